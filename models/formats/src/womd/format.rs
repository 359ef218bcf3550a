//! Scenario records as an import and export format.

use super::MAX_RECORD_BYTES;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, one};
use crate::limits::memory_for;
use crate::loss;
use crate::source::Source;
use crate::written::BoundedFile;
use crate::{identities, unpack};
use scene::Scene;
use std::io;

/// Memory per byte of a record until it is a scene, bytes.
const RECORD_MEMORY: u64 = 4;

/// Waymo Open Motion Scenario records.
pub struct Womd;

impl Format for Womd {
    fn info(&self) -> Info {
        Info {
            id: "womd",
            name: "Waymo Open Motion Scenario (TFRecord)",
            media_type: "application/octet-stream",
            extensions: &["tfrecord", "tfrecord.gz"],
            import: true,
            export: true,
            many: true,
            takes_net: false,
            notes: "Road users with their states, lanes with their surroundings, signals, and the road users \
                 to be predicted. Checksums are verified. Plain or gzip.",
            loses: &[
                loss::code::NO_CONDITIONS,
                loss::code::NO_GENERATED,
                loss::code::NO_MODES,
                loss::code::NO_SUBTYPE,
                loss::code::NO_ROLES,
                loss::code::NO_LICENCE,
                loss::code::NO_NOTES,
                loss::code::NO_DRIVABLE,
                loss::code::NO_LANE_WIDTH,
                loss::code::NO_LANE_TYPE,
                loss::code::LONG_RECORD,
                loss::code::IDS_RENUMBERED,
            ],
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if super::looks_like(head) {
            return 2;
        }
        // Other tools name files that they derive from records after them.
        let json = matches!(head.iter().find(|byte| !byte.is_ascii_whitespace()), Some(b'{' | b'['));
        u8::from(!json && name.to_ascii_lowercase().contains("tfrecord"))
    }

    fn scenes<'a>(&'a self, file: &'a dyn Source, options: &'a ImportOptions) -> Scenes<'a> {
        let join = options.join_identities;
        let options = super::Options {
            skip: options.skip,
            max_scenes: options.max_scenes,
            licence: options.licence.clone(),
            verify_crc: options.verify,
            max_record_bytes: MAX_RECORD_BYTES.min(memory_for(file.encoded_len()) / RECORD_MEMORY),
            ..super::Options::default()
        };
        let records = file.open().map_err(|error| unpack::fault(&error, 0));
        let records = match records.and_then(|input| super::ScenarioReader::new(input, options)) {
            Ok(records) => records,
            Err(error) => return one(Err(error)),
        };
        Box::new(records.map(move |read| {
            read.map(|(mut scene, mut warnings)| {
                if join {
                    warnings.extend(identities::join(&mut scene));
                }
                (scene, warnings)
            })
        }))
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let mut file = BoundedFile::new(options.bounds());
        let losses = super::write(scenes, &mut file, options.gzip, options.motion)?;
        Ok(Exported { bytes: file.whole()?, losses })
    }
}
