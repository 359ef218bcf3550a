//! A path driven so that others go first. The motion is unchanged for as long as possible, then brakes as
//! little as necessary, and continues once the path is free.

use super::blocks::PathBlock;
use super::path_progress::PathProgress;
use crate::tuning::fixed::yielding::{
    AT_REST_MPS, CREEPS_M, HALTS_MPS, HARD_JERK_MPS3, HARD_MPS2, JERK_MPS3, TRACKS_S, WORTH_GOING_M,
};
use scene::{HORIZON_STEPS, STANDING_MPS, STEP_S, State};

/// Time ahead in which the agent looks for room to go, steps.
const GOING_STEPS: usize = 15;
/// Margin in time before and after others, steps.
const TIME_GAP: usize = 3;
/// Steps per second.
const SECOND: usize = 10;
/// Tolerance for rounding of distances, metres.
const HAIR_M: f64 = 0.02;
/// Steps by which braking begins earlier than necessary.
const EARLIER: usize = 6;
/// Bisections of the range of accelerations.
const HALVINGS: usize = 7;

/// How an agent gives way.
#[derive(Clone, Copy, Debug)]
pub(super) struct YieldManner {
    /// Braking, m/s2.
    pub(super) brake_mps2: f64,
    /// Speeding up again, m/s2.
    pub(super) accelerate_mps2: f64,
    /// Distance kept from an obstacle, metres.
    pub(super) gap_m: f64,
    /// Time headway kept in addition, at the agent's own speed, seconds.
    pub(super) headway_s: f64,
    /// Factor of the path's speed at each place.
    pub(super) pace: f64,
    /// Factor of the first speed of an agent that enters: less than one if it braked before it came into
    /// sight.
    pub(super) entry: f64,
}

/// A path at another pace: one entry per state, to the window's end or until the agent leaves.
#[derive(Clone, Debug)]
pub(super) struct Paced {
    pub(super) along_m: Vec<f64>,
    pub(super) speed_mps: Vec<f64>,
    /// Number of leading states that are the path's own.
    pub(super) own: usize,
}

/// Bounds of progress at each step of the window.
struct ProgressBounds {
    at_m: Vec<f64>,
    /// The least bound of this and all later steps.
    from_m: Vec<f64>,
    /// Bounds at the window's end that persist after it, and the speeds at which they move on, m/s.
    after: Vec<(f64, f64)>,
}

impl ProgressBounds {
    fn new(at_m: Vec<f64>, after: Vec<(f64, f64)>) -> Self {
        let mut from_m = at_m.clone();
        for i in (0..from_m.len().saturating_sub(1)).rev() {
            from_m[i] = from_m[i].min(from_m[i + 1]);
        }
        Self { at_m, from_m, after }
    }

    /// Whether braking at this rate from here on stays below the bounds. This includes agents that move on
    /// beyond the window and brake at the same rate.
    fn hold(&self, step: usize, along_m: f64, speed_mps: f64, manner: YieldManner) -> bool {
        let brake_mps2 = manner.brake_mps2;
        let along_m = along_m + manner.headway_s * speed_mps;
        let stops_m = speed_mps * speed_mps / (2.0 * brake_mps2);
        let behind = |(bound, speed): &(f64, f64)| {
            along_m + stops_m <= bound + speed * speed / (2.0 * brake_mps2) + HAIR_M
        };
        if !self.after.iter().all(behind) {
            return false;
        }
        if along_m + stops_m <= self.from_m[step] + HAIR_M {
            return true;
        }
        let stops_s = speed_mps / brake_mps2;
        self.at_m[step..].iter().enumerate().all(|(i, bound)| {
            let t = i as f64 * STEP_S;
            let moved = if t < stops_s { speed_mps * t - 0.5 * brake_mps2 * t * t } else { stops_m };
            along_m + moved <= bound + HAIR_M
        })
    }
}

