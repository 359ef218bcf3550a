//! The OpenAPI 3.1 document: paths from the handlers, schemas from the Rust types, problems from the
//! table of codes.

use crate::base::problem::Code;
use crate::routes::{generate, maps, place, scenes, score};
use formats::native::{MapDoc, SceneDoc};
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use utoipa::openapi::{InfoBuilder, LicenseBuilder, OpenApi, OpenApiBuilder};

/// Codes that any operation can answer with.
const ANYWHERE: &[Code] = &[
    Code::BadHost,
    Code::HostNotAllowed,
    Code::CrossSite,
    Code::UriTooLong,
    Code::HeadersTooLarge,
    Code::Internal,
];
/// Codes of operations that change something.
const CHANGES: &[Code] = &[Code::BadOrigin];
/// Codes of operations that take a body.
const BODIES: &[Code] = &[
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
/// Codes of operations that take a scene.
const SCENES: &[Code] =
    &[Code::HalfPosition, Code::UnknownMap, Code::TooManyAgents, Code::MapTooLarge, Code::UnsupportedVersion];

/// Further codes of single operations.
fn own_codes(operation: &str) -> &'static [Code] {
    match operation {
        "listScenes" => &[Code::InvalidField, Code::OutOfRange],
        "createScene" => &[Code::StoreFull, Code::Exists],
        "readScene" => &[Code::NotFound, Code::InvalidField],
        "replaceScene" => {
            &[Code::NotFound, Code::StaleEtag, Code::PreconditionRequired, Code::ReadOnly, Code::StoreFull]
        }
        "renameScene" => {
            &[Code::NotFound, Code::StaleEtag, Code::PreconditionRequired, Code::ReadOnly, Code::StoreFull]
        }
        "deleteScene" => &[Code::NotFound, Code::StaleEtag, Code::PreconditionRequired, Code::ReadOnly],
        "duplicateScene" => &[Code::NotFound, Code::StoreFull],
        "exportScene" => &[
            Code::NotFound,
            Code::FormatUnknown,
            Code::CannotRepresent,
            Code::InvalidField,
            Code::OutOfRange,
        ],
        "exportUnsaved" => &[Code::FormatUnknown, Code::CannotRepresent],
        "importScenes" => &[Code::FormatUnknown, Code::LicenceRefused, Code::StoreFull],
        "readMap" => &[Code::NotFound],
        "generate" => &[
            Code::NotFound,
            Code::NotAcceptable,
            Code::Exists,
            Code::Superseded,
            Code::StaleRevision,
            Code::Cancelled,
            Code::StaleEtag,
            Code::StartMissing,
            Code::UnknownAgent,
            Code::ReplyTooLarge,
            Code::NonFiniteOutput,
            Code::Busy,
            Code::ShuttingDown,
            Code::GenerateTimeout,
        ],
        "place" => &[Code::NotFound, Code::UnknownAgent, Code::Cancelled, Code::GenerateTimeout],
        "cancelJob" => &[Code::NotFound],
        "score" => &[Code::NotFound, Code::UnknownAgent],
        "readyz" => &[Code::NotReady],
        _ => &[],
    }
}

/// The document before its paths.
pub fn head() -> OpenApi {
    let licence =
        LicenseBuilder::new().name("MIT OR Apache-2.0").identifier(Some("MIT OR Apache-2.0")).build();
    let info = InfoBuilder::new()
        .title("DragTraffic")
        .version(env!("CARGO_PKG_VERSION"))
        .description(Some(
            "Traffic scenes from conditions: fix where road users start and where they should be, and get \
             coherent futures. Metres, seconds, radians; x east, y north; step 0.1 s. What the editor does, \
             a script can do: it uses these operations and no others.",
        ))
        .license(Some(licence))
        .build();
    OpenApiBuilder::new().info(info).build()
}

/// The whole document; equal builds give equal text.
pub fn document() -> Value {
    let (_, paths) = crate::routes::all().split_for_parts();
    let mut document = serde_json::to_value(paths).unwrap_or(Value::Null);
    document["servers"] = json!([{"url": "/", "description": "the server that gave this document"}]);
    let token = json!({"type": "http", "scheme": "bearer", "description": "with --token-file only"});
    document["security"] = json!([{}, {"token": []}]);
    document["components"] = json!({"schemas": schemas(), "securitySchemes": {"token": token}});
    let methods = document["paths"].as_object_mut().into_iter().flatten();
    for operation in methods.flat_map(|(_, item)| item.as_object_mut().into_iter().flatten()) {
        let (method, operation) = operation;
        complete(method, operation);
    }
    document
}

/// Pretty text with a last newline, as it is committed.
pub fn text() -> String {
    let mut text = serde_json::to_string_pretty(&document()).unwrap_or_default();
    text.push('\n');
    text
}

