//! State that every handler can reach.

use crate::generation::LaneOperations;
use crate::http::body::{Reading, Room};
use crate::http::idempotency::Sender;
use crate::http::observe::RequestGate;
use crate::runs::RunStore;
use crate::scenes::store::Viewer;
use crate::scenes::{Catalog, map_bytes};
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
    /// Bounds.
    pub limits: Arc<Limits>,
    /// Access rules of the server.
    pub gate: RequestGate,
    /// Scenes and maps, wherever they are; handlers take [`Self::catalog_of`].
    pub catalog: Catalog,
    /// Users own their scenes.
    pub owners: bool,
    /// Room for bodies.
    pub room: Arc<Room>,
    /// All CPU work.
    pub pool: Arc<Pool>,
    /// The operations, for calls that people wait for.
    pub operations: Operations,
    /// The same for long calls: they leave a core to the others.
    pub patient: Operations,
    /// Runs that clients step.
    pub runs: RunStore,
    /// Experts are warm.
    pub warm: AtomicBool,
    /// Counters.
    pub metrics: PrometheusHandle,
    /// Sources for non-commercial use are refused at import.
    pub refuse_nc: bool,
}

impl App {
    /// Wraps the state.
    pub fn new(inside: AppParts) -> Self {
        Self(Arc::new(inside))
    }

    /// Scenes as the sender of a request may see them.
    pub fn catalog_of(&self, sender: &Sender) -> Catalog {
        let viewer =
            if self.owners { Viewer::user(sender.name.clone(), sender.is_admin) } else { Viewer::default() };
        self.catalog.of(sender.party, viewer)
    }

    /// Expected time to work out a map that a call needs; zero for a known one.
    ///
    /// # Errors
    /// A full queue.
    pub async fn map_preparation(&self, map: &Shared<LaneMap>) -> Result<Duration, Problem> {
        let (generator, map) = (Arc::clone(&self.operations.generator), map.clone());
        self.pool.document(map_bytes(&map), move || Ok(generator.maps().cost(&map).preparation)).await
    }

    /// The operations by the lane of a call.
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
