//! Table 7: the contribution of each part of the product, measured by leaving it out.

use super::measure::{given_motion, is_met, left_to_goal, log_loss, measure};
use super::quality::request;
use super::roads::OffRoad;
use super::sheet::{Cell, Form, Sheet};
use super::stats::{Bootstrap, Value};
use super::table::TableSpec;
use super::{Case, Judged, Site, Subset};
use anyhow::Result;
use experts::{Generator, Request, Shown};
use rayon::prelude::*;
use scene::AgentType;

/// Part of the product that is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Without {
    Nothing,
    Neighbours,
    Signals,
    Routes,
    Projection,
    Parting,
    Refinement,
    Choice,
}

impl Without {
    const ALL: [Self; 8] = [
        Self::Nothing,
        Self::Neighbours,
        Self::Signals,
        Self::Routes,
        Self::Projection,
        Self::Parting,
        Self::Refinement,
        Self::Choice,
    ];

    fn name(self) -> &'static str {
        match self {
            Self::Nothing => "complete",
            Self::Neighbours => "no neighbours",
            Self::Signals => "no signals",
            Self::Routes => "no route anchors",
            Self::Projection => "no projection",
            Self::Parting => "no parting",
            Self::Refinement => "no refinement",
            Self::Choice => "no choice",
        }
    }

    /// The request of table 1 without this part.
    fn request(self, site: &Site<'_>, case: &Case, subset: Subset, seed: u64) -> Request {
        let id = &site.log(case).id;
        let mut scene = site.asked(case, subset);
        match self {
            Self::Neighbours => scene.agents.retain(|agent| agent.id == *id),
            Self::Signals => scene.signals.clear(),
            _ => {}
        }
        let mut request = request(scene, id, self != Self::Refinement, seed);
        match self {
            Self::Routes => request.stages.planning.routes = false,
            Self::Projection => request.stages.planning.projection = false,
            Self::Parting => request.stages.parted = false,
            Self::Choice => (request.stages.shown, request.stages.guidance) = (Shown::Likeliest, false),
            _ => {}
        }
        request
    }
}

/// Conditions of the table.
const SUBSETS: [Subset; 2] = [Subset::None, Subset::PosSpeedHeading];

/// Answers of one road user under one condition, in the order of [`Without::ALL`].
struct CaseAnswers {
    site: usize,
    subset: Subset,
    found: [Option<Found>; Without::ALL.len()],
}

/// Figures of one answer.
#[derive(Clone, Copy)]
struct Found {
    min_ade: f64,
    first_ade: f64,
    log_loss: Option<f64>,
    /// 1 if the shown future meets its goal, 0 if not; `None` without a goal.
    met: Option<f64>,
    road: OffRoad,
}

impl Found {
    /// The table's columns for the scene of this index: value and weight.
    fn values(&self, site: usize) -> [Option<Value>; COLUMNS.len()] {
        let [off, past] = self.road.shares(site).map(|v| (v.weight > 0.0).then_some(v));
        let plain = |x| Some(Value::new(site, x));
        let [log_loss, met] = [self.log_loss, self.met].map(|x| x.and_then(plain));
        [plain(self.min_ade), plain(self.first_ade), log_loss, met, off, past]
    }
}

const COLUMNS: [&str; 6] = ["minADE6", "first ADE", "log loss", "goals met", "off lanes", "past edges"];
/// Columns before this index are plain numbers, the others are shares.
const FIRST_SHARE: usize = 3;

fn found(
    generator: &Generator,
    site: &Site<'_>,
    case: &Case,
    subset: Subset,
    without: Without,
    seed: u64,
) -> Result<Option<Found>> {
    let log = site.log(case);
    let answer = generator.answer(without.request(site, case, subset, seed))?;
    let Some(futures) = answer.samples.first().and_then(|s| s.agents.get(&log.id)) else { return Ok(None) };
    let Some(shown) = futures.modes.get(futures.chosen) else { return Ok(None) };
    let m = measure(log, case, subset, &futures.modes, futures.chosen);
    let probabilities = given_motion(&futures.modes);
    let goal = case.goal(site.scene, subset);
    let met = left_to_goal(&goal, case, shown).is_some_and(is_met);
    Ok(Some(Found {
        min_ade: m.min_ade,
        first_ade: m.first_ade,
        log_loss: log_loss(&probabilities, m.best),
        met: (!goal.is_free()).then_some(f64::from(u8::from(met))),
        road: OffRoad::of(site, case.agent, &shown.states),
    }))
}

