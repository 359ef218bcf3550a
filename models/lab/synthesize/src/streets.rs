//! Networks of streets: one junction with its arms, a grid, an arterial, a car park.

use super::network::{Character, CrossSection, MPH, Network, Rank, hermite, left_of, unit};
use formats::polyline::{arc_lengths, length, part, point_at};
use scene::Vec2;
use scene::geometry::{direction, rotate};
use scene::random::Stream;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Draws a cross-section for a street of this rank.
pub fn section(draw: &mut Stream, rank: Rank) -> CrossSection {
    let yes = |draw: &mut Stream, p: f64, width: f64| if draw.chance(p) { width } else { 0.0 };
    match rank {
        Rank::Arterial => {
            let lanes = draw.one_of([2, 2, 3]);
            let bike = draw.between(1.5, 1.9);
            CrossSection {
                forward: lanes,
                backward: lanes,
                speed: draw.one_of([35.0, 35.0, 40.0, 45.0]) * MPH,
                lane: draw.between(3.2, 3.6),
                priority: 8,
                sidewalk: draw.between(1.8, 3.0),
                bike: yes(draw, 0.6, bike),
                parking: yes(draw, 0.25, 2.7),
                median: draw.between(3.3, 4.5),
                rank,
            }
        }
        Rank::Collector => {
            let bike = draw.between(1.4, 1.8);
            CrossSection {
                forward: 1,
                backward: 1,
                speed: draw.one_of([25.0, 30.0, 35.0]) * MPH,
                lane: draw.between(3.1, 3.6),
                priority: 4,
                sidewalk: draw.between(1.8, 2.6),
                bike: yes(draw, 0.65, bike),
                parking: yes(draw, 0.55, 2.6),
                median: yes(draw, 0.5, 3.3),
                rank,
            }
        }
        _ => CrossSection {
            forward: 1,
            backward: 1,
            speed: 25.0 * MPH,
            lane: draw.between(2.9, 3.6),
            priority: 2,
            sidewalk: draw.between(1.5, 2.2),
            bike: 0.0,
            parking: yes(draw, 0.8, 2.6),
            median: 0.0,
            rank,
        },
    }
}

/// A slightly curved street between two points.
fn bent(draw: &mut Stream, p: Vec2, q: Vec2, swing: f64) -> Vec<Vec2> {
    let way = unit(q - p);
    let mut lean = || unit(way + left_of(way) * draw.normal_about(0.0, swing).tan());
    let (a, b) = (lean(), lean());
    hermite(p, a, q, b)
}

const UNSIGNALLED: [&str; 3] = ["priority", "priority_stop", "allway_stop"];
const QUIET: [&str; 4] = ["priority", "priority_stop", "allway_stop", "right_before_left"];

