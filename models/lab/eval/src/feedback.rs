//! Table 10: how many rounds of cards a person needs to see the wanted future, with learning from feedback
//! and with random draws. The persons are simulated, and their preferences are hidden.

use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::TableSpec;
use super::{Case, Judged, Site, type_name};
use anyhow::Result;
use experts::{Generator, Request};
use rayon::prelude::*;
use scene::AgentType;
use scene::preference::{Candidate, Features, Feedback, Trait, Verdict, Wish, WishDirection, choose};
use scene::random::{Key, Stream};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Persons with individual preferences, for each road user.
const PEOPLE: u64 = 8;
/// Cards of a round.
const CARDS: usize = 6;
/// Number of draws, one for each round; then the first one is repeated with other cards.
const DRAWS: u64 = 8;
/// Rounds after which a simulated user gives up.
const MOST_ROUNDS: usize = 60;
/// Share of all drawn candidates that the person wants: those liked best.
const WANTED: f64 = 0.02;
/// Share of feedback that is reversed by mistake.
const SLIPS: f64 = 0.1;
/// Most rejected cards of a round, those liked least.
const REJECTED: usize = 3;
/// Share of rejected cards for which the user gives a reason.
const SAID_WHY: f64 = 0.5;
/// Number of tries over which random draws are averaged.
const TRIES: u8 = 20;
/// Road users of a scene for each type, the first ones.
const CASES_A_TYPE: usize = 2;

/// Table 10.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 10,
    name: "feedback",
    make: |trial| Ok(vec![feedback(&trial.judged, &trial.sites, &trial.boot, trial.seed)?].into()),
};

/// Rounds until the wanted future is among the cards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rounds {
    /// With feedback.
    pub told: f64,
    /// With feedback, partly with a reason.
    pub why: f64,
    /// With six random cards from the same wide draws.
    pub random: f64,
    /// With the six futures of a new seed each time.
    pub seeds: f64,
}

fn feedback(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Sheet> {
    let mut sheet = Sheet::new(
        "10 Rounds until a person sees what they want",
        &[
            "Simulated people with two or three hidden wishes (more or less of a trait, or about so much; who goes first; \
           what is driven), who want the 2 % that they like best of all that was drawn, keep the best card of a round \
           where it is better than half of all, reject the three worst, and err in a tenth of what they say. Rounds of \
           six cards, 60 when never: told what was kept and rejected; told, \
           and half of the rejected ones with what should be otherwise; six at random of the same wide draws; the six futures \
           of a new seed. Share: rounds told of those at random.",
        ],
        &["ours", "type"],
        &["told", "with why", "at random", "new seeds", "share", "share with why"],
    );
    for own in judged {
        let found: Result<Vec<Vec<_>>> = sites
            .par_iter()
            .map(|site| {
                let of_case = |case: &Case| Ok((case.agent_type, of_case(&own.generator, site, case, seed)?));
                chosen(site).into_iter().map(of_case).collect()
            })
            .collect();
        let found: Vec<Vec<_>> = found?;
        for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
            let all: Vec<(usize, Rounds)> = sites
                .iter()
                .zip(&found)
                .flat_map(|(site, cases)| {
                    let mine = cases.iter().filter(|(of, _)| *of == agent_type);
                    mine.flat_map(|(_, people)| people).map(|rounds| (site.index, *rounds))
                })
                .collect();
            if all.is_empty() {
                continue;
            }
            let mean = |value: fn(&Rounds) -> f64| {
                Cell::of(boot.estimate(all.iter().map(|(k, r)| Value::new(*k, value(r)))), Form::Plain)
            };
            let share = |value: fn(&Rounds) -> f64| {
                let all = all.iter().map(|(k, r)| Value::share(*k, value(r), r.random));
                Cell::of(boot.estimate(all), Form::Percent)
            };
            let cells = vec![
                mean(|r| r.told),
                mean(|r| r.why),
                mean(|r| r.random),
                mean(|r| r.seeds),
                share(|r| r.told),
                share(|r| r.why),
            ];
            sheet.push([own.name.as_str(), type_name(agent_type)], cells);
        }
    }
    Ok(sheet)
}

/// A few road users of each type.
fn chosen<'s>(site: &'s Site<'_>) -> Vec<&'s Case> {
    let of = |agent_type| site.cases.iter().filter(move |c| c.agent_type == agent_type).take(CASES_A_TYPE);
    [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist].into_iter().flat_map(of).collect()
}

