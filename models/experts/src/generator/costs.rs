//! The cost of each candidate of an actor by itself.

use super::actor::PlannedActor;
use super::candidates::{CandidateOrigin, MotionCandidate};
use super::choice::{JointOption, medoid_costs};
use super::motion::Sweep;
use super::others::Others;
use super::road_rules::drives_against;
use super::slot::Slot;
use super::stepping_out::steps_out;
use super::via_steering::vias_missed;
use crate::features::agent::AgentPlan;
use crate::maps::KnownMap;
use crate::planning::{INSTANTS, PER_INSTANT};
use crate::request::ShownLast;
use crate::tuning::ChoiceTuning;
use scene::geometry::obb::OrientedBox;
use scene::geometry::{cross, direction};
use scene::judge::{Judge, Trace};
use scene::motion::{MotionState, Trajectory};
use scene::score::Actor as ScoreActor;
use scene::{Agent, AgentType, Future, HORIZON_STEPS, STEP_S, State};
use std::sync::Arc;

/// What an actor's candidates are compared with.
pub(super) struct Yardstick<'a> {
    /// The mode that the scene is built around.
    pub(super) around: Option<Slot>,
    /// The future that the user saw last.
    pub(super) shown: Option<&'a ShownLast>,
    /// The actor is driving that future.
    pub(super) under_way: bool,
    pub(super) map: &'a KnownMap,
    pub(super) judge: &'a Judge<'a>,
    /// The agents that do not act.
    pub(super) others: &'a Others<'a>,
    /// The road user in the scene.
    pub(super) agent: &'a Agent,
    pub(super) start_step: usize,
    pub(super) tuning: &'a ChoiceTuning,
}

/// The options of the joint choice: one per candidate, in their order. `known` holds the options of the first
/// candidates, computed before the others were added.
pub(super) fn options(
    actor: &PlannedActor,
    candidates: &[MotionCandidate],
    known: &[JointOption],
    by: &Yardstick<'_>,
) -> Vec<JointOption> {
    let tuning = by.tuning;
    let size = &actor.plan.present.size;
    let rule_cost = |c: &MotionCandidate| match &c.motion.states {
        // A given motion costs nothing by itself.
        _ if c.origin.is_given() => 0.0,
        states => rule_cost_of(actor, states, by) + stepping_out(actor, states, by),
    };
    let mut rule_costs: Vec<f64> = known.iter().map(|option| option.rule_cost).collect();
    rule_costs.extend(candidates[known.len()..].iter().map(rule_cost));
    let costs = match &actor.kept {
        Some(kept) => candidates
            .iter()
            .map(|c| tuning.deviating + deviation_m(&c.motion.states, kept) / tuning.deviation_m)
            .collect(),
        None => central(&actor.plan, candidates, by.around, tuning),
    };
    let shown_rule_cost =
        candidates.iter().position(|c| c.origin.goes_on()).map_or(0.0, |shown| rule_costs[shown]);
    let option = |o: usize, cost: f64| {
        let (c, rule_cost) = (&candidates[o], rule_costs[o]);
        let sweep = match known.get(o) {
            Some(option) => Arc::clone(&option.sweep),
            None => Arc::new(Sweep::of_rollout(&c.motion.states, size)),
        };
        let missed = if c.motion.reach.is_reached() { 0.0 } else { tuning.goal_missed };
        let goes = actor.plan.target.position.is_some();
        let cost = match c.origin {
            // If all alternatives are similar, a swerving motion is far from each, so its cost is bounded.
            CandidateOrigin::Swerving(_) | CandidateOrigin::Shown(_) | CandidateOrigin::UnderWay(_) => {
                cost.min(tuning.most_swerving + missed)
            }
            // With a goal, the cost of the distance from the other modes is bounded too.
            CandidateOrigin::Mode(_) | CandidateOrigin::Guided(_) if goes => {
                cost.min(tuning.most_central + missed)
            }
            CandidateOrigin::Following(_) => tuning.following + missed,
            CandidateOrigin::Stopping(_) => tuning.stopping + missed,
            _ => cost,
        };
        let binds = if rule_cost < shown_rule_cost - tuning.lawful_by { tuning.unlawful_binds } else { 1.0 };
        let leaves_rest = if actor.rests
            && c.origin != CandidateOrigin::Rest
            && actor.plan.present.agent_type == AgentType::Vehicle
        {
            tuning.leaving_rest
        } else {
            0.0
        };
        let cost = cost + rule_cost + leaves_rest + binds * switching(c, by);
        let cost = if c.origin.is_given() { 0.0 } else { cost };
        JointOption { sweep, cost, rule_cost, burden: 0.0, kept: c.origin == CandidateOrigin::Kept }
    };
    costs.into_iter().enumerate().map(|(o, cost)| option(o, cost)).collect()
}

