//! Derived data of a map, computed once and shared by generation and placement.

use lru::LruCache;
use scene::Cancel;
use scene::geometry::Extent;
use scene::geometry::crowding::Crowding;
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{ContentHash, LaneMap, Shared};
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Number of maps kept; the least recently used one is dropped first.
const MOST: NonZeroUsize = NonZeroUsize::new(32).unwrap();
/// Limit of the bytes of all kept maps except the newest.
const MOST_BYTES: usize = 128 << 20;
/// Approximate bytes of memory per cell of a piece: points, arc lengths and headings of lanes, and pieces and
/// cells of two indexes.
const CELL_BYTES: usize = 300;

/// Derived data of a map.
pub(crate) struct KnownMap {
    /// Density of its lines.
    crowding: Crowding,
    /// Lanes with their links.
    pub(crate) graph: Arc<LaneGraph>,
    /// Where vehicles may drive.
    pub(crate) drivable: Arc<Drivable>,
    /// Rectangle around all its lines; `None` if it has none.
    pub(crate) extent: Option<Extent>,
}

impl KnownMap {
    fn bytes(&self) -> usize {
        CELL_BYTES * self.crowding.entries + self.drivable.kept_bytes()
    }

    fn of(map: &LaneMap, graph: LaneGraph) -> Self {
        let crowding = Crowding::of(map.outlines());
        let extent = Extent::about(map.outlines().flat_map(|(points, _)| points.iter().copied()));
        Self { crowding, drivable: graph.ground().clone(), graph: Arc::new(graph), extent }
    }
}

/// Pieces in one cell on crowded maps of streets.
const USUAL_CROWD: f64 = 200.0;
/// Time to process a map, per cell of a piece and per pair of pieces in a cell. Measured on one core of 2.6
/// GHz.
const CELL_NS: f64 = 1_500.0;
const PAIR_NS: f64 = 12.0;

/// Cost of work on a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCost {
    /// Approximate time to compute its lanes and ground; zero once they are cached.
    pub preparation: Duration,
    /// Time of a search at its densest place, relative to a map of streets; 1 or more.
    pub crowded: f64,
}

/// Approximate time for one thread to compute the lanes and the ground of a map that is not cached.
pub fn preparation(map: &LaneMap) -> Duration {
    preparation_of(&Crowding::of(map.outlines()))
}

fn preparation_of(crowding: &Crowding) -> Duration {
    let nanoseconds = CELL_NS * crowding.entries as f64 + PAIR_NS * crowding.pairs as f64;
    Duration::from_nanos(nanoseconds as u64)
}

/// A bounded cache of known maps. A map is addressed by its content, so nothing in it becomes stale.
pub struct Maps(Mutex<LruCache<ContentHash, Arc<KnownMap>>>);

impl Default for Maps {
    fn default() -> Self {
        Self(Mutex::new(LruCache::new(MOST)))
    }
}

impl Maps {
    /// The derived data of a map, computed on first use.
    pub(crate) fn known(&self, map: &Shared<LaneMap>) -> Arc<KnownMap> {
        let computed = self.known_unless(map, &Cancel::default());
        computed.unwrap_or_else(|| Arc::new(KnownMap::of(map, LaneGraph::default())))
    }

    /// As [`Self::known`]; `None` once the call is cancelled.
    pub(crate) fn known_unless(&self, map: &Shared<LaneMap>, cancel: &Cancel) -> Option<Arc<KnownMap>> {
        let hash = map.hash();
        if let Some(known) = self.cached().get(&hash) {
            return Some(known.clone());
        }
        // Computed outside the lock: other calls may continue on known maps.
        let graph = LaneGraph::unless(map, &|| cancel.is_cancelled())?;
        let known = Arc::new(KnownMap::of(map, graph));
        let mut cached = self.cached();
        cached.put(hash, known.clone());
        let bytes = |cached: &LruCache<_, Arc<KnownMap>>| {
            cached.iter().map(|(_, known)| known.bytes()).sum::<usize>()
        };
        while cached.len() > 1 && bytes(&cached) > MOST_BYTES {
            cached.pop_lru();
        }
        drop(cached);
        Some(known)
    }

    /// Cost of work on a map; its preparation is zero if the map is cached.
    pub fn cost(&self, map: &Shared<LaneMap>) -> MapCost {
        let known = self.cached().peek(&map.hash()).map(|known| known.crowding);
        let (crowding, preparation) = known.map_or_else(
            || {
                let crowding = Crowding::of(map.outlines());
                (crowding, preparation_of(&crowding))
            },
            |known| (known, Duration::ZERO),
        );
        MapCost { preparation, crowded: (crowding.most as f64 / USUAL_CROWD).max(1.0) }
    }

    /// Where vehicles may drive on a map.
    pub fn drivable(&self, map: &Shared<LaneMap>) -> Arc<Drivable> {
        self.known(map).drivable.clone()
    }

    /// Lanes of a map with their links.
    pub fn graph(&self, map: &Shared<LaneMap>) -> Arc<LaneGraph> {
        self.known(map).graph.clone()
    }

    /// Empties the cache: the next call on each map computes it again.
    pub fn forget(&self) {
        self.cached().clear();
    }

    /// Locks the cache. Its entries are always complete, so a panic elsewhere does not corrupt it.
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
    fn a_crowd_costs_the_same_beside_a_long_empty_road() {
        let crowd = || {
            (0..1_000).map(|i| Lane::street(i.to_string(), vec![Vec2::new(0.0, 0.0), Vec2::new(5.0, 1.0)]))
        };
        let road: Vec<Vec2> = (0..4_000).map(|i| Vec2::new(2.0 * f64::from(i), 100.0)).collect();
        let cost =
            |lanes: Vec<Lane>| Maps::default().cost(&LaneMap { lanes, ..LaneMap::default() }.into()).crowded;
        let with_roads = crowd().chain((0..8).map(|i| Lane::street(format!("road {i}"), road.clone())));
        assert_eq!((cost(crowd().collect()), cost(with_roads.collect())), (5.0, 5.0));
        assert_eq!(cost(vec![Lane::street("road", road)]), 1.0);
    }

    #[test]
    fn large_maps_are_few() {
        let maps = Maps::default();
        // Lanes of 4 km with a point every 2 m, side by side: a tenth of the cache's byte limit.
        let large = |seed: usize| -> Shared<LaneMap> {
            let line = |y: usize| {
                (0..2_000).map(|i| Vec2::new(2.0 * i as f64, (10 * y + seed) as f64)).collect::<Vec<_>>()
            };
            LaneMap {
                lanes: (0..20).map(|y| Lane::street(y.to_string(), line(y))).collect(),
                ..LaneMap::default()
            }
            .into()
        };
        let known = maps.known(&large(0)).bytes();
        assert!((8 << 20..20 << 20).contains(&known), "{known}");
        (1..14).for_each(|seed| drop(maps.known(&large(seed))));
        let kept = maps.cached().len();
        assert!(kept == MOST_BYTES / known, "{kept} maps of {known} bytes");
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
