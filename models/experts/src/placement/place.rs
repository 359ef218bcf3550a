//! Places road users one at a time.

use super::model::{PlacementModel, SPEED_STEP, TypeModel};
use super::observe::{driven_lane, may_hold};
use super::pose::{Pose, draw_pose, draw_size};
use super::random::{self, Weights};
use super::region::Region;
use super::sites::{LEADER, Site, SiteKind, Sites, leader_class};
use super::speed::{
    ANY_CONTEXT, allowed_mps, drive_context, group_context, leader_ahead, usual_mps, walk_context,
};
use super::stops::{Ahead, StopKind};
use crate::request::{Cancel, GenerateError};
use scene::STANDING_MPS;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::geometry::{direction, wrap_angle};
use scene::limits::Limits;
use scene::random::Stream;
use scene::routes::LaneGraph;
use scene::routes::speed::Obstacle;
use scene::{
    Agent, AgentId, AgentType, Conditions, MAX_AGENTS, Scene, Size, Start, State, Subtype, Track, Vec2,
};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::f64::consts::{FRAC_PI_4, PI};
use std::sync::Arc;

/// Most road users asked for by count.
pub const MAX_COUNT: usize = MAX_AGENTS;
/// Highest density, road users a kilometre of lane.
pub const MAX_PER_LANE_KM: f64 = 200.0;
/// Greatest room along the lane that may be asked for, metres.
pub const MAX_GAP_M: f64 = 50.0;
/// Room around every box, metres.
const MARGIN_M: f64 = 0.1;
/// Draws of a cell for one road user before it is given up.
const TRIES: usize = 128;
/// Draws of a pose in one cell that may fail before the cell counts as full.
const CELL_TRIES: u8 = 4;
/// Braking that starts may ask of a driver at once, m/s2: no start is an emergency.
const BRAKE_MPS2: f64 = 3.0;
/// Room that a driver keeps to a red light's stop line, metres.
const STOP_LINE_M: f64 = 0.3;
/// Share of a lane's half width on which nobody parks or stands.
const BAND: f64 = 0.9;

/// How many road users.
#[derive(Clone, Debug, PartialEq)]
pub enum Amount {
    /// For each kilometre of lane for motor vehicles in the region, junctions left out.
    PerLaneKm(f64),
    /// So many in all.
    Count(usize),
    /// So many of each type, whatever [`PlaceRequest::types`] says.
    Each(BTreeMap<AgentType, usize>),
}

/// How road users are placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[schemars(rename = "PlacementMethod")]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// By learned rates and distributions.
    Model,
    /// Even along lanes, at the speed limit: where there are no weights, and to compare with.
    LaneSampler,
}

/// One call of placement.
#[derive(Clone, Debug)]
pub struct PlaceRequest {
    /// Map, signals, and road users that may be kept.
    pub scene: Arc<Scene>,
    /// Scene step at which the placed start; signals and kept road users are as they are then.
    pub step: usize,
    /// Where centres may lie.
    pub region: Region,
    /// How many.
    pub amount: Amount,
    /// Share of each type; sums to one.
    pub types: BTreeMap<AgentType, f64>,
    /// Road users of the scene that stay; `None` keeps all. The rest are as if they were not there.
    pub keep: Option<BTreeSet<AgentId>>,
    /// Repeats the answer.
    pub seed: u64,
    /// Least room between those who drive, along the lane, metres.
    pub min_gap_m: f64,
}

impl PlaceRequest {
    /// The defaults of `POST /v1/place` for a scene.
    pub fn new(scene: Arc<Scene>) -> Self {
        let types = [(AgentType::Vehicle, 0.8), (AgentType::Pedestrian, 0.15), (AgentType::Cyclist, 0.05)];
        Self {
            scene,
            step: 0,
            region: Region::Everywhere,
            amount: Amount::PerLaneKm(12.0),
            types: BTreeMap::from(types),
            keep: None,
            seed: 0,
            min_gap_m: 2.0,
        }
    }
}

/// The answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// New road users with one state at the step and the same start as a condition; goals are free.
    pub agents: Vec<Agent>,
    /// Those that were asked for and found no place, by type.
    pub unplaced: BTreeMap<AgentType, usize>,
    /// Why, in one sentence; `None` when all were placed.
    pub reason: Option<String>,
    /// How they were placed.
    pub method: Method,
}

