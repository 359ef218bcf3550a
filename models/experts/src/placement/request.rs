//! Request and result of placement.

use super::arms::Arm;
use super::driving::SpeedRange;
use super::region::Region;
use crate::tuning::placing::request::{PER_LANE_KM, TYPES};
use scene::{Agent, AgentId, AgentType, MAX_AGENTS, Scene};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::Arc;

/// Most road users in a request by count.
pub const MAX_COUNT: usize = MAX_AGENTS;
/// Highest density, road users per kilometre of lane.
pub const MAX_PER_LANE_KM: f64 = 200.0;
/// Largest gap along the lane that a request may set, metres.
pub const MAX_GAP_M: f64 = 50.0;

/// Highest flow of one arm, vehicles per hour.
pub const MAX_PER_HOUR: f64 = 20_000.0;
/// Most parked cars per 100 m of kerb.
pub const MAX_PARKED_PER_100M: f64 = 20.0;
/// Highest starting speed in a request, m/s: the top speed of cars.
pub const MAX_SPEED_MPS: f64 = 40.0;

/// Flow of vehicles that enter by an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrivals {
    /// [`Arm::id`].
    pub arm: String,
    /// Motor vehicles per hour, all lanes together.
    pub per_hour: f64,
}

/// Number of parked cars, relative to the room at kerbs and in lots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parked {
    /// Share of the places that are occupied, 0 to 1.
    Share(f64),
    /// Cars per 100 m of kerb with room; lots get the same share of their bays.
    Per100M(f64),
}

/// The vehicles made for an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct ArmTraffic {
    /// The arm.
    pub arm: Arm,
    /// Length of its path from the entry to the end line: the first junction, or where the road ends or joins
    /// another, metres.
    pub length_m: f64,
    /// Capacity of its lanes, vehicles per hour.
    pub most_per_hour: f64,
    /// Vehicles of its traffic that are present at the start.
    pub placed: usize,
    /// Vehicles that enter later.
    pub later: usize,
}

/// Number of road users.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// Per kilometre of lane for motor vehicles in the region, without junctions.
    PerLaneKm(f64),
    /// Total number.
    Count(usize),
    /// Number of each type, regardless of [`PlaceRequest::types`].
    Each(BTreeMap<AgentType, usize>),
}

/// Method of placement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PlacementMethod {
    /// Learned rates and distributions.
    Model,
    /// Evenly along lanes, at the speed limit: without weights, and as a baseline.
    LaneSampler,
}

/// One call of placement.
#[derive(Clone, Debug)]
pub struct PlaceRequest {
    /// Map, signals, and road users that may be kept.
    pub scene: Arc<Scene>,
    /// Scene step at which the placed road users start; signals and kept road users are taken from it.
    pub step: usize,
    /// Region of the centres.
    pub region: Region,
    /// Number of road users.
    pub amount: Amount,
    /// Share of each type; sums to one.
    pub types: BTreeMap<AgentType, f64>,
    /// Road users of the scene that stay; `None` keeps all. The others are ignored.
    pub keep: Option<BTreeSet<AgentId>>,
    /// Equal seeds give equal answers.
    pub seed: u64,
    /// Smallest gap along the lane between agents that drive, metres.
    pub min_gap_m: f64,
    /// Bounds of the speeds of moving motor vehicles; `None` keeps the usual speeds of these roads.
    pub speeds: Option<SpeedRange>,
    /// Traffic by arm. Only these arms supply the drivers on their lanes.
    pub arrivals: Vec<Arrivals>,
    /// Parked cars, in addition to those of [`PlaceRequest::amount`].
    pub parked: Option<Parked>,
}

impl PlaceRequest {
    /// The defaults of `POST /v1/place` for a scene.
    pub fn new(scene: Arc<Scene>) -> Self {
        Self {
            scene,
            step: 0,
            region: Region::Everywhere,
            amount: Amount::PerLaneKm(PER_LANE_KM),
            types: BTreeMap::from(TYPES),
            keep: None,
            seed: 0,
            min_gap_m: 2.0,
            speeds: None,
            arrivals: Vec::new(),
            parked: None,
        }
    }
}

/// The answer of a placement.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// New road users with one state at the step and the same start as a condition; goals are free. A later
    /// arrival has a motion from the map's edge on, a parked vehicle stands throughout; neither has a
    /// condition.
    pub agents: Vec<Agent>,
    /// Requested road users without a place, by type.
    pub unplaced: BTreeMap<AgentType, usize>,
    /// Why some found no place, in one sentence; `None` if all were placed.
    pub reason: Option<String>,
    /// The method that was used.
    pub method: PlacementMethod,
    /// All arms of the map or region, with the vehicles made for them.
    pub arms: Vec<ArmTraffic>,
    /// Number of parking places; `None` if the request has no parked cars.
    pub parking_places: Option<usize>,
}

impl PlaceRequest {
    /// Ids that are not used in the scene.
    pub(super) fn free_ids(&self) -> impl Iterator<Item = AgentId> {
        let taken: HashSet<&str> = self.scene.agents.iter().map(|a| a.id.as_str()).collect();
        (1..).map(|n: usize| format!("p{n}")).filter(move |id| !taken.contains(id.as_str()))
    }

    /// Number of each type, by largest remainder; vehicles first.
    pub(super) fn wanted(&self, lane_km: f64) -> BTreeMap<AgentType, usize> {
        let total = match &self.amount {
            Amount::Each(each) => return each.clone(),
            Amount::Count(n) => *n,
            Amount::PerLaneKm(density) => (density * lane_km).round().min(1e6) as usize,
        };
        let exact = |share: f64| share * total as f64;
        let mut counts: BTreeMap<AgentType, usize> =
            self.types.iter().map(|(t, share)| (*t, (exact(*share) + 1e-9) as usize)).collect();
        let mut rest: Vec<(f64, AgentType)> = self
            .types
            .iter()
            .map(|(t, share)| (exact(*share) - (exact(*share) + 1e-9).floor(), *t))
            .collect();
        rest.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let missing = total.saturating_sub(counts.values().sum());
        for (_, agent_type) in rest.into_iter().take(missing) {
            *counts.entry(agent_type).or_default() += 1;
        }
        counts
    }
}

/// Why some found no place, in one sentence; `full` if the scene can hold no more.
pub(super) fn reason(unplaced: &BTreeMap<AgentType, usize>, full: bool) -> Option<String> {
    if unplaced.is_empty() {
        return None;
    }
    let who: Vec<String> = unplaced.iter().map(|(t, n)| counted(*n, *t)).collect();
    let why = if full {
        format!("a scene holds {MAX_AGENTS} road users")
    } else {
        "no free place found".to_owned()
    };
    Some(format!("{why} for {}", who.join(", ")))
}

/// A count with its noun: `3 vehicles`.
pub(super) fn counted(n: usize, agent_type: AgentType) -> String {
    let one = match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "road user",
    };
    format!("{n} {one}{}", if n == 1 { "" } else { "s" })
}
