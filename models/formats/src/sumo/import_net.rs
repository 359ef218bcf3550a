//! Reads a network file as a map about the origin, with its signals.

use super::map::{MapOptions, SignalPlace, lane_map};
use super::net::{LaneKind, Net, NetLane};
use super::programs::SignalProgram;
use crate::around::{Around, Chosen, MapPart};
use crate::limits::{MAX_DECODED_BYTES, MAX_MAP_POINTS, MAX_POLYLINES, MAX_SIGNALS, memory_for};
use crate::map_file;
use crate::polyline::length;
use crate::problem::{FieldProblem, ImportWarning, ReadError};
use crate::refusals::{self, shown, what};
use crate::repairs;
use crate::sentences;
use crate::source::Source;
use crate::unpack::{self, Bounds};
use scene::map::{LaneMap, Points};
use scene::{MAX_COORDINATE_M, Origin, STEP_S, Shared, Signal, Vec2};
use std::collections::{BTreeSet, HashMap};

/// Most bytes of a decompressed network. The largest that a scene can hold has a third of it.
const MAX_BYTES: u64 = 64 << 20;
/// Warning about left-hand traffic.
pub(crate) const LEFT_HAND: &str = "left-hand";
/// Memory per byte of text until it is a map, bytes.
const TEXT_MEMORY: u64 = 4;
/// Greatest distance of a network's coordinate from its own origin, metres.
pub(super) const MAX_SOURCE_M: f64 = 1e8;

/// A network in the form of a scene.
#[derive(Clone, Debug)]
pub(super) struct NetScene {
    /// About the origin.
    pub map: Shared<LaneMap>,
    /// Origin in the network's frame, whole metres.
    pub origin: Vec2,
    /// Geographic position of the origin if the network states its projection.
    pub place: Origin,
    /// Half the size of the bounding box of all lanes, metres.
    pub half: Vec2,
    pub warnings: Vec<ImportWarning>,
    /// The circle to which the map must be cut.
    pub part: Option<MapPart>,
    places: Vec<SignalPlace>,
    programs: HashMap<String, SignalProgram>,
}

/// Reads a network, plain or compressed with gzip.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the limits of a file, `invalid-field` with the line for an
/// unreadable value, `cannot-represent` for another kind of file or one without lanes, `map-too-large` and
/// `out-of-range` for what no scene can hold.
pub(super) fn read(file: &dyn Source, around: Option<Around>) -> Result<NetScene, ReadError> {
    let mut chosen = Chosen::of(around);
    let whole = MAX_BYTES.min(memory_for(file.encoded_len()) / TEXT_MEMORY);
    // Only a small part is kept, whatever the size of the file.
    let most = if chosen.is_part() { MAX_DECODED_BYTES } else { whole };
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(most)));
    let mut net = Net::read_part(input.map_err(|error| unpack::fault(&error, 0))?, &mut chosen)?;
    let (origin, half) = check_net(&net, &chosen)?;
    // Left-hand traffic is mirrored right-hand traffic, including the order of its lanes: it is drawn
    // mirrored.
    let mirrored = net.notes.left_hand;
    let turned = |p: Vec2| if mirrored { Vec2::new(p.x, -p.y) } else { p };
    for lane in &mut net.lanes {
        lane.shape.iter_mut().for_each(|p| *p = turned(*p - origin));
    }
    for junction in &mut net.junctions {
        junction.position = turned(junction.position - origin);
    }
    let mut drawn = lane_map(&net, MapOptions { sidewalks: true, parking: false });
    if mirrored {
        drawn.map = drawn.map.mirrored();
        drawn.signals.iter_mut().for_each(|place| place.stop = turned(place.stop));
    }
    // Around junctions with extreme lane directions, borders can intersect at any distance.
    let near = |points: &Points| points.xy.iter().all(|p| p.amax() <= MAX_COORDINATE_M);
    drawn.map.drivable.retain(|area| near(&area.polygon));
    drawn.map.road_edges.retain(|line| near(&line.points));
    drawn.map.road_lines.retain(|line| near(&line.points));
    let mut warnings = warnings_of(&net);
    let shared = || ImportWarning::new("lanes-shared", sentences::lanes_shared(drawn.narrow));
    warnings.extend((drawn.narrow > 0).then(shared));
    let mut places = drawn.signals;
    if places.len() > MAX_SIGNALS {
        let message = sentences::signals_near_centre(places.len(), MAX_SIGNALS);
        warnings.push(ImportWarning::new("signals-dropped", message));
        places.sort_by(|a, b| a.stop.norm().total_cmp(&b.stop.norm()));
        places.truncate(MAX_SIGNALS);
    }
    // Of programs with the same id, the simulation runs the one that was loaded last.
    let programs = net.programs.into_iter().map(|p| (p.id.clone(), p)).collect();
    let place = match net.notes.projection {
        Some(crs) => {
            let at = origin - net.notes.offset;
            Origin { x_m: at.x, y_m: at.y, crs: Some(crs), ..Origin::default() }
        }
        None => Origin { x_m: origin.x, y_m: origin.y, ..Origin::default() },
    };
    let mut map = Shared::from(drawn.map);
    warnings.extend(repairs::drop_far_links(&mut map));
    let part = chosen.part(origin, what::LANES);
    Ok(NetScene { map, origin, place, half, warnings, part, places, programs })
}

