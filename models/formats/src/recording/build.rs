//! Scenes of a scenario, in order: one scene, or one for each 9.1 s of a recording that is too long for one.

use super::motion::{Derived, complete, spacing_s, step_at, track};
use super::{AgentIds, RecordedAgent, RecordedLight, RecordedState, middle};
use crate::format::{EGO, NOW_STEP, RECORDED_STEPS};
use crate::frame::Frame;
use crate::headings::{HeadingUnit, MOVES_MPS, Votes, said_wrapped};
use crate::limits::{MAX_AGENTS, MAX_SIGNALS, MAX_STEPS};
use crate::problem::{ImportWarning, Imported, ReadError};
use crate::refusals::{self, what};
use crate::repairs::checked;
use crate::sentences;
use scene::map::LaneMap;
use scene::wrap_angle;
use scene::{
    Agent, AgentFutures, Conditions, Future, Generated, MAX_COORDINATE_M, Meta, Origin, STEP_S, Scene,
    Shared, State, Timing, Vec2,
};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::f64::consts::TAU;

/// Samples of a road user within this time count as simultaneous, seconds.
const SAME_S: f64 = 1e-6;
/// Most scenes of one recording: one day.
const MAX_WINDOWS: usize = 10_000;
/// A file whose coordinates stay within this distance of its zero keeps its frame, metres.
const NEAR_M: f64 = 1_000.0;
/// Most samples of a scene document, and most futures of a road user in one sample.
const MAX_FUTURES: (usize, usize) = (256, 64);
/// Greatest speed along an axis, as of a track, m/s.
const MAX_SPEED_MPS: f64 = 150.0;

/// Description of a scenario in a file, without the motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Said {
    pub name: String,
    pub meta: Meta,
    /// Origin of the scene in the file's frame; derived when absent.
    pub origin: Option<Origin>,
    /// Projection of the file's frame, for a derived origin.
    pub crs: Option<String>,
    /// Time of the first step in the file, seconds; that of the first sample if absent.
    pub start_s: Option<f64>,
    pub timing: Option<Timing>,
    /// Time between samples, seconds; the most frequent one if absent.
    pub spacing_s: Option<f64>,
    /// Map about the origin.
    pub map: Shared<LaneMap>,
    /// Lights of lanes of the map; those beyond the limit are left out.
    pub lights: Vec<RecordedLight>,
    pub warnings: Vec<ImportWarning>,
}

/// A possible motion of a road user.
#[derive(Clone, Debug)]
pub(crate) struct RecordedFuture {
    /// Index of the road user.
    pub user: usize,
    /// Index of the sample in the file.
    pub sample: u64,
    pub mode: u64,
    pub probability: Option<f64>,
    pub chosen: bool,
    pub samples: Vec<RecordedState>,
}

/// Content of a scenario in a file.
#[derive(Default)]
pub(crate) struct Recording {
    pub said: Said,
    pub users: Vec<RecordedAgent>,
    pub futures: Vec<RecordedFuture>,
}

