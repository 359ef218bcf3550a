//! Cuts a map to a square about the origin.

use formats::polyline::{length, simplify};
use scene::Vec2;
use scene::map::{Area, Lane, LaneMap, LaneType, Neighbor, TypedLine};
use std::collections::HashMap;

/// The map within the square, coordinates in whole centimetres.
pub fn clip(map: &LaneMap, half: f64) -> LaneMap {
    let lanes: Vec<Lane> = map
        .lanes
        .iter()
        .filter_map(|lane| {
            let points = tidy(&line(&lane.points.xy, half)?);
            // Straight sections need few points; bends keep more, because cars follow them.
            let points =
                simplify(&points, 0.02, if lane.lane_type == LaneType::Sidewalk { 40.0 } else { 5.0 });
            Some(Lane { points: points.into(), ..lane.clone() })
        })
        .collect();
    let counts: HashMap<String, usize> = lanes.iter().map(|l| (l.id.clone(), l.points.xy.len())).collect();
    let lanes = lanes
        .into_iter()
        .map(|mut lane| {
            let own = lane.points.xy.len();
            let fix = |list: &mut Vec<Neighbor>| {
                list.retain(|n| counts.contains_key(&n.lane));
                for n in list {
                    n.own_range = (0, own - 1);
                    n.other_range = (0, counts[&n.lane] - 1);
                }
            };
            fix(&mut lane.left_neighbors);
            fix(&mut lane.right_neighbors);
            lane.predecessors.retain(|id| counts.contains_key(id));
            lane.successors.retain(|id| counts.contains_key(id));
            lane.width_m = lane.width_m.map(|w| (w * 100.0).round() / 100.0);
            lane.speed_limit_mps = lane.speed_limit_mps.map(|v| (v * 100.0).round() / 100.0);
            lane
        })
        .collect();
    let lines = |list: &[TypedLine]| -> Vec<TypedLine> {
        let cut = |l: &TypedLine| {
            let points = tidy(&line(&l.points.xy, half)?);
            Some(TypedLine { points: simplify(&points, 0.02, 40.0).into(), ..l.clone() })
        };
        list.iter().filter_map(cut).collect()
    };
    let areas = |list: &[Area]| -> Vec<Area> {
        let cut = |a: &Area| {
            let ring = tidy(&ring(&a.polygon.xy, half));
            (ring.len() > 2).then(|| Area { polygon: ring.into(), ..a.clone() })
        };
        list.iter().filter_map(cut).collect()
    };
    let signs = map.stop_signs.iter().filter(|s| s.position.amax() < half).cloned().map(|mut sign| {
        sign.lanes.retain(|id| counts.contains_key(id));
        sign.position = tidy(&[sign.position])[0];
        sign
    });
    LaneMap {
        road_lines: lines(&map.road_lines),
        road_edges: lines(&map.road_edges),
        crosswalks: areas(&map.crosswalks),
        speed_bumps: Vec::new(),
        driveways: areas(&map.driveways),
        stop_signs: signs.collect(),
        drivable: areas(&map.drivable),
        lanes,
    }
}

fn tidy(points: &[Vec2]) -> Vec<Vec2> {
    let round = |v: f64| {
        let v = (v * 100.0).round() / 100.0;
        if v == 0.0 { 0.0 } else { v }
    };
    let mut points: Vec<Vec2> = points.iter().map(|p| p.map(round)).collect();
    if points.len() > 2 {
        points.dedup();
    }
    points
}

/// The longest part of a line inside the square; `None` if it is too short.
fn line(points: &[Vec2], half: f64) -> Option<Vec<Vec2>> {
    let mut parts: Vec<Vec<Vec2>> = vec![Vec::new()];
    for w in points.windows(2) {
        let Some((a, b)) = segment(w[0], w[1], half) else { continue };
        let current = parts.len() - 1;
        match parts[current].last() {
            Some(last) if (last - a).norm() < 1e-6 => parts[current].push(b),
            Some(_) => parts.push(vec![a, b]),
            None => parts[current] = vec![a, b],
        }
    }
    let longest = parts.into_iter().max_by(|a, b| length(a).total_cmp(&length(b)))?;
    (longest.len() > 1 && length(&longest) > 0.05).then_some(longest)
}

/// The part of a segment inside the square (Liang and Barsky).
fn segment(a: Vec2, b: Vec2, half: f64) -> Option<(Vec2, Vec2)> {
    let d = b - a;
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-d.x, a.x + half), (d.x, half - a.x), (-d.y, a.y + half), (d.y, half - a.y)] {
        if p.abs() < 1e-12 {
            if q < 0.0 {
                return None;
            }
        } else if p < 0.0 {
            from = from.max(q / p);
        } else {
            to = to.min(q / p);
        }
    }
    (from < to).then(|| (a + d * from, a + d * to))
}

/// The part of a ring inside the square (Sutherland and Hodgman).
fn ring(points: &[Vec2], half: f64) -> Vec<Vec2> {
    let mut ring = points.to_vec();
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let depth = |p: &Vec2| half - sign * p[axis];
        let mut kept = Vec::new();
        for (i, b) in ring.iter().enumerate() {
            let a = &ring[(i + ring.len() - 1) % ring.len()];
            let (da, db) = (depth(a), depth(b));
            if (da < 0.0) != (db < 0.0) {
                kept.push(a + (b - a) * (da / (da - db)));
            }
            if db >= 0.0 {
                kept.push(*b);
            }
        }
        ring = kept;
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_rings_end_at_the_square() {
        let long = [Vec2::new(-20.0, 1.0), Vec2::new(20.0, 1.0)];
        assert_eq!(line(&long, 10.0), Some(vec![Vec2::new(-10.0, 1.0), Vec2::new(10.0, 1.0)]));
        assert_eq!(line(&[Vec2::new(30.0, 0.0), Vec2::new(20.0, 1.0)], 10.0), None);
        let big = [(-20.0, -5.0), (20.0, -5.0), (20.0, 5.0), (-20.0, 5.0)].map(|(x, y)| Vec2::new(x, y));
        let cut = ring(&big, 10.0);
        assert_eq!(cut.len(), 4);
        assert!(cut.iter().all(|p| p.x.abs() == 10.0 && p.y.abs() == 5.0));
    }
}
