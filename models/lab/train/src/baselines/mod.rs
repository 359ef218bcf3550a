//! Learned rivals of the experts, trained on the same records with the same tools and as many steps. They
//! show what other networks achieve without the experts' lanes, control space and projection.
//!
//! - [`BaselineKind::TrafficGen`] (Feng et al., "TrafficGen", 2022): multi-context gating over map and road
//!   users to six futures as points; squared error of the best one and likelihood of its index. Vehicles
//!   only, without conditions.
//! - [`BaselineKind::TrafficGenConditional`]: one such network for all types, with the condition as an input.
//! - [`BaselineKind::Paper`] (DragTraffic, 2024): the same regressor with the condition, one for each type,
//!   and a conditional diffusion model that refines its futures, with its own context encoder and a
//!   one-dimensional U-Net over the points: five leapfrog steps from the fifth of a hundred noise levels. It
//!   is trained as in the paper: the denoiser alone, then the initializer with the denoiser and its encoder
//!   frozen, then both.
//!
//! All of them see the road user itself, map pieces and neighbours as the experts do, but no routes. The
//! condition (position, velocity and heading at the end, and the box) goes through its own MLP. A future has
//! 18 points, one every half second, in the road user's frame at the start; [`curve`] converts them to
//! states. A goal is only an input of the networks: nothing forces them to meet it.

mod answer;
mod curve;
mod encoder;
mod loss;
mod regressor;
mod sight;
mod stages;
mod unet;

#[cfg(test)]
mod tests;

pub use answer::Baseline;

use std::collections::{BTreeMap, HashMap};
use std::path::PathBuf;

use candle_core::{Device, Tensor, Var};
use experts::net::{Architecture, Card, NetError, Params, on_cpu};
use scene::AgentType;
use serde::{Deserialize, Serialize};

use crate::training::{self, EVERYBODY, Metrics, Stage, TrainError, TrainOptions, TrainProgress};
use regressor::Regressor;
use unet::Unet;

/// The only member of a file's metadata.
const HEADER: &str = "dragtraffic-baseline";

/// Method of a baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum BaselineKind {
    /// TrafficGen: vehicles, no condition.
    #[serde(rename = "trafficgen")]
    #[value(name = "trafficgen")]
    TrafficGen,
    /// One TrafficGen for all types, with the condition.
    #[serde(rename = "trafficgen-conditional")]
    #[value(name = "trafficgen-conditional")]
    TrafficGenConditional,
    /// The paper's architecture at its own outputs.
    Paper,
}

impl BaselineKind {
    /// Whether it sees goals.
    pub fn has_condition(self) -> bool {
        self != Self::TrafficGen
    }

    /// Expert whose records it learns from, if the method requires one.
    pub fn expert(self) -> Option<&'static str> {
        match self {
            Self::TrafficGen => Some("vehicle"),
            Self::TrafficGenConditional => Some(EVERYBODY),
            Self::Paper => None,
        }
    }
}

/// Shape of a baseline's networks.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Method.
    pub kind: BaselineKind,
    /// Widths and counts, as for the experts.
    pub sizes: Architecture,
    /// Hidden size of the condition's MLP; the paper has 1024.
    pub condition_width: usize,
}

impl Plan {
    /// The method at the experts' own width.
    pub fn of(kind: BaselineKind) -> Self {
        let sizes = Architecture::default();
        Self { kind, condition_width: sizes.width, sizes }
    }
}

