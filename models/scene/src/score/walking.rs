//! Rules for one pedestrian: running, and walking on the carriageway.

use super::input::{Actor, ScoreInput};
use super::lane_rules::lasting;
use super::report::{Stretch, stretches};
use crate::geometry::cross;
use crate::map::Area;
use crate::{AgentType, STEP_S, State, Vec2};

/// Shortest run that counts, seconds.
const RUNNING_S: f64 = 1.0;
/// Shortest walk along a lane that counts, seconds.
const ALONG_S: f64 = 2.0;
/// Cosine of the angle between a lane and a walk along it.
const ALONG: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// A pedestrian nearer to a crosswalk than this is on it, metres.
pub const ON_CROSSWALK_M: f64 = 1.5;
/// Shortest crossing of lanes that counts, metres.
const CROSSING_M: f64 = 3.0;
/// Steps off the lanes after which the pedestrian has reached the other side.
const BETWEEN_LANES: usize = 15;
/// Shares of a crossing that a crosswalk over the same lanes covers.
const SAME_LANES: (f64, f64) = (0.3, 0.7);

/// Stretches of running; `worst` in m/s.
pub(crate) fn running(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    if actor.agent_type != AgentType::Pedestrian {
        return Vec::new();
    }
    let speed = |step| Some((step, actor.state(step)?.speed_mps()));
    let runs = |s: &(usize, f64)| s.1 > input.thresholds.running_mps;
    let flagged: Vec<(usize, f64)> = input.steps.clone().filter_map(speed).filter(runs).collect();
    lasting(stretches(actor, &flagged), RUNNING_S)
}

/// Stretches along a vehicle lane, and crossings of such lanes beside a crosswalk over them; `worst` in
/// metres walked.
pub(crate) fn on_carriageway(actor: &Actor<'_>, input: &ScoreInput<'_>) -> Vec<Stretch> {
    if actor.agent_type != AgentType::Pedestrian {
        return Vec::new();
    }
    let on_lanes: Vec<(usize, &State)> = input
        .steps
        .clone()
        .filter_map(|step| Some((step, actor.state(step)?)))
        .filter(|(_, state)| input.drivable.vehicle_lanes(state.position()).next().is_some())
        .collect();
    if on_lanes.is_empty() {
        return Vec::new();
    }
    let mut found = along(actor, input, &on_lanes);
    found.extend(beside_crosswalks(actor, input, &on_lanes));
    found
}

fn along(actor: &Actor<'_>, input: &ScoreInput<'_>, on_lanes: &[(usize, &State)]) -> Vec<Stretch> {
    let walks_along = |state: &State| {
        let speed = state.speed_mps();
        let way = state.velocity();
        let mut lanes = input.drivable.vehicle_lanes(state.position());
        let along = lanes.all(|(lane, band)| {
            let axis = lane.to - lane.from;
            !band.in_junction && axis.dot(&way).abs() >= ALONG * axis.norm() * speed
        });
        along && speed > input.thresholds.moving_mps && !is_on_crosswalk(input, state.position())
    };
    let steps = on_lanes.iter().filter(|(_, state)| walks_along(state));
    let flagged: Vec<(usize, f64)> = steps.map(|(step, _)| (*step, 0.0)).collect();
    let mut found = lasting(stretches(actor, &flagged), ALONG_S);
    for stretch in &mut found {
        let (from, until) = (step_of(stretch.time_s), step_of(stretch.until_s));
        let walked = |(step, state): &(usize, &State)| {
            if (from..=until).contains(step) { state.speed_mps() * STEP_S } else { 0.0 }
        };
        stretch.worst = Some(on_lanes.iter().map(walked).sum());
    }
    found.retain(|s| s.worst.is_some_and(|m| m > input.thresholds.along_lane_m));
    found
}

fn is_on_crosswalk(input: &ScoreInput<'_>, place: Vec2) -> bool {
    input.map.crosswalks.iter().any(|area| area.is_near(place, ON_CROSSWALK_M))
}

fn beside_crosswalks(
    actor: &Actor<'_>,
    input: &ScoreInput<'_>,
    on_lanes: &[(usize, &State)],
) -> Vec<Stretch> {
    let mut found = Vec::new();
    for crossing in on_lanes.chunk_by(|a, b| b.0 - a.0 <= BETWEEN_LANES) {
        let (Some(first), Some(last)) = (crossing.first(), crossing.last()) else { continue };
        let off_before = first.0.checked_sub(1).is_some_and(|step| is_there(actor, input, step));
        let (from, to) = (first.1.position(), last.1.position());
        let crosses = off_before && is_there(actor, input, last.0 + 1) && (to - from).norm() >= CROSSING_M;
        if !crosses {
            continue;
        }
        // A crosswalk may be drawn short of the kerbs, so the middle decides.
        let middle = &crossing[crossing.len() / 4..crossing.len() - crossing.len() / 4];
        if middle.iter().all(|(_, state)| is_on_crosswalk(input, state.position())) {
            continue;
        }
        if input.map.crosswalks.iter().any(|area| serves(area, from, to, input.thresholds.crosswalk_m)) {
            let walked_m = (to - from).norm();
            found.extend(
                stretches(actor, &[(first.0, walked_m)])
                    .into_iter()
                    .map(|s| Stretch { until_s: super::report::time_of(last.0 as f64), ..s }),
            );
        }
    }
    found
}

