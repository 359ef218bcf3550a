//! How the futures of a finished sample stand to what the others are shown to do, and what they do.

use super::verdicts::as_shown;
use crate::generator::KnownMap;
use crate::generator::workers::Workers;
use crate::request::Request;
use scene::judge::{Manoeuvre, Relation, Trace, manoeuvre, relations};
use scene::{AgentType, Future, Sample};

/// In larger answers only the shown futures of those that were not asked for get relations.
const FEW: usize = 60;

/// Writes down relations and manoeuvres of the futures of a sample.
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
    let few = futures.len() <= FEW;
    let asked = |id: &str| request.agents.as_ref().is_none_or(|asked| asked.contains(id));
    let is_shown = |id: &str, future: &Future| {
        sample
            .agents
            .get(id)
            .and_then(|f| f.modes.get(f.chosen))
            .is_some_and(|shown| std::ptr::eq(shown, future))
    };
    let found: Vec<(Vec<Relation>, Option<Manoeuvre>)> = workers.map(&futures, |&(i, future)| {
        let (agent, shown) = (&scene.agents[i], &others[i]);
        let lanes = (agent.kind() != AgentType::Pedestrian).then_some(&*map.graph);
        let manoeuvre = manoeuvre(&future.states, agent.kind(), lanes);
        if !few && !asked(&agent.id) && !is_shown(&agent.id, future) {
            return (Vec::new(), manoeuvre);
        }
        let late = future.first_step.saturating_sub(first_step);
        let at = |step: usize| future.states.get(step.checked_sub(late)?).copied();
        let me = Trace::ahead(shown.id(), shown.agent_type(), shown.size(), late + future.states.len(), at);
        (relations(&me, &others, first_step), manoeuvre)
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
