//! Table 8: the effect of refinement and of each of its parts.

use super::coherence::{SceneCoherence, from_log_m, judge};
use super::realism::closeness;
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::{Made, TableSpec};
use super::together::{Ask, Motions, logged_pairs, motions_of, scenes};
use super::{Judged, Site};
use anyhow::Result;
use experts::{Generator, Refining, Shown, Stages};
use lab_train::quantile;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::time::Instant;

/// Draws of each scene.
const DRAWS: usize = 12;
/// A collision sooner than this at constant velocity is a near miss, seconds.
const SOON_S: f64 = 1.5;

/// A variant of refinement.
#[derive(Clone, Copy)]
struct Variant {
    name: &'static str,
    steps: usize,
    diversity: f64,
    refining: Refining,
}

/// Rows of the table; the first is the product.
fn variants() -> Vec<Variant> {
    let full = Refining::default();
    let variant = |name, steps, refining| Variant { name, steps, diversity: 1.0, refining };
    vec![
        variant("complete: 5 steps", 5, full),
        Variant { diversity: 0.0, ..variant("off, without noise", 0, full) },
        variant("1 step", 1, full),
        variant("2 steps", 2, full),
        variant("10 steps", 10, full),
        variant("start level 5", 5, Refining { start: 5, ..full }),
        variant("start level 20", 5, Refining { start: 20, ..full }),
        variant("no repulsion", 5, Refining { repulsion: false, ..full }),
        variant("no attention", 5, Refining { attention: false, ..full }),
        variant("overlaps not resolved", 5, Refining { resolve_overlaps: false, ..full }),
    ]
}

const COLUMNS: [(&str, Form); 9] = [
    ("draw: in an overlap", Form::Percent),
    ("near miss", Form::Percent),
    ("past edges", Form::Percent),
    ("ADE", Form::Plain),
    ("min of 12", Form::Plain),
    ("composite", Form::Fine),
    ("chosen: in an overlap", Form::Percent),
    ("past edges", Form::Percent),
    ("first ADE", Form::Plain),
];

/// Figures of one scene, by column, and the time of its answer.
struct SceneFigures {
    values: [Option<Value>; COLUMNS.len()],
    took_ms: f64,
}

fn row(
    generator: &Generator,
    site: &Site<'_>,
    out: &BTreeSet<(usize, usize)>,
    ask: Ask,
    refining: Refining,
) -> Result<SceneFigures> {
    let run = |shown, guidance, samples| -> Result<Vec<Motions>> {
        let stages = Stages { shown, guidance, refining, ..Stages::default() };
        let found = scenes(generator, site, Ask { stages, samples, ..ask })?;
        Ok(found.iter().map(|sample| motions_of(site, sample)).collect())
    };
    let draws = run(Shown::Drawn, false, DRAWS)?;
    let started = Instant::now();
    let chosen = run(Shown::Chosen, true, 1)?;
    let took_ms = started.elapsed().as_secs_f64() * 1e3;
    let (composite, (near, counted)) = closeness(site, &draws, SOON_S);
    let judged = |all: &[Motions]| all.iter().map(|m| judge(site, m, out)).collect::<Vec<SceneCoherence>>();
    let (draws_judged, chosen) = (judged(&draws), judged(&chosen));
    let share = |all: &[SceneCoherence], value: &dyn Fn(&SceneCoherence) -> (f64, f64)| {
        let (part, whole) = all.iter().map(value).fold((0.0, 0.0), |t, v| (t.0 + v.0, t.1 + v.1));
        (whole > 0.0).then(|| Value::share(site.index, part, whole))
    };
    let overlap = |v: &SceneCoherence| (v.overlapping[2], v.moving);
    let edges = |v: &SceneCoherence| (v.road.past_edges, v.road.edge_steps);
    let distance = |v: &SceneCoherence| (v.distance, v.moving);
    let best = |agent: usize| {
        let apart = draws.iter().filter_map(|m| Some(from_log_m(site, agent, m[agent].as_ref()?)));
        apart.reduce(f64::min)
    };
    let bests: Vec<f64> = site.cases.iter().filter_map(|case| best(case.agent)).collect();
    let values = [
        share(&draws_judged, &overlap),
        (counted > 0.0).then(|| Value::share(site.index, near, counted)),
        share(&draws_judged, &edges),
        share(&draws_judged, &distance),
        (!bests.is_empty()).then(|| Value::share(site.index, bests.iter().sum(), bests.len() as f64)),
        composite.map(|c| Value::new(site.index, c)),
        share(&chosen, &overlap),
        share(&chosen, &edges),
        share(&chosen, &distance),
    ];
    Ok(SceneFigures { values, took_ms })
}

/// Table 8.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 8,
    name: "refinement",
    make: |trial| {
        let (sheets, times) = refining(&trial.judged, &trial.sites, &trial.boot, trial.seed)?;
        Ok(Made { sheets, times: vec![times], ..Made::default() })
    },
};

