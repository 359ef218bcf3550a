//! A smooth energy that pushes moving boxes apart: it grows when two of them come closer than half a metre,
//! and its negative gradient separates them. Training and generation call the same functions.
//!
//! A moving box is a sequence of poses at equally spaced instants. The box that is moved is represented by
//! three discs along its length, the others by their rectangles.

/// Gap below which the energy grows, metres.
const MARGIN: f32 = 0.5;
/// Energy per squared metre of missing gap.
const WEIGHT: f32 = 0.3;

/// Centre x and y, cosine and sine of the heading at each instant. All zero: absent.
pub type Poses<const N: usize> = [[f32; 4]; N];

/// A box that acts as an obstacle.
#[derive(Clone, Copy, Debug)]
pub struct MovingBox<'a, const N: usize> {
    /// Its poses at the instants.
    pub poses: &'a Poses<N>,
    /// Half length and half width, metres.
    pub half: [f32; 2],
}

/// How the energy grows as the gap shrinks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// Quadratically: the input of the refiner.
    Square,
    /// Linearly, up to two metres: the penalty in training.
    Linear,
}

/// The axis-aligned rectangle around the places of a moving box: least x and y, then greatest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds([f32; 4]);

impl Bounds {
    /// Bounds over the instants at which the box is present. If it never is, the bounds are far from all
    /// others.
    pub fn of<const N: usize>(poses: &Poses<N>) -> Self {
        let mut all = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
        for pose in poses.iter().filter(|p| !absent(p)) {
            for axis in 0..2 {
                all[axis] = all[axis].min(pose[axis]);
                all[axis + 2] = all[axis + 2].max(pose[axis]);
            }
        }
        Self(all)
    }

    /// Whether two boxes of these half sizes may have an energy within these bounds. False guarantees that
    /// [`overlap_energy`] is zero.
    pub fn may_touch(&self, half: [f32; 2], other: &Self, other_half: [f32; 2]) -> bool {
        let reach = reach_of(half, other_half);
        (0..2).all(|axis| {
            self.0[axis] - other.0[axis + 2] <= reach && other.0[axis] - self.0[axis + 2] <= reach
        })
    }
}

/// Greatest distance of two centres along x or y at which their boxes can be within each other's margin.
fn reach_of(half: [f32; 2], other: [f32; 2]) -> f32 {
    MARGIN + half[0] + half[1] + other[0] + other[1]
}

/// Energy of a moving box, and its gradient with respect to the centre's x and y at each instant.
#[derive(Clone, Debug)]
pub struct OverlapEnergy<const N: usize> {
    /// Sum over obstacles and instants.
    pub energy: f32,
    /// Gradient [instant][x, y] for fixed headings.
    pub gradient: [[f32; 2]; N],
}

