//! Interactions of two road users: collisions, near misses, smallest gap, smallest time to collision.

mod company;
mod log;
mod measures;
mod mover;
mod near;
mod tally;

use super::input::{Actor, Exclude, ScoreInput};
use super::report::{BoxOverlap, Collision, Encounter, EncounterKind, NearMiss, time_of};
use crate::geometry::Vec2;
use crate::geometry::obb::{OrientedBox, circle_gap, gap_and_direction, iou, overlaps, shared_area_m2};
use crate::geometry::ttc::{LOOK_AHEAD_S, time_to_collision};
pub use log::{SAME_GAP_M, SAME_S};
pub use measures::Measures;
pub(crate) use mover::{Mover, MoverBounds, MoverState};
pub(super) use near::{BRUSH_M, PARKED_M};
use near::{Gap, Nearest, Side, near_miss};
pub(super) use tally::PairTally;

/// Moments checked per step, including the step itself.
pub const SUBSTEPS: usize = 4;

/// Totals over the pairs of one road user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairTotals {
    /// Its collisions that are not in the log.
    pub collisions: usize,
    /// Its near misses that are not in the log.
    pub near_misses: usize,
    /// Its overlaps below the collision threshold that the log does not contain.
    pub light_overlaps: usize,
    /// Its collisions that the log contains too.
    pub logged_collisions: usize,
    /// Whether its box overlaps another's at a step, however little.
    pub overlaps: bool,
    /// Smallest time to collision, seconds.
    pub min_ttc_s: Option<f64>,
    /// The other road user of that pair, by index in the input.
    pub min_ttc_with: Option<usize>,
    /// Least gap, metres.
    pub min_distance_m: Option<f64>,
    /// Least post-encroachment time, seconds.
    pub pet_s: Option<f64>,
}

/// Results of all pairs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairScores {
    /// At most one per pair, in pair order.
    pub collisions: Vec<Collision>,
    /// At most one per pair, in pair order.
    pub overlaps: Vec<BoxOverlap>,
    /// At most one per pair, in pair order.
    pub near_misses: Vec<NearMiss>,
    /// One per pair with any of these events, in pair order.
    pub encounters: Vec<Encounter>,
    /// By road user, in input order.
    pub agents: Vec<PairTotals>,
}

/// Results of one pair.
#[derive(Debug, Default)]
struct Pair {
    min_ttc_s: Option<f64>,
    min_distance_m: Option<f64>,
    overlaps: bool,
    touch: Option<Touch>,
    collision: Option<Contact>,
    near: Option<Nearest>,
}

/// An overlap of the boxes of a pair whose contact counts, at one or more steps.
#[derive(Debug)]
struct Touch {
    /// First step, from the first scored one.
    first: usize,
    /// Greatest depth, metres.
    depth_m: f64,
}

impl Touch {
    fn keep(touch: &mut Option<Self>, step: usize, depth_m: f64) {
        let touch = touch.get_or_insert(Self { first: step, depth_m });
        touch.depth_m = touch.depth_m.max(depth_m);
    }
}

/// A collision. Times are in steps from the first scored one.
#[derive(Debug)]
struct Contact {
    /// First and last moment above the threshold.
    first: f64,
    last: f64,
    /// Relative speed at the first moment, m/s.
    closing_mps: f64,
    /// Greatest intersection over union.
    iou: f64,
}

/// Known smallest gap and time of both road users: larger values do not change the score of the pair.
#[derive(Clone, Copy, Debug)]
struct PairBounds {
    gap_m: f64,
    ttc_s: f64,
}

impl PairBounds {
    /// Any value may change the score.
    const NOTHING: Self = Self { gap_m: f64::INFINITY, ttc_s: LOOK_AHEAD_S };
}

/// Scores all pairs that the input selects.
pub fn score_pairs(input: &ScoreInput<'_>) -> PairScores {
    let movers: Vec<Mover> = input.actors.iter().map(|a| Mover::new(a, input.steps.clone())).collect();
    let movers: Vec<&Mover> = movers.iter().collect();
    PairTally::of_all(input, &movers).scores(input)
}

/// How two motions meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Meeting {
    /// As [`Collision`].
    Collision { time_s: f64, iou: f64, closing_speed_mps: f64 },
    /// As [`BoxOverlap`].
    Overlap { time_s: f64, depth_m: f64 },
    /// As [`NearMiss`].
    Near { time_s: f64, distance_m: f64, ttc_s: Option<f64>, closing_speed_mps: f64 },
}

impl Meeting {
    fn kind(&self) -> EncounterKind {
        match self {
            Self::Collision { .. } => EncounterKind::Collision,
            Self::Overlap { .. } => EncounterKind::Overlap,
            Self::Near { .. } => EncounterKind::NearMiss,
        }
    }

