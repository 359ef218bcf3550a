//! Files of a scenario: the scenario, its map and its catalogs, separately or in one zip.

use crate::limits::{MAX_DECODED_BYTES, memory_for};
use crate::problem::ReadError;
use crate::refusals;
use crate::source::Source;
use crate::unpack::{self, Bounds};
use std::io::Read;

/// Memory per byte of text until it is a scene, bytes.
const TEXT_MEMORY: u64 = 8;
/// Beginning of a zip.
pub(super) const ZIP: &[u8] = b"PK\x03\x04";

/// Most bytes of a file's text.
pub(super) fn most(file: &dyn Source) -> u64 {
    MAX_DECODED_BYTES.min(memory_for(file.encoded_len()) / TEXT_MEMORY)
}

/// Files of a scenario.
#[derive(Default)]
pub(super) struct ScenarioFiles {
    /// Scenarios and catalogs with their names.
    pub texts: Vec<(String, Vec<u8>)>,
    /// Maps with their names.
    pub maps: Vec<(String, Vec<u8>)>,
}

impl ScenarioFiles {
    /// # Errors
    /// The bounds of a file, `malformed-file`.
    pub fn read(file: &dyn Source) -> Result<Self, ReadError> {
        let mut input = file.open().map_err(|error| unpack::fault(&error, 0))?;
        let mut head = Vec::new();
        let begun = input.by_ref().take(ZIP.len() as u64).read_to_end(&mut head);
        begun.map_err(|error| unpack::fault(&error, 0))?;
        let most = most(file);
        if head != ZIP {
            let mut text = Vec::new();
            let whole = std::io::Cursor::new(head).chain(input);
            let unpacked = unpack::open(whole, Bounds::of(most));
            unpacked
                .and_then(|mut input| input.read_to_end(&mut text))
                .map_err(|error| unpack::fault(&error, 0))?;
            return Ok(Self { texts: vec![(String::new(), text)], maps: Vec::new() });
        }
        drop(input);
        let mut files = Self::default();
        for (name, bytes) in
            unpack::zipped(file, most, |name| name.ends_with(".xosc") || name.ends_with(".xodr"))?
        {
            if name.ends_with(".xosc") { &mut files.texts } else { &mut files.maps }.push((name, bytes));
        }
        if files.texts.is_empty() {
            return Err(ReadError::other_content(refusals::zip_without(".xosc", ".xosc.zip")));
        }
        Ok(files)
    }

    /// The map with the name of a path.
    pub fn map(&self, path: &str) -> Option<&Vec<u8>> {
        let base = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or_default().to_ascii_lowercase();
        self.maps.iter().find(|(name, _)| base(name) == base(path)).map(|(_, bytes)| bytes)
    }
}
