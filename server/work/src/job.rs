//! One job: its caller, its work, and its end.

use super::kind::{JobKind, PoolLane};
use super::lock;
use super::sync::Mutex;
use super::sync::atomic::{AtomicBool, Ordering};
use api::{Code, Problem};
use base::metrics;
use base::party::Party;
use experts::Cancel;
use std::fmt::Display;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Work of a job. It ends the job itself unless it is stopped.
pub type Work = Box<dyn FnOnce() + Send>;

/// Caller of a job.
#[derive(Clone, Debug, Default)]
pub struct Caller {
    /// The caller's own id for the job.
    pub job: Option<String>,
    /// Client whose newer revisions supersede this one, and this revision.
    pub client: Option<(String, u64)>,
    /// Connection of the request.
    pub connection: Option<u64>,
    /// Party of the caller.
    pub party: Party,
    /// The WebSocket of the request, which has its own share among those of its party.
    pub line: Option<u64>,
    /// No caller waits for the answer.
    pub background: bool,
}

impl Caller {
    /// The names under which callers take turns, from the whole to its parts: the party; the client or the
    /// WebSocket, or all plain requests of the party together; the connection.
    pub(super) fn names(&self) -> CallerNames {
        let party = self.party.to_string();
        let client = self.client.as_ref().map(|(client, _)| format!("{party} {client}"));
        let share = match (&client, self.line) {
            (Some(client), _) => client.clone(),
            (None, Some(number)) => format!("{party} #{number}"),
            (None, None) => format!("{party} "),
        };
        let own = self.connection.map_or_else(|| share.clone(), |number| format!("{share} #{number}"));
        CallerNames { party, share, own, client }
    }
}

/// Names of a caller; each is a part of the previous one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct CallerNames {
    pub party: String,
    pub share: String,
    pub own: String,
    /// Its client, which is another one than a client of the same id of another party.
    pub client: Option<String>,
}

impl CallerNames {
    /// The names that take turns: the whole first, then its parts.
    pub fn turns(&self) -> [&String; 3] {
        [&self.party, &self.share, &self.own]
    }
}

/// The name of a party's job among those of all parties. Ids have no spaces.
pub(super) fn job_name(party: impl Display, id: &str) -> String {
    format!("{party} {id}")
}

/// A request for a job.
#[derive(Clone, Debug)]
pub struct JobRequest {
    /// Kind of work.
    pub kind: JobKind,
    /// Approximate time on one thread.
    pub cost: Duration,
    /// Caller.
    pub caller: Caller,
}

impl JobRequest {
    /// The lane of its queue.
    pub fn lane(&self) -> PoolLane {
        self.kind.lane(self.cost, self.caller.background)
    }
}

/// Why a job ends without its result.
#[derive(Clone, Debug)]
pub enum Stop {
    /// A newer revision of the same client replaced it.
    Superseded(u64),
    /// A refusal, a failure or a cancellation.
    Problem(Problem),
}

impl Stop {
    fn outcome(&self) -> &'static str {
        match self {
            Self::Superseded(_) => "superseded",
            Self::Problem(problem) if problem.code == Code::Cancelled => "cancelled",
            Self::Problem(_) => "error",
        }
    }
}

/// End of a job. Only the first call counts.
pub trait Ending: Send + Sync {
    /// Ends the job without a result. False if it had already ended.
    fn stop(&self, stop: Stop) -> bool;

    /// Whether it has ended.
    fn is_over(&self) -> bool;

    /// How long a reader has left data waiting.
    fn stalled(&self) -> Duration {
        Duration::ZERO
    }
}

/// Data about the job for its work.
#[derive(Debug)]
pub struct Ticket {
    /// Id, unique among the open jobs of a party.
    pub id: String,
    /// Name among the open jobs of all parties.
    pub(super) name: String,
    /// Client whose newer revisions supersede this one, and this revision.
    pub client: Option<(String, u64)>,
    /// Set when the job is stopped.
    pub cancel: Cancel,
    /// Number of jobs ahead of this one when it was queued.
    pub queue_position: usize,
    asked: Instant,
}

impl Ticket {
    pub(super) fn new(
        (id, name): (String, String),
        client: Option<(String, u64)>,
        queue_position: usize,
    ) -> Self {
        Self { id, name, client, cancel: Cancel::default(), queue_position, asked: Instant::now() }
    }

