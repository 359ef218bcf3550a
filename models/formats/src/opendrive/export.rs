//! Writes a map as OpenDRIVE 1.7: each lane is a road of its own, so that its geometry is preserved.

use super::course;
use super::roads::{Road, RoadLink, Roads, roads};
use crate::driving_side::keeps_left;
use crate::format::{ExportOptions, Exported};
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::polyline::{arc_lengths, distance_to, length};
use crate::sentences;
use crate::written::BoundedFile;
use scene::geometry::polyline::Polyline;
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::map::{LaneMap, LaneType};
use scene::{MAX_COORDINATE_M, Scene, Vec2};
use std::collections::{BTreeMap, HashMap};
use std::io;

/// Length over which a lane takes the width of the previous one, metres.
const TAPER_M: f64 = 10.0;
/// Shortest road that is written, metres.
const SHORTEST_M: f64 = 0.01;
/// Lights, and stop signs of the German catalogue, on which OpenDRIVE's own is based.
const LIGHT: &str = "1000001";
const STOP_SIGN: &str = "206";
/// Date of all files, so that they do not depend on the time of writing.
const DAY: &str = "1970-01-01T00:00:00";

/// Driving side: the word for it, and the number of the single lane of each road, which runs along its road
/// on that side.
#[derive(Clone, Copy)]
struct WrittenSide {
    word: &'static str,
    lane: &'static str,
    side: &'static str,
    /// Direction from the reference line to the lane's outer border, in widths.
    outward: f64,
}

const RIGHT_HAND: WrittenSide = WrittenSide { word: "RHT", lane: "-1", side: "right", outward: -1.0 };
const LEFT_HAND: WrittenSide = WrittenSide { word: "LHT", lane: "1", side: "left", outward: 1.0 };

/// Id of the light of a signal of a scene, by its position.
pub(crate) fn light_id(signal: usize) -> String {
    (signal + 1).to_string()
}

/// Writes the map of a scene, in the scene's own frame.
///
/// # Errors
/// `InvalidInput` for a scene without a lane, since a map needs a road.
pub(crate) fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    let (file, losses) = document(scene, options)?;
    Ok(Exported { bytes: file.whole()?, losses })
}

