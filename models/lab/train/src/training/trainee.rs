//! Interface of trainable networks.

use std::collections::BTreeMap;

use candle_core::{Device, Tensor, Var};
use experts::net::{Architecture, Card, Expert, NetError};
use scene::random::Stream;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::metrics::Metrics;
use super::sample::Shard;
use super::stages::{self, Stage, Tools};
use super::{Record, TrainError};

/// Networks with their losses. Parameter names decide which stage trains them: see [`Trainee::share`].
pub(crate) trait Trainee: Sized + Sync {
    /// Configuration that determines the shapes and the meaning of the tensors.
    type Architecture: Clone + PartialEq + Serialize + DeserializeOwned;

    /// Random weights from a seed.
    fn random(
        architecture: Self::Architecture,
        card: Card,
        seed: u64,
        device: &Device,
    ) -> Result<Self, NetError>;
    /// Weights of a file, for further training.
    fn read(bytes: &[u8], device: &Device) -> Result<Self, NetError>;
    /// These networks with the additional parts of the wanted architecture, random from a seed.
    fn grown(self, _wanted: &Self::Architecture, _seed: u64) -> Result<Self, NetError> {
        Ok(self)
    }
    /// The bytes of a weights file.
    fn write(&self) -> Result<Vec<u8>, NetError>;
    /// Configuration of the networks.
    fn architecture(&self) -> &Self::Architecture;
    /// Card of the weights in the file.
    fn card(&self) -> &Card;
    /// Card of the weights, for changes.
    fn card_mut(&mut self) -> &mut Card;
    /// All tensors by name.
    fn tensors(&self) -> &BTreeMap<String, Tensor>;
    /// All variables by name.
    fn vars(&self) -> &BTreeMap<String, Var>;

    /// Whether the networks can learn from a record.
    fn takes(&self, record: &Record) -> bool;
    /// Whether draws come from each file with the same probability, however many records it has.
    fn draws_files_evenly(&self) -> bool;

    /// Share of the learning rate for a parameter in a stage; a parameter without a share is unchanged, bit
    /// for bit. For the experts: parameters under `refiner.` are frozen in [`Stage::Initializer`], all others
    /// are frozen in [`Stage::Denoiser`] and learn slower in [`Stage::Joint`].
    fn share(stage: Stage, name: &str) -> f64 {
        let refiner = name.starts_with("refiner.");
        match stage {
            Stage::Denoiser => f64::from(u8::from(refiner)),
            Stage::Initializer => f64::from(u8::from(!refiner)),
            Stage::Joint if refiner => 1.0,
            Stage::Joint => 0.2,
        }
    }

    /// A scalar whose backward pass gives the gradient of a stage's loss summed over the shard, and the
    /// metrics.
    fn loss(
        &self,
        tools: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> Result<(Tensor, Metrics), TrainError>;
    /// Figures on held-out records.
    fn validate(
        &self,
        tools: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> Result<Metrics, TrainError>;
}

impl Trainee for Expert {
    type Architecture = Architecture;

    fn random(architecture: Architecture, card: Card, seed: u64, device: &Device) -> Result<Self, NetError> {
        Self::trainable(architecture, card, seed, device)
    }

    fn read(bytes: &[u8], device: &Device) -> Result<Self, NetError> {
        Self::load_trainable(bytes, device)
    }

    fn grown(self, wanted: &Architecture, seed: u64) -> Result<Self, NetError> {
        if wanted.refiner_attention <= self.architecture.refiner_attention {
            return Ok(self);
        }
        self.with_attention(wanted.refiner_attention, seed)
    }

    fn write(&self) -> Result<Vec<u8>, NetError> {
        self.save()
    }

    fn architecture(&self) -> &Architecture {
        &self.architecture
    }

    fn card(&self) -> &Card {
        &self.card
    }

    fn card_mut(&mut self) -> &mut Card {
        &mut self.card
    }

    fn tensors(&self) -> &BTreeMap<String, Tensor> {
        self.tensors()
    }

    fn vars(&self) -> &BTreeMap<String, Var> {
        self.vars()
    }

    fn takes(&self, _: &Record) -> bool {
        true
    }

    fn draws_files_evenly(&self) -> bool {
        false
    }

    fn loss(
        &self,
        tools: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> Result<(Tensor, Metrics), TrainError> {
        stages::train(self, tools, shard, stage, rng)
    }

    fn validate(
        &self,
        tools: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> Result<Metrics, TrainError> {
        stages::validate(self, tools, shard, stage, rng)
    }
}
