//! Variations of a draft on its own path: another pace, another line, or another order at a crossing. The
//! goal is kept, because goals are linear in the knots (see [`crate::planning::coordinates`]).

use super::actor::PlannedActor;
use super::draft_traces::trace_of;
use super::slot::Slot;
use super::trajectory::{BASIS, route_coordinates};
use crate::features::agent::AgentPlan;
use crate::planning::profile::Caps;
use crate::planning::{
    ACROSS_SCALE, ALONG_SCALE, INSTANT_S, INSTANTS, RESIDUAL, Residual, integrated_hat, twice_integrated_hat,
};
pub(super) use crate::tuning::fixed::variations::HURRY;
use crate::tuning::fixed::variations::{
    AFTER_GOAL_M, BRISK, CLEAR_M, DRIVING_M, DRIVING_MPS2, DRIVING_TO_GOAL_M, GAPS_S, LEFT_S, NEAR_GOAL_S,
    ON_FOOT_M, ON_FOOT_MPS2, ON_FOOT_TO_GOAL_M, OVER_KERB_M, RIDING_M, RIDING_MPS2, RIDING_TO_GOAL_M,
    SOONEST_S, SPARE_MPS, SPARE_MPS2, WALKING_MPS,
};
use nalgebra::{DMatrix, DVector};
use scene::judge::{Trace, crossing};
use scene::motion::MotionKind;
use scene::{AgentType, KNOT_S, KNOTS, STEP_S, Vec2};
use std::cell::OnceCell;

/// The end of a window, seconds.
const END_S: f64 = INSTANTS as f64 * INSTANT_S;
/// Times at which the progress of a waiting draft is prescribed, seconds.
const HELD_AT_S: [f64; 6] = [1.5, 3.0, 4.5, 6.0, 7.5, 9.0];

/// A draft with its progress: the input from which variations are made and measured.
pub(super) struct DraftView<'a> {
    actor: &'a PlannedActor,
    pub(super) slot: Slot,
    pub(super) residual: Residual,
    /// Progress and offset at the instants, metres.
    route: [(f64, f64); INSTANTS],
    places: [(Vec2, f64); INSTANTS],
    trace: OnceCell<Trace>,
}

impl<'a> DraftView<'a> {
    pub(super) fn of(actor: &'a PlannedActor, slot: Slot, residual: &Residual) -> Self {
        let route = route_coordinates(&actor.plan, slot, residual);
        let anchor = &actor.plan.anchors[slot.index()];
        let places = route.map(|(along, across)| anchor.place(along, across));
        Self { actor, slot, residual: *residual, route, places, trace: OnceCell::new() }
    }

    /// The same draft with an offset added.
    pub(super) fn with(&self, offset: &Residual) -> Self {
        let residual = std::array::from_fn(|k| self.residual[k] + offset[k]);
        Self::of(self.actor, self.slot, &residual)
    }

    /// The draft as others see it.
    pub(super) fn trace(&self) -> &Trace {
        self.trace.get_or_init(|| trace_of(self.actor, &self.places))
    }

    /// Mean distance from another draft, metres.
    pub(super) fn apart_m(&self, other: &Self) -> f64 {
        let each = self.places.iter().zip(&other.places);
        each.map(|(a, b)| (a.0 - b.0).norm()).sum::<f64>() / INSTANTS as f64
    }

    /// Distance travelled in the window, metres.
    pub(super) fn way_m(&self) -> f64 {
        self.route[INSTANTS - 1].0
    }

    /// Whether it has come to rest by the window's end.
    pub(super) fn ends_at_rest(&self) -> bool {
        self.route[INSTANTS - 1].0 - self.route[INSTANTS - 2].0 < scene::STANDING_MPS * INSTANT_S
    }

    pub(super) fn along_at(&self, seconds: f64) -> f64 {
        let at = (seconds / INSTANT_S).clamp(0.0, INSTANTS as f64);
        let (i, share) = (at.floor() as usize, at.fract());
        let knot = |i: usize| if i == 0 { 0.0 } else { self.route[i.min(INSTANTS) - 1].0 };
        knot(i) + share * (knot(i + 1) - knot(i))
    }

    /// Speeds between the instants, m/s.
    fn speeds(&self) -> [f64; INSTANTS] {
        std::array::from_fn(|i| {
            let before = if i == 0 { 0.0 } else { self.route[i - 1].0 };
            (self.route[i].0 - before) / INSTANT_S
        })
    }

    /// Whether braking, acceleration and pace stay usual, or no worse than in `from`. `hurry` is the share by
    /// which it may exceed the caps of its path.
    pub(super) fn is_usual(&self, from: &Self, hurry: f64) -> bool {
        self.is_within(from, hurry, usual_rates(self.actor.plan.present.agent_type))
    }

