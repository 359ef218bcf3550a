//! Converts a scene to a Scenario message, and writes its file.

use super::export_map::{MapIds, features, map_point};
use super::import::SIGNAL_STATES;
use super::proto::{
    DynamicMapState, ObjectState, RequiredPrediction, Scenario, Track, TrafficSignalLaneState,
};
use super::record::write_record;
use crate::format::{EGO, ExportedMotion};
use crate::frame::Frame;
use crate::loss::{Loss, code};
use crate::unwritten;
use flate2::Compression;
use flate2::write::GzEncoder;
use prost::Message;
use scene::{Agent, AgentType, STEP_S, Scene, Shown, Signal, Size, State, Subtype};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::io::{self, Write};

/// Writes one record per scene.
///
/// # Errors
/// Those of the writer. Losses are not errors: each kind is listed once.
pub fn write(
    scenes: &[&Scene],
    out: impl Write,
    gzip: bool,
    motion: ExportedMotion,
) -> io::Result<Vec<Loss>> {
    let mut losses = BTreeSet::new();
    packed(out, gzip, |out| write_records(scenes, out, motion, &mut losses))?;
    Ok(losses.into_iter().collect())
}

/// Writes to a file, compressed with gzip or not.
pub(super) fn packed(
    out: impl Write,
    gzip: bool,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = out;
    if gzip {
        let mut encoder = GzEncoder::new(out, Compression::default());
        write(&mut encoder)?;
        encoder.finish()?.flush()
    } else {
        write(&mut out)?;
        out.flush()
    }
}

fn write_records(
    scenes: &[&Scene],
    mut out: &mut dyn Write,
    motion: ExportedMotion,
    losses: &mut BTreeSet<Loss>,
) -> io::Result<()> {
    for scene in scenes {
        let (message, lost) = scenario(scene, motion);
        losses.extend(lost);
        write_record(&mut out, &message.encode_to_vec())?;
    }
    Ok(())
}

/// The message of a scene, and its losses.
pub fn scenario(scene: &Scene, motion: ExportedMotion) -> (Scenario, Vec<Loss>) {
    let frame = Frame::of(&scene.meta.origin);
    let mut losses = Vec::new();
    let ids = agent_ids(&scene.agents, &mut losses);
    let map_ids = MapIds::new(&scene.map, &mut losses);
    let (shown, steps) = motion.all(scene);
    losses.extend(unwritten::length(scene, steps));
    let tracks: Vec<Track> = scene
        .agents
        .iter()
        .zip(&shown)
        .zip(&ids)
        .map(|((agent, shown), id)| Track {
            id: Some(*id),
            object_type: Some(type_number(shown.agent_type)),
            states: states(&agent.track, shown, steps, frame),
        })
        .collect();
    let index: HashMap<&str, usize> =
        scene.agents.iter().enumerate().map(|(i, a)| (a.id.as_str(), i)).collect();
    let number = |id: &String| index.get(id.as_str()).and_then(|i| ids.get(*i)).copied();
    let predict = |(id, difficulty): &(String, u32)| {
        let track_index = i32::try_from(*index.get(id.as_str())?).ok();
        Some(RequiredPrediction { track_index, difficulty: i32::try_from(*difficulty).ok() })
    };
    let ego = scene.agents.iter().position(|a| a.role.as_deref() == Some(EGO));
    let id = record_id(scene);
    let message = Scenario {
        timestamps_seconds: timestamps(scene.meta.timestamps_s.as_deref(), steps),
        tracks,
        objects_of_interest: scene.meta.objects_of_interest.iter().filter_map(number).collect(),
        scenario_id: Some(id.clone()),
        sdc_track_index: ego.and_then(|i| i32::try_from(i).ok()),
        dynamic_map_states: signal_rows(&scene.signals, steps, frame, &map_ids),
        map_features: features(&scene.map, frame, &map_ids, &mut losses),
        current_time_index: i32::try_from(scene.time.now_step).ok(),
        tracks_to_predict: scene.meta.tracks_to_predict.iter().filter_map(predict).collect(),
    };
    scene_losses(scene, motion, id, &mut losses);
    (message, losses)
}

/// Record id of a scene: its id in the source, else its own.
pub(super) fn record_id(scene: &Scene) -> &String {
    scene.meta.source_id.as_ref().or(scene.id.as_ref()).unwrap_or(&scene.name)
}

fn type_number(agent_type: AgentType) -> i32 {
    match agent_type {
        AgentType::Vehicle => 1,
        AgentType::Pedestrian => 2,
        AgentType::Cyclist => 3,
        AgentType::Other => 4,
    }
}

