//! Slots of an actor's modes.

use crate::planning::{MODES, Modes, Residual};

/// A mode, by its index among an actor's anchors and drafts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Slot(u8);

impl Slot {
    /// The first slot: for agents with a goal position, its mode is trained to be the middle of the
    /// distribution.
    pub(super) const FIRST: Self = Self(0);

    /// The slot of an index below [`MODES`].
    pub(super) fn new(index: usize) -> Self {
        debug_assert!(index < MODES);
        Self(index as u8)
    }

    /// Its number in the answer.
    pub(super) fn number(self) -> u32 {
        u32::from(self.0)
    }

    /// Every slot in order.
    pub(super) fn all() -> impl Iterator<Item = Self> {
        (0..MODES).map(Self::new)
    }

    /// Index below [`MODES`].
    pub(super) fn index(self) -> usize {
        usize::from(self.0)
    }

    /// The draft in this slot.
    pub(super) fn of(self, modes: &Modes) -> &Residual {
        &modes[self.index()]
    }
}
