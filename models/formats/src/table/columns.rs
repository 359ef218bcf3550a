//! Columns of a table: this program's by their names, those of others by a column file.

use super::names::{FileNames, TableKind};
use super::{
    COLUMNS, FRAME, FRAME_RATE, LATITUDE, LONGITUDE, ORIGIN_X, ORIGIN_Y, PLACE_LATITUDE, PLACE_LONGITUDE,
    SPEED, SPEED_LIMIT,
};
use crate::problem::{FieldProblem, ReadError, code};
use crate::refusals::{self, expected, shown, wanted};
use crate::source::{Source, without_mark};
use crate::unpack::{self, Bounds};
use scene::message::Message;
use serde::Deserialize;
use std::borrow::Borrow;
use std::collections::{BTreeMap, HashSet};
use std::io::Read;

/// Most bytes of a column file.
const MAX_BYTES: u64 = 1 << 20;
/// Member of a column file that describes a wide table, and most columns of one of its parts.
const WIDE: &str = "wide";
const MOST_WIDE: usize = 256;
/// Members that name a public data set, the files of a recording, and the part to read.
const SET: &str = "set";
const FILES: &str = "files";
const ONLY: &str = "only";
/// Most ids of a part.
const MOST_IDS: usize = 10_000;

/// Source of a value.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ColumnSource {
    /// The table that has the column.
    pub file: TableKind,
    /// Name of the column; nothing if every row has the same value.
    pub column: Option<String>,
    /// The value of every row; together with a column, the default for files without the column.
    pub value: Option<String>,
    /// Numbers are `factor * number + offset`.
    pub factor: f64,
    pub offset: f64,
    /// Words of the table and their counterparts here.
    pub words: BTreeMap<String, String>,
    /// Half of this size is added in the direction of the column, or subtracted (-1): positions of corners
    /// and bumpers become positions of centres.
    pub half: Option<(f64, &'static str)>,
    /// Whether files without the column are read too.
    pub optional: bool,
}

/// Sources of values by this program's names.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Columns {
    pub sources: BTreeMap<&'static str, ColumnSource>,
    pub wide: Option<Wide>,
    /// Names of the files of recordings with several files.
    pub files: Option<FileNames>,
    pub only: TablePart,
}

/// The part of a recording that is read.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct TablePart {
    /// First and last time, seconds of the recording.
    pub time_s: Option<(f64, f64)>,
    /// Ids of road users.
    pub agent_id: Option<HashSet<TrackId>>,
}

/// An id in a column file, a text or a whole number.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(from = "TextOrNumber")]
pub(super) struct TrackId(String);

#[derive(Deserialize)]
#[serde(untagged)]
enum TextOrNumber {
    Text(String),
    Number(i64),
}

impl From<TextOrNumber> for TrackId {
    fn from(told: TextOrNumber) -> Self {
        match told {
            TextOrNumber::Text(text) => Self(text),
            TextOrNumber::Number(number) => Self(number.to_string()),
        }
    }
}

impl Borrow<str> for TrackId {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl TablePart {
    /// Whether rows of this road user are read.
    pub fn takes_id(&self, id: &str) -> bool {
        self.agent_id.as_ref().is_none_or(|ids| ids.contains(id))
    }

    /// Whether rows of this time are read.
    pub fn takes_time(&self, time_s: f64) -> bool {
        self.time_s.is_none_or(|(from_s, to_s)| (from_s..=to_s).contains(&time_s))
    }
}

/// A wide table with one row per road user: some columns for it, then groups of columns, one group for each
/// time.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wide {
    pub fixed: usize,
    pub repeated: usize,
}

/// Columns of public data sets, by the word for `--columns`.
pub const PRESETS: [(&str, &str); 9] = [
    ("citysim", include_str!("presets/citysim.json")),
    ("exid", include_str!("presets/exid.json")),
    ("highd", include_str!("presets/highd.json")),
    ("ind", include_str!("presets/ind.json")),
    ("interaction", include_str!("presets/interaction.json")),
    ("ngsim", include_str!("presets/ngsim.json")),
    ("pneuma", include_str!("presets/pneuma.json")),
    ("round", include_str!("presets/round.json")),
    ("sind", include_str!("presets/sind.json")),
];

/// The columns of a data set with this name.
pub fn preset(name: &str) -> Option<&'static str> {
    PRESETS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, text)| *text)
}

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
    #[serde(default)]
    file: TableKind,
    column: Option<String>,
    value: Option<serde_json::Value>,
    unit: Option<String>,
    factor: Option<f64>,
    offset: Option<f64>,
    #[serde(default)]
    words: BTreeMap<String, String>,
    add_half: Option<String>,
    #[serde(default)]
    optional: bool,
}

/// Names that a table of this program may have.
fn own_names() -> impl Iterator<Item = &'static str> {
    COLUMNS.into_iter().chain([SPEED, LATITUDE, LONGITUDE])
}

/// All names that a column file may map.
fn names() -> impl Iterator<Item = &'static str> {
    let others = [FRAME, FRAME_RATE, ORIGIN_X, ORIGIN_Y, PLACE_LATITUDE, PLACE_LONGITUDE, SPEED_LIMIT];
    own_names().chain(others)
}

