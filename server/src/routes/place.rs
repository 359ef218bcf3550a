//! `/v1/place`: road users where there are none yet.

use super::openapi::one_scene;
use super::scene_ref::{AboutScene, SceneRef, Subject, WithScene};
use crate::app::App;
use crate::base::problem::{Code, Problem};
use crate::http::body::JsonText;
use crate::http::extract::Connection;
use crate::work::{Asked, Kind};
use axum::extract::State;
use experts::placement::{
    Amount, ArmTraffic, Arrivals, MAX_COUNT, MAX_GAP_M, MAX_PARKED_PER_100M, MAX_PER_HOUR, MAX_PER_LANE_KM,
    MAX_SPEED_MPS, Method, Parked, PlaceRequest, Placement, Region, SpeedRange, map_bounds, ring_area_m2,
};
use experts::{Cancel, GenerateError, Placer};
use formats::native::{AgentDoc, MAX_SAFE_INTEGER, Members, SceneDoc};
use formats::{FieldProblem, ReadError, pointer_token};
use scene::{AgentType, STEP_S, Scene, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

/// What placing takes, about: a few road users, or a town of them.
const PLACE_COST: Duration = Duration::from_millis(50);

/// How far a region may reach beyond the map's box, metres: a hand-drawn ring is seldom exact.
const REGION_MARGIN_M: f64 = 50.0;
/// Most corners of a region.
const MAX_CORNERS: usize = scene::MAX_POLYLINE_POINTS;
/// Most arms that traffic may be asked of.
const MAX_ARMS: usize = 256;
/// Shares must sum to one within this.
const SHARE_TOLERANCE: f64 = 1e-6;

/// A circle.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CircleDoc {
    /// Centre, metres.
    x_m: f64,
    /// Centre, metres.
    y_m: f64,
    /// Metres.
    #[schemars(range(min = 0.5, max = 20000.0))]
    radius_m: f64,
}

/// Where centres may lie: exactly one of the two.
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

/// How many: exactly one of the two.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DensityDoc {
    /// Road users for each kilometre of lane for motor vehicles in the region, junctions left out.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 200.0))]
    per_lane_km: Option<f64>,
    /// Road users in all.
    #[serde(default)]
    #[schemars(range(min = 1, max = 256))]
    count: Option<u64>,
}

/// Between which speeds motor vehicles start that move.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpeedsDoc {
    /// m/s.
    #[schemars(range(min = 0.0, max = 40.0))]
    min_mps: f64,
    /// m/s; not less than `min_mps`.
    #[schemars(range(min = 0.0, max = 40.0))]
    max_mps: f64,
}

/// Traffic that comes in by an arm.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArrivalsDoc {
    /// Id of one of the reply's `arms`.
    arm: String,
    /// Motor vehicles an hour, all lanes together.
    #[schemars(range(min = 0.0, max = 20000.0))]
    per_hour: f64,
}

/// Cars parked along kerbs and in lots: exactly one of the two.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParkedDoc {
    /// Share of the places that are taken.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 1.0))]
    share: Option<f64>,
    /// Cars on each 100 m of kerb that has room; of the bays in lots as large a share.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 20.0))]
    per_100m: Option<f64>,
}