/// The figures, their paired differences to the complete product, and the times, which differ in each run.
///
/// # Errors
/// When a generator fails.
fn refining(
    judged: &[Judged],
    sites: &[Site<'_>],
    boot: &Bootstrap,
    seed: u64,
) -> Result<(Vec<Sheet>, Sheet)> {
    let keys = ["ours", "goals", "refinement"];
    let names = COLUMNS.map(|c| c.0);
    let mut figures = Sheet::new(
        "8a What refinement brings",
        &[
            "Whole scenes as in table 2, goals none or position, speed and heading. Draw: 12 joint scenes, of \
             each road user one future by its probability, with noise of diversity 1, nothing chosen and nothing \
             guided; shares over all of them. In an overlap: share of moving road users. Near miss: a collision \
             within 1.5 s at constant velocity. Past edges: share of vehicle steps with a corner past a road \
             edge. ADE of a draw and of the best of 12 for each road user, metres. Composite: table 4's realism, \
             of the 12 draws. Chosen: the scene shown, after choice and guidance.",
            "The same weights throughout, none trained for what is left out. No repulsion: the gradient of the \
             scene's energy is zero. Overlaps not resolved: the plain steps down the energy of boxes, boxes \
             soon and road edges that follow the last step are left out.",
        ],
        &keys,
        &names,
    );
    let mut differences = Sheet::new(
        "8b Paired differences, changed minus complete",
        &["The same scenes and seed. Shares in percentage points."],
        &keys,
        &names,
    );
    let mut times = Sheet::new(
        "8c Time of table 8's shown scenes",
        &[
            "Milliseconds a call on one thread, maps warm, whatever else the machine was doing: quantiles over \
           scenes.",
        ],
        &keys,
        &["p50", "p95"],
    );
    let sites: Vec<&Site<'_>> = sites.iter().filter(|s| s.cases.len() >= 2).collect();
    let left_out: Vec<BTreeSet<(usize, usize)>> = sites.par_iter().map(|site| logged_pairs(site)).collect();
    for own in judged {
        for goals in [false, true] {
            let mut complete: Vec<SceneFigures> = Vec::new();
            for (index, variant) in variants().into_iter().enumerate() {
                let ask =
                    Ask { steps: variant.steps, diversity: variant.diversity, ..Ask::shipped(goals, seed) };
                let jobs: Vec<_> = sites.iter().zip(&left_out).collect();
                let rows: Result<Vec<SceneFigures>> = jobs
                    .par_iter()
                    .map(|(site, out)| row(&own.generator, site, out, ask, variant.refining))
                    .collect();
                let rows = rows?;
                let keys = [own.name.as_str(), if goals { "all fixed" } else { "none" }, variant.name];
                let cell = |i: usize| {
                    Cell::of(boot.estimate(rows.iter().filter_map(|row| row.values[i])), COLUMNS[i].1)
                };
                figures.push(keys, (0..COLUMNS.len()).map(cell).collect());
                if index > 0 {
                    let cell = |i: usize| {
                        let pairs = rows.iter().zip(&complete);
                        let values = pairs.filter_map(|(row, whole)| {
                            let (changed, whole) = (row.values[i]?, whole.values[i]?);
                            Some(Value { value: changed.value - whole.value, ..whole })
                        });
                        Cell::of(boot.estimate(values), signed(COLUMNS[i].1))
                    };
                    differences.push(keys, (0..COLUMNS.len()).map(cell).collect());
                }
                times.push(keys, spread(&rows));
                if index == 0 {
                    complete = rows;
                }
            }
        }
    }
    Ok((vec![figures, differences], times))
}

fn signed(form: Form) -> Form {
    match form {
        Form::Percent => Form::SignedPercent,
        Form::Fine => Form::SignedFine,
        _ => Form::Signed,
    }
}

fn spread(rows: &[SceneFigures]) -> Vec<Cell> {
    let mut all: Vec<f64> = rows.iter().map(|row| row.took_ms).collect();
    all.sort_by(f64::total_cmp);
    [0.5, 0.95].map(|share| Cell::Number { value: quantile(&all, share), form: Form::Plain }).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{log, scene, shifted};

    #[test]
    fn every_way_has_its_line_and_differences_are_paired() {
        let scenes: Vec<_> =
            [7.0, 9.0].map(|v| scene(vec![log("a", v, 91), shifted(log("b", 5.0, 91), 12.0, 0.0)])).into();
        let sites: Vec<Site<'_>> = scenes.iter().enumerate().map(|(i, s)| Site::new(i, s)).collect();
        let generator = Generator::random(2).unwrap().with_threads(1);
        let judged = [Judged { name: "random".into(), generator }];
        let (sheets, times) = refining(&judged, &sites, &Bootstrap::new(2, 1), 1).unwrap();
        let [figures, differences] = &sheets[..] else { panic!("two sheets") };
        let count = variants().len();
        assert_eq!((figures.lines.len(), times.lines.len()), (2 * count, 2 * count));
        assert_eq!(differences.lines.len(), 2 * (count - 1));
        let mean = |cell: &Cell| match cell {
            Cell::Estimate { estimate, .. } => estimate.mean,
            _ => panic!("no figure"),
        };
        for (k, line) in differences.lines.iter().enumerate() {
            let (block, variant) = (k / (count - 1) * count, k % (count - 1) + 1);
            assert_eq!(line.keys, figures.lines[block + variant].keys);
            let cells =
                [&figures.lines[block + variant], &figures.lines[block], line].map(|l| mean(&l.cells[3]));
            assert!((cells[0] - cells[1] - cells[2]).abs() < 1e-9, "{cells:?}");
        }
        // The variants differ from each other as far as random weights can show it.
        let ades: BTreeSet<u64> =
            figures.lines[..count].iter().map(|l| mean(&l.cells[3]).to_bits()).collect();
        assert!(ades.len() >= count - 1, "{ades:?}");
    }
}
