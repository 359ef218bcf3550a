//! Scenes wherever they are: saved by the user, shipped as demos, or in the data folder; and maps by
//! content hash.

use crate::app::App;
use crate::base::problem::{Code, Problem};
use crate::http::body::blocking;
use crate::scenes::store::{MapRecord, SceneRecord, SceneSummary};
use formats::native::{self, MapDoc, MapField, MapForm, SceneDoc};
use scene::{ContentHash, LaneMap, Scene};
use serde::Serialize;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// A scene as lists show it.
#[derive(Clone, Debug, Serialize, schemars::JsonSchema)]
#[schemars(rename = "SceneItem")]
pub struct Item {
    /// Id of the scene.
    pub id: String,
    /// For people.
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
    /// Words to find it by.
    pub tags: Vec<String>,
    /// Scene it is a variant of.
    pub parent_id: Option<String>,
    /// Size as stored.
    pub bytes: u64,
    /// Demo scenes and those of the data folder; duplicate one to change it.
    pub readonly: bool,
}

/// Road users by type.
#[derive(Clone, Copy, Debug, Default, Serialize, serde::Deserialize, schemars::JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Counts {
    pub vehicle: usize,
    pub pedestrian: usize,
    pub cyclist: usize,
    pub other: usize,
}

/// What lists say about a scene's content.
#[derive(Clone, Debug, Default, Serialize, serde::Deserialize, schemars::JsonSchema)]
pub struct Facts {
    /// Road users by type.
    pub counts: Counts,
    /// Steps of 0.1 s.
    pub steps: usize,
    /// Format or tool it came from.
    pub source: String,
    /// Id in the source.
    pub source_id: Option<String>,
    /// Licence of the content.
    pub licence: Option<String>,
    /// Has generated futures.
    pub generated: bool,
}

impl Facts {
    /// Of a scene.
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

impl From<SceneSummary> for Item {
    fn from(row: SceneSummary) -> Self {
        Self {
            facts: serde_json::from_str(&row.meta).unwrap_or_default(),
            tags: serde_json::from_str(&row.tags).unwrap_or_default(),
            id: row.id,
            name: row.name,
            etag: row.etag,
            created_at: row.created_at,
            updated_at: row.updated_at,
            map_sha256: row.map_sha,
            parent_id: row.parent_id,
            bytes: row.bytes,
            readonly: false,
        }
    }
}

/// Maps in memory, the longest unused dropped first.
#[derive(Debug)]
pub struct MapCache {
    most: usize,
    kept: Mutex<VecDeque<(ContentHash, Arc<LaneMap>)>>,
}

impl MapCache {
    /// An empty cache of so many maps.
    pub fn new(most: usize) -> Self {
        Self { most: most.max(1), kept: Mutex::default() }
    }

    fn get(&self, hash: &ContentHash) -> Option<Arc<LaneMap>> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let at = kept.iter().position(|(key, _)| key == hash)?;
        let entry = kept.remove(at)?;
        let map = Arc::clone(&entry.1);
        kept.push_back(entry);
        Some(map)
    }

    fn put(&self, hash: ContentHash, map: &Arc<LaneMap>) {
        if self.get(&hash).is_some() {
            return;
        }
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() >= self.most {
            kept.pop_front();
        }
        kept.push_back((hash, Arc::clone(map)));
    }
}

/// The map of a hash, wherever it is.
pub async fn map(app: &App, hash: ContentHash) -> Result<Option<Arc<LaneMap>>, Problem> {
    if let Some(map) = app.maps.get(&hash) {
        return Ok(Some(map));
    }
    let map = match app.store.map(&hash.hex()).await? {
        Some(json) => Some(blocking(move || parse_map(&json)).await?),
        None => app.library.map(&hash).await?,
    };
    if let Some(map) = &map {
        app.maps.put(hash, map);
    }
    Ok(map)
}

fn parse_map(json: &[u8]) -> Result<Arc<LaneMap>, Problem> {
    let doc: MapDoc = native::from_json(json)?;
    Ok(Arc::new(doc.into_map()?))
}