/// Bounds by blocks that are still there when the window ends, or come after it, and the speeds at which they
/// move on.
fn after(blocks: &[&PathBlock], gap_m: f64) -> Vec<(f64, f64)> {
    let there = blocks.iter().filter(|b| b.from + b.taken.len() > HORIZON_STEPS);
    let bound = |b: &&PathBlock| {
        let (last, _) = *b.taken.last()?;
        if b.from > HORIZON_STEPS {
            return Some(((last - gap_m).max(0.0), 0.0));
        }
        let earlier = b.taken.len().saturating_sub(1 + SECOND);
        let (before, _) = *b.taken.get(earlier)?;
        let seconds = (b.taken.len() - 1 - earlier).max(1) as f64 * STEP_S;
        Some(((last - gap_m).max(0.0), ((last - before) / seconds).max(0.0)))
    };
    there.filter_map(bound).collect()
}

/// Bounds on progress that keep an agent behind these blocks.
fn behind(blocks: &[&PathBlock], gap_m: f64) -> Vec<f64> {
    let mut at_m = vec![f64::INFINITY; HORIZON_STEPS + 1];
    for block in blocks.iter().filter(|block| block.from <= HORIZON_STEPS) {
        for (i, (first, _)) in block.taken.iter().enumerate() {
            let step = block.from + i;
            let from = step.saturating_sub(TIME_GAP);
            for bound in &mut at_m[from..=(step + TIME_GAP).min(HORIZON_STEPS)] {
                *bound = bound.min((first - gap_m).max(0.0));
            }
        }
    }
    at_m
}

impl Paced {
    /// A path behind these blocks. For a block that cannot be avoided, it brakes as hard as the manner
    /// allows.
    pub(super) fn behind(path: &PathProgress, blocks: &[&PathBlock], manner: YieldManner) -> Self {
        let mut after_end = after(blocks, manner.gap_m);
        let bounds = ProgressBounds::new(behind(blocks, manner.gap_m), after_end.clone());
        // On another timing, the agent does not pass a place while its own motion stands there: it had a
        // reason to stand.
        let mut waiting = bounds.at_m.clone();
        for (i, state) in path.states.iter().enumerate() {
            if state.speed_mps() < STANDING_MPS {
                let bound = &mut waiting[path.enters + i];
                *bound = bound.min(path.along_m[i] + CREEPS_M);
            }
        }
        let stands = |s: &&State| s.speed_mps() < STANDING_MPS;
        if !path.leaves() && path.states.last().filter(stands).is_some() {
            after_end.push((path.length_m() + CREEPS_M, 0.0));
        }
        let waiting = ProgressBounds::new(waiting, after_end);
        let brake = manner.brake_mps2;
        let start_mps = manner.entry * path.states.first().map_or(0.0, State::speed_mps);
        let enters_as_it_is = manner.entry == 1.0;
        let mut out =
            Self { along_m: vec![0.0], speed_mps: vec![start_mps], own: usize::from(enters_as_it_is) };
        let (mut along, mut speed, mut own) = (0.0, start_mps, manner.pace == 1.0 && enters_as_it_is);
        for step in path.enters..HORIZON_STEPS {
            let next = step + 1;
            if own {
                let Some(state) = path.states.get(next - path.enters) else { break };
                let (on_m, at_mps) = (path.along_m[next - path.enters], state.speed_mps());
                if bounds.hold(next, on_m, at_mps, manner) {
                    (along, speed) = (on_m, at_mps);
                    out.push(along, speed);
                    out.own += 1;
                    continue;
                }
                own = false;
            }
            let wanted = manner.pace * path.speed_at_mps(along);
            let most = ((wanted - speed) / STEP_S).clamp(-brake, manner.accelerate_mps2);
            let after = |rate: f64| {
                let then = (speed + rate * STEP_S).max(0.0);
                (along + 0.5 * (speed + then) * STEP_S, then)
            };
            let holds = |rate: f64| {
                let (along, speed) = after(rate);
                waiting.hold(next, along, speed, manner)
            };
            let mut rate = greatest(-brake, most, holds);
            let room = least_soon(&waiting.at_m, next) - along;
            if speed < 1e-3 && room < WORTH_GOING_M {
                rate = 0.0;
            }
            (along, speed) = if speed < 1e-3 && rate <= 0.0 { (along, 0.0) } else { after(rate) };
            if speed < AT_REST_MPS && rate <= 0.0 {
                speed = 0.0;
            }
            if path.leaves() && along > path.length_m() {
                break;
            }
            out.push(along, speed);
        }
        out.eased(manner)
    }

