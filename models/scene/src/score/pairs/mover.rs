//! One road user made ready for many pairs.

use crate::geometry::obb::OrientedBox;
use crate::geometry::ttc::LOOK_AHEAD_S;
use crate::geometry::{Vec2, wrap_angle};
use crate::score::input::Actor;
use crate::{AgentType, STEP_S};
use std::ops::Range;

/// Steps to each side over which a turn is measured.
const TURN_STEPS: usize = 2;

/// One road user made ready for many pairs: its boxes and velocities over the scored steps.
#[derive(Debug)]
pub(crate) struct Mover {
    /// Box and velocity a scored step.
    pub moments: Vec<Option<MoverState>>,
    /// Greatest distance from its first place, metres.
    pub travel_m: f64,
    /// Farthest any point of its box moves from one seen step to the next, metres.
    pub(super) max_displacement_m: f64,
    /// Greatest speed, m/s.
    pub(super) top_mps: f64,
    /// Holds its boxes at all steps.
    pub places: Option<Rectangle>,
    /// Holds all it can touch within the look-ahead at constant velocity.
    pub(super) reach: Option<Rectangle>,
    pub agent_type: AgentType,
    /// The motion was made, not recorded.
    pub generated: bool,
}

/// Centre and half extents of an upright rectangle, metres.
pub(crate) type Rectangle = (Vec2, Vec2);

/// Box and velocity (m/s) at one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MoverState {
    pub outline: OrientedBox,
    pub velocity: Vec2,
    pub speed_mps: f64,
    /// Bound on how far any point of the box moves to the next step, metres; none without one.
    pub(super) displacement_m: Option<f64>,
}

impl Mover {
    /// Of the motion that is scored, over these scene steps.
    pub(crate) fn new(actor: &Actor<'_>, steps: Range<usize>) -> Self {
        let moment = |step| {
            let state = actor.state(step)?;
            let outline = OrientedBox::of_state(state, &actor.size);
            Some(MoverState {
                outline,
                velocity: state.velocity(),
                speed_mps: state.speed_mps(),
                displacement_m: None,
            })
        };
        let mut moments: Vec<Option<MoverState>> = steps.clone().map(moment).collect();
        for step in 1..moments.len() {
            if let [Some(from), Some(to)] = &mut moments[step - 1..=step] {
                from.displacement_m = Some(displacement(from, to));
            }
        }
        let seen: Vec<&MoverState> = moments.iter().flatten().collect();
        let max_displacement_m = seen.windows(2).map(|w| displacement(w[0], w[1])).fold(0.0, f64::max);
        let top_mps = seen.iter().map(|m| m.speed_mps).fold(0.0, f64::max);
        let places = rectangle(moments.iter().flatten().map(|m| (m.outline, Vec2::zeros())));
        let reach = rectangle(moments.iter().flatten().map(|m| (m.outline, m.velocity * LOOK_AHEAD_S)));
        let travel_m = actor.travel_m(steps);
        let (agent_type, generated) = (actor.agent_type, actor.generated);
        Self { moments, travel_m, max_displacement_m, top_mps, places, reach, agent_type, generated }
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

    /// Box between two steps, `part` from 0 to 1 of the way; places and headings change evenly.
    pub(super) fn between(&self, step: usize, part: f64) -> Option<OrientedBox> {
        let from = self.moments.get(step)?.as_ref()?.outline;
        if part == 0.0 {
            return Some(from);
        }
        let to = self.moments.get(step + 1)?.as_ref()?.outline;
        let center = from.center() + (to.center() - from.center()) * part;
        let heading = from.heading_rad() + wrap_angle(to.heading_rad() - from.heading_rad()) * part;
        Some(OrientedBox::new(center, from.half_length_m(), from.half_width_m(), heading))
    }
}

/// Bound on how far any point of the box moves from the first moment to the second, metres.
fn displacement(from: &MoverState, to: &MoverState) -> f64 {
    let turn = wrap_angle(to.outline.heading_rad() - from.outline.heading_rad()).abs();
    (to.outline.center() - from.outline.center()).norm() + turn * from.outline.radius_m()
}

/// Upright rectangle about boxes, each with its bounding circle moved from here to there.
fn rectangle(moved: impl Iterator<Item = (OrientedBox, Vec2)>) -> Option<Rectangle> {
    let mut low = Vec2::repeat(f64::INFINITY);
    let mut high = -low;
    for (outline, shift) in moved {
        let (p, r) = (outline.center(), Vec2::repeat(outline.radius_m()));
        low = low.inf(&(p.inf(&(p + shift)) - r));
        high = high.sup(&(p.sup(&(p + shift)) + r));
    }
    (low.x <= high.x).then(|| (0.5 * (low + high), 0.5 * (high - low)))
}
