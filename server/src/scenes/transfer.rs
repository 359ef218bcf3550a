//! Files in and out: the formats of the `formats` crate behind the words that routes and the command
//! line use.

use crate::base::netconvert::Installed;
use crate::base::problem::{Code, Problem};
use formats::netconvert::Netconvert;
use formats::registry::{self, FORMATS};
use formats::{COLUMNS_POINTER, ExportOptions, ExportedMotion, ImportOptions, NET_POINTER, Source, source};
use scene::Scene;
use serde::Deserialize;
use std::sync::Arc;

/// One scene of a file.
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// What the reader changed or left out.
    pub warnings: Vec<formats::Warning>,
}

/// What a file gave.
pub struct Read {
    /// Scenes in order.
    pub scenes: Vec<Imported>,
    /// Records that are no scenes: position and reason.
    pub skipped: Vec<(usize, Problem)>,
}

/// A file on its way out.
pub struct Written {
    /// Content.
    pub bytes: Vec<u8>,
    /// Media type.
    pub media_type: &'static str,
    /// With the dot.
    pub extension: String,
    /// Codes of what the format cannot hold.
    pub losses: Vec<formats::Loss>,
}

/// Which motion an export takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// Chosen futures where there are any, the log before and beside them.
    #[default]
    Chosen,
    /// The recording.
    Log,
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
        name => name,
    }
}

/// Reads a file; the format is recognised from its content when `format` is `None`. `skip` scenes
/// are passed over and at most `most` given. `beside` is what comes with the file.
///
/// # Errors
/// `format-unknown`, `invalid-field` for something beside a file that takes none, or why not one scene
/// of the file can be read.
pub fn read(
    bytes: &[u8],
    format: Option<&str>,
    name: &str,
    skip: usize,
    most: usize,
    beside: &Beside,
) -> Result<Read, Problem> {
    let wanted = Wanted::of(&bytes, format, name, beside, (skip, most))?;
    let mut scenes = Vec::new();
    let skipped = wanted.each(&bytes, |imported| {
        scenes.push(imported);
        Ok(())
    })?;
    Ok(Read { scenes, skipped })
}

/// What may come with a file.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// The network or map that a recording belongs to.
    pub net: Option<Arc<dyn Source>>,
    /// Which columns of a table say what.
    pub columns: Option<Arc<dyn Source>>,
}

/// What is to be read out of a file.
pub struct Wanted {
    /// Id of the format.
    pub format: &'static str,
    /// What the file is called.
    name: String,
    options: ImportOptions,
}

impl Wanted {
    /// Recognises a file from its content when `format` is `None`. `window`: scenes to pass over, and the most to
    /// take.
    ///
    /// # Errors
    /// `format-unknown`, or `invalid-field` for something beside a file that takes none.
    pub fn of(
        file: &dyn Source,
        format: Option<&str>,
        name: &str,
        beside: &Beside,
        (skip, most): (usize, usize),
    ) -> Result<Self, Problem> {
        let found = match format {
            Some(format) => registry::by_id(known(format)).ok_or_else(registry::unknown)?,
            None => registry::recognised(&source::head(file), name)?,
        };
        let info = found.info();
        let Beside { net, columns } = beside.clone();
        if net.is_some() && !info.takes_net {
            let detail = format!("a file of format {} comes without a network", info.id);
            return Err(Problem::field(NET_POINTER, Code::InvalidField, detail));
        }
        if columns.is_some() && !found.takes_columns() {
            let detail = format!("a file of format {} has no columns to name", info.id);
            return Err(Problem::field(COLUMNS_POINTER, Code::InvalidField, detail));
        }
        let netconvert: Option<Arc<dyn Netconvert>> = Some(Arc::new(Installed));
        let options =
            ImportOptions { skip, max_scenes: most, net, netconvert, columns, ..ImportOptions::default() };
        Ok(Self { format: info.id, name: name.to_owned(), options })
    }

    /// Hands each scene to `take` before the next one is read; gives the records that are no scenes: position and
    /// reason.
    ///
    /// # Errors
    /// Why not one scene of the file can be read, and what `take` reports.
    pub fn each(
        &self,
        file: &dyn Source,
        mut take: impl FnMut(Imported) -> Result<(), Problem>,
    ) -> Result<Vec<(usize, Problem)>, Problem> {
        let (mut skipped, mut taken) = (Vec::new(), false);
        let scenes = registry::scenes(file, &self.name, self.format, &self.options)?;
        for (index, result) in scenes.enumerate() {
            match result {
                Ok((scene, warnings)) => take(Imported { scene, warnings })?,
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

/// Writes a scene as a file.
///
/// # Errors
/// `format-unknown`, `cannot-represent`, or `out-of-range` for a sample that is not there.
pub fn write(scene: &Scene, format: &str, sample: Option<usize>, motion: Motion) -> Result<Written, Problem> {
    write_part(scene, format, sample, motion, None, false)
}

/// As [`write`], for a file of several scenes: what the scene is called there, and whether others come before it.
///
/// # Errors
/// Those of [`write`].
pub fn write_part(
    scene: &Scene,
    format: &str,
    sample: Option<usize>,
    motion: Motion,
    label: Option<String>,
    continued: bool,
) -> Result<Written, Problem> {
    let found = registry::by_id(known(format)).ok_or_else(|| {
        let shown: String = format.chars().take(40).collect();
        let detail = format!("No format is named \"{shown}\"; there are {}.", names().join(", "));
        Problem::field("/query/format", Code::FormatUnknown, detail)
    })?;
    let mut copy = None;
    if let Some(sample) = sample {
        let count = scene.generated.as_ref().map_or(0, |g| g.samples.len());
        if sample >= count.max(1) {
            return Err(Problem::range("/query/sample", 0.0, count.max(1) as f64 - 1.0, sample as f64));
        }
        let mut scene = scene.clone();
        if let Some(generated) = &mut scene.generated {
            generated.chosen_sample = sample;
        }
        copy = Some(scene);
    }
    let motion = match motion {
        Motion::Chosen => ExportedMotion::Chosen,
        Motion::Log => ExportedMotion::Log,
    };
    let options = ExportOptions { motion, gzip: false, sample, label, continued };
    let exported = found
        .export(&[copy.as_ref().unwrap_or(scene)], &options)
        .map_err(|error| Problem::new(Code::CannotRepresent, error.to_string()))?;
    let info = found.info();
    debug_assert!(
        exported.losses.iter().all(|loss| info.loses.contains(&loss.code)),
        "{:?}",
        exported.losses
    );
    Ok(Written {
        bytes: exported.bytes,
        media_type: info.media_type,
        extension: info.extensions.first().map(|e| format!(".{e}")).unwrap_or_default(),
        losses: exported.losses,
    })
}
