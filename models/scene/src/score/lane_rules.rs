//! Lane rules for one vehicle: the speed limit, the heading at its end, and the end of the map's roads.

use super::input::{Actor, ScoreInput};
use super::report::{Stretch, stretches};
use super::road::{PARKED_M, drives};
use crate::geometry::direction;
use crate::{AgentType, STEP_S, State, Vec2};

/// Shortest time above the limit that counts, seconds.
pub(super) const SPEEDING_S: f64 = 1.0;
/// Mean deceleration since the start above which a vehicle is not speeding, m/s2: it was too fast already.
const SLOWING_MPS2: f64 = 0.5;
/// Cosine of the heading difference beyond which a lane leads elsewhere.
const ELSEWHERE: f64 = 0.5;
/// A lane that turns more within this distance of the place is a bend, metres: its direction there is no
/// measure.
const BEND_M: f64 = 4.0;

/// The step at which a motion ends: when its goal is due, else its last.
pub(crate) fn end_step(input: &ScoreInput<'_>, actor: &Actor<'_>) -> Option<usize> {
    let last = input.steps.clone().rev().find(|step| actor.state(*step).is_some())?;
    let due = actor.goal.time_s.filter(|_| actor.generated && actor.goal.position.is_some());
    let due = due.map_or(last, |time_s| (time_s / STEP_S).round().max(0.0) as usize);
    Some(due.clamp(input.steps.start, last))
}

/// The end of a vehicle's motion if its heading deviates from the direction of every lane there; `worst` in
/// radians. Bends, junctions, driveways and headings fixed by the user are excluded.
pub(crate) fn ends_askew(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    let asked = actor.generated && actor.goal.heading_rad.is_some();
    if !drives(actor) || asked || actor.travel_m(input.steps.clone()) < PARKED_M {
        return Vec::new();
    }
    let found = end_step(input, actor).and_then(|step| Some((step, actor.state(step)?)));
    let Some((step, state)) = found.filter(|(_, s)| !input.drivable.is_driveway(s.position())) else {
        return Vec::new();
    };
    let forward = direction(state.heading_rad);
    let mut least_rad: Option<f64> = None;
    let reach = [-BEND_M, 0.0, BEND_M].map(|m| state.position() + forward * m);
    for (lane, band) in reach.iter().flat_map(|point| input.drivable.vehicle_lanes(*point)) {
        if band.in_junction {
            return Vec::new();
        }
        let along = (lane.to - lane.from).normalize();
        let turn_rad = along.dot(&forward).abs().min(1.0).acos();
        least_rad = Some(least_rad.map_or(turn_rad, |least| least.min(turn_rad)));
    }
    let on_lane = input.drivable.vehicle_lanes(state.position()).next().is_some();
    let askew = least_rad.filter(|rad| on_lane && *rad > input.thresholds.askew_rad);
    askew.map(|rad| stretches(actor, &[(step, rad)])).unwrap_or_default()
}

/// Stretches of at least [`SPEEDING_S`] above the speed limit of every lane in the vehicle's direction;
/// `worst` in m/s above the limit.
pub(crate) fn speeding(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    if !drives(actor) {
        return Vec::new();
    }
    let (share, extra_mps) = (input.thresholds.speeding_share, input.thresholds.speeding_mps);
    let mut flagged: Vec<(usize, f64)> = Vec::new();
    let mut start: Option<(usize, f64)> = None;
    let mut fast_since_start = true;
    for step in input.steps.clone() {
        let Some(state) = actor.state(step) else { continue };
        let speed = state.speed_mps();
        let &mut (first, first_mps) = start.get_or_insert((step, speed));
        // A cheap test before the lanes are searched: no limit is lower.
        if speed <= extra_mps {
            fast_since_start = false;
            continue;
        }
        let forward = direction(state.heading_rad);
        let limits = input.drivable.vehicle_lanes(state.position()).filter_map(|(lane, band)| {
            let along = lane.to - lane.from;
            let leads = along.dot(&forward) >= ELSEWHERE * along.norm();
            band.speed_limit_mps.filter(|_| leads)
        });
        let limit = limits.reduce(f64::max);
        let above = limit.filter(|limit| speed > limit * (1.0 + share) + extra_mps);
        fast_since_start &= above.is_some();
        let slowed_to_mps = first_mps - SLOWING_MPS2 * STEP_S * (step - first) as f64;
        let slowing = fast_since_start && step > first && speed <= slowed_to_mps + 1e-9;
        if let Some(limit) = above.filter(|_| !slowing) {
            flagged.push((step, speed - limit));
        }
    }
    lasting(stretches(actor, &flagged), SPEEDING_S)
}

