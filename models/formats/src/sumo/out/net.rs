//! Writes a network for SUMO (`net.xml`): lanes at their positions, with links, right of way and signals.

use super::network::{Edge, ExportedNetwork, Junction, LaneRole, Link, is_motorway};
use super::yields::{LinkPriority, letters};
use crate::format::{ExportOptions, Exported};
use crate::loss::{Loss, code};
use crate::markup::{Markup, decimal};
use crate::polyline::{distance_to, length, resample};
use crate::sentences;
use crate::sumo::map::{MAX_PIECES, SPACING_M};
use crate::written::{BoundedFile, FileBounds};
use scene::map::{Lane, LaneMap, LaneType};
use scene::routes::assumed_speed_limit_mps;
use scene::{STEP_S, Scene, SignalState, Vec2};
use std::io;

/// Links with a greater angle than the first are turns, and than the second U-turns, radians.
const TURNS_RAD: (f64, f64) = (0.6, 2.6);
/// Word in the types of edges that are motorways.
const MOTORWAY: &str = "highway.motorway";

/// Writes the map of a scene, in the frame of its source.
///
/// # Errors
/// `InvalidInput` for a scene without a lane.
pub(in crate::sumo) fn write(scene: &Scene, options: &ExportOptions) -> io::Result<Exported> {
    let network = ExportedNetwork::of(scene);
    let (_, steps) = options.motion.all(scene);
    let Some(file) = document(scene, &network, steps, options.bounds())? else {
        let message = crate::refusals::file_needs("SUMO", crate::refusals::what::LANE);
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    };
    let mut losses = losses(scene, &network);
    let made = |junction: &Junction| never_green(scene, junction, steps).contains(&true);
    if network.junctions.iter().any(made) {
        let detail = "lights that are never green turn green for 10 s after the motion";
        losses.push(Loss::new(code::NO_SIGNAL_STATES, detail));
    }
    if !scene.agents.is_empty() {
        losses.push(Loss::new(code::NO_ROAD_USERS, "road users and their motion"));
    }
    Ok(Exported { bytes: file.whole()?, losses })
}

/// The file, with signals over this many steps; nothing for a map without lanes.
pub(super) fn document(
    scene: &Scene,
    network: &ExportedNetwork<'_>,
    steps: usize,
    bounds: FileBounds,
) -> io::Result<Option<BoundedFile>> {
    if network.edges.is_empty() {
        return Ok(None);
    }
    let mut out = Markup::new(bounds);
    out.open("net", &[("version", "1.20"), ("junctionCornerDetail", "5"), ("limitTurnSpeed", "-1")]);
    location(scene, network, &mut out);
    for junction in &network.junctions {
        for (lane, id) in junction.links.iter().flat_map(|link| &link.via) {
            out.open("edge", &[("id", id), ("function", "internal")]);
            write_lane(network, *lane, &format!("{id}_0"), 0, &mut out);
            out.close();
        }
    }
    for edge in &network.edges {
        out.check()?;
        write_edge(network, edge, &mut out);
    }
    for junction in network.junctions.iter().filter(|junction| !junction.lights.is_empty()) {
        lights(scene, junction, steps, &mut out);
    }
    for junction in &network.junctions {
        out.check()?;
        write_junction(network, junction, &mut out);
    }
    for link in network.junctions.iter().flat_map(|junction| &junction.links) {
        waiting(network, link, &mut out);
    }
    for junction in &network.junctions {
        out.check()?;
        for (i, link) in junction.links.iter().enumerate() {
            connection(network, junction, (link, junction.rules.get(i)), &mut out);
        }
    }
    out.close();
    out.finish().map(Some)
}

fn location(scene: &Scene, network: &ExportedNetwork<'_>, out: &mut Markup) {
    let points = || network.lines.iter().flatten();
    let first = points().next().copied().unwrap_or_default();
    let (low, high) = points().fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
    let corners: Vec<String> = [low.x, low.y, high.x, high.y].into_iter().map(decimal).collect();
    let boundary = corners.join(",");
    // SUMO does not know other names of projections.
    let crs = scene.meta.origin.crs.as_deref().filter(|crs| crs.starts_with("+proj"));
    out.empty(
        "location",
        &[
            ("netOffset", "0.00,0.00"),
            ("convBoundary", &boundary),
            ("origBoundary", &boundary),
            ("projParameter", crs.unwrap_or("!")),
        ],
    );
}

