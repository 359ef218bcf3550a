//! Exit codes of commands.

/// Exit code of a command; the numbers are part of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Any failure without its own code.
    Failure = 1,
    /// The command line is invalid.
    Usage = 2,
    /// Input cannot be read or is invalid.
    Input = 3,
    /// Some items failed, the others are done.
    Partly = 4,
    /// There were losses under `--strict`.
    Lossy = 5,
    /// The address is in use.
    AddressInUse = 6,
    /// Weights are missing or invalid.
    Weights = 7,
    /// The output exists.
    OutputExists = 8,
    /// Ctrl-C; commands that write result by result keep the completed ones.
    Interrupted = 130,
}

/// Why a command failed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Exit code.
    pub exit: Exit,
    /// One sentence; empty if it was already printed.
    pub message: String,
}

impl Failure {
    /// A failure with one sentence; numbers of system errors are removed.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: without_error_numbers(&message.into()) }
    }

    /// A failure of an invalid command line.
    pub fn usage(message: impl Into<String>) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// A failure of invalid input.
    pub fn input(message: impl Into<String>) -> Self {
        Self::new(Exit::Input, message)
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self::new(Exit::Failure, error.to_string())
    }
}

/// Removes numbers such as that of "No such file or directory (os error 2)": the text is enough.
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
