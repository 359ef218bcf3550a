//! Curves in time whose velocity soon returns to a constant one: how pedestrians walk to a place.
//!
//! A cubic in time carries the initial velocity through the whole curve. A pedestrian's initial velocity does
//! not last: most of it is sway and gait. This curve minimizes the squares of both acceleration and deviation
//! from a constant velocity, with the [relaxation time](Tension::to_target) as their ratio (a spline under
//! tension, Schweikert 1966, in time). It approaches a straight line for short relaxation times and the cubic
//! for long ones.

use super::Target;
use crate::{STEP_S, Vec2};

/// A spline under tension between two places: a constant velocity plus deviations that decay from either end.
#[derive(Clone, Copy, Debug)]
pub struct Tension {
    origin: Vec2,
    even: Vec2,
    /// Deviations that decay from the start, and towards the end, metres.
    fading: [Vec2; 2],
    seconds: f64,
    relax_s: f64,
}

impl Tension {
    /// The curve from a place and velocity (m, m/s) to a target's position at its step. A deviation from the
    /// constant velocity decays to 1/e in `relax_s` seconds, which must be above 0. The velocity at the end
    /// follows the target's speed and heading if they are fixed. A free end has no acceleration; if only the
    /// speed is fixed, the free end gives the direction. `None` for a target without a position.
    pub fn to_target(from: (Vec2, Vec2), target: &Target, relax_s: f64) -> Option<Self> {
        let to = target.position?;
        let seconds = target.step.max(1) as f64 * STEP_S;
        let free = Self::new(from, to, None, seconds, relax_s);
        let end = target.end_velocity(free.at(seconds).1);
        Some(end.map_or(free, |end| Self::new(from, to, Some(end), seconds, relax_s)))
    }

    /// The place is origin + even t + fading0 e^(-t/r) + fading1 e^(-(T-t)/r). The four follow from both ends
    /// and their velocities; a free end has acceleration zero instead.
    fn new(from: (Vec2, Vec2), to: Vec2, end: Option<Vec2>, seconds: f64, relax_s: f64) -> Self {
        let (length, left) = (seconds / relax_s, (-seconds / relax_s).exp());
        let beyond = to - from.0 - from.1 * seconds;
        let fading = match end {
            Some(end) => {
                let sum = (end - from.1) * (relax_s / (1.0 - left));
                let first = (beyond + sum * (left * length - (1.0 - left)))
                    / ((1.0 + left) * length - 2.0 * (1.0 - left));
                [first, sum - first]
            }
            None => {
                let first = beyond / ((1.0 + left * left) * length - (1.0 - left * left));
                [first, first * -left]
            }
        };
        let even = from.1 + (fading[0] - fading[1] * left) / relax_s;
        Self { origin: from.0 - fading[0] - fading[1] * left, even, fading, seconds, relax_s }
    }

    /// Place and velocity after `t` seconds; beyond the end the velocity is constant.
    pub fn at(&self, t: f64) -> (Vec2, Vec2) {
        let inside = t.min(self.seconds);
        let fade = [(-inside / self.relax_s).exp(), ((inside - self.seconds) / self.relax_s).exp()];
        let [first, second] = [self.fading[0] * fade[0], self.fading[1] * fade[1]];
        let velocity = self.even + (second - first) / self.relax_s;
        (self.origin + self.even * inside + first + second + velocity * (t - inside), velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const FROM: (Vec2, Vec2) = (Vec2::new(1.0, 2.0), Vec2::new(2.0, 0.5));

    fn target() -> Target {
        Target { step: 60, position: Some(Vec2::new(9.0, 4.0)), ..Target::default() }
    }

    #[test]
    fn meets_both_ends_and_goes_on() {
        for relax_s in [0.2, 1.0, 5.0, 100.0] {
            let fixed = Target { heading_rad: Some(FRAC_PI_2), speed_mps: Some(1.2), ..target() };
            let curve = Tension::to_target(FROM, &fixed, relax_s).unwrap();
            let end = (Vec2::new(9.0, 4.0), Vec2::new(0.0, 1.2));
            let close =
                |a: (Vec2, Vec2), b: (Vec2, Vec2)| (a.0 - b.0).norm() < 1e-6 && (a.1 - b.1).norm() < 1e-6;
            assert!(close(curve.at(0.0), FROM) && close(curve.at(6.0), end), "{curve:?}");
            assert!(close(curve.at(8.0), (end.0 + end.1 * 2.0, end.1)));
            let slope = (curve.at(3.001).0 - curve.at(2.999).0) / 0.002;
            assert!((slope - curve.at(3.0).1).norm() < 1e-5);
        }
    }

    #[test]
    fn a_free_end_has_no_acceleration_and_a_fixed_speed_is_met() {
        let curve = Tension::to_target(FROM, &target(), 2.0).unwrap();
        let change = (curve.at(6.0).1 - curve.at(5.99).1) / 0.01;
        assert!(change.norm() < 0.02, "{change}");
        let speed = Target { speed_mps: Some(1.7), ..target() };
        let curve = Tension::to_target(FROM, &speed, 2.0).unwrap();
        assert!((curve.at(6.0).1.norm() - 1.7).abs() < 1e-9);
        assert!(Tension::to_target(FROM, &Target { position: None, ..target() }, 2.0).is_none());
    }

    #[test]
    fn the_first_velocity_is_soon_forgotten() {
        let curve = Tension::to_target(FROM, &target(), 0.5).unwrap();
        let even = curve.at(3.0).1;
        assert!((curve.at(2.5).1 - even).norm() < 0.01 && (FROM.1 - even).norm() > 0.5);
        // For a long relaxation time it is the cubic: the velocity of a free end is 1.5 times the mean minus
        // half the initial one.
        let cubic = Tension::to_target(FROM, &target(), 1e3).unwrap();
        let natural = (Vec2::new(9.0, 4.0) - FROM.0) * (1.5 / 6.0) - FROM.1 * 0.5;
        assert!((cubic.at(6.0).1 - natural).norm() < 1e-3);
    }
}
