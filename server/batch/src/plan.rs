//! The plan of a batch, as a user writes it.

use crate::draws;
use crate::fault::{PlanFault, document};
use crate::figures::FigureFilter;
use crate::map::BatchMap;
use crate::pattern::choice::PatternChoice;
use crate::pattern::document::RoadPattern;
use crate::pattern::search::PatternSearch;
use crate::sampling::{BatchSampling, SamplingMethod};
use crate::situation::BatchSituation;
use crate::who::{self, AgentSelector};
use api::GenerateRequest;
use api::generate::request::ReactChoice;
use formats::native::{self, MAX_SAFE_INTEGER};
use scene::Scene;
use scene::routes::LaneGraph;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::fmt;

/// Most seeds of a plan.
const MOST_SEEDS: u64 = 100_000;
/// Most situations of a plan.
const MOST_SITUATIONS: usize = 1_000;
/// Most units in a chunk.
const MOST_IN_CHUNK: u64 = 100_000;

/// Scenes x situations x draws x seeds, and a condition on the results to keep.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "DragTraffic batch plan")]
pub struct BatchPlan {
    /// Files, folders and patterns such as `logs/**/*.json`, in any format; relative to the folder of the plan.
    #[serde(default)]
    pub scenes: Vec<String>,
    /// Maps to fill with road users; their scenes follow those of the files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub maps: Vec<BatchMap>,
    /// Situations in each scene. Without one, all road users are generated freely.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub situations: Vec<BatchSituation>,
    /// A count (seeds from 0 on), or a list. Each draw is generated once per seed.
    #[serde(default)]
    pub seeds: BatchSeeds,
    /// Condition on the results to keep, such as `actor.min_ttc_s < 1.5 && collisions == 0`. A search looks for
    /// them.
    #[serde(rename = "where", default, skip_serializing_if = "Option::is_none")]
    pub filter: Option<String>,
    /// Method by which the numbers of a situation are chosen.
    #[serde(default)]
    pub sampling: BatchSampling,
    /// Options of every generation.
    #[serde(default)]
    pub generate: BatchOptions,
    /// Number of units per chunk, the part of the work that is written at once.
    #[serde(default = "chunk_units")]
    #[schemars(range(min = 1, max = 100000))]
    pub chunk_units: u64,
}

fn chunk_units() -> u64 {
    500
}

/// Seeds: a count, or a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum BatchSeeds {
    /// Number of seeds: 0, 1, 2, ...
    Count(u64),
    /// A list of seeds.
    List(Vec<u64>),
}

impl Default for BatchSeeds {
    fn default() -> Self {
        Self::Count(1)
    }
}

impl BatchSeeds {
    /// All of them.
    pub fn list(&self) -> Vec<u64> {
        match self {
            Self::Count(count) => (0..*count).collect(),
            Self::List(list) => list.clone(),
        }
    }
}

impl<'de> Deserialize<'de> for BatchSeeds {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct SeedsVisitor;
        impl<'de> Visitor<'de> for SeedsVisitor {
            type Value = BatchSeeds;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a count or a list of seeds")
            }

            fn visit_u64<E: Error>(self, count: u64) -> Result<BatchSeeds, E> {
                Ok(BatchSeeds::Count(count))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seeds: A) -> Result<BatchSeeds, A::Error> {
                let mut list = Vec::new();
                while let Some(seed) = seeds.next_element()? {
                    list.push(seed);
                }
                Ok(BatchSeeds::List(list))
            }
        }
        deserializer.deserialize_any(SeedsVisitor)
    }
}

impl JsonSchema for BatchSeeds {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "BatchSeeds".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let seed = json_schema!({"type": "integer", "minimum": 0, "maximum": MAX_SAFE_INTEGER});
        json_schema!({
            "anyOf": [
                {"type": "integer", "minimum": 1, "maximum": MOST_SEEDS},
                {"type": "array", "items": seed, "minItems": 1, "maxItems": MOST_SEEDS, "uniqueItems": true}
            ]
        })
    }
}

