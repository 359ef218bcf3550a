//! Finds interactive scenes among recorded ones.

use super::Interest;
use scene::{Agent, AgentType, HORIZON_STEPS, Scene, Vec2};

/// Two road users meet when they come nearer than this to one place, metres.
const PLACE_M: f64 = 2.5;
/// Greatest difference of the times, steps.
const APART_STEPS: usize = 30;
/// A scene is interactive only if a pair comes closer than this, metres.
pub(super) const INTERACTIVE_M: f64 = 10.0;
/// A road user that moves no farther than this counts in no encounter, metres.
const MOVES_M: f64 = 2.0;
/// Every other step is checked.
const STRIDE: usize = 2;

/// Interaction of pairs of a road user of this type and one of another type that both move, in the first 9 s
/// of the log: the number of pairs that come to the same place within 3 s of each other, and the least
/// distance.
pub(super) fn interest(scene: &Scene, of: AgentType) -> Interest {
    let moving: Vec<(AgentType, Vec<(usize, Vec2)>)> =
        scene.agents.iter().filter_map(|agent| Some((agent.agent_type, places(agent)?))).collect();
    let mut out = Interest { encounters: 0, nearest_m: f64::MAX };
    for (_, a) in moving.iter().filter(|(kind, _)| *kind == of) {
        for (_, b) in moving.iter().filter(|(kind, _)| *kind != of && *kind != AgentType::Other) {
            let nearest_m = nearest_m(a, b);
            out.encounters += usize::from(nearest_m < PLACE_M);
            out.nearest_m = out.nearest_m.min(nearest_m);
        }
    }
    out
}

fn places(agent: &Agent) -> Option<Vec<(usize, Vec2)>> {
    let steps = (0..=HORIZON_STEPS).step_by(STRIDE);
    let places: Vec<(usize, Vec2)> = steps.filter_map(|s| Some((s, agent.state_at(s)?.position()))).collect();
    let first = places.first()?.1;
    places.iter().any(|(_, p)| (p - first).norm() > MOVES_M).then_some(places)
}

/// Least distance between positions that both reach within 3 s of each other.
fn nearest_m(a: &[(usize, Vec2)], b: &[(usize, Vec2)]) -> f64 {
    let mut least = f64::MAX;
    for (s, p) in a {
        for (_, q) in b.iter().filter(|(t, _)| s.abs_diff(*t) <= APART_STEPS) {
            least = least.min((p - q).norm_squared());
        }
    }
    least.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::walker;
    use lab_train::samples::{log, scene, shifted};

    #[test]
    fn only_those_who_come_to_one_place_in_time_meet() {
        // The walker comes to the lane 30 m ahead after 3.3 s; the car is there after 3.75 s.
        let mut crossing = walker("w", 1.2, (30.0, -4.0));
        for state in crossing.track.states.iter_mut().flatten() {
            let gone = state.x_m - 30.0;
            (state.x_m, state.y_m) = (30.0, -4.0 + gone);
        }
        let of = |agents| interest(&scene(agents), AgentType::Pedestrian);
        let met = of(vec![log("a", 8.0, 91), crossing.clone()]);
        assert!(met.encounters == 1 && met.nearest_m < 1.0, "{met:?}");
        // A road user far behind comes too late, one that stands meets none, and two on foot do not count.
        let late = shifted(log("b", 8.0, 91), -60.0, 0.0);
        let stands = shifted(log("c", 0.0, 91), 30.0, 0.0);
        let apart = of(vec![late, stands, crossing.clone(), walker("v", 1.2, (30.0, -4.0))]);
        assert!(apart.encounters == 0 && apart.nearest_m > 10.0, "{apart:?}");
        assert_eq!(interest(&scene(vec![log("a", 8.0, 91), crossing]), AgentType::Vehicle).encounters, 1);
    }
}
