//! Cuts a map to a circle: lanes and lines that leave it end there, and references to them are adapted.

use crate::around::MapPart;
use crate::polyline::length;
use crate::problem::ImportWarning;
use crate::refusals::what;
use crate::sentences;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use scene::map::{Area, Boundary, Lane, LaneMap, Neighbor, Points, TypedLine};
use scene::{Signal, Vec2};
use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;

/// Lengths below which stretches of lanes and of lines are dropped, metres.
const LEAST_LANE_M: f64 = 1.0;
const LEAST_LINE_M: f64 = 0.3;
/// Corners of the polygon that stands for the circle when areas are cut.
const CORNERS: u32 = 96;

/// Keeps what lies within the circle of a part, and reports how much that is.
pub(crate) fn cut(map: &mut LaneMap, signals: &mut Vec<Signal>, part: &MapPart) -> ImportWarning {
    let circle = CutCircle { middle: part.middle, radius_m: part.around.radius_m };
    let lanes = map.lanes.len();
    let stretches = cut_lanes(map, circle);
    let pieces = [&mut map.road_lines, &mut map.road_edges].map(|lines| cut_lines(lines, circle));
    refer(map, &stretches, &pieces.concat());
    for areas in [&mut map.crosswalks, &mut map.speed_bumps] {
        areas.retain(|area| circle.holds(middle(&area.polygon.xy)));
    }
    for areas in [&mut map.driveways, &mut map.drivable] {
        *areas = areas.drain(..).flat_map(|area| cut_area(area, circle)).collect();
    }
    name_apart([&mut map.driveways, &mut map.drivable]);
    map.stop_signs.retain_mut(|sign| {
        sign.lanes.retain(|lane| stretches.contains_key(lane));
        circle.holds(sign.position) && !sign.lanes.is_empty()
    });
    let crossings: HashSet<&str> = map.crosswalks.iter().map(|area| area.id.as_str()).collect();
    signals.retain(|signal| {
        let known = stretches.contains_key(&signal.lane) || crossings.contains(signal.lane.as_str());
        known && signal.stop.is_none_or(|stop| circle.holds(stop))
    });
    let ended = stretches.values().filter(|stretch| stretch.is_cut()).count();
    // Lanes that a reader took beside the circle count as skipped.
    let beside = if part.what == what::LANES { lanes - map.lanes.len() } else { 0 };
    let around = part.around;
    let message = sentences::cut_around(
        around.radius_m,
        around.x,
        around.y,
        map.lanes.len(),
        ended,
        part.what,
        part.left_out + beside,
    );
    ImportWarning::new("cut-around", message)
}

#[derive(Clone, Copy)]
struct CutCircle {
    middle: Vec2,
    radius_m: f64,
}

impl CutCircle {
    fn holds(&self, p: Vec2) -> bool {
        (p - self.middle).norm() <= self.radius_m
    }

    /// The part of a segment inside, as shares of its length.
    fn within(&self, a: Vec2, b: Vec2) -> Option<(f64, f64)> {
        let (from, along) = (a - self.middle, b - a);
        let square = along.norm_squared();
        if square < 1e-18 {
            return self.holds(a).then_some((0.0, 1.0));
        }
        let half = from.dot(&along) / square;
        let root = half * half - (from.norm_squared() - self.radius_m * self.radius_m) / square;
        let root = (root > 0.0).then(|| root.sqrt())?;
        let (low, high) = ((-half - root).max(0.0), (-half + root).min(1.0));
        (low < high).then_some((low, high))
    }

    /// Stretches of a line that lie inside.
    fn stretches(&self, line: &Points) -> Vec<CutStretch> {
        let last = line.xy.len().saturating_sub(1) as f64;
        if line.xy.iter().all(|p| self.holds(*p)) {
            return vec![CutStretch { from: 0.0, to: last, last }];
        }
        let mut found: Vec<CutStretch> = Vec::new();
        for (i, pair) in line.xy.windows(2).enumerate() {
            let Some((low, high)) = self.within(pair[0], pair[1]) else { continue };
            let (from, to) = (i as f64 + low, i as f64 + high);
            match found.last_mut() {
                Some(before) if before.to >= from => before.to = to,
                _ => found.push(CutStretch { from, to, last }),
            }
        }
        found
    }
}

/// A stretch of a line, in indices of its points and shares of the segments between them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CutStretch {
    from: f64,
    to: f64,
    /// Last point of the line.
    last: f64,
}

impl CutStretch {
    fn begins_cut(&self) -> bool {
        self.from > 0.0
    }