/// Names that only the table of a recording, or the column file itself, has.
const OF_RECORDING: [&str; 6] =
    [FRAME_RATE, ORIGIN_X, ORIGIN_Y, PLACE_LATITUDE, PLACE_LONGITUDE, SPEED_LIMIT];

const UNITS: &str = "m, ft, cm, km, s, ks, ms, us, ns, rad, deg, m/s, km/h, mph, ft/s";

/// Factor of a unit to metres, seconds, radians and m/s.
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
    /// This program's own names.
    pub fn own() -> Self {
        let own = |name| {
            (name, ColumnSource { column: Some(String::from(name)), factor: 1.0, ..ColumnSource::default() })
        };
        Self { sources: own_names().map(own).collect(), ..Self::default() }
    }

    /// The columns of the public data set that shares most of these names, with the names of all sets that
    /// share as many; nothing if no set has its columns here.
    pub fn recognised(names: &[String]) -> Option<(Self, String)> {
        let found = |column: &String| names.contains(column);
        let mut best: Option<(usize, Self, Vec<&str>)> = None;
        for (set, _) in PRESETS {
            let Ok(columns) = Self::read(&set.as_bytes()) else { continue };
            let told = || {
                let own = own_names().collect::<HashSet<_>>();
                let tracks = columns.sources.values().filter(|source| source.file == TableKind::Tracks);
                tracks.filter(move |source| source.column.as_deref().is_some_and(|name| !own.contains(name)))
            };
            let needed = |source: &&ColumnSource| !source.optional && source.value.is_none();
            if !told().filter(needed).all(|source| source.column.as_ref().is_some_and(found)) {
                continue;
            }
            let count = told().filter_map(|source| source.column.as_ref()).filter(|name| found(name)).count();
            match &mut best {
                Some((most, _, sets)) if *most == count => sets.push(set),
                Some((most, ..)) if *most > count => {}
                _ => best = Some((count, columns, vec![set])),
            }
        }
        best.map(|(_, columns, sets)| (columns, sets.join(", ")))
    }

    /// Columns of a column file, or those of the data set that it names, with this program's names for
    /// unmapped ones.
    ///
    /// # Errors
    /// `malformed-json`, `invalid-field`.
    pub fn read(file: &dyn Source) -> Result<Self, ReadError> {
        let mut bytes = Vec::new();
        let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
        let input = input.and_then(|mut input| input.read_to_end(&mut bytes));
        input.map_err(|error| unpack::fault(&error, 0))?;
        let named = std::str::from_utf8(&bytes).ok().and_then(|text| preset(text.trim().trim_matches('"')));
        let mut columns = Self::own();
        columns.take(named.map_or(bytes.as_slice(), str::as_bytes))?;
        Ok(columns)
    }

    /// Applies the members of a column file.
    fn take(&mut self, text: &[u8]) -> Result<(), ReadError> {
        let malformed = |error: serde_json::Error| ReadError::malformed_json(&error, error.to_string());
        let refused = |name: &str, message: Message| {
            ReadError::from(FieldProblem::new(format!("/{name}"), code::INVALID_FIELD, message))
        };
        let mut told: BTreeMap<String, serde_json::Value> =
            serde_json::from_slice(without_mark(text)).map_err(malformed)?;
        if let Some(set) = told.remove(SET) {
            let found = set.as_str().and_then(preset).ok_or_else(|| {
                let sets = PRESETS.map(|(set, _)| set).join(", ");
                refused(SET, refusals::one_of(&sets))
            })?;
            self.take(found.as_bytes())?;
        }
        if let Some(wide) = told.remove(WIDE) {
            let wide: Wide = serde_json::from_value(wide).map_err(malformed)?;
            if wide.repeated == 0 || wide.fixed.max(wide.repeated) > MOST_WIDE {
                return Err(refused(WIDE, expected(wanted::WIDE_COLUMNS)));
            }
            self.wide = Some(wide);
        }
        if let Some(files) = told.remove(FILES) {
            let read = serde_json::from_value(files).ok().filter(FileNames::can_be);
            self.files = Some(read.ok_or_else(|| refused(FILES, expected(wanted::TABLE_FILES)))?);
        }
        if let Some(only) = told.remove(ONLY) {
            let can_be = |only: &TablePart| {
                only.time_s.is_none_or(|(from_s, to_s)| from_s <= to_s)
                    && only.agent_id.as_ref().is_none_or(|ids| (1..=MOST_IDS).contains(&ids.len()))
            };
            let read = serde_json::from_value(only).ok().filter(can_be);
            self.only = read.ok_or_else(|| refused(ONLY, expected(wanted::TABLE_PART)))?;
        }
        for (name, told) in told {
            let fault = |message: Message| {
                let pointer = format!("/{}", crate::problem::pointer_token(&name));
                ReadError::from(FieldProblem::new(pointer, code::INVALID_FIELD, message))
            };
            let Some(own) = names().find(|own| *own == name) else {
                let all: Vec<_> = names().collect();
                return Err(fault(refusals::one_of(&all.join(", "))));
            };
            let told = serde_json::from_value(told).map_err(|_| fault(expected(wanted::NAME_OR_OBJECT)))?;
            let origin = match told {
                Told::Name(column) => {
                    ColumnSource { column: Some(column), factor: 1.0, ..ColumnSource::default() }
                }
                Told::More(more) => more.origin().map_err(fault)?,
            };
            if OF_RECORDING.contains(&own) && origin.file != TableKind::Recording && origin.column.is_some() {
                return Err(fault(expected(wanted::OF_RECORDING)));
            }
            // The rows of other tables are found by the id.
            if own == "agent_id" && origin.file != TableKind::Tracks {
                return Err(fault(expected(wanted::OF_TRACKS)));
            }
            self.sources.insert(own, origin);
        }
        Ok(())
    }
}

