//! Table 1: distance between futures and the recorded motion, one road user at a time. The given goal is the
//! only known part of the future.

mod sheets;

use sheets::Quality;

use super::measure::{
    Measured, can_be_followed, given_motion, is_met, is_outside_limits, left_to_goal, measure,
};
use super::parked::{parked, standing};
use super::picture;
use super::rivals::{Rival, learned};
use super::table::{Made, TableSpec, Trial};
use super::{Case, Entrants, Site, Subset};
use anyhow::Result;
use experts::{Generator, ReachReport, Request};
use rayon::prelude::*;
use scene::{Agent, AgentFutures, AgentType, Future, HORIZON_STEPS, STANDING_MPS, Scene, wrap_angle};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Table 1, with its pictures.
pub(super) const TABLE: TableSpec = TableSpec { number: 1, name: "quality", make };

fn make(trial: &mut Trial<'_>) -> Result<Made> {
    let outcomes = collect(trial.entrants(), &trial.sites, trial.seed)?;
    let mut sheets = Quality::new(trial.entrants(), &outcomes, &trial.boot).sheets();
    sheets.push(parked(&trial.judged, &trial.sites, &trial.boot, trial.seed)?);
    sheets.push(standing(&trial.judged, &trial.sites, &trial.boot, trial.seed)?);
    let pictures = match trial.judged.first().filter(|_| trial.pictures) {
        Some(own) => picture::of_outcomes(&own.generator, &trial.sites, &outcomes, trial.seed)?,
        None => Vec::new(),
    };
    Ok(Made { sheets, pictures, ..Made::default() })
}

/// Method that answers a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AnswerSource {
    /// The shipped product, with the weights of this index.
    Refined(usize),
    /// The same weights without refinement and noise.
    Initializer(usize),
    /// The learned rival of this index.
    Learned(usize),
    /// A formula without learning.
    Formula(Rival),
}

impl AnswerSource {
    /// All methods, in the order of the tables.
    pub fn all(entrants: Entrants<'_>) -> Vec<Self> {
        let ours = (0..entrants.judged.len()).flat_map(|i| [Self::Refined(i), Self::Initializer(i)]);
        ours.chain(Self::rivals(entrants)).collect()
    }

    /// All rivals.
    pub fn rivals(entrants: Entrants<'_>) -> Vec<Self> {
        let learned = (0..entrants.baselines.len()).map(Self::Learned);
        learned.chain(Rival::ALL.map(Self::Formula)).collect()
    }

    /// All methods with probabilities, by their final answers.
    pub fn answering(entrants: Entrants<'_>) -> Vec<Self> {
        let ours = (0..entrants.judged.len()).map(Self::Refined);
        ours.chain((0..entrants.baselines.len()).map(Self::Learned)).collect()
    }

    /// Name in tables.
    pub fn name(self, entrants: Entrants<'_>) -> String {
        let of = |i: usize| entrants.judged.get(i).map_or("?", |j| j.name.as_str());
        match self {
            Self::Refined(i) => of(i).into(),
            Self::Initializer(i) => format!("{}, initializer alone", of(i)),
            Self::Learned(i) => entrants.baselines.get(i).map_or("?", |b| b.name.as_str()).into(),
            Self::Formula(rival) => rival.name().into(),
        }
    }
}

/// Below this speed recorded headings are noise, m/s.
const TURNING_MPS: f64 = 0.5;

/// Kind of a logged motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Manner {
    turn_deg: f64,
    from_rest: bool,
    stopping: bool,
    seen_throughout: bool,
    followable: bool,
}

