//! Requests of runs, with their defaults and ranges.

use crate::code::Code;
use crate::english::{self, wanted};
use crate::home::{AboutScene, SceneRef, one_scene};
use crate::limits::STEPS;
use crate::problem::{Problem, refuse};
use experts::run::{EgoState, PLAN_INTERVAL_MS, RUN_STEP_MS, RunSettings};
use formats::native::{MAX_SAFE_INTEGER, Members, SceneDoc};
use formats::problem::MAX_PROBLEMS;
use formats::refusals::expected;
use formats::{FieldProblem, pointer_token};
use scene::{AgentId, STEP_S, Scene, State as AgentState};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Body that begins a run. Exactly one of `scene` and `scene_id` is given. With `snapshot` the egos and all settings are
/// those of the snapshot.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = one_scene)]
pub struct RunBody {
    /// The scene itself; its map may be `{"ref":"sha256:HEX"}`.
    pub scene: Option<SceneDoc>,
    /// A scene of this server.
    pub scene_id: Option<String>,
    /// With `scene_id`: the call is refused if the scene has changed.
    pub etag: Option<String>,
    /// Road users that the caller drives, by id; none by default.
    pub egos: Option<Vec<String>>,
    /// Seed, which repeats the run; 0 by default.
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: Option<u64>,
    /// Length of a step, seconds, in whole milliseconds; 0.1 by default.
    #[schemars(range(min = 0.05, max = 0.5))]
    pub step_s: Option<f64>,
    /// Replan interval of the other road users, seconds; 1 by default.
    #[schemars(range(min = 0.2, max = 5.0))]
    pub plan_interval_s: Option<f64>,
    /// Scene time at which the run begins, seconds; 0 by default.
    #[schemars(range(min = 0.0, max = 59.9))]
    pub start_s: Option<f64>,
    /// Refinement steps of each plan; 1 by default.
    #[schemars(range(max = 100))]
    pub steps: Option<u64>,
    /// A snapshot of a run in this scene, base64, from which the run continues.
    pub snapshot: Option<String>,
}

impl AboutScene for RunBody {
    fn take_scene(&mut self) -> SceneRef {
        let (scene, scene_id, etag) = (self.scene.take(), self.scene_id.take(), self.etag.take());
        SceneRef { scene, scene_id, etag, hold: false }
    }
}

impl RunBody {
    /// The settings, with every number checked against its range.
    pub(super) fn settings(&self, scene: &Scene) -> Result<RunSettings, Problem> {
        let usual = RunSettings::default();
        let seconds = |milliseconds: u32| f64::from(milliseconds) / 1e3;
        let seed = self.seed.unwrap_or(usual.seed);
        let step_s = self.step_s.unwrap_or(seconds(usual.step_ms));
        let plan_interval_s = self.plan_interval_s.unwrap_or(seconds(usual.plan_interval_ms));
        let start_s = self.start_s.unwrap_or(0.0);
        let steps = self.steps.unwrap_or(usual.refinement as u64);
        let last_s = (scene.time.steps - 1) as f64 * STEP_S;
        let (step, interval) = (RUN_STEP_MS, PLAN_INTERVAL_MS);
        let numbers = [
            ("/seed", 0.0, MAX_SAFE_INTEGER as f64, seed as f64),
            ("/step_s", seconds(step.0), seconds(step.1), step_s),
            ("/plan_interval_s", seconds(interval.0), seconds(interval.1), plan_interval_s),
            ("/start_s", 0.0, last_s, start_s),
            ("/steps", 0.0, STEPS as f64, steps as f64),
        ];
        // The last step's time is rounded.
        let outside = numbers.into_iter().filter(|(_, min, max, got)| !(*got >= *min && *got <= max + 1e-9));
        refuse(outside.map(|(at, min, max, got)| FieldProblem::range(at, min, max, got)).collect())?;
        Ok(RunSettings {
            seed,
            step_ms: (step_s * 1e3).round() as u32,
            plan_interval_ms: (plan_interval_s * 1e3).round() as u32,
            start_step: (start_s / STEP_S).round() as usize,
            refinement: steps as usize,
        })
    }

