//! One unit: from its number to its row, and to the line of its result where that is kept.

use super::folder::BatchFolder;
use super::record::BatchRecord;
use crate::base::clock;
use crate::cli::Failure;
use crate::cli::generate::{created_at, tell};
use crate::cli::score::figures::{FigureFilter, Figures};
use api::generate::GenerationAnswer;
use api::generate::request::{AgentChoice, ReactChoice};
use api::{GenerateRequest, Operations, Problem, Subject};
use batch::case::facts::CaseFacts;
use batch::case::motion::CaseMotion;
use batch::catalogue::UnitProblem;
use batch::row::{BatchRow, KeptCase, UnitOutcome};
use batch::unit::BatchUnit;
use experts::Cancel;
use formats::native::{ConditionsDoc, Members};
use lru::LruCache;
use scene::scenarios::Casting;
use scene::score::ScoreInput;
use scene::score::meeting::MeetingSearch;
use scene::{Conditions, Scene};
use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Scenes in memory: units of one scene follow each other.
const SCENES: NonZeroUsize = NonZeroUsize::new(8).unwrap();

/// A scene that is read by the first who needs it.
type Slot = Arc<OnceLock<Result<Arc<Scene>, Failure>>>;

/// What came of a unit.
pub struct UnitEnd {
    /// Its row.
    pub row: BatchRow,
    /// The lines of its result, where it is kept.
    pub lines: Option<CaseLines>,
}

/// The lines of a result that is kept.
pub struct CaseLines {
    /// Its reference.
    pub case: String,
    /// Its motion, for pictures; empty where nobody is seen.
    pub motion: String,
}

/// A result that was made again.
pub struct RemadeResult {
    /// The scene with its futures.
    pub scene: Scene,
    /// Names the result, in six characters.
    pub code: String,
}

/// What units need.
pub struct UnitWorker<'a> {
    folder: &'a BatchFolder,
    record: &'a BatchRecord,
    filter: Option<FigureFilter>,
    operations: &'a Operations,
    scenes: Mutex<LruCache<usize, Slot>>,
    /// Time inside the engine, microseconds of all threads.
    engine_us: AtomicU64,
}

/// Who acts in a unit, and on what conditions.
#[derive(Default)]
struct Roles {
    actor: Option<String>,
    casting: Option<Casting>,
    conditions: BTreeMap<String, ConditionsDoc>,
}

impl<'a> UnitWorker<'a> {
    /// For the units of a folder.
    ///
    /// # Errors
    /// Exit 3 for a condition on the results that makes no sense.
    pub fn new(
        folder: &'a BatchFolder,
        record: &'a BatchRecord,
        operations: &'a Operations,
    ) -> Result<Self, Failure> {
        let filter = record.plan.filter.as_deref().map(FigureFilter::parse).transpose();
        let filter = filter.map_err(|reason| Failure::input(format!("where: {reason}")))?;
        let scenes = Mutex::new(LruCache::new(SCENES));
        Ok(Self { folder, record, filter, operations, scenes, engine_us: AtomicU64::new(0) })
    }

    /// Time inside the engine, the sum over all threads.
    pub fn engine_time(&self) -> Duration {
        Duration::from_micros(self.engine_us.load(Ordering::Relaxed))
    }

    /// Works on a unit.
    ///
    /// # Errors
    /// Exit 3 when the folder lacks the scene. All else that can go wrong is a row.
    pub fn end(&self, unit: &BatchUnit) -> Result<UnitEnd, Failure> {
        let missing = || Failure::input(format!("{}: no unit {}", self.folder.shown(), unit.id.hex()));
        let entry = self.record.scenes.get(unit.scene).ok_or_else(missing)?;
        let situation = self.record.plan.situations.get(unit.situation).ok_or_else(missing)?;
        let mut row = BatchRow {
            unit: unit.id.hex(),
            scene: entry.sha256.clone(),
            name: entry.name.clone(),
            situation: situation.name().to_owned(),
            actor: unit.actor.clone(),
            other: None,
            draw: unit.draw,
            drawn: unit.drawn.clone(),
            seed: unit.seed,
            outcome: UnitOutcome::NobodyFits,
            problem: entry.problem.clone(),
            code: None,
            goal: None,
            reacting: None,
            what: None,
            miss: None,
            figures: BTreeMap::new(),
            facts: CaseFacts::default(),
        };
        if row.problem.is_some() {
            row.outcome = UnitOutcome::Failed;
            return Ok(UnitEnd { row, lines: None });
        }
        if !situation.agents.is_empty() && unit.actor.is_none() {
            return Ok(UnitEnd { row, lines: None });
        }
        let scene = self.scene(unit.scene)?;
        let began = clock::monotonic();
        let answered = self.roles(unit, &scene).map(|roles| self.answered(unit, &scene, roles));
        let spent = clock::monotonic().saturating_sub(began).as_micros();
        self.engine_us.fetch_add(spent as u64, Ordering::Relaxed);
        let lines = match answered {
            None => None,
            Some(Err(Problem { code, detail, .. })) => {
                row.outcome = UnitOutcome::Failed;
                row.problem = Some(UnitProblem { code: code.name().to_owned(), detail });
                None
            }
            Some(Ok((roles, answered))) => self.settled(&mut row, roles, &answered),
        };
        Ok(UnitEnd { row, lines })
    }

