//! Road users placed on maps: over HTTP and on the command line, good and bad, and as starts of futures.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

use dragtraffic_tests::program::program;
use dragtraffic_tests::scenes::street;
use dragtraffic_tests::{Request, Server};
use serde_json::{Value, json};
use std::process::Command;

const DEMOS: [&str; 5] =
    ["demo-crossing", "demo-arterial", "demo-motorway", "demo-residential", "demo-roundabout"];

fn place(server: &Server, body: &Value) -> Value {
    let reply = server.post("/v1/place", body).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    reply.json()
}

/// x, y, heading, half length and half width, the box grown by `margin_m`.
fn outline(agent: &Value, step: usize, margin_m: f64) -> Option<[f64; 5]> {
    let track = &agent["track"];
    let first = track["first_step"].as_u64().unwrap() as usize;
    let at = step.checked_sub(first)?;
    let seen = |range: &Value| (range[0].as_u64()..range[1].as_u64()).contains(&Some(step as u64));
    if !track["valid"].as_array().is_none_or(|ranges| ranges.iter().any(seen)) {
        return None;
    }
    let of = |name: &str| track[name][at].as_f64();
    let half = |name: &str| 0.5 * agent[name].as_f64().unwrap() + margin_m;
    Some([of("x_m")?, of("y_m")?, of("heading_rad")?, half("length_m"), half("width_m")])
}

/// Whether two rectangles share area: no side of either separates them.
fn touch(a: &[f64; 5], b: &[f64; 5]) -> bool {
    let apart = |a: &[f64; 5], b: &[f64; 5]| {
        let (c, s) = (a[2].cos(), a[2].sin());
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let (tc, ts) = ((b[2] - a[2]).cos().abs(), (b[2] - a[2]).sin().abs());
        let along = (dx * c + dy * s).abs() - a[3] - b[3] * tc - b[4] * ts;
        let across = (dy * c - dx * s).abs() - a[4] - b[3] * ts - b[4] * tc;
        along >= -1e-9 || across >= -1e-9
    };
    !apart(a, b) && !apart(b, a)
}

