//! Manually designed networks of the demo scenes, which show the features of the editor.

use super::network::{Character, CrossSection, MPH, Network, Rank, hermite};
use super::random::Purpose;
use super::ways::{Arm, MotorwayShape, approach, carriageway, ring};
use formats::polyline::{arc_lengths, part, point_at};
use scene::Vec2;
use scene::geometry::direction;
use std::f64::consts::FRAC_PI_2;

fn character(name: &str, cycle_s: u32) -> Character {
    Character {
        name: name.to_owned(),
        actuated: false,
        opposites: true,
        cycle_s,
        crosswalk: 4.0,
        reach: 100.0,
    }
}

const MAIN: CrossSection = CrossSection {
    forward: 2,
    backward: 2,
    speed: 35.0 * MPH,
    lane: 3.4,
    priority: 8,
    sidewalk: 3.6,
    bike: 1.9,
    parking: 0.0,
    median: 3.4,
    rank: Rank::Arterial,
};

const SIDE: CrossSection = CrossSection {
    forward: 1,
    backward: 1,
    speed: 30.0 * MPH,
    lane: 3.4,
    priority: 4,
    sidewalk: 3.4,
    bike: 1.8,
    parking: 2.4,
    median: 3.4,
    rank: Rank::Collector,
};

const HOMES: CrossSection = CrossSection {
    forward: 1,
    backward: 1,
    speed: 25.0 * MPH,
    lane: 3.3,
    priority: 2,
    sidewalk: 2.4,
    bike: 0.0,
    parking: 2.3,
    median: 0.0,
    rank: Rank::Residential,
};

fn finished(mut net: Network) -> Network {
    net.expand(&mut Purpose::Network.stream(41));
    net
}

fn ray(
    net: &mut Network,
    from: &str,
    to: &str,
    angle_deg: f64,
    reach: f64,
    section: CrossSection,
    turn: bool,
) {
    let (start, way) = (net.position(from), direction(angle_deg.to_radians()));
    net.end(to, start + way * reach);
    net.road(from, to, vec![start, start + way * reach], section, (turn, false));
}

/// Signalised junction of an avenue and a street, with left-turn lanes, cycle lanes and parked cars.
pub fn crossing() -> Network {
    let mut net = Network::new(character("demo-crossing", 60));
    net.node("c", Vec2::zeros(), "traffic_light", Some(7.0));
    for (id, angle, section) in [("e", 3.0, MAIN), ("n", 94.0, SIDE), ("w", 183.0, MAIN), ("s", 273.0, SIDE)]
    {
        ray(&mut net, "c", id, angle, 230.0, section, true);
    }
    // A car park behind the south-eastern corner.
    let (x, y) = (direction(3.0_f64.to_radians()), direction(93.0_f64.to_radians()));
    let corner = |along: f64, up: f64| x * along + y * up;
    net.paved.push(vec![
        corner(38.0, -34.0),
        corner(38.0, -64.0),
        corner(104.0, -64.0),
        corner(104.0, -34.0),
    ]);
    net.paved.push(vec![corner(56.0, -12.0), corner(56.0, -34.5), corner(63.0, -34.5), corner(63.0, -12.0)]);
    for (up, nose) in [(-37.2, 93.0_f64), (-58.8, 273.0)] {
        net.stalls.push((vec![corner(66.0, up), corner(102.0, up)], nose.to_radians()));
    }
    finished(net)
}

/// Roundabout of four arms with sidewalks all round.
pub fn roundabout() -> Network {
    let mut net = Network::new(character("demo-roundabout", 60));
    let angles: Vec<f64> = [4.0_f64, 92.0, 181.0, 274.0].iter().map(|a| a.to_radians()).collect();
    ring(&mut net, &angles, 15.0, 1, 3.0);
    for (i, &angle) in angles.iter().enumerate() {
        let s =
            CrossSection { parking: 0.0, bike: 0.0, median: 1.6, speed: 25.0 * MPH, sidewalk: 3.0, ..SIDE };
        let bend = [0.10, -0.08, 0.06, 0.05][i];
        let arm = Arm { angle, section: s, sidewalk: 3.0, street: [170.0, 60.0 * bend, bend] };
        approach(&mut net, i, arm, 15.0, 1);
    }
    finished(net)
}

