//! Reads an OpenDRIVE file as a map about the origin, with its signals.

use super::filter::{self, Filtered, Offset};
use super::lanes::{self, Found, carries_vehicles, is_road};
use super::places::RoadPlaces;
use super::sections::{NetworkFrame, Section, sections};
use super::{marks, objects, signals};
use crate::around::{Around, Chosen};
use crate::format::MAP_TIMING;
use crate::map_file::{self, MapRead};
use crate::problem::{ImportWarning, ReadError};
use crate::refusals::{self, what};
use crate::sentences;
use crate::source::Source;
use crate::surface::{self, Strip};
use crate::{bounds, lights};
use scene::geometry::rotate;
use scene::map::LaneMap;
use scene::{MAX_COORDINATE_M, Origin, Vec2, wrap_angle};
use std::collections::BTreeMap;
use xodr::{Direction, RoadNetwork};

/// Least width of a lane that no edge may cross, metres.
const WAY_M: f64 = 1.0;
/// Most characters of a name.
const NAME_CHARS: usize = 100;

/// Reads a file, plain or compressed with gzip: a scene with a map and signals, without road users.
///
/// # Errors
/// `malformed-file` for broken XML or gzip, the limits of a file, `cannot-represent` for another kind of file
/// or one without lanes, `map-too-large` and `out-of-range` for what no scene can hold.
pub(super) fn read(file: &dyn Source, around: Option<Around>) -> Result<MapRead, ReadError> {
    read_with_roads(file, around).map(|(map, _)| map)
}

/// Reads a map, with the positions on its roads that a scenario may name.
pub(crate) fn read_with_roads(
    file: &dyn Source,
    around: Option<Around>,
) -> Result<(MapRead, RoadPlaces), ReadError> {
    let mut chosen = Chosen::of(around);
    let mut file = filter::read(file, &mut chosen)?;
    if let (true, Some(message)) = (file.is_empty, chosen.nothing()) {
        return Err(ReadError::other_content(message));
    }
    let text = std::mem::take(&mut file.text);
    let (network, provenance) = xodr::load_str_with_provenance(&text)
        .map_err(|error| ReadError::other_content(refusals::no_roads_with_lanes(&error.to_string())))?;
    drop(text);
    let mut frame = NetworkFrame::of(&network);
    if let Some(origin) = chosen.origin() {
        frame.middle = origin - file.origin;
    }
    // Roads begin near the network's origin; far from it, numbers have lost their precision.
    let wide = !chosen.is_part() && map_file::is_too_wide(frame.half);
    if wide || frame.middle.amax() > 2.0 * MAX_COORDINATE_M {
        return Err(ReadError::map_too_large(map_file::extent(frame.half)));
    }
    let sections = sections(&network, &file, &frame);
    let mut next = 0;
    let mut id = || {
        next += 1;
        next.to_string()
    };
    let mut map = LaneMap::default();
    let found = lanes::draw(&network, &sections, &file.links, &mut map);
    if map.lanes.is_empty() {
        return Err(ReadError::other_content(refusals::file_has_no(what::LANE)));
    }
    let approximated = marks::draw(&network, &provenance, &sections, &found, &mut map, &mut id);
    let strips = strips(&network, &sections);
    let ways = ways(&sections, &found, &map);
    // The map has everything that is needed of the lanes.
    drop(sections);
    let whole = surface::draw(&mut map, &strips, &ways, &mut id);
    bounds::by_edges(&mut map);
    map.crosswalks = objects::crosswalks(&network, &frame, &mut id);
    let ruled = signals::find(&network, &provenance, &frame, &found, &map, &mut id);
    map.stop_signs = ruled.signs;
    let (signals, made) = lights::signals(&map, ruled.heads, MAP_TIMING.steps);

    let mut warnings = warnings(&file, &provenance.warnings, approximated, whole);
    let unused = || ImportWarning::new("signals-dropped", sentences::signals_without_lane(ruled.unused));
    warnings.extend((ruled.unused > 0).then(unused));
    warnings.extend(made);
    let name: String = network.header().name.chars().filter(|c| !c.is_control()).take(NAME_CHARS).collect();
    let name = name.trim().to_owned();
    let part = chosen.part(file.origin + frame.middle, what::LANES);
    let Offset { at, z_m, turn_rad } = file.offset;
    let middle = at + rotate(file.origin + frame.middle, turn_rad);
    let origin = Origin {
        x_m: middle.x,
        y_m: middle.y,
        z_m,
        rotation_rad: wrap_angle(turn_rad),
        crs: file.projection,
    };
    let roads = RoadPlaces::of(network, file.origin, frame.middle, ruled.lights);
    Ok((MapRead { name, map: map.into(), signals, origin, warnings, part }, roads))
}

