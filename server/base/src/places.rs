//! A limited number of places, of which one party gets at most half.

use super::party::Party;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Expected time for which a place is held, before any has been returned.
const FIRST_GUESS_S: f64 = 1.0;

/// A number of places that parties take and return.
#[derive(Debug)]
pub struct SharedPlaces {
    most: usize,
    state: Mutex<PlacesState>,
}

#[derive(Debug)]
struct PlacesState {
    /// Number of places held by each party.
    taken: BTreeMap<Party, usize>,
    /// Running mean of the time for which a place is held, seconds.
    taken_s: f64,
    /// Number of refusals so far.
    refused: usize,
}

/// Why a party gets no place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacesFull {
    /// The exhausted limit: that of one party, or of all.
    pub limit: usize,
    /// Whether the party itself is at its limit.
    pub is_own: bool,
    /// Estimated time until a place is free; refused callers get successive times.
    pub wait: Duration,
}

impl SharedPlaces {
    /// This number of places.
    pub fn new(most: usize) -> Arc<Self> {
        let state = PlacesState { taken: BTreeMap::new(), taken_s: FIRST_GUESS_S, refused: 0 };
        Arc::new(Self { most, state: Mutex::new(state) })
    }

    /// Takes a place for a party.
    ///
    /// # Errors
    /// When all are taken, or half of them by this party.
    pub fn take(self: &Arc<Self>, party: Party) -> Result<TakenPlace, PlacesFull> {
        let share = self.most.div_ceil(2);
        let mut state = self.lock();
        let own = state.taken.get(&party).copied().unwrap_or_default();
        let is_own = own > 0 && own >= share;
        if is_own || state.taken.values().sum::<usize>() >= self.most {
            let limit = if is_own { share } else { self.most };
            let turn = state.refused % limit.max(1) + 1;
            state.refused += 1;
            let wait = Duration::from_secs_f64(state.taken_s * turn as f64 / limit.max(1) as f64);
            return Err(PlacesFull { limit, is_own, wait });
        }
        state.taken.insert(party, own + 1);
        Ok(TakenPlace { party, since: Instant::now(), places: Arc::clone(self) })
    }

    /// Counts are usable after a panic elsewhere.
    fn lock(&self) -> MutexGuard<'_, PlacesState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A place that is held until this is dropped.
#[derive(Debug)]
pub struct TakenPlace {
    party: Party,
    since: Instant,
    places: Arc<SharedPlaces>,
}

impl Drop for TakenPlace {
    fn drop(&mut self) {
        let mut state = self.places.lock();
        state.taken_s = 0.8 * state.taken_s + 0.2 * self.since.elapsed().as_secs_f64();
        if let Some(own) = state.taken.get_mut(&self.party) {
            *own -= 1;
        }
        state.taken.retain(|_, own| *own > 0);
    }
}

#[cfg(test)]
mod tests {
    use super::SharedPlaces;
    use crate::party::Party;
    use std::net::IpAddr;

    #[test]
    fn a_party_has_at_most_half_and_all_have_at_most_all() {
        let party = |last: u8| Party::of(IpAddr::from([10, 0, 0, last]));
        let places = SharedPlaces::new(3);
        let first = [places.take(party(1)).unwrap(), places.take(party(1)).unwrap()];
        let full = |last| places.take(party(last)).map_err(|full| (full.limit, full.is_own)).map(drop);
        assert_eq!(full(1), Err((2, true)));
        let other = places.take(party(2)).unwrap();
        assert_eq!((full(2), full(3)), (Err((3, false)), Err((3, false))));
        drop(first);
        assert_eq!((full(1), full(3)), (Ok(()), Ok(())));
        drop(other);
        assert_eq!(SharedPlaces::new(0).take(party(1)).map_err(|full| full.is_own).map(drop), Err(false));
    }

    #[test]
    fn refused_callers_are_told_moments_that_follow_the_time_for_which_places_are_taken() {
        let places = SharedPlaces::new(2);
        (0..40).for_each(|_| drop(places.take(Party::Own)));
        let held = [Party::Own, Party::Local(1)].map(|party| places.take(party).unwrap());
        let wait_ms = || places.take(Party::Local(2)).unwrap_err().wait.as_secs_f64() * 1e3;
        let [first, second, third] = [wait_ms(), wait_ms(), wait_ms()];
        assert!(second < 100.0, "places were given back at once, yet {second} ms");
        assert!(
            (second - 2.0 * first).abs() < 1e-3 && (third - first).abs() < 1e-3,
            "{first} {second} {third}"
        );
        drop(held);
    }
}
