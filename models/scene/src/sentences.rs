//! The sentences of faults: general ones, which all readers use, and those of a scene.

use crate::message::{Message, Placeholder, Word};

/// Things that are counted or missing: the values `what` of sentences. A word that several crates need stands here.
pub mod what {
    crate::words! {
        AREA_CORNERS = "corners of areas";
        CHARACTERS = "characters";
        ENTRIES = "entries";
        ID = "id";
        LANE_LINKS = "links of lanes";
        LINKS = "links";
        PAIRS = "pairs of pieces of lines in the same 8 m x 8 m";
        PIECES = "pieces of lines in 8 m x 8 m";
        SIGNALS = "signals";
        SQUARES = "squares of 8 m that lines pass through";
    }
}

/// The values `expected` of sentences.
pub mod wanted {
    crate::words! {
        AS_LONG_AS_X = "as many values as x_m";
        COORDINATES = "finite coordinates within 10000 m";
        ID_CHARACTERS = "1 to 64 of A-Z a-z 0-9 _ . : -";
        LANE_RANGES = "width 0.1 to 50 m and speed limit 0 to 100 m/s";
        ROAD_EDGE = "the id of a road edge of the map";
        RUNS = "at least one run, with rising first steps within the scene";
        STATE_RANGES = "finite numbers within 10000 m and 150 m/s";
    }
}

crate::messages! {
    agents_over_limit(agents: usize, most: usize) = "agents-over-limit", "{agents} agents; at most {most}";
    appears_twice(what: Word, id: &str) = "appears-twice", "{what} \"{id}\" appears twice";
    at_most(found: impl Placeholder, what: Word, most: impl Placeholder) = "at-most", "{found} {what} found, at most {most} expected";
    expected(expected: impl Placeholder) = "expected", "{expected} expected";
    found_expected(found: impl Placeholder, expected: impl Placeholder) =
        "found-expected", "{found} found, {expected} expected";
    map_over_limit(lines: usize, points: usize, most_lines: usize, most_points: usize) =
        "map-over-limit",
        "{lines} polylines with {points} points; at most {most_lines} with {most_points}";
    more_than(most: impl Placeholder, what: Word) = "more-than", "more than {most} {what}";
    outside(found: &str, least: &str, most: &str) = "outside", "{found} found, {least} to {most} expected";
    points_out_of_range(count: usize, least: usize, most: usize) =
        "points-out-of-range",
        [count] "{count} point; {least} to {most} expected",
        "{count} points; {least} to {most} expected";
    state_expected(step: usize, expected: Word) = "state-expected", "state {step}: {expected} expected";
    track_beyond_scene(end: usize, steps: usize) =
        "track-beyond-scene", "track ends after step {end}, the scene has {steps}";
}

/// A number outside its range, both ends of which are allowed.
pub fn out_of_range(found: f64, least: f64, most: f64) -> Message {
    // A number with hundreds of digits is unreadable.
    let found = if found.abs() < 1e15 { found.to_string() } else { format!("{found:e}") };
    outside(&found, &least.to_string(), &most.to_string())
}
