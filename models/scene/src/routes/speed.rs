//! Speed caps of a path, and obstacles on it.

use super::{LaneGraph, Leg, Polyline, Route};
use crate::geometry::direction;
use crate::geometry::obb::OrientedBox;
use crate::{SignalState, Vec2};

/// Window over which the curvature of a path is measured, metres.
const CURVATURE_WINDOW_M: f64 = 3.0;
/// Highest speed cap of a bend, m/s.
const TOP_SPEED_MPS: f64 = 35.0;
/// A road user whose centre is farther than this from the path is no obstacle, metres.
pub const IN_THE_WAY_M: f64 = 1.6;
/// Centres less far ahead than this are beside or behind the own box, metres.
const AHEAD_M: f64 = 2.0;
/// Cosine below which another's direction counts as crossing or opposing.
const SAME_WAY: f64 = 0.3;
/// A stop line this little behind still counts, metres.
const PASSED_M: f64 = 1.0;

/// Comfort limits that cap the speed in bends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedRules {
    /// Sideways acceleration v^2 k, m/s2.
    pub lateral_mps2: f64,
    /// Braking ahead of bends, m/s2.
    pub brake_mps2: f64,
}

impl Default for SpeedRules {
    fn default() -> Self {
        Self { lateral_mps2: 2.2, brake_mps2: 2.2 }
    }
}

/// Another road user's outline and speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// Its box.
    pub outline: OrientedBox,
    /// Along its heading, m/s.
    pub speed_mps: f64,
}

/// The nearest road user ahead on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// Index among the obstacles given.
    pub index: usize,
    /// Free distance between the boxes along the path, metres; negative when they overlap.
    pub gap_m: f64,
    /// Its speed along the path, m/s; zero if it crosses or approaches.
    pub speed_mps: f64,
}

/// The first signal on a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalAhead {
    /// Index among the signals given.
    pub index: usize,
    /// State.
    pub state: SignalState,
    /// Distance along the path to the stop line, metres.
    pub distance_m: f64,
}

/// A signal as routes use it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneSignal {
    /// Lane that obeys it, index into [`LaneGraph::lanes`].
    pub lane: usize,
    /// State now.
    pub state: SignalState,
    /// Stop point; `None` means the lane's beginning.
    pub stop: Option<Vec2>,
}

/// Absolute curvature at every point of `path`, 1/m.
pub fn curvatures_per_m(path: &Polyline) -> Vec<f64> {
    path.arc_m().iter().map(|s| path.curvature_at(*s, CURVATURE_WINDOW_M).abs()).collect()
}

/// Speed cap at every point of `path`, m/s: the limit there, sqrt(lateral / curvature) in bends, and braking
/// in time for all slower places ahead. Points beyond the end of `limits_mps` have its last value; if it is
/// empty they have no limit.
///
/// Braking in time applies to limits too: each cap can be met from the previous one by comfortable braking.
pub fn speed_caps(path: &Polyline, limits_mps: &[f64], rules: SpeedRules) -> Vec<f64> {
    caps_of_bends(path.arc_m(), &curvatures_per_m(path), limits_mps, rules)
}

/// [`speed_caps`] for known curvatures at each arc length.
pub fn caps_of_bends(
    arc_m: &[f64],
    curvatures_per_m: &[f64],
    limits_mps: &[f64],
    rules: SpeedRules,
) -> Vec<f64> {
    let last = limits_mps.last().copied().unwrap_or(TOP_SPEED_MPS);
    let in_bend = |curvature: f64| (rules.lateral_mps2 / curvature.max(1e-6)).sqrt().min(TOP_SPEED_MPS);
    let cap = |(i, k): (usize, &f64)| in_bend(*k).min(limits_mps.get(i).copied().unwrap_or(last));
    let mut caps: Vec<f64> = curvatures_per_m.iter().enumerate().map(cap).collect();
    for i in (1..caps.len()).rev() {
        let reachable = (caps[i] * caps[i] + 2.0 * rules.brake_mps2 * (arc_m[i] - arc_m[i - 1])).sqrt();
        caps[i - 1] = caps[i - 1].min(reachable);
    }
    caps
}

/// Nearest obstacle ahead with its centre within 1.6 m of the path. The path begins at the centre of the own
/// box, which is `own_length_m` long and is not in `others`.
pub fn leader(path: &Polyline, own_length_m: f64, others: &[Obstacle]) -> Option<Leader> {
    leaders(path, own_length_m, others).into_iter().next()
}

/// All obstacles ahead in the sense of [`leader`], nearest first.
pub fn leaders(path: &Polyline, own_length_m: f64, others: &[Obstacle]) -> Vec<Leader> {
    let mut found: Vec<(f64, Leader)> = Vec::new();
    for (index, other) in others.iter().enumerate() {
        let Some(foot) = path.project_within(other.outline.center(), IN_THE_WAY_M) else { continue };
        if foot.s_m < AHEAD_M || foot.s_m >= path.length_m() {
            continue;
        }
        let along = other.outline.forward().dot(&direction(foot.heading_rad));
        let across = (1.0 - along * along).max(0.0).sqrt();
        let half_extent = other.outline.half_length_m() * along.abs() + other.outline.half_width_m() * across;
        let gap_m = foot.s_m - half_extent - 0.5 * own_length_m;
        let speed_mps = if along > SAME_WAY { other.speed_mps } else { 0.0 };
        found.push((foot.s_m, Leader { index, gap_m, speed_mps }));
    }
    // A stable sort: among obstacles at the same place, the first given comes first.
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, leader)| leader).collect()
}

