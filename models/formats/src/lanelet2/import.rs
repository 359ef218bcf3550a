//! Reads a Lanelet2 map as a scene about the origin.

use super::lanelets::{Lanelet, is, lanelets};
use super::osm::{self, Osm, Tags};
use crate::around::{Around, Chosen, MapPart};
use crate::format::MAP_TIMING;
use crate::lights::{self, SignalHead, heading_at};
use crate::map_file::{self, MapRead};
use crate::problem::{ImportWarning, ReadError};
use crate::projection::TransverseMercator;
use crate::refusals::{self, what};
use crate::sentences;
use crate::sides::LaneletKind;
use crate::source::Source;
use crate::surface::{self, Strip};
use crate::{bounds, polyline};
use scene::map::{Area, Boundary, Lane, LaneMap, LaneType, Neighbor, ROAD_LINE_TYPES, StopSign, TypedLine};
use scene::{Origin, Vec2};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Greatest distance between signal heads of one junction, metres.
const JUNCTION_M: f64 = 60.0;

/// Reads a file, plain or gzip: a scene with a map and signals, without road users.
///
/// # Errors
/// Those of the file, `cannot-represent` for one without lanelets, `map-too-large`.
pub(super) fn read(file: &dyn Source, around: Option<Around>) -> Result<MapRead, ReadError> {
    let mut chosen = Chosen::of(around);
    let mut osm = osm::read(file, &mut chosen)?;
    if let (0, Some(message)) = (osm.relations.len(), chosen.nothing()) {
        return Err(ReadError::other_content(message));
    }
    let asked = around;
    // In a file of degrees, the circle gets its position once they are metres.
    let around = match (around, &osm.projection) {
        (Some(around), Some(projection)) => {
            let middle = projection.metres(around.y, around.x);
            Some(Around { x: middle.x, y: middle.y, ..around })
        }
        (around, _) => around,
    };
    let origin = about_the_middle(&mut osm, around)?;
    let (lanelets, broken) = lanelets(&osm);
    let mut map = LaneMap::default();
    let lanes = draw(&lanelets, &mut map);
    if map.lanes.is_empty() {
        let closed = osm.relations.iter().any(|relation| is(&relation.tags, "type", "lanelet"));
        let closed = closed && map.crosswalks.is_empty();
        let message = if closed { refusals::no_open_lanelets() } else { refusals::no_lanelets() };
        return Err(ReadError::other_content(message));
    }
    link(&lanelets, &lanes, &mut map);
    paint(&osm, &lanelets, &lanes, &mut map);
    let whole = ground(&lanelets, &mut map);
    bounds::by_edges(&mut map);
    let heads = rules(&osm, &lanelets, &lanes, &mut map);
    let (signals, made) = lights::signals(&map, heads, MAP_TIMING.steps);
    let mut warnings = Vec::new();
    let unusable = || ImportWarning::new("lanes-dropped", sentences::lanelets_unusable(broken));
    warnings.extend((broken > 0).then(unusable));
    warnings.extend((!whole).then(|| ImportWarning::new("edges-dropped", sentences::crossing_lanelets())));
    warnings.extend(made);
    let crs = osm.projection.filter(TransverseMercator::has_place).map(|projection| projection.name());
    let mut placed = Chosen::of(around);
    placed.left_out = chosen.left_out;
    let part = placed.part(origin, what::LANES);
    let origin = Origin { x_m: origin.x, y_m: origin.y, crs, ..Origin::default() };
    let part = part.zip(asked).map(|(part, around)| MapPart { around, ..part });
    Ok(MapRead { name: String::new(), map: map.into(), signals, origin, warnings, part })
}

