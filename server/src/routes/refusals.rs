//! Refusals of an operation, declared next to its handler and added to the document from there. The
//! end-to-end tests check every refusal against these lists.

use api::Code;
use base::problem::status_of;
use std::collections::BTreeMap;
use utoipa::openapi::content::ContentBuilder;
use utoipa::openapi::schema::{AllOfBuilder, ObjectBuilder, Schema, SchemaType, Type};
use utoipa::openapi::{HeaderBuilder, Ref, RefOr, Response, ResponseBuilder};

/// All operations: checks before the handler, and too many busy connections.
pub const ANYWHERE: &[Code] = &[
    Code::BadHeader,
    Code::BadHost,
    Code::HeadTimeout,
    Code::HostNotAllowed,
    Code::Unauthorized,
    Code::Forbidden,
    Code::CrossSite,
    Code::UriTooLong,
    Code::HeadersTooLarge,
    Code::TooManyRequests,
    Code::Busy,
    Code::Internal,
];
/// Operations that change something.
pub const CHANGES: &[Code] = &[Code::BadOrigin];
/// Operations that take a body.
pub const BODY: &[Code] = &[
    Code::MalformedJson,
    Code::MalformedFile,
    Code::BodyTimeout,
    Code::BodyTooLarge,
    Code::DecodedTooLarge,
    Code::ExpansionTooHigh,
    Code::UnsupportedMediaType,
    Code::InvalidField,
    Code::OutOfRange,
];
/// Operations that take a scene.
pub const SCENE: &[Code] = &[
    Code::HalfPosition,
    Code::StartMissing,
    Code::UnknownMap,
    Code::UnknownAgent,
    Code::TooManyAgents,
    Code::MapTooLarge,
    Code::MapTooComplex,
    Code::UnsupportedVersion,
];
/// Operations that take a scene or the id of one.
pub const SCENE_REF: &[Code] = &[Code::NotFound, Code::StaleEtag];
/// Operations that use the store.
pub const STORE: &[Code] = &[Code::StoreUnavailable];
/// Operations that read query parameters.
pub const QUERY: &[Code] = &[Code::InvalidField, Code::OutOfRange];
/// Operations that may wait for a worker.
pub const WORK: &[Code] = &[Code::Busy, Code::ShuttingDown, Code::Cancelled, Code::GenerateTimeout];

/// Codes of refusals that contain a time to retry.
const WAITS: &[Code] = &[
    Code::Busy,
    Code::NotReady,
    Code::ShuttingDown,
    Code::StoreUnavailable,
    Code::TooManyRuns,
    Code::TooManyRequests,
];

/// Replies for these codes, one per status.
pub fn responses(sets: &[&[Code]]) -> BTreeMap<String, RefOr<Response>> {
    let mut by_status: BTreeMap<u16, Vec<&'static str>> = BTreeMap::new();
    for code in [ANYWHERE].iter().chain(sets).copied().flatten() {
        let names = by_status.entry(status_of(*code)).or_default();
        if !names.contains(&code.name()) {
            names.push(code.name());
        }
    }
    by_status.into_iter().map(|(status, names)| (status.to_string(), RefOr::T(response(&names)))).collect()
}

fn response(names: &[&'static str]) -> Response {
    let untyped = |object: ObjectBuilder| object.schema_type(SchemaType::AnyValue);
    let code = untyped(ObjectBuilder::new()).enum_values(Some(names.iter().copied()));
    let narrowed = untyped(ObjectBuilder::new()).property("code", code);
    let schema = AllOfBuilder::new().item(Ref::from_schema_name("Problem")).item(narrowed);
    let content = ContentBuilder::new().schema(Some(Schema::from(schema))).build();
    let reply =
        ResponseBuilder::new().description(names.join(", ")).content("application/problem+json", content);
    if !WAITS.iter().any(|code| names.contains(&code.name())) {
        return reply.build();
    }
    let seconds = ObjectBuilder::new().schema_type(Type::Integer).minimum(Some(1));
    let wait = HeaderBuilder::new().schema(Some(seconds)).description(Some("seconds until another attempt"));
    reply.header("Retry-After", wait.build()).build()
}

/// Declares the refusals of one operation: a name for `responses(..)`, the sets that apply, and the
/// operation's own codes.
macro_rules! refusals {
    ($name:ident: $($set:ident)* $(, $code:ident)*) => {
        /// Refusals of the operation.
        struct $name;

        impl utoipa::IntoResponses for $name {
            fn responses() -> std::collections::BTreeMap<
                String,
                utoipa::openapi::RefOr<utoipa::openapi::Response>,
            > {
                $crate::routes::refusals::responses(&[
                    $($crate::routes::refusals::$set,)*
                    &[$(api::Code::$code,)*],
                ])
            }
        }
    };
}
