//! Fits the placement weights to recorded scenes. The same input gives the same bytes.

use crate::provenance::Provenance;
use crate::scenes::{read_scenes, scene_files};
use anyhow::{Result, ensure};
use experts::placement::learn::{
    CellCounts, CellKind, FORMAT, Histogram, Observation, PlacementModel, PoseContext, Rate, SPEED_CLASSES,
    SpeedContext, TypeModel, VERSION, cell_kinds, heading_classes, lateral_classes, observe,
};
use rayon::prelude::*;
use scene::routes::LaneGraph;
use scene::{AgentType, Scene};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Steps of a window that are read; they are far enough apart for the traffic to change.
const STEPS: [usize; 3] = [0, 45, 90];
/// Sweeps over the factors; each step is exact for one feature, and they settle quickly.
const SWEEPS: usize = 60;
/// Number of fictitious road users at the average rate in each class of a feature, so that rare classes stay
/// near it.
const PRIOR_COUNT: f64 = 2.0;
/// The same for a speed context, towards the context without the leader.
const PRIOR_SPEEDS: f64 = 8.0;
/// Speeds that a context needs to be kept.
const LEAST_SPEEDS: f64 = 20.0;
/// Classes of boxes, metres.
const BOX_LENGTH_M: f64 = 0.25;
const BOX_WIDTH_M: f64 = 0.1;
/// Boxes kept: this share of all.
const BOX_SHARE: f64 = 0.99;

/// Options of the training data.
#[derive(Clone, Debug)]
pub struct PlacementOptions {
    /// Files or folders of scenes in any format that can be read.
    pub inputs: Vec<PathBuf>,
    /// Description of the data for the weights' header; replaces that of the scenes.
    pub trained_on: Option<String>,
}

/// Counts of the training data.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PlacementSummary {
    pub files: usize,
    pub unreadable: usize,
    pub scenes: u64,
    /// Road users in cells by type and kind of place.
    pub seen: BTreeMap<AgentType, BTreeMap<CellKind, f64>>,
    /// Road users in no cell, by type.
    pub nowhere: BTreeMap<AgentType, usize>,
}

/// Sums over scenes.
#[derive(Default)]
struct Sums {
    scenes: u64,
    provenance: Provenance,
    cells: CellCounts,
    lateral: BTreeMap<(AgentType, PoseContext), Vec<f64>>,
    heading: BTreeMap<(AgentType, PoseContext), Vec<f64>>,
    boxes: BTreeMap<(AgentType, CellKind), BTreeMap<(u32, u32), Box2>>,
    speeds: BTreeMap<AgentType, BTreeMap<SpeedContext, Vec<f64>>>,
    nowhere: BTreeMap<AgentType, usize>,
}

/// Boxes of one class: how many, and their summed length and width.
#[derive(Clone, Copy, Default)]
struct Box2 {
    count: f64,
    length_m: f64,
    width_m: f64,
}

/// Reads scenes and fits the weights; files in order of their names.
///
/// # Errors
/// When nothing can be read.
pub fn run(
    options: &PlacementOptions,
    mut progress: impl FnMut(&PlacementSummary),
) -> Result<(PlacementModel, PlacementSummary)> {
    let files = scene_files(&options.inputs)?;
    let (mut sums, mut summary) = (Sums::default(), PlacementSummary::default());
    for chunk in files.chunks(16) {
        // Results are added in the order of the files, so the number of threads changes no byte.
        let found: Vec<Option<Sums>> = chunk.par_iter().map(|file| of_file(file)).collect();
        for one in found {
            summary.files += 1;
            match one {
                Some(one) => sums.add(one),
                None => summary.unreadable += 1,
            }
        }
        summary.scenes = sums.scenes;
        progress(&summary);
    }
    ensure!(sums.scenes > 0, "no scene could be read");
    summary.nowhere = sums.nowhere.clone();
    for ((agent_type, kind, _), (_, count)) in &sums.cells {
        *summary.seen.entry(*agent_type).or_default().entry(*kind).or_default() += count;
    }
    Ok((sums.model(options), summary))
}

