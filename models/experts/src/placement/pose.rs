//! How a road user stands in a cell: drawn from the learned distributions, or measured for learning.
//! Both directions are here, so that they cannot drift apart.

use super::model::{Histogram, TypeModel};
use super::sites::{Site, SiteKind, Sites};
use scene::geometry::direction;
use scene::map::LaneType;
use scene::random::Stream;
use scene::{AgentType, Size, Subtype, Vec2, wrap_angle};
use std::f64::consts::{FRAC_PI_2, PI};

/// Room between a driveway's end and a car's, metres.
const DRIVEWAY_END_M: f64 = 0.3;

/// Which offsets and headings hold in a cell.
pub(super) fn pose_context(sites: &Sites<'_>, site: &Site) -> u16 {
    match site.kind {
        SiteKind::Lane => {
            let lane = &sites.graph.lanes()[site.line];
            if lane.lane_type == LaneType::BikeLane { 2 } else { u16::from(lane.interpolating) }
        }
        SiteKind::Kerb if site.free_m < 3.5 => 10,
        SiteKind::Kerb if site.free_m.is_finite() => 11,
        SiteKind::Kerb => 12,
        SiteKind::Crosswalk => 20,
        SiteKind::Pavement => 30,
        SiteKind::Driveway => 40,
    }
}

/// A way to stand in a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) position: Vec2,
    pub(super) heading_rad: f64,
    /// Arc length on the cell's line, metres.
    pub(super) s_m: f64,
}

/// Half of a box's extent across a line to which it stands at `turn_rad`, metres.
fn half_across(size: Size, turn_rad: f64) -> f64 {
    0.5 * (size.length_m * turn_rad.sin().abs() + size.width_m * turn_rad.cos().abs())
}

fn draw(histogram: Option<&Histogram>, stream: &mut Stream) -> f64 {
    let Some(histogram) = histogram else { return 0.0 };
    let class = stream.among(histogram.share.iter().copied()).unwrap_or(0);
    histogram.low + histogram.step * (class as f64 + stream.unit())
}

/// Box of a road user in a cell of this kind; the type's default where nothing was learned.
pub(super) fn draw_size(
    model: &TypeModel,
    agent_type: AgentType,
    kind: SiteKind,
    stream: &mut Stream,
) -> (Size, Subtype) {
    let boxes = model.sizes.get(&kind).or_else(|| model.sizes.values().next());
    let drawn = boxes.and_then(|b| b.get(stream.among(b.iter().map(|b| b[2]))?));
    let Some([length_m, width_m, _]) = drawn else {
        let subtype = subtype(agent_type, 4.7);
        return (Size::default_for(agent_type, subtype), subtype);
    };
    let subtype = subtype(agent_type, *length_m);
    let height_m = Size::default_for(agent_type, subtype).height_m;
    (Size { length_m: *length_m, width_m: *width_m, height_m }, subtype)
}

/// Finer type that a box of this length suggests.
fn subtype(agent_type: AgentType, length_m: f64) -> Subtype {
    match agent_type {
        AgentType::Vehicle if length_m < 3.0 => Subtype::Motorcycle,
        AgentType::Vehicle if length_m > 10.0 => Subtype::Bus,
        AgentType::Vehicle if length_m > 6.5 => Subtype::Truck,
        AgentType::Vehicle => Subtype::Car,
        AgentType::Pedestrian => Subtype::Adult,
        AgentType::Cyclist => Subtype::Bicycle,
        AgentType::Other => Subtype::Unknown,
    }
}

/// Outward axis of a driveway: from the nearest lane to its middle.
fn driveway_axis(sites: &Sites<'_>, site: &Site) -> Option<Vec2> {
    let hit = sites.graph.nearest_for(site.center, 40.0, AgentType::Vehicle).into_iter().next()?;
    let foot = sites.graph.lanes()[hit.lane].path.sample(hit.s_m).position;
    (site.center - foot).try_normalize(1e-3)
}

