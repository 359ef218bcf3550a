//! The request of a placement, with its defaults.

use crate::home::{AboutScene, SceneRef, one_scene};
use formats::native::{Members, SceneDoc};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// A circle.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CircleDoc {
    /// Centre, metres.
    pub x_m: f64,
    /// Centre, metres.
    pub y_m: f64,
    /// Metres.
    #[schemars(range(min = 0.5, max = 20000.0))]
    pub radius_m: f64,
}

/// Region for box centres: exactly one of `circle` and `polygon_m`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegionDoc {
    /// Open ring of corners, metres; even-odd rule.
    #[serde(default)]
    pub polygon_m: Option<Vec<[f64; 2]>>,
    /// Circle.
    #[serde(default)]
    pub circle: Option<CircleDoc>,
}

/// Density: exactly one of `count` and `per_lane_km`.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DensityDoc {
    /// Road users per kilometre of lane for motor vehicles in the region, without junctions.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 200.0))]
    pub per_lane_km: Option<f64>,
    /// Total number of road users.
    #[serde(default)]
    #[schemars(range(min = 1, max = 256))]
    pub count: Option<u64>,
}

/// Range of start speeds of moving motor vehicles.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpeedsDoc {
    /// m/s.
    #[schemars(range(min = 0.0, max = 40.0))]
    pub min_mps: f64,
    /// m/s; not less than `min_mps`.
    #[schemars(range(min = 0.0, max = 40.0))]
    pub max_mps: f64,
}

/// Traffic that enters by an arm.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArrivalsDoc {
    /// Id of one of the reply's `arms`.
    pub arm: String,
    /// Motor vehicles per hour, all lanes together.
    #[schemars(range(min = 0.0, max = 20000.0))]
    pub per_hour: f64,
}

/// Cars parked at kerbs and in car parks: exactly one of `per_100m` and `share`.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParkedDoc {
    /// Share of the parking places that are occupied.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub share: Option<f64>,
    /// Cars per 100 m of kerb with room; the same share of the bays in car parks is occupied.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 20.0))]
    pub per_100m: Option<f64>,
}

/// Body of a placement. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = one_scene)]
pub struct PlaceBody {
    /// The scene itself; its map may be `{"ref":"sha256:HEX"}`.
    pub scene: Option<SceneDoc>,
    /// A scene of this server.
    pub scene_id: Option<String>,
    /// With `scene_id`: the call is refused if the scene has changed.
    pub etag: Option<String>,
    /// Region; null is the whole map. It may reach 50 m beyond the map's box.
    pub region: Option<RegionDoc>,
    /// Density. Absent or null: 12 per kilometre, or 0 with `arrivals` or `parked`.
    pub density: Option<DensityDoc>,
    /// Shares of `vehicle`, `pedestrian` and `cyclist`, which sum to 1.
    #[schemars(with = "Option<BTreeMap<String, f64>>")]
    pub types: Option<Members<f64>>,
    /// Road users of the scene to keep; null keeps all. The others count as removed.
    pub keep: Option<Vec<String>>,
    /// Scene time at which they start, seconds.
    #[schemars(range(min = 0.0, max = 59.9))]
    pub start_s: f64,
    /// Seed of the random draws; equal seeds give equal answers.
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: u64,
    /// Minimum gap along the lane between moving vehicles, metres. All other gaps are at least 0.1 m.
    #[schemars(range(min = 0.0, max = 50.0))]
    pub min_gap_m: f64,
    /// Speeds of moving motor vehicles; null draws the speeds typical of each road. Vehicles at rest, as in a
    /// queue, stay at rest.
    pub speeds: Option<SpeedsDoc>,
    /// Traffic by arm, until the end of the scene. It is the only source of vehicles on the lanes of these
    /// arms.
    #[schemars(length(max = 256))]
    pub arrivals: Vec<ArrivalsDoc>,
    /// Parked cars, in addition to `density`.
    pub parked: Option<ParkedDoc>,
}

impl Default for PlaceBody {
    /// The defaults of a placement.
    fn default() -> Self {
        Self {
            scene: None,
            scene_id: None,
            etag: None,
            region: None,
            density: None,
            types: None,
            keep: None,
            start_s: 0.0,
            seed: 0,
            min_gap_m: 2.0,
            speeds: None,
            arrivals: Vec::new(),
            parked: None,
        }
    }
}

impl AboutScene for PlaceBody {
    fn take_scene(&mut self) -> SceneRef {
        SceneRef {
            scene: self.scene.take(),
            scene_id: self.scene_id.take(),
            etag: self.etag.take(),
            hold: false,
        }
    }
}
