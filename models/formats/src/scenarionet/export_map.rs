//! Converts a lane map to map features.

use super::words::{lane_word, line_word};
use super::writer::PickleWriter;
use crate::loss::{Loss, code};
use crate::units::mph;
use scene::map::{Area, Boundary, Lane, LaneMap, Neighbor, Points, ROAD_LINE_TYPES};
use std::collections::{BTreeSet, HashSet};

/// Keys of features, each used once.
#[derive(Default)]
struct Keys {
    used: HashSet<String>,
    changed: bool,
}

impl Keys {
    /// The id, or the id with its kind as a prefix if an earlier feature has it.
    fn take(&mut self, kind: &str, id: &str) -> String {
        let mut key = id.to_owned();
        while !self.used.insert(key.clone()) {
            self.changed = true;
            key = format!("{kind}.{key}");
        }
        key
    }
}

/// All features, kind by kind.
pub(super) fn features(map: &LaneMap, w: &mut PickleWriter, losses: &mut BTreeSet<Loss>) {
    let mut keys = Keys::default();
    w.dict(|w| {
        for item in &map.lanes {
            w.entry(&keys.take("lane", &item.id), |w| lane(item, w));
        }
        for (kind, prefix, list) in
            [("line", "ROAD_LINE_", &map.road_lines), ("edge", "ROAD_EDGE_", &map.road_edges)]
        {
            for line in list {
                w.entry(&keys.take(kind, &line.id), |w| {
                    w.dict(|w| {
                        w.entry("type", |w| w.text(&line_word(prefix, &line.line_type)));
                        w.entry("polyline", |w| points(&line.points, w));
                    });
                });
            }
        }
        let areas: [(&str, &str, &[Area]); 3] = [
            ("crosswalk", "CROSSWALK", &map.crosswalks),
            ("bump", "SPEED_BUMP", &map.speed_bumps),
            ("driveway", "DRIVEWAY", &map.driveways),
        ];
        for (kind, word, list) in areas {
            for area in list {
                w.entry(&keys.take(kind, &area.id), |w| {
                    w.dict(|w| {
                        w.entry("type", |w| w.text(word));
                        w.entry("polygon", |w| points(&area.polygon, w));
                    });
                });
            }
        }
        for sign in &map.stop_signs {
            w.entry(&keys.take("sign", &sign.id), |w| {
                w.dict(|w| {
                    w.entry("type", |w| w.text("STOP_SIGN"));
                    w.entry("position", |w| {
                        w.floats(1, &[sign.position.x, sign.position.y, sign.z_m.unwrap_or(0.0)])
                    });
                    w.entry("lane", |w| w.list(&sign.lanes, |w, lane| w.text(lane)));
                });
            });
        }
    });
    if keys.changed {
        losses.insert(Loss::new(
            code::IDS_RENUMBERED,
            "ids that features of several kinds have got the kind before them",
        ));
    }
    let foreign = map.lanes.iter().any(|lane| !lane_word(lane.lane_type).1);
    if foreign {
        losses.insert(Loss::new(code::NO_LANE_TYPE, "bus lanes, sidewalks and parking become untyped"));
    }
}

fn points(points: &Points, w: &mut PickleWriter) {
    let height = |i: usize| points.z_m.as_ref().and_then(|z| z.get(i)).copied().unwrap_or(0.0);
    let numbers: Vec<f64> = points.xy.iter().enumerate().flat_map(|(i, p)| [p.x, p.y, height(i)]).collect();
    w.floats(3, &numbers);
}

fn lane(lane: &Lane, w: &mut PickleWriter) {
    w.dict(|w| {
        w.entry("type", |w| w.text(lane_word(lane.lane_type).0));
        w.entry("polyline", |w| points(&lane.points, w));
        w.entry("interpolating", |w| w.bool(lane.interpolating));
        if let Some(limit) = lane.speed_limit_mps {
            w.entry("speed_limit_mph", |w| w.float(mph(limit)));
            w.entry("speed_limit_kmh", |w| w.float(limit * 3.6));
        }
        if let Some(width) = lane.width_m {
            w.entry("width", |w| w.floats(2, &[width / 2.0; 2].repeat(lane.points.xy.len())));
        }
        w.entry("entry_lanes", |w| w.list(&lane.predecessors, |w, id| w.text(id)));
        w.entry("exit_lanes", |w| w.list(&lane.successors, |w, id| w.text(id)));
        w.entry("left_boundaries", |w| w.list(&lane.left_boundary, boundary));
        w.entry("right_boundaries", |w| w.list(&lane.right_boundary, boundary));
        w.entry("left_neighbor", |w| w.list(&lane.left_neighbors, neighbor));
        w.entry("right_neighbor", |w| w.list(&lane.right_neighbors, neighbor));
    });
}

fn boundary(w: &mut PickleWriter, boundary: &Boundary) {
    w.dict(|w| {
        w.entry("boundary_feature_id", |w| w.text(&boundary.line));
        w.entry("lane_start_index", |w| w.int(boundary.from));
        w.entry("lane_end_index", |w| w.int(boundary.to));
        let word = boundary.kind.and_then(|kind| ROAD_LINE_TYPES.get(kind as usize));
        if let Some(word) = word {
            w.entry("boundary_type", |w| w.text(&line_word("ROAD_LINE_", word)));
        }
    });
}

fn neighbor(w: &mut PickleWriter, neighbor: &Neighbor) {
    w.dict(|w| {
        w.entry("feature_id", |w| w.text(&neighbor.lane));
        w.entry("self_start_index", |w| w.int(neighbor.own_range.0));
        w.entry("self_end_index", |w| w.int(neighbor.own_range.1));
        w.entry("neighbor_start_index", |w| w.int(neighbor.other_range.0));
        w.entry("neighbor_end_index", |w| w.int(neighbor.other_range.1));
        w.entry("boundaries", |w| w.list(&neighbor.boundaries, boundary));
    });
}
