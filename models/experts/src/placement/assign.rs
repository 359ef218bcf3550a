//! The cell and the lane that a road user of a scene is in.

use super::cells::{CellKind, Cells, MapCell};
use crate::tuning::placing::assign::{
    BESIDE_DRIVING_M, BESIDE_RIDING_M, CROSSWALK_M, LANE_REACH_M, PARKED_EXTENT_M, PARKED_M, PAVEMENT_M,
    RADIAN_M,
};
use scene::routes::{LaneGraph, LaneHit};
use scene::{Agent, AgentType, State, Vec2, wrap_angle};

/// The lane that an agent drives on: it is near the lane's middle and along it.
pub(super) fn driven_lane(graph: &LaneGraph, agent_type: AgentType, state: &State) -> Option<LaneHit> {
    let turn = |hit: &LaneHit| wrap_angle(state.heading_rad - hit.heading_rad).abs();
    let on = |hit: &LaneHit| {
        let half_m = 0.5 * graph.lanes()[hit.lane].width_m
            + if agent_type == AgentType::Cyclist { BESIDE_RIDING_M } else { BESIDE_DRIVING_M };
        hit.distance_m < half_m && turn(hit) < 1.0
    };
    let hits = graph.nearest_for(state.position(), LANE_REACH_M, agent_type).into_iter().filter(on);
    hits.min_by(|a, b| {
        let cost = |h: &LaneHit| h.distance_m + RADIAN_M * turn(h);
        cost(a).total_cmp(&cost(b)).then(a.lane.cmp(&b.lane))
    })
}

/// The cell of an agent, and its lane if it drives.
pub(super) fn assign(
    cells: &Cells<'_>,
    agent: &Agent,
    state: &State,
) -> (Option<usize>, Option<(usize, f64)>) {
    let agent_type = agent.agent_type;
    if matches!(agent_type, AgentType::Vehicle | AgentType::Cyclist)
        && let Some(hit) = driven_lane(cells.graph, agent_type, state)
    {
        return (cells.lane_cell(hit.lane, hit.s_m), Some((hit.lane, hit.s_m)));
    }
    let position = state.position();
    let cell = match agent_type {
        AgentType::Vehicle if agent.track.extent_m() < PARKED_EXTENT_M => {
            cells.driveway_at(position).or_else(|| kerb_at(cells, position))
        }
        AgentType::Pedestrian | AgentType::Cyclist => walk_at(cells, position),
        _ => None,
    };
    (cell, None)
}

/// The kerb cell nearest to a point beside its lane.
fn kerb_at(cells: &Cells<'_>, position: Vec2) -> Option<usize> {
    nearest(
        cells,
        position,
        |cell| cell.kind == CellKind::Kerb,
        |cell, foot| {
            let away = cell.side * foot.lateral_m;
            let kerb_m = 0.5 * cells.graph.lanes()[cell.line].width_m + cell.free_m;
            (away > 0.0 && away < PARKED_M && away < kerb_m + 0.5).then_some(away)
        },
    )
}

/// The crosswalk cell that holds a point, else the pavement cell nearest to it.
fn walk_at(cells: &Cells<'_>, position: Vec2) -> Option<usize> {
    let on_crosswalk = nearest(
        cells,
        position,
        |s| s.kind == CellKind::Crosswalk,
        |cell, foot| {
            let half_m = 0.5 * cells.graph.lanes()[cell.line].width_m;
            (foot.distance_m < half_m + CROSSWALK_M).then_some(foot.distance_m)
        },
    );
    on_crosswalk.or_else(|| {
        nearest(
            cells,
            position,
            |s| s.kind == CellKind::Pavement,
            |cell, foot| {
                let outside_m = if cell.on_lane { foot.distance_m } else { cell.side * foot.lateral_m };
                (outside_m > -2.0 && foot.distance_m < PAVEMENT_M).then_some(foot.distance_m)
            },
        )
    })
}

/// The cheapest of the wanted cells near a point.
fn nearest(
    cells: &Cells<'_>,
    position: Vec2,
    wanted: impl Fn(&MapCell) -> bool,
    cost: impl Fn(&MapCell, &scene::routes::Foot) -> Option<f64>,
) -> Option<usize> {
    let near = |cell: &MapCell| (cell.center - position).norm() < PARKED_M + cell.extent();
    let candidates = cells.all.iter().enumerate().filter(|(_, s)| wanted(s) && near(s));
    let costs = candidates.filter_map(|(at, cell)| {
        let foot = cells.path(cell)?.project_between(position, cell.from_m, cell.to_m);
        Some((cost(cell, &foot)?, at))
    });
    costs.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, at)| at)
}
