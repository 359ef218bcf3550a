//! What is worked out about a map once: shared by those who generate and those who place.

use lru::LruCache;
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{ContentHash, LaneMap};
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

/// Maps kept, the least recently used one goes first.
const MOST: NonZeroUsize = NonZeroUsize::new(32).unwrap();

/// What is worked out about a map once.
pub(crate) struct KnownMap {
    /// Lanes with their links.
    pub(crate) graph: Arc<LaneGraph>,
    /// Where vehicles may drive.
    pub(crate) drivable: Arc<Drivable>,
}

/// Known maps, a bounded number of them. A map's content never changes, so nothing is ever out of date.
pub struct Maps {
    cached: Mutex<Cached>,
}

/// By content hash, and by the very map that was handed in, which saves the hashing.
struct Cached {
    by_hash: LruCache<ContentHash, Arc<KnownMap>>,
    /// By address. The weak handle keeps an address from being given to another map while it is here.
    by_handle: LruCache<usize, (Weak<LaneMap>, Arc<KnownMap>)>,
}

impl Default for Maps {
    fn default() -> Self {
        let (by_hash, by_handle) = (LruCache::new(MOST), LruCache::new(MOST));
        Self { cached: Mutex::new(Cached { by_hash, by_handle }) }
    }
}

impl Maps {
    /// What is known about a map, worked out where it is new.
    pub(crate) fn known(&self, map: &Arc<LaneMap>) -> Arc<KnownMap> {
        if let Some(known) = self.cached().by_handle(map) {
            return known;
        }
        let hash = map.hash();
        if let Some(known) = self.cached().by_hash(hash, map) {
            return known;
        }
        // Not under the lock: others may go on with maps that are known.
        let graph = Arc::new(LaneGraph::new(map));
        let known = Arc::new(KnownMap { drivable: graph.ground().clone(), graph });
        self.cached().insert(hash, map, known.clone());
        known
    }

    /// Forgets all: the next call on each map works it out again.
    pub fn forget(&self) {
        let mut cached = self.cached();
        cached.by_hash.clear();
        cached.by_handle.clear();
    }

    /// Nothing in the cache is ever half done, so a panic elsewhere does not spoil it.
    fn cached(&self) -> MutexGuard<'_, Cached> {
        self.cached.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Cached {
    fn by_handle(&mut self, map: &Arc<LaneMap>) -> Option<Arc<KnownMap>> {
        let (weak, known) = self.by_handle.get(&address(map))?;
        weak.upgrade().is_some_and(|m| Arc::ptr_eq(&m, map)).then(|| known.clone())
    }

    fn by_hash(&mut self, hash: ContentHash, map: &Arc<LaneMap>) -> Option<Arc<KnownMap>> {
        let known = self.by_hash.get(&hash)?.clone();
        self.by_handle.put(address(map), (Arc::downgrade(map), known.clone()));
        Some(known)
    }

    fn insert(&mut self, hash: ContentHash, map: &Arc<LaneMap>, known: Arc<KnownMap>) {
        self.by_handle.put(address(map), (Arc::downgrade(map), known.clone()));
        self.by_hash.put(hash, known);
    }
}

fn address(map: &Arc<LaneMap>) -> usize {
    Arc::as_ptr(map).addr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;
    use scene::map::Lane;

    fn street(length: usize) -> Arc<LaneMap> {
        let points: Vec<Vec2> = (0..=length).map(|i| Vec2::new(i as f64, 0.0)).collect();
        Arc::new(LaneMap { lanes: vec![Lane::street("a", points)], ..LaneMap::default() })
    }

    #[test]
    fn a_map_is_worked_out_once_by_handle_and_by_content() {
        let maps = Maps::default();
        let known = maps.known(&street(50));
        let again = street(50);
        assert!(Arc::ptr_eq(&known, &maps.known(&again)), "equal content");
        assert!(Arc::ptr_eq(&known, &maps.known(&again)), "the same handle");
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
