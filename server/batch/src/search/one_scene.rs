//! A search in one scene: its tries one after the other, each chosen from the previous ones.

use super::GroupSearch;
use super::call::{MOST_TRIES, SearchBody, SearchEnd, SearchTry};
use crate::catalogue::CatalogueScene;
use crate::engine::UnitEngine;
use crate::fault::PlanFault;
use crate::plan::BatchPlan;
use crate::row::UnitOutcome;
use crate::sampling::BatchSampling;
use crate::unit::UnitList;
use api::problem::{refuse, unknown_agent};
use api::{Code, Operations, Problem};
use experts::Cancel;
use scene::{ContentHash, Scene};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Tries between two checks of the results, for methods that do not adapt.
const CHUNK: u64 = 20;

/// A checked search.
pub struct SceneSearch {
    plan: BatchPlan,
    entries: Vec<CatalogueScene>,
    scene: Arc<Scene>,
    engine: BTreeMap<String, String>,
    found: u64,
    tries: u64,
}

impl SceneSearch {
    /// Checks a request about a scene. `engine` holds the hashes of weights and tuning.
    ///
    /// # Errors
    /// Each fault of the request with its pointer, and `out-of-range` for more than [`MOST_TRIES`] tries.
    pub fn new(
        body: &SearchBody,
        scene: Arc<Scene>,
        engine: BTreeMap<String, String>,
    ) -> Result<Self, Problem> {
        let name = scene.id.clone().unwrap_or_default();
        let sampling = BatchSampling { method: body.method, draws: body.tries, seed: body.seed };
        let plan = BatchPlan {
            scenes: vec![name.clone()],
            maps: Vec::new(),
            situations: vec![body.situation.clone()],
            seeds: body.seeds.clone(),
            filter: Some(body.condition.clone()),
            sampling,
            generate: body.generate.clone(),
            chunk_units: CHUNK,
        };
        let faults = plan.faults().into_iter().map(|PlanFault { path, detail }| {
            Problem::new(Code::InvalidField, detail).as_fault(pointer(&path))
        });
        refuse(faults.collect())?;
        let stranger = body.situation.with.as_ref().filter(|with| scene.agent(with).is_none());
        refuse(stranger.map(|id| unknown_agent("/situation/with".into(), id)).into_iter().collect())?;
        let entry = CatalogueScene {
            sha256: ContentHash::of(&name).hex(),
            name,
            problem: None,
            actors: plan.actors(&scene),
        };
        let mut search = Self {
            plan,
            entries: vec![entry],
            scene,
            engine,
            found: body.found.unwrap_or(u64::MAX),
            tries: 0,
        };
        search.tries = search.list().len();
        for (at, number) in [("/tries", search.tries), ("/found", body.found.unwrap_or(1))] {
            if !(1..=MOST_TRIES).contains(&number) {
                return Err(Problem::range(at, 1.0, MOST_TRIES as f64, number as f64));
            }
        }
        Ok(search)
    }

    /// Limit of its tries.
    pub fn tries(&self) -> u64 {
        self.tries
    }

    /// Paths of the varied numbers.
    pub fn varied(&self) -> Vec<String> {
        let situations = self.plan.situations.iter();
        situations.flat_map(|situation| situation.dimensions()).map(|dimension| dimension.path).collect()
    }

