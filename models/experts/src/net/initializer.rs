//! The first six futures.

use candle_core::{D, Result, Tensor};

use super::architecture::Architecture;
use super::encoder::Context;
use super::error::NetError;
use super::layers::{CrossBlock, Linear, Mlp, Norm, RELU_GAIN};
use super::ops;
use super::params::{Init, Params};
use super::smooth;
use crate::planning::{MODES, RESIDUAL};

/// Spread of a residual for an output of 1 of the last layer.
const SPREAD: f64 = 1.5;

/// The initializer's tensors.
#[derive(Clone, Debug)]
pub struct Initial {
    /// Normalised residuals [batch, MODES, RESIDUAL], tangent to the goal.
    pub residual: Tensor,
    /// Logarithm of the scale of each number of a residual, [batch, MODES, RESIDUAL].
    pub log_scale: Tensor,
    /// Scores of the modes [batch, MODES]; their softmax is the probability.
    pub score: Tensor,
    /// Score of standing still [batch]; its sigmoid is the probability.
    pub stays: Tensor,
}

impl Initial {
    /// Logarithms of the modes' probabilities [batch, MODES].
    ///
    /// # Errors
    /// When memory cannot be allocated.
    pub fn log_prob(&self) -> Result<Tensor> {
        candle_nn::ops::log_softmax(&self.score, D::Minus1)
    }
}

/// Six learned queries, gated by the context and by their anchors.
#[derive(Clone, Debug)]
pub struct Initializer {
    queries: Tensor,
    anchor: Linear,
    context: Linear,
    block: CrossBlock,
    token: Linear,
    gate: Linear,
    pooled: Linear,
    norm: Norm,
    head: Mlp,
    stays: Mlp,
    smooth: Tensor,
}

impl Initializer {
    /// Builds the initializer.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(p: &mut Params, a: &Architecture) -> std::result::Result<Self, NetError> {
        let d = a.width;
        let queries = p.get("initializer.queries", &[MODES, d], Init::Normal(0.5))?;
        Ok(Self {
            smooth: smooth::matrix(queries.device())?,
            queries,
            anchor: Linear::new(p, "initializer.anchor", 2 * d, d, 1.0)?,
            context: Linear::new(p, "initializer.context", d, d, 1.0)?,
            block: CrossBlock::new(p, "initializer.block", d, a.heads)?,
            token: Linear::new(p, "initializer.token", d, d, RELU_GAIN)?.relu(),
            gate: Linear::new(p, "initializer.gate", d, d, 0.5)?,
            pooled: Linear::new(p, "initializer.pooled", 2 * d, d, RELU_GAIN)?.relu(),
            norm: Norm::new(p, "initializer.norm", d)?,
            head: Mlp::new(p, "initializer.head", [2 * d, 2 * d, 2 * RESIDUAL + 1], 0.2)?,
            stays: Mlp::new(p, "initializer.stays", [d, d / 2, 1], 0.3)?,
        })
    }

    /// Residuals, scales and scores of a batch.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn forward(&self, context: &Context) -> Result<Initial> {
        let (batch, modes, width) = context.anchors.dims3()?;
        let anchors = Tensor::cat(&[&context.anchors, &context.plain_anchors], 2)?;
        let known = self.context.forward(&context.vector)?.unsqueeze(1)?;
        let x = self.anchor.forward(&anchors)?.broadcast_add(&self.queries)?.broadcast_add(&known)?;
        let x = self.block.forward(&x, &context.tokens, &context.mask)?;
        // The modes exchange information by gating: the context is the gate, and the maximum over modes
        // updates it.
        let gate = (candle_nn::ops::sigmoid(&self.gate.forward(&context.vector)?)? * 2.0)?;
        let x = self.norm.forward(&ops::gate_mix(&x, &self.token.forward(&x)?, &gate, 0.5)?)?;
        let none = Tensor::zeros((batch, modes), x.dtype(), x.device())?;
        let best = ops::segment_max(&x, &none, &[modes])?;
        let shared = self.pooled.forward(&Tensor::cat(&[&context.vector, &best], 1)?)?;
        let shared = shared.unsqueeze(1)?.broadcast_as((batch, modes, width))?;
        let said = self.head.forward(&Tensor::cat(&[&x, &shared.contiguous()?], 2)?)?;
        let raw = (said.narrow(2, 0, RESIDUAL)?.contiguous()? * SPREAD)?;
        let raw = raw.reshape((batch * modes, RESIDUAL))?.matmul(&self.smooth)?;
        let residual = ops::project(&raw.reshape((batch, modes, RESIDUAL))?, &context.tangent)?;
        Ok(Initial {
            residual,
            log_scale: said.narrow(2, RESIDUAL, RESIDUAL)?.contiguous()?,
            score: said.narrow(2, 2 * RESIDUAL, 1)?.contiguous()?.reshape((batch, modes))?,
            stays: self.stays.forward(&context.vector)?.reshape(batch)?,
        })
    }
}
