//! Sums of measured values, in a fixed order.

use std::fmt;

/// Named sums over a number of records.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metrics {
    records: usize,
    sums: Vec<(&'static str, f64)>,
}

impl Metrics {
    /// Metrics of some records, without values yet.
    pub fn new(records: usize) -> Self {
        Self { records, sums: Vec::new() }
    }

    /// Adds one record's value.
    pub fn add(&mut self, name: &'static str, value: f32) {
        self.sum(name, f64::from(value));
    }

    fn sum(&mut self, name: &'static str, value: f64) {
        match self.sums.iter_mut().find(|(known, _)| *known == name) {
            Some((_, sum)) => *sum += value,
            None => self.sums.push((name, value)),
        }
    }

    /// Adds the metrics of other records.
    pub fn merge(&mut self, other: &Self) {
        self.records += other.records;
        for &(name, value) in &other.sums {
            self.sum(name, value);
        }
    }

    /// Number of records.
    pub fn records(&self) -> usize {
        self.records
    }

    /// Mean over the records; nothing if it was not measured.
    pub fn mean(&self, name: &str) -> Option<f64> {
        let (_, sum) = self.sums.iter().find(|(known, _)| *known == name)?;
        Some(sum / self.records.max(1) as f64)
    }

    /// All means.
    pub fn means(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        self.sums.iter().map(|&(name, sum)| (name, sum / self.records.max(1) as f64))
    }
}

impl fmt::Display for Metrics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (name, mean)) in self.means().enumerate() {
            write!(f, "{}{name} {mean:.4}", if index == 0 { "" } else { "  " })?;
        }
        Ok(())
    }
}
