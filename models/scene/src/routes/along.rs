//! Places farther along the lane of a road user.

use super::start::lane_under;
use super::{LaneGraph, Pose};
use crate::geometry::direction;
use crate::{AgentType, wrap_angle};
use std::f64::consts::FRAC_PI_2;

/// Most lanes in a move.
const MOST_LANES: usize = 32;

impl LaneGraph {
    /// The pose `ahead_m` farther along the lane under it, backwards if negative: at the same offset from the
    /// lane's middle and the same angle to it. Beyond the lane it follows the first successor. If no lane is
    /// under the pose, or none follows, it continues straight on.
    pub fn moved_along(&self, pose: Pose, agent_type: AgentType, ahead_m: f64) -> Pose {
        let Some(hit) = lane_under(self, pose, agent_type) else {
            return Pose::new(pose.position + ahead_m * pose.direction(), pose.heading_rad);
        };
        let (mut lane, mut s_m) = (hit.lane, hit.s_m + ahead_m);
        for _ in 0..MOST_LANES {
            let on = &self.lanes()[lane];
            let over_m = s_m - on.path.length_m();
            let next = if over_m > 0.0 {
                &on.successors
            } else if s_m < 0.0 {
                &on.predecessors
            } else {
                break;
            };
            let Some(next) = next.iter().copied().find(|next| self.lanes()[*next].carries(agent_type)) else {
                break;
            };
            s_m = if over_m > 0.0 { over_m } else { s_m + self.lanes()[next].path.length_m() };
            lane = next;
        }
        let on = self.lanes()[lane].path.extrapolate(s_m);
        let left = direction(on.heading_rad + FRAC_PI_2);
        let turn_rad = wrap_angle(pose.heading_rad - hit.heading_rad);
        Pose::new(on.position + hit.lateral_m * left, wrap_angle(on.heading_rad + turn_rad))
    }
}

#[cfg(test)]
mod tests {
    use crate::AgentType::{Pedestrian, Vehicle};
    use crate::routes::sample_maps::{crossing, two_lanes};
    use crate::routes::{LaneGraph, Pose};
    use std::f64::consts::FRAC_PI_2;

    fn near(pose: Pose, x_m: f64, y_m: f64, heading_rad: f64) {
        let off = (pose.position - crate::Vec2::new(x_m, y_m)).norm();
        assert!(off < 0.05 && (pose.heading_rad - heading_rad).abs() < 0.05, "{pose:?}");
    }

    #[test]
    fn a_move_follows_the_lane_and_those_after_it() {
        let graph = LaneGraph::new(&crossing());
        // Straight on from the western arm, 0.3 m left of the middle and slightly turned.
        let pose = Pose::xyh(-20.0, -1.45, 0.1);
        near(graph.moved_along(pose, Vehicle, 5.0), -15.0, -1.45, 0.1);
        // The first path through the crossing turns right, on a quarter circle of 10.25 m radius.
        let through = graph.moved_along(pose, Vehicle, 8.0 + FRAC_PI_2 * 10.25 + 4.0);
        near(through, -1.45, -16.0, 0.1 - FRAC_PI_2);
        let back = graph.moved_along(through, Vehicle, -(8.0 + FRAC_PI_2 * 10.25 + 4.0));
        near(back, pose.position.x, pose.position.y, pose.heading_rad);
    }

    #[test]
    fn a_move_off_the_lanes_goes_straight_on() {
        let graph = LaneGraph::new(&two_lanes());
        near(graph.moved_along(Pose::xyh(0.0, 30.0, FRAC_PI_2), Vehicle, -4.0), 0.0, 26.0, FRAC_PI_2);
        near(graph.moved_along(Pose::xyh(0.0, 0.0, FRAC_PI_2), Pedestrian, 2.0), 0.0, 2.0, FRAC_PI_2);
        // Beyond a lane that ends, it continues straight on.
        near(graph.moved_along(Pose::xyh(199.0, 0.0, 0.0), Vehicle, 6.0), 205.0, 0.0, 0.0);
    }
}
