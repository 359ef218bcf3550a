//! Arrays of features stacked into tensors, always padded to the same sizes.

use candle_core::{Device, Result, Tensor};

use super::architecture::TOKENS;
use crate::features::encounters::{ENCOUNTER, ENCOUNTERS, Encounters};
use crate::features::{ANCHOR, AgentFeatures, NEIGHBOUR, NEIGHBOURS, OWN};
use crate::planning::{MODES, RESIDUAL};

/// Value added to the scores and maxima of padding.
pub const NO: f32 = -1e4;

/// Road users as tensors.
pub struct InputTensors {
    /// [batch, OWN]
    pub own: Tensor,
    /// [batch, NEIGHBOURS, NEIGHBOUR]
    pub neighbours: Tensor,
    /// [batch, MODES, ANCHOR]
    pub anchors: Tensor,
    /// [batch, TOKENS], 0 or -1e4 at padding.
    pub mask: Tensor,
    /// [batch, 2, KNOTS, KNOTS]
    pub tangent: Tensor,
}

impl InputTensors {
    /// Stacks road users.
    ///
    /// # Errors
    /// When memory for them cannot be allocated.
    pub fn stack(agents: &[&AgentFeatures], device: &Device) -> Result<Self> {
        let batch = agents.len();
        let (mut own, mut anchors) =
            (Vec::with_capacity(batch * OWN), Vec::with_capacity(batch * MODES * ANCHOR));
        let mut neighbours = vec![0f32; batch * NEIGHBOURS * NEIGHBOUR];
        let mut mask = vec![0f32; batch * TOKENS];
        let mut tangent = Vec::with_capacity(batch * RESIDUAL * RESIDUAL / 2);
        for (at, agent) in agents.iter().enumerate() {
            own.extend_from_slice(&agent.own);
            anchors.extend_from_slice(agent.anchors.as_flattened());
            tangent.extend_from_slice(agent.tangent.as_flattened().as_flattened());
            let others = agent.neighbours.len().min(NEIGHBOURS);
            neighbours[at * NEIGHBOURS * NEIGHBOUR..][..others * NEIGHBOUR]
                .copy_from_slice(agent.neighbours[..others].as_flattened());
            mask[at * TOKENS..][others..NEIGHBOURS].fill(NO);
        }
        let knots = RESIDUAL / 2;
        Ok(Self {
            own: Tensor::from_vec(own, (batch, OWN), device)?,
            neighbours: Tensor::from_vec(neighbours, (batch, NEIGHBOURS, NEIGHBOUR), device)?,
            anchors: Tensor::from_vec(anchors, (batch, MODES, ANCHOR), device)?,
            mask: Tensor::from_vec(mask, (batch, TOKENS), device)?,
            tangent: Tensor::from_vec(tangent, (batch, 2, knots, knots), device)?,
        })
    }
}

/// Encounters of the drafts of a batch as tensors.
pub struct EncounterTensors {
    /// [batch * MODES, 1 + ENCOUNTERS, ENCOUNTER]; the first of each row is empty, all zeros.
    pub numbers: Tensor,
    /// [batch * MODES, 1 + ENCOUNTERS], 0 or -1e4 at padding.
    pub mask: Tensor,
}

impl EncounterTensors {
    /// Stacks the encounters of each agent's drafts.
    ///
    /// # Errors
    /// When memory for them cannot be allocated.
    pub fn stack(agents: &[&Encounters], device: &Device) -> Result<Self> {
        const TOKENS: usize = 1 + ENCOUNTERS;
        let rows = agents.len() * MODES;
        let (mut numbers, mut mask) = (vec![0f32; rows * TOKENS * ENCOUNTER], vec![NO; rows * TOKENS]);
        for (row, found) in agents.iter().copied().flatten().enumerate() {
            let found = &found[..found.len().min(ENCOUNTERS)];
            numbers[(row * TOKENS + 1) * ENCOUNTER..][..found.len() * ENCOUNTER]
                .copy_from_slice(found.as_flattened());
            mask[row * TOKENS..][..=found.len()].fill(0.0);
        }
        Ok(Self {
            numbers: Tensor::from_vec(numbers, (rows, TOKENS, ENCOUNTER), device)?,
            mask: Tensor::from_vec(mask, (rows, TOKENS), device)?,
        })
    }
}
