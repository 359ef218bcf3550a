//! Every agent that does not act in a window: its motion, and whether it may change.

use super::blocks::{Corridor, PathBlock, closed};
use super::path_progress::{PathProgress, along_road};
use crate::generator::cast::WindowCast;
use crate::generator::choice::FixedMotion;
use crate::generator::motion::{KeptMotion, Sweep};
use crate::generator::workers::WorkerPool;
use crate::planning::STAYS_WITHIN_M;
use crate::planning::stop_line::StopLine;
use crate::planning::world::World;
use crate::request::Request;
use crate::tuning::Tuning;
use crate::tuning::fixed::choice::COMES_IN_STEPS;
use scene::geometry::direction;
use scene::judge::Trace;
use scene::limits::Limits;
use scene::routes::LaneGraph;
use scene::{AgentId, AgentType, HORIZON_STEPS, STANDING_MPS, Size, State};
use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

/// From this many agents on, several threads prepare them.
const MANY: usize = 96;

/// The source of a kept motion. Two motions of one source do not avoid each other: their distance has not
/// changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KeptFrom {
    /// The recording.
    Log,
    /// An earlier answer.
    Future,
}

/// An agent that does not act in a window.
pub(in crate::generator) struct OtherAgent {
    /// Index into the scene's agents.
    pub(super) index: usize,
    pub(in crate::generator) id: AgentId,
    /// Its kept motion.
    pub(in crate::generator) sweep: Sweep,
    pub(super) kept_from: KeptFrom,
    agent_type: AgentType,
    /// Whether its motion may be used to name the relations of drafts.
    visible: bool,
    /// Recorded motion that names relations in place of `sweep`.
    recorded: Option<Sweep>,
    /// Step at which it enters, for an agent that stays out if its place is taken then.
    comes_in: Option<usize>,
    pub(super) response: Response,
}

/// Whether an agent may change its motion.
pub(super) enum Response {
    /// It keeps its motion regardless of the others.
    Keeps,
    /// It may yield.
    Reacts(Box<Reactor>),
}

/// What an agent needs to yield on its own path.
pub(super) struct Reactor {
    /// Index into the scene's agents.
    pub(super) index: usize,
    pub(super) agent_type: AgentType,
    pub(super) size: Size,
    pub(super) limits: Limits,
    pub(super) path: PathProgress,
    /// It changed its motion in an earlier window and continues that motion.
    pub(super) resumed: bool,
    /// Computed on first use, because few agents ever meet another.
    road: OnceLock<ReactorRoad>,
    /// The blocks on its path by the kept motion of each other agent.
    pub(super) around: OnceLock<Vec<Vec<PathBlock>>>,
}

/// The road along an agent's path.
pub(super) struct ReactorRoad {
    /// Its path, extended along the road.
    pub(super) path: PathProgress,
    pub(super) corridor: Corridor,
    /// Red signals on its path.
    pub(super) lights: Vec<PathBlock>,
}

/// An agent that may react, with its index in [`Others`].
#[derive(Clone, Copy)]
pub(super) struct ReactingAgent<'a> {
    pub(super) at: usize,
    pub(super) other: &'a OtherAgent,
    pub(super) own: &'a Reactor,
}

/// All agents that are present in a window, or enter during it, and do not act.
pub(in crate::generator) struct Others<'g> {
    /// Agents that may react first; both parts sorted by id, because sums over them run in this order.
    pub(super) each: Vec<OtherAgent>,
    /// Number of agents that may react.
    pub(super) reacting: usize,
    stop_lines: Vec<StopLine>,
    graph: Option<Arc<LaneGraph>>,
    pub(super) tuning: &'g Tuning,
    /// Scene step at which the window starts.
    pub(super) start_step: usize,
}

impl<'g> Others<'g> {
    /// No agents.
    pub(in crate::generator) fn none(tuning: &'g Tuning) -> Self {
        let (each, stop_lines) = (Vec::new(), Vec::new());
        Self { each, reacting: 0, stop_lines, graph: None, tuning, start_step: 0 }
    }

