//! Events in recorded scenes, as tags with time, place, road users and a figure. Collisions, near misses,
//! braking, red-light violations and similar events come from the score; the others are defined here.

mod hidden;
mod lanes;
mod seen;
pub mod table;
#[cfg(test)]
mod tests;

use crate::case::facts::recorded_input;
use lanes::LaneChange;
use scene::routes::LaneGraph;
use scene::score::meeting::{MeetingPair, MeetingSearch, PairRelation};
use scene::score::report::{EncounterKind, Stretch};
use scene::score::{Actor, Drivable, ScoreInput, score};
use scene::{STEP_S, Scene, State};
use std::collections::BTreeSet;

/// Post-encroachment time below which a crossing is close, seconds.
const CLOSE_S: f64 = 1.5;
/// Driving against the traffic for less than this is a turn across it, metres.
const WRONG_WAY_M: f64 = 4.0;

/// Tags of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MinedTag {
    /// Two boxes overlap, by the rules of the score.
    Collision,
    /// A near miss of the score that braking could still avoid.
    NearMiss,
    /// Two road users cross with a post-encroachment time below 1.5 s.
    CloseCrossing,
    /// A vehicle changes lanes closely ahead of another.
    CutIn,
    /// A vehicle changes lanes.
    LaneChange,
    /// A vehicle or cyclist makes a U-turn.
    UTurn,
    /// A pedestrian crosses a vehicle's path from behind another vehicle.
    HiddenWalker,
    /// Harsh braking of the score, confirmed by the positions.
    HardBraking,
    /// Harsh steering of the score, for a moving vehicle.
    HardSteering,
    /// A stop line is crossed at red.
    RedLight,
    /// Driving against the traffic, by the rules of the score.
    WrongWay,
    /// A pedestrian on the carriageway, by the rules of the score.
    OnCarriageway,
    /// A pedestrian runs.
    Running,
    /// A vehicle is too fast, by the rules of the score.
    Speeding,
}

impl MinedTag {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Collision,
        Self::NearMiss,
        Self::CloseCrossing,
        Self::CutIn,
        Self::LaneChange,
        Self::UTurn,
        Self::HiddenWalker,
        Self::HardBraking,
        Self::HardSteering,
        Self::RedLight,
        Self::WrongWay,
        Self::OnCarriageway,
        Self::Running,
        Self::Speeding,
    ];

    /// Name of the tag, and of its figure.
    const fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Collision => ("collision", "depth_m"),
            Self::NearMiss => ("near-miss", "ttc_s"),
            Self::CloseCrossing => ("close-crossing", "pet_s"),
            Self::CutIn => ("cut-in", "headway_s"),
            Self::LaneChange => ("lane-change", "speed_mps"),
            Self::UTurn => ("u-turn", "turn_rad"),
            Self::HiddenWalker => ("hidden-walker", "hidden_s"),
            Self::HardBraking => ("hard-braking", "braking_mps2"),
            Self::HardSteering => ("hard-steering", "lateral_mps2"),
            Self::RedLight => ("red-light", "speed_mps"),
            Self::WrongWay => ("wrong-way", "driven_m"),
            Self::OnCarriageway => ("on-carriageway", "walked_m"),
            Self::Running => ("running", "speed_mps"),
            Self::Speeding => ("speeding", "excess_mps"),
        }
    }

    /// Name of the tag.
    pub const fn name(self) -> &'static str {
        self.names().0
    }

    /// Name of its figure, with the unit.
    pub const fn figure(self) -> &'static str {
        self.names().1
    }
}

/// An event.
#[derive(Clone, Debug, PartialEq)]
pub struct MinedEvent {
    /// Tag.
    pub tag: MinedTag,
    /// Road user that acts.
    pub actor: String,
    /// The other road user, if there is one.
    pub other: Option<String>,
    /// Scene time, seconds.
    pub time_s: f64,
    /// Position, metres.
    pub x_m: f64,
    /// Position, metres.
    pub y_m: f64,
    /// The figure of the tag.
    pub value: Option<f64>,
}

/// Events of a scene as it was recorded, by time. `graph` and `drivable` belong to its map.
pub fn mine(scene: &Scene, graph: &LaneGraph, drivable: &Drivable) -> Vec<MinedEvent> {
    let input = recorded_input(scene, drivable);
    let mut events = Vec::new();
    of_score(&input, &mut events);
    let search = MeetingSearch::new(&input);
    let pairs: Vec<Option<MeetingPair>> = (0..input.actors.len()).map(|of| search.hardest(of)).collect();
    of_crossings(&input, &pairs, &mut events);
    for actor in &input.actors {
        for change in lanes::changes(&input, actor, graph) {
            of_change(&input, actor, &change, &mut events);
        }
        events.extend(lanes::turns_round(&input, actor));
    }
    events.sort_by(|a, b| {
        let order = a.time_s.total_cmp(&b.time_s).then(a.tag.cmp(&b.tag));
        order.then_with(|| (&a.actor, &a.other).cmp(&(&b.actor, &b.other)))
    });
    events
}

/// The time of a step, seconds.
fn time_s(step: usize) -> f64 {
    step as f64 / (1.0 / STEP_S).round()
}

