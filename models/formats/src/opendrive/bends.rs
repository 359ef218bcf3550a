//! Bends and lateral offsets of roads, from which the memory for them and the ends of their sections are
//! derived.

use crate::xml::Element;
use scene::Vec2;
use scene::geometry::{self, Extent};

/// Most memory per metre of lane, bytes: points, borders and crossing edges.
const LANE_MEMORY: f64 = 800.0;
/// Memory per metre of lane of roads that hardly bend, bytes: their lanes have fewer points. It applies only
/// to the first roads of a file, since each is compared with the previous ones.
const STRAIGHT_MEMORY: f64 = 200.0;
const STRAIGHT_ROADS: usize = 128;
/// Memory for each pair of lanes of two such roads that may cross, bytes: their edges are cut at the
/// crossing.
const CROSSING_MEMORY: f64 = 500.0;
/// Greatest lane width for the extent of a road, metres.
const LANE_M: f64 = 5.0;
/// A road that hardly bends: greatest curvature, 1/m, and turn from its start to its end, radians: a whole ring, which
/// crosses itself a few times at most. At each of its records it may bend over so many metres.
const STRAIGHT_CURVATURE: f64 = 0.01;
const STRAIGHT_TURN_RAD: f64 = 6.5;
const BEND_M: f64 = 20.0;

/// Bends of a road.
#[derive(Default)]
pub(super) struct RoadBends {
    /// Greatest curvature, 1/m, and turn of all pieces, radians.
    curvature: f64,
    turn_rad: f64,
    /// The open segment: start, direction in radians, length in metres.
    piece: (Vec2, f64, f64),
    /// Extent of all segments.
    extent: Option<Extent>,
    /// Number of records at which lanes may bend.
    records: usize,
}

impl RoadBends {
    /// Takes an element of the road.
    pub fn take(&mut self, element: &Element) {
        let value = |name| number(element, name).unwrap_or(0.0);
        let (start, heading_rad, length_m) = self.piece;
        match element.name.as_str() {
            "line" => self.reach(start + geometry::direction(heading_rad) * length_m, 0.0),
            "arc" | "spiral" => {
                let curvatures = ["curvature", "curvStart", "curvEnd"].map(|name| value(name).abs());
                let most = curvatures.into_iter().fold(0.0, f64::max);
                self.curvature = self.curvature.max(most);
                self.turn_rad += most * length_m;
                self.reach(start, length_m);
            }
            "poly3" | "paramPoly3" => self.curvature = f64::INFINITY,
            "geometry" => {
                self.piece = (Vec2::new(value("x"), value("y")), value("hdg"), value("length").abs());
                self.reach(self.piece.0, 0.0);
                self.records += 1;
            }
            "laneSection" => self.records += 1,
            // A constant bends no lane.
            "laneOffset" | "width" | "border" => {
                self.records += usize::from(["b", "c", "d"].into_iter().any(|term| value(term) != 0.0));
            }
            _ => {}
        }
    }

    /// Extends the box by a position and its surroundings.
    fn reach(&mut self, place: Vec2, around_m: f64) {
        let around = Extent::of([place]).grown(around_m);
        self.extent = Some(self.extent.unwrap_or(around).joined(&around));
    }

    /// Memory per metre of the lanes of a road of this length, bytes.
    fn lane_memory(&self, length_m: f64) -> f64 {
        if self.curvature > STRAIGHT_CURVATURE || self.turn_rad > STRAIGHT_TURN_RAD {
            return LANE_MEMORY;
        }
        let bent = (self.records as f64 * BEND_M / length_m.max(BEND_M)).min(1.0);
        LANE_MEMORY * bent + STRAIGHT_MEMORY * (1.0 - bent)
    }
}

/// Roads that hardly bend, to find those that may cross.
#[derive(Default)]
pub(super) struct StraightRoads(Vec<(Extent, f64)>);

impl StraightRoads {
    /// Memory for the lanes of a road, bytes per metre, and for its crossings with the previous ones, bytes.
    pub fn take(&mut self, bends: &RoadBends, length_m: f64, lanes: usize) -> (f64, f64) {
        let memory = bends.lane_memory(length_m);
        let counts = memory < LANE_MEMORY && self.0.len() < STRAIGHT_ROADS;
        let Some(extent) = bends.extent.filter(|_| counts) else { return (LANE_MEMORY, 0.0) };
        let lanes = lanes as f64;
        let extent = extent.grown(lanes * LANE_M);
        let near = self.0.iter().filter(|(other, _)| extent.touches(other));
        let pairs: f64 = near.map(|(_, others)| others * lanes).sum();
        self.0.push((extent, lanes));
        (memory, CROSSING_MEMORY * pairs)
    }
}

/// A `<laneOffset>`: a cubic from its position on.
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

    /// Distance between the beginning of the next one and the end of this one, metres.
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
