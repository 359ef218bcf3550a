//! Input of training: observations of recorded scenes, and the form of the weights that are fitted to them.
//!
//! [`observe`] reads a recorded scene with the same cells, features and situations as placement, so the two
//! cannot diverge. The fit itself belongs to the trainer, which writes a
//! [`PlacementModel`](super::PlacementModel) in the classes given here.

use super::assign::assign;
use super::cells::{Cells, FEATURES, LEADER_GAP, MapCell, leader_class};
use super::driving::{allowed_mps, leader_ahead, usual_mps};
use super::pose::{measure, pose_context};
use super::region::Region;
use scene::geometry::obb::OrientedBox;
use scene::routes::LaneGraph;
use scene::routes::speed::Obstacle;
use scene::{Agent, AgentType, Scene, State, Vec2};
use std::collections::BTreeMap;

pub use super::cells::{CellKind, cell_kinds};
pub use super::context::{LeaderGap, LeaderPace, PoseContext, RoadAhead, SpeedContext};
pub use super::driving::speed_class;
pub use super::model::{FORMAT, Histogram, PlacementModel, Rate, SPEED_CLASSES, TypeModel, VERSION};
pub use super::pose::{heading_classes, lateral_classes};

/// Half the side of the square around the ego in which all agents are recorded, metres. Synthetic windows
/// keep agents within 60 m.
pub const SEEN_M: f64 = 60.0;

/// Groups of equal cells (type, kind and features), with their total metres or driveways and their road
/// users.
pub type CellCounts = BTreeMap<(AgentType, CellKind, [u8; FEATURES]), (f64, f64)>;

/// Everything that one scene teaches at one step.
#[derive(Clone, Debug, Default)]
pub struct Observation {
    /// Counts by group of cells.
    pub cells: CellCounts,
    /// Offsets across the line: type, context, value.
    pub lateral: Vec<(AgentType, PoseContext, f64)>,
    /// Headings against the line: type, context, value.
    pub heading: Vec<(AgentType, PoseContext, f64)>,
    /// Boxes: type, kind, length and width.
    pub sizes: Vec<(AgentType, CellKind, f64, f64)>,
    /// Speed classes: type, context, class.
    pub speeds: Vec<(AgentType, SpeedContext, usize)>,
    /// Road users in no cell, by type: nothing is learned from them.
    pub nowhere: BTreeMap<AgentType, usize>,
}

/// A road user at the step.
struct SeenAgent<'a> {
    agent: &'a Agent,
    state: State,
    cell: Option<usize>,
    /// Lane and arc length of an agent that drives.
    lane: Option<(usize, f64)>,
    in_square: bool,
    ego: bool,
}

/// Observes a scene at one step. Only cells and road users within [`SEEN_M`] of the ego count.
///
/// The counts leave out the ego and its cell: windows are cut around road users, so one is always there. The
/// others are distributed as if it were not (Slivnyak's theorem).
pub fn observe(scene: &Scene, graph: &LaneGraph, step: usize) -> Observation {
    let ego = scene.agents.iter().find(|a| a.role.as_deref() == Some("ego"));
    let center = ego.and_then(|a| a.state_at(scene.time.now_step)).map_or(Vec2::zeros(), |s| s.position());
    let square = |p: Vec2| (p - center).amax() < SEEN_M;
    let region = Region::Circle { center, radius_m: 1.5 * SEEN_M };
    let mut cells = Cells::new(scene, graph, step, &region);
    let mut seen: Vec<SeenAgent<'_>> = Vec::new();
    for agent in &scene.agents {
        let Some(state) = agent.state_at(step) else { continue };
        let (cell, lane) = assign(&cells, agent, &state);
        let in_square = square(state.position());
        seen.push(SeenAgent {
            agent,
            state,
            cell,
            lane,
            in_square,
            ego: agent.role.as_deref() == Some("ego"),
        });
    }
    set_leader_gaps(&mut cells, &seen);
    let mut out = Observation::default();
    count_cells(&cells, &seen, square, &mut out);
    let obstacles: Vec<Obstacle> = seen
        .iter()
        .map(|s| Obstacle {
            outline: OrientedBox::of_state(&s.state, &s.agent.size),
            speed_mps: s.state.speed_mps(),
        })
        .collect();
    for (i, one) in seen.iter().enumerate().filter(|(_, s)| s.in_square) {
        let Some(at) = one.cell else {
            *out.nowhere.entry(one.agent.agent_type).or_default() += 1;
            continue;
        };
        learn_from(&cells, one, i, &cells.all[at], &obstacles, &mut out);
    }
    out
}

