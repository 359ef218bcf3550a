//! Scores of answers.

use crate::scenes::Standings;
use scene::score::{Drivable, PairChoice, Score, ScoreInput, Thresholds};
use scene::{Sample, Scene};

/// Score of one sample of an answer: its futures, the chosen futures of road users that were kept,
/// and the log of the rest.
pub fn sample(scene: &Scene, sample: &Sample, drivable: &Drivable, standings: Option<&Standings>) -> Score {
    let mut all = sample.clone();
    super::kept::fill(scene, &mut all);
    of(&ScoreInput::of_sample(scene, Some(&all), drivable), sample.agents.len(), standings)
}

/// Score of an input in which so many road users move otherwise than in the scene of the standings.
pub fn of(input: &ScoreInput<'_>, changed: usize, standings: Option<&Standings>) -> Score {
    let usual = input.pairs == PairChoice::default() && input.thresholds == Thresholds::default();
    // Where most have changed, what stands saves nothing.
    match standings.filter(|_| usual && 2 * changed <= input.actors.len()) {
        Some(standings) => standings.over(&input.steps, input.drivable).score(input),
        None => scene::score::score(input),
    }
}