/// Track ids: the id of the road user if it is a number, else the next free number.
pub(super) fn agent_ids(agents: &[Agent], losses: &mut Vec<Loss>) -> Vec<i32> {
    let own = |agent: &Agent| agent.id.parse::<i32>().ok().filter(|n| n.to_string() == agent.id);
    let taken: HashSet<i32> = agents.iter().filter_map(own).collect();
    let mut free = (1_000_000..i32::MAX).filter(|n| !taken.contains(n));
    let ids: Vec<i32> = agents.iter().map(|a| own(a).or_else(|| free.next()).unwrap_or(0)).collect();
    if taken.len() < agents.len() {
        losses.push(Loss::new(code::IDS_RENUMBERED, "road users' ids that are no numbers got new ones"));
    }
    ids
}

/// Its state at each step. Heights are those of the log; a missing one is the last known height.
fn states(log: &scene::Track, shown: &Shown<'_>, steps: usize, frame: Frame) -> Vec<ObjectState> {
    let mut height = None;
    (0..steps)
        .map(|step| {
            if log.at(step).is_some() {
                let heights = log.z_m.as_ref().zip(step.checked_sub(log.first_step));
                height = heights.and_then(|(z, slot)| z.get(slot)).copied();
            }
            let state = shown.track.at(step);
            state.map_or_else(absent, |state| present(&shown.size, state, height, frame))
        })
        .collect()
}

/// A step at which the road user was not seen: meaningless zeros, as in Waymo's files.
fn absent() -> ObjectState {
    ObjectState {
        center_x: Some(0.0),
        center_y: Some(0.0),
        center_z: Some(0.0),
        length: Some(0.0),
        width: Some(0.0),
        height: Some(0.0),
        heading: Some(0.0),
        velocity_x: Some(0.0),
        velocity_y: Some(0.0),
        valid: Some(false),
    }
}

fn present(size: &Size, state: &State, z_m: Option<f64>, frame: Frame) -> ObjectState {
    let at = frame.place(state.position());
    let velocity = frame.turn(state.velocity());
    ObjectState {
        center_x: Some(at.x),
        center_y: Some(at.y),
        center_z: z_m.map(|z| frame.height(z)),
        length: Some(size.length_m as f32),
        width: Some(size.width_m as f32),
        height: size.height_m.map(|h| h as f32),
        heading: Some(frame.heading(state.heading_rad) as f32),
        velocity_x: Some(velocity.x as f32),
        velocity_y: Some(velocity.y as f32),
        valid: Some(true),
    }
}

/// The times of the source, continued in steps of 0.1 s if a future is longer.
fn timestamps(times: Option<&[f64]>, steps: usize) -> Vec<f64> {
    let own = times.unwrap_or_default();
    let last = own.last().copied();
    let continued = |step: usize| match last {
        Some(last) => last + (step + 1 - own.len()) as f64 * STEP_S,
        None => step as f64 * STEP_S,
    };
    (0..steps).map(|step| own.get(step).copied().unwrap_or_else(|| continued(step))).collect()
}

fn signal_rows(signals: &[Signal], steps: usize, frame: Frame, ids: &MapIds) -> Vec<DynamicMapState> {
    let row = |step: usize| {
        let shown = signals.iter().filter(|s| s.runs.first().is_some_and(|run| run.0 <= step));
        let lane_state = |signal: &Signal| {
            let state = signal.at(step);
            let number = SIGNAL_STATES.iter().position(|s| *s == state).unwrap_or(0);
            TrafficSignalLaneState {
                lane: Some(ids.lane(&signal.lane)),
                state: i32::try_from(number).ok(),
                stop_point: signal.stop.map(|p| map_point(frame, p, signal.stop_z_m)),
            }
        };
        DynamicMapState { lane_states: shown.map(lane_state).collect() }
    };
    (0..steps).map(row).collect()
}

fn scene_losses(scene: &Scene, motion: ExportedMotion, id: &str, losses: &mut Vec<Loss>) {
    let agents = &scene.agents;
    losses.extend(unwritten::conditions(scene, motion));
    losses.extend(unwritten::futures(scene, motion));
    if agents.iter().any(|a| a.subtype != Subtype::Unknown) {
        losses.push(Loss::new(code::NO_SUBTYPE, "finer kinds such as truck or child"));
    }
    let egos = agents.iter().filter(|a| a.role.as_deref() == Some(EGO)).count();
    if egos > 1 || agents.iter().any(|a| a.role.as_deref().is_some_and(|r| r != EGO)) {
        losses.push(Loss::new(code::NO_ROLES, "roles other than the ego's"));
    }
    if scene.licence().is_some() {
        losses.push(Loss::new(code::NO_LICENCE, "the file has no place for a licence"));
    }
    losses.extend(unwritten::notes(scene, id));
}
