//! `dragtraffic synthesize`, `prepare`, `train`, `eval`, `bench`: the only file that knows how experts are made.

use super::{Common, Exit, Failure, output};
use clap::{Args, ValueEnum};
use experts::net::Architecture;
use experts::{Refining, Tuning};
use lab::baselines::{self, Baseline, Kind};
use lab::crop::Crop;
use lab::eval::{Judged, Table};
use lab::synthesize::{self, Options, Template};
use lab::train::{Processor, Stage};
use scene::AgentType;
use std::path::PathBuf;

/// Flags of `synthesize`.
#[derive(Args, Clone, Debug)]
pub struct SynthesizeArgs {
    /// Seeds to work on; each gives one file.
    #[arg(long, default_value_t = 1)]
    count: u64,
    /// First seed.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Folder to write to; files that are there already are kept.
    #[arg(short, long)]
    output: PathBuf,
    /// Windows of 9 seconds cut from each seed's two minutes.
    #[arg(long, default_value_t = 40)]
    per_seed: usize,
    /// Seeds worked on at the same time; 0 means one a core.
    #[arg(long, default_value_t = 0)]
    threads: usize,
    /// SUMO's folder, with bin/ in it; else SUMO_HOME, else PATH.
    #[arg(long, value_name = "DIR")]
    sumo_home: Option<PathBuf>,
    /// Kind of all networks; mixed when absent.
    #[arg(long, value_enum)]
    template: Option<TemplateWord>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum TemplateWord {
    Crossing,
    Grid,
    Arterial,
    Lot,
    Roundabout,
    Motorway,
    Quarter,
}

impl From<TemplateWord> for Template {
    fn from(word: TemplateWord) -> Self {
        match word {
            TemplateWord::Crossing => Self::Crossing,
            TemplateWord::Grid => Self::Grid,
            TemplateWord::Arterial => Self::Arterial,
            TemplateWord::Lot => Self::Lot,
            TemplateWord::Roundabout => Self::Roundabout,
            TemplateWord::Motorway => Self::Motorway,
            TemplateWord::Quarter => Self::Quarter,
        }
    }
}

/// Whose expert.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum ExpertWord {
    Vehicle,
    Pedestrian,
    Cyclist,
}

impl ExpertWord {
    fn agent_type(self) -> AgentType {
        match self {
            Self::Vehicle => AgentType::Vehicle,
            Self::Pedestrian => AgentType::Pedestrian,
            Self::Cyclist => AgentType::Cyclist,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Vehicle => "vehicle",
            Self::Pedestrian => "pedestrian",
            Self::Cyclist => "cyclist",
        }
    }
}

/// Flags of `statistics`.
#[derive(Args, Clone, Debug)]
pub struct StatisticsArgs {
    /// Sets of scenes, each NAME=PATH; a column of the table each.
    #[arg(required = true, value_name = "NAME=PATH")]
    sets: Vec<String>,
    /// Print JSON, not Markdown.
    #[arg(long)]
    json: bool,
    /// Most files of a set, spread evenly over it.
    #[arg(long, default_value_t = 250)]
    most: usize,
}

/// Flags of `prepare`.
#[derive(Args, Clone, Debug)]
pub struct PrepareArgs {
    /// Files or folders of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// File of records to write.
    #[arg(short, long)]
    output: PathBuf,
    /// Whose expert the records are for.
    #[arg(long, value_enum)]
    expert: ExpertWord,
    /// Draws road users and conditions.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Most road users of a scene.
    #[arg(long, default_value_t = 6)]
    per_scene: usize,
    /// Choices of conditions for each moving road user.
    #[arg(long, default_value_t = 2)]
    draws: usize,
    /// Stop after so many records.
    #[arg(long, default_value_t = 200_000)]
    most: u64,
    /// Side of a square about the ego (else the first road user), metres: those outside are left out. The
    /// paper's is 120.
    #[arg(long, value_name = "METRES", value_parser = metres)]
    crop: Option<f64>,
    /// Leave out scenes with fewer road users at the first step. The paper's least is 32.
    #[arg(long, value_name = "N", default_value_t = 0)]
    least_agents: usize,
    /// Take each scene's mirror image too: twice the records from few scenes.
    #[arg(long)]
    mirror: bool,
}

