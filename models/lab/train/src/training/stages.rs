//! The losses of the three stages for a shard, and the metrics on held-out records.

use candle_core::{Device, Result, Tensor};
use experts::Refining;
use experts::features::AgentFeatures;
use experts::features::OWN_GOAL_POSITION;
use experts::features::encounters::{Encounters, encounters};
use experts::net::inputs::EncounterTensors;
use experts::net::{Context, DraftInputs, Expert, Initial, Prepared, schedule};
use experts::planning::pullback::Pullback;
use experts::planning::{ALONG_SCALE, INSTANT_S, INSTANTS, MODES, RESIDUAL, mode_at};
use experts::tuning::SHIPPED;
use scene::KNOTS;
use scene::geometry::overlap_energy::{Growth, carried_back, carried_on, overlap_energy};
use scene::random::Stream;

use super::loss::{self, AgentOutput, InitialParts};
use super::metrics::Metrics;
use super::obstacles::{Obstacle, ShardObstacles};
use super::route::{DraftPoses, ResidualBasis};
use super::sample::Shard;
use super::{Record, TrainError};

/// Residuals of a record's modes.
pub(super) use experts::planning::Modes;

/// Weight of the overlap penalty in the joint stage, of energies summed over the instants.
const PENALTY: f32 = 6.888_889;
/// Weight of the distance to the draft, for the modes that are not the best.
const STAY: f32 = 0.5;

/// Which part of the expert is trained, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// The refiner learns to remove noise from recorded residuals.
    Denoiser,
    /// The initializer learns six futures and their probabilities.
    Initializer,
    /// The refiner learns on drafts of the initializer, with the overlap penalty; the rest follows at a lower
    /// rate.
    Joint,
}

impl Stage {
    /// Records of one scene in a batch: the joint stage refines all of them at once.
    pub(super) fn together(self) -> usize {
        if self == Self::Joint { 8 } else { 1 }
    }
}

/// Constants of all shards.
pub(crate) struct Tools {
    pub(super) route: ResidualBasis,
    pullback: Pullback,
    /// Inputs of the refiner.
    refining: Refining,
}

impl Tools {
    pub(super) fn new(refining: Refining) -> Self {
        Self { route: ResidualBasis::new(), pullback: Pullback::default(), refining }
    }
}

/// Overlap energy of a draft, and its gradient along and across at the instants.
fn energy(
    record: &Record,
    draft: &DraftPoses,
    obstacles: &[Obstacle],
    growth: Growth,
) -> (f32, [[f32; 2]; INSTANTS]) {
    let overlap = overlap_energy(&draft.poses, record.half, obstacles.iter().map(Obstacle::moving), growth);
    (overlap.energy, draft.along_across(&overlap.gradient))
}

/// Penalty of the joint stage for one residual: boxes that are too close now or will be soon, as in the
/// energy that resolves overlaps in a draw. Records contain no kerbs.
fn penalty(
    tools: &Tools,
    record: &Record,
    mode: usize,
    residual: &[f32; RESIDUAL],
    obstacles: &[Obstacle],
) -> (f32, [[f32; 2]; INSTANTS]) {
    let tuning = &SHIPPED.overlaps;
    let (share, weight) = (tuning.soon_intervals as f32, tuning.soon as f32);
    let draft = DraftPoses::of(&tools.route, record, mode, residual);
    let (mut energy, mut gradient) = energy(record, &draft, obstacles, Growth::Linear);
    let later: Vec<Obstacle> = obstacles.iter().map(|o| o.carried_on(share)).collect();
    let later = later.iter().map(Obstacle::moving);
    let soon = overlap_energy(&carried_on(&draft.poses, share), record.half, later, Growth::Linear);
    energy += weight * soon.energy;
    let slope = draft.along_across(&carried_back(&soon.gradient, share));
    for (sum, slope) in gradient.as_flattened_mut().iter_mut().zip(slope.as_flattened()) {
        *sum += weight * slope;
    }
    (energy, gradient)
}

