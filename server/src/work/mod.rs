//! Generations: a fixed pool of workers, a bounded queue, latest wins, and every way to stop.
//!
//! A job ends exactly once, with the first [`End`] that is put into its outbox: the worker's answer
//! or failure, a newer revision, DELETE, a dropped connection, a time limit, or shutdown. All but
//! the first set the generator's cancel flag too, which it looks at between denoising steps.

mod clients;
mod outbox;
mod worker;

pub use outbox::{End, Message};

use crate::base::limits::Limits;
use crate::base::problem::{Code, Problem};
use crate::generation::events::{Envelope, ErrorBody, GeneratedHead, SupersededBody};
use clients::Clients;
use experts::{Cancel, Generator, Request};
use outbox::Outbox;
use serde::Serialize;
use std::collections::{HashMap, VecDeque};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// What a worker is to do.
#[derive(Debug)]
pub struct Task {
    /// For the generator.
    pub request: Request,
    /// All alternatives in drafts, not the chosen ones alone.
    pub all_modes: bool,
    /// Score each sample.
    pub score: bool,
    /// The rest of `generated`.
    pub head: GeneratedHead,
}

/// Who asks.
#[derive(Clone, Debug, Default)]
pub struct Caller {
    /// The caller's own id for the job.
    pub job: Option<String>,
    /// Client whose newer revisions take over.
    pub client: Option<(String, u64)>,
}

/// One generation.
#[derive(Debug)]
pub struct Job {
    /// Id, unique among those under way.
    pub id: String,
    client: Option<(String, u64)>,
    cancel: Cancel,
    outbox: Outbox,
    seq: AtomicU64,
    queue_position: AtomicUsize,
    asked: Instant,
    /// When a worker took it.
    began: Mutex<Option<Instant>>,
    task: Mutex<Option<Task>>,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Job {
    /// Sends one event; with `end`, the last one. False when the job has ended already.
    fn send<T: Serialize>(&self, event: &'static str, body: T, end: Option<End>) -> bool {
        if self.outbox.is_closed() {
            return false;
        }
        let seq = self.seq.fetch_add(1, Ordering::Relaxed);
        let elapsed_ms = (self.asked.elapsed().as_secs_f64() * 1e4).round() / 10.0;
        let revision = self.client.as_ref().map(|c| c.1);
        let envelope = Envelope { event, seq, job: &self.id, revision, elapsed_ms, body };
        match serde_json::to_vec(&envelope) {
            Ok(json) => self.outbox.push(Message { event, seq, json: json.into(), end }),
            Err(error) => {
                let problem = Problem::internal(error);
                let json = problem.body(None, None).to_string().into();
                self.outbox.push(Message { event: "error", seq, json, end: Some(End::Problem(problem)) })
            }
        }
    }

    /// Ends the job and stops its work, unless it has ended already.
    fn end(&self, end: End) {
        let outcome = match &end {
            End::Superseded(_) => "superseded",
            End::Problem(p) if p.code == Code::Cancelled => "cancelled",
            _ => "error",
        };
        let first = match &end {
            End::Superseded(by_revision) => {
                let body = SupersededBody { by_revision: *by_revision };
                self.send("superseded", body, Some(end))
            }
            End::Problem(problem) => self.send("error", ErrorBody::new(problem), Some(end.clone())),
            End::Final => false,
        };
        self.cancel.cancel();
        if first {
            crate::base::metrics::generated(outcome);
        }
    }

    fn fail(&self, problem: Problem) {
        self.end(End::Problem(problem));
    }
}

#[derive(Debug)]
struct State {
    queue: VecDeque<Arc<Job>>,
    jobs: HashMap<String, Arc<Job>>,
    clients: Clients,
    running: usize,
    closing: bool,
    /// Running mean of a generation's time, seconds.
    mean_s: f64,
}

/// Shared by handlers and workers.
pub struct Pool {
    state: Mutex<State>,
    arrived: Condvar,
    limits: Arc<Limits>,
    stopped: AtomicBool,
}

impl Pool {
    /// Starts the workers and the one that watches time limits.
    pub fn start(generator: &Arc<Generator>, limits: &Arc<Limits>) -> Arc<Self> {
        let state = State {
            queue: VecDeque::new(),
            jobs: HashMap::new(),
            clients: Clients::new(limits.clients as usize, Duration::from_secs(limits.client_idle_s)),
            running: 0,
            closing: false,
            mean_s: 0.3,
        };
        let pool = Arc::new(Self {
            state: Mutex::new(state),
            arrived: Condvar::new(),
            limits: Arc::clone(limits),
            stopped: AtomicBool::new(false),
        });
        for _ in 0..limits.workers() {
            let (pool, generator) = (Arc::clone(&pool), Arc::clone(generator));
            std::thread::spawn(move || worker::work(&pool, &generator));
        }
        let watched = Arc::clone(&pool);
        std::thread::spawn(move || watched.watch());
        pool
    }

