//! Where road users can be: short cells of lanes, kerbs, crosswalks and pavements. A few features of its
//! surroundings decide how often a cell is occupied.

mod build;

use super::context::SpeedContext;
use super::region::{Region, in_ring};
use super::stop_lines::{LineAhead, ShownLights};
use crate::tuning::placing::cells::{DRIVEWAY_REACH_M, LEADER_M, LEADER_REACH_M};
use scene::routes::Polyline;
use scene::routes::graph::{GraphLane, LaneGraph};
use scene::{AgentType, Scene, Vec2};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// Length of a cell, metres, on maps that are not huge.
const CELL_M: f64 = 5.0;
/// Most cells of a map; larger maps get longer cells.
const MAX_CELLS: f64 = 40_000.0;
/// Most features of a cell.
pub(super) const FEATURES: usize = 6;
/// Index of the distance to the leader among a lane cell's features.
pub(super) const LEADER_GAP: usize = 5;

/// Kind of cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CellKind {
    /// On a lane, driving or waiting.
    Lane,
    /// Parked between a lane and the kerb, or beside a lane without a kerb.
    Kerb,
    /// On a crosswalk.
    Crosswalk,
    /// On the pavement along a road edge, or on a sidewalk lane.
    Pavement,
    /// Parked in a driveway.
    Driveway,
}

/// Kinds of cells that a type may occupy.
pub fn cell_kinds(agent_type: AgentType) -> &'static [CellKind] {
    match agent_type {
        AgentType::Vehicle => &[CellKind::Lane, CellKind::Kerb, CellKind::Driveway],
        AgentType::Pedestrian => &[CellKind::Crosswalk, CellKind::Pavement],
        AgentType::Cyclist => &[CellKind::Lane, CellKind::Crosswalk, CellKind::Pavement],
        AgentType::Other => &[],
    }
}

impl CellKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::Lane, Self::Kerb, Self::Crosswalk, Self::Pavement, Self::Driveway];

    /// The situation by which speeds off the lanes are learned; `None` for drivers and parked vehicles.
    pub(super) fn speed_context(self) -> Option<SpeedContext> {
        match self {
            Self::Crosswalk => Some(SpeedContext::Crosswalk),
            Self::Pavement => Some(SpeedContext::Pavement),
            Self::Lane | Self::Kerb | Self::Driveway => None,
        }
    }

    /// Number of classes of each feature.
    pub fn feature_classes(self) -> &'static [usize] {
        match self {
            Self::Lane => const { &[8, 7, LineAhead::CLASSES, 5, 9, 2 * (LEADER_M.len() + 1)] },
            Self::Kerb => &[7, 2, 7, 4, 8],
            Self::Crosswalk => &[2],
            Self::Pavement => &[4, 5, 7, 2],
            Self::Driveway => &[],
        }
    }
}

/// One cell.
#[derive(Clone, Debug)]
pub(super) struct MapCell {
    pub(super) kind: CellKind,
    /// Index of the graph lane; of the road edge for a pavement without a lane; of the driveway.
    pub(super) line: usize,
    /// The pavement is a sidewalk lane.
    pub(super) on_lane: bool,
    pub(super) from_m: f64,
    pub(super) to_m: f64,
    pub(super) center: Vec2,
    /// For kerbs: +1 left of the lane, -1 right. For pavements along an edge: the side away from the road.
    pub(super) side: f64,
    /// For kerbs: distance from the lane's border to the kerb, metres; infinite without a kerb.
    pub(super) free_m: f64,
    pub(super) features: [u8; FEATURES],
    pub(super) ahead: LineAhead,
}

impl MapCell {
    /// Factor of its rate: metres, or one for a driveway.
    pub(super) fn extent(&self) -> f64 {
        if self.kind == CellKind::Driveway { 1.0 } else { self.to_m - self.from_m }
    }
}

/// All cells of a scene at one moment.
pub(super) struct Cells<'a> {
    pub(super) scene: &'a Scene,
    pub(super) graph: &'a LaneGraph,
    pub(super) lights: ShownLights,
    /// Road edges as lines.
    pub(super) edges: Vec<Polyline>,
    pub(super) all: Vec<MapCell>,
    /// The cells of kind lane, by graph lane. The first of them need not be the lane's first cell.
    by_lane: HashMap<usize, LaneCells>,
}

struct LaneCells {
    /// Indices into the scene's cells.
    held: Range<usize>,
    /// Number along the lane of the first cell in `held`.
    first: usize,
    /// Number of cells of the whole lane.
    count: usize,
}

fn class(value: f64, bounds: &[f64]) -> u8 {
    bounds.iter().filter(|b| value >= **b).count() as u8
}

