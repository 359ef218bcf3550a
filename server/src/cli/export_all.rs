//! `dragtraffic export-all`: writes every saved scene as a file, for users without a program that reads the
//! store.

use super::convert::{ids, writable};
use super::serve::default_db;
use super::{Common, Exit, Failure};
use crate::scenes::record;
use crate::scenes::store::{self, DumpedScene, StoreError};
use api::Problem;
use api::export::{self, FilePart, MotionChoice};
use clap::Args;
use formats::files::WholeFolder;
use formats::{native, registry};
use serde::Serialize;
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Format of the store.
const NATIVE: &str = "dragtraffic";
/// List of the files, in the same folder. Ids of scenes contain no dot.
const LIST: &str = "scenes.ndjson";

/// Flags of `export-all`.
#[derive(Args, Clone, Debug)]
pub struct ExportAllArgs {
    /// Database file of the saved scenes; a server may be using it. Default: that of serve.
    #[arg(env = "DRAGTRAFFIC_DB", value_name = "STORE")]
    db: Option<PathBuf>,
    /// Folder to make. It appears when all scenes are in it.
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[arg(long, value_name = "FORMAT", default_value = "dragtraffic", value_parser = writable, help = format!("Format of the files: {}", ids(|info| info.export)))]
    format: &'static str,
}

/// A line of the list.
#[derive(Serialize)]
struct ListLine<'a> {
    file: &'a str,
    id: &'a str,
    name: &'a str,
    etag: &'a str,
    created_at: &'a str,
    updated_at: &'a str,
    /// Codes of losses.
    losses: Vec<&'static str>,
}

/// Writes the files and their list.
///
/// # Errors
/// Exit 3 when there is no store, or a scene cannot be converted; 8 when the folder exists; else 1.
pub fn run(args: ExportAllArgs, common: &Common) -> Result<(), Failure> {
    let db = args.db.map_or_else(default_db, Ok)?;
    if !db.is_file() {
        return Err(Failure::input(format!("{}: no such file", db.display())));
    }
    let unwritten = |error| unwritten(&args.output, &error);
    let folder = WholeFolder::create(&args.output).map_err(unwritten)?;
    let extension = registry::by_id(args.format).and_then(|format| format.info().extensions.first().copied());
    let extension = extension.unwrap_or("json");
    let (mut list, mut losses, mut count) = (Vec::new(), BTreeSet::new(), 0_u64);
    store::each(&db, &mut |scene| {
        let refused = |problem: Problem| {
            let message = format!("{}: {}; nothing was exported", scene.summary.id, problem.detail);
            ExportStop(Failure::input(message))
        };
        let (bytes, lost) = written(&scene, args.format).map_err(refused)?;
        let file = format!("{}.{extension}", scene.summary.id);
        folder.add(&file, &bytes).map_err(|error| ExportStop(unwritten(error)))?;
        let line = serde_json::to_vec(&line(&scene, &file, &lost)).map_err(std::io::Error::from);
        list.extend(line.map_err(|error| ExportStop(error.into()))?);
        list.push(b'\n');
        losses.extend(lost);
        count += 1;
        Ok(())
    })
    .map_err(|ExportStop(failure)| {
        let Failure { exit, message } = failure;
        Failure { exit, message: format!("{}: {message}", db.display()) }
    })?;
    folder.add(LIST, &list).map_err(unwritten)?;
    folder.finish().map_err(unwritten)?;
    if !losses.is_empty() {
        common.say(&format!("not in {}: {}", args.format, Vec::from_iter(losses).join(", ")));
    }
    common.say(&format!("{} -> {}: {count} scenes", db.display(), args.output.display()));
    Ok(())
}

fn line<'a>(scene: &'a DumpedScene, file: &'a str, losses: &[&'static str]) -> ListLine<'a> {
    let store::SceneSummary { id, name, etag, created_at, updated_at, .. } = &scene.summary;
    ListLine { file, id, name, etag, created_at, updated_at, losses: losses.to_vec() }
}

/// A scene in a format, with the codes of its losses. The native format is the stored text.
fn written(scene: &DumpedScene, format: &str) -> Result<(Vec<u8>, Vec<&'static str>), Problem> {
    let whole = record::with_map(&scene.json, &scene.map)?;
    if format == NATIVE {
        return Ok((whole, Vec::new()));
    }
    let file =
        export::write(&native::read(&whole)?, format, None, MotionChoice::Chosen, FilePart::default())?;
    Ok((file.bytes, file.losses.iter().map(|loss| loss.code).collect()))
}

/// Why the export ended early.
struct ExportStop(Failure);

impl From<StoreError> for ExportStop {
    fn from(error: StoreError) -> Self {
        Self(Failure::new(Exit::Failure, error.to_string()))
    }
}

fn unwritten(folder: &Path, error: &std::io::Error) -> Failure {
    match error.kind() {
        ErrorKind::AlreadyExists => {
            let message = format!("{} exists; export-all makes a new folder", folder.display());
            Failure::new(Exit::OutputExists, message)
        }
        _ => Failure::new(Exit::Failure, format!("{}: {error}", folder.display())),
    }
}