/// Body of a placement. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = one_scene)]
pub struct PlaceBody {
    /// The scene itself; its map may be `{"ref":"sha256:HEX"}`.
    #[serde(default)]
    scene: Option<SceneDoc>,
    /// A scene of this server.
    #[serde(default)]
    scene_id: Option<String>,
    /// With `scene_id`: refuse when the scene has changed.
    #[serde(default)]
    etag: Option<String>,
    /// Where; null is the whole map. It may reach 50 m beyond the map's box.
    #[serde(default)]
    region: Option<RegionDoc>,
    /// How many; absent or null is 12 for each kilometre, or nobody beside `arrivals` or `parked`.
    #[serde(default)]
    density: Option<DensityDoc>,
    /// Share of `vehicle`, `pedestrian` and `cyclist`; sums to 1.
    #[serde(default)]
    #[schemars(with = "Option<BTreeMap<String, f64>>")]
    types: Option<Members<f64>>,
    /// Road users of the scene that stay; null keeps all. The others are taken to be gone.
    #[serde(default)]
    keep: Option<Vec<String>>,
    /// Scene time at which they start, seconds.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 59.9))]
    at_s: f64,
    /// The same seed gives the same answer.
    #[serde(default)]
    #[schemars(range(max = 9007199254740991u64))]
    seed: u64,
    /// Least room along the lane between those who drive, metres. Everybody else keeps 0.1 m.
    #[serde(default = "usual_gap")]
    #[schemars(range(min = 0.0, max = 50.0))]
    min_gap_m: f64,
    /// Speeds of motor vehicles that move; null is as they are on such roads. Who stands, as in a queue, stands.
    #[serde(default)]
    speeds: Option<SpeedsDoc>,
    /// Traffic by arm, for as long as the scene lasts. Drivers on the lanes of these arms come from here alone.
    #[serde(default)]
    #[schemars(length(max = 256))]
    arrivals: Vec<ArrivalsDoc>,
    /// Parked cars, beside those that `density` asks for.
    #[serde(default)]
    parked: Option<ParkedDoc>,
}

fn usual_gap() -> f64 {
    2.0
}

/// What was placed.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PlaceReply {
    /// New road users: one state at `at_s`, the same as a fixed start, goals free. Who comes in by an arm later
    /// has a track from the map's edge on, which it keeps until it reacts; who is parked has one that stands.
    pub agents: Vec<AgentDoc>,
    /// Road users asked for that found no place.
    pub unplaced: usize,
    /// Why, in one sentence; null when all were placed.
    pub reason: Option<String>,
    /// `model`, or `lane-sampler` where the weights folder has no placement weights.
    pub method: Method,
    /// Where roads come into the map or the region, with what came of the traffic asked for.
    pub arms: Vec<ArmDoc>,
    /// Places at kerbs and in lots; null without `parked`.
    pub parking_places: Option<usize>,
}

/// A lane by which an arm leads in.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ArmLaneDoc {
    /// Id of the lane.
    pub lane: String,
    /// Arc length at which it comes in, metres.
    pub s_m: f64,
}

/// Where a road comes in.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ArmDoc {
    /// The compass point that it comes from, with a number where several do: `north-east`, `west-2`.
    pub id: String,
    /// Middle of its lanes there, metres.
    pub x_m: f64,
    /// The same, metres.
    pub y_m: f64,
    /// Direction in which it leads, radians.
    pub heading_rad: f64,
    /// From right to left.
    pub lanes: Vec<ArmLaneDoc>,
    /// To its line, metres: the first junction, or where the road ends or joins another.
    pub length_m: f64,
    /// Most vehicles an hour that its lanes take.
    pub most_per_hour: f64,
    /// Vehicles of its traffic that are there at the start.
    pub placed: usize,
    /// Those that come in later.
    pub later: usize,
}

impl ArmDoc {
    fn of(traffic: &ArmTraffic, scene: &Scene) -> Self {
        let ArmTraffic { arm, length_m, most_per_hour, placed, later } = traffic;
        // The first lanes of the graph are those of the map.
        let lane = |i: usize| scene.map.lanes.get(i).map(|lane| lane.id.clone()).unwrap_or_default();
        Self {
            id: arm.id.clone(),
            x_m: arm.position.x,
            y_m: arm.position.y,
            heading_rad: arm.heading_rad,
            lanes: arm.lanes.iter().map(|l| ArmLaneDoc { lane: lane(l.lane), s_m: l.s_m }).collect(),
            length_m: *length_m,
            most_per_hour: *most_per_hour,
            placed: *placed,
            later: *later,
        }
    }
}

