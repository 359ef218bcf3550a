//! Paths through a junction, drawn from lane to lane.

use crate::curve::join;
use crate::draft::MapDraft;
use crate::parameters::{Arm, Connections, Turn};
use crate::roadway::Roadway;
use crate::turns::{Movement, all_links};
use scene::map::LaneType;

/// Wider bends have no benefit, metres.
const WIDEST_M: f64 = 40.0;

/// Distances of the lanes of an arm from its kerbs, and the bends of its kerbs.
#[derive(Clone, Copy, Debug)]
pub struct Bends {
    /// The corner beside the lanes in of an arm: the next arm counter-clockwise, and its radius; none if the
    /// kerb goes straight on.
    pub next: usize,
    pub radius_m: Option<f64>,
}

/// Draws all paths. `roads` and `bends` are indexed by arm.
pub fn draw(
    draft: &mut MapDraft,
    arms: &[Arm],
    connections: &Connections,
    roads: &[Roadway],
    bends: &[Bends],
    kerbs_m: &[[f64; 2]],
    lane_m: f64,
) {
    for (from, links) in all_links(arms, connections).into_iter().enumerate() {
        for link in links {
            let (a, b) = (roads[from].left.lanes[link.lane_in], roads[link.to].right.lanes[link.lane_out]);
            let aside = [link.lane_in, link.lane_out].map(|i| (i as f64 + 0.5) * lane_m);
            let one_way = |arm: usize| arms[arm].lanes_in == 0 || arms[arm].lanes_out == 0;
            let middle_m = |arm: usize| if one_way(arm) { 0.0 } else { arms[arm].median_m / 2.0 };
            let aside = [aside[0] + middle_m(from), aside[1] + middle_m(link.to)];
            let radius_m = radius(bends, kerbs_m, from, link.to, aside);
            let way = Movement {
                lanes: Some([link.lane_in, link.lane_out]),
                added: link.added,
                ..bare(from, link.to, link.turn)
            };
            connect(draft, [a, b], radius_m, way);
        }
    }
    cycles(draft, arms, roads, bends, kerbs_m);
}

/// Greatest radius of a bend that keeps its distance from the inner kerb.
fn radius(bends: &[Bends], kerbs_m: &[[f64; 2]], from: usize, to: usize, aside_m: [f64; 2]) -> f64 {
    // Right turns follow the corner beside the lanes in; left turns to the previous arm follow its corner.
    let (bend, room) = if bends[from].next == to {
        (bends[from].radius_m, [kerbs_m[from][0] - aside_m[0], kerbs_m[to][1] - aside_m[1]])
    } else if bends[to].next == from {
        (bends[to].radius_m, [kerbs_m[from][1] + aside_m[0], kerbs_m[to][0] + aside_m[1]])
    } else {
        (None, [0.0; 2])
    };
    bend.map_or(WIDEST_M, |radius_m| (radius_m + room[0].min(room[1])).min(WIDEST_M))
}

/// A path for cycles that is not drawn yet.
fn bare(from: usize, to: usize, turn: Turn) -> Movement {
    Movement { lane: 0, from, to, turn, lanes: None, added: false }
}

fn connect(draft: &mut MapDraft, [a, b]: [usize; 2], radius_m: f64, way: Movement) {
    let line = join(draft.end(a), draft.start(b), radius_m);
    let lane_type = if way.lanes.is_some() { LaneType::SurfaceStreet } else { LaneType::BikeLane };
    let lane = draft.through(a, b, line, lane_type);
    draft.movements.push(Movement { lane, ..way });
}

/// Cycle lanes go straight on and round the corner; without a cycle lane on the other side, they lead into
/// the lane beside the kerb.
fn cycles(draft: &mut MapDraft, arms: &[Arm], roads: &[Roadway], bends: &[Bends], kerbs_m: &[[f64; 2]]) {
    for from in 0..arms.len() {
        let ways: Vec<(usize, Turn)> = crate::turns::directions(arms, from)
            .into_iter()
            .enumerate()
            .filter_map(|(to, turn)| Some((to, turn?)))
            .filter(|(to, _)| !roads[*to].right.all().is_empty())
            .collect();
        let left_alone = ways.iter().all(|(_, turn)| *turn == Turn::Left);
        for (to, turn) in ways {
            let cycle_in = roads[from].left.cycle;
            let target = roads[to].right.cycle.or(roads[to].right.lanes.last().copied());
            let (Some(target), true) = (target, turn != Turn::Left || left_alone) else { continue };
            let half_m = |arm: usize| arms[arm].cycle_lane_m.max(1.5) / 2.0;
            let aside = [kerbs_m[from][0] - half_m(from), kerbs_m[to][1] - half_m(to)];
            let radius_m = radius(bends, kerbs_m, from, to, aside);
            if let Some(cycle_in) = cycle_in {
                connect(draft, [cycle_in, target], radius_m, bare(from, to, turn));
            } else if let (Some(last), Some(cycle_out)) =
                (roads[from].left.lanes.last(), roads[to].right.cycle)
            {
                // A cycle lane begins here.
                connect(draft, [*last, cycle_out], radius_m, bare(from, to, turn));
            }
        }
    }
}
