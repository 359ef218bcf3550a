//! Facts about road users and requests that clients need too, from the tables of the crates below: what
//! each kind can do, what conditions may ask for, and what a request has when it does not say.

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

/// What one kind of road user can do; answers never go beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MotionLimits {
    /// Greatest speeding up.
    accel_mps2: f64,
    /// Greatest braking, positive.
    brake_mps2: f64,
    /// Greatest sideways acceleration.
    lateral_mps2: f64,
    /// Greatest curvature; null on foot, where turning has no bound. Vehicles longer than the kind's
    /// usual ones turn wider.
    curvature_per_m: Option<f64>,
    /// Top speed.
    speed_mps: f64,
    /// What a future does where there is time.
    comfortable: DrivingManner,
    /// What a future does where time presses. It does more only where a goal or another road user forces it.
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

/// Motion limits by kind of road user, each of the kind's usual size.
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
    /// The limits that projection, scoring and tests read.
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

/// What conditions may ask for, by type; both ends are allowed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct ConditionRanges {
    pub vehicle: Ranges,
    pub pedestrian: Ranges,
    pub cyclist: Ranges,
}

impl ConditionRanges {
    /// The ranges that conditions are read against.
    pub fn current() -> Self {
        Self {
            vehicle: Ranges::of(AgentType::Vehicle),
            pedestrian: Ranges::of(AgentType::Pedestrian),
            cyclist: Ranges::of(AgentType::Cyclist),
        }
    }
}

/// What via points may ask for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ViaRanges {
    /// Of one road user.
    most: usize,
    /// Both ends are allowed.
    tolerance_m: (f64, f64),
    default_tolerance_m: f64,
    /// So far from its time one may be passed.
    within_s: f64,
}

/// What goals relative to another road user may ask for; both ends are allowed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RelationRanges {
    gap_m: (f64, f64),
    gap_s: (f64, f64),
    after_s: (f64, f64),
    slower_mps: (f64, f64),
    lanes_left: (f64, f64),
    /// Goals in a row that are relative to each other.
    most_in_a_row: usize,
}

/// Fixed numbers by which events and verdicts are worked out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Judging {
    /// Two events of the same kind and road users within this time are one, seconds.
    same_event_s: f64,
    /// A near miss that is closer by more than this is another one, metres.
    same_gap_m: f64,
    /// Shorter braking and steering is no fault, seconds.
    harsh_s: f64,
    /// Steps before and after a moment between which braking and steering are measured.
    harsh_steps: usize,
    /// Slower than this is standing, m/s.
    standing_mps: f64,
    /// No collision is looked for later, seconds.
    look_ahead_s: f64,
    /// A road user that travels less has no post-encroachment time, metres.
    pet_travel_m: f64,
    /// Paths that meet at less than this angle do not cross, radians.
    pet_angle_rad: f64,
    /// A motion of less is a stay, metres.
    stays_m: f64,
    /// Turning by more is a turn, radians.
    turn_rad: f64,
    /// Turning by more is turning round, radians.
    turn_round_rad: f64,
    /// A lane is driven on within this of its middle, metres.
    on_lane_m: f64,
    /// A lane whose direction differs by more is not driven on, radians.
    along_lane_rad: f64,
    /// Motions whose headings differ by less go the same way, radians.
    same_way_rad: f64,
    /// Standing longer by less is no wait, seconds.
    waits_s: f64,
    /// Two cards of a round are somewhere at least so far apart, metres.
    card_apart_m: f64,
}

/// Fixed numbers of planning by which a client can show places and ways before an answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PlanningNumbers {
    /// Front bumper to stop line, metres.
    stop_line_gap_m: f64,
    /// A stop line belongs to a path that passes it nearer than this, metres.
    stop_line_beside_m: f64,
    /// And whose direction differs from that of the line's lane by less, radians.
    stop_line_turned_rad: f64,
    /// Front bumper to a standing road user ahead, metres.
    queue_gap_m: f64,
    /// A standing road user nearer to a path than this is in the queue on it, metres.
    in_queue_m: f64,
    /// A road user whose centre is farther from a path is not in its way, metres.
    in_the_way_m: f64,
    /// A route starts on a lane at most so far from the road user, metres.
    start_lane_m: f64,
    /// And whose direction differs by at most this, radians.
    start_turn_rad: f64,
    /// Most lanes from which routes start.
    most_starts: usize,
    /// A goal lies on a lane at most so far away, metres.
    goal_lane_m: f64,
    /// Most lanes on which a goal lies.
    most_goal_lanes: usize,
    /// Longer routes are detours: times the straight way, and metres more.
    longest_route: (f64, f64),
    /// Speed cap of walkers, m/s.
    walking_mps: f64,
}

impl PlanningNumbers {
    /// The numbers that routes and futures are planned by.
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
    /// The numbers that scores and verdicts read.
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

/// A number that decides what counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ThresholdRange {
    /// Unless another one is given.
    usual: f64,
    /// Least and most.
    range: [f64; 2],
}

/// All of them, as `assets/domain.json` has them.
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
    /// What counts as an event, by name.
    thresholds: BTreeMap<&'static str, ThresholdRange>,
    judging: Judging,
    planning: PlanningNumbers,
    /// By kind of layout and parameter.
    layout_ranges: BTreeMap<&'static str, BTreeMap<String, [f64; 2]>>,
}

impl Domain {
    /// Those of this build.
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

/// Pretty text with a last newline, as it is committed.
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
