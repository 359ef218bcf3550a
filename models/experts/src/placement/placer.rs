//! Placement with its weights and its cache of maps.

use super::model::{PlacementInfo, PlacementModel};
use super::place::place;
use super::request::{PlaceRequest, Placement};
use crate::maps::Maps;
use crate::request::GenerateError;
use crate::weights::WeightsError;
use scene::Cancel;
use std::sync::Arc;

/// Places road users. Cheap to share; calls may run at the same time.
pub struct Placer {
    weights: Option<(PlacementModel, PlacementInfo)>,
    maps: Arc<Maps>,
}

impl Placer {
    /// Builds a placer from the bytes of a weights file; without one, road users are placed evenly along
    /// lanes.
    ///
    /// # Errors
    /// When the file has another form, or contains impossible numbers.
    pub fn new(weights: Option<&[u8]>, maps: Arc<Maps>) -> Result<Self, WeightsError> {
        let read = |bytes| {
            let model = PlacementModel::load(bytes)?;
            let info = model.info(bytes);
            Ok((model, info))
        };
        Ok(Self { weights: weights.map(read).transpose()?, maps })
    }

    /// Facts about the weights; `None` if road users are placed evenly along lanes.
    pub fn info(&self) -> Option<&PlacementInfo> {
        self.weights.as_ref().map(|(_, info)| info)
    }

    /// The weights themselves.
    pub fn model(&self) -> Option<&PlacementModel> {
        self.weights.as_ref().map(|(model, _)| model)
    }

    /// Places road users. Equal requests give equal answers.
    ///
    /// # Errors
    /// An unknown id among the kept ones, and [`GenerateError::Cancelled`].
    pub fn place(&self, request: &PlaceRequest, cancel: &Cancel) -> Result<Placement, GenerateError> {
        let map = self.maps.known_unless(&request.scene.map, cancel).ok_or(GenerateError::Cancelled)?;
        place(self.model(), &map.graph, request, cancel)
    }
}
