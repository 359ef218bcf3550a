use super::super::tests::{input_of, straight, track_of};
use super::super::{Actor, Drivable, Exclude, PairChoice, ScoreInput};
use super::mover::MoverState;
use super::near::{Side, meet_within};
use super::*;
use crate::AgentType::{Pedestrian, Vehicle};
use crate::geometry::obb::overlaps;
use crate::{STEP_S, State, Track};
use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI};

fn scored(actors: Vec<Actor<'_>>, change: impl Fn(&mut ScoreInput<'_>)) -> PairScores {
    let drivable = Drivable::default();
    let mut input = input_of(actors, &drivable);
    change(&mut input);
    score_pairs(&input)
}

fn plain(actors: Vec<Actor<'_>>) -> PairScores {
    scored(actors, |_| ())
}

fn car(id: &'static str, x: f64, y: f64, heading: f64, speed: f64) -> Actor<'static> {
    straight(id, Vehicle, (x, y), heading, speed)
}

/// Parked: same place all the time.
fn parked(id: &'static str, x: f64, y: f64) -> Actor<'static> {
    car(id, x, y, 0.0, 0.0)
}

#[test]
fn rear_end_collision() {
    let found = plain(vec![car("a", 0.0, 0.0, 0.0, 15.0), car("b", 24.0, 0.0, 0.0, 5.0)]);
    // 20 m between the bumpers at 10 m/s: contact after 2 s, and the first quarter step in which they share
    // area is at 2.025 s.
    assert_eq!(found.collisions.len(), 1);
    let crash = &found.collisions[0];
    assert_eq!((crash.a.as_str(), crash.b.as_str(), crash.time_s), ("a", "b", 2.025));
    assert!((crash.iou - 1.0).abs() < 1e-9 && (crash.closing_speed_mps - 10.0).abs() < 1e-9);
    assert!(found.near_misses.is_empty());
    assert_eq!(found.agents[0].min_ttc_s, Some(0.0));
    assert!((found.agents[1].min_distance_m.unwrap() + 2.0).abs() < 1e-9);
}

#[test]
fn collision_between_two_steps() {
    // Two walkers' boxes pass through a corner of each other between steps: only the substep detects it.
    let fast = |id, x: f64, y: f64, h| straight(id, Pedestrian, (x, y), h, 40.0);
    let found = plain(vec![fast("a", -2.0, 0.0, 0.0), fast("b", 0.0, -2.0, FRAC_PI_2)]);
    assert_eq!(found.collisions.len(), 1);
    assert_eq!(found.collisions[0].time_s, 0.05);
    // At no step were they on a collision course.
    assert_eq!(found.agents.iter().map(|a| a.min_ttc_s).collect::<Vec<_>>(), [Some(0.0); 2]);
}

#[test]
fn small_under_large() {
    let mut bus = parked("a", 0.0, 0.0);
    (bus.size.length_m, bus.size.width_m) = (12.0, 2.6);
    let mut child = straight("b", Pedestrian, (0.0, -9.0), FRAC_PI_2, 2.0);
    (child.size.length_m, child.size.width_m) = (0.4, 0.4);
    assert_eq!(plain(vec![bus.clone(), child.clone()]).collisions.len(), 1);
    let above = |iou: f64, covered_share: f64| {
        let actors = vec![bus.clone(), child.clone()];
        let limits = |input: &mut ScoreInput<'_>| {
            (input.thresholds.iou, input.thresholds.covered_share) = (iou, covered_share);
        };
        scored(actors, limits)
    };
    assert_eq!(above(0.02, 0.5).collisions.len(), 1);
    let paper = above(0.02, 2.0);
    assert!(paper.collisions.is_empty() && paper.agents[0].overlaps);
}

#[test]
fn log_overlaps_are_left_out() {
    let log = track_of(|_| State::default());
    let apart = track_of(|i| State { x_m: if i == 50 { 1.0 } else { 9.0 }, ..State::default() });
    let beside = track_of(|_| State { y_m: 1.5, ..State::default() });
    let pair = |second: &'static Track, first: &'static Track| {
        let with = |id, y, log: &'static Track| Actor { log: Some(log), ..parked(id, 0.0, y) };
        vec![with("a", 0.0, first), with("b", 1.5, second)]
    };
    let leaked = |track: Track| -> &'static Track { Box::leak(Box::new(track)) };
    let (log, apart, beside) = (leaked(log), leaked(apart), leaked(beside));
    let count = |second, rule| scored(pair(second, log), |input| input.exclude = rule).collisions.len();
    assert_eq!(count(beside, Exclude::Nothing), 1);
    assert_eq!(count(beside, Exclude::OverlapAtStart), 0);
    assert_eq!(count(apart, Exclude::OverlapAtStart), 1);
    assert_eq!(count(apart, Exclude::OverlapInLog), 0);
}

/// Moves as recorded.
fn recorded<'a>(actor: &'a Actor<'a>) -> Actor<'a> {
    Actor { generated: false, log: Some(&actor.track), ..actor.clone() }
}

/// Generated motion over a recording.
fn made<'a>(actor: &Actor<'a>, log: &'a Actor<'a>) -> Actor<'a> {
    Actor { log: Some(&log.track), ..actor.clone() }
}

