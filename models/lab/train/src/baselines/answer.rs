//! A trained baseline as a rival: weights of a file or a folder, and their futures of road users in a scene.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use candle_core::{Device, Tensor};
use experts::features::AgentFeatures;
use experts::features::agent::plan_with;
use experts::planning::MODES;
use experts::planning::world::World;
use scene::random::Key;
use scene::{AgentType, Future, State};

use super::encoder::Sight;
use super::regressor::NUMBERS;
use super::sight::{Points, forget_goals};
use super::stages::{points, refine};
use super::unet::STEPS;
use super::{BaselineKind, Networks, curve};
use crate::polylines::{Polylines, SeenPiece};
use crate::training::{least, softmax};

/// A learned rival.
pub struct Baseline {
    /// Name in tables.
    pub name: String,
    kind: BaselineKind,
    networks: Vec<Networks>,
    /// It answers for types that it did not learn from.
    for_all: bool,
    /// Draws the noise of refinement.
    seed: u64,
}

impl Baseline {
    /// Reads a weights file, or all `.safetensors` files of a folder: one for each type.
    ///
    /// # Errors
    /// When a file cannot be read or holds no baseline, when files are of different methods, or when two
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
        Ok(Self { name: name.into(), kind, networks, for_all: false, seed: 0 })
    }

    /// Answers for all types, regardless of those that its network learned from, as plain TrafficGen does in
    /// the paper's Table I.
    #[must_use]
    pub fn for_all_types(mut self) -> Self {
        self.for_all = true;
        self
    }

    /// Draws the noise of refinement by another seed.
    #[must_use]
    pub fn seeded(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Small random networks for tests.
    #[cfg(any(test, feature = "samples"))]
    ///
    /// # Errors
    /// When the tensor library fails.
    pub fn random(name: &str, kind: BaselineKind) -> Result<Self> {
        let networks = vec![Networks::small(kind, kind.expert().unwrap_or("vehicle"), 1)?];
        Ok(Self { name: name.into(), kind, networks, for_all: false, seed: 0 })
    }

    /// Whether it sees goals; otherwise it only answers requests without a goal.
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
            let types: &[AgentType] = if self.for_all {
                &[AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist]
            } else {
                networks.types()?
            };
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
            let sight =
                Sight::stack(&networks.plan, &polylines.pieces, &lines, &features, networks.device())?;
            let regressed = networks.regressor.forward(&sight)?;
            let found = match &networks.refiner {
                Some(refiner) => {
                    let ids = slots.iter().map(|(_, who)| world.scene.agents[who.index].id.as_str());
                    let fresh = self.fresh(ids, world.step, networks.device())?;
                    refine(refiner, &refiner.context(&sight)?, &regressed.points, &fresh)?
                }
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

    /// Noise of all refinement steps, independent for each road user: other road users in the request do not
    /// change it.
    fn fresh<'a>(
        &self,
        ids: impl Iterator<Item = &'a str>,
        step: usize,
        device: &Device,
    ) -> candle_core::Result<Vec<Tensor>> {
        let mut draws: Vec<Vec<f32>> = vec![Vec::new(); STEPS];
        let mut batch = 0;
        for id in ids {
            batch += 1;
            let key = Key::default().number(self.seed).number(step as u64).words(&["leapfrog", id]);
            let mut stream = key.stream();
            for draw in &mut draws {
                draw.extend((0..MODES * NUMBERS).map(|_| stream.normal() as f32));
            }
        }
        draws.into_iter().map(|draw| Tensor::from_vec(draw, (batch, MODES, NUMBERS), device)).collect()
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
