//! The posterior of a person's preference.

use super::features::{Features, Trait};
use super::{Feedback, Verdict, Wish};
use crate::random::Stream;
use nalgebra::{DMatrix, DVector};

/// Prior deviation of a trait's slope and curvature. A preference may have its maximum in the middle.
const SLOPE: f64 = 1.0;
const BEND: f64 = 0.7;
/// Slope of an explicit wish, and its certainty.
const SAID_SLOPE: f64 = 1.5;
const SAID_DEVIATION: f64 = 0.4;
/// Number of the latest rejected motions with which a judged motion is compared.
const MOST_COMPARED: usize = 24;
/// Limit of Newton steps; the concave objective needs fewer.
const MOST_STEPS: usize = 30;
/// Convergence: no weight moves by more than this.
const FOUND: f64 = 1e-8;
/// Quantities are measured in standard deviations of the draw, clamped to this, because outliers do not
/// express wishes.
const MOST_DEVIATIONS: f64 = 3.0;

/// A preference: a normal distribution over the weights of a utility that is linear in the traits and their
/// squares. It is the Laplace approximation of the Plackett-Luce posterior (Guiver and Snelson, ICML 2009,
/// use the same likelihood). Each kept card was preferred to the rejected ones and to the draw's average, and
/// the average to each rejected one.
#[derive(Clone, Debug)]
pub struct Taste {
    axes: Vec<Axis>,
    mean: DVector<f64>,
    /// Lower triangular factor of the covariance.
    spread: DMatrix<f64>,
}

/// A trait with its mean and standard deviation in the draw.
#[derive(Clone, Debug)]
struct Axis {
    of: Trait,
    /// Index of its first weight.
    at: usize,
    average: f64,
    deviation: f64,
}

/// A choice of one motion over others.
struct Comparison {
    taken: DVector<f64>,
    left: Vec<DVector<f64>>,
}

impl Taste {
    /// The posterior from feedback, over a draw that defines the usual range of each trait.
    pub fn learn(feedback: &Feedback, draw: &[&Features]) -> Self {
        let mut taste = Self::unknown(feedback, draw);
        let comparisons = taste.comparisons(feedback, draw);
        let (center, precision) = taste.prior(feedback);
        let mut at = center.clone();
        let mut curvature = precision.clone();
        for _ in 0..MOST_STEPS {
            let mut slope = &precision * (&center - &at);
            curvature.copy_from(&precision);
            for comparison in &comparisons {
                comparison.add(&at, &mut slope, &mut curvature);
            }
            let Some(solved) = curvature.clone().cholesky() else { break };
            let mut step = solved.solve(&slope);
            // Full steps may overshoot if the evidence is one-sided.
            let value = |at: &DVector<f64>| log_posterior(at, &center, &precision, &comparisons);
            let now = value(&at);
            while value(&(&at + &step)) < now && step.amax() > FOUND {
                step *= 0.5;
            }
            at += &step;
            if step.amax() < FOUND {
                break;
            }
        }
        let covariance = curvature.cholesky().map(|c| c.inverse()).and_then(nalgebra::Cholesky::new);
        taste.spread = covariance.map_or_else(|| DMatrix::zeros(at.len(), at.len()), |c| c.l());
        taste.mean = at;
        taste
    }

    fn unknown(feedback: &Feedback, draw: &[&Features]) -> Self {
        let judged = feedback.answers.iter().map(|answer| &answer.features);
        let mut traits: Vec<Trait> = draw.iter().copied().chain(judged).flat_map(Features::traits).collect();
        traits.extend(feedback.wishes.iter().map(|wish| wish.of.clone()));
        traits.sort();
        traits.dedup();
        traits.retain(|of| !feedback.forgotten.contains(of));
        let mut size = 0;
        let axis = |of| {
            let axis = Axis::new(of, size, draw);
            size += axis.size();
            axis
        };
        let axes: Vec<Axis> = traits.into_iter().map(axis).collect();
        Self { axes, mean: DVector::zeros(size), spread: DMatrix::identity(size, size) }
    }

    /// Mean and precision of the weights before any answer.
    fn prior(&self, feedback: &Feedback) -> (DVector<f64>, DMatrix<f64>) {
        let mut center = DVector::zeros(self.mean.len());
        let mut sure = DVector::zeros(self.mean.len());
        for axis in &self.axes {
            let i = axis.at;
            let said = feedback.wishes.iter().rfind(|wish| wish.of == axis.of);
            center[i] = said.map_or(0.0, |wish| SAID_SLOPE * wish.wants.sign());
            let deviation = if said.is_some() { SAID_DEVIATION } else { SLOPE };
            sure[i] = deviation.powi(-2);
            if axis.size() == 2 {
                sure[i + 1] = BEND.powi(-2);
            }
        }
        (center, DMatrix::from_diagonal(&sure))
    }