    fn list(&self) -> UnitList<'_> {
        UnitList::new(&self.plan, &self.entries, &self.engine)
    }

    /// Makes the tries. `each` receives them and may end the search.
    ///
    /// # Errors
    /// The problem of a cancelled generation. Other problems belong to their try.
    pub fn run(
        &self,
        operations: &Operations,
        cancel: &Cancel,
        each: &mut dyn FnMut(SearchTry) -> ControlFlow<SearchEnd>,
    ) -> Result<SearchEnd, Problem> {
        let list = self.list();
        let engine = UnitEngine::new(&self.plan, &self.entries, operations);
        let (mut group, mut number, mut found) = (None::<(u64, GroupSearch<'_>)>, 0, 0);
        for chunk in list.chunks() {
            if list.is_searched() && group.as_ref().is_none_or(|(share, _)| *share != chunk.share) {
                group = GroupSearch::new(&list, chunk.share).map(|searches| (chunk.share, searches));
            }
            let mut rows = Vec::new();
            for place in chunk.units.clone() {
                let unit = match &group {
                    Some((_, searches)) => searches.unit(place),
                    None => list.unit(place),
                };
                let Some((unit, row)) = unit.and_then(|unit| engine.row(&unit).map(|row| (unit, row))) else {
                    continue;
                };
                let answered = match engine.has_work(&unit) {
                    true => engine.answer(&unit, &self.scene, cancel),
                    false => Ok(None),
                };
                if let Err(problem) = &answered
                    && matches!(problem.code, Code::Cancelled | Code::GenerateTimeout)
                {
                    return Err(problem.clone());
                }
                let end = engine.end(row, answered);
                rows.push(end.row.clone());
                found += u64::from(end.row.outcome == UnitOutcome::Kept);
                if let ControlFlow::Break(end) = each(SearchTry::new(number, end, &self.plan.generate)) {
                    return Ok(end);
                }
                if found >= self.found {
                    return Ok(SearchEnd::Found);
                }
                number += 1;
            }
            if let Some((_, searches)) = &mut group {
                searches.learn(&rows);
            }
        }
        Ok(SearchEnd::Tries)
    }
}

/// The pointer in the request for a path in the plan.
fn pointer(path: &str) -> String {
    let named = match path {
        "sampling.draws" => "tries".to_owned(),
        "sampling.method" => "method".to_owned(),
        "sampling.seed" => "seed".to_owned(),
        path => path.replacen("situations[0]", "situation", 1),
    };
    format!("/{}", named.replace(['.', '['], "/").replace(']', ""))
}

#[cfg(test)]
mod tests {
    use super::{SceneSearch, pointer};
    use crate::search::call::SearchBody;
    use scene::{LaneMap, Scene};
    use std::collections::BTreeMap;
    use std::sync::Arc;

    fn faults(text: &str) -> Vec<(String, String)> {
        let body: SearchBody = serde_json::from_str(text).unwrap();
        let scene = Arc::new(Scene::bare("a", LaneMap::default(), Vec::new()));
        let problem = SceneSearch::new(&body, scene, BTreeMap::new()).err().unwrap();
        let errors = problem.members.errors.unwrap_or_default();
        errors.into_iter().map(|error| (error.pointer, error.detail)).collect()
    }

    #[test]
    fn faults_are_about_members_of_the_request() {
        assert_eq!(pointer("situations[0].agents[2]"), "/situation/agents/2");
        assert_eq!(pointer("where"), "/where");
        let all = faults(
            r#"{"situation": {"agents": ["@any"], "goal": {"speed_mps": {"uniform": [5, 200]}}},
                "where": "min_tcc_s < 1", "generate": {"horizon_s": 90}}"#,
        );
        let at: Vec<&str> = all.iter().map(|(pointer, _)| pointer.as_str()).collect();
        let expected = ["/where", "/generate/horizon_s", "/situation/agents/0", "/situation/goal/speed_mps"];
        assert_eq!(at, expected, "{all:?}");
        assert!(all[0].1.contains("did you mean min_ttc_s?"), "{all:?}");
    }

    #[test]
    fn the_other_road_user_is_one_of_the_scene() {
        let with = r#"{"situation": {"agents": ["@all"], "with": "7"}, "where": "pair.gap_m < 1"}"#;
        let found = faults(with);
        assert_eq!(found[0].0, "/situation/with", "{found:?}");
    }

    #[test]
    fn tries_are_bounded_together() {
        let many = r#"{"situation": {"template": "brake"}, "where": "collisions == 0", "seeds": 1001}"#;
        assert_eq!(faults(many)[0].0, "/tries");
        let none = r#"{"situation": {"template": "brake"}, "where": "collisions == 0", "found": 0}"#;
        assert_eq!(faults(none)[0].0, "/found");
    }
}
