//! Covariance matrix adaptation: draws points from a normal distribution, and moves, scales and rotates it
//! towards the best of them. After Hansen, "The CMA Evolution Strategy: A Tutorial" (arXiv 1604.00772), with
//! his default parameters and only positive weights. Equation numbers refer to its appendix A.

use nalgebra::{DMatrix, DVector};

/// Shortest axis: a collapsed distribution cannot grow again.
const LEAST_LENGTH: f64 = 1e-9;
/// Longest step, in units of the space: a longer one would draw from the whole space.
const MOST_STEP: f64 = 1.0;

/// An adaptive distribution.
#[derive(Clone, Debug)]
pub struct CmaEs {
    mean: DVector<f64>,
    step: f64,
    covariance: DMatrix<f64>,
    /// Axes of the covariance as columns, and the standard deviation along each.
    axes: DMatrix<f64>,
    lengths: DVector<f64>,
    step_path: DVector<f64>,
    shape_path: DVector<f64>,
    updates: i32,
}

impl CmaEs {
    /// Number of points per update for this number of dimensions: equation 48.
    pub fn population(dimensions: usize) -> usize {
        4 + (3.0 * (dimensions.max(1) as f64).ln()) as usize
    }

    /// A distribution around a point, with a standard deviation.
    pub fn new(mean: DVector<f64>, step: f64) -> Self {
        let n = mean.len();
        Self {
            mean,
            step,
            covariance: DMatrix::identity(n, n),
            axes: DMatrix::identity(n, n),
            lengths: DVector::repeat(n, 1.0),
            step_path: DVector::zeros(n),
            shape_path: DVector::zeros(n),
            updates: 0,
        }
    }

    /// The point for standard normal numbers, one per dimension.
    pub fn point(&self, normal: &DVector<f64>) -> DVector<f64> {
        &self.mean + self.step * &self.axes * normal.component_mul(&self.lengths)
    }

    /// Largest standard deviation of the distribution.
    pub fn extent(&self) -> f64 {
        self.step * self.lengths.max()
    }

    /// Moves to the mean of equally good points, and widens.
    pub fn widen(&mut self, points: &[DVector<f64>], times: f64) {
        let sum = points.iter().fold(self.mean.clone() * 0.0, |sum, point| sum + point);
        self.mean = sum / points.len().max(1) as f64;
        self.step = (self.step * times).min(MOST_STEP);
    }

