//! Converts a Scenario message to a scene.

use super::ids::UniqueIds;
use super::proto::{DynamicMapState, ObjectState, RequiredPrediction, Scenario, Track};
use super::{LICENCE_OWN, LICENCE_WAYMO, Options, SYNTHETIC_PREFIX, import_map};
use crate::format::EGO;
use crate::limits::MAX_AGENTS;
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::repairs::checked;
use crate::sentences::{self, subject};
use scene::geometry::Extent;
use scene::{Agent, AgentType, Conditions, Meta, Origin, STEP_S, Scene, Size, State, Subtype, Timing};
use scene::{Signal, SignalState, Vec2};
use std::collections::{BTreeMap, BTreeSet};

/// Least size that a box can have, metres.
const LEAST_SIZE_M: f64 = 0.05;

/// WOMD's signal states in the order of their numbers.
pub(crate) const SIGNAL_STATES: [SignalState; 9] = [
    SignalState::Unknown,
    SignalState::ArrowStop,
    SignalState::ArrowCaution,
    SignalState::ArrowGo,
    SignalState::Stop,
    SignalState::Caution,
    SignalState::Go,
    SignalState::FlashingStop,
    SignalState::FlashingCaution,
];

/// Turns a message into a scene.
///
/// # Errors
/// The faults that `Scene::checked` finds: numbers that are not finite or out of bounds, a map that
/// is too large, more steps than a scene has.
pub fn scene(scenario: Scenario, options: &Options) -> Result<Imported, ReadError> {
    let mut warnings = Vec::new();
    let steps = steps(&scenario);
    let now = scenario.current_time_index.unwrap_or(0).max(0) as usize;
    let now_step = now.min(steps.saturating_sub(1));
    if now != now_step {
        warnings.push(ImportWarning::new("now-step-moved", sentences::now_step_moved(now, steps)));
    }
    let ego = scenario.sdc_track_index.and_then(|i| usize::try_from(i).ok());
    let ego = ego.filter(|i| *i < scenario.tracks.len());
    let origin = origin(&scenario, ego, now_step);
    let kept = kept_tracks(&scenario.tracks, ego, now_step, &mut warnings);
    let ids = track_ids(&scenario.tracks, &mut warnings);
    let interest = interest(&scenario, &ids, &kept);
    let predict = predictions(&scenario.tracks_to_predict, &ids, &kept);
    let signals = signals(&scenario.dynamic_map_states, origin, &mut warnings);
    let map = import_map::lane_map(scenario.map_features, origin, &mut warnings);
    let mut varying = 0;
    let mut agents = Vec::new();
    for (i, (track, id)) in scenario.tracks.iter().zip(&ids).enumerate() {
        if kept.contains(&i) {
            let role = (Some(i) == ego).then(|| EGO.to_owned());
            let (agent, varies) = agent(track, id.clone(), role, now_step, origin);
            varying += usize::from(varies);
            agents.push(agent);
        }
    }
    if varying > 0 {
        warnings.push(ImportWarning::new("sizes-vary", sentences::sizes_vary_now(varying)));
    }
    let id = scenario.scenario_id.unwrap_or_default();
    let synthetic = id.starts_with(SYNTHETIC_PREFIX);
    let licence = match &options.licence {
        Some(licence) => licence.clone(),
        None if synthetic => LICENCE_OWN.into(),
        None => LICENCE_WAYMO.into(),
    };
    let meta = Meta {
        source: if synthetic { "synthetic" } else { "womd" }.into(),
        licence: Some(licence),
        origin: Origin { x_m: origin.x, y_m: origin.y, ..Origin::default() },
        objects_of_interest: interest,
        tracks_to_predict: predict,
        timestamps_s: timestamps(scenario.timestamps_seconds, steps, &mut warnings),
        source_id: (!id.is_empty()).then(|| id.clone()),
        ..Meta::default()
    };
    let scene = Scene {
        id: None,
        name: id,
        meta,
        time: Timing { steps, now_step },
        map: map.into(),
        signals,
        agents,
        generated: None,
        extra: BTreeMap::new(),
    };
    checked(scene, warnings)
}

fn steps(scenario: &Scenario) -> usize {
    let tracks = scenario.tracks.iter().map(|t| t.states.len()).max().unwrap_or(0);
    tracks.max(scenario.timestamps_seconds.len()).max(scenario.dynamic_map_states.len())
}

fn valid(state: &ObjectState) -> bool {
    state.valid == Some(true)
}

fn position(state: &ObjectState) -> Vec2 {
    Vec2::new(state.center_x.unwrap_or(0.0), state.center_y.unwrap_or(0.0))
}

