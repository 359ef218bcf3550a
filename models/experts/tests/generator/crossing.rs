//! The hand-made scene of the generator's tests, which the golden answers use too.

use scene::map::{Area, Lane, LaneMap};
use scene::{Agent, AgentType, Scene, State, Subtype, Vec2};

/// A straight lane 3.5 m wide with a point per metre and a limit of 30 mph.
fn lane(id: &str, from: Vec2, to: Vec2, successors: &[&str]) -> Lane {
    let n = (to - from).norm().ceil() as usize;
    let points: Vec<Vec2> = (0..=n).map(|i| from + (to - from) * (i as f64 / n as f64)).collect();
    Lane {
        width_m: Some(3.5),
        speed_limit_mps: Some(13.4),
        successors: successors.iter().map(|s| (*s).to_owned()).collect(),
        ..Lane::street(id, points)
    }
}

/// An agent that goes straight on at this speed for the 9.1 s of the log.
pub fn agent(id: &str, agent_type: AgentType, at: (f64, f64), heading_rad: f64, speed: f64) -> Agent {
    let ahead = scene::geometry::direction(heading_rad);
    let state = |i: usize| {
        let p = Vec2::new(at.0, at.1) + ahead * (speed * 0.1 * i as f64);
        State { x_m: p.x, y_m: p.y, heading_rad, vx_mps: ahead.x * speed, vy_mps: ahead.y * speed }
    };
    Agent::bare(id, agent_type, Subtype::Unknown, (0..91).map(|i| Some(state(i))).collect())
}

/// Two streets that cross, with cars, a cyclist, a pedestrian and a parked car.
pub fn crossing() -> Scene {
    use std::f64::consts::FRAC_PI_2;
    let v = Vec2::new;
    let map = LaneMap {
        lanes: vec![
            lane("w", v(-100.0, -1.75), v(-8.0, -1.75), &["we", "wn"]),
            lane("we", v(-8.0, -1.75), v(8.0, -1.75), &["e"]),
            lane("wn", v(-8.0, -1.75), v(1.75, 8.0), &["n"]),
            lane("e", v(8.0, -1.75), v(120.0, -1.75), &[]),
            lane("s", v(1.75, -100.0), v(1.75, -8.0), &["sn"]),
            lane("sn", v(1.75, -8.0), v(1.75, 8.0), &["n"]),
            lane("n", v(1.75, 8.0), v(1.75, 120.0), &[]),
        ],
        ..LaneMap::default()
    };
    let agents = vec![
        agent("1", AgentType::Vehicle, (-40.0, -1.75), 0.0, 8.0),
        agent("2", AgentType::Vehicle, (-60.0, -1.75), 0.0, 9.0),
        agent("3", AgentType::Vehicle, (1.75, -45.0), FRAC_PI_2, 8.0),
        agent("4", AgentType::Cyclist, (1.9, -20.0), FRAC_PI_2, 4.0),
        agent("5", AgentType::Pedestrian, (-12.0, 6.0), -FRAC_PI_2, 1.3),
        agent("6", AgentType::Vehicle, (-30.0, -6.5), 0.0, 0.0),
    ];
    Scene::bare("crossing", map, agents).checked().unwrap()
}

/// One lane eastwards with a crosswalk over it.
pub fn street() -> LaneMap {
    let ring = [(-2.0, -3.5), (2.0, -3.5), (2.0, 0.0), (-2.0, 0.0)].map(|(x, y)| Vec2::new(x, y));
    LaneMap {
        lanes: vec![lane("a", Vec2::new(-100.0, -1.75), Vec2::new(100.0, -1.75), &[])],
        crosswalks: vec![Area { id: "walk".into(), polygon: ring.to_vec().into(), holes: Vec::new() }],
        ..LaneMap::default()
    }
}
