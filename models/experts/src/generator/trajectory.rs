//! From route coordinates to motion: residual knots on an anchor, to positions, to control knots, to a
//! rollout that meets the goal and the limits.

use super::motion::Places;
use super::slot::Slot;
use super::via_steering::{projected, steer_to_vias};
use crate::features::agent::{AgentPlan, BEYOND_M};
use crate::planning::lights::Waiting;
use crate::planning::profile::{Caps, Progress};
use crate::planning::{ACROSS_SCALE, ALONG_SCALE, Basis, INSTANTS, PER_INSTANT, Residual, STAYS_WITHIN_M};
use crate::tuning::fixed::trajectory::{
    ALONG_LANE_M, AT_LINE_M, BACKING_BRAKE_MPS2, BACKING_WAY_M, OFFSET_SHARES, RADIAN_M, RESTING_MPS,
    SHORT_OF_LINE_M,
};
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::motion::{
    Gear, Knots, Limiting, MotionKind, MotionModel, MotionState, Projection, Reach, Sampled, Smoothing,
    Target, TargetError, Trajectory, fit, project, refit_after,
};
use scene::{HORIZON_STEPS, KNOTS, State, Vec2, wrap_angle};
use std::sync::LazyLock;

pub(super) static BASIS: LazyLock<Basis> = LazyLock::new(Basis::new);

/// The states of a future, and whether it meets the goal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rollout {
    pub(super) states: Trajectory,
    pub(super) reach: Reach,
}

impl Rollout {
    /// Box centres and headings at the instants.
    pub(super) fn places(&self) -> Places {
        let place = |s: &MotionState| (s.position, s.heading_rad);
        std::array::from_fn(|i| self.states.get((i + 1) * PER_INSTANT).map(place))
    }

    /// Replaces the reason of a missed goal by that of another motion that misses it.
    pub(super) fn with_reason_of(mut self, other: Reach) -> Self {
        if let (
            Reach::Unreachable { limiting, needs, .. },
            Reach::Unreachable { limiting: why, needs: what, .. },
        ) = (&mut self.reach, other)
        {
            (*limiting, *needs) = (why, what);
        }
        self
    }
}

impl From<Projection> for Rollout {
    fn from(p: Projection) -> Self {
        Self { states: p.trajectory, reach: p.reach }
    }
}

/// Progress and offset of a draft at the instants.
pub(super) fn route_coordinates(plan: &AgentPlan, slot: Slot, residual: &Residual) -> [(f64, f64); INSTANTS] {
    let anchor = &plan.anchors[slot.index()];
    let mut out = [(0.0, 0.0); INSTANTS];
    let mut last = 0.0_f64;
    for (i, place) in out.iter_mut().enumerate() {
        let (mut along, mut across) = (anchor.base_at((i + 1) * PER_INSTANT), 0.0);
        for k in 0..KNOTS {
            along += f64::from(ALONG_SCALE * BASIS.along[i][k] * residual[k]);
            across += f64::from(ACROSS_SCALE * BASIS.across[i][k] * residual[KNOTS + k]);
        }
        across *= plan.aside_share[i];
        // Progress never decreases.
        last = along.max(last);
        *place = (last, across);
    }
    if plan.departs > 0 {
        let waits = (plan.departs / PER_INSTANT).min(INSTANTS);
        out.rotate_right(waits);
        out[..waits].fill((0.0, 0.0));
    }
    at_lights(plan, slot, steer_to_vias(plan, slot, out))
}