/// Flags of `train`.
#[derive(Args, Clone, Debug)]
pub struct TrainArgs {
    /// Files made by `prepare`.
    #[arg(required = true)]
    records: Vec<PathBuf>,
    /// denoiser, then initializer, then joint.
    #[arg(long, value_enum, required_unless_present = "baseline")]
    stage: Option<StageWord>,
    /// Which expert.
    #[arg(long, value_enum, required_unless_present = "baseline")]
    expert: Option<ExpertWord>,
    /// Train a rival of the experts in their place, for `eval --baseline`. trafficgen takes vehicles' records,
    /// trafficgen-conditional a file of each type, paper an --expert and the three stages.
    #[arg(long, value_enum)]
    baseline: Option<BaselineWord>,
    /// Weights file to write; its checkpoint lies beside it.
    #[arg(short, long)]
    output: PathBuf,
    /// Weights of the stage before.
    #[arg(long)]
    init: Option<PathBuf>,
    /// Optimiser steps.
    #[arg(long, default_value_t = 3000)]
    steps: u64,
    /// Records a step.
    #[arg(long, default_value_t = 64)]
    batch: usize,
    /// Greatest learning rate.
    #[arg(long, default_value_t = 1e-3)]
    rate: f64,
    /// What computes the networks. cuda is the first NVIDIA graphics card, in a program built with the feature
    /// cuda; only the CPU gives the same bits again.
    #[arg(long, value_enum, default_value_t = DeviceWord::Cpu)]
    device: DeviceWord,
    /// Threads that share a step on the CPU; the result does not depend on it.
    #[arg(long, default_value_t = 1)]
    workers: usize,
    /// Draws records and first weights.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Parts of refinement to leave out, to see what they bring.
    #[arg(long, value_enum, value_delimiter = ',')]
    without: Vec<PartWord>,
    /// End after this time, the rate falling accordingly; the result then depends on the machine's speed.
    #[arg(long, value_name = "MINUTES")]
    minutes: Option<f64>,
    /// Go on from the checkpoint.
    #[arg(long)]
    resume: bool,
    /// What the data are, for the weights' header.
    #[arg(long, default_value = "Synthetic traffic made by dragtraffic synthesize (CC0)")]
    trained_on: String,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum StageWord {
    Denoiser,
    Initializer,
    Joint,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum DeviceWord {
    Cpu,
    Cuda,
}

impl From<DeviceWord> for Processor {
    fn from(word: DeviceWord) -> Self {
        match word {
            DeviceWord::Cpu => Self::Cpu,
            DeviceWord::Cuda => Self::Cuda,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum PartWord {
    /// The way downhill in the scene's energy.
    Push,
}

impl From<StageWord> for Stage {
    fn from(word: StageWord) -> Self {
        match word {
            StageWord::Denoiser => Self::Denoiser,
            StageWord::Initializer => Self::Initializer,
            StageWord::Joint => Self::Joint,
        }
    }
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BaselineWord {
    Trafficgen,
    TrafficgenConditional,
    Paper,
}

impl From<BaselineWord> for Kind {
    fn from(word: BaselineWord) -> Self {
        match word {
            BaselineWord::Trafficgen => Self::TrafficGen,
            BaselineWord::TrafficgenConditional => Self::TrafficGenConditional,
            BaselineWord::Paper => Self::Paper,
        }
    }
}

/// Flags of `train-placement`.
#[derive(Args, Clone, Debug)]
pub struct TrainPlacementArgs {
    /// Files or folders of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// Weights file to write.
    #[arg(short, long)]
    output: PathBuf,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
    /// What the data are, for the weights' header.
    #[arg(long, default_value = "Synthetic traffic made by dragtraffic synthesize (CC0)")]
    trained_on: String,
}

/// Flags of `eval-place`.
#[derive(Args, Clone, Debug)]
pub struct EvalPlaceArgs {
    #[command(flatten)]
    scenes: SceneArgs,
    /// Region: a circle of this radius about the ego, metres.
    #[arg(long, default_value_t = 60.0)]
    radius: f64,
    /// Placements of each scene.
    #[arg(long, default_value_t = 4)]
    seeds: u64,
    /// JSON in place of Markdown.
    #[arg(long)]
    json: bool,
}

/// Flags of `eval`.
#[derive(Args, Clone, Debug)]
pub struct EvalArgs {
    #[command(flatten)]
    scenes: SceneArgs,
    /// Name of the weights in the tables.
    #[arg(long, default_value = "ours")]
    name: String,
    /// Further weights to judge beside them.
    #[arg(long, value_name = "NAME=DIR", value_parser = named_folder)]
    also: Vec<(String, PathBuf)>,
    /// The same weights with one tuned number changed, beside them in the same tables: a name of
    /// `experts::tuning`, such as `choice.overlap`. Without a value, what the number is for is left out.
    #[arg(long, value_name = "NAME[=VALUE]", value_parser = tuned)]
    ablate: Vec<(String, Tuning)>,
    /// Learned rivals to stand beside them in tables 1, 2 and 4: weights made by `train --baseline`, a file or
    /// a folder with one for each type.
    #[arg(long, value_name = "NAME=PATH", value_parser = named_folder)]
    baseline: Vec<(String, PathBuf)>,
    /// Tables to make: 1 quality, 2 coherence, 3 control, 4 realism, 5 variety, 6 cost, 7 ablations; and the long
    /// 8, refinement (some ten minutes of a core for 40 scenes).
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2, 3, 4, 5, 6, 7],
          value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=8))]
    tables: Vec<usize>,
    /// Folder for the tables as Markdown and JSON and for pictures of the best, the worst and random cases.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Draws noise, resamples, drags and random pictures.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Table 2: lines for the product re-planned every so many seconds, 0.1 to 9 each.
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', default_values = ["3", "6", "9"],
          value_parser = replan_steps)]
    replan: Vec<usize>,
    /// The paper's crop: road users of a 120 m square about the ego alone, scenes with at least 32 of them.
    #[arg(long)]
    paper_crop: bool,
}

