//! Turns positions at times into scenes: the shared part of formats that list the motion of road users row by
//! row.

mod build;
mod motion;

pub(crate) use build::{RecordedFuture, Recording, Said};

use crate::format::EGO;
use crate::limits::MAX_GOAL_DISTANCE_M;
use scene::geometry::Extent;
use scene::{AgentType, STEP_S, Signal, SignalState, Size, Subtype, Vec2};
use std::collections::BTreeSet;

/// Most rows that one scenario may have.
pub(crate) const MAX_SAMPLES: usize = 1_000_000;
/// Most road users of one scenario, of which 256 are chosen.
pub(crate) const MAX_USERS: usize = 20_000;
/// Greatest distance of a coordinate from the origin of a file, metres.
const FARTHEST_M: f64 = 1e8;
/// Distance from the ego's path up to which the map is kept, metres.
const BESIDE_M: f64 = 100.0;

/// State of a road user at a time, in the frame of the file. Values that the file lacks are NaN; a NaN
/// position means that the road user was not seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RecordedState {
    pub time_s: f64,
    /// Centre of the box, metres.
    pub at: Vec2,
    pub heading_rad: f64,
    pub velocity: Vec2,
    pub z_m: f64,
}

impl RecordedState {
    /// Whether the road user was seen, at a place that a map can have.
    pub fn is_seen(&self) -> bool {
        self.at.x.abs() <= FARTHEST_M && self.at.y.abs() <= FARTHEST_M
    }
}

/// A road user of a file.
#[derive(Clone, Debug)]
pub(crate) struct RecordedAgent {
    pub id: String,
    pub agent_type: AgentType,
    pub subtype: Subtype,
    pub role: Option<String>,
    /// Length, width and height as far as the file gives them, metres.
    pub size_m: [Option<f64>; 3],
    pub samples: Vec<RecordedState>,
}

impl RecordedAgent {
    /// The recording car with this length, width and height in metres; `None` if it has no position.
    pub fn ego(size_m: [f64; 3], samples: Vec<RecordedState>) -> Option<Self> {
        (!samples.is_empty()).then(|| Self {
            id: EGO.to_owned(),
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            role: Some(EGO.to_owned()),
            size_m: size_m.map(Some),
            samples,
        })
    }

    /// The box, with the usual size if the file gives none, and whether it does.
    fn size(&self) -> (Size, bool) {
        let usual = Size::default_for(self.agent_type, self.subtype);
        let [length, width, height] = self.size_m;
        let said = length.is_some() && width.is_some();
        let size = Size {
            length_m: length.unwrap_or(usual.length_m),
            width_m: width.unwrap_or(usual.width_m),
            height_m: if said { height } else { height.or(usual.height_m) },
        };
        (size, said)
    }
}

/// The light of a lane at times of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RecordedLight {
    /// Id of the lane in the map.
    pub lane: String,
    /// Stop position, in the frame of the map.
    pub stop: Option<Vec2>,
    /// Rising times in seconds, each with the state from then on.
    pub states: Vec<(f64, SignalState)>,
}

impl RecordedLight {
    /// The light over the steps of a scene that begins at `start_s`.
    fn signal(&self, start_s: f64, steps: usize) -> Signal {
        let mut runs: Vec<(usize, SignalState)> = Vec::new();
        for step in 0..steps {
            let by_s = start_s + (step as f64 + 0.25) * STEP_S;
            let after = self.states.partition_point(|(time_s, _)| *time_s <= by_s);
            let state = after
                .checked_sub(1)
                .and_then(|i| self.states.get(i))
                .map_or(SignalState::Unknown, |(_, state)| *state);
            if runs.last().is_none_or(|(_, last)| *last != state) {
                runs.push((step, state));
            }
        }
        Signal { lane: self.lane.clone(), stop: self.stop, stop_z_m: None, runs }
    }
}

/// Centre and radius of the part of a map that a scene needs: around the ego's path, otherwise around all
/// road users.
pub(crate) fn reach(users: &[RecordedAgent]) -> Option<(Vec2, f64)> {
    let ego = || users.iter().filter(|user| user.role.as_deref() == Some(EGO));
    let reached: Vec<&RecordedAgent> =
        if ego().next().is_some() { ego().collect() } else { users.iter().collect() };
    let seen = reached.iter().flat_map(|user| &user.samples).filter(|sample| sample.is_seen());
    let extent = Extent::about(seen.map(|sample| sample.at))?;
    let radius_m = (extent.size().norm() / 2.0 + BESIDE_M).min(MAX_GOAL_DISTANCE_M);
    Some((extent.middle().map(f64::round), radius_m))
}

/// The median of each coordinate: a few stragglers do not move it.
pub(crate) fn middle(points: impl Iterator<Item = Vec2>) -> Vec2 {
    let (mut x, mut y): (Vec<f64>, Vec<f64>) = points.map(|p| (p.x, p.y)).unzip();
    let median = |list: &mut Vec<f64>| {
        list.sort_by(f64::total_cmp);
        list.get(list.len() / 2).copied().unwrap_or(0.0)
    };
    Vec2::new(median(&mut x), median(&mut y))
}

/// Gives each road user a valid id of its own.
#[derive(Default)]
pub(crate) struct AgentIds {
    taken: BTreeSet<String>,
    pub changed: usize,
}

impl AgentIds {
    /// The id itself if it is valid and free.
    pub fn take(&mut self, id: &str) -> String {
        let legal = |c: char| if c.is_ascii_alphanumeric() || "_.:-".contains(c) { c } else { '_' };
        let mut clean: String = id.chars().map(legal).take(if id.len() > 64 { 56 } else { 64 }).collect();
        if clean.is_empty() {
            clean.push('_');
        }
        let mut name = clean.clone();
        let mut count = 1;
        while self.taken.contains(&name) {
            count += 1;
            clean.truncate(56);
            name = format!("{clean}.{count}");
        }
        self.changed += usize::from(name != id);
        self.taken.insert(name.clone());
        name
    }
}

/// Type and subtype of a road user's word; `None` for an unknown word.
pub(crate) fn kind_of(word: &str) -> Option<(AgentType, Subtype)> {
    use AgentType::{Cyclist, Other, Pedestrian, Vehicle};
    let word = word.trim().to_ascii_lowercase().replace([' ', '-'], "_");
    Some(match word.as_str() {
        "vehicle" | "motor_vehicle" => (Vehicle, Subtype::Unknown),
        "car" | "passenger_car" | "passenger" => (Vehicle, Subtype::Car),
        "truck" | "truck_bus" | "lorry" => (Vehicle, Subtype::Truck),
        "bus" => (Vehicle, Subtype::Bus),
        "van" => (Vehicle, Subtype::Van),
        "motorcycle" | "motorcyclist" | "motorbike" => (Vehicle, Subtype::Motorcycle),
        "trailer" => (Vehicle, Subtype::Trailer),
        "emergency" => (Vehicle, Subtype::Emergency),
        "pedestrian" | "person" | "walker" => (Pedestrian, Subtype::Unknown),
        "adult" => (Pedestrian, Subtype::Adult),
        "child" => (Pedestrian, Subtype::Child),
        "wheelchair" => (Pedestrian, Subtype::Wheelchair),
        "cyclist" | "pedestrian/bicycle" => (Cyclist, Subtype::Unknown),
        "bicycle" | "bike" | "riding_bicycle" => (Cyclist, Subtype::Bicycle),
        "scooter" => (Cyclist, Subtype::Scooter),
        "other" | "static" | "background" | "construction" | "unknown" | "riderless_bicycle" => {
            (Other, Subtype::Unknown)
        }
        _ => return None,
    })
}
