//! Which lanes lead where.

use crate::parameters::{Arm, Connection, Connections, Turn};
use scene::wrap_angle;
use std::f64::consts::PI;

/// Ways out nearer than this to straight on are straight on, radians.
const STRAIGHT_ON_RAD: f64 = 0.72;

/// A drawn path through a junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// Index of its lane in the map.
    pub lane: usize,
    /// Arms it comes from and goes to, by the order of the parameters.
    pub from: usize,
    pub to: usize,
    pub turn: Turn,
    /// The lane in and the lane out, counted from the middle of the road; none for cycles.
    pub lanes: Option<[usize; 2]>,
    /// A single connection, not made by a turn lane.
    pub added: bool,
}

/// One way from a lane of an arm to a lane of another, both counted from the middle of the road.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurnLink {
    pub to: usize,
    pub turn: Turn,
    pub lane_in: usize,
    pub lane_out: usize,
    pub added: bool,
}

/// The direction of each other arm as seen from the entry `from`; `None` for itself.
pub fn directions(arms: &[Arm], from: usize) -> Vec<Option<Turn>> {
    let inwards = arms[from].angle_deg.to_radians() + PI;
    let change = |arm: &Arm| wrap_angle(arm.angle_deg.to_radians() - inwards);
    let ahead = |i: usize| change(&arms[i]).abs();
    let others = (0..arms.len()).filter(|i| *i != from);
    let straight =
        others.min_by(|a, b| ahead(*a).total_cmp(&ahead(*b))).filter(|i| ahead(*i) < STRAIGHT_ON_RAD);
    (0..arms.len())
        .map(|i| match i {
            i if i == from => None,
            i if Some(i) == straight => Some(Turn::Straight),
            i if change(&arms[i]) > 0.0 => Some(Turn::Left),
            _ => Some(Turn::Right),
        })
        .collect()
}

/// What lanes are for in the mirror image.
pub fn mirrored(lanes: &[Vec<Turn>]) -> Vec<Vec<Turn>> {
    let lane = |turns: &Vec<Turn>| turns.iter().rev().map(|turn| turn.mirrored()).collect();
    lanes.iter().map(lane).collect()
}

/// What each lane in is for, from the middle of the road to the kerb.
pub fn of_lanes(arms: &[Arm], from: usize) -> Vec<Vec<Turn>> {
    if let Some(turns) = &arms[from].turns {
        return turns.clone();
    }
    let directions = directions(arms, from);
    let there =
        |turn: Turn| directions.iter().zip(arms).any(|(way, arm)| *way == Some(turn) && arm.lanes_out > 0);
    let (left, straight, right) = (there(Turn::Left), there(Turn::Straight), there(Turn::Right));
    let count = usize::from(arms[from].lanes_in);
    (0..count)
        .map(|i| {
            let mut turns = Vec::new();
            let (first, last) = (i == 0, i + 1 == count);
            if straight {
                if first && left {
                    turns.push(Turn::Left);
                }
                // With more than one lane, turns across oncoming traffic have a lane of their own.
                if !(first && left && count > 1) {
                    turns.push(Turn::Straight);
                }
                if last && right {
                    turns.push(Turn::Right);
                }
            } else {
                let half = count.div_ceil(2);
                if left && (i < half || !right) {
                    turns.push(Turn::Left);
                }
                if right && (i >= count / 2 && (i >= half || count % 2 == 1) || !left) {
                    turns.push(Turn::Right);
                }
            }
            turns
        })
        .collect()
}

/// The ways from the lanes of an arm.
pub fn links(arms: &[Arm], from: usize) -> Vec<TurnLink> {
    let directions = directions(arms, from);
    let turns = of_lanes(arms, from);
    let mut links = Vec::new();
    for (to, turn) in directions.iter().enumerate().filter_map(|(i, way)| way.map(|turn| (i, turn))) {
        let outs = usize::from(arms[to].lanes_out);
        let ins: Vec<usize> = (0..turns.len()).filter(|i| turns[*i].contains(&turn)).collect();
        if outs == 0 {
            continue;
        }
        for (k, lane_in) in ins.iter().enumerate() {
            let lane_out = match turn {
                Turn::Left => k.min(outs - 1),
                Turn::Straight | Turn::Right => (outs - 1).saturating_sub(ins.len() - 1 - k),
            };
            links.push(TurnLink { to, turn, lane_in: *lane_in, lane_out, added: false });
        }
    }
    links
}