/// Progress and offset at the instants, with waits at red signals. A waiting agent keeps the offset that it
/// would have had at that progress.
fn at_lights(plan: &AgentPlan, slot: Slot, wanted: [(f64, f64); INSTANTS]) -> [(f64, f64); INSTANTS] {
    let gates = &plan.lights[slot.index()];
    let kerb = plan.kerbs[slot.index()].as_ref().filter(|_| plan.target.position.is_some());
    if (gates.is_empty() && kerb.is_none()) || plan.model.gear == Gear::Reverse {
        return wanted;
    }
    let anchor = &plan.anchors[slot.index()];
    let before = |i: usize| if i == 0 { (0.0, 0.0) } else { wanted[i - 1] };
    let progress: Progress = std::array::from_fn(|step| {
        let (i, part) = (step / PER_INSTANT, (step % PER_INSTANT) as f64 / PER_INSTANT as f64);
        let (from, to) = (before(i).0, before((i + 1).min(INSTANTS)).0);
        from + part * (to - from)
    });
    if let Some(kerb) = kerb {
        let held = kerb.waiting(&progress, plan.model.start_speed_mps(), plan.target.step);
        return held.map_or(wanted, |held| beside_at(&wanted, &held));
    }
    let waiting = Waiting {
        gates,
        v0: plan.model.start_speed_mps(),
        limits: &plan.model.limits,
        target: &plan.target,
        caps: Caps::new(anchor.path.arc_m(), &anchor.caps_mps),
        easy_mps2: plan.easy_mps2,
    };
    let held = waiting.obeying(&progress);
    // Without a goal, all modes but the first leave at the latest when the signal turns green.
    let leaves = plan.is_free() && slot != Slot::FIRST;
    let left = leaves.then(|| waiting.setting_off(held.as_ref().unwrap_or(&progress))).flatten();
    let Some(held) = left.or(held) else { return wanted };
    beside_at(&wanted, &held)
}

/// Places at another progress than wanted, each with the offset of the wanted motion at that progress.
fn beside_at(wanted: &[(f64, f64); INSTANTS], held: &Progress) -> [(f64, f64); INSTANTS] {
    let before = |i: usize| if i == 0 { (0.0, 0.0) } else { wanted[i - 1] };
    std::array::from_fn(|i| {
        let along = held[(i + 1) * PER_INSTANT];
        let next = (0..INSTANTS).find(|k| wanted[*k].0 >= along).unwrap_or(INSTANTS - 1);
        let (from, to) = (before(next), wanted[next]);
        let part = if to.0 - from.0 > 1e-6 { ((along - from.0) / (to.0 - from.0)).min(1.0) } else { 1.0 };
        (along, from.1 + part * (to.1 - from.1))
    })
}

/// Box centres and headings of a draft at the instants, before any motion model is applied.
pub(super) fn places(plan: &AgentPlan, slot: Slot, residual: &Residual) -> [(Vec2, f64); INSTANTS] {
    let anchor = &plan.anchors[slot.index()];
    route_coordinates(plan, slot, residual).map(|(along, across)| anchor.place(along, across))
}

/// The motion of a draft: fitted to its places, and projected onto goal and limits.
pub(super) fn to_trajectory(plan: &AgentPlan, slot: Slot, residual: &Residual) -> Rollout {
    if plan.model.gear == Gear::Reverse {
        return backing(plan);
    }
    waiting(plan, slot, route_coordinates(plan, slot, residual))
}

/// The mean motion of drafts on one path: their mean progress and offset, weighted by probability. They lie
/// on the path of the first of them, `path`.
pub(super) fn mean_trajectory(plan: &AgentPlan, path: Slot, drafts: &[(f64, Slot, &Residual)]) -> Rollout {
    let total: f64 = drafts.iter().map(|d| d.0).sum::<f64>().max(1e-12);
    let mut mean = [(0.0, 0.0); INSTANTS];
    for (probability, slot, residual) in drafts {
        let own = route_coordinates(plan, *slot, residual);
        for (mean, own) in mean.iter_mut().zip(own) {
            mean.0 += probability / total * own.0;
            mean.1 += probability / total * own.1;
        }
    }
    waiting(plan, path, mean)
}

/// The motion at these progresses and offsets. Ten knots cannot follow every halt: an agent that would roll
/// over the stop line of a red signal halts earlier.
fn waiting(plan: &AgentPlan, slot: Slot, coordinates: [(f64, f64); INSTANTS]) -> Rollout {
    let motion = on_the_road(plan, slot, coordinates);
    let anchor = &plan.anchors[slot.index()];
    let mut earlier = coordinates;
    for gate in &plan.lights[slot.index()] {
        let line_m = gate.line_m().max(0.0);
        let waits = |i: &usize| gate.is_red((i + 1) * PER_INSTANT) && coordinates[*i].0 <= line_m;
        let over = |i: usize| {
            let place = motion.states[(i + 1) * PER_INSTANT].position;
            anchor.coordinates(place, coordinates[i].0).0 - line_m
        };
        let over_m = (0..INSTANTS).filter(waits).map(over).fold(f64::NEG_INFINITY, f64::max);
        if over_m > -AT_LINE_M {
            let share = ((line_m - over_m - SHORT_OF_LINE_M) / line_m.max(0.1)).clamp(0.0, 1.0);
            for i in (0..INSTANTS).filter(waits) {
                earlier[i].0 *= share;
            }
        }
    }
    if earlier == coordinates { motion } else { on_the_road(plan, slot, earlier) }
}

