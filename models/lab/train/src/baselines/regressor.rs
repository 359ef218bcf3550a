//! From the visible surroundings of a road user over six learned queries (Varadarajan et al., "MultiPath++",
//! 2021) to points and scores.

use candle_core::{Result, Tensor};
use experts::net::layers::{Linear, Mlp};
use experts::net::{Gating, Init, NetError, Params};
use experts::planning::{INSTANT_S, INSTANTS, MODES};

use super::Plan;
use super::encoder::{EncodedBatch, Encoder, Sight};

/// Numbers of a future: x and y at the instants.
pub(super) const NUMBERS: usize = 2 * INSTANTS;
/// Gating blocks over the six queries.
const QUERY_BLOCKS: usize = 3;
/// Growth of a coordinate per second when the last layer outputs 1, m/s.
const SPREAD_MPS: f64 = 8.0;

/// Six futures of a batch.
pub(super) struct Regressed {
    /// Metres in the road user's frame, [batch, MODES, NUMBERS].
    pub(super) points: Tensor,
    /// [batch, MODES]; the softmax is the probability.
    pub(super) score: Tensor,
}

/// Maps features to futures.
pub(super) struct Regressor {
    encoder: Encoder,
    queries: Tensor,
    known: Linear,
    query_gating: Gating,
    head: Mlp,
    /// Metres of one number, [NUMBERS].
    spread: Tensor,
}

impl Regressor {
    pub(super) fn new(p: &mut Params, plan: &Plan) -> std::result::Result<Self, NetError> {
        let d = plan.sizes.width;
        let spread: Vec<f32> =
            (0..NUMBERS).map(|i| (SPREAD_MPS * INSTANT_S * (i / 2 + 1) as f64) as f32).collect();
        Ok(Self {
            encoder: Encoder::new(p, "initializer.sight", plan)?,
            queries: p.get("initializer.queries", &[MODES, d], Init::Normal(0.5))?,
            known: Linear::new(p, "initializer.known", d, d, 1.0)?,
            query_gating: Gating::new(p, "initializer", (QUERY_BLOCKS, d), &[MODES])?,
            head: Mlp::new(p, "initializer.head", [2 * d, 2 * d, NUMBERS + 1], 0.2)?,
            spread: Tensor::from_vec(spread, NUMBERS, p.device())?,
        })
    }

    /// Six futures.
    pub(super) fn forward(&self, sight: &Sight) -> Result<Regressed> {
        let EncodedBatch { vector, .. } = self.encoder.read(sight)?;
        let (batch, width) = vector.dims2()?;
        let known = self.known.forward(&vector)?.unsqueeze(1)?;
        let queries = known.broadcast_add(&self.queries)?;
        let all = Tensor::zeros((batch, MODES), queries.dtype(), queries.device())?;
        let (context, modes) = self.query_gating.forward(&vector, queries, &all)?;
        let context = context.unsqueeze(1)?.broadcast_as((batch, MODES, width))?.contiguous()?;
        let output = self.head.forward(&Tensor::cat(&[&modes, &context], 2)?)?;
        Ok(Regressed {
            points: output.narrow(2, 0, NUMBERS)?.contiguous()?.broadcast_mul(&self.spread)?,
            score: output.narrow(2, NUMBERS, 1)?.contiguous()?.reshape((batch, MODES))?,
        })
    }
}
