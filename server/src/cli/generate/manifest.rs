//! The manifest of a folder of results: one line per kept sample.

use super::made::MadeScene;
use crate::cli::Failure;
use crate::cli::score::table::{Table, figure};
use batch::engine::goal_word;
use batch::figures::Figures;
use scene::scenarios::Template;

/// Name of its file.
pub const NAME: &str = "manifest.csv";
/// Its figures of the score; `score --csv` prints all.
const FIGURES: [&str; 8] = [
    "actor.min_ttc_s",
    "min_ttc_s",
    "min_distance_m",
    "collisions",
    "near_misses",
    "off_road",
    "red_lights",
    "goals_reached",
];

/// The table with its heading.
pub fn table() -> Table {
    let mut table = Table::bare();
    let about = ["file", "scene", "template", "seed", "sample", "actor", "other", "goal", "reacting"];
    let heading = about.into_iter().chain(FIGURES).chain(["what"]);
    table.add(&heading.map(str::to_owned).collect::<Vec<_>>());
    table
}

/// The lines of one result. The index is that of the sample in the file, which may differ from its index
/// among all samples.
pub fn rows(
    made: &MadeScene,
    file: &str,
    scene: &str,
    template: Option<Template>,
    seed: u64,
) -> Result<Vec<Vec<String>>, Failure> {
    let generated = made.scene.generated.as_ref();
    let other = made.casting.as_ref().and_then(|casting| casting.other.clone()).unwrap_or_default();
    let actor = made.actor.clone().unwrap_or_default();
    let goal = goal_word(made.actor.as_ref().and_then(|id| made.resolved.get(id)));
    let what = made.casting.as_ref().map_or_else(String::new, |casting| casting.words.clone());
    let row = |(place, (_, figures)): (usize, &(usize, Option<Figures>))| {
        let sample = generated.and_then(|generated| generated.samples.get(place));
        let reacting = sample.map_or(0, |s| s.agents.values().filter(|f| f.reaction.is_some()).count());
        let values = FIGURES.iter().map(|name| {
            figures.as_ref().and_then(|figures| figures.get(name)).map_or_else(String::new, figure)
        });
        let about = [
            file.to_owned(),
            scene.to_owned(),
            template.map_or_else(String::new, |template| template.name().to_owned()),
            seed.to_string(),
            place.to_string(),
            actor.clone(),
            other.clone(),
            goal.to_owned(),
            reacting.to_string(),
        ];
        about.into_iter().chain(values).chain([what.clone()]).collect()
    };
    Ok(made.samples.iter().enumerate().map(row).collect())
}
