//! A fast overlap test of two motions, for the thousands of pairs in the choice of futures.

use super::input::Thresholds;
use super::pairs::{BRUSH_M, PARKED_M};
use crate::geometry::obb::{OrientedBox, circle_gap, gap_and_direction, overlaps};
use crate::geometry::{Extent, Vec2, rotate, wrap_angle};
use crate::{Size, State};
use std::f64::consts::FRAC_PI_6;
use std::sync::OnceLock;

/// "Close" boxes are nearer than this, metres.
pub const CLOSE_M: f64 = 0.5;
/// Boxes per bounding rectangle.
const CHUNK: usize = 8;

/// Rectangle around these boxes.
fn extent_of(boxes: &[Option<OrientedBox>]) -> Extent {
    boxes.iter().flatten().fold(Extent::NONE, |extent, b| {
        let half = b.upright_half_extents();
        extent.joined(&Extent { low: b.center() - half, high: b.center() + half })
    })
}

/// Bounding rectangles of the boxes of one or several motions: over all moments, and over every eight.
#[derive(Clone, Debug)]
pub struct SweptBounds {
    whole: Extent,
    chunks: Vec<Extent>,
}

impl SweptBounds {
    /// Bounds around all of these motions.
    pub fn about<'a>(motions: impl IntoIterator<Item = &'a SweptBoxes>) -> Self {
        let mut all = Self { whole: Extent::NONE, chunks: Vec::new() };
        for Self { whole, chunks } in motions.into_iter().map(|motion| &motion.bounds) {
            all.whole = all.whole.joined(whole);
            all.chunks.resize(all.chunks.len().max(chunks.len()), Extent::NONE);
            all.chunks.iter_mut().zip(chunks).for_each(|(all, one)| *all = all.joined(one));
        }
        all
    }

    /// False if no two of the motions come nearer than this, metres.
    pub fn may_come_within(&self, other: &Self, margin_m: f64) -> bool {
        self.near_chunks(other, margin_m).next().is_some()
    }

    /// The groups of eight moments whose rectangles are nearer than this, metres.
    fn near_chunks(&self, other: &Self, margin_m: f64) -> impl Iterator<Item = usize> {
        let possible = self.whole.is_near(&other.whole, margin_m);
        let chunks = self.chunks.iter().zip(&other.chunks).take_while(move |_| possible).enumerate();
        chunks.filter(move |(_, (a, b))| a.is_near(b, margin_m)).map(|(chunk, _)| chunk)
    }
}

/// The boxes of one motion at common moments (every third step in the choice of futures).
#[derive(Clone, Debug)]
pub struct SweptBoxes {
    boxes: Vec<Option<OrientedBox>>,
    bounds: SweptBounds,
    /// One per moment, computed for the first comparison that needs them.
    motions: OnceLock<Box<[Option<BoxMotion>]>>,
    /// Diagonal of the first box's upright rectangle, metres.
    extent_m: f64,
    /// Greatest speed between two moments of [`MOMENT_S`], m/s.
    top_mps: f64,
}

impl SweptBoxes {
    /// From one box per moment; `None` while the road user is absent.
    pub fn new(boxes: Vec<Option<OrientedBox>>) -> Self {
        let whole = extent_of(&boxes);
        let bounds = SweptBounds { whole, chunks: boxes.chunks(CHUNK).map(extent_of).collect() };
        let extent_m = boxes.iter().flatten().next().map_or(0.0, |b| 2.0 * b.upright_half_extents().norm());
        let moved = |w: &[Option<OrientedBox>]| match w {
            [Some(from), Some(to)] => (to.center() - from.center()).norm(),
            _ => 0.0,
        };
        let top_mps = boxes.windows(2).map(moved).fold(0.0, f64::max) / MOMENT_S;
        Self { boxes, bounds, motions: OnceLock::new(), extent_m, top_mps }
    }

    /// From states at those moments.
    pub fn of_states<'a>(states: impl IntoIterator<Item = Option<&'a State>>, size: &Size) -> Self {
        Self::new(states.into_iter().map(|s| s.map(|s| OrientedBox::of_state(s, size))).collect())
    }

    /// Box at a moment.
    pub fn at(&self, moment: usize) -> Option<&OrientedBox> {
        self.boxes.get(moment)?.as_ref()
    }

    /// Number of moments.
    pub fn len(&self) -> usize {
        self.boxes.len()
    }

    /// Whether there are no moments.
    pub fn is_empty(&self) -> bool {
        self.boxes.is_empty()
    }
}

