//! The mirror image of a scene: left and right swapped, so that a few recorded scenes teach twice as much.

use scene::map::{Area, Lane, LaneMap, Points, TypedLine};
use scene::{Scene, State, Vec2};

/// The scene with y and all headings turned over. What drives on the right drives on the left in it.
pub fn mirrored(scene: &Scene) -> Scene {
    let mut out = scene.clone();
    out.map = map(&scene.map).into();
    out.generated = None;
    for signal in &mut out.signals {
        signal.stop = signal.stop.map(point);
    }
    for agent in &mut out.agents {
        for state in agent.track.states.iter_mut().flatten() {
            let State { y_m, heading_rad, vy_mps, .. } = *state;
            (state.y_m, state.heading_rad, state.vy_mps) = (-y_m, -heading_rad, -vy_mps);
        }
        let conditions = &mut agent.conditions;
        for position in [&mut conditions.start.position, &mut conditions.goal.position] {
            *position = position.map(point);
        }
        for heading in [&mut conditions.start.heading_rad, &mut conditions.goal.heading_rad] {
            *heading = heading.map(|h| -h);
        }
    }
    out
}

fn point(p: Vec2) -> Vec2 {
    Vec2::new(p.x, -p.y)
}

fn points(line: &Points) -> Points {
    Points { xy: line.xy.iter().copied().map(point).collect(), z_m: line.z_m.clone() }
}

fn map(map: &LaneMap) -> LaneMap {
    let lines = |list: &[TypedLine]| {
        list.iter().map(|l| TypedLine { points: points(&l.points), ..l.clone() }).collect()
    };
    let areas = |list: &[Area]| {
        let area = |a: &Area| Area {
            id: a.id.clone(),
            polygon: points(&a.polygon),
            holes: a.holes.iter().map(points).collect(),
        };
        list.iter().map(area).collect()
    };
    let lane = |l: &Lane| Lane {
        points: points(&l.points),
        left_boundary: l.right_boundary.clone(),
        right_boundary: l.left_boundary.clone(),
        left_neighbors: l.right_neighbors.clone(),
        right_neighbors: l.left_neighbors.clone(),
        ..l.clone()
    };
    LaneMap {
        lanes: map.lanes.iter().map(lane).collect(),
        road_lines: lines(&map.road_lines),
        road_edges: lines(&map.road_edges),
        crosswalks: areas(&map.crosswalks),
        speed_bumps: areas(&map.speed_bumps),
        driveways: areas(&map.driveways),
        stop_signs: map
            .stop_signs
            .iter()
            .map(|s| scene::map::StopSign { position: point(s.position), ..s.clone() })
            .collect(),
        drivable: areas(&map.drivable),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{log, scene, shifted};
    use experts::features::agent::plan;
    use experts::planning::world::World;
    use scene::routes::LaneGraph;
    use std::sync::Arc;

    #[test]
    fn twice_is_the_scene_again() {
        let mut first = scene(vec![log("a", 8.0, 91), shifted(log("b", 5.0, 91), 30.0, 3.5)]);
        first.agents[0].conditions.goal.position = Some(Vec2::new(50.0, 3.0));
        let other = mirrored(&first);
        assert_ne!(other, first);
        assert_eq!(mirrored(&other), first);
    }

    #[test]
    fn anchors_are_mirrored_too() {
        let mut first = scene(vec![log("a", 8.0, 91)]);
        first.agents[0].conditions.goal.position = Some(Vec2::new(60.0, 3.5));
        let ends = |scene: &Scene| -> Vec<Vec2> {
            let world = World::new(scene, Arc::new(LaneGraph::new(&scene.map)), 0);
            let planned = plan(&world, &world.present[0]);
            planned.anchors.iter().map(|a| a.path.last().position).collect()
        };
        let (here, there) = (ends(&first), ends(&mirrored(&first)));
        assert_eq!(here.len(), there.len());
        assert!(here.iter().zip(&there).all(|(a, b)| (point(*a) - b).norm() < 1e-6), "{here:?} {there:?}");
    }
}
