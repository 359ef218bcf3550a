//! The kind of road where two road users meet.

use scene::geometry::Extent;
use scene::geometry::polyline::Polyline;
use scene::map::{Lane, LaneType};
use scene::{LaneMap, Vec2, wrap_angle};

/// A place counts as on a crosswalk within this distance of its outline, metres.
const CROSSWALK_M: f64 = 1.0;
/// A place is on a lane within this of its centre, metres.
const ON_LANE_M: f64 = 3.0;
/// Lanes that cross within this distance of the place form a junction, metres.
const JUNCTION_M: f64 = 8.0;
/// Lanes that merge or fork within this distance along a lane count, metres.
const JOINING_M: f64 = 20.0;
/// Distance before and after the place over which a bend is measured, metres.
const BEND_M: f64 = 15.0;
/// Smallest angle at which lanes cross, radians: 25 degrees.
const CROSSING_RAD: f64 = 0.436;
/// Change of heading above which a lane bends, radians: 20 degrees.
const BEND_RAD: f64 = 0.349;

/// Names of the kinds of road, as [`road_layout`] returns them.
pub const LAYOUTS: [&str; 6] = ["crosswalk", "junction", "merge", "bend", "straight", "off-lane"];

/// A lane at a place.
struct LaneAt<'a> {
    lane: &'a Lane,
    line: Polyline,
    s_m: f64,
    distance_m: f64,
    heading_rad: f64,
}

/// The kind of road at a place: on a crosswalk; where lanes cross or lead through a junction; where they
/// merge or fork; in a bend; on a straight lane; off all lanes.
pub fn road_layout(map: &LaneMap, place: Vec2) -> &'static str {
    if map.crosswalks.iter().any(|area| area.is_near(place, CROSSWALK_M)) {
        return "crosswalk";
    }
    let lanes: Vec<LaneAt<'_>> = map.lanes.iter().filter_map(|lane| lane_at(lane, place)).collect();
    let own = || lanes.iter().filter(|at| at.distance_m <= ON_LANE_M);
    if own().next().is_none() {
        return "off-lane";
    }
    let crosses = |a: &LaneAt<'_>, b: &LaneAt<'_>| {
        let turn = wrap_angle(a.heading_rad - b.heading_rad).abs();
        turn > CROSSING_RAD && turn < std::f64::consts::PI - CROSSING_RAD
    };
    let is_junction = own().any(|at| at.lane.interpolating)
        || lanes.iter().enumerate().any(|(i, a)| lanes.iter().skip(i + 1).any(|b| crosses(a, b)));
    let joins = |at: &LaneAt<'_>| {
        let begins = at.lane.predecessors.len() > 1 && at.s_m <= JOINING_M;
        begins || (at.lane.successors.len() > 1 && at.line.length_m() - at.s_m <= JOINING_M)
    };
    let bends = |at: &LaneAt<'_>| {
        let from = at.line.heading_at((at.s_m - BEND_M).max(0.0));
        let to = at.line.heading_at((at.s_m + BEND_M).min(at.line.length_m()));
        wrap_angle(to - from).abs() > BEND_RAD
    };
    match () {
        () if is_junction => "junction",
        () if own().any(joins) => "merge",
        () if own().any(bends) => "bend",
        () => "straight",
    }
}

/// A lane that carries traffic, if it is near enough for a junction.
fn lane_at(lane: &Lane, place: Vec2) -> Option<LaneAt<'_>> {
    let walked = matches!(lane.lane_type, LaneType::Sidewalk | LaneType::Parking);
    if walked || Extent::of(lane.points.xy.iter().copied()).outside_m(place) > JUNCTION_M {
        return None;
    }
    let line = Polyline::new(lane.points.xy.iter().copied());
    let foot = line.project(place);
    (foot.distance_m <= JUNCTION_M).then_some(LaneAt {
        lane,
        line,
        s_m: foot.s_m,
        distance_m: foot.distance_m,
        heading_rad: foot.heading_rad,
    })
}

#[cfg(test)]
mod tests {
    use super::{LAYOUTS, road_layout};
    use scene::map::{Area, Lane, Points};
    use scene::{LaneMap, Vec2};

    fn line(points: &[(f64, f64)]) -> Points {
        Points::from(points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect::<Vec<_>>())
    }

    #[test]
    fn each_layout_is_told() {
        let arc: Vec<(f64, f64)> = (0..=15)
            .map(|i| f64::from(i) / 10.0)
            .map(|a| (300.0 + 40.0 * a.sin(), 40.0 - 40.0 * a.cos()))
            .collect();
        let mut east = Lane::street("east", line(&[(0.0, 0.0), (200.0, 0.0)]));
        east.successors = vec!["on".into(), "off".into()];
        let map = LaneMap {
            lanes: vec![
                east,
                Lane::street("north", line(&[(100.0, -50.0), (100.0, 50.0)])),
                Lane::street("west", line(&[(200.0, 3.5), (0.0, 3.5)])),
                Lane::street("arc", line(&arc)),
            ],
            crosswalks: vec![Area {
                id: "c".into(),
                polygon: line(&[(48.0, -4.0), (52.0, -4.0), (52.0, 8.0), (48.0, 8.0)]),
                holes: Vec::new(),
            }],
            ..LaneMap::default()
        };
        let at = |x, y| road_layout(&map, Vec2::new(x, y));
        let told =
            [at(50.0, 0.0), at(102.0, 1.0), at(190.0, 0.0), at(320.0, 5.4), at(20.0, 1.0), at(20.0, 60.0)];
        assert_eq!(told, LAYOUTS);
    }
}
