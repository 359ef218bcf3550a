//! A map under the road users of a table, and how many of them it fits.

use crate::around::MapPart;
use crate::cut::cut;
use crate::frame::Frame;
use crate::limits::MAX_GOAL_DISTANCE_M;
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::projection::TransverseMercator;
use crate::repairs::checked;
use crate::sentences;
use crate::settle::place;
use scene::geometry::segments::{SegmentIndex, pieces};
use scene::map::LaneMap;
use scene::{AgentType, Scene, Shared, Vec2};
use std::cell::Cell;

/// The map is kept so far beside the road users, metres.
const BESIDE_M: f64 = 100.0;
/// A map farther away is that of another place, metres.
const FARTHEST_M: f64 = 1e8;
/// A vehicle is on a lane up to so far beside it, metres.
const ON_LANE_M: f64 = 0.5;
/// Every so many steps are looked at.
const LOOKED_AT: usize = 10;
/// With fewer vehicles on lanes the map is that of another place or frame.
const FITS: f64 = 0.5;

/// Lays the map of a scene under the road users of another, whose frames have the same source.
///
/// # Errors
/// What a scene cannot hold.
pub(crate) fn lay((mut scene, mut warnings): Imported, ground: &Scene) -> Result<Imported, ReadError> {
    let states = scene.agents.iter().flat_map(|agent| agent.track.states.iter().flatten());
    let corners = states.map(|state| state.position()).fold(None, |corners, at| {
        let (low, high): (Vec2, Vec2) = corners.unwrap_or((at, at));
        Some((low.inf(&at), high.sup(&at)))
    });
    let Some((low, high)) = corners else { return Ok((scene, warnings)) };
    let mut share = Some(0.0);
    if let Some(mut map) = placed(ground, &scene) {
        let middle = (low + high) / 2.0;
        let radius_m = ((high - low).norm() / 2.0 + BESIDE_M).min(MAX_GOAL_DISTANCE_M);
        let file = Frame::of(&scene.meta.origin).place(middle).map(f64::round);
        let part = MapPart { middle, ..MapPart::about(file, radius_m) };
        warnings.push(cut(&mut map, &mut Vec::new(), &part));
        share = on_lanes(&scene, &map);
        scene.map = Shared::from(map);
        scene.meta.origin.crs = scene.meta.origin.crs.take().or_else(|| ground.meta.origin.crs.clone());
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

/// The map of a scene in the frame of another; nothing where it lies on the other side of the globe.
fn placed(ground: &Scene, scene: &Scene) -> Option<LaneMap> {
    let (from, to) = (Frame::of(&ground.meta.origin), Frame::of(&scene.meta.origin));
    let crs = |scene: &Scene| TransverseMercator::named(scene.meta.origin.crs.as_deref()?);
    let differ = crs(ground).zip(crs(scene)).filter(|(from, to)| from != to);
    let lost = Cell::new(false);
    let mut map = LaneMap::clone(&ground.map);
    place(&mut map, |p| {
        let mut p = from.place(p);
        // Maps and tables in degrees are projected each about its own middle.
        if let Some((from, to)) = differ {
            let (lat, lon) = from.degrees(p);
            p = to.metres(lat, lon);
        }
        p = to.place_back(p);
        // Numbers that are none are not near either.
        let near = p.x.abs() <= FARTHEST_M && p.y.abs() <= FARTHEST_M;
        lost.set(lost.get() || !near);
        if near { p } else { Vec2::zeros() }
    });
    (!lost.get()).then_some(map)
}

/// Share of the places of vehicles that lie on a lane of vehicles; nothing where there are none.
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
