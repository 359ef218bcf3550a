//! Tests over synthetic maps.

use super::sample_maps::{crossing, crosswalk, lane, line, map, ring, two_lanes};
use super::*;
use crate::map::LaneType;
use crate::{AgentType, LaneMap, Vec2};

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn ids(map: &LaneMap, route: &Route) -> Vec<String> {
    route.legs.iter().map(|leg| map.lanes[leg.lane].id.clone()).collect()
}

fn assert_continuous(path: &Polyline) {
    for pair in path.points().windows(2) {
        assert!((pair[1] - pair[0]).norm() <= 1.5, "jump from {:?} to {:?}", pair[0], pair[1]);
    }
}

#[test]
fn links_are_mutual_and_rebuilt_where_missing() {
    let graph = LaneGraph::new(&crossing());
    let into = graph.lane_index("w_in").unwrap();
    assert_eq!(graph.lanes()[into].successors.len(), 3);
    for next in &graph.lanes()[into].successors {
        assert_eq!(graph.lanes()[*next].predecessors, [into]);
    }
    let bare = map(vec![
        lane("a", line(v(0.0, 0.0), v(20.0, 0.0))),
        lane("b", line(v(20.3, 0.2), v(40.0, 2.0))),
        lane("c", line(v(20.0, 0.0), v(20.0, 30.0))),
    ]);
    let graph = LaneGraph::new(&bare);
    assert_eq!(graph.lanes()[0].successors, [1], "b goes on, c turns too sharply");
    assert_eq!(graph.lanes()[1].predecessors, [0]);
}

#[test]
fn sides_come_from_the_geometry_when_none_are_recorded() {
    let graph = LaneGraph::new(&two_lanes());
    let right = &graph.lanes()[0];
    assert!(right.right.is_empty());
    assert_eq!(right.left.len(), 1);
    assert_eq!(right.left[0].lane, 1);
    assert!((right.left[0].across(150.0).unwrap() - 150.0).abs() < 0.5);
    assert_eq!(graph.lanes()[1].right[0].lane, 0);
}

/// Hundreds of overlapping lanes are not streets; a search for neighbours would take minutes.
#[test]
fn lanes_that_lie_over_each_other_have_no_sides_and_no_links() {
    let heap =
        |n: usize| map((0..n).map(|i| lane(i.to_string(), line(v(0.0, 0.0), v(2_000.0, 0.0)))).collect());
    let graph = LaneGraph::new(&heap(500));
    assert!(graph.lanes().iter().all(|lane| lane.left.is_empty() && lane.right.is_empty()));
    let knot = |n: usize| {
        let into = (0..n).map(|i| lane(format!("in {i}"), line(v(0.0, 0.0), v(20.0, 0.0))));
        let out = (0..n).map(|i| lane(format!("out {i}"), line(v(20.0, 0.0), v(40.0, 0.0))));
        LaneGraph::new(&map(into.chain(out).collect()))
    };
    assert!(knot(60).lanes()[..60].iter().all(|lane| lane.successors.len() == 60));
    assert!(knot(70).lanes().iter().all(|lane| lane.successors.is_empty()));
}

#[test]
fn nearest_lanes_are_exact() {
    let graph = LaneGraph::new(&crossing());
    let hits = graph.nearest_for(v(-50.0, -1.0), 4.0, AgentType::Vehicle);
    assert_eq!(hits[0].lane, graph.lane_index("w_in").unwrap());
    assert!((hits[0].lateral_m - 0.75).abs() < 1e-9 && (hits[0].s_m - 62.0).abs() < 1e-9);
    assert_eq!(hits[1].lane, graph.lane_index("w_out").unwrap());
    assert!(graph.nearest_for(v(-50.0, -1.0), 4.0, AgentType::Pedestrian).is_empty());
}

#[test]
fn crossing_gives_three_ways() {
    let map = crossing();
    let graph = LaneGraph::new(&map);
    let pose = Pose::xyh(-40.0, -1.5, 0.05);
    let routes = routes_ahead(&graph, pose, AgentType::Vehicle, route_length_m(8.0));
    assert_eq!(routes.len(), 3);
    assert_eq!(ids(&map, &routes[0]), ["w_in", "w_in>e", "e_out"], "straight on is the best start");
    for route in &routes {
        assert_continuous(&route.path);
        assert!((route.path.length_m() - route_length_m(8.0)).abs() < 3.0);
        assert!((route.lateral_m - 0.25).abs() < 1e-6 && (route.heading_error_rad - 0.05).abs() < 1e-6);
        assert_eq!(route.limits_mps.len(), route.path.points().len());
        assert!(!route.terminal);
    }
}

