//! Traffic signals of a scenario: controllers whose phases repeat in a cycle.

use super::parameters::{attribute, number};
use super::unread::Unread;
use crate::limits::MAX_SIGNALS;
use crate::opendrive::places::RoadLight;
use crate::problem::ReadError;
use crate::recording::RecordedLight;
use crate::tree::XmlNode;
use scene::{STEP_S, SignalState};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Greatest time over which signals are computed, seconds.
const LONGEST_S: f64 = 3600.0;
/// Most references that are followed from one controller.
const MOST_REFERENCES: usize = 100;
/// Most state changes of all signals.
const MAX_CHANGES: usize = 1_000_000;

/// State of each signal in a phase, by the id of the signal.
#[derive(Debug)]
struct LightPhase {
    /// End of the phase after the beginning of the cycle, seconds.
    end_s: f64,
    shown: BTreeMap<String, SignalState>,
}

/// A `<TrafficSignalController>`.
#[derive(Debug)]
struct LightController {
    name: String,
    /// Delay of the cycle relative to that of the referenced controller, seconds.
    delay_s: f64,
    reference: String,
    phases: Vec<LightPhase>,
}

/// Signal controllers of a scenario.
#[derive(Debug, Default)]
pub(super) struct LightControllers {
    list: Vec<LightController>,
}

impl LightControllers {
    /// Adds the controllers of `<TrafficSignals>`.
    ///
    /// # Errors
    /// `invalid-field` for a value that is not a number.
    pub fn read(&mut self, signals: &XmlNode) -> Result<(), ReadError> {
        for node in signals.all("TrafficSignalController") {
            let mut phases = Vec::new();
            let mut end_s = 0.0;
            for phase in node.all("Phase") {
                let for_ever = attribute(phase, "duration").trim().eq_ignore_ascii_case("inf");
                let seconds = if for_ever { None } else { number(phase, "duration")? };
                end_s += if for_ever { f64::INFINITY } else { seconds.unwrap_or(0.0).max(0.0) };
                let mut shown = BTreeMap::new();
                for state in phase.all("TrafficSignalState") {
                    let found = state_of(attribute(state, "state"))
                        .or_else(|| state_of(attribute(phase, "name")))
                        .unwrap_or_default();
                    shown.insert(attribute(state, "trafficSignalId").to_owned(), found);
                }
                phases.push(LightPhase { end_s, shown });
            }
            self.list.push(LightController {
                name: attribute(node, "name").to_owned(),
                delay_s: number(node, "delay")?.unwrap_or(0.0),
                reference: attribute(node, "reference").to_owned(),
                phases,
            });
        }
        Ok(())
    }

    /// Signals of lanes over a time from zero, seconds, and the number of those beyond the limit of a scene.
    /// Controllers without a signal on the roads are listed by their place.
    pub fn lights(
        &self,
        heads: &[RoadLight],
        span_s: f64,
        place: &str,
        unread: &mut Unread,
    ) -> (Vec<RecordedLight>, usize) {
        let on_roads: HashSet<&str> = heads.iter().map(|head| head.id.as_str()).collect();
        let mut rules: HashMap<&str, &LightController> = HashMap::new();
        for controller in &self.list {
            let ids = controller.phases.iter().flat_map(|phase| phase.shown.keys().map(String::as_str));
            let mut any = false;
            for id in ids.filter(|id| on_roads.contains(id)) {
                rules.entry(id).or_insert(controller);
                any = true;
            }
            if !any {
                unread.push(&format!("{place}/TrafficSignalController[{}]", controller.name));
            }
        }
        // A lane obeys the first signal with a program.
        let mut lanes = HashSet::new();
        let ruled = heads.iter().filter_map(|head| Some((head, *rules.get(head.id.as_str())?)));
        let ruled: Vec<_> = ruled.filter(|(head, _)| lanes.insert(head.lane.as_str())).collect();
        let kept = ruled.len().min(MAX_SIGNALS);
        let most = MAX_CHANGES / kept.max(1);
        let by_name: HashMap<&str, &LightController> =
            self.list.iter().rev().map(|controller| (controller.name.as_str(), controller)).collect();
        let light = |(head, controller): &(&RoadLight, &LightController)| RecordedLight {
            lane: head.lane.clone(),
            stop: Some(head.stop),
            states: controller.states(&head.id, controller.begins_s(&by_name), span_s, most),
        };
        (ruled.iter().take(kept).map(light).collect(), ruled.len() - kept)
    }
}

