//! The report of a call beside its futures: value and source of each field, verdict on the goal, warnings.

use super::actor::PlannedActor;
use super::trajectory::Rollout;
use crate::planning::world::{AgentAtStart, World};
use crate::request::{
    Field, Intermediate, NearestState, ReachReport, Resolved, ResolvedGoal, ResolvedStart, ResolvedVia,
    Source, Warning, WarningCode,
};
use crate::sentences::{self, Need, Speed, kind};
use crate::tuning::fixed::report::{BEYOND_REACH, OFF_ROAD_M, OVERLAP_IOU};
use scene::geometry::obb::{OrientedBox, iou};
use scene::message::Message;
use scene::motion::{Limiting, MotionKind, MotionState, Reach};
use scene::via::passings;
use scene::{AgentId, AgentType, Conditions, Passing, RelativePlace, STEP_S, State, Via, wrap_angle};

impl From<&MotionState> for NearestState {
    fn from(s: &MotionState) -> Self {
        Self {
            x_m: s.position.x,
            y_m: s.position.y,
            heading_rad: wrap_angle(s.heading_rad),
            speed_mps: s.speed_mps(),
        }
    }
}

/// The outcome of one agent over all windows.
pub(super) struct AgentOutcome<'a> {
    /// The agent at the start of the call.
    pub(super) present: &'a AgentAtStart,
    /// Its conditions as the user fixed them.
    pub(super) conditions: &'a Conditions,
    /// Scene step at which the goal is due.
    pub(super) due_step: usize,
    /// State of its shown future at that step, or at the end for a later goal.
    pub(super) end: State,
    /// All states of its shown future, the start first.
    pub(super) states: Vec<State>,
    /// Verdict of the last window before the goal was due.
    pub(super) reach: ReachReport,
    /// Subgoals of the earlier windows.
    pub(super) intermediate: Vec<Intermediate>,
    /// Why its goal, which is relative to another agent, could not be resolved.
    pub(super) unrelated: Option<&'a Message>,
}

impl AgentOutcome<'_> {
    /// The verdict on a goal that could not be resolved, or that of the last window.
    fn verdict(&self) -> ReachReport {
        let Some(message) = self.unrelated else { return self.reach.clone() };
        ReachReport::Unreachable {
            nearest: NearestState {
                x_m: self.end.x_m,
                y_m: self.end.y_m,
                heading_rad: wrap_angle(self.end.heading_rad),
                speed_mps: self.end.speed_mps(),
            },
            limiting: Limiting::Relation,
            needs: None,
            words: message.to_string(),
            message: message.clone(),
            with: self.conditions.relation.as_ref().map(|relation| relation.to.clone()),
        }
    }
}

/// Fields and verdict of one road user. `world` is that of the first window.
pub(super) fn resolved(world: &World<'_>, outcome: AgentOutcome<'_>) -> Resolved {
    let reach = outcome.verdict();
    let AgentOutcome { present, conditions, due_step, end, states, intermediate, .. } = outcome;
    let agent = world.agent(present);
    let logged = agent.state_at(world.step).is_some();
    let start = |value: f64, fixed: bool| {
        let from = match (fixed, logged) {
            (true, _) => Source::User,
            (false, true) => Source::Log,
            (false, false) => Source::Default,
        };
        Field { value, from }
    };
    let size =
        |value: f64, fixed: bool| Field { value, from: if fixed { Source::User } else { Source::Log } };
    let relation = conditions.relation.as_ref().map(|relation| relation.place);
    let passing = matches!(relation, Some(RelativePlace::After(_)));
    // A passing relation gives the time, any other relation gives the rest.
    let fixed_by = if relation.is_some() && !passing { Source::Relation } else { Source::User };
    let goal = |value: f64, fixed: bool| Field { value, from: if fixed { fixed_by } else { Source::Model } };
    let (s, c, asked) = (&present.start, &conditions.start, &conditions.goal);
    let position = asked.position.unwrap_or(end.position());
    let due_from = match asked.time_s {
        Some(_) if passing => Source::Relation,
        Some(_) => Source::User,
        None => Source::Default,
    };
    Resolved {
        agent_type: present.agent_type,
        length_m: size(present.size.length_m, conditions.length_m.is_some()),
        width_m: size(present.size.width_m, conditions.width_m.is_some()),
        start: ResolvedStart {
            x_m: start(s.x_m, c.position.is_some()),
            y_m: start(s.y_m, c.position.is_some()),
            heading_rad: start(s.heading_rad, c.heading_rad.is_some()),
            speed_mps: start(s.speed_mps(), c.speed_mps.is_some()),
        },
        goal: ResolvedGoal {
            x_m: goal(position.x, asked.position.is_some()),
            y_m: goal(position.y, asked.position.is_some()),
            heading_rad: goal(
                wrap_angle(asked.heading_rad.unwrap_or(end.heading_rad)),
                asked.heading_rad.is_some(),
            ),
            speed_mps: goal(asked.speed_mps.unwrap_or_else(|| end.speed_mps()), asked.speed_mps.is_some()),
            time_s: Field { value: due_step as f64 * STEP_S, from: due_from },
        },
        reach,
        via: vias(&conditions.via, world.step, &states),
        by_road: None,
        intermediate,
    }
}

