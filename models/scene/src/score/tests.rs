//! Helpers of the score tests, and scores of whole scenes.

use super::*;
use crate::map::{Area, Lane, TypedLine};
use crate::{AgentType, Goal, LaneMap, STEP_S, Size, State, Subtype, Track, Vec2};
use std::borrow::Cow;

static EMPTY: LaneMap = LaneMap {
    lanes: Vec::new(),
    road_lines: Vec::new(),
    road_edges: Vec::new(),
    crosswalks: Vec::new(),
    speed_bumps: Vec::new(),
    driveways: Vec::new(),
    stop_signs: Vec::new(),
    drivable: Vec::new(),
};

/// 91 steps of a motion.
pub(super) fn track_of(state: impl Fn(usize) -> State) -> Track {
    Track { first_step: 0, states: (0..91).map(|i| Some(state(i))).collect(), z_m: None }
}

/// Generated motion straight on at a steady speed: vehicles 4 by 2 m, others 0.8 by 0.8 m.
pub(crate) fn straight(
    id: &'static str,
    agent_type: AgentType,
    from: (f64, f64),
    heading_rad: f64,
    speed_mps: f64,
) -> Actor<'static> {
    let (length_m, width_m) = if agent_type == AgentType::Vehicle { (4.0, 2.0) } else { (0.8, 0.8) };
    let velocity = crate::geometry::direction(heading_rad) * speed_mps;
    let state = |i: usize| State {
        x_m: from.0 + velocity.x * i as f64 * STEP_S,
        y_m: from.1 + velocity.y * i as f64 * STEP_S,
        heading_rad,
        vx_mps: velocity.x,
        vy_mps: velocity.y,
    };
    Actor {
        id,
        agent_type,
        subtype: Subtype::Unknown,
        size: Size { length_m, width_m, height_m: None },
        track: Cow::Owned(track_of(state)),
        log: None,
        generated: true,
        goal: Goal::default(),
        may_cross: &[],
        via: &[],
        reference: None,
        modes: &[],
    }
}

/// These road users on an empty map, scored over 91 steps.
pub(super) fn input_of<'a>(actors: Vec<Actor<'a>>, drivable: &'a Drivable) -> ScoreInput<'a> {
    ScoreInput {
        actors,
        map: &EMPTY,
        signals: &[],
        drivable,
        steps: 0..91,
        pairs: PairChoice::All,
        exclude: Exclude::Nothing,
        thresholds: Thresholds::default(),
    }
}

fn xy(points: &[(f64, f64)]) -> Vec<Vec2> {
    points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()
}

/// An area without holes.
pub(crate) fn area(points: &[(f64, f64)]) -> Area {
    Area { id: "area".into(), polygon: xy(points).into(), holes: Vec::new() }
}

/// A road edge.
pub(super) fn edge(points: &[(f64, f64)]) -> TypedLine {
    TypedLine { id: "edge".into(), line_type: "boundary".into(), points: xy(points).into() }
}

/// A street lane without a width.
pub(super) fn lane(id: &str, points: &[(f64, f64)]) -> Lane {
    Lane::street(id, xy(points))
}

