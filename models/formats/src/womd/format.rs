//! Scenario records as a format among others.

use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info};
use crate::identities;
use crate::problem::{Imported, ReadError};
use scene::Scene;
use std::io;

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
        }
    }

    fn sniff(&self, head: &[u8], name: &str) -> u8 {
        if super::looks_like(head) {
            return 2;
        }
        // Other tools name what they made of records after them.
        let json = matches!(head.iter().find(|byte| !byte.is_ascii_whitespace()), Some(b'{' | b'['));
        u8::from(!json && name.to_ascii_lowercase().contains("tfrecord"))
    }

    fn import(&self, bytes: &[u8], options: &ImportOptions) -> Vec<Result<Imported, ReadError>> {
        let join = options.join_identities;
        let options = super::Options {
            skip: options.skip,
            max_scenes: options.max_scenes,
            licence: options.licence.clone(),
            verify_crc: options.verify,
            ..super::Options::default()
        };
        let mut read = super::read_all(bytes, &options);
        for (scene, warnings) in read.iter_mut().flatten().filter(|_| join) {
            warnings.extend(identities::join(scene));
        }
        read
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let mut bytes = Vec::new();
        let losses = super::write(scenes, &mut bytes, options.gzip, options.motion)?;
        Ok(Exported { bytes, losses })
    }
}
