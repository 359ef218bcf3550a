//! A fair queue: of the waiting callers, the one served longest ago is next.

use std::collections::HashMap;

/// Number of remembered callers.
const MOST: usize = 1_024;
/// Difference between the turns of two services: a new caller has a turn between them.
const STEP: u64 = 2;

/// When each caller was last served.
#[derive(Debug, Default)]
pub struct FairQueue {
    turns: HashMap<String, u64>,
    next: u64,
}

impl FairQueue {
    /// The turn in which a caller was last served; 0 for one that is not remembered.
    pub fn last_turn(&self, caller: &str) -> u64 {
        self.turns.get(caller).copied().unwrap_or(0)
    }

    /// Notes that a caller waits. A new one goes before the caller that was served last, but not before those
    /// that wait longer: otherwise new names in succession would keep all others waiting.
    pub fn wait(&mut self, caller: &str) {
        if !self.turns.contains_key(caller) {
            self.set(caller, self.next.saturating_sub(STEP / 2));
        }
    }

    /// Notes that a caller is served now.
    pub fn serve(&mut self, caller: &str) {
        self.next += STEP;
        self.set(caller, self.next);
    }

    fn set(&mut self, caller: &str, turn: u64) {
        if self.turns.len() >= MOST && !self.turns.contains_key(caller) {
            let kept = self.next.saturating_sub(STEP * MOST as u64 / 2);
            self.turns.retain(|_, turn| *turn > kept);
            // So many are new since then that no order among them is worth keeping.
            if self.turns.len() >= MOST {
                self.turns.clear();
            }
        }
        self.turns.insert(caller.to_owned(), turn);
    }
}

#[cfg(test)]
mod tests {
    use super::{FairQueue, MOST};

    #[test]
    fn who_was_served_longest_ago_is_next() {
        let mut queue = FairQueue::default();
        queue.serve("a");
        queue.serve("b");
        queue.serve("a");
        assert!(queue.last_turn("new") < queue.last_turn("b") && queue.last_turn("b") < queue.last_turn("a"));
        for i in 0..3 * MOST {
            queue.serve(&format!("caller-{i}"));
        }
        assert!(queue.turns.len() <= MOST && queue.last_turn("a") == 0);
    }

    #[test]
    fn new_callers_in_succession_keep_nobody_waiting() {
        let mut queue = FairQueue::default();
        queue.serve("first");
        queue.serve("busy");
        queue.wait("new");
        assert!(queue.last_turn("first") < queue.last_turn("new"), "it waits longer");
        assert!(queue.last_turn("new") < queue.last_turn("busy"), "it was served last");
        for i in 0..3 * MOST {
            queue.wait(&format!("caller-{i}"));
            assert!(queue.turns.len() <= MOST);
        }
        queue.serve("other");
        queue.wait("newer");
        assert!(queue.last_turn("busy") < queue.last_turn("newer"));
    }
}
