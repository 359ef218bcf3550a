//! Turns FCD into scenes: consecutive windows of 9.1 s. Only the current window is in memory.

use super::formats::SOURCE;
use super::import_net::NetScene;
use super::kinds::{self, AgentKind};
use super::rows::{FcdItem, FcdRow, FcdRows};
use super::window::{Between, FcdState, MAX_FILLED_S, SAME_S, between, track};
use crate::format::{NOW_STEP, RECORDED_STEPS as STEPS};
use crate::limits::MAX_AGENTS;
use crate::problem::{FieldProblem, ImportWarning, Imported, ReadError, code};
use crate::recording::{AgentIds, middle};
use crate::refusals::{self, what};
use crate::repairs::checked;
use crate::sentences;
use scene::geometry::direction;
use scene::{
    Agent, AgentType, Conditions, MAX_COORDINATE_M, Meta, Origin, STEP_S, Scene, Shared, Timing, Vec2,
};
use std::collections::BTreeMap;

/// Most positions that one window may hold.
const MAX_SAMPLES: usize = 1_000_000;
/// Most road users of one window of which 256 are chosen.
const MAX_USERS: usize = 50_000;
/// Distance outside the network's bounding box up to which positions belong to it, metres.
const BESIDE_M: f64 = 500.0;

/// Network and licence that all scenes of a recording share.
pub(super) struct FcdContext {
    pub net: Option<NetScene>,
    pub licence: Option<String>,
}

/// One road user over the window.
struct FcdAgent {
    kind: AgentKind,
    /// Whether the file states its size.
    measured: bool,
    samples: Vec<FcdState>,
}

/// Persons and vehicles may share an id.
type Key = (String, bool);

/// Scenes of a recording, one per window with at least one road user.
pub(super) struct Windows<'a> {
    rows: FcdRows<'a>,
    common: FcdContext,
    users: BTreeMap<Key, FcdAgent>,
    samples: usize,
    /// Number and time of the current time step.
    step: u64,
    time_s: Option<f64>,
    first_s: f64,
    /// Number of the current window.
    window: u64,
    coarsest_s: f64,
    left_out: usize,
    heights: bool,
    given: bool,
    ended: bool,
}

impl<'a> Windows<'a> {
    pub fn new(rows: FcdRows<'a>, common: FcdContext) -> Self {
        Self {
            rows,
            common,
            users: BTreeMap::new(),
            samples: 0,
            step: 0,
            time_s: None,
            first_s: 0.0,
            window: 0,
            coarsest_s: 0.0,
            left_out: 0,
            heights: false,
            given: false,
            ended: false,
        }
    }

    fn start_s(&self) -> f64 {
        self.first_s + self.window as f64 * STEPS as f64 * STEP_S
    }

    /// The window of a time.
    fn window_of(&self, time_s: f64) -> u64 {
        // The conversion to an integer saturates: nothing is below zero.
        ((time_s - self.first_s + SAME_S) / (STEPS as f64 * STEP_S)).floor() as u64
    }

    /// Begins a time step; returns the window's scene if the previous step was its last.
    fn begin_step(&mut self, time_s: f64) -> Option<Result<Imported, ReadError>> {
        let Some(before_s) = self.time_s.replace(time_s) else {
            self.first_s = time_s;
            return None;
        };
        self.step += 1;
        let last_s = self.start_s() + (STEPS - 1) as f64 * STEP_S;
        // A pause past the window's end cannot be interpolated: the window then ends with its present
        // content.
        let filled = time_s - before_s <= MAX_FILLED_S + SAME_S;
        if before_s < last_s - SAME_S && (filled || time_s <= last_s + SAME_S) {
            self.coarsest_s = self.coarsest_s.max(time_s - before_s);
            return None;
        }
        let scene = self.scene(before_s);
        self.coarsest_s = time_s - before_s;
        // Windows without content are skipped at once.
        self.window = (self.window + 1).max(self.window_of(before_s));
        if !filled && before_s < self.start_s() {
            self.window = self.window.max(self.window_of(time_s));
        }
        let keep = self.step.saturating_sub(2);
        self.users.retain(|_, user| {
            user.samples.retain(|s| s.step >= keep);
            !user.samples.is_empty()
        });
        self.samples = self.users.values().map(|user| user.samples.len()).sum();
        scene
    }

