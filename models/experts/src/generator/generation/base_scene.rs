//! The scene that a call's windows are cut from.

use super::spans::Spans;
use crate::generator::extrapolation::{Guessed, extrapolated};
use crate::request::Request;
use scene::{HORIZON_STEPS, Meta, Scene};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The call's scene with every kept motion extended to the end of the last window. Also, for each agent, the
/// step from which its motion is extrapolated. `replaced` returns true for agents that get a new motion.
pub(super) fn known_to_the_end(
    request: &Request,
    replaced: impl Fn(usize) -> bool,
    spans: &Spans,
) -> (Arc<Scene>, Vec<Option<Guessed>>) {
    let scene = &request.scene;
    let start = request.start_step;
    let last = start + spans.last_start() + HORIZON_STEPS;
    let mut guessed = vec![None; scene.agents.len()];
    let agents = scene.agents.iter().enumerate().map(|(i, agent)| {
        if replaced(i) {
            return agent.clone();
        }
        let pinned = request.pinned.get(&agent.id).map(Vec::as_slice);
        let (track, since) = extrapolated(scene, agent, pinned, start, last);
        guessed[i] = since;
        scene::Agent { track: track.into(), ..agent.clone() }
    });
    let agents = agents.collect();
    (Arc::new(bare(scene, agents)), guessed)
}

/// A scene with these road users and the other parts that planning needs.
pub(super) fn bare(scene: &Scene, agents: Vec<scene::Agent>) -> Scene {
    Scene {
        id: None,
        name: String::new(),
        meta: Meta::default(),
        time: scene.time,
        map: scene.map.clone(),
        signals: scene.signals.clone(),
        agents,
        generated: None,
        extra: BTreeMap::new(),
    }
}
