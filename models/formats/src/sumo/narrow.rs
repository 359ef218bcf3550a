//! Narrow two-way roads. A road with a single lane for both directions has two edges in a network, each half
//! as wide as the road. No car fits in its half: drivers use the middle of the road, and so do both lanes
//! here.

use super::net::{EdgeFunction, LaneKind, Net};
use crate::polyline::{arc_lengths, offset_right};
use scene::Vec2;
use std::borrow::Cow;
use std::collections::HashMap;

/// A narrower lane has no room for a car beside oncoming traffic, metres.
const NARROW_M: f64 = 2.2;
/// Borders within this distance are one line, metres.
const TOUCHING_M: f64 = 0.6;

/// Narrow roads of a network.
#[derive(Debug, Default)]
pub(super) struct NarrowRoads {
    /// The opposite edge of each edge.
    edges: HashMap<usize, usize>,
    /// Width of the whole road for each lane, metres.
    widths_m: HashMap<usize, f64>,
}

impl NarrowRoads {
    pub fn of(net: &Net) -> Self {
        let mut narrow: HashMap<(&str, &str), Vec<(usize, usize)>> = HashMap::new();
        for (i, edge) in net.edges.iter().enumerate().filter(|(_, e)| e.function == EdgeFunction::Normal) {
            let beside = [LaneKind::Sidewalk, LaneKind::Closed, LaneKind::Bike];
            let mut driven = edge.lanes.iter().copied().filter(|l| !beside.contains(&net.lanes[*l].kind));
            let (Some(lane), None) = (driven.next(), driven.next()) else { continue };
            let width_m = net.lanes[lane].width_m;
            let leftmost = edge.lanes.last() == Some(&lane);
            if leftmost && width_m < NARROW_M && net.lanes[lane].shape.len() > 1 {
                narrow.entry((&edge.from, &edge.to)).or_default().push((i, lane));
            }
        }
        let mut roads = Self::default();
        for (edge, lane) in narrow.values().flatten() {
            let against = (net.edges[*edge].to.as_str(), net.edges[*edge].from.as_str());
            let touches = |(other, beside): &&(usize, usize)| other != edge && touch(net, *lane, *beside);
            if let Some((other, beside)) = narrow.get(&against).and_then(|list| list.iter().find(touches)) {
                roads.edges.insert(*edge, *other);
                roads.widths_m.insert(*lane, net.lanes[*lane].width_m + net.lanes[*beside].width_m);
            }
        }
        roads
    }

    /// Number of roads.
    pub fn count(&self) -> usize {
        self.edges.len() / 2
    }

    /// Whether two edges are the directions of one narrow road.
    pub fn share(&self, edge: usize, other: usize) -> bool {
        self.edges.get(&edge) == Some(&other)
    }

    /// Whether an edge is a direction of a narrow road.
    pub fn has(&self, edge: usize) -> bool {
        self.edges.contains_key(&edge)
    }

    /// Width of a lane, metres.
    pub fn width_m(&self, net: &Net, lane: usize) -> f64 {
        self.widths_m.get(&lane).copied().unwrap_or(net.lanes[lane].width_m)
    }

    /// Centre lines of all lanes: those of narrow roads in the middle of the road, and those through
    /// junctions from or to such roads.
    pub fn lines<'a>(&self, net: &'a Net) -> Vec<Cow<'a, [Vec2]>> {
        let mut lines: Vec<Cow<'_, [Vec2]>> = net.lanes.iter().map(|l| Cow::Borrowed(&*l.shape)).collect();
        // Displacement of the beginning and the end of a lane through a junction.
        let mut moved: HashMap<usize, [Vec2; 2]> = HashMap::new();
        let by = |lane: usize, last: bool| {
            self.widths_m.get(&lane).and_then(|_| {
                let (old, new) = (&net.lanes[lane].shape, middle(net, lane));
                if last { Some(new.last()? - old.last()?) } else { Some(new.first()? - old.first()?) }
            })
        };
        let is_inner = |lane: usize| net.edge_of(lane).function == EdgeFunction::Internal;
        for (lane, next) in
            net.lanes.iter().enumerate().flat_map(|(i, l)| l.successors.iter().map(move |n| (i, *n)))
        {
            if let (true, Some(by)) = (is_inner(next), by(lane, true)) {
                moved.entry(next).or_default()[0] = by;
            }
            if let (true, Some(by)) = (is_inner(lane), by(next, false)) {
                moved.entry(lane).or_default()[1] = by;
            }
        }
        for lane in self.widths_m.keys() {
            lines[*lane] = middle(net, *lane).into();
        }
        for (lane, [start, end]) in moved {
            let along = arc_lengths(&net.lanes[lane].shape);
            let whole = along.last().copied().unwrap_or_default().max(1e-9);
            let shifted = |(p, s): (&Vec2, &f64)| p + start * (1.0 - s / whole) + end * (s / whole);
            lines[lane] = net.lanes[lane].shape.iter().zip(&along).map(shifted).collect();
        }
        lines
    }
}

