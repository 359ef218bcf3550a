//! `dragtraffic generate`: the operation of `POST /v1/generate`, from files to files; many scenes, seeds and
//! templates in one call.

mod ask;
mod asked;
mod made;
mod manifest;
mod many;
pub mod tell;

pub use made::created_at;

use super::inputs::{Inputs, Reading, no_ids, notes};
use super::output::{self, Folder};
use super::values::{For, for_one, index, one_of, seeds, whole, within};
use super::{Common, Exit, Failure};
use api::GenerateRequest;
use api::generate::request::KeptFutures;
use api::limits;
use asked::AskedGoal;
use batch::figures::FigureFilter;
use batch::who::AgentSelector;
use clap::Args;
use formats::native::{MAX_SAFE_INTEGER, StartDoc, ViaDoc};
use scene::AgentType;
use scene::scenarios::Template;
use std::ops::Range;
use std::path::PathBuf;

/// Heading of the flags about single road users.
const ROAD_USERS: &str = "Road users";
/// Heading of the flags about drawing.
const DRAWING: &str = "Drawing and planning";

/// Flags of `generate`.
#[derive(Args, Clone, Debug)]
pub struct GenerateArgs {
    #[command(flatten)]
    inputs: Inputs,
    /// Scenes to take from each file, counted from 0: a number, or FIRST..LAST (both included). Default: the
    /// first for one output file, all for a folder.
    #[arg(long, value_name = "WHICH", value_parser = index)]
    index: Option<Range<usize>>,
    /// File for the scene with its futures; - is standard output. A folder (DIR/) takes one file per scene,
    /// template and seed, and manifest.csv with their figures.
    #[arg(short, long, value_name = "FILE|DIR/")]
    output: Option<PathBuf>,
    /// Print the scene as JSON, also on a terminal.
    #[arg(long, conflicts_with = "output")]
    json: bool,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
    /// Exit with 4 if a template fits no road user of a scene, or if --where keeps no sample of a template.
    #[arg(long)]
    strict: bool,
    /// Test situations to create, separated by commas. The actor is picked from the scene and reported; all
    /// others react unless --react names some.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "NAME", conflicts_with_all = ["agents", "goal", "goal_from_log"])]
    template: Vec<Template>,
    /// Keep only samples that satisfy this condition, such as 'actor.min_ttc_s < 1.5 && collisions == 0'.
    /// Syntax: dragtraffic score --help.
    #[arg(long = "where", value_name = "CONDITION", value_parser = FigureFilter::parse)]
    filter: Option<FigureFilter>,

