//! Room to brake: lowers drawn speeds until comfortable braking suffices for the road user ahead, and for one
//! whose path crosses or joins. A road user for which no speed suffices is left out.

use crate::planning::world::AgentAtStart;
use crate::tuning::placing::room::{
    APART_S, BEFORE_M, LONGEST_M, REACTION_S, SAME_LINE_M, SAME_WAY, SIDE_M, STANDING_GAP_M, WALK_AHEAD_S,
    WALK_SIDE_M,
};
use scene::geometry::direction;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::limits::Limits;
use scene::routes::speed::{Obstacle, SpeedRules, caps_of_bends, curvatures_per_m};
use scene::routes::{LaneGraph, Polyline};
use scene::{AgentType, STANDING_MPS, Subtype, Vec2};
use std::f64::consts::FRAC_PI_2;

/// Distance between the boxes of a path, metres.
const STEP_M: f64 = 1.0;
/// Most paths of one driver.
const MOST_WAYS: usize = 8;
/// Most rounds of lowering speeds; each round lowers at least one.
const ROUNDS: usize = 40;
/// A road user that needs room to brake, or that others have to brake for.
pub(super) struct DrivenBox {
    pub(super) agent_type: AgentType,
    pub(super) limits: Limits,
    pub(super) outline: OrientedBox,
    pub(super) speed_mps: f64,
    /// Graph lane and arc length of a driver, metres.
    pub(super) lane: Option<(usize, f64)>,
    /// The request keeps it, so its speed does not change.
    pub(super) kept: bool,
}

impl DrivenBox {
    /// A road user that the request keeps.
    pub(super) fn kept(present: &AgentAtStart, lane: Option<(usize, f64)>) -> Self {
        let Obstacle { outline, speed_mps } = present.obstacle();
        let limits = Limits::of(present.agent_type, Subtype::default(), present.size.length_m);
        Self { agent_type: present.agent_type, limits, outline, speed_mps, lane, kept: true }
    }
}

/// Boxes of a kept road user over the ground that it cannot avoid, and slightly beyond.
pub(super) fn next(graph: &LaneGraph, mover: &DrivenBox) -> impl Iterator<Item = OrientedBox> {
    let walks = mover.lane.is_none().then(|| kept_clear(mover));
    ways(graph, mover).into_iter().filter(move |_| walks.is_none()).flatten().chain(walks)
}

/// The speed from which a driver slows down to `to_mps` within `room_m` by comfortable braking, after a
/// reaction time.
pub(super) fn brakes_from(limits: &Limits, room_m: f64, to_mps: f64) -> f64 {
    let brake_mps2 = limits.comfortable.brake_mps2;
    let moment_mps = brake_mps2 * REACTION_S;
    (moment_mps * moment_mps + to_mps * to_mps + 2.0 * brake_mps2 * room_m.max(0.0)).sqrt() - moment_mps
}

/// The paths that a road user can take from its place, slightly longer than its stopping distance.
fn ways(graph: &LaneGraph, mover: &DrivenBox) -> Vec<Vec<OrientedBox>> {
    let parked = mover.lane.is_none() && mover.agent_type == AgentType::Vehicle;
    if parked {
        return Vec::new();
    }
    let brake_mps2 = mover.limits.comfortable.brake_mps2;
    let stops_m = mover.speed_mps * REACTION_S + mover.speed_mps.powi(2) / (2.0 * brake_mps2);
    let reach_m = (stops_m + STANDING_GAP_M + 2.0 * mover.outline.half_length_m()).min(LONGEST_M);
    let lines = match mover.lane {
        Some((lane, s_m)) => lines(graph, mover.agent_type, lane, s_m, reach_m),
        None => {
            let center = mover.outline.center();
            vec![Polyline::new([center, center + mover.outline.forward() * reach_m])]
        }
    };
    lines
        .iter()
        .map(|line| {
            let aside_m = line.project(mover.outline.center()).lateral_m;
            let count = (line.length_m().min(reach_m) / STEP_M) as usize;
            let on = (1..=count).map(|i| {
                let place = line.sample(i as f64 * STEP_M);
                let center = place.position + direction(place.heading_rad + FRAC_PI_2) * aside_m;
                let (half_length_m, half_width_m) =
                    (mover.outline.half_length_m(), mover.outline.half_width_m());
                OrientedBox::new(center, half_length_m, half_width_m + SIDE_M, place.heading_rad)
            });
            let own = &mover.outline;
            let first = OrientedBox::new(
                own.center(),
                own.half_length_m(),
                own.half_width_m() + SIDE_M,
                own.heading_rad(),
            );
            std::iter::once(first).chain(on).collect()
        })
        .collect()
}