#[test]
fn a_lane_beside_is_a_route_and_the_end_is_known() {
    let graph = LaneGraph::new(&two_lanes());
    let routes = routes_ahead(&graph, Pose::xyh(150.0, 0.3, 0.0), AgentType::Vehicle, 100.0);
    assert_eq!(routes.len(), 2);
    assert!((routes[1].lateral_m + 3.2).abs() < 0.1);
    assert!(routes.iter().all(|r| r.terminal && (r.path.length_m() - 50.0).abs() < 1.0));
}

/// A motorway entry: its lane ends beside one that continues.
#[test]
fn a_lane_that_ends_is_left_before_its_end() {
    let entry = lane("entry", line(v(-200.0, 0.0), v(0.0, 0.0)));
    let through = lane("through", line(v(-200.0, 3.5), v(300.0, 3.5)));
    let map = map(vec![entry, through]);
    let graph = LaneGraph::new(&map);
    let routes = routes_ahead(&graph, Pose::xyh(-180.0, 0.0, 0.0), AgentType::Vehicle, 300.0);
    assert_eq!(ids(&map, &routes[0]), ["entry", "through"]);
    assert_continuous(&routes[0].path);
    let lateral_m = |x: f64| {
        let foot = routes[0].path.project(v(x, 0.0));
        routes[0].path.sample(foot.s_m).position.y
    };
    assert!(lateral_m(-100.0).abs() < 0.1 && (lateral_m(-10.0) - 3.5).abs() < 0.1);
    assert!(!routes[0].terminal && routes[0].path.length_m() > 295.0);
    // Too near the end to change: the lane ends.
    let late = routes_ahead(&graph, Pose::xyh(-6.0, 0.0, 0.0), AgentType::Vehicle, 100.0);
    assert!(late[0].terminal);
    let leaves_m = |lane: usize| graph.leaves_before_m(lane, AgentType::Vehicle);
    assert!((100.0..190.0).contains(&leaves_m(0).unwrap()) && leaves_m(1).is_none());
}

#[test]
fn relaxed_start_off_the_lane() {
    let graph = LaneGraph::new(&two_lanes());
    let off = Pose::xyh(0.0, -5.0, 1.0);
    assert!(!routes_ahead(&graph, off, AgentType::Vehicle, 60.0).is_empty());
    assert!(routes_ahead(&graph, Pose::xyh(0.0, -8.0, 1.0), AgentType::Vehicle, 60.0).is_empty());
    assert!(routes_ahead(&graph, Pose::xyh(0.0, 0.0, 3.0), AgentType::Vehicle, 60.0).is_empty());
}

#[test]
fn rings_end_and_go_round() {
    let graph = LaneGraph::new(&ring());
    let start = graph.lane_index("e0").unwrap();
    let pose = graph.lanes()[start].path.sample(40.0);
    let routes = routes_ahead(&graph, pose, AgentType::Vehicle, 100.0);
    assert!(routes.len() >= 3, "an exit at each quarter: {}", routes.len());
    let mut circle = lane("o", ring().lanes[0].points.xy.clone());
    circle.successors = vec!["o".into()];
    let graph = LaneGraph::new(&map(vec![circle]));
    let pose = graph.lanes()[0].path.sample(1.0);
    assert!(routes_ahead(&graph, pose, AgentType::Vehicle, 200.0).len() <= 1);
}

#[test]
fn people_walk_over_crosswalks_both_ways() {
    let graph = LaneGraph::new(&crosswalk());
    let east = routes_ahead(&graph, Pose::xyh(2.0, 0.5, 0.0), AgentType::Pedestrian, 40.0);
    assert_eq!(east.len(), 1);
    assert!((east[0].path.length_m() - 40.0).abs() < 2.0 && (east[0].lateral_m - 0.5).abs() < 1e-6);
    let west = routes_ahead(&graph, Pose::xyh(20.0, 0.0, 3.1), AgentType::Pedestrian, 40.0);
    assert!(west[0].path.last().position.x.abs() < 1.0 && west[0].terminal);
    assert_eq!(graph.lanes().iter().filter(|l| l.lane_type == LaneType::Sidewalk).count(), 4);
}

