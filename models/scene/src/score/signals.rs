//! Red-light violations: the front crosses the stop line while the signal of its lane says stop.

use super::input::{Actor, ScoreInput};
use super::report::{RedLight, time_of};
use crate::geometry::polyline::{Polyline, Pose};
use crate::geometry::{Extent, Vec2, cross, wrap_angle};
use crate::{AgentType, Signal, SignalState};
use std::collections::HashMap;
use std::f64::consts::FRAC_PI_4;

/// A road user takes a lane if its mean distance from the centre is below this, metres.
const ON_LANE_M: f64 = 1.5;
/// Lanes whose distances differ by less count as equally near, metres.
const SAME_LANE_M: f64 = 0.3;
/// Length of path after (or before) the line that decides which lane is taken, metres.
const TELLING_M: f64 = 20.0;

/// Crossings of lines within this many steps belong to one junction.
const SAME_JUNCTION_STEPS: usize = 10;
/// A road user that ends this near before a line waits there, metres.
const WAITING_M: f64 = 15.0;

/// Stop line of a signal.
pub(crate) struct SignalStopLine<'a> {
    signal: &'a Signal,
    line: Polyline,
    at: Pose,
    /// Unit vector along the lane there.
    ahead: Vec2,
    half_width_m: f64,
    /// The signal's lane continues behind the stop line, through the junction; otherwise it ends there.
    goes_on: bool,
}

/// The stop lines of the input's signals.
pub(crate) fn stop_lines<'a>(input: &ScoreInput<'a>) -> Vec<SignalStopLine<'a>> {
    if input.signals.is_empty() {
        return Vec::new();
    }
    let lanes: HashMap<&str, &crate::map::Lane> =
        input.map.lanes.iter().map(|l| (l.id.as_str(), l)).collect();
    let stop_line = |signal: &'a Signal| {
        let lane = lanes.get(signal.lane.as_str())?;
        let line = Polyline::new(lane.points.xy.iter().copied());
        // Without a stop point: lanes through a junction are controlled at their start, others at their end.
        let default_m = if lane.interpolating { 0.0 } else { line.length_m() };
        let s_m = signal.stop.map_or(default_m, |p| line.project(p).s_m);
        let mut at = line.sample(s_m);
        at.position = signal.stop.unwrap_or(at.position);
        let goes_on = line.length_m() - s_m > 5.0;
        let ahead = at.direction();
        Some(SignalStopLine {
            signal,
            at,
            ahead,
            goes_on,
            half_width_m: 0.5 * lane.width_or_assumed_m() + 0.25,
            line,
        })
    };
    input.signals.iter().filter_map(stop_line).collect()
}

/// One crossing of one line.
struct LineCrossing<'a, 'b> {
    line: &'b SignalStopLine<'a>,
    step: usize,
    part: f64,
}

impl LineCrossing<'_, '_> {
    /// Whether the line's signal says stop at that time.
    fn must_stop(&self) -> bool {
        let state = self.line.signal.at(self.step);
        state.is_stop() && state != SignalState::FlashingStop
    }
}

