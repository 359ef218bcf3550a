//! Tables of figures, as Markdown and JSON.

use super::stats::Estimate;
use serde::Serialize;
use std::fmt::Write as _;

/// Number format of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// With two decimals.
    Plain,
    /// With three decimals.
    Fine,
    /// In percent.
    Percent,
    /// With its sign: differences.
    Signed,
    /// With three decimals and its sign.
    SignedFine,
    /// In percent with its sign: differences of shares, in percentage points.
    SignedPercent,
}

impl Form {
    fn write(self, x: f64) -> String {
        match self {
            Self::Plain => format!("{x:.2}"),
            Self::Fine => format!("{x:.3}"),
            Self::Percent => format!("{:.1} %", 100.0 * x),
            Self::Signed => format!("{x:+.2}"),
            Self::SignedFine => format!("{x:+.3}"),
            Self::SignedPercent => format!("{:+.1} %", 100.0 * x),
        }
    }
}

/// One entry of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// A figure with its interval.
    Estimate {
        /// Estimate.
        #[serde(flatten)]
        estimate: Estimate,
        /// Number format.
        form: Form,
    },
    /// A count.
    Count(u64),
    /// A number without an interval: a quantile, a maximum.
    Number {
        /// Value.
        value: f64,
        /// Number format.
        form: Form,
    },
    /// Words.
    Text(String),
    /// Nothing was measured.
    Nothing,
}

impl Cell {
    /// A figure, or nothing.
    pub fn of(estimate: Option<Estimate>, form: Form) -> Self {
        estimate.map_or(Self::Nothing, |estimate| Self::Estimate { estimate, form })
    }

    fn markdown(&self, row_samples: u64) -> String {
        match self {
            Self::Estimate { estimate: e, form } => {
                let (low, high) = (form.write(e.low), form.write(e.high));
                let low = low.trim_end_matches(" %");
                let own =
                    if e.samples == row_samples { String::new() } else { format!(" (n {})", e.samples) };
                format!("{} [{low}, {high}]{own}", form.write(e.mean))
            }
            Self::Count(n) => n.to_string(),
            Self::Number { value, form } => form.write(*value),
            Self::Text(text) => text.clone(),
            Self::Nothing => "-".into(),
        }
    }
}

/// One line of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SheetRow {
    /// Keys of the row, one for each of [`Sheet::keys`].
    pub keys: Vec<String>,
    /// One entry for each of [`Sheet::columns`].
    pub cells: Vec<Cell>,
}

/// One table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sheet {
    /// Heading.
    pub title: String,
    /// Sentences under the heading: protocol, units.
    pub notes: Vec<String>,
    /// Names of the columns with a row's keys.
    pub keys: Vec<String>,
    /// Names of the columns of figures, with units.
    pub columns: Vec<String>,
    /// Body.
    pub lines: Vec<SheetRow>,
}

impl Sheet {
    /// An empty table.
    pub fn new(title: &str, notes: &[&str], keys: &[&str], columns: &[&str]) -> Self {
        let owned = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect();
        Self {
            title: title.into(),
            notes: owned(notes),
            keys: owned(keys),
            columns: owned(columns),
            lines: Vec::new(),
        }
    }

    /// Adds a line.
    pub fn push<S: Into<String>>(&mut self, keys: impl IntoIterator<Item = S>, cells: Vec<Cell>) {
        self.lines.push(SheetRow { keys: keys.into_iter().map(Into::into).collect(), cells });
    }

    /// As Markdown, with a column of sample counts where the figures have them.
    pub fn markdown(&self) -> String {
        let mut out = format!("### {}\n\n", self.title);
        for note in &self.notes {
            let _ = writeln!(out, "{note}\n");
        }
        let counted = self.lines.iter().any(|l| samples(l) > 0);
        let n = counted.then(|| "n".to_owned());
        let head: Vec<String> = self.keys.iter().cloned().chain(n).chain(self.columns.clone()).collect();
        let _ = writeln!(out, "| {} |\n|{}", head.join(" | "), "---|".repeat(head.len()));
        for line in &self.lines {
            let own = samples(line);
            let n = counted.then(|| if own > 0 { own.to_string() } else { "-".into() });
            let cells = line.cells.iter().map(|c| c.markdown(own));
            let all: Vec<String> = line.keys.iter().cloned().chain(n).chain(cells).collect();
            let _ = writeln!(out, "| {} |", all.join(" | "));
        }
        out.push('\n');
        out
    }
}

/// Sample count of a line's first figure; other figures state theirs if it differs.
fn samples(line: &SheetRow) -> u64 {
    let of = |cell: &Cell| match cell {
        Cell::Estimate { estimate, .. } => Some(estimate.samples),
        _ => None,
    };
    line.cells.iter().find_map(of).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markdown_says_mean_interval_and_counts() {
        let mut sheet = Sheet::new("T", &["Note."], &["type"], &["ADE, m", "met", "most"]);
        let estimate = |samples| Estimate { mean: 0.5, low: 0.25, high: 0.75, samples, scenes: 2 };
        sheet.push(
            ["vehicle"],
            vec![
                Cell::of(Some(estimate(9)), Form::Plain),
                Cell::of(Some(estimate(4)), Form::Percent),
                Cell::of(None, Form::Plain),
            ],
        );
        let expected = "### T\n\nNote.\n\n| type | n | ADE, m | met | most |\n|---|---|---|---|---|\n\
                        | vehicle | 9 | 0.50 [0.25, 0.75] | 50.0 % [25.0, 75.0 %] (n 4) | - |\n\n";
        assert_eq!(sheet.markdown(), expected);
    }
}
