//! Shared state of all handlers.

use crate::generation::LaneOperations;
use crate::http::body::{Reading, Room};
use crate::http::idempotency::Sender;
use crate::http::observe::RequestGate;
use crate::runs::RunStore;
use crate::scenes::store::Viewer;
use crate::scenes::{Catalog, length};
use api::{Operations, Problem};
use axum::extract::FromRef;
use base::limits::Limits;
use metrics_exporter_prometheus::PrometheusHandle;
use scene::{LaneMap, Shared};
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;
use work::Pool;

/// Shared state. Cheap to clone.
#[derive(Clone)]
pub struct App(Arc<AppParts>);

/// Parts of [`App`].
pub struct AppParts {
    /// Limits.
    pub limits: Arc<Limits>,
    /// Access rules of the server.
    pub gate: RequestGate,
    /// Scenes and maps, in all their sources; handlers use [`Self::catalog_of`].
    pub catalog: Catalog,
    /// Whether users own their scenes.
    pub owners: bool,
    /// Memory budget of bodies.
    pub room: Arc<Room>,
    /// The pool for all CPU work.
    pub pool: Arc<Pool>,
    /// The operations for interactive calls.
    pub operations: Operations,
    /// The same for long calls: they leave one core to the others.
    pub patient: Operations,
    /// Runs in progress.
    pub runs: RunStore,
    /// Whether the experts are warmed up.
    pub warm: AtomicBool,
    /// Counters.
    pub metrics: PrometheusHandle,
    /// Whether imports whose licence allows only non-commercial use are refused.
    pub refuse_nc: bool,
}

impl App {
    /// Wraps the state.
    pub fn new(inside: AppParts) -> Self {
        Self(Arc::new(inside))
    }

    /// The scenes that the sender of a request may see.
    pub fn catalog_of(&self, sender: &Sender) -> Catalog {
        let viewer =
            if self.owners { Viewer::user(sender.name.clone(), sender.is_admin) } else { Viewer::default() };
        self.catalog.of(sender.party, viewer)
    }

    /// Expected time to prepare the map of a call; zero for a known map.
    ///
    /// # Errors
    /// A full queue.
    pub async fn map_preparation(&self, map: &Shared<LaneMap>) -> Result<Duration, Problem> {
        let (generator, map) = (Arc::clone(&self.operations.generator), map.clone());
        self.pool.document(length::of_map(&map), move || Ok(generator.maps().cost(&map).preparation)).await
    }

    /// The operations by lane of the pool.
    pub fn lanes(&self) -> LaneOperations<'_> {
        LaneOperations { quick: &self.operations, patient: &self.patient }
    }
}

impl Deref for App {
    type Target = AppParts;

    fn deref(&self) -> &AppParts {
        &self.0
    }
}

impl FromRef<App> for RequestGate {
    fn from_ref(app: &App) -> Self {
        app.gate.clone()
    }
}

impl FromRef<App> for Reading {
    fn from_ref(app: &App) -> Self {
        let (limits, pool) = (Arc::clone(&app.limits), Arc::clone(&app.pool));
        Self { limits, pool, room: Arc::clone(&app.room) }
    }
}
