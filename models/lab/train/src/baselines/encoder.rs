//! Encoder of a road user's surroundings, by multi-context gating (Varadarajan et al., "MultiPath++", 2021).
//! The regressor has one such encoder, and the paper's denoiser has its own.

use candle_core::{Device, Result, Tensor};
use experts::features::{AgentFeatures, NEIGHBOUR, NEIGHBOURS, OWN, OWN_CONDITION, OWN_GOAL_VALUES};
use experts::net::inputs::{InputTensors, NO};
use experts::net::layers::{Mlp, Norm, RELU_GAIN};
use experts::net::{Gating, NetError, Params};

use super::Plan;
use crate::polylines::{PIECE, PIECE_POSE, PIECES, SeenPiece};

/// Width of a map piece's encoding.
const PIECE_WIDTH: usize = 64;
/// Numbers of the condition: position, velocity and heading at the end, length and width of the box.
pub(super) const CONDITION: usize = 8;

/// A batch of road users as tensors, before any network.
pub(super) struct Sight {
    /// Encoded map's rows, [pieces, PIECE].
    map: Tensor,
    lines: Lines,
    inputs: InputTensors,
    /// Of pieces and neighbours, [batch, PIECES + NEIGHBOURS].
    mask: Tensor,
    /// [batch, CONDITION]; `None` for networks without a condition.
    condition: Option<Tensor>,
}

impl Sight {
    /// Stacks the features of road users, the map pieces that each sees, and the pieces. If `plan` has a condition, the
    /// goal values are moved from the state of the road user to a separate input.
    pub(super) fn stack(
        plan: &Plan,
        map: &[[f32; PIECE]],
        seen: &[&[SeenPiece]],
        agents: &[&AgentFeatures],
        device: &Device,
    ) -> Result<Self> {
        // One row of zeros for a map without pieces.
        let none = [[0.0; PIECE]];
        let map = if map.is_empty() { &none } else { map };
        let map = Tensor::from_slice(map.as_flattened(), (map.len(), PIECE), device)?;
        let (inputs, condition) = if plan.kind.has_condition() {
            let conditions: Vec<[f32; CONDITION]> = agents.iter().map(|agent| condition(agent)).collect();
            let mut states: Vec<AgentFeatures> = agents.iter().map(|agent| (*agent).clone()).collect();
            states.iter_mut().for_each(|agent| agent.own[OWN_GOAL_VALUES].fill(0.0));
            let inputs = InputTensors::stack(&states.iter().collect::<Vec<_>>(), device)?;
            let conditions =
                Tensor::from_slice(conditions.as_flattened(), (conditions.len(), CONDITION), device)?;
            (inputs, Some(conditions))
        } else {
            (InputTensors::stack(agents, device)?, None)
        };
        let lines = Lines::stack(seen, device)?;
        let mask = Tensor::cat(&[&lines.mask, &inputs.mask.narrow(1, 0, NEIGHBOURS)?], 1)?;
        Ok(Self { map, lines, inputs, mask, condition })
    }
}

/// The condition of a road user. A speed without a heading is taken along the present heading.
fn condition(agent: &AgentFeatures) -> [f32; CONDITION] {
    let [ahead, left, cos, sin, speed, length, width] = OWN_CONDITION.map(|i| agent.own[i]);
    let way = if cos == 0.0 && sin == 0.0 { 1.0 } else { cos };
    [ahead, left, speed * way, speed * sin, cos, sin, length, width]
}

/// Encoding of a batch of road users.
pub(super) struct EncodedBatch {
    /// [batch, width]
    pub(super) vector: Tensor,
    /// [batch, 1 + PIECES + NEIGHBOURS, width]: the vector, map pieces, neighbours.
    pub(super) tokens: Tensor,
    /// Additive mask of the tokens.
    pub(super) mask: Tensor,
    /// The encoded condition, [batch, condition width], if there is one.
    pub(super) condition: Option<Tensor>,
}

/// Map pieces that a batch sees, padded.
struct Lines {
    /// [batch * PIECES], rows of the encoded map; 0 at padding.
    piece: Tensor,
    /// [batch * PIECES, PIECE_POSE]
    pose: Tensor,
    /// [batch, PIECES], 0 or -1e4 at padding.
    mask: Tensor,
}

