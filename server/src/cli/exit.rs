//! How commands end.

/// How a command ends; the numbers are part of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Anything that has no number of its own.
    Failure = 1,
    /// The command line makes no sense.
    Usage = 2,
    /// Input cannot be read or is not valid.
    Input = 3,
    /// Some items failed, the rest are done.
    Partly = 4,
    /// Something was lost under `--strict`.
    Lossy = 5,
    /// The address is taken.
    AddressInUse = 6,
    /// Weights are missing or wrong.
    Weights = 7,
    /// The output exists.
    OutputExists = 8,
    /// Ctrl-C; commands that write result by result keep the finished ones.
    Interrupted = 130,
}

/// Why a command failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Exit code.
    pub exit: Exit,
    /// One sentence; empty when it was printed already.
    pub message: String,
}

impl Failure {
    /// A failure with one sentence.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: message.into() }
    }

    /// A command line that makes no sense.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// Input that cannot be taken.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(Exit::Input, message)
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self::new(Exit::Failure, error.to_string())
    }
}
