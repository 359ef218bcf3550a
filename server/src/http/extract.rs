//! Parts of a request: ids in the path, query parameters, preconditions.

use crate::http::coding;
use api::{Code, Problem};
use axum::extract::{FromRequestParts, Path, Query};
use axum::http::header::{HeaderName, IF_MATCH, IF_NONE_MATCH};
use axum::http::request::Parts;
use axum::http::{Extensions, HeaderMap};
use base::id::is_id;
use base::party::Party;
use base::problem::Refusal;
use serde::de::DeserializeOwned;
use work::Caller;

/// An id in the path. An invalid one is simply not found.
pub struct Id(pub String);

impl<S: Send + Sync> FromRequestParts<S> for Id {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        match Path::<String>::from_request_parts(parts, state).await {
            Ok(Path(id)) if is_id(&id) => Ok(Self(id)),
            _ => Err(Problem::new(Code::NotFound, "Ids are 1 to 64 of A-Z a-z 0-9 _ and -.").into()),
        }
    }
}

/// The connection of a request.
#[derive(Clone, Copy, Debug)]
pub struct Connection {
    /// Unique while the server runs.
    pub number: u64,
    /// Its party.
    pub party: Party,
    /// Whether it is a WebSocket.
    pub is_line: bool,
    /// Whether it is known to belong to another user of this machine.
    pub strangers: bool,
    /// Whether it comes from a trusted proxy.
    pub trusted: bool,
}

/// The party of a request; `None` if it came by no connection.
pub fn party_of(extensions: &Extensions) -> Option<Party> {
    extensions.get::<Connection>().map(|connection| connection.party)
}

impl<S: Send + Sync> FromRequestParts<S> for Connection {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Refusal> {
        let known = parts.extensions.get().copied();
        known.ok_or_else(|| Problem::internal("a request without a connection").into())
    }
}

impl From<Connection> for Caller {
    fn from(connection: Connection) -> Self {
        let Connection { number, party, is_line, .. } = connection;
        Self { connection: Some(number), party, line: is_line.then_some(number), ..Self::default() }
    }
}

/// Query parameters; unknown or invalid ones are refused.
pub struct QueryParams<T>(pub T);

impl<T: DeserializeOwned, S: Send + Sync> FromRequestParts<S> for QueryParams<T> {
    type Rejection = Refusal;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Refusal> {
        let query = Query::<T>::from_request_parts(parts, state).await;
        query
            .map(|Query(params)| Self(params))
            .map_err(|error| Problem::field("/query", Code::InvalidField, error.body_text()).into())
    }
}

/// ETags of If-Match, including those of compressed replies; `None` without the header.
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
        lines.flat_map(|line| line.split(',')).map(|tag| coding::unmarked(tag.trim())).collect()
    })
}
