//! What every handler can reach, and the table of routes.

use crate::base::limits::Limits;
use crate::base::problem::Problem;
use crate::http::embed;
use crate::http::guard::Guard;
use crate::http::observe;
use crate::routes;
use crate::scenes::catalog::MapCache;
use crate::scenes::library::Library;
use crate::scenes::store::Store;
use crate::work::Pool;
use axum::Router;
use axum::response::{IntoResponse, Response};
use experts::Generator;
use metrics_exporter_prometheus::PrometheusHandle;
use std::any::Any;
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
    pub guard: Guard,
    /// Saved scenes.
    pub store: Store,
    /// Read-only scenes.
    pub library: Library,
    /// Maps in memory.
    pub maps: MapCache,
    /// Generations.
    pub pool: Arc<Pool>,
    /// Experts.
    pub generator: Arc<Generator>,
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

/// All routes with their layers.
pub fn router(app: &App) -> Router {
    let (router, _) = routes::all().split_for_parts();
    router
        .merge(routes::pages())
        .fallback(embed::fallback)
        // Bodies are bounded by `body`, with limits of their own.
        .layer(axum::extract::DefaultBodyLimit::disable())
        .layer(tower_http::catch_panic::CatchPanicLayer::custom(panicked))
        .layer(axum::middleware::from_fn_with_state(app.clone(), observe::observe))
        .with_state(app.clone())
}

fn panicked(cause: Box<dyn Any + Send>) -> Response {
    let text = cause.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("no message");
    Problem::internal(format!("panic: {text}")).into_response()
}
