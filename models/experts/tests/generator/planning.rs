//! Stages of planning that an evaluation may switch off.

use super::*;
use ::scene::routes::LaneGraph;
use experts::Planning;
use experts::features::agent::{AgentPlan, plan};
use experts::planning::anchors::PathKind;
use experts::planning::world::World;

fn planned(scene: &Scene, planning: Planning) -> AgentPlan {
    let mut world = World::new(scene, Arc::new(LaneGraph::new(&scene.map)), 0);
    world.planning = planning;
    let who = world.present.iter().find(|p| scene.agents[p.index].id == "1").unwrap();
    plan(&world, who)
}

#[test]
fn each_takes_away_its_own_part_alone() {
    for goal in [0, 7] {
        let scene = with_goal(crossing(), "1", goal);
        let all = planned(&scene, Planning::default());
        assert!(all.anchors.iter().all(|a| a.route.is_some()));

        let free = planned(&scene, Planning { routes: false, ..Planning::default() });
        assert!(free.anchors.iter().all(|a| a.route.is_none() && a.kind != PathKind::Route));
        assert_eq!(free.features.neighbours, all.features.neighbours);
        assert_eq!(free.features.own, all.features.own);
        // The anchors of the same car without a lane nearby.
        let mut bare = scene.clone();
        bare.map = LaneMap::default().into();
        let bare = planned(&bare, Planning::default());
        let points = |p: &AgentPlan| p.anchors.iter().map(|a| a.path.points().to_vec()).collect::<Vec<_>>();
        assert_eq!(points(&free), points(&bare));
    }
}

#[test]
fn an_answer_shows_it() {
    let answer = |planning| {
        let mut request = ask(crossing(), Some(&["1"]));
        request.stages.planning = planning;
        run(&GENERATOR, request).samples
    };
    let all = answer(Planning::default());
    assert_ne!(answer(Planning { routes: false, ..Planning::default() }), all);
    // Without a goal the projection only enforces the limits.
    assert_eq!(answer(Planning { projection: false, ..Planning::default() }), all);
}

#[test]
fn without_projection_a_goal_is_seen_but_not_met() {
    let scene = with_goal(crossing(), "1", 7);
    let goal = scene.agents.iter().find(|a| a.id == "1").unwrap().conditions.goal;
    let (position, speed_mps) = (goal.position.unwrap(), goal.speed_mps.unwrap());
    let left = |projection| {
        let mut request = ask(scene.clone(), Some(&["1"]));
        request.stages.planning.projection = projection;
        let answer = run(&GENERATOR, request);
        let of_future = |future: &::scene::Future| {
            let end = future.states[goal.step_in_window(0.0) - 1];
            (end.position() - position).norm() + (end.speed_mps() - speed_mps).abs()
        };
        answer.samples[0].agents["1"].modes.iter().map(of_future).fold(0.0, f64::max)
    };
    let (with, without) = (left(true), left(false));
    assert!(with < 1e-3 && without > 10.0 * with.max(1e-3), "{with} and {without}");
}
