//! Scene and conditions to futures: features, the three experts behind their gate, refinement,
//! projection and choice. Map to road users: placement.

mod clock;
mod engine;
pub mod features;
pub mod generator;
mod maps;
pub mod net;
pub mod placement;
pub mod planning;
pub mod request;
pub mod tuning;
pub mod weights;

pub use clock::Clock;
pub use engine::Engine;
pub use generator::{Generation, Generator};
pub use maps::Maps;
pub use placement::Placer;
pub use planning::world::Planning;
pub use request::{
    Accepted, Answer, Cancel, Draft, Event, Field, GenerateError, Intermediate, Limiting, NearestState,
    ReachReport, React, Refining, Request, Resolved, ResolvedGoal, ResolvedStart, Shown, Source, Stages,
    Timings, Warning, WarningCode,
};
pub use tuning::Tuning;
pub use weights::{WeightsError, WeightsInfo};
