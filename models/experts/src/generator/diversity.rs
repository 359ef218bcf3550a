//! Makes the six modes of an agent six distinguishable futures.
//!
//! Modes have different anchors, yet they often coincide with a goal, before a junction or in a queue. The
//! second of two coinciding modes adds nothing, so it is changed. It passes a crossing agent in an order that
//! no other mode has, or else gets another pace or lateral offset. The changed mode gets a low probability.
//! Its change is an offset that the networks do not see, so refinement keeps it.

use super::actor::PlannedActor;
use super::candidates::middle;
use super::slot::Slot;
use super::stepping_out::steps_out;
use super::variations::{DraftView, HURRY, pace_steps};
use crate::planning::{MODES, Modes, RESIDUAL, Residual};
use crate::tuning::DuplicateTuning;
use crate::tuning::fixed::duplicate_modes::NO_COPY;
use scene::judge::{Trace, crossing};

/// Number of crossing agents that the best guess considers: those with the smallest time shift.
const MOST_STREAMS: usize = 3;
/// Number of modes that are no copies but are replaced to cover a missing order.
const MOST_GIVEN_UP: usize = 2;

/// The changes that make the modes of an actor six different futures.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DiverseModes {
    /// Offset that is added to each mode.
    pub(super) offset: Modes,
    /// Probability of each mode; they sum to one.
    pub(super) probability: [f64; MODES],
    /// Modes that no draw changes: the best guess, and modes with a given order or wait.
    pub(super) steady: [bool; MODES],
}

impl DiverseModes {
    /// No changes.
    pub(super) fn none(actor: &PlannedActor) -> Self {
        let mut steady = [false; MODES];
        steady[best(actor).index()] = true;
        Self { offset: [[0.0; RESIDUAL]; MODES], probability: actor.probability, steady }
    }

    /// The changes for an actor among others. `share` is the factor of the middle mode's residual.
    pub(super) fn of(actor: &PlannedActor, others: &[&Trace], share: f32, tuning: &DuplicateTuning) -> Self {
        let views: Vec<DraftView<'_>> = Slot::all()
            .map(|slot| {
                let share = if middle(actor) == Some(slot) { share } else { 1.0 };
                DraftView::of(actor, slot, &slot.of(&actor.modes).map(|r| share * r))
            })
            .collect();
        let near: Vec<&Trace> = others
            .iter()
            .copied()
            .filter(|o| o.id() != actor.id && views.iter().any(|s| s.trace().may_meet(o)))
            .collect();
        let mut found =
            Diversifying { diverse: Self::none(actor), actor, near, views, accepted: Vec::new(), tuning };
        found.run();
        found.diverse
    }
}

/// The mode that is the best guess; it is never changed.
pub(super) fn best(actor: &PlannedActor) -> Slot {
    middle(actor).unwrap_or(actor.likeliest())
}

/// Mean distance below which two modes are copies, metres.
pub(super) fn copy_m(actor: &PlannedActor, tuning: &DuplicateTuning) -> f64 {
    if actor.plan.target.position.is_some() { tuning.copy_with_goal_m } else { tuning.copy_m }
}

struct Diversifying<'a> {
    diverse: DiverseModes,
    actor: &'a PlannedActor,
    near: Vec<&'a Trace>,
    /// View of each mode, by slot.
    views: Vec<DraftView<'a>>,
    /// Slots that are not copies.
    accepted: Vec<usize>,
    tuning: &'a DuplicateTuning,
}

impl<'a> Diversifying<'a> {
    fn run(&mut self) {
        let copy_m = copy_m(self.actor, self.tuning);
        let first = best(self.actor).index();
        // By slot and not by probability: a slot keeps its variation while the user drags a goal.
        let order = std::iter::once(first).chain((0..MODES).filter(|i| *i != first));
        let mut copies: Vec<(usize, usize)> = Vec::new();
        for i in order {
            let twin = self.accepted.iter().find(|j| self.views[i].apart_m(&self.views[**j]) < copy_m);
            match twin {
                Some(j) => copies.push((i, *j)),
                None => self.accepted.push(i),
            }
        }
        let missing = self.missing_orders(first);
        let waits = self.waits_until(first);
        if copies.is_empty() && missing.is_empty() && waits.is_none() {
            return;
        }
        let mut free: Vec<usize> = copies.iter().map(|c| c.0).collect();
        free.sort_unstable();
        if let Some(passed_s) = waits {
            let path = self.actor.plan.anchors[first].path_identity();
            let make = |diversifying: &Self, i: usize| {
                let same = diversifying.actor.plan.anchors[i].path_identity() == path;
                let like = &diversifying.views[first];
                same.then(|| diversifying.views[i].waiting_at_kerb(like, passed_s)).flatten()
            };
            self.give(&make, first, &mut free);
        }
        for (stream, before) in missing {
            let make = |diversifying: &Self, i: usize| {
                let made = diversifying.views[i].ordered(stream, before)?;
                diversifying.is_free(&diversifying.views[i], &made).then_some(made)
            };
            self.give(&make, first, &mut free);
        }
        for i in free {
            if let Some(made) = self.another(i, copy_m) {
                self.take(i, made);
            }
        }
        self.share_out(&copies);
    }

