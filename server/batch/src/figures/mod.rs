//! The figures of a score by name, for conditions and tables: numbers of the scene's score and counts of its lists,
//! under `actor.` those of the requested road user, and under `pair.` those of its pair with another one.

mod expression;
mod known;
mod tokens;

use crate::names::hint;
use expression::Expression;
pub use known::names;
use known::{OTHER_FIRST, lists_by_agent};
use scene::Scene;
use scene::score::meeting::{MeetingPair, MeetingSearch};
use scene::score::{Score, ScoreInput};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Prefix of the actor's figures.
const ACTOR: &str = "actor.";
/// Prefix of the figures of a pair.
const PAIR: &str = "pair.";
/// The figure that is not in the score.
const ROAD_USERS: &str = "road_users";

/// A condition on a score, as text and parsed.
#[derive(Clone, Debug)]
pub struct FigureFilter {
    text: String,
    expression: Arc<Expression>,
}

impl FigureFilter {
    /// Parses a condition.
    ///
    /// # Errors
    /// The fault with its column; for an unknown name, a list of all names.
    pub fn parse(text: &str) -> Result<Self, String> {
        let known = |name: &str| if names().iter().any(|n| n == name) { Ok(()) } else { Err(unknown(name)) };
        let expression = Expression::parse(text, &known).map_err(|wrong| wrong.to_string())?;
        Ok(Self { text: text.to_owned(), expression: Arc::new(expression) })
    }

    /// Its text as given.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The conditions that it joins by `&&`, in order; the whole condition if its outermost operator is `||`.
    pub fn parts(&self) -> Vec<Self> {
        let (mut depth, mut from, mut cuts) = (0usize, 0, Vec::new());
        let bytes = self.text.as_bytes();
        for (at, pair) in bytes.windows(2).enumerate() {
            match pair {
                [b'(', _] => depth += 1,
                [b')', _] => depth = depth.saturating_sub(1),
                b"||" if depth == 0 => return vec![self.clone()],
                b"&&" if depth == 0 => {
                    cuts.push(from..at);
                    from = at + 2;
                }
                _ => {}
            }
        }
        cuts.push(from..bytes.len());
        let part =
            |cut: std::ops::Range<usize>| self.text.get(cut).and_then(|text| Self::parse(text.trim()).ok());
        cuts.into_iter().map(part).collect::<Option<_>>().unwrap_or_else(|| vec![self.clone()])
    }

    /// Whether a score satisfies it.
    pub fn holds(&self, figures: &Figures) -> bool {
        self.expression.holds(&|name| figures.get(name))
    }

    /// Distance of a score from it; 0 if it holds.
    pub fn miss(&self, figures: &Figures) -> f64 {
        self.expression.miss(&|name| figures.get(name))
    }
}

fn unknown(name: &str) -> String {
    if name == "violations" {
        return "violations is kinematic.violations now".to_owned();
    }
    let meant = hint(name, names().iter().map(String::as_str));
    format!("no figure is named \"{name}\"{meant}; there are {}", names().join(", "))
}

/// The figures of one score.
pub struct Figures(BTreeMap<String, f64>);

impl Figures {
    /// The figures of a score, of one road user in it, and of its pair with another one.
    pub fn new(score: &Score, actor: Option<&str>, pair: Option<&MeetingPair>) -> Self {
        let mut all = BTreeMap::from([(ROAD_USERS.to_owned(), score.agents.len() as f64)]);
        let mut add = |prefix: &str, value: serde_json::Result<Value>| {
            // A score always has a JSON form.
            if let Ok(value) = value {
                flatten(prefix, &value, &mut all);
            }
        };
        let scene = serde_json::to_value(&score.scene).unwrap_or_default();
        if let Some((id, agent)) = actor.and_then(|id| Some((id, score.agents.get(id)?))) {
            add(ACTOR, serde_json::to_value(agent));
            let own = |list: &String| {
                let entries = scene[list].as_array()?.iter().filter(|entry| entry["agent"] == id);
                Some((list.clone(), Value::Array(entries.cloned().collect())))
            };
            add(ACTOR, Ok(Value::Object(lists_by_agent().iter().filter_map(own).collect())));
        }
        add("", Ok(scene));
        if let Some(pair) = pair {
            add(PAIR, serde_json::to_value(pair.measures));
            add(PAIR, Ok(serde_json::json!({ OTHER_FIRST: pair.other_first })));
        }
        Self(all)
    }

