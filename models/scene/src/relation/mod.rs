//! Goals that are fixed relative to another road user: "12 m ahead of 1, 4 m/s slower, one lane left".
//!
//! [`GoalRelation`] is what a user fixed. [`faults`] checks it in its scene. [`place`] resolves it to an
//! ordinary goal once the motion of the other road user is known.

mod place;
#[cfg(test)]
mod tests;

pub use place::{OtherMotion, RelativeGoal, place};

use crate::message::Message;
use crate::{Agent, AgentId, sentences};
use serde::Serialize;
use std::collections::HashMap;

/// Longest chain of goals that are relative to each other.
pub const MAX_RELATED_IN_A_ROW: usize = 4;
/// Gap to the other road user, metres.
pub const GAP_M: (f64, f64) = (0.0, 500.0);
/// Time gap behind the other road user, seconds.
pub const GAP_S: (f64, f64) = (0.0, 20.0);
/// Delay at a place against the other road user, seconds; negative is earlier.
pub const AFTER_S: (f64, f64) = (-30.0, 30.0);
/// Difference by which the speed is lower than the other's, m/s; negative is faster.
pub const SLOWER_MPS: (f64, f64) = (-60.0, 60.0);
/// Lanes to the left of the other road user's; negative is to the right.
pub const LANES_LEFT: (f64, f64) = (-4.0, 4.0);

/// A goal relative to another road user. The goal's own fields hold the rest: its time, and its place for
/// [`RelativePlace::After`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GoalRelation {
    /// The other road user.
    pub to: AgentId,
    /// The place, or the time.
    pub place: RelativePlace,
    /// Difference by which the speed is lower than the other's, m/s; the goal's own speed takes precedence.
    pub slower_mps: f64,
    /// Lanes to the left of the other's lane; negative is to the right.
    pub lanes_left: i32,
}

/// Place or time of a goal as seen from the other road user. Gaps are between the two boxes, along the lanes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum RelativePlace {
    /// Metres ahead of it at the goal's time.
    Ahead(f64),
    /// Metres behind it at the goal's time.
    Behind(f64),
    /// Seconds behind it at the goal's time, at the speed of the goal.
    BehindBy(f64),
    /// At the goal's own place, this many seconds after the other was nearest to it.
    After(f64),
}

/// Invalid relations of these road users: index of the road user, and the sentence. A relation must name
/// another road user of the scene, and relations form no cycle and no chain of more than
/// [`MAX_RELATED_IN_A_ROW`].
pub fn faults(agents: &[Agent]) -> Vec<(usize, Message)> {
    if agents.iter().all(|agent| agent.conditions.relation.is_none()) {
        return Vec::new();
    }
    let by_id: HashMap<&str, &Agent> = agents.iter().map(|agent| (agent.id.as_str(), agent)).collect();
    let fault = |agent: &Agent| {
        let own = agent.conditions.relation.as_ref()?;
        if !by_id.contains_key(own.to.as_str()) {
            return Some(sentences::relation_unknown(&own.to.chars().take(64).collect::<String>()));
        }
        if own.to == agent.id {
            return Some(sentences::relation_to_itself());
        }
        let mut row = vec![agent.id.as_str()];
        let mut next = own.to.as_str();
        loop {
            row.push(next);
            if next == agent.id {
                return Some(sentences::relation_ring(&row.join(", ")));
            }
            let relation = by_id.get(next).and_then(|other| other.conditions.relation.as_ref())?;
            if row.len() > MAX_RELATED_IN_A_ROW {
                return Some(sentences::relation_row(MAX_RELATED_IN_A_ROW));
            }
            next = relation.to.as_str();
        }
    };
    agents.iter().enumerate().filter_map(|(i, agent)| Some((i, fault(agent)?))).collect()
}
