//! What a road user can do, and what each of it costs by itself.

use super::super::KnownMap;
use super::super::actor::{Actor, Role};
use super::super::choice::{Choosable, medoid_costs, swept, swept_kept};
use super::super::realise::{Motion, PER_INSTANT};
use crate::planning::{INSTANTS, MODES};
use scene::geometry::obb::OrientedBox;
use scene::motion::{MotionState, Trajectory};
use scene::{AgentType, State};

/// Cost of a motion that is off the lanes all the time.
const OFF_LANES: f64 = 8.0;
/// The same for one with a corner beyond the road's edges, and how far beyond counts, metres.
const PAST_EDGES: f64 = 8.0;
const PAST_EDGE_M: f64 = 0.1;

/// What the mode that a scene is built around counts more than the others, whose probabilities sum to 1: it is
/// shown unless it is in the way, and then what is near to it.
const AROUND: f64 = 2.0;

/// The slot of the mode that is the middle of what may happen: the first, which was trained to be that where
/// there is a place to go.
pub(super) fn middle_slot(actor: &Actor) -> Option<usize> {
    let moves = actor.pinned.is_none() && !actor.keeps_its_path() && !actor.rests;
    (moves && actor.planned.target.position.is_some()).then_some(0)
}

/// How much of what was learned there is in the middle; the rest is the formula's answer, its anchor's own base.
/// Recorded road users keep nearer to the formula than simulated ones do, people on foot nearest.
pub(super) fn learned_share(actor: &Actor) -> f32 {
    match actor.planned.present.agent_type {
        AgentType::Pedestrian => 0.4,
        _ => 0.5,
    }
}

/// What an actor can do: its motions, after what it keeps (reacting) or has pinned. `around` is the slot of
/// the mode that the scene is built around.
pub(super) fn options(
    actor: &Actor,
    motions: &[(f64, usize, Motion)],
    around: Option<usize>,
    map: &KnownMap,
) -> Vec<Choosable> {
    let size = &actor.planned.present.size;
    if let Some(pinned) = &actor.pinned {
        let boxes = swept_kept(|step| pinned.get(step - 1).copied(), size);
        return vec![Choosable { boxes, cost: 0.0 }];
    }
    let all: Vec<&Trajectory> = motions.iter().map(|m| &m.2.states).collect();
    let weight = |m: &(f64, usize, Motion)| m.0 + if around == Some(m.1) { AROUND } else { 0.0 };
    let modes: Vec<(&Trajectory, f64)> =
        motions.iter().take(MODES).map(|m| (&m.2.states, weight(m))).collect();
    let mut out = Vec::with_capacity(motions.len() + 1);
    match &actor.kept {
        None => {
            for (motion, cost) in motions.iter().zip(medoid_costs(&all, &modes)) {
                // A goal missed is worse than anything but an overlap.
                let missed = if motion.2.reach.is_reached() { 0.0 } else { 3.0 };
                let off = off_road(actor, &motion.2.states, map);
                out.push(Choosable { boxes: swept(&motion.2.states, size), cost: cost + missed + off });
            }
        }
        Some(kept) => {
            let boxes = swept_kept(|step| kept.get(step - 1).copied(), size);
            out.push(Choosable { boxes, cost: 0.0 });
            for motion in motions {
                let boxes = swept(&motion.2.states, size);
                let off = off_road(actor, &motion.2.states, map);
                out.push(Choosable { boxes, cost: 0.6 + deviation_m(&motion.2.states, kept) / 4.0 + off });
            }
        }
    }
    out
}

/// A vehicle whose box lies within the road's edges at the start.
pub(super) fn starts_on_the_road(actor: &Actor, map: &KnownMap) -> bool {
    let present = &actor.planned.present;
    let outline = OrientedBox::of_state(&present.start, &present.size);
    present.agent_type == AgentType::Vehicle
        && map.drivable.box_outside_m(&outline).is_some_and(|outside| outside <= PAST_EDGE_M)
}

/// What it costs a vehicle that starts on a lane to be away from every lane, and one that starts within the
/// road's edges to have a corner beyond them.
fn off_road(actor: &Actor, states: &Trajectory, map: &KnownMap) -> f64 {
    let present = &actor.planned.present;
    if present.agent_type != AgentType::Vehicle || states.is_empty() {
        return 0.0;
    }
    let away = |s: &MotionState| map.graph.nearest_for(s.position, 2.5, present.agent_type).is_empty();
    let beyond = |s: &MotionState| {
        let outline = OrientedBox::of_state(&State::from(s), &present.size);
        map.drivable.box_outside_m(&outline).is_some_and(|outside| outside > PAST_EDGE_M)
    };
    let looked_at = || states.iter().step_by(PER_INSTANT);
    let share = |off: &dyn Fn(&MotionState) -> bool| {
        if off(&states[0]) {
            0.0
        } else {
            looked_at().filter(|s| off(s)).count() as f64 / (INSTANTS + 1) as f64
        }
    };
    OFF_LANES * share(&away) + PAST_EDGES * share(&beyond)
}

/// Mean distance of a motion from the kept one, metres.
fn deviation_m(states: &Trajectory, kept: &[State]) -> f64 {
    let pairs = states.iter().skip(1).zip(kept).step_by(5);
    let (sum, n) =
        pairs.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a.position - b.position()).norm(), n + 1.0));
    if n > 0.0 { sum / n } else { 0.0 }
}

/// Which of an actor's motions a chosen option is; `None` for what is kept or pinned.
pub(super) fn shown_motion(actor: &Actor, option: usize) -> Option<usize> {
    if actor.pinned.is_some() {
        return None;
    }
    match actor.role {
        Role::Reacting if actor.kept.is_some() => option.checked_sub(1),
        _ => Some(option),
    }
}
