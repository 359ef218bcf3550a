//! What the random draws of a seed are for.

use scene::random::{Key, Stream};

/// What a stream of draws decides. Streams of one seed are independent, so that a change in one part
/// leaves the draws of the others as they were.
#[derive(Clone, Copy, Debug)]
pub enum Purpose {
    /// Roads and junctions.
    Network = 1,
    /// Who drives where and when.
    Demand = 2,
    /// Parked cars.
    Parking = 3,
    /// Wander and ripple of tracks.
    Motion = 4,
    /// Choice of windows.
    Windows = 5,
    /// Manoeuvres that SUMO does not know.
    Scripted = 6,
    /// What the map leaves out.
    Map = 7,
    /// People who stand.
    Standing = 8,
}

impl Purpose {
    /// The stream of a seed for this.
    pub fn stream(self, seed: u64) -> Stream {
        Key::default().number(seed).number(self as u64).stream()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_repeat_and_differ() {
        let first = |seed, purpose: Purpose| purpose.stream(seed).unit();
        assert_eq!(first(7, Purpose::Network), first(7, Purpose::Network));
        assert_ne!(first(7, Purpose::Network), first(7, Purpose::Demand));
        assert_ne!(first(7, Purpose::Network), first(8, Purpose::Network));
    }
}