/// Options of every generation.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BatchOptions {
    /// Let the other road users react.
    pub react: bool,
    /// Scene time of the start, seconds.
    #[schemars(range(min = 0.0, max = 59.9))]
    pub start_s: f64,
    /// Time to generate, seconds.
    #[schemars(range(min = 0.5, max = 20.0))]
    pub horizon_s: f64,
    /// Replan interval, seconds: 3, 6 or 9.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replan_interval_s: Option<f64>,
    /// Number of futures planned for each road user.
    #[schemars(range(min = 1, max = 6))]
    pub modes: u64,
    /// Scale of the noise, which makes seeds differ.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub diversity: f64,
    /// Refinement steps.
    #[schemars(range(max = 100))]
    pub steps: u64,
}

impl Default for BatchOptions {
    fn default() -> Self {
        let GenerateRequest { start_s, horizon_s, replan_interval_s, modes, diversity, steps, .. } =
            GenerateRequest::default();
        Self { react: true, start_s, horizon_s, replan_interval_s, modes, diversity, steps }
    }
}

impl BatchOptions {
    /// Scene step of the start.
    pub fn start_step(&self) -> usize {
        self.request(0).start_step()
    }

    /// The request of one unit, without its conditions: one sample, scored.
    pub fn request(&self, seed: u64) -> GenerateRequest {
        let Self { react, start_s, horizon_s, replan_interval_s, modes, diversity, steps } = *self;
        GenerateRequest {
            react: ReactChoice::Whether(react),
            start_s,
            horizon_s,
            replan_interval_s,
            seed,
            samples: 1,
            modes,
            diversity,
            steps,
            score: true,
            ..GenerateRequest::default()
        }
    }
}

impl BatchPlan {
    /// Reads a plan from TOML.
    ///
    /// # Errors
    /// Its faults, each with its path; an unknown member has a suggestion.
    pub fn parse(text: &str) -> Result<Self, Vec<PlanFault>> {
        Self::parse_with(text, &|_| Err("a file is not read here".into()))
    }

    /// The same with pattern files, whose text `file` returns.
    ///
    /// # Errors
    /// Its faults and those of the patterns, each with its path.
    pub fn parse_with(
        text: &str,
        file: &dyn Fn(&str) -> Result<String, String>,
    ) -> Result<Self, Vec<PlanFault>> {
        let mut plan: Self = document(text)?;
        let mut faults = Vec::new();
        for (i, situation) in plan.situations.iter_mut().enumerate().take(MOST_SITUATIONS) {
            let Some(name) = situation.pattern.as_ref().and_then(PatternChoice::file) else { continue };
            let under = format!("situations[{i}].pattern");
            let of_file = |fault: PlanFault| PlanFault::new(&under, format!("{name}: {fault}"));
            let read = file(name).map_err(|reason| vec![PlanFault::new(&under, reason)]);
            match read.and_then(|text| {
                RoadPattern::parse(&text).map_err(|all| all.into_iter().map(of_file).collect())
            }) {
                Ok(pattern) => situation.pattern = Some(PatternChoice::Given(Box::new(pattern))),
                Err(all) => faults.extend(all),
            }
        }
        if faults.is_empty() { plan.checked() } else { Err(faults) }
    }

    /// Reads a plan from JSON, the form in which results store it.
    ///
    /// # Errors
    /// Its faults, each with its path.
    pub fn read(json: &[u8]) -> Result<Self, Vec<PlanFault>> {
        let plan: Self = native::from_json(json).map_err(PlanFault::of_read)?;
        plan.checked()
    }

    fn checked(mut self) -> Result<Self, Vec<PlanFault>> {
        if self.situations.is_empty() {
            self.situations.push(BatchSituation::default());
        }
        let faults = self.faults();
        if faults.is_empty() { Ok(self) } else { Err(faults) }
    }

