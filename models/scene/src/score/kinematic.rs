//! Acceleration, braking and turning of a motion, by central differences over two steps.

use super::input::{Actor, ScoreInput};
use super::report::{Stretch, maximum, stretches};
use crate::geometry::cross;
use crate::limits::Limits;
use crate::{AgentType, STEP_S, State, Subtype, wrap_angle};
use schemars::JsonSchema;
use serde::Serialize;
use std::ops::Range;

/// Speed below which curvature (yaw rate over speed) is undefined, m/s.
const LEAST_CURVE_MPS: f64 = 1.0;
/// Speed below which a walker's direction is undefined, m/s.
const LEAST_WALK_MPS: f64 = 0.3;

/// Number of steps before and after a moment over which harshness is measured.
pub const HARSH_STEPS: usize = 2;

/// Limits of plausible motion in scores. They are wider than [`Limits`], which generated motion keeps,
/// because differences of rounded positions and foreign motion are noisier. `None`: not scored for this type.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct KinematicLimits {
    /// Acceleration, m/s2.
    pub accel_mps2: f64,
    /// Braking, m/s2, positive.
    pub brake_mps2: f64,
    /// Sideways, m/s2.
    pub lateral_mps2: f64,
    /// Turning, rad/s.
    pub yaw_rate_radps: Option<f64>,
    /// Change of the longitudinal acceleration, m/s3.
    pub jerk_mps3: Option<f64>,
    /// Curvature of the path, 1/m.
    pub curvature_per_m: Option<f64>,
}

impl KinematicLimits {
    /// Vehicles: wider than what motion keeps (curvature wider where the kind turns tighter).
    /// Cyclists and pedestrians: the hard limits by the same factors.
    pub fn of(agent_type: AgentType, subtype: Subtype, length_m: f64) -> Self {
        let hard = Limits::of(agent_type, subtype, length_m);
        match agent_type {
            AgentType::Pedestrian => Self {
                accel_mps2: 3.0,
                brake_mps2: 3.0,
                lateral_mps2: 3.0,
                yaw_rate_radps: None,
                jerk_mps3: None,
                curvature_per_m: None,
            },
            AgentType::Cyclist => Self {
                accel_mps2: 1.5 * hard.accel_mps2,
                brake_mps2: 1.125 * hard.brake_mps2,
                lateral_mps2: 1.2 * hard.lateral_mps2,
                yaw_rate_radps: Some(2.0),
                jerk_mps3: Some(15.0),
                curvature_per_m: Some(1.2 * hard.curvature_per_m),
            },
            _ => Self {
                accel_mps2: 6.0,
                brake_mps2: 9.0,
                lateral_mps2: 7.0,
                yaw_rate_radps: Some(1.5),
                jerk_mps3: Some(15.0),
                curvature_per_m: Some((1.2 * hard.curvature_per_m).max(0.3)),
            },
        }
    }
}

/// Greatest values of a motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Kinematic {
    /// Greatest speed, m/s.
    pub speed_mps: f64,
    /// Greatest acceleration, m/s2.
    pub accel_mps2: f64,
    /// Greatest braking, m/s2, positive.
    pub brake_mps2: f64,
    /// Greatest sideways acceleration, m/s2.
    pub lateral_mps2: f64,
    /// Greatest yaw rate, rad/s; none for pedestrians.
    pub yaw_rate_radps: Option<f64>,
    /// Greatest jerk along the path, m/s3; none for pedestrians.
    pub jerk_mps3: Option<f64>,
    /// Greatest curvature above 1 m/s, 1/m; none for pedestrians.
    pub curvature_per_m: Option<f64>,
    /// Number of steps with at least one value over its limit ([`KinematicLimits`]).
    pub violations: usize,
}

