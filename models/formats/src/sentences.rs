//! The sentences of the readers' refusals and warnings (what a reader changed, assumed or left out) and of the
//! writers' losses.

use scene::message::Word;

/// What repeats an id or needs another one.
pub mod subject {
    use scene::message::Word;

    /// Agents of a scene.
    pub const ROAD_USERS: Word = Word { code: "road-users", english: "road users" };
    /// Lanes, lines, edges and areas.
    pub const MAP_FEATURES: Word = Word { code: "map-features", english: "map features" };
    /// Recorded motion.
    pub const TRACKS: Word = Word { code: "tracks", english: "tracks" };
}

/// What is wrong with text that should be JSON.
pub mod json_fault {
    use scene::message::Word;

    const FAULTS: [(&[&str], Word); 7] = [
        (&["EOF"], Word { code: "cut-off", english: "the text is cut off" }),
        (&["expected value", "expected ident"], Word { code: "no-value", english: "a value is missing" }),
        (&["trailing comma"], Word { code: "comma", english: "there is one comma too many" }),
        (&["trailing characters"], Word { code: "text-after", english: "text follows after the end" }),
        (&["key must be a string"], Word { code: "no-quotes", english: "a name has no quotes" }),
        (&["expected "], Word { code: "no-sign", english: "a comma, colon or bracket is missing" }),
        (&["invalid number", "number out of range"], Word { code: "number", english: "a number is invalid" }),
    ];
    const TEXT: Word = Word { code: "text", english: "a text is invalid" };

    /// The fault that the parser names; its words are serde_json's.
    pub(crate) fn of(error: &serde_json::Error) -> Word {
        let words = error.to_string();
        let named = |starts: &[&str]| starts.iter().any(|start| words.starts_with(start));
        FAULTS.iter().find(|(starts, _)| named(starts)).map_or(TEXT, |(_, word)| *word)
    }
}

