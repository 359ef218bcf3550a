//! Many scenes, templates and seeds in one call: in parallel, one file each, with a table of the kept
//! results.

use super::GenerateArgs;
use super::made::{MadeScene, MakeOutcome, Maker};
use super::{manifest, tell};
use crate::cli::inputs::{Reading, Source};
use crate::cli::output::{self, Folder};
use crate::cli::progress::Progress;
use crate::cli::tally::Tally;
use crate::cli::{Common, Exit, Failure, parallel};
use batch::figures::Figures;
use scene::Scene;
use scene::scenarios::Template;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Least number of parts per worker, so that no worker is left with much work at the end.
const PARTS: usize = 4;

/// A template, if any, and a seed.
type Wish = (Option<Template>, u64);

/// Some of the wishes for one file.
struct WishBatch<'a> {
    source: &'a Source,
    wishes: &'a [Wish],
}

/// Outcome of one wish for one scene.
struct WishEnd {
    scene: String,
    wish: Wish,
    how: WishOutcome,
}

enum WishOutcome {
    /// Written: a line for the terminal, and lines of the table.
    Kept(String, Vec<Vec<String>>),
    /// No sample satisfies the condition.
    LeftOut,
    NobodyFits,
    Failed(Failure),
}

/// Counts of one template.
#[derive(Default)]
struct Sum {
    all: usize,
    kept: usize,
    unfit: usize,
}

/// Generates everything.
///
/// # Errors
/// Exit 4 when some failed, when nothing is kept, or under `--strict` when a template fits no road user; 8
/// when the folder already has results.
pub fn run(args: &GenerateArgs, sources: &[Source], path: &Path, common: &Common) -> Result<(), Failure> {
    let folder = Folder::new(path, args.force)?;
    output::keep(&folder.at(manifest::NAME), args.force)?;
    let wishes = wishes(args);
    let workers = args.inputs.workers();
    // A call with one scene runs its seeds in parallel.
    let parts = (PARTS * workers).div_ceil(sources.len().max(1));
    let size = wishes.len().div_ceil(parts).max(1);
    let parts: Vec<WishBatch<'_>> = sources
        .iter()
        .flat_map(|source| wishes.chunks(size).map(move |wishes| WishBatch { source, wishes }))
        .collect();
    let operations = common.operations_on(1)?;
    let maker = Maker { args, operations: &operations, scored: true };
    let total = (sources.len() * wishes.len()) as u64;
    let progress = Progress::new("generations", total, common.quiet);
    let mut report = BatchReport::new(&progress, total == 1);
    let work = |part: &WishBatch<'_>| part.run(&maker, &folder, &progress);
    parallel::in_order(&parts, workers, work, |part, ends| report.add(part, ends));
    let BatchReport { table, sums, tally, .. } = report;
    drop(progress);
    let table = table.bytes()?;
    let written = folder.write(manifest::NAME, &table)?;
    if !common.quiet {
        sums.iter().for_each(|(template, sum)| output::complain(&sum.words(*template, args)));
        output::complain(&format!("the results are listed in {}", written.display()));
    }
    tally.end("generations")?;
    // As for a single file: a call without any result is a failure.
    if sums.values().all(|sum| sum.kept == 0) {
        return Err(Failure::new(Exit::Partly, "no result was kept"));
    }
    if args.strict && sums.values().any(|sum| sum.unfit > 0 || sum.kept == 0) {
        return Err(Failure::new(
            Exit::Partly,
            "--strict: a template fits no road user of a scene, or none of its samples was kept",
        ));
    }
    Ok(())
}

/// Templates by seeds.
fn wishes(args: &GenerateArgs) -> Vec<Wish> {
    let templates: BTreeSet<Option<Template>> = if args.template.is_empty() {
        BTreeSet::from([None])
    } else {
        args.template.iter().copied().map(Some).collect()
    };
    let seeds = args.seeds.clone().unwrap_or(args.seed..args.seed + 1);
    templates.into_iter().flat_map(|template| seeds.clone().map(move |seed| (template, seed))).collect()
}

impl WishBatch<'_> {
    fn run(&self, maker: &Maker<'_>, folder: &Folder, progress: &Progress) -> Result<Vec<WishEnd>, Failure> {
        let reading = Reading { index: maker.args.index.clone(), ..Reading::default() };
        let mut ends = Vec::new();
        let mut first = true;
        self.source.each(&reading, &mut |item| {
            for wish in self.wishes {
                let how = self.one(maker, folder, &item.scene, &item.name, *wish);
                let how = how.unwrap_or_else(WishOutcome::Failed);
                ends.push(WishEnd { scene: item.name.clone(), wish: *wish, how });
                // The number of scenes in the files is unknown, so only the first scene of each counts.
                if first {
                    progress.step();
                }
            }
            first = false;
            Ok(())
        })?;
        Ok(ends)
    }

    fn one(
        &self,
        maker: &Maker<'_>,
        folder: &Folder,
        scene: &Scene,
        name: &str,
        (template, seed): Wish,
    ) -> Result<WishOutcome, Failure> {
        let made = match maker.make(self.source, scene.clone(), template, seed)? {
            MakeOutcome::NobodyFits(_) => return Ok(WishOutcome::NobodyFits),
            MakeOutcome::Made(made) => made,
        };
        if made.samples.is_empty() {
            return Ok(WishOutcome::LeftOut);
        }
        let file = match template {
            Some(template) => format!("{name}-{}-seed{seed:03}.json", template.name()),
            None => format!("{name}-seed{seed:03}.json"),
        };
        folder.write(&file, &made.bytes())?;
        let rows = manifest::rows(&made, &file, name, template, seed)?;
        Ok(WishOutcome::Kept(format!("{file}: {}", words(&made)), rows))
    }
}

