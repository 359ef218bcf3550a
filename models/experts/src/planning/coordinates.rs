//! Route coordinates: the numbers that describe a future.
//!
//! A future is described relative to an *anchor*. An anchor is a path (a route along the lane graph, or a
//! straight line on foot) with a base progress along it. A future is the anchor plus
//! * `KNOTS` longitudinal acceleration residuals, one per second (integrated twice to metres along), and
//! * `KNOTS` lateral offsets, one per second (metres to the left of the path, the first always zero).
//!
//! In these route coordinates a fixed goal is linear in the knots, so a constant projection keeps it
//! ([`AgentFeatures::tangent`](crate::features::AgentFeatures::tangent)), in training and at each refinement
//! step alike.

use scene::{KNOT_S, KNOTS};

/// Modes of an answer, one anchor slot each.
pub const MODES: usize = 6;
/// Instants at which route coordinates are compared: 0.5, 1.0, .. 9.0 s.
pub const INSTANTS: usize = 18;
/// Steps from an instant to the next.
pub const PER_INSTANT: usize = scene::HORIZON_STEPS / INSTANTS;
/// Seconds from an instant to the next.
pub const INSTANT_S: f64 = scene::HORIZON_STEPS as f64 / INSTANTS as f64 * scene::STEP_S;
/// Numbers of one future in route coordinates: along knots, then across knots.
pub const RESIDUAL: usize = 2 * KNOTS;
/// One future in route coordinates, relative to its anchor.
pub type Residual = [f32; RESIDUAL];
/// The futures of all modes of a road user, each relative to its own anchor.
pub type Modes = [Residual; MODES];

/// The mode at which the cumulative probability reaches `at`.
pub fn mode_at(probability: &[f64; MODES], at: f64) -> usize {
    let mut left = at;
    let reached = probability.iter().position(|p| {
        let within = left < *p;
        left -= p;
        within
    });
    reached.unwrap_or(MODES - 1)
}

/// An agent that stays within this distance of its place for a whole window counts as standing, metres.
pub const STAYS_WITHIN_M: f64 = 0.5;

/// Scale of the along knots, m/s2: residuals are divided by it before they enter a network.
pub const ALONG_SCALE: f32 = 1.0;
/// Scale of the across knots, metres.
pub const ACROSS_SCALE: f32 = 1.0;

/// Basis of the route coordinates: metres at the instants per knot.
#[derive(Clone, Debug)]
pub struct Basis {
    /// Along: hats integrated twice, `[INSTANTS][KNOTS]`.
    pub along: [[f32; KNOTS]; INSTANTS],
    /// Across: hats; the first knot's column is zero.
    pub across: [[f32; KNOTS]; INSTANTS],
}

impl Basis {
    /// Computes the basis, which is always the same.
    pub fn new() -> Self {
        let mut basis = Self { along: [[0.0; KNOTS]; INSTANTS], across: [[0.0; KNOTS]; INSTANTS] };
        for instant in 0..INSTANTS {
            let t = INSTANT_S * (instant + 1) as f64;
            for knot in 0..KNOTS {
                basis.along[instant][knot] = twice_integrated_hat(knot, t) as f32;
                if knot > 0 {
                    basis.across[instant][knot] = hat(knot, t) as f32;
                }
            }
        }
        basis
    }
}

impl Default for Basis {
    fn default() -> Self {
        Self::new()
    }
}

/// Hat function of a knot at time `t`, seconds.
pub fn hat(knot: usize, t: f64) -> f64 {
    (1.0 - (t / KNOT_S - knot as f64).abs()).max(0.0)
}

/// Integral of [`hat`] from 0 to `t`.
pub fn integrated_hat(knot: usize, t: f64) -> f64 {
    let primitive = |x: f64| match x {
        x if x <= -1.0 => 0.0,
        x if x <= 0.0 => 0.5 * (x + 1.0) * (x + 1.0),
        x if x <= 1.0 => 1.0 - 0.5 * (1.0 - x) * (1.0 - x),
        _ => 1.0,
    };
    KNOT_S * (primitive(t / KNOT_S - knot as f64) - primitive(-(knot as f64)))
}

/// Integral of [`integrated_hat`] from 0 to `t`.
pub fn twice_integrated_hat(knot: usize, t: f64) -> f64 {
    let primitive = |x: f64| match x {
        x if x <= -1.0 => 0.0,
        x if x <= 0.0 => (x + 1.0).powi(3) / 6.0,
        x if x <= 1.0 => x + (1.0 - x).powi(3) / 6.0,
        _ => x,
    };
    let slope_at_start = match -(knot as f64) {
        x if x <= -1.0 => 0.0,
        x => 0.5 * (x + 1.0) * (x + 1.0),
    };
    let t = t / KNOT_S;
    KNOT_S * KNOT_S * (primitive(t - knot as f64) - primitive(-(knot as f64)) - slope_at_start * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draw_follows_the_probabilities() {
        let probability = [0.5, 0.0, 0.25, 0.25, 0.0, 0.0];
        let modes = [0.0, 0.49, 0.5, 0.76, 0.999].map(|at| mode_at(&probability, at));
        assert_eq!(modes, [0, 0, 2, 3, 3]);
        assert_eq!(mode_at(&probability, 1.0), MODES - 1);
    }

    #[test]
    fn integrals_match_sums() {
        for knot in 0..KNOTS {
            let (mut once, mut twice) = (0.0, 0.0);
            let dt = 1e-4;
            for i in 0..90_000 {
                let t = (i as f64 + 0.5) * dt;
                once += hat(knot, t) * dt;
                twice += integrated_hat(knot, t) * dt;
            }
            assert!((once - integrated_hat(knot, 9.0)).abs() < 1e-6);
            assert!((twice - twice_integrated_hat(knot, 9.0)).abs() < 1e-4);
        }
    }
}
