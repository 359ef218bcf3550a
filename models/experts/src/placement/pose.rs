//! Poses of road users in a cell: drawn from the learned distributions, or measured for learning. Both
//! directions are in one file so that they cannot diverge.

use super::cells::{CellKind, Cells, MapCell};
use super::context::PoseContext;
use super::model::{Histogram, TypeModel};
use crate::tuning::placing::pose::{
    BUS_M, CROSSWALK_OFFSETS, DRIVEWAY_END_M, DRIVEWAY_REACH_M, HALF_LANE_M, KERB_OFFSETS, LANE_OFFSETS,
    LANE_SIDE_M, LANE_TURNS, MOTORCYCLE_M, NARROW_KERB_M, OTHER_TURNS, PAVEMENT_OFFSETS, SIDEWALK_SHARE,
    STRAIGHT_M, TRUCK_M, USUAL_M,
};
use scene::geometry::direction;
use scene::map::LaneType;
use scene::random::Stream;
use scene::{AgentType, Size, Subtype, Vec2, wrap_angle};
use std::f64::consts::FRAC_PI_2;

/// The situation whose offsets and headings apply in a cell.
pub(super) fn pose_context(cells: &Cells<'_>, cell: &MapCell) -> PoseContext {
    match cell.kind {
        CellKind::Lane => {
            let lane = &cells.graph.lanes()[cell.line];
            match lane.lane_type {
                LaneType::BikeLane => PoseContext::BikeLane,
                _ if lane.interpolating => PoseContext::JunctionLane,
                _ => PoseContext::Lane,
            }
        }
        CellKind::Kerb if cell.free_m < NARROW_KERB_M => PoseContext::NarrowKerb,
        CellKind::Kerb if cell.free_m.is_finite() => PoseContext::WideKerb,
        CellKind::Kerb => PoseContext::NoKerb,
        CellKind::Crosswalk => PoseContext::Crosswalk,
        CellKind::Pavement => PoseContext::Pavement,
        CellKind::Driveway => PoseContext::Driveway,
    }
}

/// A pose relative to a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) position: Vec2,
    pub(super) heading_rad: f64,
    /// Arc length on the cell's line, metres.
    pub(super) s_m: f64,
}

/// Half of a box's extent across a line, for a box at `turn_rad` to it, metres.
fn half_across(size: Size, turn_rad: f64) -> f64 {
    0.5 * (size.length_m * turn_rad.sin().abs() + size.width_m * turn_rad.cos().abs())
}

fn draw(histogram: Option<&Histogram>, stream: &mut Stream) -> f64 {
    let Some(histogram) = histogram else { return 0.0 };
    let class = stream.among(histogram.share.iter().copied()).unwrap_or(0);
    histogram.low + histogram.step * (class as f64 + stream.unit())
}

/// Box of a road user in a cell of this kind; the type's default if none was learned.
pub(super) fn draw_size(
    model: &TypeModel,
    agent_type: AgentType,
    kind: CellKind,
    stream: &mut Stream,
) -> (Size, Subtype) {
    let boxes = model.sizes.get(&kind).or_else(|| model.sizes.values().next());
    let drawn = boxes.and_then(|b| b.get(stream.among(b.iter().map(|b| b[2]))?));
    let Some([length_m, width_m, _]) = drawn else {
        let subtype = subtype(agent_type, USUAL_M);
        return (Size::default_for(agent_type, subtype), subtype);
    };
    let subtype = subtype(agent_type, *length_m);
    let height_m = Size::default_for(agent_type, subtype).height_m;
    (Size { length_m: *length_m, width_m: *width_m, height_m }, subtype)
}

/// The subtype that a box of this length suggests.
fn subtype(agent_type: AgentType, length_m: f64) -> Subtype {
    match agent_type {
        AgentType::Vehicle if length_m < MOTORCYCLE_M => Subtype::Motorcycle,
        AgentType::Vehicle if length_m > BUS_M => Subtype::Bus,
        AgentType::Vehicle if length_m > TRUCK_M => Subtype::Truck,
        AgentType::Vehicle => Subtype::Car,
        AgentType::Pedestrian => Subtype::Adult,
        AgentType::Cyclist => Subtype::Bicycle,
        AgentType::Other => Subtype::Unknown,
    }
}

/// Outward axis of a driveway: from the nearest lane to the driveway's middle.
fn driveway_axis(cells: &Cells<'_>, cell: &MapCell) -> Option<Vec2> {
    let hit =
        cells.graph.nearest_for(cell.center, DRIVEWAY_REACH_M, AgentType::Vehicle).into_iter().next()?;
    let foot = cells.graph.lanes()[hit.lane].path.position_at(hit.s_m);
    (cell.center - foot).try_normalize(1e-3)
}

