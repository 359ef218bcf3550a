//! How the numbers of the situations of a plan are chosen.

use crate::fault::PlanFault;
use formats::native::MAX_SAFE_INTEGER;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most draws of one situation for one road user.
pub const MOST_DRAWS: u64 = 1_000_000;

/// Method by which the numbers of a situation are chosen.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BatchSampling {
    /// A grid takes every combination; the other methods take `draws` draws.
    pub method: SamplingMethod,
    /// Draws per scene, situation and road user; tries per search.
    #[schemars(range(min = 1, max = 1000000))]
    pub draws: u64,
    /// Seed of the draws.
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: u64,
}

impl Default for BatchSampling {
    fn default() -> Self {
        Self { method: SamplingMethod::Grid, draws: 10, seed: 0 }
    }
}

/// Method by which the numbers of a situation are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SamplingMethod {
    /// Every combination of the values.
    Grid,
    /// Independent draws.
    Random,
    /// Each range has as many strata of equal width as there are draws, and one draw in each.
    LatinHypercube,
    /// Scrambled Sobol points, which spread evenly over all ranges at once; best with a power of two of draws.
    Sobol,
    /// Search for results that satisfy `where`: CMA-ES over the ranges, separately for each seed.
    Search,
}

impl BatchSampling {
    /// Checks the ranges.
    pub(crate) fn check(&self, faults: &mut Vec<PlanFault>) {
        if !(1..=MOST_DRAWS).contains(&self.draws) {
            faults.push(PlanFault::new("sampling.draws", format!("1 to {MOST_DRAWS} expected")));
        }
        if self.seed > MAX_SAFE_INTEGER {
            faults.push(PlanFault::new("sampling.seed", format!("at most {MAX_SAFE_INTEGER} expected")));
        }
    }
}