#[test]
fn what_both_do_as_recorded_is_in_the_log() {
    let (a, b) = (car("a", 0.0, 0.0, 0.0, 15.0), car("b", 24.0, 0.0, 0.0, 5.0));
    let found = plain(vec![recorded(&a), recorded(&b)]);
    assert!(found.collisions[0].in_log);
    assert_eq!((found.agents[0].collisions, found.agents[0].logged_collisions), (0, 1));
    let (a, b) = (car("a", 0.0, 0.0, 0.0, 10.0), car("b", 40.0, -46.6, FRAC_PI_2, 10.0));
    let found = plain(vec![recorded(&a), recorded(&b)]);
    assert!(found.near_misses[0].in_log);
    assert_eq!(found.agents[1].near_misses, 0);
}

#[test]
fn made_motion_that_collides_is_never_the_logs() {
    let (a, b) = (car("a", 0.0, 0.0, 0.0, 15.0), car("b", 24.0, 0.0, 0.0, 5.0));
    let log = car("a", -0.5, 0.0, 0.0, 15.0);
    let found = plain(vec![made(&a, &log), recorded(&b)]);
    assert!(!found.collisions[0].in_log && found.agents[0].collisions == 1);
}

#[test]
fn a_made_near_miss_is_in_the_log_only_where_the_recording_shows_it_too() {
    let (a, b) = (car("a", 0.0, 0.0, 0.0, 10.0), car("b", 40.0, -46.6, FRAC_PI_2, 10.0));
    let in_log = |log: &Actor<'_>| plain(vec![made(&a, log), recorded(&b)]).near_misses[0].in_log;
    assert!(in_log(&car("a", 0.1, 0.0, 0.0, 10.0)), "nearly the same drive");
    assert!(!in_log(&car("a", -60.0, 0.0, 0.0, 10.0)), "one that comes long after");
}

