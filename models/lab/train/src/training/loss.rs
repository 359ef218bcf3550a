//! Losses with explicit gradients: the networks have few outputs, and a loss through the tensor library would
//! cost more than some of the networks.

use experts::features::GroundTruth;

use experts::planning::{INSTANTS, MODES, RESIDUAL};
use scene::KNOTS;

use super::route::ResidualBasis;

/// Added under the root of a distance for smoothness, square metres.
const ROUND: f32 = 0.01;
/// Weight of the pull of the first mode to the recording, whether it is the best mode or not, if a goal's
/// position is fixed. With such a goal the first mode is the mean future and the default answer.
const MIDDLE: f32 = 0.3;
/// Mean distance above which a mode that is not the best is not pulled, metres.
const FAR: f32 = 60.0;

/// Output of the initializer for one road user.
#[derive(Clone, Debug)]
pub(super) struct AgentOutput {
    pub(super) residual: [[f32; RESIDUAL]; MODES],
    pub(super) log_scale: [[f32; RESIDUAL]; MODES],
    pub(super) score: [f32; MODES],
    pub(super) stays: f32,
}

impl AgentOutput {
    pub(super) fn zero() -> Self {
        Self {
            residual: [[0.0; RESIDUAL]; MODES],
            log_scale: [[0.0; RESIDUAL]; MODES],
            score: [0.0; MODES],
            stays: 0.0,
        }
    }
}

/// Parts of the initializer's loss, for reports.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct InitialParts {
    pub(super) total: f32,
    pub(super) min_ade: f32,
    pub(super) first_ade: f32,
    pub(super) score_nll: f32,
    pub(super) stays_bce: f32,
    pub(super) scale_nll: f32,
}

/// Distance between a residual and the recording, mean over the valid instants, and its gradient.
pub(super) fn distance(
    route: &ResidualBasis,
    target: &GroundTruth,
    mode: usize,
    residual: &[f32; RESIDUAL],
) -> (f32, [f32; RESIDUAL]) {
    let coordinates = route.coordinates(&target.base_along[mode], residual);
    let count = target.valid.iter().sum::<f32>().max(1e-3);
    let (mut mean, mut pull) = (0.0, [[0.0; 2]; INSTANTS]);
    for i in 0..INSTANTS {
        if target.valid[i] == 0.0 {
            continue;
        }
        let (a, b) = (coordinates[i][0] - target.along[mode][i], coordinates[i][1] - target.across[mode][i]);
        let length = (a * a + b * b + ROUND).sqrt();
        mean += length / count;
        pull[i] = [a / length / count, b / length / count];
    }
    (mean, to_knots(route, &pull))
}

/// Converts a gradient [along, across] at the instants to one at the normalised knots.
pub(super) fn to_knots(route: &ResidualBasis, pull: &[[f32; 2]; INSTANTS]) -> [f32; RESIDUAL] {
    let mut knots = [0.0; RESIDUAL];
    for half in 0..2 {
        for (row, pull) in route.rows(half).iter().zip(pull) {
            for (knot, basis) in knots[half * KNOTS..][..KNOTS].iter_mut().zip(row) {
                *knot += basis * pull[half];
            }
        }
    }
    knots
}

/// Weight of a road user by its speed, so that fast ones do not dominate.
pub(super) fn speed_weight(target: &GroundTruth) -> f32 {
    let speed = target.base_along.iter().map(|base| base[0].abs()).fold(0.0, f32::max) / 0.5;
    1.0 / (1.0 + 0.05 * speed)
}

/// The index of the least value.
pub(crate) fn least(values: &[f32]) -> usize {
    (0..values.len()).fold(0, |best, i| if values[i] < values[best] { i } else { best })
}

