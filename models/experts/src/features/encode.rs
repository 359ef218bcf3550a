//! Encodes a road user, its neighbours and its anchors as rows of the tables.

use super::ahead::{LightAhead, PathFacts};
use super::block::{encoded, flag};
use super::tables::{
    ANCHOR, AnchorInputs, BASE_STEPS, BaseInstant, KindFlags, LightFlags, NEIGHBOUR, NEIGHBOURS, Neighbour,
    OWN, Own, PATH_POINTS, PathFlags, PathPoint,
};
use crate::planning::MODES;
use crate::planning::anchors::{Anchor, PathKind};
use crate::planning::profile::speed_at;
use crate::planning::world::{AgentAtStart, World};
use scene::geometry::{direction, rotate};
use scene::motion::{MotionModel, Target};
use scene::{AgentType, HORIZON_STEPS, STANDING_MPS, STEP_S, SignalState, Subtype, Vec2, wrap_angle};

/// Speed below which another road user counts as not moving, m/s.
const STILL_MPS: f64 = 0.1;
/// Distance of something that does not exist, metres.
const FAR_M: f64 = 100.0;
/// Time of an event that does not occur in the window, seconds.
const NEVER_S: f64 = 12.0;

/// The road user's frame: x ahead, y left.
pub(super) struct AgentFrame {
    origin: Vec2,
    heading_rad: f64,
}

