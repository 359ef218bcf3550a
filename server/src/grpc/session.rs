//! One session: the scene that a caller described and, from its first query on, a run in it.

use super::messages::{LoggedObject, ObjectMotion, SessionBegin};
use super::motion::{self, PlanePose};
use api::{Code, Problem};
use experts::{Cancel, EgoState, Generator, Run, RunSettings};
use formats::native::MAX_SAFE_INTEGER;
use scene::{
    Agent, AgentType, MAX_AGENTS, MAX_STEPS, STEP_S, Scene, Signal, Size, State, Subtype, Timing, Track,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Length of a step, microseconds.
const STEP_US: u64 = 100_000;
/// Largest delay after a step at which a query still refers to that step, microseconds.
const SLACK_US: u64 = 1_000;
/// Latest handover, so that no sum of times overflows, microseconds.
const LATEST_US: u64 = 1 << 62;
/// Smallest and greatest extent of a box, metres.
const EXTENT_M: (f64, f64) = (0.2, 30.0);

/// A road user of the caller.
struct SessionObject {
    /// Name used by the caller.
    name: String,
    /// Id in the scene.
    id: String,
    /// Height of its last pose, metres.
    z_m: f64,
    /// Its recording.
    logged: Vec<PlanePose>,
}

/// An open session.
pub struct TrafficSession {
    scene: Arc<Scene>,
    objects: Vec<SessionObject>,
    /// Time of the first step of the scene, microseconds.
    origin_us: u64,
    handover_us: u64,
    seed: u64,
    run: Option<SessionRun>,
}

/// States of all road users after a step.
#[derive(Clone)]
struct SessionMoment {
    number: u64,
    states: BTreeMap<String, State>,
}

/// A run with its last two steps.
struct SessionRun {
    run: Run,
    /// Names of the road users that the caller drives, with their motion so far.
    egos: BTreeMap<String, Vec<PlanePose>>,
    before: SessionMoment,
    present: SessionMoment,
}

impl TrafficSession {
    /// The session of a request, on the map of a scene.
    ///
    /// # Errors
    /// Every fault of the road users and the times.
    pub fn begin(request: &SessionBegin, base: &Scene) -> Result<Self, Problem> {
        let asked = &request.logged_object_trajectories;
        if asked.len() > MAX_AGENTS {
            let detail = format!("{} road users; at most {MAX_AGENTS} expected", asked.len());
            return Err(Problem::new(Code::TooManyAgents, detail).limit(MAX_AGENTS as u64));
        }
        let mut logs = Vec::new();
        for object in asked {
            let poses = motion::poses(object.trajectory.as_ref()).ok_or_else(|| {
                refused(&object.object_id, "poses within 10 km of the origin, by rising time, expected")
            })?;
            logs.push(poses);
        }
        if request.handover_time_us > LATEST_US {
            let (latest, got) = (LATEST_US as f64, request.handover_time_us as f64);
            return Err(Problem::range("/handover_time_us", 0.0, latest, got));
        }
        let first = logs.iter().flatten().map(|pose| pose.at_us).min();
        let handover_us = request.handover_time_us;
        let origin_us = first.unwrap_or(handover_us).min(handover_us);
        let last = logs.iter().flatten().map(|pose| pose.at_us).max().unwrap_or(handover_us).max(handover_us);
        let start_step = (handover_us - origin_us).div_ceil(STEP_US) as usize;
        if start_step >= MAX_STEPS {
            let most_s = (MAX_STEPS - 1) as f64 * STEP_S;
            return Err(Problem::range("/handover_time_us", 0.0, most_s, start_step as f64 * STEP_S));
        }
        let steps = ((last - origin_us).div_ceil(STEP_US) as usize + 1).clamp(start_step + 1, MAX_STEPS);
        // Aligns the handover with a step.
        let origin_us = handover_us.saturating_sub(start_step as u64 * STEP_US);
        let mut objects = Vec::new();
        let mut agents = Vec::new();
        for (number, (object, logged)) in asked.iter().zip(logs).enumerate() {
            let id =
                if is_id(&object.object_id) { object.object_id.clone() } else { format!("object-{number}") };
            agents.push(agent(&id, object, &logged, origin_us, steps));
            let z_m = logged.last().map_or(0.0, |pose| pose.z_m);
            objects.push(SessionObject { name: object.object_id.clone(), id, z_m, logged });
        }
        let scene = Scene {
            signals: signals(&base.signals, steps),
            time: Timing { steps, now_step: start_step },
            ..Scene::bare(&base.name, scene::LaneMap::default(), agents)
        };
        let scene = Scene { map: base.map.clone(), ..scene };
        let scene = scene.checked().map_err(|faults| {
            let words = faults.iter().map(|fault| format!("{}: {}", fault.at, fault.message));
            Problem::new(Code::InvalidField, words.collect::<Vec<_>>().join("; "))
        })?;
        let (scene, seed) = (Arc::new(scene), request.random_seed % (MAX_SAFE_INTEGER + 1));
        Ok(Self { scene, objects, origin_us, handover_us, seed, run: None })
    }

    /// The described scene.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Positions at a time of the road users that the caller does not drive. The first query determines which
    /// road users the caller drives: later ones name the same.
    ///
    /// # Errors
    /// An unknown road user, a time before an earlier one, or a missing pose of one that the caller drives.
    pub fn simulate(
        &mut self,
        time_us: u64,
        updates: &[ObjectMotion],
        generator: &Generator,
        cancel: &Cancel,
    ) -> Result<Vec<ObjectMotion>, Problem> {
        let updates = self.updates(updates)?;
        if self.run.is_none() {
            self.run = Some(self.begun(&updates, generator, cancel)?);
        }
        let run = self.run.as_mut().ok_or_else(|| Problem::internal("a session without its run"))?;
        for (name, poses) in updates {
            let known = run.egos.get_mut(&name).ok_or_else(|| {
                refused(&name, "the caller drives those that its first question named, and no others")
            })?;
            merge(known, poses);
        }
        let (start_step, origin_us) = (run.run.settings().start_step as u64, self.origin_us);
        let at_us = |number: u64| origin_us + (start_step + number) * STEP_US;
        let most_us = at_us(MAX_STEPS as u64);
        if time_us > most_us {
            let seconds = |us: u64| us.saturating_sub(origin_us) as f64 * 1e-6;
            return Err(Problem::range("/time_query_us", 0.0, seconds(most_us), seconds(time_us)));
        }
        let to_do = (run.present.number..).take_while(|number| at_us(*number) + SLACK_US < time_us);
        let egos = to_do.map(|number| run.egos_at(at_us(number + 1), &self.objects));
        // All poses are checked before the first step, so a query that lacks one changes nothing.
        for egos in egos.collect::<Result<Vec<_>, Problem>>()? {
            let step = run.run.step(generator, &egos, cancel)?;
            let present = SessionMoment { number: step.number, states: step.states.into_iter().collect() };
            run.before = std::mem::replace(&mut run.present, present);
        }
        let (from_us, to_us) = (at_us(run.before.number), at_us(run.present.number));
        if time_us + SLACK_US < from_us {
            let detail = format!("{time_us} us is before {from_us} us, which was asked for already");
            return Err(Problem::field("/time_query_us", Code::StepOrder, detail));
        }
        let share = match to_us - from_us {
            0 => 1.0,
            span => (time_us.saturating_sub(from_us) as f64 / span as f64).min(1.0),
        };
        let there = self.objects.iter().filter(|object| !run.egos.contains_key(&object.name));
        let replies = there.filter_map(|object| {
            let after = run.present.states.get(&object.id);
            let before = run.before.states.get(&object.id).or(after)?;
            let pose = motion::between(before, after.unwrap_or(before), share, time_us, object.z_m);
            Some(motion::reply(&object.name, &pose))
        });
        Ok(replies.collect())
    }

    /// The poses of a query, by the caller's names.
    fn updates(&self, updates: &[ObjectMotion]) -> Result<BTreeMap<String, Vec<PlanePose>>, Problem> {
        let mut known = BTreeMap::new();
        for update in updates {
            let name = &update.object_id;
            if !self.objects.iter().any(|object| object.name == *name) {
                return Err(refused(name, "the session has no such road user"));
            }
            let poses = motion::poses(update.trajectory.as_ref());
            let poses = poses.ok_or_else(|| refused(name, "poses by rising time expected"))?;
            known.insert(name.clone(), poses);
        }
        Ok(known)
    }

    fn begun(
        &self,
        updates: &BTreeMap<String, Vec<PlanePose>>,
        generator: &Generator,
        cancel: &Cancel,
    ) -> Result<SessionRun, Problem> {
        let driven = self.objects.iter().filter(|object| updates.contains_key(&object.name));
        let ids: Vec<String> = driven.clone().map(|object| object.id.clone()).collect();
        let start_step = (self.handover_us - self.origin_us).div_ceil(STEP_US) as usize;
        let settings = RunSettings { seed: self.seed, start_step, ..RunSettings::default() };
        let run = Run::new(Arc::clone(&self.scene), &ids, settings, generator, cancel)?;
        let egos = driven.map(|object| (object.name.clone(), object.logged.clone())).collect();
        let there = run.present();
        let present = SessionMoment { number: there.number, states: there.states.into_iter().collect() };
        Ok(SessionRun { run, egos, before: present.clone(), present })
    }
}

impl SessionRun {
    /// States at a time of the road users that the caller drives.
    fn egos_at(&self, at_us: u64, objects: &[SessionObject]) -> Result<Vec<EgoState>, Problem> {
        let mut states = Vec::new();
        for object in objects {
            let Some(poses) = self.egos.get(&object.name) else { continue };
            let known = motion::at(poses, at_us);
            let pose = known.ok_or_else(|| refused(&object.name, &format!("no pose at {at_us} us")))?;
            let then_us = at_us.saturating_sub(STEP_US);
            let before = motion::at(poses, then_us).unwrap_or(pose);
            let state = motion::state(&pose, &before, (at_us - then_us) as f64 * 1e-6);
            states.push(EgoState::new(&object.id, state));
        }
        Ok(states)
    }
}

/// Adds poses; they replace known ones of the same or a later time.
fn merge(known: &mut Vec<PlanePose>, poses: Vec<PlanePose>) {
    if let Some(first) = poses.first() {
        known.retain(|pose| pose.at_us < first.at_us);
    }
    known.extend(poses);
}

fn refused(name: &str, what: &str) -> Problem {
    let shown: String = name.chars().take(64).collect();
    Problem::new(Code::InvalidField, format!("road user \"{shown}\": {what}"))
}

fn is_id(name: &str) -> bool {
    (1..=64).contains(&name.len()) && name.chars().all(|c| c.is_ascii_alphanumeric() || "_.:-".contains(c))
}

/// The signals of the scene, within its new duration.
fn signals(signals: &[Signal], steps: usize) -> Vec<Signal> {
    let within = |signal: &Signal| {
        let runs: Vec<_> = signal.runs.iter().copied().filter(|(first, _)| *first < steps).collect();
        (!runs.is_empty()).then(|| Signal { runs, ..signal.clone() })
    };
    signals.iter().filter_map(within).collect()
}

/// A road user of the scene, with its recording at each step.
fn agent(id: &str, object: &LoggedObject, logged: &[PlanePose], origin_us: u64, steps: usize) -> Agent {
    let stands = object.is_static || logged.len() == 1;
    let pose = |step: usize| {
        let at_us = origin_us + step as u64 * STEP_US;
        if stands { logged.first().copied() } else { motion::at(logged, at_us) }
    };
    let at_step = |step: usize| {
        let own = pose(step)?;
        let (before, after) = (step.checked_sub(1).and_then(pose), pose(step + 1));
        let (from, to) = (before.unwrap_or(own), if before.is_some() { own } else { after.unwrap_or(own) });
        let State { vx_mps, vy_mps, .. } = motion::state(&to, &from, STEP_S);
        Some(State { vx_mps, vy_mps, ..motion::state(&own, &own, STEP_S) })
    };
    let states: Vec<Option<State>> = (0..steps).map(at_step).collect();
    let (agent_type, subtype) = kind(&object.label_class);
    let mut agent = Agent::bare(id, agent_type, subtype, Vec::new());
    if let Some(extent) = object.aabb {
        let [length_m, width_m, height_m] = [extent.size_x, extent.size_y, extent.size_z].map(f64::from);
        let held =
            |value: f64| if value.is_finite() { value.clamp(EXTENT_M.0, EXTENT_M.1) } else { EXTENT_M.0 };
        agent.size =
            Size { length_m: held(length_m), width_m: held(width_m), height_m: Some(held(height_m)) };
    }
    agent.track = Track { first_step: 0, states, z_m: None }.into();
    agent
}

/// Type of a road user from the class in its label.
fn kind(label: &str) -> (AgentType, Subtype) {
    let label = label.to_ascii_lowercase();
    let is = |words: &[&str]| words.iter().any(|word| label.contains(word));
    match () {
        () if is(&["person", "pedestrian", "stroller"]) => (AgentType::Pedestrian, Subtype::Adult),
        () if is(&["motorcycle"]) => (AgentType::Vehicle, Subtype::Motorcycle),
        () if is(&["rider", "cycl", "bicycle"]) => (AgentType::Cyclist, Subtype::Bicycle),
        () if is(&["truck"]) => (AgentType::Vehicle, Subtype::Truck),
        () if is(&["bus"]) => (AgentType::Vehicle, Subtype::Bus),
        () if is(&["trailer"]) => (AgentType::Vehicle, Subtype::Trailer),
        () if is(&["object", "animal", "train"]) => (AgentType::Other, Subtype::Unknown),
        () => (AgentType::Vehicle, Subtype::Car),
    }
}