/// Flags of `bench`.
#[derive(Args, Clone, Debug)]
pub struct BenchArgs {
    #[command(flatten)]
    scenes: SceneArgs,
}

/// Scenes to look at.
#[derive(Args, Clone, Debug)]
struct SceneArgs {
    /// Files or folders of scenes in any format.
    #[arg(required = true)]
    inputs: Vec<PathBuf>,
    /// Most files, in the order of their names.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    scenes: usize,
}

/// Seconds as steps of the scene.
fn replan_steps(text: &str) -> Result<usize, String> {
    let steps = text.parse::<f64>().map(|seconds| (seconds / scene::STEP_S).round());
    match steps {
        Ok(steps) if (1.0..=scene::HORIZON_STEPS as f64).contains(&steps) => Ok(steps as usize),
        _ => Err("0.1 to 9 seconds expected".into()),
    }
}

fn metres(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(metres) if f64::is_finite(metres) && metres > 0.0 => Ok(metres),
        _ => Err("a length above 0 in metres expected".into()),
    }
}

/// A tuned number and its value as text, and all numbers with that one changed.
fn tuned(text: &str) -> Result<(String, Tuning), String> {
    let (name, value) = match text.split_once('=') {
        Some((name, value)) => (name, Some(value.parse().map_err(|_| format!("\"{value}\" is no number"))?)),
        None => (text, None),
    };
    let changed = Tuning::default().with(name, value).map_err(|error| error.to_string())?;
    Ok((text.to_owned(), changed))
}

fn named_folder(text: &str) -> Result<(String, PathBuf), String> {
    match text.split_once('=') {
        Some((name, folder)) if !name.is_empty() && !folder.is_empty() => Ok((name.into(), folder.into())),
        _ => Err("NAME=DIR expected".into()),
    }
}

/// Makes training windows.
///
/// # Errors
/// Exit 1 without SUMO, 4 when some seeds failed.
pub fn synthesize(args: SynthesizeArgs, common: &Common) -> Result<(), Failure> {
    let options = Options {
        seeds: args.seed..args.seed.saturating_add(args.count),
        out_dir: args.output,
        threads: args.threads,
        sumo_home: args.sumo_home,
        per_seed: args.per_seed,
        template: args.template.map(Template::from),
    };
    let quiet = common.quiet;
    let report = synthesize::run(&options, &|progress| {
        if !quiet {
            let (done, all) = progress.finished;
            let windows = progress.windows.map_or("there already".into(), |n| format!("{n} windows"));
            output::complain(&format!("seed {}: {windows} ({done} of {all})", progress.seed));
        }
    })
    .map_err(|error| Failure::new(Exit::Failure, error.to_string()))?;
    let [vehicles, pedestrians, cyclists] = report.agents;
    let line = serde_json::json!({
        "written": report.written, "skipped": report.skipped, "windows": report.windows,
        "vehicles": vehicles, "pedestrians": pedestrians, "cyclists": cyclists, "failed": report.failed.len(),
    });
    output::print(format!("{line}\n").as_bytes())?;
    for (seed, reason) in &report.failed {
        output::complain(&format!("seed {seed} failed: {reason}"));
    }
    if report.failed.is_empty() {
        return Ok(());
    }
    Err(Failure::new(Exit::Partly, format!("{} seeds failed", report.failed.len())))
}