#[test]
fn people_who_walk_in_company_do_not_collide() {
    let walk = |id, x, y, h, v| straight(id, Pedestrian, (x, y), h, v);
    let hits = |actors| plain(actors).collisions.len();
    // Side by side, behind each other, a group of three, two standing in conversation: their boxes touch.
    assert_eq!(hits(vec![walk("a", 0.0, 0.0, 0.0, 1.4), walk("b", 0.0, 0.6, 0.0, 1.4)]), 0);
    assert_eq!(hits(vec![walk("a", 0.0, 0.0, 0.0, 1.4), walk("b", -1.0, 0.0, 0.0, 1.45)]), 0);
    let third = walk("c", -0.5, 0.4, 0.0, 1.4);
    assert_eq!(hits(vec![walk("a", 0.0, 0.0, 0.0, 1.4), walk("b", 0.0, 0.6, 0.0, 1.4), third]), 0);
    assert_eq!(hits(vec![walk("a", 0.0, 0.0, 0.0, 0.0), walk("b", 0.0, 0.6, PI, 0.0)]), 0);
    // A couple that parts after a second was in company before, whatever the window shows; strangers were not.
    let parting = |apart_mps: f64| {
        let mut other = walk("b", 0.0, 0.55, 0.0, 1.4);
        other.track = Cow::Owned(track_of(move |i| {
            let (slow, fast) = (i.min(10) as f64, i.saturating_sub(10) as f64);
            let y_m = 0.55 + (apart_mps * slow + 2.0 * fast) * STEP_S;
            let vy_mps = if i < 10 { apart_mps } else { 2.0 };
            State { x_m: 0.14 * i as f64, y_m, heading_rad: 0.0, vx_mps: 1.4, vy_mps }
        }));
        hits(vec![walk("a", 0.0, 0.0, 0.0, 1.4), other])
    };
    assert_eq!((parting(0.6), parting(0.9)), (0, 1));
    // Two pedestrians that walk into each other, and one that walks into another's back.
    assert_eq!(hits(vec![walk("a", 0.0, 0.0, 0.0, 1.4), walk("b", 8.0, 0.0, PI, 1.4)]), 1);
    assert_eq!(hits(vec![walk("a", 0.0, 0.0, 0.0, 2.4), walk("b", 5.0, 0.0, 0.0, 1.0)]), 1);
}

#[test]
fn a_truck_and_its_trailer_do_not_collide() {
    // The boxes part at the start by 0.2 m, and overlap later, in a bend of 30 m radius.
    let bend = |behind: f64, heading_lag: f64| {
        track_of(move |i| {
            let h = 8.0 / 30.0 * i as f64 * STEP_S - behind / 30.0;
            let (s, c) = h.sin_cos();
            let (x_m, y_m) = (30.0 * s, 30.0 * (1.0 - c));
            let heading_rad = crate::wrap_angle(h - heading_lag * i as f64 / 90.0);
            State { x_m, y_m, heading_rad, vx_mps: 8.0 * c, vy_mps: 8.0 * s }
        })
    };
    let (mut truck, mut trailer) = (car("a", 0.0, 0.0, 0.0, 8.0), car("b", 0.0, 0.0, 0.0, 8.0));
    (truck.size.length_m, trailer.size.length_m) = (6.0, 6.0);
    (truck.track, trailer.track) = (Cow::Owned(bend(0.0, 0.0)), Cow::Owned(bend(6.15, 0.5)));
    let hits = |a: &Actor<'_>, b: &Actor<'_>| {
        scored(vec![a.clone(), b.clone()], |input| input.exclude = Exclude::OverlapAtStart).collisions.len()
    };
    let (mut a, mut b) = (recorded(&truck), recorded(&trailer));
    assert_eq!(hits(&a, &b), 0);
    // In generated motion they are still a truck and its trailer.
    (a.generated, b.generated) = (true, true);
    assert_eq!(hits(&a, &b), 0);
    // Two cars of a standing queue are not: generated motion makes one hit the other.
    let (front, back) = (parked("a", 4.3, 0.0), parked("b", 0.0, 0.0));
    assert_eq!(hits(&recorded(&front), &made(&car("b", 0.0, 0.0, 0.0, 3.0), &back)), 1);
}

#[test]
fn recorded_cars_that_stay_parked_do_not_collide() {
    // The box of one grows into the other's for a while.
    let shaken = |i: usize| State { y_m: 2.1 - 0.3 * f64::from(u8::from(i > 40)), ..State::default() };
    let (a, mut b) = (parked("a", 0.0, 0.0), parked("b", 0.0, 2.1));
    b.track = Cow::Owned(track_of(shaken));
    b.size.width_m = 2.0;
    assert!(plain(vec![recorded(&a), recorded(&b)]).collisions.is_empty());
    assert_eq!(plain(vec![a, b]).collisions.len(), 1);
}

