//! Oriented boxes: the outlines of road users, the gap between two of them, and their overlap.

use super::{Vec2, direction};
use crate::{Size, State};

/// A rectangle in the plane: the outline of a road user seen from above. Immutable, so that the
/// cached direction always fits the heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    center: Vec2,
    half_length_m: f64,
    half_width_m: f64,
    heading_rad: f64,
    forward: Vec2,
    radius_m: f64,
}

impl OrientedBox {
    /// Box about `center` (metres) with half its length along `heading_rad` and half its width across.
    /// Negative half sizes count as zero.
    pub fn new(center: Vec2, half_length_m: f64, half_width_m: f64, heading_rad: f64) -> Self {
        Self::facing(center, (half_length_m, half_width_m), heading_rad, direction(heading_rad))
    }

    /// The same with a known unit vector along `heading_rad`, which many boxes of one moment share. `half_m`
    /// is half length, then half width.
    pub(crate) fn facing(center: Vec2, half_m: (f64, f64), heading_rad: f64, forward: Vec2) -> Self {
        let (half_length_m, half_width_m) = (half_m.0.max(0.0), half_m.1.max(0.0));
        let radius_m = (half_length_m * half_length_m + half_width_m * half_width_m).sqrt();
        Self { center, half_length_m, half_width_m, heading_rad, forward, radius_m }
    }

    /// Box of a road user of this size in this state.
    pub fn of_state(state: &State, size: &Size) -> Self {
        Self::new(state.position(), 0.5 * size.length_m, 0.5 * size.width_m, state.heading_rad)
    }

    /// Centre, metres.
    pub fn center(&self) -> Vec2 {
        self.center
    }

    /// Half the extent along the heading, metres.
    pub fn half_length_m(&self) -> f64 {
        self.half_length_m
    }

    /// Half the extent across the heading, metres.
    pub fn half_width_m(&self) -> f64 {
        self.half_width_m
    }

    /// Heading as given, radians.
    pub fn heading_rad(&self) -> f64 {
        self.heading_rad
    }

    /// Unit vector along the heading.
    pub fn forward(&self) -> Vec2 {
        self.forward
    }

    /// Unit vector to the left of the heading.
    pub fn left(&self) -> Vec2 {
        Vec2::new(-self.forward.y, self.forward.x)
    }

    /// Radius of the circle about the centre that holds the box, metres.
    pub fn radius_m(&self) -> f64 {
        self.radius_m
    }

    /// Area, m2.
    pub fn area_m2(&self) -> f64 {
        4.0 * self.half_length_m * self.half_width_m
    }

    /// The box with every side moved outwards by `margin_m` (inwards when negative, to a line at most).
    pub fn grown(&self, margin_m: f64) -> Self {
        let half_m = (self.half_length_m + margin_m, self.half_width_m + margin_m);
        Self::facing(self.center, half_m, self.heading_rad, self.forward)
    }

    /// The same box about another centre, metres.
    pub fn about(&self, center: Vec2) -> Self {
        Self { center, ..*self }
    }

    /// The box that its motion to another place covers, if the path between them is straight.
    pub fn stretched_to(&self, to: &Self) -> Self {
        let way = to.center - self.center;
        let half_m = (to.half_length_m + 0.5 * way.norm(), to.half_width_m);
        Self::facing(self.center + 0.5 * way, half_m, to.heading_rad, to.forward)
    }

    /// Corners counter-clockwise from the front left: front left, rear left, rear right, front right.
    pub fn corners(&self) -> [Vec2; 4] {
        let (along, across) = (self.forward * self.half_length_m, self.left() * self.half_width_m);
        [
            self.center + along + across,
            self.center - along + across,
            self.center - along - across,
            self.center + along - across,
        ]
    }

    /// Whether the segment between two points and the box share a point.
    pub fn meets_segment(&self, from: Vec2, to: Vec2) -> bool {
        let (from, to) = (self.local(from), self.local(to));
        // The part of the segment that is left after each pair of sides has clipped it.
        let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
        for (start, way, half) in
            [(from.x, to.x - from.x, self.half_length_m), (from.y, to.y - from.y, self.half_width_m)]
        {
            if way == 0.0 {
                if start.abs() > half {
                    return false;
                }
                continue;
            }
            let (a, b) = ((-half - start) / way, (half - start) / way);
            enters = enters.max(a.min(b));
            leaves = leaves.min(a.max(b));
        }
        enters <= leaves
    }

    /// `point` in the frame of the box: x ahead of the centre, y to its left, metres.
    pub fn local(&self, point: Vec2) -> Vec2 {
        self.local_vector(point - self.center)
    }

