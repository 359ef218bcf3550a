//! Errors of training.

use std::path::{Path, PathBuf};

/// Why training or its files failed.
#[derive(Debug, thiserror::Error)]
pub enum TrainError {
    /// A file cannot be read or written.
    #[error("cannot use {path}")]
    Io {
        /// File.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
    /// A file has invalid content.
    #[error("{path}: {reason}")]
    Damaged {
        /// File.
        path: PathBuf,
        /// Value found and value expected.
        reason: String,
    },
    /// Options or data that do not fit together.
    #[error("{0}")]
    Invalid(String),
    /// A stop was requested; the run's checkpoint is kept.
    #[error("stopped after step {step}; --resume goes on from there")]
    Stopped {
        /// Steps that are done.
        step: u64,
    },
    /// No graphics card is usable.
    #[error("no CUDA device to train on: {0}")]
    Device(String),
    /// The network library failed.
    #[error(transparent)]
    Tensor(#[from] candle_core::Error),
    /// Weights cannot be used.
    #[error(transparent)]
    Net(#[from] experts::net::NetError),
}

impl TrainError {
    /// Adds the file to an I/O error.
    pub fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Io { path: path.to_path_buf(), source }
    }

    /// A damaged file.
    pub fn damaged(path: &Path, reason: impl Into<String>) -> Self {
        Self::Damaged { path: path.to_path_buf(), reason: reason.into() }
    }
}
