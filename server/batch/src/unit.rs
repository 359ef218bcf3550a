//! The units of a batch: one generation each, in a fixed order, computed from their number without a list of
//! all.

use crate::catalogue::CatalogueScene;
use crate::chunk::{self, BatchChunk};
use crate::draws;
use crate::order::{UnitBlock, UnitPlace};
use crate::plan::BatchPlan;
use crate::sampling::SamplingMethod;
use crate::search::order::SearchOrder;
use crate::search::state::SearchState;
use crate::situation::BatchSituation;
use scene::ContentHash;
use scene::random::Key;
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
    /// The road user that gets the conditions, if the situation names road users and the scene has one; or
    /// the place of a pattern.
    pub actor: Option<String>,
    /// Number of the draw.
    pub draw: u64,
    /// Drawn numbers by path; for a search, [`GroupSearch`](crate::search::GroupSearch) has them.
    pub drawn: BTreeMap<String, f64>,
    /// Seed of the generation.
    pub seed: u64,
}

/// All units of a plan over a catalogue.
pub struct UnitList<'a> {
    plan: &'a BatchPlan,
    scenes: &'a [CatalogueScene],
    seeds: Vec<u64>,
    order: UnitOrder,
    /// Hash of what all units share: version, weights, tuning and options.
    shared: ContentHash,
}

/// The order of the units.
enum UnitOrder {
    /// Independent draws.
    Draws(Vec<UnitBlock>),
    /// Tries that follow from earlier ones.
    Searches(SearchOrder),
}

impl<'a> UnitList<'a> {
    /// The units of a plan. `engine` holds the hashes of weights and tuning.
    pub fn new(plan: &'a BatchPlan, scenes: &'a [CatalogueScene], engine: &BTreeMap<String, String>) -> Self {
        let blocks = UnitBlock::all(plan, scenes);
        let order = if plan.sampling.method == SamplingMethod::Search {
            UnitOrder::Searches(SearchOrder::new(plan, blocks))
        } else {
            UnitOrder::Draws(blocks)
        };
        let shared = ContentHash::of(&(env!("CARGO_PKG_VERSION"), engine, &plan.generate));
        Self { plan, scenes, seeds: plan.seeds.list(), order, shared }
    }

    /// Number of units.
    pub fn len(&self) -> u64 {
        match &self.order {
            UnitOrder::Draws(blocks) => blocks.last().map_or(0, UnitBlock::end),
            UnitOrder::Searches(order) => order.len(),
        }
    }

    /// Whether there are no units.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The chunks of all units, in their order.
    pub fn chunks(&self) -> Box<dyn Iterator<Item = BatchChunk> + '_> {
        match &self.order {
            UnitOrder::Draws(_) => Box::new(chunk::chunks(self.len(), self.plan.chunk_units)),
            UnitOrder::Searches(order) => Box::new(order.chunks()),
        }
    }

    /// The order of the tries, if the plan searches.
    pub(crate) fn searches(&self) -> Option<&SearchOrder> {
        match &self.order {
            UnitOrder::Draws(_) => None,
            UnitOrder::Searches(order) => Some(order),
        }
    }

    /// Whether a chunk follows from the previous chunks of its share.
    pub fn is_searched(&self) -> bool {
        self.searches().is_some()
    }

    /// The unit with a number below [`Self::len`].
    pub fn unit(&self, number: u64) -> Option<BatchUnit> {
        self.at(match &self.order {
            UnitOrder::Draws(blocks) => UnitBlock::place(blocks, number)?,
            UnitOrder::Searches(order) => order.group_of(number)?.find(number)?.1,
        })
    }

    /// The unit at a place.
    pub(crate) fn at(&self, place: UnitPlace) -> Option<BatchUnit> {
        let UnitOf { scene, situation, actor, seed, is_nobody } = self.of(place)?;
        let draw = place.draw;
        let drawn = if is_nobody {
            BTreeMap::new()
        } else {
            let of = actor.unwrap_or_default();
            draws::drawn(situation, &self.plan.sampling, &scene.sha256, of, draw)
        };
        // The numbers of a search follow from its ranges and its condition.
        let searched = self.searches().map(|_| (situation, &self.plan.sampling, &self.plan.filter));
        let (name, template) = (situation.name(), &situation.template);
        let id = ContentHash::of(&(
            &self.shared,
            &scene.sha256,
            &scene.name,
            (name, template, searched),
            actor,
            draw,
            &drawn,
            seed,
        ));
        let id = situation.fixed().map_or(id, |fixed| ContentHash::of(&(id, fixed)));
        let id = situation.pattern().map_or(id, |pattern| ContentHash::of(&(id, pattern)));
        let actor = actor.map(str::to_owned);
        Some(BatchUnit { id, scene: place.scene, situation: place.situation, actor, draw, drawn, seed })
    }

    /// The search of a road user and a seed, at its start; `None` if no road user fits.
    pub(crate) fn search(&self, place: UnitPlace) -> Option<SearchState<'a>> {
        let UnitOf { scene, situation, actor, seed, is_nobody } = self.of(place)?;
        let words = ["batch search", situation.name(), &scene.sha256, actor.unwrap_or_default()];
        let key = Key::default().words(&words).number(self.plan.sampling.seed).number(seed);
        (!is_nobody).then(|| SearchState::new(situation, key))
    }

    /// The parts of a plan at a place.
    fn of(&self, place: UnitPlace) -> Option<UnitOf<'a>> {
        let scene = self.scenes.get(place.scene)?;
        let actors = scene.actors.get(place.situation).and_then(Option::as_ref);
        Some(UnitOf {
            scene,
            situation: self.plan.situations.get(place.situation)?,
            actor: actors.and_then(|actors| actors.get(place.actor)).map(String::as_str),
            seed: self.seeds.get(place.seed).copied()?,
            is_nobody: scene.problem.is_some() || actors.is_some_and(Vec::is_empty),
        })
    }
}

