//! Features of futures that a person can name.

use super::Places;
use crate::judge::{FaultKind, Manoeuvre, RelationKind};
use crate::{AgentId, Future, STANDING_MPS, STEP_S, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Largest time gap that counts, seconds; a larger one is free room.
const ROOM_S: f64 = 5.0;
/// Steps between the speeds of which an acceleration is the difference. Shorter changes are jitter.
const ACCEL_STEPS: usize = 5;
/// Steps between places.
const PLACE_STEPS: usize = 5;
/// Seconds between places.
pub(super) const PLACE_S: f64 = PLACE_STEPS as f64 * STEP_S;

/// A property of a motion that a user can name and want changed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "trait", rename_all = "snake_case", deny_unknown_fields)]
pub enum Trait {
    /// Mean speed.
    Pace,
    /// Least time gap to a road user that crosses its path.
    Gap,
    /// Hardest braking, accelerating or turning.
    Harshness,
    /// Time at standstill.
    Standing,
    /// Distance from the recording.
    FromLog,
    /// Going first where their paths cross.
    First {
        /// The one that goes first.
        who: AgentId,
        /// The other.
        with: AgentId,
    },
    /// Its manoeuvre.
    Does {
        /// The road user.
        who: AgentId,
        /// The manoeuvre.
        manoeuvre: Manoeuvre,
    },
}

/// The traits of a motion of one road user, or of several together.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Features {
    /// Mean speed, m/s; for several road users the mean.
    #[schemars(range(min = 0.0, max = 150.0))]
    pub pace_mps: f64,
    /// Least time between it and another where their paths cross, seconds, at most 5; for several road users
    /// the least.
    #[schemars(range(min = 0.0, max = 5.0))]
    pub gap_s: f64,
    /// Greatest change of velocity over half a second, m/s2; for several road users the greatest.
    #[schemars(range(min = 0.0, max = 1000.0))]
    pub harshness_mps2: f64,
    /// Time at standstill, seconds; for several road users the mean.
    #[schemars(range(min = 0.0, max = 60.0))]
    pub standing_s: f64,
    /// Mean distance from the recording, metres; for several road users the mean. Absent without a recording.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 100000.0))]
    pub from_log_m: Option<f64>,
    /// By road user and other: whether it goes first where their paths cross.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub first: BTreeMap<AgentId, BTreeMap<AgentId, bool>>,
    /// Manoeuvre by road user.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub manoeuvres: BTreeMap<AgentId, Manoeuvre>,
}

impl Features {
    /// Features of motions that are made together.
    pub fn of<'a>(scene: &Scene, motions: impl Iterator<Item = (&'a str, &'a Future)>) -> Self {
        let mut features = Self { gap_s: ROOM_S, ..Self::default() };
        let (mut count, mut logged) = (0.0, Vec::new());
        for (id, future) in motions {
            count += 1.0;
            features.pace_mps += pace_mps(future);
            features.harshness_mps2 = features.harshness_mps2.max(harshness_mps2(future));
            let stands = future.states.iter().filter(|s| s.speed_mps() < STANDING_MPS).count();
            features.standing_s += stands as f64 * STEP_S;
            logged.extend(from_log_m(scene, id, future));
            for relation in &future.about.relations {
                if let Some(gap_s) = relation.gap_s {
                    features.gap_s = features.gap_s.min(gap_s);
                }
                let first = match relation.kind {
                    RelationKind::Before => true,
                    RelationKind::After | RelationKind::GivesWayTo => false,
                    RelationKind::Follows => continue,
                };
                features
                    .first
                    .entry(id.to_owned())
                    .or_default()
                    .entry(relation.with.clone())
                    .or_insert(first);
            }
            features.manoeuvres.extend(future.about.manoeuvre.map(|does| (id.to_owned(), does)));
        }
        if count > 0.0 {
            features.pace_mps /= count;
            features.standing_s /= count;
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        features.from_log_m = (!logged.is_empty()).then(|| mean(&logged));
        features
    }

