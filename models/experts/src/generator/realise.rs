//! From route coordinates to motion: residual knots on an anchor, to positions, to control knots, to a
//! rollout that meets the goal and the limits.

use crate::features::agent::Planned;
use crate::planning::{ACROSS_SCALE, ALONG_SCALE, Basis, INSTANTS, RESIDUAL, STAYS_WITHIN_M};
use scene::geometry::direction;
use scene::motion::{
    Gear, Kind, Knots, MotionState, Projection, Reach, Residuals, Sampled, Target, Trajectory, fit, project,
};
use scene::{HORIZON_STEPS, KNOTS, Vec2, wrap_angle};
use std::sync::LazyLock;

/// Steps between two instants.
pub(super) const PER_INSTANT: usize = HORIZON_STEPS / INSTANTS;

pub(super) static BASIS: LazyLock<Basis> = LazyLock::new(Basis::new);

/// One future as motion.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub(super) states: Trajectory,
    pub(super) reach: Reach,
}

impl From<Projection> for Motion {
    fn from(p: Projection) -> Self {
        Self { states: p.trajectory, reach: p.reach }
    }
}

/// Progress and offset of a draft at the instants.
pub(super) fn route_coordinates(
    planned: &Planned,
    slot: usize,
    residual: &[f32; RESIDUAL],
) -> [(f64, f64); INSTANTS] {
    let anchor = &planned.anchors[slot];
    let mut out = [(0.0, 0.0); INSTANTS];
    let mut last = 0.0_f64;
    for (i, place) in out.iter_mut().enumerate() {
        let (mut along, mut across) = (anchor.base_at((i + 1) * PER_INSTANT), 0.0);
        for k in 0..KNOTS {
            along += f64::from(ALONG_SCALE * BASIS.along[i][k] * residual[k]);
            across += f64::from(ACROSS_SCALE * BASIS.across[i][k] * residual[KNOTS + k]);
        }
        // Nobody rolls back along a path.
        last = along.max(last);
        *place = (last, across);
    }
    out
}

/// Box centres and headings of a draft at the instants, before any motion model has its say.
pub(super) fn places(planned: &Planned, slot: usize, residual: &[f32; RESIDUAL]) -> [(Vec2, f64); INSTANTS] {
    let anchor = &planned.anchors[slot];
    route_coordinates(planned, slot, residual).map(|(along, across)| anchor.place(along, across))
}

/// The motion of a draft: fitted to its places and projected onto goal and limits.
pub(super) fn realise(planned: &Planned, slot: usize, residual: &[f32; RESIDUAL]) -> Motion {
    if planned.model.gear == Gear::Reverse {
        return backing(planned);
    }
    through(planned, places(planned, slot, residual))
}

/// The motion between drafts (probability, slot, residual) on one path: their mean progress and offset.
pub(super) fn middle(planned: &Planned, drafts: &[(f64, usize, [f32; RESIDUAL])]) -> Motion {
    let total: f64 = drafts.iter().map(|d| d.0).sum::<f64>().max(1e-12);
    let mut mean = [(0.0, 0.0); INSTANTS];
    for (probability, slot, residual) in drafts {
        let own = route_coordinates(planned, *slot, residual);
        for (mean, own) in mean.iter_mut().zip(own) {
            mean.0 += probability / total * own.0;
            mean.1 += probability / total * own.1;
        }
    }
    let anchor = &planned.anchors[drafts[0].1];
    through(planned, mean.map(|(along, across)| anchor.place(along, across)))
}

/// What motions are projected onto: the goal, or nothing but the limits.
fn projected_onto(planned: &Planned) -> Target {
    let target = planned.target;
    if planned.projected { target } else { Target { step: target.step, ..Target::default() } }
}

/// The motion that passes near these places (box centres and the path's headings) at the instants.
fn through(planned: &Planned, places: [(Vec2, f64); INSTANTS]) -> Motion {
    let mut samples = Vec::with_capacity(INSTANTS);
    let mut last = (planned.present.start.position(), planned.present.start.heading_rad);
    for (i, (position, path_heading)) in places.into_iter().enumerate() {
        // Drifting across a path turns the body; at a crawl the path says it better.
        let chord = position - last.0;
        let chord_heading = if chord.norm() > 1.0 { chord.y.atan2(chord.x) } else { path_heading };
        let drift = wrap_angle(chord_heading - path_heading).clamp(-0.5, 0.5);
        let heading_rad = path_heading + if chord.norm() > 1.0 { 0.5 * drift } else { 0.0 };
        samples.push(Sampled { step: (i + 1) * PER_INSTANT, position, heading_rad });
        last = (position, heading_rad);
    }
    let knots = fit(&planned.model, &samples);
    let motion = project(&planned.model, &knots, &projected_onto(planned), None);
    if motion.reach.is_reached() {
        return motion.into();
    }
    reversing(planned, &motion).unwrap_or_else(|| motion.into())
}