impl Recording {
    /// The scenes, each built on demand.
    pub fn scenes(mut self) -> impl Iterator<Item = Result<Imported, ReadError>> {
        let can_be = |time: &Timing| (1..=MAX_STEPS).contains(&time.steps) && time.now_step < time.steps;
        self.said.timing = self.said.timing.filter(can_be);
        for list in self.lists() {
            list.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        }
        self.said.warnings.extend(settle_headings(&mut self.users));
        let repeated: usize = self.users.iter().map(|user| repeated(&user.samples)).sum();
        if repeated > 0 {
            self.said.warnings.push(ImportWarning::new("rows-repeated", sentences::rows_repeated(repeated)));
        }
        let usual = || spacing_s(self.users.iter().map(|user| user.samples.as_slice()));
        let spacing_s = self.said.spacing_s.unwrap_or_else(usual);
        let mut derived = Derived::default();
        for list in self.lists() {
            let found = complete(list, spacing_s);
            derived.headings |= found.headings;
            derived.velocities |= found.velocities;
        }
        let times = |first: bool| {
            let lists = self.users.iter().map(|user| &user.samples);
            let logged = lists.filter_map(|list| if first { list.first() } else { list.last() });
            let drawn =
                self.futures.iter().filter_map(|f| if first { f.samples.first() } else { f.samples.last() });
            let logged: Vec<f64> = logged.map(|s| s.time_s).collect();
            if logged.is_empty() { drawn.map(|s| s.time_s).collect() } else { logged }
        };
        let first_s = times(true).into_iter().fold(f64::INFINITY, f64::min);
        let last_s = times(false).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let start_s = self.said.start_s.unwrap_or(if first_s.is_finite() { first_s } else { 0.0 });
        let steps = (((last_s - start_s) / STEP_S + 0.05).floor().max(0.0) as usize).saturating_add(1);
        let made = PreparedRecording { spacing_s, derived, start_s, recording: self };
        let steps = made.recording.said.timing.map_or(steps, |timing| timing.steps);
        made.windows(steps)
    }

    fn lists(&mut self) -> impl Iterator<Item = &mut Vec<RecordedState>> {
        let logged = self.users.iter_mut().map(|user| &mut user.samples);
        logged.chain(self.futures.iter_mut().map(|future| &mut future.samples))
    }
}

/// A recording with sorted and complete samples.
struct PreparedRecording {
    recording: Recording,
    spacing_s: f64,
    derived: Derived,
    start_s: f64,
}

impl PreparedRecording {
    fn windows(self, steps: usize) -> impl Iterator<Item = Result<Imported, ReadError>> {
        let windowed = steps > MAX_STEPS;
        let mut list: Vec<usize> = vec![0];
        if windowed {
            // Only windows with a road user count: pauses may have any length.
            let window_s = RECORDED_STEPS as f64 * STEP_S;
            let at =
                |s: &RecordedState| ((s.time_s - self.start_s) / window_s + 1e-6).floor().max(0.0) as usize;
            let samples = self.recording.users.iter().flat_map(|user| &user.samples);
            let windows: BTreeSet<usize> = samples.filter(|s| s.is_seen()).map(at).collect();
            list = windows.into_iter().collect();
        }
        let mut fault = (list.len() > MAX_WINDOWS)
            .then(|| ReadError::other_content(refusals::at_most(list.len(), what::SCENES, MAX_WINDOWS)));
        if fault.is_some() {
            list.clear();
        }
        let (mut given, count) = (false, list.len());
        let window = if windowed { RECORDED_STEPS } else { steps.max(1) };
        let mut scenes = list.into_iter().enumerate().filter_map(move |(k, i)| {
            let steps = window.min(steps.saturating_sub(i.saturating_mul(window))).max(1);
            // A single step at the end begins a window that was not recorded.
            let begun = steps == 1 && k > 0;
            let start_s = self.start_s + i as f64 * window as f64 * STEP_S;
            let scene = if begun { None } else { self.scene(start_s, steps, windowed) };
            given |= scene.is_some();
            let empty = || Some(Err(ReadError::other_content(refusals::file_has_no(what::ROAD_USER))));
            if k + 1 == count && !given { scene.or_else(empty) } else { scene }
        });
        std::iter::from_fn(move || fault.take().map(Err).or_else(|| scenes.next()))
    }

