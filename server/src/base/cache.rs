//! Values kept in memory by key. Where they are too many, the party with most of them drops the one that it has not
//! used for longest.

use super::party::Party;
use lru::LruCache;
use std::collections::BTreeMap;
use std::fmt;
use std::hash::Hash;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A cache of values that are cheap to clone, bounded by what they weigh together.
pub struct Cache<K: Hash + Eq, V> {
    inside: Mutex<CacheEntries<K, V>>,
    most: usize,
}

struct CacheEntries<K: Hash + Eq, V> {
    values: LruCache<K, CacheEntry<V>>,
    weight: usize,
    /// Part of the weight, by the party that brought it.
    shares: BTreeMap<Party, usize>,
}

struct CacheEntry<V> {
    value: V,
    weight: usize,
    party: Party,
}

impl<K: Hash + Eq, V: Clone> Cache<K, V> {
    /// An empty cache with values of total weight `most` at most.
    pub fn new(most: usize) -> Self {
        let inside = CacheEntries { values: LruCache::unbounded(), weight: 0, shares: BTreeMap::new() };
        Self { inside: Mutex::new(inside), most }
    }

    fn lock(&self) -> MutexGuard<'_, CacheEntries<K, V>> {
        // A cache of whole values is usable after a panic elsewhere.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The value of a key, which counts as a use.
    pub fn get(&self, key: &K) -> Option<V> {
        self.lock().values.get(key).map(|entry| entry.value.clone())
    }

    /// Keeps a value that a party brought, in place of the key's older one; not one that is heavier than all may be
    /// together.
    pub fn put(&self, key: K, value: V, weight: usize, party: Party)
    where
        K: Clone,
    {
        let mut inside = self.lock();
        inside.forget(&key);
        if weight > self.most {
            return;
        }
        inside.weight += weight;
        *inside.shares.entry(party).or_default() += weight;
        inside.values.put(key, CacheEntry { value, weight, party });
        while inside.weight > self.most && inside.make_room() {}
    }

    /// Drops the value of a key.
    pub fn forget(&self, key: &K) {
        self.lock().forget(key);
    }
}

impl<K: Hash + Eq, V> CacheEntries<K, V> {
    fn forget(&mut self, key: &K) {
        if let Some(CacheEntry { weight, party, .. }) = self.values.pop(key) {
            self.weight -= weight;
            if let Some(share) = self.shares.get_mut(&party) {
                *share -= weight;
            }
            self.shares.retain(|_, share| *share > 0);
        }
    }

    /// Drops the longest unused value of the party with the largest share; false where there is none.
    fn make_room(&mut self) -> bool
    where
        K: Clone,
    {
        let Some((&party, _)) = self.shares.iter().max_by_key(|(_, share)| **share) else { return false };
        let oldest = self.values.iter().rev().find(|(_, entry)| entry.party == party);
        let Some(key) = oldest.map(|(key, _)| key.clone()) else { return false };
        self.forget(&key);
        true
    }
}

impl<K: Hash + Eq, V> fmt::Debug for Cache<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cache")
    }
}

#[cfg(test)]
mod tests {
    use super::super::party::Party;
    use super::Cache;

    const OWN: Party = Party::Own;

    #[test]
    fn the_longest_unused_makes_room() {
        let cache = Cache::new(2);
        cache.put("a", 1, 1, OWN);
        cache.put("b", 2, 1, OWN);
        assert_eq!(cache.get(&"a"), Some(1));
        cache.put("c", 3, 1, OWN);
        assert_eq!((cache.get(&"a"), cache.get(&"b"), cache.get(&"c")), (Some(1), None, Some(3)));
    }

    #[test]
    fn what_is_heavy_takes_the_room_of_many() {
        let cache = Cache::new(10);
        (0..5).for_each(|key| cache.put(key, key, 2, OWN));
        cache.put(5, 5, 7, OWN);
        assert_eq!((0..6).filter(|key| cache.get(key).is_some()).collect::<Vec<_>>(), [4, 5]);
        // A newer value takes the place of the older one, and its weight.
        cache.put(5, 6, 8, OWN);
        assert_eq!((cache.get(&4), cache.get(&5)), (Some(4), Some(6)));
        cache.put(4, 4, 11, OWN);
        assert_eq!((cache.get(&4), cache.get(&5)), (None, Some(6)), "too heavy to keep");
        cache.forget(&5);
        (0..5).for_each(|key| cache.put(key, key, 2, OWN));
        assert!((0..5).all(|key| cache.get(&key).is_some()));
    }

    #[test]
    fn who_brings_most_makes_room_for_the_others() {
        let party = |last: u8| Party::of(std::net::IpAddr::from([10, 0, 0, last]));
        let cache = Cache::new(10);
        cache.put(100, (), 3, party(1));
        (0..8).for_each(|key| cache.put(key, (), 2, party(2)));
        let kept =
            |keys: std::ops::Range<i32>| keys.filter(|key| cache.get(key).is_some()).collect::<Vec<_>>();
        assert_eq!((kept(0..8), kept(100..101)), (vec![5, 6, 7], vec![100]));
        cache.forget(&100);
        cache.put(8, (), 4, party(2));
        assert_eq!(kept(0..9), [5, 6, 7, 8], "alone it has all the room");
    }
}