fn of_file(path: &Path) -> Option<Sums> {
    let scenes = read_scenes(path).ok().filter(|s| !s.is_empty())?;
    let mut sums = Sums::default();
    for scene in &scenes {
        sums.provenance.add(scene);
        sums.scene(scene);
    }
    Some(sums)
}

fn add_to<K: Ord, T>(into: &mut BTreeMap<K, Vec<T>>, more: BTreeMap<K, Vec<T>>) {
    for (key, values) in more {
        into.entry(key).or_default().extend(values);
    }
}

impl Sums {
    fn scene(&mut self, scene: &Scene) {
        let graph = LaneGraph::new(&scene.map);
        self.scenes += 1;
        for step in STEPS.into_iter().filter(|s| *s < scene.time.steps) {
            self.observation(observe(scene, &graph, step));
        }
    }

    fn observation(&mut self, seen: Observation) {
        self.cells(seen.cells);
        for (agent_type, context, value) in seen.lateral {
            self.lateral.entry((agent_type, context)).or_default().push(value);
        }
        for (agent_type, context, value) in seen.heading {
            self.heading.entry((agent_type, context)).or_default().push(value);
        }
        for (agent_type, kind, length_m, width_m) in seen.sizes {
            let class = ((length_m / BOX_LENGTH_M) as u32, (width_m / BOX_WIDTH_M) as u32);
            let of_class = self.boxes.entry((agent_type, kind)).or_default().entry(class).or_default();
            of_class.count += 1.0;
            of_class.length_m += length_m;
            of_class.width_m += width_m;
        }
        for (agent_type, context, class) in seen.speeds {
            let of_type = self.speeds.entry(agent_type).or_default();
            for context in context.with_broader() {
                of_type.entry(context).or_insert_with(|| vec![0.0; SPEED_CLASSES])[class] += 1.0;
            }
        }
        for (agent_type, count) in seen.nowhere {
            *self.nowhere.entry(agent_type).or_default() += count;
        }
    }

    fn cells(&mut self, cells: CellCounts) {
        for (key, (extent, count)) in cells {
            let cell = self.cells.entry(key).or_default();
            cell.0 += extent;
            cell.1 += count;
        }
    }

    fn add(&mut self, other: Self) {
        self.scenes += other.scenes;
        self.provenance.merge(&other.provenance);
        self.cells(other.cells);
        add_to(&mut self.lateral, other.lateral);
        add_to(&mut self.heading, other.heading);
        for (key, classes) in other.boxes {
            for (class, more) in classes {
                let of_class = self.boxes.entry(key).or_default().entry(class).or_default();
                of_class.count += more.count;
                of_class.length_m += more.length_m;
                of_class.width_m += more.width_m;
            }
        }
        for (agent_type, rows) in other.speeds {
            for (context, counts) in rows {
                let of_type = self.speeds.entry(agent_type).or_default();
                let row = of_type.entry(context).or_insert_with(|| vec![0.0; SPEED_CLASSES]);
                row.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
            }
        }
        for (agent_type, count) in other.nowhere {
            *self.nowhere.entry(agent_type).or_default() += count;
        }
    }

    fn model(&self, options: &PlacementOptions) -> PlacementModel {
        let mut types = BTreeMap::new();
        for agent_type in [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist] {
            let mut model = TypeModel::default();
            for &kind in cell_kinds(agent_type) {
                if let Some(rate) = self.rate(agent_type, kind) {
                    model.rates.insert(kind, rate);
                }
                let boxes = self.boxes.get(&(agent_type, kind)).map(common_boxes).unwrap_or_default();
                if !boxes.is_empty() {
                    model.sizes.insert(kind, boxes);
                }
            }
            let of_type = |all: &BTreeMap<(AgentType, PoseContext), Vec<f64>>,
                           classes: fn(PoseContext) -> (f64, f64, usize)| {
                let own = all.iter().filter(|((t, _), _)| *t == agent_type);
                own.map(|((_, context), values)| (*context, histogram(values, classes(*context)))).collect()
            };
            model.lateral = of_type(&self.lateral, lateral_classes);
            model.heading = of_type(&self.heading, heading_classes);
            model.speed = self.speeds.get(&agent_type).map(speed_rows).unwrap_or_default();
            types.insert(agent_type, model);
        }
        PlacementModel {
            format: FORMAT.to_owned(),
            version: VERSION,
            licence: self.provenance.licence(),
            trained_on: options.trained_on.clone().unwrap_or_else(|| self.provenance.words()),
            scenes: self.scenes,
            types,
        }
    }

