//! Facts that clients need too, from the tables of the lower crates: motion limits by kind of road user,
//! ranges of conditions, and defaults of requests.

use experts::generator::WAITS_STEPS;
use experts::request::{DEFAULTS, Defaults};
use experts::tuning::published::{
    IN_QUEUE_M, QUEUE_GAP_M, STOP_LINE_BESIDE_M, STOP_LINE_GAP_M, STOP_LINE_TURNED_RAD, WALKING_MPS,
};
use formats::native::Ranges;
use scene::geometry::ttc::LOOK_AHEAD_S;
use scene::judge::manoeuvre::{ALONG_LANE_RAD, ON_LANE_M, ROUND_RAD, STAYS_M, TURN_RAD};
use scene::judge::{HARSH_S, SAME_WAY_RAD};
use scene::limits::{DrivingManner, Limits};
use scene::preference::LEAST_APART_M;
use scene::routes::speed::IN_THE_WAY_M;
use scene::routes::start::{MAX_STARTS, ON_LANE_TURN_RAD, RELAXED_M};
use scene::routes::to_goal::{self, LONGEST_ROUTE, MAX_GOAL_LANES};
use scene::score::kinematic::HARSH_STEPS;
use scene::score::pairs::{SAME_GAP_M, SAME_S};
use scene::score::pet::{LEAST_ANGLE_RAD, LEAST_TRAVEL_M};
use scene::score::{Threshold, Thresholds};
use scene::via::VIA_WITHIN_S;
use scene::{
    AgentType, DEFAULT_VIA_TOLERANCE_M, MAX_AGENTS, MAX_VIAS, STANDING_MPS, STEP_S, Size, Subtype,
    VIA_TOLERANCE_M, relation,
};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Motion limits of one kind of road user; answers never exceed them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MotionLimits {
    /// Greatest acceleration.
    accel_mps2: f64,
    /// Greatest braking, positive.
    brake_mps2: f64,
    /// Greatest sideways acceleration.
    lateral_mps2: f64,
    /// Greatest curvature; null for pedestrians, who turn without a bound. Vehicles longer than usual for the
    /// kind turn wider.
    curvature_per_m: Option<f64>,
    /// Top speed.
    speed_mps: f64,
    /// Limits of a future without time pressure.
    comfortable: DrivingManner,
    /// Limits of a future under time pressure. It exceeds them only if a goal or another road user requires
    /// it.
    hurried: DrivingManner,
}

impl MotionLimits {
    fn of(agent_type: AgentType, subtype: Subtype) -> Self {
        let length_m = Size::default_for(agent_type, subtype).length_m;
        let limits = Limits::of(agent_type, subtype, length_m);
        Self {
            accel_mps2: limits.accel_mps2,
            brake_mps2: limits.brake_mps2,
            lateral_mps2: limits.lateral_mps2,
            curvature_per_m: Some(limits.curvature_per_m).filter(|c| c.is_finite()),
            speed_mps: limits.speed_mps,
            comfortable: limits.comfortable,
            hurried: limits.hurried,
        }
    }
}

/// Motion limits by kind of road user, for the usual size of each kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct KindLimits {
    pub car: MotionLimits,
    pub truck: MotionLimits,
    pub bus: MotionLimits,
    pub trailer: MotionLimits,
    pub motorcycle: MotionLimits,
    pub cyclist: MotionLimits,
    pub pedestrian: MotionLimits,
    pub other: MotionLimits,
}

impl KindLimits {
    /// The limits that projection, scoring and tests use.
    pub fn current() -> Self {
        let vehicle = |subtype| MotionLimits::of(AgentType::Vehicle, subtype);
        Self {
            car: vehicle(Subtype::Car),
            truck: vehicle(Subtype::Truck),
            bus: vehicle(Subtype::Bus),
            trailer: vehicle(Subtype::Trailer),
            motorcycle: vehicle(Subtype::Motorcycle),
            cyclist: MotionLimits::of(AgentType::Cyclist, Subtype::Bicycle),
            pedestrian: MotionLimits::of(AgentType::Pedestrian, Subtype::Adult),
            other: MotionLimits::of(AgentType::Other, Subtype::Unknown),
        }
    }
}

