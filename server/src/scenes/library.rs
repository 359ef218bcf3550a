//! Read-only scenes: embedded demos, and files of the folder given with `--data`.
//!
//! Files are read in the background for the list: at the start, and when they change. A scene is parsed again when it
//! is opened, and a few stay in memory.

use super::demos;
use super::folder::FolderReader;
use super::item::{Facts, SceneItem};
use super::weight;
use api::import::{Companions, SceneFile};
use api::{Code, Opened, Problem};
use base::cache::Cache;
use base::clock;
use base::folder::{DataFolder, FileStamp, HeldFile};
use base::id;
use base::memory::{self, Memory};
use base::netconvert::companions;
use base::party::Party;
use formats::table;
use scene::{ContentHash, LaneMap, Scene, Shared};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock, Weak};
use std::time::{Duration, Instant, SystemTime};
use work::Pool;

/// Limit of files from the data folder.
const MOST_FILES: usize = 5_000;
/// Shortest time between two looks at the data folder.
const LOOK_EVERY: Duration = Duration::from_secs(2);
/// The time between two looks is at least this multiple of the duration of a look.
const REST: u32 = 50;

#[derive(Clone, Debug)]
enum ScenePlace {
    /// Id of a demo.
    Demo(String),
    /// Name of a file of the data folder, and the index of the scene in it.
    File(PathBuf, usize),
}

#[derive(Clone, Debug)]
struct Entry {
    item: SceneItem,
    place: ScenePlace,
}

/// Facts about a scene's file, for lists.
struct FileFacts {
    etag: String,
    /// Bytes of the file and of those that are read with it.
    bytes: u64,
    modified: SystemTime,
}

struct LibraryState {
    entries: RwLock<BTreeMap<String, Entry>>,
    open: Arc<Cache<String, Opened>>,
    pool: Arc<Pool>,
    folder: Option<FolderReader>,
    /// Memory of all requests, from which files are read.
    memory: Arc<Memory>,
}

/// A file of the data folder as the library last saw it.
struct SeenFile {
    /// Its stamp, and those of the files that are read with it.
    stamps: Vec<Option<FileStamp>>,
    /// Whether its scenes are listed, if it has any.
    is_read: bool,
}

/// All read-only scenes. Cheap to clone.
#[derive(Clone)]
pub struct Library(Arc<LibraryState>);

impl Library {
    /// Starts with the demos; the folder's files follow as they are read. Opened scenes are cached in up to `cached`
    /// bytes of this memory.
    ///
    /// # Errors
    /// When the folder cannot be opened, or a thread cannot be started.
    pub fn start(
        folder: Option<&Path>,
        pool: Arc<Pool>,
        (memory, cached): (&Arc<Memory>, u64),
    ) -> io::Result<Self> {
        let reader = folder.map(FolderReader::start).transpose()?;
        let (entries, open) = (RwLock::default(), Arc::new(Cache::new(memory.part(cached))));
        let lent: Weak<Cache<String, Opened>> = Arc::downgrade(&open);
        memory.lend(lent);
        let memory = Arc::clone(memory);
        let library = Self(Arc::new(LibraryState { entries, open, pool, folder: reader, memory }));
        library.add_demos();
        if let Some(folder) = folder.map(DataFolder::open).transpose()? {
            let state = Arc::downgrade(&library.0);
            std::thread::Builder::new().name("library".into()).spawn(move || watch(&state, &folder))?;
        }
        Ok(library)
    }

    /// Whether the data folder, if there is one, answers.
    pub async fn answers(&self) -> bool {
        match &self.0.folder {
            Some(folder) => folder.answers().await,
            None => true,
        }
    }

