//! `dragtraffic lab eval` and `bench`.

use super::{SceneArgs, crowd_bench, failed, http_bench, print_json, run_bench, scenes};
use crate::cli::progress::Progress;
use crate::cli::{Common, Exit, Failure, output};
use clap::Args;
use experts::Tuning;
use lab_eval::{EvalReport, Judged, TABLES, TABLES_FILE, TableSpec};
use lab_train::baselines::Baseline;
use lab_train::scenes::Crop;
use std::path::PathBuf;

/// Flags of `eval`.
#[derive(Args, Clone, Debug)]
pub struct EvalArgs {
    #[command(flatten)]
    scenes: SceneArgs,
    /// Name of the weights in the tables.
    #[arg(long, default_value = "ours")]
    name: String,
    /// Further weights to evaluate.
    #[arg(long, value_name = "NAME=DIR", value_parser = named_folder)]
    also: Vec<(String, PathBuf)>,
    /// The same weights with one tuned number changed, such as `choice.overlap` of `experts::tuning`. Without
    /// a value, the term of that number is left out.
    #[arg(long, value_name = "NAME[=VALUE]", value_parser = tuned)]
    ablate: Vec<(String, Tuning)>,
    /// Trained baselines for tables 1, 2 and 4: weights of `lab train --baseline`, one file or a folder with
    /// one file per type.
    #[arg(long, value_name = "NAME=PATH", value_parser = named_folder)]
    baseline: Vec<(String, PathBuf)>,
    /// Tables to compute, by number or name: 1 quality, 2 coherence, 3 control, 4 realism, 5 variety, 6 cost,
    /// 7 ablations, 8 refinement (about 10 min on one core for 40 scenes), 9 trust, 10 feedback.
    #[arg(long, value_name = "TABLE", value_delimiter = ',', default_values = ["1", "2", "3", "4", "5", "6", "7"],
          value_parser = table)]
    tables: Vec<&'static TableSpec>,
    /// Folder for the tables as Markdown and JSON, and for pictures of the best, the worst and random cases.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Overwrite the tables in the folder.
    #[arg(long)]
    force: bool,
    /// Seed that draws noise, resamples, drags and random pictures.
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Table 2: replan intervals to compare, 0.1 to 9 s each.
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', default_values = ["3", "6", "9"],
          value_parser = replan_steps)]
    replan: Vec<usize>,
    /// Use the paper's crop: the road users in a 120 m square around the ego, in scenes with at least 32 of
    /// them.
    #[arg(long)]
    paper_crop: bool,
}

/// Flags of `bench`.
#[derive(Args, Clone, Debug)]
pub struct BenchArgs {
    #[command(flatten)]
    scenes: SceneArgs,
    /// Measure over HTTP: start a server, and time each call beside the same request in this process.
    #[arg(long, conflicts_with = "crowd")]
    http: bool,
    /// Measure one step of a run beside 8, 32 and 128 placed road users on the map of the first scene.
    #[arg(long, conflicts_with_all = ["http", "crowd"])]
    steps: bool,
    /// Numbers of simultaneous clients, one after another; then one client that drags beside the heaviest
    /// calls. Uses the first scene, over HTTP.
    #[arg(long, value_name = "CLIENTS", value_delimiter = ',')]
    crowd: Vec<usize>,
    /// Duration of each crowd, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 30.0, requires = "crowd")]
    seconds: f64,
}

/// A table by its number or name.
fn table(text: &str) -> Result<&'static TableSpec, String> {
    let number = text.parse().ok().and_then(TableSpec::numbered);
    let named = || const { &TABLES }.iter().find(|table| table.name == text);
    number.or_else(named).ok_or_else(|| {
        let each: Vec<String> =
            TABLES.iter().map(|table| format!("{} {}", table.number, table.name)).collect();
        format!("a number or a name expected: {}", each.join(", "))
    })
}

