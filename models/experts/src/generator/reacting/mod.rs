//! Those who may give up the motion that they have, and who of them does.
//!
//! A kept motion is everybody's first option. Who keeps it is in nobody's way but that of a changed motion: of those
//! that were asked for, and of those that changed because of them. Whose kept motion meets none of these stays as it
//! is; the others drive their own path at another pace ([`giving_way`]), one after the other ([`chain`]).

mod blocks;
mod chain;
mod course;
mod giving_way;
mod reaction;
mod yielding;

pub(super) use chain::{Answered, Changed, caused};
pub(super) use course::{Moving, carry_on};
pub(super) use reaction::reaction_of;

use super::actor::Actor;
use super::background::{Known, background_states};
use super::trajectory::{rest, to_trajectory};
use super::window::Cast;
use super::workers::Workers;
use crate::planning::STAYS_WITHIN_M;
use crate::planning::world::{AgentAtStart, World};
use crate::request::{React, Request};
use crate::tuning::Tuning;
use blocks::{Block, Corridor, closed};
use course::Course;
use scene::limits::Limits;
use scene::score::{SweptBoxes, overlap};
use scene::{AgentId, AgentType, HORIZON_STEPS, Size, Start, State, Vec2};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// Whose word a kept motion is. Two of one kind do not mind each other: how near they come is how it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keeps {
    /// The recording's.
    Log,
    /// An earlier answer's.
    Future,
}

/// Somebody who keeps its motion whatever the others do.
pub(super) struct Fixed {
    id: AgentId,
    pub(super) moving: Moving,
    keeps: Keeps,
}

/// Somebody who may give up its motion.
pub(super) struct Answerer {
    pub(super) id: AgentId,
    /// Index into the scene's agents.
    pub(super) index: usize,
    agent_type: AgentType,
    size: Size,
    limits: Limits,
    course: Course,
    corridor: Corridor,
    kept: Moving,
    keeps: Keeps,
    /// It gave up its motion in an earlier window: this is how it goes on.
    resumed: bool,
    /// Red lights on its way.
    lights: Vec<Block>,
    /// Where and when others are in its way by what they keep: first those that may answer, then the fixed ones.
    around: OnceLock<Vec<Vec<Block>>>,
}

/// All who are there in a window, or come in, and do not act in it.
pub(super) struct Answerers<'g> {
    all: Vec<Answerer>,
    pub(super) fixed: Vec<Fixed>,
    tuning: &'g Tuning,
    /// Scene step at which the window starts.
    start_step: usize,
}

impl<'g> Answerers<'g> {
    /// Nobody.
    pub(super) fn none(tuning: &'g Tuning) -> Self {
        Self { all: Vec::new(), fixed: Vec::new(), tuning, start_step: 0 }
    }

    /// Everybody but the actors.
    pub(super) fn of(
        world: &World<'_>,
        request: &Request,
        actors: &[Actor],
        cast: &Cast,
        tuning: &'g Tuning,
    ) -> Self {
        let acting: BTreeSet<usize> = actors.iter().map(|a| a.plan.present.index).collect();
        let mut out = Self { start_step: world.step, ..Self::none(tuning) };
        let mut order: Vec<usize> = (0..world.scene.agents.len()).filter(|i| !acting.contains(i)).collect();
        // The order of road users in the scene must not show.
        order.sort_by(|a, b| world.scene.agents[*a].id.cmp(&world.scene.agents[*b].id));
        for index in order {
            let agent = &world.scene.agents[index];
            let present = world.present.iter().find(|p| p.index == index);
            let resumed = cast.resumed.get(&index);
            let mut known: Vec<Option<State>> = match resumed {
                Some(states) => (0..=HORIZON_STEPS).map(|step| states.get(step).copied()).collect(),
                None => {
                    let known = Known::of(&world.scene, agent, world.step);
                    (0..=HORIZON_STEPS).map(|step| known.at(step)).collect()
                }
            };
            if let Some(present) = present {
                known[0] = Some(present.start);
            }
            let conditions = &world.conditions[index];
            let size = Size {
                length_m: conditions.length_m.unwrap_or(agent.size.length_m),
                width_m: conditions.width_m.unwrap_or(agent.size.width_m),
                ..agent.size
            };
            if known.iter().all(Option::is_none) {
                continue;
            }
            let boxes = known
                .iter()
                .map(|s| s.as_ref().map(|s| scene::geometry::obb::OrientedBox::of_state(s, &size)));
            let moving = Moving::new(boxes.collect());
            let generated = request.scene.generated.as_ref();
            let chosen = generated.and_then(|g| g.chosen_future(&agent.id));
            let pinned = request.pinned.contains_key(&agent.id);
            let made = chosen.is_some() || pinned || resumed.is_some();
            let keeps = if made { Keeps::Future } else { Keeps::Log };
            let agent_type = conditions.kind_of(agent);
            let may = (resumed.is_some() || cast.may_react.contains(&index))
                && agent_type != AgentType::Other
                && (conditions.start == Start::default() || keeps == Keeps::Future);
            // Who stands all the time stays; who gave up something goes on, and be it standing.
            let shortest_m = if resumed.is_some() { 0.0 } else { STAYS_WITHIN_M };
            let course = may.then(|| Course::of(&known, shortest_m)).flatten();
            let Some(course) = course else {
                out.fixed.push(Fixed { id: agent.id.clone(), moving, keeps });
                continue;
            };
            let corridor = Corridor::of(&course, &size);
            let lights = lights(world, agent_type, &corridor);
            out.all.push(Answerer {
                id: agent.id.clone(),
                index,
                agent_type,
                size,
                limits: Limits::of(agent_type, agent.subtype, size.length_m),
                course,
                corridor,
                kept: moving,
                keeps,
                resumed: resumed.is_some(),
                lights,
                around: OnceLock::new(),
            });
        }
        out
    }

