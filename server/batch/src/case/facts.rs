//! The facts of a result: the two road users, the place, their order, distance and speeds.

use super::layout::road_layout;
use formats::columnar::{Column, ColumnValue, ColumnValues};
use scene::score::meeting::{MeetingPair, MeetingSearch, PairRelation};
use scene::score::{Actor, ScoreInput};
use scene::{AgentType, STEP_S, SignalState, State};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Textual facts; their columns in the tables begin with `case.`.
pub const WORDS: [&str; 7] = ["layout", "actor_type", "other", "other_type", "meeting", "first", "signal"];
/// Numeric facts with their units; their columns in the tables begin with `case.`.
pub const NUMBERS: [&str; 11] = [
    "ttc_s",
    "pet_s",
    "gap_m",
    "drac_mps2",
    "actor_mps",
    "other_mps",
    "time_s",
    "x_m",
    "y_m",
    "driven_s",
    "driven_m",
];
/// Prefix of the columns.
const PREFIX: &str = "case.";
/// Value of a textual fact that does not apply.
pub const NONE: &str = "none";

/// Names of the columns of facts, each with the name of its fact.
pub fn columns() -> &'static [(String, &'static str)] {
    static COLUMNS: OnceLock<Vec<(String, &'static str)>> = OnceLock::new();
    let column = |fact: &&'static str| (format!("{PREFIX}{fact}"), *fact);
    COLUMNS.get_or_init(|| WORDS.iter().chain(&NUMBERS).map(column).collect())
}

/// The facts of one result: one road user and its hardest pair.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CaseFacts {
    /// Textual facts by the names of [`WORDS`].
    pub words: BTreeMap<&'static str, String>,
    /// Numeric facts by the names of [`NUMBERS`]; facts that do not apply are absent.
    pub numbers: BTreeMap<&'static str, f64>,
}

impl CaseFacts {
    /// The facts of a road user, by its index in the input; `None` if it is not present.
    pub fn of(
        input: &ScoreInput<'_>,
        search: &MeetingSearch<'_>,
        of: usize,
    ) -> Option<(Self, Option<MeetingPair>)> {
        let actor = input.actors.get(of)?;
        let last = input.steps.clone().rev().find(|step| actor.state(*step).is_some())?;
        let pair = search.hardest(of);
        let place =
            pair.as_ref().map(|pair| pair.place).or_else(|| actor.state(last).map(State::position))?;
        let mut facts = Self::default();
        let mut word = |name, word: &str| drop(facts.words.insert(name, word.to_owned()));
        word("layout", road_layout(input.map, place));
        word("actor_type", type_word(actor.agent_type));
        word("signal", search.signal(of).map_or(NONE, signal_word));
        let other = pair.as_ref().and_then(|pair| input.actors.get(pair.other));
        word("other_type", other.map_or(NONE, |other| type_word(other.agent_type)));
        word("meeting", pair.as_ref().map_or(NONE, |pair| relation_word(pair.relation)));
        let first = pair.as_ref().and_then(|pair| pair.other_first);
        word("first", first.map_or(NONE, |other| if other { "other" } else { "actor" }));
        if let Some(other) = other {
            word("other", other.id);
        }
        let driven = driven(actor, input);
        let mut numbers = vec![("driven_s", Some(driven.0)), ("driven_m", Some(driven.1))];
        numbers.extend([("x_m", Some(place.x)), ("y_m", Some(place.y))]);
        if let Some((pair, other)) = pair.as_ref().zip(other) {
            let speed = |of: &Actor<'_>| of.state(pair.step).map(State::speed_mps);
            let measures = &pair.measures;
            numbers.extend([
                ("ttc_s", pair.ttc_s),
                ("pet_s", measures.pet_s),
                ("gap_m", measures.gap_m),
                ("drac_mps2", measures.drac_mps2),
                ("actor_mps", speed(actor)),
                ("other_mps", speed(other)),
                ("time_s", Some(pair.step as f64 * STEP_S)),
            ]);
        } else {
            numbers.push(("actor_mps", actor.state(last).map(State::speed_mps)));
        }
        facts.numbers.extend(numbers.into_iter().filter_map(|(name, number)| Some((name, number?))));
        Some((facts, pair))
    }

