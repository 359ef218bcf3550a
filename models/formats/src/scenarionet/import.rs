//! Converts the dictionary of a scenario to a scene.

use super::import_map;
use super::machine;
use super::value::{Pickle, PickleValue};
use super::words::{agent_type, signal_state};
use crate::describe;
use crate::format::{EGO, ImportOptions};
use crate::headings::{self, HeadingUnit};
use crate::limits::{MAX_SIGNALS, MAX_STEPS};
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError, code};
use crate::refusals::{at_most, expected, wanted, what};
use crate::sentences::{self, subject};
use crate::settle::{self, Ids};
use crate::source::Source;
use crate::unpack::{self, Bounds};
use scene::message::Message;
use scene::sentences::state_expected;
use scene::{
    Agent, Meta, Origin, STEP_S, Scene, Signal, SignalState, Size, State, Subtype, Timing, Track, Vec2,
};
use std::collections::{BTreeMap, HashMap};
use std::io::Read;

/// Most bytes of a file once decompressed.
const MAX_BYTES: u64 = 64 << 20;
/// Most road users that are read.
const MAX_TRACKS: usize = 2_048;
/// Least side of a box, metres.
const LEAST_SIZE_M: f64 = 0.05;
/// Key of the dictionary of this program in the metadata.
pub(super) const OWN: &str = "dragtraffic";

fn invalid(pointer: &str, message: Message) -> ReadError {
    FieldProblem::new(pointer, code::INVALID_FIELD, message).into()
}

/// Reads a file, plain or gzip.
///
/// # Errors
/// Those of the pickle machine and of the file; `cannot-represent` for a pickle of another kind, `invalid-field`,
/// and the faults of a scene.
pub(super) fn read(file: &dyn Source, options: &ImportOptions) -> Result<Imported, ReadError> {
    let mut bytes = Vec::new();
    let opened = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_BYTES)));
    let read = opened.and_then(|mut input| input.read_to_end(&mut bytes));
    read.map_err(|error| unpack::fault(&error, bytes.len() as u64))?;
    let pickle = machine::read(&bytes)?;
    drop(bytes);
    let root = &pickle.root;
    let (Some(tracks), Some(features)) = (pickle.get(root, "tracks"), pickle.get(root, "map_features"))
    else {
        return Err(other_sort(&pickle));
    };
    let mut warnings = Vec::new();
    let nothing = PickleValue::None;
    let metadata = pickle.get(root, "metadata").unwrap_or(&nothing);
    let steps = steps(&pickle, tracks)?;
    let own = pickle.get(metadata, OWN).unwrap_or(&nothing);
    let (mut agents, ids) = agents(&pickle, tracks, metadata, steps, &mut warnings)?;
    warnings.extend(headings::settle(&mut agents, HeadingUnit::Radians));
    let map = import_map::lane_map(&pickle, features, &mut warnings)?;
    let lights = pickle.get(root, "dynamic_map_states").unwrap_or(&nothing);
    let signals = signals(&pickle, lights, steps, &mut warnings)?;
    let text = |from: &PickleValue, key: &str| pickle.get(from, key).and_then(|value| pickle.text(value));
    let id = text(root, "id").or_else(|| text(metadata, "scenario_id")).unwrap_or_default();
    let id: String = id.chars().take(scene::MAX_NAME_CHARS).collect();
    let source =
        text(own, "source").or_else(|| text(metadata, "dataset")).unwrap_or_else(|| "scenarionet".into());
    let now =
        ["current_time_index", "now_step"].iter().find_map(|key| pickle.whole(pickle.get(metadata, key)?));
    // Recordings of the Waymo data set have 1 s of history.
    let now = now.and_then(|now| usize::try_from(now).ok()).unwrap_or(if steps == 91 { 10 } else { 0 });
    let timestamps_s = timestamps(&pickle, metadata, steps, &mut warnings);
    let number =
        |key: &str| pickle.get(own, key).and_then(|value| pickle.number(value)).filter(|v| v.is_finite());
    let origin = Origin {
        x_m: number("origin_x_m").unwrap_or(0.0),
        y_m: number("origin_y_m").unwrap_or(0.0),
        z_m: number("origin_z_m").unwrap_or(0.0),
        rotation_rad: number("origin_rotation_rad").unwrap_or(0.0),
        crs: text(own, "origin_crs"),
    };
    let texts = |key: &str| -> Vec<String> {
        let list = pickle.get(own, key).and_then(|value| pickle.items(value)).unwrap_or_default();
        list.iter().take(64).filter_map(|value| pickle.text(value)).collect()
    };
    let interest =
        pickle.get(metadata, "objects_of_interest").and_then(|value| pickle.items(value)).unwrap_or_default();
    let known = |value: &PickleValue| ids.get(&pickle.text(value)?).cloned();
    let licence = text(own, "licence");
    if matches!(pickle.get(metadata, "metadrive_processed"), Some(PickleValue::Bool(true))) {
        warnings.push(ImportWarning::new("frame-moved", sentences::moved_by_metadrive()));
    }
    let scene = Scene {
        id: None,
        name: text(own, "name").unwrap_or_else(|| id.clone()),
        meta: describe::fitted(Meta {
            source,
            source_id: Some(id).filter(|id| !id.is_empty()),
            licence,
            origin,
            tags: texts("tags"),
            notes: text(own, "notes").unwrap_or_default(),
            objects_of_interest: interest.iter().take(MAX_TRACKS).filter_map(known).collect(),
            tracks_to_predict: predictions(&pickle, metadata, &ids),
            timestamps_s,
            ..Meta::default()
        })?,
        time: Timing { steps, now_step: now.min(steps.saturating_sub(1)) },
        map: scene::LaneMap::default().into(),
        signals,
        agents,
        generated: None,
        extra: BTreeMap::new(),
    };
    settle::settled(scene, map, warnings, options)
}