/// Somebody who was placed, before the speed is known.
struct Placed {
    agent_type: AgentType,
    subtype: Subtype,
    size: Size,
    pose: Pose,
    kind: SiteKind,
    /// Lane of those who drive.
    lane: Option<usize>,
}

struct Placing<'a> {
    request: &'a PlaceRequest,
    model: Option<&'a PlacementModel>,
    sites: Sites<'a>,
    /// Distance from each lane cell to the nearest road user ahead, metres.
    gaps: Vec<f64>,
    rates: BTreeMap<AgentType, Weights>,
    /// Failed draws by type and cell.
    failed: BTreeMap<AgentType, Vec<u8>>,
    /// Kept road users, then placed ones in order.
    obstacles: Vec<Obstacle>,
    /// The obstacle drives on a lane.
    driving: Vec<bool>,
    kept: usize,
    placed: Vec<Placed>,
}

/// Places road users by the model, or evenly along lanes without one. Equal requests give equal answers.
///
/// # Errors
/// An unknown id in `keep`, and [`GenerateError::Cancelled`].
pub fn place(
    model: Option<&PlacementModel>,
    graph: &LaneGraph,
    request: &PlaceRequest,
    cancel: &Cancel,
) -> Result<Placement, GenerateError> {
    let scene = &request.scene;
    let unknown = request.keep.iter().flatten().find(|id| scene.agent(id).is_none());
    if let Some(id) = unknown {
        return Err(GenerateError::UnknownAgent(id.clone()));
    }
    let kept: Vec<&Agent> =
        scene.agents.iter().filter(|a| request.keep.as_ref().is_none_or(|k| k.contains(&a.id))).collect();
    let mut placing = Placing::new(model, graph, request, &kept);
    let wanted = request.wanted(placing.sites.lane_km(&request.region));
    let mut free = MAX_AGENTS.saturating_sub(kept.len());
    let (mut unplaced, mut full) = (BTreeMap::new(), false);
    for (&agent_type, &count) in &wanted {
        let asked = count.min(free);
        full |= asked < count;
        let done = placing.place_type(agent_type, asked, cancel)?;
        free -= done;
        if done < count {
            unplaced.insert(agent_type, count - done);
        }
    }
    let speeds = placing.speeds();
    let reason = reason(&unplaced, full);
    let method = if model.is_some() { Method::Model } else { Method::LaneSampler };
    Ok(Placement { agents: placing.agents(&speeds), unplaced, reason, method })
}

fn reason(unplaced: &BTreeMap<AgentType, usize>, full: bool) -> Option<String> {
    if unplaced.is_empty() {
        return None;
    }
    let name = |t: &AgentType, n: usize| {
        let one = match t {
            AgentType::Vehicle => "vehicle",
            AgentType::Pedestrian => "pedestrian",
            AgentType::Cyclist => "cyclist",
            AgentType::Other => "road user",
        };
        format!("{n} {one}{}", if n == 1 { "" } else { "s" })
    };
    let who: Vec<String> = unplaced.iter().map(|(t, n)| name(t, *n)).collect();
    let why = if full {
        format!("a scene holds {MAX_AGENTS} road users")
    } else {
        "no free place found".to_owned()
    };
    Some(format!("{why} for {}", who.join(", ")))
}

impl PlaceRequest {
    /// How many of each type, by largest remainder; vehicles first.
    fn wanted(&self, lane_km: f64) -> BTreeMap<AgentType, usize> {
        let total = match &self.amount {
            Amount::Each(each) => return each.clone(),
            Amount::Count(n) => *n,
            Amount::PerLaneKm(density) => (density * lane_km).round().min(1e6) as usize,
        };
        let exact = |share: f64| share * total as f64;
        let mut counts: BTreeMap<AgentType, usize> =
            self.types.iter().map(|(t, share)| (*t, (exact(*share) + 1e-9) as usize)).collect();
        let mut rest: Vec<(f64, AgentType)> = self
            .types
            .iter()
            .map(|(t, share)| (exact(*share) - (exact(*share) + 1e-9).floor(), *t))
            .collect();
        rest.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let missing = total.saturating_sub(counts.values().sum());
        for (_, agent_type) in rest.into_iter().take(missing) {
            *counts.entry(agent_type).or_default() += 1;
        }
        counts
    }
}

