//! Who answers whom: from those that were asked for to whoever they are in the way of, and on from there.

use super::course::Moving;
use super::giving_way::{Seen, Way, first_meeting};
use super::reaction::reaction;
use super::{Answerers, Keeps};
use scene::judge::Reaction;
use scene::score::SweptBoxes;
use scene::{AgentId, State};

/// How often one road user thinks again in a window.
const MOST_THOUGHTS: usize = 4;

/// A motion of this answer that others may have to answer.
pub(in crate::generator) struct Changed {
    pub(in crate::generator) id: AgentId,
    pub(in crate::generator) moving: Moving,
    /// It had it before: those who keep an earlier answer too do not mind.
    pub(in crate::generator) kept: bool,
}

/// Somebody who gave up its motion.
#[derive(Clone, Debug)]
pub(in crate::generator) struct Answered {
    /// Index into the scene's agents.
    pub(in crate::generator) index: usize,
    /// Steps after the window's start at which it is there first.
    pub(in crate::generator) enters: usize,
    /// From the step after that on.
    pub(in crate::generator) states: Vec<State>,
    /// So many of them are what it did anyway.
    pub(in crate::generator) own: usize,
    /// `None` for one that goes on with what it answered in an earlier window.
    pub(in crate::generator) reaction: Option<Reaction>,
}

