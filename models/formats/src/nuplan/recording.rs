//! Turns a log into scenes: road users from the lidar sweeps, the ego from its poses, and the city around
//! them.

use super::database::Database;
use super::log::{LogPose, LogScene, LogTables};
use super::map::{CityMap, LaneKey};
use crate::around::{Around, Chosen, MapPart};
use crate::cut::cut;
use crate::format::{ImportOptions, NET_POINTER};
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::recording::{RecordedAgent, RecordedLight, RecordedState, Recording, Said, reach};
use crate::refusals::{self, what};
use crate::sentences;
use crate::source::Source;
use scene::geometry::direction;
use scene::map::Lane;
use scene::{AgentType, Meta, Origin, SignalState, Subtype};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Licence of the data set.
pub(super) const LICENCE: &str = "cc-by-nc-sa-4.0";
/// The data set's car (Chrysler Pacifica): length, width and height, and the distance of its centre ahead of
/// the rear axle, to which its poses refer, metres.
const EGO_SIZE_M: [f64; 3] = [5.176, 2.297, 1.777];
const EGO_AHEAD_M: f64 = 1.461;
/// Seconds per unit of the tables' times.
const TICK_S: f64 = 1e-6;
/// Most kinds of situations in the tags of a scene.
const MAX_TAGS: usize = 32;
/// Prefix of the tag that names a scene's city.
const CITY: &str = "city:";

/// A log with the map of its city.
pub(super) struct NuPlan {
    log: LogTables,
    map: Option<CityMap>,
    licence: String,
}

impl NuPlan {
    /// # Errors
    /// Those of the tables; those of the map lie under [`NET_POINTER`].
    pub fn read(database: &Database, options: &ImportOptions) -> Result<Self, ReadError> {
        let log = LogTables::read(database)?;
        if log.scenes.is_empty() {
            return Err(ReadError::other_content(refusals::file_has_no(what::SCENE)));
        }
        let city = |net| CityMap::read(&Database::open(net)?, log.zone);
        let map = options.net.as_ref().map(|net| city(net as &dyn Source)).transpose();
        let map = map.map_err(|error| error.under(NET_POINTER))?;
        Ok(Self { log, map, licence: options.licence.clone().unwrap_or_else(|| LICENCE.to_owned()) })
    }

    /// The scenes, each built on demand.
    pub fn scenes(self) -> impl Iterator<Item = Result<Imported, ReadError>> {
        (0..self.log.scenes.len()).flat_map(move |i| {
            let recording = self.log.scenes.get(i).map(|scene| self.recording(scene));
            recording.into_iter().flat_map(Recording::scenes).collect::<Vec<_>>()
        })
    }

    fn recording(&self, scene: &LogScene) -> Recording {
        let log = &self.log;
        let sweeps = log.sweeps.get(scene.sweeps.clone()).unwrap_or_default();
        let start = sweeps.first().map_or(0, |sweep| sweep.time);
        let time_s = |sweep: usize| {
            log.sweeps.get(sweep).map_or(0.0, |sweep| sweep.time.saturating_sub(start) as f64 * TICK_S)
        };
        let mut ego = Vec::new();
        for (sweep, pose) in scene.sweeps.clone().zip(sweeps.iter().map(|sweep| sweep.ego)) {
            let Some(pose) = pose else { continue };
            let mut state = state(time_s(sweep), &pose);
            state.at += direction(state.heading_rad) * EGO_AHEAD_M;
            ego.push(state);
        }
        let mut users: BTreeMap<usize, RecordedAgent> = BTreeMap::new();
        for (sweep, seen) in log.boxes.within(&scene.sweeps) {
            let Some(track) = log.tracks.get(seen.track) else { continue };
            let user = users.entry(seen.track).or_insert_with(|| {
                let (agent_type, subtype) = kind(&track.category);
                let size_m = track.size_m.map(|side| side.filter(|side| (0.05..=100.0).contains(side)));
                RecordedAgent {
                    id: track.token.clone(),
                    agent_type,
                    subtype,
                    role: None,
                    size_m,
                    samples: Vec::new(),
                }
            });
            user.samples.push(state(time_s(*sweep), &seen.pose));
        }
        let mut all: Vec<RecordedAgent> = RecordedAgent::ego(EGO_SIZE_M, ego).into_iter().collect();
        all.extend(users.into_values());
        let tags = || log.tags.within(&scene.sweeps).iter().map(|(_, tag)| tag);
        let kinds: BTreeSet<&str> = tags().map(|tag| tag.kind.as_str()).collect();
        let about: BTreeSet<usize> = tags().filter_map(|tag| tag.track).collect();
        let city = (!log.city.is_empty()).then(|| format!("{CITY}{}", log.city));
        let mut said = Said {
            name: scene.name.clone(),
            start_s: Some(0.0),
            crs: log.zone.map(|zone| zone.name()),
            meta: Meta {
                source: "nuplan".into(),
                source_id: Some(scene.token.clone()).filter(|token| !token.is_empty()),
                licence: Some(self.licence.clone()),
                tags: city.into_iter().chain(kinds.into_iter().take(MAX_TAGS).map(str::to_owned)).collect(),
                objects_of_interest: (about.into_iter())
                    .filter_map(|track| log.tracks.get(track))
                    .map(|track| track.token.clone())
                    .collect(),
                ..Meta::default()
            },
            ..Said::default()
        };
        match &self.map {
            Some(map) => self.lay_map(map, scene, &all, time_s, &mut said),
            None => said.warnings.push(ImportWarning::new("no-network", sentences::network_missing())),
        }
        Recording { said, users: all, futures: Vec::new() }
    }

