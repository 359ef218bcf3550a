//! The goals and via points of each window.

use crate::generator::subgoal::{as_goal, subgoal};
use crate::planning::world::World;
use crate::request::{Intermediate, Request};
use scene::via::passings;
use scene::{Conditions, Goal, HORIZON_STEPS, STEP_S, State, Via};
use std::collections::BTreeMap;

/// Goals and via points of one window.
#[derive(Default)]
pub(super) struct Targets {
    /// Goals that replace the fixed ones, by agent of the scene.
    pub(super) goals: Vec<(usize, Goal)>,
    /// Via points that are left, or that lie before a subgoal, by agent of the scene.
    pub(super) vias: Vec<(usize, Vec<Via>)>,
    /// Subgoals of goals that are due after the window's end, by agent of the scene.
    pub(super) subgoals: BTreeMap<usize, Intermediate>,
}

/// Steps after the call's start at which a road user's goal is due; the end of the call if the goal has no
/// time.
pub(super) fn due(request: &Request, agent: usize) -> isize {
    let goal = &request.scene.agents[agent].conditions.goal;
    match goal.time_s {
        Some(t) => (t / STEP_S).round() as isize - request.start_step as isize,
        None => request.horizon_steps as isize,
    }
}

/// Via points that are still to be passed when a window begins at a scene step. Those whose time is over are
/// dropped.
fn left_of<'v>(asked: &'v Conditions, start_step: usize, step: usize, executed: &[State]) -> &'v [Via] {
    let passed = passings(&asked.via, (start_step + 1) as f64 * STEP_S, executed);
    let done = asked.via.iter().zip(&passed).rposition(|(via, passing)| via.is_passed(passing));
    let behind = |via: &Via| via.time_s.is_some_and(|t| (t / STEP_S).round() <= step as f64);
    let late = asked.via.iter().rposition(behind);
    let first = done.max(late).map_or(0, |last| last + 1);
    &asked.via[first..]
}

/// The goal of a road user and the step after the call's start at which it is due. If the goal has no
/// position, the last via point that is due after the window stands in for it.
fn aim(request: &Request, agent: usize, vias: &[Via], step: usize) -> (Goal, isize) {
    let goal = request.scene.agents[agent].conditions.goal;
    let later = |via: &&Via| via.time_s.is_some_and(|t| t > (step + HORIZON_STEPS) as f64 * STEP_S);
    match vias.iter().rfind(later).filter(|_| goal.position.is_none()) {
        Some(via) => {
            let goal = Goal { position: Some(via.position), time_s: via.time_s, ..Goal::default() };
            let due_s = via.time_s.unwrap_or_default();
            (goal, (due_s / STEP_S).round() as isize - request.start_step as isize)
        }
        None => (goal, due(request, agent)),
    }
}

impl Targets {
    /// The targets of window `number`. Goals in the past are dropped; goals that are due after the window
    /// become subgoals. `executed` returns a road user's motion since the call's start.
    pub(super) fn of<'e>(
        request: &Request,
        world: &World<'_>,
        number: usize,
        executed: impl Fn(usize) -> &'e [State],
    ) -> Self {
        let mut targets = Self::default();
        let step = world.step;
        let passed = step as isize - request.start_step as isize;
        for (i, agent) in request.scene.agents.iter().enumerate() {
            let asked = &agent.conditions;
            let vias = left_of(asked, request.start_step, world.step, executed(i));
            let (goal, due) = aim(request, i, vias, world.step);
            if vias.len() < asked.via.len() {
                targets.vias.push((i, vias.to_vec()));
            }
            let goal = &goal;
            if goal.is_free() {
                continue;
            }
            let left = due - passed;
            if left <= 0 {
                targets.goals.push((i, Goal::default()));
                targets.vias.retain(|(agent, _)| *agent != i);
                if !asked.via.is_empty() {
                    targets.vias.push((i, Vec::new()));
                }
            } else if left as usize <= HORIZON_STEPS {
                let time_s = Some((step as isize + left) as f64 * STEP_S);
                if goal.step_in_window(step as f64 * STEP_S) != left as usize {
                    targets.goals.push((i, Goal { time_s, ..*goal }));
                }
            } else if let Some(who) = world.present.iter().find(|p| p.index == i) {
                let (state, on_the_way) = subgoal(world, who, goal, vias, left as usize);
                if on_the_way < asked.via.len() {
                    targets.vias.retain(|(agent, _)| *agent != i);
                    targets.vias.push((i, vias[..on_the_way].to_vec()));
                }
                let time_s = (step + HORIZON_STEPS) as f64 * STEP_S;
                let asked = as_goal(&state, world.model(who).kind, goal, left as usize, time_s);
                if !asked.is_free() {
                    let sent = Intermediate { window: number, time_s, state, reached: false };
                    targets.subgoals.insert(i, sent);
                }
                targets.goals.push((i, asked));
            }
        }
        targets
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::routes::LaneGraph;
    use scene::{Agent, AgentType, LaneMap, Scene, State, Subtype, Vec2};
    use std::sync::Arc;

    fn of(time_s: f64, start_step: usize, step: usize) -> Targets {
        let start = State { vx_mps: 5.0, ..State::default() };
        let mut car = Agent::bare("a", AgentType::Vehicle, Subtype::Car, vec![Some(start); 120]);
        car.conditions.goal =
            Goal { position: Some(Vec2::new(90.0, 0.0)), time_s: Some(time_s), ..Goal::default() };
        let scene = Arc::new(Scene::bare("", LaneMap::default(), vec![car]));
        let request = Request { start_step, horizon_steps: 200, ..Request::new(scene.clone()) };
        let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), step);
        Targets::of(&request, &world, 1, |_| &[])
    }

    #[test]
    fn a_goal_is_asked_where_it_is_due_and_dropped_after_it() {
        // The window takes this goal as the user fixed it, without an override.
        let due = of(12.0, 0, 60);
        assert!(due.goals.is_empty() && due.subgoals.is_empty());
        assert!(of(6.0, 0, 60).goals[0].1.is_free());
    }

    #[test]
    fn a_goal_due_later_becomes_a_state_on_the_way() {
        let later = of(18.0, 0, 60);
        let sent = later.subgoals[&0];
        assert_eq!((sent.window, sent.time_s), (1, 15.0));
        assert!(sent.state.x_m > 30.0 && sent.state.x_m < 90.0, "{}", sent.state.x_m);
        assert_eq!(later.goals[0].1.position, Some(sent.state.position()));
    }
}