/// Inputs of a refiner step, as tensors.
struct StepInputs {
    push: Tensor,
    /// Encounters, for a refiner with attention.
    encounters: Option<EncounterTensors>,
}

impl StepInputs {
    /// Inputs for drafts among obstacles.
    fn at(
        expert: &Expert,
        tools: &Tools,
        shard: &Shard,
        obstacles: &[Vec<Obstacle>],
        drafts: &[Modes],
    ) -> Result<Self> {
        let device = expert.device();
        let stacked = || {
            let met = met(tools, shard, obstacles, drafts);
            EncounterTensors::stack(&met.iter().collect::<Vec<_>>(), device)
        };
        Ok(Self {
            push: tensor(&repulsions(tools, shard, obstacles, drafts), device)?,
            encounters: expert.attends().then(stacked).transpose()?,
        })
    }

    fn borrowed(&self) -> DraftInputs<'_> {
        DraftInputs { push: &self.push, encounters: self.encounters.as_ref() }
    }
}

/// The encounters of drafts.
fn met(tools: &Tools, shard: &Shard, obstacles: &[Vec<Obstacle>], drafts: &[Modes]) -> Vec<Encounters> {
    if !tools.refining.attention {
        return vec![Encounters::default(); drafts.len()];
    }
    let all = shard.records.iter().zip(obstacles).zip(drafts);
    all.map(|((record, obstacles), draft)| {
        std::array::from_fn(|mode| {
            let own = DraftPoses::of(&tools.route, record, mode, &draft[mode]).poses;
            encounters(&own, record.half, obstacles.iter().map(Obstacle::moving))
        })
    })
    .collect()
}

/// Descent directions of the energy at drafts.
fn repulsions(tools: &Tools, shard: &Shard, obstacles: &[Vec<Obstacle>], drafts: &[Modes]) -> Vec<Modes> {
    if !tools.refining.repulsion {
        return vec![[[0.0; RESIDUAL]; MODES]; drafts.len()];
    }
    let all = shard.records.iter().zip(obstacles).zip(drafts);
    all.map(|((record, obstacles), draft)| {
        std::array::from_fn(|mode| {
            let draft = DraftPoses::of(&tools.route, record, mode, &draft[mode]);
            let (energy, slope) = energy(record, &draft, obstacles, Growth::Square);
            if energy > 0.0 {
                tools.pullback.downhill(&slope, &record.agent.tangent)
            } else {
                [0.0; RESIDUAL]
            }
        })
    })
    .collect()
}

fn context(expert: &Expert, shard: &Shard) -> std::result::Result<Context, TrainError> {
    let agents: Vec<&AgentFeatures> = shard.records.iter().map(|record| &record.agent).collect();
    Ok(expert.encode(&agents)?)
}

fn tensor(values: &[Modes], device: &Device) -> Result<Tensor> {
    Tensor::from_slice(values.as_flattened().as_flattened(), (values.len(), MODES, RESIDUAL), device)
}

fn arrays(tensor: &Tensor) -> Result<Vec<Modes>> {
    let values = tensor.flatten_all()?.to_vec1::<f32>()?;
    Ok(values.as_chunks::<RESIDUAL>().0.as_chunks::<MODES>().0.to_vec())
}

/// `sum(output * gradient)`: its backward pass gives `gradient` to `output`.
pub(crate) fn seeded(output: &Tensor, gradient: Vec<f32>) -> Result<Tensor> {
    (output * Tensor::from_vec(gradient, output.shape(), output.device())?)?.sum_all()
}

fn seeded_modes(output: &Tensor, gradient: &[Modes]) -> Result<Tensor> {
    seeded(output, gradient.as_flattened().as_flattened().to_vec())
}

fn noise(rng: &mut Stream, count: usize, scale: f32) -> Vec<Modes> {
    (0..count)
        .map(|_| std::array::from_fn(|_| std::array::from_fn(|_| scale * rng.normal() as f32)))
        .collect()
}

