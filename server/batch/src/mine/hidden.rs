//! Pedestrians hidden from a vehicle.

use scene::geometry::direction;
use scene::score::meeting::MeetingPair;
use scene::score::{Actor, ScoreInput};
use scene::{AgentType, STEP_S, State, Vec2};

/// Time before the smallest distance in which visibility is checked, seconds.
const BEFORE_S: f64 = 4.0;
/// Shortest hidden time that counts, seconds.
const LEAST_S: f64 = 0.5;
/// Greatest time between the two at the crossing, seconds.
const MEETS_S: f64 = 4.0;
/// A pedestrian farther away than this is not considered, metres.
const FAR_M: f64 = 50.0;
/// Distance of the driver's eye behind the vehicle's front, as a share of its length.
const DRIVER: f64 = 0.15;
/// Lowest speed of the vehicle, m/s.
const DRIVES_MPS: f64 = 2.0;

/// Time for which another road user hides a crossing pedestrian from the vehicle, before the two are nearest,
/// seconds.
pub(super) fn hidden_s(
    input: &ScoreInput<'_>,
    actor: &Actor<'_>,
    other: &Actor<'_>,
    pair: &MeetingPair,
) -> Option<f64> {
    let (walker, vehicle) = match (actor.agent_type, other.agent_type) {
        (AgentType::Pedestrian, AgentType::Vehicle) => (actor, other),
        (AgentType::Vehicle, AgentType::Pedestrian) => (other, actor),
        _ => return None,
    };
    pair.measures.pet_s.filter(|pet_s| *pet_s <= MEETS_S)?;
    let first = pair.step.saturating_sub((BEFORE_S / STEP_S) as usize).max(input.steps.start);
    let is_hidden = |step: &usize| {
        let (Some(own), Some(seen)) = (vehicle.state(*step), walker.state(*step)) else { return false };
        let eye = own.position() + direction(own.heading_rad) * (DRIVER * vehicle.size.length_m);
        let moves = own.speed_mps() >= DRIVES_MPS && (seen.position() - eye).norm() <= FAR_M;
        moves && input.actors.iter().any(|by| hides(by, *step, [vehicle, walker], eye, seen))
    };
    let steps = (first..=pair.step).filter(is_hidden).count();
    Some(steps as f64 * STEP_S).filter(|hidden_s| *hidden_s >= LEAST_S - 1e-6)
}

/// Whether a vehicle is in the line of sight.
fn hides(by: &Actor<'_>, step: usize, pair: [&Actor<'_>; 2], eye: Vec2, seen: &State) -> bool {
    by.agent_type == AgentType::Vehicle
        && pair.iter().all(|of| of.id != by.id)
        && by.outline(step).is_some_and(|outline| outline.meets_segment(eye, seen.position()))
}