    /// The columns of these facts, in their order.
    pub(crate) fn table<'a>(all: impl Iterator<Item = &'a Self> + Clone) -> impl Iterator<Item = Column> {
        columns().iter().map(move |(name, fact)| {
            let words = || all.clone().map(|facts| facts.words.get(fact).cloned()).collect();
            let numbers = || all.clone().map(|facts| facts.numbers.get(fact).copied()).collect();
            let is_word = WORDS.contains(fact);
            let values = if is_word { ColumnValues::Text(words()) } else { ColumnValues::Number(numbers()) };
            Column { name, required: false, values }
        })
    }

    /// Stores the value of a column; false if the column is not a fact.
    pub fn read(&mut self, column: &str, value: &ColumnValue<'_>) -> bool {
        let Some(name) = column.strip_prefix(PREFIX) else { return false };
        let fact = |names: &[&'static str]| names.iter().copied().find(|fact| *fact == name);
        match value {
            ColumnValue::Text(text) => {
                self.words.extend(fact(&WORDS).map(|fact| (fact, (*text).to_owned())));
            }
            ColumnValue::Number(number) => self.numbers.extend(fact(&NUMBERS).map(|fact| (fact, *number))),
            ColumnValue::Whole(_) | ColumnValue::Flag(_) | ColumnValue::Nothing => {}
        }
        true
    }

    /// A textual fact; [`NONE`] if it is unknown.
    pub fn word(&self, name: &str) -> &str {
        self.words.get(name).map_or(NONE, String::as_str)
    }
}

/// The facts of a recorded road user.
pub struct RecordedFacts {
    /// Its id.
    pub id: String,
    /// Its facts.
    pub facts: CaseFacts,
}

/// The input to score a scene as it was recorded.
pub(crate) fn recorded_input<'a>(
    scene: &'a scene::Scene,
    drivable: &'a scene::score::Drivable,
) -> ScoreInput<'a> {
    let logs = scene.agents.iter().filter(|agent| agent.kind() != AgentType::Other).map(Actor::of_kept);
    ScoreInput { actors: logs.collect(), ..ScoreInput::of_sample(scene, None, drivable) }
}

/// The facts of a scene as it was recorded: one entry per road user that moves.
pub fn recorded(scene: &scene::Scene, drivable: &scene::score::Drivable) -> Vec<RecordedFacts> {
    let input = recorded_input(scene, drivable);
    let search = MeetingSearch::new(&input);
    let moves =
        |of: &usize| input.actors.get(*of).is_some_and(|a| a.travel_m(input.steps.clone()) >= MOVES_M);
    let all = (0..input.actors.len()).filter(moves);
    let named = |of: usize| {
        let (facts, _) = CaseFacts::of(&input, &search, of)?;
        Some(RecordedFacts { id: input.actors.get(of)?.id.to_owned(), facts })
    };
    all.filter_map(named).collect()
}

/// A recorded road user that travels less than this does not move, metres.
const MOVES_M: f64 = 1.0;

/// Seconds during which a road user is present, and metres that it drives.
fn driven(actor: &Actor<'_>, input: &ScoreInput<'_>) -> (f64, f64) {
    let steps = input.steps.start..input.steps.end.saturating_sub(1);
    let moves = steps.filter_map(|step| Some((actor.state(step)?, actor.state(step + 1)?)));
    moves.fold((0.0, 0.0), |(s, m), (from, to)| (s + STEP_S, m + (to.position() - from.position()).norm()))
}

/// Name of a type in the tables.
pub fn type_word(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "other",
    }
}

fn relation_word(relation: PairRelation) -> &'static str {
    match relation {
        PairRelation::Crossing => "crossing",
        PairRelation::Following => "following",
        PairRelation::Oncoming => "oncoming",
        PairRelation::Beside => "beside",
    }
}

fn signal_word(state: SignalState) -> &'static str {
    match state {
        _ if state.is_stop() => "stop",
        SignalState::Caution | SignalState::ArrowCaution | SignalState::FlashingCaution => "caution",
        SignalState::Go | SignalState::ArrowGo => "go",
        _ => "unknown",
    }
}
