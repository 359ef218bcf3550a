//! The numbers of a situation: every combination of a grid, or a number of draws.

use crate::distribution::Distribution;
use crate::fault::PlanFault;
use crate::sampling::{BatchSampling, MOST_DRAWS, SamplingMethod};
use crate::situation::{BatchSituation, MOST_CONDITIONS};
use crate::{latin_hypercube, sobol};
use scene::random::Key;
use std::collections::BTreeMap;

// A situation has conditions, or a template's parameters, which are fewer.
const _: () = assert!(MOST_CONDITIONS <= sobol::DIMENSIONS);

/// Number of draws of a situation for one road user of one scene.
pub fn count(situation: &BatchSituation, sampling: &BatchSampling) -> u64 {
    let dimensions = situation.dimensions();
    if sampling.method == SamplingMethod::Grid {
        let points = dimensions.iter().map(|dimension| dimension.distribution.points() as u64);
        return points.fold(1, u64::saturating_mul);
    }
    // Without a varied number there is only one draw.
    let varies = dimensions.iter().any(|dimension| !dimension.distribution.is_fixed());
    if varies { sampling.draws } else { 1 }
}

/// The numbers of one draw, by path. A draw depends only on the scene, the road user, the situation and its
/// number. Neither other situations nor other scenes change it. A search has none: its numbers follow from
/// its earlier tries.
pub fn drawn(
    situation: &BatchSituation,
    sampling: &BatchSampling,
    scene: &str,
    actor: &str,
    draw: u64,
) -> BTreeMap<String, f64> {
    let mut left = draw;
    let mut varied = 0;
    let mut value = |path: &str, distribution: &Distribution| {
        let key =
            Key::default().words(&["batch", situation.name(), scene, actor, path]).number(sampling.seed);
        let share = match sampling.method {
            SamplingMethod::Grid => {
                let points = (distribution.points() as u64).max(1);
                let place = left % points;
                left /= points;
                return Some(distribution.point(place as usize));
            }
            SamplingMethod::Random => key.number(draw).stream().unit(),
            SamplingMethod::LatinHypercube => latin_hypercube::share(&key, draw, sampling.draws),
            SamplingMethod::Sobol => sobol::share(&key, varied, draw),
            SamplingMethod::Search => return None,
        };
        // The first dimensions spread best, so fixed numbers use none.
        varied += usize::from(!distribution.is_fixed());
        Some(distribution.at(share))
    };
    let dimensions = situation.dimensions().into_iter();
    dimensions
        .filter_map(|dimension| {
            let value = value(&dimension.path, dimension.distribution)?;
            Some((dimension.path, value))
        })
        .collect()
}

/// Checks that a situation can be drawn.
pub(crate) fn check(
    situation: &BatchSituation,
    sampling: &BatchSampling,
    path: &str,
    faults: &mut Vec<PlanFault>,
) {
    if sampling.method == SamplingMethod::Grid {
        for dimension in situation.dimensions() {
            if let Distribution::Uniform { points: None, .. } = dimension.distribution {
                let detail = "a range needs points in a grid, such as points = 5; or another sampling.method";
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
    use crate::sampling::{BatchSampling, SamplingMethod};
    use crate::situation::BatchSituation;
    use std::collections::{BTreeMap, BTreeSet};

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

    const DRAWN: [SamplingMethod; 3] =
        [SamplingMethod::Random, SamplingMethod::LatinHypercube, SamplingMethod::Sobol];

    #[test]
    fn draws_depend_on_what_they_are_for() {
        let situation = situation();
        for method in DRAWN {
            let sampling = BatchSampling { method, draws: 5, seed: 1 };
            assert_eq!(count(&situation, &sampling), 5);
            let at = |scene: &str, actor: &str, draw| drawn(&situation, &sampling, scene, actor, draw);
            assert_eq!(at("s", "6", 2), at("s", "6", 2));
            let seed = BatchSampling { seed: 2, ..sampling.clone() };
            let others =
                [at("t", "6", 2), at("s", "7", 2), at("s", "6", 3), drawn(&situation, &seed, "s", "6", 2)];
            assert!(
                others.iter().all(|other| other["goal.speed_mps"] != at("s", "6", 2)["goal.speed_mps"]),
                "{method:?}"
            );
            let fixed: BatchSituation = serde_json::from_str(r#"{"agents":["6"],"width_m":2}"#).unwrap();
            assert_eq!(count(&fixed, &sampling), 1);
        }
    }

    #[test]
    fn stratified_draws_hit_each_stratum_of_a_range_and_each_choice_equally_often() {
        let situation = situation();
        let hits = |method| {
            let sampling = BatchSampling { method, draws: 32, seed: 3 };
            let all: Vec<_> = (0..32).map(|draw| drawn(&situation, &sampling, "s", "6", draw)).collect();
            assert!(all.iter().all(|numbers| numbers["width_m"] == 2.0));
            let stratum = |numbers: &BTreeMap<String, f64>| ((numbers["goal.speed_mps"] - 5.0) * 8.0) as u64;
            let near = all.iter().filter(|numbers| numbers["goal.ahead_m"] == 20.0).count();
            (all.iter().map(stratum).collect::<BTreeSet<_>>().len(), near)
        };
        assert_eq!(hits(SamplingMethod::LatinHypercube), (32, 16));
        assert_eq!(hits(SamplingMethod::Sobol), (32, 16));
        assert!(hits(SamplingMethod::Random).0 < 28);
    }
}
