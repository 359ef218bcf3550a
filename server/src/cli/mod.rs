//! The command line. Results go to stdout, everything else to stderr.

mod document;
mod files;
mod generate;
mod interrupt;
mod lab;
mod output;
mod place;
mod serve;

use crate::base::clock;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

/// How a command ends; the numbers are part of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Anything that has no number of its own.
    Failure = 1,
    /// The command line makes no sense.
    Usage = 2,
    /// Input cannot be read or is not valid.
    Input = 3,
    /// Some items failed, the rest are done.
    Partly = 4,
    /// Something was lost under `--strict`.
    Lossy = 5,
    /// The address is taken.
    AddressInUse = 6,
    /// Weights are missing or wrong.
    Weights = 7,
    /// The output exists.
    OutputExists = 8,
    /// Ctrl-C; what was done by then is kept where the command says so.
    Interrupted = 130,
}

/// Why a command failed.
#[derive(Debug)]
pub struct Failure {
    /// Exit code.
    pub exit: Exit,
    /// One sentence; empty when it was told already.
    pub message: String,
}

impl Failure {
    /// A failure with one sentence.
    pub fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: message.into() }
    }
}

impl From<std::io::Error> for Failure {
    fn from(error: std::io::Error) -> Self {
        Self::new(Exit::Failure, error.to_string())
    }
}

/// Make traffic scenes by dragging: editor, HTTP API and command line in one program.
#[derive(Parser)]
#[command(name = "dragtraffic", version, args_conflicts_with_subcommands = true, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    serve: serve::ServeArgs,
    #[command(flatten)]
    common: Common,
}

/// Flags of every command.
#[derive(Args, Clone, Debug)]
pub struct Common {
    /// Log lines as text or JSON.
    #[arg(long, global = true, value_enum, env = "DRAGTRAFFIC_LOG_FORMAT")]
    pub log_format: Option<LogFormat>,
    /// Which log lines: error, warn, info, debug, trace, or a tracing filter.
    #[arg(long, global = true, env = "DRAGTRAFFIC_LOG", default_value = "info")]
    pub log_level: String,
    /// Say nothing but errors.
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Folder with vehicle.safetensors, pedestrian.safetensors, cyclist.safetensors and, if it has
    /// them, placement.json, in place of the weights inside the program.
    #[arg(long, global = true, env = "DRAGTRAFFIC_WEIGHTS", value_name = "DIR")]
    pub weights: Option<PathBuf>,
}

/// Form of log lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LogFormat {
    /// For people.
    Text,
    /// One object a line.
    Json,
}

/// Two calls of a command, for the end of its help.
macro_rules! examples {
    ($first:literal, $second:literal) => {
        concat!("Examples:\n  ", $first, "\n  ", $second)
    };
}

/// How commands end, for the end of the program's help.
const EXIT_CODES: &str = "\
Exit codes:
  0 done   1 failure   2 command line   3 input   4 some items failed   5 lossy under --strict
  6 address in use   7 weights   8 the output exists   130 Ctrl-C   143 asked to terminate

Each command has examples in its own help: dragtraffic generate --help";

