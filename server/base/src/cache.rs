//! A cache of values by key. When it is full, the party with the largest share drops its least recently used
//! value.

use super::memory::{Lender, Memory, MemoryShare};
use super::party::Party;
use lru::LruCache;
use std::collections::BTreeMap;
use std::fmt;
use std::hash::Hash;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A cache of values that are cheap to clone, limited by their total weight in bytes.
pub struct Cache<K: Hash + Eq, V> {
    inside: Mutex<CacheEntries<K, V>>,
    memory: Arc<Memory>,
}

struct CacheEntries<K: Hash + Eq, V> {
    values: LruCache<K, CacheEntry<V>>,
    weight: MemoryShare,
    /// Weight by the party that added the values.
    shares: BTreeMap<Party, usize>,
}

struct CacheEntry<V> {
    value: V,
    weight: usize,
    party: Party,
}

impl<K: Hash + Eq, V: Clone> Cache<K, V> {
    /// An empty cache whose values take at most this memory together.
    pub fn new(memory: Arc<Memory>) -> Self {
        let (values, weight) = (LruCache::unbounded(), memory.nothing());
        Self { inside: Mutex::new(CacheEntries { values, weight, shares: BTreeMap::new() }), memory }
    }

    fn lock(&self) -> MutexGuard<'_, CacheEntries<K, V>> {
        // A cache of complete values is usable after a panic elsewhere.
        self.inside.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The value of a key; this counts as a use.
    pub fn get(&self, key: &K) -> Option<V> {
        self.lock().values.get(key).map(|entry| entry.value.clone())
    }

    /// Stores a value for a party and replaces the key's older one. A value that would not fit even into an
    /// empty cache is not stored.
    pub fn put(&self, key: K, value: V, weight: usize, party: Party)
    where
        K: Clone,
    {
        let mut inside = self.lock();
        inside.forget(&key);
        if weight as u64 > self.memory.most() {
            return;
        }
        // The new value counts in the choice of the party that makes room.
        *inside.shares.entry(party).or_default() += weight;
        while !inside.weight.grow_within(weight) {
            if !inside.make_room() {
                inside.take_from_share(party, weight);
                return;
            }
        }
        inside.values.put(key, CacheEntry { value, weight, party });
    }

    /// Drops the value of a key.
    pub fn forget(&self, key: &K) {
        self.lock().forget(key);
    }
}

impl<K: Hash + Eq, V> CacheEntries<K, V> {
    fn forget(&mut self, key: &K) {
        if let Some(CacheEntry { weight, party, .. }) = self.values.pop(key) {
            self.weight.shrink(weight);
            self.take_from_share(party, weight);
        }
    }

    fn take_from_share(&mut self, party: Party, weight: usize) {
        if let Some(share) = self.shares.get_mut(&party) {
            *share -= weight;
        }
        self.shares.retain(|_, share| *share > 0);
    }

    /// Drops the least recently used value of the party with the largest share; false if there is none.
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

impl<K: Hash + Eq + Clone + Send, V: Clone + Send> Lender for Cache<K, V> {
    fn give_back(&self, bytes: usize) {
        let mut inside = self.lock();
        let least = inside.weight.bytes().saturating_sub(bytes);
        while inside.weight.bytes() > least && inside.make_room() {}
    }
}

impl<K: Hash + Eq, V> fmt::Debug for Cache<K, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cache")
    }
}

#[cfg(test)]
mod tests {
    use super::super::memory::Memory;
    use super::super::party::Party;
    use super::Cache;

    const OWN: Party = Party::Own;

    #[test]
    fn the_longest_unused_makes_room() {
        let cache = Cache::new(Memory::new(2));
        cache.put("a", 1, 1, OWN);
        cache.put("b", 2, 1, OWN);
        assert_eq!(cache.get(&"a"), Some(1));
        cache.put("c", 3, 1, OWN);
        assert_eq!((cache.get(&"a"), cache.get(&"b"), cache.get(&"c")), (Some(1), None, Some(3)));
    }

    #[test]
    fn what_is_heavy_takes_the_room_of_many() {
        let cache = Cache::new(Memory::new(10));
        (0..5).for_each(|key| cache.put(key, key, 2, OWN));
        cache.put(5, 5, 7, OWN);
        assert_eq!((0..6).filter(|key| cache.get(key).is_some()).collect::<Vec<_>>(), [4, 5]);
        // A newer value replaces the older one and its weight.
        cache.put(5, 6, 8, OWN);
        assert_eq!((cache.get(&4), cache.get(&5)), (Some(4), Some(6)));
        cache.put(4, 4, 11, OWN);
        assert_eq!((cache.get(&4), cache.get(&5)), (None, Some(6)), "too heavy to keep");
        cache.forget(&5);
        (0..5).for_each(|key| cache.put(key, key, 2, OWN));
        assert!((0..5).all(|key| cache.get(&key).is_some()));
    }

    #[test]
    fn a_short_budget_takes_from_the_cache() {
        let whole = Memory::new(10);
        let cache = std::sync::Arc::new(Cache::new(whole.part(8)));
        let lender: std::sync::Weak<Cache<i32, ()>> = std::sync::Arc::downgrade(&cache);
        whole.lend(lender);
        (0..4).for_each(|key| cache.put(key, (), 2, OWN));
        let held = whole.take(5).unwrap();
        assert_eq!((0..4).filter(|key| cache.get(key).is_some()).count(), 1);
        cache.put(9, (), 6, OWN);
        assert_eq!((cache.get(&9), whole.taken()), (None, 5), "what is not there cannot be kept");
        drop(held);
        cache.put(9, (), 6, OWN);
        assert_eq!((cache.get(&9), whole.taken()), (Some(()), 6));
    }

    #[test]
    fn who_brings_most_makes_room_for_the_others() {
        let party = |last: u8| Party::of(std::net::IpAddr::from([10, 0, 0, last]));
        let cache = Cache::new(Memory::new(10));
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
