//! The tool that scores scenes.

use super::schema::{self, Members};
use super::tools::{ToolAnswer, Toolbox};
use api::score::ScoreRequest;
use api::{Problem, Subject};
use batch::figures::Figures;
use experts::Cancel;
use scene::score::Score;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;

/// Members that are passed on to a score.
const OF_SCORE: [&str; 2] = ["pairs", "thresholds"];
/// Entries per list of the score in the answer.
const MOST_ENTRIES: usize = 12;

/// Arguments of `score_scene` besides those of the request.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ScoreCall {
    /// Name of the open scene.
    scene: String,
    /// Id of a road user whose figures are added to the answer.
    #[serde(default)]
    road_user: Option<String>,
}

/// Arguments of `score_scene`.
pub fn score_arguments() -> Members {
    schema::of::<ScoreCall, ScoreRequest>(&OF_SCORE)
}

/// Scores the shown motions of a scene.
pub fn score(tools: &Toolbox, arguments: Members, _: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, request) = schema::read::<ScoreCall, ScoreRequest>(arguments, &OF_SCORE)?;
    let scene = tools.desk.get(&call.scene)?;
    if let Some(id) = call.road_user.as_ref().filter(|id| scene.agent(id).is_none()) {
        return Err(super::give::unknown_road_user(id));
    }
    let score = tools.operations.score(&request, &Subject::passing(scene))?;
    let figures = Figures::new(&score, call.road_user.as_deref(), None);
    let mut lines = vec![summary(&score)];
    lines.extend(figures.all().iter().map(|(name, value)| format!("{name} = {}", rounded(*value))));
    lines.extend(entries(&score));
    Ok(ToolAnswer::words(lines.join("\n")))
}

/// The entries of non-empty lists, one line each.
fn entries(score: &Score) -> Vec<String> {
    let scene = serde_json::to_value(&score.scene).unwrap_or_default();
    let mut lines = Vec::new();
    for (name, list) in scene.as_object().into_iter().flatten() {
        let Some(list) = list.as_array().filter(|list| !list.is_empty() && list[0].is_object()) else {
            continue;
        };
        for entry in list.iter().take(MOST_ENTRIES) {
            lines.push(format!("{name}: {entry}"));
        }
        if list.len() > MOST_ENTRIES {
            lines.push(format!("{name}: {} more", list.len() - MOST_ENTRIES));
        }
    }
    lines
}

fn rounded(value: f64) -> Value {
    Value::from((value * 1e3).round() / 1e3)
}

/// The most important figures in one line.
pub fn summary(score: &Score) -> String {
    let scene = &score.scene;
    let own = scene.collisions.iter().filter(|collision| !collision.in_log).count();
    let mut parts = vec![match own {
        1 => "1 collision".to_owned(),
        count => format!("{count} collisions"),
    }];
    parts.push(format!("{} near misses", scene.near_misses.len()));
    if let Some(ttc) = scene.min_ttc_s {
        let pair = scene.min_ttc_pair.as_ref().map_or_else(String::new, |[a, b]| format!(" ({a} and {b})"));
        parts.push(format!("minimum time to collision {ttc:.1} s{pair}"));
    }
    if !scene.off_road.is_empty() {
        parts.push(format!("{} off the road", scene.off_road.len()));
    }
    if let Some(share) = scene.goals_reached {
        parts.push(format!("{:.0} % of the goals reached", 100.0 * share));
    }
    parts.join(", ")
}
