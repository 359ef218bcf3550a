//! Inputs of the experts: the tables.
//!
//! The order of the fields is the order of the inputs, and the weights' header holds a hash of these tables.
//! After a change of a name, unit, scale or order, weights have to be trained again. `docs/features.md` is
//! generated from here.

use super::block::{Block, Feature, block, described, index_of};
use crate::planning::{INSTANTS, MODES, RESIDUAL};
use scene::ContentHash;
use std::fmt::Write;
use std::ops::Range;

/// Number of other road users among the inputs.
pub const NEIGHBOURS: usize = 16;

block! {
    /// Type of a road user, one flag each; all zero for any other type.
    pub struct KindFlags {
        vehicle: (flag) "a vehicle",
        pedestrian: (flag) "on foot",
        cyclist: (flag) "a cyclist",
        heavy: (flag) "a truck, bus or trailer",
    }
}

block! {
    /// The road user itself and its conditions. Ahead and left are relative to its heading at the start.
    pub struct Own {
        kind: [KindFlags; 1] "what it is",
        motorcycle: (flag) "a motorcycle",
        speed: (10.0 "m/s") "speed",
        stands: (flag) "slower than what counts as standing",
        velocity_ahead: (10.0 "m/s") "velocity ahead",
        velocity_left: (10.0 "m/s") "velocity to the left",
        length: (5.0 "m") "length of its box",
        width: (2.0 "m") "width of its box",
        goal_time: (9.0 "s") "time to the goal, or to the end of the window",
        goal_position_fixed: (flag) "the goal has a position",
        goal_heading_fixed: (flag) "the goal has a heading",
        goal_speed_fixed: (flag) "the goal has a speed",
        goal_ahead: (50.0 "m") "position of the goal, ahead",
        goal_left: (50.0 "m") "position of the goal, to the left",
        goal_distance: (50.0 "m") "distance of the goal",
        goal_bearing_cos: (1.0 "") "bearing of the goal, cosine; 0 at the goal itself",
        goal_bearing_sin: (1.0 "") "bearing of the goal, sine",
        goal_pace_change: (5.0 "m/s") "mean speed that the goal asks for, less the speed now",
        goal_heading_cos: (1.0 "") "heading at the goal, cosine; 0 where it is free",
        goal_heading_sin: (1.0 "") "heading at the goal, sine",
        goal_speed: (10.0 "m/s") "speed at the goal; 0 where it is free",
        goal_speed_change: (5.0 "m/s") "speed at the goal, less the speed now",
        on_lane: (flag) "a lane is within 6 m",
        lane_offset: (3.0 "m") "offset from the nearest lane, left positive; 3 m without one",
        lane_heading_cos: (1.0 "") "heading relative to that lane, cosine",
        lane_heading_sin: (1.0 "") "heading relative to that lane, sine",
        others_within_10_m: (5.0 "") "other road users within 10 m",
        others_within_30_m: (15.0 "") "other road users within 30 m",
    }
}

block! {
    /// Another road user, in the frame of the observing road user.
    pub struct Neighbour {
        ahead: (30.0 "m") "position ahead",
        left: (30.0 "m") "position to the left",
        distance: (30.0 "m") "distance",
        heading_cos: (1.0 "") "heading, cosine",
        heading_sin: (1.0 "") "heading, sine",
        velocity_ahead: (10.0 "m/s") "velocity ahead",
        velocity_left: (10.0 "m/s") "velocity to the left",
        speed: (10.0 "m/s") "speed",
        stands: (flag) "slower than 0.1 m/s",
        kind: [KindFlags; 1] "what it is",
        length: (5.0 "m") "length of its box",
        width: (2.0 "m") "width of its box",
        goal_fixed: (flag) "its goal has a position",
        goal_ahead: (50.0 "m") "position of its goal, ahead",
        goal_left: (50.0 "m") "position of its goal, to the left",
        goal_speed: (10.0 "m/s") "speed at its goal; -1 where it is free",
    }
}

