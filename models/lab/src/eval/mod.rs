//! Judging the experts on scenes: goals met, errors against the log, latency, pictures.

mod cases;
mod errors;
pub mod latency;
pub mod picture;
mod reach;

pub use cases::{Case, Subset, cases};
pub use errors::{ErrorRow, ErrorTable, errors};
pub use reach::{Missed, ReachTable, reach};

use experts::{Answer, Cancel, Event, GenerateError, Generator, Request};

/// Runs a call to its end.
///
/// # Errors
/// What the call reports.
pub fn answer(generator: &Generator, request: Request) -> Result<Answer, GenerateError> {
    for event in generator.start(request, Cancel::default())? {
        if let Event::Final(answer) = event? {
            return Ok(answer);
        }
    }
    Err(GenerateError::Expert("the call ended without an answer".into()))
}
