//! Reads the tables of which scenes consist, row by row; unneeded content is skipped.

use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, what};
use crate::source::without_mark;
use serde::Deserialize;
use serde::de::{DeserializeOwned, Deserializer, SeqAccess, Visitor};
use std::collections::{HashMap, HashSet};
use std::fmt;
use std::io::Read;
use std::marker::PhantomData;

/// Most rows of a table: a third more than in the whole data set.
const MAX_ROWS: usize = 4_000_000;
/// Sensor whose sweep has the time of a sample and the pose of the ego.
const SENSOR: &str = "LIDAR_TOP";

#[derive(Clone, Debug, Deserialize)]
pub(super) struct SceneRow {
    pub token: String,
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub log_token: String,
    pub first_sample_token: String,
}

#[derive(Clone, Debug, Deserialize)]
pub(super) struct SampleRow {
    token: String,
    /// Time, microseconds.
    pub timestamp: i64,
    #[serde(default)]
    pub next: String,
}

#[derive(Clone, Debug, Deserialize)]
pub(super) struct AnnotationRow {
    sample_token: String,
    pub instance_token: String,
    pub translation: [f64; 3],
    /// Width, length and height, metres.
    pub size: [f64; 3],
    /// Quaternion: w, x, y and z.
    pub rotation: [f64; 4],
}

#[derive(Deserialize)]
struct InstanceRow {
    token: String,
    category_token: String,
}

#[derive(Deserialize)]
struct CategoryRow {
    token: String,
    name: String,
}

#[derive(Deserialize)]
struct LogRow {
    token: String,
    #[serde(default)]
    location: String,
}

#[derive(Deserialize)]
struct SampleDataRow {
    sample_token: String,
    ego_pose_token: String,
    #[serde(default)]
    is_key_frame: bool,
    #[serde(default)]
    filename: String,
}

/// Pose of the ego.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct EgoPoseRow {
    token: String,
    pub translation: [f64; 3],
    pub rotation: [f64; 4],
}

/// Tables by their keys.
#[derive(Debug, Default)]
pub(super) struct Tables {
    pub scenes: Vec<SceneRow>,
    pub samples: HashMap<String, SampleRow>,
    /// Annotations by sample.
    pub annotations: HashMap<String, Vec<AnnotationRow>>,
    /// Categories by instance.
    pub categories: HashMap<String, String>,
    /// Locations by log.
    pub locations: HashMap<String, String>,
    /// Poses of the ego by sample.
    pub egos: HashMap<String, EgoPoseRow>,
}

impl Tables {
    /// Reads the tables from files by name (`scene.json` and so on).
    ///
    /// # Errors
    /// `malformed-json` with the table, `cannot-represent` for a table that is missing, `out-of-range` for too many
    /// rows.
    pub fn read(files: &HashMap<String, Vec<u8>>) -> Result<Self, ReadError> {
        let table = |name: &str| {
            let missing = || ReadError::other_content(refusals::zip_without(name, "scene.json"));
            files.get(name).map(Vec::as_slice).ok_or_else(missing)
        };
        let mut tables = Self::default();
        rows(table("scene.json")?, "scene.json", |row| tables.scenes.push(row))?;
        rows(table("sample.json")?, "sample.json", |row: SampleRow| {
            tables.samples.insert(row.token.clone(), row);
        })?;
        rows(table("sample_annotation.json")?, "sample_annotation.json", |row: AnnotationRow| {
            tables.annotations.entry(row.sample_token.clone()).or_default().push(row);
        })?;
        let mut names = HashMap::new();
        rows(table("category.json")?, "category.json", |row: CategoryRow| {
            names.insert(row.token, row.name);
        })?;
        rows(table("instance.json")?, "instance.json", |row: InstanceRow| {
            let name = names.get(&row.category_token).cloned().unwrap_or_default();
            tables.categories.insert(row.token, name);
        })?;
        if let Some(log) = files.get("log.json") {
            rows(log, "log.json", |row: LogRow| {
                tables.locations.insert(row.token, row.location);
            })?;
        }
        if let (Some(data), Some(poses)) = (files.get("sample_data.json"), files.get("ego_pose.json")) {
            tables.egos(data, poses)?;
        }
        Ok(tables)
    }

    fn egos(&mut self, data: &[u8], poses: &[u8]) -> Result<(), ReadError> {
        let mut wanted: HashMap<String, (bool, String)> = HashMap::new();
        rows(data, "sample_data.json", |row: SampleDataRow| {
            let best = row.filename.contains(SENSOR);
            let known = wanted.get(&row.sample_token).is_some_and(|(known, _)| *known || !best);
            if row.is_key_frame && !known {
                wanted.insert(row.sample_token, (best, row.ego_pose_token));
            }
        })?;
        let tokens: HashSet<&String> = wanted.values().map(|(_, token)| token).collect();
        let mut found = HashMap::new();
        rows(poses, "ego_pose.json", |row: EgoPoseRow| {
            if tokens.contains(&row.token) {
                found.insert(row.token.clone(), row);
            }
        })?;
        drop(tokens);
        let pose =
            |(sample, (_, token)): (String, (bool, String))| Some((sample, found.get(&token)?.clone()));
        self.egos = wanted.into_iter().filter_map(pose).collect();
        Ok(())
    }

    /// Samples of a scene, in order.
    pub fn samples_of(&self, scene: &SceneRow) -> Vec<(&str, &SampleRow)> {
        let mut samples: Vec<(&str, &SampleRow)> = Vec::new();
        let mut next = scene.first_sample_token.as_str();
        while let Some((token, row)) = self.samples.get_key_value(next) {
            // A cyclic chain of samples has no end.
            if samples.len() >= self.samples.len() {
                break;
            }
            samples.push((token, row));
            next = &row.next;
        }
        samples
    }
}

/// Passes each row of a table to `take`.
fn rows<T: DeserializeOwned>(bytes: &[u8], table: &str, take: impl FnMut(T)) -> Result<(), ReadError> {
    struct TableRows<T, F>(F, PhantomData<T>);

    impl<'de, T: DeserializeOwned, F: FnMut(T)> Visitor<'de> for TableRows<T, F> {
        type Value = bool;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a list of rows")
        }

        fn visit_seq<A: SeqAccess<'de>>(mut self, mut seq: A) -> Result<bool, A::Error> {
            for _ in 0..MAX_ROWS {
                match seq.next_element()? {
                    Some(row) => (self.0)(row),
                    None => return Ok(true),
                }
            }
            while seq.next_element::<serde::de::IgnoredAny>()?.is_some() {}
            Ok(false)
        }
    }

    let mut json = serde_json::Deserializer::from_reader(without_mark(bytes).take(u64::MAX));
    let read =
        json.deserialize_seq(TableRows(take, PhantomData)).and_then(|whole| json.end().map(|()| whole));
    match read {
        Ok(true) => Ok(()),
        Ok(false) => {
            let message = refusals::more_than(MAX_ROWS, what::ROWS);
            Err(FieldProblem::new(format!("/{table}"), code::OUT_OF_RANGE, message).into())
        }
        Err(error) => Err(ReadError::malformed_json(&error, error.to_string()).under(&format!("/{table}"))),
    }
}