/// The refusal of a pickle with other content.
fn other_sort(pickle: &Pickle) -> ReadError {
    let entries = pickle.entries(&pickle.root);
    let of_files = |entries: &[(PickleValue, PickleValue)]| {
        entries
            .iter()
            .take(8)
            .any(|(name, _)| matches!(name, PickleValue::Text(text) if text.ends_with(".pkl")))
    };
    let files = entries.is_some_and(of_files);
    ReadError::other_content(expected(if files { wanted::SCENARIO_FILES } else { wanted::SCENARIO }))
}

/// Number of steps: that of the longest track.
fn steps(pickle: &Pickle, tracks: &PickleValue) -> Result<usize, ReadError> {
    let all = pickle.entries(tracks).ok_or_else(|| invalid("/tracks", expected(wanted::DICTIONARY)))?;
    let stated = pickle.get(&pickle.root, "length").and_then(|value| pickle.whole(value)).unwrap_or(0);
    let length = |track: &PickleValue| {
        let position = pickle.get(pickle.get(track, "state")?, "position")?;
        pickle
            .array(position)
            .and_then(|array| array.shape.first().copied())
            .or_else(|| pickle.items(position).map(<[_]>::len))
    };
    let longest = all.iter().take(MAX_TRACKS).filter_map(|(_, track)| length(track)).max().unwrap_or(0);
    let steps = longest.max(usize::try_from(stated).unwrap_or(0));
    if steps == 0 || steps > MAX_STEPS {
        return Err(FieldProblem::range("/length", 1.0, MAX_STEPS as f64, steps as f64).into());
    }
    Ok(steps)
}

/// Road users, and their ids by the ids of the file.
fn agents(
    pickle: &Pickle,
    tracks: &PickleValue,
    metadata: &PickleValue,
    steps: usize,
    warnings: &mut Vec<ImportWarning>,
) -> Result<(Vec<Agent>, HashMap<String, String>), ReadError> {
    let all = pickle.entries(tracks).unwrap_or_default();
    if all.len() > MAX_TRACKS {
        let message = at_most(all.len(), what::TRACKS, MAX_TRACKS);
        return Err(FieldProblem::new("/tracks", code::TOO_MANY_AGENTS, message).into());
    }
    let ego = pickle.get(metadata, "sdc_id").and_then(|value| pickle.text(value));
    let (mut agents, mut names, mut ids, mut varying) = (Vec::new(), HashMap::new(), Ids::default(), 0);
    for (key, track) in all {
        let Some(key) = pickle.text(key) else {
            return Err(invalid("/tracks", expected(wanted::IDS)));
        };
        let id = ids.take(&key);
        let (mut agent, varies) = agent(pickle, &key, track, steps)?;
        varying += usize::from(varies);
        agent.role = (ego.as_deref() == Some(key.as_str())).then(|| EGO.to_owned());
        agent.id.clone_from(&id);
        names.insert(key, id);
        agents.push(agent);
    }
    warnings.extend(ids.warning(subject::ROAD_USERS));
    if varying > 0 {
        warnings.push(ImportWarning::new("sizes-vary", sentences::sizes_vary_median(varying)));
    }
    Ok((agents, names))
}

