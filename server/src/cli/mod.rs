//! The command line. Results go to stdout, everything else to stderr.

/// Two example calls of a command, for the end of its help.
macro_rules! examples {
    ($first:literal, $second:literal) => {
        concat!(
            "Examples:\n  ",
            $first,
            "\n  ",
            $second,
            "\n\nGlobal options: -q, -v, --weights DIR, --log-format FORMAT, --log-level LEVEL; see dragtraffic --help",
            "\nExit codes: 0 done, 1 failure, 2 command line, 3 input, 4 some failed; all: dragtraffic --help"
        )
    };
}

mod backup;
mod batch;
mod common;
mod config;
mod convert;
mod doctor;
mod document;
mod exit;
mod export_all;
mod generate;
mod health;
mod index;
mod inputs;
mod interrupt;
#[cfg(feature = "lab")]
mod lab;
mod listen;
mod map;
mod matching;
mod mcp;
mod mine;
mod output;
mod parallel;
mod place;
mod plan;
mod pointers;
mod progress;
mod restore;
mod score;
mod serve;
mod shell;
mod tally;
mod values;

pub use common::Common;
pub use exit::{Exit, Failure};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;

/// Make traffic scenes by dragging: editor, HTTP API and command line in one program.
#[derive(Parser)]
#[command(name = "dragtraffic", version, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    serve: serve::ServeArgs,
    #[command(flatten)]
    common: Common,
}

/// Exit codes, for the end of the program's help.
const EXIT_CODES: &str = "\
Exit codes:
  0 done   1 failure   2 command line   3 input   4 some items failed   5 lossy under --strict
  6 address in use   7 weights   8 the output exists   130 Ctrl-C   143 asked to terminate

Each command has examples in its own help: dragtraffic generate --help";

