//! A scene as input of the templates: its drivers, and the path of each.

use crate::routes::{LaneGraph, Polyline, Pose, best_route_ahead};
use crate::{Agent, AgentType, Scene, Shown, State, Vec2, wrap_angle};

/// Length of a path behind its road user, metres, so that agents beside and behind project onto it.
pub(super) const BEHIND_M: f64 = 40.0;
/// Length of the lanes that extend a known motion, metres.
const BEYOND_M: f64 = 120.0;
/// A motion shorter than this defines no path; the lanes ahead do, metres.
const LEAST_MOTION_M: f64 = 2.0;
/// Smallest distance between points of a path, metres.
const APART_M: f64 = 0.5;
/// Headings that differ by less are the same, radians.
const SAME_WAY_RAD: f64 = 0.5;

/// A vehicle that is present at the start.
pub(super) struct Driver<'a> {
    pub(super) agent: &'a Agent,
    pub(super) shown: Shown<'a>,
    pub(super) state: State,
    /// Its path: its known motion, then lanes. It begins [`BEHIND_M`] behind the road user.
    pub(super) way: Polyline,
}

/// Place of another agent relative to a driver's path.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaceAhead {
    /// Metres ahead of the path's owner; negative behind it.
    pub(super) ahead_m: f64,
    /// Metres to the left of the path.
    pub(super) left_m: f64,
    /// Heading relative to the path, wrapped, radians.
    pub(super) turn_rad: f64,
}

impl PlaceAhead {
    pub(super) fn same_way(&self) -> bool {
        self.turn_rad.abs() < SAME_WAY_RAD
    }
}

impl Driver<'_> {
    pub(super) fn speed_mps(&self) -> f64 {
        self.state.speed_mps()
    }

    pub(super) fn length_m(&self) -> f64 {
        self.shown.size.length_m
    }

    /// The pose this many metres ahead; `None` beyond the end of what is known.
    pub(super) fn pose_ahead(&self, metres: f64) -> Option<Pose> {
        let s = BEHIND_M + metres;
        (s >= 0.0 && s <= self.way.length_m()).then(|| self.way.sample(s))
    }

    /// Place of a pose relative to the path.
    pub(super) fn place_of(&self, position: Vec2, heading_rad: f64) -> PlaceAhead {
        let foot = self.way.project(position);
        PlaceAhead {
            ahead_m: foot.s_m - BEHIND_M,
            left_m: foot.lateral_m,
            turn_rad: wrap_angle(heading_rad - foot.heading_rad),
        }
    }

    /// Distance covered in some seconds, metres: by its known motion, else at its present speed.
    pub(super) fn advance_m(&self, start_step: usize, after_s: f64) -> f64 {
        let step = start_step + (after_s / crate::STEP_S).round() as usize;
        match self.shown.track.at(step) {
            Some(state) => self.place_of(state.position(), state.heading_rad).ahead_m,
            None => self.speed_mps() * after_s,
        }
    }
}

pub(super) struct Stage<'a> {
    pub(super) scene: &'a Scene,
    pub(super) graph: &'a LaneGraph,
    pub(super) start_step: usize,
    /// In the scene's order.
    pub(super) drivers: Vec<Driver<'a>>,
}

impl<'a> Stage<'a> {
    pub(super) fn new(scene: &'a Scene, graph: &'a LaneGraph, start_step: usize) -> Self {
        let driver = |agent: &'a Agent| {
            let shown = scene.shown(agent);
            let state = *shown.track.at(start_step)?;
            let drives = shown.agent_type == AgentType::Vehicle;
            let way = drives.then(|| way(&shown, &state, graph, start_step))?;
            Some(Driver { agent, shown, state, way })
        };
        Self { scene, graph, start_step, drivers: scene.agents.iter().filter_map(driver).collect() }
    }

    /// The leader on a driver's path in the same direction, and the gap between the two, metres.
    pub(super) fn leader(&self, of: usize) -> Option<(usize, f64)> {
        let own = &self.drivers[of];
        let ahead = self.drivers.iter().enumerate().filter(|(i, _)| *i != of).filter_map(|(i, other)| {
            let place = own.place_of(other.state.position(), other.state.heading_rad);
            let in_lane = place.left_m.abs() < 1.6 && place.same_way() && place.ahead_m > 1.0;
            in_lane.then(|| (i, place.ahead_m - 0.5 * (own.length_m() + other.length_m())))
        });
        ahead.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The known motion, then the straightest continuation along the lanes.
fn way(shown: &Shown<'_>, state: &State, graph: &LaneGraph, start_step: usize) -> Polyline {
    let forward = crate::geometry::direction(state.heading_rad);
    let mut points = vec![state.position() - forward * BEHIND_M, state.position()];
    let mut end = Pose::new(state.position(), state.heading_rad);
    let track = &shown.track;
    let last = track.first_step + track.states.len();
    for known in (start_step + 1..last).filter_map(|step| track.at(step)) {
        if (known.position() - end.position).norm() >= APART_M {
            end = Pose::new(known.position(), known.heading_rad);
            points.push(known.position());
        }
    }
    let gone: f64 = points.windows(2).skip(1).map(|pair| (pair[1] - pair[0]).norm()).sum();
    if gone < LEAST_MOTION_M {
        points.truncate(2);
        end = Pose::new(state.position(), state.heading_rad);
    }
    let route = best_route_ahead(graph, end, AgentType::Vehicle, BEYOND_M);
    if let Some(route) = route {
        // The lane's middle may be beside the end of the motion: the offset fades out over the first metres.
        points.extend(route.path.points().iter().copied().filter(|p| (p - end.position).norm() > 6.0));
    }
    Polyline::new(points)
}
