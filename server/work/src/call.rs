//! Calls with one answer: a closure in, its result out.

use super::job::{Caller, Ending, JobRequest, Stop};
use super::kind::{JobKind, PoolLane};
use super::sync::Mutex;
use super::{Pool, lock};
use api::{Code, Problem};
use base::metrics;
use experts::Cancel;
use std::future::Future;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::oneshot;

tokio::task_local! {
    /// Caller whose request the task serves.
    static CALLER: Caller;
}

/// Runs `work` for a caller: its documents use the caller's turns and queue places.
pub async fn on_behalf_of<F: Future>(caller: Caller, work: F) -> F::Output {
    CALLER.scope(caller, work).await
}

/// Documents up to this size are processed at once, bytes: a queue would cost more than it saves.
const SMALL_BYTES: usize = 32 << 10;

/// Time in which the threads of a lane must take a small call.
const ANSWER: Duration = Duration::from_secs(2);

/// Sender of a call's only reply.
struct ReplySlot<T>(Mutex<Option<oneshot::Sender<Result<T, Problem>>>>);

impl<T> ReplySlot<T> {
    /// Sends the result. False if one was already sent.
    fn give(&self, result: Result<T, Problem>) -> bool {
        // The caller may have left; the result still ends the call.
        lock(&self.0).take().map(|sender| drop(sender.send(result))).is_some()
    }
}

impl<T: Send> Ending for ReplySlot<T> {
    fn stop(&self, stop: Stop) -> bool {
        self.give(Err(match stop {
            Stop::Problem(problem) => problem,
            Stop::Superseded(by) => superseded(by),
        }))
    }

    fn is_over(&self) -> bool {
        lock(&self.0).is_none()
    }
}

/// The refusal of a call that a newer revision has superseded.
pub fn superseded(by: u64) -> Problem {
    let detail = format!("Revision {by} of the same client has replaced this one.");
    Problem::new(Code::Superseded, detail).with(|m| m.by_revision = Some(by))
}

impl Pool {
    /// Waits for a worker and returns the result of the work. Dropping the future cancels the work.
    ///
    /// # Errors
    /// The work's own problem, a full queue, a time limit, or shutdown.
    pub async fn run<T: Send + 'static>(
        self: &Arc<Self>,
        asked: JobRequest,
        work: impl FnOnce(&Cancel) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let (sender, receiver) = oneshot::channel();
        let kind = asked.kind;
        let answer = Arc::new(ReplySlot(Mutex::new(Some(sender))));
        let (_, _hold) = self.submit(asked, |ticket| {
            let (ticket, given) = (Arc::clone(ticket), Arc::clone(&answer));
            let work = move || {
                let result = work(&ticket.cancel);
                let outcome = if result.is_ok() { "final" } else { "error" };
                if given.give(result) {
                    metrics::ended(kind.name(), outcome);
                }
            };
            (answer, Box::new(work))
        })?;
        receiver.await.unwrap_or_else(|_| Err(Problem::internal("a call ended without its answer")))
    }

    /// Whether the threads of a lane take a small call soon. A lane with long waits fails only if all its
    /// threads are busy with calls that ended some time ago.
    pub async fn answers(self: &Arc<Self>, lane: PoolLane) -> bool {
        let kind = match lane {
            PoolLane::Document => JobKind::Document,
            PoolLane::Quick => JobKind::Score,
            PoolLane::Patient | PoolLane::Background => {
                return lock(&self.state).hanging(lane, ANSWER) < self.limits.workers();
            }
        };
        let asked = JobRequest { kind, cost: Duration::ZERO, caller: Caller::default() };
        let call = tokio::time::timeout(ANSWER, self.run(asked, |_| Ok(())));
        matches!(call.await, Ok(Ok(())))
    }

    /// Runs work on a document of about this size: at once if it is small, else queued for the task's caller
    /// ([`on_behalf_of`]), or for the program itself.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub async fn document<T: Send + 'static>(
        self: &Arc<Self>,
        bytes: usize,
        work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        if bytes <= SMALL_BYTES {
            return work();
        }
        // Reading takes about this time per byte; the largest documents are refused when they are decoded.
        let cost = Duration::from_nanos(10 * bytes.min(64 << 20) as u64);
        let caller = CALLER.try_with(Caller::clone).unwrap_or_default();
        let asked = JobRequest { kind: JobKind::Document, cost, caller };
        self.run(asked, move |_| work()).await
    }
}