    /// Adapts to a population that was drawn from it, best point first.
    pub fn adapt(&mut self, ranked: &[DVector<f64>]) {
        let n = self.mean.len() as f64;
        let weights = weights(ranked.len());
        let mass = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        // Equations 55 to 58.
        let step_rate = (mass + 2.0) / (n + mass + 5.0);
        let damping = 1.0 + 2.0 * (((mass - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + step_rate;
        let shape_rate = (4.0 + mass / n) / (n + 4.0 + 2.0 * mass / n);
        let one_rate = 2.0 / ((n + 1.3).powi(2) + mass);
        let many_rate = (2.0 * (mass - 2.0 + 1.0 / mass) / ((n + 2.0).powi(2) + mass)).min(1.0 - one_rate);

        let moves: Vec<DVector<f64>> =
            ranked.iter().take(weights.len()).map(|point| (point - &self.mean) / self.step).collect();
        let weighted = || weights.iter().zip(&moves);
        let shift = weighted().fold(self.mean.clone() * 0.0, |sum, (weight, y)| sum + *weight * y);
        let round = &self.axes * (self.axes.transpose() * &shift).component_div(&self.lengths);
        self.step_path *= 1.0 - step_rate;
        self.step_path += (step_rate * (2.0 - step_rate) * mass).sqrt() * round;
        // Approximate length of a path without selection.
        let expected = n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
        let length = self.step_path.norm();
        self.updates += 1;
        let settled = (1.0 - (1.0 - step_rate).powi(2 * self.updates)).sqrt();
        // A long path does not describe the shape: the step grows first.
        let counts = f64::from(u8::from(length / settled < (1.4 + 2.0 / (n + 1.0)) * expected));
        self.shape_path *= 1.0 - shape_rate;
        self.shape_path += counts * (shape_rate * (2.0 - shape_rate) * mass).sqrt() * &shift;

        let lost = (1.0 - counts) * shape_rate * (2.0 - shape_rate);
        self.covariance *= 1.0 - one_rate - many_rate + one_rate * lost;
        self.covariance += one_rate * &self.shape_path * self.shape_path.transpose();
        for (weight, y) in weighted() {
            self.covariance += many_rate * *weight * y * y.transpose();
        }
        self.mean += self.step * shift;
        self.step = (self.step * (step_rate / damping * (length / expected - 1.0)).exp()).min(MOST_STEP);
        let eigen = self.covariance.clone().symmetric_eigen();
        self.axes = eigen.eigenvectors;
        self.lengths = eigen.eigenvalues.map(|value| value.max(0.0).sqrt().max(LEAST_LENGTH));
    }
}

/// Weights of the better half of a population, which sum to 1: equations 49 to 53.
fn weights(population: usize) -> Vec<f64> {
    let half = (population as f64 + 1.0) / 2.0;
    let raw: Vec<f64> =
        (1..=(population / 2).max(1)).map(|rank| (half.max(1.5) / rank as f64).ln()).collect();
    let sum: f64 = raw.iter().sum();
    raw.iter().map(|weight| weight / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::CmaEs;
    use nalgebra::DVector;
    use scene::random::{Key, Stream};

    fn normal(stream: &mut Stream, n: usize) -> DVector<f64> {
        DVector::from_fn(n, |_, _| stream.normal())
    }

    /// Smallest value found within this number of generations.
    fn found(value: impl Fn(&DVector<f64>) -> f64, n: usize, generations: usize, seed: u64) -> f64 {
        let mut stream = Key::default().number(seed).stream();
        let mut optimiser = CmaEs::new(DVector::repeat(n, 0.3), 0.3);
        let mut best = f64::MAX;
        for _ in 0..generations {
            let mut points: Vec<DVector<f64>> =
                (0..CmaEs::population(n)).map(|_| optimiser.point(&normal(&mut stream, n))).collect();
            points.sort_by(|a, b| value(a).total_cmp(&value(b)));
            best = best.min(value(&points[0]));
            optimiser.adapt(&points);
        }
        best
    }

    #[test]
    fn it_finds_the_bottom_of_a_long_narrow_and_turned_valley() {
        let valley = |x: &DVector<f64>| {
            let sum: f64 = x.iter().sum();
            x.iter().map(|v| (v - 0.7).powi(2)).sum::<f64>() + 1e3 * (sum - 0.7 * x.len() as f64).powi(2)
        };
        for seed in 0..5 {
            let best = found(valley, 4, 180, seed);
            assert!(best < 1e-8, "seed {seed}: {best}");
        }
        // Rosenbrock's function: a bent valley with its minimum at (1, 1).
        let bent = |x: &DVector<f64>| 100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2);
        assert!(found(bent, 2, 150, 1) < 1e-8);
        assert!(found(|x| (x[0] - 0.5).abs(), 1, 40, 1) < 1e-4);
    }

    #[test]
    fn as_many_random_points_find_less() {
        let bowl = |x: &DVector<f64>| x.iter().map(|v| (v - 0.8).powi(2)).sum::<f64>();
        let mut stream = Key::default().number(4).stream();
        let random = (0..60 * CmaEs::population(5))
            .map(|_| bowl(&DVector::from_fn(5, |_, _| stream.unit())))
            .fold(f64::MAX, f64::min);
        assert!(found(bowl, 5, 60, 4) < 0.01 * random);
    }
}
