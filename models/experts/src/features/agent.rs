//! A road user ready for its expert: its anchors, its target, and the inputs of the networks.

use super::AgentFeatures;
use super::ahead::PathFacts;
use super::encode::{self, AgentFrame};
use super::tables::ANCHOR;
use super::tangent::tangent;
use crate::planning::anchors::{Anchor, anchors};
use crate::planning::crossing::{Kerb, kerb};
use crate::planning::lights::{Gate, gates, sets_off};
use crate::planning::world::{AgentAtStart, Waypoint, World};
use crate::planning::{INSTANT_S, INSTANTS, MODES};
use scene::geometry::obb::OrientedBox;
use scene::motion::{MotionKind, MotionModel, Target};
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{AgentType, STANDING_MPS, STEP_S, Vec2, wrap_angle};
use std::sync::Arc;

/// Distance beyond the road's edge within which a corner still counts as on the road, metres.
pub const BEYOND_M: f64 = 0.1;

/// A road user ready for its expert.
#[derive(Clone, Debug)]
pub struct AgentPlan {
    /// The agent and its state at the start.
    pub present: AgentAtStart,
    /// Its motion model.
    pub model: MotionModel,
    /// The goal to meet.
    pub target: Target,
    /// The via points that it must pass in this window.
    pub vias: Vec<Waypoint>,
    /// Its [`MODES`] anchors.
    pub anchors: Vec<Anchor>,
    /// Red signals on each anchor's path.
    pub lights: [Vec<Gate>; MODES],
    /// Kerb on each anchor's path, where a walker steps onto the lanes.
    pub kerbs: [Option<Kerb>; MODES],
    /// Lane heading at the goal for each anchor, if the goal lies on a lane and leaves its heading free,
    /// radians.
    pub lane_headings: [Option<f64>; MODES],
    /// Acceleration with which a standing agent sets off towards a goal, m/s2.
    pub easy_mps2: f64,
    /// Step of the window up to which an agent at rest waits for the one ahead of it to move off.
    pub departs: usize,
    /// Factor of the learned offsets at each instant; it decays after a goal.
    pub aside_share: [f64; INSTANTS],
    /// Ground on which it may drive: [`World::ground`].
    pub drivable: Arc<Drivable>,
    /// As [`AgentPlan::drivable`]; `None` unless the map bounds its roads and the agent is a vehicle that starts on
    /// them.
    pub ground: Option<Arc<Drivable>>,
    /// Inputs of the networks.
    pub features: AgentFeatures,
    /// Whether motions are projected onto the goal: see
    /// [`Planning::projection`](crate::planning::world::Planning).
    pub projected: bool,
}

/// Computes anchors and features of one road user.
pub fn plan(world: &World<'_>, who: &AgentAtStart) -> AgentPlan {
    let anchors = anchors(world, who, &world.model(who), &world.target(who));
    plan_with(world, who, anchors)
}

/// Features of a road user with the given [`MODES`] anchors.
pub fn plan_with(world: &World<'_>, who: &AgentAtStart, anchors: Vec<Anchor>) -> AgentPlan {
    let model = world.model(who);
    let target = world.target(who);
    let frame = AgentFrame::of(who);
    let mut encoded = Box::new([[0.0; ANCHOR]; MODES]);
    let obstacles = world.obstacles(who.index);
    let mut lights: [Vec<Gate>; MODES] = Default::default();
    let mut kerbs: [Option<Kerb>; MODES] = Default::default();
    let mut last: Option<(u64, PathFacts)> = None;
    for (slot, anchor) in anchors.iter().enumerate() {
        let path_identity = anchor.path_identity();
        // Slots of one path share the facts about the path.
        let facts = match last.take() {
            Some((identity, facts)) if identity == path_identity => {
                lights[slot] = lights[slot - 1].clone();
                kerbs[slot] = kerbs[slot - 1].clone();
                facts
            }
            _ => {
                lights[slot] = gates(world, who, &anchor.path);
                kerbs[slot] = kerb(world, who, &anchor.path);
                PathFacts::of(world, who, anchor, &obstacles)
            }
        };
        encoded[slot] = encode::anchor(&frame, anchor, &facts, slot);
        last = Some((path_identity, facts));
    }
    let lane_headings = lane_headings(world, who, &target, &anchors);
    let features = AgentFeatures {
        own: encode::own(world, who, &model, &target, &frame),
        neighbours: encode::neighbours(world, who, &frame),
        anchors: encoded,
        // The learned offsets must also keep the end aligned with the lane.
        tangent: Box::new(tangent(&Target {
            heading_rad: target.heading_rad.or(lane_headings[0]),
            ..target
        })),
    };
    let projected = world.planning.projection;
    let easy_mps2 = world.tuning.anchors.setting_off_mps2;
    let present = who.clone();
    let drivable = world.ground(who);
    let ground = ground(&drivable, who);
    AgentPlan {
        present,
        model,
        target,
        vias: world.waypoints(who),
        anchors,
        lights,
        kerbs,
        lane_headings,
        easy_mps2,
        departs: 0,
        aside_share: aside_share(&model, &target, world.tuning.anchors.after_goal_s),
        drivable,
        ground,
        features,
        projected,
    }
}