fn control<const N: usize>(draw: &mut Stream, signals: f64, others: [&'static str; N]) -> &'static str {
    if draw.chance(signals) { "traffic_light" } else { draw.one_of(others) }
}

/// Signal settings that every template draws.
pub fn character(draw: &mut Stream, name: &str, reach: f64) -> Character {
    Character {
        name: name.to_owned(),
        actuated: draw.chance(0.75),
        opposites: draw.chance(0.67),
        cycle_s: 45 + draw.below(50) as u32,
        crosswalk: draw.between(3.0, 4.5),
        reach,
    }
}

/// One junction of 3 to 5 skewed and curved arms, with side streets half-way along the arms.
pub fn crossing(draw: &mut Stream) -> Network {
    let arms = draw.weighted([(3, 0.22), (4, 0.70), (5, 0.08)]);
    let main_rank =
        draw.weighted([(Rank::Arterial, 0.45), (Rank::Collector, 0.4), (Rank::Residential, 0.15)]);
    let side_rank = match main_rank {
        Rank::Arterial => draw.one_of([Rank::Arterial, Rank::Collector]),
        Rank::Collector => draw.one_of([Rank::Collector, Rank::Residential]),
        other => other,
    };
    let kind = match main_rank {
        Rank::Arterial => control(draw, 0.95, UNSIGNALLED),
        Rank::Collector => control(draw, 0.6, UNSIGNALLED),
        _ => control(draw, 0.05, QUIET),
    };
    let mut net = Network::new(character(draw, &format!("cross{arms}_{}", main_rank.name()), 140.0));
    net.node("c", Vec2::zeros(), kind, Some(draw.between(2.5, 7.5)));
    let skew = draw.normal_about(0.0, 0.18);
    let angles = match arms {
        3 => vec![0.0, PI, FRAC_PI_2 + draw.normal_about(0.0, 0.2)],
        4 => {
            let straight = [draw.normal_about(0.0, 0.06), draw.normal_about(0.0, 0.06)];
            vec![0.0, FRAC_PI_2 + skew, PI + straight[0], 1.5 * PI + skew + straight[1]]
        }
        _ => vec![0.0, 1.25, 2.5, 3.75, 5.0],
    };
    let base = draw.between(0.0, TAU);
    let (main, side) = (section(draw, main_rank), section(draw, side_rank));
    for (i, angle) in angles.into_iter().enumerate() {
        let is_main = if arms == 4 { i % 2 == 0 } else { i < 2 };
        arm(draw, &mut net, i, base + angle, if is_main { main } else { side });
    }
    net
}

fn arm(draw: &mut Stream, net: &mut Network, i: usize, angle: f64, section_: CrossSection) {
    let (way, across) = (direction(angle), left_of(direction(angle)));
    let drift = if section_.rank == Rank::Arterial { 12.0 } else { 27.0 };
    let end = way * draw.between(230.0, 340.0) + across * draw.normal_about(0.0, drift);
    let line = hermite(Vec2::zeros(), way, end, unit(way + across * draw.normal_about(0.0, 0.4)));
    let turn = section_.median > 3.0 && draw.chance(0.85);
    let fringe = format!("f{i}");
    net.end(&fringe, end);
    if !draw.chance(0.6) {
        net.road("c", &fringe, line, section_, (turn, false));
        return;
    }
    let (total, lengths, at) = (length(&line), arc_lengths(&line), draw.between(95.0, 150.0));
    let place = point_at(&line, &lengths, at);
    let along = unit(point_at(&line, &lengths, at + 1.0) - place);
    let middle = format!("s{i}");
    net.node(
        &middle,
        place,
        if draw.chance(0.6) { "priority" } else { "priority_stop" },
        Some(draw.between(3.0, 6.0)),
    );
    net.road("c", &middle, part(&line, 0.0, at), section_, (turn, false));
    net.road(&middle, &fringe, part(&line, at, total), section_, (false, false));
    let sides: &[f64] = if draw.chance(0.3) { &[1.0, -1.0] } else { &[draw.one_of([1.0, -1.0])] };
    for (k, side) in sides.iter().enumerate() {
        let street = section(draw, Rank::Residential);
        let out = unit(left_of(along) * *side + along * draw.normal_about(0.0, 0.15));
        let end = place + out * draw.between(80.0, 120.0);
        let id = format!("g{i}_{k}");
        net.end(&id, end);
        let line = bent(draw, place, end, 0.12);
        net.road(&middle, &id, line, street, (false, false));
    }
}

/// Land use of a street grid.
#[derive(Clone, Copy, PartialEq)]
enum District {
    /// Residential streets.
    Homes,
    /// A town centre with one-way streets.
    Centre,
    /// A district of a town: crossing arterials among residential streets.
    Quarter,
}

impl District {
    fn name(self) -> &'static str {
        match self {
            Self::Homes => "grid_residential",
            Self::Centre => "grid_downtown",
            Self::Quarter => "quarter",
        }
    }

    /// Number of streets per direction: the least number, and the number of possible values from it on.
    fn size(self) -> (i32, usize) {
        if self == Self::Quarter { (5, 2) } else { (3, 2) }
    }

    /// Ranges of the spacing of streets, metres.
    fn pitch(self) -> [(f64, f64); 2] {
        if self == Self::Quarter { [(100.0, 150.0); 2] } else { [(75.0, 120.0), (70.0, 120.0)] }
    }

    /// Section of the streets of one direction; the first direction is the busier one.
    fn street(self, draw: &mut Stream, first: bool, main: bool) -> CrossSection {
        if main && self == Self::Quarter {
            let arterial = section(draw, Rank::Arterial);
            return CrossSection { median: arterial.median.max(arterial.lane), ..arterial };
        }
        let busy = match (self, first) {
            (Self::Homes, true) | (Self::Quarter, _) => 0.3,
            (Self::Homes, false) => 0.0,
            (Self::Centre, true) => 1.0,
            (Self::Centre, false) => 0.7,
        };
        let rank = if draw.chance(busy) { Rank::Collector } else { Rank::Residential };
        CrossSection { median: 0.0, ..section(draw, rank) }
    }

    fn control(self, draw: &mut Stream, a: Rank, b: Rank) -> &'static str {
        let arterials = [a, b].into_iter().filter(|r| *r == Rank::Arterial).count();
        let collector = a == Rank::Collector || b == Rank::Collector;
        match (self, arterials, collector) {
            (_, 2, _) => control(draw, 0.97, ["priority_stop"]),
            (_, 1, true) => control(draw, 0.8, ["priority_stop"]),
            (_, 1, false) => control(draw, 0.3, ["priority_stop"]),
            (Self::Centre, ..) => control(draw, 0.75, QUIET),
            (_, _, true) => control(draw, 0.25, QUIET),
            _ => control(draw, 0.0, QUIET),
        }
    }
}

