//! Relations and manoeuvres of the futures of a finished sample. Relations are to the shown motions of
//! others, or to their reactions to the future.

use crate::maps::KnownMap;
use crate::request::Request;
use scene::judge::{Manoeuvre, Relation, Trace, manoeuvre, relations};
use scene::score::Actor;
use scene::{AgentType, Future, Sample};

/// Number of futures in a sample up to which all get relations. In a larger sample, an agent that the call
/// does not regenerate gets them only for its shown future.
const FEW: usize = 60;

/// All agents as they are shown, to relate futures to.
pub(super) struct ShownAgents<'a> {
    request: &'a Request,
    map: &'a KnownMap,
    sample: &'a Sample,
    /// One trace per road user of the scene, from the step after the start on.
    traces: Vec<Trace>,
    few: bool,
}

impl<'a> ShownAgents<'a> {
    /// `shown` holds the scene's road users in their order; the sample has `futures` futures in all.
    pub(super) fn new(
        request: &'a Request,
        map: &'a KnownMap,
        sample: &'a Sample,
        shown: &[Actor<'_>],
        futures: usize,
    ) -> Self {
        let agents = request.scene.agents.iter().zip(shown);
        let traces = agents.map(|(agent, shown)| Self::trace(request, agent, shown)).collect();
        Self { request, map, sample, traces, few: futures <= FEW }
    }

    /// The manoeuvre of an agent's future.
    pub(super) fn manoeuvre(&self, agent: usize, future: &Future) -> Option<Manoeuvre> {
        let kind = self.request.scene.agents[agent].kind();
        let lanes = (kind != AgentType::Pedestrian).then_some(&*self.map.graph);
        manoeuvre(&future.states, kind, lanes)
    }

    /// The motion of an agent, to relate futures to.
    fn trace(request: &Request, agent: &scene::Agent, actor: &Actor<'_>) -> Trace {
        let at = |step: usize| actor.state(request.start_step + 1 + step).copied();
        Trace::new(&agent.id, agent.kind(), &actor.size, request.horizon_steps, at)
    }

    /// Relations of a future to the other agents. `instead` replaces the shown motion of some of them.
    pub(super) fn relations(
        &self,
        agent: usize,
        future: &Future,
        instead: &[(usize, Actor<'_>)],
    ) -> Vec<Relation> {
        if !self.few && !self.is_asked(agent) && !self.is_shown(agent, future) {
            return Vec::new();
        }
        let (shown, first_step) = (&self.traces[agent], self.request.start_step + 1);
        let late = future.first_step.saturating_sub(first_step);
        let at = |step: usize| future.states.get(step.checked_sub(late)?).copied();
        let me = Trace::new(shown.id(), shown.agent_type(), shown.size(), late + future.states.len(), at)
            .going_on();
        let own = |(i, actor): &(usize, Actor<'_>)| {
            (*i, Self::trace(self.request, &self.request.scene.agents[*i], actor))
        };
        let instead: Vec<(usize, Trace)> = instead.iter().map(own).collect();
        let others = self.traces.iter().enumerate();
        let others = others.map(|(i, shown)| instead.iter().find(|(j, _)| *j == i).map_or(shown, |(_, t)| t));
        relations(&me, others, first_step)
    }

    fn is_asked(&self, agent: usize) -> bool {
        let id = &self.request.scene.agents[agent].id;
        self.request.agents.as_ref().is_none_or(|asked| asked.contains(id))
    }

    fn is_shown(&self, agent: usize, future: &Future) -> bool {
        let futures = self.sample.agents.get(&self.request.scene.agents[agent].id);
        futures.and_then(|f| f.modes.get(f.chosen)).is_some_and(|shown| std::ptr::eq(shown, future))
    }
}
