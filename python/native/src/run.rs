//! Runs: stepped traffic around road users that Python drives.

use crate::calls::{ProcessEngine, cancellable, raised, reply, request};
use crate::scene::NativeScene;
use api::runs::{PeekReply, RunBody, StepReply};
use api::{Operations, Problem};
use experts::run::{EgoState, RunStep};
use experts::{Cancel, Run, RunError};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;
use scene::State;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Numbers of a state: x, y, heading, and velocity in x and y.
const COLUMNS: usize = 5;

/// Result of a step: its number, the time at its end, the ids of the present road users, their states, and
/// the rest as JSON if there is any.
type Stepped<'py> = (u64, f64, Vec<String>, Bound<'py, PyArray2<f64>>, Option<Bound<'py, PyBytes>>);

/// Ids of the egos, one row of a state for each, and the plan that each announces: no rows for no plan.
type SaidEgos<'py> = (Vec<String>, PyReadonlyArray2<'py, f64>, Vec<PyReadonlyArray2<'py, f64>>);

/// Ids of the other road users, the states of each, and the rest as JSON.
type Peeked<'py> = (Vec<String>, Vec<Bound<'py, PyArray2<f64>>>, Bound<'py, PyBytes>);

/// A run at one moment.
#[pyclass(name = "Run", module = "dragtraffic._native")]
pub struct NativeRun {
    run: Run,
}

#[pymethods]
impl NativeRun {
    /// Begins a run with the settings of `POST /v1/runs`.
    #[staticmethod]
    fn begin(py: Python<'_>, scene: &NativeScene, settings: &[u8]) -> PyResult<Self> {
        let body: RunBody = request(py, settings)?;
        let run = cancellable(py, |operations, cancel| operations.begin_run(&body, &scene.scene, cancel))?;
        Ok(Self { run })
    }

    /// The run of a snapshot.
    #[staticmethod]
    fn restore(py: Python<'_>, scene: &NativeScene, snapshot: &[u8]) -> PyResult<Self> {
        let restored = Run::restore(Arc::clone(&scene.scene), snapshot);
        restored.map(|run| Self { run }).map_err(|error| raised(py, Problem::from(error)))
    }