#[cfg(any(test, feature = "samples"))]
impl Plan {
    /// Small networks, for tests.
    fn small(kind: BaselineKind) -> Self {
        let sizes = Architecture { width: 32, gating_blocks: 2, ..Architecture::default() };
        Self { kind, sizes, condition_width: 32 }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    plan: Plan,
    card: Card,
}

/// The networks of a baseline.
struct Networks {
    plan: Plan,
    card: Card,
    regressor: Regressor,
    refiner: Option<Unet>,
    tensors: BTreeMap<String, Tensor>,
    vars: BTreeMap<String, Var>,
}

impl Networks {
    fn build(plan: Plan, card: Card, mut p: Params) -> Result<Self, NetError> {
        plan.sizes.check()?;
        if plan.condition_width == 0 {
            return Err(NetError::Header {
                member: HEADER,
                reason: "condition_width is 0; 1 or more expected".into(),
            });
        }
        let regressor = Regressor::new(&mut p, &plan)?;
        let refiner = match plan.kind {
            BaselineKind::Paper => Some(Unet::new(&mut p, &plan)?),
            BaselineKind::TrafficGen | BaselineKind::TrafficGenConditional => None,
        };
        let (tensors, vars) = p.finish()?;
        Ok(Self { plan, card, regressor, refiner, tensors, vars })
    }

    /// Small random networks, for tests.
    #[cfg(any(test, feature = "samples"))]
    fn small(kind: BaselineKind, expert: &str, seed: u64) -> Result<Self, NetError> {
        let card = Card {
            expert: expert.into(),
            licence: String::new(),
            trained_on: String::new(),
            untrained: true,
            notes: BTreeMap::new(),
        };
        Self::build(Plan::small(kind), card, Params::random(seed, true, &Device::Cpu))
    }

    fn load(bytes: &[u8], trainable: bool, device: &Device) -> Result<Self, NetError> {
        let format = |error: safetensors::SafeTensorError| NetError::Format(error.to_string());
        let header = |reason: String| NetError::Header { member: HEADER, reason };
        let (_, metadata) = safetensors::SafeTensors::read_metadata(bytes).map_err(format)?;
        let text = metadata.metadata().as_ref().and_then(|m| m.get(HEADER));
        let text = text.ok_or_else(|| header("absent: these are not a baseline's weights".into()))?;
        let Header { plan, card } = serde_json::from_str(text).map_err(|e| header(e.to_string()))?;
        let tensors = candle_core::safetensors::load_buffer(bytes, &Device::Cpu)?.into_iter().collect();
        Self::build(plan, card, Params::given(tensors, trainable, device))
    }

    fn save(&self) -> Result<Vec<u8>, NetError> {
        let header = Header { plan: self.plan.clone(), card: self.card.clone() };
        let text = serde_json::to_string(&header).map_err(|error| NetError::Format(error.to_string()))?;
        let tensors = on_cpu(&self.tensors)?;
        safetensors::serialize(&tensors, Some(HashMap::from([(HEADER.to_owned(), text)])))
            .map_err(|error| NetError::Format(error.to_string()))
    }

    /// Device of its tensors.
    fn device(&self) -> &Device {
        self.tensors.values().next().map_or(&Device::Cpu, Tensor::device)
    }

    /// Types that it supports.
    fn types(&self) -> Result<&'static [AgentType], NetError> {
        match self.card.expert.as_str() {
            "vehicle" => Ok(&[AgentType::Vehicle]),
            "pedestrian" => Ok(&[AgentType::Pedestrian]),
            "cyclist" => Ok(&[AgentType::Cyclist]),
            EVERYBODY => Ok(&[AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist]),
            other => Err(NetError::Header {
                member: HEADER,
                reason: format!("expert \"{other}\"; vehicle, pedestrian, cyclist or {EVERYBODY} expected"),
            }),
        }
    }
}

/// Usual options of a baseline's training.
pub fn options(kind: BaselineKind, records: Vec<PathBuf>, stage: Stage, out: PathBuf) -> TrainOptions<Plan> {
    TrainOptions::of(records, stage, out, Plan::of(kind))
}

/// Trains a baseline and writes its weights; `report` gets each line. Returns the last validation.
///
/// # Errors
/// When the method has no such stage, files cannot be read or written, or a checkpoint belongs to another
/// run.
pub fn train(
    options: &TrainOptions<Plan>,
    report: &mut dyn FnMut(&TrainProgress),
) -> Result<Metrics, TrainError> {
    if options.architecture.kind != BaselineKind::Paper && options.stage != Stage::Initializer {
        return Err(TrainError::Invalid("this baseline has one stage: initializer".into()));
    }
    training::run_of::<Networks>(options, report)
}