/// Expected distance of each candidate to all alternatives, and whether it misses its goal or a via point.
fn central(
    plan: &AgentPlan,
    candidates: &[MotionCandidate],
    around: Option<Slot>,
    tuning: &ChoiceTuning,
) -> Vec<f64> {
    let all: Vec<&Trajectory> = candidates.iter().map(|c| &c.motion.states).collect();
    let extra = |c: &MotionCandidate| {
        if around.is_some() && c.origin.slot() == around { tuning.around } else { 0.0 }
    };
    let alternatives = candidates.iter().filter(|c| c.origin.is_alternative());
    let weighted: Vec<(&Trajectory, f64)> =
        alternatives.map(|c| (&c.motion.states, c.probability + extra(c))).collect();
    let missed = |c: &MotionCandidate| {
        let goal = if c.motion.reach.is_reached() { 0.0 } else { tuning.goal_missed };
        goal + tuning.goal_missed * vias_missed(plan, &c.motion.states) as f64
    };
    medoid_costs(&all, &weighted).into_iter().zip(candidates).map(|(cost, c)| cost + missed(c)).collect()
}

/// Cost of harsh braking or steering, by its duration in seconds.
fn harsh(actor: &PlannedActor, states: &Trajectory, tuning: &ChoiceTuning) -> f64 {
    if actor.plan.present.agent_type == AgentType::Pedestrian {
        return 0.0;
    }
    let is_harsh = |w: &[MotionState]| {
        let (from, to) = (w[0].velocity, w[1].velocity);
        let change = (to - from) / STEP_S;
        let ahead = direction(w[0].heading_rad);
        -change.dot(&ahead) > tuning.harsh_mps2 || cross(ahead, change).abs() > tuning.harsh_mps2
    };
    let steps = states.windows(2).filter(|w| is_harsh(w)).count();
    // One or two steps are a short steering correction.
    if steps > 2 { tuning.harsh + tuning.harsh_second * steps as f64 * STEP_S } else { 0.0 }
}

/// Cost of crossing a stop line at red and of harsh braking or steering. For a vehicle, also the cost of leaving the
/// road or driving against the traffic.
fn rule_cost_of(actor: &PlannedActor, states: &Trajectory, by: &Yardstick<'_>) -> f64 {
    let mut cost = off_road(actor, states, by.map, by.tuning) + harsh(actor, states, by.tuning);
    if by.judge.has_lights() {
        let moved = states.iter().skip(1).map(State::from).collect();
        let future = Future::bare(1.0, by.start_step + 1, moved);
        let runs = by.judge.runs_red(&ScoreActor::of_future(by.agent, &future, &[]));
        cost += if runs { by.tuning.red_light } else { 0.0 };
    }
    cost
}

/// Cost to a walker without a goal of stepping out in front of a fast vehicle.
fn stepping_out(actor: &PlannedActor, states: &Trajectory, by: &Yardstick<'_>) -> f64 {
    let plan = &actor.plan;
    let beside = plan.target.position.is_none() && plan.kerbs.iter().any(Option::is_some);
    if !beside || by.others.traces().next().is_none() {
        return 0.0;
    }
    let at = |step: usize| states.get(step + 1).map(State::from);
    let me = Trace::new(&actor.id, plan.present.agent_type, &plan.present.size, HORIZON_STEPS, at);
    let before_any = by.others.traces().any(|other| steps_out(&me, other).is_some());
    if before_any { by.tuning.stepping_out } else { 0.0 }
}

/// Cost of showing another motion than the one that the user saw last.
fn switching(candidate: &MotionCandidate, by: &Yardstick<'_>) -> f64 {
    let Some(shown) = by.shown else { return 0.0 };
    let mut apart: Vec<f64> = Vec::with_capacity(INSTANTS);
    for (i, place) in shown.places.iter().take(INSTANTS).enumerate() {
        let state = &candidate.motion.states[(i + 1) * PER_INSTANT];
        apart.push((state.position - place).norm());
    }
    if apart.is_empty() {
        return 0.0;
    }
    let mean_m = apart.iter().sum::<f64>() / apart.len() as f64;
    let most_m = apart.iter().copied().fold(0.0, f64::max);
    let other = shown.anchor.is_some() && candidate.origin.slot().map(Slot::number) != shown.anchor;
    let (tuning, other) = (by.tuning, f64::from(u8::from(other)));
    let switching = if by.under_way { tuning.leaving_course } else { tuning.switching };
    switching * ((mean_m + 0.5 * most_m) / tuning.switching_m).min(1.0) + tuning.other_mode * other
}