    /// Everybody's kept motion.
    pub(super) fn movings(&self) -> impl Iterator<Item = &Moving> {
        self.all.iter().map(|a| &a.kept).chain(self.fixed.iter().map(|f| &f.moving))
    }

    /// Everybody's motion by name, those who gave up theirs with what they do instead.
    pub(super) fn movings_with(&self, answered: &[Answered]) -> Vec<(&AgentId, Cow<'_, Moving>)> {
        let of = |own: &'_ Answerer| answered.iter().find(|a| a.index == own.index && a.reaction.is_some());
        let all = self.all.iter().map(|own| match of(own) {
            Some(answer) => {
                // From the step after it is there first.
                let first = own.course.states.first().into_iter();
                let states = first.chain(&answer.states);
                (&own.id, Cow::Owned(Moving::of_states(answer.enters, states, &own.size)))
            }
            None => (&own.id, Cow::Borrowed(&own.kept)),
        });
        all.chain(self.fixed.iter().map(|f| (&f.id, Cow::Borrowed(&f.moving)))).collect()
    }

    /// Somebody who may answer would have to answer this.
    pub(super) fn are_met_by(&self, boxes: &SweptBoxes) -> bool {
        self.all.iter().any(|a| overlap(&a.kept.swept, boxes).close)
    }

    /// Two kept motions are as near as they were.
    fn mind(&self, a: Keeps, b: Keeps) -> bool {
        a != b
    }
}

/// When the lights of the lanes that a course follows are red, as something in its way.
fn lights(world: &World<'_>, agent_type: AgentType, corridor: &Corridor) -> Vec<Block> {
    if agent_type == AgentType::Pedestrian {
        return Vec::new();
    }
    let mut out = Vec::new();
    for signal in &world.scene.signals {
        let Some(lane) = world.graph.lane_index(&signal.lane) else { continue };
        let first = world.graph.lanes()[lane].path.first();
        let at = signal.stop.unwrap_or(first.position);
        let Some(line) = corridor.line(at, first.heading_rad) else { continue };
        out.extend(closed(line, |step| signal.at(world.step + step).is_stop()));
    }
    out
}

/// Those of `may_react` that were asked to go somewhere, or put somewhere, before: they plan anew like the actors,
/// and keep what they have unless something is in the way.
pub(super) fn reacting(
    world: &World<'_>,
    workers: &Workers,
    actors: &[Actor],
    may_react: &BTreeSet<usize>,
    react: &React,
    near_m: f64,
) -> Vec<Actor> {
    let asked = |who: &AgentAtStart| {
        let conditions = &world.conditions[who.index];
        !conditions.goal.is_free() || conditions.start != Start::default()
    };
    let candidates: Vec<_> =
        world.present.iter().filter(|p| may_react.contains(&p.index) && asked(p)).collect();
    if candidates.is_empty() {
        return Vec::new();
    }
    let paths: Vec<(Vec<Vec2>, f64)> =
        actors.iter().map(|a| (path(a), a.plan.present.size.length_m)).collect();
    let found = workers.map(&candidates, |who| {
        let kept = background_states(world, who);
        let named = matches!(react, React::Only(_));
        let parked = kept.iter().all(|s| (s.position() - who.start.position()).norm() < STAYS_WITHIN_M);
        let reach = |length: f64| near_m + 0.5 * (length + who.size.length_m);
        let near = paths.iter().any(|(path, length)| come_near(path, &kept, reach(*length)));
        let unmoved = world.conditions[who.index].start == Start::default();
        let leaves_it = !named && unmoved && (parked || !near);
        (!leaves_it).then(|| Actor::reacting(world, who, kept))
    });
    found.into_iter().flatten().collect()
}

/// Where an actor is about to go, one place a step.
fn path(actor: &Actor) -> Vec<Vec2> {
    let slot = actor.likeliest();
    let motion =
        if actor.rests { rest(&actor.plan) } else { to_trajectory(&actor.plan, slot, slot.of(&actor.modes)) };
    motion.states.iter().skip(1).map(|s| s.position).collect()
}

/// Two motions come within this of each other within three seconds. One state a step each.
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
        // Northwards through x = 60, there after so many steps.
        let north = |passes: f64| -> Vec<State> {
            (1..=90).map(|i| State { x_m: 60.0, y_m: i as f64 - passes, ..State::default() }).collect()
        };
        assert!(come_near(&east, &north(60.0), 5.0));
        assert!(come_near(&east, &north(45.0), 5.0));
        assert!(!come_near(&east, &north(15.0), 5.0));
    }
}
