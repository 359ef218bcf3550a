//! The work of one unit: selecting its actors, the generation, and its row.

use crate::case::facts::CaseFacts;
use crate::case::motion::CaseMotion;
use crate::catalogue::{CatalogueScene, UnitProblem};
use crate::figures::{FigureFilter, Figures};
use crate::pattern::place::PatternPlace;
use crate::pattern::search::PatternSearch;
use crate::plan::BatchPlan;
use crate::recorded::RecordedMotion;
use crate::row::{BatchRow, UnitOutcome};
use crate::unit::BatchUnit;
use api::generate::GenerationAnswer;
use api::generate::request::{AgentChoice, ReactChoice};
use api::{GenerateRequest, Operations, Problem, Subject};
use experts::{Cancel, Field, Limiting, ReachReport, Resolved, Source};
use formats::native::{ConditionsDoc, Members};
use scene::scenarios::Casting;
use scene::score::meeting::{MeetingPair, MeetingSearch};
use scene::score::{Score, ScoreInput};
use scene::{Conditions, Scene};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The actors of a unit and their conditions.
#[derive(Default)]
struct UnitRoles {
    actor: Option<String>,
    other: Option<String>,
    /// Description of the actor's behaviour, one sentence.
    what: Option<String>,
    conditions: BTreeMap<String, ConditionsDoc>,
    /// The scene with the road users of a pattern.
    put: Option<Arc<Scene>>,
}

/// The generation of a unit.
pub struct UnitAnswer {
    roles: UnitRoles,
    /// The answer: one sample, scored.
    pub answer: GenerationAnswer,
}

/// Result of a unit.
pub struct UnitEnd {
    /// Its row.
    pub row: BatchRow,
    /// Conditions of its request, by road user.
    pub conditions: BTreeMap<String, ConditionsDoc>,
    /// Its motion, for pictures; `None` without a result, or if no road user is visible.
    pub motion: Option<CaseMotion>,
}

/// Works on the units of a plan.
pub struct UnitEngine<'a> {
    plan: &'a BatchPlan,
    scenes: &'a [CatalogueScene],
    filter: Option<FigureFilter>,
    operations: &'a Operations,
}

impl<'a> UnitEngine<'a> {
    /// An engine for the units of a plan over a catalogue.
    pub fn new(plan: &'a BatchPlan, scenes: &'a [CatalogueScene], operations: &'a Operations) -> Self {
        // The plan was checked when it was read.
        let filter = plan.filter.as_deref().and_then(|text| FigureFilter::parse(text).ok());
        Self { plan, scenes, filter, operations }
    }

    /// The row of a unit before its generation; `None` for a unit of another plan.
    pub fn row(&self, unit: &BatchUnit) -> Option<BatchRow> {
        let entry = self.scenes.get(unit.scene)?;
        let situation = self.plan.situations.get(unit.situation)?;
        Some(BatchRow {
            unit: unit.id.hex(),
            scene: entry.sha256.clone(),
            name: entry.name.clone(),
            situation: situation.name().to_owned(),
            actor: unit.actor.clone(),
            other: None,
            draw: unit.draw,
            drawn: unit.drawn.clone(),
            seed: unit.seed,
            outcome: if entry.problem.is_some() { UnitOutcome::Failed } else { UnitOutcome::NobodyFits },
            problem: entry.problem.clone(),
            code: None,
            goal: None,
            reacting: None,
            what: None,
            miss: None,
            figures: BTreeMap::new(),
            facts: CaseFacts::default(),
        })
    }

    /// Whether there is something to generate; otherwise the row is final.
    pub fn has_work(&self, unit: &BatchUnit) -> bool {
        let is_scene = self.scenes.get(unit.scene).is_some_and(|entry| entry.problem.is_none());
        let situation = self.plan.situations.get(unit.situation);
        let names_actor = situation.is_some_and(|of| !of.agents.is_empty() || of.pattern.is_some());
        is_scene && (!names_actor || unit.actor.is_some())
    }