/// All connections of a junction by their arm of entry: those of its turn lanes, adjusted by the single ones.
pub fn all_links(arms: &[Arm], connections: &Connections) -> Vec<Vec<TurnLink>> {
    let mut all = usual_links(arms);
    let is = |from: usize, link: &TurnLink, other: &Connection| {
        other.from == [from, link.lane_in] && other.to == [link.to, link.lane_out]
    };
    for (from, links) in all.iter_mut().enumerate() {
        links.retain(|link| !connections.removed.iter().any(|other| is(from, link, other)));
        for other in connections.added.iter().filter(|other| other.from[0] == from) {
            if !links.iter().any(|link| is(from, link, other)) {
                let ([_, lane_in], [to, lane_out]) = (other.from, other.to);
                // A U-turn yields as a left turn does.
                let turn = directions(arms, from)[to].unwrap_or(Turn::Left);
                links.push(TurnLink { to, turn, lane_in, lane_out, added: true });
            }
        }
    }
    all
}

/// Connections of the turn lanes. A lane out without one is reached from the entry of the nearest lane out.
fn usual_links(arms: &[Arm]) -> Vec<Vec<TurnLink>> {
    let mut all: Vec<Vec<TurnLink>> = (0..arms.len()).map(|from| links(arms, from)).collect();
    for to in 0..arms.len() {
        for lane_out in 0..usize::from(arms[to].lanes_out) {
            let into = |link: &&TurnLink| link.to == to;
            if all.iter().flatten().filter(into).any(|link| link.lane_out == lane_out) {
                continue;
            }
            let mut best: Option<(usize, usize, TurnLink)> = None;
            for (from, links) in all.iter().enumerate() {
                for link in links.iter().filter(into) {
                    let aside = link.lane_out.abs_diff(lane_out);
                    let price = 2 * aside + usize::from(link.turn != Turn::Straight);
                    if best.as_ref().is_none_or(|(least, ..)| price < *least) {
                        best = Some((price, from, *link));
                    }
                }
            }
            if let Some((_, from, link)) = best {
                all[from].push(TurnLink { lane_out, ..link });
            }
        }
    }
    all
}

/// Names of arms by where they lead.
pub fn names(arms: &[Arm]) -> Vec<String> {
    const POINTS: [&str; 8] =
        ["East", "North-east", "North", "North-west", "West", "South-west", "South", "South-east"];
    let point = |arm: &Arm| POINTS[(arm.angle_deg / 45.0).round().rem_euclid(8.0) as usize % 8];
    let mut names: Vec<String> = Vec::new();
    for (i, arm) in arms.iter().enumerate() {
        let same = arms[..i].iter().filter(|other| point(other) == point(arm)).count();
        names.push(if same == 0 { point(arm).to_owned() } else { format!("{} {}", point(arm), same + 1) });
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cross(lanes: [(u8, u8); 4]) -> Vec<Arm> {
        (0..4).map(|i| Arm::leading(90.0 * f64::from(i), lanes[i as usize].0, lanes[i as usize].1)).collect()
    }

    #[test]
    fn one_lane_leads_everywhere_and_two_share_it() {
        let arms = cross([(2, 2), (1, 1), (2, 2), (1, 1)]);
        assert_eq!(of_lanes(&arms, 1), [vec![Turn::Left, Turn::Straight, Turn::Right]]);
        assert_eq!(of_lanes(&arms, 0), [vec![Turn::Left], vec![Turn::Straight, Turn::Right]]);
        // From the east, right is north.
        assert_eq!(directions(&arms, 0)[1], Some(Turn::Right));
        assert_eq!(names(&arms), ["East", "North", "West", "South"]);
        let all = all_links(&arms, &Connections::default());
        assert!(all.iter().flatten().any(|l| l.to == 2 && l.lane_out == 0));
    }

    #[test]
    fn an_arm_across_a_road_has_no_way_straight_on() {
        let arms = [Arm::leading(0.0, 1, 1), Arm::leading(180.0, 1, 1), Arm::leading(270.0, 3, 1)];
        assert_eq!(of_lanes(&arms, 2), [vec![Turn::Left], vec![Turn::Left, Turn::Right], vec![Turn::Right]]);
        assert_eq!(of_lanes(&arms, 0), [vec![Turn::Left, Turn::Straight]]);
    }
}
