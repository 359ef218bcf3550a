//! The open scenes: by name, limited in number and memory.

use crate::scenes::weight;
use api::{Code, Problem};
use base::id;
use base::memory::{Memory, MemoryShare};
use scene::Scene;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A scene with its share of memory.
struct OnDesk {
    scene: Arc<Scene>,
    /// Held until the scene is closed or replaced.
    _share: MemoryShare,
}

/// All open scenes.
pub struct SceneDesk {
    most: usize,
    memory: Arc<Memory>,
    open: Mutex<BTreeMap<String, OnDesk>>,
}

impl SceneDesk {
    /// A desk for this number of scenes in this memory.
    pub fn new(most: usize, memory: Arc<Memory>) -> Self {
        Self { most, memory, open: Mutex::default() }
    }

    fn open(&self) -> MutexGuard<'_, BTreeMap<String, OnDesk>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Names of the open scenes, sorted.
    pub fn names(&self) -> Vec<String> {
        self.open().keys().cloned().collect()
    }

    /// An open scene.
    ///
    /// # Errors
    /// `not-found` with the names of open scenes.
    pub fn get(&self, name: &str) -> Result<Arc<Scene>, Problem> {
        let found = self.open().get(name).map(|held| Arc::clone(&held.scene));
        found.ok_or_else(|| self.unknown(name))
    }

    /// Reads all names, so it must not be called under the lock.
    fn unknown(&self, name: &str) -> Problem {
        let shown: String = name.chars().take(64).collect();
        let names = self.names();
        let open =
            if names.is_empty() { "none is".to_owned() } else { format!("open are {}", names.join(", ")) };
        let detail = format!("no open scene is named \"{shown}\": {open}; open_scene opens one");
        Problem::field("/scene", Code::NotFound, detail)
    }

    /// Opens a scene under this name, or a similar free one.
    ///
    /// # Errors
    /// `store-full` at the limit of scenes or bytes.
    pub fn add(&self, like: &str, scene: Scene) -> Result<String, Problem> {
        let held = self.held(scene)?;
        let mut open = self.open();
        if open.len() >= self.most {
            let count = open.len();
            let detail = format!("{count} scenes are open, as many as may be; close_scene closes one");
            return Err(Problem::new(Code::StoreFull, detail).limit(self.most as u64));
        }
        let like = match id::cleaned(like) {
            empty if empty.is_empty() => "scene".to_owned(),
            like => like,
        };
        let numbered = (2..).map(|number| format!("{like}-{number}"));
        let name = std::iter::once(like.clone()).chain(numbered).find(|name| !open.contains_key(name));
        let name = name.unwrap_or(like);
        open.insert(name.clone(), held);
        Ok(name)
    }

    /// Replaces an open scene by its changed version.
    ///
    /// # Errors
    /// `store-full` if it does not fit; the former one then stays. `not-found`.
    pub fn put(&self, name: &str, scene: Scene) -> Result<Arc<Scene>, Problem> {
        let held = self.held(scene)?;
        let scene = Arc::clone(&held.scene);
        let replaced = self.open().get_mut(name).map(|place| *place = held);
        replaced.map(|()| scene).ok_or_else(|| self.unknown(name))
    }

    fn held(&self, scene: Scene) -> Result<OnDesk, Problem> {
        let share = self.memory.take(weight::of_open(&scene)).ok_or_else(|| {
            let detail = "the open scenes take as much memory as they may; close_scene closes one";
            Problem::new(Code::StoreFull, detail).limit(self.memory.most())
        })?;
        Ok(OnDesk { scene: Arc::new(scene), _share: share })
    }

    /// Closes a scene.
    ///
    /// # Errors
    /// `not-found`.
    pub fn close(&self, name: &str) -> Result<(), Problem> {
        let closed = self.open().remove(name);
        closed.map(|_| ()).ok_or_else(|| self.unknown(name))
    }
}

#[cfg(test)]
mod tests {
    use super::SceneDesk;
    use api::Code;
    use base::memory::Memory;
    use scene::{LaneMap, Scene};

    fn empty() -> Scene {
        Scene::bare("empty", LaneMap::default(), Vec::new())
    }

    #[test]
    fn scenes_have_names_of_their_own_up_to_a_number() {
        let desk = SceneDesk::new(2, Memory::new(1 << 20));
        assert_eq!(desk.add("a/b", empty()).unwrap(), "a-b");
        assert_eq!(desk.add("a/b", empty()).unwrap(), "a-b-2");
        assert_eq!(desk.add("c", empty()).unwrap_err().code, Code::StoreFull);
        let unknown = desk.get("c").unwrap_err();
        assert_eq!(unknown.code, Code::NotFound);
        assert!(unknown.detail.contains("open are a-b, a-b-2"), "{}", unknown.detail);
        desk.close("a-b").unwrap();
        assert!(desk.put("a-b", empty()).is_err() && desk.close("a-b").is_err());
        assert_eq!(desk.add("", empty()).unwrap(), "scene");
    }

    #[test]
    fn memory_is_bounded_and_comes_back() {
        let mut large = empty();
        large.meta.notes = "x".repeat(10_000);
        let desk = SceneDesk::new(9, Memory::new(25_000));
        desk.add("a", large.clone()).unwrap();
        desk.add("b", large.clone()).unwrap();
        assert_eq!(desk.add("c", large.clone()).unwrap_err().code, Code::StoreFull);
        assert!(desk.put("a", large.clone()).is_err() && desk.get("a").is_ok());
        desk.close("b").unwrap();
        assert!(desk.put("a", large).is_ok());
    }
}
