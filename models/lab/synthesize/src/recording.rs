//! One seed, from its network to the cleaned tracks of all road users.

use super::demand::{self, DemandFactors};
use super::fleet::{ActorKind, Fleet};
use super::footpath::Kerbs;
use super::network::{Network, Rank};
use super::programs::{ProgramError, Sumo};
use super::random::Purpose;
use super::tracks::{self, Cleaned};
use super::{DT_S, RECORDED_S, parked, scripted};
use formats::polyline::resample;
use formats::sumo::SumoError;
use formats::sumo::fcd;
use formats::sumo::map::{MapOptions, NetMap, lane_id, lane_map};
use formats::sumo::net::{LaneKind, Net};
use formats::sumo::signals::SignalLog;
use scene::geometry::obb::{OrientedBox, signed_gap};
use scene::map::Area;
use scene::random::Stream;
use scene::{AgentType, Size, Subtype, Vec2};
use std::collections::HashSet;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

/// Overlap of two boxes that makes a track unusable, metres.
const DEEP_M: f64 = 0.2;
/// Steps between two searches for overlaps.
pub const CHECK_EVERY: usize = 5;

/// Why a seed gave no recording.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// A program of SUMO failed.
    #[error(transparent)]
    SignalProgram(#[from] ProgramError),
    /// A file of SUMO could not be read.
    #[error("cannot read SUMO's {file}")]
    File {
        /// Name of the file.
        file: &'static str,
        /// Error in the file.
        source: SumoError,
    },
    /// The temporary folder.
    #[error("cannot use temporary files")]
    Io(#[from] std::io::Error),
}

/// A road user of the simulation.
#[derive(Clone, Debug)]
pub struct SimulatedAgent {
    /// Type in scenes.
    pub agent_type: AgentType,
    /// Finer type in scenes.
    pub subtype: Subtype,
    /// Box.
    pub size: Size,
    /// Whether it is parked for the whole recording.
    pub parked: bool,
    /// Whether SUMO moved it as a person.
    pub on_foot: bool,
    /// States over the recording.
    pub track: Cleaned,
    /// Steps (multiples of [`CHECK_EVERY`]) at which it overlaps another road user.
    pub overlaps: Vec<usize>,
}

impl SimulatedAgent {
    /// A road user of a kind that is not parked.
    pub fn of(kind: &ActorKind, track: Cleaned) -> Self {
        Self {
            agent_type: kind.agent_type,
            subtype: kind.subtype,
            size: kind.size,
            parked: false,
            on_foot: kind.on_foot,
            track,
            overlaps: Vec::new(),
        }
    }
}

/// Recording of one seed, in the network's frame.
#[derive(Debug)]
pub struct SimulatedRecording {
    /// Generated network.
    pub network: Network,
    /// Its map.
    pub map: NetMap,
    /// All road users.
    pub actors: Vec<SimulatedAgent>,
    /// Signal states.
    pub signals: SignalLog,
    /// Ids of map lanes in car parks.
    lot_lanes: HashSet<String>,
}

impl SimulatedRecording {
    /// Removes the lanes of car parks from the map: recorded maps seldom have them, although cars drive
    /// there.
    pub fn unmap_lots(&mut self) {
        self.map.map.lanes.retain(|lane| !self.lot_lanes.contains(&lane.id));
    }
}

/// A folder that is removed at the end.
struct TempFolder(PathBuf);

impl TempFolder {
    fn new(seed: u64) -> std::io::Result<Self> {
        let path = std::env::temp_dir().join(format!("dragtraffic-{}-{seed}", std::process::id()));
        // A leftover of an interrupted run with the same process id.
        if path.exists() {
            std::fs::remove_dir_all(&path)?;
        }
        std::fs::create_dir_all(&path)?;
        Ok(Self(path))
    }
}

impl Drop for TempFolder {
    fn drop(&mut self) {
        // A failure is ignored: the system clears its temporary folder.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Simulates a network and cleans the recorded tracks.
///
/// # Errors
/// When SUMO fails or its files cannot be read.
pub fn record(
    sumo: &Sumo,
    network: Network,
    crowd: Option<DemandFactors>,
    seed: u64,
) -> Result<SimulatedRecording, RecordError> {
    let folder = TempFolder::new(seed)?;
    let path = folder.0.as_path();
    network.write(path)?;
    sumo.build_network(path, &network.character)?;
    let net = Net::read(&std::fs::read_to_string(path.join("net.xml"))?)
        .map_err(|source| RecordError::File { file: "net.xml", source })?;
    let mut draw = Purpose::Demand.stream(seed);
    let fleet = Fleet::new(&mut draw, network.character.name.contains("motorway"));
    let drawn = DemandFactors::new(&mut draw);
    demand::write(&network, &net, &fleet, crowd.unwrap_or(drawn), &mut draw, path)?;
    sumo.simulate(path, seed)?;
    let mut actors = moving(path, &fleet, seed)?;
    let signals = read_signals(path)?;

    let mut map = lane_map(&net, MapOptions { sidewalks: true, parking: true });
    let kerbs = Kerbs::new(&map.map.road_edges);
    for actor in actors.iter_mut().filter(|a| a.on_foot) {
        kerbs.keep_off(&mut actor.track);
    }
    let parked = parked::park(&network, &net, &mut Purpose::Parking.stream(seed));
    let mut next_id = 1_000_000;
    let mut areas = |rings: &[Vec<Vec2>]| -> Vec<Area> {
        let area = |ring: &Vec<Vec2>| {
            next_id += 1;
            Area { id: next_id.to_string(), polygon: ring.clone().into(), holes: Vec::new() }
        };
        rings.iter().map(area).collect()
    };
    map.map.driveways.extend(areas(&parked.driveways));
    map.map.drivable.extend(areas(&network.paved));
    for car in &parked.cars {
        actors.push(SimulatedAgent {
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            size: car.size,
            parked: true,
            on_foot: false,
            track: tracks::still(car.position, car.heading_rad),
            overlaps: Vec::new(),
        });
    }
    standing(&net, &mut actors, &mut Purpose::Standing.stream(seed));
    scripted::add(&net, &fleet, &mut actors, &mut Purpose::Scripted.stream(seed));
    find_overlaps(&mut actors);
    let in_lot = |lane: &usize| net.edge_of(*lane).road_type == Rank::Lot.name();
    let lot_lanes = (0..net.lanes.len()).filter(in_lot).map(lane_id).collect();
    Ok(SimulatedRecording { network, map, actors, signals, lot_lanes })
}

fn moving(path: &Path, fleet: &Fleet, seed: u64) -> Result<Vec<SimulatedAgent>, RecordError> {
    let file = std::io::BufReader::new(std::fs::File::open(path.join("fcd.csv"))?);
    let records = fcd::read_csv(file).map_err(|source| RecordError::File { file: "fcd.csv", source })?;
    let mut draw = Purpose::Motion.stream(seed);
    let mut actors = Vec::new();
    for record in records.into_values() {
        let Some(kind) = fleet.kinds.get(&record.vehicle_type) else { continue };
        let Some(track) = tracks::clean(&record, kind, &mut draw) else { continue };
        actors.push(SimulatedAgent::of(kind, track));
    }
    Ok(actors)
}

fn read_signals(path: &Path) -> Result<SignalLog, RecordError> {
    match std::fs::read_to_string(path.join("tls.xml")) {
        Ok(text) => SignalLog::read(&text).map_err(|source| RecordError::File { file: "tls.xml", source }),
        // A network without signals writes none.
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(SignalLog::default()),
        Err(error) => Err(error.into()),
    }
}

/// Adds one standing pedestrian per eight walking ones.
fn standing(net: &Net, actors: &mut Vec<SimulatedAgent>, draw: &mut Stream) {
    let sidewalks: Vec<&Vec<Vec2>> =
        net.lanes.iter().filter(|l| l.kind == LaneKind::Sidewalk).map(|l| &l.shape).collect();
    let walkers = actors.iter().filter(|a| a.agent_type == AgentType::Pedestrian).count();
    if sidewalks.is_empty() {
        return;
    }
    for _ in 0..draw.poisson(0.12 * walkers as f64) {
        let line = resample(sidewalks[draw.below(sidewalks.len())], 1.0);
        let at = if draw.chance(0.6) { draw.below(line.len()) } else { draw.below(2) * (line.len() - 1) };
        let place = line[at] + Vec2::from(draw.normal_pair()) * 0.4;
        let side = draw.clipped(0.85, 0.1, 0.6, 1.1);
        let heading = draw.between(-PI, PI);
        actors.push(SimulatedAgent {
            agent_type: AgentType::Pedestrian,
            subtype: Subtype::Adult,
            size: Size { length_m: side, width_m: side, height_m: Some(1.75) },
            parked: false,
            on_foot: true,
            track: tracks::stand(place, heading, draw),
            overlaps: Vec::new(),
        });
    }
}

/// Records overlaps of vehicles and cyclists. A parked car that another touches is removed. If a cyclist is
/// involved, the overlap counts for the cyclist (first for one on the sidewalk).
fn find_overlaps(actors: &mut Vec<SimulatedAgent>) {
    let wheeled: Vec<usize> =
        (0..actors.len()).filter(|&i| actors[i].agent_type != AgentType::Pedestrian).collect();
    let mut gone = vec![false; actors.len()];
    for step in (0..=(RECORDED_S / DT_S) as usize).step_by(CHECK_EVERY) {
        let boxes: Vec<(usize, OrientedBox)> = wheeled
            .iter()
            .filter_map(|&i| Some((i, OrientedBox::of_state(actors[i].track.at(step)?, &actors[i].size))))
            .collect();
        for (n, (i, a)) in boxes.iter().enumerate() {
            for (j, b) in &boxes[n + 1..] {
                let near = (a.center() - b.center()).norm() < a.radius_m() + b.radius_m();
                if !near || actors[*i].parked && actors[*j].parked || signed_gap(a, b) > -DEEP_M {
                    continue;
                }
                if let Some(&car) = [i, j].into_iter().find(|k| actors[**k].parked) {
                    gone[car] = true;
                    continue;
                }
                let rides = |k: usize| actors[k].agent_type == AgentType::Cyclist;
                let fault: Vec<usize> = match [*i, *j].into_iter().find(|&k| rides(k) && actors[k].on_foot) {
                    Some(k) => vec![k],
                    None => match [*i, *j].into_iter().find(|&k| rides(k)) {
                        Some(k) => vec![k],
                        None => vec![*i, *j],
                    },
                };
                for k in fault {
                    actors[k].overlaps.push(step);
                }
            }
        }
    }
    let mut kept = gone.iter();
    actors.retain(|_| !kept.next().copied().unwrap_or(false));
}