#[test]
fn a_bus_that_stands_or_crawls_beside_a_walker_is_no_near_miss() {
    let misses = |speed: f64| {
        // It stands for three seconds, then rolls off at that speed; the walker comes up to its side.
        let roll = |i: usize| {
            let rolled = (i as f64 - 30.0).max(0.0) * STEP_S;
            State { x_m: speed * rolled, vx_mps: if rolled > 0.0 { speed } else { 0.0 }, ..State::default() }
        };
        let mut bus = car("a", 0.0, 0.0, 0.0, 0.0);
        (bus.size.length_m, bus.size.width_m) = (12.0, 2.6);
        bus.track = Cow::Owned(track_of(roll));
        let walk = |i: usize| {
            let t = (i as f64 * STEP_S).min(3.5);
            State {
                x_m: 8.0,
                y_m: -6.5 + 1.4 * t,
                vy_mps: if t < 3.5 { 1.4 } else { 0.0 },
                ..State::default()
            }
        };
        let mut walker = straight("b", Pedestrian, (0.0, 0.0), FRAC_PI_2, 0.0);
        walker.track = Cow::Owned(track_of(walk));
        let found = plain(vec![bus, walker]);
        (found.near_misses.len(), found.collisions.len())
    };
    assert_eq!((misses(0.6).0, misses(1.3).0), (0, 0));
    // Rolling past at 4 m/s, it touches a walker in its way.
    assert_eq!(misses(4.0), (0, 1));
}

#[test]
fn a_car_that_turns_goes_round_those_ahead_of_it() {
    // East at 6 m/s, a quarter turn to the left, then north, past the front of one that waits.
    let turning = |i: usize| {
        let way = 6.0 * STEP_S * i as f64 - 12.0;
        let h = (way / 10.0).clamp(0.0, FRAC_PI_2);
        let (s, c) = h.sin_cos();
        let (straight, after) = (way.min(0.0), (way - 10.0 * FRAC_PI_2).max(0.0));
        let (x_m, y_m) = (straight + 10.0 * s, 10.0 - 10.0 * c + after);
        State { x_m, y_m, heading_rad: h, vx_mps: 6.0 * c, vy_mps: 6.0 * s }
    };
    let waiting = |i: usize| {
        let rolled = 0.1 * (i as f64 - 60.0).clamp(0.0, 20.0);
        let vx_mps = if (60..80).contains(&i) { -1.0 } else { 0.0 };
        State { x_m: 12.0 - rolled, y_m: 1.0, heading_rad: -PI, vx_mps, vy_mps: 0.0 }
    };
    let (mut a, mut b) = (car("a", 0.0, 0.0, 0.0, 0.0), car("b", 0.0, 0.0, 0.0, 0.0));
    (a.track, b.track) = (Cow::Owned(track_of(turning)), Cow::Owned(track_of(waiting)));
    let found = plain(vec![a.clone(), b.clone()]);
    assert_eq!(found.near_misses, []);
    assert!(found.agents[0].min_ttc_s.unwrap() < 1.5);
    // Without the turn it is one.
    let straight = |i: usize| {
        let t = (i as f64 * STEP_S).min(2.0);
        State { x_m: 6.0 * t - 1.5 * t * t - 0.5, vx_mps: 6.0 - 3.0 * t, ..State::default() }
    };
    a.track = Cow::Owned(track_of(straight));
    assert_eq!(plain(vec![a, b]).near_misses.len(), 1);
}

#[test]
fn only_regenerated_pairs() {
    let rolls = car("b", 24.0, 0.0, 0.0, 1.0);
    let mut actors = vec![car("a", 0.0, 0.0, 0.0, 15.0), rolls, parked("c", 24.0, 0.5)];
    for actor in &mut actors {
        actor.generated = actor.id == "a";
    }
    assert_eq!(plain(actors.clone()).collisions.len(), 3);
    let found = scored(actors, |input| input.pairs = PairChoice::Regenerated);
    let ids: Vec<_> = found.collisions.iter().map(|c| c.b.as_str()).collect();
    assert_eq!(ids, ["b", "c"]);
}

