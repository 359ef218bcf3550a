//! `/v1/info`: what this server is and can do.

use crate::app::App;
use crate::base::domain::{ConditionRanges, KindLimits};
use crate::base::limits::{Bound, Limits};
use crate::scenes::transfer;
use axum::extract::State;
use experts::placement::PlacementInfo;
use experts::request::{DEFAULTS, Defaults};
use experts::{Generator, Placer, WeightsInfo};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// What the program was built for.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Build {
    /// Target triple.
    target: &'static str,
    /// Cargo profile.
    profile: &'static str,
}

/// What this server is and can do.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Info {
    /// Name of the program.
    name: &'static str,
    /// Version of the program.
    version: &'static str,
    build: Build,
    /// What computes the networks.
    device: &'static str,
    /// Experts by name.
    weights: BTreeMap<String, WeightsInfo>,
    /// Weights of placement; null when road users are placed evenly along lanes.
    placement: Option<PlacementInfo>,
    /// Bounds of the server by name, and those of the scene format.
    limits: BTreeMap<&'static str, Bound>,
    /// What conditions may ask for.
    condition_ranges: ConditionRanges,
    /// What each kind of road user can do.
    motion_limits: KindLimits,
    /// What a generation has when the request does not say.
    defaults: Defaults,
    /// Formats of files.
    formats: Vec<formats::format::Info>,
    /// Sentences for people who run the server.
    notices: Vec<String>,
}

impl Info {
    /// Of a server with these experts and bounds; for the command line too.
    pub fn new(generator: &Generator, placer: &Placer, limits: &Limits) -> Self {
        Self {
            name: "dragtraffic",
            version: env!("CARGO_PKG_VERSION"),
            build: Build { target: env!("BUILD_TARGET"), profile: env!("BUILD_PROFILE") },
            device: "cpu",
            weights: generator.weights().clone(),
            placement: placer.info().cloned(),
            limits: limits.bounds(),
            condition_ranges: ConditionRanges::current(),
            motion_limits: KindLimits::current(),
            defaults: DEFAULTS,
            formats: transfer::table(),
            notices: Vec::new(),
        }
    }
}

refusals!(Refused:);

/// Version, weights, limits and formats.
#[utoipa::path(get, path = "/v1/info", operation_id = "info", tag = "server",
    responses((status = 200, description = "the server", body = ref("#/components/schemas/Info")), Refused))]
pub async fn info(State(app): State<App>) -> axum::Json<Info> {
    axum::Json(Info::new(&app.generator, &app.placer, &app.limits))
}
