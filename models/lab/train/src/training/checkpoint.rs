//! A training run on disk: weights, moments and running means in one safetensors file.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use candle_core::{Device, Tensor};
use experts::net::Card;
use serde::{Deserialize, Serialize};

use super::TrainError;
use super::optim::{AdamW, Moments};
use super::stages::Stage;
use super::trainee::Trainee;

const HEADER: &str = "dragtraffic-training";

/// State of a run, without its parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckpointState<A> {
    pub(super) architecture: A,
    pub(super) card: Card,
    pub(super) stage: Stage,
    pub(super) seed: u64,
    pub(super) batch: usize,
    /// Total number of steps, over which the rate decays.
    pub(super) steps: u64,
    /// Top learning rate.
    pub(super) rate: f64,
    /// Learning rate at the end; a hundredth of the top one if absent.
    #[serde(default)]
    pub(super) rate_end: Option<f64>,
    pub(super) minutes: Option<f64>,
    /// Whether the refiner gets the descent direction of the energy.
    pub(super) repulsion: bool,
    /// Whether the refiner attends to the obstacles of drafts.
    pub(super) attention: bool,
    pub(super) step: u64,
    /// Seconds trained so far.
    pub(super) seconds: f64,
    /// Hash of the records.
    pub(super) records: String,
}

/// Replaces a file completely or not at all.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> Result<(), TrainError> {
    formats::files::replace(path, bytes).map_err(TrainError::io(path))
}

pub(super) fn save<T: Trainee>(
    path: &Path,
    state: &CheckpointState<T::Architecture>,
    trained: &T,
    adam: &AdamW,
) -> Result<(), TrainError> {
    let mut tensors = BTreeMap::new();
    for (name, tensor) in trained.tensors() {
        tensors.insert(format!("weights/{name}"), tensor.to_device(&Device::Cpu)?);
    }
    for (name, moments) in &adam.moments {
        for (kind, values) in
            [("first", &moments.first), ("second", &moments.second), ("mean", &moments.mean)]
        {
            let tensor = Tensor::from_slice(values, values.len(), &Device::Cpu)?;
            tensors.insert(format!("{kind}/{name}"), tensor);
        }
    }
    let damaged = |reason: String| TrainError::damaged(path, reason);
    let text = serde_json::to_string(state).map_err(|error| damaged(error.to_string()))?;
    let bytes = safetensors::serialize(&tensors, Some(HashMap::from([(HEADER.to_owned(), text)])))
        .map_err(|error| damaged(error.to_string()))?;
    replace(path, &bytes)
}

/// A run that can be continued.
pub(super) struct Resumed<T: Trainee> {
    pub(super) state: CheckpointState<T::Architecture>,
    pub(super) trained: T,
    pub(super) adam: AdamW,
}

/// Reads a run; its networks are placed on `device`, wherever they were before.
pub(super) fn load<T: Trainee>(path: &Path, device: &Device) -> Result<Resumed<T>, TrainError> {
    let bytes = std::fs::read(path).map_err(TrainError::io(path))?;
    let damaged = |reason: String| TrainError::damaged(path, reason);
    let (_, metadata) =
        safetensors::SafeTensors::read_metadata(&bytes).map_err(|e| damaged(e.to_string()))?;
    let text = metadata.metadata().as_ref().and_then(|m| m.get(HEADER));
    let text = text.ok_or_else(|| damaged("not a checkpoint of a training run".into()))?;
    let state: CheckpointState<T::Architecture> =
        serde_json::from_str(text).map_err(|error| damaged(error.to_string()))?;
    let mut tensors = candle_core::safetensors::load_buffer(&bytes, &Device::Cpu)?;
    let trained = T::random(state.architecture.clone(), state.card.clone(), 0, device)?;
    let mut take = |kind: &str, name: &str, count: usize| -> Result<Tensor, TrainError> {
        let tensor = tensors.remove(&format!("{kind}/{name}"));
        let tensor =
            tensor.ok_or_else(|| TrainError::damaged(path, format!("{kind} of {name} is missing")))?;
        if tensor.elem_count() != count {
            return Err(TrainError::damaged(
                path,
                format!("{kind} of {name} has shape {:?}", tensor.shape()),
            ));
        }
        Ok(tensor)
    };
    let mut adam = AdamW::new(trained.vars(), |name| T::share(state.stage, name))?;
    adam.step = state.step;
    for (name, var) in trained.vars() {
        let count = var.elem_count();
        var.set(&take("weights", name, count)?.reshape(var.shape())?.to_device(device)?)?;
        let mut values = |kind: &str| -> Result<Vec<f32>, TrainError> {
            Ok(take(kind, name, count)?.flatten_all()?.to_vec1::<f32>()?)
        };
        let share = T::share(state.stage, name);
        let (first, second, mean) = (values("first")?, values("second")?, values("mean")?);
        adam.moments.insert(name.clone(), Moments { first, second, mean, share });
    }
    Ok(Resumed { state, trained, adam })
}
