//! Conditions under which two road users have a near miss at a moment.

use super::mover::{Mover, MoverState};
use crate::geometry::obb::{OrientedBox, circle_gap, overlaps};
use crate::geometry::{Vec2, direction, rotate, wrap_angle};
use crate::score::input::Thresholds;
use crate::{AgentType, STEP_S};
use std::f64::consts::FRAC_PI_6;

/// A road user that always stays within this distance of its first place is parked, metres.
pub(in crate::score) const PARKED_M: f64 = 1.0;
/// Speed below which a vehicle beside pedestrians crawls, m/s: a pedestrian can easily keep clear of it.
const CRAWL_MPS: f64 = 1.5;

/// Gap for passing a parked road user, smaller than for others because cars stand beside every lane, metres.
pub(in crate::score) const BRUSH_M: f64 = 0.15;

/// Lower bound of a gap as a divisor, metres.
pub(super) const LEAST_GAP_M: f64 = 0.05;
/// Cosine of the angle within which a follower has the other ahead of it.
const AHEAD: f64 = 0.7;

/// A collision course of fewer steps is about to end by a turn, so it is no near miss.
const LEAST_COURSE: usize = 3;

/// Reason of a near miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NearMissKind {
    /// The gap: one crosses close to the other.
    Gap,
    /// The course: they would collide if both continued.
    Course,
}

/// The worst moment of a near miss, and the steps of its first and last.
#[derive(Debug)]
pub(super) struct Nearest {
    pub step: usize,
    pub gap: Gap,
    pub first: usize,
    pub last: usize,
    steps: usize,
    crosses: bool,
}

impl Nearest {
    /// Keeps the moment with the least time to collision, then the least gap.
    pub(super) fn keep(near: &mut Option<Self>, step: usize, gap: Gap, kind: NearMissKind) {
        let key = |gap: &Gap| (gap.ttc_s.unwrap_or(f64::INFINITY), gap.gap_m);
        let new = || Self { step, gap, first: step, last: step, steps: 0, crosses: false };
        let near = near.get_or_insert_with(new);
        (near.last, near.steps) = (step, near.steps + 1);
        near.crosses |= kind == NearMissKind::Gap;
        if key(&gap) < key(&near.gap) {
            (near.step, near.gap) = (step, gap);
        }
    }

    /// Whether one crosses close to the other, or the collision course lasts for [`LEAST_COURSE`] steps.
    pub(super) fn lasts(&self) -> bool {
        self.crosses || self.steps >= LEAST_COURSE
    }
}

/// One of the two at a step.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub mover: &'a Mover,
    pub moment: &'a MoverState,
    pub step: usize,
}

impl Side<'_> {
    fn walks(&self) -> bool {
        self.mover.agent_type == AgentType::Pedestrian
    }

    /// Its box after `time_s` at constant speed and turn rate.
    pub(super) fn later(&self, turn_rate_radps: f64, time_s: f64) -> OrientedBox {
        let outline = &self.moment.outline;
        let turned = turn_rate_radps * time_s;
        // Along an arc, the displacement has the direction of the chord, half the turn off.
        let half = 0.5 * turned;
        let chord = if half.abs() < 1e-6 { 1.0 } else { half.sin() / half };
        let center = outline.center() + rotate(self.moment.velocity * (time_s * chord), half);
        let heading = outline.heading_rad() + turned;
        OrientedBox::new(center, outline.half_length_m(), outline.half_width_m(), heading)
    }
}

/// The gap of two boxes at a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub gap_m: f64,
    /// Unit vector from the first to the second.
    pub towards: Vec2,
    /// Time to collision at constant velocity, seconds, if there is one.
    pub ttc_s: Option<f64>,
    /// How fast the gap shrinks, m/s.
    pub closing_mps: f64,
}

