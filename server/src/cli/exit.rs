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
    /// A failure with one sentence; the numbers of the system's errors are left out.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: without_error_numbers(&message.into()) }
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

/// The words of system errors say what happened: "No such file or directory (os error 2)".
fn without_error_numbers(message: &str) -> String {
    let mut parts = message.split(" (os error ");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |kept, part| kept + part.split_once(')').map_or("", |(_, rest)| rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_has_the_words_of_a_system_error_alone() {
        let error = std::io::Error::from_raw_os_error(2);
        assert!(error.to_string().contains("(os error 2)"), "{error}");
        let message = Failure::input(format!("a.json: {error}, b.json: {error}; c.json")).message;
        assert!(!message.contains("os error"), "{message}");
        assert!(message.starts_with("a.json: ") && message.ends_with("; c.json"), "{message}");
        assert_eq!(Failure::input("a (b)").message, "a (b)");
    }
}
