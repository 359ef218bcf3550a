//! The routes, one file per resource.

#[macro_use]
mod refusals;

pub mod docs;
pub mod export;
pub mod generate;
pub mod health;
pub mod import;
pub mod info;
pub mod jobs;
pub mod layouts;
pub mod maps;
pub mod openapi;
mod own;
pub mod place;
pub mod runs;
mod scene_ref;
pub mod scenes;
mod schemas;
pub mod score;
pub mod search;

use crate::app::App;
use crate::http::guard::Guard;
use crate::http::idempotency::{self, Replies};
use crate::http::observe::RequestGate;
use crate::http::{below, embed, long_replies, observe};
use api::Problem;
use axum::Router;
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::get;
use base::base_path;
use base::problem::Refusal;
use std::any::Any;
use std::sync::Arc;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Every documented route: what is served here is described in the OpenAPI document.
fn documented() -> OpenApiRouter<App> {
    OpenApiRouter::with_openapi(openapi::head())
        .routes(routes!(scenes::list::list, scenes::write::create))
        .routes(routes!(
            scenes::read::read,
            scenes::write::replace,
            scenes::write::rename,
            scenes::write::remove
        ))
        .routes(routes!(scenes::read::preview_of))
        .routes(routes!(scenes::copy::duplicate))
        .routes(routes!(export::stored))
        .routes(routes!(export::unsaved))
        .routes(routes!(import::import))
        .routes(routes!(maps::list))
        .routes(routes!(maps::read))
        .routes(routes!(layouts::make))
        .routes(routes!(layouts::templates))
        .routes(routes!(generate::generate, generate::line))
        .routes(routes!(jobs::cancel))
        .routes(routes!(runs::begin))
        .routes(routes!(runs::step, runs::line))
        .routes(routes!(runs::peek))
        .routes(routes!(runs::snapshot))
        .routes(routes!(runs::read, runs::remove))
        .routes(routes!(runs::scene))
        .routes(routes!(place::place))
        .routes(routes!(score::score))
        .routes(routes!(search::search))
        .routes(routes!(info::info))
        .routes(routes!(health::healthz))
        .routes(routes!(health::readyz))
        .routes(routes!(health::metrics))
}

/// The document itself and its pages.
fn pages() -> Router<App> {
    Router::new()
        .route("/openapi.json", get(docs::document))
        .route("/docs", get(docs::reference))
        .route("/docs/", get(|| async { Redirect::permanent(&base_path::published("/docs")) }))
        .route("/docs/problems", get(docs::problems))
        .route("/docs/style.css", get(docs::style))
}

/// All routes with their layers.
pub fn router(app: &App) -> Router {
    let (router, _) = documented().split_for_parts();
    let router = router
        .merge(pages())
        .fallback(embed::fallback)
        // `http::body` limits bodies, with its own limits.
        .layer(axum::extract::DefaultBodyLimit::disable())
        .layer(tower_http::catch_panic::CatchPanicLayer::custom(panicked))
        .layer(axum::middleware::from_fn_with_state(Arc::clone(&app.room.memory), long_replies::hold))
        .layer(axum::middleware::from_fn_with_state(Replies::default(), idempotency::once))
        .layer(axum::middleware::from_fn_with_state(app.gate.clone(), observe::observe))
        .with_state(app.clone());
    below::below(router)
}

/// Routes for probes, without token.
pub fn probes(app: &App) -> Router {
    let (guard, limits) = (Guard::for_probes().into(), Arc::clone(&app.limits));
    let rates = Arc::clone(&app.gate.rates);
    let gate = RequestGate { guard, limits, rates, audit: None, sample: Arc::default() };
    let (router, _) = OpenApiRouter::new()
        .routes(routes!(health::healthz))
        .routes(routes!(health::readyz))
        .routes(routes!(health::metrics))
        .split_for_parts();
    router.layer(axum::middleware::from_fn_with_state(gate, observe::observe)).with_state(app.clone())
}

fn panicked(cause: Box<dyn Any + Send>) -> Response {
    let text = cause.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("no message");
    Refusal::from(Problem::internal(format!("panic: {text}"))).into_response()
}