/// The motion at these progresses and offsets. If an offset takes a corner beyond the road's edge and the
/// path itself stays within, the offset shrinks.
fn on_the_road(plan: &AgentPlan, slot: Slot, coordinates: [(f64, f64); INSTANTS]) -> Rollout {
    let anchor = &plan.anchors[slot.index()];
    let size = &plan.present.size;
    let places = coordinates.map(|(along, across)| {
        let wanted = anchor.place(along, across);
        let Some(ground) = &plan.ground else { return wanted };
        let outside_m = |(position, heading_rad): (Vec2, f64)| {
            let outline = OrientedBox::new(position, 0.5 * size.length_m, 0.5 * size.width_m, heading_rad);
            ground.box_outside_m(&outline).unwrap_or(0.0)
        };
        if across == 0.0 || outside_m(wanted) <= BEYOND_M || outside_m(anchor.place(along, 0.0)) > BEYOND_M {
            return wanted;
        }
        let inside = OFFSET_SHARES.into_iter().map(|share| anchor.place(along, share * across));
        inside.into_iter().find(|place| outside_m(*place) <= BEYOND_M).unwrap_or(anchor.place(along, 0.0))
    });
    through(plan, slot, places)
}

/// The motion that passes near these box centres at the instants, facing its direction of motion.
pub(super) fn along_places(plan: &AgentPlan, slot: Slot, centres: &[Vec2; INSTANTS]) -> Rollout {
    if plan.model.gear == Gear::Reverse {
        return backing(plan);
    }
    through(plan, slot, facing_on(plan, centres))
}

/// The motion that was driven past these box centres, fitted again with hurried or physical limits, and with
/// or without the lane's heading at the goal. The fit nearest to the centres is taken.
pub(super) fn driven_again(plan: &AgentPlan, slot: Slot, centres: &[Vec2; INSTANTS]) -> Rollout {
    if plan.model.gear == Gear::Reverse {
        return backing(plan);
    }
    let places = facing_on(plan, centres);
    let samples = as_driven(&places);
    let target = projected_onto(plan);
    let along = plan.lane_headings[slot.index()].filter(|_| plan.projected);
    let along = along.map(|heading_rad| Target { heading_rad: Some(heading_rad), ..target });
    let mut nearest: Option<(f64, Projection)> = None;
    for model in [plan.model.hurried(), plan.model] {
        let knots = fit(&model, &samples, Smoothing::DRIVEN);
        for target in along.iter().chain([&target]) {
            let motion = projected(plan, &model, &knots, target);
            if !motion.reach.is_reached() {
                continue;
            }
            let motion = on_after(plan, &model, motion, &samples, Smoothing::DRIVEN);
            let off_m = off_m(&motion.trajectory, &places);
            if nearest.as_ref().is_none_or(|(least_m, _)| off_m < *least_m) {
                nearest = Some((off_m, motion));
            }
        }
    }
    match nearest {
        Some((_, motion)) => motion.into(),
        None => through(plan, slot, places),
    }
}

/// The motion past these box centres for an agent that other agents may stop. A missed goal counts as missed
/// because of traffic. With `gets_there` the motion is projected onto the goal, otherwise only onto the
/// limits.
pub(super) fn short_along(
    plan: &AgentPlan,
    centres: &[Vec2; INSTANTS],
    smoothing: Smoothing,
    gets_there: bool,
) -> Rollout {
    let places = facing_on(plan, centres);
    let samples = if smoothing == Smoothing::DRIVEN { as_driven(&places) } else { samples(plan, &places) };
    let knots = fit(&plan.model, &samples, smoothing);
    let free = Target { step: plan.target.step, ..Target::default() };
    let target = if gets_there { projected_onto(plan) } else { free };
    let motion = project(&plan.model, &knots, &target, None);
    let nearest = motion.trajectory[plan.target.step];
    let residuals = TargetError::of(&nearest, &plan.target);
    let reach = if residuals.is_met() {
        Reach::Reached(residuals)
    } else {
        Reach::Unreachable { nearest, residuals, limiting: Limiting::Traffic, needs: None }
    };
    Rollout { states: motion.trajectory, reach }
}