    fn scene(&self, start_s: f64, steps: usize, windowed: bool) -> Option<Result<Imported, ReadError>> {
        let said = &self.recording.said;
        let usual = Timing { steps, now_step: NOW_STEP.min(steps - 1) };
        let time = if windowed { usual } else { said.timing.unwrap_or(usual) };
        let now_s = start_s + time.now_step as f64 * STEP_S;
        let end_s = start_s + steps as f64 * STEP_S - STEP_S / 2.0;
        let mut warnings = said.warnings.clone();
        // First position of the first future of each road user.
        let mut drawn: HashMap<usize, Vec2> = HashMap::new();
        for future in self.recording.futures.iter().filter(|_| !windowed) {
            if let Some(first) = future.samples.iter().find(|s| s.is_seen()) {
                drawn.entry(future.user).or_insert(first.at);
            }
        }
        let unseen = Vec2::new(f64::NAN, f64::NAN);
        let mut present: Vec<(usize, Vec2)> = Vec::new();
        for (i, user) in self.recording.users.iter().enumerate() {
            let from = user.samples.partition_point(|s| s.time_s < start_s - STEP_S / 2.0);
            let within = user.samples.get(from..).unwrap_or_default().iter().take_while(|s| s.time_s < end_s);
            let near = |a: &&RecordedState, b: &&RecordedState| {
                (a.time_s - now_s).abs().total_cmp(&(b.time_s - now_s).abs())
            };
            let at = within.filter(|s| s.is_seen()).min_by(near).map(|s| s.at);
            match at {
                Some(at) => present.push((i, at)),
                // A whole scene includes road users that were never seen.
                None if !windowed => present.push((i, drawn.get(&i).copied().unwrap_or(unseen))),
                None => {}
            }
        }
        if present.is_empty() {
            return None;
        }
        let origin = said.origin.clone().unwrap_or_else(|| self.origin(&present));
        let frame = Frame::of(&origin);
        let kept = self.kept(&present, &origin, &mut warnings);
        let (mut ids, mut names) = (AgentIds::default(), HashMap::new());
        let (mut agents, mut assumed, mut resampled) = (Vec::new(), 0, false);
        for i in kept {
            let user = self.recording.users.get(i)?;
            let (track, filled) = track(&user.samples, start_s, steps, self.spacing_s, frame);
            if windowed && track.states.iter().all(Option::is_none) {
                continue;
            }
            resampled |= filled;
            let (size, measured) = user.size();
            assumed += usize::from(!measured);
            let id = ids.take(&user.id);
            names.insert(i, id.clone());
            agents.push(Agent {
                id,
                agent_type: user.agent_type,
                subtype: user.subtype,
                role: user.role.clone(),
                size,
                track: track.into(),
                conditions: Conditions::default(),
            });
        }
        if windowed && agents.is_empty() {
            return None;
        }
        self.warn(assumed, resampled || self.off_steps(start_s), ids.changed, windowed, &mut warnings);
        let generated = if windowed { None } else { self.generated(&names, start_s, frame, &mut warnings) };
        let name = if windowed { format!("{} {start_s:.1} s", said.name) } else { said.name.clone() };
        let timestamps_s = match &said.meta.timestamps_s {
            None if windowed => Some((0..steps).map(|i| start_s + i as f64 * STEP_S).collect()),
            said => said.clone().filter(|_| !windowed),
        };
        let named = |id: &String| {
            let at = self.recording.users.iter().position(|user| user.id == *id)?;
            names.get(&at).cloned()
        };
        let meta = Meta {
            origin,
            timestamps_s,
            objects_of_interest: said.meta.objects_of_interest.iter().filter_map(named).collect(),
            tracks_to_predict: (said.meta.tracks_to_predict.iter())
                .filter_map(|(id, hard)| Some((named(id)?, *hard)))
                .collect(),
            ..said.meta.clone()
        };
        let scene = Scene {
            id: None,
            name: name.chars().take(scene::MAX_NAME_CHARS).collect(),
            meta,
            time,
            map: said.map.clone(),
            signals: said.lights.iter().take(MAX_SIGNALS).map(|light| light.signal(start_s, steps)).collect(),
            agents,
            generated,
            extra: BTreeMap::new(),
        };
        Some(checked(scene, warnings))
    }