/// Arc length on the path of the place at `s_m` of the leg's lane; `None` if the leg does not pass it.
fn on_path(leg: &Leg, s_m: f64) -> Option<f64> {
    let passes = s_m >= leg.from_m - PASSED_M && s_m <= leg.to_m + 1e-6;
    passes.then(|| leg.path_from_m + (s_m - leg.from_m).max(0.0))
}

/// First signal on the route. A signal whose stop line the route has already passed does not count.
pub fn first_signal(route: &Route, graph: &LaneGraph, signals: &[LaneSignal]) -> Option<SignalAhead> {
    for leg in &route.legs {
        let here = signals.iter().enumerate().filter(|(_, signal)| signal.lane == leg.lane);
        let met = here.filter_map(|(index, signal)| {
            let path = &graph.lanes().get(signal.lane)?.path;
            let s = signal.stop.map_or(0.0, |stop| path.project(stop).s_m);
            Some(SignalAhead { index, state: signal.state, distance_m: on_path(leg, s)? })
        });
        let first = met.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m).then(a.index.cmp(&b.index)));
        if first.is_some() {
            return first;
        }
    }
    None
}

/// Distance along the route's path to the place beside its first stop sign, metres.
pub fn stop_sign_distance_m(route: &Route, graph: &LaneGraph) -> Option<f64> {
    route.legs.iter().find_map(|leg| on_path(leg, graph.lanes().get(leg.lane)?.stop_sign_m?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::routes::sample_maps::crossing;
    use crate::routes::{Pose, routes_ahead};
    use crate::{AgentType, LaneMap, map::StopSign};

    fn route(map: &LaneMap, x: f64) -> (LaneGraph, Route) {
        let graph = LaneGraph::new(map);
        let routes = routes_ahead(&graph, Pose::xyh(x, -1.75, 0.0), AgentType::Vehicle, 100.0);
        let left = graph.lane_index("w_in>n").unwrap();
        let turning = routes.into_iter().find(|r| r.legs.iter().any(|l| l.lane == left)).unwrap();
        (graph, turning)
    }

    #[test]
    fn bends_are_slow_and_braked_for() {
        let (_, route) = route(&crossing(), -60.0);
        let caps = speed_caps(&route.path, &route.limits_mps, SpeedRules::default());
        let slowest = caps.iter().copied().fold(f64::INFINITY, f64::min);
        let expected = (2.2_f64 * 13.75).sqrt();
        assert!((slowest - expected).abs() < 0.3, "{slowest} for {expected}");
        assert_eq!(caps[0], 13.4);
        let arc = route.path.arc_m();
        for i in 1..caps.len() {
            let braking = (caps[i - 1].powi(2) - caps[i].powi(2)) / (2.0 * (arc[i] - arc[i - 1]));
            assert!(braking <= 2.2 + 1e-9);
        }
    }

    #[test]
    fn the_nearest_ahead_leads() {
        let path = Polyline::new([Vec2::zeros(), Vec2::new(100.0, 0.0)]);
        let at = |x: f64, y: f64, heading_rad: f64| Obstacle {
            outline: OrientedBox::new(Vec2::new(x, y), 2.0, 1.0, heading_rad),
            speed_mps: 7.0,
        };
        let others = [at(-10.0, 0.0, 0.0), at(40.0, 0.5, 0.0), at(20.0, 3.0, 0.0), at(60.0, 0.0, 0.0)];
        let found = leader(&path, 5.0, &others).unwrap();
        assert_eq!(found, Leader { index: 1, gap_m: 35.5, speed_mps: 7.0 });
        let crossing = leader(&path, 5.0, &[at(30.0, 1.0, std::f64::consts::FRAC_PI_2)]).unwrap();
        assert!((crossing.gap_m - 26.5).abs() < 1e-3 && crossing.speed_mps == 0.0);
        assert_eq!(leader(&path, 5.0, &[]), None);
    }

    #[test]
    fn signals_and_stop_signs_on_the_route() {
        let mut map = crossing();
        let sign = StopSign {
            id: "s".into(),
            position: Vec2::new(-13.0, -4.0),
            z_m: None,
            lanes: vec!["w_in".into(), "nowhere".into()],
        };
        map.stop_signs.push(sign);
        let (graph, route) = route(&map, -50.0);
        assert!((stop_sign_distance_m(&route, &graph).unwrap() - 37.0).abs() < 0.1);
        let signal = |id: &str, state| LaneSignal { lane: graph.lane_index(id).unwrap(), state, stop: None };
        let signals = [signal("w_in>e", SignalState::Go), signal("w_in>n", SignalState::Stop)];
        let found = first_signal(&route, &graph, &signals).unwrap();
        assert_eq!((found.index, found.state), (1, SignalState::Stop));
        assert!((found.distance_m - 38.0).abs() < 0.2);
        assert_eq!(first_signal(&route, &graph, &signals[..1]), None);
    }
}
