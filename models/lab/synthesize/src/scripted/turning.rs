//! U-turns between junctions, which networks without turnarounds lack.

use super::{LanePlace, Lanes, cubic, entering, heading_at, length, part, progress, record, sharpest};
use crate::{DT_S, RECORDED_S};
use formats::polyline::arc_lengths;
use formats::sumo::fcd::FcdTrack;
use scene::geometry::{cross, direction};
use scene::random::Stream;
use scene::wrap_angle;
use std::f64::consts::PI;

/// Greatest curvature, 1/m: about the turning circle of a car at the front.
const SHARPEST: f64 = 0.235;
/// Range of distances between opposite lanes in which a car can make the turn without reversing, metres.
const ACROSS_M: [f64; 2] = [8.5, 17.0];

impl Lanes<'_> {
    /// A car that drives along a lane, makes a U-turn into an opposite lane, and continues.
    pub(super) fn turning_back(&self, draw: &mut Stream) -> Option<FcdTrack> {
        if self.places.is_empty() {
            return None;
        }
        let from = &self.places[draw.below(self.places.len())];
        if matches!(self.net.edge_of(from.lane).road_type.as_str(), "motorway" | "lot" | "roundabout") {
            return None;
        }
        let to = self.opposite(from, draw)?;
        let before = self.towards(from.lane, from.s_m);
        let approach = length(&before);
        // With these tangents, the cubic curve is nearly a semicircle.
        let reach = 2.0 * (to.position - from.position).norm();
        let turn = cubic(from.position, from.heading_rad, to.position, to.heading_rad, reach);
        if approach < 20.0 || sharpest(&turn) > SHARPEST {
            return None;
        }
        let turned = approach + length(&turn);
        let mut path = before;
        path.extend(turn.into_iter().skip(1));
        let onwards = self.onwards(to.lane, to.s_m, draw);
        path.extend(part(&onwards, 0.3, length(&onwards)));
        let (top, slow) = (draw.clipped(10.0, 2.0, 6.0, 14.0), draw.between(1.6, 4.2));
        let (accel, brake) = (draw.clipped(1.6, 0.5, 0.8, 3.0), draw.clipped(1.5, 0.3, 0.8, 2.5));
        let speeds = progress(&path, |s, v| {
            if s < approach {
                let may = (slow * slow + 2.0 * brake * (approach - s)).sqrt().min(top);
                if s == 0.0 { may } else { may.max(v - 3.0 * DT_S) }
            } else if s < turned {
                slow.min(v + accel * DT_S)
            } else {
                (v + accel * DT_S).min(top)
            }
        });
        let start = draw.between(0.0, RECORDED_S - 25.0);
        let record = record(&path, heading_at(&path, &arc_lengths(&path), 0.0), start, &speeds, top);
        entering(&record, start)
    }

    /// A position to the left on a lane of the opposite direction.
    fn opposite(&self, from: &LanePlace, draw: &mut Stream) -> Option<&LanePlace> {
        let ahead = direction(from.heading_rad);
        let fits = |p: &&LanePlace| {
            let way = p.position - from.position;
            (ACROSS_M[0]..ACROSS_M[1]).contains(&cross(ahead, way))
                && (-0.5..3.0).contains(&way.dot(&ahead))
                && wrap_angle(p.heading_rad - from.heading_rad - PI).abs() < 0.3
        };
        let found: Vec<&LanePlace> = self.places.iter().filter(fits).collect();
        found.get(draw.below(found.len())).copied()
    }
}