impl AgentPlan {
    /// Whether a place is farther than `off_lanes_m` from every lane that the agent may use. Beyond the ends
    /// of the map's roads no place is, because lanes there are unknown.
    pub fn is_off_lanes(&self, graph: &LaneGraph, place: Vec2, off_lanes_m: f64) -> bool {
        !graph.has_lane_for(place, off_lanes_m, self.present.agent_type)
            && !self.drivable.is_beside_allowed(place)
            && !self.drivable.is_beyond_map(place)
    }

    /// Whether the agent has neither a goal nor a via point.
    pub fn is_free(&self) -> bool {
        self.target.is_free() && self.vias.is_empty()
    }

    /// Whether the agent stands at a red signal that is known to turn green, and has neither a goal nor a via
    /// point.
    pub fn sets_off(&self) -> bool {
        self.is_free()
            && self.model.start_speed_mps() < STANDING_MPS
            && self.lights.iter().any(|gates| sets_off(gates))
    }
}

/// Factor of the learned offsets at each instant, see [`AgentPlan::aside_share`]. For wheeled agents it
/// decays by a factor of e every `fading_s` seconds after a goal with a position. Walkers follow no lane, so
/// theirs stays 1.
fn aside_share(model: &MotionModel, target: &Target, fading_s: f64) -> [f64; INSTANTS] {
    let fades = model.kind == MotionKind::Drive && target.position.is_some();
    std::array::from_fn(|i| {
        let past_s = (i + 1) as f64 * INSTANT_S - target.step as f64 * STEP_S;
        if fades && past_s > 0.0 { (-past_s / fading_s).exp() } else { 1.0 }
    })
}

fn ground(ground: &Arc<Drivable>, who: &AgentAtStart) -> Option<Arc<Drivable>> {
    let outline = OrientedBox::of_state(&who.start, &who.size);
    let starts_there = ground.box_outside_m(&outline).is_some_and(|outside_m| outside_m <= BEYOND_M);
    (who.agent_type == AgentType::Vehicle && ground.is_bounded() && starts_there).then(|| ground.clone())
}

/// See [`AgentPlan::lane_headings`].
fn lane_headings(
    world: &World<'_>,
    who: &AgentAtStart,
    target: &Target,
    anchors: &[Anchor],
) -> [Option<f64>; MODES] {
    // Riders enter and leave lanes freely.
    let (Some(goal), None, AgentType::Vehicle) = (target.position, target.heading_rad, who.agent_type) else {
        return [None; MODES];
    };
    let under = lanes_under(world, who, goal);
    std::array::from_fn(|slot| {
        let path = &anchors.get(slot)?.path;
        let arriving_rad = path.sample(path.project(goal).s_m).heading_rad;
        let turn = |heading_rad: &f64| wrap_angle(heading_rad - arriving_rad).abs();
        let nearest = under.iter().copied().min_by(|a, b| turn(a).total_cmp(&turn(b)))?;
        (turn(&nearest) < world.tuning.anchors.along_lane_rad).then_some(nearest)
    })
}

/// Headings of the lanes that contain a place.
fn lanes_under(world: &World<'_>, who: &AgentAtStart, place: Vec2) -> Vec<f64> {
    let lanes = world.graph.lanes();
    let near = world.graph.nearest_for(place, 4.0, who.agent_type);
    near.iter().filter(|h| h.distance_m <= 0.5 * lanes[h.lane].width_m).map(|h| h.heading_rad).collect()
}