/// Converts seconds to steps.
fn replan_steps(text: &str) -> Result<usize, String> {
    let steps = text.parse::<f64>().map(|seconds| (seconds / scene::STEP_S).round());
    match steps {
        Ok(steps) if (1.0..=scene::HORIZON_STEPS as f64).contains(&steps) => Ok(steps as usize),
        _ => Err("0.1 to 9 seconds expected".into()),
    }
}

/// Parses a tuned number and its value, and returns all numbers with that one changed.
fn tuned(text: &str) -> Result<(String, Tuning), String> {
    let (name, value) = match text.split_once('=') {
        Some((name, value)) => {
            (name, Some(value.parse().map_err(|_| format!("\"{value}\" is not a number"))?))
        }
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

/// Evaluates the experts on scenes: writes the tables to stdout as Markdown, and everything to the output
/// folder, each table as soon as it is complete.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights, 8 when the folder already has tables.
pub fn eval(args: EvalArgs, common: &Common) -> Result<(), Failure> {
    if let Some(folder) = &args.output {
        output::keep(&folder.join(TABLES_FILE), args.force)?;
    }
    let scenes = scenes(&args.scenes)?;
    // Scenes are evaluated in parallel, each on one thread.
    let one =
        |name: String, generator: experts::Generator| Judged { name, generator: generator.with_threads(1) };
    let mut judged = vec![one(args.name.clone(), common.generator()?)];
    for (what, tuning) in args.ablate {
        let changed = common.generator()?.with_tuning(tuning);
        judged.push(one(format!("{}, {what}", args.name), changed));
    }
    for (name, folder) in args.also {
        let common = Common { weights: Some(folder), ..common.clone() };
        judged.push(one(name, common.generator()?));
    }
    let baselines: Result<Vec<Baseline>, Failure> = args
        .baseline
        .iter()
        .map(|(name, path)| {
            Baseline::load(name, path).map_err(|e| Failure::new(Exit::Weights, format!("{e:#}")))
        })
        .collect();
    let baselines = baselines?;
    let options = lab_eval::EvalOptions {
        tables: args.tables,
        seed: args.seed,
        pictures: args.output.is_some(),
        replan_steps: args.replan,
        crop: if args.paper_crop { Crop::PAPER } else { Crop::default() },
    };
    let bar = Progress::new("tables", options.tables.len() as u64, common.quiet);
    let progress = |line: &str| bar.line(line);
    // Finished tables stay if the run is stopped.
    let made = |report: &EvalReport| {
        bar.step();
        args.output.as_ref().map_or(Ok(()), |folder| report.write(folder))
    };
    let report = lab_eval::run(judged, &baselines, &scenes, &options, &progress, &made).map_err(failed)?;
    drop(bar);
    let cost: String = report.cost.iter().map(|sheet| sheet.markdown()).collect();
    output::print(format!("{}{cost}", report.markdown()).as_bytes())
}

/// Measures the time of answers: the engine's with one thread and with two, or a server's.
///
/// # Errors
/// Exit 3 when nothing can be read, 7 without weights.
pub fn bench(args: BenchArgs, common: &Common) -> Result<(), Failure> {
    let scenes = scenes(&args.scenes)?;
    if args.http {
        return print_json(&http_bench::latency(&scenes, common)?);
    }
    if let (true, Some(scene)) = (args.steps, scenes.first()) {
        return print_json(&run_bench::step_times(scene, common)?);
    }
    if let (false, Some(scene)) = (args.crowd.is_empty(), scenes.first()) {
        return print_json(&crowd_bench::strain(scene, &args.crowd, args.seconds, common)?);
    }
    let mut rows = Vec::new();
    for threads in [1, 2] {
        let generator = common.generator()?.with_threads(threads);
        generator.warm_up();
        rows.extend(lab_eval::cost::latency(&generator, threads, &scenes).map_err(failed)?);
    }
    print_json(&rows)
}
