//! The inputs of a batch: read once, stored by content, listed with the road users that each situation concerns.

use super::folder::BatchFolder;
use crate::cli::generate::who::{self, AgentSelector};
use crate::cli::inputs::{Inputs, Item, Source};
use crate::cli::progress::Progress;
use crate::cli::{Common, Failure, parallel};
use api::Problem;
use batch::catalogue::{CatalogueScene, UnitProblem};
use batch::fault::PlanFault;
use batch::plan::BatchPlan;
use scene::{AgentType, ContentHash, Scene};
use std::path::Path;

/// Whom each situation of a plan concerns; `None` for one that names nobody.
pub type Selectors = Vec<Option<Vec<AgentSelector>>>;

/// The selectors of a plan.
///
/// # Errors
/// Those that are none, each with its path.
pub fn selectors(plan: &BatchPlan) -> Result<Selectors, Vec<PlanFault>> {
    let (mut all, mut faults) = (Vec::new(), Vec::new());
    for (i, situation) in plan.situations.iter().enumerate() {
        let mut of = Vec::new();
        for (j, text) in situation.agents.iter().enumerate() {
            match text.parse() {
                Ok(selector) => of.push(selector),
                Err(reason) => faults.push(PlanFault::new(format!("situations[{i}].agents[{j}]"), reason)),
            }
        }
        all.push((!of.is_empty()).then_some(of));
    }
    if faults.is_empty() { Ok(all) } else { Err(faults) }
}

/// Reads all inputs of a plan; each scene goes into the folder. `selectors` are those of the plan.
///
/// # Errors
/// Exit 3 for an input that does not exist, 1 when a scene cannot be written.
pub fn read(
    plan: &BatchPlan,
    selectors: &Selectors,
    base: &Path,
    folder: &BatchFolder,
    workers: usize,
    common: &Common,
) -> Result<Vec<CatalogueScene>, Failure> {
    let paths = plan.scenes.iter().map(|path| base.join(path)).collect();
    let sources = Inputs { scenes: paths, jobs: None }.sources()?;
    if let Some(missing) = sources.iter().find(|source| !source.path.exists()) {
        return Err(Failure::input(format!("{}: no such file", missing.shown())));
    }
    let start_step = plan.generate.start_step();
    let progress = Progress::new("inputs", sources.len() as u64, common.quiet);
    let mut scenes = Vec::new();
    let mut failure = None;
    let work = |source: &Source| of_source(source, folder, selectors, start_step);
    parallel::in_order(&sources, workers, work, |_, found| {
        match found {
            Ok(found) => scenes.extend(found),
            Err(error) => drop(failure.get_or_insert(error)),
        }
        progress.step();
    });
    match failure {
        Some(failure) => Err(failure),
        None => Ok(scenes),
    }
}

fn of_source(
    source: &Source,
    folder: &BatchFolder,
    selectors: &Selectors,
    start_step: usize,
) -> Result<Vec<CatalogueScene>, Failure> {
    let mut found = Vec::new();
    source.each_or_problem(&mut |name, read| {
        found.push(match read {
            Ok(Item { scene, .. }) => CatalogueScene {
                name,
                sha256: folder.put_scene(&scene)?,
                problem: None,
                actors: selectors.iter().map(|of| actors(of.as_deref(), &scene, start_step)).collect(),
            },
            Err(Problem { code, detail, .. }) => {
                let sha256 = ContentHash::of(&(&name, code.name(), &detail)).hex();
                let problem = Some(UnitProblem { code: code.name().to_owned(), detail });
                CatalogueScene { name, sha256, problem, actors: Vec::new() }
            }
        });
        Ok(())
    })?;
    Ok(found)
}

/// The road users of a scene that are there at the start and meant; an id of another scene means nobody here.
fn actors(of: Option<&[AgentSelector]>, scene: &Scene, start_step: usize) -> Option<Vec<String>> {
    let of = of?;
    let mut all: Vec<String> = Vec::new();
    for selector in of {
        let everybody = || scene.agents.iter().map(|agent| agent.id.clone()).collect();
        let meant =
            who::ids(std::slice::from_ref(selector), scene, start_step, "agents").unwrap_or(Some(Vec::new()));
        for id in meant.unwrap_or_else(everybody) {
            let there = scene.agent(&id).is_some_and(|agent| {
                agent.kind() != AgentType::Other && scene.shown(agent).track.at(start_step).is_some()
            });
            if there && !all.contains(&id) {
                all.push(id);
            }
        }
    }
    Some(all)
}
