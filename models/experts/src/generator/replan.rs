//! Replans a motion that still meets another agent, or leaves the road on its way to a goal on it. The same
//! motion is tried beside its path and earlier or later on it: the cheapest sequence of shifts, one per
//! instant, by dynamic programming. Start and goal stay the same. Alternatively the motion stops before the
//! obstacle.

use super::motion::Sweep;
use super::slot::Slot;
use super::trajectory::{Rollout, along_places, short_along};
use crate::features::agent::{AgentPlan, BEYOND_M};
use crate::planning::{INSTANTS, PER_INSTANT};
use crate::tuning::ReplanTuning;
use crate::tuning::fixed::replan::{
    BRAKES, HARDER_M, LEAST_WAY_M, ROOM_M, SHORT_M, SLOPE, SPARE_M, THERE_M, WALKER_ROOM_M,
};
use scene::geometry::direction;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::motion::{Gear, MotionKind, Smoothing, Trajectory};
use scene::routes::{LaneGraph, Polyline, Pose};
use scene::score::CLOSE_M;
use scene::{AgentType, HORIZON_STEPS, STEP_S, Vec2};
use std::f64::consts::FRAC_PI_2;

/// Number of shifts to each side, and their spacing, metres.
const ASIDES: i32 = 6;
const ASIDE_M: f64 = 0.6;
/// Number of shifts along the path each way, and their spacing, metres.
const AHEADS: i32 = 7;
const AHEAD_M: f64 = 1.0;
/// Number of shifts to the side at an instant.
const ACROSS: usize = (2 * ASIDES + 1) as usize;
const ALONG: usize = (2 * AHEADS + 1) as usize;
const SHIFTS: usize = ACROSS * ALONG;
/// Largest change of a shift between two instants, in units to the side and along.
const MOST_ASIDE: i32 = 2;
const MOST_AHEAD: i32 = 1;
/// Steps around an instant at which boxes are checked.
const ABOUT: [isize; 3] = [-2, 0, 2];
/// Length of the path beyond the last place, metres.
const TAIL_M: f64 = 20.0;

/// A shift: along the path and to the left.
#[derive(Clone, Copy, PartialEq)]
struct Shift {
    ahead: i32,
    aside: i32,
}

impl Shift {
    const NONE: Self = Self { ahead: 0, aside: 0 };

    fn all() -> impl Iterator<Item = Self> {
        (-AHEADS..=AHEADS).flat_map(|ahead| (-ASIDES..=ASIDES).map(move |aside| Self { ahead, aside }))
    }

    fn index(self) -> usize {
        (self.ahead + AHEADS) as usize * ACROSS + (self.aside + ASIDES) as usize
    }

    fn ahead_m(self) -> f64 {
        f64::from(self.ahead) * AHEAD_M
    }

    fn aside_m(self) -> f64 {
        f64::from(self.aside) * ASIDE_M
    }

    fn cost(self, weights: &ReplanTuning) -> f64 {
        weights.aside * self.aside_m().powi(2) + weights.ahead * self.ahead_m().powi(2)
    }
}

/// The surroundings of a motion that is replanned.
#[derive(Clone, Copy)]
pub(super) struct ReplanField<'a> {
    pub(super) graph: &'a LaneGraph,
    /// Distance from every lane beyond which a place is off the lanes, metres.
    pub(super) off_lanes_m: f64,
    pub(super) weights: &'a ReplanTuning,
    /// The motions of the other agents.
    pub(super) others: &'a [&'a Sweep],
}

/// A step at which boxes are checked, with another agent near.
struct ReplanMoment<'a> {
    /// Boxes of other agents within reach of the shifts.
    near: Vec<&'a OrientedBox>,
    /// One entry per shift along the path.
    unshifted: Vec<Unshifted>,
}

/// A place on the path.
struct Unshifted {
    position: Vec2,
    left: Vec2,
    /// `met` is the box with the margin [`SPARE_M`], `close` with [`CLOSE_M`] in addition.
    met: OrientedBox,
    close: OrientedBox,
}

impl ReplanMoment<'_> {
    /// Whether another agent is in a box of a shift.
    fn is_in(&self, shift: Shift, of: impl Fn(&Unshifted) -> &OrientedBox) -> bool {
        let on = &self.unshifted[(shift.ahead + AHEADS) as usize];
        let outline = of(on).about(on.position + on.left * shift.aside_m());
        self.near.iter().any(|b| meets(b, &outline))
    }
}

