//! Cases of geometry and verdicts that the engine and the page must compute equally. This test computes the
//! expected values and compares them with `assets/cases/physics.json`; `ACCEPT=1 cargo test -p
//! dragtraffic-scene --test page_cases` writes them. The page reads the same file
//! (`web/test/model/physics-cases.test.ts`).
#![allow(clippy::expect_used, clippy::unwrap_used, missing_docs, reason = "a test")]

use scene::geometry::obb::{OrientedBox, overlaps, signed_gap};
use scene::geometry::ttc::{LOOK_AHEAD_S, time_to_collision};
use scene::motion::MotionModel;
use scene::motion::project::{Target, project};
use scene::score::kinematic::harsh_braking;
use scene::score::{Actor, Drivable, Exclude, PairChoice, ScoreInput, Thresholds, score};
use scene::{AgentType, Goal, LaneMap, STEP_S, Size, State, Subtype, Track, Vec2};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// x and y of the centre (metres), heading (radians), length and width (metres), speed (m/s).
type Body = [f64; 6];

fn outline([x, y, heading, length, width, _]: Body) -> OrientedBox {
    OrientedBox::new(Vec2::new(x, y), 0.5 * length, 0.5 * width, heading)
}

fn velocity([.., heading, _, _, speed]: Body) -> Vec2 {
    Vec2::new(heading.cos(), heading.sin()) * speed
}

fn car(x: f64, y: f64, heading: f64, speed: f64) -> Body {
    [x, y, heading, 4.0, 2.0, speed]
}

fn rounded(v: f64) -> f64 {
    (v * 1e6).round() / 1e6
}

/// Two boxes: whether they overlap, and the gap between them.
fn gaps() -> Vec<Value> {
    let person = |x, y| [x, y, 0.0, 0.8, 0.8, 0.0];
    let others = [
        car(3.0, 0.0, 0.0, 0.0),
        car(3.99, 0.0, 0.0, 0.0),
        car(4.01, 0.0, 0.0, 0.0),
        car(4.05, 0.0, 0.0, 0.0),
        car(4.11, 0.0, 0.0, 0.0),
        car(0.0, 1.95, 0.0, 0.0),
        car(0.0, 2.05, 0.0, 0.0),
        car(7.0, 6.0, 0.0, 0.0),
        car(0.0, 5.0, FRAC_PI_2, 0.0),
        car(0.0, 2.9, FRAC_PI_2, 0.0),
        car(3.4, 2.4, FRAC_PI_4, 0.0),
        car(4.2, 3.2, FRAC_PI_4, 0.0),
        car(5.0, 1.0, 2.5, 0.0),
        [9.0, 0.3, 0.2, 12.0, 2.55, 0.0],
        [8.0, 0.3, 0.2, 12.0, 2.55, 0.0],
        person(2.3, 1.3),
        person(2.5, 1.5),
        person(0.0, 0.0),
    ];
    let me = car(0.0, 0.0, 0.0, 0.0);
    let case = |other: Body| {
        let (a, b) = (outline(me), outline(other));
        json!({ "a": me, "b": other, "overlaps": overlaps(&a, &b, 0.0), "gap_m": rounded(signed_gap(&a, &b).max(0.0)) })
    };
    others.into_iter().map(case).collect()
}