    /// The same for these rates of braking and speeding up, m/s2.
    fn is_within(&self, from: &Self, hurry: f64, (brakes, speeds_up): (f64, f64)) -> bool {
        let plan = &self.actor.plan;
        let anchor = &plan.anchors[self.slot.index()];
        let caps = match plan.model.kind {
            MotionKind::Drive => Caps::new(anchor.path.arc_m(), &anchor.caps_mps),
            MotionKind::Walk => Caps::new(&[0.0], &[WALKING_MPS]),
        };
        let v0 = plan.model.start_speed_mps();
        let (mine, theirs) = (self.speeds(), from.speeds());
        let fastest = theirs.iter().copied().fold(v0, f64::max);
        let rates = |v: &[f64; INSTANTS]| -> [f64; INSTANTS] {
            // The first difference is the speed in the middle of the first interval.
            std::array::from_fn(|i| {
                if i == 0 { (v[0] - v0) / (0.5 * INSTANT_S) } else { (v[i] - v[i - 1]) / INSTANT_S }
            })
        };
        let own = rates(&theirs);
        let least = own.iter().copied().fold(-brakes, f64::min);
        let most = own.iter().copied().fold(speeds_up, f64::max);
        let each = rates(&mine).into_iter().zip(mine).zip(&self.route);
        each.into_iter().all(|((rate, speed), (along, _))| {
            let cap = (hurry * caps.at(*along)).max(fastest);
            rate >= least - SPARE_MPS2 && rate <= most + SPARE_MPS2 && speed <= cap + SPARE_MPS
        })
    }

    /// The draft `like` on this path, waiting at the kerb until `passed_s`. `None` if there is no kerb, or it
    /// cannot stop there in time.
    pub(super) fn waiting_at_kerb(&self, like: &Self, passed_s: f64) -> Option<Self> {
        let plan = &self.actor.plan;
        let kerb = plan.kerbs[self.slot.index()].as_ref()?;
        let wanted = std::array::from_fn(|step| like.along_at(step as f64 * STEP_S));
        let until = (passed_s / STEP_S).ceil() as usize;
        let held = kerb.held(&wanted, plan.model.start_speed_mps(), until)?;
        let shifts = HELD_AT_S.map(|t| (t, held[(t / STEP_S).round() as usize] - self.along_at(t)));
        let made = self.with(&pace(plan, &shifts)?);
        let stays = (0..=until.min((END_S / STEP_S) as usize))
            .all(|step| made.along_at(step as f64 * STEP_S) <= kerb.line_m + OVER_KERB_M);
        stays.then_some(made)
    }

    /// A change of pace that passes before or after another agent where their paths cross. `None` if they do
    /// not cross or no usual change of pace does it.
    pub(super) fn ordered(&self, other: &Trace, before: bool) -> Option<Self> {
        let ground = crossing(self.trace(), other)?;
        let seconds = |moment: usize| Trace::seconds(moment) + STEP_S;
        // An agent that goes first or lets another pass accelerates and brakes harder than without traffic.
        let (brakes, speeds_up) = usual_rates(self.actor.plan.present.agent_type);
        let brisk = (BRISK.0 * brakes, BRISK.1 * speeds_up);
        let made = GAPS_S.iter().find_map(|gap_s| {
            let (when_s, wanted_m) = if before {
                (seconds(ground.theirs.0) - gap_s, self.along_at(seconds(ground.mine.1)) + CLEAR_M)
            } else {
                (seconds(ground.theirs.1) + gap_s, self.along_at(seconds(ground.mine.0)) - CLEAR_M)
            };
            if !(SOONEST_S..END_S).contains(&when_s) {
                return None;
            }
            let shift_m = wanted_m - self.along_at(when_s);
            let made = self.with(&pace(&self.actor.plan, &[(when_s, shift_m)])?);
            made.is_within(self, HURRY, brisk).then_some(made)
        })?;
        let order = crossing(made.trace(), other).map(|g| g.order());
        (order == Some(if before { 1 } else { -1 })).then_some(made)
    }
}

/// Usual braking and acceleration, m/s2.
fn usual_rates(agent_type: AgentType) -> (f64, f64) {
    match agent_type {
        AgentType::Pedestrian => ON_FOOT_MPS2,
        AgentType::Cyclist => RIDING_MPS2,
        _ => DRIVING_MPS2,
    }
}

/// Longitudinal knots of the gentlest change of pace that is ahead by these metres at these times and keeps
/// the goal. `None` if the goal leaves no room for it.
pub(super) fn pace(plan: &AgentPlan, shifts: &[(f64, f64)]) -> Option<Residual> {
    let goal_s = plan.target.step as f64 * STEP_S;
    let row = |f: fn(usize, f64) -> f64, t: f64| -> [f64; KNOTS] { std::array::from_fn(|k| f(k, t)) };
    let mut rows: Vec<([f64; KNOTS], f64)> = Vec::with_capacity(shifts.len() + 2);
    if plan.target.position.is_some() {
        rows.push((row(twice_integrated_hat, goal_s), 0.0));
        if shifts.iter().any(|(t, _)| (t - goal_s).abs() < NEAR_GOAL_S) {
            return None;
        }
    }
    // A change after the goal does not change the arrival.
    let after_goal = plan.target.position.is_some() && shifts.iter().any(|(t, _)| *t > goal_s);
    if plan.target.speed_mps.is_some() || after_goal {
        rows.push((row(integrated_hat, goal_s), 0.0));
    }
    rows.extend(shifts.iter().map(|(t, metres)| (row(twice_integrated_hat, *t), *metres)));
    let a = DMatrix::from_fn(rows.len(), KNOTS, |i, k| rows[i].0[k]);
    let wanted = DVector::from_fn(rows.len(), |i, _| rows[i].1);
    let gram = &a * a.transpose() + DMatrix::identity(rows.len(), rows.len()) * 1e-9;
    let knots = a.transpose() * gram.cholesky()?.solve(&wanted);
    let mut offset = [0.0; RESIDUAL];
    for (knot, value) in offset.iter_mut().zip(knots.iter()) {
        *knot = *value as f32 / ALONG_SCALE;
    }
    offset.iter().all(|v| v.is_finite()).then_some(offset)
}

