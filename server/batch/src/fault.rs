//! What is wrong with a plan, and where.

use crate::names::hint;
use api::Problem;
use formats::ReadError;
use formats::native;
use serde::de::DeserializeOwned;
use std::fmt;

/// One fault of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanFault {
    /// The member, as TOML names it: `situations[0].goal.speed_mps`; empty for the whole plan.
    pub path: String,
    /// Value found and value expected, with a hint where the name is a slip.
    pub detail: String,
}

impl PlanFault {
    /// About one member.
    pub fn new(path: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { path: path.into(), detail: detail.into() }
    }

    /// Of a document that was not of the wanted shape.
    pub(crate) fn of_read(error: ReadError) -> Vec<Self> {
        let fault = |pointer: &str, detail: &str| Self::new(dotted(pointer), hinted(detail));
        error.problems.iter().map(|problem| fault(&problem.pointer, &problem.detail)).collect()
    }

    /// Of a refusal of the operations, about a part of the plan.
    pub(crate) fn of_problem(under: &str, problem: &Problem) -> Vec<Self> {
        let errors = problem.members.errors.as_deref().unwrap_or_default();
        let under = |pointer: &str| format!("{under}.{}", dotted(pointer));
        errors.iter().map(|error| Self::new(under(&error.pointer), error.detail.clone())).collect()
    }
}

/// Reads a document in TOML.
///
/// # Errors
/// Its faults, each with its path; an unknown member has the name that was probably meant.
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

/// A JSON pointer as a path of TOML.
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

/// The message about an unknown member with the name that was meant, where one is close.
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
