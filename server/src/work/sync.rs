//! Threads, locks and flags of the pool: the standard library's, or those of a model checker that runs the same
//! code in every order it can think of (feature `shuttle`, `schedules`).

#[cfg(feature = "shuttle")]
pub use shuttle::sync::{Condvar, Mutex, MutexGuard, atomic};
#[cfg(not(feature = "shuttle"))]
pub use std::sync::{Condvar, Mutex, MutexGuard, atomic};
#[cfg(not(feature = "shuttle"))]
pub use std::thread;

/// Threads of the model checker.
#[cfg(feature = "shuttle")]
pub mod thread {
    #[cfg(test)]
    pub use shuttle::thread::spawn;
    pub use shuttle::thread::{Builder, yield_now};

    /// The model has no clock: a sleeping thread yields to all others.
    pub fn sleep(_: std::time::Duration) {
        yield_now();
    }
}
