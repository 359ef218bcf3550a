//! A trained baseline as a rival: weights of a file or a folder, and their futures of road users in a scene.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use candle_core::Device;
use experts::features::AgentFeatures;
use experts::features::agent::plan_with;
use experts::planning::MODES;
use experts::planning::world::World;
use scene::{Future, State};

use super::sight::{Points, forget_goals};
use super::stages::{points, refine};
use super::{BaselineKind, Networks, curve};
use crate::polylines::{Polylines, SeenPiece};
use crate::training::{least, softmax};

/// A learned rival.
pub struct Baseline {
    /// Name in tables.
    pub name: String,
    kind: BaselineKind,
    networks: Vec<Networks>,
}

impl Baseline {
    /// Reads a weights file, or all `.safetensors` files of a folder: one for each type.
    ///
    /// # Errors
    /// When a file cannot be read or is no baseline's, when files are of different methods, or when two
    /// answer for the same type.
    pub fn load(name: &str, path: &Path) -> Result<Self> {
        let mut networks: Vec<Networks> = Vec::new();
        for file in files(path)? {
            let told = || format!("baseline {}", file.display());
            let found = std::fs::read(&file).with_context(told)?;
            let found = Networks::load(&found, false, &Device::Cpu).with_context(told)?;
            let types = found.types().with_context(told)?;
            for other in &networks {
                ensure!(other.plan.kind == found.plan.kind, "{}: of another method than the rest", told());
                let twice = other.types()?.iter().any(|t| types.contains(t));
                ensure!(!twice, "{}: another file answers for the same type", told());
            }
            networks.push(found);
        }
        let first = networks.first();
        let kind = first.map(|n| n.plan.kind).with_context(|| format!("no weights in {}", path.display()))?;
        Ok(Self { name: name.into(), kind, networks })
    }

    /// Small random networks for tests.
    #[cfg(any(test, feature = "samples"))]
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn random(name: &str, kind: BaselineKind) -> Result<Self> {
        let networks = vec![Networks::small(kind, kind.expert().unwrap_or("vehicle"), 1)?];
        Ok(Self { name: name.into(), kind, networks })
    }

    /// It sees goals; otherwise it answers only where there is none.
    pub fn has_condition(&self) -> bool {
        self.kind.has_condition()
    }

    /// Six futures each of some agents of a world under its conditions, the most probable first; none for a
    /// type that it does not know. `polylines` are those of the world's map.
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn futures(
        &self,
        world: &World<'_>,
        polylines: &Polylines,
        agents: &[usize],
    ) -> Result<Vec<Vec<Future>>> {
        let mut out = vec![Vec::new(); agents.len()];
        for networks in &self.networks {
            let types = networks.types()?;
            let (mut slots, mut lines, mut features) = (Vec::new(), Vec::new(), Vec::<AgentFeatures>::new());
            for (slot, agent) in agents.iter().enumerate() {
                let who = world.present.iter().find(|p| p.index == *agent);
                if let Some(who) = who.filter(|who| types.contains(&who.agent_type)) {
                    slots.push((slot, who));
                    lines.push(polylines.seen(world, who));
                    features.push(plan_with(world, who, Vec::new()).features);
                }
            }
            if slots.is_empty() {
                continue;
            }
            if !self.has_condition() {
                features.iter_mut().for_each(forget_goals);
            }
            let lines: Vec<&[SeenPiece]> = lines.iter().map(Vec::as_slice).collect();
            let features: Vec<&AgentFeatures> = features.iter().collect();
            let seen = networks.regressor.see(&polylines.pieces, &lines, &features)?;
            let regressed = networks.regressor.forward(&seen)?;
            let found = match &networks.refiner {
                Some(refiner) => refine(refiner, &seen, &regressed.points)?,
                None => regressed.points,
            };
            let scores = regressed.score.flatten_all()?.to_vec1::<f32>()?;
            let answers = points(&found)?.into_iter().zip(scores.as_chunks::<MODES>().0);
            for ((slot, who), (modes, score)) in slots.into_iter().zip(answers) {
                out[slot] = decoded(&who.start, &modes, score);
            }
        }
        Ok(out)
    }
}

/// Points and scores as futures, the most probable first.
fn decoded(start: &State, modes: &[Points; MODES], score: &[f32; MODES]) -> Vec<Future> {
    let future = |(points, probability): (&Points, f32)| {
        Future::bare(f64::from(probability), 1, curve::states(start, points))
    };
    let mut futures: Vec<Future> = modes.iter().zip(softmax(score)).map(future).collect();
    futures.swap(0, least(&score.map(|score| -score)));
    futures
}

/// The file itself, or the weights files of a folder by name.
fn files(path: &Path) -> Result<Vec<PathBuf>> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let listing = std::fs::read_dir(path).with_context(|| format!("list {}", path.display()))?;
    let mut files: Vec<PathBuf> = listing.filter_map(|entry| entry.ok().map(|e| e.path())).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "safetensors"));
    files.sort();
    Ok(files)
}
