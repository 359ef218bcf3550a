//! Waymo Open Motion Dataset: reads and writes Scenario messages in TFRecord files, plain or compressed with
//! gzip.
//!
//! Import moves the origin to the ego (kept in `meta.origin`), converts miles per hour to m/s and ids to
//! strings, and keeps heights. Export adds the origin back; reading the export gives the same scene, minus
//! the [`crate::Loss`]es that the writer lists.

pub(crate) mod example;
mod export;
mod export_map;
pub(crate) mod format;
mod ids;
mod import;
mod import_map;
pub mod proto;
mod record;
pub(crate) mod rollouts;
mod wire;

pub use export::{scenario, write};
pub use import::scene;
pub use record::{MAX_RECORD_BYTES, RecordReader, TfRecord, looks_like, masked_crc, write_record};
pub use wire::MAX_TRACKS;

use crate::limits::{MAX_DECODED_BYTES, MAX_EXPANSION, MAX_SCENES};
use crate::problem::{Imported, ReadError};
use crate::refusals::{self, wanted, what};
use prost::Message;
use std::io::Read;

/// Licence of scenes from Waymo.
pub const LICENCE_WAYMO: &str = "waymo-nc";
/// Licence of our own synthetic scenes.
pub const LICENCE_OWN: &str = "cc0";
/// Prefix of the Scenario ids of our own synthetic scenes.
pub const SYNTHETIC_PREFIX: &str = "synth-";

/// Options for reading a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Number of records to skip.
    pub skip: usize,
    /// Greatest number of scenes to read; later records are not read.
    pub max_scenes: usize,
    /// Most bytes after decompression.
    pub max_decoded_bytes: u64,
    /// Most bytes of one record.
    pub max_record_bytes: u64,
    /// Greatest ratio of decompressed to compressed bytes, after the first MiB.
    pub max_expansion: u64,
    /// Whether to verify the CRCs.
    pub verify_crc: bool,
    /// Licence of the scenes; by default Waymo's, and cc0 for ids that begin with `synth-`.
    pub licence: Option<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            skip: 0,
            max_scenes: MAX_SCENES,
            max_decoded_bytes: MAX_DECODED_BYTES,
            max_record_bytes: MAX_RECORD_BYTES,
            max_expansion: MAX_EXPANSION,
            verify_crc: true,
            licence: None,
        }
    }
}

/// Reads scenes one by one from a stream of any length.
pub struct ScenarioReader<R: Read> {
    reader: RecordReader<R>,
    options: Options,
    given: usize,
}

impl<R: Read> ScenarioReader<R> {
    /// Opens a plain or gzip TFRecord stream.
    ///
    /// # Errors
    /// `malformed-file` when the reader fails.
    pub fn new(input: R, options: Options) -> Result<Self, ReadError> {
        let reader = RecordReader::new(input, &options)?;
        Ok(Self { reader, options, given: 0 })
    }
}

impl<R: Read> Iterator for ScenarioReader<R> {
    type Item = Result<Imported, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.options.skip > 0 {
            self.options.skip -= 1;
            if let Err(error) = self.reader.next()? {
                // A fault in a skipped record matters only if no record can follow it.
                if self.reader.has_ended() {
                    return Some(Err(error));
                }
            }
        }
        if self.given >= self.options.max_scenes {
            return None;
        }
        let record = self.reader.next()?;
        self.given += 1;
        Some(record.and_then(|record| read_record(&record, &self.options)))
    }
}

/// Reads a whole file in memory. One entry per record; a broken record does not stop the others.
pub fn read_all(bytes: &[u8], options: &Options) -> Vec<Result<Imported, ReadError>> {
    match ScenarioReader::new(bytes, options.clone()) {
        Ok(records) => records.collect(),
        Err(error) => vec![Err(error)],
    }
}

/// Whether the record is a tf.Example: its field 1 contains a message of messages under field 1. A Scenario
/// has a list of doubles there, the first of which is near zero.
fn is_example(data: &[u8]) -> bool {
    let Some(rest) = data.strip_prefix(&[0x0a]) else { return false };
    let length = rest.iter().position(|byte| byte & 0x80 == 0).map_or(0, |last| last + 1);
    matches!(rest.get(length), None | Some(0x0a))
}

/// Reads one record's message.
///
/// # Errors
/// `malformed-file` with the byte for broken protobuf; the faults of a scene otherwise.
pub fn read_record(record: &TfRecord, options: &Options) -> Result<Imported, ReadError> {
    if is_example(&record.data) {
        return Err(ReadError::other_content(refusals::expected(wanted::SCENARIO_RECORD)));
    }
    wire::check(&record.data, record.offset)?;
    let scenario = proto::Scenario::decode(record.data.as_slice()).map_err(|error| {
        ReadError::malformed(record.offset, refusals::unreadable("Scenario", &error.to_string()))
    })?;
    if scenario.tracks.is_empty() && scenario.map_features.is_empty() {
        return Err(ReadError::other_content(refusals::file_has_no(what::TRACKS_OR_MAP)));
    }
    scene(scenario, options)
}
