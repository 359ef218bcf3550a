//! Roads that meet at a ring, which is driven counter-clockwise and has the right of way.

use crate::curve::{Pose, arc, join, left_of, parallel, straight, tidy};
use crate::draft::{CornerPlace, MapDraft, place};
use crate::junction::{Spoke, between, crosswalks, finish, open, spokes};
use crate::parameters::Roundabout;
use crate::roadway::{Plan, Roadway};
use scene::Vec2;
use scene::map::LaneType;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Greatest angle between the arm's middle and the point where an entry or exit meets the ring, radians.
/// Below it, that angle's greatest share of the angle to the next arm.
const ENTRY_RAD: f64 = 0.72;
const ENTRY_SHARE: f64 = 0.46;
/// Smallest radius of a kerb, metres.
const LEAST_KERB_M: f64 = 0.5;
/// Length over which the directions of an arm diverge, and length of the raised median there, metres.
const FLARE_M: f64 = 26.0;
const RAISED_M: f64 = 14.0;
/// Least length of every arm beyond the ring, metres.
const LEAST_ROAD_M: f64 = 45.0;

/// A kerb from arm to arm: where it touches the arms (metres from the middle) and the ring (angles).
struct Corner {
    radius_m: f64,
    arms: [usize; 2],
    at_m: [f64; 2],
    on_ring: [f64; 2],
}

struct Ring {
    /// Radii of the centre lines of the lanes, from the island outwards.
    lanes_m: Vec<f64>,
    inner_m: f64,
    outer_m: f64,
    width_m: f64,
    limit_kmh: f64,
}

pub fn draw(layout: &Roundabout) -> MapDraft {
    let (mut spokes, order) = spokes(&layout.arms, layout.lane_width_m, layout.traffic);
    let ring = ring(layout, &spokes);
    let corners = corners(&mut spokes, &ring, layout.kerb_radius_m);
    for spoke in &mut spokes {
        spoke.mouth_m += 0.4;
        let crosswalk = spoke.arm.crosswalk_m;
        spoke.stop_m = spoke.mouth_m + if crosswalk > 0.0 { crosswalk + 1.2 } else { 0.5 };
        spoke.end_m = spoke.arm.length_m.max(spoke.stop_m + LEAST_ROAD_M);
    }
    let mut draft = MapDraft::default();
    let plans: Vec<(Vec<Vec2>, Vec<f64>)> = spokes.iter().map(flare).collect();
    let roads: Vec<Roadway> = (0..spokes.len())
        .map(|k| {
            let id = format!("arm{}", order[k] + 1);
            let road = plan(&spokes[k], &plans[k], &id).draw(&mut draft);
            open(&mut draft, &road);
            road
        })
        .collect();
    kerbs(&mut draft, &spokes, &plans, &corners, &ring, &roads);
    lanes(&mut draft, &spokes, &roads, &ring, &order);
    paint(&mut draft, &spokes, &ring);
    crosswalks(&mut draft, &spokes);
    if layout.sidewalk_m > 0.0 {
        sidewalks(&mut draft, &spokes, &plans, &corners, &ring, layout.sidewalk_m);
    }
    let places: Vec<(CornerPlace, [usize; 2])> = corners
        .iter()
        .map(|corner| {
            let [a, _] = corner.arms;
            let at = fillet(&spokes[a], corner, 0, 0.0);
            let at = at[at.len() / 2];
            (CornerPlace { at_m: place(at), radius_m: corner.radius_m, arms: corner.arms }, corner.arms)
        })
        .collect();
    finish(&mut draft, &spokes, &roads, &order, &places);
    draft
}

/// The ring, with an island as large as the arms need.
fn ring(layout: &Roundabout, spokes: &[Spoke]) -> Ring {
    let count = f64::from(layout.ring_lanes);
    let width_m = layout.ring_lane_width_m;
    let fits = |outer_m: f64| {
        (0..spokes.len()).all(|a| {
            let b = (a + 1) % spokes.len();
            let share = |m: f64| (m / outer_m).min(1.0).asin();
            let taken = share(spokes[a].kerbs_m()[0] + 1.0) + share(spokes[b].kerbs_m()[1] + 1.0);
            taken < 0.9 * between(&spokes[a], &spokes[b])
        })
    };
    let mut inner_m = layout.island_radius_m;
    while !fits(inner_m + count * width_m) && inner_m < 300.0 {
        inner_m += 1.0;
    }
    Ring {
        lanes_m: (0..layout.ring_lanes).map(|i| inner_m + (f64::from(i) + 0.5) * width_m).collect(),
        inner_m,
        outer_m: inner_m + count * width_m,
        width_m,
        limit_kmh: layout.ring_speed_limit_kmh,
    }
}

