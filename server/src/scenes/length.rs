//! Approximate lengths of scenes and maps as JSON, by which the cost of work on them is estimated. They count every
//! part that a client can make long.

use super::{record, weight};
use formats::native::{AnyDoc, GeneratedDoc, MapDoc, MapField, PointsDoc, SceneDoc};
use scene::{LaneMap, Scene};

/// Approximate bytes of a step of a road user.
const STEP: usize = 40;
/// Approximate bytes of a point of a map.
const POINT: usize = 20;
/// Approximate bytes of a link of a lane.
const LINK: usize = 10;

/// Approximate bytes of a scene as JSON.
pub fn of_scene(scene: &Scene) -> usize {
    let steps: usize = scene.agents.iter().map(|agent| agent.track.states.len()).sum();
    let samples = scene.generated.iter().flat_map(|g| &g.samples);
    let modes = samples.flat_map(|s| s.agents.values()).flat_map(|f| &f.modes);
    let made: usize = modes.map(|future| future.states.len()).sum();
    (steps + made) * STEP + of_map(&scene.map) + scene.extra.values().map(weight::of_value).sum::<usize>()
}

/// Approximate bytes of a map as JSON.
pub fn of_map(map: &LaneMap) -> usize {
    let links: usize = map.lanes.iter().map(|lane| lane.predecessors.len() + lane.successors.len()).sum();
    let (lines, points) = record::size(map);
    (lines + points) * POINT + links * LINK
}

/// Approximate bytes of a document.
pub fn of_doc(doc: &SceneDoc) -> usize {
    let steps: usize = doc.agents.iter().map(|agent| agent.track.x_m.len()).sum();
    let map = match &doc.map {
        MapField::Inline(map) => of_map_doc(map),
        MapField::Ref(_) => 0,
    };
    let made = doc.generated.as_ref().map_or(0, states) * STEP;
    let kept: usize = doc.extra.0.values().map(|AnyDoc(value)| weight::of_value(value)).sum();
    steps * STEP + map + made + kept
}

fn states(generated: &GeneratedDoc) -> usize {
    let agents = generated.samples.iter().flat_map(|sample| sample.agents.0.values());
    agents.flat_map(|agent| &agent.modes).map(|mode| mode.x_m.len()).sum()
}

fn of_map_doc(map: &MapDoc) -> usize {
    let lanes = map.lanes.iter().map(|lane| &lane.points_m);
    let lines = map.road_lines.iter().map(|line| &line.points_m);
    let edges = map.road_edges.iter().map(|edge| &edge.points_m);
    let areas = [&map.crosswalks, &map.speed_bumps, &map.driveways].into_iter().flatten();
    let drivable = map.drivable.iter().flat_map(|area| std::iter::once(&area.polygon_m).chain(&area.holes_m));
    let all = lanes.chain(lines).chain(edges).chain(areas.map(|area| &area.polygon_m)).chain(drivable);
    let length = |points: &PointsDoc| (1 + points.0.xy.len()) * POINT;
    let links: usize = map.lanes.iter().map(|lane| lane.predecessors.len() + lane.successors.len()).sum();
    all.map(length).sum::<usize>() + links * LINK
}
