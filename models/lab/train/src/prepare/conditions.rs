//! Which condition fields a training record fixes: all subsets appear, the common ones more often.

use scene::random::{Key, Stream};
use scene::{Agent, Conditions, Goal, HORIZON_STEPS, STEP_S, Scene};

/// Draws for one scene, the same for the same seed and scene name.
pub(super) struct Draws(Stream);

/// Subsets as (position, heading, speed) with their shares in percent.
const SUBSETS: [((bool, bool, bool), f64); 8] = [
    ((false, false, false), 30.0),
    ((true, false, false), 18.0),
    ((true, false, true), 15.0),
    ((true, true, false), 8.0),
    ((true, true, true), 16.0),
    ((false, false, true), 8.0),
    ((false, true, false), 2.0),
    ((false, true, true), 3.0),
];

impl Draws {
    pub(super) fn new(seed: u64, name: &str) -> Self {
        Self(Key::default().number(seed).text(name).stream())
    }

    /// Order in which the agents are considered.
    pub(super) fn shuffle(&mut self, agents: &mut [usize]) {
        self.0.shuffle(agents);
    }

    /// Whether a standing road user is taken.
    pub(super) fn takes(&mut self, share: f64) -> bool {
        self.0.chance(share)
    }

    /// A goal from the recorded motion, with some fields left free.
    pub(super) fn goal(&mut self, agent: &Agent, standing: bool) -> Goal {
        let subset = self.0.weighted(SUBSETS);
        if subset == (false, false, false) || (standing && self.0.chance(0.7)) {
            return Goal::default();
        }
        let steps: Vec<usize> =
            agent.track.valid_steps().filter(|s| (20..=HORIZON_STEPS).contains(s)).collect();
        let Some(last) = steps.last().copied() else { return Goal::default() };
        let step = if self.0.chance(0.75) { last } else { steps[self.0.below(steps.len())] };
        let Some(state) = agent.state_at(step) else { return Goal::default() };
        Goal {
            position: subset.0.then(|| state.position()),
            heading_rad: subset.1.then_some(state.heading_rad),
            speed_mps: subset.2.then(|| state.speed_mps()),
            time_s: Some(step as f64 * STEP_S),
        }
    }

    /// In half of the records a few others have their goals fixed too, so that the expert learns to read them.
    pub(super) fn others(&mut self, scene: &Scene, but: usize, conditions: &mut [Conditions]) {
        if self.0.chance(0.5) {
            return;
        }
        let share = self.0.unit();
        for (i, agent) in scene.agents.iter().enumerate() {
            if i != but && self.0.chance(share) {
                conditions[i].goal = self.goal(agent, agent.track.extent_m() < 2.0);
            }
        }
    }
}
