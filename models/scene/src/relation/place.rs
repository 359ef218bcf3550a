//! Resolves a relation to an ordinary goal, given the motion of the other road user.

use super::{GoalRelation, RelativePlace};
use crate::geometry::direction;
use crate::message::Message;
use crate::routes::start::{ON_LANE_TURN_RAD, RELAXED_M};
use crate::routes::{LaneGraph, Pose};
use crate::via::passings;
use crate::{AgentType, Goal, STANDING_MPS, STEP_S, Size, State, Vec2, Via, sentences, wrap_angle};

/// The other road user passes a place if it comes nearer than this, metres.
const PASSES_M: f64 = 5.0;
/// The other road user drives along a lane if its motion stays this near to it, metres.
const FOLLOWS_M: f64 = 2.0;
/// Distance to which a heading difference of one radian is equivalent, metres.
const METRES_PER_RAD: f64 = 3.0;
/// Least time from the start to a goal, seconds.
const SOONEST_S: f64 = 0.5;
/// Most lanes in a gap.
const MOST_LANES: usize = 64;

/// The motion of the road user that a goal is relative to.
pub struct OtherMotion<'a> {
    /// Type for which it is generated.
    pub agent_type: AgentType,
    /// Its box.
    pub size: Size,
    /// State at a scene step; `None` while it is absent.
    pub at: &'a dyn Fn(usize) -> Option<State>,
}

/// A goal to be resolved.
pub struct RelativeGoal<'a> {
    /// What was fixed.
    pub relation: &'a GoalRelation,
    /// The goal's own fields.
    pub goal: Goal,
    /// Type of the road user with this goal.
    pub agent_type: AgentType,
    /// Length of its box, metres.
    pub length_m: f64,
    /// Scene step at which the call starts.
    pub start_step: usize,
    /// Scene step at which the goal is due if it has no relation to a passing.
    pub due_step: usize,
    /// Scene step at which the call ends.
    pub end_step: usize,
}

/// The ordinary goal of a relation.
///
/// # Errors
/// Why there is none: the other road user is absent, stands, or does not pass the place; the lane is missing
/// or ends; the time lies outside the call.
pub fn place(graph: &LaneGraph, asked: &RelativeGoal<'_>, other: &OtherMotion<'_>) -> Result<Goal, Message> {
    match asked.relation.place {
        RelativePlace::After(after_s) => after(asked, other, after_s),
        RelativePlace::Ahead(_) | RelativePlace::Behind(_) | RelativePlace::BehindBy(_) => {
            beside(graph, asked, other)
        }
    }
}

/// The goal's own place, `after_s` seconds after the other passes it.
fn after(asked: &RelativeGoal<'_>, other: &OtherMotion<'_>, after_s: f64) -> Result<Goal, Message> {
    let to = &asked.relation.to;
    let position = asked.goal.position.unwrap_or_default();
    let steps = asked.start_step..=asked.end_step;
    let first = steps.clone().find(|step| (other.at)(*step).is_some());
    let first = first.ok_or_else(|| sentences::relation_gone(to, asked.end_step as f64 * STEP_S))?;
    let states: Vec<State> = (first..=asked.end_step).map_while(other.at).collect();
    let via = Via { position, tolerance_m: PASSES_M, time_s: None };
    let passing = passings(&[via], first as f64 * STEP_S, &states).pop();
    let passing = passing.filter(|passing| passing.distance_m <= PASSES_M);
    let passing = passing.ok_or_else(|| sentences::relation_not_passed(to, PASSES_M))?;
    let step = ((passing.time_s + after_s) / STEP_S).round();
    let time_s = step / (1.0 / STEP_S).round();
    let (least_s, most_s) = (asked.start_step as f64 * STEP_S + SOONEST_S, asked.end_step as f64 * STEP_S);
    if time_s < least_s - 1e-6 || time_s > most_s + 1e-6 {
        return Err(sentences::relation_outside(to, passing.time_s, time_s, least_s, most_s));
    }
    Ok(Goal { position: Some(position), time_s: Some(time_s), ..asked.goal })
}

/// A place ahead of or behind the other, in a lane counted from its own.
fn beside(graph: &LaneGraph, asked: &RelativeGoal<'_>, other: &OtherMotion<'_>) -> Result<Goal, Message> {
    let relation = asked.relation;
    let due_s = asked.due_step as f64 * STEP_S;
    let state = (other.at)(asked.due_step).ok_or_else(|| sentences::relation_gone(&relation.to, due_s))?;
    let other_mps = state.speed_mps();
    let speed_mps = asked.goal.speed_mps.unwrap_or(other_mps - relation.slower_mps);
    // The recorded speed of a standing road user is noise.
    if speed_mps < -STANDING_MPS {
        return Err(sentences::relation_too_slow(&relation.to, other_mps, due_s, relation.slower_mps));
    }
    let speed_mps = speed_mps.max(0.0);
    let boxes_m = 0.5 * (asked.length_m + other.size.length_m);
    let along_m = match relation.place {
        RelativePlace::Ahead(gap_m) => gap_m + boxes_m,
        RelativePlace::Behind(gap_m) => -gap_m - boxes_m,
        RelativePlace::BehindBy(gap_s) if speed_mps >= STANDING_MPS => -gap_s * speed_mps - boxes_m,
        RelativePlace::BehindBy(_) | RelativePlace::After(_) => {
            return Err(sentences::relation_stands(&relation.to, due_s));
        }
    };
    let pose = match lane_of(graph, &state, other.agent_type) {
        Some(lane) => along_lanes(graph, asked, other, lane, along_m)?,
        None if relation.lanes_left != 0 => {
            return Err(sentences::relation_off_lanes(&relation.to, due_s));
        }
        None => {
            let position = state.position() + direction(state.heading_rad) * along_m;
            Pose::new(position, state.heading_rad)
        }
    };
    Ok(Goal {
        position: Some(pose.position),
        heading_rad: Some(wrap_angle(pose.heading_rad)),
        speed_mps: Some(speed_mps),
        time_s: asked.goal.time_s,
    })
}