impl Kinematic {
    /// Greatest of each value over all, and the sum of violations; `None` without any.
    pub fn over_all<'a>(all: impl Iterator<Item = &'a Self>) -> Option<Self> {
        let optional = |a: Option<f64>, b: Option<f64>| maximum([a, b].into_iter());
        all.copied().reduce(|a, b| Self {
            speed_mps: a.speed_mps.max(b.speed_mps),
            accel_mps2: a.accel_mps2.max(b.accel_mps2),
            brake_mps2: a.brake_mps2.max(b.brake_mps2),
            lateral_mps2: a.lateral_mps2.max(b.lateral_mps2),
            yaw_rate_radps: optional(a.yaw_rate_radps, b.yaw_rate_radps),
            jerk_mps3: optional(a.jerk_mps3, b.jerk_mps3),
            curvature_per_m: optional(a.curvature_per_m, b.curvature_per_m),
            violations: a.violations + b.violations,
        })
    }
}

/// Values at one step, all absolute except `along`.
#[derive(Clone, Copy, Debug, Default)]
struct KinematicValues {
    along: f64,
    lateral: f64,
    yaw_rate: Option<f64>,
    curvature: Option<f64>,
}

/// Greatest values over `steps`, and the stretches of implausible turns (over a limit of lateral
/// acceleration, yaw rate or curvature; `worst` is the share of the limit).
pub fn score_kinematic(actor: &Actor<'_>, steps: Range<usize>) -> (Kinematic, Vec<Stretch>) {
    let limits = KinematicLimits::of(actor.agent_type, actor.subtype, actor.size.length_m);
    let walks = actor.agent_type == AgentType::Pedestrian;
    let states: Vec<Option<&State>> = steps.clone().map(|i| actor.state(i)).collect();
    let moments: Vec<Option<KinematicValues>> =
        (0..states.len()).map(|i| moment(&states, i, walks)).collect();
    let mut found = Kinematic {
        speed_mps: states.iter().flatten().map(|s| s.speed_mps()).fold(0.0, f64::max),
        ..Kinematic::default()
    };
    let mut turns = Vec::new();
    for (i, m) in moments.iter().enumerate().filter_map(|(i, m)| Some((i, m.as_ref()?))) {
        let jerk = if walks { None } else { jerk(&moments, i) };
        found.accel_mps2 = found.accel_mps2.max(m.along);
        found.brake_mps2 = found.brake_mps2.max(-m.along);
        found.lateral_mps2 = found.lateral_mps2.max(m.lateral);
        found.yaw_rate_radps = maximum([found.yaw_rate_radps, m.yaw_rate].into_iter());
        found.curvature_per_m = maximum([found.curvature_per_m, m.curvature].into_iter());
        found.jerk_mps3 = maximum([found.jerk_mps3, jerk].into_iter());
        let part = |value: Option<f64>, limit: Option<f64>| value.zip(limit).map_or(0.0, |(v, l)| v / l);
        let turn = (m.lateral / limits.lateral_mps2)
            .max(part(m.yaw_rate, limits.yaw_rate_radps))
            .max(part(m.curvature, limits.curvature_per_m));
        let along = (m.along / limits.accel_mps2).max(-m.along / limits.brake_mps2);
        if turn > 1.0 {
            turns.push((steps.start + i, turn));
        }
        found.violations += usize::from(turn.max(along).max(part(jerk, limits.jerk_mps3)) > 1.0);
    }
    (found, stretches(actor, &turns))
}

fn moment(states: &[Option<&State>], i: usize, walks: bool) -> Option<KinematicValues> {
    let (before, here, after) = ((*states.get(i.checked_sub(1)?)?)?, states[i]?, (*states.get(i + 1)?)?);
    let span = 2.0 * STEP_S;
    if walks {
        let a = (after.velocity() - before.velocity()) / span;
        let speed = here.speed_mps();
        let (along, lateral) = if speed > LEAST_WALK_MPS {
            let u = here.velocity() / speed;
            (a.dot(&u), cross(u, a).abs())
        } else {
            (a.norm(), 0.0)
        };
        return Some(KinematicValues { along, lateral, yaw_rate: None, curvature: None });
    }
    let (speed, along) = (signed_speed(here), (signed_speed(after) - signed_speed(before)) / span);
    let yaw_rate = wrap_angle(after.heading_rad - before.heading_rad).abs() / span;
    Some(KinematicValues {
        // In reverse, higher speed is acceleration too. A standing vehicle has no gear, whatever the sign of
        // its zero.
        along: if speed < 0.0 { -along } else { along },
        lateral: speed.abs() * yaw_rate,
        yaw_rate: Some(yaw_rate),
        curvature: (speed.abs() > LEAST_CURVE_MPS).then(|| yaw_rate / speed.abs()),
    })
}