/// The valid state nearest in time to a step.
fn nearest(track: &Track, step: usize) -> Option<&ObjectState> {
    let known = track.states.iter().enumerate().filter(|(_, s)| valid(s));
    known.min_by_key(|(i, _)| i.abs_diff(step)).map(|(_, s)| s)
}

/// The ego's position at the current step; without an ego, the middle of the content in whole metres, so that
/// a round trip gives the same origin.
fn origin(scenario: &Scenario, ego: Option<usize>, now_step: usize) -> Vec2 {
    let ego = ego.and_then(|i| scenario.tracks.get(i)).and_then(|track| nearest(track, now_step));
    if let Some(state) = ego {
        return finite_or_zero(position(state));
    }
    let states = scenario.tracks.iter().filter_map(|track| nearest(track, now_step)).map(position);
    let map = scenario.map_features.iter().filter_map(import_map::any_point).map(|p| p.plane());
    let extent = Extent::about(states.chain(map).filter(|p| p.x.is_finite() && p.y.is_finite()));
    extent.map_or(Vec2::zeros(), |extent| finite_or_zero(extent.middle().map(f64::round)))
}

fn finite_or_zero(p: Vec2) -> Vec2 {
    if p.x.is_finite() && p.y.is_finite() { p } else { Vec2::zeros() }
}

/// Indices of the tracks that fit a scene: the ego and the tracks nearest to it.
fn kept_tracks(
    tracks: &[Track],
    ego: Option<usize>,
    now_step: usize,
    warnings: &mut Vec<ImportWarning>,
) -> BTreeSet<usize> {
    if tracks.len() <= MAX_AGENTS {
        return (0..tracks.len()).collect();
    }
    let centre = ego.and_then(|i| tracks.get(i)).and_then(|t| nearest(t, now_step)).map(position);
    let centre = centre.unwrap_or_else(|| {
        let known: Vec<Vec2> = tracks.iter().filter_map(|t| nearest(t, now_step)).map(position).collect();
        known.iter().sum::<Vec2>() / known.len().max(1) as f64
    });
    let mut order: Vec<(f64, usize)> = tracks
        .iter()
        .enumerate()
        .map(|(i, track)| {
            let distance = nearest(track, now_step).map_or(f64::INFINITY, |s| (position(s) - centre).norm());
            (if Some(i) == ego { -1.0 } else { distance }, i)
        })
        .collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let message = sentences::agents_near_ego(tracks.len(), MAX_AGENTS);
    warnings.push(ImportWarning::new("agents-dropped", message));
    order.into_iter().take(MAX_AGENTS).map(|(_, i)| i).collect()
}

fn track_ids(tracks: &[Track], warnings: &mut Vec<ImportWarning>) -> Vec<String> {
    let mut ids = UniqueIds::default();
    let list = tracks.iter().map(|track| ids.take(track.id.unwrap_or(0).into())).collect();
    ids.warn(subject::TRACKS, warnings);
    list
}

fn agent(track: &Track, id: String, role: Option<String>, now: usize, origin: Vec2) -> (Agent, bool) {
    let agent_type = match track.object_type {
        Some(1) => AgentType::Vehicle,
        Some(2) => AgentType::Pedestrian,
        Some(3) => AgentType::Cyclist,
        _ => AgentType::Other,
    };
    let current = nearest(track, now);
    let side = |value: Option<f32>| value.map(|v| f64::from(v).max(LEAST_SIZE_M));
    let default = Size::default_for(agent_type, Subtype::Unknown);
    let size = Size {
        length_m: current.and_then(|s| side(s.length)).unwrap_or(default.length_m),
        width_m: current.and_then(|s| side(s.width)).unwrap_or(default.width_m),
        height_m: current.and_then(|s| s.height).map(f64::from),
    };
    let box_of = |s: &ObjectState| (s.length, s.width, s.height);
    let known = || track.states.iter().filter(|s| valid(s));
    let varies = current.is_some_and(|c| known().any(|s| box_of(s) != box_of(c)));
    let states = track.states.iter().map(|s| valid(s).then(|| state(s, origin))).collect();
    let heights = |s: &ObjectState| if valid(s) { s.center_z.unwrap_or(0.0) } else { 0.0 };
    let z_m = known().any(|s| s.center_z.is_some()).then(|| track.states.iter().map(heights).collect());
    let track = scene::Track { first_step: 0, states, z_m };
    let subtype = Subtype::Unknown;
    (
        Agent { id, agent_type, subtype, role, size, track: track.into(), conditions: Conditions::default() },
        varies,
    )
}

