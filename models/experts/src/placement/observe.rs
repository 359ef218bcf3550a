//! What a recorded scene teaches: which cells are taken, and how those in them stand and move.

use super::model::kinds;
use super::pose::{measure, pose_context};
use super::region::Region;
use super::sites::{FACTS, LEADER, Site, SiteKind, Sites, leader_class};
use super::speed::{allowed_mps, drive_context, leader_ahead, speed_class, usual_mps, walk_context};
use scene::geometry::obb::OrientedBox;
use scene::routes::speed::Obstacle;
use scene::routes::{LaneGraph, LaneHit};
use scene::{Agent, AgentType, Scene, State, Vec2, wrap_angle};
use std::collections::BTreeMap;

/// Half a side of the square about the ego in which everybody is recorded, metres. Synthetic windows keep
/// who comes within 60 m.
pub const SEEN_M: f64 = 60.0;
/// A road user farther from a crosswalk's middle line than its half width and this is not on it, metres.
const CROSSWALK_M: f64 = 0.5;
/// Farthest from a road edge that still counts as its pavement, metres.
const PAVEMENT_M: f64 = 7.0;
/// Farthest centre of a parked vehicle from the lane it stands beside, metres.
const PARKED_M: f64 = 12.0;
/// A vehicle that moves less than this in the recording is parked when it stands off the lanes, metres.
const PARKED_EXTENT_M: f64 = 1.0;

/// Cells alike: type, kind and facts; with their metres (or driveways) and the road users in them.
pub type CellCounts = BTreeMap<(AgentType, SiteKind, [u8; FACTS]), (f64, f64)>;

/// All that one scene teaches at one step.
#[derive(Clone, Debug, Default)]
pub struct Observation {
    /// Cells.
    pub cells: CellCounts,
    /// Offsets across the line: type, context, value.
    pub lateral: Vec<(AgentType, u16, f64)>,
    /// Headings against the line: type, context, value.
    pub heading: Vec<(AgentType, u16, f64)>,
    /// Boxes: type, kind, length and width.
    pub sizes: Vec<(AgentType, SiteKind, f64, f64)>,
    /// Speed classes: type, context, class.
    pub speeds: Vec<(AgentType, u16, usize)>,
    /// Road users that are in no cell, by type: nothing is learned from them.
    pub nowhere: BTreeMap<AgentType, usize>,
}

/// A road user at the step.
struct Seen<'a> {
    agent: &'a Agent,
    state: State,
    site: Option<usize>,
    /// Lane and arc length for those who drive.
    lane: Option<(usize, f64)>,
    in_square: bool,
    ego: bool,
}

/// Looks at a scene at one step. Cells and road users count within [`SEEN_M`] of the ego alone.
///
/// The ego itself and its cell are left out: windows are cut about road users, so one is always there, and
/// the rest is distributed as if it were not (Slivnyak's theorem).
pub fn observe(scene: &Scene, graph: &LaneGraph, step: usize) -> Observation {
    let ego = scene.agents.iter().find(|a| a.role.as_deref() == Some("ego"));
    let center = ego.and_then(|a| a.state_at(scene.time.now_step)).map_or(Vec2::zeros(), |s| s.position());
    let square = |p: Vec2| (p - center).amax() < SEEN_M;
    let region = Region::Circle { center, radius_m: 1.5 * SEEN_M };
    let mut sites = Sites::new(scene, graph, step, &region);
    let mut seen: Vec<Seen<'_>> = Vec::new();
    for agent in &scene.agents {
        let Some(state) = agent.state_at(step) else { continue };
        let (site, lane) = assign(&sites, agent, &state);
        let in_square = square(state.position());
        seen.push(Seen { agent, state, site, lane, in_square, ego: agent.role.as_deref() == Some("ego") });
    }
    set_leaders(&mut sites, &seen);
    let mut out = Observation::default();
    count_cells(&sites, &seen, square, &mut out);
    let obstacles: Vec<Obstacle> = seen
        .iter()
        .map(|s| Obstacle {
            outline: OrientedBox::of_state(&s.state, &s.agent.size),
            speed_mps: s.state.speed_mps(),
        })
        .collect();
    for (i, one) in seen.iter().enumerate().filter(|(_, s)| s.in_square) {
        let Some(at) = one.site else {
            *out.nowhere.entry(one.agent.agent_type).or_default() += 1;
            continue;
        };
        learn_from(&sites, one, i, &sites.all[at], &obstacles, &mut out);
    }
    out
}