    fn ends_cut(&self) -> bool {
        self.to < self.last
    }

    fn is_cut(&self) -> bool {
        self.begins_cut() || self.ends_cut()
    }

    fn of(&self, line: &Points) -> Points {
        let inner = self.from.floor() as usize + 1..self.to.ceil() as usize;
        let places = || {
            let ends = [self.from, self.to];
            std::iter::once(ends[0]).chain(inner.clone().map(|i| i as f64)).chain([ends[1]])
        };
        let split = |at: f64| {
            let i = (at.floor() as usize).min(line.xy.len().saturating_sub(2));
            (i, at - i as f64)
        };
        let xy = places().map(|at| {
            let (i, share) = split(at);
            line.xy[i] + (line.xy[i + 1] - line.xy[i]) * share
        });
        let height = |z_m: &Vec<f64>| {
            let at = |at: f64| {
                let (i, share) = split(at);
                Some(z_m.get(i)? + (z_m.get(i + 1)? - z_m.get(i)?) * share)
            };
            places().map(|place| at(place).unwrap_or_default()).collect()
        };
        Points { xy: xy.collect(), z_m: line.z_m.as_ref().map(height) }
    }

    /// New indices of a range of points, as far as it lies in the stretch.
    fn renumbered(&self, (from, to): (usize, usize)) -> Option<(usize, usize)> {
        let (low, high) = ((from as f64).max(self.from), (to as f64).min(self.to));
        let count = self.to.ceil() as usize - self.from.floor() as usize;
        let number = |at: f64, up: bool| {
            let at = if up { at.ceil() } else { at.floor() } - self.from.floor();
            (at.max(0.0) as usize).min(count)
        };
        (low <= high).then(|| (number(low, low > self.from), number(high, high >= self.to)))
    }
}

/// Cuts lanes; a lane that enters the circle several times keeps its longest stretch.
fn cut_lanes(map: &mut LaneMap, circle: CutCircle) -> HashMap<String, CutStretch> {
    let mut kept = HashMap::new();
    map.lanes.retain_mut(|lane| {
        let long = |stretch: &CutStretch| {
            if stretch.is_cut() { length(&stretch.of(&lane.points).xy) } else { f64::INFINITY }
        };
        let stretches = circle.stretches(&lane.points).into_iter().map(|stretch| (long(&stretch), stretch));
        let longest = stretches.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(long, _)| *long >= LEAST_LANE_M);
        let Some((_, stretch)) = longest else { return false };
        if stretch.is_cut() {
            lane.points = stretch.of(&lane.points);
        }
        kept.insert(lane.id.clone(), stretch);
        true
    });
    kept
}

/// Pieces of lines that were cut: the id of the whole line, and the id and the points of the piece.
type Pieces = Vec<(String, String, Vec<Vec2>)>;

/// Cuts lines. A line may have several pieces; the first keeps its id.
fn cut_lines(lines: &mut Vec<TypedLine>, circle: CutCircle) -> Pieces {
    let mut taken: HashSet<String> = lines.iter().map(|line| line.id.clone()).collect();
    let (mut kept, mut pieces) = (Vec::new(), Vec::new());
    for line in lines.drain(..) {
        let stretches = circle.stretches(&line.points);
        if stretches.iter().all(|stretch| !stretch.is_cut()) && !stretches.is_empty() {
            pieces.push((line.id.clone(), line.id.clone(), Vec::new()));
            kept.push(line);
            continue;
        }
        let cut = stretches.iter().map(|stretch| stretch.of(&line.points));
        for (i, points) in cut.filter(|points| length(&points.xy) >= LEAST_LINE_M).enumerate() {
            let id = if i == 0 { line.id.clone() } else { fresh(&line.id, &mut taken) };
            pieces.push((line.id.clone(), id.clone(), points.xy.clone()));
            kept.push(TypedLine { id, line_type: line.line_type.clone(), points });
        }
    }
    *lines = kept;
    pieces
}

/// A new id derived from that of the whole.
fn fresh(id: &str, taken: &mut HashSet<String>) -> String {
    let stem: String = id.chars().take(50).collect();
    let mut count = 2;
    loop {
        let name = format!("{stem}.{count}");
        if taken.insert(name.clone()) {
            return name;
        }
        count += 1;
    }
}

