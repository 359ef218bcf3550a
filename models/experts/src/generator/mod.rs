//! The generator: three experts behind their gate, their caches, and calls that yield events.

mod actor;
mod choice;
mod halfway;
mod noise;
mod parallel;
mod realise;
mod report;
mod rollout;
mod weights;
mod window;

pub use rollout::Generation;
pub use weights::{WeightsError, WeightsInfo};

use crate::features::world::MapIndex;
use crate::net::{Expert, NetError};
use crate::placement::{self, PlaceRequest, Placement, PlacementInfo, PlacementModel};
use crate::request::{Cancel, GenerateError, Request};
use candle_core::Tensor;
use scene::score::Drivable;
use scene::{AgentType, ContentHash, LaneMap};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError, Weak};

/// Maps kept encoded.
const MAPS: usize = 32;

/// Types with an expert, in the order of their weights files.
pub const EXPERTS: [(AgentType, &str); 3] =
    [(AgentType::Vehicle, "vehicle"), (AgentType::Pedestrian, "pedestrian"), (AgentType::Cyclist, "cyclist")];

/// The three experts with their caches. Cheap to share; calls may run at the same time.
pub struct Generator {
    experts: BTreeMap<AgentType, Expert>,
    info: BTreeMap<String, WeightsInfo>,
    placement: Option<(PlacementModel, PlacementInfo)>,
    maps: Mutex<MapCache>,
    threads: usize,
}

/// A map as the experts know it, worked out once.
pub(crate) struct EncodedMap {
    pub(crate) index: Arc<MapIndex>,
    /// Where vehicles may drive.
    pub(crate) drivable: Drivable,
    encodings: [OnceLock<Tensor>; EXPERTS.len()],
}

/// Encoded maps by content hash, and by the very map that was handed in (which saves the hashing).
#[derive(Default)]
struct MapCache {
    by_hash: Vec<(ContentHash, Arc<EncodedMap>)>,
    by_handle: Vec<(Weak<LaneMap>, Arc<EncodedMap>)>,
}

impl Generator {
    /// Loads the weights that are built into the program.
    ///
    /// # Errors
    /// When a file is damaged or of another architecture.
    pub fn built_in() -> Result<Self, WeightsError> {
        let placement = weights::read_placement(weights::PLACEMENT)?;
        Ok(Self { placement: Some(placement), ..Self::from_files(weights::built_in())? })
    }

    /// Loads `vehicle.safetensors`, `pedestrian.safetensors` and `cyclist.safetensors` from a folder, and
    /// `placement.json` where it is there.
    ///
    /// # Errors
    /// When a file is missing, damaged or of another architecture.
    pub fn from_dir(dir: &Path) -> Result<Self, WeightsError> {
        let placement = weights::placement_in(dir)?;
        Ok(Self { placement, ..Self::from_files(weights::read_dir(dir)?)? })
    }

    /// Random weights, for tests of everything but quality.
    ///
    /// # Errors
    /// When memory for them cannot be had.
    pub fn random(seed: u64) -> Result<Self, WeightsError> {
        Self::from_files(weights::random(seed)?)
    }

    fn from_files(files: Vec<(AgentType, &'static str, Vec<u8>)>) -> Result<Self, WeightsError> {
        let (mut experts, mut info) = (BTreeMap::new(), BTreeMap::new());
        for (agent_type, name, bytes) in files {
            let expert = Expert::load(&bytes)
                .map_err(|e| WeightsError { path: format!("{name}.safetensors"), reason: e.to_string() })?;
            info.insert(name.to_owned(), WeightsInfo::of(name, &bytes, &expert));
            experts.insert(agent_type, expert);
        }
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        Ok(Self { experts, info, placement: None, maps: Mutex::default(), threads })
    }

    /// Cuts whole scenes over so many threads; the answer does not depend on it.
    #[must_use]
    pub fn with_threads(self, threads: usize) -> Self {
        Self { threads: threads.max(1), ..self }
    }

    /// Runs each expert once so that the first user does not pay for it.
    pub fn warm_up(&self) {
        weights::warm_up(self);
    }

    /// Expert name to facts.
    pub fn weights(&self) -> &BTreeMap<String, WeightsInfo> {
        &self.info
    }

    /// Begins a call. The iterator does the work, one event at a time; dropping it stops the call.
    ///
    /// # Errors
    /// What can be told before any work: unknown ids, missing starts, too many road users.
    pub fn start(&self, request: Request, cancel: Cancel) -> Result<Generation<'_>, GenerateError> {
        Generation::new(self, request, cancel)
    }

