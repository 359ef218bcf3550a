//! The networks' part in a window: first modes, a sample's draw, refinement steps.

use super::actor::{PlannedActor, by_probability};
use super::candidates::leads_by_probability;
use super::diversity::DiverseModes;
use super::drafts::Drafts;
use super::duplicate_modes;
use super::joint_drafts::JointDrafts;
use super::noise::NoiseKey;
use super::overlaps::resolve_overlaps;
use super::repulsion::{outlines, surroundings};
use super::sampling::widen;
use super::slot::Slot;
use super::trajectory::may_rest;
use super::window_setting::WindowSetting;
use crate::features::stays_in_the_world;
use crate::net::{Context, InitialOutput, NetError, Prepared, schedule};
use crate::planning::{MODES, Modes, mode_at};
use crate::request::{GenerateError, Request, Shown};
use crate::tuning::fixed::drafting::STAYS_ABOVE;
use crate::weights::EXPERTS;
use scene::{AgentId, AgentType};

/// Fewest agents of a type in one network call for which splitting over threads pays.
const FEWEST_IN_BATCH: usize = 2;

/// Actors of one expert that run in one network call.
pub(super) struct Batch {
    agent_type: AgentType,
    /// Indices of the window's actors.
    actors: Vec<usize>,
    prepared: Prepared,
}

impl From<NetError> for GenerateError {
    fn from(error: NetError) -> Self {
        Self::Expert(error.to_string())
    }
}

/// Runs encoder and initializer on actors. `first` is the window's index of the first of them.
pub(super) fn encode(
    setting: &WindowSetting<'_>,
    actors: &mut [PlannedActor],
    first: usize,
) -> Result<Vec<Batch>, GenerateError> {
    let workers = setting.workers();
    let mut groups: Vec<(AgentType, Vec<usize>)> = Vec::new();
    for (agent_type, _) in EXPERTS {
        let of_type = |i: &usize| actors[*i].plan.present.agent_type == agent_type;
        let all: Vec<usize> = (0..actors.len()).filter(of_type).collect();
        let run = all.len().div_ceil(workers.threads()).max(FEWEST_IN_BATCH);
        groups.extend(all.chunks(run).map(|part| (agent_type, part.to_vec())));
    }
    let shared = &*actors;
    let results = workers.map(&groups, |(agent_type, members)| {
        let expert = setting.resources.expert(*agent_type)?;
        let features: Vec<_> = members.iter().map(|i| &shared[*i].plan.features).collect();
        let context: Context = expert.encode(&features)?;
        let output = expert.initialize(&context)?;
        let prepared = expert.prepare_refine(&context)?;
        Ok::<_, GenerateError>((output, prepared))
    });
    let mut batches = Vec::with_capacity(groups.len());
    for ((agent_type, members), result) in groups.into_iter().zip(results) {
        let (output, prepared) = result?;
        for (row, index) in members.iter().enumerate() {
            initialize(setting, &mut actors[*index], &output, row)?;
        }
        let actors = members.into_iter().map(|i| i + first).collect();
        batches.push(Batch { agent_type, actors, prepared });
    }
    Ok(batches)
}

/// Sets an actor's first modes, and whether it rests, from a row of the initializer's output.
fn initialize(
    setting: &WindowSetting<'_>,
    actor: &mut PlannedActor,
    output: &InitialOutput,
    row: usize,
) -> Result<(), GenerateError> {
    finite(&output.residual[row], 0, &actor.id)?;
    let tuning = setting.tuning();
    let sure = actor.plan.target.position.is_some();
    let temperature = if sure { 1.0 } else { tuning.probability.temperature };
    actor.weigh_networks(&tuning.speeds);
    let mut modes = actor.weighed(output.residual[row]);
    let mut probability = softmax(&output.log_prob[row], temperature);
    if setting.request.stages.parted {
        duplicate_modes::replace(&actor.plan, &mut modes, &mut probability, &tuning.duplicates);
    }
    actor.set_modes(modes, probability);
    actor.stays_probability = stays_in_the_world(f64::from(output.stays[row]));
    let free = actor.plan.is_free();
    let waits = actor.plan.sets_off();
    let stays = !free || (actor.stays_probability > STAYS_ABOVE && !waits) || actor.is_parked();
    actor.rests = actor.stays_parked
        || (may_rest(&actor.plan, setting.number > 0 || setting.request.drives(&actor.id)) && stays);
    Ok(())
}

