//! The one table of what each kind of road user can do. Projection, scoring and tests read it.

use crate::{AgentType, Subtype};
use serde::Serialize;

/// Bounds of motion of one kind of road user. Hard limits are never broken by an answer; the
/// comfortable ones are what scoring calls normal.
///
/// Hard limits follow the 99 % tails measured on recorded tracks, and the bounds that Waymax takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Greatest speeding up, m/s2.
    pub accel_mps2: f64,
    /// Greatest braking, m/s2, positive.
    pub brake_mps2: f64,
    /// Greatest sideways acceleration v^2 k, m/s2.
    pub lateral_mps2: f64,
    /// Greatest curvature, 1/m (wheels; not used on foot).
    pub curvature_per_m: f64,
    /// Top speed, m/s.
    pub speed_mps: f64,
    /// Sideways acceleration that drivers choose in bends, m/s2.
    pub comfort_lateral_mps2: f64,
    /// Reference point behind the box centre, in lengths.
    pub reference_offset: f64,
}

const CAR: Limits = Limits {
    accel_mps2: 4.0,
    brake_mps2: 8.0,
    lateral_mps2: 6.0,
    curvature_per_m: 0.25,
    speed_mps: 40.0,
    comfort_lateral_mps2: 2.2,
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
                comfort_lateral_mps2: 1.0,
                reference_offset: 0.0,
            },
            (AgentType::Cyclist, _) => Self {
                accel_mps2: 3.5,
                brake_mps2: 4.0,
                lateral_mps2: 4.0,
                curvature_per_m: 0.7,
                speed_mps: 14.0,
                comfort_lateral_mps2: 1.8,
                reference_offset: 0.2,
            },
            (_, Subtype::Motorcycle) => Self { curvature_per_m: 0.4, accel_mps2: 5.0, ..CAR },
            (_, Subtype::Truck | Subtype::Bus | Subtype::Trailer) => {
                Self { accel_mps2: 3.0, brake_mps2: 7.0, speed_mps: 32.0, ..CAR.long(length_m) }
            }
            _ => CAR.long(length_m),
        }
    }

    /// Long vehicles turn wider: the tightest circle grows with the wheelbase beyond a car's.
    fn long(self, length_m: f64) -> Self {
        let curvature_per_m = self.curvature_per_m.min(self.curvature_per_m * 6.5 / length_m.max(1.0));
        Self { curvature_per_m, ..self }
    }
}
