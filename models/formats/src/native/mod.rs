//! Native scene JSON, version 1: the form that scenes are stored and sent in.
//!
//! The `*Doc` types are the document; other crates may embed them in their own requests. A document
//! becomes a [`Scene`] in one step, [`SceneDoc::into_scene`].

mod agent;
mod any;
mod conditions;
mod document;
mod document_read;
pub(crate) mod format;
mod generated;
mod json;
mod map;
mod map_domain;
mod relation;
mod resolve;
mod value;

pub use agent::{AgentDoc, TrackDoc};
pub use any::{AnyDoc, MAX_VALUES};
pub use conditions::{ConditionsDoc, GoalDoc, GoalFrame, GoalRelationDoc, StartDoc, VelocityDoc, ViaDoc};
pub use document::{FORMAT, MapForm, MetaDoc, OriginDoc, RunDoc, SceneDoc, SignalDoc, TimeDoc, VERSION};
pub use generated::{AgentFuturesDoc, FutureDoc, GeneratedDoc, SampleDoc};
pub use json::from_json;
pub use map::{
    AreaDoc, BoundaryDoc, DrivableDoc, LaneDoc, MapDoc, MapField, MapRef, NeighborDoc, RoadEdgeDoc,
    RoadLineDoc, StopSignDoc,
};
pub use resolve::{Context, MAX_COORDINATE_M, MAX_GOAL_DISTANCE_M, Ranges, Window, check_goal_time};
pub use value::{MAX_MEMBERS, MAX_SAFE_INTEGER, Members, PointDoc, PointsDoc, round_m, round_rad};

use crate::problem::{ReadError, RefusalKind};
use crate::source::Source;
use scene::Scene;
use serde::Deserialize;

/// Media type of the document.
pub const MEDIA_TYPE: &str = "application/vnd.dragtraffic.scene+json";

/// Reads a scene document whose map is inline.
///
/// # Errors
/// Every fault that a scene can have, by the codes of [`crate::problem::code`]; a map given by hash is `unknown-map`.
pub fn read(bytes: &[u8]) -> Result<Scene, ReadError> {
    read_doc(bytes)?.into_scene(|_| None)
}

/// Reads a scene document without converting it to a scene.
///
/// # Errors
/// `malformed-json`, `invalid-field`, or `unsupported-version` when members are unknown because the document
/// is of a later version.
pub fn read_doc(bytes: &[u8]) -> Result<SceneDoc, ReadError> {
    from_json::<SceneDoc>(bytes).map_err(|error| of_version(error, || serde_json::from_slice(bytes).ok()))
}

/// As [`read`], for a document that may be too long to be in memory beside its scene.
///
/// # Errors
/// Those of [`read`], and `malformed-file` when it cannot be read.
pub fn read_from(file: &dyn Source) -> Result<Scene, ReadError> {
    let doc = match json::Text::of(file)? {
        json::Text::Whole(bytes) => read_doc(&bytes),
        json::Text::Long(text) => text
            .parse::<SceneDoc>()
            .map_err(|error| of_version(error, || serde_json::from_reader(text.open().ok()?).ok())),
    };
    doc?.into_scene(|_| None)
}

#[derive(Deserialize)]
struct VersionHead {
    version: u64,
}

/// If a document with unknown members is of a later version, refuses the version instead.
fn of_version(error: ReadError, head: impl FnOnce() -> Option<VersionHead>) -> ReadError {
    if error.kind != RefusalKind::Invalid {
        return error;
    }
    head().and_then(|head| document::check_version(head.version).err()).unwrap_or(error)
}

/// Writes a scene document with its map inline. Equal scenes give equal bytes.
pub fn write(scene: &Scene) -> Vec<u8> {
    write_doc(&SceneDoc::from_scene(scene, MapForm::Inline))
}

/// Writes a document. Equal documents give equal bytes.
pub fn write_doc(doc: &SceneDoc) -> Vec<u8> {
    // Documents have string keys and plain values; serde_json never fails on those.
    serde_json::to_vec(doc).unwrap_or_default()
}

/// JSON Schema (2020-12) of the document. It covers types, ranges of numbers and member names; the reader
/// checks the uniqueness of ids, equal column lengths and the like.
pub fn schema() -> schemars::Schema {
    let mut generator = schemars::generate::SchemaSettings::draft2020_12().into_generator();
    generator.root_schema_for::<SceneDoc>()
}
