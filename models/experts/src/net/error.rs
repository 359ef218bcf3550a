//! Errors of weights and networks.

/// Why weights cannot be used or a network failed.
#[derive(Debug, thiserror::Error)]
pub enum NetError {
    /// The file is not a safetensors file.
    #[error("not a safetensors file: {0}")]
    Format(String),
    /// The header lacks a member, or has a value that this program cannot run.
    #[error("header member \"{member}\": {reason}")]
    Header {
        /// Member of the metadata header.
        member: &'static str,
        /// What was found and what was expected.
        reason: String,
    },
    /// A tensor is missing.
    #[error("tensor \"{0}\" is missing")]
    Missing(String),
    /// A tensor has another shape or type than the architecture says.
    #[error("tensor \"{name}\" is {found}, expected {expected}")]
    Shape {
        /// Name of the tensor.
        name: String,
        /// What the file has.
        found: String,
        /// What the architecture needs.
        expected: String,
    },
    /// The tensor library failed.
    #[error(transparent)]
    Tensor(#[from] candle_core::Error),
}
