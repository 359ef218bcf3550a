//! "A scene, or the id of one": the one way calls name what they are about.

use crate::app::App;
use crate::base::problem::{Code, Problem};
use crate::http::body::Json;
use crate::scenes::Standings;
use axum::extract::{FromRequest, Request};
use formats::native::SceneDoc;
use scene::Scene;
use serde::de::DeserializeOwned;
use std::sync::Arc;

/// What a body says about its scene. Exactly one of `scene` and `scene_id` is given.
#[derive(Debug, Default)]
pub struct SceneRef {
    /// The scene itself.
    pub scene: Option<SceneDoc>,
    /// A scene of this server.
    pub scene_id: Option<String>,
    /// With `scene_id`: the version that is meant.
    pub etag: Option<String>,
    /// With `scene`: calls that follow will name it.
    pub hold: bool,
}

impl SceneRef {
    /// The scene that is named.
    ///
    /// # Errors
    /// `invalid-field` unless exactly one is given, `not-found`, `stale-etag`, or every fault of the
    /// scene, its pointers below `/scene`.
    pub async fn open(self, app: &App) -> Result<Subject, Problem> {
        match (self.scene, self.scene_id) {
            (Some(doc), None) => {
                let scene = app.catalog.scene_of(doc).await;
                let scene = scene.map_err(|problem| problem.under("/scene"))?;
                if !self.hold {
                    return Ok(Subject { scene: Arc::new(scene), standings: None, held: None });
                }
                let (name, opened) = app.catalog.hold(scene);
                Ok(Subject { scene: opened.scene, standings: Some(opened.standings), held: Some(name) })
            }
            (None, Some(id)) => {
                let opened = app.catalog.open(&id).await?;
                if self.etag.is_some_and(|etag| etag != opened.etag) {
                    let detail = "The stored scene is another than the one you read.";
                    return Err(Problem::new(Code::StaleEtag, detail).with(|m| m.etag = Some(opened.etag)));
                }
                Ok(Subject { scene: opened.scene, standings: Some(opened.standings), held: None })
            }
            _ => {
                let detail = "exactly one of scene and scene_id is needed";
                Err(Problem::field("/scene", Code::InvalidField, detail))
            }
        }
    }
}

/// A body that is about a scene.
pub trait AboutScene {
    /// Takes out what it says about it.
    fn take_scene(&mut self) -> SceneRef;
}

/// The scene that a call is about.
pub struct Subject {
    /// The scene.
    pub scene: Arc<Scene>,
    /// What it comes to as it stands; not for one that came with the call and goes with it.
    pub standings: Option<Arc<Standings>>,
    /// The name under which it is held from now on.
    pub held: Option<String>,
}

/// A JSON body with the scene it is about.
pub struct WithScene<T>(pub T, pub Subject);

impl<T: AboutScene + DeserializeOwned + Send + 'static> FromRequest<App> for WithScene<T> {
    type Rejection = Problem;

    async fn from_request(request: Request, app: &App) -> Result<Self, Problem> {
        let Json(mut body) = Json::<T>::from_request(request, app).await?;
        // Opening a scene costs more than a refusal may.
        app.pool.expects(None)?;
        let scene = body.take_scene().open(app).await?;
        Ok(Self(body, scene))
    }
}
