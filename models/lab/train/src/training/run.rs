//! A training run from records to weights.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use candle_core::{Device, Tensor};
use experts::Refining;
use experts::net::{Architecture, Card, Expert};
use scene::licence::strictest;

use super::checkpoint::{self, CheckpointState, Resumed};
use super::log::Log;
use super::metrics::Metrics;
use super::optim::{AdamW, rate};
use super::processor::Processor;
use super::sample::{Split, is_held_out};
use super::stages::{Stage, Tools};
use super::trainee::Trainee;
use super::workers::{SHARD, Workers};
use super::{Records, TrainError};
use crate::provenance::Provenance;

/// Name of networks for all types.
pub const EVERYBODY: &str = "everybody";
/// Steps between two lines of a report.
const REPORT: u64 = 100;
/// Most held-out records that are used.
const HELD_OUT: usize = 2048;

/// Options of a training.
#[derive(Clone, Debug)]
pub struct TrainOptions<A = Architecture> {
    /// Files of records.
    pub records: Vec<PathBuf>,
    /// Name of the expert: vehicle, pedestrian or cyclist.
    pub expert: String,
    /// Description of the records' sources for the header; replaces that of the records. Their licences are
    /// kept in any case.
    pub trained_on: Option<String>,
    /// Stage of the training.
    pub stage: Stage,
    /// Initial weights; random ones if absent.
    pub init: Option<PathBuf>,
    /// Total number of steps.
    pub steps: u64,
    /// Records per step.
    pub batch: usize,
    /// Top learning rate.
    pub rate: f64,
    /// Learning rate at the end; a hundredth of the top one if absent.
    pub rate_end: Option<f64>,
    /// Device that computes the networks; a run is repeatable bit for bit only on the CPU.
    pub processor: Processor,
    /// Threads on the CPU; the result does not depend on it.
    pub threads: usize,
    /// Path of the weights (their running mean). Beside it are the checkpoint and the log, as JSON lines and
    /// as curves: `.checkpoint`, `.jsonl` and `.svg` are appended to its name.
    pub out: PathBuf,
    /// Whether to resume from an existing checkpoint.
    pub resume: bool,
    /// Seed of the weights, the batches and the noise.
    pub seed: u64,
    /// Ends the run after this time, with the rate decaying accordingly; the result then depends on the speed
    /// of the machine.
    pub minutes: Option<f64>,
    /// Steps between two validations, each followed by a save.
    pub validate_every: u64,
    /// Time after which a checkpoint is also written at a line of the report, seconds.
    pub checkpoint_every_s: f64,
    /// A flag by which other threads end the run after the current step, with a checkpoint.
    pub stop: Arc<AtomicBool>,
    /// Sizes of new networks.
    pub architecture: A,
    /// Inputs of the refiner; ablations remove some.
    pub refining: Refining,
}

impl TrainOptions {
    /// Default options; the arguments have no defaults.
    pub fn new(records: Vec<PathBuf>, stage: Stage, out: PathBuf) -> Self {
        Self::of(records, stage, out, Architecture::default())
    }
}

impl<A> TrainOptions<A> {
    /// Default options for networks of an architecture.
    pub(crate) fn of(records: Vec<PathBuf>, stage: Stage, out: PathBuf, architecture: A) -> Self {
        Self {
            records,
            expert: "vehicle".into(),
            trained_on: None,
            stage,
            init: None,
            steps: 20_000,
            batch: 64,
            rate: 1e-3,
            rate_end: None,
            processor: Processor::default(),
            threads: 1,
            out,
            resume: false,
            seed: 1,
            minutes: None,
            validate_every: 1000,
            checkpoint_every_s: 60.0,
            stop: Arc::default(),
            architecture,
            refining: Refining::default(),
        }
    }
}

/// Path of a run's checkpoint.
pub fn checkpoint_path(out: &Path) -> PathBuf {
    let mut path = out.as_os_str().to_owned();
    path.push(".checkpoint");
    path.into()
}

/// Number of steps for this many epochs over the training records.
///
/// # Errors
/// When records cannot be read.
pub fn steps_of(records: &[PathBuf], epochs: f64, batch: usize) -> Result<u64, TrainError> {
    let records = Records::load(records)?;
    let known = (0..records.len()).filter(|i| !is_held_out(records.scene_of(*i).0)).count();
    Ok((epochs * known as f64 / batch.max(1) as f64).ceil().max(1.0) as u64)
}

