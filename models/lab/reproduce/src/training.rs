//! Training of the tables' networks, one after another; a stopped run resumes.

use crate::methods::Method;
use crate::sets::{Centre, Sets, free_records_path, records_path};
use crate::{Stop, Stopped, stopped};
use anyhow::{Context, Result};
use experts::net::Architecture;
use lab_train::baselines::{self, BaselineKind, Plan};
use lab_train::training::{
    self, EVERYBODY, Metrics, Stage, TrainError, TrainOptions, TrainProgress, best_path,
};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Length of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Length {
    /// Number of epochs.
    Epochs(f64),
    /// Optimiser steps.
    Steps(u64),
}

impl Length {
    fn steps(self, records: usize, batch: usize) -> u64 {
        match self {
            Self::Epochs(epochs) => (epochs * records as f64 / batch.max(1) as f64).ceil().max(1.0) as u64,
            Self::Steps(steps) => steps.max(1),
        }
    }
}

/// Training schedule of the networks (the paper's implementation details).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Schedule {
    /// The paper's denoiser alone.
    pub denoiser: Length,
    /// Regressors: the baselines, the paper's initializer and ours.
    pub regressor: Length,
    /// Fine-tuning of both together, the paper's and ours.
    pub joint: Length,
    /// Initial learning rate.
    pub rate: f64,
    /// Final learning rate.
    pub rate_end: f64,
    /// Records per step.
    pub batch: usize,
}

impl Schedule {
    /// The paper's schedule: 100, 150 and 40 epochs, 3e-4 falling to 4e-5 (it states 0.0004, which would be
    /// no decay). It states no batch size, and no separate length for the initializer, which gets that of the
    /// other regressors.
    pub const PAPER: Self = Self {
        denoiser: Length::Epochs(100.0),
        regressor: Length::Epochs(150.0),
        joint: Length::Epochs(40.0),
        rate: 3e-4,
        rate_end: 4e-5,
        batch: 64,
    };
    /// A schedule for minutes of work on two cores.
    pub const QUICK: Self = Self {
        denoiser: Length::Steps(200),
        regressor: Length::Steps(400),
        joint: Length::Steps(50),
        rate: 2e-3,
        rate_end: 1e-4,
        batch: 32,
    };
}

/// One training.
#[derive(Clone, Debug)]
struct TrainingJob {
    method: Method,
    /// Path below the folder, without the ending.
    name: String,
    expert: &'static str,
    records: Vec<PathBuf>,
    stage: Stage,
    length: Length,
    count: usize,
    init: Option<String>,
}

impl TrainingJob {
    fn steps(&self, schedule: &Schedule) -> u64 {
        self.length.steps(self.count, schedule.batch)
    }

    /// Approximate cost of a record relative to TrafficGen's, to estimate the remaining time.
    fn cost(&self) -> f64 {
        match (self.method, self.stage) {
            (Method::Paper, Stage::Denoiser) => 1.5,
            (Method::Paper, Stage::Joint) => 5.0,
            (Method::OursTrained, Stage::Joint) => 2.0,
            _ => 1.0,
        }
    }

    fn work(&self, schedule: &Schedule) -> f64 {
        self.cost() * (self.steps(schedule) * schedule.batch as u64) as f64
    }
}

