//! The schemas of the OpenAPI document, made from the Rust types.

use super::{health, import, maps, scenes};
use crate::generation::events;
use crate::generation::search::SearchEvent;
use api::map::{MapBody, MapReply, TemplateList};
use api::place::{PlaceBody, PlaceReply};
use api::{GenerateRequest, info::ProgramInfo, score::ScoreRequest};
use base::problem::ProblemDoc;
use batch::search::call::SearchBody;
use formats::native::{MapDoc, SceneDoc};
use scene::score::Score;
use schemars::SchemaGenerator;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Prefix of references.
const FOLDER: &str = "#/components/schemas/";

/// Schemas of replies: members that are always present are required.
fn replies(generator: &mut SchemaGenerator) {
    generator.subschema_for::<ProblemDoc>();
    generator.subschema_for::<events::StreamEvent>();
    generator.subschema_for::<SearchEvent>();
    generator.subschema_for::<Score>();
    generator.subschema_for::<PlaceReply>();
    generator.subschema_for::<import::ImportedBody>();
    generator.subschema_for::<ProgramInfo>();
    generator.subschema_for::<health::Health>();
    generator.subschema_for::<scenes::list::SceneList>();
    generator.subschema_for::<scenes::Saved>();
    generator.subschema_for::<maps::MapList>();
    generator.subschema_for::<MapReply>();
    generator.subschema_for::<TemplateList>();
    api::runs::replies(generator);
}

/// Schemas of requests, and of documents used in both directions: members with a default are optional.
fn requests(generator: &mut SchemaGenerator) {
    generator.subschema_for::<SceneDoc>();
    generator.subschema_for::<MapDoc>();
    generator.subschema_for::<GenerateRequest>();
    generator.subschema_for::<ScoreRequest>();
    generator.subschema_for::<PlaceBody>();
    generator.subschema_for::<MapBody>();
    generator.subschema_for::<SearchBody>();
    api::runs::requests(generator);
    generator.subschema_for::<scenes::write::ScenePatch>();
    generator.subschema_for::<scenes::copy::DuplicateRequest>();
}

fn settings() -> SchemaSettings {
    SchemaSettings::draft2020_12().with(|s| s.definitions_path = "/components/schemas".into())
}

/// All components by name.
pub fn all() -> Map<String, Value> {
    let mut told = settings().for_serialize().into_generator();
    let mut asked = settings().for_deserialize().into_generator();
    replies(&mut told);
    requests(&mut asked);
    let mut all = told.take_definitions(true);
    // A type in both sets is a document: what is returned can be sent back.
    all.extend(asked.take_definitions(true));
    let names = names(&all);
    let mut all: Vec<(String, Value)> =
        all.into_iter().map(|(name, schema)| (names.get(&name).cloned().unwrap_or(name), schema)).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    for (name, schema) in &mut all {
        refer(schema, &names);
        words_together(schema);
        // Client generators name classes by the title.
        if let Some(members) = schema.as_object_mut() {
            members.insert("title".into(), name.as_str().into());
        }
    }
    all.into_iter().collect()
}

/// Names without the suffix that distinguishes a document from its value type, if such a name is free.
fn names(all: &Map<String, Value>) -> BTreeMap<String, String> {
    let short = |name: &String| Some((name.clone(), name.strip_suffix("Doc")?.to_owned()));
    all.keys().filter_map(short).filter(|(_, short)| !all.contains_key(short)).collect()
}

/// Writes a choice of words as one `enum`. A choice of constants, each with a description, is equivalent for
/// a validator, but client generators make a type of each constant.
fn words_together(schema: &mut Value) {
    match schema {
        Value::Object(members) => {
            members.values_mut().for_each(words_together);
            let Some((words, meanings)) = members.get("oneOf").and_then(words_of) else { return };
            members.remove("oneOf");
            members.insert("type".into(), "string".into());
            members.insert("enum".into(), words.into());
            let own = members.get("description").and_then(Value::as_str).unwrap_or_default();
            let text = std::iter::once(own.to_owned()).chain(meanings).filter(|line| !line.is_empty());
            members.insert("description".into(), text.collect::<Vec<_>>().join("\n\n").into());
        }
        Value::Array(items) => items.iter_mut().for_each(words_together),
        _ => {}
    }
}

/// The words of a choice that contains nothing else, and a line for each described word.
fn words_of(choice: &Value) -> Option<(Vec<Value>, Vec<String>)> {
    let (mut words, mut meanings) = (Vec::new(), Vec::new());
    for one in choice.as_array()? {
        let given = match (one.get("const"), one.get("enum").and_then(Value::as_array)) {
            (Some(word), None) => std::slice::from_ref(word),
            (None, Some(several)) => several,
            _ => return None,
        };
        if !given.iter().all(Value::is_string) {
            return None;
        }
        if let (Some(meaning), [Value::String(word)]) =
            (one.get("description").and_then(Value::as_str), given)
        {
            meanings.push(format!("`{word}`: {meaning}"));
        }
        words.extend_from_slice(given);
    }
    Some((words, meanings))
}

/// Renames the references in a schema.
fn refer(schema: &mut Value, names: &BTreeMap<String, String>) {
    match schema {
        Value::Object(members) => {
            if let Some(Value::String(reference)) = members.get_mut("$ref")
                && let Some(name) = reference.strip_prefix(FOLDER).and_then(|name| names.get(name))
            {
                *reference = format!("{FOLDER}{name}");
            }
            members.values_mut().for_each(|member| refer(member, names));
        }
        Value::Array(items) => items.iter_mut().for_each(|item| refer(item, names)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;
    use std::collections::BTreeSet;

    #[test]
    fn a_schema_is_named_as_its_title_and_chooses_among_words_by_one_enum() {
        let all = super::all();
        for (name, schema) in &all {
            assert_eq!(schema["title"], **name);
            assert!(!name.ends_with("Doc") || all.contains_key(name.trim_end_matches("Doc")), "{name}");
        }
        let kinds = &all["FaultKind"];
        assert!(kinds["enum"].as_array().unwrap().contains(&"near_miss".into()) && kinds["oneOf"].is_null());
        assert!(kinds["description"].as_str().unwrap().contains("`near_miss`: "));
    }

    #[test]
    fn a_name_means_one_type_in_requests_and_replies() {
        let mut told = super::settings().for_serialize().into_generator();
        let mut asked = super::settings().for_deserialize().into_generator();
        super::replies(&mut told);
        super::requests(&mut asked);
        let (told, asked) = (told.take_definitions(true), asked.take_definitions(true));
        let members = |schema: &Value| -> BTreeSet<String> {
            schema["properties"].as_object().into_iter().flatten().map(|(name, _)| name.clone()).collect()
        };
        for (name, schema) in told.iter().filter(|(name, _)| asked.contains_key(*name)) {
            assert_eq!(members(schema), members(&asked[name]), "{name}");
        }
    }
}
