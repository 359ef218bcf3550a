//! Property tests over random maps, most of them broken.

use super::sample_maps::{crossing, lane, ring, two_lanes};
use super::*;
use crate::map::LaneType;
use crate::{AgentType, LaneMap, Vec2};
use proptest::prelude::*;

const TYPES: [AgentType; 4] =
    [AgentType::Vehicle, AgentType::Cyclist, AgentType::Pedestrian, AgentType::Other];

/// Lanes with points anywhere (often repeated), any type, and links to anything: themselves, each other in
/// circles, lanes that do not exist.
fn any_map() -> impl Strategy<Value = LaneMap> {
    let corner = (-4..5_i32, -4..5_i32).prop_map(|(x, y)| Vec2::new(f64::from(x), f64::from(y)) * 9.0);
    let kind = prop::sample::select(vec![
        LaneType::SurfaceStreet,
        LaneType::SurfaceStreet,
        LaneType::Undefined,
        LaneType::Freeway,
        LaneType::BikeLane,
        LaneType::Sidewalk,
        LaneType::Parking,
    ]);
    let links = prop::collection::vec(0..9_usize, 0..4);
    let one = (prop::collection::vec(corner, 0..5), kind, links.clone(), links);
    prop::collection::vec(one, 0..8).prop_map(|lanes| {
        let named = |links: Vec<usize>| links.iter().map(|i| format!("l{i}")).collect::<Vec<_>>();
        let lanes = lanes.into_iter().enumerate().map(|(i, (points, lane_type, next, before))| {
            let mut lane = lane(format!("l{i}"), points);
            lane.lane_type = lane_type;
            (lane.successors, lane.predecessors) = (named(next), named(before));
            lane
        });
        LaneMap { lanes: lanes.collect(), ..LaneMap::default() }
    })
}

fn good_map() -> impl Strategy<Value = LaneMap> {
    prop::sample::select(vec![crossing(), ring(), two_lanes()])
}

fn any_pose(reach: f64) -> impl Strategy<Value = Pose> {
    (-reach..reach, -reach..reach, -4.0..4.0_f64).prop_map(|(x, y, h)| Pose::xyh(x, y, h))
}

/// A pose near some lane of the graph, or the pose itself if there is none.
fn near_lane(graph: &LaneGraph, pick: usize, share: f64, off: Pose) -> Pose {
    let drivable: Vec<_> = graph.lanes().iter().filter(|l| l.carries(AgentType::Vehicle)).collect();
    let Some(lane) = drivable.get(pick % drivable.len().max(1)) else { return off };
    let on = lane.path.sample(share * lane.path.length_m());
    Pose::new(on.position + 0.02 * off.position, on.heading_rad + 0.1 * off.heading_rad)
}

fn assert_route(route: &Route) -> Result<(), TestCaseError> {
    prop_assert_eq!(route.limits_mps.len(), route.path.points().len());
    prop_assert!(route.path.points().iter().all(|p| p.x.is_finite() && p.y.is_finite()));
    prop_assert!(route.limits_mps.iter().all(|v| *v > 0.0));
    prop_assert!(route.legs.windows(2).all(|l| l[0].path_from_m <= l[1].path_from_m + 1e-9));
    prop_assert!(route.legs.iter().all(|l| l.from_m <= l.to_m + 1e-9));
    prop_assert!(route.lateral_m.is_finite() && route.heading_error_rad.abs() <= 3.2);
    let caps = speed::speed_caps(&route.path, &route.limits_mps, SpeedRules::default());
    prop_assert!(caps.iter().all(|v| v.is_finite() && *v > 0.0));
    Ok(())
}