/// Two boxes at constant velocities: the time to collision.
fn collision_times() -> Vec<Value> {
    let pairs = [
        (car(0.0, 0.0, 0.0, 10.0), car(24.0, 0.5, 0.0, 5.0)),
        (car(0.0, 0.0, 0.0, 10.0), car(44.0, 0.0, PI, 10.0)),
        (car(0.0, 0.0, 0.0, 10.0), car(24.0, 3.0, 0.0, 0.0)),
        (car(0.0, 0.0, 0.0, 5.0), car(24.0, 0.5, 0.0, 10.0)),
        (car(-20.0, 0.0, 0.0, 10.0), car(0.0, -20.0, FRAC_PI_2, 10.0)),
        (car(-20.0, 0.0, 0.0, 10.0), car(0.0, -28.0, FRAC_PI_2, 10.0)),
        (car(-20.0, 0.0, 0.0, 10.0), car(0.0, -25.0, FRAC_PI_2, 11.0)),
        (car(0.0, 0.0, 0.0, 1.0), car(12.9, 0.0, 0.0, 0.0)),
        (car(0.0, 0.0, 0.0, 1.0), car(11.9, 0.0, 0.0, 0.0)),
        (car(0.0, 0.0, 0.3, 8.0), [20.0, 6.0, 2.0, 0.8, 0.8, 1.4]),
    ];
    let case = |(a, b): (Body, Body)| {
        let ttc_s = time_to_collision(&outline(a), velocity(a), &outline(b), velocity(b), LOOK_AHEAD_S);
        json!({ "a": a, "b": b, "ttc_s": ttc_s.map(rounded) })
    };
    pairs.into_iter().map(case).collect()
}

