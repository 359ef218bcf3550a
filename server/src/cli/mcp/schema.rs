//! Arguments of tools: their own members plus members of an operation's request.

use api::{Code, Problem};
use formats::native::from_json;
use schemars::{JsonSchema, SchemaGenerator};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// A JSON object.
pub type Members = Map<String, Value>;

/// A request with no members.
#[derive(serde::Deserialize, JsonSchema)]
pub struct NoRequest {}

/// The schema of a tool's own members and of the request's members that it passes on.
pub fn of<Own: JsonSchema, Passed: JsonSchema>(passed: &[&str]) -> Members {
    let (own, request) = (root::<Own>(), root::<Passed>());
    let mut properties = members(&own, "properties");
    let of_request = members(&request, "properties").into_iter();
    properties.extend(of_request.filter(|(name, _)| passed.contains(&name.as_str())));
    let mut definitions = members(&own, "$defs");
    definitions.extend(members(&request, "$defs"));
    let mut schema = Members::new();
    schema.insert("type".into(), "object".into());
    if let Some(required) = own.get("required") {
        schema.insert("required".into(), required.clone());
    }
    let used = used(&properties, &definitions);
    definitions.retain(|name, _| used.contains(name));
    schema.insert("properties".into(), properties.into());
    if !definitions.is_empty() {
        schema.insert("$defs".into(), definitions.into());
    }
    schema.insert("additionalProperties".into(), false.into());
    schema
}

fn root<T: JsonSchema>() -> Value {
    SchemaGenerator::default().root_schema_for::<T>().to_value()
}

fn members(schema: &Value, name: &str) -> Members {
    schema.get(name).and_then(Value::as_object).cloned().unwrap_or_default()
}

/// Names of the definitions that members refer to, directly or through other definitions.
fn used(properties: &Members, definitions: &Members) -> Vec<String> {
    let mut used = Vec::new();
    let mut waiting: Vec<&Value> = properties.values().collect();
    while let Some(value) = waiting.pop() {
        match value {
            Value::Object(members) => {
                let name = members.get("$ref").and_then(Value::as_str);
                let name = name.and_then(|text| text.strip_prefix("#/$defs/"));
                if let Some((name, schema)) = name.and_then(|name| definitions.get_key_value(name))
                    && !used.contains(name)
                {
                    used.push(name.clone());
                    waiting.push(schema);
                }
                waiting.extend(members.values());
            }
            Value::Array(items) => waiting.extend(items),
            _ => {}
        }
    }
    used
}

/// Parses the arguments of a call: the tool's own, and the request to pass on.
///
/// # Errors
/// Every member that is unknown, missing or invalid, by pointer.
pub fn read<Own: DeserializeOwned, Passed: DeserializeOwned>(
    arguments: Members,
    passed: &[&str],
) -> Result<(Own, Passed), Problem> {
    let (request, own): (Members, Members) =
        arguments.into_iter().partition(|(name, _)| passed.contains(&name.as_str()));
    Ok((parsed(&own)?, parsed(&request)?))
}

fn parsed<T: DeserializeOwned>(members: &Members) -> Result<T, Problem> {
    let bytes = serde_json::to_vec(members).map_err(Problem::internal)?;
    from_json(&bytes).map_err(Problem::from)
}

/// The problem of a member with an unknown word.
pub fn no_word(pointer: &str, got: &str, words: &[&str]) -> Problem {
    let shown: String = got.chars().take(40).collect();
    let detail = format!("\"{shown}\"; {} expected", words.join(", "));
    Problem::field(pointer, Code::InvalidField, detail)
}
