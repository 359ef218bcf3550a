//! `dragtraffic lab statistics`.

use super::print_json;
use crate::cli::inputs::patterns;
use crate::cli::{Exit, Failure, output};
use clap::Args;
use std::path::PathBuf;

/// Flags of `statistics`.
#[derive(Args, Clone, Debug)]
pub struct StatisticsArgs {
    /// Sets of scenes, each NAME=PATH; one column of the table per set.
    #[arg(required = true, value_name = "NAME=PATH")]
    sets: Vec<String>,
    /// Print JSON instead of Markdown.
    #[arg(long)]
    json: bool,
    /// Maximum number of files per set, spread evenly over it.
    #[arg(long, default_value_t = 250)]
    most: usize,
}

/// Prints statistics of sets of scenes, one column each.
///
/// # Errors
/// Exit 3 when a set cannot be read.
pub fn statistics(args: StatisticsArgs) -> Result<(), Failure> {
    let unreadable = |reason: String| Failure::new(Exit::Input, reason);
    let mut columns = Vec::new();
    for set in &args.sets {
        let (name, path) =
            set.split_once('=').ok_or_else(|| unreadable(format!("{set}: expected NAME=PATH")))?;
        let files = lab_train::scenes::scene_files(&patterns(&[PathBuf::from(path)])?)
            .map_err(|e| unreadable(format!("{e:#}")))?;
        let every = files.len().div_ceil(args.most.max(1)).max(1);
        let mut statistics = lab_synthesize::statistics::Statistics::default();
        for file in files.iter().step_by(every) {
            let scenes = lab_train::scenes::read_scenes(file).map_err(|e| unreadable(format!("{e:#}")))?;
            scenes.iter().for_each(|scene| statistics.add(scene));
        }
        columns.push((name.to_owned(), statistics));
    }
    if args.json {
        let rows: std::collections::BTreeMap<_, _> =
            columns.iter().map(|(n, s)| (n, s.summaries())).collect();
        return print_json(&rows);
    }
    output::print(lab_synthesize::statistics::markdown(&columns).as_bytes())
}
