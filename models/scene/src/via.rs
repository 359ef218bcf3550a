//! Via points: places that a road user passes on its way, with a tolerance and, if fixed, a time.

use crate::{STEP_S, State, Vec2};
use serde::Serialize;

/// Most via points of one road user.
pub const MAX_VIAS: usize = 4;
/// Range of a via point's tolerance, metres, both ends included.
pub const VIA_TOLERANCE_M: (f64, f64) = (0.5, 5.0);
/// Default tolerance, metres.
pub const DEFAULT_VIA_TOLERANCE_M: f64 = 1.0;
/// Greatest deviation from a via point's time, seconds.
pub const VIA_WITHIN_S: f64 = 0.5;

/// A via point; a road user passes its via points in order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Via {
    /// Position of the box centre, metres, scene frame.
    pub position: Vec2,
    /// Passed no farther away than this, metres.
    pub tolerance_m: f64,
    /// Scene time at which it is passed; any time if free.
    pub time_s: Option<f64>,
}

/// Where a motion comes nearest to a via point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passing {
    /// Distance of the box centre from it, metres.
    pub distance_m: f64,
    /// Scene time, seconds.
    pub time_s: f64,
    /// Box centre then, metres.
    pub place: Vec2,
}

impl Via {
    /// Whether a passing is within the tolerance.
    pub fn is_passed(&self, passing: &Passing) -> bool {
        passing.distance_m <= self.tolerance_m && self.beyond_s(passing) == 0.0
    }

    /// Seconds outside the allowed time.
    fn beyond_s(&self, passing: &Passing) -> f64 {
        let off_s = self.time_s.map_or(0.0, |due_s| (passing.time_s - due_s).abs());
        (off_s - VIA_WITHIN_S - 1e-6).max(0.0)
    }

    /// Cost of a passing. A time other than the fixed one costs most, so it is taken only if the motion never
    /// has that time.
    fn cost(&self, passing: &Passing) -> f64 {
        let missed_m = (passing.distance_m - self.tolerance_m).max(0.0);
        passing.distance_m + MISSED * missed_m + ANOTHER_TIME * self.beyond_s(passing)
    }
}

/// Weight of a metre outside the tolerance, relative to a metre within it.
const MISSED: f64 = 100.0;
/// Weight of a second outside the allowed time.
const ANOTHER_TIME: f64 = 1e6;

/// How a motion passes via points in order, with as few and as little misses as possible. `states` are one
/// step apart, the first at the scene time `start_s`. Empty without states.
pub fn passings(vias: &[Via], start_s: f64, states: &[State]) -> Vec<Passing> {
    if vias.is_empty() || states.is_empty() {
        return Vec::new();
    }
    // By via point and interval between states: the cost of passing all via points up to it, and where.
    let stretches = states.len().saturating_sub(1).max(1);
    let mut best = vec![0.0_f64; stretches];
    let mut chosen: Vec<Vec<usize>> = Vec::with_capacity(vias.len());
    for via in vias {
        let (mut least, mut at) = (f64::INFINITY, 0);
        let mut from = Vec::with_capacity(stretches);
        for (i, before) in best.iter_mut().enumerate() {
            let here = *before + via.cost(&nearest(via, start_s, states, i));
            if here < least {
                (least, at) = (here, i);
            }
            from.push(at);
            *before = least;
        }
        chosen.push(from);
    }
    let mut last = stretches - 1;
    let mut out: Vec<Passing> = Vec::with_capacity(vias.len());
    for (via, from) in vias.iter().zip(&chosen).rev() {
        last = from[last];
        out.push(nearest(via, start_s, states, last));
    }
    out.reverse();
    out
}

/// The nearest point to a via point between a state and the next, within its time if that is fixed.
fn nearest(via: &Via, start_s: f64, states: &[State], i: usize) -> Passing {
    let from = states[i].position();
    let chord = states.get(i + 1).map_or(Vec2::zeros(), |s| s.position() - from);
    let (mut least, mut most) = (0.0, 1.0);
    let begins_s = start_s + i as f64 * STEP_S;
    if let Some(due_s) = via.time_s {
        let share = |t: f64| ((t - begins_s) / STEP_S).clamp(0.0, 1.0);
        (least, most) = (share(due_s - VIA_WITHIN_S), share(due_s + VIA_WITHIN_S));
    }
    let along = if chord.norm_squared() > 1e-12 {
        ((via.position - from).dot(&chord) / chord.norm_squared()).clamp(least, most)
    } else {
        least
    };
    let place = from + chord * along;
    Passing { distance_m: (via.position - place).norm(), time_s: begins_s + along * STEP_S, place }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn via(x: f64, y: f64, time_s: Option<f64>) -> Via {
        Via { position: Vec2::new(x, y), tolerance_m: 1.0, time_s }
    }

    /// East at 10 m/s from the origin.
    fn east() -> Vec<State> {
        (0..=90).map(|i| State { x_m: f64::from(i), vx_mps: 10.0, ..State::default() }).collect()
    }

    #[test]
    fn the_nearest_place_lies_between_two_states() {
        let passed = passings(&[via(30.4, 0.7, None)], 1.0, &east());
        assert!((passed[0].distance_m - 0.7).abs() < 1e-9);
        assert!((passed[0].time_s - 4.04).abs() < 1e-9);
        assert!(via(30.4, 0.7, None).is_passed(&passed[0]));
        let missed = passings(&[via(30.0, 3.0, None)], 0.0, &east());
        assert!(!via(30.0, 3.0, None).is_passed(&missed[0]));
    }

    #[test]
    fn order_counts() {
        let there = [via(20.0, 0.0, None), via(60.0, 0.0, None)];
        assert!(there.iter().zip(passings(&there, 0.0, &east())).all(|(v, p)| v.is_passed(&p)));
        let back = [there[1], there[0]];
        let passed = passings(&back, 0.0, &east());
        assert_eq!(back.iter().zip(&passed).filter(|(v, p)| v.is_passed(p)).count(), 1);
        assert!(passed[0].time_s <= passed[1].time_s + STEP_S, "the same stretch may be both");
        // Out and back: the first is passed on the way out, the second on the way back.
        let mut round = east();
        round.extend((0..90).rev().map(|i| State { x_m: f64::from(i), ..State::default() }));
        let passed = passings(&back, 0.0, &round);
        assert!(back.iter().zip(&passed).all(|(v, p)| v.is_passed(p)));
        assert!(passed[1].time_s > 9.0);
    }

    #[test]
    fn a_time_is_held_to() {
        for (time_s, passes) in
            [(3.0, true), (3.3, true), (3.8, false), (2.2, false), (8.0, false), (30.0, false)]
        {
            let asked = via(30.0, 0.0, Some(time_s));
            let passing = passings(&[asked], 0.0, &east())[0];
            assert_eq!(asked.is_passed(&passing), passes, "{time_s}: {passing:?}");
        }
    }

    #[test]
    fn one_state_is_a_motion_too_and_none_is_none() {
        assert!(passings(&[via(0.0, 0.0, None)], 0.0, &[]).is_empty());
        assert_eq!(passings(&[via(0.0, 2.0, None)], 0.0, &east()[..1])[0].distance_m, 2.0);
    }
}