    /// The run as bytes, without its scene.
    fn snapshot<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.run.snapshot())
    }

    /// The same run, which goes its own way from here.
    fn branch(&self) -> Self {
        Self { run: self.run.clone() }
    }

    #[getter]
    fn egos(&self) -> Vec<&str> {
        self.run.egos().into_iter().map(String::as_str).collect()
    }

    #[getter]
    fn step_s(&self) -> f64 {
        f64::from(self.run.settings().step_ms) / 1e3
    }

    /// The present as a step.
    fn present<'py>(&self, py: Python<'py>) -> PyResult<Stepped<'py>> {
        stepped(py, self.run.present())
    }

    /// One step; `rows` of x, y, heading and velocity are the egos' states at its end. `plans` are the states
    /// that each ego announces, 0.1 s apart; an ego with zero rows announces none.
    #[allow(clippy::needless_pass_by_value, reason = "what Python passes is owned")]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        ids: Vec<String>,
        states: PyReadonlyArray2<'py, f64>,
        plans: Vec<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Stepped<'py>> {
        let egos = egos((ids, states, plans))?;
        let (engine, run) = (ProcessEngine::here()?, &mut self.run);
        let none = Cancel::default();
        let step = py.detach(|| engine.run(|operations| run.step(&operations.generator, &egos, &none)));
        stepped(py, step.map_err(|error| raised(py, Problem::from(error)))?)
    }

    /// One step of each of several runs, on several threads, with the arguments of [`step`](Self::step). All
    /// runs are stepped or, if one is refused, none.
    #[staticmethod]
    #[allow(clippy::needless_pass_by_value, reason = "what Python passes is owned")]
    fn step_together<'py>(
        py: Python<'py>,
        runs: Vec<Bound<'py, Self>>,
        said: Vec<SaidEgos<'py>>,
    ) -> PyResult<Vec<Stepped<'py>>> {
        if runs.len() != said.len() {
            return Err(PyValueError::new_err("egos for each run expected"));
        }
        let held: Result<Vec<_>, _> = runs.iter().map(Bound::try_borrow_mut).collect();
        let mut held = held.map_err(|_| PyValueError::new_err("each run once expected"))?;
        let all = said.into_iter().map(egos).collect::<PyResult<Vec<_>>>()?;
        let works: Vec<(&Run, Vec<EgoState>)> = held.iter().map(|own| &own.run).zip(all).collect();
        let engine = ProcessEngine::here()?;
        let step = |operations: &Operations, (run, egos): (&Run, Vec<EgoState>)| {
            let mut next = run.clone();
            let step = next.step(&operations.generator, &egos, &Cancel::default())?;
            Ok::<_, RunError>((next, step))
        };
        let made: Result<Vec<_>, _> = py.detach(|| {
            engine.run(|operations| works.into_par_iter().map(|work| step(operations, work)).collect())
        });
        let made = made.map_err(|error| raised(py, Problem::from(error)))?;
        let mut steps = Vec::with_capacity(made.len());
        for (own, (next, step)) in held.iter_mut().zip(made) {
            own.run = next;
            steps.push(stepped(py, step)?);
        }
        Ok(steps)
    }

    /// What the other road users would do if the egos drove these plans.
    #[allow(clippy::needless_pass_by_value, reason = "what Python passes is owned")]
    fn peek<'py>(
        &self,
        py: Python<'py>,
        ids: Vec<String>,
        plans: Vec<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Peeked<'py>> {
        let mut motions = BTreeMap::new();
        for (id, plan) in ids.into_iter().zip(&plans) {
            motions.insert(id, rows(plan)?);
        }
        let (engine, none) = (ProcessEngine::here()?, Cancel::default());
        let peek =
            py.detach(|| engine.run(|operations| self.run.peek(&operations.generator, &motions, &none)));
        let mut peek = peek.map_err(|error| raised(py, Problem::from(error)))?;
        let (mut others, mut futures) = (Vec::new(), Vec::new());
        for (id, states) in std::mem::take(&mut peek.futures) {
            others.push(id);
            futures.push(table(py, states.iter())?);
        }
        Ok((others, futures, reply(py, &PeekReply::of(&self.run, &peek))?))
    }
}

fn egos((ids, states, plans): SaidEgos<'_>) -> PyResult<Vec<EgoState>> {
    let states = rows(&states)?;
    if states.len() != ids.len() || plans.len() != ids.len() {
        return Err(PyValueError::new_err("one row of states and one plan for each ego expected"));
    }
    let all = ids.into_iter().zip(states).zip(&plans);
    all.map(|((id, state), plan)| Ok(EgoState { id, state, plan: rows(plan)? })).collect()
}

fn stepped(py: Python<'_>, mut step: RunStep) -> PyResult<Stepped<'_>> {
    let (ids, states): (Vec<String>, Vec<State>) = std::mem::take(&mut step.states).into_iter().unzip();
    let quiet =
        step.changes.is_empty() && step.faults.is_empty() && step.entered.is_empty() && step.left.is_empty();
    let rest = if quiet { None } else { Some(reply(py, &StepReply::from(&step))?) };
    Ok((step.number, step.time_s, ids, table(py, states.iter())?, rest))
}

/// States as an array, one row each.
fn table<'py, 's>(
    py: Python<'py>,
    states: impl ExactSizeIterator<Item = &'s State>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = states.len();
    let numbers = states.flat_map(|s| [s.x_m, s.y_m, s.heading_rad, s.vx_mps, s.vy_mps]);
    PyArray1::from_iter(py, numbers).reshape([count, COLUMNS])
}

/// The states in an array, one row each.
fn rows(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<State>> {
    let array = array.as_array();
    if array.ncols() != COLUMNS && array.nrows() > 0 {
        return Err(PyValueError::new_err(format!(
            "a state is x_m, y_m, heading_rad, vx_mps, vy_mps; these have {} numbers",
            array.ncols()
        )));
    }
    let state = |row: numpy::ndarray::ArrayView1<'_, f64>| State {
        x_m: row[0],
        y_m: row[1],
        heading_rad: row[2],
        vx_mps: row[3],
        vy_mps: row[4],
    };
    Ok(array.rows().into_iter().map(state).collect())
}