fn is_there(actor: &Actor<'_>, input: &ScoreInput<'_>, step: usize) -> bool {
    input.steps.contains(&step) && actor.state(step).is_some()
}

/// Whether the crosswalk leads over the same lanes, at most this far beside the crossing.
fn serves(area: &Area, from: Vec2, to: Vec2, beside_m: f64) -> bool {
    let length_m = (to - from).norm();
    let over = (to - from) / length_m;
    let ring = &area.polygon.xy;
    let along = |p: &Vec2| over.dot(&(p - from));
    let low_m = ring.iter().map(along).fold(f64::INFINITY, f64::min);
    let high_m = ring.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    let away_m = ring.iter().map(|p| cross(over, p - from).abs()).fold(f64::INFINITY, f64::min);
    low_m <= SAME_LANES.0 * length_m && high_m >= SAME_LANES.1 * length_m && away_m <= beside_m
}

fn step_of(time_s: f64) -> usize {
    (time_s / STEP_S).round() as usize
}

#[cfg(test)]
mod tests {
    use super::super::tests::{area, input_of, lane, straight};
    use super::super::{Drivable, ScoreInput};
    use super::*;
    use crate::LaneMap;
    use std::f64::consts::FRAC_PI_2;

    /// A street of two lanes to the east with a crosswalk from x = 18 to 22.
    fn street() -> LaneMap {
        LaneMap {
            lanes: vec![lane("a", &[(-50.0, 0.0), (50.0, 0.0)]), lane("b", &[(50.0, 3.5), (-50.0, 3.5)])],
            crosswalks: vec![area(&[(18.0, -2.0), (22.0, -2.0), (22.0, 5.5), (18.0, 5.5)])],
            ..LaneMap::default()
        }
    }

    fn found(from: (f64, f64), heading_rad: f64, speed_mps: f64) -> Vec<Stretch> {
        let map = street();
        let drivable = Drivable::new(&map);
        let walker = straight("a", AgentType::Pedestrian, from, heading_rad, speed_mps);
        let input = ScoreInput { map: &map, ..input_of(vec![walker], &drivable) };
        on_carriageway(&input.actors[0], &input)
    }

    #[test]
    fn a_walk_along_a_lane_is_on_the_carriageway() {
        let along = found((-10.0, 0.5), 0.2, 1.0);
        assert_eq!(along.len(), 1);
        // It leaves the lane after 6.2 m and continues along the next one.
        assert!((along[0].worst.unwrap() - 9.1).abs() < 0.2, "{along:?}");
        assert!(found((-10.0, 0.5), 0.0, 0.3).is_empty(), "2.7 m, slower than a walk");
        assert!(found((-10.0, -6.0), 0.0, 1.4).is_empty(), "beside the street");
        assert!(found((18.5, 0.0), 0.0, 0.3).is_empty(), "on the crosswalk");
    }

    #[test]
    fn crossing_beside_a_crosswalk_is_on_the_carriageway() {
        let at = |x: f64| found((x, -4.0), FRAC_PI_2, 1.4);
        let beside = at(10.0);
        assert_eq!(beside.len(), 1);
        assert!((beside[0].worst.unwrap() - 7.0).abs() < 0.3 && beside[0].time_s > 1.0);
        assert!(at(20.0).is_empty(), "on it");
        assert!(at(16.6).is_empty(), "right beside it");
        assert!(at(-10.0).is_empty(), "28 m away");
        assert!(found((10.0, -4.0), FRAC_PI_2, 0.6).is_empty(), "it has not crossed yet");
    }

    #[test]
    fn a_crosswalk_over_another_road_does_not_serve() {
        let other = area(&[(18.0, -9.0), (22.0, -9.0), (22.0, -5.0), (18.0, -5.0)]);
        assert!(!serves(&other, Vec2::new(10.0, -2.0), Vec2::new(10.0, 5.0), 15.0));
    }

    #[test]
    fn a_fast_walk_for_a_second_is_a_run() {
        let drivable = Drivable::default();
        let runs = |agent_type, mps: f64| {
            let input = input_of(vec![straight("a", agent_type, (0.0, 0.0), 0.0, mps)], &drivable);
            running(&input.actors[0], &input).first().and_then(|s| s.worst)
        };
        assert_eq!(runs(AgentType::Pedestrian, 3.0), Some(3.0));
        assert_eq!(runs(AgentType::Pedestrian, 2.4), None);
        assert_eq!(runs(AgentType::Cyclist, 3.0), None);
    }
}
