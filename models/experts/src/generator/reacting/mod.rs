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
use crate::planning::lights::StopLine;
use crate::planning::world::{AgentAtStart, World};
use crate::request::{React, Request};
use crate::tuning::Tuning;
use blocks::{Block, Corridor, closed};
use course::Course;
use scene::geometry::obb::OrientedBox;
use scene::limits::Limits;
use scene::routes::LaneGraph;
use scene::score::{SweptBoxes, overlap};
use scene::{AgentId, AgentType, HORIZON_STEPS, Size, Start, State, Vec2};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

/// So many road users are looked at by several threads.
const MANY: usize = 96;

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
    kept: Moving,
    keeps: Keeps,
    /// It gave up its motion in an earlier window: this is how it goes on.
    resumed: bool,
    /// Worked out when somebody is in its way: few are met.
    road: OnceLock<Road>,
    /// Where and when others are in its way by what they keep: first those that may answer, then the fixed ones.
    around: OnceLock<Vec<Vec<Block>>>,
}

/// What somebody follows its course through.
struct Road {
    /// Its course, and how the road goes on from there.
    course: Course,
    corridor: Corridor,
    /// Red lights on its way.
    lights: Vec<Block>,
}

/// All who are there in a window, or come in, and do not act in it.
pub(super) struct Answerers<'g> {
    all: Vec<Answerer>,
    pub(super) fixed: Vec<Fixed>,
    stop_lines: Vec<StopLine>,
    graph: Option<Arc<LaneGraph>>,
    tuning: &'g Tuning,
    /// Scene step at which the window starts.
    start_step: usize,
}

/// One who does not act.
enum Role {
    Answers(Box<Answerer>),
    Stays(Fixed),
}

impl<'g> Answerers<'g> {
    /// Nobody.
    pub(super) fn none(tuning: &'g Tuning) -> Self {
        let (all, fixed, stop_lines) = (Vec::new(), Vec::new(), Vec::new());
        Self { all, fixed, stop_lines, graph: None, tuning, start_step: 0 }
    }

    /// Everybody but the actors.
    pub(super) fn of(
        world: &World<'_>,
        workers: &Workers,
        request: &Request,
        actors: &[Actor],
        cast: &Cast,
        tuning: &'g Tuning,
    ) -> Self {
        let acting: BTreeSet<usize> = actors.iter().map(|a| a.plan.present.index).collect();
        let mut order: Vec<usize> = (0..world.scene.agents.len()).filter(|i| !acting.contains(i)).collect();
        // The order of road users in the scene must not show.
        order.sort_by(|a, b| world.scene.agents[*a].id.cmp(&world.scene.agents[*b].id));
        let roles = workers.map_many(MANY, &order, |&index| role(world, request, cast, index));
        let stop_lines = world.stop_lines.clone();
        let graph = Some(Arc::clone(&world.graph));
        let mut out = Self { start_step: world.step, stop_lines, graph, ..Self::none(tuning) };
        for role in roles.into_iter().flatten() {
            match role {
                Role::Answers(own) => out.all.push(*own),
                Role::Stays(own) => out.fixed.push(own),
            }
        }
        out
    }

    /// What one of those who may answer follows its course through.
    fn road(&self, who: usize) -> &Road {
        let own = &self.all[who];
        own.road.get_or_init(|| {
            let course = match &self.graph {
                Some(graph) if !own.course.leaves() => own.course.clone().led_on(graph, own.agent_type),
                _ => own.course.clone(),
            };
            let corridor = Corridor::of(&course, &own.size);
            let on_foot = own.agent_type == AgentType::Pedestrian;
            let lines = self.stop_lines.iter().filter(|_| !on_foot);
            let red = lines.filter_map(|line| {
                let at_m = corridor.line(line.at())?;
                Some(closed(at_m, |step| line.red() >> step & 1 == 1))
            });
            let lights = red.flatten().collect();
            Road { course, corridor, lights }
        })
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

/// What somebody who does not act does in a window; `None` for one that is nowhere in it.
fn role(world: &World<'_>, request: &Request, cast: &Cast, index: usize) -> Option<Role> {
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
    if known.iter().all(Option::is_none) {
        return None;
    }
    let conditions = &world.conditions[index];
    let size = conditions.size_of(agent.size);
    let boxes = known.iter().map(|s| s.as_ref().map(|s| OrientedBox::of_state(s, &size)));
    let moving = Moving::new(boxes.collect());
    let chosen = request.scene.generated.as_ref().and_then(|g| g.chosen_future(&agent.id));
    let made = chosen.is_some() || request.pinned.contains_key(&agent.id) || resumed.is_some();
    let keeps = if made { Keeps::Future } else { Keeps::Log };
    let agent_type = conditions.kind_of(agent);
    let may = (resumed.is_some() || cast.may_react.contains(&index))
        && agent_type != AgentType::Other
        && (conditions.start == Start::default() || keeps == Keeps::Future);
    // Who stands all the time stays; who gave up something goes on, and be it standing.
    let shortest_m = if resumed.is_some() { 0.0 } else { STAYS_WITHIN_M };
    let Some(course) = may.then(|| Course::of(&known, shortest_m)).flatten() else {
        return Some(Role::Stays(Fixed { id: agent.id.clone(), moving, keeps }));
    };
    Some(Role::Answers(Box::new(Answerer {
        id: agent.id.clone(),
        index,
        agent_type,
        size,
        limits: Limits::of(agent_type, agent.subtype, size.length_m),
        course,
        kept: moving,
        keeps,
        resumed: resumed.is_some(),
        road: OnceLock::new(),
        around: OnceLock::new(),
    })))
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
        !conditions.goal.is_free() || !conditions.via.is_empty() || conditions.start != Start::default()
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