/// Ranges of conditions by type; both ends are included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct ConditionRanges {
    pub vehicle: Ranges,
    pub pedestrian: Ranges,
    pub cyclist: Ranges,
}

impl ConditionRanges {
    /// The ranges against which conditions are checked.
    pub fn current() -> Self {
        Self {
            vehicle: Ranges::of(AgentType::Vehicle),
            pedestrian: Ranges::of(AgentType::Pedestrian),
            cyclist: Ranges::of(AgentType::Cyclist),
        }
    }
}

/// Ranges of via points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ViaRanges {
    /// Most via points of one road user.
    most: usize,
    /// Range of the tolerance, both ends included.
    tolerance_m: (f64, f64),
    default_tolerance_m: f64,
    /// Greatest deviation from a via point's time.
    within_s: f64,
}

/// Ranges of goals relative to another road user, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RelationRanges {
    gap_m: (f64, f64),
    gap_s: (f64, f64),
    after_s: (f64, f64),
    slower_mps: (f64, f64),
    lanes_left: (f64, f64),
    /// Longest chain of goals that are relative to each other.
    most_in_a_row: usize,
}

/// Constants of events and verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Judging {
    /// Two events of the same kind and road users within this time are one event, seconds.
    same_event_s: f64,
    /// A near miss that is closer by more than this is a separate one, metres.
    same_gap_m: f64,
    /// Shortest duration of harsh braking or steering that is a fault, seconds.
    harsh_s: f64,
    /// Steps before and after a moment between which braking and steering are measured.
    harsh_steps: usize,
    /// Speed below which a road user stands, m/s.
    standing_mps: f64,
    /// Largest time to collision that is searched, seconds.
    look_ahead_s: f64,
    /// Shortest distance travelled of a road user with a post-encroachment time, metres.
    pet_travel_m: f64,
    /// Smallest angle at which paths cross, radians.
    pet_angle_rad: f64,
    /// Motion below which a road user stays, metres.
    stays_m: f64,
    /// Change of heading above which a motion is a turn, radians.
    turn_rad: f64,
    /// Change of heading above which a motion is a U-turn, radians.
    turn_round_rad: f64,
    /// Greatest distance from the middle of the lane that is driven, metres.
    on_lane_m: f64,
    /// Greatest heading difference to the lane that is driven, radians.
    along_lane_rad: f64,
    /// Greatest heading difference of motions in the same direction, radians.
    same_way_rad: f64,
    /// Shortest additional standing time that counts as waiting, seconds.
    waits_s: f64,
    /// At some place, two cards of a round are at least this far apart, metres.
    card_apart_m: f64,
}

/// Constants of planning with which a client can show places and paths before an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlanningNumbers {
    /// Front bumper to stop line, metres.
    stop_line_gap_m: f64,
    /// A stop line belongs to a path that passes it within this distance, metres.
    stop_line_beside_m: f64,
    /// The path's heading then differs from that of the line's lane by less than this, radians.
    stop_line_turned_rad: f64,
    /// Front bumper to a standing road user ahead, metres.
    queue_gap_m: f64,
    /// A standing road user within this distance of a path is in the queue on it, metres.
    in_queue_m: f64,
    /// A road user whose centre is farther than this from a path is not on it, metres.
    in_the_way_m: f64,
    /// Greatest distance between a road user and the lane on which a route starts, metres.
    start_lane_m: f64,
    /// Greatest heading difference to that lane, radians.
    start_turn_rad: f64,
    /// Most lanes from which routes start.
    most_starts: usize,
    /// Greatest distance between a goal and a lane that it lies on, metres.
    goal_lane_m: f64,
    /// Most lanes that a goal lies on.
    most_goal_lanes: usize,
    /// Routes longer than this are detours: factor of the straight distance, and metres in addition.
    longest_route: (f64, f64),
    /// Highest walking speed, m/s.
    walking_mps: f64,
}

