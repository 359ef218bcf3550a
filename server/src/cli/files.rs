//! `dragtraffic import`, `convert`, `export` and `score`: files in, files out.

use super::{Exit, Failure, output};
use crate::base::problem::Problem;
use crate::routes::import::range;
use crate::scenes::transfer::{self, Imported, Motion};
use clap::Args;
use scene::Scene;
use scene::score::{Drivable, PairChoice, ScoreInput, Thresholds};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Flags of `import` and `convert`.
#[derive(Args, Clone, Debug)]
pub struct ConvertArgs {
    /// File to read; - is stdin.
    #[arg(required_unless_present = "list")]
    input: Option<PathBuf>,
    /// File to write; a folder for many scenes; - or absent is stdout.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Format of the input; recognised from its content when absent.
    #[arg(long)]
    from: Option<String>,
    /// Network that a SUMO recording belongs to.
    #[arg(long)]
    net: Option<PathBuf>,
    /// Format of the output.
    #[arg(long, default_value = "dragtraffic")]
    to: String,
    /// Scenes to take: one number, or FIRST..LAST.
    #[arg(long)]
    index: Option<String>,
    /// Which motion the output takes.
    #[arg(long, value_enum, default_value_t)]
    mode: Motion,
    /// Exit 5 when the output cannot hold something.
    #[arg(long)]
    strict: bool,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
    /// List the formats and exit.
    #[arg(long)]
    list: bool,
}

/// Flags of `export`.
#[derive(Args, Clone, Debug)]
pub struct ExportArgs {
    /// Scene to read; - is stdin.
    scene: PathBuf,
    /// Format of the output.
    #[arg(long)]
    format: String,
    /// File to write; - or absent is stdout.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Which sample of the generated futures.
    #[arg(long)]
    sample: Option<usize>,
    /// Which motion the output takes.
    #[arg(long, value_enum, default_value_t)]
    mode: Motion,
    /// Exit 5 when the output cannot hold something.
    #[arg(long)]
    strict: bool,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// Flags of `score`.
#[derive(Args, Clone, Debug)]
pub struct ScoreArgs {
    /// Scenes to read, of any format.
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// One JSON object a line in place of text.
    #[arg(long)]
    json: bool,
    /// Which pairs are looked at: all of them, or those with a generated road user.
    #[arg(long, value_enum, default_value_t)]
    pairs: PairChoice,
    /// Boxes collide when their intersection over union is above this; 0 takes any overlap.
    #[arg(long, value_name = "SHARE", default_value_t = Thresholds::default().iou, value_parser = share)]
    iou: f64,
    /// Near miss: time to collision below this, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = Thresholds::default().ttc_s, value_parser = positive)]
    ttc: f64,
    /// Near miss: gap below this, metres.
    #[arg(long, value_name = "METRES", default_value_t = Thresholds::default().gap_m, value_parser = positive)]
    gap: f64,
}

fn share(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v| (0.0..=1.0).contains(v)).ok_or_else(|| "0 to 1 expected".to_owned())
}

fn positive(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|v| (0.0..=60.0).contains(v)).ok_or_else(|| "0 to 60 expected".to_owned())
}

/// Problems of files as failures of the command.
pub fn refused(path: &Path, problem: &Problem) -> Failure {
    let mut message = format!("{}: {}", path.display(), problem.detail);
    for error in problem.members.errors.iter().flatten().skip(1) {
        message.push_str(&format!("\n  {error}"));
    }
    Failure::new(Exit::Input, message)
}

/// Reads scenes of any format.
///
/// # Errors
/// Exit 3.
pub fn read_scenes(path: &Path, from: Option<&str>, index: Option<&str>) -> Result<Vec<Imported>, Failure> {
    read_with_net(path, from, index, None)
}

fn read_with_net(
    path: &Path,
    from: Option<&str>,
    index: Option<&str>,
    net: Option<&Path>,
) -> Result<Vec<Imported>, Failure> {
    let bytes = output::read(path)?;
    let net = net.map(output::read).transpose()?;
    let wanted = index.map(range).transpose().map_err(|p| Failure::new(Exit::Usage, p.detail))?;
    let (skip, most) = wanted.map_or((0, usize::MAX), |range| (range.start, range.len()));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let read = transfer::read(&bytes, from, &name, skip, most, net);
    let read = read.map_err(|problem| refused(path, &problem))?;
    for (index, problem) in &read.skipped {
        output::complain(&format!("{}: scene {index} left out: {}", path.display(), problem.detail));
    }
    for imported in &read.scenes {
        for warning in &imported.warnings {
            output::complain(&format!("{}: {}: {}", path.display(), warning.code, warning.detail));
        }
    }
    if read.scenes.is_empty() {
        return Err(Failure::new(Exit::Input, format!("{}: no scene at that index", path.display())));
    }
    Ok(read.scenes)
}

/// Reads exactly one scene, the first of the file.
///
/// # Errors
/// Exit 3.
pub fn read_scene(path: &Path) -> Result<Scene, Failure> {
    let mut scenes = read_scenes(path, None, Some("0"))?;
    Ok(scenes.swap_remove(0).scene)
}

