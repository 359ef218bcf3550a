//! Encodes the inputs of a road user as one vector and a set of tokens (multi-context gating: Varadarajan et
//! al., "MultiPath++", 2021, section 3.2).

use candle_core::{Result, Tensor};

use super::architecture::Architecture;
use super::error::NetError;
use super::inputs::InputTensors;
use super::layers::{Linear, Mlp, Norm, RELU_GAIN};
use super::ops;
use super::params::Params;
use crate::features::{ANCHOR, NEIGHBOUR, NEIGHBOURS, OWN};
use crate::planning::MODES;

/// Input of the initializer and the refiner for a batch of road users.
#[derive(Clone, Debug)]
pub struct Context {
    /// Context vector [batch, width].
    pub vector: Tensor,
    /// Tokens [batch, 1 + TOKENS, width]: the context vector, neighbours, anchors.
    pub tokens: Tensor,
    /// Additive mask [batch, 1 + TOKENS].
    pub mask: Tensor,
    /// Anchor tokens after gating [batch, MODES, width].
    pub anchors: Tensor,
    /// Anchor tokens before gating [batch, MODES, width].
    pub plain_anchors: Tensor,
    /// Goal projections [batch, 2, KNOTS, KNOTS].
    pub tangent: Tensor,
}

impl Context {
    /// Number of road users.
    pub fn batch(&self) -> usize {
        self.vector.dims()[0]
    }
}

#[derive(Clone, Debug)]
struct GatingBlock {
    token: Linear,
    gate: Linear,
    pooled: Linear,
}

/// Multi-context gating: tokens gated by a context, which is updated by the maximum over each kind of token.
#[derive(Clone, Debug)]
pub struct Gating {
    blocks: Vec<GatingBlock>,
    kinds: Vec<usize>,
}

impl Gating {
    /// Gating blocks of a width for tokens of several kinds, with their counts, under the name `name.blocks`.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(
        p: &mut Params,
        name: &str,
        (blocks, width): (usize, usize),
        kinds: &[usize],
    ) -> std::result::Result<Self, NetError> {
        let d = width;
        let blocks = (0..blocks)
            .map(|block| {
                let name = |part: &str| format!("{name}.blocks.{block}.{part}");
                Ok(GatingBlock {
                    token: Linear::new(p, &name("token"), d, d, RELU_GAIN)?.relu(),
                    gate: Linear::new(p, &name("gate"), d, d, 0.5)?,
                    pooled: Linear::new(p, &name("pooled"), kinds.len() * d, d, RELU_GAIN)?.relu(),
                })
            })
            .collect::<std::result::Result<_, NetError>>()?;
        Ok(Self { blocks, kinds: kinds.to_vec() })
    }

    /// Context [batch, width] and tokens [batch, tokens, width] after all blocks; `mask` [batch, tokens] is
    /// 0, or -1e4 at padding.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn forward(&self, context: &Tensor, tokens: Tensor, mask: &Tensor) -> Result<(Tensor, Tensor)> {
        let (mut context, mut tokens) = (context.clone(), tokens);
        for (index, block) in self.blocks.iter().enumerate() {
            // Running means over the blocks so far, as in the paper.
            let keep = (index + 1) as f64 / (index + 2) as f64;
            let gate = (candle_nn::ops::sigmoid(&block.gate.forward(&context)?)? * 2.0)?;
            tokens = ops::gate_mix(&tokens, &block.token.forward(&tokens)?, &gate, keep)?;
            let pooled = ops::segment_max(&tokens, mask, &self.kinds)?;
            context = ((context * keep)? + (block.pooled.forward(&pooled)? * (1.0 - keep))?)?;
        }
        Ok((context, tokens))
    }
}

/// Embeds all tokens, then gates them.
#[derive(Clone, Debug)]
pub struct ContextEncoder {
    own: Mlp,
    neighbour: Mlp,
    anchor: Mlp,
    gating: Gating,
    mix: Mlp,
    context_norm: Norm,
    token_norm: Norm,
}

impl ContextEncoder {
    /// Builds the encoder.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(p: &mut Params, a: &Architecture) -> std::result::Result<Self, NetError> {
        let d = a.width;
        let kinds = [NEIGHBOURS, MODES];
        let gating = Gating::new(p, "context", (a.gating_blocks, d), &kinds)?;
        Ok(Self {
            own: Mlp::new(p, "context.own", [OWN, d, d], RELU_GAIN)?.relu(),
            neighbour: Mlp::new(p, "context.neighbour", [NEIGHBOUR, d, d], RELU_GAIN)?.relu(),
            anchor: Mlp::new(p, "context.anchor", [ANCHOR, d, d], RELU_GAIN)?.relu(),
            gating,
            mix: Mlp::new(p, "context.mix", [2 * d, d, d], 1.0)?,
            context_norm: Norm::new(p, "context.norm", d)?,
            token_norm: Norm::new(p, "context.token_norm", d)?,
        })
    }

    /// Encodes a batch.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn forward(&self, inputs: &InputTensors) -> Result<Context> {
        let batch = inputs.own.dim(0)?;
        let own = self.own.forward(&inputs.own)?;
        let plain_anchors = self.anchor.forward(&inputs.anchors)?;
        let tokens = Tensor::cat(&[&self.neighbour.forward(&inputs.neighbours)?, &plain_anchors], 1)?;
        let (context, tokens) = self.gating.forward(&own, tokens, &inputs.mask)?;
        let vector = self.context_norm.forward(&self.mix.forward(&Tensor::cat(&[&own, &context], 1)?)?)?;
        let tokens = self.token_norm.forward(&tokens)?;
        let anchors = tokens.narrow(1, NEIGHBOURS, MODES)?.contiguous()?;
        let seen_by_all = Tensor::zeros((batch, 1), inputs.mask.dtype(), inputs.mask.device())?;
        Ok(Context {
            tokens: Tensor::cat(&[&vector.unsqueeze(1)?, &tokens], 1)?,
            mask: Tensor::cat(&[&seen_by_all, &inputs.mask], 1)?,
            vector,
            anchors,
            plain_anchors,
            tangent: inputs.tangent.clone(),
        })
    }
}