block! {
    /// A point of an anchor's path.
    pub struct PathPoint {
        ahead: (30.0 "m") "position ahead",
        left: (30.0 "m") "position to the left",
        heading_cos: (1.0 "") "heading of the path, cosine",
        heading_sin: (1.0 "") "heading of the path, sine",
        cap: (10.0 "m/s") "speed that bends and limits allow there",
    }
}

block! {
    /// Base progress at a moment.
    pub struct BaseInstant {
        along: (30.0 "m") "metres along the path",
        speed: (10.0 "m/s") "speed",
    }
}

block! {
    /// State of a signal; all zero without one.
    pub struct LightFlags {
        known: (flag) "there is a light",
        stop: (flag) "it shows stop",
        caution: (flag) "it shows caution",
        go: (flag) "it shows go",
    }
}

block! {
    /// Where a path came from.
    pub struct PathFlags {
        route: (flag) "lanes all the way",
        joined: (flag) "by a curve onto or off the lanes",
        least_effort: (flag) "the motion of least effort",
        straight: (flag) "straight on",
    }
}

/// Points at which an anchor's path is seen: eighths of a little more than its base reaches.
pub const PATH_POINTS: usize = 8;
/// Steps at which an anchor's base is seen.
pub const BASE_STEPS: [usize; 6] = [10, 20, 35, 50, 70, 90];

block! {
    /// An anchor: a path, the base progress along it, and what lies ahead on it. Absent items are encoded as far away:
    /// 100 m for places, 12 s for times of arrival.
    pub struct AnchorInputs {
        path: [PathPoint; PATH_POINTS] "the path",
        base: [BaseInstant; BASE_STEPS.len()] "the base after 1, 2, 3.5, 5, 7 and 9 s",
        path_length: (100.0 "m") "length of the path",
        leader: (flag) "another road user is ahead on the path",
        leader_gap: (30.0 "m") "gap to the leader",
        leader_closeness: (1.0 "") "logarithm of 30 m over that gap",
        leader_speed: (10.0 "m/s") "speed of the leader",
        light: [LightFlags; 1] "the first light on the path",
        light_distance: (30.0 "m") "distance to the light",
        light_age: (10.0 "s") "time that it has been in its state",
        stop_sign: (flag) "a stop sign is ahead",
        stop_sign_distance: (30.0 "m") "distance to the stop sign",
        crossing: (flag) "somebody's straight way on crosses the path",
        crossing_distance: (30.0 "m") "distance to where it crosses",
        crossing_time: (9.0 "s") "when it crosses",
        crossing_speed: (10.0 "m/s") "how fast it is",
        speed_limit: (15.0 "m/s") "speed limit where the route begins; 0 without one",
        lateral: (3.0 "m") "offset from the route at the start, left positive",
        heading_error: (1.0 "rad") "heading relative to the route at the start",
        terminal: (flag) "the route ends where the map ends",
        origin: [PathFlags; 1] "where the path came from",
        slot: (flag; MODES) "which slot this is",
        timing: (1.0 "") "which of its path's timings this is, from slow to fast, over their number",
        timings: (6.0 "") "timings of this path",
        second_leader: (flag) "another road user is ahead of the leader",
        second_gap: (30.0 "m") "gap to that one",
        second_speed: (10.0 "m/s") "speed of that one",
        queue: (5.0 "") "standing road users on the path within 60 m",
        light_reached: (9.0 "s") "when the base gets to the light",
        light_speed: (10.0 "m/s") "how fast it is then",
        leader_reached: (9.0 "s") "when the base gets to the leader, who is taken to drive on as now",
        crossing_lead: (9.0 "s") "by how much the base gets later to the crossing than the other one",
        junction: (flag) "a junction is ahead, or it is in one",
        junction_from: (30.0 "m") "where the junction begins",
        junction_to: (30.0 "m") "where it ends",
        junction_turn: (1.0 "rad") "how far the path turns in it, to the left",
        junction_ways: (3.0 "") "ways that the lane before it leads on",
        junction_reached: (9.0 "s") "when the base enters the junction",
        junction_speed: (10.0 "m/s") "how fast it is then",
        lanes_left: (2.0 "") "lanes beside the first one on its left, the same way",
        lanes_right: (2.0 "") "lanes beside the first one on its right, the same way",
        lanes_oncoming: (2.0 "") "lanes beside the first one on its left, the other way",
    }
}

