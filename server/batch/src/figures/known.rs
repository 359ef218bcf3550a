//! Names of the figures, from the schemas of the score.

use super::{ACTOR, PAIR, ROAD_USERS};
use scene::score::pairs::Measures;
use scene::score::{AgentScore, SceneScore};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value;
use std::sync::OnceLock;

/// Greatest nesting of figures.
const DEEPEST: usize = 3;
/// Whether the other road user of a pair passes the place first.
pub(super) const OTHER_FIRST: &str = "other_first";

/// All names, those of the scene first.
pub fn names() -> &'static [String] {
    static NAMES: OnceLock<Vec<String>> = OnceLock::new();
    NAMES.get_or_init(|| {
        let mut names = vec![ROAD_USERS.to_owned()];
        names.extend(of_schema::<SceneScore>(""));
        let mut own = of_schema::<AgentScore>(ACTOR);
        own.extend(lists_by_agent().iter().map(|list| format!("{ACTOR}{list}")));
        own.sort();
        names.extend(own);
        let mut of_pair = of_schema::<Measures>(PAIR);
        of_pair.push(format!("{PAIR}{OTHER_FIRST}"));
        of_pair.sort();
        names.extend(of_pair);
        names
    })
}

/// Lists of a scene's score whose entries name a single road user.
pub(super) fn lists_by_agent() -> &'static [String] {
    static LISTS: OnceLock<Vec<String>> = OnceLock::new();
    LISTS.get_or_init(|| {
        let root = schema_of::<SceneScore>();
        let by_agent = |(name, member): (&String, &Value)| {
            let entry = meant(&root, &meant(&root, member)["items"]);
            entry["properties"]["agent"].is_object().then(|| name.clone())
        };
        root["properties"].as_object().into_iter().flatten().filter_map(by_agent).collect()
    })
}

/// Names of the numbers and lists of a type, from its schema.
fn of_schema<T: JsonSchema>(prefix: &str) -> Vec<String> {
    let schema = schema_of::<T>();
    let mut names = Vec::new();
    collect(&schema, &schema, prefix, 0, &mut names);
    names.sort();
    names
}

fn schema_of<T: JsonSchema>() -> Value {
    let schema: Schema = SchemaGenerator::default().root_schema_for::<T>();
    schema.to_value()
}

fn collect(root: &Value, schema: &Value, prefix: &str, deep: usize, names: &mut Vec<String>) {
    for (name, member) in schema["properties"].as_object().into_iter().flatten() {
        let name = format!("{prefix}{name}");
        let member = meant(root, member);
        let is = |kind: &str| match &member["type"] {
            Value::Array(kinds) => kinds.iter().any(|k| k == kind),
            one => one == kind,
        };
        if ["number", "integer", "boolean", "array"].into_iter().any(is) {
            names.push(name);
        } else if deep < DEEPEST {
            collect(root, member, &format!("{name}."), deep + 1, names);
        }
    }
}

/// The schema to which a reference, or a "this or null", leads.
fn meant<'a>(root: &'a Value, schema: &'a Value) -> &'a Value {
    let choice = schema["anyOf"].as_array().and_then(|all| all.iter().find(|one| one["type"] != "null"));
    let schema = choice.unwrap_or(schema);
    let pointer = schema["$ref"].as_str().and_then(|text| text.strip_prefix('#'));
    pointer.and_then(|pointer| root.pointer(pointer)).unwrap_or(schema)
}
