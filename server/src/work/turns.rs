//! Whose turn it is: of all who wait, the one served longest ago.

use std::collections::HashMap;

/// Parties remembered. Whoever is forgotten counts as never served.
const MOST: usize = 1_024;

/// When each party was last served.
#[derive(Debug, Default)]
pub struct Turns {
    served: HashMap<String, u64>,
    next: u64,
}

impl Turns {
    /// The turn it was last served in; 0 for never.
    pub fn last(&self, party: &str) -> u64 {
        self.served.get(party).copied().unwrap_or(0)
    }

    /// It is served now.
    pub fn serve(&mut self, party: &str) {
        self.next += 1;
        if self.served.len() >= MOST && !self.served.contains_key(party) {
            let kept = self.next.saturating_sub(MOST as u64 / 2);
            self.served.retain(|_, turn| *turn > kept);
        }
        self.served.insert(party.to_owned(), self.next);
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, Turns};

    #[test]
    fn who_was_served_longest_ago_is_next() {
        let mut turns = Turns::default();
        turns.serve("a");
        turns.serve("b");
        turns.serve("a");
        assert!(turns.last("new") < turns.last("b") && turns.last("b") < turns.last("a"));
        for i in 0..3 * MOST {
            turns.serve(&format!("caller-{i}"));
        }
        assert!(turns.served.len() <= MOST && turns.last("a") == 0);
    }
}
