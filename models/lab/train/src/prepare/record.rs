//! One road user's record: features only from the start, targets from the recording.

use crate::polylines::Polylines;
use crate::training::{AnchorPath, BOXES, LoggedBox, PATH_POINTS, Record};
use experts::features::GroundTruth;
use experts::features::agent::{AgentPlan, plan};
use experts::planning::anchors::Anchor;
use experts::planning::world::{AgentAtStart, World};
use experts::planning::{INSTANTS, MODES, STAYS_WITHIN_M};
use scene::geometry::{direction, rotate};
use scene::{Agent, HORIZON_STEPS};

/// Steps between two instants.
const PER_INSTANT: usize = HORIZON_STEPS / INSTANTS;

/// `None` if the road user is absent at the start.
pub(super) fn record(world: &World<'_>, polylines: &Polylines, index: usize) -> Option<Record> {
    let who = world.present.iter().find(|p| p.index == index)?;
    let planned = plan(world, who);
    let agent = world.agent(who);
    let target = target(&planned, agent, world.step);
    let turned = agent
        .state_at(HORIZON_STEPS)
        .map_or(0.0, |s| scene::wrap_angle(s.heading_rad - who.start.heading_rad).abs());
    let first = world.present.first().map_or(who.start, |p| p.start);
    let (away, ahead) = (who.start.position() - first.position(), direction(who.start.heading_rad));
    Some(Record {
        number: who.index as u32,
        place: [away.x, away.y, ahead.x, ahead.y].map(|v| v as f32),
        boxes: boxes(world, who, agent),
        half: [0.5 * who.size.length_m as f32, 0.5 * who.size.width_m as f32],
        centre_ahead: 0.0,
        paths: Box::new(std::array::from_fn(|i| path(&planned.anchors[i], who))),
        weight: if turned > 0.35 { 2.0 } else { 1.0 },
        agent: planned.features,
        pieces: polylines.seen(world, who),
        target,
    })
}

fn target(planned: &AgentPlan, agent: &Agent, start_step: usize) -> GroundTruth {
    let mut out = GroundTruth {
        base_along: [[0.0; INSTANTS]; MODES],
        along: [[0.0; INSTANTS]; MODES],
        across: [[0.0; INSTANTS]; MODES],
        valid: [0.0; INSTANTS],
        stays: f32::from(u8::from(stays(agent, start_step))),
    };
    for (mode, anchor) in planned.anchors.iter().enumerate() {
        let mut near = 0.0;
        for i in 0..INSTANTS {
            let step = (i + 1) * PER_INSTANT;
            out.base_along[mode][i] = anchor.base_at(step) as f32;
            let Some(state) = agent.state_at(start_step + step) else { continue };
            let (along, across) = anchor.coordinates(state.position(), near);
            near = along;
            out.along[mode][i] = along as f32;
            out.across[mode][i] = across as f32;
            out.valid[i] = 1.0;
        }
    }
    out
}

/// Keeps its place for the whole window.
fn stays(agent: &Agent, start_step: usize) -> bool {
    let Some(start) = agent.state_at(start_step) else { return false };
    let steps = agent.track.valid_steps().filter(|s| *s > start_step);
    let far = |s: usize| agent.state_at(s).map_or(0.0, |q| (q.position() - start.position()).norm());
    steps.map(far).fold(0.0, f64::max) < STAYS_WITHIN_M
}

/// The path, one point per metre, in the road user's frame.
fn path(anchor: &Anchor, who: &AgentAtStart) -> AnchorPath {
    let count = (anchor.path.length_m().ceil() as usize + 8).clamp(2, PATH_POINTS);
    let local = |i: usize| {
        let p = anchor.path.extrapolate(i as f64).position - who.start.position();
        let p = rotate(p, -who.start.heading_rad);
        [p.x as f32, p.y as f32]
    };
    AnchorPath { start: 0.0, points: (0..count).map(local).collect() }
}

/// Recorded boxes of the road users that come nearest.
fn boxes(world: &World<'_>, who: &AgentAtStart, agent: &Agent) -> Vec<LoggedBox> {
    let instants = || (1..=INSTANTS).map(|i| world.step + i * PER_INSTANT);
    let mut order: Vec<(f64, &AgentAtStart)> = world
        .present
        .iter()
        .filter(|p| p.index != who.index)
        .filter_map(|p| {
            let other = world.agent(p);
            let gaps = instants()
                .filter_map(|s| Some((other.state_at(s)?.position() - agent.state_at(s)?.position()).norm()));
            let nearest = gaps.fold(f64::INFINITY, f64::min) - 0.5 * p.size.length_m;
            (nearest < 25.0).then_some((nearest, p))
        })
        .collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.index.cmp(&b.1.index)));
    order.truncate(BOXES);
    let logged = |p: &AgentAtStart| {
        let mut poses = [[0.0; 4]; INSTANTS];
        for (pose, step) in poses.iter_mut().zip(instants()) {
            if let Some(state) = world.agent(p).state_at(step) {
                let local = rotate(state.position() - who.start.position(), -who.start.heading_rad);
                let ahead = direction(state.heading_rad - who.start.heading_rad);
                *pose = [local.x as f32, local.y as f32, ahead.x as f32, ahead.y as f32];
            }
        }
        let half = [0.5 * p.size.length_m as f32, 0.5 * p.size.width_m as f32];
        LoggedBox { poses, half, number: p.index as u32 }
    };
    order.into_iter().map(|(_, p)| logged(p)).collect()
}
