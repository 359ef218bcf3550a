//! One expert: three networks and the metadata of their file.

use std::collections::{BTreeMap, HashMap};

use candle_core::{Device, Tensor, Var};
use serde::{Deserialize, Serialize};

use super::architecture::Architecture;
use super::encoder::{Context, ContextEncoder};
use super::error::NetError;
use super::initializer::{Initial, Initializer};
use super::inputs::{EncounterTensors, InputTensors};
use super::params::Params;
use super::refiner::{DraftInputs, Prepared, Refiner};
use crate::features::AgentFeatures;
use crate::features::encounters::Encounters;
use crate::planning::{MODES, RESIDUAL};

/// The only member of the file's metadata. Several members would have a random order, and the file is
/// identified by its hash.
const HEADER: &str = "dragtraffic";

/// Metadata of the weights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Card {
    /// Name of the expert: vehicle, pedestrian or cyclist.
    pub expert: String,
    /// Licence of the weights.
    pub licence: String,
    /// Data that they were trained on.
    pub trained_on: String,
    /// Whether the weights are random, for tests.
    pub untrained: bool,
    /// Other facts: hash of the records, steps, figures.
    #[serde(default)]
    pub notes: BTreeMap<String, String>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WeightsHeader {
    architecture: Architecture,
    card: Card,
}

/// The first futures of a batch as plain numbers, one entry per road user.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialOutput {
    /// Normalised residuals, tangent to the goal.
    pub residual: Vec<[[f32; RESIDUAL]; MODES]>,
    /// Scale (spread) of each number of a residual.
    pub scale: Vec<[[f32; RESIDUAL]; MODES]>,
    /// Logarithms of the modes' probabilities.
    pub log_prob: Vec<[f32; MODES]>,
    /// Probability that the road user stands still.
    pub stays: Vec<f32>,
}

/// The networks of one expert. Cheap to share between threads.
#[derive(Clone, Debug)]
pub struct Expert {
    /// Its sizes.
    pub architecture: Architecture,
    /// Metadata of its file.
    pub card: Card,
    /// Inputs to a context.
    pub context: ContextEncoder,
    /// Context to first futures.
    pub initializer: Initializer,
    /// Drafts to refined drafts.
    pub refiner: Refiner,
    device: Device,
    tensors: BTreeMap<String, Tensor>,
    vars: BTreeMap<String, Var>,
}

impl Expert {
    /// Random weights from a seed, as plain tensors, for tests.
    ///
    /// # Errors
    /// When memory for them cannot be allocated.
    pub fn random(seed: u64) -> Result<Self, NetError> {
        let card = Card {
            expert: "random".into(),
            licence: "MIT OR Apache-2.0".into(),
            trained_on: "nothing".into(),
            untrained: true,
            notes: BTreeMap::new(),
        };
        Self::build(Architecture::default(), card, Params::random(seed, false, &Device::Cpu))
    }

    /// Random weights from a seed that can be trained.
    ///
    /// # Errors
    /// When the architecture is not one this program runs.
    pub fn trainable(
        architecture: Architecture,
        card: Card,
        seed: u64,
        device: &Device,
    ) -> Result<Self, NetError> {
        Self::build(architecture, card, Params::random(seed, true, device))
    }

    /// Reads a weights file as plain tensors, which record no graph.
    ///
    /// # Errors
    /// When the bytes are not such a file, or have another architecture.
    pub fn load(bytes: &[u8]) -> Result<Self, NetError> {
        Self::read(bytes, false, &Device::Cpu)
    }

    /// Reads a weights file to train it further.
    ///
    /// # Errors
    /// As [`Expert::load`].
    pub fn load_trainable(bytes: &[u8], device: &Device) -> Result<Self, NetError> {
        Self::read(bytes, true, device)
    }

    /// The same trainable expert with more pairs of attention in its refiner, random ones from a seed.
    ///
    /// # Errors
    /// When there are too many pairs.
    pub fn with_attention(self, pairs: usize, seed: u64) -> Result<Self, NetError> {
        let architecture = Architecture { refiner_attention: pairs, ..self.architecture };
        let grown = Self::trainable(architecture, self.card, seed, &self.device)?;
        for (name, tensor) in &self.tensors {
            if let Some(var) = grown.vars.get(name) {
                var.set(tensor)?;
            }
        }
        Ok(grown)
    }

    fn read(bytes: &[u8], trainable: bool, device: &Device) -> Result<Self, NetError> {
        let format = |error: safetensors::SafeTensorError| NetError::Format(error.to_string());
        let (_, metadata) = safetensors::SafeTensors::read_metadata(bytes).map_err(format)?;
        let text = metadata.metadata().as_ref().and_then(|m| m.get(HEADER)).ok_or_else(|| {
            NetError::Header { member: HEADER, reason: "absent: these are not an expert's weights".into() }
        })?;
        let header: WeightsHeader = serde_json::from_str(text)
            .map_err(|error| NetError::Header { member: HEADER, reason: error.to_string() })?;
        let tensors = candle_core::safetensors::load_buffer(bytes, &Device::Cpu)?.into_iter().collect();
        Self::build(header.architecture, header.card, Params::given(tensors, trainable, device))
    }

    fn build(architecture: Architecture, card: Card, mut p: Params) -> Result<Self, NetError> {
        architecture.check()?;
        let device = p.device().clone();
        let context = ContextEncoder::new(&mut p, &architecture)?;
        let initializer = Initializer::new(&mut p, &architecture)?;
        let refiner = Refiner::new(&mut p, &architecture)?;
        let (tensors, vars) = p.finish()?;
        Ok(Self { architecture, card, context, initializer, refiner, device, tensors, vars })
    }

