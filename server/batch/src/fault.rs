//! Faults of a plan, with their places.

use crate::names::hint;
use api::Problem;
use formats::ReadError;
use formats::native;
use serde::de::DeserializeOwned;
use std::fmt;

/// One fault of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanFault {
    /// Path of the member in TOML: `situations[0].goal.speed_mps`; empty for the whole plan.
    pub path: String,
    /// Value found and value expected, with a hint if the name is probably a typo.
    pub detail: String,
}

impl PlanFault {
    /// A fault of one member.
    pub fn new(path: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { path: path.into(), detail: detail.into() }
    }

    /// The faults of a document with another structure.
    pub(crate) fn of_read(error: ReadError) -> Vec<Self> {
        let fault = |pointer: &str, detail: &str| Self::new(dotted(pointer), hinted(detail));
        error.problems.iter().map(|problem| fault(&problem.pointer, &problem.detail)).collect()
    }

    /// The faults of a refused operation, for a part of the plan.
    pub(crate) fn of_problem(under: &str, problem: &Problem) -> Vec<Self> {
        let errors = problem.members.errors.as_deref().unwrap_or_default();
        let under = |pointer: &str| format!("{under}.{}", dotted(pointer));
        errors.iter().map(|error| Self::new(under(&error.pointer), error.detail.clone())).collect()
    }
}

/// Reads a document in TOML.
///
/// # Errors
/// Its faults, each with its path; an unknown member has a suggestion.
pub(crate) fn document<T: DeserializeOwned>(text: &str) -> Result<T, Vec<PlanFault>> {
    let whole = |detail: String| vec![PlanFault::new("", detail)];
    let table: toml::Table = text.parse().map_err(|error: toml::de::Error| whole(error.to_string()))?;
    let json = serde_json::to_vec(&table).map_err(|error| whole(error.to_string()))?;
    native::from_json(&json).map_err(PlanFault::of_read)
}

impl fmt::Display for PlanFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { path, detail } = self;
        if path.is_empty() { f.write_str(detail) } else { write!(f, "{path}: {detail}") }
    }
}

/// Converts a JSON pointer to a TOML path.
fn dotted(pointer: &str) -> String {
    pointer.split('/').skip(1).fold(String::new(), |path, token| {
        let token = token.replace("~1", "/").replace("~0", "~");
        match token.parse::<usize>() {
            Ok(index) => format!("{path}[{index}]"),
            Err(_) if path.is_empty() => token,
            Err(_) => format!("{path}.{token}"),
        }
    })
}

/// The message about an unknown member, with a suggestion if a known name is close.
fn hinted(detail: &str) -> String {
    let mut names = detail.split('`').skip(1).step_by(2);
    let (true, Some(found)) = (detail.starts_with("unknown "), names.next()) else {
        return detail.to_owned();
    };
    format!("{detail}{}", hint(found, names))
}

#[cfg(test)]
mod tests {
    use super::{dotted, hinted};

    #[test]
    fn pointers_become_paths_of_toml() {
        assert_eq!(dotted("/situations/0/goal/speed_mps"), "situations[0].goal.speed_mps");
        assert_eq!(dotted(""), "");
    }

    #[test]
    fn a_slip_is_named() {
        let detail = "unknown field `seed`, expected one of `scenes`, `seeds`";
        assert_eq!(hinted(detail), format!("{detail} (did you mean seeds?)"));
        assert_eq!(hinted("unknown field `x`, expected `scenes`"), "unknown field `x`, expected `scenes`");
    }
}
