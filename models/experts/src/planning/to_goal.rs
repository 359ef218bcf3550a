//! Paths to a goal position: along lanes if they lead there in time, off the lanes only if no lane does.

use super::around::around;
use super::coordinates::MODES;
use super::crossing::by_crosswalk;
use super::legal::broken_m;
use super::profile::{Caps, TimedLeg, fastest, going_on, slowest};
use super::way::{Anchor, PathKind, UntimedPath, identity_of};
use super::world::{AgentAtStart, World};
use crate::tuning::AnchorTuning;
use crate::tuning::fixed::to_goal::{
    AFTER_GOAL_M, ARRIVING_M, DIRECT, LATE_M, LATERAL_MPS2, LEAST_CHORD_M, PRESSED, PRESSED_SHARE,
};
use scene::geometry::direction;
use scene::motion::{MotionKind, MotionModel, Projection, Target, Tension, project};
use scene::routes::{
    EndPose, GoalQuery, GoalRoute, Polyline, RouteKind, base_path, best_route_ahead, further_routes_to_goal,
    routes_to_goal,
};
use scene::score::Drivable;
use scene::{AgentType, HORIZON_STEPS, STEP_S, Vec2};
use std::sync::Arc;

/// Most paths that get anchors.
pub(super) const MOST_WAYS: usize = 3;
/// The first path to a goal gets more of the slots than the others.
pub(super) const GOAL_SLOTS: [[usize; MOST_WAYS]; MOST_WAYS] = [[6, 0, 0], [4, 2, 0], [3, 2, 1]];

/// Anchors to a goal position, [`MODES`] of them.
pub(super) fn anchors_to_goal(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
) -> Vec<Anchor> {
    let candidates = paths_to_goal(world, who, model, target, goal, target.step < HORIZON_STEPS);
    let seconds = target.step as f64 * STEP_S;
    let v0 = model.start_speed_mps();
    let mut out = Vec::with_capacity(MODES);
    let slots = GOAL_SLOTS[candidates.len().clamp(1, 3) - 1];
    for (candidate, count) in candidates.into_iter().zip(slots) {
        let base = candidate.pace.unwrap_or_else(|| {
            let leg = TimedLeg {
                v0,
                from_m: 0.0,
                length_m: goal_progress(&candidate.path, goal),
                seconds,
                end_mps: target.speed_mps,
                easy_mps2: world.tuning.anchors.setting_off_mps2,
            };
            if model.kind == MotionKind::Walk {
                leg.arriving()
            } else {
                candidate.arriving(&leg, &model.limits)
            }
        });
        let caps = Caps::new(candidate.path.arc_m(), &candidate.caps_mps);
        let base = going_on(base, target.step, &caps);
        for timing in 0..count {
            out.push(candidate.anchor(base, (timing, count)));
        }
    }
    out
}

/// Progress of the goal along a path that ends at it or continues beyond it.
pub(super) fn goal_progress(path: &Polyline, goal: Vec2) -> f64 {
    let foot = path.project(goal);
    let beyond = (goal - path.last().position).dot(&path.last().direction());
    if foot.s_m >= path.length_m() - 1e-6 && beyond > 0.0 { path.length_m() + beyond } else { foot.s_m }
}

/// The trip of a vehicle or rider to a goal position.
struct GoalTrip<'a, 'w> {
    world: &'a World<'w>,
    who: &'a AgentAtStart,
    model: &'a MotionModel,
    target: &'a Target,
    goal: Vec2,
    query: GoalQuery,
    /// The motion of least effort, with its path.
    least: Projection,
    least_path: Polyline,
    /// Ground on which it may drive.
    ground: Arc<Drivable>,
}

/// Paths to a goal position, the preferred one first. `goes_on` extends them along the lanes beyond the goal.
pub(super) fn paths_to_goal(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
    goes_on: bool,
) -> Vec<UntimedPath> {
    if model.kind == MotionKind::Walk {
        let straight = walk_to(who, model, target, goal, &world.tuning.anchors);
        let by_crosswalk = by_crosswalk(world, who, model, target, goal, &straight.path);
        let around = around(world, who, model, target, goal);
        return by_crosswalk.into_iter().chain(around).chain([straight]).collect();
    }
    let hurried = project(&model.hurried(), &model.coasting(), target, None);
    let least =
        if hurried.reach.is_reached() { hurried } else { project(model, &model.coasting(), target, None) };
    let least_path = Polyline::new(least.trajectory.iter().take(target.step + 1).map(|s| s.position));
    let v0 = model.start_speed_mps();
    let pace_mps = (goal - who.start.position()).norm() / (target.step as f64 * STEP_S);
    let query = GoalQuery {
        pose: who.pose(),
        // An agent with time to spare changes lanes over a shorter distance than one in a hurry.
        speed_mps: 0.5 * (v0 + pace_mps),
        agent_type: who.agent_type,
        goal,
        goal_heading_rad: target.heading_rad,
        least_effort_m: Some(least_path.length_m()),
    };
    let trip =
        GoalTrip { world, who, model, target, goal, query, least, least_path, ground: world.ground(who) };
    let mut ways = trip.by_the_road(trip.usual());
    ways.truncate(MOST_WAYS);
    if goes_on {
        ways.iter_mut().for_each(|way| trip.go_on(way));
    }
    ways
}

