//! Multi-context gating over what a road user sees, then over six learned queries (Varadarajan et al.,
//! "MultiPath++", 2021), to points and scores.

use candle_core::{Device, Result, Tensor};
use experts::features::{AgentFeatures, NEIGHBOUR, NEIGHBOURS, OWN};
use experts::net::inputs::{Inputs, NO};
use experts::net::layers::{Linear, Mlp, Norm, RELU_GAIN};
use experts::net::{Architecture, Gating, Init, NetError, Params};
use experts::planning::{INSTANT_S, INSTANTS, MODES};

use crate::polylines::{PIECE, PIECE_POSE, PIECES, SeenPiece};

/// Numbers of a future: x and y at the instants.
pub(super) const NUMBERS: usize = 2 * INSTANTS;
/// Gating blocks over the six queries.
const QUERY_BLOCKS: usize = 3;
/// Width of a map piece's encoding.
const PIECE_WIDTH: usize = 64;
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

/// Map pieces that a batch sees, padded.
struct Lines {
    /// [batch * PIECES], rows of the encoded map; 0 at padding.
    piece: Tensor,
    /// [batch * PIECES, PIECE_POSE]
    pose: Tensor,
    /// [batch, PIECES], 0 or -1e4 at padding.
    mask: Tensor,
}

impl Lines {
    fn stack(seen: &[&[SeenPiece]], device: &Device) -> Result<Self> {
        let batch = seen.len();
        let mut piece = vec![0u32; batch * PIECES];
        let mut pose = vec![[0f32; PIECE_POSE]; batch * PIECES];
        let mut mask = vec![NO; batch * PIECES];
        for (at, seen) in seen.iter().enumerate() {
            for (slot, seen) in (at * PIECES..).zip(seen.iter().take(PIECES)) {
                (piece[slot], pose[slot], mask[slot]) = (seen.piece as u32, seen.pose, 0.0);
            }
        }
        Ok(Self {
            piece: Tensor::from_vec(piece, batch * PIECES, device)?,
            pose: Tensor::from_slice(pose.as_flattened(), (batch * PIECES, PIECE_POSE), device)?,
            mask: Tensor::from_vec(mask, (batch, PIECES), device)?,
        })
    }
}

/// Features to futures.
pub(super) struct Regressor {
    map: Mlp,
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
            map: Mlp::new(p, "map", [PIECE, PIECE_WIDTH, PIECE_WIDTH], RELU_GAIN)?.relu(),
            own: Mlp::new(p, "context.own", [OWN, d, d], RELU_GAIN)?.relu(),
            piece: Mlp::new(p, "context.piece", [PIECE_WIDTH + PIECE_POSE, d, d], RELU_GAIN)?.relu(),
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

    /// Reads a batch: features of road users, which map pieces each sees, and the pieces.
    pub(super) fn see(
        &self,
        map: &[[f32; PIECE]],
        seen: &[&[SeenPiece]],
        agents: &[&AgentFeatures],
    ) -> Result<Seen> {
        let device = self.queries.device();
        // One row of zeros for a map without pieces.
        let none = [[0.0; PIECE]];
        let map = if map.is_empty() { &none } else { map };
        let map = Tensor::from_slice(map.as_flattened(), (map.len(), PIECE), device)?;
        let map = self.map.forward(&map)?;
        let inputs = Inputs::stack(agents, device)?;
        let lines = Lines::stack(seen, device)?;
        let mask = Tensor::cat(&[&lines.mask, &inputs.mask.narrow(1, 0, NEIGHBOURS)?], 1)?;
        let own = self.own.forward(&inputs.own)?;
        let lines = Tensor::cat(&[&map.index_select(&lines.piece, 0)?, &lines.pose], 1)?;
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
        let output = self.head.forward(&Tensor::cat(&[&modes, &context], 2)?)?;
        Ok(Regressed {
            points: output.narrow(2, 0, NUMBERS)?.contiguous()?.broadcast_mul(&self.spread)?,
            score: output.narrow(2, NUMBERS, 1)?.contiguous()?.reshape((batch, MODES))?,
        })
    }
}