    /// Scene time, seconds.
    fn time_s(&self) -> f64 {
        let (Self::Collision { time_s, .. } | Self::Overlap { time_s, .. } | Self::Near { time_s, .. }) =
            self;
        *time_s
    }

    fn of(pair: &Pair, first_step: usize) -> Option<Self> {
        let scene_time = |step: f64| time_of(first_step as f64 + step);
        if let Some(Contact { first, iou, closing_mps: closing_speed_mps, .. }) = pair.collision {
            return Some(Self::Collision { time_s: scene_time(first), iou, closing_speed_mps });
        }
        if let Some(Touch { first, depth_m }) = pair.touch {
            return Some(Self::Overlap { time_s: scene_time(first as f64), depth_m });
        }
        let Nearest { step, gap, .. } = pair.near.as_ref()?;
        let (distance_m, ttc_s, closing_speed_mps) = (gap.gap_m, gap.ttc_s, gap.closing_mps);
        Some(Self::Near { time_s: scene_time(*step as f64), distance_m, ttc_s, closing_speed_mps })
    }

    /// Whether two motions with these bounds come near enough for an interaction.
    pub(crate) fn is_possible(input: &ScoreInput<'_>, a: &MoverBounds, b: &MoverBounds) -> bool {
        !a.stay_apart(b, input.thresholds.near_gap_m())
    }

