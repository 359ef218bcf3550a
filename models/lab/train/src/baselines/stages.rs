//! The baselines' stages of training.

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, Var};
use experts::features::AgentFeatures;
use experts::net::{Card, NetError, Params, schedule};
use experts::planning::MODES;
use scene::random::Stream;

use super::loss::{self, UNIT_M};
use super::regressor::{NUMBERS, Regressed, Seen};
use super::sight::{Points, Truth, asks_for_a_place, forget_goals};
use super::unet::{Unet, steps};
use super::{BaselineKind, Networks, Plan};
use crate::polylines::SeenPiece;
use crate::training::{Metrics, Record, Shard, Stage, Tools, TrainError, Trainee, index, seeded};

impl Trainee for Networks {
    type Architecture = Plan;

    fn random(plan: Plan, card: Card, seed: u64, device: &Device) -> std::result::Result<Self, NetError> {
        Self::build(plan, card, Params::random(seed, true, device))
    }

    fn read(bytes: &[u8], device: &Device) -> std::result::Result<Self, NetError> {
        Self::load(bytes, true, device)
    }

    fn write(&self) -> std::result::Result<Vec<u8>, NetError> {
        self.save()
    }

    fn architecture(&self) -> &Plan {
        &self.plan
    }

    fn card(&self) -> &Card {
        &self.card
    }

    fn card_mut(&mut self) -> &mut Card {
        &mut self.card
    }

    fn tensors(&self) -> &BTreeMap<String, Tensor> {
        &self.tensors
    }

    fn vars(&self) -> &BTreeMap<String, Var> {
        &self.vars
    }

    fn takes(&self, record: &Record) -> bool {
        self.plan.kind.has_condition() || !asks_for_a_place(&record.agent)
    }

    fn draws_files_evenly(&self) -> bool {
        self.plan.kind == BaselineKind::TrafficGenConditional
    }

    fn loss(
        &self,
        _: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> std::result::Result<(Tensor, Metrics), TrainError> {
        let mut metrics = Metrics::new(shard.records.len());
        let seen = self.see(shard)?;
        let truths: Vec<Truth> = shard.records.iter().map(Truth::of).collect();
        let refiner = self.refiner.as_ref();
        let loss = match (stage, refiner) {
            (Stage::Denoiser, Some(refiner)) => denoiser(refiner, &seen, &truths, rng, &mut metrics)?,
            (Stage::Joint, Some(refiner)) => {
                let (first, regressed) = self.regressor(&seen, &truths, &mut metrics)?;
                (first + joint(refiner, &seen, &truths, &regressed, rng, &mut metrics)?)?
            }
            _ => self.regressor(&seen, &truths, &mut metrics)?.0,
        };
        Ok((loss, metrics))
    }

    fn validate(
        &self,
        _: &Tools,
        shard: &Shard,
        stage: Stage,
        _: &mut Stream,
    ) -> std::result::Result<Metrics, TrainError> {
        let mut metrics = Metrics::new(shard.records.len());
        let seen = self.see(shard)?;
        let truths: Vec<Truth> = shard.records.iter().map(Truth::of).collect();
        let (_, regressed) = self.regressor(&seen, &truths, &mut metrics)?;
        if let Some(refiner) = self.refiner.as_ref().filter(|_| stage != Stage::Initializer) {
            let refined = refine(refiner, &seen, &regressed.points)?;
            for (truth, futures) in truths.iter().zip(points(&refined)?) {
                let ade = loss::squared(truth, &futures).ade;
                metrics.add("refined", ade.into_iter().fold(f32::INFINITY, f32::min));
            }
        }
        Ok(metrics)
    }
}

impl Networks {
    fn see(&self, shard: &Shard) -> Result<Seen> {
        let mut agents: Vec<AgentFeatures> = shard.records.iter().map(|r| r.agent.clone()).collect();
        if !self.plan.kind.has_condition() {
            agents.iter_mut().for_each(forget_goals);
        }
        let seen: Vec<&[SeenPiece]> = shard.records.iter().map(|r| r.pieces.as_slice()).collect();
        self.regressor.see(&shard.pieces, &seen, &agents.iter().collect::<Vec<_>>())
    }

