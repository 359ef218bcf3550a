//! Routes of a server that is published below a base path.

use super::guard::PROBES;
use super::{extract, observe};
use api::{Code, Problem};
use axum::Router;
use axum::extract::Request;
use axum::http::Uri;
use axum::http::uri::PathAndQuery;
use axum::response::{IntoResponse, Redirect, Response};
use base::base_path;
use std::time::Instant;

/// The routes below the server's base path; probes work without it too.
pub fn below(router: Router) -> Router {
    if base_path::base().is_empty() {
        return router;
    }
    Router::new().fallback(move |request: Request| serve(router.clone(), request))
}

async fn serve(router: Router, mut request: Request) -> Response {
    let uri = request.uri();
    let path = uri.path();
    if path == base_path::base() {
        let query = uri.query().map(|query| format!("?{query}")).unwrap_or_default();
        return Redirect::permanent(&format!("{path}/{query}")).into_response();
    }
    let Some(inner) = base_path::within(path).or(Some(path).filter(|path| PROBES.contains(path))) else {
        let detail = format!("This server is below {}/.", base_path::base());
        let peer = extract::party_of(request.extensions());
        return observe::unread(Problem::new(Code::NotFound, detail), Instant::now(), peer);
    };
    let target = uri.query().map_or_else(|| inner.to_owned(), |query| format!("{inner}?{query}"));
    let mut parts = uri.clone().into_parts();
    parts.path_and_query = PathAndQuery::try_from(target).ok();
    if let Ok(uri) = Uri::from_parts(parts) {
        *request.uri_mut() = uri;
    }
    let Ok(reply) = tower::ServiceExt::oneshot(router, request).await;
    reply
}