impl PlaceReply {
    fn of(placement: &Placement, scene: &Scene) -> Self {
        Self {
            agents: placement.agents.iter().map(AgentDoc::from_agent).collect(),
            unplaced: placement.unplaced.values().sum(),
            reason: placement.reason.clone(),
            method: placement.method,
            arms: placement.arms.iter().map(|arm| ArmDoc::of(arm, scene)).collect(),
            parking_places: placement.parking_places,
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

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK);

/// Places road users on a map: vehicles on lanes and parked at kerbs, people on crosswalks and pavements,
/// cyclists on bike lanes or on the right; traffic at a rate from the arms, and parked cars. Boxes keep 0.1 m apart
/// and all centres lie in the region. Fewer than asked is no error. Stores nothing.
#[utoipa::path(post, path = "/v1/place", operation_id = "place", tag = "generate",
    request_body(content = ref("#/components/schemas/PlaceBody"), content_type = "application/json",
        example = json!({
            "scene_id": "demo-crossing", "density": {"count": 20}, "seed": 7, "keep": [],
            "types": {"vehicle": 0.7, "pedestrian": 0.2, "cyclist": 0.1},
            "region": {"circle": {"x_m": 0.0, "y_m": 0.0, "radius_m": 60.0}},
        })),
    responses((status = 200, description = "what was placed", body = ref("#/components/schemas/PlaceReply")),
        Refused))]
pub async fn place(
    State(app): State<App>,
    connection: Connection,
    WithScene(body, Subject { scene, .. }): WithScene<PlaceBody>,
) -> Result<JsonText, Problem> {
    let placer = Arc::clone(&app.placer);
    let work =
        move |cancel: &Cancel| JsonText::of(&PlaceReply::of(&body.run(&scene, &placer, cancel)?, &scene));
    let asked = Asked { kind: Kind::Place, cost: PLACE_COST, caller: connection.into() };
    app.pool.run(asked, work).await
}

impl PlaceBody {
    /// Checks the options and places.
    ///
    /// # Errors
    /// Every fault of the options; a cancelled call.
    pub fn run(&self, scene: &Arc<Scene>, placer: &Placer, cancel: &Cancel) -> Result<Placement, Problem> {
        let request = self.request(scene)?;
        placer.place(&request, cancel).map_err(|error| match error {
            GenerateError::UnknownAgent(_) => Problem::field("/keep", Code::UnknownAgent, error.to_string()),
            GenerateError::UnknownArm { ref arm, .. } => {
                let named = |a: &&ArrivalsDoc| a.arm.chars().take(64).eq(arm.chars());
                let at = self.arrivals.iter().position(|a| named(&a)).unwrap_or(0);
                Problem::field(&format!("/arrivals/{at}/arm"), Code::InvalidField, error.to_string())
            }
            other => other.into(),
        })
    }

