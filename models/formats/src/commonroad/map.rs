//! Reads lanelets as a lane map.

use super::document::{CommonRoadDocument, Lanelet, Side};
use super::words::{INTERSECTION, MAX_SPEED_SIGNS, STOP_SIGNS, lane_kind, line_type};
use crate::map_file::AGAINST;
use crate::problem::ImportWarning;
use crate::sentences;
use crate::sides::{self, LaneletKind};
use crate::surface::{self, Strip};
use crate::{bounds, polyline};
use scene::map::{Area, Boundary, Lane, LaneMap, LaneType, Neighbor, ROAD_LINE_TYPES, StopSign, TypedLine};
use scene::{MAX_POLYLINE_POINTS, Vec2};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Overlap of a lanelet's ground with that of its neighbour, metres.
const BESIDE_M: f64 = 0.5;

/// Lanes of each lanelet: with its direction, and against it.
pub(super) type Lanes = HashMap<i64, Vec<usize>>;

/// A map of the lanelets, and the lanes of each lanelet.
pub(super) fn lane_map(document: &CommonRoadDocument, warnings: &mut Vec<ImportWarning>) -> (LaneMap, Lanes) {
    let mut map = LaneMap::default();
    let lanes = draw(document, &mut map, warnings);
    link(&document.lanelets, &lanes, &mut map);
    paint(&document.lanelets, &lanes, &mut map);
    if !ground(&document.lanelets, &lanes, &mut map) {
        warnings.push(ImportWarning::new("edges-dropped", sentences::crossing_lanelets()));
    }
    bounds::by_edges(&mut map);
    stop_signs(document, &lanes, &mut map);
    (map, lanes)
}

/// Draws lanes and crosswalks.
fn draw(document: &CommonRoadDocument, map: &mut LaneMap, warnings: &mut Vec<ImportWarning>) -> Lanes {
    let through: HashSet<i64> = document.turns.iter().map(|(_, id)| *id).collect();
    let mut lanes = Lanes::new();
    let mut twice = 0;
    for lanelet in &document.lanelets {
        if lanes.contains_key(&lanelet.id) {
            twice += 1;
            continue;
        }
        let drawn = lanes.entry(lanelet.id).or_default();
        let users: Vec<String> = lanelet.one_way.iter().chain(&lanelet.both_ways).cloned().collect();
        let LaneletKind::Lane(lane_type) = lane_kind(&lanelet.types, &users) else {
            let mut ring: Vec<Vec2> =
                lanelet.right.points.iter().chain(lanelet.left.points.iter().rev()).copied().collect();
            ring.dedup();
            if ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            map.crosswalks.push(Area { id: lanelet.id.to_string(), polygon: ring.into(), holes: Vec::new() });
            continue;
        };
        let (points, width_m) = centre(lanelet);
        let driven = lane_type.carries_vehicles();
        let both = driven && lanelet.one_way.is_empty() && drives(&lanelet.both_ways);
        let interpolating =
            through.contains(&lanelet.id) || lanelet.types.iter().any(|word| word == INTERSECTION);
        for forward in if both { &[true, false][..] } else { &[true] } {
            let mut points = points.clone();
            if !forward {
                points.reverse();
            }
            drawn.push(map.lanes.len());
            map.lanes.push(Lane {
                lane_type,
                width_m: Some(((width_m * 1e3).round() / 1e3).clamp(0.1, 50.0)),
                speed_limit_mps: speed_limit(document, lanelet),
                interpolating,
                ..Lane::street(format!("{}{}", lanelet.id, if *forward { "" } else { AGAINST }), points)
            });
        }
    }
    if twice > 0 {
        warnings.push(ImportWarning::new("lanes-dropped", sentences::lanelets_with_used_id(twice)));
    }
    lanes
}

fn drives(users: &[String]) -> bool {
    users.iter().any(|user| !matches!(user.as_str(), "pedestrian" | "bicycle" | "bus" | "train"))
}

