//! Converts a request to the placer's input, and checks every member against its range.

use super::request::{ArrivalsDoc, DensityDoc, ParkedDoc, PlaceBody, RegionDoc, SpeedsDoc};
use crate::english::{self, wanted, what};
use crate::problem::{Problem, refuse, unknown_agent};
use experts::placement::{
    Amount, Arrivals, MAX_COUNT, MAX_GAP_M, MAX_PARKED_PER_100M, MAX_PER_HOUR, MAX_PER_LANE_KM,
    MAX_SPEED_MPS, Parked, PlaceRequest, Region, SpeedRange, map_extent, ring_area_m2,
};
use formats::native::{MAX_SAFE_INTEGER, Members};
use formats::problem::MAX_PROBLEMS;
use formats::refusals::{at_most, expected, out_of_range, wanted::AGENT_TYPE};
use formats::{FieldProblem, pointer_token};
use scene::geometry::Extent;
use scene::message::Message;
use scene::{AgentType, STEP_S, Scene, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Greatest distance of a region beyond the map's box, metres: hand-drawn rings are not exact.
const REGION_MARGIN_M: f64 = 50.0;
/// Most corners of a region.
const MAX_CORNERS: usize = scene::MAX_POLYLINE_POINTS;
/// Most arms in a request.
const MAX_ARMS: usize = 256;
/// Tolerance of the sum of shares, which must be one.
const SHARE_TOLERANCE: f64 = 1e-6;

impl PlaceBody {
    pub(super) fn engine_request(&self, scene: &Arc<Scene>) -> Result<PlaceRequest, Problem> {
        let mut faults = Vec::new();
        let last_s = (scene.time.steps - 1) as f64 * STEP_S;
        let numbers = [
            ("/start_s", 0.0, last_s, self.start_s),
            ("/seed", 0.0, MAX_SAFE_INTEGER as f64, self.seed as f64),
            ("/min_gap_m", 0.0, MAX_GAP_M, self.min_gap_m),
        ];
        for (pointer, min, max, got) in numbers {
            in_range(&mut faults, pointer, (min, max), got);
        }
        let amount = match &self.density {
            Some(density) => amount(density, &mut faults),
            None if self.arrivals.is_empty() && self.parked.is_none() => {
                PlaceRequest::new(Arc::clone(scene)).amount
            }
            None => Amount::PerLaneKm(0.0),
        };
        let speeds = self.speeds.map(|doc| speeds(doc, &mut faults));
        let arrivals = arrivals(&self.arrivals, &mut faults);
        let parked = self.parked.as_ref().map(|doc| parked(doc, &mut faults));
        let types = match &self.types {
            Some(types) => shares(types, &mut faults),
            None => PlaceRequest::new(Arc::clone(scene)).types,
        };
        let region = self.region.as_ref().map_or(Region::Everywhere, |doc| region(doc, scene, &mut faults));
        for (i, id) in self.keep.iter().flatten().enumerate().filter(|(_, id)| scene.agent(id).is_none()) {
            faults.push(unknown_agent(format!("/keep/{i}"), id));
        }
        faults.truncate(MAX_PROBLEMS);
        refuse(faults)?;
        Ok(PlaceRequest {
            step: (self.start_s / STEP_S).round() as usize,
            region,
            amount,
            types,
            keep: self.keep.as_ref().map(|ids| ids.iter().cloned().collect::<BTreeSet<_>>()),
            seed: self.seed,
            min_gap_m: self.min_gap_m,
            speeds,
            arrivals,
            parked,
            ..PlaceRequest::new(Arc::clone(scene))
        })
    }
}

fn in_range(faults: &mut Vec<FieldProblem>, pointer: &str, (min, max): (f64, f64), got: f64) {
    // The last step's time is rounded.
    if !(got >= min && got <= max + 1e-9) {
        faults.push(FieldProblem::range(pointer, min, max, got));
    }
}

fn invalid(pointer: impl Into<String>, message: Message) -> FieldProblem {
    FieldProblem::new(pointer, "invalid-field", message)
}

fn amount(density: &DensityDoc, faults: &mut Vec<FieldProblem>) -> Amount {
    match (density.per_lane_km, density.count) {
        (Some(per_km), None) => {
            in_range(faults, "/density/per_lane_km", (0.0, MAX_PER_LANE_KM), per_km);
            Amount::PerLaneKm(per_km)
        }
        (None, Some(count)) => {
            in_range(faults, "/density/count", (1.0, MAX_COUNT as f64), count as f64);
            Amount::Count(count as usize)
        }
        _ => {
            faults.push(invalid("/density", english::exactly_one("per_lane_km", "count")));
            Amount::Count(0)
        }
    }
}

fn speeds(doc: SpeedsDoc, faults: &mut Vec<FieldProblem>) -> SpeedRange {
    let SpeedsDoc { min_mps, max_mps } = doc;
    in_range(faults, "/speeds/min_mps", (0.0, MAX_SPEED_MPS), min_mps);
    in_range(faults, "/speeds/max_mps", (min_mps.clamp(0.0, MAX_SPEED_MPS), MAX_SPEED_MPS), max_mps);
    SpeedRange { min_mps, max_mps }
}

fn arrivals(all: &[ArrivalsDoc], faults: &mut Vec<FieldProblem>) -> Vec<Arrivals> {
    if all.len() > MAX_ARMS {
        faults.push(invalid("/arrivals", at_most(all.len(), what::ARMS, MAX_ARMS)));
        return Vec::new();
    }
    let mut seen = BTreeSet::new();
    for (i, ArrivalsDoc { arm, per_hour }) in all.iter().enumerate() {
        in_range(faults, &format!("/arrivals/{i}/per_hour"), (0.0, MAX_PER_HOUR), *per_hour);
        if !seen.insert(arm) {
            faults.push(invalid(format!("/arrivals/{i}/arm"), expected(wanted::ONE_RATE)));
        }
    }
    all.iter().map(|doc| Arrivals { arm: doc.arm.clone(), per_hour: doc.per_hour }).collect()
}

fn parked(doc: &ParkedDoc, faults: &mut Vec<FieldProblem>) -> Parked {
    match (doc.share, doc.per_100m) {
        (Some(share), None) => {
            in_range(faults, "/parked/share", (0.0, 1.0), share);
            Parked::Share(share)
        }
        (None, Some(count)) => {
            in_range(faults, "/parked/per_100m", (0.0, MAX_PARKED_PER_100M), count);
            Parked::Per100M(count)
        }
        _ => {
            faults.push(invalid("/parked", english::exactly_one("share", "per_100m")));
            Parked::Share(0.0)
        }
    }
}

fn shares(types: &Members<f64>, faults: &mut Vec<FieldProblem>) -> BTreeMap<AgentType, f64> {
    let mut shares = BTreeMap::new();
    for (name, share) in &types.0 {
        let agent_type = match name.as_str() {
            "vehicle" => AgentType::Vehicle,
            "pedestrian" => AgentType::Pedestrian,
            "cyclist" => AgentType::Cyclist,
            _ => {
                let pointer = format!("/types/{}", pointer_token(name));
                faults.push(invalid(pointer, expected(AGENT_TYPE)));
                continue;
            }
        };
        in_range(faults, &format!("/types/{name}"), (0.0, 1.0), *share);
        shares.insert(agent_type, *share);
    }
    let sum: f64 = types.0.values().sum();
    if (sum - 1.0).abs() > SHARE_TOLERANCE || sum.is_nan() {
        faults.push(FieldProblem::new("/types", "out-of-range", english::share_sum(&sum.to_string())));
    }
    shares
}

fn region(doc: &RegionDoc, scene: &Scene, faults: &mut Vec<FieldProblem>) -> Region {
    let Some(extent) = map_extent(&scene.map) else {
        faults.push(invalid("/region", english::empty_map()));
        return Region::Everywhere;
    };
    let Extent { low, high } = extent.grown(REGION_MARGIN_M);
    let before = faults.len();
    match (&doc.polygon_m, &doc.circle) {
        (Some(corners), None) => {
            if !(3..=MAX_CORNERS).contains(&corners.len()) {
                let message = out_of_range(corners.len() as f64, 3.0, MAX_CORNERS as f64);
                faults.push(invalid("/region/polygon_m", message));
            }
            for (i, [x, y]) in corners.iter().enumerate().take(MAX_CORNERS) {
                in_range(faults, &format!("/region/polygon_m/{i}/0"), (low.x, high.x), *x);
                in_range(faults, &format!("/region/polygon_m/{i}/1"), (low.y, high.y), *y);
            }
            let ring: Vec<Vec2> = corners.iter().map(|[x, y]| Vec2::new(*x, *y)).collect();
            if faults.len() == before && ring_area_m2(&ring) < 0.1 {
                faults.push(invalid("/region/polygon_m", expected(wanted::AREA)));
            }
            Region::Polygon(ring)
        }
        (None, Some(circle)) => {
            in_range(faults, "/region/circle/x_m", (low.x, high.x), circle.x_m);
            in_range(faults, "/region/circle/y_m", (low.y, high.y), circle.y_m);
            in_range(
                faults,
                "/region/circle/radius_m",
                (0.5, 2.0 * scene::MAX_COORDINATE_M),
                circle.radius_m,
            );
            Region::Circle { center: Vec2::new(circle.x_m, circle.y_m), radius_m: circle.radius_m }
        }
        _ => {
            faults.push(invalid("/region", english::exactly_one("polygon_m", "circle")));
            Region::Everywhere
        }
    }
}