    fn request(&self, scene: &Arc<Scene>) -> Result<PlaceRequest, Problem> {
        let mut faults = Vec::new();
        let last_s = (scene.time.steps - 1) as f64 * STEP_S;
        let numbers = [
            ("/at_s", 0.0, last_s, self.at_s),
            ("/seed", 0.0, MAX_SAFE_INTEGER as f64, self.seed as f64),
            ("/min_gap_m", 0.0, MAX_GAP_M, self.min_gap_m),
        ];
        for (pointer, min, max, got) in numbers {
            in_range(&mut faults, pointer, (min, max), got);
        }
        let amount = match &self.density {
            Some(density) => amount(density, &mut faults),
            None if self.arrivals.is_empty() && self.parked.is_none() => {
                PlaceRequest::new(Arc::clone(scene)).amount
            }
            None => Amount::PerLaneKm(0.0),
        };
        let speeds = self.speeds.map(|doc| speeds(doc, &mut faults));
        let arrivals = arrivals(&self.arrivals, &mut faults);
        let parked = self.parked.as_ref().map(|doc| parked(doc, &mut faults));
        let types = match &self.types {
            Some(types) => shares(types, &mut faults),
            None => PlaceRequest::new(Arc::clone(scene)).types,
        };
        let region = self.region.as_ref().map_or(Region::Everywhere, |doc| region(doc, scene, &mut faults));
        for (i, id) in self.keep.iter().flatten().enumerate().filter(|(_, id)| scene.agent(id).is_none()) {
            let shown: String = id.chars().take(64).collect();
            let detail = format!("the scene has no road user \"{shown}\"");
            faults.push(FieldProblem::new(
                format!("/keep/{i}"),
                formats::problem::code::UNKNOWN_AGENT,
                detail,
            ));
        }
        if !faults.is_empty() {
            faults.truncate(32);
            return Err(ReadError::invalid(faults).into());
        }
        Ok(PlaceRequest {
            step: (self.at_s / STEP_S).round() as usize,
            region,
            amount,
            types,
            keep: self.keep.as_ref().map(|ids| ids.iter().cloned().collect::<BTreeSet<_>>()),
            seed: self.seed,
            min_gap_m: self.min_gap_m,
            speeds,
            arrivals,
            parked,
            ..PlaceRequest::new(Arc::clone(scene))
        })
    }
}

fn in_range(faults: &mut Vec<FieldProblem>, pointer: &str, (min, max): (f64, f64), got: f64) {
    // The last step's time has a rounding of its own.
    if !(got >= min && got <= max + 1e-9) {
        faults.push(FieldProblem::range(pointer, min, max, got));
    }
}

fn amount(density: &DensityDoc, faults: &mut Vec<FieldProblem>) -> Amount {
    match (density.per_lane_km, density.count) {
        (Some(per_km), None) => {
            in_range(faults, "/density/per_lane_km", (0.0, MAX_PER_LANE_KM), per_km);
            Amount::PerLaneKm(per_km)
        }
        (None, Some(count)) => {
            in_range(faults, "/density/count", (1.0, MAX_COUNT as f64), count as f64);
            Amount::Count(count as usize)
        }
        _ => {
            let detail = "exactly one of per_lane_km and count is needed";
            faults.push(FieldProblem::new("/density", "invalid-field", detail));
            Amount::Count(0)
        }
    }
}

fn speeds(doc: SpeedsDoc, faults: &mut Vec<FieldProblem>) -> SpeedRange {
    let SpeedsDoc { min_mps, max_mps } = doc;
    in_range(faults, "/speeds/min_mps", (0.0, MAX_SPEED_MPS), min_mps);
    in_range(faults, "/speeds/max_mps", (min_mps.clamp(0.0, MAX_SPEED_MPS), MAX_SPEED_MPS), max_mps);
    SpeedRange { min_mps, max_mps }
}

fn arrivals(all: &[ArrivalsDoc], faults: &mut Vec<FieldProblem>) -> Vec<Arrivals> {
    if all.len() > MAX_ARMS {
        let detail = format!("{} arms found, at most {MAX_ARMS} expected", all.len());
        faults.push(FieldProblem::new("/arrivals", "invalid-field", detail));
        return Vec::new();
    }
    let mut seen = BTreeSet::new();
    for (i, ArrivalsDoc { arm, per_hour }) in all.iter().enumerate() {
        in_range(faults, &format!("/arrivals/{i}/per_hour"), (0.0, MAX_PER_HOUR), *per_hour);
        if !seen.insert(arm) {
            let detail = "this arm is there already; one rate for each expected";
            faults.push(FieldProblem::new(format!("/arrivals/{i}/arm"), "invalid-field", detail));
        }
    }
    all.iter().map(|doc| Arrivals { arm: doc.arm.clone(), per_hour: doc.per_hour }).collect()
}

