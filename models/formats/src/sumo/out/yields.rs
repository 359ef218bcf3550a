//! Right of way at a junction.

use super::network::Link;
use crate::joints::Crossings;
use scene::Vec2;
use scene::geometry::cross;

/// A link that turns by this much more than another gives way to it, radians.
const TURNS_MORE_RAD: f64 = 0.3;

/// Links that cross a link, and which of them have priority.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct LinkPriority {
    /// Links that cross or join it.
    pub foes: Vec<bool>,
    /// Those of them with priority over it.
    pub first: Vec<bool>,
}

impl LinkPriority {
    pub fn gives_way(&self) -> bool {
        self.first.contains(&true)
    }
}

/// The flags as digits in the order of SUMO, in which the first link is last.
pub(super) fn letters(list: &[bool]) -> String {
    list.iter().rev().map(|set| if *set { '1' } else { '0' }).collect()
}

/// Of two crossing links, one has priority: the one without a stop sign, else the one with the smaller turn,
/// else the one from the right.
pub(super) fn rules(links: &[Link], lines: &[Vec<Vec2>]) -> Vec<LinkPriority> {
    let none = || vec![false; links.len()];
    let mut rules: Vec<LinkPriority> =
        links.iter().map(|_| LinkPriority { foes: none(), first: none() }).collect();
    let line = |link: &Link| -> Vec<Vec2> {
        link.via.iter().flat_map(|(lane, _)| lines[*lane].iter().copied()).collect()
    };
    let ways: Vec<Vec<Vec2>> = links.iter().map(line).collect();
    let mut crossings = Crossings::of(ways.iter().map(Vec::as_slice));
    // SUMO looks for foes on the internal lanes of links: either all links have such lanes, or none.
    let all = links.iter().all(|link| !link.via.is_empty()) || links.iter().all(|link| link.via.is_empty());
    for (i, a) in links.iter().enumerate() {
        for (j, b) in links.iter().enumerate().skip(i + 1) {
            let ways = !a.via.is_empty() && !b.via.is_empty();
            let mut meet = || ways && crossings.meet(i, j);
            if !(all || ways) || a.from == b.from || !(a.to == b.to || meet()) {
                continue;
            }
            (rules[i].foes[j], rules[j].foes[i]) = (true, true);
            if goes_first(a, b, lines) {
                rules[j].first[i] = true;
            } else {
                rules[i].first[j] = true;
            }
        }
    }
    rules
}

fn goes_first(a: &Link, b: &Link, lines: &[Vec<Vec2>]) -> bool {
    if a.stops != b.stops {
        return b.stops;
    }
    let more = a.turn_rad.abs() - b.turn_rad.abs();
    if more.abs() > TURNS_MORE_RAD {
        return more < 0.0;
    }
    let way = |lane: usize| lines[lane].last_chunk::<2>().map_or(Vec2::zeros(), |[p, q]| q - p);
    // A road user from the right approaches towards the left of the other.
    cross(way(b.from), way(a.from)) >= 0.0
}
