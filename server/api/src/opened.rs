//! Scenes that are open, and what is worked out about them once.

use scene::Scene;
use scene::score::{BaselineScore, Drivable};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

/// Spans of steps that a scene's standing score is kept for.
const SPANS: usize = 2;

/// A scene that is open, with its ETag.
#[derive(Clone)]
pub struct Opened {
    /// The scene, with its id.
    pub scene: Arc<Scene>,
    /// With quotes.
    pub etag: String,
    /// What it comes to as it stands.
    pub standings: Arc<Standings>,
}

impl Opened {
    /// A scene of which nothing is worked out yet.
    pub fn new(scene: Scene, etag: String) -> Self {
        let scene = Arc::new(scene);
        Self { standings: Arc::new(Standings::new(Arc::clone(&scene))), scene, etag }
    }
}

/// Scores of an unchanged scene by the number of scored steps; computed at the first use.
pub struct Standings {
    scene: Arc<Scene>,
    known: Mutex<Vec<Arc<BaselineScore>>>,
}

impl Standings {
    /// Of a scene that stays open.
    pub fn new(scene: Arc<Scene>) -> Self {
        Self { scene, known: Mutex::default() }
    }

    /// The one over these steps.
    pub fn over(&self, steps: &Range<usize>, drivable: &Drivable) -> Arc<BaselineScore> {
        let find = |known: &[Arc<BaselineScore>]| known.iter().find(|s| s.steps() == *steps).cloned();
        let lock = || self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(standing) = find(&lock()) {
            return standing;
        }
        // Not under the lock: two callers may compute the same, but neither waits for the other.
        let standing = Arc::new(BaselineScore::new(Arc::clone(&self.scene), drivable, steps.clone()));
        let mut known = lock();
        if find(&known).is_none() {
            known.insert(0, Arc::clone(&standing));
            known.truncate(SPANS);
        }
        standing
    }
}
