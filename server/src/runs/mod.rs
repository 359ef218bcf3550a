//! Runs that clients step: in memory, limited in number, bytes and share per party, and dropped when idle.

mod follow;

pub use follow::Follower;

use crate::scenes::weight;
use api::runs::unknown_run;
use api::{Code, Problem, english};
use axum::body::Bytes;
use base::limits::Limits;
use base::memory::{Memory, MemoryShare};
use base::party::Party;
use base::places::{SharedPlaces, TakenPlace};
use experts::Run;
use scene::State;
use std::collections::BTreeMap;
use std::mem::size_of;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// Average limit of stored states per road user of a run: a plan of nine seconds and its extension.
const STATES: usize = 130;

/// The reply to the step with this number, as it was sent.
pub type LastStep = Option<(u64, Bytes)>;

/// A run with the reply to its last step.
pub struct HeldRun {
    /// The run.
    pub run: Run,
    /// Its last step, which followers wait for.
    pub last: watch::Sender<LastStep>,
}

/// A run that one request at a time uses exclusively.
pub type SharedRun = Arc<tokio::sync::Mutex<HeldRun>>;

struct RunEntry {
    run: SharedRun,
    /// Released with the run.
    _room: RunRoom,
    used: Instant,
}

/// Resources of a run.
struct RunRoom {
    _place: TakenPlace,
    _memory: MemoryShare,
}

/// All runs of the server by id.
pub struct RunStore {
    entries: Mutex<BTreeMap<String, RunEntry>>,
    places: Arc<SharedPlaces>,
    /// Places of clients that follow runs: each keeps a connection busy for as long as the run exists.
    followers: Arc<SharedPlaces>,
    limits: Arc<Limits>,
    memory: Arc<Memory>,
}

impl RunStore {
    /// An empty one.
    pub fn new(limits: &Arc<Limits>, memory: &Arc<Memory>) -> Self {
        let memory = memory.part(limits.run_bytes);
        let places = SharedPlaces::new(limits.runs as usize);
        let followers = SharedPlaces::new((limits.connections / 2).max(1) as usize);
        Self { entries: Mutex::default(), places, followers, limits: Arc::clone(limits), memory }
    }

    /// Refuses a run before any work if there would be no room for it afterwards.
    ///
    /// # Errors
    /// `too-many-runs`.
    pub fn expects(&self, party: Party) -> Result<(), Problem> {
        let mut entries = self.lock();
        self.drop_idle(&mut entries);
        self.room_for(&entries, party, 0).map(drop)
    }

    /// Stores a run that a party has begun.
    ///
    /// # Errors
    /// `too-many-runs`.
    pub fn add(&self, id: &str, run: Run, party: Party) -> Result<(), Problem> {
        let scene = run.scene();
        let bytes =
            weight::of_scene(scene) + run.bytes().max(STATES * size_of::<State>() * scene.agents.len());
        let mut entries = self.lock();
        self.drop_idle(&mut entries);
        let room = self.room_for(&entries, party, bytes)?;
        let run = Arc::new(tokio::sync::Mutex::new(HeldRun { run, last: watch::Sender::new(None) }));
        entries.insert(id.to_owned(), RunEntry { run, _room: room, used: Instant::now() });
        Ok(())
    }

    /// The run of an id; this counts as a use.
    ///
    /// # Errors
    /// `not-found`.
    pub fn get(&self, id: &str) -> Result<SharedRun, Problem> {
        let mut entries = self.lock();
        self.drop_idle(&mut entries);
        let entry = entries.get_mut(id).ok_or_else(unknown_run)?;
        entry.used = Instant::now();
        Ok(Arc::clone(&entry.run))
    }

    /// The run of an id, and the seconds since its last use; this does not count as a use.
    ///
    /// # Errors
    /// `not-found`.
    pub fn look(&self, id: &str) -> Result<(SharedRun, u64), Problem> {
        let mut entries = self.lock();
        self.drop_idle(&mut entries);
        let entry = entries.get(id).ok_or_else(unknown_run)?;
        Ok((Arc::clone(&entry.run), entry.used.elapsed().as_secs()))
    }

    /// A place for a client that follows a run.
    ///
    /// # Errors
    /// `busy` when half of all connections follow runs, or a quarter of this party alone.
    pub fn follow(&self, party: Party) -> Result<TakenPlace, Problem> {
        let full = |_| Problem::new(Code::Busy, "Too many clients follow runs.").retry_after(1);
        self.followers.take(party).map_err(full)
    }