/// Fresh drafts for a sample, one entry per actor: the modes plus the draw's noise. `diverse` has one entry
/// per actor.
pub(super) fn first_drafts(
    setting: &WindowSetting<'_>,
    actors: &[PlannedActor],
    batches: &[Batch],
    diverse: &[Option<DiverseModes>],
    sample: usize,
) -> Result<Vec<Drafts>, GenerateError> {
    let request = &*setting.request;
    let key = NoiseKey { seed: request.seed, sample, agent: "", window: setting.number, step: 0 };
    let likeliest_leads = leads_by_probability(request.stages.shown, sample);
    let fresh = |actor: &PlannedActor| {
        let leading = if likeliest_leads {
            actor.likeliest()
        } else {
            let at = NoiseKey { agent: &actor.id, step: u64::MAX, ..key }.unit();
            Slot::new(mode_at(&actor.probability, at))
        };
        Drafts::of(actor, leading)
    };
    let mut drafts: Vec<Drafts> = actors.iter().map(fresh).collect();
    if let Some(&(level, _)) = levels(request).first() {
        for batch in batches {
            let modes: Vec<Modes> = batch.actors.iter().map(|i| drafts[*i].modes).collect();
            // Refinement removes nearly all of the draw's noise again.
            let noise = |i: &usize| NoiseKey { agent: &actors[*i].id, ..key }.normals(request.diversity);
            let noise: Vec<Modes> = batch.actors.iter().map(noise).collect();
            let expert = setting.resources.expert(batch.agent_type)?;
            let noisy = expert.add_noise(&batch.prepared, &modes, &noise, level)?;
            for (i, modes) in batch.actors.iter().zip(noisy) {
                drafts[*i].modes = modes;
            }
        }
    }
    let (diversity, tuning) = (request.diversity, &setting.tuning().diversity);
    let each: Vec<_> = actors.iter().zip(diverse).collect();
    let widened = setting.workers().map(&each, |(actor, diverse)| {
        let diverse = diverse.as_ref()?;
        Some((diverse.offset, widen(actor, diverse, diversity, NoiseKey { agent: &actor.id, ..key }, tuning)))
    });
    for (drafts, widened) in drafts.iter_mut().zip(widened) {
        let Some((offset, (added, probability))) = widened else { continue };
        drafts.add(&offset);
        drafts.add(&added);
        drafts.probability = probability;
        drafts.order = by_probability(&probability);
    }
    Ok(drafts)
}

/// The drafts of every actor after a refinement step.
pub(super) fn refine(
    of: JointDrafts<'_>,
    batches: &[Batch],
    step: usize,
) -> Result<Vec<Drafts>, GenerateError> {
    let JointDrafts { setting, actors, others, sample, .. } = of;
    let mut drafts = of.drafts.to_vec();
    let stages = &setting.request.stages;
    let levels = levels(&setting.request);
    let Some(&level) = levels.get(step - 1) else { return Ok(drafts) };
    // For the first chosen sample, choice and guidance resolve overlaps, and its user is waiting.
    let drawn = sample > 0 || stages.shown != Shown::Chosen;
    let resolves = drawn && stages.refining.resolve_overlaps && step == levels.len();
    let energy = of.energy();
    let obstacles = outlines(others.sweeps(), energy.tuning);
    let attending = attending(setting, batches)?;
    let (workers, refining) = (setting.workers(), &stages.refining);
    let seen = surroundings(&energy, workers, (actors, &drafts), &obstacles, (refining, &attending));
    let results = setting.workers().map(batches, |batch| {
        let modes: Vec<Modes> = batch.actors.iter().map(|i| drafts[*i].plain()).collect();
        let repulsion: Vec<Modes> = batch.actors.iter().map(|i| seen[*i].repulsion).collect();
        let encounters: Vec<_> = batch.actors.iter().map(|i| &seen[*i].encounters).collect();
        let expert = setting.resources.expert(batch.agent_type)?;
        let inputs = (&*repulsion, &*encounters);
        Ok::<_, GenerateError>(expert.refine_step(&batch.prepared, &modes, inputs, level, None)?)
    });
    for (batch, result) in batches.iter().zip(results) {
        for (i, modes) in batch.actors.iter().zip(result?) {
            finite(&modes, step, &actors[*i].id)?;
            drafts[*i].refined(actors[*i].weighed(modes));
        }
    }
    if resolves {
        resolve_overlaps(&energy, actors, &mut drafts, &obstacles);
    }
    Ok(drafts)
}

/// The agent types whose experts attend to encounters.
fn attending(setting: &WindowSetting<'_>, batches: &[Batch]) -> Result<Vec<AgentType>, GenerateError> {
    let mut found = Vec::new();
    for batch in batches {
        if !found.contains(&batch.agent_type) && setting.resources.expert(batch.agent_type)?.attends() {
            found.push(batch.agent_type);
        }
    }
    Ok(found)
}

/// Noise levels of the refinement steps: from the leapfrog start, or from as high as the number of steps
/// needs.
fn levels(request: &Request) -> Vec<(usize, usize)> {
    schedule::ddim(request.stages.refining.start.max(request.steps), request.steps)
}

/// Number of refinement steps of a call.
pub(super) fn steps(request: &Request) -> usize {
    levels(request).len()
}

/// Probabilities from log probabilities; a higher temperature makes them flatter.
fn softmax(log_prob: &[f32; MODES], temperature: f64) -> [f64; MODES] {
    let values = log_prob.map(|l| (f64::from(l) / temperature).exp());
    let sum: f64 = values.iter().sum();
    values.map(|v| v / sum.max(1e-12))
}

fn finite(modes: &Modes, step: usize, agent: &AgentId) -> Result<(), GenerateError> {
    if modes.as_flattened().iter().all(|v| v.is_finite()) {
        return Ok(());
    }
    Err(GenerateError::NonFinite { step, agent: agent.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temperature_flattens() {
        let log_prob = [0.0, -1.0, -2.0, -3.0, -4.0, -5.0];
        let (sharp, flat) = (softmax(&log_prob, 1.0), softmax(&log_prob, 2.5));
        assert!(sharp[0] > flat[0] && sharp[5] < flat[5]);
        assert!((flat.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
