//! `dragtraffic match`: finds the places of maps where a pattern fits, and writes a scene for each.

use super::inputs::{Inputs, Item};
use super::output::{self, Folder};
use super::tally::survey;
use super::{Common, Failure};
use batch::pattern::document::RoadPattern;
use batch::pattern::place::PatternPlace;
use batch::pattern::search::PatternSearch;
use batch::pattern::shipped;
use clap::Args;
use formats::native;
use scene::Scene;
use scene::routes::LaneGraph;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The argument for all built-in patterns.
const ALL: &str = "all";

/// Flags of `match`.
#[derive(Args, Clone, Debug)]
pub struct MatchArgs {
    /// Name of a pattern, a file of one (PATTERN.toml), or all.
    #[arg(value_name = "PATTERN", required_unless_present = "list")]
    pattern: Option<String>,
    #[command(flatten)]
    maps: MatchInputs,
    /// Print the patterns that come with the program.
    #[arg(long, exclusive = true)]
    list: bool,
    /// Print the places as JSON.
    #[arg(long)]
    json: bool,
    /// Folder for a scene of each place, with the road users of the pattern and their goals.
    #[arg(short, long, value_name = "DIR/")]
    output: Option<PathBuf>,
    /// Overwrite scenes that exist.
    #[arg(long)]
    force: bool,
}

/// Files with maps.
#[derive(Args, Clone, Debug)]
struct MatchInputs {
    /// Files, folders or patterns such as 'maps/**/*.json', in any format.
    #[arg(value_name = "MAP", required_unless_present = "list")]
    maps: Vec<PathBuf>,
    /// Files processed in parallel. Default: one per core.
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=512))]
    jobs: Option<u16>,
}

/// A place as JSON.
#[derive(Serialize)]
struct PlaceLine<'a> {
    pattern: &'a str,
    map: &'a str,
    id: &'a str,
    lane: &'a str,
    s_m: f64,
    x_m: f64,
    y_m: f64,
}

/// The result of one map.
struct MatchedMap {
    name: String,
    lanes: usize,
    /// Places by pattern.
    places: Vec<Vec<PatternPlace>>,
}

/// Counts of a pattern over all maps.
#[derive(Clone, Copy, Default)]
struct MatchCount {
    lanes: usize,
    places: usize,
}

/// Finds the places of a pattern.
///
/// # Errors
/// Exit 2 without a pattern of that name, 3 when a pattern or no map can be read, 4 when some maps cannot, 8.
pub fn run(args: &MatchArgs, common: &Common) -> Result<(), Failure> {
    if args.list {
        let line = |of: &RoadPattern| format!("{:<22}{}\n", of.name, of.title);
        return output::print(shipped::all().iter().map(line).collect::<String>().as_bytes());
    }
    let patterns = patterns(args.pattern.as_deref().unwrap_or_default())?;
    let inputs = Inputs { scenes: args.maps.maps.clone(), jobs: args.maps.jobs };
    let sources = inputs.sources()?;
    let folder = args.output.as_deref().map(|path| Folder::new(path, args.force)).transpose()?;
    let (maps, tally) = survey(&sources, inputs.workers(), common.quiet, |_, _, item| {
        of_map(item, &patterns, folder.as_ref())
    });
    let text = if args.json { json(&patterns, &maps) } else { counts(&patterns, &maps) };
    output::print(text.as_bytes())?;
    tally.end("files")
}

/// The patterns of an argument.
fn patterns(word: &str) -> Result<Vec<RoadPattern>, Failure> {
    if word == ALL {
        return Ok(shipped::all().to_vec());
    }
    if !word.ends_with(".toml") {
        return shipped::named(word).map(|pattern| vec![pattern.clone()]).map_err(Failure::usage);
    }
    let refused = |faults: Vec<_>| {
        let lines: Vec<String> = faults.iter().map(|fault| format!("{word}: {fault}")).collect();
        Failure::input(lines.join("\n  "))
    };
    RoadPattern::parse(&output::read_text(Path::new(word))?).map(|pattern| vec![pattern]).map_err(refused)
}

/// The places of all patterns on a map.
fn of_map(item: Item, patterns: &[RoadPattern], folder: Option<&Folder>) -> Result<MatchedMap, Failure> {
    let graph = LaneGraph::new(&item.scene.map);
    let (mut lanes, mut places) = (0, Vec::new());
    for pattern in patterns {
        let search = PatternSearch::new(pattern, &item.scene, &graph);
        let matched = search.all();
        if let Some(folder) = folder {
            write(folder, pattern, &item.scene, &item.name, &matched)?;
        }
        lanes = search.lanes();
        places.push(matched);
    }
    Ok(MatchedMap { name: item.name, lanes, places })
}

/// Writes a scene for each place, with the default values.
fn write(
    folder: &Folder,
    pattern: &RoadPattern,
    scene: &Scene,
    map: &str,
    places: &[PatternPlace],
) -> Result<(), Failure> {
    for place in places {
        let agents = place.cast(pattern, &pattern.standard(), 0).map_err(Failure::input)?;
        let name = format!("{}-{map}-{}", pattern.name, place.id);
        let made = PatternPlace::scene(scene, name.clone(), agents, 0);
        folder.write(&format!("{name}.json"), &native::write(&made))?;
    }
    Ok(())
}

/// How many lanes match, one line per pattern.
fn counts(patterns: &[RoadPattern], maps: &[MatchedMap]) -> String {
    let lanes: usize = maps.iter().map(|map| map.lanes).sum();
    let mut text = String::new();
    for (i, pattern) in patterns.iter().enumerate() {
        let count =
            maps.iter().filter_map(|map| map.places.get(i)).fold(MatchCount::default(), |count, places| {
                let own: BTreeSet<&str> = places.iter().map(|place| place.lane.as_str()).collect();
                MatchCount { lanes: count.lanes + own.len(), places: count.places + places.len() }
            });
        let MatchCount { lanes: matched, places } = count;
        text += &format!("{:<22}{matched} of {lanes} lanes match, {places} places\n", pattern.name);
    }
    text
}

/// The places as JSON.
fn json(patterns: &[RoadPattern], maps: &[MatchedMap]) -> String {
    let lines = maps.iter().flat_map(|map| {
        let of = patterns.iter().zip(&map.places);
        of.flat_map(move |(pattern, places)| {
            places.iter().map(move |place| PlaceLine {
                pattern: &pattern.name,
                map: &map.name,
                id: &place.id,
                lane: &place.lane,
                s_m: native::round_m(place.s_m),
                x_m: native::round_m(place.position.x),
                y_m: native::round_m(place.position.y),
            })
        })
    });
    // It holds only numbers and texts, which serde_json always writes.
    serde_json::to_string_pretty(&lines.collect::<Vec<_>>()).unwrap_or_default() + "\n"
}
