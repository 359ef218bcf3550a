//! Parked cars. They are not simulated: boxes along parking strips, in driveways and in the bays of car
//! parks.

use super::network::{Network, left_of, unit};
use formats::polyline::{arc_lengths, length, part, point_at, resample};
use formats::sumo::net::{EdgeFunction, LaneKind, Net};
use scene::random::Stream;
use scene::{Size, Vec2};
use std::f64::consts::PI;

/// A parked car.
#[derive(Clone, Copy, Debug)]
pub struct ParkedCar {
    /// Box centre, network frame.
    pub position: Vec2,
    /// Radians.
    pub heading_rad: f64,
    /// Box.
    pub size: Size,
}

/// Parked cars, and the driveways for some of them.
#[derive(Clone, Debug, Default)]
pub struct ParkedCars {
    /// Cars.
    pub cars: Vec<ParkedCar>,
    /// Open rings.
    pub driveways: Vec<Vec<Vec2>>,
    /// Points of all traffic lanes and half of their width.
    lanes: Vec<(Vec2, f64)>,
}

fn body(draw: &mut Stream) -> Size {
    let length_m = draw.clipped(4.8, 0.42, 3.9, 6.2);
    Size { length_m, width_m: draw.clipped(2.08, 0.11, 1.85, 2.45), height_m: Some(1.7) }
}

/// Parks cars in a network.
pub fn park(network: &Network, net: &Net, draw: &mut Stream) -> ParkedCars {
    let mut cars = ParkedCars::default();
    for lane in net.lanes.iter().filter(|l| matches!(l.kind, LaneKind::Vehicle | LaneKind::Bike)) {
        cars.lanes.extend(resample(&lane.shape, 2.0).into_iter().map(|p| (p, lane.width_m / 2.0)));
    }
    for (i, lane) in net.lanes.iter().enumerate() {
        let edge = net.edge_of(i);
        if edge.function != EdgeFunction::Normal {
            continue;
        }
        match lane.kind {
            LaneKind::Closed => {
                let fill =
                    if edge.road_type == "arterial" { draw.beta(1.5, 2.0) } else { draw.beta(2.0, 2.3) };
                cars.along(&lane.shape, lane.width_m, fill, draw);
            }
            LaneKind::Sidewalk if edge.road_type == "residential" && draw.chance(0.8) => {
                let strip = edge.lanes.iter().any(|l| net.lanes[*l].kind == LaneKind::Closed);
                cars.driveways(&lane.shape, lane.width_m, if strip { 2.6 } else { 0.0 }, draw);
            }
            _ => {}
        }
    }
    let (fill, backed) = (draw.beta(1.7, 1.8), draw.between(0.05, 0.3));
    for (line, heading) in &network.stalls {
        cars.stalls(line, *heading, fill, backed, draw);
    }
    cars
}

impl ParkedCars {
    fn put(&mut self, position: Vec2, heading_rad: f64, size: Size, clearance: f64) {
        if self.lanes.iter().all(|(p, half)| (p - position).norm() - half > clearance) {
            self.cars.push(ParkedCar { position, heading_rad, size });
        }
    }

    /// Parks a row of cars along a strip, close to the kerb.
    fn along(&mut self, strip: &[Vec2], width: f64, fill: f64, draw: &mut Stream) {
        let total = length(strip);
        let mut s = draw.between(5.0, 9.0);
        while s < total - 11.0 {
            let size = body(draw);
            if draw.chance(fill) {
                let chord = part(strip, s, s + size.length_m);
                let (a, b) = (chord[0], chord[chord.len() - 1]);
                let way = unit(b - a);
                let aside = width / 2.0 - size.width_m / 2.0 - 0.15;
                let position = (a + b) / 2.0 - left_of(way) * draw.clipped(aside, 0.12, -0.3, 0.5);
                let heading = way.y.atan2(way.x) + draw.normal_about(0.0, 0.012);
                self.put(position, heading, size, size.width_m / 2.0 - 0.1);
            }
            s += size.length_m + draw.clipped(1.2, 0.5, 0.6, 4.0);
            if draw.chance(0.08) {
                s += draw.between(4.0, 8.0);
            }
        }
    }

    /// Adds driveways beyond a sidewalk, each with up to two cars.
    fn driveways(&mut self, sidewalk: &[Vec2], width: f64, strip: f64, draw: &mut Stream) {
        let (total, lengths) = (length(sidewalk), arc_lengths(sidewalk));
        let mut s = draw.between(12.0, 25.0);
        while s < total - 14.0 {
            let base = point_at(sidewalk, &lengths, s);
            let way = unit(point_at(sidewalk, &lengths, s + 1.0) - base);
            let away = -left_of(way);
            let count = draw.weighted([(0, 0.52), (1, 0.32), (2, 0.16)]);
            for c in 0..count {
                let size = body(draw);
                let depth = width / 2.0 + size.length_m / 2.0 + draw.between(0.3, 4.0);
                let heading = away.y.atan2(away.x) + if draw.chance(0.6) { PI } else { 0.0 };
                let position = base + way * (2.7 * c as f64) + away * depth;
                self.put(position, heading + draw.normal_about(0.0, 0.03), size, size.length_m / 2.0 + 1.0);
            }
            if count > 0 {
                let (near, far) = (-width / 2.0 - strip, width / 2.0 + 10.0);
                let corner = |along: f64, out: f64| base + way * along + away * out;
                let wide = 2.7 * (count - 1) as f64 + 1.5;
                self.driveways.push(vec![
                    corner(-1.5, near),
                    corner(-1.5, far),
                    corner(wide, far),
                    corner(wide, near),
                ]);
            }
            s += draw.between(13.0, 24.0);
        }
    }

    /// Parks cars in a row of perpendicular bays.
    fn stalls(&mut self, line: &[Vec2], heading: f64, fill: f64, backed: f64, draw: &mut Stream) {
        let (total, lengths) = (length(line), arc_lengths(line));
        let nose = scene::geometry::direction(heading);
        let mut s = 0.0;
        while s < total {
            if draw.chance(fill) {
                let size = body(draw);
                let position = point_at(line, &lengths, s) - nose * draw.normal_about(0.0, 0.25);
                let turned = if draw.chance(backed) { PI } else { 0.0 };
                self.put(
                    position,
                    heading + turned + draw.normal_about(0.0, 0.025),
                    size,
                    size.length_m / 2.0 - 0.6,
                );
            }
            s += 2.75;
        }
    }
}
