//! Scenes from all sources: saved by the user, shipped as demos, or in the data folder; and maps by content
//! hash.

use super::length;
use super::library::Library;
use super::record;
use super::store::{Expect, PackedScene, SceneRecord, Store, StoreError, StoredText, Viewer, Written};
use super::weight;
use api::home::not_found;
use api::{Code, Home, Opened, Problem};
use base::cache::Cache;
use base::id;
use base::limits::Limits;
use base::memory::Memory;
use base::party::Party;
use formats::native::{self, MapDoc, MapField, MapForm, SceneDoc};
use scene::{ContentHash, LaneMap, Scene, Shared};
use std::sync::{Arc, Weak};
use work::Pool;

/// Prefix of a held scene's name, which came with a request; ids of saved scenes have no colon.
const HELD: &str = "held:";

/// All scenes and maps that the server knows. Cheap to clone.
#[derive(Clone)]
pub struct Catalog {
    /// Saved scenes.
    pub store: Store,
    /// Read-only scenes.
    pub library: Library,
    maps: Arc<Cache<ContentHash, Shared<LaneMap>>>,
    open: Arc<Cache<String, Opened>>,
    pool: Arc<Pool>,
    /// Party to which cached scenes are charged.
    party: Party,
}

impl Catalog {
    /// A catalog over a store and a library, with a cache of maps and saved scenes up to these limits.
    pub fn new(
        store: Store,
        library: Library,
        pool: Arc<Pool>,
        limits: &Limits,
        memory: &Arc<Memory>,
    ) -> Self {
        let maps = Arc::new(Cache::new(memory.part(limits.cached_map_bytes)));
        let open = Arc::new(Cache::new(memory.part(limits.cached_scene_bytes)));
        // A map can be read again, a held scene cannot.
        let lent: Weak<Cache<ContentHash, Shared<LaneMap>>> = Arc::downgrade(&maps);
        memory.lend(lent);
        let lent: Weak<Cache<String, Opened>> = Arc::downgrade(&open);
        memory.lend(lent);
        Self { store: store.within(memory), library, maps, open, pool, party: Party::default() }
    }

    /// The same for a caller: it sees only its scenes, and its cached scenes are charged to it.
    pub fn of(&self, party: Party, viewer: Viewer) -> Self {
        Self { party, store: self.store.of(viewer), ..self.clone() }
    }

    /// The map with a hash, from any source.
    ///
    /// # Errors
    /// When it cannot be read.
    pub async fn map(&self, hash: ContentHash) -> Result<Option<Shared<LaneMap>>, Problem> {
        if let Some(map) = self.maps.get(&hash) {
            return Ok(Some(map));
        }
        let map = match self.store.map(&hash.hex()).await? {
            Some(text) => Some(self.pool.document(text.json.len(), move || parse_map(&text.json)).await?),
            None => self.library.map(&hash).await?,
        };
        if let Some(map) = &map {
            self.maps.put(hash, map.clone(), weight::of_map(map), self.party);
        }
        Ok(map)
    }

    /// A scene with all its members, as it is saved or in the library.
    ///
    /// # Errors
    /// `not-found`, or when it cannot be read.
    pub async fn whole(&self, id: &str) -> Result<Arc<Scene>, Problem> {
        match self.library.open(id).await? {
            Some(opened) => Ok(opened.scene),
            None => Ok(Arc::new(self.saved(id).await?.0)),
        }
    }

    /// A saved scene and its ETag.
    async fn saved(&self, id: &str) -> Result<(Scene, String), Problem> {
        let (summary, text) = self.store.get(id).await?.ok_or_else(not_found)?;
        let doc = self.parsed(text).await?;
        Ok((self.read(doc).await?, summary.etag))
    }

    /// The document of a stored scene.
    ///
    /// # Errors
    /// A full queue, or a broken text.
    pub async fn parsed(&self, text: StoredText) -> Result<SceneDoc, Problem> {
        let length = text.json.len();
        let parse = move || Ok(native::read_doc(&text.json)?);
        self.pool.document(length, parse).await
    }

    /// JSON of an open scene.
    ///
    /// # Errors
    /// A full queue, or a defect.
    pub async fn written(&self, scene: Arc<Scene>, form: MapForm) -> Result<Vec<u8>, Problem> {
        let bytes = length::of_scene(&scene);
        self.pool.document(bytes, move || Ok(native::write_doc(&SceneDoc::from_scene(&scene, form)))).await
    }

