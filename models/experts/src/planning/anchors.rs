//! Anchors: where a road user may go, before any network speaks.
//!
//! With a goal position they are lane routes to it (or the least-effort motion where that is as good);
//! without one, routes ahead, each with several timings. Pedestrians get straight lines beside routes.

use super::MODES;
use super::profile::{Caps, Progress, arriving, cruising, reaching_speed};
use super::world::{AgentAtStart, World};
use crate::tuning::AnchorTuning;
use scene::geometry::direction;
use scene::motion::{Kind, MotionModel, Target, Tension, project};
use scene::routes::{
    EndPose, GoalQuery, Polyline, Route, RouteKind, SpeedRules, base_path, route_length_m, routes_ahead,
    routes_to_goal, speed,
};
use scene::{AgentType, HORIZON_STEPS, STEP_S, Vec2};

/// What kind of path an anchor follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathKind {
    /// Lanes all the way.
    Route,
    /// By a curve onto or off the lanes.
    Joined,
    /// The motion of least effort to the goal: projected for vehicles, a spline under tension for people and riders.
    LeastEffort,
    /// Straight on: no lane is known.
    Straight,
}

/// A path with a base progress along it.
#[derive(Clone, Debug)]
pub struct Anchor {
    /// Path of the box centre, scene frame; begins at the start position.
    pub path: Polyline,
    /// Base progress along it.
    pub base: Progress,
    /// Speed caps at the path's points, m/s.
    pub caps_mps: Vec<f64>,
    /// Where the path came from.
    pub kind: PathKind,
    /// Route behind it, if any.
    pub route: Option<Route>,
    /// Names the path across small changes of the goal, so that modes keep their place while dragging.
    pub identity: u64,
    /// Which timing of its path this is, and of how many.
    pub timing: (usize, usize),
}

/// Names of timings on one path; more than there are modes.
const TIMINGS: u64 = 8;

/// Slots of each path when there are 1 to 6 of them.
const SLOTS: [[usize; MODES]; MODES] = [
    [6, 0, 0, 0, 0, 0],
    [3, 3, 0, 0, 0, 0],
    [2, 2, 2, 0, 0, 0],
    [2, 2, 1, 1, 0, 0],
    [2, 1, 1, 1, 1, 0],
    [1, 1, 1, 1, 1, 1],
];
/// The first path to a goal gets more of the slots than the others.
const GOAL_SLOTS: [[usize; 3]; 3] = [[6, 0, 0], [4, 2, 0], [3, 2, 1]];

/// A path before it has timings.
struct Way {
    path: Polyline,
    caps_mps: Vec<f64>,
    limit_mps: f64,
    kind: PathKind,
    route: Option<Route>,
    identity: u64,
    /// Base progress that comes with the path.
    pace: Option<Progress>,
}

/// The six anchors of a road user.
pub fn anchors(world: &World<'_>, who: &AgentAtStart, model: &MotionModel, target: &Target) -> Vec<Anchor> {
    match target.position {
        Some(goal) => anchors_to_goal(world, who, model, target, goal),
        None => anchors_ahead(world, who, model, target),
    }
}

fn anchors_to_goal(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
) -> Vec<Anchor> {
    let candidates = paths_to_goal(world, who, model, target, goal);
    let seconds = target.step as f64 * STEP_S;
    let v0 = model.start_speed_mps();
    let mut out = Vec::with_capacity(MODES);
    let slots = GOAL_SLOTS[candidates.len().clamp(1, 3) - 1];
    for (candidate, count) in candidates.into_iter().zip(slots) {
        // Whoever must be there in time takes bends as fast as that asks.
        let base = candidate.pace.unwrap_or_else(|| {
            arriving(
                v0,
                goal_progress(&candidate.path, goal),
                seconds,
                target.speed_mps,
                world.tuning.anchors.setting_off_mps2,
            )
        });
        for timing in 0..count {
            out.push(candidate.anchor(base, (timing, count)));
        }
    }
    out
}