    fn add(&mut self, row: FcdRow) -> Result<(), ReadError> {
        let Some(time_s) = self.time_s else { return Ok(()) };
        let users = self.users.len();
        let user = self.users.entry((row.id, row.person)).or_insert_with(|| {
            let mut kind = kinds::of(&row.type_name, row.person);
            let (length_m, width_m) = row.size_m;
            kind.size.length_m = length_m.unwrap_or(kind.size.length_m).min(60.0);
            kind.size.width_m = width_m.unwrap_or(kind.size.width_m).min(60.0);
            let measured = length_m.is_some() && width_m.is_some();
            let measured = measured || kinds::size_of(&row.type_name).is_some();
            FcdAgent { kind, measured, samples: Vec::new() }
        });
        // SUMO's point is the middle of the front bumper; that of a person is the centre.
        let on_foot = user.kind.agent_type == AgentType::Pedestrian;
        let back_m = if on_foot { 0.0 } else { user.kind.size.length_m / 2.0 };
        let centre = row.point - direction(row.heading_rad) * back_m;
        let sample = FcdState {
            step: self.step,
            time_s,
            centre,
            heading_rad: row.heading_rad,
            speed_mps: row.speed_mps,
        };
        // A row that is repeated in a step counts once.
        if user.samples.last().is_none_or(|last| last.step != self.step) {
            user.samples.push(sample);
            self.samples += 1;
        }
        let counts = [(self.samples, MAX_SAMPLES, what::POSITIONS), (users, MAX_USERS, what::ROAD_USERS)];
        if let Some((most, what)) = refusals::exceeded(&counts) {
            let message = refusals::positions_over_limit(most, what, STEPS as f64 * STEP_S);
            return Err(FieldProblem::new("", code::TOO_MANY_AGENTS, message).into());
        }
        Ok(())
    }

    /// The scene of the window up to a time; `None` without any road user in it.
    fn scene(&mut self, last_s: f64) -> Option<Result<Imported, ReadError>> {
        let start_s = self.start_s();
        let steps = ((last_s - start_s + SAME_S) / STEP_S).floor() as i64 + 1;
        let steps = usize::try_from(steps).unwrap_or(0).min(STEPS);
        // A single step at the end begins a window that was not recorded.
        if steps == 0 || (steps == 1 && self.given) {
            return None;
        }
        let end_s = start_s + (steps - 1) as f64 * STEP_S;
        let seen = |s: &&FcdState| s.time_s >= start_s - SAME_S && s.time_s <= end_s + SAME_S;
        let now_s = start_s + NOW_STEP.min(steps - 1) as f64 * STEP_S;
        let nearest = |user: &FcdAgent| {
            let near =
                |a: &&FcdState, b: &&FcdState| (a.time_s - now_s).abs().total_cmp(&(b.time_s - now_s).abs());
            user.samples.iter().filter(seen).min_by(near).map(|s| s.centre)
        };
        let present = |(key, user)| nearest(user).map(|at| (key, user, at));
        let all: Vec<(&Key, &FcdAgent, Vec2)> = self.users.iter().filter_map(present).collect();
        if all.is_empty() {
            return None;
        }
        let middle = middle(all.iter().map(|(_, _, at)| *at));
        let origin = self.common.net.as_ref().map_or(middle.map(f64::round), |net| net.origin);
        let mut warnings = self.common.net.as_ref().map_or_else(Vec::new, |net| net.warnings.clone());
        let kept = self.kept(&all, middle, origin, &mut warnings);
        let mut ids = AgentIds::default();
        let mut agents = Vec::new();
        let (mut assumed, mut jumps) = (0, 0);
        for (key, user) in kept {
            let track = track(&user.samples, start_s, steps, origin);
            if track.states.iter().all(Option::is_none) {
                continue;
            }
            assumed += usize::from(!user.measured);
            let pairs =
                user.samples.windows(2).filter(|w| matches!(w, [a, b] if between(a, b) == Between::Jump));
            jumps += pairs.count();
            agents.push(Agent {
                id: ids.take(&key.0),
                agent_type: user.kind.agent_type,
                subtype: user.kind.subtype,
                role: None,
                size: user.kind.size,
                track: track.into(),
                conditions: Conditions::default(),
            });
        }
        if agents.is_empty() {
            return None;
        }
        self.warn(assumed, jumps, ids.changed, &mut warnings);
        self.given = true;
        let scene = Scene {
            id: None,
            name: format!("FCD {start_s:.1} s"),
            meta: Meta {
                source: SOURCE.into(),
                licence: self.common.licence.clone(),
                origin: self.common.net.as_ref().map_or_else(
                    || Origin { x_m: origin.x, y_m: origin.y, ..Origin::default() },
                    |net| net.place.clone(),
                ),
                timestamps_s: (start_s != 0.0)
                    .then(|| (0..steps).map(|i| start_s + i as f64 * STEP_S).collect()),
                ..Meta::default()
            },
            time: Timing { steps, now_step: NOW_STEP.min(steps - 1) },
            map: self.common.net.as_ref().map_or_else(Shared::default, |net| net.map.clone()),
            signals: self.common.net.as_ref().map_or_else(Vec::new, |net| net.signals(start_s, steps)),
            agents,
            generated: None,
            extra: BTreeMap::new(),
        };
        Some(checked(scene, warnings))
    }

