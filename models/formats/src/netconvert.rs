//! SUMO's netconvert, a program of its own that the caller may have.

use std::fmt::Debug;
use std::io;

/// Runs netconvert for readers that need it.
pub trait Netconvert: Debug + Send + Sync {
    /// What it makes of a file: the network that it writes as `net.xml`. It is started in an empty folder that holds
    /// the file `name`, with these arguments.
    ///
    /// # Errors
    /// `NotFound` where there is no such program, `TimedOut`, and with its words when it fails.
    fn network(&self, name: &str, file: &[u8], arguments: &[String]) -> io::Result<Vec<u8>>;
}
