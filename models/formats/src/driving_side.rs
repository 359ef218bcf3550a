//! The driving side of a map, found from its lanes.

use scene::Vec2;
use scene::geometry::cross;
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::map::{Lane, LaneMap};

/// Distance from a lane up to which oncoming traffic is searched, metres.
const BESIDE_M: f64 = 8.0;
/// Most lanes that are examined: those of a large map agree long before.
const MOST_LANES: usize = 2_000;

/// Whether most lanes have oncoming traffic to their right; false if the map does not show it.
pub(crate) fn keeps_left(map: &LaneMap) -> bool {
    let driven = |lane: &Lane| lane.lane_type.carries_vehicles() && !lane.interpolating;
    let lanes: Vec<&Lane> = map.lanes.iter().filter(|lane| driven(lane)).collect();
    let all = lanes.iter().zip(0..).flat_map(|(lane, i)| pieces(&lane.points.xy, i)).collect();
    let index = SegmentIndex::new(all);
    let (mut left, mut right) = (0, 0);
    for lane in lanes.iter().take(MOST_LANES) {
        let points = &lane.points.xy;
        let at = points.len() / 2;
        let (Some(before), Some(p)) = (at.checked_sub(1).and_then(|i| points.get(i)), points.get(at)) else {
            continue;
        };
        let way = p - before;
        let oncoming = index.near(*p, BESIDE_M).filter(|piece| {
            let along = piece.to - piece.from;
            along.dot(&way) < -0.9 * along.norm() * way.norm()
        });
        let off = oncoming.map(|piece| piece.foot(*p) - p);
        let nearest = off.min_by(|a: &Vec2, b: &Vec2| a.norm().total_cmp(&b.norm()));
        match nearest.map(|off| cross(way, off)) {
            Some(side) if side > 0.0 => left += 1,
            Some(side) if side < 0.0 => right += 1,
            _ => {}
        }
    }
    right > left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn oncoming_traffic_shows_the_side() {
        let street = |id: &str, from: (f64, f64), to: (f64, f64)| {
            let points: Vec<Vec2> = vec![Vec2::new(from.0, from.1), Vec2::new(to.0, to.1)];
            Lane::street(id, points)
        };
        let lanes = vec![street("1", (0.0, -1.75), (50.0, -1.75)), street("2", (50.0, 1.75), (0.0, 1.75))];
        let map = LaneMap { lanes, ..LaneMap::default() };
        assert!(!keeps_left(&map) && keeps_left(&map.mirrored()) && !keeps_left(&LaneMap::default()));
    }
}
