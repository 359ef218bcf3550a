//! `dragtraffic score`: figures of scenes and of each of their samples, filtered by a condition.

pub mod table;
mod thresholds;
mod words;

use super::inputs::{Inputs, Item, Reading, Source};
use super::output::{self, Folder};
use super::progress::Progress;
use super::tally::Tally;
use super::{Common, Failure, parallel, values};
use batch::figures::{self, FigureFilter, Figures};
use clap::Args;
use formats::native::{self, MapForm, SceneDoc};
use scene::score::{Drivable, Score, ScoreInput};
use scene::{Sample, Scene};
use serde_json::{Map, Value, json};
use std::ops::Range;
use std::path::PathBuf;
use table::Table;
use thresholds::Counting;

/// Flags of `score`.
#[derive(Args, Clone, Debug)]
pub struct ScoreArgs {
    #[command(flatten)]
    inputs: Inputs,
    /// Samples to score: chosen, all, a number counted from 0, or FIRST..LAST (both included).
    #[arg(long, value_name = "WHICH", default_value = "chosen", value_parser = which)]
    sample: Which,
    /// Keep only samples that satisfy this condition, such as 'min_ttc_s < 1.5 && collisions == 0'. Terms: a
    /// figure of the score, or actor.FIGURE for the generated road user; a list counts its entries that are
    /// not in the recording. Operators: < <= > >= == != && || ! ( ). A comparison with a missing figure is
    /// false. An unknown name lists all figures.
    #[arg(long = "where", value_name = "CONDITION", value_parser = FigureFilter::parse)]
    filter: Option<FigureFilter>,
    /// Print one JSON object per line instead of text.
    #[arg(long)]
    json: bool,
    /// Write a table with one row per sample to this file; - is standard output instead of text.
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    csv: Option<PathBuf>,
    /// Copy each scored sample to this folder, one scene per sample.
    #[arg(long, value_name = "DIR")]
    copy_to: Option<PathBuf>,
    /// Overwrite the table and the copies.
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    counting: Counting,
}

/// Selection of a scene's samples.
#[derive(Clone, Debug, PartialEq)]
enum Which {
    Chosen,
    All,
    These(Range<usize>),
}

fn which(text: &str) -> Result<Which, String> {
    match text {
        "chosen" => Ok(Which::Chosen),
        "all" => Ok(Which::All),
        _ => values::index(text)
            .map(Which::These)
            .map_err(|_| "chosen, all, a number or FIRST..LAST expected".into()),
    }
}

/// The result of one file.
struct Scored {
    text: String,
    rows: Vec<Vec<String>>,
    held: usize,
    looked_at: usize,
}

/// Scores scenes.
///
/// # Errors
/// Exit 2 when a scene lacks the requested sample, 3 when none can be read, 4 when some cannot, 8 when the table or a
/// copy exists.
pub fn score(args: ScoreArgs, common: &Common) -> Result<(), Failure> {
    let sources = args.inputs.sources()?;
    if let Some(path) = args.csv.as_deref().filter(|path| *path != std::path::Path::new("-")) {
        output::keep(path, args.force)?;
    }
    let copies = args.copy_to.as_deref().map(|path| Folder::new(path, args.force)).transpose()?;
    let progress = Progress::new("files", sources.len() as u64, common.quiet);
    let (mut tally, mut table, mut broken) = (Tally::default(), Table::new(), None);
    let (mut held, mut looked_at) = (0, 0);
    let work = |source: &Source| of_file(source, &args, copies.as_ref());
    parallel::in_order(&sources, args.inputs.workers(), work, |_, scored| {
        let result = scored.map(|scored| {
            held += scored.held;
            looked_at += scored.looked_at;
            scored.rows.iter().for_each(|row| table.add(row));
            let done = progress.pausing(|| output::print(scored.text.as_bytes()));
            broken = broken.take().or(done.err());
        });
        tally.add(result, sources.len() == 1, &progress);
        progress.step();
    });
    drop(progress);
    if let Some(failure) = broken {
        return Err(failure);
    }
    if let Some(path) = &args.csv {
        output::write(Some(path), &table.bytes()?, args.force)?;
    }
    if let (Some(filter), false) = (&args.filter, common.quiet || looked_at == 0) {
        output::complain(&format!("{held} of {looked_at} hold {}", filter.text()));
    }
    tally.end("files")
}