fn shape(points: &[Vec2]) -> String {
    let points: Vec<String> = points.iter().map(|p| format!("{},{}", decimal(p.x), decimal(p.y))).collect();
    points.join(" ")
}

/// Permission attribute of a lane.
fn permission(lane_type: LaneType) -> Option<(&'static str, &'static str)> {
    match lane_type {
        LaneType::BikeLane => Some(("allow", "bicycle")),
        LaneType::BusLane => Some(("allow", "bus")),
        LaneType::Sidewalk => Some(("allow", "pedestrian")),
        LaneType::Parking => Some(("disallow", "all")),
        LaneType::Freeway => Some(("disallow", "pedestrian bicycle")),
        LaneType::Undefined | LaneType::SurfaceStreet => None,
    }
}

/// The limit of a lane, assumed if the map has none, m/s.
pub(super) fn limit_mps(lane: &Lane) -> f64 {
    lane.speed_limit_mps.unwrap_or_else(|| assumed_speed_limit_mps(lane.lane_type))
}

fn write_lane(network: &ExportedNetwork<'_>, lane: usize, id: &str, index: usize, out: &mut Markup) {
    let line = &network.lines[lane];
    let lane = &network.map.lanes[lane];
    let (number, speed) = (index.to_string(), decimal(limit_mps(lane)));
    let (length, width) = (decimal(length(line)), decimal(lane.width_or_assumed_m()));
    let shape = shape(line);
    let mut attributes = vec![("id", id), ("index", &*number)];
    attributes.extend(permission(lane.lane_type));
    attributes.extend([("speed", &*speed), ("length", &*length), ("width", &*width), ("shape", &*shape)]);
    out.empty("lane", &attributes);
}

fn write_edge(network: &ExportedNetwork<'_>, edge: &Edge, out: &mut Markup) {
    let lanes = || edge.lanes.iter().map(|lane| &network.map.lanes[*lane]);
    let [from, to] = [edge.from, edge.to].map(|junction| network.junctions[junction].id.as_str());
    // Faster roads get the higher priority, from which SUMO derives right of way.
    let priority = lanes().map(limit_mps).fold(1.0, f64::max).round().to_string();
    let mut attributes = vec![("id", edge.id.as_str()), ("from", from), ("to", to), ("priority", &priority)];
    if lanes().any(is_motorway) {
        attributes.push(("type", MOTORWAY));
    }
    out.open("edge", &attributes);
    for (index, lane) in edge.lanes.iter().enumerate() {
        write_lane(network, *lane, &format!("{}_{index}", edge.id), index, out);
    }
    out.close();
}

/// SUMO's letter for a signal state.
fn letter(state: SignalState) -> char {
    match state {
        SignalState::Go | SignalState::ArrowGo => 'g',
        SignalState::Caution | SignalState::ArrowCaution => 'y',
        SignalState::Stop | SignalState::ArrowStop => 'r',
        SignalState::FlashingStop => 's',
        SignalState::FlashingCaution => 'o',
        SignalState::Unknown => 'O',
    }
}

/// Length of an added phase in which those signals are green that are never green during the motion, seconds.
const MADE_PHASE_S: f64 = 10.0;

/// For each signal of a junction, whether it is never green in these steps.
fn never_green(scene: &Scene, junction: &Junction, steps: usize) -> Vec<bool> {
    let stops = |light: &usize| {
        let signal = &scene.signals[*light];
        let begins = signal.runs.iter().map(|run| run.0).filter(|step| *step < steps).chain([0]);
        begins.into_iter().all(|step| matches!(letter(signal.at(step)), 'r' | 'y'))
    };
    junction.lights.iter().map(stops).collect()
}

/// Signal states of a junction, as a program that begins with the scene. It is as long as the motion, because
/// SUMO repeats programs.
fn lights(scene: &Scene, junction: &Junction, steps: usize, out: &mut Markup) {
    let steps = steps.max(1);
    let program = [("id", &*junction.id), ("type", "static"), ("programID", "0"), ("offset", "0")];
    out.open("tlLogic", &program);
    let signals = || junction.lights.iter().map(|light| &scene.signals[*light]);
    let mut begins: Vec<usize> = signals().flat_map(|signal| signal.runs.iter().map(|run| run.0)).collect();
    begins.push(0);
    begins.retain(|step| *step < steps);
    begins.sort_unstable();
    begins.dedup();
    for (i, begin) in begins.iter().enumerate() {
        let end = begins.get(i + 1).copied().unwrap_or(steps);
        let shown: String = signals().map(|signal| letter(signal.at(*begin))).collect();
        let duration = decimal((end - begin) as f64 * STEP_S);
        out.empty("phase", &[("duration", &duration), ("state", &shown)]);
    }
    // A vehicle at a signal that is never green in the recording would wait forever.
    let never = never_green(scene, junction, steps);
    if never.contains(&true) {
        let shown: String = never.iter().map(|never| if *never { 'g' } else { 'r' }).collect();
        out.empty("phase", &[("duration", &decimal(MADE_PHASE_S)), ("state", &shown)]);
    }
    out.close();
}

