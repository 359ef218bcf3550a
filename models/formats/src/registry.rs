//! One table of formats, for the server, the command line and the documentation.

use crate::av2::Argoverse;
use crate::commonroad::format::CommonRoad;
use crate::format::{Format, GroundMaps, ImportOptions, Info, NET_POINTER, Scenes};
use crate::foxglove::Mcap;
use crate::geojson::GeoJson;
use crate::gpudrive::format::{GPUDRIVE, NOCTURNE};
use crate::html::Page;
use crate::kinds;
use crate::lanelet2::format::LANELET2;
use crate::limits::MAX_DECODED_BYTES;
use crate::loss::Loss;
use crate::native;
use crate::native::format::NativeJson;
#[cfg(not(target_family = "wasm"))]
use crate::nuplan::format::NuPlanLog;
use crate::nuscenes::format::NuScenesTables;
use crate::opendrive::format::OPENDRIVE;
use crate::openscenario::format::OpenScenario;
use crate::osm::format::OsmExtract;
use crate::osm_items::holds_lanelets;
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError, code};
use crate::refusals;
use crate::scenarionet::format::ScenarioNet;
use crate::sentences;
use crate::source::{Source, head, without_mark};
use crate::sumo::folder::SumoFolder;
use crate::sumo::formats::{SUMO_NET, SumoFcd};
use crate::table::TableFormat;
use crate::unpack::{self, Bounds, has_word};
use crate::womd::example::WomdExample;
use crate::womd::format::Womd;
use crate::womd::rollouts::SimAgents;
use scene::Scene;
use scene::message::Message;
use std::fmt::Write as _;
use std::sync::Arc;

/// File name endings of compressed files.
const COMPRESSED: [&str; 2] = ["gz", "zst"];

/// From this confidence on, a format recognises a file by its content.
const BY_CONTENT: u8 = 2;

/// All formats, the native one first.
pub static FORMATS: &[&dyn Format] = &[
    &NativeJson,
    &Womd,
    &WomdExample,
    &SimAgents,
    &SUMO_NET,
    &SumoFcd,
    &SumoFolder,
    &OPENDRIVE,
    &OpenScenario,
    &LANELET2,
    &OsmExtract,
    &CommonRoad,
    &ScenarioNet,
    &GPUDRIVE,
    &NOCTURNE,
    &TableFormat::Csv,
    &TableFormat::Parquet,
    &Argoverse,
    &NuScenesTables,
    #[cfg(not(target_family = "wasm"))]
    &NuPlanLog,
    &GeoJson,
    &Page,
    &Mcap,
];

/// The table of all formats in Markdown: what is read and written, what a file holds and what it may lack.
pub fn markdown() -> String {
    let mut table = String::from(
        "| format | id, ends of names | read | write | notes | what a written file may lack |\n|---|---|---|---|---|---|\n",
    );
    let is = |yes: bool| if yes { "yes" } else { "no" };
    for info in FORMATS.iter().map(|format| format.info()) {
        let ends: Vec<String> = info.extensions.iter().map(|end| format!("`.{end}`")).collect();
        let lacks = if info.export { info.loses.join(", ") } else { "-".to_owned() };
        let lacks = if lacks.is_empty() { "nothing".to_owned() } else { lacks };
        let (read, write) = (is(info.import), is(info.export));
        let _ = writeln!(
            table,
            "| {} | `{}` {} | {read} | {write} | {} | {lacks} |",
            info.name,
            info.id,
            ends.join(" "),
            info.notes
        );
    }
    table
}

/// The format with this id.
pub fn by_id(id: &str) -> Option<&'static dyn Format> {
    FORMATS.iter().copied().find(|format| format.info().id == id)
}

/// The most likely format of a file with this beginning. `name` is a label only; it is never opened.
pub fn sniff(bytes: &[u8], name: &str) -> Option<&'static dyn Format> {
    recognised(bytes, name).ok()
}