/// Lateral knots of a line that is this far aside half way to the goal, or at the end if there is no goal.
pub(super) fn line(plan: &AgentPlan, aside_m: f64) -> Residual {
    let goal_s = plan.target.step as f64 * STEP_S;
    let share = |t: f64| match plan.target.position {
        Some(_) if t < goal_s => (std::f64::consts::PI * t / goal_s).sin().powi(2),
        Some(_) => 0.0,
        None => (t / END_S).powi(2) * (3.0 - 2.0 * t / END_S),
    };
    let mut offset = [0.0; RESIDUAL];
    for k in 1..KNOTS {
        offset[KNOTS + k] = (aside_m * share(k as f64 * KNOT_S)) as f32 / ACROSS_SCALE;
    }
    tangent(plan, &offset)
}

/// An offset without the part that would change the goal.
pub(super) fn tangent(plan: &AgentPlan, offset: &Residual) -> Residual {
    let mut out = [0.0; RESIDUAL];
    for (half, projection) in plan.features.tangent.iter().enumerate() {
        for (i, row) in projection.iter().enumerate() {
            let from = &offset[half * KNOTS..(half + 1) * KNOTS];
            out[half * KNOTS + i] = row.iter().zip(from).map(|(p, v)| p * v).sum();
        }
    }
    out
}

/// Mean metres along and across that an offset moves a draft.
pub(super) fn moves_m(offset: &Residual) -> (f64, f64) {
    let (mut along, mut across) = (0.0, 0.0);
    for i in 0..INSTANTS {
        let sum = |basis: &[f32; KNOTS], knots: &[f32]| -> f64 {
            f64::from(basis.iter().zip(knots).map(|(b, k)| b * k).sum::<f32>())
        };
        along += sum(&BASIS.along[i], &offset[..KNOTS]).abs();
        across += sum(&BASIS.across[i], &offset[KNOTS..]).abs();
    }
    let count = INSTANTS as f64;
    (f64::from(ALONG_SCALE) * along / count, f64::from(ACROSS_SCALE) * across / count)
}

/// Other paces and lines to try, the most distinct first: metres ahead, when, and metres aside.
pub(super) fn pace_steps(plan: &AgentPlan, late_first: bool) -> Vec<Residual> {
    let goal_s = plan.target.step as f64 * STEP_S;
    let agent_type = plan.present.agent_type;
    let (paces, aside_m): (&[f64], f64) = match (agent_type, plan.target.position.is_some()) {
        (AgentType::Pedestrian, true) => ON_FOOT_TO_GOAL_M,
        (AgentType::Pedestrian, false) => ON_FOOT_M,
        (AgentType::Cyclist, true) => RIDING_TO_GOAL_M,
        (AgentType::Cyclist, false) => RIDING_M,
        (_, true) => DRIVING_TO_GOAL_M,
        (_, false) => DRIVING_M,
    };
    let sign = if late_first { -1.0 } else { 1.0 };
    let middle_s = if plan.target.position.is_some() { 0.5 * goal_s } else { END_S };
    let mut out = Vec::with_capacity(4 * paces.len() + 4);
    let lines = |out: &mut Vec<Residual>| out.extend([1.0, -1.0].map(|s| line(plan, s * sign * aside_m)));
    for (i, metres) in paces.iter().enumerate() {
        out.extend([1.0, -1.0].iter().filter_map(|s| pace(plan, &[(middle_s, s * sign * metres)])));
        if i == 0 {
            lines(&mut out);
        }
    }
    let both = |metres: f64, aside: f64| -> Option<Residual> {
        let (along, across) = (pace(plan, &[(middle_s, metres)])?, line(plan, aside));
        Some(std::array::from_fn(|k| along[k] + across[k]))
    };
    let small = paces.last().copied().unwrap_or(1.0);
    out.extend(
        [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)]
            .into_iter()
            .filter_map(|(a, b)| both(a * sign * small, b * aside_m)),
    );
    // For a goal that is met early: slower or faster after it.
    if plan.target.position.is_some() && goal_s < END_S - LEFT_S {
        let later = AFTER_GOAL_M.map(|metres| pace(plan, &[(END_S, sign * metres)]));
        out.extend(later.into_iter().flatten());
    }
    out
}
