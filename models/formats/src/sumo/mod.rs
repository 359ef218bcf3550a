//! Files of the traffic simulator SUMO: road networks (`net.xml`), floating-car data (FCD) and recorded
//! signal states. The program itself is never linked.
//!
//! [`formats`] has the two formats that users know, `folder` both of them in one zip; they take any bytes. The other modules serve
//! `synthesize` too, which trusts what SUMO has just written.

pub mod fcd;
pub(crate) mod folder;
pub mod formats;
mod import_fcd;
pub(crate) mod import_net;
pub mod kerb;
mod kinds;
pub mod map;
pub mod medians;
pub mod net;
mod out;
mod paint;
pub mod programs;
mod rows;
pub mod signals;
mod window;

use crate::problem::{FieldProblem, ReadError, code};
use crate::xml::Missing;

/// Why a SUMO file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum SumoError {
    /// Not well-formed XML (a document type definition is refused too), broken gzip, or a bound that was met.
    #[error("{0}")]
    File(#[from] ReadError),
    /// A required attribute is not there.
    #[error("{0}")]
    Missing(#[from] Missing),
    /// An attribute or a field is no number or no list of points.
    #[error("line {line}: \"{found}\" found where {expected} was expected")]
    Value {
        /// Value found, shortened.
        found: String,
        /// Value expected.
        expected: &'static str,
        /// Line in the file, from 1.
        line: u32,
    },
    /// The file holds something else.
    #[error("expected {expected}, found {found}")]
    Content {
        /// Content expected.
        expected: &'static str,
        /// Content found.
        found: String,
    },
}

impl SumoError {
    fn value(found: &str, expected: &'static str, line: u32) -> Self {
        Self::Value { found: found.chars().take(40).collect(), expected, line }
    }
}

impl From<SumoError> for ReadError {
    fn from(error: SumoError) -> Self {
        let detail = error.to_string();
        match error {
            SumoError::File(error) => error,
            SumoError::Missing(missing) => missing.into(),
            SumoError::Value { .. } => FieldProblem::new("", code::INVALID_FIELD, detail).into(),
            SumoError::Content { .. } => FieldProblem::new("", code::CANNOT_REPRESENT, detail).into(),
        }
    }
}