/// The most likely format, or the reason why there is none: other known kinds of files are named.
///
/// # Errors
/// `format-unknown`.
pub fn recognised(bytes: &[u8], name: &str) -> Result<&'static dyn Format, ReadError> {
    let bytes = without_mark(bytes);
    let scored = FORMATS.iter().map(|format| (format.sniff(bytes, name), *format));
    let best = scored.filter(|(score, _)| *score > 0).max_by_key(|(score, _)| *score);
    if let Some((BY_CONTENT.., format)) = best {
        return Ok(format);
    }
    // Content counts more than the file name.
    let ends: Vec<&str> = FORMATS.iter().flat_map(|format| format.info().extensions).copied().collect();
    if let Some(refusal) = kinds::refusal(bytes, name, &ends) {
        return Err(refusal);
    }
    match best {
        Some((_, format)) => Ok(format),
        None if bytes.trim_ascii_start().starts_with(b"[") => Err(refused(refusals::json_array())),
        None => Err(unknown()),
    }
}

/// The format of a file by its beginning; by its whole content if two formats begin alike.
///
/// # Errors
/// `format-unknown`.
pub fn identified(file: &dyn Source, name: &str) -> Result<&'static dyn Format, ReadError> {
    let head = head(file);
    // A compressed file that is broken at its beginning has no head either.
    if head.len() as u64 == file.encoded_len() && without_mark(&head).trim_ascii().is_empty() {
        return Err(refused(refusals::empty_file()));
    }
    let found = match recognised(&head, name) {
        // Programs that sort the members of JSON write the format after all road users.
        Err(_) if begins_object(&head) && holds_scene(file) => &NativeJson,
        found => found?,
    };
    let alike: [&'static dyn Format; 2] = [&LANELET2, &OsmExtract];
    if alike.iter().any(|format| format.info().id == found.info().id) {
        return Ok(alike[usize::from(!holds_lanelets(file))]);
    }
    Ok(found)
}

fn begins_object(head: &[u8]) -> bool {
    without_mark(head).trim_ascii_start().starts_with(b"{")
}

/// Whether a file names the format of our own scenes at any place.
fn holds_scene(file: &dyn Source) -> bool {
    let input = file.open().and_then(|input| unpack::open(input, Bounds::of(MAX_DECODED_BYTES)));
    input.is_ok_and(|input| has_word(input, native::FORMAT.as_bytes()))
}

/// Reads a file in memory of the given format (`auto` looks at its content and name).
///
/// # Errors
/// `format-unknown`; faults of single scenes are in the list.
pub fn import(
    bytes: &[u8],
    name: &str,
    format: &str,
    options: &ImportOptions,
) -> Result<Vec<Result<Imported, ReadError>>, ReadError> {
    let options = grounded(&bytes, name, format, options)?;
    Ok(scenes(&bytes, name, format, &options)?.collect())
}

/// Reads lazily: each scene on demand, with the maps of [`grounded`] options under tables.
///
/// # Errors
/// `format-unknown`.
pub fn scenes<'a>(
    file: &'a dyn Source,
    name: &str,
    format: &str,
    options: &'a ImportOptions,
) -> Result<Scenes<'a>, ReadError> {
    let found = of_id(file, name, format)?;
    let called = called(name, &found.info());
    let named = move |(mut scene, warnings): Imported| {
        if scene.name.is_empty() {
            scene.name.clone_from(&called);
        }
        (scene, warnings)
    };
    Ok(Box::new(found.scenes(file, options).map(move |scene| scene.map(&named))))
}

/// The format with this id; for `auto`, that of the file.
fn of_id(file: &dyn Source, name: &str, id: &str) -> Result<&'static dyn Format, ReadError> {
    if id == "auto" { identified(file, name) } else { by_id(id).ok_or_else(unknown) }
}

/// The options with the maps for a file of road users, for [`scenes`]: the map that is given for a table
/// ([`ImportOptions::net`]), otherwise the maps that come with the file. Of the latter, an unreadable map is
/// skipped with a warning.
///
/// # Errors
/// `format-unknown`, those of the map under [`NET_POINTER`], a broken file that should contain maps.
pub fn grounded(
    file: &dyn Source,
    name: &str,
    format: &str,
    options: &ImportOptions,
) -> Result<ImportOptions, ReadError> {
    let ground = Arc::new(ground(of_id(file, name, format)?, file, options)?);
    Ok(ImportOptions { ground, ..options.clone() })
}

