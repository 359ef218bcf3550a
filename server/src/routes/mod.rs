//! The URL tree: one file a resource.

pub mod docs;
pub mod export;
pub mod generate;
pub mod health;
pub mod import;
pub mod info;
pub mod jobs;
pub mod maps;
pub mod openapi;
pub mod place;
pub mod scenes;
pub mod score;

use crate::app::App;
use crate::base::problem::{Code, Problem};
use axum::Router;
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::HeaderMap;
use axum::http::header::{HeaderName, IF_MATCH, IF_NONE_MATCH};
use axum::http::request::Parts;
use axum::routing::get;
use serde::de::DeserializeOwned;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Every route of the document.
pub fn all() -> OpenApiRouter<App> {
    OpenApiRouter::with_openapi(openapi::head())
        .routes(routes!(scenes::list, scenes::create))
        .routes(routes!(scenes::read, scenes::replace, scenes::rename, scenes::remove))
        .routes(routes!(scenes::duplicate))
        .routes(routes!(export::stored))
        .routes(routes!(export::unsaved))
        .routes(routes!(import::import))
        .routes(routes!(maps::list))
        .routes(routes!(maps::read))
        .routes(routes!(generate::generate))
        .routes(routes!(jobs::cancel))
        .routes(routes!(place::place))
        .routes(routes!(score::score))
        .routes(routes!(info::info))
        .routes(routes!(health::healthz))
        .routes(routes!(health::readyz))
        .routes(routes!(health::metrics))
}

/// The document itself and its pages.
pub fn pages() -> Router<App> {
    Router::new()
        .route("/openapi.json", get(docs::document))
        .route("/docs", get(docs::reference))
        .route("/docs/problems", get(docs::problems))
        .route("/docs/style.css", get(docs::style))
}

/// Ids of scenes and jobs: `[A-Za-z0-9_-]{1,64}`.
pub fn is_id(text: &str) -> bool {
    (1..=64).contains(&text.len()) && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}

/// An id in the path. One that no scene can have is simply not found.
pub struct Id(pub String);

impl<S: Send + Sync> FromRequestParts<S> for Id {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        match Path::<String>::from_request_parts(parts, state).await {
            Ok(Path(id)) if is_id(&id) => Ok(Self(id)),
            _ => Err(Problem::new(Code::NotFound, "Ids are 1 to 64 of A-Z a-z 0-9 _ and -.")),
        }
    }
}

/// Query parameters; unknown or unreadable ones are refused.
pub struct Params<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for Params<T> {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let query = Query::<T>::from_request_parts(parts, state).await;
        query
            .map(|Query(params)| Self(params))
            .map_err(|error| Problem::field("/query", Code::InvalidField, error.body_text()))
    }
}

/// ETags of If-Match, as sent; `None` without the header.
pub fn if_match(headers: &HeaderMap) -> Option<Vec<String>> {
    tags(headers, &IF_MATCH)
}

/// ETags of If-None-Match; `None` without the header.
pub fn if_none_match(headers: &HeaderMap) -> Option<Vec<String>> {
    tags(headers, &IF_NONE_MATCH)
}

fn tags(headers: &HeaderMap, name: &HeaderName) -> Option<Vec<String>> {
    headers.contains_key(name).then(|| {
        let lines = headers.get_all(name).iter().filter_map(|v| v.to_str().ok());
        lines.flat_map(|line| line.split(',')).map(|tag| tag.trim().to_owned()).collect()
    })
}