    /// The figures of a score and of the scored motions. The figures of a pair are those of the actor with `other`;
    /// without `other`, those of its hardest pair.
    pub fn of(score: &Score, input: &ScoreInput<'_>, actor: Option<&str>, other: Option<&str>) -> Self {
        let pair = actor.and_then(|id| MeetingSearch::new(input).of(id, other));
        Self::new(score, actor, pair.as_ref())
    }

    /// The figures of a row of a table.
    pub fn of_row(figures: BTreeMap<String, f64>) -> Self {
        Self(figures)
    }

    /// All figures by name.
    pub fn all(&self) -> &BTreeMap<String, f64> {
        &self.0
    }

    /// A figure; `None` if the scene lacks it.
    pub fn get(&self, name: &str) -> Option<f64> {
        self.0.get(name).copied()
    }
}

fn flatten(prefix: &str, value: &Value, out: &mut BTreeMap<String, f64>) {
    for (name, value) in value.as_object().into_iter().flatten() {
        let name = format!("{prefix}{name}");
        match value {
            // Events that are in the log too are listed, but not counted.
            Value::Array(list) => {
                let own = list.iter().filter(|entry| entry["in_log"] != true).count();
                out.insert(name, own as f64);
            }
            Value::Bool(is) => drop(out.insert(name, f64::from(u8::from(*is)))),
            Value::Number(number) => drop(number.as_f64().map(|n| out.insert(name, n))),
            Value::Object(_) => flatten(&format!("{name}."), value, out),
            Value::Null | Value::String(_) => {}
        }
    }
}

/// The road user for which the futures of a scene were requested, if it is a single one.
pub fn actor_of(scene: &Scene) -> Option<&str> {
    match scene.generated.as_ref()?.request["agents"].as_array()?.as_slice() {
        [Value::String(only)] => Some(only),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Scene;
    use scene::score::{Drivable, ScoreInput};

    #[test]
    fn figures_are_those_of_the_score() {
        let known = names();
        for name in [
            "min_ttc_s",
            "collisions",
            "goals_reached",
            "actor.min_ttc_s",
            "goal_error.position_m",
            "near_misses",
            "actor.red_lights",
            "pair.pet_s",
            "pair.other_first",
        ] {
            assert!(known.iter().any(|n| n == name), "{name}: {known:?}");
        }
        assert!(!known.iter().any(|n| n.contains("in_log") || n.ends_with('.')), "{known:?}");
        let empty = Scene::bare("none", scene::LaneMap::default(), Vec::new());
        let drivable = Drivable::new(&empty.map);
        let score = scene::score::score(&ScoreInput::of_scene(&empty, &drivable));
        let figures = Figures::new(&score, None, None);
        assert_eq!((figures.get("collisions"), figures.get("min_ttc_s")), (Some(0.0), None));
        // Every figure of a score can be used by its name.
        assert!(figures.0.keys().all(|name| known.contains(name)), "{:?}", figures.0.keys());
        assert!(FigureFilter::parse("min_ttc_s < 1.5 && collisions == 0").is_ok());
        assert!(FigureFilter::parse("collisions == 0").unwrap().holds(&figures));
    }

    #[test]
    fn a_condition_is_cut_where_all_of_it_must_hold() {
        let parts = |text: &str| {
            let parts = FigureFilter::parse(text).unwrap().parts();
            parts.iter().map(|part| part.text().to_owned()).collect::<Vec<_>>()
        };
        assert_eq!(parts("collisions == 0"), ["collisions == 0"]);
        assert_eq!(
            parts("min_ttc_s < 1 && (collisions == 0 && pet_s > 1 || overlaps > 0) &&!(pet_s < 2)"),
            ["min_ttc_s < 1", "(collisions == 0 && pet_s > 1 || overlaps > 0)", "!(pet_s < 2)"]
        );
        let either = "collisions == 0 && pet_s > 1 || overlaps > 0";
        assert_eq!(parts(either), [either]);
    }

    #[test]
    fn a_slip_is_named() {
        let wrong = FigureFilter::parse("min_tcc_s < 1").unwrap_err();
        assert!(
            wrong.starts_with(
                "column 1: no figure is named \"min_tcc_s\" (did you mean min_ttc_s?); there are"
            ),
            "{wrong}"
        );
        assert!(!FigureFilter::parse("something_else < 1").unwrap_err().contains("did you mean"));
    }
}