    /// Memory for a run that is stored elsewhere, if it is free.
    pub fn room(&self, bytes: usize) -> Option<MemoryShare> {
        self.memory.take(bytes)
    }

    /// Drops a run.
    ///
    /// # Errors
    /// `not-found`.
    pub fn remove(&self, id: &str) -> Result<(), Problem> {
        self.lock().remove(id).map(drop).ok_or_else(unknown_run)
    }

    /// Drops all idle runs.
    pub fn tidy(&self) {
        self.drop_idle(&mut self.lock());
    }

    /// Seconds without a use after which a run is dropped.
    pub fn idle_s(&self) -> u64 {
        self.limits.run_idle_s
    }

    fn drop_idle(&self, entries: &mut BTreeMap<String, RunEntry>) {
        let idle = Duration::from_secs(self.limits.run_idle_s);
        // A run in use is held by its request.
        entries.retain(|_, entry| entry.used.elapsed() < idle || Arc::strong_count(&entry.run) > 1);
    }

    /// The resources of a run of this size, if they are free.
    fn room_for(
        &self,
        entries: &BTreeMap<String, RunEntry>,
        party: Party,
        bytes: usize,
    ) -> Result<RunRoom, Problem> {
        let limit = match self.places.take(party) {
            Ok(place) => match self.memory.take(bytes) {
                Some(memory) => return Ok(RunRoom { _place: place, _memory: memory }),
                None => self.limits.runs,
            },
            Err(full) => full.limit as u64,
        };
        let oldest = entries.values().map(|entry| entry.used.elapsed().as_secs()).max().unwrap_or(0);
        let wait_s = self.limits.run_idle_s.saturating_sub(oldest).clamp(1, 60);
        Err(Problem::of(Code::TooManyRuns, english::too_many_runs()).limit(limit).retry_after(wait_s))
    }

    /// A table of complete values is usable after a panic elsewhere.
    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, RunEntry>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::RunStore;
    use api::Code;
    use base::limits::Limits;
    use base::memory::Memory;
    use base::party::Party;
    use experts::{Cancel, Generator, Run, RunSettings};
    use scene::{LaneMap, Scene};
    use std::sync::Arc;

    #[test]
    fn runs_are_bounded_in_number_share_and_bytes_and_forgotten_when_idle() {
        let generator = Generator::random(1).unwrap();
        let scene = Arc::new(Scene::bare("empty", LaneMap::default(), Vec::new()));
        let run =
            || Run::new(scene.clone(), &[], RunSettings::default(), &generator, &Cancel::default()).unwrap();
        let whole = Memory::new(1 << 30);
        let store = |limits: Limits| RunStore::new(&Arc::new(limits), &whole);
        let party = |last: u8| Party::of(std::net::IpAddr::from([10, 0, 0, last]));
        let few = store(Limits { runs: 3, ..Limits::default() });
        let add = |store: &RunStore, id: &str, last: u8| {
            store.add(id, run(), party(last)).map_err(|problem| problem.members.limit)
        };
        assert_eq!((add(&few, "a", 1), add(&few, "b", 1)), (Ok(()), Ok(())));
        assert_eq!(add(&few, "c", 1), Err(Some(2)));
        assert_eq!(few.expects(party(1)).unwrap_err().code, Code::TooManyRuns);
        assert_eq!(add(&few, "c", 2), Ok(()));
        assert_eq!(add(&few, "d", 2), Err(Some(3)));
        assert!(few.expects(party(3)).unwrap_err().members.retry_after_s.is_some());
        few.remove("a").unwrap();
        assert_eq!(few.look("a").err().map(|problem| problem.code), Some(Code::NotFound));
        assert_eq!(few.get("a").err().map(|problem| problem.code), Some(Code::NotFound));
        assert_eq!(add(&few, "d", 2), Ok(()));
        let small = store(Limits { run_bytes: 10, ..Limits::default() });
        assert_eq!(add(&small, "a", 1), Err(Some(64)));
        let held = whole.take((whole.most() - whole.taken()) as usize).unwrap();
        assert_eq!(add(&store(Limits::default()), "a", 1), Err(Some(64)), "no memory is left");
        drop(held);
        let brief = store(Limits { run_idle_s: 0, ..Limits::default() });
        add(&brief, "a", 1).unwrap();
        brief.tidy();
        assert!(brief.get("a").is_err());
    }
}
