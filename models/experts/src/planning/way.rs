//! Paths that an agent may take, before and after they have a timing.

use super::coordinates::MODES;
use super::profile::{Caps, Progress, TimedLeg};
use super::world::{AgentAtStart, World};
use crate::tuning::AnchorTuning;
use crate::tuning::fixed::on_foot::{LEAST_MPS, LONGER, SWAYING_MPS};
use crate::tuning::fixed::profile::HURRY;
use crate::tuning::fixed::way::{
    ASSUMED_LIMIT_MPS, BEND_RAD, OFF_LANES_DRIVING_MPS, OFF_LANES_ON_FOOT_MPS, OFF_LANES_RIDING_MPS,
    SEARCHED_M, WITHOUT_LIMIT_MPS,
};
use scene::geometry::direction;
use scene::limits::Limits;
use scene::motion::{MotionKind, MotionModel};
use scene::routes::{Polyline, Route, SpeedRules, base_path, route_length_m, routes_ahead, speed};
use scene::{AgentType, HORIZON_STEPS, STEP_S, Vec2};

/// The kind of path that an anchor follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathKind {
    /// Along lanes all the way.
    Route,
    /// By a curve onto or off the lanes.
    Joined,
    /// The motion of least effort to the goal: projected for vehicles, a spline under tension for people and riders.
    LeastEffort,
    /// Straight on, because no lane is known.
    Straight,
}

/// A path with a base progress along it.
#[derive(Clone, Debug)]
pub struct Anchor {
    /// Path of the box centre, scene frame; begins at the start position.
    pub path: Polyline,
    /// Base progress along the path.
    pub base: Progress,
    /// Speed caps at the path's points, m/s.
    pub caps_mps: Vec<f64>,
    /// Where the path came from.
    pub kind: PathKind,
    /// Route that the path follows, if any.
    pub route: Option<Route>,
    /// Identifies the path across small changes of the goal, so that modes keep their slot while the user
    /// drags.
    pub identity: u64,
    /// Index of this timing among those of its path, and their number.
    pub timing: (usize, usize),
    /// Metres along the path at which it passes each via point of the window.
    pub passes_m: Vec<f64>,
}

/// Multiplier of path identities; larger than the number of modes.
const TIMINGS: u64 = 8;

/// Number of slots per path, for 1 to 6 paths.
pub(super) const SLOTS: [[usize; MODES]; MODES] = [
    [6, 0, 0, 0, 0, 0],
    [3, 3, 0, 0, 0, 0],
    [2, 2, 2, 0, 0, 0],
    [2, 2, 1, 1, 0, 0],
    [2, 1, 1, 1, 1, 0],
    [1, 1, 1, 1, 1, 1],
];

/// A path without timings.
pub(super) struct UntimedPath {
    pub(super) path: Polyline,
    pub(super) caps_mps: Vec<f64>,
    /// Curvature at the path's points, 1/m.
    pub(super) curvatures_per_m: Vec<f64>,
    /// Speed limits at the path's points, including usual speeding, m/s.
    pub(super) limits_mps: Vec<f64>,
    pub(super) limit_mps: f64,
    pub(super) kind: PathKind,
    pub(super) route: Option<Route>,
    pub(super) identity: u64,
    /// Base progress that belongs to the path.
    pub(super) pace: Option<Progress>,
}

pub(super) fn paths_ahead(world: &World<'_>, who: &AgentAtStart, model: &MotionModel) -> Vec<UntimedPath> {
    let v0 = model.start_speed_mps();
    let graph = &world.graph;
    let walking = model.kind == MotionKind::Walk;
    let length = if walking { walked_m(v0) } else { route_length_m(v0) };
    let routes = if world.planning.routes {
        routes_ahead(graph, who.pose(), who.agent_type, length)
    } else {
        Vec::new()
    };
    let mut out: Vec<UntimedPath> = Vec::with_capacity(MODES);
    if walking || routes.is_empty() {
        out.push(straight_on(who, model, length, &world.tuning.anchors));
    }
    let most = if walking { 3 } else { MODES };
    for route in routes {
        if out.len() == most {
            break;
        }
        let path = base_path(&route.path, who.pose(), v0, who.agent_type, None);
        let limit = route.limits_mps.first().copied().unwrap_or(model.limits.speed_mps);
        let identity = identity_of(&route);
        let comfort = model.limits.comfortable.lateral_mps2;
        out.push(UntimedPath::new(
            path,
            comfort,
            limit.min(model.limits.speed_mps),
            PathKind::Route,
            Some(route),
            identity,
            &world.tuning.anchors,
        ));
    }
    if out.len() == 1 && !walking && out[0].kind == PathKind::Straight {
        out.extend([BEND_RAD, -BEND_RAD].map(|bend| bent(who, model, length, bend, &world.tuning.anchors)));
    }
    out
}

