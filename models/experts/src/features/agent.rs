//! A road user ready for its expert: its anchors, its target, and what the networks see of it.

use super::AgentFeatures;
use super::ahead::PathFacts;
use super::encode::{self, Frame};
use super::tables::ANCHOR;
use super::tangent::tangent;
use crate::planning::MODES;
use crate::planning::anchors::{Anchor, anchors};
use crate::planning::world::{AgentAtStart, World};
use scene::motion::{MotionModel, Target};

/// A road user ready for its expert.
#[derive(Clone, Debug)]
pub struct AgentPlan {
    /// Who and where.
    pub present: AgentAtStart,
    /// How it can move.
    pub model: MotionModel,
    /// What it must meet.
    pub target: Target,
    /// [`MODES`] of them.
    pub anchors: Vec<Anchor>,
    /// For the networks.
    pub features: AgentFeatures,
    /// Motions are projected onto the goal: see [`Planning::projection`](crate::planning::world::Planning).
    pub projected: bool,
}

/// Works out anchors and features of one road user.
pub fn plan(world: &World<'_>, who: &AgentAtStart) -> AgentPlan {
    let anchors = anchors(world, who, &world.model(who), &world.target(who));
    plan_with(world, who, anchors)
}

/// Features of a road user with given anchors, [`MODES`] of them.
pub fn plan_with(world: &World<'_>, who: &AgentAtStart, anchors: Vec<Anchor>) -> AgentPlan {
    let model = world.model(who);
    let target = world.target(who);
    let frame = Frame::of(who);
    let mut encoded = Box::new([[0.0; ANCHOR]; MODES]);
    let obstacles = world.obstacles(who.index);
    let mut last: Option<(u64, PathFacts)> = None;
    for (slot, anchor) in anchors.iter().enumerate() {
        let path_identity = anchor.path_identity();
        // Slots of one path share what can be said of the path.
        let facts = match last.take() {
            Some((identity, facts)) if identity == path_identity => facts,
            _ => PathFacts::of(world, who, anchor, &obstacles),
        };
        encoded[slot] = encode::anchor(&frame, anchor, &facts, slot);
        last = Some((path_identity, facts));
    }
    let features = AgentFeatures {
        own: encode::own(world, who, &model, &target, &frame),
        neighbours: encode::neighbours(world, who, &frame),
        anchors: encoded,
        tangent: Box::new(tangent(&target)),
    };
    let projected = world.planning.projection;
    AgentPlan { present: who.clone(), model, target, anchors, features, projected }
}
