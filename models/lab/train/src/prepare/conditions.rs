//! Which condition fields a training record fixes: all subsets appear, the common ones more often.

use rand_chacha::ChaCha12Rng;
use rand_core::{Rng, SeedableRng};
use scene::{Agent, Conditions, Goal, HORIZON_STEPS, STEP_S, Scene};

/// Draws for one scene, the same for the same seed and scene name.
pub(super) struct Draw(ChaCha12Rng);

/// Subsets as (position, heading, speed) with their shares in percent.
const SUBSETS: [((bool, bool, bool), u32); 8] = [
    ((false, false, false), 30),
    ((true, false, false), 18),
    ((true, false, true), 15),
    ((true, true, false), 8),
    ((true, true, true), 16),
    ((false, false, true), 8),
    ((false, true, false), 2),
    ((false, true, true), 3),
];

impl Draw {
    pub(super) fn new(seed: u64, name: &str) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&seed.to_le_bytes());
        hasher.update(name.as_bytes());
        Self(ChaCha12Rng::from_seed(*hasher.finalize().as_bytes()))
    }

    /// Even over 0 .. 1.
    fn unit(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / (f64::from(u32::MAX) + 1.0)
    }

    pub(super) fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    pub(super) fn shuffle(&mut self, list: &mut [usize]) {
        for i in (1..list.len()).rev() {
            list.swap(i, (self.unit() * (i + 1) as f64) as usize);
        }
    }

    /// A goal from what the road user did, some fields left free.
    pub(super) fn goal(&mut self, agent: &Agent, standing: bool) -> Goal {
        let mut ticket = (self.unit() * 100.0) as u32;
        let mut subset = SUBSETS[0].0;
        for (candidate, share) in SUBSETS {
            subset = candidate;
            if ticket < share {
                break;
            }
            ticket -= share;
        }
        if subset == (false, false, false) || (standing && self.chance(0.7)) {
            return Goal::default();
        }
        let steps: Vec<usize> =
            agent.track.valid_steps().filter(|s| (20..=HORIZON_STEPS).contains(s)).collect();
        let Some(last) = steps.last().copied() else { return Goal::default() };
        let step = if self.chance(0.75) { last } else { steps[(self.unit() * steps.len() as f64) as usize] };
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
        if self.chance(0.5) {
            return;
        }
        let share = self.unit();
        for (i, agent) in scene.agents.iter().enumerate() {
            if i != but && self.chance(share) {
                conditions[i].goal = self.goal(agent, agent.track.extent_m() < 2.0);
            }
        }
    }
}