#[derive(Subcommand)]
enum Command {
    /// Serve the editor and the HTTP API (the default).
    #[command(after_help = examples!("dragtraffic serve --open", "dragtraffic serve --data recordings/ --port 9000"))]
    Serve(serve::ServeArgs),
    /// Generate futures of a scene.
    #[command(after_help = examples!("dragtraffic generate scene.json --agents 6 --goal 6=-40,8 --react -o out.json", "dragtraffic generate scene.json --samples 8 --seed 7 --horizon 20 --replan 6 -o long.json"))]
    Generate(generate::GenerateArgs),
    /// Place road users on a scene's map.
    #[command(after_help = examples!("dragtraffic place scene.json --count 30 --keep --seed 7 -o placed.json", "dragtraffic place scene.json --density 12 --types vehicle=0.7,pedestrian=0.3 -o placed.json"))]
    Place(place::PlaceArgs),
    /// Turn a file of any known format into scene JSON.
    #[command(after_help = examples!("dragtraffic import record.tfrecord.gz --index 0 -o scene.json", "dragtraffic import fcd.xml --net net.xml --index 0..9 -o scenes/"))]
    Import(files::ConvertArgs),
    /// Turn a file of one format into another.
    #[command(after_help = examples!("dragtraffic convert record.tfrecord.gz --to dragtraffic --index 0 -o scene.json", "dragtraffic convert --list"))]
    Convert(files::ConvertArgs),
    /// Write a scene in another format.
    #[command(after_help = examples!("dragtraffic export out.json --format womd -o out.tfrecord", "dragtraffic export out.json --format womd --mode log --strict -o log.tfrecord"))]
    Export(files::ExportArgs),
    /// Score scenes: collisions, near misses, off-road driving, kinematics, goals.
    #[command(after_help = examples!("dragtraffic score out.json", "dragtraffic score scenes/*.json --json --pairs regenerated --ttc 2"))]
    Score(files::ScoreArgs),
    /// Print the OpenAPI document, or compare it with a file.
    #[command(after_help = examples!("dragtraffic openapi > assets/openapi.json", "dragtraffic openapi --check assets/openapi.json"))]
    Openapi(document::CheckArgs),
    /// Print the JSON Schema of the scene document, or compare it with a file.
    #[command(after_help = examples!("dragtraffic schema > scene.schema.json", "dragtraffic schema --check assets/schema/scene.v1.schema.json"))]
    Schema(document::CheckArgs),
    /// Print motion limits, ranges of conditions and defaults of requests, or compare them with a file.
    #[command(after_help = examples!("dragtraffic domain > domain.json", "dragtraffic domain --check assets/domain.json"))]
    Domain(document::CheckArgs),
    /// Print version, weights, limits and formats as JSON.
    #[command(after_help = examples!("dragtraffic info", "dragtraffic info --weights DIR"))]
    Info,
    /// Make training windows from procedural networks, driven through SUMO.
    #[command(after_help = examples!("dragtraffic synthesize --seed 0 --count 8 --per-seed 20 -o windows/", "dragtraffic synthesize --seed 900 --count 8 --sumo-home /opt/sumo -o held-out/"))]
    Synthesize(lab::SynthesizeArgs),
    /// Lay the statistics of sets of scenes side by side.
    #[command(after_help = examples!("dragtraffic statistics synthetic=windows/ recorded=recordings/", "dragtraffic statistics recorded=recordings/ --json --most 50"))]
    Statistics(lab::StatisticsArgs),
    /// Make training shards from logs.
    #[command(after_help = examples!("dragtraffic prepare windows/ --expert vehicle -o vehicle.records", "dragtraffic prepare recordings/ --expert cyclist --crop 120 --least-agents 32 --mirror -o cyclist.records"))]
    Prepare(lab::PrepareArgs),
    /// Train an expert.
    #[command(after_help = examples!("dragtraffic train vehicle.records --expert vehicle --stage initializer --steps 20000 -o v1.safetensors", "dragtraffic train vehicle.records --expert vehicle --stage joint --steps 1200 --init v1.safetensors -o vehicle.safetensors"))]
    Train(lab::TrainArgs),
    /// Learn the placement weights from scenes.
    #[command(after_help = examples!("dragtraffic train-placement windows/ -o placement.json", "dragtraffic train-placement windows/ --trained-on \"Synthetic traffic, seeds 0 to 99\" -o placement.json"))]
    TrainPlacement(lab::TrainPlacementArgs),
    /// Judge the placement on recorded scenes.
    #[command(after_help = examples!("dragtraffic eval-place recordings/", "dragtraffic eval-place recordings/ --radius 80 --seeds 8 --json"))]
    EvalPlace(lab::EvalPlaceArgs),
    /// Judge the experts on scenes: tables of quality, coherence, control, realism, variety and cost, pictures.
    #[command(after_help = examples!("dragtraffic eval recordings/ --tables 1,2 -o tables/", "dragtraffic eval recordings/ --tables 1,2,4 --baseline TrafficGen=trafficgen.safetensors -o tables/"))]
    Eval(lab::EvalArgs),
    /// Reproduce the paper on recordings: its sets, its methods trained as it says, its two tables with its own figures
    /// beside.
    #[command(after_help = examples!("dragtraffic reproduce recordings/ --quick -o paper/", "dragtraffic reproduce training_20s/ --test validation/ --condition-width 1024 -o paper/"))]
    Reproduce(lab::ReproduceArgs),
    /// Time answers: one drag, and whole scenes.
    #[command(after_help = examples!("dragtraffic bench recordings/", "dragtraffic bench recordings/ --scenes 20 --weights DIR"))]
    Bench(lab::BenchArgs),
}