/// Speed along the heading, negative in reverse, m/s.
fn signed_speed(state: &State) -> f64 {
    state.velocity().dot(&crate::geometry::direction(state.heading_rad))
}

fn jerk(moments: &[Option<KinematicValues>], i: usize) -> Option<f64> {
    let (before, after) = (moments.get(i.checked_sub(1)?)?.as_ref()?, moments.get(i + 1)?.as_ref()?);
    Some((after.along - before.along).abs() / (2.0 * STEP_S))
}

/// Stretches of braking above the threshold, for recorded motion too. Uses speeds 0.2 s before and after, so
/// that one bad sample of a recording is no event. Not for walkers.
pub fn harsh_braking(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    if actor.agent_type == AgentType::Pedestrian {
        return Vec::new();
    }
    let harsh = |b: &(usize, f64)| b.1 > input.thresholds.harsh_brake_mps2;
    let flagged: Vec<_> = braking(actor, input.steps.clone()).filter(harsh).collect();
    stretches(actor, &flagged)
}

/// Braking at each step, m/s2: speeds 0.2 s before and after.
fn braking(actor: &Actor<'_>, steps: Range<usize>) -> impl Iterator<Item = (usize, f64)> {
    let within = steps.clone();
    let speed = move |i: usize| actor.state(i).filter(|_| within.contains(&i)).map(State::speed_mps);
    steps.filter_map(move |i| {
        let change = speed(i.checked_sub(HARSH_STEPS)?)? - speed(i + HARSH_STEPS)?;
        Some((i, change / (2.0 * HARSH_STEPS as f64 * STEP_S)))
    })
}