/// How a motion that begins at a scene step passes via points.
fn vias(vias: &[Via], step: usize, states: &[State]) -> Vec<ResolvedVia> {
    let passed = passings(vias, step as f64 * STEP_S, states);
    let report = |(via, at): (&Via, &Passing)| ResolvedVia {
        x_m: via.position.x,
        y_m: via.position.y,
        tolerance_m: via.tolerance_m,
        passed: via.is_passed(at),
        distance_m: at.distance_m,
        time_s: at.time_s,
    };
    vias.iter().zip(&passed).map(report).collect()
}

/// Verdict of one window on its target. `since_s` is the scene time at the start of a later window, from
/// which the reason then holds. `blocked_by` is the agent before which the motion stops.
pub(super) fn reach_report(
    actor: &PlannedActor,
    motion: &Rollout,
    since_s: Option<f64>,
    blocked_by: Option<&AgentId>,
) -> ReachReport {
    match &motion.reach {
        Reach::Reached(r) => ReachReport::Reached {
            position_m: r.position_m,
            heading_rad: r.heading_rad,
            speed_mps: r.speed_mps,
        },
        Reach::Unreachable { nearest, limiting, needs, .. } => {
            let reason = reason(actor, nearest, *limiting, *needs, blocked_by);
            let message = match since_s {
                Some(since_s) => sentences::since(reason, since_s),
                None => reason,
            };
            ReachReport::Unreachable {
                nearest: nearest.into(),
                limiting: *limiting,
                needs: *needs,
                words: message.to_string(),
                message,
                with: blocked_by.cloned(),
            }
        }
    }
}

/// Why a goal is out of reach, and what is within reach.
fn reason(
    actor: &PlannedActor,
    nearest: &MotionState,
    limiting: Limiting,
    needs: Option<f64>,
    blocked_by: Option<&AgentId>,
) -> Message {
    let planned = &actor.plan;
    let time_s = planned.target.step as f64 * STEP_S;
    let kind = match planned.present.agent_type {
        AgentType::Pedestrian => kind::PEDESTRIAN,
        AgentType::Cyclist => kind::CYCLIST,
        _ => kind::VEHICLE,
    };
    let start = planned.present.start;
    let most_m = (nearest.position - start.position()).norm();
    let goal_m = planned.target.position.map(|p| (p - start.position()).norm());
    let start_mps = Speed { mps: start.speed_mps(), on_foot: planned.model.kind == MotionKind::Walk };
    let need = |unit| Need { amount: needs, unit };
    match (limiting, goal_m) {
        (Limiting::Acceleration | Limiting::Speed, Some(goal_m)) if goal_m > most_m => {
            sentences::goal_too_far(time_s, goal_m, start_mps, kind, most_m)
        }
        (Limiting::Acceleration, _) => sentences::goal_too_fast(time_s, start_mps, need("m/s²")),
        (Limiting::Speed, _) => sentences::goal_above_top_speed(kind, need("m/s")),
        (Limiting::Braking, Some(goal_m)) => {
            sentences::goal_too_near(start_mps, most_m, goal_m, need("m/s²"))
        }
        (Limiting::Braking, None) => sentences::goal_too_slow(time_s, need("m/s²")),
        (Limiting::Lateral, _) => sentences::goal_too_tight(need("m/s² sideways")),
        (Limiting::Curvature, _) => sentences::goal_turn_too_tight(kind),
        // A goal whose relation fails is free and has no such reason.
        (Limiting::Traffic | Limiting::Relation, _) => {
            let short_m = planned.target.position.map_or(0.0, |p| (p - nearest.position).norm());
            match blocked_by {
                Some(id) => sentences::goal_blocked(id, kind, short_m),
                None => sentences::goal_blocked_by_traffic(kind, short_m),
            }
        }
    }
}

/// Warnings about unlikely starts and goals, which are generated nevertheless. `world` is that of the first
/// window. `asked` returns an agent's conditions and the number of steps until its goal is due.
pub(super) fn warnings<'a>(
    world: &World<'_>,
    actors: &[PlannedActor],
    asked: impl Fn(usize) -> (&'a Conditions, usize),
) -> Vec<Warning> {
    let mut out = Vec::new();
    for actor in actors {
        let present = &actor.plan.present;
        let (conditions, due) = asked(present.index);
        let mut warn = |code, message| out.push(Warning::of(code, &actor.id, message));
        let off_road = |point| {
            present.agent_type != AgentType::Pedestrian
                && !world.graph.lanes().is_empty()
                && world.graph.nearest_for(point, OFF_ROAD_M, present.agent_type).is_empty()
        };
        if let Some(position) = conditions.goal.position {
            if off_road(position) {
                warn(WarningCode::GoalOffRoad, sentences::goal_off_road(OFF_ROAD_M));
            }
            let distance = (position - present.start.position()).norm();
            let seconds = due as f64 * STEP_S;
            if distance
                > BEYOND_REACH * seconds * actor.plan.model.limits.speed_mps.max(present.start.speed_mps())
            {
                warn(WarningCode::GoalUnreachable, sentences::goal_beyond_top_speed(distance, seconds));
            }
        }
        if conditions.start.position.is_some() {
            if off_road(present.start.position()) {
                warn(WarningCode::StartOffRoad, sentences::start_off_road(OFF_ROAD_M));
            }
            let own = OrientedBox::of_state(&present.start, &present.size);
            for other in world.present.iter().filter(|p| p.index != present.index) {
                if iou(&own, &OrientedBox::of_state(&other.start, &other.size)) > OVERLAP_IOU {
                    warn(WarningCode::StartOverlaps, sentences::start_overlaps(&world.agent(other).id));
                }
            }
        }
    }
    out
}
