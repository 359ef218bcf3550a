//! A map that is being drawn.

use crate::curve::{self, Pose};
use crate::parameters::{Connection, Turn};
use crate::turns::{Movement, mirrored};
use scene::map::{Area, Boundary, Lane, LaneMap, LaneType, Neighbor, StopSign, TypedLine};
use scene::{Signal, Vec2};
use schemars::JsonSchema;
use serde::Serialize;

/// Position of an arm, for editing handles.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ArmPlace {
    /// Such as `North`.
    pub name: String,
    /// Stop position of inbound traffic, in the middle of the arm, metres.
    pub mouth_m: [f64; 2],
    /// Point where the arm leaves the map, metres.
    pub end_m: [f64; 2],
    /// Distances from the middle to the kerb of the inbound lanes and to that of the outbound lanes, metres.
    pub kerbs_m: [f64; 2],
    /// Turns of its inbound lanes, from the middle of the road to the kerb, without single connections.
    pub turns: Vec<Vec<Turn>>,
    /// End of each inbound lane, metres.
    pub ins_m: Vec<[f64; 2]>,
    /// Start of each outbound lane, metres.
    pub outs_m: Vec<[f64; 2]>,
}

/// A drawn path through a junction.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JunctionPath {
    /// From where to where.
    #[serde(flatten)]
    pub connection: Connection,
    /// Id of its lane in the map.
    pub lane: String,
    /// The direction, as seen from the entry.
    pub turn: Turn,
    /// Whether it was added to those of the turn lanes.
    pub added: bool,
}

/// A bend of a kerb at a corner.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CornerPlace {
    /// The middle of the bend, metres.
    pub at_m: [f64; 2],
    /// Its radius, metres: less than requested where arms are too close.
    pub radius_m: f64,
    /// The arms that it joins.
    pub arms: [usize; 2],
}

/// Properties of a lane that the map does not hold.
#[derive(Clone, Debug, Default)]
pub struct LaneExtra {
    /// Whether the road continues beyond the map at its beginning and its end.
    pub open: [bool; 2],
}

/// Largest vehicle that must be able to follow every bend.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Vehicle {
    #[default]
    Bus,
    Car,
}

#[derive(Clone, Debug, Default)]
pub struct MapDraft {
    pub map: LaneMap,
    pub signals: Vec<Signal>,
    /// By lane.
    pub about: Vec<LaneExtra>,
    pub movements: Vec<Movement>,
    pub turns: Vehicle,
    pub arms: Vec<ArmPlace>,
    pub corners: Vec<CornerPlace>,
    /// Raised ground within the carriageway.
    pub islands: Vec<Vec<Vec2>>,
}

pub fn place(p: Vec2) -> [f64; 2] {
    [p.x, p.y]
}

impl MapDraft {
    /// Adds a lane; returns its index.
    pub fn lane(
        &mut self,
        id: String,
        lane_type: LaneType,
        line: Vec<Vec2>,
        width_m: f64,
        limit_kmh: f64,
    ) -> usize {
        let lane = Lane {
            lane_type,
            width_m: Some(width_m),
            speed_limit_mps: (limit_kmh > 0.0).then_some(limit_kmh / 3.6),
            ..Lane::street(id, line)
        };
        self.map.lanes.push(lane);
        self.about.push(LaneExtra::default());
        self.map.lanes.len() - 1
    }

    pub fn points(&self, lane: usize) -> &[Vec2] {
        &self.map.lanes[lane].points.xy
    }

    /// Start pose of a lane.
    pub fn start(&self, lane: usize) -> Pose {
        let line = self.points(lane);
        let way = line[1] - line[0];
        Pose { at: line[0], heading_rad: way.y.atan2(way.x) }
    }

    /// End pose of a lane.
    pub fn end(&self, lane: usize) -> Pose {
        let line = self.points(lane);
        let last = line.len() - 1;
        let way = line[last] - line[last - 1];
        Pose { at: line[last], heading_rad: way.y.atan2(way.x) }
    }

    pub fn link(&mut self, from: usize, to: usize) {
        let (a, b) = (self.map.lanes[from].id.clone(), self.map.lanes[to].id.clone());
        if !self.map.lanes[from].successors.contains(&b) {
            self.map.lanes[from].successors.push(b);
            self.map.lanes[to].predecessors.push(a);
        }
    }

    /// Adds a path through a junction between two lanes; returns its index.
    pub fn through(&mut self, from: usize, to: usize, line: Vec<Vec2>, lane_type: LaneType) -> usize {
        let (a, b) = (&self.map.lanes[from], &self.map.lanes[to]);
        let id = format!("{}-{}", a.id, b.id);
        let width_m = a.width_or_assumed_m().min(b.width_or_assumed_m());
        let limit_mps = a.speed_limit_mps.unwrap_or(13.9).min(b.speed_limit_mps.unwrap_or(13.9));
        // Comfortable lateral acceleration in a bend: 2.6 m/s2.
        let bend = curve::curvature(&line).max(1e-4);
        let limit_mps = limit_mps.min((2.6 / bend).sqrt()).max(2.0);
        let lane = self.lane(id, lane_type, line, width_m, limit_mps * 3.6);
        self.map.lanes[lane].interpolating = true;
        self.link(from, lane);
        self.link(lane, to);
        lane
    }

