//! The order of the units of a plan: blocks of scene and situation, each with road users, draws and seeds.

use crate::catalogue::CatalogueScene;
use crate::draws;
use crate::plan::BatchPlan;

/// The place of a unit in its plan, by indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnitPlace {
    /// Scene of the catalogue.
    pub scene: usize,
    /// Situation of the plan.
    pub situation: usize,
    /// Road user among those of the situation in the scene.
    pub actor: usize,
    /// Number of the draw.
    pub draw: u64,
    /// Seed among those of the plan.
    pub seed: usize,
}

/// The units of a situation in a scene.
pub struct UnitBlock {
    scene: usize,
    /// Situation of the plan.
    pub situation: usize,
    /// Draws per road user and seed.
    pub draws: u64,
    actors: u64,
    seeds: u64,
    /// Number of units before it.
    first: u64,
    /// Number of searches before it; each road user and seed is a search.
    first_search: u64,
}

impl UnitBlock {
    /// The blocks of a plan over a catalogue. A single unit reports an input that is not a scene, or a
    /// situation without road users.
    pub fn all(plan: &BatchPlan, scenes: &[CatalogueScene]) -> Vec<Self> {
        let seeds = plan.seeds.list().len() as u64;
        let (mut blocks, mut first, mut first_search) = (Vec::new(), 0, 0);
        for (i, scene) in scenes.iter().enumerate() {
            // An input that is not a scene is one unit, whose row gives the reason.
            let most = if scene.problem.is_some() { 1 } else { plan.situations.len() };
            for (situation, of) in plan.situations.iter().enumerate().take(most) {
                let actors = scene.actors.get(situation).and_then(Option::as_ref);
                let single = Self { scene: i, situation, draws: 1, actors: 1, seeds: 1, first, first_search };
                let block = if scene.problem.is_some() || actors.is_some_and(Vec::is_empty) {
                    single
                } else {
                    let actors = actors.map_or(1, |actors| actors.len() as u64);
                    Self { draws: draws::count(of, &plan.sampling), actors, seeds, ..single }
                };
                first = block.end();
                first_search += block.searches();
                blocks.push(block);
            }
        }
        blocks
    }

    fn searches(&self) -> u64 {
        self.actors * self.seeds
    }

    /// Number of the unit after its last one.
    pub fn end(&self) -> u64 {
        self.first + self.searches() * self.draws
    }

    /// The block of a unit.
    fn of_unit(blocks: &[Self], number: u64) -> Option<&Self> {
        let at = blocks.partition_point(|block| block.first <= number).checked_sub(1)?;
        blocks.get(at).filter(|block| number < block.end())
    }

    /// The place of a unit: seeds vary fastest, then draws, then road users.
    pub fn place(blocks: &[Self], number: u64) -> Option<UnitPlace> {
        let block = Self::of_unit(blocks, number)?;
        let Self { scene, situation, draws, seeds, first, .. } = *block;
        let (seed, rest) = ((number - first) % seeds, (number - first) / seeds);
        let (draw, actor) = (rest % draws, (rest / draws) as usize);
        Some(UnitPlace { scene, situation, actor, draw, seed: seed as usize })
    }

    /// The number of the search of a unit, if the draws of a search are consecutive.
    pub fn search_of(blocks: &[Self], number: u64) -> Option<u64> {
        let block = Self::of_unit(blocks, number)?;
        Some(block.first_search + (number - block.first) / block.draws)
    }

    /// The block of a search, and the place of its first draw.
    pub fn of_search(blocks: &[Self], search: u64) -> Option<(&Self, UnitPlace)> {
        let at = blocks.partition_point(|block| block.first_search <= search).checked_sub(1)?;
        let block = blocks.get(at)?;
        let Self { scene, situation, seeds, first_search, .. } = *block;
        let within = search - first_search;
        let (actor, seed) = ((within / seeds) as usize, (within % seeds) as usize);
        let place = UnitPlace { scene, situation, actor, draw: 0, seed };
        (within < block.searches()).then_some((block, place))
    }

    /// Number of the first unit of a search of the block, if the draws of a search are consecutive.
    pub fn first_of(&self, search: u64) -> u64 {
        self.first + (search - self.first_search) * self.draws
    }
}
