//! The reply of a placement, as JSON.

use experts::placement::{ArmTraffic, Placement, PlacementMethod};
use formats::native::AgentDoc;
use scene::Scene;
use schemars::JsonSchema;
use serde::Serialize;

/// Result of a placement.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PlaceReply {
    /// New road users: one state at `start_s`, the same as a fixed start, goals free. One that enters by an arm
    /// later has a track from the map's edge on, which it keeps until it reacts; a parked one has a standing track.
    pub agents: Vec<AgentDoc>,
    /// Number of requested road users without a place.
    pub unplaced: usize,
    /// Reason for `unplaced`, in one sentence; null if all were placed.
    pub reason: Option<String>,
    /// `model`, or `lane-sampler` if the weights folder has no placement weights.
    pub method: PlacementMethod,
    /// Arms: where roads enter the map or the region, with the traffic placed on each.
    pub arms: Vec<ArmDoc>,
    /// Parking places at kerbs and in car parks; null without `parked`.
    pub parking_places: Option<usize>,
}

/// A lane by which an arm enters the map or the region.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ArmLaneDoc {
    /// Id of the lane.
    pub lane: String,
    /// Arc length of the entry, metres.
    pub s_m: f64,
}

/// An arm: a road that enters the map or the region.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct ArmDoc {
    /// Compass direction that it comes from, with a number if several arms share it: `north-east`, `west-2`.
    pub id: String,
    /// Middle of its lanes at the entry, metres.
    pub x_m: f64,
    /// Middle of its lanes at the entry, metres.
    pub y_m: f64,
    /// Driving direction at the entry, radians.
    pub heading_rad: f64,
    /// Its lanes, from right to left.
    pub lanes: Vec<ArmLaneDoc>,
    /// Length from the entry to the end line, metres: the first junction, or where the road ends or joins
    /// another.
    pub length_m: f64,
    /// Capacity of its lanes, vehicles per hour.
    pub most_per_hour: f64,
    /// Vehicles of its traffic that are present at the start.
    pub placed: usize,
    /// Vehicles that enter later.
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
    /// The reply of a placement in this scene.
    pub fn of(placement: &Placement, scene: &Scene) -> Self {
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
