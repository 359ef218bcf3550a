//! Runs: stepped traffic around road users that the caller drives.

mod reply;
mod request;

pub use reply::{PeekReply, RunEvent, RunReply, SnapshotReply, StepReply};
pub use request::{EgoDoc, MotionDoc, PeekBody, RunBody, StateDoc, StepBody};

use crate::code::Code;
use crate::english;
use crate::problem::{Problem, refuse, shortened};
use base64::engine::general_purpose::STANDARD;
use base64::{DecodeError, Engine};
use experts::run::{RunPeek, RunStep, SnapshotError, VERSION_AT};
use experts::{Cancel, Generator, Run, RunError};
use formats::FieldProblem;
use formats::native::MAX_SAFE_INTEGER;
use scene::Scene;
use schemars::SchemaGenerator;
use std::sync::Arc;

impl RunBody {
    /// Begins a run, or restores one.
    ///
    /// # Errors
    /// Every fault of the settings, the egos and the snapshot; a cancelled call.
    pub fn begin(&self, scene: &Arc<Scene>, generator: &Generator, cancel: &Cancel) -> Result<Run, Problem> {
        if let Some(text) = &self.snapshot {
            self.check_restored()?;
            let bytes = STANDARD.decode(text).map_err(|error| {
                let at = first_wrong(&error, text.len());
                Problem::of(Code::InvalidField, english::snapshot_broken(at)).at("/snapshot")
            })?;
            return Ok(Run::restore(Arc::clone(scene), &bytes)?);
        }
        let settings = self.settings(scene)?;
        let egos = self.egos.clone().unwrap_or_default();
        Ok(Run::new(Arc::clone(scene), &egos, settings, generator, cancel)?)
    }
}

impl StepBody {
    /// Makes the next step.
    ///
    /// # Errors
    /// `step-order` unless it is the next one, every fault of the egos' states, a cancelled call.
    pub fn step(&self, run: &mut Run, generator: &Generator, cancel: &Cancel) -> Result<RunStep, Problem> {
        let next = run.number() + 1;
        if self.number > MAX_SAFE_INTEGER {
            refuse(vec![FieldProblem::range("/number", 0.0, MAX_SAFE_INTEGER as f64, self.number as f64)])?;
        }
        if self.number != next {
            return Err(Problem::of(
                Code::StepOrder,
                english::step_order(self.number as usize, next as usize),
            ));
        }
        let egos = self.states()?;
        Ok(run.step(generator, &egos, cancel)?)
    }
}

impl PeekBody {
    /// Predicts the motion of the others.
    ///
    /// # Errors
    /// Every fault of the plans; a cancelled call.
    pub fn peek(&self, run: &Run, generator: &Generator, cancel: &Cancel) -> Result<RunPeek, Problem> {
        let plans = self.motions()?;
        run.peek(generator, &plans, cancel).map_err(|error| Problem::from(error).moved("/egos", "/plans"))
    }
}

impl Problem {
    /// The same refusal about another member.
    fn moved(mut self, from: &str, to: &str) -> Self {
        for error in self.members.errors.iter_mut().flatten() {
            if let Some(rest) = error.pointer.strip_prefix(from) {
                error.pointer = format!("{to}{rest}");
            }
        }
        self
    }
}

impl From<RunError> for Problem {
    fn from(error: RunError) -> Self {
        let of = |code, message| Self::of(code, message).at("/egos");
        match error {
            RunError::UnknownAgent(id) => of(Code::UnknownAgent, english::unknown_agent(&shortened(&id))),
            RunError::EgoAbsent(id) => of(Code::StartMissing, english::ego_absent(&shortened(&id))),
            RunError::EgoTwice(id) => of(Code::InvalidField, english::ego_once(&shortened(&id))),
            RunError::EgoMissing(id) => of(Code::InvalidField, english::ego_once(&shortened(&id))),
            RunError::NotAnEgo(id) => of(Code::InvalidField, english::not_an_ego(&shortened(&id))),
            RunError::NoState { agent, at } => {
                of(Code::OutOfRange, english::no_state(&shortened(&agent), at))
            }
            RunError::PlanTooLong { found, most, .. } => Self::range("/egos", 0.0, most as f64, found as f64),
            RunError::OutOfRange { what, least, most, got } => {
                Self::range(&format!("/{what}"), least as f64, most as f64, got as f64)
            }
            RunError::Over { most } => Self::range("/number", 1.0, most as f64, most as f64 + 1.0),
            RunError::Snapshot(error) => Self::of(Code::InvalidField, snapshot(error)).at("/snapshot"),
            RunError::Generate(error) => error.into(),
        }
    }
}

/// Index of the first invalid byte in a base64 text of `length` bytes.
fn first_wrong(error: &DecodeError, length: usize) -> usize {
    match *error {
        DecodeError::InvalidByte(at, _) | DecodeError::InvalidLastSymbol(at, _) => at,
        DecodeError::InvalidLength(_) | DecodeError::InvalidPadding => length,
    }
}