impl AgentFrame {
    pub(super) fn of(who: &AgentAtStart) -> Self {
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

fn kind_flags(agent_type: AgentType, subtype: Subtype) -> KindFlags {
    KindFlags {
        vehicle: flag(agent_type == AgentType::Vehicle),
        pedestrian: flag(agent_type == AgentType::Pedestrian),
        cyclist: flag(agent_type == AgentType::Cyclist),
        heavy: flag(matches!(subtype, Subtype::Truck | Subtype::Bus | Subtype::Trailer)),
    }
}

/// The road user itself and its target.
pub(super) fn own(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    frame: &AgentFrame,
) -> [f32; OWN] {
    let v0 = model.start_speed_mps();
    let subtype = world.agent(who).subtype;
    let velocity = frame.vector(who.start.velocity());
    let seconds = target.step as f64 * STEP_S;
    let goal = target.position.map(|p| frame.point(p));
    let local = goal.unwrap_or_default();
    let bearing = if local.norm() > 0.1 { local.normalize() } else { Vec2::zeros() };
    let heading = target.heading_rad.map_or(Vec2::zeros(), |h| frame.heading(h));
    let lanes = world.graph.nearest_for(who.start.position(), 6.0, who.agent_type);
    let lane = lanes.first();
    let off = lane.map_or(0.0, |l| wrap_angle(who.start.heading_rad - l.heading_rad));
    let others_within = |reach_m: f64| {
        let close = |p: &&AgentAtStart| (p.start.position() - who.start.position()).norm() < reach_m;
        world.present.iter().filter(close).count() as f64 - 1.0
    };
    encoded(&Own {
        kind: [kind_flags(who.agent_type, subtype)],
        motorcycle: flag(subtype == Subtype::Motorcycle),
        speed: v0,
        stands: flag(v0 < STANDING_MPS),
        velocity_ahead: velocity.x,
        velocity_left: velocity.y,
        length: who.size.length_m,
        width: who.size.width_m,
        goal_time: seconds,
        goal_position_fixed: flag(target.position.is_some()),
        goal_heading_fixed: flag(target.heading_rad.is_some()),
        goal_speed_fixed: flag(target.speed_mps.is_some()),
        goal_ahead: local.x,
        goal_left: local.y,
        goal_distance: local.norm(),
        goal_bearing_cos: bearing.x,
        goal_bearing_sin: bearing.y,
        goal_pace_change: if goal.is_some() { local.norm() / seconds - v0 } else { 0.0 },
        goal_heading_cos: heading.x,
        goal_heading_sin: heading.y,
        goal_speed: target.speed_mps.unwrap_or(0.0),
        goal_speed_change: target.speed_mps.map_or(0.0, |v| v - v0),
        on_lane: flag(lane.is_some()),
        lane_offset: lane.map_or(3.0, |l| l.lateral_m),
        lane_heading_cos: off.cos(),
        lane_heading_sin: off.sin(),
        others_within_10_m: others_within(10.0),
        others_within_30_m: others_within(30.0),
    })
}

/// The most important other road users: near before far, ahead before behind, moving before standing.
pub(super) fn neighbours(world: &World<'_>, who: &AgentAtStart, frame: &AgentFrame) -> Vec<[f32; NEIGHBOUR]> {
    let mut order: Vec<(f64, &AgentAtStart)> = world
        .present
        .iter()
        .filter(|p| p.index != who.index)
        .map(|p| {
            let local = frame.point(p.start.position());
            let parked = if p.start.speed_mps() < STILL_MPS { 6.0 } else { 0.0 };
            (local.norm() - 0.3 * local.x.clamp(-30.0, 30.0) + parked, p)
        })
        .filter(|(rank, _)| *rank < FAR_M)
        .collect();
    // A stable sort: equal ranks stay in the world's order.
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.truncate(NEIGHBOURS);
    order.into_iter().map(|(_, p)| neighbour(world, p, frame)).collect()
}

fn neighbour(world: &World<'_>, other: &AgentAtStart, frame: &AgentFrame) -> [f32; NEIGHBOUR] {
    let local = frame.point(other.start.position());
    let heading = frame.heading(other.start.heading_rad);
    let velocity = frame.vector(other.start.velocity());
    let goal = &world.conditions[other.index].goal;
    let fixed = goal.position.map_or(Vec2::zeros(), |p| frame.point(p));
    encoded(&Neighbour {
        ahead: local.x,
        left: local.y,
        distance: local.norm(),
        heading_cos: heading.x,
        heading_sin: heading.y,
        velocity_ahead: velocity.x,
        velocity_left: velocity.y,
        speed: other.start.speed_mps(),
        stands: flag(other.start.speed_mps() < STILL_MPS),
        kind: [kind_flags(other.agent_type, world.agent(other).subtype)],
        length: other.size.length_m,
        width: other.size.width_m,
        goal_fixed: flag(goal.position.is_some()),
        goal_ahead: fixed.x,
        goal_left: fixed.y,
        goal_speed: goal.speed_mps.unwrap_or(-1.0),
    })
}

fn light_flags(light: Option<&LightAhead>) -> LightFlags {
    let state = light.map(|light| light.state);
    LightFlags {
        known: flag(state.is_some()),
        stop: flag(state.is_some_and(SignalState::is_stop)),
        caution: flag(state.is_some_and(SignalState::is_caution)),
        go: flag(matches!(state, Some(SignalState::Go | SignalState::ArrowGo))),
    }
}

fn path_points(frame: &AgentFrame, anchor: &Anchor) -> [PathPoint; PATH_POINTS] {
    let reach_m = 1.3 * anchor.base[HORIZON_STEPS].max(12.0);
    std::array::from_fn(|i| {
        let s = reach_m * (i + 1) as f64 / PATH_POINTS as f64;
        let pose = anchor.path.extrapolate(s);
        let (position, heading) = (frame.point(pose.position), frame.heading(pose.heading_rad));
        let last = anchor.caps_mps.len().saturating_sub(1);
        let at = anchor.path.arc_m().partition_point(|a| *a < s).min(last);
        PathPoint {
            ahead: position.x,
            left: position.y,
            heading_cos: heading.x,
            heading_sin: heading.y,
            cap: anchor.caps_mps.get(at).copied().unwrap_or(15.0).min(40.0),
        }
    })
}

/// An anchor in its slot, with the facts about its path ahead.
pub(super) fn anchor(frame: &AgentFrame, anchor: &Anchor, facts: &PathFacts, slot: usize) -> [f32; ANCHOR] {
    let base = &anchor.base;
    let route = anchor.route.as_ref();
    let light = facts.light.as_ref();
    let lit = light.and_then(|l| first_step(|step| base[step] >= l.distance_m));
    let leader = facts.leader.as_ref();
    let gap_m = leader.map_or(FAR_M, |l| l.gap_m);
    let met =
        leader.and_then(|l| first_step(|step| base[step] >= l.gap_m + l.speed_mps * step as f64 * STEP_S));
    let crossing = facts.crossing;
    let crossed = crossing.and_then(|c| first_step(|step| base[step] >= c.distance_m));
    let crossing_lead = crossed.zip(crossing).map_or(9.0, |(step, c)| step as f64 * STEP_S - c.time_s);
    let junction = facts.junction.as_ref();
    let entered = junction.and_then(|j| first_step(|step| base[step] >= j.from_m));
    let speed_then = |step: Option<usize>| step.map_or(0.0, |step| speed_at(base, step));
    let second = facts.second.as_ref();
    let (timing, timings) = anchor.timing;
    let [lanes_left, lanes_right, lanes_oncoming] = facts.beside.map(|lanes| lanes as f64);
    encoded(&AnchorInputs {
        path: path_points(frame, anchor),
        base: BASE_STEPS.map(|step| BaseInstant { along: base[step], speed: speed_at(base, step) }),
        path_length: anchor.path.length_m(),
        leader: flag(leader.is_some()),
        leader_gap: gap_m,
        leader_closeness: (30.0 / gap_m.max(1.0)).ln(),
        leader_speed: leader.map_or(0.0, |l| l.speed_mps),
        light: [light_flags(light)],
        light_distance: light.map_or(FAR_M, |l| l.distance_m),
        light_age: light.map_or(0.0, |l| l.age_s),
        stop_sign: flag(facts.stop_sign_m.is_some()),
        stop_sign_distance: facts.stop_sign_m.unwrap_or(FAR_M),
        crossing: flag(crossing.is_some()),
        crossing_distance: crossing.map_or(FAR_M, |c| c.distance_m),
        crossing_time: crossing.map_or(9.0, |c| c.time_s),
        crossing_speed: crossing.map_or(0.0, |c| c.speed_mps),
        speed_limit: route.and_then(|r| r.limits_mps.first().copied()).unwrap_or(0.0),
        lateral: route.map_or(0.0, |r| r.lateral_m),
        heading_error: route.map_or(0.0, |r| r.heading_error_rad),
        terminal: flag(route.is_some_and(|r| r.terminal)),
        origin: [PathFlags {
            route: flag(anchor.kind == PathKind::Route),
            joined: flag(anchor.kind == PathKind::Joined),
            least_effort: flag(anchor.kind == PathKind::LeastEffort),
            straight: flag(anchor.kind == PathKind::Straight),
        }],
        slot: std::array::from_fn::<f64, MODES, _>(|i| flag(i == slot)),
        timing: (timing as f64 + 0.5) / timings as f64,
        timings: timings as f64,
        second_leader: flag(second.is_some()),
        second_gap: second.map_or(FAR_M, |l| l.gap_m),
        second_speed: second.map_or(0.0, |l| l.speed_mps),
        queue: facts.queue as f64,
        light_reached: seconds_of(lit),
        light_speed: speed_then(lit),
        leader_reached: seconds_of(met),
        crossing_lead,
        junction: flag(junction.is_some()),
        junction_from: junction.map_or(FAR_M, |j| j.from_m),
        junction_to: junction.map_or(FAR_M, |j| j.to_m),
        junction_turn: junction.map_or(0.0, |j| j.turn_rad),
        junction_ways: junction.map_or(1.0, |j| j.ways as f64),
        junction_reached: seconds_of(entered),
        junction_speed: speed_then(entered),
        lanes_left,
        lanes_right,
        lanes_oncoming,
    })
}

/// The first step of the window at which something holds.
fn first_step(holds: impl Fn(usize) -> bool) -> Option<usize> {
    (1..=HORIZON_STEPS).find(|step| holds(*step))
}

/// A step in seconds.
fn seconds_of(step: Option<usize>) -> f64 {
    step.map_or(NEVER_S, |step| step as f64 * STEP_S)
}
