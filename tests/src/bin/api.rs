//! `api SCHEMATHESIS CONFIG EXAMPLES SEED`: checks the real server against its own document with
//! Schemathesis. `cargo xtask schemathesis` builds and runs it.

#![allow(clippy::print_stderr, reason = "it talks to people")]

use anyhow::{bail, ensure};
use dragtraffic_tests::Server;
use dragtraffic_tests::program::root;
use std::process::{Command, ExitCode};

/// Limits that keep calls short: the test checks replies, not durations.
const LIMITS: [&str; 3] = ["reply_points=20000", "regenerated_agents=8", "running=2"];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::from(2)
        }
    }
}

/// Whether the run found no fault.
fn run(arguments: &[String]) -> anyhow::Result<bool> {
    let [schemathesis, config, examples, seed] = arguments else {
        bail!("usage: api SCHEMATHESIS CONFIG EXAMPLES SEED")
    };
    let flags: Vec<&str> = LIMITS.iter().flat_map(|limit| ["--limit", limit]).collect();
    let server = Server::start(&flags)?;
    server.wait_ready()?;
    let status = Command::new(schemathesis)
        .args(["--config-file", config, "run", &format!("http://{}/openapi.json", server.address)])
        .args(["--max-examples", examples, "--seed", seed])
        .current_dir(root())
        .status()?;
    ensure!(server.get("/healthz")?.status == 200, "the server is gone");
    Ok(status.success())
}
