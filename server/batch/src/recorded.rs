//! Goals and starts derived from a road user's recording or start: shifted by the drawn numbers.

use experts::planning::world::AgentAtStart;
use formats::native::{GoalDoc, StartDoc};
use scene::geometry::direction;
use scene::routes::LaneGraph;
use scene::{Agent, STEP_S, Start, State, wrap_angle};
use std::f64::consts::FRAC_PI_2;

/// Least time from the start to a goal, seconds: an earlier recorded state carries no information.
const LEAST_S: f64 = 0.5;
/// Greatest shift of the time of a recorded goal, seconds.
pub const MOST_SHIFT_S: f64 = 20.0;
/// Greatest multiple of a recorded speed.
pub const MOST_TIMES: f64 = 5.0;

/// A road user's recording, the lanes of its map, and the generated time.
pub struct RecordedMotion<'a> {
    agent: &'a Agent,
    graph: &'a LaneGraph,
    start_step: usize,
    end_s: f64,
}

/// A recorded state, shifted by the drawn numbers of a goal.
fn pushed(state: &State, of: &dyn Fn(&str) -> Option<f64>) -> State {
    let number = |name: &str| of(name).unwrap_or_default();
    let (ahead_m, left_m) = (number("goal.ahead_m"), number("goal.left_m"));
    let times = of("goal.speed_times").unwrap_or(1.0);
    let (sin, cos) = state.heading_rad.sin_cos();
    State {
        x_m: state.x_m + ahead_m * cos - left_m * sin,
        y_m: state.y_m + ahead_m * sin + left_m * cos,
        heading_rad: wrap_angle(state.heading_rad + number("goal.turn_rad")),
        vx_mps: state.vx_mps * times,
        vy_mps: state.vy_mps * times,
    }
}

impl<'a> RecordedMotion<'a> {
    /// The recording of a road user from a step of the scene on, for this many seconds.
    pub fn new(agent: &'a Agent, graph: &'a LaneGraph, start_step: usize, horizon_s: f64) -> Self {
        Self { agent, graph, start_step, end_s: start_step as f64 * STEP_S + horizon_s }
    }

    /// The recorded state at the time of the goal, or the last one before it, shifted by the drawn numbers. `None` if
    /// the recording ends with the start, or the shifted time is not generated.
    pub fn goal(&self, of: &dyn Fn(&str) -> Option<f64>) -> Option<GoalDoc> {
        let asked = (of("goal.time_s").unwrap_or(self.end_s) / STEP_S).round() as usize;
        let step = self.agent.track.valid_steps().take_while(|step| *step <= asked).last()?;
        let start_s = self.start_step as f64 * STEP_S;
        let recorded_s = step as f64 * STEP_S;
        let time_s = recorded_s + of("goal.later_s").unwrap_or_default();
        if recorded_s < start_s + LEAST_S
            || !(start_s + LEAST_S..=self.end_s + STEP_S / 2.0).contains(&time_s)
        {
            return None;
        }
        let state = pushed(&self.agent.state_at(step)?, of);
        Some(GoalDoc {
            x_m: Some(state.x_m),
            y_m: Some(state.y_m),
            heading_rad: Some(state.heading_rad),
            speed_mps: of("goal.speed_mps").or(Some(state.speed_mps())),
            time_s: Some(time_s.min(self.end_s)),
            ..GoalDoc::default()
        })
    }

