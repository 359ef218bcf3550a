//! The inputs of a batch: read once, stored by content hash, and listed with the road users of each
//! situation.

use super::folder::BatchFolder;
use crate::cli::inputs::{Inputs, Source};
use crate::cli::progress::Progress;
use crate::cli::{Common, Failure, parallel};
use api::{Operations, Problem};
use batch::catalogue::{CatalogueScene, UnitProblem};
use batch::plan::BatchPlan;
use experts::Cancel;
use scene::{ContentHash, Scene};
use std::path::Path;
use std::sync::Arc;

/// The inputs of a plan, and how they are read.
pub struct PlanInputs<'a> {
    /// The plan.
    pub plan: &'a BatchPlan,
    /// Folder to which its paths are relative.
    pub base: &'a Path,
    /// Folder in which the scenes are stored.
    pub folder: &'a BatchFolder,
    /// Operations that place road users on maps.
    pub operations: &'a Operations,
}

/// A map with the number of one of its scenes.
type Filling = (usize, String, Arc<Scene>, u64);

impl PlanInputs<'_> {
    /// Reads all inputs, and stores each scene in the folder.
    ///
    /// # Errors
    /// Exit 3 for an input that does not exist, 1 when a scene cannot be written.
    pub fn read(&self, workers: usize, common: &Common) -> Result<Vec<CatalogueScene>, Failure> {
        let mut scenes = Vec::new();
        let files = if self.plan.scenes.is_empty() { Vec::new() } else { self.sources(&self.plan.scenes)? };
        self.all(&files, workers, common, &mut scenes, |source| self.of_source(source))?;
        let fillings = self.fillings(&mut scenes)?;
        self.all(&fillings, workers, common, &mut scenes, |filling| Ok(vec![self.filled(filling)?]))?;
        Ok(scenes)
    }

    /// Processes inputs in parallel; their scenes stay in the order of the inputs.
    fn all<T: Sync>(
        &self,
        inputs: &[T],
        workers: usize,
        common: &Common,
        scenes: &mut Vec<CatalogueScene>,
        work: impl Fn(&T) -> Result<Vec<CatalogueScene>, Failure> + Sync,
    ) -> Result<(), Failure> {
        let progress = Progress::new("inputs", inputs.len() as u64, common.quiet);
        let mut failure = None;
        parallel::in_order(inputs, workers, work, |_, found| {
            match found {
                Ok(found) => scenes.extend(found),
                Err(error) => drop(failure.get_or_insert(error)),
            }
            progress.step();
        });
        failure.map_or(Ok(()), Err)
    }

    fn sources(&self, paths: &[String]) -> Result<Vec<Source>, Failure> {
        let paths = paths.iter().map(|path| self.base.join(path)).collect();
        let sources = Inputs { scenes: paths, jobs: None }.sources()?;
        match sources.iter().find(|source| !source.path.exists()) {
            Some(missing) => Err(Failure::input(format!("{}: no such file", missing.shown()))),
            None => Ok(sources),
        }
    }

    fn of_source(&self, source: &Source) -> Result<Vec<CatalogueScene>, Failure> {
        let mut found = Vec::new();
        source.each_or_problem(&mut |name, read| {
            found.push(self.entry(name, read.map(|item| item.scene))?);
            Ok(())
        })?;
        Ok(found)
    }

    /// The fillings of all maps, each map read once. A file without a map is a separate entry.
    fn fillings(&self, scenes: &mut Vec<CatalogueScene>) -> Result<Vec<Filling>, Failure> {
        let mut fillings = Vec::new();
        for (i, map) in self.plan.maps.iter().enumerate() {
            let mut add = |name: &str, mut scene: Scene| {
                scene.agents.clear();
                scene.generated = None;
                let scene = Arc::new(scene);
                let label = map.label(name).to_owned();
                fillings.extend((0..map.scenes).map(|n| (i, label.clone(), Arc::clone(&scene), n)));
            };
            if let Some(drawn) = map.drawn() {
                let refused = |problem: Problem| Failure::input(format!("maps[{i}]: {}", problem.detail));
                add("", drawn.draw().map_err(refused)?.1);
                continue;
            }
            for source in self.sources(&map.files)? {
                source.each_or_problem(&mut |name, read| {
                    match read {
                        Ok(item) => add(&name, item.scene),
                        Err(problem) => scenes.push(self.entry(name, Err(problem))?),
                    }
                    Ok(())
                })?;
            }
        }
        Ok(fillings)
    }

    fn filled(&self, (map, label, scene, number): &Filling) -> Result<CatalogueScene, Failure> {
        let name = format!("{label}-{number}");
        let Some(map) = self.plan.maps.get(*map) else {
            return Err(Failure::input(format!("{name}: no map")));
        };
        let body = map.filling(*number, self.plan.generate.start_s);
        let placement = self.operations.place(&body, scene, &Cancel::default());
        let read = placement.map(|placement| {
            let mut scene = Scene::clone(scene);
            scene.agents = placement.agents;
            scene
        });
        self.entry(name, read)
    }

    /// A scene, or an input that could not be read.
    fn entry(&self, name: String, read: Result<Scene, Problem>) -> Result<CatalogueScene, Failure> {
        Ok(match read {
            Ok(scene) => CatalogueScene {
                name,
                sha256: self.folder.put_scene(&scene)?,
                problem: None,
                actors: self.plan.actors(&scene),
            },
            Err(Problem { code, detail, .. }) => {
                let sha256 = ContentHash::of(&(&name, code.name(), &detail)).hex();
                let problem = Some(UnitProblem { code: code.name().to_owned(), detail });
                CatalogueScene { name, sha256, problem, actors: Vec::new() }
            }
        })
    }
}
