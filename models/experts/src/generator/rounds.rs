//! Rounds with feedback: the next cards are selected from a wide draw.

use crate::request::{Answer, React, Request};
use scene::preference::{Candidate, Feedback, choose as next_cards};
use scene::{AgentFutures, Sample};

/// Selects the next cards from a wide draw. With one regenerated agent and no reactions a card is a future,
/// otherwise a sample.
pub(super) fn choose(request: &Request, feedback: &Feedback, answer: &mut Answer) {
    let alone = request.agents.as_ref().filter(|agents| agents.len() == 1 && request.react == React::Nobody);
    let only = alone.and_then(|agents| agents.first());
    let candidates = match only {
        Some(id) => Candidate::futures(&request.scene, &answer.samples, id),
        None => Candidate::scenes(&request.scene, &answer.samples),
    };
    let round = next_cards(&candidates, feedback, request.modes, request.seed);
    let taken = round.taken.iter().map(|i| &candidates[*i]);
    answer.samples = match only {
        Some(id) => {
            let future = |(candidate, share): (&Candidate, &f64)| {
                let futures = answer.samples.get(candidate.sample)?.agents.get(id)?;
                let mut future = futures.modes.get(candidate.mode?)?.clone();
                future.probability = *share;
                Some(future)
            };
            let modes: Vec<_> = taken.zip(&round.shares).filter_map(future).collect();
            let agents = (!modes.is_empty()).then(|| (id.clone(), AgentFutures::of(0, modes)));
            vec![Sample { agents: agents.into_iter().collect(), ..Sample::default() }]
        }
        None => taken.filter_map(|candidate| answer.samples.get(candidate.sample).cloned()).collect(),
    };
    answer.round = Some(round);
}
