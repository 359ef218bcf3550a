//! Read-only scenes: demos inside the program, and files of the folder given with `--data`.
//!
//! Files are read once in the background for the list; a scene is parsed again when it is opened,
//! and a few stay in memory.

use crate::base::clock;
use crate::base::problem::Problem;
use crate::http::body::blocking;
use crate::http::embed::DemoScenes;
use crate::scenes::catalog::{Facts, Item, Opened};
use formats::native;
use scene::{ContentHash, LaneMap, Scene};
use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock};
use std::time::SystemTime;

/// Scenes kept in memory.
const KEPT: usize = 8;
/// Most files taken from the data folder.
const MOST_FILES: usize = 5_000;

#[derive(Clone, Debug)]
enum Place {
    /// Name of an embedded file.
    Demo(String),
    /// File and the position of the scene in it.
    File(PathBuf, usize),
}

#[derive(Clone, Debug)]
struct Entry {
    item: Item,
    place: Place,
}

#[derive(Default)]
struct Inside {
    entries: BTreeMap<String, Entry>,
    open: VecDeque<(String, Opened)>,
}

/// All read-only scenes. Cheap to clone.
#[derive(Clone, Default)]
pub struct Library(Arc<RwLock<Inside>>);

impl Library {
    /// The demos at once; the folder's files as they are read.
    pub fn start(folder: Option<&Path>) -> Self {
        let library = Self::default();
        let folder = folder.map(Path::to_owned);
        let filled = library.clone();
        std::thread::spawn(move || {
            filled.add_demos();
            if let Some(folder) = folder {
                filled.add_folder(&folder);
            }
        });
        library
    }

    fn with<T>(&self, look: impl FnOnce(&Inside) -> T) -> T {
        look(&self.0.read().unwrap_or_else(PoisonError::into_inner))
    }

    fn change(&self, change: impl FnOnce(&mut Inside)) {
        change(&mut self.0.write().unwrap_or_else(PoisonError::into_inner));
    }

    /// For lists, by id.
    pub fn items(&self) -> Vec<Item> {
        self.with(|inside| inside.entries.values().map(|e| e.item.clone()).collect())
    }

    /// True when this id is one of the library's.
    pub fn has(&self, id: &str) -> bool {
        self.with(|inside| inside.entries.contains_key(id))
    }

    /// Opens a scene; `None` when the id is not one of the library's.
    ///
    /// # Errors
    /// When its file cannot be read any more.
    pub async fn open(&self, id: &str) -> Result<Option<Opened>, Problem> {
        let known = self.with(|i| i.open.iter().find(|(key, _)| key == id).map(|(_, opened)| opened.clone()));
        if known.is_some() {
            return Ok(known);
        }
        let Some(entry) = self.with(|inside| inside.entries.get(id).cloned()) else { return Ok(None) };
        let id = id.to_owned();
        let scene = blocking(move || {
            let mut scene = read(&entry.place)?;
            scene.id = Some(entry.item.id.clone());
            scene.name.clone_from(&entry.item.name);
            Ok(Opened { scene: Arc::new(scene), etag: entry.item.etag })
        });
        let opened = scene.await?;
        self.change(|inside| {
            if inside.open.len() >= KEPT {
                inside.open.pop_front();
            }
            inside.open.push_back((id, opened.clone()));
        });
        Ok(Some(opened))
    }

    /// A map that one of the scenes has.
    ///
    /// # Errors
    /// When its file cannot be read any more.
    pub async fn map(&self, hash: &ContentHash) -> Result<Option<Arc<LaneMap>>, Problem> {
        let hex = hash.hex();
        let holder = self.with(|inside| {
            inside.entries.values().find(|e| e.item.map_sha256 == hex).map(|e| e.item.id.clone())
        });
        match holder {
            Some(id) => Ok(self.open(&id).await?.map(|opened| Arc::clone(&opened.scene.map))),
            None => Ok(None),
        }
    }

    fn add(&self, id: String, scene: &Scene, place: Place, bytes: &[u8], modified: SystemTime) {
        let hash = ContentHash::of_bytes(bytes).hex();
        let time = clock::text(modified);
        let item = Item {
            name: if scene.name.is_empty() { id.clone() } else { scene.name.clone() },
            etag: format!("\"ro-{}\"", hash.get(..16).unwrap_or_default()),
            created_at: time.clone(),
            updated_at: time,
            facts: Facts::of(scene),
            map_sha256: scene.map.hash().hex(),
            tags: scene.meta.tags.clone(),
            parent_id: None,
            bytes: bytes.len() as u64,
            readonly: true,
            id: id.clone(),
        };
        self.change(|inside| {
            inside.entries.insert(id, Entry { item, place });
        });
    }

    fn add_demos(&self) {
        for name in DemoScenes::iter() {
            let Some(file) = DemoScenes::get(&name) else { continue };
            let Some(id) = name.strip_suffix(".json").filter(|id| crate::routes::is_id(id)) else { continue };
            match native::read(&file.data) {
                Ok(scene) => {
                    let place = Place::Demo(name.to_string());
                    self.add(id.to_owned(), &scene, place, &file.data, SystemTime::UNIX_EPOCH);
                }
                Err(error) => tracing::error!(%name, %error, "demo scene is broken"),
            }
        }
    }

    fn add_folder(&self, folder: &Path) {
        let listed = match std::fs::read_dir(folder) {
            Ok(listed) => listed,
            Err(error) => {
                tracing::error!(folder = %folder.display(), %error, "data folder cannot be read");
                return;
            }
        };
        let mut files: Vec<PathBuf> = listed.flatten().map(|f| f.path()).filter(|p| p.is_file()).collect();
        files.sort();
        files.truncate(MOST_FILES);
        for path in files {
            match read_file(&path) {
                Ok((bytes, scenes)) => {
                    let modified =
                        path.metadata().and_then(|m| m.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
                    for (index, scene) in scenes.iter().enumerate() {
                        let id = file_id(&path, scene, index);
                        self.add(id, scene, Place::File(path.clone(), index), &bytes, modified);
                    }
                }
                Err(error) => tracing::info!(file = %path.display(), %error, "no scene"),
            }
        }
    }
}

fn read(place: &Place) -> Result<Scene, Problem> {
    match place {
        Place::Demo(name) => {
            let file = DemoScenes::get(name).ok_or_else(|| Problem::internal("demo scene is gone"))?;
            Ok(native::read(&file.data)?)
        }
        Place::File(path, index) => {
            let (_, mut scenes) = read_file(path).map_err(Problem::internal)?;
            if *index < scenes.len() {
                Ok(scenes.swap_remove(*index))
            } else {
                Err(Problem::internal("a file of the data folder has changed"))
            }
        }
    }
}

fn read_file(path: &Path) -> Result<(Vec<u8>, Vec<Scene>), String> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let read = crate::scenes::transfer::read(&bytes, None, &name, 0, MOST_FILES, None);
    let read = read.map_err(|problem| problem.detail)?;
    Ok((bytes, read.scenes.into_iter().map(|s| s.scene).collect()))
}

/// `womd-<scenario id>` where the source has an id, else a name made from the file's.
fn file_id(path: &Path, scene: &Scene, index: usize) -> String {
    let source = if scene.meta.source.is_empty() { "file" } else { &scene.meta.source };
    let stem = path.file_name().unwrap_or_default().to_string_lossy();
    let stem = stem.split('.').next().unwrap_or_default();
    let own = scene.meta.source_id.clone().unwrap_or_else(|| format!("{stem}-{index}"));
    let clean = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    format!("{source}-{own}").chars().map(clean).take(64).collect()
}
