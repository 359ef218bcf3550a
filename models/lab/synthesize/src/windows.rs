//! Cuts a recording into windows of 91 steps, each centred on one road user.

use super::recording::{CHECK_EVERY, SimulatedAgent, SimulatedRecording};
use super::sight;
use super::{DT_S, RECORDED_S, WARM_UP_S};
use formats::sumo::map::NetMap;
use scene::map::{Area, Lane, LaneMap, Points, TypedLine};
use scene::random::Stream;
use scene::{Agent, AgentType, Conditions, Meta, Origin, STEP_S, Scene, Signal, State, Timing, Track, Vec2};
use std::collections::{HashMap, HashSet};

/// Steps of a window.
pub const STEPS: usize = 91;
/// The step that windows are centred on.
pub const NOW: usize = 10;
/// Half a side of the square in which a road user belongs to a window, metres.
const CROP_M: f64 = 60.0;
/// States beyond this distance are not seen, metres.
const SEEN_M: f64 = 200.0;
/// Map features with a point within this square are kept, metres.
const MAP_M: f64 = 210.0;
/// Most road users of a window.
const MAX_AGENTS: usize = 256;
/// Least number of states of a road user in a window.
const FEWEST_STATES: usize = 5;
/// Steps after which a road user that starts must have moved.
const SOON: usize = 25;
/// Types of the road users at the centres of windows, in turn: pedestrians and cyclists more often than their
/// share.
const TURNS: [AgentType; 10] = {
    use AgentType::{Cyclist as C, Pedestrian as P, Vehicle as V};
    [V, V, P, V, C, V, P, V, V, C]
};

/// Windows dropped while cutting.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drops {
    /// Windows with too many overlapping road users.
    pub overlapping: usize,
    /// Windows with a vehicle that jumps.
    pub jumping: usize,
    /// Windows without a road user to centre on.
    pub empty: usize,
}

/// Cuts `count` windows at equal intervals.
pub fn cut(
    recording: &SimulatedRecording,
    seed: u64,
    count: usize,
    draw: &mut Stream,
) -> (Vec<Scene>, Drops) {
    let last = (RECORDED_S / DT_S) as usize - STEPS;
    let mut used: HashMap<usize, i32> = HashMap::new();
    let mut drops = Drops::default();
    let mut scenes = Vec::new();
    for w in 0..count {
        let start = if count > 1 { last * w / (count - 1) } else { last / 2 };
        let Some(centre) = choose(recording, start, TURNS[w % TURNS.len()], &used, draw) else {
            drops.empty += 1;
            continue;
        };
        *used.entry(centre).or_default() += 1;
        let Some(cast) = cast(recording, start, centre, &mut drops) else { continue };
        let name = format!("{} {seed}, {}", recording.network.character.name, w + 1);
        scenes.push(window(recording, start, &cast, format!("synth-{seed}-{w}"), name));
    }
    (scenes, drops)
}

fn in_window(steps: &[usize], start: usize) -> bool {
    steps.iter().any(|s| (start..start + STEPS).contains(s))
}

fn overlaps_in(actor: &SimulatedAgent, start: usize) -> bool {
    actor.overlaps.iter().any(|s| s + CHECK_EVERY > start && *s < start + STEPS)
}

/// The road user at the centre of a window: seen all the time, moving if possible, and seldom used before.
fn choose(
    recording: &SimulatedRecording,
    start: usize,
    wanted: AgentType,
    used: &HashMap<usize, i32>,
    draw: &mut Stream,
) -> Option<usize> {
    let reach = recording.network.character.reach;
    let whole = |a: &SimulatedAgent| a.track.at(start).is_some() && a.track.at(start + STEPS - 1).is_some();
    let fits = |a: &SimulatedAgent| {
        let near = a.track.at(start + NOW).is_some_and(|s| s.position().norm() < reach);
        near && !a.parked && whole(a) && !in_window(&a.track.jumps, start) && !overlaps_in(a, start)
    };
    let of_type = |t: AgentType| -> Vec<usize> {
        let all = recording.actors.iter().enumerate();
        all.filter(|(_, a)| a.agent_type == t && fits(a)).map(|(i, _)| i).collect()
    };
    let mut candidates = of_type(wanted);
    if candidates.is_empty() {
        candidates = of_type(AgentType::Vehicle);
    }
    let weight = |i: &usize| {
        let track = &recording.actors[*i].track;
        let travel = match (track.at(start), track.at(start + STEPS - 1)) {
            (Some(a), Some(b)) => (b.position() - a.position()).norm(),
            _ => 0.0,
        };
        let fresh = 0.4_f64.powi(used.get(i).copied().unwrap_or(0));
        // Recorded windows are selected for their events, so a road user that waits for most of a window is
        // rarely at its centre.
        let soon = track.at(start + SOON).zip(track.at(start));
        let starts = soon.is_some_and(|(a, b)| (a.position() - b.position()).norm() > 0.5);
        fresh
            * if travel <= 3.0 {
                0.2
            } else if starts {
                1.0
            } else {
                0.4
            }
    };
    draw.among(candidates.iter().map(weight)).map(|i| candidates[i])
}