/// Whether two boxes overlap.
fn meets(b: &OrientedBox, outline: &OrientedBox) -> bool {
    let reach = b.radius_m() + outline.radius_m();
    (b.center() - outline.center()).norm_squared() < reach * reach && overlaps(outline, b, 0.0)
}

/// Largest distance that a shift moves a box, metres.
const SHIFTED_M: f64 = AHEADS as f64 * AHEAD_M + ASIDES as f64 * ASIDE_M;

/// A motion to be shifted.
struct ShiftSearch<'a> {
    plan: &'a AgentPlan,
    field: ReplanField<'a>,
    /// The vehicle starts on a lane, so it stays near lanes.
    keeps_to_lanes: bool,
    path: Polyline,
    /// Metres along it, one value per step.
    along_m: Vec<f64>,
    /// The motions of the field that its shifts may meet.
    near: Vec<&'a Sweep>,
}

/// The motion on the path of `slot` that avoids all other agents: to the side, earlier or later. `None` if
/// shifting does not lower the cost.
pub(super) fn swerve(
    plan: &AgentPlan,
    field: ReplanField<'_>,
    slot: Slot,
    motion: &Trajectory,
) -> Option<Rollout> {
    let search = ShiftSearch::new(plan, field, motion)?;
    let shifts = search.least()?;
    let centres: [Vec2; INSTANTS] =
        std::array::from_fn(|i| search.pose((i + 1) * PER_INSTANT, shifts[i]).position);
    Some(along_places(plan, slot, &centres))
}

/// The motion on the same path that stops before the agent it would meet; `None` if no braking suffices. It
/// misses its goal unless it stops there or later.
pub(super) fn stop_before(plan: &AgentPlan, field: ReplanField<'_>, motion: &Trajectory) -> Option<Rollout> {
    let search = ShiftSearch::new(plan, field, motion)?;
    let mut best: Option<Vec<f64>> = None;
    for share in BRAKES {
        // The latest possible stop gets farthest.
        let halts = (0..HORIZON_STEPS).step_by(PER_INSTANT).rev();
        let along_m = halts
            .map(|from| search.halting(from, share * plan.model.limits.brake_mps2))
            .find(|along_m| search.is_free(along_m));
        let farther =
            |best: &Vec<f64>, now: &Vec<f64>| now.last() > best.last().map(|m| m + HARDER_M).as_ref();
        if let Some(now) = along_m
            && best.as_ref().is_none_or(|best| farther(best, &now))
        {
            best = Some(now);
        }
    }
    let along_m = best?;
    let centres: [Vec2; INSTANTS] =
        std::array::from_fn(|i| search.path.extrapolate(along_m[(i + 1) * PER_INSTANT]).position);
    let gets_there = along_m[plan.target.step] >= search.along_m[plan.target.step] - THERE_M;
    Some(short_along(plan, &centres, Smoothing::WISHED, gets_there))
}

impl<'a> ShiftSearch<'a> {
    /// `None` for a motion that rolls backwards or hardly moves.
    fn new(plan: &'a AgentPlan, field: ReplanField<'a>, motion: &Trajectory) -> Option<Self> {
        let mut along_m = Vec::with_capacity(motion.len());
        let mut way_m = 0.0;
        for (i, state) in motion.iter().enumerate() {
            way_m += if i == 0 { 0.0 } else { (state.position - motion[i - 1].position).norm() };
            along_m.push(way_m);
        }
        let backwards = plan.model.gear == Gear::Reverse;
        if backwards || way_m < LEAST_WAY_M || along_m.len() <= HORIZON_STEPS {
            return None;
        }
        let last = motion.last()?;
        let tail = last.position + direction(last.heading_rad) * TAIL_M;
        let path = Polyline::new(motion.iter().map(|s| s.position).chain([tail]));
        let vehicle = plan.present.agent_type == AgentType::Vehicle;
        let mut search = Self { plan, field, keeps_to_lanes: false, path, along_m, near: Vec::new() };
        search.keeps_to_lanes = vehicle && !search.is_off_lanes(plan.present.start.position());
        search.near = search.may_be_met();
        Some(search)
    }

