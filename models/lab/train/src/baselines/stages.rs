//! The baselines' stages of training.

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, Var};
use experts::features::AgentFeatures;
use experts::net::{Card, NetError, Params, schedule};
use experts::planning::MODES;
use scene::random::Stream;

use super::encoder::Sight;
use super::loss::{self, UNIT_M};
use super::regressor::{NUMBERS, Regressed};
use super::sight::{Points, Truth, asks_for_a_place, forget_goals};
use super::unet::{Context, STEPS, Unet};
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

    /// Share of the learning rate, as in the paper: frozen parts have none, and the joint stage trains
    /// everything alike.
    fn share(stage: Stage, name: &str) -> f64 {
        let refiner = name.starts_with("refiner.");
        match stage {
            Stage::Denoiser => f64::from(u8::from(refiner)),
            Stage::Initializer => f64::from(u8::from(!refiner)),
            Stage::Joint => 1.0,
        }
    }

    fn loss(
        &self,
        _: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> std::result::Result<(Tensor, Metrics), TrainError> {
        let mut metrics = Metrics::new(shard.records.len());
        let sight = self.sight(shard)?;
        let truths: Vec<Truth> = shard.records.iter().map(Truth::of).collect();
        let loss = match (stage, self.refiner.as_ref()) {
            (Stage::Denoiser, Some(refiner)) => {
                let seen = refiner.context(&sight)?;
                estimation(refiner, &seen, &truths, rng, &mut metrics)?
            }
            (Stage::Joint, Some(refiner)) => {
                let seen = refiner.context(&sight)?;
                let noise = estimation(refiner, &seen, &truths, rng, &mut metrics)?;
                let mut first = self.regressor.forward(&sight)?;
                let fresh = fresh(rng, truths.len(), self.device())?;
                first.points = refine(refiner, &seen, &first.points, &fresh)?;
                (noise + pulled(&first, &truths, ["refined", "first"], &mut metrics)?)?
            }
            _ => pulled(&self.regressor.forward(&sight)?, &truths, ["min", "first"], &mut metrics)?,
        };
        Ok((loss, metrics))
    }

    fn validate(
        &self,
        _: &Tools,
        shard: &Shard,
        stage: Stage,
        rng: &mut Stream,
    ) -> std::result::Result<Metrics, TrainError> {
        let mut metrics = Metrics::new(shard.records.len());
        let sight = self.sight(shard)?;
        let truths: Vec<Truth> = shard.records.iter().map(Truth::of).collect();
        match (stage, self.refiner.as_ref()) {
            (Stage::Denoiser, Some(refiner)) => {
                estimation(refiner, &refiner.context(&sight)?, &truths, rng, &mut metrics)?;
            }
            (Stage::Joint, Some(refiner)) => {
                let seen = refiner.context(&sight)?;
                let mut first = self.regressor.forward(&sight)?;
                nearest(&first, &truths, "min", &mut metrics)?;
                let fresh = fresh(rng, truths.len(), self.device())?;
                first.points = refine(refiner, &seen, &first.points, &fresh)?;
                pulled(&first, &truths, ["refined", "first"], &mut metrics)?;
            }
            _ => {
                pulled(&self.regressor.forward(&sight)?, &truths, ["min", "first"], &mut metrics)?;
            }
        }
        Ok(metrics)
    }
}

impl Networks {
    fn sight(&self, shard: &Shard) -> Result<Sight> {
        let mut agents: Vec<AgentFeatures> = shard.records.iter().map(|r| r.agent.clone()).collect();
        if !self.plan.kind.has_condition() {
            agents.iter_mut().for_each(forget_goals);
        }
        let seen: Vec<&[SeenPiece]> = shard.records.iter().map(|r| r.pieces.as_slice()).collect();
        let agents: Vec<&AgentFeatures> = agents.iter().collect();
        Sight::stack(&self.plan, &shard.pieces, &seen, &agents, self.device())
    }
}

/// The paper's L_MSE of the future nearest to the recording and L_NLL of its index. `least` and `first` name
/// the metrics of the least distance and of the distance of the most probable future.
fn pulled(
    futures: &Regressed,
    truths: &[Truth],
    [least, first]: [&'static str; 2],
    metrics: &mut Metrics,
) -> Result<Tensor> {
    let scores = futures.score.flatten_all()?.to_vec1::<f32>()?;
    let (mut pulls, mut nudges) = (Vec::with_capacity(truths.len()), Vec::with_capacity(truths.len()));
    let all = truths.iter().zip(points(&futures.points)?).zip(scores.as_chunks::<MODES>().0);
    for ((truth, futures), score) in all {
        let fared = loss::squared(truth, &futures);
        let (likelihood, nudge) = index(score, fared.best);
        let shown = crate::training::least(&score.map(|score| -score));
        metrics.add("loss", fared.loss + likelihood);
        metrics.add(least, fared.ade.into_iter().fold(f32::INFINITY, f32::min));
        metrics.add(first, fared.ade[shown]);
        metrics.add("score", likelihood);
        pulls.push(fared.gradient);
        nudges.push(nudge);
    }
    seeded(&futures.points, flat(&pulls))? + seeded(&futures.score, nudges.as_flattened().to_vec())?
}

/// Least mean distance of six futures, as a metric only.
fn nearest(futures: &Regressed, truths: &[Truth], name: &'static str, metrics: &mut Metrics) -> Result<()> {
    for (truth, futures) in truths.iter().zip(points(&futures.points)?) {
        metrics.add(name, loss::squared(truth, &futures).ade.into_iter().fold(f32::INFINITY, f32::min));
    }
    Ok(())
}

/// Futures in metres after all refinement steps.
pub(super) fn refine(refiner: &Unet, seen: &Context, futures: &Tensor, fresh: &[Tensor]) -> Result<Tensor> {
    refiner.leapfrog(seen, &(futures / f64::from(UNIT_M))?, fresh)? * f64::from(UNIT_M)
}

/// Noise for all refinement steps of a batch.
pub(super) fn fresh(rng: &mut Stream, batch: usize, device: &Device) -> Result<Vec<Tensor>> {
    let mut draw = || {
        let values: Vec<f32> = (0..batch * MODES * NUMBERS).map(|_| rng.normal() as f32).collect();
        Tensor::from_vec(values, (batch, MODES, NUMBERS), device)
    };
    (0..STEPS).map(|_| draw()).collect()
}

/// The paper's L_NE: the network predicts the noise in the recording. All modes are the recording, each with
/// its own noise.
fn estimation(
    refiner: &Unet,
    seen: &Context,
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
        metrics.add("noise", total);
    }
    seeded(&output, gradient)
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
