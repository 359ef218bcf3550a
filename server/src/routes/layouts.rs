//! `/v1/map`: maps from nothing.

use crate::app::App;
use crate::base::problem::Problem;
use crate::http::body::{Json, JsonText};
use crate::http::extract::Connection;
use crate::work::{Asked, Kind};
use axum::extract::State;
use formats::native::{AnyDoc, MapForm, SceneDoc};
use formats::{FieldProblem, ReadError};
use layouts::{ArmPlace, Built, Check, CornerPlace, Fault, Layout, TEMPLATES, Template, Way};
use scene::{MAX_NAME_CHARS, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::time::Duration;

/// What drawing a map and writing it takes, about.
const MAP_COST: Duration = Duration::from_millis(5);

/// Body of a new map.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MapBody {
    /// What to start from.
    template: Template,
    /// In place of the template's own parameters; those that are left out stay, and a list replaces a list. Names and
    /// ranges are those of the template in `Layout`.
    #[serde(default)]
    #[schemars(with = "Option<std::collections::BTreeMap<String, serde_json::Value>>")]
    parameters: Option<AnyDoc>,
    /// Name of the scene; that of the template when left out.
    #[serde(default)]
    #[schemars(length(max = 200))]
    name: Option<String>,
}

/// A new map.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct MapReply {
    /// A scene with the map and nobody in it. Its `x_layout` says what it was made from.
    scene: SceneDoc,
    /// The template with all its parameters.
    layout: Layout,
    /// What was looked at. A check that failed forbids nothing.
    checks: Vec<Check>,
    /// Where the arms lie, in the order of the parameters.
    arms: Vec<ArmPlace>,
    /// Where kerbs bend between them.
    corners: Vec<CornerPlace>,
    /// Ways from lane to lane where roads meet at grade.
    ways: Vec<Way>,
}

/// A template and its own parameters.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TemplateItem {
    /// Its name for people.
    title: &'static str,
    /// The template with all its parameters.
    #[schemars(with = "Layout")]
    layout: Value,
}

/// All templates.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct TemplateList {
    templates: Vec<TemplateItem>,
}

impl TemplateList {
    /// Those of this build.
    pub fn new() -> Self {
        let item = |template: &Template| {
            let layout = json!({ "template": template.name(), "parameters": template.all_parameters() });
            TemplateItem { title: template.title(), layout }
        };
        Self { templates: TEMPLATES.iter().map(item).collect() }
    }
}

impl MapBody {
    /// Draws the map.
    ///
    /// # Errors
    /// Every fault of the parameters.
    pub fn run(self) -> Result<(Layout, Scene, Built), Problem> {
        let name = self.name.unwrap_or_else(|| self.template.title().to_owned());
        let length = name.chars().count();
        if length > MAX_NAME_CHARS {
            let fault = FieldProblem::range("/name", 0.0, MAX_NAME_CHARS as f64, length as f64);
            return Err(ReadError::from(fault).into());
        }
        let layout = match self.parameters {
            None => self.template.layout(),
            Some(AnyDoc(given)) => self.template.with(&given).map_err(|fault| refused(vec![fault]))?,
        };
        let (scene, built) = layouts::scene(&layout, &name).map_err(refused)?;
        Ok((layout, scene, built))
    }

    /// Draws the map and says all of it.
    ///
    /// # Errors
    /// Every fault of the parameters.
    pub fn reply(self) -> Result<MapReply, Problem> {
        let (layout, scene, Built { checks, arms, corners, ways, .. }) = self.run()?;
        let scene = SceneDoc::from_scene(&scene, MapForm::Inline);
        Ok(MapReply { scene, layout, checks, arms, corners, ways })
    }
}

fn refused(faults: Vec<Fault>) -> Problem {
    let told = |fault: Fault| {
        let pointer = format!("/parameters{}", fault.pointer);
        match fault.range {
            Some((least, most, got)) => FieldProblem::range(pointer, least, most, got),
            None => FieldProblem::new(pointer, formats::problem::code::INVALID_FIELD, fault.reason),
        }
    };
    ReadError::invalid(faults.into_iter().map(told).collect()).into()
}

refusals!(Refused: CHANGES BODY WORK);
refusals!(Unread:);

/// Draws a map from a template and its parameters: lanes with links, neighbours and boundaries, kerbs, crosswalks,
/// stop signs, lights over nine seconds. Stores nothing.
#[utoipa::path(post, path = "/v1/map", operation_id = "makeMap", tag = "maps",
    request_body(content = ref("#/components/schemas/MapBody"), content_type = "application/json",
        example = json!({"template": "four-arms", "parameters": {"kerb_radius_m": 6.0, "control": "equal"}})),
    responses((status = 200, description = "the map", body = ref("#/components/schemas/MapReply")), Refused))]
pub async fn make(
    State(app): State<App>,
    connection: Connection,
    Json(body): Json<MapBody>,
) -> Result<JsonText, Problem> {
    let asked = Asked { kind: Kind::Map, cost: MAP_COST, caller: connection.into() };
    app.pool.run(asked, move |_| JsonText::of(&body.reply()?)).await
}

/// Lists the templates of maps with their parameters.
#[utoipa::path(get, path = "/v1/map/templates", operation_id = "listTemplates", tag = "maps",
    responses((status = 200, description = "all templates", body = ref("#/components/schemas/TemplateList")), Unread))]
pub async fn templates() -> axum::Json<TemplateList> {
    axum::Json(TemplateList::new())
}
