//! Reads scenes from files: the formats of the `formats` crate under the names that transports use.

use crate::code::Code;
use crate::english;
use crate::problem::Problem;
use formats::around::Around;
use formats::netconvert::Netconvert;
use formats::registry::{self, FORMATS};
use formats::{COLUMNS_POINTER, FolderFiles, ImportOptions, NET_POINTER, Source};
use scene::Scene;
use std::ops::Range;
use std::sync::Arc;

/// Pointer of faults in `around`.
const AROUND_POINTER: &str = "/query/around";

/// One scene of a file.
pub struct ReadScene {
    /// The scene.
    pub scene: Scene,
    /// Changes and omissions of the reader.
    pub warnings: Vec<formats::ImportWarning>,
}

/// The result of reading a file.
pub struct ReadFile {
    /// Scenes in order.
    pub scenes: Vec<ReadScene>,
    /// Records that are not scenes: index and reason.
    pub skipped: Vec<(usize, Problem)>,
}

/// Ids of all formats.
pub fn names() -> Vec<&'static str> {
    FORMATS.iter().map(|format| format.info().id).collect()
}

/// The formats for `/v1/info`.
pub fn table() -> Vec<formats::format::Info> {
    FORMATS.iter().map(|format| format.info()).collect()
}

/// The id of a format, if `name` is a common alias.
pub fn known(name: &str) -> &str {
    match name {
        "scene" | "json" | "native" => "dragtraffic",
        "waymo" | "tfrecord" => "womd",
        "fcd" => "sumo-fcd",
        "net" => "sumo-net",
        "table" => "csv",
        "xosc" => "openscenario",
        "xodr" => "opendrive",
        name => name,
    }
}

/// Inputs that accompany a file.
#[derive(Clone, Debug, Default)]
pub struct Companions {
    /// The network or map that a recording belongs to.
    pub net: Option<Arc<dyn Source>>,
    /// Meaning of a table's columns.
    pub columns: Option<Arc<dyn Source>>,
    /// The file's folder, with the other tables of a recording.
    pub folder: Option<FolderFiles>,
    /// The part of a map to read; everything if absent.
    pub around: Option<Around>,
    /// The program that converts an OpenStreetMap extract to a network, if the transport has one.
    pub netconvert: Option<Arc<dyn Netconvert>>,
}

/// What to read from a file.
pub struct SceneFile {
    /// Id of the format.
    pub format: &'static str,
    /// Name of the file.
    name: String,
    options: ImportOptions,
}

impl SceneFile {
    /// Detects the format from the content if `format` is `None`. `window` is the number of scenes to skip,
    /// and the most to read.
    ///
    /// # Errors
    /// `format-unknown`, or `invalid-field` for an accompanying input that the format does not accept.
    pub fn of(
        file: &dyn Source,
        format: Option<&str>,
        name: &str,
        beside: &Companions,
        (skip, most): (usize, usize),
    ) -> Result<Self, Problem> {
        let found = match format {
            Some(format) => registry::by_id(known(format)).ok_or_else(registry::unknown)?,
            None => registry::identified(file, name)?,
        };
        let info = found.info();
        let Companions { net, columns, folder, around, netconvert } = beside.clone();
        if net.is_some() && !info.takes_net {
            return Err(Problem::of(Code::InvalidField, english::no_network(info.id)).at(NET_POINTER));
        }
        if columns.is_some() && !found.takes_columns() {
            return Err(Problem::of(Code::InvalidField, english::no_columns(info.id)).at(COLUMNS_POINTER));
        }
        if around.is_some() && !found.takes_around() {
            return Err(Problem::of(Code::InvalidField, english::no_part(info.id)).at(AROUND_POINTER));
        }
        let options = ImportOptions {
            skip,
            max_scenes: most,
            net,
            netconvert,
            columns,
            folder,
            around,
            ..ImportOptions::default()
        };
        Ok(Self { format: info.id, name: name.to_owned(), options })
    }

    /// Reads all scenes.
    ///
    /// # Errors
    /// Why no scene of the file can be read.
    pub fn read(&self, file: &dyn Source) -> Result<ReadFile, Problem> {
        let mut scenes = Vec::new();
        let skipped = self.each(file, |scene| {
            scenes.push(scene);
            Ok(())
        })?;
        Ok(ReadFile { scenes, skipped })
    }

    /// Passes each scene to `take` before it reads the next one. Returns the records that are not scenes:
    /// index and reason.
    ///
    /// # Errors
    /// Why no scene of the file can be read, and the errors of `take`.
    pub fn each(
        &self,
        file: &dyn Source,
        mut take: impl FnMut(ReadScene) -> Result<(), Problem>,
    ) -> Result<Vec<(usize, Problem)>, Problem> {
        let (mut skipped, mut taken) = (Vec::new(), false);
        let options = registry::grounded(file, &self.name, self.format, &self.options)?;
        let scenes = registry::scenes(file, &self.name, self.format, &options)?;
        for (index, result) in scenes.enumerate() {
            match result {
                Ok((scene, warnings)) => take(ReadScene { scene, warnings })?,
                Err(error) => {
                    skipped.push((self.options.skip + index, Problem::from(error)));
                    continue;
                }
            }
            taken = true;
        }
        if !taken && !skipped.is_empty() {
            return Err(skipped.swap_remove(0).1);
        }
        Ok(skipped)
    }
}

/// Parses `X,Y,RADIUS`, the circle of a map to read.
///
/// # Errors
/// `invalid-field`.
pub fn around(text: &str) -> Result<Around, Problem> {
    text.parse().map_err(|message| Problem::of(Code::InvalidField, message).at(AROUND_POINTER))
}

/// Parses `3` or `0..9`, both ends included.
pub fn range(text: &str) -> Result<Range<usize>, Problem> {
    let wrong = || Problem::field("/query/index", Code::InvalidField, "a number or FIRST..LAST expected");
    let number = |s: &str| s.trim().parse::<usize>().ok().filter(|n| *n < 1_000_000_000).ok_or_else(wrong);
    match text.split_once("..") {
        None => number(text).map(|n| n..n + 1),
        Some((first, last)) => {
            let (first, last) = (number(first)?, number(last)?);
            if last < first { Err(wrong()) } else { Ok(first..last + 1) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::range;

    #[test]
    fn index_ranges() {
        assert_eq!(range("3").ok(), Some(3..4));
        assert_eq!(range("0..9").ok(), Some(0..10));
        for bad in ["", "a", "-1", "5..2", "1..", "..3", "99999999999999999999"] {
            assert!(range(bad).is_err(), "{bad}");
        }
    }
}