    /// Generates a unit in its scene; `None` if no road user fits.
    ///
    /// # Errors
    /// Those of the generation.
    pub fn answer(
        &self,
        unit: &BatchUnit,
        scene: &Arc<Scene>,
        cancel: &Cancel,
    ) -> Result<Option<UnitAnswer>, Problem> {
        let Some(roles) = self.roles(unit, scene) else { return Ok(None) };
        let mut request: GenerateRequest = self.plan.generate.request(unit.seed);
        request.conditions = Members(roles.conditions.clone());
        match &roles.actor {
            Some(actor) if roles.put.is_none() => {
                request.agents = Some(AgentChoice::Ids(vec![actor.clone()]))
            }
            _ => {
                // All road users are generated, those of a pattern without a goal too, so none is left to
                // react.
                request.agents =
                    roles.put.as_ref().map(|_| AgentChoice::Ids(roles.conditions.keys().cloned().collect()));
                request.react = ReactChoice::Whether(false);
            }
        }
        let about = Subject::passing(Arc::clone(roles.put.as_ref().unwrap_or(scene)));
        let answer = self.operations.generate(&request, &about, cancel.clone())?.answer()?;
        Ok(Some(UnitAnswer { roles, answer }))
    }

    fn roles(&self, unit: &BatchUnit, scene: &Scene) -> Option<UnitRoles> {
        let situation = self.plan.situations.get(unit.situation)?;
        let options = &self.plan.generate;
        if let Some(template) = situation.template() {
            let graph = self.operations.generator.maps().graph(&scene.map);
            let fixed = situation.parameters_of(&unit.drawn);
            let casting =
                template.cast(scene, &graph, options.start_step(), options.horizon_s, unit.seed, &fixed)?;
            let conditions = ConditionsDoc::from_conditions(&casting.conditions);
            let conditions = BTreeMap::from([(casting.actor.clone(), conditions)]);
            let Casting { actor, other, words, .. } = casting;
            return Some(UnitRoles { actor: Some(actor), other, what: Some(words), conditions, put: None });
        }
        if let Some(pattern) = situation.pattern() {
            let graph = self.operations.generator.maps().graph(&scene.map);
            let place = PatternSearch::new(pattern, scene, &graph).find(unit.actor.as_ref()?)?;
            let agents =
                place.cast(pattern, &situation.parameters_of(&unit.drawn), options.start_step()).ok()?;
            let ids: Vec<String> = agents.iter().map(|agent| agent.id.clone()).collect();
            let conditions =
                agents.iter().map(|of| (of.id.clone(), ConditionsDoc::from_conditions(&of.conditions)));
            let what = Some(format!("{} at {}", pattern.name, place.id));
            let conditions = conditions.collect();
            let put = PatternPlace::scene(scene, scene.name.clone(), agents, options.start_step());
            let (actor, other) = (ids.first().cloned(), ids.get(1).cloned());
            return Some(UnitRoles { actor, other, what, conditions, put: Some(Arc::new(put)) });
        }
        let Some(actor) = &unit.actor else { return Some(UnitRoles::default()) };
        let own = |id: &str| {
            let own = scene.agent(id).map_or_else(Conditions::default, |agent| agent.conditions.clone());
            ConditionsDoc::from_conditions(&own)
        };
        let graph = self.operations.generator.maps().graph(&scene.map);
        let recording = scene
            .agent(actor)
            .map(|agent| RecordedMotion::new(agent, &graph, options.start_step(), options.horizon_s));
        let applied = situation.applied(own(actor), &unit.drawn, recording.as_ref())?;
        let beside = situation.beside(scene, options.start_step()).into_iter().filter(|id| id != actor);
        let beside = beside.map(|id| (id.clone(), situation.applied_beside(own(&id), &unit.drawn)));
        let conditions = beside.chain([(actor.clone(), applied)]).collect();
        let other = situation.with.clone();
        Some(UnitRoles { actor: Some(actor.clone()), other, conditions, ..UnitRoles::default() })
    }

