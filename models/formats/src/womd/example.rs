//! Scenes as `tf.Example` records, the dataset's form for machine learning: lists of fixed length by name,
//! with -1 for missing values.

use super::export::scenario;
use super::proto::{
    BytesList, Example, Feature, FeatureData, FeatureKind, Features, FloatList, Int64List, MapFeature,
    MapPoint, ObjectState, Scenario, Track,
};
use super::record::write_record;
use crate::format::{ExportOptions, Exported, Format, ImportOptions, Info, NOW_STEP, Scenes, written_only};
use crate::loss::{Loss, code};
use crate::polyline::{arc_lengths, length, point_at};
use crate::sentences;
use crate::source::Source;
use prost::Message;
use scene::{STEP_S, Scene, Vec2};
use std::collections::{BTreeMap, BTreeSet};
use std::io;

/// Most road users, signals and road points of a record.
const ROOM: (usize, usize, usize) = (128, 16, 30_000);
/// Number of steps before and after the present one.
const PAST: usize = NOW_STEP;
const FUTURE: usize = 80;
/// Least spacing of road points, metres; doubled until they fit.
const SPACING_M: f64 = 0.5;
/// Value of an empty slot.
const NOTHING: f32 = -1.0;
/// Type numbers of road points: the first numbers of painted lines and of edges, and those of signs and
/// areas.
const FIRST_LINE: i64 = 5;
const FIRST_EDGE: i64 = 14;
const STOP_SIGN: i64 = 17;
const CROSSWALK: i64 = 18;
const SPEED_BUMP: i64 = 19;
const DRIVEWAY: i64 = 20;
const MICROSECONDS: f64 = 1e6;

/// Waymo Open Motion `tf.Example` records.
pub(crate) struct WomdExample;

impl Format for WomdExample {
    fn info(&self) -> Info {
        Info {
            id: "womd-example",
            name: "Waymo Open Motion tf.Example (TFRecord)",
            media_type: "application/octet-stream",
            extensions: &["example.tfrecord", "example.tfrecord.gz"],
            import: false,
            export: true,
            many: true,
            takes_net: false,
            notes: "The flat form of the same: `state/...`, `roadgraph_samples/...`, \
                 `traffic_light_state/...` in the dataset's shapes, for 128 road users, 91 steps, 16 \
                 signals and 30 000 points. Plain or gzip.",
            loses: &[
                code::NO_CONDITIONS,
                code::NO_GENERATED,
                code::NO_MODES,
                code::NO_SUBTYPE,
                code::NO_ROLES,
                code::NO_LICENCE,
                code::NO_NOTES,
                code::NO_MAP,
                code::NO_SIGNALS,
                code::NO_ROAD_USERS,
                code::NO_TIMING,
                code::NO_LANE_GRAPH,
                code::NO_SPEED_LIMITS,
                code::NO_DRIVABLE,
                code::NO_LANE_WIDTH,
                code::NO_LANE_TYPE,
                code::GEOMETRY_APPROXIMATED,
                code::IDS_RENUMBERED,
            ],
        }
    }

    fn scenes<'a>(&'a self, _: &'a dyn Source, _: &'a ImportOptions) -> Scenes<'a> {
        written_only(&self.info())
    }

    fn export(&self, scenes: &[&Scene], options: &ExportOptions) -> io::Result<Exported> {
        let mut bytes = Vec::new();
        let mut losses = BTreeSet::new();
        super::export::packed(&mut bytes, options.gzip, |mut out| {
            for scene in scenes {
                let (message, lost) = scenario(scene, options.motion);
                losses.extend(lost.into_iter().filter(|loss| loss.code != code::LONG_RECORD));
                let record = example(&message, &mut losses);
                write_record(&mut out, &record.encode_to_vec())?;
            }
            Ok(())
        })?;
        Ok(Exported { bytes, losses: losses.into_iter().collect() })
    }
}

/// Lists of a record by name.
#[derive(Default)]
struct Lists(BTreeMap<String, Feature>);

impl Lists {
    fn add(&mut self, name: String, kind: FeatureKind) {
        self.0.insert(name, Feature { kind: Some(kind) });
    }

    fn floats(&mut self, name: impl Into<String>, value: Vec<f32>) {
        self.add(name.into(), FeatureKind::Float(FloatList { value }));
    }

    fn whole(&mut self, name: impl Into<String>, value: Vec<i64>) {
        self.add(name.into(), FeatureKind::Int64(Int64List { value }));
    }
}

