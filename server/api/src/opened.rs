//! Open scenes, and data that is computed once for them.

use scene::Scene;
use scene::score::{BaselineScore, Drivable};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of step ranges for which a scene's scores are cached.
const SPANS: usize = 2;

/// An open scene, with its ETag.
#[derive(Clone)]
pub struct Opened {
    /// The scene, with its id.
    pub scene: Arc<Scene>,
    /// ETag, with quotes.
    pub etag: String,
    /// Scores of the unchanged scene.
    pub standings: Arc<Standings>,
}

impl Opened {
    /// An open scene without cached scores.
    pub fn new(scene: Scene, etag: String) -> Self {
        let scene = Arc::new(scene);
        Self { standings: Arc::new(Standings::new(Arc::clone(&scene))), scene, etag }
    }
}

/// Scores of an unchanged scene by range of steps, computed on first use.
pub struct Standings {
    scene: Arc<Scene>,
    known: Mutex<Vec<Arc<BaselineScore>>>,
}

impl Standings {
    /// The cache of a scene that stays open.
    pub fn new(scene: Arc<Scene>) -> Self {
        Self { scene, known: Mutex::default() }
    }

    /// The score over these steps.
    pub fn over(&self, steps: &Range<usize>, drivable: &Drivable) -> Arc<BaselineScore> {
        let find = |known: &[Arc<BaselineScore>]| known.iter().find(|s| s.steps() == *steps).cloned();
        let lock = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(standing) = find(&lock()) {
            return standing;
        }
        // Computed outside the lock: two callers may compute the same score, but neither waits for the other.
        let standing = Arc::new(BaselineScore::new(Arc::clone(&self.scene), drivable, steps.clone()));
        let mut known = lock();
        if find(&known).is_none() {
            known.insert(0, Arc::clone(&standing));
            known.truncate(SPANS);
        }
        standing
    }
}