    /// Adds the city to a scene, as far as the ego gets, with the lights of its connectors.
    fn lay_map(
        &self,
        city: &CityMap,
        scene: &LogScene,
        users: &[RecordedAgent],
        time_s: impl Fn(usize) -> f64,
        said: &mut Said,
    ) {
        let Some((origin, radius_m)) = reach(users) else { return };
        let around = Around { x: origin.x, y: origin.y, radius_m };
        let part = city.part(origin, Chosen::of(Some(around)));
        let mut map = part.map;
        said.warnings.extend(part.warnings);
        let left_out = part.chosen.left_out;
        let circle = MapPart { left_out, ..MapPart::about(origin, radius_m) };
        said.warnings.push(cut(&mut map, &mut Vec::new(), &circle));
        let mut lights: BTreeMap<i64, BTreeMap<usize, SignalState>> = BTreeMap::new();
        for (sweep, seen) in self.log.lights.within(&scene.sweeps) {
            lights.entry(seen.connector).or_default().insert(*sweep, seen.state);
        }
        let lanes: HashMap<&str, &Lane> = map.lanes.iter().map(|lane| (lane.id.as_str(), lane)).collect();
        for (connector, seen) in lights {
            let id = part.ids.get(&LaneKey::Connector(connector));
            let Some(lane) = id.and_then(|id| lanes.get(id.as_str())) else { continue };
            let mut states = Vec::new();
            let mut seen = seen.into_iter().peekable();
            while let Some((sweep, state)) = seen.next() {
                states.push((time_s(sweep), state));
                // The light is unknown at sweeps without a state.
                if seen.peek().is_none_or(|(next, _)| *next > sweep + 1) && sweep + 1 < scene.sweeps.end {
                    states.push((time_s(sweep + 1), SignalState::Unknown));
                }
            }
            let stop = lane.points.xy.first().copied();
            said.lights.push(RecordedLight { lane: lane.id.clone(), stop, states });
        }
        said.map = map.into();
        let crs = Some(city.zone.name());
        said.origin = Some(Origin { x_m: origin.x, y_m: origin.y, crs, ..Origin::default() });
    }
}

fn state(time_s: f64, pose: &LogPose) -> RecordedState {
    RecordedState {
        time_s,
        at: pose.at,
        heading_rad: pose.heading_rad,
        velocity: pose.velocity,
        z_m: pose.z_m,
    }
}

/// Kind of a category such as `czone_sign`.
fn kind(category: &str) -> (AgentType, Subtype) {
    match category {
        "vehicle" => (AgentType::Vehicle, Subtype::Unknown),
        "bicycle" => (AgentType::Cyclist, Subtype::Bicycle),
        "pedestrian" => (AgentType::Pedestrian, Subtype::Unknown),
        _ => (AgentType::Other, Subtype::Unknown),
    }
}
