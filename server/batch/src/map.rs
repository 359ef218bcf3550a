//! Scenes of a plan that are built from maps with placed road users.

use crate::fault::PlanFault;
use crate::names::hint;
use crate::situation::schema_range;
use api::map::{MapBody, TemplateItem, TemplateList};
use api::place::PlaceBody;
use api::place::request::{DensityDoc, ParkedDoc};
use formats::native::MAX_SAFE_INTEGER;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::sync::LazyLock;

/// Most scenes of one map.
const MOST_SCENES: u64 = 100_000;

/// Maps that are filled with road users, each a number of times.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BatchMap {
    /// Prefix of the scene names. Default: the name of the template or of the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Files, folders and patterns, relative to the folder of the plan. Their road users are removed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<String>,
    /// Template of maps, in place of files. `dragtraffic map --list` prints them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "template_names")]
    pub template: Option<String>,
    /// Parameters of the template, by name.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub parameters: Map<String, Value>,
    /// Road users per kilometre of lane; 12 without `count`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 200.0))]
    pub per_lane_km: Option<f64>,
    /// Total number of road users.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 256))]
    pub count: Option<u64>,
    /// Share of the parking places that are occupied.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1.0))]
    pub parked_share: Option<f64>,
    /// Number of scenes per map.
    #[schemars(range(min = 1, max = 100000))]
    pub scenes: u64,
    /// Seed of the first scene; each scene has the next one.
    #[schemars(range(max = 9007199254740991u64))]
    pub seed: u64,
}

impl Default for BatchMap {
    fn default() -> Self {
        Self {
            name: None,
            files: Vec::new(),
            template: None,
            parameters: Map::new(),
            per_lane_km: None,
            count: None,
            parked_share: None,
            scenes: 1,
            seed: 0,
        }
    }
}

impl BatchMap {
    /// The map of the template; `None` for maps from files.
    pub fn drawn(&self) -> Option<MapBody> {
        let template = self.template.as_ref()?;
        let body = json!({ "template": template, "parameters": self.parameters, "name": self.name });
        serde_json::from_value(body).ok()
    }

    /// Prefix of its scenes' names; `of` is the name of the file.
    pub fn label<'a>(&'a self, of: &'a str) -> &'a str {
        self.name.as_deref().or(self.template.as_deref()).unwrap_or(of)
    }

    /// The placement of one of its scenes, from the start of the generations on.
    pub fn filling(&self, scene: u64, start_s: f64) -> PlaceBody {
        let density = DensityDoc { per_lane_km: self.per_lane_km, count: self.count };
        PlaceBody {
            density: (self.per_lane_km.is_some() || self.count.is_some()).then_some(density),
            parked: self.parked_share.map(|share| ParkedDoc { share: Some(share), per_100m: None }),
            seed: self.seed + scene,
            start_s,
            ..PlaceBody::default()
        }
    }

    /// Checks the map; `path` is its path in the plan.
    pub(crate) fn check(&self, path: &str, faults: &mut Vec<PlanFault>) {
        static DENSITY: LazyLock<Schema> = LazyLock::new(|| schemars::schema_for!(DensityDoc));
        static PARKED: LazyLock<Schema> = LazyLock::new(|| schemars::schema_for!(ParkedDoc));
        let mut fault = |member: &str, detail: String| {
            faults.push(PlanFault::new(format!("{path}.{member}"), detail));
        };
        let mut inside = |member: &str, value: Option<f64>, (least, most): (f64, f64)| {
            if let Some(value) = value.filter(|value| !(least..=most).contains(value)) {
                fault(member, format!("{value} is outside {least} to {most}"));
            }
        };
        inside("per_lane_km", self.per_lane_km, schema_range(&DENSITY, "per_lane_km"));
        inside("count", self.count.map(|count| count as f64), schema_range(&DENSITY, "count"));
        inside("parked_share", self.parked_share, schema_range(&PARKED, "share"));
        inside("scenes", Some(self.scenes as f64), (1.0, MOST_SCENES as f64));
        if self.seed > MAX_SAFE_INTEGER - MOST_SCENES {
            fault("seed", format!("at most {} expected", MAX_SAFE_INTEGER - MOST_SCENES));
        }
        if self.per_lane_km.is_some() && self.count.is_some() {
            fault("count", "per_lane_km and count exclude each other".into());
        }
        match (&self.template, self.files.is_empty()) {
            (None, true) => fault("files", "files or a template expected".into()),
            (Some(_), false) => fault("files", "files and template exclude each other".into()),
            (None, false) if !self.parameters.is_empty() => {
                fault("parameters", "parameters belong to a template".into());
            }
            (None, false) => {}
            (Some(template), true) => match self.drawn().map(MapBody::draw) {
                Some(Ok(_)) => {}
                Some(Err(problem)) => faults.extend(PlanFault::of_problem(path, &problem)),
                None => {
                    let known: Vec<String> = templates();
                    let names = known.iter().map(String::as_str);
                    let detail = format!(
                        "\"{template}\" is unknown{}; there are {}",
                        hint(template, names),
                        known.join(", ")
                    );
                    fault("template", detail);
                }
            },
        }
    }
}

