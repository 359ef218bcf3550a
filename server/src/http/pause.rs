//! The pause before the reply to a refused client: a client that retries at once would take cores from
//! others.
//!
//! During the pause its connection is the first to make room for a new one.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::Notify;

/// The pause of a connection, if there is one. Extension of its requests.
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

    /// When it began; `None` outside a pause.
    pub fn since(&self) -> Option<Instant> {
        *self.0.since.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the pause.
    pub fn hurry(&self) {
        self.0.hurry.notify_one();
    }

    /// Waits for `time`, or less if the connection's place is needed. True if the connection should close
    /// after the reply.
    pub async fn wait(&self, time: Duration) -> bool {
        self.set(Some(Instant::now()));
        let hurried = tokio::time::timeout(time, self.0.hurry.notified()).await.is_ok();
        self.set(None);
        hurried
    }
}