/// A distorted street grid of a residential area, or a grid of a town centre with one-way streets.
pub fn grid(draw: &mut Stream) -> Network {
    let district = if draw.chance(0.45) { District::Centre } else { District::Homes };
    blocks(draw, district, 150.0)
}

/// A district of a town, 600 to 900 m wide: traffic enters far away and has spread out in the recorded area.
pub fn quarter(draw: &mut Stream) -> Network {
    blocks(draw, District::Quarter, 260.0)
}

fn blocks(draw: &mut Stream, district: District, reach_m: f64) -> Network {
    let centre = district == District::Centre;
    let mut net = Network::new(character(draw, district.name(), reach_m));
    let (least, more) = district.size();
    let size = [least + draw.below(more) as i32, least + draw.below(more) as i32];
    let pitch = district.pitch().map(|(low, high)| draw.between(low, high));
    let turn = draw.between(0.0, TAU);
    let phase = [draw.between(0.0, TAU), draw.between(0.0, TAU)];
    let warp = if centre { 0.0 } else { draw.between(0.0, 12.0) };
    // Index of the arterial in each direction, away from the edge of the district.
    let mains = size.map(|n| 1 + draw.below(n as usize - 2) as i32);
    let mut streets =
        |axis: usize| (0..size[axis]).map(|i| district.street(draw, axis == 0, i == mains[axis])).collect();
    let (columns, rows): (Vec<CrossSection>, Vec<CrossSection>) = (streets(0), streets(1));
    let one_way: Vec<bool> = (0..size[0]).map(|_| centre && draw.chance(0.35)).collect();
    let name = |i: i32, j: i32| format!("n{}_{}", i + 1, j + 1);
    for i in -1..=size[0] {
        for j in -1..=size[1] {
            let (in_x, in_y) = ((0..size[0]).contains(&i), (0..size[1]).contains(&j));
            if !in_x && !in_y {
                continue;
            }
            let flat = Vec2::new(
                (f64::from(i) - f64::from(size[0] - 1) / 2.0) * pitch[0],
                (f64::from(j) - f64::from(size[1] - 1) / 2.0) * pitch[1],
            );
            let wave = Vec2::new((flat.y / 60.0 + phase[0]).sin(), (flat.x / 60.0 + phase[1]).sin());
            let place = rotate(flat + wave * warp + Vec2::from(draw.normal_pair()) * 2.5, turn);
            if in_x && in_y {
                let kind = district.control(draw, columns[i as usize].rank, rows[j as usize].rank);
                net.node(&name(i, j), place, kind, Some(draw.between(3.0, 7.0)));
            } else {
                net.end(&name(i, j), place);
            }
        }
    }
    let missing = if centre { 0.04 } else { 0.12 };
    let swing = if centre { 0.01 } else { 0.1 };
    for (count, other, down) in [(size[0], size[1], true), (size[1], size[0], false)] {
        for line in 0..count {
            let street = if down { columns[line as usize] } else { rows[line as usize] };
            let main = street.rank == Rank::Arterial;
            for k in -1..other {
                if !main && (0..other - 1).contains(&k) && draw.chance(missing) {
                    continue;
                }
                let (a, b) = if down {
                    (name(line, k), name(line, k + 1))
                } else {
                    (name(k, line), name(k + 1, line))
                };
                let mut s = street;
                if down && one_way[line as usize] {
                    (s.forward, s.backward) = if line % 2 == 0 { (2, 0) } else { (0, 2) };
                }
                let line = bent(draw, net.position(&a), net.position(&b), swing);
                let turn_lanes = (main && k >= 0, main && k + 1 < other);
                net.road(&a, &b, line, s, turn_lanes);
            }
        }
    }
    net
}

