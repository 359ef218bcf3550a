//! Whether the recording contains an event of a pair.

use super::mover::Mover;
use super::{Pair, PairBounds, Touch, look_at};
use crate::STEP_S;
use crate::score::input::{Actor, ScoreInput};
use std::borrow::Cow;

/// Greatest time difference to the log's event for the same event, seconds.
pub const SAME_S: f64 = 1.0;
/// Greatest excess depth over the log's overlap for the same overlap, metres.
const SAME_DEPTH_M: f64 = 0.1;
/// Greatest difference to the log's gap for the same near miss, metres.
pub const SAME_GAP_M: f64 = 0.5;

/// The pair as it was recorded; `None` without a recording of both.
pub(super) fn logged(input: &ScoreInput<'_>, a: &Actor<'_>, b: &Actor<'_>) -> Option<(Mover, Mover)> {
    let of_log = |actor: &Actor<'_>| {
        let log = actor.log.filter(|log| log.states.iter().any(Option::is_some))?;
        let track = Cow::Borrowed(log);
        Some(Mover::new(&Actor { track, generated: false, ..actor.clone() }, input.steps.clone()))
    };
    Some((of_log(a)?, of_log(b)?))
}

/// Whether the collision, else the overlap, else the near miss of this pair belongs to the log. Either both
/// move as recorded, or the log has an equally near event at about the same time. A collision of generated
/// motion never belongs to the log.
pub(super) fn is_in_log(input: &ScoreInput<'_>, a: &Actor<'_>, b: &Actor<'_>, pair: &Pair) -> bool {
    if !a.generated && !b.generated {
        return true;
    }
    if pair.collision.is_some() {
        return false;
    }
    let Some((p, q)) = logged(input, a, b) else { return false };
    let log = look_at(input, &p, &q, PairBounds::NOTHING);
    if let Some(touch) = &pair.touch {
        let as_deep = |l: Touch| touch.depth_m <= l.depth_m + SAME_DEPTH_M;
        return log.collision.is_some() || log.touch.is_some_and(as_deep);
    }
    let Some(found) = &pair.near else { return false };
    let near = |at: f64, first: f64, last: f64| {
        let same = SAME_S / STEP_S;
        (first - same..=last + same).contains(&at)
    };
    let at = found.step as f64;
    let same = |l: &super::near::Nearest| {
        near(at, l.first as f64, l.last as f64) && found.gap.gap_m >= l.gap.gap_m - SAME_GAP_M
    };
    let hit = log.collision.as_ref();
    hit.is_some_and(|l| near(at, l.first, l.last)) || log.near.as_ref().is_some_and(same)
}
