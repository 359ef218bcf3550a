//! Losses that several writers share.

use crate::format::ExportedMotion;
use crate::loss::{Loss, code};
use crate::sentences;
use scene::{Agent, Scene, Start};

/// Whether a condition fixes more than boxes and states hold. Types, sizes and the starts of futures are
/// among these.
pub(crate) fn is_fixed(scene: &Scene, agent: &Agent, motion: ExportedMotion) -> bool {
    let mut rest = agent.conditions.clone();
    if motion == ExportedMotion::Chosen {
        (rest.agent_type, rest.length_m, rest.width_m) = (None, None, None);
        let generated = scene.generated.as_ref();
        if generated.is_some_and(|g| g.chosen_future(&agent.id).is_some()) {
            rest.start = Start::default();
        }
    }
    !rest.is_empty()
}

/// Loss of conditions, in a file that holds only boxes and states.
pub(crate) fn conditions(scene: &Scene, motion: ExportedMotion) -> Option<Loss> {
    let lost = scene.agents.iter().any(|agent| is_fixed(scene, agent, motion));
    let detail = match motion {
        ExportedMotion::Chosen => "goals, and starts of road users that were not generated from them",
        ExportedMotion::Log => "types, sizes, starts and goals that the user fixed",
    };
    lost.then(|| Loss::new(code::NO_CONDITIONS, detail))
}

/// Losses of futures, in a file with one motion for each road user.
pub(crate) fn futures(scene: &Scene, motion: ExportedMotion) -> Vec<Loss> {
    let Some(generated) = &scene.generated else { return Vec::new() };
    let mut losses = Vec::new();
    if motion == ExportedMotion::Chosen {
        losses.push(Loss::new(code::NO_GENERATED, "read again, generated motion counts as recorded"));
    }
    let mut futures = generated.samples.iter().flat_map(|s| s.agents.values());
    if motion == ExportedMotion::Log || generated.samples.len() > 1 || futures.any(|f| f.modes.len() > 1) {
        losses.push(Loss::new(code::NO_MODES, "generated futures other than the exported one"));
    }
    losses
}

/// Loss of a file with more steps than the scene.
pub(crate) fn length(scene: &Scene, steps: usize) -> Option<Loss> {
    let known = scene.time.steps;
    (steps > known).then(|| Loss::counted(code::LONG_RECORD, sentences::loss_longer(steps, known)))
}

/// Loss of name, tags, notes and the like, in a file that is named `id` and has no place for them.
pub(crate) fn notes(scene: &Scene, id: &str) -> Option<Loss> {
    let lost = !scene.meta.tags.is_empty() || is_noted(scene, id);
    lost.then(|| Loss::new(code::NO_NOTES, "name, tags, notes and members of other tools"))
}

/// Whether the scene has notes, a parent, extra members or a name other than its id.
pub(crate) fn is_noted(scene: &Scene, id: &str) -> bool {
    let meta = &scene.meta;
    !meta.notes.is_empty() || meta.parent_id.is_some() || scene.name != id || !scene.extra.is_empty()
}
