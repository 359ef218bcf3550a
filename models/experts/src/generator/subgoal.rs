//! Subgoals: the state at a window's end for a road user whose goal is due later.

use crate::planning::world::{AgentAtStart, World};
use crate::request::NearestState;
use scene::motion::{MotionKind, MotionModel};
use scene::routes::{EndPose, GoalQuery, Polyline, base_path, routes_to_goal};
use scene::{Goal, HORIZON_STEPS, STEP_S, Vec2, Via};

/// Steps that a later window needs to turn to a heading, for a goal without a position.
const TURN_STEPS: usize = 30;
/// A standing agent closer to its goal than this has arrived, metres.
const THERE_M: f64 = 0.05;

/// The state at the window's end on the way to a goal that is due `left` steps after the window's start,
/// later than the window's end. The path follows the lanes if they lead to the goal. Otherwise, and on foot,
/// it is straight. The acceleration along it is constant, or linear in time if the goal also fixes the speed.
/// The path leads through the via points; their number before that state is returned too.
pub(super) fn subgoal(
    world: &World<'_>,
    who: &AgentAtStart,
    goal: &Goal,
    vias: &[Via],
    left: usize,
) -> (NearestState, usize) {
    let model = world.model(who);
    let v0 = model.start_speed_mps();
    let Some(position) = goal.position else {
        return (changing(who, v0, goal, left), vias.len());
    };
    if !vias.is_empty() {
        return through(world, who, &model, (goal, position), vias, left);
    }
    (on_the_way(world, who, &model, goal, position, left), 0)
}

/// The same through via points. Those with a time after the window determine the timing.
fn through(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    (goal, position): (&Goal, Vec2),
    vias: &[Via],
    left: usize,
) -> (NearestState, usize) {
    let free = Goal::default();
    let mut points = vec![who.start.position()];
    let mut from = who.clone();
    let mut at_m = Vec::with_capacity(vias.len());
    let places = vias.iter().map(|via| (via.position, &free)).chain([(position, goal)]);
    for (place, asked) in places {
        let leg = path_to(world, &from, model, asked, place);
        points.extend(leg.points().iter().skip(1));
        at_m.push(Polyline::new(points.iter().copied()).length_m());
        let end = leg.last();
        let velocity = end.direction() * model.start_speed_mps();
        (from.start.x_m, from.start.y_m, from.start.heading_rad) =
            (end.position.x, end.position.y, end.heading_rad);
        (from.start.vx_mps, from.start.vy_mps) = (velocity.x, velocity.y);
    }
    let path = Polyline::new(points);
    let step = |via: &Via| via.time_s.map(|t| ((t / STEP_S).round() as usize).saturating_sub(world.step));
    // The first timed point beyond the window, and the last one within it.
    let timed = || vias.iter().zip(&at_m).filter_map(|(via, at)| Some((step(via)?, *at)));
    let next = timed().find(|(step, _)| *step > HORIZON_STEPS);
    let passed_m = timed().rfind(|(step, _)| *step <= HORIZON_STEPS).map_or(0.0, |(_, at)| at);
    let (due, length_m, end_mps) = match next {
        Some((due, at)) => (due, at, None),
        None => (left, path.length_m(), goal.speed_mps),
    };
    let (along_m, speed_mps) = travelled(model.start_speed_mps(), model, length_m, end_mps, due);
    let along_m = along_m.max(passed_m);
    let pose = path.sample(along_m);
    let state =
        NearestState { x_m: pose.position.x, y_m: pose.position.y, heading_rad: pose.heading_rad, speed_mps };
    // A via point that is almost reached is passed in this window.
    let on_the_way =
        vias.iter().zip(&at_m).filter(|(via, at)| **at <= along_m + 0.5 * via.tolerance_m).count();
    (state, on_the_way)
}

/// The same without via points.
fn on_the_way(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    goal: &Goal,
    position: Vec2,
    left: usize,
) -> NearestState {
    let v0 = model.start_speed_mps();
    let distance_m = (position - who.start.position()).norm();
    if distance_m < THERE_M && v0 < THERE_M {
        return NearestState {
            x_m: position.x,
            y_m: position.y,
            heading_rad: goal.heading_rad.unwrap_or(who.start.heading_rad),
            speed_mps: 0.0,
        };
    }
    let path = path_to(world, who, model, goal, position);
    let (along_m, speed_mps) = travelled(v0, model, path.length_m(), goal.speed_mps, left);
    let pose = path.sample(along_m);
    NearestState { x_m: pose.position.x, y_m: pose.position.y, heading_rad: pose.heading_rad, speed_mps }
}