/// Draws how a road user of this size stands in a cell; `None` when the cell has no room for it.
pub(super) fn draw_pose(
    sites: &Sites<'_>,
    site: &Site,
    model: &TypeModel,
    agent_type: AgentType,
    size: Size,
    stream: &mut Stream,
) -> Option<Pose> {
    let context = pose_context(sites, site);
    let turn_rad = draw(model.heading.get(&context), stream);
    let offset = draw(model.lateral.get(&context), stream);
    let s_m = stream.between(site.from_m, site.to_m);
    if site.kind == SiteKind::Driveway {
        return in_driveway(sites, site, size, turn_rad, stream);
    }
    let base = sites.path(site)?.sample(s_m);
    let lane = sites.graph.lanes().get(site.line);
    let half_lane_m = lane.map_or(1.75, |l| 0.5 * l.width_m);
    let lateral_m = match site.kind {
        SiteKind::Lane if agent_type == AgentType::Cyclist && context != 2 => offset - half_lane_m,
        SiteKind::Lane => offset,
        SiteKind::Kerb => {
            let half = half_across(size, turn_rad);
            let near = if context == 10 {
                half_lane_m + site.free_m - offset - half
            } else {
                half_lane_m + offset + half
            };
            // No car stands across the kerb.
            if site.free_m.is_finite() && near + half > half_lane_m + site.free_m {
                return None;
            }
            site.side * near
        }
        SiteKind::Crosswalk => offset.clamp(-1.0, 1.0) * half_lane_m,
        // The middle 70 % of a sidewalk; learned are pavements along edges.
        SiteKind::Pavement if site.on_lane => stream.between(-0.7, 0.7) * half_lane_m,
        SiteKind::Pavement => site.side * offset,
        SiteKind::Driveway => 0.0,
    };
    let left = direction(base.heading_rad + FRAC_PI_2);
    let turn_rad = if site.kind == SiteKind::Kerb { site.side * turn_rad } else { turn_rad };
    Some(Pose {
        position: base.position + left * lateral_m,
        heading_rad: wrap_angle(base.heading_rad + turn_rad),
        s_m,
    })
}

/// Anywhere along a driveway's axis.
fn in_driveway(
    sites: &Sites<'_>,
    site: &Site,
    size: Size,
    turn_rad: f64,
    stream: &mut Stream,
) -> Option<Pose> {
    let axis = driveway_axis(sites, site)?;
    let ring = &sites.scene.map.driveways.get(site.line)?.polygon.xy;
    let span = |unit: Vec2| {
        let along = ring.iter().map(move |p| (p - site.center).dot(&unit));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let (along, across) = (span(axis), span(Vec2::new(-axis.y, axis.x)));
    let room =
        |(low, high): (f64, f64), half: f64| (low + half <= high - half).then_some((low + half, high - half));
    let (low, high) = room(along, 0.5 * size.length_m + DRIVEWAY_END_M)?;
    let (left, right) = room(across, 0.5 * size.width_m)?;
    let position = site.center
        + axis * stream.between(low, high)
        + Vec2::new(-axis.y, axis.x) * stream.between(left, right);
    Some(Pose { position, heading_rad: wrap_angle(axis.y.atan2(axis.x) + turn_rad), s_m: 0.0 })
}

/// What a pose in a cell teaches: offset (when offsets are learned there) and heading, in the terms that
/// [`draw_pose`] draws.
pub(super) fn measure(
    sites: &Sites<'_>,
    site: &Site,
    agent_type: AgentType,
    size: Size,
    position: Vec2,
    heading_rad: f64,
) -> Option<(Option<f64>, f64)> {
    if site.kind == SiteKind::Driveway {
        let axis = driveway_axis(sites, site)?;
        return Some((None, wrap_angle(heading_rad - axis.y.atan2(axis.x))));
    }
    let context = pose_context(sites, site);
    let foot = sites.path(site)?.project(position);
    let turn_rad = wrap_angle(heading_rad - foot.heading_rad);
    let half_lane_m = sites.graph.lanes().get(site.line).map_or(1.75, |l| 0.5 * l.width_m);
    let offset = match site.kind {
        SiteKind::Lane if agent_type == AgentType::Cyclist && context != 2 => foot.lateral_m + half_lane_m,
        SiteKind::Lane => foot.lateral_m,
        SiteKind::Kerb => {
            let (away, half) = (site.side * foot.lateral_m, half_across(size, turn_rad));
            if context == 10 { half_lane_m + site.free_m - away - half } else { away - half - half_lane_m }
        }
        SiteKind::Crosswalk => foot.lateral_m / half_lane_m.max(0.1),
        SiteKind::Pavement if site.on_lane => return Some((None, turn_rad)),
        SiteKind::Pavement => site.side * foot.lateral_m,
        SiteKind::Driveway => return None,
    };
    let turn_rad = if site.kind == SiteKind::Kerb { wrap_angle(site.side * turn_rad) } else { turn_rad };
    Some((Some(offset), turn_rad))
}

/// Lower bound, class width and number of classes of the offsets of a context, metres (half widths on
/// crosswalks).
pub fn lateral_classes(context: u16) -> (f64, f64, usize) {
    match context {
        0..=2 => (-2.0, 0.1, 60),
        10..=12 => (-1.0, 0.2, 40),
        20 => (-1.0, 0.1, 20),
        _ => (-2.0, 0.25, 40),
    }
}

/// The same of headings, radians.
pub fn heading_classes(context: u16) -> (f64, f64, usize) {
    match context {
        0..=2 => (-20f64.to_radians(), 1f64.to_radians(), 40),
        _ => (-PI, PI / 36.0, 72),
    }
}