/// Road users in a window about `centre`, which comes first, and the position of its origin.
struct Cast {
    actors: Vec<usize>,
    origin: Vec2,
}

fn cast(recording: &SimulatedRecording, start: usize, centre: usize, drops: &mut Drops) -> Option<Cast> {
    let place = recording.actors[centre].track.at(start + NOW)?.position();
    let origin = place.map(|v| snap(v, 512.0));
    let close = |i: &usize| {
        let track = &recording.actors[*i].track;
        let inside = |s: &State| (s.position() - origin).amax() < CROP_M;
        (start..start + STEPS).any(|step| track.at(step).is_some_and(inside))
    };
    let all: Vec<usize> = (0..recording.actors.len()).filter(|i| *i != centre && close(i)).collect();
    let (bad, good): (Vec<usize>, Vec<usize>) =
        all.into_iter().partition(|i| overlaps_in(&recording.actors[*i], start));
    if bad.len() > 2 {
        drops.overlapping += 1;
        return None;
    }
    if good.iter().any(|i| in_window(&recording.actors[*i].track.jumps, start)) {
        drops.jumping += 1;
        return None;
    }
    let mut others: Vec<(f64, usize)> = good
        .into_iter()
        .filter_map(|i| {
            let nearest = (start..start + STEPS)
                .filter_map(|step| recording.actors[i].track.at(step))
                .map(|s| (s.position() - origin).norm())
                .fold(f64::INFINITY, f64::min);
            Some((nearest, i)).filter(|_| seen(&recording.actors[i], start, origin).count() >= FEWEST_STATES)
        })
        .collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    others.truncate(MAX_AGENTS - 1);
    let actors = std::iter::once(centre).chain(others.into_iter().map(|o| o.1)).collect();
    Some(Cast { actors, origin })
}

/// Steps of a window with the visible states, relative to the origin.
fn seen(actor: &SimulatedAgent, start: usize, origin: Vec2) -> impl Iterator<Item = (usize, State)> {
    let shifted = move |step: usize| {
        let state = actor.track.at(start + step)?;
        let p = state.position() - origin;
        // Further decimals take space in files and carry no information.
        let (x_m, y_m) = (snap(p.x, 65536.0), snap(p.y, 65536.0));
        (p.amax() < SEEN_M).then_some((step, State { x_m, y_m, ..*state }))
    };
    (0..STEPS).filter_map(shifted)
}

