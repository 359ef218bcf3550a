//! Small maps for tests: a straight road, a crossing of four arms, a ring, and broken ones.

use super::{Polyline, Pose};
use crate::geometry::{direction, rotate};
use crate::map::{Area, Lane, LaneType};
use crate::{LaneMap, Vec2};

pub(crate) fn lane(id: impl Into<String>, points: Vec<Vec2>) -> Lane {
    Lane::street(id, points)
}

pub(crate) fn map(lanes: Vec<Lane>) -> LaneMap {
    LaneMap { lanes, ..LaneMap::default() }
}

/// Straight points every 2 m.
pub(crate) fn line(from: Vec2, to: Vec2) -> Vec<Vec2> {
    Polyline::new([from, to]).resample(2.0).points().to_vec()
}

/// Circular arc with a point every 5 degrees; `turn_rad` is positive to the left.
pub(crate) fn arc(from: Pose, radius_m: f64, turn_rad: f64) -> Vec<Vec2> {
    let n = (turn_rad.abs() / 0.09).ceil().max(2.0) as usize;
    let side = turn_rad.signum();
    let centre = from.position + radius_m * side * rotate(from.direction(), std::f64::consts::FRAC_PI_2);
    (0..=n).map(|i| centre + rotate(from.position - centre, turn_rad * i as f64 / n as f64)).collect()
}

/// Two lanes eastwards (y = 0 right, y = 3.5 left), 400 m from x = -200.
pub(crate) fn two_lanes() -> LaneMap {
    let at = |y: f64| line(Vec2::new(-200.0, y), Vec2::new(200.0, y));
    map(vec![lane("right", at(0.0)), lane("left", at(3.5))])
}

/// Four arms of one lane each way, 100 m long, with straight, left and right paths through. Links lead from
/// `w_in` (western arm, eastbound) to `w_in>e` to `e_out`, and so on. Right-hand traffic.
pub(crate) fn crossing() -> LaneMap {
    use std::f64::consts::FRAC_PI_2;
    let (near, far, side) = (12.0, 112.0, 1.75);
    let names = ["w", "s", "e", "n"];
    let mut lanes = Vec::new();
    // Arm k lies where the heading of its incoming traffic points back to.
    for (k, name) in names.iter().enumerate() {
        let heading = FRAC_PI_2 * k as f64;
        let place = |along: f64, left: f64| rotate(Vec2::new(along, left), heading);
        let mut incoming = lane(format!("{name}_in"), line(place(-far, -side), place(-near, -side)));
        let outgoing = lane(format!("{name}_out"), line(place(-near, side), place(-far, side)));
        let entry = Pose::new(place(-near, -side), heading);
        let ways = [(1, near - side, -FRAC_PI_2), (2, 0.0, 0.0), (3, near + side, FRAC_PI_2)];
        for (ahead, radius, turn) in ways {
            // Counted counter-clockwise, the next arm lies to the right of incoming traffic.
            let to = names[(k + ahead) % 4];
            let points = match turn == 0.0 {
                true => line(entry.position, entry.position + 2.0 * near * direction(heading)),
                false => arc(entry, radius, turn),
            };
            let mut way = lane(format!("{name}_in>{to}"), points);
            way.interpolating = true;
            way.predecessors = vec![incoming.id.clone()];
            way.successors = vec![format!("{to}_out")];
            incoming.successors.push(way.id.clone());
            lanes.push(way);
        }
        lanes.extend([incoming, outgoing]);
    }
    map(lanes)
}

/// A roundabout of 15 m radius in four quarters, with an entry and an exit of 60 m at each.
pub(crate) fn ring() -> LaneMap {
    use std::f64::consts::FRAC_PI_2;
    let mut lanes = Vec::new();
    for k in 0..4 {
        let at = FRAC_PI_2 * f64::from(k);
        let from = Pose::new(15.0 * direction(at), at + FRAC_PI_2);
        let mut quarter = lane(format!("q{k}"), arc(from, 15.0, FRAC_PI_2));
        let next = Pose::new(15.0 * direction(at + FRAC_PI_2), at + 2.0 * FRAC_PI_2);
        quarter.successors = vec![format!("q{}", (k + 1) % 4), format!("x{k}")];
        let exit = lane(format!("x{k}"), line(next.position, next.position + 60.0 * next.direction()));
        let mut entry = lane(format!("e{k}"), line(from.position - 60.0 * from.direction(), from.position));
        entry.successors = vec![format!("q{k}")];
        lanes.extend([quarter, exit, entry]);
    }
    map(lanes)
}

/// One crosswalk from (0, 0) to (12, 0), 4 m wide, and a sidewalk that continues from its end.
pub(crate) fn crosswalk() -> LaneMap {
    let corner = |x: f64, y: f64| Vec2::new(x, y);
    let ring = vec![corner(0.0, -2.0), corner(12.0, -2.0), corner(12.0, 2.0), corner(0.0, 2.0)];
    let mut walk = lane("walk", line(corner(13.0, 0.0), corner(60.0, 0.0)));
    walk.lane_type = LaneType::Sidewalk;
    let area = Area { id: "cw".into(), polygon: ring.into(), holes: Vec::new() };
    LaneMap { crosswalks: vec![area], ..map(vec![walk]) }
}
