//! The drafts of an actor in one sample.

use super::actor::PlannedActor;
use super::slot::Slot;
use crate::planning::{MODES, Modes, RESIDUAL, Residual};

/// The drafts of an actor in one sample.
#[derive(Clone)]
pub(super) struct Drafts {
    pub(super) modes: Modes,
    /// The part of the drafts that the networks do not see: diversity and the draw.
    pub(super) offset: Modes,
    /// Probability of each mode; they sum to one.
    pub(super) probability: [f64; MODES],
    /// Modes in order of descending probability.
    pub(super) order: [Slot; MODES],
    /// The mode of this actor that the others see during refinement.
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

    /// Adds an offset that the networks do not see.
    pub(super) fn add(&mut self, offset: &Modes) {
        for (mode, more) in [&mut self.modes, &mut self.offset].into_iter().map(|m| (m, offset)) {
            for (value, more) in mode.as_flattened_mut().iter_mut().zip(more.as_flattened()) {
                *value += more;
            }
        }
    }

    /// The modes as the networks see them.
    pub(super) fn plain(&self) -> Modes {
        let mut plain = self.modes;
        for (value, offset) in plain.as_flattened_mut().iter_mut().zip(self.offset.as_flattened()) {
            *value -= offset;
        }
        plain
    }

    /// Takes over the modes that the networks refined.
    pub(super) fn refined(&mut self, plain: Modes) {
        self.modes = plain;
        for (value, offset) in self.modes.as_flattened_mut().iter_mut().zip(self.offset.as_flattened()) {
            *value += offset;
        }
    }
}
