//! The sentences of refused requests.

/// Countable parts of requests: the values of `what` in sentences.
pub mod what {
    pub use scene::sentences::what::ENTRIES;

    scene::words! {
        ARMS = "arms";
        PLACES = "places";
        TRAITS = "traits";
    }
}

/// The values of `expected` in sentences.
pub mod wanted {
    scene::words! {
        AREA = "a ring that encloses some area";
        COLUMNS = "columns of equal length with at least one value";
        ONE_RATE = "one rate for each arm";
    }
}

scene::messages! {
    unknown_agent(id: &str) = "unknown-agent", "the scene has no road user \"{id}\"";
    not_asked(id: &str) =
        "not-asked", "road user \"{id}\" is not in agents: add \"{id}\" to agents, or leave this condition out";
    no_agents_named() =
        "no-agents-named", "expected \"all\", at least one id, or at least one road user that reacts";
    too_many_regenerated(count: usize, most: usize) =
        "too-many-regenerated",
        [count] "{count} road user to regenerate; at most {most}",
        "{count} road users to regenerate; at most {most}";
    too_many_points(points: usize, most: usize) =
        "too-many-points", "the reply would have {points} points; at most {most}";
    too_much_work(seconds: usize, most: usize) =
        "too-much-work", "the call would take about {seconds} s of a core; at most {most}";
    no_future_kept() =
        "no-future-kept", "the scene keeps no future of this road user from the start on";
    replan_interval(got: f64) = "replan-interval", "{got} s; null, 3, 6 or 9 expected";
    more_than_a_turn(got: &str, radians: &str) =
        "more-than-a-turn", "{got} rad is more than a turn; {got} degrees are {radians} rad";
    exactly_one(first: &str, second: &str) = "exactly-one", "exactly one of {first} and {second} is needed";
    share_sum(sum: &str) = "share-sum", "the shares sum to {sum}; 1 expected";
    empty_map() = "empty-map", "the map is empty: it has no place for a region";
    one_scene() = "one-scene", "exactly one of scene and scene_id is needed";
    changed_scene() = "changed-scene", "The stored scene has changed since it was read.";
    no_network(format: &str) = "no-network", "a file of format {format} takes no network file";
    no_part(format: &str) =
        "no-part", "a file of format {format} is read whole; maps of SUMO, OpenDRIVE, Lanelet2 and OpenStreetMap are read in part";
    no_columns(format: &str) = "no-columns", "a file of format {format} has no columns to name";
    unknown_format(format: &str, formats: &str) =
        "unknown-format", "No format is named \"{format}\"; there are {formats}.";
    ego_absent(id: &str) = "ego-absent", "\"{id}\" is not in the scene at the start";
    ego_once(id: &str) = "ego-once", "\"{id}\" must be named exactly once";
    not_an_ego(id: &str) = "not-an-ego", "\"{id}\" is not an ego";
    no_state(id: &str, at: usize) = "no-ego-state", "\"{id}\", state {at}: the position or the speed is out of range";
    step_order(got: usize, next: usize) = "step-order", "step {got} found, step {next} expected";
    setting_of_snapshot(member: &str) = "setting-of-snapshot", "the snapshot has its own {member}";
    snapshot_of_another_scene() = "snapshot-of-another-scene", "the snapshot belongs to another scene";
    snapshot_broken(at: usize) = "snapshot-broken", "not a snapshot: byte {at} is wrong";
    too_many_runs() = "too-many-runs", "no room for another run; delete one, or wait";
    too_many_requests(most: usize) =
        "too-many-requests",
        [most] "more than {most} request a second from this caller",
        "more than {most} requests a second from this caller";
    defect() = "defect", "The server failed; see its log.";
}
