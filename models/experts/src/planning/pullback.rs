//! The overlap energy of a draft against other road users' boxes, and the way downhill in the draft's
//! own knots. Training and generation call the same functions.
//!
//! The box of the draft is three discs along its length; the energy grows where a disc comes closer to
//! another box than half a metre.

use super::smooth;
use crate::features::{ACROSS_SCALE, ALONG_SCALE, Basis, INSTANT_S, INSTANTS, RESIDUAL};
use scene::KNOTS;

/// Gap below which the energy grows, metres.
const MARGIN: f32 = 0.5;
/// Longest push, in normalised knots.
const LONGEST: f32 = 0.8;
const WEIGHT: f32 = 0.3;

/// Centre x and y, cosine and sine of the heading at each instant. All zero: nobody there.
pub type Poses = [[f32; 4]; INSTANTS];

/// A box that is in the way.
#[derive(Clone, Copy, Debug)]
pub struct Obstacle<'a> {
    /// Where it is.
    pub poses: &'a Poses,
    /// Half length and half width, metres.
    pub half: [f32; 2],
}

/// How the energy grows with the missing gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// With its square: the input of the refiner.
    Square,
    /// Linearly, up to two metres: the penalty in training.
    Linear,
}

/// Energy of a draft, and its gradient to the centre's x and y at each instant.
#[derive(Clone, Debug)]
pub struct Overlap {
    /// Sum over obstacles and instants.
    pub energy: f32,
    /// Gradient [instant][x, y], headings held.
    pub gradient: [[f32; 2]; INSTANTS],
}

/// The energy of a box of `half` length and width that moves by `own` among obstacles.
pub fn overlap<'a>(
    own: &Poses,
    half: [f32; 2],
    obstacles: impl IntoIterator<Item = Obstacle<'a>>,
    growth: Growth,
) -> Overlap {
    let mut result = Overlap { energy: 0.0, gradient: [[0.0; 2]; INSTANTS] };
    for obstacle in obstacles {
        let reach = MARGIN + half[0] + half[1] + obstacle.half[0] + obstacle.half[1];
        for instant in 0..INSTANTS {
            let (a, b) = (own[instant], obstacle.poses[instant]);
            let far = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) > reach;
            if far || absent(&a) || absent(&b) {
                continue;
            }
            let (gap, slope) = gap(a, half, b, obstacle.half);
            let missing = MARGIN - gap;
            if missing <= 0.0 {
                continue;
            }
            let (energy, factor) = match growth {
                Growth::Square => (missing * missing, -2.0 * missing),
                Growth::Linear if missing < 2.0 => (missing, -1.0),
                Growth::Linear => (2.0, 0.0),
            };
            result.energy += WEIGHT * energy;
            for axis in 0..2 {
                result.gradient[instant][axis] += WEIGHT * factor * slope[axis];
            }
        }
    }
    result
}

/// Where boxes would be `ahead_s` later if each went on, headings held, as it has moved since the instant
/// before. Nobody is there at the first instant, and where one of the two says so.
pub fn carried_on(poses: &Poses, ahead_s: f32) -> Poses {
    let share = ahead_s / INSTANT_S as f32;
    let mut out = [[0.0; 4]; INSTANTS];
    for instant in 1..INSTANTS {
        let (before, now) = (&poses[instant - 1], &poses[instant]);
        if !absent(before) && !absent(now) {
            let on = |axis: usize| now[axis] + share * (now[axis] - before[axis]);
            out[instant] = [on(0), on(1), now[2], now[3]];
        }
    }
    out
}

/// A gradient to the centres of [`carried_on`] boxes as one to the centres they were made from.
pub fn carried_back(gradient: &[[f32; 2]; INSTANTS], ahead_s: f32) -> [[f32; 2]; INSTANTS] {
    let share = ahead_s / INSTANT_S as f32;
    let mut out = [[0.0; 2]; INSTANTS];
    for instant in 1..INSTANTS {
        for axis in 0..2 {
            out[instant][axis] += (1.0 + share) * gradient[instant][axis];
            out[instant - 1][axis] -= share * gradient[instant][axis];
        }
    }
    out
}

/// Whether a pose says that nobody is there.
pub fn absent(pose: &[f32; 4]) -> bool {
    pose[2] == 0.0 && pose[3] == 0.0
}