/// The energy of a box of half sizes `half` that moves by `own` among obstacles.
pub fn overlap_energy<'a, const N: usize>(
    own: &Poses<N>,
    half: [f32; 2],
    obstacles: impl IntoIterator<Item = MovingBox<'a, N>>,
    growth: Growth,
) -> OverlapEnergy<N> {
    let mut result = OverlapEnergy { energy: 0.0, gradient: [[0.0; 2]; N] };
    for obstacle in obstacles {
        let reach = reach_of(half, obstacle.half);
        for instant in 0..N {
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

/// Boxes extrapolated with their velocity since the previous instant, headings held. `share` is the time
/// ahead, in intervals between instants. The result is absent at the first instant, and where the pose or the
/// previous one is absent.
pub fn carried_on<const N: usize>(poses: &Poses<N>, share: f32) -> Poses<N> {
    let mut out = [[0.0; 4]; N];
    for instant in 1..N {
        let (before, now) = (&poses[instant - 1], &poses[instant]);
        if !absent(before) && !absent(now) {
            let on = |axis: usize| now[axis] + share * (now[axis] - before[axis]);
            out[instant] = [on(0), on(1), now[2], now[3]];
        }
    }
    out
}

/// Converts a gradient with respect to the centres of [`carried_on`] boxes to one with respect to the
/// original centres.
pub fn carried_back<const N: usize>(gradient: &[[f32; 2]; N], share: f32) -> [[f32; 2]; N] {
    let mut out = [[0.0; 2]; N];
    for instant in 1..N {
        for axis in 0..2 {
            out[instant][axis] += (1.0 + share) * gradient[instant][axis];
            out[instant - 1][axis] -= share * gradient[instant][axis];
        }
    }
    out
}

/// Whether the pose marks an absent box.
pub fn absent(pose: &[f32; 4]) -> bool {
    pose[2] == 0.0 && pose[3] == 0.0
}

/// Gap between a box, as three discs along its length, and another box (negative if they overlap), and its
/// gradient with respect to the first box's centre.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn far_and_absent_boxes_cost_nothing() {
        let far = [[100.0, 0.0, 1.0, 0.0]; 3];
        let nobody = [[0.0; 4]; 3];
        let own = [[0.0, 0.0, 1.0, 0.0]; 3];
        let others = [&far, &nobody].map(|poses| MovingBox { poses, half: [2.0, 1.0] });
        let result = overlap_energy(&own, [2.0, 1.0], others, Growth::Square);
        assert_eq!((result.energy, result.gradient), (0.0, [[0.0; 2]; 3]));
    }

    #[test]
    fn gradients_match_differences() {
        let (c, s) = (0.3f32.cos(), 0.3f32.sin());
        let other = [[14.0, 1.9, c, s], [14.5, 2.2, c, s]];
        let own = [[10.2, 0.3, 1.0, 0.0], [12.0, 0.4, 1.0, 0.0]];
        for growth in [Growth::Square, Growth::Linear] {
            for share in [None, Some(2.0)] {
                let energy = |own: &Poses<2>| {
                    let obstacle = MovingBox { poses: &other, half: [2.0, 1.0] };
                    let own = share.map_or(*own, |share| carried_on(own, share));
                    overlap_energy(&own, [2.2, 0.9], [obstacle], growth)
                };
                let found = energy(&own);
                assert!(found.energy > 0.0, "{growth:?} {share:?}");
                let gradient = share.map_or(found.gradient, |share| carried_back(&found.gradient, share));
                for instant in 0..2 {
                    for axis in 0..2 {
                        let at = |delta: f32| {
                            let mut moved = own;
                            moved[instant][axis] += delta;
                            f64::from(energy(&moved).energy)
                        };
                        let slope = (at(1e-3) - at(-1e-3)) / 2e-3;
                        let expected = f64::from(gradient[instant][axis]);
                        assert!((slope - expected).abs() < 0.01 + 0.03 * slope.abs(), "{slope} {expected}");
                    }
                }
            }
        }
    }

    #[test]
    fn boxes_are_carried_on_as_they_moved() {
        let mut poses: Poses<18> = std::array::from_fn(|i| [2.0 * i as f32, 1.0, 1.0, 0.0]);
        poses[5] = [0.0; 4];
        let on = carried_on(&poses, 3.0);
        assert_eq!(on[1], [8.0, 1.0, 1.0, 0.0]);
        assert!([0, 5, 6].iter().all(|i| absent(&on[*i])));
    }

    #[test]
    fn bounds_leave_out_nobody_who_counts() {
        let own: Poses<8> = std::array::from_fn(|i| [3.0 * i as f32, 0.0, 1.0, 0.0]);
        let half = [2.2, 0.9];
        let mut left_out = 0;
        for (x, y) in (-60..60).flat_map(|x| (-20..20).map(move |y| (x as f32 * 0.7, y as f32 * 0.7))) {
            let mut other: Poses<8> = std::array::from_fn(|i| [x, y + 0.3 * i as f32, 0.0, 1.0]);
            other[3] = [0.0; 4];
            let obstacle = MovingBox { poses: &other, half: [2.0, 1.0] };
            let energy = overlap_energy(&own, half, [obstacle], Growth::Square).energy;
            let near = Bounds::of(&own).may_touch(half, &Bounds::of(&other), [2.0, 1.0]);
            assert!(near || energy == 0.0, "{x} {y}");
            left_out += usize::from(!near);
        }
        assert!(left_out > 1000, "{left_out}");
        let nobody = [[0.0; 4]; 8];
        assert!(!Bounds::of(&own).may_touch(half, &Bounds::of(&nobody), [2.0, 1.0]));
    }

    #[test]
    fn gaps_are_distances() {
        let b = [0.0, 0.0, 0.0, 1.0];
        let (side, slope) = gap([4.0, 0.0, 0.0, 1.0], [2.0, 1.0], b, [2.0, 1.0]);
        assert!((side - 2.0).abs() < 1e-5 && (slope[0] - 1.0).abs() < 1e-5);
        assert!(gap([0.5, 0.5, 1.0, 0.0], [2.0, 1.0], b, [2.0, 1.0]).0 < -1.0);
    }
}
