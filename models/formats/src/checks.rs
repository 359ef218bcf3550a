//! Properties that must hold for any input. Fuzz targets run them, and so do plain tests over the fuzz
//! corpus; a violation panics.
#![allow(clippy::panic, clippy::expect_used, reason = "a panic is how a promise is reported broken")]

use crate::around::Chosen;
use crate::format::{ExportOptions, ExportedMotion, FolderFiles, ImportOptions};
use crate::native::{self, ConditionsDoc, Context, Window};
use crate::osm::extract;
use crate::problem::ReadError;
use crate::registry;
use crate::source::Source;
use crate::table::beside;
use crate::womd::{self, Options};
use scene::routes::LaneGraph;
use scene::score::{Drivable, ScoreInput, score};
use scene::{AgentType, Scene, State};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A property that must hold for any bytes. Returns whether the bytes were read; panics on a violation.
pub type Check = fn(&[u8]) -> bool;

/// Every reader by the name of its corpus in `fuzz/corpus`.
pub const TARGETS: &[(&str, Check)] = &[
    ("native", native),
    ("map", map),
    ("conditions", conditions),
    ("womd", womd),
    ("sumo-net", |bytes| sumo("sumo-net", bytes)),
    ("sumo-fcd", |bytes| sumo("sumo-fcd", bytes)),
    ("sumo-pair", |bytes| pair("sumo-fcd", bytes)),
    ("sumo", |bytes| both_ways("sumo", bytes)),
    ("opendrive", |bytes| map_of("opendrive", bytes)),
    ("lanelet2", |bytes| map_of("lanelet2", bytes)),
    ("osm", osm),
    ("commonroad", |bytes| both_ways("commonroad", bytes)),
    ("scenarionet", |bytes| both_ways("scenarionet", bytes)),
    ("gpudrive", |bytes| both_ways("gpudrive", bytes)),
    ("nocturne", |bytes| both_ways("nocturne", bytes)),
    ("csv", |bytes| recording("csv", bytes)),
    ("csv-columns", columns_pair),
    ("csv-folder", folder),
    ("parquet", |bytes| recording("parquet", bytes)),
    ("av2", |bytes| recording("av2", bytes)),
    ("av2-pair", |bytes| pair("av2", bytes)),
    ("openscenario", |bytes| recording("openscenario", bytes)),
    ("nuscenes", |bytes| recording("nuscenes", bytes)),
    #[cfg(not(target_family = "wasm"))]
    ("nuplan", |bytes| recording("nuplan", bytes)),
    ("sniff", sniff),
];

/// A document that is read is written as an equal scene, and then always as the same bytes.
///
/// # Panics
/// When it is not.
pub fn native(bytes: &[u8]) -> bool {
    let Ok(scene) = native::read(bytes) else { return false };
    let written = native::write(&scene);
    let again = native::read(&written).expect("what was written is read");
    // The first write rounds futures; from then on nothing changes.
    assert_eq!(native::write(&again), written, "writing is not stable");
    true
}

/// The network written for netconvert reads back unchanged.
///
/// # Panics
/// If it reads back differently.
pub fn osm(bytes: &[u8]) -> bool {
    let Ok(roads) = extract::read(&bytes, &mut Chosen::default()) else { return false };
    let again = extract::read(&roads.xml, &mut Chosen::default()).expect("what was written is read");
    assert_eq!(again.xml, roads.xml, "writing is not stable");
    true
}

/// For any map of a document, the lane graph and the drivable area can be built, and its road users can be
/// scored.
///
/// # Panics
/// When something cannot be derived.
pub fn map(bytes: &[u8]) -> bool {
    let Ok(scene) = native::read(bytes) else { return false };
    works(&scene);
    true
}

/// Computes everything that is derived from an opened scene.
fn works(scene: &Scene) {
    LaneGraph::new(&scene.map);
    let drivable = Drivable::new(&scene.map);
    let chosen = scene.generated.as_ref().and_then(|g| g.samples.get(g.chosen_sample));
    score(&ScoreInput::of_sample(scene, chosen, &drivable));
}

/// A record that is read is written back as an equal scene. Checksums are not verified, so that a fuzzer gets
/// past them.
///
/// # Panics
/// When it is not.
pub fn womd(bytes: &[u8]) -> bool {
    let options =
        Options { verify_crc: false, max_scenes: 4, max_decoded_bytes: 16 << 20, ..Options::default() };
    let mut read = false;
    for (scene, _) in womd::read_all(bytes, &options).into_iter().flatten() {
        let mut file = Vec::new();
        womd::write(&[&scene], &mut file, false, ExportedMotion::Log).expect("a vector takes all");
        let mut list = womd::read_all(&file, &Options::default());
        assert!(matches!(list.pop(), Some(Ok(_))), "what was written is not read");
        works(&scene);
        read = true;
    }
    read
}

/// A SUMO network or recording that is read is a scene that the native format can hold.
///
/// # Panics
/// When it is not.
pub fn sumo(format: &str, bytes: &[u8]) -> bool {
    imported(format, bytes, None)
}

/// A recording that is read in the format with this id is a scene that the native format can hold.
///
/// # Panics
/// When it is not.
pub fn recording(format: &str, bytes: &[u8]) -> bool {
    imported(format, bytes, None)
}

/// The bytes before and after the first zero byte.
fn parts(bytes: &[u8]) -> (&[u8], &[u8]) {
    let mut parts = bytes.splitn(2, |byte| *byte == 0);
    (parts.next().unwrap_or_default(), parts.next().unwrap_or_default())
}

