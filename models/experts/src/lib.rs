//! Scene and conditions to futures: features, the three experts behind their gate, refinement,
//! projection and choice. Map to road users: placement.
//!
//! ```
//! use experts::{Engine, Request};
//! use scene::map::{Lane, LaneMap};
//! use scene::{Agent, AgentType, Scene, State, Subtype, Vec2};
//!
//! // A straight lane of 200 m, and a car on it at 10 m/s.
//! let lane = Lane::street("east", vec![Vec2::new(0.0, 0.0), Vec2::new(200.0, 0.0)]);
//! let state = State { x_m: 20.0, vx_mps: 10.0, ..State::default() };
//! let mut car = Agent::bare("a", AgentType::Vehicle, Subtype::Car, vec![Some(state)]);
//! car.conditions.goal.position = Some(Vec2::new(110.0, 0.0));
//! let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
//! let scene = Scene::bare("one car", map, vec![car]);
//!
//! let engine = Engine::built_in()?;
//! let answer = engine.generator.answer(Request::new(scene.into()))?;
//! let futures = &answer.samples[0].agents["a"];
//! let end = futures.modes[futures.chosen].states.last().unwrap();
//! assert!((end.x_m - 110.0).abs() < 0.05 && end.y_m.abs() < 0.05, "goals are met exactly");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clock;
mod engine;
pub mod features;
pub mod generator;
mod maps;
pub mod net;
pub mod placement;
pub mod planning;
pub mod request;
pub mod run;
pub mod sentences;
pub mod tuning;
pub mod weights;

pub use clock::Clock;
pub use engine::Engine;
pub use generator::{Generation, Generator};
pub use maps::{MapCost, Maps, preparation};
pub use placement::Placer;
pub use planning::world::Planning;
pub use request::{
    Accepted, Answer, Draft, Event, Field, GenerateError, Intermediate, NearestState, ReachReport, React,
    Refining, Request, Resolved, ResolvedGoal, ResolvedStart, ResolvedVia, Shown, Source, Stages, Timings,
    Warning, WarningCode,
};
pub use run::{EgoState, Run, RunError, RunSettings};
pub use scene::Cancel;
pub use scene::motion::Limiting;
pub use tuning::Tuning;
pub use weights::{WeightsError, WeightsInfo};
