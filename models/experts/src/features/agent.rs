//! What an expert sees of one road user: its own state and condition, the others, its anchors, and the
//! projections that keep a fixed goal.

use super::{ANCHOR, AgentFeatures, NEIGHBOUR, NEIGHBOURS, OWN};
use crate::planning::anchors::{Anchor, PathKind, anchors};
use crate::planning::profile::speed_at;
use crate::planning::world::{AgentAtStart, World};
use crate::planning::{MODES, hat, integrated_hat, twice_integrated_hat};
use nalgebra::DMatrix;
use scene::geometry::{direction, rotate};
use scene::motion::{MotionModel, Target};
use scene::routes::{Beside, LaneGraph, Leg, Route, speed};
use scene::{AgentType, HORIZON_STEPS, KNOT_S, KNOTS, STEP_S, SignalState, Subtype, Vec2, wrap_angle};
use std::ops::Range;

/// A road user ready for its expert.
#[derive(Clone, Debug)]
pub struct AgentPlan {
    /// Who and where.
    pub present: AgentAtStart,
    /// How it can move.
    pub model: MotionModel,
    /// What it must meet.
    pub target: Target,
    /// [`MODES`] of them.
    pub anchors: Vec<Anchor>,
    /// For the networks.
    pub features: AgentFeatures,
    /// Motions are projected onto the goal: see [`Planning::projection`](crate::planning::world::Planning).
    pub projected: bool,
}

/// Which of the numbers about the road user itself speak of its goal: time, masks, values.
pub const OWN_GOAL: Range<usize> = 11..25;
/// The mask bit of the goal's position among them.
pub const OWN_GOAL_POSITION: usize = 12;
/// Which of a neighbour's numbers speak of its goal.
pub const NEIGHBOUR_GOAL: Range<usize> = 15..19;

/// Works out anchors and features of one road user.
pub fn plan(world: &World<'_>, who: &AgentAtStart) -> AgentPlan {
    let anchors = anchors(world, who, &world.model(who), &world.target(who));
    plan_with(world, who, anchors)
}

/// Features of a road user with given anchors, [`MODES`] of them.
pub fn plan_with(world: &World<'_>, who: &AgentAtStart, anchors: Vec<Anchor>) -> AgentPlan {
    let model = world.model(who);
    let target = world.target(who);
    let frame = Frame::of(who);
    let mut encoded = Box::new([[0.0; ANCHOR]; MODES]);
    let obstacles = world.obstacles(who.index);
    let mut last: Option<(u64, PathFacts)> = None;
    for (slot, anchor) in anchors.iter().enumerate() {
        let path_identity = anchor.identity / 8;
        // Slots of one path share what can be said of the path.
        let facts = match last.take() {
            Some((identity, facts)) if identity == path_identity => facts,
            _ => PathFacts::of(world, who, anchor, &obstacles),
        };
        encoded[slot] = encode_anchor(&frame, anchor, &facts, slot);
        last = Some((path_identity, facts));
    }
    let features = AgentFeatures {
        own: encode_own(world, who, &model, &target, &frame),
        neighbours: neighbours(world, who, &frame),
        anchors: encoded,
        tangent: Box::new(tangent(&target)),
    };
    let projected = world.planning.projection;
    AgentPlan { present: who.clone(), model, target, anchors, features, projected }
}

/// The road user's frame: x ahead, y left.
struct Frame {
    origin: Vec2,
    heading_rad: f64,
}

impl Frame {
    fn of(who: &AgentAtStart) -> Self {
        Self { origin: who.start.position(), heading_rad: who.start.heading_rad }
    }

    fn point(&self, p: Vec2) -> Vec2 {
        rotate(p - self.origin, -self.heading_rad)
    }

    fn vector(&self, v: Vec2) -> Vec2 {
        rotate(v, -self.heading_rad)
    }

    fn heading(&self, h: f64) -> Vec2 {
        direction(h - self.heading_rad)
    }
}

/// Fills an array of numbers from the left; what does not fit is a defect that tests catch.
struct Filler<const N: usize> {
    values: [f32; N],
    at: usize,
}

impl<const N: usize> Filler<N> {
    fn new() -> Self {
        Self { values: [0.0; N], at: 0 }
    }