    /// All agents except those in `acting`, by index into the scene's agents.
    pub(in crate::generator) fn of(
        world: &World<'_>,
        workers: &WorkerPool,
        request: &Request,
        acting: &BTreeSet<usize>,
        cast: &WindowCast,
        tuning: &'g Tuning,
    ) -> Self {
        let mut order: Vec<usize> = (0..world.scene.agents.len()).filter(|i| !acting.contains(i)).collect();
        // The answer must not depend on the order of the agents in the scene.
        order.sort_by(|a, b| world.scene.agents[*a].id.cmp(&world.scene.agents[*b].id));
        let all = workers.map_many(MANY, &order, |&index| OtherAgent::of(world, request, cast, index));
        let may_react = |other: &OtherAgent| matches!(other.response, Response::Reacts(_));
        let (mut each, keeping): (Vec<_>, Vec<_>) = all.into_iter().flatten().partition(may_react);
        let reacting = each.len();
        each.extend(keeping);
        let stop_lines = world.stop_lines.clone();
        let graph = Some(Arc::clone(&world.graph));
        Self { each, reacting, stop_lines, graph, tuning, start_step: world.step }
    }

    /// Every agent's kept motion.
    pub(in crate::generator) fn sweeps(&self) -> impl Iterator<Item = &Sweep> {
        self.each.iter().map(|other| &other.sweep)
    }

    /// The motions that do not depend on the actors.
    pub(in crate::generator) fn kept(&self) -> impl Iterator<Item = FixedMotion<'_>> {
        self.each[self.reacting..].iter().map(OtherAgent::fixed)
    }

    /// The motions to which drafts are related by name.
    pub(in crate::generator) fn traces(&self) -> impl Iterator<Item = &Trace> {
        let named = self.each.iter().filter(|other| other.visible);
        named.map(|other| other.recorded.as_ref().unwrap_or(&other.sweep).trace(&other.id, other.agent_type))
    }

    /// Whether an agent that may react would meet this motion, follow it too closely, or stay out because of it.
    pub(in crate::generator) fn would_react_to(&self, motion: &Sweep) -> bool {
        self.each[..self.reacting].iter().any(|other| other.sweep.first_conflict(motion).is_some())
            || self.each.iter().any(|other| other.is_kept_out_by(motion))
    }

    /// The agents that may react.
    pub(super) fn reactors(&self) -> Vec<ReactingAgent<'_>> {
        let found = self.each.iter().enumerate().filter_map(|(at, other)| match &other.response {
            Response::Reacts(own) => Some(ReactingAgent { at, other, own }),
            Response::Keeps => None,
        });
        found.collect()
    }

    /// The road along the path of an agent that may react.
    pub(super) fn road<'a>(&self, own: &'a Reactor) -> &'a ReactorRoad {
        own.road.get_or_init(|| {
            let path = match &self.graph {
                Some(graph) if !own.path.leaves() => own.path.clone().extended(graph, own.agent_type),
                _ => own.path.clone(),
            };
            let corridor = Corridor::of(&path, &own.size);
            let on_foot = own.agent_type == AgentType::Pedestrian;
            let lines = self.stop_lines.iter().filter(|_| !on_foot);
            let red = lines.filter_map(|line| {
                let at_m = corridor.line(line.at())?;
                Some(closed(at_m, |step| line.red() >> step & 1 == 1))
            });
            let lights = red.flatten().collect();
            ReactorRoad { path, corridor, lights }
        })
    }
}

impl OtherAgent {
    /// Whether it would enter where this motion is.
    pub(super) fn is_kept_out_by(&self, motion: &Sweep) -> bool {
        self.fixed().is_kept_out_by(motion)
    }