/// Positions, headings and speeds as they are written: rounded, so that what is checked is what is sent.
fn rounded(value: f64, parts: f64) -> f64 {
    (value * parts).round() / parts
}

impl<'a> Placing<'a> {
    fn new(
        model: Option<&'a PlacementModel>,
        graph: &'a LaneGraph,
        request: &'a PlaceRequest,
        kept: &[&Agent],
    ) -> Self {
        let sites = Sites::new(&request.scene, graph, request.step, &request.region);
        let (mut obstacles, mut driving) = (Vec::new(), Vec::new());
        let mut placing = Self {
            request,
            model,
            gaps: vec![f64::INFINITY; sites.all.len()],
            sites,
            rates: BTreeMap::new(),
            failed: BTreeMap::new(),
            obstacles: Vec::new(),
            driving: Vec::new(),
            kept: 0,
            placed: Vec::new(),
        };
        let mut lanes = Vec::new();
        for agent in kept {
            let Some(state) = start_of(agent, request.step) else { continue };
            let size = Size {
                length_m: agent.conditions.length_m.unwrap_or(agent.size.length_m),
                width_m: agent.conditions.width_m.unwrap_or(agent.size.width_m),
                ..agent.size
            };
            let lane = driven_lane(graph, agent.agent_type, &state);
            obstacles.push(Obstacle {
                outline: OrientedBox::of_state(&state, &size),
                speed_mps: state.speed_mps(),
            });
            driving.push(lane.is_some());
            lanes.extend(lane.map(|hit| (hit.lane, hit.s_m)));
        }
        placing.kept = obstacles.len();
        (placing.obstacles, placing.driving) = (obstacles, driving);
        for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
            let rates: Vec<f64> =
                placing.sites.all.iter().map(|site| placing.rate(agent_type, site)).collect();
            placing.failed.insert(agent_type, vec![0; rates.len()]);
            placing.rates.insert(agent_type, Weights::new(&rates));
        }
        for (lane, s_m) in lanes {
            placing.lead(lane, s_m);
        }
        placing
    }

    fn of_type(&self, agent_type: AgentType) -> Option<&'a TypeModel> {
        self.model.and_then(|m| m.types.get(&agent_type))
    }

    /// How likely a cell is drawn for a type.
    fn rate(&self, agent_type: AgentType, site: &Site) -> f64 {
        let reach_m = 0.5 * site.extent() + 20.0;
        let fits =
            may_hold(&self.sites, site, agent_type) && self.request.region.may_hold(site.center, reach_m);
        if !fits {
            return 0.0;
        }
        if self.model.is_none() {
            let parks = matches!(site.kind, SiteKind::Kerb | SiteKind::Driveway);
            let rides = agent_type != AgentType::Cyclist || site.kind == SiteKind::Lane;
            return if rides && !parks { site.extent() } else { 0.0 };
        }
        self.of_type(agent_type).and_then(|m| m.rates.get(&site.kind)).map_or(0.0, |rate| rate.of(site))
    }

    /// Somebody drives at `s_m` of a lane: cells behind have a leader.
    fn lead(&mut self, lane: usize, s_m: f64) {
        let mut nearer = Vec::new();
        self.sites.behind(lane, s_m, |at, gap_m| {
            if gap_m < self.gaps[at] {
                nearer.push((at, gap_m));
            }
        });
        for (at, gap_m) in nearer {
            self.gaps[at] = self.gaps[at].min(gap_m);
            let site = &mut self.sites.all[at];
            let class = leader_class(self.gaps[at], site.ahead.queues());
            if site.facts[LEADER] == class {
                continue;
            }
            site.facts[LEADER] = class;
            for agent_type in [AgentType::Vehicle, AgentType::Cyclist] {
                let full = self.failed.get(&agent_type).is_some_and(|f| f[at] >= CELL_TRIES);
                let rate = if full { 0.0 } else { self.rate(agent_type, &self.sites.all[at]) };
                if let Some(rates) = self.rates.get_mut(&agent_type) {
                    rates.set(at, rate);
                }
            }
        }
    }

    /// Places up to `count` of a type; how many found a place.
    fn place_type(
        &mut self,
        agent_type: AgentType,
        count: usize,
        cancel: &Cancel,
    ) -> Result<usize, GenerateError> {
        let mut done = 0;
        for number in 0..count {
            if cancel.is_cancelled() {
                return Err(GenerateError::Cancelled);
            }
            let mut stream = random::stream(self.request.seed, purpose(agent_type), number);
            done += usize::from(self.place_one(agent_type, &mut stream));
        }
        Ok(done)
    }

    fn place_one(&mut self, agent_type: AgentType, stream: &mut Stream) -> bool {
        for _ in 0..TRIES {
            let Some(at) = self.rates.get(&agent_type).and_then(|rates| rates.draw(stream)) else {
                return false;
            };
            if let Some(placed) = self.draw(agent_type, at, stream) {
                self.obstacles.push(Obstacle { outline: placed.outline(), speed_mps: 0.0 });
                self.driving.push(placed.lane.is_some());
                let lane = placed.lane.map(|lane| (lane, placed.pose.s_m));
                self.placed.push(placed);
                if let Some((lane, s_m)) = lane {
                    self.lead(lane, s_m);
                }
                return true;
            }
            let failed = self.failed.get_mut(&agent_type).and_then(|f| f.get_mut(at));
            if let Some(failed) = failed {
                *failed += 1;
                if *failed >= CELL_TRIES
                    && let Some(rates) = self.rates.get_mut(&agent_type)
                {
                    rates.set(at, 0.0);
                }
            }
        }
        false
    }

    /// A road user in a cell, if one that fits is drawn.
    fn draw(&self, agent_type: AgentType, at: usize, stream: &mut Stream) -> Option<Placed> {
        let site = &self.sites.all[at];
        let (size, subtype, mut pose) = match self.of_type(agent_type) {
            Some(model) => {
                let (size, subtype) = draw_size(model, agent_type, site.kind, stream);
                (size, subtype, draw_pose(&self.sites, site, model, agent_type, size, stream)?)
            }
            None => {
                let subtype = Subtype::default();
                let size = Size::default_for(agent_type, subtype);
                (size, subtype, even_pose(&self.sites, site, agent_type, stream)?)
            }
        };
        pose.position = pose.position.map(|v| rounded(v, 1e3));
        pose.heading_rad = wrap_angle(rounded(pose.heading_rad, 1e4));
        let lane = (site.kind == SiteKind::Lane).then_some(site.line);
        let placed = Placed { agent_type, subtype, size, pose, kind: site.kind, lane };
        self.fits(&placed).then_some(placed)
    }

    fn fits(&self, placed: &Placed) -> bool {
        let inside = self.request.region.contains(placed.pose.position)
            && placed.pose.position.amax() <= scene::MAX_COORDINATE_M;
        inside && self.is_free(placed) && (self.model.is_none() || self.is_sensible(placed))
    }

    /// Nobody is too near.
    fn is_free(&self, placed: &Placed) -> bool {
        let outline = placed.outline();
        let near = outline.grown(MARGIN_M);
        // Room along the lane counts between those who drive the same way.
        let gap_m = self.request.min_gap_m.max(MARGIN_M);
        let long = OrientedBox::new(
            outline.center(),
            outline.half_length_m() + gap_m,
            near.half_width_m(),
            outline.heading_rad(),
        );
        self.obstacles.iter().zip(&self.driving).all(|(other, driving)| {
            let turn = wrap_angle(other.outline.heading_rad() - outline.heading_rad()).abs();
            let follows = *driving && placed.lane.is_some() && turn < FRAC_PI_4;
            !overlaps(if follows { &long } else { &near }, &other.outline, 0.0)
        })
    }

    /// Drivers wait at red lights, nobody parks on a lane, and people stand on the pavement.
    fn is_sensible(&self, placed: &Placed) -> bool {
        let outline = placed.outline();
        match placed.kind {
            SiteKind::Lane => {
                match placed.lane.map(|lane| self.sites.lights.ahead(self.sites.graph, lane, placed.pose.s_m))
                {
                    Some(Ahead::Stop(StopKind::Red, m)) => m >= outline.half_length_m() + STOP_LINE_M,
                    _ => true,
                }
            }
            SiteKind::Kerb | SiteKind::Driveway => {
                let nose = outline.forward() * outline.half_length_m();
                let points = [outline.center() + nose, outline.center(), outline.center() - nose];
                points.iter().all(|p| !self.on_lane(*p))
            }
            SiteKind::Pavement => !self.on_lane(outline.center()),
            SiteKind::Crosswalk => true,
        }
    }

    /// The point lies on the band that traffic of some lane uses.
    fn on_lane(&self, point: Vec2) -> bool {
        let drives = |_: usize, l: &scene::routes::GraphLane| {
            l.carries(AgentType::Vehicle) || l.carries(AgentType::Cyclist)
        };
        let hits = self.sites.graph.nearest_lanes(point, 4.0, drives);
        hits.iter().any(|h| h.distance_m < BAND * 0.5 * self.sites.graph.lanes()[h.lane].width_m)
    }

    /// Speed of everyone placed, m/s: those nearest to a conflict first, leaders before followers.
    fn speeds(&mut self) -> Vec<f64> {
        let mut order: Vec<(f64, usize)> = Vec::new();
        for (i, placed) in self.placed.iter().enumerate() {
            let ahead = placed.lane.map(|l| self.sites.lights.ahead(self.sites.graph, l, placed.pose.s_m));
            let distance_m = match ahead {
                Some(Ahead::Inside(_)) => 0.0,
                Some(ahead) => ahead.stop_m(),
                None => 0.0,
            };
            // Until it is known, a leader is taken to drive.
            self.obstacles[self.kept + i].speed_mps = if placed.lane.is_some() { 5.0 } else { 0.0 };
            order.push((distance_m, i));
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut begun = HashSet::new();
        for (_, i) in order {
            self.settle(i, &mut begun);
        }
        self.obstacles[self.kept..].iter().map(|o| o.speed_mps).collect()
    }

    /// Draws the speed of one road user, after that of the leader. A ring of leaders is cut where it began.
    fn settle(&mut self, i: usize, begun: &mut HashSet<usize>) {
        if !begun.insert(i) {
            return;
        }
        let placed = &self.placed[i];
        let mut stream =
            random::stream(self.request.seed, &format!("{} speed", purpose(placed.agent_type)), i);
        let own = self.kept + i;
        let speed_mps = match placed.lane {
            Some(lane) => {
                let s_m = placed.pose.s_m;
                let outline = self.obstacles[own].outline;
                // A leader's path begins at the own centre, where nothing else can be; the own box is too
                // near to count as ahead.
                let leader = leader_ahead(self.sites.graph, lane, s_m, &outline, &self.obstacles);
                if let Some(index) = leader.and_then(|l| l.index.checked_sub(self.kept)) {
                    self.settle(index, begun);
                }
                let leader = leader.map(|l| {
                    let aligned = l.speed_mps > 0.0;
                    (l.gap_m, if aligned { self.obstacles[l.index].speed_mps } else { 0.0 })
                });
                self.drive_speed(i, lane, leader, &mut stream)
            }
            None => self.walk_speed(i, &mut stream),
        };
        self.obstacles[own].speed_mps = rounded(speed_mps, 1e3);
    }

    fn drive_speed(&self, i: usize, lane: usize, leader: Option<(f64, f64)>, stream: &mut Stream) -> f64 {
        let placed = &self.placed[i];
        let limits = Limits::of(placed.agent_type, placed.subtype, placed.size.length_m);
        let Some(model) = self.of_type(placed.agent_type) else {
            let limit_mps = self.sites.graph.lanes()[lane].speed_limit_mps;
            let most = if placed.agent_type == AgentType::Cyclist { 5.0 } else { limits.speed_mps };
            return limit_mps.min(most);
        };
        let ahead = self.sites.lights.ahead(self.sites.graph, lane, placed.pose.s_m);
        let unit_mps = allowed_mps(self.sites.graph, lane, placed.pose.s_m, placed.agent_type);
        let mut most = limits.speed_mps;
        let brakes_from =
            |room_m: f64, to_mps: f64| (to_mps * to_mps + 2.0 * BRAKE_MPS2 * room_m.max(0.0)).sqrt();
        if let Some((gap_m, speed_mps)) = leader {
            most = most.min(brakes_from(gap_m - 1.0, speed_mps));
        }
        if let Ahead::Stop(StopKind::Red, m) = ahead {
            most = most.min(brakes_from(m - 0.5 * placed.size.length_m - STOP_LINE_M, 0.0));
        }
        let context = drive_context(ahead, leader);
        let rows = [context, group_context(context), ANY_CONTEXT];
        drawn_speed(model, &rows, unit_mps, most, stream)
    }

    fn walk_speed(&self, i: usize, stream: &mut Stream) -> f64 {
        let placed = &self.placed[i];
        if placed.agent_type == AgentType::Vehicle {
            return 0.0;
        }
        let most = Limits::of(placed.agent_type, placed.subtype, placed.size.length_m).speed_mps;
        let unit_mps = usual_mps(placed.agent_type);
        match self.of_type(placed.agent_type) {
            Some(model) => drawn_speed(model, &[walk_context(placed.kind)], unit_mps, most, stream),
            None => 0.7 * unit_mps,
        }
    }

    /// The placed as road users of the scene, with ids that are free there.
    fn agents(&self, speeds: &[f64]) -> Vec<Agent> {
        let taken: HashSet<&str> = self.request.scene.agents.iter().map(|a| a.id.as_str()).collect();
        let mut ids = (1..).map(|n: usize| format!("p{n}")).filter(|id| !taken.contains(id.as_str()));
        let placed = self.placed.iter().zip(speeds);
        placed.map(|(p, speed)| p.agent(ids.next().unwrap_or_default(), *speed, self.request.step)).collect()
    }
}

