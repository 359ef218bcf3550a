//! Queue of events from a worker to a reader. The worker never waits: for a slow reader `step` events are
//! dropped, all others are kept.

use base::metrics;
use bytes::Bytes;
use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::Notify;
use work::Stop;

/// End of a job.
#[derive(Clone, Debug)]
pub enum JobEnd {
    /// The job ended with an answer.
    Final,
    /// The job ended without an answer.
    Stopped(Stop),
}

/// One event, ready to be sent.
#[derive(Clone, Debug)]
pub struct EventMessage {
    /// Value of `event`.
    pub event: &'static str,
    /// Sequence number in the stream.
    pub seq: u64,
    /// The whole object as JSON.
    pub json: Bytes,
    /// Set on the last event.
    pub end: Option<JobEnd>,
}

#[derive(Debug)]
struct OutboxState {
    waiting: VecDeque<EventMessage>,
    closed: bool,
    /// When the first waiting message began to wait.
    since: Instant,
}

/// Queue between one job and its one reader.
#[derive(Debug)]
pub struct Outbox {
    inside: Mutex<OutboxState>,
    changed: Notify,
    most: usize,
}

impl Outbox {
    /// An empty queue that keeps `most` events before it drops steps.
    pub fn new(most: usize) -> Self {
        let inside = OutboxState { waiting: VecDeque::new(), closed: false, since: Instant::now() };
        Self { inside: Mutex::new(inside), changed: Notify::new(), most }
    }

    fn lock(&self) -> MutexGuard<'_, OutboxState> {
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds an event unless the last one has been added already. True if it was added.
    pub fn push(&self, message: EventMessage) -> bool {
        let mut inside = self.lock();
        if inside.closed {
            return false;
        }
        if message.event == "step" && inside.waiting.len() >= self.most {
            metrics::dropped_event();
            return true;
        }
        if inside.waiting.is_empty() {
            inside.since = Instant::now();
        }
        inside.closed = message.end.is_some();
        inside.waiting.push_back(message);
        drop(inside);
        self.changed.notify_one();
        true
    }

    /// Whether the last event has been added.
    pub fn is_closed(&self) -> bool {
        self.lock().closed
    }

    /// How long the reader has left an event waiting.
    pub fn stalled(&self) -> Duration {
        let inside = self.lock();
        if inside.waiting.is_empty() { Duration::ZERO } else { inside.since.elapsed() }
    }

    /// Waits for the next event; `None` after the last.
    pub async fn next(&self) -> Option<EventMessage> {
        loop {
            let changed = self.changed.notified();
            {
                let mut inside = self.lock();
                if let Some(message) = inside.waiting.pop_front() {
                    inside.since = Instant::now();
                    return Some(message);
                }
                if inside.closed {
                    return None;
                }
            }
            changed.await;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{EventMessage, JobEnd, Outbox};

    fn message(event: &'static str, seq: u64) -> EventMessage {
        let end = (event == "final").then_some(JobEnd::Final);
        EventMessage { event, seq, json: bytes::Bytes::new(), end }
    }

    #[tokio::test]
    async fn a_slow_reader_loses_steps_only() {
        let outbox = Outbox::new(2);
        for seq in 0..6 {
            outbox.push(message(if seq == 0 { "accepted" } else { "step" }, seq));
        }
        outbox.push(message("initial", 6));
        outbox.push(message("final", 7));
        assert!(!outbox.push(message("step", 8)), "nothing follows the last");
        let mut seen = Vec::new();
        while let Some(message) = outbox.next().await {
            seen.push(message.seq);
        }
        assert_eq!(seen, [0, 1, 6, 7]);
    }
}
