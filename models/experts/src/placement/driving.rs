//! Speed limits at a place, and the leader of a driver there.

use super::model::{SPEED_CLASSES, SPEED_STEP};
use super::stop_lines::straightest;
use crate::tuning::placing::driving::{
    BEND_LOOK_M, BEND_MPS2, BEND_OVER_M, BEYOND_LOOK_M, BOX_REACH_M, CYCLIST_MPS, LEADER_LOOK_M, RIDING_MPS,
    WALKING_MPS,
};
use scene::STANDING_MPS;
use scene::geometry::obb::OrientedBox;
use scene::routes::speed::{Leader, Obstacle, leader};
use scene::routes::{LaneGraph, Polyline};
use scene::{AgentType, Vec2};

/// Range of the start speeds of moving drivers, m/s.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the names say it")]
pub struct SpeedRange {
    pub min_mps: f64,
    pub max_mps: f64,
}

/// Speed that the limit and bends allow at a place of a lane, m/s.
pub(super) fn allowed_mps(graph: &LaneGraph, lane: usize, s_m: f64, agent_type: AgentType) -> f64 {
    let most = if agent_type == AgentType::Cyclist { CYCLIST_MPS } else { f64::INFINITY };
    let limit_mps = graph.lanes()[lane].speed_limit_mps;
    limit_mps.min(bend_mps(graph, lane, s_m)).min(most).max(1.0)
}

/// Number of places ahead at which the bend is looked up.
const BEND_LOOKS: i32 = 5;

/// Speed that the bends of a lane allow at a place of it, m/s.
pub(super) fn bend_mps(graph: &LaneGraph, lane: usize, s_m: f64) -> f64 {
    let here = &graph.lanes()[lane];
    let mut allowed = f64::INFINITY;
    for i in 0..=BEND_LOOKS {
        let ahead_m = BEND_LOOK_M * f64::from(i) / f64::from(BEND_LOOKS);
        if s_m + ahead_m > here.path.length_m() {
            break;
        }
        let bend = here.path.curvature_at(s_m + ahead_m, BEND_OVER_M).abs().max(1e-6);
        allowed = allowed.min((BEND_MPS2 / bend + 2.0 * BEND_MPS2 * ahead_m).sqrt());
    }
    allowed
}

/// Usual speed off the lanes, m/s.
pub(super) fn usual_mps(agent_type: AgentType) -> f64 {
    if agent_type == AgentType::Cyclist { RIDING_MPS } else { WALKING_MPS }
}

/// The nearest road user in front of a place on a lane; at a fork, straight on.
pub(super) fn leader_ahead(
    graph: &LaneGraph,
    lane: usize,
    s_m: f64,
    outline: &OrientedBox,
    others: &[Obstacle],
) -> Option<Leader> {
    let near = |o: &Obstacle| (o.outline.center() - outline.center()).norm() < LEADER_LOOK_M + BOX_REACH_M;
    let (index, close): (Vec<usize>, Vec<Obstacle>) =
        others.iter().enumerate().filter(|(_, o)| near(o)).map(|(i, o)| (i, *o)).unzip();
    if close.is_empty() {
        return None;
    }
    let mut points: Vec<Vec2> = vec![graph.lanes()[lane].path.position_at(s_m)];
    let (mut at, mut from_m, mut left_m) = (lane, s_m, LEADER_LOOK_M + BEYOND_LOOK_M);
    for _ in 0..12 {
        let path = &graph.lanes()[at].path;
        let until_m = (from_m + left_m).min(path.length_m());
        points.extend(path.slice(from_m, until_m).points().iter().skip(1));
        left_m -= until_m - from_m;
        let Some(next) = straightest(graph, at).filter(|_| left_m > 1.0) else { break };
        (at, from_m) = (next, 0.0);
    }
    let found = leader(&Polyline::new(points), 2.0 * outline.half_length_m(), &close)?;
    Some(Leader { index: index[found.index], ..found })
}

/// Class of a speed, in units of the allowed speed.
pub fn speed_class(speed_mps: f64, unit_mps: f64) -> usize {
    if speed_mps < STANDING_MPS {
        return 0;
    }
    (1 + (speed_mps / unit_mps.max(0.1) / SPEED_STEP) as usize).min(SPEED_CLASSES - 1)
}
