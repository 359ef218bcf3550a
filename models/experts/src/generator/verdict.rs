//! The faults that one motion would have, by the rules of a scene's score.

use super::window_setting::WindowSetting;
use crate::request::Request;
use scene::geometry::Extent;
use scene::judge::{Change, Fault, Judge, Other};
use scene::motion::Trajectory;
use scene::score::Actor;
use scene::{Agent, Future, HORIZON_STEPS, State, Vec2};

/// An agent farther than this from a motion has no fault with it, metres: half a long vehicle, plus as much
/// for a near miss.
const AWAY_M: f64 = 25.0;

/// The judge of motions in a window, with the default thresholds: the thresholds of a call change no motion.
pub(super) fn window_judge<'a>(setting: &'a WindowSetting<'_>) -> Judge<'a> {
    let world = &setting.world;
    let steps = world.step..world.step + HORIZON_STEPS + 1;
    Judge::new(&world.scene.map, &world.scene.signals, &setting.map.drivable, steps)
}

/// An agent that does not keep its motion.
pub(super) struct ChangedAgent {
    /// Index into the scene's agents.
    pub(super) agent: usize,
    pub(super) future: Future,
    /// Whether the judged motion is the cause.
    pub(super) is_caused: bool,
}

/// A motion of an agent, to be judged.
pub(super) struct JudgedMotion<'a> {
    setting: &'a WindowSetting<'a>,
    /// Index into the scene's agents.
    agent: usize,
    future: Future,
}

impl<'a> JudgedMotion<'a> {
    /// Of the agent of this index.
    pub(super) fn new(setting: &'a WindowSetting<'a>, agent: usize, motion: &Trajectory) -> Self {
        let future = Future::bare(1.0, setting.world.step + 1, setting.cut(motion));
        Self { setting, agent, future }
    }

    /// Recorded states after the start must not influence the choice.
    fn actor(&self) -> Actor<'_> {
        let agent = &self.setting.request.scene.agents[self.agent];
        Actor { log: None, reference: None, ..Actor::of_future(agent, &self.future, &[]) }
    }

    /// The faults that do not involve another agent.
    pub(super) fn alone(&self, judge: &Judge<'_>) -> Vec<Fault> {
        judge.alone(&self.actor())
    }

    /// The faults that involve another agent. `changed` are the agents that do not keep their motions.
    pub(super) fn among(&self, judge: &Judge<'_>, changed: &[ChangedAgent]) -> Vec<Fault> {
        let (actor, request) = (self.actor(), &*self.setting.request);
        let agents = &request.scene.agents;
        let ground = MotionExtent::about(self.future.states.iter().map(State::position));
        let others = agents.iter().enumerate().filter(|(i, _)| *i != self.agent).map(|(i, other)| {
            let new = changed.iter().find(|other| other.agent == i).map(|other| &other.future);
            as_taken(request, other, new)
        });
        let others = others.filter(|o| o.track.states.iter().flatten().any(|s| ground.holds(s.position())));
        let others: Vec<Other<'_>> = others.map(|other| judge.other(other)).collect();
        let mut faults = judge.among(&actor, others.iter());
        let caused = changed.iter().filter(|other| other.is_caused);
        let changes = caused.map(|other| change(request, &agents[other.agent], &other.future));
        faults.extend(judge.towards(&actor, &changes.collect::<Vec<_>>()));
        faults
    }
}

/// A road user with a new motion, else with the future that the scene keeps, else with its log.
pub(super) fn as_taken<'a>(request: &'a Request, agent: &'a Agent, new: Option<&'a Future>) -> Actor<'a> {
    let kept = || request.scene.generated.as_ref()?.chosen_future(&agent.id);
    match new.or_else(kept) {
        Some(future) => Actor::of_future(agent, future, &[]),
        None => Actor::of_log(agent),
    }
}

/// A road user with the motion that another one causes, and without it.
pub(super) fn change<'a>(request: &'a Request, agent: &'a Agent, now: &'a Future) -> Change<'a> {
    Change { now: as_taken(request, agent, Some(now)), before: as_taken(request, agent, None) }
}

/// Upright rectangle around motions, with room for the agents that can meet them.
pub(super) struct MotionExtent(Extent);

impl MotionExtent {
    /// The rectangle around these places.
    pub(super) fn about(places: impl Iterator<Item = Vec2>) -> Self {
        Self(Extent::of(places))
    }

    /// Whether an agent at this place may meet one of the motions.
    pub(super) fn holds(&self, place: Vec2) -> bool {
        self.0.outside_m(place) <= AWAY_M
    }
}