/// The lists of a Scenario message.
fn example(scenario: &Scenario, losses: &mut BTreeSet<Loss>) -> Example {
    let mut lists = Lists::default();
    let id = scenario.scenario_id.clone().unwrap_or_default().into_bytes();
    lists.add("scenario/id".into(), FeatureKind::Bytes(BytesList { value: vec![id] }));
    let now = usize::try_from(scenario.current_time_index.unwrap_or(0)).unwrap_or(0);
    let steps = scenario.tracks.iter().map(|track| track.states.len()).max().unwrap_or(0);
    if now != PAST || steps > now + 1 + FUTURE {
        losses.insert(Loss::counted(code::NO_TIMING, sentences::loss_steps_over_room(PAST, FUTURE)));
    }
    let kept = kept(scenario, now, losses);
    road_users(scenario, now, &kept, &mut lists);
    lights(scenario, now, &mut lists, losses);
    roads(&scenario.map_features, &mut lists, losses);
    Example { features: Some(Features { feature: lists.0 }) }
}

/// Steps of a part of the record; nothing where the scene does not reach.
fn parts(now: usize) -> [(&'static str, Vec<Option<usize>>); 3] {
    [
        ("past", (0..PAST).map(|i| (now + i).checked_sub(PAST)).collect()),
        ("current", vec![Some(now)]),
        ("future", (1..=FUTURE).map(|i| Some(now + i)).collect()),
    ]
}

fn is_valid(state: &&ObjectState) -> bool {
    state.valid == Some(true)
}

/// Tracks that fit the record: the ego, those to be predicted, and the nearest to them.
fn kept(scenario: &Scenario, now: usize, losses: &mut BTreeSet<Loss>) -> Vec<usize> {
    let tracks = &scenario.tracks;
    if tracks.len() <= ROOM.0 {
        return (0..tracks.len()).collect();
    }
    let lost = sentences::loss_users_over_room(tracks.len(), ROOM.0);
    losses.insert(Loss::counted(code::NO_ROAD_USERS, lost));
    let ego = scenario.sdc_track_index.and_then(|index| usize::try_from(index).ok());
    let wanted = scenario.tracks_to_predict.iter().filter_map(|p| usize::try_from(p.track_index?).ok());
    let first: BTreeSet<usize> = ego.into_iter().chain(wanted).collect();
    let place = |track: &Track| {
        let state = track.states.get(now).filter(is_valid)?;
        Some(Vec2::new(state.center_x?, state.center_y?))
    };
    let middle = ego.and_then(|ego| place(tracks.get(ego)?)).unwrap_or_default();
    let away = |i: &usize| match (first.contains(i), tracks.get(*i).and_then(place)) {
        (true, _) => -1.0,
        (false, Some(at)) => (at - middle).norm(),
        (false, None) => f64::INFINITY,
    };
    let mut order: Vec<usize> = (0..tracks.len()).collect();
    order.sort_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
    order.truncate(ROOM.0);
    order.sort_unstable();
    order
}

/// Time of a step, microseconds.
fn time(scenario: &Scenario, step: usize) -> i64 {
    let seconds = scenario.timestamps_seconds.get(step).copied().unwrap_or(step as f64 * STEP_S);
    (seconds * MICROSECONDS).round() as i64
}

type Value = fn(&ObjectState) -> f32;

/// Values of a state by name.
const STATE: [(&str, Value); 11] = [
    ("x", |s| s.center_x.unwrap_or_default() as f32),
    ("y", |s| s.center_y.unwrap_or_default() as f32),
    ("z", |s| s.center_z.unwrap_or_default() as f32),
    ("bbox_yaw", |s| s.heading.unwrap_or_default()),
    ("length", |s| s.length.unwrap_or_default()),
    ("width", |s| s.width.unwrap_or_default()),
    ("height", |s| s.height.unwrap_or_default()),
    ("velocity_x", |s| s.velocity_x.unwrap_or_default()),
    ("velocity_y", |s| s.velocity_y.unwrap_or_default()),
    ("speed", |s| s.velocity_x.unwrap_or_default().hypot(s.velocity_y.unwrap_or_default())),
    ("vel_yaw", |s| s.velocity_y.unwrap_or_default().atan2(s.velocity_x.unwrap_or_default())),
];

fn road_users(scenario: &Scenario, now: usize, kept: &[usize], lists: &mut Lists) {
    let tracks: Vec<Option<&Track>> = (0..ROOM.0).map(|i| scenario.tracks.get(*kept.get(i)?)).collect();
    let float = |value: fn(&Track) -> Option<i32>| {
        let value = |track: &Option<&Track>| track.and_then(value).map_or(NOTHING, |value| value as f32);
        tracks.iter().map(value).collect()
    };
    lists.floats("state/id", float(|track| track.id));
    lists.floats("state/type", float(|track| track.object_type));
    let whole =
        |value: &dyn Fn(usize) -> i64| (0..ROOM.0).map(|i| kept.get(i).map_or(-1, |i| value(*i))).collect();
    let at = |index: Option<i32>| index.and_then(|index| usize::try_from(index).ok());
    lists.whole("state/is_sdc", whole(&|i| i64::from(at(scenario.sdc_track_index) == Some(i))));
    let predicted = |i: usize| scenario.tracks_to_predict.iter().find(|p| at(p.track_index) == Some(i));
    lists.whole("state/tracks_to_predict", whole(&|i| i64::from(predicted(i).is_some())));
    let difficulty = |i: usize| predicted(i).and_then(|p| p.difficulty).unwrap_or(0).into();
    lists.whole("state/difficulty_level", whole(&difficulty));
    let interest = |i: usize| {
        let id = scenario.tracks.get(i).and_then(|track| track.id);
        id.is_some_and(|id| scenario.objects_of_interest.contains(&id))
    };
    lists.whole("state/objects_of_interest", whole(&|i| i64::from(interest(i))));
    for (part, steps) in parts(now) {
        let states: Vec<(Option<usize>, Option<&ObjectState>)> = tracks
            .iter()
            .flat_map(|track| {
                let state = move |step: Option<usize>| track.and_then(|track| track.states.get(step?));
                steps.iter().map(move |step| (*step, state(*step).filter(is_valid)))
            })
            .collect();
        for (name, value) in STATE {
            let list = states.iter().map(|(_, state)| state.map_or(NOTHING, value)).collect();
            lists.floats(format!("state/{part}/{name}"), list);
        }
        let times = states.iter().map(|(step, state)| match (step, state) {
            (Some(step), Some(_)) => time(scenario, *step),
            _ => -1,
        });
        lists.whole(format!("state/{part}/timestamp_micros"), times.collect());
        let valid = states.iter().map(|(_, state)| i64::from(state.is_some())).collect();
        lists.whole(format!("state/{part}/valid"), valid);
    }
}

fn lights(scenario: &Scenario, now: usize, lists: &mut Lists, losses: &mut BTreeSet<Loss>) {
    let rows = &scenario.dynamic_map_states;
    if rows.iter().any(|row| row.lane_states.len() > ROOM.1) {
        losses.insert(Loss::counted(code::NO_SIGNALS, sentences::loss_lights_over_room(ROOM.1)));
    }
    for (part, steps) in parts(now) {
        let slots = |step: &Option<usize>| {
            let row = step.and_then(|step| rows.get(step));
            (0..ROOM.1).map(move |i| row.and_then(|row| row.lane_states.get(i)).copied())
        };
        let shown: Vec<_> = steps.iter().flat_map(slots).collect();
        let name = |what: &str| format!("traffic_light_state/{part}/{what}");
        let whole = |value: fn(&super::proto::TrafficSignalLaneState) -> i64| {
            shown.iter().map(|light| light.as_ref().map_or(-1, value)).collect()
        };
        lists.whole(name("id"), whole(|light| light.lane.unwrap_or(-1)));
        lists.whole(name("state"), whole(|light| light.state.unwrap_or(0).into()));
        lists.whole(name("valid"), shown.iter().map(|light| i64::from(light.is_some())).collect());
        let stops: Vec<Option<MapPoint>> =
            shown.iter().map(|light| light.and_then(|light| light.stop_point)).collect();
        let along = |value: fn(MapPoint) -> Option<f64>| {
            let one = |stop: &Option<MapPoint>| stop.map_or(NOTHING, |p| value(p).unwrap_or_default() as f32);
            stops.iter().map(one).collect()
        };
        lists.floats(name("x"), along(|p| p.x));
        lists.floats(name("y"), along(|p| p.y));
        lists.floats(name("z"), along(|p| p.z));
        let times = steps.iter().map(|step| match step.filter(|step| *step < rows.len()) {
            Some(step) => time(scenario, step),
            None => -1,
        });
        lists.whole(name("timestamp_micros"), times.collect());
    }
}

/// A line of the map as it is written.
struct MapLine {
    id: i64,
    kind: i64,
    points: Vec<Vec2>,
    z_m: Vec<f64>,
}

impl MapLine {
    fn of(feature: &MapFeature) -> Option<Self> {
        let (kind, list): (i64, Vec<MapPoint>) = match feature.feature_data.as_ref()? {
            FeatureData::Lane(lane) => (lane.lane_type.unwrap_or(0).into(), lane.polyline.clone()),
            FeatureData::RoadLine(line) => {
                (FIRST_LINE + i64::from(line.line_type.unwrap_or(0)), line.polyline.clone())
            }
            FeatureData::RoadEdge(line) => {
                (FIRST_EDGE + i64::from(line.line_type.unwrap_or(0)), line.polyline.clone())
            }
            FeatureData::StopSign(sign) => (STOP_SIGN, sign.position.into_iter().collect()),
            FeatureData::Crosswalk(area) => (CROSSWALK, area.polygon.clone()),
            FeatureData::SpeedBump(area) => (SPEED_BUMP, area.polygon.clone()),
            FeatureData::Driveway(area) => (DRIVEWAY, area.polygon.clone()),
        };
        let points = list.iter().map(MapPoint::plane).collect();
        let z_m = list.iter().map(|point| point.z.unwrap_or(0.0)).collect();
        // Corners of areas stay as they are, as in the dataset.
        Some(Self { id: feature.id.unwrap_or(-1), kind, points, z_m })
    }

    fn is_area(&self) -> bool {
        self.kind >= STOP_SIGN
    }

    /// Number of points at a spacing.
    fn count(&self, spacing_m: f64) -> usize {
        if self.is_area() || self.points.len() < 2 {
            return self.points.len();
        }
        (length(&self.points) / spacing_m).ceil() as usize + 1
    }

    /// Points with heights, at a spacing.
    fn sampled(&self, spacing_m: f64) -> Vec<(Vec2, f64)> {
        if self.is_area() || self.points.len() < 2 {
            return self.points.iter().copied().zip(self.z_m.iter().copied()).collect();
        }
        let arc = arc_lengths(&self.points);
        let total = length(&self.points);
        let count = self.count(spacing_m);
        let at = |i: usize| {
            let s = total * i as f64 / (count - 1).max(1) as f64;
            let next = arc.partition_point(|other| *other < s).clamp(1, arc.len() - 1);
            let (from, to) = (arc[next - 1], arc[next]);
            let share = if to > from { (s - from) / (to - from) } else { 0.0 };
            let z = self.z_m[next - 1] + (self.z_m[next] - self.z_m[next - 1]) * share.clamp(0.0, 1.0);
            (point_at(&self.points, &arc, s), z)
        };
        (0..count).map(at).collect()
    }
}

fn roads(features: &[MapFeature], lists: &mut Lists, losses: &mut BTreeSet<Loss>) {
    let lines: Vec<MapLine> = features.iter().filter_map(MapLine::of).collect();
    let count = |spacing_m: f64| lines.iter().map(|line| line.count(spacing_m)).sum::<usize>();
    let mut spacing_m = SPACING_M;
    // At a large enough spacing each line has only its two ends.
    while count(spacing_m) > ROOM.2 && spacing_m < 1e6 {
        spacing_m *= 2.0;
    }
    losses.insert(Loss::counted(code::GEOMETRY_APPROXIMATED, sentences::loss_lines_sampled(spacing_m)));
    losses.insert(Loss::new(code::NO_LANE_GRAPH, "which lanes follow each other and lie side by side"));
    losses.insert(Loss::new(code::NO_SPEED_LIMITS, "limits of lanes"));
    let (mut at, mut along, mut ids, mut kinds) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut left_out = 0;
    for line in &lines {
        let points = line.sampled(spacing_m);
        for (i, (p, z)) in points.iter().enumerate() {
            if ids.len() >= ROOM.2 {
                left_out += 1;
                continue;
            }
            // The direction to the next point; at the end, that from the previous point.
            let step = |a: &(Vec2, f64), b: &(Vec2, f64)| [b.0.x - a.0.x, b.0.y - a.0.y, b.1 - a.1];
            let way = match (points.get(i + 1), i.checked_sub(1).and_then(|i| points.get(i))) {
                (Some(next), _) => step(&(*p, *z), next),
                (None, Some(before)) => step(before, &(*p, *z)),
                (None, None) => [0.0; 3],
            };
            let norm = way.iter().map(|v| v * v).sum::<f64>().sqrt().max(1e-9);
            at.extend([p.x as f32, p.y as f32, *z as f32]);
            along.extend(way.map(|v| (v / norm) as f32));
            ids.push(line.id);
            kinds.push(line.kind);
        }
    }
    if left_out > 0 {
        let lost = sentences::loss_points_over_room(ROOM.2 + left_out, ROOM.2);
        losses.insert(Loss::counted(code::NO_MAP, lost));
    }
    let valid = (0..ROOM.2).map(|i| i64::from(i < ids.len())).collect();
    lists.whole("roadgraph_samples/valid", valid);
    ids.resize(ROOM.2, -1);
    kinds.resize(ROOM.2, -1);
    at.resize(3 * ROOM.2, NOTHING);
    along.resize(3 * ROOM.2, NOTHING);
    lists.whole("roadgraph_samples/id", ids);
    lists.whole("roadgraph_samples/type", kinds);
    lists.floats("roadgraph_samples/xyz", at);
    lists.floats("roadgraph_samples/dir", along);
}