fn straight_on(who: &AgentAtStart, model: &MotionModel, length: f64, tuning: &AnchorTuning) -> UntimedPath {
    let start = who.start.position();
    let (faces, velocity) = (direction(who.start.heading_rad), who.start.velocity());
    // A walker's velocity sways, so its heading predicts its direction better, unless it clearly moves
    // elsewhere.
    let aside = model.kind == MotionKind::Walk
        && velocity.norm() > SWAYING_MPS
        && velocity.dot(&faces) < 0.5 * velocity.norm();
    let ahead = if aside { velocity.normalize() } else { faces };
    let n = length.ceil().max(2.0) as usize;
    let path = Polyline::new((0..=n).map(|i| start + ahead * i as f64));
    UntimedPath::new(path, 2.0, assumed_speed(who.agent_type), PathKind::Straight, None, 3, tuning)
}

/// An arc that turns by `bend` radians over its length.
fn bent(
    who: &AgentAtStart,
    model: &MotionModel,
    length: f64,
    bend: f64,
    tuning: &AnchorTuning,
) -> UntimedPath {
    let n = length.ceil().max(2.0) as usize;
    let mut at = who.start.position();
    let points: Vec<Vec2> = (0..=n)
        .map(|i| {
            let here = at;
            at += direction(who.start.heading_rad + bend * i as f64 / n as f64);
            here
        })
        .collect();
    let comfort = model.limits.comfortable.lateral_mps2;
    let identity = if bend > 0.0 { 4 } else { 5 };
    UntimedPath::new(
        Polyline::new(points),
        comfort,
        assumed_speed(who.agent_type),
        PathKind::Straight,
        None,
        identity,
        tuning,
    )
}

/// Length of a walker's path, metres: longer than the distance walked in a window.
fn walked_m(v0: f64) -> f64 {
    HORIZON_STEPS as f64 * STEP_S * v0.max(LEAST_MPS) * LONGER.0 + LONGER.1
}

/// Speed off every lane, m/s.
pub(super) fn assumed_speed(agent_type: AgentType) -> f64 {
    match agent_type {
        AgentType::Pedestrian => OFF_LANES_ON_FOOT_MPS,
        AgentType::Cyclist => OFF_LANES_RIDING_MPS,
        _ => OFF_LANES_DRIVING_MPS,
    }
}

impl UntimedPath {
    pub(super) fn new(
        path: Polyline,
        lateral_mps2: f64,
        limit_mps: f64,
        kind: PathKind,
        route: Option<Route>,
        identity: u64,
        tuning: &AnchorTuning,
    ) -> Self {
        let over_limit = tuning.over_limit;
        let limits_mps: Vec<f64> = match (&route, limit_mps.is_finite()) {
            (Some(route), true) => path
                .arc_m()
                .iter()
                .map(|s| {
                    let i = (*s as usize).min(route.limits_mps.len().saturating_sub(1));
                    // Many drive faster than the posted limit.
                    route.limits_mps.get(i).map_or(limit_mps, |l| over_limit * l)
                })
                .collect(),
            _ => vec![
                if limit_mps.is_finite() { over_limit * limit_mps } else { WITHOUT_LIMIT_MPS };
                path.points().len()
            ],
        };
        let rules = SpeedRules { lateral_mps2, ..SpeedRules::default() };
        let curvatures_per_m = speed::curvatures_per_m(&path);
        let caps_mps = speed::caps_of_bends(path.arc_m(), &curvatures_per_m, &limits_mps, rules);
        let limit_mps = if limit_mps.is_finite() { limit_mps } else { ASSUMED_LIMIT_MPS };
        Self { path, caps_mps, curvatures_per_m, limits_mps, limit_mps, kind, route, identity, pace: None }
    }

    /// Extends the path by another one that begins at its end, at an easy pace of at most `limit_mps`.
    pub(super) fn extend(&mut self, onward: &Polyline, limit_mps: f64) {
        let curvatures = speed::curvatures_per_m(onward);
        let rules = SpeedRules::default();
        let caps = speed::caps_of_bends(onward.arc_m(), &curvatures, &[limit_mps], rules);
        self.caps_mps.extend(caps.into_iter().skip(1));
        self.limits_mps.extend(vec![limit_mps; curvatures.len().saturating_sub(1)]);
        self.curvatures_per_m.extend(curvatures.into_iter().skip(1));
        let points = self.path.points().iter().chain(onward.points().iter().skip(1));
        self.path = Polyline::new(points.copied());
    }