#[test]
fn base_paths_begin_and_end_where_asked() {
    let graph = LaneGraph::new(&crossing());
    let pose = Pose::xyh(-40.0, -1.0, 0.1);
    for route in routes_ahead(&graph, pose, AgentType::Vehicle, route_length_m(8.0)) {
        let path = base_path(&route.path, pose, 8.0, AgentType::Vehicle, None);
        assert_continuous(&path);
        assert_eq!(path.first().position, pose.position);
        assert!((path.first().heading_rad - 0.1).abs() < 0.02, "{}", path.first().heading_rad);
        assert!((path.last().position - route.path.last().position).norm() < 1e-6);
        assert!(path.max_curvature(0.0, 1e3, 2.0) < 0.2, "{}", path.max_curvature(0.0, 1e3, 2.0));
        let aim = route.path.sample(50.0);
        let left = Vec2::new(-aim.direction().y, aim.direction().x);
        let goal = EndPose {
            position: aim.position + 1.2 * left,
            heading_rad: Some(aim.heading_rad - 0.1),
            speed_mps: 10.0,
        };
        let path = base_path(&route.path, pose, 8.0, AgentType::Vehicle, Some(goal));
        assert_continuous(&path);
        assert!((path.first().position - pose.position).norm() < 1e-9);
        assert!((path.last().position - goal.position).norm() < 1e-9);
        assert!(crate::wrap_angle(path.last().heading_rad - aim.heading_rad + 0.1).abs() < 0.03);
        assert!(path.max_curvature(0.0, 1e3, 2.0) < 0.3, "{}", path.max_curvature(0.0, 1e3, 2.0));
    }
}

fn query(pose: Pose, goal: Vec2, heading: Option<f64>) -> GoalQuery {
    GoalQuery {
        pose,
        speed_mps: 8.0,
        agent_type: AgentType::Vehicle,
        goal,
        goal_heading_rad: heading,
        least_effort_m: None,
    }
}

fn assert_reached(route: &GoalRoute, query: &GoalQuery) {
    assert_continuous(&route.route.path);
    let end = EndPose { position: query.goal, heading_rad: query.goal_heading_rad, speed_mps: 10.0 };
    let path = base_path(&route.route.path, query.pose, query.speed_mps, query.agent_type, Some(end));
    assert_continuous(&path);
    assert!((path.first().position - query.pose.position).norm() < 1e-9);
    assert!((path.last().position - query.goal).norm() < 1e-9);
}

#[test]
fn forward_routes_reach_each_arm() {
    let map = crossing();
    let graph = LaneGraph::new(&map);
    let pose = Pose::xyh(-40.0, -1.5, 0.0);
    for (goal, way) in [(v(40.0, -1.0), "w_in>e"), (v(-2.5, -50.0), "w_in>s"), (v(2.0, 50.0), "w_in>n")] {
        let query = query(pose, goal, None);
        let routes = routes_to_goal(&graph, &query);
        assert_eq!(routes[0].kind, RouteKind::Forward);
        assert_eq!(ids(&map, &routes[0].route)[1], way);
        assert!(routes[0].goal_lateral_m.abs() < 1.0);
        assert_reached(&routes[0], &query);
    }
}

#[test]
fn u_turns_are_joined_from_behind() {
    let graph = LaneGraph::new(&crossing());
    let back = query(Pose::xyh(-40.0, -1.5, 0.0), v(-60.0, 1.75), None);
    let routes = routes_to_goal(&graph, &back);
    assert_eq!(routes.len(), 1);
    assert_eq!(routes[0].kind, RouteKind::Joined);
    assert_reached(&routes[0], &back);
    let strict = GoalQuery { least_effort_m: Some(10.0), ..back };
    assert!(routes_to_goal(&graph, &strict).is_empty(), "longer than 1.25 of least effort");
    // Pulling out of a driveway, across the lanes.
    let out = query(Pose::xyh(-60.0, -12.0, 1.57), v(-20.0, -1.75), Some(0.0));
    let routes = routes_to_goal(&graph, &out);
    assert_eq!(routes[0].kind, RouteKind::Joined);
    assert_reached(&routes[0], &out);
}

#[test]
fn goals_beside_the_road_are_met() {
    let graph = LaneGraph::new(&two_lanes());
    let off = query(Pose::xyh(-50.0, 0.0, 0.0), v(0.0, -9.0), None);
    let routes = routes_to_goal(&graph, &off);
    assert_eq!(routes[0].kind, RouteKind::OffLane);
    assert!((routes[0].route.path.last().position - off.goal).norm() < 1e-9);
    assert_reached(&routes[0], &off);
    assert!(routes_to_goal(&graph, &query(off.pose, v(0.0, -90.0), None)).is_empty());
}

