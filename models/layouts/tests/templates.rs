//! Whatever the parameters, the map holds together.

#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a failed test panics")]

use layouts::{
    Arm, Built, CarPark, CheckKind, Connection, Connections, Control, Junction, Layout, Merge, Program, Road,
    Roundabout, TEMPLATES, Template, Traffic, Turn, TurnAcross, build,
};
use proptest::prelude::*;
use scene::geometry::segments::pieces;
use scene::map::{Lane, LaneMap};
use scene::{SignalState, Vec2, wrap_angle};
use serde_json::json;
use std::collections::HashMap;

/// Arms with at least 20 degrees between them: widths of the gaps are drawn and scaled to a whole turn.
fn arms() -> impl Strategy<Value = Vec<Arm>> {
    let arm =
        (0..=3u8, 0..=3u8, 40.0..120.0, prop_oneof![Just(0.0), 1.5..2.5], 0.0..4.0, 0.0..5.0, any::<bool>());
    prop::collection::vec((arm, 0.0..1.0f64), 3..=6).prop_map(|drawn| {
        let count = drawn.len() as f64;
        let sum: f64 = drawn.iter().map(|(_, gap)| gap).sum::<f64>().max(1e-6);
        let mut angle_deg = 17.0;
        drawn
            .into_iter()
            .enumerate()
            .map(|(i, ((lanes_in, lanes_out, length_m, cycle_lane_m, median_m, crosswalk_m, main), gap))| {
                angle_deg += 20.5 + (360.0 - 20.5 * count) * gap / sum;
                // From the first two one can always get to each other.
                let lanes_in = if i < 2 { lanes_in.max(1) } else { lanes_in };
                let lanes_out = if i < 2 || lanes_in == 0 { lanes_out.max(1) } else { lanes_out };
                let turns = None;
                Arm {
                    angle_deg: angle_deg % 360.0,
                    length_m,
                    lanes_in,
                    lanes_out,
                    turns,
                    cycle_lane_m,
                    median_m,
                    crosswalk_m,
                    main,
                    ..Arm::default()
                }
            })
            .collect()
    })
}

fn traffic() -> impl Strategy<Value = Traffic> {
    prop_oneof![Just(Traffic::RightHand), Just(Traffic::LeftHand)]
}

fn junction() -> impl Strategy<Value = Junction> {
    let control = prop_oneof![Just(Control::Signals), Just(Control::Priority), Just(Control::Equal)];
    let across = prop_oneof![Just(TurnAcross::Permissive), Just(TurnAcross::Protected)];
    (arms(), control, across, 3.0..20.0f64, 2.5..4.0f64, 0.0..4.0f64, traffic()).prop_map(
        |(arms, control, turns_across, kerb_radius_m, lane_width_m, sidewalk_m, traffic)| Junction {
            arms,
            control,
            program: Program { turns_across, ..Program::default() },
            kerb_radius_m,
            lane_width_m,
            sidewalk_m,
            traffic,
            ..Junction::default()
        },
    )
}

/// A junction with ways added and taken at random among its lanes, turning back included.
fn connected() -> impl Strategy<Value = Junction> {
    let picks = || prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 0..12);
    (junction(), picks(), picks()).prop_map(|(junction, added, removed)| {
        let lanes = |count: fn(&Arm) -> u8| -> Vec<[usize; 2]> {
            let of = |(i, arm): (usize, &Arm)| (0..usize::from(count(arm))).map(move |k| [i, k]).collect();
            junction.arms.iter().enumerate().flat_map::<Vec<_>, _>(of).collect()
        };
        let (ins, outs) = (lanes(|arm| arm.lanes_in), lanes(|arm| arm.lanes_out));
        let pick = |(a, b): &(prop::sample::Index, prop::sample::Index)| Connection {
            from: *a.get(&ins),
            to: *b.get(&outs),
        };
        let added: Vec<Connection> = added.iter().map(pick).collect();
        let removed = removed.iter().map(pick).filter(|c| !added.contains(c)).collect();
        Junction { connections: Connections { added, removed }, ..junction }
    })
}

fn roundabout() -> impl Strategy<Value = Roundabout> {
    (arms(), 6.0..40.0f64, 1..=2u8, 3.0..20.0f64, 2.5..4.0f64, traffic()).prop_map(
        |(arms, island_radius_m, ring_lanes, kerb_radius_m, lane_width_m, traffic)| Roundabout {
            arms,
            island_radius_m,
            ring_lanes,
            kerb_radius_m,
            lane_width_m,
            traffic,
            ..Roundabout::default()
        },
    )
}