impl NetScene {
    /// Signals over `steps` steps from `start_s`, seconds of the simulation. Links without a program are
    /// left out.
    pub fn signals(&self, start_s: f64, steps: usize) -> Vec<Signal> {
        let signal = |place: &SignalPlace| {
            let runs = self.programs.get(&place.program)?.runs(place.link, start_s, STEP_S, steps);
            Some(Signal { lane: place.feature.clone(), stop: Some(place.stop), stop_z_m: None, runs })
        };
        self.places.iter().filter_map(signal).collect()
    }
}

/// Refuses what no scene can hold before anything is drawn. Returns the middle of the network in whole metres
/// and half its size.
fn check_net(net: &Net, chosen: &Chosen) -> Result<(Vec2, Vec2), ReadError> {
    if net.lanes.is_empty() {
        let message = chosen.nothing().unwrap_or_else(|| refusals::file_has_no(what::LANE));
        return Err(ReadError::other_content(message));
    }
    // Each edge becomes two borders and an area besides its lanes.
    let polylines = net.lanes.len() + 2 * net.edges.len();
    if polylines > MAX_POLYLINES {
        return Err(ReadError::map_too_large(refusals::network_too_large(MAX_POLYLINES, what::LINES)));
    }
    let mut corners: Option<(Vec2, Vec2)> = None;
    for lane in &net.lanes {
        check_lane(lane)?;
        for p in &lane.shape {
            corners = Some(corners.map_or((*p, *p), |(low, high)| (low.inf(p), high.sup(p))));
        }
    }
    let (low, high) = corners.unwrap_or_default();
    let (middle, half) = (((low + high) / 2.0).map(f64::round), (high - low) / 2.0);
    if let Some(origin) = chosen.origin() {
        return check_points(net).map(|()| (origin, half));
    }
    if map_file::is_too_wide(half) {
        return Err(ReadError::map_too_large(map_file::extent(half)));
    }
    check_points(net).map(|()| (middle, half))
}

fn check_points(net: &Net) -> Result<(), ReadError> {
    let points: f64 = net.lanes.iter().map(|l| l.shape.len() as f64 + length(&l.shape) / 2.0).sum();
    if points > MAX_MAP_POINTS as f64 {
        return Err(ReadError::map_too_large(refusals::network_too_large(MAX_MAP_POINTS, what::POINTS)));
    }
    Ok(())
}

fn check_lane(lane: &NetLane) -> Result<(), ReadError> {
    let problem = |what, min: f64, max: f64, got: f64| {
        let [least, most, found] = [min, max, got].map(|v| v.to_string());
        let message = refusals::lane_outside(&shown(&lane.id), what, &found, &least, &most);
        Err(FieldProblem::range_of("", min, max, got, message).into())
    };
    let far = lane.shape.iter().flat_map(|p| [p.x, p.y]).find(|v| v.abs() > MAX_SOURCE_M);
    if let Some(value) = far {
        return problem(what::COORDINATE, -MAX_SOURCE_M, MAX_SOURCE_M, value);
    }
    if !(0.0..=50.0).contains(&lane.width_m) {
        return problem(what::WIDTH, 0.0, 50.0, lane.width_m);
    }
    if !(0.0..=100.0).contains(&lane.speed_mps) {
        return problem(what::SPEED, 0.0, 100.0, lane.speed_mps);
    }
    Ok(())
}

fn warnings_of(net: &Net) -> Vec<ImportWarning> {
    let mut warnings = Vec::new();
    let mut warn = |applies: bool, code, message| {
        if applies {
            warnings.push(ImportWarning::new(code, message));
        }
    };
    warn(true, "ids-renumbered", sentences::ids_renumbered());
    warn(net.notes.heights, "heights-dropped", sentences::map_heights_dropped());
    warn(net.notes.left_hand, LEFT_HAND, sentences::left_hand_network());
    let closed = net.lanes.iter().filter(|l| l.kind == LaneKind::Closed).count();
    warn(closed > 0, "lanes-dropped", sentences::lanes_closed(closed));
    let ids: BTreeSet<&str> = net.programs.iter().map(|p| p.id.as_str()).collect();
    warn(ids.len() < net.programs.len(), "programs-dropped", sentences::programs_beyond_last());
    let held = net.programs.iter().filter(|p| !p.is_simple()).count();
    warn(held > 0, "signals-held", sentences::signals_held(held));
    let ruled = net.lanes.iter().filter_map(|l| l.signal.as_ref());
    let missing = ruled.filter(|(program, _)| !ids.contains(program.as_str())).count();
    warn(missing > 0, "signals-dropped", sentences::signal_links_unprogrammed(missing));
    warnings
}
