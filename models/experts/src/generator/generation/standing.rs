//! How the futures of a finished sample stand to what the others are shown to do, and what they do.

use super::verdicts::as_shown;
use crate::generator::KnownMap;
use crate::generator::workers::Workers;
use crate::request::Request;
use scene::judge::{Manoeuvre, Relation, Trace, manoeuvre, relations};
use scene::{AgentType, Future, Sample};

/// Writes down relations and manoeuvres of the futures of those that were asked for, and of everybody's that is
/// shown.
pub(super) fn relate(request: &Request, map: &KnownMap, workers: &Workers, sample: &mut Sample) {
    let scene = &request.scene;
    let first_step = request.start_step + 1;
    let others: Vec<Trace> = scene
        .agents
        .iter()
        .map(|agent| {
            let shown = as_shown(request, sample, agent);
            let at = |step: usize| shown.state(first_step + step).copied();
            Trace::new(&agent.id, agent.kind(), &shown.size, request.horizon_steps, at)
        })
        .collect();
    let futures: Vec<(usize, &Future)> = scene
        .agents
        .iter()
        .enumerate()
        .filter_map(|(i, agent)| Some((i, sample.agents.get(&agent.id)?)))
        .flat_map(|(i, futures)| futures.modes.iter().map(move |future| (i, future)))
        .collect();
    let found: Vec<(Vec<Relation>, Option<Manoeuvre>)> = workers.map(&futures, |&(i, future)| {
        let (agent, shown) = (&scene.agents[i], &others[i]);
        let late = future.first_step.saturating_sub(first_step);
        let at = |step: usize| future.states.get(step.checked_sub(late)?).copied();
        let me = Trace::ahead(shown.id(), shown.agent_type(), shown.size(), late + future.states.len(), at);
        let lanes = (agent.kind() != AgentType::Pedestrian).then_some(&*map.graph);
        (relations(&me, &others, first_step), manoeuvre(&future.states, agent.kind(), lanes))
    });
    let mut found = found.into_iter();
    for agent in &scene.agents {
        let Some(futures) = sample.agents.get_mut(&agent.id) else { continue };
        for (future, (relations, manoeuvre)) in futures.modes.iter_mut().zip(found.by_ref()) {
            future.about.relations = relations;
            future.about.manoeuvre = manoeuvre;
        }
    }
}
