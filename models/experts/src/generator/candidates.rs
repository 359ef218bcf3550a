//! The candidate motions of an actor, each with its origin. The choice picks one per actor.

use super::actor::PlannedActor;
use super::choice::distance;
use super::drafts::Drafts;
use super::slot::Slot;
use super::trajectory::{
    Rollout, as_it_is, driven_again, mean_trajectory, rest, short_along, to_trajectory, without_creep,
};
use crate::planning::{INSTANTS, PER_INSTANT};
use crate::request::{Shown, ShownLast};
use crate::tuning::MiddleTuning;
use scene::motion::{Gear, Reach, Smoothing};
use scene::{AgentType, Vec2};

/// Origin of a candidate. A person's decision is an origin too: a picked future is the only candidate of its
/// actor ([`CandidateOrigin::Pinned`]). Rejected futures would belong here as well: [`candidates`] would drop
/// the modes near them before it derives anything from those modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CandidateOrigin {
    /// The motion that a reacting actor has without this call.
    Kept,
    /// The future that a person picked.
    Pinned,
    /// Rest at the start pose.
    Rest,
    /// The draft of a mode.
    Mode(Slot),
    /// The mean of all modes on one path; this mode is the nearest to it.
    PathMean(Slot),
    /// The motion of this mode that the user saw last, adapted to the present goal.
    Shown(Slot),
    /// The motion that the actor is driving, continued. This mode is the nearest to it.
    UnderWay(Slot),
    /// The draft of this mode after overlaps were resolved.
    Settled(Slot),
    /// The draft of this mode, guided out of a conflict of the chosen scene.
    Guided(Slot),
    /// A motion on the path of this mode that swerves around an obstacle.
    Swerving(Slot),
    /// A motion on the path of this mode that stops before an obstacle.
    Stopping(Slot),
    /// A motion on the path of this mode that follows its leaders and yields to agents that cross first.
    Following(Slot),
}

impl CandidateOrigin {
    /// The mode that the candidate is, was made from, or is nearest to.
    pub(super) fn slot(self) -> Option<Slot> {
        match self {
            Self::Kept | Self::Pinned | Self::Rest => None,
            Self::Mode(slot)
            | Self::PathMean(slot)
            | Self::Shown(slot)
            | Self::UnderWay(slot)
            | Self::Settled(slot)
            | Self::Guided(slot)
            | Self::Swerving(slot)
            | Self::Stopping(slot)
            | Self::Following(slot) => Some(slot),
        }
    }

    /// Whether the motion existed before this answer: the actor had it, or a person picked it.
    pub(super) fn is_given(self) -> bool {
        matches!(self, Self::Kept | Self::Pinned)
    }

    /// Whether the user saw it last.
    pub(super) fn is_shown(self) -> bool {
        matches!(self, Self::Shown(_))
    }

    /// Whether it continues what was shown or driven before.
    pub(super) fn goes_on(self) -> bool {
        matches!(self, Self::Shown(_) | Self::UnderWay(_))
    }

    /// Whether it is an alternative of the answer by itself. Other new motions replace an alternative when
    /// they are chosen.
    pub(super) fn is_alternative(self) -> bool {
        matches!(self, Self::Rest | Self::Mode(_))
    }
}

/// One possible motion of an actor.
#[derive(Clone, Debug)]
pub(super) struct MotionCandidate {
    /// Probability of an alternative; zero for given motions and for motions derived from alternatives.
    pub(super) probability: f64,
    /// Where the motion came from.
    pub(super) origin: CandidateOrigin,
    /// The motion itself.
    pub(super) motion: Rollout,
}

/// The drafts of one actor in one sample, to make candidates from.
pub(super) struct Material<'a> {
    pub(super) actor: &'a PlannedActor,
    pub(super) drafts: &'a Drafts,
    /// An earlier plan already moves the actor.
    pub(super) moves: bool,
    pub(super) tuning: &'a MiddleTuning,
    /// The future that the user saw last, for the sample and window that continue it.
    pub(super) shown: Option<&'a ShownLast>,
    /// The actor is driving that future.
    pub(super) under_way: bool,
    /// Number of alternatives that the choice weighs, the most probable first.
    pub(super) weighed: usize,
}

