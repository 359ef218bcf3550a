//! The OpenAPI 3.1 document: paths from the handlers, [`schemas`], problems from the table of codes.

use super::schemas;
use base::{base_path::published, limits::Limits};
use serde_json::{Map, Value, json};
use utoipa::openapi::{InfoBuilder, LicenseBuilder, OpenApi, OpenApiBuilder};

/// The document without its paths.
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

/// The complete document; equal builds give equal text.
pub fn document() -> Value {
    let (_, paths) = super::documented().split_for_parts();
    let mut document = serde_json::to_value(paths).unwrap_or(Value::Null);
    document["servers"] =
        json!([{"url": published("/"), "description": "the server that gave this document"}]);
    let token = json!({"type": "http", "scheme": "bearer", "description": "with --token-file only"});
    document["security"] = json!([{}, {"token": []}]);
    tidy(&mut document);
    document["components"] = json!({"schemas": schemas::all(), "securitySchemes": {"token": token}});
    document
}

/// Adds facts that the paths' macros cannot express. A body is required except for a copy. Documents have
/// their own media type too, an uploaded file is bytes or part of a form, and an export has the media type of
/// its format.
fn tidy(document: &mut Value) {
    let operations = document["paths"].as_object_mut().into_iter().flat_map(|paths| paths.values_mut());
    for operation in operations.flat_map(|item| item.as_object_mut().into_iter().flat_map(Map::values_mut)) {
        let id = operation["operationId"].as_str().unwrap_or_default().to_owned();
        if let Some(content) = operation.pointer_mut("/responses/200/content").and_then(Value::as_object_mut)
            && matches!(id.as_str(), "exportScene" | "exportUnsaved")
        {
            content.extend(exported());
        }
        let Some(body) = operation.get_mut("requestBody").and_then(Value::as_object_mut) else { continue };
        body.insert("required".into(), json!(id != "duplicateScene"));
        let Some(content) = body.get_mut("content").and_then(Value::as_object_mut) else { continue };
        if let (Some(json), "createScene" | "replaceScene" | "exportUnsaved") =
            (content.get("application/json").cloned(), id.as_str())
        {
            content.insert("application/vnd.dragtraffic.scene+json".into(), json);
        }
        if id == "importScenes" {
            let part = json!({"type": "string", "format": "binary"});
            let most = Limits::default().import_files;
            let files = json!({"type": "array", "items": part, "minItems": 1, "maxItems": most});
            let parts = json!({"file": files, "net": part, "columns": part});
            let form = json!({"type": "object", "required": ["file"], "properties": parts});
            content.insert("multipart/form-data".into(), json!({"schema": form}));
            content.insert("application/octet-stream".into(), json!({"schema": part}));
        }
    }
}

/// Media types of written files; only they distinguish text from bytes.
fn exported() -> Map<String, Value> {
    let written = formats::registry::FORMATS.iter().map(|format| format.info()).filter(|info| info.export);
    let content = |media_type: &'static str| match media_type {
        formats::native::MEDIA_TYPE => json!({"schema": {"$ref": "#/components/schemas/Scene"}}),
        _ => json!({"schema": {"type": "string", "format": "binary"}}),
    };
    written.map(|info| (info.media_type.to_owned(), content(info.media_type))).collect()
}

/// Pretty-printed JSON with a final newline, as it is committed.
pub fn text() -> String {
    serde_json::to_string_pretty(&document()).unwrap_or_default() + "\n"
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
                let replies = operation["responses"].as_object().unwrap();
                // Every list of refusals contains 421, so an operation without it has declared none.
                assert!(replies.contains_key("421"), "{id} declares no refusals");
                for (status, reply) in replies {
                    let words = reply["description"].as_str().unwrap_or_default();
                    assert!(!words.is_empty(), "{id} {status} has no description");
                }
            }
        }
        assert_eq!(document["openapi"], "3.1.0");
    }

    #[test]
    fn bodies_and_preconditions_that_are_needed_are_said_to_be() {
        let document = super::document();
        for (path, item) in document["paths"].as_object().unwrap() {
            for (method, operation) in item.as_object().unwrap() {
                let id = operation["operationId"].as_str().unwrap();
                if let Some(body) = operation.get("requestBody") {
                    assert_eq!(body["required"], id != "duplicateScene", "{id}");
                }
                if path.starts_with("/v1/scenes") && matches!(method.as_str(), "patch" | "delete") {
                    let parameters = operation["parameters"].as_array().unwrap();
                    let tag = parameters.iter().find(|p| p["name"] == "If-Match").unwrap();
                    assert_eq!(tag["required"], true, "{id}");
                }
            }
        }
        for name in ["GenerateRequest", "PlaceBody", "ScoreRequest", "RunBody", "SearchBody"] {
            let one = &document["components"]["schemas"][name]["oneOf"];
            assert_eq!(one.as_array().map(Vec::len), Some(2), "{name}");
        }
        let forms = &document["paths"]["/v1/import"]["post"]["requestBody"]["content"];
        assert!(forms["multipart/form-data"]["schema"]["properties"]["net"].is_object());
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