    /// The interaction of two motions regardless of who generated them, without events that the log contains.
    /// `input` gives thresholds and exclusions.
    pub(crate) fn between(
        input: &ScoreInput<'_>,
        (a, mover_a): (&Actor<'_>, &Mover),
        (b, mover_b): (&Actor<'_>, &Mover),
    ) -> Option<Self> {
        // Only collisions and near misses are needed, so these bounds skip the search for smallest gap and
        // time.
        let known = PairBounds { gap_m: input.thresholds.near_gap_m(), ttc_s: input.thresholds.ttc_s };
        if !Self::is_possible(input, &mover_a.bounds, &mover_b.bounds) {
            return None;
        }
        let pair = look_at(input, mover_a, mover_b, known);
        let met = Self::of(&pair, input.steps.start)?;
        let known = is_excluded(input, a, b) || log::is_in_log(input, a, b, &pair);
        (!known).then_some(met)
    }
}

/// Whether the pair is excluded: the log shows it overlapping, or it is a truck and its trailer.
pub(super) fn is_excluded(input: &ScoreInput<'_>, a: &Actor<'_>, b: &Actor<'_>) -> bool {
    let (Some(log_a), Some(log_b)) = (a.log, b.log) else { return false };
    let mut logged = input.steps.clone().filter_map(|step| {
        let boxes = (log_a.at(step)?, log_b.at(step)?);
        Some((OrientedBox::of_state(boxes.0, &a.size), OrientedBox::of_state(boxes.1, &b.size)))
    });
    if input.exclude == Exclude::Nothing {
        return false;
    }
    let Some((p, q)) = logged.next() else { return false };
    let overlap = |(p, q): (OrientedBox, OrientedBox)| overlaps(&p, &q, 0.0);
    // A truck and its trailer are always adjacent, so few pairs need the expensive check.
    let hitched = || log::logged(input, a, b).is_some_and(|(p, q)| company::are_hitched(&p, &q));
    overlap((p, q))
        || (input.exclude == Exclude::OverlapInLog && logged.any(overlap))
        || (circle_gap(&p, &q) <= 0.0 && hitched())
}

/// Steps through the motions of a pair.
fn look_at(input: &ScoreInput<'_>, a: &Mover, b: &Mover, known: PairBounds) -> Pair {
    let limits = &input.thresholds;
    let mut pair = Pair::default();
    let travels = a.travel_m >= PARKED_M || b.travel_m >= PARKED_M;
    let mut next = 0;
    for (step, (p, q)) in a.moments.iter().zip(&b.moments).enumerate() {
        let (Some(p), Some(q)) = (p, q) else { continue };
        if step < next {
            continue;
        }
        let moving = p.speed_mps > limits.moving_mps || q.speed_mps > limits.moving_mps;
        let apart = circle_gap(&p.outline, &q.outline);
        // The gap matters if it can be a new minimum, a near miss, or a collision before the next step.
        let gap_m = known.gap_m.min(pair.min_distance_m.unwrap_or(f64::INFINITY)).max(limits.near_gap_m());
        let horizon_s = known.ttc_s.min(pair.min_ttc_s.unwrap_or(LOOK_AHEAD_S)).max(limits.ttc_s);
        let displacement_m = a.max_displacement_m + b.max_displacement_m;
        let matter_m = gap_m.max(displacement_m).max((a.top_mps + b.top_mps) * horizon_s);
        if apart > matter_m + displacement_m {
            // Nothing matters until the two have come that near. Two that stand never come nearer: the
            // quotient is infinite then.
            next = step.saturating_add(((apart - matter_m) / displacement_m) as usize);
            continue;
        }
        let matters = apart < gap_m.max(p.displacement_m.unwrap_or(0.0) + q.displacement_m.unwrap_or(0.0));
        let (gap, towards) =
            if matters { gap_and_direction(&p.outline, &q.outline) } else { (apart, Vec2::zeros()) };
        let ttc_s = if moving { ttc(p, q, horizon_s) } else { None };
        if matters {
            pair.overlaps |= gap < 0.0;
            let touches = gap < 0.0 && !belong_together(a, b, step);
            if touches {
                Touch::keep(&mut pair.touch, step, -gap);
            }
            if touches || (travels && gap >= 0.0) {
                pair.min_distance_m = least(pair.min_distance_m, Some(gap));
            }
            collide(&mut pair, input, (a, b), step, gap);
        }
        pair.min_ttc_s = least(pair.min_ttc_s, ttc_s);
        if ttc_s.is_some_and(|t| t < limits.ttc_s) || (matters && gap < limits.near_gap_m()) {
            let (gap, towards) =
                if matters { (gap, towards) } else { gap_and_direction(&p.outline, &q.outline) };
            let closing = (p.velocity - q.velocity).dot(&towards);
            let ttc_s = if moving { ttc(p, q, LOOK_AHEAD_S) } else { None };
            let gap = Gap { gap_m: gap, towards, ttc_s, closing_mps: closing };
            let side = |mover, moment| Side { mover, moment, step };
            if let Some(kind) = near_miss(limits, side(a, p), side(b, q), &gap) {
                Nearest::keep(&mut pair.near, step, gap, kind);
            }
        }
    }
    pair.near = pair.near.filter(Nearest::lasts);
    if pair.collision.is_some() {
        // Two that brush each other between two steps have no collision course at either step.
        pair.min_ttc_s = Some(0.0);
    }
    pair
}

pub(super) fn ttc(p: &MoverState, q: &MoverState, horizon_s: f64) -> Option<f64> {
    time_to_collision(&p.outline, p.velocity, &q.outline, q.velocity, horizon_s)
}

/// Checks for collisions from this step to just before the next.
fn collide(pair: &mut Pair, input: &ScoreInput<'_>, (a, b): (&Mover, &Mover), step: usize, gap: f64) {
    let displacement_m = |m: &Mover| m.moments.get(step)?.as_ref()?.displacement_m;
    let displacement = displacement_m(a).zip(displacement_m(b)).map(|(p, q)| p + q);
    let moments = if gap > displacement.unwrap_or(0.0) {
        return;
    } else if displacement.is_some() {
        SUBSTEPS
    } else {
        1
    };
    for sub in 0..moments {
        let part = sub as f64 / SUBSTEPS as f64;
        let (Some(p), Some(q)) = (a.between(step, part), b.between(step, part)) else { return };
        let shared = shared_area_m2(&p, &q);
        if shared <= 0.0 {
            continue;
        }
        let share = iou(&p, &q);
        let covered = shared / p.area_m2().min(q.area_m2()).max(1e-9);
        let collides = share > input.thresholds.iou || covered > input.thresholds.covered_share;
        let moment = step as f64 + part;
        if let Some(contact) = &mut pair.collision {
            contact.iou = contact.iou.max(share);
            contact.last = if collides { moment } else { contact.last };
        } else if collides && !belong_together(a, b, step) {
            let closing_mps = impact_mps(a, b, step);
            pair.collision = Some(Contact { first: moment, last: moment, closing_mps, iou: share });
        }
    }
}

/// Whether contact of the two means nothing: pedestrians in company, or recorded cars that both stay parked.
pub(super) fn belong_together(a: &Mover, b: &Mover, step: usize) -> bool {
    let parked = |m: &Mover| !m.generated && m.travel_m < PARKED_M;
    parked(a) && parked(b) || company::walk_together(a, b, step)
}

/// Relative speed at a step, m/s.
fn impact_mps(a: &Mover, b: &Mover, step: usize) -> f64 {
    match (a.moments.get(step), b.moments.get(step)) {
        (Some(Some(p)), Some(Some(q))) => (p.velocity - q.velocity).norm(),
        _ => 0.0,
    }
}

pub(super) fn least(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests;