    fn comparisons(&self, feedback: &Feedback, draw: &[&Features]) -> Vec<Comparison> {
        let mut average = DVector::zeros(self.mean.len());
        draw.iter().for_each(|features| average += self.row(features));
        average /= draw.len().max(1) as f64;
        let of = |verdict| feedback.answers.iter().filter(move |answer| answer.verdict == verdict);
        let rejected: Vec<_> = of(Verdict::Reject).map(|answer| self.row(&answer.features)).collect();
        let last = &rejected[rejected.len().saturating_sub(MOST_COMPARED)..];
        let mut comparisons = Vec::new();
        for kept in of(Verdict::Keep) {
            let left = last.iter().chain([&average]).cloned().collect();
            comparisons.push(Comparison { taken: self.row(&kept.features), left });
        }
        for row in &rejected {
            comparisons.push(Comparison { taken: average.clone(), left: vec![row.clone()] });
        }
        for answer in &feedback.answers {
            if let Some((wished, was)) =
                answer.why.as_ref().and_then(|why| self.wished(why, &answer.features))
            {
                comparisons.push(Comparison { taken: wished, left: vec![was] });
            }
        }
        comparisons
    }

    /// A card with a trait shifted in the wished direction, and the card itself.
    fn wished(&self, why: &Wish, features: &Features) -> Option<(DVector<f64>, DVector<f64>)> {
        let axis = self.axis(&why.of)?;
        let was = self.row(features);
        let mut wished = was.clone();
        axis.put(axis.measured(features) + why.wants.sign(), &mut wished);
        Some((wished, was))
    }

    fn axis(&self, of: &Trait) -> Option<&Axis> {
        self.axes.iter().find(|axis| axis.of == *of)
    }

    /// A motion as a row of features, one per weight.
    fn row(&self, features: &Features) -> DVector<f64> {
        let mut row = DVector::zeros(self.mean.len());
        for axis in &self.axes {
            axis.put(axis.measured(features), &mut row);
        }
        row
    }

    /// Posterior mean of the utility; 0 is the average before anything is known.
    pub fn liking(&self, features: &Features) -> f64 {
        self.mean.dot(&self.row(features))
    }

    /// One draw of the posterior, as a utility of each motion.
    pub(super) fn maybe(&self, stream: &mut Stream, all: &[&Features]) -> Vec<f64> {
        let noise = DVector::from_iterator(self.mean.len(), (0..self.mean.len()).map(|_| stream.normal()));
        let weights = &self.mean + &self.spread * noise;
        all.iter().map(|features| weights.dot(&self.row(features))).collect()
    }

    /// Certainty that more of a trait is liked: 1 certainly more, -1 certainly less, 0 unknown.
    pub(super) fn leaning(&self, of: &Trait) -> f64 {
        let Some(Axis { at, .. }) = self.axis(of) else { return 0.0 };
        let sure = self.mean[*at] / self.spread.row(*at).norm().max(1e-12);
        // The normal distribution's probability on this side, approximated by a logistic function.
        (0.8 * sure).tanh()
    }
}

impl Axis {
    fn new(of: Trait, at: usize, draw: &[&Features]) -> Self {
        let values: Vec<f64> = draw.iter().filter_map(|features| features.value(&of)).collect();
        let count = values.len().max(1) as f64;
        let average = values.iter().sum::<f64>() / count;
        let deviation = (values.iter().map(|v| (v - average).powi(2)).sum::<f64>() / count).sqrt();
        if of.is_quantity() {
            // A draw without any spread does not define a scale.
            return Self { of, at, average, deviation: deviation.max(0.1) };
        }
        Self { of, at, average: 0.0, deviation: 1.0 }
    }

    /// A quantity also has a curvature weight.
    fn size(&self) -> usize {
        if self.of.is_quantity() { 2 } else { 1 }
    }

    fn measured(&self, features: &Features) -> f64 {
        let value = features.value(&self.of).unwrap_or(self.average);
        ((value - self.average) / self.deviation).clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS)
    }

    fn put(&self, measured: f64, row: &mut DVector<f64>) {
        row[self.at] = measured;
        if self.of.is_quantity() {
            row[self.at + 1] = (measured * measured - 1.0) / std::f64::consts::SQRT_2;
        }
    }
}

impl Comparison {
    /// Probability of each to be taken, the taken one first.
    fn shares(&self, at: &DVector<f64>) -> Vec<f64> {
        let likings: Vec<f64> = [&self.taken].into_iter().chain(&self.left).map(|row| at.dot(row)).collect();
        let most = likings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let parts: Vec<f64> = likings.iter().map(|liking| (liking - most).exp()).collect();
        let whole: f64 = parts.iter().sum();
        parts.into_iter().map(|part| part / whole).collect()
    }

    /// Adds the gradient of its log likelihood and the negated Hessian.
    fn add(&self, at: &DVector<f64>, slope: &mut DVector<f64>, curvature: &mut DMatrix<f64>) {
        let shares = self.shares(at);
        let mut expected = DVector::zeros(at.len());
        for (share, row) in shares.iter().zip([&self.taken].into_iter().chain(&self.left)) {
            expected.axpy(*share, row, 1.0);
            curvature.ger(*share, row, row, 1.0);
        }
        curvature.ger(-1.0, &expected, &expected, 1.0);
        *slope += &self.taken - expected;
    }
}

fn log_posterior(
    at: &DVector<f64>,
    center: &DVector<f64>,
    precision: &DMatrix<f64>,
    comparisons: &[Comparison],
) -> f64 {
    let off = at - center;
    let taken = |comparison: &Comparison| comparison.shares(at)[0].max(f64::MIN_POSITIVE).ln();
    -0.5 * off.dot(&(precision * &off)) + comparisons.iter().map(taken).sum::<f64>()
}
