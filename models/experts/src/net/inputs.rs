//! Arrays of features stacked into tensors, always padded to the same sizes.

use candle_core::{Device, Result, Tensor};

use super::architecture::TOKENS;
use crate::features::{
    ANCHOR, AgentFeatures, MODES, NEIGHBOUR, NEIGHBOURS, OWN, PIECE, PIECE_POSE, PIECES, RESIDUAL,
};

/// Added to the scores and maxima of padding.
const NO: f32 = -1e4;

/// Road users as tensors.
pub struct Inputs {
    /// [batch, OWN]
    pub own: Tensor,
    /// [batch * PIECES], rows of the encoded map; 0 at padding.
    pub piece: Tensor,
    /// [batch * PIECES, PIECE_POSE]
    pub pose: Tensor,
    /// [batch, NEIGHBOURS, NEIGHBOUR]
    pub neighbours: Tensor,
    /// [batch, MODES, ANCHOR]
    pub anchors: Tensor,
    /// [batch, TOKENS], 0 or -1e4 at padding.
    pub mask: Tensor,
    /// [batch, 2, KNOTS, KNOTS]
    pub tangent: Tensor,
}

impl Inputs {
    /// Stacks road users. `rows` is the number of rows of the encoded map.
    ///
    /// # Errors
    /// When a road user sees a piece that is not there.
    pub fn stack(agents: &[&AgentFeatures], rows: usize, device: &Device) -> Result<Self> {
        let batch = agents.len();
        let (mut own, mut anchors) =
            (Vec::with_capacity(batch * OWN), Vec::with_capacity(batch * MODES * ANCHOR));
        let mut piece = vec![0u32; batch * PIECES];
        let mut pose = vec![0f32; batch * PIECES * PIECE_POSE];
        let mut neighbours = vec![0f32; batch * NEIGHBOURS * NEIGHBOUR];
        let mut mask = vec![0f32; batch * TOKENS];
        let mut tangent = Vec::with_capacity(batch * RESIDUAL * RESIDUAL / 2);
        for (at, agent) in agents.iter().enumerate() {
            own.extend_from_slice(&agent.own);
            anchors.extend_from_slice(agent.anchors.as_flattened());
            tangent.extend_from_slice(agent.tangent.as_flattened().as_flattened());
            for (slot, seen) in agent.pieces.iter().take(PIECES).enumerate() {
                if seen.piece >= rows {
                    candle_core::bail!("map piece {} of {rows}", seen.piece);
                }
                piece[at * PIECES + slot] = seen.piece as u32;
                pose[(at * PIECES + slot) * PIECE_POSE..][..PIECE_POSE].copy_from_slice(&seen.pose);
            }
            let others = agent.neighbours.len().min(NEIGHBOURS);
            neighbours[at * NEIGHBOURS * NEIGHBOUR..][..others * NEIGHBOUR]
                .copy_from_slice(agent.neighbours[..others].as_flattened());
            let mask = &mut mask[at * TOKENS..][..TOKENS];
            mask[agent.pieces.len().min(PIECES)..PIECES].fill(NO);
            mask[PIECES + others..PIECES + NEIGHBOURS].fill(NO);
        }
        let knots = RESIDUAL / 2;
        Ok(Self {
            own: Tensor::from_vec(own, (batch, OWN), device)?,
            piece: Tensor::from_vec(piece, batch * PIECES, device)?,
            pose: Tensor::from_vec(pose, (batch * PIECES, PIECE_POSE), device)?,
            neighbours: Tensor::from_vec(neighbours, (batch, NEIGHBOURS, NEIGHBOUR), device)?,
            anchors: Tensor::from_vec(anchors, (batch, MODES, ANCHOR), device)?,
            mask: Tensor::from_vec(mask, (batch, TOKENS), device)?,
            tangent: Tensor::from_vec(tangent, (batch, 2, knots, knots), device)?,
        })
    }
}

/// Map pieces as a tensor [N, PIECE]; one row of zeros for a map without pieces.
///
/// # Errors
/// When memory for it cannot be had.
pub fn pieces(pieces: &[[f32; PIECE]], device: &Device) -> Result<Tensor> {
    if pieces.is_empty() {
        return Tensor::from_vec(vec![0f32; PIECE], (1, PIECE), device);
    }
    Tensor::from_slice(pieces.as_flattened(), (pieces.len(), PIECE), device)
}
