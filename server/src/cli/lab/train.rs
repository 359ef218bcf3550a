//! `dragtraffic lab train`.

use super::failed;
use crate::cli::progress::Progress;
use crate::cli::{Common, Exit, Failure, interrupt, output};
use clap::{Args, ValueEnum};
use experts::Refining;
use experts::net::Architecture;
use lab_train::baselines::{self, BaselineKind};
use lab_train::training::{self, Processor, Stage, TrainError};
use scene::AgentType;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The refiner's input with the descent direction of the scene's energy.
const PUSH: &str = "push";
/// The refiner's attention to encountered drafts.
const ATTENTION: &str = "attention";

/// Flags of `train`.
#[derive(Args, Clone, Debug)]
pub struct TrainArgs {
    /// Files written by `lab prepare`.
    #[arg(required = true, value_name = "FILE")]
    records: Vec<PathBuf>,
    /// Stage of the training, in this order.
    #[arg(long, value_enum, value_name = "STAGE", required_unless_present = "baseline")]
    stage: Option<Stage>,
    /// Expert to train.
    #[arg(long, value_enum, value_name = "TYPE", required_unless_present = "baseline")]
    expert: Option<AgentType>,
    /// Train a baseline for `lab eval --baseline` instead of an expert. trafficgen takes the records of
    /// vehicles, trafficgen-conditional one file per type, paper an --expert and the three stages.
    #[arg(long, value_enum, value_name = "METHOD")]
    baseline: Option<BaselineKind>,
    /// Weights file to write; its checkpoint lies beside it.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Weights of the previous stage.
    #[arg(long, value_name = "FILE")]
    init: Option<PathBuf>,
    /// Optimiser steps.
    #[arg(long, value_name = "N", default_value_t = 3000)]
    steps: u64,
    /// Passes through the records, instead of --steps.
    #[arg(long, value_name = "N", conflicts_with = "steps")]
    epochs: Option<f64>,
    /// Records per step.
    #[arg(long, value_name = "N", default_value_t = 64)]
    batch: usize,
    /// Maximum learning rate.
    #[arg(long, value_name = "RATE", default_value_t = 1e-3)]
    rate: f64,
    /// Final learning rate. Default: a hundredth of the maximum.
    #[arg(long, value_name = "RATE")]
    rate_end: Option<f64>,
    /// Pairs of attention in the refiner: to the drafts that each draft meets, then to the context. More than --init
    /// has begin with random weights; 0 keeps those of --init.
    #[arg(long, value_name = "N", default_value_t = 0, conflicts_with = "baseline", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(0..=16))]
    refiner_attention: usize,
    /// Hidden units of a baseline's condition MLP. The paper uses 1024.
    #[arg(long, value_name = "N", default_value_t = 128, value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=4096))]
    condition_width: usize,
    /// Device that computes the networks. cuda needs a program built with the feature cuda; only the CPU
    /// repeats a run bit for bit.
    #[arg(long, value_enum, value_name = "DEVICE", default_value = "cpu")]
    device: Processor,
    /// CPU threads per step; the result does not depend on it.
    #[arg(long, value_name = "N", default_value_t = 1)]
    workers: usize,
    /// Seed that draws records and initial weights.
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Parts of the refinement to leave out, for ablation.
    #[arg(long, value_name = "PART", value_delimiter = ',', value_parser = [PUSH, ATTENTION])]
    without: Vec<String>,
    /// Stop after this time, min, with the learning rate scaled to it; the result then depends on the speed
    /// of the machine.
    #[arg(long, value_name = "MINUTES")]
    minutes: Option<f64>,
    /// Continue from the checkpoint, which is written at each validation, each minute and on Ctrl-C. The
    /// weights with the lowest held-out loss have the suffix .best.
    #[arg(long)]
    resume: bool,
    /// Overwrite existing weights.
    #[arg(long)]
    force: bool,
    /// Description of the data for the header of the weights. Default: the description in the records. The
    /// licence is always the strictest of the records.
    #[arg(long, value_name = "TEXT")]
    trained_on: Option<String>,
}

/// The name of a type on the command line, which is the name of its expert.
fn word(agent_type: AgentType) -> String {
    agent_type.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// Trains an expert.
///
/// # Errors
/// Exit 1 with the reason.
pub fn train(mut args: TrainArgs, common: &Common) -> Result<(), Failure> {
    let goes_on = args.resume && training::checkpoint_path(&args.output).exists();
    if !goes_on {
        output::keep(&args.output, args.force)?;
    }
    if let Some(epochs) = args.epochs {
        args.steps = training::steps_of(&args.records, epochs, args.batch).map_err(failed)?;
    }
    let stop = interrupt::gently();
    let stage = args.stage.unwrap_or(Stage::Initializer);
    let (records, output) = (args.records.clone(), args.output.clone());
    let progress = Progress::new("steps", args.steps, common.quiet);
    let mut report = |line: &training::TrainProgress| {
        progress.line(&line.to_string());
        match line {
            training::TrainProgress::Begin { step, .. } => progress.begin(*step),
            training::TrainProgress::Training { step, .. } => progress.reach(*step),
            training::TrainProgress::Validation { .. } => {}
        }
    };
    let expert = args.expert.map(word);
    let done = match args.baseline {
        None => {
            let mut options = training::TrainOptions::new(records, stage, output);
            options.architecture = args.expert.map_or_else(Architecture::default, Architecture::of);
            options.architecture.refiner_attention = args.refiner_attention;
            training::run(&args.set(options, expert.unwrap_or_default(), stop), &mut report)
        }
        Some(kind) => {
            let expert = kind.expert().map(str::to_owned).or(expert);
            let expert =
                expert.ok_or_else(|| Failure::new(Exit::Usage, "--baseline paper needs --expert"))?;
            let mut options = baselines::options(kind, records, stage, output);
            options.architecture.condition_width = args.condition_width;
            baselines::train(&args.set(options, expert, stop), &mut report)
        }
    };
    match done {
        Err(stopped @ TrainError::Stopped { .. }) => {
            Err(Failure::new(Exit::Interrupted, stopped.to_string()))
        }
        done => done.map(drop).map_err(failed),
    }
}

impl TrainArgs {
    /// Sets the options that all trainings share.
    fn set<A>(
        self,
        options: training::TrainOptions<A>,
        expert: String,
        stop: Arc<AtomicBool>,
    ) -> training::TrainOptions<A> {
        training::TrainOptions {
            expert,
            init: self.init,
            steps: self.steps,
            batch: self.batch,
            rate: self.rate,
            rate_end: self.rate_end,
            processor: self.device,
            threads: self.workers,
            seed: self.seed,
            refining: Refining {
                repulsion: !self.without.iter().any(|part| part == PUSH),
                attention: !self.without.iter().any(|part| part == ATTENTION),
                ..options.refining
            },
            minutes: self.minutes,
            resume: self.resume,
            trained_on: self.trained_on,
            stop,
            ..options
        }
    }
}
