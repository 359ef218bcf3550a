//! Values kept in memory by key, the longest unused dropped first.

use lru::LruCache;
use std::fmt;
use std::hash::Hash;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A cache of values that are cheap to clone, bounded by what they weigh together.
pub struct Cache<K: Hash + Eq, V> {
    inside: Mutex<CacheEntries<K, V>>,
    most: usize,
}

struct CacheEntries<K: Hash + Eq, V> {
    values: LruCache<K, (V, usize)>,
    weight: usize,
}

impl<K: Hash + Eq, V: Clone> Cache<K, V> {
    /// An empty cache with values of total weight `most` at most.
    pub fn new(most: usize) -> Self {
        Self { inside: Mutex::new(CacheEntries { values: LruCache::unbounded(), weight: 0 }), most }
    }

    fn lock(&self) -> MutexGuard<'_, CacheEntries<K, V>> {
        // A cache of whole values is usable after a panic elsewhere.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The value of a key, which counts as a use.
    pub fn get(&self, key: &K) -> Option<V> {
        self.lock().values.get(key).map(|(value, _)| value.clone())
    }

    /// Keeps a value, in place of the key's older one; not one that is heavier than all may be together.
    pub fn put(&self, key: K, value: V, weight: usize) {
        let mut inside = self.lock();
        inside.forget(&key);
        if weight > self.most {
            return;
        }
        inside.weight += weight;
        inside.values.put(key, (value, weight));
        while inside.weight > self.most {
            let Some((_, (_, weight))) = inside.values.pop_lru() else { break };
            inside.weight -= weight;
        }
    }

    /// Drops the value of a key.
    pub fn forget(&self, key: &K) {
        self.lock().forget(key);
    }
}

impl<K: Hash + Eq, V> CacheEntries<K, V> {
    fn forget(&mut self, key: &K) {
        if let Some((_, weight)) = self.values.pop(key) {
            self.weight -= weight;
        }
    }
}

impl<K: Hash + Eq, V> fmt::Debug for Cache<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cache")
    }
}

#[cfg(test)]
mod tests {
    use super::Cache;

    #[test]
    fn the_longest_unused_makes_room() {
        let cache = Cache::new(2);
        cache.put("a", 1, 1);
        cache.put("b", 2, 1);
        assert_eq!(cache.get(&"a"), Some(1));
        cache.put("c", 3, 1);
        assert_eq!((cache.get(&"a"), cache.get(&"b"), cache.get(&"c")), (Some(1), None, Some(3)));
    }

    #[test]
    fn what_is_heavy_takes_the_room_of_many() {
        let cache = Cache::new(10);
        (0..5).for_each(|key| cache.put(key, key, 2));
        cache.put(5, 5, 7);
        assert_eq!((0..6).filter(|key| cache.get(key).is_some()).collect::<Vec<_>>(), [4, 5]);
        // A newer value takes the place of the older one, and its weight.
        cache.put(5, 6, 8);
        assert_eq!((cache.get(&4), cache.get(&5)), (Some(4), Some(6)));
        cache.put(4, 4, 11);
        assert_eq!((cache.get(&4), cache.get(&5)), (None, Some(6)), "too heavy to keep");
        cache.forget(&5);
        (0..5).for_each(|key| cache.put(key, key, 2));
        assert!((0..5).all(|key| cache.get(&key).is_some()));
    }
}
