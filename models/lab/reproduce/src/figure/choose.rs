//! Chooses scenes and road users that show the subjects of the figure.

use lab_eval::Site;
use lab_eval::measure::{can_be_followed, following, mean_distance_m};
use scene::{Agent, AgentType, HORIZON_STEPS, STANDING_MPS, Vec2, wrap_angle};

/// Subject of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Road users placed on an empty map.
    Creating,
    /// One end is moved, and the others react.
    Editing,
    /// A recording with motion that is physically impossible.
    Correcting,
    /// Case (a): a left turn at an intersection.
    Left,
    /// Case (b): a right turn.
    Right,
    /// Cases (c) and (d): a vehicle waits among pedestrians, and then gets a goal that makes it drive.
    Waiting,
}

impl Role {
    /// All roles, in the order of the page.
    pub const ALL: [Self; 6] =
        [Self::Creating, Self::Editing, Self::Correcting, Self::Left, Self::Right, Self::Waiting];

    /// Index in [`Role::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Prefix of its panels' ids.
    pub fn id(self) -> &'static str {
        match self {
            Self::Creating => "creating",
            Self::Editing => "editing",
            Self::Correcting => "correcting",
            Self::Left => "case-a",
            Self::Right => "case-b",
            Self::Waiting => "case-c",
        }
    }

    /// Name of the role, for messages about missing scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Creating => "creating",
            Self::Editing => "editing a vehicle's end",
            Self::Correcting => "correcting a recording that cannot have been driven",
            Self::Left => "case (a), a left turn among others",
            Self::Right => "case (b), a right turn among others",
            Self::Waiting => "cases (c) and (d), a vehicle that waits among pedestrians",
        }
    }
}

/// A road user of a scene that shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Role of the panel.
    pub role: Role,
    /// Index of the scene in the list.
    pub case: usize,
    /// Suitability; higher is better.
    pub score: f64,
    /// Index of the road user; `None` for [`Role::Creating`].
    pub who: Option<usize>,
}

/// Angles that count as a turn, degrees.
const TURN_DEG: std::ops::Range<f64> = 50.0..130.0;
/// Below this speed a recorded heading is noise, m/s.
const TURNING_MPS: f64 = 0.5;
/// Road users within this distance of another's path within 3 s take part in it, metres.
const NEAR_M: f64 = 4.0;
/// Pedestrians within this distance count for a waiting vehicle, metres.
const AROUND_M: f64 = 30.0;
/// A vehicle that moves by less than this waits, metres.
const WAITS_M: f64 = 1.0;

/// All that a scene can show.
pub fn found(case: usize, site: &Site<'_>) -> Vec<Found> {
    let mut out = Vec::new();
    let mut add = |role, score: f64, who| {
        if score > 0.0 {
            out.push(Found { role, case, score, who });
        }
    };
    let moving: Vec<Vec<Vec2>> = site.cases.iter().map(|c| way(site.log(c))).collect();
    add(Role::Creating, site.scene.map.lanes.len() as f64, None);
    for (place, case) in site.cases.iter().enumerate() {
        let log = site.log(case);
        if log.agent_type != AgentType::Vehicle || case.goal_step < HORIZON_STEPS {
            continue;
        }
        let others = moving.iter().enumerate().filter(|(i, _)| *i != place);
        let meets = others.filter(|(_, other)| near(&moving[place], other)).count() as f64;
        let followed = can_be_followed(log, case);
        let turn = turn_deg(log);
        let who = Some(case.agent);
        if followed && TURN_DEG.contains(&turn) {
            add(Role::Left, meets, who);
        }
        if followed && TURN_DEG.contains(&-turn) {
            add(Role::Right, meets, who);
        }
        if followed && turn.abs() < 20.0 && log.track.extent_m() > 30.0 {
            add(Role::Editing, meets, who);
        }
        if !followed {
            let motion = following(log, case.start);
            add(Role::Correcting, mean_distance_m(log, |step| motion[step].position), who);
        }
    }
    for (i, agent) in site.scene.agents.iter().enumerate() {
        if let Some(walkers) = waits(site, agent) {
            add(Role::Waiting, walkers as f64, Some(i));
        }
    }
    out
}

/// Positions at the half seconds; the first position in gaps of the log.
fn way(log: &Agent) -> Vec<Vec2> {
    let first = log.state_at(0).map_or(Vec2::zeros(), |s| s.position());
    (0..=HORIZON_STEPS).step_by(5).map(|s| log.state_at(s).map_or(first, |s| s.position())).collect()
}

fn near(a: &[Vec2], b: &[Vec2]) -> bool {
    let soon = |i: usize| b.iter().enumerate().filter(move |(j, _)| i.abs_diff(*j) <= 6);
    a.iter().enumerate().any(|(i, p)| soon(i).any(|(_, q)| (p - q).norm() < NEAR_M))
}

/// Angle of the turn to the left, degrees.
fn turn_deg(log: &Agent) -> f64 {
    let states: Vec<_> = (0..=HORIZON_STEPS).filter_map(|s| log.state_at(s)).collect();
    let moving: Vec<_> = states.iter().filter(|s| s.speed_mps() > TURNING_MPS).collect();
    moving.windows(2).map(|w| wrap_angle(w[1].heading_rad - w[0].heading_rad)).sum::<f64>().to_degrees()
}

/// Number of pedestrians and cyclists that move around a vehicle that waits on a lane for all of the 9 s.
fn waits(site: &Site<'_>, agent: &Agent) -> Option<usize> {
    let start = agent.state_at(0)?;
    agent.state_at(HORIZON_STEPS)?;
    let on_lane = || {
        let hits = site.graph.nearest_for(start.position(), 1.5, AgentType::Vehicle);
        hits.first().is_some_and(|hit| wrap_angle(hit.heading_rad - start.heading_rad).abs() < 0.3)
    };
    let stands = start.speed_mps() < STANDING_MPS && agent.track.extent_m() < WAITS_M;
    if agent.agent_type != AgentType::Vehicle || !stands || !on_lane() {
        return None;
    }
    let around = site.cases.iter().filter(|c| {
        c.agent_type != AgentType::Vehicle && (c.start.position() - start.position()).norm() < AROUND_M
    });
    Some(around.count())
}
