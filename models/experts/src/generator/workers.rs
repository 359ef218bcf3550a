//! Parallel work over a few threads, with results in the order of the items.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// A fixed number of threads that belong to one generator, started on first use.
pub(super) struct WorkerPool {
    threads: usize,
    /// `None` if threads cannot be started: the caller's thread does the work then, and the answer is the
    /// same.
    pool: OnceLock<Option<ThreadPool>>,
}

impl WorkerPool {
    /// A pool of this many threads, at least one.
    pub(super) fn new(threads: usize) -> Self {
        Self { threads: threads.max(1), pool: OnceLock::new() }
    }

    /// A pool with as many threads as the machine runs at a time.
    pub(super) fn of_machine() -> Self {
        Self::new(std::thread::available_parallelism().map_or(1, usize::from))
    }

    /// Number of threads.
    pub(super) fn threads(&self) -> usize {
        self.threads
    }

    /// Applies `f` to each item. With one thread or one item, the caller's thread does all the work.
    pub(super) fn map<T: Sync, R: Send>(&self, items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
        self.map_many(2, items, f)
    }

    /// The same for small work: fewer than `many` items are processed by the caller, because handing them over takes
    /// longer.
    pub(super) fn map_many<T: Sync, R: Send>(
        &self,
        many: usize,
        items: &[T],
        f: impl Fn(&T) -> R + Sync + Send,
    ) -> Vec<R> {
        match self.pool() {
            Some(pool) if items.len() >= many && !is_in_another(pool) => shared(pool, self.threads, items, f),
            _ => items.iter().map(f).collect(),
        }
    }

    fn pool(&self) -> Option<&ThreadPool> {
        let start = || {
            let named = ThreadPoolBuilder::new().thread_name(|i| format!("generator-{i}"));
            named.num_threads(self.threads).build().ok()
        };
        if self.threads > 1 { self.pool.get_or_init(start).as_ref() } else { None }
    }
}

/// Applies `f` to each item on the caller's thread and on threads of the pool. The caller begins at once: a sleeping
/// thread wakes about 50 microseconds later, the duration of a small item.
fn shared<T: Sync, R: Send>(
    pool: &ThreadPool,
    threads: usize,
    items: &[T],
    f: impl Fn(&T) -> R + Sync + Send,
) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let results: Vec<Mutex<Option<R>>> = items.iter().map(|_| Mutex::new(None)).collect();
    let work = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(i) else { return };
            let result = f(item);
            *results[i].lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        }
    };
    pool.in_place_scope(|scope| {
        for _ in 1..threads.min(items.len()) {
            scope.spawn(|_| work());
        }
        work();
    });
    let result = |slot: Mutex<Option<R>>| slot.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.into_iter().filter_map(result).collect()
}

/// Whether the caller's thread belongs to another pool. While it waits for this pool it would start more work
/// of its own pool, nested until its stack overflows. Its own pool already occupies the cores.
fn is_in_another(pool: &ThreadPool) -> bool {
    rayon::current_thread_index().is_some() && pool.current_thread_index().is_none()
}

#[cfg(test)]
mod tests {
    use super::WorkerPool;
    use rayon::prelude::*;
    use std::thread::ThreadId;

    #[test]
    fn order_is_kept() {
        let items: Vec<usize> = (0..17).collect();
        for threads in [1, 2, 5, 40] {
            let doubled = WorkerPool::new(threads).map(&items, |i| i * 2);
            assert_eq!(doubled, items.iter().map(|i| i * 2).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_thread_of_another_pool_does_its_work_itself() {
        let (ours, id) = (WorkerPool::new(2), |_: &usize| std::thread::current().id());
        let of_caller = |_: usize| {
            let own = std::thread::current().id();
            ours.map(&[0; 4], id).iter().all(|other: &ThreadId| *other == own)
        };
        let foreign = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        assert!(foreign.install(|| (0..50).into_par_iter().map(of_caller).all(|is| is)));
        // Nested work in the same pool is still split: no thread waits for itself.
        assert_eq!(ours.map(&[2, 3], |n| ours.map(&vec![1; *n], |i| i * 2).len()), [2, 3]);
    }

    #[test]
    fn the_caller_works_beside_threads_with_a_name_and_none_starts_for_one() {
        let name = |_: &usize| {
            std::thread::sleep(std::time::Duration::from_millis(20));
            std::thread::current().name().map(str::to_owned)
        };
        let names = WorkerPool::new(2).map(&[0; 8], name);
        let own = std::thread::current().name().map(str::to_owned);
        let is_named = |n: &Option<String>| n.as_ref().is_some_and(|n| n.starts_with("generator-"));
        assert!(names.iter().all(|n| *n == own || is_named(n)), "{names:?}");
        assert!(names.contains(&own) && names.iter().any(is_named), "{names:?}");
        assert_eq!(WorkerPool::new(1).map(&[0; 2], name), [own.clone(), own]);
    }
}
