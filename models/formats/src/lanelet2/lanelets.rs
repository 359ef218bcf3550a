//! Lanelets: their sides in the direction of travel, their middle, what they are for.

use super::osm::{Osm, OsmRelation, Tags};
use crate::sides::{self, LaneletKind};
use scene::Vec2;
use scene::geometry::cross;
use scene::map::LaneType;

/// One lanelet.
pub(super) struct Lanelet<'a> {
    pub id: i64,
    /// Ids of the lines of its left and its right side, which are several where the sides are drawn in pieces.
    pub ways: [Vec<i64>; 2],
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

/// A side: the points of its lines, as ids and places.
type SideLine = (Vec<i64>, Vec<Vec2>);

/// The lines of a side as one: each goes on where another ends, whichever way it is drawn.
fn side(osm: &Osm, ways: &[i64]) -> Option<SideLine> {
    let nodes = |id: &i64| {
        let known = osm.ways.get(id)?.nodes.iter().filter(|node| osm.nodes.contains_key(node));
        let nodes: Vec<i64> = known.copied().collect();
        (nodes.len() > 1).then_some(nodes)
    };
    let mut rest: Vec<Vec<i64>> = ways.iter().filter_map(nodes).collect();
    if rest.is_empty() {
        return None;
    }
    let mut line = rest.remove(0);
    while let Some(at) = rest.iter().position(|other| joins(&line, other)) {
        let mut other = rest.remove(at);
        let (first, last) = (line.first().copied(), line.last().copied());
        if other.last().copied() == last || other.first().copied() == first {
            other.reverse();
        }
        if other.first().copied() == last {
            line.extend(other.into_iter().skip(1));
        } else {
            other.pop();
            other.append(&mut line);
            line = other;
        }
    }
    let places = line.iter().filter_map(|node| osm.nodes.get(node).copied()).collect();
    Some((line, places))
}

/// Whether two lines share an end.
fn joins(a: &[i64], b: &[i64]) -> bool {
    [a.first(), a.last()].iter().any(|end| *end == b.first() || *end == b.last())
}

fn lanelet<'a>(osm: &Osm, relation: &'a OsmRelation) -> Option<Lanelet<'a>> {
    let ways: [Vec<i64>; 2] = [relation.all("left").collect(), relation.all("right").collect()];
    let (mut left, mut right) = (side(osm, &ways[0])?, side(osm, &ways[1])?);
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
        kind: kind(relation)?,
    })
}

/// Road users that a lanelet is for.
#[derive(Clone, Copy, Default)]
struct LaneletUsers {
    cars: bool,
    buses: bool,
    cyclists: bool,
    walkers: bool,
}

impl LaneletUsers {
    /// Those stated; a finer word counts before a coarser one, and who is not stated does not pass.
    fn stated(participants: &[(String, bool)]) -> Self {
        let passes = |words: &[&str]| {
            let said = |word: &&str| participants.iter().find(|(who, _)| who == word).map(|(_, yes)| *yes);
            words.iter().find_map(said).unwrap_or(false)
        };
        Self {
            cars: passes(&["vehicle:car", "vehicle"]),
            buses: passes(&["vehicle:bus", "vehicle"]),
            cyclists: passes(&["bicycle"]),
            walkers: passes(&["pedestrian"]),
        }
    }

    /// Those of a subtype by the rules of Lanelet2. A subtype that they do not know is for nobody.
    fn of_subtype(subtype: &str) -> Self {
        let [driven, ridden, walked] = match subtype {
            "" | "highway" => [true, false, false],
            "road" => [true, true, false],
            "play_street" | "exit" => [true, true, true],
            "bus_lane" => return Self { buses: true, ..Self::default() },
            "bicycle_lane" => [false, true, false],
            "shared_walkway" => [false, true, true],
            "walkway" | "crosswalk" | "stairs" | "pedestrian_lane" => [false, false, true],
            _ => [false, false, false],
        };
        Self { cars: driven, buses: driven, cyclists: ridden, walkers: walked }
    }
}

fn kind(relation: &OsmRelation) -> Option<LaneletKind> {
    let subtype = relation.tags.get("subtype").map_or("", String::as_str);
    let passing = match relation.participants.as_slice() {
        [] => LaneletUsers::of_subtype(subtype),
        participants => LaneletUsers::stated(participants),
    };
    let lane_type = match passing {
        LaneletUsers { walkers: true, .. } if subtype == "crosswalk" => return Some(LaneletKind::Crosswalk),
        LaneletUsers { cars: true, .. } if subtype == "highway" => LaneType::Freeway,
        // Who else may pass a bus lane does not make it a lane for all.
        LaneletUsers { buses: true, .. } if subtype == "bus_lane" => LaneType::BusLane,
        LaneletUsers { cars: true, .. } => LaneType::SurfaceStreet,
        LaneletUsers { buses: true, .. } => LaneType::BusLane,
        LaneletUsers { walkers: true, .. } => LaneType::Sidewalk,
        LaneletUsers { cyclists: true, .. } => LaneType::BikeLane,
        _ => return None,
    };
    Some(LaneletKind::Lane(lane_type))
}