/// Path of a run's weights with the least held-out loss.
pub fn best_path(out: &Path) -> PathBuf {
    let mut path = out.as_os_str().to_owned();
    path.push(".best");
    path.into()
}

/// A line of a run's report.
#[derive(Clone, Debug)]
pub enum TrainProgress {
    /// The run begins or continues.
    Begin {
        /// Number of training records and of held-out records.
        records: (usize, usize),
        /// Number of trained parameters.
        parameters: usize,
        /// Steps already done.
        step: u64,
    },
    /// Means over the steps since the last line.
    Training {
        /// Steps done.
        step: u64,
        /// Present learning rate.
        rate: f64,
        /// Mean norm of the gradient before clipping.
        gradient: f64,
        /// Losses and distances.
        metrics: Metrics,
        /// Records per second.
        speed: f64,
    },
    /// Metrics of the running mean of the weights on held-out records.
    Validation {
        /// Steps done.
        step: u64,
        /// Losses and distances.
        metrics: Metrics,
    },
}

impl fmt::Display for TrainProgress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Begin { records, parameters, step } => write!(
                f,
                "{} records, {} held out, {parameters} parameters, from step {step}",
                records.0, records.1
            ),
            Self::Training { step, rate, gradient, metrics, speed } => {
                write!(f, "{step:>7}  {metrics}  gradient {gradient:.2}  rate {rate:.1e}  {speed:.0}/s")
            }
            Self::Validation { step, metrics } => write!(f, "{step:>7}  held out: {metrics}"),
        }
    }
}

/// Trains an expert and writes the weights; `report` gets each line. Returns the last validation.
///
/// # Errors
/// When files cannot be read or written, or a checkpoint belongs to another run.
pub fn run(options: &TrainOptions, report: &mut dyn FnMut(&TrainProgress)) -> Result<Metrics, TrainError> {
    run_of::<Expert>(options, report)
}

/// [`run`] for any trainable networks.
pub(crate) fn run_of<T: Trainee>(
    options: &TrainOptions<T::Architecture>,
    report: &mut dyn FnMut(&TrainProgress),
) -> Result<Metrics, TrainError> {
    let device = options.processor.device()?;
    let records = Records::load(&options.records)?;
    let provenance = provenance(options, &records)?;
    let mut run = TrainingRun::<T>::begin(options, &records, &provenance, &device)?;
    let even = run.trained.draws_files_evenly();
    let split = Split::new(&records, HELD_OUT, even, |record| run.trained.takes(record))?;
    report(&TrainProgress::Begin {
        records: (split.train(), split.held_out.len()),
        parameters: run.trained.tensors().values().map(Tensor::elem_count).sum(),
        step: run.adam.step,
    });
    // A graphics card is used best with whole batches, one after another.
    let (shard, threads) = if device.is_cpu() { (SHARD, options.threads) } else { (options.batch, 1) };
    let workers = Workers {
        records: &records,
        tools: Tools::new(options.refining),
        stage: options.stage,
        seed: options.seed,
        shard,
        threads,
    };
    let log = Log::open(&options.out, run.adam.step)?;
    let mut reporter = RunReporter { report, log };
    let mut since = Since::new();
    let mut kept = Instant::now();
    let mut validated = None;
    while run.progress() < 1.0 {
        if options.stop.load(Ordering::Relaxed) {
            reporter.log.write()?;
            run.keep()?;
            return Err(TrainError::Stopped { step: run.adam.step });
        }
        let ends = (options.rate, options.rate_end.unwrap_or(0.01 * options.rate));
        let rate = rate(ends, run.adam.step, options.steps.min(200), run.progress());
        let batch = split.batch(options.seed, run.adam.step, options.batch, options.stage.together());
        let (gradients, metrics) = workers.train(&run.trained, &batch, run.adam.step)?;
        let length = run.adam.apply(run.trained.vars(), &gradients, rate)?;
        run.adam.average(run.trained.vars())?;
        since.add(&metrics, length);
        let step = run.adam.step;
        if step.is_multiple_of(REPORT) {
            reporter.line(&since.line(step, rate))?;
            since = Since::new();
            // Only at a line, so that the log of a run that continues from here equals that of an
            // uninterrupted run.
            if kept.elapsed().as_secs_f64() >= options.checkpoint_every_s {
                reporter.log.write()?;
                run.keep()?;
                kept = Instant::now();
            }
        }
        if step.is_multiple_of(options.validate_every.max(1)) {
            validated = Some((step, run.finish(&workers, &split, &mut reporter)?));
            since = Since::new();
            kept = Instant::now();
        }
    }
    match validated {
        Some((step, metrics)) if step == run.adam.step => Ok(metrics),
        _ => run.finish(&workers, &split, &mut reporter),
    }
}

