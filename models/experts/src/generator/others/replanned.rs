//! The agents that react by replanning, like regenerated agents.

use crate::generator::actor::PlannedActor;
use crate::generator::motion::KeptMotion;
use crate::generator::trajectory::{rest, to_trajectory};
use crate::generator::workers::WorkerPool;
use crate::planning::STAYS_WITHIN_M;
use crate::planning::world::{AgentAtStart, World};
use scene::{State, Vec2};
use std::collections::BTreeSet;

/// The agents of `may_react` with a goal or via point from an earlier call, or whose motion does not continue
/// from their start. They replan, and keep their motion unless a changed one is in the way. Unless the call
/// `named` them, only agents near an actor are included.
pub(in crate::generator) fn replanned(
    world: &World<'_>,
    workers: &WorkerPool,
    actors: &[PlannedActor],
    may_react: &BTreeSet<usize>,
    named: bool,
    near_m: f64,
) -> Vec<PlannedActor> {
    let asked = |who: &AgentAtStart| {
        let conditions = &world.conditions[who.index];
        !conditions.goal.is_free() || !conditions.via.is_empty() || is_moved(world, who)
    };
    let candidates: Vec<_> =
        world.present.iter().filter(|p| may_react.contains(&p.index) && asked(p)).collect();
    if candidates.is_empty() {
        return Vec::new();
    }
    let paths: Vec<(Vec<Vec2>, f64)> =
        actors.iter().map(|a| (path(a), a.plan.present.size.length_m)).collect();
    let found = workers.map(&candidates, |who| {
        let kept = KeptMotion::states(world, who);
        let parked = kept.iter().all(|s| (s.position() - who.start.position()).norm() < STAYS_WITHIN_M);
        let reach = |length: f64| near_m + 0.5 * (length + who.size.length_m);
        let near = paths.iter().any(|(path, length)| come_near(path, &kept, reach(*length)));
        let leaves_it = !named && !is_moved(world, who) && (parked || !near);
        (!leaves_it).then(|| PlannedActor::reacting(world, who, kept))
    });
    found.into_iter().flatten().collect()
}

/// Whether its motion is useless because it now starts elsewhere or at another speed.
fn is_moved(world: &World<'_>, who: &AgentAtStart) -> bool {
    let kept = KeptMotion::of(&world.scene, world.agent(who), world.step);
    !kept.begins_at(&who.start, &world.conditions[who.index])
}

/// Places of an actor's likeliest draft, one per step.
fn path(actor: &PlannedActor) -> Vec<Vec2> {
    let slot = actor.likeliest();
    let motion =
        if actor.rests { rest(&actor.plan) } else { to_trajectory(&actor.plan, slot, slot.of(&actor.modes)) };
    motion.states.iter().skip(1).map(|s| s.position).collect()
}

/// Whether two motions, with one state per step each, come within this distance within three seconds.
fn come_near(a: &[Vec2], b: &[State], reach_m: f64) -> bool {
    (4..a.len()).step_by(5).any(|i| {
        let from = i.saturating_sub(30);
        let to = (i + 30).min(b.len());
        (from..to).step_by(5).any(|j| (a[i] - b[j].position()).norm() < reach_m)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_is_near_in_time_too() {
        let east: Vec<Vec2> = (1..=90).map(|i| Vec2::new(i as f64, 0.0)).collect();
        // Northwards, crossing x = 60 after this many steps.
        let north = |passes: f64| -> Vec<State> {
            (1..=90).map(|i| State { x_m: 60.0, y_m: i as f64 - passes, ..State::default() }).collect()
        };
        assert!(come_near(&east, &north(60.0), 5.0));
        assert!(come_near(&east, &north(45.0), 5.0));
        assert!(!come_near(&east, &north(15.0), 5.0));
    }
}
