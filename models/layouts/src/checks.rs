//! Checks of every map: each failure has a position and a reason. A failed check blocks nothing.

use crate::curve::{curvature, turn};
use crate::draft::{MapDraft, Vehicle, place};
use crate::lights::{gives_way, meet};
use crate::messages;
use scene::limits::Limits;
use scene::map::LaneType;
use scene::message::{Message, Word};
use scene::{AgentType, HORIZON_STEPS, SignalState, Subtype};
use schemars::JsonSchema;
use serde::Serialize;

/// Least width of a lane for motor vehicles and of a cycle lane, metres.
const LEAST_M: f64 = 2.5;
const LEAST_CYCLE_M: f64 = 1.5;
/// Most failures of one kind that are listed.
const MOST: usize = 8;

/// Subject of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CheckKind {
    /// Every lane has a successor or leaves the map, and can be reached.
    LanesLead,
    /// A bus of 12 m (in a car park: a car) can turn.
    Turns,
    /// No lane is too narrow.
    Widths,
    /// No two movements with simultaneous green conflict.
    SignalsApart,
}

/// A check that passed, or one failure of a check.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Check {
    /// Subject of the check.
    pub kind: CheckKind,
    /// Whether it passed.
    pub passed: bool,
    /// The finding in English.
    pub text: String,
    /// The finding as data.
    pub message: Message,
    /// Place of the failure, metres.
    pub at_m: Option<[f64; 2]>,
    /// Lanes concerned.
    pub lanes: Vec<String>,
}

impl Check {
    fn passed(kind: CheckKind, message: Message) -> Self {
        Self { kind, passed: true, text: message.to_string(), message, at_m: None, lanes: Vec::new() }
    }

    pub(crate) fn mirrored(mut self) -> Self {
        if let Some(at) = &mut self.at_m {
            at[1] = -at[1];
        }
        self
    }
}

/// All checks of a drawing.
pub fn all(draft: &MapDraft) -> Vec<Check> {
    let mut checks = Vec::new();
    let mut add = |passed: Check, failed: Vec<Check>| {
        if failed.is_empty() {
            checks.push(passed);
        } else {
            checks.extend(failed.into_iter().take(MOST));
        }
    };
    add(Check::passed(CheckKind::LanesLead, messages::lanes_lead()), ends(draft));
    let (vehicle, _) = vehicle(draft.turns);
    add(Check::passed(CheckKind::Turns, messages::vehicle_turns(vehicle)), bends(draft));
    add(Check::passed(CheckKind::Widths, messages::lanes_wide()), widths(draft));
    if !draft.signals.is_empty() {
        add(Check::passed(CheckKind::SignalsApart, messages::greens_apart()), greens(draft));
    }
    checks
}

fn fault(draft: &MapDraft, kind: CheckKind, message: Message, lane: usize, share: f64) -> Check {
    let points = draft.points(lane);
    let at = points[((points.len() - 1) as f64 * share).round() as usize];
    let lanes = vec![draft.map.lanes[lane].id.clone()];
    Check { kind, passed: false, text: message.to_string(), message, at_m: Some(place(at)), lanes }
}

/// Lanes for vehicles and cycles.
fn travelled(draft: &MapDraft) -> impl Iterator<Item = usize> + '_ {
    let used = |kind: LaneType| kind.carries_vehicles() || kind.carries_cyclists();
    (0..draft.map.lanes.len()).filter(move |i| used(draft.map.lanes[*i].lane_type))
}