    /// Writes the result of a generation into the row of its unit.
    pub fn end(&self, mut row: BatchRow, answered: Result<Option<UnitAnswer>, Problem>) -> UnitEnd {
        let UnitAnswer { roles, answer } = match answered {
            Ok(Some(answered)) => answered,
            Ok(None) => return UnitEnd { row, conditions: BTreeMap::new(), motion: None },
            Err(Problem { code, detail, .. }) => {
                row.outcome = UnitOutcome::Failed;
                row.problem = Some(UnitProblem { code: code.name().to_owned(), detail });
                return UnitEnd { row, conditions: BTreeMap::new(), motion: None };
            }
        };
        let drivable = self.operations.generator.maps().drivable(&answer.scene.map);
        let input = ScoreInput::of_sample(&answer.scene, answer.samples.first(), &drivable);
        let search = MeetingSearch::new(&input);
        let score = answer.scores.as_ref().and_then(|scores| scores.first());
        let sample = answer.samples.first();
        let reacting = sample.map_or(0, |s| s.agents.values().filter(|f| f.reaction.is_some()).count());
        row.code = Some(answer.code.clone());
        let goals = roles.conditions.keys().map(|id| goal_word(answer.answer.resolved.get(id)));
        // With several goals, one missed goal decides.
        let goal = goals.max_by_key(|word| GOAL_WORDS.iter().position(|known| known == word));
        row.goal = Some(goal.unwrap_or(GOAL_WORDS[0]).to_owned());
        row.reacting = Some(reacting as u64);
        (row.actor, row.other, row.what) = (roles.actor, roles.other, roles.what);
        let (motion, hardest) = happened(&mut row, &input, &search, score).unzip();
        let pair = match (&row.actor, &row.other) {
            (Some(actor), Some(other)) => search.of(actor, Some(other)),
            (Some(_), None) => hardest.flatten(),
            (None, _) => None,
        };
        let figures = score.map(|score| Figures::new(score, row.actor.as_deref(), pair.as_ref()));
        row.figures = figures.as_ref().map(|figures| figures.all().clone()).unwrap_or_default();
        row.miss = self.filter.as_ref().zip(figures.as_ref()).map(|(filter, figures)| filter.miss(figures));
        let is_left_out = self.filter.is_some() && row.miss != Some(0.0);
        row.outcome = if is_left_out { UnitOutcome::LeftOut } else { UnitOutcome::Kept };
        UnitEnd { row, conditions: roles.conditions, motion: motion.flatten() }
    }
}

/// Writes the facts of a result into its row: those of the actor, else of one of the pair with the least time to
/// collision. Returns the motion and the hardest pair of this road user.
fn happened(
    row: &mut BatchRow,
    input: &ScoreInput<'_>,
    search: &MeetingSearch<'_>,
    score: Option<&Score>,
) -> Option<(Option<CaseMotion>, Option<MeetingPair>)> {
    let hardest = || score?.scene.min_ttc_pair.as_ref().map(|pair| &pair[0]);
    let id = row.actor.as_ref().or_else(hardest)?;
    let of = input.actors.iter().position(|actor| actor.id == id)?;
    let (facts, pair) = CaseFacts::of(input, search, of)?;
    row.facts = facts;
    Some((CaseMotion::of(&row.unit, input, of, pair.as_ref()), pair))
}

/// Whether a road user has a requested goal.
pub fn has_goal(resolved: &Resolved) -> bool {
    let asked = |field: Field| matches!(field.from, Source::User | Source::Relation);
    let goal = &resolved.goal;
    let is_unplaced = matches!(resolved.reach, ReachReport::Unreachable { limiting: Limiting::Relation, .. });
    is_unplaced || asked(goal.x_m) || asked(goal.speed_mps) || asked(goal.heading_rad)
}

/// The values of [`goal_word`].
const GOAL_WORDS: [&str; 3] = ["none", "met", "missed"];

/// Whether the goal of a road user is met, in one word, for tables.
pub fn goal_word(resolved: Option<&Resolved>) -> &'static str {
    match resolved.filter(|resolved| has_goal(resolved)).map(|resolved| &resolved.reach) {
        None => GOAL_WORDS[0],
        Some(ReachReport::Reached { .. }) => GOAL_WORDS[1],
        Some(ReachReport::Unreachable { .. }) => GOAL_WORDS[2],
    }
}