    /// Makes the result of a unit again; `None` where it has none.
    ///
    /// # Errors
    /// Exit 3 when the folder lacks the scene.
    pub fn result(&self, unit: &BatchUnit) -> Result<Option<RemadeResult>, Failure> {
        let has_problem = self.record.scenes.get(unit.scene).is_none_or(|entry| entry.problem.is_some());
        let names_agents =
            self.record.plan.situations.get(unit.situation).is_some_and(|of| !of.agents.is_empty());
        if has_problem || (names_agents && unit.actor.is_none()) {
            return Ok(None);
        }
        let scene = self.scene(unit.scene)?;
        let answered = self.roles(unit, &scene).and_then(|roles| self.answered(unit, &scene, roles).ok());
        Ok(answered.map(|(_, GenerationAnswer { scene, samples, head, code, .. })| {
            let generated = Some(head.generated(created_at(), samples));
            RemadeResult { scene: Scene { generated, ..(*scene).clone() }, code }
        }))
    }

    /// A scene of the catalogue, read once for all units that need it now.
    fn scene(&self, index: usize) -> Result<Arc<Scene>, Failure> {
        let slot = {
            let mut scenes = self.scenes.lock().unwrap_or_else(PoisonError::into_inner);
            Arc::clone(scenes.get_or_insert(index, Slot::default))
        };
        let missing = || Failure::input(format!("{}: no scene {index}", self.folder.shown()));
        let read = || {
            let entry = self.record.scenes.get(index).ok_or_else(missing)?;
            self.folder.read_scene(entry).map(Arc::new)
        };
        slot.get_or_init(read).clone()
    }

    /// Who acts; `None` where nobody fits.
    fn roles(&self, unit: &BatchUnit, scene: &Scene) -> Option<Roles> {
        let situation = self.record.plan.situations.get(unit.situation)?;
        let options = &self.record.plan.generate;
        if let Some(template) = situation.template() {
            let graph = self.operations.generator.maps().graph(&scene.map);
            let fixed = situation.parameters_of(&unit.drawn);
            let casting =
                template.cast(scene, &graph, options.start_step(), options.horizon_s, unit.seed, &fixed)?;
            let conditions = ConditionsDoc::from_conditions(&casting.conditions);
            let conditions = BTreeMap::from([(casting.actor.clone(), conditions)]);
            return Some(Roles { actor: Some(casting.actor.clone()), casting: Some(casting), conditions });
        }
        let Some(actor) = &unit.actor else { return Some(Roles::default()) };
        let own = scene.agent(actor).map_or_else(Conditions::default, |agent| agent.conditions.clone());
        let conditions = situation.applied(ConditionsDoc::from_conditions(&own), &unit.drawn);
        let conditions = BTreeMap::from([(actor.clone(), conditions)]);
        Some(Roles { actor: Some(actor.clone()), casting: None, conditions })
    }

    fn answered(
        &self,
        unit: &BatchUnit,
        scene: &Arc<Scene>,
        roles: Roles,
    ) -> Result<(Roles, GenerationAnswer), Problem> {
        let mut request: GenerateRequest = self.record.plan.generate.request(unit.seed);
        request.conditions = Members(roles.conditions.clone());
        match &roles.actor {
            Some(actor) => request.agents = Some(AgentChoice::Ids(vec![actor.clone()])),
            // All are generated, and nobody is left to react.
            None => request.react = ReactChoice::Whether(false),
        }
        let about = Subject::passing(Arc::clone(scene));
        let generation = self.operations.generate(&request, &about, Cancel::default())?;
        let answered = generation.answer()?;
        Ok((roles, answered))
    }

    /// Writes an answer into its row; gives the lines of a result that is kept.
    fn settled(&self, row: &mut BatchRow, roles: Roles, answered: &GenerationAnswer) -> Option<CaseLines> {
        let actor = roles.actor.as_deref();
        let score = answered.scores.as_ref().and_then(|scores| scores.first());
        let figures = score.map(|score| Figures::new(score, actor));
        let sample = answered.samples.first();
        let reacting = sample.map_or(0, |s| s.agents.values().filter(|f| f.reaction.is_some()).count());
        row.code = Some(answered.code.clone());
        row.goal = Some(tell::goal_word(actor.and_then(|id| answered.answer.resolved.get(id))).to_owned());
        row.reacting = Some(reacting as u64);
        row.actor = roles.actor.clone();
        if let Some(casting) = roles.casting {
            (row.other, row.what) = (casting.other, Some(casting.words));
        }
        let motion = self.happened(row, answered);
        row.figures = figures.as_ref().map(|figures| figures.all().clone()).unwrap_or_default();
        row.miss = self.filter.as_ref().zip(figures.as_ref()).map(|(filter, figures)| filter.miss(figures));
        if self.filter.is_some() && row.miss != Some(0.0) {
            row.outcome = UnitOutcome::LeftOut;
            return None;
        }
        row.outcome = UnitOutcome::Kept;
        let case = KeptCase::of(row, roles.conditions).line();
        Some(CaseLines { case, motion: motion.map_or_else(String::new, |motion| motion.line()) })
    }

    /// Writes what happens into a row, about the actor or about one of the pair with the least time to collision; gives
    /// the motion.
    fn happened(&self, row: &mut BatchRow, answered: &GenerationAnswer) -> Option<CaseMotion> {
        let hardest = || answered.scores.as_ref()?.first()?.scene.min_ttc_pair.as_ref().map(|pair| &pair[0]);
        let id = row.actor.as_ref().or_else(hardest)?;
        let drivable = self.operations.generator.maps().drivable(&answered.scene.map);
        let input = ScoreInput::of_sample(&answered.scene, answered.samples.first(), &drivable);
        let of = input.actors.iter().position(|actor| actor.id == id)?;
        let (facts, pair) = CaseFacts::of(&input, &MeetingSearch::new(&input), of)?;
        row.facts = facts;
        CaseMotion::of(&row.unit, &input, of, pair.as_ref())
    }
}
