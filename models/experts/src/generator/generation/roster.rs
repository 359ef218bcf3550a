//! The roster of a call: one part per road user of the scene, and the cast of each window.

use super::base_scene::known_to_the_end;
use super::ledger::Ledger;
use super::spans::Spans;
use crate::generator::cast::{MOST_ACTORS, WindowCast};
use crate::generator::extrapolation::Guessed;
use crate::generator::others::extend_along_road;
use crate::planning::world::World;
use crate::request::{GenerateError, React, Request};
use scene::{AgentId, AgentType, HORIZON_STEPS, Scene};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The part of an agent in a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CallPart {
    /// The call regenerates it.
    Asked,
    /// The call regenerates it, but the user picked its future. It is fixed in the first window and
    /// background afterwards. It replans at the end of the picked future.
    Picked,
    /// It may react to the regenerated agents.
    MayReact,
    /// It keeps a future that ends before the call does, and is planned from there.
    Continues,
    /// It enters after the start of a call that covers all agents or lets all react. It is planned from the
    /// end of its log.
    Arrives,
    /// It keeps its motion.
    Kept,
    /// It is not present at the start.
    Absent,
}

impl CallPart {
    /// Whether it may get new futures although the call does not regenerate it.
    pub(super) fn answers(self) -> bool {
        matches!(self, Self::MayReact | Self::Continues | Self::Arrives)
    }

    /// Whether the call regenerates it.
    pub(super) fn is_asked(self) -> bool {
        matches!(self, Self::Asked | Self::Picked)
    }
}

/// The parts in a call, one per agent of the scene.
pub(super) struct Roster {
    /// The scene that windows are cut from.
    base: Arc<Scene>,
    parts: Vec<CallPart>,
    /// In calls of several windows: the step from which a kept motion is extrapolated, by agent.
    guessed: Vec<Option<Guessed>>,
}

impl Roster {
    /// The parts in a call, and the scene that its windows are cut from. That is the scene of the call, with
    /// kept motions extended to the end of the last window.
    ///
    /// # Errors
    /// Unknown ids, ids of agents that cannot move, or more regenerated agents than [`MOST_ACTORS`].
    pub(super) fn of(
        request: &Request,
        world: &World<'_>,
        spans: &Spans,
    ) -> Result<(Self, Arc<Scene>), GenerateError> {
        let scene = &request.scene;
        let movable: BTreeSet<usize> =
            world.present.iter().filter(|p| p.agent_type != AgentType::Other).map(|p| p.index).collect();
        let asked = match &request.agents {
            None => movable.clone(),
            Some(ids) => find(scene, &movable, ids)?,
        };
        let several = spans.count() > 1;
        let coming = |i: &usize| {
            let agent = &scene.agents[*i];
            let there = request.start_step + 1..=request.start_step + request.horizon_steps;
            agent.kind() != AgentType::Other && there.into_iter().any(|step| agent.state_at(step).is_some())
        };
        let there = || movable.iter().copied().chain((0..scene.agents.len()).filter(coming)).collect();
        let mut may_react: BTreeSet<usize> = match &request.react {
            React::Nobody => BTreeSet::new(),
            React::Everyone => there(),
            React::Only(ids) => find(scene, &there(), ids)?,
        };
        may_react.retain(|i| !asked.contains(i));
        if asked.len() > MOST_ACTORS {
            return Err(GenerateError::TooManyAgents { found: asked.len(), most: MOST_ACTORS });
        }
        let here: BTreeSet<usize> = world.present.iter().map(|p| p.index).collect();
        let picked = |i: usize| request.pinned.contains_key(&scene.agents[i].id);
        let (base, guessed) = if several {
            known_to_the_end(request, |i| asked.contains(&i) && !picked(i), spans)
        } else {
            (scene.clone(), vec![None; scene.agents.len()])
        };
        let everybody = request.agents.is_none() || matches!(request.react, React::Everyone);
        let keeps_a_future = |i: usize| {
            let generated = scene.generated.as_ref();
            generated.is_some_and(|g| g.chosen_future(&scene.agents[i].id).is_some())
        };
        let part = |i: usize| {
            let ends = guessed[i].is_some();
            let moves = scene.agents[i].kind() != AgentType::Other;
            match () {
                () if asked.contains(&i) => {
                    if picked(i) {
                        CallPart::Picked
                    } else {
                        CallPart::Asked
                    }
                }
                () if may_react.contains(&i) => CallPart::MayReact,
                () if movable.contains(&i) && ends && keeps_a_future(i) => CallPart::Continues,
                () if !here.contains(&i) && ends && everybody && moves => CallPart::Arrives,
                () if here.contains(&i) => CallPart::Kept,
                () => CallPart::Absent,
            }
        };
        let parts = (0..scene.agents.len()).map(part).collect();
        Ok((Self { base: base.clone(), parts, guessed }, base))
    }

    /// The part of a road user.
    pub(super) fn part(&self, agent: usize) -> CallPart {
        self.parts[agent]
    }

    /// Road users whose part satisfies `is`.
    pub(super) fn with(&self, is: impl Fn(CallPart) -> bool) -> impl Iterator<Item = usize> {
        self.parts.iter().enumerate().filter(move |(_, part)| is(**part)).map(|(i, _)| i)
    }

    /// The step from which each kept motion is extrapolated.
    pub(super) fn guesses(&self) -> impl Iterator<Item = (usize, Guessed)> {
        self.guessed.iter().enumerate().filter_map(|(i, guessed)| Some((i, (*guessed)?)))
    }

    /// Whether the kept motion of a road user is extrapolated from scene step `step` on.
    fn known_until(&self, agent: usize, step: usize) -> bool {
        self.guessed[agent].is_some_and(|g| g.step <= step)
    }

