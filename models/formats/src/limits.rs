//! Limits for outside data; `scene::Scene::checked` has the same ones.

pub use scene::{MAX_AGENTS, MAX_MAP_POINTS, MAX_POLYLINE_POINTS, MAX_POLYLINES, MAX_SIGNALS, MAX_STEPS};

/// Most bytes of a short text, such as the role of a road user or the source of a scene.
pub const MAX_WORD: usize = 256;
/// Greatest distance of a goal from the start, metres.
pub const MAX_GOAL_DISTANCE_M: f64 = 1_500.0;
/// Most scenes of one import.
pub const MAX_SCENES: usize = 200;
/// Most bytes of an import once decompressed.
pub const MAX_DECODED_BYTES: u64 = 1 << 30;
/// Most values of a native document.
pub const MAX_DOCUMENT_VALUES: u64 = 32 << 20;
/// Greatest ratio of decompressed to compressed bytes, checked after the first MiB.
pub const MAX_EXPANSION: u64 = 100;

/// Greatest memory for reading a file of `encoded` bytes.
pub const fn memory_for(encoded: u64) -> u64 {
    encoded.saturating_mul(8).saturating_add(64 << 20)
}