fn template_names(_: &mut SchemaGenerator) -> Schema {
    json_schema!({"type": ["string", "null"], "enum": templates()})
}

/// Names of the templates of maps.
fn templates() -> Vec<String> {
    let name = |item: &TemplateItem| item.layout["template"].as_str().map(str::to_owned);
    TemplateList::current().templates.iter().filter_map(name).collect()
}

#[cfg(test)]
mod tests {
    use crate::plan::BatchPlan;

    fn faults(map: &str) -> Vec<String> {
        let plan = BatchPlan::parse(&format!("[[maps]]\n{map}"));
        plan.unwrap_err().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_map_is_drawn_and_filled_by_its_seeds() {
        let text =
            "[[maps]]\ntemplate = 'four-arms'\nparameters = { kerb_radius_m = 8 }\ncount = 9\nseed = 4";
        let plan = BatchPlan::parse(text).unwrap();
        let map = &plan.maps[0];
        assert_eq!((map.label("a"), map.scenes), ("four-arms", 1));
        let (_, scene, _) = map.drawn().unwrap().draw().unwrap();
        assert!(scene.agents.is_empty() && !scene.map.lanes.is_empty());
        let filling = map.filling(2, 1.5);
        assert_eq!((filling.seed, filling.start_s, filling.density.unwrap().count), (6, 1.5, Some(9)));
        assert!(map.filling(0, 0.0).parked.is_none());
    }

    #[test]
    fn faults_have_their_place() {
        for (map, expected) in [
            ("", "maps[0].files: files or a template expected"),
            ("template = 'for-arms'", "maps[0].template: \"for-arms\" is unknown (did you mean four-arms?)"),
            ("template = 'curve'\nfiles = ['a']", "maps[0].files: files and template exclude"),
            ("files = ['a']\nparameters = { radius_m = 4 }", "maps[0].parameters: parameters belong"),
            (
                "template = 'four-arms'\nparameters = { kerb_radius_m = 1e9 }",
                "maps[0].parameters.kerb_radius_m: ",
            ),
            ("template = 'four-arms'\ncount = 0", "maps[0].count: 0 is outside 1 to 256"),
            ("template = 'four-arms'\ncount = 3\nper_lane_km = 4", "maps[0].count: per_lane_km and count"),
            ("template = 'four-arms'\nper_lane_km = 900", "maps[0].per_lane_km: 900 is outside 0 to 200"),
            ("template = 'four-arms'\nscenes = 0", "maps[0].scenes: 0 is outside 1 to 100000"),
            ("template = 'four-arms'\nnumber = 0", "maps[0].number: unknown field `number`"),
        ] {
            let all = faults(map);
            assert!(all.len() == 1 && all[0].starts_with(expected), "{map}: {all:?}");
        }
        assert!(BatchPlan::parse("seeds = 1").unwrap_err()[0].to_string().starts_with("scenes: "));
        let twice = "template = 'curve'\n[[maps]]\ntemplate = 'curve'";
        assert!(
            faults(twice)[0].starts_with("maps[1].name: another map is called curve"),
            "{:?}",
            faults(twice)
        );
    }
}
