//! Off-road and wrong-way driving, for vehicles only.

use super::drivable::Drivable;
use super::input::{Actor, ScoreInput};
use super::lane_rules::end_step;
use super::report::{Stretch, share, stretches, time_of};
use crate::geometry::direction;
use crate::geometry::obb::OrientedBox;
use crate::{AgentType, STEP_S, Subtype, Vec2};

/// A vehicle that stays within this distance of its first place is parked, metres.
pub(super) const PARKED_M: f64 = 1.0;

/// Road score of a vehicle's motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoadScore {
    /// Share of its steps with a corner off the road.
    pub offroad_share: Option<f64>,
    /// Greatest distance of a corner off the road, metres.
    pub offroad_max_m: Option<f64>,
    /// Share of its moving steps against the traffic.
    pub wrong_way_share: Option<f64>,
    /// Stretches off the road except those over a median; `worst` in metres.
    pub off_road: Vec<Stretch>,
    /// Stretches over a median; `worst` in metres.
    pub over_median: Vec<Stretch>,
    /// Stretches against the traffic; `worst` in metres driven.
    pub wrong_way: Vec<Stretch>,
    pub(super) offroad_steps: usize,
    pub(super) road_steps: usize,
    pub(super) wrong_way_steps: usize,
    pub(super) moving_steps: usize,
}

/// Scores a vehicle's steps. Nothing for other types, on maps that do not define where to drive, and for
/// vehicles parked at their recorded place (they often stand across the kerb), whether generated or not.
pub fn score_road(input: &ScoreInput<'_>, actor: &Actor<'_>) -> RoadScore {
    let parked = actor.travel_m(input.steps.clone()) < PARKED_M && stands_where_logged(input, actor);
    if !drives(actor) || parked || input.drivable.is_unknown() {
        return RoadScore::default();
    }
    let ground = input.drivable.allowing(actor.may_cross);
    let limits = &input.thresholds;
    let (mut off, mut wrong) = (Vec::new(), Vec::new());
    let mut score = RoadScore::default();
    let mut farthest: Option<f64> = None;
    // A vehicle that stops against the traffic ends against it.
    let end = end_step(input, actor);
    let mut travelled_m = 0.0;
    let mut before: Option<(OrientedBox, Option<f64>)> = None;
    for step in input.steps.clone() {
        let (Some(state), Some(outline)) = (actor.state(step), actor.outline(step)) else { continue };
        // Standing vehicles mostly stand for many steps.
        let outside_m = match before {
            Some((same, outside_m)) if same == outline => outside_m,
            _ => ground.box_outside_m(&outline),
        };
        before = Some((outline, outside_m));
        if let Some(outside_m) = outside_m {
            score.road_steps += 1;
            farthest = Some(farthest.unwrap_or(0.0).max(outside_m));
            if outside_m > limits.offroad_m {
                off.push((step, outside_m));
            }
        }
        travelled_m += state.speed_mps() * STEP_S;
        let moves = state.speed_mps() > limits.moving_mps;
        score.moving_steps += usize::from(moves);
        if (moves || Some(step) == end)
            && input.drivable.is_wrong_way(state.position(), outline.forward()) == Some(true)
        {
            score.wrong_way_steps += usize::from(moves);
            wrong.push((step, travelled_m));
        }
    }
    score.offroad_steps = off.len();
    score.offroad_max_m = farthest;
    score.offroad_share = share(off.len(), score.road_steps);
    score.wrong_way_share = share(wrong.len(), score.moving_steps);
    let mut left = stretches(actor, &off);
    for stretch in &mut left {
        stretch.edge = edge_of(&ground, actor, stretch);
    }
    let over_median = |s: &Stretch| is_over_median(&ground, actor, s);
    (score.over_median, score.off_road) = left.into_iter().partition(over_median);
    score.wrong_way = stretches(actor, &wrong);
    // They hold the distance driven up to then.
    for stretch in &mut score.wrong_way {
        let before = |w: &&(usize, f64)| time_of(w.0 as f64) == stretch.time_s;
        let begun_m = wrong.iter().find(before).map_or(0.0, |w| w.1);
        stretch.worst = stretch.worst.map(|m| m - begun_m);
    }
    score
}

/// Whether the actor is a vehicle that moves under its own power.
pub(super) fn drives(actor: &Actor<'_>) -> bool {
    actor.agent_type == AgentType::Vehicle && actor.subtype != Subtype::Trailer
}

/// Whether it begins in its recorded state of that step; without a recorded state, the user placed it.
fn stands_where_logged(input: &ScoreInput<'_>, actor: &Actor<'_>) -> bool {
    let Some(step) = input.steps.clone().find(|step| actor.state(*step).is_some()) else { return true };
    let (now, logged) = (actor.state(step), actor.log.and_then(|log| log.at(step)));
    let moved_m = now.zip(logged).map(|(p, q)| (p.position() - q.position()).norm());
    !actor.generated || moved_m.is_some_and(|m| m < PARKED_M)
}

