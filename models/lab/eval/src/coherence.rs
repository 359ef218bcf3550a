//! Table 2: the coherence of scenes whose road users are generated together.

use super::measure::mean_distance_m;
use super::rivals::{Together, least_effort};
use super::roads::OffRoad;
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::{Made, TableSpec};
use super::together::{
    Ask, Boxes, MOMENTS, Motions, STRIDE, logged_pairs, motions_by, motions_of, motions_of_log, scenes,
};
use super::{Entrants, Judged, Site};
use anyhow::Result;
use experts::{Shown, Stages};
use rayon::prelude::*;
use scene::{HORIZON_STEPS, STEP_S, State};
use std::collections::BTreeSet;

/// Coherence figures of one scene.
#[derive(Clone, Debug, Default)]
pub(super) struct SceneCoherence {
    /// Moving road users.
    pub(super) moving: f64,
    /// Moving road users in an overlap that begins within 3, 6 and 9 s.
    pub(super) overlapping: [f64; 3],
    /// Share of all generated road users in a collision by the paper's definition.
    paper: f64,
    /// Off-road figures of the moving vehicles.
    pub(super) road: OffRoad,
    /// Sum of the moving road users' mean distances from the log, metres.
    pub(super) distance: f64,
}

/// Of scenes.
const STEPS_A_SECOND: f64 = 10.0;

/// Seconds within which overlaps are counted.
const WITHIN_S: [f64; 3] = [3.0, 6.0, 9.0];

/// Evaluates one scene; the given pairs may overlap.
pub(super) fn judge(
    site: &Site<'_>,
    motions: &Motions,
    left_out: &BTreeSet<(usize, usize)>,
) -> SceneCoherence {
    let moving: BTreeSet<usize> =
        site.cases.iter().map(|c| c.agent).filter(|i| motions[*i].is_some()).collect();
    let meetings: Vec<_> =
        Boxes::new(site, motions).meetings().into_iter().filter(|m| !left_out.contains(&m.pair)).collect();
    let both = |pair: (usize, usize)| [pair.0, pair.1];
    let within = |seconds: f64| {
        let last = (seconds / (STRIDE as f64 * STEP_S)).round() as usize;
        let soon = meetings.iter().filter(|m| m.first < last.min(MOMENTS));
        let met: BTreeSet<usize> = soon.flat_map(|m| both(m.pair)).collect();
        met.intersection(&moving).count() as f64
    };
    let paper: BTreeSet<usize> = meetings.iter().filter(|m| m.paper).flat_map(|m| both(m.pair)).collect();
    let present = motions.iter().flatten().count().max(1) as f64;
    let mut out = SceneCoherence {
        moving: moving.len() as f64,
        overlapping: WITHIN_S.map(within),
        paper: paper.len() as f64 / present,
        ..SceneCoherence::default()
    };
    for &i in &moving {
        let Some(states) = &motions[i] else { continue };
        out.distance += from_log_m(site, i, states);
        out.road.add(&OffRoad::of(site, i, states));
    }
    out
}

/// Mean distance of states at steps 1 ..= 90 from an agent's log, metres.
pub(super) fn from_log_m(site: &Site<'_>, agent: usize, states: &[State]) -> f64 {
    mean_distance_m(&site.scene.agents[agent], |step| states[step - 1].position())
}

/// Settings of the product for each row of the table.
const LINES: [(&str, usize, f64, Shown, bool); 5] = [
    ("initializer, most probable", 0, 0.0, Shown::Likeliest, false),
    ("initializer, random future", 0, 0.0, Shown::Drawn, false),
    ("+ refinement, no choice", 5, 1.0, Shown::Drawn, false),
    ("+ choice", 5, 1.0, Shown::Chosen, false),
    ("+ guidance: the product", 5, 1.0, Shown::Chosen, true),
];

/// Table 2.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 2,
    name: "coherence",
    make: |trial| {
        let replan_steps = trial.replan_steps;
        let sheet = coherence(trial.entrants(), &trial.sites, &trial.boot, replan_steps, trial.seed)?;
        Ok(Made::from(vec![sheet]))
    },
};

