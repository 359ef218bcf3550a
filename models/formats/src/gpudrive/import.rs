//! Reads a scenario as a scene.

use super::document::{self, Document, Light, Object, Point, Road};
use crate::format::{EGO, ImportOptions};
use crate::headings::{self, HeadingUnit};
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError, code};
use crate::refusals::unequal_columns;
use crate::sentences::{self, subject};
use crate::settle::{self, Ids};
use crate::source::Source;
use scene::map::{
    Area, Lane, LaneMap, LaneType, Points, ROAD_EDGE_TYPES, ROAD_LINE_TYPES, StopSign, TypedLine,
};
use scene::{Agent, AgentType, Meta, Scene, Signal, SignalState, Size, State, Subtype, Timing, Track, Vec2};
use std::collections::BTreeMap;

/// Least side of a box, metres.
const LEAST_SIZE_M: f64 = 0.05;
/// Numbers of the map elements by kind: the first ones of lines and edges.
pub(super) const FIRST_LINE: i64 = 5;
pub(super) const FIRST_EDGE: i64 = 14;

/// Reads a file, plain or gzip.
///
/// # Errors
/// Those of [`document::read`], `out-of-range` for lists of different lengths, the faults of a scene.
pub(super) fn read(file: &dyn Source, options: &ImportOptions, source: &str) -> Result<Imported, ReadError> {
    let document = document::read(file)?;
    let mut warnings = Vec::new();
    let steps = document.objects.iter().map(|object| object.position.len()).max().unwrap_or(0);
    let lit = document.tl_states.0.iter().map(|(_, light)| light.state.len()).max().unwrap_or(0);
    let steps = steps.max(lit).max(1);
    // Files of Nocturne, which have degrees, have no heights.
    let flat = document.scenario_id.is_none()
        && document.objects.iter().flat_map(|object| &object.position).all(|p| p.z.is_none());
    let mut ids = Ids::default();
    let mut agents = Vec::new();
    for (i, object) in document.objects.iter().enumerate() {
        let id = object.id.unwrap_or(i as i64);
        agents.push(agent(object, i, ids.take(&id.to_string()))?);
    }
    warnings.extend(ids.warning(subject::ROAD_USERS));
    let unit = if flat { HeadingUnit::UsuallyDegrees } else { HeadingUnit::UsuallyRadians };
    warnings.extend(headings::settle(&mut agents, unit));
    let metadata = document.metadata.as_ref();
    let by_index = |i: i64| usize::try_from(i).ok().and_then(|i| agents.get(i)).map(|agent| agent.id.clone());
    let predict = metadata.iter().flat_map(|metadata| &metadata.tracks_to_predict);
    let predict: Vec<_> = predict.filter_map(|p| Some((by_index(p.track_index)?, p.difficulty))).collect();
    let interest = metadata.iter().flat_map(|metadata| &metadata.objects_of_interest).map(i64::to_string);
    let interest: Vec<_> = interest.filter(|id| agents.iter().any(|agent| agent.id == *id)).collect();
    let ego = metadata.and_then(|metadata| usize::try_from(metadata.sdc_track_index?).ok());
    if let Some(ego) = ego.and_then(|ego| agents.get_mut(ego)) {
        ego.role = Some(EGO.to_owned());
    }
    let map = lane_map(&document.roads, &mut warnings);
    let signals =
        document.tl_states.0.iter().filter_map(|(lane, light)| signal(lane, light, steps)).collect();
    let Document { name, scenario_id, .. } = document;
    let name: String = name.chars().take(scene::MAX_NAME_CHARS).collect();
    let scene = Scene {
        id: None,
        name: if name.is_empty() { scenario_id.clone().unwrap_or_default() } else { name },
        meta: Meta {
            source: source.to_owned(),
            source_id: scenario_id.map(|id| id.chars().take(scene::MAX_NAME_CHARS).collect()),
            objects_of_interest: interest,
            tracks_to_predict: predict,
            ..Meta::default()
        },
        // Recordings of the Waymo data set begin one second before the present.
        time: Timing { steps, now_step: if steps == 91 { 10 } else { 0 } },
        map: LaneMap::default().into(),
        signals,
        agents,
        generated: None,
        extra: BTreeMap::new(),
    };
    settle::settled(scene, map, warnings, options)
}