/// Facts about leaders: every lane cell's distance to the nearest road user ahead of it.
fn set_leaders(sites: &mut Sites<'_>, seen: &[Seen<'_>]) {
    let mut gaps = vec![f64::INFINITY; sites.all.len()];
    for (lane, s_m) in seen.iter().filter_map(|s| s.lane) {
        sites.behind(lane, s_m, |at, gap_m| gaps[at] = gaps[at].min(gap_m));
    }
    for (site, gap_m) in sites.all.iter_mut().zip(gaps).filter(|(s, _)| s.kind == SiteKind::Lane) {
        site.facts[LEADER] = leader_class(gap_m, site.ahead.queues());
    }
}

fn count_cells(sites: &Sites<'_>, seen: &[Seen<'_>], square: impl Fn(Vec2) -> bool, out: &mut Observation) {
    let mut counts: BTreeMap<(AgentType, usize), f64> = BTreeMap::new();
    let own = seen.iter().find(|s| s.ego).and_then(|s| s.site);
    for one in seen.iter().filter(|s| s.in_square && !s.ego) {
        if let Some(at) = one.site {
            *counts.entry((one.agent.agent_type, at)).or_default() += 1.0;
        }
    }
    for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
        for (at, site) in sites.all.iter().enumerate() {
            if Some(at) == own || !square(site.center) || !may_hold(sites, site, agent_type) {
                continue;
            }
            let cell = out.cells.entry((agent_type, site.kind, site.facts)).or_default();
            cell.0 += site.extent();
            cell.1 += counts.get(&(agent_type, at)).copied().unwrap_or(0.0);
        }
    }
}

/// The type is looked for in such cells.
pub(super) fn may_hold(sites: &Sites<'_>, site: &Site, agent_type: AgentType) -> bool {
    let lane_fits = || sites.graph.lanes().get(site.line).is_some_and(|l| l.carries(agent_type));
    kinds(agent_type).contains(&site.kind) && (site.kind != SiteKind::Lane || lane_fits())
}

fn learn_from(
    sites: &Sites<'_>,
    one: &Seen<'_>,
    own: usize,
    site: &Site,
    obstacles: &[Obstacle],
    out: &mut Observation,
) {
    let (agent_type, size) = (one.agent.agent_type, one.agent.size);
    let context = pose_context(sites, site);
    let pose = measure(sites, site, agent_type, size, one.state.position(), one.state.heading_rad);
    if let Some((lateral, heading_rad)) = pose {
        out.heading.push((agent_type, context, heading_rad));
        out.lateral.extend(lateral.map(|m| (agent_type, context, m)));
    }
    out.sizes.push((agent_type, site.kind, size.length_m, size.width_m));
    let speed_mps = one.state.speed_mps();
    if let Some((lane, s_m)) = one.lane {
        let ahead = sites.lights.ahead(sites.graph, lane, s_m);
        let others: Vec<Obstacle> =
            obstacles.iter().enumerate().filter(|(i, _)| *i != own).map(|(_, o)| *o).collect();
        let leader = leader_ahead(sites.graph, lane, s_m, &obstacles[own].outline, &others);
        let unit_mps = allowed_mps(sites.graph, lane, s_m, agent_type);
        let context = drive_context(ahead, leader.map(|l| (l.gap_m, l.speed_mps)));
        out.speeds.push((agent_type, context, speed_class(speed_mps, unit_mps)));
    } else if agent_type != AgentType::Vehicle {
        out.speeds.push((agent_type, walk_context(site.kind), speed_class(speed_mps, usual_mps(agent_type))));
    }
}

