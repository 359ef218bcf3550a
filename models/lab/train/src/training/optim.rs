//! AdamW (Loshchilov and Hutter, 2019) with moments that can be saved, and a running mean of the weights.

use std::collections::BTreeMap;

use candle_core::{Tensor, Var};

use super::TrainError;

const BETA1: f64 = 0.9;
const BETA2: f64 = 0.98;
const EPSILON: f64 = 1e-8;
const DECAY: f64 = 0.01;
/// Greatest norm of a step's gradient.
const CLIP: f64 = 5.0;
/// Greatest share of the running mean of the weights that is kept in each step.
const MEAN: f64 = 0.999;

/// Gradients in the order of the parameters' names; nothing for a parameter that was not used.
pub(super) type Gradients = Vec<Option<Vec<f32>>>;

/// Numbers of a parameter beside its weights.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Moments {
    pub(super) first: Vec<f32>,
    pub(super) second: Vec<f32>,
    pub(super) mean: Vec<f32>,
    /// Share of the learning rate.
    pub(super) share: f64,
}

/// The optimiser's state.
pub(super) struct AdamW {
    pub(super) moments: BTreeMap<String, Moments>,
    pub(super) step: u64,
}

impl AdamW {
    /// The initial state; `share` is the share of the learning rate for a parameter.
    pub(super) fn new(vars: &BTreeMap<String, Var>, share: impl Fn(&str) -> f64) -> Result<Self, TrainError> {
        let mut moments = BTreeMap::new();
        for (name, var) in vars {
            let mean = var.as_tensor().flatten_all()?.to_vec1::<f32>()?;
            let zero = vec![0.0; mean.len()];
            let share = share(name);
            moments.insert(name.clone(), Moments { first: zero.clone(), second: zero, mean, share });
        }
        Ok(Self { moments, step: 0 })
    }

    /// One step; returns the norm of the gradient before clipping.
    pub(super) fn apply(
        &mut self,
        vars: &BTreeMap<String, Var>,
        gradients: &Gradients,
        rate: f64,
    ) -> Result<f64, TrainError> {
        let squares = |g: &Vec<f32>| g.iter().map(|x| f64::from(*x) * f64::from(*x)).sum::<f64>();
        let length = gradients.iter().flatten().map(squares).sum::<f64>().sqrt();
        if !length.is_finite() {
            // A gradient with NaN must not reach the weights.
            self.step += 1;
            return Ok(length);
        }
        let clip = if length > CLIP { CLIP / length } else { 1.0 };
        self.step += 1;
        for (((name, var), moments), gradient) in vars.iter().zip(self.moments.values_mut()).zip(gradients) {
            let rate = rate * moments.share;
            let Some(gradient) = gradient.as_ref().filter(|_| rate > 0.0) else { continue };
            let decay = if name.ends_with(".weight") { DECAY } else { 0.0 };
            let mut values = var.as_tensor().flatten_all()?.to_vec1::<f32>()?;
            update(&mut values, moments, gradient, Rates { rate, decay, clip, step: self.step });
            var.set(&Tensor::from_vec(values, var.shape(), var.device())?)?;
        }
        Ok(length)
    }

    /// Updates the running mean of the weights; frozen parameters keep their bits.
    pub(super) fn average(&mut self, vars: &BTreeMap<String, Var>) -> Result<(), TrainError> {
        let keep = MEAN.min((1.0 + self.step as f64) / (10.0 + self.step as f64)) as f32;
        for (var, moments) in vars.values().zip(self.moments.values_mut()) {
            if moments.share == 0.0 {
                continue;
            }
            let values = var.as_tensor().flatten_all()?.to_vec1::<f32>()?;
            for (mean, value) in moments.mean.iter_mut().zip(values) {
                *mean = keep * *mean + (1.0 - keep) * value;
            }
        }
        Ok(())
    }

    /// Copies the running mean into another expert's variables.
    pub(super) fn write_means(&self, vars: &BTreeMap<String, Var>) -> Result<(), TrainError> {
        for (var, moments) in vars.values().zip(self.moments.values()) {
            var.set(&Tensor::from_vec(moments.mean.clone(), var.shape(), var.device())?)?;
        }
        Ok(())
    }
}

#[derive(Clone, Copy)]
struct Rates {
    rate: f64,
    decay: f64,
    clip: f64,
    step: u64,
}

fn update(values: &mut [f32], moments: &mut Moments, gradient: &[f32], rates: Rates) {
    let power = rates.step.min(100_000) as i32;
    let (first_share, second_share) = (1.0 - BETA1.powi(power), 1.0 - BETA2.powi(power));
    let (b1, b2, clip) = (BETA1 as f32, BETA2 as f32, rates.clip as f32);
    let size = (rates.rate / first_share) as f32;
    let root = (1.0 / second_share.sqrt()) as f32;
    let shrink = (1.0 - rates.rate * rates.decay) as f32;
    for (i, value) in values.iter_mut().enumerate() {
        let g = clip * gradient[i];
        let m = b1 * moments.first[i] + (1.0 - b1) * g;
        let v = b2 * moments.second[i] + (1.0 - b2) * g * g;
        (moments.first[i], moments.second[i]) = (m, v);
        *value = shrink * *value - size * m / (root * v.sqrt() + EPSILON as f32);
    }
}

/// Learning rate at a share (0..1) of the training: a cosine from `top` to `end`, after a warm-up.
pub(super) fn rate((top, end): (f64, f64), step: u64, warm_up: u64, progress: f64) -> f64 {
    let warm = ((step + 1) as f64 / warm_up.max(1) as f64).min(1.0);
    let cosine = 0.5 * (1.0 + (std::f64::consts::PI * progress.clamp(0.0, 1.0)).cos());
    warm * (end + (top - end) * cosine)
}

#[cfg(test)]
mod tests {
    use candle_core::{DType, Device};

    use super::*;

    #[test]
    fn a_bowl_is_walked_down() {
        let vars = BTreeMap::from([
            ("a.weight".to_owned(), Var::ones(3, DType::F32, &Device::Cpu).unwrap()),
            ("b.bias".to_owned(), Var::ones(2, DType::F32, &Device::Cpu).unwrap()),
        ]);
        let mut adam = AdamW::new(&vars, |_| 1.0).unwrap();
        for _ in 0..500 {
            let gradients = vars.values().map(|v| Some(v.as_tensor().to_vec1::<f32>().unwrap())).collect();
            adam.apply(&vars, &gradients, 0.01).unwrap();
            adam.average(&vars).unwrap();
        }
        for var in vars.values() {
            assert!(var.as_tensor().to_vec1::<f32>().unwrap().iter().all(|v| v.abs() < 0.05));
        }
        let before = vars["b.bias"].as_tensor().to_vec1::<f32>().unwrap();
        let gradients = vec![Some(vec![f32::NAN; 3]), Some(vec![1.0; 2])];
        assert!(adam.apply(&vars, &gradients, 0.01).unwrap().is_nan());
        assert_eq!(vars["b.bias"].as_tensor().to_vec1::<f32>().unwrap(), before);
    }

    #[test]
    fn the_rate_rises_then_falls() {
        let of = |step, progress| rate((1.0, 0.01), step, 100, progress);
        assert!(of(0, 0.0) < 0.02);
        assert!((of(100, 0.0) - 1.0).abs() < 1e-9);
        assert!((of(500, 1.0) - 0.01).abs() < 1e-9);
    }
}