/// A recording and its network or map, which comes first and ends with a zero byte.
///
/// # Panics
/// When a scene is read that the native format cannot hold.
pub fn pair(format: &str, bytes: &[u8]) -> bool {
    let (net, file) = parts(bytes);
    imported(format, file, Some(net))
}

/// A table in CSV and the meaning of its columns, which comes first and ends with a zero byte.
///
/// # Panics
/// When a scene is read that the native format cannot hold.
pub fn columns_pair(bytes: &[u8]) -> bool {
    let (columns, file) = parts(bytes);
    let columns = Some(Arc::new(columns.to_vec()) as Arc<dyn Source>);
    read("csv", file, &ImportOptions { max_scenes: 4, columns, ..ImportOptions::default() })
}

/// A table in CSV in its folder. Zero bytes separate the meaning of its columns (empty: to be detected), the
/// table and the other files of the folder; each file begins with its name and a line feed.
///
/// # Panics
/// When a scene is read that the native format cannot hold, or a file is used that is not beside the table.
pub fn folder(bytes: &[u8]) -> bool {
    let mut parts = bytes.split(|byte| *byte == 0);
    let columns = parts.next().filter(|columns| !columns.is_empty());
    let named = |part: &[u8]| {
        let end = part.iter().position(|byte| *byte == b'\n').unwrap_or(part.len());
        let (name, content) = part.split_at(end);
        (String::from_utf8_lossy(name).into_owned(), content.get(1..).unwrap_or_default().to_vec())
    };
    let Some((name, file)) = parts.next().map(named) else { return false };
    let files: BTreeMap<String, Vec<u8>> = parts.map(named).filter(|(other, _)| *other != name).collect();
    let beside = beside(&name, columns.as_ref().map(|columns| columns as &dyn Source), || {
        Ok::<_, std::convert::Infallible>(files.keys().cloned().collect())
    });
    let Ok(beside) = beside;
    let other = |other: String| {
        let content = files.get(&other).expect("a file of the folder is beside the table").clone();
        (other, Arc::new(content) as Arc<dyn Source>)
    };
    let folder = Some(FolderFiles { name, others: beside.into_iter().map(other).collect() });
    let columns = columns.map(|columns| Arc::new(columns.to_vec()) as Arc<dyn Source>);
    read("csv", &file, &ImportOptions { max_scenes: 4, columns, folder, ..ImportOptions::default() })
}

/// A map that is read in the format with this id is a scene that the native format can hold.
///
/// # Panics
/// When it is not.
pub fn map_of(format: &str, bytes: &[u8]) -> bool {
    imported(format, bytes, None)
}

/// A scenario that is read in the format with this id is a scene that the native format can hold; its export
/// is read again with as many road users.
///
/// # Panics
/// When it is not.
pub fn both_ways(format: &str, bytes: &[u8]) -> bool {
    let format = registry::by_id(format).expect("the format is in the table");
    let options = ImportOptions { max_scenes: 4, ..ImportOptions::default() };
    let mut read = false;
    for (scene, _) in format.import(bytes, &options).into_iter().flatten() {
        native::read(&native::write(&scene)).expect("what was written is read");
        works(&scene);
        let options = ExportOptions { motion: ExportedMotion::Log, ..ExportOptions::default() };
        // The format may be unable to hold a scene without a map.
        if let Ok(file) = format.export(&[&scene], &options) {
            let again = format.import(&file.bytes, &ImportOptions::default()).pop();
            // A map just within the limit may exceed it once its points are rounded.
            let too_complex = |error: &ReadError| error.problems.iter().all(|p| p.code == "map-too-complex");
            let is_read = again.as_ref().is_some_and(|again| again.as_ref().err().is_none_or(too_complex));
            assert!(is_read, "what was written is not read: {again:?}");
        }
        read = true;
    }
    read
}

fn imported(format: &str, bytes: &[u8], net: Option<&[u8]>) -> bool {
    let net = net.map(|net| Arc::new(net.to_vec()) as Arc<dyn Source>);
    read(format, bytes, &ImportOptions { max_scenes: 4, net, ..ImportOptions::default() })
}

fn read(format: &str, bytes: &[u8], options: &ImportOptions) -> bool {
    let mut read = false;
    // The registry adds maps that come with a table.
    let scenes = registry::import(bytes, "", format, options).into_iter().flatten();
    for (scene, _) in scenes.flatten() {
        native::read(&native::write(&scene)).expect("what was written is read");
        works(&scene);
        read = true;
    }
    read
}

/// Reads an uploaded file of unknown format in the format that detection chose.
///
/// # Panics
/// When a reader returns a scene that the native format cannot hold.
pub fn sniff(bytes: &[u8]) -> bool {
    registry::sniff(bytes, "").is_some_and(|format| imported(format.info().id, bytes, None))
}

/// Resolved conditions are within their ranges, and resolve to themselves after they are written.
///
/// # Panics
/// When they are not.
pub fn conditions(bytes: &[u8]) -> bool {
    let Ok(doc) = native::from_json::<ConditionsDoc>(bytes) else { return false };
    let start = State { x_m: 3.0, y_m: -7.0, heading_rad: 2.5, vx_mps: 4.0, vy_mps: 0.0 };
    let context = Context {
        agent_type: AgentType::Vehicle,
        start: Some(start),
        window: Window { start_s: 0.0, horizon_s: 9.0 },
    };
    let Ok(resolved) = doc.resolve("", &context) else { return false };
    let again = ConditionsDoc::from_conditions(&resolved).resolve("", &context);
    assert_eq!(again.as_ref(), Ok(&resolved), "resolved conditions do not resolve to themselves");
    true
}
