//! Paths through a place: polylines along lanes or across them, with the place at a known arc length.

use scene::AgentType;
use scene::geometry::direction;
use scene::routes::{LaneGraph, Polyline, Pose};
use scene::wrap_angle;

/// Length of a path before and after its place if lanes continue, metres.
const REACH_M: f64 = 300.0;
/// Length of a path across a lane to each side, metres.
const ACROSS_M: f64 = 40.0;
/// Most lanes of a path on each side of the place.
const MOST_LANES: usize = 48;

/// A path with its place.
#[derive(Clone, Debug)]
pub(super) struct LaneWay {
    path: Polyline,
    place_m: f64,
    /// Lanes that lead to the place, nearest first, each with the metres from its end to the place.
    pub(super) lanes: Vec<(usize, f64)>,
}

impl LaneWay {
    /// The path along motor vehicle lanes through a place of one of them: straight on at forks and merges,
    /// but from `before` if that is given.
    pub(super) fn along(graph: &LaneGraph, lane: usize, s_m: f64, before: Option<usize>) -> Self {
        let lanes = graph.lanes();
        let own = &lanes[lane].path;
        let mut parts = vec![own.slice((s_m - REACH_M).max(0.0), (s_m + REACH_M).min(own.length_m()))];
        let mut behind = vec![(lane, s_m - own.length_m())];
        let (mut known_m, mut last) = (s_m, lane);
        while known_m < REACH_M && behind.len() < MOST_LANES {
            let forced = before.filter(|_| behind.len() == 1);
            let Some(next) = forced.or_else(|| straightest(graph, &lanes[last].predecessors)) else { break };
            let path = &lanes[next].path;
            behind.push((next, known_m));
            parts.insert(0, path.slice((path.length_m() - (REACH_M - known_m)).max(0.0), path.length_m()));
            known_m += path.length_m();
            last = next;
        }
        let (mut beyond_m, mut count) = (own.length_m() - s_m, 1);
        last = lane;
        while beyond_m < REACH_M && count < MOST_LANES {
            let Some(next) = straightest(graph, &lanes[last].successors) else { break };
            let path = &lanes[next].path;
            parts.push(path.slice(0.0, path.length_m().min(REACH_M - beyond_m)));
            beyond_m += path.length_m();
            (last, count) = (next, count + 1);
        }
        let path = Polyline::new(parts.iter().flat_map(|part| part.points().iter().copied()));
        // Lanes do not join exactly, so the place is searched near its expected arc length.
        let place_m = path.project_between(
            own.position_at(s_m),
            known_m.min(REACH_M) - 5.0,
            known_m.min(REACH_M) + 5.0,
        );
        Self { place_m: place_m.s_m, path, lanes: behind }
    }

    /// The same path in the opposite direction.
    pub(super) fn reversed(&self) -> Self {
        Self { path: self.path.reversed(), place_m: self.path.length_m() - self.place_m, lanes: Vec::new() }
    }

    /// A straight path across a place.
    pub(super) fn across(place: Pose) -> Self {
        let side = direction(place.heading_rad) * ACROSS_M;
        let path = Polyline::new([place.position - side, place.position + side]);
        Self { path, place_m: ACROSS_M, lanes: Vec::new() }
    }

    /// Its length before the place and after it, metres.
    pub(super) fn room_m(&self) -> (f64, f64) {
        (self.place_m, self.path.length_m() - self.place_m)
    }

    /// The pose this many metres after the place, clamped to the path.
    pub(super) fn pose(&self, at_m: f64) -> Pose {
        self.path.sample(self.place_m + at_m)
    }

    /// The same; `None` beyond the path.
    pub(super) fn pose_on(&self, at_m: f64) -> Option<Pose> {
        let (before_m, after_m) = self.room_m();
        (at_m >= -before_m - 1e-6 && at_m <= after_m + 1e-6).then(|| self.pose(at_m))
    }

    /// The change of heading from one place of it to another, radians.
    pub(super) fn turn_rad(&self, from_m: f64, to_m: f64) -> f64 {
        wrap_angle(self.pose(to_m).heading_rad - self.pose(from_m).heading_rad)
    }

    /// The greatest change of heading between places of a stretch and its end, radians.
    pub(super) fn bend_rad(&self, from_m: f64, to_m: f64) -> f64 {
        let steps = ((to_m - from_m) / 5.0).ceil().max(1.0) as usize;
        let at = |i: usize| from_m + (to_m - from_m) * i as f64 / steps as f64;
        (0..steps).map(|i| self.turn_rad(at(i), to_m).abs()).fold(0.0, f64::max)
    }
}

/// The straightest of these lanes that motor vehicles use.
fn straightest(graph: &LaneGraph, lanes: &[usize]) -> Option<usize> {
    let turn = |lane: usize| {
        let path = &graph.lanes()[lane].path;
        wrap_angle(path.last().heading_rad - path.first().heading_rad).abs()
    };
    let used = lanes.iter().copied().filter(|lane| graph.lanes()[*lane].carries(AgentType::Vehicle));
    used.min_by(|a, b| turn(*a).total_cmp(&turn(*b)).then(a.cmp(b)))
}