#[derive(Subcommand)]
enum Command {
    /// Serve the editor and the HTTP API (the default command).
    #[command(after_help = examples!("dragtraffic serve --open", "dragtraffic serve --data recordings/ --port 9000"))]
    Serve(serve::ServeArgs),
    /// Generate futures of road users, towards goals or freely.
    #[command(after_help = examples!("dragtraffic generate scene.json --agents 6 --goal 6=ahead:40,left:3.5,time:4 --react -o out.json", "dragtraffic generate scenes/ --template brake,cut-in --seeds 20 --where 'actor.min_ttc_s < 1.5 && collisions == 0' -o found/"))]
    Generate(Box<generate::GenerateArgs>),
    /// Generate many scenes by a plan; several processes share the work, and an interrupted run resumes.
    #[command(after_help = examples!("dragtraffic batch plan.toml -o out/", "dragtraffic batch plan.toml -o out/ --shard 0/8"))]
    Batch(batch::BatchArgs),
    /// Reproduce results of a batch from their references: scenes with futures, byte for byte.
    #[command(after_help = examples!("dragtraffic replay out/ S63D1R -o scene.json", "dragtraffic replay out/ --kept -o cases/"))]
    Replay(batch::ReplayArgs),
    /// Write a table of the moving road users in recorded scenes, to select scenes.
    #[command(after_help = examples!("dragtraffic index logs/ -o index.parquet", "dragtraffic index 'logs/**/*.tfrecord*' -o index.parquet --force"))]
    Index(index::IndexArgs),
    /// Tag events in recorded scenes: near misses, cut-ins, hard braking, red-light violations and the like.
    #[command(after_help = examples!("dragtraffic mine logs/ -o events.parquet", "dragtraffic mine 'logs/**/*.tfrecord*' --json"))]
    Mine(mine::MineArgs),
    /// Find the places of maps where a pattern fits, and make a scene for each.
    #[command(name = "match", after_help = examples!("dragtraffic match CCFtap town.json -o turns/", "dragtraffic match all maps/ --json"))]
    Match(matching::MatchArgs),
    /// Create a map from a template: junctions, roundabouts, merges, roads, car parks.
    #[command(after_help = examples!("dragtraffic map --template four-arms --set arms.1.angle_deg=71 --set kerb_radius_m=6 -o crossing.json", "dragtraffic map --list"))]
    Map(map::MapArgs),
    /// Place road users on the map of a scene.
    #[command(after_help = examples!("dragtraffic place scene.json --count 30 --keep --seed 7 -o placed.json", "dragtraffic place scenes/ --density 12 --types vehicle=0.7,pedestrian=0.3 -o placed/"))]
    Place(place::PlaceArgs),
    /// Convert scenes between file formats.
    #[command(visible_aliases = ["import", "export"], after_help = examples!("dragtraffic convert record.tfrecord.gz --index 0 -o scene.json", "dragtraffic convert 'runs/*.json' --to csv -o motion.csv"))]
    Convert(convert::ConvertArgs),
    /// Score scenes: collisions, near misses, off-road driving, kinematics, goals.
    #[command(after_help = examples!("dragtraffic score out.json", "dragtraffic score found/ --sample all --where 'min_ttc_s < 1.5 && collisions == 0' --csv close.csv"))]
    Score(score::ScoreArgs),
    /// Offer the operations to a language model, as tools of the Model Context Protocol.
    #[command(after_help = examples!("dragtraffic mcp", "dragtraffic mcp --folder recordings/ --folder out/"))]
    Mcp(mcp::McpArgs),
    /// Copy the saved scenes of a server, even while it runs.
    #[command(after_help = examples!("dragtraffic backup -o scenes-monday.sqlite", "dragtraffic backup --db scenes.sqlite -o copies/scenes.sqlite --force"))]
    Backup(backup::BackupArgs),
    /// Replace the store by a copy that backup made.
    #[command(after_help = examples!("dragtraffic restore scenes-monday.sqlite --force", "dragtraffic restore copies/scenes.sqlite --db scenes.sqlite"))]
    Restore(restore::RestoreArgs),
    /// Write every saved scene of a store as a file.
    #[command(after_help = examples!("dragtraffic export-all -o scenes/", "dragtraffic export-all scenes.sqlite -o scenes/ --format openscenario"))]
    ExportAll(export_all::ExportAllArgs),
    /// Check whether a running server works: exit code 0 or 1.
    #[command(after_help = examples!("dragtraffic health", "dragtraffic health http://127.0.0.1:9090 --timeout 2"))]
    Health(health::HealthArgs),
    /// Check whether this machine has what the server needs.
    #[command(after_help = examples!("dragtraffic doctor", "dragtraffic doctor --config server.toml --json"))]
    Doctor(Box<doctor::DoctorArgs>),
    /// Print version, weights, limits and formats as JSON.
    #[command(after_help = examples!("dragtraffic info formats --markdown", "dragtraffic info weights --weights DIR"))]
    Info(document::InfoArgs),
    /// Print the OpenAPI document, or compare it with a file.
    #[command(after_help = examples!("dragtraffic openapi > assets/openapi.json", "dragtraffic openapi --check assets/openapi.json"))]
    Openapi(document::CheckArgs),
    /// Print the JSON Schema of the scene document, of the plan of a batch or of a pattern, or compare it with a file.
    #[command(after_help = examples!("dragtraffic schema > scene.schema.json", "dragtraffic schema batch --check assets/schema/batch.v1.schema.json"))]
    Schema(document::SchemaArgs),
    /// Print motion limits, ranges of conditions and defaults of requests, or compare them with a file.
    #[command(after_help = examples!("dragtraffic domain > domain.json", "dragtraffic domain --check assets/domain.json"))]
    Domain(document::CheckArgs),
    /// Print the completions of a shell.
    #[command(after_help = examples!("dragtraffic completions bash > ~/.local/share/bash-completion/completions/dragtraffic", "dragtraffic completions fish > ~/.config/fish/completions/dragtraffic.fish"))]
    Completions(shell::CompletionsArgs),
    /// Print the manual page, or write one per command.
    #[command(after_help = examples!("dragtraffic man | man -l -", "dragtraffic man -o ~/.local/share/man/man1/"))]
    Man(shell::ManArgs),
    /// Train and evaluate the networks.
    #[cfg(feature = "lab")]
    #[command(subcommand, after_help = examples!("dragtraffic lab eval recordings/ --tables 1,2 -o tables/", "dragtraffic lab bench recordings/"))]
    Lab(lab::LabCommand),
}

/// Parses a command line, whose first word is the program's name, and runs the command. Returns the exit
/// code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let cli = match parsed(&arguments) {
        Ok(cli) => cli,
        Err(error) => {
            let code = if error.use_stderr() { Exit::Usage as u8 } else { 0 };
            if let Some(message) = elsewhere(&error).or_else(|| renamed(&error)) {
                output::complain(&message);
                return code;
            }
            // Help into a closed pipe is not a failure.
            let _ = error.print();
            return code;
        }
    };
    let common = cli.common;
    common.log();
    let command = cli.command.unwrap_or(Command::Serve(cli.serve));
    if !command.ends_by_itself() {
        interrupt::watch();
    }
    match command.run(&common) {
        Ok(()) => 0,
        Err(failure) => {
            if !failure.message.is_empty() {
                output::complain(&failure.message);
            }
            failure.exit as u8
        }
    }
}

fn parsed(arguments: &[OsString]) -> Result<Cli, clap::Error> {
    let command = without_global_options(Cli::command());
    let mut matches = command.clone().try_get_matches_from(arguments)?;
    let refused = |message| Cli::command().error(ErrorKind::InvalidValue, message);
    if let Some(command) = config::with_file(command, &matches).map_err(refused)? {
        matches = command.try_get_matches_from(arguments)?;
    }
    if let Some((name, _)) = matches.subcommand() {
        stray(&matches, name)?;
    }
    Cli::from_arg_matches(&matches)
}