fn agent(object: &Object, index: usize, id: String) -> Result<Agent, ReadError> {
    let count = object.position.len();
    let lists = [
        ("heading", object.heading.len()),
        ("velocity", object.velocity.len()),
        ("valid", object.valid.len()),
    ];
    if let Some((name, length)) = lists.into_iter().find(|(_, length)| *length != count) {
        let message = unequal_columns(length, count, "position");
        return Err(
            FieldProblem::new(format!("/objects/{index}/{name}"), code::INVALID_FIELD, message).into()
        );
    }
    let agent_type = match object.kind.as_str() {
        "vehicle" => AgentType::Vehicle,
        "pedestrian" => AgentType::Pedestrian,
        "cyclist" => AgentType::Cyclist,
        _ => AgentType::Other,
    };
    let state = |i: usize| {
        let (at, v, heading_rad) =
            (object.position.get(i)?, object.velocity.get(i)?, *object.heading.get(i)?);
        Some(State { x_m: at.x, y_m: at.y, heading_rad, vx_mps: v.x, vy_mps: v.y })
    };
    let seen = |i: usize| object.valid.get(i) == Some(&true);
    let states: Vec<_> = (0..count).map(|i| state(i).filter(|_| seen(i))).collect();
    let height = |(i, p): (usize, &Point)| if seen(i) { p.z.unwrap_or(0.0) } else { 0.0 };
    let has_z = object.position.iter().enumerate().any(|(i, p)| seen(i) && p.z.is_some());
    let z_m = has_z.then(|| object.position.iter().enumerate().map(height).collect());
    let mut agent = Agent::bare(id, agent_type, Subtype::Unknown, Vec::new());
    agent.size = Size {
        length_m: object.length.max(LEAST_SIZE_M),
        width_m: object.width.max(LEAST_SIZE_M),
        height_m: object.height.filter(|height| *height > 0.0),
    };
    agent.track = Track { first_step: 0, states, z_m }.into();
    Ok(agent)
}

fn points(list: &[Point]) -> Points {
    let z_m = list.iter().any(|p| p.z.is_some()).then(|| list.iter().map(|p| p.z.unwrap_or(0.0)).collect());
    Points { xy: list.iter().map(|p| Vec2::new(p.x, p.y)).collect(), z_m }
}

fn lane_type(number: Option<i64>) -> LaneType {
    match number {
        Some(1) => LaneType::Freeway,
        Some(2) => LaneType::SurfaceStreet,
        Some(3) => LaneType::BikeLane,
        _ => LaneType::Undefined,
    }
}

fn word(words: &[&'static str], number: Option<i64>, first: i64) -> String {
    let place = number.and_then(|number| usize::try_from(number - first).ok());
    place.and_then(|place| words.get(place)).copied().unwrap_or("unknown").to_owned()
}

fn lane_map(roads: &[Road], warnings: &mut Vec<ImportWarning>) -> LaneMap {
    let mut map = LaneMap::default();
    let mut ids: [Ids; 3] = Default::default();
    let mut dropped = 0;
    for (i, road) in roads.iter().enumerate() {
        let number = road.id.unwrap_or(i as i64).to_string();
        let mut id = |kind: usize| ids.get_mut(kind).map(|ids| ids.take(&number)).unwrap_or_default();
        let line = points(&road.geometry);
        let count = line.xy.len();
        match road.kind.as_str() {
            "lane" if count > 1 => {
                let lane = Lane { lane_type: lane_type(road.map_element_id), ..Lane::street(id(0), line) };
                map.lanes.push(lane);
            }
            "road_line" if count > 0 => {
                let line_type = word(&ROAD_LINE_TYPES, road.map_element_id, FIRST_LINE);
                map.road_lines.push(TypedLine { id: id(1), line_type, points: line });
            }
            "road_edge" if count > 0 => {
                let line_type = word(&ROAD_EDGE_TYPES, road.map_element_id, FIRST_EDGE);
                map.road_edges.push(TypedLine { id: id(1), line_type, points: line });
            }
            "stop_sign" if count > 0 => {
                let z_m = line.z_m.and_then(|z| z.first().copied());
                map.stop_signs.push(StopSign { id: id(2), position: line.xy[0], z_m, lanes: Vec::new() });
            }
            kind @ ("crosswalk" | "speed_bump" | "driveway") if count > 0 => {
                let area = Area { id: id(2), polygon: line, holes: Vec::new() };
                match kind {
                    "crosswalk" => map.crosswalks.push(area),
                    "speed_bump" => map.speed_bumps.push(area),
                    _ => map.driveways.push(area),
                }
            }
            _ => dropped += 1,
        }
    }
    ids.iter().for_each(|ids| warnings.extend(ids.warning(subject::MAP_FEATURES)));
    if dropped > 0 {
        warnings.push(ImportWarning::new("features-dropped", sentences::features_unread(dropped)));
    }
    map
}

/// The state of a word such as `arrow_stop`.
fn signal_state(word: &str) -> SignalState {
    serde_json::from_value(serde_json::Value::String(word.to_owned())).unwrap_or_default()
}

fn signal(lane: &str, light: &Light, steps: usize) -> Option<Signal> {
    let mut shown = vec![SignalState::Unknown; steps];
    for (i, word) in light.state.iter().enumerate() {
        let step = light.time_index.get(i).copied().unwrap_or(i);
        if let Some(slot) = shown.get_mut(step) {
            *slot = signal_state(word);
        }
    }
    let mut runs: Vec<(usize, SignalState)> = Vec::new();
    for (step, state) in shown.into_iter().enumerate() {
        if runs.last().is_none_or(|(_, last)| *last != state) {
            runs.push((step, state));
        }
    }
    let stop = light.x.first().zip(light.y.first()).map(|(x, y)| Vec2::new(*x, *y));
    let lane = Ids::default().take(lane);
    (!light.state.is_empty()).then(|| Signal {
        lane,
        stop,
        stop_z_m: light.z.first().copied().filter(|_| stop.is_some()),
        runs,
    })
}
