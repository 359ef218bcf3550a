//! Parallel work on many items, with results in the order of the items and a limited number of waiting
//! results.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError, mpsc};

/// Results per worker that may wait for an earlier one.
const AHEAD: usize = 4;

/// Default number of workers: one per core.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, NonZeroUsize::get)
}

/// Number of taken results: workers do not run too far ahead of it.
#[derive(Default)]
struct Taken {
    count: Mutex<usize>,
    more: Condvar,
}

impl Taken {
    fn set(&self, count: usize) {
        *self.count.lock().unwrap_or_else(PoisonError::into_inner) = count;
        self.more.notify_all();
    }

    fn wait_for(&self, least: usize) {
        let count = self.count.lock().unwrap_or_else(PoisonError::into_inner);
        // The state under this lock is always consistent, so a panic elsewhere does not corrupt it.
        drop(self.more.wait_while(count, |count| *count < least));
    }
}

/// Releases all waiting workers if one panics.
struct Release<'a>(&'a Taken);

impl Drop for Release<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.set(usize::MAX);
        }
    }
}

/// Processes all items with this number of workers and passes the results to `take` in the order of the
/// items.
pub fn in_order<T: Sync, R: Send>(
    items: &[T],
    workers: usize,
    work: impl Fn(&T) -> R + Sync,
    mut take: impl FnMut(&T, R),
) {
    let workers = workers.clamp(1, items.len().max(1));
    if workers == 1 {
        return items.iter().for_each(|item| take(item, work(item)));
    }
    let (next, taken) = (AtomicUsize::new(0), Taken::default());
    let (sender, results) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..workers {
            let (sender, next, taken, work) = (sender.clone(), &next, &taken, &work);
            scope.spawn(move || {
                let _release = Release(taken);
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(i) else { break };
                    taken.wait_for((i + 1).saturating_sub(AHEAD * workers));
                    if sender.send((i, work(item))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut due = 0;
        for (i, result) in results {
            waiting.insert(i, result);
            while let (Some(result), Some(item)) = (waiting.remove(&due), items.get(due)) {
                take(item, result);
                due += 1;
                taken.set(due);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::in_order;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn results_come_in_order_and_few_wait() {
        let items: Vec<usize> = (0..200).collect();
        let (running, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let mut seen = Vec::new();
        let work = |item: &usize| {
            let ahead = running.fetch_add(1, Ordering::SeqCst) + 1;
            most.fetch_max(ahead, Ordering::SeqCst);
            // The first of every ten items is slow, so others overtake it.
            if item.is_multiple_of(10) {
                std::thread::sleep(std::time::Duration::from_millis(2));
            }
            item * 2
        };
        in_order(&items, 3, work, |item, result| {
            running.fetch_sub(1, Ordering::SeqCst);
            assert_eq!(result, item * 2);
            seen.push(*item);
        });
        assert_eq!(seen, items);
        assert!(most.load(Ordering::SeqCst) <= 4 * 3 + 3, "{most:?}");
        in_order(&[] as &[usize], 3, |_| (), |_, ()| panic!("there is nothing"));
    }
}
