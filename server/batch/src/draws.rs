//! The numbers of a situation: every combination of a grid, or independent draws.

use crate::distribution::Distribution;
use crate::fault::PlanFault;
use crate::plan::{BatchSampling, SamplingMethod};
use crate::situation::BatchSituation;
use scene::random::Key;
use std::collections::BTreeMap;

/// Most draws of one situation for one road user.
const MOST_DRAWS: u64 = 1_000_000;

/// Number of draws of a situation for one road user of one scene.
pub fn count(situation: &BatchSituation, sampling: &BatchSampling) -> u64 {
    let dimensions = situation.dimensions();
    match sampling.method {
        SamplingMethod::Grid => {
            let points = dimensions.iter().map(|dimension| dimension.distribution.points() as u64);
            points.fold(1, u64::saturating_mul)
        }
        // Equal numbers are drawn once.
        SamplingMethod::Random if dimensions.iter().all(|dimension| dimension.distribution.is_fixed()) => 1,
        SamplingMethod::Random => sampling.draws,
    }
}

/// The numbers of one draw, by path. A random draw depends on the scene, the road user, the situation and the number
/// alone: neither other situations nor other scenes change it.
pub fn drawn(
    situation: &BatchSituation,
    sampling: &BatchSampling,
    scene: &str,
    actor: &str,
    draw: u64,
) -> BTreeMap<String, f64> {
    let mut left = draw;
    let value = |path: &str, distribution: &Distribution, left: &mut u64| match sampling.method {
        SamplingMethod::Grid => {
            let points = (distribution.points() as u64).max(1);
            let place = *left % points;
            *left /= points;
            distribution.point(place as usize)
        }
        SamplingMethod::Random => {
            let key = Key::default().words(&["batch", situation.name(), scene, actor, path]);
            distribution.draw(&mut key.number(sampling.seed).number(draw).stream())
        }
    };
    let dimensions = situation.dimensions().into_iter();
    dimensions
        .map(|dimension| {
            let value = value(&dimension.path, dimension.distribution, &mut left);
            (dimension.path, value)
        })
        .collect()
}

/// What keeps a situation from being drawn.
pub(crate) fn check(
    situation: &BatchSituation,
    sampling: &BatchSampling,
    path: &str,
    faults: &mut Vec<PlanFault>,
) {
    if sampling.method == SamplingMethod::Grid {
        for dimension in situation.dimensions() {
            if let Distribution::Uniform { points: None, .. } = dimension.distribution {
                let detail =
                    "a range needs points in a grid, such as points = 5; or sampling.method = \"random\"";
                faults.push(PlanFault::new(format!("{path}.{}", dimension.path), detail));
            }
        }
    }
    let count = count(situation, sampling);
    if count > MOST_DRAWS {
        faults.push(PlanFault::new(path, format!("{count} draws; at most {MOST_DRAWS} expected")));
    }
}

#[cfg(test)]
mod tests {
    use super::{count, drawn};
    use crate::plan::{BatchSampling, SamplingMethod};
    use crate::situation::BatchSituation;
    use std::collections::BTreeSet;

    fn situation() -> BatchSituation {
        let text = r#"{"agents":["6"],"width_m":2,"goal":{
            "speed_mps":{"uniform":[5,9],"points":3},"ahead_m":{"choice":[20,40]}}}"#;
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn a_grid_takes_every_combination_once() {
        let (situation, sampling) = (situation(), BatchSampling::default());
        assert_eq!(count(&situation, &sampling), 6);
        let all: BTreeSet<String> =
            (0..6).map(|draw| format!("{:?}", drawn(&situation, &sampling, "s", "6", draw))).collect();
        assert_eq!(all.len(), 6, "{all:?}");
        assert!(
            all.iter().any(|numbers| numbers.contains("\"goal.ahead_m\": 40.0, \"goal.speed_mps\": 9.0"))
        );
    }

    #[test]
    fn random_draws_depend_on_what_they_are_for() {
        let situation = situation();
        let sampling = BatchSampling { method: SamplingMethod::Random, draws: 5, seed: 1 };
        assert_eq!(count(&situation, &sampling), 5);
        let at = |scene: &str, actor: &str, draw| drawn(&situation, &sampling, scene, actor, draw);
        assert_eq!(at("s", "6", 2), at("s", "6", 2));
        let others = [at("t", "6", 2), at("s", "7", 2), at("s", "6", 3)];
        assert!(others.iter().all(|other| other["goal.speed_mps"] != at("s", "6", 2)["goal.speed_mps"]));
        let fixed: BatchSituation = serde_json::from_str(r#"{"agents":["6"],"width_m":2}"#).unwrap();
        assert_eq!(count(&fixed, &sampling), 1);
    }
}
