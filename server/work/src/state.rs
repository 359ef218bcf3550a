//! State of the pool: waiting jobs by lane, running jobs, and turns.

use super::clients::Clients;
use super::fair_queue::FairQueue;
use super::job::{CallerNames, Job, Stop};
use super::kind::PoolLane;
use base::limits::Limits;
use base::metrics;
use std::collections::{BTreeMap, HashMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

/// Jobs of one lane.
#[derive(Default)]
pub struct LaneQueue {
    /// Waiting jobs, in the order of their arrival.
    pub queue: VecDeque<Arc<Job>>,
    /// Number of running jobs.
    pub running: usize,
    /// Running mean of the actual time of jobs per expected second.
    pace: Option<f64>,
    /// Number of refused jobs so far.
    refused: usize,
}

impl LaneQueue {
    /// Expected wait of a new job for one of these threads, seconds.
    fn wait_s(&self, threads: usize) -> f64 {
        let waiting: f64 = self.queue.iter().map(|job| job.cost.as_secs_f64()).sum();
        waiting * self.pace.unwrap_or(1.0) / threads.max(1) as f64
    }

    /// When a refused caller gets a place, seconds. The first caller gets the time at which the first job
    /// leaves the queue, the next caller that of the second job, and so on, cyclically. Callers who obey then
    /// come as places get free, not all at once.
    pub fn next_place_s(&mut self, threads: usize) -> f64 {
        let places = self.queue.len().max(1);
        let turn = self.refused % places + 1;
        self.refused += 1;
        self.wait_s(threads) * turn as f64 / places as f64
    }

    /// Records the end of a job.
    pub fn finished(&mut self, job: &Job, took: Duration) {
        self.running -= 1;
        let pace = took.as_secs_f64() / job.cost.as_secs_f64().max(1e-3);
        self.pace = Some(self.pace.map_or(pace, |mean| 0.8 * mean + 0.2 * pace));
    }
}

/// The most frequent name, and its count.
fn most<'a>(names: impl Iterator<Item = &'a String>) -> Option<(&'a String, usize)> {
    let mut counts: BTreeMap<&String, usize> = BTreeMap::new();
    names.for_each(|name| *counts.entry(name).or_default() += 1);
    counts.into_iter().max_by_key(|(_, count)| *count)
}

/// All lanes and jobs.
pub struct PoolState {
    lanes: [LaneQueue; PoolLane::ALL.len()],
    /// Waiting and running jobs, by name.
    pub jobs: HashMap<String, Arc<Job>>,
    /// Revisions of clients.
    pub clients: Clients,
    fair_queue: FairQueue,
    /// Number of waiting threads, by the first lane that they take.
    pub idle: [usize; PoolLane::ALL.len()],
    /// No more calls are accepted.
    pub closing: bool,
}

impl PoolState {
    /// An empty pool.
    pub fn new(limits: &Limits) -> Self {
        let idle = Duration::from_secs(limits.client_idle_s);
        Self {
            lanes: Default::default(),
            jobs: HashMap::new(),
            clients: Clients::new(limits.clients as usize, idle),
            fair_queue: FairQueue::default(),
            idle: [0; PoolLane::ALL.len()],
            closing: false,
        }
    }

    /// Jobs of a lane.
    pub fn lane(&mut self, lane: PoolLane) -> &mut LaneQueue {
        &mut self.lanes[lane as usize]
    }

    /// Number of running jobs.
    pub fn running(&self) -> usize {
        self.lanes.iter().map(|lane| lane.running).sum()
    }

    /// Number of threads of a lane that still run jobs which were stopped longer ago than `patience`.
    pub fn hanging(&self, lane: PoolLane, patience: Duration) -> usize {
        self.jobs.values().filter(|job| job.lane == lane && job.hangs(patience)).count()
    }