    /// For each situation, the road users of a scene that get its conditions, or the places where its pattern
    /// fits; `None` for a situation that names none.
    pub fn actors(&self, scene: &Scene) -> Vec<Option<Vec<String>>> {
        let start_step = self.generate.start_step();
        let graph = OnceCell::new();
        let of = |situation: &BatchSituation| {
            if let Some(pattern) = situation.pattern() {
                let search =
                    PatternSearch::new(pattern, scene, graph.get_or_init(|| LaneGraph::new(&scene.map)));
                return Some(search.all().into_iter().map(|place| place.id).collect());
            }
            // The plan was checked when it was read.
            let selectors: Vec<AgentSelector> =
                situation.agents.iter().filter_map(|text| text.parse().ok()).collect();
            (!selectors.is_empty()).then(|| who::actors(&selectors, scene, start_step))
        };
        self.situations.iter().map(of).collect()
    }

    /// Faults of the plan.
    pub(crate) fn faults(&self) -> Vec<PlanFault> {
        let mut faults = Vec::new();
        let mut fault = |path: &str, detail: String| faults.push(PlanFault::new(path, detail));
        if self.scenes.is_empty() && self.maps.is_empty() {
            fault("scenes", "at least one file, folder or pattern expected, or maps".into());
        }
        let seeds = match &self.seeds {
            BatchSeeds::Count(count) => *count,
            BatchSeeds::List(list) => list.len() as u64,
        };
        if !(1..=MOST_SEEDS).contains(&seeds) {
            fault("seeds", format!("1 to {MOST_SEEDS} seeds expected"));
        } else {
            let list = self.seeds.list();
            if list.iter().any(|seed| *seed > MAX_SAFE_INTEGER) {
                fault("seeds", format!("a seed is at most {MAX_SAFE_INTEGER}"));
            }
            if list.iter().collect::<BTreeSet<_>>().len() < list.len() {
                fault("seeds", "a seed is given twice".into());
            }
        }
        if self.sampling.method == SamplingMethod::Search && self.filter.is_none() {
            fault("where", "a search needs a condition that it looks for".into());
        }
        if let Some(Err(reason)) = self.filter.as_deref().map(FigureFilter::parse) {
            fault("where", reason);
        }
        if !(1..=MOST_IN_CHUNK).contains(&self.chunk_units) {
            fault("chunk_units", format!("1 to {MOST_IN_CHUNK} expected"));
        }
        if self.situations.len() > MOST_SITUATIONS {
            fault("situations", format!("at most {MOST_SITUATIONS} expected"));
        }
        if !(0.0..=59.9).contains(&self.generate.start_s) {
            fault("generate.start_s", format!("{} is outside 0 to 59.9", self.generate.start_s));
        }
        self.sampling.check(&mut faults);
        if let Err(problem) = self.generate.request(0).check_ranges() {
            faults.extend(PlanFault::of_problem("generate", &problem));
        }
        let mut labels = BTreeSet::new();
        for (i, map) in self.maps.iter().enumerate() {
            let path = format!("maps[{i}]");
            map.check(&path, &mut faults);
            // File names are not known here.
            let label = map.label("");
            if !label.is_empty() && !labels.insert(label) {
                let detail = format!("another map is called {label}; give each a name");
                faults.push(PlanFault::new(format!("{path}.name"), detail));
            }
        }
        let mut names = BTreeSet::new();
        for (i, situation) in self.situations.iter().enumerate().take(MOST_SITUATIONS) {
            let path = format!("situations[{i}]");
            situation.check(&path, &mut faults);
            if !names.insert(situation.name()) {
                let detail = format!("another situation is called {}; give each a name", situation.name());
                faults.push(PlanFault::new(format!("{path}.name"), detail));
            }
            draws::check(situation, &self.sampling, &path, &mut faults);
        }
        faults
    }
}

