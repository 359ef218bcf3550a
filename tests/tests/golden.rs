//! Golden answers: the answers of the shipped weights to a few calls, stored in `tests/golden`. A code change that
//! changes an answer fails here first; `cargo xtask golden` prints the differences, `cargo xtask golden --accept`
//! stores them.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, reason = "a failed test panics")]

#[path = "golden/cases.rs"]
mod cases;
#[path = "golden/compare.rs"]
mod compare;

use cases::{CASES, Case};
use compare::Differences;
use dragtraffic_tests::program::root;
use experts::{Cancel, Engine, Event, Generation};
use scene::{AgentFutures, Sample, State};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Handling of an answer that differs from the golden one.
#[derive(Clone, Copy, PartialEq)]
enum Mode {
    /// The test fails.
    Check,
    /// The difference is reported, with its size.
    Review,
    /// It becomes the golden answer.
    Accept,
}

fn mode() -> Mode {
    match std::env::var("GOLDEN").as_deref() {
        Ok("review") => Mode::Review,
        Ok("accept") => Mode::Accept,
        _ => Mode::Check,
    }
}

fn file(name: &str) -> PathBuf {
    root().join("tests/golden").join(format!("{name}.json"))
}

/// Rounds to 1e-5, finer than the tolerance of the comparison.
fn rounded(value: f64) -> f64 {
    (value * 1e5).round() / 1e5
}

/// x, y, heading, speed.
fn state(s: &State) -> Value {
    json!([s.x_m, s.y_m, s.heading_rad, s.speed_mps()].map(rounded))
}

/// The state at each full second, and the last one.
fn seconds(states: &[State]) -> Value {
    let last = states.len().saturating_sub(1);
    let picked = states.iter().enumerate().filter(|(i, _)| (i + 1) % 10 == 0 || *i == last);
    picked.map(|(_, s)| state(s)).collect()
}

/// All futures of an answer; for a draft, only the last state of the shown one.
fn futures(of: &AgentFutures, all: bool) -> Value {
    if !all {
        let last = of.modes.get(of.chosen).and_then(|shown| shown.states.last());
        return json!({"chosen": of.chosen, "ends": last.map(state)});
    }
    let modes = of.modes.iter().map(|f| {
        json!({"anchor": f.anchor, "probability": rounded(f.probability), "first_step": f.first_step,
            "steps": f.states.len(), "states": seconds(&f.states)})
    });
    json!({"chosen": of.chosen, "modes": modes.collect::<Vec<_>>()})
}

fn sample(of: &Sample, all: bool) -> Value {
    of.agents.iter().map(|(id, f)| (id.clone(), futures(f, all))).collect::<serde_json::Map<_, _>>().into()
}

fn event(event: Event, call: &mut Generation<'_>) -> Value {
    match event {
        Event::Accepted(a) => {
            json!({"event": "accepted", "regenerated": a.regenerated, "reacting": a.reacting,
            "fixed": a.fixed.len(), "steps": a.steps, "windows": a.windows, "warnings": a.warnings})
        }
        Event::Draft(d) => json!({"event": "draft", "window": d.window, "sample": d.sample, "step": d.step,
            "futures": sample(&call.drafted().unwrap(), false)}),
        Event::Final(a) => {
            let resolved = a.resolved.iter().map(|(id, r)| {
                (id.clone(), json!({"type": r.agent_type, "reach": r.reach, "intermediate": r.intermediate}))
            });
            json!({"event": "final", "windows": a.windows, "warnings": a.warnings,
                "resolved": resolved.collect::<serde_json::Map<_, _>>(),
                "samples": a.samples.iter().map(|s| sample(s, true)).collect::<Vec<_>>()})
        }
    }
}

/// Present answer of the program to a case.
fn answer(engine: &Engine, case: &Case) -> Value {
    match case {
        Case::Generate(request) => {
            let mut call = engine.generator.start(request(), Cancel::default()).unwrap();
            let mut events = Vec::new();
            while let Some(told) = call.next() {
                events.push(event(told.unwrap(), &mut call));
            }
            events.into()
        }
        Case::Place(request) => {
            let placed = engine.placer.place(&request(), &Cancel::default()).unwrap();
            let agents = placed.agents.iter().map(|a| {
                let starts: Vec<Value> = a.track.states.iter().flatten().map(state).collect();
                json!({"id": a.id, "type": a.agent_type, "subtype": a.subtype, "length_m": a.size.length_m,
                    "width_m": a.size.width_m, "starts": starts})
            });
            json!({"agents": agents.collect::<Vec<_>>(), "unplaced": placed.unplaced, "reason": placed.reason})
        }
    }
}

#[test]
fn the_shipped_weights_answer_as_they_did() {
    let Engine { generator, placer } = Engine::built_in().unwrap();
    let engine = Engine { generator: generator.with_threads(1), placer };
    let mode = mode();
    let mut failed = Vec::new();
    for (name, case) in CASES {
        let now = answer(&engine, case);
        let golden = std::fs::read(file(name)).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
        let differences = golden.map(|golden: Value| Differences::between(&golden, &now));
        let equal = differences.as_ref().is_some_and(Differences::is_empty);
        match &differences {
            Some(found) if equal => println!("{name}: as it was (largest change {:.1e})", found.largest()),
            Some(found) => println!("{name}: changed\n{found}"),
            None => println!("{name}: new"),
        }
        if mode == Mode::Accept && !equal {
            std::fs::create_dir_all(root().join("tests/golden")).unwrap();
            std::fs::write(file(name), format!("{}\n", compare::text(&now))).unwrap();
        }
        if !equal {
            failed.push(*name);
        }
    }
    assert!(
        mode != Mode::Check || failed.is_empty(),
        "{} changed; `cargo xtask golden` shows how, `cargo xtask golden --accept` keeps it",
        failed.join(", ")
    );
}

/// The page of the networks' inputs equals the output of their tables.
#[test]
fn the_page_of_inputs_is_up_to_date() {
    let path = root().join("docs/features.md");
    let page = experts::features::tables::page();
    if mode() == Mode::Accept {
        std::fs::write(&path, &page).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == page, "docs/features.md: `cargo xtask golden --accept` makes it anew");
}