fn snap(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

/// A scene of the given road users; the first is the ego.
fn window(recording: &SimulatedRecording, start: usize, cast: &Cast, id: String, name: String) -> Scene {
    let mut agents = Vec::new();
    for (n, &i) in cast.actors.iter().enumerate() {
        let actor = &recording.actors[i];
        let mut states = vec![None; STEPS];
        for (step, state) in seen(actor, start, cast.origin) {
            states[step] = Some(state);
        }
        let role = if n == 0 { Some("ego") } else { actor.parked.then_some("parked") };
        agents.push(Agent {
            id: (n + 1).to_string(),
            agent_type: actor.agent_type,
            subtype: actor.subtype,
            role: role.map(str::to_owned),
            size: actor.size,
            track: Track { first_step: 0, states, z_m: None }.into(),
            conditions: Conditions::default(),
        });
    }
    sight::hide_unseen(&mut agents, STEPS);
    agents.retain(|a| a.track.states.iter().flatten().count() >= FEWEST_STATES);
    let map = crop(&recording.map.map, cast.origin);
    let signals = signals(recording, start, &map, cast.origin);
    let moves = |a: &Agent| a.track.extent_m() > 3.0 && a.track.states.iter().all(Option::is_some);
    let to_predict = agents.iter().filter(|a| moves(a)).take(8).map(|a| (a.id.clone(), 0)).collect();
    Scene {
        id: None,
        name,
        meta: Meta {
            source: "synthetic".to_owned(),
            source_id: Some(id),
            licence: Some("cc0".to_owned()),
            origin: Origin { x_m: cast.origin.x, y_m: cast.origin.y, ..Origin::default() },
            tracks_to_predict: to_predict,
            ..Meta::default()
        },
        time: Timing { steps: STEPS, now_step: NOW },
        map: map.into(),
        signals,
        agents,
        generated: None,
        extra: Default::default(),
    }
}

/// States of the signals of a map's features over a window.
pub fn signals(recording: &SimulatedRecording, start: usize, map: &LaneMap, origin: Vec2) -> Vec<Signal> {
    let lanes = map.lanes.iter().map(|l| l.id.as_str());
    let kept: HashSet<&str> = lanes.chain(map.crosswalks.iter().map(|c| c.id.as_str())).collect();
    let from_s = WARM_UP_S + start as f64 * DT_S;
    let NetMap { signals, .. } = &recording.map;
    let in_map = signals.iter().filter(|s| kept.contains(s.feature.as_str()));
    in_map
        .map(|s| Signal {
            lane: s.feature.clone(),
            stop: Some(s.stop - origin),
            stop_z_m: None,
            runs: recording.signals.runs(&s.program, s.link, from_s, STEP_S, STEPS),
        })
        .collect()
}

/// The features of a map near a point, relative to that point. Features are kept whole; links to omitted
/// features are removed.
pub fn crop(map: &LaneMap, origin: Vec2) -> LaneMap {
    let near = |points: &Points| points.xy.iter().any(|p| (p - origin).amax() < MAP_M);
    let moved = |points: &Points| -> Points {
        let shift = |p: &Vec2| (p - origin).map(|v| snap(v, 512.0));
        points.xy.iter().map(shift).collect::<Vec<_>>().into()
    };
    let kept: HashSet<&str> = map.lanes.iter().filter(|l| near(&l.points)).map(|l| l.id.as_str()).collect();
    let linked = |ids: &[String]| ids.iter().filter(|id| kept.contains(id.as_str())).cloned().collect();
    let lanes = map.lanes.iter().filter(|l| near(&l.points)).map(|l| {
        let beside = |list: &[scene::map::Neighbor]| {
            list.iter().filter(|n| kept.contains(n.lane.as_str())).cloned().collect()
        };
        Lane {
            points: moved(&l.points),
            predecessors: linked(&l.predecessors),
            successors: linked(&l.successors),
            left_neighbors: beside(&l.left_neighbors),
            right_neighbors: beside(&l.right_neighbors),
            ..l.clone()
        }
    });
    let lines = |list: &[TypedLine]| -> Vec<TypedLine> {
        let kept = list.iter().filter(|l| near(&l.points));
        kept.map(|l| TypedLine { points: moved(&l.points), ..l.clone() }).collect()
    };
    let areas = |list: &[Area]| -> Vec<Area> {
        let kept = list.iter().filter(|a| near(&a.polygon));
        kept.map(|a| Area { polygon: moved(&a.polygon), ..a.clone() }).collect()
    };
    let signs = map.stop_signs.iter().filter_map(|s| {
        let lanes: Vec<String> = linked(&s.lanes);
        let position = s.position - origin;
        (!lanes.is_empty()).then(|| scene::map::StopSign { position, lanes, ..s.clone() })
    });
    LaneMap {
        lanes: lanes.collect(),
        road_lines: lines(&map.road_lines),
        road_edges: lines(&map.road_edges),
        crosswalks: areas(&map.crosswalks),
        speed_bumps: Vec::new(),
        driveways: areas(&map.driveways),
        stop_signs: signs.collect(),
        drivable: areas(&map.drivable),
    }
}
