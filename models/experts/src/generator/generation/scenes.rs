//! The scene at the start of a later window, made of the states that the earlier windows reached.

use super::base_scene::bare;
use super::ledger::Ledger;
use super::roster::{CallPart, Roster};
use scene::geometry::direction;
use scene::{AgentType, HORIZON_STEPS, Scene, Start, State, Track};

/// The scene at the start of a later window, at `step`. Each road user's track is what it has reached, or its
/// kept motion in the window. Conditions on starts are dropped: they are in the past.
pub(super) fn reached(base: &Scene, roster: &Roster, ledger: &Ledger, step: usize) -> Scene {
    let agents = base.agents.iter().enumerate().map(|(i, agent)| {
        let progress = ledger.progress(i).filter(|_| !roster.follows_its_pick(i, step));
        let mut states: Vec<Option<State>> = match progress {
            Some(progress) => vec![progress.executed.last().copied()],
            None => (step..=step + HORIZON_STEPS).map(|at| agent.track.at(at).copied()).collect(),
        };
        // A recorded velocity is not changed: its lateral part is noise.
        let made = progress.is_some() || roster.part(i) == CallPart::Continues;
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

/// A reached state as the start of the next window. In a bend the box centre swings out; the wheels' own
/// speed, which is continuous, is the part along the heading.
fn rolling(state: &State) -> State {
    let ahead = direction(state.heading_rad);
    let velocity = ahead * state.velocity().dot(&ahead);
    State { vx_mps: velocity.x, vy_mps: velocity.y, ..*state }
}
