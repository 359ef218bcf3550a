//! Sources of scenes: a scene in the request, or the id of one, which a `Home` resolves.

use crate::code::Code;
use crate::english;
use crate::opened::{Opened, Standings};
use crate::problem::Problem;
use formats::native::SceneDoc;
use scene::Scene;
use serde_json::json;
use std::collections::BTreeMap;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};

/// Source of a transport's scenes: a store, a data folder, examples, a browser's storage, a dictionary.
///
/// Its functions may wait for a disk or another thread, in whatever way the transport does.
pub trait Home: Sync {
    /// The scene of a document. If the document names its map by hash, the map is looked up.
    ///
    /// # Errors
    /// `unknown-map`, or every fault of the scene.
    fn read(&self, doc: SceneDoc) -> impl Future<Output = Result<Scene, Problem>> + Send;

    /// Opens a scene by its id, or by the name under which it is held.
    ///
    /// # Errors
    /// `not-found`.
    fn open(&self, id: &str) -> impl Future<Output = Result<Opened, Problem>> + Send;

    /// Keeps a scene in memory for later calls, and returns its name; `None` if this home keeps nothing.
    fn hold(&self, scene: Scene) -> (Option<String>, Opened);
}

/// Scenes by id, in memory. An empty map is the home of calls that carry their scenes.
impl Home for BTreeMap<String, Opened> {
    async fn read(&self, doc: SceneDoc) -> Result<Scene, Problem> {
        Ok(doc.into_scene(|_| None)?)
    }

    async fn open(&self, id: &str) -> Result<Opened, Problem> {
        self.get(id).cloned().ok_or_else(not_found)
    }

    fn hold(&self, scene: Scene) -> (Option<String>, Opened) {
        (None, Opened::new(scene, String::new()))
    }
}

/// The refusal of an unknown id.
pub fn not_found() -> Problem {
    Problem::new(Code::NotFound, "No scene has this id.")
}

/// The result of a home that never waits; `None` for a home that does.
pub fn at_once<T>(given: impl Future<Output = T>) -> Option<T> {
    match pin!(given).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(value) => Some(value),
        Poll::Pending => None,
    }
}

/// The scene of a request. Exactly one of `scene` and `scene_id` is given.
#[derive(Debug, Default)]
pub struct SceneRef {
    /// The scene itself.
    pub scene: Option<SceneDoc>,
    /// Id of a scene of the home.
    pub scene_id: Option<String>,
    /// With `scene_id`: the expected version.
    pub etag: Option<String>,
    /// With `scene`: keep it in memory, because later calls refer to it.
    pub hold: bool,
}

/// A request about a scene.
pub trait AboutScene {
    /// Takes the scene out of the request.
    fn take_scene(&mut self) -> SceneRef;
}

/// The scene of a call.
pub struct Subject {
    /// The scene.
    pub scene: Arc<Scene>,
    /// Scores of the unchanged scene; `None` for a scene that belongs to this call only.
    pub standings: Option<Arc<Standings>>,
    /// The name under which it is held from now on.
    pub held: Option<String>,
}

impl Subject {
    /// A scene that belongs to this call only.
    pub fn passing(scene: impl Into<Arc<Scene>>) -> Self {
        Self { scene: scene.into(), standings: None, held: None }
    }

    fn standing(opened: Opened, held: Option<String>) -> Self {
        Self { scene: opened.scene, standings: Some(opened.standings), held }
    }
}

impl SceneRef {
    /// Resolves the scene.
    ///
    /// # Errors
    /// `invalid-field` unless exactly one is given, `not-found`, `stale-etag`, or every fault of the scene,
    /// its pointers below `/scene`.
    pub async fn open<H: Home>(self, home: &H) -> Result<Subject, Problem> {
        match (self.scene, self.scene_id) {
            (Some(doc), None) => {
                let mut scene = home.read(doc).await.map_err(|problem| problem.under("/scene"))?;
                // No answer depends on these members, and they may be long.
                scene.extra.clear();
                if !self.hold {
                    return Ok(Subject::passing(scene));
                }
                let (name, opened) = home.hold(scene);
                Ok(Subject::standing(opened, name))
            }
            (None, Some(id)) => {
                let opened = home.open(&id).await?;
                if self.etag.is_some_and(|etag| etag != opened.etag) {
                    let problem = Problem::of(Code::StaleEtag, english::changed_scene());
                    return Err(problem.with(|m| m.etag = Some(opened.etag)));
                }
                Ok(Subject::standing(opened, None))
            }
            _ => Err(Problem::of(Code::InvalidField, english::one_scene()).at("/scene")),
        }
    }
}

/// Schema rule: exactly one of `scene` and `scene_id` is given, and not as null.
pub fn one_scene(schema: &mut schemars::Schema) {
    let given =
        |member: &str| json!({"required": [member], "properties": {member: {"not": {"type": "null"}}}});
    schema.insert("oneOf".into(), json!([given("scene"), given("scene_id")]));
}

#[cfg(test)]
mod tests {
    use super::{SceneRef, at_once};
    use crate::code::Code;
    use crate::opened::Opened;
    use scene::{LaneMap, Scene};
    use std::collections::BTreeMap;

    fn opened(wanted: SceneRef) -> Result<super::Subject, Code> {
        let scene = Scene::bare("kept", LaneMap::default(), Vec::new());
        let home = BTreeMap::from([("a".to_owned(), Opened::new(scene, "\"1\"".into()))]);
        at_once(wanted.open(&home)).unwrap().map_err(|problem| problem.code)
    }

    #[test]
    fn a_request_names_one_scene() {
        let by_id = |id: &str, etag: Option<&str>| SceneRef {
            scene_id: Some(id.into()),
            etag: etag.map(str::to_owned),
            ..SceneRef::default()
        };
        assert_eq!(opened(by_id("a", None)).unwrap().scene.name, "kept");
        assert_eq!(opened(by_id("a", Some("\"1\""))).unwrap().held, None);
        assert_eq!(opened(by_id("a", Some("\"2\""))).err(), Some(Code::StaleEtag));
        assert_eq!(opened(by_id("b", None)).err(), Some(Code::NotFound));
        assert_eq!(opened(SceneRef::default()).err(), Some(Code::InvalidField));
    }
}
