//! Lanelets: their sides in the direction of travel, their middle, what they are for.

use super::osm::{Osm, OsmRelation, Tags};
use crate::sides::{self, LaneletKind};
use scene::Vec2;
use scene::geometry::cross;
use scene::map::LaneType;

/// One lanelet.
pub(super) struct Lanelet<'a> {
    pub id: i64,
    /// Lines of its sides, and those between its ends, as ids.
    pub ways: [i64; 2],
    /// First and last points of its left and right side, as ids.
    pub ends: [(i64, i64); 2],
    pub left: Vec<Vec2>,
    pub right: Vec<Vec2>,
    pub relation: &'a OsmRelation,
    pub kind: LaneletKind,
}

impl Lanelet<'_> {
    /// Traffic goes both ways.
    pub fn two_way(&self) -> bool {
        self.relation.tags.get("one_way").is_some_and(|value| value == "no" || value == "false")
    }

    /// Points a metre apart halfway between the sides, and the mean width.
    pub fn middle(&self) -> (Vec<Vec2>, f64) {
        sides::middle(&self.left, &self.right)
    }

    /// Right and left side with as many points.
    pub fn sides(&self) -> (Vec<Vec2>, Vec<Vec2>) {
        sides::matched(&self.left, &self.right)
    }
}

/// All lanelets with two sides, and how many have none.
pub(super) fn lanelets(osm: &Osm) -> (Vec<Lanelet<'_>>, usize) {
    let all = osm.relations.iter().filter(|relation| is(&relation.tags, "type", "lanelet"));
    let (mut found, mut broken) = (Vec::new(), 0);
    for relation in all {
        match lanelet(osm, relation) {
            Some(lanelet) => found.push(lanelet),
            None => broken += 1,
        }
    }
    (found, broken)
}

pub(super) fn is(tags: &Tags, key: &str, value: &str) -> bool {
    tags.get(key).is_some_and(|found| found == value)
}

fn lanelet<'a>(osm: &Osm, relation: &'a OsmRelation) -> Option<Lanelet<'a>> {
    let ways = [relation.member("left")?, relation.member("right")?];
    let line = |id: &i64| -> Option<(Vec<i64>, Vec<Vec2>)> {
        let nodes = &osm.ways.get(id)?.nodes;
        let known: Vec<(i64, Vec2)> = nodes.iter().filter_map(|n| Some((*n, *osm.nodes.get(n)?))).collect();
        (known.len() > 1).then(|| known.into_iter().unzip())
    };
    let (mut left, mut right) = (line(&ways[0])?, line(&ways[1])?);
    let last = |line: &[Vec2]| line[line.len() - 1];
    // Sides are drawn in any direction: they must run the same way, and the left one on the left.
    let along = (left.1[0] - right.1[0]).norm() + (last(&left.1) - last(&right.1)).norm();
    let against = (left.1[0] - last(&right.1)).norm() + (last(&left.1) - right.1[0]).norm();
    if against < along {
        right.0.reverse();
        right.1.reverse();
    }
    let ring = right.1.iter().chain(left.1.iter().rev()).copied();
    let ring: Vec<Vec2> = ring.collect();
    let area: f64 = (0..ring.len()).map(|i| cross(ring[i], ring[(i + 1) % ring.len()])).sum();
    if area < 0.0 {
        for line in [&mut left, &mut right] {
            line.0.reverse();
            line.1.reverse();
        }
    }
    let ends_of = |ids: &[i64]| (ids[0], ids[ids.len() - 1]);
    Some(Lanelet {
        id: relation.id,
        ways,
        ends: [ends_of(&left.0), ends_of(&right.0)],
        left: left.1,
        right: right.1,
        relation,
        kind: kind(&relation.tags)?,
    })
}

fn kind(tags: &Tags) -> Option<LaneletKind> {
    let yes = |key: &str| is(tags, key, "yes");
    let on_foot = yes("participant:pedestrian") && !yes("participant:vehicle");
    Some(match tags.get("subtype").map_or("road", String::as_str) {
        "crosswalk" => LaneletKind::Crosswalk,
        "highway" => LaneletKind::Lane(LaneType::Freeway),
        "bus_lane" => LaneletKind::Lane(LaneType::BusLane),
        "bicycle_lane" => LaneletKind::Lane(LaneType::BikeLane),
        "walkway" | "shared_walkway" | "pedestrian_lane" => LaneletKind::Lane(LaneType::Sidewalk),
        "stairs" | "exit" | "rail" => return None,
        _ if on_foot => LaneletKind::Lane(LaneType::Sidewalk),
        _ => LaneletKind::Lane(LaneType::SurfaceStreet),
    })
}
