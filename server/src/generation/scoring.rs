//! Scores of scenes, with the map's index kept between calls.

use scene::score::{Drivable, ScoreInput};
use scene::{ContentHash, Sample, Scene};
use serde_json::Value;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Map indices kept.
const KEPT: usize = 16;

type Kept = Vec<(ContentHash, Arc<Drivable>)>;

/// The index of a scene's map, built once a map.
pub fn drivable(scene: &Scene) -> Arc<Drivable> {
    static CACHE: OnceLock<Mutex<Kept>> = OnceLock::new();
    let cache = CACHE.get_or_init(Mutex::default);
    let hash = scene.map.hash();
    let found = |kept: &Kept| kept.iter().find(|(key, _)| *key == hash).map(|(_, value)| Arc::clone(value));
    if let Some(known) = found(&cache.lock().unwrap_or_else(PoisonError::into_inner)) {
        return known;
    }
    let built = Arc::new(Drivable::new(&scene.map));
    let mut kept = cache.lock().unwrap_or_else(PoisonError::into_inner);
    if kept.len() >= KEPT {
        kept.remove(0);
    }
    kept.push((hash, Arc::clone(&built)));
    built
}

/// Score of one sample of an answer: its futures, the chosen futures of road users that were kept,
/// and the log of the rest.
pub fn sample(scene: &Scene, sample: &Sample) -> Value {
    let mut all = sample.clone();
    let kept = scene.generated.as_ref().and_then(|g| g.samples.get(g.chosen_sample));
    for (id, futures) in kept.into_iter().flat_map(|s| &s.agents) {
        all.agents.entry(id.clone()).or_insert_with(|| futures.clone());
    }
    let drivable = drivable(scene);
    let score = scene::score::score(&ScoreInput::of_sample(scene, Some(&all), &drivable));
    serde_json::to_value(score).unwrap_or(Value::Null)
}
