//! `dragtraffic convert`, also known as `import` and `export`: converts files between formats.

mod one;

use super::inputs::{Inputs, Item, Reading, Source, notes};
use super::output::{self, Folder};
use super::progress::Progress;
use super::tally::Tally;
use super::{Common, Exit, Failure, parallel, values};
use api::export::{self, FilePart, MotionChoice, WrittenFile};
use api::import::{self, Companions};
use base::netconvert::companions;
use clap::Args;
use formats::around::Around;
use formats::format::Info;
use formats::registry::{self, FORMATS};
use one::{One, too_many};
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

/// Flags of `convert`.
#[derive(Args, Clone, Debug)]
pub struct ConvertArgs {
    #[command(flatten)]
    inputs: Inputs,
    /// File to write, or a folder (DIR/) for one file per scene; - is standard output. Formats that hold many
    /// scenes (womd, csv) take all of them in one file.
    #[arg(short, long, value_name = "FILE|DIR/")]
    output: Option<PathBuf>,
    #[arg(long, value_name = "FORMAT", default_value = "dragtraffic", value_parser = writable, help = format!("Format of the output: {}", ids(|info| info.export)))]
    to: &'static str,
    #[arg(long, value_name = "FORMAT", value_parser = readable, help = format!("Format of the input; recognised from its content when absent: {}", ids(|info| info.import)))]
    from: Option<&'static str>,
    /// Road network of a SUMO recording, map of an Argoverse scenario, or map under a table.
    #[arg(long, value_name = "FILE")]
    net: Option<PathBuf>,
    /// JSON file that maps the columns of a table to the names of this program, with units and factors; or a data set
    /// whose columns are known: citysim, exid, highd, ind, interaction, ngsim, pneuma, round, sind.
    #[arg(long, value_name = "FILE|SET")]
    columns: Option<PathBuf>,
    /// Part of a map to read: what lies within RADIUS metres of X,Y in the coordinates of the file (longitude,latitude
    /// where it has degrees). Lanes end at the circle.
    #[arg(long, value_name = "X,Y,RADIUS", value_parser = values::around, allow_hyphen_values = true)]
    around: Option<Around>,
    /// Scenes to take from each file, counted from 0: a number, or FIRST..LAST (both included). Default: all.
    #[arg(long, value_name = "WHICH", value_parser = values::index)]
    index: Option<Range<usize>>,
    /// Sample of the generated futures, counted from 0. Default: the chosen one; in csv, all.
    #[arg(long, value_name = "N")]
    sample: Option<usize>,
    /// Motion to write.
    #[arg(long, value_enum, default_value_t)]
    mode: MotionChoice,
    /// Write nothing and exit with 5 if the format cannot hold a detail.
    #[arg(long)]
    strict: bool,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// Id of a format that can be written.
///
/// # Errors
/// The names of these formats.
pub(super) fn writable(text: &str) -> Result<&'static str, String> {
    format_of(text, "written", |info| info.export)
}

fn readable(text: &str) -> Result<&'static str, String> {
    format_of(text, "read", |info| info.import)
}

fn format_of(text: &str, done: &str, can: fn(&Info) -> bool) -> Result<&'static str, String> {
    let id = import::known(text);
    let found = FORMATS.iter().map(|format| format.info()).find(|info| can(info) && info.id == id);
    found.map(|info| info.id).ok_or_else(|| format!("{} can be {done}", ids(can)))
}

/// Ids of the formats that satisfy `can`.
pub(super) fn ids(can: fn(&Info) -> bool) -> String {
    let infos = FORMATS.iter().map(|format| format.info()).filter(can);
    infos.map(|info| info.id).collect::<Vec<_>>().join(", ")
}

/// Codes of losses, with one sentence each.
type Losses = BTreeMap<&'static str, String>;

/// The result of one file.
#[derive(Default)]
struct Converted {
    /// The parts for a single output file; empty if the scenes went to separate files.
    parts: Vec<Vec<u8>>,
    losses: Losses,
    lines: Vec<String>,
    /// Whether it is read later, in its turn: a file of many scenes for a single output.
    deferred: bool,
}