/// A scalar whose backward pass gives the gradient of a stage's loss summed over the shard, and the metrics.
pub(super) fn train(
    expert: &Expert,
    tools: &Tools,
    shard: &Shard,
    stage: Stage,
    rng: &mut Stream,
) -> std::result::Result<(Tensor, Metrics), TrainError> {
    let context = context(expert, shard)?;
    let mut metrics = Metrics::new(shard.records.len());
    let loss = match stage {
        Stage::Denoiser => denoiser(expert, tools, shard, &context, rng, &mut metrics)?,
        Stage::Initializer => initializer(expert, tools, shard, &context, &mut metrics)?.0,
        Stage::Joint => {
            let (first, initial) = initializer(expert, tools, shard, &context, &mut metrics)?;
            (first + joint(expert, tools, shard, &context, &initial, rng, &mut metrics)?)?
        }
    };
    Ok((loss, metrics))
}

fn initializer(
    expert: &Expert,
    tools: &Tools,
    shard: &Shard,
    context: &Context,
    metrics: &mut Metrics,
) -> std::result::Result<(Tensor, Initial), TrainError> {
    let initial = expert.initializer.forward(context)?;
    let mut grads = Vec::with_capacity(shard.records.len());
    for (index, output) in outputs(&initial)?.iter().enumerate() {
        let Record { agent, target, .. } = &shard.records[index];
        let bound = agent.own[OWN_GOAL_POSITION] > 0.0;
        let (parts, grad) = loss::initial(&tools.route, target, &shard.recorded[index], bound, output);
        add_parts(metrics, &parts);
        grads.push(grad);
    }
    let of = |part: &dyn Fn(&AgentOutput) -> Vec<f32>| grads.iter().flat_map(part).collect::<Vec<f32>>();
    let loss = (seeded(&initial.residual, of(&|g| g.residual.as_flattened().to_vec()))?
        + seeded(&initial.log_scale, of(&|g| g.log_scale.as_flattened().to_vec()))?)?;
    let loss = (loss + seeded(&initial.score, of(&|g| g.score.to_vec()))?)?;
    let loss = (loss + seeded(&initial.stays, of(&|g| vec![g.stays]))?)?;
    Ok((loss, initial))
}

fn add_parts(metrics: &mut Metrics, parts: &InitialParts) {
    metrics.add("loss", parts.total);
    metrics.add("min", parts.min_ade);
    metrics.add("first", parts.first_ade);
    metrics.add("score", parts.score_nll);
    metrics.add("stays", parts.stays_bce);
    metrics.add("scale", parts.scale_nll);
}

fn outputs(initial: &Initial) -> Result<Vec<AgentOutput>> {
    let (residual, log_scale) = (arrays(&initial.residual)?, arrays(&initial.log_scale)?);
    let score = initial.score.flatten_all()?.to_vec1::<f32>()?;
    let stays = initial.stays.to_vec1::<f32>()?;
    let score = score.as_chunks::<MODES>().0;
    Ok((0..residual.len())
        .map(|i| AgentOutput {
            residual: residual[i],
            log_scale: log_scale[i],
            score: score[i],
            stays: stays[i],
        })
        .collect())
}

