//! The baselines' losses with their gradients, written out.

use experts::planning::{INSTANTS, MODES};

use super::sight::{Points, Truth};
use crate::training::least;

/// Unit of distances, metres: squared errors then weigh about as much as the likelihood.
pub(super) const UNIT_M: f32 = 5.0;
/// Total weight of all modes except the best, so that none stops learning.
const LOSERS: f32 = 0.01;
/// Mean square above which a losing mode is not pulled, units squared.
const FAR: f32 = 100.0;

/// Errors of six futures.
pub(super) struct Fared {
    /// Mean distances, metres.
    pub(super) ade: [f32; MODES],
    /// Index of the future with the least mean square error.
    pub(super) best: usize,
    pub(super) loss: f32,
    /// Gradient by point, per metre.
    pub(super) gradient: [Points; MODES],
}

/// Squared error of the best future.
pub(super) fn squared(truth: &Truth, futures: &[Points; MODES]) -> Fared {
    let count = truth.valid.iter().sum::<f32>().max(1.0);
    let error = |future: &Points, i: usize| {
        let (a, b) = (future[i], truth.points[i]);
        [truth.valid[i] * (a[0] - b[0]), truth.valid[i] * (a[1] - b[1])]
    };
    let mean = |future: &Points, of: fn(f32) -> f32| -> f32 {
        let each = (0..INSTANTS).map(|i| error(future, i)).map(|[x, y]| of(x * x + y * y));
        each.sum::<f32>() / count
    };
    let squares = futures.each_ref().map(|f| mean(f, |square| square / (UNIT_M * UNIT_M)));
    let best = least(&squares);
    let mut fared = Fared {
        ade: futures.each_ref().map(|f| mean(f, f32::sqrt)),
        best,
        loss: squares[best],
        gradient: [[[0.0; 2]; INSTANTS]; MODES],
    };
    for (mode, future) in futures.iter().enumerate() {
        let mut pull = if mode == best { 1.0 } else { 0.0 };
        if squares[mode] < FAR {
            pull += LOSERS / MODES as f32;
            fared.loss += LOSERS / MODES as f32 * squares[mode];
        }
        let share = 2.0 * pull / (count * UNIT_M * UNIT_M);
        for i in 0..INSTANTS {
            fared.gradient[mode][i] = error(future, i).map(|e| share * e);
        }
    }
    fared
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::training::index;

    #[test]
    fn gradients_are_those_of_the_losses() {
        let truth = Truth {
            points: std::array::from_fn(|i| [i as f32, 0.1 * i as f32]),
            valid: std::array::from_fn(|i| if i < 15 { 1.0 } else { 0.0 }),
        };
        let mut futures: [Points; MODES] =
            std::array::from_fn(|m| std::array::from_fn(|i| [i as f32 * 1.1, m as f32 - 1.7]));
        let fared = squared(&truth, &futures);
        assert_eq!(fared.best, 2);
        for (mode, i, axis) in [(2, 3, 0), (2, 14, 1), (0, 5, 0), (2, 16, 0)] {
            let step = 0.01;
            let at = |futures: &[Points; MODES]| squared(&truth, futures).loss;
            futures[mode][i][axis] += step;
            let above = at(&futures);
            futures[mode][i][axis] -= 2.0 * step;
            let slope = (above - at(&futures)) / (2.0 * step);
            futures[mode][i][axis] += step;
            assert!((slope - fared.gradient[mode][i][axis]).abs() < 1e-3, "{mode} {i} {slope}");
        }
        let (loss, gradient) = index(&[0.0, 1.0, 0.5, 0.0, 0.0, 0.0], 1);
        let (above, _) = index(&[0.0, 1.01, 0.5, 0.0, 0.0, 0.0], 1);
        assert!(((above - loss) / 0.01 - gradient[1]).abs() < 1e-2);
    }
}
