//! Faults of files that every reader repairs or reports alike, before a scene is checked.

use crate::headings::motion;
use crate::limits::MAX_POLYLINE_POINTS;
use crate::polyline::simplify;
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError};
use crate::sentences;
use scene::map::{Boundary, Lane, LaneMap, Neighbor, Points};
use scene::message::Message;
use scene::routes::LaneGraph;
use scene::{Agent, AgentType, Scene, Shared, Vec2, geometry};
use std::collections::{HashMap, HashSet};

/// Greatest gap between the ends of linked lanes, metres: the greater of their widths, clamped to this range.
const GAP_M: (f64, f64) = (3.0, 4.5);
/// Lanes whose ends are within this distance meet, metres.
const MEETING_M: f64 = 0.5;
/// Lines with too many points are first thinned with this tolerance, metres.
const THINNED_M: f64 = 0.02;
/// A box is long if the ratio of its sides is at least this.
const LONG: f64 = 1.3;
/// A box lies across the motion if the cosine of their angle is below this in most of at least this many
/// moving states.
const ACROSS: f64 = 0.5;
const ENOUGH: usize = 3;

/// Repairs the faults of a file in the scene that a reader made, and checks it against the limits of a scene.
pub(crate) fn checked(mut scene: Scene, mut warnings: Vec<ImportWarning>) -> Result<Imported, ReadError> {
    let thinned = thin_lines(&mut scene.map);
    warnings.extend(warning(thinned, "lines-thinned", sentences::lines_thinned));
    match scene.checked() {
        Ok(scene) => Ok((scene, warnings)),
        Err(faults) => Err(ReadError::invalid(faults.into_iter().map(FieldProblem::from).collect())),
    }
}

/// Warns of road users whose boxes lie across their motion.
pub(crate) fn notice_boxes(agents: &[Agent]) -> Option<ImportWarning> {
    let across = agents.iter().filter(|agent| lies_across(agent)).count();
    warning(across, "boxes-across", sentences::boxes_across)
}

/// Drops links of lanes whose ends are farther apart than about a lane's width, and reverses links whose
/// lanes meet the other way round. For readers of maps, in which such a link is a fault. Recordings keep
/// their links, so that their export equals what was read.
pub(crate) fn drop_far_links(map: &mut Shared<LaneMap>) -> impl Iterator<Item = ImportWarning> + use<> {
    let (dropped, turned) = drop_gaps(map);
    let dropped = warning(dropped, "links-dropped", sentences::links_apart);
    dropped.into_iter().chain(warning(turned, "links-turned", sentences::links_turned))
}

/// Links lanes that end where others begin, as the engine would, so that the scene and its exports have the
/// links. A map with its own links is unchanged.
pub(crate) fn join_lanes(map: &mut LaneMap) -> Option<ImportWarning> {
    if map.lanes.iter().any(|lane| !lane.successors.is_empty() || !lane.predecessors.is_empty()) {
        return None;
    }
    let links = LaneGraph::rebuilt_links(map);
    for (from, to) in &links {
        let [before, after] = [from, to].map(|i| map.lanes[*i].id.clone());
        map.lanes[*from].successors.push(after);
        map.lanes[*to].predecessors.push(before);
    }
    warning(links.len(), "no-lane-graph", sentences::lane_links_derived)
}

fn warning(count: usize, code: &'static str, message: fn(usize) -> Message) -> Option<ImportWarning> {
    (count > 0).then(|| ImportWarning::new(code, message(count)))
}

/// Whether the long side of a road user's box lies across its motion.
fn lies_across(agent: &Agent) -> bool {
    let (length_m, width_m) = (agent.size.length_m, agent.size.width_m);
    let driven = matches!(agent.agent_type, AgentType::Vehicle | AgentType::Cyclist);
    if !driven || length_m.max(width_m) < LONG * length_m.min(width_m) {
        return false;
    }
    let states = &agent.track.states;
    let along = states.iter().enumerate().filter_map(|(i, state)| {
        let way = motion(states, i)?;
        let heading = geometry::direction((*state)?.heading_rad);
        let long = if length_m > width_m { heading } else { Vec2::new(-heading.y, heading.x) };
        Some((long.dot(&way) / way.norm()).abs() < ACROSS)
    });
    let (across, count) = along.fold((0, 0), |(a, n), across| (a + usize::from(across), n + 1));
    count >= ENOUGH && 2 * across > count
}

