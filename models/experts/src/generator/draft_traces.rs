//! Traces of drafts, for relations, before drafts are fitted to the motion limits.

use super::actor::PlannedActor;
use super::slot::Slot;
use super::trajectory::places;
use crate::planning::{INSTANTS, Modes, PER_INSTANT};
use scene::judge::Trace;
use scene::{HORIZON_STEPS, STEP_S, State, Vec2, wrap_angle};

/// The trace of a draft, straight between instants.
pub(super) fn trace_of(actor: &PlannedActor, places: &[(Vec2, f64); INSTANTS]) -> Trace {
    let present = &actor.plan.present;
    let knot = |i: usize| match i {
        0 => (present.start.position(), present.start.heading_rad),
        i => places[i - 1],
    };
    let at = |step: usize| {
        let (i, share) = (step / PER_INSTANT, (step % PER_INSTANT + 1) as f64 / PER_INSTANT as f64);
        let ((from, h0), (to, h1)) = (knot(i), knot(i + 1));
        let position = from + (to - from) * share;
        let heading_rad = h0 + share * wrap_angle(h1 - h0);
        let velocity = (to - from) / (PER_INSTANT as f64 * STEP_S);
        Some(State { x_m: position.x, y_m: position.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y })
    };
    Trace::new(&actor.id, present.agent_type, &present.size, HORIZON_STEPS, at)
}

/// The trace of one mode of an actor; that of its start if it rests.
pub(super) fn trace_of_mode(actor: &PlannedActor, slot: Slot, modes: &Modes) -> Trace {
    let start = &actor.plan.present.start;
    if actor.rests {
        return trace_of(actor, &[(start.position(), start.heading_rad); INSTANTS]);
    }
    trace_of(actor, &places(&actor.plan, slot, slot.of(modes)))
}
