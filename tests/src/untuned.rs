//! Numbers of the engine outside its tables of tuned numbers, and a search for them in the sources.
//!
//! The reasons are:
//! - `input`: measured for the networks.
//! - `bound`: only leaves out what cannot matter.
//! - `grid`, `bracket`: resolution of a search.
//! - `divisor`: keeps a division finite.
//! - `kinematics`, `geometry`, `angle`, `polynomial`: follow from a formula.
//! - `sample`: the scene that warms the engine up.

/// Floating-point constants outside `experts::tuning`: file, name, and the reason in a word.
pub const CONSTANTS: &[(&str, &str, &str)] = &[
    ("features/agent.rs", "BEYOND_M", "input"),
    ("features/ahead.rs", "QUEUE_M", "input"),
    ("features/ahead.rs", "MEETS_M", "input"),
    ("features/block.rs", "BOUND", "input"),
    ("features/encode.rs", "STILL_MPS", "input"),
    ("features/encode.rs", "FAR_M", "input"),
    ("features/encode.rs", "NEVER_S", "input"),
    ("features/encounters.rs", "WITHIN_M", "input"),
    ("features/encounters.rs", "POSITION_M", "input"),
    ("features/encounters.rs", "HALF_M", "input"),
    ("features/encounters.rs", "GAP_M", "input"),
    ("features/encounters.rs", "GAP_SCALE_M", "input"),
    ("features/mod.rs", "STANDING_SHARE", "training"),
    ("features/mod.rs", "MOVING_DRAWS", "training"),
    ("maps.rs", "CELL_NS", "measured"),
    ("maps.rs", "PAIR_NS", "measured"),
    ("maps.rs", "USUAL_CROWD", "measured"),
    ("generator/replan.rs", "ASIDE_M", "grid"),
    ("generator/replan.rs", "AHEAD_M", "grid"),
    ("generator/replan.rs", "TAIL_M", "numerics"),
    ("generator/replan.rs", "SHIFTED_M", "geometry"),
    ("generator/verdict.rs", "AWAY_M", "bound"),
    ("generator/variations.rs", "END_S", "geometry"),
    ("generator/variations.rs", "HELD_AT_S", "grid"),
    ("generator/others/blocks.rs", "SPACING_M", "grid"),
    ("generator/others/blocks.rs", "HAIR_M", "rounding"),
    ("generator/others/path_progress.rs", "GRAIN_M", "grid"),
    ("generator/others/yielding.rs", "HAIR_M", "rounding"),
    ("generator/repulsion.rs", "NEAR_M", "bound"),
    ("generator/subgoal.rs", "THERE_M", "rounding"),
    ("generator/trajectory.rs", "LEAST_CHORD_M", "numerics"),
    ("net/initializer.rs", "SPREAD", "architecture"),
    ("net/inputs.rs", "NO", "architecture"),
    ("net/layers.rs", "RELU_GAIN", "architecture"),
    ("net/ops/norm.rs", "EPSILON", "numerics"),
    ("net/ops/pool.rs", "PADDING", "numerics"),
    ("net/refiner.rs", "SPREAD", "architecture"),
    ("placement/arms.rs", "LOOK_STEP_M", "grid"),
    ("placement/arms.rs", "TIME_STEP_M", "grid"),
    ("placement/cells.rs", "CELL_M", "table"),
    ("placement/cells.rs", "MAX_CELLS", "bound"),
    ("placement/context.rs", "GAPS", "table"),
    ("placement/following.rs", "SPEED_STEP_M", "grid"),
    ("placement/learn.rs", "SEEN_M", "training"),
    ("placement/model.rs", "SPEED_STEP", "table"),
    ("placement/request.rs", "MAX_PER_LANE_KM", "range"),
    ("placement/request.rs", "MAX_GAP_M", "range"),
    ("placement/request.rs", "MAX_PER_HOUR", "range"),
    ("placement/request.rs", "MAX_PARKED_PER_100M", "range"),
    ("placement/request.rs", "MAX_SPEED_MPS", "range"),
    ("placement/room.rs", "STEP_M", "grid"),
    ("placement/speeds.rs", "ROUNDING_MPS", "rounding"),
    ("planning/around.rs", "SPACING_M", "grid"),
    ("planning/coordinates.rs", "INSTANT_S", "format"),
    ("planning/coordinates.rs", "STAYS_WITHIN_M", "format"),
    ("planning/coordinates.rs", "ALONG_SCALE", "format"),
    ("planning/coordinates.rs", "ACROSS_SCALE", "format"),
    ("planning/crossing.rs", "LOOK_M", "grid"),
    ("planning/crossing.rs", "SPACING_M", "grid"),
    ("planning/legal.rs", "STEP_M", "grid"),
    ("planning/pullback.rs", "LONGEST", "training"),
    ("planning/smooth.rs", "LENGTH_S", "training"),
];