/// Hides the global options in the help of each command; one line there refers to them.
fn without_global_options(mut whole: clap::Command) -> clap::Command {
    fn hidden(command: clap::Command) -> clap::Command {
        let each = |arg: clap::Arg| if arg.is_global_set() { arg.hide(true) } else { arg };
        command.mut_args(each).mut_subcommands(hidden)
    }
    whole.build();
    whole.mut_subcommands(hidden)
}

/// Refuses server flags before another command, for which they have no effect.
fn stray(matches: &ArgMatches, command: &str) -> Result<(), clap::Error> {
    let server = serve::ServeArgs::augment_args(clap::Command::new("serve"));
    for flag in server.get_arguments() {
        if matches.value_source(flag.get_id().as_str()) == Some(ValueSource::CommandLine) {
            let name = flag.get_long().unwrap_or_default();
            let message = if config::COMMANDS.contains(&command) {
                format!("--{name} belongs behind the command: dragtraffic {command} --{name}")
            } else {
                format!("--{name} is a flag of serve and means nothing to {command}")
            };
            return Err(Cli::command().error(ErrorKind::ArgumentConflict, message));
        }
    }
    Ok(())
}

/// Flags of earlier versions, with their replacements.
const RENAMED: [(&str, &str); 5] = [
    ("--forget", "--kept-futures forgotten"),
    ("--replan", "--replan-interval"),
    ("--at", "--start-time"),
    ("--format", "--to"),
    ("--samples", "--sample"),
];

/// The hint for a flag of an earlier version.
fn renamed(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(flag)) = error.get(ContextKind::InvalidArg) else { return None };
    let (old, new) = RENAMED.iter().find(|(old, _)| old == flag)?;
    (error.kind() == ErrorKind::UnknownArgument).then(|| format!("{old} is {new} now"))
}

/// The hint for a lab command outside `lab`, or for one that this program lacks.
fn elsewhere(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    if name == "drive" {
        return Some("drive runs planners in Python and comes with the Python package: pip install .".into());
    }
    match (name == "lab" || LAB_COMMANDS.contains(&name.as_str()), cfg!(feature = "lab")) {
        (true, true) => Some(format!("{name} is a command of the lab: dragtraffic lab {name}")),
        (true, false) => {
            Some("this program lacks the lab: build one with cargo build --release --features lab".into())
        }
        (false, _) => None,
    }
}

/// Names of the commands of the lab.
const LAB_COMMANDS: &[&str] = &[
    "synthesize",
    "statistics",
    "prepare",
    "train",
    "train-placement",
    "eval-placement",
    "eval-filled",
    "eval",
    "reproduce",
    "bench",
];

impl Command {
    /// Whether the command handles Ctrl-C itself: the server shuts down in order, and training writes a
    /// checkpoint.
    fn ends_by_itself(&self) -> bool {
        match self {
            Self::Serve(_) => true,
            #[cfg(feature = "lab")]
            Self::Lab(command) => command.ends_by_itself(),
            _ => false,
        }
    }

    fn run(self, common: &Common) -> Result<(), Failure> {
        match self {
            Self::Serve(args) => serve::run(args, common),
            Self::Backup(args) => backup::run(args, common),
            Self::Restore(args) => restore::run(args, common),
            Self::ExportAll(args) => export_all::run(args, common),
            Self::Health(args) => health::run(args, common),
            Self::Doctor(args) => doctor::run(*args, common),
            Self::Generate(args) => generate::run(*args, common),
            Self::Batch(args) => batch::run(args, common),
            Self::Replay(args) => batch::replay(&args, common),
            Self::Index(args) => index::index(&args, common),
            Self::Mine(args) => mine::run(&args, common),
            Self::Match(args) => matching::run(&args, common),
            Self::Map(args) => map::run(args, common),
            Self::Place(args) => place::run(args, common),
            Self::Convert(args) => convert::convert(args, common),
            Self::Score(args) => score::score(args, common),
            Self::Mcp(args) => mcp::run(args, common),
            Self::Openapi(args) => document::openapi(args),
            Self::Schema(args) => document::schema(args),
            Self::Domain(args) => document::domain(args),
            Self::Info(args) => document::info(args, common),
            Self::Completions(args) => shell::completions(args),
            Self::Man(args) => shell::man(args),
            #[cfg(feature = "lab")]
            Self::Lab(command) => command.run(common),
        }
    }
}

#[cfg(all(test, feature = "lab"))]
mod tests {
    use super::{LAB_COMMANDS, lab};
    use clap::Subcommand;

    #[test]
    fn a_program_without_the_lab_knows_the_names_of_its_commands() {
        let commands = lab::LabCommand::augment_subcommands(clap::Command::new("dragtraffic"));
        let names: Vec<&str> = commands.get_subcommands().map(clap::Command::get_name).collect();
        assert_eq!(names, LAB_COMMANDS);
    }
}
