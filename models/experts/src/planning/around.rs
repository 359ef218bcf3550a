//! Paths on foot around standing obstacles between start and goal: parked vehicles, and people who wait.

use super::crossing::walking;
use super::way::{PathKind, UntimedPath};
use super::world::{AgentAtStart, World};
use crate::tuning::fixed::around::{DETOUR, DETOUR_M, MOST_ROUNDS, ROOM_M, ROUNDED_M, SPARE_M};
use scene::geometry::obb::OrientedBox;
use scene::motion::{MotionModel, Target};
use scene::routes::Polyline;
use scene::{STANDING_MPS, Vec2};

/// Distance between the points of a path, metres.
const SPACING_M: f64 = 0.5;
/// Number of parts in which the margin around a box shrinks if it contains an end of the path.
const ROOM_PARTS: u8 = 5;
/// First identity of paths around boxes.
const IDENTITY: u64 = 1_000_000;

/// The shortest path to a goal around standing road users. `None` if the straight path is free, or if no
/// detour is short enough.
pub(super) fn around(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
) -> Option<UntimedPath> {
    let start = who.start.position();
    let room_m = 0.5 * who.size.width_m.max(who.size.length_m) + ROOM_M;
    let standing = world.obstacles(who.index).into_iter().filter(|o| o.speed_mps < STANDING_MPS);
    let boxes: Vec<KeptClear> =
        standing.filter_map(|o| KeptClear::new(&o.outline, room_m, [start, goal])).collect();
    let mut known: Vec<usize> = met(&boxes, &[start, goal]);
    if known.is_empty() {
        return None;
    }
    let straight_m = (goal - start).norm();
    let longest_m = (DETOUR * straight_m).max(straight_m + DETOUR_M);
    for _ in 0..MOST_ROUNDS {
        let way = shortest(&boxes, &known, start, goal, longest_m)?;
        let more: Vec<usize> = met(&boxes, &way.places).into_iter().filter(|i| !known.contains(i)).collect();
        if !more.is_empty() {
            known.extend(more);
            continue;
        }
        let path = Polyline::new(way.places).resample(SPACING_M).smoothed(ROUNDED_M);
        let pace = walking(model.start_speed_mps(), path.length_m(), target);
        let (limit_mps, tuning) = (model.limits.speed_mps, &world.tuning.anchors);
        let kind = PathKind::LeastEffort;
        let untimed = UntimedPath::new(path, 2.0, limit_mps, kind, None, IDENTITY + way.identity, tuning);
        return Some(UntimedPath { pace, ..untimed });
    }
    None
}

/// A standing box with the margin that a walker keeps from it.
struct KeptClear {
    grown: OrientedBox,
    /// The box with the largest margin that leaves the start outside, and the goal: for the first leg, and
    /// for the last.
    at_ends: [OrientedBox; 2],
}

impl KeptClear {
    /// `None` if the start or the goal is inside the box even without a margin.
    fn new(outline: &OrientedBox, room_m: f64, ends: [Vec2; 2]) -> Option<Self> {
        let grown = |part: u8| outline.grown(room_m * f64::from(part) / f64::from(ROOM_PARTS));
        let outside = |end: Vec2| (0..=ROOM_PARTS).rev().map(grown).find(|b| !b.meets_segment(end, end));
        let [at_start, at_goal] = ends.map(outside);
        Some(Self { grown: grown(ROOM_PARTS), at_ends: [at_start?, at_goal?] })
    }

    /// Whether a leg meets the box; `first` and `last` mark the first and the last leg of the path.
    fn meets(&self, from: Vec2, to: Vec2, first: bool, last: bool) -> bool {
        let [at_start, at_goal] = &self.at_ends;
        (!first || at_start.meets_segment(from, to))
            && (!last || at_goal.meets_segment(from, to))
            && (first || last || self.grown.meets_segment(from, to))
    }
}

/// Indices of the boxes that a path meets.
fn met(boxes: &[KeptClear], way: &[Vec2]) -> Vec<usize> {
    let last = way.len().saturating_sub(2);
    let meets = |b: &KeptClear| {
        way.windows(2).enumerate().any(|(leg, ends)| b.meets(ends[0], ends[1], leg == 0, leg == last))
    };
    (0..boxes.len()).filter(|i| meets(&boxes[*i])).collect()
}

