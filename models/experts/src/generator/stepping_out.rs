//! Pedestrians that step out in front of a fast vehicle.

use crate::tuning::fixed::stepping_out::{AFTER_S, FAST_MPS, HARD_MPS2};
use scene::AgentType;
use scene::judge::{Trace, crossing};

/// Time at which a vehicle has passed, seconds, if the walker would meet it or make it brake hard. `None` if
/// the walker crosses before the vehicle arrives, lets it pass, or leaves it room to stop.
pub(super) fn steps_out(walker: &Trace, other: &Trace) -> Option<f64> {
    if other.agent_type() != AgentType::Vehicle {
        return None;
    }
    let ground = crossing(walker, other)?;
    let ((enters, leaves), (comes, passes)) = (ground.mine, ground.theirs);
    if leaves < comes || enters > passes {
        return None;
    }
    let speed_mps = other.speed_at(enters)?;
    let room_s = Trace::seconds(comes.saturating_sub(enters));
    let hard = speed_mps > 2.0 * HARD_MPS2 * room_s;
    (speed_mps > FAST_MPS && hard).then(|| Trace::seconds(passes) + AFTER_S)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::geometry::direction;
    use scene::{Size, State, Subtype};
    use std::f64::consts::FRAC_PI_2;

    /// Straight on from a place for 9 s.
    fn going(agent_type: AgentType, from: (f64, f64), heading_rad: f64, speed_mps: f64) -> Trace {
        let size = Size::default_for(agent_type, Subtype::Unknown);
        let v = direction(heading_rad) * speed_mps;
        let at = |step: usize| {
            let t = 0.1 * (step + 1) as f64;
            let (x_m, y_m) = (from.0 + v.x * t, from.1 + v.y * t);
            Some(State { x_m, y_m, heading_rad, vx_mps: v.x, vy_mps: v.y })
        };
        Trace::new(if agent_type == AgentType::Vehicle { "car" } else { "walker" }, agent_type, &size, 90, at)
    }

    #[test]
    fn before_a_fast_car_that_is_near_and_no_other() {
        // Crosses a lane at y = 0 and is on it from 2 to 4.5 s.
        let walker = going(AgentType::Pedestrian, (0.0, -4.5), FRAC_PI_2, 1.4);
        let car = |from_m: f64, speed_mps: f64| going(AgentType::Vehicle, (from_m, 0.0), 0.0, speed_mps);
        let passed_s = steps_out(&walker, &car(-38.0, 12.0)).unwrap();
        assert!((3.0..4.5).contains(&passed_s), "{passed_s}");
        assert_eq!(steps_out(&walker, &car(-90.0, 12.0)), None, "over by then");
        assert_eq!(steps_out(&walker, &car(-10.0, 12.0)), None, "it has passed");
        assert_eq!(steps_out(&walker, &car(-11.0, 3.0)), None, "slow enough to let the pedestrian go");
    }
}
