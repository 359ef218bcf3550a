//! `dragtraffic mine`: tags events in recorded scenes.

use super::inputs::Inputs;
use super::output;
use super::tally::survey;
use super::{Common, Failure};
use batch::mine::MinedTag;
use batch::mine::table::{self, MinedScene};
use clap::Args;
use std::path::PathBuf;

/// Flags of `mine`.
#[derive(Args, Clone, Debug)]
pub struct MineArgs {
    #[command(flatten)]
    inputs: Inputs,
    /// Table of the events, Parquet.
    #[arg(short, long, value_name = "FILE.parquet")]
    output: Option<PathBuf>,
    /// Print the events as JSON.
    #[arg(long)]
    json: bool,
    /// Overwrite the table.
    #[arg(long)]
    force: bool,
}

/// Tags recorded scenes.
///
/// # Errors
/// Exit 3 when no scene can be read, 4 when some cannot, 8 when the table exists.
pub fn run(args: &MineArgs, common: &Common) -> Result<(), Failure> {
    let sources = args.inputs.sources()?;
    if let Some(path) = &args.output {
        output::keep(path, args.force)?;
    }
    let (scenes, tally) = survey(&sources, args.inputs.workers(), common.quiet, |source, number, item| {
        Ok(MinedScene::new(source.shown(), number, item.name, &item.scene))
    });
    if !scenes.is_empty() {
        let text = if args.json { json(&scenes) } else { counts(&scenes) };
        output::print(text.as_bytes())?;
        if let Some(path) = &args.output {
            output::write(Some(path), &table::table(scenes)?, args.force)?;
        }
    }
    tally.end("files")
}

/// How often each tag occurs, and in how many scenes.
fn counts(scenes: &[MinedScene]) -> String {
    let mut text = format!("{:<16}{:>8}{:>8}\n", "tag", "events", "scenes");
    for tag in MinedTag::ALL {
        let of = |scene: &MinedScene| scene.events().filter(|event| event.tag == tag).count();
        let events: usize = scenes.iter().map(of).sum();
        let with = scenes.iter().filter(|scene| of(scene) > 0).count();
        text += &format!("{:<16}{events:>8}{with:>8}\n", tag.name());
    }
    text
}

fn json(scenes: &[MinedScene]) -> String {
    let lines: Vec<_> = scenes.iter().flat_map(MinedScene::lines).collect();
    // It holds only numbers and texts, which serde_json always writes.
    serde_json::to_string_pretty(&lines).unwrap_or_default() + "\n"
}
