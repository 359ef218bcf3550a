//! Weights files: built in, from a folder, or random.

use super::{EXPERTS, Generator};
use crate::net::Expert;
use crate::placement::{FILE_NAME, PlacementInfo, PlacementModel};
use crate::request::{Cancel, Request};
use scene::map::Lane;
use scene::{Agent, AgentType, ContentHash, LaneMap, Scene, State, Subtype, Vec2};
use std::path::Path;
use std::sync::Arc;

/// Facts about one expert's weights.
#[derive(Clone, Debug, serde::Serialize, schemars::JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct WeightsInfo {
    pub name: String,
    pub sha256: String,
    pub parameters: usize,
    pub licence: String,
    pub trained_on: String,
    pub horizon_s: f64,
    pub modes: usize,
    /// Random weights, for tests.
    pub untrained: bool,
}

impl WeightsInfo {
    pub(super) fn of(name: &str, bytes: &[u8], expert: &Expert) -> Self {
        Self {
            name: name.to_owned(),
            sha256: ContentHash::of_bytes(bytes).hex(),
            parameters: expert.parameters(),
            licence: expert.card.licence.clone(),
            trained_on: expert.card.trained_on.clone(),
            horizon_s: scene::HORIZON_STEPS as f64 * scene::STEP_S,
            modes: crate::features::MODES,
            untrained: expert.card.untrained,
        }
    }
}

/// Why weights cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("weights {path}: {reason}")]
pub struct WeightsError {
    /// File.
    pub path: String,
    /// What is wrong.
    pub reason: String,
}

type Files = Vec<(AgentType, &'static str, Vec<u8>)>;

pub(super) fn built_in() -> Files {
    let bytes: [&[u8]; EXPERTS.len()] = [
        include_bytes!("../../../../assets/weights/vehicle.safetensors"),
        include_bytes!("../../../../assets/weights/pedestrian.safetensors"),
        include_bytes!("../../../../assets/weights/cyclist.safetensors"),
    ];
    EXPERTS.iter().zip(bytes).map(|((t, name), b)| (*t, *name, b.to_vec())).collect()
}

pub(super) fn read_dir(dir: &Path) -> Result<Files, WeightsError> {
    let read = |(agent_type, name): &(AgentType, &'static str)| {
        let path = dir.join(format!("{name}.safetensors"));
        match std::fs::read(&path) {
            Ok(bytes) => Ok((*agent_type, *name, bytes)),
            Err(e) => Err(WeightsError { path: path.display().to_string(), reason: e.to_string() }),
        }
    };
    EXPERTS.iter().map(read).collect()
}

/// The placement weights inside the program.
pub(super) const PLACEMENT: &[u8] = include_bytes!("../../../../assets/weights/placement.json");

pub(super) fn read_placement(bytes: &[u8]) -> Result<(PlacementModel, PlacementInfo), WeightsError> {
    let model = PlacementModel::load(bytes)?;
    let info = model.info(bytes);
    Ok((model, info))
}

/// Placement weights of a folder, which may have none.
pub(super) fn placement_in(dir: &Path) -> Result<Option<(PlacementModel, PlacementInfo)>, WeightsError> {
    let path = dir.join(FILE_NAME);
    match std::fs::read(&path) {
        Ok(bytes) => read_placement(&bytes).map(Some),
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(e) => Err(WeightsError { path: path.display().to_string(), reason: e.to_string() }),
    }
}

pub(super) fn random(seed: u64) -> Result<Files, WeightsError> {
    let make = |(i, (agent_type, name)): (usize, &(AgentType, &'static str))| {
        let failed =
            |e: crate::net::NetError| WeightsError { path: (*name).to_owned(), reason: e.to_string() };
        let expert = Expert::random(seed.wrapping_add(i as u64)).map_err(failed)?;
        Ok((*agent_type, *name, expert.save().map_err(failed)?))
    };
    EXPERTS.iter().enumerate().map(make).collect()
}

/// A small scene through all three experts: fills the heap and the caches of the tensor library.
pub(super) fn warm_up(generator: &Generator) {
    let lane = Lane::street("1", (0..40).map(|i| Vec2::new(5.0 * f64::from(i), 0.0)).collect::<Vec<_>>());
    let agent = |i: usize| {
        let agent_type = EXPERTS[i % 3].0;
        let state = State { x_m: 6.0 * i as f64, vx_mps: 1.0, ..State::default() };
        Agent::bare(i.to_string(), agent_type, Subtype::Unknown, vec![Some(state)])
    };
    let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
    let scene = Scene::bare("", map, (0..24).map(agent).collect());
    if let Ok(call) = generator.start(Request::new(Arc::new(scene)), Cancel::default()) {
        call.for_each(drop);
    }
}
