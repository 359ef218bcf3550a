//! Score: collisions, near misses, off-road driving, kinematics, goals.

use crate::english::wanted;
use crate::home::{AboutScene, SceneRef, Subject, one_scene};
use crate::opened::Standings;
use crate::problem::{Problem, refuse, unknown_agent};
use experts::Maps;
use formats::native::{Members, SceneDoc};
use formats::refusals::expected;
use formats::{FieldProblem, pointer_token};
use scene::score::{PairChoice, Score, ScoreInput, Thresholds};
use scene::{AgentFutures, Future, Sample, Scene, State as AgentState, Track};
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, IntoDeserializer, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;
use std::fmt;

/// Motion of one road user as columns, one value per step from `first_step`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs, reason = "the names say it")]
pub struct TrajectoryDoc {
    /// Scene step of the first value.
    #[schemars(range(max = 599))]
    pub first_step: u64,
    pub x_m: Vec<f64>,
    pub y_m: Vec<f64>,
    pub heading_rad: Vec<f64>,
    pub vx_mps: Vec<f64>,
    pub vy_mps: Vec<f64>,
}

/// Motion with which trajectories are compared.
#[derive(Clone, Debug, JsonSchema)]
#[schemars(untagged, rename = "Reference")]
pub enum ReferenceMotion {
    /// `"log"`.
    Word(LogWord),
    /// Motion by road user.
    Given(Members<TrajectoryDoc>),
}

impl<'de> Deserialize<'de> for ReferenceMotion {
    /// Parses the input directly: serde's untagged enums buffer it, which would lose the positions of faults.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = ReferenceMotion;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"log\" or motion by road user")
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<ReferenceMotion, E> {
                LogWord::deserialize(word.into_deserializer()).map(ReferenceMotion::Word)
            }

            fn visit_map<A: MapAccess<'de>>(self, members: A) -> Result<ReferenceMotion, A::Error> {
                Members::deserialize(MapAccessDeserializer::new(members)).map(ReferenceMotion::Given)
            }
        }

        deserializer.deserialize_any(Either)
    }
}

/// The value `log`.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Log")]
pub enum LogWord {
    /// The recording.
    Log,
}

/// Body of a score. Exactly one of `scene` and `scene_id` is given.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = one_scene)]
pub struct ScoreRequest {
    /// The scene itself.
    pub scene: Option<SceneDoc>,
    /// A scene of this server.
    pub scene_id: Option<String>,
    /// With `scene_id`: the call is refused if the scene has changed.
    pub etag: Option<String>,
    /// Motion to score, by road user; the others are scored with their chosen future, else with the log.
    pub trajectories: Members<TrajectoryDoc>,
    /// Reference; the log by default.
    pub reference: Option<ReferenceMotion>,
    /// `all` or `regenerated`.
    pub pairs: PairChoice,
    /// Thresholds; absent ones have their defaults.
    pub thresholds: Thresholds,
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

/// Thresholds out of their range.
pub(crate) fn beyond(thresholds: &Thresholds) -> impl Iterator<Item = FieldProblem> {
    thresholds.outside().map(|(threshold, got)| {
        let (least, most) = threshold.range;
        FieldProblem::range(format!("/thresholds/{}", threshold.name), least, most, got)
    })
}

/// Scores a scene: chosen futures or the given motion, and the log of the rest.
///
/// # Errors
/// Every fault of the given motion and thresholds.
pub fn score(about: &Subject, request: &ScoreRequest, maps: &Maps) -> Result<Score, Problem> {
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
    if let Some(ReferenceMotion::Given(given)) = &request.reference {
        for (id, doc) in &given.0 {
            let Some(states) = states(scene, "/reference", id, doc, &mut faults) else { continue };
            let states = states.into_iter().map(Some).collect();
            references.insert(id, Track { first_step: doc.first_step as usize, states, z_m: None });
        }
    }
    refuse(faults)?;
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
    Ok(with_standings(&input, changed, about.standings.as_deref()))
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
        faults.push(unknown_agent(at.clone(), id));
    }
    let (first, steps) = (doc.first_step as f64, doc.x_m.len());
    if first + steps as f64 > 1_000.0 {
        faults.push(FieldProblem::range(format!("{at}/first_step"), 0.0, 1_000.0 - steps as f64, first));
    }
    let columns = [&doc.y_m, &doc.heading_rad, &doc.vx_mps, &doc.vy_mps];
    if columns.iter().any(|column| column.len() != steps) || steps == 0 {
        faults.push(FieldProblem::new(at.clone(), "invalid-field", expected(wanted::COLUMNS)));
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

/// Score of an input in which `changed` road users move differently from the unchanged scene.
pub(crate) fn with_standings(input: &ScoreInput<'_>, changed: usize, standings: Option<&Standings>) -> Score {
    let usual = input.pairs == PairChoice::default() && input.thresholds == Thresholds::default();
    // If most road users have changed, the cached scores save nothing.
    match standings.filter(|_| usual && 2 * changed <= input.actors.len()) {
        Some(standings) => standings.over(&input.steps, input.drivable).score(input),
        None => scene::score::score(input),
    }
}
