//! The sentences of refused files, beside the general ones of [`scene::sentences`], and their words.

use scene::message::{Placeholder, Word};

pub use scene::sentences::{
    appears_twice, at_most, expected, found_expected, more_than, out_of_range, outside,
};

/// Things that are counted, missing or not read: the values `what` of sentences.
pub mod what {
    pub use scene::sentences::what::{ENTRIES, ID, SIGNALS};

    scene::words! {
        ATTRIBUTE = "attribute";
        ATTRIBUTES = "attributes";
        CALL = "a call of something that is not a name";
        CLASS_OBJECT = "an object of a class";
        BYTES = "bytes";
        CHUNKS = "column chunks";
        COLUMN_BYTES = "bytes of the file's description";
        COORDINATE = "coordinate in metres";
        DECODED_BYTES = "bytes once decompressed";
        DOCTYPE = "a document type definition";
        DOCUMENT_VALUES = "values in a document of this size";
        ELEMENTS = "elements";
        FEATURES = "features";
        FIELD_BYTES = "bytes of a protobuf field";
        FILE_BYTES = "bytes of a Parquet file";
        FUTURES = "futures";
        GOAL = "goal";
        GROUP_BYTES = "bytes of the pages of a row group once unpacked";
        HIGHWAY = "way that is tagged highway";
        INSTRUCTION = "an instruction";
        IDS = "ids";
        LANE = "lane";
        LANES = "lanes";
        LANE_OR_USER = "lane or road user";
        LANELETS = "lanelets";
        LANELET_POINTS = "points of lanelets";
        LANE_METRES = "m of lanes";
        LINE = "a line";
        LINES = "lines";
        LINE_BYTES = "bytes in a line";
        LINE_METRES = "m of reference lines";
        MAPS = "maps that come with a table";
        MAP_BYTES = "bytes of maps that come with a table";
        MEMBERS = "members of a relation";
        MEMORY = "lists, dictionaries and arrays";
        MESSAGES = "messages of one kind";
        NESTED = "nested elements";
        OBJECTS = "objects";
        OBSTACLES = "obstacles";
        ORIGIN = "origin in metres";
        OUTER_BYTES = "bytes outside of the file";
        OUTER_REFERENCE = "a reference to something outside of the file";
        PAGE_BYTES = "bytes of a page once unpacked";
        POINTS = "points";
        POSITIONS = "positions";
        RECORD = "record";
        RECORD_DATA = "the data of a record";
        RECORD_LENGTH = "the length of a record (broken, or not a TFRecord file)";
        RECORD_BYTES = "bytes of a record";
        REFERENCES = "references";
        REGISTERED_NAME = "a name by its number in a registry";
        RELATIONS = "relations";
        REMEMBERED = "memo entries";
        ROADS = "roads";
        ROAD_BYTES = "bytes of roads";
        ROAD_ELEMENTS = "elements of roads";
        ROAD_POINTS = "points of roads";
        ROAD_USER = "road user";
        ROAD_USERS = "road users";
        ROW = "row";
        ROWS = "rows";
        ROW_BYTES = "bytes in a row";
        SCENE = "scene";
        SCENES = "scenes of 9.1 s in one scenario";
        SECTION_LANES = "lanes in one lane section";
        SIGNS = "signs, signals and references";
        SPEED = "speed in m/s";
        STATE = "a state of something that is not an array";
        STATES = "states";
        TAG = "a tag";
        TAG_BYTES = "bytes in a tag";
        TEXT = "a text";
        TRACKS = "tracks";
        TRACKS_OR_MAP = "tracks and no map features";
        TRACK_STATES = "states of a track";
        VALUES = "values";
        VIA_POINT = "via point";
        VIA_POINTS = "via points";
        WAY_POINTS = "points of a way";
        WIDTH = "width in metres";
        XML_ELEMENT = "XML element";
    }
}