    /// Road users to generate, separated by commas: ids, @all, @moving, @vehicles, @pedestrians, @cyclists,
    /// @ego. Default: those with a goal or via points; without any of these, all.
    #[arg(long, value_delimiter = ',', value_name = "WHO", help_heading = ROAD_USERS)]
    agents: Vec<AgentSelector>,
    /// Let the other road users react: all of them, or only those named (--react=7,8).
    #[arg(long, value_delimiter = ',', num_args = 0..=1, require_equals = true, default_missing_value = "@all", value_name = "WHO", help_heading = ROAD_USERS)]
    react: Vec<AgentSelector>,
    /// Goal of a road user: X,Y[,SPEED[,HEADING[,TIME]]]; an empty field stays free. Or keys, as in
    /// 6=ahead:40,left:3.5,speed:0,time:4: x, y, heading in the frame of the scene, or ahead, left, turn from
    /// the start pose. Or relative to another road user, as in 6=of:1,ahead:12,slower:4,lanes_left:1,time:5: one
    /// of ahead, behind (gap in m), behind_s (gap in s) and after (s after it passes x, y). Units: m, m/s, rad, s.
    #[arg(long, value_name = "ID=GOAL", value_parser = for_one(asked::goal), help_heading = ROAD_USERS)]
    goal: Vec<For<AskedGoal>>,
    /// Take the goals of these road users from the recording: position, heading, speed and time of the last
    /// state within the horizon. --goal takes precedence.
    #[arg(long, value_delimiter = ',', value_name = "WHO", help_heading = ROAD_USERS)]
    goal_from_log: Vec<AgentSelector>,
    /// Via point of a road user: X,Y[,TIME[,TOLERANCE]], or keys, as in 6=x:10,y:4,tolerance:2. Units: m, s.
    /// At most four per road user, in the order of passing.
    #[arg(long, value_name = "ID=VIA", value_parser = for_one(asked::via), help_heading = ROAD_USERS)]
    via: Vec<For<ViaDoc>>,
    /// Start of a road user: X,Y[,SPEED[,HEADING]], or keys, as in 6=x:10,y:4,speed:8. Units: m, m/s, rad.
    #[arg(long, value_name = "ID=START", value_parser = for_one(asked::start), help_heading = ROAD_USERS)]
    start: Vec<For<StartDoc>>,
    /// Length and width of a road user, m.
    #[arg(long, value_name = "ID=LENGTHxWIDTH", value_parser = for_one(asked::size), help_heading = ROAD_USERS)]
    size: Vec<For<(f64, f64)>>,
    /// Type of a road user: vehicle, pedestrian or cyclist.
    #[arg(long = "type", value_name = "ID=TYPE", value_parser = for_one(agent_type), help_heading = ROAD_USERS)]
    agent_type: Vec<For<AgentType>>,
    /// All conditions of a road user from a JSON file, in the form of the HTTP API.
    #[arg(long, value_name = "ID=FILE.json", value_parser = for_one(file), help_heading = ROAD_USERS)]
    condition: Vec<For<PathBuf>>,
    /// Futures of earlier calls, of road users that are not generated: answered keeps them in the answer, omitted plans
    /// around them without answering them, forgotten drops them before planning.
    #[arg(long, value_name = "WHAT", default_value = "answered", value_parser = kept_futures, help_heading = ROAD_USERS)]
    kept_futures: KeptFutures,

    /// Seed of the random draws; equal seeds give equal answers.
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = GenerateRequest::default().seed, value_parser = whole(0, MAX_SAFE_INTEGER), help_heading = DRAWING)]
    seed: u64,
    /// One result per seed: a count, or FIRST..LAST (both included).
    #[arg(long, value_name = "COUNT|FIRST..LAST", conflicts_with = "seed", value_parser = seeds, help_heading = DRAWING)]
    seeds: Option<Range<u64>>,
    /// Joint samples per seed, 1 to 32.
    #[arg(long, value_name = "N", default_value_t = GenerateRequest::default().samples, value_parser = clap::value_parser!(u64).range(1..=limits::SAMPLES), help_heading = DRAWING)]
    samples: u64,
    /// Futures kept per road user, 1 to 6.
    #[arg(long, value_name = "N", default_value_t = GenerateRequest::default().modes, value_parser = clap::value_parser!(u64).range(1..=limits::MODES), help_heading = DRAWING)]
    modes: u64,
    /// Refinement steps, 0 to 100.
    #[arg(long, value_name = "N", default_value_t = GenerateRequest::default().steps, value_parser = clap::value_parser!(u64).range(0..=limits::STEPS), help_heading = DRAWING)]
    steps: u64,
    /// Time to generate, 0.5 to 20 s. Beyond 9 s, road users replan from the states they have reached.
    #[arg(long, value_name = "SECONDS", default_value_t = GenerateRequest::default().horizon_s, value_parser = within(limits::LEAST_HORIZON_S, limits::MOST_HORIZON_S, "seconds"), help_heading = DRAWING)]
    horizon: f64,
    /// Scene time of the start, s.
    #[arg(long, value_name = "SECONDS", default_value_t = GenerateRequest::default().start_s, value_parser = within(0.0, 59.9, "seconds"), help_heading = DRAWING)]
    start_time: f64,
    /// Time between two plans: 3, 6 or 9 s. Default: 9.
    #[arg(long, value_name = "SECONDS", value_parser = one_of(&limits::REPLAN_S), help_heading = DRAWING)]
    replan_interval: Option<f64>,
    /// Scale of the noise, 0 to 2. With 0, all seeds give the most probable answer.
    #[arg(long, value_name = "SCALE", default_value_t = GenerateRequest::default().diversity, value_parser = within(0.0, limits::DIVERSITY, ""), help_heading = DRAWING)]
    diversity: f64,
}

