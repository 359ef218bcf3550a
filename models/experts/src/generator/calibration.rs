//! Calibration of the probabilities in an answer.

use crate::tuning::ProbabilityTuning;

/// Turns weights into probabilities that sum to one, in the same order. Raw weights are overconfident against
/// recordings: the networks learn from simulated timing, and diversity, projection and choice change the
/// futures afterwards. A temperature flattens all probabilities. With a goal position (`sure`), a vehicle or
/// cyclist gets a share spread evenly instead.
pub(super) fn calibrated(
    weights: Vec<f64>,
    (sure, walks): (bool, bool),
    tuning: &ProbabilityTuning,
) -> Vec<f64> {
    let even = 1.0 / weights.len().max(1) as f64;
    let (temperature, spread) = match (sure, walks) {
        (true, false) => (1.0, tuning.spread_with_goal),
        (true, true) => (1.0, 0.0),
        (false, _) => (tuning.answer_temperature, 0.0),
    };
    let flat: Vec<f64> = weights.iter().map(|w| w.max(0.0).powf(1.0 / temperature)).collect();
    let sum: f64 = flat.iter().sum();
    flat.into_iter()
        .map(|w| spread * even + (1.0 - spread) * if sum > 0.0 { w / sum } else { even })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tuning::SHIPPED;

    #[test]
    fn an_answer_is_less_sure_than_its_weights_in_the_same_order() {
        let weights = vec![0.9, 0.06, 0.02, 0.02, 0.0, 0.0];
        for sure in [false, true] {
            let said = calibrated(weights.clone(), (sure, false), &SHIPPED.probability);
            assert!((said.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(said[0] < 0.9 && said.windows(2).all(|w| w[0] >= w[1]), "{said:?}");
        }
        assert!(calibrated(weights, (true, false), &SHIPPED.probability)[5] > 0.05);
        assert_eq!(calibrated(vec![0.0, 0.0], (false, false), &SHIPPED.probability), [0.5, 0.5]);
    }
}
