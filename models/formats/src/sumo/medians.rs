//! Ends of medians. The sides of a median are drawn as borders of the two carriageways. At its end, at a
//! crosswalk or beside a turn lane, they are two lines without a connection. This module joins them by a
//! nose, and cuts a tapering median off where it is still wide enough to be built.

use crate::polyline::{arc_lengths, length, part, resample};
use scene::Vec2;
use scene::map::{Area, LaneMap, TypedLine};
use std::f64::consts::PI;

/// Borders whose ends are closer than this are continuous, metres.
const JOINED_M: f64 = 0.05;
/// Medians are narrower than this, metres.
const WIDEST_M: f64 = 15.0;
/// Ends of other kerbs within this distance are joined, metres.
const GORE_M: f64 = 1.0;
/// Width at which a narrowing median is cut off, metres.
const NOSE_M: f64 = 0.8;
/// Greatest length of a nose beyond the ends that it joins, metres.
const BULGE_M: f64 = 0.6;
/// A painted line that ends this near to a median's point is extended to its nose, metres.
const PAINT_M: f64 = 1.5;
/// Spacing of points where a median narrows, metres.
const STEP_M: f64 = 0.5;

/// An end of a border, by the index of its line.
#[derive(Clone, Copy)]
struct BorderEnd {
    line: usize,
    /// Whether this is the line's last point; otherwise its first.
    last: bool,
    point: Vec2,
    /// Direction away from the line's end, a unit vector.
    way: Vec2,
    median: bool,
}

/// Joins the loose ends of medians, and of kerbs that nearly meet. Ends for which `cut` holds are at the edge
/// of the map and stay open.
pub fn close(map: &mut LaneMap, cut: impl Fn(Vec2) -> bool) {
    let mut ends = loose(&map.road_edges);
    ends.retain(|e| !cut(e.point));
    let mut pairs = Vec::new();
    for (i, a) in ends.iter().enumerate() {
        for b in ends[i + 1..].iter().take_while(|b| b.point.x - a.point.x < WIDEST_M) {
            let gap_m = (b.point - a.point).norm();
            let widest_m = if a.median && b.median { WIDEST_M } else { GORE_M };
            if a.line != b.line && gap_m < widest_m && a.way.dot(&b.way) > 0.7 {
                pairs.push((gap_m, *a, *b));
            }
        }
    }
    pairs.sort_by(|p, q| p.0.total_cmp(&q.0));
    let mut done: Vec<(usize, bool)> = Vec::new();
    for (gap_m, a, b) in pairs {
        let (of_a, of_b) = ((a.line, a.last), (b.line, b.last));
        if done.contains(&of_a) || done.contains(&of_b) {
            continue;
        }
        done.extend([of_a, of_b]);
        let ahead_m = (b.point - a.point).dot(&(a.way + b.way)) / 2.0;
        if ahead_m.abs() < 0.5 * gap_m || !a.median {
            let nose = nose(a.point, b.point, a.way, gap_m);
            extend(&mut map.road_edges, a, nose);
        } else if ahead_m > 0.0 {
            blunt(map, a, b);
        } else {
            blunt(map, b, a);
        }
    }
}

/// Ends without a continuation, sorted by x.
fn loose(lines: &[TypedLine]) -> Vec<BorderEnd> {
    let of_line = |(line, typed): (usize, &TypedLine)| {
        let (points, median) = (&typed.points.xy, typed.line_type == "median");
        let n = points.len();
        let end = |last: bool, point: Vec2, before: Vec2| {
            let way = (point - before) / (point - before).norm().max(1e-9);
            BorderEnd { line, last, point, way, median }
        };
        if n < 2 {
            return Vec::new();
        }
        vec![end(false, points[0], points[1]), end(true, points[n - 1], points[n - 2])]
    };
    let mut ends: Vec<BorderEnd> = lines.iter().enumerate().flat_map(of_line).collect();
    ends.sort_by(|a, b| a.point.x.total_cmp(&b.point.x));
    let mut joined = vec![false; ends.len()];
    for i in 0..ends.len() {
        for j in i + 1..ends.len() {
            if ends[j].point.x - ends[i].point.x > JOINED_M {
                break;
            }
            if (ends[j].point - ends[i].point).norm() < JOINED_M {
                (joined[i], joined[j]) = (true, true);
            }
        }
    }
    let mut joined = joined.iter();
    ends.retain(|_| !joined.next().copied().unwrap_or(false));
    ends
}

