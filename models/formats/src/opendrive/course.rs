//! The reference line of a road: straight segments, with a short bend if the next road has another direction.

use super::roads::{Road, RoadLink, Roads};
use crate::markup::{Markup, decimal};
use scene::geometry::{direction, rotate};
use scene::{Vec2, wrap_angle};

/// Length of a road that a bend at an end takes, metres.
const BEND_M: f64 = 2.0;
/// Smaller differences of headings count as straight, radians.
const STRAIGHT_RAD: f64 = 1e-4;
/// Parts in which the length of a bend is measured.
const PARTS: usize = 16;

/// One piece.
pub(super) struct Piece {
    start: Vec2,
    heading_rad: f64,
    length_m: f64,
    /// Coefficients of a bend along and across the heading, for t, t² and t³ with t from 0 to 1.
    bend: Option<[Vec2; 3]>,
}

fn heading(from: Vec2, to: Vec2) -> f64 {
    let way = to - from;
    way.y.atan2(way.x)
}

/// Headings at which roads end and begin if others continue them.
fn own_heading(road: &Road<'_>, at_end: bool) -> Option<f64> {
    match (road.line(), at_end) {
        ([first, second, ..], false) => Some(heading(*first, *second)),
        ([.., before, last], true) => Some(heading(*before, *last)),
        _ => None,
    }
}

/// The segments of a road along its line. It begins in the direction in which the previous one ends; a way
/// through a junction also ends in the direction of the next one.
pub(super) fn pieces(road: &Road<'_>, drawn: &Roads<'_>) -> Vec<Piece> {
    let other = |link: Option<RoadLink>, at_end: bool| match link {
        Some(RoadLink::Road(other)) => own_heading(&drawn.roads[other], at_end),
        _ => None,
    };
    let begins = other(road.predecessor, true);
    let ends = other(road.successor, false).filter(|_| road.junction.is_some());
    let line = road.line();
    let mut pieces = Vec::with_capacity(line.len() + 1);
    let last = line.len().saturating_sub(2);
    for (i, way) in line.windows(2).enumerate() {
        let (mut from, mut to) = (way[0], way[1]);
        let along_rad = heading(from, to);
        let bends = |rad: &f64| wrap_angle(rad - along_rad).abs() > STRAIGHT_RAD;
        let first_bend = begins.filter(|_| i == 0).filter(bends);
        let last_bend = ends.filter(|_| i == last).filter(bends);
        let room_m = (to - from).norm() / 2.0;
        if let Some(begin_rad) = first_bend {
            let until = from + direction(along_rad) * BEND_M.min(room_m);
            pieces.push(bend(from, begin_rad, until, along_rad));
            from = until;
        }
        let tail = last_bend.map(|end_rad| {
            let since = to - direction(along_rad) * BEND_M.min(room_m);
            let tail = bend(since, along_rad, to, end_rad);
            to = since;
            tail
        });
        let length_m = (to - from).norm();
        if length_m > 1e-6 {
            pieces.push(Piece { start: from, heading_rad: along_rad, length_m, bend: None });
        }
        pieces.extend(tail);
    }
    pieces
}

/// A cubic between two positions with these headings.
fn bend(from: Vec2, from_rad: f64, to: Vec2, to_rad: f64) -> Piece {
    let chord_m = (to - from).norm();
    let (way, end) = (rotate(to - from, -from_rad), direction(to_rad - from_rad) * chord_m);
    let start = Vec2::new(chord_m, 0.0);
    let bend = [start, 3.0 * way - 2.0 * start - end, start + end - 2.0 * way];
    let at = |k: usize| {
        let t = k as f64 / PARTS as f64;
        t * (bend[0] + t * (bend[1] + t * bend[2]))
    };
    let length_m = (0..PARTS).map(|k| (at(k + 1) - at(k)).norm()).sum();
    Piece { start: from, heading_rad: from_rad, length_m, bend: Some(bend) }
}

/// Length of all, metres.
pub(super) fn length(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.length_m).sum()
}

/// Writes the pieces one after the other.
pub(super) fn write(pieces: &[Piece], out: &mut Markup) {
    let mut s_m = 0.0;
    for piece in pieces {
        out.open(
            "geometry",
            &[
                ("s", &decimal(s_m)),
                ("x", &decimal(piece.start.x)),
                ("y", &decimal(piece.start.y)),
                ("hdg", &decimal(piece.heading_rad)),
                ("length", &decimal(piece.length_m)),
            ],
        );
        match piece.bend {
            None => out.empty("line", &[]),
            Some([b, c, d]) => {
                let numbers = [b.x, c.x, d.x, b.y, c.y, d.y].map(decimal);
                let [b_u, c_u, d_u, b_v, c_v, d_v] = numbers.each_ref().map(String::as_str);
                out.empty(
                    "paramPoly3",
                    &[
                        ("aU", "0"),
                        ("bU", b_u),
                        ("cU", c_u),
                        ("dU", d_u),
                        ("aV", "0"),
                        ("bV", b_v),
                        ("cV", c_v),
                        ("dV", d_v),
                        ("pRange", "normalized"),
                    ],
                );
            }
        }
        out.close();
        s_m += piece.length_m;
    }
}