/// Adapts links, sides and neighbours after the cut.
fn refer(map: &mut LaneMap, stretches: &HashMap<String, CutStretch>, pieces: &Pieces) {
    let mut by_line: HashMap<&str, Vec<(&str, &[Vec2])>> = HashMap::new();
    for (whole, id, points) in pieces {
        by_line.entry(whole).or_default().push((id, points));
    }
    let joined = |from: &str, to: &str| {
        let ends = stretches.get(from).zip(stretches.get(to));
        ends.is_some_and(|(from, to)| !from.ends_cut() && !to.begins_cut())
    };
    let nearest = |line: &str, p: Vec2| -> Option<String> {
        let far = |points: &[Vec2]| points.iter().map(|q| (q - p).norm()).fold(f64::INFINITY, f64::min);
        let pieces = by_line.get(line)?;
        let near = pieces.iter().min_by(|a, b| far(a.1).total_cmp(&far(b.1)));
        near.map(|(id, _)| (*id).to_owned())
    };
    for lane in &mut map.lanes {
        let Some(own) = stretches.get(&lane.id) else { continue };
        let Lane { id, points, successors, predecessors, .. } = lane;
        successors.retain(|next| joined(id, next));
        predecessors.retain(|before| joined(before, id));
        let side = |side: &mut Boundary| {
            let Some(range) = own.renumbered((side.from, side.to)) else { return false };
            (side.from, side.to) = range;
            let beside = points.xy.get(range.0.midpoint(range.1)).copied().unwrap_or_default();
            nearest(&side.line, beside).map(|line| side.line = line).is_some()
        };
        lane.left_boundary.retain_mut(side);
        lane.right_boundary.retain_mut(side);
        let neighbor = |beside: &mut Neighbor| {
            let Some(other) = stretches.get(&beside.lane) else { return false };
            let ranges = own.renumbered(beside.own_range).zip(other.renumbered(beside.other_range));
            let Some((own, range)) = ranges else { return false };
            (beside.own_range, beside.other_range) = (own, range);
            beside.boundaries.retain_mut(|side| {
                let Some(range) = other.renumbered((side.from, side.to)) else { return false };
                (side.from, side.to) = range;
                by_line.contains_key(side.line.as_str())
            });
            true
        };
        lane.left_neighbors.retain_mut(neighbor);
        lane.right_neighbors.retain_mut(neighbor);
    }
}

/// The parts of an area inside, all with its id.
fn cut_area(area: Area, circle: CutCircle) -> Vec<Area> {
    let rings = || std::iter::once(&area.polygon).chain(&area.holes);
    if rings().all(|ring| ring.xy.iter().all(|p| circle.holds(*p))) {
        return vec![area];
    }
    let place = |p: &Vec2| [p.x, p.y];
    let subject: Vec<Vec<[f64; 2]>> = rings().map(|ring| ring.xy.iter().map(place).collect()).collect();
    let corner = |i: u32| {
        let turn = f64::from(i) / f64::from(CORNERS) * TAU;
        [circle.middle.x + circle.radius_m * turn.cos(), circle.middle.y + circle.radius_m * turn.sin()]
    };
    let round: Vec<[f64; 2]> = (0..CORNERS).map(corner).collect();
    let points = |ring: Vec<[f64; 2]>| -> Points {
        ring.into_iter().map(|[x, y]| Vec2::new(x, y)).collect::<Vec<_>>().into()
    };
    let shapes = subject.overlay(&vec![round], OverlayRule::Intersect, FillRule::EvenOdd);
    let parts = shapes.into_iter().filter_map(|shape| {
        let mut rings = shape.into_iter().filter(|ring| ring.len() > 2).map(points);
        Some(Area { id: area.id.clone(), polygon: rings.next()?, holes: rings.collect() })
    });
    parts.collect()
}

/// Gives different ids to parts of one area.
fn name_apart(lists: [&mut Vec<Area>; 2]) {
    let mut taken = HashSet::new();
    for area in lists.into_iter().flatten() {
        if !taken.insert(area.id.clone()) {
            area.id = fresh(&area.id, &mut taken);
        }
    }
}