/// Paths along the lanes ahead of a place, one per branch.
pub(super) fn lines(
    graph: &LaneGraph,
    agent_type: AgentType,
    lane: usize,
    s_m: f64,
    reach_m: f64,
) -> Vec<Polyline> {
    let mut done = Vec::new();
    let path = &graph.lanes()[lane].path;
    let rest = |path: &Polyline, from_m: f64, reach_m: f64| -> Vec<Vec2> {
        let to_m = (from_m + reach_m).min(path.length_m());
        if to_m - from_m < 0.1 {
            vec![path.position_at(from_m)]
        } else {
            path.slice(from_m, to_m).points().to_vec()
        }
    };
    let mut todo = vec![(lane, rest(path, s_m, reach_m), reach_m - (path.length_m() - s_m))];
    while let Some((at, points, left_m)) = todo.pop() {
        let carries = |next: &&usize| graph.lanes()[**next].carries(agent_type);
        let next: Vec<usize> = graph.lanes()[at].successors.iter().filter(carries).copied().collect();
        if left_m < STEP_M || next.is_empty() || done.len() + todo.len() + 1 >= MOST_WAYS {
            if points.len() > 1 {
                done.push(Polyline::new(points));
            }
            continue;
        }
        for lane in next {
            let path = &graph.lanes()[lane].path;
            let longer = points.iter().copied().chain(rest(path, 0.0, left_m).into_iter().skip(1)).collect();
            todo.push((lane, longer, left_m - path.length_m()));
        }
    }
    done
}

/// The highest speed for the bends ahead, on the branch that allows most, m/s.
pub(super) fn bend_mps(graph: &LaneGraph, mover: &DrivenBox) -> f64 {
    let Some((lane, s_m)) = mover.lane else { return f64::INFINITY };
    let manner = mover.limits.comfortable;
    let rules = SpeedRules { lateral_mps2: manner.lateral_mps2, brake_mps2: manner.brake_mps2 };
    let cap = |line: &Polyline| {
        let caps = caps_of_bends(line.arc_m(), &curvatures_per_m(line), &[f64::INFINITY], rules);
        caps.first().copied().unwrap_or(f64::INFINITY)
    };
    let lines = lines(graph, mover.agent_type, lane, s_m, LONGEST_M);
    lines.iter().map(cap).reduce(f64::max).unwrap_or(f64::INFINITY)
}

/// A road user on one of a driver's paths, and its distance.
struct MetOnWay {
    by: usize,
    with: usize,
    room_m: f64,
    /// Share of the other's speed along this path.
    along: f64,
}

/// Where the paths of two drivers cross or join: metres until each is in the other's way, and until it has
/// left.
struct WaysMeet {
    of: [usize; 2],
    into_m: [f64; 2],
    past_m: [f64; 2],
    joins: bool,
}

/// Lowers speeds until there is room. Returns which road users are left out.
pub(super) fn make_room(graph: &LaneGraph, movers: &mut [DrivenBox]) -> Vec<bool> {
    let ways: Vec<Vec<Vec<OrientedBox>>> = movers.iter().map(|mover| ways(graph, mover)).collect();
    let contacts = contacts(movers, &ways);
    let crossings = crossings(movers, &ways, &contacts);
    let mut out = vec![false; movers.len()];
    for _ in 0..ROUNDS {
        let mut changed = false;
        for contact in &contacts {
            changed |= follow(contact, movers, &mut out);
        }
        for crossing in &crossings {
            changed |= yield_to(crossing, movers, &mut out);
        }
        if !changed {
            break;
        }
    }
    out
}

/// The box from which others keep clear; for a walker it includes the next moments.
fn kept_clear(mover: &DrivenBox) -> OrientedBox {
    let own = &mover.outline;
    if mover.lane.is_some() || mover.agent_type == AgentType::Vehicle {
        return *own;
    }
    let ahead_m = 0.5 * mover.speed_mps * WALK_AHEAD_S;
    let center = own.center() + own.forward() * ahead_m;
    OrientedBox::new(center, own.half_length_m() + ahead_m, own.half_width_m(), own.heading_rad())
        .grown(WALK_SIDE_M)
}