    /// Number of waiting jobs in a lane, without those of this client, which a newer revision would end.
    pub fn waiting_beside(&mut self, lane: PoolLane, client: Option<&str>) -> usize {
        let own = |job: &&Arc<Job>| client.is_some() && job.client() == client;
        let queue = &self.lane(lane).queue;
        queue.len() - queue.iter().filter(own).count()
    }

    /// The job that gives up its place in a full queue: the newest one of the party with the most waiting
    /// jobs, and within it of the caller with the most. `None` if that is the new caller itself, whose job
    /// would be the newest.
    pub fn gives_way(&mut self, lane: PoolLane, new: &CallerNames) -> Option<Arc<Job>> {
        let queue = &self.lane(lane).queue;
        let (greediest, count) = most(queue.iter().map(|job| &job.caller.party))?;
        let own = queue.iter().filter(|job| job.caller.party == new.party).count();
        // The new job would make its party the greediest; then the shares within it decide.
        let party = if count > own + 1 { greediest } else { &new.party };
        let of_party = || queue.iter().filter(|job| job.caller.party == *party);
        let (share, count) = most(of_party().map(|job| &job.caller.share))?;
        let own = of_party().filter(|job| job.caller.share == new.share).count();
        if *party == new.party && count <= own + 1 {
            return None;
        }
        of_party().rfind(|job| job.caller.share == *share).cloned()
    }

    /// Adds a waiting job.
    pub fn arrived(&mut self, job: &Arc<Job>) {
        job.caller.turns().into_iter().for_each(|name| self.fair_queue.wait(name));
        self.lane(job.lane).queue.push_back(Arc::clone(job));
        self.jobs.insert(job.ticket.name.clone(), Arc::clone(job));
        self.show();
    }

    /// Takes a job out of a lane's queue: of those that satisfy `fits`, the one whose caller was served
    /// longest ago.
    pub fn next(&mut self, lane: PoolLane, fits: impl Fn(&Job) -> bool) -> Option<Arc<Job>> {
        let of_lane = self.lanes[lane as usize].queue.iter().enumerate();
        let fitting = of_lane.filter(|(_, job)| fits(job));
        let turns = |job: &Job| job.caller.turns().map(|name| self.fair_queue.last_turn(name));
        let (at, _) = fitting.min_by_key(|(_, job)| turns(job))?;
        let job = self.lane(lane).queue.remove(at)?;
        // A caller may be its whole share, and that its whole party.
        let mut names = job.caller.turns().to_vec();
        names.dedup();
        names.into_iter().for_each(|name| self.fair_queue.serve(name));
        self.lane(lane).running += 1;
        self.show();
        Some(job)
    }

    /// Ends the running and queued jobs of this client.
    pub fn supersede(&mut self, client: &str, revision: u64) {
        let of_client = |job: &&Arc<Job>| job.client() == Some(client);
        let older: Vec<_> = self.jobs.values().filter(of_client).cloned().collect();
        for job in older {
            job.stop(Stop::Superseded(revision));
            self.forget_queued(&job);
        }
    }

    /// Removes a job that has ended from its queue, if it still waits there.
    pub fn forget_queued(&mut self, job: &Arc<Job>) {
        let queue = &mut self.lane(job.lane).queue;
        let before = queue.len();
        queue.retain(|queued| !Arc::ptr_eq(queued, job));
        if queue.len() < before {
            self.jobs.remove(&job.ticket.name);
        }
        self.show();
    }

    /// Empties all queues and returns all jobs.
    pub fn close(&mut self) -> Vec<Arc<Job>> {
        self.closing = true;
        self.lanes.iter_mut().for_each(|lane| lane.queue.clear());
        self.jobs.values().cloned().collect()
    }

    /// Updates the metrics.
    pub fn show(&self) {
        for (lane, traffic) in PoolLane::ALL.iter().zip(&self.lanes) {
            metrics::load(lane.name(), traffic.queue.len(), traffic.running);
        }
    }
}
