//! Road rules that a vehicle's motion keeps or breaks.

use super::actor::PlannedActor;
use super::trajectory::Rollout;
use crate::features::agent::BEYOND_M;
use crate::planning::PER_INSTANT;
use crate::tuning::ChoiceTuning;
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::motion::MotionState;
use scene::score::Drivable;
use scene::{AgentType, STANDING_MPS, State};

/// Whether the actor is a vehicle whose box lies within the road's edges at the start.
pub(super) fn starts_on_the_road(actor: &PlannedActor, tuning: &ChoiceTuning) -> bool {
    let present = &actor.plan.present;
    let outline = OrientedBox::of_state(&present.start, &present.size);
    present.agent_type == AgentType::Vehicle
        && actor.plan.drivable.box_outside_m(&outline).is_some_and(|outside| outside <= tuning.past_edge_m)
}

/// Whether a vehicle moves against the traffic of its lane.
pub(super) fn drives_against(ground: &Drivable, state: &MotionState) -> bool {
    let moves = state.speed_mps() > STANDING_MPS;
    moves && ground.is_wrong_way(state.position, direction(state.heading_rad)) == Some(true)
}

/// Whether a vehicle on the road leaves it although its goal, if any, lies on it.
pub(super) fn leaves_the_road(actor: &PlannedActor, motion: &Rollout) -> bool {
    let Some(ground) = &actor.plan.ground else { return false };
    let is_off = |state: &MotionState| {
        let outline = OrientedBox::of_state(&State::from(state), &actor.plan.present.size);
        ground.box_outside_m(&outline).is_some_and(|m| m > BEYOND_M)
    };
    let goal = actor.plan.target.position.and_then(|_| motion.states.get(actor.plan.target.step));
    !goal.is_some_and(is_off) && motion.states.iter().step_by(PER_INSTANT).any(is_off)
}

/// Whether a vehicle on the road drives against the traffic.
pub(super) fn is_against_traffic(actor: &PlannedActor, motion: &Rollout) -> bool {
    let ground = actor.plan.ground.as_deref();
    ground.is_some_and(|ground| {
        motion.states.iter().step_by(PER_INSTANT).any(|state| drives_against(ground, state))
    })
}
