//! Turns a table into scenes: rows of a scenario are contiguous, with its road users in any order.

use super::columns::{ColumnSource, Columns};
use super::companions::{AgentsTable, NamedTable, RecordingFacts, RecordingFiles};
use super::gathered::Gathered;
use super::names::TableKind;
use super::notes::{KEY, Notes};
use super::rows::{Rows, TableFile};
use super::write::plain;
use super::{FRAME, FRAME_RATE, GENERATED, LATITUDE, LOG, LONGITUDE, SPEED};
use crate::columnar::ColumnValue;
use crate::format::{COLUMNS_POINTER, ImportOptions};
use crate::limits::MAX_STEPS;
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError, code, pointer_token};
use crate::projection::TransverseMercator;
use crate::recording::{RecordedAgent, RecordedFuture, RecordedState, Said, kind_of};
use crate::refusals::{self, wanted, what};
use crate::sentences;
use crate::underlay::{self, Placing};
use scene::geometry::direction;
use scene::message::Word;
use scene::{AgentType, Meta, Origin, STEP_S, Subtype, Vec2};
use std::borrow::Cow;
use std::collections::hash_map::DefaultHasher;
use std::collections::{BTreeMap, HashSet};
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// Greatest coordinate, metres, and greatest time, seconds (a clock in nanoseconds is refused).
const MAX_METRES: f64 = 1e9;
const MAX_SECONDS: f64 = 1e11;
/// Bytes of an id.
const MAX_ID: usize = 256;
/// A recording whose coordinates stay within this distance of its origin keeps its frame, metres.
const OWN_FRAME_M: f64 = 1_000.0;

/// A column that is read.
struct Picked {
    at: ColumnPlace,
    origin: ColumnSource,
}

/// Source of the values of a column.
#[derive(Clone, Copy)]
enum ColumnPlace {
    /// Every row has the value of the column file.
    Everywhere,
    /// This column of the rows.
    Row(usize),
    /// This column of the table of road users.
    Agent(usize),
}

/// Scenes of a recording, scenario after scenario.
pub(super) struct Scenarios<'a> {
    rows: Rows<'a>,
    /// Remaining tables of tracks, the next one last, and the name of the current one.
    tracks: Vec<NamedTable<'a>>,
    file: String,
    told: Columns,
    columns: BTreeMap<&'static str, Picked>,
    agents: Option<AgentsTable>,
    facts: RecordingFacts,
    /// Name of scenes without a name in the table.
    called: String,
    /// Warnings from opening the files.
    warnings: Vec<ImportWarning>,
    options: &'a ImportOptions,
    notes: Notes,
    gathered: Option<Gathered>,
    /// Finished scenarios, by hash.
    ended: HashSet<u64>,
    ready: Option<Box<dyn Iterator<Item = Result<Imported, ReadError>>>>,
    /// Bytes of the tracks, which limit the rows in memory.
    encoded: u64,
    /// The current row is read but not yet assigned to a scene.
    pending: bool,
    given: bool,
    over: bool,
}

/// Finds the columns of a table of tracks.
fn pick(
    names: &[String],
    told: &Columns,
    agents: Option<&AgentsTable>,
) -> Result<BTreeMap<&'static str, Picked>, ReadError> {
    let mut picked = BTreeMap::new();
    for (name, origin) in &told.sources {
        let in_row = || names.iter().position(|found| Some(found) == origin.column.as_ref());
        let place = match (origin.file, &origin.column, agents) {
            (TableKind::Recording, ..) => continue,
            (_, None, _) => Some(ColumnPlace::Everywhere),
            (TableKind::Agents, Some(_), Some(agents)) => agents.column(name).map(ColumnPlace::Agent),
            // Some users merge the tables of a recording into one.
            _ => in_row().map(ColumnPlace::Row),
        };
        let place = place.or_else(|| origin.value.as_ref().map(|_| ColumnPlace::Everywhere));
        match (place, &origin.column) {
            (Some(at), _) => {
                picked.insert(*name, Picked { at, origin: origin.clone() });
            }
            // A column named by the user must exist.
            (None, Some(column))
                if column != name && !origin.optional && origin.file == TableKind::Tracks =>
            {
                let message = refusals::no_column(column, &shown(names));
                let pointer = format!("{COLUMNS_POINTER}/{name}");
                return Err(FieldProblem::new(pointer, code::INVALID_FIELD, message).into());
            }
            (None, _) => {}
        }
    }
    let has = |name: &str| picked.contains_key(name);
    let on_globe = has(LATITUDE) && has(LONGITUDE);
    let places = ["x_m", "y_m"].into_iter().filter(|_| !on_globe);
    let needed = std::iter::once("agent_id").chain(places).filter(|name| !has(name));
    let mut missing: Vec<&str> = needed.collect();
    if !(has("time_s") || has("step") || has(FRAME)) {
        missing.push("time_s or step");
    }
    if missing.is_empty() {
        return Ok(picked);
    }
    Err(ReadError::other_content(sentences::columns_missing(&missing.join(", "), &shown(names))))
}

