//! Tools that change scenes: road users, conditions, futures.

use super::judge;
use super::schema::{self, Members};
use super::tools::{ToolAnswer, Toolbox, yes};
use crate::cli::generate::tell;
use api::generate::GenerationAnswer;
use api::limits::MOST_HORIZON_S;
use api::place::PlaceBody;
use api::{GenerateRequest, Problem, Subject};
use experts::{Cancel, WarningCode};
use scene::{STEP_S, Scene};
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt::Write as _;

/// Members that are passed on to a placement.
const OF_PLACE: [&str; 10] =
    ["region", "density", "types", "keep", "start_s", "seed", "min_gap_m", "speeds", "arrivals", "parked"];
/// Members of a generation that set conditions.
const OF_CONDITIONS: [&str; 4] = ["conditions", "add_agents", "remove_agents", "start_s"];
/// Members that are passed on to a generation.
pub const OF_GENERATE: [&str; 11] = [
    "conditions",
    "agents",
    "react",
    "start_s",
    "horizon_s",
    "replan_interval_s",
    "seed",
    "samples",
    "modes",
    "diversity",
    "kept_futures",
];
/// Number of road users of an answer that are described.
const MOST_LINES: usize = 24;
/// Number of road users whose future is described second by second.
const MOST_TRACED: usize = 4;

/// What a tool about a scene has beside the request.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SceneCall {
    /// Name of the open scene.
    scene: String,
    /// Include a picture in the answer.
    #[serde(default = "yes")]
    picture: bool,
}

/// Arguments of `place_road_users`.
pub fn place_arguments() -> Members {
    schema::of::<SceneCall, PlaceBody>(&OF_PLACE)
}

/// Places road users and keeps them in the scene.
pub fn place(tools: &Toolbox, arguments: Members, cancel: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, body) = schema::read::<SceneCall, PlaceBody>(arguments, &OF_PLACE)?;
    let scene = tools.desk.get(&call.scene)?;
    let placement = tools.operations.place(&body, &scene, cancel)?;
    let ids: Vec<&str> = placement.agents.iter().map(|agent| agent.id.as_str()).collect();
    let mut text = format!("Placed {} road users: {}.", ids.len(), ids.join(", "));
    let unplaced: usize = placement.unplaced.values().sum();
    if unplaced > 0 {
        let reason = placement.reason.as_deref().unwrap_or_default();
        let _ = write!(text, "\n{unplaced} have no place: {reason}");
    }
    for traffic in &placement.arms {
        let (arm, most) = (&traffic.arm.id, traffic.most_per_hour);
        let _ = write!(text, "\narm {arm}: at most {most:.0} vehicles an hour");
        let _ = write!(text, "; {} at the start, {} later", traffic.placed, traffic.later);
    }
    let checked = body.placed(&scene, placement);
    let scene = tools.desk.put(&call.scene, checked)?;
    let step = (body.start_s / STEP_S).round() as usize;
    Ok(ToolAnswer::with_picture(text, &scene, step, call.picture))
}

/// Arguments of `set_conditions`.
pub fn condition_arguments() -> Members {
    schema::of::<SceneCall, GenerateRequest>(&OF_CONDITIONS)
}