/// Stretches of wheeled road users beyond the end of the map's roads; `worst` in metres from the lanes.
pub(crate) fn off_map(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    let rides = actor.agent_type == AgentType::Cyclist || drives(actor);
    if !rides || input.drivable.is_unknown() {
        return Vec::new();
    }
    let reach_m = input.thresholds.off_map_m;
    let mut flagged: Vec<(usize, f64)> = Vec::new();
    // A place near a lane, and the radius in which all places are near that lane too.
    let mut near: Option<(Vec2, f64)> = None;
    for step in input.steps.clone() {
        let Some(place) = actor.state(step).map(State::position) else { continue };
        if near.is_some_and(|(centre, radius_m)| (place - centre).norm() < radius_m) {
            continue;
        }
        near = input.drivable.lane_away_m(place, reach_m).map(|away_m| (place, reach_m - away_m));
        let away_m = if near.is_none() { input.drivable.off_map_m(place, reach_m) } else { None };
        flagged.extend(away_m.map(|away_m| (step, away_m)));
    }
    stretches(actor, &flagged)
}

/// Stretches that last at least this long.
pub(super) fn lasting(mut stretches: Vec<Stretch>, seconds: f64) -> Vec<Stretch> {
    stretches.retain(|s| s.until_s - s.time_s >= seconds - 1e-6);
    stretches
}

#[cfg(test)]
mod tests {
    use super::super::tests::{input_of, lane, straight, track_of};
    use super::super::{Drivable, ScoreInput};
    use super::*;
    use crate::map::Lane;
    use crate::{Goal, LaneMap, State, Vec2};
    use std::borrow::Cow;

    fn street(limit_mps: Option<f64>) -> Lane {
        Lane { speed_limit_mps: limit_mps, ..lane("east", &[(-20.0, 0.0), (200.0, 0.0)]) }
    }

    fn drivable(lane: Lane) -> Drivable {
        Drivable::new(&LaneMap { lanes: vec![lane], ..LaneMap::default() })
    }

