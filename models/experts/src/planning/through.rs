//! Paths through via points, planned leg by leg as paths to a goal. Their progress is at each via point at
//! its time.

use super::coordinates::MODES;
use super::profile::{Caps, Progress, TimedLeg, cruising_from, going_on, speed_at};
use super::to_goal::{GOAL_SLOTS, MOST_WAYS, goal_progress, paths_to_goal};
use super::way::{Anchor, SLOTS, UntimedPath, assumed_speed, paths_ahead};
use super::world::{AgentAtStart, Waypoint, World};
use crate::tuning::fixed::through::{FASTER, LEAST_LEG_M, PRESSED, UNHURRIED};
use scene::motion::{MotionKind, MotionModel, Target};
use scene::{HORIZON_STEPS, STEP_S, State, Vec2};

/// Paths to a via point from which the next leg begins; the last leg has as many as there are slots.
const WAYS_ON: usize = 2;
/// Steps before the window's end by which an agent without a goal has passed its last via point.
const LEFT_STEPS: usize = 10;

/// A path through the via points so far, with the arc length of each.
struct Through {
    way: UntimedPath,
    /// Metres along the path, one per via point.
    at_m: Vec<f64>,
    /// Sum of the ranks of its legs; the lowest sum comes first.
    rank: usize,
    /// Mean speed of its last leg, m/s.
    mean_mps: f64,
}

/// The six anchors of a road user through its via points, to its goal, or further along the lanes.
pub(super) fn anchors_through(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    vias: &[Waypoint],
) -> Vec<Anchor> {
    let steps = leg_steps(who, model, target, vias);
    let mut through: Vec<Through> = Vec::new();
    for (k, waypoint) in vias.iter().enumerate() {
        let place = waypoint.via.position;
        let asked = Target { step: steps[k], position: Some(place), ..Target::default() };
        through = lead_on(world, who, model, through, steps[k], |from, model| {
            paths_to_goal(world, from, model, &asked, place, false)
        });
        through.truncate(WAYS_ON);
        for found in &mut through {
            found.at_m.push(found.way.path.length_m());
        }
    }
    let left = steps.get(vias.len()).copied().unwrap_or(1);
    match target.position {
        Some(goal) => {
            let asked = Target { step: left, ..*target };
            let goes_on = target.step < HORIZON_STEPS;
            through = lead_on(world, who, model, through, left, |from, model| {
                paths_to_goal(world, from, model, &asked, goal, goes_on)
            });
            through.truncate(MOST_WAYS);
            let slots = GOAL_SLOTS[through.len().clamp(1, MOST_WAYS) - 1];
            timed(through, slots, |found, _, _| to_goal(world, model, target, vias, found, goal))
        }
        None => {
            through =
                lead_on(world, who, model, through, left, |from, model| paths_ahead(world, from, model));
            through.truncate(MODES);
            let slots = SLOTS[through.len().clamp(1, MODES) - 1];
            timed(through, slots, |found, timing, count| {
                ahead(world, model, target, vias, found, (timing as f64 + 0.5) / count as f64)
            })
        }
    }
}

/// Anchors of these paths; each gets as many timings as it has slots.
fn timed(
    through: Vec<Through>,
    slots: impl IntoIterator<Item = usize>,
    base: impl Fn(&Through, usize, usize) -> Progress,
) -> Vec<Anchor> {
    let mut out = Vec::with_capacity(MODES);
    for (found, count) in through.iter().zip(slots) {
        for timing in 0..count {
            let anchor = found.way.anchor(base(found, timing, count), (timing, count));
            out.push(Anchor { passes_m: found.at_m.clone(), ..anchor });
        }
    }
    out
}

/// Extends each path by the paths that are found from its end; if there are none yet, starts new paths. The
/// next leg takes `steps`.
fn lead_on(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    through: Vec<Through>,
    steps: usize,
    find: impl Fn(&AgentAtStart, &MotionModel) -> Vec<UntimedPath>,
) -> Vec<Through> {
    let mean_mps = |leg: &UntimedPath| leg.path.length_m() / (steps as f64 * STEP_S);
    if through.is_empty() {
        let first = |(rank, way): (usize, UntimedPath)| Through {
            at_m: Vec::new(),
            rank,
            mean_mps: mean_mps(&way),
            way,
        };
        return find(who, model).into_iter().enumerate().map(first).collect();
    }
    let mut out = Vec::new();
    for found in through {
        let from = found.end(who);
        let model = MotionModel::new(from.agent_type, world.agent(who).subtype, from.size, from.start);
        for (rank, leg) in find(&from, &model).into_iter().enumerate() {
            let way = found.way.followed_by(&leg);
            let (at_m, rank) = (found.at_m.clone(), found.rank + rank);
            out.push(Through { way, at_m, rank, mean_mps: mean_mps(&leg) });
        }
    }
    out.sort_by_key(|found: &Through| found.rank);
    out
}

impl Through {
    /// The road user at the end of the path so far, facing along it.
    fn end(&self, who: &AgentAtStart) -> AgentAtStart {
        let end = self.way.path.last();
        let velocity = end.direction() * self.mean_mps;
        let (x_m, y_m, heading_rad) = (end.position.x, end.position.y, end.heading_rad);
        let start = State { x_m, y_m, heading_rad, vx_mps: velocity.x, vy_mps: velocity.y };
        AgentAtStart { start, ..who.clone() }
    }
}

