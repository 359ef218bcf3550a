//! A run as bytes. Equal runs give equal bytes, and a restored run continues exactly like the saved one.
//!
//! The format: a head (eight bytes, the last is the version), the SHA-256 of the scene's map, signals and
//! road users, then numbers in little-endian order. The scene itself is not included.

use super::agents::{DrivenPlan, EgoMotion, LOOKED_AT, NEVER_PLANNED, Presence, RunAgent};
use super::error::{RunError, SnapshotError};
use super::settings::{MOST_ANNOUNCED, MOST_RUN_MS, RunSettings, is_state};
use super::state::{Run, identity, with_goal_times};
use scene::{MAX_STEPS, MAX_VIAS, Scene, State};
use std::sync::Arc;

/// The last byte is the version of the format.
const HEAD: [u8; 8] = *b"DT-RUN\0\x01";
/// Offset of the version byte in a snapshot.
pub const VERSION_AT: usize = 7;
/// More states than any plan has.
const MOST_STATES: usize = LOOKED_AT + MAX_STEPS;

impl Run {
    /// The run as bytes, without its scene.
    pub fn snapshot(&self) -> Vec<u8> {
        let mut out = SnapshotWriter(Vec::with_capacity(64 + self.bytes()));
        out.0.extend(HEAD);
        out.0.extend(self.identity.bytes());
        let RunSettings { seed, step_ms, plan_interval_ms, start_step, refinement } = self.settings;
        for number in [seed, step_ms.into(), plan_interval_ms.into(), start_step as u64, refinement as u64] {
            out.number(number);
        }
        out.number(self.number);
        out.number(self.elapsed_ms);
        for own in &self.agents {
            out.number(own.vias_passed as u64);
            match &own.presence {
                Presence::Coming => out.number(0),
                Presence::Gone => out.number(1),
                Presence::Driven(plan) => {
                    out.number(2);
                    out.number(plan.from_ms);
                    out.number(plan.planned_ms as u64);
                    out.states(&plan.states);
                }
                Presence::Ego(motion) => {
                    out.number(3);
                    out.number(motion.brakes_mps2.to_bits());
                    out.state(&motion.state);
                    out.states(&motion.plan);
                }
            }
        }
        out.0
    }

    /// Restores a run of this scene from its bytes.
    ///
    /// # Errors
    /// Bytes that are not a snapshot, of another version or scene, cut off, or with impossible values; the
    /// error names the byte.
    pub fn restore(scene: Arc<Scene>, bytes: &[u8]) -> Result<Self, RunError> {
        let identity = identity(&scene);
        let mut read = SnapshotReader { bytes, at: 0 };
        let head: [u8; 8] = read.take().map_err(|_| SnapshotError::NoSnapshot)?;
        if head[..VERSION_AT] != HEAD[..VERSION_AT] {
            return Err(SnapshotError::NoSnapshot.into());
        }
        if head[VERSION_AT] != HEAD[VERSION_AT] {
            return Err(SnapshotError::Version(head[VERSION_AT]).into());
        }
        if read.take::<32>()? != *identity.bytes() {
            return Err(SnapshotError::OtherScene.into());
        }
        let settings = RunSettings {
            seed: read.number()?,
            step_ms: read.below(u64::from(u32::MAX), "a length of a step")? as u32,
            plan_interval_ms: read.below(u64::from(u32::MAX), "an interval")? as u32,
            start_step: read.below(MAX_STEPS as u64, "a start")? as usize,
            refinement: read.below(101, "a number of refinement steps")? as usize,
        };
        settings.check()?;
        let (number, at) = (read.number()?, read.at);
        let elapsed_ms = read.below(MOST_RUN_MS + 1, "a time")?;
        if number.checked_mul(settings.step_ms.into()) != Some(elapsed_ms) {
            return Err(SnapshotError::Value { at, what: "a time" }.into());
        }
        let agents = scene.agents.iter().map(|_| read.agent(elapsed_ms)).collect::<Result<_, _>>()?;
        if read.at < bytes.len() {
            return Err(SnapshotError::GoesOn(read.at).into());
        }
        let scene = with_goal_times(scene, settings.start_step);
        Ok(Self { scene, identity, settings, number, elapsed_ms, agents })
    }
}

struct SnapshotWriter(Vec<u8>);

impl SnapshotWriter {
    fn number(&mut self, number: u64) {
        self.0.extend(number.to_le_bytes());
    }

    fn state(&mut self, state: &State) {
        let State { x_m, y_m, heading_rad, vx_mps, vy_mps } = *state;
        [x_m, y_m, heading_rad, vx_mps, vy_mps].into_iter().for_each(|value| self.number(value.to_bits()));
    }

    fn states(&mut self, states: &[State]) {
        self.number(states.len() as u64);
        states.iter().for_each(|state| self.state(state));
    }
}

struct SnapshotReader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl SnapshotReader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], SnapshotError> {
        let part = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk());
        let part = part.ok_or(SnapshotError::Ends(self.bytes.len()))?;
        self.at += N;
        Ok(*part)
    }

    fn number(&mut self) -> Result<u64, SnapshotError> {
        Ok(u64::from_le_bytes(self.take()?))
    }

    fn below(&mut self, end: u64, what: &'static str) -> Result<u64, SnapshotError> {
        let at = self.at;
        let number = self.number()?;
        if number < end { Ok(number) } else { Err(SnapshotError::Value { at, what }) }
    }

    fn state(&mut self) -> Result<State, SnapshotError> {
        let at = self.at;
        let mut value = || self.number().map(f64::from_bits);
        let (x_m, y_m, heading_rad) = (value()?, value()?, value()?);
        let state = State { x_m, y_m, heading_rad, vx_mps: value()?, vy_mps: value()? };
        if is_state(&state) { Ok(state) } else { Err(SnapshotError::Value { at, what: "a state" }) }
    }

    fn states(&mut self, least: usize, most: usize) -> Result<Vec<State>, SnapshotError> {
        let at = self.at;
        let count = self.below(most as u64 + 1, "a number of states")? as usize;
        if count < least {
            return Err(SnapshotError::Value { at, what: "a number of states" });
        }
        // No memory is reserved for states that may be missing.
        (0..count).map(|_| self.state()).collect()
    }

    fn agent(&mut self, elapsed_ms: u64) -> Result<RunAgent, SnapshotError> {
        let vias_passed = self.below(MAX_VIAS as u64 + 1, "a number of via points")? as usize;
        let presence = match self.below(4, "a presence")? {
            0 => Presence::Coming,
            1 => Presence::Gone,
            2 => {
                let from_ms = self.below(elapsed_ms + 1, "a time")?;
                let at = self.at;
                let planned_ms = self.number()? as i64;
                if planned_ms != NEVER_PLANNED && planned_ms.unsigned_abs() > MOST_RUN_MS {
                    return Err(SnapshotError::Value { at, what: "a time" });
                }
                Presence::Driven(DrivenPlan { from_ms, planned_ms, states: self.states(1, MOST_STATES)? })
            }
            _ => {
                let at = self.at;
                let brakes_mps2 = f64::from_bits(self.number()?);
                if !(0.0..=1e5).contains(&brakes_mps2) {
                    return Err(SnapshotError::Value { at, what: "a braking" });
                }
                Presence::Ego(EgoMotion {
                    brakes_mps2,
                    state: self.state()?,
                    plan: self.states(0, MOST_ANNOUNCED)?,
                })
            }
        };
        Ok(RunAgent { presence, vias_passed })
    }
}