/// The carriageway of each section: adjacent lanes without a kerb, with at least one for traffic.
fn strips(network: &RoadNetwork, sections: &[Section]) -> Vec<Strip> {
    let mut strips = Vec::new();
    for section in sections {
        let count = section.lanes.len();
        let mut from = 0;
        for to in 0..=count {
            if to < count && is_road(section, to) {
                continue;
            }
            strips.extend(strip(network, section, from, to));
            from = to + 1;
        }
    }
    strips
}

/// Lanes `from..to` of a section.
fn strip(network: &RoadNetwork, section: &Section, from: usize, to: usize) -> Option<Strip> {
    let lanes = section.lanes.get(from..to)?;
    let (first, last) =
        (lanes.iter().find(|l| carries_vehicles(l))?, lanes.iter().rfind(|l| carries_vehicles(l))?);
    // Oncoming traffic is to the left of a driver, or to the right in left-hand traffic.
    let inner_is_left = |direction| (direction != Direction::Backward) != section.left_hand;
    let goes_on = |at_end: bool| {
        section.junction.is_some()
            || lanes.iter().filter_map(|lane| network.lane(lane.id)).any(|lane| match lane.direction {
                Direction::Forward if at_end => !lane.successors.is_empty(),
                Direction::Forward => !lane.predecessors.is_empty(),
                Direction::Backward if at_end => !lane.predecessors.is_empty(),
                Direction::Backward => !lane.successors.is_empty(),
                Direction::Both => !lane.successors.is_empty() || !lane.predecessors.is_empty(),
            })
    };
    Some(Strip {
        right: section.borders[from].clone(),
        left: section.borders[to].clone(),
        inner: [!inner_is_left(first.direction), inner_is_left(last.direction)],
        joined: [goes_on(false), goes_on(true)],
        junction: section.junction.is_some(),
    })
}

/// Centre lines of lanes that are wide enough for traffic, and of the connections to their successors.
fn ways(sections: &[Section], found: &Found, map: &LaneMap) -> Vec<Vec<Vec2>> {
    let mut ways = Vec::new();
    let mut wide = vec![[false; 2]; map.lanes.len()];
    for lane in sections.iter().flat_map(|section| &section.lanes).filter(|lane| carries_vehicles(lane)) {
        let is_wide = |i: usize| lane.widths_m.get(i).is_some_and(|width| *width >= WAY_M);
        let mut way = Vec::new();
        for (i, p) in lane.center.iter().enumerate() {
            if is_wide(i) {
                way.push(*p);
            } else {
                ways.push(std::mem::take(&mut way));
            }
        }
        ways.push(way);
        for drawn in found.get(&lane.id).into_iter().flatten() {
            let ends = [is_wide(0), is_wide(lane.center.len().saturating_sub(1))];
            wide[drawn.lane] = if drawn.forward { ends } else { [ends[1], ends[0]] };
        }
    }
    let by_id: BTreeMap<&str, usize> =
        map.lanes.iter().enumerate().map(|(i, l)| (l.id.as_str(), i)).collect();
    for (lane, [_, wide_end]) in map.lanes.iter().zip(&wide) {
        for next in lane.successors.iter().filter_map(|id| by_id.get(id.as_str())) {
            let ends = (lane.points.xy.last(), map.lanes[*next].points.xy.first());
            if let ((Some(end), Some(start)), true, true) = (ends, *wide_end, wide[*next][0]) {
                ways.push(vec![*end, *start]);
            }
        }
    }
    ways.retain(|way| way.len() > 1);
    ways
}

fn warnings(
    file: &Filtered,
    faults: &[xodr::Warning],
    approximated: usize,
    whole: bool,
) -> Vec<ImportWarning> {
    let mut warnings = Vec::new();
    let mut warn = |applies: bool, code, message| {
        if applies {
            warnings.push(ImportWarning::new(code, message));
        }
    };
    let others = faults.iter().filter(|fault| !fault.is_ignored()).map(ToString::to_string);
    let faults: Vec<String> = file.faults.iter().cloned().chain(others).collect();
    if let Some(first) = faults.first() {
        let first: String = first.chars().take(300).collect();
        let message = match faults.len() - 1 {
            0 => sentences::map_fault(&first),
            more => sentences::map_faults(&first, more),
        };
        warn(true, "map-faults", message);
    }
    let listed: Vec<String> = file.left_out.iter().map(|(what, count)| format!("{count} x {what}")).collect();
    warn(!listed.is_empty(), "parts-dropped", sentences::parts_left_out(&listed.join(", ")));
    let (bordered, length_m) = file.bordered;
    warn(bordered > 0, "lanes-dropped", sentences::lanes_bordered(bordered, length_m));
    warn(approximated > 0, "lines-approximated", sentences::lines_approximated(approximated));
    warn(!whole, "edges-dropped", sentences::crossing_roads());
    warnings
}
