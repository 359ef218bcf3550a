//! Latency of a drag over HTTP on this machine, as information and not as a gate.

use crate::{Outcome, program, root};
use anyhow::{Context, ensure};
use serde_json::Value;
use std::process::{Command, Stdio};

const SCENE: &str = "assets/scenes/demo-crossing.json";

/// Runs the benchmark briefly and reports its medians.
pub fn drag() -> anyhow::Result<Outcome> {
    let mut command = Command::new(program()?);
    let output = command
        .args(["lab", "bench", SCENE, "--http", "--quiet"])
        .current_dir(root())
        .stdin(Stdio::null())
        .stderr(Stdio::inherit())
        .output()?;
    ensure!(output.status.success(), "dragtraffic lab bench: {}", output.status);
    line(&serde_json::from_slice(&output.stdout)?).map(Outcome::Told)
}

/// Medians of a drag and of a release, with the reply's size.
fn line(rows: &Value) -> anyhow::Result<String> {
    let row = |what: &str| {
        let rows = rows.as_array().into_iter().flatten();
        rows.into_iter().find(|row| row["what"] == what).with_context(|| format!("no row \"{what}\""))
    };
    let ms = |row: &Value, member: &str| {
        row[member]["p50_ms"].as_f64().with_context(|| format!("no {member} in {row}"))
    };
    let (drag, release) = (row("drag, streamed")?, row("release, streamed")?);
    let bytes = release["bytes"].as_u64().context("no bytes")?;
    Ok(format!(
        "p50 of this build: drag, first futures {:.1} ms, end {:.1} ms (in process {:.1}); release {:.1} ms (in process {:.1}), {} KB",
        ms(drag, "first")?,
        ms(drag, "http")?,
        ms(drag, "engine")?,
        ms(release, "http")?,
        ms(release, "engine")?,
        bytes / 1000
    ))
}

#[cfg(test)]
mod tests {
    use super::line;
    use serde_json::json;

    #[test]
    fn medians_of_drag_and_release_are_told() {
        let row = |what: &str, ms: f64| {
            let p50 = json!({"p50_ms": ms});
            json!({"what": what, "http": p50, "engine": {"p50_ms": ms - 1.0}, "first": {"p50_ms": ms / 2.0}, "bytes": 70_400})
        };
        let rows = json!([row("drag, streamed", 4.0), row("release, streamed", 5.0)]);
        assert!(line(&rows).unwrap().ends_with(
            "first futures 2.0 ms, end 4.0 ms (in process 3.0); release 5.0 ms (in process 4.0), 70 KB"
        ));
        assert!(line(&json!([row("drag, streamed", 4.0)])).is_err());
    }
}