/// The points where kerbs leave the arms, which are the beginnings of the arms.
fn corners(spokes: &mut [Spoke], ring: &Ring, radius_m: f64) -> Vec<Corner> {
    (0..spokes.len())
        .map(|a| {
            let b = (a + 1) % spokes.len();
            let angle = between(&spokes[a], &spokes[b]);
            let aside = [spokes[a].kerbs_m()[0], spokes[b].kerbs_m()[1]];
            let mut radius_m = radius_m;
            loop {
                let out =
                    |m: f64| ((ring.outer_m + radius_m).powi(2) - (m + radius_m).powi(2)).max(1.0).sqrt();
                let at_m = aside.map(out);
                let on = |i: usize| (aside[i] + radius_m).atan2(at_m[i]);
                let room = angle - on(0) - on(1);
                if room > 0.01 || radius_m <= LEAST_KERB_M {
                    spokes[a].mouth_m = spokes[a].mouth_m.max(at_m[0]);
                    spokes[b].mouth_m = spokes[b].mouth_m.max(at_m[1]);
                    let start = spokes[a].arm.angle_deg.to_radians();
                    let on_ring = [start + on(0), start + angle - on(1).min(angle - on(0))];
                    return Corner { radius_m, arms: [a, b], at_m, on_ring };
                }
                radius_m *= 0.85;
            }
        })
        .collect()
}

/// An arm's axis, and its median, which widens towards the ring.
fn flare(spoke: &Spoke) -> (Vec<Vec2>, Vec<f64>) {
    let near = (FLARE_M / 2.0) as usize;
    let mut axis: Vec<Vec2> = (0..near).map(|i| spoke.at(spoke.stop_m + 2.0 * i as f64, 0.0)).collect();
    axis.extend(straight(spoke.at(spoke.stop_m + FLARE_M, 0.0), spoke.at(spoke.end_m, 0.0)));
    let median = |p: &Vec2| {
        let share = ((p.dot(&spoke.way) - spoke.stop_m) / FLARE_M).clamp(0.0, 1.0);
        spoke.arm.median_m * (1.0 - share * share * (3.0 - 2.0 * share))
    };
    let median_m = axis.iter().map(median).collect();
    (axis, median_m)
}

fn plan<'a>(spoke: &'a Spoke, (axis, median_m): &'a (Vec<Vec2>, Vec<f64>), id: &'a str) -> Plan<'a> {
    Plan { id, profile: &spoke.profile, axis, median_m, raised_m: RAISED_M, stops: [true, false] }
}

/// The line from the arm (0: its left kerb, inwards; 1: its right kerb, outwards) to the ring, at this
/// distance behind the kerb.
fn fillet(spoke: &Spoke, corner: &Corner, side: usize, behind_m: f64) -> Vec<Vec2> {
    let sign = if side == 0 { 1.0 } else { -1.0 };
    let aside_m = spoke.kerbs_m()[side] + corner.radius_m;
    let centre = spoke.at(corner.at_m[side], sign * aside_m);
    let radius_m = (corner.radius_m - behind_m).max(0.2);
    let heading = spoke.arm.angle_deg.to_radians();
    // From beside the arm to the ring.
    let by = FRAC_PI_2 - aside_m.atan2(corner.at_m[side]);
    let from = heading - sign * FRAC_PI_2;
    let line = arc(centre, radius_m, from, from - sign * by);
    if side == 0 { line } else { line.into_iter().rev().collect() }
}

/// A kerb from edge to edge of the map at this distance behind, between two distances from the middle on its
/// arms.
fn kerb(
    spokes: &[Spoke],
    plans: &[(Vec<Vec2>, Vec<f64>)],
    corner: &Corner,
    ring: &Ring,
    behind_m: f64,
) -> [Vec<Vec2>; 3] {
    let [a, b] = corner.arms;
    let along = |k: usize, side: usize| {
        let line = plan(&spokes[k], &plans[k], "").kerb(side);
        parallel(&line, if side == 1 { behind_m } else { -behind_m })
    };
    let mut first = along(a, 1);
    first.reverse();
    let mut round = fillet(&spokes[a], corner, 0, behind_m);
    let [from, to] = corner.on_ring;
    if to > from {
        round.extend(arc(Vec2::zeros(), ring.outer_m + behind_m, from, to));
    }
    round.extend(fillet(&spokes[b], corner, 1, behind_m));
    [first, round, along(b, 0)]
}