    /// Links two lanes of one direction that lie side by side over their whole length and have as many
    /// points.
    pub fn beside(&mut self, left: usize, right: usize) {
        let range = |lane: usize| (0, self.map.lanes[lane].points.xy.len() - 1);
        let (l, r) = (range(left), range(right));
        let neighbor = |lane: &Lane, own: (usize, usize), other: (usize, usize)| Neighbor {
            lane: lane.id.clone(),
            own_range: own,
            other_range: other,
            boundaries: Vec::new(),
        };
        let of_left = neighbor(&self.map.lanes[right], l, r);
        let of_right = neighbor(&self.map.lanes[left], r, l);
        self.map.lanes[left].right_neighbors.push(of_left);
        self.map.lanes[right].left_neighbors.push(of_right);
    }

    /// Paths for motor vehicles, in the order of the parameters.
    pub fn ways(&self) -> Vec<JunctionPath> {
        let way = |m: &Movement| {
            let [lane_in, lane_out] = m.lanes?;
            let lane = self.map.lanes[m.lane].id.clone();
            let connection = Connection { from: [m.from, lane_in], to: [m.to, lane_out] };
            Some(JunctionPath { connection, lane, turn: m.turn, added: m.added })
        };
        self.movements.iter().filter_map(way).collect()
    }

    /// Adds a painted line; returns its id.
    pub fn line(&mut self, line_type: &str, points: Vec<Vec2>) -> String {
        let id = format!("line{}", self.map.road_lines.len() + 1);
        self.map.road_lines.push(TypedLine {
            id: id.clone(),
            line_type: line_type.into(),
            points: points.into(),
        });
        id
    }

    /// Adds a kerb; returns its id.
    pub fn edge(&mut self, line_type: &str, points: Vec<Vec2>) -> String {
        let id = format!("edge{}", self.map.road_edges.len() + 1);
        self.map.road_edges.push(TypedLine {
            id: id.clone(),
            line_type: line_type.into(),
            points: points.into(),
        });
        id
    }

    /// Assigns a line or kerb to the left (or right) side of a whole lane.
    pub fn bound(&mut self, lane: usize, left: bool, line: &str) {
        let lane = &mut self.map.lanes[lane];
        let to = lane.points.xy.len() - 1;
        let side = if left { &mut lane.left_boundary } else { &mut lane.right_boundary };
        side.push(Boundary { line: line.to_owned(), from: 0, to, kind: None });
    }

    /// Adds a raised island: a closed kerb around ground that is not drivable.
    pub fn island(&mut self, ring: Vec<Vec2>) -> String {
        let mut kerb = ring.clone();
        kerb.extend(ring.first().copied());
        self.islands.push(ring);
        self.edge("median", kerb)
    }

    pub fn crosswalk(&mut self, ring: [Vec2; 4]) -> String {
        let id = format!("crosswalk{}", self.map.crosswalks.len() + 1);
        let polygon = ring.to_vec().into();
        self.map.crosswalks.push(Area { id: id.clone(), polygon, holes: Vec::new() });
        id
    }

    pub fn bump(&mut self, ring: [Vec2; 4]) {
        let id = format!("bump{}", self.map.speed_bumps.len() + 1);
        self.map.speed_bumps.push(Area { id, polygon: ring.to_vec().into(), holes: Vec::new() });
    }

    /// Adds drivable ground with `holes`.
    pub fn ground(&mut self, ring: Vec<Vec2>, holes: Vec<Vec<Vec2>>) {
        let id = format!("ground{}", self.map.drivable.len() + 1);
        let holes = holes.into_iter().map(Into::into).collect();
        self.map.drivable.push(Area { id, polygon: ring.into(), holes });
    }

    pub fn stop_sign(&mut self, position: Vec2, lanes: Vec<String>) {
        let id = format!("stop{}", self.map.stop_signs.len() + 1);
        self.map.stop_signs.push(StopSign { id, position, z_m: None, lanes });
    }

    pub fn sidewalk(&mut self, line: Vec<Vec2>, width_m: f64, corner: bool) -> usize {
        let id = format!("walk{}", self.map.lanes.len() + 1);
        let lane = self.lane(id, LaneType::Sidewalk, curve::tidy(line), width_m, 0.0);
        self.map.lanes[lane].interpolating = corner;
        lane
    }

    /// The map with left and right exchanged.
    pub fn mirrored(mut self) -> Self {
        self.map = self.map.mirrored();
        for signal in &mut self.signals {
            signal.stop = signal.stop.map(|p| Vec2::new(p.x, -p.y));
        }
        let flip = |p: &mut [f64; 2]| p[1] = -p[1];
        for arm in &mut self.arms {
            flip(&mut arm.mouth_m);
            flip(&mut arm.end_m);
            arm.ins_m.iter_mut().chain(&mut arm.outs_m).for_each(flip);
        }
        self.arms.iter_mut().for_each(|arm| arm.turns = mirrored(&arm.turns));
        self.movements.iter_mut().for_each(|m| m.turn = m.turn.mirrored());
        self.corners.iter_mut().for_each(|corner| flip(&mut corner.at_m));
        self
    }
}