    fn local_vector(&self, v: Vec2) -> Vec2 {
        Vec2::new(v.dot(&self.forward), v.dot(&self.left()))
    }

    fn world_vector(&self, v: Vec2) -> Vec2 {
        self.forward * v.x + self.left() * v.y
    }

    /// Half extents along x and y of the upright rectangle that holds the box, metres.
    pub fn upright_half_extents(&self) -> Vec2 {
        let (c, s) = (self.forward.x.abs(), self.forward.y.abs());
        let (l, w) = (self.half_length_m, self.half_width_m);
        Vec2::new(c * l + s * w, s * l + c * w)
    }

    /// Signed distance from the box to a point (negative inside, metres) and its gradient in the
    /// frame of the box (a unit vector that points outwards).
    fn distance_local(&self, p: Vec2) -> (f64, Vec2) {
        let (sx, sy) = (1f64.copysign(p.x), 1f64.copysign(p.y));
        let (dx, dy) = (p.x.abs() - self.half_length_m, p.y.abs() - self.half_width_m);
        if dx > 0.0 && dy > 0.0 {
            let d = dx.hypot(dy);
            (d, Vec2::new(sx * dx / d, sy * dy / d))
        } else if dx > dy {
            (dx, Vec2::new(sx, 0.0))
        } else {
            (dy, Vec2::new(0.0, sy))
        }
    }
}

/// Gap between two boxes and the unit vector along which it is least, from `a` towards `b`.
///
/// Positive: the distance between the nearest points. Negative: the depth, which is how far one box must move
/// to separate them. Zero: they touch. Exact for boxes (separating axes for the depth, corners against sides
/// for the distance). Constant cost, some 60 flops when overlapping or far apart.
pub fn gap_and_direction(a: &OrientedBox, b: &OrientedBox) -> (f64, Vec2) {
    let widest = widest_side(a, b);
    if widest.0 <= 0.0 { widest } else { nearest_corner(a, b) }
}

/// Greatest separation over the four side directions and that direction, from `a` towards `b`: the
/// gap itself when not positive, else a lower bound of it.
fn widest_side(a: &OrientedBox, b: &OrientedBox) -> (f64, Vec2) {
    let between = b.center - a.center;
    let (in_a, in_b) = (a.local_vector(between), b.local_vector(between));
    let turn = a.local_vector(b.forward);
    let (c, s) = (turn.x.abs(), turn.y.abs());
    let axes = [
        (in_a.x, a.forward, a.half_length_m + b.half_length_m * c + b.half_width_m * s),
        (in_a.y, a.left(), a.half_width_m + b.half_length_m * s + b.half_width_m * c),
        (in_b.x, b.forward, b.half_length_m + a.half_length_m * c + a.half_width_m * s),
        (in_b.y, b.left(), b.half_width_m + a.half_length_m * s + a.half_width_m * c),
    ];
    let mut best = (f64::NEG_INFINITY, a.forward);
    for (offset, axis, reach) in axes {
        let separation = offset.abs() - reach;
        if separation > best.0 {
            best = (separation, axis * 1f64.copysign(offset));
        }
    }
    best
}

/// Distance of two boxes that are apart: in the plane the nearest points always include a corner.
fn nearest_corner(a: &OrientedBox, b: &OrientedBox) -> (f64, Vec2) {
    let mut best = (f64::INFINITY, Vec2::zeros());
    for (holder, other, sign) in [(a, b, 1.0), (b, a, -1.0)] {
        for corner in other.corners() {
            let (distance, outwards) = holder.distance_local(holder.local(corner));
            if distance < best.0 {
                best = (distance, holder.world_vector(outwards) * sign);
            }
        }
    }
    best
}

/// Gap between two boxes, metres: separation when positive, depth when negative, zero at touch.
///
/// ```
/// use scene::geometry::{Vec2, obb::{OrientedBox, signed_gap}};
/// let car = OrientedBox::new(Vec2::new(0.0, 0.0), 2.0, 1.0, 0.0);
/// let beside = OrientedBox::new(Vec2::new(0.0, 3.5), 2.0, 1.0, 0.0);
/// assert_eq!(signed_gap(&car, &beside), 1.5);
/// let across = OrientedBox::new(Vec2::new(2.5, 0.0), 2.0, 1.0, std::f64::consts::FRAC_PI_2);
/// assert!((signed_gap(&car, &across) + 0.5).abs() < 1e-12); // half a metre deep
/// ```
pub fn signed_gap(a: &OrientedBox, b: &OrientedBox) -> f64 {
    gap_and_direction(a, b).0
}