/// Cost to a vehicle that starts on a lane of being off every lane. A vehicle that starts within the road's
/// edges also pays for a corner beyond them and for driving against the traffic.
fn off_road(actor: &PlannedActor, states: &Trajectory, map: &KnownMap, tuning: &ChoiceTuning) -> f64 {
    let present = &actor.plan.present;
    let Some(start) = states.first().filter(|_| present.agent_type == AgentType::Vehicle) else {
        return 0.0;
    };
    let away = |s: &MotionState| actor.plan.is_off_lanes(&map.graph, s.position, tuning.off_lanes_m);
    let beyond = |s: &MotionState| {
        let outline = OrientedBox::of_state(&State::from(s), &present.size);
        actor.plan.drivable.box_outside_m(&outline).is_some_and(|outside| outside > tuning.past_edge_m)
    };
    let share = |off: &dyn Fn(&MotionState) -> bool| {
        if off(start) {
            0.0
        } else {
            let looked_at = states.iter().step_by(PER_INSTANT);
            looked_at.filter(|s| off(s)).count() as f64 / (INSTANTS + 1) as f64
        }
    };
    let (past_edges, wrong_way) = (share(&beyond), share(&|s| drives_against(&map.drivable, s)));
    let at_all = if past_edges + wrong_way > 0.0 { tuning.leaving_the_road } else { 0.0 };
    tuning.off_lanes * share(&away) + tuning.past_edges * past_edges + tuning.wrong_way * wrong_way + at_all
}

/// Mean distance of a motion from the one that the actor keeps, metres.
fn deviation_m(states: &Trajectory, kept: &[State]) -> f64 {
    let pairs = states.iter().skip(1).zip(kept).step_by(5);
    let (sum, n) =
        pairs.fold((0.0, 0.0), |(sum, n), (a, b)| (sum + (a.position - b.position()).norm(), n + 1.0));
    if n > 0.0 { sum / n } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use crate::generator::trajectory::rest;
    use crate::tuning::SHIPPED;
    use scene::Goal;

    fn plan() -> AgentPlan {
        car_on_a_street(0.0, Goal::default())
    }

    /// Standing this many metres ahead.
    fn at(x_m: f64, probability: f64, origin: CandidateOrigin) -> MotionCandidate {
        let mut motion = rest(&plan());
        motion.states.iter_mut().for_each(|s| s.position.x = x_m);
        MotionCandidate { probability, origin, motion }
    }

    #[test]
    fn the_middle_costs_least_and_what_a_scene_is_built_around_draws_it() {
        let modes = [0.0, 4.0, 8.0];
        let of = |i: usize| at(modes[i], 1.0 / 3.0, CandidateOrigin::Mode(Slot::new(i)));
        let all = [of(0), of(1), of(2), at(4.0, 0.0, CandidateOrigin::PathMean(Slot::new(1)))];
        let free = central(&plan(), &all, None, &SHIPPED.choice);
        assert!(free[1] < free[0] && free[1] < free[2] && free[1] == free[3], "{free:?}");
        let around = central(&plan(), &all, Some(Slot::new(2)), &SHIPPED.choice);
        assert!(around[2] < around[1] && around[1] < around[0], "{around:?}");
    }

    #[test]
    fn a_missed_goal_is_worse() {
        use scene::motion::{Limiting, Reach, TargetError};
        let mut all = [
            at(0.0, 0.5, CandidateOrigin::Mode(Slot::new(0))),
            at(0.0, 0.5, CandidateOrigin::Mode(Slot::new(1))),
        ];
        let nearest = all[0].motion.states[0];
        all[0].motion.reach = Reach::Unreachable {
            residuals: TargetError::default(),
            nearest,
            limiting: Limiting::Speed,
            needs: None,
        };
        let costs = central(&plan(), &all, None, &SHIPPED.choice);
        assert!((costs[0] - costs[1] - SHIPPED.choice.goal_missed).abs() < 1e-12, "{costs:?}");
    }
}
