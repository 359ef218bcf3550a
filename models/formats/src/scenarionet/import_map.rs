//! Converts the map features of a scenario to a lane map.

use super::value::{Pickle, PickleValue};
use super::words::{Feature, feature};
use crate::limits::{MAX_MAP_POINTS, MAX_POLYLINES};
use crate::problem::{FieldProblem, ImportWarning, ReadError, code, pointer_token};
use crate::refusals::{at_most, expected, more_than, wanted, what};
use crate::sentences::{self, subject};
use crate::settle::Ids;
use crate::units::MPS_PER_MPH;
use scene::Vec2;
use scene::map::{Area, Boundary, Lane, LaneMap, Neighbor, Points, ROAD_LINE_TYPES, StopSign, TypedLine};
use scene::message::{Message, Word};

/// Most links, neighbours and boundaries.
const MAX_REFERENCES: usize = 10 * MAX_POLYLINES;
/// Most characters of an id in a reference.
const MAX_ID: usize = 64;

/// The id of a feature in references to it.
pub(super) fn reference(id: &str) -> String {
    Ids::default().take(&id.chars().take(MAX_ID).collect::<String>())
}

/// Counts over all features.
#[derive(Default)]
struct FeatureCounts {
    points: usize,
    references: usize,
    dropped: usize,
}

/// Sorts features into a map, in their order.
///
/// # Errors
/// `map-too-large`, `invalid-field` for malformed lines.
pub(super) fn lane_map(
    pickle: &Pickle,
    features: &PickleValue,
    warnings: &mut Vec<ImportWarning>,
) -> Result<LaneMap, ReadError> {
    let all = pickle.entries(features);
    let all = all.ok_or_else(|| {
        FieldProblem::new("/map_features", code::INVALID_FIELD, expected(wanted::DICTIONARY))
    })?;
    if all.len() > MAX_POLYLINES {
        return Err(too_large(at_most(all.len(), what::FEATURES, MAX_POLYLINES)));
    }
    let mut map = LaneMap::default();
    let mut ids: [Ids; 3] = Default::default();
    let mut counts = FeatureCounts::default();
    for (key, value) in all {
        let key = pickle.text(key).unwrap_or_default();
        let word = pickle.get(value, "type").and_then(|value| pickle.text(value)).unwrap_or_default();
        let Some(kind) = feature(&word) else {
            counts.dropped += 1;
            continue;
        };
        let mut id = |i: usize| ids.get_mut(i).map(|ids| ids.take(&key)).unwrap_or_default();
        let line = line(pickle, value, &key, &mut counts)?;
        match kind {
            Feature::Lane(lane_type) if line.xy.len() > 1 => {
                let lane = Lane { lane_type, ..Lane::street(id(0), line) };
                map.lanes.push(self::lane(pickle, value, lane, &mut counts)?);
            }
            Feature::Line(line_type) if !line.xy.is_empty() => {
                map.road_lines.push(TypedLine { id: id(1), line_type: line_type.into(), points: line });
            }
            Feature::Edge(line_type) if !line.xy.is_empty() => {
                map.road_edges.push(TypedLine { id: id(1), line_type: line_type.into(), points: line });
            }
            Feature::Crosswalk | Feature::SpeedBump | Feature::Driveway if !line.xy.is_empty() => {
                let area = Area { id: id(2), polygon: line, holes: Vec::new() };
                match kind {
                    Feature::Crosswalk => map.crosswalks.push(area),
                    Feature::SpeedBump => map.speed_bumps.push(area),
                    _ => map.driveways.push(area),
                }
            }
            Feature::StopSign if !line.xy.is_empty() => {
                let lanes = pickle.get(value, "lane").map(|lanes| references(pickle, lanes, &mut counts));
                let z_m = line.z_m.and_then(|z| z.first().copied());
                let sign = StopSign {
                    id: id(2),
                    position: line.xy[0],
                    z_m,
                    lanes: lanes.transpose()?.unwrap_or_default(),
                };
                map.stop_signs.push(sign);
            }
            _ => counts.dropped += 1,
        }
    }
    ids.iter().for_each(|ids| warnings.extend(ids.warning(subject::MAP_FEATURES)));
    if counts.dropped > 0 {
        warnings.push(ImportWarning::new("features-dropped", sentences::features_unread(counts.dropped)));
    }
    Ok(map)
}

fn too_large(message: Message) -> ReadError {
    FieldProblem::new("/map_features", code::MAP_TOO_LARGE, message).into()
}

/// The line, ring or position of a feature.
fn line(
    pickle: &Pickle,
    value: &PickleValue,
    key: &str,
    counts: &mut FeatureCounts,
) -> Result<Points, ReadError> {
    let found = ["polyline", "polygon", "position"].iter().find_map(|name| pickle.get(value, name));
    let Some(found) = found else { return Ok(Points::default()) };
    let at = format!("/map_features/{}", pointer_token(&key.chars().take(60).collect::<String>()));
    let wrong =
        |wanted: Word| ReadError::from(FieldProblem::new(at.as_str(), code::INVALID_FIELD, expected(wanted)));
    let (across, numbers) =
        pickle.rows(found, 3 * (MAX_MAP_POINTS + 1)).ok_or_else(|| wrong(wanted::ROWS_OF_NUMBERS))?;
    // A position is one row.
    let across = if across == 1 && (2..=3).contains(&numbers.len()) { numbers.len() } else { across };
    if numbers.is_empty() {
        return Ok(Points::default());
    }
    if !(2..=3).contains(&across) {
        return Err(wrong(wanted::ROWS_OF_XYZ));
    }
    if numbers.iter().any(|v| !v.is_finite()) {
        return Err(wrong(wanted::FINITE_POINTS));
    }
    let xy: Vec<Vec2> = numbers.chunks_exact(across).map(|row| Vec2::new(row[0], row[1])).collect();
    counts.points += xy.len();
    if counts.points > MAX_MAP_POINTS {
        return Err(too_large(more_than(MAX_MAP_POINTS, what::POINTS)));
    }
    let z_m = (across == 3).then(|| numbers.chunks_exact(across).map(|row| row[2]).collect());
    Ok(Points { xy, z_m })
}