fn state(state: &ObjectState, origin: Vec2) -> State {
    let at = position(state) - origin;
    State {
        x_m: at.x,
        y_m: at.y,
        heading_rad: state.heading.unwrap_or(0.0).into(),
        vx_mps: state.velocity_x.unwrap_or(0.0).into(),
        vy_mps: state.velocity_y.unwrap_or(0.0).into(),
    }
}

fn interest(scenario: &Scenario, ids: &[String], kept: &BTreeSet<usize>) -> Vec<String> {
    let find = |wanted: &i32| {
        let at = scenario.tracks.iter().position(|t| t.id == Some(*wanted))?;
        ids.get(at).filter(|_| kept.contains(&at)).cloned()
    };
    scenario.objects_of_interest.iter().filter_map(find).collect()
}

fn predictions(list: &[RequiredPrediction], ids: &[String], kept: &BTreeSet<usize>) -> Vec<(String, u32)> {
    let find = |wanted: &RequiredPrediction| {
        let at = usize::try_from(wanted.track_index?).ok()?;
        let id = ids.get(at).filter(|_| kept.contains(&at)).cloned()?;
        Some((id, wanted.difficulty.unwrap_or(0).max(0).unsigned_abs()))
    };
    list.iter().filter_map(find).collect()
}

/// Run-length encoded signals, in order of first appearance. A lane with two states in one step has two
/// signals.
fn signals(rows: &[DynamicMapState], origin: Vec2, warnings: &mut Vec<ImportWarning>) -> Vec<Signal> {
    let mut signals: Vec<Signal> = Vec::new();
    let mut places: BTreeMap<(i64, usize), usize> = BTreeMap::new();
    let mut last_seen: Vec<usize> = Vec::new();
    let mut moved = 0;
    for (step, row) in rows.iter().enumerate() {
        let mut times: BTreeMap<i64, usize> = BTreeMap::new();
        for lane_state in &row.lane_states {
            let lane = lane_state.lane.unwrap_or(0);
            let nth = times.entry(lane).or_insert(0);
            let at = *places.entry((lane, *nth)).or_insert_with(|| {
                let stop = lane_state.stop_point.as_ref();
                signals.push(Signal {
                    lane: lane.to_string(),
                    stop: stop.map(|p| p.plane() - origin),
                    stop_z_m: stop.and_then(|p| p.z),
                    runs: Vec::new(),
                });
                last_seen.push(step);
                signals.len() - 1
            });
            *nth += 1;
            let number = usize::try_from(lane_state.state.unwrap_or(0)).unwrap_or(0);
            let state = SIGNAL_STATES.get(number).copied().unwrap_or_default();
            let (Some(signal), Some(seen)) = (signals.get_mut(at), last_seen.get_mut(at)) else { continue };
            let stop = lane_state.stop_point.as_ref().map(|p| p.plane() - origin);
            moved += usize::from(stop.is_some() && stop != signal.stop);
            if step > *seen + 1 {
                push_run(&mut signal.runs, *seen + 1, SignalState::Unknown);
            }
            push_run(&mut signal.runs, step, state);
            *seen = step;
        }
    }
    for (signal, seen) in signals.iter_mut().zip(last_seen) {
        if seen + 1 < rows.len() {
            push_run(&mut signal.runs, seen + 1, SignalState::Unknown);
        }
    }
    if moved > 0 {
        warnings.push(ImportWarning::new("stop-points-vary", sentences::stop_points_vary()));
    }
    signals
}

fn push_run(runs: &mut Vec<(usize, SignalState)>, step: usize, state: SignalState) {
    if runs.last().is_none_or(|run| run.1 != state) {
        runs.push((step, state));
    }
}

/// Times of the steps, unless they are exactly 0.1 s apart from zero.
fn timestamps(times: Vec<f64>, steps: usize, warnings: &mut Vec<ImportWarning>) -> Option<Vec<f64>> {
    if times.iter().enumerate().all(|(i, t)| *t == i as f64 * STEP_S) {
        return None;
    }
    if times.len() != steps || times.iter().any(|t| !t.is_finite()) {
        warnings.push(ImportWarning::new("timestamps-ignored", sentences::times_ignored(times.len(), steps)));
        return None;
    }
    let first = times.first().copied().unwrap_or(0.0);
    let late = times.iter().enumerate().any(|(i, t)| (t - first - i as f64 * STEP_S).abs() > STEP_S / 2.0);
    if late {
        warnings.push(ImportWarning::new("timestamps-irregular", sentences::times_irregular()));
    }
    Some(times)
}
