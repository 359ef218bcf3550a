//! `dragtraffic generate`: the same work as `POST /v1/generate`, from file to file.

use super::files::read_scene;
use super::{Common, Exit, Failure, output};
use crate::base::limits::Limits;
use crate::base::problem::Problem;
use crate::generation::events::GeneratedHead;
use crate::generation::kept;
use crate::routes::generate::GenerateRequest;
use clap::Args;
use experts::request::DEFAULTS;
use experts::{Cancel, Event};
use formats::native::{self, MapForm, SceneDoc};
use scene::{Generated, Scene};
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// Flags of `generate`.
#[derive(Args, Clone, Debug)]
pub struct GenerateArgs {
    /// Scene to read, of any format; - is stdin.
    scene: PathBuf,
    /// Conditions of a road user: ID=FILE.json.
    #[arg(long, value_name = "ID=FILE")]
    condition: Vec<String>,
    /// Goal of a road user: ID=X,Y[,SPEED[,HEADING[,TIME]]]; an empty place leaves the field free.
    #[arg(long, value_name = "ID=X,Y,..")]
    goal: Vec<String>,
    /// Road users to regenerate, with commas; all when absent.
    #[arg(long, value_delimiter = ',')]
    agents: Vec<String>,
    /// The rest answers: all of it, or the given ids.
    #[arg(long, value_delimiter = ',', num_args = 0.., value_name = "ID")]
    react: Option<Vec<String>>,
    /// Forget the futures that the scene has from earlier calls: whoever is not asked for goes back to its log.
    /// Without it they are planned around and stay.
    #[arg(long)]
    forget: bool,
    /// The same seed gives the same answer.
    #[arg(long, default_value_t = DEFAULTS.seed)]
    seed: u64,
    /// Independent joint scenes.
    #[arg(long, default_value_t = DEFAULTS.samples as u64)]
    samples: u64,
    /// Alternatives kept per road user.
    #[arg(long, default_value_t = DEFAULTS.modes as u64)]
    modes: u64,
    /// Denoising steps.
    #[arg(long, default_value_t = DEFAULTS.steps as u64)]
    steps: u64,
    /// Seconds to generate, 0.5 to 20. More than 9 is planned window after window.
    #[arg(long, default_value_t = DEFAULTS.horizon_s)]
    horizon: f64,
    /// Scene time of the start, seconds.
    #[arg(long, default_value_t = 0.0)]
    start: f64,
    /// Plan anew, from the states reached, after so many seconds: 3, 6 or 9 (9 when absent).
    #[arg(long)]
    replan: Option<f64>,
    /// Scale of the noise, which makes seeds differ; 0 is the best guess.
    #[arg(long, default_value_t = DEFAULTS.diversity)]
    diversity: f64,
    /// File to write the scene with its futures to; - or absent is stdout.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Overwrite the output.
    #[arg(long)]
    force: bool,
}

/// Generates and writes the scene with its futures.
///
/// # Errors
/// Exit 2, 3, 7, 8.
pub fn run(args: GenerateArgs, common: &Common) -> Result<(), Failure> {
    let scene = read_scene(&args.scene)?;
    let body: GenerateRequest = serde_json::from_value(body(&args)?)
        .map_err(|error| Failure::new(Exit::Usage, format!("options: {error}")))?;
    let refused = |problem: Problem| super::files::refused(&args.scene, &problem);
    let generator = super::generator(common)?;
    let task = body.task(&scene, &Limits::default(), &generator).map_err(refused)?;
    let mut scene = (*task.request.scene).clone();
    let failed = |error: experts::GenerateError| Failure::new(Exit::Failure, error.to_string());
    let events = generator.start(task.request, Cancel::default()).map_err(failed)?;
    for event in events {
        if let Event::Final(answer) = event.map_err(failed)? {
            for warning in &answer.warnings {
                let who = warning.agent.as_deref().unwrap_or("scene");
                output::complain(&format!("{who}: {}: {}", warning.code, warning.detail));
            }
            let mut samples = answer.samples;
            samples.iter_mut().for_each(|sample| kept::fill(&scene, sample));
            tell_latecomers(&scene, &args, &samples);
            scene.generated = Some(generated(task.head, samples));
            return write(&scene, &args);
        }
    }
    Err(Failure::new(Exit::Failure, "the generator ended without an answer"))
}