    /// Orders (before or after) in which no accepted mode passes the agents whose paths the best guess
    /// crosses.
    fn missing_orders(&self, first: usize) -> Vec<(&'a Trace, bool)> {
        let me = self.views[first].trace();
        let mut streams: Vec<(i64, &'a Trace)> =
            self.near.iter().filter_map(|other| Some((crossing(me, other)?.least_shift(), *other))).collect();
        streams.sort_by(|a, b| a.0.cmp(&b.0).then_with(|| a.1.id().cmp(b.1.id())));
        streams.truncate(MOST_STREAMS);
        let has = |other: &Trace, wanted: i64| {
            self.accepted
                .iter()
                .any(|i| crossing(self.views[*i].trace(), other).is_some_and(|g| g.order() == wanted))
        };
        let each = |(_, other): (i64, &'a Trace)| [(other, true), (other, false)];
        let wants = streams.into_iter().flat_map(each);
        wants.filter(|(other, before)| !has(other, if *before { 1 } else { -1 })).collect()
    }

    /// For a walker: the time at which the last vehicle has passed that the best guess would step out in
    /// front of, seconds. `None` if an accepted mode waits at the kerb until then.
    fn waits_until(&self, first: usize) -> Option<f64> {
        let plan = &self.actor.plan;
        let kerb = plan.kerbs[first].as_ref().filter(|_| plan.target.position.is_none())?;
        let me = self.views[first].trace();
        let passed_s = self.near.iter().filter_map(|other| steps_out(me, other)).reduce(f64::max)?;
        let waits = |i: &usize| {
            let at_m = self.views[*i].along_at(passed_s);
            plan.kerbs[*i].is_some() && (kerb.line_m - 2.0..=kerb.line_m).contains(&at_m)
        };
        (!self.accepted.iter().any(waits)).then_some(passed_s)
    }

    /// Gives a variation to a copy, or to an unlikely mode on a path that another mode has too.
    fn give(
        &mut self,
        made: &dyn Fn(&Self, usize) -> Option<DraftView<'a>>,
        first: usize,
        free: &mut Vec<usize>,
    ) {
        if let Some((at, found)) = free.iter().enumerate().find_map(|(at, i)| Some((at, made(self, *i)?))) {
            let i = free.remove(at);
            self.diverse.steady[i] = true;
            self.take(i, found);
            return;
        }
        let given_up = (0..MODES).filter(|i| self.diverse.steady[*i] && *i != first).count();
        if !free.is_empty() || given_up >= MOST_GIVEN_UP {
            return;
        }
        let path = |i: usize| self.actor.plan.anchors[i].path_identity();
        let mut unlikely: Vec<usize> = (0..MODES)
            .filter(|i| *i != first && !self.diverse.steady[*i])
            .filter(|i| (0..MODES).any(|j| j != *i && path(j) == path(*i)))
            .collect();
        unlikely.sort_by(|a, b| self.actor.probability[*a].total_cmp(&self.actor.probability[*b]));
        if let Some((i, found)) = unlikely.into_iter().find_map(|i| Some((i, made(self, i)?))) {
            self.accepted.retain(|j| *j != i);
            self.diverse.steady[i] = true;
            self.take(i, found);
        }
    }

    /// Another pace or line for a copy, apart from all present modes.
    fn another(&self, i: usize, copy_m: f64) -> Option<DraftView<'a>> {
        let from = &self.views[i];
        let free_target = self.actor.plan.target.position.is_none();
        // An agent that waits without a goal has a reason to wait.
        let waits = free_target && from.ends_at_rest();
        let tries = pace_steps(&self.actor.plan, i % 2 == 1).into_iter().map(|offset| from.with(&offset));
        tries
            .filter(|made| !waits || made.way_m() <= from.way_m())
            .filter(|made| self.accepted.iter().all(|j| made.apart_m(&self.views[*j]) > NO_COPY * copy_m))
            .find(|made| made.is_usual(from, HURRY) && self.is_free(from, made))
    }

    /// Whether the changed draft meets no agent that the original draft does not meet.
    fn is_free(&self, from: &DraftView<'_>, made: &DraftView<'_>) -> bool {
        self.near.iter().all(|other| !made.trace().meets(other) || from.trace().meets(other))
    }

    fn take(&mut self, i: usize, made: DraftView<'a>) {
        let before: &Residual = &self.views[i].residual;
        self.diverse.offset[i] = std::array::from_fn(|k| made.residual[k] - before[k]);
        self.views[i] = made;
        self.accepted.push(i);
    }

    /// Moves the probability of a changed copy to the mode that it copied. Every changed mode gets the tuned
    /// low probability.
    fn share_out(&mut self, copies: &[(usize, usize)]) {
        let made = |i: usize| self.diverse.offset[i] != [0.0; RESIDUAL];
        let mut probability = self.diverse.probability;
        for (i, twin) in copies.iter().filter(|(i, _)| made(*i)) {
            probability[*twin] += probability[*i];
            probability[*i] = 0.0;
        }
        let count = (0..MODES).filter(|i| made(*i)).count() as f64;
        let rest: f64 = (0..MODES).filter(|i| !made(*i)).map(|i| probability[i]).sum();
        let left = 1.0 - count * self.tuning.probability;
        for (i, p) in probability.iter_mut().enumerate() {
            *p = if made(i) { self.tuning.probability } else { *p * left / rest.max(1e-12) };
        }
        self.diverse.probability = probability;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::{car_on_a_street, walker_beside_a_street};
    use crate::planning::INSTANTS;
    use crate::tuning::SHIPPED;
    use scene::geometry::direction;
    use scene::{AgentType, Goal, Size, State, Subtype, Vec2};

    fn driver(speed_mps: f64, goal_m: Option<f64>) -> PlannedActor {
        let position = goal_m.map(|x| Vec2::new(x, 0.0));
        let mut actor = PlannedActor::new(
            "1".into(),
            car_on_a_street(speed_mps, Goal { position, ..Goal::default() }),
            None,
        );
        // All modes are equal to the first.
        let first = actor.plan.anchors[0].clone();
        actor.plan.anchors.iter_mut().for_each(|anchor| *anchor = first.clone());
        actor
    }

    /// Crosses the street at x = 40 after this many seconds.
    fn crossing_at(passes_s: f64) -> Trace {
        let size = Size::default_for(AgentType::Vehicle, Subtype::Car);
        let at = |step: usize| {
            let v = direction(std::f64::consts::FRAC_PI_2) * 9.0;
            let y_m = 9.0 * (0.1 * (step + 1) as f64 - passes_s);
            let heading_rad = std::f64::consts::FRAC_PI_2;
            Some(State { x_m: 40.0, y_m, heading_rad, vx_mps: v.x, vy_mps: v.y })
        };
        Trace::new("7", AgentType::Vehicle, &size, 90, at)
    }

    fn shown<'a>(actor: &'a PlannedActor, diverse: &DiverseModes) -> Vec<DraftView<'a>> {
        let offset = |slot: Slot| *slot.of(&diverse.offset);
        Slot::all().map(|slot| DraftView::of(actor, slot, &offset(slot))).collect()
    }