/// A document's scene, its map looked up when given by hash and remembered when given inline.
pub async fn scene_of(app: &App, doc: SceneDoc) -> Result<Scene, Problem> {
    let wanted = match &doc.map {
        MapField::Ref(reference) => reference.hash.strip_prefix("sha256:").and_then(ContentHash::from_hex),
        MapField::Inline(_) => None,
    };
    let known = match wanted {
        Some(hash) => map(app, hash).await?,
        None => None,
    };
    let app = app.clone();
    blocking(move || {
        let inline = matches!(doc.map, MapField::Inline(_));
        let scene = doc.into_scene(|_| known)?;
        if inline {
            app.maps.put(scene.map.hash(), &scene.map);
        }
        Ok(scene)
    })
    .await
}

/// A scene that is open, with its ETag.
#[derive(Clone)]
pub struct Opened {
    /// The scene, with its id.
    pub scene: Arc<Scene>,
    /// With quotes.
    pub etag: String,
}

/// Opens a scene by id.
///
/// # Errors
/// `not-found`.
pub async fn open(app: &App, id: &str) -> Result<Opened, Problem> {
    if let Some(opened) = app.library.open(id).await? {
        return Ok(opened);
    }
    let (summary, json) = app.store.get(id).await?.ok_or_else(not_found)?;
    let doc = blocking(move || Ok(native::read_doc(&json)?)).await?;
    let scene = Arc::new(scene_of(app, doc).await?);
    Ok(Opened { scene, etag: summary.etag })
}

/// Nothing has this id.
pub fn not_found() -> Problem {
    Problem::new(Code::NotFound, "No scene has this id.")
}

/// The row that keeps a scene under an id. Marks its futures stale when they answer another scene.
pub fn record(mut scene: Scene, id: &str) -> SceneRecord {
    let input = scene.input_hash().hex();
    if let Some(generated) = &mut scene.generated {
        generated.stale = generated.input_sha256 != input;
    }
    scene.meta.created_with.get_or_insert_with(|| env!("CARGO_PKG_VERSION").to_owned());
    scene.id = Some(id.to_owned());
    let doc = SceneDoc::from_scene(&scene, MapForm::Ref);
    let (polylines, points) = size(&scene.map);
    SceneRecord {
        name: scene.name.clone(),
        tags: scene.meta.tags.clone(),
        parent_id: scene.meta.parent_id.clone(),
        meta: serde_json::to_string(&Facts::of(&scene)).unwrap_or_default(),
        json: native::write_doc(&doc),
        map: MapRecord { sha: scene.map.hash().hex(), polylines, points, json: Some(map_json(&scene.map)) },
    }
}

/// Native JSON of a map.
pub fn map_json(map: &LaneMap) -> Vec<u8> {
    serde_json::to_vec(&MapDoc::from_map(map)).unwrap_or_default()
}

/// Lines (with areas) and points of a map.
pub fn size(map: &LaneMap) -> (usize, usize) {
    let lines = map.road_lines.iter().chain(&map.road_edges).map(|l| l.points.xy.len());
    let areas = [&map.crosswalks, &map.speed_bumps, &map.driveways, &map.drivable];
    let areas = areas.into_iter().flatten().map(|a| a.polygon.xy.len());
    let counts = map.lanes.iter().map(|l| l.points.xy.len()).chain(lines).chain(areas);
    counts.fold((0, 0), |(lines, points), n| (lines + 1, points + n))
}

/// A stored document with its map put in place of the reference.
///
/// The reference is found as text: it is written by [`native::write_doc`] before any member that a
/// user can name, and quotes inside strings are escaped, so its first occurrence is the map member.
pub fn with_map(json: &[u8], sha: &str, map: &[u8]) -> Vec<u8> {
    let reference = format!("\"map\":{{\"ref\":\"sha256:{sha}\"}}");
    let at = json.windows(reference.len()).position(|window| window == reference.as_bytes());
    let Some((before, after)) = at.and_then(|at| Some((json.get(..at)?, json.get(at + reference.len()..)?)))
    else {
        return json.to_vec();
    };
    [before, b"\"map\":", map, after].concat()
}
