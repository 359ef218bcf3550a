//! The chain of reactions: from the agents that a call regenerates to the agents in their way, and from those
//! to others.

use super::giving_way::{SeenMotion, YieldOption};
use super::other::{KeptFrom, OtherAgent, Others, ReactingAgent, Response};
use super::reaction::{reaction, stays_out};
use crate::generator::motion::Sweep;
use crate::generator::window_setting::WindowSetting;
use scene::judge::{Reaction, ReactionKind};
use scene::{AgentId, Future, State};
use std::borrow::Cow;
use std::sync::Arc;

/// Limit of decisions of one agent in a window.
const MOST_DECISIONS: usize = 4;

/// A motion of this answer that other agents may have to yield to.
pub(in crate::generator) struct ChangedMotion {
    pub(in crate::generator) id: AgentId,
    pub(in crate::generator) sweep: Arc<Sweep>,
    /// The agent had this motion before, so other agents that keep an earlier answer do not yield to it.
    pub(in crate::generator) kept: bool,
}

/// An agent that changed its motion because of others.
#[derive(Clone, Debug)]
pub(in crate::generator) struct Reacted {
    /// Index into the scene's agents.
    pub(in crate::generator) index: usize,
    /// Step after the window's start at which the agent is first present.
    pub(in crate::generator) enters: usize,
    /// States from the step after `enters` on.
    pub(in crate::generator) states: Vec<State>,
    /// Number of leading states that belong to the kept motion.
    pub(in crate::generator) own: usize,
    /// `None` for an agent that continues its reaction of an earlier window.
    pub(in crate::generator) reaction: Option<Reaction>,
}

impl Reacted {
    /// Whether the agent does not enter at all.
    pub(in crate::generator) fn stays_out(&self) -> bool {
        self.reaction.as_ref().is_some_and(|reaction| reaction.kind == ReactionKind::StaysOut)
    }

    /// Its motion as a future, up to the end of the call. Empty if it stays out: the agent is absent from the
    /// window's start on.
    pub(in crate::generator) fn future(&self, setting: &WindowSetting<'_>) -> Future {
        if self.stays_out() {
            return Future::bare(1.0, setting.world.step + 1, Vec::new());
        }
        let left = setting.steps_left().saturating_sub(self.enters);
        let states = self.states.iter().take(left).copied().collect();
        Future::bare(1.0, setting.world.step + self.enters + 1, states)
    }
}

