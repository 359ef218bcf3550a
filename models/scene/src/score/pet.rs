//! Post-encroachment time: the time between two road users on the same ground where their paths cross (Allen,
//! Shin and Cooper 1978).

use super::pairs::{Mover, MoverState};
use crate::geometry::obb::overlaps;
use crate::geometry::{Extent, Vec2, cross};
use crate::{AgentType, STEP_S};

/// Paths that meet at less than this angle merge or follow, and do not cross: 20 degrees.
pub const LEAST_ANGLE_RAD: f64 = 0.349;
/// A road user that travels less has no post-encroachment time, metres.
pub const LEAST_TRAVEL_M: f64 = 2.0;
/// Steps between the points of the coarse paths.
const COARSE: usize = 3;
/// Pieces of a coarse path per bound.
const PIECES: usize = 8;

/// The crossing of two paths with the smallest time between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Encroachment {
    /// Post-encroachment time, seconds.
    pub pet_s: f64,
    /// Crossing of the paths of the centres.
    pub point: Vec2,
    /// Whether the second one is first; `None` if both arrive at once.
    pub b_first: Option<bool>,
}

/// Seconds between one road user leaving a piece of ground and the other arriving there, where the paths of
/// their centres cross. It is the minimum over all crossings, zero if both are there at once, to one step.
/// `None` if the paths do not cross, for two walkers, and for road users that stay within 2 m.
///
/// It is the smallest time shift that makes the boxes overlap near the crossing. For crossings at right
/// angles this equals the classic "second enters the shared area after the first has left it".
pub(super) fn post_encroachment_s(a: &Mover, b: &Mover) -> Option<f64> {
    encroachment(a, b).map(|crossing| crossing.pet_s)
}

/// As [`post_encroachment_s`], with the place and the road user that is there first.
pub(super) fn encroachment(a: &Mover, b: &Mover) -> Option<Encroachment> {
    let walkers = a.agent_type == AgentType::Pedestrian && b.agent_type == AgentType::Pedestrian;
    if walkers || a.travel_m < LEAST_TRAVEL_M || b.travel_m < LEAST_TRAVEL_M || !places_meet(a, b) {
        return None;
    }
    let mut least: Option<(usize, PathCrossing)> = None;
    for crossing in crossings(&coarse(a), &coarse(b)) {
        let known = least.map_or(usize::MAX, |(steps, _)| steps);
        if let Some(steps) = least_shift(a, b, &crossing, known).filter(|steps| *steps < known) {
            least = Some((steps, crossing));
        }
    }
    least.map(|(steps, PathCrossing { point, step_a, step_b })| Encroachment {
        pet_s: steps as f64 * STEP_S,
        point,
        b_first: (step_a != step_b).then_some(step_b < step_a),
    })
}

fn places_meet(a: &Mover, b: &Mover) -> bool {
    let (Some((ca, ha)), Some((cb, hb))) = (a.bounds.places, b.bounds.places) else { return false };
    let apart = (ca - cb).abs() - ha - hb;
    apart.x < 0.0 && apart.y < 0.0
}

/// Centres at every third seen step, with the steps.
fn coarse(mover: &Mover) -> Vec<(usize, Vec2)> {
    let seen: Vec<(usize, Vec2)> = mover
        .moments
        .iter()
        .enumerate()
        .filter_map(|(i, m)| Some((i, m.as_ref()?.outline.center())))
        .collect();
    let last = seen.len().saturating_sub(1);
    let kept = |k: usize| k.is_multiple_of(COARSE) || k == last;
    seen.into_iter().enumerate().filter(|(k, _)| kept(*k)).map(|(_, p)| p).collect()
}

/// Crossing of two paths, and the step at which each road user is there.
#[derive(Clone, Copy, Debug)]
struct PathCrossing {
    point: Vec2,
    step_a: usize,
    step_b: usize,
}

fn crossings(a: &[(usize, Vec2)], b: &[(usize, Vec2)]) -> Vec<PathCrossing> {
    let mut found = Vec::new();
    let (extents_a, extents_b) = (extents(a), extents(b));
    for (i, in_a) in extents_a.iter().enumerate() {
        for (j, in_b) in extents_b.iter().enumerate() {
            if !in_a.touches(in_b) {
                continue;
            }
            for p in piece_ends(a, i).windows(2) {
                for q in piece_ends(b, j).windows(2) {
                    found.extend(cross_pieces(p, q));
                }
            }
        }
    }
    found
}

/// Points of one group of pieces: groups share their end points.
fn piece_ends(path: &[(usize, Vec2)], group: usize) -> &[(usize, Vec2)] {
    let from = group * PIECES;
    &path[from.min(path.len())..(from + PIECES + 1).min(path.len())]
}

fn extents(path: &[(usize, Vec2)]) -> Vec<Extent> {
    let groups = path.len().saturating_sub(1).div_ceil(PIECES);
    (0..groups).map(|group| Extent::of(piece_ends(path, group).iter().map(|p| p.1))).collect()
}

