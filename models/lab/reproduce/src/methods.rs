//! Methods of the tables.

use crate::sets::{Centre, Sets};
use crate::training::weights_path;
use anyhow::{Context, Result};
use experts::Generator;
use experts::weights::Files;
use lab_train::baselines::Baseline;
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;

/// A line of the tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// TrafficGen, trained on vehicles without conditions, applied to all types.
    TrafficGen,
    /// TrafficGen of all types with the condition.
    Mixture,
    /// The paper's own.
    Paper,
    /// Our experts trained on the same records with the same schedule.
    OursTrained,
    /// Our shipped experts.
    OursShipped,
    /// A cubic spline to the end: the result without learning.
    Spline,
}

impl Method {
    /// All methods, in the order of the tables.
    pub const ALL: [Self; 6] =
        [Self::TrafficGen, Self::Mixture, Self::Paper, Self::OursTrained, Self::OursShipped, Self::Spline];

    /// Name in the tables; the first three are the paper's.
    pub fn name(self) -> &'static str {
        match self {
            Self::TrafficGen => "TrafficGen",
            Self::Mixture => "TrafficGen Mixture Training with Condition",
            Self::Paper => "DragTraffic with Condition",
            Self::OursTrained => "ours with condition, the same records and length of training",
            Self::OursShipped => "ours with condition, as shipped",
            Self::Spline => "cubic spline to the condition, no learning",
        }
    }
}

/// Networks of the methods.
pub struct Entrants {
    trafficgen: Option<Baseline>,
    mixture: Option<Baseline>,
    paper: Option<Baseline>,
    trained: Option<Generator>,
    shipped: Generator,
    /// Sets with training records.
    learned: [bool; 3],
}

/// The answering part of a method.
pub enum Answerer<'a> {
    /// A learned rival, and whether it sees the condition.
    Learned(&'a Baseline, bool),
    /// Experts.
    Ours(&'a Generator),
    /// A formula.
    Spline,
}

impl Entrants {
    /// Loads the trained networks. For types without training data, the shipped experts replace ours of the
    /// same records in whole scenes, and these have no line of their own. `shipped` runs on one thread, since
    /// scenes are evaluated in parallel.
    ///
    /// # Errors
    /// When weights cannot be read.
    pub fn load(folder: &Path, sets: &Sets, shipped: Generator, seed: u64) -> Result<Self> {
        let learned = Centre::ALL.map(|c| sets.sets[c.index()].judged.train > 0);
        let baseline = |method: Method, name: &str| -> Result<Option<Baseline>> {
            let file = weights_path(folder, name);
            let path = if method == Method::Paper { folder.join("weights/paper") } else { file };
            if !path.exists() {
                return Ok(None);
            }
            Ok(Some(Baseline::load(method.name(), &path)?.seeded(seed)))
        };
        let trained = learned.iter().any(|l| *l).then(|| -> Result<Generator> {
            let mut files = Files::built_in().experts;
            for (centre, file) in
                [Centre::Ego, Centre::Pedestrian, Centre::Cyclist].into_iter().zip(&mut files)
            {
                let path = weights_path(folder, &format!("ours/{}", centre.expert()));
                if path.exists() {
                    *file = std::fs::read(&path).with_context(|| format!("read {}", path.display()))?.into();
                }
            }
            Ok(Generator::new(&files, Arc::default())?.with_threads(1))
        });
        Ok(Self {
            trafficgen: baseline(Method::TrafficGen, "trafficgen")?.map(Baseline::for_all_types),
            mixture: baseline(Method::Mixture, "mixture")?,
            paper: baseline(Method::Paper, "paper")?,
            trained: trained.transpose()?,
            shipped: shipped.with_threads(1),
            learned,
        })
    }

    /// Answerer of a method for one type; `None` if there was no training data.
    pub fn of(&self, method: Method, centre: Centre) -> Option<Answerer<'_>> {
        let own = self.learned[centre.index()];
        match method {
            Method::TrafficGen => self.trafficgen.as_ref().map(|b| Answerer::Learned(b, false)),
            Method::Mixture => self.mixture.as_ref().map(|b| Answerer::Learned(b, true)),
            Method::Paper => self.paper.as_ref().filter(|_| own).map(|b| Answerer::Learned(b, true)),
            Method::OursTrained => self.trained.as_ref().filter(|_| own).map(Answerer::Ours),
            Method::OursShipped => Some(Answerer::Ours(&self.shipped)),
            Method::Spline => Some(Answerer::Spline),
        }
    }
}
