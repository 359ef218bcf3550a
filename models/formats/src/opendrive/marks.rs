//! Painted lines of a network, and the lanes that they bound.

use super::lanes::Found;
use super::sections::Section;
use crate::polyline::simplify;
use scene::Vec2;
use scene::map::{Boundary, LaneMap, ROAD_LINE_TYPES, TypedLine};
use std::collections::HashMap;
use xodr::{LanePosition, Provenance, RoadMarkProvenance, RoadNetwork};

/// Tolerance of simplified paint, and its longest segment, metres.
const KEPT_M: (f64, f64) = (0.03, 20.0);

/// A painted line of a section.
struct Painted {
    /// Index of the border in the section.
    border: usize,
    /// Beginning and end, as positions among the section's points.
    from: f64,
    to: f64,
    /// Index in [`LaneMap::road_lines`].
    line: usize,
}

/// Draws all lines. Returns the number of those of an unknown kind.
pub(super) fn draw(
    network: &RoadNetwork,
    provenance: &Provenance,
    sections: &[Section],
    found: &Found,
    map: &mut LaneMap,
    mut id: impl FnMut() -> String,
) -> usize {
    let by_place: HashMap<(&str, usize), usize> =
        sections.iter().enumerate().map(|(i, s)| ((s.road.as_str(), s.number), i)).collect();
    let mut painted: Vec<Vec<Painted>> = sections.iter().map(|_| Vec::new()).collect();
    let mut approximated = 0;
    for place in &provenance.road_marks {
        let Some(mark) = network.road_mark(place.road_mark) else { continue };
        let Some(at) = by_place.get(&(place.road_id.as_str(), place.section)).copied() else { continue };
        let Some((line_type, exact)) = line_type(place.material.trim(), &mark.color) else { continue };
        let section = &sections[at];
        let Some((border, from, to)) = stretch(network, section, place) else { continue };
        let points = cut(&section.borders[border], from, to);
        if points.len() < 2 {
            continue;
        }
        approximated += usize::from(!exact);
        painted[at].push(Painted { border, from, to, line: map.road_lines.len() });
        let points = simplify(&points, KEPT_M.0, KEPT_M.1).into();
        map.road_lines.push(TypedLine { id: id(), line_type: line_type.to_owned(), points });
    }
    for (section, painted) in sections.iter().zip(&painted) {
        bound(section, painted, found, map);
    }
    approximated
}

/// The word for a mark, and whether it is exact; nothing for what is not paint. `sort` is its `type`
/// (e_roadMarkType).
fn line_type(sort: &str, colour: &str) -> Option<(&'static str, bool)> {
    let yellow = matches!(colour, "yellow" | "orange");
    let plain = yellow || matches!(colour, "" | "standard" | "white");
    let (word, exact) = match (sort, yellow) {
        ("solid", false) => ("solid_single_white", true),
        ("solid", true) => ("solid_single_yellow", true),
        ("broken", false) => ("broken_single_white", true),
        ("broken", true) => ("broken_single_yellow", true),
        ("solid solid", false) => ("solid_double_white", true),
        ("solid solid", true) => ("solid_double_yellow", true),
        ("broken broken", false) => ("broken_single_white", false),
        ("broken broken", true) => ("broken_double_yellow", true),
        ("solid broken" | "broken solid", false) => ("solid_double_white", false),
        ("solid broken" | "broken solid", true) => ("passing_double_yellow", true),
        ("botts dots", false) => ("broken_single_white", false),
        ("botts dots", true) => ("broken_single_yellow", false),
        _ => return None,
    };
    Some((word, exact && plain))
}

/// The border of a mark, and its beginning and end among the border's points.
fn stretch(
    network: &RoadNetwork,
    section: &Section,
    place: &RoadMarkProvenance,
) -> Option<(usize, f64, f64)> {
    // A mark is on the outer border of its lane; that of lane 0 between the two sides.
    let right = section.lanes.iter().filter(|lane| lane.number < 0).count();
    let border = match place.od_lane_id {
        0 => right,
        number => {
            let at = section.lanes.iter().position(|lane| lane.number == number)?;
            if number < 0 { at } else { at + 1 }
        }
    };
    let lane = section.lanes.get(border.min(section.lanes.len().checked_sub(1)?))?;
    let last = lane.center.len().checked_sub(1)?;
    let line = network.lane(lane.id)?.center.points();
    let arc = |s: f64| network.centerline_s(LanePosition { lane: lane.id, s, offset: 0.0 });
    let place_of = |arc: f32| {
        let mut left = arc;
        for (i, ends) in line.windows(2).enumerate() {
            let piece = ends[0].distance_to(ends[1]);
            if left <= piece {
                let place = (i as f64 + f64::from(left / piece.max(1e-6))) / section.stride as f64;
                return place.min(last as f64);
            }
            left -= piece;
        }
        last as f64
    };
    let from = arc(place.s).map_or(0.0, place_of);
    let to = arc(place.s + place.length).map_or(last as f64, place_of);
    (to > from).then_some((border, from, to))
}

/// The part of a line between two positions.
fn cut(line: &[Vec2], from: f64, to: f64) -> Vec<Vec2> {
    let at = |place: f64| {
        let i = (place.floor() as usize).min(line.len().saturating_sub(1));
        let next = line.get(i + 1).or(line.get(i))?;
        Some(line.get(i)? + (next - line.get(i)?) * (place - i as f64))
    };
    let inner = line.iter().enumerate().filter(|(i, _)| (*i as f64) > from + 1e-6 && (*i as f64) < to - 1e-6);
    at(from).into_iter().chain(inner.map(|(_, p)| *p)).chain(at(to)).collect()
}

/// Assigns bounding lines to the lanes of a section.
fn bound(section: &Section, painted: &[Painted], found: &Found, map: &mut LaneMap) {
    for (j, lane) in section.lanes.iter().enumerate() {
        for drawn in found.get(&lane.id).into_iter().flatten() {
            for paint in painted.iter().filter(|paint| paint.border == j || paint.border == j + 1) {
                let within = |place: &f64| *place >= paint.from - 0.02 && *place <= paint.to + 0.02;
                let mut covered = drawn.places.iter().enumerate().filter(|(_, place)| within(place));
                let Some((first, _)) = covered.next() else { continue };
                let last = covered.next_back().map_or(first, |(i, _)| i);
                let line = &map.road_lines[paint.line];
                let kind = ROAD_LINE_TYPES.iter().position(|word| *word == line.line_type);
                let boundary = Boundary {
                    line: line.id.clone(),
                    from: first,
                    to: last,
                    kind: kind.and_then(|kind| u32::try_from(kind).ok()),
                };
                let lane = &mut map.lanes[drawn.lane];
                let on_left = (paint.border == j + 1) == drawn.forward;
                if on_left { &mut lane.left_boundary } else { &mut lane.right_boundary }.push(boundary);
            }
        }
    }
}
