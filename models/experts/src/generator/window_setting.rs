//! The setting of a planning window, which all of its samples share.

use super::resources::Resources;
use super::workers::WorkerPool;
use crate::maps::KnownMap;
use crate::planning::pullback::Pullback;
use crate::planning::world::World;
use crate::request::Request;
use crate::tuning::Tuning;
use scene::motion::Trajectory;
use scene::{HORIZON_STEPS, State};
use std::sync::Arc;

/// A planning window before any agent acts.
pub(super) struct WindowSetting<'g> {
    pub(super) resources: &'g Resources,
    pub(super) request: Arc<Request>,
    pub(super) map: Arc<KnownMap>,
    /// The scene at the window's start, and the conditions of its agents in this window.
    pub(super) world: World<'g>,
    /// Number of the window, from 0.
    pub(super) number: usize,
    pub(super) pullback: Pullback,
}

impl<'g> WindowSetting<'g> {
    /// The threads that share the work.
    pub(super) fn workers(&self) -> &'g WorkerPool {
        &self.resources.workers
    }

    /// The tuned numbers.
    pub(super) fn tuning(&self) -> &'g Tuning {
        &self.resources.tuning
    }

    /// Steps from the window's start to the end of the call.
    pub(super) fn steps_left(&self) -> usize {
        self.request.start_step + self.request.horizon_steps - self.world.step
    }

    /// The requested part of a trajectory without its start.
    pub(super) fn cut(&self, states: &Trajectory) -> Vec<State> {
        let left = self.steps_left();
        states.iter().skip(1).take(left.min(HORIZON_STEPS)).map(State::from).collect()
    }
}
