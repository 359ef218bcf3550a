//! A scenario in the form of its file.

use crate::limits::{MAX_POLYLINES, MAX_SIGNALS, MAX_STEPS};
use crate::lists::bounded;
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::parser_words;
use crate::source::{Source, unmarked};
use crate::unpack::{self, Bounds};
use serde::de::{Deserializer, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::error::Category;
use std::fmt;

/// Most bytes of a file once decompressed.
const MAX_BYTES: u64 = 64 << 20;
/// Most road users that are read.
pub(super) const MAX_OBJECTS: usize = 2_048;
/// Most points of a line.
const MAX_LINE: usize = 100_000;

/// A place.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(super) struct Point {
    pub x: f64,
    pub y: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
}

/// A road user.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Object {
    #[serde(deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub position: Vec<Point>,
    pub width: f64,
    pub length: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    #[serde(deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub heading: Vec<f64>,
    #[serde(deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub velocity: Vec<Point>,
    #[serde(deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub valid: Vec<bool>,
    #[serde(rename = "goalPosition", default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<Point>,
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<i64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mark_as_expert: Option<bool>,
}

/// A part of the map.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Road {
    #[serde(deserialize_with = "bounded::<_, _, MAX_LINE>")]
    pub geometry: Vec<Point>,
    #[serde(rename = "type")]
    pub kind: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map_element_id: Option<i64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<i64>,
}

/// State of a signal.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Light {
    #[serde(deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub state: Vec<String>,
    #[serde(default, deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub x: Vec<f64>,
    #[serde(default, deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub y: Vec<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub z: Vec<f64>,
    #[serde(default, deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub time_index: Vec<usize>,
    #[serde(default, skip_serializing_if = "Vec::is_empty", deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub lane_id: Vec<i64>,
}

/// A road user with motion to be predicted.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Prediction {
    pub track_index: i64,
    #[serde(default)]
    pub difficulty: u32,
}

/// Metadata of a recording.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(super) struct Metadata {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sdc_track_index: Option<i64>,
    #[serde(default, deserialize_with = "bounded::<_, _, MAX_OBJECTS>")]
    pub objects_of_interest: Vec<i64>,
    #[serde(default, deserialize_with = "bounded::<_, _, MAX_OBJECTS>")]
    pub tracks_to_predict: Vec<Prediction>,
}

/// A file.
#[derive(Debug, Deserialize, Serialize)]
pub(super) struct Document {
    #[serde(default)]
    pub name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scenario_id: Option<String>,
    #[serde(deserialize_with = "bounded::<_, _, MAX_OBJECTS>")]
    pub objects: Vec<Object>,
    #[serde(deserialize_with = "bounded::<_, _, MAX_POLYLINES>")]
    pub roads: Vec<Road>,
    #[serde(default)]
    pub tl_states: Lights,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub metadata: Option<Metadata>,
}

/// Lights by their lane, in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Lights(pub Vec<(String, Light)>);

impl<'de> Deserialize<'de> for Lights {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Each;
        impl<'de> Visitor<'de> for Each {
            type Value = Lights;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of lights by lane")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Lights, A::Error> {
                let mut lights = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    if lights.len() >= MAX_SIGNALS {
                        return Err(serde::de::Error::custom(format_args!("more than {MAX_SIGNALS} lights")));
                    }
                    lights.push(entry);
                }
                Ok(Lights(lights))
            }
        }
        deserializer.deserialize_map(Each)
    }
}

impl Serialize for Lights {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(lane, light)| (lane, light)))
    }
}

/// Reads a file, plain or gzip, from its beginning to its end.
///
/// # Errors
/// `malformed-json` with line and column, `invalid-field` with the place, the bounds of a file.
pub(super) fn read(file: &dyn Source) -> Result<Document, ReadError> {
    let open = || {
        let input =
            file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES))).and_then(unmarked);
        input.map(serde_json::Deserializer::from_reader).map_err(|error| unpack::fault(&error, 0))
    };
    let mut parser = open()?;
    match Document::deserialize(&mut parser).and_then(|document| parser.end().map(|()| document)) {
        Ok(document) => Ok(document),
        Err(error) if error.is_io() => Err(unpack::fault(&error.into(), 0)),
        Err(error) if error.classify() != Category::Data => {
            Err(ReadError::malformed_json(&error, plain(&error)))
        }
        // The parser that tracks places is slower, and runs only for a fault.
        Err(error) => {
            let traced = serde_path_to_error::deserialize::<_, Document>(&mut open()?);
            let pointer = traced.err().map(|error| error.path().to_string()).unwrap_or_default();
            let pointer = pointer.replace('[', ".").replace(']', "");
            let pointer: String =
                pointer.split('.').filter(|part| !part.is_empty()).map(|part| format!("/{part}")).collect();
            Err(FieldProblem::new(pointer, code::INVALID_FIELD, parser_words(&plain(&error))).into())
        }
    }
}

/// The message without its position, which is reported as numbers.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let end = text.rfind(" at line ").unwrap_or(text.len());
    text.get(..end).unwrap_or(&text).chars().take(300).collect()
}