/// Rounds of all simulated users with one road user.
pub(super) fn of_case(generator: &Generator, site: &Site<'_>, case: &Case, seed: u64) -> Result<Vec<Rounds>> {
    let scene = Arc::new(site.scene.clone());
    let id = site.log(case).id.clone();
    let mut draws = Vec::new();
    for k in 0..DRAWS {
        let mut request = Request::new(Arc::clone(&scene)).round(Feedback::default());
        request.agents = Some(BTreeSet::from([id.clone()]));
        request.seed = seed + k;
        // The whole draw is needed, not its first cards.
        request.feedback = None;
        let samples = generator.answer(request)?.samples;
        let mut draw = Candidate::futures(&scene, &samples, &id);
        draw.retain(Candidate::is_clean);
        draws.push(draw);
    }
    let people = (0..PEOPLE).filter_map(|number| {
        let person =
            Person::new(&draws, Key::default().words(&["person", &id]).number(seed).number(number).stream())?;
        Some(person.rounds(&draws, seed + number))
    });
    Ok(people.collect())
}

/// A simulated user with a hidden preference.
struct Person {
    wishes: Vec<Hidden>,
    /// Cards liked more than this are wanted.
    wanted: f64,
    /// Cards liked more than this are better than half of all.
    fair: f64,
    stream: Stream,
}

struct Hidden {
    of: Trait,
    average: f64,
    deviation: f64,
    weight: f64,
    /// Preferred value in deviations above the average; `None`: the more the better.
    about: Option<f64>,
}

impl Person {
    fn new(draws: &[Vec<Candidate>], mut stream: Stream) -> Option<Self> {
        let all: Vec<&Features> = draws.iter().flatten().map(|c| &c.features).collect();
        let mut traits: Vec<Trait> = all.iter().flat_map(|f| f.traits()).collect();
        traits.sort();
        traits.dedup();
        let mut differing: Vec<Hidden> =
            traits.into_iter().filter_map(|of| Hidden::new(of, &all, &mut stream)).collect();
        stream.shuffle(&mut differing);
        differing.truncate(2 + stream.below(2));
        if differing.is_empty() {
            return None;
        }
        let mut person = Self { wishes: differing, wanted: 0.0, fair: 0.0, stream };
        let mut likings: Vec<f64> = all.iter().map(|f| person.likes(f)).collect();
        likings.sort_by(f64::total_cmp);
        let at = |share: f64| likings[((likings.len() - 1) as f64 * share) as usize];
        (person.wanted, person.fair) = (at(1.0 - WANTED), at(0.5));
        // If many candidates are liked equally well, there is no best one to find.
        (person.wanted > at(1.0 - 2.0 * WANTED)).then_some(person)
    }

    fn likes(&self, features: &Features) -> f64 {
        self.wishes.iter().map(|wish| wish.likes(features)).sum()
    }

    fn rounds(mut self, draws: &[Vec<Candidate>], seed: u64) -> Rounds {
        let counted = |rounds: Option<usize>| rounds.unwrap_or(MOST_ROUNDS) as f64;
        let drawn = |round: usize| &draws[round % draws.len()];
        let mut told = |said_why: f64| {
            let mut feedback = Feedback::default();
            let seen = (0..MOST_ROUNDS).find(|round| {
                let draw = drawn(*round);
                let next = choose(draw, &feedback, CARDS, seed + 1_000 * *round as u64);
                let cards: Vec<&Candidate> = next.taken.iter().map(|i| &draw[*i]).collect();
                let seen = cards.iter().any(|card| self.wants(card));
                self.answer(&mut feedback, cards, said_why);
                seen
            });
            counted(seen.map(|round| round + 1))
        };
        let (told, why) = (told(0.0), told(SAID_WHY));
        let mut at_random = || {
            let seen = (0..MOST_ROUNDS).find(|round| {
                let mut cards: Vec<&Candidate> = drawn(*round).iter().collect();
                self.stream.shuffle(&mut cards);
                cards.iter().take(CARDS).any(|card| self.wants(card))
            });
            counted(seen.map(|round| round + 1))
        };
        let random = (0..TRIES).map(|_| at_random()).sum::<f64>() / f64::from(TRIES);
        let seeds = (0..MOST_ROUNDS).find(|round| {
            let mut futures = drawn(*round).iter().filter(|c| c.sample == round / draws.len());
            futures.any(|candidate| self.wants(candidate))
        });
        Rounds { told, why, random, seeds: counted(seeds.map(|round| round + 1)) }
    }