/// The parts of a plan that a unit belongs to.
struct UnitOf<'a> {
    scene: &'a CatalogueScene,
    situation: &'a BatchSituation,
    actor: Option<&'a str>,
    seed: u64,
    /// The input is not a scene, or has no road user for the situation.
    is_nobody: bool,
}

#[cfg(test)]
mod tests {
    use super::{BatchUnit, UnitList};
    use crate::case::facts::CaseFacts;
    use crate::catalogue::{CatalogueScene, UnitProblem};
    use crate::plan::BatchPlan;
    use crate::row::{BatchRow, UnitOutcome};
    use crate::search::GroupSearch;
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
        // Three seeds of the template; two road users by two speeds by three seeds; one; three and one.
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
        // The filter and the size of chunks change no generation.
        other = BatchPlan { filter: Some("collisions == 0".into()), chunk_units: 7, ..plan.clone() };
        assert_eq!(first, id(&other, &scenes, &engine("x")));
    }

    #[test]
    fn tries_of_searches_are_in_chunks_by_population() {
        let text = "scenes = ['a']\nseeds = 2\nwhere = 'collisions == 0'\nchunk_units = 12\n\
                    [sampling]\nmethod = 'search'\ndraws = 10\n\
                    [[situations]]\nname = 'fast'\nagents = ['@all']\n\
                    goal = { speed_mps = { uniform = [5, 9] }, ahead_m = { uniform = [5, 90] } }\n\
                    [[situations]]\nname = 'slow'\nagents = ['@all']\ngoal = { speed_mps = 2 }";
        let plan = BatchPlan::parse(text).unwrap();
        let scene = |name: &str, actors: &[&str]| {
            let actors: Vec<String> = actors.iter().map(|id| (*id).to_owned()).collect();
            let sha256 = format!("hash of {name}");
            let actors = vec![Some(actors.clone()), Some(actors)];
            CatalogueScene { name: name.into(), sha256, problem: None, actors }
        };
        let scenes = [scene("a", &["1", "2"]), scene("empty", &[]), scene("b", &["3"])];
        let list = UnitList::new(&plan, &scenes, &BTreeMap::new());
        // Ten tries for each road user and seed, and one if nothing varies; one if nobody fits.
        assert_eq!(list.len(), (40 + 4) + (1 + 1) + (20 + 2));
        let chunks: Vec<_> = list.chunks().collect();
        // Two searches form a group, with populations of six tries.
        let sizes: Vec<_> = chunks.iter().map(|c| (c.number, c.share, c.units.end - c.units.start)).collect();
        let expected = [
            [(0, 0, 12), (1, 0, 8)].as_slice(),
            &[(3, 1, 12), (4, 1, 8)],
            &[(6, 2, 2), (9, 3, 2), (12, 4, 2)],
            &[(15, 5, 12), (16, 5, 8), (18, 6, 2)],
        ];
        assert_eq!(sizes, expected.concat());
        let units: Vec<_> = chunks.iter().flat_map(|c| c.units.clone()).collect();
        assert_eq!(units, (0..list.len()).collect::<Vec<_>>());
        let all: Vec<_> = units.iter().map(|number| list.unit(*number).unwrap()).collect();
        assert_eq!(all.iter().map(|unit| unit.id).collect::<BTreeSet<_>>().len(), all.len());
        let told = |i: usize| (all[i].actor.as_deref(), all[i].seed, all[i].draw);
        assert_eq!(
            [told(0), told(6), told(12), told(16)],
            [(Some("1"), 0, 0), (Some("1"), 1, 0), (Some("1"), 0, 6), (Some("1"), 1, 6)]
        );
        assert!(list.unit(list.len()).is_none());

        let mut searches = GroupSearch::new(&list, 0).unwrap();
        let first: Vec<_> = (0..12).map(|number| searches.unit(number).unwrap()).collect();
        assert!(first.iter().all(|unit| unit.drawn.len() == 2), "{first:?}");
        assert_ne!(first[0].drawn, first[6].drawn, "each seed has a search of its own");
        assert_eq!(first[3].id, all[3].id);
        let before = searches.unit(12).unwrap();
        let rows: Vec<_> =
            first.iter().map(|unit| row(unit, (unit.drawn["goal.ahead_m"] - 60.0).abs())).collect();
        searches.learn(&rows);
        assert_ne!(searches.unit(12).unwrap().drawn, before.drawn);
        assert_eq!(GroupSearch::new(&list, 1).unwrap().unit(0), None, "a unit of another group");
        assert!(GroupSearch::new(&list, 7).is_none());
    }

    fn row(unit: &BatchUnit, miss: f64) -> BatchRow {
        BatchRow {
            unit: unit.id.hex(),
            scene: String::new(),
            name: String::new(),
            situation: String::new(),
            actor: None,
            other: None,
            draw: unit.draw,
            drawn: unit.drawn.clone(),
            seed: unit.seed,
            outcome: UnitOutcome::LeftOut,
            problem: None,
            code: None,
            goal: None,
            reacting: None,
            what: None,
            miss: Some(miss),
            figures: BTreeMap::new(),
            facts: CaseFacts::default(),
        }
    }
}
