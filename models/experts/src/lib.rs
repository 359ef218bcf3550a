//! Scene and conditions to futures: features, the three experts behind their gate, refinement,
//! projection and choice. Map to road users: placement.

pub mod features;
pub mod generator;
pub mod net;
pub mod placement;
pub mod request;

pub use features::world::Planning;
pub use generator::{Generation, Generator, WeightsError, WeightsInfo};
pub use request::{
    Accepted, Answer, Cancel, Draft, Event, Field, GenerateError, Intermediate, Limiting, NearestState,
    ReachReport, React, Refining, Request, Resolved, ResolvedGoal, ResolvedStart, Shown, Source, Stages,
    Timings, Warning, WarningCode,
};
