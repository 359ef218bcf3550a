//! One road, straight or bent; its kerbs come closer at a crosswalk if cars are parked.

use crate::curve::{arc, left_of, length, parallel, straight, tidy};
use crate::draft::MapDraft;
use crate::junction::open;
use crate::parameters::{Road, Traffic};
use crate::roadway::{Plan, Profile};
use scene::Vec2;
use scene::geometry::direction;
use scene::map::LaneType;
use std::f64::consts::FRAC_PI_2;

/// Length before and behind a crosswalk without parking, metres; over it, the kerb comes closer.
const NO_PARKING_M: f64 = 7.0;
const TAPER_M: f64 = 2.5;
/// Distance of speed bumps from the crosswalk, and their length, metres.
const BUMP_AWAY_M: f64 = 22.0;
const BUMP_M: f64 = 2.4;
/// Least radius of a bend at its inner edge, metres.
const INSIDE_M: f64 = 8.0;
/// Least length of the straight beginning and end, metres.
const STRAIGHT_M: f64 = 20.0;

pub fn draw(road: &Road) -> MapDraft {
    let profile = Profile {
        lanes: [usize::from(road.lanes_forward), usize::from(road.lanes_backward)],
        lane_m: road.lane_width_m,
        cycle_m: road.cycle_lane_m,
        parking_m: 0.0,
        median_m: road.median_m,
        limit_kmh: road.speed_limit_kmh,
    };
    let axis = axis(road, &profile);
    let length_m = length(&axis);
    let mut draft = MapDraft::default();
    let median_m = vec![road.median_m; axis.len()];
    // With a crosswalk the median is not raised, so that it does not block pedestrians.
    let raised = if road.crosswalk_m > 0.0 { 0.0 } else { f64::INFINITY };
    let plan = Plan {
        id: "road",
        profile: &profile,
        axis: &axis,
        median_m: &median_m,
        raised_m: raised,
        stops: [false, false],
    };
    let drawn = plan.draw(&mut draft);
    for lane in drawn.left.all().into_iter().chain(drawn.right.all()) {
        draft.about[lane].open[0] = true;
    }
    open(&mut draft, &drawn);
    drawn.left.all().into_iter().for_each(|lane| draft.about[lane].open[1] = true);

    let middle_m = length_m / 2.0;
    let stations = stations(road, length_m);
    let parked = road.parking_m > 0.0;
    let kerb = |side: usize| -> Vec<Vec2> {
        let base = profile.half_m(side);
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let wide = |s: f64| {
            if !parked || profile.lanes[side] == 0 {
                return 0.0;
            }
            if road.crosswalk_m <= 0.0 {
                return road.parking_m;
            }
            let away = (s - middle_m).abs() - road.crosswalk_m / 2.0 - NO_PARKING_M;
            road.parking_m * (away / TAPER_M + 1.0).clamp(0.0, 1.0)
        };
        stations.iter().map(|s| beside(&axis, *s, sign * (base + wide(*s)))).collect()
    };
    let (right, left) = (kerb(0), kerb(1));
    let mut ring = right.clone();
    ring.extend(left.iter().rev());
    let islands = std::mem::take(&mut draft.islands);
    draft.ground(tidy(ring), islands);
    for (side, line) in [(&drawn.right, &right), (&drawn.left, &left)] {
        let edge = draft.edge("boundary", line.clone());
        if let Some(last) = side.all().last() {
            draft.bound(*last, false, &edge);
        }
    }
    if parked {
        parking(&mut draft, road, &profile, &axis, length_m);
    }
    crosswalk(&mut draft, road, &profile, &axis, middle_m);
    if road.sidewalk_m > 0.0 {
        let half_m = |side: usize| profile.half_m(side) + if parked { road.parking_m } else { 0.0 };
        sidewalks(&mut draft, road, &axis, [half_m(0), half_m(1)], length_m);
    }
    draft
}

/// The axis of the road, with its middle as near to the origin of the scene as possible.
fn axis(road: &Road, profile: &Profile) -> Vec<Vec2> {
    let bend_deg = match road.traffic {
        Traffic::RightHand => road.bend_deg,
        Traffic::LeftHand => -road.bend_deg,
    };
    let bend = bend_deg.to_radians();
    let widest = profile.half_m(0).max(profile.half_m(1)) + road.parking_m + road.sidewalk_m + INSIDE_M;
    let radius_m = road.radius_m.max(widest);
    let around_m = radius_m * bend.abs();
    let lead_m = ((road.length_m - around_m) / 2.0).max(STRAIGHT_M);
    let mut line = straight(Vec2::new(-lead_m, 0.0), Vec2::zeros());
    if bend.abs() > 1e-3 {
        let side = bend.signum();
        let centre = Vec2::new(0.0, side * radius_m);
        line.extend(arc(centre, radius_m, -side * FRAC_PI_2, -side * FRAC_PI_2 + bend));
    }
    let end = line[line.len() - 1];
    line.extend(straight(end, end + direction(bend) * lead_m));
    let line = tidy(line);
    let middle = at(&line, length(&line) / 2.0).0;
    line.into_iter().map(|p| p - middle).collect()
}