/// Whether the crossed edge divides two roads: it is marked as a median, or the vehicle gets to a lane in the
/// opposite direction.
fn is_over_median(ground: &Drivable, actor: &Actor<'_>, stretch: &Stretch) -> bool {
    let place = Vec2::new(stretch.x_m, stretch.y_m);
    if ground.is_median(place, actor.size.length_m + stretch.worst.unwrap_or(0.0)) {
        return true;
    }
    let (from, to) = (actor.state(step_of(stretch.time_s)), actor.state(step_of(stretch.until_s) + 2));
    let (Some(from), Some(to)) = (from, to) else { return false };
    ground.is_wrong_way(to.position(), direction(from.heading_rad)) == Some(true)
}

/// The edge under the box where it leaves the road, else the nearest one.
fn edge_of(ground: &Drivable, actor: &Actor<'_>, stretch: &Stretch) -> Option<String> {
    let outline = actor.outline(step_of(stretch.time_s))?;
    ground.edge_under(&outline).map(str::to_owned)
}

fn step_of(time_s: f64) -> usize {
    (time_s / STEP_S).round() as usize
}

#[cfg(test)]
mod tests {
    use super::super::tests::{area, input_of, lane, straight};
    use super::*;
    use crate::LaneMap;
    use crate::map::TypedLine;
    use crate::score::Drivable;
    use std::f64::consts::PI;

    #[test]
    fn leaves_the_road_half_way() {
        let road = area(&[(-10.0, -4.0), (45.0, -4.0), (45.0, 4.0), (-10.0, 4.0)]);
        let drivable = Drivable::new(&LaneMap { drivable: vec![road], ..LaneMap::default() });
        let car = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        let walker = straight("b", AgentType::Pedestrian, (0.0, 0.0), 0.0, 10.0);
        let input = input_of(vec![car, walker], &drivable);
        let score = score_road(&input, &input.actors[0]);
        // The front is at x + 2; more than 0.1 m outside from step 44 (x = 44, front 46) to 90.
        assert_eq!((score.offroad_steps, score.road_steps), (47, 91));
        // At the end the front is at 92, 47 m outside.
        assert!((score.offroad_max_m.unwrap() - 47.0).abs() < 1e-9);
        assert_eq!(score.off_road.len(), 1);
        assert_eq!((score.off_road[0].time_s, score.off_road[0].until_s), (4.4, 9.0));
        assert_eq!(score_road(&input, &input.actors[1]), RoadScore::default());
    }

    #[test]
    fn over_a_median_that_may_be_crossed_is_no_fault() {
        let side = |id: &str, y: f64| {
            let points = vec![Vec2::new(-50.0, y), Vec2::new(150.0, y)];
            TypedLine { id: id.into(), line_type: "median".into(), points: points.into() }
        };
        let map = LaneMap {
            lanes: vec![
                lane("east", &[(-50.0, 0.0), (150.0, 0.0)]),
                lane("north", &[(-50.0, 8.0), (150.0, 8.0)]),
            ],
            road_edges: vec![side("near", 3.0), side("far", 5.0)],
            ..LaneMap::default()
        };
        let drivable = Drivable::new(&map);
        let over = |may_cross: &[String]| {
            let car = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.2, 5.0);
            let car = Actor { may_cross, ..car };
            let score = score_road(&input_of(vec![car.clone()], &drivable), &car);
            (score.over_median, score.offroad_steps)
        };
        let (faults, steps) = over(&[]);
        assert_eq!((faults.len(), faults[0].edge.as_deref()), (1, Some("near")));
        assert!(steps > 10, "{steps}");
        assert_eq!(over(&["near".into()]), (Vec::new(), 0), "its other side is part of it");
        assert_eq!(over(&["other".into()]).1, steps);
    }

    #[test]
    fn what_stays_parked_off_the_road_is_judged_alike() {
        let road = area(&[(-10.0, -4.0), (45.0, -4.0), (45.0, 4.0), (-10.0, 4.0)]);
        let drivable = Drivable::new(&LaneMap { drivable: vec![road], ..LaneMap::default() });
        let of = |generated: bool, log: (f64, f64)| {
            let track = straight("a", AgentType::Vehicle, log, 0.0, 0.0).track.into_owned();
            let parked = straight("a", AgentType::Vehicle, (0.0, 4.0), 0.0, 0.0);
            let car = Actor { generated, log: Some(&track), ..parked };
            score_road(&input_of(vec![car.clone()], &drivable), &car).offroad_share
        };
        assert_eq!((of(false, (0.0, 4.0)), of(true, (0.0, 4.0))), (None, None));
        assert_eq!(of(true, (0.0, 0.0)), Some(1.0), "it was put there");
    }

    #[test]
    fn against_the_traffic() {
        let map = LaneMap { lanes: vec![lane("east", &[(-10.0, 0.0), (45.5, 0.0)])], ..LaneMap::default() };
        let drivable = Drivable::new(&map);
        let with = straight("a", AgentType::Vehicle, (0.0, 0.0), 0.0, 10.0);
        let against = straight("b", AgentType::Vehicle, (90.0, 0.0), PI, 10.0);
        let input = input_of(vec![with, against], &drivable);
        assert_eq!(score_road(&input, &input.actors[0]).wrong_way_share, Some(0.0));
        let score = score_road(&input, &input.actors[1]);
        // On the lane (or within half a lane of its end) from x = 47 to 0: 48 of 91 steps.
        assert_eq!((score.wrong_way_steps, score.moving_steps), (48, 91));
        assert_eq!(score.wrong_way[0].time_s, 4.3);
    }
}
