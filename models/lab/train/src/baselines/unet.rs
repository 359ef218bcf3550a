//! The paper's refiner: a one-dimensional U-Net over the points of a future that says the noise in them, with
//! cross-attention to what the road user sees, its condition included.

use candle_core::{Result, Tensor};
use experts::net::layers::{CrossBlock, Linear, Norm, RELU_GAIN};
use experts::net::schedule::{self, LEVELS};
use experts::net::{Architecture, Init, NetError, Params};
use experts::planning::{INSTANTS, MODES};

use super::regressor::{NUMBERS, Seen};

/// Level of noise at which the initializer's futures enter.
const START: usize = 5;
/// Steps from there.
const STEPS: usize = 5;
/// Points that become one on the way down: 18 points, then 9, then 3.
const POOLED: [usize; 2] = [2, 3];

/// Level pairs of refinement.
pub(super) fn steps() -> Vec<(usize, usize)> {
    schedule::ddim(START, STEPS)
}

/// Convolution of three neighbours on a line, zeros beyond its ends.
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

/// Two convolutions with the level of noise between them, added to their input.
struct Block {
    norm: Norm,
    first: Conv,
    level: Linear,
    second: Conv,
}

impl Block {
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

/// The refiner. Futures are in units of the loss here, [batch, MODES, NUMBERS].
pub(super) struct Unet {
    levels: Tensor,
    context: Linear,
    token_norm: Norm,
    enter: Conv,
    down: [Block; 2],
    pool: [Linear; 2],
    attention: Vec<CrossBlock>,
    spread: [Linear; 2],
    join: [Linear; 2],
    up: [Block; 2],
    norm: Norm,
    leave: Linear,
}

impl Unet {
    pub(super) fn new(p: &mut Params, a: &Architecture) -> std::result::Result<Self, NetError> {
        let d = a.width;
        // Channels at 18, 9 and 3 points.
        let [c0, c1, c2] = [d / 4, d / 2, d];
        let linear = |p: &mut Params, name: &str, inputs, outputs| {
            Linear::new(p, &format!("refiner.{name}"), inputs, outputs, RELU_GAIN)
        };
        let attention = (0..a.refiner_blocks)
            .map(|block| CrossBlock::new(p, &format!("refiner.attention.{block}"), d, a.heads))
            .collect::<std::result::Result<_, _>>()?;
        Ok(Self {
            levels: p.get("refiner.levels", &[LEVELS + 1, d], Init::Normal(0.5))?,
            context: Linear::new(p, "refiner.context", d, d, 1.0)?,
            token_norm: Norm::new(p, "refiner.token_norm", d)?,
            enter: Conv::new(p, "refiner.enter", 2, c0)?,
            down: [Block::new(p, "refiner.down.0", c0, d)?, Block::new(p, "refiner.down.1", c1, d)?],
            pool: [linear(p, "pool.0", POOLED[0] * c0, c1)?, linear(p, "pool.1", POOLED[1] * c1, c2)?],
            attention,
            spread: [linear(p, "spread.0", c1, POOLED[0] * c0)?, linear(p, "spread.1", c2, POOLED[1] * c1)?],
            join: [linear(p, "join.0", 2 * c0, c0)?, linear(p, "join.1", 2 * c1, c1)?],
            up: [Block::new(p, "refiner.up.0", c0, d)?, Block::new(p, "refiner.up.1", c1, d)?],
            norm: Norm::new(p, "refiner.norm", c0)?,
            leave: Linear::new(p, "refiner.leave", c0, 2, 0.1)?,
        })
    }

    /// The noise in futures at levels, one a road user.
    pub(super) fn noise(&self, seen: &Seen, futures: &Tensor, levels: &[usize]) -> Result<Tensor> {
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
        let tokens = self.token_norm.forward(&seen.tokens)?;
        for block in &self.attention {
            coarse = block.forward(&coarse, &tokens, &seen.mask)?;
        }
        let coarse = self.spread[1].forward(&coarse.reshape((lines, points, ()))?)?;
        let joined = Tensor::cat(&[&coarse.reshape(middle.shape())?, &middle], 2)?;
        let middle = self.up[1].forward(&self.join[1].forward(&joined)?, &level)?;
        let wide = self.spread[0].forward(&middle)?;
        let joined = Tensor::cat(&[&wide.reshape(fine.shape())?, &fine], 2)?;
        let fine = self.up[0].forward(&self.join[0].forward(&joined)?, &level)?;
        self.leave.forward(&self.norm.forward(&fine)?)?.reshape((batch, MODES, NUMBERS))
    }

    /// The futures without the noise of one level for all.
    pub(super) fn denoise(&self, seen: &Seen, futures: &Tensor, level: usize) -> Result<Tensor> {
        let signal = schedule::signal(level);
        let noise = self.noise(seen, futures, &vec![level; futures.dim(0)?])?;
        (futures - (noise * (1.0 - signal).sqrt())?)? * (1.0 / signal.sqrt())
    }

    /// Goes some refinement steps without chance.
    pub(super) fn walk(&self, seen: &Seen, futures: &Tensor, steps: &[(usize, usize)]) -> Result<Tensor> {
        let mut futures = futures.clone();
        for &(from, to) in steps {
            let step = schedule::step(from, to, 0.0);
            let denoised = self.denoise(seen, &futures, from)?;
            futures = ((denoised * step.denoised)? + (futures * step.residual)?)?;
        }
        Ok(futures)
    }
}
