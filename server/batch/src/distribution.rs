//! A number of a plan: fixed, or drawn from a range or a list.

use crate::fault::PlanFault;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::{Deserialize, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// Resolution of drawn numbers, steps per unit: four decimal places.
const STEPS_PER_UNIT: f64 = 1e4;
/// Most values of a number in a grid.
pub const MOST_POINTS: usize = 10_000;

/// Source of a number.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// A fixed value.
    Fixed(f64),
    /// Uniform between two bounds.
    Uniform {
        /// Least.
        low: f64,
        /// Greatest.
        high: f64,
        /// Number of values in a grid, both bounds included.
        points: Option<usize>,
    },
    /// One of these values.
    Choice(Vec<f64>),
}

/// The table form.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct DistributionTable {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    uniform: Option<(f64, f64)>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    points: Option<usize>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    choice: Option<Vec<f64>>,
}

impl Distribution {
    /// Whether it has only one value.
    pub fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed(_))
    }

    /// The quantile at this share, 0 to 1; rounded to four decimal places.
    pub fn at(&self, share: f64) -> f64 {
        match self {
            Self::Fixed(value) => *value,
            Self::Uniform { low, high, .. } => rounded(low + (high - low) * share).clamp(*low, *high),
            Self::Choice(values) => {
                let place = (share * values.len() as f64) as usize;
                values.get(place).or(values.last()).copied().unwrap_or_default()
            }
        }
    }

    /// Number of values in a grid.
    pub fn points(&self) -> usize {
        match self {
            Self::Fixed(_) => 1,
            Self::Uniform { points, .. } => points.unwrap_or(0),
            Self::Choice(values) => values.len(),
        }
    }

    /// A value of a grid, by its index.
    pub fn point(&self, place: usize) -> f64 {
        match self {
            Self::Fixed(value) => *value,
            Self::Uniform { low, high, points } => {
                let last = points.unwrap_or(1).saturating_sub(1).max(1);
                let value = rounded(low + (high - low) * place as f64 / last as f64);
                if place == last { *high } else { value.clamp(*low, *high) }
            }
            Self::Choice(values) => values.get(place).copied().unwrap_or_default(),
        }
    }

    /// Checks every possible value against a range, and its members against each other.
    pub(crate) fn check(&self, path: &str, (least, most): (f64, f64), faults: &mut Vec<PlanFault>) {
        let mut fault = |detail: String| faults.push(PlanFault::new(path, detail));
        let values = match self {
            Self::Fixed(value) => vec![*value],
            Self::Uniform { low, high, points } => {
                if low > high {
                    fault(format!("uniform from {low} to {high}: the first bound is the least"));
                }
                if points.is_some_and(|points| !(2..=MOST_POINTS).contains(&points)) {
                    fault(format!("points: 2 to {MOST_POINTS} expected"));
                }
                vec![*low, *high]
            }
            Self::Choice(values) => {
                if values.is_empty() || values.len() > MOST_POINTS {
                    fault(format!("choice: 1 to {MOST_POINTS} values expected"));
                }
                values.clone()
            }
        };
        if let Some(value) = values.iter().find(|value| !(**value >= least && **value <= most)) {
            fault(format!("{value} is outside {least} to {most}"));
        }
    }
}

fn rounded(value: f64) -> f64 {
    (value * STEPS_PER_UNIT).round() / STEPS_PER_UNIT
}

impl<'de> Deserialize<'de> for Distribution {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(DistributionVisitor)
    }
}

struct DistributionVisitor;

