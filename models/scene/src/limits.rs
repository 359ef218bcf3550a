//! The two tables of motion limits per kind of road user: what is physically possible, and what drivers do.
//! Planning, projection, scoring and tests read them.

use crate::{AgentType, Subtype};
use schemars::JsonSchema;
use serde::Serialize;

/// Acceleration limits of a driving style.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DrivingManner {
    /// Greatest acceleration.
    pub accel_mps2: f64,
    /// Greatest braking, positive.
    pub brake_mps2: f64,
    /// Greatest sideways acceleration v^2 k.
    pub lateral_mps2: f64,
}

impl DrivingManner {
    /// Interpolates between this manner (0) and another (1).
    pub fn towards(self, other: Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + share * (b - a);
        Self {
            accel_mps2: mix(self.accel_mps2, other.accel_mps2),
            brake_mps2: mix(self.brake_mps2, other.brake_mps2),
            lateral_mps2: mix(self.lateral_mps2, other.lateral_mps2),
        }
    }
}

/// Motion limits of one kind of road user. An answer never exceeds the physical ones. It leaves the hurried
/// manner only if a goal or another road user forces it, and uses the comfortable one if there is time.
///
/// The physical limits follow the 99 % tails measured on recorded tracks, and the bounds of Waymax.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Greatest acceleration, m/s2.
    pub accel_mps2: f64,
    /// Greatest braking, m/s2, positive.
    pub brake_mps2: f64,
    /// Greatest sideways acceleration v^2 k, m/s2.
    pub lateral_mps2: f64,
    /// Greatest curvature, 1/m (wheels; not used on foot).
    pub curvature_per_m: f64,
    /// Top speed, m/s.
    pub speed_mps: f64,
    /// Manner if there is time.
    pub comfortable: DrivingManner,
    /// Manner under time pressure: 99 % of recorded vehicles stay below 3.2 m/s2 sideways.
    pub hurried: DrivingManner,
    /// Distance of the reference point behind the box centre, as a share of the length.
    pub reference_offset: f64,
}

const CAR: Limits = Limits {
    accel_mps2: 4.0,
    brake_mps2: 8.0,
    lateral_mps2: 6.0,
    curvature_per_m: 0.25,
    speed_mps: 40.0,
    comfortable: DrivingManner { accel_mps2: 1.5, brake_mps2: 2.0, lateral_mps2: 2.2 },
    hurried: DrivingManner { accel_mps2: 3.0, brake_mps2: 3.8, lateral_mps2: 3.5 },
    reference_offset: 0.3,
};

impl Limits {
    /// Limits of a kind of road user of this length.
    pub fn of(agent_type: AgentType, subtype: Subtype, length_m: f64) -> Self {
        match (agent_type, subtype) {
            (AgentType::Pedestrian, _) => Self {
                accel_mps2: 2.0,
                brake_mps2: 2.0,
                lateral_mps2: 2.0,
                curvature_per_m: f64::INFINITY,
                speed_mps: 6.0,
                comfortable: DrivingManner { accel_mps2: 1.0, brake_mps2: 1.0, lateral_mps2: 1.0 },
                hurried: DrivingManner { accel_mps2: 2.0, brake_mps2: 2.0, lateral_mps2: 2.0 },
                reference_offset: 0.0,
            },
            (AgentType::Cyclist, _) => Self {
                accel_mps2: 3.5,
                brake_mps2: 4.0,
                lateral_mps2: 4.0,
                curvature_per_m: 0.7,
                speed_mps: 14.0,
                comfortable: DrivingManner { accel_mps2: 1.0, brake_mps2: 1.5, lateral_mps2: 1.8 },
                hurried: DrivingManner { accel_mps2: 2.0, brake_mps2: 3.0, lateral_mps2: 2.8 },
                reference_offset: 0.2,
            },
            (_, Subtype::Motorcycle) => Self { curvature_per_m: 0.4, accel_mps2: 5.0, ..CAR },
            (_, Subtype::Truck | Subtype::Bus | Subtype::Trailer) => Self {
                accel_mps2: 3.0,
                brake_mps2: 7.0,
                speed_mps: 32.0,
                comfortable: DrivingManner { accel_mps2: 1.0, ..CAR.comfortable },
                hurried: DrivingManner { accel_mps2: 2.0, ..CAR.hurried },
                ..CAR.long(length_m)
            },
            _ => CAR.long(length_m),
        }
    }

    /// The same limits, lowered to those of a manner.
    pub fn within(self, manner: DrivingManner) -> Self {
        Self {
            accel_mps2: self.accel_mps2.min(manner.accel_mps2),
            brake_mps2: self.brake_mps2.min(manner.brake_mps2),
            lateral_mps2: self.lateral_mps2.min(manner.lateral_mps2),
            ..self
        }
    }

    /// Long vehicles turn wider: the tightest circle grows with the wheelbase beyond a car's.
    fn long(self, length_m: f64) -> Self {
        let curvature_per_m = self.curvature_per_m.min(self.curvature_per_m * 6.5 / length_m.max(1.0));
        Self { curvature_per_m, ..self }
    }
}
