//! `dragtraffic restore`: replaces the store by a copy that `backup` made.

use super::backup::{same_file, takes_a_file};
use super::serve::default_db;
use super::{Common, Exit, Failure, output};
use crate::scenes::store;
use clap::Args;
use std::path::PathBuf;

/// Flags of `restore`.
#[derive(Args, Clone, Debug)]
pub struct RestoreArgs {
    /// Copy that backup made.
    #[arg(value_name = "COPY")]
    copy: PathBuf,
    /// Database file to replace; no server may use it. Default: that of serve.
    #[arg(long, env = "DRAGTRAFFIC_DB", value_name = "FILE")]
    db: Option<PathBuf>,
    /// Replace an existing store, with all its scenes.
    #[arg(long)]
    force: bool,
}

/// Checks the copy and puts it in place, completely or not at all.
///
/// # Errors
/// Exit 2 when the two are one file, 3 when there is no copy, 8 when there is a store already, else 1.
pub fn run(args: RestoreArgs, common: &Common) -> Result<(), Failure> {
    let db = args.db.map_or_else(default_db, Ok)?;
    if !args.copy.is_file() {
        return Err(Failure::input(format!("{}: no such file", args.copy.display())));
    }
    if !takes_a_file(&db) || same_file(&args.copy, &db) {
        return Err(Failure::usage(format!("--db {}: another plain file is expected", db.display())));
    }
    output::keep(&db, args.force)?;
    let shown = format!("{} -> {}", args.copy.display(), db.display());
    let restored = store::restore(&args.copy, &db)
        .map_err(|error| Failure::new(Exit::Failure, format!("{shown}: {error}")))?;
    common.say(&format!("{shown}: {} scenes, sound", restored.scenes));
    Ok(())
}