/// Converts files to another format.
///
/// # Errors
/// Exit 2, 3, 4, 5, 8.
pub fn convert(args: ConvertArgs, common: &Common) -> Result<(), Failure> {
    let file = |path: &Option<PathBuf>| {
        let bytes = path.as_deref().map(output::read).transpose()?;
        Ok::<_, Failure>(bytes.map(|bytes| Arc::new(bytes) as Arc<dyn formats::Source>))
    };
    // A file of that name takes precedence over a data set.
    let named = args.columns.as_deref().filter(|path| !path.exists()).and_then(|path| path.to_str());
    let columns = match named.and_then(formats::table::preset) {
        Some(text) => Some(Arc::new(text.as_bytes()) as Arc<dyn formats::Source>),
        None => file(&args.columns)?,
    };
    let sources = args.inputs.sources_by(columns.as_deref())?;
    let beside = Companions { net: file(&args.net)?, columns, around: args.around, ..companions() };
    let reading = Reading { from: args.from.map(str::to_owned), beside, index: args.index.clone() };
    let progress = Progress::new("files", sources.len() as u64, common.quiet);
    let mut losses = Losses::new();
    let mut tally = Tally::default();
    let only = sources.len() == 1;
    let mut note = |converted: &Converted| {
        common.listed(converted.lines.clone(), "notes").iter().for_each(|line| progress.line(line));
        for (code, detail) in &converted.losses {
            losses.entry(code).or_insert_with(|| detail.clone());
        }
    };
    let mut failed = None;
    match args.output.as_deref().filter(|path| Folder::named(path)) {
        Some(path) => {
            let folder = Folder::new(path, args.force)?;
            let work = |source: &Source| to_folder(source, &args, &reading, &folder);
            parallel::in_order(&sources, args.inputs.workers(), work, |_, converted| {
                tally.add(converted.map(|converted| note(&converted)), only, &progress);
                progress.step();
            });
        }
        None => {
            let mut one = One::create(&args)?;
            if !(one.many || only) {
                return Err(too_many());
            }
            let work = |source: &Source| to_one(source, &args, &reading);
            parallel::in_order(&sources, args.inputs.workers(), work, |source, converted| {
                let taken = converted.and_then(|converted| {
                    note(&converted);
                    converted.parts.iter().try_for_each(|part| one.add(part))?;
                    if converted.deferred {
                        streamed(source, &args, &reading, &mut one, &mut note)
                    } else {
                        Ok(())
                    }
                });
                if let Err(failure @ Failure { exit: Exit::Usage | Exit::Lossy | Exit::Failure, .. }) = &taken
                {
                    failed.get_or_insert_with(|| failure.clone());
                }
                tally.add(taken, only, &progress);
                progress.step();
            });
            // An output that cannot be complete is not written at all.
            if let (Some(failure), false) = (failed, only) {
                return Err(failure);
            }
            let ended = tally.end("files");
            if ended.as_ref().is_err_and(|failure| failure.exit != Exit::Partly) {
                return ended;
            }
            one.finish()?;
            drop(progress);
            tell(&losses, only, &args, common);
            return ended;
        }
    }
    drop(progress);
    tell(&losses, only, &args, common);
    tally.end("files")
}

/// Lists the losses once: as sentences for one file, by code for many.
fn tell(losses: &Losses, only: bool, args: &ConvertArgs, common: &Common) {
    if only {
        let lines = losses.iter().map(|(code, detail)| format!("not in {}: {code}: {detail}", args.to));
        common.listed(lines.collect(), "losses").iter().for_each(|line| common.say(line));
    } else if !losses.is_empty() {
        let codes: Vec<&str> = losses.keys().copied().collect();
        common.say(&format!("not in {}: {}", args.to, codes.join(", ")));
    }
}