/// Sums up sets of scenes, one column each.
///
/// # Errors
/// Exit 3 when a set cannot be read.
pub fn statistics(args: StatisticsArgs) -> Result<(), Failure> {
    let unreadable = |reason: String| Failure::new(Exit::Input, reason);
    let mut columns = Vec::new();
    for set in &args.sets {
        let (name, path) =
            set.split_once('=').ok_or_else(|| unreadable(format!("{set}: expected NAME=PATH")))?;
        let files =
            lab::prepare::scene_files(&[PathBuf::from(path)]).map_err(|e| unreadable(e.to_string()))?;
        let every = files.len().div_ceil(args.most.max(1)).max(1);
        let mut statistics = lab::statistics::Statistics::default();
        for file in files.iter().step_by(every) {
            let scenes = lab::prepare::read_scenes(file).map_err(|e| unreadable(e.to_string()))?;
            scenes.iter().for_each(|scene| statistics.add(scene));
        }
        columns.push((name.to_owned(), statistics));
    }
    if args.json {
        let rows: std::collections::BTreeMap<_, _> =
            columns.iter().map(|(n, s)| (n, s.summaries())).collect();
        return print_json(&rows);
    }
    output::print(lab::statistics::markdown(&columns).as_bytes())
}

/// Makes training records.
///
/// # Errors
/// Exit 3 when nothing can be read, 1 when the records cannot be written.
pub fn prepare(args: PrepareArgs, common: &Common) -> Result<(), Failure> {
    let options = lab::prepare::Options {
        inputs: args.inputs,
        out: args.output,
        agent_type: args.expert.agent_type(),
        seed: args.seed,
        per_scene: args.per_scene,
        draws: args.draws,
        most_records: args.most,
        crop: Crop { side_m: args.crop, least_agents: args.least_agents },
        mirror: args.mirror,
    };
    let progress = |report: &lab::prepare::Report| {
        if !common.quiet {
            output::complain(&format!(
                "{} files, {} scenes, {} records",
                report.files, report.scenes, report.records
            ));
        }
    };
    let report = lab::prepare::run(&options, progress).map_err(failed)?;
    print_json(&report)
}

/// Trains an expert.
///
/// # Errors
/// Exit 1 with the reason.
pub fn train(args: TrainArgs, common: &Common) -> Result<(), Failure> {
    let stage = args.stage.map_or(Stage::Initializer, Stage::from);
    let (records, output) = (args.records.clone(), args.output.clone());
    let quiet = common.quiet;
    let mut report = |line: &lab::train::Progress| {
        if !quiet {
            output::complain(&line.to_string());
        }
    };
    let expert = args.expert.map(ExpertWord::name);
    let done = match args.baseline.map(Kind::from) {
        None => {
            let mut options = lab::train::Options::new(records, stage, output);
            options.architecture = args
                .expert
                .map_or_else(Architecture::default, |expert| Architecture::of(expert.agent_type()));
            lab::train::run(&args.set(options, expert.unwrap_or_default()), &mut report)
        }
        Some(kind) => {
            let expert = kind.expert().or(expert);
            let expert = expert
                .ok_or_else(|| Failure::new(Exit::Usage, "--baseline paper: --expert says whose it is"))?;
            let options = baselines::options(kind, records, stage, output);
            baselines::train(&args.set(options, expert), &mut report)
        }
    };
    done.map(drop).map_err(|error| Failure::new(Exit::Failure, error.to_string()))
}

impl TrainArgs {
    /// Fills in what all trainings have.
    fn set<A>(self, options: lab::train::Options<A>, expert: &str) -> lab::train::Options<A> {
        lab::train::Options {
            expert: expert.to_owned(),
            init: self.init,
            steps: self.steps,
            batch: self.batch,
            rate: self.rate,
            processor: self.device.into(),
            threads: self.workers,
            seed: self.seed,
            refining: Refining { repulsion: !self.without.contains(&PartWord::Push), ..options.refining },
            minutes: self.minutes,
            resume: self.resume,
            trained_on: self.trained_on,
            ..options
        }
    }
}