/// All trainings, in order.
fn jobs(folder: &Path, sets: &Sets, schedule: &Schedule) -> Vec<TrainingJob> {
    // Training records: those of validation are in the same file.
    let share = |centre: Centre, records: usize| {
        let judged = &sets.sets[centre.index()].judged;
        let known = judged.train + judged.validation;
        (judged.train > 0).then(|| (records * judged.train).div_ceil(known))
    };
    let learned = |centre: Centre| share(centre, sets.sets[centre.index()].records);
    let mut out = Vec::new();
    let job = |method, name: &str, expert, records: Vec<PathBuf>, count| TrainingJob {
        method,
        name: name.into(),
        expert,
        records,
        stage: Stage::Initializer,
        length: schedule.regressor,
        count,
        init: None,
    };
    let vehicles = sets.sets[Centre::Ego.index()].judged;
    if let Some(count) = share(Centre::Ego, vehicles.train + vehicles.validation) {
        out.push(job(Method::TrafficGen, "trafficgen", "vehicle", vec![free_records_path(folder)], count));
    }
    let all: Vec<Centre> = Centre::ALL.into_iter().filter(|c| learned(*c).is_some()).collect();
    if !all.is_empty() {
        let records = all.iter().map(|c| records_path(folder, *c)).collect();
        let count = all.iter().filter_map(|c| learned(*c)).sum();
        out.push(job(Method::Mixture, "mixture", EVERYBODY, records, count));
    }
    for centre in all {
        let count = learned(centre).unwrap_or_default();
        let name = centre.expert();
        let of = |method, name: &str| {
            job(method, name, centre.expert(), vec![records_path(folder, centre)], count)
        };
        let (first, second) = (format!("paper-denoiser/{name}"), format!("paper-initializer/{name}"));
        out.push(TrainingJob {
            stage: Stage::Denoiser,
            length: schedule.denoiser,
            ..of(Method::Paper, &first)
        });
        out.push(TrainingJob { init: Some(first), ..of(Method::Paper, &second) });
        let joint = |job: TrainingJob, init: String| TrainingJob {
            stage: Stage::Joint,
            length: schedule.joint,
            init: Some(init),
            ..job
        };
        out.push(joint(of(Method::Paper, &format!("paper/{name}")), second));
        let first = format!("ours-initializer/{name}");
        out.push(of(Method::OursTrained, &first));
        out.push(joint(of(Method::OursTrained, &format!("ours/{name}")), first));
    }
    out
}

/// Path of the finished weights of a name.
pub fn weights_path(folder: &Path, name: &str) -> PathBuf {
    folder.join(format!("weights/{name}.safetensors"))
}

/// Settings shared by all trainings.
pub struct Training<'a> {
    /// Folder of the run.
    pub folder: &'a Path,
    /// Lengths and rates.
    pub schedule: Schedule,
    /// Hidden size of the condition's MLP.
    pub condition_width: usize,
    /// Draws weights, batches and noise.
    pub seed: u64,
    /// Threads that share a step; the result does not depend on it.
    pub threads: usize,
    /// Flag that ends the run.
    pub stop: &'a Stop,
}

/// Steps of each training behind the tables.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Trained {
    /// Name below the folder of weights.
    pub name: String,
    /// Stage.
    pub stage: Stage,
    /// Optimiser steps.
    pub steps: u64,
    /// Number of epochs.
    pub epochs: f64,
}

