//! Table 3: goals that differ from the recording. A dragged goal must be met, or refused with a reason,
//! within the limits and without jumps, and the other road users must make room.

use super::measure::{at, goal_error, is_met, is_outside_limits};
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::TableSpec;
use super::together::STRIDE;
use super::{Case, Judged, Site, Subset};
use anyhow::Result;
use experts::{Answer, Generator, ReachReport, React, Request};
use lab_train::quantile;
use rayon::prelude::*;
use scene::geometry::direction;
use scene::geometry::obb::{OrientedBox, overlaps};
use scene::random::Key;
use scene::{AgentType, Goal, HORIZON_STEPS, Sample, Scene, State, Vec2, wrap_angle};
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Greatest number of road users whose goals are dragged.
const MOST_CASES: usize = 200;
/// Distances by which the goal is moved, metres: in both directions along the lane and across it.
const MOVES_M: [f64; 5] = [2.0, 4.0, 8.0, 15.0, 30.0];
/// Shift of the goal that tests for jumps of the answer, metres.
const NUDGE_M: f64 = 0.05;

/// Direction in which a goal was dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DragDirection {
    Along,
    Across,
}

/// One counterfactual drag.
#[derive(Clone, Debug)]
struct CounterfactualDrag {
    site: usize,
    way: DragDirection,
    /// Whether speed and heading are fixed too.
    full: bool,
    met: bool,
    /// Remaining distance to the goal's position, metres.
    left_m: f64,
    reported: bool,
    /// Distance between the reported nearest state and the shown future, metres.
    beside_report_m: f64,
    futures: usize,
    outside: usize,
    /// Vehicle steps off the lanes, and all vehicle steps.
    off: (f64, f64),
    /// Displacement of the shown future when its goal moves by 5 cm, metres.
    jump_m: f64,
    /// Overlap with any other road user: without reactions, and with all reactions.
    hits: Option<[bool; 2]>,
}

/// Table 3.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 3,
    name: "control",
    make: |trial| Ok(control(&trial.judged, &trial.sites, &trial.boot, trial.seed)?.into()),
};