/// Lines that a vehicle or cyclist crosses at red.
///
/// If several lanes fork at one line, the lane that the road user takes decides. Flashing red counts as a
/// stop sign and is ignored. A right turn after a stop is allowed if the thresholds say so.
pub(crate) fn crossed_at_red(
    input: &ScoreInput<'_>,
    actor: &Actor<'_>,
    lines: &[SignalStopLine<'_>],
) -> Vec<RedLight> {
    let rides = matches!(actor.agent_type, AgentType::Vehicle | AgentType::Cyclist);
    if lines.is_empty() || !rides || actor.travel_m(input.steps.clone()) <= 1.0 {
        return Vec::new();
    }
    let places = || input.steps.clone().filter_map(|i| actor.state(i)).map(crate::State::position);
    let extent = Extent::of(places());
    let mut crossings: Vec<LineCrossing<'_, '_>> = Vec::new();
    for line in lines {
        if extent.outside_m(line.at.position) > 0.5 * actor.size.length_m + line.half_width_m {
            continue;
        }
        for step in input.steps.clone() {
            if let Some(part) = crosses(actor, line, step) {
                crossings.push(LineCrossing { line, step, part });
            }
        }
    }
    crossings.sort_by_key(|c| c.step);
    let mut found = Vec::new();
    // Crossings within a second belong to one junction: the nearest lane decides, unless an equally near lane
    // lets it pass. An agent on none of these lanes, nor on one without a signal, is bound by all of them.
    for group in crossings.chunk_by(|a, b| b.step - a.step < SAME_JUNCTION_STEPS) {
        let allowed = input.thresholds.right_on_red && turns_right_after_stop(actor, group[0].step);
        if allowed || !group.iter().any(LineCrossing::must_stop) {
            continue;
        }
        let off_lanes_m: Vec<f64> =
            group.iter().map(|c| off_lane_m(actor, c.line, c.step, input.steps.end)).collect();
        let least = off_lanes_m.iter().copied().fold(f64::INFINITY, f64::min);
        let most = if least < ON_LANE_M { (least + SAME_LANE_M).min(ON_LANE_M) } else { f64::INFINITY };
        let taken = || group.iter().zip(&off_lanes_m).filter(|(_, off_m)| **off_m <= most).map(|(c, _)| c);
        if !taken().all(LineCrossing::must_stop) {
            continue;
        }
        if most.is_infinite() && takes_a_free_lane(input, actor, group[0].step, lines) {
            continue;
        }
        if let (Some(c), Some(state)) = (taken().next(), actor.state(group[0].step)) {
            found.push(RedLight {
                agent: actor.id.to_owned(),
                lane: c.line.signal.lane.clone(),
                time_s: time_of(c.step as f64 + c.part),
                speed_mps: state.speed_mps(),
                in_log: false,
            });
        }
    }
    found
}

/// State of the signal whose stop line a road user passes first, at that time. For a road user that stands at
/// a line at its end, the state then. At a fork the lane that it takes decides. `None` without a line.
pub(crate) fn signal_passed(
    input: &ScoreInput<'_>,
    actor: &Actor<'_>,
    lines: &[SignalStopLine<'_>],
) -> Option<SignalState> {
    let end = input.steps.end;
    let passed = |line| input.steps.clone().find(|step| crosses(actor, line, *step).is_some());
    let passed: Vec<_> = lines.iter().filter_map(|line| Some((passed(line)?, line))).collect();
    if let Some(first) = passed.iter().map(|(step, _)| *step).min() {
        let junction = passed.into_iter().filter(|(step, _)| step - first < SAME_JUNCTION_STEPS);
        let off = |of: &(usize, &SignalStopLine<'_>)| off_lane_m(actor, of.1, of.0, end);
        let (step, line) = junction.min_by(|p, q| off(p).total_cmp(&off(q)))?;
        return Some(line.signal.at(step));
    }
    let last = input.steps.clone().rev().find(|step| actor.state(*step).is_some())?;
    let state = actor.state(last)?;
    let waits = |line: &&SignalStopLine<'_>| {
        let before = line.at.position - state.position();
        let ahead_m = before.dot(&line.ahead) - 0.5 * actor.size.length_m;
        let along = crate::geometry::direction(state.heading_rad).dot(&line.ahead) > 0.5;
        along && (0.0..=WAITING_M).contains(&ahead_m) && cross(line.ahead, before).abs() <= line.half_width_m
    };
    lines.iter().find(waits).map(|line| line.signal.at(last))
}

/// Whether it takes a lane without a signal behind the line.
fn takes_a_free_lane(
    input: &ScoreInput<'_>,
    actor: &Actor<'_>,
    step: usize,
    lines: &[SignalStopLine<'_>],
) -> bool {
    let place = |i: usize| actor.state(i).map(crate::State::position);
    let Some(here) = place(step) else { return false };
    let told: Vec<Vec2> =
        (step..input.steps.end).map_while(place).take_while(|p| (p - here).norm() <= TELLING_M).collect();
    let free = input.map.lanes.iter().filter(|lane| {
        lane.lane_type.carries_vehicles() && !lines.iter().any(|line| line.signal.lane == lane.id)
    });
    free.filter(|lane| lane.points.xy.iter().any(|p| (p - here).norm() <= TELLING_M)).any(|lane| {
        let line = Polyline::new(lane.points.xy.iter().copied());
        let off: f64 = told.iter().map(|p| line.project(*p).distance_m).sum();
        off / (told.len() as f64) < ON_LANE_M
    })
}

/// Whether the front crosses the line between this step and the next, in the lane's direction; returns the
/// share of the step, 0 to 1.
fn crosses(actor: &Actor<'_>, line: &SignalStopLine<'_>, step: usize) -> Option<f64> {
    let (from, to) = (actor.state(step)?, actor.state(step + 1)?);
    let (ahead, reach) = (line.ahead, 0.5 * actor.size.length_m);
    // The front passes the line between the two.
    let moved = (to.position() - from.position()).norm() + 2.0 * reach;
    if (to.position() - line.at.position).norm_squared() > (reach + line.half_width_m + moved).powi(2) {
        return None;
    }
    let front = |s: &crate::State| {
        let forward = crate::geometry::direction(s.heading_rad);
        (s.position() + forward * reach - line.at.position, forward)
    };
    let ((before, forward), (after, _)) = (front(from), front(to));
    let (u0, u1) = (before.dot(&ahead), after.dot(&ahead));
    let in_lane = cross(ahead, after).abs() <= line.half_width_m;
    (u0 <= 0.0 && u1 > 0.0 && in_lane && forward.dot(&ahead) > 0.5).then(|| -u0 / (u1 - u0))
}

/// Mean distance of the centre from the signal's lane over that length of path.
fn off_lane_m(actor: &Actor<'_>, line: &SignalStopLine<'_>, step: usize, end: usize) -> f64 {
    let Some(here) = actor.state(step).map(crate::State::position) else { return f64::INFINITY };
    let within = |p: &Vec2| (p - here).norm() <= TELLING_M;
    let place = |i: usize| actor.state(i).map(crate::State::position);
    let places: Vec<Vec2> = if line.goes_on {
        // From where the centre is on the lane.
        let past = |p: &Vec2| (p - line.at.position).dot(&line.ahead) >= 0.0;
        (step..end).map_while(place).skip_while(|p| !past(p)).take_while(within).collect()
    } else {
        (0..=step).rev().map_while(place).take_while(within).collect()
    };
    if places.is_empty() {
        return cross(line.ahead, here - line.at.position).abs();
    }
    places.iter().map(|p| line.line.project(*p).lateral_m.abs()).sum::<f64>() / places.len() as f64
}

/// Whether it turns right by more than 45 degrees in the six seconds after the line, and stood in the three
/// seconds before it.
fn turns_right_after_stop(actor: &Actor<'_>, step: usize) -> bool {
    let stood = (step.saturating_sub(30)..=step).filter_map(|i| actor.state(i)).any(|s| s.speed_mps() < 1.0);
    let later = (step..=step + 60).rev().find_map(|i| actor.state(i));
    let turn = actor.state(step).zip(later).map_or(0.0, |(a, b)| wrap_angle(b.heading_rad - a.heading_rad));
    stood && turn < -FRAC_PI_4
}

#[cfg(test)]
mod tests {
    use super::super::tests::{input_of, lane, straight};
    use super::*;
    use crate::LaneMap;
    use crate::score::Drivable;

    fn signal(lane: &str, runs: &[(usize, SignalState)]) -> Signal {
        Signal { lane: lane.into(), stop: Some(Vec2::new(40.0, 0.0)), stop_z_m: None, runs: runs.to_vec() }
    }

    /// East at 10 m/s from x = 0, front at x + 2, over a line at x = 40: crosses after 3.8 s.
    fn run(signals: &[Signal]) -> Vec<(String, f64)> {
        let left: Vec<(f64, f64)> = (0..=9)
            .map(|i| f64::from(i) * 0.17)
            .map(|h| (40.0 + 20.0 * h.sin(), 20.0 - 20.0 * h.cos()))
            .collect();
        let map = LaneMap {
            lanes: vec![lane("through", &[(40.0, 0.0), (100.0, 0.0)]), lane("left", &left)],
            ..LaneMap::default()
        };
        let drivable = Drivable::default();
        let mut input = input_of(vec![straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0)], &drivable);
        (input.map, input.signals) = (&map, signals);
        let lines = stop_lines(&input);
        crossed_at_red(&input, &input.actors[0], &lines).into_iter().map(|r| (r.lane, r.time_s)).collect()
    }

    #[test]
    fn only_at_red() {
        use SignalState::{Caution, FlashingStop, Go, Stop};
        assert_eq!(run(&[signal("through", &[(0, Stop)])]), [("through".to_owned(), 3.8)]);
        assert_eq!(run(&[signal("through", &[(0, Go), (37, Stop)])]), [("through".to_owned(), 3.8)]);
        assert!(run(&[signal("through", &[(0, Stop), (37, Go)])]).is_empty());
        assert!(run(&[signal("through", &[(0, Caution), (60, Stop)])]).is_empty());
        assert!(run(&[signal("through", &[(0, FlashingStop)])]).is_empty());
        assert!(run(&[]).is_empty() && run(&[signal("unknown", &[(0, Stop)])]).is_empty());
    }

    #[test]
    fn the_state_passed_is_that_of_the_lane_taken() {
        use SignalState::{ArrowStop, Go, Stop};
        let passed = |signals: &[Signal], speed_mps: f64| {
            let map = LaneMap {
                lanes: vec![
                    lane("through", &[(40.0, 0.0), (100.0, 0.0)]),
                    lane("left", &[(40.0, 0.0), (40.0, 50.0)]),
                ],
                ..LaneMap::default()
            };
            let drivable = Drivable::default();
            let mut input =
                input_of(vec![straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, speed_mps)], &drivable);
            (input.map, input.signals) = (&map, signals);
            signal_passed(&input, &input.actors[0], &stop_lines(&input))
        };
        let signals = [signal("left", &[(0, ArrowStop)]), signal("through", &[(0, Stop), (20, Go)])];
        assert_eq!(passed(&signals, 10.0), Some(Go));
        // It ends 5 m before the line, or 20 m.
        assert_eq!(passed(&signals[1..], 33.0 / 9.0), Some(Go));
        assert_eq!(passed(&signals, 2.0), None);
        assert_eq!(passed(&[], 10.0), None);
    }

    #[test]
    fn the_lane_taken_decides() {
        use SignalState::{ArrowStop, Go, Stop};
        let (left_red, through_green) = (signal("left", &[(0, ArrowStop)]), signal("through", &[(0, Go)]));
        assert!(run(&[left_red.clone(), through_green]).is_empty());
        let left_green = signal("left", &[(0, Go)]);
        assert_eq!(run(&[left_green, signal("through", &[(0, Stop)])]).len(), 1);
        assert!(run(&[left_red]).is_empty());
    }

    #[test]
    fn who_takes_no_lane_behind_the_line_is_bound_by_all() {
        use SignalState::{Go, Stop};
        // An immediate right turn, where no lane leads.
        let map =
            LaneMap { lanes: vec![lane("through", &[(40.0, 0.0), (100.0, 0.0)])], ..LaneMap::default() };
        let drivable = Drivable::default();
        let turns = |signals: &[Signal]| {
            let mut car = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
            for (i, state) in car.track.to_mut().states.iter_mut().flatten().enumerate().skip(41) {
                let past_m = i as f64 - 41.0;
                (state.x_m, state.y_m, state.heading_rad) = (41.0, -past_m, -1.57);
            }
            let mut input = input_of(vec![car], &drivable);
            (input.map, input.signals) = (&map, signals);
            let lines = stop_lines(&input);
            crossed_at_red(&input, &input.actors[0], &lines).len()
        };
        assert_eq!(turns(&[signal("through", &[(0, Stop)])]), 1);
        assert_eq!(turns(&[signal("through", &[(0, Go)])]), 0);
    }
}
