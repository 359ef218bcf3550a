//! Sizes of an expert, kept in the header of its weights.

use scene::AgentType;
use serde::{Deserialize, Serialize};

use super::error::NetError;
use crate::features::NEIGHBOURS;
use crate::features::tables::tables_hash;
use crate::planning::MODES;

/// Tokens of a context: neighbours, anchors.
pub const TOKENS: usize = NEIGHBOURS + MODES;

/// Version of the networks' arithmetic. The hash of the tables identifies their inputs.
const VERSION: u32 = 6;

/// Everything that determines the shapes of an expert's tensors and their meaning.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Architecture {
    /// Version of the networks' code; another number means other arithmetic.
    pub version: u32,
    /// Width of tokens and of the context vector.
    pub width: usize,
    /// Multi-context-gating blocks.
    pub gating_blocks: usize,
    /// MLP blocks of a refiner without attention.
    pub refiner_blocks: usize,
    /// Pairs of attention blocks instead: to a draft's encounters, then to the context. 0 in the shipped
    /// weights.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub refiner_attention: usize,
    /// Heads of every attention.
    pub heads: usize,
    /// Scale of a draw's noise, percent of 1 m/s2 along and 1 m across.
    pub noise_percent: u32,
    /// Hash of the tables of features that the expert was trained on.
    pub features: String,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

impl Default for Architecture {
    fn default() -> Self {
        Self {
            version: VERSION,
            width: 128,
            gating_blocks: 4,
            refiner_blocks: 2,
            refiner_attention: 0,
            heads: 4,
            noise_percent: 100,
            features: tables_hash(),
        }
    }
}

impl Architecture {
    /// The architecture for a type; noise that is small for a vehicle would be a stagger on foot.
    pub fn of(agent_type: AgentType) -> Self {
        let noise_percent = if agent_type == AgentType::Pedestrian { 30 } else { 100 };
        Self { noise_percent, ..Self::default() }
    }

    /// Checks that this program can run it.
    ///
    /// # Errors
    /// When the version, the features or the sizes do not fit.
    pub fn check(&self) -> Result<(), NetError> {
        let refuse = |reason: String| Err(NetError::Header { member: "architecture", reason });
        if self.version != VERSION {
            return refuse(format!("version {}, this program runs version {VERSION}", self.version));
        }
        let features = tables_hash();
        if self.features != features {
            let found = &self.features;
            return refuse(format!("trained on features {found}, this program has {features}"));
        }
        if !(1..=1000).contains(&self.noise_percent) {
            return refuse(format!("noise of {} percent; 1 to 1000 can be", self.noise_percent));
        }
        let sizes = [self.width, self.gating_blocks, self.refiner_blocks, self.heads];
        if self.refiner_attention > 16 {
            return refuse(format!("{} pairs of attention; 0 to 16 can be", self.refiner_attention));
        }
        if sizes.iter().any(|&size| size == 0 || size > 4096) || !self.width.is_multiple_of(self.heads) {
            return refuse(format!("sizes {sizes:?} (width, blocks, heads) cannot be"));
        }
        Ok(())
    }
}
