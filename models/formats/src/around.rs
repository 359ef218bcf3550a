//! The part of a map that is read: everything within a circle.
//!
//! A reader skips what lies entirely outside, so that its limits apply to the part only. Lanes that leave the
//! circle are cut later ([`crate::cut`]).

use crate::refusals::{self, wanted, what};
use scene::Vec2;
use scene::message::{Message, Word};
use std::str::FromStr;

/// Least and greatest radius, metres.
const RADIUS_M: (f64, f64) = (10.0, 5_000.0);
/// Greatest distance of a circle from the origin of a file, metres.
const FARTHEST_M: f64 = 1e8;
/// Roads and lanes up to this far outside the circle are read too, so that those that begin inside are
/// complete, metres.
const BESIDE_M: f64 = 60.0;
/// Metres of a degree of latitude.
const DEGREE_M: f64 = 111_320.0;

/// A circle in the coordinates of a file: metres, or degrees (longitude, latitude) where the file has degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Around {
    /// East, or longitude.
    pub x: f64,
    /// North, or latitude.
    pub y: f64,
    /// Metres.
    pub radius_m: f64,
}

impl FromStr for Around {
    type Err = Message;

    /// `X,Y,RADIUS`.
    fn from_str(text: &str) -> Result<Self, Message> {
        let wrong = || refusals::expected(wanted::AROUND);
        let mut numbers = text.split(',').map(|part| part.trim().parse::<f64>().ok());
        let mut next = || numbers.next().flatten().ok_or_else(wrong);
        let around = Self { x: next()?, y: next()?, radius_m: next()? };
        let fits = around.x.abs() <= FARTHEST_M
            && around.y.abs() <= FARTHEST_M
            && (RADIUS_M.0..=RADIUS_M.1).contains(&around.radius_m);
        if fits && numbers.next().is_none() { Ok(around) } else { Err(wrong()) }
    }
}

/// What a reader takes from a file: everything, or what lies near a circle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chosen {
    around: Option<Around>,
    /// Bounding box of everything that was asked for, in the coordinates of the file.
    corners: Option<(Vec2, Vec2)>,
    /// Number of things outside, as the reader counts them.
    pub left_out: usize,
}

impl Chosen {
    pub fn of(around: Option<Around>) -> Self {
        Self { around, ..Self::default() }
    }

    /// Whether only a part is read.
    pub fn is_part(&self) -> bool {
        self.around.is_some()
    }

    /// Whether a line in metres is taken; every line is if the whole file is read.
    pub fn takes(&mut self, line: &[Vec2]) -> bool {
        let Some(around) = self.around else { return true };
        self.see(line);
        let middle = Vec2::new(around.x, around.y);
        reaches(line.iter().map(|p| p - middle), around.radius_m + BESIDE_M)
    }

    /// Whether something within this distance of a place may be taken.
    pub fn takes_near(&mut self, at: Vec2, within_m: f64) -> bool {
        let Some(around) = self.around else { return true };
        self.see(&[at]);
        (at - Vec2::new(around.x, around.y)).norm() <= around.radius_m + BESIDE_M + within_m
    }

    /// Whether a line in degrees (longitude, latitude) that comes this near to the circle is taken, metres.
    pub fn takes_degrees(&mut self, line: &[Vec2], beside_m: f64) -> bool {
        let Some(around) = self.around else { return true };
        self.see(line);
        let metres = |p: &Vec2| {
            let (east, north) = (p.x - around.x, p.y - around.y);
            Vec2::new(east * around.y.to_radians().cos(), north) * DEGREE_M
        };
        reaches(line.iter().map(metres), around.radius_m + beside_m)
    }

    fn see(&mut self, line: &[Vec2]) {
        for p in line {
            self.corners = Some(self.corners.map_or((*p, *p), |(low, high)| (low.inf(p), high.sup(p))));
        }
    }

    /// The part in the frame of a map whose origin lies at `origin` of the file. `what` names the omitted
    /// things.
    pub fn part(&self, origin: Vec2, what: Word) -> Option<MapPart> {
        let around = self.around?;
        let middle = Vec2::new(around.x, around.y) - origin;
        Some(MapPart { middle, around, left_out: self.left_out, what })
    }

    /// Centre of the circle in whole metres: the origin of a map that is read in part.
    pub fn origin(&self) -> Option<Vec2> {
        self.around.map(|around| Vec2::new(around.x.round(), around.y.round()))
    }

    /// The reason if nothing of a file is taken because it lies elsewhere.
    pub fn nothing(&self) -> Option<Message> {
        let (around, (low, high)) = (self.around?, self.corners?);
        let [x, y] = [(low.x, high.x), (low.y, high.y)].map(|(low, high)| format!("{low} to {high}"));
        Some(refusals::nothing_around(around.radius_m, around.x, around.y, &x, &y))
    }
}

/// A part of a map, in the frame of the map.
#[derive(Clone, Debug)]
pub(crate) struct MapPart {
    /// Centre of the circle, metres.
    pub middle: Vec2,
    /// The circle in the coordinates of the file.
    pub around: Around,
    /// Number of things that the reader skipped, and their kind.
    pub left_out: usize,
    pub what: Word,
}

impl MapPart {
    /// A circle about the origin of a map, which lies at this place of its file.
    pub fn about(place: Vec2, radius_m: f64) -> Self {
        let around = Around { x: place.x, y: place.y, radius_m };
        Self { middle: Vec2::zeros(), around, left_out: 0, what: what::LANES }
    }
}

/// Whether a line comes this near to the origin.
fn reaches(line: impl Iterator<Item = Vec2> + Clone, within_m: f64) -> bool {
    let near = |a: Vec2, b: Vec2| {
        let along = b - a;
        let share = (-a.dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        (a + along * share).norm() <= within_m
    };
    let mut before = None;
    line.into_iter().any(|p| near(before.replace(p).unwrap_or(p), p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_read_from_three_numbers() {
        assert_eq!("5,-2.5, 300".parse(), Ok(Around { x: 5.0, y: -2.5, radius_m: 300.0 }));
        for wrong in ["", "1,2", "1,2,3", "1,2,9000", "nan,0,100", "1,2,300,4", "1e9,0,100", "a,b,c"] {
            assert!(wrong.parse::<Around>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn lines_are_taken_that_pass_the_circle() {
        let mut chosen = Chosen::of("0,0,100".parse().ok());
        let line = |points: &[(f64, f64)]| points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect::<Vec<_>>();
        assert!(chosen.takes(&line(&[(-900.0, 90.0), (900.0, 90.0)])), "both ends lie outside");
        assert!(!chosen.takes(&line(&[(-900.0, 190.0), (900.0, 190.0)])) && !chosen.takes(&[]));
        assert!(Chosen::default().takes(&[]), "without a circle all is");
        let message = chosen.nothing().map(|message| message.english).unwrap_or_default();
        assert!(message.contains("-900 to 900"), "{message}");
        let mut chosen = Chosen::of("11.5,48.1,100".parse().ok());
        assert!(chosen.takes_degrees(&[Vec2::new(11.502, 48.1)], 60.0), "149 m to the east");
        assert!(!chosen.takes_degrees(&[Vec2::new(11.503, 48.1)], 60.0));
    }
}
