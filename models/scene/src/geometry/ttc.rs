//! Time to collision of two boxes at constant velocity.

use super::Vec2;
use super::obb::OrientedBox;

/// Greatest time to collision that is searched, seconds.
pub const LOOK_AHEAD_S: f64 = 8.0;

/// Seconds until two boxes that keep their velocities (m/s) and headings begin to overlap; zero when
/// they overlap now; `None` when they do not within `horizon_s`.
///
/// Exact: on each of the four side directions, the projections of the boxes overlap during one interval of
/// time. The boxes overlap while all four do (swept separating axes). Boxes that only touch or slide along
/// each other do not collide. Constant cost; boxes whose bounding circles never meet cost one closest
/// approach.
///
/// ```
/// use scene::geometry::{Vec2, obb::OrientedBox, ttc::time_to_collision};
/// let follower = OrientedBox::new(Vec2::new(0.0, 0.0), 2.0, 1.0, 0.0);
/// let leader = OrientedBox::new(Vec2::new(24.0, 0.5), 2.0, 1.0, 0.0);
/// // 20 m between the bumpers, closing at 10 m/s
/// let t = time_to_collision(&follower, Vec2::new(15.0, 0.0), &leader, Vec2::new(5.0, 0.0), 8.0);
/// assert!((t.unwrap_or(0.0) - 2.0).abs() < 1e-12);
/// ```
pub fn time_to_collision(
    a: &OrientedBox,
    va: Vec2,
    b: &OrientedBox,
    vb: Vec2,
    horizon_s: f64,
) -> Option<f64> {
    let (between, closing) = (b.center() - a.center(), va - vb);
    if circles_stay_apart(between, closing, a.radius_m() + b.radius_m(), horizon_s) {
        return None;
    }
    let turn = Vec2::new(a.forward().dot(&b.forward()), a.left().dot(&b.forward()));
    let (c, s) = (turn.x.abs(), turn.y.abs());
    let (la, wa, lb, wb) = (a.half_length_m(), a.half_width_m(), b.half_length_m(), b.half_width_m());
    let axes = [
        (a.forward(), la + lb * c + wb * s),
        (a.left(), wa + lb * s + wb * c),
        (b.forward(), lb + la * c + wa * s),
        (b.left(), wb + la * s + wa * c),
    ];
    let (mut enter, mut leave) = (0.0f64, horizon_s);
    for (axis, reach) in axes {
        // The shadows overlap while |offset - speed t| < reach.
        let (offset, speed) = (axis.dot(&between), axis.dot(&closing));
        if speed.abs() < 1e-12 {
            if offset.abs() >= reach {
                return None;
            }
        } else {
            let (t0, t1) = ((offset - reach) / speed, (offset + reach) / speed);
            enter = enter.max(t0.min(t1));
            leave = leave.min(t0.max(t1));
        }
    }
    (enter < leave).then_some(enter)
}

/// The bounding circles do not come together within the horizon.
fn circles_stay_apart(between: Vec2, closing: Vec2, reach: f64, horizon_s: f64) -> bool {
    let towards = between.dot(&closing);
    let distance_squared = between.norm_squared();
    if distance_squared <= reach * reach {
        return false;
    }
    if towards <= 0.0 {
        return true;
    }
    let nearest_s = (towards / closing.norm_squared()).min(horizon_s);
    (between - closing * nearest_s).norm_squared() > reach * reach
}

#[cfg(test)]
mod tests {
    use super::super::obb::{moved, overlaps};
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn car(x: f64, y: f64, heading: f64) -> OrientedBox {
        OrientedBox::new(Vec2::new(x, y), 2.0, 1.0, heading)
    }

    #[test]
    fn known_times() {
        let v = |x: f64, y: f64| Vec2::new(x, y);
        let head_on = time_to_collision(&car(0., 0., 0.), v(10., 0.), &car(44., 0., PI), v(-10., 0.), 8.0);
        assert!((head_on.unwrap() - 2.0).abs() < 1e-12);
        // Crossing at a right angle: bumper reaches the other's near side after 10 m.
        let cross =
            time_to_collision(&car(0., 0., 0.), v(10., 0.), &car(13., -13., FRAC_PI_2), v(0., 10.), 8.0);
        assert!((cross.unwrap() - 1.0).abs() < 1e-12);
        // One lane over, opposite directions: passes without contact.
        assert_eq!(
            time_to_collision(&car(0., 0., 0.), v(10., 0.), &car(40., 3.5, PI), v(-10., 0.), 8.0),
            None
        );
        // Now overlapping; equal velocities; touching and sliding; beyond the horizon; already past.
        assert_eq!(
            time_to_collision(&car(0., 0., 0.), v(1., 0.), &car(1., 0., 0.), v(0., 0.), 8.0),
            Some(0.0)
        );
        assert_eq!(time_to_collision(&car(0., 0., 0.), v(9., 0.), &car(5., 0., 0.), v(9., 0.), 8.0), None);
        assert_eq!(time_to_collision(&car(0., 0., 0.), v(9., 0.), &car(3., 2., 0.), v(0., 0.), 8.0), None);
        assert_eq!(time_to_collision(&car(0., 0., 0.), v(1., 0.), &car(13., 0., 0.), v(0., 0.), 8.0), None);
        assert_eq!(time_to_collision(&car(0., 0., 0.), v(9., 0.), &car(-5., 0., 0.), v(0., 0.), 8.0), None);
    }

    proptest! {
        /// Boxes are apart before the time found, overlap just after it, and never overlap otherwise.
        #[test]
        fn agrees_with_stepping(
            x in -30.0..30.0, y in -30.0..30.0, h in -3.0..3.0, k in -3.0..3.0,
            vx in -9.0..9.0, vy in -9.0..9.0, wx in -9.0..9.0, wy in -9.0..9.0,
        ) {
            let (a, b) = (car(0.0, 0.0, h), car(x, y, k));
            let (va, vb) = (Vec2::new(vx, vy), Vec2::new(wx, wy));
            let at = |t: f64| (moved(&a, 0.0, va * t), moved(&b, 0.0, vb * t));
            let found = time_to_collision(&a, va, &b, vb, 8.0);
            for i in 0..160 {
                let t = i as f64 * 0.05;
                if t < found.unwrap_or(f64::INFINITY) - 1e-6 {
                    let (p, q) = at(t);
                    prop_assert!(!overlaps(&p, &q, 0.0), "overlap at {t} before {found:?}");
                }
            }
            if let Some(t) = found {
                let (p, q) = at(t);
                prop_assert!(overlaps(&p, &q, 1e-6));
            }
            prop_assert_eq!(found.is_some(), time_to_collision(&b, vb, &a, va, 8.0).is_some());
        }
    }
}
