//! One motion at the steps of a window, in the forms in which the stages compare it.

use crate::planning::{INSTANTS, PER_INSTANT, STAYS_WITHIN_M};
use scene::geometry::Extent;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::judge::Trace;
use scene::motion::Trajectory;
use scene::score::{CLOSE_M, SweptBoxes, dangerous_moments, overlap, tailgating_moments};
use scene::{AgentId, AgentType, HORIZON_STEPS, STEP_S, Size, State, Vec2};
use std::sync::OnceLock;

/// The choice compares every third step. It omits the start: an overlap there cannot be avoided.
const STRIDE: usize = 3;

/// Box centre and heading at each instant; `None` at an instant at which the agent is absent.
pub(in crate::generator) type Places = [Option<(Vec2, f64)>; INSTANTS];

/// The states of an agent, one per step from the window's start on, and its box. Boxes, swept boxes and trace
/// are computed on first use.
#[derive(Clone, Debug)]
pub(in crate::generator) struct Sweep {
    states: Vec<Option<State>>,
    size: Size,
    boxes: OnceLock<Vec<Option<OrientedBox>>>,
    swept: OnceLock<SweptBoxes>,
    trace: OnceLock<Trace>,
}

impl Sweep {
    /// From one state per step; `None` at a step at which the agent is absent.
    pub(in crate::generator) fn new(states: Vec<Option<State>>, size: &Size) -> Self {
        let (boxes, swept, trace) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { states, size: *size, boxes, swept, trace }
    }

    /// From a rollout that begins at the window's start.
    pub(in crate::generator) fn of_rollout(states: &Trajectory, size: &Size) -> Self {
        Self::new(states.iter().map(|state| Some(State::from(state))).collect(), size)
    }

