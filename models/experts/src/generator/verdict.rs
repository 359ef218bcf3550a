//! The faults that one motion would have, by the rules of a scene's score.

use super::window_setting::WindowSetting;
use crate::planning::world::World;
use crate::request::Request;
use scene::judge::{Fault, Judge, Other};
use scene::motion::Trajectory;
use scene::score::Actor;
use scene::{Agent, Future, HORIZON_STEPS, Vec2};

/// An agent farther than this from a motion can meet none of it, metres: half a long vehicle, and as much for the
/// near miss.
pub(super) const AWAY_M: f64 = 25.0;

/// The judge of motions of a window, by the usual thresholds: those of a call change no motion.
pub(super) fn window_judge<'a>(world: &'a World<'_>, setting: &'a WindowSetting<'_>) -> Judge<'a> {
    let scene = &world.scene;
    let steps = world.step..world.step + HORIZON_STEPS + 1;
    Judge::new(&scene.map, &scene.signals, &setting.map.drivable, steps)
}

/// The faults of a motion of an agent, given by its index; `changed` are the agents that do not keep theirs.
pub(super) fn faults(
    setting: &WindowSetting<'_>,
    judge: &Judge<'_>,
    agent: usize,
    motion: &Trajectory,
    changed: &[(usize, Future)],
) -> Vec<Fault> {
    let request = &*setting.request;
    let agents = &request.scene.agents;
    let future = Future::bare(1.0, setting.world.step + 1, setting.cut(motion));
    // What the recording does later must not show in what is chosen.
    let actor = Actor { log: None, reference: None, ..Actor::of_future(&agents[agent], &future, &[]) };
    let mut faults = judge.alone(&actor);
    let low = motion.iter().fold(Vec2::repeat(f64::INFINITY), |low, s| low.inf(&s.position));
    let high = motion.iter().fold(Vec2::repeat(f64::NEG_INFINITY), |high, s| high.sup(&s.position));
    let (low, high) = (low - Vec2::repeat(AWAY_M), high + Vec2::repeat(AWAY_M));
    let near = |place: Vec2| (low.x..=high.x).contains(&place.x) && (low.y..=high.y).contains(&place.y);
    let others = agents.iter().enumerate().filter(|(i, _)| *i != agent).map(|(i, other)| {
        let new = changed.iter().find(|(j, _)| *j == i).map(|(_, future)| future);
        as_taken(request, other, new)
    });
    let others = others.filter(|o| o.track.states.iter().flatten().any(|s| near(s.position())));
    let others: Vec<Other<'_>> = others.map(|other| judge.other(other)).collect();
    faults.extend(judge.among(&actor, others.iter()));
    faults
}

/// A road user with a new motion; without one with the future that the scene keeps, or its log.
pub(super) fn as_taken<'a>(request: &'a Request, agent: &'a Agent, new: Option<&'a Future>) -> Actor<'a> {
    let kept = || request.scene.generated.as_ref()?.chosen_future(&agent.id);
    match new.or_else(kept) {
        Some(future) => Actor::of_future(agent, future, &[]),
        None => Actor::of_log(agent),
    }
}