/// Folders whose numbers were fixed during training: the weights fit no other numbers.
pub const OF_FOLDERS: &[(&str, &str)] = &[
    ("features/", "scales and reaches of the inputs, part of the format of the weights"),
    ("net/", "architecture and initialisation"),
];

/// Other numbers outside `experts::tuning`: file, literal, and the reason in a word.
pub const LITERALS: &[(&str, &str, &str)] = &[
    ("clock.rs", "1e3", "unit"),
    ("sentences.rs", "3.6", "unit"),
    ("planning/coordinates.rs", "6.0", "polynomial"),
    ("planning/crossing.rs", "0.05", "divisor"),
    ("planning/legal.rs", "400.0", "grid"),
    ("planning/profile.rs", "0.1", "divisor"),
    ("planning/profile.rs", "4.0", "polynomial"),
    ("planning/profile.rs", "30.0", "bracket"),
    ("planning/to_goal.rs", "1.5", "kinematics"),
    ("generator/mod.rs", "5.0", "sample"),
    ("generator/mod.rs", "6.0", "sample"),
    ("generator/subgoal.rs", "30.0", "bracket"),
    ("generator/trajectory.rs", "0.1", "divisor"),
    ("generator/variations.rs", "3.0", "polynomial"),
    ("generator/others/blocks.rs", "5.0", "angle"),
    ("run/contacts.rs", "1e3", "rounding"),
    ("run/snapshot.rs", "1e5", "range"),
    ("run/state.rs", "1e3", "unit"),
    ("run/stepping.rs", "1e3", "unit"),
    ("placement/arms.rs", "2_000.0", "grid"),
    ("placement/arms.rs", "0.01", "rounding"),
    ("placement/arrivals.rs", "3600.0", "unit"),
    ("placement/arrivals.rs", "1e3", "rounding"),
    ("placement/arrivals.rs", "1e4", "rounding"),
    ("placement/cells.rs", "1000.0", "unit"),
    ("placement/cells/build.rs", "0.01", "rounding"),
    ("placement/cells/build.rs", "6.0", "bound"),
    ("placement/cells/build.rs", "20.0", "bound"),
    ("placement/checks.rs", "3.0", "angle"),
    ("placement/driving.rs", "0.1", "divisor"),
    ("placement/following.rs", "0.1", "divisor"),
    ("placement/learn.rs", "1.5", "bound"),
    ("placement/model.rs", "0.2", "range"),
    ("placement/model.rs", "4.0", "range"),
    ("placement/model.rs", "25.0", "range"),
    ("placement/parking.rs", "100.0", "unit"),
    ("placement/parking.rs", "1e3", "rounding"),
    ("placement/parking.rs", "1e4", "rounding"),
    ("placement/place.rs", "20.0", "bound"),
    ("placement/place.rs", "1e3", "rounding"),
    ("placement/place.rs", "1e4", "rounding"),
    ("placement/placed.rs", "1e3", "rounding"),
    ("placement/pose.rs", "0.1", "divisor"),
    ("placement/request.rs", "1e6", "bound"),
    ("placement/room.rs", "0.1", "numerics"),
    ("placement/speeds.rs", "1e3", "rounding"),
];