    /// The bytes of a weights file: the same bytes for the same weights and card.
    ///
    /// # Errors
    /// When a tensor cannot be read back.
    pub fn save(&self) -> Result<Vec<u8>, NetError> {
        let header = WeightsHeader { architecture: self.architecture.clone(), card: self.card.clone() };
        let text = serde_json::to_string(&header).map_err(|error| NetError::Format(error.to_string()))?;
        let tensors = on_cpu(&self.tensors)?;
        safetensors::serialize(&tensors, Some(HashMap::from([(HEADER.to_owned(), text)])))
            .map_err(|error| NetError::Format(error.to_string()))
    }

    /// Whether its refiner attends to encounters.
    pub fn attends(&self) -> bool {
        self.architecture.refiner_attention > 0
    }

    /// Number of trained numbers.
    pub fn parameters(&self) -> usize {
        self.tensors.values().map(Tensor::elem_count).sum()
    }

    /// All tensors by name.
    pub fn tensors(&self) -> &BTreeMap<String, Tensor> {
        &self.tensors
    }

    /// The variables by name; none unless the expert was made to be trained.
    pub fn vars(&self) -> &BTreeMap<String, Var> {
        &self.vars
    }

    /// Device of the weights.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// Contexts of a batch of road users. A road user's context does not depend on the batch, bit for bit.
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn encode(&self, agents: &[&AgentFeatures]) -> Result<Context, NetError> {
        Ok(self.context.forward(&InputTensors::stack(agents, &self.device)?)?)
    }

    /// First futures of a batch as tensors.
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn initial(&self, context: &Context) -> Result<Initial, NetError> {
        Ok(self.initializer.forward(context)?)
    }

    /// First futures of a batch.
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn initialize(&self, context: &Context) -> Result<InitialOutput, NetError> {
        let initial = self.initial(context)?;
        let rows =
            |tensor: &Tensor| -> Result<Vec<f32>, NetError> { Ok(tensor.flatten_all()?.to_vec1::<f32>()?) };
        Ok(InitialOutput {
            residual: blocks(&rows(&initial.residual)?),
            scale: blocks(&rows(&initial.log_scale.exp()?)?),
            log_prob: rows(&initial.log_prob()?)?.as_chunks::<MODES>().0.to_vec(),
            stays: rows(&candle_nn::ops::sigmoid(&initial.stays)?)?,
        })
    }

    /// Values that are constant over the steps, for any number of [`Expert::refine_step`] calls.
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn prepare_refine(&self, context: &Context) -> Result<Prepared, NetError> {
        Ok(self.refiner.prepare(context)?)
    }

    /// Drafts with noise of a level, to start refinement from.
    ///
    /// # Errors
    /// When the counts differ from the batch's.
    pub fn add_noise(
        &self,
        prepared: &Prepared,
        residual: &[[[f32; RESIDUAL]; MODES]],
        noise: &[[[f32; RESIDUAL]; MODES]],
        level: usize,
    ) -> Result<Vec<[[f32; RESIDUAL]; MODES]>, NetError> {
        let levels = vec![level; residual.len()];
        let noisy =
            self.refiner.add_noise(prepared, &self.tensor(residual)?, &self.tensor(noise)?, &levels)?;
        Ok(blocks(&noisy.flatten_all()?.to_vec1::<f32>()?))
    }

    /// One refinement step from level `t` to `t_next`, as given by [`super::schedule::ddim`]. `push` is the
    /// result of [`Pullback::downhill`](crate::planning::pullback::Pullback::downhill) at the drafts,
    /// `encounters` that of [`encounters`](crate::features::encounters::encounters), which only an attending
    /// expert reads. `noise` holds standard normal numbers, or nothing for a deterministic step. Each has one
    /// entry per agent.
    ///
    /// # Errors
    /// When the counts differ from the batch's.
    pub fn refine_step(
        &self,
        prepared: &Prepared,
        residual: &[[[f32; RESIDUAL]; MODES]],
        (push, encounters): (&[[[f32; RESIDUAL]; MODES]], &[&Encounters]),
        levels: (usize, usize),
        noise: Option<&[[[f32; RESIDUAL]; MODES]]>,
    ) -> Result<Vec<[[f32; RESIDUAL]; MODES]>, NetError> {
        let noise = noise.map(|noise| self.tensor(noise)).transpose()?;
        let (residual, push) = (self.tensor(residual)?, self.tensor(push)?);
        let stacked = || EncounterTensors::stack(encounters, &self.device);
        let encounters = self.attends().then(stacked).transpose()?;
        let inputs = DraftInputs { push: &push, encounters: encounters.as_ref() };
        let next = self.refiner.step(prepared, &residual, &inputs, levels, noise.as_ref())?;
        Ok(blocks(&next.flatten_all()?.to_vec1::<f32>()?))
    }

    fn tensor(&self, values: &[[[f32; RESIDUAL]; MODES]]) -> Result<Tensor, NetError> {
        let flat = values.as_flattened().as_flattened();
        Ok(Tensor::from_slice(flat, (values.len(), MODES, RESIDUAL), &self.device)?)
    }
}

/// Copies tensors from any device to memory, from which a file can be written.
///
/// # Errors
/// When a tensor cannot be read back.
pub fn on_cpu(tensors: &BTreeMap<String, Tensor>) -> Result<BTreeMap<&str, Tensor>, NetError> {
    tensors.iter().map(|(name, tensor)| Ok((name.as_str(), tensor.to_device(&Device::Cpu)?))).collect()
}

fn blocks(values: &[f32]) -> Vec<[[f32; RESIDUAL]; MODES]> {
    values.as_chunks::<RESIDUAL>().0.as_chunks::<MODES>().0.to_vec()
}
