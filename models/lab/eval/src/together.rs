//! Whole scenes: joint generation of all road users that can move, and their overlaps.

use super::measure::at;
use super::{Site, Subset};
use anyhow::Result;
use experts::{Generator, Request, Stages};
use scene::geometry::obb::{OrientedBox, iou, overlaps};
use scene::{AgentType, Future, Goal, HORIZON_STEPS, STANDING_MPS, STEP_S, Sample, Scene, State, Vec2};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Most road users of one call.
const MOST: usize = 128;
/// Every third step is evaluated, except the start.
pub const STRIDE: usize = 3;
/// Number of evaluated moments.
pub const MOMENTS: usize = HORIZON_STEPS / STRIDE;
/// Intersection over union above which the paper counts a collision.
pub const PAPER_IOU: f64 = 0.02;
/// A goal within this distance of a road user's start requires no motion, metres.
const IN_PLACE_M: f64 = 0.3;
/// A log that stays within this distance of its start stands, metres.
const STANDING_M: f64 = 2.0;

/// Options of a whole scene's request.
#[derive(Clone, Copy, Debug)]
pub struct Ask {
    /// Whether moving road users get goals from the log (position, speed, heading); the others keep their
    /// place.
    pub goals: bool,
    /// Refinement steps.
    pub steps: usize,
    /// Scale of the draw's noise.
    pub diversity: f64,
    /// Stages that run.
    pub stages: Stages,
    /// Steps between replans; `None` plans once.
    pub replan_steps: Option<usize>,
    /// Joint scenes.
    pub samples: usize,
    /// Seed; equal seeds give equal answers.
    pub seed: u64,
}

impl Ask {
    /// The shipped settings.
    pub fn shipped(goals: bool, seed: u64) -> Self {
        Self {
            goals,
            steps: 5,
            diversity: 1.0,
            stages: Stages::default(),
            replan_steps: None,
            samples: 1,
            seed,
        }
    }
}

/// Indices of the road users that are generated: moving ones first, at most 128.
pub fn generated(site: &Site<'_>) -> Vec<usize> {
    let moving: Vec<usize> = site.cases.iter().map(|c| c.agent).collect();
    let stands = |i: &usize| {
        let agent = &site.scene.agents[*i];
        agent.agent_type != AgentType::Other && agent.state_at(0).is_some() && !moving.contains(i)
    };
    let others = (0..site.scene.agents.len()).filter(stands);
    moving.iter().copied().chain(others).take(MOST).collect()
}

/// Goal of an agent in a whole scene with goals; free if its log ends too early.
pub fn joint_goal(site: &Site<'_>, agent: usize) -> Goal {
    if let Some(case) = site.cases.iter().find(|c| c.agent == agent) {
        return case.goal(site.scene, Subset::PosSpeedHeading);
    }
    let log = &site.scene.agents[agent];
    match log.state_at(0) {
        Some(start) if log.track.extent_m() < STANDING_M => Goal {
            position: Some(start.position()),
            heading_rad: Some(start.heading_rad),
            speed_mps: Some(0.0),
            time_s: Some(HORIZON_STEPS as f64 * STEP_S),
        },
        _ => Goal::default(),
    }
}

/// The blind scene with the request's goals.
pub fn asked(site: &Site<'_>, goals: bool) -> Scene {
    let mut scene = site.blind.clone();
    if goals {
        for i in generated(site) {
            scene.agents[i].conditions.goal = joint_goal(site, i);
        }
    }
    scene
}

/// Joint scenes of all road users.
///
/// # Errors
/// When the generator fails.
pub fn scenes(generator: &Generator, site: &Site<'_>, ask: Ask) -> Result<Vec<Sample>> {
    let ids: BTreeSet<String> =
        generated(site).into_iter().map(|i| site.scene.agents[i].id.clone()).collect();
    if ids.is_empty() {
        return Ok(Vec::new());
    }
    let mut request = Request::new(Arc::new(asked(site, ask.goals)));
    request.agents = Some(ids);
    (request.steps, request.diversity, request.stages) = (ask.steps, ask.diversity, ask.stages);
    (request.samples, request.seed, request.replan_steps) = (ask.samples, ask.seed, ask.replan_steps);
    Ok(generator.answer(request)?.samples)
}

/// States of all road users at steps 1 ..= 90, by agent of the scene; `None` for agents that are not
/// generated.
pub type Motions = Vec<Option<Vec<State>>>;

/// Shown futures of a sample.
pub fn motions_of(site: &Site<'_>, sample: &Sample) -> Motions {
    let shown = |id: &String| {
        let futures = sample.agents.get(id)?;
        let future: &Future = futures.modes.get(futures.chosen)?;
        (1..=HORIZON_STEPS).map(|step| at(future, step).copied()).collect()
    };
    site.scene.agents.iter().map(|agent| shown(&agent.id)).collect()
}

/// Whether a standing road user keeps its place because it has no goal elsewhere.
pub(super) fn rests(start: &State, goal: &Goal) -> bool {
    let stays = |place: Vec2| (place - start.position()).norm() < IN_PLACE_M;
    start.speed_mps() < STANDING_MPS && goal.position.is_none_or(stays)
}

