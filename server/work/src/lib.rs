//! The pool for CPU work: fixed workers, bounded queues, latest wins, and every way to stop.
//!
//! There are four lanes with their own threads. Long work (big generations, large files) never delays smaller
//! calls, with or without a waiting caller. None of these delays reading and writing of documents, so a newer
//! revision is read, and a scene saved, while all workers are busy. Within a lane callers take turns. A long
//! call yields between its steps to smaller ones of others, and in turn to those of other parties. Threads
//! for long work, or work without a waiting caller, leave the cores to the others.
//!
//! A job ends exactly once, with what is first put into its [`Ending`]: its result, a newer revision, DELETE,
//! a dropped connection, a time limit, or shutdown. All but the result also set its [`Cancel`], which the
//! work checks between its steps.

mod call;
mod clients;
mod fair_queue;
mod job;
mod kind;
#[cfg(test)]
mod schedules;
mod state;
mod sync;

pub use call::{on_behalf_of, superseded};
pub use job::{Caller, Ending, JobRequest, Stop, Ticket, Work};
pub use kind::{JobKind, PoolLane};

use api::{Code, Problem};
use base::id;
use base::limits::Limits;
use base::metrics;
use base::party::Party;
use job::{CallerNames, Job, job_name};
use state::PoolState;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, PoisonError};
use std::time::{Duration, Instant};
use sync::atomic::{AtomicBool, Ordering};
use sync::{Condvar, Mutex, MutexGuard, thread};

/// Expected time of a document that a worker of interactive calls reads too: as much as the shortest calls take.
const BRIEF: Duration = Duration::from_millis(10);
/// Shortest time after which a refused call may be repeated, seconds.
const SOONEST_S: f64 = 0.01;

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Sets the niceness of the calling thread, and of threads that it starts, to that of a lane (nice(2)). Only
/// on Linux: elsewhere niceness applies to the whole process.
pub fn give_way(lane: PoolLane) {
    #[cfg(all(target_os = "linux", not(test)))]
    // If the system refuses, the thread keeps its priority.
    let _ = rustix::process::nice(lane.nice());
    #[cfg(not(all(target_os = "linux", not(test))))]
    let _ = lane.nice();
}

/// Shared by handlers and workers.
pub struct Pool {
    state: Mutex<PoolState>,
    /// One per lane: waking other threads in vain would take a core from the waker.
    arrived: [Condvar; PoolLane::ALL.len()],
    limits: Arc<Limits>,
    stopped: AtomicBool,
}

impl Pool {
    /// Starts the workers and the thread that watches time limits.
    ///
    /// # Errors
    /// When the system cannot start a thread.
    pub fn start(limits: &Arc<Limits>) -> io::Result<Arc<Self>> {
        let pool = Arc::new(Self {
            state: Mutex::new(PoolState::new(limits)),
            arrived: Default::default(),
            limits: Arc::clone(limits),
            stopped: AtomicBool::new(false),
        });
        for number in 0..limits.workers() {
            pool.spawn(format!("worker-{number}"), |pool| {
                give_way(PoolLane::Quick);
                pool.work(&[PoolLane::Quick, PoolLane::Document]);
            })?;
            for lane in [PoolLane::Patient, PoolLane::Background] {
                pool.spawn(format!("{}-{number}", lane.name()), move |pool| {
                    give_way(lane);
                    pool.work(&[lane]);
                })?;
            }
        }
        for number in 0..limits.readers() {
            pool.spawn(format!("reader-{number}"), |pool| pool.work(&[PoolLane::Document]))?;
        }
        pool.spawn("watch".into(), Self::watch)?;
        Ok(pool)
    }

    fn spawn(self: &Arc<Self>, name: String, run: impl FnOnce(&Self) + Send + 'static) -> io::Result<()> {
        let pool = Arc::clone(self);
        thread::Builder::new().name(name).spawn(move || run(&pool)).map(drop)
    }

