//! Connections of lanes: which lane leads into which, and which lane ends share a junction. Writers of
//! formats whose roads end at junctions use them.

use crate::polyline::length;
use scene::map::LaneMap;
use scene::{Vec2, geometry};
use std::collections::{BTreeSet, HashMap};

/// Most ways through junctions that are tested for crossings.
const MOST_CROSSING: usize = 1_500;
/// Most pairs of line segments that are compared: ten times what a large town needs.
const MOST_PIECES: u64 = 100_000_000;

/// A lane is a ring if its ends are nearer to each other than this share of its length.
const RING_SHARE: f64 = 0.1;

/// Ends of lanes grouped by their junction.
pub(crate) struct Groups(Vec<usize>);

impl Groups {
    /// Every end of this many lanes in its own group.
    pub fn of(lanes: usize) -> Self {
        Self((0..2 * lanes).collect())
    }

    /// The end that represents its group.
    pub fn root(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    /// Puts two ends into one junction.
    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// Index of the end of a lane in [`Groups`].
pub(crate) fn end_of(lane: usize) -> usize {
    2 * lane
}

/// Index of the beginning of a lane in [`Groups`].
pub(crate) fn start_of(lane: usize) -> usize {
    2 * lane + 1
}

/// Connections of the lanes of a map, by their index in it.
pub(crate) struct Joints {
    /// Which lane leads into which, each pair once.
    pub links: BTreeSet<(usize, usize)>,
    /// Successors of each lane.
    pub outs: Vec<Vec<usize>>,
    /// Predecessors of each lane.
    pub ins: Vec<Vec<usize>>,
}

impl Joints {
    pub fn of(map: &LaneMap) -> Self {
        let links = links(map);
        let count = map.lanes.len();
        let (mut ins, mut outs) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        for (a, b) in &links {
            outs[*a].push(*b);
            ins[*b].push(*a);
        }
        Self { links, outs, ins }
    }
}

fn links(map: &LaneMap) -> BTreeSet<(usize, usize)> {
    let places: HashMap<&str, usize> =
        map.lanes.iter().enumerate().map(|(i, l)| (l.id.as_str(), i)).collect();
    let mut links = BTreeSet::new();
    for (i, lane) in map.lanes.iter().enumerate() {
        links.extend(lane.successors.iter().filter_map(|id| Some((i, *places.get(id.as_str())?))));
        links.extend(lane.predecessors.iter().filter_map(|id| Some((*places.get(id.as_str())?, i))));
    }
    links.retain(|(a, b)| a != b || is_ring(&map.lanes[*a].points.xy));
    links
}

/// Whether a line ends where it begins.
fn is_ring(points: &[Vec2]) -> bool {
    let apart_m = points.first().zip(points.last()).map(|(first, last)| (last - first).norm());
    apart_m.is_some_and(|apart_m| apart_m < RING_SHARE * length(points))
}

/// Joins ways that cross each other into one junction: lines, each with the end of a lane at its junction.
pub(crate) fn join_crossing(ways: &[(&[Vec2], usize)], groups: &mut Groups) {
    if ways.len() > MOST_CROSSING {
        return;
    }
    let mut crossings = Crossings::of(ways.iter().map(|(points, _)| *points));
    for i in 0..ways.len() {
        for j in i + 1..ways.len() {
            if groups.root(ways[i].1) != groups.root(ways[j].1) && crossings.meet(i, j) {
                groups.join(ways[i].1, ways[j].1);
            }
        }
    }
}

/// Finds which of many lines cross or touch.
pub(crate) struct Crossings<'a> {
    lines: Vec<&'a [Vec2]>,
    boxes: Vec<(Vec2, Vec2)>,
    left: u64,
}

impl<'a> Crossings<'a> {
    pub fn of(lines: impl Iterator<Item = &'a [Vec2]>) -> Self {
        let lines: Vec<&[Vec2]> = lines.collect();
        let corners = |points: &&[Vec2]| {
            let first = points.first().copied().unwrap_or_default();
            points.iter().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)))
        };
        Self { boxes: lines.iter().map(corners).collect(), lines, left: MOST_PIECES }
    }

    /// Whether two lines cross or touch. Beyond the limit of comparisons, overlapping boxes count as
    /// touching.
    pub fn meet(&mut self, i: usize, j: usize) -> bool {
        let (a, b) = (self.boxes[i], self.boxes[j]);
        if (0..2).any(|k| a.0[k] > b.1[k] || b.0[k] > a.1[k]) {
            return false;
        }
        let pieces = (self.lines[i].len() * self.lines[j].len()) as u64;
        let Some(left) = self.left.checked_sub(pieces) else { return true };
        self.left = left;
        cross(self.lines[i], self.lines[j])
    }
}

fn cross(a: &[Vec2], b: &[Vec2]) -> bool {
    let side = |p: Vec2, q: Vec2, r: Vec2| geometry::cross(q - p, r - p);
    a.windows(2).any(|a| {
        b.windows(2).any(|b| {
            side(a[0], a[1], b[0]) * side(a[0], a[1], b[1]) <= 0.0
                && side(b[0], b[1], a[0]) * side(b[0], b[1], a[1]) <= 0.0
        })
    })
}