/// Where a kept road user is at a step: as recorded, with the start it was given.
fn start_of(agent: &Agent, step: usize) -> Option<State> {
    let logged = agent.state_at(step);
    let fixed = &agent.conditions.start;
    let position = fixed.position.or(logged.map(|s| s.position()))?;
    let heading_rad = fixed.heading_rad.or(logged.map(|s| s.heading_rad)).unwrap_or(0.0);
    let speed_mps = fixed.speed_mps.or(logged.map(|s| s.speed_mps())).unwrap_or(0.0);
    let velocity = direction(heading_rad) * speed_mps;
    Some(State { x_m: position.x, y_m: position.y, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y })
}

fn purpose(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "other",
    }
}

/// A speed from the first of the contexts that is known, at most `most` m/s.
fn drawn_speed(model: &TypeModel, contexts: &[u16], unit_mps: f64, most: f64, stream: &mut Stream) -> f64 {
    let row = contexts.iter().find_map(|context| model.speed.get(context));
    let class = row.and_then(|row| stream.among(row.iter().copied())).unwrap_or(0);
    let part = stream.unit();
    if class == 0 {
        return 0.0;
    }
    let speed_mps = (unit_mps * SPEED_STEP * (class as f64 - 1.0 + part)).min(most);
    if speed_mps < STANDING_MPS { 0.0 } else { speed_mps }
}

