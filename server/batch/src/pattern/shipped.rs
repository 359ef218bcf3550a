//! The built-in patterns.

use super::document::RoadPattern;
use crate::names::hint;
use std::sync::OnceLock;

macro_rules! files {
    ($($name:literal),* $(,)?) => { [$(include_str!(concat!("../../../../assets/patterns/", $name, ".toml"))),*] };
}

/// Their documents.
const FILES: [&str; 24] = files![
    "alks-cut-in",
    "alks-cut-out",
    "alks-deceleration",
    "cbda",
    "cbfa",
    "cbla",
    "cbna",
    "cbnao",
    "cbta",
    "cccscp",
    "ccfhol",
    "ccfhos",
    "ccftap",
    "ccrb",
    "ccrm",
    "ccrs",
    "cpfa",
    "cpla",
    "cpna",
    "cpnco",
    "cpta",
    "crosswalk-after-bend",
    "merge",
    "roundabout-entry",
];

/// All built-in patterns, sorted by name.
pub fn all() -> &'static [RoadPattern] {
    static ALL: OnceLock<Vec<RoadPattern>> = OnceLock::new();
    // The tests parse each of them.
    ALL.get_or_init(|| FILES.iter().filter_map(|text| RoadPattern::parse(text).ok()).collect())
}

/// The pattern with this name, ignoring case.
///
/// # Errors
/// An unknown name, with a suggestion.
pub fn named(name: &str) -> Result<&'static RoadPattern, String> {
    let found = all().iter().find(|pattern| pattern.name.eq_ignore_ascii_case(name));
    let names = || all().iter().map(|pattern| pattern.name.as_str());
    found.ok_or_else(|| {
        let all = names().collect::<Vec<_>>().join(", ");
        format!("\"{name}\" is no pattern{}; there are {all}", hint(name, names()))
    })
}

#[cfg(test)]
mod tests {
    use super::{FILES, all, named};
    use crate::pattern::document::RoadPattern;

    #[test]
    fn every_file_is_a_pattern_of_its_own() {
        for text in FILES {
            let read = RoadPattern::parse(text);
            assert!(read.is_ok(), "{read:?}: {text}");
        }
        let mut names: Vec<String> = all().iter().map(|of| of.name.to_ascii_lowercase()).collect();
        names.dedup();
        assert_eq!(names.len(), FILES.len());
        assert_eq!(named("ccrs").unwrap().name, "CCRs");
        assert!(named("CCRx").unwrap_err().contains("did you mean CCR"), "{:?}", named("CCRx"));
    }
}
