//! The generator: three experts behind their gate, their caches, and calls that yield events.

mod actor;
mod choice;
mod halfway;
mod noise;
mod parallel;
mod realise;
mod report;
mod rollout;
#[cfg(test)]
mod samples;
mod twins;
mod weights;
mod window;

pub use rollout::Generation;
pub use weights::{WeightsError, WeightsInfo};

use crate::net::Expert;
use crate::placement::{self, PlaceRequest, Placement, PlacementInfo, PlacementModel};
use crate::request::{Cancel, GenerateError, Request};
use scene::routes::LaneGraph;
use scene::score::Drivable;
use scene::{AgentType, ContentHash, LaneMap};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError, Weak};

/// Maps kept.
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

/// What is worked out about a map once.
pub(crate) struct KnownMap {
    /// Lanes with their links.
    pub(crate) graph: Arc<LaneGraph>,
    /// Where vehicles may drive.
    pub(crate) drivable: Drivable,
}

/// Known maps by content hash, and by the very map that was handed in (which saves the hashing).
#[derive(Default)]
struct MapCache {
    by_hash: Vec<(ContentHash, Arc<KnownMap>)>,
    by_handle: Vec<(Weak<LaneMap>, Arc<KnownMap>)>,
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

    /// Forgets what was worked out about maps: the next call on each works it out again.
    pub fn forget_maps(&self) {
        *self.maps.lock().unwrap_or_else(PoisonError::into_inner) = MapCache::default();
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
        let map = self.known_map(&request.scene.map);
        placement::place(self.placement_model(), &map.graph, request, cancel)
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

    /// What is known about a map, from the cache where it is there.
    pub(crate) fn known_map(&self, map: &Arc<LaneMap>) -> Arc<KnownMap> {
        let lock = || self.maps.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = lock().by_handle(map) {
            return known;
        }
        let hash = map.hash();
        if let Some(known) = lock().by_hash(hash, map) {
            return known;
        }
        let found = Arc::new(KnownMap { graph: Arc::new(LaneGraph::new(map)), drivable: Drivable::new(map) });
        lock().insert(hash, map, found.clone());
        found
    }
}

impl MapCache {
    fn by_handle(&self, map: &Arc<LaneMap>) -> Option<Arc<KnownMap>> {
        let same = |weak: &Weak<LaneMap>| weak.upgrade().is_some_and(|m| Arc::ptr_eq(&m, map));
        self.by_handle.iter().find(|(weak, _)| same(weak)).map(|(_, known)| known.clone())
    }

    fn by_hash(&mut self, hash: ContentHash, map: &Arc<LaneMap>) -> Option<Arc<KnownMap>> {
        let known = self.by_hash.iter().find(|(h, _)| *h == hash)?.1.clone();
        self.remember(map, known.clone());
        Some(known)
    }

    fn insert(&mut self, hash: ContentHash, map: &Arc<LaneMap>, known: Arc<KnownMap>) {
        self.by_hash.retain(|(h, _)| *h != hash);
        if self.by_hash.len() >= MAPS {
            self.by_hash.remove(0);
        }
        self.by_hash.push((hash, known.clone()));
        self.remember(map, known);
    }

    fn remember(&mut self, map: &Arc<LaneMap>, known: Arc<KnownMap>) {
        self.by_handle.retain(|(weak, _)| weak.strong_count() > 0);
        if self.by_handle.len() >= MAPS {
            self.by_handle.remove(0);
        }
        self.by_handle.push((Arc::downgrade(map), known));
    }
}
