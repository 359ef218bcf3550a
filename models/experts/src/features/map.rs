//! Map pieces for the map encoder: lanes, edges, crosswalks and stop signs cut into stretches of at
//! most 20 m, each in its own frame, so that a map is encoded once whoever looks at it.

use super::{MapFeatures, PIECE};
use scene::geometry::polyline::Polyline;
use scene::map::{LaneMap, LaneType};
use scene::routes::Pose;
use scene::{Vec2, geometry};

/// Longest piece, metres.
const PIECE_M: f64 = 20.0;
/// Points of a piece.
const POINTS: usize = 10;
/// Numbers of a point: position and direction.
const PER_POINT: usize = 4;

/// Pieces of a map with where they lie.
#[derive(Clone, Debug, Default)]
pub struct MapPieces {
    /// For the map encoder.
    pub features: MapFeatures,
    /// Middle of each piece, scene frame.
    pub poses: Vec<Pose>,
    /// Lane id of pieces of lanes, for their signals.
    pub lanes: Vec<Option<String>>,
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

impl MapPieces {
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
            let local = geometry::rotate(here.position - middle.position, -middle.heading_rad) / 10.0;
            let ahead = geometry::direction(here.heading_rad - middle.heading_rad);
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
        self.features.pieces.push(features);
        self.poses.push(middle);
        self.lanes.push(id.cloned());
    }
}
