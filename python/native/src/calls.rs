//! The engine of the process, and calls that release the interpreter lock and stop at Ctrl-C.

use api::{Operations, Problem};
use experts::{Cancel, Engine};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyBytes;
use rayon::{ThreadPool, ThreadPoolBuilder};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::PathBuf;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time between two checks for Ctrl-C.
const LOOK: Duration = Duration::from_millis(50);

/// The engine, with the process that created it.
static ENGINE: Mutex<Option<ProcessEngine>> = Mutex::new(None);

/// The operations in one process.
#[derive(Clone)]
pub struct ProcessEngine {
    process: u32,
    operations: Operations,
    /// Threads of calls in a forked process: the shared pool of the thread library lost its threads in the
    /// fork, and would wait for them.
    pool: Option<Arc<ThreadPool>>,
}

impl ProcessEngine {
    /// The engine of this process. A forked process shares the weights.
    ///
    /// # Errors
    /// When weights cannot be read, or a forked process gets no threads.
    pub fn here() -> PyResult<Self> {
        let mut known = ENGINE.lock().unwrap_or_else(PoisonError::into_inner);
        let process = std::process::id();
        let engine = match known.take() {
            Some(engine) if engine.process == process => engine,
            Some(engine) => {
                let threads = std::thread::available_parallelism().map_or(1, usize::from);
                let pool = ThreadPoolBuilder::new().num_threads(threads).build();
                let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
                let operations = engine.operations.beside(threads);
                Self { process, operations, pool: Some(Arc::new(pool)) }
            }
            None => {
                let loaded = match std::env::var_os("DRAGTRAFFIC_WEIGHTS") {
                    Some(folder) => Engine::from_dir(&PathBuf::from(folder)),
                    None => Engine::built_in(),
                };
                let engine = loaded.map_err(|error| PyRuntimeError::new_err(format!("weights: {error}")))?;
                Self { process, operations: Operations::new(engine), pool: None }
            }
        };
        Ok(known.insert(engine).clone())
    }

    /// Runs work on the operations.
    pub fn run<T: Send>(&self, work: impl FnOnce(&Operations) -> T + Send) -> T {
        match &self.pool {
            Some(pool) => pool.install(|| work(&self.operations)),
            None => work(&self.operations),
        }
    }
}

/// Runs work on another thread with the interpreter lock released, so that other Python threads go on. A
/// signal such as Ctrl-C cancels it.
///
/// # Errors
/// A refusal, the exception of the signal, or a defect.
pub fn cancellable<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Operations, &Cancel) -> Result<T, Problem> + Send,
) -> PyResult<T> {
    let engine = ProcessEngine::here()?;
    let outcome = py.detach(|| {
        let cancel = Cancel::default();
        let (done, ended) = channel::<()>();
        std::thread::scope(|scope| {
            let watched = &cancel;
            let working = scope.spawn(move || {
                let outcome = engine.run(|operations| work(operations, watched));
                drop(done);
                outcome
            });
            while ended.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                if let Err(signal) = Python::attach(|py| py.check_signals()) {
                    cancel.cancel();
                    let _ = working.join();
                    return Err(signal);
                }
            }
            Ok(working.join())
        })
    })?;
    match outcome {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(problem)) => Err(raised(py, problem)),
        Err(_) => Err(PyRuntimeError::new_err("a defect of dragtraffic ended the call")),
    }
}

/// A refusal as `dragtraffic.DragTrafficError`.
pub fn raised(py: Python<'_>, problem: Problem) -> PyErr {
    static REFUSAL: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let made = REFUSAL.import(py, "dragtraffic._errors", "refusal").and_then(|refusal| {
        let errors = serde_json::to_string(&problem.members.errors.unwrap_or_default());
        refusal.call1((problem.detail, problem.code.name(), errors.unwrap_or_default()))
    });
    made.map_or_else(|error| error, PyErr::from_value)
}

/// Parses a request from JSON.
pub fn request<T: DeserializeOwned>(py: Python<'_>, bytes: &[u8]) -> PyResult<T> {
    formats::native::from_json(bytes).map_err(|error| raised(py, error.into()))
}

/// A reply as JSON.
pub fn reply<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = serde_json::to_vec(value).map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    Ok(PyBytes::new(py, &bytes))
}
