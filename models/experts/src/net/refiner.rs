//! The conditional diffusion model that makes drafts coherent (the paper, section III-C).
//!
//! Besides the draft itself, each step sees the descent direction of the overlap energy at that draft, and
//! applies a learned share of it. If the architecture has pairs of attention, it also attends to the draft's
//! encounters: the drafts, at that step, of agents that it meets. It then attends to the context's tokens,
//! which hold the conditions of the agent and of its neighbours. The shipped weights have none: see their
//! card.

use candle_core::{Result, Tensor};

use super::architecture::Architecture;
use super::encoder::Context;
use super::error::NetError;
use super::inputs::EncounterTensors;
use super::layers::{CrossBlock, Linear, Mlp, MlpBlock, Norm, RELU_GAIN};
use super::params::Params;
use super::{ops, schedule, smooth};
use crate::features::encounters::ENCOUNTER;
use crate::planning::{MODES, RESIDUAL};

/// Numbers that encode the noise level.
const LEVEL: usize = 8;
/// Spread of a correction for an output of 1 of the last layer.
const SPREAD: f64 = 1.5;

/// Values that every step of a call needs, computed once.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Anchors and context, [batch, MODES, width].
    base: Tensor,
    tangent: Tensor,
    /// Tokens of the context [batch, 1 + TOKENS, width], and their additive mask.
    tokens: Tensor,
    mask: Tensor,
}

impl Prepared {
    /// The same values without their graph, so that no gradient flows back through them.
    pub fn detach(&self) -> Self {
        let (base, tokens) = (self.base.detach(), self.tokens.detach());
        Self { base, tokens, tangent: self.tangent.clone(), mask: self.mask.clone() }
    }
}

/// A pair of attention blocks: of each draft to its encounters, then of all drafts of an agent to its
/// context.
#[derive(Clone, Debug)]
struct AttentionPair {
    encounters: CrossBlock,
    context: CrossBlock,
}

/// A refiner's inputs about drafts at a step.
pub struct DraftInputs<'a> {
    /// The descent direction of the overlap energy, [batch, MODES, RESIDUAL], from
    /// [`Pullback::downhill`](crate::planning::pullback::Pullback::downhill).
    pub push: &'a Tensor,
    /// Encounters of the drafts, for a refiner with attention.
    pub encounters: Option<&'a EncounterTensors>,
}

/// Denoises residuals, given their encounters, their anchors and the context.
#[derive(Clone, Debug)]
pub struct Refiner {
    draft: Linear,
    anchor: Linear,
    context: Linear,
    /// Absent without pairs of attention.
    encounter: Option<Mlp>,
    pairs: Vec<AttentionPair>,
    /// Empty with pairs of attention.
    blocks: Vec<MlpBlock>,
    norm: Norm,
    head: Mlp,
    smooth: Tensor,
    noise_scale: f64,
}

