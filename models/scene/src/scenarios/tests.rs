use super::{Casting, Template};
use crate::map::Lane;
use crate::routes::LaneGraph;
use crate::{Agent, AgentType, LaneMap, Scene, Signal, SignalState, State, Subtype, Vec2};
use std::collections::{BTreeMap, BTreeSet};

/// A driver along x (or y) for a whole window.
fn driver(id: &str, at: (f64, f64), velocity: (f64, f64)) -> Agent {
    let state = |i: usize| State {
        x_m: at.0 + velocity.0 * 0.1 * i as f64,
        y_m: at.1 + velocity.1 * 0.1 * i as f64,
        heading_rad: velocity.1.atan2(velocity.0),
        vx_mps: velocity.0,
        vy_mps: velocity.1,
    };
    Agent::bare(id, AgentType::Vehicle, Subtype::Car, (0..91).map(|i| Some(state(i))).collect())
}

fn lane(id: &str, from: (f64, f64), to: (f64, f64)) -> Lane {
    let at = |i: i32| {
        let share = f64::from(i) / 60.0;
        Vec2::new(from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
    };
    Lane::street(id, (0..=60).map(at).collect::<Vec<_>>())
}

/// Two lanes along x, one across them.
fn scene(agents: Vec<Agent>) -> (Scene, LaneGraph) {
    let lanes = vec![
        lane("a", (-100.0, 0.0), (200.0, 0.0)),
        lane("b", (-100.0, 3.5), (200.0, 3.5)),
        lane("c", (40.0, -100.0), (40.0, 200.0)),
    ];
    let map = LaneMap { lanes, ..LaneMap::default() };
    let graph = LaneGraph::new(&map);
    (Scene::bare("test", map, agents), graph)
}

/// Casts with all figures drawn, from the first step on.
fn casting(template: Template, scene: &Scene, graph: &LaneGraph, seed: u64) -> Option<Casting> {
    template.cast(scene, graph, 0, 9.0, seed, &BTreeMap::new())
}

#[test]
fn the_one_who_is_followed_brakes() {
    let (scene, graph) =
        scene(vec![driver("behind", (-15.0, 0.0), (10.0, 0.0)), driver("ahead", (0.0, 0.0), (10.0, 0.0))]);
    for seed in 0..20 {
        let cast = casting(Template::Brake, &scene, &graph, seed).unwrap();
        assert_eq!((cast.actor.as_str(), cast.other.as_deref()), ("ahead", Some("behind")));
        let goal = cast.conditions.goal;
        let (place, time_s) = (goal.position.unwrap(), goal.time_s.unwrap());
        assert_eq!(goal.speed_mps, Some(0.0));
        assert!(place.y.abs() < 0.01 && place.x > 6.0 && place.x < 30.0, "{place}");
        // From 10 m/s to rest at 3.5 to 7.5 m/s2, after at most 1.5 s.
        assert!((1.5..=4.4).contains(&time_s), "{time_s}");
        assert!(cast.words.contains("behind is 10 m behind"), "{}", cast.words);
        assert_eq!(casting(Template::Brake, &scene, &graph, seed), Some(cast));
    }
    let times: BTreeSet<u64> = (0..20)
        .map(|seed| casting(Template::Brake, &scene, &graph, seed).unwrap().conditions.goal.time_s.unwrap())
        .map(|time_s| (time_s * 10.0) as u64)
        .collect();
    assert!(times.len() > 5, "{times:?}");
}

#[test]
fn the_neighbour_cuts_in() {
    let (scene, graph) =
        scene(vec![driver("own", (0.0, 0.0), (10.0, 0.0)), driver("beside", (6.0, 3.5), (10.0, 0.0))]);
    let mut actors = BTreeSet::new();
    for seed in 0..20 {
        let cast = casting(Template::CutIn, &scene, &graph, seed).unwrap();
        let goal = cast.conditions.goal;
        let (place, time_s) = (goal.position.unwrap(), goal.time_s.unwrap());
        let (lane_y, other_x) = if cast.actor == "beside" { (0.0, 0.0) } else { (3.5, 6.0) };
        assert!((place.y - lane_y).abs() < 0.01, "{place}");
        let gap = place.x - (other_x + 10.0 * time_s) - 4.7;
        assert!((1.4..=6.1).contains(&gap), "{gap}");
        actors.insert(cast.actor);
    }
    assert_eq!(actors.len(), 2, "{actors:?}");
}

#[test]
fn a_fixed_figure_holds_and_the_others_stay() {
    let (scene, graph) =
        scene(vec![driver("own", (0.0, 0.0), (10.0, 0.0)), driver("beside", (6.0, 3.5), (10.0, 0.0))]);
    let fixed = |name: &str, value| BTreeMap::from([(name.to_owned(), value)]);
    let goal = |seed, fixed| {
        let cast = Template::CutIn.cast(&scene, &graph, 0, 9.0, seed, &fixed).unwrap();
        (cast.conditions.goal.time_s.unwrap(), cast.conditions.goal.speed_mps.unwrap())
    };
    for seed in 0..10 {
        let free = goal(seed, BTreeMap::new());
        let (time_s, speed_mps) = goal(seed, fixed("speed_share", 0.5));
        assert_eq!((time_s, speed_mps), (free.0, 5.0), "{seed}");
        assert_eq!(goal(seed, fixed("takes_s", 3.0)).0, 3.0, "{seed}");
    }
    for figure in Template::ALL.iter().flat_map(|template| template.figures()) {
        let inside = figure.allowed.0 <= figure.drawn.0 && figure.drawn.1 <= figure.allowed.1;
        assert!(inside, "{}", figure.name);
    }
}

#[test]
fn the_one_at_red_goes_through() {
    let agents = vec![driver("waits", (0.0, 0.0), (8.0, 0.0)), driver("crosses", (40.0, -40.0), (0.0, 10.0))];
    let (mut scene, graph) = scene(agents);
    let stop = Some(Vec2::new(30.0, 0.0));
    scene.signals =
        vec![Signal { lane: "a".into(), stop, stop_z_m: None, runs: vec![(0, SignalState::Stop)] }];
    for seed in 0..20 {
        let cast = casting(Template::Late, &scene, &graph, seed).unwrap();
        assert_eq!((cast.actor.as_str(), cast.other.as_deref()), ("waits", Some("crosses")));
        let goal = cast.conditions.goal;
        let place = goal.position.unwrap();
        // 8 m beyond the crossing at x = 40, within the metre in which the other counts as on the path.
        assert!(place.y.abs() < 0.01 && (place.x - 48.0).abs() < 1.1, "{place}");
        assert!(goal.speed_mps.unwrap() >= 5.0);
    }
}

#[test]
fn who_is_alone_plays_nothing() {
    let (scene, graph) = scene(vec![driver("alone", (0.0, 0.0), (10.0, 0.0))]);
    for template in Template::ALL {
        assert_eq!(casting(template, &scene, &graph, 1), None, "{}", template.name());
    }
}
