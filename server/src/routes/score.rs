//! `/v1/score`: collisions, near misses, off-road driving, kinematics, goals.

use super::openapi::one_scene;
use super::scene_ref::{AboutScene, SceneRef, Subject, WithScene};
use crate::app::App;
use crate::base::problem::Problem;
use crate::generation::scoring;
use crate::http::body::JsonText;
use crate::http::extract::Connection;
use crate::work::{Asked, Kind};
use axum::extract::State;
use experts::Maps;
use formats::native::{Members, SceneDoc};
use formats::{FieldProblem, ReadError, pointer_token};
use scene::score::{PairChoice, Score, ScoreInput, Thresholds};
use scene::{AgentFutures, Future, Sample, Scene, State as AgentState, Track};
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

/// Motion of one road user as columns, one value a step from `first_step`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrajectoryDoc {
    /// Scene step of the first value.
    #[schemars(range(max = 599))]
    first_step: u64,
    x_m: Vec<f64>,
    y_m: Vec<f64>,
    heading_rad: Vec<f64>,
    vx_mps: Vec<f64>,
    vy_mps: Vec<f64>,
}

/// What trajectories are compared with.
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged)]
pub enum Reference {
    /// `"log"`.
    Word(Log),
    /// Motion by road user.
    Given(Members<TrajectoryDoc>),
}

impl<'de> Deserialize<'de> for Reference {
    /// Read as it comes: what is kept to be tried twice would lose where its faults are.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = Reference;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"log\" or motion by road user")
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<Reference, E> {
                Log::deserialize(word.into_deserializer()).map(Reference::Word)
            }

            fn visit_map<A: MapAccess<'de>>(self, members: A) -> Result<Reference, A::Error> {
                Members::deserialize(MapAccessDeserializer::new(members)).map(Reference::Given)
            }
        }

        deserializer.deserialize_any(Either)
    }
}

/// The word `log`.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Log {
    /// The recording.
    Log,
}

/// Body of a score. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = one_scene)]
pub struct ScoreRequest {
    /// The scene itself.
    #[serde(default)]
    scene: Option<SceneDoc>,
    /// A scene of this server.
    #[serde(default)]
    scene_id: Option<String>,
    /// With `scene_id`: refuse when the scene has changed.
    #[serde(default)]
    etag: Option<String>,
    /// Motion to score; for the rest the chosen futures, else the log.
    #[serde(default)]
    trajectories: Members<TrajectoryDoc>,
    /// The log by default.
    #[serde(default)]
    reference: Option<Reference>,
    /// `all` or `regenerated`.
    #[serde(default)]
    pairs: PairChoice,
    /// Numbers that decide what counts; those absent have their defaults.
    #[serde(default)]
    thresholds: Thresholds,
}

impl AboutScene for ScoreRequest {
    fn take_scene(&mut self) -> SceneRef {
        SceneRef {
            scene: self.scene.take(),
            scene_id: self.scene_id.take(),
            etag: self.etag.take(),
            hold: false,
        }
    }
}

refusals!(Refused: CHANGES BODY SCENE SCENE_REF STORE WORK);

/// Scores a scene: chosen futures or the given motion, and the log of the rest.
#[utoipa::path(post, path = "/v1/score", operation_id = "score", tag = "score",
    request_body(content = ref("#/components/schemas/ScoreRequest"), content_type = "application/json",
        example = json!({"scene_id": "demo-crossing"})),
    responses((status = 200, description = "the score", body = ref("#/components/schemas/ScoreReply")),
        Refused))]
pub async fn score(
    State(app): State<App>,
    connection: Connection,
    WithScene(request, about): WithScene<ScoreRequest>,
) -> Result<JsonText, Problem> {
    let generator = Arc::clone(&app.generator);
    let scene = &about.scene;
    // Measured: 256 road users over 600 steps take half a second.
    let cost = Duration::from_nanos(3_200 * (scene.agents.len() * scene.time.steps) as u64);
    let asked = Asked { kind: Kind::Score, cost, caller: connection.into() };
    app.pool.run(asked, move |_| JsonText::of(&of(&about, &request, generator.maps())?)).await
}

