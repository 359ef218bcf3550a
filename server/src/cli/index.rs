//! `dragtraffic index`: what each road user does in recorded scenes, as a table.

use super::inputs::Inputs;
use super::output;
use super::tally::survey;
use super::{Common, Failure};
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
    let (scenes, tally) = survey(&sources, args.inputs.workers(), common.quiet, |source, number, item| {
        Ok(IndexedScene::new(source.path.display().to_string(), number, item.name, &item.scene))
    });
    let (count, rows) = (scenes.len(), scenes.iter().map(IndexedScene::rows).sum::<usize>());
    if count > 0 {
        output::write(Some(&args.output), &index::table(scenes)?, args.force)?;
        common.say(&format!("{rows} moving road users of {count} scenes"));
    }
    tally.end("files")
}
