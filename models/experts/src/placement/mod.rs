//! Placement G(map): adds road users to a map (`POST /v1/place`).
//!
//! Cells of lanes, kerbs, crosswalks, pavements and driveways are drawn one at a time, in proportion to
//! learned rates. Each placed agent changes the rates behind it. Pose and box come from learned
//! distributions; a pose that touches another agent is drawn again. Speeds are drawn last, nearest to a
//! conflict first, so that each follower knows its leader.

mod arms;
mod arrivals;
mod assign;
mod cells;
mod checks;
mod context;
mod driving;
mod following;
pub mod learn;
mod model;
mod parking;
mod place;
mod placed;
mod placer;
mod pose;
mod random;
mod region;
mod request;
mod room;
mod speeds;
mod stop_lines;

pub use arms::{Arm, ArmLane};
pub use driving::SpeedRange;
pub use model::{PlacementInfo, PlacementModel};
pub use place::place;
pub use placer::Placer;
pub use region::{Region, map_extent, ring_area_m2};
pub use request::{
    Amount, ArmTraffic, Arrivals, MAX_COUNT, MAX_GAP_M, MAX_PARKED_PER_100M, MAX_PER_HOUR, MAX_PER_LANE_KM,
    MAX_SPEED_MPS, Parked, PlaceRequest, Placement, PlacementMethod,
};