fn denoiser(
    expert: &Expert,
    tools: &Tools,
    shard: &Shard,
    context: &Context,
    rng: &mut Stream,
    metrics: &mut Metrics,
) -> std::result::Result<Tensor, TrainError> {
    let prepared = expert.refiner.prepare(context)?;
    let count = shard.records.len();
    // Half of the levels are those of refinement.
    let levels: Vec<usize> = (0..count)
        .map(|_| {
            let top = if rng.chance(0.5) { schedule::START } else { schedule::LEVELS };
            1 + rng.below(top)
        })
        .collect();
    let device = expert.device();
    let clean = tensor(&shard.recorded, device)?;
    let noisy =
        expert.refiner.add_noise(&prepared, &clean, &tensor(&noise(rng, count, 1.0), device)?, &levels)?;
    let obstacles = ShardObstacles::new(shard).as_recorded();
    let inputs = StepInputs::at(expert, tools, shard, &obstacles, &arrays(&noisy)?)?;
    let denoised = expert.refiner.denoise(&prepared, &noisy, &inputs.borrowed(), &levels)?;
    let mut grads = Vec::with_capacity(count);
    for (index, refined) in arrays(&denoised)?.iter().enumerate() {
        let (target, recorded) = (&shard.records[index].target, &shard.recorded[index]);
        let weight = loss::speed_weight(target);
        let shares = shares(recorded);
        let mut grad = [[0.0; RESIDUAL]; MODES];
        let mut total = 0.0;
        for mode in 0..MODES {
            let (loss, slope) = loss::denoised(&tools.route, target, mode, &recorded[mode], &refined[mode]);
            total += weight * shares[mode] * loss;
            grad[mode] = slope.map(|s| weight * shares[mode] * s);
        }
        let best = loss::least(&shares.map(|share| -share));
        metrics.add("loss", total);
        metrics.add("ade", loss::distance(&tools.route, target, best, &refined[best]).0);
        grads.push(grad);
    }
    Ok(seeded_modes(&denoised, &grads)?)
}

/// Weight of each mode's recorded residual: an anchor far from the recording would need residuals that no
/// draft has. The weights sum to 1.
fn shares(recorded: &Modes) -> [f32; MODES] {
    let size = recorded.map(|r| (r.iter().map(|x| x * x).sum::<f32>() / RESIDUAL as f32).sqrt());
    let least = size[loss::least(&size)];
    let share = size.map(|size| (-4.0 * (size - least)).exp());
    let total: f32 = share.iter().sum();
    share.map(|share| share / total)
}

fn joint(
    expert: &Expert,
    tools: &Tools,
    shard: &Shard,
    context: &Context,
    initial: &Initial,
    rng: &mut Stream,
    metrics: &mut Metrics,
) -> std::result::Result<Tensor, TrainError> {
    let prepared = expert.refiner.prepare(context)?;
    let mut drafts = arrays(&initial.residual)?;
    for (record, draft) in shard.records.iter().zip(&mut drafts) {
        take_by_surprise(&tools.route, record, draft, rng);
    }
    // Most road users follow one of their drafts, as in a joint draw; the others move as recorded.
    let leading: Vec<Option<usize>> =
        outputs(initial)?.iter().map(|output| rng.chance(0.8).then(|| drawn(output, rng))).collect();
    let scale = [0.0, rng.unit() as f32, 1.0][rng.below(3)];
    let start = if rng.chance(0.2) { 0 } else { schedule::START };
    let obstacles = ShardObstacles::new(shard);
    let walk = Walk { expert, tools, shard, obstacles: &obstacles, leading, prepared: prepared.detach() };
    // Usually, a single step does everything.
    let steps = schedule::ddim(start, if rng.chance(0.6) { 1 } else { schedule::STEPS });
    let taken = rng.below(steps.len());
    let before = walk.go(
        &tensor(&drafts, expert.device())?,
        start,
        &steps[..taken],
        &noise(rng, shard.records.len(), scale),
    )?;
    let levels = vec![steps[taken].0; shard.records.len()];
    let inputs = walk.inputs(&arrays(&before)?)?;
    let refined = expert.refiner.denoise(&prepared, &before, &inputs.borrowed(), &levels)?;
    let refined_modes = arrays(&refined)?;
    // Each is compared with the others' positions after the step: all have seen the same drafts.
    let others = walk.others(&refined_modes);
    let mut grads = Vec::with_capacity(shard.records.len());
    for (index, refined) in refined_modes.iter().enumerate() {
        let (record, draft) = (&shard.records[index], &drafts[index]);
        grads.push(joint_gradient(tools, record, &others[index], draft, refined, metrics));
    }
    Ok(seeded_modes(&refined, &grads)?)
}

