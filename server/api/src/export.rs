//! Writes scenes as files.

use crate::code::Code;
use crate::english;
use crate::import::{known, names};
use crate::problem::Problem;
use formats::refusals::file_too_long;
use formats::{ExportOptions, ExportedMotion, is_too_long, registry};
use scene::message::Message;
use scene::{Cancel, Scene};
use serde::Deserialize;

/// A written file.
pub struct WrittenFile {
    /// Content.
    pub bytes: Vec<u8>,
    /// Media type.
    pub media_type: &'static str,
    /// Extension, with the dot.
    pub extension: String,
    /// Losses: details that the format cannot hold.
    pub losses: Vec<formats::Loss>,
}

/// Which motion an export takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum MotionChoice {
    /// The chosen futures, and the recording for all else.
    #[default]
    Chosen,
    /// Only the recording.
    Log,
}

/// Limits of a file, and the position of a scene in it.
#[derive(Clone, Debug, Default)]
pub struct FilePart {
    /// Name of the scene in a file of several scenes.
    pub label: Option<String>,
    /// Whether other scenes precede it.
    pub continued: bool,
    /// Size limit of the file, bytes.
    pub most_bytes: Option<u64>,
    /// Stops the writing when nobody waits for the file any more.
    pub cancel: Cancel,
}

/// Writes a scene as a file.
///
/// # Errors
/// `format-unknown`, `cannot-represent`, `reply-too-large`, `cancelled`, or `out-of-range` for a sample that
/// does not exist.
pub fn write(
    scene: &Scene,
    format: &str,
    sample: Option<usize>,
    motion: MotionChoice,
    part: FilePart,
) -> Result<WrittenFile, Problem> {
    let found = registry::by_id(known(format)).ok_or_else(|| {
        let shown: String = format.chars().take(40).collect();
        let message = english::unknown_format(&shown, &names().join(", "));
        Problem::of(Code::FormatUnknown, message).at("/query/format")
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
        MotionChoice::Chosen => ExportedMotion::Chosen,
        MotionChoice::Log => ExportedMotion::Log,
    };
    let FilePart { label, continued, most_bytes, cancel } = part;
    let options =
        ExportOptions { motion, gzip: false, sample, label, continued, most_bytes, cancel: cancel.clone() };
    let exported = found.export(&[copy.as_ref().unwrap_or(scene)], &options).map_err(|error| {
        if cancel.is_cancelled() {
            return Problem::new(Code::Cancelled, "No client waits for the file any more.");
        }
        let message = error.get_ref().and_then(|fault| fault.downcast_ref::<Message>());
        let code = if is_too_long(&error) { Code::ReplyTooLarge } else { Code::CannotRepresent };
        let problem = Problem::new(code, error.to_string()).with(|m| m.message = message.cloned());
        if is_too_long(&error) { problem.limit(most_bytes.unwrap_or_default()) } else { problem }
    })?;
    let bytes = exported.bytes.len() as u64;
    if let Some(most) = most_bytes.filter(|most| bytes > *most) {
        return Err(Problem::of(Code::ReplyTooLarge, file_too_long(bytes, most)).limit(most));
    }
    let info = found.info();
    debug_assert!(
        exported.losses.iter().all(|loss| info.loses.contains(&loss.code)),
        "{:?}",
        exported.losses
    );
    Ok(WrittenFile {
        bytes: exported.bytes,
        media_type: info.media_type,
        extension: info.extensions.first().map(|e| format!(".{e}")).unwrap_or_default(),
        losses: exported.losses,
    })
}
