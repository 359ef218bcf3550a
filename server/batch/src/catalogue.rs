//! The catalogue of a batch's inputs: the scenes by content hash, and the road users of each situation.

use serde::{Deserialize, Serialize};

/// One scene, or an input that could not be read.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CatalogueScene {
    /// Name in the results: the file's name without extensions, or the scene's own name in a file of many.
    pub name: String,
    /// SHA-256 of its document, or of the unreadable file, 64 hex digits.
    pub sha256: String,
    /// Why the input is not a scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub problem: Option<UnitProblem>,
    /// For each situation, the road users that get its conditions, or the places of its pattern; null for a
    /// situation that names none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub actors: Vec<Option<Vec<String>>>,
}

/// Why a unit has no result.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct UnitProblem {
    /// Machine-readable code, one of the codes of the API.
    pub code: String,
    /// One sentence.
    pub detail: String,
}
