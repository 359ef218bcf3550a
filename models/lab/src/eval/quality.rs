//! Table 1: how far futures are from what really happened, one road user at a time, nothing known of
//! anybody's future but the goal that is stated.

use super::measure::{Measured, goal_error, is_met, is_outside_limits, measure};
use super::rivals::Rival;
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Estimate, Value};
use super::{Case, Judged, Site, Subset, answer};
use anyhow::Result;
use experts::{Generator, ReachReport, Request};
use rayon::prelude::*;
use scene::{Agent, AgentFutures, AgentType, HORIZON_STEPS, Scene, wrap_angle};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Who answers a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// The product as it is shipped, with the weights of this index.
    Refined(usize),
    /// The same weights without refinement and noise.
    Initializer(usize),
    /// No learning.
    Formula(Rival),
}

impl Method {
    /// All, in the tables' order.
    pub fn all(judged: usize) -> Vec<Self> {
        let ours = (0..judged).flat_map(|i| [Self::Refined(i), Self::Initializer(i)]);
        ours.chain(Rival::ALL.map(Self::Formula)).collect()
    }

    /// Name in tables.
    pub fn name(self, judged: &[Judged]) -> String {
        let of = |i: usize| judged.get(i).map_or("?", |j| j.name.as_str());
        match self {
            Self::Refined(i) => of(i).into(),
            Self::Initializer(i) => format!("{}, initializer alone", of(i)),
            Self::Formula(rival) => rival.name().into(),
        }
    }
}

/// What kind of motion the log shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Manner {
    turn_deg: f64,
    from_rest: bool,
    stopping: bool,
}

