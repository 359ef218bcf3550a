//! Pairs that belong together: pedestrians walking in company, a truck and its trailer. Their contact is no
//! fault, because boxes exceed the bodies, or because they are coupled.

use super::mover::Mover;
use crate::geometry::obb::signed_gap;
use crate::{AgentType, STEP_S};

/// Greatest distance between the centres of pedestrians in company, metres.
const COMPANY_M: f64 = 1.5;
/// Greatest difference of their velocities, m/s.
const COMPANY_MPS: f64 = 0.7;
/// Time before and after a moment over which company is determined, seconds.
const COMPANY_S: f64 = 2.0;
/// Shorter company is an encounter, seconds.
const LEAST_COMPANY_S: f64 = 1.0;
/// Greatest gap between a truck and its trailer, metres.
const HITCH_M: f64 = 0.5;
/// Greatest change of the distance of their centres in bends, metres.
const HITCH_PLAY_M: f64 = 1.0;
/// Shortest distance that they drive together, metres: cars of a standing queue are no trailers.
const HITCH_TRAVEL_M: f64 = 2.0;

/// Whether two walkers keep together around this step. They are near each other and equally fast, walking or
/// standing, for most of two seconds before and after. Before the first step, which nobody knows, they kept
/// together if they do so at that step: a couple that parts within the first second was in company before.
pub(super) fn walk_together(a: &Mover, b: &Mover, step: usize) -> bool {
    if a.agent_type != AgentType::Pedestrian || b.agent_type != AgentType::Pedestrian {
        return false;
    }
    let around = (COMPANY_S / STEP_S) as usize;
    let (first, end) = (step.saturating_sub(around), (step + around + 1).min(a.moments.len()));
    let (mut seen, mut together) = (0usize, 0usize);
    for (k, (p, q)) in a.moments[first..end].iter().zip(&b.moments[first..end]).enumerate() {
        let (Some(p), Some(q)) = (p, q) else { continue };
        let near = (p.outline.center() - q.outline.center()).norm() <= COMPANY_M;
        let same = near && (p.velocity - q.velocity).norm() <= COMPANY_MPS;
        let unknown = if first + k == 0 { around.saturating_sub(step) } else { 0 };
        seen += 1 + unknown;
        together += if same { 1 + unknown } else { 0 };
    }
    together as f64 * STEP_S >= LEAST_COMPANY_S && 2 * together > seen
}

/// Whether they are a truck and its trailer: two vehicle boxes that drive and always stay adjacent.
pub(super) fn are_hitched(a: &Mover, b: &Mover) -> bool {
    let vehicles = a.agent_type == AgentType::Vehicle && b.agent_type == AgentType::Vehicle;
    if !vehicles || a.travel_m < HITCH_TRAVEL_M || b.travel_m < HITCH_TRAVEL_M {
        return false;
    }
    let (mut seen, mut least_m, mut most_m) = (0usize, f64::INFINITY, 0f64);
    for (p, q) in a.moments.iter().zip(&b.moments) {
        let (Some(p), Some(q)) = (p, q) else { continue };
        let apart_m = (p.outline.center() - q.outline.center()).norm();
        (least_m, most_m) = (least_m.min(apart_m), most_m.max(apart_m));
        if most_m - least_m > HITCH_PLAY_M || signed_gap(&p.outline, &q.outline) > HITCH_M {
            return false;
        }
        seen += 1;
    }
    seen as f64 * STEP_S >= LEAST_COMPANY_S
}