/// The file, with its losses.
///
/// # Errors
/// Those of [`write`].
pub(crate) fn document(scene: &Scene, options: &ExportOptions) -> io::Result<(BoundedFile, Vec<Loss>)> {
    let drawn = roads(&scene.map);
    if drawn.roads.iter().all(|road| length(&road.points) < SHORTEST_M) {
        let message = crate::refusals::file_needs("OpenDRIVE", crate::refusals::what::LANE);
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let beside = Roadside::of(scene, &drawn);
    let rule = if keeps_left(&scene.map) { LEFT_HAND } else { RIGHT_HAND };
    let mut out = Markup::new(options.bounds());
    out.open("OpenDRIVE", &[]);
    header(scene, &mut out);
    let mut off_m = 0.0_f64;
    for (i, road) in drawn.roads.iter().enumerate() {
        out.check()?;
        off_m = off_m.max(write_road(i, (road, &drawn), (&scene.map, rule), &beside, &mut out));
    }
    for (number, connecting) in &drawn.junctions {
        out.check()?;
        write_junction(*number, connecting, (&drawn, rule), &mut out);
    }
    out.close();
    Ok((out.finish()?, losses(scene, &drawn, off_m)))
}

fn header(scene: &Scene, out: &mut Markup) {
    let points = || scene.map.lanes.iter().flat_map(|lane| &lane.points.xy);
    let first = points().next().copied().unwrap_or_default();
    let (low, high) = points().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
    out.open(
        "header",
        &[
            ("revMajor", "1"),
            ("revMinor", "7"),
            ("name", &scene.name),
            ("version", "1"),
            ("date", DAY),
            ("north", &decimal(high.y)),
            ("south", &decimal(low.y)),
            ("east", &decimal(high.x)),
            ("west", &decimal(low.x)),
            ("vendor", "DragTraffic"),
        ],
    );
    let origin = &scene.meta.origin;
    if let Some(crs) = &origin.crs {
        out.leaf("geoReference", crs);
        let place = [
            ("x", &*decimal(origin.x_m)),
            ("y", &*decimal(origin.y_m)),
            ("z", &*decimal(origin.z_m)),
            ("hdg", &*decimal(origin.rotation_rad)),
        ];
        out.empty("offset", &place);
    }
    if let Some(licence) = scene.licence() {
        out.empty("userData", &[("code", "licence"), ("value", &licence)]);
    }
    out.close();
}

/// Objects beside each road.
#[derive(Default)]
struct Roadside {
    /// Lights: index among the scene's, and stop position.
    lights: BTreeMap<usize, Vec<(usize, Vec2)>>,
    stop_signs: BTreeMap<usize, Vec<(usize, Vec2)>>,
    crosswalks: BTreeMap<usize, Vec<usize>>,
    /// Number of signals that belong to no road.
    lost_signals: usize,
}

impl Roadside {
    fn of(scene: &Scene, drawn: &Roads<'_>) -> Self {
        let mut beside = Self::default();
        let lanes: HashMap<&str, usize> =
            scene.map.lanes.iter().enumerate().map(|(i, lane)| (lane.id.as_str(), i)).collect();
        for (i, signal) in scene.signals.iter().enumerate() {
            let Some(lane) = lanes.get(signal.lane.as_str()) else {
                beside.lost_signals += 1;
                continue;
            };
            let first = drawn.roads[*lane].points.first().copied().unwrap_or_default();
            beside.lights.entry(*lane).or_default().push((i, signal.stop.unwrap_or(first)));
        }
        for (i, sign) in scene.map.stop_signs.iter().enumerate() {
            for lane in sign.lanes.iter().filter_map(|id| lanes.get(id.as_str())) {
                beside.stop_signs.entry(*lane).or_default().push((i, sign.position));
            }
        }
        let lines = drawn.roads.iter().take(scene.map.lanes.len()).zip(0..);
        let lines = SegmentIndex::new(lines.flat_map(|(road, i)| pieces(&road.points, i)).collect());
        for (i, area) in scene.map.crosswalks.iter().enumerate() {
            let nearest = lines.nearest(middle(&area.polygon.xy), 4.0 * MAX_COORDINATE_M);
            let road = nearest.map_or(0, |(piece, ..)| piece.owner as usize);
            beside.crosswalks.entry(road).or_default().push(i);
        }
        beside
    }
}

fn middle(ring: &[Vec2]) -> Vec2 {
    ring.iter().sum::<Vec2>() / ring.len().max(1) as f64
}

/// Writes a road; returns the distance between its reference line and the centre line, metres.
fn write_road(
    number: usize,
    (road, drawn): (&Road<'_>, &Roads<'_>),
    (map, rule): (&LaneMap, WrittenSide),
    beside: &Roadside,
    out: &mut Markup,
) -> f64 {
    let line = road.line();
    let pieces = course::pieces(road, drawn);
    let total = course::length(&pieces);
    let lane = road.lane;
    out.open(
        "road",
        &[
            ("name", &lane.id),
            ("length", &decimal(total)),
            ("id", &number.to_string()),
            ("junction", &road.junction.map_or("-1".to_owned(), |j| junction_id(j, drawn))),
            ("rule", rule.word),
        ],
    );
    out.open("link", &[]);
    for (name, link, contact) in
        [("predecessor", road.predecessor, "end"), ("successor", road.successor, "start")]
    {
        match link {
            Some(RoadLink::Road(other)) => out.empty(
                name,
                &[("elementType", "road"), ("elementId", &other.to_string()), ("contactPoint", contact)],
            ),
            Some(RoadLink::Junction(other)) => {
                out.empty(name, &[("elementType", "junction"), ("elementId", &junction_id(other, drawn))]);
            }
            None => {}
        }
    }
    out.close();
    speed(road, out);
    out.open("planView", &[]);
    course::write(&pieces, out);
    out.close();
    heights(road, out);
    lanes((road, rule), drawn, total, out);
    let path = Polyline::new(line.iter().copied());
    crosswalks(number, &path, map, beside, out);
    signals((number, rule), &path, beside, out);
    out.close();
    road.points.iter().map(|p| distance_to(line, *p)).fold(0.0, f64::max)
}

fn speed(road: &Road<'_>, out: &mut Markup) {
    let kind = match road.lane.lane_type {
        LaneType::Freeway => "motorway",
        LaneType::BikeLane => "bicycle",
        LaneType::Sidewalk => "pedestrian",
        _ => "town",
    };
    out.open("type", &[("s", "0"), ("type", kind)]);
    if let Some(limit_mps) = road.lane.speed_limit_mps {
        out.empty("speed", &[("max", &decimal(limit_mps)), ("unit", "m/s")]);
    }
    out.close();
}

/// Heights at the points of the lane, interpolated linearly.
fn heights(road: &Road<'_>, out: &mut Markup) {
    let Some(z_m) = &road.lane.points.z_m else { return };
    let arc = arc_lengths(&road.lane.points.xy);
    let total = length(&road.lane.points.xy);
    // A road that is a part of its lane begins where it begins, or ends where it ends.
    let from = match road.points.first() == road.lane.points.xy.first() {
        true => 0.0,
        false => total - length(&road.points),
    };
    out.open("elevationProfile", &[]);
    let mut begun = false;
    for ((s, z), next) in arc.windows(2).zip(z_m.windows(2)).zip(arc.iter().skip(1)) {
        let slope = (z[1] - z[0]) / (s[1] - s[0]).max(1e-9);
        if *next <= from || s[0] - from >= length(&road.points) || (begun && (z[1] - z[0]).abs() < 1e-9) {
            continue;
        }
        let start = (s[0] - from).max(0.0);
        let height = z[0] + slope * (start + from - s[0]);
        out.empty(
            "elevation",
            &[
                ("s", &decimal(start)),
                ("a", &decimal(height)),
                ("b", &decimal(slope)),
                ("c", "0"),
                ("d", "0"),
            ],
        );
        begun = true;
    }
    if !begun {
        let height = z_m.first().copied().unwrap_or_default();
        out.empty("elevation", &[("s", "0"), ("a", &decimal(height)), ("b", "0"), ("c", "0"), ("d", "0")]);
    }
    out.close();
}

/// Widths along a road, interpolated linearly: position and width, metres. Roads that meet have the same
/// width there.
fn widths(road: &Road<'_>, drawn: &Roads<'_>, total: f64) -> Vec<(f64, f64)> {
    let width = |road: &Road<'_>| road.lane.width_or_assumed_m();
    let at = |link: Option<RoadLink>| match link {
        Some(RoadLink::Road(other)) => Some(width(&drawn.roads[other])),
        _ => None,
    };
    let own = width(road);
    match (road.junction, at(road.predecessor), at(road.successor)) {
        (Some(_), Some(from), Some(to)) => vec![(0.0, from), (total, to)],
        (_, Some(from), _) if from != own => vec![(0.0, from), (TAPER_M.min(total), own)],
        _ => vec![(0.0, own)],
    }
}

/// The single lane, whose middle is the reference line.
fn lanes((road, rule): (&Road<'_>, WrittenSide), drawn: &Roads<'_>, total: f64, out: &mut Markup) {
    let kind = match road.lane.lane_type {
        LaneType::BikeLane => "biking",
        LaneType::Sidewalk => "sidewalk",
        LaneType::Parking => "parking",
        LaneType::BusLane => "bus",
        _ => "driving",
    };
    let widths = widths(road, drawn, total);
    // From each position: the width there, and its increase per metre.
    let pieces: Vec<(f64, f64, f64)> = widths
        .iter()
        .enumerate()
        .filter(|(i, (s, _))| *i == 0 || total - s > SHORTEST_M)
        .map(|(i, (s, width))| {
            let next = widths.get(i + 1).map_or(0.0, |(t, wide)| (wide - width) / (t - s).max(SHORTEST_M));
            (*s, *width, next)
        })
        .collect();
    let cubic = |name, place, s: f64, a: f64, b: f64, out: &mut Markup| {
        let numbers =
            [(place, &*decimal(s)), ("a", &*decimal(a)), ("b", &*decimal(b)), ("c", "0"), ("d", "0")];
        out.empty(name, &numbers);
    };
    out.open("lanes", &[]);
    for (s, width, slope) in &pieces {
        cubic("laneOffset", "s", *s, -rule.outward * width / 2.0, -rule.outward * slope / 2.0, out);
    }
    let centre = |out: &mut Markup| {
        out.open("center", &[]);
        out.open("lane", &[("id", "0"), ("type", "none"), ("level", "false")]);
        out.close();
        out.close();
    };
    out.open("laneSection", &[("s", "0")]);
    // The standard requires the order left, centre, right.
    if rule.side == "right" {
        centre(out);
    }
    out.open(rule.side, &[]);
    out.open("lane", &[("id", rule.lane), ("type", kind), ("level", "false")]);
    out.open("link", &[]);
    for (name, link) in [("predecessor", road.predecessor), ("successor", road.successor)] {
        if let Some(RoadLink::Road(_)) = link {
            out.empty(name, &[("id", rule.lane)]);
        }
    }
    out.close();
    for (s, width, slope) in &pieces {
        cubic("width", "sOffset", *s, *width, *slope, out);
    }
    out.close();
    out.close();
    if rule.side == "left" {
        centre(out);
    }
    out.close();
    out.close();
}

fn crosswalks(number: usize, path: &Polyline, map: &LaneMap, beside: &Roadside, out: &mut Markup) {
    let Some(areas) = beside.crosswalks.get(&number) else { return };
    out.open("objects", &[]);
    for i in areas {
        let ring = &map.crosswalks[*i].polygon.xy;
        let middle = middle(ring);
        let foot = path.project(middle);
        let turned = |p: &Vec2| scene::geometry::rotate(p - middle, -foot.heading_rad);
        out.open(
            "object",
            &[
                ("type", "crosswalk"),
                ("id", &format!("crosswalk{i}")),
                ("name", "crosswalk"),
                ("s", &decimal(foot.s_m)),
                ("t", &decimal(foot.lateral_m)),
                ("zOffset", "0"),
                ("hdg", "0"),
                ("orientation", "none"),
            ],
        );
        out.open("outlines", &[]);
        out.open("outline", &[("id", "0"), ("closed", "true"), ("outer", "true")]);
        for (k, corner) in ring.iter().map(turned).enumerate() {
            out.empty(
                "cornerLocal",
                &[
                    ("u", &decimal(corner.x)),
                    ("v", &decimal(corner.y)),
                    ("z", "0"),
                    ("height", "0"),
                    ("id", &k.to_string()),
                ],
            );
        }
        out.close();
        out.close();
        out.close();
    }
    out.close();
}

fn signals((number, rule): (usize, WrittenSide), path: &Polyline, beside: &Roadside, out: &mut Markup) {
    let (lights, signs) = (beside.lights.get(&number), beside.stop_signs.get(&number));
    if lights.is_none() && signs.is_none() {
        return;
    }
    out.open("signals", &[]);
    let mut write = |id: &str, place: Vec2, dynamic: &str, kind: [&str; 2], name: &str| {
        let foot = path.project(place);
        out.open(
            "signal",
            &[
                ("s", &decimal(foot.s_m)),
                ("t", &decimal(foot.lateral_m)),
                ("id", id),
                ("name", name),
                ("dynamic", dynamic),
                ("orientation", "+"),
                ("zOffset", "3"),
                ("country", kind[0]),
                ("type", kind[1]),
                ("subtype", "-1"),
                ("hOffset", "0"),
            ],
        );
        out.empty("validity", &[("fromLane", rule.lane), ("toLane", rule.lane)]);
        out.close();
    };
    for (i, stop) in lights.into_iter().flatten() {
        write(&light_id(*i), *stop, "yes", ["OpenDRIVE", LIGHT], "light");
    }
    for (i, place) in signs.into_iter().flatten() {
        write(&format!("stop{i}-{number}"), *place, "no", ["DE", STOP_SIGN], "stop");
    }
    out.close();
}

fn junction_id(number: usize, drawn: &Roads<'_>) -> String {
    (drawn.roads.len() + number).to_string()
}

fn write_junction(
    number: usize,
    connecting: &[usize],
    (drawn, rule): (&Roads<'_>, WrittenSide),
    out: &mut Markup,
) {
    let id = junction_id(number, drawn);
    out.open("junction", &[("name", &format!("junction {id}")), ("id", &id), ("type", "default")]);
    for (k, road) in connecting.iter().enumerate() {
        let Some(RoadLink::Road(incoming)) = drawn.roads[*road].predecessor else { continue };
        out.open(
            "connection",
            &[
                ("id", &k.to_string()),
                ("incomingRoad", &incoming.to_string()),
                ("connectingRoad", &road.to_string()),
                ("contactPoint", "start"),
            ],
        );
        out.empty("laneLink", &[("from", rule.lane), ("to", rule.lane)]);
        out.close();
    }
    out.close();
}

fn losses(scene: &Scene, drawn: &Roads<'_>, off_m: f64) -> Vec<Loss> {
    let map: &LaneMap = &scene.map;
    let mut losses = Vec::new();
    let drawn = sentences::loss_lane_lines(1e3 * off_m, drawn.cut);
    losses.push(Loss::counted(code::GEOMETRY_APPROXIMATED, drawn));
    let mut lose = |lost: bool, code, detail: String| losses.extend(lost.then(|| Loss::new(code, detail)));
    lose(!scene.agents.is_empty(), code::NO_ROAD_USERS, "road users and their motion".into());
    let lines = !map.road_lines.is_empty() || !map.road_edges.is_empty();
    lose(lines, code::NO_LINES, "painted lines and road edges".into());
    lose(!map.drivable.is_empty(), code::NO_DRIVABLE, "drivable areas".into());
    let areas = !map.speed_bumps.is_empty() || !map.driveways.is_empty();
    lose(areas, code::NO_AREAS, "speed bumps and driveways".into());
    let beside =
        |lane: &scene::map::Lane| !lane.left_neighbors.is_empty() || !lane.right_neighbors.is_empty();
    lose(map.lanes.iter().any(beside), code::NO_NEIGHBORS, "which lanes lie beside each other".into());
    lose(!scene.signals.is_empty(), code::NO_SIGNALS, "what signals show: their heads are there".into());
    losses
}
