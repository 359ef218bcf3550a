//! Demo scenes: manually designed networks with simulated traffic, of which the nine seconds with the best score
//! are selected. `cargo run -p dragtraffic-lab-synthesize --example demo_scenes -- assets/scenes` writes them.

use super::demand::DemandFactors;
use super::demo_check;
use super::demo_networks as networks;
use super::network::Network;
use super::programs::Sumo;
use super::recording::{self, RecordError, SimulatedAgent, SimulatedRecording};
use super::windows::{self, NOW, STEPS};
use super::{DT_S, RECORDED_S, demo_clip, demo_mend};
use formats::polyline::contains;
use scene::geometry::{cross, direction};
use scene::{Agent, AgentType, Conditions, Meta, Scene, Size, State, Subtype, Timing, Track, Vec2};
use std::path::{Path, PathBuf};

/// Half a side of the square in which a demo shows road users, metres.
const SHOWN_M: f64 = 110.0;
/// Half a side of the square to which the map is cut, metres.
const MAP_M: f64 = 125.0;

/// Recipe of a demo scene.
pub struct Demo {
    /// Id and file name.
    pub id: &'static str,
    /// Display name of the place.
    pub name: &'static str,
    /// Description.
    pub notes: &'static str,
    network: fn() -> Network,
    crowd: DemandFactors,
    seeds: &'static [u64],
    /// Wanted numbers: moving vehicles, parked vehicles, pedestrians, cyclists.
    wanted: [usize; 4],
    /// Least number of buses.
    buses: usize,
    /// Whether signals must change.
    signals: bool,
    /// Vehicles that move less than this in the whole time are stuck, metres.
    least_m: f64,
}

/// All demo scenes.
pub const DEMOS: [Demo; 5] = [
    Demo {
        id: "demo-crossing",
        name: "Rosa & 5th",
        notes: "Signalised crossing with left-turn lanes, bike lanes, crosswalks and parked cars.",
        network: networks::crossing,
        crowd: DemandFactors { traffic: 0.55, cyclists: 26.0, people: 30.0, buses: 0.05 },
        seeds: &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12],
        wanted: [16, 14, 10, 5],
        buses: 1,
        signals: true,
        least_m: 0.0,
    },
    Demo {
        id: "demo-roundabout",
        name: "Roundabout, 4 arms",
        notes: "Single-lane roundabout with crosswalks on all arms.",
        network: networks::roundabout,
        crowd: DemandFactors { traffic: 1.9, cyclists: 26.0, people: 30.0, buses: 0.04 },
        seeds: &[1, 2, 3, 4],
        wanted: [13, 0, 9, 4],
        buses: 0,
        signals: false,
        least_m: 3.0,
    },
    Demo {
        id: "demo-motorway",
        name: "Ring road merge",
        notes: "Motorway entry; a street with a sidewalk and bike lanes runs beside it.",
        network: networks::motorway,
        crowd: DemandFactors { traffic: 1.35, cyclists: 30.0, people: 45.0, buses: 0.01 },
        seeds: &[1, 2, 3, 4, 5, 6, 7, 8],
        wanted: [30, 0, 6, 4],
        buses: 0,
        signals: false,
        least_m: 90.0,
    },
    Demo {
        id: "demo-residential",
        name: "School street",
        notes: "Residential street with parked cars, driveways and stop signs.",
        network: networks::residential,
        crowd: DemandFactors { traffic: 4.2, cyclists: 22.0, people: 34.0, buses: 0.0 },
        seeds: &[1, 2, 3, 4],
        wanted: [6, 22, 10, 4],
        buses: 0,
        signals: false,
        least_m: 3.0,
    },
    Demo {
        id: "demo-arterial",
        name: "Market, evening peak",
        notes: "Arterial with two signalised crossings and a bus.",
        network: networks::arterial,
        crowd: DemandFactors { traffic: 0.95, cyclists: 24.0, people: 22.0, buses: 0.05 },
        seeds: &[1, 2, 3, 4, 5, 6, 7, 8],
        wanted: [38, 6, 12, 5],
        buses: 1,
        signals: true,
        least_m: 0.0,
    },
];

