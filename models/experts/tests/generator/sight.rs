//! What an evaluation may take away from what the experts see.

use super::*;
use experts::Sight;
use experts::features::agent::{Planned, plan};
use experts::features::anchors::PathKind;
use experts::features::world::{MapIndex, World};

fn planned(scene: &Scene, sight: Sight) -> Planned {
    let mut world = World::new(scene, Arc::new(MapIndex::new(&scene.map)), 0);
    world.sight = sight;
    let who = world.present.iter().find(|p| scene.agents[p.index].id == "1").unwrap();
    plan(&world, who)
}

#[test]
fn each_takes_away_its_own_part_alone() {
    for goal in [0, 7] {
        let scene = with_goal(crossing(), "1", goal);
        let all = planned(&scene, Sight::default());
        assert!(!all.features.pieces.is_empty() && all.anchors.iter().all(|a| a.route.is_some()));

        let blind = planned(&scene, Sight { pieces: false, ..Sight::default() });
        assert!(blind.features.pieces.is_empty());
        assert_eq!(blind.features.anchors, all.features.anchors);
        assert_eq!(blind.features.neighbours, all.features.neighbours);

        let free = planned(&scene, Sight { routes: false, ..Sight::default() });
        assert!(free.anchors.iter().all(|a| a.route.is_none() && a.kind != PathKind::Route));
        assert_eq!(free.features.pieces.len(), all.features.pieces.len());
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
    assert_ne!(answer(Sight { pieces: false, ..Sight::default() }), all);
    assert_ne!(answer(Sight { routes: false, ..Sight::default() }), all);
}
