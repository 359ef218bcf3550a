//! One memory budget for bodies, WebSockets, imports, exports, replies, runs and caches. Requests that do not
//! fit are refused, so that the system does not kill the process.

use api::{Code, Problem};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Memory of the program itself: code, weights, threads, the store's cache, and the work of the pool.
/// Measured: 92 MB at rest, 190 MB with calls of the largest kinds.
pub const OWN_BYTES: u64 = 256 << 20;

/// The refusal of a request that does not fit.
pub fn full() -> Problem {
    Problem::new(Code::Busy, "Other requests fill the memory.").retry_after(1)
}

/// A cache of values that can be recomputed, such as open scenes; it makes room for data that cannot.
pub trait Lender: Send + Sync {
    /// Drops values of at least this many bytes in total, or all.
    fn give_back(&self, bytes: usize);
}

/// A memory budget, or a part of one for one purpose.
pub struct Memory {
    most: usize,
    taken: AtomicUsize,
    /// The budget of which this is a part.
    above: Option<Arc<Self>>,
    lenders: Mutex<Vec<Weak<dyn Lender>>>,
}

impl Memory {
    /// A budget of this size, bytes.
    pub fn new(most: u64) -> Arc<Self> {
        Self::below(most, None)
    }

    /// A part of this budget with its own limit, bytes.
    pub fn part(self: &Arc<Self>, most: u64) -> Arc<Self> {
        Self::below(most, Some(Arc::clone(self)))
    }

    fn below(most: u64, above: Option<Arc<Self>>) -> Arc<Self> {
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        Arc::new(Self { most, taken: AtomicUsize::new(0), above, lenders: Mutex::default() })
    }

    /// Most bytes that can be taken if nothing else is taken.
    pub fn most(&self) -> u64 {
        let above = self.above.as_ref().map_or(u64::MAX, |above| above.most());
        above.min(self.most as u64)
    }

    /// Bytes that are taken.
    pub fn taken(&self) -> u64 {
        self.taken.load(Ordering::Relaxed) as u64
    }

    /// Registers a cache that makes room when memory is short.
    pub fn lend(&self, lender: Weak<dyn Lender>) {
        self.lenders.lock().unwrap_or_else(PoisonError::into_inner).push(lender);
    }

    /// Takes bytes; `None` if they are not free, even after caches have made room.
    pub fn take(self: &Arc<Self>, bytes: usize) -> Option<MemoryShare> {
        let mut share = self.nothing();
        share.grow(bytes).then_some(share)
    }

    /// A share of zero bytes.
    pub fn nothing(self: &Arc<Self>) -> MemoryShare {
        MemoryShare { memory: Arc::clone(self), bytes: 0 }
    }

    fn try_take(&self, bytes: usize) -> bool {
        let more = |taken: usize| taken.checked_add(bytes).filter(|sum| *sum <= self.most);
        if self.taken.fetch_update(Ordering::Relaxed, Ordering::Relaxed, more).is_err() {
            return false;
        }
        let fits = self.above.as_ref().is_none_or(|above| above.try_take(bytes));
        if !fits {
            self.taken.fetch_sub(bytes, Ordering::Relaxed);
        }
        fits
    }

    fn give(&self, bytes: usize) {
        self.taken.fetch_sub(bytes, Ordering::Relaxed);
        if let Some(above) = &self.above {
            above.give(bytes);
        }
    }

    /// Asks caches to make room, here and in the budget above.
    fn ask_back(&self, bytes: usize) {
        let lenders: Vec<_> = self
            .lenders
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .iter()
            .filter_map(Weak::upgrade)
            .collect();
        lenders.iter().for_each(|lender| lender.give_back(bytes));
        if let Some(above) = &self.above {
            above.ask_back(bytes);
        }
    }
}

impl std::fmt::Debug for Memory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Memory({} of {})", self.taken(), self.most)
    }
}

/// Bytes that are held until this is dropped.
#[derive(Debug)]
pub struct MemoryShare {
    memory: Arc<Memory>,
    bytes: usize,
}

impl MemoryShare {
    /// Number of bytes.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Takes more bytes, after caches have made room if needed; false if they are not free.
    pub fn grow(&mut self, bytes: usize) -> bool {
        if self.grow_within(bytes) {
            return true;
        }
        self.memory.ask_back(bytes);
        self.grow_within(bytes)
    }

    /// The same for a cache, which makes room itself.
    pub fn grow_within(&mut self, bytes: usize) -> bool {
        let fits = self.memory.try_take(bytes);
        self.bytes += if fits { bytes } else { 0 };
        fits
    }

    /// Returns some of the bytes.
    pub fn shrink(&mut self, bytes: usize) {
        let bytes = bytes.min(self.bytes);
        self.bytes -= bytes;
        self.memory.give(bytes);
    }
}

impl Drop for MemoryShare {
    fn drop(&mut self) {
        self.shrink(self.bytes);
    }
}

#[cfg(test)]
mod tests {
    use super::{Lender, Memory, MemoryShare};
    use std::sync::{Arc, Mutex, Weak};

    #[test]
    fn parts_take_from_the_whole_and_give_back() {
        let whole = Memory::new(100);
        let (bodies, runs) = (whole.part(80), whole.part(80));
        let held = bodies.take(70).unwrap();
        assert!(bodies.take(11).is_none() && runs.take(31).is_none());
        let mut other = runs.take(30).unwrap();
        assert_eq!((whole.taken(), bodies.taken(), runs.taken()), (100, 70, 30));
        assert!(!other.grow(1) && runs.take(usize::MAX).is_none());
        other.shrink(20);
        assert_eq!((other.bytes(), whole.taken()), (10, 80));
        drop(held);
        assert!(other.grow(70) && !other.grow(1), "a part has its own bound");
        drop(other);
        assert_eq!((whole.taken(), bodies.taken(), runs.taken(), bodies.most()), (0, 0, 0, 80));
    }

    struct KeptShares(Mutex<Vec<MemoryShare>>);

    impl Lender for KeptShares {
        fn give_back(&self, _: usize) {
            self.0.lock().unwrap().pop();
        }
    }

    #[test]
    fn what_can_be_had_again_makes_room() {
        let whole = Memory::new(100);
        let kept = Arc::new(KeptShares(Mutex::new(vec![whole.take(40).unwrap(), whole.take(40).unwrap()])));
        let lender: Weak<KeptShares> = Arc::downgrade(&kept);
        whole.lend(lender);
        let held = whole.part(90).take(50).unwrap();
        assert_eq!((kept.0.lock().unwrap().len(), whole.taken()), (1, 90));
        assert!(whole.take(90).is_none() && kept.0.lock().unwrap().is_empty());
        drop(held);
        assert_eq!(whole.taken(), 0);
    }
}