/// How two motions meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Overlap {
    /// Whether the boxes share area at some moment.
    pub overlaps: bool,
    /// Whether the boxes come nearer than [`CLOSE_M`] at some moment; true whenever `overlaps` is.
    pub close: bool,
}

/// Seconds between two moments of the swept boxes.
const MOMENT_S: f64 = 0.3;
/// Time headway below which an agent follows too closely, seconds: three moments.
const HEADWAY_S: f64 = 0.9;
/// Speed up to which a short headway is that of a queue, m/s.
const FOLLOWS_MPS: f64 = 3.0;
/// Half length below which a box is a walker's: two walkers have no near misses, metres.
const WALKER_M: f64 = 0.6;
/// Times ahead at which courses are checked, seconds.
const LOOKS_S: [f64; 5] = [0.3, 0.6, 0.9, 1.2, 1.5];

/// Motion of a box at a moment.
#[derive(Clone, Copy, Debug)]
struct BoxMotion {
    /// Metres per second.
    velocity: Vec2,
    turn_radps: f64,
}

impl BoxMotion {
    /// By moment, from the previous one; `None` if the road user is absent at one of the two.
    fn each(boxes: &[Option<OrientedBox>]) -> Box<[Option<Self>]> {
        let between = |w: &[Option<OrientedBox>]| {
            let (before, now) = w[0].as_ref().zip(w[1].as_ref())?;
            let velocity = (now.center() - before.center()) / MOMENT_S;
            let turn_radps = wrap_angle(now.heading_rad() - before.heading_rad()) / MOMENT_S;
            Some(Self { velocity, turn_radps })
        };
        std::iter::once(None).chain(boxes.windows(2).map(between)).collect()
    }
}

/// A box that continues at constant velocity.
struct Going<'a> {
    outline: &'a OrientedBox,
    velocity: Vec2,
    turn_radps: f64,
}

impl<'a> Going<'a> {
    fn at(motion: &'a SweptBoxes, moment: usize) -> Option<Self> {
        let each = motion.motions.get_or_init(|| BoxMotion::each(&motion.boxes));
        let BoxMotion { velocity, turn_radps } = (*each.get(moment)?)?;
        Some(Self { outline: motion.at(moment)?, velocity, turn_radps })
    }

    fn later(&self, time_s: f64) -> OrientedBox {
        let turned = self.turn_radps * time_s;
        let center = self.outline.center() + rotate(self.velocity * time_s, 0.5 * turned);
        let heading = self.outline.heading_rad() + turned;
        OrientedBox::new(center, self.outline.half_length_m(), self.outline.half_width_m(), heading)
    }

    /// Whether they pass each other at speed within the gap for parked vehicles.
    fn brushes(&self, other: &Self, limits: &Thresholds) -> bool {
        let is_fast = (self.velocity - other.velocity).norm() > limits.pass_mps;
        let brush_m = BRUSH_M.min(limits.pass_gap_m);
        is_fast && gap_and_direction(self.outline, other.outline).0 < brush_m
    }

    /// Whether they pass or cross within the gap of a near miss, or would soon touch if both continued. The
    /// latter does not count if easy braking of a follower prevents it.
    fn threatens(&self, other: &Self, limits: &Thresholds) -> bool {
        let relative = self.velocity - other.velocity;
        let speed = relative.norm();
        let least_mps = limits.closing_speed_mps;
        if speed <= least_mps || circle_gap(self.outline, other.outline) > limits.ttc_s * speed {
            return false;
        }
        let (gap_m, towards) = gap_and_direction(self.outline, other.outline);
        let closing = relative.dot(&towards);
        let turn = wrap_angle(self.outline.heading_rad() - other.outline.heading_rad()).abs();
        let follows = turn < FRAC_PI_6 && towards.dot(&self.outline.forward()).abs() > 0.7;
        // Scores check three times as often: a passing or crossing pair may be nearer between two moments.
        let least_m = if follows { gap_m } else { gap_m - 0.5 * MOMENT_S * closing.abs() };
        if least_m < limits.pass_gap_m && speed > limits.pass_mps {
            return true;
        }
        if closing <= least_mps {
            return false;
        }
        if follows && closing * closing / (2.0 * gap_m.max(0.05)) <= limits.follow_brake_mps2 {
            return false;
        }
        let crosses = (FRAC_PI_6..=5.0 * FRAC_PI_6).contains(&turn);
        let moves = |one: &Self| one.velocity.norm() > limits.moving_mps;
        if crosses && least_m < limits.gap_m && moves(self) && moves(other) {
            return true;
        }
        LOOKS_S.iter().any(|t| overlaps(&self.later(*t), &other.later(*t), 0.0))
    }
}