/// Progress of the goal along a path that ends at it (or goes on beyond it).
fn goal_progress(path: &Polyline, goal: Vec2) -> f64 {
    let foot = path.project(goal);
    let beyond = (goal - path.last().position).dot(&path.last().direction());
    if foot.s_m >= path.length_m() - 1e-6 && beyond > 0.0 { path.length_m() + beyond } else { foot.s_m }
}

fn paths_to_goal(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
) -> Vec<Way> {
    let v0 = model.start_speed_mps();
    let end = EndPose { position: goal, heading_rad: target.heading_rad };
    if model.kind == Kind::Walk {
        return vec![walk_to(who, model, target, goal, &world.tuning.anchors)];
    }
    let least = project(model, &model.coasting(), target, None);
    let least_path = Polyline::new(least.trajectory.iter().take(target.step + 1).map(|s| s.position));
    let query = GoalQuery {
        pose: who.pose(),
        speed_mps: v0,
        agent_type: who.agent_type,
        goal,
        goal_heading_rad: target.heading_rad,
        least_effort_m: Some(least_path.length_m()),
    };
    let mut out: Vec<Way> = Vec::new();
    let routes = if world.planning.routes { routes_to_goal(&world.graph, &query) } else { Vec::new() };
    for found in routes {
        let path = base_path(&found.route.path, who.pose(), v0, who.agent_type, Some(end));
        let kind = if found.kind == RouteKind::Forward { PathKind::Route } else { PathKind::Joined };
        let identity = identity_of(&found.route);
        out.push(Way::new(
            path,
            3.5,
            f64::INFINITY,
            kind,
            Some(found.route),
            identity,
            &world.tuning.anchors,
        ));
    }
    // Riders keep to no lane's middle and use pavements: the smooth way serves unless a route with the traffic
    // goes elsewhere.
    if who.agent_type == AgentType::Cyclist
        && let Some(mut smooth) = smooth_to(who, model, target, goal, &world.tuning.anchors)
        && out.first().is_none_or(|c| {
            c.kind != PathKind::Route
                || greatest_distance(&smooth.path, &c.path) < world.tuning.anchors.riders_berth_m
        })
    {
        smooth.route = if out.is_empty() { None } else { out.remove(0).route };
        out.insert(0, smooth);
        out.truncate(3);
        return out;
    }
    let near = out.first().is_some_and(|c| greatest_distance(&least_path, &c.path) < 1.0);
    let joined = out.first().is_some_and(|c| c.kind == PathKind::Joined);
    let direct = least.reach.is_reached() && is_direct(least_path.length_m(), who, goal);
    if out.is_empty() || near || (joined && direct) {
        let path = with_tail(least_path, who);
        let route = if near { out.remove(0).route } else { None };
        // Off the lanes a goal with a heading is met straight away; without one the lanes say how.
        let place = usize::from(joined && !near && target.heading_rad.is_none());
        out.insert(
            place,
            Way::new(path, 3.5, f64::INFINITY, PathKind::LeastEffort, route, 1, &world.tuning.anchors),
        );
    }
    out.truncate(3);
    out
}

/// On foot, a spline under tension: it leaves as the person walks now and arrives as the goal asks. Where that
/// would wind, or there is hardly a way to go, the straight line.
fn walk_to(
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
    tuning: &AnchorTuning,
) -> Way {
    if let Some(smooth) = smooth_to(who, model, target, goal, tuning) {
        return smooth;
    }
    let start = who.start.position();
    let chord = goal - start;
    let path = if chord.norm() > 0.3 {
        let n = chord.norm().ceil().max(1.0) as usize;
        Polyline::new((0..=n).map(|i| start + chord * (i as f64 / n as f64)))
    } else {
        Polyline::new([start, start + direction(who.start.heading_rad)])
    };
    Way::new(path, 2.0, model.limits.speed_mps, PathKind::Straight, None, 2, tuning)
}