fn ground(format: &dyn Format, file: &dyn Source, options: &ImportOptions) -> Result<GroundMaps, ReadError> {
    let mut ground = GroundMaps::default();
    match &options.net {
        Some(net) if format.takes_columns() => {
            ground.maps.push(place(net, "", options).map_err(|error| error.under(NET_POINTER))?);
        }
        _ => {
            let maps = format.maps(file, options)?;
            ground.warnings = maps.warnings;
            for (name, map) in maps.files {
                match place(map.as_ref(), &name, options) {
                    Ok(map) => ground.maps.push(map),
                    Err(error) => {
                        let why = error.problems.first().map_or("", |problem| problem.detail.as_str());
                        let message = sentences::map_unread(&name, why);
                        ground.warnings.push(ImportWarning::new("map-unread", message));
                    }
                }
            }
        }
    }
    Ok(ground)
}

/// A scene with the map of a location.
fn place(map: &dyn Source, name: &str, options: &ImportOptions) -> Result<Scene, ReadError> {
    let format = identified(map, name)?;
    let options = ImportOptions { netconvert: options.netconvert.clone(), ..ImportOptions::default() };
    let empty = || refused(sentences::not_a_known_format(format.info().id));
    let mut scene = format.scenes(map, &options).next().ok_or_else(empty)??.0;
    scene.name = called(name, &format.info());
    if scene.map.lanes.is_empty() {
        return Err(ReadError::other_content(refusals::file_has_no(refusals::what::LANE)));
    }
    Ok(scene)
}

/// Name of a file without the extensions of formats and compression.
pub fn stem(name: &str) -> &str {
    let formats = FORMATS.iter().flat_map(|format| format.info().extensions);
    let ends: Vec<&str> = formats.chain(&COMPRESSED).copied().collect();
    let mut stem = name;
    // The longest ending first: nothing of `net.xml` may remain as `net`.
    let shorter = |stem: &str| ends.iter().filter_map(|end| without(stem, end)).min();
    while let Some(length) = shorter(stem) {
        stem = stem.get(..length).unwrap_or_default();
    }
    stem
}

/// Length of a name without this ending and the dot before it; nothing if that would be the whole name.
fn without(name: &str, end: &str) -> Option<usize> {
    let length = name.len().checked_sub(end.len() + 1).filter(|length| *length > 0)?;
    let behind = name.get(length..)?.strip_prefix('.')?;
    behind.eq_ignore_ascii_case(end).then_some(length)
}

/// Name of a scene without one in its file: the file's name, otherwise that of the format.
fn called(file: &str, info: &Info) -> String {
    let file: String = file.chars().filter(|c| !c.is_control()).collect();
    let stem = stem(file.rsplit(['/', '\\']).next().unwrap_or_default()).trim();
    let name = if stem.is_empty() { info.name } else { stem };
    name.chars().take(scene::MAX_NAME_CHARS).collect()
}

/// `format-unknown`.
pub fn unknown() -> ReadError {
    let known: Vec<&str> = FORMATS.iter().map(|f| f.info()).filter(|f| f.import).map(|f| f.id).collect();
    refused(sentences::not_a_known_format(&known.join(", ")))
}

fn refused(message: Message) -> ReadError {
    FieldProblem::new("", code::FORMAT_UNKNOWN, message).into()
}

/// Loss codes as the header `Dragtraffic-Loss` lists them.
pub fn loss_header(losses: &[Loss]) -> String {
    let mut codes: Vec<&str> = losses.iter().map(|loss| loss.code).collect();
    codes.dedup();
    codes.join(", ")
}

/// Losses with their sentences and numbers as the header `Dragtraffic-Losses` lists them: JSON in ASCII.
pub fn losses_header(losses: &[Loss]) -> String {
    let text = serde_json::to_string(losses).unwrap_or_default();
    let mut ascii = String::with_capacity(text.len());
    let mut units = [0; 2];
    for c in text.chars() {
        if c.is_ascii() {
            ascii.push(c);
        } else {
            c.encode_utf16(&mut units).iter().for_each(|unit| ascii.push_str(&format!("\\u{unit:04x}")));
        }
    }
    ascii
}
