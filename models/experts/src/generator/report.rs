//! The report of a call besides its futures: every field's value and origin, the verdict on the goal in plain
//! words, and warnings.

use super::actor::PlannedActor;
use super::trajectory::Rollout;
use crate::planning::world::{AgentAtStart, World};
use crate::request::{
    Field, Intermediate, NearestState, ReachReport, Resolved, ResolvedGoal, ResolvedStart, ResolvedVia,
    Source, Warning, WarningCode,
};
use scene::geometry::obb::{OrientedBox, iou};
use scene::motion::{Kind, Limiting, MotionState, Reach};
use scene::via::passings;
use scene::{AgentId, AgentType, Conditions, Passing, STEP_S, State, Via, wrap_angle};

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
    /// At the start of the call.
    pub(super) present: &'a AgentAtStart,
    /// As the user fixed them.
    pub(super) conditions: &'a Conditions,
    /// Scene step at which the goal is due.
    pub(super) due_step: usize,
    /// State of its shown future then (or at the end, for a goal later than that).
    pub(super) end: State,
    /// All states of its shown future, the start first.
    pub(super) states: Vec<State>,
    /// Verdict of the last window before the goal was due.
    pub(super) reach: ReachReport,
    /// Where earlier windows were sent.
    pub(super) intermediate: Vec<Intermediate>,
}

/// Fields and verdict of one road user; `world` is that of the first window.
pub(super) fn resolved(world: &World<'_>, outcome: AgentOutcome<'_>) -> Resolved {
    let AgentOutcome { present, conditions, due_step, end, states, reach, intermediate } = outcome;
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
    let goal =
        |value: f64, fixed: bool| Field { value, from: if fixed { Source::User } else { Source::Model } };
    let (s, c, asked) = (&present.start, &conditions.start, &conditions.goal);
    let position = asked.position.unwrap_or(end.position());
    let due_from = if asked.time_s.is_some() { Source::User } else { Source::Default };
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

/// Where a via point is missed, in words; they are counted from 1.
pub(super) fn missed_words(number: usize, via: &ResolvedVia) -> String {
    let ResolvedVia { tolerance_m, distance_m, time_s, .. } = via;
    format!(
        "Via point {number} is passed {distance_m:.1} m away at {time_s:.1} s; at most {tolerance_m:.1} m was asked."
    )
}

/// Verdict of one window on what it was asked. `since_s` is the scene time of a later window's start:
/// its words are about the way from there. `blocked_by` is in the way of a motion that halts before somebody.
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
            let words = words(actor, nearest, *limiting, *needs, blocked_by);
            let words = since_s.map_or(words.clone(), |s| format!("From {s:.1} s on: {words}"));
            ReachReport::Unreachable {
                nearest: nearest.into(),
                limiting: (*limiting).into(),
                needs: *needs,
                words,
                with: blocked_by.cloned(),
            }
        }
    }
}

/// One sentence or two: what cannot be, and what can.
fn words(
    actor: &PlannedActor,
    nearest: &MotionState,
    limiting: Limiting,
    needs: Option<f64>,
    blocked_by: Option<&AgentId>,
) -> String {
    let planned = &actor.plan;
    let seconds = planned.target.step as f64 * STEP_S;
    let what = match planned.present.agent_type {
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        _ => "vehicle",
    };
    let start = planned.present.start;
    let went = (nearest.position - start.position()).norm();
    let asked = planned.target.position.map(|p| (p - start.position()).norm());
    let from = match planned.model.kind {
        Kind::Walk => format!("{:.1} m/s", start.speed_mps()),
        Kind::Drive => format!("{:.0} km/h", 3.6 * start.speed_mps()),
    };
    let needs = |unit: &str| needs.map_or(String::new(), |n| format!(" It would take {n:.1} {unit}."));
    match (limiting, asked) {
        (Limiting::Acceleration | Limiting::Speed, Some(asked)) if asked > went => format!(
            "Too far for {seconds:.1} s. The goal is {asked:.0} m away. In {seconds:.1} s from {from} this {what} gets {went:.0} m at most."
        ),
        (Limiting::Acceleration, _) => {
            format!("Cannot speed up that much in {seconds:.1} s from {from}.{}", needs("m/s²"))
        }
        (Limiting::Speed, _) => format!("Faster than this {what} can go.{}", needs("m/s")),
        (Limiting::Braking, Some(asked)) => format!(
            "Cannot stop that soon. From {from} it gets no nearer than {went:.0} m, the goal is {asked:.0} m away.{}",
            needs("m/s²")
        ),
        (Limiting::Braking, None) => {
            format!("Cannot slow down that much in {seconds:.1} s.{}", needs("m/s²"))
        }
        (Limiting::Lateral, _) => format!("Too tight at this speed.{}", needs("m/s² sideways")),
        (Limiting::Curvature, _) => format!("Too tight a turn for this {what}."),
        (Limiting::Traffic, _) => {
            let short = planned.target.position.map_or(0.0, |p| (p - nearest.position).norm());
            let who = blocked_by.map_or("Somebody".to_owned(), |id| format!("Road user {id}"));
            format!("{who} is in the way of this {what}. It halts {short:.0} m short of the goal.")
        }
    }
}

/// Unlikely starts and goals: done anyway, but said. `world` is that of the first window, `asked` gives
/// what the user fixed about a road user and after how many steps its goal is due.
pub(super) fn warnings<'a>(
    world: &World<'_>,
    actors: &[PlannedActor],
    asked: impl Fn(usize) -> (&'a Conditions, usize),
) -> Vec<Warning> {
    let mut out = Vec::new();
    for actor in actors {
        let present = &actor.plan.present;
        let (conditions, due) = asked(present.index);
        let mut warn = |code: WarningCode, detail: String| {
            out.push(Warning { code, agent: Some(actor.id.clone()), detail });
        };
        let off_road = |point| {
            present.agent_type != AgentType::Pedestrian
                && !world.graph.lanes().is_empty()
                && world.graph.nearest_for(point, 6.0, present.agent_type).is_empty()
        };
        if let Some(position) = conditions.goal.position {
            if off_road(position) {
                warn(WarningCode::GoalOffRoad, "There is no lane within 6 m of the goal.".into());
            }
            let distance = (position - present.start.position()).norm();
            let seconds = due as f64 * STEP_S;
            if distance > 1.1 * seconds * actor.plan.model.limits.speed_mps.max(present.start.speed_mps()) {
                warn(
                    WarningCode::GoalUnreachable,
                    format!("{distance:.0} m in {seconds:.1} s is beyond the top speed."),
                );
            }
        }
        if conditions.start.position.is_some() {
            if off_road(present.start.position()) {
                warn(WarningCode::StartOffRoad, "There is no lane within 6 m of the start.".into());
            }
            let own = OrientedBox::of_state(&present.start, &present.size);
            for other in world.present.iter().filter(|p| p.index != present.index) {
                if iou(&own, &OrientedBox::of_state(&other.start, &other.size)) > 0.02 {
                    warn(
                        WarningCode::StartOverlaps,
                        format!("The start overlaps {}.", world.agent(other).id),
                    );
                }
            }
        }
    }
    out
}