/// Why a demo was not made.
#[derive(Debug, thiserror::Error)]
pub enum DemoError {
    /// The traffic could not be simulated.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// No part of the recordings fits.
    #[error("{0}: no nine seconds fit in any of its seeds")]
    NoWindow(&'static str),
    /// The file could not be written.
    #[error("{path}: {source}")]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
}

/// Makes one demo scene.
///
/// # Errors
/// When SUMO is missing or fails, or no part of the traffic passes the checks.
pub fn scene_of(demo: &Demo, sumo_home: Option<&Path>) -> Result<Scene, DemoError> {
    let sumo = Sumo::find(sumo_home).map_err(RecordError::from)?;
    let mut best: Option<(f64, Scene)> = None;
    for &seed in demo.seeds {
        let recording = recording::record(&sumo, (demo.network)(), Some(demo.crowd), seed)?;
        let starts = (0..(RECORDED_S / DT_S) as usize - STEPS).step_by(10);
        for start in starts {
            let Some(scene) = demo.window(&recording, start) else { continue };
            let score = demo.misfit(&scene, &recording, start);
            if best.as_ref().is_none_or(|(least, _)| score < *least) {
                // A demo has no events: unneeded road users that cause one are removed.
                let scene = demo_check::without_troublemakers(scene);
                if demo_check::faults(&scene).is_empty() {
                    best = Some((score, scene));
                }
            }
        }
    }
    best.map(|(_, scene)| scene).ok_or(DemoError::NoWindow(demo.id))
}

/// Writes demo scenes in the native format, `ID.json` each; all of them, or the named one.
///
/// # Errors
/// See [`scene_of`]; also when a file cannot be written.
pub fn demo(folder: &Path, only: Option<&str>, sumo_home: Option<&Path>) -> Result<Vec<PathBuf>, DemoError> {
    let mut written = Vec::new();
    for demo in DEMOS.iter().filter(|d| only.is_none_or(|id| d.id == id)) {
        let scene = scene_of(demo, sumo_home)?;
        let path = folder.join(format!("{}.json", demo.id));
        let write = || -> std::io::Result<()> {
            std::fs::create_dir_all(folder)?;
            std::fs::write(&path, formats::native::write(&scene))
        };
        write().map_err(|source| DemoError::Write { path: path.clone(), source })?;
        written.push(path);
    }
    Ok(written)
}

/// Corrects an existing demo scene by the current rules, and returns it with its remaining faults.
pub fn mended(scene: Scene) -> (Scene, Vec<String>) {
    let scene = demo_check::without_troublemakers(demo_mend::mend(scene, MAP_M));
    let faults = demo_check::faults(&scene);
    (scene, faults)
}

fn rounded(value: f64, parts: f64) -> f64 {
    let value = (value * parts).round() / parts;
    // Negative zeros do not appear in the files.
    if value == 0.0 { 0.0 } else { value }
}

impl Demo {
    /// The scene from a step on, if no road user in it jumps.
    fn window(&self, recording: &SimulatedRecording, start: usize) -> Option<Scene> {
        let mut cast: Vec<(&SimulatedAgent, Vec<Option<State>>)> =
            recording.actors.iter().map(|a| (a, shown(a, start))).filter(|(_, s)| usable(s)).collect();
        let jumps = |a: &SimulatedAgent| a.track.jumps.iter().any(|s| (start..start + STEPS).contains(s));
        if cast.iter().any(|(a, _)| jumps(a)) {
            return None;
        }
        self.thin_out(&mut cast);
        let agents: Vec<Agent> =
            cast.into_iter().enumerate().map(|(n, (a, states))| agent(n, a, states)).collect();
        let map = demo_clip::clip(&recording.map.map, MAP_M);
        let signals = windows::signals(recording, start, &map, Vec2::zeros());
        let scene = Scene {
            id: Some(self.id.to_owned()),
            name: self.name.to_owned(),
            meta: Meta {
                source: "synthetic".to_owned(),
                source_id: Some(self.id.to_owned()),
                licence: Some("cc0".to_owned()),
                tags: vec!["demo".to_owned()],
                notes: self.notes.to_owned(),
                ..Meta::default()
            },
            time: Timing { steps: STEPS, now_step: NOW },
            map: map.into(),
            signals,
            agents,
            generated: None,
            extra: Default::default(),
        };
        Some(demo_mend::mend(demo_check::without_overlaps(scene), MAP_M))
    }