/// Events that the score lists.
fn of_score(input: &ScoreInput<'_>, events: &mut Vec<MinedEvent>) {
    let found = score(input).scene;
    let actor = |id: &str| input.actors.iter().find(|actor| actor.id == id);
    for encounter in &found.encounters {
        let measures = &encounter.measures;
        let both = actor(&encounter.a).zip(actor(&encounter.b));
        if !both.is_some_and(|(a, b)| seen::close_in(a, b, encounter.time_s)) {
            continue;
        }
        let (tag, value) = match encounter.kind {
            EncounterKind::Collision => (MinedTag::Collision, measures.gap_m.map(|gap_m| -gap_m)),
            EncounterKind::NearMiss if seen::is_avoidable(measures) => (MinedTag::NearMiss, measures.ttc_s),
            EncounterKind::NearMiss | EncounterKind::Overlap => continue,
        };
        events.push(MinedEvent {
            tag,
            actor: encounter.a.clone(),
            other: Some(encounter.b.clone()),
            time_s: encounter.time_s,
            x_m: encounter.x_m,
            y_m: encounter.y_m,
            value,
        });
    }
    let counts = |tag: MinedTag, stretch: &Stretch| match tag {
        MinedTag::HardBraking => actor(&stretch.agent).is_some_and(|of| seen::brakes(of, stretch)),
        MinedTag::HardSteering => actor(&stretch.agent).is_some_and(|of| seen::steers(of, stretch)),
        MinedTag::Running => actor(&stretch.agent).is_some_and(|of| seen::runs(of, stretch)),
        MinedTag::WrongWay => stretch.worst.is_some_and(|driven_m| driven_m >= WRONG_WAY_M),
        _ => true,
    };
    let lists = [
        (MinedTag::HardBraking, &found.harsh_braking),
        (MinedTag::HardSteering, &found.harsh_steering),
        (MinedTag::WrongWay, &found.wrong_way),
        (MinedTag::OnCarriageway, &found.on_carriageway),
        (MinedTag::Running, &found.running),
        (MinedTag::Speeding, &found.speeding),
    ];
    for (tag, stretches) in lists {
        let seen = seen::joined(stretches.iter().filter(|stretch| counts(tag, stretch)));
        events.extend(seen.into_iter().map(|stretch| MinedEvent {
            tag,
            actor: stretch.agent,
            other: None,
            time_s: stretch.time_s,
            x_m: stretch.x_m,
            y_m: stretch.y_m,
            value: stretch.worst,
        }));
    }
    for red in found.red_lights.iter().filter(|red| seen::stays_red(input, red)) {
        let step = (red.time_s / STEP_S).round() as usize;
        let place = actor(&red.agent).and_then(|actor| actor.state(step)).map(State::position);
        let Some(place) = place else { continue };
        events.push(MinedEvent {
            tag: MinedTag::RedLight,
            actor: red.agent.clone(),
            other: None,
            time_s: red.time_s,
            x_m: place.x,
            y_m: place.y,
            value: Some(red.speed_mps),
        });
    }
}

/// Crossings of the pairs, each pair once.
fn of_crossings(input: &ScoreInput<'_>, pairs: &[Option<MeetingPair>], events: &mut Vec<MinedEvent>) {
    let mut known = BTreeSet::new();
    for (of, pair) in pairs.iter().enumerate() {
        let Some(pair) = pair.as_ref().filter(|pair| pair.relation == PairRelation::Crossing) else {
            continue;
        };
        let (Some(actor), Some(other)) = (input.actors.get(of), input.actors.get(pair.other)) else {
            continue;
        };
        let Some(pet_s) =
            pair.measures.pet_s.filter(|_| known.insert((of.min(pair.other), of.max(pair.other))))
        else {
            continue;
        };
        let event = |tag, value| MinedEvent {
            tag,
            actor: actor.id.to_owned(),
            other: Some(other.id.to_owned()),
            time_s: time_s(pair.step),
            x_m: pair.place.x,
            y_m: pair.place.y,
            value: Some(value),
        };
        if pet_s < CLOSE_S {
            events.push(event(MinedTag::CloseCrossing, pet_s));
        }
        if let Some(hidden_s) = hidden::hidden_s(input, actor, other, pair) {
            events.push(event(MinedTag::HiddenWalker, hidden_s));
        }
    }
}

/// A lane change, and a cut-in if a follower is close.
fn of_change(input: &ScoreInput<'_>, actor: &Actor<'_>, change: &LaneChange, events: &mut Vec<MinedEvent>) {
    let Some(state) = actor.state(change.step) else { return };
    let event = |tag, other: Option<&str>, value| MinedEvent {
        tag,
        actor: actor.id.to_owned(),
        other: other.map(str::to_owned),
        time_s: time_s(change.step),
        x_m: state.x_m,
        y_m: state.y_m,
        value: Some(value),
    };
    events.push(event(MinedTag::LaneChange, None, state.speed_mps()));
    if let Some((other, headway_s)) = lanes::follower(input, actor, change) {
        events.push(event(MinedTag::CutIn, Some(other.id), headway_s));
    }
}