/// Sets the leader feature of every lane cell: its distance to the nearest road user ahead.
fn set_leader_gaps(cells: &mut Cells<'_>, seen: &[SeenAgent<'_>]) {
    let mut gaps = vec![f64::INFINITY; cells.all.len()];
    for (lane, s_m) in seen.iter().filter_map(|s| s.lane) {
        cells.behind(lane, s_m, |at, gap_m| gaps[at] = gaps[at].min(gap_m));
    }
    for (cell, gap_m) in cells.all.iter_mut().zip(gaps).filter(|(s, _)| s.kind == CellKind::Lane) {
        cell.features[LEADER_GAP] = leader_class(gap_m, cell.ahead.queues());
    }
}

fn count_cells(
    cells: &Cells<'_>,
    seen: &[SeenAgent<'_>],
    square: impl Fn(Vec2) -> bool,
    out: &mut Observation,
) {
    let mut counts: BTreeMap<(AgentType, usize), f64> = BTreeMap::new();
    let own = seen.iter().find(|s| s.ego).and_then(|s| s.cell);
    for one in seen.iter().filter(|s| s.in_square && !s.ego) {
        if let Some(at) = one.cell {
            *counts.entry((one.agent.agent_type, at)).or_default() += 1.0;
        }
    }
    for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
        for (at, cell) in cells.all.iter().enumerate() {
            if Some(at) == own || !square(cell.center) || !cells.may_hold(cell, agent_type) {
                continue;
            }
            let alike = out.cells.entry((agent_type, cell.kind, cell.features)).or_default();
            alike.0 += cell.extent();
            alike.1 += counts.get(&(agent_type, at)).copied().unwrap_or(0.0);
        }
    }
}

fn learn_from(
    cells: &Cells<'_>,
    one: &SeenAgent<'_>,
    own: usize,
    cell: &MapCell,
    obstacles: &[Obstacle],
    out: &mut Observation,
) {
    let (agent_type, size) = (one.agent.agent_type, one.agent.size);
    let context = pose_context(cells, cell);
    let pose = measure(cells, cell, agent_type, size, one.state.position(), one.state.heading_rad);
    if let Some((lateral, heading_rad)) = pose {
        out.heading.push((agent_type, context, heading_rad));
        out.lateral.extend(lateral.map(|m| (agent_type, context, m)));
    }
    out.sizes.push((agent_type, cell.kind, size.length_m, size.width_m));
    let speed_mps = one.state.speed_mps();
    if let Some((lane, s_m)) = one.lane {
        let ahead = cells.lights.ahead(cells.graph, lane, s_m);
        let others: Vec<Obstacle> =
            obstacles.iter().enumerate().filter(|(i, _)| *i != own).map(|(_, o)| *o).collect();
        let leader = leader_ahead(cells.graph, lane, s_m, &obstacles[own].outline, &others);
        let unit_mps = allowed_mps(cells.graph, lane, s_m, agent_type);
        let context = SpeedContext::driver(ahead.road_ahead(), leader.map(|l| (l.gap_m, l.speed_mps)));
        out.speeds.push((agent_type, context, speed_class(speed_mps, unit_mps)));
    } else if let Some(context) = cell.kind.speed_context() {
        out.speeds.push((agent_type, context, speed_class(speed_mps, usual_mps(agent_type))));
    }
}