/// The middle of the line, along it; on pavements a little off the road.
fn even_pose(sites: &Sites<'_>, site: &Site, agent_type: AgentType, stream: &mut Stream) -> Option<Pose> {
    let s_m = stream.between(site.from_m, site.to_m);
    let base = sites.path(site)?.sample(s_m);
    let aside_m = if site.kind == SiteKind::Pavement && !site.on_lane { 1.5 * site.side } else { 0.0 };
    let back = agent_type == AgentType::Pedestrian && stream.unit() < 0.5;
    let left = Vec2::new(-base.direction().y, base.direction().x);
    let heading_rad = wrap_angle(base.heading_rad + if back { PI } else { 0.0 });
    Some(Pose { position: base.position + left * aside_m, heading_rad, s_m })
}

impl Placed {
    fn outline(&self) -> OrientedBox {
        let (half_length, half_width) = (0.5 * self.size.length_m, 0.5 * self.size.width_m);
        OrientedBox::new(self.pose.position, half_length, half_width, self.pose.heading_rad)
    }

    fn agent(&self, id: AgentId, speed_mps: f64, step: usize) -> Agent {
        let velocity = direction(self.pose.heading_rad) * speed_mps;
        let state = State {
            x_m: self.pose.position.x,
            y_m: self.pose.position.y,
            heading_rad: self.pose.heading_rad,
            vx_mps: rounded(velocity.x, 1e3),
            vy_mps: rounded(velocity.y, 1e3),
        };
        let start = Start {
            position: Some(self.pose.position),
            heading_rad: Some(self.pose.heading_rad),
            speed_mps: Some(speed_mps),
        };
        Agent {
            id,
            agent_type: self.agent_type,
            subtype: self.subtype,
            role: None,
            size: self.size,
            track: Track { first_step: step, states: vec![Some(state)], z_m: None },
            conditions: Conditions { start, ..Conditions::default() },
        }
    }
}