fn kept_futures(text: &str) -> Result<KeptFutures, String> {
    serde_json::from_value(text.into()).map_err(|_| "answered, omitted or forgotten expected".to_owned())
}

fn agent_type(text: &str) -> Result<AgentType, String> {
    let found = <AgentType as clap::ValueEnum>::from_str(text, true);
    found.map_err(|_| "vehicle, pedestrian or cyclist expected".to_owned())
}

#[allow(clippy::unnecessary_wraps, reason = "one of the readers of values")]
fn file(text: &str) -> Result<PathBuf, String> {
    Ok(text.into())
}

/// Generates and writes scenes with their futures.
///
/// # Errors
/// Exit 2, 3, 4, 7, 8.
pub fn run(args: GenerateArgs, common: &Common) -> Result<(), Failure> {
    args.check()?;
    let sources = args.inputs.sources()?;
    if !args.react.is_empty() {
        no_ids(&sources, "--react")?;
    }
    let folder = args.output.as_deref().filter(|path| Folder::named(path));
    let many = folder.is_some() || sources.len() > 1 || args.seeds.is_some() || args.template.len() > 1;
    if many {
        let path = args.output.as_deref().ok_or_else(|| {
            Failure::usage(
                "several results: give a folder, --output DIR/, for one file per result and manifest.csv",
            )
        })?;
        return many::run(&args, &sources, path, common);
    }
    let [source] = sources.as_slice() else { return Ok(()) };
    one(&args, source, common)
}

/// One scene to one file, with a line for each road user.
fn one(args: &GenerateArgs, source: &super::inputs::Source, common: &Common) -> Result<(), Failure> {
    if let Some(path) = args.output.as_deref().filter(|path| *path != std::path::Path::new("-")) {
        output::keep(path, args.force)?;
    }
    let item = source.first(&Reading { index: args.index.clone(), ..Reading::default() })?;
    common.listed(notes(source, &item.notes), "notes").iter().for_each(|line| common.say(line));
    let operations = common.operations()?;
    let maker = made::Maker { args, operations: &operations, scored: args.filter.is_some() };
    let template = args.template.first().copied();
    let made = match maker.make(source, item.scene, template, args.seed)? {
        made::MakeOutcome::Made(made) => *made,
        made::MakeOutcome::NobodyFits(template) => {
            let message = format!("{}: {}: no road user fits", source.shown(), template.name());
            return Err(Failure::new(Exit::Partly, message));
        }
    };
    tell::lines(&made, args, common).iter().for_each(|line| common.say(line));
    if made.samples.is_empty() {
        let condition = args.filter.as_ref().map_or("", FigureFilter::text);
        let message = format!("nothing written: no sample of {} holds {condition}", made.all_samples);
        return Err(Failure::new(Exit::Partly, message));
    }
    output::write_scene(args.output.as_deref(), &made.bytes(), args.force, args.json)
}

impl GenerateArgs {
    /// Refuses a flag that names one road user twice, which clap cannot detect.
    fn check(&self) -> Result<(), Failure> {
        twice("--goal", &self.goal)?;
        twice("--start", &self.start)?;
        twice("--size", &self.size)?;
        twice("--type", &self.agent_type)?;
        twice("--condition", &self.condition)
    }

    /// Scene step of the start.
    fn start_step(&self) -> usize {
        (self.start_time / scene::STEP_S).round() as usize
    }
}

fn twice<T>(flag: &str, values: &[For<T>]) -> Result<(), Failure> {
    let again = |i: &usize| values[..*i].iter().any(|before| before.id == values[*i].id);
    match (0..values.len()).find(again) {
        Some(i) => Err(Failure::usage(format!("{flag} is given twice for {}", values[i].id))),
        None => Ok(()),
    }
}