#[test]
fn a_light_touch_is_a_collision_and_never_a_near_miss() {
    // b crosses behind a: up to 2 m of a's rear corner are in front of b.
    let crossing = |y: f64, iou: f64| {
        let actors = vec![car("a", 0.0, 0.0, 0.0, 10.0), car("b", 40.0, y, FRAC_PI_2, 10.0)];
        scored(actors, |input| input.thresholds.iou = iou)
    };
    let y = |i: u32| -46.0 + 0.05 * f64::from(i);
    let light = (0..40).map(y).find(|y| !crossing(*y, 0.02).overlaps.is_empty()).unwrap();
    let found = crossing(light, 0.0);
    assert!(found.collisions.len() == 1 && found.overlaps.is_empty() && found.near_misses.is_empty());
    // Above only the paper's threshold it is an overlap and no near miss.
    let paper = crossing(light, 0.02);
    assert!(paper.collisions.is_empty() && paper.near_misses.is_empty(), "{paper:?}");
    let depth_m = paper.overlaps[0].depth_m;
    assert!(depth_m > 0.0 && !paper.overlaps[0].in_log, "{paper:?}");
    assert_eq!(paper.agents[0].min_distance_m, Some(-depth_m));
    assert_eq!((paper.agents[0].light_overlaps, paper.agents[0].near_misses), (1, 0));
}

#[test]
fn crossing_near_miss_at_its_worst_moment() {
    // b crosses 0.5 m behind a's rear: front at y = -1 when a's rear is at x = 41.5.
    let found = plain(vec![car("a", 0.0, 0.0, 0.0, 10.0), car("b", 40.0, -46.6, FRAC_PI_2, 10.0)]);
    assert!(found.collisions.is_empty());
    assert_eq!(found.near_misses.len(), 1);
    let miss = &found.near_misses[0];
    assert!(miss.distance_m < 1.5 && miss.closing_speed_mps > 1.0, "{miss:?}");
    assert!((4.0..4.7).contains(&miss.time_s), "{miss:?}");
    assert_eq!((found.agents[0].near_misses, found.agents[1].near_misses), (1, 1));
}

#[test]
fn head_on_turned_away_is_a_near_miss() {
    // Both stop 1 m apart after closing at 20 m/s: no collision, but time to collision was short.
    let stop = |from: f64, way: f64| {
        move |i: usize| {
            let t = (i as f64 * STEP_S).min(4.0);
            State {
                x_m: from + way * (10.0 * t - 1.25 * t * t),
                vx_mps: way * (10.0 - 2.5 * t),
                ..State::default()
            }
        }
    };
    let mut a = car("a", 0.0, 0.0, 0.0, 10.0);
    let mut b = car("b", 45.0, 0.0, PI, 10.0);
    a.track = Cow::Owned(track_of(stop(0.0, 1.0)));
    let facing = move |i| State { heading_rad: -PI, ..stop(45.0, -1.0)(i) };
    b.track = Cow::Owned(track_of(facing));
    let found = plain(vec![a, b]);
    assert!(found.collisions.is_empty());
    assert_eq!(found.near_misses.len(), 1);
    let miss = &found.near_misses[0];
    assert!(miss.ttc_s.unwrap() < 1.5 && miss.closing_speed_mps > 1.0, "{miss:?}");
    assert!((found.agents[0].min_distance_m.unwrap() - 1.0).abs() < 1e-9);
}