/// Numbers out of their range.
pub fn beyond(thresholds: &Thresholds) -> impl Iterator<Item = FieldProblem> {
    thresholds.outside().map(|(threshold, got)| {
        let (least, most) = threshold.range;
        FieldProblem::range(format!("/thresholds/{}", threshold.name), least, most, got)
    })
}

fn of(about: &Subject, request: &ScoreRequest, maps: &Maps) -> Result<Score, Problem> {
    let scene = &about.scene;
    let mut faults: Vec<FieldProblem> = beyond(&request.thresholds).collect();
    let mut sample = scene.generated.as_ref().and_then(|g| g.samples.get(g.chosen_sample)).cloned();
    for (id, doc) in &request.trajectories.0 {
        let Some(states) = states(scene, "/trajectories", id, doc, &mut faults) else { continue };
        let future = Future::bare(1.0, doc.first_step as usize, states);
        let futures = AgentFutures::of(0, vec![future]);
        sample.get_or_insert_with(Sample::default).agents.insert(id.clone(), futures);
    }
    let mut references: BTreeMap<&str, Track> = BTreeMap::new();
    if let Some(Reference::Given(given)) = &request.reference {
        for (id, doc) in &given.0 {
            let Some(states) = states(scene, "/reference", id, doc, &mut faults) else { continue };
            let states = states.into_iter().map(Some).collect();
            references.insert(id, Track { first_step: doc.first_step as usize, states, z_m: None });
        }
    }
    if !faults.is_empty() {
        return Err(ReadError::invalid(faults).into());
    }
    let drivable = maps.drivable(&scene.map);
    let mut input = ScoreInput::of_sample(scene, sample.as_ref(), &drivable);
    for actor in &mut input.actors {
        if let Some(track) = references.get(actor.id) {
            actor.reference = Some(track);
        }
    }
    input.pairs = request.pairs;
    input.thresholds = request.thresholds;
    let changed = request.trajectories.0.len() + references.len();
    Ok(scoring::of(&input, changed, about.standings.as_deref()))
}

/// The motion of a document, or its faults.
fn states(
    scene: &Scene,
    base: &str,
    id: &str,
    doc: &TrajectoryDoc,
    faults: &mut Vec<FieldProblem>,
) -> Option<Vec<AgentState>> {
    let at = format!("{base}/{}", pointer_token(id));
    let before = faults.len();
    if scene.agent(id).is_none() {
        faults.push(FieldProblem::new(
            at.clone(),
            formats::problem::code::UNKNOWN_AGENT,
            "the scene has no such road user",
        ));
    }
    let (first, steps) = (doc.first_step as f64, doc.x_m.len());
    if first + steps as f64 > 1_000.0 {
        faults.push(FieldProblem::range(format!("{at}/first_step"), 0.0, 1_000.0 - steps as f64, first));
    }
    let columns = [&doc.y_m, &doc.heading_rad, &doc.vx_mps, &doc.vy_mps];
    if columns.iter().any(|column| column.len() != steps) || steps == 0 {
        let detail = "columns of equal length with at least one value expected";
        faults.push(FieldProblem::new(at.clone(), "invalid-field", detail));
    }
    let bounds = [
        (&doc.x_m, 1e5),
        (&doc.y_m, 1e5),
        (&doc.heading_rad, 1e3),
        (&doc.vx_mps, 150.0),
        (&doc.vy_mps, 150.0),
    ];
    for (column, most) in bounds {
        if let Some(bad) = column.iter().find(|v| !v.is_finite() || v.abs() > most) {
            faults.push(FieldProblem::range(at.clone(), -most, most, *bad));
        }
    }
    if faults.len() > before {
        return None;
    }
    let rows = doc.x_m.iter().zip(&doc.y_m).zip(&doc.heading_rad).zip(&doc.vx_mps).zip(&doc.vy_mps);
    let states = rows.map(|((((x_m, y_m), heading_rad), vx_mps), vy_mps)| AgentState {
        x_m: *x_m,
        y_m: *y_m,
        heading_rad: *heading_rad,
        vx_mps: *vx_mps,
        vy_mps: *vy_mps,
    });
    Some(states.collect())
}