impl LightController {
    /// Start of its cycle, seconds: the sum of the delays along the references, which may be cyclic.
    fn begins_s(&self, by_name: &HashMap<&str, &Self>) -> f64 {
        let (mut begins_s, mut at) = (0.0, self);
        for _ in 0..MOST_REFERENCES {
            if at.reference.is_empty() {
                break;
            }
            begins_s += at.delay_s;
            let Some(next) = by_name.get(at.reference.as_str()) else { break };
            at = next;
        }
        begins_s
    }

    /// Changes of a signal's state over a time from zero.
    fn states(&self, id: &str, begins_s: f64, span_s: f64, most: usize) -> Vec<(f64, SignalState)> {
        let cycle_s = self.phases.last().map_or(0.0, |phase| phase.end_s);
        let mut states: Vec<(f64, SignalState)> = Vec::new();
        for step in 0..=(span_s.min(LONGEST_S) / STEP_S) as usize {
            let time_s = step as f64 * STEP_S;
            // In the middle of a step, so that rounding of sums has no effect.
            let since_s = time_s + 0.5 * STEP_S - begins_s;
            let in_cycle_s = if cycle_s > 0.0 { since_s.rem_euclid(cycle_s) } else { 0.0 };
            let index = self.phases.partition_point(|phase| phase.end_s <= in_cycle_s);
            let phase = self.phases.get(index).or(self.phases.last());
            let state = phase.and_then(|phase| phase.shown.get(id).copied()).unwrap_or_default();
            if states.last().is_none_or(|(_, last)| *last != state) && states.len() < most {
                states.push((time_s, state));
            }
        }
        states
    }
}

/// A state from the words of its lamps from top to bottom, such as `off;off;on`, or from one word.
fn state_of(words: &str) -> Option<SignalState> {
    let words = words.trim().to_ascii_lowercase();
    let lamps: Vec<&str> = words.split(';').map(str::trim).collect();
    let is = |lamp: usize, word: &str| lamps.get(lamp).is_some_and(|lamp| lamp.starts_with(word));
    let lit = |lamp: usize| is(lamp, "on") || is(lamp, "blink") || is(lamp, "flash");
    if lamps.len() > 1 {
        // A signal with two lamps has no amber.
        let green = lamps.len().min(3) - 1;
        let amber = |lit: bool| lit && green > 1;
        return Some(match () {
            () if lit(green) => SignalState::Go,
            () if amber(lit(1)) && !is(1, "on") => SignalState::FlashingCaution,
            () if amber(lit(1)) => SignalState::Caution,
            () if lit(0) && !is(0, "on") => SignalState::FlashingStop,
            () if lit(0) => SignalState::Stop,
            () => SignalState::Unknown,
        });
    }
    let flashes = ["flash", "blink"].iter().any(|word| words.contains(word));
    let has = |list: &[&str]| list.iter().any(|word| words.contains(word));
    Some(match () {
        () if has(&["amber", "yellow", "attention", "caution"]) && flashes => SignalState::FlashingCaution,
        () if has(&["amber", "yellow", "attention", "caution"]) => SignalState::Caution,
        () if has(&["red", "stop"]) && flashes => SignalState::FlashingStop,
        () if has(&["red", "stop"]) => SignalState::Stop,
        () if has(&["green", "go"]) => SignalState::Go,
        () if words == "off" => SignalState::Unknown,
        () => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use SignalState::{Caution, FlashingCaution, FlashingStop, Go, Stop, Unknown};

    #[test]
    fn words_of_lamps_and_colours_are_read() {
        let words = [
            ("on;off;off", Some(Stop)),
            ("on; on; off", Some(Caution)),
            ("off;blink;off", Some(FlashingCaution)),
            ("blink;off;off", Some(FlashingStop)),
            ("off;off;on", Some(Go)),
            ("off;off;off", Some(Unknown)),
            ("on;off", Some(Stop)),
            ("off;on", Some(Go)),
            ("Red", Some(Stop)),
            ("red yellow", Some(Caution)),
            ("flashing attention", Some(FlashingCaution)),
            ("green", Some(Go)),
            ("", None),
            ("phase 1", None),
        ];
        assert_eq!(words.map(|(word, _)| state_of(word)), words.map(|(_, state)| state));
    }
}
