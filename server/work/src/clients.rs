//! Latest wins: the highest revision that each client has sent.

use std::collections::HashMap;
use std::time::{Duration, Instant};

/// Bounded table of clients; the one unseen longest is dropped first.
#[derive(Debug)]
pub struct Clients {
    most: usize,
    idle: Duration,
    seen: HashMap<String, Seen>,
}

#[derive(Debug)]
struct Seen {
    revision: u64,
    at: Instant,
}

impl Clients {
    /// An empty table.
    pub fn new(most: usize, idle: Duration) -> Self {
        Self { most: most.max(1), idle, seen: HashMap::new() }
    }

    /// Checks that a revision is newer than all earlier ones.
    ///
    /// # Errors
    /// The highest revision so far, if this one is not higher.
    pub fn check(&self, client: &str, revision: u64, now: Instant) -> Result<(), u64> {
        let remembered = |seen: &&Seen| now.duration_since(seen.at) <= self.idle;
        match self.seen.get(client).filter(remembered) {
            Some(seen) if revision <= seen.revision => Err(seen.revision),
            _ => Ok(()),
        }
    }

    /// Records a newer revision.
    pub fn advance(&mut self, client: &str, revision: u64, now: Instant) {
        let idle = self.idle;
        if let Some(seen) = self.seen.get_mut(client) {
            *seen = Seen { revision, at: now };
            return;
        }
        if self.seen.len() >= self.most {
            self.seen.retain(|_, seen| now.duration_since(seen.at) <= idle);
        }
        if self.seen.len() >= self.most {
            let oldest = self.seen.iter().min_by_key(|(_, seen)| seen.at).map(|(name, _)| name.clone());
            oldest.map(|name| self.seen.remove(&name));
        }
        self.seen.insert(client.to_owned(), Seen { revision, at: now });
    }
}

#[cfg(test)]
mod tests {
    use super::Clients;
    use std::time::{Duration, Instant};

    #[test]
    fn revisions_must_rise_until_forgotten() {
        let start = Instant::now();
        let mut clients = Clients::new(2, Duration::from_secs(10));
        let mut advance = |client: &str, revision, at| -> Result<(), u64> {
            clients.check(client, revision, at)?;
            clients.advance(client, revision, at);
            Ok(())
        };
        assert_eq!(advance("a", 5, start), Ok(()));
        assert_eq!(advance("a", 5, start), Err(5));
        assert_eq!(advance("a", 6, start), Ok(()));
        assert_eq!(advance("b", 1, start + Duration::from_secs(1)), Ok(()));
        assert_eq!(advance("c", 1, start + Duration::from_secs(2)), Ok(()));
        assert_eq!(advance("a", 1, start + Duration::from_secs(3)), Ok(()), "forgotten for room");
        assert_eq!(advance("a", 1, start + Duration::from_secs(14)), Ok(()), "forgotten by time");
    }
}