/// Says who comes in after the start of a scene that is generated whole and keeps its log, which knows nothing of
/// what the others do now.
fn tell_latecomers(scene: &Scene, args: &GenerateArgs, samples: &[scene::Sample]) {
    let start = (args.start / scene::STEP_S).round() as usize;
    let late = |agent: &&scene::Agent| {
        agent.state_at(start).is_none()
            && agent.track.last_valid_step() > Some(start)
            && !samples.iter().any(|sample| sample.agents.contains_key(&agent.id))
    };
    let count = scene.agents.iter().filter(late).count();
    if args.agents.is_empty() && args.react.is_none() && count > 0 {
        output::complain(&format!(
            "{count} road users come in later and keep their log; --react lets them answer the others"
        ));
    }
}

fn write(scene: &Scene, args: &GenerateArgs) -> Result<(), Failure> {
    let bytes = native::write_doc(&SceneDoc::from_scene(scene, MapForm::Inline));
    output::write(args.output.as_deref(), &bytes, args.force)
}

fn generated(head: GeneratedHead, samples: Vec<scene::Sample>) -> Generated {
    let head = head.dated();
    Generated {
        input_sha256: head.input_sha256,
        stale: head.stale,
        weights: head.weights,
        seed: head.seed,
        request: head.request,
        licence: head.licence,
        created_at: head.created_at,
        chosen_sample: head.chosen_sample,
        samples,
    }
}

/// The body of `POST /v1/generate` that says the same.
fn body(args: &GenerateArgs) -> Result<Value, Failure> {
    let mut conditions = Map::new();
    for text in &args.condition {
        let (id, file) = split(text, "--condition")?;
        let bytes = output::read(file.as_ref())?;
        let value: Value = serde_json::from_slice(&bytes)
            .map_err(|error| Failure::new(Exit::Input, format!("{file}: {error}")))?;
        conditions.insert(id.to_owned(), value);
    }
    for text in &args.goal {
        let (id, numbers) = split(text, "--goal")?;
        let slot = conditions.entry(id).or_insert_with(|| json!({}));
        slot["goal"] = goal(numbers)?;
    }
    let react = match &args.react {
        None => json!(false),
        Some(ids) if ids.is_empty() => json!(true),
        Some(ids) => json!(ids),
    };
    Ok(json!({
        "conditions": conditions,
        "agents": if args.agents.is_empty() { json!("all") } else { json!(args.agents) },
        "react": react, "start_s": args.start, "horizon_s": args.horizon, "replan_interval_s": args.replan,
        "seed": args.seed, "samples": args.samples, "modes": args.modes, "diversity": args.diversity,
        "steps": args.steps, "score": false,
        "kept_futures": if args.forget { "forgotten" } else { "answered" },
    }))
}

fn split<'a>(text: &'a str, flag: &str) -> Result<(&'a str, &'a str), Failure> {
    text.split_once('=').ok_or_else(|| Failure::new(Exit::Usage, format!("{flag} {text}: ID=... expected")))
}

fn goal(text: &str) -> Result<Value, Failure> {
    let names = ["x_m", "y_m", "speed_mps", "heading_rad", "time_s"];
    let mut goal = Map::new();
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    if fields.len() > names.len() {
        return Err(Failure::new(Exit::Usage, format!("--goal {text}: at most {} numbers", names.len())));
    }
    for (name, field) in names.into_iter().zip(fields).filter(|(_, field)| !field.is_empty()) {
        let number: f64 =
            field.parse().ok().filter(|n: &f64| n.is_finite()).ok_or_else(|| {
                Failure::new(Exit::Usage, format!("--goal {text}: \"{field}\" is no number"))
            })?;
        goal.insert(name.into(), json!(number));
    }
    Ok(Value::Object(goal))
}

#[cfg(test)]
mod tests {
    use super::goal;
    use serde_json::json;

    #[test]
    fn goals_on_the_command_line() {
        assert_eq!(goal("61,3.4,12").ok(), Some(json!({"x_m": 61.0, "y_m": 3.4, "speed_mps": 12.0})));
        assert_eq!(goal("1,2,,0.5").ok(), Some(json!({"x_m": 1.0, "y_m": 2.0, "heading_rad": 0.5})));
        assert!(goal("1,NaN").is_err());
        assert!(goal("1,2,3,4,5,6").is_err());
    }
}
