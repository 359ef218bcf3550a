//! Compares placed road users with recorded ones: the same scenes, as many of each type, the same region.

mod distance;
mod table;

pub use table::markdown;

use anyhow::Result;
use distance::{jensen_shannon, wasserstein};
use experts::placement::{Amount, PlaceRequest, PlacementModel, Region, place};
use experts::{Cancel, Placer};
use rayon::prelude::*;
use scene::geometry::obb::{OrientedBox, overlaps, shared_area_m2};
use scene::random::Key;
use scene::routes::{LaneGraph, LaneHit};
use scene::score::Drivable;
use scene::{Agent, AgentType, Scene, State, wrap_angle};
use serde::Serialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Types that are evaluated.
const TYPES: [AgentType; 3] = [AgentType::Vehicle, AgentType::Pedestrian, AgentType::Cyclist];
/// Distances to lanes and neighbours are capped at this, metres.
const FAR_M: f64 = 50.0;
/// Draws of scenes for the intervals.
const RESAMPLES: u64 = 400;
/// Road users slower than this count as standing, m/s.
const SLOW_MPS: f64 = 0.5;
/// Corners farther off the road than this count as off it, metres.
const OFF_ROAD_M: f64 = 0.3;

/// Options of the evaluation.
#[derive(Clone, Copy, Debug)]
pub struct EvalPlaceOptions {
    /// Region: a circle of this radius about the ego, metres.
    pub radius_m: f64,
    /// Placements of each scene.
    pub seeds: u64,
}

impl Default for EvalPlaceOptions {
    fn default() -> Self {
        Self { radius_m: 60.0, seeds: 4 }
    }
}

/// Measures of each road user.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum Measure {
    NearestNeighborM,
    LaneDistanceM,
    SpeedMps,
    HeadingDeg,
    LengthM,
    WidthM,
}

impl Measure {
    /// All measures, with the ranges of their classes.
    const ALL: [(Self, f64, f64); 6] = [
        (Self::NearestNeighborM, 0.0, FAR_M),
        (Self::LaneDistanceM, 0.0, 12.0),
        (Self::SpeedMps, 0.0, 24.0),
        (Self::HeadingDeg, 0.0, 180.0),
        (Self::LengthM, 0.0, 12.0),
        (Self::WidthM, 0.0, 3.0),
    ];

    /// Words for tables.
    pub fn words(self) -> &'static str {
        match self {
            Self::NearestNeighborM => "nearest neighbour (m)",
            Self::LaneDistanceM => "distance to lane centre (m)",
            Self::SpeedMps => "speed (m/s)",
            Self::HeadingDeg => "heading to lane (°)",
            Self::LengthM => "length (m)",
            Self::WidthM => "width (m)",
        }
    }
}

/// A figure with its 95 % interval over draws of scenes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct Interval {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

/// Distance of one distribution from that of the log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct DistributionDistance {
    /// Wasserstein-1, in the measure's unit.
    pub wasserstein: Interval,
    /// Jensen-Shannon divergence over 24 classes, bits.
    pub jensen_shannon: f64,
}

/// One measure of one type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct MeasureGaps {
    pub model: DistributionDistance,
    pub lane_sampler: DistributionDistance,
    /// The logs of one half of the scenes against those of the other: the effect of chance.
    pub log_halves: DistributionDistance,
}

/// Counts and shares of one source of road users.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PlacementFacts {
    pub asked: usize,
    pub placed: usize,
    /// Pairs of boxes that share area.
    pub overlaps: usize,
    /// Share of vehicles with a corner off the road.
    pub off_road_share: Interval,
    /// Share of vehicles more than 2 m from every lane's centre.
    pub off_lane_share: Interval,
    /// Share of standing vehicles.
    pub standing_share: Interval,
}

/// The table.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PlacementReport {
    pub scenes: usize,
    pub seeds: u64,
    pub radius_m: f64,
    /// Road users in the logs, by type.
    pub logged: BTreeMap<AgentType, usize>,
    pub rows: BTreeMap<AgentType, BTreeMap<Measure, MeasureGaps>>,
    pub log: PlacementFacts,
    pub model: PlacementFacts,
    pub lane_sampler: PlacementFacts,
}

/// Values of one scene by type and measure, and its counts.
#[derive(Clone, Debug, Default)]
struct SceneMeasures {
    by: BTreeMap<(AgentType, Measure), Vec<f64>>,
    asked: usize,
    placed: usize,
    overlaps: usize,
    off_road: Vec<f64>,
    off_lane: Vec<f64>,
    standing: Vec<f64>,
}