/// A place on a lane: its index and the arc length, metres.
type LanePlace = (usize, f64);

/// The lane that a road user is on.
fn lane_of(graph: &LaneGraph, state: &State, agent_type: AgentType) -> Option<LanePlace> {
    let turn = |heading_rad: f64| wrap_angle(heading_rad - state.heading_rad).abs();
    let near = graph.nearest_for(state.position(), RELAXED_M, agent_type).into_iter().filter(|hit| {
        let half_width_m = FOLLOWS_M.max(0.5 * graph.lanes()[hit.lane].width_m);
        hit.distance_m <= half_width_m && turn(hit.heading_rad) <= ON_LANE_TURN_RAD
    });
    let score = |distance_m: f64, heading_rad: f64| distance_m + METRES_PER_RAD * turn(heading_rad);
    let best = near.min_by(|a, b| {
        let (one, two) = (score(a.distance_m, a.heading_rad), score(b.distance_m, b.heading_rad));
        one.total_cmp(&two).then(a.lane.cmp(&b.lane))
    })?;
    Some((best.lane, best.s_m))
}

/// The place this many metres along the lanes from the other's place, after a number of lane changes.
fn along_lanes(
    graph: &LaneGraph,
    asked: &RelativeGoal<'_>,
    other: &OtherMotion<'_>,
    (mut lane, mut s_m): LanePlace,
    along_m: f64,
) -> Result<Pose, Message> {
    let GoalRelation { to, lanes_left, .. } = asked.relation;
    let due_s = asked.due_step as f64 * STEP_S;
    for _ in 0..lanes_left.unsigned_abs() {
        let own = &graph.lanes()[lane];
        let sides = if *lanes_left > 0 { &own.left } else { &own.right };
        let carries = |lane: usize| graph.lanes()[lane].carries(asked.agent_type);
        let next = sides.iter().filter(|side| side.same_direction && carries(side.lane));
        let next = next.filter_map(|side| Some((side.lane, side.across(s_m)?))).next();
        (lane, s_m) = next.ok_or_else(|| match *lanes_left {
            left if left > 0 => sentences::relation_no_lane_left(left.unsigned_abs() as usize, to, due_s),
            right => sentences::relation_no_lane_right(right.unsigned_abs() as usize, to, due_s),
        })?;
    }
    let mut left_m = along_m.abs();
    for _ in 0..MOST_LANES {
        let own = &graph.lanes()[lane];
        let room_m = if along_m > 0.0 { own.path.length_m() - s_m } else { s_m };
        if left_m <= room_m {
            return Ok(own.path.sample(s_m + left_m.copysign(along_m)));
        }
        left_m -= room_m;
        let (links, steps) = if along_m > 0.0 {
            (&own.successors, asked.due_step..=asked.end_step)
        } else {
            (&own.predecessors, asked.start_step..=asked.due_step)
        };
        let seen: Vec<Vec2> =
            steps.step_by(5).filter_map(|step| Some((other.at)(step)?.position())).collect();
        let Some(next) = next_lane(graph, lane, links, asked.agent_type, &seen) else { break };
        (lane, s_m) = (next, if along_m > 0.0 { 0.0 } else { graph.lanes()[next].path.length_m() });
    }
    Err(sentences::relation_lane_ends(to, left_m, due_s))
}

/// The next lane forwards or backwards: the one that the other road user drives along, else the straightest.
fn next_lane(
    graph: &LaneGraph,
    lane: usize,
    links: &[usize],
    agent_type: AgentType,
    seen: &[Vec2],
) -> Option<usize> {
    let lanes = graph.lanes();
    let usable = links.iter().copied().filter(|next| lanes[*next].carries(agent_type) && *next != lane);
    let driven = |next: usize| {
        let path = &lanes[next].path;
        // All links share the places near both ends.
        let inner = (0.3 * path.length_m(), 0.7 * path.length_m());
        let on = |place: &&Vec2| {
            let foot = path.project(**place);
            foot.distance_m <= FOLLOWS_M && foot.s_m >= inner.0 && foot.s_m <= inner.1
        };
        seen.iter().filter(on).count()
    };
    let turn = |next: usize| {
        let path = &lanes[next].path;
        wrap_angle(path.heading_at(path.length_m()) - path.heading_at(0.0)).abs()
    };
    usable.min_by(|a, b| driven(*b).cmp(&driven(*a)).then(turn(*a).total_cmp(&turn(*b))).then(a.cmp(b)))
}
