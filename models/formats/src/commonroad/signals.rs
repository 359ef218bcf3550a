//! Converts traffic lights with their cycles to signals over the steps of a scene.

use super::document::{CommonRoadDocument, TrafficLight};
use super::map::{Lanes, stop};
use super::words::signal_state;
use crate::limits::MAX_SIGNALS;
use crate::problem::ImportWarning;
use crate::sentences;
use scene::map::LaneMap;
use scene::{STEP_S, Signal, SignalState};
use std::collections::{HashMap, HashSet};

/// A signal for each lane that a traffic light controls, over `steps` steps from step `first` of the file.
pub(super) fn signals(
    document: &CommonRoadDocument,
    (map, lanes): (&LaneMap, &Lanes),
    first: i64,
    steps: usize,
    warnings: &mut Vec<ImportWarning>,
) -> Vec<Signal> {
    let turns: HashMap<i64, &'static str> = document.turns.iter().map(|(turn, id)| (*id, *turn)).collect();
    let mut shown: HashMap<i64, Vec<(usize, SignalState)>> = HashMap::new();
    let mut signals: Vec<Signal> = Vec::new();
    let mut ruled: HashSet<(usize, i64)> = HashSet::new();
    let mut dropped = 0;
    for lanelet in &document.lanelets {
        let Some(&own) = lanes.get(&lanelet.id).and_then(|own| own.first()) else { continue };
        for id in &lanelet.lights {
            let Some(light) = document.lights.get(id).filter(|light| light.active) else { continue };
            let runs = shown.entry(*id).or_insert_with(|| runs(light, document.step_s, first, steps));
            if runs.is_empty() {
                continue;
            }
            // A traffic light for a turn controls the paths through the junction with that turn.
            let next =
                lanelet.successors.iter().filter(|next| turns.get(next).is_some_and(|t| covers(light, t)));
            let next: Vec<usize> = next.filter_map(|next| lanes.get(next)?.first().copied()).collect();
            let rules = if is_for_all(light) || next.is_empty() { vec![own] } else { next };
            for lane in rules {
                if !ruled.insert((lane, *id)) {
                    continue;
                }
                if signals.len() >= MAX_SIGNALS {
                    dropped += 1;
                    continue;
                }
                let begin = map.lanes[lane].points.xy.first().copied();
                let stop = if lane == own { stop(lanelet, &map.lanes[own]) } else { begin };
                signals.push(Signal {
                    lane: map.lanes[lane].id.clone(),
                    stop,
                    stop_z_m: None,
                    runs: runs.clone(),
                });
            }
        }
    }
    if dropped > 0 {
        warnings
            .push(ImportWarning::new("signals-dropped", sentences::signals_over_limit(dropped, MAX_SIGNALS)));
    }
    signals
}

fn is_for_all(light: &TrafficLight) -> bool {
    matches!(light.direction.as_str(), "" | "all")
}

fn covers(light: &TrafficLight, turn: &str) -> bool {
    light.direction.to_ascii_lowercase().contains(turn)
}

/// States of a signal over the steps of a scene. Empty if its cycle has no length.
fn runs(light: &TrafficLight, step_s: f64, first: i64, steps: usize) -> Vec<(usize, SignalState)> {
    let length: u64 = light.cycle.iter().fold(0, |sum, (_, duration)| sum.saturating_add(*duration));
    if length == 0 {
        return Vec::new();
    }
    let mut runs: Vec<(usize, SignalState)> = Vec::new();
    for step in 0..steps {
        let time = first.saturating_add((step as f64 * STEP_S / step_s + 1e-6).floor() as i64);
        let mut left =
            time.saturating_sub(light.offset).rem_euclid(i64::try_from(length).unwrap_or(i64::MAX));
        let now = light.cycle.iter().find(|(_, duration)| {
            left = left.saturating_sub(i64::try_from(*duration).unwrap_or(i64::MAX));
            left < 0
        });
        let state = now.and_then(|(color, _)| signal_state(color)).unwrap_or_default();
        if runs.last().is_none_or(|(_, last)| *last != state) {
            runs.push((step, state));
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_goes_on_over_the_scene() {
        let cycle = [("red", 30), ("redYellow", 5), ("green", 20), ("yellow", 5)];
        let cycle = cycle.map(|(color, steps)| (color.to_owned(), steps)).to_vec();
        let light = TrafficLight { cycle, offset: 10, direction: "all".into(), active: true };
        use SignalState::{Caution, Go, Stop};
        assert_eq!(
            runs(&light, 0.1, 0, 91),
            [(0, Go), (5, Caution), (10, Stop), (45, Go), (65, Caution), (70, Stop)]
        );
        // Steps of 0.2 s last twice as long; a later beginning is later in the cycle.
        assert_eq!(runs(&light, 0.2, 5, 31), [(0, Caution), (10, Stop)]);
        let empty = TrafficLight { cycle: vec![("red".into(), 0)], ..light };
        assert_eq!(runs(&empty, 0.1, 0, 91), []);
    }
}