impl Refiner {
    /// Builds the refiner.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(p: &mut Params, a: &Architecture) -> std::result::Result<Self, NetError> {
        let d = a.width;
        let plain_blocks = if a.refiner_attention == 0 { a.refiner_blocks } else { 0 };
        let blocks = (0..plain_blocks)
            .map(|block| MlpBlock::new(p, &format!("refiner.blocks.{block}.mlp"), d))
            .collect::<std::result::Result<_, _>>()?;
        let pairs = (0..a.refiner_attention)
            .map(|pair| {
                let mut block =
                    |part: &str| CrossBlock::new(p, &format!("refiner.pairs.{pair}.{part}"), d, a.heads);
                Ok(AttentionPair { encounters: block("encounters")?, context: block("context")? })
            })
            .collect::<std::result::Result<_, NetError>>()?;
        let sizes = [ENCOUNTER, d / 2, d];
        let encounter = (a.refiner_attention > 0)
            .then(|| Mlp::new(p, "refiner.encounter", sizes, RELU_GAIN).map(Mlp::relu))
            .transpose()?;
        let draft = Linear::new(p, "refiner.draft", 2 * RESIDUAL + LEVEL, d, RELU_GAIN)?;
        let head = Mlp::new(p, "refiner.head", [d, d, RESIDUAL + 2], 0.02)?;
        let norm = Norm::new(p, "refiner.norm", d)?;
        Ok(Self {
            draft,
            anchor: Linear::new(p, "refiner.anchor", 2 * d, d, 1.0)?,
            context: Linear::new(p, "refiner.context", d, d, 1.0)?,
            encounter,
            pairs,
            blocks,
            norm,
            head,
            smooth: smooth::matrix(p.device())?,
            noise_scale: f64::from(a.noise_percent) / 100.0,
        })
    }

    /// Values that are constant over the steps.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn prepare(&self, context: &Context) -> Result<Prepared> {
        let anchors = Tensor::cat(&[&context.anchors, &context.plain_anchors], 2)?;
        let known = self.context.forward(&context.vector)?.unsqueeze(1)?;
        Ok(Prepared {
            base: self.anchor.forward(&anchors)?.broadcast_add(&known)?,
            tangent: context.tangent.clone(),
            tokens: context.tokens.clone(),
            mask: context.mask.clone(),
        })
    }

    /// Residuals [batch, MODES, RESIDUAL] with noise of `levels`, one per road user. `noise` holds standard
    /// normal numbers of the same shape; they are smoothed and made tangent to the goal here.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn add_noise(
        &self,
        prepared: &Prepared,
        residual: &Tensor,
        noise: &Tensor,
        levels: &[usize],
    ) -> Result<Tensor> {
        let noise = self.shape_noise(prepared, noise)?;
        let kept = shares(levels, schedule::signal, residual)?;
        let added = shares(levels, |level| 1.0 - schedule::signal(level), residual)?;
        residual.broadcast_mul(&kept)? + noise.broadcast_mul(&added)?
    }

    fn shape_noise(&self, prepared: &Prepared, noise: &Tensor) -> Result<Tensor> {
        ops::project(&(self.smoothed(noise)? * self.noise_scale)?, &prepared.tangent)
    }

    fn smoothed(&self, z: &Tensor) -> Result<Tensor> {
        let dims = z.dims3()?;
        z.contiguous()?.reshape((dims.0 * dims.1, RESIDUAL))?.matmul(&self.smooth)?.reshape(dims)
    }

    /// The denoised residual (x0 form) [batch, MODES, RESIDUAL]. `residual`, of the same shape, has noise of
    /// `levels` (one per agent); `inputs` belong to it.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn denoise(
        &self,
        prepared: &Prepared,
        residual: &Tensor,
        inputs: &DraftInputs<'_>,
        levels: &[usize],
    ) -> Result<Tensor> {
        let DraftInputs { push, encounters } = inputs;
        let (batch, modes, _) = residual.dims3()?;
        if levels.len() != batch || modes != MODES {
            candle_core::bail!("{} levels for residuals {:?}", levels.len(), residual.shape());
        }
        let device = residual.device();
        let times: Vec<f32> =
            levels.iter().flat_map(|&level| std::iter::repeat_n(embed(level), modes)).flatten().collect();
        let times = Tensor::from_vec(times, (batch, modes, LEVEL), device)?;
        let mut x = (self.draft.forward(&Tensor::cat(&[residual, *push, &times], 2)?)? + &prepared.base)?;
        if let Some(encounter) = &self.encounter {
            let Some(encounters) = encounters else {
                candle_core::bail!("a refiner that attends has no encounters")
            };
            let (met, width) = (encounter.forward(&encounters.numbers)?, x.dim(2)?);
            for pair in &self.pairs {
                let alone = x.reshape((batch * modes, 1, width))?;
                let alone = pair.encounters.forward(&alone, &met, &encounters.mask)?;
                let together = alone.reshape((batch, modes, width))?;
                x = pair.context.forward(&together, &prepared.tokens, &prepared.mask)?;
            }
        }
        for block in &self.blocks {
            x = block.forward(&x)?;
        }
        let said = self.head.forward(&self.norm.forward(&x)?)?;
        let correction = (self.smoothed(&said.narrow(2, 0, RESIDUAL)?)? * SPREAD)?;
        let taken = (gates(&said.narrow(2, RESIDUAL, 2)?.contiguous()?)? * *push)?;
        let kept = residual.broadcast_mul(&shares(levels, skip, residual)?)?;
        ops::project(&((kept + correction)? + taken)?, &prepared.tangent)
    }

    /// One DDIM step from level `t` to `t_next`; with `noise` (standard normal) it is random.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn step(
        &self,
        prepared: &Prepared,
        residual: &Tensor,
        inputs: &DraftInputs<'_>,
        (t, t_next): (usize, usize),
        noise: Option<&Tensor>,
    ) -> Result<Tensor> {
        let denoised = self.denoise(prepared, residual, inputs, &vec![t; residual.dim(0)?])?;
        let step = schedule::step(t, t_next, if noise.is_some() { 1.0 } else { 0.0 });
        let next = ((denoised * step.denoised)? + (residual * step.residual)?)?;
        match noise {
            Some(noise) => next + (self.shape_noise(prepared, noise)? * step.noise)?,
            None => Ok(next),
        }
    }
}

/// Power of the skip connection. Without noise a draft passes unchanged, so that steps without a push do not
/// wear it down; towards pure noise it counts less and less.
fn skip(level: usize) -> f64 {
    let signal = schedule::signal(level);
    signal / signal.max(0.5).powi(2)
}

/// Square roots of shares of power as [batch, 1, 1].
fn shares(levels: &[usize], power: impl Fn(usize) -> f64, like: &Tensor) -> Result<Tensor> {
    let values: Vec<f32> = levels.iter().map(|&level| power(level).sqrt() as f32).collect();
    Tensor::from_vec(values, (levels.len(), 1, 1), like.device())
}

/// Shares of the push for the two halves of a residual: softplus of [.., 2], each repeated.
fn gates(said: &Tensor) -> Result<Tensor> {
    let (batch, modes, _) = said.dims3()?;
    // softplus(x) = relu(x) + log(1 + exp(-|x|)), which cannot overflow.
    let soft = (said.relu()? + (said.abs()?.neg()?.exp()? + 1.0)?.log()?)?;
    soft.reshape((batch, modes, 2, 1))?
        .broadcast_as((batch, modes, 2, RESIDUAL / 2))?
        .contiguous()?
        .reshape((batch, modes, RESIDUAL))
}

fn embed(level: usize) -> [f32; LEVEL] {
    std::array::from_fn(|i| {
        let angle = (1 << (i / 2)) as f64 * std::f64::consts::PI * level as f64 / schedule::LEVELS as f64;
        (if i % 2 == 0 { angle.sin() } else { angle.cos() }) as f32
    })
}