/// A mode drawn by the initializer's probabilities.
fn drawn(output: &AgentOutput, rng: &mut Stream) -> usize {
    mode_at(&loss::softmax(&output.score).map(f64::from), rng.unit())
}

/// In half of the records, one mode gets a speed change that the initializer would not give. The generator
/// makes such futures if two coincide, and refinement must keep them different.
fn take_by_surprise(route: &ResidualBasis, record: &Record, draft: &mut Modes, rng: &mut Stream) {
    let [takes, mode, rate, until] = std::array::from_fn(|_| rng.unit());
    if takes < 0.5 {
        return;
    }
    let mode = (mode * MODES as f64) as usize;
    let base = &record.target.base_along[mode];
    let speed_mps = f64::from(base[0]) / INSTANT_S;
    let rate = (2.0 * rate - 1.0) * (0.3 + 0.15 * speed_mps);
    let until = (1.0 + until * (KNOTS - 1) as f64) as usize;
    let mut changed = draft[mode];
    for (row, knot) in record.agent.tangent[0].iter().zip(&mut changed) {
        *knot += rate as f32 / ALONG_SCALE * row[..until].iter().sum::<f32>();
    }
    let along = route.coordinates(base, &changed);
    if along.windows(2).all(|pair| pair[0][0] <= pair[1][0]) {
        draft[mode] = changed;
    }
}

/// The best mode is pulled to the recording, the others to their drafts, all away from overlaps.
fn joint_gradient(
    tools: &Tools,
    record: &Record,
    obstacles: &[Obstacle],
    draft: &Modes,
    refined: &Modes,
    metrics: &mut Metrics,
) -> Modes {
    let weight = loss::speed_weight(&record.target);
    let route = &tools.route;
    let winner = loss::least(&std::array::from_fn::<f32, MODES, _>(|mode| {
        loss::distance(route, &record.target, mode, &draft[mode]).0
    }));
    let mut grads = [[0.0; RESIDUAL]; MODES];
    let (mut total, mut penalties) = (0.0, 0.0);
    for mode in 0..MODES {
        let (pull, (near, slope)) = if mode == winner {
            (1.0, loss::distance(route, &record.target, mode, &refined[mode]))
        } else {
            (STAY / (MODES - 1) as f32, loss::moved(route, &draft[mode], &refined[mode]))
        };
        if mode == winner {
            metrics.add("refined", near);
        }
        let (overlap, repulsion) = penalty(tools, record, mode, &refined[mode], obstacles);
        let overlap_slope = loss::to_knots(route, &repulsion);
        let share = PENALTY / MODES as f32;
        penalties += overlap / MODES as f32;
        total += weight * pull * near + share * overlap;
        for i in 0..RESIDUAL {
            grads[mode][i] = weight * pull * slope[i] + share * overlap_slope[i];
        }
    }
    metrics.add("loss", total);
    metrics.add("penalty", penalties);
    grads
}

/// Refinement steps without backpropagation.
struct Walk<'a> {
    expert: &'a Expert,
    tools: &'a Tools,
    shard: &'a Shard,
    obstacles: &'a ShardObstacles,
    /// The leading mode of each record; nothing for one that moves as recorded.
    leading: Vec<Option<usize>>,
    prepared: Prepared,
}

impl Walk<'_> {
    /// The obstacles if the records move along these drafts.
    fn others(&self, drafts: &[Modes]) -> Vec<Vec<Obstacle>> {
        self.obstacles.along(&self.tools.route, self.shard, &self.leading, drafts)
    }

    fn inputs(&self, drafts: &[Modes]) -> Result<StepInputs> {
        StepInputs::at(self.expert, self.tools, self.shard, &self.others(drafts), drafts)
    }

    fn go(&self, drafts: &Tensor, start: usize, steps: &[(usize, usize)], noise: &[Modes]) -> Result<Tensor> {
        let (refiner, device) = (&self.expert.refiner, self.expert.device());
        let levels = vec![start; self.shard.records.len()];
        let mut residual =
            refiner.add_noise(&self.prepared, drafts, &tensor(noise, device)?, &levels)?.detach();
        for &step in steps {
            let inputs = self.inputs(&arrays(&residual)?)?;
            residual = refiner.step(&self.prepared, &residual, &inputs.borrowed(), step, None)?.detach();
        }
        Ok(residual)
    }
}