    /// Poisson regression by backfitting: each factor in turn is set so that its classes have the
    /// observed number of road users.
    fn rate(&self, agent_type: AgentType, kind: CellKind) -> Option<Rate> {
        let own = || self.cells.iter().filter(|((t, k, _), _)| *t == agent_type && *k == kind);
        let (extent, count) = own().fold((0.0, 0.0), |sum, (_, c)| (sum.0 + c.0, sum.1 + c.1));
        if extent <= 0.0 {
            return None;
        }
        let factors = kind.feature_classes().iter().map(|n| vec![1.0; *n]).collect();
        let mut rate = Rate { per_m: count / extent, factors };
        for _ in 0..SWEEPS {
            for feature in 0..rate.factors.len() {
                let classes = rate.factors[feature].len();
                let (mut seen, mut expected) = (vec![PRIOR_COUNT; classes], vec![PRIOR_COUNT; classes]);
                for ((_, _, features), (extent, count)) in own() {
                    let class = usize::from(features[feature]);
                    seen[class] += count;
                    expected[class] += extent * rate.per_m * rate.factor(features);
                }
                for (factor, (seen, expected)) in
                    rate.factors[feature].iter_mut().zip(seen.iter().zip(&expected))
                {
                    // The prior pulls towards one, not towards the value of the last sweep.
                    let without = (expected - PRIOR_COUNT) / *factor;
                    *factor = (seen / (without + PRIOR_COUNT)).max(1e-6);
                }
            }
            let expected: f64 = own()
                .map(|((_, _, features), (extent, _))| extent * rate.per_m * rate.factor(features))
                .sum();
            if expected > 0.0 {
                rate.per_m *= count / expected;
            }
        }
        rate.per_m = short(rate.per_m);
        rate.factors.iter_mut().flatten().for_each(|f| *f = short(*f));
        Some(rate)
    }
}

/// The data support three digits.
fn short(value: f64) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    let parts = 10f64.powi(2 - value.abs().log10().floor() as i32);
    (value * parts).round() / parts
}

/// Shares; those outside the classes are left out.
fn histogram(values: &[f64], (low, step, classes): (f64, f64, usize)) -> Histogram {
    let mut counts = vec![0.0; classes];
    for value in values {
        let class = ((value - low) / step).floor();
        if class >= 0.0 && (class as usize) < classes {
            counts[class as usize] += 1.0;
        }
    }
    if counts.iter().all(|c| *c == 0.0) {
        // No value lies within the classes: the class of zero, else the first.
        counts[((-low / step) as usize).min(classes - 1)] = 1.0;
    }
    let total: f64 = counts.iter().sum();
    Histogram { low, step, share: counts.into_iter().map(|c| short(c / total)).collect() }
}

/// The most frequent boxes with their mean length and width.
fn common_boxes(classes: &BTreeMap<(u32, u32), Box2>) -> Vec<[f64; 3]> {
    let total: f64 = classes.values().map(|b| b.count).sum();
    let mut sorted: Vec<&Box2> = classes.values().collect();
    sorted.sort_by(|a, b| b.count.total_cmp(&a.count));
    let mut held = 0.0;
    let mut boxes = Vec::new();
    for one in sorted {
        if held >= BOX_SHARE * total {
            break;
        }
        held += one.count;
        let mean = |sum: f64| ((sum / one.count) * 100.0).round() / 100.0;
        boxes.push([
            mean(one.length_m).clamp(0.3, 25.0),
            mean(one.width_m).clamp(0.3, 3.2),
            short(one.count / total),
        ]);
    }
    boxes
}

