//! The paper's three sets from recordings (its section on the dataset): 6 s intervals, a 120 m square with at
//! least 32 road users, centred on the ego, on cyclists and on pedestrians, 30 frames and a valid end, split
//! by place.

mod cut;
mod files;
mod interest;

pub use cut::Cut;
pub use files::{each_case, free_records_path, interactive, make, records_path};

use anyhow::Result;
use lab_train::provenance::Provenance;
use lab_train::scenes::{Crop, read_scenes, scene_files};
use scene::{AgentType, Scene};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Centre of a square, which also decides the evaluated road users: in the ego's squares all vehicles, in the
/// others only the centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Centre {
    /// The recording vehicle.
    Ego,
    /// Each pedestrian in turn.
    Pedestrian,
    /// Each cyclist in turn.
    Cyclist,
}

impl Centre {
    /// All centres, in the order of the paper's Table I.
    pub const ALL: [Self; 3] = [Self::Ego, Self::Pedestrian, Self::Cyclist];

    /// Index in [`Centre::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Type of the road users for training and evaluation.
    pub fn judged(self) -> AgentType {
        match self {
            Self::Ego => AgentType::Vehicle,
            Self::Pedestrian => AgentType::Pedestrian,
            Self::Cyclist => AgentType::Cyclist,
        }
    }

    /// Name of the expert, and of its files.
    pub fn expert(self) -> &'static str {
        match self {
            Self::Ego => "vehicle",
            Self::Pedestrian => "pedestrian",
            Self::Cyclist => "cyclist",
        }
    }

    /// Name of the set.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ego => "ego-centred",
            Self::Pedestrian => "pedestrian-centred",
            Self::Cyclist => "cyclist-centred",
        }
    }
}

/// Options of the sets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SetOptions {
    /// Steps from the start of an interval to its end, and from one start to the next.
    pub interval_steps: usize,
    /// The square, and the least number of road users in it.
    pub crop: Crop,
    /// Least number of frames after the first at which an evaluated road user is known.
    pub least_frames: usize,
    /// Drawn ends of each road user for training.
    pub draws: usize,
    /// Most vehicles for training in one of the ego's squares.
    pub most_vehicles: usize,
    /// Draws ends and vehicles.
    pub seed: u64,
}

/// Sources of the scenes.
#[derive(Clone, Debug)]
pub struct Data {
    /// Files or folders for training; a tenth of their places is reserved for tests unless `test` has some.
    pub data: Vec<PathBuf>,
    /// Files or folders only for tests.
    pub test: Vec<PathBuf>,
    /// Most files of each.
    pub most_files: usize,
}

impl Data {
    /// Files of one part, sorted, evenly thinned to the greatest number.
    ///
    /// # Errors
    /// When a folder cannot be listed or holds nothing.
    pub fn files(&self, part: Part) -> Result<Vec<PathBuf>> {
        let inputs = match part {
            Part::Data => &self.data,
            Part::Test => &self.test,
        };
        if inputs.is_empty() {
            return Ok(Vec::new());
        }
        let files = scene_files(inputs)?;
        let every = files.len().div_ceil(self.most_files.max(1)).max(1);
        Ok(files.into_iter().step_by(every).collect())
    }
}

/// Which of the inputs a file belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// Training data.
    Data,
    /// Only for tests.
    Test,
}

/// Scenes of a file; none if it cannot be read.
fn scenes(path: &Path) -> Vec<Scene> {
    read_scenes(path).unwrap_or_default()
}

/// Share that a place belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Share {
    /// Training.
    Train,
    /// Selection of the weights to keep.
    Validation,
    /// Evaluation.
    Test,
}

/// Counts in training, validation and test.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Shares {
    pub train: usize,
    pub validation: usize,
    pub test: usize,
}

impl Shares {
    fn add(&mut self, share: Share, count: usize) {
        match share {
            Share::Train => self.train += count,
            Share::Validation => self.validation += count,
            Share::Test => self.test += count,
        }
    }

    /// All together.
    pub fn all(&self) -> usize {
        self.train + self.validation + self.test
    }

    fn merge(&mut self, other: &Self) {
        self.train += other.train;
        self.validation += other.validation;
        self.test += other.test;
    }
}

/// Counts of one set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetCounts {
    /// Squares considered: an interval about the ego, or about one pedestrian or cyclist that may be
    /// evaluated.
    pub squares: usize,
    /// Squares with too few road users.
    pub too_few: usize,
    /// Squares without a road user to evaluate.
    pub nobody: usize,
    /// Cases: the remaining squares.
    pub cases: Shares,
    /// Road users in them for training or evaluation.
    pub judged: Shares,
    /// Training records from them.
    pub records: usize,
}

impl SetCounts {
    fn merge(&mut self, other: &Self) {
        self.squares += other.squares;
        self.too_few += other.too_few;
        self.nobody += other.nobody;
        self.cases.merge(&other.cases);
        self.judged.merge(&other.judged);
        self.records += other.records;
    }
}

/// Interaction between road users of different types.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interest {
    /// Pairs that come to one place within 3 s of each other.
    pub encounters: usize,
    /// Smallest distance of a pair, metres.
    pub nearest_m: f64,
}

impl Interest {
    /// The most interesting first.
    fn order(&self, other: &Self) -> std::cmp::Ordering {
        other.encounters.cmp(&self.encounters).then(self.nearest_m.total_cmp(&other.nearest_m))
    }
}

/// One evaluated square, and its origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TestCase {
    /// Part and index of its file in the sorted list.
    pub file: (Part, usize),
    /// Scene of the file.
    pub scene: usize,
    /// First step of the interval.
    pub start: usize,
    /// Set.
    pub centre: Centre,
    /// Id of the road user in the middle, unless it is the ego.
    pub middle: Option<String>,
    /// Interaction between road users; `None` if the recording ends before 9 s, and for the ego's squares.
    pub interest: Option<Interest>,
}

impl TestCase {
    /// File and scene that it is cut from.
    pub fn place(&self) -> ((Part, usize), usize) {
        (self.file, self.scene)
    }
}

/// Description of the sets.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sets {
    /// Files considered.
    pub files: usize,
    /// Files without a readable scene.
    pub unreadable: usize,
    /// Scenes read.
    pub scenes: usize,
    /// Sources of the scenes, with their licences.
    pub sources: Provenance,
    /// Their duration, seconds.
    pub seconds: f64,
    /// Intervals cut from them.
    pub intervals: usize,
    /// Scenes left out of training because their place is among the tests.
    pub shared_places: usize,
    /// Places by their use.
    pub places: Shares,
    /// Counts in the order of [`Centre::ALL`].
    pub sets: [SetCounts; 3],
    /// Test cases.
    pub tests: Vec<TestCase>,
}
