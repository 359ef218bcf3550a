//! One answer: from a scene and a seed to a scene with its futures.

use super::{GenerateArgs, ask};
use crate::cli::inputs::Source;
use crate::cli::{Exit, Failure, pointers};
use api::generate::{GenerationAnswer, GenerationRun};
use api::{Operations, Problem, Subject};
use base::clock;
use batch::figures::Figures;
use experts::{Cancel, Resolved, Warning};
use formats::native::{self, MapForm, SceneDoc};
use scene::Scene;
use scene::scenarios::{Casting, Template};
use scene::score::ScoreInput;
use std::collections::BTreeMap;
use std::time::{Duration, UNIX_EPOCH};

/// Makes answers.
pub struct Maker<'a> {
    /// Flags.
    pub args: &'a GenerateArgs,
    /// The operations.
    pub operations: &'a Operations,
    /// Whether figures are needed.
    pub scored: bool,
}

/// The result for a scene and a seed.
pub enum MakeOutcome {
    /// An answer.
    Made(Box<MadeScene>),
    /// No road user of the scene fits the template.
    NobodyFits(Template),
}

/// An answer.
pub struct MadeScene {
    /// The scene with the kept samples.
    pub scene: Scene,
    /// The casting of a template.
    pub casting: Option<Casting>,
    /// The requested road user, if it is a single one.
    pub actor: Option<String>,
    /// Conditions of each road user, and whether they are met.
    pub resolved: BTreeMap<String, Resolved>,
    /// Warnings.
    pub warnings: Vec<Warning>,
    /// Index of each kept sample among all, and its figures if they are needed.
    pub samples: Vec<(usize, Option<Figures>)>,
    /// Number of all samples.
    pub all_samples: usize,
    /// Road users outside the call whose futures the scene keeps.
    pub kept: Vec<String>,
    /// Code of the answer, six characters.
    pub code: String,
}

impl Maker<'_> {
    /// Makes an answer.
    ///
    /// # Errors
    /// Exit 1, 2 or 3.
    pub fn make(
        &self,
        source: &Source,
        scene: Scene,
        template: Option<Template>,
        seed: u64,
    ) -> Result<MakeOutcome, Failure> {
        let args = self.args;
        let casting = match template {
            None => None,
            Some(template) => {
                let graph = self.operations.generator.maps().graph(&scene.map);
                let casting =
                    template.cast(&scene, &graph, args.start_step(), args.horizon, seed, &BTreeMap::new());
                let Some(casting) = casting else { return Ok(MakeOutcome::NobodyFits(template)) };
                Some(casting)
            }
        };
        let request = ask::request(args, &scene, casting.as_ref(), seed, self.scored)?;
        let plan = self
            .operations
            .plan(&request, &Subject::passing(scene))
            .map_err(|problem| pointers::refused(source, &problem))?;
        let failed =
            |problem: Problem| Failure::new(Exit::Failure, format!("{}: {}", source.shown(), problem.detail));
        let asked = plan.request.agents.as_ref();
        let actor = asked.filter(|ids| ids.len() == 1).and_then(|ids| ids.first().cloned());
        let call = self.operations.start(plan, Cancel::default());
        let answered = call.and_then(GenerationRun::answer).map_err(failed)?;
        let GenerationAnswer { answer, samples: all, scores, head, code, .. } = answered;
        let mut scene = (*answered.scene).clone();
        let all_samples = all.len();
        let last = all.last().into_iter().zip(answer.samples.last());
        let kept =
            last.flat_map(|(whole, own)| whole.agents.keys().filter(|id| !own.agents.contains_key(*id)));
        let kept = kept.cloned().collect();
        let scores =
            scores.map_or_else(|| vec![None; all_samples], |scores| scores.into_iter().map(Some).collect());
        let (mut samples, mut numbers) = (Vec::new(), Vec::new());
        let drivable = self.operations.generator.maps().drivable(&scene.map);
        let other = casting.as_ref().and_then(|casting| casting.other.as_deref());
        for (number, (sample, score)) in all.into_iter().zip(scores).enumerate() {
            let figures = score.map(|score| {
                let input = ScoreInput::of_sample(&scene, Some(&sample), &drivable);
                Figures::of(&score, &input, actor.as_deref(), other)
            });
            let wanted = |figures: &Figures| args.filter.as_ref().is_none_or(|filter| filter.holds(figures));
            if figures.as_ref().is_none_or(wanted) {
                samples.push(sample);
                numbers.push((number, figures));
            }
        }
        scene.generated = Some(head.generated(created_at(), samples));
        Ok(MakeOutcome::Made(Box::new(MadeScene {
            scene,
            casting,
            actor,
            resolved: answer.resolved,
            warnings: answer.warnings,
            samples: numbers,
            all_samples,
            kept,
            code,
        })))
    }
}

impl MadeScene {
    /// The scene document.
    pub fn bytes(&self) -> Vec<u8> {
        native::write_doc(&SceneDoc::from_scene(&self.scene, MapForm::Inline))
    }
}

/// Empty, so that equal calls give equal files; the time of SOURCE_DATE_EPOCH if it is set.
pub fn created_at() -> String {
    let given = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.parse().ok());
    let time = given.and_then(|seconds| UNIX_EPOCH.checked_add(Duration::from_secs(seconds)));
    time.map_or_else(String::new, clock::text)
}
