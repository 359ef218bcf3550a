//! Opens a scene from another project, gives one road user a goal, and prints its futures with their faults.
//!
//! `cargo run --package dragtraffic-experts --example generate -- assets/scenes/demo-crossing.json 4 2 27.5`

#![allow(clippy::print_stdout, reason = "it talks to people")]

use experts::{Engine, React, Request};
use formats::ImportOptions;
use scene::Vec2;
use std::error::Error;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, id, x, y] = arguments.as_slice() else { return Err("name SCENE ID X Y".into()) };

    // The importer detects the format from the content.
    let mut scenes =
        formats::registry::import(&std::fs::read(path)?, path, "auto", &ImportOptions::default())?;
    let (mut scene, _warnings) = scenes.swap_remove(0)?;
    let agent = scene.agents.iter_mut().find(|agent| agent.id == *id).ok_or("no agent has this id")?;
    agent.conditions.goal.position = Some(Vec2::new(x.parse()?, y.parse()?));

    let engine = Engine::built_in()?;
    let request = Request {
        agents: Some([id.clone()].into()),
        react: React::Everyone,
        seed: 7,
        ..Request::new(Arc::new(scene))
    };
    let answer = engine.generator.answer(request)?;
    for (who, futures) in &answer.samples[0].agents {
        for (rank, future) in futures.modes.iter().enumerate() {
            let end = future.states.last().ok_or("a future without steps")?;
            let mark = if rank == futures.chosen { "*" } else { " " };
            let faults: Vec<String> = future.about.faults.iter().map(|f| format!("{:?}", f.kind)).collect();
            println!(
                "{mark} {who} {:3.0} %  ends at {:.1}, {:.1}  {}",
                100.0 * future.probability,
                end.x_m,
                end.y_m,
                faults.join(", ")
            );
        }
    }
    Ok(())
}