#[test]
fn member_names_are_those_of_the_api() {
    let drivable = Drivable::default();
    let mut ahead = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
    ahead.goal.speed_mps = Some(10.0);
    let reference = ahead.track.clone().into_owned();
    ahead.reference = Some(&reference);
    let behind = straight("b", AgentType::Vehicle, (-20.0, 0.0), 0.0, 15.0);
    let score = score(&input_of(vec![ahead, behind], &drivable));
    let json = serde_json::to_value(&score).unwrap();
    for name in [
        "collisions",
        "collision_rate",
        "overlaps",
        "near_misses",
        "encounters",
        "min_ttc_s",
        "min_ttc_pair",
        "min_distance_m",
        "pet_s",
        "offroad_share",
        "offroad_max_m",
        "wrong_way_share",
        "kinematic",
        "goal_error",
        "goals_reached",
        "min_ade_m",
        "min_fde_m",
        "endpoint",
    ] {
        assert!(json["scene"].get(name).is_some(), "{name} is missing");
    }
    let crash = &json["scene"]["collisions"][0];
    assert_eq!((crash["a"].as_str(), crash["b"].as_str()), (Some("a"), Some("b")));
    assert!(crash["iou"].as_f64().is_some() && crash["time_s"].as_f64().is_some());
    assert_eq!(
        json["agents"]["a"]["goal_error"],
        serde_json::json!({"position_m": null, "heading_rad": null, "speed_mps": 0.0})
    );
    assert_eq!(json["agents"]["b"]["goal_error"], serde_json::Value::Null);
    assert_eq!(json["agents"]["a"]["endpoint"], "last");
    assert_eq!(json["thresholds"]["iou"], 0.0);
}

#[test]
fn an_encounter_has_its_measures_and_those_of_the_recording() {
    let drivable = Drivable::default();
    let log =
        |x_m: f64, mps: f64| straight("log", AgentType::Vehicle, (x_m, 0.0), 0.0, mps).track.into_owned();
    // 10 m apart, 14 m from centre to centre; the recording keeps that gap.
    let (log_a, log_b) = (log(0.0, 10.0), log(-14.0, 10.0));
    let mut leader = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
    let mut follower = straight("b", AgentType::Vehicle, (-14.0, 0.0), 0.0, 12.0);
    (leader.log, follower.log) = (Some(&log_a), Some(&log_b));
    let scene = score(&input_of(vec![leader, follower], &drivable)).scene;
    assert_eq!(scene.encounters.len(), 1);
    let met = &scene.encounters[0];
    assert_eq!((met.a.as_str(), met.b.as_str(), met.kind), ("a", "b", report::EncounterKind::Collision));
    assert_eq!((met.time_s, met.in_log), (scene.collisions[0].time_s, false));
    // They touch after 5 s; the place lies between their centres.
    assert!((met.time_s - 5.0).abs() < 0.15 && (met.x_m - (10.0 * met.time_s - 2.0)).abs() < 1.0, "{met:?}");
    let found = met.measures;
    assert_eq!((found.ttc_s, found.pet_s), (Some(0.0), None));
    assert!(found.drac_mps2.unwrap() > 3.0 && found.headway_s.unwrap() < 0.05, "{found:?}");
    let log = met.log.unwrap();
    assert_eq!((log.ttc_s, log.drac_mps2), (None, None));
    assert!((log.gap_m.unwrap() - 10.0).abs() < 1e-9 && (log.headway_s.unwrap() - 1.0).abs() < 1e-9);
    assert_eq!(scene.min_ttc_pair, Some(["a".to_owned(), "b".to_owned()]));
}

#[test]
fn same_input_same_score() {
    let drivable = Drivable::default();
    let names = ["a", "b", "c", "d", "e", "f"];
    let crowd = || {
        let one = |(i, id): (usize, &&'static str)| {
            straight(id, AgentType::Vehicle, (i as f64 * 7.0, i as f64 * 2.5), 0.4 * i as f64, 8.0)
        };
        input_of(names.iter().enumerate().map(one).collect(), &drivable)
    };
    let json = |input: &ScoreInput<'_>| serde_json::to_string(&score(input)).unwrap();
    assert_eq!(json(&crowd()), json(&crowd()));
    // Another order of road users changes no figure of any of them.
    let mut turned = crowd();
    turned.actors.reverse();
    assert_eq!(score(&crowd()).agents, score(&turned).agents);
}

#[test]
fn empty_scene() {
    let drivable = Drivable::default();
    let score = score(&input_of(Vec::new(), &drivable));
    assert_eq!((score.scene.collision_rate, score.scene.min_ttc_s), (0.0, None));
    assert!(score.agents.is_empty());
}