impl<'de> Visitor<'de> for DistributionVisitor {
    type Value = Distribution;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, { uniform = [LOW, HIGH] } or { choice = [A, B] }")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Distribution, E> {
        Ok(Distribution::Fixed(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Distribution, E> {
        Ok(Distribution::Fixed(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Distribution, E> {
        Ok(Distribution::Fixed(value as f64))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Distribution, A::Error> {
        let table = DistributionTable::deserialize(MapAccessDeserializer::new(map))?;
        match (table.uniform, table.choice, table.points) {
            (Some((low, high)), None, points) => Ok(Distribution::Uniform { low, high, points }),
            (None, Some(values), None) => Ok(Distribution::Choice(values)),
            (None, Some(_), Some(_)) => Err(Error::custom("points belong to uniform, not to choice")),
            (Some(_), Some(_), _) => Err(Error::custom("uniform and choice exclude each other")),
            (None, None, _) => Err(Error::custom("uniform or choice expected")),
        }
    }
}

impl Serialize for Distribution {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let table = |uniform, points, choice| DistributionTable { uniform, points, choice };
        match self {
            Self::Fixed(value) => serializer.serialize_f64(*value),
            Self::Uniform { low, high, points } => {
                table(Some((*low, *high)), *points, None).serialize(serializer)
            }
            Self::Choice(values) => table(None, None, Some(values.clone())).serialize(serializer),
        }
    }
}

impl JsonSchema for Distribution {
    fn schema_name() -> Cow<'static, str> {
        "Distribution".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or the distribution that it is drawn from.",
            "anyOf": [
                {"type": "number"},
                {
                    "type": "object",
                    "properties": {
                        "uniform": {
                            "description": "Uniform between the least and the greatest value.",
                            "type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2
                        },
                        "points": {
                            "description": "Number of values in a grid, both bounds included.",
                            "type": "integer", "minimum": 2, "maximum": MOST_POINTS
                        }
                    },
                    "required": ["uniform"],
                    "additionalProperties": false
                },
                {
                    "type": "object",
                    "properties": {
                        "choice": {
                            "description": "One of these values; a grid takes all.",
                            "type": "array", "items": {"type": "number"}, "minItems": 1, "maxItems": MOST_POINTS
                        }
                    },
                    "required": ["choice"],
                    "additionalProperties": false
                }
            ]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Distribution;
    use scene::random::Key;

    fn read(json: &str) -> Distribution {
        serde_json::from_str(json).unwrap()
    }

    #[test]
    fn numbers_ranges_and_lists_are_read_and_written_alike() {
        for text in [
            "4.0",
            r#"{"uniform":[1.0,3.0]}"#,
            r#"{"uniform":[1.0,3.0],"points":5}"#,
            r#"{"choice":[1.0,9.0]}"#,
        ] {
            assert_eq!(serde_json::to_string(&read(text)).unwrap(), text);
        }
        let wrong = |text: &str| serde_json::from_str::<Distribution>(text).unwrap_err().to_string();
        assert!(wrong("\"4\"").contains("a number, { uniform"), "{}", wrong("\"4\""));
        assert!(wrong(r#"{"unifrom":[1,2]}"#).contains("unknown field `unifrom`"));
        assert!(wrong(r#"{"uniform":[1,2],"choice":[1]}"#).contains("exclude each other"));
        assert!(wrong("{}").contains("uniform or choice expected"));
    }

    #[test]
    fn a_grid_has_both_bounds_and_draws_stay_inside() {
        let range = read(r#"{"uniform":[0.1,0.7],"points":4}"#);
        let points: Vec<f64> = (0..range.points()).map(|place| range.point(place)).collect();
        assert_eq!(points, [0.1, 0.3, 0.5, 0.7]);
        let mut stream = Key::default().number(1).stream();
        let drawn: Vec<f64> = (0..200).map(|_| range.at(stream.unit())).collect();
        assert!(drawn.iter().all(|value| (0.1..=0.7).contains(value)), "{drawn:?}");
        assert!(drawn.iter().any(|value| *value < 0.2) && drawn.iter().any(|value| *value > 0.6));
        let list = read(r#"{"choice":[3,5,8]}"#);
        let drawn: Vec<f64> = (0..50).map(|_| list.at(stream.unit())).collect();
        assert!([3.0, 5.0, 8.0].iter().all(|value| drawn.contains(value)), "{drawn:?}");
    }
}