/// The goal of a window that ends in a subgoal. If the final goal has no position, the position stays free,
/// and so does the heading while there is time to turn later.
pub(super) fn as_goal(state: &NearestState, kind: MotionKind, goal: &Goal, left: usize, time_s: f64) -> Goal {
    let placed = goal.position.is_some();
    let turns = goal.heading_rad.is_some() && left < HORIZON_STEPS + TURN_STEPS;
    // Walkers turn as they walk; wheeled agents have to be led onto the path.
    let led = if placed { kind == MotionKind::Drive } else { turns };
    Goal {
        position: placed.then(|| state.position()),
        heading_rad: led.then_some(state.heading_rad),
        speed_mps: (placed || goal.speed_mps.is_some()).then_some(state.speed_mps),
        time_s: Some(time_s),
    }
}

/// For a goal without a position: a linear share of the change of speed, and the goal's heading.
fn changing(who: &AgentAtStart, v0: f64, goal: &Goal, left: usize) -> NearestState {
    let share = HORIZON_STEPS as f64 / left as f64;
    let speed_mps = goal.speed_mps.map_or(v0, |v| v0 + (v - v0) * share);
    let start = &who.start;
    let heading_rad = goal.heading_rad.unwrap_or(start.heading_rad);
    NearestState { x_m: start.x_m, y_m: start.y_m, heading_rad, speed_mps }
}

fn path_to(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    goal: &Goal,
    position: Vec2,
) -> Polyline {
    let straight = || Polyline::new([who.start.position(), position]);
    if model.kind == MotionKind::Walk {
        return straight();
    }
    let v0 = model.start_speed_mps();
    let query = GoalQuery {
        pose: who.pose(),
        speed_mps: v0,
        agent_type: who.agent_type,
        goal: position,
        goal_heading_rad: goal.heading_rad,
        least_effort_m: None,
    };
    let end = EndPose { position, heading_rad: goal.heading_rad, speed_mps: v0 };
    match routes_to_goal(&world.graph, &query).into_iter().next() {
        Some(found) => base_path(&found.route.path, who.pose(), v0, who.agent_type, Some(end)),
        None => straight(),
    }
}

/// Metres along the path and speed after one window, for a path of `length_m` that takes `left` steps.
/// Progress never decreases, and the speed stays within the limit of the agent type, or the present speed if
/// that is higher.
fn travelled(v0: f64, model: &MotionModel, length_m: f64, end: Option<f64>, left: usize) -> (f64, f64) {
    let seconds = left as f64 * STEP_S;
    let top = model.limits.speed_mps.max(v0);
    let speed = |shape: f64, t: f64| {
        let wished = match end {
            Some(end) => v0 + (end - v0) * t / seconds + shape * t * (seconds - t),
            None => v0 + shape * t,
        };
        wished.clamp(0.0, top)
    };
    let after = |shape: f64, steps: usize| -> f64 {
        (0..steps).map(|i| speed(shape, (i as f64 + 0.5) * STEP_S) * STEP_S).sum()
    };
    // The distance rises with the shape; 40 bisections of this range leave less than a micrometre.
    let (mut low, mut high) = (-30.0, 30.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if after(middle, left) < length_m { low = middle } else { high = middle }
    }
    let steps = HORIZON_STEPS.min(left);
    (after(high, steps).min(length_m), speed(high, steps as f64 * STEP_S))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{AgentType, Size, State, Subtype};

    fn car(v0: f64) -> MotionModel {
        let start = State { vx_mps: v0, ..State::default() };
        MotionModel::new(
            AgentType::Vehicle,
            Subtype::Car,
            Size::default_for(AgentType::Vehicle, Subtype::Car),
            start,
        )
    }

    #[test]
    fn acceleration_is_constant_and_the_rest_of_the_way_fits_the_rest_of_the_time() {
        let (along, speed) = travelled(8.0, &car(8.0), 220.0, None, 200);
        // s = 8 t + a t^2 / 2 over 20 s: a = 0.3.
        assert!((along - (8.0 * 9.0 + 0.15 * 81.0)).abs() < 1e-3, "{along}");
        assert!((speed - 10.7).abs() < 1e-3, "{speed}");
    }

    #[test]
    fn stopping_short_ends_at_the_goal_and_does_not_roll_back() {
        let (along, speed) = travelled(10.0, &car(10.0), 30.0, None, 150);
        assert!((along - 30.0).abs() < 1e-3 && speed == 0.0, "{along} {speed}");
    }

    #[test]
    fn both_ends_of_the_speed_are_kept() {
        let (along, speed) = travelled(10.0, &car(10.0), 120.0, Some(2.0), 180);
        // The mean of 10 and 2 m/s over 18 s is 108 m. The other 12 m come from a parabola, half of them by
        // half time.
        assert!((along - (0.5 * (10.0 + 6.0) * 9.0 + 6.0)).abs() < 1e-2, "{along}");
        assert!((speed - (6.0 + 12.0 * 6.0 / (18.0 * 18.0 * 18.0) * 81.0)).abs() < 1e-2, "{speed}");
    }
}
