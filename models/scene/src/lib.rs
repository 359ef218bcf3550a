//! Data model of a traffic scene: lane map, signals, road users with their tracks, fixed conditions, and the
//! motions that each road user can make.
//!
//! Units and frame everywhere: metres, seconds, radians; x east, y north, heading counter-clockwise from +x,
//! wrapped to [-pi, pi); time zero is the first step; one step is [`STEP_S`].
//!
//! No files, no network, no tensors. A value of this crate is valid by its type: outside data becomes a
//! [`Scene`] in one fallible step ([`Scene::checked`]).
//!
//! ```
//! use scene::score::{Drivable, ScoreInput, score};
//! use scene::{Agent, AgentType, LaneMap, STEP_S, Scene, State, Subtype};
//!
//! // A car at 15 m/s, and 24 m ahead of it a car at 5 m/s.
//! let drive = |id: &str, x: f64, speed: f64| {
//!     let at = |step: i32| State { x_m: x + speed * STEP_S * f64::from(step), vx_mps: speed, ..State::default() };
//!     Agent::bare(id, AgentType::Vehicle, Subtype::Car, (0..91).map(|step| Some(at(step))).collect())
//! };
//! let scene = Scene::bare("", LaneMap::default(), vec![drive("a", 0.0, 15.0), drive("b", 24.0, 5.0)]);
//!
//! let drivable = Drivable::new(&scene.map);
//! let score = score(&ScoreInput::of_scene(&scene, &drivable));
//! assert_eq!(score.scene.collisions.len(), 1);
//! assert_eq!(score.agents["a"].min_ttc_s, Some(0.0));
//! ```

pub mod agent;
mod cancel;
pub mod condition;
pub mod generated;
pub mod geometry;
pub mod hash;
pub mod judge;
pub mod licence;
pub mod limits;
pub mod map;
pub mod message;
pub mod motion;
pub mod objects;
pub mod preference;
pub mod random;
pub mod relation;
pub mod routes;
pub mod scenarios;
mod scene;
pub mod score;
pub mod sentences;
pub mod shared;
mod shown;
pub mod signal;
pub mod via;

pub use agent::{Agent, AgentId, AgentType, Size, State, Subtype, Track};
pub use cancel::Cancel;
pub use condition::{Conditions, Goal, MAX_CROSSED_EDGES, Start};
pub use generated::{AgentFutures, Future, Generated, Sample};
pub use geometry::{Vec2, wrap_angle};
pub use hash::ContentHash;
pub use map::LaneMap;
pub use relation::{GoalRelation, RelativePlace};
pub use scene::{
    MAX_AGENTS, MAX_AREA_CORNERS, MAX_COORDINATE_M, MAX_LANE_LINKS, MAX_MAP_LINKS, MAX_MAP_POINTS,
    MAX_NAME_CHARS, MAX_NOTES_CHARS, MAX_POLYLINE_POINTS, MAX_POLYLINES, MAX_SIGNALS, MAX_STEPS,
};
pub use scene::{Meta, Origin, Scene, SceneError, Timing};
pub use shared::Shared;
pub use shown::Shown;
pub use signal::{Signal, SignalState};
pub use via::{DEFAULT_VIA_TOLERANCE_M, MAX_VIAS, Passing, VIA_TOLERANCE_M, Via};

/// Length of one step in seconds, fixed for the whole product (10 Hz).
pub const STEP_S: f64 = 0.1;
/// Steps in one planning window (9 s).
pub const HORIZON_STEPS: usize = 90;
/// Most steps of one answer, over all its planning windows (20 s).
pub const MAX_HORIZON_STEPS: usize = 200;
/// Control knots of a future, one per second from 0 to 9 s (more do not fit recorded motion better). Their
/// number minus one divides the horizon's steps.
pub const KNOTS: usize = 10;
/// Agents slower than this count as standing, m/s: recordings show waiting road users with speeds up to it.
pub const STANDING_MPS: f64 = 0.3;
/// Steps from a knot to the next.
pub const KNOT_STEPS: usize = HORIZON_STEPS / (KNOTS - 1);
/// Seconds from a knot to the next.
pub const KNOT_S: f64 = KNOT_STEPS as f64 * STEP_S;