    /// Checks that only the scene is given besides a snapshot.
    pub(super) fn check_restored(&self) -> Result<(), Problem> {
        let given = [
            ("egos", self.egos.is_some()),
            ("seed", self.seed.is_some()),
            ("step_s", self.step_s.is_some()),
            ("plan_interval_s", self.plan_interval_s.is_some()),
            ("start_s", self.start_s.is_some()),
            ("steps", self.steps.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            Some((member, _)) => {
                let problem = Problem::of(Code::InvalidField, english::setting_of_snapshot(member));
                Err(problem.at(&format!("/{member}")))
            }
            None => Ok(()),
        }
    }
}

/// Position, heading and velocity of a road user at one moment, scene frame.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "the names say it")]
pub struct StateDoc {
    pub x_m: f64,
    pub y_m: f64,
    pub heading_rad: f64,
    pub vx_mps: f64,
    pub vy_mps: f64,
}

/// States as columns, 0.1 s apart.
#[derive(Clone, Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "the names say it")]
pub struct MotionDoc {
    pub x_m: Vec<f64>,
    pub y_m: Vec<f64>,
    pub heading_rad: Vec<f64>,
    pub vx_mps: Vec<f64>,
    pub vy_mps: Vec<f64>,
}

impl MotionDoc {
    /// The states, or the fault at this pointer.
    fn states(&self, pointer: &str) -> Result<Vec<AgentState>, FieldProblem> {
        let count = self.x_m.len();
        let columns = [&self.y_m, &self.heading_rad, &self.vx_mps, &self.vy_mps];
        if columns.iter().any(|column| column.len() != count) {
            return Err(FieldProblem::new(pointer, "invalid-field", expected(wanted::COLUMNS)));
        }
        let state = |i: usize| AgentState {
            x_m: self.x_m[i],
            y_m: self.y_m[i],
            heading_rad: self.heading_rad[i],
            vx_mps: self.vx_mps[i],
            vy_mps: self.vy_mps[i],
        };
        Ok((0..count).map(state).collect())
    }
}

/// State and plan of an ego at the end of a step.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EgoDoc {
    /// One of the run's egos.
    pub id: String,
    /// Box centre, metres.
    pub x_m: f64,
    /// Box centre, metres.
    pub y_m: f64,
    /// Radians.
    pub heading_rad: f64,
    /// Velocity of the box centre, m/s.
    pub vx_mps: f64,
    /// Velocity of the box centre, m/s.
    pub vy_mps: f64,
    /// Announced motion: at most 90 states, the first 0.1 s after the step's end. Without a plan, the others expect
    /// it to continue along its lane.
    #[serde(default)]
    pub plan: MotionDoc,
}

/// Body of a step.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepBody {
    /// Number of the step: one more than the last. Repeating the last number returns the same reply.
    #[schemars(range(max = 9007199254740991u64))]
    pub number: u64,
    /// States of all egos at the end of the step.
    #[serde(default)]
    pub egos: Vec<EgoDoc>,
}

impl StepBody {
    /// The states of the egos.
    pub(super) fn states(&self) -> Result<Vec<EgoState>, Problem> {
        let (mut faults, mut states) = (Vec::new(), Vec::new());
        for (i, ego) in self.egos.iter().enumerate() {
            let EgoDoc { x_m, y_m, heading_rad, vx_mps, vy_mps, .. } = *ego;
            let state = AgentState { x_m, y_m, heading_rad, vx_mps, vy_mps };
            match ego.plan.states(&format!("/egos/{i}/plan")) {
                Ok(plan) => states.push(EgoState { id: ego.id.clone(), state, plan }),
                Err(fault) => faults.push(fault),
            }
        }
        faults.truncate(MAX_PROBLEMS);
        refuse(faults)?;
        Ok(states)
    }
}

/// Body of a peek into the future of a run.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PeekBody {
    /// Motion by ego, the first state 0.1 s after the present; at most 90 states. An ego that is left out follows its
    /// announced plan.
    pub plans: Members<MotionDoc>,
}

impl PeekBody {
    /// The states by ego.
    pub(super) fn motions(&self) -> Result<BTreeMap<AgentId, Vec<AgentState>>, Problem> {
        let (mut faults, mut plans) = (Vec::new(), BTreeMap::new());
        for (id, motion) in &self.plans.0 {
            match motion.states(&format!("/plans/{}", pointer_token(id))) {
                Ok(states) => drop(plans.insert(id.clone(), states)),
                Err(fault) => faults.push(fault),
            }
        }
        faults.truncate(MAX_PROBLEMS);
        refuse(faults)?;
        Ok(plans)
    }
}
