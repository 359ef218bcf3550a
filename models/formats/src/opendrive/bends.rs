//! How roads bend and where their lanes are moved aside, for the memory that they take and the ends of their sections.

use crate::xml::Element;

/// Most memory for each metre of lane, bytes: points, borders and crossing edges.
pub(super) const LANE_MEMORY: f64 = 800.0;
/// Memory for each metre of lane of roads that hardly bend, bytes: the lanes have fewer points. It holds for the first
/// roads of a file alone, since more of them may cross each other over and over.
const STRAIGHT_MEMORY: f64 = 300.0;
pub(super) const STRAIGHT_ROADS: usize = 2;
/// A road that hardly bends: greatest curvature, 1/m, and turn from its start to its end, radians: a whole ring, which
/// crosses itself a few times at most. At each of its records it may bend over so many metres.
const STRAIGHT_CURVATURE: f64 = 0.01;
const STRAIGHT_TURN_RAD: f64 = 6.5;
const BEND_M: f64 = 20.0;

/// How a road bends.
#[derive(Default)]
pub(super) struct RoadBends {
    /// Greatest curvature, 1/m, and turn of all pieces, radians.
    curvature: f64,
    turn_rad: f64,
    /// Length of the piece that is open, metres.
    piece_m: f64,
    /// Records at which lanes may bend.
    records: usize,
}

impl RoadBends {
    /// Takes an element of the road.
    pub fn take(&mut self, element: &Element) {
        let size = |name| number(element, name).unwrap_or(0.0).abs();
        match element.name.as_str() {
            "arc" | "spiral" => {
                let curvatures = ["curvature", "curvStart", "curvEnd"].map(size);
                let most = curvatures.into_iter().fold(0.0, f64::max);
                self.curvature = self.curvature.max(most);
                self.turn_rad += most * self.piece_m;
            }
            "poly3" | "paramPoly3" => self.curvature = f64::INFINITY,
            "geometry" => {
                self.piece_m = size("length");
                self.records += 1;
            }
            "laneOffset" | "width" | "border" | "laneSection" => self.records += 1,
            _ => {}
        }
    }

    /// Memory for each metre of the lanes of a road of this length, bytes.
    pub fn lane_memory(&self, length_m: f64) -> f64 {
        if self.curvature > STRAIGHT_CURVATURE || self.turn_rad > STRAIGHT_TURN_RAD {
            return LANE_MEMORY;
        }
        let bent = (self.records as f64 * BEND_M / length_m.max(BEND_M)).min(1.0);
        LANE_MEMORY * bent + STRAIGHT_MEMORY * (1.0 - bent)
    }
}

/// A `<laneOffset>`: a cubic from its place on.
#[derive(Clone, Copy)]
pub(super) struct LaneOffset {
    pub s_m: f64,
    terms: [f64; 4],
}

impl LaneOffset {
    pub fn of(element: &Element) -> Self {
        let value = |name| number(element, name).unwrap_or(0.0);
        Self { s_m: value("s"), terms: ["a", "b", "c", "d"].map(value) }
    }

    /// How far the next one begins from where this one has led, metres.
    pub fn step_m(&self, next: &Self) -> f64 {
        let ds = next.s_m - self.s_m;
        let [a, b, c, d] = self.terms;
        (a + ds * (b + ds * (c + ds * d)) - next.terms[0]).abs()
    }
}

/// An attribute as a finite number.
pub(super) fn number(element: &Element, name: &str) -> Option<f64> {
    element.get(name)?.trim().parse().ok().filter(|value: &f64| value.is_finite())
}