/// Box centres with the headings of an agent that drives from each to the next.
fn facing_on(plan: &AgentPlan, centres: &[Vec2; INSTANTS]) -> [(Vec2, f64); INSTANTS] {
    let mut last = (plan.present.start.position(), plan.present.start.heading_rad);
    let facing = centres.map(|centre| {
        let chord = centre - last.0;
        let heading_rad = if chord.norm() > LEAST_CHORD_M { chord.y.atan2(chord.x) } else { last.1 };
        last = (centre, heading_rad);
        last
    });
    // A chord has the heading of its midpoint.
    let mut places = facing;
    for i in 0..INSTANTS - 1 {
        places[i].1 += 0.5 * wrap_angle(facing[i + 1].1 - facing[i].1);
    }
    places
}

/// Chords shorter than this have no heading, metres.
const LEAST_CHORD_M: f64 = 0.2;

/// The target that motions are projected onto: the goal, or a free target that only enforces the limits.
fn projected_onto(plan: &AgentPlan) -> Target {
    let target = plan.target;
    if plan.projected { target } else { Target { step: target.step, ..Target::default() } }
}

/// Places (box centres and the path's headings) at the instants as samples of a motion.
fn samples(plan: &AgentPlan, places: &[(Vec2, f64); INSTANTS]) -> Vec<Sampled> {
    let mut samples = Vec::with_capacity(INSTANTS);
    let mut last = (plan.present.start.position(), plan.present.start.heading_rad);
    for (i, &(position, path_heading)) in places.iter().enumerate() {
        // Drifting across a path turns the body; at a crawl the heading is the path's.
        let chord = position - last.0;
        let chord_heading = if chord.norm() > 1.0 { chord.y.atan2(chord.x) } else { path_heading };
        let drift = wrap_angle(chord_heading - path_heading).clamp(-0.5, 0.5);
        let heading_rad = path_heading + if chord.norm() > 1.0 { 0.5 * drift } else { 0.0 };
        samples.push(Sampled { step: (i + 1) * PER_INSTANT, position, heading_rad });
        last = (position, heading_rad);
    }
    samples
}

/// Places of a driven motion, as samples of it.
fn as_driven(places: &[(Vec2, f64); INSTANTS]) -> Vec<Sampled> {
    let sample = |(i, &(position, heading_rad)): (usize, &(Vec2, f64))| Sampled {
        step: (i + 1) * PER_INSTANT,
        position,
        heading_rad,
    };
    places.iter().enumerate().map(sample).collect()
}

/// The motion that passes near these places (box centres and the path's headings) at the instants, on the
/// path of this slot. It stays within the hurried limits if that meets the goal, else within the physical
/// ones.
fn through(plan: &AgentPlan, slot: Slot, places: [(Vec2, f64); INSTANTS]) -> Rollout {
    let samples = samples(plan, &places);
    let hurried = plan.model.hurried();
    let motion = through_within(plan, &hurried, slot, &places, &samples);
    if motion.reach.is_reached() {
        return motion.into();
    }
    as_possible(plan, through_within(plan, &plan.model, slot, &places, &samples))
}

/// A motion within the physical limits; it reverses only if that comes nearer to the goal.
fn as_possible(plan: &AgentPlan, motion: Projection) -> Rollout {
    if motion.reach.is_reached() {
        return motion.into();
    }
    reversing(plan, &motion).unwrap_or_else(|| motion.into())
}

/// Greatest distance of a motion from these places at their instants, metres.
fn off_m(motion: &Trajectory, places: &[(Vec2, f64)]) -> f64 {
    let off =
        |(i, (place, _)): (usize, &(Vec2, f64))| (motion[(i + 1) * PER_INSTANT].position - place).norm();
    places.iter().enumerate().map(off).fold(0.0, f64::max)
}