fn contacts(movers: &[DrivenBox], ways: &[Vec<Vec<OrientedBox>>]) -> Vec<MetOnWay> {
    let clear: Vec<OrientedBox> = movers.iter().map(kept_clear).collect();
    let mut found = Vec::new();
    for (by, own) in ways.iter().enumerate() {
        for (with, other) in clear.iter().enumerate().filter(|(with, _)| *with != by) {
            // A road user whose middle is behind the driver's own is not ahead.
            let to_other = movers[with].outline.center() - movers[by].outline.center();
            let behind = to_other.dot(&movers[by].outline.forward()) < 0.0;
            let firsts = own.iter().filter_map(|way| {
                let at = way.iter().position(|own| overlaps(own, other, 0.0))?;
                Some((at, way[at].forward().dot(&other.forward())))
            });
            let Some((at, along)) = firsts.min_by_key(|(at, _)| *at) else { continue };
            if behind && at == 0 {
                continue;
            }
            let along = if along > SAME_WAY { along } else { 0.0 };
            found.push(MetOnWay { by, with, room_m: (at as f64 - 1.0).max(0.0) * STEP_M, along });
        }
    }
    found
}

fn crossings(movers: &[DrivenBox], ways: &[Vec<Vec<OrientedBox>>], contacts: &[MetOnWay]) -> Vec<WaysMeet> {
    let ahead: std::collections::HashSet<[usize; 2]> =
        contacts.iter().filter(|c| c.along > 0.0).flat_map(|c| [[c.by, c.with], [c.with, c.by]]).collect();
    let mut found = Vec::new();
    for (i, of_i) in ways.iter().enumerate() {
        for (j, of_j) in ways.iter().enumerate().skip(i + 1) {
            let [a, b] = [i, j].map(|k| &movers[k]);
            if ahead.contains(&[i, j]) || a.kept && b.kept || a.lane.is_none() || b.lane.is_none() {
                continue;
            }
            for a in of_i {
                for b in of_j {
                    found.extend(crossing([i, j], a, b));
                }
            }
        }
    }
    found
}

fn crossing(of: [usize; 2], a: &[OrientedBox], b: &[OrientedBox]) -> Option<WaysMeet> {
    let reach_m = (a.len() + b.len()) as f64 * STEP_M + a[0].radius_m() + b[0].radius_m();
    if (a[0].center() - b[0].center()).norm() > reach_m {
        return None;
    }
    let meet = |p: &OrientedBox, q: &OrientedBox| {
        let turn = p.forward().dot(&q.forward());
        let near = turn.abs() < SAME_WAY || (p.center() - q.center()).norm() < SAME_LINE_M;
        near && overlaps(p, q, 0.0)
    };
    let mut held: Option<WaysMeet> = None;
    for (i, p) in a.iter().enumerate() {
        for (j, q) in b.iter().enumerate().filter(|(_, q)| meet(p, q)) {
            let at = [i as f64 * STEP_M, j as f64 * STEP_M];
            let joins = p.forward().dot(&q.forward()) > SAME_WAY;
            let held = held.get_or_insert(WaysMeet { of, into_m: at, past_m: at, joins });
            for k in 0..2 {
                held.into_m[k] = held.into_m[k].min(at[k]);
                held.past_m[k] = held.past_m[k].max(at[k]);
            }
            held.joins |= joins;
        }
    }
    held
}

/// Lowers the speed of a driver that follows or meets another; true if a speed or a left-out flag changed.
fn follow(contact: &MetOnWay, movers: &mut [DrivenBox], out: &mut [bool]) -> bool {
    let &MetOnWay { by, with, room_m, along } = contact;
    if out[by] || out[with] {
        return false;
    }
    let ahead_mps = movers[with].speed_mps * along;
    let most = brakes_from(&movers[by].limits, room_m - STANDING_GAP_M, ahead_mps);
    if movers[by].speed_mps <= most + 1e-6 {
        return false;
    }
    if movers[by].kept {
        // A kept road user cannot be slowed down.
        out[with] |= !movers[with].kept;
        return !movers[with].kept;
    }
    lower(&mut movers[by], most)
}

