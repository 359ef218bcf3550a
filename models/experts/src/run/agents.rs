//! The road users of a run: those that enter later, those that are present with the plan that they drive, and
//! those that have left.

use crate::generator::{extend_along_road, state_between};
use crate::tuning::fixed::run::{BRAKES_FOR_S, BRAKES_MPS2};
use scene::geometry::direction;
use scene::routes::LaneGraph;
use scene::{AgentType, HORIZON_STEPS, STANDING_MPS, STEP_S, State};

/// Duration of a step of a plan, milliseconds.
pub(super) const PLAN_STEP_MS: u64 = 100;
/// Number of states of a plan that the generator reads: the present and nine seconds.
pub(super) const LOOKED_AT: usize = HORIZON_STEPS + 1;
/// Number of states by which an extended plan exceeds that, so that it is not extended at each step.
const SPARE: usize = 20;
/// Value of `planned_ms` for a road user that has not planned yet.
pub(super) const NEVER_PLANNED: i64 = i64::MIN;

/// One road user of the scene in a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RunAgent {
    pub(super) presence: Presence,
    /// Number of via points that it has passed.
    pub(super) vias_passed: usize,
}

/// Whether a road user is present, and who drives it.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Presence {
    /// It enters later.
    Coming,
    /// The run drives it.
    Driven(DrivenPlan),
    /// The caller drives it.
    Ego(EgoMotion),
    /// It has left and does not return.
    Gone,
}

/// The motion that a road user drives.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DrivenPlan {
    /// Time of the run at the first state, milliseconds.
    pub(super) from_ms: u64,
    /// States 0.1 s apart.
    pub(super) states: Vec<State>,
    /// Time of the run of its last plan, milliseconds; [`NEVER_PLANNED`] at first.
    pub(super) planned_ms: i64,
}

/// The known motion of an ego.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EgoMotion {
    pub(super) state: State,
    /// Announced states, from 0.1 s after the present on.
    pub(super) plan: Vec<State>,
    /// Braking in the last step, m/s2.
    pub(super) brakes_mps2: f64,
}

impl Presence {
    /// The state at this time of the run; `None` if the road user is absent.
    pub(super) fn state(&self, now_ms: u64) -> Option<State> {
        match self {
            Self::Coming | Self::Gone => None,
            Self::Driven(plan) => Some(plan.at(now_ms)),
            Self::Ego(motion) => Some(motion.state),
        }
    }
}

impl DrivenPlan {
    /// The plan of a road user that has not planned yet.
    pub(super) fn fresh(now_ms: u64, state: State) -> Self {
        Self { from_ms: now_ms, states: vec![state], planned_ms: NEVER_PLANNED }
    }

    /// The state at a time of the run, clamped to the plan's first and last state.
    pub(super) fn at(&self, now_ms: u64) -> State {
        let past_ms = now_ms.saturating_sub(self.from_ms);
        let i = (past_ms / PLAN_STEP_MS) as usize;
        let share = (past_ms % PLAN_STEP_MS) as f64 / PLAN_STEP_MS as f64;
        let last = self.states.last().copied().unwrap_or_default();
        let at = |i: usize| self.states.get(i).copied().unwrap_or(last);
        if share == 0.0 { at(i) } else { state_between(&at(i), &at(i + 1), share) }
    }

    /// Drops past states, and extends the plan along the road if it ends within the states that the generator
    /// reads.
    pub(super) fn carry_on(&mut self, now_ms: u64, graph: &LaneGraph, agent_type: AgentType) {
        let past = (now_ms.saturating_sub(self.from_ms) / PLAN_STEP_MS) as usize;
        let past = past.min(self.states.len().saturating_sub(1));
        self.states.drain(..past);
        self.from_ms += past as u64 * PLAN_STEP_MS;
        // One state more, because the present may lie between two states.
        if self.states.len() <= LOOKED_AT {
            let count = LOOKED_AT + 1 + SPARE;
            if self.states.len() == 1 {
                let first = self.states[0];
                self.states = along_road(&first, count, graph, agent_type);
            } else {
                let way: Vec<Option<State>> = self.states.iter().copied().map(Some).collect();
                extend_along_road(&mut self.states, &way, graph, agent_type, count);
            }
        }
    }

    /// The states at 0, 0.1 .. 9 s from now on.
    pub(super) fn ahead(&self, now_ms: u64) -> Vec<State> {
        (0..LOOKED_AT as u64).map(|i| self.at(now_ms + i * PLAN_STEP_MS)).collect()
    }
}

impl EgoMotion {
    /// What the others expect of it: states at 0, 0.1 .. 9 s from now on. They follow its announced plan,
    /// then the road.
    pub(super) fn expected(&self, graph: &LaneGraph, agent_type: AgentType) -> Vec<State> {
        if self.plan.is_empty() {
            let even = along_road(&self.state, LOOKED_AT, graph, agent_type);
            return if self.brakes_mps2 > BRAKES_MPS2 { self.braking(&even) } else { even };
        }
        let mut states: Vec<State> = std::iter::once(self.state).chain(self.plan.iter().copied()).collect();
        let way: Vec<Option<State>> = states.iter().copied().map(Some).collect();
        extend_along_road(&mut states, &way, graph, agent_type, LOOKED_AT);
        while states.len() < LOOKED_AT {
            states.extend(states.last().copied());
        }
        states
    }