    /// From states that begin `first` steps after the window's start. States after the window's end are
    /// dropped.
    pub(in crate::generator) fn entering<'a>(
        first: usize,
        states: impl IntoIterator<Item = &'a State>,
        size: &Size,
    ) -> Self {
        let absent = std::iter::repeat_n(None, first);
        let states = absent.chain(states.into_iter().copied().map(Some));
        Self::new(states.take(HORIZON_STEPS + 1).collect(), size)
    }

    /// The size of its box.
    pub(in crate::generator) fn size(&self) -> &Size {
        &self.size
    }

    /// One state per step; `None` at a step at which the agent is absent.
    pub(in crate::generator) fn states(&self) -> &[Option<State>] {
        &self.states
    }

    /// State at a step.
    pub(in crate::generator) fn state(&self, step: usize) -> Option<&State> {
        self.states.get(step)?.as_ref()
    }

    /// One box per step.
    pub(in crate::generator) fn boxes(&self) -> &[Option<OrientedBox>] {
        self.boxes.get_or_init(|| {
            let outline = |state: &State| OrientedBox::of_state(state, &self.size);
            self.states.iter().map(|state| state.as_ref().map(outline)).collect()
        })
    }

    /// Box at a step.
    pub(in crate::generator) fn at(&self, step: usize) -> Option<&OrientedBox> {
        self.boxes().get(step)?.as_ref()
    }

    /// Box at `time_s` after the last step, if the agent is present then and continues straight on.
    pub(in crate::generator) fn beyond(&self, time_s: f64) -> Option<OrientedBox> {
        let last = self.at(HORIZON_STEPS)?;
        Some(last.about(last.center() + self.velocity(HORIZON_STEPS) * time_s))
    }

    /// Rectangle around the places at all steps, and `beyond_s` after the last one.
    pub(in crate::generator) fn extent(&self, beyond_s: f64) -> Extent {
        let last = self.state(HORIZON_STEPS);
        let beyond = last.map(|last| last.position() + self.velocity(HORIZON_STEPS) * beyond_s);
        Extent::of(self.states.iter().flatten().map(State::position).chain(beyond))
    }

    /// The boxes that the choice compares.
    pub(in crate::generator) fn swept(&self) -> &SweptBoxes {
        self.swept.get_or_init(|| {
            let compared = self.states.iter().skip(STRIDE).step_by(STRIDE);
            SweptBoxes::of_states(compared.map(Option::as_ref), &self.size)
        })
    }

    /// The motion from the step after the start on, in the form from which relations and manoeuvres are read.
    pub(in crate::generator) fn trace(&self, id: &AgentId, agent_type: AgentType) -> &Trace {
        self.trace.get_or_init(|| {
            Trace::new(id, agent_type, &self.size, HORIZON_STEPS, |step| self.state(step + 1).copied())
        })
    }

    /// Box centres and headings at the instants.
    pub(in crate::generator) fn places(&self) -> Places {
        let place = |state: &State| (state.position(), state.heading_rad);
        std::array::from_fn(|i| self.state((i + 1) * PER_INSTANT).map(place))
    }

    /// Whether the boxes of two motions do not overlap at the start.
    pub(in crate::generator) fn starts_apart(&self, other: &Self) -> bool {
        match (self.at(0), other.at(0)) {
            (Some(a), Some(b)) => !overlaps(a, b, 0.0),
            _ => true,
        }
    }

    /// Whether the boxes of two motions overlap at some step.
    pub(in crate::generator) fn meets(&self, other: &Self) -> bool {
        let touch = |(a, b): (&Option<OrientedBox>, &Option<OrientedBox>)| match (a, b) {
            (Some(a), Some(b)) => overlaps(a, b, 0.0),
            _ => false,
        };
        let found = overlap(self.swept(), other.swept());
        found.overlaps || found.close && self.boxes().iter().zip(other.boxes()).any(touch)
    }

    /// The first compared step at which two motions come close.
    pub(in crate::generator) fn first_meeting(&self, other: &Self) -> Option<usize> {
        let (a, b) = (self.swept(), other.swept());
        if !overlap(a, b).close {
            return None;
        }
        let near = |i: usize| match (a.at(i), b.at(i)) {
            (Some(p), Some(q)) => overlaps(p, q, CLOSE_M),
            _ => false,
        };
        let moment = (0..a.len()).find(|i| near(*i))?;
        Some(STRIDE * (moment + 1))
    }

    /// The first compared step at which this motion comes close to another one, or follows it too closely.
    pub(in crate::generator) fn first_conflict(&self, other: &Self) -> Option<usize> {
        let tailgates = tailgating_moments(self.swept(), other.swept()).next();
        self.first_meeting(other).into_iter().chain(tailgates.map(|moment| STRIDE * (moment + 1))).min()
    }

    /// Time for which this motion follows another one too closely, seconds.
    pub(in crate::generator) fn tailgates_s(&self, other: &Self) -> f64 {
        tailgating_moments(self.swept(), other.swept()).count() as f64 * STRIDE as f64 * STEP_S
    }

    /// The first step at which two motions touch, or would soon touch at their present velocities.
    pub(in crate::generator) fn first_danger(&self, other: &Self) -> Option<usize> {
        let touch =
            |step: &usize| self.at(*step).zip(other.at(*step)).is_some_and(|(a, b)| overlaps(a, b, 0.0));
        let touched = self.meets(other).then(|| (1..self.states.len()).find(touch)).flatten();
        let danger = dangerous_moments(self.swept(), other.swept()).next();
        touched.into_iter().chain(danger.map(|moment| STRIDE * (moment + 1))).min()
    }

    /// Whether the agent is present and stays within [`STAYS_WITHIN_M`] of its first place.
    pub(in crate::generator) fn stands(&self) -> bool {
        let mut places = self.states.iter().flatten().map(State::position);
        let first = places.next();
        first.is_some_and(|first| places.all(|place| (place - first).norm() < STAYS_WITHIN_M))
    }

    /// Velocity between a step and the step before, m/s; zero where the agent is absent at one of them.
    pub(in crate::generator) fn velocity(&self, step: usize) -> Vec2 {
        match (step.checked_sub(1).and_then(|before| self.state(before)), self.state(step)) {
            (Some(a), Some(b)) => (b.position() - a.position()) / STEP_S,
            _ => Vec2::zeros(),
        }
    }
}