/// Parses the command line and does what it says.
pub fn run() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let code = if error.use_stderr() { Exit::Usage as u8 } else { 0 };
            // Help into a closed pipe is no failure.
            let _ = error.print();
            return ExitCode::from(code);
        }
    };
    let common = cli.common;
    log(&common);
    // The server ends by itself, and training with a checkpoint, alone or on the way to the paper's tables.
    if !matches!(cli.command, None | Some(Command::Serve(_) | Command::Train(_) | Command::Reproduce(_))) {
        interrupt::watch();
    }
    let done = match cli.command {
        None => serve::run(cli.serve, &common),
        Some(Command::Serve(args)) => serve::run(args, &common),
        Some(Command::Generate(args)) => generate::run(args, &common),
        Some(Command::Place(args)) => place::run(args, &common),
        Some(Command::Import(args)) => files::convert(args, true),
        Some(Command::Convert(args)) => files::convert(args, false),
        Some(Command::Export(args)) => files::export(args),
        Some(Command::Score(args)) => files::score(args),
        Some(Command::Openapi(args)) => document::openapi(args),
        Some(Command::Schema(args)) => document::schema(args),
        Some(Command::Domain(args)) => document::domain(args),
        Some(Command::Info) => document::info(&common),
        Some(Command::Synthesize(args)) => lab::synthesize(args, &common),
        Some(Command::Statistics(args)) => lab::statistics(args),
        Some(Command::Prepare(args)) => lab::prepare(args, &common),
        Some(Command::Train(args)) => lab::train(args, &common),
        Some(Command::TrainPlacement(args)) => lab::train_placement(args, &common),
        Some(Command::EvalPlace(args)) => lab::eval_place(args, &common),
        Some(Command::Eval(args)) => lab::eval(args, &common),
        Some(Command::Reproduce(args)) => lab::reproduce(args, &common),
        Some(Command::Bench(args)) => lab::bench(args, &common),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if !failure.message.is_empty() {
                output::complain(&failure.message);
            }
            ExitCode::from(failure.exit as u8)
        }
    }
}

fn log(common: &Common) {
    let level = if common.quiet { "error" } else { common.log_level.as_str() };
    let filter = tracing_subscriber::EnvFilter::try_new(level)
        .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new("info"));
    let terminal = std::io::stderr().is_terminal();
    let builder = tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr);
    let json = match common.log_format {
        Some(format) => format == LogFormat::Json,
        None => false,
    };
    let done = if json {
        builder.json().try_init()
    } else {
        let colour = terminal && std::env::var_os("NO_COLOR").is_none();
        builder.with_ansi(colour).with_target(false).try_init()
    };
    // A second subscriber is refused; the first one logs.
    let _ = done;
}

/// Generator and placer, from a folder or from inside the program.
///
/// # Errors
/// Exit 7.
pub fn engine(common: &Common) -> Result<experts::Engine, Failure> {
    let loaded = match &common.weights {
        Some(folder) => experts::Engine::from_dir(folder),
        None => experts::Engine::built_in(),
    };
    let engine = loaded.map_err(|error| Failure::new(Exit::Weights, format!("{error:#}")))?;
    Ok(experts::Engine { generator: engine.generator.with_clock(clock::monotonic), ..engine })
}

/// The generator alone.
///
/// # Errors
/// Exit 7.
pub fn generator(common: &Common) -> Result<experts::Generator, Failure> {
    Ok(engine(common)?.generator)
}