/// Numbers about the road user itself and its condition.
pub const OWN: usize = <Own as Block>::WIDTH;
/// Numbers of another road user.
pub const NEIGHBOUR: usize = <Neighbour as Block>::WIDTH;
/// Numbers of an anchor.
pub const ANCHOR: usize = <AnchorInputs as Block>::WIDTH;

/// Range of the inputs about the road user itself that describe its goal: time, masks, values.
pub const OWN_GOAL: Range<usize> = index_of!(Own, goal_time)..index_of!(Own, on_lane);
/// Range of the values among them, without time and masks.
pub const OWN_GOAL_VALUES: Range<usize> = index_of!(Own, goal_ahead)..index_of!(Own, on_lane);
/// Position ahead and left, heading as cosine and sine, and speed among those values; then the box's length and width.
pub const OWN_CONDITION: [usize; 7] = [
    index_of!(Own, goal_ahead),
    index_of!(Own, goal_left),
    index_of!(Own, goal_heading_cos),
    index_of!(Own, goal_heading_sin),
    index_of!(Own, goal_speed),
    index_of!(Own, length),
    index_of!(Own, width),
];
/// Index of the mask of the goal's position.
pub const OWN_GOAL_POSITION: usize = index_of!(Own, goal_position_fixed);
/// Range of a neighbour's inputs that describe its goal.
pub const NEIGHBOUR_GOAL: Range<usize> = index_of!(Neighbour, goal_fixed)..NEIGHBOUR;

/// The tables by name.
pub fn tables() -> [(&'static str, Vec<Feature>); 3] {
    [
        ("own", described::<Own>()),
        ("neighbour", described::<Neighbour>()),
        ("anchor", described::<AnchorInputs>()),
    ]
}

/// Hash of everything about an expert's inputs and outputs on which its weights depend.
pub fn tables_hash() -> String {
    let mut text = format!("neighbours {NEIGHBOURS} modes {MODES} instants {INSTANTS} residual {RESIDUAL}\n");
    for (block, features) in tables() {
        for feature in features {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{block} {} {} {}", feature.name, feature.unit, feature.scale);
        }
    }
    ContentHash::of_bytes(text.as_bytes()).hex()
}

/// The tables as a Markdown page.
pub fn page() -> String {
    let mut out = String::from(
        "# What the experts see\n\nMade from `models/experts/src/features/tables.rs`; `cargo xtask golden --accept` \
         makes it anew. Each value is divided by its scale and kept within -20 .. 20.\n",
    );
    for (block, features) in tables() {
        let _ =
            writeln!(out, "\n## {block}\n\n| index | name | unit | scale | what |\n|---|---|---|---|---|");
        for (index, f) in features.iter().enumerate() {
            let _ = writeln!(out, "| {index} | {} | {} | {} | {} |", f.name, f.unit, f.scale, f.meaning);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_those_of_the_tables() {
        let [(_, own), (_, neighbour), (_, anchor)] = tables();
        assert_eq!((own.len(), neighbour.len(), anchor.len()), (OWN, NEIGHBOUR, ANCHOR));
        let goal = |features: &[Feature]| -> Vec<usize> {
            (0..features.len()).filter(|i| features[*i].name.starts_with("goal_")).collect()
        };
        assert_eq!(OWN_GOAL.collect::<Vec<_>>(), goal(&own), "{own:?}");
        assert_eq!(NEIGHBOUR_GOAL.collect::<Vec<_>>(), goal(&neighbour), "{neighbour:?}");
        assert_eq!(own[OWN_GOAL_POSITION].name, "goal_position_fixed");
    }

    #[test]
    fn no_two_inputs_have_one_name() {
        for (block, features) in tables() {
            let names: std::collections::BTreeSet<&str> = features.iter().map(|f| f.name.as_str()).collect();
            assert_eq!(names.len(), features.len(), "{block}");
            assert!(features.iter().all(|f| f.scale > 0.0 && !f.meaning.is_empty()), "{block}");
        }
    }
}
