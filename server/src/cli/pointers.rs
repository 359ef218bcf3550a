//! Faults of a request in terms of the command line: flag and value instead of a JSON pointer.

use crate::cli::inputs::Source;
use crate::cli::{Failure, inputs};
use api::Problem;

/// Members of a request and their flags.
const FLAGS: [(&str, &str); 19] = [
    ("/horizon_s", "--horizon"),
    ("/replan_interval_s", "--replan-interval"),
    ("/start_s", "--start-time"),
    ("/samples", "--samples"),
    ("/modes", "--modes"),
    ("/steps", "--steps"),
    ("/diversity", "--diversity"),
    ("/seed", "--seed"),
    ("/agents", "--agents"),
    ("/react", "--react"),
    ("/pinned", "--pinned"),
    // Members of a placement.
    ("/min_gap_m", "--min-gap"),
    ("/density/count", "--count"),
    ("/density", "--density"),
    ("/types", "--types"),
    ("/region", "--region"),
    ("/keep", "--keep"),
    ("/speeds", "--speeds"),
    ("/arrivals", "--arrivals"),
];

/// The failure of a refused request; faults of the scene itself are attributed to the file.
pub fn refused(source: &Source, problem: &Problem) -> Failure {
    let Some(errors) = problem.members.errors.as_deref().filter(|errors| !errors.is_empty()) else {
        return inputs::refused(&source.path, problem);
    };
    let words: Option<Vec<String>> =
        errors.iter().map(|error| Some(format!("{}: {}", in_flags(&error.pointer)?, error.detail))).collect();
    match words {
        Some(words) => Failure::usage(words.join("\n  ")),
        None => inputs::refused(&source.path, problem),
    }
}

fn in_flags(pointer: &str) -> Option<String> {
    if let Some(rest) = pointer.strip_prefix("/conditions/") {
        return Some(of_conditions(rest));
    }
    if let Some(name) = pointer.strip_prefix("/types/") {
        return Some(format!("--types {}", unescaped(name)));
    }
    let flag = FLAGS.iter().find(|(member, _)| pointer.starts_with(member));
    flag.map(|(_, flag)| (*flag).to_owned())
}

/// An unescaped token of a pointer (RFC 6901).
fn unescaped(token: &str) -> String {
    token.replace("~1", "/").replace("~0", "~")
}

/// Converts a pointer such as `6/goal/speed_mps`.
fn of_conditions(rest: &str) -> String {
    let mut parts = rest.split('/');
    let id = unescaped(parts.next().unwrap_or_default());
    let path: Vec<&str> = parts.collect();
    let key = |name: &str| {
        let ends = ["_mps", "_rad", "_m", "_s"];
        ends.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name).to_owned()
    };
    match path.as_slice() {
        ["goal", "relation", "to"] => format!("--goal {id}: of"),
        ["goal", "relation", field] => format!("--goal {id}: {}", key_of_relation(field)),
        ["goal", field, ..] => format!("--goal {id}: {}", key(field)),
        ["start", field, ..] => format!("--start {id}: {}", key(field)),
        [name @ ("goal" | "start" | "via")] => format!("--{name} {id}"),
        [name @ ("length_m" | "width_m")] => format!("--size {id}: {}", key(name)),
        ["type"] => format!("--type {id}"),
        _ => format!("road user {id}"),
    }
}

/// A member of a relation as a key: `behind_s` is another key than `behind`.
fn key_of_relation(name: &str) -> &str {
    match name {
        "behind_m" => "behind",
        "after_s" => "after",
        "slower_mps" => "slower",
        "ahead_m" => "ahead",
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::in_flags;

    #[test]
    fn pointers_become_flags() {
        let flag = |pointer: &str| in_flags(pointer).unwrap();
        assert_eq!(flag("/conditions/6/goal/speed_mps"), "--goal 6: speed");
        assert_eq!(flag("/conditions/a~1b/start/x_m"), "--start a/b: x");
        assert_eq!(flag("/conditions/6/goal/relation/to"), "--goal 6: of");
        assert_eq!(flag("/conditions/6/goal/relation/behind_s"), "--goal 6: behind_s");
        assert_eq!(flag("/conditions/6/length_m"), "--size 6: length");
        assert_eq!(flag("/agents/0"), "--agents");
        assert_eq!(flag("/types/car"), "--types car");
        assert_eq!(flag("/density/count"), "--count");
        assert_eq!(in_flags("/scene/map"), None);
    }
}