impl PlanningNumbers {
    /// The constants by which routes and futures are planned.
    pub fn current() -> Self {
        Self {
            stop_line_gap_m: STOP_LINE_GAP_M,
            stop_line_beside_m: STOP_LINE_BESIDE_M,
            stop_line_turned_rad: STOP_LINE_TURNED_RAD,
            queue_gap_m: QUEUE_GAP_M,
            in_queue_m: IN_QUEUE_M,
            in_the_way_m: IN_THE_WAY_M,
            start_lane_m: RELAXED_M,
            start_turn_rad: ON_LANE_TURN_RAD,
            most_starts: MAX_STARTS,
            goal_lane_m: to_goal::ON_LANE_M,
            most_goal_lanes: MAX_GOAL_LANES,
            longest_route: LONGEST_ROUTE,
            walking_mps: WALKING_MPS,
        }
    }
}

impl Judging {
    /// The constants of scores and verdicts.
    pub fn current() -> Self {
        Self {
            same_event_s: SAME_S,
            same_gap_m: SAME_GAP_M,
            harsh_s: HARSH_S,
            harsh_steps: HARSH_STEPS,
            standing_mps: STANDING_MPS,
            look_ahead_s: LOOK_AHEAD_S,
            pet_travel_m: LEAST_TRAVEL_M,
            pet_angle_rad: LEAST_ANGLE_RAD,
            stays_m: STAYS_M,
            turn_rad: TURN_RAD,
            turn_round_rad: ROUND_RAD,
            on_lane_m: ON_LANE_M,
            along_lane_rad: ALONG_LANE_RAD,
            same_way_rad: SAME_WAY_RAD,
            waits_s: WAITS_STEPS as f64 * STEP_S,
            card_apart_m: LEAST_APART_M,
        }
    }
}

/// A threshold of an event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ThresholdRange {
    /// Default value.
    usual: f64,
    /// Lowest and highest value.
    range: [f64; 2],
}

/// All facts, in the form of `assets/domain.json`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Domain {
    /// Version of the program.
    version: &'static str,
    /// Most agents of a scene.
    most_agents: usize,
    limits: KindLimits,
    condition_ranges: ConditionRanges,
    via: ViaRanges,
    relation: RelationRanges,
    defaults: Defaults,
    /// Thresholds of events, by name.
    thresholds: BTreeMap<&'static str, ThresholdRange>,
    judging: Judging,
    planning: PlanningNumbers,
    /// Ranges of parameters, by kind of layout.
    layout_ranges: BTreeMap<&'static str, BTreeMap<String, [f64; 2]>>,
}

impl Domain {
    /// The facts of this build.
    pub fn current() -> Self {
        let (limits, condition_ranges) = (KindLimits::current(), ConditionRanges::current());
        let via = ViaRanges {
            most: MAX_VIAS,
            tolerance_m: VIA_TOLERANCE_M,
            default_tolerance_m: DEFAULT_VIA_TOLERANCE_M,
            within_s: VIA_WITHIN_S,
        };
        let relation = RelationRanges {
            gap_m: relation::GAP_M,
            gap_s: relation::GAP_S,
            after_s: relation::AFTER_S,
            slower_mps: relation::SLOWER_MPS,
            lanes_left: relation::LANES_LEFT,
            most_in_a_row: relation::MAX_RELATED_IN_A_ROW,
        };
        let range = |t: Threshold| (t.name, ThresholdRange { usual: t.usual(), range: t.range.into() });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            most_agents: MAX_AGENTS,
            limits,
            condition_ranges,
            via,
            relation,
            defaults: DEFAULTS,
            thresholds: Thresholds::ALL.map(range).into(),
            judging: Judging::current(),
            planning: PlanningNumbers::current(),
            layout_ranges: layouts::ranges(),
        }
    }
}

/// Pretty-printed JSON with a final newline, as it is committed.
pub fn text() -> String {
    let mut text = serde_json::to_string_pretty(&Domain::current()).unwrap_or_default();
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    #[test]
    fn it_says_what_the_tables_say() {
        let domain: Value = serde_json::from_str(&super::text()).unwrap();
        assert_eq!(domain["limits"]["car"]["accel_mps2"], 4.0);
        assert_eq!(domain["limits"]["car"]["curvature_per_m"], 0.25);
        assert_eq!(domain["limits"]["pedestrian"]["curvature_per_m"], Value::Null);
        assert_eq!(domain["condition_ranges"]["vehicle"]["length_m"], serde_json::json!([1.5, 25.0]));
        assert_eq!(domain["defaults"]["steps"], 5);
        assert_eq!(domain["defaults"]["horizon_s"], 9.0);
    }
}