/// Reports a run to the caller and to the log beside the weights.
struct RunReporter<'a> {
    report: &'a mut dyn FnMut(&TrainProgress),
    log: Log,
}

impl RunReporter<'_> {
    fn line(&mut self, line: &TrainProgress) -> Result<(), TrainError> {
        (self.report)(line);
        self.log.add(line)
    }
}

/// Provenance of all records.
///
/// # Errors
/// If some belong to another expert.
fn provenance<A>(options: &TrainOptions<A>, records: &Records) -> Result<Provenance, TrainError> {
    let mut all = Provenance::default();
    for (path, own) in options.records.iter().zip(records.provenances()) {
        if options.expert != EVERYBODY && own.expert != options.expert {
            let reason = format!("records of the expert \"{}\", not of \"{}\"", own.expert, options.expert);
            return Err(TrainError::damaged(path, reason));
        }
        all.merge(own);
    }
    Ok(all)
}

/// Measurements since the last line.
struct Since {
    metrics: Metrics,
    lengths: f64,
    steps: u64,
    clock: Instant,
}

impl Since {
    fn new() -> Self {
        Self { metrics: Metrics::default(), lengths: 0.0, steps: 0, clock: Instant::now() }
    }

    fn add(&mut self, metrics: &Metrics, length: f64) {
        self.metrics.merge(metrics);
        self.lengths += length;
        self.steps += 1;
    }

    fn line(&self, step: u64, rate: f64) -> TrainProgress {
        TrainProgress::Training {
            step,
            rate,
            gradient: self.lengths / self.steps.max(1) as f64,
            metrics: self.metrics.clone(),
            speed: self.metrics.records() as f64 / self.clock.elapsed().as_secs_f64().max(1e-9),
        }
    }
}

struct TrainingRun<'a, T: Trainee> {
    options: &'a TrainOptions<T::Architecture>,
    trained: T,
    /// The networks with the running mean of the weights.
    mean: T,
    adam: AdamW,
    records: String,
    clock: Instant,
    seconds_before: f64,
}

impl<'a, T: Trainee> TrainingRun<'a, T> {
    fn begin(
        options: &'a TrainOptions<T::Architecture>,
        records: &Records,
        provenance: &Provenance,
        device: &Device,
    ) -> Result<Self, TrainError> {
        let path = checkpoint_path(&options.out);
        let hash = records.hash().to_hex().to_string();
        let resumed =
            if options.resume && path.exists() { Some(checkpoint::load::<T>(&path, device)?) } else { None };
        let (trained, adam, seconds_before) = match resumed {
            Some(resumed) => {
                same_run(&path, options, &hash, &resumed.state)?;
                let Resumed { state, trained, adam } = resumed;
                (trained, adam, state.seconds)
            }
            None => {
                let trained: T = first_weights(options, provenance, device)?;
                let adam = AdamW::new(trained.vars(), |name| T::share(options.stage, name))?;
                (trained, adam, 0.0)
            }
        };
        let mean = T::random(trained.architecture().clone(), trained.card().clone(), 0, device)?;
        Ok(Self { options, trained, mean, adam, records: hash, clock: Instant::now(), seconds_before })
    }

    fn seconds(&self) -> f64 {
        self.seconds_before + self.clock.elapsed().as_secs_f64()
    }

    /// Completed share of the run.
    fn progress(&self) -> f64 {
        let steps = self.adam.step as f64 / self.options.steps.max(1) as f64;
        match self.options.minutes {
            Some(minutes) => steps.max(self.seconds() / (60.0 * minutes)),
            None => steps,
        }
    }

