//! Conditions that begin at a road user's own recording: where it was, pushed by drawn numbers.

use formats::native::{GoalDoc, StartDoc};
use scene::{Agent, STEP_S, State, wrap_angle};

/// Least time from the start to a goal, seconds: a step of the recording before it says nothing.
const LEAST_S: f64 = 0.5;
/// Greatest shift of the time of a recorded goal, seconds.
pub const MOST_SHIFT_S: f64 = 20.0;
/// Greatest multiple of a recorded speed.
pub const MOST_TIMES: f64 = 5.0;

/// A road user's recording, and the time that is generated.
pub struct RecordedMotion<'a> {
    agent: &'a Agent,
    start_step: usize,
    end_s: f64,
}

/// Numbers that push a recorded state.
struct Push {
    ahead_m: f64,
    left_m: f64,
    turn_rad: f64,
    times: f64,
}

impl Push {
    /// Drawn for the goal or the start of a situation; 0, and the recorded speed, where a number is absent.
    fn drawn(of: &dyn Fn(&str) -> Option<f64>, member: &str) -> Self {
        let of = |name: &str| of(&format!("{member}.{name}"));
        let number = |name: &str| of(name).unwrap_or_default();
        Self {
            ahead_m: number("ahead_m"),
            left_m: number("left_m"),
            turn_rad: number("turn_rad"),
            times: of("speed_times").unwrap_or(1.0),
        }
    }

    fn moved(&self, state: &State) -> State {
        let (sin, cos) = state.heading_rad.sin_cos();
        State {
            x_m: state.x_m + self.ahead_m * cos - self.left_m * sin,
            y_m: state.y_m + self.ahead_m * sin + self.left_m * cos,
            heading_rad: wrap_angle(state.heading_rad + self.turn_rad),
            vx_mps: state.vx_mps * self.times,
            vy_mps: state.vy_mps * self.times,
        }
    }
}

impl<'a> RecordedMotion<'a> {
    /// Of a road user, from a step of the scene on for so many seconds.
    pub fn new(agent: &'a Agent, start_step: usize, horizon_s: f64) -> Self {
        Self { agent, start_step, end_s: start_step as f64 * STEP_S + horizon_s }
    }

    /// The recorded state at the time of the goal, or the last one before it, pushed by the drawn numbers. `None` where
    /// the recording ends with the start, or the shifted time is not one of those that are generated.
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
        let state = Push::drawn(of, "goal").moved(&self.agent.state_at(step)?);
        Some(GoalDoc {
            x_m: Some(state.x_m),
            y_m: Some(state.y_m),
            heading_rad: Some(state.heading_rad),
            speed_mps: of("goal.speed_mps").or(Some(state.speed_mps())),
            time_s: Some(time_s.min(self.end_s)),
            ..GoalDoc::default()
        })
    }

    /// The recorded start, pushed by the drawn numbers: what they do not concern stays free.
    pub fn start(&self, of: &dyn Fn(&str) -> Option<f64>) -> Option<StartDoc> {
        let state = Push::drawn(of, "start").moved(&self.agent.state_at(self.start_step)?);
        let is_moved = of("start.ahead_m").or(of("start.left_m")).is_some();
        let turn = of("start.turn_rad").map(|_| state.heading_rad);
        let speed = of("start.speed_times").map(|_| state.speed_mps());
        Some(StartDoc {
            x_m: is_moved.then_some(state.x_m).or(of("start.x_m")),
            y_m: is_moved.then_some(state.y_m).or(of("start.y_m")),
            heading_rad: turn.or(of("start.heading_rad")),
            speed_mps: speed.or(of("start.speed_mps")),
            velocity: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::RecordedMotion;
    use scene::{Agent, AgentType, STEP_S, State, Subtype};
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

    fn of<'a>(drawn: &'a BTreeMap<&str, f64>) -> impl Fn(&str) -> Option<f64> + 'a {
        move |path| drawn.get(path).copied()
    }

    #[test]
    fn a_goal_is_the_recorded_one_pushed_aside_slower_and_later() {
        let agent = northward();
        let recording = RecordedMotion::new(&agent, 10, 5.0);
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
        // The recording ends after 4 s, before the end of what is generated.
        let last = recording.goal(&|_| None).unwrap();
        near(last.y_m, 20.0);
        near(last.time_s, 4.0);
    }

    #[test]
    fn nobody_fits_whose_recording_or_time_is_not_there() {
        let agent = northward();
        assert!(RecordedMotion::new(&agent, 38, 5.0).goal(&|_| None).is_none());
        let recording = RecordedMotion::new(&agent, 0, 5.0);
        for later in [-3.8, 1.2] {
            assert!(recording.goal(&of(&BTreeMap::from([("goal.later_s", later)]))).is_none());
        }
        assert!(RecordedMotion::new(&agent, 50, 5.0).start(&|_| None).is_none());
    }

    #[test]
    fn a_start_is_pushed_in_what_is_drawn_alone() {
        let agent = northward();
        let recording = RecordedMotion::new(&agent, 10, 5.0);
        let start = recording.start(&of(&BTreeMap::from([("start.speed_times", 2.0)]))).unwrap();
        assert_eq!((start.x_m, start.heading_rad, start.speed_mps), (None, None, Some(10.0)));
        let start = recording.start(&of(&BTreeMap::from([("start.ahead_m", -3.0)]))).unwrap();
        assert!((start.y_m.unwrap() - 2.0).abs() < 1e-9 && start.x_m.unwrap().abs() < 1e-9);
        assert_eq!(start.speed_mps, None);
    }
}