fn write_junction(network: &ExportedNetwork<'_>, junction: &Junction, out: &mut Markup) {
    let kind = match junction {
        Junction { lights, .. } if !lights.is_empty() => "traffic_light",
        Junction { links, .. } if links.is_empty() => "dead_end",
        Junction { rules, .. } if rules.is_empty() => "unregulated",
        _ => "priority",
    };
    let lane_id = |lane: &usize| {
        let (edge, index) = network.place(*lane)?;
        Some(format!("{}_{index}", edge.id))
    };
    let incoming: Vec<String> = junction.incoming.iter().filter_map(lane_id).collect();
    let ways = junction.links.iter().flat_map(|link| &link.via);
    let ways: Vec<String> = ways.map(|(_, id)| format!("{id}_0")).collect();
    out.open(
        "junction",
        &[
            ("id", &junction.id),
            ("type", kind),
            ("x", &decimal(junction.middle.x)),
            ("y", &decimal(junction.middle.y)),
            ("incLanes", &incoming.join(" ")),
            ("intLanes", &ways.join(" ")),
            ("shape", &shape(&junction.outline)),
        ],
    );
    for (i, rule) in junction.rules.iter().enumerate() {
        let (index, first, foes) = (i.to_string(), letters(&rule.first), letters(&rule.foes));
        out.empty("request", &[("index", &index), ("response", &first), ("foes", &foes), ("cont", "0")]);
    }
    out.close();
}

/// Internal junctions between the parts of a link, at which SUMO lets traffic wait.
fn waiting(network: &ExportedNetwork<'_>, link: &Link, out: &mut Markup) {
    for pair in link.via.windows(2) {
        let [(_, before), (lane, id)] = pair else { continue };
        let at = network.lines[*lane].first().copied().unwrap_or_default();
        let (id, before) = (format!("{id}_0"), format!("{before}_0"));
        out.empty(
            "junction",
            &[
                ("id", &*id),
                ("type", "internal"),
                ("x", &decimal(at.x)),
                ("y", &decimal(at.y)),
                ("incLanes", &before),
                ("intLanes", ""),
            ],
        );
    }
}

fn connection(
    network: &ExportedNetwork<'_>,
    junction: &Junction,
    (link, rule): (&Link, Option<&LinkPriority>),
    out: &mut Markup,
) {
    let (Some((from, from_lane)), Some((to, to_lane))) = (network.place(link.from), network.place(link.to))
    else {
        return;
    };
    let (from_lane, to_lane) = (from_lane.to_string(), to_lane.to_string());
    let direction = match link.turn_rad {
        turn if turn.abs() > TURNS_RAD.1 => "t",
        turn if turn > TURNS_RAD.0 => "l",
        turn if turn < -TURNS_RAD.0 => "r",
        _ => "s",
    };
    let gives_way = rule.is_some_and(LinkPriority::gives_way);
    let state = match link {
        Link { light: Some(_), .. } => "o",
        Link { stops: true, .. } => "s",
        _ if gives_way => "m",
        _ => "M",
    };
    let way = link.via.first().map(|(_, id)| format!("{id}_0"));
    let light = link.light.map(|light| light.to_string());
    let mut attributes =
        vec![("from", &*from.id), ("to", &*to.id), ("fromLane", &*from_lane), ("toLane", &*to_lane)];
    attributes.extend(way.as_deref().map(|way| ("via", way)));
    attributes
        .extend(light.as_deref().iter().flat_map(|light| [("tl", &*junction.id), ("linkIndex", *light)]));
    attributes.extend([("dir", direction), ("state", state)]);
    out.empty("connection", &attributes);
    for (part, (_, id)) in link.via.iter().enumerate() {
        let way = link.via.get(part + 1).map(|(_, id)| format!("{id}_0"));
        let mut onwards = vec![("from", &**id), ("to", &*to.id), ("fromLane", "0"), ("toLane", &*to_lane)];
        onwards.extend(way.as_deref().map(|way| ("via", way)));
        onwards.extend([("dir", direction), ("state", "M")]);
        out.empty("connection", &onwards);
    }
}

