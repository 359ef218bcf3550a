//! Road users in a scene document.

use super::conditions::ConditionsDoc;
use super::resolve::{Context, Window};
use super::value::{id, words};
use crate::limits::{MAX_STEPS, MAX_WORD};
use crate::problem::{FieldProblem, Problems};
use crate::refusals::{self, wanted};
use scene::{Agent, AgentType, Conditions, Size, State, Subtype, Track};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};

fn agent_types(_: &mut SchemaGenerator) -> Schema {
    words(&["vehicle", "pedestrian", "cyclist", "other"])
}

fn subtypes(_: &mut SchemaGenerator) -> Schema {
    words(&[
        "car",
        "truck",
        "bus",
        "van",
        "motorcycle",
        "trailer",
        "emergency",
        "adult",
        "child",
        "wheelchair",
        "scooter",
        "bicycle",
        "unknown",
    ])
}

/// Recorded states as columns, one value per step from `first_step`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrackDoc {
    /// Scene step of the first value.
    #[schemars(range(max = 599))]
    pub first_step: u64,
    /// Half-open ranges of scene steps at which the road user was seen; all when absent. Values
    /// outside them are written as 0 and ignored.
    #[serde(default)]
    pub valid: Option<Vec<[u64; 2]>>,
    /// Box centre, metres.
    pub x_m: Vec<f64>,
    /// Box centre, metres.
    pub y_m: Vec<f64>,
    /// Box centre's height, metres.
    #[serde(default)]
    pub z_m: Option<Vec<f64>>,
    /// Radians.
    pub heading_rad: Vec<f64>,
    /// m/s.
    pub vx_mps: Vec<f64>,
    /// m/s.
    pub vy_mps: Vec<f64>,
}

impl TrackDoc {
    /// The document of a track.
    pub fn from_track(track: &Track) -> Self {
        let column = |f: fn(&State) -> f64| -> Vec<f64> {
            track.states.iter().map(|s| s.as_ref().map_or(0.0, f)).collect()
        };
        let heights = |z: &Vec<f64>| {
            let seen = track.states.iter().map(Option::is_some);
            z.iter().zip(seen).map(|(z, seen)| if seen { *z } else { 0.0 }).collect()
        };
        Self {
            first_step: track.first_step as u64,
            valid: Some(valid_ranges(track)),
            x_m: column(|s| s.x_m),
            y_m: column(|s| s.y_m),
            z_m: track.z_m.as_ref().map(heights),
            heading_rad: column(|s| s.heading_rad),
            vx_mps: column(|s| s.vx_mps),
            vy_mps: column(|s| s.vy_mps),
        }
    }

    pub(crate) fn into_track(self, pointer: &str, problems: &mut Problems) -> Track {
        let steps = self.x_m.len();
        let before = problems.0.len();
        let columns = [
            ("y_m", &self.y_m),
            ("heading_rad", &self.heading_rad),
            ("vx_mps", &self.vx_mps),
            ("vy_mps", &self.vy_mps),
        ];
        for (name, column) in columns.into_iter().chain(self.z_m.as_ref().map(|z| ("z_m", z))) {
            if column.len() != steps {
                let message = refusals::unequal_columns(column.len(), steps, "x_m");
                problems.invalid(format!("{pointer}/{name}"), message);
            }
        }
        let last_step = (MAX_STEPS - 1) as u64;
        if self.first_step > last_step {
            let at = format!("{pointer}/first_step");
            problems.push(FieldProblem::range(at, 0.0, last_step as f64, self.first_step as f64));
        }
        let seen = self.seen(steps, pointer, problems);
        if problems.0.len() > before {
            return Track::default();
        }
        let values =
            self.x_m.iter().zip(&self.y_m).zip(&self.heading_rad).zip(&self.vx_mps).zip(&self.vy_mps);
        let states = values
            .zip(&seen)
            .map(|(((((x_m, y_m), heading_rad), vx_mps), vy_mps), seen)| {
                let state = State {
                    x_m: *x_m,
                    y_m: *y_m,
                    heading_rad: *heading_rad,
                    vx_mps: *vx_mps,
                    vy_mps: *vy_mps,
                };
                seen.then_some(state)
            })
            .collect();
        let mut z_m = self.z_m;
        for (z, seen) in z_m.iter_mut().flatten().zip(&seen) {
            if !seen {
                *z = 0.0;
            }
        }
        Track { first_step: self.first_step as usize, states, z_m }
    }

