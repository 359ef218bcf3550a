//! Metadata of a Parquet table: frame, licence and time of its scenes, under the key `dragtraffic`.

use scene::{Meta, Origin, Scene, Timing};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name of the note in the file.
pub(super) const KEY: &str = "dragtraffic";

/// All metadata.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Notes {
    format: String,
    version: u32,
    units: String,
    frame: String,
    pub scenes: Vec<SceneNote>,
}

/// Metadata of one scene.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct SceneNote {
    pub scenario_id: String,
    source: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    source_id: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    licence: Option<String>,
    origin: OriginNote,
    steps: usize,
    now_step: usize,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub roles: BTreeMap<String, String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    timestamps_s: Option<Vec<f64>>,
}

/// Origin of the scene in the frame of the rows: `row = rotate(scene, rotation_rad) + (x_m, y_m, z_m)`.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct OriginNote {
    x_m: f64,
    y_m: f64,
    z_m: f64,
    rotation_rad: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    crs: Option<String>,
}

impl Notes {
    /// Metadata of scenes by their names in the table.
    pub fn of(scenes: &[(&Scene, String)]) -> Self {
        let note = |(scene, name): &(&Scene, String)| {
            let Origin { x_m, y_m, z_m, rotation_rad, crs } = scene.meta.origin.clone();
            let roles = scene.agents.iter().filter_map(|agent| Some((agent.id.clone(), agent.role.clone()?)));
            SceneNote {
                scenario_id: name.clone(),
                source: scene.meta.source.clone(),
                source_id: scene.meta.source_id.clone(),
                licence: scene.licence(),
                origin: OriginNote { x_m, y_m, z_m, rotation_rad, crs },
                steps: scene.time.steps,
                now_step: scene.time.now_step,
                roles: roles.collect(),
                timestamps_s: scene.meta.timestamps_s.clone(),
            }
        };
        Self {
            format: "dragtraffic.table".into(),
            version: 1,
            units: "metres, seconds, radians; in the columns' names".into(),
            frame: "x east, y north (or the source's axes), heading counter-clockwise from +x; the origin of each \
                    scene is added back; positions are centres of boxes"
                .into(),
            scenes: scenes.iter().map(note).collect(),
        }
    }
}

impl SceneNote {
    /// Its information about a scene that is read.
    pub fn meta(&self) -> Meta {
        Meta {
            source: self.source.clone(),
            source_id: self.source_id.clone(),
            licence: self.licence.clone(),
            timestamps_s: self.timestamps_s.clone().filter(|times| times.len() == self.steps),
            ..Meta::default()
        }
    }

    /// Origin of the scene; `None` if a value is out of range.
    pub fn origin(&self) -> Option<Origin> {
        let OriginNote { x_m, y_m, z_m, rotation_rad, crs } = &self.origin;
        let fits = [x_m, y_m, z_m, rotation_rad].iter().all(|value| value.abs() <= 1e9);
        fits.then(|| Origin {
            x_m: *x_m,
            y_m: *y_m,
            z_m: *z_m,
            rotation_rad: *rotation_rad,
            crs: crs.clone(),
        })
    }

    /// Timing of the scene.
    pub fn timing(&self) -> Timing {
        Timing { steps: self.steps, now_step: self.now_step }
    }
}
