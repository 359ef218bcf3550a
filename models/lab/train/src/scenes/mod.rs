//! Recorded scenes: reads them from files, and prepares them for training and evaluation.

mod crop;
mod mirror;
mod stretch;

pub use crop::{Crop, Cropped};
pub use mirror::mirrored;
pub use stretch::stretch;

use anyhow::{Context, Result};
use scene::{Conditions, Scene, SignalState, Track};
use std::path::{Path, PathBuf};

/// Scene files below the inputs, sorted.
///
/// # Errors
/// When a folder cannot be listed or holds nothing.
pub fn scene_files(inputs: &[PathBuf]) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for input in inputs {
        if input.is_dir() {
            let listing = std::fs::read_dir(input).with_context(|| format!("list {}", input.display()))?;
            files.extend(listing.filter_map(|e| e.ok().map(|e| e.path())).filter(|p| p.is_file()));
        } else {
            files.push(input.clone());
        }
    }
    files.retain(|p| !p.to_string_lossy().ends_with(".tmp"));
    files.sort();
    anyhow::ensure!(!files.is_empty(), "no files in {inputs:?}");
    Ok(files)
}

/// All scenes of a file that can be read, as the program opens them.
///
/// # Errors
/// When the file cannot be opened or no format reads it.
pub fn read_scenes(path: &Path) -> Result<Vec<Scene>> {
    let bytes = std::fs::read(path).with_context(|| format!("read {}", path.display()))?;
    let options = formats::ImportOptions::default();
    let imported = formats::registry::import(&bytes, &path.to_string_lossy(), "auto", &options);
    Ok(imported?.into_iter().filter_map(Result::ok).map(|(scene, _)| scene).collect())
}

/// Key of the place of a scene: the source id without its window number.
pub fn place_key(scene: &Scene) -> u64 {
    let id = scene.meta.source_id.as_deref().unwrap_or(&scene.name);
    let place = if id.starts_with("synth-") { id.rsplit_once('-').map_or(id, |p| p.0) } else { id };
    let hash = blake3::hash(place.as_bytes());
    hash.as_bytes()[..8].iter().fold(0, |key, byte| (key << 8) | u64::from(*byte))
}

/// A copy of a scene without information after its first step. It has one state for each road user, signals
/// that are unknown after their present state, no conditions and no futures. Neither features nor choices can
/// look ahead in it.
pub fn blind(scene: &Scene) -> Scene {
    let mut out = scene.clone();
    out.generated = None;
    for agent in &mut out.agents {
        let start = agent.track.at(0).copied();
        let states = start.map(|s| vec![Some(s)]).unwrap_or_default();
        agent.track = Track { first_step: 0, states, z_m: None }.into();
        agent.conditions = Conditions::default();
    }
    for signal in &mut out.signals {
        signal.runs.retain(|(first, _)| *first == 0);
    }
    out.signals.retain(|signal| !signal.runs.is_empty());
    for signal in &mut out.signals {
        signal.runs.push((1, SignalState::Unknown));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::{log, scene, shifted};
    use scene::{Signal, SignalState};

    #[test]
    fn a_blind_scene_knows_nothing_of_the_future() {
        let mut first = scene(vec![log("a", 8.0, 91), shifted(log("b", 5.0, 91), 30.0, 3.5)]);
        let runs = vec![(0, SignalState::Go), (40, SignalState::Stop)];
        first.signals.push(Signal { lane: "a".into(), stop: None, stop_z_m: None, runs });
        let mut other = first.clone();
        for agent in &mut other.agents {
            for state in agent.track.states.iter_mut().skip(1).flatten() {
                (state.x_m, state.vx_mps) = (state.x_m + 17.0, 0.0);
            }
        }
        other.signals[0].runs[1] = (20, SignalState::Caution);
        // A signal whose states begin later is absent.
        let late = Signal { runs: vec![(7, SignalState::Stop)], ..first.signals[0].clone() };
        other.signals.push(late);
        assert_eq!(blind(&first), blind(&other));
        assert_eq!(blind(&first).agents[0].track.valid_steps().collect::<Vec<_>>(), [0]);
    }
}
