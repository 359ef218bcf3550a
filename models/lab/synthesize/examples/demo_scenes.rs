//! Makes the demo scenes: `cargo run -p dragtraffic-lab-synthesize --example demo_scenes -- FOLDER [ID]`. Needs SUMO.

use anyhow::Context as _;
use std::path::Path;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let folder = arguments.first().context("name the folder for the scenes, such as assets/scenes")?;
    let written = lab_synthesize::demo::demo(Path::new(folder), arguments.get(1).map(String::as_str), None)?;
    for path in written {
        eprintln!("{}", path.display());
    }
    Ok(())
}
