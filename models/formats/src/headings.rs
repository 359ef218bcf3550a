//! The unit of headings: the vote of moving road users, and headings outside one turn.

use crate::problem::ImportWarning;
use crate::sentences;
use scene::{Agent, STEP_S, State, Vec2, geometry, wrap_angle};
use std::f64::consts::TAU;

/// Above this speed, the motion follows the heading, m/s.
pub(crate) const MOVES_MPS: f64 = 1.0;
/// Least mean cosine between heading and motion of a road user that moves along its heading, and least
/// difference to that of the other unit: a road user that suits both units has no vote.
const ALONG: f64 = 0.8;
const CLEAR: f64 = 0.2;

/// Least number of moving states that overrule the usual unit of a format.
const ENOUGH: usize = 10;

/// The unit of headings as far as the format defines it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeadingUnit {
    /// Radians, by the format's definition.
    Radians,
    /// Either unit, usually radians or degrees: the file decides.
    UsuallyRadians,
    UsuallyDegrees,
}

/// Votes of road users on the unit of their headings.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Votes {
    degrees: usize,
    radians: usize,
    /// Moving states of the road users that suit degrees, and radians.
    states: [usize; 2],
    /// Road users with a heading, and the number of them with most headings outside one turn in radians.
    found: usize,
    outside: usize,
    any_outside: bool,
}

/// The velocity of a road user at a step, m/s: as stated, otherwise towards its next position.
pub(crate) fn motion(states: &[Option<State>], at: usize) -> Option<Vec2> {
    let state = states.get(at)?.as_ref()?;
    let next = || states.get(at + 1)?.as_ref().map(|next| (next.position() - state.position()) / STEP_S);
    let moves = |v: &Vec2| v.norm() > MOVES_MPS;
    Some(state.velocity()).filter(moves).or_else(next).filter(moves)
}

impl Votes {
    fn of(agents: &[Agent]) -> Self {
        let mut votes = Self::default();
        for agent in agents {
            let states = &agent.track.states;
            let known = states.iter().enumerate().filter_map(|(i, state)| Some((i, (*state)?.heading_rad)));
            votes.add(known.map(|(i, heading)| (heading, motion(states, i))));
        }
        votes
    }

    /// Adds a road user: its headings, each with its motion if it moves.
    pub fn add(&mut self, states: impl Iterator<Item = (f64, Option<Vec2>)>) {
        let (mut count, mut degrees, mut radians) = (0.0, 0.0, 0.0);
        let (mut known, mut outside) = (0, 0);
        for (heading, way) in states.filter(|(heading, _)| heading.is_finite()) {
            known += 1;
            outside += usize::from(heading.abs() > TAU);
            let Some(way) = way.map(|way| way / way.norm()) else { continue };
            count += 1.0;
            degrees += geometry::direction(heading.to_radians()).dot(&way);
            radians += geometry::direction(heading).dot(&way);
        }
        self.found += usize::from(known > 0);
        self.any_outside |= outside > 0;
        self.outside += usize::from(2 * outside > known);
        let clear = |own: f64, other: f64| own > ALONG * count && own > other + CLEAR * count;
        let moving = count as usize;
        self.degrees += usize::from(moving > 0 && clear(degrees, radians));
        self.radians += usize::from(moving > 0 && clear(radians, degrees));
        for (states, sum) in self.states.iter_mut().zip([degrees, radians]) {
            *states += if sum > ALONG * count { moving } else { 0 };
        }
    }

    /// Whether nothing has to be decided: no heading is outside one turn, and the format defines radians. If
    /// the format only usually has radians, a car that reverses to the east votes for degrees too: a single
    /// vote within one turn means nothing.
    pub fn is_quiet(&self, unit: HeadingUnit) -> bool {
        !self.any_outside
            && match unit {
                HeadingUnit::Radians => true,
                HeadingUnit::UsuallyRadians => self.degrees < 2,
                HeadingUnit::UsuallyDegrees => false,
            }
    }

    pub fn said_degrees(&self) -> ImportWarning {
        let message = match self.degrees {
            0 => sentences::headings_in_degrees(self.outside, self.found),
            agree => sentences::headings_along_degrees(agree, agree + self.radians),
        };
        ImportWarning::new("headings-in-degrees", message)
    }

    /// Whether headings are degrees: the majority decides, then the size of headings, then the usual unit.
    pub fn in_degrees(&self, unit: HeadingUnit) -> bool {
        let by_size = 2 * self.outside > self.found;
        let (degrees, radians) = (self.degrees > self.radians, self.radians > self.degrees);
        match unit {
            HeadingUnit::Radians => by_size && !radians,
            HeadingUnit::UsuallyRadians => (degrees && self.states[0] >= ENOUGH) || (by_size && !radians),
            HeadingUnit::UsuallyDegrees => !(radians && self.states[1] >= ENOUGH),
        }
    }
}