/// An arterial with signalised junctions, side streets and sometimes a car park.
pub fn arterial(draw: &mut Stream) -> Network {
    let mut net = Network::new(character(draw, "arterial", 180.0));
    let mut main = section(draw, Rank::Arterial);
    main.median = main.median.max(main.lane);
    let (turn, wave, phase) = (draw.between(0.0, TAU), draw.between(0.0, 30.0), draw.between(0.0, TAU));
    let place = |x: f64| rotate(Vec2::new(x, wave * (x / 110.0 + phase).sin()), turn);
    let mut xs = vec![-360.0];
    let mut x = -200.0 + draw.between(-20.0, 20.0);
    while x < 225.0 {
        xs.push(x);
        x += draw.between(100.0, 260.0);
    }
    xs.push(370.0);
    let last = xs.len() - 1;
    let name = |k: usize| format!("a{k}");
    for (k, &x) in xs.iter().enumerate() {
        if k == 0 || k == last {
            net.end(&name(k), place(x));
        } else {
            let kind = control(draw, 0.6, ["priority_stop"]);
            net.node(&name(k), place(x), kind, Some(draw.between(5.0, 10.0)));
        }
    }
    let mut lots = 0;
    for k in 0..last {
        let line = (0..24).map(|i| place(xs[k] + (xs[k + 1] - xs[k]) * f64::from(i) / 23.0)).collect();
        net.road(&name(k), &name(k + 1), line, main, (k > 0, k + 1 < last));
        if k == 0 {
            continue;
        }
        let here = place(xs[k]);
        let across = left_of(unit(place(xs[k] + 1.0) - here));
        for side in [1.0, -1.0] {
            let choice = draw.unit();
            if choice < 0.15 {
                continue;
            }
            if choice < 0.35 && lots == 0 {
                lots += 1;
                lot_branch(draw, &mut net, &name(k), across * side);
                continue;
            }
            let rank = if draw.chance(0.5) { Rank::Collector } else { Rank::Residential };
            let street = section(draw, rank);
            let out = unit(across * side + left_of(across) * draw.normal_about(0.0, 0.1));
            let end = here + out * draw.between(120.0, 170.0);
            let id = format!("b{k}_{}", if side > 0.0 { "l" } else { "r" });
            net.end(&id, end);
            net.road(&name(k), &id, hermite(here, out, end, out), street, (street.median > 3.0, false));
        }
    }
    net
}

/// A car park behind a junction: an entry, then aisles with perpendicular bays on both sides.
fn lot_branch(draw: &mut Stream, net: &mut Network, at: &str, way: Vec2) {
    let (origin, across) = (net.position(at), left_of(way));
    let aisle = CrossSection {
        forward: 1,
        backward: 1,
        speed: 10.0 * MPH,
        lane: 3.2,
        priority: 1,
        sidewalk: 0.0,
        bike: 0.0,
        parking: 0.0,
        median: 0.0,
        rank: Rank::Lot,
    };
    let (pitch, half, count) = (17.5, draw.between(35.0, 60.0), 1 + draw.below(3));
    let mut previous = at.to_owned();
    for k in 0..count {
        let base = origin + way * (38.0 + pitch * k as f64);
        let id = format!("l{k}_{at}");
        net.node(&id, base, "priority", Some(if k == 0 { 4.0 } else { 3.0 }));
        net.straight(&previous, &id, CrossSection { speed: if k == 0 { 15.0 } else { 10.0 } * MPH, ..aisle });
        for (name, side) in [("l", 1.0), ("r", -1.0)] {
            let end = base + across * (side * half);
            let end_id = format!("{id}_{name}");
            net.end(&end_id, end);
            net.straight(&id, &end_id, aisle);
            for row in [1.0, -1.0] {
                let shift = way * (row * 6.0);
                let line = vec![base + across * (side * 8.0) + shift, end + shift];
                let nose = way * row;
                net.stalls.push((line, nose.y.atan2(nose.x)));
            }
        }
        previous = id;
    }
    let (near, far) = (38.0 - 9.0, 38.0 + pitch * (count - 1) as f64 + 9.0);
    let corner = |along: f64, side: f64| origin + way * along + across * (side * (half + 3.0));
    net.paved.push(vec![corner(near, 1.0), corner(near, -1.0), corner(far, -1.0), corner(far, 1.0)]);
}

/// A street with the entry of a car park.
pub fn parking_lot(draw: &mut Stream) -> Network {
    let mut net = Network::new(character(draw, "lot", 130.0));
    let main = section(draw, Rank::Collector);
    let (west, east) =
        (Vec2::new(-220.0, draw.normal_about(0.0, 30.0)), Vec2::new(220.0, draw.normal_about(0.0, 30.0)));
    net.end("w", west);
    net.end("e", east);
    let kind = control(draw, 0.25, ["priority", "priority_stop"]);
    net.node("c", Vec2::zeros(), kind, Some(6.0));
    let turn = main.median > 3.0;
    let x = Vec2::new(1.0, 0.0);
    net.road("w", "c", hermite(west, x, Vec2::zeros(), x), main, (false, turn));
    net.road("c", "e", hermite(Vec2::zeros(), x, east, unit(Vec2::new(1.0, 0.1))), main, (turn, false));
    lot_branch(draw, &mut net, "c", Vec2::new(0.0, 1.0));
    if draw.chance(0.6) {
        let street = section(draw, Rank::Residential);
        let south = Vec2::new(draw.normal_about(0.0, 20.0), -150.0);
        net.end("s", south);
        let down = Vec2::new(0.0, -1.0);
        net.road("c", "s", hermite(Vec2::zeros(), down, south, down), street, (false, false));
    }
    net
}
