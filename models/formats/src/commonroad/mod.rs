//! CommonRoad scenarios: lanelets, signs and traffic lights with cycles, obstacles with trajectories,
//! planning problems.

mod document;
mod export;
mod export_map;
mod export_motion;
pub(crate) mod format;
mod goals;
mod import;
mod map;
mod motion;
mod shapes;
mod signals;
mod words;
