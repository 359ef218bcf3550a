//! Lays a map under the road users of a table, and measures how many of them it fits.

use crate::around::MapPart;
use crate::cut::cut;
use crate::format::GroundMaps;
use crate::frame::Frame;
use crate::limits::MAX_GOAL_DISTANCE_M;
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::projection::TransverseMercator;
use crate::repairs::checked;
use crate::sentences;
use crate::settle::place;
use scene::geometry::Extent;
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::map::{Lane, LaneMap};
use scene::{AgentType, Scene, Shared, Vec2};
use std::cell::Cell;

/// Distance from the road users up to which the map is kept, metres.
const BESIDE_M: f64 = 100.0;
/// A map farther away belongs to another place, metres.
const FARTHEST_M: f64 = 1e8;
/// Distance from a lane up to which a vehicle is on it, metres.
const ON_LANE_M: f64 = 0.5;
/// Of several maps, one that begins farther away belongs to another place, metres.
const ELSEWHERE_M: f64 = 50_000.0;
/// Steps between two that are checked.
const LOOKED_AT: usize = 10;
/// With a smaller share of vehicles on lanes, the map belongs to another place or frame.
const FITS: f64 = 0.5;

/// Information of a recording about its place.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Placing {
    /// Origin of its own frame in the frame of the scene's source, metres.
    pub shift: Option<Vec2>,
    /// Speed limit of its lanes, m/s.
    pub limit_mps: Option<f64>,
}

/// A map under the road users of a scene.
struct LaidMap<'a> {
    map: LaneMap,
    /// Share of the positions of vehicles that lie on its lanes; nothing without vehicles.
    share: Option<f64>,
    cut: ImportWarning,
    from: &'a Scene,
}

/// Lays the map on which most vehicles are under the road users of a scene. Their frames have the same
/// source, or a map without a projection is in the recording's own frame.
///
/// # Errors
/// What a scene cannot hold.
pub(crate) fn lay(
    (mut scene, mut warnings): Imported,
    ground: &GroundMaps,
    placing: Placing,
) -> Result<Imported, ReadError> {
    warnings.extend(ground.warnings.iter().cloned());
    let states = scene.agents.iter().flat_map(|agent| agent.track.states.iter().flatten());
    let extent = Extent::about(states.map(|state| state.position()));
    let (Some(extent), false) = (extent, ground.maps.is_empty()) else { return Ok((scene, warnings)) };
    let middle = extent.middle();
    let radius_m = (extent.size().norm() / 2.0 + BESIDE_M).min(MAX_GOAL_DISTANCE_M);
    let file = Frame::of(&scene.meta.origin).place(middle).map(f64::round);
    let part = MapPart { middle, ..MapPart::about(file, radius_m) };
    let laid = |from, shift| {
        let mut map = placed(from, &scene, shift)?;
        let cut = cut(&mut map, &mut Vec::new(), &part);
        Some(LaidMap { share: on_lanes(&scene, &map), map, cut, from })
    };
    let mut best: Option<LaidMap<'_>> = None;
    for from in &ground.maps {
        let own = placing.shift.filter(|_| from.meta.origin.crs.is_none());
        let shifts = std::iter::once(Vec2::zeros()).chain(own);
        let near = |shift: &Vec2| {
            let begin = from.map.lanes.first().and_then(|lane| lane.points.xy.first());
            let begin = begin.map(|p| mover(from, &scene, *shift)(*p));
            ground.maps.len() == 1 || begin.is_some_and(|p| (p - middle).norm() < ELSEWHERE_M)
        };
        for map in shifts.filter(near).filter_map(|shift| laid(from, shift)) {
            let worth =
                |laid: &LaidMap<'_>| (laid.share.unwrap_or(0.0), usize::from(!laid.map.lanes.is_empty()));
            if best.as_ref().is_none_or(|best| worth(&map) > worth(best)) {
                best = Some(map);
            }
        }
    }
    let mut share = Some(0.0);
    if let Some(mut laid) = best {
        warnings.push(laid.cut);
        share = laid.share;
        if ground.maps.len() > 1 {
            let message = sentences::map_chosen(&laid.from.name, ground.maps.len());
            warnings.push(ImportWarning::new("map-chosen", message));
        }
        warnings.extend(placing.limit_mps.and_then(|limit_mps| limit(&mut laid.map, limit_mps)));
        let crs = laid.from.meta.origin.crs.clone();
        scene.map = Shared::from(laid.map);
        scene.meta.origin.crs = scene.meta.origin.crs.take().or(crs);
    }
    warnings.extend(share.map(|share| {
        let percent = 100.0 * share;
        if share < FITS {
            return ImportWarning::new("map-elsewhere", sentences::map_elsewhere(percent));
        }
        ImportWarning::new("map-laid", sentences::map_laid(percent))
    }));
    checked(scene, warnings)
}

