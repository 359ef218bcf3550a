//! The sentences of faults: general ones for all readers, and those of a scene.

use crate::message::{Message, Placeholder, Word};

/// Countable or missing things: the values of `what` in sentences. Words that several crates use are here.
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

/// The values of `expected` in sentences.
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
    agents_over_limit(agents: usize, most: usize) = "agents-over-limit", "{agents} road users; at most {most}";
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
    relation_gone(agent: &str, time_s: f64) =
        "relation-gone", "Road user {agent}, to which the goal is relative, is not in the scene at {time_s:.1} s.";
    relation_lane_ends(agent: &str, short_m: f64, time_s: f64) =
        "relation-lane-ends",
        "The lane ends {short_m:.0} m before the place that is relative to road user {agent} at {time_s:.1} s.";
    relation_no_lane_left(number: usize, agent: &str, time_s: f64) =
        "relation-no-lane-left",
        "Lane {number} to the left of road user {agent} does not exist at {time_s:.1} s.";
    relation_no_lane_right(number: usize, agent: &str, time_s: f64) =
        "relation-no-lane-right",
        "Lane {number} to the right of road user {agent} does not exist at {time_s:.1} s.";
    relation_not_passed(agent: &str, within_m: f64) =
        "relation-not-passed", "Road user {agent} does not come within {within_m:.0} m of the goal.";
    relation_off_lanes(agent: &str, time_s: f64) =
        "relation-off-lanes", "Road user {agent} is on no lane at {time_s:.1} s, so it has no lane beside it.";
    relation_outside(agent: &str, passed_s: f64, time_s: f64, least_s: f64, most_s: f64) =
        "relation-outside",
        "Road user {agent} passes the goal at {passed_s:.1} s. The goal is then due at {time_s:.1} s; {least_s:.1} s to \
         {most_s:.1} s is possible.";
    relation_ring(row: &str) = "relation-ring", "the goals are relative to each other in a circle: {row}";
    relation_row(most: usize) = "relation-row", "more than {most} goals are relative to each other in a chain";
    relation_stands(agent: &str, time_s: f64) =
        "relation-stands", "Road user {agent} stands at {time_s:.1} s. A time gap needs a speed; use a gap in metres.";
    relation_to_itself() = "relation-to-itself", "the goal is relative to the same road user";
    relation_too_slow(agent: &str, other_mps: f64, time_s: f64, slower_mps: f64) =
        "relation-too-slow",
        "Road user {agent} drives at {other_mps:.1} m/s at {time_s:.1} s; {slower_mps:.1} m/s slower is below zero.";
    relation_unknown(id: &str) =
        "relation-unknown", "the goal is relative to \"{id}\", which is not in the scene";
    state_expected(step: usize, expected: Word) = "state-expected", "state {step}: {expected} expected";
    track_beyond_scene(end: usize, steps: usize) =
        "track-beyond-scene", "track ends after step {end}, the scene has {steps}";
}

/// A number outside its range, both ends included.
pub fn out_of_range(found: f64, least: f64, most: f64) -> Message {
    // A number with hundreds of digits is unreadable.
    let found = if found.abs() < 1e15 { found.to_string() } else { format!("{found:e}") };
    outside(&found, &least.to_string(), &most.to_string())
}