/// The values `expected` of sentences.
pub mod wanted {
    scene::words! {
        AFTER_VIA = "a time after that of the via point before";
        AROUND = "X,Y,RADIUS: the coordinates of a place in the file and 10 to 5000 m";
        AGENT_TYPE = "vehicle, pedestrian or cyclist";
        ANGLE = "an angle in degrees";
        ARGUMENTS = "arguments that the name takes";
        ARRAY_BYTES = "as many bytes as the array has values";
        ARRAY_SHAPE = "the shape of an array";
        ARRAY_STATE = "the state of an array";
        ARRAY_TYPE = "the type of an array";
        ATTRIBUTE = "an attribute such as x=\"1.5\"";
        BEFORE_GOAL = "a time before that of the goal";
        BOUNDS = "two or more points";
        BOUNDED = "a finite number that is not too large";
        BYTES = "bytes";
        COLUMN_OR_VALUE = "a column, a value for all rows, or both";
        COLUMN_VALUES = "as many values in a column as there are rows";
        COORDINATE = "a coordinate in metres";
        COORDINATE_OR_INVALID = "a coordinate in metres (or valid = 0)";
        CSV = "CSV text, not Parquet";
        DEGREES = "degrees";
        DICTIONARY = "a dictionary";
        DICTIONARY_VALUES = "a dictionary of no more values than it has bytes for";
        DURATION = "a duration in seconds";
        ELEMENT = "an element";
        ENCODING = "plain or dictionary encoding of a page";
        FACTOR = "a factor other than zero and a finite offset";
        FCD = "SUMO's FCD (<fcd-export>)";
        FCD_COLUMNS = "columns timestep_time, vehicle_id, vehicle_x, vehicle_y, vehicle_angle, vehicle_speed, separated by ;";
        FIELD_NUMBER = "a field number of protobuf";
        FINITE = "finite numbers at valid steps";
        FINITE_POINTS = "finite points";
        FLAT_COLUMN = "a flat column of numbers or text";
        FRAME_RATE = "frames a second";
        FUTURE = "the number of a future";
        HALF = "length_m or width_m in add_half, or one of them with a minus";
        HEADER = "the whole header of a page";
        HEADER_VALUES = "a page header without contradictions";
        HEADING = "a heading in radians";
        HEX = "\"sha256:\" and 64 hex digits";
        ID = "an id";
        ID_BYTES = "an id of 1 to 256 bytes";
        ID_NUMBER = "a whole number as id";
        IDS = "ids that are texts or numbers";
        INSTRUCTION = "a known instruction";
        ITEM = "an item on the stack";
        KEY_VALUES = "a value for each key";
        LETTER = "a character code";
        LIST = "a list";
        MAGIC = "PAR1 at the beginning and the end";
        MARK = "a mark on the stack";
        MEMORY = "a memo entry";
        METRES = "at most 1e8 m";
        NAME_OR_OBJECT = "a name or an object";
        NUMBER = "a number";
        NUMBERS = "numbers";
        NUMBER_10 = "a protobuf number of at most ten bytes";
        NUMBER_8 = "a number of at most eight bytes";
        ONE_PLACE = "exactly one of ahead_m, behind_m, behind_s and after_s";
        ONE_SCENARIO = "one scenario in the file";
        PAGE_PLACE = "pages that end within their column";
        PAIR = "a pair";
        PARAMETER = "the name of a declared parameter, or an expression in ${}";
        PLACE = "a position";
        POINT = "a point such as 1.5,-2.0";
        PROBABILITY = "a probability";
        QUOTES = "quotes around a text";
        RANGES = "rising half-open ranges within the track";
        REFERENCE = "a known reference";
        ROOT_END = "the end of the document";
        ROW_GROUP = "all columns in each row group";
        OF_RECORDING = "a value, or a column with \"file\": \"recording\"";
        OF_TRACKS = "a column of the tracks: other tables are found by it";
        ROWS_OF_NUMBERS = "rows of numbers";
        ROWS_OF_XYZ = "rows of x, y and z";
        SCENARIO = "tracks and map_features of a ScenarioNet scenario";
        SCENARIO_FILES = "a scenario; import the sd_*.pkl files of the set, each of which is one";
        SCENARIO_RECORD = "a Scenario record, not a tf.Example (the dataset has both)";
        SCENARIO_ROWS = "a scenario whose rows stand together, with a name of up to 256 bytes";
        SCENE = "a scene";
        SIZE = "a size in metres";
        SPEED = "a speed in m/s";
        START_POSE = "a start pose, from the log or from \"start\"";
        START_TAG = "an open element";
        STEP = "a step";
        STEPS = "a number of steps";
        STEP_SIZE = "0.001 to 10 s";
        SUMO_NET = "a SUMO network (<net>)";
        TEXT = "a text";
        TABLE_FILES = "tracks and, if there are some, agents, agents_by and recording: names with one * each";
        TABLE_PART = "time_s with first and last time, agent_id with a list of ids, or both";
        TEXT_OR_NUMBER = "a text, a number or a boolean as value";
        THRIFT = "a description in Thrift";
        TIME = "a time in seconds";
        TIME_AFTER = "a time after that of the time step before";
        TIME_OR_STEP = "a time in seconds, or a step";
        TRUTH = "booleans";
        TUPLE = "a tuple";
        VERSION = "a version from 1 on";
        VELOCITY = "a velocity in m/s";
        WHOLE = "a whole number";
        WHOLE_NUMBER = "a protobuf number that ends within its message";
        WHOLE_FROM_0 = "a whole number from 0 on";
        WIDE_COLUMNS = "1 to 256 columns";
        WIRE_TYPE = "a wire type of protobuf that is not a group";
        WITHIN_FILE = "columns within the file";
    }
}

