//! Writes road users as obstacles, and the one with a goal as a planning problem.

use super::export_map::position;
use super::words::road_user_word;
use crate::format::EGO;
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::polyline::length;
use scene::map::Lane;
use scene::{
    Agent, Conditions, Goal, HORIZON_STEPS, STEP_S, Scene, Shown, State, Subtype, Track, Vec2, wrap_angle,
};
use std::collections::BTreeSet;
use std::f64::consts::{FRAC_PI_2, PI};

/// Side of the square in which a goal lies, metres.
const GOAL_M: f64 = 1.0;
/// Tolerances of a goal: heading (radians), speed (m/s) and time (steps).
const OFF: (f64, f64, usize) = (0.1, 0.5, 5);

/// A road user of the scenario.
pub(super) struct ScenarioAgent<'a> {
    pub agent: &'a Agent,
    /// Its motion in the file.
    pub shown: &'a Shown<'a>,
    /// Its number in the scenario.
    pub id: i64,
    /// Whether the user fixed more than boxes and states can hold.
    pub is_fixed: bool,
}

/// The road user that a planner drives, with its start and goal.
pub(super) struct PlanningTask {
    /// Index in the list of road users.
    agent: usize,
    first_step: usize,
    start: State,
    goal: Goal,
}

/// Writes a planning problem from the beginning of the longest lane to its end, for a scene without an ego or
/// a goal: a scenario needs one.
pub(super) fn write_made(scene: &Scene, id: i64, out: &mut Markup) {
    let lanes = &scene.map.lanes;
    let length =
        |lane: &&Lane| if lane.lane_type.carries_vehicles() { length(&lane.points.xy) } else { -1.0 };
    let longest = lanes.iter().max_by(|a, b| length(a).total_cmp(&length(b)));
    let Some([first, second, ..]) = longest.map(|lane| lane.points.xy.as_slice()) else { return };
    let way = second - first;
    let heading_rad = way.y.atan2(way.x);
    let start = State { x_m: first.x, y_m: first.y, heading_rad, ..State::default() };
    let position = longest.and_then(|lane| lane.points.xy.last().copied());
    let goal = Goal { position, ..Goal::default() };
    planning_problem(&PlanningTask { agent: 0, first_step: 0, start, goal }, id, out);
}