    /// The same without jerks: braking begins earlier, and the acceleration changes at a driver's rate.
    fn eased(mut self, manner: YieldManner) -> Self {
        let sharp = self.clone();
        let steps = sharp.speed_mps.len();
        if self.own >= steps {
            return self;
        }
        let jerk = if manner.brake_mps2 > HARD_MPS2 { HARD_JERK_MPS3 } else { JERK_MPS3 } * STEP_S;
        let from = self.own.saturating_sub(EARLIER).max(1);
        self.own = self.own.min(from);
        let before = |i: usize| (sharp.speed_mps[i] - sharp.speed_mps[i.saturating_sub(1)]) / STEP_S;
        let mut rate = before(from - 1);
        for i in from..steps {
            let (along, speed) = (self.along_m[i - 1], self.speed_mps[i - 1]);
            let soon = (i + EARLIER).min(steps - 1);
            let lower = (sharp.speed_mps[soon] - speed) / TRACKS_S;
            let wanted = if lower < 0.0 { lower } else { before(i).max(0.0).min(lower) };
            rate = wanted.clamp(rate - jerk, rate + jerk);
            let mut then = (speed + rate * STEP_S).max(0.0);
            let room_m = (sharp.along_m[i] - along).max(0.0);
            let halts = sharp.speed_mps[i] == 0.0 && sharp.speed_mps[soon] == 0.0;
            if halts && then < HALTS_MPS {
                (then, rate) = (0.0, 0.0);
            }
            let ahead = 0.5 * (speed + then) * STEP_S;
            self.speed_mps[i] = then;
            self.along_m[i] = along + if then == 0.0 && halts { 0.0 } else { ahead.min(room_m) };
        }
        self
    }

    fn push(&mut self, along_m: f64, speed_mps: f64) {
        self.along_m.push(along_m);
        self.speed_mps.push(speed_mps);
    }

    /// Progress at a step of the window; infinite once the agent has left. After the window it continues at
    /// the last speed.
    pub(super) fn along_at(&self, path: &PathProgress, step: usize) -> f64 {
        let at = |step: usize| step.saturating_sub(path.enters);
        let beyond_s = step.saturating_sub(HORIZON_STEPS) as f64 * STEP_S;
        let i = at(step.min(HORIZON_STEPS));
        let there = self.along_m.get(i).zip(self.speed_mps.get(i));
        there.map_or(f64::INFINITY, |(along_m, speed_mps)| along_m + beyond_s * speed_mps)
    }

    /// Whether the agent keeps its own timing to the end.
    pub(super) fn is_own(&self, path: &PathProgress) -> bool {
        self.own == path.states.len()
    }

    /// Its states, one per step from its entry on: the path's own for as long as it keeps to them.
    pub(super) fn states(&self, path: &PathProgress) -> Vec<State> {
        let own = path.states.iter().take(self.own).copied();
        let paced = self.along_m.iter().zip(&self.speed_mps).skip(self.own);
        own.chain(paced.map(|(along, speed)| path.state(*along, *speed))).collect()
    }
}

/// The least bound of the next steps.
fn least_soon(at_m: &[f64], step: usize) -> f64 {
    at_m[step..].iter().take(GOING_STEPS).copied().fold(f64::INFINITY, f64::min)
}

