//! Builds a path from a chain of lanes.

use super::start::errors_at;
use super::{LaneGraph, Leg, Polyline, Pose, Route};
use crate::Vec2;

/// Distance between the points of a route's path, metres.
const STEP_M: f64 = 1.0;
/// Half window of the moving average that rounds off the kinks between lanes, metres.
const SMOOTH_HALF_M: f64 = 2.0;

/// A stretch of a lane in a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hop {
    pub lane: usize,
    pub from_m: f64,
    pub to_m: f64,
    /// Length from `from_m` over which the path still moves here from a neighbouring lane, metres. It may
    /// exceed the hop if the move continues in the next one, and is zero if the previous lane simply ends
    /// here.
    pub change_m: f64,
    /// The previous lane ends here; otherwise it is a neighbour.
    pub follows: bool,
}

/// A move to a neighbouring lane that takes more than one hop: its offset carries over to the new lanes.
struct Moving {
    /// Offset of the previous lane, positive left, metres.
    offset_m: f64,
    total_m: f64,
    gone_m: f64,
}

impl Moving {
    /// The point of a move at `pose` of the new lane, `further_m` on.
    fn at(&self, pose: Pose, further_m: f64) -> Vec2 {
        let heading = pose.direction();
        let left = self.offset_m * (1.0 - smooth((self.gone_m + further_m) / self.total_m));
        pose.position + left * Vec2::new(-heading.y, heading.x)
    }
}

impl Hop {
    pub fn along(lane: usize, from_m: f64, to_m: f64) -> Self {
        Self { lane, from_m, to_m, change_m: 0.0, follows: true }
    }

    pub fn length_m(&self) -> f64 {
        (self.to_m - self.from_m).max(0.0)
    }
}

/// Points of a chain before smoothing, and the arc length at which each hop begins.
fn chain(graph: &LaneGraph, hops: &[Hop]) -> (Vec<Vec2>, Vec<f64>) {
    let mut points: Vec<Vec2> = Vec::new();
    let (mut starts, mut length) = (Vec::with_capacity(hops.len()), 0.0);
    let mut moving: Option<Moving> = None;
    for (i, hop) in hops.iter().enumerate() {
        starts.push(length);
        let path = &graph.lanes()[hop.lane].path;
        let change_m = hop.change_m.min(hop.length_m());
        let mut add = |p: Vec2| {
            length += points.last().map_or(0.0, |last| (p - last).norm());
            points.push(p);
        };
        let pieces = change_m.ceil().max(1.0) as usize;
        let shares = (0..=pieces).map(|k| k as f64 / pieces as f64);
        let before = i.checked_sub(1).map(|k| hops[k]).filter(|_| change_m > 0.0 && !hop.follows);
        let beside = before.map(|before| (&graph.lanes()[before.lane].path, before.to_m));
        if let Some((beside, left_m)) = beside {
            moving = None;
            if hop.change_m > hop.length_m() {
                let onto = path.sample(hop.from_m);
                let (offset_m, _) = errors_at(beside.extrapolate(left_m), onto);
                moving = Some(Moving { offset_m, total_m: hop.change_m, gone_m: 0.0 });
            } else {
                for share in shares.clone() {
                    let from = beside.extrapolate(left_m + share * change_m).position;
                    let to = path.position_at(hop.from_m + share * change_m);
                    add(from + smooth(share) * (to - from));
                }
            }
        }
        if let Some(moving) = moving.as_mut().filter(|_| change_m > 0.0) {
            for share in shares {
                add(moving.at(path.sample(hop.from_m + share * change_m), share * change_m));
            }
            moving.gone_m += change_m;
        }
        // The move has reached the middle of the lane.
        if hop.change_m <= hop.length_m() {
            path.slice(hop.from_m + change_m, hop.to_m).points().iter().copied().for_each(&mut add);
        }
    }
    (points, starts)
}

/// Rises from 0 to 1 with zero slope and curvature at either end.
pub(super) fn smooth(share: f64) -> f64 {
    let t = share.clamp(0.0, 1.0);
    t * t * t * (10.0 + t * (6.0 * t - 15.0))
}

/// Route along a chain of lanes for a road user at `pose`; `None` if the chain has no length.
pub(super) fn route(graph: &LaneGraph, hops: &[Hop], pose: Pose, terminal: bool) -> Option<Route> {
    let (points, starts) = chain(graph, hops);
    let raw = Polyline::new(points);
    if raw.length_m() < 0.5 {
        return None;
    }
    let path = raw.resample(STEP_M).smoothed(SMOOTH_HALF_M);
    let scale = path.length_m() / raw.length_m();
    let legs = hops.iter().zip(&starts).map(|(hop, start)| Leg {
        lane: hop.lane,
        from_m: hop.from_m,
        to_m: hop.to_m,
        path_from_m: start * scale,
    });
    let legs: Vec<Leg> = legs.collect();
    let limits_mps = limits(graph, &legs, &path);
    let (lateral_m, heading_error_rad) = errors_at(pose, path.first());
    Some(Route { legs, path, limits_mps, lateral_m, heading_error_rad, terminal })
}

/// Speed limit of the leg that each point of the path lies on, m/s.
pub(super) fn limits(graph: &LaneGraph, legs: &[Leg], path: &Polyline) -> Vec<f64> {
    let limit = |s: &f64| {
        let leg = legs.partition_point(|leg| leg.path_from_m <= *s).saturating_sub(1);
        legs.get(leg).map_or(f64::INFINITY, |leg| graph.lanes()[leg.lane].speed_limit_mps)
    };
    path.arc_m().iter().map(limit).collect()
}

/// Points every `step_m` along a chain, to compare chains without building their paths.
pub(super) fn trace(graph: &LaneGraph, hops: &[Hop], step_m: f64) -> Vec<Vec2> {
    let (mut points, mut next, mut length) = (Vec::new(), 0.0, 0.0);
    for hop in hops {
        let path = &graph.lanes()[hop.lane].path;
        while next <= length + hop.length_m() {
            points.push(path.position_at(hop.from_m + next - length));
            next += step_m;
        }
        length += hop.length_m();
    }
    points
}

/// Mean distance between traces over their common length, metres.
pub(super) fn mean_distance_m(a: &[Vec2], b: &[Vec2]) -> f64 {
    let n = a.len().min(b.len());
    a.iter().zip(b).map(|(p, q)| (p - q).norm()).sum::<f64>() / n.max(1) as f64
}
