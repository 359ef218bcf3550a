//! The whole scene document.

use super::agent::AgentDoc;
use super::any::AnyDoc;
use super::generated::GeneratedDoc;
use super::map::{MapDoc, MapField, MapRef};
use super::value::{Members, PointDoc};
use crate::limits::{MAX_AGENTS, MAX_STEPS, MAX_WORD};
use crate::lists::bounded;
use crate::problem::{FieldProblem, Problems, ReadError, code};
use crate::refusals::{self, expected, wanted};
use scene::{Agent, ContentHash, LaneMap, Meta, Origin, STEP_S, Scene, Shared, Signal, SignalState, Timing};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

/// Value of the `format` member.
pub const FORMAT: &str = "dragtraffic.scene";
/// Newest version that this reader knows.
pub const VERSION: u64 = 1;

/// Position of the scene in its source's frame: `source = rotate(scene, rotation_rad) + (x, y, z)`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[allow(missing_docs, reason = "the names say it")]
pub struct OriginDoc {
    #[schemars(range(min = -1e9, max = 1e9))]
    pub x_m: f64,
    #[schemars(range(min = -1e9, max = 1e9))]
    pub y_m: f64,
    #[schemars(range(min = -1e9, max = 1e9))]
    pub z_m: f64,
    #[schemars(range(min = -1e9, max = 1e9))]
    pub rotation_rad: f64,
    pub crs: Option<String>,
}

/// Source of the scene, and notes on it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MetaDoc {
    /// Format or tool, such as `womd`, `drawn`, `synthetic`.
    pub source: String,
    /// Id in the source.
    pub source_id: Option<String>,
    /// Licence of the content, such as `waymo-nc` or `cc0`.
    pub licence: Option<String>,
    /// Frame of the source.
    pub origin: OriginDoc,
    /// Scene that this one is a variant of.
    pub parent_id: Option<String>,
    /// Search terms.
    #[schemars(length(max = 256))]
    #[serde(deserialize_with = "bounded::<_, _, 256>")]
    pub tags: Vec<String>,
    /// Free text.
    #[schemars(length(max = 10_000))]
    pub notes: String,
    /// Version of the program that made it.
    pub created_with: Option<String>,
    /// WOMD's objects of interest, by road user id.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "bounded::<_, _, MAX_AGENTS>")]
    pub objects_of_interest: Vec<String>,
    /// WOMD's tracks to predict: id of the road user, and difficulty.
    #[serde(skip_serializing_if = "Vec::is_empty", deserialize_with = "bounded::<_, _, MAX_AGENTS>")]
    pub tracks_to_predict: Vec<(String, u32)>,
    /// The source's times of the steps, seconds, when they are not exactly 0.1 s apart from zero.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timestamps_s: Option<Vec<f64>>,
}

/// Steps of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeDoc {
    /// Always 0.1.
    #[serde(default = "step_s")]
    #[schemars(extend("const" = 0.1))]
    pub step_s: f64,
    /// Number of steps of the scene.
    #[schemars(range(min = 1, max = 600))]
    pub steps: u64,
    /// The source's "current" step.
    #[serde(default)]
    #[schemars(range(max = 599))]
    pub now_step: u64,
}

fn step_s() -> f64 {
    STEP_S
}

/// A run of a signal: its first step and its state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunDoc(pub u64, pub SignalState);

impl JsonSchema for RunDoc {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "SignalRun".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "[first step, state]",
            "type": "array",
            "prefixItems": [
                {"type": "integer", "minimum": 0, "maximum": 599},
                {"type": "string", "enum": ["unknown", "arrow_stop", "arrow_caution", "arrow_go", "stop",
                    "caution", "go", "flashing_stop", "flashing_caution"]}
            ],
            "minItems": 2,
            "maxItems": 2
        })
    }
}

/// The signal of one lane over the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SignalDoc {
    /// Id of the lane that obeys it.
    pub lane: String,
    /// Stop position.
    #[serde(default)]
    pub stop_m: Option<PointDoc>,
    /// Run-length encoded states, in order of their first steps.
    #[schemars(length(min = 1))]
    #[serde(deserialize_with = "bounded::<_, _, MAX_STEPS>")]
    pub states: Vec<RunDoc>,
}

/// Form of the map in a document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapForm {
    /// The whole map.
    Inline,
    /// `{"ref":"sha256:HEX"}`, for a reader that knows the map.
    Ref,
}