/// Adds problem replies and examples to one operation.
fn complete(method: &str, operation: &mut Value) {
    for (status, reply) in operation["responses"].as_object_mut().into_iter().flatten() {
        if reply["description"].as_str().is_none_or(str::is_empty) {
            reply["description"] = if status == "201" { "stored" } else { "the answer" }.into();
        }
    }
    let id = operation["operationId"].as_str().unwrap_or_default().to_owned();
    let mut codes: Vec<Code> = ANYWHERE.to_vec();
    if method != "get" {
        codes.extend(CHANGES);
    }
    let body = operation["requestBody"].to_string();
    if body != "null" {
        codes.extend(BODIES);
    }
    if body.contains("schemas/Scene\"")
        || body.contains("GenerateRequest")
        || body.contains("ScoreRequest")
        || body.contains("PlaceBody")
        || id == "importScenes"
    {
        codes.extend(SCENES);
    }
    codes.extend(own_codes(&id));
    let mut by_status: BTreeMap<u16, Vec<&'static str>> = BTreeMap::new();
    for code in codes {
        let names = by_status.entry(code.status()).or_default();
        if !names.contains(&code.name()) {
            names.push(code.name());
        }
    }
    for (status, names) in by_status {
        let reference = json!({"$ref": "#/components/schemas/Problem"});
        let narrowed = json!({"allOf": [reference, {"properties": {"code": {"enum": names}}}]});
        operation["responses"][status.to_string()] = json!({
            "description": names.join(", "),
            "content": {"application/problem+json": {"schema": narrowed}},
        });
    }
    if let Some(example) = example(&id)
        && let Some(content) = operation["requestBody"]["content"].as_object_mut()
    {
        for (_, media) in content {
            media["example"] = example.clone();
        }
    }
    if id == "generate" {
        for media in ["application/x-ndjson", "text/event-stream"] {
            operation["responses"]["200"]["content"][media]["x-stream-item"] = true.into();
        }
    }
}

fn example(operation: &str) -> Option<Value> {
    match operation {
        "generate" => Some(json!({
            "scene_id": "demo-crossing", "agents": ["5"], "seed": 7,
            "conditions": {"5": {"goal": {"x_m": 14.0, "y_m": 0.4, "speed_mps": 6.0}}},
        })),
        "place" => Some(json!({
            "scene_id": "demo-crossing", "density": {"count": 20}, "seed": 7, "keep": [],
            "types": {"vehicle": 0.7, "pedestrian": 0.2, "cyclist": 0.1},
            "region": {"circle": {"x_m": 0.0, "y_m": 0.0, "radius_m": 60.0}},
        })),
        "score" => Some(json!({"scene_id": "demo-crossing"})),
        "renameScene" => Some(json!({"name": "left turn, late"})),
        "duplicateScene" => Some(json!({"name": "left turn, later"})),
        _ => None,
    }
}

fn schemas() -> Map<String, Value> {
    let settings = SchemaSettings::draft2020_12().with(|s| s.definitions_path = "/components/schemas".into());
    let mut generator = settings.into_generator();
    let scene = generator.root_schema_for::<SceneDoc>();
    generator.subschema_for::<MapDoc>();
    generator.subschema_for::<generate::GenerateRequest>();
    generator.subschema_for::<score::ScoreRequest>();
    generator.subschema_for::<place::PlaceBody>();
    generator.subschema_for::<place::PlaceReply>();
    generator.subschema_for::<scenes::SceneList>();
    generator.subschema_for::<scenes::Saved>();
    generator.subschema_for::<scenes::ScenePatch>();
    generator.subschema_for::<scenes::DuplicateRequest>();
    generator.subschema_for::<maps::MapList>();
    let mut all: BTreeMap<String, Value> = generator.take_definitions(true).into_iter().collect();
    let mut scene = scene.to_value();
    if let Some(scene) = scene.as_object_mut() {
        scene.remove("$schema");
        scene.remove("$defs");
        scene.remove("components");
    }
    all.insert("Scene".into(), scene);
    all.insert("Map".into(), json!({"$ref": "#/components/schemas/MapDoc"}));
    let written: Map<String, Value> =
        serde_json::from_str(include_str!("../../openapi/replies.json")).unwrap_or_default();
    all.extend(written);
    let codes: Vec<&str> = Code::ALL.iter().map(|code| code.name()).collect();
    if let Some(problem) = all.get_mut("Problem") {
        problem["properties"]["code"]["enum"] = json!(codes);
    }
    all.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use serde_json::Value;
    use std::collections::BTreeSet;

    #[test]
    fn the_committed_document_is_current() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/openapi.json");
        let committed = std::fs::read_to_string(path).unwrap_or_default();
        let now = super::text();
        assert!(committed == now, "run: cargo run -p dragtraffic -- openapi > assets/openapi.json");
    }

    #[test]
    fn every_reference_leads_somewhere_and_every_operation_has_an_id() {
        let document = super::document();
        let mut references = BTreeSet::new();
        collect(&document, &mut references);
        for reference in &references {
            let pointer = reference.trim_start_matches('#');
            assert!(document.pointer(pointer).is_some(), "{reference}");
        }
        let mut ids = BTreeSet::new();
        for (path, item) in document["paths"].as_object().unwrap() {
            for (method, operation) in item.as_object().unwrap() {
                let id = operation["operationId"].as_str().unwrap_or_else(|| panic!("{method} {path}"));
                assert!(ids.insert(id.to_owned()), "{id} twice");
                assert!(operation["responses"]["421"].is_object(), "{id}");
            }
        }
        assert_eq!(document["openapi"], "3.1.0");
    }

    fn collect(value: &Value, into: &mut BTreeSet<String>) {
        match value {
            Value::Object(members) => {
                if let Some(Value::String(reference)) = members.get("$ref") {
                    into.insert(reference.clone());
                }
                members.values().for_each(|member| collect(member, into));
            }
            Value::Array(items) => items.iter().for_each(|item| collect(item, into)),
            _ => {}
        }
    }
}