    /// Queues a job. `make` returns the work and the receiver of its end.
    ///
    /// # Errors
    /// `shutting-down`, `exists`, `stale-revision` or `busy`; then nothing has changed, and the same revision
    /// may be tried again.
    pub fn submit<E: Ending + 'static>(
        self: &Arc<Self>,
        asked: JobRequest,
        make: impl FnOnce(&Arc<Ticket>) -> (Arc<E>, Work),
    ) -> Result<(Arc<E>, Handle), Problem> {
        let (lane, names) = (asked.lane(), asked.caller.names());
        let JobRequest { kind, cost, caller } = asked;
        let mut state = lock(&self.state);
        // During shutdown, documents of open calls are still read and written.
        let refused = state.closing && lane != PoolLane::Document;
        if refused || self.stopped.load(Ordering::Relaxed) {
            return Err(Problem::new(Code::ShuttingDown, "The server is shutting down.").retry_after(5));
        }
        let id = caller.job.unwrap_or_else(id::fresh);
        let name = job_name(&names.party, &id);
        if state.jobs.contains_key(&name) {
            return Err(Problem::new(Code::Exists, "A job with this id is under way."));
        }
        let now = Instant::now();
        let client = names.client.as_deref().zip(caller.client.as_ref().map(|(_, revision)| *revision));
        if let Some((client, revision)) = client {
            state.clients.check(client, revision, now).map_err(|highest| {
                let detail = format!("Revision {revision} is not above {highest}.");
                Problem::new(Code::StaleRevision, detail).with(|m| m.highest_revision = Some(highest))
            })?;
        }
        let gives_way = self.check_room(&mut state, lane, &names)?;
        if let Some(job) = gives_way {
            let busy = self.busy(&mut state, lane);
            job.fail(busy);
            state.forget_queued(&job);
        }
        if let Some((client, revision)) = client {
            state.clients.advance(client, revision, now);
            state.supersede(client, revision);
        }
        let before = state.lane(lane).queue.len() + state.running();
        let ticket = Arc::new(Ticket::new((id, name), caller.client, before));
        let (ending, work) = make(&ticket);
        let end = Arc::clone(&ending) as Arc<dyn Ending>;
        let job = Arc::new(Job::new(kind, lane, cost, names, ticket, end, work));
        state.arrived(&job);
        // A worker reads short documents too, if all readers are busy or already woken for others.
        let is_short = lane == PoolLane::Document && job.cost <= BRIEF;
        let reads = is_short && state.lane(lane).queue.len() > state.idle[lane as usize];
        let wakes = if reads { PoolLane::Quick } else { lane };
        drop(state);
        self.arrived[wakes as usize].notify_one();
        Ok((ending, Handle { job, pool: Arc::clone(self) }))
    }

    /// Checks for a place in the queue of a lane. In a full one the newest call of the greediest caller gives
    /// up its place, and is returned; if that is the new caller itself, it is refused.
    ///
    /// # Errors
    /// `busy`.
    fn check_room(
        &self,
        state: &mut PoolState,
        lane: PoolLane,
        names: &CallerNames,
    ) -> Result<Option<Arc<Job>>, Problem> {
        if (state.waiting_beside(lane, names.client.as_deref()) as u64) < self.limits.queue {
            return Ok(None);
        }
        state.gives_way(lane, names).map(Some).ok_or_else(|| self.busy(state, lane))
    }

    /// Refusal of a call for which a lane has no room.
    fn busy(&self, state: &mut PoolState, lane: PoolLane) -> Problem {
        let waiting = state.lane(lane).queue.len();
        let threads = if lane == PoolLane::Document { self.limits.readers() } else { self.limits.workers() };
        let wait_s = state.lane(lane).next_place_s(threads).clamp(SOONEST_S, 60.0);
        let detail = format!("{waiting} calls are waiting already.");
        Problem::new(Code::Busy, detail).retry_after_ms((1e3 * wait_s).ceil() as u64)
    }

    /// Refuses a call early if it would be refused later: the lane that a small call of this client waits for
    /// is full.
    ///
    /// # Errors
    /// `busy`.
    pub fn expects(&self, caller: &Caller) -> Result<(), Problem> {
        self.check_room(&mut lock(&self.state), PoolLane::Quick, &caller.names()).map(drop)
    }

    /// Cancels a job of a party by its id; an unknown id has no effect.
    pub fn cancel(&self, party: Party, id: &str) {
        let job = lock(&self.state).jobs.get(&job_name(party, id)).cloned();
        if let Some(job) = job {
            job.fail(Problem::new(Code::Cancelled, "The job was cancelled."));
            lock(&self.state).forget_queued(&job);
        }
    }

    /// Whether another call would be queued.
    pub fn has_room(&self) -> bool {
        let mut state = lock(&self.state);
        !state.closing && (state.lane(PoolLane::Quick).queue.len() as u64) < self.limits.queue
    }

    /// Stops taking long work.
    pub fn close(&self) {
        lock(&self.state).closing = true;
    }

    /// Ends all open jobs and lets the workers exit.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
        let jobs = lock(&self.state).close();
        for job in jobs {
            job.fail(Problem::new(Code::ShuttingDown, "The server is shutting down.").retry_after(5));
        }
        self.arrived.iter().for_each(Condvar::notify_all);
    }

    /// Runs jobs of these lanes, the first one preferred, until the pool stops.
    fn work(&self, lanes: &[PoolLane]) {
        while let Some(job) = self.take(lanes) {
            self.perform(&job);
        }
    }

    /// The next job to run; `None` when the pool has stopped.
    fn take(&self, lanes: &[PoolLane]) -> Option<Arc<Job>> {
        let mut state = lock(&self.state);
        // Interactive calls wait behind no long document.
        let reads = lanes.first() == Some(&PoolLane::Document);
        let fits = |job: &Job| job.lane != PoolLane::Document || reads || job.cost <= BRIEF;
        loop {
            if self.stopped.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(job) = lanes.iter().find_map(|lane| state.next(*lane, fits)) {
                return Some(job);
            }
            // Threads wait by the first of their lanes.
            let own = lanes.first().map_or(0, |lane| *lane as usize);
            state.idle[own] += 1;
            state = self.arrived[own].wait(state).unwrap_or_else(PoisonError::into_inner);
            state.idle[own] -= 1;
        }
    }

    /// Runs a job that was taken out of its queue.
    fn perform(&self, job: &Job) {
        let began = Instant::now();
        metrics::work(job.kind.name(), "queue", job.ticket.elapsed().as_secs_f64());
        if let Some(work) = job.begin().filter(|_| !job.is_over()) {
            // Work shares only caches of plain values, which are usable after a panic.
            if catch_unwind(AssertUnwindSafe(work)).is_err() {
                job.fail(Problem::internal(format!("a {} panicked", job.kind.noun())));
            }
        }
        metrics::work(job.kind.name(), "work", began.elapsed().as_secs_f64());
        let mut state = lock(&self.state);
        state.jobs.remove(&job.ticket.name);
        state.lane(job.lane).finished(job, job.worked());
        state.show();
    }

    /// Called between two steps of a long call: lets waiting jobs whose turn it is ([`Job::lets_go`]) run
    /// first.
    pub fn let_others_go(&self, ticket: &Ticket) {
        let Some(own) = lock(&self.state).jobs.get(&ticket.name).cloned() else { return };
        while own.lane == PoolLane::Patient && !self.stopped.load(Ordering::Relaxed) {
            let Some(job) = lock(&self.state).next(PoolLane::Patient, |job| own.lets_go(job)) else { break };
            job.go_inside();
            own.pause(|| self.perform(&job));
        }
    }

    /// Ends jobs that exceed their time limit or whose reader has stopped reading.
    fn watch(&self) {
        let seconds = Duration::from_secs;
        let mut rounds = 0u64;
        while !self.stopped.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(100));
            rounds += 1;
            if rounds.is_multiple_of(50) {
                // The allocator releases memory only during an allocation, so an idle server makes one here.
                drop(std::hint::black_box(Vec::<u8>::with_capacity(1 << 20)));
            }
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

/// A reader's handle of its job: dropping it before the end stops the work.
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
