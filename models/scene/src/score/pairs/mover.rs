//! One road user, prepared for comparison with many others.

use crate::geometry::obb::OrientedBox;
use crate::geometry::ttc::LOOK_AHEAD_S;
use crate::geometry::{Extent, Vec2, wrap_angle};
use crate::score::input::Actor;
use crate::{AgentType, STEP_S, State};
use std::ops::Range;

/// Steps to each side over which a turn rate is measured.
const TURN_STEPS: usize = 2;

/// One road user, prepared for comparison with many others: its boxes and velocities over the scored steps.
#[derive(Debug)]
pub(crate) struct Mover {
    /// Box and velocity per scored step.
    pub moments: Vec<Option<MoverState>>,
    /// Greatest distance from its first place, metres.
    pub travel_m: f64,
    /// Greatest displacement of any point of its box between consecutive known steps, metres.
    pub(super) max_displacement_m: f64,
    /// Greatest speed, m/s.
    pub(super) top_mps: f64,
    pub bounds: MoverBounds,
    pub agent_type: AgentType,
    /// Whether the motion was generated, not recorded.
    pub generated: bool,
}

/// Bounds of a road user's places over the scored steps, and of what it can touch, without its boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MoverBounds {
    /// Contains its boxes at all steps.
    pub(crate) places: Option<Rectangle>,
    /// Contains everything that it can touch within the look-ahead at constant velocity.
    reach: Option<Rectangle>,
}

impl MoverBounds {
    /// Bounds of the scored motion over these scene steps.
    pub(crate) fn new(actor: &Actor<'_>, steps: Range<usize>) -> Self {
        let radius_m = OrientedBox::of_state(&State::default(), &actor.size).radius_m();
        let states = || steps.clone().filter_map(|step| actor.state(step));
        let places = rectangle(radius_m, states().map(|state| (state.position(), Vec2::zeros())));
        let reach = states().map(|state| (state.position(), state.velocity() * LOOK_AHEAD_S));
        Self { places, reach: rectangle(radius_m, reach) }
    }

    /// Whether nothing this pair does can change a score. Neither reaches the other within the look-ahead,
    /// and their places stay farther apart than the known smallest gaps, metres.
    pub(crate) fn stay_apart(&self, other: &Self, known_m: f64) -> bool {
        let clear = |p: Option<Rectangle>, q: Option<Rectangle>| match (p, q) {
            (Some((cp, hp)), Some((cq, hq))) => {
                let apart = (cp - cq).abs() - hp - hq;
                Vec2::new(apart.x.max(0.0), apart.y.max(0.0)).norm()
            }
            _ => f64::INFINITY,
        };
        clear(self.reach, other.reach) > 0.0 && clear(self.places, other.places) > known_m
    }
}

/// Centre and half extents of an upright rectangle, metres.
pub(crate) type Rectangle = (Vec2, Vec2);

/// Box and velocity (m/s) at one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MoverState {
    pub outline: OrientedBox,
    pub velocity: Vec2,
    pub speed_mps: f64,
    /// Bound of the displacement of any point of the box to the next step, metres; `None` without one.
    pub(super) displacement_m: Option<f64>,
}

impl Mover {
    /// The scored motion over these scene steps.
    pub(crate) fn new(actor: &Actor<'_>, steps: Range<usize>) -> Self {
        let mut moments: Vec<Option<MoverState>> = Vec::with_capacity(steps.len());
        let (mut max_displacement_m, mut top_mps) = (0.0_f64, 0.0_f64);
        let mut before: Option<(usize, MoverState)> = None;
        for (i, step) in steps.clone().enumerate() {
            let moment = actor.state(step).map(|state| {
                let known = before.filter(|(_, b)| b.outline.heading_rad() == state.heading_rad);
                let outline = match known {
                    Some((_, before)) => before.outline.about(state.position()),
                    None => OrientedBox::of_state(state, &actor.size),
                };
                let (velocity, speed_mps) = (state.velocity(), state.speed_mps());
                MoverState { outline, velocity, speed_mps, displacement_m: None }
            });
            if let Some(moment) = moment {
                if let Some((last, from)) = &before {
                    let moved_m = displacement(from, &moment);
                    max_displacement_m = max_displacement_m.max(moved_m);
                    if let Some(from) = moments[*last].as_mut().filter(|_| last + 1 == i) {
                        from.displacement_m = Some(moved_m);
                    }
                }
                top_mps = top_mps.max(moment.speed_mps);
                before = Some((i, moment));
            }
            moments.push(moment);
        }
        let (travel_m, bounds) = (actor.travel_m(steps.clone()), MoverBounds::new(actor, steps));
        let (agent_type, generated) = (actor.agent_type, actor.generated);
        Self { moments, travel_m, max_displacement_m, top_mps, bounds, agent_type, generated }
    }

    /// Turn rate at a step, rad/s, from the headings 0.2 s before and after. Zero for pedestrians, which turn
    /// on the spot, and at the ends of the known motion.
    pub(super) fn turn_rate_radps(&self, step: usize) -> f64 {
        let heading = |i: usize| Some(self.moments.get(i)?.as_ref()?.outline.heading_rad());
        let (before, after) = (step.saturating_sub(TURN_STEPS), step + TURN_STEPS);
        match (heading(before), heading(step), heading(after)) {
            _ if self.agent_type == AgentType::Pedestrian => 0.0,
            (Some(from), _, Some(to)) => wrap_angle(to - from) / (STEP_S * (after - before) as f64),
            (Some(from), Some(to), None) if before < step => {
                wrap_angle(to - from) / (STEP_S * (step - before) as f64)
            }
            _ => 0.0,
        }
    }

    /// Box between two steps at a share of 0 to 1; position and heading are interpolated linearly.
    pub(super) fn between(&self, step: usize, part: f64) -> Option<OrientedBox> {
        let from = self.moments.get(step)?.as_ref()?.outline;
        if part == 0.0 {
            return Some(from);
        }
        let to = self.moments.get(step + 1)?.as_ref()?.outline;
        let center = from.center() + (to.center() - from.center()) * part;
        let heading = from.heading_rad() + turn_rad(&from, &to) * part;
        Some(OrientedBox::new(center, from.half_length_m(), from.half_width_m(), heading))
    }
}

/// The turn between two boxes, at most a quarter turn. Detectors sometimes confuse front and back, and a box
/// turned by half is the same box.
fn turn_rad(from: &OrientedBox, to: &OrientedBox) -> f64 {
    0.5 * wrap_angle(2.0 * (to.heading_rad() - from.heading_rad()))
}

/// Bound of the displacement of any point of the box from the first moment to the second, metres.
fn displacement(from: &MoverState, to: &MoverState) -> f64 {
    let turn = turn_rad(&from.outline, &to.outline).abs();
    (to.outline.center() - from.outline.center()).norm() + turn * from.outline.radius_m()
}

/// Upright rectangle around circles of this radius, each moved between two points.
fn rectangle(radius_m: f64, moved: impl Iterator<Item = (Vec2, Vec2)>) -> Option<Rectangle> {
    let centers = Extent::about(moved.flat_map(|(p, shift)| [p, p + shift]))?;
    let about = centers.grown(radius_m);
    Some((about.middle(), 0.5 * about.size()))
}
