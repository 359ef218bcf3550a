//! Layers with parameters.

use candle_core::{Result, Tensor};

use super::error::NetError;
use super::ops;
use super::params::{Init, Params};

/// `x W + b`, with or without a rectifier.
#[derive(Clone, Debug)]
pub struct Linear {
    weight: Tensor,
    bias: Tensor,
    relu: bool,
}

impl Linear {
    /// A layer; `gain` scales the initial weights' deviation `gain / sqrt(inputs)`.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(
        p: &mut Params,
        name: &str,
        inputs: usize,
        outputs: usize,
        gain: f64,
    ) -> std::result::Result<Self, NetError> {
        Ok(Self {
            weight: p.get(
                &format!("{name}.weight"),
                &[inputs, outputs],
                Init::Normal(gain / (inputs as f64).sqrt()),
            )?,
            bias: p.get(&format!("{name}.bias"), &[outputs], Init::Constant(0.0))?,
            relu: false,
        })
    }

    /// The same layer followed by a rectifier.
    #[must_use]
    pub fn relu(mut self) -> Self {
        self.relu = true;
        self
    }

    /// `x` [.., inputs] to [.., outputs].
    ///
    /// # Errors
    /// When the shape does not fit.
    pub fn forward(&self, x: &Tensor) -> Result<Tensor> {
        ops::linear(x, &self.weight, &self.bias, self.relu)
    }
}

/// Deviation gain that keeps the variance through a rectifier.
pub const RELU_GAIN: f64 = 1.4;

/// Two linear layers with a rectifier between them.
#[derive(Clone, Debug)]
pub struct Mlp {
    first: Linear,
    second: Linear,
}

impl Mlp {
    /// `sizes` are inputs, hidden and outputs; `gain` is the last layer's.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(
        p: &mut Params,
        name: &str,
        sizes: [usize; 3],
        gain: f64,
    ) -> std::result::Result<Self, NetError> {
        Ok(Self {
            first: Linear::new(p, &format!("{name}.0"), sizes[0], sizes[1], RELU_GAIN)?.relu(),
            second: Linear::new(p, &format!("{name}.1"), sizes[1], sizes[2], gain)?,
        })
    }

    /// The same with a rectifier at the end.
    #[must_use]
    pub fn relu(mut self) -> Self {
        self.second = self.second.relu();
        self
    }

    /// `x` [.., inputs] to [.., outputs].
    ///
    /// # Errors
    /// When the shape does not fit.
    pub fn forward(&self, x: &Tensor) -> Result<Tensor> {
        self.second.forward(&self.first.forward(x)?)
    }
}

/// Layer norm over the last dimension.
#[derive(Clone, Debug)]
pub struct Norm {
    scale: Tensor,
    shift: Tensor,
}

impl Norm {
    /// A norm over `width` numbers.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(p: &mut Params, name: &str, width: usize) -> std::result::Result<Self, NetError> {
        Ok(Self {
            scale: p.get(&format!("{name}.scale"), &[width], Init::Constant(1.0))?,
            shift: p.get(&format!("{name}.shift"), &[width], Init::Constant(0.0))?,
        })
    }

    /// `x` [.., width] to the same shape.
    ///
    /// # Errors
    /// When the shape does not fit.
    pub fn forward(&self, x: &Tensor) -> Result<Tensor> {
        ops::layer_norm(x, &self.scale, &self.shift)
    }
}

/// An MLP added to its input (pre-norm), separately for each token.
#[derive(Clone, Debug)]
pub struct MlpBlock {
    norm: Norm,
    mlp: Mlp,
}

impl MlpBlock {
    /// A block of a width.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(p: &mut Params, name: &str, width: usize) -> std::result::Result<Self, NetError> {
        Ok(Self {
            norm: Norm::new(p, &format!("{name}_norm"), width)?,
            mlp: Mlp::new(p, name, [width, 2 * width, width], 0.3)?,
        })
    }

    /// `x` [.., width] to the same shape.
    ///
    /// # Errors
    /// When the shape does not fit.
    pub fn forward(&self, x: &Tensor) -> Result<Tensor> {
        x + self.mlp.forward(&self.norm.forward(x)?)?
    }
}

/// Attention of queries to a context's tokens, added to its input (pre-norm), then an [`MlpBlock`].
#[derive(Clone, Debug)]
pub struct CrossBlock {
    heads: usize,
    query_norm: Norm,
    query: Linear,
    key_value: Linear,
    out: Linear,
    mlp: MlpBlock,
}

impl CrossBlock {
    /// A block of a width.
    ///
    /// # Errors
    /// When the parameters cannot be created.
    pub fn new(
        p: &mut Params,
        name: &str,
        width: usize,
        heads: usize,
    ) -> std::result::Result<Self, NetError> {
        Ok(Self {
            heads,
            query_norm: Norm::new(p, &format!("{name}.query_norm"), width)?,
            query: Linear::new(p, &format!("{name}.query"), width, width, 1.0)?,
            key_value: Linear::new(p, &format!("{name}.key_value"), width, 2 * width, 1.0)?,
            out: Linear::new(p, &format!("{name}.out"), width, width, 0.3)?,
            mlp: MlpBlock::new(p, &format!("{name}.mlp"), width)?,
        })
    }

    /// `x` [batch, queries, width] to the same shape, attending to `tokens` [batch, tokens, width]; `mask`
    /// [batch, tokens] is additive.
    ///
    /// # Errors
    /// When the shapes do not fit.
    pub fn forward(&self, x: &Tensor, tokens: &Tensor, mask: &Tensor) -> Result<Tensor> {
        let q = self.query.forward(&self.query_norm.forward(x)?)?;
        let seen = ops::attention(&q, &self.key_value.forward(tokens)?, mask, self.heads)?;
        self.mlp.forward(&(x + self.out.forward(&seen)?)?)
    }
}
