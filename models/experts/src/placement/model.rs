//! The learned model: occupancy of cells, and pose and speed of their road users.
//!
//! Rates are log-linear: a rate per metre (per driveway) times one factor for each feature of the cell.
//! Everything else is histograms by context. The model is one small, readable JSON file.

use super::cells::{CellKind, FEATURES, MapCell};
use super::context::{PoseContext, SpeedContext};
use crate::weights::{PLACEMENT_FILE, WeightsError};
use scene::{AgentType, ContentHash};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Value of `format` in a weights file.
pub const FORMAT: &str = "dragtraffic.placement";
/// Value of `version`.
pub const VERSION: u32 = 2;
/// Largest weights file that is read, bytes.
const MAX_BYTES: usize = 1 << 20;
/// Classes of a speed histogram: standing, then shares of the speed that the place allows.
pub const SPEED_CLASSES: usize = 24;
/// Width of the speed classes after the first, as a share of the allowed speed.
pub const SPEED_STEP: f64 = 0.07;

/// A histogram, uniform within a class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Histogram {
    /// Lower bound of the first class.
    pub low: f64,
    /// Width of a class.
    pub step: f64,
    /// Share of each class; they sum to one.
    pub share: Vec<f64>,
}

/// Rate at which cells of one kind are occupied.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rate {
    /// Road users per metre (per driveway) if all factors are one.
    pub per_m: f64,
    /// Factors by feature of the cell, then by class of the feature.
    pub factors: Vec<Vec<f64>>,
}

/// What was learned about one type.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TypeModel {
    /// By kind of cell.
    pub rates: BTreeMap<CellKind, Rate>,
    /// Boxes by kind of cell: length and width in metres, share.
    pub sizes: BTreeMap<CellKind, Vec<[f64; 3]>>,
    /// Offsets across the line of the cell by situation, metres; on crosswalks in half widths.
    pub lateral: BTreeMap<PoseContext, Histogram>,
    /// Heading against the line of the cell by situation, radians.
    pub heading: BTreeMap<PoseContext, Histogram>,
    /// Speeds as shares of what the place allows by situation, [`SPEED_CLASSES`] each.
    pub speed: BTreeMap<SpeedContext, Vec<f64>>,
}

/// The content of a weights file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlacementModel {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`].
    pub version: u32,
    /// Licence of the numbers.
    pub licence: String,
    /// Data that the numbers were learned from.
    pub trained_on: String,
    /// Number of scenes that they were learned from.
    pub scenes: u64,
    /// By type.
    pub types: BTreeMap<AgentType, TypeModel>,
}

/// Description of the placement weights.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PlacementInfo {
    pub sha256: String,
    pub numbers: usize,
    pub licence: String,
    pub trained_on: String,
}

impl Histogram {
    fn is_sound(&self) -> bool {
        let total: f64 = self.share.iter().sum();
        let finite = self.low.is_finite() && self.step > 0.0 && self.step.is_finite();
        finite && self.share.len() <= 1_000 && shares(&self.share) && total > 0.0
    }
}

fn shares(values: &[f64]) -> bool {
    values.iter().all(|v| *v >= 0.0 && v.is_finite())
}

impl Rate {
    /// Expected number of road users in a cell.
    pub(super) fn of(&self, cell: &MapCell) -> f64 {
        cell.extent() * self.per_m * self.factor(&cell.features)
    }

    /// Product of the factors of a cell's features.
    pub fn factor(&self, features: &[u8; FEATURES]) -> f64 {
        let each = self.factors.iter().zip(features);
        each.map(|(factors, class)| factors.get(usize::from(*class)).copied().unwrap_or(0.0)).product()
    }
}

impl PlacementModel {
    /// Reads a weights file.
    ///
    /// # Errors
    /// When it has another form, or contains impossible numbers.
    pub fn load(bytes: &[u8]) -> Result<Self, WeightsError> {
        let wrong = |reason: String| WeightsError { path: PLACEMENT_FILE.to_owned(), reason };
        if bytes.len() > MAX_BYTES {
            return Err(wrong(format!("{} bytes, at most {MAX_BYTES} expected", bytes.len())));
        }
        let model: Self = serde_json::from_slice(bytes).map_err(|e| wrong(e.to_string()))?;
        model.check().map_err(wrong)?;
        Ok(model)
    }

    fn check(&self) -> Result<(), String> {
        if self.format != FORMAT || self.version != VERSION {
            return Err(format!(
                "{} version {} found, {FORMAT} version {VERSION} expected",
                self.format, self.version
            ));
        }
        for (agent_type, model) in &self.types {
            for (kind, rate) in &model.rates {
                let classes = kind.feature_classes();
                let fits = rate.factors.len() == classes.len()
                    && rate.factors.iter().zip(classes).all(|(f, n)| f.len() == *n && shares(f));
                if !fits || !shares(&[rate.per_m]) {
                    return Err(format!("{agent_type:?}: rates of {kind:?} have the wrong form"));
                }
            }
            let boxes = model.sizes.values().flatten();
            let sound =
                |b: &[f64; 3]| (0.2..=25.0).contains(&b[0]) && (0.2..=4.0).contains(&b[1]) && b[2] >= 0.0;
            if !boxes.into_iter().all(sound) {
                return Err(format!("{agent_type:?}: a box is out of range"));
            }
            if !model.lateral.values().chain(model.heading.values()).all(Histogram::is_sound) {
                return Err(format!("{agent_type:?}: a histogram has the wrong form"));
            }
            if !model.speed.values().all(|row| row.len() == SPEED_CLASSES && shares(row)) {
                return Err(format!("{agent_type:?}: speeds have the wrong form"));
            }
        }
        Ok(())
    }

    /// The file's bytes; equal models give equal bytes.
    ///
    /// # Errors
    /// When a number is not finite.
    pub fn save(&self) -> Result<Vec<u8>, serde_json::Error> {
        let mut bytes = serde_json::to_vec(self)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// Facts about the model in a weights file.
    pub fn info(&self, bytes: &[u8]) -> PlacementInfo {
        let of_type = |m: &TypeModel| {
            let rates = m.rates.values().map(|r| 1 + r.factors.iter().map(Vec::len).sum::<usize>());
            let histograms = m.lateral.values().chain(m.heading.values()).map(|h| h.share.len());
            let boxes = m.sizes.values().map(|s| 3 * s.len());
            rates.chain(histograms).chain(boxes).chain(m.speed.values().map(Vec::len)).sum::<usize>()
        };
        PlacementInfo {
            sha256: ContentHash::of_bytes(bytes).hex(),
            numbers: self.types.values().map(of_type).sum(),
            licence: self.licence.clone(),
            trained_on: self.trained_on.clone(),
        }
    }
}