/// Losses of the map; a map without lanes has none, because it is not written.
pub(super) fn losses(scene: &Scene, network: &ExportedNetwork<'_>) -> Vec<Loss> {
    let map = network.map;
    let mut losses = Vec::new();
    let off_m = network.lines.iter().map(|line| cut_off_m(line)).fold(0.0, f64::max);
    losses.push(Loss::counted(code::GEOMETRY_APPROXIMATED, sentences::loss_lane_points(1e3 * off_m)));
    let count = network.roles.iter().filter(|role| **role == LaneRole::Lost).count();
    if count > 0 {
        losses.push(Loss::counted(code::NO_MAP, sentences::loss_lanes_without_length(count)));
    }
    let mut lose = |lost: bool, code, detail: &str| losses.extend(lost.then(|| Loss::new(code, detail)));
    lose(true, code::NO_IDS, "lanes and lights are numbered when they are read");
    let lines = !map.road_lines.is_empty() || !map.road_edges.is_empty();
    lose(lines, code::NO_LINES, "painted lines and road edges: they are redrawn beside the lanes");
    lose(!map.drivable.is_empty(), code::NO_DRIVABLE, "drivable areas: they are redrawn around the lanes");
    let areas = [&map.crosswalks, &map.speed_bumps, &map.driveways].into_iter().any(|list| !list.is_empty());
    lose(areas, code::NO_AREAS, "crosswalks, speed bumps and driveways");
    let any = |test: fn(&Lane) -> bool| map.lanes.iter().any(test);
    let other = any(|lane| matches!(lane.lane_type, LaneType::Undefined | LaneType::Parking));
    lose(
        other
            || network.junctions.iter().flat_map(|junction| &junction.links).any(|link| is_mixed(map, link)),
        code::NO_LANE_TYPE,
        "lanes of no known type are streets; parking is open to nobody and is not read again; ways through \
         junctions are motorways where the lanes before them are",
    );
    lose(any(|lane| lane.width_m.is_none()), code::NO_LANE_WIDTH, "assumed widths are read as known ones");
    lose(
        any(|lane| lane.speed_limit_mps.is_none()),
        code::NO_SPEED_LIMITS,
        "assumed limits are read as known",
    );
    lose(
        any(|lane| !lane.left_neighbors.is_empty() || !lane.right_neighbors.is_empty()),
        code::NO_NEIGHBORS,
        "lanes beside each other over a part of their length",
    );
    lose(
        any(|lane| lane.interpolating) || !network.map.stop_signs.is_empty(),
        code::NO_LANE_GRAPH,
        "which lanes lead through junctions where lanes part or meet without one, and stop signs of other lanes",
    );
    lose(any(|lane| lane.points.z_m.is_some()), code::NO_Z, "heights");
    lose(!network.unruled.is_empty(), code::NO_SIGNALS, "lights of what is not entered through a junction");
    let states = || scene.signals.iter().flat_map(|signal| &signal.runs).map(|run| run.1);
    let plain = |state| {
        !matches!(letter(state), 'O' | 'o') && crate::sumo::signals::state_of(letter(state) as u8) != state
    };
    lose(states().any(plain), code::NO_SIGNAL_STATES, "arrows are plain lights, flashing red is red");
    let elsewhere = scene.meta.origin.crs.as_deref().is_some_and(|crs| !crs.starts_with("+proj"));
    lose(elsewhere, code::NO_NOTES, "the projection");
    losses
}

/// Whether a path through a junction and the lane before it differ in being a motorway.
fn is_mixed(map: &LaneMap, link: &Link) -> bool {
    let lane = |lane: usize| map.lanes.get(lane).is_some_and(is_motorway);
    link.via.iter().any(|(way, _)| lane(*way) != lane(link.from))
}

/// Greatest deviation of a line after resampling at the spacings with which lanes are read, metres.
fn cut_off_m(line: &[Vec2]) -> f64 {
    let again =
        [SPACING_M.0, SPACING_M.1].map(|step_m| resample(line, step_m.max(length(line) / MAX_PIECES)));
    let off = |again: &Vec<Vec2>| line.iter().map(|p| distance_to(again, *p)).fold(0.0, f64::max);
    again.iter().map(off).fold(0.0, f64::max)
}