/// Measures of log, model and lane sampler of one scene.
type Three = [SceneMeasures; 3];

/// Compares placements with the logs of scenes.
///
/// # Errors
/// When placement fails.
pub fn eval(placer: &Placer, scenes: &[Scene], options: EvalPlaceOptions) -> Result<PlacementReport> {
    let model = placer.model();
    let judged: Vec<Result<Option<Three>>> =
        scenes.par_iter().map(|scene| of_scene(model, scene, options)).collect();
    let mut all: Vec<Three> = Vec::new();
    for one in judged {
        all.extend(one?);
    }
    let mut report = PlacementReport {
        scenes: all.len(),
        seeds: options.seeds,
        radius_m: options.radius_m,
        ..PlacementReport::default()
    };
    for agent_type in TYPES {
        let count =
            all.iter().map(|s| s[0].by.get(&(agent_type, Measure::LengthM)).map_or(0, Vec::len)).sum();
        report.logged.insert(agent_type, count);
        if count == 0 {
            continue;
        }
        for (measure, low, high) in Measure::ALL {
            let row = MeasureGaps {
                model: gap(&all, 1, (agent_type, measure), (low, high)),
                lane_sampler: gap(&all, 2, (agent_type, measure), (low, high)),
                log_halves: halves(&all, (agent_type, measure), (low, high)),
            };
            report.rows.entry(agent_type).or_default().insert(measure, row);
        }
    }
    report.log = facts(&all, 0);
    report.model = facts(&all, 1);
    report.lane_sampler = facts(&all, 2);
    Ok(report)
}

fn of_scene(
    model: Option<&PlacementModel>,
    scene: &Scene,
    options: EvalPlaceOptions,
) -> Result<Option<Three>> {
    let step = scene.time.now_step;
    let ego = scene.agents.iter().find(|a| a.role.as_deref() == Some("ego"));
    let Some(ego) = ego.and_then(|a| a.state_at(step)) else { return Ok(None) };
    let region = Region::Circle { center: ego.position(), radius_m: options.radius_m };
    let there = |a: &&Agent| {
        TYPES.contains(&a.agent_type) && a.state_at(step).is_some_and(|s| region.contains(s.position()))
    };
    let logged: Vec<Agent> = scene.agents.iter().filter(there).cloned().collect();
    let mut each: BTreeMap<AgentType, usize> = BTreeMap::new();
    for agent in &logged {
        *each.entry(agent.agent_type).or_default() += 1;
    }
    let graph = LaneGraph::new(&scene.map);
    let drivable = Drivable::new(&scene.map);
    let mut three = Three::default();
    three[0].add(&graph, &drivable, &logged, step);
    three[0].asked = logged.len();
    let mut request = PlaceRequest::new(Arc::new(Scene { agents: Vec::new(), ..scene.clone() }));
    (request.step, request.region, request.amount) = (step, region, Amount::Each(each));
    // Some recorded cars stand closer than 2 m; placement must be allowed to do the same.
    request.min_gap_m = 1.0;
    for seed in 0..options.seeds {
        request.seed = seed;
        for (slot, model) in [(1, model), (2, None)] {
            let placement = place(model, &graph, &request, &Cancel::default())?;
            three[slot].add(&graph, &drivable, &placement.agents, step);
            three[slot].asked += logged.len();
        }
    }
    Ok(Some(three))
}

impl SceneMeasures {
    fn add(&mut self, graph: &LaneGraph, drivable: &Drivable, agents: &[Agent], step: usize) {
        let there = agents.iter().filter_map(|a| Some((a, a.state_at(step)?)));
        let there: Vec<(&Agent, State, OrientedBox)> =
            there.map(|(a, s)| (a, s, OrientedBox::of_state(&s, &a.size))).collect();
        self.placed += there.len();
        for (i, (agent, state, outline)) in there.iter().enumerate() {
            let others = || there.iter().enumerate().filter(move |(j, _)| *j != i);
            let nearest =
                others().map(|(_, o)| (o.1.position() - state.position()).norm()).fold(FAR_M, f64::min);
            let touching = others().filter(|(j, o)| *j > i && overlaps(outline, &o.2, 0.0));
            self.overlaps += touching.filter(|(_, o)| shared_area_m2(outline, &o.2) > 1e-6).count();
            let lane = lane_of(graph, state);
            let lane_m = lane.as_ref().map_or(FAR_M, |h| h.distance_m);
            let turn = lane.map_or(0.0, |h| wrap_angle(state.heading_rad - h.heading_rad).abs());
            let mut push = |measure, value| {
                self.by.entry((agent.agent_type, measure)).or_default().push(value);
            };
            push(Measure::NearestNeighborM, nearest);
            push(Measure::LaneDistanceM, lane_m);
            push(Measure::SpeedMps, state.speed_mps());
            push(Measure::HeadingDeg, turn.to_degrees());
            push(Measure::LengthM, agent.size.length_m);
            push(Measure::WidthM, agent.size.width_m);
            if agent.agent_type == AgentType::Vehicle {
                let share = |is: bool| f64::from(u8::from(is));
                self.standing.push(share(state.speed_mps() < SLOW_MPS));
                self.off_lane.push(share(lane_m > 2.0));
                self.off_road.extend(drivable.box_outside_m(outline).map(|m| share(m > OFF_ROAD_M)));
            }
        }
    }
}

