//! The paper's denoiser: its own encoder, and a one-dimensional U-Net that predicts the noise in the points
//! of a future. At each step it has cross-attention to the road user's surroundings and the user's condition.

use candle_core::{Result, Tensor};
use experts::net::layers::{CrossBlock, Linear, Norm, RELU_GAIN};
use experts::net::schedule::{self, LEVELS};
use experts::net::{Init, NetError, Params};
use experts::planning::{INSTANTS, MODES};

use super::Plan;
use super::encoder::{EncodedBatch, Encoder, Sight};
use super::regressor::NUMBERS;

/// Level of noise at which the initializer's futures enter.
const START: usize = 5;
/// Number of steps from there.
pub(super) const STEPS: usize = 5;
/// Points that become one on the way down: 18 points, then 9, then 3.
const POOLED: [usize; 2] = [2, 3];

/// Level pairs of refinement, one level per step.
pub(super) fn steps() -> Vec<(usize, usize)> {
    schedule::ddim(START, STEPS)
}

/// Convolution of three adjacent points, with zeros beyond the ends.
struct Conv(Linear);

impl Conv {
    fn new(p: &mut Params, name: &str, inputs: usize, outputs: usize) -> std::result::Result<Self, NetError> {
        Ok(Self(Linear::new(p, name, 3 * inputs, outputs, RELU_GAIN)?))
    }

    /// `x` [lines, points, inputs] to [lines, points, outputs].
    fn forward(&self, x: &Tensor) -> Result<Tensor> {
        let points = x.dim(1)?;
        let padded = x.pad_with_zeros(1, 1, 1)?;
        let shifted = (0..3).map(|by| padded.narrow(1, by, points)).collect::<Result<Vec<_>>>()?;
        self.0.forward(&Tensor::cat(&shifted, 2)?)
    }
}

/// Two convolutions with the noise level between them, added to their input.
struct ResidualBlock {
    norm: Norm,
    first: Conv,
    level: Linear,
    second: Conv,
}

impl ResidualBlock {
    fn new(p: &mut Params, name: &str, channels: usize, width: usize) -> std::result::Result<Self, NetError> {
        Ok(Self {
            norm: Norm::new(p, &format!("{name}.norm"), channels)?,
            first: Conv::new(p, &format!("{name}.first"), channels, channels)?,
            level: Linear::new(p, &format!("{name}.level"), width, channels, 1.0)?,
            second: Conv::new(p, &format!("{name}.second"), channels, channels)?,
        })
    }

    /// `x` [lines, points, channels]; `level` [lines, width].
    fn forward(&self, x: &Tensor, level: &Tensor) -> Result<Tensor> {
        let y = self.first.forward(&self.norm.forward(x)?)?;
        let y = y.broadcast_add(&self.level.forward(level)?.unsqueeze(1)?)?.relu()?;
        x + self.second.forward(&y)?
    }
}

/// Output of the denoiser's own encoder for a batch.
pub(super) struct Context {
    /// [batch, width]
    pub(super) vector: Tensor,
    /// The user's condition, then what is seen, [batch, tokens, width].
    tokens: Tensor,
    mask: Tensor,
}

/// The denoiser. Futures are in the units of the loss here, [batch, MODES, NUMBERS].
pub(super) struct Unet {
    encoder: Encoder,
    /// The encoded condition as a token.
    asked: Linear,
    levels: Tensor,
    context: Linear,
    token_norm: Norm,
    enter: Conv,
    down: [ResidualBlock; 2],
    pool: [Linear; 2],
    attention: Vec<CrossBlock>,
    spread: [Linear; 2],
    join: [Linear; 2],
    up: [ResidualBlock; 2],
    norm: Norm,
    leave: Linear,
}

impl Unet {
    pub(super) fn new(p: &mut Params, plan: &Plan) -> std::result::Result<Self, NetError> {
        let (a, d) = (&plan.sizes, plan.sizes.width);
        // Channels at 18, 9 and 3 points.
        let [c0, c1, c2] = [d / 4, d / 2, d];
        let linear = |p: &mut Params, name: &str, inputs, outputs| {
            Linear::new(p, &format!("refiner.{name}"), inputs, outputs, RELU_GAIN)
        };
        let attention = (0..a.refiner_blocks)
            .map(|block| CrossBlock::new(p, &format!("refiner.attention.{block}"), d, a.heads))
            .collect::<std::result::Result<_, _>>()?;
        Ok(Self {
            encoder: Encoder::new(p, "refiner.sight", plan)?,
            asked: Linear::new(p, "refiner.asked", plan.condition_width, d, 1.0)?,
            levels: p.get("refiner.levels", &[LEVELS + 1, d], Init::Normal(0.5))?,
            context: Linear::new(p, "refiner.context", d, d, 1.0)?,
            token_norm: Norm::new(p, "refiner.token_norm", d)?,
            enter: Conv::new(p, "refiner.enter", 2, c0)?,
            down: [
                ResidualBlock::new(p, "refiner.down.0", c0, d)?,
                ResidualBlock::new(p, "refiner.down.1", c1, d)?,
            ],
            pool: [linear(p, "pool.0", POOLED[0] * c0, c1)?, linear(p, "pool.1", POOLED[1] * c1, c2)?],
            attention,
            spread: [linear(p, "spread.0", c1, POOLED[0] * c0)?, linear(p, "spread.1", c2, POOLED[1] * c1)?],
            join: [linear(p, "join.0", 2 * c0, c0)?, linear(p, "join.1", 2 * c1, c1)?],
            up: [
                ResidualBlock::new(p, "refiner.up.0", c0, d)?,
                ResidualBlock::new(p, "refiner.up.1", c1, d)?,
            ],
            norm: Norm::new(p, "refiner.norm", c0)?,
            leave: Linear::new(p, "refiner.leave", c0, 2, 0.1)?,
        })
    }