    fn nearest_m(all: &[DraftView<'_>]) -> f64 {
        let pairs = (0..all.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.map(|(a, b)| all[a].apart_m(&all[b])).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn six_alike_become_six_that_keep_the_goal() {
        let actor = driver(9.0, Some(80.0));
        let diverse = DiverseModes::of(&actor, &[], 1.0, &SHIPPED.duplicates);
        let all = shown(&actor, &diverse);
        assert!(nearest_m(&all) > SHIPPED.duplicates.copy_with_goal_m, "{}", nearest_m(&all));
        assert_eq!(diverse.offset[0], [0.0; RESIDUAL], "the best guess stays");
        for view in &all {
            assert!((view.way_m() - all[0].way_m()).abs() < 0.05, "{}", view.way_m());
        }
        assert!((diverse.probability.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{:?}", diverse.probability);
        assert!(diverse.probability[0] > 0.85, "what is made up is unlikely: {:?}", diverse.probability);
    }

    #[test]
    fn one_goes_before_and_one_after_whoever_crosses() {
        let actor = driver(9.0, Some(80.0));
        for passes_s in [4.4, 4.6] {
            let other = crossing_at(passes_s);
            let diverse = DiverseModes::of(&actor, &[&other], 1.0, &SHIPPED.duplicates);
            let all = shown(&actor, &diverse);
            let orders: Vec<i64> =
                all.iter().filter_map(|s| Some(crossing(s.trace(), &other)?.order())).collect();
            assert!(orders.contains(&1) && orders.contains(&-1), "{passes_s}: {orders:?}");
            assert!(nearest_m(&all) > 0.5, "{}", nearest_m(&all));
        }
    }

    #[test]
    fn who_would_step_out_before_a_fast_car_may_wait_at_the_kerb_too() {
        let mut actor = PlannedActor::new("1".into(), walker_beside_a_street(1.4), None);
        actor.set_modes([[0.0; RESIDUAL]; MODES], [0.4, 0.12, 0.12, 0.12, 0.12, 0.12]);
        let car = |passes_s: f64| {
            let size = Size::default_for(AgentType::Vehicle, Subtype::Car);
            let at = |step: usize| {
                let x_m = 12.0 * (0.1 * (step + 1) as f64 - passes_s);
                Some(State { x_m, vx_mps: 12.0, ..State::default() })
            };
            Trace::new("7", AgentType::Vehicle, &size, 90, at)
        };
        let line_m = actor.plan.kerbs[0].as_ref().unwrap().line_m;
        assert!((3.0..4.25).contains(&line_m), "before the lane: {line_m}");
        let waiting = |diverse: &DiverseModes, passes_s: f64| {
            let all = shown(&actor, diverse);
            let at_kerb = |s: &&DraftView<'_>| {
                let stands_m = s.along_at(passes_s + 0.3);
                (line_m - 1.0..line_m + 0.3).contains(&stands_m)
            };
            all.iter().filter(at_kerb).map(|s| s.slot.index()).collect::<Vec<_>>()
        };
        let comes = car(4.6);
        let diverse = DiverseModes::of(&actor, &[&comes], 1.0, &SHIPPED.duplicates);
        let found = waiting(&diverse, 4.6);
        assert!(found.iter().any(|i| diverse.steady[*i] && *i != 0), "{found:?}");
        assert!(found.iter().all(|i| !shown(&actor, &diverse)[*i].trace().meets(&comes)));
        assert_eq!(diverse.offset[0], [0.0; RESIDUAL], "the best guess stays");
        // No vehicle approaches that would have to brake.
        let alone = DiverseModes::of(&actor, &[&car(60.0)], 1.0, &SHIPPED.duplicates);
        assert!(!alone.steady[1..].contains(&true));
    }

    #[test]
    fn without_a_goal_copies_part_and_who_waits_waits() {
        let actor = driver(9.0, None);
        let all = shown(&actor, &DiverseModes::of(&actor, &[], 1.0, &SHIPPED.duplicates));
        assert!(nearest_m(&all) > SHIPPED.duplicates.copy_m, "{}", nearest_m(&all));
        let mut waiting = driver(0.0, None);
        waiting.plan.anchors.iter_mut().for_each(|anchor| anchor.base.fill(0.0));
        let diverse = DiverseModes::of(&waiting, &[], 1.0, &SHIPPED.duplicates);
        assert!(shown(&waiting, &diverse).iter().all(|s| s.way_m() < 1e-6));
    }

    #[test]
    fn six_of_their_own_are_left_alone() {
        let mut actor = driver(9.0, Some(80.0));
        for (i, anchor) in actor.plan.anchors.iter_mut().enumerate() {
            for step in 0..anchor.base.len() {
                anchor.base[step] += 0.5 * i as f64 * (step as f64 / 30.0).min(1.0) * INSTANTS as f64 / 6.0;
            }
        }
        assert_eq!(DiverseModes::of(&actor, &[], 1.0, &SHIPPED.duplicates), DiverseModes::none(&actor));
    }
}
