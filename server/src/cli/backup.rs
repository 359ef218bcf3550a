//! `dragtraffic backup`: copies the saved scenes, whether or not a server uses them.

use super::serve::default_db;
use super::{Common, Exit, Failure, output};
use crate::scenes::store;
use clap::Args;
use std::path::{Path, PathBuf};

/// Flags of `backup`.
#[derive(Args, Clone, Debug)]
pub struct BackupArgs {
    /// Database file of the saved scenes; a server may be using it. Default: that of serve.
    #[arg(long, env = "DRAGTRAFFIC_DB", value_name = "FILE")]
    db: Option<PathBuf>,
    /// File for the copy; serve --db reads it.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// Copies the whole store, checks the copy, and puts it in its place.
///
/// # Errors
/// Exit 2 when the two are one file, 3 when there is no store to copy, 8 when the output exists, else 1.
pub fn run(args: BackupArgs, common: &Common) -> Result<(), Failure> {
    let db = args.db.map_or_else(default_db, Ok)?;
    if !db.is_file() {
        return Err(Failure::input(format!("--db {}: no such file", db.display())));
    }
    if !takes_a_file(&args.output) {
        let message = format!("--output {}: a plain file is expected", args.output.display());
        return Err(Failure::usage(message));
    }
    if same_file(&db, &args.output) {
        let message = format!("--output {}: this is the store itself", args.output.display());
        return Err(Failure::usage(message));
    }
    output::keep(&args.output, args.force)?;
    let shown = format!("{} -> {}", db.display(), args.output.display());
    let copied = store::backup(&db, &args.output)
        .map_err(|error| Failure::new(Exit::Failure, format!("{shown}: {error}")))?;
    if !common.quiet {
        output::complain(&format!("{shown}: {} scenes, {} bytes, sound", copied.scenes, copied.bytes));
    }
    Ok(())
}

/// Whether the path is a file or does not exist.
pub fn takes_a_file(path: &Path) -> bool {
    path != Path::new("-") && path.metadata().map_or(true, |found| found.is_file())
}

/// Whether both paths are the same file, or one is a side file of the database.
pub fn same_file(db: &Path, output: &Path) -> bool {
    let Ok(db) = db.canonicalize() else { return false };
    let output = output.canonicalize().unwrap_or_else(|_| {
        let folder = output.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize().unwrap_or_default();
        folder.join(output.file_name().unwrap_or_default())
    });
    ["", "-wal", "-shm", "-journal", "-reserve", "-probe"].iter().any(|end| {
        let mut name = db.as_os_str().to_owned();
        name.push(end);
        output.as_os_str() == name
    })
}
