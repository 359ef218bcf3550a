//! Sizes of an expert, kept in the header of its weights.

use scene::AgentType;
use serde::{Deserialize, Serialize};

use super::NetError;
use crate::features::{ANCHOR, NEIGHBOUR, NEIGHBOURS, OWN};
use crate::planning::{INSTANTS, MODES, RESIDUAL};

/// Tokens of a context: neighbours, anchors.
pub const TOKENS: usize = NEIGHBOURS + MODES;

/// Generation of what features mean and of the networks' arithmetic.
const VERSION: u32 = 5;

/// Everything that decides the shapes of an expert's tensors and what they mean.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Architecture {
    /// Generation of the networks' code; another number means other arithmetic.
    pub version: u32,
    /// Width of tokens and of the context vector.
    pub width: usize,
    /// Multi-context-gating blocks.
    pub gating_blocks: usize,
    /// Blocks of the refiner.
    pub refiner_blocks: usize,
    /// Heads of every attention.
    pub heads: usize,
    /// Scale of a draw's noise, percent of 1 m/s2 along and 1 m across.
    pub noise_percent: u32,
    /// Sizes of the features the expert was trained on.
    pub features: FeatureSizes,
}

/// Sizes of features.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "the constants of `features` by their names")]
pub struct FeatureSizes {
    pub own: usize,
    pub neighbours: usize,
    pub neighbour: usize,
    pub anchor: usize,
    pub modes: usize,
    pub instants: usize,
    pub residual: usize,
}

impl FeatureSizes {
    /// Those of this program.
    pub const CURRENT: Self = Self {
        own: OWN,
        neighbours: NEIGHBOURS,
        neighbour: NEIGHBOUR,
        anchor: ANCHOR,
        modes: MODES,
        instants: INSTANTS,
        residual: RESIDUAL,
    };
}

impl Default for Architecture {
    fn default() -> Self {
        Self {
            version: VERSION,
            width: 128,
            gating_blocks: 4,
            refiner_blocks: 2,
            heads: 4,
            noise_percent: 100,
            features: FeatureSizes::CURRENT,
        }
    }
}

impl Architecture {
    /// For road users of a type: what is a shade of driving is a stagger on foot.
    pub fn of(agent_type: AgentType) -> Self {
        let noise_percent = if agent_type == AgentType::Pedestrian { 30 } else { 100 };
        Self { noise_percent, ..Self::default() }
    }

    /// Whether this program can run it.
    ///
    /// # Errors
    /// When the version, the features or the sizes do not fit.
    pub fn check(&self) -> Result<(), NetError> {
        let refuse = |reason: String| Err(NetError::Header { member: "architecture", reason });
        if self.version != VERSION {
            return refuse(format!("version {}, this program runs version {VERSION}", self.version));
        }
        if self.features != FeatureSizes::CURRENT {
            return refuse(format!(
                "features {:?}, this program has {:?}",
                self.features,
                FeatureSizes::CURRENT
            ));
        }
        if !(1..=1000).contains(&self.noise_percent) {
            return refuse(format!("noise of {} percent; 1 to 1000 can be", self.noise_percent));
        }
        let sizes = [self.width, self.gating_blocks, self.refiner_blocks, self.heads];
        if sizes.iter().any(|&size| size == 0 || size > 4096) || !self.width.is_multiple_of(self.heads) {
            return refuse(format!("sizes {sizes:?} (width, blocks, heads) cannot be"));
        }
        Ok(())
    }
}