/// Joint generation of all road users, over scenes with at least two moving ones.
///
/// The product also has a row for each of `replan_steps`, the steps between replans (1..=90).
///
/// # Errors
/// When a generator fails.
fn coherence(
    entrants: Entrants<'_>,
    sites: &[Site<'_>],
    boot: &Bootstrap,
    replan_steps: &[usize],
    seed: u64,
) -> Result<Sheet> {
    let mut sheet = Sheet::new(
        "2 Coherence of whole scenes",
        &[
            "Everybody that is there at the first step is generated together, at most 128, from the states at \
             that step alone. Boxes overlap strictly (any overlap), every third step, where the log is known; \
             pairs that overlap in the log are left out (the log's own line shows them). Shares are of moving \
             road users; \"paper's rate\" is the mean over scenes of the share of all road users whose boxes' \
             intersection over union passes 0.02. Off lanes: share of vehicle steps more than 2.5 m off every \
             lane; past edges: with a corner past a road edge. ADE of the futures shown, metres. Plans are made \
             once for the 9 s, but in the lines that say how often everybody plans anew from the states reached.",
            "With goals: position, speed and heading of the log's end for those that move; what stands keeps \
             its place.",
            "A learned rival that knows vehicles alone has the others go the way of least effort.",
        ],
        &["goals", "what"],
        &[
            "in an overlap, 9 s",
            "within 6 s",
            "within 3 s",
            "scenes with any",
            "paper's rate",
            "off lanes",
            "past edges",
            "ADE",
        ],
    );
    let sites: Vec<&Site<'_>> = sites.iter().filter(|s| s.cases.len() >= 2).collect();
    let left_out: Vec<BTreeSet<(usize, usize)>> = sites.par_iter().map(|site| logged_pairs(site)).collect();
    let nothing = BTreeSet::new();
    let verdicts = |motions: &[Motions], logs: bool| -> Vec<SceneCoherence> {
        let jobs: Vec<_> = sites.iter().zip(motions).zip(&left_out).collect();
        jobs.par_iter()
            .map(|((site, motions), out)| judge(site, motions, if logs { &nothing } else { out }))
            .collect()
    };
    for goals in [false, true] {
        let word = if goals { "all fixed" } else { "none" };
        let mut line = |name: &str, verdicts: &[SceneCoherence]| {
            sheet.push([word, name], cells(boot, &sites, verdicts));
        };
        let logs: Vec<Motions> = sites.iter().map(|site| motions_of_log(site)).collect();
        line("log", &verdicts(&logs, true));
        let prior: Vec<Motions> = sites
            .par_iter()
            .map(|site| {
                motions_by(site, goals, |i, start, goal, step| {
                    least_effort(&site.blind.agents[i], start, goal, step)
                })
            })
            .collect();
        line("prior", &verdicts(&prior, false));
        for baseline in entrants.baselines.iter().filter(|b| !goals || b.has_condition()) {
            let all: Result<Vec<Together<'_>>> =
                sites.par_iter().map(|site| Together::new(baseline, site, goals)).collect();
            let all = all?;
            let likeliest: Vec<Motions> = all.iter().map(Together::likeliest).collect();
            line(&format!("{}: most probable", baseline.name), &verdicts(&likeliest, false));
            let drawn: Vec<Motions> = all.iter().map(|scene| scene.drawn(seed, 0)).collect();
            line(&format!("{}: random future", baseline.name), &verdicts(&drawn, false));
        }
        for own in entrants.judged {
            let mut product = Vec::new();
            for (name, steps, diversity, shown, guidance) in LINES {
                let stages = Stages { shown, guidance, ..Stages::default() };
                let ask = Ask { steps, diversity, stages, ..Ask::shipped(goals, seed) };
                product = verdicts(&generated_motions(own, &sites, ask)?, false);
                line(&format!("{}: {name}", own.name), &product);
            }
            for &steps in replan_steps {
                let name = format!("{}: re-planned every {} s", own.name, steps as f64 / STEPS_A_SECOND);
                // A single plan for 9 s is the product as it is.
                if steps == HORIZON_STEPS {
                    line(&name, &product);
                    continue;
                }
                let ask = Ask { replan_steps: Some(steps), ..Ask::shipped(goals, seed) };
                line(&name, &verdicts(&generated_motions(own, &sites, ask)?, false));
            }
        }
    }
    Ok(sheet)
}

/// Shown motion of all road users, by site.
fn generated_motions(own: &Judged, sites: &[&Site<'_>], ask: Ask) -> Result<Vec<Motions>> {
    let of = |site: &&Site<'_>| {
        let samples = scenes(&own.generator, site, ask)?;
        Ok(samples.first().map_or_else(|| vec![None; site.scene.agents.len()], |s| motions_of(site, s)))
    };
    sites.par_iter().map(of).collect()
}

fn cells(boot: &Bootstrap, sites: &[&Site<'_>], verdicts: &[SceneCoherence]) -> Vec<Cell> {
    let share = |value: &dyn Fn(&SceneCoherence) -> (f64, f64), form| {
        let values = sites.iter().zip(verdicts).map(|(site, v)| {
            let (part, whole) = value(v);
            Value::share(site.index, part, whole)
        });
        Cell::of(boot.estimate(values), form)
    };
    vec![
        share(&|v| (v.overlapping[2], v.moving), Form::Percent),
        share(&|v| (v.overlapping[1], v.moving), Form::Percent),
        share(&|v| (v.overlapping[0], v.moving), Form::Percent),
        share(&|v| (f64::from(u8::from(v.overlapping[2] > 0.0)), 1.0), Form::Percent),
        share(&|v| (v.paper, 1.0), Form::Percent),
        share(&|v| (v.road.off_lanes, v.road.steps), Form::Percent),
        share(&|v| (v.road.past_edges, v.road.edge_steps), Form::Percent),
        share(&|v| (v.distance, v.moving), Form::Plain),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{log, scene, shifted};

    #[test]
    fn overlaps_are_counted_once_a_road_user_and_in_time() {
        // The second car catches up with the first: both 4.7 m long, 35 m behind, 5 m/s faster: after 6 s.
        let scene = scene(vec![
            shifted(log("a", 5.0, 91), 35.0, 0.0),
            log("b", 5.0, 91),
            shifted(log("c", 5.0, 91), 0.0, 40.0),
        ]);
        let site = Site::new(0, &scene);
        let mut motions = motions_of_log(&site);
        if let Some(states) = &mut motions[1] {
            for (i, s) in states.iter_mut().enumerate() {
                (s.x_m, s.vx_mps) = (1.0 * (i + 1) as f64, 10.0);
            }
        }
        let verdict = judge(&site, &motions, &BTreeSet::new());
        assert_eq!(verdict.moving, 3.0);
        assert_eq!(verdict.overlapping, [0.0, 0.0, 2.0]);
        assert!((verdict.paper - 2.0 / 3.0).abs() < 1e-9);
        // The third drives 40 m beside the lanes.
        assert!((verdict.road.off_lanes / verdict.road.steps - 1.0 / 3.0).abs() < 1e-9);
        let excused = judge(&site, &motions, &BTreeSet::from([(0, 1)]));
        assert_eq!(excused.overlapping, [0.0; 3]);
    }
}