fn ids(list: &Value) -> Vec<String> {
    list.as_array().unwrap().iter().map(|a| a["id"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn nobody_overlaps_on_any_demo_with_any_seed() {
    let server = Server::with_demos().unwrap();
    let mut placed = 0;
    for demo in DEMOS {
        let scene = server.get(&format!("/v1/scenes/{demo}")).unwrap().json();
        let kept = scene["agents"].as_array().unwrap();
        for seed in 0..6u64 {
            // Sparse and dense, in an empty scene and among existing road users.
            let keep = if seed % 2 == 0 { Value::Null } else { json!([]) };
            let count = 10 + 30 * seed;
            let types = json!({"vehicle": 0.5, "pedestrian": 0.3, "cyclist": 0.2});
            let body = json!({"scene_id": demo, "density": {"count": count}, "types": types, "seed": seed, "keep": keep});
            let reply = place(&server, &body);
            let agents = reply["agents"].as_array().unwrap();
            assert_eq!(agents.len() as u64 + reply["unplaced"].as_u64().unwrap(), count, "{demo} {seed}");
            assert_eq!(reply["reason"].is_null(), reply["unplaced"] == 0);
            assert_eq!(reply["method"], "model");
            placed += agents.len();
            let new: Vec<[f64; 5]> = agents.iter().map(|a| outline(a, 0, 0.0).unwrap()).collect();
            let old: Vec<[f64; 5]> = if keep.is_null() {
                kept.iter().filter_map(|a| outline(a, 0, 0.0)).collect()
            } else {
                Vec::new()
            };
            for i in 0..new.len() {
                // Each box keeps 10 cm of clearance from the earlier ones.
                let one = &outline(&agents[i], 0, 0.0999).unwrap();
                let others = new[..i].iter().chain(&old);
                assert_eq!(others.filter(|o| touch(one, o)).count(), 0, "{demo} {seed} {}", agents[i]);
            }
            let mut all = ids(&reply["agents"]);
            all.extend(ids(&scene["agents"]));
            let count = all.len();
            all.sort();
            all.dedup();
            assert_eq!(all.len(), count, "ids are new");
        }
    }
    assert!(placed > 1_000, "{placed}");
}

#[test]
fn placed_road_users_are_starts_of_futures() {
    let server = Server::with_demos().unwrap();
    for demo in ["demo-crossing", "demo-roundabout"] {
        let body = json!({"scene_id": demo, "density": {"count": 24}, "seed": 3, "keep": []});
        let placed = place(&server, &body);
        let mut scene = server.get(&format!("/v1/scenes/{demo}")).unwrap().json();
        scene["agents"] = placed["agents"].clone();
        let steps = scene["time"]["steps"].as_u64().unwrap() as usize;
        // A vehicle that stands at a kerb is parked.
        let is_parked = |agent: &&Value| agent["track"]["x_m"].as_array().unwrap().len() == steps;
        for agent in scene["agents"].as_array().unwrap().iter().filter(|agent| !is_parked(agent)) {
            let (start, goal) = (&agent["conditions"]["start"], &agent["conditions"]["goal"]);
            assert_eq!(start["x_m"], agent["track"]["x_m"][0]);
            let free = |goal: &Value| goal.as_object().is_none_or(|g| g.values().all(Value::is_null));
            assert!(free(goal), "{goal}");
            let limit = match agent["type"].as_str().unwrap() {
                "vehicle" => 40.0,
                "cyclist" => 14.0,
                _ => 4.5,
            };
            let speed = start["speed_mps"].as_f64().unwrap();
            assert!((0.0..=limit).contains(&speed), "{agent}");
        }
        let count = scene["agents"].as_array().unwrap().len();
        let answer = server.post("/v1/generate", &json!({"scene": scene, "seed": 1})).unwrap();
        assert_eq!(answer.status, 200, "{}", answer.text());
        let answer = answer.json();
        let warned = answer["warnings"].as_array().unwrap();
        assert_eq!(warned.iter().filter(|w| w["code"] == "start-overlaps").count(), 0, "{warned:?}");
        let futures = answer["samples"][0]["agents"].as_object().unwrap();
        assert_eq!(futures.len(), count);
        // No road user exceeds its motion limits, from the first step on.
        let scores = answer["scores"][0]["agents"].as_object().unwrap();
        assert_eq!(scores.len(), count);
        for (id, of) in scores {
            assert_eq!(of["kinematic"]["violations"], 0, "{id}: {of}");
        }
    }
}

#[test]
fn centres_lie_in_the_region_and_the_seed_repeats_them() {
    let server = Server::with_demos().unwrap();
    let ring = json!([[-40.0, -30.0], [40.0, -30.0], [40.0, 5.0], [0.0, 5.0], [0.0, 40.0], [-40.0, 40.0]]);
    let body = json!({"scene_id": "demo-crossing", "density": {"per_lane_km": 120}, "seed": 11,
        "region": {"polygon_m": ring}, "keep": []});
    let reply = place(&server, &body);
    let agents = reply["agents"].as_array().unwrap();
    assert!(agents.len() >= 10, "{}", agents.len());
    for agent in agents {
        let [x, y, ..] = outline(agent, 0, 0.0).unwrap();
        let inside = (-40.0..=40.0).contains(&x) && (-30.0..=40.0).contains(&y) && !(x > 0.0 && y > 5.0);
        assert!(inside, "{x} {y}");
    }
    assert_eq!(place(&server, &body), reply);
    let mut other = body.clone();
    other["seed"] = json!(12);
    assert_ne!(place(&server, &other)["agents"], reply["agents"]);
    // A circle off the road has no free place, which is no error.
    let nowhere = json!({"scene_id": "demo-crossing", "density": {"count": 3},
        "region": {"circle": {"x_m": 90.0, "y_m": 90.0, "radius_m": 2.0}}});
    let nothing = place(&server, &nowhere);
    assert_eq!(
        (nothing["unplaced"].as_u64(), nothing["agents"].as_array().map(Vec::len)),
        (Some(3), Some(0))
    );
    assert!(nothing["reason"].as_str().unwrap().contains("vehicle"), "{nothing}");
}

#[test]
fn kept_road_users_are_in_the_way_and_types_are_as_asked() {
    let server = Server::start(&[]).unwrap();
    // 13 cars on each of two lanes: nearly full. If all of them are kept, there is less room.
    let scene = street(26, 20);
    let all = json!({"scene": scene, "density": {"count": 200}, "types": {"vehicle": 1.0}, "min_gap_m": 2});
    let among = place(&server, &all)["agents"].as_array().unwrap().len();
    let mut alone = all.clone();
    alone["keep"] = json!(["0"]);
    let alone = place(&server, &alone)["agents"].as_array().unwrap().len();
    assert!(alone > among, "{alone} {among}");
    let body = json!({"scene": street(2, 20), "density": {"count": 10}, "start_s": 1.0,
        "types": {"vehicle": 0.4, "cyclist": 0.6, "pedestrian": 0.0}});
    let reply = place(&server, &body);
    let count = |t: &str| reply["agents"].as_array().unwrap().iter().filter(|a| a["type"] == t).count();
    assert_eq!((count("vehicle"), count("cyclist"), count("pedestrian")), (4, 6, 0));
    for agent in reply["agents"].as_array().unwrap() {
        assert_eq!(agent["track"]["first_step"], 10);
    }
    // The scene may hold 256 road users, and has three.
    let mut full = json!({"scene": street(26, 20), "density": {"count": 256}, "types": {"vehicle": 1.0}});
    full["min_gap_m"] = json!(0);
    let reply = place(&server, &full);
    assert!(reply["agents"].as_array().unwrap().len() <= 230);
    assert!(reply["unplaced"].as_u64().unwrap() >= 26);
}

#[test]
fn drivers_wait_at_red_lights() {
    let server = Server::start(&[]).unwrap();
    let lane = |id: &str, from: f64, to: f64, next: &[&str], inside: bool| {
        let points: Vec<[f64; 2]> =
            (0..=20).map(|i| [from + (to - from) * f64::from(i) / 20.0, 0.0]).collect();
        json!({"id": id, "type": "surface_street", "points_m": points, "width_m": 3.5, "successors": next,
            "speed_limit_mps": 13.4, "interpolating": inside})
    };
    let scene = |state: &str| {
        json!({"format": "dragtraffic.scene", "version": 1, "name": "light", "meta": {"source": "drawn"},
            "time": {"step_s": 0.1, "steps": 91, "now_step": 0}, "agents": [],
            "map": {"lanes": [lane("in", -100.0, 0.0, &["mid"], false), lane("mid", 0.0, 20.0, &["out"], true),
                lane("out", 20.0, 120.0, &[], false)]},
            "signals": [{"lane": "mid", "stop_m": [0.0, 0.0], "states": [[0, state]]}]})
    };
    let mut fronts = Vec::new();
    let mut speeds = [(0.0, 0.0); 2];
    for (slot, state) in ["stop", "go"].into_iter().enumerate() {
        for seed in 0..30 {
            let region = json!({"polygon_m": [[-30.0, -5.0], [0.0, -5.0], [0.0, 5.0], [-30.0, 5.0]]});
            let body = json!({"scene": scene(state), "density": {"count": 2}, "types": {"vehicle": 1.0},
                "seed": seed, "region": region});
            for agent in place(&server, &body)["agents"].as_array().unwrap() {
                let [x, _, heading, half_length, _] = outline(agent, 0, 0.0).unwrap();
                let speed = agent["conditions"]["start"]["speed_mps"].as_f64().unwrap();
                // Vehicles parked beside the lane stand in any case.
                if agent["track"]["y_m"][0].as_f64().unwrap().abs() > 1.5 {
                    continue;
                }
                speeds[slot] = (speeds[slot].0 + speed, speeds[slot].1 + 1.0);
                if state == "stop" {
                    let front = x + half_length * heading.cos();
                    fronts.push(front);
                    // No vehicle is so fast that the signal would require emergency braking.
                    assert!(speed * speed <= 2.0 * 3.0 * (-front).max(0.0) + 0.1, "{agent}");
                }
            }
        }
    }
    assert!(fronts.len() > 20 && fronts.iter().all(|f| *f < 0.0), "{fronts:?}");
    let [red, green] = speeds.map(|(sum, n)| sum / n);
    assert!(red < 0.6 * green, "{red} at red, {green} at green");
}

/// A map made from a template, as a scene with this many steps.
fn made(server: &Server, template: &str, parameters: &Value, steps: usize) -> Value {
    let reply = server.post("/v1/map", &json!({"template": template, "parameters": parameters})).unwrap();
    assert_eq!(reply.status, 200, "{}", reply.text());
    let mut scene = reply.json()["scene"].clone();
    scene["time"]["steps"] = json!(steps);
    scene
}

#[test]
fn traffic_comes_in_by_arms() {
    let server = Server::start(&[]).unwrap();
    let scene = made(&server, "four-arms", &json!({}), 91);
    let arms = place(&server, &json!({"scene": scene, "density": {"per_lane_km": 0}}))["arms"].clone();
    assert_eq!(ids(&arms), ["east", "north", "west", "south"]);
    let mut body = json!({"scene": scene, "seed": 4, "arrivals": [
        {"arm": "north", "per_hour": 1200}, {"arm": "east", "per_hour": 600}]});
    let reply = place(&server, &body);
    let agents = reply["agents"].as_array().unwrap();
    let count = |arm: &Value| arm["placed"].as_u64().unwrap() + arm["later"].as_u64().unwrap();
    let arms = reply["arms"].as_array().unwrap();
    assert_eq!(arms.iter().map(count).sum::<u64>() as usize, agents.len(), "nobody else");
    assert_eq!((count(&arms[2]), count(&arms[3])), (0, 0));
    assert!(agents.len() >= 4, "{agents:?}");
    for agent in agents {
        let track = &agent["track"];
        let (first, seen) = (track["first_step"].as_u64().unwrap(), track["x_m"].as_array().unwrap().len());
        assert!(if first == 0 { seen == 1 } else { seen > 1 || first == 90 }, "{track}");
    }
    assert_eq!(place(&server, &body), reply, "the same again");
    // The density applies to the other arms, and changes nothing here.
    body["density"] = json!({"per_lane_km": 40});
    body["types"] = json!({"vehicle": 1.0});
    let more = place(&server, &body);
    assert!(ids(&more["agents"]).len() > agents.len());
    assert_eq!(more["arms"], reply["arms"]);
    // Road users that arrive later stay in the scene when it is generated.
    let mut scene = scene.clone();
    scene["agents"] = reply["agents"].clone();
    let answer = server.post("/v1/generate", &json!({"scene": scene, "react": true, "seed": 1})).unwrap();
    assert_eq!(answer.status, 200, "{}", answer.text());
    let scores = answer.json()["scores"][0]["agents"].as_object().unwrap().len();
    assert_eq!(scores, agents.len());
}

#[test]
fn speeds_keep_to_the_range_that_was_asked_for() {
    let server = Server::with_demos().unwrap();
    let mut moving = 0;
    for demo in DEMOS {
        for (min, max) in [(0.0, 4.0), (6.0, 9.0), (14.0, 20.0)] {
            let body = json!({"scene_id": demo, "keep": [], "density": {"count": 40}, "seed": 2,
                "types": {"vehicle": 0.7, "cyclist": 0.3}, "speeds": {"min_mps": min, "max_mps": max}});
            let reply = place(&server, &body);
            let agents = reply["agents"].as_array().unwrap();
            assert_eq!(agents.len() as u64 + reply["unplaced"].as_u64().unwrap(), 40);
            for agent in agents {
                // A parked vehicle has a standing track instead of a start.
                let Some(speed) = agent["conditions"]["start"]["speed_mps"].as_f64() else {
                    assert!(agent["track"]["vx_mps"].as_array().unwrap().iter().all(|v| *v == 0.0));
                    continue;
                };
                if agent["type"] == "cyclist" {
                    assert!(speed <= 14.0, "{agent}");
                } else if speed > 0.0 {
                    moving += 1;
                    assert!((min - 0.002..=max + 0.002).contains(&speed), "{demo} {min}..{max}: {agent}");
                }
            }
        }
    }
    assert!(moving > 60, "{moving}");
}

#[test]
fn cars_park_where_there_is_room() {
    let server = Server::start(&[]).unwrap();
    let park = |scene: &Value, parked: Value| {
        place(&server, &json!({"scene": scene, "seed": 3, "parked": parked, "density": {"per_lane_km": 0}}))
    };
    let lot = made(&server, "car-park", &json!({}), 91);
    let half = park(&lot, json!({"share": 0.5}));
    let places = half["parking_places"].as_u64().unwrap();
    let cars = half["agents"].as_array().unwrap();
    assert!(places >= 20, "{places}");
    assert_eq!(cars.len() as u64, (places as f64 * 0.5).round() as u64, "{}", half["reason"]);
    // A higher share keeps the cars that already stand.
    let most = park(&lot, json!({"share": 0.8}));
    let at = |car: &Value| (car["track"]["x_m"][0].to_string(), car["track"]["y_m"][0].to_string());
    let all: Vec<_> = most["agents"].as_array().unwrap().iter().map(at).collect();
    assert!(cars.iter().all(|car| all.contains(&at(car))));
    let boxes: Vec<[f64; 5]> =
        most["agents"].as_array().unwrap().iter().map(|car| outline(car, 0, 0.0).unwrap()).collect();
    for (i, a) in boxes.iter().enumerate() {
        assert_eq!(boxes[..i].iter().filter(|b| touch(a, b)).count(), 0);
    }
    for car in cars {
        assert_eq!(car["track"]["x_m"].as_array().unwrap().len(), 91);
        assert!(car["track"]["vx_mps"].as_array().unwrap().iter().all(|v| v.as_f64() == Some(0.0)));
        assert!(
            car["conditions"]["start"].as_object().is_none_or(|s| s.values().all(Value::is_null)),
            "{car}"
        );
    }
    // Driven, they stand where they stood.
    let mut scene = lot.clone();
    scene["agents"] = half["agents"].clone();
    let answer =
        server.post("/v1/generate", &json!({"scene": scene, "react": true, "seed": 1})).unwrap().json();
    let score = &answer["scores"][0]["scene"];
    assert_eq!(score["collisions"].as_array().map(Vec::len), Some(0), "{score}");
    assert_eq!(score["kinematic"]["speed_mps"], 0.0, "{score}");
    // A street with strips beside its lanes; one without them has no room, and the reply gives the reason.
    let street = made(&server, "straight", &json!({"parking_m": 2.2}), 91);
    let along = park(&street, json!({"per_100m": 8}));
    assert!(along["agents"].as_array().unwrap().len() > 5, "{along}");
    let bare = park(&made(&server, "straight", &json!({"parking_m": 0.0}), 91), json!({"share": 1.0}));
    assert_eq!((bare["parking_places"].as_u64(), ids(&bare["agents"]).len()), (Some(0), 0));
    assert!(bare["reason"].as_str().unwrap().contains("no room for parked cars"), "{bare}");
}

#[test]
fn a_large_map_is_answered_in_time() {
    let server = Server::start(&[]).unwrap();
    // 60 x 60 lanes of 100 m and one sign that says nothing.
    let lanes: Vec<Value> = (0..3_600)
        .map(|i| {
            let (x, y) = (f64::from(i % 60) * 110.0 - 3_300.0, f64::from(i / 60) * 20.0 - 600.0);
            let points: Vec<[f64; 2]> = (0..=20).map(|k| [x + 5.0 * f64::from(k), y]).collect();
            json!({"id": i.to_string(), "type": "surface_street", "points_m": points})
        })
        .collect();
    let scene = json!({"format": "dragtraffic.scene", "version": 1, "name": "large", "meta": {"source": "drawn"},
        "time": {"step_s": 0.1, "steps": 1, "now_step": 0}, "agents": [], "map": {"lanes": lanes}});
    let began = std::time::Instant::now();
    let reply =
        place(&server, &json!({"scene": scene, "density": {"count": 256}, "types": {"vehicle": 1.0}}));
    assert_eq!(reply["unplaced"], 0, "{}", reply["reason"]);
    assert_eq!(reply["agents"].as_array().unwrap().len(), 256);
    assert!(began.elapsed().as_secs() < 30, "{:?}", began.elapsed());
}

#[test]
fn a_map_without_lanes_has_none_to_fill() {
    let server = Server::start(&[]).unwrap();
    let kerb = json!({"id": "k", "points_m": [[0, 0], [40, 0], [80, 5]]});
    let lot = json!({"id": "d", "polygon_m": [[0, -20], [40, -20], [40, -5], [0, -5]]});
    let mut scene = street(0, 1);
    for map in [json!({"road_edges": [kerb], "driveways": [lot]}), json!({})] {
        scene["map"] = map;
        place(&server, &json!({"scene": scene}));
        let by_length = place(&server, &json!({"scene": scene, "density": {"per_lane_km": 40}}));
        assert_eq!(ids(&by_length["agents"]).len(), 0, "{by_length}");
    }
}

#[test]
fn bad_requests_are_refused_with_their_place() {
    let server = Server::start(&[]).unwrap();
    let good = json!({"scene": street(2, 20), "density": {"count": 3}});
    let cases: Vec<(&str, Value, &str, &str)> = vec![
        ("/start_s", json!(2.0), "out-of-range", "/start_s"),
        ("/start_s", json!(-0.1), "out-of-range", "/start_s"),
        ("/seed", json!(1u64 << 54), "out-of-range", "/seed"),
        ("/min_gap_m", json!(50.1), "out-of-range", "/min_gap_m"),
        ("/density", json!({"count": 257}), "out-of-range", "/density/count"),
        ("/density", json!({"count": 0}), "out-of-range", "/density/count"),
        ("/density", json!({"per_lane_km": 200.5}), "out-of-range", "/density/per_lane_km"),
        ("/density", json!({"per_lane_km": -1}), "out-of-range", "/density/per_lane_km"),
        ("/density", json!({}), "invalid-field", "/density"),
        ("/density", json!({"count": 3, "per_lane_km": 3}), "invalid-field", "/density"),
        ("/types", json!({"vehicle": 0.5}), "out-of-range", "/types"),
        ("/types", json!({"vehicle": 1.00001}), "out-of-range", "/types/vehicle"),
        ("/types", json!({"vehicle": 1.0, "other": 0.0}), "invalid-field", "/types/other"),
        ("/types", json!({"vehicle": 1.5, "cyclist": -0.5}), "out-of-range", "/types/cyclist"),
        ("/keep", json!(["ghost"]), "unknown-agent", "/keep/0"),
        ("/region", json!({}), "invalid-field", "/region"),
        ("/region", json!({"polygon_m": [[0, 0], [1, 0]]}), "invalid-field", "/region/polygon_m"),
        ("/region", json!({"polygon_m": [[0, 0], [5, 0], [9, 0]]}), "invalid-field", "/region/polygon_m"),
        (
            "/region",
            json!({"polygon_m": [[0, 0], [5, 0], [900, 3]]}),
            "out-of-range",
            "/region/polygon_m/2/0",
        ),
        (
            "/region",
            json!({"circle": {"x_m": 0, "y_m": 400, "radius_m": 5}}),
            "out-of-range",
            "/region/circle/y_m",
        ),
        (
            "/region",
            json!({"circle": {"x_m": 0, "y_m": 0, "radius_m": 0}}),
            "out-of-range",
            "/region/circle/radius_m",
        ),
        ("/speeds", json!({"min_mps": -1, "max_mps": 5}), "out-of-range", "/speeds/min_mps"),
        ("/speeds", json!({"min_mps": 9, "max_mps": 5}), "out-of-range", "/speeds/max_mps"),
        ("/speeds", json!({"min_mps": 9, "max_mps": 41}), "out-of-range", "/speeds/max_mps"),
        ("/speeds", json!({"min_mps": 9}), "invalid-field", "/speeds"),
        ("/arrivals", json!([{"arm": "west", "per_hour": 20001}]), "out-of-range", "/arrivals/0/per_hour"),
        ("/arrivals", json!([{"arm": "moon", "per_hour": 20}]), "invalid-field", "/arrivals/0/arm"),
        (
            "/arrivals",
            json!([{"arm": "west", "per_hour": 20}, {"arm": "west", "per_hour": 30}]),
            "invalid-field",
            "/arrivals/1/arm",
        ),
        ("/parked", json!({}), "invalid-field", "/parked"),
        ("/parked", json!({"share": 1.1}), "out-of-range", "/parked/share"),
        ("/parked", json!({"per_100m": 20.1}), "out-of-range", "/parked/per_100m"),
        ("/sead", json!(1), "invalid-field", "/sead"),
        ("/scene_id", json!("demo-crossing"), "invalid-field", "/scene"),
        ("/density", json!({"count": 1.5}), "invalid-field", "/density/count"),
    ];
    for (pointer, value, code, place) in cases {
        let mut body = good.clone();
        body[pointer.trim_start_matches('/')] = value.clone();
        let reply = server.post("/v1/place", &body).unwrap();
        assert_eq!((reply.status, reply.code().as_str()), (422, code), "{pointer} {value}: {}", reply.text());
        assert_eq!(reply.json()["errors"][0]["pointer"], place, "{pointer} {value}: {}", reply.text());
    }
    assert_eq!(server.post("/v1/place", &json!({})).unwrap().code(), "invalid-field");
    let missing = server.post("/v1/place", &json!({"scene_id": "nothing-here"})).unwrap();
    assert_eq!((missing.status, missing.code().as_str()), (404, "not-found"));
    let text =
        Request::new("POST", "/v1/place").header("content-type", "application/json").body("{\"scene\":");
    assert_eq!(server.send(&text).unwrap().code(), "malformed-json");
    assert_eq!(server.get("/v1/place").unwrap().status, 405);
    assert_eq!(server.post("/v1/place", &good).unwrap().status, 200);
}

#[test]
fn the_command_line_places_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(path("in.json"), street(4, 20).to_string()).unwrap();
    let ring = json!([[[-50, -8], [50, -8], [50, 12], [-50, 12], [-50, -8]]]);
    let region =
        json!({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": ring}});
    std::fs::write(path("region.geojson"), region.to_string()).unwrap();
    let run = |arguments: &[&str]| Command::new(program()).args(arguments).output().unwrap();
    let (scene, region, out) = (path("in.json"), path("region.geojson"), path("out.json"));
    let arguments = [
        "place",
        &scene,
        "--count",
        "5",
        "--types",
        "vehicle=1",
        "--region",
        &region,
        "--seed",
        "4",
        "--keep=0,1",
        "-o",
        &out,
    ];
    let done = run(&arguments);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let made: Value = serde_json::from_slice(&std::fs::read(&out).unwrap()).unwrap();
    assert_eq!(ids(&made["agents"])[..2], ["0", "1"]);
    let placed = &made["agents"].as_array().unwrap()[2..];
    assert_eq!(placed.len(), 5);
    for agent in placed {
        let [x, y, ..] = outline(agent, 0, 0.0).unwrap();
        assert!((-50.0..=50.0).contains(&x) && (-8.0..=12.0).contains(&y));
    }
    assert_eq!(run(&arguments).status.code(), Some(8), "the output is kept");
    assert_eq!(run(&["place", &scene, "--types", "vehicle"]).status.code(), Some(2));
    std::fs::write(path("bad.geojson"), "{\"type\": \"Point\"}").unwrap();
    assert_eq!(run(&["place", &scene, "--region", &path("bad.geojson")]).status.code(), Some(3));
    // The scene that was written can be generated from.
    let futures = run(&["generate", &out, "-o", &path("futures.json")]);
    assert!(futures.status.success(), "{}", String::from_utf8_lossy(&futures.stderr));
}