    fn wants(&self, card: &Candidate) -> bool {
        self.likes(&card.features) >= self.wanted
    }

    fn answer(&mut self, feedback: &mut Feedback, mut cards: Vec<&Candidate>, said_why: f64) {
        cards.sort_by(|a, b| self.likes(&b.features).total_cmp(&self.likes(&a.features)));
        let best = cards.first().filter(|card| self.likes(&card.features) > self.fair).map(|_| 0);
        let worst = cards.len().saturating_sub(REJECTED).max(1)..cards.len();
        let verdicts = best.into_iter().map(|i| (i, Verdict::Keep));
        for (i, verdict) in verdicts.chain(worst.map(|i| (i, Verdict::Reject))) {
            let why =
                (verdict == Verdict::Reject && self.stream.chance(said_why)).then(|| self.lacks(cards[i]));
            let verdict = match (self.stream.chance(SLIPS), verdict) {
                (false, verdict) => verdict,
                (true, Verdict::Keep) => Verdict::Reject,
                (true, Verdict::Reject) => Verdict::Keep,
            };
            feedback.answers.push(cards[i].judged(verdict, why.flatten()));
        }
    }

    /// The wish that the card satisfies least.
    fn lacks(&self, card: &Candidate) -> Option<Wish> {
        let liked = |wish: &&Hidden| wish.likes(&card.features);
        let least = self.wishes.iter().min_by(|a, b| liked(a).total_cmp(&liked(b)))?;
        Some(least.said(&card.features))
    }
}

impl Hidden {
    /// Nothing if all candidates are alike.
    fn new(of: Trait, all: &[&Features], stream: &mut Stream) -> Option<Self> {
        let values: Vec<f64> = all.iter().filter_map(|f| f.value(&of)).collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let average = mean(&values);
        let deviation = mean(&values.iter().map(|v| (v - average).powi(2)).collect::<Vec<_>>()).sqrt();
        let quantity = !matches!(of, Trait::First { .. } | Trait::Does { .. });
        let weight = if stream.chance(0.5) { 1.0 } else { -1.0 };
        let about = (quantity && stream.chance(1.0 / 3.0)).then(|| stream.between(-1.5, 1.5));
        (deviation > 0.05).then_some(Self { of, average, deviation, weight, about })
    }

    fn measured(&self, features: &Features) -> f64 {
        let value = features.value(&self.of).unwrap_or(self.average);
        ((value - self.average) / self.deviation).clamp(-3.0, 3.0)
    }

    fn likes(&self, features: &Features) -> f64 {
        match self.about {
            Some(about) => -(self.measured(features) - about).powi(2),
            None => self.weight * self.measured(features),
        }
    }

    fn said(&self, features: &Features) -> Wish {
        let rising = self.about.map_or(self.weight, |about| about - self.measured(features));
        Wish {
            of: self.of.clone(),
            wants: if rising > 0.0 { WishDirection::More } else { WishDirection::Less },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_saves_rounds() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../assets/scenes/demo-crossing.json");
        let demo = formats::native::read(&std::fs::read(path).unwrap()).unwrap();
        let site = Site::new(0, &demo);
        let generator = experts::Engine::built_in().unwrap().generator;
        // One of each type; the table has more.
        let cases = chosen(&site).into_iter().step_by(CASES_A_TYPE);
        let found: Vec<Rounds> =
            cases.flat_map(|case| of_case(&generator, &site, case, 1).unwrap()).collect();
        let sum = |value: fn(&Rounds) -> f64| found.iter().map(value).sum::<f64>();
        let (told, why) = (sum(|r| r.told), sum(|r| r.why));
        let (random, seeds) = (sum(|r| r.random), sum(|r| r.seeds));
        let figures = format!("{told} told, {why} with why, {random} at random, {seeds} by new seeds");
        assert!(found.len() > 12, "{} people: {figures}", found.len());
        assert!(2.5 * told <= seeds && 2.0 * told <= random && 2.0 * why <= random, "{figures}");
    }
}