#[test]
fn no_near_miss_for_ordinary_neighbours() {
    let none = |actors| assert_eq!(plain(actors).near_misses, []);
    // Parked cars door to door; driving past a parked car with 0.6 m; side by side in step.
    none(vec![parked("a", 0.0, 0.0), parked("b", 0.0, 2.3)]);
    none(vec![car("a", -40.0, 0.0, 0.0, 10.0), parked("b", 0.0, 2.6)]);
    none(vec![car("a", 0.0, 0.0, 0.0, 10.0), car("b", 0.0, 2.5, 0.0, 10.0)]);
    // Oncoming one lane over.
    none(vec![car("a", 0.0, 0.0, 0.0, 10.0), car("b", 80.0, 3.5, PI, 10.0)]);
    // Pedestrians that pass each other.
    let walk = |id, x, y, h| straight(id, Pedestrian, (x, y), h, 1.4);
    none(vec![walk("a", 0.0, 0.0, 0.0), walk("b", 10.0, 1.0, PI)]);
    // Stopping behind a queue at 2 m/s2 with half a metre left: time to collision falls below 1.5 s.
    let queue = |i: usize| {
        let t = (i as f64 * STEP_S).min(5.0);
        State { x_m: 10.0 * t - t * t, vx_mps: 10.0 - 2.0 * t, ..State::default() }
    };
    let mut a = car("a", 0.0, 0.0, 0.0, 10.0);
    a.track = Cow::Owned(track_of(queue));
    let mut b = car("b", 29.5, 0.0, 0.0, 0.0);
    let creep = |i: usize| State { x_m: 29.5 + 0.05 * (i as f64 - 60.0).max(0.0), ..State::default() };
    b.track = Cow::Owned(track_of(creep));
    none(vec![a, b]);
}

#[test]
fn least_times_and_distances() {
    let found =
        plain(vec![car("a", 0.0, 0.0, 0.0, 10.0), car("b", 500.0, 30.0, 0.0, 10.0), parked("c", 0.0, 6.0)]);
    // a passes c with 4 m between the sides and never meets b.
    assert!((found.agents[0].min_distance_m.unwrap() - 4.0).abs() < 1e-9);
    assert_eq!(found.agents[0].min_ttc_s, None);
    // b is nearest to the parked c at its start: 496 m ahead and 22 m beside.
    assert!((found.agents[1].min_distance_m.unwrap() - 496f64.hypot(22.0)).abs() < 1e-9);
}

#[test]
fn gaps_in_a_track_are_skipped() {
    let mut a = car("a", 0.0, 0.0, 0.0, 15.0);
    let hidden = a.track.to_mut();
    for slot in &mut hidden.states[10..80] {
        *slot = None;
    }
    let found = plain(vec![a, parked("b", 60.0, 0.0)]);
    assert!(found.collisions.is_empty());
    assert!(found.agents[0].min_ttc_s.unwrap() > 2.5);
}

/// The shortcuts change nothing: a full evaluation of every step of every pair gives the same figures.
#[test]
fn shortcuts_are_exact() {
    let names = ["a", "b", "c", "d", "e", "f", "g", "h"];
    for seed in 0..20 {
        let some = |i: usize, k: f64, range: f64| ((i as f64 + 1.7 * f64::from(seed)) * k).sin() * range;
        let one = |(i, id): (usize, &&'static str)| {
            car(id, some(i, 12.9, 60.0), some(i, 78.2, 60.0), some(i, 37.7, PI), some(i, 93.9, 12.0).abs())
        };
        let actors: Vec<_> = names.iter().enumerate().map(one).collect();
        let drivable = Drivable::default();
        let input = input_of(actors.clone(), &drivable);
        let found = score_pairs(&input);
        for i in 0..actors.len() {
            let (mut gap, mut ttc_s) = (f64::INFINITY, f64::INFINITY);
            for j in (0..actors.len()).filter(|j| *j != i) {
                let stands = |k: usize| actors[k].travel_m(0..91) < PARKED_M;
                for step in 0..91 {
                    let at = |k: usize| Some((actors[k].outline(step)?, *actors[k].state(step)?));
                    let ((p, u), (q, v)) = (at(i).unwrap(), at(j).unwrap());
                    if !(stands(i) && stands(j)) {
                        gap = gap.min(gap_and_direction(&p, &q).0);
                    }
                    if u.speed_mps().max(v.speed_mps()) > 0.5 {
                        let t = time_to_collision(&p, u.velocity(), &q, v.velocity(), LOOK_AHEAD_S);
                        ttc_s = ttc_s.min(t.unwrap_or(f64::INFINITY));
                    }
                }
            }
            let totals = &found.agents[i];
            assert_eq!(totals.min_distance_m.unwrap_or(f64::INFINITY), gap, "seed {seed} agent {i}");
            assert_eq!(totals.min_ttc_s.unwrap_or(f64::INFINITY), ttc_s, "seed {seed} agent {i}");
        }
    }
}