/// Thins lines with more points than a scene holds. Returns their number.
fn thin_lines(map: &mut Shared<LaneMap>) -> usize {
    if !map.outlines().any(|(xy, _)| xy.len() > MAX_POLYLINE_POINTS) {
        return 0;
    }
    let long = |points: &Points| points.xy.len() > MAX_POLYLINE_POINTS;
    let map: &mut LaneMap = map;
    let (mut count, mut kept_of) = (0, HashMap::new());
    for lane in map.lanes.iter_mut().filter(|lane| long(&lane.points)) {
        count += 1;
        let kept = thin(&mut lane.points);
        lane.left_boundary.iter_mut().chain(&mut lane.right_boundary).for_each(|side| renumber(side, &kept));
        kept_of.insert(lane.id.clone(), kept);
    }
    if !kept_of.is_empty() {
        for lane in &mut map.lanes {
            let own = kept_of.get(&lane.id);
            for side in lane.left_neighbors.iter_mut().chain(&mut lane.right_neighbors) {
                renumber_neighbor(side, own, kept_of.get(&side.lane));
            }
        }
    }
    let areas = map.crosswalks.iter_mut().chain(&mut map.speed_bumps).chain(&mut map.driveways);
    let rings = areas.chain(&mut map.drivable);
    let rings = rings.flat_map(|area| std::iter::once(&mut area.polygon).chain(&mut area.holes));
    let lines = map.road_lines.iter_mut().chain(&mut map.road_edges).map(|line| &mut line.points);
    for points in lines.chain(rings).filter(|points| long(points)) {
        count += 1;
        thin(points);
    }
    count
}

/// Thins a line: straight parts first, then every other point. Returns the old indices of the kept points.
fn thin(points: &mut Points) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..points.xy.len()).collect();
    let mut off_m = THINNED_M;
    while kept.len() > MAX_POLYLINE_POINTS {
        let now: Vec<Vec2> = kept.iter().map(|i| points.xy[*i]).collect();
        let fewer = simplify(&now, off_m, f64::INFINITY);
        off_m *= 2.0;
        let last = kept.last().copied();
        if fewer.len() < kept.len() {
            let mut fewer = fewer.into_iter().peekable();
            kept.retain(|i| fewer.next_if_eq(&points.xy[*i]).is_some());
        } else {
            kept = kept.into_iter().step_by(2).collect();
        }
        if kept.last() != last.as_ref() {
            kept.extend(last);
        }
    }
    if let Some(z_m) = &mut points.z_m {
        *z_m = kept.iter().filter_map(|i| z_m.get(*i).copied()).collect();
    }
    points.xy = kept.iter().map(|i| points.xy[*i]).collect();
    kept
}

/// The kept point at or before a point.
fn renumbered(at: usize, kept: &[usize]) -> usize {
    kept.partition_point(|old| *old <= at).saturating_sub(1)
}

fn renumber(side: &mut Boundary, kept: &[usize]) {
    (side.from, side.to) = (renumbered(side.from, kept), renumbered(side.to, kept));
}

fn renumber_neighbor(side: &mut Neighbor, own: Option<&Vec<usize>>, other: Option<&Vec<usize>>) {
    if let Some(kept) = own {
        side.own_range = (renumbered(side.own_range.0, kept), renumbered(side.own_range.1, kept));
        side.boundaries.iter_mut().for_each(|boundary| renumber(boundary, kept));
    }
    if let Some(kept) = other {
        side.other_range = (renumbered(side.other_range.0, kept), renumbered(side.other_range.1, kept));
    }
}

/// Drops links of lanes whose ends are farther apart than about a lane's width, and reverses links that lead
/// back. Returns the number of both.
fn drop_gaps(map: &mut Shared<LaneMap>) -> (usize, usize) {
    let by_id: HashMap<&str, &Lane> = map.lanes.iter().map(|lane| (lane.id.as_str(), lane)).collect();
    let apart = |from: &Lane, to: &Lane| {
        let width_m = from.width_or_assumed_m().max(to.width_or_assumed_m()).clamp(GAP_M.0, GAP_M.1);
        let ends = from.points.xy.last().zip(to.points.xy.first());
        ends.is_some_and(|(end, start)| (end - start).norm() > width_m)
    };
    let mut gaps: HashSet<(String, String)> = HashSet::new();
    for lane in &map.lanes {
        let named = |id: &String| by_id.get(id.as_str()).copied();
        let after = lane.successors.iter().filter_map(named).map(|next| (lane, next));
        let before = lane.predecessors.iter().filter_map(named).map(|before| (before, lane));
        gaps.extend(
            after.chain(before).filter(|(a, b)| apart(a, b)).map(|(a, b)| (a.id.clone(), b.id.clone())),
        );
    }
    if gaps.is_empty() {
        return (0, 0);
    }
    let leads_back = |(from, to): &&(String, String)| {
        let lanes = by_id.get(from.as_str()).zip(by_id.get(to.as_str()));
        lanes.is_some_and(|(from, to)| goes_on(&to.points.xy, &from.points.xy))
    };
    let turned: HashSet<(String, String)> =
        gaps.iter().filter(leads_back).map(|(from, to)| (to.clone(), from.clone())).collect();
    let add = |list: &mut Vec<String>, id: &String| {
        if !list.contains(id) {
            list.push(id.clone());
        }
    };
    let mut order: Vec<&(String, String)> = turned.iter().collect();
    order.sort_unstable();
    for lane in &mut map.lanes {
        let id = lane.id.clone();
        lane.successors.retain(|next| !gaps.contains(&(id.clone(), next.clone())));
        lane.predecessors.retain(|before| !gaps.contains(&(before.clone(), id.clone())));
        for (from, to) in &order {
            if *from == id {
                add(&mut lane.successors, to);
            }
            if *to == id {
                add(&mut lane.predecessors, from);
            }
        }
    }
    (gaps.len() - turned.len(), turned.len())
}