/// A near miss: both move (or one stands in the way for a while) and the gap shrinks fast. Either they would
/// collide within the time threshold if both continued, around their bends too, or one crosses close to the
/// other. Generated motion that almost brushes another at speed also counts. Excluded are two walkers, parked
/// cars, wheels that stand or crawl beside people, a road user that passes beside another on its own line,
/// and one that brakes normally behind another.
pub(super) fn near_miss(limits: &Thresholds, a: Side<'_>, b: Side<'_>, gap: &Gap) -> Option<NearMissKind> {
    let made = a.mover.generated || b.mover.generated;
    let parked = a.mover.travel_m < PARKED_M || b.mover.travel_m < PARKED_M;
    let relative_mps = (a.moment.velocity - b.moment.velocity).norm();
    let pass_gap_m = if parked { BRUSH_M.min(limits.pass_gap_m) } else { limits.pass_gap_m };
    let passes = gap.gap_m < pass_gap_m && relative_mps > limits.pass_mps;
    if made && passes && !(a.walks() && b.walks()) {
        return Some(NearMissKind::Gap);
    }
    if parked || a.walks() && b.walks() || gap.closing_mps <= limits.closing_speed_mps {
        return None;
    }
    let crawls = |wheels: Side<'_>, walker: Side<'_>| walker.walks() && wheels.moment.speed_mps <= CRAWL_MPS;
    if crawls(a, b) || crawls(b, a) {
        return None;
    }
    let turn = wrap_angle(a.moment.outline.heading_rad() - b.moment.outline.heading_rad()).abs();
    let needed_mps2 = gap.closing_mps.powi(2) / (2.0 * gap.gap_m.max(LEAST_GAP_M));
    if follows(a.moment, b.moment, gap.towards) && needed_mps2 <= limits.follow_brake_mps2 {
        return None;
    }
    let moves = |side: Side<'_>| side.moment.speed_mps > limits.moving_mps;
    let crosses = (FRAC_PI_6..=5.0 * FRAC_PI_6).contains(&turn);
    let by_gap = gap.gap_m < limits.gap_m && moves(a) && moves(b);
    let by_time = gap.ttc_s.is_some_and(|t| t < limits.ttc_s);
    if by_gap && crosses {
        return Some(NearMissKind::Gap);
    }
    ((by_gap || by_time) && meet_within(a, b, limits.ttc_s)).then_some(NearMissKind::Course)
}

/// Whether one of the two is behind the other in the same direction.
pub(super) fn follows(a: &MoverState, b: &MoverState, towards: Vec2) -> bool {
    let turn = wrap_angle(a.outline.heading_rad() - b.outline.heading_rad()).abs();
    turn < FRAC_PI_6 && towards.dot(&direction(a.outline.heading_rad())).abs() > AHEAD
}

/// Whether the two touch within this time at constant speeds and turn rates.
pub(super) fn meet_within(a: Side<'_>, b: Side<'_>, time_s: f64) -> bool {
    meeting_s(a, b, time_s).is_some()
}

/// Seconds until the two touch at constant speeds and turn rates, at most `time_s`; checked step by step.
pub(super) fn meeting_s(a: Side<'_>, b: Side<'_>, time_s: f64) -> Option<f64> {
    let (of_a, of_b) = (a.mover.turn_rate_radps(a.step), b.mover.turn_rate_radps(b.step));
    let both_m = (a.moment.speed_mps + b.moment.speed_mps) * STEP_S;
    let last = (time_s / STEP_S).ceil() as usize;
    let mut step = 0;
    while step <= last {
        let later_s = (step as f64 * STEP_S).min(time_s);
        let (later_a, later_b) = (a.later(of_a, later_s), b.later(of_b, later_s));
        if overlaps(&later_a, &later_b, 0.0) {
            return Some(later_s);
        }
        // Two separate boxes cannot touch before they have covered the gap, so those steps are skipped.
        let apart_m = circle_gap(&later_a, &later_b).max(0.0);
        step = step.saturating_add(((apart_m / both_m) as usize).max(1));
    }
    None
}