/// A round end from `a` to `b` that bulges along `way`; straight if they nearly meet.
fn nose(a: Vec2, b: Vec2, way: Vec2, gap_m: f64) -> Vec<Vec2> {
    if gap_m < 0.5 {
        return vec![b];
    }
    let (middle, half) = ((a + b) / 2.0, (a - b) / 2.0);
    let bulge = way * BULGE_M.min(gap_m / 2.0);
    (1..=6).map(|i| PI * f64::from(i) / 6.0).map(|t| middle + half * t.cos() + bulge * t.sin()).collect()
}

fn extend(lines: &mut [TypedLine], end: BorderEnd, more: Vec<Vec2>) {
    let Some(line) = lines.get_mut(end.line) else { return };
    if end.last {
        line.points.xy.extend(more);
    } else {
        line.points.xy.splice(0..0, more.into_iter().rev());
    }
    line.points.z_m = None;
}

/// `near` ends beside `far`, which continues to the point of the median. Both are cut off where they are
/// [`NOSE_M`] apart; the rest becomes road, with the painted line extended to the nose.
fn blunt(map: &mut LaneMap, near: BorderEnd, far: BorderEnd) {
    let towards_end = |end: BorderEnd| {
        let mut points = map.road_edges[end.line].points.xy.clone();
        if !end.last {
            points.reverse();
        }
        points
    };
    let (a, b) = (towards_end(near), resample(&towards_end(far), STEP_M));
    let lengths = arc_lengths(&a);
    let total = length(&a);
    // After the end of `near`, the median has no width.
    let Some((at_b, s, foot)) = (0..b.len()).rev().find_map(|i| {
        let (s, foot) = foot_on(&a, &lengths, b[i]);
        ((foot - b[i]).norm() >= NOSE_M && s < total - 1e-6).then_some((i, s, foot))
    }) else {
        return;
    };
    if at_b < 2 || s < STEP_M {
        return;
    }
    let (kept_a, tail_a) = (part(&a, 0.0, s), part(&a, s, total));
    let (kept_b, tail_b) = (b[..=at_b].to_vec(), b[at_b..].to_vec());
    let gap_m = (foot - b[at_b]).norm();
    let way = (tail_b[tail_b.len() - 1] - foot) / (tail_b[tail_b.len() - 1] - foot).norm().max(1e-9);
    let nose = nose(foot, b[at_b], way, gap_m);
    let tip = (foot + b[at_b]) / 2.0 + way * BULGE_M.min(gap_m / 2.0);
    let middle: Vec<Vec2> = tail_b
        .iter()
        .map(|p| (p + foot_on(&a, &lengths, *p).1) / 2.0)
        .filter(|p| (p - tip).dot(&way) > 0.1)
        .collect();

    let mut kept_a = kept_a;
    kept_a.extend(nose);
    for (end, mut points) in [(near, kept_a), (far, crate::polyline::simplify(&kept_b, 0.02, 20.0))] {
        if !end.last {
            points.reverse();
        }
        map.road_edges[end.line].points = points.into();
    }
    let mut ring = tail_a;
    ring.extend(tail_b.iter().rev());
    let id = (largest_id(map) + 1).to_string();
    map.drivable.push(Area { id, polygon: ring.into(), holes: Vec::new() });
    let mut line = vec![tip];
    line.extend(middle);
    line.push(far.point);
    paint(map, crate::polyline::simplify(&line, 0.03, 20.0), far.point);
}

/// Extends the painted line that ends at `from` along `points`, which lead there.
fn paint(map: &mut LaneMap, points: Vec<Vec2>, from: Vec2) {
    let near = |p: Option<&Vec2>| p.is_some_and(|p| (p - from).norm() < PAINT_M);
    let way = from - points[0];
    // The line may overlap the median a little.
    let before = |end: Vec2| -> Vec<Vec2> {
        points[..points.len() - 1].iter().copied().filter(|p| (end - p).dot(&way) > 0.0).collect()
    };
    let yellow = |l: &&mut TypedLine| l.line_type.contains("yellow");
    for line in map.road_lines.iter_mut().filter(yellow) {
        let xy = &mut line.points.xy;
        if near(xy.first()) {
            let more = before(xy[0]);
            xy.splice(0..0, more);
        } else if near(xy.last()) {
            let more = before(xy[xy.len() - 1]);
            xy.extend(more.into_iter().rev());
        } else {
            continue;
        }
        line.points.z_m = None;
        return;
    }
}