    /// Its kept motion. An agent that may slow down conflicts with nothing if it has room at the step of its
    /// entry.
    fn fixed(&self) -> FixedMotion<'_> {
        let steps = if matches!(self.response, Response::Keeps) { COMES_IN_STEPS } else { 0 };
        FixedMotion { sweep: &self.sweep, comes_in: self.comes_in.map(|step| (step, step + steps)) }
    }

    /// Whether it would meet this motion soon after it enters with `own`.
    pub(super) fn comes_in_before(&self, own: &Sweep, motion: &Sweep) -> bool {
        let comes_in = self.comes_in.map(|step| (step, step + COMES_IN_STEPS));
        FixedMotion { sweep: own, comes_in }.is_kept_out_by(motion)
    }

    /// Step and state of its entry, for an agent that may stay out.
    pub(super) fn entry(&self) -> Option<(usize, &State)> {
        self.comes_in.and_then(|step| Some((step, self.sweep.state(step)?)))
    }

    /// An agent of the scene; `None` if it is absent in the whole window.
    fn of(world: &World<'_>, request: &Request, cast: &WindowCast, index: usize) -> Option<Self> {
        let agent = &world.scene.agents[index];
        let conditions = &world.conditions[index];
        let size = conditions.size_of(agent.size);
        let agent_type = conditions.kind_of(agent);
        let kept = KeptMotion::of(&world.scene, agent, world.step);
        let present = world.present.iter().find(|p| p.index == index);
        // On a road, an agent of which only one state is known is expected to follow its lane.
        let ahead_mps = |s: &State| s.velocity().dot(&direction(s.heading_rad));
        let rolls = present.filter(|p| kept.is_guessed() && ahead_mps(&p.start) >= STANDING_MPS);
        let on_its_lane = rolls.and_then(|p| along_road(&p.start, &world.graph, agent_type));
        let recorded: Vec<Option<State>> =
            on_its_lane.unwrap_or_else(|| (0..=HORIZON_STEPS).map(|step| kept.at(step)).collect());
        let resumed = cast.resumed.get(&index);
        let (mut states, recorded) = match resumed {
            Some(states) => {
                let states = (0..=HORIZON_STEPS).map(|step| states.get(step).copied()).collect();
                // Relations use the scene's own motion, even if the agent continues a reaction.
                (states, Some(Sweep::new(recorded, &size)))
            }
            None => (recorded, None),
        };
        if let Some(present) = present {
            states[0] = Some(present.start);
        }
        if states.iter().all(Option::is_none) {
            return None;
        }
        let chosen = request.scene.generated.as_ref().and_then(|g| g.chosen_future(&agent.id));
        let made = chosen.is_some() || request.pinned.contains_key(&agent.id) || resumed.is_some();
        let kept_from = if made { KeptFrom::Future } else { KeptFrom::Log };
        let goes_on = || present.is_none_or(|present| kept.begins_at(&present.start, conditions));
        let may_react = (resumed.is_some() || cast.may_react.contains(&index) && goes_on())
            && agent_type != AgentType::Other;
        let comes_in = states.iter().position(Option::is_some).filter(|step| may_react && *step > 0);
        // An agent that stands all the time stays; one that changed its motion continues, even if it stands.
        let shortest_m = if resumed.is_some() { 0.0 } else { STAYS_WITHIN_M };
        let path = may_react.then(|| PathProgress::of(&states, shortest_m)).flatten();
        let response = path.map_or(Response::Keeps, |path| {
            Response::Reacts(Box::new(Reactor {
                index,
                agent_type,
                size,
                limits: Limits::of(agent_type, agent.subtype, size.length_m),
                path,
                resumed: resumed.is_some(),
                road: OnceLock::new(),
                around: OnceLock::new(),
            }))
        });
        // A call that regenerates all agents knows no recording after the start.
        let visible = request.agents.is_some()
            || agent.state_at(world.step).is_some()
            || conditions.start.position.is_some();
        let sweep = Sweep::new(states, &size);
        let id = agent.id.clone();
        Some(Self { index, id, sweep, kept_from, agent_type, visible, recorded, comes_in, response })
    }
}
