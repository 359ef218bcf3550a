//! Generation: conditions to futures, as an iterator of events.

mod apply;
mod engine;
mod plan;
mod ranges;
pub mod request;
mod run;

pub use plan::GenerationPlan;
pub use request::GenerateRequest;
pub use run::{GenerationAnswer, GenerationEvent, GenerationRun, round_ms};

use experts::{React, Request};
use scene::{Sample, Scene};

/// Number of road users that are regenerated or may react.
fn concerned(request: &Request) -> usize {
    match (&request.agents, &request.react) {
        (None, _) | (_, React::Everyone) => request.scene.agents.len() - request.scene.counts()[3],
        (Some(agents), React::Only(ids)) => agents.union(ids).count(),
        (Some(agents), React::Nobody) => agents.len(),
    }
}

/// Adds the chosen futures of road users outside the call to a sample. The plans avoid exactly these futures,
/// so the answer is coherent only with them.
fn fill(scene: &Scene, sample: &mut Sample) {
    let kept = scene.generated.as_ref().and_then(|generated| generated.samples.get(generated.chosen_sample));
    let there = |id: &String| scene.agent(id).is_some();
    for (id, futures) in kept.into_iter().flat_map(|kept| &kept.agents).filter(|(id, _)| there(id)) {
        sample.agents.entry(id.clone()).or_insert_with(|| futures.clone());
    }
}
