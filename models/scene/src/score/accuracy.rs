//! Distance of generated motion from a reference, as in the paper's Table I.

use super::input::Actor;
use super::report::mean;
use crate::{Future, State, Track, wrap_angle};
use schemars::JsonSchema;
use serde::Serialize;
use std::ops::Range;

/// The step that counts as the end of a future.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Endpoint {
    /// The last one.
    #[default]
    Last,
    /// The one before: the goal position was given, so the last step carries no information (the paper's
    /// rule).
    BeforeLast,
}

/// Errors against the reference, over the steps at which both are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Accuracy {
    /// Least mean distance of any future, metres.
    pub min_ade_m: Option<f64>,
    /// Least distance at the end of any future, metres.
    pub min_fde_m: Option<f64>,
    /// Mean distance of the chosen future, metres.
    pub ade_m: Option<f64>,
    /// Greatest distance of the chosen future, metres (the log ghost's figure).
    pub max_distance_m: Option<f64>,
    /// Mean absolute heading error of the future that ends closest, radians.
    pub heading_error_rad: Option<f64>,
    /// Mean absolute speed error of the future that ends closest, m/s.
    pub speed_error_mps: Option<f64>,
    /// Step that counted as the end.
    pub endpoint: Endpoint,
}

impl Accuracy {
    /// Mean over road users (for the greatest distance, the maximum); `None` without any.
    pub fn mean<'a>(all: impl Iterator<Item = &'a Self> + Clone) -> Option<Self> {
        let first = all.clone().next()?;
        let over = |field: fn(&Self) -> Option<f64>| mean(all.clone().map(field));
        Some(Self {
            min_ade_m: over(|a| a.min_ade_m),
            min_fde_m: over(|a| a.min_fde_m),
            ade_m: over(|a| a.ade_m),
            max_distance_m: super::report::maximum(all.clone().map(|a| a.max_distance_m)),
            heading_error_rad: over(|a| a.heading_error_rad),
            speed_error_mps: over(|a| a.speed_error_mps),
            endpoint: first.endpoint,
        })
    }
}

/// Errors of one motion against the reference.
struct Errors {
    ade_m: f64,
    end_m: f64,
    max_m: f64,
    heading_rad: f64,
    speed_mps: f64,
}

/// Errors of a generated motion and its alternatives within `steps`. `None` for recorded motion, without a
/// reference, or if the two share no step.
pub fn accuracy(actor: &Actor<'_>, steps: Range<usize>) -> Option<Accuracy> {
    let reference = actor.reference.filter(|_| actor.generated)?;
    let endpoint = if actor.goal.position.is_some() { Endpoint::BeforeLast } else { Endpoint::Last };
    // The first scored step is the start, which is given.
    let made = steps.start + 1..steps.end;
    let chosen = errors(made.clone(), |i| actor.state(i), reference, endpoint)?;
    let of_mode = |mode: &Future| {
        let at = |i: usize| mode.states.get(i.checked_sub(mode.first_step)?);
        errors(made.clone(), at, reference, endpoint)
    };
    let modes: Vec<Errors> = actor.modes.iter().filter_map(of_mode).collect();
    let all = || std::iter::once(&chosen).take(usize::from(modes.is_empty())).chain(&modes);
    let closest = all().min_by(|p, q| p.end_m.total_cmp(&q.end_m));
    Some(Accuracy {
        min_ade_m: all().map(|e| e.ade_m).reduce(f64::min),
        min_fde_m: all().map(|e| e.end_m).reduce(f64::min),
        ade_m: Some(chosen.ade_m),
        max_distance_m: Some(chosen.max_m),
        heading_error_rad: closest.map(|e| e.heading_rad),
        speed_error_mps: closest.map(|e| e.speed_mps),
        endpoint,
    })
}

fn errors<'a>(
    steps: Range<usize>,
    at: impl Fn(usize) -> Option<&'a State>,
    reference: &Track,
    endpoint: Endpoint,
) -> Option<Errors> {
    let known: Vec<(&State, &State)> = steps.filter_map(|i| Some((at(i)?, reference.at(i)?))).collect();
    let distance = |(p, q): &(&State, &State)| (p.position() - q.position()).norm();
    let end = match endpoint {
        Endpoint::Last => known.last()?,
        Endpoint::BeforeLast => known.get(known.len().saturating_sub(2))?,
    };
    let over = |of: &dyn Fn(&(&State, &State)) -> f64| known.iter().map(of).sum::<f64>() / known.len() as f64;
    Some(Errors {
        ade_m: over(&distance),
        end_m: distance(end),
        max_m: known.iter().map(distance).fold(0.0, f64::max),
        heading_rad: over(&|(p, q)| wrap_angle(p.heading_rad - q.heading_rad).abs()),
        speed_mps: over(&|(p, q)| (p.speed_mps() - q.speed_mps()).abs()),
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::straight;
    use super::*;
    use crate::{AgentType, Goal, Vec2};

    #[test]
    fn distances_from_the_log() {
        let log = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0).track.into_owned();
        let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 9.0);
        assert_eq!(accuracy(&actor, 0..91), None);
        actor.reference = Some(&log);
        // One more metre each second: the mean over steps 1 to 90 is 4.55 m, the end 9 m.
        let found = accuracy(&actor, 0..91).unwrap();
        assert!((found.min_ade_m.unwrap() - 4.55).abs() < 1e-9);
        assert!((found.min_fde_m.unwrap() - 9.0).abs() < 1e-9);
        assert!((found.speed_error_mps.unwrap() - 1.0).abs() < 1e-9);
        assert_eq!(found.heading_error_rad, Some(0.0));
        actor.goal = Goal { position: Some(Vec2::new(81.0, 0.0)), ..Goal::default() };
        let found = accuracy(&actor, 0..91).unwrap();
        assert!((found.min_fde_m.unwrap() - 8.9).abs() < 1e-9);
        assert_eq!(found.endpoint, Endpoint::BeforeLast);
    }

    #[test]
    fn best_of_the_modes() {
        let log = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0).track.into_owned();
        let mode = |speed: f64| {
            let track = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, speed).track.into_owned();
            Future::bare(0.5, 1, track.states.into_iter().skip(1).flatten().collect())
        };
        let modes = [mode(9.0), mode(10.5)];
        let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 9.0);
        (actor.reference, actor.modes) = (Some(&log), &modes);
        let found = accuracy(&actor, 0..91).unwrap();
        assert!((found.min_fde_m.unwrap() - 4.5).abs() < 1e-9);
        assert!((found.ade_m.unwrap() - 4.55).abs() < 1e-9);
        assert!((found.speed_error_mps.unwrap() - 0.5).abs() < 1e-9);
    }
}