/// Both sheets.
///
/// # Errors
/// When a generator fails.
fn control(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Vec<Sheet>> {
    let picked = picked(sites, seed, MOST_CASES);
    let mut sheets = [reach_sheet(), limits_sheet()];
    for own in judged {
        let drags: Result<Vec<Vec<CounterfactualDrag>>> = picked
            .par_iter()
            .map(|&(s, c)| dragged(&own.generator, &sites[s], &sites[s].cases[c], seed))
            .collect();
        let drags: Vec<CounterfactualDrag> = drags?.into_iter().flatten().collect();
        for (way, name) in [(DragDirection::Along, "along"), (DragDirection::Across, "across")] {
            for full in [false, true] {
                let mine: Vec<&CounterfactualDrag> =
                    drags.iter().filter(|d| d.way == way && d.full == full).collect();
                let fields = if full { "position, speed, heading" } else { "position" };
                let keys = [own.name.as_str(), name, fields];
                sheets[0].push(keys, reach_cells(boot, &mine));
                sheets[1].push(keys, limit_cells(boot, &mine));
            }
        }
    }
    Ok(sheets.into())
}

/// At most this many road users, drawn by the seed: indices of their sites and of the cases there.
pub(super) fn picked(sites: &[Site<'_>], seed: u64, most: usize) -> Vec<(usize, usize)> {
    let mut picked: Vec<(usize, usize)> =
        sites.iter().enumerate().flat_map(|(s, site)| (0..site.cases.len()).map(move |c| (s, c))).collect();
    Key::default().number(seed).words(&["control"]).stream().shuffle(&mut picked);
    picked.truncate(most);
    picked.sort_unstable();
    picked
}

/// The logged goal with its position moved along its lane or across it, and everything else free; `None`
/// without a position.
pub(super) fn dragged_goal(site: &Site<'_>, case: &Case, along: bool, metres: f64) -> Option<Goal> {
    let logged = case.goal(site.scene, Subset::PosSpeedHeading);
    let way = if along { DragDirection::Along } else { DragDirection::Across };
    let (position, _) = moved(site, case, logged.position?, logged.heading_rad, way, metres);
    Some(Goal { position: Some(position), time_s: logged.time_s, ..Goal::default() })
}

/// All drags of one road user.
fn dragged(
    generator: &Generator,
    site: &Site<'_>,
    case: &Case,
    seed: u64,
) -> Result<Vec<CounterfactualDrag>> {
    let log = site.log(case);
    let logged = case.goal(site.scene, Subset::PosSpeedHeading);
    let Some(base) = logged.position else { return Ok(Vec::new()) };
    let mut draw = Key::default().number(seed).words(&["nudge", site.name(), &log.id]).stream();
    let mut out = Vec::new();
    for (i, metres) in MOVES_M.into_iter().enumerate() {
        let ways = [
            (DragDirection::Along, metres),
            (DragDirection::Along, -metres),
            (DragDirection::Across, metres),
            (DragDirection::Across, -metres),
        ];
        for (k, (way, metres)) in ways.into_iter().enumerate() {
            let (position, heading) = moved(site, case, base, logged.heading_rad, way, metres);
            for full in [false, true] {
                let goal = Goal {
                    position: Some(position),
                    heading_rad: full.then_some(heading),
                    speed_mps: logged.speed_mps.filter(|_| full),
                    time_s: logged.time_s,
                };
                let nudge = direction(std::f64::consts::TAU * draw.unit()) * NUDGE_M;
                let nudged = Goal { position: Some(position + nudge), ..goal };
                let mut drag = drag(generator, site, case, goal, nudged, seed)?;
                (drag.way, drag.full) = (way, full);
                // One drag in four, in each direction in turn.
                if !full && k == i % ways.len() {
                    drag.hits = Some(hits(generator, site, case, goal, seed)?);
                }
                out.push(drag);
            }
        }
    }
    Ok(out)
}

/// A goal moved along its lane, or to its left, with the lane's heading there.
fn moved(
    site: &Site<'_>,
    case: &Case,
    base: Vec2,
    heading: Option<f64>,
    way: DragDirection,
    metres: f64,
) -> (Vec2, f64) {
    let heading = heading.unwrap_or(case.start.heading_rad);
    let hits = site.graph.nearest_for(base, 3.0, case.agent_type);
    let lane = hits.into_iter().find(|hit| wrap_angle(hit.heading_rad - heading).abs() < 0.8);
    match (way, lane) {
        (DragDirection::Along, Some(hit)) => {
            let pose = site.graph.lanes()[hit.lane].path.extrapolate(hit.s_m + metres);
            let left = direction(pose.heading_rad + FRAC_PI_2);
            let turned = wrap_angle(heading + pose.heading_rad - hit.heading_rad);
            (pose.position + left * hit.lateral_m, turned)
        }
        (DragDirection::Along, None) => (base + direction(heading) * metres, heading),
        (DragDirection::Across, lane) => {
            let along = lane.map_or(heading, |hit| hit.heading_rad);
            (base + direction(along + FRAC_PI_2) * metres, heading)
        }
    }
}

pub(super) fn request(mut scene: Scene, case: &Case, goal: Goal, seed: u64) -> Request {
    let agent = &mut scene.agents[case.agent];
    agent.conditions.goal = goal;
    let ids = BTreeSet::from([agent.id.clone()]);
    let mut request = Request::new(Arc::new(scene));
    (request.agents, request.seed) = (Some(ids), seed);
    request
}

fn drag(
    generator: &Generator,
    site: &Site<'_>,
    case: &Case,
    goal: Goal,
    nudged: Goal,
    seed: u64,
) -> Result<CounterfactualDrag> {
    let id = &site.log(case).id;
    let answered = generator.answer(request(site.blind.clone(), case, goal, seed))?;
    let again = generator.answer(request(site.blind.clone(), case, nudged, seed))?;
    let (states, other) = (shown(&answered, id), shown(&again, id));
    let apart = states.iter().zip(other).map(|(a, b)| (a.position() - b.position()).norm());
    let jump_m = apart.fold(0.0, f64::max);
    let end = states.get(case.goal_step - 1).copied().unwrap_or(case.start);
    let error = goal_error(&goal, &end);
    let nearest = match answered.resolved.get(id).map(|r| &r.reach) {
        Some(ReachReport::Unreachable { nearest, .. }) => Some(nearest.position()),
        _ => None,
    };
    let agent = &site.blind.agents[case.agent];
    let modes = answered.samples.first().and_then(|s| s.agents.get(id)).map_or(&[][..], |f| &f.modes);
    let away = |s: &&State| !site.graph.has_lane_for(s.position(), 2.5, AgentType::Vehicle);
    let driven = case.agent_type == AgentType::Vehicle && !away(&&case.start);
    let looked_at = || states.iter().take(case.goal_step).step_by(STRIDE).filter(|_| driven);
    Ok(CounterfactualDrag {
        site: site.index,
        way: DragDirection::Along,
        full: false,
        met: is_met(error),
        left_m: error[0],
        reported: nearest.is_some(),
        beside_report_m: nearest.map_or(0.0, |p| (p - end.position()).norm()),
        futures: modes.len(),
        outside: modes.iter().filter(|f| is_outside_limits(agent, &case.start, f)).count(),
        off: (looked_at().filter(away).count() as f64, looked_at().count() as f64),
        jump_m,
        hits: None,
    })
}

fn shown<'a>(answer: &'a Answer, id: &str) -> &'a [State] {
    let futures = answer.samples.first().and_then(|s| s.agents.get(id));
    futures.and_then(|f| f.modes.get(f.chosen)).map_or(&[], |f| &f.states)
}

/// Whether the dragged road user overlaps any other: while the others replay their log, and while they react.
fn hits(generator: &Generator, site: &Site<'_>, case: &Case, goal: Goal, seed: u64) -> Result<[bool; 2]> {
    let mut out = [false; 2];
    for (hit, react) in out.iter_mut().zip([React::Nobody, React::Everyone]) {
        let mut request = request(site.scene.clone(), case, goal, seed);
        request.react = react;
        let answer = generator.answer(request)?;
        *hit = answer.samples.first().is_some_and(|sample| meets_anybody(site.scene, case.agent, sample));
    }
    Ok(out)
}