/// Turns a file of one format into another.
///
/// # Errors
/// Exit 3, 5, 8.
pub fn convert(args: ConvertArgs, to_native: bool) -> Result<(), Failure> {
    let Some(input) = args.input.filter(|_| !args.list) else {
        let text = serde_json::to_string_pretty(&transfer::table()).unwrap_or_default();
        return output::print(format!("{text}\n").as_bytes());
    };
    let to = if to_native { "dragtraffic".to_owned() } else { args.to };
    let scenes = read_with_net(&input, args.from.as_deref(), args.index.as_deref(), args.net.as_deref())?;
    let folder = args.output.as_deref().filter(|path| path.is_dir());
    if scenes.len() > 1 && folder.is_none() {
        let message = format!("{} scenes; give --index, or a folder as --output", scenes.len());
        return Err(Failure::new(Exit::Usage, message));
    }
    for (i, imported) in scenes.iter().enumerate() {
        let target = match folder {
            Some(folder) => Some(folder.join(file_name(&imported.scene, i, &to))),
            None => args.output.clone(),
        };
        write(&imported.scene, &to, None, args.mode, target.as_deref(), args.strict, args.force)?;
    }
    Ok(())
}

fn file_name(scene: &Scene, index: usize, to: &str) -> String {
    let info = formats::registry::by_id(to).map(|format| format.info());
    let extension = info.and_then(|info| info.extensions.first().copied()).unwrap_or("json");
    let clean = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let stem: String =
        scene.meta.source_id.as_deref().unwrap_or(&scene.name).chars().map(clean).take(60).collect();
    if stem.is_empty() { format!("scene-{index:06}.{extension}") } else { format!("{stem}.{extension}") }
}

/// Writes a scene in another format.
///
/// # Errors
/// Exit 3, 5, 8.
pub fn export(args: ExportArgs) -> Result<(), Failure> {
    let scene = read_scene(&args.scene)?;
    write(&scene, &args.format, args.sample, args.mode, args.output.as_deref(), args.strict, args.force)
}

fn write(
    scene: &Scene,
    format: &str,
    sample: Option<usize>,
    motion: Motion,
    target: Option<&Path>,
    strict: bool,
    force: bool,
) -> Result<(), Failure> {
    let written = transfer::write(scene, format, sample, motion)
        .map_err(|problem| Failure::new(Exit::Usage, problem.detail))?;
    for loss in &written.losses {
        output::complain(&format!("not in {format}: {}: {}", loss.code, loss.detail));
    }
    if strict && !written.losses.is_empty() {
        return Err(Failure::new(
            Exit::Lossy,
            "nothing written: --strict was given and something would be lost",
        ));
    }
    output::write(target, &written.bytes, force)
}

/// Scores scenes.
///
/// # Errors
/// Exit 3 when none can be read, 4 when some cannot.
pub fn score(args: ScoreArgs) -> Result<(), Failure> {
    let (mut done, mut failed) = (0, 0);
    for path in &args.scenes {
        let scenes = match read_scenes(path, None, None) {
            Ok(scenes) => scenes,
            Err(failure) => {
                output::complain(&failure.message);
                failed += 1;
                continue;
            }
        };
        for imported in scenes {
            let drivable = Drivable::new(&imported.scene.map);
            let mut input = ScoreInput::of_scene(&imported.scene, &drivable);
            input.pairs = args.pairs;
            input.thresholds =
                Thresholds { iou: args.iou, ttc_s: args.ttc, gap_m: args.gap, ..input.thresholds };
            let score = scene::score::score(&input);
            let mut object = Map::new();
            object.insert("file".into(), path.display().to_string().into());
            object.insert("source_id".into(), json!(imported.scene.meta.source_id));
            if let Ok(Value::Object(members)) = serde_json::to_value(&score) {
                object.extend(members);
            }
            let line = if args.json { Value::Object(object).to_string() } else { in_words(path, &score) };
            output::print(format!("{line}\n").as_bytes())?;
            done += 1;
        }
    }
    match (done, failed) {
        (_, 0) => Ok(()),
        (0, _) => Err(Failure::new(Exit::Input, "no scene could be read")),
        _ => Err(Failure::new(
            Exit::Partly,
            format!("{failed} of {} files could not be read", args.scenes.len()),
        )),
    }
}

/// The score in one line. The words are those of "Words of a score" in the README.
fn in_words(path: &Path, score: &scene::score::Score) -> String {
    let number = |value: Option<f64>, unit: &str| value.map_or("-".into(), |v| format!("{v:.2} {unit}"));
    let scene = &score.scene;
    let own = |in_log: &[bool]| {
        let (all, log) = (in_log.len(), in_log.iter().filter(|in_log| **in_log).count());
        let of_log = if log > 0 { format!(" (and {log} of the log)") } else { String::new() };
        (all - log, of_log)
    };
    let list = |one: &str, many: &str, in_log: Vec<bool>| {
        let (count, of_log) = own(&in_log);
        format!("{count} {}{of_log}", if count == 1 { one } else { many })
    };
    format!(
        "{}: {}, {}, {}, least time to collision {}, least gap {}, off road {}",
        path.display(),
        list("collision", "collisions", scene.collisions.iter().map(|c| c.in_log).collect()),
        list("lighter overlap", "lighter overlaps", scene.overlaps.iter().map(|c| c.in_log).collect()),
        list("near miss", "near misses", scene.near_misses.iter().map(|c| c.in_log).collect()),
        number(scene.min_ttc_s, "s"),
        number(scene.min_distance_m, "m"),
        scene.offroad_share.map_or("-".into(), |share| format!("{:.1} %", share * 100.0)),
    )
}
