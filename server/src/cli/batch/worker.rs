//! Processes one unit: from its number to its row, and to the line of its result if it is kept.

use super::folder::BatchFolder;
use super::record::BatchRecord;
use crate::cli::Failure;
use crate::cli::generate::created_at;
use api::Operations;
use api::generate::GenerationAnswer;
use base::clock;
use batch::engine::{UnitEnd, UnitEngine};
use batch::row::{BatchRow, KeptCase, UnitOutcome};
use batch::unit::BatchUnit;
use experts::Cancel;
use lru::LruCache;
use scene::Scene;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Number of scenes in memory: the units of one scene are consecutive.
const SCENES: NonZeroUsize = NonZeroUsize::new(8).unwrap();

/// A scene that the first thread that needs it reads.
type Slot = Arc<OnceLock<Result<Arc<Scene>, Failure>>>;

/// The output of a unit.
pub struct UnitLines {
    /// Its row.
    pub row: BatchRow,
    /// The lines of its result, if it is kept.
    pub lines: Option<CaseLines>,
}

/// The lines of a kept result.
pub struct CaseLines {
    /// Its reference.
    pub case: String,
    /// Its motion, for pictures; empty if no road user is visible.
    pub motion: String,
}

/// A regenerated result.
pub struct RemadeResult {
    /// The scene with its futures.
    pub scene: Scene,
    /// Result code, six characters.
    pub code: String,
}

/// What units need.
pub struct UnitWorker<'a> {
    folder: &'a BatchFolder,
    record: &'a BatchRecord,
    engine: UnitEngine<'a>,
    scenes: Mutex<LruCache<usize, Slot>>,
    /// Time in the engine, microseconds, summed over threads.
    engine_us: AtomicU64,
}

impl<'a> UnitWorker<'a> {
    /// A worker for the units of a folder.
    pub fn new(folder: &'a BatchFolder, record: &'a BatchRecord, operations: &'a Operations) -> Self {
        let scenes = Mutex::new(LruCache::new(SCENES));
        let engine = UnitEngine::new(&record.plan, &record.scenes, operations);
        Self { folder, record, engine, scenes, engine_us: AtomicU64::new(0) }
    }

    /// Time in the engine, summed over threads.
    pub fn engine_time(&self) -> Duration {
        Duration::from_micros(self.engine_us.load(Ordering::Relaxed))
    }

    /// Processes a unit.
    ///
    /// # Errors
    /// Exit 3 when the folder lacks the scene. All other errors become a row.
    pub fn end(&self, unit: &BatchUnit) -> Result<UnitLines, Failure> {
        let missing = || Failure::input(format!("{}: no unit {}", self.folder.shown(), unit.id.hex()));
        let row = self.engine.row(unit).ok_or_else(missing)?;
        if !self.engine.has_work(unit) {
            return Ok(UnitLines { row, lines: None });
        }
        let scene = self.scene(unit.scene)?;
        let began = clock::monotonic();
        let answered = self.engine.answer(unit, &scene, &Cancel::default());
        let spent = clock::monotonic().saturating_sub(began).as_micros();
        self.engine_us.fetch_add(spent as u64, Ordering::Relaxed);
        let UnitEnd { row, conditions, motion } = self.engine.end(row, answered);
        let lines = (row.outcome == UnitOutcome::Kept).then(|| CaseLines {
            case: KeptCase::of(&row, conditions).line(),
            motion: motion.map_or_else(String::new, |motion| motion.line()),
        });
        Ok(UnitLines { row, lines })
    }

    /// Regenerates the result of a unit; `None` if it has none.
    ///
    /// # Errors
    /// Exit 3 when the folder lacks the scene.
    pub fn result(&self, unit: &BatchUnit) -> Result<Option<RemadeResult>, Failure> {
        if !self.engine.has_work(unit) {
            return Ok(None);
        }
        let scene = self.scene(unit.scene)?;
        let answered = self.engine.answer(unit, &scene, &Cancel::default()).ok().flatten();
        Ok(answered.map(|answered| {
            let GenerationAnswer { scene, samples, head, code, .. } = answered.answer;
            let generated = Some(head.generated(created_at(), samples));
            RemadeResult { scene: Scene { generated, ..(*scene).clone() }, code }
        }))
    }

    /// A scene of the catalogue, read once for all units that need it now.
    fn scene(&self, index: usize) -> Result<Arc<Scene>, Failure> {
        let slot = {
            let mut scenes = self.scenes.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(scenes.get_or_insert(index, Slot::default))
        };
        let missing = || Failure::input(format!("{}: no scene {index}", self.folder.shown()));
        let read = || {
            let entry = self.record.scenes.get(index).ok_or_else(missing)?;
            self.folder.read_scene(entry).map(Arc::new)
        };
        slot.get_or_init(read).clone()
    }
}