/// The message about an invalid snapshot.
fn snapshot(error: SnapshotError) -> scene::message::Message {
    match error {
        SnapshotError::NoSnapshot => english::snapshot_broken(0),
        SnapshotError::Version(_) => english::snapshot_broken(VERSION_AT),
        SnapshotError::OtherScene => english::snapshot_of_another_scene(),
        SnapshotError::Ends(at) | SnapshotError::GoesOn(at) | SnapshotError::Value { at, .. } => {
            english::snapshot_broken(at)
        }
    }
}

/// Adds the schemas of the replies.
pub fn replies(generator: &mut SchemaGenerator) {
    generator.subschema_for::<RunReply>();
    generator.subschema_for::<RunEvent>();
    generator.subschema_for::<StepReply>();
    generator.subschema_for::<PeekReply>();
    generator.subschema_for::<SnapshotReply>();
}

/// Adds the schemas of the requests.
pub fn requests(generator: &mut SchemaGenerator) {
    generator.subschema_for::<RunBody>();
    generator.subschema_for::<StepBody>();
    generator.subschema_for::<PeekBody>();
}

/// The refusal of a run that the transport does not have, or no longer has.
pub fn unknown_run() -> Problem {
    Problem::new(Code::NotFound, "No run has this id. A server forgets runs that are not used for a while.")
}

#[cfg(test)]
mod tests {
    use super::{RunBody, StepBody};
    use crate::code::Code;
    use base64::Engine;
    use base64::engine::general_purpose::STANDARD;
    use experts::{Cancel, Generator};
    use scene::map::{Lane, LaneMap};
    use scene::{Agent, AgentType, Scene, State, Subtype, Vec2};
    use std::sync::Arc;

    fn street() -> Arc<Scene> {
        let lane = Lane::street("a", vec![Vec2::new(0.0, 0.0), Vec2::new(300.0, 0.0)]);
        let car = |id: &str, x_m: f64| {
            let state = State { x_m, vx_mps: 8.0, ..State::default() };
            Agent::bare(id, AgentType::Vehicle, Subtype::Car, vec![Some(state)])
        };
        let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
        Arc::new(Scene::bare("street", map, vec![car("1", 60.0), car("2", 30.0)]))
    }

    fn body(text: &str) -> RunBody {
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn a_run_is_begun_stepped_in_order_and_restored() {
        let (scene, generator) = (street(), Generator::random(1).unwrap());
        let none = Cancel::default();
        let mut run = body(r#"{"egos": ["1"], "step_s": 0.2}"#).begin(&scene, &generator, &none).unwrap();
        let ego = r#"{"id": "1", "x_m": 61.6, "y_m": 0, "heading_rad": 0, "vx_mps": 8, "vy_mps": 0}"#;
        let step = |number: u64| -> StepBody {
            serde_json::from_str(&format!(r#"{{"number": {number}, "egos": [{ego}]}}"#)).unwrap()
        };
        for wrong in [0, 2] {
            let problem = step(wrong).step(&mut run, &generator, &none).unwrap_err();
            assert_eq!(problem.code, Code::StepOrder);
        }
        let made = step(1).step(&mut run, &generator, &none).unwrap();
        assert_eq!((made.number, made.states.len(), made.time_s), (1, 2, 0.2));
        let text = STANDARD.encode(run.snapshot());
        let again = body(&format!(r#"{{"snapshot": "{text}"}}"#)).begin(&scene, &generator, &none).unwrap();
        assert!(again.snapshot() == run.snapshot());
    }

    #[test]
    fn faults_are_found_with_their_places() {
        let (scene, generator) = (street(), Generator::random(1).unwrap());
        let refused = |text: &str| {
            let problem = body(text).begin(&scene, &generator, &Cancel::default()).unwrap_err();
            let first = problem.members.errors.unwrap().remove(0);
            (problem.code, first.pointer)
        };
        let at = |code, pointer: &str| (code, pointer.to_owned());
        assert_eq!(refused(r#"{"egos": ["9"]}"#), at(Code::UnknownAgent, "/egos"));
        assert_eq!(refused(r#"{"egos": ["1", "1"]}"#), at(Code::InvalidField, "/egos"));
        assert_eq!(refused(r#"{"step_s": 0.01}"#), at(Code::OutOfRange, "/step_s"));
        assert_eq!(refused(r#"{"plan_interval_s": 60}"#), at(Code::OutOfRange, "/plan_interval_s"));
        assert_eq!(refused(r#"{"start_s": 90}"#), at(Code::OutOfRange, "/start_s"));
        assert_eq!(refused(r#"{"snapshot": "AAAA"}"#), at(Code::InvalidField, "/snapshot"));
        assert_eq!(refused(r#"{"snapshot": "?"}"#), at(Code::InvalidField, "/snapshot"));
        assert_eq!(refused(r#"{"snapshot": "", "seed": 1}"#), at(Code::InvalidField, "/seed"));
    }
}
