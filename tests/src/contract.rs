//! The committed OpenAPI document as a contract: every reply and every event that a test receives is checked
//! against the schema of its operation and status.

#![allow(clippy::panic, clippy::expect_used, reason = "a reply that breaks the contract fails its test")]

use crate::http::Reply;
use crate::program::root;
use jsonschema::Validator;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// The contract of one operation.
pub struct Promise {
    name: String,
    operation: &'static Value,
}

/// The document, read once.
fn document() -> &'static Value {
    static DOCUMENT: OnceLock<Value> = OnceLock::new();
    DOCUMENT.get_or_init(|| {
        let path = root().join("assets/openapi.json");
        let text = std::fs::read(&path).expect("the document is committed");
        serde_json::from_slice(&text).expect("the document is JSON")
    })
}

/// The contract of an address; `None` if the document has none.
pub fn promise(method: &str, target: &str) -> Option<Promise> {
    let path = target.split('?').next().unwrap_or_default();
    let fits = |template: &str| {
        let (mut there, mut asked) = (template.split('/'), path.split('/'));
        loop {
            match (there.next(), asked.next()) {
                (None, None) => return true,
                (Some(part), Some(given)) if part == given || part.starts_with('{') => {}
                _ => return false,
            }
        }
    };
    let paths = document()["paths"].as_object()?;
    let (template, item) = paths.iter().find(|(template, _)| fits(template))?;
    let operation = item.get(method.to_ascii_lowercase())?;
    Some(Promise { name: format!("{method} {template}"), operation })
}

impl Promise {
    /// Checks a whole reply against the contract.
    pub fn check(&self, reply: &Reply) {
        self.check_headers(reply);
        match reply.header("content-type") {
            "application/x-ndjson" => reply.text().lines().for_each(|line| self.check_event(line)),
            "text/event-stream" => {
                let text = reply.text();
                text.lines().filter_map(|line| line.strip_prefix("data: ")).for_each(|e| self.check_event(e));
            }
            media if media.ends_with("json") => self.check_body(reply.status, media, &reply.json()),
            _ => self.check_status(reply.status),
        }
    }

    fn check_status(&self, status: u16) {
        let known = self.operation["responses"].get(status.to_string()).is_some();
        assert!(known, "{}: {status} is not in the document", self.name);
    }

    /// Checks that headers that clients act on are in the document.
    fn check_headers(&self, reply: &Reply) {
        let declared = &self.operation["responses"][reply.status.to_string()]["headers"];
        for name in ["ETag", "Location", "Retry-After"] {
            let sent = !reply.header(&name.to_ascii_lowercase()).is_empty();
            assert!(!sent || declared[name].is_object(), "{}: {} sends {name}", self.name, reply.status);
        }
    }

    fn check_body(&self, status: u16, media: &str, body: &Value) {
        self.check_status(status);
        let content = &self.operation["responses"][status.to_string()]["content"];
        let schema = content.get(media).and_then(|media| media.get("schema"));
        let schema =
            schema.unwrap_or_else(|| panic!("{}: {status} {media} is not in the document", self.name));
        // A file of another format is declared as arbitrary bytes even if it is JSON.
        if schema["format"] != "binary" {
            self.hold(schema, body);
        }
    }

    /// Checks one event of a stream against the contract.
    pub fn check_event(&self, text: &str) {
        let event: Value =
            serde_json::from_str(text).unwrap_or_else(|error| panic!("{}: {error}: {text}", self.name));
        let schema = &self.operation["responses"]["200"]["content"]["application/x-ndjson"]["schema"];
        self.hold(schema, &event);
    }

    fn hold(&self, schema: &Value, value: &Value) {
        let validator = validator(schema);
        let faults: Vec<String> = validator
            .iter_errors(value)
            .take(4)
            .map(|error| format!("{} at {}", error, error.instance_path()))
            .collect();
        let shown: String = value.to_string().chars().take(1_000).collect();
        assert!(faults.is_empty(), "{} breaks its contract: {}\n{shown}", self.name, faults.join("; "));
    }
}

/// The validator of a schema of the document, made once.
fn validator(schema: &Value) -> Arc<Validator> {
    static KNOWN: OnceLock<Mutex<HashMap<String, Arc<Validator>>>> = OnceLock::new();
    let known = KNOWN.get_or_init(Mutex::default);
    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
    let made = known.entry(schema.to_string()).or_insert_with(|| {
        let whole = json!({"allOf": [schema], "components": document()["components"]});
        let options = jsonschema::options().with_draft(jsonschema::Draft::Draft202012);
        Arc::new(options.build(&whole).expect("a schema of the document"))
    });
    Arc::clone(made)
}
