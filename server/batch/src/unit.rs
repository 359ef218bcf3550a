//! The units of a batch: one generation each, in a fixed order, found by number without a list of all.

use crate::catalogue::CatalogueScene;
use crate::draws;
use crate::plan::BatchPlan;
use scene::ContentHash;
use std::collections::BTreeMap;

/// One generation.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchUnit {
    /// Hash of the scene's content, the conditions, the seed, the options and the engine.
    pub id: ContentHash,
    /// Index of the scene in the catalogue.
    pub scene: usize,
    /// Index of the situation in the plan.
    pub situation: usize,
    /// The road user that gets the conditions, where the situation names road users and the scene has one.
    pub actor: Option<String>,
    /// Number of the draw.
    pub draw: u64,
    /// Drawn numbers by path.
    pub drawn: BTreeMap<String, f64>,
    /// Seed of the generation.
    pub seed: u64,
}

/// Scene, situation and number of the first unit of the two.
struct UnitBlock {
    scene: usize,
    situation: usize,
    first: u64,
}

/// All units of a plan over a catalogue.
pub struct UnitList<'a> {
    plan: &'a BatchPlan,
    scenes: &'a [CatalogueScene],
    seeds: Vec<u64>,
    blocks: Vec<UnitBlock>,
    count: u64,
    /// Of all that the units share: version, weights, tuning and options.
    shared: ContentHash,
}

impl<'a> UnitList<'a> {
    /// Of a plan. `engine` names the hashes of weights and tuning.
    pub fn new(plan: &'a BatchPlan, scenes: &'a [CatalogueScene], engine: &BTreeMap<String, String>) -> Self {
        let seeds = plan.seeds.list();
        let (mut blocks, mut count) = (Vec::new(), 0_u64);
        for (i, scene) in scenes.iter().enumerate() {
            // An input that is no scene is one unit: its row says why.
            let situations = if scene.problem.is_some() { 1 } else { plan.situations.len() };
            for situation in 0..situations {
                blocks.push(UnitBlock { scene: i, situation, first: count });
                count += Self::size(plan, scene, situation, seeds.len() as u64);
            }
        }
        let shared = ContentHash::of(&(env!("CARGO_PKG_VERSION"), engine, &plan.generate));
        Self { plan, scenes, seeds, blocks, count, shared }
    }

    /// Units of one situation in one scene.
    fn size(plan: &BatchPlan, scene: &CatalogueScene, situation: usize, seeds: u64) -> u64 {
        let of = scene.actors.get(situation).and_then(Option::as_ref);
        match (&scene.problem, of, plan.situations.get(situation)) {
            (None, Some(actors), Some(_)) if actors.is_empty() => 1,
            (None, actors, Some(of)) => {
                actors.map_or(1, |actors| actors.len() as u64) * draws::count(of, &plan.sampling) * seeds
            }
            _ => 1,
        }
    }

    /// Number of units.
    pub fn len(&self) -> u64 {
        self.count
    }

    /// Is there none?
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The unit of a number below [`Self::len`].
    pub fn unit(&self, number: u64) -> Option<BatchUnit> {
        let at = self.blocks.partition_point(|block| block.first <= number).checked_sub(1)?;
        let block = self.blocks.get(at)?;
        let scene = self.scenes.get(block.scene)?;
        let situation = self.plan.situations.get(block.situation)?;
        let seeds = self.seeds.len() as u64;
        let within = number - block.first;
        let (seed, rest) = (self.seeds.get((within % seeds) as usize).copied()?, within / seeds);
        let draws = draws::count(situation, &self.plan.sampling).max(1);
        let (draw, rest) = (rest % draws, rest / draws);
        let actors = scene.actors.get(block.situation).and_then(Option::as_ref);
        let actor = actors.and_then(|actors| actors.get(rest as usize)).cloned();
        let nobody = scene.problem.is_some() || actors.is_some_and(Vec::is_empty);
        let drawn = if nobody {
            BTreeMap::new()
        } else {
            let of = actor.as_deref().unwrap_or_default();
            draws::drawn(situation, &self.plan.sampling, &scene.sha256, of, draw)
        };
        let (name, template) = (situation.name(), &situation.template);
        let id = ContentHash::of(&(
            &self.shared,
            &scene.sha256,
            &scene.name,
            name,
            template,
            &actor,
            draw,
            &drawn,
            seed,
        ));
        Some(BatchUnit { id, scene: block.scene, situation: block.situation, actor, draw, drawn, seed })
    }
}