impl Manner {
    /// Of a log from its first step.
    pub fn of(log: &Agent) -> Self {
        let states: Vec<_> = (0..=HORIZON_STEPS).filter_map(|step| log.state_at(step)).collect();
        // Headings of those who stand are noise.
        let moving: Vec<_> = states.iter().filter(|s| s.speed_mps() > 0.5).collect();
        let turn: f64 = moving.windows(2).map(|w| wrap_angle(w[1].heading_rad - w[0].heading_rad)).sum();
        let speed = |s: Option<&scene::State>| s.map_or(0.0, scene::State::speed_mps);
        let (first, last) = (speed(states.first()), speed(states.last()));
        Self {
            turn_deg: turn.to_degrees().abs(),
            from_rest: first < 0.3,
            stopping: first > 1.0 && last < 0.3,
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
}

const GROUPS: [(Group, &str); 6] = [
    (Group::All, "all"),
    (Group::Straight, "straight, under 20 deg"),
    (Group::Turning, "turning, 20 to 149 deg"),
    (Group::UTurn, "U-turn, 150 deg and more"),
    (Group::FromRest, "from rest"),
    (Group::Stopping, "stopping"),
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
    /// Who answered.
    pub method: Method,
    /// Errors.
    pub measured: Measured,
    manner: Manner,
    /// By future; empty for formulas.
    probabilities: Vec<f64>,
    goal: Option<GoalVerdict>,
}

#[derive(Clone, Copy, Debug)]
struct GoalVerdict {
    met: bool,
    reported: bool,
    futures: usize,
    outside: usize,
}

/// The shipped settings, or the initializer as it is.
fn request(scene: Scene, id: &str, refined: bool, seed: u64) -> Request {
    let mut request = Request::new(Arc::new(scene));
    request.agents = Some(BTreeSet::from([id.to_owned()]));
    request.seed = seed;
    if !refined {
        (request.steps, request.diversity) = (0, 0.0);
    }
    request
}

/// Futures of one case by itself, and whether the goal was said to be out of reach.
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
    let answer = answer(generator, request(site.asked(case, subset), id, refined, seed))?;
    let reach = answer.resolved.get(id).map(|r| &r.reach);
    let reported = matches!(reach, Some(ReachReport::Unreachable { .. }));
    let sample = answer.samples.into_iter().next();
    Ok(sample.and_then(|mut s| s.agents.remove(id)).map(|futures| (futures, reported)))
}

/// Answers of everybody to all cases, in order of scenes, cases, conditions, methods.
///
/// # Errors
/// When a generator fails.
pub fn collect(judged: &[Judged], sites: &[Site<'_>], seed: u64) -> Result<Vec<Outcome>> {
    let all: Result<Vec<Vec<Outcome>>> =
        sites.par_iter().map(|site| site_outcomes(judged, site, seed)).collect();
    Ok(all?.into_iter().flatten().collect())
}

fn site_outcomes(judged: &[Judged], site: &Site<'_>, seed: u64) -> Result<Vec<Outcome>> {
    let mut out = Vec::new();
    for (index, case) in site.cases.iter().enumerate() {
        let log = site.log(case);
        let manner = Manner::of(log);
        for subset in Subset::ALL {
            for method in Method::all(judged.len()) {
                let found = match method {
                    Method::Refined(i) => alone(&judged[i].generator, site, case, subset, true, seed)?,
                    Method::Initializer(i) => alone(&judged[i].generator, site, case, subset, false, seed)?,
                    Method::Formula(rival) => {
                        let modes = rival.futures(site, case, subset, seed);
                        (!modes.is_empty()).then_some((AgentFutures { chosen: 0, modes }, false))
                    }
                };
                let Some((futures, reported)) = found else { continue };
                let ours = !matches!(method, Method::Formula(_));
                out.push(Outcome {
                    site: site.index,
                    case: index,
                    agent_type: case.agent_type,
                    subset,
                    method,
                    measured: measure(log, case, subset, &futures.modes, futures.chosen),
                    manner,
                    probabilities: if ours {
                        futures.modes.iter().map(|f| f.probability).collect()
                    } else {
                        Vec::new()
                    },
                    goal: ours.then(|| verdict(site, case, subset, &futures, reported)),
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
    let shown = futures.modes[futures.chosen].states.get(case.goal_step - 1);
    let agent = &site.blind.agents[case.agent];
    let outside = |f: &&scene::Future| is_outside_limits(agent, &case.start, f);
    GoalVerdict {
        met: shown.is_some_and(|s| is_met(goal_error(&goal, s))),
        reported,
        futures: futures.modes.len(),
        outside: futures.modes.iter().filter(outside).count(),
    }
}

/// Everything that table 1 prints.
pub struct Quality<'a> {
    judged: &'a [Judged],
    outcomes: &'a [Outcome],
    boot: &'a Bootstrap,
    types: Vec<AgentType>,
}

impl<'a> Quality<'a> {
    /// Over these outcomes.
    pub fn new(judged: &'a [Judged], outcomes: &'a [Outcome], boot: &'a Bootstrap) -> Self {
        let types: BTreeSet<AgentType> = outcomes.iter().map(|o| o.agent_type).collect();
        Self { judged, outcomes, boot, types: types.into_iter().collect() }
    }

    /// The sheets, in order.
    pub fn sheets(&self) -> Vec<Sheet> {
        vec![self.errors(), self.differences(), self.breakdown(), self.reliability(), self.goals()]
    }

    fn of(
        &self,
        agent_type: AgentType,
        subset: Subset,
        method: Method,
    ) -> impl Iterator<Item = &'a Outcome> + Clone {
        let fits = move |o: &&Outcome| o.agent_type == agent_type && o.subset == subset && o.method == method;
        self.outcomes.iter().filter(fits)
    }

    fn mean<'o>(
        &self,
        outcomes: impl Iterator<Item = &'o Outcome>,
        value: impl Fn(&Outcome) -> Option<f64>,
    ) -> Option<Estimate> {
        self.boot.estimate(outcomes.filter_map(|o| Some(Value::new(o.site, value(o)?))))
    }

    fn errors(&self) -> Sheet {
        let mut sheet = Sheet::new(
            "1a Distance from the log",
            &[
                "Metres; mean over road users and its 95 % interval. One road user at a time; of all others only \
                 the state at the first step is known. \"First\" is the future shown; FDE is taken at the log's \
                 last frame, with a goal position at the frame before. Heading and speed are those of the future \
                 closest at its end, as in the paper, whose ADE stands under \"closest\". Log loss of the best \
                 future; six even ones give 1.79.",
            ],
            &["type", "condition", "method"],
            &[
                "minADE6",
                "minFDE6",
                "first ADE",
                "first FDE",
                "most probable ADE",
                "closest ADE",
                "heading, rad",
                "speed, m/s",
                "log loss",
            ],
        );
        for &agent_type in &self.types {
            for subset in Subset::ALL {
                for method in Method::all(self.judged.len()) {
                    let all = || self.of(agent_type, subset, method);
                    if all().next().is_none() {
                        continue;
                    }
                    let plain = |value: fn(&Measured) -> f64| {
                        Cell::of(self.mean(all(), |o| Some(value(&o.measured))), Form::Plain)
                    };
                    let likely = matches!(method, Method::Formula(_));
                    sheet.push(
                        [type_name(agent_type).into(), subset.name().into(), method.name(self.judged)],
                        vec![
                            plain(|m| m.min_ade),
                            plain(|m| m.min_fde),
                            plain(|m| m.first_ade),
                            plain(|m| m.first_fde),
                            if likely { Cell::Nothing } else { plain(|m| m.likeliest_ade) },
                            plain(|m| m.closest_ade),
                            Cell::of(self.mean(all(), |o| o.measured.heading_rad), Form::Fine),
                            plain(|m| m.speed_mps),
                            Cell::of(self.mean(all(), log_loss), Form::Plain),
                        ],
                    );
                }
            }
        }
        sheet
    }

    /// Values of one method by case.
    fn by_case(
        &self,
        agent_type: AgentType,
        subset: Subset,
        method: Method,
        value: fn(&Measured) -> f64,
    ) -> BTreeMap<(usize, usize), f64> {
        self.of(agent_type, subset, method).map(|o| ((o.site, o.case), value(&o.measured))).collect()
    }

    /// Ours minus a rival's, over the cases that both answered.
    fn difference(
        &self,
        agent_type: AgentType,
        subset: Subset,
        [ours, rival]: [Method; 2],
        value: fn(&Measured) -> f64,
    ) -> Option<Estimate> {
        let theirs = self.by_case(agent_type, subset, rival, value);
        let ours = self.by_case(agent_type, subset, ours, value);
        let paired = ours.iter().filter_map(|(case, v)| Some(Value::new(case.0, v - theirs.get(case)?)));
        self.boot.estimate(paired)
    }

    /// The rival with the least mean, of those that answered every case.
    fn best_rival(
        &self,
        agent_type: AgentType,
        subset: Subset,
        value: fn(&Measured) -> f64,
    ) -> Option<Rival> {
        let count = |rival| self.of(agent_type, subset, Method::Formula(rival)).count();
        let most = Rival::ALL.into_iter().map(count).max()?;
        let mean = |rival: Rival| {
            let all = self.by_case(agent_type, subset, Method::Formula(rival), value);
            (all.len() == most && most > 0).then(|| (all.values().sum::<f64>() / most as f64, rival))
        };
        let least = Rival::ALL.into_iter().filter_map(mean).min_by(|a, b| a.0.total_cmp(&b.0));
        least.map(|(_, rival)| rival)
    }

    fn differences(&self) -> Sheet {
        let mut sheet = Sheet::new(
            "1b Paired differences of ADE, ours minus theirs",
            &[
                "Metres, over the same cases; below zero ours is better. A rival with one answer has it as both \
                 its best and its first. \"Best rival\" is the formula with the least mean among those that \
                 answer every case, picked for each figure by itself. The last line of a block says what \
                 refinement brings: the shipped settings minus the initializer alone.",
            ],
            &["type", "condition", "ours", "minus"],
            &["minADE6", "first ADE", "best rival of min, of first"],
        );
        let (min, first): (fn(&Measured) -> f64, fn(&Measured) -> f64) = (|m| m.min_ade, |m| m.first_ade);
        for &agent_type in &self.types {
            for subset in Subset::ALL {
                for (i, own) in self.judged.iter().enumerate() {
                    let ours = Method::Refined(i);
                    let mut line = |name: &str, a: Option<Estimate>, b: Option<Estimate>, best: Cell| {
                        let keys = [type_name(agent_type), subset.name(), &own.name, name];
                        if a.is_some() {
                            sheet
                                .push(keys, vec![Cell::of(a, Form::Signed), Cell::of(b, Form::Signed), best]);
                        }
                    };
                    let against = |method, value| self.difference(agent_type, subset, [ours, method], value);
                    let best = [min, first].map(|value| self.best_rival(agent_type, subset, value));
                    let [a, b] = [(best[0], min), (best[1], first)]
                        .map(|(rival, value)| against(Method::Formula(rival?), value));
                    let names = best.map(|r| r.map_or("-", Rival::name)).join(", ");
                    line("best rival", a, b, Cell::Text(names));
                    for rival in Rival::ALL {
                        let method = Method::Formula(rival);
                        line(rival.name(), against(method, min), against(method, first), Cell::Nothing);
                    }
                    let alone = Method::Initializer(i);
                    line("initializer alone", against(alone, min), against(alone, first), Cell::Nothing);
                }
            }
        }
        sheet
    }

    fn breakdown(&self) -> Sheet {
        let mut sheet = Sheet::new(
            "1c Vehicles by manner",
            &[
                "Metres. \"Along\" and \"across\" are the mean absolute errors of the future shown in the log's \
                 heading; their shares are of its ADE. A vehicle may be in several lines.",
            ],
            &["ours", "condition", "manner"],
            &["minADE6", "first ADE", "along", "across", "along, share", "across, share"],
        );
        for (i, own) in self.judged.iter().enumerate() {
            for subset in Subset::ALL {
                for (group, name) in GROUPS {
                    let all = || {
                        let mine = self.of(AgentType::Vehicle, subset, Method::Refined(i));
                        mine.filter(move |o| o.manner.is(group))
                    };
                    if all().next().is_none() {
                        continue;
                    }
                    let plain = |value: fn(&Measured) -> f64| {
                        Cell::of(self.mean(all(), |o| Some(value(&o.measured))), Form::Plain)
                    };
                    let share = |value: fn(&Measured) -> f64| {
                        let of = |o: &Outcome| Value::share(o.site, value(&o.measured), o.measured.first_ade);
                        let found = self.boot.estimate(all().map(of));
                        // The weights are metres, the samples road users.
                        let found = found.map(|e| Estimate { samples: all().count() as u64, ..e });
                        Cell::of(found, Form::Percent)
                    };
                    sheet.push(
                        [own.name.as_str(), subset.name(), name],
                        vec![
                            plain(|m| m.min_ade),
                            plain(|m| m.first_ade),
                            plain(|m| m.along),
                            plain(|m| m.across),
                            share(|m| m.along),
                            share(|m| m.across),
                        ],
                    );
                }
            }
        }
        sheet
    }

    fn reliability(&self) -> Sheet {
        let mut sheet = Sheet::new(
            "1d Do the probabilities mean what they say?",
            &["Futures of all types and conditions by the probability given to them; right is the best one."],
            &["ours", "bin"],
            &["mean probability", "right"],
        );
        for (i, own) in self.judged.iter().enumerate() {
            let mine: Vec<&Outcome> = self
                .outcomes
                .iter()
                .filter(|o| o.method == Method::Refined(i) && o.probabilities.len() > 1)
                .collect();
            for bin in 0..10 {
                let futures = || {
                    mine.iter().flat_map(|o| {
                        let all = o.probabilities.iter().enumerate();
                        all.map(|(k, p)| (o.site, *p, o.measured.best == k))
                    })
                };
                let inside = || futures().filter(|(_, p, _)| ((p * 10.0) as usize).min(9) == bin);
                let low = f64::from(bin as u32) / 10.0;
                sheet.push(
                    [own.name.clone(), format!("{low:.1} to {:.1}", low + 0.1)],
                    vec![
                        Cell::of(
                            self.boot.estimate(inside().map(|(s, p, _)| Value::new(s, p))),
                            Form::Percent,
                        ),
                        Cell::of(
                            self.boot.estimate(inside().map(|(s, _, right)| Value::flag(s, right))),
                            Form::Percent,
                        ),
                    ],
                );
            }
        }
        sheet
    }

    fn goals(&self) -> Sheet {
        let mut sheet = Sheet::new(
            "1e Goals met, limits kept",
            &[
                "A goal is met within 0.05 m, 0.02 rad and 0.05 m/s by the future shown. \"Silent\" counts goals \
                 that were neither met nor reported unreachable.",
            ],
            &["ours", "type", "condition"],
            &["met", "met or reported", "silent", "futures", "outside limits"],
        );
        for (i, own) in self.judged.iter().enumerate() {
            for &agent_type in &self.types {
                for subset in Subset::ALL {
                    let all: Vec<(usize, GoalVerdict)> = self
                        .of(agent_type, subset, Method::Refined(i))
                        .filter_map(|o| Some((o.site, o.goal?)))
                        .collect();
                    if all.is_empty() {
                        continue;
                    }
                    let share = |holds: fn(&GoalVerdict) -> bool| {
                        let flags = all.iter().map(|(s, g)| Value::flag(*s, holds(g)));
                        if subset == Subset::None {
                            return Cell::Nothing;
                        }
                        Cell::of(self.boot.estimate(flags), Form::Percent)
                    };
                    let sum = |count: fn(&GoalVerdict) -> usize| {
                        Cell::Count(all.iter().map(|(_, g)| count(g)).sum::<usize>() as u64)
                    };
                    sheet.push(
                        [own.name.as_str(), type_name(agent_type), subset.name()],
                        vec![
                            share(|g| g.met),
                            share(|g| g.met || g.reported),
                            sum(|g| usize::from(!g.met && !g.reported)),
                            sum(|g| g.futures),
                            sum(|g| g.outside),
                        ],
                    );
                }
            }
        }
        sheet
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

/// Negative log likelihood of the best future; `None` where there was one alone, or for formulas.
fn log_loss(outcome: &Outcome) -> Option<f64> {
    let p = outcome.probabilities.get(outcome.measured.best)?;
    (outcome.probabilities.len() > 1).then(|| -p.max(1e-6).ln())
}

#[cfg(test)]
mod tests {
    use super::super::samples::{east, log};
    use super::*;

    #[test]
    fn manners_of_logs() {
        let straight = Manner::of(&log("a", 10.0, 91));
        assert!(straight.is(Group::Straight) && straight.is(Group::All) && !straight.is(Group::FromRest));
        let mut turning = log("b", 10.0, 91);
        for (i, state) in turning.track.states.iter_mut().flatten().enumerate() {
            state.heading_rad = wrap_angle(0.04 * i as f64);
        }
        assert!(Manner::of(&turning).is(Group::UTurn));
        let mut stopping = log("c", 10.0, 91);
        stopping.track.states[90] = Some(east(450.0, 0.0, 0.1));
        assert!(Manner::of(&stopping).is(Group::Stopping));
    }
}