/// A scene document, version 1.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "DragTraffic scene", transform = only_x_members)]
pub struct SceneDoc {
    /// `dragtraffic.scene`.
    #[schemars(extend("const" = "dragtraffic.scene"))]
    pub format: String,
    /// 1.
    #[schemars(extend("const" = 1))]
    pub version: u64,
    /// Set by the server.
    #[serde(default)]
    pub id: Option<String>,
    /// Display name.
    #[serde(default)]
    #[schemars(length(max = 200))]
    pub name: String,
    /// Source and notes.
    #[serde(default)]
    pub meta: MetaDoc,
    /// Steps.
    pub time: TimeDoc,
    /// Map, or its hash.
    pub map: MapField,
    /// Traffic signals.
    #[serde(default)]
    #[schemars(length(max = 512))]
    pub signals: Vec<SignalDoc>,
    /// Road users.
    #[serde(default)]
    #[schemars(length(max = 256))]
    pub agents: Vec<AgentDoc>,
    /// Futures added by the generator.
    #[serde(default)]
    pub generated: Option<GeneratedDoc>,
    /// Members under `x_` keys, kept unchanged; any other is refused.
    #[serde(flatten)]
    pub extra: Members<AnyDoc>,
}

/// Schema of "other members only under `x_` keys", which serde's flatten cannot express.
fn only_x_members(schema: &mut Schema) {
    schema.insert("additionalProperties".into(), false.into());
    schema.insert("patternProperties".into(), serde_json::json!({"^x_": true}));
}

impl SceneDoc {
    /// Converts to the domain's scene. `resolve_map` returns the map of a known hash.
    ///
    /// # Errors
    /// `unsupported-version`, `unknown-map`, and all faults of fields with their JSON pointers.
    pub fn into_scene(
        self,
        resolve_map: impl FnOnce(&ContentHash) -> Option<Shared<LaneMap>>,
    ) -> Result<Scene, ReadError> {
        self.check_head()?;
        let map = self.map.into_map(resolve_map)?;
        let mut problems = Problems::default();
        let time = self.time.into_timing(&mut problems);
        let meta = self.meta.into_meta(&mut problems);
        let signals = self.signals.into_iter().map(SignalDoc::into_signal).collect();
        let mut agents: Vec<Agent> = Vec::new();
        for (i, agent) in self.agents.into_iter().enumerate() {
            match agent.into_agent(&format!("/agents/{i}")) {
                Ok(agent) => agents.push(agent),
                Err(faults) => faults.into_iter().for_each(|fault| problems.push(fault)),
            }
        }
        let generated = self.generated.map(|g| g.into_generated("/generated", &mut problems));
        if !problems.0.is_empty() {
            return Err(ReadError::invalid(problems.0));
        }
        let extra = self.extra.0.into_iter().map(|(key, value)| (key, value.0)).collect();
        let scene =
            Scene { id: self.id, name: self.name, meta, time, map, signals, agents, generated, extra };
        scene
            .checked()
            .map_err(|faults| ReadError::invalid(faults.into_iter().map(FieldProblem::from).collect()))
    }

    /// The document of a scene.
    pub fn from_scene(scene: &Scene, form: MapForm) -> Self {
        let map = match form {
            MapForm::Inline => MapField::Inline(MapDoc::from_map(&scene.map)),
            MapForm::Ref => MapField::Ref(MapRef { hash: format!("sha256:{}", scene.map.hash()) }),
        };
        let extra = scene.extra.iter().map(|(key, value)| (key.clone(), AnyDoc(value.clone()))).collect();
        Self {
            format: FORMAT.into(),
            version: VERSION,
            id: scene.id.clone(),
            name: scene.name.clone(),
            meta: MetaDoc::from_meta(&scene.meta),
            time: TimeDoc {
                step_s: STEP_S,
                steps: scene.time.steps as u64,
                now_step: scene.time.now_step as u64,
            },
            map,
            signals: scene.signals.iter().map(SignalDoc::from_signal).collect(),
            agents: scene.agents.iter().map(AgentDoc::from_agent).collect(),
            generated: scene.generated.as_ref().map(GeneratedDoc::from_generated),
            extra: Members(extra),
        }
    }

