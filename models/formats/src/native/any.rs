//! JSON that is kept unchanged: members of other tools, requests, scores.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::fmt;

/// Maximum number of values (numbers, texts, lists, objects) that are kept unchanged: in one member, or in all own
/// members of a scene together.
pub const MAX_VALUES: usize = 50_000;

/// Any JSON, kept unchanged, up to `MOST` values; repeated member names are refused.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct AnyDoc<const MOST: usize = MAX_VALUES>(pub Value);

impl<'de, const MOST: usize> Deserialize<'de> for AnyDoc<MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        AnyValues::up_to(MOST).read().deserialize(deserializer).map(AnyDoc)
    }
}

/// A number of values that may still be kept.
pub(super) struct AnyValues {
    most: usize,
    left: usize,
}

impl AnyValues {
    pub(super) fn up_to(most: usize) -> Self {
        Self { most, left: most }
    }

    /// Reads a member.
    pub(super) fn read(&mut self) -> AnyVisitor<'_> {
        AnyVisitor(self)
    }
}

/// Builds a value and counts down the remaining values.
pub(super) struct AnyVisitor<'a>(&'a mut AnyValues);

impl<'de> DeserializeSeed<'de> for AnyVisitor<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        let most = self.0.most;
        let more = || D::Error::custom(format_args!("more than {most} values that are kept as they are"));
        self.0.left = self.0.left.checked_sub(1).ok_or_else(more)?;
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for AnyVisitor<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any JSON value")
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E: Error>(self, v: bool) -> Result<Value, E> {
        Ok(v.into())
    }

    fn visit_i64<E: Error>(self, v: i64) -> Result<Value, E> {
        Ok(v.into())
    }

    fn visit_u64<E: Error>(self, v: u64) -> Result<Value, E> {
        Ok(v.into())
    }

    fn visit_f64<E: Error>(self, v: f64) -> Result<Value, E> {
        Ok(v.into())
    }

    fn visit_str<E: Error>(self, v: &str) -> Result<Value, E> {
        Ok(v.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = seq.next_element_seed(AnyVisitor(self.0))? {
            list.push(value);
        }
        Ok(Value::Array(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Value, A::Error> {
        let mut members = Map::new();
        while let Some(key) = map.next_key::<String>()? {
            if members.contains_key(&key) {
                return Err(A::Error::custom(format_args!("duplicate field `{key}`")));
            }
            members.insert(key, map.next_value_seed(AnyVisitor(self.0))?);
        }
        Ok(Value::Object(members))
    }
}

impl<const MOST: usize> JsonSchema for AnyDoc<MOST> {
    fn schema_name() -> Cow<'static, str> {
        "Any".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!(true)
    }

    fn inline_schema() -> bool {
        true
    }
}