/// Whether the road user's box overlaps another one at some third step, in a pair that does not overlap in
/// the log.
fn meets_anybody(scene: &Scene, agent: usize, sample: &Sample) -> bool {
    let outline = |i: usize, step: usize, generated: bool| {
        let agent = &scene.agents[i];
        let future = sample.agents.get(&agent.id).and_then(|f| f.modes.get(f.chosen));
        let state = match future.filter(|_| generated) {
            Some(future) => at(future, step).copied(),
            None => agent.state_at(step),
        };
        state.map(|s| OrientedBox::of_state(&s, &agent.size))
    };
    let meet = |j: usize, generated: bool| {
        (STRIDE..=HORIZON_STEPS).step_by(STRIDE).any(|step| {
            match (outline(agent, step, generated), outline(j, step, generated)) {
                (Some(a), Some(b)) => overlaps(&a, &b, 0.0),
                _ => false,
            }
        })
    };
    (0..scene.agents.len()).any(|j| j != agent && meet(j, true) && !meet(j, false))
}

fn reach_sheet() -> Sheet {
    Sheet::new(
        "3a Control: goals dragged away from the log",
        &[
            "Goals moved by 2, 4, 8, 15 and 30 m forwards, backwards, left and right in the lane's frame, 20 for \
             each of at most 200 road users drawn by the seed. Met within 0.05 m, 0.02 rad, 0.05 m/s; many \
             of these goals cannot be met by any motion within the limits, and must be reported then. Metres.",
        ],
        &["ours", "moved", "fixed"],
        &[
            "met",
            "met or reported",
            "left, met: p50",
            "p95",
            "max",
            "left, not met: p50",
            "p95",
            "report beside shown: p95",
            "max",
        ],
    )
}

fn reach_cells(boot: &Bootstrap, drags: &[&CounterfactualDrag]) -> Vec<Cell> {
    let flags = |holds: fn(&CounterfactualDrag) -> bool| {
        Cell::of(boot.estimate(drags.iter().map(|d| Value::flag(d.site, holds(d)))), Form::Percent)
    };
    let of = |keep: fn(&CounterfactualDrag) -> bool, value: fn(&CounterfactualDrag) -> f64| {
        sorted(drags.iter().filter(|d| keep(d)).map(|d| value(d)))
    };
    let met = of(|d| d.met, |d| d.left_m);
    let missed = of(|d| !d.met, |d| d.left_m);
    let beside = of(|d| d.reported, |d| d.beside_report_m);
    vec![
        flags(|d| d.met),
        flags(|d| d.met || d.reported),
        number(&met, 0.5, Form::Fine),
        number(&met, 0.95, Form::Fine),
        number(&met, 1.0, Form::Fine),
        number(&missed, 0.5, Form::Plain),
        number(&missed, 0.95, Form::Plain),
        number(&beside, 0.95, Form::Plain),
        number(&beside, 1.0, Form::Plain),
    ]
}

fn limits_sheet() -> Sheet {
    Sheet::new(
        "3b Control: limits, road, others, smoothness",
        &[
            "Off lanes: share of steps to the goal more than 2.5 m off every lane, vehicles that start on one. \
             Overlaps: the dragged road user with anybody, others replaying their log or reacting, one drag in \
             four. Jump: greatest distance by which the future shown moves when its goal moves by 5 cm, metres.",
        ],
        &["ours", "moved", "fixed"],
        &[
            "jumps over 1 m",
            "jump: p50",
            "p95",
            "p99",
            "futures",
            "outside limits",
            "off lanes",
            "overlaps, nobody reacts",
            "overlaps, all react",
        ],
    )
}

fn limit_cells(boot: &Bootstrap, drags: &[&CounterfactualDrag]) -> Vec<Cell> {
    let off = boot.estimate(drags.iter().map(|d| Value::share(d.site, d.off.0, d.off.1)));
    let hit = |i: usize| {
        let flags = drags.iter().filter_map(|d| Some(Value::flag(d.site, d.hits?[i])));
        Cell::of(boot.estimate(flags), Form::Percent)
    };
    let jumps = sorted(drags.iter().map(|d| d.jump_m));
    let far = boot.estimate(drags.iter().map(|d| Value::flag(d.site, d.jump_m > 1.0)));
    vec![
        Cell::of(far, Form::Percent),
        number(&jumps, 0.5, Form::Fine),
        number(&jumps, 0.95, Form::Fine),
        number(&jumps, 0.99, Form::Fine),
        Cell::Count(drags.iter().map(|d| d.futures).sum::<usize>() as u64),
        Cell::Count(drags.iter().map(|d| d.outside).sum::<usize>() as u64),
        Cell::of(off, Form::Percent),
        hit(0),
        hit(1),
    ]
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

fn number(sorted: &[f64], share: f64, form: Form) -> Cell {
    if sorted.is_empty() { Cell::Nothing } else { Cell::Number { value: quantile(sorted, share), form } }
}