/// The middle line of a lanelet, from the file's own points if both sides have as many; and its width.
fn centre(lanelet: &Lanelet) -> (Vec<Vec2>, f64) {
    let (left, right) = (&lanelet.left.points, &lanelet.right.points);
    if left.len() == right.len() && left.len() <= MAX_POLYLINE_POINTS {
        return sides::halfway(left, right);
    }
    sides::middle(left, right)
}

fn speed_limit(document: &CommonRoadDocument, lanelet: &Lanelet) -> Option<f64> {
    let signs = lanelet.signs.iter().filter_map(|id| document.signs.get(id)).flat_map(|sign| &sign.elements);
    let limits = signs.filter(|(kind, _)| MAX_SPEED_SIGNS.contains(&kind.as_str())).filter_map(|(_, v)| *v);
    let limit = limits.reduce(f64::min).or(lanelet.speed_mps);
    limit.filter(|limit| (0.0..=100.0).contains(limit))
}

/// Links successors and neighbours in both directions.
fn link(lanelets: &[Lanelet], lanes: &Lanes, map: &mut LaneMap) {
    let lane = |id: i64, forward: bool| lanes.get(&id)?.get(usize::from(!forward)).copied();
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    for lanelet in lanelets {
        for forward in [true, false] {
            let Some(own) = lane(lanelet.id, forward) else { continue };
            let (after, before) = (&lanelet.successors, &lanelet.predecessors);
            let (after, before) = if forward { (after, before) } else { (before, after) };
            pairs.extend(after.iter().filter_map(|id| Some((own, lane(*id, forward)?))));
            pairs.extend(before.iter().filter_map(|id| Some((lane(*id, forward)?, own))));
        }
    }
    let mut known = HashSet::new();
    for (before, after) in pairs {
        if before != after && known.insert((before, after)) {
            let [first, second] = [before, after].map(|i| map.lanes[i].id.clone());
            map.lanes[before].successors.push(second);
            map.lanes[after].predecessors.push(first);
        }
    }
    let travelled = |lane: &Lane| lane.lane_type.carries_vehicles() || lane.lane_type.carries_cyclists();
    for lanelet in lanelets {
        let Some(own) = lane(lanelet.id, true).filter(|i| travelled(&map.lanes[*i])) else { continue };
        for (side, on_left) in [(&lanelet.left, true), (&lanelet.right, false)] {
            let Some((id, true)) = side.beside else { continue };
            let other = lane(id, true).filter(|other| *other != own && travelled(&map.lanes[*other]));
            let Some(other) = other else { continue };
            let whole = |i: usize| (0, map.lanes[i].points.xy.len() - 1);
            let neighbor = Neighbor {
                lane: map.lanes[other].id.clone(),
                own_range: whole(own),
                other_range: whole(other),
                boundaries: Vec::new(),
            };
            let own = &mut map.lanes[own];
            let beside = if on_left { &mut own.left_neighbors } else { &mut own.right_neighbors };
            if beside.is_empty() {
                beside.push(neighbor);
            }
        }
    }
}

/// Lines between the same two points are the same line.
type Ends = [(i64, i64); 2];

fn ends(points: &[Vec2]) -> Ends {
    let tenths = |p: Option<&Vec2>| p.map_or((0, 0), |p| ((p.x * 10.0) as i64, (p.y * 10.0) as i64));
    let mut ends = [tenths(points.first()), tenths(points.last())];
    ends.sort_unstable();
    ends
}

/// Draws the painted sides of lanelets, each once, and links them to the lanes that they bound.
fn paint(lanelets: &[Lanelet], lanes: &Lanes, map: &mut LaneMap) {
    let mut drawn: HashMap<Ends, usize> = HashMap::new();
    let mut done = HashSet::new();
    for lanelet in lanelets {
        let Some(own) = lanes.get(&lanelet.id).filter(|own| !own.is_empty() && done.insert(lanelet.id))
        else {
            continue;
        };
        for (side, on_left) in [(&lanelet.left, true), (&lanelet.right, false)] {
            let Some(line_type) = line_type(&side.marking) else { continue };
            let line = *drawn.entry(ends(&side.points)).or_insert_with(|| {
                let id = format!("{}.{}", lanelet.id, if on_left { "left" } else { "right" });
                map.road_lines.push(line_of(id, line_type, side));
                map.road_lines.len() - 1
            });
            let line = &map.road_lines[line];
            let kind = ROAD_LINE_TYPES.iter().position(|word| *word == line.line_type);
            let (id, kind) = (line.id.clone(), kind.and_then(|kind| u32::try_from(kind).ok()));
            for (lane, forward) in own.iter().zip([true, false]) {
                let lane = &mut map.lanes[*lane];
                let to = lane.points.xy.len() - 1;
                let boundary = Boundary { line: id.clone(), from: 0, to, kind };
                let left = on_left == forward;
                if left { &mut lane.left_boundary } else { &mut lane.right_boundary }.push(boundary);
            }
        }
    }
}