    /// This path followed by another, which begins where this one ends.
    pub(super) fn followed_by(&self, leg: &Self) -> Self {
        let points = self.path.points().iter().chain(leg.path.points().iter().skip(1));
        let kind = if self.kind == leg.kind { self.kind } else { PathKind::Joined };
        Self {
            path: Polyline::new(points.copied()),
            caps_mps: joined(&self.caps_mps, &leg.caps_mps),
            curvatures_per_m: joined(&self.curvatures_per_m, &leg.curvatures_per_m),
            limits_mps: joined(&self.limits_mps, &leg.limits_mps),
            limit_mps: leg.limit_mps,
            kind,
            route: self.route.clone(),
            identity: self.identity.wrapping_mul(1_000_003).wrapping_add(leg.identity),
            pace: None,
        }
    }

    /// Progress over a leg of this path, as comfortable as its time allows.
    pub(super) fn arriving(&self, leg: &TimedLeg, limits: &Limits) -> Progress {
        let manners = HURRY.map(|share| {
            let manner = limits.comfortable.towards(limits.hurried, share);
            let rules = SpeedRules { lateral_mps2: manner.lateral_mps2, brake_mps2: manner.brake_mps2 };
            let caps =
                speed::caps_of_bends(self.path.arc_m(), &self.curvatures_per_m, &self.limits_mps, rules);
            (caps, (manner.accel_mps2, manner.brake_mps2))
        });
        leg.arriving_in_comfort(
            manners.iter().map(|(caps, rates)| (Caps::new(self.path.arc_m(), caps), *rates)),
        )
    }

    pub(super) fn anchor(&self, base: Progress, timing: (usize, usize)) -> Anchor {
        Anchor {
            path: self.path.clone(),
            base,
            caps_mps: self.caps_mps.clone(),
            kind: self.kind,
            route: self.route.clone(),
            identity: self.identity.wrapping_mul(TIMINGS).wrapping_add(timing.0 as u64),
            timing,
            passes_m: Vec::new(),
        }
    }
}

/// Values at the points of a path and of the leg that follows it, whose first point is the path's last.
fn joined(way: &[f64], leg: &[f64]) -> Vec<f64> {
    way.iter().chain(leg.iter().skip(1)).copied().collect()
}

/// Hash of the lanes of a route.
pub(super) fn identity_of(route: &Route) -> u64 {
    route.legs.iter().fold(17, |h: u64, leg| h.wrapping_mul(1_000_003).wrapping_add(leg.lane as u64 + 11))
}

impl Anchor {
    /// Position of the box centre at progress `along` and offset `across`, and the path's heading there.
    pub fn place(&self, along: f64, across: f64) -> (Vec2, f64) {
        let pose = self.path.extrapolate(along);
        let left = direction(pose.heading_rad + std::f64::consts::FRAC_PI_2);
        (pose.position + left * across, pose.heading_rad)
    }

    /// Route coordinates (along, across) of a point, searched near the progress `near`.
    pub fn coordinates(&self, point: Vec2, near: f64) -> (f64, f64) {
        let length = self.path.length_m();
        let foot = self.path.project_between(
            point,
            (near - SEARCHED_M.0).clamp(0.0, length),
            (near + SEARCHED_M.1).clamp(0.0, length),
        );
        if foot.s_m >= length - 1e-6 {
            let end = self.path.last();
            let beyond = (point - end.position).dot(&end.direction());
            let across = scene::geometry::cross(end.direction(), point - end.position);
            return (length + beyond.max(0.0), across);
        }
        if foot.s_m <= 1e-6 {
            let first = self.path.first();
            let behind = (point - first.position).dot(&first.direction());
            let across = scene::geometry::cross(first.direction(), point - first.position);
            return (behind.min(0.0), across);
        }
        (foot.s_m, foot.lateral_m)
    }

    /// Identity of the path without its timing.
    pub fn path_identity(&self) -> u64 {
        self.identity / TIMINGS
    }

    /// Base progress at a step.
    pub fn base_at(&self, step: usize) -> f64 {
        self.base[step.min(HORIZON_STEPS)]
    }
}
