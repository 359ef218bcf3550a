//! Corrects existing demo scenes: `cargo run -p dragtraffic-lab-synthesize --example mend_scenes -- FILE...`.

use anyhow::Context as _;

fn main() -> anyhow::Result<()> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    anyhow::ensure!(!files.is_empty(), "name the scenes, such as assets/scenes/demo-crossing.json");
    for file in files {
        let bytes = std::fs::read(&file).with_context(|| file.clone())?;
        let scene = formats::native::read(&bytes).map_err(|e| anyhow::anyhow!("{file}: {e}"))?;
        let (scene, faults) = lab_synthesize::demo::mended(scene);
        for fault in faults {
            eprintln!("{file}: {fault}");
        }
        std::fs::write(&file, formats::native::write(&scene)).with_context(|| file.clone())?;
    }
    Ok(())
}
