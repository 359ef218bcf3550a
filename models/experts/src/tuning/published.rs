//! Fixed numbers of planning that clients need too: what they show before an answer follows the same rules.

use super::fixed::{blocks, following, lights, variations};

/// Front bumper to stop line, metres.
pub const STOP_LINE_GAP_M: f64 = blocks::LINE_GAP_M;
/// A stop line belongs to a path that passes it nearer than this, metres.
pub const STOP_LINE_BESIDE_M: f64 = blocks::LINE_BESIDE_M;
/// And whose direction differs from that of the line's lane by less than this, radians.
pub const STOP_LINE_TURNED_RAD: f64 = blocks::LINE_TURNED_RAD;
/// Front bumper to what stands ahead, metres.
pub const QUEUE_GAP_M: f64 = following::GAP_M;
/// A standing agent nearer to a path than this is in the queue on it, metres.
pub const IN_QUEUE_M: f64 = lights::IN_QUEUE_M;
/// Speed cap of walkers, m/s.
pub const WALKING_MPS: f64 = variations::WALKING_MPS;
