//! `dragtraffic lab reproduce`.

use super::failed;
use crate::cli::inputs::patterns;
use crate::cli::{Common, Exit, Failure, interrupt, output};
use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum};
use lab_reproduce::{
    CollisionOptions, Data, Length, OtherRun, Parts, RunOptions, Schedule, SetOptions, Stopped, paper,
};
use lab_train::scenes::Crop;
use scene::{HORIZON_STEPS, STEP_S};
use std::path::PathBuf;

/// Files of each input in a quick run.
const QUICK_FILES: usize = 150;
/// Scenes for Table II in a quick run.
const QUICK_SCENES: [usize; 2] = [16, 16];

/// Flags of `reproduce`.
#[derive(Args, Clone, Debug)]
pub struct ReproduceArgs {
    /// Files, folders or patterns of recordings in any format, such as Waymo Scenario TFRecords of 9 or 20 s.
    /// A tenth of their places is held out for validation and, without --test, another tenth for the test.
    #[arg(required = true)]
    data: Vec<PathBuf>,
    /// Files, folders or patterns used only for the test; their places are never trained on.
    #[arg(long, value_name = "PATH")]
    test: Vec<PathBuf>,
    /// Folder of the run; an interrupted run continues with what it holds.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Train briefly and use few scenes: 10 min on two cores.
    #[arg(long)]
    quick: bool,
    /// Make only this result.
    #[arg(long, value_enum)]
    only: Option<Only>,
    /// Seed that draws initial weights, batches, noise and conditions.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Length of an interval and distance between two starts, s.
    #[arg(long, value_name = "SECONDS", default_value = "6", value_parser = interval)]
    interval: usize,
    /// Side of the square around the ego, a pedestrian or a cyclist, m.
    #[arg(long, value_name = "METRES", default_value_t = 120.0)]
    crop: f64,
    /// Minimum number of road users of a square at its first frame.
    #[arg(long, value_name = "N", default_value_t = 32)]
    least_agents: usize,
    /// Minimum number of frames at which an evaluated road user is known.
    #[arg(long, value_name = "N", default_value_t = 30)]
    frames: usize,
    /// Intersection over union above which two boxes collide in Table II.
    #[arg(long, default_value_t = lab_eval::together::PAPER_IOU)]
    iou: f64,
    /// Hidden units of the condition MLP. The paper uses 1024.
    #[arg(long, value_name = "N", default_value_t = 128,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=4096))]
    condition_width: usize,
    /// Epochs of the denoiser, of the regressors, and of both together. Default: those of the paper, fewer
    /// with --quick.
    #[arg(long, value_name = "D,R,J", value_parser = epochs)]
    epochs: Option<[f64; 3]>,
    /// Initial learning rate. The paper uses 3e-4.
    #[arg(long)]
    rate: Option<f64>,
    /// Final learning rate. The paper uses 4e-5.
    #[arg(long)]
    rate_end: Option<f64>,
    /// Records per step.
    #[arg(long, value_name = "N")]
    batch: Option<usize>,
    /// Maximum number of files of the data and of the test, spread evenly over their names.
    #[arg(long, value_name = "N")]
    files: Option<usize>,
    /// CPU threads per training step; the result does not depend on it.
    #[arg(long, default_value_t = 2)]
    workers: usize,
    /// Start a new run even if the folder holds one.
    #[arg(long)]
    force: bool,
}

/// One of the results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Only {
    /// Tables I and II.
    Tables,
    /// Creating, editing, correcting, and the cases (a) to (d), with the shipped weights.
    Figure,
}

/// Converts seconds to steps.
fn interval(text: &str) -> Result<usize, String> {
    let steps = text.parse::<f64>().map(|seconds| (seconds / STEP_S).round());
    match steps {
        Ok(steps) if (30.0..=HORIZON_STEPS as f64).contains(&steps) => Ok(steps as usize),
        _ => Err("3 to 9 seconds expected".into()),
    }
}

/// Parses three numbers separated by commas.
fn epochs(text: &str) -> Result<[f64; 3], String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|part| part.trim().parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0))
        .collect();
    let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| "three numbers above 0 expected, as in 100,150,40".into())
}

/// Reproduces the paper's tables and figure from recordings.
///
/// # Errors
/// Exit 1 with the reason, 7 without weights, 8 when the folder holds another run, 130 on Ctrl-C.
pub fn reproduce(args: ReproduceArgs, common: &Common) -> Result<(), Failure> {
    let args = ReproduceArgs { data: patterns(&args.data)?, test: patterns(&args.test)?, ..args };
    let stop = interrupt::gently();
    let engine = common.engine()?;
    let options = args.options(stop);
    if args.force {
        lab_reproduce::forget(&options.out).map_err(failed)?;
    }
    let quiet = common.quiet;
    let progress = |line: &str| {
        if !quiet {
            output::complain(line);
        }
    };
    let text = lab_reproduce::run(&options, engine, &progress).map_err(|error| {
        let exit = match () {
            () if error.is::<Stopped>() => Exit::Interrupted,
            () if error.is::<OtherRun>() => Exit::OutputExists,
            () => Exit::Failure,
        };
        Failure::new(exit, format!("{error:#}"))
    })?;
    output::print(text.as_bytes())
}

impl ReproduceArgs {
    fn options(&self, stop: lab_reproduce::Stop) -> RunOptions {
        let base = if self.quick { Schedule::QUICK } else { Schedule::PAPER };
        let [denoiser, regressor, joint] = match self.epochs {
            Some(epochs) => epochs.map(Length::Epochs),
            None => [base.denoiser, base.regressor, base.joint],
        };
        let most = paper::INTERACTIVE.map(|(_, most)| most);
        RunOptions {
            data: Data {
                data: self.data.clone(),
                test: self.test.clone(),
                most_files: self.files.unwrap_or(if self.quick { QUICK_FILES } else { usize::MAX }),
            },
            out: self.output.clone(),
            sets: SetOptions {
                interval_steps: self.interval,
                crop: Crop { side_m: Some(self.crop), least_agents: self.least_agents },
                least_frames: self.frames,
                draws: 2,
                most_vehicles: 16,
                seed: self.seed,
            },
            schedule: Schedule {
                denoiser,
                regressor,
                joint,
                rate: self.rate.unwrap_or(base.rate),
                rate_end: self.rate_end.unwrap_or(base.rate_end),
                batch: self.batch.unwrap_or(base.batch),
            },
            condition_width: self.condition_width,
            collisions: CollisionOptions {
                iou: self.iou,
                most: if self.quick { QUICK_SCENES } else { most },
                seed: self.seed,
            },
            parts: Parts { tables: self.only != Some(Only::Figure), figure: self.only != Some(Only::Tables) },
            seed: self.seed,
            threads: self.workers,
            stop,
        }
    }
}
