use super::*;
use crate::map::Lane;
use crate::routes::LaneGraph;
use crate::{AgentType, Goal, LaneMap, Scene, Size, State, Subtype, Vec2};

/// Two lanes eastwards, 3.5 m apart: `a`, 100 m long, leads to `b`; `c` is to the left of `a`.
fn road() -> LaneGraph {
    let line = |x: f64, y: f64| (0..=20).map(|i| Vec2::new(x + 5.0 * f64::from(i), y)).collect::<Vec<Vec2>>();
    let mut lanes = vec![
        Lane::street("a", line(0.0, 0.0)),
        Lane::street("b", line(100.0, 0.0)),
        Lane::street("c", line(0.0, 3.5)),
    ];
    lanes[0].successors = vec!["b".into()];
    lanes[1].predecessors = vec!["a".into()];
    LaneGraph::new(&LaneMap { lanes, ..LaneMap::default() })
}

/// East at 10 m/s, at x = 40 m at step 0.
fn other(step: usize) -> Option<State> {
    (step <= 200).then(|| State { x_m: 40.0 + step as f64, y_m: 0.3, vx_mps: 10.0, ..State::default() })
}

fn relation(place: RelativePlace) -> GoalRelation {
    GoalRelation { to: "1".into(), place, slower_mps: 0.0, lanes_left: 0 }
}

fn placed(relation: &GoalRelation, goal: Goal, at: &dyn Fn(usize) -> Option<State>) -> Result<Goal, String> {
    let size = Size { length_m: 5.0, width_m: 2.0, height_m: None };
    let asked = RelativeGoal {
        relation,
        goal,
        agent_type: AgentType::Vehicle,
        length_m: 4.0,
        start_step: 0,
        due_step: 50,
        end_step: 90,
    };
    let other = OtherMotion { agent_type: AgentType::Vehicle, size, at };
    place(&road(), &asked, &other).map_err(|message| message.code.to_owned())
}

fn x(goal: &Goal) -> f64 {
    goal.position.unwrap().x
}

#[test]
fn a_gap_lies_between_the_boxes() {
    let ahead = placed(&relation(RelativePlace::Ahead(12.0)), Goal::default(), &other).unwrap();
    // On the next lane: 90 + 12 + half of both lengths.
    assert!((x(&ahead) - 106.5).abs() < 1e-6 && ahead.position.unwrap().y.abs() < 1e-9, "{ahead:?}");
    assert_eq!((ahead.speed_mps, ahead.time_s), (Some(10.0), None));
    assert!(ahead.heading_rad.unwrap().abs() < 1e-9);
    let behind = placed(&relation(RelativePlace::Behind(12.0)), Goal::default(), &other).unwrap();
    assert!((x(&behind) - 73.5).abs() < 1e-6, "{behind:?}");
}

#[test]
fn a_time_gap_counts_at_the_speed_of_the_goal() {
    let slower = GoalRelation { slower_mps: 4.0, ..relation(RelativePlace::BehindBy(1.5)) };
    let behind = placed(&slower, Goal::default(), &other).unwrap();
    assert!((x(&behind) - (90.0 - 9.0 - 4.5)).abs() < 1e-6, "{behind:?}");
    assert_eq!(behind.speed_mps, Some(6.0));
    let own = Goal { speed_mps: Some(8.0), ..Goal::default() };
    let behind = placed(&relation(RelativePlace::BehindBy(1.5)), own, &other).unwrap();
    assert!((x(&behind) - (90.0 - 12.0 - 4.5)).abs() < 1e-6, "{behind:?}");
}

#[test]
fn lanes_are_counted_from_the_other_one() {
    let left = GoalRelation { lanes_left: 1, ..relation(RelativePlace::Behind(10.0)) };
    let goal = placed(&left, Goal::default(), &other).unwrap();
    assert!((goal.position.unwrap() - Vec2::new(75.5, 3.5)).norm() < 1e-6, "{goal:?}");
    let code = |lanes_left| {
        let relation = GoalRelation { lanes_left, ..relation(RelativePlace::Behind(10.0)) };
        placed(&relation, Goal::default(), &other).unwrap_err()
    };
    assert_eq!((code(2).as_str(), code(-1).as_str()), ("relation-no-lane-left", "relation-no-lane-right"));
}

