//! Maps as pieces of lines, for networks that read them. Lanes, edges, crosswalks and stop signs are cut into
//! stretches of at most 20 m, each in its own frame. Only the baselines see them; the anchors of the experts
//! contain what these need of the map.

use experts::planning::world::{AgentAtStart, World};
use scene::geometry::polyline::Polyline;
use scene::geometry::{direction, rotate};
use scene::map::{LaneMap, LaneType};
use scene::routes::Pose;
use scene::{SignalState, Vec2};

/// Most pieces that a road user sees.
pub const PIECES: usize = 48;
/// Numbers of a piece in its own frame.
pub const PIECE: usize = 60;
/// Numbers of a piece relative to a road user: pose, distance, signal state, time in state.
pub const PIECE_POSE: usize = 14;

/// Longest piece, metres.
const PIECE_M: f64 = 20.0;
/// Points of a piece.
const POINTS: usize = 10;
/// Numbers of a point: position and direction.
const PER_POINT: usize = 4;
/// Farthest piece that is seen, metres.
const SIGHT_M: f64 = 90.0;

/// Pieces of a map with their poses.
#[derive(Clone, Debug, Default)]
pub struct Polylines {
    /// [`PIECE`] numbers each.
    pub pieces: Vec<[f32; PIECE]>,
    /// Middle of each piece, scene frame.
    poses: Vec<Pose>,
    /// Lane id of pieces of lanes, for their signals.
    lanes: Vec<Option<String>>,
}

/// One piece as a road user sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenPiece {
    /// Index into [`Polylines::pieces`].
    pub piece: usize,
    /// Relative pose and present signal.
    pub pose: [f32; PIECE_POSE],
}

/// Kind of a piece, one number each in the features.
#[derive(Clone, Copy)]
enum PieceKind {
    Lane(LaneType),
    Edge,
    Crosswalk,
    StopSign,
}

impl PieceKind {
    fn slot(self) -> usize {
        match self {
            Self::Lane(LaneType::Freeway) => 0,
            Self::Lane(LaneType::BikeLane) => 1,
            Self::Lane(LaneType::BusLane) => 2,
            Self::Lane(LaneType::Sidewalk) => 3,
            Self::Lane(LaneType::Parking) => 4,
            Self::Lane(_) => 5,
            Self::Edge => 6,
            Self::Crosswalk => 7,
            Self::StopSign => 8,
        }
    }
}

impl Polylines {
    /// Cuts a map.
    pub fn new(map: &LaneMap) -> Self {
        let mut out = Self::default();
        for lane in &map.lanes {
            let extra = [
                lane.speed_limit_mps.map_or(-1.0, |v| v / 15.0),
                lane.width_or_assumed_m() / 4.0,
                f64::from(u8::from(lane.interpolating)),
                if lane.successors.is_empty() { 1.0 } else { 0.0 },
            ];
            out.cut(&lane.points.xy, PieceKind::Lane(lane.lane_type), extra, Some(&lane.id));
        }
        for edge in &map.road_edges {
            out.cut(&edge.points.xy, PieceKind::Edge, [0.0; 4], None);
        }
        for crosswalk in &map.crosswalks {
            let mut ring = crosswalk.polygon.xy.clone();
            ring.extend(ring.first().copied());
            out.push(&Polyline::new(ring), PieceKind::Crosswalk, [0.0; 4], Some(&crosswalk.id));
        }
        for sign in &map.stop_signs {
            let point = [sign.position, sign.position + Vec2::new(0.1, 0.0)];
            out.push(&Polyline::new(point), PieceKind::StopSign, [0.0; 4], None);
        }
        out
    }

    fn cut(&mut self, points: &[Vec2], kind: PieceKind, extra: [f64; 4], id: Option<&String>) {
        let line = Polyline::new(points.iter().copied());
        let count = (line.length_m() / PIECE_M).ceil().max(1.0) as usize;
        let step = line.length_m() / count as f64;
        for i in 0..count {
            let piece = line.slice(i as f64 * step, (i + 1) as f64 * step);
            self.push(&piece, kind, extra, id);
        }
    }

    fn push(&mut self, line: &Polyline, kind: PieceKind, extra: [f64; 4], id: Option<&String>) {
        let middle = line.sample(0.5 * line.length_m());
        let mut features = [0.0_f32; PIECE];
        for i in 0..POINTS {
            let here = line.sample(line.length_m() * i as f64 / (POINTS - 1) as f64);
            let local = rotate(here.position - middle.position, -middle.heading_rad) / 10.0;
            let ahead = direction(here.heading_rad - middle.heading_rad);
            let at = i * PER_POINT;
            features[at..at + PER_POINT].copy_from_slice(&[
                local.x as f32,
                local.y as f32,
                ahead.x as f32,
                ahead.y as f32,
            ]);
        }
        let at = POINTS * PER_POINT;
        features[at + kind.slot()] = 1.0;
        features[at + 9] = (line.length_m() / PIECE_M) as f32;
        for (i, value) in extra.into_iter().enumerate() {
            features[at + 10 + i] = value as f32;
        }
        self.pieces.push(features);
        self.poses.push(middle);
        self.lanes.push(id.cloned());
    }

    /// Map pieces that a road user sees: at most [`PIECES`], the nearest first, biased ahead and to its goal.
    pub fn seen(&self, world: &World<'_>, who: &AgentAtStart) -> Vec<SeenPiece> {
        let (origin, heading_rad) = (who.start.position(), who.start.heading_rad);
        let local = |p: Vec2| rotate(p - origin, -heading_rad);
        let goal = world.target(who).position.map(local);
        let mut order: Vec<(f64, usize, Vec2)> = Vec::new();
        for (piece, pose) in self.poses.iter().enumerate() {
            let at = local(pose.position);
            let distance = at.norm();
            if distance <= SIGHT_M {
                let to_goal = goal.map_or(f64::INFINITY, |g| (g - at).norm() + 10.0);
                order.push(((distance - 0.35 * at.x).min(to_goal), piece, at));
            }
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        order.truncate(PIECES);
        let seen = |(_, piece, at)| SeenPiece { piece, pose: self.relative(world, piece, at, heading_rad) };
        order.into_iter().map(seen).collect()
    }

    /// A piece's place `at` and heading in the frame of a road user with this heading, and its signal.
    fn relative(&self, world: &World<'_>, piece: usize, at: Vec2, heading_rad: f64) -> [f32; PIECE_POSE] {
        let ahead = direction(self.poses[piece].heading_rad - heading_rad);
        let lane = self.lanes[piece].as_deref().and_then(|id| world.graph.lane_index(id));
        let signal = lane.and_then(|lane| world.signals.iter().position(|s| s.lane == lane));
        let state = signal.map(|i| world.signals[i].state);
        let age_s = signal.map_or(0.0, |i| world.signal_ages_s[i]);
        let flag = |value: bool| f64::from(u8::from(value));
        let mut out = [0.0; PIECE_POSE];
        let values = [
            at.x / 30.0,
            at.y / 30.0,
            at.norm() / 30.0,
            ahead.x,
            ahead.y,
            flag(at.x > 0.0),
            flag(at.norm() < 8.0),
            flag(state.is_some()),
            flag(state.is_some_and(SignalState::is_stop)),
            flag(state.is_some_and(SignalState::is_caution)),
            flag(matches!(state, Some(SignalState::Go | SignalState::ArrowGo))),
            age_s.min(200.0) / 10.0,
        ];
        for (out, value) in out.iter_mut().zip(values) {
            *out = value as f32;
        }
        out
    }
}