    /// Queues a generation.
    ///
    /// # Errors
    /// `shutting-down`, `exists`, `stale-revision` or `busy`.
    pub fn submit(self: &Arc<Self>, caller: Caller, task: Task) -> Result<Handle, Problem> {
        let mut state = lock(&self.state);
        if state.closing {
            return Err(Problem::new(Code::ShuttingDown, "The server is about to stop.").retry_after(5));
        }
        let id = caller.job.unwrap_or_else(|| uuid::Uuid::now_v7().to_string());
        if state.jobs.contains_key(&id) {
            return Err(Problem::new(Code::Exists, "A job with this id is under way."));
        }
        if let Some((client, revision)) = &caller.client {
            state.clients.advance(client, *revision, Instant::now()).map_err(|highest| {
                let detail = format!("Revision {revision} is not above {highest}.");
                Problem::new(Code::StaleRevision, detail).with("highest_revision", highest)
            })?;
            state.supersede(client, *revision);
        }
        if state.queue.len() as u64 >= self.limits.queue {
            let wait = (state.queue.len() as f64 * state.mean_s).ceil().clamp(1.0, 30.0);
            let detail = format!("{} generations are waiting already.", state.queue.len());
            return Err(Problem::new(Code::Busy, detail).retry_after(wait as u64));
        }
        let job = Arc::new(Job {
            id: id.clone(),
            client: caller.client,
            cancel: Cancel::default(),
            outbox: Outbox::new(self.limits.buffered_events as usize),
            seq: AtomicU64::new(0),
            queue_position: AtomicUsize::new(state.queue.len() + state.running),
            asked: Instant::now(),
            began: Mutex::new(None),
            task: Mutex::new(Some(task)),
        });
        state.jobs.insert(id, Arc::clone(&job));
        state.queue.push_back(Arc::clone(&job));
        crate::base::metrics::load(state.queue.len(), state.running);
        drop(state);
        self.arrived.notify_one();
        Ok(Handle { job, pool: Arc::clone(self) })
    }

    /// Cancels a job by its id; unknown ids are nothing to do.
    pub fn cancel(&self, id: &str) {
        let job = lock(&self.state).jobs.get(id).cloned();
        if let Some(job) = job {
            job.fail(Problem::new(Code::Cancelled, "The job was cancelled."));
            self.forget_queued(&job);
        }
    }

    /// True when another call would be queued.
    pub fn has_room(&self) -> bool {
        let state = lock(&self.state);
        !state.closing && (state.queue.len() as u64) < self.limits.queue
    }

    /// Takes no more jobs.
    pub fn close(&self) {
        lock(&self.state).closing = true;
    }

    /// Ends everything under way and lets the workers go.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
        let jobs: Vec<_> = {
            let mut state = lock(&self.state);
            state.closing = true;
            state.queue.clear();
            state.jobs.values().cloned().collect()
        };
        for job in jobs {
            job.fail(Problem::new(Code::ShuttingDown, "The server is stopping.").retry_after(5));
        }
        self.arrived.notify_all();
    }

    /// Takes a job that has ended out of the queue, if it still waits there.
    fn forget_queued(&self, job: &Arc<Job>) {
        let mut state = lock(&self.state);
        let before = state.queue.len();
        state.queue.retain(|queued| !Arc::ptr_eq(queued, job));
        if state.queue.len() < before {
            state.jobs.remove(&job.id);
        }
        crate::base::metrics::load(state.queue.len(), state.running);
    }

    /// The next job to work on; `None` when the pool has stopped.
    fn take(&self) -> Option<Arc<Job>> {
        let mut state = lock(&self.state);
        loop {
            if self.stopped.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(job) = state.queue.pop_front() {
                state.running += 1;
                *lock(&job.began) = Some(Instant::now());
                crate::base::metrics::load(state.queue.len(), state.running);
                return Some(job);
            }
            state = self.arrived.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn finished(&self, job: &Job, took: Duration) {
        let mut state = lock(&self.state);
        state.running -= 1;
        state.jobs.remove(&job.id);
        state.mean_s = 0.8 * state.mean_s + 0.2 * took.as_secs_f64();
        crate::base::metrics::load(state.queue.len(), state.running);
    }

    /// Ends jobs that take too long or whose reader has stopped reading.
    fn watch(&self) {
        let seconds = Duration::from_secs;
        while !self.stopped.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(100));
            let jobs: Vec<_> = lock(&self.state).jobs.values().cloned().collect();
            for job in jobs {
                let worked = lock(&job.began).map_or(Duration::ZERO, |began| began.elapsed());
                let limit = if worked > seconds(self.limits.generate_s) {
                    self.limits.generate_s
                } else if job.asked.elapsed() > seconds(self.limits.stream_s) {
                    self.limits.stream_s
                } else if job.outbox.stalled() > seconds(self.limits.stalled_s) {
                    job.fail(Problem::new(Code::Cancelled, "The reader stopped reading."));
                    continue;
                } else {
                    continue;
                };
                let detail = format!("The generation took longer than {limit} s.");
                job.fail(Problem::new(Code::GenerateTimeout, detail).with("limit", limit));
                self.forget_queued(&job);
            }
        }
    }
}

impl State {
    /// Ends what this client has running or queued.
    fn supersede(&mut self, client: &str, revision: u64) {
        let older: Vec<_> = self
            .jobs
            .values()
            .filter(|job| job.client.as_ref().is_some_and(|c| c.0 == client))
            .cloned()
            .collect();
        for job in older {
            job.end(End::Superseded(revision));
            let before = self.queue.len();
            self.queue.retain(|queued| !Arc::ptr_eq(queued, &job));
            if self.queue.len() < before {
                self.jobs.remove(&job.id);
            }
        }
    }
}

/// A reader's hold on its job: dropping it before the end stops the work.
pub struct Handle {
    /// The job.
    pub job: Arc<Job>,
    pool: Arc<Pool>,
}

impl Handle {
    /// The next event; `None` after the last.
    pub async fn next(&self) -> Option<Message> {
        self.job.outbox.next().await
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        if !self.job.outbox.is_closed() {
            self.job.fail(Problem::new(Code::Cancelled, "The connection was dropped."));
            self.pool.forget_queued(&self.job);
        }
    }
}