/// A scene in the requested format.
fn written(
    item: &Item,
    args: &ConvertArgs,
    continued: bool,
    converted: &mut Converted,
) -> Result<WrittenFile, Failure> {
    let part = FilePart { label: Some(item.name.clone()), continued, ..FilePart::default() };
    let written = export::write(&item.scene, args.to, args.sample, args.mode, part)
        .map_err(|problem| sample_missing(args, problem))?;
    for loss in &written.losses {
        converted.losses.entry(loss.code).or_insert_with(|| loss.detail.clone());
    }
    if args.strict && !written.losses.is_empty() {
        let codes: Vec<&str> = written.losses.iter().map(|loss| loss.code).collect();
        let message = format!(
            "{}: nothing written: --strict was given and {} would be lost",
            item.name,
            codes.join(", ")
        );
        return Err(Failure::new(Exit::Lossy, message));
    }
    Ok(written)
}

fn sample_missing(args: &ConvertArgs, problem: api::Problem) -> Failure {
    match args.sample {
        Some(sample) => Failure::usage(format!("--sample {sample}: {}", problem.detail)),
        None => Failure::usage(problem.detail),
    }
}

/// One file per scene.
fn to_folder(
    source: &Source,
    args: &ConvertArgs,
    reading: &Reading,
    folder: &Folder,
) -> Result<Converted, Failure> {
    let extension = registry::by_id(args.to).and_then(|format| format.info().extensions.first().copied());
    let extension = extension.unwrap_or("json");
    let mut converted = Converted::default();
    let (mut first, mut notes) = (None, 0);
    let count = source.each(reading, &mut |item| {
        notes += item.notes.len();
        let file = written(&item, args, false, &mut converted)?;
        let path = folder.write(&format!("{}.{extension}", item.name), &file.bytes)?;
        first.get_or_insert(path);
        Ok(())
    })?;
    let first = first.map_or_else(String::new, |path| path.display().to_string());
    let many = if count > 1 { format!(" and {} more", count - 1) } else { String::new() };
    let noted = if notes > 0 { format!(" ({notes} notes of the reader)") } else { String::new() };
    converted.lines.push(format!("{}: {first}{many}{noted}", source.shown()));
    Ok(converted)
}

/// The parts of one file for the single output.
fn to_one(source: &Source, args: &ConvertArgs, reading: &Reading) -> Result<Converted, Failure> {
    let mut converted = Converted::default();
    let mut count = 0;
    let read = source.each(reading, &mut |item| {
        count += 1;
        if count > 1 {
            // Only one file of many scenes is in memory at a time, so this one waits for its turn.
            converted = Converted { deferred: true, ..Converted::default() };
            return Err(Failure::new(Exit::Failure, ""));
        }
        converted.lines.extend(notes(source, &item.notes));
        let file = written(&item, args, true, &mut converted)?;
        converted.parts.push(scenario_alone(args, file.bytes)?);
        Ok(())
    });
    if converted.deferred { Ok(converted) } else { read.map(|_| converted) }
}

/// For an output named `.xosc`: the scenario without its zip, and beside it the map that it names.
fn scenario_alone(args: &ConvertArgs, bytes: Vec<u8>) -> Result<Vec<u8>, Failure> {
    let output = args.output.as_deref();
    let named = output.filter(|path| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("xosc")));
    let Some(path) = named.filter(|_| args.to == "openscenario") else { return Ok(bytes) };
    let broken = |error: std::io::Error| Failure::new(Exit::Failure, error.to_string());
    let mut scenario = Vec::new();
    for (name, bytes) in formats::unzipped(&bytes).map_err(broken)? {
        if name.ends_with(".xosc") {
            scenario = bytes;
        } else {
            output::write(Some(&path.with_file_name(name)), &bytes, args.force)?;
        }
    }
    Ok(scenario)
}

/// Writes a file of many scenes to the output, one scene after the other.
fn streamed(
    source: &Source,
    args: &ConvertArgs,
    reading: &Reading,
    one: &mut One,
    note: &mut dyn FnMut(&Converted),
) -> Result<(), Failure> {
    let read = source.each(reading, &mut |item| {
        let mut converted = Converted::default();
        converted.lines.extend(notes(source, &item.notes));
        let file = written(&item, args, true, &mut converted)?;
        note(&converted);
        one.add(&file.bytes)
    });
    read.map(drop)
}
