//! Noise levels of the diffusion model: 100 steps on a cosine (Nichol and Dhariwal, "Improved denoising
//! diffusion probabilistic models", 2021), traversed by DDIM steps (Song et al., 2021) from a leapfrog start
//! (Mao et al., "Leapfrog diffusion", 2023).

/// Number of noise levels; level 0 has no noise.
pub const LEVELS: usize = 100;
/// Default level at which refinement begins.
pub const START: usize = 10;
/// Default number of refinement steps.
pub const STEPS: usize = 5;

/// Share of signal power at a level, `alpha bar`.
pub fn signal(level: usize) -> f64 {
    let angle = level.min(LEVELS) as f64 / LEVELS as f64 * std::f64::consts::FRAC_PI_2 * 0.98;
    angle.cos().powi(2)
}

/// Level pairs (from, to) of `steps` DDIM steps from a start level down to 0, as even as whole levels allow.
/// More steps than levels are reduced to the levels; a start at 0 gives that many steps at 0.
pub fn ddim(start: usize, steps: usize) -> Vec<(usize, usize)> {
    let start = start.min(LEVELS);
    let steps = if start == 0 { steps } else { steps.min(start) };
    let level = |step: usize| start * (steps - step) / steps.max(1);
    (0..steps).map(|step| (level(step), level(step + 1))).collect()
}

/// Factors of a DDIM step: `r' = denoised * x0 + residual * r + noise * e`, with fresh noise `e`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DenoisingStep {
    /// Factor of the denoised residual.
    pub denoised: f64,
    /// Factor of the residual before the step.
    pub residual: f64,
    /// Factor of fresh noise.
    pub noise: f64,
}

/// The step between two levels: deterministic for `eta` 0, drawn like the full chain for `eta` 1.
pub fn step(from: usize, to: usize, eta: f64) -> DenoisingStep {
    let (a, b) = (signal(from), signal(to));
    if from == 0 || to == 0 {
        return DenoisingStep { denoised: b.sqrt(), residual: 0.0, noise: 0.0 };
    }
    let noise = eta * ((1.0 - b) / (1.0 - a) * (1.0 - a / b).max(0.0)).sqrt();
    let direction = (1.0 - b - noise * noise).max(0.0).sqrt() / (1.0 - a).sqrt();
    DenoisingStep { denoised: b.sqrt() - direction * a.sqrt(), residual: direction, noise }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_end_without_noise() {
        assert_eq!(ddim(20, 5), [(20, 16), (16, 12), (12, 8), (8, 4), (4, 0)]);
        assert_eq!(ddim(100, 100).len(), 100);
        assert_eq!(ddim(7, 100).len(), 7);
        assert_eq!(ddim(0, 3), [(0, 0); 3]);
        assert!(ddim(20, 0).is_empty());
        assert_eq!(signal(0), 1.0);
        assert!((0..LEVELS).all(|level| signal(level + 1) < signal(level)));
    }

    #[test]
    fn a_step_keeps_the_variance_of_a_known_signal() {
        for (from, to) in [(20, 16), (100, 40), (3, 1)] {
            for eta in [0.0, 0.5, 1.0] {
                // r = sqrt(a) x0 + sqrt(1 - a) e: after the step the noise has variance 1 - b.
                let (a, b, s) = (signal(from), signal(to), step(from, to, eta));
                assert!((s.denoised + s.residual * a.sqrt() - b.sqrt()).abs() < 1e-12);
                let left = s.residual.powi(2) * (1.0 - a) + s.noise.powi(2);
                assert!((left - (1.0 - b)).abs() < 1e-12);
            }
        }
    }
}