/// Arc length and position of the point of a line that is nearest to `p`.
fn foot_on(line: &[Vec2], lengths: &[f64], p: Vec2) -> (f64, Vec2) {
    let mut best = (f64::INFINITY, 0.0, line[0]);
    for (w, s) in line.windows(2).zip(lengths) {
        let along = w[1] - w[0];
        let share = ((p - w[0]).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        let foot = w[0] + along * share;
        let gap = (foot - p).norm();
        if gap < best.0 {
            best = (gap, s + along.norm() * share, foot);
        }
    }
    (best.1, best.2)
}

/// Greatest integer id of the map.
fn largest_id(map: &LaneMap) -> u64 {
    let lines = map.road_lines.iter().chain(&map.road_edges).map(|l| &l.id);
    let areas = map.crosswalks.iter().chain(&map.driveways).chain(&map.drivable).map(|a| &a.id);
    let ids = map.lanes.iter().map(|l| &l.id).chain(lines).chain(areas);
    ids.chain(map.stop_signs.iter().map(|s| &s.id)).filter_map(|id| id.parse().ok()).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(id: &str, line_type: &str, points: &[(f64, f64)]) -> TypedLine {
        let points: Vec<Vec2> = points.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        TypedLine { id: id.into(), line_type: line_type.into(), points: points.into() }
    }

    #[test]
    fn a_median_ends_in_a_round_nose() {
        let sides = |y: f64| line("1", "median", &[(0.0, y), (20.0, y)]);
        let mut map = LaneMap { road_edges: vec![sides(0.0), sides(1.6)], ..LaneMap::default() };
        close(&mut map, |p| p.x < 0.5);
        let points = &map.road_edges[0].points.xy;
        assert_eq!(points[0], Vec2::new(0.0, 0.0), "the cut end stays open");
        assert!((points[points.len() - 1] - Vec2::new(20.0, 1.6)).norm() < 1e-9);
        let most = points.iter().map(|p| p.x).fold(0.0, f64::max);
        assert!((most - 20.6).abs() < 1e-9, "{most}");
    }

    #[test]
    fn a_median_that_narrows_is_cut_where_it_can_still_be_built() {
        // One side continues to the point at x = 30, the other ended a little earlier beside it.
        let straight = line("1", "median", &[(0.0, 0.0), (29.0, 0.0)]);
        let slanted = line("2", "median", &[(0.0, 3.0), (30.0, 0.0)]);
        let paint = line("3", "solid_double_yellow", &[(30.0, 0.0), (60.0, 0.0)]);
        let mut map =
            LaneMap { road_edges: vec![straight, slanted], road_lines: vec![paint], ..LaneMap::default() };
        close(&mut map, |p| p.x < 0.5);
        // They are 0.8 m apart at x = 22.
        let ends: Vec<f64> = map.road_edges.iter().map(|e| e.points.xy[e.points.xy.len() - 1].x).collect();
        assert!(ends.iter().all(|x| (21.0..22.5).contains(x)), "{ends:?}");
        let first = map.road_lines[0].points.xy[0];
        assert!((21.5..23.0).contains(&first.x) && (0.2..0.6).contains(&first.y), "{first:?}");
        assert_eq!((map.drivable.len(), map.drivable[0].id.as_str()), (1, "4"));
    }

    #[test]
    fn kerbs_that_all_but_meet_do() {
        let ramp = line("1", "boundary", &[(0.0, 3.0), (20.0, 0.3)]);
        let road = line("2", "boundary", &[(0.0, 0.0), (20.0, 0.0)]);
        let mut map = LaneMap { road_edges: vec![ramp, road], ..LaneMap::default() };
        close(&mut map, |p| p.x < 0.5);
        assert_eq!(map.road_edges[0].points.xy.len() + map.road_edges[1].points.xy.len(), 5);
    }
}