    fn push(&mut self, value: f64) {
        debug_assert!(self.at < N, "more than {N} numbers");
        if let Some(slot) = self.values.get_mut(self.at) {
            // Bounded so that a far goal or a wild log cannot drown everything else.
            *slot = if value.is_finite() { value.clamp(-20.0, 20.0) as f32 } else { 0.0 };
        }
        self.at += 1;
    }

    fn flag(&mut self, value: bool) {
        self.push(f64::from(u8::from(value)));
    }

    fn vector(&mut self, v: Vec2, scale: f64) {
        self.push(v.x / scale);
        self.push(v.y / scale);
    }
}

fn type_flags<const N: usize>(out: &mut Filler<N>, agent_type: AgentType, subtype: Subtype) {
    out.flag(agent_type == AgentType::Vehicle);
    out.flag(agent_type == AgentType::Pedestrian);
    out.flag(agent_type == AgentType::Cyclist);
    out.flag(matches!(subtype, Subtype::Truck | Subtype::Bus | Subtype::Trailer));
}

fn encode_own(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    frame: &Frame,
) -> [f32; OWN] {
    let mut out = Filler::<OWN>::new();
    let v0 = model.start_speed_mps();
    let subtype = world.agent(who).subtype;
    type_flags(&mut out, who.agent_type, subtype);
    out.flag(subtype == Subtype::Motorcycle);
    out.push(v0 / 10.0);
    out.flag(v0 < 0.3);
    out.vector(frame.vector(who.start.velocity()), 10.0);
    out.push(who.size.length_m / 5.0);
    out.push(who.size.width_m / 2.0);
    let seconds = target.step as f64 * STEP_S;
    out.push(seconds / 9.0);
    out.flag(target.position.is_some());
    out.flag(target.heading_rad.is_some());
    out.flag(target.speed_mps.is_some());
    let goal = target.position.map(|p| frame.point(p));
    let local = goal.unwrap_or_default();
    out.vector(local, 50.0);
    out.push(local.norm() / 50.0);
    let bearing = if local.norm() > 0.1 { local.normalize() } else { Vec2::zeros() };
    out.vector(bearing, 1.0);
    // How much faster or slower than now the goal asks to be on average.
    out.push(if goal.is_some() { (local.norm() / seconds - v0) / 5.0 } else { 0.0 });
    let heading = target.heading_rad.map_or(Vec2::zeros(), |h| frame.heading(h));
    out.vector(heading, 1.0);
    out.push(target.speed_mps.unwrap_or(0.0) / 10.0);
    out.push(target.speed_mps.map_or(0.0, |v| (v - v0) / 5.0));
    let lanes = world.graph.nearest_for(who.start.position(), 6.0, who.agent_type);
    let nearest = lanes.first();
    out.flag(nearest.is_some());
    out.push(nearest.map_or(3.0, |l| l.lateral_m) / 3.0);
    let off = nearest.map_or(0.0, |l| wrap_angle(who.start.heading_rad - l.heading_rad));
    out.push(off.cos());
    out.push(off.sin());
    let near = |reach: f64| {
        let close = |p: &&AgentAtStart| (p.start.position() - who.start.position()).norm() < reach;
        world.present.iter().filter(close).count() as f64 - 1.0
    };
    out.push(near(10.0) / 5.0);
    out.push(near(30.0) / 15.0);
    out.values
}

fn neighbours(world: &World<'_>, who: &AgentAtStart, frame: &Frame) -> Vec<[f32; NEIGHBOUR]> {
    let mut order: Vec<(f64, &AgentAtStart)> = world
        .present
        .iter()
        .filter(|p| p.index != who.index)
        .map(|p| {
            let local = frame.point(p.start.position());
            let parked = if p.start.speed_mps() < 0.1 { 6.0 } else { 0.0 };
            (local.norm() - 0.3 * local.x.clamp(-30.0, 30.0) + parked, p)
        })
        .filter(|(rank, _)| *rank < 100.0)
        .collect();
    // Stable: equal ranks stay in the world's order.
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.truncate(NEIGHBOURS);
    order.into_iter().map(|(_, p)| encode_neighbour(world, p, frame)).collect()
}

