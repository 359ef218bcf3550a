//! Constraints on a drawn pose: it touches no other agent, and its type is allowed there.

use super::cells::{CellKind, Cells};
use super::placed::PlacedAgent;
use super::stop_lines::{LineAhead, STOP_LINE_M, StopControl};
pub(super) use crate::tuning::placing::checks::END_M;
use crate::tuning::placing::checks::{
    BAND, BEFORE_M, CROSSING_M, LANE_REACH_M, LONG_M, LONG_TURN_RAD, MARGIN_M, PAST_EDGE_M, SIDE_M,
    WALK_AHEAD_M, WALK_SIDE_M,
};
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::geometry::wrap_angle;
use scene::routes::speed::Obstacle;
use scene::routes::{GraphLane, LaneGraph};
use scene::{AgentType, Vec2};
use std::f64::consts::FRAC_PI_4;

/// Type of a present road user, with its lane and its arc length on it, metres.
pub(super) type KindOnLane = (AgentType, Option<(usize, f64)>);

/// The boxes from which a new road user keeps clear.
#[derive(Default)]
pub(super) struct Neighbours {
    /// Kept road users, then placed ones in order.
    pub(super) obstacles: Vec<Obstacle>,
    /// Type of each; lane and arc length of each driver.
    pub(super) kinds: Vec<KindOnLane>,
    /// Boxes of kept road users in the next moments.
    pub(super) next: Vec<OrientedBox>,
}

impl Neighbours {
    /// Adds a road user.
    pub(super) fn push(&mut self, obstacle: Obstacle, agent_type: AgentType, lane: Option<(usize, f64)>) {
        self.obstacles.push(obstacle);
        self.kinds.push((agent_type, lane));
    }

    /// Whether no obstacle is too near. `min_gap_m` is the room along the lane between drivers of the same
    /// direction. Drivers that pass or cross each other keep a gap, and no pedestrian is directly in front of
    /// a driver.
    pub(super) fn is_free(&self, placed: &PlacedAgent, min_gap_m: f64) -> bool {
        let outline = placed.outline();
        let near = outline.grown(MARGIN_M);
        let gap_m = min_gap_m.max(MARGIN_M);
        let wide = |outline: &OrientedBox, gap_m: f64| {
            let (length_m, width_m) = (outline.half_length_m() + gap_m, outline.half_width_m() + SIDE_M);
            OrientedBox::new(outline.center(), length_m, width_m, outline.heading_rad())
        };
        let (long, beside) = (wide(&outline, gap_m), wide(&outline, MARGIN_M));
        let (passing, crossing) = (outline.grown(SIDE_M), outline.grown(CROSSING_M));
        let in_the_way = |next: &OrientedBox| overlaps(&near, next, 0.0);
        let apart = |(other, kept): (&Obstacle, &KindOnLane)| {
            let (agent_type, lane) = kept;
            let turn = wrap_angle(other.outline.heading_rad() - outline.heading_rad()).abs();
            let other = &other.outline;
            match (placed.lane.is_some(), lane.is_some()) {
                (true, true) if turn < FRAC_PI_4 => !overlaps(&long, other, 0.0),
                (true, true) if turn > 3.0 * FRAC_PI_4 => !overlaps(&passing, other, 0.0),
                (true, true) => !overlaps(&crossing, other, 0.0),
                (true, false) if *agent_type != AgentType::Vehicle => {
                    !overlaps(&before(&outline), other, 0.0)
                }
                (true, false) => !overlaps(&beside, other, 0.0),
                (false, true) if placed.agent_type != AgentType::Vehicle => {
                    !overlaps(&before(other), &outline, 0.0)
                }
                (false, true) => !overlaps(&near, &wide(other, MARGIN_M), 0.0),
                (false, false)
                    if turn > FRAC_PI_4
                        && ![placed.agent_type, *agent_type].contains(&AgentType::Vehicle) =>
                {
                    !overlaps(&outline.grown(WALK_SIDE_M), other, 0.0)
                }
                _ => !overlaps(&near, other, 0.0),
            }
        };
        self.obstacles.iter().zip(&self.kinds).all(apart) && !self.next.iter().any(in_the_way)
    }
}

/// Zone without pedestrians: the box of a driver, the strip beside it, and the next metres ahead.
fn before(driver: &OrientedBox) -> OrientedBox {
    let center = driver.center() + driver.forward() * (0.5 * BEFORE_M);
    let (half_length_m, half_width_m) =
        (driver.half_length_m() + 0.5 * BEFORE_M, driver.half_width_m() + WALK_SIDE_M);
    OrientedBox::new(center, half_length_m, half_width_m, driver.heading_rad())
}