fn lower(mover: &mut DrivenBox, most: f64) -> bool {
    let before = mover.speed_mps;
    mover.speed_mps = if most < STANDING_MPS { 0.0 } else { before.min(most) };
    mover.speed_mps < before
}

/// Makes one of two stop before their paths meet, unless they pass that place well apart in time. True if a
/// speed or a left-out flag changed.
fn yield_to(crossing: &WaysMeet, movers: &mut [DrivenBox], out: &mut [bool]) -> bool {
    let WaysMeet { of, into_m, past_m, joins } = crossing;
    if out[of[0]] || out[of[1]] {
        return false;
    }
    let room_m = into_m.map(|m| m - BEFORE_M);
    let speed = of.map(|i| movers[i].speed_mps);
    let enters_s = [0, 1].map(|k| if speed[k] > 0.0 { into_m[k] / speed[k] } else { f64::INFINITY });
    let leaves_s = [0, 1].map(|k| if speed[k] > 0.0 { past_m[k] / speed[k] } else { f64::INFINITY });
    // The later one stops, if both could.
    let later = usize::from(enters_s[1] >= enters_s[0]);
    let most = |k: usize| {
        let limits = &movers[of[k]].limits;
        let stops = brakes_from(limits, room_m[k], 0.0);
        let lengths_m = of.iter().map(|i| movers[*i].outline.half_length_m()).sum::<f64>();
        let behind_m = into_m[k] - into_m[1 - k] - lengths_m - STANDING_GAP_M;
        if *joins && behind_m > 0.0 { stops.max(brakes_from(limits, behind_m, speed[1 - k])) } else { stops }
    };
    let yields = |k: usize| room_m[k] >= 0.0 && speed[k] <= most(k) + 1e-6;
    let apart = |k: usize| !joins && enters_s[k] > leaves_s[1 - k] + APART_S;
    if yields(0) || yields(1) || apart(0) || apart(1) {
        return false;
    }
    let may = |k: usize| !movers[of[k]].kept && room_m[k] >= 0.0;
    let Some(who) = [later, 1 - later].into_iter().find(|k| may(*k)) else {
        // Each already blocks the path of the other.
        let who = if movers[of[1]].kept { of[0] } else { of[1] };
        out[who] = true;
        return true;
    };
    let most = most(who);
    lower(&mut movers[of[who]], most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::{Lane, LaneMap};
    use std::f64::consts::PI;

    fn line(id: &str, points: &[(f64, f64)]) -> Lane {
        Lane::street(id, points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect::<Vec<_>>())
    }

    fn graph(lanes: Vec<Lane>) -> LaneGraph {
        LaneGraph::new(&LaneMap { lanes, ..LaneMap::default() })
    }

    /// A car of 4 m on a lane.
    fn car(graph: &LaneGraph, lane: usize, s_m: f64, speed_mps: f64) -> DrivenBox {
        let place = graph.lanes()[lane].path.sample(s_m);
        DrivenBox {
            agent_type: AgentType::Vehicle,
            limits: Limits::of(AgentType::Vehicle, Subtype::Car, 4.0),
            outline: OrientedBox::new(place.position, 2.0, 0.9, place.heading_rad),
            speed_mps,
            lane: Some((lane, s_m)),
            kept: false,
        }
    }

    fn walker(x_m: f64, y_m: f64, heading_rad: f64, speed_mps: f64) -> DrivenBox {
        DrivenBox {
            agent_type: AgentType::Pedestrian,
            limits: Limits::of(AgentType::Pedestrian, Subtype::Adult, 0.5),
            outline: OrientedBox::new(Vec2::new(x_m, y_m), 0.25, 0.25, heading_rad),
            speed_mps,
            lane: None,
            kept: false,
        }
    }

    fn speeds(graph: &LaneGraph, movers: Vec<DrivenBox>) -> Vec<Option<f64>> {
        let mut movers = movers;
        let out = make_room(graph, &mut movers);
        movers.iter().zip(out).map(|(mover, out)| (!out).then_some(mover.speed_mps)).collect()
    }

    /// Metres to a stop, by comfortable braking after a reaction time.
    fn stops_m(speed_mps: f64) -> f64 {
        speed_mps * REACTION_S + speed_mps * speed_mps / 4.0
    }

    #[test]
    fn braking_takes_the_room_that_there_is() {
        let limits = Limits::of(AgentType::Vehicle, Subtype::Car, 4.0);
        for (room_m, ahead_mps) in [(0.0, 0.0), (1.4, 6.0), (8.8, 0.0), (40.0, 10.0)] {
            let speed_mps = brakes_from(&limits, room_m, ahead_mps);
            let needed_m = speed_mps * REACTION_S + (speed_mps * speed_mps - ahead_mps * ahead_mps) / 4.0;
            assert!(speed_mps >= 0.0 && (needed_m - room_m).abs() < 1e-9, "{speed_mps} m/s, {room_m} m");
        }
    }

    #[test]
    fn followers_can_brake_for_whom_they_follow() {
        let graph = graph(vec![line("a", &[(0.0, 0.0), (300.0, 0.0)])]);
        let of = |gap_m: f64, ahead_mps: f64| {
            speeds(&graph, vec![car(&graph, 0, 10.0, 20.0), car(&graph, 0, 14.0 + gap_m, ahead_mps)])[0]
                .unwrap()
        };
        for gap_m in [6.0, 20.0, 60.0] {
            let speed_mps = of(gap_m, 0.0);
            assert!(
                speed_mps > 1.0 && stops_m(speed_mps) <= gap_m - 2.0 + 1e-6,
                "{speed_mps} m/s, {gap_m} m"
            );
        }
        assert!(of(20.0, 12.0) > of(20.0, 4.0), "a fast leader needs less room");
        assert_eq!(of(200.0, 0.0), 20.0, "it is far away");
        // A chain: each driver uses the final speed of the one ahead.
        let chain = (0..4).map(|i| car(&graph, 0, 10.0 + 15.0 * f64::from(i), 20.0 - 6.0 * f64::from(i)));
        let slowed: Vec<f64> = speeds(&graph, chain.collect()).into_iter().flatten().collect();
        for pair in slowed.windows(2) {
            assert!(stops_m(pair[0]) - pair[1] * pair[1] / 4.0 <= 9.0 + 1e-6, "{slowed:?}");
        }
    }

    #[test]
    fn one_of_two_whose_ways_cross_can_stop_before() {
        let lanes =
            || vec![line("a", &[(-100.0, 0.0), (100.0, 0.0)]), line("b", &[(0.0, -100.0), (0.0, 100.0)])];
        let graph = graph(lanes());
        let at = |a_m: f64, b_m: f64| {
            speeds(&graph, vec![car(&graph, 0, 100.0 - a_m, 10.0), car(&graph, 1, 100.0 - b_m, 10.0)])
        };
        // Box and path begin to overlap about 3 m before the crossing.
        let slowed = at(20.0, 22.0);
        assert_eq!(slowed[0], Some(10.0), "it comes first");
        assert!(
            slowed[1].is_some_and(|v| stops_m(v) <= 22.0 - 3.0 - BEFORE_M + 1e-6 && v > 3.0),
            "{slowed:?}"
        );
        assert_eq!(at(8.0, 36.0), [Some(10.0), Some(10.0)], "one passes well after the other");
        assert_eq!(at(60.0, 60.0), [Some(10.0), Some(10.0)], "both are far away");
        assert_eq!(at(3.05, 3.05)[1], None, "neither can stop any more");
    }

    #[test]
    fn who_turns_left_can_wait_for_oncoming_traffic() {
        let mut before = line("before", &[(0.0, -60.0), (0.0, -8.0)]);
        let arc = |i: u32| {
            let angle = f64::from(i) / 12.0 * FRAC_PI_2;
            (-12.0 + 12.0 * angle.cos(), -8.0 + 12.0 * angle.sin())
        };
        let mut turn = line("turn", &(0..=12).map(arc).collect::<Vec<_>>());
        turn.interpolating = true;
        before.successors = vec!["turn".into()];
        turn.predecessors = vec!["before".into()];
        let oncoming = line("oncoming", &[(-3.5, 80.0), (-3.5, -80.0)]);
        let graph = graph(vec![before, turn, oncoming]);
        let index = |id: &str| graph.lane_index(id).unwrap();
        let turns = car(&graph, index("before"), 47.0, 8.0);
        let slowed = speeds(&graph, vec![turns, car(&graph, index("oncoming"), 58.0, 12.0)]);
        assert!(slowed[0].is_some_and(|v| v < 6.0) || slowed[1].is_some_and(|v| v < 8.0), "{slowed:?}");
    }

    #[test]
    fn who_joins_another_has_room_behind_it() {
        let ends = |id: &str, y_m: f64| {
            let mut lane = line(id, &[(0.0, y_m), (60.0, y_m), (100.0, 0.0)]);
            lane.successors = vec!["on".into()];
            lane
        };
        let mut on = line("on", &[(100.0, 0.0), (200.0, 0.0)]);
        on.predecessors = vec!["a".into(), "b".into()];
        let graph = graph(vec![ends("a", 8.0), ends("b", -8.0), on]);
        let index = |id: &str| graph.lane_index(id).unwrap();
        let of = |behind_m: f64| {
            let movers =
                vec![car(&graph, index("a"), 80.0, 12.0), car(&graph, index("b"), 80.0 - behind_m, 13.0)];
            speeds(&graph, movers)
        };
        let near = of(4.0)[1].unwrap();
        assert!(near < 9.0, "{near} m/s four metres behind");
        assert_eq!(of(40.0), [Some(12.0), Some(13.0)], "a gap to join");
    }

    #[test]
    fn cars_stop_for_walkers_and_walkers_for_each_other() {
        let graph = graph(vec![line("a", &[(0.0, 0.0), (200.0, 0.0)])]);
        let before = |walker: DrivenBox| speeds(&graph, vec![car(&graph, 0, 10.0, 14.0), walker])[0].unwrap();
        let crosses = before(walker(40.0, -4.0, FRAC_PI_2, 1.4));
        assert!(stops_m(crosses) <= 28.0 - WALK_SIDE_M - 2.0, "{crosses} m/s");
        assert_eq!(before(walker(40.0, -4.0, -FRAC_PI_2, 1.4)), 14.0, "it walks away");
        let meet = speeds(&graph, vec![walker(0.0, 9.0, 0.0, 2.0), walker(1.5, 9.0, PI, 2.0)]);
        assert!(meet.iter().flatten().all(|v| *v < 0.5), "{meet:?}");
    }

    #[test]
    fn nobody_is_put_before_a_road_user_that_stays() {
        let graph = graph(vec![line("a", &[(0.0, 0.0), (200.0, 0.0)])]);
        let kept = |speed_mps: f64| DrivenBox { kept: true, ..car(&graph, 0, 10.0, speed_mps) };
        let of =
            |speed_mps: f64, s_m: f64| speeds(&graph, vec![kept(speed_mps), car(&graph, 0, s_m, 0.0)])[1];
        assert_eq!(of(15.0, 30.0), None);
        assert_eq!(of(15.0, 90.0), Some(0.0));
        assert_eq!(of(0.0, 20.0), Some(0.0));
        let next: Vec<OrientedBox> = next(&graph, &kept(15.0)).collect();
        let is_in_the_way = |x_m: f64, y_m: f64| {
            next.iter().any(|own| overlaps(own, &walker(x_m, y_m, 0.0, 0.0).outline, 0.0))
        };
        assert!(is_in_the_way(30.0, 0.5) && !is_in_the_way(30.0, 3.0) && !is_in_the_way(120.0, 0.0));
    }

    #[test]
    fn bends_ahead_are_braked_for() {
        let arc = |i: u32| {
            let angle = f64::from(i) / 20.0 * FRAC_PI_2;
            (60.0 + 15.0 * angle.sin(), 15.0 - 15.0 * angle.cos())
        };
        let points: Vec<(f64, f64)> = std::iter::once((0.0, 0.0)).chain((0..=20).map(arc)).collect();
        let graph = graph(vec![line("bend", &points)]);
        let at = |s_m: f64| bend_mps(&graph, &car(&graph, 0, s_m, 0.0));
        let in_bend = (2.2_f64 * 15.0).sqrt();
        assert!((at(70.0) - in_bend).abs() < 0.6, "{} m/s in the bend, {in_bend} expected", at(70.0));
        let before = (in_bend * in_bend + 2.0 * 2.0 * 30.0).sqrt();
        assert!((at(30.0) - before).abs() < 1.0, "{} m/s before it, {before} expected", at(30.0));
    }
}
