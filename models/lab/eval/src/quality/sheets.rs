//! The sheets of table 1.

use super::super::measure::{Measured, log_loss};
use super::super::rivals::Rival;
use super::super::sheet::{Cell, Form, Sheet};
use super::super::stats::{Bootstrap, Estimate, Value};
use super::super::{Entrants, Subset, type_name};
use super::{AnswerSource, GROUPS, GoalVerdict, Outcome};
use scene::AgentType;
use std::collections::{BTreeMap, BTreeSet};

/// Selects one of the errors.
type ErrorOf = fn(&Measured) -> f64;

/// Everything that table 1 prints.
pub struct Quality<'a> {
    entrants: Entrants<'a>,
    outcomes: &'a [Outcome],
    boot: &'a Bootstrap,
    types: Vec<AgentType>,
}

impl<'a> Quality<'a> {
    /// The sheets over these outcomes.
    pub fn new(entrants: Entrants<'a>, outcomes: &'a [Outcome], boot: &'a Bootstrap) -> Self {
        let types: BTreeSet<AgentType> = outcomes.iter().map(|o| o.agent_type).collect();
        Self { entrants, outcomes, boot, types: types.into_iter().collect() }
    }

    /// The sheets, in order.
    pub fn sheets(&self) -> Vec<Sheet> {
        vec![self.errors(), self.differences(), self.breakdown(), self.reliability(), self.goals()]
    }

