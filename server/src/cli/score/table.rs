//! Scores as a table: one line per sample, one column per figure.

use super::figures::{Figures, names};
use crate::cli::inputs::Item;
use crate::cli::{Exit, Failure};

/// A table as comma-separated values.
pub struct Table(csv::Writer<Vec<u8>>);

impl Table {
    /// A table with the standard heading.
    pub fn new() -> Self {
        let mut table = Self::bare();
        let heading =
            ["file", "scene", "sample", "actor"].into_iter().chain(names().iter().map(String::as_str));
        table.add(&heading.map(str::to_owned).collect::<Vec<_>>());
        table
    }

    /// A table without a heading.
    pub fn bare() -> Self {
        Self(csv::Writer::from_writer(Vec::new()))
    }

    /// Adds a line.
    pub fn add(&mut self, row: &[String]) {
        let is_number = |text: &str| text.parse::<f64>().is_ok();
        let cell = |text: &String| {
            if is_number(text) { text.clone() } else { formats::table::cell(text).into_owned() }
        };
        // All lines have the same length, and writing to a vector cannot fail.
        let _ = self.0.write_record(row.iter().map(cell));
    }

    /// The file.
    ///
    /// # Errors
    /// None in practice: writing to a vector cannot fail.
    pub fn bytes(self) -> Result<Vec<u8>, Failure> {
        self.0.into_inner().map_err(|error| Failure::new(Exit::Failure, error.to_string()))
    }
}

/// A line of the table.
pub fn row(file: &str, item: &Item, sample: Option<usize>, figures: &Figures) -> Vec<String> {
    let actor = super::figures::actor_of(&item.scene).unwrap_or_default();
    let sample = sample.map_or_else(String::new, |sample| sample.to_string());
    let cells = names().iter().map(|name| figures.get(name).map_or_else(String::new, figure));
    [file.to_owned(), item.name.clone(), sample, actor.to_owned()].into_iter().chain(cells).collect()
}

/// A figure with at most six decimals, without trailing zeros.
pub fn figure(value: f64) -> String {
    let text = format!("{value:.6}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.to_owned() }
}
