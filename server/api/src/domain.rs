//! Facts about road users and requests that clients need too, from the tables of the crates below: what
//! each kind can do, what conditions may ask for, and what a request has when it does not say.

use experts::request::{DEFAULTS, Defaults};
use formats::native::Ranges;
use scene::limits::Limits;
use scene::score::{Threshold, Thresholds};
use scene::via::VIA_WITHIN_S;
use scene::{AgentType, DEFAULT_VIA_TOLERANCE_M, MAX_VIAS, Size, Subtype, VIA_TOLERANCE_M};
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
    /// Sideways acceleration that drivers choose in bends: comfort, not a bound.
    comfort_lateral_mps2: f64,
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
            comfort_lateral_mps2: limits.comfort_lateral_mps2,
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
    limits: KindLimits,
    condition_ranges: ConditionRanges,
    via: ViaRanges,
    defaults: Defaults,
    /// What counts as an event, by name.
    thresholds: BTreeMap<&'static str, ThresholdRange>,
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
            limits,
            condition_ranges,
            via,
            defaults: DEFAULTS,
            thresholds: Thresholds::ALL.map(range).into(),
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