fn encode_neighbour(world: &World<'_>, other: &AgentAtStart, frame: &Frame) -> [f32; NEIGHBOUR] {
    let mut out = Filler::<NEIGHBOUR>::new();
    let agent = world.agent(other);
    let local = frame.point(other.start.position());
    out.vector(local, 30.0);
    out.push(local.norm() / 30.0);
    out.vector(frame.heading(other.start.heading_rad), 1.0);
    out.vector(frame.vector(other.start.velocity()), 10.0);
    out.push(other.start.speed_mps() / 10.0);
    out.flag(other.start.speed_mps() < 0.1);
    type_flags(&mut out, other.agent_type, agent.subtype);
    out.push(other.size.length_m / 5.0);
    out.push(other.size.width_m / 2.0);
    let goal = &world.conditions[other.index].goal;
    out.flag(goal.position.is_some());
    let fixed = goal.position.map_or(Vec2::zeros(), |p| frame.point(p));
    out.vector(fixed, 50.0);
    out.push(goal.speed_mps.unwrap_or(-1.0) / 10.0);
    out.values
}

fn signal_flags<const N: usize>(out: &mut Filler<N>, state: Option<SignalState>) {
    out.flag(state.is_some());
    out.flag(state.is_some_and(SignalState::is_stop));
    out.flag(state.is_some_and(SignalState::is_caution));
    out.flag(matches!(state, Some(SignalState::Go | SignalState::ArrowGo)));
}

/// Standing road users this far ahead count as a queue, metres.
const QUEUE_M: f64 = 60.0;

/// What can be said of a path whatever the timing on it.
struct PathFacts {
    leader: Option<speed::Leader>,
    /// The one ahead of the leader.
    second: Option<speed::Leader>,
    /// Standing road users on the path within [`QUEUE_M`].
    queue: usize,
    light: Option<(SignalState, f64, f64)>,
    stop_sign_m: Option<f64>,
    /// Nearest crossing road user: distance along the path, its time to get there, its speed.
    crossing: Option<(f64, f64, f64)>,
    junction: Option<Junction>,
    /// Lanes that run beside the first one: the same way on its left and on its right, the other way.
    beside: [usize; 3],
}

/// The first junction on a path, as the map's connecting lanes say.
struct Junction {
    from_m: f64,
    to_m: f64,
    /// How far the path turns in it, radians to the left.
    turn_rad: f64,
    /// Ways that the lane before it leads on.
    ways: usize,
}

impl PathFacts {
    fn of(world: &World<'_>, who: &AgentAtStart, anchor: &Anchor, obstacles: &[speed::Obstacle]) -> Self {
        let light = anchor.route.as_ref().and_then(|route| {
            let ahead = speed::first_signal(route, &world.graph, &world.signals)?;
            Some((ahead.state, ahead.distance_m, world.signal_ages_s.get(ahead.index).copied()?))
        });
        let stop_sign_m =
            anchor.route.as_ref().and_then(|route| speed::stop_sign_distance_m(route, &world.graph));
        let ahead = speed::leaders(&anchor.path, who.size.length_m, obstacles);
        let waits = |l: &&speed::Leader| l.gap_m < QUEUE_M && obstacles[l.index].speed_mps < 0.5;
        Self {
            leader: ahead.first().copied(),
            second: ahead.get(1).copied(),
            queue: ahead.iter().filter(waits).count(),
            light,
            stop_sign_m,
            crossing: crossing(anchor, obstacles),
            junction: anchor.route.as_ref().and_then(|route| junction(route, &world.graph)),
            beside: anchor.route.as_ref().map_or([0; 3], |route| beside(route, &world.graph)),
        }
    }
}

/// The first junction that a route passes, or in which it begins.
fn junction(route: &Route, graph: &LaneGraph) -> Option<Junction> {
    let connects = |leg: &Leg| graph.lanes()[leg.lane].interpolating;
    let first = route.legs.iter().position(connects)?;
    let through = route.legs[first..].iter().take_while(|leg| connects(leg)).count();
    let last = &route.legs[first + through - 1];
    let (from_m, to_m) = (route.legs[first].path_from_m, last.path_from_m + last.to_m - last.from_m);
    let heading = |s_m: f64| route.path.sample(s_m).heading_rad;
    let ways = first.checked_sub(1).map_or(1, |k| graph.lanes()[route.legs[k].lane].successors.len());
    Some(Junction { from_m, to_m, turn_rad: wrap_angle(heading(to_m) - heading(from_m)), ways })
}