impl Others<'_> {
    /// Cost of a motion to the agents that would have to yield to it.
    pub(in crate::generator) fn burden(&self, sweep: &Sweep) -> f64 {
        let cost = |who: ReactingAgent<'_>| {
            let price = self.price(&who.other.sweep, sweep);
            (price > 0.0 && !who.other.is_kept_out_by(sweep)).then(|| {
                let way = self.way(who, &[SeenMotion { reactor: None, kept: false, sweep }], price);
                way.map_or(price, |way| way.cost)
            })
        };
        self.reactors().into_iter().filter_map(cost).sum()
    }

    /// The agents that change their motion because of these changed ones. An agent that is left out keeps its
    /// motion bit for bit.
    pub(in crate::generator) fn reactions(&self, changed: &[&ChangedMotion]) -> Vec<Reacted> {
        let reactors = self.reactors();
        let moved = changed.iter().filter(|c| !c.kept).map(|c| (&c.id, &*c.sweep));
        let mut out = vec![None; self.each.len()];
        self.keep_out(&mut out, moved.clone());
        let ways = self.ways(&reactors, changed, &out);
        let yielding =
            reactors.iter().zip(&ways).filter_map(|(who, way)| Some((&who.other.id, &way.as_ref()?.sweep)));
        self.keep_out(&mut out, yielding);
        // Some agents can neither enter as they are nor brake in time.
        for (who, way) in reactors.iter().zip(&ways) {
            let own = way.as_ref().map_or(&who.other.sweep, |way| &way.sweep);
            let met = || moved.clone().find(|(_, motion)| who.other.comes_in_before(own, motion));
            out[who.at] = out[who.at].or_else(|| met().map(|(id, _)| id));
        }
        let causes = self.causes(&reactors, changed, &ways);
        let stay_out = self.each.iter().zip(&out).filter_map(|(other, cause)| {
            let ((step, state), cause) = (other.entry()?, (*cause)?.clone());
            Some(Reacted {
                index: other.index,
                enters: step,
                states: Vec::new(),
                own: 0,
                reaction: Some(stays_out(state, cause, self.start_step + step)),
            })
        });
        let stay_out: Vec<Reacted> = stay_out.collect();
        let each = reactors.into_iter().zip(ways).zip(causes).filter(|((who, _), _)| out[who.at].is_none());
        let reacted = each.filter_map(|((ReactingAgent { own, .. }, way), cause)| {
            let path = &own.path;
            // The first state is known, unless the agent enters at another speed.
            let of = |states: &[State], own_states: usize, reaction: Option<Reaction>| {
                let known = own_states.min(1);
                Reacted {
                    index: own.index,
                    enters: path.enters + known - 1,
                    states: states.iter().skip(known).copied().collect(),
                    own: own_states - known,
                    reaction,
                }
            };
            match way.zip(cause) {
                Some((way, cause)) => {
                    let reaction = reaction(own, &way, cause, self.start_step);
                    Some(of(&way.states, way.paced.own, Some(reaction)))
                }
                None => own.resumed.then(|| of(&path.states, path.states.len(), None)),
            }
        });
        reacted.chain(stay_out).collect()
    }

    /// For each agent that cannot enter because one of these motions is in its place, records which agent
    /// keeps it out.
    fn keep_out<'a, 'm>(
        &self,
        out: &mut [Option<&'a AgentId>],
        motions: impl Iterator<Item = (&'a AgentId, &'m Sweep)> + Clone,
    ) {
        for (other, out) in
            self.each.iter().zip(out).filter(|(other, out)| other.entry().is_some() && out.is_none())
        {
            let by = motions.clone().find(|(id, motion)| **id != other.id && other.is_kept_out_by(motion));
            *out = by.map(|(id, _)| id);
        }
    }

    /// Every agent's motion by id: the new motion of agents that react, the kept motion of all others.
    pub(in crate::generator) fn with(&self, reacted: &[Reacted]) -> Vec<(&AgentId, Cow<'_, Sweep>)> {
        let changed = |other: &OtherAgent| {
            let new = reacted.iter().find(|r| r.index == other.index && r.reaction.is_some())?;
            if new.stays_out() {
                return Some(Sweep::new(Vec::new(), other.sweep.size()));
            }
            let Response::Reacts(own) = &other.response else { return None };
            // A reaction begins at the step after the agent is first present, unless it enters at another
            // speed.
            let known = own.path.states.first().filter(|_| new.enters >= own.path.enters);
            let states = known.into_iter().chain(&new.states);
            Some(Sweep::entering(own.path.enters, states, &own.size))
        };
        let motion = |other| changed(other).map_or(Cow::Borrowed(&other.sweep), Cow::Owned);
        self.each.iter().map(|other| (&other.id, motion(other))).collect()
    }

    /// Resolves the earliest conflict until no agent can lower its cost.
    fn ways(
        &self,
        reactors: &[ReactingAgent<'_>],
        changed: &[&ChangedMotion],
        out: &[Option<&AgentId>],
    ) -> Vec<Option<YieldOption>> {
        let mut ways: Vec<Option<YieldOption>> = vec![None; reactors.len()];
        // An agent that stays out makes no decision.
        let decisions = |who: &ReactingAgent<'_>| if out[who.at].is_some() { MOST_DECISIONS } else { 0 };
        let mut decisions: Vec<usize> = reactors.iter().map(decisions).collect();
        loop {
            let seen = self.seen(reactors, changed, &ways);
            let first = reactors
                .iter()
                .filter(|who| decisions[who.at] < MOST_DECISIONS)
                .filter_map(|who| Some((first_conflict(*who, ways[who.at].as_ref(), &seen)?, who.at)))
                .min();
            let Some((_, at)) = first else { return ways };
            decisions[at] += 1;
            let others: Vec<SeenMotion<'_>> = seen.into_iter().filter(|s| s.reactor != Some(at)).collect();
            let now = ways[at].as_ref().map_or(&reactors[at].other.sweep, |w| &w.sweep);
            let stays: f64 =
                others.iter().map(|s| self.price(now, s.sweep) + self.tailgating(now, s.sweep)).sum();
            let stays = stays + ways[at].as_ref().map_or(0.0, |_| self.tuning.choice.deviating);
            match self.way(reactors[at], &others, stays - 1e-9) {
                Some(way) => ways[at] = Some(way),
                // No option helps; a later change of another agent may.
                None => decisions[at] = MOST_DECISIONS,
            }
        }
    }

    /// All motions that have changed so far.
    fn seen<'a>(
        &'a self,
        reactors: &[ReactingAgent<'a>],
        changed: &[&'a ChangedMotion],
        ways: &'a [Option<YieldOption>],
    ) -> Vec<SeenMotion<'a>> {
        let asked = changed.iter().map(|c| SeenMotion { reactor: None, kept: c.kept, sweep: &c.sweep });
        let reacting = reactors.iter().zip(ways).filter_map(|(who, way)| {
            let earlier = (who.other.kept_from == KeptFrom::Future).then_some(&who.other.sweep);
            let sweep = way.as_ref().map(|w| &w.sweep).or(earlier)?;
            Some(SeenMotion { reactor: Some(who.at), kept: way.is_none(), sweep })
        });
        let keeping = self.each[self.reacting..].iter().filter(|o| o.kept_from == KeptFrom::Future);
        let keeping = keeping.map(|o| SeenMotion { reactor: None, kept: true, sweep: &o.sweep });
        asked.chain(reacting).chain(keeping).collect()
    }

    /// For each agent, the changed motion with which its kept motion is in conflict; `None` if there is none or
    /// the agent did not change.
    fn causes(
        &self,
        reactors: &[ReactingAgent<'_>],
        changed: &[&ChangedMotion],
        ways: &[Option<YieldOption>],
    ) -> Vec<Option<AgentId>> {
        let mut sources: Vec<(&AgentId, &Sweep)> = changed.iter().map(|c| (&c.id, &*c.sweep)).collect();
        // The agents that keep an earlier answer are sources too.
        let keeps = |at: usize| ways.get(at).is_none_or(Option::is_none);
        let earlier = self.each.iter().enumerate();
        let earlier = earlier.filter(|(at, o)| o.kept_from == KeptFrom::Future && keeps(*at));
        sources.extend(earlier.map(|(_, o)| (&o.id, &o.sweep)));
        let kept: Vec<&Sweep> = reactors.iter().map(|who| &who.other.sweep).collect();
        let changes: Vec<_> =
            ways.iter().zip(reactors).map(|(w, who)| Some((&who.other.id, &w.as_ref()?.sweep))).collect();
        caused(sources, &kept, &changes)
    }
}

/// The first step at which an agent meets a changed motion, or follows one too closely.
fn first_conflict(
    who: ReactingAgent<'_>,
    way: Option<&YieldOption>,
    seen: &[SeenMotion<'_>],
) -> Option<usize> {
    let own = way.map_or(&who.other.sweep, |w| &w.sweep);
    // Two motions kept from earlier answers do not avoid each other.
    let avoids = |s: &SeenMotion<'_>| way.is_some() || !s.kept || who.other.kept_from == KeptFrom::Log;
    let others = seen.iter().filter(|s| s.reactor != Some(who.at) && avoids(s));
    others.filter_map(|s| own.first_conflict(s.sweep)).min()
}

/// The direct cause of each change, if it has one. It is the first motion with which the kept one is in
/// conflict, among the sources and the changes that have a cause themselves.
pub(in crate::generator) fn caused<'a>(
    mut sources: Vec<(&'a AgentId, &'a Sweep)>,
    kept: &[&Sweep],
    changes: &[Option<(&'a AgentId, &'a Sweep)>],
) -> Vec<Option<AgentId>> {
    let mut causes: Vec<Option<AgentId>> = vec![None; changes.len()];
    loop {
        let mut found = Vec::new();
        for (i, change) in changes.iter().enumerate() {
            let (Some(change), None) = (change, &causes[i]) else { continue };
            let first = sources.iter().filter_map(|(id, m)| Some((kept[i].first_conflict(m)?, *id))).min();
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
