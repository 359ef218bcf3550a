//! Facts about a scene without its content.

use super::store::{SceneShare, SceneSummary};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A scene in a list.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SceneItem {
    /// Id of the scene.
    pub id: String,
    /// Display name.
    pub name: String,
    /// With quotes, as in the ETag header.
    pub etag: String,
    /// RFC 3339.
    pub created_at: String,
    /// RFC 3339.
    pub updated_at: String,
    /// Road users by type, and steps.
    #[serde(flatten)]
    pub facts: Facts,
    /// Content hash of the map, 64 hex digits.
    pub map_sha256: String,
    /// Search terms.
    pub tags: Vec<String>,
    /// Scene of which it is a variant.
    pub parent_id: Option<String>,
    /// Size in the store, bytes.
    pub bytes: u64,
    /// Whether it is read-only, as demo scenes and those of the data folder are; duplicate one to change it.
    pub readonly: bool,
    /// Owner of the scene, on a server whose scenes have owners.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub owner: Option<String>,
    /// Rights of other users on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shared: Option<SceneShare>,
}

/// Road users by type.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Counts {
    pub vehicle: usize,
    pub pedestrian: usize,
    pub cyclist: usize,
    pub other: usize,
}

/// Facts about a scene's content in lists.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct Facts {
    /// Road users by type.
    pub counts: Counts,
    /// Number of steps of 0.1 s.
    pub steps: usize,
    /// Source: format or tool.
    pub source: String,
    /// Id in the source.
    pub source_id: Option<String>,
    /// Licence of the content.
    pub licence: Option<String>,
    /// Whether it has generated futures.
    pub generated: bool,
}

impl Facts {
    /// Facts about a scene.
    pub fn of(scene: &Scene) -> Self {
        let [vehicle, pedestrian, cyclist, other] = scene.counts();
        Self {
            counts: Counts { vehicle, pedestrian, cyclist, other },
            steps: scene.time.steps,
            source: scene.meta.source.clone(),
            source_id: scene.meta.source_id.clone(),
            licence: scene.meta.licence.clone(),
            generated: scene.generated.is_some(),
        }
    }
}

/// Tags of a stored scene.
pub fn tags_of(row: &SceneSummary) -> Vec<String> {
    serde_json::from_str(&row.tags).unwrap_or_default()
}

impl From<SceneSummary> for SceneItem {
    fn from(row: SceneSummary) -> Self {
        Self {
            facts: serde_json::from_str(&row.meta).unwrap_or_default(),
            tags: tags_of(&row),
            id: row.id,
            name: row.name,
            etag: row.etag,
            created_at: row.created_at,
            updated_at: row.updated_at,
            map_sha256: row.map_sha,
            parent_id: row.parent_id,
            bytes: row.bytes,
            readonly: false,
            shared: row.ownership.owner.is_some().then_some(row.ownership.shared),
            owner: row.ownership.owner,
        }
    }
}