/// Reports missing tables of a recording that would add to its tracks.
fn missing_tables(files: &RecordingFiles<'_>, told: &Columns) -> Vec<ImportWarning> {
    let told_of = |kind| told.sources.values().any(|source| source.file == kind && source.column.is_some());
    let kinds = [
        (TableKind::Agents, files.agents.is_empty(), sentences::agents_table_missing()),
        (TableKind::Recording, files.recording.is_empty(), sentences::recording_table_missing()),
    ];
    let missing = kinds.into_iter().filter(|(kind, lacks, _)| *lacks && told_of(*kind));
    missing.map(|(.., message)| ImportWarning::new("tables-missing", message)).collect()
}

/// A fault of a file of this name.
fn within(error: ReadError, name: &str) -> ReadError {
    if name.is_empty() { error } else { error.under(&format!("/{}", pointer_token(name))) }
}

impl<'a> Scenarios<'a> {
    pub fn open(
        mut files: RecordingFiles<'a>,
        options: &'a ImportOptions,
        parquet: bool,
    ) -> Result<Self, ReadError> {
        let mut told = match &options.columns {
            Some(file) => Columns::read(file).map_err(|error| error.under(COLUMNS_POINTER))?,
            None => Columns::own(),
        };
        let encoded = files.encoded_len();
        files.tracks.reverse();
        let (name, first) =
            files.tracks.pop().ok_or_else(|| ReadError::other_content(refusals::file_has_no(what::ROW)))?;
        let open = |wide| match (&first, parquet) {
            (TableFile::Given(file), true) => Rows::parquet(*file),
            _ => Rows::csv(&first, wide),
        };
        let mut rows = open(told.wide).map_err(|error| within(error, &name))?;
        let mut warnings: Vec<ImportWarning> = files.told.take().into_iter().collect();
        if options.columns.is_none()
            && pick(rows.names(), &told, None).is_err()
            && let Some((columns, sets)) = Columns::recognised(rows.names())
        {
            warnings.push(ImportWarning::new("columns-recognised", sentences::columns_recognised(&sets)));
            if columns.wide.is_some() {
                rows = open(columns.wide).map_err(|error| within(error, &name))?;
            }
            told = columns;
        }
        let agents = match files.agents.as_slice() {
            [] => None,
            tables => Some(AgentsTable::read(tables, &told)?),
        };
        let facts = RecordingFacts::read(&files.recording, &told)?;
        warnings.extend(missing_tables(&files, &told));
        let mut scenarios = Self {
            rows,
            tracks: files.tracks,
            file: name,
            told,
            columns: BTreeMap::new(),
            agents,
            facts,
            called: files.name,
            warnings,
            options,
            notes: Notes::default(),
            gathered: None,
            ended: HashSet::new(),
            ready: None,
            encoded,
            pending: false,
            given: false,
            over: false,
        };
        scenarios.begin_table().map_err(|error| within(error, &scenarios.file))?;
        // Notes of another program under our key are ignored.
        let notes = scenarios.rows.notes();
        scenarios.notes = notes.get(KEY).and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default();
        Ok(scenarios)
    }

