//! Output of a batch for each unit: a row of a table, and a line for each kept result.

use crate::case::facts::CaseFacts;
use crate::catalogue::UnitProblem;
use formats::ReadError;
use formats::columnar::{self, Column, ColumnValue, ColumnValues, ParquetTable};
use formats::native::ConditionsDoc;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;

/// Outcome of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum UnitOutcome {
    /// Its result satisfies the condition, or there is none.
    Kept,
    /// Its result does not satisfy the condition.
    LeftOut,
    /// No road user of the scene fits the situation.
    NobodyFits,
    /// It has no result; the row has the problem.
    Failed,
}

impl UnitOutcome {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Kept, Self::LeftOut, Self::NobodyFits, Self::Failed];

    /// Name of the outcome in the tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kept => "kept",
            Self::LeftOut => "left-out",
            Self::NobodyFits => "nobody-fits",
            Self::Failed => "failed",
        }
    }
}

/// One unit in the table of its chunk.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchRow {
    /// Id of the unit, 64 hex digits.
    pub unit: String,
    /// Hash of the scene, 64 hex digits.
    pub scene: String,
    /// Name of the scene.
    pub name: String,
    /// Name of the situation.
    pub situation: String,
    /// The road user that gets the conditions, if it is a single one.
    pub actor: Option<String>,
    /// The road user that the situation affects.
    pub other: Option<String>,
    /// Number of the draw.
    pub draw: u64,
    /// Drawn numbers by path.
    pub drawn: BTreeMap<String, f64>,
    /// Seed of the generation.
    pub seed: u64,
    /// Outcome.
    pub outcome: UnitOutcome,
    /// Why it failed.
    pub problem: Option<UnitProblem>,
    /// Result code, six characters.
    pub code: Option<String>,
    /// Whether the goal of the actor is met: met, missed, none.
    pub goal: Option<String>,
    /// Number of road users that react.
    pub reacting: Option<u64>,
    /// What the actor does, in one sentence.
    pub what: Option<String>,
    /// Distance of the result from the condition of the plan; 0 if it holds.
    pub miss: Option<f64>,
    /// Figures of the score by name.
    pub figures: BTreeMap<String, f64>,
    /// Facts of the result; empty without one.
    pub facts: CaseFacts,
}

/// A kept result by reference: the inputs that reproduce it, and its figures.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct KeptCase {
    /// Id of the unit.
    pub unit: String,
    /// Result code, six characters.
    pub code: String,
    /// Hash of the scene.
    pub scene: String,
    /// Name of the scene.
    pub name: String,
    /// Name of the situation.
    pub situation: String,
    /// The road user that gets the conditions, if it is a single one.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub actor: Option<String>,
    /// The road user that the situation affects.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub other: Option<String>,
    /// What the actor does, in one sentence.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub what: Option<String>,
    /// Conditions of the request, by road user.
    pub conditions: BTreeMap<String, ConditionsDoc>,
    /// Drawn numbers by path.
    #[serde(skip_serializing_if = "BTreeMap::is_empty", default)]
    pub drawn: BTreeMap<String, f64>,
    /// Number of the draw.
    pub draw: u64,
    /// Seed of the generation.
    pub seed: u64,
    /// Figures of the score by name.
    pub figures: BTreeMap<String, f64>,
}

impl KeptCase {
    /// The kept case of a row.
    pub fn of(row: &BatchRow, conditions: BTreeMap<String, ConditionsDoc>) -> Self {
        Self {
            unit: row.unit.clone(),
            code: row.code.clone().unwrap_or_default(),
            scene: row.scene.clone(),
            name: row.name.clone(),
            situation: row.situation.clone(),
            actor: row.actor.clone(),
            other: row.other.clone(),
            what: row.what.clone(),
            conditions,
            drawn: row.drawn.clone(),
            draw: row.draw,
            seed: row.seed,
            figures: row.figures.clone(),
        }
    }

    /// Its JSON line, with the newline.
    pub fn line(&self) -> String {
        // The document has string keys and plain values, which serde_json always writes.
        serde_json::to_string(self).unwrap_or_default() + "\n"
    }
}

/// Rows as Parquet: the columns of [`BatchRow`], one for each fact, and one for each figure. Equal rows give equal bytes.
///
/// # Errors
/// None is expected.
pub fn table(rows: &[BatchRow], figures: &'static [String]) -> io::Result<Vec<u8>> {
    columnar::write([columns(rows, figures)], Vec::new())
}

