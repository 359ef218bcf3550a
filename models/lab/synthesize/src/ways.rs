//! Networks of directed edges: roundabouts, and motorways with ramps.

use super::network::{CrossSection, MPH, Network, Rank, hermite, left_of, unit};
use super::streets::{character, section};
use formats::polyline::{arc_lengths, length, offset_right, part, point_at};
use scene::Vec2;
use scene::geometry::{direction, rotate};
use scene::random::Stream;
use std::f64::consts::TAU;

/// Half the arc of the ring between the entry and the exit of an arm, metres.
const HALF_MOUTH_M: f64 = 7.5;

/// A roundabout of three or four arms, with one or two lanes.
pub fn roundabout(draw: &mut Stream) -> Network {
    let arms = draw.one_of([3, 4, 4]);
    let radius = draw.between(13.0, 22.0);
    let lanes = if radius < 18.0 || draw.chance(0.6) { 1 } else { 2 };
    let mut net = Network::new(character(draw, &format!("roundabout{arms}"), 130.0));
    let base = draw.between(0.0, TAU);
    let angles: Vec<f64> =
        (0..arms).map(|i| base + TAU * i as f64 / arms as f64 + draw.normal_about(0.0, 0.1)).collect();
    let main = section(draw, Rank::Collector);
    let side_rank = if draw.chance(0.4) { Rank::Residential } else { Rank::Collector };
    let side = section(draw, side_rank);
    let bare = |s: CrossSection| CrossSection { parking: 0.0, bike: 0.0, median: 1.2, ..s };
    ring(&mut net, &angles, radius, lanes, 0.0);
    for (i, &angle) in angles.iter().enumerate() {
        let s = bare(if i % 2 == 0 { main } else { side });
        let (reach, lean, bend) =
            (draw.between(180.0, 270.0), draw.normal_about(0.0, 18.0), draw.normal_about(0.0, 0.2));
        let arm = Arm { angle, section: s, sidewalk: 0.0, street: [reach, lean, bend] };
        approach(&mut net, i, arm, radius, lanes);
    }
    net
}

/// The ring: counter-clockwise arcs between the entries of the arms, with a sidewalk of this width outside
/// (zero: none).
pub fn ring(net: &mut Network, angles: &[f64], radius: f64, lanes: usize, sidewalk: f64) {
    let half = HALF_MOUTH_M / radius;
    let mut mouths: Vec<(f64, String)> = Vec::new();
    for (i, &angle) in angles.iter().enumerate() {
        mouths.push((angle - half, format!("rx{i}")));
        mouths.push((angle + half, format!("ri{i}")));
    }
    for (angle, id) in &mouths {
        net.node(id, direction(*angle) * radius, "priority", Some(4.0));
    }
    mouths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let s = CrossSection {
        forward: lanes,
        backward: 0,
        speed: if radius < 17.0 { 15.0 } else { 20.0 } * MPH,
        lane: if lanes == 1 { 4.2 } else { 3.7 },
        priority: 9,
        sidewalk: 0.0,
        bike: 0.0,
        parking: 0.0,
        median: 0.0,
        rank: Rank::Roundabout,
    };
    let mut edges = Vec::new();
    for (k, (from, id)) in mouths.iter().enumerate() {
        let (to, next) = &mouths[(k + 1) % mouths.len()];
        let span = (to - from).rem_euclid(TAU);
        let n = ((span * radius / 1.5) as usize).max(2);
        let arc = (0..=n).map(|i| direction(from + span * i as f64 / n as f64) * radius).collect();
        let edge = format!("ring{k}");
        // There is no sidewalk across the entry of an arm.
        let walk = if id.starts_with("ri") { sidewalk } else { 0.0 };
        net.edge(&edge, [id, next], arc, lanes, CrossSection { sidewalk: walk, ..s }, false);
        edges.push(edge);
    }
    net.roundabout(mouths.into_iter().map(|m| m.1).collect(), edges);
}

/// An arm of a roundabout.
#[derive(Clone, Copy, Debug)]
pub struct Arm {
    /// Direction from the middle of the ring, radians.
    pub angle: f64,
    /// Cross-section of the street.
    pub section: CrossSection,
    /// Width of the sidewalk along entry and exit, metres.
    pub sidewalk: f64,
    /// Length, lateral offset of the end, and bend of the street.
    pub street: [f64; 3],
}

/// Arm `i` of a ring with this radius and number of lanes: a street up to a splitter node with a crosswalk, then a
/// separate entry and exit.
pub fn approach(net: &mut Network, i: usize, arm: Arm, radius: f64, lanes: usize) {
    let Arm { angle, section: s, sidewalk, street: shape } = arm;
    let (way, across) = (direction(angle), left_of(direction(angle)));
    let ring_lane = if lanes == 1 { 4.2 } else { 3.7 };
    let near = way * (radius + ring_lane * lanes as f64 + 22.0);
    let end = near + way * shape[0] + across * shape[1];
    let (splitter, fringe) = (format!("s{i}"), format!("f{i}"));
    net.node(&splitter, near, "priority", Some(3.0));
    net.end(&fringe, end);
    net.road(&splitter, &fringe, hermite(near, way, end, unit(way + across * shape[2])), s, (false, false));
    let half = HALF_MOUTH_M / radius;
    let (entry, exit) = (format!("ri{i}"), format!("rx{i}"));
    let tangent = |a: f64| left_of(direction(a));
    let inward = unit(tangent(angle + half) * 0.8 - way * 0.75);
    let outward = unit(tangent(angle - half) * 0.8 + way * 0.75);
    let gap = across * (s.median / 2.0);
    let lead_in = hermite(near + gap, -way, net.position(&entry), inward);
    let lead_out = hermite(net.position(&exit), outward, near - gap, way);
    let slow = CrossSection { speed: 20.0 * MPH, priority: 3, sidewalk, rank: Rank::Collector, ..s };
    net.edge(&format!("in{i}"), [&splitter, &entry], lead_in, s.forward, slow, false);
    net.edge(&format!("out{i}"), [&exit, &splitter], lead_out, s.backward, slow, false);
}

