//! Constants of planning that clients need too: what they show before an answer follows the same rules.

use super::fixed::{blocks, following, lights, variations};

/// Front bumper to stop line, metres.
pub const STOP_LINE_GAP_M: f64 = blocks::LINE_GAP_M;
/// A stop line belongs to a path that passes it within this distance, metres.
pub const STOP_LINE_BESIDE_M: f64 = blocks::LINE_BESIDE_M;
/// The path's heading then differs from that of the line's lane by less than this, radians.
pub const STOP_LINE_TURNED_RAD: f64 = blocks::LINE_TURNED_RAD;
/// Distance between the front bumper and a standing leader, metres.
pub const QUEUE_GAP_M: f64 = following::GAP_M;
/// A standing agent within this distance of a path is in the queue on it, metres.
pub const IN_QUEUE_M: f64 = lights::IN_QUEUE_M;
/// Highest walking speed, m/s.
pub const WALKING_MPS: f64 = variations::WALKING_MPS;
