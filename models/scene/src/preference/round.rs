//! Selection of the next cards.

use super::features::{self, Features, PLACE_S};
use super::taste::Taste;
use super::wishes::{self, Learned};
use super::{Feedback, JudgedCard, Places, Verdict, Wish};
use crate::random::Key;
use crate::{AgentId, Future, Sample, Scene, Vec2};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Two cards differ if a road user is this far apart at some time, metres...
const APART_M: f64 = 1.5;
/// ...or, for slow motions, by the distance that they cover in this time, seconds.
const APART_S: f64 = 1.0;
/// Smallest distance that distinguishes two almost standing motions, metres.
pub const LEAST_APART_M: f64 = 0.3;
/// Below this share of that distance, a card counts as one that was already judged.
const SAME_SHARE: f64 = 0.3;
/// Rule-keeping candidates suffice for a round if there are this many times as many as cards.
const ENOUGH_TIMES: usize = 2;

/// A motion that may become a card: a future of one road user, or a joint scene.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Index of the sample.
    pub sample: usize,
    /// Index of its future; `None` for the whole sample.
    pub mode: Option<usize>,
    /// Its features.
    pub features: Features,
    places: Places,
    broken: bool,
}

/// A candidate on a card.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RoundCard {
    /// Features of the card; the client returns them with the verdict.
    pub features: Features,
    /// Share of the learned wishes that it fulfils; absent if none is known.
    #[serde(rename = "match", skip_serializing_if = "Option::is_none")]
    pub fulfils: Option<f64>,
    /// Box centres at every half second, by road user; the client returns them with the verdict.
    pub places: BTreeMap<AgentId, Vec<[f64; 2]>>,
}

/// A round: the shown candidates, and what has been learned so far.
#[derive(Clone, Debug, PartialEq)]
pub struct Round {
    /// Indices of the shown candidates, the best liked first.
    pub taken: Vec<usize>,
    /// The cards, parallel to `taken`.
    pub cards: Vec<RoundCard>,
    /// Probability of each card to be liked best; they sum to one.
    pub shares: Vec<f64>,
    /// Wishes on which the answers agree, the most certain first.
    pub wishes: Vec<Learned>,
}

impl Candidate {
    /// All futures of one road user.
    pub fn futures(scene: &Scene, samples: &[Sample], id: &str) -> Vec<Self> {
        let futures = samples.iter().enumerate().filter_map(|(k, sample)| Some((k, sample.agents.get(id)?)));
        let modes =
            futures.flat_map(|(k, f)| f.modes.iter().enumerate().map(move |(m, future)| (k, m, future)));
        modes.map(|(sample, mode, future)| Self::of(scene, sample, Some(mode), &[(id, future)])).collect()
    }

    /// All samples, each with the chosen futures of all agents.
    pub fn scenes(scene: &Scene, samples: &[Sample]) -> Vec<Self> {
        let one = |(k, sample): (usize, &Sample)| {
            let futures = sample.agents.iter();
            let motions: Vec<_> =
                futures.filter_map(|(id, f)| Some((id.as_str(), f.modes.get(f.chosen)?))).collect();
            Self::of(scene, k, None, &motions)
        };
        samples.iter().enumerate().map(one).collect()
    }

    /// Whether it breaks no rule and meets its goal.
    pub fn is_clean(&self) -> bool {
        !self.broken
    }

    #[cfg(test)]
    pub(super) fn break_a_rule(&mut self) {
        self.broken = true;
    }

    fn of(scene: &Scene, sample: usize, mode: Option<usize>, motions: &[(&str, &Future)]) -> Self {
        Self {
            sample,
            mode,
            features: Features::of(scene, motions.iter().copied()),
            places: features::places(motions.iter().copied()),
            broken: motions.iter().any(|(_, future)| features::is_broken(future)),
        }
    }

    /// The candidate as a judged card.
    pub fn judged(&self, verdict: Verdict, why: Option<Wish>) -> JudgedCard {
        JudgedCard { features: self.features.clone(), verdict, why, places: self.places.clone() }
    }

