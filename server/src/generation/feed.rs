//! The events of one job: its worker or a stop produces them, its reader consumes them.

use super::events::{Envelope, ErrorBody, EventBody, SupersededBody};
use super::outbox::{EventMessage, JobEnd, Outbox};
use api::Problem;
use base::problem::logged;
use serde::Serialize;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use work::{Ending, Handle, Stop, Ticket};

/// Numbers events, wraps them in their envelope, and puts them into the outbox.
#[derive(Debug)]
pub struct Feed {
    /// Ticket of the job.
    pub ticket: Arc<Ticket>,
    outbox: Outbox,
    seq: AtomicU64,
    /// Path of the operation, for problems.
    path: &'static str,
}

impl Feed {
    /// An empty feed of the operation at `path`; it keeps `most` events before it drops steps.
    pub fn new(ticket: Arc<Ticket>, most: usize, path: &'static str) -> Self {
        Self { ticket, outbox: Outbox::new(most), seq: AtomicU64::new(0), path }
    }

    /// Sends one event; with `end` it is the last one. False if the job has already ended.
    pub fn send<T: EventBody + Serialize>(&self, body: T, end: Option<JobEnd>) -> bool {
        if self.outbox.is_closed() {
            return false;
        }
        let event = body.name();
        let seq = self.seq.fetch_add(1, Ordering::Relaxed);
        let elapsed_ms = (self.ticket.elapsed().as_secs_f64() * 1e4).round() / 10.0;
        let revision = self.ticket.client.as_ref().map(|c| c.1);
        let envelope = Envelope { event, seq, job: &self.ticket.id, revision, elapsed_ms, body };
        match serde_json::to_vec(&envelope) {
            Ok(json) => self.outbox.push(EventMessage { event, seq, json: json.into(), end }),
            Err(error) => self.fail(Problem::internal(error)),
        }
    }

    /// Ends the job with a problem. False if it has already ended.
    pub fn fail(&self, problem: Problem) -> bool {
        let problem = logged(problem);
        self.send(ErrorBody::new(&problem, self.path), Some(JobEnd::Stopped(Stop::Problem(problem))))
    }
}

impl Ending for Feed {
    fn stop(&self, stop: Stop) -> bool {
        match stop {
            Stop::Superseded(by_revision) => {
                self.send(SupersededBody { by_revision }, Some(JobEnd::Stopped(stop)))
            }
            Stop::Problem(problem) => self.fail(problem),
        }
    }

    fn is_over(&self) -> bool {
        self.outbox.is_closed()
    }

    fn stalled(&self) -> Duration {
        self.outbox.stalled()
    }
}

/// The only reader of a job; dropping it before the end stops the work.
pub struct EventReader {
    feed: Arc<Feed>,
    _hold: Handle,
}

impl EventReader {
    /// The reader of a job in the pool.
    pub fn new(feed: Arc<Feed>, handle: Handle) -> Self {
        Self { feed, _hold: handle }
    }

    /// The next event; `None` after the last.
    pub async fn next(&self) -> Option<EventMessage> {
        self.feed.outbox.next().await
    }
}
