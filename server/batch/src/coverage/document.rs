//! `coverage.json`, and the table that a terminal shows.

use super::count::{BucketCount, BucketState};
use super::diversity::Diversity;
use super::table::{CoverageTable, Exposure};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// The document.
#[derive(Clone, Debug, Serialize)]
pub struct CoverageDocument {
    format: &'static str,
    version: u32,
    /// Whether all chunks of the plan exist.
    pub complete: bool,
    /// Number of kept results that fill a bucket.
    pub full: u64,
    /// The comparisons of the plan's condition, which `left_out_by` refers to.
    pub conditions: Vec<String>,
    /// Counts by bucket.
    pub dimensions: Vec<DimensionBody>,
    /// Counts by pair of buckets, for each pair of dimensions.
    pub pairs: Vec<PairBody>,
    /// The space of possible cases.
    pub diversity: DiversityBody,
}

/// A dimension.
#[derive(Clone, Debug, Serialize)]
pub struct DimensionBody {
    name: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'static str>,
    buckets: Vec<BucketBody>,
}

#[derive(Clone, Debug, Serialize)]
struct BucketBody {
    name: String,
    state: BucketState,
    recorded: u64,
    tried: u64,
    kept: u64,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    left_out_by: BTreeMap<String, u64>,
    recorded_s: f64,
    recorded_m: f64,
    kept_s: f64,
    kept_m: f64,
}

/// A pair of dimensions.
#[derive(Clone, Debug, Serialize)]
pub struct PairBody {
    dimensions: [&'static str; 2],
    full: u64,
    thin: u64,
    /// Holes whose results the condition left out.
    left_out: u64,
    never_tried: u64,
    /// Cells with a recording or a result.
    cells: Vec<CellBody>,
}

#[derive(Clone, Debug, Serialize)]
struct CellBody {
    buckets: [usize; 2],
    recorded: u64,
    tried: u64,
    kept: u64,
    /// Index of the condition that left out most results.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out_by: Option<usize>,
}

/// The numbers before and after generation.
#[derive(Clone, Debug, Serialize)]
pub struct DiversityBody {
    /// Dimensions that span the space.
    dimensions: Vec<&'static str>,
    /// Numbers of the recorded scenes.
    recorded: Diversity,
    /// The kept results.
    kept: Diversity,
    /// Both together.
    both: Diversity,
    /// Number of cells with a kept result but no recording.
    new_cells: u64,
}

/// Rounds to a tenth.
fn tenth(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

impl CoverageDocument {
    /// The document of a table. `conditions` are the comparisons by index.
    pub fn new(table: &CoverageTable, conditions: Vec<String>, full: u64, complete: bool) -> Self {
        let dimensions = (0..table.dimensions.len()).filter_map(|i| dimension(table, i, &conditions, full));
        let dimensions = dimensions.collect();
        let numbers = 0..table.dimensions.len();
        let pairs = numbers.clone().flat_map(|i| numbers.clone().skip(i + 1).map(move |j| (i, j)));
        let pairs = pairs.filter_map(|(i, j)| pair(table, i, j, full)).collect();
        let of_space = table.dimensions.iter().filter(|of| of.is_of_space);
        let diversity = DiversityBody {
            dimensions: of_space.map(|of| of.name).collect(),
            recorded: table.space.recorded(),
            kept: table.space.kept(),
            both: table.space.both(),
            new_cells: table.space.new_cells(),
        };
        Self {
            format: "dragtraffic.coverage",
            version: 1,
            complete,
            full,
            conditions,
            dimensions,
            pairs,
            diversity,
        }
    }

    /// The table for a terminal: one row per bucket, then the pairs and the space.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{:<11} {:<18} {:>8} {:>7} {:>7} {:>9} {:>10}  state\n",
            "dimension", "bucket", "recorded", "tried", "kept", "kept s", "kept m"
        );
        for dimension in &self.dimensions {
            let mut name = dimension.name;
            for bucket in &dimension.buckets {
                let unit = dimension.unit.filter(|_| bucket.state != BucketState::Nothing);
                let label =
                    unit.map_or_else(|| bucket.name.clone(), |unit| format!("{} {unit}", bucket.name));
                let most = bucket.left_out_by.iter().max_by_key(|(_, count)| **count);
                let why = most.filter(|_| bucket.state == BucketState::LeftOut);
                let why = why.map_or_else(String::new, |(by, count)| format!(" by {by}: {count}"));
                let BucketBody { recorded, tried, kept, kept_s, kept_m, state, .. } = bucket;
                let row = format!(
                    "{name:<11} {label:<18} {recorded:>8} {tried:>7} {kept:>7} {kept_s:>9.1} {kept_m:>10.1}  {}{why}",
                    state.name()
                );
                text.push_str(row.trim_end());
                text.push('\n');
                name = "";
            }
        }
        let sum = |of: fn(&PairBody) -> u64| self.pairs.iter().map(of).sum::<u64>();
        // Writing into a string cannot fail.
        let _ = writeln!(
            text,
            "pairs of dimensions: {} full, {} thin, {} holes left out, {} holes never tried",
            sum(|of| of.full),
            sum(|of| of.thin),
            sum(|of| of.left_out),
            sum(|of| of.never_tried)
        );
        let DiversityBody { recorded, kept, both, new_cells, .. } = &self.diversity;
        for (name, of) in [("recorded", recorded), ("kept", kept), ("both", both)] {
            let Diversity { cases, cells, entropy_bits } = of;
            let _ = writeln!(text, "{name:<8} {cases:>7} cases, {cells:>6} cells, {entropy_bits:>6.3} bits");
        }
        let _ = writeln!(text, "{new_cells} cells have a kept case and no recording");
        text
    }
}

