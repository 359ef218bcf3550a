//! A run: stepped traffic around road users that the caller drives.
//!
//! The caller drives some road users, the *egos*: at each step it gives their states, and it may announce
//! their plans. The run drives all others. They know the past and what egos announce, and nothing else. Each
//! follows a plan of nine seconds and replans at an interval. In between, when a changed motion of another
//! would meet its own, it reacts at once by changing its pace on its path.
//!
//! A run is a value: it has no thread, clock or file. Its state is a [snapshot](Run::snapshot) of bytes.
//!
//! ```
//! use experts::{Cancel, EgoState, Engine, Run, RunSettings};
//! use scene::map::{Lane, LaneMap};
//! use scene::{Agent, AgentType, Scene, State, Subtype, Vec2};
//!
//! // Two cars on a straight lane; the caller drives the front one.
//! let lane = Lane::street("east", vec![Vec2::new(0.0, 0.0), Vec2::new(400.0, 0.0)]);
//! let at = |x_m: f64| State { x_m, vx_mps: 10.0, ..State::default() };
//! let car = |id: &str, x_m: f64| Agent::bare(id, AgentType::Vehicle, Subtype::Car, vec![Some(at(x_m))]);
//! let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
//! let scene = Scene::bare("two cars", map, vec![car("mine", 60.0), car("theirs", 30.0)]);
//!
//! let engine = Engine::built_in()?.generator;
//! let egos = ["mine".to_owned()];
//! let mut run = Run::new(scene.into(), &egos, RunSettings::default(), &engine, &Cancel::default())?;
//! // "mine" brakes at 4 m/s2 and announces nothing.
//! for i in 1..=20 {
//!     let t = 0.1 * f64::from(i);
//!     let mine = State { x_m: 60.0 + 10.0 * t - 2.0 * t * t, vx_mps: 10.0 - 4.0 * t, ..State::default() };
//!     let step = run.step(&engine, &[EgoState::new("mine", mine)], &Cancel::default())?;
//!     assert!(step.faults.is_empty());
//! }
//! assert!(run.state("theirs").unwrap().speed_mps() < 9.0, "it brakes too");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod agents;
mod borders;
mod calls;
mod contacts;
mod error;
mod moment;
mod settings;
mod snapshot;
mod state;
mod stepping;

pub use borders::DepartureReason;
pub use contacts::RunFault;
pub use error::{RunError, SnapshotError};
pub use settings::{EgoState, MOST_ANNOUNCED, MOST_RUN_MS, PLAN_INTERVAL_MS, RUN_STEP_MS, RunSettings};
pub use snapshot::VERSION_AT;
pub use state::{Run, RunChange, RunDeparture, RunPeek, RunStep};
