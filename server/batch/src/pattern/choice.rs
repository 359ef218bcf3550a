//! The pattern of a plan.

use super::document::RoadPattern;
use super::shipped;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Extension of a pattern file.
const FILE: &str = ".toml";

/// A pattern by name, or inline.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum PatternChoice {
    /// A built-in pattern, or a file that has not been read yet.
    Named(String),
    /// An inline pattern.
    Given(Box<RoadPattern>),
}

impl PatternChoice {
    /// The pattern.
    ///
    /// # Errors
    /// An unknown name, as a sentence.
    pub fn pattern(&self) -> Result<&RoadPattern, String> {
        match self {
            Self::Named(name) => shipped::named(name),
            Self::Given(pattern) => Ok(pattern),
        }
    }

    /// The file that it names.
    pub(crate) fn file(&self) -> Option<&str> {
        match self {
            Self::Named(name) => Some(name.as_str()).filter(|name| name.ends_with(FILE)),
            Self::Given(_) => None,
        }
    }
}

impl<'de> Deserialize<'de> for PatternChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ChoiceVisitor;
        impl<'de> Visitor<'de> for ChoiceVisitor {
            type Value = PatternChoice;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a pattern, a file of one, or a pattern")
            }

            fn visit_str<E: Error>(self, name: &str) -> Result<PatternChoice, E> {
                Ok(PatternChoice::Named(name.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PatternChoice, A::Error> {
                let pattern = RoadPattern::deserialize(MapAccessDeserializer::new(map))?;
                Ok(PatternChoice::Given(Box::new(pattern)))
            }
        }
        deserializer.deserialize_any(ChoiceVisitor)
    }
}

impl JsonSchema for PatternChoice {
    fn schema_name() -> Cow<'static, str> {
        "PatternChoice".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = shipped::all().iter().map(|pattern| pattern.name.as_str()).collect();
        let pattern = generator.subschema_for::<RoadPattern>();
        json_schema!({"anyOf": [
            {"type": "string", "enum": names},
            {"type": "string", "pattern": "\\.toml$"},
            pattern
        ]})
    }
}