impl Lines {
    fn stack(seen: &[&[SeenPiece]], device: &Device) -> Result<Self> {
        let batch = seen.len();
        let mut piece = vec![0u32; batch * PIECES];
        let mut pose = vec![[0f32; PIECE_POSE]; batch * PIECES];
        let mut mask = vec![NO; batch * PIECES];
        for (at, seen) in seen.iter().enumerate() {
            for (slot, seen) in (at * PIECES..).zip(seen.iter().take(PIECES)) {
                (piece[slot], pose[slot], mask[slot]) = (seen.piece as u32, seen.pose, 0.0);
            }
        }
        Ok(Self {
            piece: Tensor::from_vec(piece, batch * PIECES, device)?,
            pose: Tensor::from_slice(pose.as_flattened(), (batch * PIECES, PIECE_POSE), device)?,
            mask: Tensor::from_vec(mask, (batch, PIECES), device)?,
        })
    }
}

/// Sight to context.
pub(super) struct Encoder {
    map: Mlp,
    own: Mlp,
    piece: Mlp,
    neighbour: Mlp,
    /// The paper's MLP of the condition; its output joins those of state and lanes.
    condition: Option<Mlp>,
    gating: Gating,
    mix: Mlp,
    norm: Norm,
}

impl Encoder {
    /// Parameters under `name`.
    pub(super) fn new(p: &mut Params, name: &str, plan: &Plan) -> std::result::Result<Self, NetError> {
        let (a, d) = (&plan.sizes, plan.sizes.width);
        let of = |part: &str| format!("{name}.{part}");
        let wide = if plan.kind.has_condition() { plan.condition_width } else { 0 };
        let condition = match wide {
            0 => None,
            wide => Some(Mlp::new(p, &of("condition"), [CONDITION, wide, wide], RELU_GAIN)?.relu()),
        };
        Ok(Self {
            map: Mlp::new(p, &of("map"), [PIECE, PIECE_WIDTH, PIECE_WIDTH], RELU_GAIN)?.relu(),
            own: Mlp::new(p, &of("own"), [OWN, d, d], RELU_GAIN)?.relu(),
            piece: Mlp::new(p, &of("piece"), [PIECE_WIDTH + PIECE_POSE, d, d], RELU_GAIN)?.relu(),
            neighbour: Mlp::new(p, &of("neighbour"), [NEIGHBOUR, d, d], RELU_GAIN)?.relu(),
            condition,
            gating: Gating::new(p, &of("context"), (a.gating_blocks, d), &[PIECES, NEIGHBOURS])?,
            mix: Mlp::new(p, &of("mix"), [2 * d + wide, d, d], 1.0)?,
            norm: Norm::new(p, &of("norm"), d)?,
        })
    }

    /// Reads a batch.
    pub(super) fn read(&self, sight: &Sight) -> Result<EncodedBatch> {
        let (batch, _) = sight.mask.dims2()?;
        let map = self.map.forward(&sight.map)?;
        let own = self.own.forward(&sight.inputs.own)?;
        let lines = Tensor::cat(&[&map.index_select(&sight.lines.piece, 0)?, &sight.lines.pose], 1)?;
        let lines = self.piece.forward(&lines)?.reshape((batch, PIECES, ()))?;
        let tokens = Tensor::cat(&[&lines, &self.neighbour.forward(&sight.inputs.neighbours)?], 1)?;
        let (context, tokens) = self.gating.forward(&own, tokens, &sight.mask)?;
        let condition = match (&self.condition, &sight.condition) {
            (Some(mlp), Some(condition)) => Some(mlp.forward(condition)?),
            _ => None,
        };
        let joined: Vec<&Tensor> = [&own, &context].into_iter().chain(&condition).collect();
        let vector = self.norm.forward(&self.mix.forward(&Tensor::cat(&joined, 1)?)?)?;
        let seen_by_all = Tensor::zeros((batch, 1), sight.mask.dtype(), sight.mask.device())?;
        Ok(EncodedBatch {
            tokens: Tensor::cat(&[&vector.unsqueeze(1)?, &tokens], 1)?,
            mask: Tensor::cat(&[&seen_by_all, &sight.mask], 1)?,
            vector,
            condition,
        })
    }
}
