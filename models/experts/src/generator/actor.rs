//! Road users of one call: those that get new futures and those that keep what they have.

use super::choice::swept_kept;
use crate::features::agent::{Planned, plan, plan_with};
use crate::planning::anchors::{Anchor, PathKind};
use crate::planning::profile::Progress;
use crate::planning::world::{Present, World};
use crate::planning::{MODES, RESIDUAL};
use scene::geometry::direction;
use scene::motion::{Gear, Kind};
use scene::routes::Polyline;
use scene::score::SweptBoxes;
use scene::{Agent, AgentId, AgentType, HORIZON_STEPS, STANDING_MPS, STEP_S, Scene, State, Track, Vec2};

/// Why a road user gets new futures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// It was asked for.
    Regenerated,
    /// It answers one that was.
    Reacting,
}

/// A road user that gets new futures.
pub(super) struct Actor {
    pub(super) id: AgentId,
    pub(super) role: Role,
    pub(super) planned: Planned,
    /// What it would do if nothing changed; reacting road users keep it unless something is in the way.
    pub(super) kept: Option<Vec<State>>,
    /// The future that the user picked: it stays as it is.
    pub(super) pinned: Option<Vec<State>>,
    /// First drafts.
    pub(super) residual: [[f32; RESIDUAL]; MODES],
    /// By mode, summing to one.
    pub(super) probability: [f64; MODES],
    /// Stays where it is.
    pub(super) rests: bool,
    /// It was parked when the call began and has not been asked to go anywhere.
    pub(super) stays_parked: bool,
    pub(super) stays_probability: f64,
    /// A vehicle that starts within the road's edges.
    pub(super) keeps_to_the_road: bool,
}

impl Actor {
    /// A road user that was asked for, or one that answers without a motion of its own to keep.
    pub(super) fn regenerated(world: &World<'_>, who: &Present, role: Role) -> Self {
        Self::of(world, who, role, plan(world, who), None)
    }

    /// One that answers: its anchors are its own path at other paces.
    pub(super) fn reacting(world: &World<'_>, who: &Present, kept: Vec<State>) -> Self {
        let goal_free = world.conditions[who.index].goal.is_free();
        let planned = match own_path(who, &kept) {
            Some(anchors) if goal_free => plan_with(world, who, anchors),
            _ => plan(world, who),
        };
        Self::of(world, who, Role::Reacting, planned, Some(kept))
    }

    fn of(world: &World<'_>, who: &Present, role: Role, planned: Planned, kept: Option<Vec<State>>) -> Self {
        Self {
            id: world.agent(who).id.clone(),
            role,
            planned,
            kept,
            pinned: None,
            residual: [[0.0; RESIDUAL]; MODES],
            probability: [1.0 / MODES as f64; MODES],
            rests: false,
            stays_parked: false,
            stays_probability: 0.0,
            keeps_to_the_road: false,
        }
    }

    /// Goes on from a state that an earlier window reached: what rolls backwards does so until it stands.
    pub(super) fn goes_on(&mut self, parked: bool) {
        let planned = &mut self.planned;
        self.stays_parked = parked && planned.target.is_free();
        let start = &planned.present.start;
        let ahead_mps = start.velocity().dot(&direction(start.heading_rad));
        if planned.model.kind == Kind::Drive && ahead_mps < -1e-3 {
            planned.model = planned.model.in_gear(Gear::Reverse);
        }
    }

    /// Anchors are its own path: the networks' residuals, made for routes, do not apply.
    pub(super) fn keeps_its_path(&self) -> bool {
        self.kept.is_some() && self.planned.anchors.iter().all(|a| a.kind == PathKind::LeastEffort)
    }

    /// A vehicle that stands beside or off every lane: nothing but its driver can make it go.
    pub(super) fn is_parked(&self) -> bool {
        let off_lane = |anchor: &Anchor| anchor.route.as_ref().is_none_or(|r| r.lateral_m.abs() > 1.4);
        self.planned.present.agent_type == AgentType::Vehicle
            && self.planned.anchors.first().is_some_and(off_lane)
    }

    /// Most probable mode.
    pub(super) fn likeliest(&self) -> usize {
        let mut best = 0;
        for mode in 1..MODES {
            if self.probability[mode] > self.probability[best] {
                best = mode;
            }
        }
        best
    }
}

/// Shares of the kept speed that a reacting road user may fall back to.
const PACES: [f64; MODES] = [1.0, 0.75, 0.5, 0.25, 0.0, 1.2];

/// Anchors along the motion that is kept, at other paces; `None` for one that hardly moves.
fn own_path(who: &Present, kept: &[State]) -> Option<Vec<Anchor>> {
    let mut points = vec![who.start.position()];
    points.extend(kept.iter().map(State::position));
    let path = Polyline::new(points);
    if path.length_m() < 2.0 {
        return None;
    }
    let last = kept.last()?;
    let tail = last.position() + direction(last.heading_rad) * 40.0;
    let mut points = path.points().to_vec();
    points.push(tail);
    let path = Polyline::new(points).resample(1.0);
    let speeds: Vec<f64> =
        (0..HORIZON_STEPS).map(|i| kept.get(i).map_or(last.speed_mps(), State::speed_mps)).collect();
    let anchors = PACES.iter().enumerate().map(|(timing, pace)| Anchor {
        base: at_pace(who.start.speed_mps(), &speeds, *pace),
        caps_mps: vec![60.0; path.points().len()],
        path: path.clone(),
        kind: PathKind::LeastEffort,
        route: None,
        identity: 100 + timing as u64,
        timing: (timing, MODES),
    });
    Some(anchors.collect())
}