/// Sets conditions, and adds and removes road users. If the scene's user part changes, its futures become
/// stale.
pub fn set_conditions(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, mut request) = schema::read::<SceneCall, GenerateRequest>(arguments, &OF_CONDITIONS)?;
    // The longest horizon: the real one is given when futures are requested.
    request.horizon_s = MOST_HORIZON_S;
    let scene = tools.desk.get(&call.scene)?;
    let mut changed = request.apply(Scene::clone(&scene))?;
    let is_other = changed.input_hash() != scene.input_hash();
    if let Some(generated) = &mut changed.generated {
        generated.stale |= is_other;
        for sample in &mut generated.samples {
            sample.agents.retain(|id, _| !request.remove_agents.contains(id));
        }
    }
    let mut lines = Vec::new();
    for id in request.conditions.0.keys() {
        let Some(agent) = changed.agent(id) else { continue };
        let what = if agent.conditions.is_empty() { "is free" } else { "has its conditions" };
        lines.push(format!("{id} {what}"));
    }
    lines.extend(request.add_agents.iter().map(|agent| format!("{} was added", agent.id)));
    lines.extend(request.remove_agents.iter().map(|id| format!("{id} was removed")));
    if lines.is_empty() {
        lines.push("Nothing was changed".to_owned());
    }
    if changed.generated.as_ref().is_some_and(|generated| generated.stale) {
        lines.push("The futures that the scene keeps answer earlier conditions: ask again".to_owned());
    }
    let scene = tools.desk.put(&call.scene, changed)?;
    let text = format!("{}.", lines.join("; "));
    Ok(ToolAnswer::with_picture(text, &scene, request.start_step(), call.picture))
}

/// Arguments of `generate_futures`.
pub fn generate_arguments() -> Members {
    schema::of::<SceneCall, GenerateRequest>(&OF_GENERATE)
}

/// Generates futures and keeps them in the scene.
pub fn generate(tools: &Toolbox, arguments: Members, cancel: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, request) = schema::read::<SceneCall, GenerateRequest>(arguments, &OF_GENERATE)?;
    let scene = tools.desk.get(&call.scene)?;
    let about = Subject::passing(scene);
    let answered = tools.operations.generate(&request, &about, cancel.clone())?.answer()?;
    let text = told(&answered);
    let scene = tools.desk.put(&call.scene, kept(answered))?;
    Ok(ToolAnswer::with_picture(text, &scene, request.start_step(), call.picture))
}

/// The scene of an answer, with its futures.
pub fn kept(answered: GenerationAnswer) -> Scene {
    let mut scene = Scene::clone(&answered.scene);
    scene.generated = Some(answered.head.generated(String::new(), answered.samples));
    scene
}

/// An answer as text: each road user, the first ones second by second, warnings, figures of each sample.
pub fn told(answered: &GenerationAnswer) -> String {
    let GenerationAnswer { answer, scores, code, .. } = answered;
    let mut agents: Vec<_> = answer.samples.first().into_iter().flat_map(|sample| &sample.agents).collect();
    let asked = |id: &String| answer.resolved.get(id).and_then(tell::goal);
    agents.sort_by_key(|(id, futures)| (asked(id).is_none(), futures.reaction.is_none()));
    let mut lines: Vec<String> = Vec::new();
    for (id, futures) in agents.iter().take(MOST_LINES) {
        lines.push(format!("{id}: {}", tell::of_one(answer.resolved.get(*id), futures)));
    }
    if agents.len() > MOST_LINES {
        lines.push(format!("{} more road users", agents.len() - MOST_LINES));
    }
    for (id, futures) in agents.iter().take(MOST_TRACED) {
        let Some(future) = futures.modes.get(futures.chosen) else { continue };
        let seconds = future.states.iter().enumerate().skip(9).step_by(10);
        let places = seconds.map(|(i, state)| {
            let time_s = (future.first_step + i) as f64 * STEP_S;
            format!("{time_s:.0} s ({:.1}, {:.1}) {:.1} m/s", state.x_m, state.y_m, state.speed_mps())
        });
        lines.push(format!("{id} second by second: {}", places.collect::<Vec<_>>().join("; ")));
    }
    for warning in answer.warnings.iter().filter(|w| w.code != WarningCode::GoalUnreachable).take(MOST_LINES)
    {
        let subject = warning.agent.as_deref().unwrap_or("scene");
        lines.push(format!("warning, {subject}: {}", warning.detail));
    }
    for (number, score) in scores.iter().flatten().enumerate() {
        lines.push(format!("sample {number}: {}", judge::summary(score)));
    }
    lines.push(format!("code {code}"));
    lines.join("\n")
}
