//! Scenes out of files: the formats of the `formats` crate behind the words that carriers use.

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

/// Pointer of faults in the part that is to be read.
const AROUND_POINTER: &str = "/query/around";

/// One scene of a file.
pub struct ReadScene {
    /// The scene.
    pub scene: Scene,
    /// What the reader changed or left out.
    pub warnings: Vec<formats::ImportWarning>,
}

/// What a file gave.
pub struct ReadFile {
    /// Scenes in order.
    pub scenes: Vec<ReadScene>,
    /// Records that are no scenes: position and reason.
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

/// The id of a format by another word that people have for it.
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

/// What may come with a file.
#[derive(Clone, Debug, Default)]
pub struct Companions {
    /// The network or map that a recording belongs to.
    pub net: Option<Arc<dyn Source>>,
    /// Which columns of a table say what.
    pub columns: Option<Arc<dyn Source>>,
    /// The file's folder: what lies there beside a table of a recording.
    pub folder: Option<FolderFiles>,
    /// The part of a map that is read; all of it when absent.
    pub around: Option<Around>,
    /// The program that makes a network of an extract of OpenStreetMap, where the carrier has one.
    pub netconvert: Option<Arc<dyn Netconvert>>,
}

/// What is to be read out of a file.
pub struct SceneFile {
    /// Id of the format.
    pub format: &'static str,
    /// What the file is called.
    name: String,
    options: ImportOptions,
}

impl SceneFile {
    /// Recognises a file from its content when `format` is `None`. `window`: scenes to pass over, and the most to
    /// take.
    ///
    /// # Errors
    /// `format-unknown`, or `invalid-field` for something beside a file that takes none.
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

    /// All of them.
    ///
    /// # Errors
    /// Why not one scene of the file can be read.
    pub fn read(&self, file: &dyn Source) -> Result<ReadFile, Problem> {
        let mut scenes = Vec::new();
        let skipped = self.each(file, |scene| {
            scenes.push(scene);
            Ok(())
        })?;
        Ok(ReadFile { scenes, skipped })
    }

    /// Hands each scene to `take` before the next one is read; gives the records that are no scenes: position and
    /// reason.
    ///
    /// # Errors
    /// Why not one scene of the file can be read, and what `take` reports.
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

/// `X,Y,RADIUS`: the circle of a map that is read.
///
/// # Errors
/// `invalid-field`.
pub fn around(text: &str) -> Result<Around, Problem> {
    text.parse().map_err(|message| Problem::of(Code::InvalidField, message).at(AROUND_POINTER))
}

/// `3` or `0..9`, both ends taken.
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
