//! Figures of one set of futures of one road user against its log.

use super::{Case, Subset};
use scene::geometry::direction;
use scene::motion::{MotionModel, MotionState, Sampled, Smoothing, Trajectory, fit, limit_excess};
use scene::{Agent, Future, Goal, HORIZON_STEPS, STANDING_MPS, State, Vec2, wrap_angle};

/// Errors of one road user's futures, over the steps at which the log is known. Distances in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// Least mean distance of any future.
    pub min_ade: f64,
    /// Least distance at the end of any future; with a goal position, at the frame before the goal.
    pub min_fde: f64,
    /// Mean distance of the shown future.
    pub first_ade: f64,
    /// Distance at the end of the shown future.
    pub first_fde: f64,
    /// Mean distance of the most probable future.
    pub likeliest_ade: f64,
    /// Mean distance of the future that is closest at its end: the paper's rule.
    pub closest_ade: f64,
    /// Mean absolute heading error of that future while the log moves, radians; `None` if it never moves.
    pub heading_rad: Option<f64>,
    /// Mean absolute speed error of that future, m/s.
    pub speed_mps: f64,
    /// Mean absolute error of the shown future along the logged heading.
    pub along: f64,
    /// Mean absolute error of the shown future across the logged heading.
    pub across: f64,
    /// Index of the best future by mean distance.
    pub best: usize,
}

/// Greatest mean distance of a motion that follows a log, metres.
const FOLLOWED_M: f64 = 0.3;
/// Greatest difference of the last speeds, m/s.
const ARRIVED_MPS: f64 = 1.5;

/// Errors of `futures` (never empty, first step right after the start); `shown` is the index of the shown
/// one.
pub fn measure(log: &Agent, case: &Case, subset: Subset, futures: &[Future], shown: usize) -> Measured {
    let known: Vec<(usize, State)> =
        (1..=HORIZON_STEPS).filter_map(|step| Some((step, log.state_at(step)?))).collect();
    let end = end_step(log, case, subset);
    let ades: Vec<f64> =
        futures.iter().map(|f| mean(pairs(&known, f).map(|(l, s)| distance(l, s)))).collect();
    let fdes: Vec<f64> = futures
        .iter()
        .map(|f| match (log.state_at(end), at(f, end)) {
            (Some(logged), Some(state)) => distance(&logged, state),
            _ => f64::INFINITY,
        })
        .collect();
    let (best, closest) = (least(&ades), least(&fdes));
    let likeliest = likeliest(futures);
    let ended = &futures[closest];
    let moving: Vec<f64> = pairs(&known, ended)
        .filter(|(l, _)| l.speed_mps() > STANDING_MPS)
        .map(|(l, s)| wrap_angle(s.heading_rad - l.heading_rad).abs())
        .collect();
    let apart = |(l, s): (&State, &State)| {
        let error = s.position() - l.position();
        let ahead = direction(l.heading_rad);
        [error.dot(&ahead).abs(), scene::geometry::cross(ahead, error).abs()]
    };
    Measured {
        min_ade: ades[best],
        min_fde: fdes[closest],
        first_ade: ades[shown],
        first_fde: fdes[shown],
        likeliest_ade: ades[likeliest],
        closest_ade: ades[closest],
        heading_rad: (!moving.is_empty()).then(|| mean(moving.into_iter())),
        speed_mps: mean(pairs(&known, ended).map(|(l, s)| (s.speed_mps() - l.speed_mps()).abs())),
        along: mean(pairs(&known, &futures[shown]).map(|p| apart(p)[0])),
        across: mean(pairs(&known, &futures[shown]).map(|p| apart(p)[1])),
        best,
    }
}

/// Frame at which the end is measured: that of the goal or, if its position was given, the one before.
fn end_step(log: &Agent, case: &Case, subset: Subset) -> usize {
    if !subset.has_position() {
        return case.goal_step;
    }
    let before = log.track.valid_steps().rfind(|s| *s >= 1 && *s < case.goal_step);
    before.unwrap_or(case.goal_step)
}

/// Index of the most probable future; the first of equals.
pub fn likeliest(futures: &[Future]) -> usize {
    let mut best = 0;
    for (i, future) in futures.iter().enumerate() {
        if future.probability > futures[best].probability {
            best = i;
        }
    }
    best
}

/// Probabilities of an answer's futures given that the road user moves, as in all cases: the probability of
/// staying is zero.
pub fn given_motion(futures: &[Future]) -> Vec<f64> {
    let stays = |f: &Future| f.states.windows(2).all(|pair| pair[0].position() == pair[1].position());
    let shares = futures.iter().map(|f| if stays(f) { 0.0 } else { f.probability });
    let total: f64 = shares.clone().sum();
    shares.map(|p| if total > 0.0 { p / total } else { 0.0 }).collect()
}

