//! Content of a scene's small picture: simplified roads, and the road users present at the first step.

use formats::native::{
    MapDoc, MapField, MapForm, MetaDoc, PointsDoc, SceneDoc, TrackDoc, round_m, round_rad,
};
use scene::{Scene, State, Track, Vec2};

/// Points of a line that are simplified together: the time of a line grows with their square.
const TOGETHER: usize = 64;
/// Greatest deviation of simplified lines, metres: one pixel of a picture that shows a junction.
const TOLERANCE_M: f64 = 0.4;

/// The scene with simplified lines and the first and last state of each road user, without details that a
/// picture of a few hundred pixels does not show. It is an ordinary scene document.
pub fn preview(scene: &Scene) -> SceneDoc {
    let mut doc = SceneDoc::from_scene(scene, MapForm::Inline);
    doc.meta = MetaDoc { source: doc.meta.source, licence: doc.meta.licence, ..MetaDoc::default() };
    doc.signals.clear();
    doc.generated = None;
    doc.extra.0.clear();
    if let MapField::Inline(map) = &mut doc.map {
        thin(map);
    }
    let tracks = scene.agents.iter().map(|agent| first_and_last(&agent.track));
    let agents = doc.agents.drain(..).zip(tracks);
    doc.agents = agents
        .filter_map(|(agent, track)| track.map(|track| (agent, track)))
        .map(|(mut agent, track)| {
            agent.track = track;
            agent
        })
        .collect();
    doc
}

/// Later road users are not in the picture; the last state shows which ones are parked.
fn first_and_last(track: &Track) -> Option<TrackDoc> {
    let first = track.states.first().filter(|_| track.first_step == 0)?.as_ref()?;
    let last = track.states.iter().rev().flatten().next()?;
    let column = |f: fn(&State) -> f64| vec![f(first), f(last)];
    Some(TrackDoc {
        x_m: column(|s| round_m(s.x_m)),
        y_m: column(|s| round_m(s.y_m)),
        heading_rad: column(|s| round_rad(s.heading_rad)),
        vx_mps: column(|s| round_m(s.vx_mps)),
        vy_mps: column(|s| round_m(s.vy_mps)),
        ..TrackDoc::default()
    })
}

fn thin(map: &mut MapDoc) {
    for lane in &mut map.lanes {
        simplify(&mut lane.points_m);
        // These refer to points by index.
        lane.left_boundary.clear();
        lane.right_boundary.clear();
        lane.left_neighbors.clear();
        lane.right_neighbors.clear();
        lane.speed_limit_mps = None;
    }
    map.road_lines.clear();
    map.stop_signs.clear();
    map.speed_bumps.clear();
    map.road_edges.iter_mut().for_each(|edge| simplify(&mut edge.points_m));
    for area in map.crosswalks.iter_mut().chain(&mut map.driveways) {
        simplify(&mut area.polygon_m);
    }
    for area in &mut map.drivable {
        simplify(&mut area.polygon_m);
        area.holes_m.iter_mut().for_each(simplify);
    }
}

fn simplify(points: &mut PointsDoc) {
    let kept = corners(&points.0.xy, TOLERANCE_M);
    points.0.z_m = None;
    points.0.xy = kept.into_iter().map(|p| Vec2::new(tenths(p.x), tenths(p.y))).collect();
}

fn tenths(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

/// The points that keep the line within the tolerance (Douglas and Peucker, [`TOGETHER`] points at a time), including
/// both ends.
fn corners(points: &[Vec2], tolerance_m: f64) -> Vec<Vec2> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let ends: Vec<usize> = (0..last).step_by(TOGETHER).chain([last]).collect();
    let mut keep = vec![false; points.len()];
    ends.iter().for_each(|end| keep[*end] = true);
    let mut open: Vec<(usize, usize)> = ends.windows(2).map(|pair| (pair[0], pair[1])).collect();
    while let Some((from, to)) = open.pop() {
        let (a, b) = (points[from], points[to]);
        let inner = (from + 1..to).map(|i| (i, distance_m2(points[i], a, b)));
        if let Some((far, d)) = inner.max_by(|p, q| p.1.total_cmp(&q.1))
            && d > tolerance_m * tolerance_m
        {
            keep[far] = true;
            open.extend([(from, far), (far, to)]);
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(p, _)| *p).collect()
}

/// Square of the distance from a point to the segment between two others.
fn distance_m2(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let (abx, aby, apx, apy) = (b.x - a.x, b.y - a.y, p.x - a.x, p.y - a.y);
    let length2 = abx * abx + aby * aby;
    let t = if length2 > 0.0 { ((apx * abx + apy * aby) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (apx - t * abx, apy - t * aby);
    dx * dx + dy * dy
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_lines_keep_their_ends_and_bends_their_corners() {
        let line: Vec<Vec2> = (0..50).map(|i| Vec2::new(f64::from(i), 0.1 * f64::from(i % 2))).collect();
        assert_eq!(corners(&line, 0.4), [line[0], line[49]]);
        let bend: Vec<Vec2> =
            (0..50).map(|i| Vec2::new(f64::from(i.min(25)), f64::from((i - 25).max(0)))).collect();
        assert_eq!(corners(&bend, 0.4), [bend[0], bend[25], bend[49]]);
        let still = vec![Vec2::new(1.0, 1.0); 5];
        assert_eq!(corners(&still, 0.4), [still[0], still[4]]);
        let long: Vec<Vec2> = (0..600).map(|i| Vec2::new(f64::from(i), 0.0)).collect();
        let ends = (0..599).step_by(TOGETHER).chain([599]);
        assert_eq!(corners(&long, 0.4), ends.map(|i| long[i]).collect::<Vec<_>>());
        assert!(corners(&[], 0.4).is_empty());
        assert_eq!(corners(&line[..1], 0.4), line[..1]);
    }
}