fn line_of(id: String, line_type: &str, side: &Side) -> TypedLine {
    let points = polyline::simplify(&side.points, 0.03, 20.0).into();
    TypedLine { id, line_type: line_type.to_owned(), points }
}

/// Draws the ground for vehicles, and its edges. False if there were too many areas to find edges.
fn ground(lanelets: &[Lanelet], lanes: &Lanes, map: &mut LaneMap) -> bool {
    let (mut strips, mut ways) = (Vec::new(), Vec::new());
    let mut done = HashSet::new();
    for lanelet in lanelets {
        let Some(own) = lanes.get(&lanelet.id).and_then(|own| own.first()).filter(|own| done.insert(**own))
        else {
            continue;
        };
        let lane = &map.lanes[*own];
        if lane.lane_type == LaneType::Sidewalk {
            continue;
        }
        let (mut right, mut left) = sides::matched(&lanelet.left.points, &lanelet.right.points);
        // Lanelets that the file lists as adjacent do not always touch.
        for (r, l) in right.iter_mut().zip(&mut left) {
            let out = (*r - *l) / (*r - *l).norm().max(1e-9) * BESIDE_M;
            *r += out * f64::from(u8::from(lanelet.right.beside.is_some()));
            *l -= out * f64::from(u8::from(lanelet.left.beside.is_some()));
        }
        let joined = [!lane.predecessors.is_empty(), !lane.successors.is_empty()];
        strips.push(Strip { right, left, inner: [false, true], joined, junction: lane.interpolating });
        ways.push(lane.points.xy.clone());
        let next = lanelet.successors.iter().filter_map(|id| lanes.get(id)?.first());
        let starts = next.filter_map(|next| map.lanes[*next].points.xy.first());
        ways.extend(
            starts
                .zip(std::iter::repeat(lane.points.xy.last()))
                .filter_map(|(start, end)| Some(vec![*end?, *start])),
        );
    }
    let mut next = 0;
    surface::draw(map, &strips, &ways, || {
        next += 1;
        next.to_string()
    })
}

/// Stop position of a lanelet: at its stop line, else at its end.
pub(super) fn stop(lanelet: &Lanelet, lane: &Lane) -> Option<Vec2> {
    let line = lanelet.stop.flatten().map(|(a, b)| (a + b) / 2.0);
    line.or_else(|| lane.points.xy.last().copied())
}

fn stop_signs(document: &CommonRoadDocument, lanes: &Lanes, map: &mut LaneMap) {
    let mut signs: BTreeMap<i64, StopSign> = BTreeMap::new();
    for lanelet in &document.lanelets {
        let Some(&lane) = lanes.get(&lanelet.id).and_then(|own| own.first()) else { continue };
        for id in &lanelet.signs {
            let stops = |sign: &&super::document::Sign| {
                sign.elements.iter().any(|(kind, _)| STOP_SIGNS.contains(&kind.as_str()))
            };
            let Some(sign) = document.signs.get(id).filter(stops) else { continue };
            let Some(position) = sign.position.or_else(|| stop(lanelet, &map.lanes[lane])) else { continue };
            let empty = || StopSign { id: id.to_string(), position, z_m: None, lanes: Vec::new() };
            let obeys = &mut signs.entry(*id).or_insert_with(empty).lanes;
            let lane = &map.lanes[lane].id;
            if !obeys.contains(lane) {
                obeys.push(lane.clone());
            }
        }
    }
    map.stop_signs.extend(signs.into_values());
}
