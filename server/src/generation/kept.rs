//! Futures that a scene has from earlier calls: whoever is not part of this one was planned around with them,
//! so the answer is coherent with them alone.

use scene::{Sample, Scene};

/// Puts the chosen futures of those who are not part of an answer into its sample.
pub fn fill(scene: &Scene, sample: &mut Sample) {
    let kept = scene.generated.as_ref().and_then(|generated| generated.samples.get(generated.chosen_sample));
    let there = |id: &String| scene.agent(id).is_some();
    for (id, futures) in kept.into_iter().flat_map(|kept| &kept.agents).filter(|(id, _)| there(id)) {
        sample.agents.entry(id.clone()).or_insert_with(|| futures.clone());
    }
}
