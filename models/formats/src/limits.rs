//! Bounds on outside data (`api.md` section 9); `scene::Scene::checked` holds the same ones.

/// Most road users in a scene.
pub const MAX_AGENTS: usize = 256;
/// Most steps in a scene.
pub const MAX_STEPS: usize = 600;
/// Most points in one map line.
pub const MAX_POLYLINE_POINTS: usize = 4_096;
/// Most map lines and areas.
pub const MAX_POLYLINES: usize = 20_000;
/// Most points of all map lines and areas.
pub const MAX_MAP_POINTS: usize = 400_000;
/// Most signals.
pub const MAX_SIGNALS: usize = 512;
/// Most scenes that one import gives.
pub const MAX_SCENES: usize = 200;
/// Most bytes of an import once decompressed.
pub const MAX_DECODED_BYTES: u64 = 1 << 30;
/// Greatest ratio of decompressed to compressed bytes, looked at after the first MiB.
pub const MAX_EXPANSION: u64 = 100;