fn kerbs(
    draft: &mut MapDraft,
    spokes: &[Spoke],
    plans: &[(Vec<Vec2>, Vec<f64>)],
    corners: &[Corner],
    ring: &Ring,
    roads: &[Roadway],
) {
    let mut ground = Vec::new();
    for corner in corners {
        let line = tidy(kerb(spokes, plans, corner, ring, 0.0).concat());
        let edge = draft.edge("boundary", line.clone());
        let [a, b] = corner.arms;
        let beside = [roads[a].left.all().last().copied(), roads[b].right.all().last().copied()];
        beside.into_iter().flatten().for_each(|lane| draft.bound(lane, false, &edge));
        ground.extend(line);
    }
    // The directions are separated between crosswalk and ring too.
    for spoke in spokes {
        let half_m = spoke.profile.middle_m(spoke.arm.median_m) / 2.0 - 0.2;
        let (near, far) = (ring.outer_m + 1.0, spoke.mouth_m - 0.4);
        if half_m > 0.3 && far - near > 2.0 * half_m + 0.5 {
            let heading = spoke.arm.angle_deg.to_radians();
            let mut rim = arc(spoke.at(far - half_m, 0.0), half_m, heading - FRAC_PI_2, heading + FRAC_PI_2);
            rim.push(spoke.at(near, half_m));
            rim.push(spoke.at(near, -half_m));
            draft.island(rim);
        }
    }
    let mut circle = arc(Vec2::zeros(), ring.inner_m, 0.0, TAU);
    circle.pop();
    draft.island(circle);
    let islands = std::mem::take(&mut draft.islands);
    draft.ground(tidy(ground), islands);
}

/// The ring's lanes and the ways in and out.
fn lanes(draft: &mut MapDraft, spokes: &[Spoke], roads: &[Roadway], ring: &Ring, order: &[usize]) {
    let count = spokes.len();
    let angle = |k: usize| spokes[k].arm.angle_deg.to_radians();
    let share = |k: usize| (ENTRY_SHARE * between(&spokes[k], &spokes[(k + 1) % count])).min(ENTRY_RAD);
    // Lanes past an arm, and on to the next one, by arm and lane of the ring.
    let (mut past, mut on): (Vec<Vec<usize>>, Vec<Vec<usize>>) = (Vec::new(), Vec::new());
    for k in 0..count {
        let before = (k + count - 1) % count;
        let from = angle(k) - share(before);
        let entry = angle(k) + share(k);
        let next = angle(k) + between(&spokes[k], &spokes[(k + 1) % count]) - share(k);
        for (word, range, list) in [("past", [from, entry], &mut past), ("on", [entry, next], &mut on)] {
            let mut lanes: Vec<usize> = Vec::new();
            for (i, radius_m) in ring.lanes_m.iter().enumerate() {
                let id = format!("ring{}.{word}{}", i + 1, order[k] + 1);
                let line = arc(Vec2::zeros(), *radius_m, range[0], range[1]);
                lanes.push(draft.lane(id, LaneType::SurfaceStreet, line, ring.width_m, ring.limit_kmh));
            }
            for pair in lanes.windows(2) {
                // Counter-clockwise, the island is on the left.
                draft.beside(pair[0], pair[1]);
            }
            list.push(lanes);
        }
    }
    for k in 0..count {
        let before = (k + count - 1) % count;
        for i in 0..ring.lanes_m.len() {
            draft.link(past[k][i], on[k][i]);
            draft.link(on[before][i], past[k][i]);
        }
        let outer = ring.lanes_m.len() - 1;
        let ins = &roads[k].left.lanes;
        for (i, lane) in ins.iter().enumerate() {
            let ring_lane = outer.saturating_sub(ins.len() - 1 - i);
            connect(draft, *lane, on[k][ring_lane], LaneType::SurfaceStreet);
        }
        let outs = &roads[k].right.lanes;
        for (i, lane) in outs.iter().enumerate() {
            let ring_lane = outer.saturating_sub(outs.len() - 1 - i);
            connect(draft, on[before][ring_lane], *lane, LaneType::SurfaceStreet);
        }
        if let Some(cycle) = roads[k].left.cycle {
            connect(draft, cycle, on[k][outer], LaneType::BikeLane);
        }
        if let Some(cycle) = roads[k].right.cycle {
            connect(draft, on[before][outer], cycle, LaneType::BikeLane);
        }
    }
}