/// Drivers are not beyond the stop line of a red signal, and parked vehicles are off the lanes. People on pavements
/// neither stand on a lane nor face one nearby.
pub(super) fn is_sensible(placed: &PlacedAgent, cells: &Cells<'_>) -> bool {
    let outline = placed.outline();
    match placed.kind {
        CellKind::Lane if !is_on_the_road(placed, cells.graph) => false,
        CellKind::Lane => {
            match placed.lane.map(|lane| cells.lights.ahead(cells.graph, lane, placed.pose.s_m)) {
                Some(LineAhead::StopLine(StopControl::Red, m)) => m >= outline.half_length_m() + STOP_LINE_M,
                _ => true,
            }
        }
        CellKind::Kerb | CellKind::Driveway => {
            let nose = outline.forward() * outline.half_length_m();
            let points = around(&outline).chain([outline.center() + nose, outline.center() - nose]);
            points.chain([outline.center()]).all(|p| !on_lane(p, cells.graph))
        }
        CellKind::Pavement => {
            let ahead = outline.center() + outline.forward() * WALK_AHEAD_M;
            [outline.center(), ahead].iter().all(|p| !on_lane(*p, cells.graph))
        }
        CellKind::Crosswalk => true,
    }
}

/// Whether the vehicle does not overhang the edge of the road or of the map, and a long one does not stand
/// across lanes.
fn is_on_the_road(placed: &PlacedAgent, graph: &LaneGraph) -> bool {
    let Some(index) = placed.lane else { return true };
    let lane = &graph.lanes()[index];
    let half_m = 0.5 * placed.size.length_m;
    let (before_m, after_m) = (placed.pose.s_m, lane.path.length_m() - placed.pose.s_m);
    let long_enough = lane.path.length_m() > 2.0 * (half_m + END_M);
    let leaves = long_enough && lane.successors.is_empty() && after_m < half_m + END_M;
    let hangs = long_enough && lane.predecessors.is_empty() && before_m < half_m;
    // Drivers leave a lane that ends before its last metres.
    let should_have_changed =
        graph.leaves_before_m(index, placed.agent_type).is_some_and(|last_m| placed.pose.s_m > last_m);
    if leaves || hangs || should_have_changed {
        return false;
    }
    let outline = placed.outline();
    let beyond_edge =
        || graph.ground().box_outside_m(&outline).is_some_and(|outside_m| outside_m > PAST_EDGE_M);
    if placed.agent_type == AgentType::Vehicle && beyond_edge() {
        return false;
    }
    let ends = [1.0, -1.0].map(|end| outline.center() + outline.forward() * (end * half_m));
    placed.size.length_m < LONG_M || ends.iter().all(|p| is_along(*p, outline.heading_rad(), graph))
}

/// Whether the point lies on the band of a lane with about this heading.
fn is_along(point: Vec2, heading_rad: f64, graph: &LaneGraph) -> bool {
    let hits = graph.nearest_lanes(point, LANE_REACH_M, |_, lane| lane.carries(AgentType::Vehicle));
    hits.iter().any(|hit| {
        let half_m = 0.5 * graph.lanes()[hit.lane].width_m;
        hit.distance_m < BAND * half_m && wrap_angle(hit.heading_rad - heading_rad).abs() < LONG_TURN_RAD
    })
}

/// Corners, and the middles of the long sides.
pub(super) fn around(outline: &OrientedBox) -> impl Iterator<Item = Vec2> {
    let left = outline.left() * outline.half_width_m();
    outline.corners().into_iter().chain([outline.center() + left, outline.center() - left])
}