/// Converts headings to radians within one turn, by the votes of the moving road users.
pub(crate) fn settle(agents: &mut [Agent], unit: HeadingUnit) -> Vec<ImportWarning> {
    let votes = Votes::of(agents);
    if votes.is_quiet(unit) {
        return Vec::new();
    }
    let mut warnings = Vec::new();
    if votes.in_degrees(unit) {
        warnings.push(votes.said_degrees());
        let states = agents.iter_mut().flat_map(|agent| agent.track.states.iter_mut().flatten());
        states.for_each(|state| state.heading_rad = wrap_angle(state.heading_rad.to_radians()));
        return warnings;
    }
    if unit == HeadingUnit::UsuallyDegrees {
        let message = sentences::headings_along_radians(votes.radians, votes.degrees + votes.radians);
        warnings.push(ImportWarning::new("headings-in-radians", message));
    }
    let mut wrapped = 0;
    // Tracks are shared: an unchanged one keeps its hash.
    for agent in agents.iter_mut().filter(|agent| is_outside(agent)) {
        for state in agent.track.states.iter_mut().flatten().filter(|state| state.heading_rad.abs() > TAU) {
            wrapped += 1;
            state.heading_rad = wrap_angle(state.heading_rad);
        }
    }
    warnings.extend(said_wrapped(wrapped));
    warnings
}

/// Reports how many headings were wrapped.
pub(crate) fn said_wrapped(count: usize) -> Option<ImportWarning> {
    (count > 0).then(|| ImportWarning::new("headings-wrapped", sentences::headings_wrapped(count)))
}

/// Whether a heading is outside one turn in radians; one that is not a number is refused later.
fn is_outside(agent: &Agent) -> bool {
    let far = |state: &State| state.heading_rad.is_finite() && state.heading_rad.abs() > TAU;
    agent.track.states.iter().flatten().any(far)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{AgentType, Subtype};

    /// A road user that moves at a speed, with a heading in the unit of a file.
    fn user(way_rad: f64, heading: f64, speed_mps: f64) -> Agent {
        let v = geometry::direction(way_rad) * speed_mps;
        let state = |i: i32| {
            let at = v * (f64::from(i) * STEP_S);
            Some(State { x_m: at.x, y_m: at.y, heading_rad: heading, vx_mps: v.x, vy_mps: v.y })
        };
        Agent::bare("1", AgentType::Vehicle, Subtype::Car, (0..5).map(state).collect())
    }

    fn read(mut agents: Vec<Agent>, degrees: bool) -> (Vec<f64>, Vec<&'static str>) {
        let unit = if degrees { HeadingUnit::UsuallyDegrees } else { HeadingUnit::UsuallyRadians };
        let codes = settle(&mut agents, unit).iter().map(|warning| warning.code).collect();
        (agents.iter().map(|agent| agent.track.states[0].unwrap_or_default().heading_rad).collect(), codes)
    }

    #[test]
    fn the_road_users_that_move_decide_the_unit() {
        let moving = |unit: f64| vec![user(0.3, 0.3 * unit, 8.0), user(-2.0, -2.0 * unit, 8.0)];
        // One heading beyond a turn does not make all others degrees.
        let odd = [moving(1.0), vec![user(1.487, 7.77, 8.0)]].concat();
        let (found, codes) = read(odd, false);
        assert!((found[0] - 0.3).abs() < 1e-9 && (found[2] - (7.77 - TAU)).abs() < 1e-9, "{found:?}");
        assert_eq!(codes, ["headings-wrapped"]);
        let degrees = 180.0 / std::f64::consts::PI;
        let (found, codes) = read([moving(degrees), vec![user(0.0, 400.0, 0.0)]].concat(), false);
        assert!((found[1] + 2.0).abs() < 1e-9 && (found[2] - 40.0_f64.to_radians()).abs() < 1e-9);
        assert_eq!(codes, ["headings-in-degrees"]);
        // If degrees are usual, the moving road users overrule that too.
        assert_eq!(read(moving(1.0), true), (vec![0.3, -2.0], vec!["headings-in-radians"]));
        // Nobody moves: the size of most headings decides, or the usual unit.
        let still = |heading| user(0.0, heading, 0.0);
        assert_eq!(read(vec![still(90.0), still(180.0), still(1.0)], false).1, ["headings-in-degrees"]);
        assert_eq!(read(vec![still(9.0), still(2.0), still(1.0)], false).1, ["headings-wrapped"]);
        assert_eq!(read(vec![still(2.0)], true).1, ["headings-in-degrees"]);
    }
}