/// Point and direction at a distance along a line.
fn at(line: &[Vec2], s_m: f64) -> (Vec2, Vec2) {
    let mut s = 0.0;
    let last = line.len() - 1;
    for i in 1..=last {
        let piece = line[i] - line[i - 1];
        let long = piece.norm().max(1e-9);
        if s + long >= s_m || i == last {
            return (line[i - 1] + piece * ((s_m - s) / long).clamp(0.0, 1.0), piece / long);
        }
        s += long;
    }
    (line[0], Vec2::new(1.0, 0.0))
}

/// The position at an offset to the left of the line, metres; smooth in bends.
fn beside(axis: &[Vec2], s_m: f64, left_m: f64) -> Vec2 {
    let total = length(axis);
    let (before, after) = (at(axis, (s_m - 0.4).max(0.0)).1, at(axis, (s_m + 0.4).min(total)).1);
    let way = (before + after).normalize();
    at(axis, s_m).0 + left_of(way) * left_m
}

/// Positions of the points of a kerb: close together in a bend and at the crosswalk.
fn stations(road: &Road, length_m: f64) -> Vec<f64> {
    let step = if road.bend_deg.abs() > 0.1 { 2.0 } else { 10.0 };
    let count = (length_m / step).ceil() as usize;
    let mut all: Vec<f64> = (0..=count).map(|i| length_m * i as f64 / count as f64).collect();
    if road.crosswalk_m > 0.0 {
        let half = road.crosswalk_m / 2.0 + NO_PARKING_M;
        for away in [half - TAPER_M, half] {
            all.extend([length_m / 2.0 - away, length_m / 2.0 + away]);
        }
    }
    all.retain(|s| (0.0..=length_m).contains(s));
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a - *b).abs() < 0.05);
    all
}

fn parking(draft: &mut MapDraft, road: &Road, profile: &Profile, axis: &[Vec2], length_m: f64) {
    let free_m = if road.crosswalk_m > 0.0 { road.crosswalk_m / 2.0 + NO_PARKING_M } else { 0.0 };
    let parts = if free_m > 0.0 {
        vec![[0.0, length_m / 2.0 - free_m], [length_m / 2.0 + free_m, length_m]]
    } else {
        vec![[0.0, length_m]]
    };
    for (side, word) in [(0, "out"), (1, "in")] {
        if profile.lanes[side] == 0 {
            continue;
        }
        let sign = if side == 0 { -1.0 } else { 1.0 };
        for (i, [from, to]) in parts.iter().filter(|[from, to]| to - from > 8.0).enumerate() {
            let count = ((to - from) / 4.0).ceil() as usize;
            let line = |left_m: f64| -> Vec<Vec2> {
                let place =
                    |k: usize| beside(axis, from + (to - from) * k as f64 / count as f64, sign * left_m);
                let mut line: Vec<Vec2> = (0..=count).map(place).collect();
                if side == 1 {
                    line.reverse();
                }
                line
            };
            let half_m = profile.half_m(side);
            let id = format!("road.{word}-parking{}", i + 1);
            draft.lane(id, LaneType::Parking, line(half_m + road.parking_m / 2.0), road.parking_m, 0.0);
            draft.line("solid_single_white", line(half_m));
        }
    }
}

fn crosswalk(draft: &mut MapDraft, road: &Road, profile: &Profile, axis: &[Vec2], middle_m: f64) {
    if road.crosswalk_m <= 0.0 {
        return;
    }
    let ring = |at_m: f64, long_m: f64, right_m: f64, left_m: f64| {
        let (p, way) = at(axis, at_m);
        let (half, left) = (way * (long_m / 2.0), left_of(way));
        [
            p - half - left * right_m,
            p + half - left * right_m,
            p + half + left * left_m,
            p - half + left * left_m,
        ]
    };
    draft.crosswalk(ring(middle_m, road.crosswalk_m, profile.half_m(0), profile.half_m(1)));
    if road.speed_bumps {
        for at_m in [middle_m - BUMP_AWAY_M, middle_m + BUMP_AWAY_M] {
            let inside = |side: usize| profile.half_m(side) - 0.3;
            draft.bump(ring(at_m, BUMP_M, inside(0), inside(1)));
        }
    }
}

/// Pavements; they are cut at the end of a crosswalk, so that people turn there.
fn sidewalks(draft: &mut MapDraft, road: &Road, axis: &[Vec2], halves_m: [f64; 2], length_m: f64) {
    let behind_m = road.sidewalk_m / 2.0 + 0.2;
    for (side, sign) in [(0, -1.0), (1, 1.0)] {
        let line = parallel(axis, sign * (halves_m[side] + behind_m));
        if road.crosswalk_m <= 0.0 {
            draft.sidewalk(line, road.sidewalk_m, false);
            continue;
        }
        // Beside the crosswalk, the pavement extends to its kerb.
        let count = (length_m / 4.0).ceil() as usize;
        let place = |s: f64| {
            let near = (1.0 - ((s - length_m / 2.0).abs() - 2.0).max(0.0) / 8.0).clamp(0.0, 1.0);
            beside(axis, s, sign * (halves_m[side] + behind_m - road.parking_m * near))
        };
        let half = |from: f64, to: f64| -> Vec<Vec2> {
            (0..=count).map(|k| place(from + (to - from) * k as f64 / count as f64)).collect()
        };
        let first = draft.sidewalk(half(0.0, length_m / 2.0), road.sidewalk_m, false);
        let last = draft.sidewalk(half(length_m / 2.0, length_m), road.sidewalk_m, false);
        draft.link(first, last);
    }
}