impl Manner {
    /// Manner of a case's log from its first step.
    pub fn of(log: &Agent, case: &Case) -> Self {
        let states: Vec<_> = (0..=HORIZON_STEPS).filter_map(|step| log.state_at(step)).collect();
        let moving: Vec<_> = states.iter().filter(|s| s.speed_mps() > TURNING_MPS).collect();
        let turn: f64 = moving.windows(2).map(|w| wrap_angle(w[1].heading_rad - w[0].heading_rad)).sum();
        let speed = |s: Option<&scene::State>| s.map_or(0.0, scene::State::speed_mps);
        let (first, last) = (speed(states.first()), speed(states.last()));
        Self {
            turn_deg: turn.to_degrees().abs(),
            from_rest: first < STANDING_MPS,
            stopping: first > 1.0 && last < STANDING_MPS,
            seen_throughout: case.goal_step == HORIZON_STEPS,
            followable: can_be_followed(log, case),
        }
    }

    /// Whether a log belongs to a group of the breakdown.
    pub fn is(&self, group: Group) -> bool {
        match group {
            Group::All => true,
            Group::Straight => self.turn_deg < 20.0,
            Group::Turning => (20.0..150.0).contains(&self.turn_deg),
            Group::UTurn => self.turn_deg >= 150.0,
            Group::FromRest => self.from_rest,
            Group::Stopping => self.stopping,
            Group::SeenThroughout => self.seen_throughout,
            Group::Followable => self.followable,
            Group::Clean => self.seen_throughout && self.followable,
        }
    }
}

/// A line of the breakdown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Group {
    All,
    Straight,
    Turning,
    UTurn,
    FromRest,
    Stopping,
    SeenThroughout,
    Followable,
    Clean,
}

const GROUPS: [(Group, &str); 9] = [
    (Group::All, "all"),
    (Group::Straight, "straight, under 20 deg"),
    (Group::Turning, "turning, 20 to 149 deg"),
    (Group::UTurn, "U-turn, 150 deg and more"),
    (Group::FromRest, "from rest"),
    (Group::Stopping, "stopping"),
    (Group::SeenThroughout, "logged at 9 s"),
    (Group::Followable, "log within limits"),
    (Group::Clean, "logged at 9 s, within limits"),
];

/// One answer to one case.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Index of the scene.
    pub site: usize,
    /// Index among the scene's cases.
    pub case: usize,
    /// Type of the road user.
    pub agent_type: AgentType,
    /// Condition.
    pub subset: Subset,
    /// Method that answered.
    pub method: AnswerSource,
    /// Errors.
    pub measured: Measured,
    manner: Manner,
    /// Probabilities of the futures; empty for formulas.
    probabilities: Vec<f64>,
    goal: Option<GoalVerdict>,
}

#[derive(Clone, Copy, Debug)]
struct GoalVerdict {
    met: bool,
    reported: bool,
    futures: usize,
    outside: usize,
    /// Distance from the shown future to the goal's position, metres, if that is fixed.
    left_m: Option<f64>,
}

/// A request with the shipped settings, or with the initializer only.
pub(super) fn request(scene: Scene, id: &str, refined: bool, seed: u64) -> Request {
    let mut request = Request::new(Arc::new(scene));
    request.agents = Some(BTreeSet::from([id.to_owned()]));
    request.seed = seed;
    // The logs of the others are withheld, so the answer must not avoid a guess at them.
    request.stages.background_in_the_way = false;
    if !refined {
        (request.steps, request.diversity) = (0, 0.0);
    }
    request
}

/// Futures of a single case, and whether the goal was reported as out of reach.
///
/// # Errors
/// When the generator fails.
pub fn alone(
    generator: &Generator,
    site: &Site<'_>,
    case: &Case,
    subset: Subset,
    refined: bool,
    seed: u64,
) -> Result<Option<(AgentFutures, bool)>> {
    let id = &site.log(case).id;
    let answer = generator.answer(request(site.asked(case, subset), id, refined, seed))?;
    let reach = answer.resolved.get(id).map(|r| &r.reach);
    let reported = matches!(reach, Some(ReachReport::Unreachable { .. }));
    let sample = answer.samples.into_iter().next();
    Ok(sample.and_then(|mut s| s.agents.remove(id)).map(|futures| (futures, reported)))
}

