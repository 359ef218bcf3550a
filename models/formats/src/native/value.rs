//! Small parts that documents share: points, members of any JSON, rounding.

use crate::problem::{FieldProblem, code};
use crate::refusals::outside;
use scene::Vec2;
use scene::map::Points;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeSeq, Serializer};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt;
use std::marker::PhantomData;

/// Greatest integer that JavaScript holds exactly.
pub const MAX_SAFE_INTEGER: u64 = (1 << 53) - 1;

/// Most members of an object that is keyed by names.
pub const MAX_MEMBERS: usize = 256;

/// One `[x, y]` or `[x, y, z]`, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointDoc {
    /// Metres east.
    pub x: f64,
    /// Metres north.
    pub y: f64,
    /// Metres up, when given.
    pub z: Option<f64>,
}

impl PointDoc {
    /// A point from the domain's position in the plane and height.
    pub fn new(xy: Vec2, z: Option<f64>) -> Self {
        Self { x: xy.x, y: xy.y, z }
    }

    /// Position in the plane.
    pub fn xy(self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }
}

impl<'de> Deserialize<'de> for PointDoc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PointVisitor;
        impl<'de> Visitor<'de> for PointVisitor {
            type Value = PointDoc;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a point of 2 or 3 numbers")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<PointDoc, A::Error> {
                let x = seq.next_element()?.ok_or_else(|| A::Error::invalid_length(0, &self))?;
                let y = seq.next_element()?.ok_or_else(|| A::Error::invalid_length(1, &self))?;
                let z = seq.next_element()?;
                if seq.next_element::<IgnoredAny>()?.is_some() {
                    return Err(A::Error::invalid_length(4, &self));
                }
                Ok(PointDoc { x, y, z })
            }
        }
        deserializer.deserialize_seq(PointVisitor)
    }
}

impl Serialize for PointDoc {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.z {
            None => [self.x, self.y].serialize(serializer),
            Some(z) => [self.x, self.y, z].serialize(serializer),
        }
    }
}

impl JsonSchema for PointDoc {
    fn schema_name() -> Cow<'static, str> {
        "Point".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let coordinate = serde_json::json!({"type": "number", "minimum": -1e4, "maximum": 1e4});
        json_schema!({
            "description": "[x, y] or [x, y, z], metres in the scene frame.",
            "type": "array",
            "prefixItems": [coordinate, coordinate],
            "items": {"type": "number"},
            "minItems": 2,
            "maxItems": 3
        })
    }
}

/// A line or open ring of points, all with or all without a height.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointsDoc(pub Points);

impl<'de> Deserialize<'de> for PointsDoc {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PointsVisitor;
        impl<'de> Visitor<'de> for PointsVisitor {
            type Value = PointsDoc;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of points, all of 2 or all of 3 numbers")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<PointsDoc, A::Error> {
                let mut xy = Vec::new();
                let mut heights = Vec::new();
                while let Some(point) = seq.next_element::<PointDoc>()? {
                    xy.push(point.xy());
                    heights.extend(point.z);
                    if !heights.is_empty() && heights.len() != xy.len() {
                        return Err(A::Error::custom(format_args!(
                            "point {} of a line has another number of coordinates than those before it",
                            xy.len() - 1
                        )));
                    }
                }
                let z_m = (!heights.is_empty()).then_some(heights);
                Ok(PointsDoc(Points { xy, z_m }))
            }
        }
        deserializer.deserialize_seq(PointsVisitor)
    }
}

impl Serialize for PointsDoc {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut seq = serializer.serialize_seq(Some(self.0.xy.len()))?;
        for (i, p) in self.0.xy.iter().enumerate() {
            let z = self.0.z_m.as_ref().map(|z| z.get(i).copied().unwrap_or(0.0));
            seq.serialize_element(&PointDoc::new(*p, z))?;
        }
        seq.end()
    }
}

impl JsonSchema for PointsDoc {
    fn schema_name() -> Cow<'static, str> {
        "Points".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let point = generator.subschema_for::<PointDoc>();
        json_schema!({
            "description": "A line or open ring; all its points have two or all have three numbers.",
            "type": "array",
            "items": point,
            "maxItems": crate::limits::MAX_POLYLINE_POINTS,
            "anyOf": [{"items": {"maxItems": 2}}, {"items": {"minItems": 3}}]
        })
    }
}

/// A JSON object of at most [`MAX_MEMBERS`] members with unique names.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Members<T>(pub BTreeMap<String, T>);

impl<T> Default for Members<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Members<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MembersVisitor<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for MembersVisitor<T> {
            type Value = Members<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Members<T>, A::Error> {
                let mut members = BTreeMap::new();
                while let Some(key) = map.next_key::<String>()? {
                    if members.len() >= MAX_MEMBERS {
                        return Err(A::Error::custom(format_args!("more than {MAX_MEMBERS} members")));
                    }
                    match members.entry(key) {
                        Entry::Vacant(slot) => {
                            slot.insert(map.next_value()?);
                        }
                        Entry::Occupied(slot) => {
                            return Err(A::Error::custom(format_args!("duplicate field `{}`", slot.key())));
                        }
                    }
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(MembersVisitor(PhantomData))
    }
}

impl<T: JsonSchema> JsonSchema for Members<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("MembersOf{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let value = generator.subschema_for::<T>();
        json_schema!({"type": "object", "additionalProperties": value})
    }

    fn inline_schema() -> bool {
        true
    }
}

/// Rounds a server-made length or speed to a millimetre (a second).
pub fn round_m(value: f64) -> f64 {
    (value * 1e3).round() / 1e3 + 0.0
}

/// Rounds a server-made heading to 0.0001 rad and keeps it within [-pi, pi).
#[allow(clippy::approx_constant, reason = "the largest heading of four decimals, not pi")]
pub fn round_rad(value: f64) -> f64 {
    let rounded = (value * 1e4).round() / 1e4 + 0.0;
    if rounded.abs() > std::f64::consts::PI { 3.1415_f64.copysign(rounded) } else { rounded }
}

/// Checks that JavaScript can hold an integer exactly.
pub(crate) fn check_integer(pointer: &str, value: u64) -> Result<u64, FieldProblem> {
    if value <= MAX_SAFE_INTEGER {
        return Ok(value);
    }
    let message = outside(&value.to_string(), "0", &MAX_SAFE_INTEGER.to_string());
    Err(FieldProblem::new(pointer, code::OUT_OF_RANGE, message))
}

/// Schema of an id.
pub(crate) fn id(_: &mut SchemaGenerator) -> Schema {
    json_schema!({"type": "string", "pattern": "^[A-Za-z0-9_.:\\-]{1,64}$"})
}

/// Schema of a list of words, for domain enums that know serde but not schemas.
pub(crate) fn words(list: &[&str]) -> Schema {
    json_schema!({"type": "string", "enum": list})
}
