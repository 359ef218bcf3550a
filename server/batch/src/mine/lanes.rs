//! Lane changes and U-turns.

use super::{MinedEvent, MinedTag, time_s};
use scene::geometry::direction;
use scene::judge::manoeuvre::{ALONG_LANE_RAD, ON_LANE_M, ROUND_RAD};
use scene::judge::{Manoeuvre, manoeuvre};
use scene::routes::LaneGraph;
use scene::score::{Actor, ScoreInput};
use scene::{AgentType, HORIZON_STEPS, State, Vec2, wrap_angle};
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;

/// Steps between lane look-ups.
const STRIDE: usize = 5;
/// Number of look-ups before and after a change that distinguish it from swaying.
const SURE: usize = 2;
/// Steps before and after the change over which the manoeuvre is classified.
const AROUND: usize = 30;
/// Lowest speed of a vehicle that changes lanes, m/s.
const DRIVES_MPS: f64 = 2.0;
/// Lanes whose distances differ by less count as equally near, metres.
const SAME_LANE_M: f64 = 0.5;
/// Greatest distance of a follower from the lane, metres.
const IN_LANE_M: f64 = 1.6;
/// Greatest heading difference of a follower, radians.
const ALIKE_RAD: f64 = 0.5;
/// Time gap to the follower below which a lane change is a cut-in, seconds.
const CUT_IN_S: f64 = 1.5;
/// Smallest extent of a U-turn, metres, which excludes jittering boxes.
const LEAST_EXTENT_M: f64 = 4.0;
/// Smallest distance between samples of a path, metres.
const APART_M: f64 = 1.0;
/// A longer distance between samples is a jump of the recording, metres.
const JUMP_M: f64 = 8.0;
/// A larger change of heading is an error of the recording or a circle, radians.
const MOST_ROUND_RAD: f64 = 4.5;
/// Steps after the change at which the gap to the follower is measured, when the vehicle is in its new lane.
const SETTLED: usize = SURE * STRIDE;

/// A lane change.
pub(super) struct LaneChange {
    /// Scene step at which the middle of the vehicle enters the new lane.
    pub(super) step: usize,
}

/// The lane changes of a vehicle.
pub(super) fn changes(input: &ScoreInput<'_>, actor: &Actor<'_>, graph: &LaneGraph) -> Vec<LaneChange> {
    if actor.agent_type != AgentType::Vehicle {
        return Vec::new();
    }
    let mut lanes: Vec<(usize, Option<usize>)> = Vec::new();
    for step in input.steps.clone().step_by(STRIDE) {
        let last = lanes.last().and_then(|(_, lane)| *lane);
        lanes.push((step, actor.state(step).and_then(|state| lane_of(graph, state, last))));
    }
    let mut found: Vec<LaneChange> = Vec::new();
    for k in SURE..lanes.len().saturating_sub(SURE) {
        let (step, Some(new)) = lanes[k] else { continue };
        let Some(old) = lanes[k - 1].1 else { continue };
        let is_beside = graph.lanes()[old].beside().any(|beside| beside.same_direction && beside.lane == new);
        let drives = actor.state(step).is_some_and(|state| state.speed_mps() >= DRIVES_MPS);
        let is_sure = || {
            let path = &graph.lanes()[new].path;
            let aside = |k: usize| {
                let (step, _) = lanes.get(k)?;
                Some(path.project(actor.state(*step)?.position()).lateral_m)
            };
            // From well beside the new lane to well inside it.
            let (Some(before), Some(after)) = (aside(k - SURE), aside(k + SURE)) else { return false };
            before.abs() - after.abs() > 1.0
                && lanes[k + 1..=k + SURE].iter().all(|(_, lane)| *lane != Some(old))
        };
        let is_new = found.last().is_none_or(|last| step - last.step > AROUND / 2);
        if is_beside && drives && is_new && is_sure() && is_told(input, actor, graph, step) {
            found.push(LaneChange { step });
        }
    }
    found
}

/// Whether the manoeuvre around a step is classified as a lane change.
fn is_told(input: &ScoreInput<'_>, actor: &Actor<'_>, graph: &LaneGraph, step: usize) -> bool {
    let first = step.saturating_sub(AROUND).max(input.steps.start);
    let states: Vec<State> =
        (first..(step + AROUND).min(input.steps.end)).filter_map(|step| actor.state(step).copied()).collect();
    let told = manoeuvre(&states, actor.agent_type, Some(graph));
    matches!(told, Some(Manoeuvre::LaneLeft | Manoeuvre::LaneRight))
}