/// Moves all points by whole metres, so that the middle of the lanelets' lines is the origin.
fn about_the_middle(osm: &mut Osm, around: Option<Around>) -> Result<Vec2, ReadError> {
    let members = osm.relations.iter().filter(|r| is(&r.tags, "type", "lanelet")).flat_map(|r| &r.members);
    let nodes = members.filter_map(|member| osm.ways.get(&member.id)).flat_map(|way| &way.nodes);
    let corners =
        nodes.filter_map(|node| osm.nodes.get(node)).fold(None, |corners: Option<(Vec2, Vec2)>, p| {
            Some(corners.map_or((*p, *p), |(low, high)| (low.inf(p), high.sup(p))))
        });
    let (low, high) = corners.unwrap_or_default();
    let (middle, half) = (((low + high) / 2.0).map(f64::round), (high - low) / 2.0);
    let middle = Chosen::of(around).origin().unwrap_or(middle);
    if around.is_none() && map_file::is_too_wide(half) {
        return Err(ReadError::map_too_large(map_file::extent(half)));
    }
    osm.nodes.values_mut().for_each(|p| *p -= middle);
    Ok(middle)
}

/// Draws lanes and crosswalks. Returns the lanes of each lanelet: with its direction, and against it.
fn draw(lanelets: &[Lanelet<'_>], map: &mut LaneMap) -> Vec<Vec<usize>> {
    let mut ids = HashSet::new();
    let mut lanes = Vec::new();
    for lanelet in lanelets {
        let mut drawn = Vec::new();
        let LaneletKind::Lane(lane_type) = lanelet.kind else {
            let ring: Vec<Vec2> = lanelet.right.iter().chain(lanelet.left.iter().rev()).copied().collect();
            let area = Area { id: lanelet.id.to_string(), polygon: ring.into(), holes: Vec::new() };
            map.crosswalks.extend((!map.crosswalks.iter().any(|other| other.id == area.id)).then_some(area));
            lanes.push(drawn);
            continue;
        };
        let (points, width_m) = lanelet.middle();
        let tags = &lanelet.relation.tags;
        let walked = lane_type == LaneType::Sidewalk;
        let ways: &[bool] = if lanelet.two_way() && !walked { &[true, false] } else { &[true] };
        for forward in ways {
            let id = format!("{}{}", lanelet.id, if *forward { "" } else { map_file::AGAINST });
            if !ids.insert(id.clone()) {
                continue;
            }
            let mut points = points.clone();
            if !forward {
                points.reverse();
            }
            drawn.push(map.lanes.len());
            map.lanes.push(Lane {
                lane_type,
                width_m: Some(((width_m * 1e3).round() / 1e3).clamp(0.1, 50.0)),
                speed_limit_mps: ["speed_limit:vehicle", "speed_limit"]
                    .iter()
                    .find_map(|key| speed(tags.get(*key)?))
                    .filter(|_| !walked),
                interpolating: tags.contains_key("turn_direction") && !walked,
                ..Lane::street(id, points)
            });
        }
        lanes.push(drawn);
    }
    lanes
}

/// A limit such as `50`, `50 km/h` or `30 mph`, in m/s.
fn speed(text: &str) -> Option<f64> {
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let value: f64 = text.get(..end)?.parse().ok()?;
    let unit = match text.get(end..)?.trim() {
        "mph" => 0.447_04,
        "m/s" | "mps" => 1.0,
        _ => 1.0 / 3.6,
    };
    let limit = (value * unit * 1e3).round() / 1e3;
    (limit > 0.0 && limit <= 100.0).then_some(limit)
}

/// The limit of a sign such as `de274-60`, or of a type that is itself a speed, in m/s.
fn sign_limit(sign_type: &str) -> Option<f64> {
    let text = sign_type.trim().to_ascii_lowercase();
    let number =
        |text: &str, unit: &str| speed(&format!("{} {unit}", text.trim_start_matches(['-', ':', '_'])));
    let german = text.strip_prefix("de").unwrap_or(&text);
    if let Some(rest) = german.strip_prefix("274.1").or_else(|| german.strip_prefix("274")) {
        return if rest.is_empty() { speed("30") } else { number(rest, "km/h") };
    }
    match german {
        "310" => return speed("50"),
        "325" | "325.1" => return speed("7"),
        _ => {}
    }
    if let Some(rest) = text.strip_prefix("us").unwrap_or(&text).strip_prefix("r2-1") {
        return number(rest, "mph");
    }
    speed(&text)
}

/// Lanelets follow each other if the ends of both sides are the same points, and lie side by side if they
/// share a line.
fn link(lanelets: &[Lanelet<'_>], lanes: &[Vec<usize>], map: &mut LaneMap) {
    // Starts and ends of lanes, with the side that is to the left there.
    let mut starts: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    let mut ends: Vec<(usize, (i64, i64))> = Vec::new();
    let mut on_right: HashMap<i64, Vec<usize>> = HashMap::new();
    let mut on_left: Vec<(usize, i64)> = Vec::new();
    for (lanelet, drawn) in lanelets.iter().zip(lanes) {
        let [left, right] = lanelet.ends;
        for (lane, forward) in drawn.iter().zip([true, false]) {
            let (start, end) = if forward {
                ((left.0, right.0), (left.1, right.1))
            } else {
                ((right.1, left.1), (right.0, left.0))
            };
            starts.entry(start).or_default().push(*lane);
            ends.push((*lane, end));
        }
        if let [lane] = drawn.as_slice() {
            lanelet.ways[1].iter().for_each(|way| on_right.entry(*way).or_default().push(*lane));
            on_left.extend(lanelet.ways[0].iter().map(|way| (*lane, *way)));
        }
    }
    for (lane, end) in ends {
        // Links between roads and ways for pedestrians only are left out.
        let walked = |lane: usize| map.lanes[lane].lane_type == LaneType::Sidewalk;
        let follows = |next: &&usize| **next != lane && walked(**next) == walked(lane);
        let following: Vec<usize> = starts.get(&end).into_iter().flatten().filter(follows).copied().collect();
        for next in following {
            let [before, after] = [lane, next].map(|i| map.lanes[i].id.clone());
            map.lanes[lane].successors.push(after);
            map.lanes[next].predecessors.push(before);
        }
    }
    let travelled = |lane: &Lane| lane.lane_type.carries_vehicles() || lane.lane_type.carries_cyclists();
    let mut done = HashSet::new();
    for (right, way) in on_left {
        for left in on_right.get(&way).into_iter().flatten().copied().filter(|left| *left != right) {
            // Two sides may share several lines.
            if !done.insert((left, right)) {
                continue;
            }
            let ways = [left, right].map(|i| {
                let points = &map.lanes[i].points.xy;
                points[points.len() - 1] - points[0]
            });
            // Some of the lanes that share a line have the opposite direction.
            if ways[0].dot(&ways[1]) <= 0.0 || !travelled(&map.lanes[left]) || !travelled(&map.lanes[right]) {
                continue;
            }
            let whole = |i: usize| (0, map.lanes[i].points.xy.len() - 1);
            let neighbor = |own: usize, other: usize| Neighbor {
                lane: map.lanes[other].id.clone(),
                own_range: whole(own),
                other_range: whole(other),
                boundaries: Vec::new(),
            };
            let (to_left, to_right) = (neighbor(right, left), neighbor(left, right));
            map.lanes[right].left_neighbors.push(to_left);
            map.lanes[left].right_neighbors.push(to_right);
        }
    }
}

/// The word for a painted line.
fn line_type(tags: &Tags) -> Option<&'static str> {
    if !matches!(tags.get("type").map(String::as_str), Some("line_thin" | "line_thick")) {
        return None;
    }
    let yellow = is(tags, "color", "yellow");
    Some(match (tags.get("subtype").map_or("solid", String::as_str), yellow) {
        ("dashed", false) => "broken_single_white",
        ("dashed", true) => "broken_single_yellow",
        ("solid_solid" | "solid_dashed" | "dashed_solid", false) => "solid_double_white",
        ("solid_solid", true) => "solid_double_yellow",
        ("solid_dashed" | "dashed_solid", true) => "passing_double_yellow",
        (_, false) => "solid_single_white",
        (_, true) => "solid_single_yellow",
    })
}

/// Draws the painted sides of lanelets, each once, and links them to the lanes that they bound.
fn paint(osm: &Osm, lanelets: &[Lanelet<'_>], lanes: &[Vec<usize>], map: &mut LaneMap) {
    let mut done = HashSet::new();
    for (lanelet, drawn) in lanelets.iter().zip(lanes) {
        let ways =
            lanelet.ways.iter().enumerate().flat_map(|(side, ways)| ways.iter().map(move |way| (side, way)));
        for (side, way) in ways {
            let Some((line, line_type)) =
                osm.ways.get(way).and_then(|way| Some((way, line_type(&way.tags)?)))
            else {
                continue;
            };
            let whole = lanelet.ways[side].len() == 1;
            let own = || line.nodes.iter().filter_map(|node| osm.nodes.get(node).copied()).collect();
            let points: Vec<Vec2> = match (whole, side) {
                (false, _) => own(),
                (true, 0) => lanelet.left.clone(),
                (true, _) => lanelet.right.clone(),
            };
            if points.len() < 2 {
                continue;
            }
            let kind = ROAD_LINE_TYPES.iter().position(|word| *word == line_type);
            for (lane, forward) in drawn.iter().zip([true, false]) {
                let lane = &mut map.lanes[*lane];
                let (from, to) =
                    if whole { (0, lane.points.xy.len() - 1) } else { beside(&lane.points.xy, &points) };
                let kind = kind.and_then(|kind| u32::try_from(kind).ok());
                let boundary = Boundary { line: way.to_string(), from, to, kind };
                let left = (side == 0) == forward;
                if left { &mut lane.left_boundary } else { &mut lane.right_boundary }.push(boundary);
            }
            if done.insert(*way) {
                let points = polyline::simplify(&points, 0.03, 20.0).into();
                map.road_lines.push(TypedLine { id: way.to_string(), line_type: line_type.into(), points });
            }
        }
    }
}

/// First and last point of a lane beside a line.
fn beside(lane: &[Vec2], line: &[Vec2]) -> (usize, usize) {
    let near = |p: Vec2| {
        let by_distance = |a: &usize, b: &usize| (lane[*a] - p).norm().total_cmp(&(lane[*b] - p).norm());
        (0..lane.len()).min_by(by_distance).unwrap_or_default()
    };
    let ends = (near(line[0]), near(line[line.len() - 1]));
    (ends.0.min(ends.1), ends.0.max(ends.1))
}

/// Draws the ground for vehicles, and its edges.
fn ground(lanelets: &[Lanelet<'_>], map: &mut LaneMap) -> bool {
    let by_id: HashMap<String, usize> =
        map.lanes.iter().enumerate().map(|(i, l)| (l.id.clone(), i)).collect();
    let (mut strips, mut ways) = (Vec::new(), Vec::new());
    for lanelet in lanelets {
        let Some(lane) = by_id.get(&lanelet.id.to_string()).map(|i| &map.lanes[*i]) else { continue };
        let LaneletKind::Lane(kind) = lanelet.kind else { continue };
        if !kind.carries_vehicles() && kind != LaneType::BikeLane {
            continue;
        }
        let (right, left) = lanelet.sides();
        let joined = [!lane.predecessors.is_empty(), !lane.successors.is_empty()];
        let junction = lane.interpolating;
        strips.push(Strip { right, left, inner: [false, true], joined, junction });
        ways.push(lane.points.xy.clone());
        for next in lane.successors.iter().filter_map(|id| by_id.get(id)) {
            let ends = (lane.points.xy.last(), map.lanes[*next].points.xy.first());
            ways.extend(ends.0.zip(ends.1).map(|(end, start)| vec![*end, *start]));
        }
    }
    let mut next = 0;
    surface::draw(map, &strips, &ways, || {
        next += 1;
        next.to_string()
    })
}

/// Finds signal heads, and draws stop signs.
fn rules(osm: &Osm, lanelets: &[Lanelet<'_>], lanes: &[Vec<usize>], map: &mut LaneMap) -> Vec<SignalHead> {
    let all = osm.relations.iter().filter(|r| is(&r.tags, "type", "regulatory_element"));
    let by_id: HashMap<i64, &osm::OsmRelation> = all.map(|rule| (rule.id, rule)).collect();
    let middle = |way: i64| {
        let nodes = &osm.ways.get(&way)?.nodes;
        let points: Vec<Vec2> = nodes.iter().filter_map(|node| osm.nodes.get(node).copied()).collect();
        (!points.is_empty()).then(|| points.iter().sum::<Vec2>() / points.len() as f64)
    };
    let mut heads: Vec<SignalHead> = Vec::new();
    let mut places: Vec<Vec2> = Vec::new();
    let mut signs: BTreeMap<i64, StopSign> = BTreeMap::new();
    for (lanelet, drawn) in lanelets.iter().zip(lanes) {
        let ruled = |i: &&usize| {
            let kind = map.lanes[**i].lane_type;
            kind.carries_vehicles() || kind.carries_cyclists()
        };
        let Some(&lane) = drawn.first().filter(ruled) else { continue };
        let points = map.lanes[lane].points.xy.clone();
        let rules = lanelet.relation.members.iter().filter(|member| member.role == "regulatory_element");
        for rule in rules.filter_map(|member| by_id.get(&member.id)) {
            let line = rule.member("ref_line").and_then(middle);
            let stop = if map.lanes[lane].interpolating { points.first() } else { points.last() };
            let (Some(&stop), subtype) = (stop, rule.tags.get("subtype").map_or("", String::as_str)) else {
                continue;
            };
            if subtype == "traffic_light" && !heads.iter().any(|head| head.lane == lane) {
                let stop =
                    line.filter(|_| !map.lanes[lane].interpolating).map_or(stop, |p| nearest(&points, p));
                let near = places.iter().position(|place| (place - stop).norm() < JUNCTION_M);
                let junction = near.unwrap_or_else(|| {
                    places.push(stop);
                    places.len() - 1
                });
                let heading_rad = heading_at(&points, stop);
                heads.push(SignalHead {
                    lane,
                    stop,
                    heading_rad,
                    junction: format!("{junction:06}"),
                    group: None,
                });
            }
            let sign_type = rule.tags.get("sign_type").map_or("", String::as_str);
            if subtype == "speed_limit" {
                let signs = rule.all("refers").filter_map(|way| osm.ways.get(&way)?.tags.get("subtype"));
                let stated = ["sign_type", "speed_limit"].into_iter().filter_map(|key| rule.tags.get(key));
                if let Some(limit) = stated.chain(signs).find_map(|text| sign_limit(text)) {
                    drawn.iter().for_each(|lane| map.lanes[*lane].speed_limit_mps = Some(limit));
                }
                continue;
            }
            if subtype == "traffic_sign" && matches!(sign_type, "de206" | "usR1-1" | "stop_sign") {
                let position = rule.member("refers").and_then(middle).or(line).unwrap_or(stop);
                let sign = StopSign { id: rule.id.to_string(), position, z_m: None, lanes: Vec::new() };
                signs.entry(rule.id).or_insert(sign).lanes.push(map.lanes[lane].id.clone());
            }
        }
    }
    map.stop_signs = signs.into_values().collect();
    heads
}

fn nearest(points: &[Vec2], p: Vec2) -> Vec2 {
    let by_distance = |a: &&Vec2, b: &&Vec2| (*a - p).norm().total_cmp(&(*b - p).norm());
    points.iter().min_by(by_distance).copied().unwrap_or(p)
}