fn actor(id: &'static str, size: [f64; 2], state: impl Fn(usize) -> State) -> Actor<'static> {
    Actor {
        id,
        agent_type: AgentType::Vehicle,
        subtype: Subtype::Unknown,
        size: Size { length_m: size[0], width_m: size[1], height_m: None },
        track: Cow::Owned(Track {
            first_step: 0,
            states: (0..91).map(|i| Some(state(i))).collect(),
            z_m: None,
        }),
        log: None,
        generated: true,
        goal: Goal::default(),
        may_cross: &[],
        via: &[],
        reference: None,
        modes: &[],
    }
}

fn steady(id: &'static str, body: Body) -> Actor<'static> {
    let v = velocity(body);
    actor(id, [body[3], body[4]], move |i| State {
        x_m: body[0] + v.x * i as f64 * STEP_S,
        y_m: body[1] + v.y * i as f64 * STEP_S,
        heading_rad: body[2],
        vx_mps: v.x,
        vy_mps: v.y,
    })
}

fn with_input<T>(actors: Vec<Actor<'_>>, thresholds: Thresholds, of: impl FnOnce(&ScoreInput<'_>) -> T) -> T {
    let map = LaneMap::default();
    let drivable = Drivable::new(&map);
    let (pairs, exclude) = (PairChoice::All, Exclude::Nothing);
    of(&ScoreInput {
        actors,
        map: &map,
        signals: &[],
        drivable: &drivable,
        steps: 0..91,
        pairs,
        exclude,
        thresholds,
    })
}

/// Two road users at constant speeds for 9 s, whose paths cross or stay apart: their post-encroachment time,
/// and the smallest gap at a step.
fn encounters() -> Vec<Value> {
    // Not on whole decimetres: boxes that just touch at a step would depend on rounding.
    let east = |x, speed| car(x + 0.03, 0.0, 0.0, speed);
    let north = |y, speed| car(0.0, y + 0.04, FRAC_PI_2, speed);
    let pairs = [
        (east(-20.0, 10.0), north(-30.0, 10.0)),
        (east(-20.0, 10.0), north(-40.0, 10.0)),
        (east(-30.0, 10.0), north(-20.0, 5.0)),
        (east(-20.0, 5.0), north(-60.0, 8.0)),
        (east(-40.0, 12.0), car(0.0, 30.04, -FRAC_PI_2, 6.0)),
        (east(-20.0, 10.0), car(20.0, -28.0, 2.0, 9.0)),
        (east(-20.0, 0.1), north(-30.0, 10.0)),
        (east(-20.0, 10.0), car(-20.0, 8.0, 0.0, 10.0)),
    ];
    let case = |(a, b): (Body, Body)| {
        let scored = with_input(vec![steady("a", a), steady("b", b)], Thresholds::default(), score);
        let of_a = scored.agents.get("a").expect("scored");
        json!({
            "a": a, "b": b, "pet_s": of_a.pet_s.map(rounded),
            "gap_m": of_a.min_distance_m.map(|m| rounded(m.max(0.0))),
        })
    };
    pairs.into_iter().map(case).collect()
}

/// Braking from 15 m/s at a constant rate after 2 s: the hardest braking in the verdict, and whether it is
/// harsh.
fn brakings() -> Vec<Value> {
    let speed = |rate: f64, i: usize| (15.0 - rate * (i as f64 * STEP_S - 2.0).max(0.0)).max(0.0);
    let case = |rate: f64| {
        let state = |i: usize| State { vx_mps: speed(rate, i), ..State::default() };
        let harsh = |limit: f64| {
            let thresholds = Thresholds { harsh_brake_mps2: limit, ..Thresholds::default() };
            with_input(vec![], thresholds, |input| harsh_braking(&actor("a", [4.0, 2.0], state), input))
        };
        let hardest = harsh(0.0).iter().filter_map(|s| s.worst).fold(0.0, f64::max);
        let is_harsh = !harsh(Thresholds::default().harsh_brake_mps2).is_empty();
        json!({ "rate_mps2": rate, "hardest_mps2": rounded(hardest), "harsh": is_harsh })
    };
    [0.0, 1.5, 3.9, 4.1, 6.0, 8.0].into_iter().map(case).collect()
}

/// The farthest goal straight ahead that a projection reaches in a given time, by type.
fn reaches() -> Vec<Value> {
    let kinds = [
        ("vehicle", AgentType::Vehicle, Subtype::Car, Size { length_m: 4.7, width_m: 2.0, height_m: None }),
        (
            "cyclist",
            AgentType::Cyclist,
            Subtype::Bicycle,
            Size { length_m: 1.8, width_m: 0.75, height_m: None },
        ),
    ];
    let mut cases = Vec::new();
    for (name, agent_type, subtype, size) in kinds {
        for (speed_mps, time_s) in [(0.0, 4.0), (5.0, 3.0), (8.0, 6.0), (10.0, 9.0)] {
            let start = State { vx_mps: speed_mps, ..State::default() };
            let model = MotionModel::new(agent_type, subtype, size, start);
            let is_reached = |x: f64| {
                let step = (time_s / STEP_S).round() as usize;
                let target = Target { step, position: Some(Vec2::new(x, 0.0)), ..Target::default() };
                project(&model, &model.coasting(), &target, None).reach.is_reached()
            };
            let (mut reached, mut missed) = (speed_mps * time_s, speed_mps * time_s + 400.0);
            for _ in 0..30 {
                let middle = 0.5 * (reached + missed);
                if is_reached(middle) { reached = middle } else { missed = middle }
            }
            let furthest_m = (reached * 100.0).round() / 100.0;
            cases.push(
                json!({ "type": name, "speed_mps": speed_mps, "time_s": time_s, "furthest_m": furthest_m }),
            );
        }
    }
    cases
}

#[test]
fn the_cases_of_the_page_are_those_of_the_engine() {
    let cases = json!({
        "gaps": gaps(),
        "collision_times": collision_times(),
        "encounters": encounters(),
        "brakings": brakings(),
        "reaches": reaches(),
    });
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/cases/physics.json");
    let lists = cases.as_object().expect("an object").iter();
    let lines = |list: &Value| -> Vec<String> {
        list.as_array().expect("a list").iter().map(|case| format!("    {case}")).collect()
    };
    let parts: Vec<String> =
        lists.map(|(k, list)| format!("  \"{k}\": [\n{}\n  ]", lines(list).join(",\n"))).collect();
    let text = format!("{{\n{}\n}}\n", parts.join(",\n"));
    if std::env::var_os("ACCEPT").is_some() {
        std::fs::create_dir_all(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/cases")).unwrap();
        std::fs::write(path, &text).unwrap();
    }
    let kept: Value =
        serde_json::from_str(&std::fs::read_to_string(path).unwrap_or_default()).unwrap_or_default();
    let count: usize =
        cases.as_object().expect("an object").values().filter_map(Value::as_array).map(Vec::len).sum();
    assert!(count >= 40, "{count} cases");
    assert!(kept == cases, "run: ACCEPT=1 cargo test -p dragtraffic-scene --test page_cases");
}