fn agent(pickle: &Pickle, id: &str, track: &PickleValue, steps: usize) -> Result<(Agent, bool), ReadError> {
    let at = |name: &str| {
        let id = crate::problem::pointer_token(&id.chars().take(60).collect::<String>());
        format!("/tracks/{id}/state/{name}")
    };
    let nothing = PickleValue::None;
    let state = pickle.get(track, "state").unwrap_or(&nothing);
    let rows = |name: &str, most: usize| pickle.get(state, name).and_then(|value| pickle.rows(value, most));
    let (across, position) = rows("position", 3 * steps)
        .ok_or_else(|| invalid(&at("position"), expected(wanted::ROWS_OF_NUMBERS)))?;
    if !(2..=3).contains(&across) {
        return Err(invalid(&at("position"), expected(wanted::ROWS_OF_XYZ)));
    }
    let (_, valid) = rows("valid", steps).ok_or_else(|| invalid(&at("valid"), expected(wanted::TRUTH)))?;
    let (_, heading) =
        rows("heading", steps).ok_or_else(|| invalid(&at("heading"), expected(wanted::NUMBERS)))?;
    let velocity = rows("velocity", 3 * steps);
    let word = pickle.get(track, "type").and_then(|value| pickle.text(value)).unwrap_or_default();
    let agent_type = agent_type(&word);
    let count = (position.len() / across).min(steps);
    let seen = |step: usize| valid.get(step).is_some_and(|v| *v != 0.0);
    let mut states = Vec::with_capacity(count);
    let mut heights = Vec::new();
    for step in 0..count {
        let place = |k: usize| position.get(step * across + k).copied().unwrap_or(0.0);
        let speed = |k: usize| match &velocity {
            Some((across, numbers)) if *across >= 2 => numbers.get(step * across + k).copied().unwrap_or(0.0),
            _ => 0.0,
        };
        let state = State {
            x_m: place(0),
            y_m: place(1),
            heading_rad: heading.get(step).copied().unwrap_or(0.0),
            vx_mps: speed(0),
            vy_mps: speed(1),
        };
        let values = [state.x_m, state.y_m, state.heading_rad, state.vx_mps, state.vy_mps];
        if seen(step) && values.iter().any(|v| !v.is_finite()) {
            return Err(invalid(&at("position"), state_expected(step, wanted::FINITE)));
        }
        states.push(seen(step).then_some(state));
        let height = if across == 3 { place(2) } else { 0.0 };
        heights.push(if seen(step) && height.is_finite() { height } else { 0.0 });
    }
    let side = |name: &str| {
        let is_size = |v: &f64| v.is_finite() && *v > 0.0;
        // A size may be one value for all steps or one per step.
        if let Some(only) = pickle.get(state, name).and_then(|value| pickle.number(value)) {
            return Some((only, false)).filter(|(only, _)| is_size(only));
        }
        let (_, numbers) = rows(name, steps)?;
        let known = numbers.iter().enumerate().filter(|(step, v)| seen(*step) && is_size(v));
        let mut known: Vec<f64> = known.map(|(_, v)| *v).collect();
        known.sort_by(f64::total_cmp);
        let median = known.get(known.len() / 2).copied()?;
        Some((median, known.first() != known.last()))
    };
    let usual = Size::default_for(agent_type, Subtype::Unknown);
    let (length, width, height) = (side("length"), side("width"), side("height"));
    let size = Size {
        length_m: length.map_or(usual.length_m, |(v, _)| v.max(LEAST_SIZE_M)),
        width_m: width.map_or(usual.width_m, |(v, _)| v.max(LEAST_SIZE_M)),
        height_m: height.map(|(v, _)| v),
    };
    let varies = [length, width, height].iter().flatten().any(|(_, varies)| *varies);
    let z_m = (across == 3).then_some(heights);
    let mut agent = Agent::bare(String::new(), agent_type, Subtype::Unknown, Vec::new());
    agent.size = size;
    agent.track = Track { first_step: 0, states, z_m }.into();
    Ok((agent, varies))
}

