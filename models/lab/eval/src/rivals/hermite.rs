//! Cubic Hermite curves in time between two positions with velocities, as an animation tool draws them
//! between key frames.

use scene::motion::Target;
use scene::{STEP_S, Vec2};

/// A cubic in time between two positions with velocities.
#[derive(Clone, Copy, Debug)]
pub struct Hermite {
    from: (Vec2, Vec2),
    to: (Vec2, Vec2),
    seconds: f64,
}

impl Hermite {
    /// The curve from a position and velocity (m, m/s) to another in `seconds`, which must be above 0.
    pub fn new(from: (Vec2, Vec2), to: (Vec2, Vec2), seconds: f64) -> Self {
        Self { from, to, seconds }
    }

    /// The curve to a target's position, reached at its step. The final velocity follows the target's speed
    /// and heading if they are fixed; a free end has no acceleration. If only the speed is fixed, its
    /// direction is that of a free end. `None` for a target without a position.
    pub fn to_target(from: (Vec2, Vec2), target: &Target) -> Option<Self> {
        let ((p0, v0), p1) = (from, target.position?);
        let seconds = target.step.max(1) as f64 * STEP_S;
        let natural = (p1 - p0) * (1.5 / seconds) - v0 * 0.5;
        let v1 = target.end_velocity(natural).unwrap_or(natural);
        Some(Self::new(from, (p1, v1), seconds))
    }

    /// Position and velocity after `t` seconds; after the end the motion continues unchanged.
    pub fn at(&self, t: f64) -> (Vec2, Vec2) {
        let ((p0, v0), (p1, v1), seconds) = (self.from, self.to, self.seconds);
        let s = t.min(seconds) / seconds;
        let (s2, s3) = (s * s, s * s * s);
        let position = p0 * (2.0 * s3 - 3.0 * s2 + 1.0)
            + v0 * (seconds * (s3 - 2.0 * s2 + s))
            + p1 * (3.0 * s2 - 2.0 * s3)
            + v1 * (seconds * (s3 - s2));
        let velocity = p0 * (6.0 * (s2 - s) / seconds)
            + v0 * (3.0 * s2 - 4.0 * s + 1.0)
            + p1 * (6.0 * (s - s2) / seconds)
            + v1 * (3.0 * s2 - 2.0 * s);
        (position + velocity * (t - seconds).max(0.0), velocity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meets_both_ends_and_goes_on() {
        let (from, to) =
            ((Vec2::new(1.0, 2.0), Vec2::new(6.0, 0.0)), (Vec2::new(40.0, 20.0), Vec2::new(0.0, 4.0)));
        let curve = Hermite::new(from, to, 6.0);
        let close = |a: (Vec2, Vec2), b: (Vec2, Vec2)| (a.0 - b.0).norm() < 1e-9 && (a.1 - b.1).norm() < 1e-9;
        assert!(close(curve.at(0.0), from) && close(curve.at(6.0), to));
        assert!(close(curve.at(8.0), (to.0 + to.1 * 2.0, to.1)));
        // The velocity is the derivative of the position.
        let slope = (curve.at(3.001).0 - curve.at(2.999).0) / 0.002;
        assert!((slope - curve.at(3.0).1).norm() < 1e-5);
    }

    #[test]
    fn a_free_end_has_no_acceleration() {
        let target = Target { step: 90, position: Some(Vec2::new(30.0, 8.0)), ..Target::default() };
        let curve = Hermite::to_target((Vec2::zeros(), Vec2::new(2.0, 0.0)), &target).unwrap();
        let change = (curve.at(9.0).1 - curve.at(8.99).1) / 0.01;
        assert!(change.norm() < 0.02, "{change}");
        let speed = Target { speed_mps: Some(4.0), ..target };
        let curve = Hermite::to_target((Vec2::zeros(), Vec2::new(2.0, 0.0)), &speed).unwrap();
        assert!((curve.at(9.0).1.norm() - 4.0).abs() < 1e-9);
        assert!(
            Hermite::to_target((Vec2::zeros(), Vec2::zeros()), &Target { position: None, ..target })
                .is_none()
        );
    }
}
