//! Planning problems as road users with goals.

use super::document::{GoalState, PlanningProblem, Range};
use super::map::Lanes;
use super::motion::Clock;
use crate::limits::MAX_GOAL_DISTANCE_M;
use crate::polyline;
use scene::map::LaneMap;
use scene::{Agent, AgentType, Conditions, Goal, MAX_COORDINATE_M, State, Subtype, Track, Vec2, wrap_angle};

/// Greatest speed of a goal, m/s, and range of its time, s.
const MAX_SPEED_MPS: f64 = 60.0;
const DUE_S: (f64, f64) = (0.5, 80.0);

/// The road user of a planning problem, with its start and goal; whether the goal was a region.
pub(super) fn agent(
    problem: &PlanningProblem,
    (map, lanes): (&LaneMap, &Lanes),
    clock: Clock,
) -> (Agent, bool) {
    let start = &problem.start;
    let velocity = start.velocity.unwrap_or_default();
    let heading_rad = start.heading_rad.unwrap_or(0.0);
    let state =
        State { x_m: start.at.x, y_m: start.at.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y };
    let mut agent = Agent::bare(problem.id.to_string(), AgentType::Vehicle, Subtype::Car, Vec::new());
    let first_step = clock.step(start.step).min(clock.steps.saturating_sub(1));
    agent.track = Track { first_step, states: vec![Some(state)], z_m: None }.into();
    let Some(goal) = problem.goals.first() else { return (agent, false) };
    let (goal, is_region) = reached(goal, &state, (map, lanes), clock);
    agent.conditions = Conditions { goal, ..Conditions::default() };
    (agent, is_region)
}

/// Conditions of a road user that does not start where the problem states: a position too far from its start
/// is dropped.
pub(super) fn from_start(mut conditions: Conditions, driven: &Agent) -> Conditions {
    let start = driven.track.states.iter().flatten().next().map(State::position);
    let near = |p: &Vec2| start.is_none_or(|start| is_near(*p, start));
    conditions.goal.position = conditions.goal.position.filter(near);
    conditions
}

fn is_near(place: Vec2, start: Vec2) -> bool {
    (place - start).norm() <= MAX_GOAL_DISTANCE_M
}

/// The middle of the goal region; whether it was more than a point.
fn reached(goal: &GoalState, start: &State, (map, lanes): (&LaneMap, &Lanes), clock: Clock) -> (Goal, bool) {
    let middle = |(from, to): Range| (from + to) / 2.0;
    let is_wide = |range: Option<Range>| range.is_some_and(|(from, to)| from != to);
    // Without an earliest time, the latest time counts.
    let time_s = goal.time.map(|(from, to)| {
        let at = if from <= clock.first as f64 + 1.0 { to } else { middle((from, to)) };
        clock.seconds(at)
    });
    let time_s = time_s.filter(|time_s| *time_s > 0.0).map(|time_s| time_s.clamp(DUE_S.0, DUE_S.1));
    let heading_rad = goal.heading_rad.map(|(from, to)| {
        // The shorter rotation, unless the file accepts any heading.
        wrap_angle(from + (to - from) / 2.0)
    });
    let all_round = goal.heading_rad.is_some_and(|(from, to)| to - from > 6.0);
    let speed_mps = goal.speed_mps.map(middle).map(|v| v.clamp(0.0, MAX_SPEED_MPS));
    let there = start.position() + start.velocity() * time_s.unwrap_or(9.0);
    let place = goal.places.first().map(|place| place.centre);
    let near = |p: &Vec2| is_near(*p, start.position());
    let place = place.filter(|p| p.amax() <= MAX_COORDINATE_M);
    let position = place.or_else(|| on_lanelets(&goal.lanelets, there, (map, lanes))).filter(near);
    let is_region = is_wide(goal.time)
        || is_wide(goal.heading_rad)
        || is_wide(goal.speed_mps)
        || goal.places.iter().any(|place| place.is_area)
        || !goal.lanelets.is_empty();
    (Goal { position, heading_rad: heading_rad.filter(|_| !all_round), speed_mps, time_s }, is_region)
}

/// The point on the middle line of any of these lanelets that is nearest to the place reached without
/// turning.
fn on_lanelets(ids: &[i64], there: Vec2, (map, lanes): (&LaneMap, &Lanes)) -> Option<Vec2> {
    let all = ids.iter().filter_map(|id| lanes.get(id)?.first()).map(|lane| &map.lanes[*lane].points.xy);
    let feet = all.map(|line| polyline::nearest(line, there));
    feet.min_by(|a, b| (a - there).norm().total_cmp(&(b - there).norm()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_near_where_one_really_starts() {
        let mut driven = Agent::bare("7", AgentType::Vehicle, Subtype::Car, Vec::new());
        let state = State { x_m: 1.0, y_m: 0.0, heading_rad: 0.0, vx_mps: 5.0, vy_mps: 0.0 };
        driven.track = Track { first_step: 0, states: vec![None, Some(state)], z_m: None }.into();
        let goal =
            |x: f64| Goal { position: Some(Vec2::new(x, 0.0)), speed_mps: Some(3.0), ..Goal::default() };
        let asked = |x: f64| from_start(Conditions { goal: goal(x), ..Conditions::default() }, &driven).goal;
        assert_eq!(asked(1_501.0), goal(1_501.0));
        assert_eq!(asked(1_501.1), Goal { position: None, ..goal(0.0) });
    }
}
