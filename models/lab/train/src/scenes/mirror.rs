//! The mirror image of a scene, which doubles the training data of a few recorded scenes.

use scene::{Scene, State, Vec2};

/// The scene with y and all headings negated: traffic that drives on the right then drives on the left.
pub fn mirrored(scene: &Scene) -> Scene {
    let mut out = scene.clone();
    out.map = scene.map.mirrored().into();
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