    /// Validates, reports and saves.
    fn finish(
        &mut self,
        workers: &Workers<'_>,
        split: &Split,
        reporter: &mut RunReporter<'_>,
    ) -> Result<Metrics, TrainError> {
        self.adam.write_means(self.mean.vars())?;
        let metrics = workers.validate(&self.mean, &split.held_out)?;
        let best = reporter.log.is_best(&metrics);
        reporter.line(&TrainProgress::Validation { step: self.adam.step, metrics: metrics.clone() })?;
        self.save(best)?;
        Ok(metrics)
    }

    /// Writes the weights, a copy as the best so far if they are, and a checkpoint.
    fn save(&mut self, best: bool) -> Result<(), TrainError> {
        let options = self.options;
        let notes = &mut self.mean.card_mut().notes;
        notes.insert(format!("{:?} steps", options.stage).to_lowercase(), self.adam.step.to_string());
        notes.insert("records".into(), self.records.clone());
        self.adam.write_means(self.mean.vars())?;
        let bytes = self.mean.write()?;
        checkpoint::replace(&options.out, &bytes)?;
        if best {
            checkpoint::replace(&best_path(&options.out), &bytes)?;
        }
        self.keep()
    }

    /// Writes only a checkpoint.
    fn keep(&self) -> Result<(), TrainError> {
        let options = self.options;
        let state = CheckpointState {
            architecture: self.trained.architecture().clone(),
            card: self.trained.card().clone(),
            stage: options.stage,
            seed: options.seed,
            batch: options.batch,
            steps: options.steps,
            rate: options.rate,
            rate_end: options.rate_end,
            minutes: options.minutes,
            repulsion: options.refining.repulsion,
            attention: options.refining.attention,
            step: self.adam.step,
            seconds: self.seconds(),
            records: self.records.clone(),
        };
        checkpoint::save(&checkpoint_path(&options.out), &state, &self.trained, &self.adam)
    }
}

fn first_weights<T: Trainee>(
    options: &TrainOptions<T::Architecture>,
    provenance: &Provenance,
    device: &Device,
) -> Result<T, TrainError> {
    let mut trained = match &options.init {
        Some(path) => {
            let bytes = std::fs::read(path).map_err(TrainError::io(path))?;
            T::read(&bytes, device)?.grown(&options.architecture, options.seed)?
        }
        None => {
            let card = Card {
                expert: String::new(),
                licence: String::new(),
                trained_on: String::new(),
                untrained: false,
                notes: Default::default(),
            };
            T::random(options.architecture.clone(), card, options.seed, device)?
        }
    };
    let card = trained.card_mut();
    let before = options.init.is_some() && !card.untrained;
    if before && card.expert != options.expert {
        let reason = format!("the weights to begin with are of the expert \"{}\"", card.expert);
        return Err(TrainError::Invalid(reason));
    }
    let own = options.trained_on.clone().unwrap_or_else(|| provenance.words());
    let mut licences = vec![provenance.licence()];
    if before {
        licences.push(card.licence.clone());
    }
    card.licence = strictest(licences.iter().map(String::as_str)).unwrap_or_default();
    card.trained_on = match before && card.trained_on != own {
        true => format!("{}, then {own}", card.trained_on),
        false => own,
    };
    card.expert.clone_from(&options.expert);
    card.untrained = false;
    Ok(trained)
}

fn same_run<A: PartialEq>(
    path: &Path,
    options: &TrainOptions<A>,
    records: &str,
    state: &CheckpointState<A>,
) -> Result<(), TrainError> {
    let differs = |what: &str| {
        Err(TrainError::damaged(path, format!("the checkpoint is of a run with another {what}")))
    };
    match () {
        () if state.records != records => differs("set of records"),
        () if state.stage != options.stage => differs("stage"),
        () if state.seed != options.seed => differs("seed"),
        () if state.batch != options.batch => differs("batch"),
        () if state.steps != options.steps => differs("number of steps"),
        () if state.rate != options.rate => differs("rate"),
        () if state.rate_end != options.rate_end => differs("rate at the end"),
        () if state.minutes != options.minutes => differs("number of minutes"),
        () if (state.repulsion, state.attention)
            != (options.refining.repulsion, options.refining.attention) =>
        {
            differs("choice of what to leave out")
        }
        () if state.card.expert != options.expert => differs("expert"),
        () if options.init.is_none() && state.architecture != options.architecture => differs("architecture"),
        () => Ok(()),
    }
}