/// Tracks to predict, by the ids of the scene.
fn predictions(pickle: &Pickle, metadata: &PickleValue, ids: &HashMap<String, String>) -> Vec<(String, u32)> {
    let listed = pickle.get(metadata, "tracks_to_predict").and_then(|value| pickle.entries(value));
    let one = |(key, value): &(PickleValue, PickleValue)| {
        let difficulty = pickle.get(value, "difficulty").and_then(|value| pickle.whole(value));
        let difficulty = difficulty.and_then(|v| u32::try_from(v).ok()).unwrap_or(0);
        ids.get(&pickle.text(key)?).map(|id| (id.clone(), difficulty))
    };
    listed.unwrap_or_default().iter().take(MAX_TRACKS).filter_map(one).collect()
}

/// Times of the steps, unless they are 0.1 s apart from zero.
fn timestamps(
    pickle: &Pickle,
    metadata: &PickleValue,
    steps: usize,
    warnings: &mut Vec<ImportWarning>,
) -> Option<Vec<f64>> {
    let listed = pickle.get(metadata, "ts").or_else(|| pickle.get(metadata, "timestep"));
    let (_, times) = pickle.rows(listed?, steps)?;
    // In single precision, multiples of 0.1 s are exact to 0.1 ms.
    let off = |(i, t): (usize, &f64)| (t - i as f64 * STEP_S).abs();
    if times.iter().enumerate().all(|time| off(time) < 1e-4) {
        return None;
    }
    if times.len() != steps || times.iter().any(|t| !t.is_finite()) {
        warnings.push(ImportWarning::new("timestamps-ignored", sentences::times_incomplete()));
        return None;
    }
    let first = times.first().copied().unwrap_or(0.0);
    let late = times.iter().enumerate().any(|(i, t)| (t - first - i as f64 * STEP_S).abs() > STEP_S / 2.0);
    if late {
        warnings.push(ImportWarning::new("timestamps-irregular", sentences::times_irregular()));
    }
    Some(times)
}

fn signals(
    pickle: &Pickle,
    lights: &PickleValue,
    steps: usize,
    warnings: &mut Vec<ImportWarning>,
) -> Result<Vec<Signal>, ReadError> {
    let all = pickle.entries(lights).unwrap_or_default();
    if all.len() > MAX_SIGNALS {
        let message = at_most(all.len(), what::SIGNALS, MAX_SIGNALS);
        return Err(FieldProblem::new("/dynamic_map_states", code::MAP_TOO_LARGE, message).into());
    }
    let (mut signals, mut empty) = (Vec::new(), 0);
    for (key, light) in all {
        let lane =
            pickle.get(light, "lane").and_then(|value| pickle.text(value)).or_else(|| pickle.text(key));
        let states = pickle.get(light, "state").and_then(|state| pickle.get(state, "object_state"));
        let (Some(lane), Some(states)) = (lane, states) else {
            empty += 1;
            continue;
        };
        let mut runs: Vec<(usize, SignalState)> = Vec::new();
        for (step, state) in words(pickle, states, steps).into_iter().enumerate() {
            if runs.last().is_none_or(|(_, last)| *last != state) {
                runs.push((step, state));
            }
        }
        let stop =
            pickle.get(light, "stop_point").and_then(|value| pickle.rows(value, 3)).map(|(_, stop)| stop);
        // Zeros mean an unknown position.
        let stop = stop.filter(|stop| {
            stop.len() >= 2 && stop.iter().all(|v| v.is_finite()) && stop.iter().any(|v| *v != 0.0)
        });
        if runs.is_empty() {
            empty += 1;
            continue;
        }
        signals.push(Signal {
            lane: import_map::reference(&lane),
            stop: stop.as_ref().map(|stop| Vec2::new(stop[0], stop[1])),
            stop_z_m: stop.and_then(|stop| stop.get(2).copied()),
            runs,
        });
    }
    if empty > 0 {
        warnings.push(ImportWarning::new("signals-dropped", sentences::signals_empty(empty)));
    }
    Ok(signals)
}

/// Signal states at each step.
fn words(pickle: &Pickle, states: &PickleValue, steps: usize) -> Vec<SignalState> {
    let state = |word: Option<String>| word.map_or(SignalState::Unknown, |word| signal_state(&word));
    if let Some(array) = pickle.array(states) {
        return (0..array.len().min(steps)).map(|i| state(array.text(i))).collect();
    }
    let items = pickle.items(states).unwrap_or_default();
    items.iter().take(steps).map(|value| state(pickle.text(value))).collect()
}
