//! The reaction of one agent to another, as figures for its description.

use super::giving_way::YieldOption;
use super::other::Reactor;
use crate::tuning::fixed::reaction::{ASIDE_M, SAME_PLACE_M};
use scene::judge::{Reaction, ReactionKind};
use scene::motion::Trajectory;
use scene::{AgentId, STANDING_MPS, STEP_S, State};

/// Standing this many steps longer than in the kept motion counts as waiting.
pub const WAITS_STEPS: usize = 5;

/// The reaction of an agent to `cause`; the window begins at `start_step`.
pub(super) fn reaction(own: &Reactor, way: &YieldOption, cause: AgentId, start_step: usize) -> Reaction {
    let paced = &way.paced;
    let (along, speed) = (&paced.along_m, &paced.speed_mps);
    let from = paced.own.min(along.len() - 1);
    let stood: Vec<f64> = own
        .path
        .states
        .iter()
        .zip(&own.path.along_m)
        .filter(|(s, _)| s.speed_mps() < STANDING_MPS)
        .map(|(_, along)| *along)
        .collect();
    let standing = (from..along.len()).filter(|i| speed[*i] < STANDING_MPS);
    let elsewhere = |i: &usize| stood.iter().all(|s| (s - along[*i]).abs() > SAME_PLACE_M);
    let waits = standing.clone().count() >= stood.len() + WAITS_STEPS
        || standing.clone().filter(elsewhere).count() >= WAITS_STEPS;
    let delay_s = own.late_s(paced);
    // How much slower it is than its kept motion at the same place.
    let less = |i: usize| own.path.speed_at_mps(along[i]) - speed[i];
    let greatest = |sign: f64| {
        (from..along.len()).max_by(|a, b| (sign * less(*a)).total_cmp(&(sign * less(*b)))).unwrap_or(from)
    };
    let (kind, at) = if waits {
        let first = standing.clone().find(elsewhere).or(standing.clone().next());
        (ReactionKind::Waits, first.unwrap_or(from))
    } else if delay_s < 0.0 {
        (ReactionKind::SpeedsUp, greatest(-1.0))
    } else {
        (ReactionKind::Slows, greatest(1.0))
    };
    let state = &way.states[at];
    Reaction {
        kind,
        cause,
        delay_s,
        time_s: (start_step + own.path.enters + at) as f64 * STEP_S,
        x_m: state.x_m,
        y_m: state.y_m,
        speed_mps: speed[at],
    }
    .rounded()
}

/// The reaction of an agent that does not enter at a scene step, in this state, because `cause` is in its
/// place.
pub(super) fn stays_out(entry: &State, cause: AgentId, step: usize) -> Reaction {
    Reaction {
        kind: ReactionKind::StaysOut,
        cause,
        delay_s: 0.0,
        time_s: step as f64 * STEP_S,
        x_m: entry.x_m,
        y_m: entry.y_m,
        speed_mps: 0.0,
    }
    .rounded()
}

/// The reaction to `cause` of an agent that replanned. `kept` is its motion from the first step after
/// `start_s` on.
pub(in crate::generator) fn reaction_of(
    kept: &[State],
    motion: &Trajectory,
    cause: AgentId,
    start_s: f64,
) -> Reaction {
    let states: Vec<State> = motion.iter().skip(1).map(State::from).collect();
    let nearest = |s: &State| {
        let apart = |k: &State| (k.position() - s.position()).norm();
        let at = (0..kept.len()).min_by(|a, b| apart(&kept[*a]).total_cmp(&apart(&kept[*b])));
        at.map_or((0, 0.0), |at| (at, apart(&kept[at])))
    };
    let last = states.len().saturating_sub(1);
    let end = states.last().copied().unwrap_or_default();
    let delay_s = (last as f64 - nearest(&end).0 as f64) * STEP_S;
    let beside: Vec<(usize, f64)> = states.iter().map(nearest).collect();
    let aside = beside.iter().map(|(_, apart)| *apart).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    // An agent with a fixed arrival time can be late or early only before it.
    let late = beside.iter().enumerate().map(|(i, (place, _))| i as f64 - *place as f64);
    let (earliest, lead) = late
        .clone()
        .enumerate()
        .fold((last, 0.0), |most, (i, late)| if -late > most.1 { (i, -late) } else { most });
    let lag = late.fold(0.0, f64::max);
    let slowest = (0..states.len()).min_by(|a, b| states[*a].speed_mps().total_cmp(&states[*b].speed_mps()));
    let slowest = slowest.unwrap_or(0);
    let stands = states.get(slowest).is_some_and(|s| s.speed_mps() < STANDING_MPS);
    let stood = kept.iter().any(|s| s.speed_mps() < STANDING_MPS);
    let (kind, at) = match aside {
        _ if stands && !stood => (ReactionKind::Waits, slowest),
        Some((at, away)) if away > ASIDE_M && delay_s.abs() < 1.0 => (ReactionKind::KeepsClear, at),
        _ if lead > lag => (ReactionKind::SpeedsUp, earliest),
        _ => (ReactionKind::Slows, slowest),
    };
    let state = states.get(at).copied().unwrap_or(end);
    Reaction {
        kind,
        cause,
        delay_s,
        time_s: start_s + (at + 1) as f64 * STEP_S,
        x_m: state.x_m,
        y_m: state.y_m,
        speed_mps: state.speed_mps(),
    }
    .rounded()
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Vec2;
    use scene::motion::MotionState;

    /// Walks east: the position after each step at that step's speed.
    fn walk(speed_mps: impl Fn(usize) -> f64) -> Trajectory {
        let mut x_m = 0.0;
        let at = |i: usize| {
            if i > 0 {
                x_m += speed_mps(i) * STEP_S;
            }
            MotionState {
                position: Vec2::new(x_m, 0.0),
                heading_rad: 0.0,
                velocity: Vec2::new(speed_mps(i), 0.0),
            }
        };
        (0..=90).map(at).collect()
    }

    fn answer(speed_mps: impl Fn(usize) -> f64) -> Reaction {
        let kept: Vec<State> = walk(|_| 1.4).iter().skip(1).map(State::from).collect();
        reaction_of(&kept, &walk(speed_mps), "car".into(), 0.0)
    }

    #[test]
    fn who_is_due_somewhere_and_hurries_first_speeds_up() {
        // 4 m ahead of the kept motion at half time, level with it at the end.
        let hurries = answer(|i| if i <= 45 { 2.0 } else { 0.8 });
        assert_eq!(hurries.kind, ReactionKind::SpeedsUp);
        assert!((hurries.time_s - 4.5).abs() < 1.5, "{}", hurries.time_s);
        let dawdles = answer(|i| if i <= 45 { 0.8 } else { 2.0 });
        assert_eq!(dawdles.kind, ReactionKind::Slows);
        assert!(dawdles.time_s < 4.6, "{}", dawdles.time_s);
    }
}
