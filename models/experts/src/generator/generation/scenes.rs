//! The scenes that windows are planned from: who is where at their start.

use super::Spans;
use super::ledger::Ledger;
use super::roster::{Part, Roster};
use crate::generator::extrapolation::{Guessed, extrapolated};
use crate::request::Request;
use scene::geometry::direction;
use scene::{AgentType, HORIZON_STEPS, Meta, Scene, Start, State, Track};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The scene as it stands where a later window starts, at `step`: each road user's track is what it has reached (or,
/// kept, what it does in the window), and what was fixed about starts is behind.
pub(super) fn reached(base: &Scene, roster: &Roster, ledger: &Ledger, step: usize) -> Scene {
    let agents = base.agents.iter().enumerate().map(|(i, agent)| {
        let progress = ledger.progress(i).filter(|_| !roster.follows_its_pick(i, step));
        let mut states: Vec<Option<State>> = match progress {
            Some(progress) => vec![progress.executed.last().copied()],
            None => (step..=step + HORIZON_STEPS).map(|at| agent.track.at(at).copied()).collect(),
        };
        // A recorded velocity is left as it is: its sideways part is noise.
        let made = progress.is_some() || roster.part(i) == Part::Continues;
        let on_foot = agent.kind() == AgentType::Pedestrian;
        if let Some(Some(first)) = states.first_mut()
            && made
            && !on_foot
        {
            *first = rolling(first);
        }
        let mut conditions = agent.conditions.clone();
        conditions.start = Start::default();
        scene::Agent {
            id: agent.id.clone(),
            role: None,
            track: Track { first_step: step, states, z_m: None }.into(),
            conditions,
            ..*agent
        }
    });
    bare(base, agents.collect())
}

/// The call's scene with the motion of those that keep theirs known to the end of the last window, and from where
/// on that is a guess, one entry an agent. `replaced` are those that do not keep theirs.
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

/// A scene of these road users, with what planning needs of the rest.
fn bare(scene: &Scene, agents: Vec<scene::Agent>) -> Scene {
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

/// A reached state as the start of the next window. The box centre of what drives swings out in a bend;
/// its wheels' own speed, which goes on unbroken, is the part along the heading.
fn rolling(state: &State) -> State {
    let ahead = direction(state.heading_rad);
    let velocity = ahead * state.velocity().dot(&ahead);
    State { vx_mps: velocity.x, vy_mps: velocity.y, ..*state }
}