/// Negative log likelihood of the best future by [`given_motion`]; `None` for a single future, for a road
/// user that must stay, and for formulas, which have no probabilities.
pub fn log_loss(probabilities: &[f64], best: usize) -> Option<f64> {
    let p = *probabilities.get(best)?;
    (probabilities.len() > 1 && p > 0.0).then(|| -p.max(1e-6).ln())
}

/// A future's state at a scene step.
pub fn at(future: &Future, step: usize) -> Option<&State> {
    future.states.get(step.checked_sub(future.first_step)?)
}

fn pairs<'a>(
    known: &'a [(usize, State)],
    future: &'a Future,
) -> impl Iterator<Item = (&'a State, &'a State)> {
    known.iter().filter_map(|(step, logged)| Some((logged, at(future, *step)?)))
}

fn distance(a: &State, b: &State) -> f64 {
    (a.position() - b.position()).norm()
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v, n + 1.0));
    if n > 0.0 { sum / n } else { 0.0 }
}

fn least(values: &[f64]) -> usize {
    (0..values.len()).min_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0)
}

/// Remaining distance of a future to a case's goal when it is due, as in [`goal_error`]; `None` if the future
/// ends earlier.
pub fn left_to_goal(goal: &Goal, case: &Case, future: &Future) -> Option<[f64; 3]> {
    future.states.get(case.goal_step - 1).map(|state| goal_error(goal, state))
}

/// Remaining distance to a goal: metres, radians, m/s; zero for free fields.
pub fn goal_error(goal: &Goal, state: &State) -> [f64; 3] {
    [
        goal.position.map_or(0.0, |p| (p - state.position()).norm()),
        goal.heading_rad.map_or(0.0, |h| wrap_angle(h - state.heading_rad).abs()),
        goal.speed_mps.map_or(0.0, |v| (v - state.speed_mps()).abs()),
    ]
}

/// Whether the remaining distance is within 0.05 m, 0.02 rad and 0.05 m/s.
pub fn is_met([position_m, heading_rad, speed_mps]: [f64; 3]) -> bool {
    position_m < 0.05 && heading_rad < 0.02 && speed_mps < 0.05
}

/// The motion within the limits that follows a log most closely from its start.
pub fn following(log: &Agent, start: State) -> Trajectory {
    let model = MotionModel::new(log.agent_type, log.subtype, log.size, start);
    let sampled = |step: usize| {
        let state = log.state_at(step)?;
        Some(Sampled { step, position: state.position(), heading_rad: state.heading_rad })
    };
    let samples: Vec<Sampled> = (1..=HORIZON_STEPS / 5).filter_map(|i| sampled(5 * i)).collect();
    model.rollout(&fit(&model, &samples, Smoothing::WISHED))
}

/// Mean distance between a log and a motion given by its position at each step, metres.
pub fn mean_distance_m(log: &Agent, at: impl Fn(usize) -> Vec2) -> f64 {
    let known = (1..=HORIZON_STEPS).filter_map(|step| Some((step, log.state_at(step)?)));
    mean(known.map(|(step, logged)| (logged.position() - at(step)).norm()))
}

/// Whether the logged motion is physically possible: the motion that follows the log stays within
/// [`FOLLOWED_M`] of it on average and arrives within [`ARRIVED_MPS`] of its last speed. Trackers that lose
/// or confuse road users leave logs that no road user can follow.
pub fn can_be_followed(log: &Agent, case: &Case) -> bool {
    let motion = following(log, case.start);
    let arrives = log
        .state_at(case.goal_step)
        .is_none_or(|last| (last.speed_mps() - motion[case.goal_step].velocity.norm()).abs() < ARRIVED_MPS);
    mean_distance_m(log, |step| motion[step].position) < FOLLOWED_M && arrives
}