/// Lanes beside the start of a route: see [`PathFacts::beside`].
fn beside(route: &Route, graph: &LaneGraph) -> [usize; 3] {
    let Some(leg) = route.legs.first() else { return [0; 3] };
    let lane = &graph.lanes()[leg.lane];
    let count = |side: &[Beside], same_way: bool| {
        side.iter().filter(|b| b.same_direction == same_way && b.across(leg.from_m).is_some()).count()
    };
    [count(&lane.left, true), count(&lane.right, true), count(&lane.left, false)]
}

/// The road user whose straight way on meets the path soonest.
fn crossing(anchor: &Anchor, obstacles: &[speed::Obstacle]) -> Option<(f64, f64, f64)> {
    let mut soonest: Option<(f64, f64, f64)> = None;
    for other in obstacles.iter().filter(|o| o.speed_mps > 0.5) {
        let (from, ahead) = (other.outline.center(), other.outline.forward());
        for seconds in [1.0, 2.0, 3.0, 4.5, 6.0] {
            let there = from + ahead * (other.speed_mps * seconds);
            let foot = anchor.path.project(there);
            let across = direction(foot.heading_rad).dot(&ahead).abs() < 0.75;
            if foot.distance_m < 3.0 && foot.s_m > 3.0 && across {
                if soonest.is_none_or(|s| seconds < s.1) {
                    soonest = Some((foot.s_m, seconds, other.speed_mps));
                }
                break;
            }
        }
    }
    soonest
}

fn encode_anchor(frame: &Frame, anchor: &Anchor, facts: &PathFacts, slot: usize) -> [f32; ANCHOR] {
    let mut out = Filler::<ANCHOR>::new();
    let reach = anchor.base[90].max(12.0);
    for i in 1..=8 {
        let s = reach * 1.3 * f64::from(i) / 8.0;
        let pose = anchor.path.extrapolate(s);
        out.vector(frame.point(pose.position), 30.0);
        out.vector(frame.heading(pose.heading_rad), 1.0);
        let at = anchor.path.arc_m().partition_point(|a| *a < s).min(anchor.caps_mps.len().saturating_sub(1));
        out.push(anchor.caps_mps.get(at).copied().unwrap_or(15.0).min(40.0) / 10.0);
    }
    for step in [10, 20, 35, 50, 70, 90] {
        out.push(anchor.base[step] / 30.0);
        out.push(speed_at(&anchor.base, step) / 10.0);
    }
    out.push(anchor.path.length_m() / 100.0);
    out.flag(facts.leader.is_some());
    let (gap, leader_speed) = facts.leader.map_or((100.0, 0.0), |l| (l.gap_m, l.speed_mps));
    out.push(gap / 30.0);
    out.push((30.0 / gap.max(1.0)).ln());
    out.push(leader_speed / 10.0);
    signal_flags(&mut out, facts.light.map(|l| l.0));
    out.push(facts.light.map_or(100.0, |l| l.1) / 30.0);
    out.push(facts.light.map_or(0.0, |l| l.2) / 10.0);
    out.flag(facts.stop_sign_m.is_some());
    out.push(facts.stop_sign_m.unwrap_or(100.0) / 30.0);
    out.flag(facts.crossing.is_some());
    let (where_m, when_s, speed) = facts.crossing.unwrap_or((100.0, 9.0, 0.0));
    out.push(where_m / 30.0);
    out.push(when_s / 9.0);
    out.push(speed / 10.0);
    let route = anchor.route.as_ref();
    out.push(route.and_then(|r| r.limits_mps.first().copied()).unwrap_or(0.0) / 15.0);
    out.push(route.map_or(0.0, |r| r.lateral_m) / 3.0);
    out.push(route.map_or(0.0, |r| r.heading_error_rad));
    out.flag(route.is_some_and(|r| r.terminal));
    for kind in [PathKind::Route, PathKind::Joined, PathKind::LeastEffort, PathKind::Straight] {
        out.flag(anchor.kind == kind);
    }
    for i in 0..MODES {
        out.flag(i == slot);
    }
    let (timing, count) = anchor.timing;
    out.push((timing as f64 + 0.5) / count as f64);
    out.push(count as f64 / 6.0);
    out.flag(facts.second.is_some());
    out.push(facts.second.map_or(100.0, |l| l.gap_m) / 30.0);
    out.push(facts.second.map_or(0.0, |l| l.speed_mps) / 10.0);
    out.push(facts.queue as f64 / 5.0);
    // What this timing does about what is ahead: when it gets to the light, to the leader (who is taken
    // to drive on as now) and to where another crosses.
    let light = facts.light.and_then(|l| first_step(|step| anchor.base[step] >= l.1));
    out.push(seconds_of(light) / 9.0);
    out.push(light.map_or(0.0, |step| speed_at(&anchor.base, step)) / 10.0);
    let met = facts
        .leader
        .and_then(|l| first_step(|step| anchor.base[step] >= l.gap_m + l.speed_mps * step as f64 * STEP_S));
    out.push(seconds_of(met) / 9.0);
    let there = facts.crossing.and_then(|c| first_step(|step| anchor.base[step] >= c.0));
    out.push(there.zip(facts.crossing).map_or(1.0, |(step, c)| (step as f64 * STEP_S - c.1) / 9.0));
    let junction = facts.junction.as_ref();
    out.flag(junction.is_some());
    out.push(junction.map_or(100.0, |j| j.from_m) / 30.0);
    out.push(junction.map_or(100.0, |j| j.to_m) / 30.0);
    out.push(junction.map_or(0.0, |j| j.turn_rad));
    out.push(junction.map_or(1.0, |j| j.ways as f64) / 3.0);
    let entered = junction.and_then(|j| first_step(|step| anchor.base[step] >= j.from_m));
    out.push(seconds_of(entered) / 9.0);
    out.push(entered.map_or(0.0, |step| speed_at(&anchor.base, step)) / 10.0);
    for lanes in facts.beside {
        out.push(lanes as f64 / 2.0);
    }
    out.values
}

