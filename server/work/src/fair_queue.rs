//! A fair queue: of the waiting callers, the one served longest ago is next.

use std::collections::HashMap;

/// Number of remembered callers. A forgotten one counts as never served.
const MOST: usize = 1_024;

/// When each caller was last served.
#[derive(Debug, Default)]
pub struct FairQueue {
    served: HashMap<String, u64>,
    next: u64,
}

impl FairQueue {
    /// The turn in which a caller was last served; 0 for never.
    pub fn last_turn(&self, caller: &str) -> u64 {
        self.served.get(caller).copied().unwrap_or(0)
    }

    /// Notes that a caller is served now.
    pub fn serve(&mut self, caller: &str) {
        self.next += 1;
        if self.served.len() >= MOST && !self.served.contains_key(caller) {
            let kept = self.next.saturating_sub(MOST as u64 / 2);
            self.served.retain(|_, turn| *turn > kept);
        }
        self.served.insert(caller.to_owned(), self.next);
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
        assert!(queue.served.len() <= MOST && queue.last_turn("a") == 0);
    }
}
