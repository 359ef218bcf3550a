//! Facts about road users and requests that clients need too, from the tables of the crates below: what
//! each kind can do, what conditions may ask for, and what a request has when it does not say.

use experts::request::{DEFAULTS, Defaults};
use formats::native::Ranges;
use scene::geometry::ttc::LOOK_AHEAD_S;
use scene::judge::HARSH_S;
use scene::limits::{DrivingManner, Limits};
use scene::score::kinematic::HARSH_STEPS;
use scene::score::pairs::{SAME_GAP_M, SAME_S};
use scene::score::pet::{LEAST_ANGLE_RAD, LEAST_TRAVEL_M};
use scene::score::{Threshold, Thresholds};
use scene::via::VIA_WITHIN_S;
use scene::{
    AgentType, DEFAULT_VIA_TOLERANCE_M, MAX_AGENTS, MAX_VIAS, STANDING_MPS, Size, Subtype, VIA_TOLERANCE_M,
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
    defaults: Defaults,
    /// What counts as an event, by name.
    thresholds: BTreeMap<&'static str, ThresholdRange>,
    judging: Judging,
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
        let range = |t: Threshold| (t.name, ThresholdRange { usual: t.usual(), range: t.range.into() });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            most_agents: MAX_AGENTS,
            limits,
            condition_ranges,
            via,
            defaults: DEFAULTS,
            thresholds: Thresholds::ALL.map(range).into(),
            judging: Judging::current(),
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
