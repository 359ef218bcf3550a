//! The pause before the answer to a refused client: one that retries at once would take cores from others.
//!
//! Meanwhile its connection is the first that makes room for a new one.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::Notify;

/// Pause of one connection, where it is in one. Extension of its requests.
#[derive(Clone, Debug, Default)]
pub struct RefusalPause(Arc<PauseState>);

#[derive(Debug, Default)]
struct PauseState {
    since: Mutex<Option<Instant>>,
    hurry: Notify,
}

impl RefusalPause {
    fn set(&self, since: Option<Instant>) {
        *self.0.since.lock().unwrap_or_else(PoisonError::into_inner) = since;
    }

    /// When it began; `None` outside of it.
    pub fn since(&self) -> Option<Instant> {
        *self.0.since.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends it.
    pub fn hurry(&self) {
        self.0.hurry.notify_one();
    }

    /// Waits for so long; less where the connection's place is needed. True if the connection is to end with the reply.
    pub async fn wait(&self, time: Duration) -> bool {
        self.set(Some(Instant::now()));
        let hurried = tokio::time::timeout(time, self.0.hurry.notified()).await.is_ok();
        self.set(None);
        hurried
    }
}
