//! Table 5: whether the futures differ, and whether the diversity setting increases the difference.

use super::measure::measure;
use super::quality::request;
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::TableSpec;
use super::{Case, Judged, Site, Subset, type_name};
use anyhow::Result;
use experts::{Generator, Request};
use rayon::prelude::*;
use scene::routes::{LaneGraph, Polyline, Pose, Route, route_length_m, routes_ahead};
use scene::{AgentFutures, AgentType, Future, State, wrap_angle};
use std::collections::BTreeSet;

/// Settings of diversity that are compared.
const DIVERSITIES: [f64; 4] = [0.0, 0.5, 1.0, 2.0];
/// Samples without a goal in which exits are searched.
const SAMPLES: usize = 12;
/// Exits count as one if their headings differ by less than this.
const SAME_EXIT_RAD: f64 = 0.5;
/// A future that ends this near a route has taken it, metres.
const ON_ROUTE_M: f64 = 3.0;

/// Table 5.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 5,
    name: "variety",
    make: |trial| Ok(variety(&trial.judged, &trial.sites, &trial.boot, trial.seed)?.into()),
};

/// Both sheets.
///
/// # Errors
/// When a generator fails.
fn variety(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Vec<Sheet>> {
    let mut spread = Sheet::new(
        "5a Variety against the diversity setting",
        &["Metres. Spread: mean distance between the ends of two of the six futures; without a goal at the \
           log's last frame, with a goal half way there. Copies: share of the six within a mean distance of 1 m (0.5 m \
           with a goal) of a likelier one. Seeds: mean distance between the same future of two seeds. One road user \
           at a time."],
        &["ours", "type", "condition", "diversity"],
        &["spread", "copies", "seeds", "minADE6", "first ADE"],
    );
    let mut exits = Sheet::new(
        "5b Exits found at crossings",
        &[
            "Vehicles from whose lane the routes ahead leave in at least two directions (0.5 rad apart) within \
           what can be driven in 9 s: share of those directions that appear among 12 samples without a goal. \
           A sample that stops before the ways part counts for none.",
        ],
        &["ours"],
        &["share found", "directions", "samples beyond the fork"],
    );
    for own in judged {
        for subset in [Subset::None, Subset::Pos] {
            for diversity in DIVERSITIES {
                let found: Result<Vec<Vec<Spread>>> = sites
                    .par_iter()
                    .map(|site| {
                        let cases = site.cases.iter();
                        let all =
                            cases.map(|case| of_case(&own.generator, site, case, subset, diversity, seed));
                        Ok(all.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
                    })
                    .collect();
                let found: Vec<Spread> = found?.into_iter().flatten().collect();
                let mine = |agent_type| found.iter().filter(move |s| s.agent_type == agent_type);
                for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
                    let mean = |value: fn(&Spread) -> f64| {
                        let values = mine(agent_type).map(|s| Value::new(s.site, value(s)));
                        Cell::of(boot.estimate(values), Form::Plain)
                    };
                    let copies = mine(agent_type).map(|s| Value::new(s.site, s.copies));
                    let cells = vec![
                        mean(|s| s.apart),
                        Cell::of(boot.estimate(copies), Form::Percent),
                        mean(|s| s.seeds),
                        mean(|s| s.min_ade),
                        mean(|s| s.first_ade),
                    ];
                    if cells[0] != Cell::Nothing {
                        let keys =
                            [&own.name, type_name(agent_type), subset.name(), &format!("{diversity:.1}")];
                        spread.push(keys, cells);
                    }
                }
            }
        }
        let found: Result<Vec<Vec<RedLineCrossing>>> = sites
            .par_iter()
            .map(|site| {
                let vehicles = site.cases.iter().filter(|c| c.agent_type == AgentType::Vehicle);
                let all = vehicles.map(|case| crossing(&own.generator, site, case, seed));
                Ok(all.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
            })
            .collect();
        let found: Vec<RedLineCrossing> = found?.into_iter().flatten().collect();
        let share = |value: fn(&RedLineCrossing) -> f64, form| {
            Cell::of(boot.estimate(found.iter().map(|c| Value::new(c.site, value(c)))), form)
        };
        exits.push(
            [own.name.as_str()],
            vec![
                share(|c| c.found / c.exits, Form::Percent),
                share(|c| c.exits, Form::Plain),
                share(|c| c.beyond, Form::Percent),
            ],
        );
    }
    Ok(vec![spread, exits])
}

struct Spread {
    site: usize,
    agent_type: AgentType,
    apart: f64,
    copies: f64,
    seeds: f64,
    min_ade: f64,
    first_ade: f64,
}

fn ask(site: &Site<'_>, case: &Case, subset: Subset, seed: u64) -> Request {
    request(site.asked(case, subset), &site.log(case).id, true, seed)
}

fn of_case(
    generator: &Generator,
    site: &Site<'_>,
    case: &Case,
    subset: Subset,
    diversity: f64,
    seed: u64,
) -> Result<Option<Spread>> {
    let log = site.log(case);
    let mut request = ask(site, case, subset, seed);
    request.diversity = diversity;
    let again = Request { seed: seed + 1, ..request.clone() };
    let (answer, again) = (generator.answer(request)?, generator.answer(again)?);
    let of = |answer: &experts::Answer| answer.samples.first().and_then(|s| s.agents.get(&log.id)).cloned();
    let (Some(futures), Some(again)) = (of(&answer), of(&again)) else { return Ok(None) };
    let futures = &futures;
    let m = measure(log, case, subset, &futures.modes, futures.chosen);
    let end = if subset.has_position() { case.goal_step.div_ceil(2) } else { case.goal_step };
    let (min_ade, first_ade) = (m.min_ade, m.first_ade);
    let apart = pairwise(futures, end);
    let copies = copies(futures, if subset.has_position() { 0.5 } else { 1.0 });
    let seeds = moved(futures, &again);
    Ok(Some(Spread {
        site: site.index,
        agent_type: case.agent_type,
        apart,
        copies,
        seeds,
        min_ade,
        first_ade,
    }))
}

/// Mean distance of two futures, metres.
fn distance(a: &Future, b: &Future) -> f64 {
    let pairs = a.states.iter().zip(&b.states);
    let sum: f64 = pairs.map(|(a, b)| (a.position() - b.position()).norm()).sum();
    sum / a.states.len().min(b.states.len()).max(1) as f64
}

/// Share of futures within this distance of an earlier one.
fn copies(futures: &AgentFutures, same_m: f64) -> f64 {
    let modes = &futures.modes;
    let copy = |i: &usize| modes[..*i].iter().any(|other| distance(&modes[*i], other) < same_m);
    (0..modes.len()).filter(copy).count() as f64 / modes.len().max(1) as f64
}

/// Mean distance between the futures of two answers on the same anchor, metres.
fn moved(a: &AgentFutures, b: &AgentFutures) -> f64 {
    let same = |f: &Future| b.modes.iter().find(|g| g.anchor == f.anchor).map(|g| distance(f, g));
    let each: Vec<f64> = a.modes.iter().filter_map(same).collect();
    each.iter().sum::<f64>() / each.len().max(1) as f64
}

/// Mean distance between two futures at a step; zero for fewer than two.
fn pairwise(futures: &AgentFutures, step: usize) -> f64 {
    let ends: Vec<&State> = futures.modes.iter().filter_map(|f| super::measure::at(f, step)).collect();
    let (mut sum, mut n) = (0.0, 0.0);
    for (i, a) in ends.iter().enumerate() {
        for b in &ends[i + 1..] {
            sum += (a.position() - b.position()).norm();
            n += 1.0;
        }
    }
    if n > 0.0 { sum / n } else { 0.0 }
}

struct RedLineCrossing {
    site: usize,
    exits: f64,
    found: f64,
    beyond: f64,
}

fn crossing(
    generator: &Generator,
    site: &Site<'_>,
    case: &Case,
    seed: u64,
) -> Result<Option<RedLineCrossing>> {
    let exits = exits(&site.graph, case);
    if exits.len() < 2 {
        return Ok(None);
    }
    let mut request = ask(site, case, Subset::None, seed);
    request.samples = SAMPLES;
    let answer = generator.answer(request)?;
    let id = &site.log(case).id;
    let taken: Vec<usize> = answer
        .samples
        .iter()
        .filter_map(|s| s.agents.get(id)?.modes.get(s.agents.get(id)?.chosen))
        .filter_map(|future| exit_of(&exits, future))
        .collect();
    let found: BTreeSet<usize> = taken.iter().copied().collect();
    Ok(Some(RedLineCrossing {
        site: site.index,
        exits: exits.len() as f64,
        found: found.len() as f64,
        beyond: taken.len() as f64 / SAMPLES as f64,
    }))
}

/// Routes ahead by the direction in which they leave.
fn exits(graph: &LaneGraph, case: &Case) -> Vec<Vec<Polyline>> {
    let pose = Pose::new(case.start.position(), case.start.heading_rad);
    let length = route_length_m(case.start.speed_mps());
    let mut out: Vec<Vec<Polyline>> = Vec::new();
    for Route { path, .. } in routes_ahead(graph, pose, case.agent_type, length) {
        let heading = path.last().heading_rad;
        let same = |group: &&mut Vec<Polyline>| {
            wrap_angle(group[0].last().heading_rad - heading).abs() < SAME_EXIT_RAD
        };
        match out.iter_mut().find(same) {
            Some(group) => group.push(path),
            None => out.push(vec![path]),
        }
    }
    out
}

/// The only direction whose routes contain a future's end; `None` before the routes diverge, or off all of
/// them.
fn exit_of(exits: &[Vec<Polyline>], future: &Future) -> Option<usize> {
    let end = future.states.last()?;
    let on = |path: &Polyline| {
        let foot = path.project(end.position());
        foot.distance_m < ON_ROUTE_M && wrap_angle(foot.heading_rad - end.heading_rad).abs() < SAME_EXIT_RAD
    };
    let mut fitting = (0..exits.len()).filter(|i| exits[*i].iter().any(on));
    let first = fitting.next()?;
    fitting.next().is_none().then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::straight;
    use scene::Vec2;

    #[test]
    fn spread_of_two_futures() {
        let futures = AgentFutures::of(0, vec![straight(0.5, 10.0, 0.0), straight(0.5, 10.0, 3.0)]);
        assert!((pairwise(&futures, 90) - 3.0).abs() < 1e-9);
    }

    #[test]
    fn a_future_takes_the_exit_it_ends_on() {
        let on = Polyline::new([Vec2::new(0.0, 0.0), Vec2::new(120.0, 0.0)]);
        let left = Polyline::new([Vec2::new(0.0, 0.0), Vec2::new(50.0, 0.0), Vec2::new(50.0, 90.0)]);
        let exits = vec![vec![on], vec![left]];
        assert_eq!(exit_of(&exits, &straight(1.0, 10.0, 0.0)), Some(0));
        // Before the fork, both routes fit.
        assert_eq!(exit_of(&exits, &straight(1.0, 4.0, 0.0)), None);
        assert_eq!(exit_of(&exits, &straight(1.0, 10.0, 20.0)), None);
    }
}
