//! The scenes that the sender of a request may see.

use crate::app::App;
use crate::http::idempotency::Sender;
use crate::scenes::Catalog;
use api::Problem;
use axum::extract::FromRequestParts;
use axum::http::Extensions;
use axum::http::request::Parts;
use base::problem::Refusal;

/// Scenes and maps that one request may use.
pub struct OwnCatalog(pub Catalog);

impl FromRequestParts<App> for OwnCatalog {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, app: &App) -> Result<Self, Refusal> {
        Ok(Self(own_catalog(app, &parts.extensions)?))
    }
}

/// The same for handlers that take a whole request.
///
/// # Errors
/// A defect: a request without a sender.
pub fn own_catalog(app: &App, extensions: &Extensions) -> Result<Catalog, Problem> {
    let sender = extensions.get::<Sender>().ok_or_else(|| Problem::internal("a request without a sender"))?;
    Ok(app.catalog_of(sender))
}