    /// Facts about the placement weights; `None` when road users are placed evenly along lanes.
    pub fn placement(&self) -> Option<&PlacementInfo> {
        self.placement.as_ref().map(|(_, info)| info)
    }

    /// The placement weights themselves.
    pub fn placement_model(&self) -> Option<&PlacementModel> {
        self.placement.as_ref().map(|(model, _)| model)
    }

    /// Places road users. The same request gives the same answer.
    ///
    /// # Errors
    /// An unknown id among those kept, and [`GenerateError::Cancelled`].
    pub fn place(&self, request: &PlaceRequest, cancel: &Cancel) -> Result<Placement, GenerateError> {
        let map = self.encoded_map(&request.scene.map);
        placement::place(self.placement_model(), &map.index.graph, request, cancel)
    }

    /// The gate: which expert a type runs on.
    pub(crate) fn expert(&self, agent_type: AgentType) -> Result<&Expert, GenerateError> {
        self.experts
            .get(&agent_type)
            .ok_or_else(|| GenerateError::Expert(format!("no expert for {agent_type:?}")))
    }

    pub(crate) fn threads(&self) -> usize {
        self.threads
    }

    /// The map's index, from the cache where it is known.
    pub(crate) fn encoded_map(&self, map: &Arc<LaneMap>) -> Arc<EncodedMap> {
        let lock = || self.maps.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().by_handle(map) {
            return known;
        }
        let hash = map.hash();
        if let Some(known) = lock().by_hash(hash, map) {
            return known;
        }
        let encoded = Arc::new(EncodedMap {
            index: Arc::new(MapIndex::new(map)),
            drivable: Drivable::new(map),
            encodings: std::array::from_fn(|_| OnceLock::new()),
        });
        lock().insert(hash, map, encoded.clone());
        encoded
    }
}

impl MapCache {
    fn by_handle(&self, map: &Arc<LaneMap>) -> Option<Arc<EncodedMap>> {
        let same = |weak: &Weak<LaneMap>| weak.upgrade().is_some_and(|m| Arc::ptr_eq(&m, map));
        self.by_handle.iter().find(|(weak, _)| same(weak)).map(|(_, encoded)| encoded.clone())
    }

    fn by_hash(&mut self, hash: ContentHash, map: &Arc<LaneMap>) -> Option<Arc<EncodedMap>> {
        let encoded = self.by_hash.iter().find(|(h, _)| *h == hash)?.1.clone();
        self.remember(map, encoded.clone());
        Some(encoded)
    }

    fn insert(&mut self, hash: ContentHash, map: &Arc<LaneMap>, encoded: Arc<EncodedMap>) {
        self.by_hash.retain(|(h, _)| *h != hash);
        if self.by_hash.len() >= MAPS {
            self.by_hash.remove(0);
        }
        self.by_hash.push((hash, encoded.clone()));
        self.remember(map, encoded);
    }

    fn remember(&mut self, map: &Arc<LaneMap>, encoded: Arc<EncodedMap>) {
        self.by_handle.retain(|(weak, _)| weak.strong_count() > 0);
        if self.by_handle.len() >= MAPS {
            self.by_handle.remove(0);
        }
        self.by_handle.push((Arc::downgrade(map), encoded));
    }
}

impl EncodedMap {
    /// The map's pieces as the expert of this type encodes them.
    pub(crate) fn encoding(&self, agent_type: AgentType, expert: &Expert) -> Result<&Tensor, NetError> {
        let slot = EXPERTS.iter().position(|(t, _)| *t == agent_type).unwrap_or(0);
        if let Some(known) = self.encodings[slot].get() {
            return Ok(known);
        }
        let tensor = expert.encode_map(&self.index.pieces.features)?;
        Ok(self.encodings[slot].get_or_init(|| tensor))
    }
}