/// Names of the floating-point constants in a text, without the tests at its end.
pub fn float_constants(text: &str) -> Vec<&str> {
    let code = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let declared = code.split("const ").skip(1).filter_map(|rest| rest.split_once(" ="));
    let floats = declared.filter_map(|(head, _)| head.split_once(": ")).filter(|(name, of)| {
        let named = name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
        named && !of.contains(['>', '{']) && (of.contains("f64") || of.contains("f32"))
    });
    floats.map(|(name, _)| name).collect()
}

/// Floating-point literals in a text other than 0, 0.5, 1, 2 and small powers of ten, which are tolerances.
/// Comments, the values of [`float_constants`], and tests at the end are left out.
pub fn float_literals(text: &str) -> Vec<String> {
    let code = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap_or(text);
    let mut code: String = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .fold(String::with_capacity(code.len()), |all, line| {
            all + line.split(" // ").next().unwrap_or(line) + "\n"
        });
    for name in float_constants(text) {
        let Some(at) = code.find(&format!("const {name}: ")) else { continue };
        let Some(value) = code[at..].find(" =").map(|i| at + i) else { continue };
        let end = code[value..].find(';').map_or(code.len(), |i| value + i);
        code.replace_range(at..end, "");
    }
    // Every other piece between quotation marks is a string.
    code.split('"').step_by(2).flat_map(floats).collect()
}

/// Floating-point numbers in code that need a reason, as they are written but without their type.
fn floats(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    let (mut rest, mut before) = (code, "");
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let head = if at == 0 { before } else { &rest[..at] };
        // A digit of a name or of a tuple field.
        let inside = head.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_')
            || (head.ends_with('.') && !head.ends_with(".."));
        let number = number(&rest[at..]);
        let typed = ["f64", "f32"].iter().any(|of| rest[at + number.len()..].starts_with(of));
        if !inside && (typed || number.contains(['.', 'e'])) && !is_plain(number) {
            found.push(number.to_owned());
        }
        before = number;
        rest = &rest[at + number.len()..];
    }
    found
}

/// The number at the beginning of a text.
fn number(text: &str) -> &str {
    let digits = |from: usize| {
        text[from..]
            .find(|c: char| !c.is_ascii_digit() && c != '_')
            .map_or(text.len(), |length| from + length)
    };
    let is_digit = |at: usize| text.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
    let mut end = digits(0);
    if text[end..].starts_with('.') && is_digit(end + 1) {
        end = digits(end + 1);
    }
    for mark in ["e", "e-"] {
        if text[end..].starts_with(mark) && is_digit(end + mark.len()) {
            return &text[..digits(end + mark.len())];
        }
    }
    &text[..end]
}

/// Whether a number needs no reason: simple factors, and powers of ten that are tolerances.
fn is_plain(number: &str) -> bool {
    let value: f64 = number.replace('_', "").parse().unwrap_or(f64::NAN);
    [0.0, 0.5, 1.0, 2.0].contains(&value) || number.starts_with("1e-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_found_by_name_and_literals_outside_them() {
        let text = "const A: f64 = 1.5;\nconst B: [f32; 2] = [0.0; 2];\nconst C: usize = 1;\n";
        assert_eq!(float_constants(text), ["A", "B"]);
        let text = "const A: f64 = 1.5;\n// 7.5\nlet x = a.0 + 0.3 * y.max(4.0); // 9.5\nlet z = -20f64.sin() + 1e3 - 1e-9;\n";
        assert_eq!(float_literals(text), ["0.3", "4.0", "20", "1e3"]);
        assert_eq!(float_literals("5.0.max(x1.0) + (0.8..END_S) + 0..7 + [0.25; 3]"), ["5.0", "0.8", "0.25"]);
        assert_eq!(
            float_literals("(0.2..=25.0, \"8.5\", v2.5, 1_000.0, 1..7, 2.0)"),
            ["0.2", "25.0", "1_000.0"]
        );
        assert!(float_literals("a();\n#[cfg(test)]\nmod tests {\n    let x = 3.5;\n}\n").is_empty());
    }
}