    /// Encodes a batch, once for all its steps.
    pub(super) fn context(&self, sight: &Sight) -> Result<Context> {
        let EncodedBatch { vector, tokens, mask, condition } = self.encoder.read(sight)?;
        let (tokens, mask) = match condition {
            Some(condition) => {
                let asked = self.asked.forward(&condition)?.unsqueeze(1)?;
                let open = Tensor::zeros((mask.dim(0)?, 1), mask.dtype(), mask.device())?;
                (Tensor::cat(&[&asked, &tokens], 1)?, Tensor::cat(&[&open, &mask], 1)?)
            }
            None => (tokens, mask),
        };
        Ok(Context { vector, tokens: self.token_norm.forward(&tokens)?, mask })
    }

    /// The noise in futures at levels, one per road user.
    pub(super) fn noise(&self, seen: &Context, futures: &Tensor, levels: &[usize]) -> Result<Tensor> {
        let batch = futures.dim(0)?;
        let (lines, device) = (batch * MODES, futures.device());
        let levels: Vec<u32> = levels.iter().map(|&level| level as u32).collect();
        let level = self.levels.index_select(&Tensor::from_vec(levels, batch, device)?, 0)?;
        let level = (level + self.context.forward(&seen.vector)?)?.unsqueeze(1)?;
        let level = level.broadcast_as((batch, MODES, level.dim(2)?))?.contiguous()?;
        let level = level.reshape((lines, ()))?;
        let enter = self.enter.forward(&futures.reshape((lines, INSTANTS, 2))?)?;
        let fine = self.down[0].forward(&enter, &level)?;
        let middle = self.pool[0].forward(&fine.reshape((lines, INSTANTS / POOLED[0], ()))?)?;
        let middle = self.down[1].forward(&middle, &level)?;
        let points = INSTANTS / (POOLED[0] * POOLED[1]);
        let mut coarse = self.pool[1].forward(&middle.reshape((lines, points, ()))?)?;
        coarse = coarse.reshape((batch, MODES * points, ()))?;
        for block in &self.attention {
            coarse = block.forward(&coarse, &seen.tokens, &seen.mask)?;
        }
        let coarse = self.spread[1].forward(&coarse.reshape((lines, points, ()))?)?;
        let joined = Tensor::cat(&[&coarse.reshape(middle.shape())?, &middle], 2)?;
        let middle = self.up[1].forward(&self.join[1].forward(&joined)?, &level)?;
        let wide = self.spread[0].forward(&middle)?;
        let joined = Tensor::cat(&[&wide.reshape(fine.shape())?, &fine], 2)?;
        let fine = self.up[0].forward(&self.join[0].forward(&joined)?, &level)?;
        self.leave.forward(&self.norm.forward(&fine)?)?.reshape((batch, MODES, NUMBERS))
    }

    /// The leapfrog steps by the paper's update (its section on diffusion refinement). Each removes its share
    /// of the estimated noise and, except for the last, adds new noise with the variance of the step. `fresh`
    /// has one draw per step.
    pub(super) fn leapfrog(&self, seen: &Context, futures: &Tensor, fresh: &[Tensor]) -> Result<Tensor> {
        let batch = futures.dim(0)?;
        let mut futures = futures.clone();
        for (i, (from, to)) in steps().into_iter().enumerate() {
            let update = Update::between(from, to);
            let noise = self.noise(seen, &futures, &vec![from; batch])?;
            futures = ((futures - (noise * update.noise)?)? * update.scale)?;
            if let Some(fresh) = fresh.get(i).filter(|_| to > 0) {
                futures = (futures + (fresh * update.fresh)?)?;
            }
        }
        Ok(futures)
    }
}

/// Factors of one step: `(x - noise * e) * scale + fresh * z`.
#[derive(Clone, Copy, Debug)]
struct Update {
    scale: f64,
    noise: f64,
    fresh: f64,
}

impl Update {
    /// Between neighbouring levels, with `alpha` the share of signal power that remains from one to the next.
    fn between(from: usize, to: usize) -> Self {
        let (signal, alpha) = (schedule::signal(from), schedule::signal(from) / schedule::signal(to));
        Self {
            scale: 1.0 / alpha.sqrt(),
            noise: (1.0 - alpha) / (1.0 - signal).sqrt(),
            fresh: (1.0 - alpha).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_with_the_true_noise_leads_to_the_mean_of_the_level_below() {
        // x = sqrt(a) x0 + sqrt(1 - a) e: the remaining share of e is that of the mean of the reverse chain.
        let (x0, e) = (2.0, -0.7);
        for (from, to) in steps() {
            let (a, b) = (schedule::signal(from), schedule::signal(to));
            let update = Update::between(from, to);
            let x = a.sqrt() * x0 + (1.0 - a).sqrt() * e;
            let found = (x - update.noise * e) * update.scale;
            let beta = 1.0 - a / b;
            let mean = b.sqrt() * beta / (1.0 - a) * x0 + (a / b).sqrt() * (1.0 - b) / (1.0 - a) * x;
            assert!((found - mean).abs() < 1e-9, "{from}: {found} {mean}");
            assert!((update.fresh.powi(2) - beta).abs() < 1e-12);
        }
    }
}