/// Whether a future breaks a limit of its road user. Exact rest breaks none, because a small speed at a
/// standing start is noise of the detector.
pub fn is_outside_limits(agent: &Agent, start: &State, future: &Future) -> bool {
    if start.speed_mps() < STANDING_MPS && future.states.iter().all(|s| s.position() == start.position()) {
        return false;
    }
    let model = MotionModel::new(agent.agent_type, agent.subtype, agent.size, *start);
    let states = std::iter::once(start).chain(&future.states);
    let trajectory: Vec<MotionState> = states
        .map(|s| MotionState { position: s.position(), heading_rad: s.heading_rad, velocity: s.velocity() })
        .collect();
    limit_excess(&model, &trajectory) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{log, straight};

    fn case(log: &Agent) -> Case {
        let start = log.state_at(0).unwrap();
        Case { agent: 0, agent_type: log.agent_type, goal_step: 90, start }
    }

    #[test]
    fn known_distances() {
        // The log drives east at 10 m/s. One future is always 2 m to the left, one 10 % too fast.
        let log = log("a", 10.0, 91);
        let left = straight(0.25, 10.0, 2.0);
        let fast = straight(0.75, 11.0, 0.0);
        let m = measure(&log, &case(&log), Subset::None, &[left, fast], 1);
        // Too fast by 1 m/s: 0.1, 0.2, .. 9.0 m: 4.55 m on average, 9 m at the end.
        assert!((m.min_ade - 2.0).abs() < 1e-9 && m.best == 0);
        assert!((m.first_ade - 4.55).abs() < 1e-9 && (m.likeliest_ade - 4.55).abs() < 1e-9);
        assert!((m.min_fde - 2.0).abs() < 1e-9 && (m.first_fde - 9.0).abs() < 1e-9);
        assert!((m.along - 4.55).abs() < 1e-9 && m.across < 1e-9);
        assert!((m.closest_ade - 2.0).abs() < 1e-9 && m.speed_mps < 1e-9);
        assert!(m.heading_rad.unwrap() < 1e-9);
    }

    #[test]
    fn staying_has_no_share_among_those_that_move() {
        let futures = [straight(0.6, 0.0, 0.0), straight(0.3, 5.0, 0.0), straight(0.1, 9.0, 0.0)];
        let shares = given_motion(&futures);
        assert!(shares.iter().zip([0.0, 0.75, 0.25]).all(|(a, b)| (a - b).abs() < 1e-12), "{shares:?}");
        assert_eq!(given_motion(&futures[..1]), [0.0]);
    }

    #[test]
    fn with_a_goal_the_end_is_the_frame_before_it() {
        let log = log("a", 10.0, 91);
        let m = measure(&log, &case(&log), Subset::Pos, &[straight(1.0, 11.0, 0.0)], 0);
        assert!((m.min_fde - 8.9).abs() < 1e-9);
        assert!((m.speed_mps - 1.0).abs() < 1e-9);
    }

    #[test]
    fn gaps_of_the_log_are_left_out() {
        let mut log = log("a", 10.0, 91);
        for step in 46..91 {
            log.track.states[step] = None;
        }
        let case = Case { goal_step: 45, ..case(&log) };
        let m = measure(&log, &case, Subset::None, &[straight(1.0, 11.0, 0.0)], 0);
        assert!((m.first_ade - 2.3).abs() < 1e-9 && (m.first_fde - 4.5).abs() < 1e-9);
    }

    #[test]
    fn goals_are_met_within_their_bounds() {
        let goal = Goal { heading_rad: Some(3.13), speed_mps: Some(1.0), ..Goal::default() };
        let state = State { heading_rad: -3.13, vx_mps: -1.0, ..State::default() };
        let [position, heading, speed] = goal_error(&goal, &state);
        assert!(position == 0.0 && heading < 0.024 && speed < 1e-9);
        assert!(is_met([0.049, 0.019, 0.049]) && !is_met([0.051, 0.0, 0.0]));
    }

    #[test]
    fn log_loss_needs_a_choice() {
        assert_eq!(log_loss(&[0.5, 0.5], 1), Some(2.0_f64.ln()));
        assert_eq!(log_loss(&[1.0], 0), None);
        assert_eq!(log_loss(&[], 0), None);
        assert_eq!(log_loss(&[0.0, 1.0], 0), None);
    }

    #[test]
    fn logs_that_nobody_can_follow_are_told() {
        let steady = log("a", 10.0, 91);
        assert!(can_be_followed(&steady, &case(&steady)));
        // The tracker jumps to another vehicle, 30 m ahead.
        let mut leap = steady.clone();
        for state in leap.track.states.iter_mut().skip(50).flatten() {
            state.x_m += 30.0;
        }
        assert!(!can_be_followed(&leap, &case(&leap)));
        // Its last speed is a glitch.
        let mut glitch = steady.clone();
        if let Some(state) = &mut glitch.track.states[90] {
            state.vx_mps = 100.0;
        }
        assert!(!can_be_followed(&glitch, &case(&glitch)));
    }

    #[test]
    fn limits_are_seen() {
        let log = log("a", 10.0, 91);
        let start = log.state_at(0).unwrap();
        assert!(!is_outside_limits(&log, &start, &straight(1.0, 10.0, 0.0)));
        let slow = State { vx_mps: 0.25, ..start };
        let rest = Future { states: vec![State { vx_mps: 0.0, ..start }; 90], ..straight(1.0, 0.0, 0.0) };
        assert!(!is_outside_limits(&log, &slow, &rest));
        // Twenty metres farther from one step to the next.
        let mut leap = straight(1.0, 10.0, 0.0);
        for state in leap.states.iter_mut().skip(40) {
            state.x_m += 20.0;
        }
        assert!(is_outside_limits(&log, &start, &leap));
    }
}
