//! The clock of this crate. The caller passes it in.

use std::time::Duration;

/// Monotonic time since an arbitrary moment.
pub type Clock = fn() -> Duration;

/// A clock that never advances: every measured time is zero.
pub(crate) fn standing() -> Duration {
    Duration::ZERO
}

/// Milliseconds since the clock read `since`.
pub(crate) fn milliseconds(clock: Clock, since: Duration) -> f64 {
    clock().saturating_sub(since).as_secs_f64() * 1e3
}