/// The lane nearest to a road user; of several lanes that it is on, the one it is aligned with.
fn lane_of(graph: &LaneGraph, state: &State) -> Option<LaneHit> {
    let hits = graph.nearest_for(state.position(), FAR_M, AgentType::Vehicle);
    let on = hits.iter().filter(|h| h.distance_m < 1.75);
    let turn = |h: &LaneHit| wrap_angle(state.heading_rad - h.heading_rad).abs();
    on.min_by(|a, b| turn(a).total_cmp(&turn(b))).or(hits.first()).copied()
}

type MeasuredOf = (AgentType, Measure);

fn pooled<'a>(scenes: impl Iterator<Item = &'a SceneMeasures>, key: MeasuredOf) -> Vec<f64> {
    scenes.flat_map(|s| s.by.get(&key).into_iter().flatten().copied()).collect()
}

/// Draws of scenes with replacement, the same for every figure.
fn resamples(scenes: usize) -> impl Iterator<Item = Vec<usize>> {
    (0..RESAMPLES).map(move |number| {
        let mut draw = Key::default().number(number).stream();
        (0..scenes).map(|_| draw.below(scenes)).collect()
    })
}

/// The value, and the middle 95 % of the values of resampled scenes.
fn figure(value: f64, mut resampled: Vec<f64>) -> Interval {
    resampled.retain(|v| v.is_finite());
    resampled.sort_by(f64::total_cmp);
    let at = |share: f64| resampled.get((share * resampled.len() as f64) as usize).copied().unwrap_or(value);
    Interval { value, low: at(0.025), high: at(0.975) }
}

fn gap(all: &[Three], slot: usize, key: MeasuredOf, (low, high): (f64, f64)) -> DistributionDistance {
    let of = |picked: &[usize], slot: usize| pooled(picked.iter().map(|i| &all[*i][slot]), key);
    let whole: Vec<usize> = (0..all.len()).collect();
    let (log, placed) = (of(&whole, 0), of(&whole, slot));
    let resampled = resamples(all.len()).map(|picked| wasserstein(&of(&picked, 0), &of(&picked, slot)));
    DistributionDistance {
        wasserstein: figure(wasserstein(&log, &placed), resampled.collect()),
        jensen_shannon: jensen_shannon(&log, &placed, low, high),
    }
}

fn halves(all: &[Three], key: MeasuredOf, (low, high): (f64, f64)) -> DistributionDistance {
    let of = |parity: usize| pooled(all.iter().skip(parity).step_by(2).map(|s| &s[0]), key);
    let (even, odd) = (of(0), of(1));
    DistributionDistance {
        wasserstein: figure(wasserstein(&even, &odd), Vec::new()),
        jensen_shannon: jensen_shannon(&even, &odd, low, high),
    }
}

fn facts(all: &[Three], slot: usize) -> PlacementFacts {
    let share = |of: fn(&SceneMeasures) -> &Vec<f64>| {
        let mean = |picked: &[usize]| {
            let values = picked.iter().flat_map(|i| of(&all[*i][slot]));
            let (sum, n) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v, n + 1.0));
            if n > 0.0 { sum / n } else { 0.0 }
        };
        let whole: Vec<usize> = (0..all.len()).collect();
        figure(mean(&whole), resamples(all.len()).map(|picked| mean(&picked)).collect())
    };
    let sum = |of: fn(&SceneMeasures) -> usize| all.iter().map(|s| of(&s[slot])).sum();
    PlacementFacts {
        asked: sum(|v| v.asked),
        placed: sum(|v| v.placed),
        overlaps: sum(|v| v.overlaps),
        off_road_share: share(|v| &v.off_road),
        off_lane_share: share(|v| &v.off_lane),
        standing_share: share(|v| &v.standing),
    }
}
