//! Facts about a program with these operations.

use crate::domain::{ConditionRanges, KindLimits};
use crate::import;
use crate::limits::Bound;
use experts::placement::PlacementInfo;
use experts::request::{DEFAULTS, Defaults};
use experts::{Generator, Placer, WeightsInfo};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Build of the program.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
#[schemars(rename = "Build")]
pub struct BuildInfo {
    /// Target triple.
    pub target: &'static str,
    /// Cargo profile.
    pub profile: &'static str,
}

/// Versions of the interfaces: each changes only when older programs or files need a change.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct InterfaceVersions {
    /// The API, the first part of its addresses: `/v1`.
    api: u64,
    /// The scene document.
    scene: u64,
    /// The file of saved scenes; absent in a program without one.
    #[serde(skip_serializing_if = "Option::is_none")]
    store: Option<u64>,
}

/// Description of the server.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "Info")]
pub struct ProgramInfo {
    /// Name of the program.
    name: &'static str,
    /// Version of the program.
    version: &'static str,
    /// Versions of the interfaces.
    versions: InterfaceVersions,
    build: BuildInfo,
    /// Device that computes the networks.
    device: &'static str,
    /// Experts by name.
    weights: BTreeMap<String, WeightsInfo>,
    /// Weights of placement; null when road users are placed evenly along lanes.
    placement: Option<PlacementInfo>,
    /// Limits of the server and of the scene format, by name.
    limits: BTreeMap<&'static str, Bound>,
    /// Ranges of conditions.
    condition_ranges: ConditionRanges,
    /// Motion limits of each kind of road user.
    motion_limits: KindLimits,
    /// Defaults of a generation.
    defaults: Defaults,
    /// Formats of files.
    formats: Vec<formats::format::Info>,
    /// Notices for the operators of the server.
    notices: Vec<String>,
}

impl ProgramInfo {
    /// The facts about an engine; the transport adds build and limits.
    pub fn new(
        generator: &Generator,
        placer: &Placer,
        build: BuildInfo,
        limits: BTreeMap<&'static str, Bound>,
    ) -> Self {
        Self {
            name: "dragtraffic",
            version: env!("CARGO_PKG_VERSION"),
            versions: InterfaceVersions { api: 1, scene: formats::native::VERSION, store: None },
            build,
            device: "cpu",
            weights: generator.weights().clone(),
            placement: placer.info().cloned(),
            limits,
            condition_ranges: ConditionRanges::current(),
            motion_limits: KindLimits::current(),
            defaults: DEFAULTS,
            formats: import::table(),
            notices: Vec::new(),
        }
    }

    /// Adds the version of the file of saved scenes.
    #[must_use]
    pub fn with_store(mut self, version: u64) -> Self {
        self.versions.store = Some(version);
        self
    }
}