#[test]
fn lane_changes_lead_to_the_lane_beside() {
    let graph = LaneGraph::new(&two_lanes());
    for x in [-20.0, 0.0, 40.0, 150.0] {
        let beside = query(Pose::xyh(-50.0, 0.1, 0.0), v(x, 3.4), Some(0.0));
        let routes = routes_to_goal(&graph, &beside);
        assert_eq!(routes[0].kind, RouteKind::Forward);
        assert_reached(&routes[0], &beside);
        assert!(routes[0].goal_lateral_m.abs() < 0.2);
    }
}

#[test]
fn lane_changes_are_as_long_as_the_speed_asks() {
    // In pieces shorter than a change at speed, as in recordings.
    let pieces = |name: &str, y: f64| {
        let piece = |i: usize| {
            let x = -200.0 + 40.0 * i as f64;
            let mut lane = lane(format!("{name} {i}"), line(v(x, y), v(x + 40.0, y)));
            lane.successors = if i < 9 { vec![format!("{name} {}", i + 1)] } else { vec![] };
            lane
        };
        (0..10).map(piece).collect::<Vec<_>>()
    };
    let graph = LaneGraph::new(&map([pieces("right", 0.0), pieces("left", 3.5)].concat()));
    for speed_mps in [8.0, 14.0, 20.0, 27.0] {
        let (pose, goal) = (Pose::xyh(-150.0, 0.0, 0.0), v(-150.0 + 7.0 * speed_mps, 3.5));
        let asked = GoalQuery { speed_mps, ..query(pose, goal, Some(0.0)) };
        let routes = routes_to_goal(&graph, &asked);
        let end = EndPose { position: goal, heading_rad: Some(0.0), speed_mps: 10.0 };
        let path = base_path(&routes[0].route.path, pose, speed_mps, AgentType::Vehicle, Some(end));
        let sharpest = path.curvatures(2.0).into_iter().map(f64::abs).fold(0.0, f64::max);
        let sideways_mps2 = sharpest * speed_mps * speed_mps;
        assert!(sideways_mps2 < 2.0, "{sideways_mps2} at {speed_mps}");
        // Staying in the lane is not a change.
        let asked = GoalQuery { goal: v(goal.x, 0.0), ..asked };
        let route = &routes_to_goal(&graph, &asked)[0].route;
        assert!(route.path.points().iter().all(|p| p.y.abs() < 1e-6), "{speed_mps}");
    }
}

#[test]
fn graphs_are_shared_between_threads() {
    fn shared<T: Send + Sync>(_: &T) {}
    shared(&LaneGraph::new(&crossing()));
}

#[test]
fn recorded_sides_hold_over_their_ranges() {
    let mut map = two_lanes();
    let beside = crate::map::Neighbor {
        lane: "left".into(),
        own_range: (50, 100),
        other_range: (60, 110),
        boundaries: Vec::new(),
    };
    map.lanes[0].left_neighbors = vec![beside];
    let graph = LaneGraph::new(&map);
    let side = &graph.lanes()[0].left[0];
    assert!(side.same_direction && side.across(99.0).is_none());
    assert!((side.across(150.0).unwrap() - 170.0).abs() < 1e-6);
    assert!(graph.lanes()[1].right.is_empty(), "sides are as recorded once some are");
}

#[test]
fn a_goal_beyond_the_last_lane_is_met_straight_on() {
    let path = Polyline::new(line(v(0.0, 0.0), v(30.0, 0.0)));
    let goal = EndPose { position: v(45.0, 1.0), heading_rad: None, speed_mps: 10.0 };
    let bent = base_path(&path, Pose::xyh(2.0, 0.5, 0.0), 5.0, AgentType::Vehicle, Some(goal));
    assert_eq!(bent.last().position, goal.position);
    assert!(bent.last().heading_rad.abs() < 0.02 && bent.max_curvature(0.0, 99.0, 2.0) < 0.05);
}

#[test]
fn a_goal_behind_is_met_by_one_cubic() {
    let path = Polyline::new(line(v(0.0, 0.0), v(30.0, 0.0)));
    let goal = EndPose { position: v(-12.0, 6.0), heading_rad: Some(3.0), speed_mps: 10.0 };
    let bent = base_path(&path, Pose::xyh(2.0, 0.0, 0.0), 5.0, AgentType::Vehicle, Some(goal));
    assert!((bent.last().position - goal.position).norm() < 1e-9);
    assert!((bent.first().heading_rad).abs() < 0.1);
}