/// The lane that somebody drives on: near its middle and along it.
pub(super) fn driven_lane(graph: &LaneGraph, agent_type: AgentType, state: &State) -> Option<LaneHit> {
    let turn = |hit: &LaneHit| wrap_angle(state.heading_rad - hit.heading_rad).abs();
    let on = |hit: &LaneHit| {
        let half_m =
            0.5 * graph.lanes()[hit.lane].width_m + if agent_type == AgentType::Cyclist { 0.8 } else { 0.2 };
        hit.distance_m < half_m && turn(hit) < 1.0
    };
    let hits = graph.nearest_for(state.position(), 4.0, agent_type).into_iter().filter(on);
    hits.min_by(|a, b| {
        let cost = |h: &LaneHit| h.distance_m + 3.0 * turn(h);
        cost(a).total_cmp(&cost(b)).then(a.lane.cmp(&b.lane))
    })
}

/// The cell somebody is in, and the lane if they drive.
fn assign(sites: &Sites<'_>, agent: &Agent, state: &State) -> (Option<usize>, Option<(usize, f64)>) {
    let agent_type = agent.agent_type;
    if matches!(agent_type, AgentType::Vehicle | AgentType::Cyclist)
        && let Some(hit) = driven_lane(sites.graph, agent_type, state)
    {
        return (sites.lane_site(hit.lane, hit.s_m), Some((hit.lane, hit.s_m)));
    }
    let position = state.position();
    let site = match agent_type {
        AgentType::Vehicle if agent.track.extent_m() < PARKED_EXTENT_M => {
            sites.driveway_at(position).or_else(|| kerb_at(sites, position))
        }
        AgentType::Pedestrian | AgentType::Cyclist => walk_at(sites, position),
        _ => None,
    };
    (site, None)
}

/// The kerb cell nearest to a point beside its lane.
fn kerb_at(sites: &Sites<'_>, position: Vec2) -> Option<usize> {
    nearest(
        sites,
        position,
        |site| site.kind == SiteKind::Kerb,
        |site, foot| {
            let away = site.side * foot.lateral_m;
            let kerb_m = 0.5 * sites.graph.lanes()[site.line].width_m + site.free_m;
            (away > 0.0 && away < PARKED_M && away < kerb_m + 0.5).then_some(away)
        },
    )
}

/// The crosswalk cell that holds a point, else the pavement cell nearest to it.
fn walk_at(sites: &Sites<'_>, position: Vec2) -> Option<usize> {
    let on_crosswalk = nearest(
        sites,
        position,
        |s| s.kind == SiteKind::Crosswalk,
        |site, foot| {
            let half_m = 0.5 * sites.graph.lanes()[site.line].width_m;
            (foot.distance_m < half_m + CROSSWALK_M).then_some(foot.distance_m)
        },
    );
    on_crosswalk.or_else(|| {
        nearest(
            sites,
            position,
            |s| s.kind == SiteKind::Pavement,
            |site, foot| {
                let outside_m = if site.on_lane { foot.distance_m } else { site.side * foot.lateral_m };
                (outside_m > -2.0 && foot.distance_m < PAVEMENT_M).then_some(foot.distance_m)
            },
        )
    })
}

/// The cell with the least cost among those near a point whose stretch of line passes it.
fn nearest(
    sites: &Sites<'_>,
    position: Vec2,
    wanted: impl Fn(&Site) -> bool,
    cost: impl Fn(&Site, &scene::routes::Foot) -> Option<f64>,
) -> Option<usize> {
    let near = |site: &Site| (site.center - position).norm() < PARKED_M + site.extent();
    let candidates = sites.all.iter().enumerate().filter(|(_, s)| wanted(s) && near(s));
    let costs = candidates.filter_map(|(at, site)| {
        let foot = sites.path(site)?.project_between(position, site.from_m, site.to_m);
        Some((cost(site, &foot)?, at))
    });
    costs.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, at)| at)
}