/// Gap between a box, as three discs along its length, and another box (negative when they overlap),
/// and its gradient to the first box's centre.
pub fn gap(a: [f32; 4], half: [f32; 2], b: [f32; 4], other: [f32; 2]) -> (f32, [f32; 2]) {
    let mut best = (f32::INFINITY, [0.0; 2]);
    let ends = (half[0] - half[1]).max(0.0);
    for along in [-ends, 0.0, ends] {
        let (x, y) = (a[0] + along * a[2] - b[0], a[1] + along * a[3] - b[1]);
        let (ahead, left) = (x * b[2] + y * b[3], -x * b[3] + y * b[2]);
        let (distance, slope) = distance_to_box(ahead, left, other);
        if distance < best.0 {
            best = (distance, [slope[0] * b[2] - slope[1] * b[3], slope[0] * b[3] + slope[1] * b[2]]);
        }
    }
    (best.0 - half[0].min(half[1]), best.1)
}

/// Signed distance of a point to a box about the origin, and its gradient.
fn distance_to_box(ahead: f32, left: f32, half: [f32; 2]) -> (f32, [f32; 2]) {
    let (dx, dy) = (ahead.abs() - half[0], left.abs() - half[1]);
    let (sx, sy) = (1f32.copysign(ahead), 1f32.copysign(left));
    if dx.max(dy) <= 0.0 {
        return if dx > dy { (dx, [sx, 0.0]) } else { (dy, [0.0, sy]) };
    }
    let (px, py) = (dx.max(0.0), dy.max(0.0));
    let distance = (px * px + py * py).sqrt();
    (distance, [sx * px / distance, sy * py / distance])
}

/// Takes gradients at the instants back to the knots of a residual.
#[derive(Clone, Debug)]
pub struct Pullback {
    basis: Basis,
    correlation: [[f32; KNOTS]; KNOTS],
}

impl Default for Pullback {
    fn default() -> Self {
        let factor = smooth::factor();
        let correlation = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..KNOTS).map(|k| factor[i][k] * factor[j][k]).sum::<f64>() as f32)
        });
        Self { basis: Basis::new(), correlation }
    }
}

impl Pullback {
    /// Gradient to the normalised knots, from the gradient [along, across] at each instant.
    pub fn knots(&self, route: &[[f32; 2]; INSTANTS]) -> [f32; RESIDUAL] {
        let mut knots = [0.0; RESIDUAL];
        for (instant, gradient) in route.iter().enumerate() {
            for knot in 0..KNOTS {
                knots[knot] += ALONG_SCALE * self.basis.along[instant][knot] * gradient[0];
                knots[KNOTS + knot] += ACROSS_SCALE * self.basis.across[instant][knot] * gradient[1];
            }
        }
        knots
    }