/// The same for courses: the two do not touch at the skipped steps.
#[test]
fn a_course_is_looked_at_wherever_they_may_touch() {
    let (mut meet, mut pass) = (0, 0);
    for seed in 0..400 {
        let some = |k: f64, range: f64| ((f64::from(seed) + 0.7) * k).sin() * range;
        // Two on roughly opposite courses, each in a bend: the heading turns with each step.
        let mover = |k: f64, x_m: f64, heading_rad: f64| {
            let (x_m, y_m) = (x_m + some(k, 8.0), some(k * 7.3, 6.0));
            let mut actor = car("a", x_m, y_m, heading_rad + some(k * 3.1, 0.5), some(k * 5.7, 12.0).abs());
            for (i, state) in actor.track.to_mut().states.iter_mut().flatten().enumerate() {
                state.heading_rad += i as f64 * some(k * 2.3, 0.05);
            }
            Mover::new(&actor, 0..91)
        };
        let (a, b) = (mover(12.9, -20.0, 0.0), mover(78.2, 20.0, PI));
        let side = |mover| Side { mover, moment: mover_at(mover, 5), step: 5 };
        let time_s = some(9.1, 8.0).abs();
        let steps = (time_s / STEP_S).ceil() as usize;
        let touch = |i: usize| {
            let later_s = (i as f64 * STEP_S).min(time_s);
            let at = |mover| side(mover).later(mover.turn_rate_radps(5), later_s);
            overlaps(&at(&a), &at(&b), 0.0)
        };
        let expected = (0..=steps).any(touch);
        assert_eq!(meet_within(side(&a), side(&b), time_s), expected, "seed {seed}");
        if expected { meet += 1 } else { pass += 1 }
    }
    assert!(meet > 20 && pass > 20, "{meet} meet, {pass} pass");
}

#[test]
fn a_box_whose_front_and_back_are_exchanged_does_not_turn() {
    // Side by side with a metre between them, and long: half a turn would sweep over the other.
    let mut flips = car("a", 0.0, 0.0, 0.0, 0.0);
    for state in flips.track.to_mut().states.iter_mut().flatten().skip(1).step_by(2) {
        state.heading_rad = PI;
    }
    let scored = scored(vec![flips, car("b", 0.0, 3.0, 0.0, 1.0)], |_| ());
    assert!(scored.collisions.is_empty(), "{:?}", scored.collisions);
}

fn mover_at(mover: &Mover, step: usize) -> &MoverState {
    mover.moments[step].as_ref().unwrap()
}

#[test]
fn time_to_collision_of_an_encounter_follows_the_turn() {
    // It turns left by 30 degrees a second at 8 m/s: a circle of 15 m, on which the other stands.
    let mut turning = car("a", 0.0, 0.0, 0.0, 8.0);
    for (i, state) in turning.track.to_mut().states.iter_mut().flatten().enumerate() {
        let turned = std::f64::consts::FRAC_PI_6 * i as f64 * STEP_S;
        let radius = 8.0 / std::f64::consts::FRAC_PI_6;
        (state.x_m, state.y_m) = (radius * turned.sin(), radius * (1.0 - turned.cos()));
        (state.vx_mps, state.vy_mps) = (8.0 * turned.cos(), 8.0 * turned.sin());
        state.heading_rad = turned;
    }
    let other = car("b", 15.3, 15.3, FRAC_PI_2, 0.0);
    let (a, b) = (Mover::new(&turning, 0..91), Mover::new(&other, 0..91));
    let at_start = |step| {
        let (p, q) = (mover_at(&a, step), mover_at(&b, step));
        (ttc(p, q, LOOK_AHEAD_S), Measures::of(&a, &b, step).ttc_s)
    };
    let (straight_on, as_it_turns) = at_start(5);
    assert_eq!(straight_on, None);
    assert!((as_it_turns.unwrap() - 2.0).abs() < 0.5, "{as_it_turns:?}");
}
