//! Lanelets: their sides in the direction of travel, their middle line, and their use.

use super::osm::{Osm, OsmRelation, Tags};
use crate::sides::{self, LaneletKind};
use scene::Vec2;
use scene::geometry::cross;
use scene::map::LaneType;
use std::collections::HashMap;

/// One lanelet.
pub(super) struct Lanelet<'a> {
    pub id: i64,
    /// Ids of the lines of its left and its right side; several if a side is drawn in pieces.
    pub ways: [Vec<i64>; 2],
    /// First and last points of its left and right side, as ids.
    pub ends: [(i64, i64); 2],
    pub left: Vec<Vec2>,
    pub right: Vec<Vec2>,
    pub relation: &'a OsmRelation,
    pub kind: LaneletKind,
}

impl Lanelet<'_> {
    /// Whether traffic goes both ways.
    pub fn two_way(&self) -> bool {
        self.relation.tags.get("one_way").is_some_and(|value| value == "no" || value == "false")
    }

    /// Points a metre apart halfway between the sides, and the mean width.
    pub fn middle(&self) -> (Vec<Vec2>, f64) {
        sides::middle(&self.left, &self.right)
    }

    /// Right and left side with the same number of points.
    pub fn sides(&self) -> (Vec<Vec2>, Vec<Vec2>) {
        sides::matched(&self.left, &self.right)
    }
}

/// All lanelets with two sides, and the number of those without.
pub(super) fn lanelets(osm: &Osm) -> (Vec<Lanelet<'_>>, usize) {
    let all = || osm.relations.iter().filter(|relation| is(&relation.tags, "type", "lanelet"));
    let mut paired: Vec<(&OsmRelation, SidePair)> =
        all().filter_map(|relation| Some((relation, SidePair::of(osm, relation)?))).collect();
    let mut ends: HashMap<End, usize> = HashMap::new();
    for end in paired.iter().flat_map(|(_, sides)| sides.ends()) {
        *ends.entry(end).or_default() += 1;
    }
    for (_, sides) in &mut paired {
        sides.meet(&ends);
    }
    let found: Vec<Lanelet<'_>> =
        paired.into_iter().filter_map(|(relation, sides)| sides.lanelet(relation)).collect();
    let broken = all().count() - found.len();
    (found, broken)
}

pub(super) fn is(tags: &Tags, key: &str, value: &str) -> bool {
    tags.get(key).is_some_and(|found| found == value)
}

/// A side: the points of its lines, as ids and positions.
type SideLine = (Vec<i64>, Vec<Vec2>);

/// The lines of a side joined to one: each begins where another ends, in either direction.
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

/// An end of a lanelet: ids of the points of its two sides there, the smaller one first.
type End = (i64, i64);

/// The two sides of a lanelet, which run the same way.
struct SidePair {
    ways: [Vec<i64>; 2],
    left: SideLine,
    right: SideLine,
}

impl SidePair {
    /// Sides are drawn in any direction: the ends of two that run the same way are near each other.
    fn of(osm: &Osm, relation: &OsmRelation) -> Option<Self> {
        let ways: [Vec<i64>; 2] = [relation.all("left").collect(), relation.all("right").collect()];
        let (left, right) = (side(osm, &ways[0])?, side(osm, &ways[1])?);
        let mut sides = Self { ways, left, right };
        let last = |line: &[Vec2]| line[line.len() - 1];
        let (left, right) = (&sides.left.1, &sides.right.1);
        let along = (left[0] - right[0]).norm() + (last(left) - last(right)).norm();
        let against = (left[0] - last(right)).norm() + (last(left) - right[0]).norm();
        if against < along {
            turn(&mut sides.right);
        }
        Some(sides)
    }

    fn ends(&self) -> [End; 2] {
        let [(left, left_end), (right, right_end)] =
            [first_and_last(&self.left), first_and_last(&self.right)];
        [end(left, right), end(left_end, right_end)]
    }

    /// In a turn about a point, both pairings of the ends are equally near. The right one is that with which
    /// more other lanelets begin or end where this one does. `ends` counts the ends of all lanelets.
    fn meet(&mut self, ends: &HashMap<End, usize>) {
        let shared = |own: [End; 2], by: usize| {
            own.iter().filter(|end| ends.get(end).is_some_and(|count| *count > by)).count()
        };
        let as_is = shared(self.ends(), 1);
        turn(&mut self.right);
        if shared(self.ends(), 0) <= as_is {
            turn(&mut self.right);
        }
    }

    /// The lanelet, with the left side on the left.
    fn lanelet(mut self, relation: &OsmRelation) -> Option<Lanelet<'_>> {
        let ring: Vec<Vec2> = self.right.1.iter().chain(self.left.1.iter().rev()).copied().collect();
        let area: f64 = (0..ring.len()).map(|i| cross(ring[i], ring[(i + 1) % ring.len()])).sum();
        if area < 0.0 {
            turn(&mut self.left);
            turn(&mut self.right);
        }
        Some(Lanelet {
            id: relation.id,
            ways: self.ways,
            ends: [first_and_last(&self.left), first_and_last(&self.right)],
            left: self.left.1,
            right: self.right.1,
            relation,
            kind: kind(relation)?,
        })
    }
}

fn end(a: i64, b: i64) -> End {
    (a.min(b), a.max(b))
}

fn first_and_last((ids, _): &SideLine) -> (i64, i64) {
    (ids[0], ids[ids.len() - 1])
}

fn turn((ids, places): &mut SideLine) {
    ids.reverse();
    places.reverse();
}

/// Road users that may use a lanelet.
#[derive(Clone, Copy, Default)]
struct LaneletUsers {
    cars: bool,
    buses: bool,
    cyclists: bool,
    walkers: bool,
}

impl LaneletUsers {
    /// The stated users; a more specific word overrides a general one, and users that are not stated may not
    /// pass.
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

    /// The users of a subtype by the rules of Lanelet2. A subtype outside these rules is for nobody.
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
        // Other users of a bus lane do not make it a lane for all.
        LaneletUsers { buses: true, .. } if subtype == "bus_lane" => LaneType::BusLane,
        LaneletUsers { cars: true, .. } => LaneType::SurfaceStreet,
        LaneletUsers { buses: true, .. } => LaneType::BusLane,
        LaneletUsers { walkers: true, .. } => LaneType::Sidewalk,
        LaneletUsers { cyclists: true, .. } => LaneType::BikeLane,
        _ => return None,
    };
    Some(LaneletKind::Lane(lane_type))
}