fn rows(generator: &Generator, site: &Site<'_>, seed: u64) -> Result<Vec<CaseAnswers>> {
    let mut out = Vec::new();
    for case in site.cases.iter().filter(|c| c.agent_type == AgentType::Vehicle) {
        for subset in SUBSETS {
            let mut row = CaseAnswers { site: site.index, subset, found: [None; Without::ALL.len()] };
            for (slot, without) in row.found.iter_mut().zip(Without::ALL) {
                *slot = found(generator, site, case, subset, without, seed)?;
            }
            out.push(row);
        }
    }
    Ok(out)
}

/// Table 7.
pub(super) const TABLE: TableSpec = TableSpec {
    number: 7,
    name: "ablations",
    make: |trial| Ok(ablation(&trial.judged, &trial.sites, &trial.boot, trial.seed)?.into()),
};

/// The figures, and their paired differences to the complete product.
///
/// # Errors
/// When a generator fails.
fn ablation(judged: &[Judged], sites: &[Site<'_>], boot: &Bootstrap, seed: u64) -> Result<Vec<Sheet>> {
    let keys = ["ours", "condition", "left out"];
    let mut figures = Sheet::new(
        "7a Vehicles with a part left out",
        &[
            "Distances in metres. One vehicle at a time as in table 1: of all others only the state at the \
             first step is known, and nobody is kept out of the way of. The same weights throughout, none \
             trained for what is left out. \"First\" is the future shown; log loss of the best future given \
             that the vehicle moves, six even ones give 1.79. Goals met: share of the cases with a goal in which the future shown meets \
             it. Off lanes: share of the shown future's steps more than 2.5 m off every lane; past edges: \
             with a corner past a road edge; n counts steps there (every third one at which the log is known).",
            "No neighbours: the others are not there at all, neither as features nor as leaders. No signals: \
             the lights are not there. No route anchors: those of a vehicle with no lane near (straight on and \
             two arcs; least effort to a goal); one at rest then counts as parked. No projection: motions keep \
             the limits, but what is left to the goal is left. No parting: futures that coincide stay so. \
             No refinement: the initializer's futures \
             without noise. No choice: the most probable future is shown.",
        ],
        &keys,
        &COLUMNS,
    );
    let mut differences = Sheet::new(
        "7b Paired differences, with a part left out minus complete",
        &["The same vehicles and steps; above zero the part helps. Shares in percentage points."],
        &keys,
        &COLUMNS,
    );
    for own in judged {
        let all: Result<Vec<Vec<CaseAnswers>>> =
            sites.par_iter().map(|s| rows(&own.generator, s, seed)).collect();
        let all: Vec<CaseAnswers> = all?.into_iter().flatten().collect();
        for subset in SUBSETS {
            for (index, without) in Without::ALL.into_iter().enumerate() {
                let mine = || all.iter().filter(|row| row.subset == subset);
                let keys = [own.name.as_str(), subset.name(), without.name()];
                let cell = |column: usize| {
                    let values = mine().filter_map(|r| r.found[index]?.values(r.site)[column]);
                    let form = if column < FIRST_SHARE { Form::Plain } else { Form::Percent };
                    Cell::of(boot.estimate(values), form)
                };
                if mine().any(|row| row.found[index].is_some()) {
                    figures.push(keys, (0..COLUMNS.len()).map(cell).collect());
                }
                let cell = |column: usize| {
                    let values = mine().filter_map(|row| difference(row, index, column));
                    let form = if column < FIRST_SHARE { Form::Signed } else { Form::SignedPercent };
                    Cell::of(boot.estimate(values), form)
                };
                if without != Without::Nothing && mine().any(|row| difference(row, index, 0).is_some()) {
                    differences.push(keys, (0..COLUMNS.len()).map(cell).collect());
                }
            }
        }
    }
    Ok(vec![figures, differences])
}

/// Figure of a row with a part left out minus that of the complete product; `None` if either is missing.
fn difference(row: &CaseAnswers, index: usize, column: usize) -> Option<Value> {
    let [without, complete] = [index, 0].map(|i| row.found[i].and_then(|f| f.values(row.site)[column]));
    let (without, complete) = (without?, complete?);
    Some(Value::share(row.site, without.value - complete.value, complete.weight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lab_train::samples::{log, scene, shifted};
    use scene::{Signal, SignalState};

    fn road() -> scene::Scene {
        let mut walker = shifted(log("walker", 1.2, 91), 5.0, 8.0);
        walker.agent_type = AgentType::Pedestrian;
        let mut scene = scene(vec![log("a", 8.0, 91), shifted(log("b", 5.0, 91), 12.0, 0.0), walker]);
        let runs = vec![(0, SignalState::Stop)];
        scene.signals.push(Signal { lane: "a".into(), stop: None, stop_z_m: None, runs });
        scene
    }

    #[test]
    fn each_request_leaves_out_one_part() {
        let scene = road();
        let site = Site::new(0, &scene);
        let of = |without: Without| without.request(&site, &site.cases[0], Subset::PosSpeedHeading, 3);
        let complete = of(Without::Nothing);
        for without in Without::ALL {
            let request = of(without);
            let differs = [
                request.scene.agents.len() != 3,
                request.scene.signals.is_empty(),
                !request.stages.planning.routes,
                !request.stages.planning.projection,
                !request.stages.parted,
                request.steps == 0 && request.diversity == 0.0,
                request.stages.shown == Shown::Likeliest,
            ];
            let changed = differs.iter().filter(|d| **d).count();
            assert_eq!(changed, usize::from(without != Without::Nothing), "{without:?}");
            assert!(!request.stages.background_in_the_way);
            let goal = |r: &Request| r.scene.agents[0].conditions.goal;
            assert_eq!(goal(&request), goal(&complete));
        }
    }

    #[test]
    fn every_part_has_its_lines_and_differences_are_paired() {
        let scenes = [road(), road()];
        let sites: Vec<Site<'_>> = scenes.iter().enumerate().map(|(i, s)| Site::new(i, s)).collect();
        let generator = Generator::random(2).unwrap().with_threads(1);
        let judged = [Judged { name: "random".into(), generator }];
        let sheets = ablation(&judged, &sites, &Bootstrap::new(2, 1), 1).unwrap();
        let [figures, differences] = &sheets[..] else { panic!("two sheets") };
        assert_eq!(figures.lines.len(), SUBSETS.len() * Without::ALL.len());
        assert_eq!(differences.lines.len(), SUBSETS.len() * (Without::ALL.len() - 1));
        let mean = |sheet: &Sheet, line: usize, column: usize| match sheet.lines[line].cells[column] {
            // Two vehicles in each of two scenes; pedestrians do not count.
            Cell::Estimate { estimate, .. } if column < 2 => (estimate.mean, estimate.samples == 4),
            Cell::Estimate { estimate, .. } => (estimate.mean, estimate.samples == 4 * 30),
            _ => panic!("no figure"),
        };
        for (k, line) in differences.lines.iter().enumerate() {
            let parts = Without::ALL.len();
            let (block, part) = (k / (parts - 1) * parts, k % (parts - 1) + 1);
            assert_eq!(line.keys, figures.lines[block + part].keys);
            for column in [0, 1, 4] {
                let (difference, counted) = mean(differences, k, column);
                let expected = mean(figures, block + part, column).0 - mean(figures, block, column).0;
                assert!((difference - expected).abs() < 1e-9 && counted, "{:?}", line.keys);
            }
            // The map has no edges.
            assert_eq!(line.cells[5], Cell::Nothing);
        }
    }
}