/// Whether the point lies on the used band of some lane.
pub(super) fn on_lane(point: Vec2, graph: &LaneGraph) -> bool {
    let drives = |_: usize, l: &GraphLane| l.carries(AgentType::Vehicle) || l.carries(AgentType::Cyclist);
    let hits = graph.nearest_lanes(point, LANE_REACH_M, drives);
    hits.iter().any(|h| h.distance_m < BAND * 0.5 * graph.lanes()[h.lane].width_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placement::pose::Pose;
    use crate::placement::region::Region;
    use scene::map::{Lane, LaneMap};
    use scene::{Scene, Signal, SignalState, Size, Subtype};

    fn car(x_m: f64, y_m: f64, heading_rad: f64, kind: CellKind) -> PlacedAgent {
        let pose = Pose { position: Vec2::new(x_m, y_m), heading_rad, s_m: x_m };
        PlacedAgent {
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            size: Size { length_m: 4.0, width_m: 2.0, height_m: None },
            pose,
            free_mps: None,
            parked: false,
            kind,
            lane: (kind == CellKind::Lane).then_some(0),
        }
    }

    fn beside(other: &PlacedAgent, drives: bool) -> Neighbours {
        let mut neighbours = Neighbours::default();
        let lane = drives.then_some((0, other.pose.s_m));
        neighbours.push(Obstacle { outline: other.outline(), speed_mps: 0.0 }, other.agent_type, lane);
        neighbours
    }

    fn on_foot(x_m: f64, y_m: f64, heading_rad: f64) -> PlacedAgent {
        let (agent_type, subtype) = (AgentType::Pedestrian, Subtype::Adult);
        let size = Size { length_m: 0.5, width_m: 0.5, height_m: None };
        PlacedAgent { agent_type, subtype, size, ..car(x_m, y_m, heading_rad, CellKind::Pavement) }
    }

    #[test]
    fn nobody_is_on_foot_before_or_beside_a_driver() {
        let driver = car(10.0, 0.0, 0.0, CellKind::Lane);
        let parked = car(10.0, 0.0, 0.0, CellKind::Kerb);
        let free = |other: &PlacedAgent, drives: bool, walker: &PlacedAgent| {
            let other_way = drives && !beside(walker, false).is_free(other, 2.0);
            let free = beside(other, drives).is_free(walker, 2.0);
            assert!(!drives || free != other_way, "the order of placing does not matter");
            free
        };
        // The nose is at 12 m, the side at 1 m.
        assert!(
            !free(&driver, true, &on_foot(14.0, 0.0, 0.0)) && free(&driver, true, &on_foot(16.0, 0.0, 0.0))
        );
        assert!(
            !free(&driver, true, &on_foot(10.0, 1.8, 0.0)) && free(&driver, true, &on_foot(10.0, 2.4, 0.0))
        );
        assert!(free(&driver, true, &on_foot(7.0, 0.0, 0.0)), "behind it");
        assert!(free(&parked, false, &on_foot(12.5, 0.0, 0.0)), "a parked car stays");
        let walker = on_foot(0.0, 0.0, 0.0);
        assert!(beside(&walker, false).is_free(&on_foot(0.0, 0.7, 0.0), 2.0), "in company");
        assert!(!beside(&walker, false).is_free(&on_foot(1.0, 0.0, 3.1), 2.0), "towards each other");
    }

    #[test]
    fn drivers_pass_each_other_with_a_gap() {
        let driver = car(10.0, 0.0, 0.0, CellKind::Lane);
        for heading_rad in [0.0, std::f64::consts::PI] {
            let at = |y_m| car(10.0, y_m, heading_rad, CellKind::Lane);
            assert!(
                !beside(&driver, true).is_free(&at(2.3), 0.0) && beside(&driver, true).is_free(&at(2.5), 0.0)
            );
        }
        let parked = car(10.0, 2.3, 0.0, CellKind::Kerb);
        assert!(
            !beside(&parked, false).is_free(&driver, 0.0) && !beside(&driver, true).is_free(&parked, 0.0)
        );
    }

    #[test]
    fn those_who_follow_keep_the_gap_and_others_the_margin() {
        let leader = car(10.0, 0.0, 0.0, CellKind::Lane);
        let at = |x_m| car(x_m, 0.0, 0.0, CellKind::Lane);
        // Bumper to bumper there are 10 - x - 4 metres.
        assert!(beside(&leader, true).is_free(&at(3.9), 2.0));
        assert!(!beside(&leader, true).is_free(&at(4.1), 2.0));
        assert!(beside(&leader, false).is_free(&at(5.8), 2.0), "parked cars need no gap along the lane");
        assert!(!beside(&leader, false).is_free(&at(5.95), 2.0));
        let across = car(10.0, 0.0, 1.0, CellKind::Lane);
        assert!(beside(&across, true).is_free(&at(4.5), 5.0), "a crossing vehicle has no follower");
        assert!(
            !beside(&across, true).is_free(&at(5.2), 0.0),
            "it is crossed with more room than it is passed"
        );
        assert!(beside(&leader, true).is_free(&car(10.0, 2.45, 0.0, CellKind::Lane), 2.0));
        assert!(!beside(&leader, true).is_free(&car(10.0, 2.35, 0.0, CellKind::Lane), 2.0));
    }

    #[test]
    fn drivers_stay_behind_red_lights_and_parked_cars_off_the_lanes() {
        let points: Vec<Vec2> = (0..=20).map(|i| Vec2::new(5.0 * f64::from(i), 0.0)).collect();
        let lane = Lane::street("a", points);
        let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
        let mut scene = Scene::bare("light", map, Vec::new());
        scene.signals = vec![Signal {
            lane: "a".into(),
            stop: Some(Vec2::new(50.0, 0.0)),
            stop_z_m: None,
            runs: vec![(0, SignalState::Stop)],
        }];
        let graph = LaneGraph::new(&scene.map);
        let cells = Cells::new(&scene, &graph, 0, &Region::Everywhere);
        // The front bumper is two metres ahead of the centre.
        assert!(is_sensible(&car(47.6, 0.0, 0.0, CellKind::Lane), &cells));
        assert!(!is_sensible(&car(47.8, 0.0, 0.0, CellKind::Lane), &cells));
        assert!(is_sensible(&car(52.0, 0.0, 0.0, CellKind::Lane), &cells), "past the line");
        assert!(is_sensible(&car(30.0, 3.0, 0.0, CellKind::Kerb), &cells));
        assert!(!is_sensible(&car(30.0, 1.0, 0.0, CellKind::Kerb), &cells));
        assert!(!is_sensible(&car(30.0, 3.0, 1.5, CellKind::Driveway), &cells), "its nose is on the lane");
        assert!(!is_sensible(&car(30.0, 2.2, 0.4, CellKind::Kerb), &cells), "its corner is on the lane");
        assert!(is_sensible(&on_foot(30.0, 3.0, 0.0), &cells));
        assert!(!is_sensible(&on_foot(30.0, 3.0, -1.5), &cells), "it heads for the lane");
        assert!(is_sensible(&on_foot(30.0, 3.0, 1.5), &cells), "it heads away");
    }
}