/// Steps of each leg: to the via points, then to the goal if there is one. Free times before a fixed one are
/// in proportion to distance; the others follow from a usual pace.
fn leg_steps(who: &AgentAtStart, model: &MotionModel, target: &Target, vias: &[Waypoint]) -> Vec<usize> {
    let mut places: Vec<(Vec2, Option<usize>)> = vias.iter().map(|w| (w.via.position, w.step)).collect();
    places.extend(target.position.map(|goal| (goal, Some(target.step))));
    let mut from = who.start.position();
    let mut lengths_m = Vec::with_capacity(places.len());
    for (place, _) in &places {
        lengths_m.push((place - from).norm().max(LEAST_LEG_M));
        from = *place;
    }
    let pace_mps = model.start_speed_mps().max(UNHURRIED * assumed_speed(who.agent_type));
    let mut out = vec![1; places.len()];
    let (mut first, mut passed) = (0, 0);
    while first < places.len() {
        let fixed = (first..places.len()).find_map(|k| Some((k, places[k].1?)));
        let (last, share) = match fixed {
            Some((k, step)) => {
                let metres: f64 = lengths_m[first..=k].iter().sum();
                (k, step.saturating_sub(passed).max(1) as f64 / metres)
            }
            None => (places.len() - 1, 1.0 / (pace_mps * STEP_S)),
        };
        for k in first..=last {
            out[k] = ((lengths_m[k] * share).round().max(1.0) as usize).min(HORIZON_STEPS);
        }
        passed = places[last].1.unwrap_or(passed);
        first = last + 1;
    }
    out
}

/// Progress that is at each timed via point at its time, and at the goal when it is due.
fn to_goal(
    world: &World<'_>,
    model: &MotionModel,
    target: &Target,
    vias: &[Waypoint],
    found: &Through,
    goal: Vec2,
) -> Progress {
    let from_m = found.at_m.last().copied().unwrap_or(0.0);
    let goal_m = from_m + goal_progress(&found.way.path.slice(from_m, found.way.path.length_m()), goal);
    let mut places = dated(vias, found);
    places.push((target.step, goal_m));
    let easy_mps2 = world.tuning.anchors.setting_off_mps2;
    let base = paced(model, &found.way, &places, target.speed_mps, easy_mps2);
    going_on(base, target.step, &Caps::new(found.way.path.arc_m(), &found.way.caps_mps))
}

/// Progress without a goal position. It is at each timed via point at its time, and passes all of them in the
/// window if the path allows. `share` sets its speed between the present one and the limit.
fn ahead(
    world: &World<'_>,
    model: &MotionModel,
    target: &Target,
    vias: &[Waypoint],
    found: &Through,
    share: f64,
) -> Progress {
    let (v0, way) = (model.start_speed_mps(), &found.way);
    let caps = Caps::new(way.path.arc_m(), &way.caps_mps);
    let dated = dated(vias, found);
    let from = dated.last().map_or(0, |(step, _)| *step);
    let last_m = found.at_m.last().copied().unwrap_or(0.0);
    let limit_mps = world.tuning.anchors.over_limit * way.limit_mps.max(v0);
    let mut speed_mps = match target.speed_mps {
        Some(speed_mps) => speed_mps,
        // At least the present speed: a via point is no reason to slow down.
        None => v0.min(limit_mps) + share * (limit_mps - v0).max(0.0),
    };
    let start = paced(model, way, &dated, None, world.tuning.anchors.setting_off_mps2);
    let goes = |speed_mps: f64| {
        cruising_from(&start, from, if from == 0 { v0 } else { speed_at(&start, from) }, speed_mps, &caps)
    };
    let mut base = goes(speed_mps);
    while base[HORIZON_STEPS - LEFT_STEPS] < last_m && speed_mps < PRESSED * limit_mps.max(1.0) {
        speed_mps = FASTER.0 * speed_mps + FASTER.1;
        base = goes(speed_mps);
    }
    base
}

/// Step and progress of each timed via point.
fn dated(vias: &[Waypoint], found: &Through) -> Vec<(usize, f64)> {
    vias.iter().zip(&found.at_m).filter_map(|(waypoint, at_m)| Some((waypoint.step?, *at_m))).collect()
}

/// Monotonic progress through these places at these steps; the speed at each is the average of the mean
/// speeds before and after it.
fn paced(
    model: &MotionModel,
    way: &UntimedPath,
    places: &[(usize, f64)],
    end_mps: Option<f64>,
    easy_mps2: f64,
) -> Progress {
    let mean_mps = |k: usize| {
        let (step, at_m) = places[k];
        let (before, from_m) = if k == 0 { (0, 0.0) } else { places[k - 1] };
        (at_m - from_m).max(0.0) / (step.saturating_sub(before).max(1) as f64 * STEP_S)
    };
    let mut out = [0.0; HORIZON_STEPS + 1];
    let (mut from, mut from_m, mut speed_mps) = (0, 0.0, model.start_speed_mps());
    for (k, (step, at_m)) in places.iter().enumerate() {
        let last = k + 1 == places.len();
        let end = if last { end_mps } else { Some(0.5 * (mean_mps(k) + mean_mps(k + 1))) };
        let seconds = step.saturating_sub(from).max(1) as f64 * STEP_S;
        let length_m = (at_m - from_m).max(0.0);
        let leg = TimedLeg { v0: speed_mps, from_m, length_m, seconds, end_mps: end, easy_mps2 };
        let leg =
            if model.kind == MotionKind::Walk { leg.arriving() } else { way.arriving(&leg, &model.limits) };
        for i in from..=HORIZON_STEPS {
            out[i] = from_m + leg[i - from];
        }
        speed_mps = speed_at(&leg, step - from);
        (from, from_m) = (*step, out[*step]);
    }
    out
}