/// The motion of this model past these places.
fn through_within(
    plan: &AgentPlan,
    model: &MotionModel,
    slot: Slot,
    places: &[(Vec2, f64); INSTANTS],
    samples: &[Sampled],
) -> Projection {
    let knots = fit(model, samples, Smoothing::WISHED);
    let target = projected_onto(plan);
    if let (Some(heading_rad), true) = (plan.lane_headings[slot.index()], plan.projected) {
        let along = Target { heading_rad: Some(heading_rad), ..target };
        let motion = projected(plan, model, &knots, &along);
        let due = (target.step / PER_INSTANT).min(INSTANTS);
        if motion.reach.is_reached() && off_m(&motion.trajectory, &places[..due]) < ALONG_LANE_M {
            return on_after(plan, model, motion, samples, Smoothing::WISHED);
        }
    }
    let motion = projected(plan, model, &knots, &target);
    if motion.reach.is_reached() { on_after(plan, model, motion, samples, Smoothing::WISHED) } else { motion }
}

/// The same motion up to the goal, and past the remaining places after it.
fn on_after(
    plan: &AgentPlan,
    model: &MotionModel,
    motion: Projection,
    samples: &[Sampled],
    smoothing: Smoothing,
) -> Projection {
    let step = plan.target.step;
    if projected_onto(plan).is_free() {
        return motion;
    }
    let knots = refit_after(model, &motion.knots, step, samples, smoothing);
    if knots == motion.knots {
        return motion;
    }
    let trajectory = model.rollout(&knots);
    // A motion that was found with another gear does not belong to this model.
    let same = (trajectory[step].position - motion.trajectory[step].position).norm() < 1e-9;
    if same { Projection { knots, trajectory, ..motion } } else { motion }
}

/// A vehicle that already rolls backwards (from an earlier window) continues to its goal or comes to rest: a
/// window never changes the gear of a moving vehicle.
fn backing(plan: &AgentPlan) -> Rollout {
    let braking = Knots { first: [-BACKING_BRAKE_MPS2; KNOTS], ..Knots::default() };
    project(&plan.model, &braking, &projected_onto(plan), None).into()
}

/// A motion that reverses to a goal behind a standing vehicle.
fn reversing(plan: &AgentPlan, forwards: &Projection) -> Option<Rollout> {
    let goal = plan.target.position?;
    let local = plan.model.to_local(goal);
    let may = plan.model.kind == MotionKind::Drive
        && plan.model.start.velocity().dot(&direction(plan.model.start.heading_rad)) < 0.5
        && local.x < 1.0
        && local.norm() < BACKING_WAY_M;
    if !may {
        return None;
    }
    let model = plan.model.in_gear(Gear::Reverse);
    let backwards = project(&model, &model.coasting(), &plan.target, None);
    let better = |p: &Projection| {
        let r = TargetError::of(&p.trajectory[plan.target.step], &plan.target);
        r.position_m + RADIAN_M * r.heading_rad + r.speed_mps
    };
    (better(&backwards) < better(forwards)).then(|| backwards.into())
}

/// The start pose without motion.
fn still(plan: &AgentPlan) -> MotionState {
    let start = &plan.present.start;
    MotionState { position: start.position(), heading_rad: start.heading_rad, velocity: Vec2::zeros() }
}

/// Exact rest at the start pose.
pub(super) fn rest(plan: &AgentPlan) -> Rollout {
    let still = still(plan);
    let error = TargetError::of(&still, &plan.target);
    Rollout { states: vec![still; HORIZON_STEPS + 1], reach: Reach::Reached(error) }
}

/// The motion with these states from the first step on, regardless of the goal.
pub(super) fn as_it_is(plan: &AgentPlan, states: &[State]) -> Rollout {
    let states: Trajectory = std::iter::once(&plan.present.start)
        .chain(states)
        .map(|s| MotionState { position: s.position(), heading_rad: s.heading_rad, velocity: s.velocity() })
        .collect();
    let due = states.get(plan.target.step).or(states.last()).copied().unwrap_or_default();
    Rollout { reach: Reach::Reached(TargetError::of(&due, &plan.target)), states }
}