impl GoalTrip<'_, '_> {
    /// Paths that drivers and riders usually take, regardless of the rules: lane routes, and the smooth path
    /// if it is as good.
    fn usual(&self) -> Vec<UntimedPath> {
        let Self { world, who, target, .. } = self;
        let routes =
            if world.planning.routes { routes_to_goal(&world.graph, &self.query) } else { Vec::new() };
        let mut out: Vec<UntimedPath> = routes.into_iter().map(|found| self.along(found)).collect();
        // Riders do not keep to a lane's middle and use pavements. For them the smooth path is enough, unless
        // a route with the traffic leads elsewhere.
        let tuning = &world.tuning.anchors;
        if who.agent_type == AgentType::Cyclist
            && let Some(mut smooth) = smooth_to(who, self.model, target, self.goal, tuning)
            && out.first().is_none_or(|c| {
                c.kind != PathKind::Route || greatest_distance(&smooth.path, &c.path) < tuning.riders_berth_m
            })
        {
            smooth.route = if out.is_empty() { None } else { out.remove(0).route };
            out.insert(0, smooth);
            return out;
        }
        let near = out.first().is_some_and(|c| greatest_distance(&self.least_path, &c.path) < 1.0);
        let joined = out.first().is_some_and(|c| c.kind == PathKind::Joined);
        let direct = self.least.reach.is_reached() && is_direct(self.least_path.length_m(), who, self.goal);
        let shorter = |way: &UntimedPath| self.least_path.length_m() < way.path.length_m();
        let direct_there = self.least.reach.is_reached() && out.first().is_none_or(shorter);
        if !near && direct_there && self.takes_what_is_allowed() {
            out.insert(0, self.least_effort());
            return out;
        }
        if out.is_empty() || near || (joined && direct) {
            let route = if near { out.remove(0).route } else { None };
            // Off the lanes, a goal with a heading is approached directly; without a heading the lanes
            // decide.
            let place = usize::from(joined && !near && target.heading_rad.is_none());
            out.insert(place, UntimedPath { route, ..self.least_effort() });
        }
        out
    }

    /// Whether the motion of least effort crosses an edge that this road user may cross, and no other edge:
    /// the permission was given for this.
    fn takes_what_is_allowed(&self) -> bool {
        let crosses = |ground: &Drivable| {
            let path = self.least_path.points();
            path.windows(2).any(|ends| ground.crosses_an_edge(ends[0], ends[1]))
        };
        let allowed = !self.world.conditions[self.who.index].may_cross.is_empty();
        allowed && crosses(self.world.graph.ground()) && !crosses(&self.ground)
    }

    fn along(&self, found: GoalRoute) -> UntimedPath {
        let GoalQuery { pose, agent_type, .. } = self.query;
        let v0 = self.model.start_speed_mps();
        let pace_mps = found.route.path.length_m() / (self.target.step as f64 * STEP_S);
        // If the speed changes at a constant rate, this is the mean speed over the last half of the path.
        let speed_mps = self.target.speed_mps.unwrap_or((1.5 * pace_mps - 0.5 * v0).max(0.0));
        let end = EndPose { position: self.goal, heading_rad: self.target.heading_rad, speed_mps };
        let path = base_path(&found.route.path, pose, v0, agent_type, Some(end));
        let kind = if found.kind == RouteKind::Forward { PathKind::Route } else { PathKind::Joined };
        let identity = identity_of(&found.route);
        let tuning = &self.world.tuning.anchors;
        UntimedPath::new(path, LATERAL_MPS2, f64::INFINITY, kind, Some(found.route), identity, tuning)
    }

    fn least_effort(&self) -> UntimedPath {
        let path = with_tail(self.least_path.clone(), self.who);
        let tuning = &self.world.tuning.anchors;
        UntimedPath::new(path, LATERAL_MPS2, f64::INFINITY, PathKind::LeastEffort, None, 1, tuning)
    }

