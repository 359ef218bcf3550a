//! Red signals on a path: the stop lines that it crosses, and progress that waits at them.

use super::profile::{Caps, Progress, TimedLeg, speed_at};
use super::stop_line::{Steps, StopLine};
use super::world::{AgentAtStart, World};
use crate::tuning::fixed::lights::{
    AT_GOAL_M, AT_LINE_M, BEFORE_LINE_M, BEYOND_M, BRAKE_MPS2, HALTED_MPS, HARDEST_MPS2, IN_QUEUE_M,
    JUMP_MPS2, LATER_M, LEAST_STOP_M, LEAST_WAY_M, NEAR_LINE_M, ON_LANE_M, ONE_JUNCTION_M, PASSED_M,
    PRESSED_SHARE, ROLLING_MPS, SAME_LANE_M, SET_OFF_MPS2, SET_OFF_TO_MPS, STOPPED_MPS, TURN_M, TURNED_M,
};
use scene::limits::Limits;
use scene::motion::Target;
use scene::routes::Polyline;
use scene::{AgentType, HORIZON_STEPS, STEP_S, wrap_angle};
use std::f64::consts::FRAC_PI_4;

/// A turn at red is checked this many steps after the line. An agent that would not be [`TURN_M`] beyond the
/// line by then does not begin the turn.
const TURN_STEPS: usize = 45;
/// Steps after green at which the first agent of a queue leaves, and steps from each agent to the next.
const FIRST_LEAVES_STEPS: usize = 10;
const NEXT_LEAVES_STEPS: usize = 12;
/// Steps over which acceleration is measured.
const SMOOTHED_STEPS: usize = 3;
/// An agent that would leave later than this step stays for the whole window.
const LATEST_LEAVING: usize = 75;

/// A stop line that a path crosses.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    /// Progress of the box centre at which its front is at the line, metres.
    line_m: f64,
    /// Steps of the window at which the signal forbids passing.
    red: Steps,
    /// Steps at which the signal is known to allow passing.
    open: Steps,
    /// The path turns right after the line, which is allowed at red after a stop.
    right: bool,
    /// Number of road users that stand at the line ahead of this one.
    queue: usize,
}

impl Gate {
    /// Progress of the box centre at which its front is at the line, metres.
    pub fn line_m(&self) -> f64 {
        self.line_m
    }

    /// Whether the line is closed at this step of the window.
    pub fn is_red(&self, step: usize) -> bool {
        self.red >> step & 1 == 1
    }

    /// The step at which an agent that stands at this red line from the start sets off. `None` if it stays
    /// red for too long.
    fn leaves(&self) -> Option<usize> {
        let green = (0..=HORIZON_STEPS).find(|i| self.red >> i & 1 == 0).filter(|green| *green > 0)?;
        // An unknown state after the end of the recording is no reason to leave.
        if self.open >> green & 1 == 0 {
            return None;
        }
        let leaves = green + FIRST_LEAVES_STEPS + self.queue * NEXT_LEAVES_STEPS;
        (leaves <= LATEST_LEAVING).then_some(leaves)
    }
}

/// Whether an agent that stands at the first of these stop lines sets off in the window.
pub fn sets_off(gates: &[Gate]) -> bool {
    gates.first().is_some_and(|gate| gate.leaves().is_some())
}

/// Stop lines on a road user's path that are red at some time in the window, nearest first.
pub fn gates(world: &World<'_>, who: &AgentAtStart, path: &Polyline) -> Vec<Gate> {
    let drives = matches!(who.agent_type, AgentType::Vehicle | AgentType::Cyclist);
    if !drives || world.stop_lines.iter().all(|line| line.red() == 0) {
        return Vec::new();
    }
    let end = path.extrapolate(path.length_m() + BEYOND_M).position;
    let longer = Polyline::new(path.points().iter().copied().chain([end]));
    let half_length_m = 0.5 * who.size.length_m;
    let stands = who.start.speed_mps() < STOPPED_MPS;
    let mut crossed: Vec<(f64, f64, &StopLine)> = Vec::new();
    for line in &world.stop_lines {
        let Some(s_m) = line.crossed_by(&longer) else { continue };
        let line_m = s_m - half_length_m;
        if line_m < 0.0 && !(stands && line_m > -PASSED_M) {
            continue;
        }
        let off_m = line.off_lane_m(&longer, s_m, &world.graph);
        if off_m < ON_LANE_M {
            crossed.push((line_m, off_m, line));
        }
    }
    crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let one_junction = crossed.chunk_by(|a, b| b.0 - a.0 < ONE_JUNCTION_M);
    let gate = |lines: &[(f64, f64, &StopLine)]| {
        // The nearest lane decides, unless another equally near lane is open.
        let least = lines.iter().map(|l| l.1).fold(f64::INFINITY, f64::min);
        let taken = || lines.iter().filter(|l| l.1 <= least + SAME_LANE_M);
        let red = taken().fold(Steps::MAX, |red, l| red & l.2.red());
        let line_m = taken().map(|l| l.0).fold(f64::INFINITY, f64::min);
        let heading = |m: f64| longer.sample(line_m + half_length_m + m).heading_rad;
        let right = wrap_angle(heading(TURNED_M) - heading(0.0)) < -FRAC_PI_4;
        let waits_ahead = |other: &&AgentAtStart| {
            let foot = longer.project(other.start.position());
            let standing = other.index != who.index && other.start.speed_mps() < STOPPED_MPS;
            standing && foot.distance_m < IN_QUEUE_M && foot.s_m > 2.0 && foot.s_m < line_m + half_length_m
        };
        let queue = if stands { world.present.iter().filter(waits_ahead).count() } else { 0 };
        let open = taken().fold(0, |open, l| open | l.2.open());
        Gate { line_m, red, open, right, queue }
    };
    one_junction.map(gate).filter(|gate| gate.red != 0).collect()
}

