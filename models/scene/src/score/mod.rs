//! Scores of whole scenes: collisions and near misses, distance and time to collision, post-encroachment
//! time, off-road and wrong-way driving, red-light violations, kinematic limits, goals met, distance from the
//! log.
//!
//! [`score`] takes a [`ScoreInput`] and returns a [`Score`], which serialises to the reply of `POST
//! /v1/score`. Equal inputs give equal scores, member for member: agents in the given order, pairs by (first,
//! second), lists by time.

pub mod accuracy;
mod baseline_score;
pub mod drivable;
pub mod goal;
pub mod input;
pub mod kinematic;
pub(crate) mod lane_rules;
pub mod meeting;
pub mod overlap;
pub mod pairs;
pub mod pet;
pub(crate) mod recorded;
pub mod report;
pub mod road;
pub mod signals;
mod single;
pub(crate) mod walking;

pub use baseline_score::BaselineScore;
pub use drivable::Drivable;
pub use input::{Actor, Exclude, PairChoice, ScoreInput, Threshold, Thresholds};
pub use overlap::{
    CLOSE_M, Overlap, SweptBounds, SweptBoxes, comes_within, dangerous_moments, overlap, tailgating_moments,
};
pub use report::{AgentScore, SceneScore, Score};

use pairs::PairScores;
use single::Single;

/// Scores a scene. Costs a few milliseconds for 128 agents over 91 steps on one core.
pub fn score(input: &ScoreInput<'_>) -> Score {
    let lines = signals::stop_lines(input);
    let singles = input.actors.iter().map(|actor| Single::of(input, actor, &lines));
    put_together(input, singles, pairs::score_pairs(input))
}

/// Combines the scores of single road users and pairs.
fn put_together(
    input: &ScoreInput<'_>,
    singles: impl IntoIterator<Item = Single>,
    pairs: PairScores,
) -> Score {
    let mut scene = SceneScore::default();
    let each = singles.into_iter().zip(&pairs.agents);
    let agents: Vec<AgentScore> = each.map(|(single, totals)| single.add_to(&mut scene, totals)).collect();
    scene.finish(input, pairs, &agents);
    let ids = input.actors.iter().map(|a| a.id.to_owned());
    Score { scene, agents: ids.zip(agents).collect(), thresholds: input.thresholds }
}

#[cfg(test)]
pub(crate) mod tests;