    /// The states `even` of a constant speed, slowed down: the ego is expected to continue braking for
    /// `BRAKES_FOR_S`.
    fn braking(&self, even: &[State]) -> Vec<State> {
        let speed_mps = self.state.speed_mps();
        if speed_mps < STANDING_MPS {
            return even.to_vec();
        }
        let (mut along, mut speed) = (0.0, speed_mps);
        (0..even.len())
            .map(|i| {
                let share = along / (speed_mps * STEP_S);
                let at = (share as usize).min(even.len().saturating_sub(2));
                let place = state_between(&even[at], &even[at + 1], share - at as f64);
                let slower = speed / speed_mps;
                let state = State { vx_mps: slower * place.vx_mps, vy_mps: slower * place.vy_mps, ..place };
                let brakes = (i as f64) * STEP_S < BRAKES_FOR_S;
                let then = if brakes { (speed - self.brakes_mps2 * STEP_S).max(0.0) } else { speed };
                along += 0.5 * (speed + then) * STEP_S;
                speed = then;
                state
            })
            .collect()
    }
}

/// States from a state on at its speed: along the road, or straight on for walkers and away from roads.
fn along_road(first: &State, count: usize, graph: &LaneGraph, agent_type: AgentType) -> Vec<State> {
    let speed_mps = first.speed_mps();
    if speed_mps < STANDING_MPS {
        let still = State { vx_mps: 0.0, vy_mps: 0.0, ..*first };
        return std::iter::once(*first).chain(std::iter::repeat_n(still, count - 1)).collect();
    }
    let straight = |i: usize| {
        let moved = first.position() + first.velocity() * (i as f64 * STEP_S);
        State { x_m: moved.x, y_m: moved.y, ..*first }
    };
    let ahead_mps = first.velocity().dot(&direction(first.heading_rad));
    if agent_type != AgentType::Pedestrian && ahead_mps > 0.0 {
        let mut states = vec![*first];
        extend_along_road(&mut states, &[Some(*first)], graph, agent_type, count);
        // Without a road there is no path to follow.
        let moves = |s: &State| (s.position() - first.position()).norm() > 0.5 * speed_mps * STEP_S;
        if states.get(1).is_some_and(moves) {
            return states;
        }
    }
    (0..count).map(straight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::{Lane, LaneMap};
    use scene::{AgentType::Vehicle, Vec2};

    fn street() -> LaneGraph {
        let points: Vec<Vec2> = (0..=400).map(|i| Vec2::new(f64::from(i), 0.0)).collect();
        LaneGraph::new(&LaneMap { lanes: vec![Lane::street("a", points)], ..LaneMap::default() })
    }

    fn going(speed_mps: f64) -> State {
        State { x_m: 10.0, vx_mps: speed_mps, ..State::default() }
    }

    #[test]
    fn a_plan_is_read_between_its_states_and_never_ends() {
        let graph = street();
        let mut plan = DrivenPlan::fresh(200, going(8.0));
        plan.carry_on(200, &graph, Vehicle);
        assert!((plan.at(250).x_m - 10.4).abs() < 1e-6, "{:?}", plan.at(250));
        for now_ms in (200..20_000).step_by(300) {
            plan.carry_on(now_ms, &graph, Vehicle);
            let ahead = plan.ahead(now_ms);
            let x_m = 10.0 + 0.008 * (now_ms - 200) as f64;
            assert!((ahead[0].x_m - x_m).abs() < 0.1 && ahead.len() == LOOKED_AT, "{now_ms}: {:?}", ahead[0]);
            assert!((ahead[90].x_m - x_m - 72.0).abs() < 0.2, "{now_ms}: {:?}", ahead[90]);
        }
    }

    #[test]
    fn an_ego_is_expected_where_it_says_else_along_its_lane_else_to_go_on_braking() {
        let graph = street();
        let silent = EgoMotion { state: going(10.0), plan: Vec::new(), brakes_mps2: 0.0 };
        assert!((silent.expected(&graph, Vehicle)[90].x_m - 100.0).abs() < 0.1);
        let brakes = EgoMotion { brakes_mps2: 4.0, ..silent.clone() };
        let expected = brakes.expected(&graph, Vehicle);
        // 10 m/s, then 1.5 s of braking at 4 m/s2, then 4 m/s.
        assert!((expected[15].x_m - 20.5).abs() < 0.1, "{:?}", expected[15]);
        assert!((expected[90].speed_mps() - 4.0).abs() < 1e-6);
        let halts = State { x_m: 11.0, ..State::default() };
        let told = EgoMotion { plan: vec![halts; 3], ..silent };
        assert_eq!(told.expected(&graph, Vehicle).len(), LOOKED_AT);
        assert!((told.expected(&graph, Vehicle)[90].x_m - 11.0).abs() < 0.1);
    }

    #[test]
    fn who_has_no_road_goes_straight_on() {
        let graph = LaneGraph::new(&LaneMap::default());
        let mut plan = DrivenPlan::fresh(0, going(2.0));
        plan.carry_on(0, &graph, AgentType::Pedestrian);
        assert!((plan.at(9_000).x_m - 28.0).abs() < 1e-6);
        let mut plan = DrivenPlan::fresh(0, going(2.0));
        plan.carry_on(0, &graph, Vehicle);
        assert!((plan.at(9_000).x_m - 28.0).abs() < 1e-6);
    }
}