/// Whether a line begins at the end of another one, in about the same direction.
fn goes_on(before: &[Vec2], after: &[Vec2]) -> bool {
    let ([.., a, end], [start, b, ..]) = (before, after) else { return false };
    let ways = [end - a, b - start].map(|way| way / way.norm().max(1e-9));
    (start - end).norm() < MEETING_M && ways[0].dot(&ways[1]) > 0.7
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{State, Subtype};

    fn line(count: usize) -> Points {
        let p = |i: usize| Vec2::new(i as f64 * 0.1, (i as f64 * 0.1).sin());
        Points { xy: (0..count).map(p).collect(), z_m: Some((0..count).map(|i| i as f64).collect()) }
    }

    #[test]
    fn long_lines_are_thinned_with_what_refers_to_their_points() {
        let mut lane = Lane::street("1", line(9_000));
        lane.left_boundary.push(Boundary { line: "7".into(), from: 0, to: 8_999, kind: None });
        let mut other = Lane::street("2", line(50));
        let range = (0, 8_999);
        other.left_neighbors.push(Neighbor {
            lane: "1".into(),
            own_range: (0, 49),
            other_range: range,
            boundaries: Vec::new(),
        });
        let map = LaneMap { lanes: vec![lane, other], ..LaneMap::default() };
        let (scene, warnings) = checked(Scene::bare("a", map, Vec::new()), Vec::new()).unwrap();
        let codes: Vec<&str> = warnings.iter().map(|warning| warning.code).collect();
        assert_eq!(codes, ["lines-thinned"]);
        let [lane, other] = &scene.map.lanes[..] else { unreachable!("two lanes") };
        let points = &lane.points;
        assert!((2..=MAX_POLYLINE_POINTS).contains(&points.xy.len()));
        let last = points.xy.len() - 1;
        assert_eq!(
            (points.xy[last], points.z_m.as_ref().map(|z| z[last])),
            (line(9_000).xy[8_999], Some(8_999.0))
        );
        assert_eq!((lane.left_boundary[0].to, other.left_neighbors[0].other_range.1), (last, last));
    }

    #[test]
    fn links_over_gaps_are_dropped() {
        let street = |id: &str, from: f64, to: f64| {
            let points: Vec<Vec2> = vec![Vec2::new(from, 0.0), Vec2::new(to, 0.0)];
            Lane::street(id, Points::from(points))
        };
        let mut lanes = vec![street("a", 0.0, 50.0), street("b", 52.0, 90.0), street("c", 95.0, 120.0)];
        lanes[0].successors = vec!["b".into(), "c".into(), "missing".into()];
        lanes[2].predecessors = vec!["b".into()];
        let mut scene = Scene::bare("a", LaneMap { lanes, ..LaneMap::default() }, Vec::new());
        assert_eq!(drop_gaps(&mut scene.map), (2, 0));
        assert_eq!(scene.map.lanes[0].successors, ["b", "missing"]);
        assert!(scene.map.lanes[2].predecessors.is_empty());
    }

    #[test]
    fn links_that_lead_back_are_turned() {
        let street = |id: &str, x: [f64; 2]| {
            Lane::street(id, x.iter().map(|x| Vec2::new(*x, 0.0)).collect::<Vec<_>>())
        };
        let mut lanes = vec![street("a", [50.0, 90.0]), street("b", [0.0, 50.0]), street("c", [90.0, 0.0])];
        // `a` follows `b`; `c` ends where `b` begins, but comes from the other side.
        lanes[0].successors = vec!["b".into()];
        lanes[1].predecessors = vec!["a".into()];
        lanes[1].successors = vec!["c".into()];
        let mut map = Shared::from(LaneMap { lanes, ..LaneMap::default() });
        let codes: Vec<&str> = drop_far_links(&mut map).map(|warning| warning.code).collect();
        assert_eq!(codes, ["links-dropped", "links-turned"]);
        assert_eq!(
            (map.lanes[1].successors.as_slice(), &map.lanes[0].predecessors[0]),
            (&["a".to_owned()][..], &"b".into())
        );
        assert!(map.lanes[0].successors.is_empty() && map.lanes[1].predecessors.is_empty());
    }

    #[test]
    fn boxes_across_their_motion_are_noticed() {
        let user = |length_m: f64, width_m: f64, heading_rad: f64| {
            let state =
                |i: i32| Some(State { x_m: f64::from(i), heading_rad, vx_mps: 10.0, ..State::default() });
            let mut agent = Agent::bare("1", AgentType::Vehicle, Subtype::Car, (0..9).map(state).collect());
            (agent.size.length_m, agent.size.width_m) = (length_m, width_m);
            agent
        };
        assert!(!lies_across(&user(4.5, 1.8, 0.0)) && !lies_across(&user(4.5, 1.8, 3.1)));
        assert!(lies_across(&user(1.8, 4.5, 0.0)) && lies_across(&user(4.5, 1.8, 1.5)));
        assert!(!lies_across(&user(1.0, 1.1, 0.0)), "one that is as long as wide says nothing");
    }
}
