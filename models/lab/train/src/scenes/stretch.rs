//! Cuts stretches of a recording into scenes of their own.

use scene::{Conditions, Scene, SignalState, Track};

/// The steps `first ..= first + steps` of a scene, as far as it has them, renumbered from 0. Conditions,
/// generated futures and road users that are never seen in the stretch are dropped.
pub fn stretch(scene: &Scene, first: usize, steps: usize) -> Scene {
    let last = (first + steps).min(scene.time.steps.saturating_sub(1)).max(first);
    let mut out = scene.clone();
    (out.generated, out.meta.timestamps_s) = (None, None);
    (out.time.steps, out.time.now_step) = (last - first + 1, 0);
    out.name = if first == 0 { scene.name.clone() } else { format!("{}+{first}", scene.name) };
    for agent in &mut out.agents {
        let states = (first..=last).map(|step| agent.track.at(step).copied()).collect();
        let heights = agent.track.z_m.as_ref().map(|z_m| {
            let at = |step: usize| z_m.get(step.checked_sub(agent.track.first_step)?).copied();
            (first..=last).map(|step| at(step).unwrap_or(0.0)).collect()
        });
        agent.track = Track { first_step: 0, states, z_m: heights }.into();
        agent.conditions = Conditions::default();
    }
    out.agents.retain(|agent| agent.track.valid_steps().next().is_some());
    for signal in &mut out.signals {
        let at_first = signal.at(first);
        let later = signal.runs.iter().filter(|(step, _)| (first + 1..=last).contains(step));
        let later: Vec<(usize, SignalState)> = later.map(|(step, state)| (step - first, *state)).collect();
        // The state at the first step began earlier; a stretch does not store when.
        signal.runs = std::iter::once((0, at_first)).chain(later).collect();
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{log, scene, shifted};
    use scene::Signal;

    #[test]
    fn a_stretch_begins_anew() {
        let mut whole = scene(vec![log("a", 8.0, 200), shifted(log("b", 5.0, 40), 30.0, 3.5)]);
        whole.time.steps = 200;
        let runs = vec![(0, SignalState::Go), (70, SignalState::Caution), (100, SignalState::Stop)];
        whole.signals.push(Signal { lane: "a".into(), stop: None, stop_z_m: None, runs });
        let cut = stretch(&whole, 60, 60);
        assert_eq!((cut.time.steps, cut.agents.len()), (61, 1));
        let agent = &cut.agents[0];
        assert_eq!(agent.state_at(0), whole.agents[0].state_at(60));
        assert_eq!((agent.state_at(60), agent.state_at(61)), (whole.agents[0].state_at(120), None));
        let expected = vec![(0, SignalState::Go), (10, SignalState::Caution), (40, SignalState::Stop)];
        assert_eq!(cut.signals[0].runs, expected);
        assert!(cut.checked().is_ok());
        // A stretch ends with its recording.
        assert_eq!(stretch(&whole, 180, 60).time.steps, 20);
    }
}