/// Braking of what rolls backwards without a reason to, m/s2.
const BACKING_BRAKE_MPS2: f64 = 1.5;

/// What rolls backwards already (from an earlier window) goes on to its goal or comes to rest: a window
/// never changes the gear of a vehicle in motion.
fn backing(planned: &Planned) -> Motion {
    let braking = Knots { first: [-BACKING_BRAKE_MPS2; KNOTS], ..Knots::default() };
    project(&planned.model, &braking, &projected_onto(planned), None).into()
}

/// A goal behind a standing vehicle may be met backwards.
fn reversing(planned: &Planned, forwards: &Projection) -> Option<Motion> {
    let goal = planned.target.position?;
    let local = planned.model.to_local(goal);
    let may = planned.model.kind == Kind::Drive
        && planned.model.start.velocity().dot(&direction(planned.model.start.heading_rad)) < 0.5
        && local.x < 1.0
        && local.norm() < 30.0;
    if !may {
        return None;
    }
    let model = planned.model.in_gear(Gear::Reverse);
    let backwards = project(&model, &model.coasting(), &planned.target, None);
    let better = |p: &Projection| {
        let r = Residuals::of(&p.trajectory[planned.target.step], &planned.target);
        r.position_m + 5.0 * r.heading_rad + r.speed_mps
    };
    (better(&backwards) < better(forwards)).then(|| backwards.into())
}

/// The start pose without motion.
fn still(planned: &Planned) -> MotionState {
    let start = &planned.present.start;
    MotionState { position: start.position(), heading_rad: start.heading_rad, velocity: Vec2::zeros() }
}

/// Exact rest at the start pose.
pub(super) fn rest(planned: &Planned) -> Motion {
    let still = still(planned);
    let residuals = Residuals::of(&still, &planned.target);
    Motion { states: vec![still; HORIZON_STEPS + 1], reach: Reach::Reached(residuals) }
}

/// Who stands and is not asked to go does not creep: less than [`STAYS_WITHIN_M`] in all is rest.
pub(super) fn without_creep(planned: &Planned, window: usize, motion: Motion) -> Motion {
    let start = planned.present.start.position();
    let creeps = |s: &MotionState| (s.position - start).norm() < STAYS_WITHIN_M;
    let rests = planned.target.is_free() && may_rest(planned, window) && motion.states.iter().all(creeps);
    if rests { rest(planned) } else { motion }
}

/// Standing at the start, and rest meets whatever is asked. What a recording shows standing may creep by
/// its jitter; what an earlier window brought here has to have come to rest by its own motion.
pub(super) fn may_rest(planned: &Planned, window: usize) -> bool {
    let standing_mps = if window == 0 { 0.3 } else { 0.05 };
    planned.present.start.speed_mps() < standing_mps
        && Residuals::of(&still(planned), &planned.target).is_met()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use scene::Goal;

    #[test]
    fn who_stands_goes_or_stays_to_the_last_bit() {
        // To the front at an even pace, this far in all.
        let crept = |planned: &Planned, metres: f64| {
            let mut motion = rest(planned);
            for (step, state) in motion.states.iter_mut().enumerate() {
                state.position.x += metres * step as f64 / HORIZON_STEPS as f64;
            }
            without_creep(planned, 0, motion).states[HORIZON_STEPS].position.x
        };
        let standing = car_on_a_street(0.0, Goal::default());
        assert_eq!([crept(&standing, 0.4), crept(&standing, 0.6)], [0.0, 0.6]);
        let asked = Goal { position: Some(Vec2::new(0.4, 0.0)), ..Goal::default() };
        assert_eq!(crept(&car_on_a_street(0.0, asked), 0.4), 0.4);
        assert_eq!(crept(&car_on_a_street(1.0, Goal::default()), 0.4), 0.4);
    }
}