    fn regressor(&self, seen: &Seen, truths: &[Truth], metrics: &mut Metrics) -> Result<(Tensor, Regressed)> {
        let regressed = self.regressor.forward(seen)?;
        let scores = regressed.score.flatten_all()?.to_vec1::<f32>()?;
        let (mut pulls, mut nudges) = (Vec::with_capacity(truths.len()), Vec::with_capacity(truths.len()));
        let all = truths.iter().zip(points(&regressed.points)?).zip(scores.as_chunks::<MODES>().0);
        for ((truth, futures), score) in all {
            let fared = loss::squared(truth, &futures);
            let (likelihood, nudge) = index(score, fared.best);
            let first = crate::training::least(&score.map(|score| -score));
            metrics.add("loss", fared.loss + likelihood);
            metrics.add("min", fared.ade.into_iter().fold(f32::INFINITY, f32::min));
            metrics.add("first", fared.ade[first]);
            metrics.add("score", likelihood);
            pulls.push(fared.gradient);
            nudges.push(nudge);
        }
        let loss = (seeded(&regressed.points, flat(&pulls))?
            + seeded(&regressed.score, nudges.as_flattened().to_vec())?)?;
        Ok((loss, regressed))
    }
}

/// Futures in metres after all refinement steps.
pub(super) fn refine(refiner: &Unet, seen: &Seen, futures: &Tensor) -> Result<Tensor> {
    refiner.walk(seen, &(futures / f64::from(UNIT_M))?, &steps())? * f64::from(UNIT_M)
}

/// The noise in the recording is to be told. All modes are the recording, each with noise of its own.
fn denoiser(
    refiner: &Unet,
    seen: &Seen,
    truths: &[Truth],
    rng: &mut Stream,
    metrics: &mut Metrics,
) -> Result<Tensor> {
    let mut levels = Vec::with_capacity(truths.len());
    let (mut noisy, mut noise) = (Vec::new(), Vec::new());
    for truth in truths {
        let level = 1 + rng.below(schedule::LEVELS);
        let signal = schedule::signal(level);
        levels.push(level);
        for _ in 0..MODES {
            for value in truth.points.as_flattened() {
                let drawn = rng.normal() as f32;
                let clean = f64::from(value / UNIT_M);
                noisy.push((signal.sqrt() * clean + (1.0 - signal).sqrt() * f64::from(drawn)) as f32);
                noise.push(drawn);
            }
        }
    }
    let noisy = Tensor::from_vec(noisy, (truths.len(), MODES, NUMBERS), seen.vector.device())?;
    let output = refiner.noise(seen, &noisy, &levels)?;
    let mut gradient = output.flatten_all()?.to_vec1::<f32>()?;
    let rows = gradient.chunks_exact_mut(MODES * NUMBERS).zip(noise.chunks_exact(MODES * NUMBERS));
    for ((gradient, noise), truth) in rows.zip(truths) {
        let count = MODES as f32 * 2.0 * truth.valid.iter().sum::<f32>().max(1.0);
        let mut total = 0.0;
        for (i, (value, noise)) in gradient.iter_mut().zip(noise).enumerate() {
            let miss = truth.valid[i % NUMBERS / 2] * (*value - noise);
            total += miss * miss / count;
            *value = 2.0 * miss / count;
        }
        metrics.add("loss", total);
    }
    seeded(&output, gradient)
}

/// The refined winner is pulled to the recording, from one of the steps on the way.
fn joint(
    refiner: &Unet,
    seen: &Seen,
    truths: &[Truth],
    regressed: &Regressed,
    rng: &mut Stream,
    metrics: &mut Metrics,
) -> Result<Tensor> {
    let steps = steps();
    let taken = rng.below(steps.len());
    let drafts = (regressed.points.detach() / f64::from(UNIT_M))?;
    let unseen = Seen { vector: seen.vector.detach(), tokens: seen.tokens.detach(), mask: seen.mask.clone() };
    let before = refiner.walk(&unseen, &drafts, &steps[..taken])?.detach();
    let refined = (refiner.denoise(seen, &before, steps[taken].0)? * f64::from(UNIT_M))?;
    let mut pulls = Vec::with_capacity(truths.len());
    for (truth, futures) in truths.iter().zip(points(&refined)?) {
        let fared = loss::squared(truth, &futures);
        metrics.add("loss", fared.loss);
        metrics.add("refined", fared.ade[fared.best]);
        pulls.push(fared.gradient);
    }
    seeded(&refined, flat(&pulls))
}

/// A tensor of futures as arrays.
pub(super) fn points(futures: &Tensor) -> Result<Vec<[Points; MODES]>> {
    let values = futures.flatten_all()?.to_vec1::<f32>()?;
    let points = values.as_chunks::<2>().0.as_chunks::<{ NUMBERS / 2 }>().0;
    Ok(points.as_chunks::<MODES>().0.to_vec())
}

fn flat(futures: &[[Points; MODES]]) -> Vec<f32> {
    futures.as_flattened().as_flattened().as_flattened().to_vec()
}