fn dimension(table: &CoverageTable, i: usize, conditions: &[String], full: u64) -> Option<DimensionBody> {
    let of = table.dimensions.get(i)?;
    let counts = table.single.get(i)?.iter().zip(table.exposure.get(i)?).zip(&of.buckets).enumerate();
    let bucket = |(bucket, ((count, exposure), name)): (usize, ((&BucketCount, &[Exposure; 2]), &String))| {
        let [recorded, kept] = exposure;
        let left_out = count.left_out.iter();
        let left_out = left_out.filter_map(|(at, number)| Some((conditions.get(*at)?.clone(), *number)));
        BucketBody {
            name: name.clone(),
            state: if of.is_nothing(bucket) { BucketState::Nothing } else { count.state(full) },
            recorded: count.recorded,
            tried: count.tried,
            kept: count.kept,
            left_out_by: left_out.collect(),
            recorded_s: tenth(recorded.seconds),
            recorded_m: tenth(recorded.metres),
            kept_s: tenth(kept.seconds),
            kept_m: tenth(kept.metres),
        }
    };
    Some(DimensionBody { name: of.name, unit: of.unit, buckets: counts.map(bucket).collect() })
}

fn pair(table: &CoverageTable, i: usize, j: usize, full: u64) -> Option<PairBody> {
    let (first, second) = (table.dimensions.get(i)?, table.dimensions.get(j)?);
    let mut body = PairBody {
        dimensions: [first.name, second.name],
        full: 0,
        thin: 0,
        left_out: 0,
        never_tried: 0,
        cells: Vec::new(),
    };
    let nothing = BucketCount::default();
    for a in 0..first.buckets.len() {
        for b in 0..second.buckets.len() {
            let count = table.pairs.get(&[(i, a), (j, b)]);
            if !first.is_nothing(a) && !second.is_nothing(b) {
                *match count.unwrap_or(&nothing).state(full) {
                    BucketState::Full => &mut body.full,
                    BucketState::Thin => &mut body.thin,
                    BucketState::LeftOut => &mut body.left_out,
                    BucketState::NeverTried | BucketState::Nothing => &mut body.never_tried,
                } += 1;
            }
            body.cells.extend(count.map(|count| CellBody {
                buckets: [a, b],
                recorded: count.recorded,
                tried: count.tried,
                kept: count.kept,
                left_out_by:
                    count.worst_condition().filter(|_| count.kept == 0).map(|(condition, _)| condition),
            }));
        }
    }
    Some(body)
}