/// Distance between the bounding circles, metres: never more than [`signed_gap`] for boxes apart.
pub fn circle_gap(a: &OrientedBox, b: &OrientedBox) -> f64 {
    (b.center - a.center).norm() - a.radius_m - b.radius_m
}

/// True when the gap is less than `margin_m`: with zero, the boxes share area (touching does not
/// count); with 0.5, they come closer than half a metre. Far boxes cost one distance.
///
/// ```
/// use scene::geometry::{Vec2, obb::{OrientedBox, overlaps}};
/// let a = OrientedBox::new(Vec2::new(0.0, 0.0), 2.0, 1.0, 0.0);
/// let b = OrientedBox::new(Vec2::new(4.0, 0.0), 2.0, 1.0, 0.0);
/// assert!(!overlaps(&a, &b, 0.0));
/// assert!(overlaps(&a, &b, 0.5));
/// ```
pub fn overlaps(a: &OrientedBox, b: &OrientedBox, margin_m: f64) -> bool {
    let reach = a.radius_m + b.radius_m + margin_m;
    if reach <= 0.0 || (b.center - a.center).norm_squared() >= reach * reach {
        return false;
    }
    let bound = widest_side(a, b).0;
    bound < margin_m && (bound <= 0.0 || nearest_corner(a, b).0 < margin_m)
}

/// Area that two boxes share, m2: `a` clipped by the four sides of `b` (Sutherland and Hodgman 1974).
pub fn shared_area_m2(a: &OrientedBox, b: &OrientedBox) -> f64 {
    if !overlaps(a, b, 0.0) {
        return 0.0;
    }
    // A quadrangle gains at most one corner at each of four cuts.
    let mut ring = [Vec2::zeros(); 8];
    let mut len = 4;
    for (slot, corner) in ring.iter_mut().zip(a.corners()) {
        *slot = b.local(corner);
    }
    let (l, w) = (b.half_length_m, b.half_width_m);
    for (normal, reach) in [(Vec2::x(), l), (-Vec2::x(), l), (Vec2::y(), w), (-Vec2::y(), w)] {
        (ring, len) = clip(&ring[..len], normal, reach);
    }
    let doubled: f64 = (0..len).map(|i| super::cross(ring[i], ring[(i + 1) % len])).sum();
    (0.5 * doubled).max(0.0)
}

/// Keeps the part of a convex ring where `normal . p <= reach`.
fn clip(ring: &[Vec2], normal: Vec2, reach: f64) -> ([Vec2; 8], usize) {
    let (mut kept, mut len) = ([Vec2::zeros(); 8], 0);
    let mut push = |p| {
        if len < kept.len() {
            kept[len] = p;
            len += 1;
        }
    };
    for (i, &p) in ring.iter().enumerate() {
        let q = ring[(i + 1) % ring.len()];
        let (over_p, over_q) = (normal.dot(&p) - reach, normal.dot(&q) - reach);
        if over_p <= 0.0 {
            push(p);
        }
        if (over_p < 0.0 && over_q > 0.0) || (over_p > 0.0 && over_q < 0.0) {
            push(p + (q - p) * (over_p / (over_p - over_q)));
        }
    }
    (kept, len)
}

/// Shared area over joint area (intersection over union), 0 to 1.
///
/// ```
/// use scene::geometry::{Vec2, obb::{OrientedBox, iou}};
/// let a = OrientedBox::new(Vec2::new(0.0, 0.0), 2.0, 1.0, 0.0);
/// let b = OrientedBox::new(Vec2::new(2.0, 0.0), 2.0, 1.0, 0.0);
/// assert!((iou(&a, &b) - 1.0 / 3.0).abs() < 1e-12);
/// ```
pub fn iou(a: &OrientedBox, b: &OrientedBox) -> f64 {
    let shared = shared_area_m2(a, b);
    if shared > 0.0 { shared / (a.area_m2() + b.area_m2() - shared) } else { 0.0 }
}