/// The loss of the initializer: winner takes all on positions, likelihood of the winner's score, scales of
/// the winner, and whether the road user stays. `recorded` are the residuals of [`super::fit::recorded`];
/// `bound` road users have a goal position. Returns the parts and the gradient.
pub(super) fn initial(
    route: &ResidualBasis,
    target: &GroundTruth,
    recorded: &[[f32; RESIDUAL]; MODES],
    bound: bool,
    output: &AgentOutput,
) -> (InitialParts, AgentOutput) {
    let mut grad = AgentOutput::zero();
    let weight = speed_weight(target);
    let distances: [(f32, [f32; RESIDUAL]); MODES] =
        std::array::from_fn(|mode| distance(route, target, mode, &output.residual[mode]));
    let ade = distances.map(|(ade, _)| ade);
    let best = least(&ade);
    let mut total = weight * ade[best];
    for (mode, (ade, slope)) in distances.iter().enumerate() {
        let mut pull = if mode == best { weight } else { 0.0 };
        total += weight * 0.01 * ade.min(FAR) / MODES as f32;
        if *ade < FAR {
            pull += weight * 0.01 / MODES as f32;
        }
        if bound && mode == 0 {
            total += weight * MIDDLE * ade;
            pull += weight * MIDDLE;
        }
        let size = (output.residual[mode].iter().map(|r| r * r).sum::<f32>() + 1e-3).sqrt();
        total += 0.004 * size / MODES as f32;
        for i in 0..RESIDUAL {
            grad.residual[mode][i] = pull * slope[i] + 0.004 / MODES as f32 * output.residual[mode][i] / size;
        }
    }
    let (score_nll, score_grad) = index(&output.score, best);
    grad.score = score_grad.map(|g| 0.5 * g);
    let (stays_bce, stays_grad) = binary(output.stays, target.stays);
    grad.stays = 0.2 * stays_grad;
    let scale_nll = scales(
        &recorded[best],
        &output.residual[best],
        &output.log_scale[best],
        0.02,
        &mut grad.log_scale[best],
    );
    total += 0.5 * score_nll + 0.2 * stays_bce + 0.02 * scale_nll;
    let first_ade = if bound { ade[0] } else { ade[least(&output.score.map(|score| -score))] };
    (InitialParts { total, min_ade: ade[best], first_ade, score_nll, stays_bce, scale_nll }, grad)
}

/// Negative log likelihood of the best mode's score, with its gradient, so that the scores estimate how often
/// each mode is the nearest. The shown answer is chosen separately, by the least expected distance.
pub(crate) fn index(score: &[f32; MODES], best: usize) -> (f32, [f32; MODES]) {
    let given = softmax(score);
    let mut gradient = given;
    gradient[best] -= 1.0;
    (-given[best].max(1e-20).ln(), gradient)
}

pub(crate) fn softmax(values: &[f32; MODES]) -> [f32; MODES] {
    let top = values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let parts = values.map(|value| (value - top).exp());
    let total: f32 = parts.iter().sum();
    parts.map(|part| part / total)
}

/// Cross-entropy of a logit and its gradient.
fn binary(logit: f32, truth: f32) -> (f32, f32) {
    let loss = logit.max(0.0) - logit * truth + (-logit.abs()).exp().ln_1p();
    (loss, 1.0 / (1.0 + (-logit).exp()) - truth)
}

/// Laplace likelihood of the recorded residual, without a gradient to the residual itself.
fn scales(
    recorded: &[f32; RESIDUAL],
    residual: &[f32; RESIDUAL],
    log_scale: &[f32; RESIDUAL],
    weight: f32,
    grad: &mut [f32; RESIDUAL],
) -> f32 {
    let mut nll = 0.0;
    for i in 0..RESIDUAL {
        // Bounded below, so that the scale of a number that is always right (a fixed one) does not diverge.
        let log = log_scale[i].clamp(-5.0, 5.0);
        let miss = (recorded[i] - residual[i]).abs() / log.exp();
        nll += miss + log;
        let free = log == log_scale[i] || (log_scale[i] > 0.0) == (miss < 1.0);
        grad[i] += if free { weight * (1.0 - miss) } else { 0.0 };
    }
    nll
}

/// A denoised residual compared with the recording: metres at the instants and, with a small weight, the
/// knots.
pub(super) fn denoised(
    route: &ResidualBasis,
    target: &GroundTruth,
    mode: usize,
    recorded: &[f32; RESIDUAL],
    residual: &[f32; RESIDUAL],
) -> (f32, [f32; RESIDUAL]) {
    let (mut loss, mut grad) = distance(route, target, mode, residual);
    for i in 0..RESIDUAL {
        let miss = residual[i] - recorded[i];
        loss += 0.05 * miss * miss;
        grad[i] += 0.1 * miss;
    }
    (loss, grad)
}

