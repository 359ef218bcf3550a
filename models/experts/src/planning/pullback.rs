//! Converts gradients at the instants of a draft to gradients of its knots: the descent direction of the
//! scene's energy.

use super::coordinates::{ACROSS_SCALE, ALONG_SCALE, Basis, INSTANTS, RESIDUAL};
use super::smooth;
use scene::KNOTS;

/// Longest descent step, in normalised knots.
const LONGEST: f32 = 0.8;

/// Converts gradients at the instants to the knots of a residual.
#[derive(Clone, Debug)]
pub struct Pullback {
    basis: Basis,
    correlation: [[f32; KNOTS]; KNOTS],
}

impl Default for Pullback {
    fn default() -> Self {
        let factor = smooth::factor();
        let correlation = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..KNOTS).map(|k| factor[i][k] * factor[j][k]).sum::<f64>() as f32)
        });
        Self { basis: Basis::new(), correlation }
    }
}

impl Pullback {
    /// Gradient with respect to the normalised knots, from the gradient [along, across] at each instant.
    pub fn knots(&self, route: &[[f32; 2]; INSTANTS]) -> [f32; RESIDUAL] {
        let mut knots = [0.0; RESIDUAL];
        for (instant, gradient) in route.iter().enumerate() {
            for knot in 0..KNOTS {
                knots[knot] += ALONG_SCALE * self.basis.along[instant][knot] * gradient[0];
                knots[KNOTS + knot] += ACROSS_SCALE * self.basis.across[instant][knot] * gradient[1];
            }
        }
        knots
    }

    /// The refiner's input: the descent direction, smoothed by the knots' correlation, tangent to the goal,
    /// of bounded length. `route` as in [`Pullback::knots`]; `tangent` as in
    /// [`AgentFeatures`](crate::features::AgentFeatures).
    pub fn downhill(
        &self,
        route: &[[f32; 2]; INSTANTS],
        tangent: &[[[f32; KNOTS]; KNOTS]; 2],
    ) -> [f32; RESIDUAL] {
        let gradient = self.knots(route);
        let mut push = [0.0; RESIDUAL];
        for half in 0..2 {
            let mut downhill = [0.0; KNOTS];
            for i in 0..KNOTS {
                for j in 0..KNOTS {
                    downhill[i] -= self.correlation[i][j] * gradient[half * KNOTS + j];
                }
            }
            for i in 0..KNOTS {
                for j in 0..KNOTS {
                    push[half * KNOTS + i] += tangent[half][i][j] * downhill[j];
                }
            }
        }
        let length = push.iter().map(|p| p * p).sum::<f32>().sqrt();
        if length > LONGEST {
            for p in &mut push {
                *p *= LONGEST / length;
            }
        }
        push
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::geometry::overlap_energy::{
        Growth, MovingBox, OverlapEnergy, carried_back, carried_on, overlap_energy,
    };

    type Poses = [[f32; 4]; INSTANTS];

    const STRAIGHT: [[[f32; KNOTS]; KNOTS]; 2] = {
        let mut matrix = [[[0.0; KNOTS]; KNOTS]; 2];
        let mut i = 0;
        while i < KNOTS {
            matrix[0][i][i] = 1.0;
            matrix[1][i][i] = 1.0;
            i += 1;
        }
        matrix
    };

    fn drive(knots: &[f32; RESIDUAL]) -> Poses {
        let basis = Basis::new();
        std::array::from_fn(|instant| {
            let (mut x, mut y) = (3.0 * 0.5 * (instant + 1) as f32, 0.0);
            for knot in 0..KNOTS {
                x += ALONG_SCALE * basis.along[instant][knot] * knots[knot];
                y += ACROSS_SCALE * basis.across[instant][knot] * knots[KNOTS + knot];
            }
            [x, y, 1.0, 0.0]
        })
    }

    fn energy(knots: &[f32; RESIDUAL], growth: Growth) -> OverlapEnergy<INSTANTS> {
        let (c, s) = (0.3f32.cos(), 0.3f32.sin());
        let poses = [[14.0, 1.9, c, s]; INSTANTS];
        overlap_energy(&drive(knots), [2.2, 0.9], [MovingBox { poses: &poses, half: [2.0, 1.0] }], growth)
    }

    #[test]
    fn gradients_match_differences() {
        for growth in [Growth::Square, Growth::Linear] {
            let knots = [0.05; RESIDUAL];
            let gradient = Pullback::default().knots(&energy(&knots, growth).gradient);
            for knot in 0..RESIDUAL {
                let at = |delta: f32| {
                    let mut moved = knots;
                    moved[knot] += delta;
                    f64::from(energy(&moved, growth).energy)
                };
                let slope = (at(1e-3) - at(-1e-3)) / 2e-3;
                assert!(
                    (slope - f64::from(gradient[knot])).abs() < 0.03 * slope.abs().max(1.0),
                    "{knot}: {slope} {}",
                    gradient[knot]
                );
            }
        }
    }

    #[test]
    fn gradients_of_boxes_carried_on_match_differences() {
        let (c, s) = (0.3f32.cos(), 0.3f32.sin());
        let poses = [[16.0, 1.9, c, s]; INSTANTS];
        let soon = |knots: &[f32; RESIDUAL]| {
            let own = carried_on(&drive(knots), 2.0);
            overlap_energy(&own, [2.2, 0.9], [MovingBox { poses: &poses, half: [2.0, 1.0] }], Growth::Square)
        };
        let knots = [0.05; RESIDUAL];
        let gradient = Pullback::default().knots(&carried_back(&soon(&knots).gradient, 2.0));
        assert!(soon(&knots).energy > 0.0);
        for knot in 0..RESIDUAL {
            let at = |delta: f32| {
                let mut moved = knots;
                moved[knot] += delta;
                f64::from(soon(&moved).energy)
            };
            let slope = (at(1e-3) - at(-1e-3)) / 2e-3;
            let expected = f64::from(gradient[knot]);
            assert!((slope - expected).abs() < 0.03 * slope.abs().max(1.0), "{knot}: {slope} {expected}");
        }
    }

    #[test]
    fn a_push_lowers_the_energy() {
        let mut knots = [0.0; RESIDUAL];
        let before = energy(&knots, Growth::Square);
        let push = Pullback::default().downhill(&before.gradient, &STRAIGHT);
        assert!(push.iter().map(|p| p * p).sum::<f32>().sqrt() <= LONGEST + 1e-5);
        for (knot, push) in knots.iter_mut().zip(push) {
            *knot += 0.02 * push;
        }
        let after = energy(&knots, Growth::Square).energy;
        assert!(before.energy > 0.0 && after < before.energy, "{} to {after}", before.energy);
    }
}
