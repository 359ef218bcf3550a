//! The codes of refusals, in one table. Clients switch on a code's name, which never changes.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};
use std::borrow::Cow;

macro_rules! codes {
    ($($variant:ident $name:literal $title:literal $when:literal;)*) => {
        /// Every code that a refusal can carry.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(missing_docs, reason = "the table says it")]
        pub enum Code { $($variant,)* }

        impl Code {
            /// All codes in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// Stable name, on which clients switch.
            pub fn name(self) -> &'static str { match self { $(Self::$variant => $name,)* } }

            /// Short title, the same for each occurrence.
            pub fn title(self) -> &'static str { match self { $(Self::$variant => $title,)* } }

            /// When the code is returned and what to do about it.
            pub fn when(self) -> &'static str { match self { $(Self::$variant => $when,)* } }
        }
    };
}

codes! {
    MalformedJson "malformed-json" "Not JSON" "The body is not JSON. Line and column of the fault are given; NaN, Infinity and numbers beyond f64 are not JSON.";
    MalformedFile "malformed-file" "Broken file" "The uploaded file is broken at byte `offset` of its decoded form.";
    BadHeader "bad-header" "Unusable header" "A header of the request cannot be read.";
    BadHost "bad-host" "Host missing or given twice" "A request needs exactly one Host header.";
    Unauthorized "unauthorized" "Token needed" "This server was started with tokens; send one of them as `Authorization: Bearer`.";
    Forbidden "forbidden" "Right missing" "The token's right does not cover this operation; `detail` names the right that is needed.";
    BadOrigin "bad-origin" "Origin not allowed" "The Origin is neither this server's nor one given with --allow-origin.";
    CrossSite "cross-site" "Request from another site" "A browser sent this on behalf of another site.";
    ReadOnly "read-only" "Scene is read-only" "Demo scenes and those of the data folder cannot be changed; duplicate the scene and change the copy.";
    NotFound "not-found" "Not found" "Nothing has this address or id.";
    MethodNotAllowed "method-not-allowed" "Method not allowed" "The Allow header lists the methods of this address.";
    NotAcceptable "not-acceptable" "No acceptable representation" "None of the media types in Accept can be given.";
    HeadTimeout "head-timeout" "Head too slow" "The request line and the header fields did not arrive in time.";
    BodyTimeout "body-timeout" "Body too slow" "The body did not arrive in time.";
    Exists "exists" "Already exists" "Something with this id already exists.";
    Superseded "superseded" "Overtaken by a newer revision" "The same client sent a newer revision; `by_revision` names it.";
    StaleRevision "stale-revision" "Revision not newer" "The revision is not above the highest that this client has sent.";
    Cancelled "cancelled" "Cancelled" "The job was cancelled by its id, or its reader left.";
    StepOrder "step-order" "Step out of order" "The step is not the next one of its run, and not the last one again. The message has the next number.";
    TooManyRuns "too-many-runs" "Too many runs" "The server holds as many runs as it may, the caller has half of them (`limit` says which), or their memory is full. Delete a run, or wait until an idle one is forgotten.";
    TooManyRequests "too-many-requests" "Too many requests" "The caller sends more than `limit` requests a second, beyond what it may send at once. Retry-After says when to ask again; `retry_after_ms` is exact.";
    StaleEtag "stale-etag" "Changed in the meantime" "The stored scene is not the one that the precondition names; its current `etag` is given.";
    BodyTooLarge "body-too-large" "Body too large" "The body is larger than `limit` bytes.";
    DecodedTooLarge "decoded-too-large" "Decoded body too large" "The body decodes to more than `limit` bytes.";
    ExpansionTooHigh "expansion-too-high" "Expands too much" "The body grows by more than `limit` when decoded.";
    UriTooLong "uri-too-long" "Address too long" "The address is longer than `limit` bytes.";
    UnsupportedMediaType "unsupported-media-type" "Media type not supported" "This address does not take this Content-Type or Content-Encoding.";
    HostNotAllowed "host-not-allowed" "Host not served here" "The Host is not this machine's own name; --allow-host adds one. This guards against DNS rebinding.";
    InvalidField "invalid-field" "Field not valid" "A field has the wrong type or form, is unknown, missing or given twice; `errors` lists all faults found.";
    OutOfRange "out-of-range" "Number out of range" "A number lies outside what its field can hold; `errors` gives the bounds.";
    HalfPosition "half-position" "Incomplete position" "`x_m` and `y_m` are fixed together or not at all.";
    StartMissing "start-missing" "Start unknown" "A start field is free and neither the log nor a default fills it.";
    UnknownAgent "unknown-agent" "No such road user" "An id names no road user of the scene.";
    NotAsked "not-asked" "Condition of a road user that is not generated" "A start, goal or via point of a road user outside `agents` would change no motion. Add the road user to `agents`, or leave the condition out.";
    UnknownMap "unknown-map" "Map not known here" "No map with this hash is known to the server; send the map inline.";
    TooManyAgents "too-many-agents" "Too many road users" "More road users than a scene may hold or a call may regenerate.";
    MapTooLarge "map-too-large" "Map too large" "The map has more lines, points or signals than a scene may hold.";
    MapTooComplex "map-too-complex" "Map too complex" "The map has more links, corners of areas, or lines over each other in one place than a scene may have; `errors` gives the bounds.";
    ReplyTooLarge "reply-too-large" "Reply would be too large" "samples x modes x road users x steps of a generation, or the bytes of an exported file, are above `limit`.";
    TooMuchWork "too-much-work" "Call would take too long" "The expected work of a generation is above `limit` seconds of a core: road users x samples x windows of 9 s, with their steps and via points.";
    UnsupportedVersion "unsupported-version" "Newer version" "The document was written by a newer version of the format.";
    FormatUnknown "format-unknown" "Format not recognised" "The file is in no format this server reads, or no format has this name.";
    CannotRepresent "cannot-represent" "Format cannot hold this" "The format cannot hold something that the scene needs.";
    PickleRefused "pickle-refused" "Pickle refused" "The pickle asks for something beside numbers, texts, lists and arrays. Nothing that a pickle names is ever called.";
    LicenceRefused "licence-refused" "Licence refused" "This server was started with --refuse-nc and the source is for non-commercial use only.";
    IdempotencyKeyReused "idempotency-key-reused" "Key of another request" "The Idempotency-Key was sent with another request before. Each request has a key of its own; a repeated one has the same body.";
    UpgradeRequired "upgrade-required" "WebSocket expected" "This address is a WebSocket's: its handshake (RFC 6455) is needed.";
    PreconditionRequired "precondition-required" "Precondition needed" "Send If-Match with the ETag last read (or If-None-Match: * to create), so that no change is lost.";
    HeadersTooLarge "headers-too-large" "Headers too large" "The request has more than `limit` header fields or bytes.";
    Internal "internal" "Server defect" "A defect of the program. The log has more under the request id.";
    NonFiniteOutput "non-finite-output" "Expert gave no number" "An expert gave NaN or Infinity; `step` and `agent` say where. Nothing of it is sent.";
    Busy "busy" "Busy" "The queue is full. Retry-After says when to ask again.";
    NotReady "not-ready" "Not ready" "`failing` lists what is not ready.";
    StoreUnavailable "store-unavailable" "Store out of reach" "The disk cannot read or write saved scenes. What was answered with success is kept; Retry-After says when to ask again.";
    ShuttingDown "shutting-down" "Shutting down" "The server is shutting down.";
    GenerateTimeout "generate-timeout" "Took too long" "The work took longer than `limit` seconds.";
    StoreFull "store-full" "Store is full" "The store holds as many scenes or bytes as it may.";
}

impl Code {
    /// The code with this name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|code| code.name() == name)
    }
}

/// The name of a [`Code`], as JSON has it.
#[derive(Clone, Copy, Debug)]
pub struct CodeName(pub Code);

impl Serialize for CodeName {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name())
    }
}

impl JsonSchema for CodeName {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Code".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = Code::ALL.iter().map(|code| code.name()).collect();
        json_schema!({"type": "string", "enum": names})
    }
}

#[cfg(test)]
mod tests {
    use super::Code;

    #[test]
    fn codes_are_unique_and_found_by_name() {
        for code in Code::ALL {
            assert_eq!(Code::from_name(code.name()), Some(*code));
            assert!(!code.title().is_empty() && !code.when().is_empty());
        }
    }
}
