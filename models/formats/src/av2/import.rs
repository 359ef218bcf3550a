//! Reads the rows of a scenario as a scene.

use super::map::Place;
use super::{AV, CITY, FOCAL, LICENCE, NOTE, SCORED};
use crate::columnar::{ColumnValue, ParquetTable};
use crate::format::EGO;
use crate::limits::MAX_STEPS;
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError, code};
use crate::recording::{MAX_SAMPLES, MAX_USERS, RecordedAgent, RecordedState, Recording, Said, kind_of};
use crate::refusals::{self, wanted, what};
use crate::sentences;
use crate::source::Source;
use scene::message::Word;
use scene::{AgentType, Meta, Origin, STEP_S, Subtype, Timing, Vec2};
use std::collections::HashMap;

/// Required columns and optional columns.
const NEEDED: [&str; 9] = [
    "track_id",
    "object_type",
    "object_category",
    "timestep",
    "position_x",
    "position_y",
    "heading",
    "velocity_x",
    "velocity_y",
];
const OPTIONAL: [&str; 7] = [
    "observed",
    "scenario_id",
    "focal_track_id",
    "city",
    "start_timestamp",
    "end_timestamp",
    "num_timestamps",
];
/// Greatest coordinate, metres.
const MAX_METRES: f64 = 1e7;

/// The columns of a file.
struct TrackRows {
    table: ParquetTable,
    /// Index of each column in the file, by name.
    at: HashMap<&'static str, usize>,
}

impl TrackRows {
    fn open(file: &dyn Source) -> Result<Self, ReadError> {
        let mut table = ParquetTable::open(file)?;
        let place = |name: &str| table.names().iter().position(|found| found == name);
        let mut at = HashMap::new();
        for name in NEEDED {
            let missing = || refusals::no_column(name, &table.names().join(", "));
            at.insert(name, place(name).ok_or_else(|| ReadError::other_content(missing()))?);
        }
        at.extend(OPTIONAL.into_iter().filter_map(|name| Some((name, place(name)?))));
        let mut chosen: Vec<usize> = at.values().copied().collect();
        chosen.sort_unstable();
        let order: HashMap<usize, usize> =
            chosen.iter().enumerate().map(|(i, column)| (*column, i)).collect();
        at.values_mut().for_each(|column| *column = order.get(column).copied().unwrap_or(usize::MAX));
        table.choose(chosen)?;
        Ok(Self { table, at })
    }

    fn value(&self, name: &str) -> ColumnValue<'_> {
        self.at.get(name).map_or(ColumnValue::Nothing, |at| self.table.value(*at))
    }

    fn fault(&self, name: &str, wanted: Word) -> ReadError {
        let pointer = format!("/row/{}/{name}", self.table.row());
        FieldProblem::new(pointer, code::INVALID_FIELD, refusals::expected(wanted)).into()
    }

    fn text(&self, name: &str) -> String {
        match self.value(name) {
            ColumnValue::Text(text) => text.chars().take(256).collect(),
            ColumnValue::Whole(whole) => whole.to_string(),
            _ => String::new(),
        }
    }

    fn number(&self, name: &str, most: f64) -> Result<f64, ReadError> {
        let number = match self.value(name) {
            ColumnValue::Number(number) => number,
            ColumnValue::Whole(whole) => whole as f64,
            _ => f64::NAN,
        };
        let expected = || self.fault(name, wanted::BOUNDED);
        if number.abs() <= most { Ok(number) } else { Err(expected()) }
    }
}

/// Values that are the same in every row, taken from the first.
#[derive(Default)]
struct First {
    scenario: String,
    focal: String,
    city: String,
    steps: usize,
    /// Nanoseconds.
    start: f64,
    end: f64,
}