/// An agent that waits at signals on its path.
pub struct Waiting<'a> {
    /// Stop lines on the path, nearest first.
    pub gates: &'a [Gate],
    /// Speed at the start, m/s.
    pub v0: f64,
    /// Limits of its type.
    pub limits: &'a Limits,
    /// The target that it must meet.
    pub target: &'a Target,
    /// Speed caps along the path.
    pub caps: Caps<'a>,
    /// Acceleration with which a standing agent sets off towards a goal, m/s2.
    pub easy_mps2: f64,
}

impl Waiting<'_> {
    /// Progress that waits at red signals; `None` if `wanted` passes none or cannot be changed. An agent that
    /// cannot stop, or would miss its goal time, continues.
    pub fn obeying(&self, wanted: &Progress) -> Option<Progress> {
        let mut changed: Option<Progress> = None;
        for gate in self.gates {
            let now = changed.as_ref().unwrap_or(wanted);
            if let Some(held) = self.held(gate, now) {
                changed = Some(held);
            }
        }
        changed
    }

    /// Progress of an agent that stands at a signal and sets off at the latest when it turns green. `None` if
    /// `wanted` does so already, or if no green is known.
    pub fn setting_off(&self, wanted: &Progress) -> Option<Progress> {
        let gate = self.gates.first().filter(|_| self.v0 < STOPPED_MPS)?;
        let leaves = gate.leaves()?;
        let mut out = *wanted;
        let (mut at_m, mut speed) = (0.0, 0.0);
        let mut later = false;
        for step in leaves..HORIZON_STEPS {
            let next = (speed + SET_OFF_MPS2 * STEP_S).min(self.caps.at(at_m)).max(0.0);
            at_m += 0.5 * (speed + next) * STEP_S;
            speed = next;
            later |= at_m > out[step + 1] + LATER_M;
            out[step + 1] = out[step + 1].max(at_m);
        }
        later.then_some(out)
    }

    /// Progress that waits at one gate.
    fn held(&self, gate: &Gate, wanted: &Progress) -> Option<Progress> {
        let passes =
            |p: &Progress| (1..=HORIZON_STEPS).find(|i| p[*i] > (gate.line_m - NEAR_LINE_M).max(LEAST_WAY_M));
        let is_red = |step: usize| gate.is_red(step);
        let turns = |p: &Progress, step: usize| {
            gate.right
                && stood_before(p, step)
                && p[(step + TURN_STEPS).min(HORIZON_STEPS)] > gate.line_m + TURN_M
        };
        let mut step = passes(wanted).filter(|step| is_red(*step))?;
        if turns(wanted, step) {
            return None;
        }
        let stop_m = (gate.line_m - BEFORE_LINE_M).max(0.0);
        let brake = self.v0 * self.v0 / (2.0 * stop_m.max(LEAST_STOP_M));
        if brake > HARDEST_MPS2 && self.v0 > 0.5 {
            return None;
        }
        let due = self.target.position.map(|_| self.target.step);
        let passes_red = |p: &Progress| passes(p).filter(|step| is_red(*step) && !turns(p, *step));
        // A signal may turn red again before the agent passes, so several green phases are tried.
        for _ in 0..3 {
            let green = (step..=HORIZON_STEPS).find(|i| !is_red(*i));
            let held = match due {
                Some(due) if due >= step => {
                    self.to_goal(stop_m, green.filter(|green| *green < due)?, due, wanted)?
                }
                _ => {
                    let turned = gate.right.then(|| self.free(true, stop_m, green, wanted));
                    let turned = turned.filter(|held| passes_red(held).is_none());
                    turned.unwrap_or_else(|| self.free(false, stop_m, green, wanted))
                }
            };
            match passes_red(&held) {
                Some(again) if again > step => step = again,
                _ => return Some(held),
            }
        }
        None
    }

    /// Brakes for the line, stands there until green (if there is one), then sets off. A goal that is due
    /// earlier keeps its progress until then. An agent that may turn at red sets off after a stop.
    fn free(&self, turns: bool, stop_m: f64, green: Option<usize>, wanted: &Progress) -> Progress {
        let brake = (self.v0 * self.v0 / (2.0 * stop_m.max(LEAST_STOP_M))).max(BRAKE_MPS2);
        let due = self.target.position.map_or(0, |_| self.target.step);
        let fastest = (1..=HORIZON_STEPS).map(|i| speed_at(wanted, i)).fold(SET_OFF_TO_MPS, f64::max);
        let mut out = [0.0; HORIZON_STEPS + 1];
        let (mut speed, mut stood, mut gone) = (self.v0, 0, false);
        for i in 0..HORIZON_STEPS {
            if i < due {
                out[i + 1] = wanted[i + 1];
                speed = speed_at(wanted, i + 1);
                continue;
            }
            stood += usize::from(speed < HALTED_MPS);
            gone |= (turns && stood > 10 && i < TURN_STEPS) || green.is_some_and(|green| i >= green);
            let open = if gone {
                let cap = self.caps.at(out[i]).min(fastest);
                (speed + SET_OFF_MPS2 * STEP_S).min(cap.max(speed - BRAKE_MPS2 * STEP_S))
            } else {
                let left = (stop_m - out[i]).max(0.0);
                speed_at(wanted, i + 1).min((2.0 * brake * left).sqrt()).min(left / STEP_S)
            };
            let hardest = self.limits.brake_mps2 * STEP_S;
            let next = open.max(speed - hardest).max(0.0);
            out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
            speed = next;
        }
        out
    }

    /// Arrives at the line when it turns green, standing or, if that takes too long, rolling; then on to the
    /// goal.
    fn to_goal(&self, stop_m: f64, green: usize, due: usize, wanted: &Progress) -> Option<Progress> {
        let seconds = |steps: usize| steps as f64 * STEP_S;
        let end_mps = self.target.speed_mps;
        ROLLING_MPS.iter().find_map(|rolling| {
            let stands = *rolling == 0.0;
            let before = if stands {
                self.braking(stop_m, green, wanted)
            } else {
                self.arriving(self.v0, 0.0, stop_m + NEAR_LINE_M, seconds(green), Some(*rolling))
            };
            let (from_m, from_mps) = (before[green], if stands { 0.0 } else { *rolling });
            if from_m > stop_m + BEFORE_LINE_M - AT_LINE_M {
                return None;
            }
            let left_m = wanted[due] - from_m;
            let after = self.arriving(from_mps, from_m, left_m, seconds(due - green), end_mps);
            let mut out = before;
            for i in green + 1..=HORIZON_STEPS {
                out[i] = from_m + after[i - green];
            }
            ((out[due] - wanted[due]).abs() < AT_GOAL_M && self.is_possible(&out, due)).then_some(out)
        })
    }

    fn arriving(&self, v0: f64, from_m: f64, length_m: f64, seconds: f64, end_mps: Option<f64>) -> Progress {
        let leg = TimedLeg { v0, from_m, length_m, seconds, end_mps, easy_mps2: self.easy_mps2 };
        let rates = (PRESSED_SHARE * self.limits.accel_mps2, HARDEST_MPS2);
        leg.arriving_in_comfort([(self.caps.clone(), rates)])
    }

    /// Follows the wanted progress until it has to brake for the line, and stands by `green`.
    fn braking(&self, stop_m: f64, green: usize, wanted: &Progress) -> Progress {
        let brake = (self.v0 * self.v0 / (2.0 * stop_m.max(LEAST_STOP_M))).max(BRAKE_MPS2);
        let mut out = [0.0; HORIZON_STEPS + 1];
        let mut speed = self.v0;
        for i in 0..HORIZON_STEPS {
            let left = (stop_m - out[i]).max(0.0);
            // The agent has to stand by `green`, so it keeps at least its start speed until it brakes.
            let open = speed_at(wanted, i + 1).max(self.v0).min((2.0 * brake * left).sqrt());
            let next = open.min(left / STEP_S).min(speed + SET_OFF_MPS2 * STEP_S);
            out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
            speed = next;
            if i >= green {
                break;
            }
        }
        out
    }

    /// Whether a progress stays within the limits up to a step.
    fn is_possible(&self, progress: &Progress, until: usize) -> bool {
        let limits = self.limits;
        let (up, down) = (PRESSED_SHARE * limits.accel_mps2, PRESSED_SHARE * limits.brake_mps2);
        (2..=until).all(|i| {
            let (before, after) = (speed_at(progress, i - 1), speed_at(progress, i));
            let change = (after - before) / STEP_S;
            // A jump of one step is smoothed away later.
            let smooth = i <= SMOOTHED_STEPS
                || (speed_at(progress, i) - speed_at(progress, i - SMOOTHED_STEPS))
                    / (SMOOTHED_STEPS as f64 * STEP_S)
                    <= up;
            smooth && change > -down - JUMP_MPS2 && after <= limits.speed_mps
        })
    }
}

/// Whether a progress stood during the two seconds before a step.
fn stood_before(progress: &Progress, step: usize) -> bool {
    (step.saturating_sub(20).max(1)..=step).any(|i| speed_at(progress, i) < STOPPED_MPS)
}
