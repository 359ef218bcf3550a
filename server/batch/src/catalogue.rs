//! What the inputs of a batch hold: the scenes by their content, and whom each situation concerns.

use serde::{Deserialize, Serialize};

/// One scene, or an input that gave none.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CatalogueScene {
    /// Name in the results: the file's without its endings, or the scene's own in a file of many.
    pub name: String,
    /// SHA-256 of its document, or of the file that is none, 64 hex digits.
    pub sha256: String,
    /// Why it is no scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub problem: Option<UnitProblem>,
    /// For each situation the road users that get its conditions, or the places of its pattern; null for a situation that
    /// names none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub actors: Vec<Option<Vec<String>>>,
}

/// Why a unit has no result.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct UnitProblem {
    /// A word that programs can switch on, one of the codes of the API.
    pub code: String,
    /// One sentence.
    pub detail: String,
}
