//! Derived data of a map, computed once and shared by generation and placement.

use lru::LruCache;
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{ContentHash, LaneMap, Shared};
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Maps kept, the least recently used one goes first.
const MOST: NonZeroUsize = NonZeroUsize::new(32).unwrap();

/// Derived data of a map.
pub(crate) struct KnownMap {
    /// Lanes with their links.
    pub(crate) graph: Arc<LaneGraph>,
    /// Where vehicles may drive.
    pub(crate) drivable: Arc<Drivable>,
}

/// Known maps, a bounded number of them. A map's content never changes, so nothing is ever out of date.
pub struct Maps(Mutex<LruCache<ContentHash, Arc<KnownMap>>>);

impl Default for Maps {
    fn default() -> Self {
        Self(Mutex::new(LruCache::new(MOST)))
    }
}

impl Maps {
    /// The derived data of a map, computed on first use.
    pub(crate) fn known(&self, map: &Shared<LaneMap>) -> Arc<KnownMap> {
        let hash = map.hash();
        if let Some(known) = self.cached().get(&hash) {
            return known.clone();
        }
        // Not under the lock: others may go on with maps that are known.
        let graph = Arc::new(LaneGraph::new(map));
        let known = Arc::new(KnownMap { drivable: graph.ground().clone(), graph });
        self.cached().put(hash, known.clone());
        known
    }

    /// Where vehicles may drive on a map.
    pub fn drivable(&self, map: &Shared<LaneMap>) -> Arc<Drivable> {
        self.known(map).drivable.clone()
    }

    /// Lanes of a map with their links.
    pub fn graph(&self, map: &Shared<LaneMap>) -> Arc<LaneGraph> {
        self.known(map).graph.clone()
    }

    /// Forgets all: the next call on each map works it out again.
    pub fn forget(&self) {
        self.cached().clear();
    }

    /// Nothing in the cache is ever half done, so a panic elsewhere does not spoil it.
    fn cached(&self) -> MutexGuard<'_, LruCache<ContentHash, Arc<KnownMap>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;
    use scene::map::Lane;

    fn street(length: usize) -> Shared<LaneMap> {
        let points: Vec<Vec2> = (0..=length).map(|i| Vec2::new(i as f64, 0.0)).collect();
        LaneMap { lanes: vec![Lane::street("a", points)], ..LaneMap::default() }.into()
    }

    #[test]
    fn a_map_is_worked_out_once_by_its_content() {
        let maps = Maps::default();
        let known = maps.known(&street(50));
        let again = street(50);
        assert!(Arc::ptr_eq(&known, &maps.known(&again)), "equal content");
        assert!(!Arc::ptr_eq(&known, &maps.known(&street(60))));
        maps.forget();
        assert!(!Arc::ptr_eq(&known, &maps.known(&again)));
    }

    #[test]
    fn a_bounded_number_is_kept_and_what_is_used_stays() {
        let maps = Maps::default();
        let (used, unused) = (street(2), street(3));
        let (first, second) = (maps.known(&used), maps.known(&unused));
        for length in 4..3 + MOST.get() {
            maps.known(&street(length));
            assert!(Arc::ptr_eq(&first, &maps.known(&used)));
        }
        maps.known(&street(1_000));
        assert!(!Arc::ptr_eq(&second, &maps.known(&street(3))));
    }
}