/// The greatest rate in a range that holds; the least if none does.
fn greatest(least: f64, most: f64, holds: impl Fn(f64) -> bool) -> f64 {
    if holds(most) {
        return most;
    }
    if !holds(least) {
        return least;
    }
    let (mut low, mut high) = (least, most);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    const EASY: YieldManner = YieldManner {
        brake_mps2: 2.0,
        accelerate_mps2: 1.5,
        gap_m: 1.0,
        headway_s: 0.0,
        pace: 1.0,
        entry: 1.0,
    };

    fn path(speed_mps: f64) -> PathProgress {
        let at = |i: usize| State { x_m: 0.1 * speed_mps * i as f64, vx_mps: speed_mps, ..State::default() };
        let known: Vec<_> = (0..=HORIZON_STEPS).map(|i| Some(at(i))).collect();
        PathProgress::of(&known, 0.5).unwrap()
    }

    /// From 40 to 46 m, in these steps.
    fn block(from: usize, until: usize) -> PathBlock {
        PathBlock { from, taken: vec![(40.0, 46.0); until - from] }
    }

    #[test]
    fn nobody_in_the_way_changes_nothing() {
        let path = path(8.0);
        let paced = Paced::behind(&path, &[], EASY);
        assert!(paced.is_own(&path) && paced.states(&path) == path.states);
    }

    #[test]
    fn it_stands_before_what_is_in_the_way_and_goes_on() {
        let path = path(8.0);
        let block = block(30, 65);
        let paced = Paced::behind(&path, &[&block], EASY);
        assert!(!paced.is_own(&path) && paced.along_m.len() == 91);
        for step in 30..65 {
            assert!(paced.along_m[step] <= 39.1, "{} at {step}", paced.along_m[step]);
        }
        assert!(paced.along_m[90] > 40.0, "{}", paced.along_m[90]);
        for w in paced.speed_mps.windows(2) {
            let rate = (w[1] - w[0]) / STEP_S;
            assert!((-2.01..=1.51).contains(&rate), "{rate}");
        }
        // It keeps its own motion for as long as that is safe.
        assert!(paced.own > 20, "{}", paced.own);
    }

    #[test]
    fn who_must_stay_stays_without_creeping() {
        let path = path(8.0);
        let block = block(30, 91);
        let paced = Paced::behind(&path, &[&block], EASY);
        let rest = &paced.along_m[75..];
        assert!(rest.iter().all(|a| *a == rest[0]), "{rest:?}");
        assert_eq!(paced.speed_mps[80], 0.0);
    }

    #[test]
    fn what_still_stands_there_when_the_window_ends_is_not_run_into_after_it() {
        let path = path(20.0);
        let stands = PathBlock { from: 60, taken: vec![(182.0, 186.0); 31] };
        let paced = Paced::behind(&path, &[&stands], EASY);
        let (along, speed) = (paced.along_m[90], paced.speed_mps[90]);
        assert!(along + speed * speed / 4.0 < 181.5, "{along} m at {speed} m/s");
    }

    #[test]
    fn an_agent_that_braked_before_it_was_seen_enters_slowly() {
        let path = path(8.0);
        let block = PathBlock { from: 10, taken: vec![(5.0, 9.0); 20] };
        let paced = Paced::behind(&path, &[&block], YieldManner { entry: 0.25, ..EASY });
        let states = paced.states(&path);
        assert!((states[0].speed_mps() - 2.0).abs() < 1e-9 && states.len() == path.states.len());
        assert!(paced.along_m[29] < 4.1, "{}", paced.along_m[29]);
        assert!(paced.along_m[90] > 20.0, "{}", paced.along_m[90]);
    }

    #[test]
    fn it_does_not_pass_where_it_stood_while_it_stood() {
        // Stands at 24 m from 3 s to 6 s.
        let progress = |i: usize| 0.8 * i.min(30).max(i.saturating_sub(30)) as f64;
        let at = |i: usize| {
            let vx_mps = if (30..60).contains(&i) { 0.0 } else { 8.0 };
            State { x_m: progress(i), vx_mps, ..State::default() }
        };
        let known: Vec<_> = (0..=HORIZON_STEPS).map(|i| Some(at(i))).collect();
        let path = PathProgress::of(&known, 0.5).unwrap();
        let early = PathBlock { from: 5, taken: vec![(8.0, 10.0); 10] };
        let paced = Paced::behind(&path, &[&early], EASY);
        assert!(!paced.is_own(&path));
        assert!(paced.along_m[59] <= 24.2, "{}", paced.along_m[59]);
        assert!(paced.along_m[90] > 29.0, "{}", paced.along_m[90]);
    }
}
