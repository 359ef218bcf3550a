//! Request bodies about a scene, together with the scene.

use super::own::own_catalog;
use crate::app::App;
use crate::http::body::Json;
use crate::http::extract::Connection;
use api::{AboutScene, Subject};
use axum::extract::{FromRequest, Request};
use base::problem::Refusal;
use serde::de::DeserializeOwned;
use work::Caller;

/// A JSON body with its scene.
pub struct WithScene<T>(pub T, pub Subject);

impl<T: AboutScene + DeserializeOwned + Send + 'static> FromRequest<App> for WithScene<T> {
    type Rejection = Refusal;

    async fn from_request(request: Request, app: &App) -> Result<Self, Refusal> {
        let connection = request.extensions().get::<Connection>().copied();
        let caller = connection.map_or_else(Caller::default, Caller::from);
        let catalog = own_catalog(app, request.extensions())?;
        let Json(mut body) = Json::<T>::from_request(request, app).await?;
        // Opening a scene costs more than a refusal may.
        app.pool.expects(&caller)?;
        let scene = body.take_scene().open(&catalog).await?;
        Ok(Self(body, scene))
    }
}
