//! Writes futures as a submission to Waymo's Sim Agents challenge: the samples of a scene are its rollouts.

use super::export::{agent_ids, record_id};
use super::proto::{JointScene, ScenarioRollouts, SimAgentsChallengeSubmission, SimulatedTrajectory};
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, Scenes, written_only};
use crate::frame::{Frame, wrapped};
use crate::loss::{Loss, code};
use crate::refusals;
use crate::sentences;
use crate::source::Source;
use crate::unwritten;
use prost::Message;
use scene::{Agent, STEP_S, Sample, Scene, State};
use std::collections::BTreeSet;
use std::io;

/// Steps of a rollout.
const STEPS: usize = 80;
/// Step from which the challenge plans, which is the present of its scenarios.
const NOW_STEP: usize = 10;
/// Number of rollouts that the challenge requires.
const ROLLOUTS: usize = 32;
/// Number of the kind of submission.
const SIM_AGENTS: i32 = 1;
const METHOD: &str = "DragTraffic";

/// `SimAgentsChallengeSubmission` messages.
pub(crate) struct SimAgents;

impl Format for SimAgents {
    fn info(&self) -> Info {
        Info {
            id: "sim-agents",
            name: "Waymo Sim Agents challenge submission",
            media_type: "application/octet-stream",
            extensions: &["binproto"],
            import: false,
            export: true,
            many: true,
            takes_net: false,
            notes: "Each sample of a scene is a rollout of 80 steps: `generate --samples 32` makes as many \
                 as the challenge takes. Fill in the submitter yourself.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_MODES,
                code::NO_SUBTYPE,
                code::NO_ROLES,
                code::NO_LICENCE,
                code::NO_NOTES,
                code::NO_MAP,
                code::NO_SIGNALS,
                code::NO_SIZES,
                code::NO_JUDGEMENTS,
                code::NO_TIMING,
                code::NO_UNSEEN,
                code::NO_VALIDITY_GAPS,
                code::NO_VELOCITY,
                code::NO_ROLLOUTS,
                code::IDS_RENUMBERED,
            ],
        }
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        written_only(&self.info())
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        scenes.iter().try_for_each(|scene| begins_as_asked(scene, options))?;
        let mut losses = BTreeSet::new();
        let submission = SimAgentsChallengeSubmission {
            scenario_rollouts: scenes.iter().map(|scene| rollouts(scene, options, &mut losses)).collect(),
            submission_type: Some(SIM_AGENTS),
            unique_method_name: Some(METHOD.into()),
            uses_lidar_data: Some(false),
            uses_camera_data: Some(false),
        };
        Ok(Exported { bytes: submission.encode_to_vec(), losses: losses.into_iter().collect() })
    }
}

/// Refuses a scene whose present or futures begin at another step than in the challenge.
fn begins_as_asked(scene: &Scene, options: &ExportOptions) -> io::Result<()> {
    let samples = scene.generated.iter().flat_map(|generated| &generated.samples).enumerate();
    let written = samples.filter(|(i, _)| options.sample.is_none_or(|sample| sample == *i));
    let futures = written.flat_map(|(_, sample)| sample.agents.values().flat_map(|futures| &futures.modes));
    let late = futures.map(|future| future.first_step).find(|first| *first > NOW_STEP + 1);
    let now = scene.time.now_step;
    if now == NOW_STEP && late.is_none() {
        return Ok(());
    }
    let found = late.map_or(now, |first| first - 1);
    let message = refusals::challenge_start(NOW_STEP, found, found as f64 * STEP_S);
    Err(io::Error::new(io::ErrorKind::InvalidInput, message))
}

fn rollouts(scene: &Scene, options: &ExportOptions, losses: &mut BTreeSet<Loss>) -> ScenarioRollouts {
    let mut renumbered = Vec::new();
    let ids = agent_ids(&scene.agents, &mut renumbered);
    losses.extend(renumbered);
    let samples: Vec<&Sample> = scene.generated.iter().flat_map(|generated| &generated.samples).collect();
    // Without futures, the log is the only rollout.
    let samples: Vec<Option<&Sample>> = match options.sample {
        Some(number) => vec![samples.get(number).copied()],
        None if samples.is_empty() => vec![None],
        None => samples.into_iter().map(Some).collect(),
    };
    if samples.len() != ROLLOUTS {
        let lost = sentences::loss_rollouts(samples.len(), ROLLOUTS);
        losses.insert(Loss::counted(code::NO_ROLLOUTS, lost));
    }
    let mut made_up = 0;
    let joint_scenes = samples.iter().map(|sample| {
        let users = scene.agents.iter().zip(&ids);
        let ways = users.filter_map(|(agent, id)| rollout(scene, agent, *id, *sample, &mut made_up));
        JointScene { simulated_trajectories: ways.collect() }
    });
    let joint_scenes = joint_scenes.collect();
    if made_up > 0 {
        losses.insert(Loss::counted(code::NO_VALIDITY_GAPS, sentences::loss_motion_extrapolated(made_up)));
    }
    lost(scene, options, losses);
    ScenarioRollouts { scenario_id: Some(record_id(scene).clone()), joint_scenes }
}

