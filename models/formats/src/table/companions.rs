//! The content of tables beside the tracks: facts about road users by id, and about the recording as a whole.

use super::columns::{ColumnSource, Columns};
use super::names::TableKind;
use super::rows::{Rows, TableFile};
use super::{FRAME_RATE, ORIGIN_X, ORIGIN_Y, PLACE_LATITUDE, PLACE_LONGITUDE, SPEED_LIMIT};
use crate::columnar::ColumnValue;
use crate::problem::{FieldProblem, ImportWarning, ReadError, code, pointer_token};
use crate::projection::UtmZone;
use crate::recording::MAX_USERS;
use crate::refusals::{self, wanted, what};
use scene::Vec2;
use scene::message::Word;
use std::collections::HashMap;
use std::ops::RangeInclusive;

/// Longest text of a cell, bytes.
const MOST_TEXT: usize = 64;

/// A table beside the tracks, with its name.
pub(super) type NamedTable<'a> = (String, TableFile<'a>);

/// Files of one recording.
#[derive(Default)]
pub(super) struct RecordingFiles<'a> {
    /// Name of the scenes if the table has none for them.
    pub name: String,
    pub tracks: Vec<NamedTable<'a>>,
    pub agents: Vec<NamedTable<'a>>,
    pub recording: Vec<NamedTable<'a>>,
    /// Warning about their origin, if any.
    pub told: Option<ImportWarning>,
}

impl RecordingFiles<'_> {
    /// Bytes of its tracks before decompression.
    pub fn encoded_len(&self) -> u64 {
        self.tracks.iter().map(|(_, file)| file.encoded_len()).sum()
    }
}

/// Tables with a row for each road user.
#[derive(Default)]
pub(super) struct AgentsTable {
    /// Columns of it that are read.
    columns: Vec<&'static str>,
    /// Texts of these columns by the id of the road user.
    rows: HashMap<String, Vec<Option<String>>>,
}

impl AgentsTable {
    /// Reads the columns that belong to these tables.
    ///
    /// # Errors
    /// Those of the files, a missing column, `too-many-agents`.
    pub fn read(files: &[NamedTable<'_>], columns: &Columns) -> Result<Self, ReadError> {
        let own = columns.sources.iter().filter(|(_, source)| source.file == TableKind::Agents);
        let own: Vec<(&'static str, &ColumnSource)> = own.map(|(name, source)| (*name, source)).collect();
        let mut table = Self { columns: own.iter().map(|(name, _)| *name).collect(), rows: HashMap::new() };
        let told = columns.files.as_ref().and_then(|files| files.agents_by.as_ref());
        let id = told.or_else(|| columns.sources.get("agent_id")?.column.as_ref());
        for (name, file) in files {
            let here = |error: ReadError| error.under(&format!("/{}", pointer_token(name)));
            let mut rows = Rows::csv(file, None).map_err(here)?;
            let place = |column: &String| rows.names().iter().position(|found| found == column);
            let missing = |column: &str| {
                let message = refusals::no_column(column, &rows.names().join(", "));
                here(ReadError::other_content(message))
            };
            let id = id.and_then(place).ok_or_else(|| missing(id.map_or("", String::as_str)))?;
            let mut places = Vec::new();
            for (_, source) in &own {
                let Some(column) = &source.column else { continue };
                let at = place(column);
                if at.is_none() && !source.optional && source.value.is_none() {
                    return Err(missing(column));
                }
                places.push(at);
            }
            while rows.advance().map_err(here)? {
                let Some(id) = text(rows.value(id)) else { continue };
                let values = places.iter().map(|at| at.and_then(|at| text(rows.value(at)))).collect();
                table.rows.insert(id, values);
                if table.rows.len() > MAX_USERS {
                    let message = refusals::more_than(MAX_USERS, what::ROAD_USERS);
                    return Err(here(FieldProblem::new("", code::TOO_MANY_AGENTS, message).into()));
                }
            }
        }
        Ok(table)
    }

    /// Index of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|own| *own == name)
    }

    /// The text of a road user in a column.
    pub fn value(&self, id: &str, column: usize) -> Option<&str> {
        self.rows.get(id)?.get(column)?.as_deref()
    }
}

/// Facts about the recording as a whole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct RecordingFacts {
    /// Frames per second.
    pub rate_hz: Option<f64>,
    /// Origin of the recording in its zone, metres.
    pub shift: Option<Vec2>,
    pub zone: Option<UtmZone>,
    pub limit_mps: Option<f64>,
}

impl RecordingFacts {
    /// Reads the first row of these tables, and the constants of the columns.
    ///
    /// # Errors
    /// Those of the files, `invalid-field` for an invalid value.
    pub fn read(files: &[NamedTable<'_>], columns: &Columns) -> Result<Self, ReadError> {
        let mut found: HashMap<String, (String, &str)> = HashMap::new();
        for (name, file) in files {
            let here = |error: ReadError| error.under(&format!("/{}", pointer_token(name)));
            let mut rows = Rows::csv(file, None).map_err(here)?;
            if rows.advance().map_err(here)? {
                for (at, column) in rows.names().iter().enumerate() {
                    if let Some(text) = text(rows.value(at)) {
                        found.insert(column.clone(), (text, name));
                    }
                }
            }
        }
        let number = |name: &str, range: RangeInclusive<f64>, expected: Word| {
            let Some(source) = columns.sources.get(name) else { return Ok(None) };
            let cell = source.column.as_ref().and_then(|column| found.get(column));
            let (text, file) = match (cell, &source.value) {
                (Some((text, file)), _) => (text, *file),
                (None, Some(value)) => (value, "columns"),
                (None, None) => return Ok(None),
            };
            let number = text.parse::<f64>().ok().map(|number| number * source.factor + source.offset);
            match number.filter(|number| range.contains(number)) {
                Some(number) => Ok(Some(number)),
                None => {
                    let message = refusals::found_expected(refusals::quoted(text), expected);
                    let column = source.column.as_deref().unwrap_or(name);
                    let pointer = format!("/{}/{}", pointer_token(file), pointer_token(column));
                    Err(ReadError::from(FieldProblem::new(pointer, code::INVALID_FIELD, message)))
                }
            }
        };
        let (metres, degrees) = (-1e8..=1e8, -180.0..=180.0);
        let pair = |a: Option<f64>, b: Option<f64>| a.zip(b);
        let shift = pair(
            number(ORIGIN_X, metres.clone(), wanted::COORDINATE)?,
            number(ORIGIN_Y, metres, wanted::COORDINATE)?,
        );
        let place = pair(
            number(PLACE_LATITUDE, -84.0..=84.0, wanted::DEGREES)?,
            number(PLACE_LONGITUDE, degrees, wanted::DEGREES)?,
        );
        Ok(Self {
            rate_hz: number(FRAME_RATE, 1e-3..=1e6, wanted::FRAME_RATE)?,
            shift: shift.map(|(x, y)| Vec2::new(x, y)),
            // A zone without a shift would put local metres near the equator.
            zone: place.filter(|_| shift.is_some()).map(|(lat, lon)| UtmZone::at(lat, lon)),
            // Some sets have -1 for no limit.
            limit_mps: number(SPEED_LIMIT, -1e3..=150.0, wanted::SPEED)?.filter(|limit| *limit > 0.0),
        })
    }
}

/// The text of a cell; nothing if it is empty or too long.
fn text(value: ColumnValue<'_>) -> Option<String> {
    match value {
        ColumnValue::Text(text) => Some(text.to_owned()).filter(|text| text.len() <= MOST_TEXT),
        _ => None,
    }
}