    /// The refiner's input: the way downhill in the knots' correlation, tangent to the goal, of bounded
    /// length. `route` as in [`Pullback::knots`]; `tangent` as in
    /// [`AgentFeatures`](crate::features::AgentFeatures).
    pub fn push(
        &self,
        route: &[[f32; 2]; INSTANTS],
        tangent: &[[[f32; KNOTS]; KNOTS]; 2],
    ) -> [f32; RESIDUAL] {
        let gradient = self.knots(route);
        let mut push = [0.0; RESIDUAL];
        for half in 0..2 {
            let mut downhill = [0.0; KNOTS];
            for i in 0..KNOTS {
                for j in 0..KNOTS {
                    downhill[i] -= self.correlation[i][j] * gradient[half * KNOTS + j];
                }
            }
            for i in 0..KNOTS {
                for j in 0..KNOTS {
                    push[half * KNOTS + i] += tangent[half][i][j] * downhill[j];
                }
            }
        }
        let length = push.iter().map(|p| p * p).sum::<f32>().sqrt();
        if length > LONGEST {
            for p in &mut push {
                *p *= LONGEST / length;
            }
        }
        push
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRAIGHT: [[[f32; KNOTS]; KNOTS]; 2] = {
        let mut matrix = [[[0.0; KNOTS]; KNOTS]; 2];
        let mut i = 0;
        while i < KNOTS {
            matrix[0][i][i] = 1.0;
            matrix[1][i][i] = 1.0;
            i += 1;
        }
        matrix
    };

    fn drive(knots: &[f32; RESIDUAL]) -> Poses {
        let basis = Basis::new();
        std::array::from_fn(|instant| {
            let (mut x, mut y) = (3.0 * 0.5 * (instant + 1) as f32, 0.0);
            for knot in 0..KNOTS {
                x += ALONG_SCALE * basis.along[instant][knot] * knots[knot];
                y += ACROSS_SCALE * basis.across[instant][knot] * knots[KNOTS + knot];
            }
            [x, y, 1.0, 0.0]
        })
    }

    fn energy(knots: &[f32; RESIDUAL], growth: Growth) -> Overlap {
        let (c, s) = (0.3f32.cos(), 0.3f32.sin());
        let poses = [[14.0, 1.9, c, s]; INSTANTS];
        overlap(&drive(knots), [2.2, 0.9], [Obstacle { poses: &poses, half: [2.0, 1.0] }], growth)
    }

    #[test]
    fn gradients_match_differences() {
        for growth in [Growth::Square, Growth::Linear] {
            let knots = [0.05; RESIDUAL];
            let gradient = Pullback::default().knots(&energy(&knots, growth).gradient);
            for knot in 0..RESIDUAL {
                let at = |delta: f32| {
                    let mut moved = knots;
                    moved[knot] += delta;
                    f64::from(energy(&moved, growth).energy)
                };
                let slope = (at(1e-3) - at(-1e-3)) / 2e-3;
                assert!(
                    (slope - f64::from(gradient[knot])).abs() < 0.03 * slope.abs().max(1.0),
                    "{knot}: {slope} {}",
                    gradient[knot]
                );
            }
        }
    }

    #[test]
    fn gradients_of_boxes_carried_on_match_differences() {
        let (c, s) = (0.3f32.cos(), 0.3f32.sin());
        let poses = [[16.0, 1.9, c, s]; INSTANTS];
        let soon = |knots: &[f32; RESIDUAL]| {
            let own = carried_on(&drive(knots), 1.0);
            overlap(&own, [2.2, 0.9], [Obstacle { poses: &poses, half: [2.0, 1.0] }], Growth::Square)
        };
        let knots = [0.05; RESIDUAL];
        let gradient = Pullback::default().knots(&carried_back(&soon(&knots).gradient, 1.0));
        assert!(soon(&knots).energy > 0.0);
        for knot in 0..RESIDUAL {
            let at = |delta: f32| {
                let mut moved = knots;
                moved[knot] += delta;
                f64::from(soon(&moved).energy)
            };
            let slope = (at(1e-3) - at(-1e-3)) / 2e-3;
            let expected = f64::from(gradient[knot]);
            assert!((slope - expected).abs() < 0.03 * slope.abs().max(1.0), "{knot}: {slope} {expected}");
        }
    }

    #[test]
    fn boxes_are_carried_on_as_they_moved() {
        let mut poses: Poses = std::array::from_fn(|i| [2.0 * i as f32, 1.0, 1.0, 0.0]);
        poses[5] = [0.0; 4];
        let on = carried_on(&poses, 1.5);
        assert_eq!(on[1], [8.0, 1.0, 1.0, 0.0]);
        assert!([0, 5, 6].iter().all(|i| absent(&on[*i])));
    }

    #[test]
    fn a_push_lowers_the_energy() {
        let mut knots = [0.0; RESIDUAL];
        let before = energy(&knots, Growth::Square);
        let push = Pullback::default().push(&before.gradient, &STRAIGHT);
        assert!(push.iter().map(|p| p * p).sum::<f32>().sqrt() <= LONGEST + 1e-5);
        for (knot, push) in knots.iter_mut().zip(push) {
            *knot += 0.02 * push;
        }
        let after = energy(&knots, Growth::Square).energy;
        assert!(before.energy > 0.0 && after < before.energy, "{} to {after}", before.energy);
    }

    #[test]
    fn far_and_absent_boxes_cost_nothing() {
        let far = [[100.0, 0.0, 1.0, 0.0]; INSTANTS];
        let nobody = [[0.0; 4]; INSTANTS];
        let result = overlap(
            &drive(&[0.0; RESIDUAL]),
            [2.0, 1.0],
            [&far, &nobody].map(|poses| Obstacle { poses, half: [2.0, 1.0] }),
            Growth::Square,
        );
        assert_eq!((result.energy, result.gradient), (0.0, [[0.0; 2]; INSTANTS]));
    }

    #[test]
    fn gaps_are_distances() {
        let b = [0.0, 0.0, 0.0, 1.0];
        let (side, slope) = gap([4.0, 0.0, 0.0, 1.0], [2.0, 1.0], b, [2.0, 1.0]);
        assert!((side - 2.0).abs() < 1e-5 && (slope[0] - 1.0).abs() < 1e-5);
        assert!(gap([0.5, 0.5, 1.0, 0.0], [2.0, 1.0], b, [2.0, 1.0]).0 < -1.0);
    }
}