/// The 80 steps after the present one, for a road user that is present.
fn rollout(
    scene: &Scene,
    agent: &Agent,
    id: i32,
    sample: Option<&Sample>,
    made_up: &mut usize,
) -> Option<SimulatedTrajectory> {
    let frame = Frame::of(&scene.meta.origin);
    let futures = sample.and_then(|sample| sample.agents.get(&agent.id));
    let shown = agent.shown(futures.and_then(|futures| futures.modes.get(futures.chosen)));
    let now = scene.time.now_step;
    let mut state = *shown.track.at(now)?;
    let heights = agent.track.z_m.as_deref().unwrap_or_default();
    let height =
        |step: usize| step.checked_sub(agent.track.first_step).and_then(|slot| heights.get(slot)).copied();
    let mut z_m =
        (0..=now).rev().filter(|step| agent.track.at(*step).is_some()).find_map(height).unwrap_or(0.0);
    let mut way = SimulatedTrajectory { object_id: Some(id), ..SimulatedTrajectory::default() };
    let mut unseen = false;
    for step in now + 1..=now + STEPS {
        state = shown.track.at(step).copied().unwrap_or_else(|| {
            unseen = true;
            ahead(&state)
        });
        // A recorded path has its own heights; a generated one keeps the last known height.
        z_m = height(step).filter(|_| futures.is_none() && agent.track.at(step).is_some()).unwrap_or(z_m);
        let at = frame.place(state.position());
        way.center_x.push(at.x as f32);
        way.center_y.push(at.y as f32);
        way.center_z.push(frame.height(z_m) as f32);
        way.heading.push(wrapped(frame.heading(state.heading_rad)) as f32);
    }
    *made_up += usize::from(unseen);
    Some(way)
}

/// The state one step later at the same velocity.
fn ahead(state: &State) -> State {
    State { x_m: state.x_m + state.vx_mps * STEP_S, y_m: state.y_m + state.vy_mps * STEP_S, ..*state }
}

fn lost(scene: &Scene, options: &ExportOptions, losses: &mut BTreeSet<Loss>) {
    let mut lose = |lost: bool, code, detail: &str| {
        losses.extend(lost.then(|| Loss::new(code, detail)));
    };
    lose(*scene.map != scene::LaneMap::default(), code::NO_MAP, "lanes, lines, edges and areas");
    lose(!scene.signals.is_empty(), code::NO_SIGNALS, "traffic signals");
    lose(true, code::NO_VELOCITY, "velocities follow from places");
    lose(true, code::NO_SIZES, "boxes are those of the scenario");
    lose(true, code::NO_SUBTYPE, "kinds are those of the scenario");
    lose(true, code::NO_TIMING, "the past, and all beyond 8 s from now");
    let roles = scene.agents.iter().any(|agent| agent.role.is_some());
    lose(roles, code::NO_ROLES, "roles, that of the ego too");
    let now = scene.time.now_step;
    let absent = scene.agents.iter().any(|agent| agent.track.at(now).is_none());
    lose(absent, code::NO_UNSEEN, "road users who are not there now");
    lose(scene.licence().is_some(), code::NO_LICENCE, "the file has no place for a licence");
    lose(true, code::NO_NOTES, "who submits it, and what they state: that is theirs to fill in");
    if let Some(generated) = &scene.generated {
        let modes =
            generated.samples.iter().flat_map(|sample| sample.agents.values()).any(|f| f.modes.len() > 1);
        lose(modes, code::NO_MODES, "futures other than the chosen one of each sample");
        lose(true, code::NO_JUDGEMENTS, "probabilities and what is said of futures");
    }
    losses.extend(unwritten::conditions(scene, options.motion));
}