scene::messages! {
    both_or_neither(first: &str, second: &str) =
        "both-or-neither", "{first} is fixed, {second} is not; fix both or neither";
    cannot_decompress(words: &str) = "cannot-decompress", "cannot decompress or read: {words}";
    challenge_start(begin: usize, found: usize, found_s: f64) =
        "challenge-start",
        "the challenge begins at step {begin} (1.0 s), this scene at step {found} ({found_s:.1} s): generate \
         its futures with --start-time 1.0";
    checksum_differs(what: Word) = "checksum-differs", "the checksum of {what} does not match";
    contradiction(format: &str) = "contradiction", "cannot be read as {format}: the file contradicts itself";
    element_lacks_attribute(element: &str, attribute: &str) =
        "element-lacks-attribute", "<{element}> has no attribute \"{attribute}\"";
    element_lacks_child(element: &str, child: &str) = "element-lacks-child", "<{element}> has no <{child}>";
    file_ends_after(found: u64, expected: u64) =
        "file-ends-after", "the file ends after {found} of {expected} bytes of a record";
    file_ends_inside(what: impl Placeholder) = "file-ends-inside", "the file ends inside {what}";
    file_has_no(what: Word) = "file-has-no", "the file has no {what}";
    file_needs(format: &str, what: Word) =
        "file-needs", "a file of format {format} needs at least one {what}; the scene has none";
    file_too_long(bytes: u64, most: u64) =
        "file-too-long", "the file has {bytes} bytes or more; at most {most}";
    found_in_element(found: &str, element: &str, expected: Word) =
        "found-in-element", "\"{found}\" found in <{element}>, {expected} expected";
    found_one_of(found: &str, list: &str) = "found-one-of", "\"{found}\" found, one of {list} expected";
    index_beyond(index: u64, below: usize) =
        "index-beyond", "{index} found, a number from 0 and below {below} expected";
    inflates_too_much(most: u64) = "inflates-too-much", "decompresses to more than {most} times its size";
    lane_outside(lane: &str, what: Word, found: &str, least: &str, most: &str) =
        "lane-outside", "lane \"{lane}\", {what}: {found} found, {least} to {most} expected";
    lanelets_in_extract() = "lanelets-in-extract", "it has lanelets: a Lanelet2 map, which is read as lanelet2";
    map_too_wide(width_m: f64, height_m: f64, most_m: f64) =
        "map-too-wide", "{width_m:.0} m x {height_m:.0} m; a map reaches {most_m} m from its middle";
    needs(what: &str, expected: impl Placeholder) = "needs", "{what} needs {expected}";
    nested_deeper(most: usize) = "nested-deeper", "nested deeper than {most} levels";
    near_a_place() =
        "near-a-place",
        "--around X,Y,RADIUS (in a call: around) reads the part within RADIUS metres of X,Y in the coordinates of the file";
    netconvert_failed(words: &str) =
        "netconvert-failed", "netconvert could not make a network from the file: {words}";
    netconvert_missing() =
        "netconvert-missing",
        "an extract of OpenStreetMap is read with SUMO's netconvert, which is not installed: run `pip install eclipse-sumo` and start again";
    nothing_around(radius_m: f64, x: f64, y: f64, x_range: &str, y_range: &str) =
        "nothing-around",
        "no lane lies within {radius_m:.0} m of {x}, {y}; the file has x {x_range} and y {y_range}";
    network_too_large(most: usize, what: Word) =
        "network-too-large",
        "more than {most} {what}";
    no_column(column: &str, columns: &str) = "no-column", "no column \"{column}\"; there are {columns}";
    no_lanelets() =
        "no-lanelets", "no lanelets: if it is an extract of OpenStreetMap, it is read as osm";
    no_open_lanelets() =
        "no-open-lanelets",
        "no lanelets with two sides that a road user may use: subtypes and participants decide";
    no_projection(key: &str) =
        "no-projection", "the projection is unknown: {key} of the map names no UTM zone";
    no_roads_with_lanes(words: &str) = "no-roads-with-lanes", "no roads with lanes: {words}";
    no_table(table: &str) = "no-table", "the database has no table {table}";
    not_both(first: &str, second: &str) = "not-both", "give either {first} or {second}, not both";
    not_read(what: Word) = "not-read", "{what} is not read";
    not_utf8(what: Word) = "not-utf8", "{what} is not UTF-8";
    one_of(list: &str) = "one-of", "one of {list} expected";
    one_scene_a_file() = "one-scene-a-file", "a file of this format holds one scene";
    only_read(format: &str) = "only-read", "{format} is read, not written";
    only_written(format: &str) = "only-written", "{format} is written, not read";
    empty_file() = "empty-file", "the file is empty";
    json_array() =
        "json-array", "the file is a JSON array; a scene is a JSON object with the format dragtraffic.scene";
    other_kind(file: &str, instead: &str) = "other-kind", "{file} is not read; {instead}";
    other_kind_named(file: &str, instead: &str, end: &str) =
        "other-kind-named",
        "{file} is not read; {instead} (its name ends in .{end}, its content is something else)";
    parser_words(words: &str) = "parser-words", "{words}";
    pickle_calls(byte: usize, name: &str) =
        "pickle-calls",
        "byte {byte}: the pickle asks for {name}; numbers, texts, lists and arrays are read, nothing is called";
    pickle_holds(byte: usize, what: impl Placeholder) =
        "pickle-holds",
        "byte {byte}: {what} found; numbers, texts, lists and arrays are read";
    positions_over_limit(most: usize, what: Word, within_s: f64) =
        "positions-over-limit",
        "more than {most} {what} within {within_s:.1} s; record fewer (fcd-output.filter-edges.input-file, \
         device.fcd.probability)";
    range_outside(what: Word, found: &str, least: &str, most: &str) =
        "range-outside", "{what}: {found} found, {least} to {most} expected";
    road_over_limit(road: &str, records: usize) =
        "road-over-limit", "road \"{road}\" has {records} records, too many for its length";
    roads_over_memory(lanes_m: f64, elements: usize) =
        "roads-over-memory",
        "{lanes_m:.0} m of lanes and {elements} elements would take more memory than a file of this size may";
    roads_too_far(reach_km: f64) = "roads-too-far", "roads over {reach_km:.0} km; a map spans a few kilometres";
    too_far_from_start(what: Word, distance_m: f64, most_m: f64) =
        "too-far-from-start", "the {what} is {distance_m:.1} m from the start, at most {most_m} m expected";
    unequal_columns(count: usize, expected: usize, like: &str) =
        "unequal-columns",
        [count] "{count} value, {expected} expected, as in {like}",
        "{count} values, {expected} expected, as in {like}";
    unknown_map() = "unknown-map", "the server has no map with this hash; send the map itself";
    unreadable(format: &str, words: &str) = "unreadable", "cannot be read as {format}: {words}";
    unsupported_version(found: u64, known: u64) =
        "unsupported-version", "version {found} found, versions up to {known} are supported";
    zip_without(first: &str, second: &str) =
        "zip-without", "a zip without a file whose name ends in {first} or {second}";
}

/// The first count over its limit.
pub(crate) fn exceeded(counts: &[(usize, usize, Word)]) -> Option<(usize, Word)> {
    counts.iter().find(|(count, most, _)| count > most).map(|(_, most, what)| (*most, *what))
}

/// Outside text in the form in which a sentence shows it.
pub(crate) fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}

/// Outside text in quotes.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", shown(text))
}

/// An element's name in its brackets.
pub(crate) fn tag(name: &str) -> String {
    format!("<{}>", shown(name))
}