/// Motions by a formula: `of` gives the states of an agent from its start, under its goal.
pub fn motions_by(
    site: &Site<'_>,
    goals: bool,
    of: impl Fn(usize, &State, &Goal, usize) -> Vec<State>,
) -> Motions {
    let mut out: Motions = vec![None; site.scene.agents.len()];
    for i in generated(site) {
        let Some(start) = site.scene.agents[i].state_at(0) else { continue };
        let goal = if goals { joint_goal(site, i) } else { Goal::default() };
        let step = goal.step_in_window(0.0);
        let rests = rests(&start, &goal);
        let still = State { vx_mps: 0.0, vy_mps: 0.0, ..start };
        out[i] = Some(if rests { vec![still; HORIZON_STEPS] } else { of(i, &start, &goal, step) });
    }
    out
}

/// Logged motions of the road users that are generated.
pub fn motions_of_log(site: &Site<'_>) -> Motions {
    let mut out: Motions = vec![None; site.scene.agents.len()];
    for i in generated(site) {
        let log = &site.scene.agents[i];
        // Gaps are never read: a moment counts only if the log is known.
        let states = (1..=HORIZON_STEPS).map(|step| log.state_at(step).unwrap_or_default());
        out[i] = Some(states.collect());
    }
    out
}

/// Boxes of the generated road users at the moments at which their log is known.
pub struct Boxes {
    boxes: Vec<(usize, Vec<Option<OrientedBox>>)>,
}

impl Boxes {
    /// Of these motions.
    pub fn new(site: &Site<'_>, motions: &Motions) -> Self {
        let of = |i: usize| {
            let agent = &site.scene.agents[i];
            let states = motions[i].as_ref()?;
            let at = |moment: usize| {
                let step = (moment + 1) * STRIDE;
                let known = agent.track.at(step).is_some();
                known.then(|| OrientedBox::of_state(&states[step - 1], &agent.size))
            };
            Some((i, (0..MOMENTS).map(at).collect()))
        };
        Self { boxes: (0..motions.len()).filter_map(of).collect() }
    }

    /// First moment of overlap of each pair of agents, and whether it ever is a collision by the paper's
    /// definition.
    pub fn meetings(&self) -> Vec<OverlappingPair> {
        self.meetings_over(PAPER_IOU)
    }

    /// Overlaps with another threshold of the intersection over union for the paper's definition.
    pub fn meetings_over(&self, threshold: f64) -> Vec<OverlappingPair> {
        let mut out = Vec::new();
        for (k, (i, a)) in self.boxes.iter().enumerate() {
            for (j, b) in &self.boxes[k + 1..] {
                let pairs = || a.iter().zip(b).enumerate().filter_map(|(m, (a, b))| Some((m, (*a)?, (*b)?)));
                let Some(first) = pairs().find(|(_, a, b)| overlaps(a, b, 0.0)).map(|p| p.0) else {
                    continue;
                };
                let paper = pairs().any(|(_, a, b)| iou(&a, &b) > threshold);
                out.push(OverlappingPair { pair: (*i, *j), first, paper });
            }
        }
        out
    }
}

/// Two road users with overlapping boxes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OverlappingPair {
    /// Agents of the scene, the lower index first.
    pub pair: (usize, usize),
    /// Moment at which the overlap begins, from 0.
    pub first: usize,
    /// The boxes' intersection over union exceeds the threshold at some moment; the default is 0.02.
    pub paper: bool,
}

/// Pairs that overlap in the log: detector boxes that touch.
pub fn logged_pairs(site: &Site<'_>) -> BTreeSet<(usize, usize)> {
    Boxes::new(site, &motions_of_log(site)).meetings().into_iter().map(|m| m.pair).collect()
}

#[cfg(test)]
mod tests {
    use super::super::measure::likeliest;
    use super::*;
    use experts::Shown;
    use lab_train::samples::{log, scene, shifted};

    #[test]
    fn what_is_shown_follows_the_stages() {
        let scene = scene(vec![log("a", 8.0, 91), shifted(log("b", 7.0, 91), 30.0, 3.5)]);
        let site = Site::new(0, &scene);
        let generator = Generator::random(3).unwrap().with_threads(1);
        let shown = |shown, guidance, steps, seed| {
            let stages = Stages { shown, guidance, ..Stages::default() };
            let ask = Ask { steps, diversity: 0.0, stages, ..Ask::shipped(false, seed) };
            scenes(&generator, &site, ask).unwrap().remove(0)
        };
        for futures in shown(Shown::Likeliest, false, 0, 1).agents.values() {
            assert_eq!(futures.chosen, likeliest(&futures.modes));
        }
        // Drawn ones repeat for a seed, and other seeds draw others.
        let draws: BTreeSet<Vec<usize>> = (0..8)
            .map(|seed| {
                let sample = shown(Shown::Drawn, false, 0, seed);
                assert_eq!(sample, shown(Shown::Drawn, false, 0, seed));
                sample.agents.values().map(|f| f.chosen).collect()
            })
            .collect();
        assert!(draws.len() > 1);
    }

    #[test]
    fn what_stands_is_asked_to_stay() {
        let scene = scene(vec![log("a", 8.0, 91), shifted(log("b", 0.0, 91), 30.0, 9.0)]);
        let site = Site::new(0, &scene);
        assert_eq!(generated(&site), [0, 1]);
        let goal = joint_goal(&site, 1);
        assert_eq!((goal.position, goal.speed_mps), (Some(Vec2::new(30.0, 9.0)), Some(0.0)));
        assert!(joint_goal(&site, 0).speed_mps.is_some_and(|v| (v - 8.0).abs() < 1e-9));
        assert!(asked(&site, false).agents.iter().all(|a| a.conditions.goal.is_free()));
    }
}
