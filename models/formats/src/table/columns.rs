//! Columns of a table: this program's by their names, others' by a file that maps them.

use super::{COLUMNS, SPEED};
use crate::problem::{FieldProblem, ReadError, code};
use crate::source::Source;
use crate::unpack::{self, Bounds};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::Read;

/// Most bytes of a column file.
const MAX_BYTES: u64 = 1 << 20;

/// Source of a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ColumnSource {
    /// Name of the column; nothing where every row has the same value.
    pub column: Option<String>,
    /// ... this one.
    pub value: Option<String>,
    /// Numbers are `factor * number + offset`.
    pub factor: f64,
    pub offset: f64,
    /// Words of theirs and ours.
    pub words: BTreeMap<String, String>,
}

/// Our name to where its values come from.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Columns(pub BTreeMap<&'static str, ColumnSource>);

/// A column in the column file: its name, or an object with details.
#[derive(Deserialize)]
#[serde(untagged)]
enum Told {
    Name(String),
    More(More),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct More {
    column: Option<String>,
    value: Option<serde_json::Value>,
    unit: Option<String>,
    factor: Option<f64>,
    offset: Option<f64>,
    #[serde(default)]
    words: BTreeMap<String, String>,
}

/// All names that a column file may map.
fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.into_iter().chain([SPEED])
}

/// Metres, seconds, radians and m/s in one of a unit.
fn unit_factor(unit: &str) -> Option<f64> {
    Some(match unit {
        "m" | "s" | "rad" | "m/s" | "mps" => 1.0,
        "deg" => std::f64::consts::PI / 180.0,
        "ft" => 0.3048,
        "cm" => 0.01,
        "km" | "ks" => 1_000.0,
        "km/h" => 1.0 / 3.6,
        "mph" => 0.447_04,
        "ft/s" => 0.3048,
        "ms" => 1e-3,
        "us" => 1e-6,
        "ns" => 1e-9,
        _ => return None,
    })
}

impl Columns {
    /// Our own names.
    pub fn own() -> Self {
        let own = |name| {
            (name, ColumnSource { column: Some(String::from(name)), factor: 1.0, ..ColumnSource::default() })
        };
        Self(names().map(own).collect())
    }

    /// Columns from a column file, with this program's names for unmapped ones.
    ///
    /// # Errors
    /// `malformed-json`, `invalid-field`.
    pub fn read(file: &dyn Source) -> Result<Self, ReadError> {
        let mut bytes = Vec::new();
        let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
        let input = input.and_then(|mut input| input.read_to_end(&mut bytes));
        input.map_err(|error| unpack::fault(&error, 0))?;
        let told: BTreeMap<String, Told> = serde_json::from_slice(&bytes)
            .map_err(|error| ReadError::malformed_json(&error, error.to_string()))?;
        let mut columns = Self::own();
        for (name, told) in told {
            let fault = |detail: String| {
                let pointer = format!("/{}", crate::problem::pointer_token(&name));
                ReadError::from(FieldProblem::new(pointer, code::INVALID_FIELD, detail))
            };
            let Some(own) = names().find(|own| *own == name) else {
                let all: Vec<_> = names().collect();
                return Err(fault(format!("one of {} expected", all.join(", "))));
            };
            let origin = match told {
                Told::Name(column) => {
                    ColumnSource { column: Some(column), factor: 1.0, ..ColumnSource::default() }
                }
                Told::More(more) => more.origin().map_err(fault)?,
            };
            columns.0.insert(own, origin);
        }
        Ok(columns)
    }
}

impl More {
    fn origin(self) -> Result<ColumnSource, String> {
        let unit = match &self.unit {
            None => 1.0,
            Some(unit) => unit_factor(unit).ok_or_else(|| {
                format!("unit \"{unit}\" found; m, ft, cm, km, s, ms, us, ns, rad, deg, m/s, km/h, mph, ft/s expected")
            })?,
        };
        let factor = self.factor.unwrap_or(1.0) * unit;
        let offset = self.offset.unwrap_or(0.0);
        if !(factor.is_finite() && offset.is_finite() && factor != 0.0) {
            return Err("a factor other than zero and a finite offset expected".into());
        }
        let value = match self.value {
            None => None,
            Some(serde_json::Value::String(text)) => Some(text),
            Some(value @ (serde_json::Value::Number(_) | serde_json::Value::Bool(_))) => {
                Some(value.to_string())
            }
            Some(_) => return Err("a text, a number or a boolean expected as value".into()),
        };
        if self.column.is_some() == value.is_some() {
            return Err("either column or value expected".into());
        }
        Ok(ColumnSource { column: self.column, value, factor, offset, words: self.words })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Columns, ReadError> {
        Columns::read(&text.as_bytes())
    }

    #[test]
    fn names_units_and_words_are_taken() {
        let told = r#"{"agent_id": "trackId", "heading_rad": {"column": "heading", "unit": "deg", "factor": -1},
            "type": {"column": "class", "words": {"1": "car"}}, "scenario_id": {"value": 7}}"#;
        let columns = read(told).unwrap().0;
        assert_eq!(columns["agent_id"].column.as_deref(), Some("trackId"));
        assert!((columns["heading_rad"].factor + 0.017_453_292_5).abs() < 1e-9);
        assert_eq!(columns["type"].words["1"], "car");
        assert_eq!(columns["scenario_id"].value.as_deref(), Some("7"));
        assert_eq!(columns["x_m"].column.as_deref(), Some("x_m"));
    }

    #[test]
    fn what_cannot_be_is_told() {
        for (text, code, at) in [
            ("[", "malformed-json", ""),
            (r#"{"xx": "a"}"#, "invalid-field", "/xx"),
            (r#"{"x_m": {"column": "a", "value": 1}}"#, "invalid-field", "/x_m"),
            (r#"{"x_m": {"column": "a", "unit": "yd"}}"#, "invalid-field", "/x_m"),
            (r#"{"x_m": {"column": "a", "factor": 0}}"#, "invalid-field", "/x_m"),
        ] {
            let error = read(text).unwrap_err();
            assert_eq!((error.code(), error.problems[0].pointer.as_str()), (code, at), "{text}");
        }
    }
}
