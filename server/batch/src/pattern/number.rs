//! A number of a pattern: itself, or the name of a parameter.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A number, the name of a parameter, or its negative: `4`, `"gap_m"`, `"-arrives_s"`.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(untagged, expecting = "a number or the name of a parameter is expected")]
pub enum PatternNumber {
    /// The number itself.
    Value(f64),
    /// The value of a parameter; a minus before the name changes its sign.
    Parameter(String),
}

impl PatternNumber {
    /// The name of its parameter.
    pub(super) fn name(&self) -> Option<&str> {
        match self {
            Self::Value(_) => None,
            Self::Parameter(text) => Some(text.strip_prefix('-').unwrap_or(text)),
        }
    }

    /// Its value; `None` for an unknown parameter.
    pub(super) fn of(&self, values: &BTreeMap<String, f64>) -> Option<f64> {
        match self {
            Self::Value(value) => Some(*value),
            Self::Parameter(text) => {
                let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
                Some(sign * values.get(self.name()?)?)
            }
        }
    }
}

impl JsonSchema for PatternNumber {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "PatternNumber".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"anyOf": [{"type": "number"}, {"type": "string", "pattern": "^-?[A-Za-z0-9_][A-Za-z0-9_-]*$"}]})
    }
}