/// Moments at which two motions pass or cross too near, or would soon touch at their present velocities. They
/// are near misses of scores, tested on the boxes of the choice.
pub fn dangerous_moments<'a>(a: &'a SweptBoxes, b: &'a SweptBoxes) -> impl Iterator<Item = usize> + 'a {
    let walks =
        |m: &SweptBoxes| m.boxes.iter().flatten().next().is_some_and(|b| b.half_length_m() < WALKER_M);
    let stays = |m: &SweptBoxes| m.bounds.whole.size().norm() < m.extent_m + PARKED_M;
    let (parked, both_walk) = (stays(a) || stays(b), walks(a) && walks(b));
    let limits = Thresholds::default();
    let margin_m = if parked { BRUSH_M } else { limits.ttc_s * (a.top_mps + b.top_mps) };
    let moments = near_moments(a, b, margin_m).take_while(move |_| !both_walk);
    moments.filter(move |&i| {
        let pair = Going::at(a, i).zip(Going::at(b, i));
        pair.is_some_and(|(a, b)| if parked { a.brushes(&b, &limits) } else { a.threatens(&b, &limits) })
    })
}

/// Moments at which a motion follows another one by less than [`HEADWAY_S`]: within that time, it passes the place
/// where the other one's box is now. Both head alike, and the one behind is not slow. A headway that is short from
/// the start on does not count until it has been longer.
pub fn tailgating_moments<'a>(
    behind: &'a SweptBoxes,
    ahead: &'a SweptBoxes,
) -> impl Iterator<Item = usize> + 'a {
    let later = (HEADWAY_S / MOMENT_S).round() as usize;
    let short = near_moments(behind, ahead, HEADWAY_S * behind.top_mps).filter(move |&i| {
        let (Some(now), Some(then), Some(leader)) = (behind.at(i), behind.at(i + later), ahead.at(i)) else {
            return false;
        };
        let follows = (leader.center() - now.center()).dot(&now.forward()) > 0.0;
        let turn = wrap_angle(then.heading_rad() - leader.heading_rad()).abs();
        let moved_m = (then.center() - now.center()).norm();
        let passes = |w: &[Option<OrientedBox>]| match w {
            [Some(from), Some(to)] => overlaps(&from.stretched_to(to), leader, 0.0),
            _ => false,
        };
        let ahead_of_it = moved_m > HEADWAY_S * FOLLOWS_MPS && follows && turn < FRAC_PI_6;
        ahead_of_it && behind.boxes[i..=i + later].windows(2).any(passes)
    });
    let from_start = short.enumerate().skip_while(|(count, moment)| count == moment);
    from_start.map(|(_, moment)| moment)
}

/// The moments of the groups in which two motions may be nearer than this, metres.
fn near_moments<'a>(a: &'a SweptBoxes, b: &'a SweptBoxes, margin_m: f64) -> impl Iterator<Item = usize> + 'a {
    let end = a.len().min(b.len());
    let chunks = a.bounds.near_chunks(&b.bounds, margin_m);
    chunks.flat_map(move |chunk| chunk * CHUNK..((chunk + 1) * CHUNK).min(end))
}

/// Whether two motions come nearer than this at some moment, metres.
pub fn comes_within(a: &SweptBoxes, b: &SweptBoxes, margin_m: f64) -> bool {
    let near = |i: usize| a.at(i).zip(b.at(i)).is_some_and(|(p, q)| overlaps(p, q, margin_m));
    near_moments(a, b, margin_m).any(near)
}

