//! Extends the tracks of road users that keep their motion to the end of a call of several windows.

use scene::{Agent, STANDING_MPS, STEP_S, Scene, State, Track};

/// The step from which a kept motion is extrapolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Guessed {
    /// First scene step that neither a future nor the log covers.
    pub(super) step: usize,
    /// The agent continues straight on; otherwise it stands at its last place.
    pub(super) moving: bool,
}

/// A road user's track as others plan against it, up to scene step `last`. It is the pinned or chosen future
/// after `start`, else the log, else straight on from the last known state. Also returns the first
/// extrapolated step, if it comes before `last`. An agent that left before the recording ends remains absent.
pub(super) fn extrapolated(
    scene: &Scene,
    agent: &Agent,
    pinned: Option<&[State]>,
    start: usize,
    last: usize,
) -> (Track, Option<Guessed>) {
    let chosen = scene.generated.as_ref().and_then(|g| g.chosen_future(&agent.id));
    let future = pinned.map(|p| (start + 1, p)).or(chosen.map(|f| (f.first_step, &*f.states)));
    let at_step = |at: usize| match future {
        Some((first, states)) if at > start && at >= first => states.get(at - first).copied(),
        _ => agent.track.at(at).copied(),
    };
    let logged = agent.track.last_valid_step().map_or(0, |l| l + 1);
    let ends = future.map_or(logged, |(first, states)| first + states.len());
    let gone = future.is_none() && logged < scene.time.steps && agent.track.valid_steps().nth(1).is_some();
    let first_step = agent.track.first_step.min(start);
    let mut seen: Option<(usize, State)> = None;
    let mut guessed: Option<Guessed> = None;
    let states = (first_step..=last.max(first_step)).map(|at| {
        if let Some(state) = at_step(at) {
            seen = Some((at, state));
            return Some(state);
        }
        let (since, state) = seen.filter(|_| at > start && !(gone && at >= ends))?;
        let moving = state.speed_mps() >= STANDING_MPS;
        if at >= ends {
            guessed = guessed.or(Some(Guessed { step: at, moving }));
        }
        if !moving {
            return Some(State { vx_mps: 0.0, vy_mps: 0.0, ..state });
        }
        let moved = state.position() + state.velocity() * ((at - since) as f64 * STEP_S);
        Some(State { x_m: moved.x, y_m: moved.y, ..state })
    });
    let states = states.collect();
    (Track { first_step, states, z_m: None }, guessed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{AgentType, LaneMap, Subtype};

    /// Observed for 11 steps of a recording of `steps` steps.
    fn track(speed_mps: f64, steps: usize) -> (Track, Option<Guessed>) {
        let at = |i: usize| State { x_m: speed_mps * 0.1 * i as f64, vx_mps: speed_mps, ..State::default() };
        let agent =
            Agent::bare("a", AgentType::Vehicle, Subtype::Car, (0..11).map(|i| Some(at(i))).collect());
        let mut scene = Scene::bare("", LaneMap::default(), vec![agent]);
        scene.time.steps = steps;
        extrapolated(&scene, &scene.agents[0], None, 5, 30)
    }

    #[test]
    fn what_moves_goes_straight_on_after_its_log() {
        let (track, guessed) = track(10.0, 11);
        assert_eq!(guessed, Some(Guessed { step: 11, moving: true }));
        assert_eq!(track.states.len(), 31);
        assert!((track.at(30).unwrap().x_m - 30.0).abs() < 1e-9);
    }

    #[test]
    fn who_went_away_stays_away() {
        let (track, guessed) = track(10.0, 91);
        assert_eq!(guessed, None);
        assert!(track.at(10).is_some() && track.at(11).is_none());
    }

    #[test]
    fn what_stands_stays() {
        let (track, guessed) = track(0.0, 11);
        assert_eq!(guessed, Some(Guessed { step: 11, moving: false }));
        assert_eq!(track.at(30).unwrap().x_m, 0.0);
    }
}