    /// The motions within reach of the shifts at some instant that do not overlap at the start.
    fn may_be_met(&self) -> Vec<&'a Sweep> {
        let own = self.outline(self.pose(0, Shift::NONE));
        let looked_at = (1..=HORIZON_STEPS).step_by(2);
        let places: Vec<(usize, Vec2)> =
            looked_at.map(|step| (step, self.path.extrapolate(self.along_m[step]).position)).collect();
        let starts_in = |other: &Sweep| other.at(0).is_some_and(|b| overlaps(&own, b, 0.0));
        let comes_near = |other: &Sweep| {
            places.iter().any(|(step, place)| {
                let Some(outline) = other.at(*step) else { return false };
                let reach = SHIFTED_M + outline.radius_m() + own.radius_m();
                (place - outline.center()).norm() < reach
            })
        };
        self.field.others.iter().copied().filter(|o| !starts_in(o) && comes_near(o)).collect()
    }

    fn pose(&self, step: usize, shift: Shift) -> Pose {
        let pose = self.path.extrapolate((self.along_m[step] + shift.ahead_m()).max(0.0));
        let left = direction(pose.heading_rad + FRAC_PI_2);
        Pose::new(pose.position + left * shift.aside_m(), pose.heading_rad)
    }

    fn outline(&self, pose: Pose) -> OrientedBox {
        let size = &self.plan.present.size;
        OrientedBox::new(pose.position, 0.5 * size.length_m, 0.5 * size.width_m, pose.heading_rad)
    }

    /// Whether a shift is allowed at an instant. At the goal's instant only zero is. If the goal lies between
    /// two instants, these allow one unit each way.
    fn allows(&self, instant: usize, shift: Shift) -> bool {
        let due = self.plan.target.position.is_some()
            && (instant * PER_INSTANT).abs_diff(self.plan.target.step) < PER_INSTANT;
        let between = instant * PER_INSTANT != self.plan.target.step;
        let hardly = between && shift.ahead.abs() <= 1 && shift.aside.abs() <= 1;
        !due || shift == Shift::NONE || hardly
    }

    /// Cost of each shift of an instant by itself.
    fn costs(&self, instant: usize) -> Vec<f64> {
        let weights = self.field.weights;
        let mut costs = vec![f64::INFINITY; SHIFTS];
        let step = instant * PER_INSTANT;
        let steps = ABOUT.map(|about| step.saturating_add_signed(about).min(HORIZON_STEPS));
        let moments: Vec<ReplanMoment<'_>> = steps.into_iter().filter_map(|step| self.moment(step)).collect();
        let ground: Vec<f64> = (-ASIDES..=ASIDES).map(|aside| self.on_ground(step, aside)).collect();
        for shift in Shift::all().filter(|s| self.allows(instant, *s)) {
            let met = if !moments.iter().any(|m| m.is_in(shift, |u| &u.close)) {
                0.0
            } else if moments.iter().any(|m| m.is_in(shift, |u| &u.met)) {
                weights.met
            } else {
                weights.close
            };
            costs[shift.index()] = met + ground[(shift.aside + ASIDES) as usize] + shift.cost(weights);
        }
        costs
    }

    /// The boxes that may be met at a step; `None` if none is near.
    fn moment(&self, step: usize) -> Option<ReplanMoment<'a>> {
        let own = self.outline(self.pose(step, Shift::NONE));
        let reach_m = SHIFTED_M + own.grown(CLOSE_M + SPARE_M).radius_m();
        let within = |b: &OrientedBox| (b.center() - own.center()).norm() < reach_m + b.radius_m();
        let boxes = self.near.iter().filter_map(|o| o.at(step));
        let near: Vec<&OrientedBox> = boxes.filter(|b| within(b)).collect();
        if near.is_empty() {
            return None;
        }
        let unshifted = |ahead: i32| {
            let pose = self.pose(step, Shift { ahead, aside: 0 });
            let outline = self.outline(pose);
            let left = direction(pose.heading_rad + FRAC_PI_2);
            let (met, close) = (outline.grown(SPARE_M), outline.grown(CLOSE_M + SPARE_M));
            Unshifted { position: pose.position, left, met, close }
        };
        Some(ReplanMoment { near, unshifted: (-AHEADS..=AHEADS).map(unshifted).collect() })
    }

    /// Cost of the ground at this lateral shift.
    fn on_ground(&self, step: usize, aside: i32) -> f64 {
        let pose = self.pose(step, Shift { ahead: 0, aside });
        let away = self.keeps_to_lanes && self.is_off_lanes(pose.position);
        let weights = self.field.weights;
        let away = f64::from(u8::from(away)) * weights.off_lanes;
        let Some(ground) = &self.plan.ground else { return away };
        let off = ground.box_outside_m(&self.outline(pose)).is_some_and(|m| m > BEYOND_M);
        let against = ground.is_wrong_way(pose.position, pose.direction()) == Some(true);
        away + f64::from(u8::from(off)) * weights.off_road + f64::from(u8::from(against)) * weights.against
    }

    fn is_off_lanes(&self, place: Vec2) -> bool {
        self.plan.is_off_lanes(self.field.graph, place, self.field.off_lanes_m)
    }

    /// Metres along the path at each step of an agent that brakes from a step on until it stands.
    fn halting(&self, from: usize, brake_mps2: f64) -> Vec<f64> {
        let mut along_m = self.along_m[..=from].to_vec();
        let last = |along_m: &Vec<f64>| along_m[along_m.len() - 1];
        let mut speed_mps = match from.checked_sub(1) {
            Some(before) => (self.along_m[from] - self.along_m[before]) / STEP_S,
            None => self.plan.model.start_speed_mps(),
        };
        while along_m.len() <= HORIZON_STEPS {
            let next_mps = (speed_mps - brake_mps2 * STEP_S).max(0.0);
            along_m.push(last(&along_m) + 0.5 * (speed_mps + next_mps) * STEP_S);
            speed_mps = next_mps;
        }
        along_m
    }

    /// Whether no box is met at this progress.
    fn is_free(&self, along_m: &[f64]) -> bool {
        (1..along_m.len()).step_by(2).all(|step| {
            let size = &self.plan.present.size;
            let pose = self.path.extrapolate(along_m[step]);
            let (short_m, beside_m) = match self.plan.model.kind {
                MotionKind::Drive => (SHORT_M, ROOM_M),
                MotionKind::Walk => WALKER_ROOM_M,
            };
            let (length, width) = (0.5 * size.length_m + short_m, 0.5 * size.width_m + beside_m);
            !self.is_met(step, &OrientedBox::new(pose.position, length, width, pose.heading_rad))
        })
    }

    /// Another agent is in a box at a step.
    fn is_met(&self, step: usize, outline: &OrientedBox) -> bool {
        self.near.iter().filter_map(|o| o.at(step)).any(|b| meets(b, outline))
    }

    /// The cheapest shifts, one per instant; `None` if no sequence is possible or worth it.
    fn least(&self) -> Option<[Shift; INSTANTS]> {
        let weights = self.field.weights;
        let mut total = vec![f64::INFINITY; SHIFTS];
        total[Shift::NONE.index()] = 0.0;
        let mut before: Vec<Vec<usize>> = Vec::with_capacity(INSTANTS);
        let mut unshifted = 0.0;
        let all: Vec<Shift> = Shift::all().collect();
        for instant in 1..=INSTANTS {
            let costs = self.costs(instant);
            unshifted += costs[Shift::NONE.index()];
            let way_m = self.along_m[instant * PER_INSTANT] - self.along_m[(instant - 1) * PER_INSTANT];
            let mut next = vec![f64::INFINITY; SHIFTS];
            let mut from = vec![Shift::NONE.index(); SHIFTS];
            for shift in all.iter().filter(|s| costs[s.index()].is_finite()) {
                for ahead in -MOST_AHEAD..=MOST_AHEAD {
                    for aside in -MOST_ASIDE..=MOST_ASIDE {
                        let last = Shift { ahead: shift.ahead - ahead, aside: shift.aside - aside };
                        let known = last.ahead.abs() <= AHEADS && last.aside.abs() <= ASIDES;
                        if !known || !self.can_drift(way_m, ahead, aside) {
                            continue;
                        }
                        let drift = weights.drift * (f64::from(aside) * ASIDE_M).powi(2)
                            + weights.pace * (f64::from(ahead) * AHEAD_M).powi(2);
                        let cost = total[last.index()] + drift + costs[shift.index()];
                        if cost < next[shift.index()] {
                            next[shift.index()] = cost;
                            from[shift.index()] = last.index();
                        }
                    }
                }
            }
            total = next;
            before.push(from);
        }
        let mut at = (0..SHIFTS).min_by(|a, b| total[*a].total_cmp(&total[*b]))?;
        // A change must save at least this much.
        if !total[at].is_finite() || total[at] > unshifted - 0.5 * weights.off_road {
            return None;
        }
        let mut shifts = [Shift::NONE; INSTANTS];
        for instant in (0..INSTANTS).rev() {
            shifts[instant] = all[at];
            at = before[instant][at];
        }
        Some(shifts)
    }

    /// Progress never decreases, and wheeled agents move sideways only while they roll.
    fn can_drift(&self, way_m: f64, ahead: i32, aside: i32) -> bool {
        let way_m = way_m + f64::from(ahead) * AHEAD_M;
        let rolls = self.plan.model.kind == MotionKind::Drive;
        way_m >= 0.0 && (!rolls || f64::from(aside.abs()) * ASIDE_M <= SLOPE * way_m + 1e-9)
    }
}