/// Learns the placement weights.
///
/// # Errors
/// Exit 1 when nothing can be read, 8 when the output exists.
pub fn train_placement(args: TrainPlacementArgs, common: &Common) -> Result<(), Failure> {
    let options = lab::placement::Options { inputs: args.inputs, trained_on: args.trained_on };
    let progress = |summary: &lab::placement::Summary| {
        if !common.quiet {
            output::complain(&format!("{} files, {} scenes", summary.files, summary.scenes));
        }
    };
    let (model, summary) = lab::placement::run(&options, progress).map_err(failed)?;
    let bytes = model.save().map_err(|e| Failure::new(Exit::Failure, e.to_string()))?;
    output::write(Some(&args.output), &bytes, args.force)?;
    print_json(&summary)
}

/// Compares placed road users with recorded ones.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights.
pub fn eval_place(args: EvalPlaceArgs, common: &Common) -> Result<(), Failure> {
    let scenes = scenes(&args.scenes)?;
    let placer = super::engine(common)?.placer;
    let options = lab::placement::EvalOptions { radius_m: args.radius, seeds: args.seeds };
    let report = lab::placement::eval(&placer, &scenes, options).map_err(failed)?;
    if args.json { print_json(&report) } else { output::print(lab::placement::markdown(&report).as_bytes()) }
}

/// Judges the experts on scenes: the tables to stdout as Markdown, everything to the output folder.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights.
pub fn eval(args: EvalArgs, common: &Common) -> Result<(), Failure> {
    let scenes = scenes(&args.scenes)?;
    // Scenes are judged side by side, each on one thread.
    let one =
        |name: String, generator: experts::Generator| Judged { name, generator: generator.with_threads(1) };
    let mut judged = vec![one(args.name.clone(), super::generator(common)?)];
    for (what, tuning) in args.ablate {
        let changed = super::generator(common)?.with_tuning(tuning);
        judged.push(one(format!("{}, {what}", args.name), changed));
    }
    for (name, folder) in args.also {
        let common = Common { weights: Some(folder), ..common.clone() };
        judged.push(one(name, super::generator(&common)?));
    }
    let baselines: Result<Vec<Baseline>, Failure> = args
        .baseline
        .iter()
        .map(|(name, path)| {
            Baseline::load(name, path).map_err(|e| Failure::new(Exit::Weights, format!("{e:#}")))
        })
        .collect();
    let baselines = baselines?;
    let options = lab::eval::Options {
        tables: args.tables.into_iter().filter_map(Table::numbered).collect(),
        seed: args.seed,
        pictures: args.output.is_some(),
        replan_steps: args.replan,
        crop: if args.paper_crop { Crop::PAPER } else { Crop::default() },
    };
    let quiet = common.quiet;
    let progress = |line: &str| {
        if !quiet {
            output::complain(line);
        }
    };
    let report = lab::eval::run(judged, &baselines, &scenes, &options, &progress).map_err(failed)?;
    if let Some(folder) = &args.output {
        report.write(folder).map_err(failed)?;
    }
    let cost: String = report.cost.iter().map(|sheet| sheet.markdown()).collect();
    output::print(format!("{}{cost}", report.markdown()).as_bytes())
}

/// Times answers at one thread and at two.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights.
pub fn bench(args: BenchArgs, common: &Common) -> Result<(), Failure> {
    let scenes = scenes(&args.scenes)?;
    let mut rows = Vec::new();
    for threads in [1, 2] {
        let generator = super::generator(common)?.with_threads(threads);
        generator.warm_up();
        rows.extend(lab::eval::cost::latency(&generator, threads, &scenes).map_err(failed)?);
    }
    print_json(&rows)
}

/// # Errors
/// Exit 3 when no file holds a scene.
fn scenes(args: &SceneArgs) -> Result<Vec<scene::Scene>, Failure> {
    let unreadable = |error: anyhow::Error| Failure::new(Exit::Input, error.to_string());
    let files = lab::prepare::scene_files(&args.inputs).map_err(unreadable)?;
    let read = files.iter().take(args.scenes).map(|file| lab::prepare::read_scenes(file));
    let scenes: Vec<scene::Scene> = read.filter_map(Result::ok).flatten().collect();
    if scenes.is_empty() {
        return Err(Failure::new(Exit::Input, "no file holds a scene that can be read"));
    }
    Ok(scenes)
}

fn failed(error: anyhow::Error) -> Failure {
    Failure::new(Exit::Failure, error.to_string())
}

fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|e| Failure::new(Exit::Failure, e.to_string()))?;
    output::print(format!("{text}\n").as_bytes())
}
