//! The extension module `dragtraffic._native`: the operations of `dragtraffic-api` in the process of Python.
//!
//! It is a carrier as HTTP and the command line are. Documents, requests and replies are JSON bytes; states are arrays
//! of numpy. The package `dragtraffic` around it gives them names and types.

mod calls;
mod program;
mod run;
mod scene;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::program::{main, version};
    #[pymodule_export]
    use super::run::NativeRun;
    #[pymodule_export]
    use super::scene::NativeScene;
}