/// Distance between a refined residual and its draft, over all instants.
pub(super) fn moved(
    route: &ResidualBasis,
    draft: &[f32; RESIDUAL],
    refined: &[f32; RESIDUAL],
) -> (f32, [f32; RESIDUAL]) {
    let difference: [f32; RESIDUAL] = std::array::from_fn(|i| refined[i] - draft[i]);
    let steps = route.coordinates(&[0.0; INSTANTS], &difference);
    let (mut mean, mut pull) = (0.0, [[0.0; 2]; INSTANTS]);
    for (step, pull) in steps.iter().zip(&mut pull) {
        let length = (step[0] * step[0] + step[1] * step[1] + ROUND).sqrt();
        mean += length / INSTANTS as f32;
        *pull = step.map(|s| s / length / INSTANTS as f32);
    }
    (mean, to_knots(route, &pull))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::{fit, toy};

    fn output(seed: u64) -> AgentOutput {
        let mut value = seed as f32 * 0.37;
        let mut next = || {
            value = (value * 1.7 + 0.31) % 1.0;
            value - 0.5
        };
        let mut output = AgentOutput::zero();
        output.residual.as_flattened_mut().iter_mut().for_each(|r| *r = next());
        output.log_scale.as_flattened_mut().iter_mut().for_each(|r| *r = next());
        output.score.iter_mut().for_each(|r| *r = next());
        output.stays = next();
        output
    }

    fn close(slope: f32, expected: f32, what: &str) {
        assert!(
            (slope - expected).abs() < 0.02 * expected.abs() + 0.004,
            "{what}: slope {slope}, gradient {expected}"
        );
    }

    #[test]
    fn initial_gradient_matches_differences() {
        let route = ResidualBasis::new();
        for (seed, record) in toy::scenes(1, 5, 3)[0].2.iter().enumerate() {
            let recorded = fit::recorded(&route, &record.agent, &record.target);
            let output = output(seed as u64 + 1);
            let bound = seed % 2 == 1;
            let (_, grad) = initial(&route, &record.target, &recorded, bound, &output);
            let slope = |change: &dyn Fn(&mut AgentOutput, f32)| {
                let at = |delta: f32| {
                    let mut moved = output.clone();
                    change(&mut moved, delta);
                    let (parts, _) = initial(&route, &record.target, &recorded, bound, &moved);
                    // Scales and scores do not change the residual: their losses are separate.
                    (f64::from(parts.total), f64::from(0.02 * parts.scale_nll + 0.5 * parts.score_nll))
                };
                let (up, down) = (at(2e-3), at(-2e-3));
                (((up.0 - down.0) / 4e-3) as f32, ((up.1 - down.1) / 4e-3) as f32)
            };
            for mode in 0..MODES {
                for i in (0..RESIDUAL).step_by(3) {
                    let (all, apart) = slope(&|output, d| output.residual[mode][i] += d);
                    close(all - apart, grad.residual[mode][i], "residual");
                    close(
                        slope(&|output, d| output.log_scale[mode][i] += d).0,
                        grad.log_scale[mode][i],
                        "scale",
                    );
                }
                close(slope(&|output, d| output.score[mode] += d).0, grad.score[mode], "score");
            }
            close(slope(&|output, d| output.stays += d).0, grad.stays, "stays");
        }
    }

    #[test]
    fn denoised_and_moved_gradients_match_differences() {
        let route = ResidualBasis::new();
        let record = &toy::scenes(1, 1, 3)[0].2[0];
        let recorded = fit::recorded(&route, &record.agent, &record.target);
        let (a, b) = (output(1).residual, output(2).residual);
        for i in 0..RESIDUAL {
            let slope = |loss: &dyn Fn(&[f32; RESIDUAL]) -> f32| {
                let (mut up, mut down) = (b[2], b[2]);
                up[i] += 2e-3;
                down[i] -= 2e-3;
                ((f64::from(loss(&up)) - f64::from(loss(&down))) / 4e-3) as f32
            };
            let one = |r: &[f32; RESIDUAL]| denoised(&route, &record.target, 2, &recorded[2], r);
            close(slope(&|r| one(r).0), one(&b[2]).1[i], "denoised");
            let two = |r: &[f32; RESIDUAL]| moved(&route, &a[2], r);
            close(slope(&|r| two(r).0), two(&b[2]).1[i], "moved");
        }
    }
}