/// The step of the hardest braking and its rate, m/s2.
pub fn hardest_braking(actor: &Actor<'_>, steps: Range<usize>) -> Option<(usize, f64)> {
    braking(actor, steps).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Stretches of turning above the threshold of lateral acceleration, as [`harsh_braking`].
pub fn harsh_steering(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    if actor.agent_type == AgentType::Pedestrian {
        return Vec::new();
    }
    let state = |i: usize| actor.state(i).filter(|_| input.steps.contains(&i));
    let sideways = |i: usize| {
        let (before, after) = (state(i.checked_sub(HARSH_STEPS)?)?, state(i + HARSH_STEPS)?);
        let turned = wrap_angle(after.heading_rad - before.heading_rad).abs();
        Some((i, state(i)?.speed_mps() * turned / (2.0 * HARSH_STEPS as f64 * STEP_S)))
    };
    let harsh = |b: &(usize, f64)| b.1 > input.thresholds.harsh_lateral_mps2;
    let flagged: Vec<_> = input.steps.clone().filter_map(sideways).filter(harsh).collect();
    stretches(actor, &flagged)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{input_of, straight, track_of};
    use super::*;
    use std::borrow::Cow;

    /// 10 m/s for 2 s, then constant braking to rest.
    fn braking(rate: f64) -> Actor<'static> {
        let state = |i: usize| {
            let t = (i as f64 * STEP_S - 2.0).clamp(0.0, 10.0 / rate);
            let x = 10.0 * (i as f64 * STEP_S).min(2.0) + 10.0 * t - 0.5 * rate * t * t;
            State { x_m: x, vx_mps: 10.0 - rate * t, ..State::default() }
        };
        let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        actor.track = Cow::Owned(track_of(state));
        actor
    }

    #[test]
    fn constant_braking() {
        let (found, turns) = score_kinematic(&braking(5.0), 0..91);
        assert!((found.brake_mps2 - 5.0).abs() < 1e-9 && found.accel_mps2 < 1e-9);
        assert!((found.jerk_mps3.unwrap() - 25.0).abs() < 1e-9);
        assert_eq!((found.lateral_mps2, found.yaw_rate_radps, found.speed_mps), (0.0, Some(0.0), 10.0));
        // The jerk exceeds 15 for steps on both sides of either kink: 12.5 and 25 around the first.
        assert!(found.violations >= 2 && found.violations <= 6, "{}", found.violations);
        assert!(turns.is_empty());
        assert_eq!(score_kinematic(&braking(2.0), 0..91).0.violations, 0);
    }

    #[test]
    fn braking_to_a_stand_is_braking_whatever_the_sign_of_zero() {
        let mut actor = braking(5.0);
        let (positive, _) = score_kinematic(&actor, 0..91);
        let states = actor.track.to_mut().states.iter_mut().flatten();
        states.filter(|state| state.vx_mps == 0.0).for_each(|state| state.vx_mps = -0.0);
        assert_eq!(score_kinematic(&actor, 0..91).0, positive);
    }

    #[test]
    fn steady_circle() {
        // Radius 20 m at 8 m/s: 3.2 m/s2 sideways, 0.4 rad/s, 0.05 1/m.
        let circle = |speed: f64, radius: f64| {
            let state = move |i: usize| {
                let h = speed / radius * i as f64 * STEP_S;
                let (s, c) = h.sin_cos();
                State {
                    x_m: radius * s,
                    y_m: radius * (1.0 - c),
                    heading_rad: wrap_angle(h),
                    vx_mps: speed * c,
                    vy_mps: speed * s,
                }
            };
            let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
            actor.track = Cow::Owned(track_of(state));
            actor
        };
        let (found, turns) = score_kinematic(&circle(8.0, 20.0), 0..91);
        assert!((found.lateral_mps2 - 3.2).abs() < 1e-9);
        assert!((found.yaw_rate_radps.unwrap() - 0.4).abs() < 1e-9);
        assert!((found.curvature_per_m.unwrap() - 0.05).abs() < 1e-9);
        assert_eq!((found.violations, turns.len()), (0, 0));
        let (found, turns) = score_kinematic(&circle(12.0, 15.0), 0..91);
        assert!((found.lateral_mps2 - 9.6).abs() < 1e-9);
        assert_eq!((found.violations, turns.len()), (89, 1));
        assert!((turns[0].worst.unwrap() - 9.6 / 7.0).abs() < 1e-9);
    }

    #[test]
    fn walkers_have_no_heading_limits() {
        let mut actor = straight("a", AgentType::Pedestrian, (0.0, 0.0), 0.0, 1.4);
        // The heading spins while the walk goes straight on.
        let spin = |i: usize| State {
            x_m: 0.14 * i as f64,
            vx_mps: 1.4,
            heading_rad: wrap_angle(i as f64),
            ..State::default()
        };
        actor.track = Cow::Owned(track_of(spin));
        let (found, _) = score_kinematic(&actor, 0..91);
        assert_eq!((found.violations, found.yaw_rate_radps, found.curvature_per_m), (0, None, None));
    }

    #[test]
    fn harsh_braking_is_one_stretch() {
        let drivable = super::super::Drivable::default();
        let input = input_of(vec![braking(5.0), braking(3.0)], &drivable);
        let events = harsh_braking(&input.actors[0], &input);
        assert_eq!(events.len(), 1);
        assert!((events[0].worst.unwrap() - 5.0).abs() < 1e-9);
        assert!((2.0..2.5).contains(&events[0].time_s) && (3.5..4.1).contains(&events[0].until_s));
        assert!(harsh_braking(&input.actors[1], &input).is_empty());
    }
}