    /// Finds the columns of the table that was opened.
    fn begin_table(&mut self) -> Result<(), ReadError> {
        self.columns = pick(self.rows.names(), &self.told, self.agents.as_ref())?;
        let has = |name: &str| self.columns.contains_key(name);
        if has(FRAME) && !has("time_s") && !has("step") && self.facts.rate_hz.is_none() {
            let pointer = format!("{COLUMNS_POINTER}/{FRAME_RATE}");
            let message = refusals::expected(wanted::FRAME_RATE);
            return Err(FieldProblem::new(pointer, code::INVALID_FIELD, message).into());
        }
        let chosen = self.columns.values().filter_map(|picked| match picked.at {
            ColumnPlace::Row(at) => Some(at),
            ColumnPlace::Everywhere | ColumnPlace::Agent(_) => None,
        });
        self.rows.choose(chosen.collect())
    }

    /// Advances to the next row, or the next table after the last one; false at the end.
    fn advance(&mut self) -> Result<bool, ReadError> {
        while !self.rows.advance()? {
            let Some((name, next)) = self.tracks.pop() else { return Ok(false) };
            self.file = name;
            self.rows = Rows::csv(&next, self.told.wide)?;
            self.begin_table()?;
        }
        Ok(true)
    }

    fn value(&self, name: &str) -> ColumnValue<'_> {
        let Some(picked) = self.columns.get(name) else { return ColumnValue::Nothing };
        let everywhere = || picked.origin.value.as_deref();
        let text = match (picked.at, &self.agents) {
            (ColumnPlace::Row(at), _) => return self.rows.value(at),
            (ColumnPlace::Agent(at), Some(agents)) => {
                let id = self.text("agent_id");
                id.and_then(|id| agents.value(&id, at)).or_else(everywhere)
            }
            (ColumnPlace::Everywhere | ColumnPlace::Agent(_), _) => everywhere(),
        };
        text.map_or(ColumnValue::Nothing, ColumnValue::Text)
    }

    fn text(&self, name: &str) -> Option<Cow<'_, str>> {
        let text = match self.value(name) {
            ColumnValue::Nothing => return None,
            ColumnValue::Text(text) => Cow::Borrowed(text),
            ColumnValue::Whole(whole) => Cow::Owned(whole.to_string()),
            ColumnValue::Number(number) => Cow::Owned(number.to_string()),
            ColumnValue::Flag(flag) => Cow::Owned(flag.to_string()),
        };
        let words = self.columns.get(name).map(|picked| &picked.origin.words);
        let text = match text {
            Cow::Borrowed(text) => Cow::Borrowed(plain(text)),
            owned => owned,
        };
        match words.and_then(|words| words.get(text.as_ref())) {
            Some(word) => Some(Cow::Borrowed(word)),
            None => Some(text).filter(|text| !text.is_empty()),
        }
    }

    fn fault(&self, name: &str, found: &str, wanted: Word) -> ReadError {
        let message = match found {
            "" => refusals::expected(wanted),
            found => refusals::found_expected(refusals::quoted(found), wanted),
        };
        let pointer = format!("/{}/{name}", self.rows.place().replace(' ', "/"));
        FieldProblem::new(pointer, code::INVALID_FIELD, message).into()
    }

    /// A number in our unit; NaN if it is missing.
    fn number(&self, name: &str, most: f64, expected: Word) -> Result<f64, ReadError> {
        let number = match self.value(name) {
            ColumnValue::Nothing => return Ok(f64::NAN),
            ColumnValue::Whole(whole) => whole as f64,
            ColumnValue::Number(number) if number.is_nan() => return Ok(f64::NAN),
            ColumnValue::Number(number) => number,
            ColumnValue::Flag(flag) => f64::from(u8::from(flag)),
            ColumnValue::Text(text) if is_missing(text) => return Ok(f64::NAN),
            ColumnValue::Text(text) => {
                let number = text.parse::<f64>();
                number.map_err(|_| self.fault(name, text, expected))?
            }
        };
        let number = self.columns.get(name).map_or(number, |picked| {
            let ColumnSource { factor, offset, .. } = picked.origin;
            if (factor, offset) == (1.0, 0.0) { number } else { number * factor + offset }
        });
        if number.is_finite() && number.abs() <= most {
            Ok(number)
        } else {
            Err(self.fault(name, &number.to_string(), expected))
        }
    }

    fn flag(&self, name: &str) -> Option<bool> {
        match self.value(name) {
            ColumnValue::Nothing => None,
            ColumnValue::Flag(flag) => Some(flag),
            ColumnValue::Whole(whole) => Some(whole != 0),
            ColumnValue::Number(number) => Some(number != 0.0),
            ColumnValue::Text(text) => Some(!matches!(text, "0" | "false" | "False" | "FALSE" | "0.0")),
        }
    }

    /// Adds the current row.
    fn add(&mut self) -> Result<(), ReadError> {
        let Some(mut gathered) = self.gathered.take() else { return Ok(()) };
        let added = self.add_to(&mut gathered);
        self.gathered = Some(gathered);
        added
    }

    fn add_to(&self, to: &mut Gathered) -> Result<(), ReadError> {
        let id = self.text("agent_id").ok_or_else(|| self.fault("agent_id", "", wanted::ID))?;
        if id.len() > MAX_ID {
            return Err(self.fault("agent_id", &id, wanted::ID_BYTES));
        }
        if !self.told.only.takes_id(&id) {
            return Ok(());
        }
        let step = self.number("step", 1e9, wanted::STEP)?;
        let mut time_s = self.number("time_s", MAX_SECONDS, wanted::TIME)?;
        if let (true, Some(rate_hz)) = (time_s.is_nan(), self.facts.rate_hz) {
            time_s = self.number(FRAME, MAX_SECONDS, wanted::STEP)? / rate_hz;
        }
        if time_s.is_nan() {
            time_s = step * STEP_S;
        }
        if time_s.is_nan() {
            return Err(self.fault("time_s", "", wanted::TIME_OR_STEP));
        }
        if !(self.told.only.takes_time(time_s) && to.takes_time(time_s)) {
            return Ok(());
        }
        to.aligned &= step >= 0.0 && (time_s - step * STEP_S).abs() < 1e-3;
        to.last_step = to.last_step.max(step);
        let sample = self.sample(time_s, to)?;
        let user = match to.user(&id) {
            Some(user) => user,
            None => {
                let user = self.user(&id, to)?;
                to.add_user(user)
            }
        };
        let list = match self.future()? {
            None => to.recording.users.get_mut(user).map(|user| &mut user.samples),
            Some((sample, mode)) => {
                let next = to.recording.futures.len();
                let at = *to.futures.entry((user, sample, mode)).or_insert(next);
                if at == next {
                    let probability = self.number("probability", 1.0, wanted::PROBABILITY)?;
                    to.recording.futures.push(RecordedFuture {
                        user,
                        sample,
                        mode,
                        probability: (probability >= 0.0).then_some(probability),
                        chosen: self.flag("chosen") == Some(true),
                        samples: Vec::new(),
                    });
                }
                to.recording.futures.get_mut(at).map(|future| &mut future.samples)
            }
        };
        if let Some(list) = list {
            list.push(sample);
        }
        to.bound(self.encoded)
    }

    /// Half of the size that a column adds, in its direction, metres.
    fn half(&self, name: &str) -> Result<f64, ReadError> {
        let Some(ColumnSource { half: Some((sign, size)), factor, .. }) =
            self.columns.get(name).map(|picked| &picked.origin)
        else {
            return Ok(0.0);
        };
        let size_m = self.number(size, 1e4, wanted::SIZE)?;
        Ok(if size_m.is_nan() { 0.0 } else { sign * factor.signum() * size_m / 2.0 })
    }

    /// The position of a row, metres; NaN if it is missing.
    fn place(&self, to: &mut Gathered) -> Result<Vec2, ReadError> {
        let [lat, lon] =
            [self.number(LATITUDE, 89.0, wanted::DEGREES)?, self.number(LONGITUDE, 180.0, wanted::DEGREES)?];
        if lat.is_nan() || lon.is_nan() {
            let metres = |name| {
                Ok::<_, ReadError>(self.number(name, MAX_METRES, wanted::COORDINATE)? + self.half(name)?)
            };
            let own = Vec2::new(metres("x_m")?, metres("y_m")?);
            to.farthest_m = to.farthest_m.max(own.amax());
            return Ok(own + self.facts.shift.unwrap_or_default());
        }
        // About the first position: the following rows are not known yet.
        if to.projection.is_none() {
            to.projection = TransverseMercator::about(std::iter::once((lat, lon)));
        }
        Ok(to
            .projection
            .map_or_else(|| Vec2::new(f64::NAN, f64::NAN), |projection| projection.metres(lat, lon)))
    }

    fn sample(&self, time_s: f64, to: &mut Gathered) -> Result<RecordedState, ReadError> {
        let metres = |name| self.number(name, MAX_METRES, wanted::COORDINATE);
        let nothing = Vec2::new(f64::NAN, f64::NAN);
        let (heading_rad, z_m) = (self.number("heading_rad", 1e6, wanted::HEADING)?, metres("z_m")?);
        let unseen = RecordedState { time_s, at: nothing, heading_rad, velocity: nothing, z_m };
        if self.flag("valid") == Some(false) {
            return Ok(unseen);
        }
        let at = self.place(to)?;
        if at.iter().any(|value| value.is_nan()) {
            let name = if at.x.is_nan() { "x_m" } else { "y_m" };
            return Err(self.fault(name, "", wanted::COORDINATE_OR_INVALID));
        }
        let mps = |name| self.number(name, 1e4, wanted::VELOCITY);
        let mut velocity = Vec2::new(mps("vx_mps")?, mps("vy_mps")?);
        if velocity.iter().any(|value| value.is_nan()) {
            velocity = direction(heading_rad) * mps(SPEED)?;
        }
        Ok(RecordedState { at, velocity, ..unseen })
    }

    fn user(&self, id: &str, to: &mut Gathered) -> Result<RecordedAgent, ReadError> {
        let metres = |name| {
            let metres = self.number(name, 1e4, wanted::SIZE)?;
            // Sets that do not measure the box of a road user give it none.
            Ok::<_, ReadError>((metres > 0.0).then_some(metres))
        };
        let word = self.text("type");
        let (agent_type, mut subtype) = match &word {
            None => {
                to.untyped = true;
                (AgentType::Vehicle, Subtype::Unknown)
            }
            Some(word) => kind_of(word).unwrap_or_else(|| {
                to.unknown_words += 1;
                (AgentType::Other, Subtype::Unknown)
            }),
        };
        if let Some((_, finer)) = self.text("subtype").and_then(|word| kind_of(&word)) {
            subtype = finer;
        }
        Ok(RecordedAgent {
            id: id.to_owned(),
            agent_type,
            subtype,
            role: None,
            size_m: [metres("length_m")?, metres("width_m")?, metres("height_m")?],
            samples: Vec::new(),
        })
    }

    /// Sample and mode of a row that is part of a future.
    fn future(&self) -> Result<Option<(u64, u64)>, ReadError> {
        let number = |name| {
            let number = self.number(name, 1e6, wanted::FUTURE)?;
            Ok::<_, ReadError>(if number >= 0.0 { number as u64 } else { 0 })
        };
        match self.text("source").as_deref() {
            Some(LOG) => Ok(None),
            Some(GENERATED) => Ok(Some((number("sample")?, number("mode")?))),
            // A table without a `source` column has modes only for futures.
            _ => {
                let mode = self.number("mode", 1e6, wanted::FUTURE)?;
                if mode.is_nan() { Ok(None) } else { Ok(Some((number("sample")?, number("mode")?))) }
            }
        }
    }

    /// Builds the scenes of the gathered rows.
    fn finish(&mut self) {
        let Some(mut gathered) = self.gathered.take() else { return };
        let mut hasher = DefaultHasher::new();
        gathered.name.hash(&mut hasher);
        self.ended.insert(hasher.finish());
        let note = self.notes.scenes.iter().find(|note| note.scenario_id == gathered.name);
        let name = if gathered.name.is_empty() { &self.called } else { &gathered.name };
        let mut said = Said { name: name.clone(), warnings: self.warnings.clone(), ..Said::default() };
        said.warnings.extend(gathered.left_out());
        said.meta =
            note.map_or_else(|| Meta { source: "table".into(), ..Meta::default() }, |note| note.meta());
        if let Some(note) = note {
            said.origin = note.origin();
            said.timing = Some(note.timing());
            for user in &mut gathered.recording.users {
                user.role = note.roles.get(&user.id).cloned();
            }
        }
        if let Some(licence) = &self.options.licence {
            said.meta.licence = Some(licence.clone());
        }
        // Tables of this program count steps from the scene's first step, even if no road user is seen then.
        if gathered.aligned && (gathered.last_step as usize) < 2 * MAX_STEPS {
            said.start_s = Some(0.0);
        }
        if gathered.untyped {
            said.warnings.push(ImportWarning::new("types-assumed", sentences::types_assumed()));
        }
        if gathered.unknown_words > 0 {
            let message = sentences::types_unknown(gathered.unknown_words);
            said.warnings.push(ImportWarning::new("types-unknown", message));
        }
        let zone = self.facts.zone.map(|zone| zone.name());
        said.crs = zone.or_else(|| gathered.projection.map(|projection| projection.name()));
        let shift = self.facts.shift;
        // A small recording keeps its own frame.
        if let (Some(at), true) = (shift, gathered.farthest_m <= OWN_FRAME_M) {
            said.origin = Some(Origin { x_m: at.x, y_m: at.y, crs: said.crs.clone(), ..Origin::default() });
        }
        gathered.recording.said = said;
        let (ground, placing) =
            (Arc::clone(&self.options.ground), Placing { shift, limit_mps: self.facts.limit_mps });
        let lay = move |read: Imported| underlay::lay(read, &ground, placing);
        self.ready = Some(Box::new(gathered.recording.scenes().map(move |read| read.and_then(&lay))));
    }

    /// Reads to the end of the scenario.
    fn read(&mut self) -> Result<(), ReadError> {
        loop {
            if !self.pending && !self.advance()? {
                self.over = true;
                self.finish();
                return Ok(());
            }
            self.pending = false;
            let name = self.text("scenario_id").unwrap_or_default();
            if self.gathered.as_ref().is_some_and(|gathered| gathered.name != name) {
                self.pending = true;
                self.finish();
                return Ok(());
            }
            if self.gathered.is_none() {
                let name = name.into_owned();
                let mut hasher = DefaultHasher::new();
                name.hash(&mut hasher);
                if name.len() > MAX_ID || self.ended.contains(&hasher.finish()) {
                    return Err(self.fault("scenario_id", &name, wanted::SCENARIO_ROWS));
                }
                self.gathered = Some(Gathered::new(name));
            }
            self.add()?;
        }
    }
}

/// Whether a text stands for a missing value.
fn is_missing(text: &str) -> bool {
    matches!(text, "" | "nan" | "NaN" | "NA" | "null" | "None")
}

fn shown(names: &[String]) -> String {
    let mut list: Vec<String> = names.iter().take(40).map(|name| name.chars().take(40).collect()).collect();
    if names.len() > 40 {
        list.push("...".into());
    }
    list.join(", ")
}

impl Iterator for Scenarios<'_> {
    type Item = Result<Imported, ReadError>;

    /// After a fault of the file nothing follows.
    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(scene) = self.ready.as_mut().and_then(Iterator::next) {
                self.given = true;
                return Some(scene);
            }
            self.ready = None;
            if self.over {
                let empty = ReadError::other_content(refusals::file_has_no(what::ROW));
                return (!std::mem::replace(&mut self.given, true)).then_some(Err(empty));
            }
            if let Err(error) = self.read() {
                (self.over, self.given) = (true, true);
                self.gathered = None;
                return Some(Err(within(error, &self.file)));
            }
        }
    }
}