/// Draws a pose of a road user of this size in a cell; `None` if the cell has no room for it.
pub(super) fn draw_pose(
    cells: &Cells<'_>,
    cell: &MapCell,
    model: &TypeModel,
    agent_type: AgentType,
    size: Size,
    stream: &mut Stream,
) -> Option<Pose> {
    let context = pose_context(cells, cell);
    let mut turn_rad = draw(model.heading.get(&context), stream);
    let offset = draw(model.lateral.get(&context), stream);
    let s_m = stream.between(cell.from_m, cell.to_m);
    if cell.kind == CellKind::Driveway {
        return in_driveway(cells, cell, size, turn_rad, stream);
    }
    let base = cells.path(cell)?.sample(s_m);
    let lane = cells.graph.lanes().get(cell.line);
    let half_lane_m = lane.map_or(HALF_LANE_M, |l| 0.5 * l.width_m);
    let lateral_m = match cell.kind {
        CellKind::Lane if agent_type == AgentType::Cyclist && context != PoseContext::BikeLane => {
            offset - half_lane_m
        }
        CellKind::Lane => {
            // Drivers start within their lane: the space beside it belongs to other lanes.
            let room_m = half_lane_m - LANE_SIDE_M;
            let most_rad = ((room_m - 0.5 * size.width_m) / (0.5 * size.length_m).max(STRAIGHT_M))
                .clamp(0.0, 1.0)
                .asin();
            turn_rad = turn_rad.clamp(-most_rad, most_rad);
            let room_m = (room_m - half_across(size, turn_rad)).max(0.0);
            offset.clamp(-room_m, room_m)
        }
        CellKind::Kerb => {
            let half = half_across(size, turn_rad);
            let near = if context == PoseContext::NarrowKerb {
                half_lane_m + cell.free_m - offset - half
            } else {
                half_lane_m + offset + half
            };
            // No car stands across the kerb.
            if cell.free_m.is_finite() && near + half > half_lane_m + cell.free_m {
                return None;
            }
            cell.side * near
        }
        CellKind::Crosswalk => offset.clamp(-1.0, 1.0) * half_lane_m,
        // The middle of a sidewalk; offsets were learned only for pavements along edges.
        CellKind::Pavement if cell.on_lane => stream.between(-SIDEWALK_SHARE, SIDEWALK_SHARE) * half_lane_m,
        CellKind::Pavement => cell.side * offset,
        CellKind::Driveway => 0.0,
    };
    let left = direction(base.heading_rad + FRAC_PI_2);
    let turn_rad = if cell.kind == CellKind::Kerb { cell.side * turn_rad } else { turn_rad };
    Some(Pose {
        position: base.position + left * lateral_m,
        heading_rad: wrap_angle(base.heading_rad + turn_rad),
        s_m,
    })
}

/// A pose anywhere along a driveway's axis.
fn in_driveway(
    cells: &Cells<'_>,
    cell: &MapCell,
    size: Size,
    turn_rad: f64,
    stream: &mut Stream,
) -> Option<Pose> {
    let axis = driveway_axis(cells, cell)?;
    let ring = &cells.scene.map.driveways.get(cell.line)?.polygon.xy;
    let span = |unit: Vec2| {
        let along = ring.iter().map(move |p| (p - cell.center).dot(&unit));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let (along, across) = (span(axis), span(Vec2::new(-axis.y, axis.x)));
    let room =
        |(low, high): (f64, f64), half: f64| (low + half <= high - half).then_some((low + half, high - half));
    let (low, high) = room(along, 0.5 * size.length_m + DRIVEWAY_END_M)?;
    let (left, right) = room(across, 0.5 * size.width_m)?;
    let position = cell.center
        + axis * stream.between(low, high)
        + Vec2::new(-axis.y, axis.x) * stream.between(left, right);
    Some(Pose { position, heading_rad: wrap_angle(axis.y.atan2(axis.x) + turn_rad), s_m: 0.0 })
}

/// Offset (if offsets are learned there) and heading of a pose in a cell, in the terms in which [`draw_pose`]
/// draws them.
pub(super) fn measure(
    cells: &Cells<'_>,
    cell: &MapCell,
    agent_type: AgentType,
    size: Size,
    position: Vec2,
    heading_rad: f64,
) -> Option<(Option<f64>, f64)> {
    if cell.kind == CellKind::Driveway {
        let axis = driveway_axis(cells, cell)?;
        return Some((None, wrap_angle(heading_rad - axis.y.atan2(axis.x))));
    }
    let context = pose_context(cells, cell);
    let foot = cells.path(cell)?.project(position);
    let turn_rad = wrap_angle(heading_rad - foot.heading_rad);
    let half_lane_m = cells.graph.lanes().get(cell.line).map_or(HALF_LANE_M, |l| 0.5 * l.width_m);
    let offset = match cell.kind {
        CellKind::Lane if agent_type == AgentType::Cyclist && context != PoseContext::BikeLane => {
            foot.lateral_m + half_lane_m
        }
        CellKind::Lane => foot.lateral_m,
        CellKind::Kerb => {
            let (away, half) = (cell.side * foot.lateral_m, half_across(size, turn_rad));
            if context == PoseContext::NarrowKerb {
                half_lane_m + cell.free_m - away - half
            } else {
                away - half - half_lane_m
            }
        }
        CellKind::Crosswalk => foot.lateral_m / half_lane_m.max(0.1),
        CellKind::Pavement if cell.on_lane => return Some((None, turn_rad)),
        CellKind::Pavement => cell.side * foot.lateral_m,
        CellKind::Driveway => return None,
    };
    let turn_rad = if cell.kind == CellKind::Kerb { wrap_angle(cell.side * turn_rad) } else { turn_rad };
    Some((Some(offset), turn_rad))
}

/// Lower bound, class width and number of classes of the offsets of a context, metres (half widths on
/// crosswalks).
pub fn lateral_classes(context: PoseContext) -> (f64, f64, usize) {
    match context {
        PoseContext::Lane | PoseContext::JunctionLane | PoseContext::BikeLane => LANE_OFFSETS,
        PoseContext::NarrowKerb | PoseContext::WideKerb | PoseContext::NoKerb => KERB_OFFSETS,
        PoseContext::Crosswalk => CROSSWALK_OFFSETS,
        PoseContext::Pavement | PoseContext::Driveway => PAVEMENT_OFFSETS,
    }
}

/// The same for headings, radians.
pub fn heading_classes(context: PoseContext) -> (f64, f64, usize) {
    match context {
        PoseContext::Lane | PoseContext::JunctionLane | PoseContext::BikeLane => LANE_TURNS,
        _ => OTHER_TURNS,
    }
}
