//! Ids that must be integers, each used once.

use std::collections::HashSet;

/// Numbers of all elements of a file.
pub(crate) struct Numbers {
    own: HashSet<i64>,
    used: HashSet<i64>,
    next: i64,
    /// Whether an id got a number other than its own.
    pub renumbered: bool,
}

impl Numbers {
    /// Reserves the numbers of these ids; free numbers start after the largest.
    pub fn of<'a>(ids: impl Iterator<Item = &'a String>) -> Self {
        let own: HashSet<i64> = ids.filter_map(|id| number(id)).collect();
        let next = own.iter().max().map_or(1, |most| most + 1);
        Self { own, used: HashSet::new(), next, renumbered: false }
    }

    /// The id's own number if it is unused, otherwise a free one.
    pub fn take(&mut self, id: &str) -> i64 {
        match number(id).filter(|number| self.used.insert(*number)) {
            Some(number) => number,
            None => {
                self.renumbered = true;
                self.free()
            }
        }
    }

    /// A number for an element without one.
    pub fn free(&mut self) -> i64 {
        while self.own.contains(&self.next) {
            self.next += 1;
        }
        self.next += 1;
        self.next - 1
    }
}

/// The positive integer that an id is.
fn number(id: &str) -> Option<i64> {
    id.parse().ok().filter(|n: &i64| (1..1 << 48).contains(n) && n.to_string() == id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_number_is_used_once() {
        let ids = ["7", "a", "7", "-1", "007", "8"].map(str::to_owned);
        let mut numbers = Numbers::of(ids.iter());
        let taken: Vec<i64> = ids.iter().map(|id| numbers.take(id)).collect();
        assert_eq!(taken, [7, 9, 10, 11, 12, 8]);
        assert!(numbers.renumbered && numbers.free() == 13);
    }
}