    /// Road users that fit the scene: those within reach of its origin and nearest to the middle of all.
    fn kept<'u>(
        &self,
        all: &[(&'u Key, &'u FcdAgent, Vec2)],
        middle: Vec2,
        origin: Vec2,
        warnings: &mut Vec<ImportWarning>,
    ) -> Vec<(&'u Key, &'u FcdAgent)> {
        if let Some(net) = &self.common.net {
            let beside =
                |(_, _, at): &&(&Key, &FcdAgent, Vec2)| ((at - net.origin).abs() - net.half).max() > BESIDE_M;
            let count = all.iter().filter(beside).count();
            if count > 0 {
                let message = sentences::agents_outside_network(count, all.len());
                warnings.push(ImportWarning::new("outside-network", message));
            }
        }
        let far = |s: &FcdState| (s.centre - origin).amax() > MAX_COORDINATE_M;
        let mut order: Vec<(f64, &Key, &FcdAgent)> = all
            .iter()
            .filter(|(_, user, _)| !user.samples.iter().any(far))
            .map(|(key, user, at)| ((at - middle).norm(), *key, *user))
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(b.1)));
        order.truncate(MAX_AGENTS);
        if order.len() < all.len() {
            let message = sentences::agents_near_centre(all.len(), order.len(), MAX_COORDINATE_M);
            warnings.push(ImportWarning::new("agents-dropped", message));
        }
        let mut kept: Vec<(&Key, &FcdAgent)> = order.into_iter().map(|(_, key, user)| (key, user)).collect();
        kept.sort_by(|a, b| a.0.cmp(b.0));
        kept
    }

    fn warn(&self, assumed: usize, jumps: usize, ids_changed: usize, warnings: &mut Vec<ImportWarning>) {
        let mut warn = |applies: bool, code, message| {
            if applies {
                warnings.push(ImportWarning::new(code, message));
            }
        };
        warn(self.common.net.is_none(), "no-network", sentences::network_missing());
        warn(assumed > 0, "sizes-assumed", sentences::sizes_assumed_by_name(assumed));
        warn(ids_changed > 0, "ids-changed", sentences::ids_respelled(ids_changed));
        warn(jumps > 0, "jumps", sentences::jumps(jumps));
        let coarse = self.coarsest_s > MAX_FILLED_S + SAME_S;
        warn(coarse, "steps-coarse", sentences::steps_coarse(self.coarsest_s, MAX_FILLED_S));
        warn(self.left_out > 0, "left-out", sentences::passengers_left_out(self.left_out));
        warn(self.heights, "heights-dropped", sentences::recording_heights_dropped());
    }

    /// The remaining scene at the end of the file; there may be another after it.
    fn finish(&mut self) -> Option<Result<Imported, ReadError>> {
        let last_s = self.time_s?;
        while !self.ended {
            let scene = self.scene(last_s);
            let last_window = self.window_of(last_s);
            self.ended = last_window <= self.window;
            self.window = last_window;
            if scene.is_some() {
                return scene;
            }
        }
        None
    }

    fn advance(&mut self) -> Option<Result<Imported, ReadError>> {
        loop {
            let item = match self.rows.next() {
                Ok(Some(item)) => item,
                Ok(None) => {
                    if let Some(scene) = self.finish() {
                        return Some(scene);
                    }
                    let empty = || ReadError::other_content(refusals::file_has_no(what::ROAD_USER));
                    self.ended = true;
                    return (!self.given).then(|| Err(empty()));
                }
                Err(error) => {
                    self.ended = true;
                    return Some(Err(error));
                }
            };
            match item {
                FcdItem::Step(time_s) => {
                    if let Some(scene) = self.begin_step(time_s) {
                        return Some(scene);
                    }
                }
                FcdItem::Row(row) => {
                    if let Err(error) = self.add(row) {
                        self.ended = true;
                        return Some(Err(error));
                    }
                }
                FcdItem::LeftOut => self.left_out += 1,
                FcdItem::Height => self.heights = true,
            }
        }
    }
}

impl Iterator for Windows<'_> {
    type Item = Result<Imported, ReadError>;

    /// After a fault of the file nothing follows.
    fn next(&mut self) -> Option<Self::Item> {
        if self.ended { None } else { self.advance() }
    }
}