fn merge() -> impl Strategy<Value = Merge> {
    (1..=5u8, any::<bool>(), any::<bool>(), 40.0..400.0f64, 4.0..30.0f64, 2.5..4.0f64, traffic()).prop_map(
        |(lanes, on_ramp, off_ramp, parallel_m, ramp_angle_deg, lane_width_m, traffic)| Merge {
            lanes,
            on_ramp,
            off_ramp,
            parallel_m,
            ramp_angle_deg,
            lane_width_m,
            traffic,
            ..Merge::default()
        },
    )
}

fn road() -> impl Strategy<Value = Road> {
    let widths =
        (prop_oneof![Just(0.0), 1.5..3.0f64], prop_oneof![Just(0.0), 1.8..3.0f64], 0.0..6.0f64, 0.0..6.0f64);
    (40.0..800.0f64, -170.0..170.0f64, 15.0..500.0f64, 1..=5u8, 0..=5u8, widths, any::<bool>(), traffic())
        .prop_map(
            |(length_m, bend_deg, radius_m, lanes_forward, lanes_backward, widths, speed_bumps, traffic)| {
                let (cycle_lane_m, parking_m, median_m, crosswalk_m) = widths;
                Road {
                    length_m,
                    bend_deg,
                    radius_m,
                    lanes_forward,
                    lanes_backward,
                    cycle_lane_m,
                    parking_m,
                    median_m,
                    crosswalk_m,
                    speed_bumps,
                    traffic,
                    ..Road::default()
                }
            },
        )
}

fn car_park() -> impl Strategy<Value = CarPark> {
    (1..=6u8, 3..=30u8, 2.3..3.5f64, 4.5..6.5f64, 3.5..7.0f64, 3.0..12.0f64, traffic()).prop_map(
        |(aisles, bays, bay_width_m, bay_length_m, aisle_m, kerb_radius_m, traffic)| CarPark {
            aisles,
            bays,
            bay_width_m,
            bay_length_m,
            aisle_m,
            kerb_radius_m,
            traffic,
            ..CarPark::default()
        },
    )
}

fn layout() -> impl Strategy<Value = Layout> {
    prop_oneof![
        4 => junction().prop_map(Layout::FourArms),
        3 => roundabout().prop_map(Layout::Roundabout),
        1 => merge().prop_map(Layout::Merge),
        2 => road().prop_map(Layout::Straight),
        1 => car_park().prop_map(Layout::CarPark),
    ]
}

fn by_id(map: &LaneMap) -> HashMap<&str, &Lane> {
    map.lanes.iter().map(|lane| (lane.id.as_str(), lane)).collect()
}

fn heading(from: Vec2, to: Vec2) -> f64 {
    (to - from).y.atan2((to - from).x)
}

/// Links are mutual, meet within 5 cm, and do not bend by more than a few degrees.
fn links_join(built: &Built) -> Result<(), TestCaseError> {
    let lanes = by_id(&built.map);
    for lane in &built.map.lanes {
        prop_assert!(lane.points.xy.len() >= 2, "{}", lane.id);
        for next in &lane.successors {
            let next = lanes[next.as_str()];
            prop_assert!(next.predecessors.contains(&lane.id), "{} {}", lane.id, next.id);
            let (a, b) = (&lane.points.xy, &next.points.xy);
            let gap = (a[a.len() - 1] - b[0]).norm();
            prop_assert!(gap < 0.05, "{} to {}: {gap} m", lane.id, next.id);
            if lane.lane_type != scene::map::LaneType::Sidewalk {
                let bend = wrap_angle(heading(b[0], b[1]) - heading(a[a.len() - 2], a[a.len() - 1]));
                prop_assert!(bend.abs() < 0.12, "{} to {}: {} degrees", lane.id, next.id, bend.to_degrees());
            }
        }
        for side in [&lane.left_neighbors, &lane.right_neighbors] {
            for other in side {
                prop_assert_eq!(lanes[other.lane.as_str()].points.xy.len(), other.other_range.1 + 1);
            }
        }
    }
    Ok(())
}