impl<'a> Cells<'a> {
    /// Cells whose centre may lie in the region, with their features at `step`.
    pub(super) fn new(scene: &'a Scene, graph: &'a LaneGraph, step: usize, region: &Region) -> Self {
        let map = &scene.map;
        let edges: Vec<Polyline> =
            map.road_edges.iter().map(|e| Polyline::new(e.points.xy.iter().copied())).collect();
        let lanes_m: f64 = graph.lanes().iter().map(|l| l.path.length_m()).sum();
        let edges_m: f64 = edges.iter().map(Polyline::length_m).sum();
        let cell_m = CELL_M.max((2.0 * lanes_m + edges_m) / MAX_CELLS);
        let lights = ShownLights::new(scene, graph, step);
        let mut cells = Self { scene, graph, lights, edges, all: Vec::new(), by_lane: HashMap::new() };
        cells.lanes(cell_m, region);
        cells.kerbs(region);
        cells.crosswalks(cell_m, region);
        cells.pavements(cell_m, region);
        cells.driveways(region);
        cells
    }

    /// Whether a type may occupy the cell.
    pub(super) fn may_hold(&self, cell: &MapCell, agent_type: AgentType) -> bool {
        let lane_fits = || self.graph.lanes().get(cell.line).is_some_and(|l| l.carries(agent_type));
        cell_kinds(agent_type).contains(&cell.kind) && (cell.kind != CellKind::Lane || lane_fits())
    }

    /// The line of a cell; `None` for driveways.
    pub(super) fn path(&self, cell: &MapCell) -> Option<&Polyline> {
        match cell.kind {
            CellKind::Driveway => None,
            CellKind::Pavement if !cell.on_lane => self.edges.get(cell.line),
            _ => self.graph.lanes().get(cell.line).map(|l| &l.path),
        }
    }

    /// The cell at arc length `s_m` of a lane.
    pub(super) fn lane_cell(&self, lane: usize, s_m: f64) -> Option<usize> {
        let of_lane = self.by_lane.get(&lane)?;
        let length_m = self.graph.lanes()[lane].path.length_m();
        let number = ((s_m / length_m * of_lane.count as f64) as usize).min(of_lane.count - 1);
        let at = of_lane.held.start + number.checked_sub(of_lane.first)?;
        of_lane.held.contains(&at).then_some(at)
    }

    /// Kilometres of lane for motor vehicles in the region, junctions left out.
    pub(super) fn lane_km(&self, region: &Region) -> f64 {
        // Junction lanes and lanes of other road users do not count.
        let counts = |lane: &GraphLane| lane.carries(AgentType::Vehicle) && !lane.interpolating;
        let counted = self.all.iter().filter(|s| {
            s.kind == CellKind::Lane
                && self.graph.lanes().get(s.line).is_some_and(counts)
                && region.contains(s.center)
        });
        counted.map(MapCell::extent).sum::<f64>() / 1000.0
    }

    /// Calls `found` with the cells behind the place at `s_m` of a lane and their distance to it, metres. It
    /// follows all lanes that lead there, up to [`LEADER_REACH_M`].
    pub(super) fn behind(&self, lane: usize, s_m: f64, mut found: impl FnMut(usize, f64)) {
        let mut todo = vec![(lane, s_m, 0.0)];
        let mut seen = HashSet::new();
        while let Some((lane, s_m, travelled_m)) = todo.pop() {
            if !seen.insert(lane) || seen.len() > 32 {
                continue;
            }
            if let Some(of_lane) = self.by_lane.get(&lane) {
                for at in of_lane.held.clone().rev() {
                    let cell = &self.all[at];
                    let gap_m = travelled_m + s_m - 0.5 * (cell.from_m + cell.to_m);
                    // The agent's own cell is not behind it.
                    if cell.to_m <= s_m && (0.0..LEADER_REACH_M).contains(&gap_m) {
                        found(at, gap_m);
                    }
                }
            }
            if travelled_m + s_m < LEADER_REACH_M {
                for before in &self.graph.lanes()[lane].predecessors {
                    todo.push((*before, self.graph.lanes()[*before].path.length_m(), travelled_m + s_m));
                }
            }
        }
    }

    /// The driveway that holds a point.
    pub(super) fn driveway_at(&self, point: Vec2) -> Option<usize> {
        let of_driveways =
            self.all.iter().enumerate().rev().take_while(|(_, s)| s.kind == CellKind::Driveway);
        let mut holding = of_driveways
            .filter(|(_, s)| (s.center - point).norm() < DRIVEWAY_REACH_M)
            .filter(|(_, s)| in_ring(&self.scene.map.driveways[s.line].polygon.xy, point));
        holding.next().map(|(at, _)| at)
    }
}

/// Class of a cell's distance to the leader. With `queues` the classes are doubled, to separate queues from
/// flowing traffic.
pub(super) fn leader_class(gap_m: f64, queues: bool) -> u8 {
    let gap = if gap_m.is_finite() { class(gap_m, &LEADER_M) } else { LEADER_M.len() as u8 };
    gap + (LEADER_M.len() as u8 + 1) * u8::from(queues)
}