    /// The ego's position, otherwise zero if the file's coordinates are small, otherwise the middle of all
    /// road users; in whole metres.
    fn origin(&self, present: &[(usize, Vec2)]) -> Origin {
        let ego = |(i, at): &&(usize, Vec2)| {
            let is_ego = |user: &RecordedAgent| user.role.as_deref() == Some(EGO);
            at.x.is_finite() && self.recording.users.get(*i).is_some_and(is_ego)
        };
        let places = || present.iter().map(|(_, at)| *at).filter(|at| at.x.is_finite());
        let at = if places().all(|at| at.amax() <= NEAR_M) {
            Vec2::zeros()
        } else {
            present.iter().find(ego).map_or_else(|| middle(places()), |(_, at)| *at).map(f64::round)
        };
        Origin { x_m: at.x, y_m: at.y, crs: self.recording.said.crs.clone(), ..Origin::default() }
    }

    /// Road users that fit the scene, in the order of the file: those within reach of the origin and nearest
    /// to the middle of all.
    fn kept(
        &self,
        present: &[(usize, Vec2)],
        origin: &Origin,
        warnings: &mut Vec<ImportWarning>,
    ) -> Vec<usize> {
        let frame = Frame::of(origin);
        let far = |s: &RecordedState| s.is_seen() && frame.place_back(s.at).amax() > MAX_COORDINATE_M;
        let middle = middle(present.iter().map(|(_, at)| *at).filter(|at| at.x.is_finite()));
        let samples = |i: usize| self.recording.users.get(i).map_or(&[][..], |user| &user.samples);
        let is_ego =
            |i: usize| self.recording.users.get(i).is_some_and(|user| user.role.as_deref() == Some(EGO));
        let near = present.iter().filter(|(i, _)| !samples(*i).iter().any(far));
        let mut order: Vec<(bool, f64, usize)> =
            near.map(|(i, at)| (!is_ego(*i), (at - middle).norm(), *i)).collect();
        order.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        order.truncate(MAX_AGENTS);
        if order.len() < present.len() {
            let message = sentences::agents_near_centre(present.len(), order.len(), MAX_COORDINATE_M);
            warnings.push(ImportWarning::new("agents-dropped", message));
        }
        let mut kept: Vec<usize> = order.into_iter().map(|(.., i)| i).collect();
        kept.sort_unstable();
        kept
    }

    /// Whether a sample lies at no step of the scene.
    fn off_steps(&self, start_s: f64) -> bool {
        let samples = self.recording.users.iter().flat_map(|user| user.samples.iter());
        samples.take(10_000).any(|s| step_at(s.time_s, start_s).is_none())
    }

    fn warn(
        &self,
        assumed: usize,
        resampled: bool,
        ids_changed: usize,
        windowed: bool,
        to: &mut Vec<ImportWarning>,
    ) {
        let mut warn = |applies: bool, code, message| {
            if applies {
                to.push(ImportWarning::new(code, message));
            }
        };
        warn(assumed > 0, "sizes-assumed", sentences::sizes_assumed(assumed));
        warn(resampled, "time-resampled", sentences::time_resampled(self.spacing_s, STEP_S));
        warn(self.derived.headings, "headings-derived", sentences::headings_derived());
        warn(self.derived.velocities, "velocities-derived", sentences::velocities_derived());
        warn(ids_changed > 0, "ids-changed", sentences::ids_respelled(ids_changed));
        warn(windowed, "cut", sentences::cut_in_scenes(RECORDED_STEPS as f64 * STEP_S));
    }