/// JSON Schema (2020-12) of a plan.
pub fn schema() -> Schema {
    schemars::generate::SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<BatchPlan>()
}

#[cfg(test)]
mod tests {
    use super::BatchPlan;

    fn faults(text: &str) -> Vec<String> {
        let plan = format!("scenes = ['a.json']\n{text}");
        BatchPlan::parse(&plan).unwrap_err().iter().map(ToString::to_string).collect()
    }

    fn fault(text: &str) -> String {
        let all = faults(text);
        assert_eq!(all.len(), 1, "{all:?}");
        all[0].clone()
    }

    #[test]
    fn a_plan_says_all_of_it_and_has_a_form_that_is_read_again() {
        let text = r#"
            scenes = ["logs/", "more/*.json"]
            seeds = [3, 5]
            where = "collisions == 0"
            chunk_units = 20
            [sampling]
            method = "random"
            draws = 4
            seed = 9
            [generate]
            horizon_s = 6
            [[situations]]
            template = "cut-in"
            parameters = { gap_m = { uniform = [2, 4] } }
            [[situations]]
            name = "faster"
            agents = ["@vehicles"]
            goal = { ahead_m = { choice = [20, 40] }, speed_mps = 12 }
        "#;
        let plan = BatchPlan::parse(text).unwrap();
        assert_eq!(plan.seeds.list(), [3, 5]);
        assert_eq!(plan.situations[1].dimensions().len(), 2);
        assert_eq!(BatchPlan::read(&serde_json::to_vec(&plan).unwrap()).unwrap(), plan);
        assert_eq!(BatchPlan::parse("scenes = ['a']").unwrap().situations[0].name(), "free");
    }

    #[test]
    fn faults_have_a_path_and_slips_a_hint() {
        assert!(
            fault("sede = 1").starts_with("sede: unknown field `sede`")
                && fault("sede = 1").contains("mean seeds?")
        );
        let deep = fault("[[situations]]\nagents = ['6']\ngoal = { sped_mps = 4 }");
        assert!(
            deep.starts_with("situations[0].goal.sped_mps: ") && deep.contains("mean speed_mps?"),
            "{deep}"
        );
        let kind = fault("[[situations]]\ntemplate = 'cutin'");
        assert!(kind.starts_with("situations[0].template: ") && kind.contains("mean cut-in?"), "{kind}");
        let figure = fault("[[situations]]\ntemplate = 'cut-in'\nparameters = { gap = 3 }");
        assert!(figure.contains("parameters.gap: ") && figure.contains("mean gap_m?"), "{figure}");
        assert!(fault("seeds = 'x'").contains("a count or a list of seeds"));
        assert!(fault("[generate]\nhorizon_s = 90").starts_with("generate.horizon_s: "));
        assert!(fault("seeds = [1, 1]").contains("given twice"));
        assert!(fault("seeds = 0").contains("1 to 100000 seeds"));
        assert!(fault("[sampling]\nmethod = 'search'").starts_with("where: a search needs"));
        assert!(fault("x = [").contains("line"));
        let speed = fault(
            "[[situations]]\nagents = ['6']\ngoal = { speed_mps = { uniform = [5, 200], points = 3 } }",
        );
        assert_eq!(speed, "situations[0].goal.speed_mps: 200 is outside 0 to 60");
        assert!(
            fault("[[situations]]\ngoal = { speed_mps = 4 }").starts_with("situations[0].agents: who gets")
        );
        let points = fault("[[situations]]\nagents = ['6']\ngoal = { speed_mps = { uniform = [5, 9] } }");
        assert!(
            points.starts_with("situations[0].goal.speed_mps: ") && points.contains("points"),
            "{points}"
        );
        assert!(
            fault("[[situations]]\ntemplate = 'brake'\n[[situations]]\ntemplate = 'brake'")
                .contains("give each a name")
        );
        assert_eq!(faults("chunk_units = 0\nseeds = 0").len(), 2);
    }
}