/// The box moved by `shift` after turning it about the origin by `angle_rad`.
#[cfg(test)]
pub(crate) fn moved(of: &OrientedBox, angle_rad: f64, shift: Vec2) -> OrientedBox {
    let center = super::rotate(of.center, angle_rad) + shift;
    OrientedBox::new(center, of.half_length_m, of.half_width_m, of.heading_rad + angle_rad)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};

    fn car(x: f64, y: f64, heading: f64) -> OrientedBox {
        OrientedBox::new(Vec2::new(x, y), 2.0, 1.0, heading)
    }

    fn any_box() -> impl Strategy<Value = OrientedBox> {
        (-6.0..6.0, -6.0..6.0, 0.2..6.0, 0.2..2.0, -4.0..4.0)
            .prop_map(|(x, y, l, w, h)| OrientedBox::new(Vec2::new(x, y), l, w, h))
    }

    #[test]
    fn pieces_that_pass_through_a_box_or_by_it() {
        let tilted = OrientedBox::new(Vec2::new(3.0, 1.0), 2.0, 1.0, 0.5);
        let at = |x: f64, y: f64| tilted.center() + tilted.forward() * x + tilted.left() * y;
        assert!(tilted.meets_segment(at(-5.0, 0.9), at(5.0, 0.9)), "along it");
        assert!(!tilted.meets_segment(at(-5.0, 1.1), at(5.0, 1.1)), "beside it");
        assert!(tilted.meets_segment(at(0.5, 0.2), at(0.6, 0.3)), "inside it");
        assert!(!tilted.meets_segment(at(2.1, -5.0), at(2.1, 5.0)), "before it");
        assert!(!tilted.meets_segment(at(3.5, 0.0), at(2.5, 0.0)), "ends before it");
        assert!(!tilted.meets_segment(at(3.0, 0.5), at(1.5, 1.6)), "past its corner");
    }

    #[test]
    fn known_gaps() {
        let a = car(0.0, 0.0, 0.0);
        assert_eq!(signed_gap(&a, &car(4.0, 0.0, 0.0)), 0.0);
        assert!(!overlaps(&a, &car(4.0, 0.0, 0.0), 0.0));
        assert_eq!(signed_gap(&a, &car(7.0, 6.0, 0.0)), 5.0); // corner to corner: 3, 4, 5
        assert!((signed_gap(&a, &a) + 2.0).abs() < 1e-12);
        let diamond = OrientedBox::new(Vec2::new(2.0 + SQRT_2 + 0.25, 0.0), 1.0, 1.0, FRAC_PI_4);
        assert!((signed_gap(&a, &diamond) - 0.25).abs() < 1e-12);
        let (gap, towards) = gap_and_direction(&a, &car(0.0, -3.0, FRAC_PI_2 * 2.0));
        assert!((gap - 1.0).abs() < 1e-12 && (towards - Vec2::new(0.0, -1.0)).norm() < 1e-12);
    }

    #[test]
    fn known_overlap_areas() {
        let square = |x, h| OrientedBox::new(Vec2::new(x, 0.0), 1.0, 1.0, h);
        assert!((iou(&square(0.0, 0.0), &square(0.0, 0.0)) - 1.0).abs() < 1e-12);
        // A square and the same square turned by 45 degrees share a regular octagon.
        let octagon = 8.0 * (SQRT_2 - 1.0);
        assert!((shared_area_m2(&square(0.0, 0.0), &square(0.0, FRAC_PI_4)) - octagon).abs() < 1e-12);
        assert_eq!(iou(&square(0.0, 0.0), &square(2.0, 0.0)), 0.0);
    }

    proptest! {
        #[test]
        fn symmetric_and_invariant(a in any_box(), b in any_box(), turn in -4.0..4.0, x in -50.0..50.0) {
            let gap = signed_gap(&a, &b);
            let (am, bm) = (moved(&a, turn, Vec2::new(x, -x)), moved(&b, turn, Vec2::new(x, -x)));
            prop_assert!((gap - signed_gap(&b, &a)).abs() < 1e-9);
            prop_assert!((gap - signed_gap(&am, &bm)).abs() < 1e-9);
            prop_assert!((iou(&a, &b) - iou(&b, &a)).abs() < 1e-9);
            prop_assert!((iou(&a, &b) - iou(&am, &bm)).abs() < 1e-9);
            prop_assert!(circle_gap(&a, &b) <= gap.max(0.0) + 1e-9);
        }

        #[test]
        fn overlap_is_negative_gap(a in any_box(), b in any_box()) {
            let (gap, towards) = gap_and_direction(&a, &b);
            prop_assume!(gap.abs() > 1e-6);
            prop_assert_eq!(overlaps(&a, &b, 0.0), gap < 0.0);
            prop_assert_eq!(iou(&a, &b) > 0.0, gap < 0.0);
            // Moving b by the gap along the direction brings the two to a touch.
            let touching = moved(&b, 0.0, -towards * gap);
            prop_assert!(signed_gap(&a, &touching).abs() < 1e-6);
        }
    }
}
