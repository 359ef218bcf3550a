//! Request rates by party: a token bucket, stored as the time at which it is full again (GCRA, ITU-T I.371).

use super::limits::Limits;
use super::party::Party;
use lru::LruCache;
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Number of remembered parties; the one silent longest is forgotten.
const PARTIES: NonZeroUsize = NonZeroUsize::new(8_192).unwrap();
/// Interval between audit entries about the refusals of one party.
const LOG_INTERVAL: Duration = Duration::from_secs(60);

/// Requests that each party may send.
#[derive(Debug)]
pub struct PartyRates {
    /// Average time between requests; `None` if the rate is unlimited.
    each: Option<Duration>,
    /// Time by which requests may be ahead of the average.
    ahead: Duration,
    parties: Mutex<LruCache<Party, PartyBucket>>,
}

#[derive(Clone, Copy, Debug)]
struct PartyBucket {
    /// When the bucket is full again.
    full_at: Instant,
    /// When a refusal was last logged.
    logged_at: Option<Instant>,
}

/// A request beyond the rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RateExceeded {
    /// Time after which one more is allowed.
    pub wait: Duration,
    /// Whether it is the first of its party within the log interval.
    pub is_logged: bool,
}

impl PartyRates {
    /// The rates of the limits; zero means unlimited.
    pub fn new(limits: &Limits) -> Self {
        let each = (limits.party_rate > 0).then(|| Duration::from_secs_f64(1.0 / limits.party_rate as f64));
        let burst = u32::try_from(limits.party_burst.saturating_sub(1)).unwrap_or(u32::MAX);
        let ahead = each.map_or(Duration::ZERO, |each| each.saturating_mul(burst));
        Self { each, ahead, parties: Mutex::new(LruCache::new(PARTIES)) }
    }

    /// Takes a token for a request at `now`.
    ///
    /// # Errors
    /// When there is none.
    pub fn take(&self, party: Party, now: Instant) -> Result<(), RateExceeded> {
        let Some(each) = self.each else { return Ok(()) };
        let mut parties = self.parties.lock().unwrap_or_else(PoisonError::into_inner);
        let bucket = parties.get_or_insert_mut(party, || PartyBucket { full_at: now, logged_at: None });
        let full_at = bucket.full_at.max(now);
        let wait = (full_at - now).saturating_sub(self.ahead);
        if wait.is_zero() {
            bucket.full_at = full_at + each;
            return Ok(());
        }
        let is_logged =
            bucket.logged_at.is_none_or(|last| now.saturating_duration_since(last) >= LOG_INTERVAL);
        if is_logged {
            bucket.logged_at = Some(now);
        }
        Err(RateExceeded { wait, is_logged })
    }
}

#[cfg(test)]
mod tests {
    use super::{PARTIES, PartyRates, RateExceeded};
    use crate::limits::Limits;
    use crate::party::Party;
    use std::time::{Duration, Instant};

    fn rates(party_rate: u64, party_burst: u64) -> PartyRates {
        PartyRates::new(&Limits { party_rate, party_burst, ..Limits::default() })
    }

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn a_burst_passes_and_then_the_rate() {
        let (rates, start) = (rates(10, 3), Instant::now());
        let at = |ms: u32| rates.take(Party::Local(1), start + ms * MS);
        assert!((0..3).all(|_| at(0).is_ok()));
        assert_eq!(at(0), Err(RateExceeded { wait: 100 * MS, is_logged: true }));
        assert_eq!(at(30), Err(RateExceeded { wait: 70 * MS, is_logged: false }));
        // The given wait suffices, and a refusal costs no token.
        assert_eq!((at(100), at(100).map_err(|refused| refused.wait)), (Ok(()), Err(100 * MS)));
        assert_eq!(rates.take(Party::Local(2), start), Ok(()), "another party has tokens of its own");
        // The bucket is full again.
        assert!((0..3).all(|_| at(2_000).is_ok()) && at(2_000).is_err());
        assert!((0..3).all(|_| at(70_000).is_ok()));
        assert!(at(70_000).is_err_and(|refused| refused.is_logged), "logged again after a minute");
    }

    #[test]
    fn no_rate_is_no_bound_and_a_burst_of_none_is_one() {
        let (unbounded, single, now) = (rates(0, 0), rates(1, 0), Instant::now());
        assert!((0..100).all(|_| unbounded.take(Party::Own, now).is_ok()));
        assert!(single.take(Party::Own, now).is_ok() && single.take(Party::Own, now).is_err());
    }

    #[test]
    fn many_parties_take_bounded_memory() {
        let (rates, now) = (rates(1, 1), Instant::now());
        let others = PARTIES.get() as u32;
        assert!((0..=others).all(|user| rates.take(Party::Local(user), now).is_ok()));
        assert_eq!(rates.parties.lock().unwrap().len(), PARTIES.get());
        assert!(rates.take(Party::Local(others), now).is_err());
        assert!(rates.take(Party::Local(0), now).is_ok(), "the longest silent one begins anew");
    }
}