    /// Time since it was queued.
    pub fn elapsed(&self) -> Duration {
        self.asked.elapsed()
    }
}

/// A waiting or running job.
pub struct Job {
    pub(super) kind: JobKind,
    pub(super) lane: PoolLane,
    pub(super) cost: Duration,
    pub(super) caller: CallerNames,
    pub(super) ticket: Arc<Ticket>,
    ending: Arc<dyn Ending>,
    work: Mutex<Option<Work>>,
    /// When a worker took it.
    began: Mutex<Option<Instant>>,
    /// Total time for which it has yielded to others.
    paused: Mutex<Duration>,
    /// When it was stopped from outside.
    stopped: Mutex<Option<Instant>>,
    /// Whether it runs while another one yields.
    is_inside: AtomicBool,
    /// Whether its thread runs another job meanwhile.
    is_yielding: AtomicBool,
}

impl Job {
    pub(super) fn new(
        kind: JobKind,
        lane: PoolLane,
        cost: Duration,
        caller: CallerNames,
        ticket: Arc<Ticket>,
        ending: Arc<dyn Ending>,
        work: Work,
    ) -> Self {
        let (work, began, paused) = (Mutex::new(Some(work)), Mutex::default(), Mutex::default());
        Self {
            kind,
            lane,
            cost,
            caller,
            ticket,
            ending,
            work,
            began,
            paused,
            stopped: Mutex::default(),
            is_inside: AtomicBool::new(false),
            is_yielding: AtomicBool::new(false),
        }
    }

    /// Called when a worker takes it.
    pub(super) fn begin(&self) -> Option<Work> {
        *lock(&self.began) = Some(Instant::now());
        lock(&self.work).take()
    }

    /// Its client.
    pub(super) fn client(&self) -> Option<&str> {
        self.caller.client.as_deref()
    }

    /// Working time of the worker so far.
    pub(super) fn worked(&self) -> Duration {
        let since = lock(&self.began).map_or(Duration::ZERO, |began| began.elapsed());
        since.saturating_sub(*lock(&self.paused))
    }

    /// Marks that it runs while another one yields.
    pub(super) fn go_inside(&self) {
        self.is_inside.store(true, Ordering::Relaxed);
    }

    /// Whether another job goes first between two steps of this one. A job of another caller does if its
    /// expected time is at most a quarter of this one's, and others have had at most this one's working time
    /// plus its expected time. A job of another party does if others would then have had no more time than
    /// this one. Only the first level yields in turn, so that two parties with many calls do not pile them
    /// up.
    pub(super) fn lets_go(&self, other: &Self) -> bool {
        let (worked, given) = (self.worked(), *lock(&self.paused));
        let is_smaller = other.caller.own != self.caller.own && 4 * other.cost <= self.cost;
        let in_turn = other.caller.party != self.caller.party && !self.is_inside.load(Ordering::Relaxed);
        (is_smaller && given <= worked + self.cost) || (in_turn && given + other.cost <= worked)
    }

    /// Runs `work`, another job, first.
    pub(super) fn pause(&self, work: impl FnOnce()) {
        let began = Instant::now();
        self.is_yielding.store(true, Ordering::Relaxed);
        work();
        self.is_yielding.store(false, Ordering::Relaxed);
        *lock(&self.paused) += began.elapsed();
    }

    pub(super) fn is_over(&self) -> bool {
        self.ending.is_over()
    }

    /// Whether a worker still runs only this job, although it was stopped longer ago than `patience`.
    pub(super) fn hangs(&self, patience: Duration) -> bool {
        let is_at_it = lock(&self.began).is_some() && !self.is_yielding.load(Ordering::Relaxed);
        is_at_it && lock(&self.stopped).is_some_and(|at| at.elapsed() > patience)
    }

    pub(super) fn stalled(&self) -> Duration {
        self.ending.stalled()
    }

    /// Ends the job and stops its work, unless it has already ended.
    pub(super) fn stop(&self, stop: Stop) {
        let outcome = stop.outcome();
        let first = self.ending.stop(stop);
        lock(&self.stopped).get_or_insert_with(Instant::now);
        self.ticket.cancel.cancel();
        if first {
            metrics::ended(self.kind.name(), outcome);
        }
    }

    pub(super) fn fail(&self, problem: Problem) {
        self.stop(Stop::Problem(problem));
    }
}