impl Answerers<'_> {
    /// What a motion costs those who would have to answer it.
    pub(in crate::generator) fn burden(&self, moving: &Moving) -> f64 {
        let meets = (0..self.all.len()).filter_map(|i| {
            let price = self.price(&self.all[i].kept, moving);
            (price > 0.0).then_some((i, price))
        });
        meets
            .map(|(i, price)| {
                let way = self.way(i, &[Seen { answerer: None, kept: false, moving }]);
                way.map_or(price, |way| way.cost.min(price))
            })
            .sum()
    }

    /// Who gives up its motion for these changed ones, and how. Whoever is left out keeps it to the last byte.
    pub(in crate::generator) fn answers(&self, changed: &[&Changed]) -> Vec<Answered> {
        let ways = self.ways(changed);
        let causes = self.causes(changed, &ways);
        let answered = ways.into_iter().zip(causes).enumerate().filter_map(|(i, (way, cause))| {
            let own = &self.all[i];
            let of = |states: &[State], own_steps: usize, reaction: Option<Reaction>| Answered {
                index: own.index,
                enters: own.course.enters,
                states: states.iter().skip(1).copied().collect(),
                own: own_steps,
                reaction,
            };
            match way.zip(cause) {
                Some((way, cause)) => {
                    let reaction = reaction(own, &way, cause, self.start_step);
                    Some(of(&way.states, way.paced.own - 1, Some(reaction)))
                }
                None => own.resumed.then(|| of(&own.course.states, own.course.states.len() - 1, None)),
            }
        });
        answered.collect()
    }

    /// The first conflict at a time is answered until none is left that somebody can do something about.
    fn ways(&self, changed: &[&Changed]) -> Vec<Option<Way>> {
        let mut ways: Vec<Option<Way>> = vec![None; self.all.len()];
        let mut thoughts = vec![0; self.all.len()];
        loop {
            let seen = self.seen(changed, &ways);
            let first = (0..self.all.len())
                .filter(|i| thoughts[*i] < MOST_THOUGHTS)
                .filter_map(|i| Some((self.first_conflict(i, ways[i].as_ref(), &seen)?, i)))
                .min();
            let Some((_, who)) = first else { return ways };
            thoughts[who] += 1;
            let others: Vec<Seen<'_>> = seen.into_iter().filter(|s| s.answerer != Some(who)).collect();
            let now = ways[who].as_ref().map_or(&self.all[who].kept, |w| &w.moving);
            let stays: f64 = others.iter().map(|s| self.price(now, s.moving)).sum();
            let stays = stays + ways[who].as_ref().map_or(0.0, |_| self.tuning.choice.deviating);
            match self.way(who, &others) {
                Some(way) if way.cost < stays - 1e-9 => ways[who] = Some(way),
                // Nothing helps as things are; another's change may.
                _ => thoughts[who] = MOST_THOUGHTS,
            }
        }
    }

    /// All changed motions as they are by now.
    fn seen<'a>(&'a self, changed: &[&'a Changed], ways: &'a [Option<Way>]) -> Vec<Seen<'a>> {
        let asked = changed.iter().map(|c| Seen { answerer: None, kept: c.kept, moving: &c.moving });
        let answering = ways.iter().enumerate().filter_map(|(i, way)| {
            let own = &self.all[i];
            let earlier = (own.keeps == Keeps::Future).then_some(&own.kept);
            let moving = way.as_ref().map(|w| &w.moving).or(earlier)?;
            Some(Seen { answerer: Some(i), kept: way.is_none(), moving })
        });
        let fixed = self.fixed.iter().filter(|f| f.keeps == Keeps::Future);
        let fixed = fixed.map(|f| Seen { answerer: None, kept: true, moving: &f.moving });
        asked.chain(answering).chain(fixed).collect()
    }

    /// The first step at which somebody meets a changed motion.
    fn first_conflict(&self, who: usize, way: Option<&Way>, seen: &[Seen<'_>]) -> Option<usize> {
        let own = &self.all[who];
        let moving = way.map_or(&own.kept, |w| &w.moving);
        // Earlier answers do not mind each other as long as both are kept.
        let minds = |s: &Seen<'_>| way.is_some() || !s.kept || own.keeps == Keeps::Log;
        let others = seen.iter().filter(|s| s.answerer != Some(who) && minds(s));
        others.filter_map(|s| first_meeting(&moving.swept, &s.moving.swept)).min()
    }

    /// Whose changed motion each one's kept motion meets, reached from those that were asked for; `None` for those
    /// that have no cause, or no change.
    fn causes(&self, changed: &[&Changed], ways: &[Option<Way>]) -> Vec<Option<AgentId>> {
        let mut sources: Vec<_> = changed.iter().map(|c| (&c.id, &c.moving.swept)).collect();
        sources.extend(self.earlier(ways));
        let kept: Vec<&SweptBoxes> = self.all.iter().map(|a| &a.kept.swept).collect();
        let changes: Vec<_> =
            ways.iter().zip(&self.all).map(|(w, a)| Some((&a.id, &w.as_ref()?.moving.swept))).collect();
        caused(sources, &kept, &changes)
    }

    /// Those who keep an earlier answer.
    fn earlier<'a>(&'a self, ways: &'a [Option<Way>]) -> impl Iterator<Item = (&'a AgentId, &'a SweptBoxes)> {
        let keep = |keeps| keeps == Keeps::Future;
        let answering = self.all.iter().zip(ways).filter(move |(a, w)| keep(a.keeps) && w.is_none());
        let fixed = self.fixed.iter().filter(move |f| keep(f.keeps)).map(|f| (&f.id, &f.moving.swept));
        answering.map(|(a, _)| (&a.id, &a.kept.swept)).chain(fixed)
    }
}

/// The direct cause of each change, if it has one: whose motion the kept one meets first, among the sources and those
/// that have a cause themselves.
pub(in crate::generator) fn caused<'a>(
    mut sources: Vec<(&'a AgentId, &'a SweptBoxes)>,
    kept: &[&SweptBoxes],
    changes: &[Option<(&'a AgentId, &'a SweptBoxes)>],
) -> Vec<Option<AgentId>> {
    let mut causes: Vec<Option<AgentId>> = vec![None; changes.len()];
    loop {
        let mut found = Vec::new();
        for (i, change) in changes.iter().enumerate() {
            let (Some(change), None) = (change, &causes[i]) else { continue };
            let first = sources.iter().filter_map(|(id, m)| Some((first_meeting(kept[i], m)?, *id))).min();
            if let Some((_, cause)) = first {
                causes[i] = Some(cause.clone());
                found.push(*change);
            }
        }
        if found.is_empty() {
            return causes;
        }
        sources.extend(found);
    }
}