impl PlanningTask {
    /// The task of the ego, otherwise of the first road user with a goal; `None` without any start. `shown`
    /// are the road users of the scene with their motion in the file.
    pub fn of(scene: &Scene, shown: &[Shown<'_>]) -> Option<Self> {
        let agents = &scene.agents;
        let ego = agents.iter().position(|agent| agent.role.as_deref() == Some(EGO));
        let agent = ego.or_else(|| agents.iter().position(|agent| !agent.conditions.goal.is_free()))?;
        let shown = shown.get(agent)?;
        let (first_step, start) = *known(&shown.track, &agents[agent]).first()?;
        let mut goal = agents[agent].conditions.goal;
        if goal.is_free() {
            // Its last recorded state becomes the goal.
            let last = shown.track.last_valid_step().filter(|last| *last > first_step);
            let end = last.and_then(|last| Some((last, shown.track.at(last)?)));
            if let Some((last, end)) = end {
                goal.position = Some(end.position());
                goal.time_s = Some(last as f64 * STEP_S);
            }
        }
        Some(Self { agent, first_step, start, goal })
    }
}

/// Writes all road users.
pub(super) fn write(
    scene: &Scene,
    users: &[ScenarioAgent<'_>],
    problem: Option<&PlanningTask>,
    out: &mut Markup,
    losses: &mut BTreeSet<Loss>,
) {
    let mut lost = Lost::default();
    for (i, user) in users.iter().enumerate() {
        if problem.is_none_or(|problem| problem.agent != i) {
            obstacle(user, out, &mut lost);
        }
    }
    if let Some(problem) = problem {
        lost.late |= problem.first_step > 0;
        planning_problem(problem, users.get(problem.agent).map_or(1, |user| user.id), out);
    }
    lost.tell(scene, problem, losses);
}

#[derive(Default)]
struct Lost {
    late: bool,
    gaps: bool,
    subtype: bool,
    conditions: bool,
}

impl Lost {
    fn tell(&self, scene: &Scene, problem: Option<&PlanningTask>, losses: &mut BTreeSet<Loss>) {
        let agents = &scene.agents;
        let ego = problem.and_then(|problem| agents.get(problem.agent));
        let fixed = ego.is_some_and(|ego| {
            let Conditions { agent_type, length_m, width_m, relation, may_cross, via, .. } = &ego.conditions;
            agent_type.is_some()
                || relation.is_some()
                || length_m.is_some()
                || width_m.is_some()
                || !may_cross.is_empty()
                || !via.is_empty()
        });
        let roles = agents.iter().filter(|agent| agent.role.is_some()).count();
        let is_ego = ego.is_some_and(|ego| ego.role.as_deref() == Some(EGO));
        // The format stores neither steps after the last state nor the present step.
        let last = agents.iter().filter_map(|agent| agent.track.last_valid_step()).max();
        let timing =
            scene.time.now_step != 0 || last.is_none_or(|last| last + 1 != scene.time.steps) || ego.is_some();
        let all = [
            (
                ego.is_some(),
                code::SINGLE_EGO,
                "one planning problem: of the ego, else of the first road user with a goal, it says where it starts and what it must reach; its motion, size and kind are left out",
            ),
            (
                self.conditions || fixed,
                code::NO_CONDITIONS,
                "what was fixed of other road users, and of this one all but start and goal",
            ),
            (roles > usize::from(is_ego), code::NO_ROLES, "roles other than the ego's"),
            (
                self.subtype,
                code::NO_SUBTYPE,
                "finer kinds that the format has no word for; vehicles without one become cars",
            ),
            (agents.iter().any(|a| a.size.height_m.is_some()), code::NO_SIZES, "heights of boxes"),
            (
                self.gaps,
                code::NO_VALIDITY_GAPS,
                "gaps are filled in; who was seen once gets a second state, who was never seen is left out",
            ),
            (
                self.late,
                code::LATE_ROAD_USERS,
                "road users that come after the first step: CommonRoad's readers take them, its schema does not",
            ),
            (timing, code::NO_TIMING, "the present step, and steps after the last state"),
        ];
        losses.extend(
            all.into_iter().filter(|(there, ..)| *there).map(|(_, code, detail)| Loss::new(code, detail)),
        );
    }
}

fn obstacle(user: &ScenarioAgent<'_>, out: &mut Markup, lost: &mut Lost) {
    let ScenarioAgent { agent, shown, id, is_fixed } = user;
    lost.conditions |= *is_fixed;
    let known = known(&shown.track, agent);
    let states = filled(&known);
    lost.gaps |= states.len() != known.len();
    let Some((first, rest)) = states.split_first() else {
        lost.gaps = true;
        return;
    };
    lost.late |= first.0 > 0;
    let (word, says_all) = road_user_word(shown.agent_type, agent.subtype);
    lost.subtype |= !says_all || (word == "car" && agent.subtype == Subtype::Unknown);
    out.open("dynamicObstacle", &[("id", &id.to_string())]);
    out.leaf("type", word);
    out.open("shape", &[]);
    out.open("rectangle", &[]);
    out.leaf("length", decimal(shown.size.length_m));
    out.leaf("width", decimal(shown.size.width_m));
    out.close();
    out.close();
    let slips = states.iter().any(|(_, state)| along(state).1.abs() > 1e-6);
    out.open("initialState", &[]);
    state(*first, slips, out);
    // CommonRoad's own reader stops at the first missing member of an initial state: slip therefore comes
    // last.
    let (next, speeds) = (rest.first().unwrap_or(first), |state: &State| along(state).0);
    let turned = wrap_angle(next.1.heading_rad - first.1.heading_rad);
    exact("acceleration", decimal((speeds(&next.1) - speeds(&first.1)) / STEP_S), out);
    exact("yawRate", decimal(turned / STEP_S), out);
    out.close();
    out.open("trajectory", &[]);
    for next in rest {
        out.open("state", &[]);
        state(*next, slips, out);
        out.close();
    }
    out.close();
    out.close();
}

/// States of a road user; for one that the user drew and that never moved, its drawn position.
fn known(track: &Track, agent: &Agent) -> Vec<(usize, State)> {
    let mut known: Vec<_> = track.valid_steps().filter_map(|step| Some((step, *track.at(step)?))).collect();
    let start = &agent.conditions.start;
    if let (true, Some(p)) = (known.is_empty(), start.position) {
        let heading_rad = start.heading_rad.unwrap_or(0.0);
        let v = scene::geometry::direction(heading_rad) * start.speed_mps.unwrap_or(0.0);
        known.push((0, State { x_m: p.x, y_m: p.y, heading_rad, vx_mps: v.x, vy_mps: v.y }));
    }
    known
}

/// Two states or more at consecutive steps, with straight motion in the gaps.
fn filled(known: &[(usize, State)]) -> Vec<(usize, State)> {
    let mut states: Vec<(usize, State)> = Vec::new();
    for (step, state) in known {
        if let Some((last, from)) = states.last().copied() {
            let gap = (step - last) as f64;
            for i in last + 1..*step {
                let share = (i - last) as f64 / gap;
                let mix = |a: f64, b: f64| a + (b - a) * share;
                let turn = wrap_angle(state.heading_rad - from.heading_rad);
                let between = State {
                    x_m: mix(from.x_m, state.x_m),
                    y_m: mix(from.y_m, state.y_m),
                    heading_rad: wrap_angle(from.heading_rad + turn * share),
                    vx_mps: mix(from.vx_mps, state.vx_mps),
                    vy_mps: mix(from.vy_mps, state.vy_mps),
                };
                states.push((i, between));
            }
        }
        states.push((*step, *state));
    }
    if let [(step, only)] = states.as_slice() {
        let next =
            State { x_m: only.x_m + only.vx_mps * STEP_S, y_m: only.y_m + only.vy_mps * STEP_S, ..*only };
        states.push((step + 1, next));
    }
    states
}

/// Velocity as a speed, negative backwards, and the angle between its direction and the heading, radians.
fn along(state: &State) -> (f64, f64) {
    let (v, speed) = (state.velocity(), state.speed_mps());
    if speed < 1e-9 {
        return (0.0, 0.0);
    }
    let slip = wrap_angle(v.y.atan2(v.x) - state.heading_rad);
    if slip.abs() > FRAC_PI_2 { (-speed, wrap_angle(slip + PI)) } else { (speed, slip) }
}

/// Radians with nine decimals: fewer would be visible at a distance.
fn angle(angle_rad: f64) -> String {
    ((wrap_angle(angle_rad) * 1e9).round() / 1e9 + 0.0).to_string()
}

fn exact(name: &'static str, value: impl std::fmt::Display, out: &mut Markup) {
    out.open(name, &[]);
    out.leaf("exact", value);
    out.close();
}

fn state((step, state): (usize, State), slips: bool, out: &mut Markup) {
    let (speed, slip) = along(&state);
    position(state.position(), out);
    exact("orientation", angle(state.heading_rad), out);
    exact("time", step, out);
    exact("velocity", decimal(speed), out);
    if slips {
        exact("slipAngle", angle(slip), out);
    }
}

fn interval(name: &'static str, (from, to): (f64, f64), out: &mut Markup) {
    out.open(name, &[]);
    out.leaf("intervalStart", decimal(from));
    out.leaf("intervalEnd", decimal(to));
    out.close();
}

fn planning_problem(problem: &PlanningTask, id: i64, out: &mut Markup) {
    out.open("planningProblem", &[("id", &id.to_string())]);
    out.open("initialState", &[]);
    let start = &problem.start;
    let (speed, slip) = along(start);
    position(start.position(), out);
    exact("velocity", decimal(speed), out);
    exact("orientation", angle(start.heading_rad), out);
    exact("yawRate", 0, out);
    exact("slipAngle", angle(slip), out);
    // The schema allows no other time here.
    exact("time", 0, out);
    out.close();
    out.open("goalState", &[]);
    let goal = &problem.goal;
    let latest = problem.first_step + HORIZON_STEPS;
    let (from, to) = match goal.time_s.map(|time_s| (time_s / STEP_S).round().max(1.0) as usize) {
        // An early goal gets less tolerance: its time begins two steps after the first one at the earliest.
        Some(step) => {
            let off = OFF.2.min(step.saturating_sub(problem.first_step + 2));
            (step - off, step + off)
        }
        None => (problem.first_step.max(1), latest),
    };
    out.open("time", &[]);
    out.leaf("intervalStart", from);
    out.leaf("intervalEnd", to);
    out.close();
    if let Some(p) = goal.position {
        square(p, out);
    }
    if let Some(heading) = goal.heading_rad {
        interval("orientation", (heading - OFF.0, heading + OFF.0), out);
    }
    if let Some(speed) = goal.speed_mps {
        let off = OFF.1.min(speed);
        interval("velocity", (speed - off, speed + off), out);
    }
    out.close();
    out.close();
}

fn square(p: Vec2, out: &mut Markup) {
    out.open("position", &[]);
    out.open("rectangle", &[]);
    out.leaf("length", decimal(GOAL_M));
    out.leaf("width", decimal(GOAL_M));
    out.leaf("orientation", 0);
    out.open("center", &[]);
    out.leaf("x", decimal(p.x));
    out.leaf("y", decimal(p.y));
    out.close();
    out.close();
    out.close();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_filled_and_one_state_becomes_two() {
        let at = |x_m: f64| State { x_m, vx_mps: 10.0, ..State::default() };
        let filled = |known: &[(usize, State)]| -> Vec<(usize, f64)> {
            filled(known).iter().map(|(step, state)| (*step, state.x_m)).collect()
        };
        assert_eq!(filled(&[(2, at(2.0)), (5, at(8.0))]), [(2, 2.0), (3, 4.0), (4, 6.0), (5, 8.0)]);
        assert_eq!(filled(&[(4, at(1.0))]), [(4, 1.0), (5, 2.0)]);
        assert_eq!(filled(&[]), []);
    }

    #[test]
    fn velocities_are_along_the_heading_or_against_it() {
        let state = State { heading_rad: 3.0, vx_mps: 3.0, vy_mps: -4.0, ..State::default() };
        let (speed, slip) = along(&state);
        assert!(speed < 0.0 && slip.abs() < FRAC_PI_2);
        let back = scene::geometry::direction(state.heading_rad + slip) * speed;
        assert!((back - state.velocity()).norm() < 1e-12);
        assert_eq!(along(&State::default()), (0.0, 0.0));
    }
}
