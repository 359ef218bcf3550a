//! Names and notes of a scene, shortened to what a scene can hold: files from other tools hold more.

use crate::problem::{FieldProblem, ReadError};
use crate::refusals::{self, what};
use scene::Meta;

/// Most bytes of a text about the source of a scene, and most entries of a list of road users.
const MAX_TEXT: usize = 256;
const MAX_ENTRIES: usize = 256;
/// Greatest distance between the origin of a scene and that of its source, metres.
const MAX_ORIGIN_M: f64 = 1e9;

fn cut(text: &mut String) {
    let end = (0..=MAX_TEXT.min(text.len())).rev().find(|end| text.is_char_boundary(*end));
    text.truncate(end.unwrap_or_default());
}

/// The same metadata with shortened texts and lists.
///
/// # Errors
/// `out-of-range` for an origin beyond all coordinates.
pub(crate) fn fitted(mut meta: Meta) -> Result<Meta, ReadError> {
    cut(&mut meta.source);
    [&mut meta.source_id, &mut meta.licence].into_iter().flatten().for_each(cut);
    meta.objects_of_interest.truncate(MAX_ENTRIES);
    meta.tracks_to_predict.truncate(MAX_ENTRIES);
    let origin = &meta.origin;
    let held = |value: &f64| (-MAX_ORIGIN_M..=MAX_ORIGIN_M).contains(value);
    let far = [origin.x_m, origin.y_m, origin.z_m].into_iter().find(|value| !held(value));
    match far {
        Some(value) => {
            let [least, most, found] = [-MAX_ORIGIN_M, MAX_ORIGIN_M, value].map(|v| v.to_string());
            let message = refusals::range_outside(what::ORIGIN, &found, &least, &most);
            Err(FieldProblem::range_of("", -MAX_ORIGIN_M, MAX_ORIGIN_M, value, message).into())
        }
        None => Ok(meta),
    }
}