/// Progress at a share of the kept speeds, slowing by at most 3.5 m/s2 and speeding up by 1.5.
fn at_pace(v0: f64, speeds: &[f64], pace: f64) -> Progress {
    let mut out = [0.0; HORIZON_STEPS + 1];
    let mut speed = v0;
    for i in 0..HORIZON_STEPS {
        let wanted = if pace == 1.0 { speeds[i] } else { (pace * speeds[i]).max(0.0) };
        let next = if pace == 1.0 {
            wanted
        } else {
            wanted.clamp(speed - 3.5 * STEP_S, speed + 1.5 * STEP_S).max(0.0)
        };
        out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
        speed = next;
    }
    out
}

/// Where a road user that keeps its motion is at a step of the window (0 is the start): its chosen
/// future, else its log; one that was only drawn goes straight on.
pub(super) fn kept_state(scene: &Scene, agent: &Agent, start_step: usize, step: usize) -> Option<State> {
    let at = start_step + step;
    if let Some(generated) = scene.generated.as_ref()
        && let Some(future) = generated.chosen_future(&agent.id)
        && let Some(state) = at.checked_sub(future.first_step).and_then(|i| future.states.get(i))
    {
        return Some(*state);
    }
    if let Some(state) = agent.state_at(at) {
        return Some(state);
    }
    let mut known = agent.track.valid_steps();
    let (Some(first), None) = (known.next(), known.next()) else { return None };
    let state = agent.state_at(first)?;
    let moved = state.position() + state.velocity() * (at.saturating_sub(first) as f64 * STEP_S);
    Some(State { x_m: moved.x, y_m: moved.y, ..state })
}

/// From where on nothing is known of a road user that keeps its motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Guessed {
    /// First scene step of which neither future nor log speaks.
    pub(super) step: usize,
    /// It goes straight on; otherwise it stands where it was.
    pub(super) moving: bool,
}

/// A road user's track as those who plan up to scene step `last` see it, kept as it is: its chosen
/// future after `start`, else its log, and where neither says more, straight on from where it was last
/// seen. Also the first step of which nothing is known, where that comes before `last`.
pub(super) fn carried(
    scene: &Scene,
    agent: &Agent,
    pinned: Option<&[State]>,
    start: usize,
    last: usize,
) -> (Track, Option<Guessed>) {
    let chosen = scene.generated.as_ref().and_then(|g| g.chosen_future(&agent.id));
    let future = pinned.map(|p| (start + 1, p)).or(chosen.map(|f| (f.first_step, &*f.states)));
    let at_step = |at: usize| match future {
        Some((first, states)) if at > start && at >= first => states.get(at - first).copied(),
        _ => agent.track.at(at).copied(),
    };
    let logged = agent.track.last_valid_step().map_or(0, |l| l + 1);
    let ends = future.map_or(logged, |(first, states)| first + states.len());
    let first_step = agent.track.first_step.min(start);
    let mut seen: Option<(usize, State)> = None;
    let mut guessed: Option<Guessed> = None;
    let states = (first_step..=last.max(first_step)).map(|at| {
        if let Some(state) = at_step(at) {
            seen = Some((at, state));
            return Some(state);
        }
        let (since, state) = seen.filter(|_| at > start)?;
        let moving = state.speed_mps() >= STANDING_MPS;
        if at >= ends {
            guessed = guessed.or(Some(Guessed { step: at, moving }));
        }
        if !moving {
            return Some(State { vx_mps: 0.0, vy_mps: 0.0, ..state });
        }
        let moved = state.position() + state.velocity() * ((at - since) as f64 * STEP_S);
        Some(State { x_m: moved.x, y_m: moved.y, ..state })
    });
    let states = states.collect();
    (Track { first_step, states, z_m: None }, guessed)
}

/// States of a kept motion over the window, one a step from the first after the start, as far as known.
pub(super) fn kept_states(scene: &Scene, agent: &Agent, start_step: usize) -> Vec<State> {
    (1..=HORIZON_STEPS).map_while(|step| kept_state(scene, agent, start_step, step)).collect()
}

/// Boxes of a kept road user.
pub(super) fn kept_boxes(world: &World<'_>, who: &Present) -> SweptBoxes {
    let agent = world.agent(who);
    swept_kept(|step| kept_state(world.scene, agent, world.step, step), &who.size)
}

/// Two motions come within 5 m of each other within 3 s (`model.md` section 6). One state a step each.
pub(super) fn come_near(a: &[Vec2], b: &[State], reach_m: f64) -> bool {
    (4..a.len()).step_by(5).any(|i| {
        let from = i.saturating_sub(30);
        let to = (i + 30).min(b.len());
        (from..to).step_by(5).any(|j| (a[i] - b[j].position()).norm() < reach_m)
    })
}