fn of_file(source: &Source, args: &ScoreArgs, copies: Option<&Folder>) -> Result<Scored, Failure> {
    let mut scored = Scored { text: String::new(), rows: Vec::new(), held: 0, looked_at: 0 };
    source.each(&Reading::default(), &mut |item| {
        let drivable = Drivable::new(&item.scene.map);
        let samples = picked(&item.scene, &args.sample)
            .map_err(|reason| Failure::usage(format!("--sample: {}: {reason}", source.shown())))?;
        for (number, sample) in samples {
            scored.looked_at += 1;
            let input = args.counting.applied(ScoreInput::of_sample(&item.scene, sample, &drivable));
            let score = scene::score::score(&input);
            let figures = Figures::of(&score, &input, figures::actor_of(&item.scene), None);
            if args.filter.as_ref().is_some_and(|filter| !filter.holds(&figures)) {
                continue;
            }
            scored.held += 1;
            let several = item.scene.generated.as_ref().is_some_and(|g| g.samples.len() > 1);
            let number = number.filter(|_| several || args.sample != Which::Chosen);
            if args.csv.is_some() {
                scored.rows.push(table::row(&source.shown(), &item, number, &figures));
            }
            if args.json {
                scored.text.push_str(&format!("{}\n", object(source, &item, number, &score)));
            } else if args.csv.as_deref() != Some(std::path::Path::new("-")) {
                let place =
                    number.map_or_else(|| source.shown(), |n| format!("{} sample {n}", source.shown()));
                scored.text.push_str(&format!("{}\n", words::line(&place, &score)));
            }
            if let Some(folder) = copies {
                copy(folder, &item, number)?;
            }
        }
        Ok(())
    })?;
    Ok(scored)
}

/// A sample with its number; the recording has neither.
type Numbered<'a> = (Option<usize>, Option<&'a Sample>);

/// The selected samples with their numbers; without futures, only the recording.
///
/// # Errors
/// A sentence if the scene lacks the first of the samples selected by number.
fn picked<'a>(scene: &'a Scene, which: &Which) -> Result<Vec<Numbered<'a>>, String> {
    let count = scene.generated.as_ref().map_or(0, |generated| generated.samples.len());
    if let Which::These(Range { start, .. }) = which
        && *start >= count
    {
        let has = match count {
            0 => "no samples".to_owned(),
            1 => "1 sample, number 0".to_owned(),
            _ => format!("{count} samples, numbers 0 to {}", count - 1),
        };
        return Err(format!("no sample {start}; the scene has {has}"));
    }
    let Some(generated) = &scene.generated else { return Ok(vec![(None, None)]) };
    let wanted = |i: &usize| match which {
        Which::Chosen => *i == generated.chosen_sample,
        Which::All => true,
        Which::These(range) => range.contains(i),
    };
    let samples = generated.samples.iter().enumerate();
    Ok(samples.filter(|(i, _)| wanted(i)).map(|(i, sample)| (Some(i), Some(sample))).collect())
}

fn object(source: &Source, item: &Item, number: Option<usize>, score: &Score) -> Value {
    let mut object = Map::new();
    object.insert("file".into(), source.shown().into());
    object.insert("source_id".into(), json!(item.scene.meta.source_id));
    if let Some(number) = number {
        object.insert("sample".into(), json!(number));
    }
    if let Ok(Value::Object(members)) = serde_json::to_value(score) {
        object.extend(members);
    }
    Value::Object(object)
}

/// Writes the scene with this sample chosen.
fn copy(folder: &Folder, item: &Item, number: Option<usize>) -> Result<(), Failure> {
    let mut scene = item.scene.clone();
    if let (Some(generated), Some(number)) = (&mut scene.generated, number) {
        generated.chosen_sample = number;
    }
    let name = match number {
        Some(number) => format!("{}-sample{number:03}.json", item.name),
        None => format!("{}.json", item.name),
    };
    let bytes = native::write_doc(&SceneDoc::from_scene(&scene, MapForm::Inline));
    folder.write(&name, &bytes).map(drop)
}