/// Kept cases as Parquet, one row group after the other. The columns are those of [`table`], and the code of
/// the case of which each is a near copy, from the second list of a group.
///
/// # Errors
/// None is expected.
pub fn case_table(
    groups: impl IntoIterator<Item = (Vec<BatchRow>, Vec<Option<String>>)>,
    figures: &'static [String],
) -> io::Result<Vec<u8>> {
    let groups = groups.into_iter().map(|(rows, copies)| {
        let mut columns = columns(&rows, figures);
        columns.push(column("copy_of", false, ColumnValues::Text(copies)));
        columns
    });
    columnar::write(groups, Vec::new())
}

fn columns(rows: &[BatchRow], figures: &'static [String]) -> Vec<Column> {
    let text = |value: fn(&BatchRow) -> Option<String>| ColumnValues::Text(rows.iter().map(value).collect());
    let whole = |value: fn(&BatchRow) -> Option<u64>| {
        ColumnValues::Whole(rows.iter().map(|row| value(row).and_then(|n| i64::try_from(n).ok())).collect())
    };
    let drawn = |row: &BatchRow| serde_json::to_string(&row.drawn).ok();
    let mut columns = vec![
        column("unit", true, text(|row| Some(row.unit.clone()))),
        column("scene", true, text(|row| Some(row.scene.clone()))),
        column("name", true, text(|row| Some(row.name.clone()))),
        column("situation", true, text(|row| Some(row.situation.clone()))),
        column("actor", false, text(|row| row.actor.clone())),
        column("other", false, text(|row| row.other.clone())),
        column("draw", true, whole(|row| Some(row.draw))),
        column("drawn", true, text(drawn)),
        column("seed", true, whole(|row| Some(row.seed))),
        column("outcome", true, text(|row| Some(row.outcome.name().to_owned()))),
        column("problem", false, text(|row| row.problem.as_ref().map(|problem| problem.code.clone()))),
        column("detail", false, text(|row| row.problem.as_ref().map(|problem| problem.detail.clone()))),
        column("code", false, text(|row| row.code.clone())),
        column("goal", false, text(|row| row.goal.clone())),
        column("reacting", false, whole(|row| row.reacting)),
        column("what", false, text(|row| row.what.clone())),
        column("miss", false, ColumnValues::Number(rows.iter().map(|row| row.miss).collect())),
    ];
    columns.extend(CaseFacts::table(rows.iter().map(|row| &row.facts)));
    columns.extend(figures.iter().map(|name| {
        let values = rows.iter().map(|row| row.figures.get(name).copied()).collect();
        column(name, false, ColumnValues::Number(values))
    }));
    columns
}

fn column(name: &'static str, required: bool, values: ColumnValues) -> Column {
    Column { name, required, values }
}

/// Rows of a table, each with its values by column.
///
/// # Errors
/// `malformed-file` and the like.
pub fn read(bytes: &Vec<u8>) -> Result<Vec<BatchRow>, ReadError> {
    let mut table = ParquetTable::open(bytes)?;
    let names = table.names().to_vec();
    table.choose((0..names.len()).collect())?;
    let mut rows = Vec::new();
    while table.advance()? {
        let (mut texts, mut wholes, mut figures) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        let mut facts = CaseFacts::default();
        for (i, name) in names.iter().enumerate() {
            match table.value(i) {
                value if facts.read(name, &value) => {}
                ColumnValue::Text(text) => drop(texts.insert(name.as_str(), text.to_owned())),
                ColumnValue::Whole(whole) => drop(wholes.insert(name.as_str(), whole.max(0) as u64)),
                ColumnValue::Number(number) => drop(figures.insert(name.clone(), number)),
                ColumnValue::Flag(_) | ColumnValue::Nothing => {}
            }
        }
        let mut text = |name: &str| texts.remove(name);
        let outcome = text("outcome").unwrap_or_default();
        let outcome = UnitOutcome::ALL.into_iter().find(|known| known.name() == outcome);
        let detail = text("detail").unwrap_or_default();
        rows.push(BatchRow {
            unit: text("unit").unwrap_or_default(),
            scene: text("scene").unwrap_or_default(),
            name: text("name").unwrap_or_default(),
            situation: text("situation").unwrap_or_default(),
            actor: text("actor"),
            other: text("other"),
            draw: wholes.get("draw").copied().unwrap_or_default(),
            drawn: serde_json::from_str(&text("drawn").unwrap_or_default()).unwrap_or_default(),
            seed: wholes.get("seed").copied().unwrap_or_default(),
            outcome: outcome.unwrap_or(UnitOutcome::Failed),
            problem: text("problem").map(|code| UnitProblem { code, detail }),
            code: text("code"),
            goal: text("goal"),
            reacting: wholes.get("reacting").copied(),
            what: text("what"),
            miss: figures.remove("miss"),
            figures,
            facts,
        });
    }
    Ok(rows)
}

