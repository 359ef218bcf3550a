//! Files of the traffic simulator SUMO: road networks (`net.xml`), floating-car data (FCD) and recorded
//! signal states. The program itself is never linked.
//!
//! [`formats`] has the two formats for users, `folder` both of them in one zip; they accept any bytes. The
//! other modules also serve `synthesize`, which trusts the output of SUMO.

pub mod fcd;
pub(crate) mod folder;
pub mod formats;
mod import_fcd;
pub(crate) mod import_net;
pub mod kerb;
mod kinds;
pub mod map;
pub mod medians;
mod narrow;
pub mod net;
mod out;
mod paint;
pub mod programs;
mod rows;
pub mod signals;
mod window;

use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{found_expected, quoted};
use crate::xml::Missing;
use scene::message::{Message, Placeholder, Word};

/// Why a SUMO file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum SumoError {
    /// Not well-formed XML (a document type definition is refused too), broken gzip, or an exceeded limit.
    #[error("{0}")]
    File(#[from] ReadError),
    /// A required attribute is missing.
    #[error("{0}")]
    Missing(#[from] Missing),
    /// An attribute or a field is not a number or not a list of points.
    #[error("{0}")]
    Value(Message),
    /// The file has other content.
    #[error("{0}")]
    Content(Message),
}

impl SumoError {
    fn value(found: &str, wanted: Word, line: u32) -> Self {
        Self::Value(found_expected(quoted(found), wanted).at_line(line))
    }

    fn content(found: impl Placeholder, wanted: Word) -> Self {
        Self::Content(found_expected(found, wanted))
    }
}

impl From<SumoError> for ReadError {
    fn from(error: SumoError) -> Self {
        match error {
            SumoError::File(error) => error,
            SumoError::Missing(missing) => missing.into(),
            SumoError::Value(message) => FieldProblem::new("", code::INVALID_FIELD, message).into(),
            SumoError::Content(message) => Self::other_content(message),
        }
    }
}
