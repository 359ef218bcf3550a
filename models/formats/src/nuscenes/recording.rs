//! Converts the tables to scenes: road users from the annotations, the ego from its poses.

use super::map::Expansion;
use super::tables::{SceneRow, Tables};
use crate::around::MapPart;
use crate::cut::cut;
use crate::format::ImportOptions;
use crate::frame::yaw;
use crate::problem::{Imported, ReadError};
use crate::recording::{RecordedAgent, RecordedState, Recording, Said, reach};
use crate::source::Source;
use crate::{limits, unpack};
use scene::geometry::direction;
use scene::{AgentType, Meta, Origin, Subtype, Vec2};
use std::collections::{BTreeMap, HashMap};

/// Memory for reading the tables as scenes, bytes per byte of the tables.
const TABLE_MEMORY: u64 = 3;
/// Licence of the data set.
const LICENCE: &str = "cc-by-nc-sa-4.0";
/// The ego vehicle of the data set (Renault Zoe): length, width and height, and distance from the rear axle, to which
/// its poses refer, to its centre, metres.
const EGO_SIZE_M: [f64; 3] = [4.084, 1.730, 1.562];
const EGO_AHEAD_M: f64 = 1.385;
/// Unit of the tables' times, seconds.
const TICK_S: f64 = 1e-6;

/// The tables and maps of a zip.
pub(super) struct NuScenes {
    tables: Tables,
    /// Map expansions by location of the log.
    maps: HashMap<String, Expansion>,
    licence: Option<String>,
}

impl NuScenes {
    /// # Errors
    /// The bounds of a file, `malformed-file`, `malformed-json`, `cannot-represent`.
    pub fn read(file: &dyn Source, options: &ImportOptions) -> Result<Self, ReadError> {
        let most = limits::MAX_DECODED_BYTES.min(limits::memory_for(file.encoded_len()) / TABLE_MEMORY);
        let mut files = HashMap::new();
        for (path, bytes) in unpack::zipped(file, most, |name| name.ends_with(".json"))? {
            let name = path.rsplit('/').next().unwrap_or_default().to_owned();
            files.entry(name).or_insert(bytes);
        }
        let tables = Tables::read(&files)?;
        let mut maps = HashMap::new();
        for location in tables.locations.values() {
            let name = format!("{location}.json");
            if let (Some(bytes), false) = (files.get(&name), maps.contains_key(location)) {
                maps.insert(location.clone(), Expansion::read(bytes, &name)?);
            }
        }
        Ok(Self { tables, maps, licence: options.licence.clone() })
    }

    /// The scenes, each built on demand.
    pub fn scenes(self) -> impl Iterator<Item = Result<Imported, ReadError>> {
        (0..self.tables.scenes.len()).flat_map(move |i| {
            let recording = self.tables.scenes.get(i).map(|row| self.recording(row));
            recording.into_iter().flat_map(Recording::scenes).collect::<Vec<_>>()
        })
    }

    fn recording(&self, row: &SceneRow) -> Recording {
        let samples = self.tables.samples_of(row);
        let start = samples.first().map_or(0, |(_, sample)| sample.timestamp);
        let mut users: BTreeMap<&str, RecordedAgent> = BTreeMap::new();
        let mut ego = Vec::new();
        for (token, sample) in &samples {
            let time_s = sample.timestamp.saturating_sub(start) as f64 * TICK_S;
            let state = |at: [f64; 3], heading_rad: f64| RecordedState {
                time_s,
                at: Vec2::new(at[0], at[1]),
                heading_rad,
                velocity: Vec2::repeat(f64::NAN),
                z_m: at[2],
            };
            if let Some(pose) = self.tables.egos.get(*token) {
                let mut state = state(pose.translation, yaw(pose.rotation));
                state.at += direction(state.heading_rad) * EGO_AHEAD_M;
                ego.push(state);
            }
            for seen in self.tables.annotations.get(*token).into_iter().flatten() {
                let category = self.tables.categories.get(&seen.instance_token).map_or("", String::as_str);
                let (agent_type, subtype) = kind(category);
                let [width, length, height] =
                    seen.size.map(|side| Some(side).filter(|v| (0.05..=100.0).contains(v)));
                let user = users.entry(&seen.instance_token).or_insert_with(|| RecordedAgent {
                    id: seen.instance_token.clone(),
                    agent_type,
                    subtype,
                    role: None,
                    size_m: [length, width, height],
                    samples: Vec::new(),
                });
                user.samples.push(state(seen.translation, yaw(seen.rotation)));
            }
        }
        let mut all: Vec<RecordedAgent> = RecordedAgent::ego(EGO_SIZE_M, ego).into_iter().collect();
        all.extend(users.into_values());
        let mut said = Said {
            name: row.name.clone(),
            start_s: Some(0.0),
            meta: Meta {
                source: "nuscenes".into(),
                source_id: Some(row.token.clone()),
                licence: Some(self.licence.clone().unwrap_or_else(|| LICENCE.to_owned())),
                ..Meta::default()
            },
            ..Said::default()
        };
        self.lay_map(row, &all, &mut said);
        Recording { said, users: all, futures: Vec::new() }
    }

    /// Adds the map of the location to a scene, cut to the reach of its road users.
    fn lay_map(&self, row: &SceneRow, users: &[RecordedAgent], said: &mut Said) {
        let expansion = self.tables.locations.get(&row.log_token).and_then(|place| self.maps.get(place));
        let (Some(expansion), Some((origin, radius_m))) = (expansion, reach(users)) else { return };
        let (mut map, warnings) = expansion.map(origin);
        said.warnings.extend(warnings);
        said.warnings.push(cut(&mut map, &mut Vec::new(), &MapPart::about(origin, radius_m)));
        said.map = map.into();
        said.origin = Some(Origin { x_m: origin.x, y_m: origin.y, ..Origin::default() });
    }
}

/// Kind of a category such as `vehicle.bus.rigid`.
fn kind(category: &str) -> (AgentType, Subtype) {
    let part = |i: usize| category.split('.').nth(i).unwrap_or_default();
    match (part(0), part(1), part(2)) {
        ("vehicle", "bicycle", _) => (AgentType::Cyclist, Subtype::Bicycle),
        ("vehicle", kind, _) => {
            let subtype = match kind {
                "car" => Subtype::Car,
                "truck" | "construction" => Subtype::Truck,
                "bus" => Subtype::Bus,
                "trailer" => Subtype::Trailer,
                "motorcycle" => Subtype::Motorcycle,
                "emergency" => Subtype::Emergency,
                _ => Subtype::Unknown,
            };
            (AgentType::Vehicle, subtype)
        }
        ("human", "pedestrian", kind) => {
            let subtype = match kind {
                "adult" | "construction_worker" | "police_officer" => Subtype::Adult,
                "child" => Subtype::Child,
                "wheelchair" => Subtype::Wheelchair,
                _ => Subtype::Unknown,
            };
            (AgentType::Pedestrian, subtype)
        }
        _ => (AgentType::Other, Subtype::Unknown),
    }
}
