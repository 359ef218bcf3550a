//! Anchors: the paths that an agent may take, before any network runs.
//!
//! With a goal position they are paths to it ([`super::to_goal`]); without one, routes ahead, each with
//! several timings. Pedestrians get straight lines besides routes.

use super::coordinates::MODES;
use super::profile::{Caps, cruising, reaching_speed};
use super::through::anchors_through;
use super::to_goal::anchors_to_goal;
use super::way::{SLOTS, paths_ahead};
use super::world::{AgentAtStart, World};
use crate::tuning::fixed::on_foot::{EVEN_MPS, FASTER, SLOWER, STROLLING_MPS};
use scene::STEP_S;
use scene::motion::{MotionKind, MotionModel, Target};

pub use super::way::{Anchor, PathKind};

/// The six anchors of a road user.
pub fn anchors(world: &World<'_>, who: &AgentAtStart, model: &MotionModel, target: &Target) -> Vec<Anchor> {
    let vias = world.waypoints(who);
    if !vias.is_empty() {
        return anchors_through(world, who, model, target, &vias);
    }
    match target.position {
        Some(goal) => anchors_to_goal(world, who, model, target, goal),
        None => anchors_ahead(world, who, model, target),
    }
}

fn anchors_ahead(world: &World<'_>, who: &AgentAtStart, model: &MotionModel, target: &Target) -> Vec<Anchor> {
    let candidates = paths_ahead(world, who, model);
    let v0 = model.start_speed_mps();
    let seconds = target.step as f64 * STEP_S;
    let slots = SLOTS[candidates.len().clamp(1, MODES) - 1];
    let mut out = Vec::with_capacity(MODES);
    for (candidate, count) in candidates.iter().zip(slots) {
        let caps = Caps::new(candidate.path.arc_m(), &candidate.caps_mps);
        for timing in 0..count {
            let share = (timing as f64 + 0.5) / count as f64;
            let base = match (target.speed_mps, model.kind) {
                (Some(speed), _) => {
                    let sag = (share - 0.5) * 0.5 * v0.max(speed).max(1.0);
                    reaching_speed(v0, speed, seconds, sag, &caps)
                }
                (None, MotionKind::Drive) => {
                    cruising(v0, share * world.tuning.anchors.over_limit * candidate.limit_mps.max(v0), &caps)
                }
                (None, MotionKind::Walk) => cruising(v0, walking_speed(v0, timing, count), &caps),
            };
            out.push(candidate.anchor(base, (timing, count)));
        }
    }
    out
}

/// Paces on foot: unchanged, standing, slower, faster, and a constant pace.
fn walking_speed(v0: f64, timing: usize, count: usize) -> f64 {
    if count == 1 {
        return v0;
    }
    [v0, 0.0, SLOWER.0 * v0 + SLOWER.1, FASTER * v0, EVEN_MPS, STROLLING_MPS][timing % 6]
}