    /// JSON of a saved scene with the reference replaced by its map.
    ///
    /// # Errors
    /// When the map is missing or the stored text is broken.
    pub async fn with_map(&self, scene: StoredText, map_sha: &str) -> Result<StoredText, Problem> {
        let map = self.store.map(map_sha).await?;
        let map = map.ok_or_else(|| Problem::internal("a stored scene's map is missing"))?;
        let bytes = scene.json.len() + map.json.len();
        let join = move || {
            let mut room = scene.room;
            if !room.grow(bytes) {
                return Err(StoreError::NoMemory.into());
            }
            let json = record::with_map(&scene.json, &map.json)?;
            room.shrink(scene.json.len());
            Ok(StoredText { json, room })
        };
        self.pool.document(bytes, join).await
    }

    /// Saves a scene under an id.
    ///
    /// # Errors
    /// When the store is full or the precondition does not hold.
    pub async fn save(&self, id: &str, expect: Expect, scene: Scene) -> Result<Written, Problem> {
        let (key, bytes) = (id.to_owned(), length::of_scene(&scene));
        let packed = self.pool.document(bytes, move || record::of_scene(scene, &key)?.packed()).await?;
        self.put(id, expect, packed).await
    }

    /// Saves a prepared row.
    ///
    /// # Errors
    /// As [`Self::save`].
    pub async fn save_record(
        &self,
        id: &str,
        expect: Expect,
        record: SceneRecord,
    ) -> Result<Written, Problem> {
        let bytes = record.json.len();
        let packed = self.pool.document(bytes, move || record.packed()).await?;
        self.put(id, expect, packed).await
    }

    async fn put(&self, id: &str, expect: Expect, packed: PackedScene) -> Result<Written, Problem> {
        let written = self.store.put(id, expect, packed).await?;
        self.open.forget(&id.to_owned());
        Ok(written)
    }

    /// Deletes a saved scene.
    ///
    /// # Errors
    /// When there is none, or the precondition does not hold.
    pub async fn delete(&self, id: &str, expect: Expect) -> Result<(), Problem> {
        self.store.delete(id, expect).await?;
        self.open.forget(&id.to_owned());
        Ok(())
    }
}

/// Maps given inline are cached; the pool parses documents. If held scenes exceed the cache, the least
/// recently used ones are dropped.
impl Home for Catalog {
    async fn read(&self, doc: SceneDoc) -> Result<Scene, Problem> {
        let wanted = match &doc.map {
            MapField::Ref(reference) => {
                reference.hash.strip_prefix("sha256:").and_then(ContentHash::from_hex)
            }
            MapField::Inline(_) => None,
        };
        let known = match wanted {
            Some(hash) => self.map(hash).await?,
            None => None,
        };
        let (bytes, maps, party) = (length::of_doc(&doc), Arc::clone(&self.maps), self.party);
        let read = move || {
            let inline = matches!(doc.map, MapField::Inline(_));
            let scene = doc.into_scene(|_| known)?;
            if inline {
                maps.put(scene.map.hash(), scene.map.clone(), weight::of_map(&scene.map), party);
            }
            Ok(scene)
        };
        self.pool.document(bytes, read).await
    }

    async fn open(&self, id: &str) -> Result<Opened, Problem> {
        if id.starts_with(HELD) {
            let forgotten = || Problem::new(Code::NotFound, "No scene is held under this name any more.");
            return self.open.get(&id.to_owned()).ok_or_else(forgotten);
        }
        if let Some(opened) = self.library.open(id).await? {
            return Ok(opened);
        }
        let key = id.to_owned();
        if let Some(known) = self.open.get(&key) {
            // Another program may have written to the file, so only the store knows the current version.
            if self.store.etag(id).await?.as_deref() == Some(known.etag.as_str()) {
                return Ok(known);
            }
            self.open.forget(&key);
        }
        let (mut scene, etag) = self.saved(id).await?;
        // No answer depends on these members, and they may be long.
        scene.extra.clear();
        let opened = Opened::new(scene, etag);
        self.open.put(key, opened.clone(), weight::of_open(&opened.scene), self.party);
        Ok(opened)
    }

    fn hold(&self, scene: Scene) -> (Option<String>, Opened) {
        let name = format!("{HELD}{}", id::fresh());
        let opened = Opened::new(scene, String::new());
        self.open.put(name.clone(), opened.clone(), weight::of_open(&opened.scene), self.party);
        (Some(name), opened)
    }
}

fn parse_map(json: &[u8]) -> Result<Shared<LaneMap>, Problem> {
    let doc: MapDoc = native::from_json(json)?;
    Ok(doc.into_map()?.into())
}