scene::messages! {
    json_syntax(fault: Word) = "json-syntax", "not valid JSON: {fault}";
    not_a_known_format(formats: &str) = "not-a-known-format", "not a file of a known format ({formats})";
    boxes_across(count: usize) =
        "boxes-across",
        [count] "The long side of {count} box lies across its motion: length and width may be swapped",
        "The long sides of {count} boxes lie across their motion: length and width may be swapped";
    columns_missing(missing: &str, columns: &str) =
        "columns-missing",
        "no column {missing}; there are {columns}. A file of columns can name them (--columns, a part columns of a form)";
    columns_recognised(sets: &str) =
        "columns-recognised", "The columns are read as those of the data set {sets}; --columns names others";
    agents_table_missing() =
        "agents-table-missing", "The table of road users, which gives their types, is missing";
    recording_table_missing() =
        "recording-table-missing",
        "The table of the recording, which gives frame rate, speed limit and place, is missing";
    rows_in_part(kept: usize, found: usize, before_s: f64) =
        "rows-in-part",
        "The table has {found} rows, more than are read at once: the {kept} rows before {before_s:.1} s are read. \
         \"only\" in a file of columns chooses another part by time_s or agent_id";
    files_beside(count: usize, names: &str) =
        "files-beside",
        [count] "{count} file from the same folder is read with the table: {names}",
        "{count} files from the same folder are read with the table: {names}";
    map_unread(name: &str, why: &str) = "map-unread", "The map {name} cannot be read: {why}";
    speed_limit_of_recording(limit_mps: f64, count: usize) =
        "speed-limit-of-recording",
        [count] "{count} lane without a speed limit has that of the recording, {limit_mps:.1} m/s",
        "{count} lanes without a speed limit have that of the recording, {limit_mps:.1} m/s";
    agents_near_ego(found: usize, kept: usize) =
        "agents-near-ego", "{found} road users; the {kept} nearest to the ego are kept";
    agents_near_centre(found: usize, kept: usize, within_m: f64) =
        "agents-near-centre",
        "{found} road users; the {kept} nearest to their centre are kept, within {within_m} m of the origin";
    agents_with_used_id(count: usize) =
        "agents-with-used-id",
        [count] "{count} obstacle with the id of another obstacle is left out",
        "{count} obstacles with the id of another obstacle are left out";
    agents_outside_network(count: usize, found: usize) =
        "agents-outside-network",
        [count] "{count} of {found} road users lies outside the network: it belongs to another recording, \
         or positions are in degrees (fcd-output.geo) rather than metres",
        "{count} of {found} road users lie outside the network: it belongs to another recording, or \
         positions are in degrees (fcd-output.geo) rather than metres";
    areas_too_far(count: usize, within_m: f64) =
        "areas-too-far",
        [count] "{count} drivable area reaches farther than {within_m} m from the centre and is left out",
        "{count} drivable areas reach farther than {within_m} m from the centre and are left out";
    crossing_areas() =
        "crossing-areas", "Drivable areas overlap too often to find the edges of the road";
    crossing_lanelets() =
        "crossing-lanelets", "Lanelets overlap too often to find the edges of the road";
    crossing_roads() = "crossing-roads", "Roads overlap too often to find their edges";
    cut_around(radius_m: f64, x: f64, y: f64, kept: usize, ended: usize, what: Word, outside: usize) =
        "cut-around",
        "within {radius_m:.0} m of {x}, {y}: lanes kept {kept}, of these ending at the circle {ended}; {what} outside {outside}";
    cut_in_scenes(each_s: f64) =
        "cut-in-scenes", "The recording is longer than a scene: it is cut into scenes of {each_s:.1} s";
    unread_by_place(count: usize, places: &str) =
        "unread-by-place",
        [count] "{count} element is not read: {places}",
        "{count} elements are not read: {places}";
    unread_places(all: usize, places: &str, more: usize) =
        "unread-places", "{all} elements are not read: {places} and {more} more";
    elements_unread(count: usize) =
        "elements-unread",
        [count] "{count} element that a scene cannot hold is left out",
        "{count} elements that a scene cannot hold are left out";
    features_unread(count: usize) =
        "features-unread",
        [count] "{count} map feature of unknown kind or with too few points is left out",
        "{count} map features of unknown kind or with too few points are left out";
    futures_unread(count: usize) =
        "futures-unread",
        [count] "{count} future is empty, impossible or beyond the limit, and is left out",
        "{count} futures are empty, impossible or beyond the limit, and are left out";
    goals_beyond_first(count: usize) =
        "goals-beyond-first",
        [count] "{count} further goal of the same road user is left out",
        "{count} further goals of the same road users are left out";
    goals_are_regions(count: usize) =
        "goals-are-regions",
        [count] "{count} goal is a region; its centre is used",
        "{count} goals are regions; their centres are used";
    headings_derived() =
        "headings-derived", "Headings are derived from the motion; a standing road user keeps its last \
         heading";
    headings_along_degrees(agree: usize, moving: usize) =
        "headings-along-degrees",
        "Headings are in degrees and were converted to radians: {agree} of {moving} moving road users move along them";
    headings_along_radians(agree: usize, moving: usize) =
        "headings-along-radians",
        "Headings are in radians where degrees are usual: {agree} of {moving} moving road users move along them";
    headings_in_degrees(outside: usize, found: usize) =
        "headings-in-degrees",
        "Headings are converted from degrees: as radians, those of {outside} of {found} road users would exceed a full turn, or the format has degrees";
    headings_wrapped(count: usize) =
        "headings-wrapped",
        [count] "{count} heading exceeds a full turn and was wrapped",
        "{count} headings exceed a full turn and were wrapped";
    ids_renumbered() = "ids-renumbered", "Lanes and junctions have numbers instead of SUMO's ids";
    ids_replaced(count: usize, subject: Word) =
        "ids-replaced",
        [count] "{count} id of {subject} was replaced: an id is unique and consists of letters, digits and _ . : -",
        "{count} ids of {subject} were replaced: an id is unique and consists of letters, digits and _ . : -";
    ids_respelled(count: usize) =
        "ids-respelled",
        [count] "{count} id was respelled or got a suffix",
        "{count} ids were respelled or got a suffix";
    ids_suffixed(count: usize, subject: Word) =
        "ids-suffixed",
        [count] "{count} repeated id of {subject} got a suffix",
        "{count} repeated ids of {subject} got a suffix";
    identities_joined(count: usize, pairs: &str, more: usize) =
        "identities-joined",
        [count] "{count} road user had a second id and is merged: {pairs} (and {more} more)",
        "{count} road users had a second id and are merged: {pairs} (and {more} more)";
    identities_joined_all(count: usize, pairs: &str) =
        "identities-joined-all",
        [count] "{count} road user had a second id and is merged: {pairs}",
        "{count} road users had a second id and are merged: {pairs}";
    jumps(count: usize) =
        "jumps",
        [count] "A road user was teleported {count} time; this gap remains",
        "Road users were teleported {count} times; these gaps remain";
    lanelets_unusable(count: usize) =
        "lanelets-unusable",
        [count] "{count} lanelet without two sides, or not for traffic, is left out",
        "{count} lanelets without two sides, or not for traffic, are left out";
    lanelets_with_used_id(count: usize) =
        "lanelets-with-used-id",
        [count] "{count} lanelet with the id of another lanelet is left out",
        "{count} lanelets with the id of another lanelet are left out";
    lanes_bordered(count: usize, length_m: f64) =
        "lanes-bordered",
        [count] "{count} lane ({length_m:.0} m) has borders in a section with widths, which the standard \
         prefers: its borders are left out",
        "{count} lanes ({length_m:.0} m) have borders in sections with widths, which the standard prefers: \
         their borders are left out";
    lanes_closed(count: usize) =
        "lanes-closed",
        [count] "{count} lane open to no road user (rails, strips) is left out",
        "{count} lanes open to no road user (rails, strips) are left out";
    lane_links_derived(count: usize) =
        "lane-links-derived",
        [count] "{count} lane link is not in the file: a lane that ends where another one begins is linked to it",
        "{count} lane links are not in the file: a lane that ends where another one begins is linked to it";
    lane_segments_unusable(count: usize) =
        "lane-segments-unusable",
        [count] "{count} lane segment without two sides is left out",
        "{count} lane segments without two sides are left out";
    lanes_shared(count: usize) =
        "lanes-shared",
        [count] "{count} two-way road is one lane wide: both directions share its middle",
        "{count} two-way roads are one lane wide: both directions share their middle";
    lanes_without_line(count: usize) =
        "lanes-without-line",
        [count] "{count} lane without a centre line is left out",
        "{count} lanes without a centre line are left out";
    left_hand() = "left-hand", "Traffic keeps to the left, as in this region";
    left_hand_network() = "left-hand-network", "Traffic keeps to the left, as the network states";
    lines_thinned(count: usize) =
        "lines-thinned",
        [count] "{count} line has more points than a scene holds and is thinned",
        "{count} lines have more points than a scene holds and are thinned";
    links_apart(count: usize) =
        "links-apart",
        [count] "{count} lane link is dropped: the ends lie more than a lane's width apart",
        "{count} lane links are dropped: the ends lie more than a lane's width apart";
    links_turned(count: usize) =
        "links-turned",
        [count] "{count} lane link leads backwards: it is turned, as its lanes meet the other way round",
        "{count} lane links lead backwards: they are turned, as their lanes meet the other way round";
    lines_approximated(count: usize) =
        "lines-approximated",
        [count] "{count} painted line has a type or colour that a scene does not support",
        "{count} painted lines have a type or colour that a scene does not support";
    loss_lane_lines(off_mm: f64, count: usize) =
        "loss-lane-lines",
        [count] "lanes are polylines within {off_mm:.0} mm, and {count} has its start as a connecting road",
        "lanes are polylines within {off_mm:.0} mm, and {count} have their start as a connecting road";
    loss_lane_points(off_mm: f64) =
        "loss-lane-points",
        "lanes are within {off_mm:.0} mm of their lines when their points are set again; stop lines and stop \
         signs are where lanes begin and end";
    loss_lanes_without_length(count: usize) =
        "loss-lanes-without-length",
        [count] "{count} lane of no length",
        "{count} lanes of no length";
    loss_lights_over_room(most: usize) =
        "loss-lights-over-room",
        "a record has room for {most} signals per step";
    loss_lines_sampled(apart_m: f64) =
        "loss-lines-sampled",
        "lines as points {apart_m} m apart, without lane graph and speed limits";
    loss_longer(steps: usize, known: usize) =
        "loss-longer",
        "nothing is cut: {steps} steps, where the scene has {known}";
    loss_motion_extrapolated(count: usize) =
        "loss-motion-extrapolated",
        [count] "{count} motion ends early and continues straight",
        "{count} motions end early and continue straight";
    loss_points_over_room(count: usize, most: usize) =
        "loss-points-over-room",
        [count] "{count} map point; a record has room for {most}",
        "{count} map points; a record has room for {most}";
    loss_rollouts(count: usize, most: usize) =
        "loss-rollouts",
        [count] "{count} of the {most} rollouts that the challenge takes: generate that many samples",
        "{count} of the {most} rollouts that the challenge takes: generate that many samples";
    loss_single_precision(off_um: f64) =
        "loss-single-precision",
        "numbers are in single precision: off by up to {off_um:.0} um";
    loss_steps_over_room(past: usize, future: usize) =
        "loss-steps-over-room",
        "states more than {past} steps before the current one or {future} after it";
    loss_users_off_lanes(count: usize) =
        "loss-users-off-lanes",
        [count] "{count} road user without a lane of its own is only in the recording",
        "{count} road users without a lane of their own are only in the recording";
    loss_users_over_room(count: usize, most: usize) =
        "loss-users-over-room",
        [count] "{count} road user; a record has room for {most}",
        "{count} road users; a record has room for {most}";
    map_fault(first: &str) = "map-fault", "{first}";
    map_faults(first: &str, more: usize) = "map-faults", "{first} (and {more} more)";
    map_heights_dropped() = "map-heights-dropped", "The network has heights; the map is flat";
    map_lacks_lanelets() = "map-lacks-lanelets", "The file has no lanelets: the scene has no map";
    map_missing() =
        "map-missing", "The scenario has no map file (log_map_archive_*.json): the scene has no lanes";
    map_elsewhere(percent: f64) =
        "map-elsewhere",
        "Only {percent:.0}% of the vehicle positions are on lanes of the map: it belongs to another place or frame of reference";
    map_chosen(name: &str, maps: usize) =
        "map-chosen", "Of {maps} maps, that of {name} has the most vehicles on its lanes";
    map_laid(percent: f64) =
        "map-laid",
        "{percent:.0}% of the vehicle positions are on lanes of the map";
    moved_by_metadrive() =
        "moved-by-metadrive", "MetaDrive moved and turned the file; the place of the recording is unknown";
    network_missing() =
        "network-missing", "The recording has no network file: the scene has no lanes and no signals";
    now_step_moved(now: usize, steps: usize) =
        "now-step-moved", "The current step is {now} of {steps}: the last step is used";
    obstacles_absent(count: usize) =
        "obstacles-absent",
        [count] "{count} obstacle is absent at all steps that are kept",
        "{count} obstacles are absent at all steps that are kept";
    obstacles_are_sets(count: usize) =
        "obstacles-are-sets",
        [count] "{count} obstacle has possible areas instead of a trajectory: its first state is kept",
        "{count} obstacles have possible areas instead of a trajectory: their first state is kept";
    obstacles_uncertain(count: usize) =
        "obstacles-uncertain",
        [count] "{count} obstacle has uncertain states; the centres are used",
        "{count} obstacles have uncertain states; the centres are used";
    obstacles_unplaced(count: usize) =
        "obstacles-unplaced",
        [count] "{count} obstacle without a place, or without a size of at most 60 m, is left out",
        "{count} obstacles without a place, or without a size of at most 60 m, are left out";
    parts_left_out(parts: &str) = "parts-left-out", "Left out: {parts}";
    passengers_left_out(count: usize) =
        "passengers-left-out",
        [count] "{count} container or passenger is left out",
        "{count} containers and passengers are left out";
    programs_beyond_last() = "programs-beyond-last", "A signal has several programs; the last one is shown";
    recording_heights_dropped() = "recording-heights-dropped", "The recording has heights; the scene is flat";
    rows_repeated(count: usize) =
        "rows-repeated",
        [count] "{count} row repeats a road user at the same time; one row of each time is kept",
        "{count} rows repeat a road user at the same time; one row of each time is kept";
    shapes_boxed(count: usize) =
        "shapes-boxed",
        [count] "{count} obstacle is not rectangular: its bounding box is used",
        "{count} obstacles are not rectangular: their bounding boxes are used";
    signal_links_unprogrammed(count: usize) =
        "signal-links-unprogrammed",
        [count] "{count} link of a signal has no program and is left out",
        "{count} links of signals have no program and are left out";
    signals_empty(count: usize) =
        "signals-empty",
        [count] "{count} signal without a lane or without phases is left out",
        "{count} signals without a lane or without phases are left out";
    signals_held(count: usize) =
        "signals-held",
        [count] "{count} signal responds to traffic; it keeps the times of its plan",
        "{count} signals respond to traffic; they keep the times of their plan";
    signals_made(count: usize, junctions: usize) =
        "signals-made",
        [junctions] "The signal heads of {junctions} junction ({count}) have no program; they got fixed \
         times",
        "The signal heads of {junctions} junctions ({count}) have no program; they got fixed times";
    signals_made_near(count: usize, junctions: usize, kept: usize) =
        "signals-made-near",
        [junctions] "The signal heads of {junctions} junction ({count}) have no program; they got fixed \
         times, and the {kept} nearest to the centre are kept",
        "The signal heads of {junctions} junctions ({count}) have no program; they got fixed times, and \
         the {kept} nearest to the centre are kept";
    signals_near_centre(found: usize, kept: usize) =
        "signals-near-centre", "{found} signals; the {kept} nearest to the centre are kept";
    signals_over_limit(count: usize, kept: usize) =
        "signals-over-limit",
        [count] "{count} signal beyond the limit of {kept} is left out",
        "{count} signals beyond the limit of {kept} are left out";
    signals_without_lane(count: usize) =
        "signals-without-lane",
        [count] "{count} signal controls no lane of the map and is left out",
        "{count} signals control no lane of the map and are left out";
    sizes_assumed(count: usize) =
        "sizes-assumed",
        [count] "{count} road user has the default size of its type",
        "{count} road users have the default size of their type";
    sizes_assumed_by_name(count: usize) =
        "sizes-assumed-by-name",
        [count] "{count} road user has the default size for the name of its type",
        "{count} road users have the default size for the name of their type";
    sizes_assumed_car(count: usize) =
        "sizes-assumed-car",
        [count] "{count} planning problem has no size: the size of a car is used",
        "{count} planning problems have no size: the size of a car is used";
    sizes_vary_median(count: usize) =
        "sizes-vary-median",
        [count] "{count} road user changes size; the median is kept",
        "{count} road users change size; the median is kept";
    sizes_vary_now(count: usize) =
        "sizes-vary-now",
        [count] "{count} road user changes size; the size at the current step is kept",
        "{count} road users change size; the size at the current step is kept";
    steps_beyond_limit(length_s: f64, kept: usize) =
        "steps-beyond-limit", "The file lasts {length_s:.1} s; the first {kept} steps of 0.1 s are kept";
    steps_coarse(apart_s: f64, filled_s: f64) =
        "steps-coarse", "Time steps are {apart_s:.1} s apart; gaps longer than {filled_s} s remain";
    stop_points_vary() = "stop-points-vary", "A signal has several stop points; its first one is kept";
    time_resampled(apart_s: f64, step_s: f64) =
        "time-resampled", "Rows are {apart_s:.3} s apart; states are computed every {step_s} s";
    time_interpolated(apart_s: f64) =
        "time-interpolated", "Steps are {apart_s} s apart; states every 0.1 s are interpolated linearly";
    times_ignored(found: usize, steps: usize) =
        "times-ignored", "{found} times for {steps} steps, or a time is not finite; steps of 0.1 s are \
         assumed";
    times_incomplete() = "times-incomplete", "Some steps have no time; steps of 0.1 s are assumed";
    times_irregular() = "times-irregular", "Steps are not 0.1 s apart; they are read as if they were";
    types_assumed() = "types-assumed", "The table has no types; all road users count as vehicles";
    types_unknown(count: usize) =
        "types-unknown",
        [count] "{count} road user has an unknown type; it is shown but not generated",
        "{count} road users have an unknown type; they are shown but not generated";
    velocities_derived() = "velocities-derived", "Velocities are derived from positions and times";
}