/// The left border of a lane, which is the middle of its road.
fn middle(net: &Net, lane: usize) -> Vec<Vec2> {
    offset_right(&net.lanes[lane].shape, -net.lanes[lane].width_m / 2.0)
}

/// Whether the left borders of two lanes are one line in opposite directions.
fn touch(net: &Net, lane: usize, other: usize) -> bool {
    let (there, back) = (middle(net, lane), middle(net, other));
    let (Some([a, b]), Some([c, d])) = (ends(&there), ends(&back)) else { return false };
    let half = |line: &[Vec2]| line.get(line.len() / 2).copied().unwrap_or_default();
    let beside = |p: Vec2| {
        back.windows(2).any(|w| {
            let along = w[1] - w[0];
            let share = ((p - w[0]).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
            (w[0] + along * share - p).norm() < TOUCHING_M
        })
    };
    (a - d).norm() < TOUCHING_M && (b - c).norm() < TOUCHING_M && beside(half(&there))
}

fn ends(line: &[Vec2]) -> Option<[Vec2; 2]> {
    Some([*line.first()?, *line.last()?])
}

#[cfg(test)]
mod tests {
    use crate::sumo::map::{MapOptions, lane_map};
    use crate::sumo::net::Net;

    /// A road of 3.2 m for both directions, and a street of 6.4 m after a junction.
    const ROAD: &str = r#"<net>
      <edge id=":c_0" function="internal">
        <lane id=":c_0_0" index="0" speed="6.5" length="10" width="3.2" shape="0,-0.8 5,-1.2 10,-1.6"/></edge>
      <edge id=":c_1" function="internal">
        <lane id=":c_1_0" index="0" speed="6.5" length="10" width="3.2" shape="10,1.6 0,0.8"/></edge>
      <edge id="in" from="w" to="c">
        <lane id="in_0" index="0" allow="pedestrian" speed="2" length="50" width="2" shape="-50,-2.6 0,-2.6"/>
        <lane id="in_1" index="1" speed="5.6" length="50" width="1.6" shape="-50,-0.8 0,-0.8"/></edge>
      <edge id="back" from="c" to="w"><lane id="back_0" index="0" speed="5.6" length="50" width="1.6" shape="0,0.8 -50,0.8"/></edge>
      <edge id="out" from="c" to="e"><lane id="out_0" index="0" speed="13.9" length="50" width="3.2" shape="10,-1.6 60,-1.6"/></edge>
      <edge id="from" from="e" to="c"><lane id="from_0" index="0" speed="13.9" length="50" width="3.2" shape="60,1.6 10,1.6"/></edge>
      <junction id="c" type="priority" x="5" y="0"/>
      <connection from="in" to="out" fromLane="1" toLane="0" via=":c_0_0" state="M"/>
      <connection from=":c_0" to="out" fromLane="0" toLane="0"/>
      <connection from="from" to="back" fromLane="0" toLane="0" via=":c_1_0" state="M"/>
      <connection from=":c_1" to="back" fromLane="0" toLane="0"/></net>"#;

    #[test]
    fn both_directions_of_a_narrow_road_keep_to_its_middle() {
        let draw = |text: &str| {
            let net = Net::read(text).unwrap();
            lane_map(&net, MapOptions { sidewalks: true, parking: false })
        };
        let drawn = draw(ROAD);
        let lane = |i: usize| &drawn.map.lanes[i];
        assert_eq!(drawn.narrow, 1);
        for i in [3, 4] {
            assert!(lane(i).points.xy.iter().all(|p| p.y.abs() < 1e-9), "{:?}", lane(i).points);
            assert_eq!(lane(i).width_m, Some(3.2));
        }
        // Ways through the junction begin and end where their lanes do.
        let ends = |i: usize| [lane(i).points.xy.first(), lane(i).points.xy.last()].map(|p| p.unwrap().y);
        let [inward, outward] = [ends(0), ends(1)];
        assert!(inward[0].abs() < 1e-9 && (inward[1] + 1.6).abs() < 1e-9, "{inward:?}");
        assert!((outward[0] - 1.6).abs() < 1e-9 && outward[1].abs() < 1e-9, "{outward:?}");
        assert_eq!((lane(5).width_m, lane(5).points.xy[0].y), (Some(3.2), -1.6), "the street stays as it is");
        // Only the street has a dividing line.
        let painted: Vec<f64> =
            drawn.map.road_lines.iter().map(|line| line.points.xy[0].x.min(line.points.xy[1].x)).collect();
        assert!(painted.len() == 1 && painted[0] >= 10.0, "{:?}", drawn.map.road_lines);
        // The surface is as wide as before.
        assert!(
            drawn.map.road_edges.iter().any(|edge| edge
                .points
                .xy
                .iter()
                .all(|p| (p.y - 1.6).abs() < 1e-9 && p.x < 1.0))
        );
        // Lanes with room for a car stay side by side.
        let wide = draw(&ROAD.replace("width=\"1.6\"", "width=\"2.4\""));
        assert!(wide.narrow == 0 && wide.map.lanes[3].points.xy[0].y == -0.8);
    }
}
