//! Positions on the roads of a map in the form of scenarios: along a road or a lane.

use scene::Vec2;
use std::collections::HashMap;
use xodr::{Direction, LaneId, LanePosition, Point, RoadId, RoadNetwork, RoadPosition};

/// Half the distance over which the direction of a road is measured, metres.
const BESIDE_M: f64 = 0.5;
/// Greatest distance of a position on a road from it, metres.
const ON_ROAD_M: f64 = 20.0;

/// A light of a lane in the form of scenarios.
#[derive(Debug)]
pub(crate) struct RoadLight {
    /// Id of its `<signal>`; real files repeat ids.
    pub id: String,
    /// Id of the lane in the map.
    pub lane: String,
    /// Stop position, in the frame of the map.
    pub stop: Vec2,
}

/// The roads of a map, about its origin.
pub(crate) struct RoadPlaces {
    /// In the order of the file.
    pub lights: Vec<RoadLight>,
    network: RoadNetwork,
    /// Origin of the network in the file, and of the map in the network.
    origin: Vec2,
    middle: Vec2,
    lanes: HashMap<(usize, i32), Vec<LaneId>>,
}

impl RoadPlaces {
    pub fn of(network: RoadNetwork, origin: Vec2, middle: Vec2, lights: Vec<RoadLight>) -> Self {
        let mut lanes: HashMap<(usize, i32), Vec<LaneId>> = HashMap::new();
        for lane in network.lanes() {
            if let Some(at) = network.road_lane(lane.id) {
                lanes.entry((at.road.0, at.od_id)).or_default().push(lane.id);
            }
        }
        Self { lights, network, origin, middle, lanes }
    }

    /// A position in the coordinates of the file.
    pub fn local(&self, world: Vec2) -> Vec2 {
        world - self.origin - self.middle
    }

    fn plane(&self, p: Point) -> Vec2 {
        Vec2::new(f64::from(p.x), f64::from(p.y)) - self.middle
    }

    /// A position beside a road's line, and the direction of the road there.
    pub fn road(&self, road: &str, s_m: f64, t_m: f64) -> Option<(Vec2, f64)> {
        let road = self.network.road_by_od_id(road)?;
        let at = |s: f64, t: f64| self.network.road_point(RoadPosition { road: road.id(), s, t });
        let place = self.plane(at(s_m, t_m)?);
        let ends = [(s_m - BESIDE_M).max(0.0), (s_m + BESIDE_M).min(road.length())];
        let way = self.plane(at(ends[1], 0.0)?) - self.plane(at(ends[0], 0.0)?);
        (way.norm() > 1e-3).then(|| (place, way.y.atan2(way.x)))
    }

    /// A position on a lane, the direction of the road there, and whether the lane runs against it.
    pub fn lane(&self, road: &str, lane: i32, s_m: f64, offset_m: f64) -> Option<(Vec2, f64, bool)> {
        let id: RoadId = self.network.road_by_od_id(road)?.id();
        let lanes = self.lanes.get(&(id.0, lane))?.iter();
        let on = |lane: &LaneId| {
            let at = LanePosition { lane: *lane, s: s_m, offset: offset_m };
            self.network.lane_point(at).map(|point| (self.plane(point), *lane))
        };
        let (place, lane) = lanes.into_iter().find_map(on)?;
        let (_, along_rad) = self.road(road, s_m, 0.0)?;
        Some((place, along_rad, self.network.lane(lane)?.direction == Direction::Backward))
    }

    /// The road at a position, the coordinates along and beside its line, and the lane.
    pub fn found(&self, at: Vec2) -> Option<(String, (f64, f64), Option<i32>)> {
        let p = at + self.middle;
        let point = Point { x: p.x as f32, y: p.y as f32, z: 0.0 };
        let found = self.network.road_position(point)?;
        let place = self.plane(self.network.road_point(found)?);
        if (place - at).norm() > ON_ROAD_M {
            return None;
        }
        let lane = self.network.lane_position(point).and_then(|on| self.network.road_lane(on.lane));
        let lane = lane.filter(|lane| lane.road == found.road).map(|lane| lane.od_id);
        Some((self.network.road(found.road)?.od_id().to_owned(), (found.s, found.t), lane))
    }
}
