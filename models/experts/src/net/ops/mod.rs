//! Tensor operations with our own backward pass, for f32 on the CPU.
//!
//! candle's own fused norm and softmax have no gradient, its broadcasts are slow backwards, and its maximum
//! gives tied elements the full gradient each. On another device or type, each function here uses stock
//! operations, limited to those with a correct gradient. Tests compare both forms on the CPU, so arithmetic
//! for training on a GPU is tested without one.

mod attention;
mod gate;
mod linear;
mod norm;
mod pool;
mod project;
mod raw;

pub use attention::attention;
pub use gate::gate_mix;
pub use linear::linear;
pub use norm::layer_norm;
pub use pool::segment_max;
pub use project::project;

#[cfg(test)]
pub(crate) mod check;
