//! `package`: the published crates compile from the contents of their packages alone.

use crate::{Outcome, cargo_command, root, run};
use anyhow::{Context, ensure};
use std::path::Path;
use std::process::Command;

/// The published crates.
const CRATES: &[&str] = &["dragtraffic-scene", "dragtraffic-formats", "dragtraffic-experts"];

/// Packs them, unpacks them beside each other and checks them as a separate workspace. It shares our profiles
/// and our target folder, so that checked dependencies are reused.
pub fn check() -> anyhow::Result<Outcome> {
    let target = root().join("target");
    let folder = target.join("packages");
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    std::fs::create_dir_all(&folder)?;
    let mut pack = cargo_command();
    pack.args(["package", "--allow-dirty", "--no-verify", "--quiet", "--target-dir"]).arg(&folder);
    pack.args(CRATES.iter().flat_map(|name| ["-p", name]));
    if let failed @ Outcome::Failed(_) = run(&mut pack)? {
        return Ok(failed);
    }
    let mut members = Vec::new();
    for name in CRATES {
        let packed = std::fs::read_dir(folder.join("package"))?.filter_map(|entry| Some(entry.ok()?.path()));
        let is_its = |path: &Path| {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            path.extension().is_some_and(|end| end == "crate") && stem.starts_with(&format!("{name}-"))
        };
        let packed =
            packed.into_iter().find(|path| is_its(path)).with_context(|| format!("no package of {name}"))?;
        // All packed files have one old date, by which cargo would mistake earlier results for up-to-date
        // ones.
        let unpacked = run(Command::new("tar").arg("-xzmf").arg(&packed).arg("-C").arg(&folder))?;
        ensure!(matches!(unpacked, Outcome::Passed), "{} cannot be unpacked", packed.display());
        members.push((name, packed.file_stem().unwrap_or_default().to_string_lossy().into_owned()));
    }
    std::fs::write(folder.join("Cargo.toml"), workspace(&members)?)?;
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock"))?;
    let manifest = folder.join("Cargo.toml");
    run(cargo_command()
        .args(["check", "--offline", "--manifest-path"])
        .arg(manifest)
        .arg("--target-dir")
        .arg(target))
}

/// The manifest of a workspace of these crates and folders; they find each other here, as they would in a
/// registry.
fn workspace(members: &[(&&str, String)]) -> anyhow::Result<String> {
    let ours = std::fs::read_to_string(root().join("Cargo.toml"))?;
    let profiles = ours.find("[profile.").context("no profile in Cargo.toml")?;
    let folders: Vec<String> = members.iter().map(|(_, folder)| format!("{folder:?}")).collect();
    let patches: Vec<String> =
        members.iter().map(|(name, folder)| format!("{name} = {{ path = {folder:?} }}")).collect();
    Ok(format!(
        "[workspace]\nresolver = \"3\"\nmembers = [{}]\n\n[patch.crates-io]\n{}\n\n{}",
        folders.join(", "),
        patches.join("\n"),
        &ours[profiles..]
    ))
}