    fn check_head(&self) -> Result<(), ReadError> {
        if self.format != FORMAT {
            let message = expected(format!("\"{FORMAT}\""));
            return Err(FieldProblem::new("/format", code::INVALID_FIELD, message).into());
        }
        check_version(self.version)
    }
}

/// Refuses versions that this reader does not know.
pub(crate) fn check_version(version: u64) -> Result<(), ReadError> {
    match version {
        VERSION => Ok(()),
        0 => Err(FieldProblem::new("/version", code::INVALID_FIELD, expected(wanted::VERSION)).into()),
        _ => {
            let message = refusals::unsupported_version(version, VERSION);
            Err(FieldProblem::new("/version", code::UNSUPPORTED_VERSION, message).into())
        }
    }
}

impl TimeDoc {
    fn into_timing(self, problems: &mut Problems) -> Timing {
        if self.step_s != STEP_S {
            problems.invalid(
                "/time/step_s",
                refusals::found_expected(self.step_s.to_string(), STEP_S.to_string()),
            );
        }
        let fit = |value: u64| usize::try_from(value).unwrap_or(usize::MAX);
        Timing { steps: fit(self.steps), now_step: fit(self.now_step) }
    }
}

impl SignalDoc {
    fn into_signal(self) -> Signal {
        Signal {
            lane: self.lane,
            stop: self.stop_m.map(PointDoc::xy),
            stop_z_m: self.stop_m.and_then(|p| p.z),
            runs: self
                .states
                .into_iter()
                .map(|r| (usize::try_from(r.0).unwrap_or(usize::MAX), r.1))
                .collect(),
        }
    }

    fn from_signal(signal: &Signal) -> Self {
        Self {
            lane: signal.lane.clone(),
            stop_m: signal.stop.map(|p| PointDoc::new(p, signal.stop_z_m)),
            states: signal.runs.iter().map(|r| RunDoc(r.0 as u64, r.1)).collect(),
        }
    }
}

impl MetaDoc {
    fn into_meta(self, problems: &mut Problems) -> Meta {
        let origin = &self.origin;
        let values = [
            ("x_m", origin.x_m),
            ("y_m", origin.y_m),
            ("z_m", origin.z_m),
            ("rotation_rad", origin.rotation_rad),
        ];
        for (name, value) in values {
            problems.range(&format!("/meta/origin/{name}"), (-1e9, 1e9), value);
        }
        let texts = [
            ("source", Some(&self.source), MAX_WORD),
            ("source_id", self.source_id.as_ref(), MAX_WORD),
            ("licence", self.licence.as_ref(), MAX_WORD),
            ("parent_id", self.parent_id.as_ref(), MAX_WORD),
            ("created_with", self.created_with.as_ref(), MAX_WORD),
            ("origin/crs", self.origin.crs.as_ref(), 8_192),
            ("notes", Some(&self.notes), 65_536),
        ];
        for (name, text, most) in texts {
            problems.length(&format!("/meta/{name}"), most, text);
        }
        let origin = self.origin;
        Meta {
            source: self.source,
            source_id: self.source_id,
            licence: self.licence,
            origin: Origin {
                x_m: origin.x_m,
                y_m: origin.y_m,
                z_m: origin.z_m,
                rotation_rad: origin.rotation_rad,
                crs: origin.crs,
            },
            parent_id: self.parent_id,
            tags: self.tags,
            notes: self.notes,
            created_with: self.created_with,
            objects_of_interest: self.objects_of_interest,
            tracks_to_predict: self.tracks_to_predict,
            timestamps_s: self.timestamps_s,
        }
    }

    fn from_meta(meta: &Meta) -> Self {
        let origin = &meta.origin;
        Self {
            source: meta.source.clone(),
            source_id: meta.source_id.clone(),
            licence: meta.licence.clone(),
            origin: OriginDoc {
                x_m: origin.x_m,
                y_m: origin.y_m,
                z_m: origin.z_m,
                rotation_rad: origin.rotation_rad,
                crs: origin.crs.clone(),
            },
            parent_id: meta.parent_id.clone(),
            tags: meta.tags.clone(),
            notes: meta.notes.clone(),
            created_with: meta.created_with.clone(),
            objects_of_interest: meta.objects_of_interest.clone(),
            tracks_to_predict: meta.tracks_to_predict.clone(),
            timestamps_s: meta.timestamps_s.clone(),
        }
    }
}