/// Two ways cross or end in one lane.
fn meet(a: &Lane, b: &Lane) -> bool {
    a.successors == b.successors
        || pieces(&a.points.xy, 0).any(|p| pieces(&b.points.xy, 1).any(|q| p.crosses(q.from, q.to)))
}

/// The arms that a way leads from and to, out of its id.
fn ends(id: &str) -> (&str, &str) {
    let arm = |text: &str| text.find('.').unwrap_or(text.len());
    let to = id.rfind("-arm").map_or("", |at| &id[at + 1..]);
    (&id[..arm(id)], &to[..arm(to)])
}

/// Two ways that meet have green together only where one gives way by the rules of the road: it turns across oncoming
/// traffic, both turn across, or they turn into the same arm.
fn greens_give_way(built: &Built) -> Result<(), TestCaseError> {
    let lanes = by_id(&built.map);
    let turns = |lane: &Lane| {
        let p = &lane.points.xy;
        wrap_angle(heading(p[p.len() - 2], p[p.len() - 1]) - heading(p[0], p[1])).abs() > 0.3
    };
    let ways: Vec<_> = built.signals.iter().filter_map(|s| Some((s, *lanes.get(s.lane.as_str())?))).collect();
    for (i, (s, a)) in ways.iter().enumerate() {
        for (t, b) in &ways[..i] {
            let (of_a, of_b) = (ends(&a.id), ends(&b.id));
            let oncoming = of_a.1 == of_b.0 || of_b.1 == of_a.0 || of_a.1 == of_b.1;
            let apart = of_a.0 == of_b.0 || oncoming || (turns(a) && turns(b));
            if apart || !meet(a, b) {
                continue;
            }
            for step in 0..91 {
                let both = s.at(step) == SignalState::Go && t.at(step) == SignalState::Go;
                prop_assert!(!both, "{} and {} at step {step}", a.id, b.id);
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn maps_hold_together(layout in layout()) {
        let (scene, built) = layouts::scene(&layout, "random").map_err(|f| TestCaseError::fail(format!("{f:?}")))?;
        links_join(&built)?;
        greens_give_way(&built)?;
        let leads = |check: &&layouts::Check| check.kind == CheckKind::LanesLead && !check.passed;
        let lost = built.checks.iter().find(leads);
        prop_assert!(lost.is_none(), "{lost:?}");
        for lane in built.map.lanes.iter().filter(|lane| lane.lane_type.carries_vehicles()) {
            prop_assert!(lane.width_or_assumed_m() >= 2.5, "{}", lane.id);
        }
        let problems = scene.checked().err();
        prop_assert!(problems.is_none(), "{problems:?}");
    }

    #[test]
    fn single_connections_are_drawn_and_lit(junction in connected()) {
        let Connections { added, removed } = junction.connections.clone();
        let usual = build(&Layout::FourArms(Junction { connections: Connections::default(), ..junction.clone() }));
        let (scene, built) = layouts::scene(&Layout::FourArms(junction), "").unwrap();
        links_join(&built)?;
        let drawn: Vec<Connection> = built.ways.iter().map(|way| way.connection).collect();
        let expected: Vec<Connection> = usual.unwrap().ways.iter().map(|way| way.connection).collect();
        for (i, connection) in drawn.iter().enumerate() {
            prop_assert!(!removed.contains(connection) && !drawn[..i].contains(connection));
            prop_assert!(expected.contains(connection) || added.contains(connection), "{connection:?}");
        }
        prop_assert!(added.iter().all(|connection| drawn.contains(connection)));
        prop_assert!(expected.iter().all(|connection| drawn.contains(connection) || removed.contains(connection)));
        for way in &built.ways {
            let lit = scene.signals.iter().filter(|signal| signal.lane == way.lane).count();
            prop_assert_eq!(lit, usize::from(!scene.signals.is_empty()), "{}", way.lane);
            prop_assert!(scene.map.lanes.iter().any(|lane| lane.id == way.lane && lane.interpolating));
        }
        // The checks find the rest: a lane in that leads nowhere, a lane out without an entry.
        for arm in 0..built.arms.len() {
            let (ins, outs) = (built.arms[arm].ins_m.len(), built.arms[arm].outs_m.len());
            let dead = (0..ins).filter(|lane| drawn.iter().all(|c| c.from != [arm, *lane])).count();
            let idle = (0..outs).filter(|lane| drawn.iter().all(|c| c.to != [arm, *lane])).count();
            let name = format!("arm{}.", arm + 1);
            let told = built.checks.iter().filter(|check| {
                check.kind == CheckKind::LanesLead && check.lanes.iter().any(|lane| lane.starts_with(&name))
            });
            let all_told = built.checks.iter().filter(|c| c.kind == CheckKind::LanesLead).count() < 8;
            prop_assert!(told.count() >= dead + idle || !all_told, "{name} {:?}", built.checks);
        }
        prop_assert!(scene.checked().is_ok());
    }

    #[test]
    fn left_hand_traffic_is_the_mirror_image(junction in connected()) {
        // Left stays left for the driver in left-hand traffic.
        let turn = |turn: &Turn| match turn {
            Turn::Left => Turn::Right,
            Turn::Straight => Turn::Straight,
            Turn::Right => Turn::Left,
        };
        let lane = |turns: &Vec<Turn>| turns.iter().rev().map(turn).collect();
        let arm = |arm: &Arm| Arm {
            angle_deg: -arm.angle_deg,
            turns: arm.turns.as_ref().map(|lanes| lanes.iter().map(lane).collect()),
            ..arm.clone()
        };
        let mirrored = Junction {
            arms: junction.arms.iter().map(arm).collect(),
            traffic: Traffic::RightHand,
            ..junction.clone()
        };
        let left = build(&Layout::FourArms(Junction { traffic: Traffic::LeftHand, ..junction })).unwrap();
        let right = build(&Layout::FourArms(mirrored)).unwrap();
        prop_assert_eq!(left.map, right.map.mirrored());
        prop_assert_eq!(left.signals.len(), right.signals.len());
        prop_assert_eq!(left.ways.len(), right.ways.len());
        for (own, other) in left.ways.iter().zip(&right.ways) {
            prop_assert_eq!((own.connection, own.turn), (other.connection, turn(&other.turn)));
        }
    }

    #[test]
    fn nonsense_is_refused_with_its_place(
        numbers in prop::collection::vec(prop_oneof![any::<f64>(), -1e3..1e3f64], 6),
        counts in prop::collection::vec(any::<u8>(), 4),
        arms in 0..9usize,
    ) {
        let arm = Arm {
            angle_deg: numbers[0],
            length_m: numbers[1],
            lanes_in: counts[0],
            lanes_out: counts[1],
            turns: Some(vec![vec![Turn::Left]; usize::from(counts[2] % 7)]),
            median_m: numbers[2],
            ..Arm::default()
        };
        let arms = (0..arms).map(|i| Arm { angle_deg: numbers[0] + 50.0 * i as f64, ..arm.clone() }).collect();
        let junction = Junction { arms, kerb_radius_m: numbers[3], lane_width_m: numbers[4], ..Junction::default() };
        for layout in [
            Layout::FourArms(junction),
            Layout::Curve(Road { length_m: numbers[0], bend_deg: numbers[1], lanes_forward: counts[3], ..Road::default() }),
            Layout::Merge(Merge { lanes: counts[0], parallel_m: numbers[5], ..Merge::default() }),
            Layout::CarPark(CarPark { aisles: counts[0], bays: counts[1], aisle_m: numbers[2], ..CarPark::default() }),
        ] {
            match layouts::scene(&layout, "") {
                Ok((scene, _)) => prop_assert!(scene.checked().is_ok()),
                Err(faults) => prop_assert!(!faults.is_empty() && faults.iter().all(|f| f.pointer.starts_with('/'))),
            }
        }
    }
}

#[test]
fn every_template_passes_its_own_checks() {
    for template in TEMPLATES {
        let (scene, built) = layouts::scene(&template.layout(), template.title()).unwrap();
        let failed: Vec<_> = built.checks.iter().filter(|check| !check.passed).collect();
        assert!(failed.is_empty(), "{}: {failed:?}", template.name());
        assert_eq!(scene.extra[layouts::EXTRA]["template"], template.name());
        scene.checked().unwrap();
    }
}

#[test]
fn arms_keep_twenty_degrees() {
    let faults = Template::FourArms
        .with(&json!({"arms": [{"angle_deg": 0}, {"angle_deg": 345}, {"angle_deg": 90}]}))
        .map(|layout| build(&layout).unwrap_err())
        .unwrap();
    assert_eq!(faults.len(), 1);
    assert_eq!(
        (faults[0].pointer.as_str(), faults[0].reason.as_str()),
        ("/arms/1/angle_deg", "Arms need 20° between them")
    );
}

#[test]
fn parameters_are_laid_over_those_of_the_template() {
    let layout = Template::ThreeArms.with(&json!({"kerb_radius_m": 4, "program": {"green_s": 20}})).unwrap();
    let Layout::ThreeArms(junction) = layout else { panic!("{layout:?}") };
    assert_eq!((junction.arms.len(), junction.kerb_radius_m, junction.program.green_s), (3, 4.0, 20.0));
    assert_eq!(junction.program.yellow_s, Program::default().yellow_s);
    let refused = |given| Template::ThreeArms.with(&given).unwrap_err();
    assert_eq!(refused(json!({"kerb_radius_m": "wide"})).pointer, "/kerb_radius_m");
    // A list is no object, however deep it lies.
    for (given, pointer) in [
        (json!([]), ""),
        (json!({"program": [20]}), "/program"),
        (json!({"arms": [{"angle_deg": 0}, [90]]}), "/arms/1"),
    ] {
        let fault = refused(given);
        assert_eq!((fault.pointer.as_str(), fault.reason.contains("object")), (pointer, true), "{fault:?}");
    }
}

#[test]
fn lights_change_and_both_roads_get_green() {
    let built = build(&Template::FourArms.layout()).unwrap();
    let ever =
        |state: SignalState| built.signals.iter().filter(|s| (0..91).any(|t| s.at(t) == state)).count();
    let ways = built.signals.iter().filter(|s| s.lane.starts_with("arm")).count();
    assert!(ever(SignalState::Go) >= ways, "{} of {ways}", ever(SignalState::Go));
    assert!(ever(SignalState::Caution) > 0 && ever(SignalState::Stop) > 0);
}

#[test]
fn connections_are_written_as_ids_of_lanes_and_refused_where_there_are_none() {
    let with =
        |connections: serde_json::Value| Template::FourArms.with(&json!({ "connections": connections }));
    let way = json!({"from": "arm2.in1", "to": "arm2.out1"});
    let layout = with(json!({"added": [way], "removed": [{"from": "arm4.in1", "to": "arm1.out2"}]})).unwrap();
    assert_eq!(layout.parameters()["connections"]["added"], json!([way]));
    let built = build(&layout).unwrap();
    let back = built.ways.iter().find(|way| way.connection.from == [1, 0] && way.connection.to == [1, 0]);
    assert_eq!(back.map(|way| way.lane.as_str()), Some("arm2.in1-arm2.out1"));
    assert!(built.ways.iter().all(|way| way.lane != "arm4.in1-arm1.out2"));
    let refused = |connections| {
        let faults = with(connections).map_or_else(|fault| vec![fault], |layout| build(&layout).unwrap_err());
        assert_eq!(faults.len(), 1, "{faults:?}");
        faults[0].pointer.clone()
    };
    assert_eq!(
        refused(json!({"added": [{"from": "arm2.in3", "to": "arm1.out1"}]})),
        "/connections/added/0/from"
    );
    assert_eq!(
        refused(json!({"removed": [way, {"from": "arm2.in1", "to": "arm5.out1"}]})),
        "/connections/removed/1/to"
    );
    assert_eq!(refused(json!({"added": [way], "removed": [way]})), "/connections/removed/0");
    assert_eq!(refused(json!({"added": [{"from": "arm2.out1", "to": "arm1.out1"}]})), "/connections/added/0");
    assert_eq!(refused(json!({"added": vec![way; 65]})), "/connections/added");
    // None is not written: documents are those of before.
    assert!(Template::FourArms.layout().parameters().get("connections").is_none());
}

#[test]
fn a_turn_that_is_taken_away_is_found() {
    let Layout::FourArms(mut junction) = Template::FourArms.layout() else { panic!("four arms") };
    junction.arms[1].turns = Some(vec![vec![Turn::Left], vec![]]);
    let built = build(&Layout::FourArms(junction)).unwrap();
    let failed: Vec<_> = built.checks.iter().filter(|check| !check.passed).collect();
    assert_eq!(failed.len(), 1, "{failed:?}");
    assert_eq!(
        (failed[0].kind, failed[0].lanes.as_slice()),
        (CheckKind::LanesLead, &["arm2.in2".to_owned()][..])
    );
}
