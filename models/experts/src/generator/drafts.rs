//! The drafts of an actor in one sample.

use super::actor::PlannedActor;
use super::slot::Slot;
use crate::planning::{MODES, Modes, RESIDUAL, Residual};

/// The drafts of an actor in one sample.
#[derive(Clone)]
pub(super) struct Drafts {
    pub(super) modes: Modes,
    /// The part of them that the networks do not see: what diversity adds, and the draw.
    pub(super) offset: Modes,
    /// By mode, summing to one.
    pub(super) probability: [f64; MODES],
    /// Modes by falling probability.
    pub(super) order: [Slot; MODES],
    /// The mode that the others see of this actor while they refine.
    pub(super) leading: Slot,
    /// The leading draft after overlaps were resolved, if that moved it.
    pub(super) settled: Option<Residual>,
}

impl Drafts {
    /// The first drafts of an actor.
    pub(super) fn of(actor: &PlannedActor, leading: Slot) -> Self {
        let offset = [[0.0; RESIDUAL]; MODES];
        let (modes, probability, order) = (actor.modes, actor.probability, actor.order);
        Self { modes, offset, probability, order, leading, settled: None }
    }

    /// Adds what the networks do not see.
    pub(super) fn add(&mut self, offset: &Modes) {
        for (mode, more) in [&mut self.modes, &mut self.offset].into_iter().map(|m| (m, offset)) {
            for (value, more) in mode.as_flattened_mut().iter_mut().zip(more.as_flattened()) {
                *value += more;
            }
        }
    }

    /// The modes as the networks know them.
    pub(super) fn plain(&self) -> Modes {
        let mut plain = self.modes;
        for (value, offset) in plain.as_flattened_mut().iter_mut().zip(self.offset.as_flattened()) {
            *value -= offset;
        }
        plain
    }

    /// Takes up the modes as the networks left them.
    pub(super) fn refined(&mut self, plain: Modes) {
        self.modes = plain;
        for (value, offset) in self.modes.as_flattened_mut().iter_mut().zip(self.offset.as_flattened()) {
            *value += offset;
        }
    }
}