impl Material<'_> {
    /// All candidates of the actor, in the order that decides ties. Given motions come first.
    pub(super) fn candidates(&self) -> Vec<MotionCandidate> {
        let PlannedActor { plan, pinned, kept, .. } = self.actor;
        let given =
            |origin, states| MotionCandidate { probability: 0.0, origin, motion: as_it_is(plan, states) };
        if let Some(pinned) = pinned {
            return vec![given(CandidateOrigin::Pinned, pinned)];
        }
        let mut out: Vec<MotionCandidate> =
            kept.iter().map(|kept| given(CandidateOrigin::Kept, kept)).collect();
        let alternatives = self.alternatives(self.weighed);
        let means = self.path_means(&alternatives);
        let missed = alternatives.iter().all(|c| !c.motion.reach.is_reached());
        let missed = alternatives.first().filter(|_| missed).map(|c| c.motion.reach);
        let driven = self.driven(&alternatives);
        out.extend(alternatives);
        out.extend(means);
        out.extend(driven);
        out.extend(self.shown_last(missed));
        if let Some(residual) = &self.drafts.settled {
            let slot = self.drafts.leading;
            let motion = self.without_creep(to_trajectory(plan, slot, residual));
            out.push(MotionCandidate { probability: 0.0, origin: CandidateOrigin::Settled(slot), motion });
        }
        out
    }

    /// The motion that was shown last, if it led close to the present goal. A small move of the goal then
    /// moves the motion by little, independent of the modes. If no draft reaches the goal (`missed` holds the
    /// reason), this motion may miss it too.
    fn shown_last(&self, missed: Option<Reach>) -> Option<MotionCandidate> {
        let (slot, places, near) = self.seen()?;
        let plan = &self.actor.plan;
        let motion = match missed {
            Some(reach) => short_along(plan, &places, Smoothing::DRIVEN, false).with_reason_of(reach),
            None if near => driven_again(plan, slot, &places),
            None => return None,
        };
        Some(MotionCandidate { probability: 0.0, origin: CandidateOrigin::Shown(slot), motion })
    }

    /// The motion that the actor is driving, within its limits and extended to its goal.
    fn driven(&self, alternatives: &[MotionCandidate]) -> Option<MotionCandidate> {
        let plan = &self.actor.plan;
        let free = self.under_way && !self.actor.only_rests() && plan.model.gear == Gear::Forward;
        let shown = self.shown.filter(|_| free && self.actor.kept.is_none())?;
        let places: [Vec2; INSTANTS] = shown.places.get(..INSTANTS)?.try_into().ok()?;
        // Smoothed: a plan that is continued every second must not keep every swing.
        let motion = self.without_creep(short_along(plan, &places, Smoothing::WISHED, true));
        let apart = |c: &&MotionCandidate| distance(&c.motion.states, &motion.states);
        let modes = alternatives.iter().filter(|c| matches!(c.origin, CandidateOrigin::Mode(_)));
        let slot = modes.min_by(|a, b| apart(a).total_cmp(&apart(b)))?.origin.slot()?;
        Some(MotionCandidate { probability: 0.0, origin: CandidateOrigin::UnderWay(slot), motion })
    }

    /// The last shown motion, stopping before another agent.
    pub(super) fn shown_stopping(&self) -> Option<MotionCandidate> {
        let (slot, places, near) = self.seen()?;
        let motion = || short_along(&self.actor.plan, &places, Smoothing::DRIVEN, false);
        (!near).then(|| MotionCandidate {
            probability: 0.0,
            origin: CandidateOrigin::Stopping(slot),
            motion: motion(),
        })
    }

    /// Mode and places of the motion that was shown last, and whether they lead close to the present goal.
    fn seen(&self) -> Option<(Slot, [Vec2; INSTANTS], bool)> {
        let shown = self.shown.filter(|_| !self.actor.only_rests() && self.actor.kept.is_none())?;
        let slot = Slot::all().find(|slot| Some(slot.number()) == shown.anchor)?;
        let plan = &self.actor.plan;
        let goal = plan.target.position?;
        let place = |i: usize| match i {
            0 => Some(plan.present.start.position()),
            i => shown.places.get(i - 1).copied(),
        };
        let (instant, past) = (plan.target.step / PER_INSTANT, plan.target.step % PER_INSTANT);
        let from = place(instant)?;
        let to = if past == 0 { from } else { place(instant + 1)? };
        let led = from + (to - from) * (past as f64 / PER_INSTANT as f64);
        let near = (led - goal).norm() <= self.tuning.same_goal_m;
        Some((slot, shown.places.get(..INSTANTS)?.try_into().ok()?, near))
    }

    /// Rest if the actor may rest, then modes by descending probability; at most `count` in all.
    pub(super) fn alternatives(&self, count: usize) -> Vec<MotionCandidate> {
        let actor = self.actor;
        let mut out = Vec::with_capacity(count);
        let mut share = 1.0;
        if actor.rests {
            let certain = actor.only_rests();
            let probability = if certain { 1.0 } else { actor.stays_probability };
            out.push(MotionCandidate {
                probability,
                origin: CandidateOrigin::Rest,
                motion: rest(&actor.plan),
            });
            if certain {
                return out;
            }
            share = 1.0 - probability;
        }
        for &slot in self.drafts.order.iter().take(count.saturating_sub(out.len())) {
            let learned = if middle(actor) == Some(slot) { self.learned_share() } else { 1.0 };
            let residual = slot.of(&self.drafts.modes).map(|r| learned * r);
            let motion = self.without_creep(to_trajectory(&actor.plan, slot, &residual));
            let probability = share * self.drafts.probability[slot.index()];
            out.push(MotionCandidate { probability, origin: CandidateOrigin::Mode(slot), motion });
        }
        out
    }

    /// For actors without a middle mode: the mean of each path's modes. Its expected distance to them is less
    /// than that of any single mode.
    fn path_means(&self, alternatives: &[MotionCandidate]) -> Vec<MotionCandidate> {
        let actor = self.actor;
        if middle(actor).is_some() || actor.only_rests() {
            return Vec::new();
        }
        let path = |slot: Slot| actor.plan.anchors[slot.index()].path_identity();
        let mut paths: Vec<(Slot, Vec<(Slot, &MotionCandidate)>)> = Vec::new();
        for mode in alternatives {
            let CandidateOrigin::Mode(slot) = mode.origin else { continue };
            match paths.iter_mut().find(|(first, _)| path(*first) == path(slot)) {
                Some((_, modes)) => modes.push((slot, mode)),
                None => paths.push((slot, vec![(slot, mode)])),
            }
        }
        let mean = |(first, modes): (Slot, Vec<(Slot, &MotionCandidate)>)| {
            let drafts: Vec<_> =
                modes.iter().map(|(slot, m)| (m.probability, *slot, slot.of(&self.drafts.modes))).collect();
            let motion = self.without_creep(mean_trajectory(&actor.plan, first, &drafts));
            let apart = |m: &MotionCandidate| distance(&m.motion.states, &motion.states);
            let (nearest, _) = modes.iter().min_by(|a, b| apart(a.1).total_cmp(&apart(b.1)))?;
            Some(MotionCandidate { probability: 0.0, origin: CandidateOrigin::PathMean(*nearest), motion })
        };
        paths.into_iter().filter(|(_, modes)| modes.len() > 1).filter_map(mean).collect()
    }

    fn without_creep(&self, motion: Rollout) -> Rollout {
        without_creep(&self.actor.plan, self.moves, motion)
    }

    /// Share of the learned residual that the middle mode keeps.
    fn learned_share(&self) -> f32 {
        learned_share(self.actor, self.tuning)
    }

    /// The mode that the scene is built around. In the first sample it is the middle of the distribution, for
    /// actors that have such a mode. In further samples it is the drawn mode, so that samples differ.
    pub(super) fn around(&self, sample: usize) -> Option<Slot> {
        match sample {
            0 => middle(self.actor),
            _ => (!self.actor.rests).then_some(self.drafts.leading),
        }
    }
}