    /// The value of a trait. An order or a manoeuvre is 1 for yes, -1 for no, and 0 if it does not occur.
    pub fn value(&self, of: &Trait) -> Option<f64> {
        let signed = |yes: bool| if yes { 1.0 } else { -1.0 };
        match of {
            Trait::Pace => Some(self.pace_mps),
            Trait::Gap => Some(self.gap_s),
            Trait::Harshness => Some(self.harshness_mps2),
            Trait::Standing => Some(self.standing_s),
            Trait::FromLog => self.from_log_m,
            Trait::First { who, with } => {
                Some(self.first.get(who).and_then(|f| f.get(with)).map_or(0.0, |f| signed(*f)))
            }
            Trait::Does { who, manoeuvre } => self.manoeuvres.get(who).map(|does| signed(does == manoeuvre)),
        }
    }

    /// Quantities by the names of their fields, each with its upper bound.
    pub fn quantities(&self) -> impl Iterator<Item = (&'static str, f64, f64)> {
        let known = [
            ("pace_mps", self.pace_mps, 150.0),
            ("gap_s", self.gap_s, ROOM_S),
            ("harshness_mps2", self.harshness_mps2, 1_000.0),
            ("standing_s", self.standing_s, 60.0),
        ];
        known.into_iter().chain(self.from_log_m.map(|m| ("from_log_m", m, 1e5)))
    }

    /// The traits for which it has a value.
    pub fn traits(&self) -> Vec<Trait> {
        let mut traits = vec![Trait::Pace, Trait::Gap, Trait::Harshness, Trait::Standing];
        traits.extend(self.from_log_m.map(|_| Trait::FromLog));
        for (who, others) in &self.first {
            traits.extend(others.keys().map(|with| Trait::First { who: who.clone(), with: with.clone() }));
        }
        let does = |(who, does): (&AgentId, &Manoeuvre)| Trait::Does { who: who.clone(), manoeuvre: *does };
        traits.extend(self.manoeuvres.iter().map(does));
        traits
    }
}

impl Trait {
    /// Whether it is a quantity, not a yes or no.
    pub(super) fn is_quantity(&self) -> bool {
        !matches!(self, Self::First { .. } | Self::Does { .. })
    }
}

/// Whether the future breaks a rule or misses its goal, so that it is no useful card.
pub(super) fn is_broken(future: &Future) -> bool {
    use FaultKind::{
        Collision, GoalMissed, OffMap, OffRoad, OnCarriageway, OverMedian, RedLight, ViaMissed, WrongWay,
    };
    let missed = |kind| matches!(kind, ViaMissed | GoalMissed);
    let ground = |kind| matches!(kind, WrongWay | OverMedian | OffRoad | OffMap | OnCarriageway);
    let broken = |kind| missed(kind) || ground(kind) || matches!(kind, Collision | RedLight);
    future.about.faults.iter().any(|fault| broken(fault.kind))
}

/// Places of motions at every half second.
pub(super) fn places<'a>(motions: impl Iterator<Item = (&'a str, &'a Future)>) -> Places {
    let at =
        |future: &Future| future.states.iter().step_by(PLACE_STEPS).map(crate::State::position).collect();
    motions.map(|(id, future)| (id.to_owned(), at(future))).collect()
}

fn pace_mps(future: &Future) -> f64 {
    let speeds = future.states.iter().map(crate::State::speed_mps);
    speeds.sum::<f64>() / future.states.len().max(1) as f64
}

fn harshness_mps2(future: &Future) -> f64 {
    let pairs = future.states.iter().zip(future.states.iter().skip(ACCEL_STEPS));
    let changes = pairs.map(|(a, b)| (b.velocity() - a.velocity()).norm() / (STEP_S * ACCEL_STEPS as f64));
    changes.fold(0.0, f64::max)
}

fn from_log_m(scene: &Scene, id: &str, future: &Future) -> Option<f64> {
    let track = &scene.agent(id)?.track;
    let states = future.states.iter().enumerate();
    let apart = states.filter_map(|(i, state)| {
        let logged = track.at(future.first_step + i)?;
        Some((state.position() - logged.position()).norm())
    });
    let (sum_m, count) = apart.fold((0.0, 0), |(sum, count), apart_m| (sum + apart_m, count + 1));
    (count > 0).then(|| sum_m / f64::from(count))
}