    /// For each step, whether the track has a value.
    fn seen(&self, steps: usize, pointer: &str, problems: &mut Problems) -> Vec<bool> {
        let Some(ranges) = &self.valid else { return vec![true; steps] };
        let mut seen = vec![false; steps];
        let mut free_from = self.first_step;
        let end = self.first_step.saturating_add(steps as u64);
        for (i, [from, to]) in ranges.iter().enumerate() {
            if *from < free_from || to <= from || *to > end {
                let message = refusals::found_expected(format!("[{from}, {to})"), wanted::RANGES);
                problems.invalid(format!("{pointer}/valid/{i}"), message);
                break;
            }
            let slots = seen.iter_mut().skip((from - self.first_step) as usize);
            slots.take((to - from) as usize).for_each(|slot| *slot = true);
            free_from = *to;
        }
        seen
    }
}

fn valid_ranges(track: &Track) -> Vec<[u64; 2]> {
    let mut ranges: Vec<[u64; 2]> = Vec::new();
    for step in track.valid_steps() {
        let step = step as u64;
        match ranges.last_mut() {
            Some(range) if range[1] == step => range[1] += 1,
            _ => ranges.push([step, step + 1]),
        }
    }
    ranges
}

/// One road user.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AgentDoc {
    /// Id, unique in the scene, `[A-Za-z0-9_.:-]{1,64}`.
    #[schemars(schema_with = "id")]
    pub id: String,
    /// Type, which selects expert and motion model; `other` is shown, but never regenerated.
    #[serde(rename = "type")]
    #[schemars(schema_with = "agent_types")]
    pub agent_type: AgentType,
    /// Finer type, which sets default size and limits.
    #[serde(default)]
    #[schemars(schema_with = "subtypes")]
    pub subtype: Subtype,
    /// Role in the source, such as `ego`.
    #[serde(default)]
    pub role: Option<String>,
    /// Length, metres. Default: that of the subtype.
    #[serde(default)]
    #[schemars(range(min = 0.05, max = 60.0))]
    pub length_m: Option<f64>,
    /// Width, metres. Default: that of the subtype.
    #[serde(default)]
    #[schemars(range(min = 0.05, max = 60.0))]
    pub width_m: Option<f64>,
    /// Height, metres.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 60.0))]
    pub height_m: Option<f64>,
    /// Recorded track; empty when absent.
    #[serde(default)]
    pub track: TrackDoc,
    /// Conditions fixed by the user.
    #[serde(default)]
    pub conditions: ConditionsDoc,
}

impl AgentDoc {
    /// The document of a road user.
    pub fn from_agent(agent: &Agent) -> Self {
        Self {
            id: agent.id.clone(),
            agent_type: agent.agent_type,
            subtype: agent.subtype,
            role: agent.role.clone(),
            length_m: Some(agent.size.length_m),
            width_m: Some(agent.size.width_m),
            height_m: agent.size.height_m,
            track: TrackDoc::from_track(&agent.track),
            conditions: ConditionsDoc::from_conditions(&agent.conditions),
        }
    }

    /// Converts to the domain's road user. `pointer` is the JSON pointer of this document, such as
    /// `/add_agents/0`.
    ///
    /// # Errors
    /// All faults of its track and conditions. `Scene::checked` checks ids and sizes.
    pub fn into_agent(self, pointer: &str) -> Result<Agent, Vec<FieldProblem>> {
        let mut problems = Problems::default();
        let defaults = Size::default_for(self.agent_type, self.subtype);
        if let Some(height_m) = self.height_m {
            problems.range(&format!("{pointer}/height_m"), (0.0, 60.0), height_m);
        }
        problems.length(&format!("{pointer}/role"), MAX_WORD, self.role.as_ref());
        let track = self.track.into_track(&format!("{pointer}/track"), &mut problems);
        let start = track.valid_steps().next().and_then(|step| track.at(step)).copied();
        let context = Context { agent_type: self.agent_type, start, window: Window::default() };
        let conditions =
            self.conditions.resolve(&format!("{pointer}/conditions"), &context).unwrap_or_else(|faults| {
                faults.into_iter().for_each(|fault| problems.push(fault));
                Conditions::default()
            });
        if !problems.0.is_empty() {
            return Err(problems.0);
        }
        let size = Size {
            length_m: self.length_m.unwrap_or(defaults.length_m),
            width_m: self.width_m.unwrap_or(defaults.width_m),
            height_m: self.height_m,
        };
        Ok(Agent {
            id: self.id,
            agent_type: self.agent_type,
            subtype: self.subtype,
            role: self.role,
            size,
            track: track.into(),
            conditions,
        })
    }
}