    /// Whether a road user still follows its picked future when a window begins at scene step `step`.
    pub(super) fn follows_its_pick(&self, agent: usize, step: usize) -> bool {
        self.part(agent) == CallPart::Picked && !self.known_until(agent, step + 1)
    }

    /// First scene step that a picked future does not cover. `None` for all other agents, and if the future
    /// covers the whole call.
    pub(super) fn pick_ends(&self, agent: usize) -> Option<usize> {
        self.guessed[agent].filter(|_| self.part(agent) == CallPart::Picked).map(|g| g.step)
    }

    /// The cast of window `number`, which begins at `world.step` and is executed up to scene step `end`.
    /// `ledger` holds the agents that got futures in earlier windows of the sample. The caller fills
    /// `parked`.
    pub(super) fn in_window(
        &self,
        number: usize,
        world: &World<'_>,
        end: usize,
        ledger: &Ledger,
    ) -> WindowCast {
        let first = number == 0;
        let acted = &ledger.acted();
        // After the first window, a picked future is background to its end, like any other kept motion.
        let asked = self.with(CallPart::is_asked).filter(|i| first || !self.follows_its_pick(*i, world.step));
        let mut acting: BTreeSet<usize> = asked.collect();
        // An agent that changed only its pace stays on its path as long as that path is known.
        let mut resumed = ledger.reacting();
        resumed.retain(|i, _| !self.known_until(*i, end));
        for (i, ahead) in &mut resumed {
            let agent = &self.base.agents[*i];
            let agent_type = world.conditions[*i].kind_of(agent);
            // An extrapolated motion continues straight on and ignores the road.
            let until =
                self.guessed[*i].map_or(usize::MAX, |g| g.step.saturating_sub(agent.track.first_step));
            let way = &agent.track.states[..agent.track.states.len().min(until)];
            extend_along_road(ahead, way, &world.graph, agent_type, HORIZON_STEPS + 1);
        }
        acting.extend(acted.iter().filter(|i| !self.part(**i).is_asked() && !resumed.contains_key(i)));
        let new = |part: CallPart| self.with(move |p| p == part).filter(move |i| !acted.contains(i));
        let mut may_react: BTreeSet<usize> = new(CallPart::MayReact).collect();
        if !first {
            // An agent whose log ends within this window has no motion left to keep.
            let seen = |i: &usize| world.scene.agents[*i].track.at(world.step).is_some();
            let ended = new(CallPart::MayReact).chain(new(CallPart::Arrives)).filter(seen);
            let ended = ended.filter(|i| self.known_until(*i, end));
            let ended: Vec<usize> = ended.take(MOST_ACTORS.saturating_sub(acting.len())).collect();
            may_react.retain(|i| !ended.contains(i));
            acting.extend(ended);
            let over = new(CallPart::Continues).filter(|i| self.known_until(*i, world.step + 1));
            let over: Vec<usize> = over.take(MOST_ACTORS.saturating_sub(acting.len())).collect();
            acting.extend(over);
        }
        WindowCast { acting, may_react, parked: BTreeSet::new(), resumed }
    }
}

/// Indices of agents by id; all must be able to move.
fn find(
    scene: &Scene,
    movable: &BTreeSet<usize>,
    ids: &BTreeSet<AgentId>,
) -> Result<BTreeSet<usize>, GenerateError> {
    ids.iter()
        .map(|id| {
            let index = scene.agents.iter().position(|a| a.id == *id);
            let index = index.ok_or_else(|| GenerateError::UnknownAgent(id.clone()))?;
            let missing = GenerateError::StartMissing { agent: id.clone(), field: "position" };
            movable.contains(&index).then_some(index).ok_or(missing)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::routes::LaneGraph;
    use scene::{Agent, LaneMap, State, Subtype};

    /// Known at this many steps from `first` on, away from the others.
    fn agent(id: &str, agent_type: AgentType, first: usize, steps: usize) -> Agent {
        let mut agent = Agent::bare(id, agent_type, Subtype::Unknown, Vec::new());
        let x_m = 10.0 * id.len() as f64;
        agent.track.first_step = first;
        agent.track.states = vec![Some(State { x_m, vx_mps: 5.0, ..State::default() }); steps];
        agent
    }

    fn parts(react: React, agents: Option<&[&str]>, horizon_steps: usize) -> Vec<CallPart> {
        let all = vec![
            agent("a", AgentType::Vehicle, 0, 91),
            agent("aa", AgentType::Vehicle, 0, 91),
            agent("aaa", AgentType::Other, 0, 91),
            agent("aaaa", AgentType::Vehicle, 40, 51),
        ];
        let scene = Arc::new(Scene::bare("", LaneMap::default(), all));
        let mut request = Request { react, horizon_steps, ..Request::new(scene.clone()) };
        request.agents = agents.map(|ids| ids.iter().map(|id| (*id).to_owned()).collect());
        let world = World::new(&scene, Arc::new(LaneGraph::new(&scene.map)), 0);
        let spans = Spans::of(&request);
        let (roster, _) = Roster::of(&request, &world, &spans).unwrap();
        (0..4).map(|i| roster.part(i)).collect()
    }

    #[test]
    fn everybody_has_one_part() {
        use CallPart::*;
        assert_eq!(parts(React::Nobody, Some(&["a"]), 90), [Asked, Kept, Kept, Absent]);
        assert_eq!(parts(React::Everyone, Some(&["a"]), 90), [Asked, MayReact, Kept, MayReact]);
        // Agents arrive only in a call of several windows.
        assert_eq!(parts(React::Nobody, None, 180), [Asked, Asked, Kept, Arrives]);
        assert_eq!(parts(React::Nobody, Some(&["a"]), 180), [Asked, Kept, Kept, Absent]);
    }
}
