//! The extension module `dragtraffic._native`: the operations of `dragtraffic-api` in the process of Python.
//!
//! It is a transport, as HTTP and the command line are. Documents, requests and replies are JSON bytes;
//! states are numpy arrays. The package `dragtraffic` around it adds names and types.

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
    use super::{Bound, PyModule, PyResult};

    /// The engine's matrix products are small: waking a second thread takes longer than a product. Runs and
    /// calls are spread over threads instead.
    #[pymodule_init]
    fn init(_module: &Bound<'_, PyModule>) -> PyResult<()> {
        gemm::set_threading_threshold(usize::MAX);
        Ok(())
    }
}