/// Crossing of two straight pieces at a large enough angle.
fn cross_pieces(p: &[(usize, Vec2)], q: &[(usize, Vec2)]) -> Option<PathCrossing> {
    let ([(step_a, p0), (_, p1)], [(step_b, q0), (_, q1)]) = (p, q) else { return None };
    let (along_p, along_q, between) = (p1 - p0, q1 - q0, q0 - p0);
    let sine = cross(along_p, along_q);
    if sine.abs() < LEAST_ANGLE_RAD.sin() * along_p.norm() * along_q.norm() || sine == 0.0 {
        return None;
    }
    let (s, t) = (cross(between, along_q) / sine, cross(between, along_p) / sine);
    let inside = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    inside.then(|| PathCrossing { point: p0 + along_p * s, step_a: *step_a, step_b: *step_b })
}

/// Smallest difference of steps at which the boxes overlap near a crossing, if below `bound`.
fn least_shift(a: &Mover, b: &Mover, crossing: &PathCrossing, bound: usize) -> Option<usize> {
    let reach = 2.0 * (radius(a, crossing.step_a) + radius(b, crossing.step_b));
    let near_a = near(a, crossing.step_a, crossing.point, reach);
    let near_b = near(b, crossing.step_b, crossing.point, reach);
    let (first_a, last_a) = (near_a.first()?.0, near_a.last()?.0);
    let (first_b, last_b) = (near_b.first()?.0, near_b.last()?.0);
    // Range of the differences of steps between these moments.
    let shortest = first_b.saturating_sub(last_a).max(first_a.saturating_sub(last_b));
    let longest = last_b.saturating_sub(first_a).max(last_a.saturating_sub(first_b));
    let hit = |p: &MoverState, step_b: Option<usize>| {
        let index = step_b.and_then(|j| j.checked_sub(first_b));
        let q = index.and_then(|k| near_b.get(k));
        q.is_some_and(|(_, q)| overlaps(&p.outline, &q.outline, 0.0))
    };
    (shortest..=longest.min(bound.saturating_sub(1))).find(|shift| {
        near_a.iter().any(|(i, p)| hit(p, i.checked_sub(*shift)) || hit(p, i.checked_add(*shift)))
    })
}

fn radius(mover: &Mover, step: usize) -> f64 {
    mover.moments.get(step).and_then(Option::as_ref).map_or(0.0, |m| m.outline.radius_m())
}

/// Consecutive moments within `reach` of `point`, around the nearest one of the piece from `step` on.
fn near(mover: &Mover, step: usize, point: Vec2, reach: f64) -> Vec<(usize, &MoverState)> {
    let distance = |i: usize| {
        let moment = mover.moments.get(i)?.as_ref()?;
        Some((i, (moment.outline.center() - point).norm()))
    };
    let piece = (step..=step + COARSE).filter_map(distance);
    let Some((middle, _)) = piece.min_by(|p, q| p.1.total_cmp(&q.1)) else { return Vec::new() };
    let close = |i: usize| {
        let moment = mover.moments.get(i)?.as_ref()?;
        (distance(i)?.1 < reach).then_some((i, moment))
    };
    let mut found: Vec<_> = (0..middle).rev().map_while(close).collect();
    found.reverse();
    found.extend((middle..mover.moments.len()).map_while(close));
    found
}

#[cfg(test)]
mod tests {
    use super::super::input::{Actor, ScoreInput};
    use super::super::tests::{input_of, straight};
    use super::*;
    use crate::AgentType::{Pedestrian, Vehicle};
    use std::f64::consts::FRAC_PI_2;

    fn pet(actors: Vec<Actor<'static>>) -> Option<f64> {
        let drivable = super::super::Drivable::default();
        let input: ScoreInput<'_> = input_of(actors, &drivable);
        let mover = |i: usize| Mover::new(&input.actors[i], input.steps.clone());
        post_encroachment_s(&mover(0), &mover(1))
    }

    #[test]
    fn second_arrives_after_the_first_left() {
        // East along y = 0 at 10 m/s, 4 m long, 2 m wide: the rear leaves x = 41 at (41 + 2 - 0) / 10 = 4.3 s.
        let east = || straight("a", Vehicle, (0.0, 0.0), 0.0, 10.0);
        // North along x = 40 at 10 m/s: the front reaches y = -1 when the centre is at -3.
        let north = |y: f64| straight("b", Vehicle, (40.0, y), FRAC_PI_2, 10.0);
        // Arrives at 5.8 s: 1.5 s later. The boxes touch at 15 steps and share ground from 16 on.
        let found = pet(vec![east(), north(-61.0)]).unwrap();
        assert!((found - 1.5).abs() < 0.11, "{found}");
        assert_eq!(pet(vec![east(), north(-40.0)]), Some(0.0));
        // Order of the two does not matter.
        assert_eq!(pet(vec![north(-61.0), east()]), Some(found));
    }

    #[test]
    fn only_for_crossing_paths() {
        let east = |y| straight("a", Vehicle, (0.0, y), 0.0, 10.0);
        assert_eq!(pet(vec![east(0.0), straight("b", Vehicle, (15.0, 0.0), 0.0, 10.0)]), None);
        assert_eq!(pet(vec![east(0.0), east(3.5)]), None);
        let walk = |id, x, y, h| straight(id, Pedestrian, (x, y), h, 1.5);
        assert_eq!(pet(vec![walk("a", 0.0, 0.0, 0.0), walk("b", 5.0, -5.0, FRAC_PI_2)]), None);
        // A walker over the road long after the car.
        let late = pet(vec![east(0.0), walk("b", 20.0, -8.0, FRAC_PI_2)]).unwrap();
        assert!((late - (4.4 - 2.24)).abs() < 0.2, "{late}");
    }
}
