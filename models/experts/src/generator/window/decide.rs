//! What is shown of everybody, once the drafts are settled.

use super::super::actor::kept_boxes;
use super::super::choice::{Choice, distance};
use super::super::realise::{Motion, middle, realise, without_creep};
use super::options::{middle_slot, options, shown_motion};
use super::{Decided, Window};
use crate::planning::MODES;
use crate::request::Shown;

impl Window<'_> {
    /// Chooses one future each. Those that keep what they do, or whose future is pinned, are left out.
    pub(in super::super) fn decide(&self) -> Vec<Decided> {
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        let mut motions: Vec<Vec<(f64, usize, Motion)>> = self.generator.workers.map(&indices, |&i| {
            let mut motions = self.motions(i, MODES);
            motions.extend(self.extras(i, &motions));
            if let Some(residual) = &self.settled[i] {
                let (planned, slot) = (&self.actors[i].planned, self.standing_for[i]);
                let motion = without_creep(planned, self.number, realise(planned, slot, residual));
                motions.push((0.0, slot, motion));
            }
            motions
        });
        let world = self.world();
        let fixed = self.in_the_way(&world).map(|p| kept_boxes(&world, p)).collect();
        let mut choice = Choice { agents: Vec::new(), fixed };
        for (actor, motions) in self.actors.iter().zip(&motions) {
            let around = self.around(choice.agents.len());
            choice.agents.push(options(actor, motions, around, &self.map));
        }
        let mut chosen = match self.request.stages.shown {
            Shown::Chosen => choice.solve(),
            Shown::Likeliest | Shown::Drawn => self.unchosen(&motions, &choice),
        };
        if self.request.stages.guidance {
            self.guide(&world, &mut choice, &mut motions, &mut chosen);
        }
        let mut decided = Vec::with_capacity(self.actors.len());
        for (i, actor) in self.actors.iter().enumerate() {
            let Some(shown) = shown_motion(actor, chosen[i]) else { continue };
            let mut motions = std::mem::take(&mut motions[i]);
            // Any other motion takes the place of the mode it is nearest to or was made from.
            let index = match motions.get(shown) {
                Some((_, slot, _)) if shown >= self.mode_count(i) => {
                    let slot = *slot;
                    let own = motions[..self.mode_count(i)].iter().position(|m| m.1 == slot).unwrap_or(0);
                    let motion = motions[shown].2.clone();
                    motions[own].2 = motion;
                    own
                }
                _ => shown,
            };
            motions.truncate(self.mode_count(i));
            let keep = self.request.modes.max(1);
            let index = if index >= keep {
                motions.swap(index, 0);
                0
            } else {
                index
            };
            motions.truncate(keep);
            decided.push(Decided { agent: actor.planned.present.index, actor: i, chosen: index, motions });
        }
        decided
    }

    /// Options that are shown when nothing is chosen: each road user's own, whatever the others do.
    fn unchosen(&self, motions: &[Vec<(f64, usize, Motion)>], choice: &Choice) -> Vec<usize> {
        let option = |(i, motions): (usize, &Vec<(f64, usize, Motion)>)| {
            let actor = &self.actors[i];
            // Options of a reacting road user begin with the motion it keeps.
            if actor.pinned.is_some() || actor.kept.is_some() || actor.rests {
                return 0;
            }
            let slot = self.standing_for[i];
            let settled = self.settled[i].and(motions.len().checked_sub(1));
            let found = settled.or_else(|| motions.iter().position(|m| m.1 == slot)).unwrap_or(0);
            found.min(choice.agents[i].len().saturating_sub(1))
        };
        motions.iter().enumerate().map(option).collect()
    }

    /// Motions that may be shown beside the modes, each under the slot of the mode that it is nearest to: where
    /// no mode is the middle of what may happen, the mean of each path's modes, which is nearer to all of them
    /// than any one is.
    fn extras(&self, i: usize, motions: &[(f64, usize, Motion)]) -> Vec<(f64, usize, Motion)> {
        let actor = &self.actors[i];
        let has_none = middle_slot(actor).is_some() || actor.pinned.is_some() || actor.keeps_its_path();
        if has_none || self.mode_count(i) == 1 {
            return Vec::new();
        }
        let path = |slot: usize| actor.planned.anchors[slot].identity / 8;
        let mut paths: Vec<Vec<&(f64, usize, Motion)>> = Vec::new();
        for motion in motions.iter().filter(|m| m.1 < MODES) {
            match paths.iter_mut().find(|group| path(group[0].1) == path(motion.1)) {
                Some(group) => group.push(motion),
                None => paths.push(vec![motion]),
            }
        }
        let of_path = |group: Vec<&(f64, usize, Motion)>| {
            let drafts: Vec<_> = group.iter().map(|m| (m.0, m.1, self.drafts[i][m.1])).collect();
            let motion = without_creep(&actor.planned, self.number, middle(&actor.planned, &drafts));
            let apart = |m: &(f64, usize, Motion)| distance(&m.2.states, &motion.states);
            let nearest = group.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?.1;
            Some((0.0, nearest, motion))
        };
        paths.into_iter().filter(|group| group.len() > 1).filter_map(of_path).collect()
    }

    /// The mode that the scene is built around: in the first scene the middle of what may happen, where a mode is
    /// that; in further ones the mode that was drawn, so that each is one of its own.
    pub(super) fn around(&self, i: usize) -> Option<usize> {
        let actor = &self.actors[i];
        match self.sample {
            0 => middle_slot(actor),
            _ => (!actor.rests && !actor.keeps_its_path()).then(|| self.standing_for[i]),
        }
    }

    /// Modes of an actor before extras and guidance added to them.
    pub(super) fn mode_count(&self, i: usize) -> usize {
        let actor = &self.actors[i];
        if actor.rests && (actor.stays_parked || !actor.planned.target.is_free()) { 1 } else { MODES }
    }
}
