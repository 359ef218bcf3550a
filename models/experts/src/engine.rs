//! A generator and a placer from one set of weights files, with one cache of maps.

use crate::generator::Generator;
use crate::maps::Maps;
use crate::placement::Placer;
use crate::weights::{Files, WeightsError};
use std::path::Path;
use std::sync::Arc;

/// Generator and placer from one set of weights. Its fields can be moved out where one of the two is enough.
pub struct Engine {
    /// Scenes and conditions to futures.
    pub generator: Generator,
    /// Maps to road users.
    pub placer: Placer,
}

impl Engine {
    /// Builds both from the bytes of weights files.
    ///
    /// # Errors
    /// When a file is damaged or of another architecture.
    pub fn new(files: &Files) -> Result<Self, WeightsError> {
        let maps = Arc::new(Maps::default());
        let placer = Placer::new(files.placement.as_deref(), maps.clone())?;
        Ok(Self { generator: Generator::new(&files.experts, maps)?, placer })
    }

    /// Loads the weights that are built into the program.
    ///
    /// # Errors
    /// When a file is damaged or of another architecture.
    pub fn built_in() -> Result<Self, WeightsError> {
        Self::new(&Files::built_in())
    }

    /// Loads the weights of a folder: see [`Files::read`].
    ///
    /// # Errors
    /// When a file is missing, damaged or of another architecture.
    pub fn from_dir(dir: &Path) -> Result<Self, WeightsError> {
        Self::new(&Files::read(dir)?)
    }
}