/// Identifiers of a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowName {
    /// Id of the unit.
    pub unit: String,
    /// Code of its result, if it has one.
    pub code: Option<String>,
    /// Whether the result is kept.
    pub is_kept: bool,
}

/// Reads only the identifiers of the rows of a table.
///
/// # Errors
/// `malformed-file` and the like.
pub fn names(bytes: &Vec<u8>) -> Result<Vec<RowName>, ReadError> {
    let mut table = ParquetTable::open(bytes)?;
    let columns: Vec<Option<usize>> = ["unit", "code", "outcome"]
        .map(|wanted| table.names().iter().position(|name| name == wanted))
        .into_iter()
        .collect();
    table.choose(columns.iter().flatten().copied().collect())?;
    let mut names = Vec::new();
    while table.advance()? {
        let mut at = 0;
        let mut texts = columns.iter().map(|column| {
            let value = column.map(|_| table.value(at))?;
            at += 1;
            if let ColumnValue::Text(text) = value { Some(text.to_owned()) } else { None }
        });
        let (unit, code) = (texts.next().flatten().unwrap_or_default(), texts.next().flatten());
        let is_kept = texts.next().flatten().as_deref() == Some(UnitOutcome::Kept.name());
        names.push(RowName { unit, code, is_kept });
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::{BatchRow, CaseFacts, KeptCase, RowName, UnitOutcome, names, read, table};
    use crate::catalogue::UnitProblem;
    use std::collections::BTreeMap;

    fn row(unit: &str) -> BatchRow {
        BatchRow {
            unit: unit.into(),
            scene: "s".into(),
            name: "crossing".into(),
            situation: "fast".into(),
            actor: Some("6".into()),
            other: None,
            draw: 2,
            drawn: BTreeMap::from([("goal.speed_mps".into(), 0.1 + 0.2)]),
            seed: 9,
            outcome: UnitOutcome::Kept,
            problem: None,
            code: Some("ABC123".into()),
            goal: Some("met".into()),
            reacting: Some(0),
            what: None,
            miss: Some(0.0),
            figures: BTreeMap::from([("actor.min_ttc_s".into(), 1.0 / 3.0), ("collisions".into(), 0.0)]),
            facts: CaseFacts {
                words: BTreeMap::from([("layout", "junction".to_owned())]),
                numbers: BTreeMap::from([("gap_m", 0.1), ("x_m", -3.0)]),
            },
        }
    }

    #[test]
    fn rows_come_back_from_the_table_bit_for_bit() {
        let figures: &'static [String] =
            Box::leak(Box::new(["actor.min_ttc_s".to_owned(), "collisions".to_owned()]));
        let problem = UnitProblem { code: "malformed-json".into(), detail: "line 1".into() };
        let failed = BatchRow {
            outcome: UnitOutcome::Failed,
            problem: Some(problem),
            actor: None,
            code: None,
            goal: None,
            reacting: None,
            miss: None,
            figures: BTreeMap::new(),
            facts: CaseFacts::default(),
            ..row("b")
        };
        let rows = [row("a"), failed];
        let bytes = table(&rows, figures).unwrap();
        assert_eq!(read(&bytes).unwrap(), rows);
        assert_eq!(table(&rows, figures).unwrap(), bytes, "equal rows, equal bytes");
        let name = |unit: &str, code: Option<&str>, is_kept| RowName {
            unit: unit.into(),
            code: code.map(str::to_owned),
            is_kept,
        };
        assert_eq!(names(&bytes).unwrap(), [name("a", Some("ABC123"), true), name("b", None, false)]);
        assert!(read(&bytes[..bytes.len() / 2].to_vec()).is_err());
    }

    #[test]
    fn a_kept_result_is_a_short_line_that_is_read_again() {
        let line = KeptCase::of(&row("a"), BTreeMap::new()).line();
        assert!(line.len() < 1_000 && line.ends_with("}\n"), "{line}");
        assert_eq!(serde_json::from_str::<KeptCase>(&line).unwrap().line(), line);
    }
}
