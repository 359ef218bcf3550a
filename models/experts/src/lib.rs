//! Scene and conditions to futures: features, the three experts behind their gate, refinement,
//! projection and choice. Map to road users: placement.

pub mod features;
pub mod generator;
pub mod net;
pub mod placement;
pub mod planning;
pub mod request;

pub use generator::{Generation, Generator, WeightsError, WeightsInfo};
pub use planning::world::Planning;
pub use request::{
    Accepted, Answer, Cancel, Draft, Event, Field, GenerateError, Intermediate, NearestState, ReachReport,
    React, Refining, Request, Resolved, Shown, Source, Stages, Timings, Warning,
};