    /// Possible motions as futures of a scene.
    fn generated(
        &self,
        names: &HashMap<usize, String>,
        start_s: f64,
        frame: Frame,
        warnings: &mut Vec<ImportWarning>,
    ) -> Option<Generated> {
        let mut samples: BTreeMap<u64, Futures<'_>> = BTreeMap::new();
        let mut dropped = 0;
        for drawn in &self.recording.futures {
            let Some(id) = names.get(&drawn.user) else { continue };
            // A future may go on after the end of the scene.
            let (track, _) = track(&drawn.samples, start_s, 2 * MAX_STEPS, self.spacing_s, frame);
            let states: Vec<State> = track.states.into_iter().map_while(|state| state).collect();
            let room = samples.len() < MAX_FUTURES.0 || samples.contains_key(&drawn.sample);
            if states.is_empty() || !states.iter().all(can_be) || !room {
                dropped += 1;
                continue;
            }
            let list = samples.entry(drawn.sample).or_default().entry(id.clone()).or_default();
            if list.len() >= MAX_FUTURES.1 {
                dropped += 1;
                continue;
            }
            list.push((drawn, Future::bare(drawn.probability.unwrap_or(f64::NAN), track.first_step, states)));
        }
        if dropped > 0 {
            warnings.push(ImportWarning::new("futures-dropped", sentences::futures_unread(dropped)));
        }
        let samples: Vec<scene::Sample> = samples.into_values().map(answer).collect();
        (!samples.is_empty()).then(|| Generated { samples, ..Generated::default() })
    }
}

/// Number of samples with the time of the previous sample; samples are sorted by time.
fn repeated(samples: &[RecordedState]) -> usize {
    samples.windows(2).filter(|pair| (pair[1].time_s - pair[0].time_s).abs() < SAME_S).count()
}

/// Converts headings to radians within one turn, as [`crate::headings::settle`] does for states.
fn settle_headings(users: &mut [RecordedAgent]) -> Option<ImportWarning> {
    let mut votes = Votes::default();
    for user in users.iter() {
        let samples = &user.samples;
        let way = |i: usize| {
            let (a, b) = (samples.get(i)?, samples.get(i + 1)?);
            let way = (b.at - a.at) / (b.time_s - a.time_s);
            Some(way).filter(|way| way.norm().is_finite() && way.norm() > MOVES_MPS)
        };
        votes.add(samples.iter().enumerate().map(|(i, sample)| (sample.heading_rad, way(i))));
    }
    if votes.is_quiet(HeadingUnit::Radians) {
        return None;
    }
    let samples = users.iter_mut().flat_map(|user| &mut user.samples);
    if votes.in_degrees(HeadingUnit::Radians) {
        samples.for_each(|sample| sample.heading_rad = sample.heading_rad.to_radians());
        return Some(votes.said_degrees());
    }
    let outside = samples.filter(|sample| sample.heading_rad.abs() > TAU);
    said_wrapped(outside.map(|sample| sample.heading_rad = wrap_angle(sample.heading_rad)).count())
}

/// Possible motions of a sample, by road user.
type Futures<'a> = BTreeMap<String, Vec<(&'a RecordedFuture, Future)>>;

/// Whether a future can have a state: futures may go a little beyond the range of tracks.
fn can_be(state: &State) -> bool {
    state.position().amax() <= 2.0 * MAX_COORDINATE_M && state.velocity().amax() <= MAX_SPEED_MPS
}

/// One sample for several road users; missing probabilities are equal.
fn answer(agents: Futures<'_>) -> scene::Sample {
    let of_agent = |mut list: Vec<(&RecordedFuture, Future)>| {
        list.sort_by_key(|(drawn, _)| drawn.mode);
        let even = 1.0 / list.len() as f64;
        for (_, future) in &mut list {
            if !(0.0..=1.0).contains(&future.probability) {
                future.probability = even;
            }
        }
        let by_belief =
            |a: &usize, b: &usize| list[*a].1.probability.total_cmp(&list[*b].1.probability).then(b.cmp(a));
        let likeliest = (0..list.len()).max_by(by_belief);
        let chosen = list.iter().position(|(drawn, _)| drawn.chosen).or(likeliest).unwrap_or(0);
        AgentFutures::of(chosen, list.into_iter().map(|(_, future)| future).collect())
    };
    let agents = agents.into_iter().map(|(id, list)| (id, of_agent(list))).collect();
    scene::Sample { agents, score: serde_json::Value::Null }
}
