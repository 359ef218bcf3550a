//! The program in the process of Python: `python -m dragtraffic` and the command `dragtraffic` of the wheel.

use pyo3::prelude::*;

/// Runs the command line and returns its exit code.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what Python passes is owned")]
pub fn main(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| dragtraffic::run(arguments.into_iter().map(Into::into)))
}

/// Version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