/// Overlap of two motions at their common moments. Motions with separate bounding rectangles cost four
/// comparisons; crossing ones about a microsecond.
///
/// ```
/// use scene::geometry::{Vec2, obb::OrientedBox};
/// use scene::score::{Overlap, SweptBoxes, overlap};
/// let row = |y: f64, speed: f64| {
///     let at = |i| Some(OrientedBox::new(Vec2::new(i as f64 * 0.3 * speed, y), 2.3, 1.0, 0.0));
///     SweptBoxes::new((0..31).map(at).collect())
/// };
/// let beside = overlap(&row(0.0, 10.0), &row(2.3, 10.0));
/// assert_eq!(beside, Overlap { overlaps: false, close: true });
/// ```
pub fn overlap(a: &SweptBoxes, b: &SweptBoxes) -> Overlap {
    let mut found = Overlap::default();
    for (p, q) in near_moments(a, b, CLOSE_M).filter_map(|i| a.at(i).zip(b.at(i))) {
        if overlaps(p, q, 0.0) {
            return Overlap { overlaps: true, close: true };
        }
        found.close = found.close || overlaps(p, q, CLOSE_M);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn straight(from: (f64, f64), heading: f64, speed: f64) -> SweptBoxes {
        let forward = crate::geometry::direction(heading);
        let start = Vec2::new(from.0, from.1);
        let at = |i: usize| OrientedBox::new(start + forward * (speed * 0.3 * i as f64), 2.3, 1.0, heading);
        SweptBoxes::new((0..31).map(|i| Some(at(i))).collect())
    }

    #[test]
    fn known_meetings() {
        let east = straight((0.0, 0.0), 0.0, 10.0);
        let north_through = straight((45.0, -45.0), std::f64::consts::FRAC_PI_2, 10.0);
        let north_late = straight((45.0, -85.0), std::f64::consts::FRAC_PI_2, 10.0);
        let beside = straight((0.0, 2.4), 0.0, 10.0);
        let far = straight((0.0, 50.0), 0.0, 10.0);
        let meetings = [north_through, north_late, beside, far].map(|other| overlap(&east, &other));
        let pairs = meetings.map(|o| (o.overlaps, o.close));
        assert_eq!(pairs, [(true, true), (false, false), (false, true), (false, false)]);
    }

    #[test]
    fn dangerous_is_what_scores_call_a_near_miss() {
        let dangers = |a: &SweptBoxes, b: &SweptBoxes| dangerous_moments(a, b).count();
        let east = straight((0.0, 0.0), 0.0, 10.0);
        let beside = |y_m: f64, speed: f64| straight((0.0, y_m), 0.0, speed);
        assert!(dangers(&east, &beside(2.3, 5.0)) > 0, "0.3 m beside it, 5 m/s slower");
        assert_eq!(dangers(&east, &beside(2.3, 9.0)), 0, "0.3 m beside it, 1 m/s slower");
        assert_eq!(dangers(&east, &beside(2.6, 5.0)), 0, "0.6 m beside it");
        // A parked car is only brushed.
        assert!(dangers(&east, &straight((20.0, 2.1), 0.0, 0.0)) > 0);
        assert_eq!(dangers(&east, &straight((20.0, 2.3), 0.0, 0.0)), 0);
    }

    #[test]
    fn tailgating_is_a_headway_below_its_limit() {
        let tails = |a: &SweptBoxes, b: &SweptBoxes| tailgating_moments(a, b).count();
        let east = straight((0.0, 0.0), 0.0, 10.0);
        // From the tenth moment on in the lane of `east`, if `y_m` is zero.
        let cuts_in = |gap_m: f64, y_m: f64, speed: f64| {
            let at = |i: usize| {
                let (x_m, aside_m) = (4.6 + gap_m + 0.3 * speed * i as f64, if i < 10 { 3.5 } else { y_m });
                Some(OrientedBox::new(Vec2::new(x_m, aside_m), 2.3, 1.0, 0.0))
            };
            SweptBoxes::new((0..31).map(at).collect())
        };
        // At the last three moments nothing is known of the time after.
        assert_eq!(tails(&east, &cuts_in(8.9, 0.0, 10.0)), 18, "0.89 s");
        assert_eq!(tails(&east, &cuts_in(9.1, 0.0, 10.0)), 0, "0.91 s");
        assert_eq!(tails(&cuts_in(8.9, 0.0, 10.0), &east), 0, "the leader");
        assert_eq!(tails(&east, &cuts_in(5.0, 2.5, 10.0)), 0, "in the next lane");
        assert_eq!(tails(&east, &straight((10.0, 0.0), 0.0, 10.0)), 0, "as before");
        let slow = straight((0.0, 0.0), 0.0, 2.5);
        assert_eq!(tails(&slow, &cuts_in(1.0, 0.0, 2.5)), 0, "in a queue");
        let crossing = straight((45.0, -38.0), std::f64::consts::FRAC_PI_2, 10.0);
        assert_eq!(tails(&east, &crossing), 0, "across");
    }

    #[test]
    fn absent_moments_do_not_meet() {
        let east = straight((0.0, 0.0), 0.0, 10.0);
        let gone = SweptBoxes::new(vec![None; 31]);
        assert_eq!(overlap(&east, &gone), Overlap::default());
        assert_eq!(overlap(&east, &SweptBoxes::new(Vec::new())), Overlap::default());
    }
}