/// The spline under tension to the goal, as a path with its pace; `None` where it would wind or hardly move.
fn smooth_to(
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
    tuning: &AnchorTuning,
) -> Option<Way> {
    let from = (who.start.position(), who.start.velocity());
    let relax_s = if model.kind == Kind::Walk { tuning.walkers_relax_s } else { tuning.riders_relax_s };
    let curve = Tension::to_target(from, target, relax_s)?;
    let mut pace = [0.0; HORIZON_STEPS + 1];
    let mut points = vec![from.0];
    for step in 1..=HORIZON_STEPS {
        let (here, _) = curve.at(step as f64 * STEP_S);
        pace[step] = pace[step - 1] + (here - points[step - 1]).norm();
        points.push(here);
    }
    if (goal - from.0).norm() <= 1.0 || !is_direct(pace[target.step], who, goal) {
        return None;
    }
    points.truncate(target.step + 1);
    let path = Polyline::new(points);
    let candidate = Way::new(path, 2.0, model.limits.speed_mps, PathKind::LeastEffort, None, 2, tuning);
    Some(Way { pace: Some(pace), ..candidate })
}

/// Whether a way of this length to the goal does not wind.
fn is_direct(length_m: f64, who: &AgentAtStart, goal: Vec2) -> bool {
    length_m < 1.25 * (goal - who.start.position()).norm() + 0.3
}

/// A path long enough to have a direction: very short ones go on along the start heading.
fn with_tail(path: Polyline, who: &AgentAtStart) -> Polyline {
    if path.length_m() > 1.0 {
        return path;
    }
    let start = who.start.position();
    Polyline::new([start, start + direction(who.start.heading_rad) * 2.0])
}

/// Greatest distance of one path's points from another path, metres.
fn greatest_distance(path: &Polyline, other: &Polyline) -> f64 {
    path.points().iter().step_by(5).map(|p| other.project(*p).distance_m).fold(0.0, f64::max)
}

fn anchors_ahead(world: &World<'_>, who: &AgentAtStart, model: &MotionModel, target: &Target) -> Vec<Anchor> {
    let candidates = paths_ahead(world, who, model);
    let v0 = model.start_speed_mps();
    let seconds = target.step as f64 * STEP_S;
    let slots = SLOTS[candidates.len().clamp(1, MODES) - 1];
    let mut out = Vec::with_capacity(MODES);
    for (candidate, count) in candidates.iter().zip(slots) {
        let caps = Caps::new(candidate.path.arc_m(), &candidate.caps_mps);
        for timing in 0..count {
            let share = (timing as f64 + 0.5) / count as f64;
            let base = match (target.speed_mps, model.kind) {
                (Some(speed), _) => {
                    let sag = (share - 0.5) * 0.5 * v0.max(speed).max(1.0);
                    reaching_speed(v0, speed, seconds, sag, &caps)
                }
                (None, Kind::Drive) => {
                    cruising(v0, share * world.tuning.anchors.over_limit * candidate.limit_mps.max(v0), &caps)
                }
                (None, Kind::Walk) => cruising(v0, walking_speed(v0, timing, count), &caps),
            };
            out.push(candidate.anchor(base, (timing, count)));
        }
    }
    out
}

/// Paces on foot: on as now, standing, slower, faster, an even pace.
fn walking_speed(v0: f64, timing: usize, count: usize) -> f64 {
    if count == 1 {
        return v0;
    }
    [v0, 0.0, 0.6 * v0 + 0.2, 1.3 * v0, 1.35, 0.3][timing % 6]
}

