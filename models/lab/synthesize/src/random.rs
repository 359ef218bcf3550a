//! Purposes of a seed's random draws.

use scene::random::{Key, Stream};

/// Purpose of a stream of draws. Streams of one seed are independent, so a change in one part leaves the
/// draws of the others unchanged.
#[derive(Clone, Copy, Debug)]
pub enum Purpose {
    /// Roads and junctions.
    Network = 1,
    /// Traffic demand.
    Demand = 2,
    /// Parked cars.
    Parking = 3,
    /// Lateral deviation and speed ripple of tracks.
    Motion = 4,
    /// Choice of windows.
    Windows = 5,
    /// Manoeuvres that SUMO lacks.
    Scripted = 6,
    /// Omissions of the map.
    Map = 7,
    /// Standing pedestrians.
    Standing = 8,
}

impl Purpose {
    /// The stream of a seed for this purpose.
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