fn assert_continuous(path: &Polyline) -> Result<(), TestCaseError> {
    for pair in path.points().windows(2) {
        prop_assert!((pair[1] - pair[0]).norm() <= 1.5, "jump from {:?} to {:?}", pair[0], pair[1]);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn broken_maps_give_sound_routes(
        map in any_map(), off in any_pose(45.0), goal in any_pose(60.0), pick in 0..8_usize,
        share in 0.0..1.0_f64, speed in 0.0..25.0_f64, asked in any::<bool>(),
    ) {
        let graph = LaneGraph::new(&map);
        let pose = near_lane(&graph, pick, share, off);
        for agent_type in TYPES {
            let routes = routes_ahead(&graph, pose, agent_type, route_length_m(speed));
            prop_assert!(routes.len() <= MAX_ROUTES);
            for route in &routes {
                assert_route(route)?;
                let path = base_path(&route.path, pose, speed, agent_type, None);
                prop_assert!((path.first().position - pose.position).norm() < 1e-9);
                assert_continuous(&path)?;
            }
            let query = GoalQuery {
                pose,
                speed_mps: speed,
                agent_type,
                goal: goal.position,
                goal_heading_rad: asked.then_some(goal.heading_rad),
                least_effort_m: None,
            };
            let routes = routes_to_goal(&graph, &query);
            prop_assert!(routes.len() <= MAX_GOAL_ROUTES);
            for found in &routes {
                assert_route(&found.route)?;
                let end = EndPose { position: query.goal, heading_rad: query.goal_heading_rad, speed_mps: 10.0 };
                let path = base_path(&found.route.path, pose, speed, agent_type, Some(end));
                prop_assert!((path.first().position - pose.position).norm() < 1e-6);
                prop_assert!((path.last().position - query.goal).norm() < 1e-6);
                assert_continuous(&path)?;
            }
        }
    }

    #[test]
    fn routes_are_deterministic_and_distinct(
        map in good_map(), off in any_pose(40.0), pick in 0..20_usize, share in 0.0..1.0_f64,
        length in 20.0..150.0_f64,
    ) {
        let graph = LaneGraph::new(&map);
        let pose = near_lane(&graph, pick, share, off);
        let routes = routes_ahead(&graph, pose, AgentType::Vehicle, length);
        prop_assert_eq!(&routes, &routes_ahead(&LaneGraph::new(&map), pose, AgentType::Vehicle, length));
        let best = best_route_ahead(&graph, pose, AgentType::Vehicle, length);
        prop_assert_eq!(routes.first(), best.as_ref());
        for route in &routes {
            assert_route(route)?;
            prop_assert!(route.path.length_m() <= length + 5.0);
            prop_assert!(route.terminal || route.path.length_m() >= 0.9 * length - 5.0);
            assert_continuous(&route.path)?;
        }
    }

    #[test]
    fn goals_ahead_on_the_lanes_are_reached(
        map in good_map(), off in any_pose(20.0), pick in 0..20_usize, share in 0.0..0.7_f64,
        speed in 0.0..15.0_f64, which in 0..6_usize, along in 0.4..1.0_f64,
    ) {
        let graph = LaneGraph::new(&map);
        let pose = near_lane(&graph, pick, share, off);
        let ahead = routes_ahead(&graph, pose, AgentType::Vehicle, route_length_m(speed));
        prop_assume!(!ahead.is_empty());
        let way = &ahead[which % ahead.len()];
        prop_assume!(way.path.length_m() > 25.0);
        let aim = way.path.sample(along * way.path.length_m());
        // On a detour, the straight distance is no measure of the length.
        prop_assume!((aim.position - pose.position).norm() * 1.4 + 20.0 > along * way.path.length_m());
        let query = GoalQuery {
            pose,
            speed_mps: speed,
            agent_type: AgentType::Vehicle,
            goal: aim.position,
            goal_heading_rad: Some(aim.heading_rad),
            least_effort_m: None,
        };
        let routes = routes_to_goal(&graph, &query);
        prop_assert!(!routes.is_empty());
        let end = EndPose { position: query.goal, heading_rad: query.goal_heading_rad, speed_mps: 10.0 };
        let path = base_path(&routes[0].route.path, pose, speed, AgentType::Vehicle, Some(end));
        assert_continuous(&path)?;
        prop_assert!((path.first().position - pose.position).norm() < 1e-6);
        prop_assert!((path.last().position - query.goal).norm() < 1e-6);
        prop_assert!(crate::wrap_angle(path.last().heading_rad - aim.heading_rad).abs() < 0.2);
    }
}