/// Answers of all methods to all cases, by scene, case, condition and method.
///
/// # Errors
/// When a generator fails.
fn collect(entrants: Entrants<'_>, sites: &[Site<'_>], seed: u64) -> Result<Vec<Outcome>> {
    let all: Result<Vec<Vec<Outcome>>> =
        sites.par_iter().map(|site| site_outcomes(entrants, site, seed)).collect();
    Ok(all?.into_iter().flatten().collect())
}

fn site_outcomes(entrants: Entrants<'_>, site: &Site<'_>, seed: u64) -> Result<Vec<Outcome>> {
    let judged = entrants.judged;
    let first = |modes: Vec<Future>| (!modes.is_empty()).then_some((AgentFutures::of(0, modes), false));
    let mut out = Vec::new();
    for (index, case) in site.cases.iter().enumerate() {
        let log = site.log(case);
        let manner = Manner::of(log, case);
        for subset in Subset::ALL {
            for method in AnswerSource::all(entrants) {
                let found = match method {
                    AnswerSource::Refined(i) => alone(&judged[i].generator, site, case, subset, true, seed)?,
                    AnswerSource::Initializer(i) => {
                        alone(&judged[i].generator, site, case, subset, false, seed)?
                    }
                    AnswerSource::Learned(i) => first(learned(&entrants.baselines[i], site, case, subset)?),
                    AnswerSource::Formula(rival) => first(rival.futures(site, case, subset, seed)),
                };
                let Some((futures, reported)) = found else { continue };
                let learned = !matches!(method, AnswerSource::Formula(_));
                out.push(Outcome {
                    site: site.index,
                    case: index,
                    agent_type: case.agent_type,
                    subset,
                    method,
                    measured: measure(log, case, subset, &futures.modes, futures.chosen),
                    manner,
                    probabilities: if learned { given_motion(&futures.modes) } else { Vec::new() },
                    goal: learned.then(|| verdict(site, case, subset, &futures, reported)),
                });
            }
        }
    }
    Ok(out)
}

fn verdict(
    site: &Site<'_>,
    case: &Case,
    subset: Subset,
    futures: &AgentFutures,
    reported: bool,
) -> GoalVerdict {
    let goal = case.goal(site.scene, subset);
    let left = left_to_goal(&goal, case, &futures.modes[futures.chosen]);
    let agent = &site.blind.agents[case.agent];
    let outside = |f: &&Future| is_outside_limits(agent, &case.start, f);
    GoalVerdict {
        left_m: left.filter(|_| subset.has_position()).map(|left| left[0]),
        met: left.is_some_and(is_met),
        reported,
        futures: futures.modes.len(),
        outside: futures.modes.iter().filter(outside).count(),
    }
}

/// Name of a type in tables.
pub fn type_name(agent_type: AgentType) -> &'static str {
    match agent_type {
        AgentType::Vehicle => "vehicle",
        AgentType::Pedestrian => "pedestrian",
        AgentType::Cyclist => "cyclist",
        AgentType::Other => "other",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{east, log};

    #[test]
    fn manners_of_logs() {
        let of = |log: &Agent| {
            let start = log.state_at(0).unwrap();
            Manner::of(log, &Case { agent: 0, agent_type: log.agent_type, goal_step: 90, start })
        };
        let straight = of(&log("a", 10.0, 91));
        assert!(straight.is(Group::Straight) && straight.is(Group::Clean) && !straight.is(Group::FromRest));
        let mut turning = log("b", 10.0, 91);
        for (i, state) in turning.track.states.iter_mut().flatten().enumerate() {
            state.heading_rad = wrap_angle(0.04 * i as f64);
        }
        assert!(of(&turning).is(Group::UTurn));
        let mut stopping = log("c", 10.0, 91);
        stopping.track.states[90] = Some(east(450.0, 0.0, 0.1));
        assert!(of(&stopping).is(Group::Stopping));
    }
}
