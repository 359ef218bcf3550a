//! Packs several files of one scene as a zip.

use crate::written::BoundedFile;
use scene::Scene;
use std::io::{self, Cursor, Read};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// Name of the files if the scene has no name that is valid for files.
const NAME: &str = "scene";
/// Longest name of the files.
const NAME_CHARS: usize = 60;

/// File name of a scene: letters, digits and dashes of its name.
pub(crate) fn file_name(scene: &Scene) -> String {
    let word = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let plain: String = scene.name.chars().map(word).collect();
    let words: Vec<&str> = plain.split('-').filter(|word| !word.is_empty()).collect();
    let name: String = words.join("-").chars().take(NAME_CHARS).collect();
    if name.is_empty() { NAME.into() } else { name }
}

/// Files of a zip that [`zip`] made, by name.
///
/// # Errors
/// A zip that is broken.
pub fn unzipped(bytes: &[u8]) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut zip = ZipArchive::new(Cursor::new(bytes))?;
    let mut files = Vec::new();
    for i in 0..zip.len() {
        let mut file = zip.by_index(i)?;
        let name = file.name()?.into_owned();
        let mut content = Vec::new();
        file.read_to_end(&mut content)?;
        files.push((name, content));
    }
    Ok(files)
}

/// Packs files by name. Equal files give equal bytes, whenever they are packed.
pub(crate) fn zip(files: Vec<(String, BoundedFile)>) -> io::Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let how = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default());
    for (name, file) in files {
        zip.start_file(name.as_str(), how)?;
        file.write_to(&mut zip)?;
    }
    Ok(zip.finish()?.into_inner())
}