    fn with<T>(&self, look: impl FnOnce(&BTreeMap<String, Entry>) -> T) -> T {
        look(&self.0.entries.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// All items for lists, by id.
    pub fn items(&self) -> Vec<SceneItem> {
        self.with(|entries| entries.values().map(|e| e.item.clone()).collect())
    }

    /// Whether this id belongs to the library.
    pub fn has(&self, id: &str) -> bool {
        self.with(|entries| entries.contains_key(id))
    }

    /// Opens a scene; `None` if the id does not belong to the library.
    ///
    /// # Errors
    /// When its file can no longer be read.
    pub async fn open(&self, id: &str) -> Result<Option<Opened>, Problem> {
        let key = id.to_owned();
        let Some(entry) = self.with(|entries| entries.get(id).cloned()) else { return Ok(None) };
        if let Some(known) = self.0.open.get(&key).filter(|known| known.etag == entry.item.etag) {
            return Ok(Some(known));
        }
        let bytes = usize::try_from(entry.item.bytes).unwrap_or(usize::MAX);
        let held = self.0.memory.take(bytes).ok_or_else(memory::full)?;
        let file = match (&entry.place, &self.0.folder) {
            // A file that has grown since is another one.
            (ScenePlace::File(name, _), Some(folder)) => {
                Some(folder.read(name.clone(), entry.item.bytes).await?)
            }
            _ => None,
        };
        let open = move || {
            let _held = held;
            let mut scene = read(&entry, file)?;
            scene.id = Some(entry.item.id.clone());
            scene.name.clone_from(&entry.item.name);
            Ok(Opened::new(scene, entry.item.etag))
        };
        let opened = self.0.pool.document(bytes, open).await?;
        self.0.open.put(key, opened.clone(), weight::of_open(&opened.scene), Party::default());
        Ok(Some(opened))
    }

    /// The map of one of the scenes, by hash.
    ///
    /// # Errors
    /// When its file can no longer be read.
    pub async fn map(&self, hash: &ContentHash) -> Result<Option<Shared<LaneMap>>, Problem> {
        let hex = hash.hex();
        let holder = self
            .with(|entries| entries.values().find(|e| e.item.map_sha256 == hex).map(|e| e.item.id.clone()));
        match holder {
            Some(id) => Ok(self.open(&id).await?.map(|opened| opened.scene.map.clone())),
            None => Ok(None),
        }
    }

    fn add(&self, id: String, scene: &Scene, place: ScenePlace, file: &FileFacts) {
        let time = clock::text(file.modified);
        let item = SceneItem {
            name: if scene.name.is_empty() { id.clone() } else { scene.name.clone() },
            etag: file.etag.clone(),
            created_at: time.clone(),
            updated_at: time,
            facts: Facts::of(scene),
            map_sha256: scene.map.hash().hex(),
            tags: scene.meta.tags.clone(),
            parent_id: None,
            bytes: file.bytes,
            readonly: true,
            owner: None,
            shared: None,
            id: id.clone(),
        };
        let mut entries = self.0.entries.write().unwrap_or_else(PoisonError::into_inner);
        entries.insert(id, Entry { item, place });
    }

    fn add_demos(&self) {
        for id in demos::ids() {
            let Some(demo) = demos::file(&id) else { continue };
            match demo.scene {
                Ok(scene) => {
                    let place = ScenePlace::Demo(id.clone());
                    let file = FileFacts {
                        etag: etag_of(&demo.bytes, &[]),
                        bytes: demo.bytes.len() as u64,
                        modified: SystemTime::UNIX_EPOCH,
                    };
                    self.add(id, &scene, place, &file);
                }
                Err(problem) => tracing::error!(%id, detail = %problem.detail, "demo scene is broken"),
            }
        }
    }

    /// Lists the scenes of the files that are new or have changed since the last look, and drops those of files that are
    /// gone. A file that changes from one look to the next may still be written, and waits for the next one.
    ///
    /// # Errors
    /// When the folder cannot be read: the list stays as it was.
    fn look(
        &self,
        folder: &DataFolder,
        seen: &mut BTreeMap<PathBuf, SeenFile>,
        at_once: bool,
    ) -> io::Result<()> {
        let mut files = folder.names()?;
        files.truncate(MOST_FILES);
        let names: Vec<&str> = files.iter().map(|path| path.to_str().unwrap_or_default()).collect();
        // Companion tables are read together with the tracks.
        let followers = table::followers(&names, None);
        let files: BTreeSet<PathBuf> = files
            .iter()
            .enumerate()
            .filter(|(at, _)| !followers.contains(at))
            .map(|(_, p)| p.clone())
            .collect();
        seen.retain(|path, _| {
            let is_there = files.contains(path);
            if !is_there {
                self.forget(path);
            }
            is_there
        });
        for path in files {
            let beside = folder.beside(&path);
            let all = std::iter::once(path.as_path()).chain(beside.iter().map(Path::new));
            let stamps: Vec<Option<FileStamp>> = all.map(|name| folder.stamp(name)).collect();
            let is_stable = seen.get(&path).map_or(at_once, |known| known.stamps == stamps);
            if seen.get(&path).is_some_and(|known| known.is_read && is_stable) {
                continue;
            }
            let is_read = is_stable && self.add_file(folder, &path, &stamps);
            seen.insert(path, SeenFile { stamps, is_read });
        }
        Ok(())
    }

    /// Lists the scenes of a file in place of those that it had. False if other requests fill the memory; no file gets more
    /// than half of it.
    fn add_file(&self, folder: &DataFolder, path: &Path, stamps: &[Option<FileStamp>]) -> bool {
        let length: u64 = stamps.iter().flatten().map(|stamp| stamp.bytes).sum();
        let most = self.0.memory.most() / 2;
        let Some(_share) = usize::try_from(length.min(most)).ok().and_then(|bytes| self.0.memory.take(bytes))
        else {
            return false;
        };
        let held = folder.read(path, most).map_err(|error| error.to_string());
        let read = held.and_then(|held| Ok((scenes_of(path, &held)?, held)));
        self.forget(path);
        match read {
            Ok((scenes, held)) => {
                let file = FileFacts {
                    etag: etag_of(&held.bytes, &held.others),
                    bytes: held.length(),
                    modified: stamps
                        .first()
                        .copied()
                        .flatten()
                        .map_or(SystemTime::UNIX_EPOCH, |own| own.modified),
                };
                for (index, scene) in scenes.iter().enumerate() {
                    // Existing scenes stay: a file replaces neither a demo nor another file's scene.
                    let ids = [file_id(path, scene, index), name_id(path, index)];
                    let Some(id) = ids.into_iter().find(|id| !self.has(id)) else {
                        tracing::warn!(file = %path.display(), "its scene's id is taken");
                        continue;
                    };
                    self.add(id, scene, ScenePlace::File(path.to_owned(), index), &file);
                }
            }
            Err(error) => tracing::info!(file = %path.display(), %error, "no scene"),
        }
        true
    }

    /// Drops the scenes of a file.
    fn forget(&self, path: &Path) {
        let mut entries = self.0.entries.write().unwrap_or_else(PoisonError::into_inner);
        entries.retain(|id, entry| {
            let is_other = !matches!(&entry.place, ScenePlace::File(of, _) if of == path);
            if !is_other {
                self.0.open.forget(id);
            }
            is_other
        });
    }
}

/// Keeps the list of a library equal to its data folder, until the library is gone.
fn watch(library: &Weak<LibraryState>, folder: &DataFolder) {
    let (mut seen, mut at_once, mut fails) = (BTreeMap::new(), true, false);
    while let Some(state) = library.upgrade() {
        let began = Instant::now();
        let looked = Library(state).look(folder, &mut seen, std::mem::take(&mut at_once));
        if let (Err(error), false) = (&looked, fails) {
            tracing::error!(%error, "data folder cannot be read");
        }
        fails = looked.is_err();
        std::thread::sleep(LOOK_EVERY.max(began.elapsed() * REST));
    }
}

/// ETag of a file, including the files that are read with it.
fn etag_of(bytes: &[u8], others: &[(String, Arc<Vec<u8>>)]) -> String {
    let hash = |bytes: &[u8]| ContentHash::of_bytes(bytes).hex();
    let own = hash(bytes);
    // A single file's ETag is that of its bytes.
    let hash = if others.is_empty() {
        own
    } else {
        let others = others.iter().map(|(name, bytes)| format!(" {name} {}", hash(bytes)));
        hash(others.fold(own, |all, other| all + &other).as_bytes())
    };
    format!("\"ro-{}\"", hash.get(..16).unwrap_or_default())
}

/// The scene of an entry; for the data folder, from the file that its name leads to now.
fn read(entry: &Entry, file: Option<io::Result<HeldFile>>) -> Result<Scene, Problem> {
    match &entry.place {
        ScenePlace::Demo(id) => demos::file(id).ok_or_else(|| Problem::internal("demo scene is gone"))?.scene,
        ScenePlace::File(path, index) => {
            let changed = |error: String| {
                tracing::info!(file = %path.display(), %error, "gone or changed");
                Problem::new(
                    Code::NotFound,
                    "The file of this scene is gone from the data folder, or has changed.",
                )
            };
            let file = file.ok_or_else(|| Problem::internal("no data folder"))?;
            let held = file.map_err(|error| changed(error.to_string()))?;
            if etag_of(&held.bytes, &held.others) != entry.item.etag {
                return Err(changed("another content".into()));
            }
            let mut scenes = scenes_of(path, &held).map_err(changed)?;
            if *index >= scenes.len() {
                return Err(changed("fewer scenes than before".into()));
            }
            Ok(scenes.swap_remove(*index))
        }
    }
}

fn scenes_of(path: &Path, held: &HeldFile) -> Result<Vec<Scene>, String> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let beside = Companions { folder: held.folder(&name), ..companions() };
    let file = SceneFile::of(&held.bytes, None, &name, &beside, (0, MOST_FILES));
    let read = file.and_then(|file| file.read(&held.bytes));
    let read = read.map_err(|problem| problem.detail)?;
    Ok(read.scenes.into_iter().map(|s| s.scene).collect())
}

/// `womd-<scenario id>` if the source has an id, else a name made from the file's. A scene with futures is
/// one of many results of its source, so it is named by its file.
fn file_id(path: &Path, scene: &Scene, index: usize) -> String {
    let own = scene.meta.source_id.as_ref().filter(|_| scene.generated.is_none());
    match (own, scene.meta.source.as_str()) {
        (Some(own), "") => id::cleaned(&format!("file-{own}")),
        (Some(own), source) => id::cleaned(&format!("{source}-{own}")),
        (None, _) => name_id(path, index),
    }
}

/// A name made from the file's.
fn name_id(path: &Path, index: usize) -> String {
    let stem = path.file_name().unwrap_or_default().to_string_lossy();
    id::cleaned(&format!("file-{}-{index}", stem.split('.').next().unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::limits::Limits;
    use formats::native::{MapForm, SceneDoc};

    #[test]
    fn demos_are_there_before_anybody_can_ask() {
        let pool = Pool::start(&Arc::new(Limits::default())).unwrap();
        let library = Library::start(None, pool, (&Memory::new(1 << 24), 1 << 20)).unwrap();
        assert_eq!(library.items().len(), demos::ids().len());
        assert!(library.has("demo-crossing"));
    }

    #[test]
    fn the_list_follows_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let write = |file: &str, name: &str| {
            let scene = Scene::bare(name, LaneMap::default(), Vec::new());
            let doc = SceneDoc::from_scene(&scene, MapForm::Inline);
            std::fs::write(folder.path().join(file), formats::native::write_doc(&doc)).unwrap();
        };
        let pool = Pool::start(&Arc::new(Limits::default())).unwrap();
        let library = Library::start(None, pool, (&Memory::new(1 << 24), 1 << 20)).unwrap();
        let (opened, mut seen) = (DataFolder::open(folder.path()).unwrap(), BTreeMap::new());
        let mut look = |at_once: bool| {
            library.look(&opened, &mut seen, at_once).unwrap();
            let own = library.items().into_iter().filter(|item| item.id.starts_with("file-"));
            own.map(|item| (item.id, item.name)).collect::<Vec<_>>()
        };
        let list = |items: &[(&str, &str)]| -> Vec<(String, String)> {
            items.iter().map(|(id, name)| ((*id).to_owned(), (*name).to_owned())).collect()
        };
        write("a.json", "one");
        std::fs::write(folder.path().join("notes.txt"), "no scene").unwrap();
        assert_eq!(look(true), list(&[("file-a-0", "one")]));
        // New and changed files may still be written: they are read once they stay the same.
        write("b.json", "two");
        write("a.json", "longer");
        assert_eq!(look(false), list(&[("file-a-0", "one")]));
        assert_eq!(look(false), list(&[("file-a-0", "longer"), ("file-b-0", "two")]));
        std::fs::remove_file(folder.path().join("a.json")).unwrap();
        assert_eq!(look(false), list(&[("file-b-0", "two")]));
        assert_eq!(look(false), list(&[("file-b-0", "two")]));
    }

    #[test]
    fn a_recording_is_named_by_its_source_and_a_result_by_its_file() {
        let mut scene = Scene::bare("s", LaneMap::default(), Vec::new());
        scene.meta.source_id = Some("own".into());
        scene.meta.source = "womd".into();
        let id = |scene: &Scene| file_id(Path::new("cases/ABC123.json"), scene, 0);
        assert_eq!(id(&scene), "womd-own");
        scene.generated = Some(scene::Generated::default());
        assert_eq!(id(&scene), "file-ABC123-0");
    }
}