/// A path from corner to corner, identified by these corners.
struct CornerWay {
    places: Vec<Vec2>,
    identity: u64,
}

/// The shortest path of at most `longest_m` past the corners of the known boxes that meets none of them.
fn shortest(
    boxes: &[KeptClear],
    known: &[usize],
    start: Vec2,
    goal: Vec2,
    longest_m: f64,
) -> Option<CornerWay> {
    let corners = known.iter().flat_map(|i| boxes[*i].grown.grown(SPARE_M).corners());
    let places: Vec<Vec2> = [start, goal].into_iter().chain(corners).collect();
    let is_free = |from: usize, to: usize| {
        !known.iter().any(|i| boxes[*i].meets(places[from], places[to], from == 0, to == 1))
    };
    let mut from = vec![0; places.len()];
    let mut length_m = vec![f64::INFINITY; places.len()];
    let mut open = vec![true; places.len()];
    length_m[0] = 0.0;
    loop {
        let next = (0..places.len()).filter(|i| open[*i] && length_m[*i] <= longest_m);
        let at = next.min_by(|a, b| length_m[*a].total_cmp(&length_m[*b]))?;
        if at == 1 {
            break;
        }
        open[at] = false;
        for to in (1..places.len()).filter(|to| open[*to]) {
            let through_m = length_m[at] + (places[to] - places[at]).norm();
            if through_m < length_m[to] && is_free(at, to) {
                (length_m[to], from[to]) = (through_m, at);
            }
        }
    }
    let (mut at, mut way, mut identity) = (1, vec![goal], 0_u64);
    while at != 0 {
        at = from[at];
        way.push(places[at]);
        // Corners are identified by their box and their index on it, independent of the other boxes.
        if let Some(corner) = at.checked_sub(2) {
            identity =
                identity.wrapping_mul(1_009).wrapping_add((4 * known[corner / 4] + corner % 4) as u64 + 1);
        }
    }
    way.reverse();
    Some(CornerWay { places: way, identity: identity % IDENTITY })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_of_parked_cars_is_passed_at_its_end_or_through_a_gap() {
        let (start, goal) = (Vec2::zeros(), Vec2::new(10.0, 0.0));
        let parked = |x_m: f64, y_m: f64| OrientedBox::new(Vec2::new(x_m, y_m), 2.4, 1.0, 0.0);
        let car = |y_m: f64| KeptClear::new(&parked(5.0, y_m), 0.5, [start, goal]).unwrap();
        let way = |boxes: &[KeptClear]| {
            let known: Vec<usize> = (0..boxes.len()).collect();
            shortest(boxes, &known, start, goal, 40.0).map(|way| way.places)
        };
        let row = [car(0.0), car(2.5), car(-2.5)];
        let round = way(&row).unwrap();
        assert!(met(&row, &round).is_empty());
        assert!(round.iter().any(|p| p.y.abs() > 3.9), "{round:?}");
        let with_gap = [car(0.4), car(-3.1), car(2.9)];
        let through = way(&with_gap).unwrap();
        assert!(met(&with_gap, &through).is_empty());
        assert!(through.iter().all(|p| p.y.abs() < 2.0), "{through:?}");
        let wall: Vec<KeptClear> = (-20..=20).map(|i| car(2.5 * f64::from(i))).collect();
        assert!(way(&wall).is_none());
    }

    #[test]
    fn a_goal_close_behind_a_parked_car_is_walked_to_round_it() {
        let (start, goal) = (Vec2::zeros(), Vec2::new(7.7, 0.0));
        let parked = OrientedBox::new(Vec2::new(5.0, 0.0), 2.4, 1.0, 0.0);
        let boxes = [KeptClear::new(&parked, 0.8, [start, goal]).unwrap()];
        assert_eq!(met(&boxes, &[start, goal]), [0]);
        let way = shortest(&boxes, &[0], start, goal, 40.0).unwrap().places;
        assert!(met(&boxes, &way).is_empty());
        assert!(way.iter().any(|p| p.y.abs() > 1.8), "{way:?}");
        assert!(KeptClear::new(&parked, 0.8, [start, Vec2::new(5.0, 0.5)]).is_none());
    }
}
