//! CPU work: fixed workers, bounded queues, latest wins, and every way to stop.
//!
//! There are two lanes. Long work (generations, placements, scores, files in and out) waits for one of
//! the workers. Short work (reading and writing of documents) has threads of its own beside them, so that
//! a newer revision is read, and a scene saved, while all workers are busy.
//!
//! A job ends exactly once, with what is first put into its [`Ending`]: its result, a newer revision,
//! DELETE, a dropped connection, a time limit, or shutdown. All but the result set its [`Cancel`] too,
//! which the work looks at between its steps.

mod call;
mod clients;
mod job;
mod kind;

pub use call::superseded;
pub use job::{Caller, Ending, Stop, Ticket, Work};
pub use kind::Kind;

use crate::base::id;
use crate::base::limits::Limits;
use crate::base::metrics;
use crate::base::problem::{Code, Problem};
use clients::Clients;
use job::Job;
use kind::Lane;
use std::collections::{HashMap, VecDeque};
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Jobs of one lane.
#[derive(Default)]
struct Traffic {
    queue: VecDeque<Arc<Job>>,
    running: usize,
    /// Running mean of a job's time, seconds.
    mean_s: f64,
}

struct State {
    long: Traffic,
    short: Traffic,
    jobs: HashMap<String, Arc<Job>>,
    clients: Clients,
    closing: bool,
}

impl State {
    fn lane(&mut self, lane: Lane) -> &mut Traffic {
        match lane {
            Lane::Long => &mut self.long,
            Lane::Short => &mut self.short,
        }
    }

    /// Ends what this client has running or queued.
    fn supersede(&mut self, client: &str, revision: u64) {
        let of_client = |job: &&Arc<Job>| job.ticket.client.as_ref().is_some_and(|c| c.0 == client);
        let older: Vec<_> = self.jobs.values().filter(of_client).cloned().collect();
        for job in older {
            job.stop(Stop::Superseded(revision));
            self.forget_queued(&job);
        }
    }

    /// Takes a job that has ended out of its queue, if it still waits there.
    fn forget_queued(&mut self, job: &Arc<Job>) {
        let queue = &mut self.lane(job.kind.lane()).queue;
        let before = queue.len();
        queue.retain(|queued| !Arc::ptr_eq(queued, job));
        if queue.len() < before {
            self.jobs.remove(&job.ticket.id);
        }
        self.show();
    }

    fn show(&self) {
        for (name, lane) in [("long", &self.long), ("short", &self.short)] {
            metrics::load(name, lane.queue.len(), lane.running);
        }
    }
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
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(limits: &Arc<Limits>) -> io::Result<Arc<Self>> {
        let state = State {
            long: Traffic { mean_s: 0.3, ..Traffic::default() },
            short: Traffic { mean_s: 0.03, ..Traffic::default() },
            jobs: HashMap::new(),
            clients: Clients::new(limits.clients as usize, Duration::from_secs(limits.client_idle_s)),
            closing: false,
        };
        let pool = Arc::new(Self {
            state: Mutex::new(state),
            arrived: Condvar::new(),
            limits: Arc::clone(limits),
            stopped: AtomicBool::new(false),
        });
        for number in 0..limits.workers() {
            pool.spawn(format!("worker-{number}"), |pool| pool.work(&[Lane::Long, Lane::Short]))?;
        }
        for number in 0..limits.readers() {
            pool.spawn(format!("reader-{number}"), |pool| pool.work(&[Lane::Short]))?;
        }
        pool.spawn("watch".into(), Self::watch)?;
        Ok(pool)
    }

    fn spawn(self: &Arc<Self>, name: String, run: impl FnOnce(&Self) + Send + 'static) -> io::Result<()> {
        let pool = Arc::clone(self);
        std::thread::Builder::new().name(name).spawn(move || run(&pool)).map(drop)
    }

