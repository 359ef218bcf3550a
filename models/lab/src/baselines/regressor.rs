//! Multi-context gating over what a road user sees, then over six learned queries (Varadarajan et al.,
//! "MultiPath++", 2021), to points and scores.

use candle_core::{Result, Tensor};
use experts::features::{
    AgentFeatures, INSTANT_S, INSTANTS, MODES, NEIGHBOUR, NEIGHBOURS, OWN, PIECE, PIECE_POSE, PIECES,
};
use experts::net::inputs::{Inputs, pieces};
use experts::net::layers::{Linear, Mlp, Norm, RELU_GAIN};
use experts::net::{Architecture, Gating, Init, MapEncoder, NetError, Params};

/// Numbers of a future: x and y at the instants.
pub(super) const NUMBERS: usize = 2 * INSTANTS;
/// Gating blocks over the six queries.
const QUERY_BLOCKS: usize = 3;
/// A coordinate grows with time by this when the last layer says 1, m/s.
const SPREAD_MPS: f64 = 8.0;

/// What a batch of road users sees.
pub(super) struct Seen {
    /// [batch, width]
    pub(super) vector: Tensor,
    /// [batch, 1 + PIECES + NEIGHBOURS, width]: the vector, map pieces, neighbours.
    pub(super) tokens: Tensor,
    /// Additive mask of the tokens.
    pub(super) mask: Tensor,
}

/// Six futures of a batch.
pub(super) struct Regressed {
    /// Metres in the road user's frame, [batch, MODES, NUMBERS].
    pub(super) points: Tensor,
    /// [batch, MODES]; the softmax is the probability.
    pub(super) score: Tensor,
}

/// Features to futures.
pub(super) struct Regressor {
    map: MapEncoder,
    own: Mlp,
    piece: Mlp,
    neighbour: Mlp,
    gating: Gating,
    mix: Mlp,
    context_norm: Norm,
    queries: Tensor,
    known: Linear,
    query_gating: Gating,
    head: Mlp,
    /// Metres of one number, [NUMBERS].
    spread: Tensor,
}

impl Regressor {
    pub(super) fn new(p: &mut Params, a: &Architecture) -> std::result::Result<Self, NetError> {
        let d = a.width;
        let spread: Vec<f32> =
            (0..NUMBERS).map(|i| (SPREAD_MPS * INSTANT_S * (i / 2 + 1) as f64) as f32).collect();
        Ok(Self {
            map: MapEncoder::new(p, a)?,
            own: Mlp::new(p, "context.own", [OWN, d, d], RELU_GAIN)?.relu(),
            piece: Mlp::new(p, "context.piece", [a.piece_width + PIECE_POSE, d, d], RELU_GAIN)?.relu(),
            neighbour: Mlp::new(p, "context.neighbour", [NEIGHBOUR, d, d], RELU_GAIN)?.relu(),
            gating: Gating::new(p, "context", (a.gating_blocks, d), &[PIECES, NEIGHBOURS])?,
            mix: Mlp::new(p, "context.mix", [2 * d, d, d], 1.0)?,
            context_norm: Norm::new(p, "context.norm", d)?,
            queries: p.get("initializer.queries", &[MODES, d], Init::Normal(0.5))?,
            known: Linear::new(p, "initializer.known", d, d, 1.0)?,
            query_gating: Gating::new(p, "initializer", (QUERY_BLOCKS, d), &[MODES])?,
            head: Mlp::new(p, "initializer.head", [2 * d, 2 * d, NUMBERS + 1], 0.2)?,
            spread: Tensor::from_vec(spread, NUMBERS, p.device())?,
        })
    }

    /// Reads a batch; `map` are the pieces that its features speak of.
    pub(super) fn see(&self, map: &[[f32; PIECE]], agents: &[&AgentFeatures]) -> Result<Seen> {
        let device = self.queries.device();
        let map = self.map.forward(&pieces(map, device)?)?;
        let inputs = Inputs::stack(agents, map.dim(0)?, device)?;
        let mask = inputs.mask.narrow(1, 0, PIECES + NEIGHBOURS)?.contiguous()?;
        let own = self.own.forward(&inputs.own)?;
        let lines = Tensor::cat(&[&map.index_select(&inputs.piece, 0)?, &inputs.pose], 1)?;
        let lines = self.piece.forward(&lines)?.reshape((agents.len(), PIECES, ()))?;
        let tokens = Tensor::cat(&[&lines, &self.neighbour.forward(&inputs.neighbours)?], 1)?;
        let (context, tokens) = self.gating.forward(&own, tokens, &mask)?;
        let vector = self.context_norm.forward(&self.mix.forward(&Tensor::cat(&[&own, &context], 1)?)?)?;
        let seen_by_all = Tensor::zeros((agents.len(), 1), mask.dtype(), device)?;
        Ok(Seen {
            tokens: Tensor::cat(&[&vector.unsqueeze(1)?, &tokens], 1)?,
            mask: Tensor::cat(&[&seen_by_all, &mask], 1)?,
            vector,
        })
    }

    /// Six futures.
    pub(super) fn forward(&self, seen: &Seen) -> Result<Regressed> {
        let (batch, width) = seen.vector.dims2()?;
        let known = self.known.forward(&seen.vector)?.unsqueeze(1)?;
        let queries = known.broadcast_add(&self.queries)?;
        let all = Tensor::zeros((batch, MODES), queries.dtype(), queries.device())?;
        let (context, modes) = self.query_gating.forward(&seen.vector, queries, &all)?;
        let context = context.unsqueeze(1)?.broadcast_as((batch, MODES, width))?.contiguous()?;
        let said = self.head.forward(&Tensor::cat(&[&modes, &context], 2)?)?;
        Ok(Regressed {
            points: said.narrow(2, 0, NUMBERS)?.contiguous()?.broadcast_mul(&self.spread)?,
            score: said.narrow(2, NUMBERS, 1)?.contiguous()?.reshape((batch, MODES))?,
        })
    }
}