fn parked(doc: &ParkedDoc, faults: &mut Vec<FieldProblem>) -> Parked {
    match (doc.share, doc.per_100m) {
        (Some(share), None) => {
            in_range(faults, "/parked/share", (0.0, 1.0), share);
            Parked::Share(share)
        }
        (None, Some(count)) => {
            in_range(faults, "/parked/per_100m", (0.0, MAX_PARKED_PER_100M), count);
            Parked::Per100M(count)
        }
        _ => {
            let detail = "exactly one of share and per_100m is needed";
            faults.push(FieldProblem::new("/parked", "invalid-field", detail));
            Parked::Share(0.0)
        }
    }
}

fn shares(types: &Members<f64>, faults: &mut Vec<FieldProblem>) -> BTreeMap<AgentType, f64> {
    let mut shares = BTreeMap::new();
    for (name, share) in &types.0 {
        let agent_type = match name.as_str() {
            "vehicle" => AgentType::Vehicle,
            "pedestrian" => AgentType::Pedestrian,
            "cyclist" => AgentType::Cyclist,
            _ => {
                let detail = "vehicle, pedestrian and cyclist can be placed";
                let pointer = format!("/types/{}", pointer_token(name));
                faults.push(FieldProblem::new(pointer, "invalid-field", detail));
                continue;
            }
        };
        in_range(faults, &format!("/types/{name}"), (0.0, 1.0), *share);
        shares.insert(agent_type, *share);
    }
    let sum: f64 = types.0.values().sum();
    if (sum - 1.0).abs() > SHARE_TOLERANCE || sum.is_nan() {
        let detail = format!("the shares sum to {sum}; 1 expected");
        faults.push(FieldProblem::new("/types", "out-of-range", detail));
    }
    shares
}

fn region(doc: &RegionDoc, scene: &Scene, faults: &mut Vec<FieldProblem>) -> Region {
    let Some((low, high)) = map_bounds(&scene.map) else {
        faults.push(FieldProblem::new(
            "/region",
            "invalid-field",
            "the map is empty: it has no place for a region",
        ));
        return Region::Everywhere;
    };
    let (low, high) = (low - Vec2::repeat(REGION_MARGIN_M), high + Vec2::repeat(REGION_MARGIN_M));
    let before = faults.len();
    match (&doc.polygon_m, &doc.circle) {
        (Some(corners), None) => {
            if !(3..=MAX_CORNERS).contains(&corners.len()) {
                let detail = format!("{} corners found, 3 to {MAX_CORNERS} expected", corners.len());
                faults.push(FieldProblem::new("/region/polygon_m", "invalid-field", detail));
            }
            for (i, [x, y]) in corners.iter().enumerate().take(MAX_CORNERS) {
                in_range(faults, &format!("/region/polygon_m/{i}/0"), (low.x, high.x), *x);
                in_range(faults, &format!("/region/polygon_m/{i}/1"), (low.y, high.y), *y);
            }
            let ring: Vec<Vec2> = corners.iter().map(|[x, y]| Vec2::new(*x, *y)).collect();
            if faults.len() == before && ring_area_m2(&ring) < 0.1 {
                let detail = "a ring that encloses some area expected";
                faults.push(FieldProblem::new("/region/polygon_m", "invalid-field", detail));
            }
            Region::Polygon(ring)
        }
        (None, Some(circle)) => {
            in_range(faults, "/region/circle/x_m", (low.x, high.x), circle.x_m);
            in_range(faults, "/region/circle/y_m", (low.y, high.y), circle.y_m);
            in_range(
                faults,
                "/region/circle/radius_m",
                (0.5, 2.0 * scene::MAX_COORDINATE_M),
                circle.radius_m,
            );
            Region::Circle { center: Vec2::new(circle.x_m, circle.y_m), radius_m: circle.radius_m }
        }
        _ => {
            let detail = "exactly one of polygon_m and circle is needed";
            faults.push(FieldProblem::new("/region", "invalid-field", detail));
            Region::Everywhere
        }
    }
}