/// Entry of a motorway, with a parallel street for pedestrians and cyclists.
pub fn motorway() -> Network {
    let mut net = Network::new(character("demo-motorway", 60));
    let line: Vec<Vec2> = (-160..=160)
        .map(|i| f64::from(i) * 3.0)
        .map(|x| Vec2::new(x, 9.0 * (x / 330.0).cos() + 3.0))
        .collect();
    let shape = MotorwayShape { lanes: 3, speed: 60.0 * MPH, median: 5.0, entry_first: true };
    // The entry lane begins west of the origin and ends east of it.
    carriageway(&mut net, &line, "f", shape, [432.0, 800.0], [165.0, 120.0], [30.0, 30.0]);
    let back: Vec<Vec2> = line.iter().rev().copied().collect();
    let exit_first = MotorwayShape { entry_first: false, ..shape };
    carriageway(&mut net, &back, "b", exit_first, [350.0, 740.0], [180.0, 140.0], [34.0, 30.0]);
    let (west, east) = (Vec2::new(-230.0, -52.0), Vec2::new(230.0, -49.0));
    let street = CrossSection { parking: 0.0, median: 0.0, ..SIDE };
    net.end("p", west);
    net.end("q", east);
    let x = Vec2::new(1.0, 0.0);
    net.road("p", "q", hermite(west, x, east, x), street, (false, false));
    finished(net)
}

/// Residential street with parked cars and driveways, and two side streets.
pub fn residential() -> Network {
    let mut net = Network::new(character("demo-residential", 60));
    let (west, east) = (Vec2::new(-210.0, -14.0), Vec2::new(210.0, 20.0));
    let line = hermite(west, direction(0.16), east, direction(0.10));
    let lengths = arc_lengths(&line);
    let total = lengths[lengths.len() - 1];
    let (one, two) = (total / 2.0 - 42.0, total / 2.0 + 40.0);
    net.end("w", west);
    net.end("e", east);
    net.node("a", point_at(&line, &lengths, one), "priority_stop", Some(6.0));
    net.node("b", point_at(&line, &lengths, two), "priority_stop", Some(6.0));
    net.road("w", "a", part(&line, 0.0, one), HOMES, (false, false));
    net.road("a", "b", part(&line, one, two), HOMES, (false, false));
    net.road("b", "e", part(&line, two, total), HOMES, (false, false));
    let lane = CrossSection { parking: 0.0, priority: 1, ..HOMES };
    ray(&mut net, "a", "n", 95.0, 150.0, lane, false);
    ray(&mut net, "b", "s", 277.0, 150.0, lane, false);
    finished(net)
}

/// Arterial with three lanes per direction and two signalised junctions.
pub fn arterial() -> Network {
    let mut net = Network::new(character("demo-arterial", 55));
    let road = CrossSection { forward: 3, backward: 3, speed: 40.0 * MPH, ..MAIN };
    let middle = |x: f64| Vec2::new(x, 6.0 * (x / 120.0).sin());
    let xs = [-260.0, -62.0, 62.0, 260.0];
    let name = ["w", "a", "b", "e"];
    for (k, &x) in xs.iter().enumerate() {
        if k % 3 == 0 {
            net.end(name[k], middle(x))
        } else {
            net.node(name[k], middle(x), "traffic_light", Some(7.0))
        }
    }
    for k in 0..3 {
        let line = (0..=30).map(|i| middle(xs[k] + (xs[k + 1] - xs[k]) * f64::from(i) / 30.0)).collect();
        net.road(name[k], name[k + 1], line, road, (k > 0, k < 2));
    }
    for (from, to, angle) in [("a", "an", 1.0), ("a", "as", 3.0), ("b", "bn", 1.0), ("b", "bs", 3.0)] {
        let section =
            if from == "a" { SIDE } else { CrossSection { bike: 0.0, median: 0.0, parking: 0.0, ..SIDE } };
        ray(&mut net, from, to, (FRAC_PI_2 * angle).to_degrees() + 3.0, 150.0, section, from == "a");
    }
    finished(net)
}
