//! The tool that searches: tries seeds and keeps the result nearest to a condition on its figures.

use super::ask::{self, OF_GENERATE};
use super::schema::{self, Members};
use super::tools::{ToolAnswer, Toolbox, yes};
use api::generate::GenerationAnswer;
use api::generate::request::{AgentChoice, ReactChoice};
use api::{Code, GenerateRequest, Problem, Subject};
use base::clock;
use batch::figures::{FigureFilter, Figures};
use experts::Cancel;
use formats::native::ConditionsDoc;
use scene::scenarios::{Casting, Template};
use scene::score::ScoreInput;
use scene::{Sample, Scene};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Most seeds of a search.
const MOST_SEEDS: u64 = 200;
/// Share of a call's time limit after which no new seed is tried.
const SHARE_OF_TIME: f64 = 0.8;
/// Number of results in the answer.
const MOST_TOLD: usize = 10;

/// Arguments of a search besides those of the request for each seed.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SearchCall {
    /// Name of the open scene.
    scene: String,
    /// Condition on the figures of the score, such as `min_ttc_s < 1.5 && collisions == 0`. Figures of the requested
    /// road user begin with `actor.`; score_scene lists the names.
    r#where: String,
    /// Test situation that is drawn again for each seed: `brake`, `cut-in` or `late`. Without one, the request is the
    /// same for all seeds.
    #[serde(default)]
    template: Option<String>,
    /// Seeds to try, from `seed` on.
    #[serde(default = "twenty")]
    #[schemars(range(min = 1, max = 200))]
    seeds: u64,
    /// Number of results that satisfy the condition after which the search ends.
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 200))]
    found: u64,
    /// Include a picture of the best result in the answer.
    #[serde(default = "yes")]
    picture: bool,
}

fn twenty() -> u64 {
    20
}

fn one() -> u64 {
    1
}

/// Arguments of `search_futures`.
pub fn arguments() -> Members {
    schema::of::<SearchCall, GenerateRequest>(&OF_GENERATE)
}

/// A sample of a seed, and its distance to the condition.
struct Try {
    seed: u64,
    /// 0 if the condition holds.
    miss: f64,
    what: String,
    answered: GenerationAnswer,
    sample: Sample,
}

/// Runs the search and keeps the best result in the scene.
pub fn search(tools: &Toolbox, arguments: Members, cancel: &Cancel) -> Result<ToolAnswer, Problem> {
    let (call, request) = schema::read::<SearchCall, GenerateRequest>(arguments, &OF_GENERATE)?;
    let scene = tools.desk.get(&call.scene)?;
    let filter = FigureFilter::parse(&call.r#where)
        .map_err(|reason| Problem::field("/where", Code::InvalidField, reason))?;
    for (pointer, number) in [("/seeds", call.seeds), ("/found", call.found)] {
        if !(1..=MOST_SEEDS).contains(&number) {
            return Err(Problem::range(pointer, 1.0, MOST_SEEDS as f64, number as f64));
        }
    }
    let template = call.template.as_deref().map(template).transpose()?;
    let until = clock::monotonic() + tools.patience.mul_f64(SHARE_OF_TIME);
    let (mut best, mut lines, mut tried, mut held, mut unfit) = (None::<Try>, Vec::new(), 0, 0, 0);
    for seed in request.seed..request.seed.saturating_add(call.seeds) {
        if held >= call.found || (tried > 0 && clock::monotonic() > until) {
            break;
        }
        tried += 1;
        let Some(found) = one_seed(tools, &scene, &request, (template, seed), &filter, cancel)? else {
            unfit += 1;
            continue;
        };
        if found.miss == 0.0 {
            held += 1;
            lines.push(format!("seed {seed}: {}", found.what));
        }
        if best.as_ref().is_none_or(|best| found.miss < best.miss) {
            best = Some(found);
        }
    }
    let mut text = format!("{held} of {tried} seeds hold {}.", filter.text());
    if unfit > 0 {
        text.push_str(&format!(" No road user fits the template with {unfit} of them."));
    }
    let Some(best) = best else { return Ok(ToolAnswer::words(text)) };
    let more = lines.len().saturating_sub(MOST_TOLD);
    lines.truncate(MOST_TOLD);
    if more > 0 {
        lines.push(format!("{more} more"));
    }
    for line in lines {
        text.push_str(&format!("\n{line}"));
    }
    let how = if best.miss == 0.0 { "the first that holds it" } else { "the nearest to it" };
    text.push_str(&format!("\nThe scene keeps the result of seed {}, {how}:\n", best.seed));
    let Try { mut answered, sample, .. } = best;
    answered.samples = vec![sample];
    text.push_str(&ask::told(&answered));
    let scene = tools.desk.put(&call.scene, ask::kept(answered))?;
    Ok(ToolAnswer::with_picture(text, &scene, request.start_step(), call.picture))
}

fn template(name: &str) -> Result<Template, Problem> {
    let found = Template::ALL.into_iter().find(|template| template.name() == name);
    found.ok_or_else(|| schema::no_word("/template", name, &Template::ALL.map(Template::name)))
}

/// The sample of a seed that is nearest to the condition; `None` if no road user fits the template.
fn one_seed(
    tools: &Toolbox,
    scene: &Arc<Scene>,
    asked: &GenerateRequest,
    (template, seed): (Option<Template>, u64),
    filter: &FigureFilter,
    cancel: &Cancel,
) -> Result<Option<Try>, Problem> {
    let mut request = GenerateRequest { seed, score: true, ..asked.clone() };
    let (mut words, mut affected) = (Vec::new(), None);
    if let Some(template) = template {
        let graph = tools.operations.generator.maps().graph(&scene.map);
        let fixed = BTreeMap::new();
        let casting = template.cast(scene, &graph, asked.start_step(), asked.horizon_s, seed, &fixed);
        let Some(casting) = casting else { return Ok(None) };
        let Casting { actor, other, conditions, words: said, .. } = casting;
        affected = other;
        request.conditions.0.insert(actor.clone(), ConditionsDoc::from_conditions(&conditions));
        request.agents = Some(AgentChoice::Ids(vec![actor]));
        if matches!(request.react, ReactChoice::Whether(false)) {
            request.react = ReactChoice::Whether(true);
        }
        words.push(said);
    }
    let about = Subject::passing(Arc::clone(scene));
    let plan = tools.operations.plan(&request, &about)?;
    let asked = plan.request.agents.as_ref();
    let actor = asked.filter(|ids| ids.len() == 1).and_then(|ids| ids.first().cloned());
    let answered = tools.operations.start(plan, cancel.clone())?.answer()?;
    let drivable = tools.operations.generator.maps().drivable(&answered.scene.map);
    let scored = answered.scores.iter().flatten().zip(&answered.samples).map(|(score, sample)| {
        let input = ScoreInput::of_sample(&answered.scene, Some(sample), &drivable);
        let figures = Figures::of(score, &input, actor.as_deref(), affected.as_deref());
        (filter.miss(&figures), score, sample)
    });
    let nearest = scored.min_by(|(a, ..), (b, ..)| a.total_cmp(b));
    let Some((miss, score, sample)) = nearest else { return Ok(None) };
    words.push(super::judge::summary(score));
    let (what, sample) = (words.join("; "), sample.clone());
    Ok(Some(Try { seed, miss, what, answered, sample }))
}
