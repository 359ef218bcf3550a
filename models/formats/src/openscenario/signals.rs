//! Signal states, as programs that run once.

use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::opendrive::export::light_id;
use scene::{STEP_S, Scene, SignalState};
use std::collections::BTreeSet;

/// The name of a state's phase, and the states of the lamps: red, yellow and green.
fn words(state: SignalState) -> (&'static str, &'static str) {
    match state {
        SignalState::Stop | SignalState::ArrowStop => ("stop", "on;off;off"),
        SignalState::Caution | SignalState::ArrowCaution => ("attention", "off;on;off"),
        SignalState::Go | SignalState::ArrowGo => ("go", "off;off;on"),
        SignalState::FlashingStop => ("flashing stop", "blink;off;off"),
        SignalState::FlashingCaution => ("flashing attention", "off;blink;off"),
        SignalState::Unknown => ("off", "off;off;off"),
    }
}

/// Writes a controller for each signal of a lane; arrows become full signals.
pub(super) fn write(scene: &Scene, out: &mut Markup, losses: &mut BTreeSet<Loss>) {
    let known = |id: &str| scene.map.lanes.iter().any(|lane| lane.id == id);
    if scene.signals.iter().any(|signal| !known(&signal.lane)) {
        losses.insert(Loss::new(code::NO_SIGNALS, "lights of crosswalks"));
    }
    let arrow = |state: &SignalState| {
        matches!(state, SignalState::ArrowStop | SignalState::ArrowCaution | SignalState::ArrowGo)
    };
    if scene.signals.iter().any(|signal| signal.runs.iter().any(|(_, state)| arrow(state))) {
        losses.insert(Loss::new(code::NO_SIGNAL_STATES, "arrows are plain lights"));
    }
    out.open("TrafficSignals", &[]);
    for (i, signal) in scene.signals.iter().enumerate().filter(|(_, signal)| known(&signal.lane)) {
        let id = light_id(i);
        out.open("TrafficSignalController", &[("name", &format!("light {id}"))]);
        let mut from = 0;
        let ends = signal.runs.iter().skip(1).map(|(first, _)| *first).chain([scene.time.steps.max(1)]);
        let states: Vec<(usize, SignalState)> =
            ends.zip(&signal.runs).map(|(end, (_, state))| (end, *state)).collect();
        for (end, state) in states.into_iter().filter(|(end, _)| *end > 0) {
            if end <= from {
                continue;
            }
            let (phase, lamps) = words(state);
            let seconds = (end - from) as f64 * STEP_S;
            out.open("Phase", &[("name", phase), ("duration", &decimal(seconds))]);
            out.empty("TrafficSignalState", &[("trafficSignalId", &id), ("state", lamps)]);
            out.close();
            from = end;
        }
        out.close();
    }
    out.close();
}
