//! What every handler can reach.

use crate::base::limits::Limits;
use crate::http::body::Reading;
use crate::http::observe::Gate;
use crate::scenes::Catalog;
use crate::work::Pool;
use axum::extract::FromRef;
use experts::{Generator, Placer};
use metrics_exporter_prometheus::PrometheusHandle;
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Shared state. Cheap to clone.
#[derive(Clone)]
pub struct App(Arc<Inside>);

/// What [`App`] holds.
pub struct Inside {
    /// Bounds.
    pub limits: Arc<Limits>,
    /// Who may talk to the server.
    pub gate: Gate,
    /// Scenes and maps, wherever they are.
    pub catalog: Catalog,
    /// All CPU work.
    pub pool: Arc<Pool>,
    /// Experts.
    pub generator: Arc<Generator>,
    /// Placement.
    pub placer: Arc<Placer>,
    /// Experts are warm.
    pub warm: AtomicBool,
    /// Counters.
    pub metrics: PrometheusHandle,
    /// Sources for non-commercial use are refused at import.
    pub refuse_nc: bool,
}

impl App {
    /// Wraps the state.
    pub fn new(inside: Inside) -> Self {
        Self(Arc::new(inside))
    }
}

impl Deref for App {
    type Target = Inside;

    fn deref(&self) -> &Inside {
        &self.0
    }
}

impl FromRef<App> for Reading {
    fn from_ref(app: &App) -> Self {
        Self { limits: Arc::clone(&app.limits), pool: Arc::clone(&app.pool) }
    }
}