fn ends(draft: &MapDraft) -> Vec<Check> {
    let carries = |id: &String, vehicles: bool| {
        let lane = draft.map.lanes.iter().find(|lane| lane.id == *id);
        lane.is_some_and(|lane| !vehicles || lane.lane_type.carries_vehicles())
    };
    let lost = |i: &usize| {
        let lane = &draft.map.lanes[*i];
        let vehicles = lane.lane_type.carries_vehicles();
        !draft.about[*i].open[1] && !lane.successors.iter().any(|id| carries(id, vehicles))
    };
    // A lane for vehicles begins at the edge of the map, or another lane leads to it.
    let unreached = |i: &usize| {
        let lane = &draft.map.lanes[*i];
        let vehicles = lane.lane_type.carries_vehicles();
        vehicles && !draft.about[*i].open[0] && !lane.predecessors.iter().any(|id| carries(id, true))
    };
    let id = |i: usize| draft.map.lanes[i].id.as_str();
    let unled = |i| fault(draft, CheckKind::LanesLead, messages::lane_leads_nowhere(id(i)), i, 1.0);
    let unfed = |i| fault(draft, CheckKind::LanesLead, messages::lane_unreached(id(i)), i, 0.0);
    travelled(draft).filter(lost).map(unled).chain(travelled(draft).filter(unreached).map(unfed)).collect()
}

/// The vehicle that must be able to turn, and its limits.
fn vehicle(vehicle: Vehicle) -> (Word, Limits) {
    match vehicle {
        Vehicle::Bus => (messages::BUS, Limits::of(AgentType::Vehicle, Subtype::Bus, 12.0)),
        Vehicle::Car => (messages::CAR, Limits::of(AgentType::Vehicle, Subtype::Car, 5.0)),
    }
}

fn bends(draft: &MapDraft) -> Vec<Check> {
    let (vehicle, limits) = vehicle(draft.turns);
    let most = limits.curvature_per_m;
    let mut failed: Vec<(f64, Check)> = Vec::new();
    for i in travelled(draft).filter(|i| draft.map.lanes[*i].lane_type.carries_vehicles()) {
        let bend = curvature(draft.points(i));
        if bend <= most || turn(draft.points(i)).abs() < 0.2 {
            continue;
        }
        let name = |arm: usize| draft.arms.get(arm).map_or("", |arm| arm.name.as_str());
        let movement = draft.movements.iter().find(|movement| movement.lane == i);
        let (radius_m, needed_m) = (1.0 / bend, 1.0 / most);
        let message = match movement {
            Some(m) => messages::movement_tight(name(m.from), name(m.to), radius_m, vehicle, needed_m),
            None => messages::lane_tight(&draft.map.lanes[i].id, radius_m, vehicle, needed_m),
        };
        if failed.iter().all(|(_, other)| other.text != message.english) {
            failed.push((bend, fault(draft, CheckKind::Turns, message, i, 0.5)));
        }
    }
    failed.sort_by(|a, b| b.0.total_cmp(&a.0));
    failed.into_iter().map(|(_, check)| check).collect()
}

fn widths(draft: &MapDraft) -> Vec<Check> {
    let narrow = |i: &usize| {
        let lane = &draft.map.lanes[*i];
        let least = if lane.lane_type.carries_vehicles() { LEAST_M } else { LEAST_CYCLE_M };
        !lane.interpolating && lane.width_or_assumed_m() < least - 1e-9
    };
    travelled(draft)
        .filter(narrow)
        .map(|i| {
            let lane = &draft.map.lanes[i];
            let message = messages::lane_narrow(&lane.id, lane.width_or_assumed_m());
            fault(draft, CheckKind::Widths, message, i, 0.5)
        })
        .collect()
}

fn greens(draft: &MapDraft) -> Vec<Check> {
    let state = |lane: usize, step: usize| {
        let id = &draft.map.lanes[lane].id;
        draft.signals.iter().find(|signal| signal.lane == *id).map_or(SignalState::Unknown, |s| s.at(step))
    };
    let mut failed = Vec::new();
    for (k, a) in draft.movements.iter().enumerate() {
        for b in &draft.movements[..k] {
            if gives_way(a, b) {
                continue;
            }
            let both = |step: usize| [a, b].iter().all(|m| state(m.lane, step) == SignalState::Go);
            if (0..=HORIZON_STEPS).step_by(5).any(both) && meet(draft, a, b) {
                let name = |arm: usize| draft.arms.get(arm).map_or("", |arm| arm.name.as_str());
                let message = messages::greens_conflict(name(a.from), name(b.from));
                failed.push(fault(draft, CheckKind::SignalsApart, message, a.lane, 0.5));
            }
        }
    }
    failed
}