/// Metrics on held-out records: those of the initializer and, unless only it is trained, those of five
/// refinement steps from its drafts with full noise.
pub(super) fn validate(
    expert: &Expert,
    tools: &Tools,
    shard: &Shard,
    stage: Stage,
    rng: &mut Stream,
) -> std::result::Result<Metrics, TrainError> {
    let context = context(expert, shard)?;
    let mut metrics = Metrics::new(shard.records.len());
    let (_, initial) = initializer(expert, tools, shard, &context, &mut metrics)?;
    if stage == Stage::Initializer {
        return Ok(metrics);
    }
    let prepared = expert.refiner.prepare(&context)?.detach();
    let leading = outputs(&initial)?.iter().map(|output| Some(drawn(output, rng))).collect();
    let obstacles = ShardObstacles::new(shard);
    let walk = Walk { expert, tools, shard, obstacles: &obstacles, leading, prepared };
    let drafts = initial.residual.detach();
    let steps = schedule::ddim(schedule::START, 1);
    let noise = noise(rng, shard.records.len(), 1.0);
    let refined = arrays(&walk.go(&drafts, schedule::START, &steps, &noise)?)?;
    let drafts = arrays(&drafts)?;
    let (before, after) = (walk.others(&drafts), walk.others(&refined));
    for (index, draft) in drafts.iter().enumerate() {
        let record = &shard.records[index];
        let ade =
            |modes: &Modes, mode: usize| loss::distance(&tools.route, &record.target, mode, &modes[mode]).0;
        let min = (0..MODES).map(|mode| ade(&refined[index], mode)).fold(f32::INFINITY, f32::min);
        metrics.add("refined", min);
        let leads = walk.leading[index].unwrap_or(0);
        for (name, modes, others) in [("overlap", draft, &before), ("overlap'", &refined[index], &after)] {
            let draft = DraftPoses::of(&tools.route, record, leads, &modes[leads]);
            let found = energy(record, &draft, &others[index], Growth::Linear).0;
            metrics.add(name, f32::from(u8::from(found > 0.3 * 0.5)));
        }
    }
    Ok(metrics)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::toy;
    use scene::random::Key;

    #[test]
    fn a_surprise_changes_the_pace_of_one_mode_and_keeps_the_goal() {
        let route = ResidualBasis::new();
        let mut rng = Key::default().number(5).stream();
        let (mut changed, mut calls) = (0, 0);
        for (.., records) in toy::scenes(12, 5, 3) {
            for record in &records {
                let drafts = [[0.0; RESIDUAL]; MODES];
                let mut taken = drafts;
                take_by_surprise(&route, record, &mut taken, &mut rng);
                calls += 1;
                let modes: Vec<usize> = (0..MODES).filter(|mode| taken[*mode] != drafts[*mode]).collect();
                assert!(modes.len() <= 1);
                let Some(&mode) = modes.first() else { continue };
                changed += 1;
                assert!(taken[mode][KNOTS..] == drafts[mode][KNOTS..], "across");
                let along = route.coordinates(&record.target.base_along[mode], &taken[mode]);
                assert!(along.windows(2).all(|pair| pair[0][0] <= pair[1][0]), "backwards");
                // Nothing remains to be removed by a fixed goal's projection.
                for (row, knot) in record.agent.tangent[0].iter().zip(&taken[mode]) {
                    let kept: f32 = row.iter().zip(&taken[mode]).map(|(p, r)| p * r).sum();
                    assert!((kept - knot).abs() < 1e-4, "{kept} {knot}");
                }
            }
        }
        assert!((calls / 8..calls * 3 / 4).contains(&changed), "{changed} of {calls}");
    }
}