fn middle(points: &[Vec2]) -> Vec2 {
    points.iter().sum::<Vec2>() / points.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn street(id: &str, xs: &[f64], y: f64) -> Lane {
        let xy: Vec<Vec2> = xs.iter().map(|x| Vec2::new(*x, y)).collect();
        let z_m = Some(xs.iter().map(|x| x / 10.0).collect());
        Lane::street(id, Points { xy, z_m })
    }

    fn circle_of(radius_m: &str) -> MapPart {
        let around = format!("0,0,{radius_m}").parse().unwrap();
        crate::around::Chosen::of(Some(around)).part(Vec2::zeros(), what::LANES).unwrap()
    }

    #[test]
    fn lanes_end_at_the_circle_and_what_refers_to_them_follows() {
        let mut lanes = vec![
            street("a", &[-300.0, -150.0, -50.0], 0.0),
            street("b", &[-50.0, 0.0, 50.0], 0.0),
            street("c", &[50.0, 80.0, 120.0, 200.0], 0.0),
            street("d", &[200.0, 300.0], 0.0),
        ];
        lanes[0].successors = vec!["b".into()];
        (lanes[1].predecessors, lanes[1].successors) = (vec!["a".into()], vec!["c".into()]);
        (lanes[2].predecessors, lanes[2].successors) = (vec!["b".into()], vec!["d".into()]);
        lanes[3].predecessors = vec!["c".into()];
        lanes[2].left_boundary = vec![
            Boundary { line: "e".into(), from: 0, to: 1, kind: None },
            Boundary { line: "e".into(), from: 2, to: 3, kind: None },
        ];
        let edge = |id: &str, xs: &[f64]| TypedLine {
            id: id.into(),
            line_type: "boundary".into(),
            points: street("", xs, 2.0).points,
        };
        let ring = [(-500.0, -5.0), (500.0, -5.0), (500.0, 5.0), (-500.0, 5.0)];
        let ring: Vec<Vec2> = ring.into_iter().map(|(x, y)| Vec2::new(x, y)).collect();
        let ground = Area { id: "g".into(), polygon: ring.into(), holes: Vec::new() };
        let mut map = LaneMap {
            lanes,
            // Enters twice.
            road_edges: vec![edge("e", &[-400.0, 500.0, 400.0, 0.0]), edge("far", &[150.0, 400.0])],
            drivable: vec![ground],
            ..LaneMap::default()
        };
        let signal = |lane: &str, x: f64| Signal {
            lane: lane.into(),
            stop: Some(Vec2::new(x, 0.0)),
            stop_z_m: None,
            runs: Vec::new(),
        };
        let mut signals = vec![signal("c", 50.0), signal("c", 190.0), signal("d", 200.0)];
        let said = cut(&mut map, &mut signals, &circle_of("100"));
        let ids: Vec<&str> = map.lanes.iter().map(|lane| lane.id.as_str()).collect();
        assert_eq!(ids, ["a", "b", "c"]);
        let xs = |i: usize| map.lanes[i].points.xy.iter().map(|p| p.x.round()).collect::<Vec<_>>();
        assert_eq!(
            [xs(0), xs(1), xs(2)],
            [vec![-100.0, -50.0], vec![-50.0, 0.0, 50.0], vec![50.0, 80.0, 100.0]]
        );
        assert!((map.lanes[2].points.z_m.as_ref().unwrap()[2] - 10.0).abs() < 1e-9);
        assert!(map.lanes[0].predecessors.is_empty() && map.lanes[2].successors.is_empty());
        assert_eq!((&map.lanes[0].successors[0], &map.lanes[2].predecessors[0]), (&"b".into(), &"b".into()));
        assert_eq!(map.lanes[2].left_boundary.len(), 1, "the second lay outside");
        assert_eq!(map.road_edges.iter().map(|edge| edge.id.as_str()).collect::<Vec<_>>(), ["e", "e.2"]);
        let reach = map.drivable[0].polygon.xy.iter().map(|p| p.norm()).fold(0.0, f64::max);
        assert!((99.0..=100.01).contains(&reach), "{reach}");
        assert_eq!(signals.len(), 1);
        assert_eq!(
            said.detail,
            "within 100 m of 0, 0: lanes kept 3, of these ending at the circle 2; lanes outside 1"
        );
    }

    #[test]
    fn ranges_are_numbered_anew() {
        let stretch = CutStretch { from: 1.5, to: 4.25, last: 9.0 };
        assert_eq!(stretch.renumbered((0, 9)), Some((0, 4)));
        assert_eq!(stretch.renumbered((2, 4)), Some((1, 3)));
        assert_eq!((stretch.renumbered((0, 1)), stretch.renumbered((5, 9))), (None, None));
        let line = Points::from((0..10).map(|i| Vec2::new(f64::from(i), 0.0)).collect::<Vec<_>>());
        assert_eq!(stretch.of(&line).xy.iter().map(|p| p.x).collect::<Vec<_>>(), [1.5, 2.0, 3.0, 4.0, 4.25]);
    }
}
