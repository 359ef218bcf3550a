//! Faults, relations and manoeuvres of the futures of a finished sample. Each future is judged by the rules
//! of a scene's score, against the shown motions of the others or their reactions to it.

use super::future_relations::ShownAgents;
use super::ledger::Instead;
use super::targets::due;
use crate::generator::verdict::{MotionExtent, as_taken, change};
use crate::generator::workers::WorkerPool;
use crate::maps::KnownMap;
use crate::planning::MODES;
use crate::request::Request;
use scene::judge::{About, Change, Judge, Other, by_weight};
use scene::score::Actor;
use scene::{Agent, AgentFutures, Future, STEP_S, Sample};

/// From this many futures on, several threads judge them; it exceeds the modes of one road user.
const MANY: usize = MODES + 1;

/// Sets the faults, relations and manoeuvre of each future of a sample. A future that is not shown is judged
/// against the reactions of the others to it.
pub(super) fn judge(
    request: &Request,
    map: &KnownMap,
    workers: &WorkerPool,
    sample: &mut Sample,
    instead: &Instead,
) {
    let scene = &request.scene;
    let steps = request.start_step..request.start_step + request.horizon_steps + 1;
    let judge = Judge::new(&scene.map, &scene.signals, &map.drivable, steps);
    let judge = judge.with_thresholds(request.thresholds);
    let shown: Vec<Actor<'_>> = scene.agents.iter().map(|agent| as_shown(request, sample, agent)).collect();
    let futures: Vec<(usize, usize, &Future)> = scene
        .agents
        .iter()
        .enumerate()
        .filter_map(|(i, agent)| Some((i, sample.agents.get(&agent.id)?)))
        .flat_map(|(i, futures)| futures.modes.iter().enumerate().map(move |(k, future)| (i, k, future)))
        .collect();
    let standing = ShownAgents::new(request, map, sample, &shown, futures.len());
    let all = sample.agents.values().flat_map(|f| &f.modes);
    let ground = MotionExtent::about(all.flat_map(|f| &f.states).map(scene::State::position));
    let others: Vec<Other<'_>> = shown
        .into_iter()
        .filter(|actor| actor.track.states.iter().flatten().any(|s| ground.holds(s.position())))
        .map(|actor| judge.other(actor))
        .collect();
    let found = workers.map_many(MANY, &futures, |&(i, k, future)| {
        let mut actor = Actor::of_future(&scene.agents[i], future, &[]);
        let due_s = (request.start_step as isize + due(request, i)) as f64 * STEP_S;
        actor.goal.time_s = actor.goal.time_s.or(Some(due_s));
        let other_reactions = instead.get(&(i, k));
        let taken: Vec<(usize, Actor<'_>)> = other_reactions
            .into_iter()
            .flatten()
            .map(|(j, reacts)| {
                (*j, as_taken(request, &scene.agents[*j], reacts.as_ref().and_then(shown_future)))
            })
            .collect();
        let reactions: Vec<(&Agent, &AgentFutures)> = match other_reactions {
            Some(others) => {
                others.iter().filter_map(|(j, f)| Some((&scene.agents[*j], f.as_ref()?))).collect()
            }
            None => scene.agents.iter().filter_map(|a| Some((a, sample.agents.get(&a.id)?))).collect(),
        };
        let id = &scene.agents[i].id;
        let caused =
            reactions.into_iter().filter(|(_, f)| f.reaction.as_ref().is_some_and(|r| r.cause == *id));
        let changes: Vec<Change<'_>> =
            caused.filter_map(|(other, f)| Some(change(request, other, shown_future(f)?))).collect();
        let relations = standing.relations(i, future, &taken);
        let answers: Vec<Other<'_>> = taken.into_iter().map(|(_, actor)| judge.other(actor)).collect();
        let shown = others.iter().filter(|other| answers.iter().all(|own| own.id() != other.id()));
        let mut faults = judge.alone(&actor);
        faults.extend(judge.among(&actor, shown.chain(&answers)));
        faults.extend(judge.towards(&actor, &changes));
        by_weight(&mut faults);
        About { faults, relations, manoeuvre: standing.manoeuvre(i, future) }
    });
    let mut found = found.into_iter();
    for agent in &scene.agents {
        let Some(futures) = sample.agents.get_mut(&agent.id) else { continue };
        for (future, about) in futures.modes.iter_mut().zip(found.by_ref()) {
            future.about = about;
        }
    }
}

/// A road user with its shown motion: its future in the sample, the one that the scene keeps, or its log.
fn as_shown<'a>(request: &'a Request, sample: &'a Sample, agent: &'a Agent) -> Actor<'a> {
    as_taken(request, agent, sample.agents.get(&agent.id).and_then(shown_future))
}

fn shown_future(futures: &AgentFutures) -> Option<&Future> {
    futures.modes.get(futures.chosen)
}
