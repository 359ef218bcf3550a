//! Scores of scenes, with the map's index kept between calls.

use crate::base::cache::Cache;
use scene::score::{Drivable, Score, ScoreInput};
use scene::{ContentHash, Sample, Scene};
use std::sync::{Arc, OnceLock};

/// Map indices kept.
const KEPT: usize = 16;

/// The index of a scene's map, built once a map.
pub fn drivable(scene: &Scene) -> Arc<Drivable> {
    static CACHE: OnceLock<Cache<ContentHash, Arc<Drivable>>> = OnceLock::new();
    let cache = CACHE.get_or_init(|| Cache::new(KEPT));
    let hash = scene.map.hash();
    cache.get(&hash).unwrap_or_else(|| {
        let built = Arc::new(Drivable::new(&scene.map));
        cache.put(hash, Arc::clone(&built));
        built
    })
}

/// Score of one sample of an answer: its futures, the chosen futures of road users that were kept,
/// and the log of the rest.
pub fn sample(scene: &Scene, sample: &Sample) -> Score {
    let mut all = sample.clone();
    super::kept::fill(scene, &mut all);
    let drivable = drivable(scene);
    scene::score::score(&ScoreInput::of_sample(scene, Some(&all), &drivable))
}
