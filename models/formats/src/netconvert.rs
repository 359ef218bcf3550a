//! SUMO's netconvert, a separate program that the caller may have.

use std::fmt::Debug;
use std::io;

/// Runs netconvert for readers that need it.
pub trait Netconvert: Debug + Send + Sync {
    /// Converts a file to a network and returns its `net.xml`. The program runs with these arguments in an
    /// empty folder that holds only the file `name`.
    ///
    /// # Errors
    /// `NotFound` without the program, `TimedOut`, and the program's own message when it fails.
    fn network(&self, name: &str, file: &[u8], arguments: &[String]) -> io::Result<Vec<u8>>;
}