/// The first step of the window at which something holds.
fn first_step(holds: impl Fn(usize) -> bool) -> Option<usize> {
    (1..=HORIZON_STEPS).find(|step| holds(*step))
}

/// A step in seconds; what does not happen in the window lies beyond it.
fn seconds_of(step: Option<usize>) -> f64 {
    step.map_or(12.0, |step| step as f64 * STEP_S)
}

/// Projections of the residual knots onto those that leave the fixed goal fields alone. The base meets
/// the goal already: along, position and speed at the goal's step; across, offset and, where the heading
/// is fixed, drift.
fn tangent(target: &Target) -> [[[f32; KNOTS]; KNOTS]; 2] {
    let t = target.step as f64 * STEP_S;
    let row = |f: fn(usize, f64) -> f64| (0..KNOTS).map(|k| f(k, t)).collect::<Vec<_>>();
    let mut along = Vec::new();
    if target.position.is_some() {
        along.push(row(twice_integrated_hat));
    }
    if target.speed_mps.is_some() {
        along.push(row(integrated_hat));
    }
    // The first offset is zero by definition.
    let mut across = vec![(0..KNOTS).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect::<Vec<_>>()];
    if target.position.is_some() {
        across.push(row(hat));
    }
    if target.position.is_some() && target.heading_rad.is_some() {
        let last = (t / KNOT_S - 1e-9).floor() as usize;
        let drift = (0..KNOTS).map(|k| match k {
            k if k == last => -1.0,
            k if k == last + 1 => 1.0,
            _ => 0.0,
        });
        across.push(drift.collect());
    }
    [null_space_projection(&along), null_space_projection(&across)]
}

/// `I - A' (A A')^-1 A` of the rows of A.
fn null_space_projection(rows: &[Vec<f64>]) -> [[f32; KNOTS]; KNOTS] {
    let mut projection = DMatrix::<f64>::identity(KNOTS, KNOTS);
    if !rows.is_empty() {
        let a = DMatrix::from_fn(rows.len(), KNOTS, |i, j| rows[i][j]);
        let gram = &a * a.transpose() + DMatrix::identity(rows.len(), rows.len()) * 1e-9;
        if let Some(inverse) = gram.try_inverse() {
            projection -= a.transpose() * inverse * &a;
        }
    }
    let mut out = [[0.0; KNOTS]; KNOTS];
    for i in 0..KNOTS {
        for j in 0..KNOTS {
            out[i][j] = projection[(i, j)] as f32;
        }
    }
    out
}