    /// Removes pedestrians, cyclists and parked cars beyond the wanted numbers, the farthest first.
    fn thin_out(&self, cast: &mut Vec<(&SimulatedAgent, Vec<Option<State>>)>) {
        let distance = |states: &[Option<State>]| {
            states.iter().flatten().map(|s| s.position().norm()).fold(f64::INFINITY, f64::min)
        };
        // The nearest moving car is first: it is the ego.
        let rank = |a: &SimulatedAgent| (a.agent_type != AgentType::Vehicle, a.parked);
        cast.sort_by(|a, b| {
            let (p, q) = (distance(&a.1), distance(&b.1));
            rank(a.0).cmp(&rank(b.0)).then(p.total_cmp(&q))
        });
        let mut left = [usize::MAX, self.wanted[1], self.wanted[2] + 2, self.wanted[3] + 1];
        cast.retain(|(actor, _)| {
            let group = match actor.agent_type {
                AgentType::Vehicle => usize::from(actor.parked),
                AgentType::Pedestrian => 2,
                _ => 3,
            };
            let keep = left[group] > 0;
            left[group] = left[group].saturating_sub(1);
            keep
        });
    }

    /// Deviation of a scene from the demo's target.
    fn misfit(&self, scene: &Scene, recording: &SimulatedRecording, start: usize) -> f64 {
        let parked = |a: &&Agent| a.role.as_deref() == Some("parked");
        let count = |t: AgentType| scene.agents.iter().filter(|a| a.agent_type == t).count();
        let at_rest = scene.agents.iter().filter(parked).count();
        let found = [
            count(AgentType::Vehicle) - at_rest,
            at_rest,
            count(AgentType::Pedestrian),
            count(AgentType::Cyclist),
        ];
        let mut score = 0.0;
        for ((found, wanted), weight) in found.iter().zip(self.wanted).zip([2.5, 0.5, 2.0, 3.0]) {
            score += weight * found.abs_diff(wanted) as f64;
        }
        let buses = scene.agents.iter().filter(|a| a.subtype == Subtype::Bus && near(a, 70.0)).count();
        score += 15.0 * self.buses.saturating_sub(buses) as f64;
        // Preferred: cars that move far and turn, pedestrians who walk near the middle and on crosswalks.
        for agent in scene.agents.iter().filter(|a| near(a, 45.0)) {
            let moved = agent.track.extent_m();
            score -= match agent.agent_type {
                AgentType::Vehicle if moved > 12.0 => {
                    1.5 + if turns(agent) || shifts(agent) { 1.5 } else { 0.0 }
                }
                AgentType::Cyclist if moved > 8.0 => 1.2,
                AgentType::Pedestrian if crosses(scene, agent) => 4.0,
                AgentType::Pedestrian if moved > 5.0 => 0.5,
                _ => 0.0,
            };
        }
        let changes = |from: usize, to: usize| {
            scene.signals.iter().any(|s| s.runs.iter().skip(1).any(|r| (from..to).contains(&r.0)))
        };
        if self.signals && !changes(15, 60) {
            score += 20.0;
        }
        // No vehicle should stand on the road for the whole time.
        let stuck = |a: &&Agent| {
            let moves = a.agent_type == AgentType::Vehicle && !parked(a);
            moves && a.track.states.iter().all(Option::is_some) && a.track.extent_m() < self.least_m
        };
        score += 5.0 * scene.agents.iter().filter(stuck).count() as f64;
        // A planner starts from the first frame: no vehicle stands on a crosswalk at signals, and none is
        // askew.
        let at_rest = |a: &&Agent| a.track.at(0).is_some_and(|s| s.speed_mps() < 4.0);
        let starts_badly = |a: &&Agent| {
            self.signals && demo_check::is_on_crosswalk(scene, a, 0) || demo_check::is_askew(scene, a, 0)
        };
        score += 6.0 * scene.agents.iter().filter(at_rest).filter(starts_badly).count() as f64;
        // All road users should be present from the first frame on.
        let late = scene.agents.iter().filter(|a| a.track.at(0).is_none()).count();
        score + 0.4 * late as f64 + 1e-6 * (start + recording.actors.len()) as f64
    }
}

fn near(agent: &Agent, reach: f64) -> bool {
    agent.track.states.iter().flatten().any(|s| s.position().norm() < reach)
}

fn crosses(scene: &Scene, agent: &Agent) -> bool {
    let mut places = agent.track.states.iter().flatten().step_by(10).map(State::position);
    places.any(|p| scene.map.crosswalks.iter().any(|c| contains(&c.polygon.xy, p)))
}

fn turns(agent: &Agent) -> bool {
    let mut states = agent.track.states.iter().flatten();
    match (states.next(), states.next_back()) {
        (Some(a), Some(b)) => scene::wrap_angle(b.heading_rad - a.heading_rad).abs() > 0.6,
        _ => false,
    }
}

/// Whether the motion ends beside its first direction without a turn, as in a lane change or a merge.
fn shifts(agent: &Agent) -> bool {
    let mut states = agent.track.states.iter().flatten();
    match (states.next(), states.next_back()) {
        (Some(a), Some(b)) => {
            cross(direction(a.heading_rad), b.position() - a.position()).abs() > 2.5 && !turns(agent)
        }
        _ => false,
    }
}

fn shown(actor: &SimulatedAgent, start: usize) -> Vec<Option<State>> {
    let inside = |s: &&State| s.position().amax() < SHOWN_M;
    (0..STEPS)
        .map(|step| {
            actor.track.at(start + step).filter(inside).map(|s| State {
                x_m: rounded(s.x_m, 1e3),
                y_m: rounded(s.y_m, 1e3),
                heading_rad: rounded(s.heading_rad, 1e4),
                vx_mps: rounded(s.vx_mps, 1e3),
                vy_mps: rounded(s.vy_mps, 1e3),
            })
        })
        .collect()
}

/// Whether the states cover at least two seconds without gaps.
fn usable(states: &[Option<State>]) -> bool {
    let seen = states.iter().filter(|s| s.is_some()).count();
    let pieces = states.windows(2).filter(|w| w[0].is_none() && w[1].is_some()).count();
    seen >= 20 && pieces + usize::from(states[0].is_some()) == 1
}

fn agent(n: usize, actor: &SimulatedAgent, states: Vec<Option<State>>) -> Agent {
    let role = if n == 0 { Some("ego") } else { actor.parked.then_some("parked") };
    let body = if actor.agent_type == AgentType::Pedestrian {
        Size { length_m: 0.6, width_m: 0.6, height_m: Some(1.75) }
    } else {
        Size {
            length_m: rounded(actor.size.length_m, 100.0),
            width_m: rounded(actor.size.width_m, 100.0),
            height_m: actor.size.height_m,
        }
    };
    Agent {
        id: (n + 1).to_string(),
        agent_type: actor.agent_type,
        subtype: actor.subtype,
        role: role.map(str::to_owned),
        size: body,
        track: Track { first_step: 0, states, z_m: None }.into(),
        conditions: Conditions::default(),
    }
}