/// Share of the learned residual that the middle mode keeps.
pub(super) fn learned_share(actor: &PlannedActor, tuning: &MiddleTuning) -> f32 {
    let share = match actor.plan.present.agent_type {
        AgentType::Pedestrian => tuning.learned_on_foot,
        _ => tuning.learned,
    };
    share as f32
}

/// The mode in the middle of the distribution, for an actor with a goal position.
pub(super) fn middle(actor: &PlannedActor) -> Option<Slot> {
    let moves = actor.pinned.is_none() && !actor.rests;
    (moves && actor.plan.target.position.is_some()).then_some(Slot::FIRST)
}

/// The candidate that is shown when the choice does not run: a given motion or rest, else the leading draft.
pub(super) fn own(actor: &PlannedActor, leading: Slot, candidates: &[MotionCandidate]) -> usize {
    let of = |origin: CandidateOrigin| candidates.iter().position(|c| c.origin == origin);
    if actor.pinned.is_some() || actor.kept.is_some() || actor.rests {
        return 0;
    }
    of(CandidateOrigin::Settled(leading)).or_else(|| of(CandidateOrigin::Mode(leading))).unwrap_or(0)
}

/// The alternatives of an answer by descending probability, at most `count`, and the index of the shown one.
/// `None` if the actor keeps a given motion. A chosen candidate that is no alternative replaces the
/// alternative of its slot. `lawful` is the factor of each candidate's probability for the rules that it
/// breaks.
pub(super) fn shown(
    candidates: Vec<MotionCandidate>,
    lawful: &[f64],
    chosen: usize,
    count: usize,
) -> Option<(usize, Vec<MotionCandidate>)> {
    let MotionCandidate { origin, motion, .. } = candidates.get(chosen)?.clone();
    if origin.is_given() {
        return None;
    }
    let stands_for = |c: &MotionCandidate| match origin {
        CandidateOrigin::Rest => c.origin == CandidateOrigin::Rest,
        _ => c.origin.slot() == origin.slot(),
    };
    let weighed = candidates.into_iter().zip(lawful);
    let mut out: Vec<(MotionCandidate, f64)> =
        weighed.filter(|(c, _)| c.origin.is_alternative()).map(|(c, share)| (c, *share)).collect();
    let at = out.iter().position(|(c, _)| stands_for(c))?;
    out[at] = (MotionCandidate { origin, motion, ..out[at].0 }, *lawful.get(chosen)?);
    let all: f64 = out.iter().map(|(c, _)| c.probability).sum();
    let left: f64 = out.iter().map(|(c, share)| c.probability * share).sum();
    for (c, share) in &mut out {
        c.probability *= *share * all / left.max(f64::MIN_POSITIVE);
    }
    let mut out: Vec<(usize, MotionCandidate)> = out.into_iter().map(|(c, _)| c).enumerate().collect();
    out.sort_by(|a, b| b.1.probability.total_cmp(&a.1.probability));
    let mut place = out.iter().position(|(i, _)| *i == at)?;
    if place >= count {
        out.swap(place, 0);
        place = 0;
    }
    out.truncate(count);
    Some((place, out.into_iter().map(|(_, c)| c).collect()))
}