/// Reads a scenario; `place` is the map of its location.
///
/// # Errors
/// Those of the file, `cannot-represent` for another table or several scenarios, `too-many-agents`.
pub(super) fn read(
    file: &dyn Source,
    place: Option<Place>,
    licence: Option<String>,
) -> Result<Imported, ReadError> {
    let mut rows = TrackRows::open(file)?;
    let mut first: Option<First> = None;
    let (mut users, mut index): (Vec<RecordedAgent>, HashMap<String, usize>) = (Vec::new(), HashMap::new());
    let (mut count, mut last_step, mut now_step) = (0, 0, None);
    let mut predicted = Vec::new();
    while rows.table.advance()? {
        let scenario = rows.text("scenario_id");
        if first.as_ref().is_some_and(|first| first.scenario != scenario) {
            return Err(ReadError::other_content(refusals::expected(wanted::ONE_SCENARIO)));
        }
        first.get_or_insert_with(|| First {
            scenario,
            focal: rows.text("focal_track_id"),
            city: rows.text("city"),
            steps: rows.number("num_timestamps", MAX_STEPS as f64).map_or(0, |steps| steps as usize),
            start: rows.number("start_timestamp", 1e19).unwrap_or(0.0),
            end: rows.number("end_timestamp", 1e19).unwrap_or(0.0),
        });
        let step = rows.number("timestep", MAX_STEPS as f64 - 1.0)?;
        if step < 0.0 || step.fract() != 0.0 {
            return Err(rows.fault("timestep", wanted::WHOLE_FROM_0));
        }
        last_step = last_step.max(step as usize);
        if rows.value("observed") == ColumnValue::Flag(true) {
            now_step = now_step.max(Some(step as usize));
        }
        let id = rows.text("track_id");
        let user = match index.get(&id) {
            Some(user) => *user,
            None => {
                let category = rows.number("object_category", 1e3).unwrap_or(0.0) as i64;
                if matches!(category, SCORED | FOCAL) {
                    predicted.push((id.clone(), 0));
                }
                let kind = kind_of(&rows.text("object_type"));
                let (agent_type, subtype) = kind.unwrap_or((AgentType::Other, Subtype::Unknown));
                let role = (id == AV).then(|| EGO.to_owned());
                let (size_m, samples) = ([None; 3], Vec::new());
                users.push(RecordedAgent { id: id.clone(), agent_type, subtype, role, size_m, samples });
                index.insert(id, users.len() - 1);
                users.len() - 1
            }
        };
        let sample = RecordedState {
            time_s: step * STEP_S,
            at: Vec2::new(rows.number("position_x", MAX_METRES)?, rows.number("position_y", MAX_METRES)?),
            heading_rad: rows.number("heading", 1e6)?,
            velocity: Vec2::new(rows.number("velocity_x", 1e4)?, rows.number("velocity_y", 1e4)?),
            z_m: f64::NAN,
        };
        users.get_mut(user).into_iter().for_each(|user| user.samples.push(sample));
        count += 1;
        let counts = [(count, MAX_SAMPLES, what::ROWS), (users.len(), MAX_USERS, what::TRACKS)];
        if let Some((most, what)) = refusals::exceeded(&counts) {
            let message = refusals::more_than(most, what);
            return Err(FieldProblem::new("", code::TOO_MANY_AGENTS, message).into());
        }
    }
    let first = first.ok_or_else(|| ReadError::other_content(refusals::file_has_no(what::ROW)))?;
    let steps = first.steps.max(last_step + 1);
    let now_step = now_step.unwrap_or(steps / 2).min(steps - 1);
    let origin = origin(&users, now_step);
    let mut warnings = Vec::new();
    let map = match place {
        Some(place) => {
            let (map, found) = place.lane_map(origin);
            warnings = found;
            map
        }
        None => {
            warnings.push(ImportWarning::new("no-map", sentences::map_missing()));
            Default::default()
        }
    };
    // Files written by this program carry their own licence; all others have that of the data set.
    let notes = rows.table.notes();
    let own = if notes.contains_key(NOTE) { notes.get("licence").cloned() } else { Some(LICENCE.into()) };
    let meta = Meta {
        source: "argoverse".into(),
        source_id: Some(first.scenario.clone()).filter(|id| !id.is_empty()),
        licence: licence.or(own),
        tags: Some(first.city.clone())
            .filter(|city| !city.is_empty())
            .map(|city| format!("{CITY}{city}"))
            .into_iter()
            .collect(),
        objects_of_interest: index
            .contains_key(&first.focal)
            .then(|| first.focal.clone())
            .into_iter()
            .collect(),
        tracks_to_predict: predicted,
        timestamps_s: timestamps(&first, steps),
        ..Meta::default()
    };
    let said = Said {
        name: first.scenario,
        meta,
        origin: Some(Origin { x_m: origin.x, y_m: origin.y, ..Origin::default() }),
        start_s: Some(0.0),
        timing: Some(Timing { steps, now_step }),
        spacing_s: Some(STEP_S),
        map: map.into(),
        warnings,
        ..Said::default()
    };
    let mut scenes = Recording { said, users, futures: Vec::new() }.scenes();
    let empty = || ReadError::other_content(refusals::file_has_no(what::ROAD_USER));
    scenes.next().unwrap_or_else(|| Err(empty()))
}

/// Present position of the recording vehicle, otherwise of the first road user, in whole metres.
fn origin(users: &[RecordedAgent], now_step: usize) -> Vec2 {
    let ego = users.iter().find(|user| user.id == AV).or(users.first());
    let now_s = now_step as f64 * STEP_S;
    let near = |a: &&RecordedState, b: &&RecordedState| {
        (a.time_s - now_s).abs().total_cmp(&(b.time_s - now_s).abs())
    };
    let sample = ego.and_then(|user| user.samples.iter().min_by(near));
    sample.map_or_else(Vec2::zeros, |sample| sample.at.map(f64::round))
}

/// Times of the source, evenly spaced from first to last; `None` if they are missing.
fn timestamps(first: &First, steps: usize) -> Option<Vec<f64>> {
    let count = first.steps.max(2) - 1;
    let step_s = (first.end - first.start) * 1e-9 / count as f64;
    // Steps of about 0.1 s.
    let sane = first.start > 0.0 && (step_s - STEP_S).abs() < STEP_S / 4.0;
    sane.then(|| (0..steps).map(|i| first.start * 1e-9 + i as f64 * step_s).collect())
}
