//! Weights files as bytes: built into the program, from a folder, or random. Reading a folder is separate
//! from building, so that a host without files can pass the bytes itself.

use crate::net::{Expert, NetError};
use scene::{AgentType, ContentHash};
use std::borrow::Cow;
use std::path::Path;

/// Types with an expert, in the order of their weights files.
pub const EXPERTS: [(AgentType, &str); 3] =
    [(AgentType::Vehicle, "vehicle"), (AgentType::Pedestrian, "pedestrian"), (AgentType::Cyclist, "cyclist")];

/// Name of the file with placement weights, beside those of the experts.
pub const PLACEMENT_FILE: &str = "placement.json";

/// Why weights cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("weights {path}: {reason}")]
pub struct WeightsError {
    /// File.
    pub path: String,
    /// What is wrong.
    pub reason: String,
}

/// Description of the weights of an expert.
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
    /// Whether the weights are random, for tests.
    pub untrained: bool,
}

impl WeightsInfo {
    /// Facts about the weights in these bytes, from which `expert` was made.
    pub(crate) fn of(name: &str, bytes: &[u8], expert: &Expert) -> Self {
        Self {
            name: name.to_owned(),
            sha256: ContentHash::of_bytes(bytes).hex(),
            parameters: expert.parameters(),
            licence: expert.card.licence.clone(),
            trained_on: expert.card.trained_on.clone(),
            horizon_s: scene::HORIZON_STEPS as f64 * scene::STEP_S,
            modes: crate::planning::MODES,
            untrained: expert.card.untrained,
        }
    }
}

/// The bytes of all weights files.
#[derive(Clone, Debug)]
pub struct Files {
    /// Bytes of the experts' files, in the order of [`EXPERTS`].
    pub experts: [Cow<'static, [u8]>; EXPERTS.len()],
    /// Bytes of the placement file; `None` places road users evenly along lanes.
    pub placement: Option<Cow<'static, [u8]>>,
}

impl Files {
    /// The files that are built into the program.
    pub fn built_in() -> Self {
        let experts: [&'static [u8]; EXPERTS.len()] = [
            include_bytes!("../weights/vehicle.safetensors"),
            include_bytes!("../weights/pedestrian.safetensors"),
            include_bytes!("../weights/cyclist.safetensors"),
        ];
        let placement: &'static [u8] = include_bytes!("../weights/placement.json");
        Self { experts: experts.map(Cow::Borrowed), placement: Some(Cow::Borrowed(placement)) }
    }

    /// Reads `vehicle.safetensors`, `pedestrian.safetensors` and `cyclist.safetensors` of a folder, and
    /// `placement.json` if it exists.
    ///
    /// # Errors
    /// When a file is missing or cannot be read.
    pub fn read(dir: &Path) -> Result<Self, WeightsError> {
        let mut experts = [const { Cow::Borrowed(&[] as &[u8]) }; EXPERTS.len()];
        for (bytes, (_, name)) in experts.iter_mut().zip(EXPERTS) {
            let path = dir.join(format!("{name}.safetensors"));
            *bytes = Cow::Owned(std::fs::read(&path).map_err(|e| unreadable(&path, &e))?);
        }
        let path = dir.join(PLACEMENT_FILE);
        let placement = match std::fs::read(&path) {
            Ok(bytes) => Some(Cow::Owned(bytes)),
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => None,
            Err(e) => return Err(unreadable(&path, &e)),
        };
        Ok(Self { experts, placement })
    }

    /// Random experts, for tests of everything but quality; no placement weights.
    ///
    /// # Errors
    /// When memory for them cannot be allocated.
    pub fn random(seed: u64) -> Result<Self, WeightsError> {
        let mut experts = [const { Cow::Borrowed(&[] as &[u8]) }; EXPERTS.len()];
        for (i, (bytes, (_, name))) in experts.iter_mut().zip(EXPERTS).enumerate() {
            let failed = |e: NetError| WeightsError { path: name.to_owned(), reason: e.to_string() };
            let expert = Expert::random(seed.wrapping_add(i as u64)).map_err(failed)?;
            *bytes = Cow::Owned(expert.save().map_err(failed)?);
        }
        Ok(Self { experts, placement: None })
    }
}

fn unreadable(path: &Path, error: &std::io::Error) -> WeightsError {
    WeightsError { path: path.display().to_string(), reason: error.to_string() }
}
