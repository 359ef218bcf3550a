//! Places road users one at a time.

use super::assign::driven_lane;
use super::cells::{CellKind, Cells, LEADER_GAP, MapCell, leader_class};
use super::checks::{Neighbours, is_sensible};
use super::model::{PlacementModel, TypeModel};
use super::placed::{PlacedAgent, rounded};
use super::pose::{Pose, draw_pose, draw_size};
use super::random::{self, WeightTree, stream_name};
use super::request::{PlaceRequest, Placement, PlacementMethod, counted, reason};
use super::room::{self, DrivenBox};
use super::speeds::StartSpeeds;
use crate::planning::world::AgentAtStart;
use crate::request::GenerateError;
use crate::tuning::placing::parking::FAST_MPS;
use crate::tuning::placing::pose::PAVEMENT_M;
use scene::Cancel;
use scene::geometry::obb::OrientedBox;
use scene::geometry::wrap_angle;
use scene::random::Stream;
use scene::routes::LaneGraph;
use scene::routes::speed::Obstacle;
use scene::{Agent, AgentId, AgentType, MAX_AGENTS, Size, Subtype, Vec2};
use std::collections::{BTreeMap, HashSet};
use std::f64::consts::PI;

/// Draws of a cell for one road user before placement gives up on it.
const TRIES: usize = 128;
/// Failed draws of a pose after which a cell counts as full.
const CELL_TRIES: u8 = 4;

/// Steps of a recording after the start in which no road user is placed on the path of a kept one.
const NEXT_STEPS: usize = 30;

/// Draws cells in proportion to rates, which each placed agent changes.
pub(super) struct Sampler<'a> {
    pub(super) request: &'a PlaceRequest,
    model: Option<&'a PlacementModel>,
    pub(super) cells: Cells<'a>,
    /// Distance from each lane cell to the nearest road user ahead, metres.
    gaps: Vec<f64>,
    /// Rate of each cell, by type.
    pub(super) rates: BTreeMap<AgentType, WeightTree>,
    /// Lanes that drivers can only reach by an arm.
    pub(super) arrival_lanes: HashSet<usize>,
    /// Number of failed draws by type and cell.
    failed: BTreeMap<AgentType, Vec<u8>>,
    neighbours: Neighbours,
    /// Number of kept road users among the neighbours.
    kept: usize,
    pub(super) placed: Vec<PlacedAgent>,
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
    let mut sampler = Sampler::new(model, graph, request, &kept);
    let mut free = MAX_AGENTS.saturating_sub(kept.len());
    let mut traffic = sampler.place_arrivals(&mut free, cancel)?;
    let parked = sampler.park(&mut free, cancel)?;
    let wanted = request.wanted(sampler.cells.lane_km(&request.region));
    let (mut unplaced, mut full) = (BTreeMap::new(), false);
    for (&agent_type, &count) in &wanted {
        let asked = count.min(free);
        full |= asked < count;
        let done = sampler.place_type(agent_type, asked, cancel)?;
        free -= done;
        if done < count {
            unplaced.insert(agent_type, count - done);
        }
    }
    let (speeds, no_room) = sampler.speeds();
    for (agent_type, count) in &no_room {
        *unplaced.entry(*agent_type).or_default() += count;
    }
    let mut ids = request.free_ids();
    let mut agents = sampler.agents(&speeds, &mut ids);
    agents.extend(sampler.late_comers(&mut traffic, &speeds, &kept, &mut ids, cancel)?);
    let mut reasons: Vec<String> = reason(&unplaced, full).into_iter().collect();
    let too_slow = speeds.iter().filter(|speed| speed.is_none()).count() - no_room.values().sum::<usize>();
    if let (1.., Some(range)) = (too_slow, request.speeds) {
        let who = counted(too_slow, AgentType::Vehicle);
        reasons.push(format!("no place where one can start at {} m/s or more for {who}", range.min_mps));
    }
    reasons.append(&mut traffic.reasons);
    reasons.extend(parked.reason);
    let missing = too_slow + traffic.unplaced + parked.unplaced;
    if missing > 0 {
        *unplaced.entry(AgentType::Vehicle).or_default() += missing;
    }
    Ok(Placement {
        agents,
        unplaced,
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
        method: if model.is_some() { PlacementMethod::Model } else { PlacementMethod::LaneSampler },
        arms: traffic.arms,
        parking_places: parked.places,
    })
}