impl Training<'_> {
    /// Trains what is missing; a stopped run continues. For each stage, the weights with the least held-out
    /// loss are kept.
    ///
    /// # Errors
    /// When records or weights cannot be read or written, or the run is stopped.
    pub fn run(&self, sets: &Sets, progress: &dyn Fn(&str)) -> Result<Vec<Trained>> {
        let jobs = jobs(self.folder, sets, &self.schedule);
        let is_done = |job: &&TrainingJob| weights_path(self.folder, &job.name).exists();
        let left: f64 = jobs.iter().filter(|j| !is_done(j)).map(|j| j.work(&self.schedule)).sum();
        let mut pace = Pace { begun: Instant::now(), done: 0.0, all: left };
        for job in &jobs {
            if is_done(&job) {
                continue;
            }
            stopped(self.stop)?;
            self.train(job, &mut pace, progress).with_context(|| format!("train {}", job.name))?;
        }
        let told = |job: &TrainingJob| {
            let steps = job.steps(&self.schedule);
            let epochs = (steps * self.schedule.batch as u64) as f64 / job.count.max(1) as f64;
            Trained { name: job.name.clone(), stage: job.stage, steps, epochs }
        };
        Ok(jobs.iter().map(told).collect())
    }

    fn train(&self, job: &TrainingJob, pace: &mut Pace, progress: &dyn Fn(&str)) -> Result<()> {
        // Elsewhere until it is finished: the folder of weights contains only finished ones.
        let out = self.folder.join(format!("training/{}.safetensors", job.name));
        if let Some(parent) = out.parent() {
            std::fs::create_dir_all(parent).with_context(|| format!("make {}", parent.display()))?;
        }
        let (steps, from) = (job.steps(&self.schedule), pace.done);
        let mut report = |line: &TrainProgress| {
            let step = match line {
                TrainProgress::Begin { step, .. }
                | TrainProgress::Training { step, .. }
                | TrainProgress::Validation { step, .. } => *step,
            };
            pace.done = from + job.work(&self.schedule) * step as f64 / steps.max(1) as f64;
            let words = match line {
                TrainProgress::Begin { records, .. } => {
                    format!("{} records, {} held out, {steps} steps", records.0, records.1)
                }
                TrainProgress::Training { .. } => line.to_string(),
                TrainProgress::Validation { metrics, .. } => format!("{step:>7}  held out: {metrics}"),
            };
            progress(&format!("{}: {words}{}", job.name, pace.words()));
        };
        let init = job.init.as_ref().map(|name| weights_path(self.folder, name));
        match job.method {
            Method::OursTrained => {
                let centre = Centre::ALL.into_iter().find(|c| c.expert() == job.expert);
                let mut options = TrainOptions::new(job.records.clone(), job.stage, out.clone());
                options.architecture =
                    centre.map_or_else(Architecture::default, |c| Architecture::of(c.judged()));
                ended(training::run(&self.set(options, job, init), &mut report))?;
            }
            Method::TrafficGen | Method::Mixture | Method::Paper | Method::OursShipped | Method::Spline => {
                let kind = match job.method {
                    Method::TrafficGen => BaselineKind::TrafficGen,
                    Method::Mixture => BaselineKind::TrafficGenConditional,
                    _ => BaselineKind::Paper,
                };
                let mut options = baselines::options(kind, job.records.clone(), job.stage, out.clone());
                options.architecture = Plan { condition_width: self.condition_width, ..Plan::of(kind) };
                ended(baselines::train(&self.set(options, job, init), &mut report))?;
            }
        }
        pace.done = from + job.work(&self.schedule);
        let best = best_path(&out);
        let kept = if best.exists() { best } else { out };
        let bytes = std::fs::read(&kept).with_context(|| format!("read {}", kept.display()))?;
        let path = weights_path(self.folder, &job.name);
        formats::files::replace(&path, &bytes).with_context(|| format!("write {}", path.display()))
    }

    fn set<A>(&self, options: TrainOptions<A>, job: &TrainingJob, init: Option<PathBuf>) -> TrainOptions<A> {
        let steps = job.steps(&self.schedule);
        TrainOptions {
            expert: job.expert.into(),
            init,
            steps,
            batch: self.schedule.batch,
            rate: self.schedule.rate,
            rate_end: Some(self.schedule.rate_end),
            threads: self.threads,
            seed: self.seed,
            resume: true,
            validate_every: (steps / 10).max(10),
            stop: Arc::clone(self.stop),
            ..options
        }
    }
}

/// Turns a stop of the training into a stop of the run.
fn ended(done: Result<Metrics, TrainError>) -> Result<Metrics> {
    match done {
        Err(TrainError::Stopped { .. }) => Err(Stopped.into()),
        done => Ok(done?),
    }
}

/// Progress of the trainings, in records weighted by cost.
struct Pace {
    begun: Instant,
    done: f64,
    all: f64,
}

impl Pace {
    fn words(&self) -> String {
        let (share, seconds) = (self.done / self.all.max(1.0), self.begun.elapsed().as_secs_f64());
        if share < 0.005 || seconds < 3.0 {
            return String::new();
        }
        let left_s = seconds * (1.0 - share).max(0.0) / share;
        let left = match left_s {
            s if s < 90.0 => format!("{s:.0} s"),
            s if s < 5400.0 => format!("{:.0} min", s / 60.0),
            s => format!("{:.1} h", s / 3600.0),
        };
        format!("  [training {:.0} % done, about {left} left]", 100.0 * share)
    }
}