    /// Queues a job. `make` gives what is to be done and where its end goes.
    ///
    /// # Errors
    /// `shutting-down`, `exists`, `stale-revision` or `busy`.
    pub fn submit<E: Ending + 'static>(
        self: &Arc<Self>,
        kind: Kind,
        caller: Caller,
        make: impl FnOnce(&Arc<Ticket>) -> (Arc<E>, Work),
    ) -> Result<(Arc<E>, Handle), Problem> {
        let mut state = lock(&self.state);
        // Documents of calls that are under way are still read and written while the server closes.
        let refused = state.closing && kind.lane() == Lane::Long;
        if refused || self.stopped.load(Ordering::Relaxed) {
            return Err(Problem::new(Code::ShuttingDown, "The server is about to stop.").retry_after(5));
        }
        let id = caller.job.unwrap_or_else(id::fresh);
        if state.jobs.contains_key(&id) {
            return Err(Problem::new(Code::Exists, "A job with this id is under way."));
        }
        if let Some((client, revision)) = &caller.client {
            state.clients.advance(client, *revision, Instant::now()).map_err(|highest| {
                let detail = format!("Revision {revision} is not above {highest}.");
                Problem::new(Code::StaleRevision, detail).with(|m| m.highest_revision = Some(highest))
            })?;
            state.supersede(client, *revision);
        }
        let running = state.long.running + state.short.running;
        let lane = state.lane(kind.lane());
        let waiting = lane.queue.len();
        if waiting as u64 >= self.limits.queue {
            let wait = (waiting as f64 * lane.mean_s).ceil().clamp(1.0, 30.0);
            let detail = format!("{waiting} calls are waiting already.");
            return Err(Problem::new(Code::Busy, detail).retry_after(wait as u64));
        }
        let ticket = Arc::new(Ticket::new(id, caller.client, waiting + running));
        let (ending, work) = make(&ticket);
        let job = Arc::new(Job::new(kind, ticket, Arc::clone(&ending) as Arc<dyn Ending>, work));
        lane.queue.push_back(Arc::clone(&job));
        state.jobs.insert(job.ticket.id.clone(), Arc::clone(&job));
        state.show();
        drop(state);
        // All: a thread that does not take this lane must not swallow the call.
        self.arrived.notify_all();
        Ok((ending, Handle { job, pool: Arc::clone(self) }))
    }

    /// Cancels a job by its id; unknown ids are nothing to do.
    pub fn cancel(&self, id: &str) {
        let job = lock(&self.state).jobs.get(id).cloned();
        if let Some(job) = job {
            job.fail(Problem::new(Code::Cancelled, "The job was cancelled."));
            lock(&self.state).forget_queued(&job);
        }
    }

    /// True when another call would be queued.
    pub fn has_room(&self) -> bool {
        let state = lock(&self.state);
        !state.closing && (state.long.queue.len() as u64) < self.limits.queue
    }

    /// Takes no more long work.
    pub fn close(&self) {
        lock(&self.state).closing = true;
    }

    /// Ends everything under way and lets the workers go.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
        let jobs: Vec<_> = {
            let mut state = lock(&self.state);
            state.closing = true;
            state.long.queue.clear();
            state.short.queue.clear();
            state.jobs.values().cloned().collect()
        };
        for job in jobs {
            job.fail(Problem::new(Code::ShuttingDown, "The server is stopping.").retry_after(5));
        }
        self.arrived.notify_all();
    }

    /// Works on jobs of these lanes, the first one first, until the pool stops.
    fn work(&self, lanes: &[Lane]) {
        while let Some((job, work)) = self.take(lanes) {
            let began = Instant::now();
            metrics::work(job.kind.name(), "queue", job.ticket.elapsed().as_secs_f64());
            if let Some(work) = work.filter(|_| !job.is_over()) {
                // Work shares caches of plain values only, so they are usable after a panic.
                if catch_unwind(AssertUnwindSafe(work)).is_err() {
                    job.fail(Problem::internal(format!("a {} panicked", job.kind.noun())));
                }
            }
            self.finished(&job, began.elapsed());
        }
    }

    /// The next job to work on; `None` when the pool has stopped.
    fn take(&self, lanes: &[Lane]) -> Option<(Arc<Job>, Option<Work>)> {
        let mut state = lock(&self.state);
        loop {
            if self.stopped.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(job) = lanes.iter().find_map(|lane| state.lane(*lane).queue.pop_front()) {
                state.lane(job.kind.lane()).running += 1;
                state.show();
                let work = job.begin();
                return Some((job, work));
            }
            state = self.arrived.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn finished(&self, job: &Job, took: Duration) {
        metrics::work(job.kind.name(), "work", took.as_secs_f64());
        let mut state = lock(&self.state);
        state.jobs.remove(&job.ticket.id);
        let lane = state.lane(job.kind.lane());
        lane.running -= 1;
        lane.mean_s = 0.8 * lane.mean_s + 0.2 * took.as_secs_f64();
        state.show();
    }

    /// Ends jobs that take too long or whose reader has stopped reading.
    fn watch(&self) {
        let seconds = Duration::from_secs;
        while !self.stopped.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(100));
            let jobs: Vec<_> = lock(&self.state).jobs.values().cloned().collect();
            for job in jobs {
                let limit = if job.worked() > seconds(self.limits.generate_s) {
                    self.limits.generate_s
                } else if job.ticket.elapsed() > seconds(self.limits.stream_s) {
                    self.limits.stream_s
                } else if job.stalled() > seconds(self.limits.stalled_s) {
                    job.fail(Problem::new(Code::Cancelled, "The reader stopped reading."));
                    continue;
                } else {
                    continue;
                };
                let detail = format!("The {} took longer than {limit} s.", job.kind.noun());
                job.fail(Problem::new(Code::GenerateTimeout, detail).limit(limit));
                lock(&self.state).forget_queued(&job);
            }
        }
    }
}

/// A reader's hold on its job: dropping it before the end stops the work.
pub struct Handle {
    job: Arc<Job>,
    pool: Arc<Pool>,
}

impl Drop for Handle {
    fn drop(&mut self) {
        if !self.job.is_over() {
            self.job.fail(Problem::new(Code::Cancelled, "The connection was dropped."));
            lock(&self.pool.state).forget_queued(&self.job);
        }
    }
}
