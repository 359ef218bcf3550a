//! What an evaluation may take away from what the experts see.

use super::*;
use ::scene::routes::LaneGraph;
use experts::Sight;
use experts::features::agent::{Planned, plan};
use experts::features::anchors::PathKind;
use experts::features::world::World;

fn planned(scene: &Scene, sight: Sight) -> Planned {
    let mut world = World::new(scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    world.sight = sight;
    let who = world.present.iter().find(|p| scene.agents[p.index].id == "1").unwrap();
    plan(&world, who)
}

#[test]
fn each_takes_away_its_own_part_alone() {
    for goal in [0, 7] {
        let scene = with_goal(crossing(), "1", goal);
        let all = planned(&scene, Sight::default());
        assert!(all.anchors.iter().all(|a| a.route.is_some()));

        let free = planned(&scene, Sight { routes: false });
        assert!(free.anchors.iter().all(|a| a.route.is_none() && a.kind != PathKind::Route));
        assert_eq!(free.features.neighbours, all.features.neighbours);
        assert_eq!(free.features.own, all.features.own);
        // The anchors of the same car where no lane is near.
        let mut bare = scene.clone();
        bare.map = Arc::new(LaneMap::default());
        let bare = planned(&bare, Sight::default());
        let points = |p: &Planned| p.anchors.iter().map(|a| a.path.points().to_vec()).collect::<Vec<_>>();
        assert_eq!(points(&free), points(&bare));
    }
}

#[test]
fn an_answer_shows_it() {
    let answer = |sight| {
        let mut request = ask(crossing(), Some(&["1"]));
        request.stages.sight = sight;
        run(&GENERATOR, request).samples
    };
    let all = answer(Sight::default());
    assert_ne!(answer(Sight { routes: false }), all);
}