/// Replaces creeping by rest: a road user without a goal that stands and moves less than [`STAYS_WITHIN_M`]
/// in the whole window stays.
pub(super) fn without_creep(plan: &AgentPlan, moves: bool, motion: Rollout) -> Rollout {
    let start = plan.present.start.position();
    let creeps = |s: &MotionState| (s.position - start).norm() < STAYS_WITHIN_M;
    let rests = plan.is_free() && may_rest(plan, moves) && motion.states.iter().all(creeps);
    if rests { rest(plan) } else { motion }
}

/// Whether the agent stands at the start and rest meets its goal. In a recording, jitter counts as standing;
/// if a plan already moves the agent, the plan must have brought it to rest.
pub(super) fn may_rest(plan: &AgentPlan, moves: bool) -> bool {
    let standing_mps = if moves { RESTING_MPS.1 } else { RESTING_MPS.0 };
    plan.vias.is_empty()
        && plan.present.start.speed_mps() < standing_mps
        && TargetError::of(&still(plan), &plan.target).is_met()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use scene::Goal;

    #[test]
    fn who_stands_goes_or_stays_to_the_last_bit() {
        // Forwards at a constant pace, this far in all.
        let crept = |plan: &AgentPlan, metres: f64| {
            let mut motion = rest(plan);
            for (step, state) in motion.states.iter_mut().enumerate() {
                state.position.x += metres * step as f64 / HORIZON_STEPS as f64;
            }
            without_creep(plan, false, motion).states[HORIZON_STEPS].position.x
        };
        let standing = car_on_a_street(0.0, Goal::default());
        assert_eq!([crept(&standing, 0.4), crept(&standing, 0.6)], [0.0, 0.6]);
        let asked = Goal { position: Some(Vec2::new(0.4, 0.0)), ..Goal::default() };
        assert_eq!(crept(&car_on_a_street(0.0, asked), 0.4), 0.4);
        assert_eq!(crept(&car_on_a_street(1.0, Goal::default()), 0.4), 0.4);
    }

    #[test]
    fn who_has_met_a_goal_goes_on_along_the_lane() {
        let time_s = Some(4.0);
        let goal =
            Goal { position: Some(Vec2::new(48.0, 0.0)), heading_rad: Some(0.0), time_s, ..Goal::default() };
        let plan = car_on_a_street(12.0, goal);
        // Two metres aside all the time except at the goal.
        let mut residual = [0.0; crate::planning::RESIDUAL];
        for (k, across) in residual[KNOTS..].iter_mut().enumerate().skip(1) {
            *across = if k == 4 { 0.0 } else { -2.0 };
        }
        for slot in Slot::all() {
            let motion = to_trajectory(&plan, slot, &residual);
            assert!(motion.reach.is_reached(), "{slot:?}: {:?}", motion.reach);
            let (before, after) = (motion.states[20], &motion.states[60..]);
            assert!(before.position.y < -1.0, "{slot:?} before the goal: {before:?}");
            let beside =
                after.iter().map(|s| s.position.y.abs() + 3.0 * s.heading_rad.abs()).fold(0.0, f64::max);
            assert!(beside < 0.5, "{slot:?} after the goal: {beside}");
        }
    }

    #[test]
    fn a_hard_stop_that_was_shown_is_driven_again() {
        let goal = Goal { position: Some(Vec2::new(60.0, 0.0)), time_s: Some(9.0), ..Goal::default() };
        let plan = car_on_a_street(12.0, goal);
        // Brakes by 6 m/s2, stands for two seconds and starts again by 3.8 m/s2.
        let x_m = |seconds: f64| match seconds {
            s if s < 2.0 => 12.0 * s - 3.0 * s * s,
            s if s < 4.0 => 12.0,
            s => 12.0 + 1.92 * (s - 4.0).powi(2),
        };
        let centres = std::array::from_fn(|i| Vec2::new(x_m(0.5 * (i + 1) as f64), 0.0));
        let places = centres.map(|centre| (centre, 0.0));
        let off_m = |motion: &Rollout| {
            assert!(motion.reach.is_reached());
            off_m(&motion.states, &places)
        };
        let again = off_m(&driven_again(&plan, Slot::FIRST, &centres));
        let hurried = off_m(&along_places(&plan, Slot::FIRST, &centres));
        assert!(again < 0.6 * hurried, "{again} m off, {hurried} m in the hurried manner");
    }
}
