//! Roundabouts: closed chains of lanes.

use scene::routes::{LaneGraph, Polyline};
use scene::{AgentType, wrap_angle};
use std::collections::{BTreeMap, VecDeque};

/// Longest circumference, metres.
const LONGEST_M: f64 = 400.0;
/// Most lanes that are searched for one ring.
const MOST_LANES: usize = 96;
/// Number of equal pieces in which a ring is examined.
const PIECES: usize = 12;
/// Number of consecutive pieces that must turn together. A road out and back between two U-turns is straight
/// over more pieces.
const TOGETHER: usize = 4;
/// Smallest turn of these pieces, radians; that of a circle is 2.1.
const LEAST_RAD: f64 = 0.7;

/// Whether the lanes from `first` on lead round to `last`, which leads to `first`.
pub(super) fn is_ring(graph: &LaneGraph, first: usize, last: usize) -> bool {
    ring(graph, first, last).is_some_and(|path| is_round(&path))
}

/// The shortest chain of lanes from `first` to `last`, as one line.
fn ring(graph: &LaneGraph, first: usize, last: usize) -> Option<Polyline> {
    let lanes = graph.lanes();
    // For each reached lane: the previous lane, and the metres to its end.
    let mut known = BTreeMap::from([(first, (first, lanes[first].path.length_m()))]);
    let mut next = VecDeque::from([first]);
    while let Some(lane) = next.pop_front() {
        let (_, length_m) = *known.get(&lane)?;
        if lane == last && length_m <= LONGEST_M {
            break;
        }
        let drives = |next: &&usize| lanes[**next].carries(AgentType::Vehicle);
        for after in lanes[lane].successors.iter().filter(drives) {
            if length_m <= LONGEST_M && known.len() < MOST_LANES && !known.contains_key(after) {
                known.insert(*after, (lane, length_m + lanes[*after].path.length_m()));
                next.push_back(*after);
            }
        }
    }
    let mut row = vec![last];
    while row.last() != Some(&first) {
        row.push(known.get(row.last()?)?.0);
    }
    let points = row.iter().rev().flat_map(|lane| lanes[*lane].path.points().iter().copied());
    Some(Polyline::new(points)).filter(|path| path.length_m() <= LONGEST_M)
}

/// Whether a closed line turns in one direction everywhere.
fn is_round(path: &Polyline) -> bool {
    let heading = |piece: usize| {
        let place = (piece % PIECES) as f64 + 0.5;
        path.sample(path.length_m() * place / PIECES as f64).heading_rad
    };
    let turns: Vec<f64> = (0..PIECES).map(|piece| wrap_angle(heading(piece + 1) - heading(piece))).collect();
    let together = |first: usize| (first..first + TOGETHER).map(|piece| turns[piece % PIECES]).sum::<f64>();
    let all: Vec<f64> = (0..PIECES).map(together).collect();
    all.iter().all(|turn| *turn > LEAST_RAD) || all.iter().all(|turn| *turn < -LEAST_RAD)
}