    /// The paths that keep to the rules and arrive in time, in order. If there are none, more paths are
    /// searched, and those that break the rules least are used; a detour must be worth its length.
    fn by_the_road(&self, ways: Vec<UntimedPath>) -> Vec<UntimedPath> {
        let tuning = &self.world.tuning.anchors;
        let fine = |cost: f64| cost <= tuning.broken_m;
        let mut judged: Vec<(f64, UntimedPath)> =
            ways.into_iter().map(|way| (self.cost(&way), way)).collect();
        if !judged.iter().any(|(cost, _)| fine(*cost)) {
            if judged.iter().all(|(_, way)| way.kind != PathKind::LeastEffort) {
                let way = self.least_effort();
                judged.push((self.cost(&way), way));
            }
            if self.world.planning.routes {
                let longest_m = self.drivable_m();
                let further = further_routes_to_goal(&self.world.graph, &self.query, longest_m);
                let known: Vec<u64> = judged.iter().map(|(_, way)| way.identity).collect();
                let further = further.into_iter().map(|found| self.along(found));
                let further = further.filter(|way| !known.contains(&way.identity));
                judged.extend(further.map(|way| (self.cost(&way), way)));
            }
            let shortest = judged.iter().map(|(_, way)| way.path.length_m()).fold(f64::INFINITY, f64::min);
            for (cost, way) in &mut judged {
                *cost += tuning.detour * (way.path.length_m() - shortest);
            }
            judged.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let least = judged.iter().map(|(cost, _)| *cost).fold(f64::INFINITY, f64::min);
        let bound = if fine(least) { tuning.broken_m } else { least + tuning.broken_m };
        judged.into_iter().filter(|(cost, _)| *cost <= bound).map(|(_, way)| way).collect()
    }

    /// Metres on which a path breaks the rules, with a large penalty if it does not arrive in time.
    fn cost(&self, way: &UntimedPath) -> f64 {
        let length_m = goal_progress(&way.path, self.goal);
        let late = if self.arrives(way, length_m) { 0.0 } else { LATE_M };
        late + broken_m(&self.ground, self.who, &way.path, length_m)
    }

    /// Whether the goal can be reached in time along a path, within the limits.
    fn arrives(&self, way: &UntimedPath, length_m: f64) -> bool {
        if way.kind == PathKind::LeastEffort {
            return self.least.reach.is_reached();
        }
        let (v0, limits, step) = (self.model.start_speed_mps(), &self.model.limits, self.target.step);
        let caps: Vec<f64> = way.caps_mps.iter().map(|cap| PRESSED * cap).collect();
        let caps = Caps::new(way.path.arc_m(), &caps);
        let soon = fastest(v0, PRESSED_SHARE * limits.accel_mps2, limits.speed_mps, &caps)[step];
        let late = slowest(v0, PRESSED_SHARE * limits.brake_mps2)[step];
        soon >= length_m - ARRIVING_M && late <= length_m + ARRIVING_M
    }

    /// Extends a path to a goal that is due before the window ends along the lanes, if the goal is on one.
    fn go_on(&self, way: &mut UntimedPath) {
        let Self { world, who, target, model, .. } = self;
        if !world.planning.routes || way.path.length_m() < 1.0 {
            return;
        }
        let end = way.path.last();
        let seconds = target.step as f64 * STEP_S;
        let mean_mps = way.path.length_m() / seconds;
        let speed_mps = target.speed_mps.unwrap_or((2.0 * mean_mps - model.start_speed_mps()).max(0.0));
        let left_s = HORIZON_STEPS as f64 * STEP_S - seconds;
        let length_m = speed_mps * left_s + AFTER_GOAL_M;
        let Some(route) = best_route_ahead(&world.graph, end, who.agent_type, length_m) else {
            return;
        };
        let limit_mps = route.limits_mps.first().copied().unwrap_or(f64::INFINITY);
        way.extend(&base_path(&route.path, end, speed_mps, who.agent_type, None), limit_mps);
    }

    /// Distance that a driver covers in the time at an easy pace, metres.
    fn drivable_m(&self) -> f64 {
        let AnchorTuning { easy_mps, setting_off_mps2, .. } = self.world.tuning.anchors;
        let caps = Caps::new(&[0.0], &[f64::INFINITY]);
        fastest(self.model.start_speed_mps(), setting_off_mps2, easy_mps, &caps)[self.target.step]
    }
}

/// On foot, a spline under tension: it leaves in the present direction of walking and arrives as the goal
/// asks. If that would wind, or the path is very short, the straight line.
fn walk_to(
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
    tuning: &AnchorTuning,
) -> UntimedPath {
    if let Some(smooth) = smooth_to(who, model, target, goal, tuning) {
        return smooth;
    }
    let start = who.start.position();
    let chord = goal - start;
    let path = if chord.norm() > LEAST_CHORD_M {
        let n = chord.norm().ceil().max(1.0) as usize;
        Polyline::new((0..=n).map(|i| start + chord * (i as f64 / n as f64)))
    } else {
        Polyline::new([start, start + direction(who.start.heading_rad)])
    };
    UntimedPath::new(path, 2.0, model.limits.speed_mps, PathKind::Straight, None, 2, tuning)
}

/// The spline under tension to the goal, as a path with its pace; `None` if it would wind or hardly move.
fn smooth_to(
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
    tuning: &AnchorTuning,
) -> Option<UntimedPath> {
    let from = (who.start.position(), who.start.velocity());
    let relax_s = if model.kind == MotionKind::Walk { tuning.walkers_relax_s } else { tuning.riders_relax_s };
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
    let candidate =
        UntimedPath::new(path, 2.0, model.limits.speed_mps, PathKind::LeastEffort, None, 2, tuning);
    Some(UntimedPath { pace: Some(pace), ..candidate })
}

/// Whether a path of this length to the goal does not wind.
fn is_direct(length_m: f64, who: &AgentAtStart, goal: Vec2) -> bool {
    length_m < DIRECT.0 * (goal - who.start.position()).norm() + DIRECT.1
}

/// A path long enough to have a direction: very short ones are extended along the start heading.
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
