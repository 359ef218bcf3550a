//! Road users that get new futures in a window.

use super::slot::Slot;
use crate::features::agent::{AgentPlan, plan};
use crate::planning::anchors::Anchor;
use crate::planning::world::{AgentAtStart, World};
use crate::planning::{MODES, Modes, RESIDUAL};
use crate::tuning::SpeedTuning;
use crate::tuning::fixed::actor::BESIDE_LANE_M;
use scene::geometry::direction;
use scene::motion::{Gear, MotionKind};
use scene::{AgentId, AgentType, HORIZON_STEPS, STEP_S, State};

/// A road user that gets new futures.
pub(super) struct PlannedActor {
    pub(super) id: AgentId,
    pub(super) plan: AgentPlan,
    /// Its motion without this call. A reacting agent keeps it unless another agent is in its way.
    pub(super) kept: Option<Vec<State>>,
    /// The future that the user picked; it is not changed.
    pub(super) pinned: Option<Vec<State>>,
    /// First drafts, one per mode.
    pub(super) modes: Modes,
    /// Probability of each mode; they sum to one.
    pub(super) probability: [f64; MODES],
    /// Modes in order of descending probability.
    pub(super) order: [Slot; MODES],
    /// The actor stays where it is.
    pub(super) rests: bool,
    /// The agent was parked when the call began and has neither a goal nor a via point.
    pub(super) stays_parked: bool,
    pub(super) stays_probability: f64,
    /// A vehicle that starts within the road's edges.
    pub(super) keeps_to_the_road: bool,
    /// Factor of the networks' output, from 0 to 1.
    network_weight: f32,
}

/// Modes in order of descending probability.
pub(super) fn by_probability(probability: &[f64; MODES]) -> [Slot; MODES] {
    let mut order: [Slot; MODES] = std::array::from_fn(Slot::new);
    order.sort_by(|a, b| {
        let falling = probability[b.index()].total_cmp(&probability[a.index()]);
        falling.then(a.cmp(b))
    });
    order
}

impl PlannedActor {
    /// A road user with a plan. `kept` is the motion that it has without this call, if any.
    pub(super) fn new(id: AgentId, plan: AgentPlan, kept: Option<Vec<State>>) -> Self {
        Self {
            id,
            plan,
            kept,
            pinned: None,
            modes: [[0.0; RESIDUAL]; MODES],
            probability: [1.0 / MODES as f64; MODES],
            order: std::array::from_fn(Slot::new),
            rests: false,
            stays_parked: false,
            stays_probability: 0.0,
            keeps_to_the_road: false,
            network_weight: 1.0,
        }
    }

    /// Lowers the weight of the networks for an agent that is, or has to be, faster than their training data.
    pub(super) fn weigh_networks(&mut self, tuning: &SpeedTuning) {
        let Self { plan, network_weight, .. } = self;
        let mean_mps = |anchor: &Anchor| anchor.base[HORIZON_STEPS] / (HORIZON_STEPS as f64 * STEP_S);
        let asked_mps = plan.anchors.first().filter(|_| plan.target.position.is_some()).map_or(0.0, mean_mps);
        let speed_mps = plan.model.start_speed_mps().max(asked_mps);
        let SpeedTuning { known_mps, unknown_mps } = *tuning;
        *network_weight = ((unknown_mps - speed_mps) / (unknown_mps - known_mps)).clamp(0.0, 1.0) as f32;
    }

    /// The networks' modes times the actor's `network_weight`.
    pub(super) fn weighed(&self, mut modes: Modes) -> Modes {
        modes.as_flattened_mut().iter_mut().for_each(|value| *value *= self.network_weight);
        modes
    }

    /// An actor that the call regenerates, or that has no motion to keep.
    pub(super) fn asked(world: &World<'_>, who: &AgentAtStart) -> Self {
        Self::new(world.agent(who).id.clone(), plan(world, who), None)
    }

    /// An actor that may replace its motion `kept` to yield to others. It keeps the goal that it had.
    pub(super) fn reacting(world: &World<'_>, who: &AgentAtStart, kept: Vec<State>) -> Self {
        Self::new(world.agent(who).id.clone(), plan(world, who), Some(kept))
    }

    /// Prepares a start in a state that an earlier window reached. A vehicle that rolls backwards does so
    /// until it stands.
    pub(super) fn goes_on(&mut self, parked: bool) {
        let plan = &mut self.plan;
        self.stays_parked = parked && plan.is_free();
        let start = &plan.present.start;
        let ahead_mps = start.velocity().dot(&direction(start.heading_rad));
        if plan.model.kind == MotionKind::Drive && ahead_mps < -1e-3 {
            plan.model = plan.model.in_gear(Gear::Reverse);
        }
    }

    /// Sets the first modes and their probabilities from the initializer's output.
    pub(super) fn set_modes(&mut self, modes: Modes, probability: [f64; MODES]) {
        (self.modes, self.probability) = (modes, probability);
        self.order = by_probability(&probability);
    }

    /// The most probable mode.
    pub(super) fn likeliest(&self) -> Slot {
        self.order[0]
    }

    /// Whether the actor is a vehicle at rest beside or off every lane. Neither a signal nor a leader can
    /// make it start.
    pub(super) fn is_parked(&self) -> bool {
        let off_lane =
            |anchor: &Anchor| anchor.route.as_ref().is_none_or(|r| r.lateral_m.abs() > BESIDE_LANE_M);
        self.plan.present.agent_type == AgentType::Vehicle && self.plan.anchors.first().is_some_and(off_lane)
    }

    /// Whether rest is the only motion that the actor can have.
    pub(super) fn only_rests(&self) -> bool {
        self.rests && (self.stays_parked || !self.plan.is_free())
    }

    /// Whether its motion is fixed: it rests, or a person picked its future.
    pub(super) fn keeps_still(&self) -> bool {
        self.rests || self.pinned.is_some()
    }
}