    /// The start in the scene, shifted by the drawn numbers: `ahead_m` is along the lane. Fields without a drawn
    /// number keep the scene's conditions. `None` if a shift is drawn and the scene has no start.
    pub fn start(&self, of: &dyn Fn(&str) -> Option<f64>) -> Option<StartDoc> {
        let of = |name: &str| of(&format!("start.{name}"));
        let Start { mut position, mut heading_rad, mut speed_mps } = self.agent.conditions.start;
        let (ahead_m, left_m, turn_rad) = (of("ahead_m"), of("left_m"), of("turn_rad"));
        let times = of("speed_times");
        if ahead_m.or(left_m).or(turn_rad).or(times).is_some() {
            let own = AgentAtStart::at(0, self.agent, &self.agent.conditions, self.start_step)?;
            let along = self.graph.moved_along(own.pose(), own.agent_type, ahead_m.unwrap_or_default());
            let left = direction(along.heading_rad + FRAC_PI_2);
            let pushed = along.position + left_m.unwrap_or_default() * left;
            let turned_rad = wrap_angle(along.heading_rad + turn_rad.unwrap_or_default());
            position = ahead_m.or(left_m).map(|_| pushed).or(position);
            heading_rad = ahead_m.or(turn_rad).map(|_| turned_rad).or(heading_rad);
            speed_mps = times.map(|times| own.start.speed_mps() * times).or(speed_mps);
        }
        Some(StartDoc {
            x_m: of("x_m").or(position.map(|at| at.x)),
            y_m: of("y_m").or(position.map(|at| at.y)),
            heading_rad: of("heading_rad").or(heading_rad),
            speed_mps: of("speed_mps").or(speed_mps),
            velocity: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::RecordedMotion;
    use scene::routes::LaneGraph;
    use scene::{Agent, AgentType, LaneMap, STEP_S, State, Subtype};
    use std::collections::BTreeMap;
    use std::f64::consts::FRAC_PI_2;

    /// Drives north at 5 m/s from the origin, recorded for 4 s.
    fn northward() -> Agent {
        let state = |step: usize| State {
            y_m: 5.0 * STEP_S * step as f64,
            heading_rad: FRAC_PI_2,
            vy_mps: 5.0,
            ..State::default()
        };
        Agent::bare(
            "1",
            AgentType::Vehicle,
            Subtype::Unknown,
            (0..=40).map(|step| Some(state(step))).collect(),
        )
    }

    fn nowhere() -> LaneGraph {
        LaneGraph::new(&LaneMap::default())
    }

    fn of<'a>(drawn: &'a BTreeMap<&str, f64>) -> impl Fn(&str) -> Option<f64> + 'a {
        move |path| drawn.get(path).copied()
    }

    #[test]
    fn a_goal_is_the_recorded_one_pushed_aside_slower_and_later() {
        let (agent, graph) = (northward(), nowhere());
        let recording = RecordedMotion::new(&agent, &graph, 10, 5.0);
        let drawn = BTreeMap::from([
            ("goal.time_s", 3.0),
            ("goal.later_s", 1.0),
            ("goal.left_m", 2.0),
            ("goal.ahead_m", 1.0),
            ("goal.speed_times", 0.5),
        ]);
        let goal = recording.goal(&of(&drawn)).unwrap();
        let near = |value: Option<f64>, expected: f64| {
            assert!((value.unwrap() - expected).abs() < 1e-9, "{value:?}")
        };
        near(goal.x_m, -2.0);
        near(goal.y_m, 16.0);
        near(goal.heading_rad, FRAC_PI_2);
        near(goal.speed_mps, 2.5);
        near(goal.time_s, 4.0);
        // The recording ends after 4 s, before the end of the generated time.
        let last = recording.goal(&|_| None).unwrap();
        near(last.y_m, 20.0);
        near(last.time_s, 4.0);
    }

    #[test]
    fn nobody_fits_whose_recording_or_time_is_not_there() {
        let (agent, graph) = (northward(), nowhere());
        assert!(RecordedMotion::new(&agent, &graph, 38, 5.0).goal(&|_| None).is_none());
        let recording = RecordedMotion::new(&agent, &graph, 0, 5.0);
        for later in [-3.8, 1.2] {
            assert!(recording.goal(&of(&BTreeMap::from([("goal.later_s", later)]))).is_none());
        }
        let pushed = BTreeMap::from([("start.ahead_m", 1.0)]);
        assert!(RecordedMotion::new(&agent, &graph, 50, 5.0).start(&of(&pushed)).is_none());
    }

    #[test]
    fn a_start_is_pushed_in_what_is_drawn_alone() {
        let (agent, graph) = (northward(), nowhere());
        let recording = RecordedMotion::new(&agent, &graph, 10, 5.0);
        let start = recording.start(&of(&BTreeMap::from([("start.speed_times", 2.0)]))).unwrap();
        assert_eq!((start.x_m, start.heading_rad, start.speed_mps), (None, None, Some(10.0)));
        let start = recording.start(&of(&BTreeMap::from([("start.ahead_m", -3.0)]))).unwrap();
        assert!((start.y_m.unwrap() - 2.0).abs() < 1e-9 && start.x_m.unwrap().abs() < 1e-9);
        assert_eq!(start.speed_mps, None);
    }

    #[test]
    fn a_start_is_pushed_from_the_one_in_the_scene() {
        let (mut agent, graph) = (northward(), nowhere());
        agent.conditions.start.position = Some(scene::Vec2::new(3.0, 1.0));
        agent.conditions.start.speed_mps = Some(4.0);
        let recording = RecordedMotion::new(&agent, &graph, 10, 5.0);
        let start = recording.start(&of(&BTreeMap::from([("start.ahead_m", 2.0)]))).unwrap();
        assert_eq!((start.x_m, start.speed_mps), (Some(3.0), Some(4.0)));
        assert!((start.y_m.unwrap() - 3.0).abs() < 1e-9);
        let start = recording.start(&of(&BTreeMap::from([("start.speed_times", 0.5)]))).unwrap();
        assert_eq!((start.x_m, start.y_m, start.speed_mps), (Some(3.0), Some(1.0), Some(2.0)));
    }
}