/// Shares by context, rare contexts drawn towards the one without the leader.
fn speed_rows(counts: &BTreeMap<SpeedContext, Vec<f64>>) -> BTreeMap<SpeedContext, Vec<f64>> {
    let blended = |context: SpeedContext, row: &Vec<f64>, prior: Option<&Vec<f64>>| {
        let total: f64 = row.iter().sum();
        let shares = (0..SPEED_CLASSES).map(|class| {
            let before = prior.map_or(0.0, |p| PRIOR_SPEEDS * p[class]);
            short((row[class] + before) / (total + if prior.is_some() { PRIOR_SPEEDS } else { 0.0 }))
        });
        (context, shares.collect::<Vec<f64>>())
    };
    let mut rows: BTreeMap<SpeedContext, Vec<f64>> = BTreeMap::new();
    // General contexts first, because each row is blended with that of its broader context.
    let mut general_first: Vec<_> = counts.iter().collect();
    general_first.sort_by_key(|(context, _)| context.with_broader().count());
    for (context, row) in general_first {
        if row.iter().sum::<f64>() < LEAST_SPEEDS {
            continue;
        }
        let parent = context.broader();
        let (context, shares) = blended(*context, row, parent.and_then(|p| rows.get(&p)));
        rows.insert(context, shares);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use experts::placement::learn::{LeaderGap, LeaderPace, RoadAhead};

    #[test]
    fn factors_are_found_again() {
        // Twice as many in class 1 of the first feature, three times in class 2 of the second.
        let mut sums = Sums::default();
        for a in 0..4u8 {
            for b in 0..5u8 {
                let rate = 0.01 * if a == 1 { 2.0 } else { 1.0 } * if b == 2 { 3.0 } else { 1.0 };
                let extent = 1e6 + 1e5 * f64::from(a * b);
                let cell = (AgentType::Pedestrian, CellKind::Pavement, [a, b, 0, 0, 0, 0]);
                sums.cells.insert(cell, (extent, extent * rate));
            }
        }
        let rate = sums.rate(AgentType::Pedestrian, CellKind::Pavement).unwrap();
        let of = |a: u8, b: u8| rate.per_m * rate.factor(&[a, b, 0, 0, 0, 0]);
        for (a, b, expected) in [(0, 0, 0.01), (1, 0, 0.02), (0, 2, 0.03), (1, 2, 0.06)] {
            assert!((of(a, b) / expected - 1.0).abs() < 0.01, "{a} {b}: {} for {expected}", of(a, b));
        }
        assert!(sums.rate(AgentType::Cyclist, CellKind::Pavement).is_none());
    }

    #[test]
    fn rare_speed_contexts_lean_on_common_ones() {
        let mut counts = BTreeMap::new();
        let row = |class: usize, n: f64| {
            let mut row = vec![0.0; SPEED_CLASSES];
            row[class] = n;
            row
        };
        counts.insert(SpeedContext::AnyDriver, row(10, 1000.0));
        let clear = RoadAhead::Clear;
        let follows = |pace| SpeedContext::Driver(clear, Some((LeaderGap::Within4M, pace)));
        let (common, rare) = (follows(LeaderPace::Slow), follows(LeaderPace::Fast));
        counts.insert(SpeedContext::DriverAnyLeader(clear), row(10, 1000.0));
        counts.insert(common, row(0, 24.0));
        counts.insert(rare, row(0, 1.0));
        let rows = speed_rows(&counts);
        assert_eq!((rows[&common][0], rows[&common][10]), (0.75, 0.25));
        assert!(!rows.contains_key(&rare));
        assert_eq!(rows[&SpeedContext::AnyDriver][10], 1.0);
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!([short(0.123456), short(12345.6), short(0.0), short(1.0)], [0.123, 12300.0, 0.0, 1.0]);
        let histogram = histogram(&[0.05, 0.15, 0.16, 9.0], (0.0, 0.1, 3));
        assert_eq!(histogram.share, [0.333, 0.667, 0.0]);
    }
}