impl More {
    fn origin(self) -> Result<ColumnSource, Message> {
        let unit = match &self.unit {
            None => 1.0,
            Some(unit) => unit_factor(unit).ok_or_else(|| refusals::found_one_of(&shown(unit), UNITS))?,
        };
        let factor = self.factor.unwrap_or(1.0) * unit;
        let offset = self.offset.unwrap_or(0.0);
        if !(factor.is_finite() && offset.is_finite() && factor != 0.0) {
            return Err(expected(wanted::FACTOR));
        }
        let value = match self.value {
            None => None,
            Some(serde_json::Value::String(text)) => Some(text),
            Some(value @ (serde_json::Value::Number(_) | serde_json::Value::Bool(_))) => {
                Some(value.to_string())
            }
            Some(_) => return Err(expected(wanted::TEXT_OR_NUMBER)),
        };
        if self.column.is_none() && value.is_none() {
            return Err(expected(wanted::COLUMN_OR_VALUE));
        }
        let half = match self.add_half.as_deref() {
            None => None,
            Some(size) => {
                let (sign, size) = size.strip_prefix('-').map_or((1.0, size), |size| (-1.0, size));
                let known = ["length_m", "width_m"].into_iter().find(|known| *known == size);
                Some((sign, known.ok_or_else(|| expected(wanted::HALF))?))
            }
        };
        let Self { file, column, words, optional, .. } = self;
        Ok(ColumnSource { file, column, value, factor, offset, words, half, optional })
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
        let columns = read(told).unwrap().sources;
        assert_eq!(columns["agent_id"].column.as_deref(), Some("trackId"));
        assert!((columns["heading_rad"].factor + 0.017_453_292_5).abs() < 1e-9);
        assert_eq!(columns["type"].words["1"], "car");
        assert_eq!(columns["scenario_id"].value.as_deref(), Some("7"));
        assert_eq!(columns["x_m"].column.as_deref(), Some("x_m"));
    }

    #[test]
    fn each_data_set_has_its_columns() {
        for (name, _) in PRESETS {
            let columns = read(name).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(columns, read(&format!("\"{}\"", name.to_uppercase())).unwrap(), "{name}");
            let own = Columns::own();
            let theirs =
                columns.sources.iter().filter(|(name, source)| own.sources.get(*name) != Some(*source));
            assert!(theirs.count() > 4);
        }
        assert_eq!(read("klingon").unwrap_err().code(), "malformed-json");
        assert_eq!(read("pneuma").unwrap().wide, Some(Wide { fixed: 4, repeated: 6 }));
    }

    #[test]
    fn what_cannot_be_is_told() {
        for (text, code, at) in [
            ("[", "malformed-json", ""),
            (r#"{"xx": "a"}"#, "invalid-field", "/xx"),
            (r#"{"x_m": {"unit": "m"}}"#, "invalid-field", "/x_m"),
            (r#"{"x_m": {"file": "attic", "column": "a"}}"#, "invalid-field", "/x_m"),
            (r#"{"agent_id": {"file": "agents", "column": "a"}}"#, "invalid-field", "/agent_id"),
            (r#"{"agent_id": {"file": "recording", "value": "1"}}"#, "invalid-field", "/agent_id"),
            (r#"{"frame_rate_hz": "fps"}"#, "invalid-field", "/frame_rate_hz"),
            (r#"{"set": "klingon"}"#, "invalid-field", "/set"),
            (r#"{"files": {"agents": "*_meta.csv"}}"#, "invalid-field", "/files"),
            (r#"{"files": {"tracks": "a*b*.csv"}}"#, "invalid-field", "/files"),
            (r#"{"only": {"time_s": [5, 1]}}"#, "invalid-field", "/only"),
            (r#"{"x_m": {"column": "a", "unit": "yd"}}"#, "invalid-field", "/x_m"),
            (r#"{"x_m": {"column": "a", "factor": 0}}"#, "invalid-field", "/x_m"),
            (r#"{"x_m": {"column": "a", "add_half": "height_m"}}"#, "invalid-field", "/x_m"),
            (r#"{"wide": {"fixed": 1, "repeated": 0}}"#, "invalid-field", "/wide"),
        ] {
            let error = read(text).unwrap_err();
            assert_eq!((error.code(), error.problems[0].pointer.as_str()), (code, at), "{text}");
        }
    }
}