/// Gives this limit to lanes for vehicles without one.
fn limit(map: &mut LaneMap, limit_mps: f64) -> Option<ImportWarning> {
    let without = |lane: &&mut Lane| lane.lane_type.carries_vehicles() && lane.speed_limit_mps.is_none();
    let lanes = map.lanes.iter_mut().filter(without);
    let count = lanes.map(|lane| lane.speed_limit_mps = Some(limit_mps)).count();
    let message = || sentences::speed_limit_of_recording(limit_mps, count);
    (count > 0).then(|| ImportWarning::new("speed-limit-of-recording", message()))
}

/// Converts positions of a scene, shifted, to the frame of another.
fn mover(ground: &Scene, scene: &Scene, shift: Vec2) -> impl Fn(Vec2) -> Vec2 + use<> {
    let (from, to) = (Frame::of(&ground.meta.origin), Frame::of(&scene.meta.origin));
    let crs = |scene: &Scene| TransverseMercator::named(scene.meta.origin.crs.as_deref()?);
    let differ = crs(ground).zip(crs(scene)).filter(|(from, to)| from != to);
    move |p| {
        let mut p = from.place(p) + shift;
        // Maps and tables in degrees are each projected about their own middle.
        if let Some((from, to)) = differ {
            let (lat, lon) = from.degrees(p);
            p = to.metres(lat, lon);
        }
        to.place_back(p)
    }
}

/// The map of a scene, shifted, in the frame of another; nothing if it lies on the other side of the globe.
fn placed(ground: &Scene, scene: &Scene, shift: Vec2) -> Option<LaneMap> {
    let moved = mover(ground, scene, shift);
    let lost = Cell::new(false);
    let mut map = LaneMap::clone(&ground.map);
    place(&mut map, |p| {
        let p = moved(p);
        // NaN is not near either.
        let near = p.x.abs() <= FARTHEST_M && p.y.abs() <= FARTHEST_M;
        lost.set(lost.get() || !near);
        if near { p } else { Vec2::zeros() }
    });
    (!lost.get()).then_some(map)
}

/// Share of the positions of vehicles that lie on a lane for vehicles; nothing without vehicles.
fn on_lanes(scene: &Scene, map: &LaneMap) -> Option<f64> {
    let lanes = || map.lanes.iter().enumerate().filter(|(_, lane)| lane.lane_type.carries_vehicles());
    let index = SegmentIndex::new(lanes().flat_map(|(i, lane)| pieces(&lane.points.xy, i as u32)).collect());
    let widest_m = lanes().map(|(_, lane)| lane.width_or_assumed_m()).fold(0.0, f64::max);
    let is_on = |at: Vec2| {
        index.near(at, widest_m / 2.0 + ON_LANE_M).any(|piece| {
            let lane = map.lanes.get(piece.owner as usize);
            let most_m = lane.map_or(0.0, |lane| lane.width_or_assumed_m() / 2.0 + ON_LANE_M);
            (piece.foot(at) - at).norm() <= most_m
        })
    };
    let vehicles = scene.agents.iter().filter(|agent| agent.agent_type == AgentType::Vehicle);
    let states = vehicles.flat_map(|agent| agent.track.states.iter().step_by(LOOKED_AT).flatten());
    let (on, all) =
        states.fold((0, 0), |(on, all), state| (on + usize::from(is_on(state.position())), all + 1));
    (all > 0).then(|| f64::from(on as u32) / f64::from(all as u32))
}
