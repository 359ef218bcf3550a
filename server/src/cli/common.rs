//! Flags of every command, and what they configure: the log, and the engine with its weights.

use super::{Exit, Failure, output};
use api::Operations;
use base::clock;
use clap::{Args, ValueEnum};
use std::io::IsTerminal;
use std::path::PathBuf;

/// Heading of these flags in the help.
const HEADING: &str = "Global options";
/// Number of losses, warnings or road users that are listed without `--verbose`.
const MOST_LISTED: usize = 10;

/// Flags of every command.
#[derive(Args, Clone, Debug)]
pub struct Common {
    /// Print only errors on standard error.
    #[arg(short, long, global = true, help_heading = HEADING)]
    pub quiet: bool,
    /// List all losses, warnings and road users on standard error, instead of the first 10.
    #[arg(short, long, global = true, conflicts_with = "quiet", help_heading = HEADING)]
    pub verbose: bool,
    /// Folder with vehicle.safetensors, pedestrian.safetensors, cyclist.safetensors and optionally
    /// placement.json. Default: the weights inside the program.
    #[arg(long, global = true, env = "DRAGTRAFFIC_WEIGHTS", value_name = "DIR", help_heading = HEADING)]
    pub weights: Option<PathBuf>,
    /// Format of log lines. Default: text.
    #[arg(long, global = true, value_enum, env = "DRAGTRAFFIC_LOG_FORMAT", value_name = "FORMAT", help_heading = HEADING)]
    pub log_format: Option<LogFormat>,
    /// Level of log lines: error, warn, info, debug, trace, or a tracing filter.
    #[arg(long, global = true, env = "DRAGTRAFFIC_LOG", value_name = "LEVEL", default_value = "info", help_heading = HEADING)]
    pub log_level: String,
}

/// Form of log lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// Lines of text.
    Text,
    /// One JSON object per line.
    Json,
}

impl Common {
    /// Prints a line on stderr; nothing under `--quiet`.
    pub fn say(&self, line: &str) {
        if !self.quiet {
            output::complain(line);
        }
    }

    /// The first lines, and the number of omitted `things`; all lines under `--verbose`.
    pub fn listed(&self, mut lines: Vec<String>, things: &str) -> Vec<String> {
        let more = lines.len().saturating_sub(MOST_LISTED);
        if more > 0 && !self.verbose {
            lines.truncate(MOST_LISTED);
            lines.push(format!("{more} more {things}; --verbose lists them"));
        }
        lines
    }

    /// Sends log lines to stderr.
    pub fn log(&self) {
        let level = if self.quiet { "error" } else { self.log_level.as_str() };
        let filter = tracing_subscriber::EnvFilter::try_new(level)
            .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new("info"));
        let terminal = std::io::stderr().is_terminal();
        // If the log cannot be written, for example on a full disk, requests are still served.
        let builder = tracing_subscriber::fmt()
            .with_env_filter(filter)
            .with_writer(std::io::stderr)
            .log_internal_errors(false);
        let done = if self.log_format == Some(LogFormat::Json) {
            builder.json().try_init()
        } else {
            let colour = terminal && std::env::var_os("NO_COLOR").is_none();
            builder.with_ansi(colour).with_target(false).try_init()
        };
        // A second subscriber is refused; the first one logs.
        let _ = done;
    }

    /// Generator and placer, from a folder or from the built-in weights.
    ///
    /// # Errors
    /// Exit 7.
    pub fn engine(&self) -> Result<experts::Engine, Failure> {
        let loaded = match &self.weights {
            Some(folder) => experts::Engine::from_dir(folder),
            None => experts::Engine::built_in(),
        };
        let engine = loaded.map_err(|error| Failure::new(Exit::Weights, format!("{error:#}")))?;
        Ok(experts::Engine { generator: engine.generator.with_clock(clock::monotonic), ..engine })
    }

    /// All operations over the engine.
    ///
    /// # Errors
    /// Exit 7.
    pub fn operations(&self) -> Result<Operations, Failure> {
        Ok(Operations { clock: clock::monotonic, ..Operations::new(self.engine()?) })
    }

    /// The same, with this number of threads per call.
    ///
    /// # Errors
    /// Exit 7.
    pub fn operations_on(&self, threads: usize) -> Result<Operations, Failure> {
        Ok(self.operations()?.beside(threads))
    }

    /// Only the generator.
    ///
    /// # Errors
    /// Exit 7.
    #[cfg(feature = "lab")]
    pub fn generator(&self) -> Result<experts::Generator, Failure> {
        Ok(self.engine()?.generator)
    }
}