fn connect(draft: &mut MapDraft, from: usize, to: usize, lane_type: LaneType) {
    // Lanes of the ring are polylines: their true direction is perpendicular to the radius.
    let on_ring = |pose: Pose| Pose { heading_rad: pose.at.y.atan2(pose.at.x) + FRAC_PI_2, ..pose };
    let ring = |draft: &MapDraft, lane: usize| draft.map.lanes[lane].id.starts_with("ring");
    let (mut a, mut b) = (draft.end(from), draft.start(to));
    if ring(draft, from) {
        a = on_ring(a);
    }
    if ring(draft, to) {
        b = on_ring(b);
    }
    let line = join(a, b, 40.0);
    draft.through(from, to, line, lane_type);
}

fn paint(draft: &mut MapDraft, spokes: &[Spoke], ring: &Ring) {
    for radius_m in ring.lanes_m.iter().skip(1).map(|m| m - ring.width_m / 2.0) {
        draft.line("broken_single_white", arc(Vec2::zeros(), radius_m, 0.0, TAU));
    }
    // Entering traffic yields.
    for spoke in spokes.iter().filter(|spoke| spoke.arm.lanes_in > 0) {
        let heading = spoke.arm.angle_deg.to_radians();
        let on = |m: f64| (m / ring.outer_m).clamp(-1.0, 1.0).asin();
        let middle_m = spoke.profile.middle_m(spoke.arm.median_m) / 2.0;
        let to = heading + on(spoke.kerbs_m()[0] + 1.0);
        draft.line("broken_single_white", arc(Vec2::zeros(), ring.outer_m, heading + on(middle_m), to));
    }
}

fn sidewalks(
    draft: &mut MapDraft,
    spokes: &[Spoke],
    plans: &[(Vec<Vec2>, Vec<f64>)],
    corners: &[Corner],
    ring: &Ring,
    width_m: f64,
) {
    let behind_m = width_m / 2.0 + 0.2;
    for corner in corners {
        let [first, round, last] = kerb(spokes, plans, corner, ring, behind_m);
        let [a, b] = corner.arms.map(|k| &spokes[k]);
        // Crosswalks lie just before the beginning of the arm.
        let cross_m = |spoke: &Spoke| spoke.mouth_m + spoke.arm.crosswalk_m / 2.0;
        let at = |spoke: &Spoke, from: Vec2| {
            let left_m = from.dot(&left_of(spoke.way));
            spoke.at(cross_m(spoke), left_m)
        };
        let (Some(inner), Some(outer)) = (first.last().copied(), last.first().copied()) else { continue };
        let (from, to) = (at(a, inner), at(b, outer));
        let mut first = first;
        first.push(from);
        let mut middle = vec![from];
        middle.extend(round);
        middle.push(to);
        let mut rest = vec![to];
        rest.extend(last);
        let lanes = [
            draft.sidewalk(first, width_m, false),
            draft.sidewalk(middle, width_m, true),
            draft.sidewalk(rest, width_m, false),
        ];
        draft.link(lanes[0], lanes[1]);
        draft.link(lanes[1], lanes[2]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::geometry::direction;

    #[test]
    fn kerbs_touch_the_ring() {
        let (mut spokes, _) = spokes(&Roundabout::default().arms, 3.25, crate::Traffic::RightHand);
        let ring = ring(&Roundabout::default(), &spokes);
        let corners = corners(&mut spokes, &ring, 10.0);
        let line = fillet(&spokes[0], &corners[0], 0, 0.0);
        let last = line[line.len() - 1];
        assert!((last.norm() - ring.outer_m).abs() < 1e-6, "{last:?}");
        assert!((last - direction(corners[0].on_ring[0]) * ring.outer_m).norm() < 1e-6);
        assert!((line[0].y - spokes[0].kerbs_m()[0]).abs() < 1e-6);
    }
}