#[cfg(test)]
mod tests {
    use super::UnitList;
    use crate::catalogue::{CatalogueScene, UnitProblem};
    use crate::plan::BatchPlan;
    use std::collections::{BTreeMap, BTreeSet};

    fn plan() -> BatchPlan {
        let text = "scenes = ['a']\nseeds = 3\n[[situations]]\ntemplate = 'brake'\n[[situations]]\nname = 'fast'\n\
                    agents = ['@vehicles']\ngoal = { speed_mps = { choice = [5, 9] } }";
        BatchPlan::parse(text).unwrap()
    }

    fn scene(name: &str, actors: &[&str]) -> CatalogueScene {
        let actors = actors.iter().map(|id| (*id).to_owned()).collect();
        let sha256 = format!("hash of {name}");
        CatalogueScene { name: name.into(), sha256, problem: None, actors: vec![None, Some(actors)] }
    }

    #[test]
    fn units_are_scenes_by_situations_by_road_users_by_draws_by_seeds() {
        let problem = UnitProblem { code: "malformed-json".into(), detail: "line 1".into() };
        let broken = CatalogueScene { problem: Some(problem), actors: Vec::new(), ..scene("broken", &[]) };
        let scenes = [scene("a", &["1", "2"]), broken, scene("empty", &[])];
        let plan = plan();
        let list = UnitList::new(&plan, &scenes, &BTreeMap::new());
        // Three seeds of the template, two road users by two speeds by three seeds; one; three and one.
        assert_eq!(list.len(), (3 + 12) + 1 + (3 + 1));
        let units: Vec<_> = (0..list.len()).map(|number| list.unit(number).unwrap()).collect();
        let ids: BTreeSet<_> = units.iter().map(|unit| unit.id).collect();
        assert_eq!(ids.len(), units.len(), "each has an id of its own");
        let last = &units[14];
        assert_eq!((last.scene, last.situation, last.actor.as_deref(), last.seed), (0, 1, Some("2"), 2));
        assert_eq!(last.drawn["goal.speed_mps"], 9.0);
        assert_eq!((units[15].scene, units[15].drawn.len()), (1, 0));
        assert_eq!((units[19].actor.as_deref(), units[19].drawn.len()), (None, 0));
        assert!(list.unit(list.len()).is_none_or(|unit| unit.scene == 2));
    }

    #[test]
    fn an_id_follows_from_content_options_and_engine() {
        let (plan, scenes) = (plan(), [scene("a", &["1"])]);
        let engine = |hash: &str| BTreeMap::from([("vehicle".to_owned(), hash.to_owned())]);
        let id = |plan: &BatchPlan, scenes: &[CatalogueScene], engine: &BTreeMap<String, String>| {
            UnitList::new(plan, scenes, engine).unit(4).unwrap().id
        };
        let first = id(&plan, &scenes, &engine("x"));
        assert_eq!(first, id(&plan, &scenes, &engine("x")));
        assert_ne!(first, id(&plan, &scenes, &engine("y")));
        let mut other = plan.clone();
        other.generate.horizon_s = 6.0;
        assert_ne!(first, id(&other, &scenes, &engine("x")));
        // What is kept, and the size of chunks, change no generation.
        other = BatchPlan { filter: Some("collisions == 0".into()), chunk_units: 7, ..plan.clone() };
        assert_eq!(first, id(&other, &scenes, &engine("x")));
    }
}