impl<'a> Sampler<'a> {
    fn new(
        model: Option<&'a PlacementModel>,
        graph: &'a LaneGraph,
        request: &'a PlaceRequest,
        kept: &[&Agent],
    ) -> Self {
        let cells = Cells::new(&request.scene, graph, request.step, &request.region);
        let mut sampler = Self {
            request,
            model,
            gaps: vec![f64::INFINITY; cells.all.len()],
            cells,
            rates: BTreeMap::new(),
            arrival_lanes: HashSet::new(),
            failed: BTreeMap::new(),
            neighbours: Neighbours::default(),
            kept: 0,
            placed: Vec::new(),
        };
        let mut lanes = Vec::new();
        for (index, agent) in kept.iter().enumerate() {
            let Some(present) = AgentAtStart::at(index, agent, &agent.conditions, request.step) else {
                continue;
            };
            let lane = driven_lane(graph, present.agent_type, &present.start);
            let lane = lane.map(|hit| (hit.lane, hit.s_m));
            let later = request.step..request.step + NEXT_STEPS;
            let recorded =
                later.filter_map(|step| Some(OrientedBox::of_state(&agent.state_at(step)?, &present.size)));
            sampler.neighbours.next.extend(recorded);
            sampler.neighbours.push(present.obstacle(), present.agent_type, lane);
            sampler.neighbours.next.extend(room::next(graph, &DrivenBox::kept(&present, lane)));
            lanes.extend(lane);
        }
        sampler.kept = sampler.neighbours.obstacles.len();
        for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
            let rates: Vec<f64> =
                sampler.cells.all.iter().map(|cell| sampler.rate(agent_type, cell)).collect();
            sampler.failed.insert(agent_type, vec![0; rates.len()]);
            sampler.rates.insert(agent_type, WeightTree::new(&rates));
        }
        for (lane, s_m) in lanes {
            sampler.lead(lane, s_m);
        }
        sampler
    }

    pub(super) fn of_type(&self, agent_type: AgentType) -> Option<&'a TypeModel> {
        self.model.and_then(|m| m.types.get(&agent_type))
    }

    /// Rate of a cell for a type.
    fn rate(&self, agent_type: AgentType, cell: &MapCell) -> f64 {
        let reach_m = 0.5 * cell.extent() + 20.0;
        let fits =
            self.cells.may_hold(cell, agent_type) && self.request.region.may_hold(cell.center, reach_m);
        let by_an_arm = agent_type == AgentType::Vehicle
            && cell.kind == CellKind::Lane
            && self.arrival_lanes.contains(&cell.line);
        let fast =
            cell.kind == CellKind::Kerb && self.cells.graph.lanes()[cell.line].speed_limit_mps > FAST_MPS;
        if !fits || by_an_arm || fast {
            return 0.0;
        }
        if self.model.is_none() {
            let parks = matches!(cell.kind, CellKind::Kerb | CellKind::Driveway);
            let rides = agent_type != AgentType::Cyclist || cell.kind == CellKind::Lane;
            return if rides && !parks { cell.extent() } else { 0.0 };
        }
        self.of_type(agent_type).and_then(|m| m.rates.get(&cell.kind)).map_or(0.0, |rate| rate.of(cell))
    }

    /// Marks an agent that drives at `s_m` of a lane as the leader of the cells behind it.
    fn lead(&mut self, lane: usize, s_m: f64) {
        let mut nearer = Vec::new();
        self.cells.behind(lane, s_m, |at, gap_m| {
            if gap_m < self.gaps[at] {
                nearer.push((at, gap_m));
            }
        });
        for (at, gap_m) in nearer {
            self.gaps[at] = self.gaps[at].min(gap_m);
            let cell = &mut self.cells.all[at];
            let class = leader_class(self.gaps[at], cell.ahead.queues());
            if cell.features[LEADER_GAP] == class {
                continue;
            }
            cell.features[LEADER_GAP] = class;
            for agent_type in [AgentType::Vehicle, AgentType::Cyclist] {
                let full = self.failed.get(&agent_type).is_some_and(|f| f[at] >= CELL_TRIES);
                let rate = if full { 0.0 } else { self.rate(agent_type, &self.cells.all[at]) };
                if let Some(rates) = self.rates.get_mut(&agent_type) {
                    rates.set(at, rate);
                }
            }
        }
    }

    /// Places up to `count` road users of a type, and returns how many found a place.
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
            let mut stream = random::stream(self.request.seed, stream_name(agent_type), number);
            done += usize::from(self.place_one(agent_type, &mut stream));
        }
        Ok(done)
    }

    /// Settles a placed agent: later agents keep clear of it, and it leads the agents behind it.
    pub(super) fn settle(&mut self, placed: PlacedAgent) {
        let obstacle = Obstacle { outline: placed.outline(), speed_mps: 0.0 };
        let lane = placed.lane.map(|lane| (lane, placed.pose.s_m));
        self.neighbours.push(obstacle, placed.agent_type, lane);
        self.placed.push(placed);
        if let Some((lane, s_m)) = lane {
            self.lead(lane, s_m);
        }
    }

    fn place_one(&mut self, agent_type: AgentType, stream: &mut Stream) -> bool {
        for _ in 0..TRIES {
            let Some(at) = self.rates.get(&agent_type).and_then(|rates| rates.draw(stream)) else {
                return false;
            };
            if let Some(placed) = self.draw(agent_type, at, stream) {
                self.settle(placed);
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

    /// A road user in a cell, if a draw fits.
    fn draw(&self, agent_type: AgentType, at: usize, stream: &mut Stream) -> Option<PlacedAgent> {
        let cell = &self.cells.all[at];
        let (size, subtype, mut pose) = match self.of_type(agent_type) {
            Some(model) => {
                let (size, subtype) = draw_size(model, agent_type, cell.kind, stream);
                (size, subtype, draw_pose(&self.cells, cell, model, agent_type, size, stream)?)
            }
            None => {
                let subtype = Subtype::default();
                let size = Size::default_for(agent_type, subtype);
                (size, subtype, even_pose(&self.cells, cell, agent_type, stream)?)
            }
        };
        pose.position = pose.position.map(|v| rounded(v, 1e3));
        pose.heading_rad = wrap_angle(rounded(pose.heading_rad, 1e4));
        let lane = (cell.kind == CellKind::Lane).then_some(cell.line);
        let (kind, free_mps) = (cell.kind, None);
        let parked = agent_type == AgentType::Vehicle && matches!(kind, CellKind::Kerb | CellKind::Driveway);
        let placed = PlacedAgent { agent_type, subtype, size, pose, kind, lane, free_mps, parked };
        self.fits(&placed).then_some(placed)
    }

    pub(super) fn fits(&self, placed: &PlacedAgent) -> bool {
        let inside = self.request.region.contains(placed.pose.position)
            && placed.pose.position.amax() <= scene::MAX_COORDINATE_M;
        inside
            && self.neighbours.is_free(placed, self.request.min_gap_m)
            && (self.model.is_none() || is_sensible(placed, &self.cells))
    }

    /// Speeds of the placed agents, m/s, in order. `None` if no speed of the wanted range is possible, or if
    /// no speed leaves room to brake; the second value counts the latter by type.
    fn speeds(&self) -> (Vec<Option<f64>>, BTreeMap<AgentType, usize>) {
        let obstacles = self.neighbours.obstacles.clone();
        let (seed, model, kept, range) = (self.request.seed, self.model, self.kept, self.request.speeds);
        let kinds = &self.neighbours.kinds;
        StartSpeeds { seed, model, cells: &self.cells, placed: &self.placed, kept, obstacles, kinds, range }
            .draw()
    }

    /// The placed agents as road users of the scene.
    fn agents(&self, speeds: &[Option<f64>], ids: &mut impl Iterator<Item = AgentId>) -> Vec<Agent> {
        let placed = self.placed.iter().zip(speeds).filter_map(|(p, speed)| Some((p, (*speed)?)));
        let steps = self.request.step..self.request.scene.time.steps;
        placed.map(|(p, speed)| p.agent(ids.next().unwrap_or_default(), speed, steps.clone())).collect()
    }
}

/// The middle of the line and along it; on pavements slightly away from the road.
fn even_pose(cells: &Cells<'_>, cell: &MapCell, agent_type: AgentType, stream: &mut Stream) -> Option<Pose> {
    let s_m = stream.between(cell.from_m, cell.to_m);
    let base = cells.path(cell)?.sample(s_m);
    let aside_m = if cell.kind == CellKind::Pavement && !cell.on_lane { PAVEMENT_M * cell.side } else { 0.0 };
    let back = agent_type == AgentType::Pedestrian && stream.unit() < 0.5;
    let left = Vec2::new(-base.direction().y, base.direction().x);
    let heading_rad = wrap_angle(base.heading_rad + if back { PI } else { 0.0 });
    Some(Pose { position: base.position + left * aside_m, heading_rad, s_m })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placement::region::Region;
    use crate::placement::request::{Amount, Parked};
    use crate::weights::Files;
    use scene::map::{Lane, LaneMap};
    use scene::{Conditions, Scene, State, Track};
    use std::sync::Arc;

    fn model() -> PlacementModel {
        PlacementModel::load(&Files::built_in().placement.unwrap()).unwrap()
    }

    fn road(limit_mps: f64) -> Scene {
        let lane = |id: &str, y_m: f64, way: f64| {
            let points: Vec<Vec2> = (-30..=30).map(|i| Vec2::new(10.0 * way * f64::from(i), y_m)).collect();
            Lane { speed_limit_mps: Some(limit_mps), ..Lane::street(id, points) }
        };
        let lanes = vec![lane("east", -2.0, 1.0), lane("west", 2.0, -1.0)];
        let edge = |id: &str, y_m: f64| scene::map::TypedLine {
            id: id.into(),
            line_type: "boundary".into(),
            points: vec![Vec2::new(-300.0, y_m), Vec2::new(300.0, y_m)].into(),
        };
        let road_edges = vec![edge("south", -6.2), edge("north", 6.2)];
        Scene::bare("road", LaneMap { lanes, road_edges, ..LaneMap::default() }, Vec::new())
    }

    fn placed(request: &PlaceRequest) -> Vec<Agent> {
        let graph = LaneGraph::new(&request.scene.map);
        place(Some(&model()), &graph, request, &Cancel::default()).unwrap().agents
    }

    #[test]
    fn nobody_parks_beside_a_fast_road() {
        let parked = |limit_mps: f64, share: f64| {
            let mut request = PlaceRequest::new(Arc::new(road(limit_mps)));
            request.amount = Amount::Each([(AgentType::Vehicle, 100)].into());
            request.parked = Some(Parked::Share(share));
            let is_parked = |agent: &&Agent| agent.conditions.start.position.is_none();
            placed(&request).iter().filter(is_parked).count()
        };
        for share in [0.0, 0.5] {
            assert!(parked(11.0, share) > 3, "{} parked", parked(11.0, share));
            assert_eq!(parked(16.0, share), 0);
        }
    }

    #[test]
    fn nobody_in_an_area_is_put_into_a_car_or_its_way() {
        let mut scene = road(14.0);
        let state = |step: u32| State {
            x_m: 1.2 * f64::from(step),
            y_m: -5.5,
            heading_rad: 0.0,
            vx_mps: 12.0,
            vy_mps: 0.0,
        };
        let car = Agent {
            id: "car".into(),
            agent_type: AgentType::Vehicle,
            subtype: Subtype::Car,
            role: None,
            size: Size { length_m: 4.6, width_m: 2.0, height_m: None },
            track: Track { first_step: 0, states: (0..91).map(|s| Some(state(s))).collect(), z_m: None }
                .into(),
            conditions: Conditions::default(),
        };
        scene.agents.push(car.clone());
        let mut request = PlaceRequest::new(Arc::new(scene));
        request.amount = Amount::Each([(AgentType::Pedestrian, 40)].into());
        request.region = Region::Circle { center: Vec2::new(10.0, -6.0), radius_m: 20.0 };
        for seed in 0..4 {
            request.seed = seed;
            let people = placed(&request);
            assert!(people.len() > 10, "{}", people.len());
            for step in 0..20 {
                let own = OrientedBox::of_state(&car.state_at(step).unwrap(), &car.size);
                let touches = |a: &&Agent| {
                    scene::geometry::obb::overlaps(
                        &own,
                        &OrientedBox::of_state(&a.state_at(0).unwrap(), &a.size),
                        0.0,
                    )
                };
                assert_eq!(people.iter().filter(touches).count(), 0, "seed {seed}, step {step}");
            }
        }
    }
}