    fn card(&self) -> RoundCard {
        let rounded = |v: f64| (v * 1000.0).round() / 1000.0;
        let places = self
            .places
            .iter()
            .map(|(id, places)| (id.clone(), places.iter().map(|p| [rounded(p.x), rounded(p.y)]).collect()));
        RoundCard { features: self.features.clone(), fulfils: None, places: places.collect() }
    }
}

/// The next `count` cards from a draw. Equal draws, feedback and seeds give equal cards. The first card has
/// the greatest posterior mean; each of the others is the best by one draw of the posterior. Candidates that
/// break a rule are taken only if few keep all rules. No card resembles another card or a judged one, so an
/// exhausted draw gives fewer cards.
pub fn choose(candidates: &[Candidate], feedback: &Feedback, count: usize, seed: u64) -> Round {
    let clean: Vec<usize> = (0..candidates.len()).filter(|i| candidates[*i].is_clean()).collect();
    let open = if clean.len() >= ENOUGH_TIMES * count { clean } else { (0..candidates.len()).collect() };
    let draw: Vec<&Features> = open.iter().map(|i| &candidates[*i].features).collect();
    let taste = Taste::learn(feedback, &draw);
    let fresh: Vec<usize> = (0..open.len()).filter(|k| is_new(&candidates[open[*k]], feedback)).collect();
    let mut stream =
        Key::default().text("feedback").number(seed).number(feedback.answers.len() as u64).stream();
    let mut taken: Vec<usize> = Vec::new();
    let best = |likings: &[f64], taken: &[usize]| {
        let place = |k: usize| &candidates[open[k]].places;
        let unlike = |k: &usize| taken.iter().all(|other| are_apart(place(*k), place(*other), 1.0));
        let left = fresh.iter().copied().filter(unlike);
        left.reduce(|best, k| if likings[k] > likings[best] { k } else { best })
    };
    let known: Vec<f64> = draw.iter().map(|features| taste.liking(features)).collect();
    // Before anything is known, the draw's own first guess leads.
    taken.extend(best(&known, &[]));
    while taken.len() < count
        && let Some(next) = best(&taste.maybe(&mut stream, &draw), &taken)
    {
        taken.push(next);
    }
    taken.sort_by(|a, b| known[*b].total_cmp(&known[*a]).then(a.cmp(b)));
    let wishes = wishes::learned(&taste, feedback);
    let card = |k: &usize| {
        let candidate = &candidates[open[*k]];
        let fulfils = wishes::fulfilled(&wishes, feedback, &candidate.features, &draw);
        RoundCard { fulfils, ..candidate.card() }
    };
    let cards = taken.iter().map(card).collect();
    let most = taken.first().map_or(0.0, |k| known[*k]);
    let parts: Vec<f64> = taken.iter().map(|k| (known[*k] - most).exp()).collect();
    let whole: f64 = parts.iter().sum();
    let shares = parts.into_iter().map(|part| part / whole).collect();
    Round { cards, shares, taken: taken.into_iter().map(|k| open[k]).collect(), wishes }
}

fn is_new(candidate: &Candidate, feedback: &Feedback) -> bool {
    feedback.answers.iter().all(|answer| are_apart(&candidate.places, &answer.places, SAME_SHARE))
}

/// Whether some road user in `b` is elsewhere than in `a`, by `share` of the distance that distinguishes two
/// cards.
fn are_apart(a: &Places, b: &Places, share: f64) -> bool {
    let differs = |(id, mine): (&String, &Vec<Vec2>)| {
        let Some(other) = b.get(id) else { return true };
        let way_m: f64 = mine.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        let time_s = mine.len().saturating_sub(1).max(1) as f64 * PLACE_S;
        let least_m = share * (APART_S * way_m / time_s).clamp(LEAST_APART_M, APART_M);
        mine.iter().zip(other).any(|(p, q)| (p - q).norm() > least_m)
    };
    a.iter().any(differs)
}