/// Whether first drafts lead by probability or by draw.
pub(super) fn leads_by_probability(how: Shown, sample: usize) -> bool {
    match how {
        Shown::Chosen => sample == 0,
        Shown::Likeliest => true,
        Shown::Drawn => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use scene::Goal;

    fn candidate(probability: f64, origin: CandidateOrigin) -> MotionCandidate {
        MotionCandidate { probability, origin, motion: rest(&car_on_a_street(0.0, Goal::default())) }
    }

    fn six() -> Vec<MotionCandidate> {
        Slot::all().map(|slot| candidate(0.1, CandidateOrigin::Mode(slot))).collect()
    }

    #[test]
    fn what_was_made_from_a_mode_takes_its_place_and_its_probability() {
        let slot = Slot::new(3);
        let mut all = six();
        all[3].probability = 0.5;
        all.push(candidate(0.0, CandidateOrigin::Guided(slot)));
        let (at, alternatives) = shown(all, &[1.0; 7], 6, 6).unwrap();
        assert_eq!((at, alternatives.len()), (0, 6));
        assert_eq!(
            (alternatives[0].origin, alternatives[0].probability),
            (CandidateOrigin::Guided(slot), 0.5)
        );
    }

    #[test]
    fn who_breaks_rules_is_less_likely_and_the_others_more() {
        let lawful = [0.25, 1.0, 1.0, 1.0, 0.5, 1.0];
        let (at, alternatives) = shown(six(), &lawful, 4, 6).unwrap();
        let origins: Vec<usize> = alternatives.iter().map(|c| c.origin.slot().unwrap().index()).collect();
        assert_eq!((at, origins), (4, vec![1, 2, 3, 5, 4, 0]));
        assert!((alternatives.iter().map(|c| c.probability).sum::<f64>() - 0.6).abs() < 1e-12);
        assert!((alternatives[5].probability / alternatives[0].probability - 0.25).abs() < 1e-12);
    }

    #[test]
    fn what_is_shown_in_place_of_a_mode_that_breaks_rules_is_weighed_by_what_it_does_itself() {
        let mut all = six();
        all.push(candidate(0.0, CandidateOrigin::Swerving(Slot::new(2))));
        let (at, alternatives) = shown(all, &[1.0, 1.0, 0.1, 1.0, 1.0, 1.0, 1.0], 6, 6).unwrap();
        assert_eq!((at, alternatives[2].origin), (2, CandidateOrigin::Swerving(Slot::new(2))));
        assert!(alternatives.iter().all(|c| (c.probability - 0.1).abs() < 1e-12));
    }

    #[test]
    fn what_is_shown_is_among_the_alternatives_however_few_are_asked_for() {
        let mut all = six();
        all.push(candidate(0.0, CandidateOrigin::PathMean(Slot::new(4))));
        let (at, alternatives) = shown(all, &[1.0; 7], 6, 2).unwrap();
        let origins: Vec<CandidateOrigin> = alternatives.iter().map(|c| c.origin).collect();
        assert_eq!(
            (at, origins),
            (0, vec![CandidateOrigin::PathMean(Slot::new(4)), CandidateOrigin::Mode(Slot::new(1))])
        );
    }

    #[test]
    fn what_is_given_is_no_part_of_the_answer() {
        assert!(shown(vec![candidate(0.0, CandidateOrigin::Pinned)], &[1.0], 0, 6).is_none());
        let mut reacting = vec![candidate(0.0, CandidateOrigin::Kept)];
        reacting.extend(six());
        assert!(shown(reacting.clone(), &[1.0; 7], 0, 6).is_none());
        let (at, alternatives) = shown(reacting, &[1.0; 7], 1, 6).unwrap();
        assert_eq!(
            (at, alternatives.len(), alternatives[0].origin),
            (0, 6, CandidateOrigin::Mode(Slot::FIRST))
        );
    }

    #[test]
    fn rest_stands_for_itself() {
        let mut all = vec![candidate(0.7, CandidateOrigin::Rest)];
        all.extend(six().into_iter().take(5));
        let (at, alternatives) = shown(all, &[1.0; 6], 0, 6).unwrap();
        assert_eq!((at, alternatives[0].origin, alternatives.len()), (0, CandidateOrigin::Rest, 6));
    }
}