/// The lane of a state: the previous one or one of its successors, if they are as near as any.
fn lane_of(graph: &LaneGraph, state: &State, last: Option<usize>) -> Option<usize> {
    let near = graph.nearest_for(state.position(), ON_LANE_M, AgentType::Vehicle);
    let mut along =
        near.into_iter().filter(|hit| wrap_angle(hit.heading_rad - state.heading_rad).abs() < ALONG_LANE_RAD);
    let first = along.next()?;
    let goes_on =
        |lane: usize| last.is_some_and(|last| last == lane || graph.lanes()[last].successors.contains(&lane));
    if goes_on(first.lane) {
        return Some(first.lane);
    }
    let alike = along.take_while(|hit| hit.distance_m < first.distance_m + SAME_LANE_M);
    Some(alike.map(|hit| hit.lane).find(|lane| goes_on(*lane)).unwrap_or(first.lane))
}

/// The close follower after a change, and its time gap, seconds.
pub(super) fn follower<'a>(
    input: &'a ScoreInput<'_>,
    actor: &Actor<'_>,
    change: &LaneChange,
) -> Option<(&'a Actor<'a>, f64)> {
    let step = change.step + SETTLED;
    let own = actor.state(step)?;
    let (ahead, left) = (direction(own.heading_rad), direction(own.heading_rad + FRAC_PI_2));
    let behind = input.actors.iter().filter(|other| other.id != actor.id).filter_map(|other| {
        let state = other.state(step)?;
        let apart = own.position() - state.position();
        let gap_m = apart.dot(&ahead) - 0.5 * (actor.size.length_m + other.size.length_m);
        let is_behind = apart.dot(&ahead) > 0.0
            && apart.dot(&left).abs() < IN_LANE_M
            && wrap_angle(own.heading_rad - state.heading_rad).abs() < ALIKE_RAD
            && state.speed_mps() > DRIVES_MPS;
        is_behind.then(|| (other, gap_m.max(0.0) / state.speed_mps()))
    });
    behind.filter(|(_, headway_s)| *headway_s < CUT_IN_S).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The U-turns of a vehicle or cyclist, from its positions, because boxes of standing ones may flip. One
/// event per run of windows with a U-turn.
pub(super) fn turns_round(input: &ScoreInput<'_>, actor: &Actor<'_>) -> Vec<MinedEvent> {
    let mut found: Vec<MinedEvent> = Vec::new();
    if !matches!(actor.agent_type, AgentType::Vehicle | AgentType::Cyclist) {
        return found;
    }
    let mut until = 0;
    for first in input.steps.clone().step_by(HORIZON_STEPS / 2) {
        let end = (first + HORIZON_STEPS + 1).min(input.steps.end);
        let turned = turned(actor, first..end);
        let turn_rad: f64 = turned.last().map_or(0.0, |(_, turn_rad)| *turn_rad);
        let half = turned.iter().find(|(_, so_far)| so_far.abs() > 0.5 * turn_rad.abs());
        let Some(((step, _), state)) = half.and_then(|half| Some((half, actor.state(half.0)?))) else {
            continue;
        };
        let is_round = turn_rad.abs() > ROUND_RAD && turn_rad.abs() < MOST_ROUND_RAD;
        if is_round && first >= until && extent_m(actor, first..end) >= LEAST_EXTENT_M {
            found.push(MinedEvent {
                tag: MinedTag::UTurn,
                actor: actor.id.to_owned(),
                other: None,
                time_s: time_s(*step),
                x_m: state.x_m,
                y_m: state.y_m,
                value: Some(turn_rad),
            });
            until = end;
        }
    }
    found
}

/// Greatest distance of a road user from its first place in a window.
fn extent_m(actor: &Actor<'_>, window: Range<usize>) -> f64 {
    let mut places = window.filter_map(|step| actor.state(step)).map(State::position);
    let first = places.next().unwrap_or_default();
    places.map(|place| (place - first).norm()).fold(0.0, f64::max)
}

/// Change of a road user's direction of motion by step of a window, radians. Jumps and turns on the spot
/// count as standing.
fn turned(actor: &Actor<'_>, window: Range<usize>) -> Vec<(usize, f64)> {
    let (mut all, mut turn_rad): (Vec<(usize, f64)>, f64) = (Vec::new(), 0.0);
    let (mut place, mut way): (Option<Vec2>, Option<f64>) = (None, None);
    for step in window {
        let Some(state) = actor.state(step) else { continue };
        let moved = place.map_or(Vec2::zeros(), |place| state.position() - place);
        if place.is_some() && moved.norm() < APART_M {
            continue;
        }
        place = Some(state.position());
        // Driving backwards is not a turn.
        let goes_ahead = moved.dot(&direction(state.heading_rad)) > 0.7 * moved.norm();
        if goes_ahead && moved.norm() < JUMP_M {
            let now = moved.y.atan2(moved.x);
            turn_rad += way.map_or(0.0, |way| wrap_angle(now - way));
            way = Some(now);
            all.push((step, turn_rad));
        }
    }
    all
}
