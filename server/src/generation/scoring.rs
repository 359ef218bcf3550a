//! Scores of answers.

use crate::scenes::Standings;
use scene::score::{PairChoice, Score, ScoreInput, Thresholds};

/// Score of an input in which so many road users move otherwise than in the scene of the standings.
pub fn of(input: &ScoreInput<'_>, changed: usize, standings: Option<&Standings>) -> Score {
    let usual = input.pairs == PairChoice::default() && input.thresholds == Thresholds::default();
    // Where most have changed, what stands saves nothing.
    match standings.filter(|_| usual && 2 * changed <= input.actors.len()) {
        Some(standings) => standings.over(&input.steps, input.drivable).score(input),
        None => scene::score::score(input),
    }
}