/// Parameters of a motorway template.
#[derive(Clone, Copy, Debug)]
pub struct MotorwayShape {
    /// Lanes of the through road.
    pub lanes: usize,
    /// Speed limit, m/s.
    pub speed: f64,
    /// Width between the directions, metres.
    pub median: f64,
    /// Whether the first junction is an entry and the second an exit; otherwise the reverse.
    pub entry_first: bool,
}

/// A curved motorway with an entry and an exit in each direction.
pub fn motorway(draw: &mut Stream) -> Network {
    let mut net = Network::new(character(draw, "motorway", 330.0));
    let shape = MotorwayShape {
        lanes: draw.one_of([2, 3, 3]),
        speed: draw.one_of([55.0, 60.0, 65.0]) * MPH,
        median: draw.between(2.0, 10.0),
        entry_first: draw.chance(0.5),
    };
    let (bow, turn) = (draw.normal_about(0.0, 90.0), draw.between(0.0, TAU));
    let line: Vec<Vec2> = (-200..=200)
        .map(|i| f64::from(i) * 3.0)
        .map(|x| rotate(Vec2::new(x, bow * (x / 360.0).cos()), turn))
        .collect();
    for back in [false, true] {
        let mut middle = line.clone();
        if back {
            middle.reverse();
        }
        let starts = [draw.between(310.0, 390.0), draw.between(690.0, 780.0)];
        let spans = [draw.between(180.0, 250.0), draw.between(150.0, 220.0)];
        let asides = [draw.between(20.0, 40.0), draw.between(20.0, 40.0)];
        carriageway(&mut net, &middle, if back { "b" } else { "f" }, shape, starts, spans, asides);
    }
    net
}

/// One direction: a through road, and two sections with an additional lane for an entry or exit ramp.
pub fn carriageway(
    net: &mut Network,
    middle: &[Vec2],
    name: &str,
    shape: MotorwayShape,
    starts: [f64; 2],
    spans: [f64; 2],
    asides: [f64; 2],
) {
    let border = offset_right(middle, shape.median / 2.0);
    let (total, lengths) = (length(&border), arc_lengths(&border));
    let cuts = [0.0, starts[0], starts[0] + spans[0], starts[1], starts[1] + spans[1], total];
    let node = |k: usize| format!("w{name}{k}");
    for (k, &cut) in cuts.iter().enumerate() {
        let place = point_at(&border, &lengths, cut);
        if k == 0 || k == 5 { net.end(&node(k), place) } else { net.node(&node(k), place, "priority", None) }
    }
    let lane = 3.6;
    let s = CrossSection {
        forward: shape.lanes,
        backward: 0,
        speed: shape.speed,
        lane,
        priority: 12,
        sidewalk: 0.0,
        bike: 0.0,
        parking: 0.0,
        median: 0.0,
        rank: Rank::Motorway,
    };
    let edge = |k: usize| format!("w{name}e{k}");
    // The ends of the shapes stay clear of the nodes: the lanes then shift over 36 m.
    let inset = |k: usize, end: f64| if k == 0 || k == 5 { 0.0 } else { end };
    for k in 0..5 {
        let piece = part(&border, cuts[k] + inset(k, 18.0), cuts[k + 1] - inset(k + 1, 18.0));
        let entry = (k == 1) == shape.entry_first && k % 2 == 1;
        net.edge(&edge(k), [&node(k), &node(k + 1)], piece, shape.lanes + k % 2, s, entry);
    }
    for (k, aside) in [(1, asides[0]), (3, asides[1])] {
        for i in 0..shape.lanes {
            net.connect(&edge(k - 1), i, &edge(k), i + 1);
            net.connect(&edge(k), i + 1, &edge(k + 1), i);
        }
        let entry = (k == 1) == shape.entry_first;
        let at = if entry { cuts[k] } else { cuts[k + 1] };
        let place = point_at(&border, &lengths, at);
        let way = unit(point_at(&border, &lengths, at + 1.0) - place);
        let right = -left_of(way);
        let mouth = place + right * (shape.lanes as f64 * lane);
        let far = mouth + way * if entry { -150.0 } else { 150.0 } + right * aside;
        let ramp = format!("ramp{name}{k}");
        net.end(&ramp, far);
        let slow = CrossSection { speed: if entry { 45.0 } else { 40.0 } * MPH, priority: 6, ..s };
        if entry {
            net.edge(
                &ramp,
                [&ramp, &node(k)],
                hermite(far, unit(way - right * 0.45), mouth, way),
                1,
                slow,
                false,
            );
            net.connect(&ramp, 0, &edge(k), 0);
        } else {
            net.connect(&edge(k - 1), 0, &edge(k), 0);
            net.edge(
                &ramp,
                [&node(k + 1), &ramp],
                hermite(mouth, way, far, unit(way + right * 0.45)),
                1,
                slow,
                false,
            );
            net.connect(&edge(k), 0, &ramp, 0);
        }
    }
}