    /// On the lane to the east, at this speed at each time.
    fn driven(speed: impl Fn(f64) -> f64) -> Actor<'static> {
        let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        let mut x_m = 0.0;
        let states = (0..91).map(|i| {
            let vx_mps = speed(i as f64 * STEP_S);
            x_m += vx_mps * STEP_S;
            Some(State { x_m, vx_mps, ..State::default() })
        });
        actor.track.to_mut().states = states.collect();
        actor
    }

    #[test]
    fn above_the_limit_by_more_than_the_tolerance_for_a_second_is_speeding() {
        let found = |limit: Option<f64>, speed: &dyn Fn(f64) -> f64| {
            let drivable = drivable(street(limit));
            let input = input_of(vec![driven(speed)], &drivable);
            speeding(&input.actors[0], &input)
        };
        // At a limit of 10 m/s, 12.4 m/s is allowed.
        let fast = found(Some(10.0), &|_| 13.0);
        assert_eq!((fast.len(), fast[0].time_s, fast[0].until_s), (1, 0.0, 9.0));
        assert!((fast[0].worst.unwrap() - 3.0).abs() < 1e-9);
        assert!(found(Some(10.0), &|_| 12.3).is_empty(), "within the tolerance");
        assert!(found(None, &|_| 30.0).is_empty(), "no limit is known");
        let for_s = |seconds: f64| move |t: f64| if (2.0..2.05 + seconds).contains(&t) { 13.0 } else { 10.0 };
        assert_eq!((found(Some(10.0), &for_s(0.8)).len(), found(Some(10.0), &for_s(1.0)).len()), (0, 1));
    }

    #[test]
    fn who_starts_too_fast_and_slows_down_is_not_speeding() {
        let drivable = drivable(street(Some(10.0)));
        let found = |speed: &dyn Fn(f64) -> f64| {
            let input = input_of(vec![driven(speed)], &drivable);
            speeding(&input.actors[0], &input).len()
        };
        assert_eq!(found(&|t| (16.0 - 0.8 * t).max(12.0)), 0);
        assert_eq!(found(&|t| 16.0 - 0.1 * t), 1);
    }

    fn askew_rad(map: &LaneMap, turn_rad: f64, change: impl Fn(&mut Actor<'_>)) -> Option<f64> {
        let drivable = Drivable::new(map);
        let mut actor = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        // It turns in the last half second.
        let state = |i: usize| {
            let heading_rad = if i > 85 { turn_rad } else { 0.0 };
            State { x_m: i as f64, heading_rad, vx_mps: 10.0, ..State::default() }
        };
        actor.track = Cow::Owned(track_of(state));
        change(&mut actor);
        let input = ScoreInput { map, ..input_of(vec![actor], &drivable) };
        ends_askew(&input.actors[0], &input).first().and_then(|s| s.worst)
    }

    #[test]
    fn the_end_across_a_lane_is_askew() {
        let map = LaneMap { lanes: vec![street(None)], ..LaneMap::default() };
        let turned = |rad: f64| askew_rad(&map, rad, |_| ());
        assert!((turned(0.4).unwrap() - 0.4).abs() < 1e-9 && turned(0.2).is_none());
        assert!((turned(2.6).unwrap() - (std::f64::consts::PI - 2.6)).abs() < 1e-9);
        let due_at_4 = Goal { position: Some(Vec2::new(40.0, 0.0)), time_s: Some(4.0), ..Goal::default() };
        assert_eq!(
            askew_rad(&map, 0.4, |a| a.goal = due_at_4),
            None,
            "it was along the lane when it was due"
        );
        let fixed = Goal { heading_rad: Some(0.4), ..Goal::default() };
        assert_eq!(askew_rad(&map, 0.4, |a| a.goal = fixed), None, "the user asked for it");
        let beside =
            |a: &mut Actor<'_>| a.track.to_mut().states.iter_mut().flatten().for_each(|s| s.y_m = 9.0);
        assert_eq!(askew_rad(&map, 0.4, beside), None, "off the lanes");
    }

    #[test]
    fn in_junctions_bends_and_other_lanes_that_fit_nothing_is_askew() {
        let junction = Lane { interpolating: true, ..street(None) };
        assert_eq!(askew_rad(&LaneMap { lanes: vec![junction], ..LaneMap::default() }, 0.4, |_| ()), None);
        let other = lane("other", &[(60.0, -12.0), (120.0, 12.0)]);
        let map = LaneMap { lanes: vec![street(None), other], ..LaneMap::default() };
        assert_eq!(askew_rad(&map, 0.4, |_| ()), None);
        let bend = lane("bend", &[(-20.0, 0.0), (92.0, 0.0), (130.0, 16.0)]);
        assert_eq!(askew_rad(&LaneMap { lanes: vec![bend], ..LaneMap::default() }, 0.4, |_| ()), None);
    }

    #[test]
    fn aside_beyond_the_end_of_the_roads_is_off_the_map_and_straight_on_is_not() {
        let drivable = drivable(lane("east", &[(-20.0, 0.0), (40.0, 0.0)]));
        let found = |heading_rad: f64| {
            let input =
                input_of(vec![straight("a", AgentType::Vehicle, (0.0, 0.0), heading_rad, 10.0)], &drivable);
            off_map(&input.actors[0], &input)
        };
        assert!(found(0.0).is_empty());
        assert!(found(0.05).is_empty(), "drifting 4.5 m in 90");
        let aside = found(0.3);
        assert_eq!(aside.len(), 1);
        assert!(aside[0].time_s > 4.0 && aside[0].worst.unwrap() > 40.0, "{aside:?}");
    }
}