#[test]
fn a_place_is_reached_after_the_other_one_has_passed() {
    let at = Goal { position: Some(Vec2::new(70.0, 1.0)), ..Goal::default() };
    let goal = placed(&relation(RelativePlace::After(0.5)), at, &other).unwrap();
    assert_eq!((goal.time_s, goal.position), (Some(3.5), at.position));
    let code = |place, goal| placed(&relation(place), goal, &other).unwrap_err();
    let beside = Goal { position: Some(Vec2::new(70.0, 20.0)), ..Goal::default() };
    assert_eq!(code(RelativePlace::After(0.5), beside), "relation-not-passed");
    assert_eq!(code(RelativePlace::After(-2.8), at), "relation-outside");
    assert_eq!(code(RelativePlace::After(8.0), at), "relation-outside");
}

#[test]
fn what_cannot_be_had_has_a_reason() {
    let code = |relation: &GoalRelation, at: &dyn Fn(usize) -> Option<State>| {
        placed(relation, Goal::default(), at).unwrap_err()
    };
    assert_eq!(
        code(&relation(RelativePlace::Ahead(1.0)), &|step| other(step).filter(|_| step < 50)),
        "relation-gone"
    );
    assert_eq!(code(&relation(RelativePlace::Ahead(200.0)), &other), "relation-lane-ends");
    let slow = GoalRelation { slower_mps: 11.0, ..relation(RelativePlace::Ahead(1.0)) };
    assert_eq!(code(&slow, &other), "relation-too-slow");
    let stands = |_: usize| Some(State { x_m: 40.0, ..State::default() });
    assert_eq!(code(&relation(RelativePlace::BehindBy(1.0)), &stands), "relation-stands");
    let off = |_: usize| Some(State { x_m: 40.0, y_m: 30.0, vx_mps: 5.0, ..State::default() });
    let left = GoalRelation { lanes_left: 1, ..relation(RelativePlace::Ahead(1.0)) };
    assert_eq!(code(&left, &off), "relation-off-lanes");
    // Away from lanes, a gap is along the other's heading.
    let goal = placed(&relation(RelativePlace::Ahead(1.0)), Goal::default(), &off).unwrap();
    assert_eq!(goal.position, Some(Vec2::new(45.5, 30.0)));
}

#[test]
fn relations_name_others_and_form_no_ring() {
    let codes = |pairs: &[(&str, &str)]| -> Vec<(usize, &str)> {
        let agent = |(id, to): &(&str, &str)| {
            let mut agent = Agent::bare(*id, AgentType::Vehicle, Subtype::Car, Vec::new());
            let of = |to: &str| GoalRelation { to: to.into(), ..relation(RelativePlace::Ahead(5.0)) };
            agent.conditions.relation = Some(*to).filter(|to| !to.is_empty()).map(of);
            agent
        };
        let scene = Scene::bare("", LaneMap::default(), pairs.iter().map(agent).collect());
        faults(&scene.agents).into_iter().map(|(i, message)| (i, message.code)).collect()
    };
    assert_eq!(codes(&[("1", ""), ("2", "1"), ("3", "2"), ("4", "3"), ("5", "4")]), []);
    assert_eq!(
        codes(&[("1", ""), ("2", "9"), ("3", "3")]),
        [(1, "relation-unknown"), (2, "relation-to-itself")]
    );
    assert_eq!(codes(&[("1", "2"), ("2", "1")]), [(0, "relation-ring"), (1, "relation-ring")]);
    let row = [("1", ""), ("2", "1"), ("3", "2"), ("4", "3"), ("5", "4"), ("6", "5")];
    assert_eq!(codes(&row), [(5, "relation-row")]);
    // A cycle is found from every chain that leads into it.
    assert_eq!(codes(&[("1", "2"), ("2", "3"), ("3", "2")]).len(), 3);
}
