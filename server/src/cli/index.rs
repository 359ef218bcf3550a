//! `dragtraffic index`: who does what in recorded scenes, as a table.

use super::inputs::{Inputs, Reading, Source};
use super::output;
use super::progress::Progress;
use super::tally::Tally;
use super::{Common, Failure, parallel};
use batch::index::{self, IndexedScene};
use clap::Args;
use std::path::PathBuf;

/// Flags of `index`.
#[derive(Args, Clone, Debug)]
pub struct IndexArgs {
    #[command(flatten)]
    inputs: Inputs,
    /// The table, Parquet.
    #[arg(short, long, value_name = "FILE.parquet")]
    output: PathBuf,
    /// Overwrite the table.
    #[arg(long)]
    force: bool,
}

/// Writes the table.
///
/// # Errors
/// Exit 3 when no scene can be read, 4 when some cannot, 8 when the table exists.
pub fn index(args: &IndexArgs, common: &Common) -> Result<(), Failure> {
    let sources = args.inputs.sources()?;
    output::keep(&args.output, args.force)?;
    let progress = Progress::new("files", sources.len() as u64, common.quiet);
    let (mut tally, mut scenes) = (Tally::default(), Vec::new());
    parallel::in_order(&sources, args.inputs.workers(), of_file, |_, found| {
        tally.add(found.map(|found| scenes.extend(found)), sources.len() == 1, &progress);
        progress.step();
    });
    drop(progress);
    let (count, rows) = (scenes.len(), scenes.iter().map(IndexedScene::rows).sum::<usize>());
    if count > 0 {
        output::write(Some(&args.output), &index::table(scenes)?, args.force)?;
        common.say(&format!("{rows} moving road users of {count} scenes"));
    }
    tally.end("files")
}

fn of_file(source: &Source) -> Result<Vec<IndexedScene>, Failure> {
    let mut found = Vec::new();
    source.each(&Reading::default(), &mut |item| {
        let number = found.len() as u64;
        found.push(IndexedScene::new(source.path.display().to_string(), number, item.name, &item.scene));
        Ok(())
    })?;
    Ok(found)
}