fn count(counts: &mut FeatureCounts, more: usize) -> Result<(), ReadError> {
    counts.references += more;
    if counts.references > MAX_REFERENCES {
        return Err(too_large(more_than(MAX_REFERENCES, what::REFERENCES)));
    }
    Ok(())
}

fn references(
    pickle: &Pickle,
    list: &PickleValue,
    counts: &mut FeatureCounts,
) -> Result<Vec<String>, ReadError> {
    let items = pickle.items(list).unwrap_or_default();
    count(counts, items.len())?;
    Ok(items.iter().filter_map(|value| pickle.text(value)).map(|id| reference(&id)).collect())
}

fn lane(
    pickle: &Pickle,
    value: &PickleValue,
    lane: Lane,
    counts: &mut FeatureCounts,
) -> Result<Lane, ReadError> {
    let number = |key: &str| pickle.get(value, key).and_then(|v| pickle.number(v)).filter(|v| v.is_finite());
    let mut list = |key: &str| match pickle.get(value, key) {
        Some(list) => references(pickle, list, counts),
        None => Ok(Vec::new()),
    };
    let (predecessors, successors) = (list("entry_lanes")?, list("exit_lanes")?);
    let limit = number("speed_limit_mph").map(|mph| mph * MPS_PER_MPH);
    let limit = limit.or_else(|| number("speed_limit_kmh").map(|kmh| kmh / 3.6));
    let mut sides = |key: &str| match pickle.get(value, key) {
        Some(list) => boundaries(pickle, list, counts),
        None => Ok(Vec::new()),
    };
    let (left_boundary, right_boundary) = (sides("left_boundaries")?, sides("right_boundaries")?);
    let mut beside = |key: &str| match pickle.get(value, key) {
        Some(list) => neighbors(pickle, list, counts),
        None => Ok(Vec::new()),
    };
    Ok(Lane {
        left_neighbors: beside("left_neighbor")?,
        right_neighbors: beside("right_neighbor")?,
        left_boundary,
        right_boundary,
        predecessors,
        successors,
        speed_limit_mps: limit.filter(|limit| (0.0..=100.0).contains(limit)),
        interpolating: number("interpolating").is_some_and(|v| v != 0.0),
        width_m: width(pickle, value),
        ..lane
    })
}

/// The median width, from whole widths or from left and right halves.
fn width(pickle: &Pickle, value: &PickleValue) -> Option<f64> {
    let (across, numbers) = pickle.rows(pickle.get(value, "width")?, 2 * MAX_MAP_POINTS)?;
    let mut widths: Vec<f64> = match across {
        2 => numbers
            .chunks_exact(2)
            .filter(|row| row[0] > 0.1 && row[1] > 0.1)
            .map(|row| row[0] + row[1])
            .collect(),
        1 => numbers,
        _ => return None,
    };
    widths.sort_by(f64::total_cmp);
    widths.get(widths.len() / 2).copied().filter(|width| (0.1..=50.0).contains(width))
}

fn index(pickle: &Pickle, value: &PickleValue, key: &str) -> usize {
    let found = pickle.get(value, key).and_then(|value| pickle.whole(value));
    found.and_then(|v| usize::try_from(v).ok()).unwrap_or(0)
}

fn boundaries(
    pickle: &Pickle,
    list: &PickleValue,
    counts: &mut FeatureCounts,
) -> Result<Vec<Boundary>, ReadError> {
    let items = pickle.items(list).unwrap_or_default();
    count(counts, items.len())?;
    let one = |value: &PickleValue| {
        let line = pickle.text(pickle.get(value, "boundary_feature_id")?)?;
        let word = pickle.get(value, "boundary_type").and_then(|value| pickle.text(value));
        let kind = word.map(|word| match feature(&word) {
            Some(Feature::Line(line)) => ROAD_LINE_TYPES.iter().position(|known| *known == line).unwrap_or(0),
            _ => 0,
        });
        Some(Boundary {
            line: reference(&line),
            from: index(pickle, value, "lane_start_index"),
            to: index(pickle, value, "lane_end_index"),
            kind: kind.and_then(|kind| u32::try_from(kind).ok()),
        })
    };
    Ok(items.iter().filter_map(one).collect())
}

fn neighbors(
    pickle: &Pickle,
    list: &PickleValue,
    counts: &mut FeatureCounts,
) -> Result<Vec<Neighbor>, ReadError> {
    let items = pickle.items(list).unwrap_or_default();
    count(counts, items.len())?;
    let mut found = Vec::new();
    for value in items {
        let Some(lane) = pickle.get(value, "feature_id").and_then(|id| pickle.text(id)) else { continue };
        let sides =
            pickle.get(value, "boundaries").map(|list| boundaries(pickle, list, counts)).transpose()?;
        found.push(Neighbor {
            lane: reference(&lane),
            own_range: (index(pickle, value, "self_start_index"), index(pickle, value, "self_end_index")),
            other_range: (
                index(pickle, value, "neighbor_start_index"),
                index(pickle, value, "neighbor_end_index"),
            ),
            boundaries: sides.unwrap_or_default(),
        });
    }
    Ok(found)
}
