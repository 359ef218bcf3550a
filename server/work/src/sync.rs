//! Threads, locks and flags of the pool: the standard library's, or those of a model checker that explores
//! thread interleavings (unit tests of this crate, `schedules`).

#[cfg(test)]
pub use shuttle::sync::{Condvar, Mutex, MutexGuard, atomic};
#[cfg(not(test))]
pub use std::sync::{Condvar, Mutex, MutexGuard, atomic};
#[cfg(not(test))]
pub use std::thread;

/// Threads of the model checker.
#[cfg(test)]
pub mod thread {
    pub use shuttle::thread::{Builder, spawn, yield_now};

    /// The model has no clock: a sleeping thread yields to all others.
    pub fn sleep(_: std::time::Duration) {
        yield_now();
    }
}