    fn of(
        &self,
        agent_type: AgentType,
        subset: Subset,
        method: AnswerSource,
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
                 future given that the road user moves, as all of these do; six even ones give 1.79.",
                "The motion of other road users is withheld, so no future avoids them: a guessed motion would be an \
                 obstacle that does not exist. In Table 2 all road users are generated together.",
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
                for method in AnswerSource::all(self.entrants) {
                    let all = || self.of(agent_type, subset, method);
                    if all().next().is_none() {
                        continue;
                    }
                    let plain = |value: ErrorOf| {
                        Cell::of(self.mean(all(), |o| Some(value(&o.measured))), Form::Plain)
                    };
                    let likely = matches!(method, AnswerSource::Formula(_));
                    sheet.push(
                        [type_name(agent_type).into(), subset.name().into(), method.name(self.entrants)],
                        vec![
                            plain(|m| m.min_ade),
                            plain(|m| m.min_fde),
                            plain(|m| m.first_ade),
                            plain(|m| m.first_fde),
                            if likely { Cell::Nothing } else { plain(|m| m.likeliest_ade) },
                            plain(|m| m.closest_ade),
                            Cell::of(self.mean(all(), |o| o.measured.heading_rad), Form::Fine),
                            plain(|m| m.speed_mps),
                            Cell::of(
                                self.mean(all(), |o| log_loss(&o.probabilities, o.measured.best)),
                                Form::Plain,
                            ),
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
        method: AnswerSource,
        value: ErrorOf,
    ) -> BTreeMap<(usize, usize), f64> {
        self.of(agent_type, subset, method).map(|o| ((o.site, o.case), value(&o.measured))).collect()
    }

    /// The product's value minus a rival's, over the cases that both answered.
    fn difference(
        &self,
        agent_type: AgentType,
        subset: Subset,
        [ours, rival]: [AnswerSource; 2],
        value: ErrorOf,
    ) -> Option<Estimate> {
        let theirs = self.by_case(agent_type, subset, rival, value);
        let ours = self.by_case(agent_type, subset, ours, value);
        let paired = ours.iter().filter_map(|(case, v)| Some(Value::new(case.0, v - theirs.get(case)?)));
        self.boot.estimate(paired)
    }

    /// The rival with the least mean, among rivals that answered every case.
    fn best_rival(&self, agent_type: AgentType, subset: Subset, value: ErrorOf) -> Option<AnswerSource> {
        let rivals = AnswerSource::rivals(self.entrants);
        let most = rivals.iter().map(|rival| self.of(agent_type, subset, *rival).count()).max()?;
        let mean = |rival: AnswerSource| {
            let all = self.by_case(agent_type, subset, rival, value);
            (all.len() == most && most > 0).then(|| (all.values().sum::<f64>() / most as f64, rival))
        };
        let least = rivals.into_iter().filter_map(mean).min_by(|a, b| a.0.total_cmp(&b.0));
        least.map(|(_, rival)| rival)
    }

    fn differences(&self) -> Sheet {
        let mut sheet = Sheet::new(
            "1b Paired differences of ADE, ours minus theirs",
            &[
                "Metres, over the same cases; below zero ours is better. A rival with one answer has it as both \
                 its best and its first. \"Best rival\" is the one with the least mean among those that \
                 answer every case, picked for each figure by itself. The last line of a block says what \
                 refinement brings: the shipped settings minus the initializer alone.",
            ],
            &["type", "condition", "ours", "minus"],
            &["minADE6", "first ADE", "best rival of min, of first"],
        );
        let (min, first): (ErrorOf, ErrorOf) = (|m| m.min_ade, |m| m.first_ade);
        for &agent_type in &self.types {
            for subset in Subset::ALL {
                for (i, own) in self.entrants.judged.iter().enumerate() {
                    let ours = AnswerSource::Refined(i);
                    let mut line = |name: &str, a: Option<Estimate>, b: Option<Estimate>, best: Cell| {
                        let keys = [type_name(agent_type), subset.name(), &own.name, name];
                        if a.is_some() {
                            sheet
                                .push(keys, vec![Cell::of(a, Form::Signed), Cell::of(b, Form::Signed), best]);
                        }
                    };
                    let against = |method, value| self.difference(agent_type, subset, [ours, method], value);
                    let best = [min, first].map(|value| self.best_rival(agent_type, subset, value));
                    let [a, b] =
                        [(best[0], min), (best[1], first)].map(|(rival, value)| against(rival?, value));
                    let names = best.map(|r| r.map_or("-".into(), |r| r.name(self.entrants))).join(", ");
                    line("best rival", a, b, Cell::Text(names));
                    for rival in AnswerSource::rivals(self.entrants) {
                        let name = rival.name(self.entrants);
                        line(&name, against(rival, min), against(rival, first), Cell::Nothing);
                    }
                    let alone = AnswerSource::Initializer(i);
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
                 heading; their shares are of its ADE. A vehicle may be in several lines. \"Within limits\": a \
                 vehicle can have driven what is logged (some motion stays within 0.3 m of it and arrives \
                 within 1.5 m/s of its last speed); the other logs are a tracker's mistakes. The best formula \
                 of each figure stands beside ours, over the same vehicles.",
            ],
            &["ours", "condition", "manner"],
            &[
                "minADE6",
                "first ADE",
                "best formula, min",
                "best formula, first",
                "along",
                "across",
                "along, share",
                "across, share",
            ],
        );
        for (i, own) in self.entrants.judged.iter().enumerate() {
            for subset in Subset::ALL {
                for (group, name) in GROUPS {
                    let all = || {
                        let mine = self.of(AgentType::Vehicle, subset, AnswerSource::Refined(i));
                        mine.filter(move |o| o.manner.is(group))
                    };
                    if all().next().is_none() {
                        continue;
                    }
                    let plain = |value: ErrorOf| {
                        Cell::of(self.mean(all(), |o| Some(value(&o.measured))), Form::Plain)
                    };
                    let formula = |value: ErrorOf| {
                        let of = |rival| {
                            let theirs = self.of(AgentType::Vehicle, subset, AnswerSource::Formula(rival));
                            self.mean(theirs.filter(|o| o.manner.is(group)), |o| Some(value(&o.measured)))
                        };
                        let found = Rival::ALL.into_iter().filter_map(of);
                        let complete = found.filter(|e| e.samples == all().count() as u64);
                        Cell::of(complete.min_by(|a, b| a.mean.total_cmp(&b.mean)), Form::Plain)
                    };
                    let share = |value: ErrorOf| {
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
                            formula(|m| m.min_ade),
                            formula(|m| m.first_ade),
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
            &[
                "Futures of all types and conditions by the probability given to them, given that the road user \
                 moves; right is the best one.",
            ],
            &["who", "bin"],
            &["mean probability", "right"],
        );
        for method in AnswerSource::answering(self.entrants) {
            let name = method.name(self.entrants);
            let mine = |o: &&Outcome| o.method == method && o.probabilities.len() > 1;
            let mine: Vec<&Outcome> = self.outcomes.iter().filter(mine).collect();
            for bin in 0..10 {
                let futures = || {
                    mine.iter().flat_map(|o| {
                        let all = o.probabilities.iter().enumerate();
                        all.map(|(k, p)| (o.site, *p, o.measured.best == k)).filter(|(_, p, _)| *p > 0.0)
                    })
                };
                let inside = || futures().filter(|(_, p, _)| ((p * 10.0) as usize).min(9) == bin);
                let low = f64::from(bin as u32) / 10.0;
                sheet.push(
                    [name.clone(), format!("{low:.1} to {:.1}", low + 0.1)],
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
                 that were neither met nor reported unreachable. \"Left\" is the distance from the future shown to \
                 the goal's position, metres.",
            ],
            &["who", "type", "condition"],
            &["met", "met or reported", "silent", "left", "futures", "outside limits"],
        );
        for method in AnswerSource::answering(self.entrants) {
            for &agent_type in &self.types {
                for subset in Subset::ALL {
                    let all: Vec<(usize, GoalVerdict)> =
                        self.of(agent_type, subset, method).filter_map(|o| Some((o.site, o.goal?))).collect();
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
                    let left = all.iter().filter_map(|(s, g)| Some(Value::new(*s, g.left_m?)));
                    let sum = |count: fn(&GoalVerdict) -> usize| {
                        Cell::Count(all.iter().map(|(_, g)| count(g)).sum::<usize>() as u64)
                    };
                    sheet.push(
                        [method.name(self.entrants).as_str(), type_name(agent_type), subset.name()],
                        vec![
                            share(|g| g.met),
                            share(|g| g.met || g.reported),
                            sum(|g| usize::from(!g.met && !g.reported)),
                            Cell::of(self.boot.estimate(left), Form::Plain),
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