fn paths_ahead(world: &World<'_>, who: &AgentAtStart, model: &MotionModel) -> Vec<Way> {
    let v0 = model.start_speed_mps();
    let graph = &world.graph;
    let walking = model.kind == Kind::Walk;
    let length = if walking { 9.0 * v0.max(1.4) * 1.3 + 4.0 } else { route_length_m(v0) };
    let routes = if world.planning.routes {
        routes_ahead(graph, who.pose(), who.agent_type, length)
    } else {
        Vec::new()
    };
    let mut out: Vec<Way> = Vec::with_capacity(MODES);
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
        let comfort = model.limits.comfort_lateral_mps2;
        out.push(Way::new(
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
        out.extend([0.6, -0.6].map(|bend| bent(who, model, length, bend, &world.tuning.anchors)));
    }
    out
}

fn straight_on(who: &AgentAtStart, model: &MotionModel, length: f64, tuning: &AnchorTuning) -> Way {
    let start = who.start.position();
    let (faces, velocity) = (direction(who.start.heading_rad), who.start.velocity());
    // The velocity of a walker sways, so the way it faces says better where it goes, unless it goes elsewhere.
    let aside =
        model.kind == Kind::Walk && velocity.norm() > 0.3 && velocity.dot(&faces) < 0.5 * velocity.norm();
    let ahead = if aside { velocity.normalize() } else { faces };
    let n = length.ceil().max(2.0) as usize;
    let path = Polyline::new((0..=n).map(|i| start + ahead * i as f64));
    Way::new(path, 2.0, assumed_speed(who.agent_type), PathKind::Straight, None, 3, tuning)
}

/// An arc that turns by `bend` radians over the length.
fn bent(who: &AgentAtStart, model: &MotionModel, length: f64, bend: f64, tuning: &AnchorTuning) -> Way {
    let n = length.ceil().max(2.0) as usize;
    let mut at = who.start.position();
    let points: Vec<Vec2> = (0..=n)
        .map(|i| {
            let here = at;
            at += direction(who.start.heading_rad + bend * i as f64 / n as f64);
            here
        })
        .collect();
    let comfort = model.limits.comfort_lateral_mps2;
    let identity = if bend > 0.0 { 4 } else { 5 };
    Way::new(
        Polyline::new(points),
        comfort,
        assumed_speed(who.agent_type),
        PathKind::Straight,
        None,
        identity,
        tuning,
    )
}

/// Speed off every lane, m/s.
fn assumed_speed(agent_type: AgentType) -> f64 {
    match agent_type {
        AgentType::Pedestrian => 1.6,
        AgentType::Cyclist => 5.0,
        _ => 8.0,
    }
}

impl Way {
    fn new(
        path: Polyline,
        lateral_mps2: f64,
        limit_mps: f64,
        kind: PathKind,
        route: Option<Route>,
        identity: u64,
        tuning: &AnchorTuning,
    ) -> Self {
        let over_limit = tuning.over_limit;
        let limits: Vec<f64> = match (&route, limit_mps.is_finite()) {
            (Some(route), true) => path
                .arc_m()
                .iter()
                .map(|s| {
                    let i = (*s as usize).min(route.limits_mps.len().saturating_sub(1));
                    // Many drive faster than the sign says.
                    route.limits_mps.get(i).map_or(limit_mps, |l| over_limit * l)
                })
                .collect(),
            _ => vec![if limit_mps.is_finite() { over_limit * limit_mps } else { 60.0 }; path.points().len()],
        };
        let rules = SpeedRules { lateral_mps2, ..SpeedRules::default() };
        let caps_mps = speed::speed_caps(&path, &limits, rules);
        let limit_mps = if limit_mps.is_finite() { limit_mps } else { 15.0 };
        Self { path, caps_mps, limit_mps, kind, route, identity, pace: None }
    }

    fn anchor(&self, base: Progress, timing: (usize, usize)) -> Anchor {
        Anchor {
            path: self.path.clone(),
            base,
            caps_mps: self.caps_mps.clone(),
            kind: self.kind,
            route: self.route.clone(),
            identity: self.identity.wrapping_mul(TIMINGS).wrapping_add(timing.0 as u64),
            timing,
        }
    }
}

/// Lanes of a route folded into one number.
fn identity_of(route: &Route) -> u64 {
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
            (near - 6.0).clamp(0.0, length),
            (near + 12.0).clamp(0.0, length),
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

    /// Names the path alone, whatever the timing on it.
    pub fn path_identity(&self) -> u64 {
        self.identity / TIMINGS
    }

    /// Progress, base speed and the like at a step.
    pub fn base_at(&self, step: usize) -> f64 {
        self.base[step.min(HORIZON_STEPS)]
    }
}