/// One line about a result.
fn words(made: &MadeScene) -> String {
    let mut parts = Vec::new();
    parts.extend(made.casting.as_ref().map(|casting| casting.words.clone()));
    let resolved = made.actor.as_ref().and_then(|id| made.resolved.get(id));
    parts.extend(resolved.and_then(tell::goal));
    let sample = made.scene.generated.as_ref().and_then(|generated| generated.samples.first());
    let reacting = sample.map_or(0, |s| s.agents.values().filter(|f| f.reaction.is_some()).count());
    parts.push(match reacting {
        1 => "1 reacts".into(),
        many => format!("{many} react"),
    });
    if let Some((_, Some(figures))) = made.samples.first() {
        parts.push(figures_words(figures, made.actor.is_some()));
    }
    if made.all_samples > 1 {
        parts.push(format!("{} of {} samples", made.samples.len(), made.all_samples));
    }
    parts.join("; ")
}

fn figures_words(figures: &Figures, actor: bool) -> String {
    let (name, whose) = if actor { ("actor.min_ttc_s", "actor's ") } else { ("min_ttc_s", "") };
    let ttc = figures.get(name).map_or("none".into(), |ttc| format!("{ttc:.2} s"));
    let collisions = figures.get("collisions").unwrap_or(0.0);
    format!("{whose}minimum TTC {ttc}, {collisions} collision{}", if collisions == 1.0 { "" } else { "s" })
}

/// Collects results as they arrive.
struct BatchReport<'a> {
    progress: &'a Progress,
    only: bool,
    table: crate::cli::score::table::Table,
    sums: BTreeMap<Option<Template>, Sum>,
    tally: Tally,
    /// Messages that were printed already: unreadable files, and scenes without a fit for a template.
    told: BTreeSet<(String, Option<Template>)>,
}

impl<'a> BatchReport<'a> {
    fn new(progress: &'a Progress, only: bool) -> Self {
        Self {
            progress,
            only,
            table: manifest::table(),
            sums: BTreeMap::new(),
            tally: Tally::default(),
            told: BTreeSet::new(),
        }
    }

    fn add(&mut self, part: &WishBatch<'_>, ends: Result<Vec<WishEnd>, Failure>) {
        match ends {
            Ok(ends) => ends.into_iter().for_each(|end| self.end(end)),
            // Other parts of the same file fail in the same way, so the failure is printed and counted once.
            Err(failure) if self.told.insert((part.source.shown(), None)) => {
                self.tally.add(Err(failure), self.only, self.progress);
            }
            Err(_) => {}
        }
    }

    fn end(&mut self, end: WishEnd) {
        let (template, seed) = end.wish;
        let sum = self.sums.entry(template).or_default();
        sum.all += 1;
        let result = match end.how {
            WishOutcome::Kept(line, rows) => {
                sum.kept += 1;
                self.progress.line(&line);
                rows.iter().for_each(|row| self.table.add(row));
                Ok(())
            }
            WishOutcome::LeftOut => Ok(()),
            WishOutcome::NobodyFits => {
                sum.unfit += 1;
                if self.told.insert((end.scene.clone(), template)) {
                    let name = template.map_or("", Template::name);
                    self.progress.line(&format!("{}: {name}: no road user fits", end.scene));
                }
                Ok(())
            }
            WishOutcome::Failed(failure) => {
                let place = format!("{}, seed {seed}: {}", end.scene, failure.message);
                Err(Failure::new(failure.exit, place))
            }
        };
        self.tally.add(result, self.only, self.progress);
    }
}

impl Sum {
    fn words(&self, template: Option<Template>, args: &GenerateArgs) -> String {
        let Self { all, kept, unfit } = self;
        let name = template.map_or_else(String::new, |template| format!("{}: ", template.name()));
        let unfit = if *unfit > 0 { format!(", {unfit} without a fitting road user") } else { String::new() };
        match &args.filter {
            Some(filter) => format!("{name}{kept} of {all} hold {}{unfit}", filter.text()),
            None => format!("{name}{kept} of {all} made{unfit}"),
        }
    }
}
