//! Converts conditions from document to domain: every field is checked, and goals are converted to the scene
//! frame.

use super::conditions::{ConditionsDoc, GoalDoc, GoalFrame, GoalRelationDoc, StartDoc, VelocityDoc, ViaDoc};
use crate::problem::{FieldProblem, Problems, code};
use crate::refusals::{self, at_most, expected, wanted, what};
use scene::geometry::rotate;
use scene::message::Word;
use scene::{
    AgentType, Conditions, DEFAULT_VIA_TOLERANCE_M, Goal, MAX_CROSSED_EDGES, MAX_VIAS, STEP_S, Start, State,
    VIA_TOLERANCE_M, Vec2, Via, wrap_angle,
};
use serde::Serialize;

pub use crate::limits::MAX_GOAL_DISTANCE_M;
/// Greatest distance of a coordinate from the scene's origin, metres.
pub const MAX_COORDINATE_M: f64 = 10_000.0;
/// Below this speed a velocity gives no heading, m/s.
const HEADING_SPEED_MPS: f64 = 0.05;
const ANGLE_RAD: (f64, f64) = (-1_000.0, 1_000.0);
const COORDINATE_M: (f64, f64) = (-MAX_COORDINATE_M, MAX_COORDINATE_M);

/// Ranges of the sizes and speeds of one agent type; both ends are included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, schemars::JsonSchema)]
#[schemars(rename = "ConditionRange")]
pub struct Ranges {
    /// Metres.
    pub length_m: (f64, f64),
    /// Metres.
    pub width_m: (f64, f64),
    /// m/s; also the norm of a velocity.
    pub speed_mps: (f64, f64),
}

impl Ranges {
    /// The ranges of a type; `other` has those of vehicles.
    pub fn of(agent_type: AgentType) -> Self {
        match agent_type {
            AgentType::Vehicle | AgentType::Other => {
                Self { length_m: (1.5, 25.0), width_m: (0.5, 4.0), speed_mps: (0.0, 60.0) }
            }
            AgentType::Pedestrian => {
                Self { length_m: (0.2, 2.0), width_m: (0.2, 2.0), speed_mps: (0.0, 12.0) }
            }
            AgentType::Cyclist => Self { length_m: (0.5, 3.5), width_m: (0.2, 1.5), speed_mps: (0.0, 25.0) },
        }
    }
}

/// Time window of a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Scene time of the start, seconds.
    pub start_s: f64,
    /// Length, seconds.
    pub horizon_s: f64,
}

impl Default for Window {
    /// The widest window of any scene: for stored conditions without a request.
    fn default() -> Self {
        Self { start_s: 0.0, horizon_s: 80.0 }
    }
}

/// Context in which conditions are read.
#[derive(Clone, Copy, Debug)]
pub struct Context {
    /// The road user's own type.
    pub agent_type: AgentType,
    /// Its logged state at the window's start, if there is one.
    pub start: Option<State>,
    /// Bounds of the goal's time.
    pub window: Window,
}

impl ConditionsDoc {
    /// Checks every field and converts the goal to the scene frame. `pointer` is the place of this document
    /// in the request, such as `/conditions/12`.
    ///
    /// # Errors
    /// All faults except those that need a scene (ids of road edges and of other road users):
    /// `half-position`, `out-of-range`, `invalid-field`, and `start-missing` when a goal of frame `agent` has
    /// no start pose as its reference.
    pub fn resolve(&self, pointer: &str, context: &Context) -> Result<Conditions, Vec<FieldProblem>> {
        let mut problems = Problems::default();
        if self.agent_type == Some(AgentType::Other) {
            problems.invalid(format!("{pointer}/type"), expected(wanted::AGENT_TYPE));
        }
        let reader = ConditionReader { ranges: Ranges::of(self.agent_type.unwrap_or(context.agent_type)) };
        let size = |name: &str, value: Option<f64>, range, problems: &mut Problems| {
            value.filter(|v| problems.range(&format!("{pointer}/{name}"), range, *v))
        };
        let length_m = size("length_m", self.length_m, reader.ranges.length_m, &mut problems);
        let width_m = size("width_m", self.width_m, reader.ranges.width_m, &mut problems);
        let start = match &self.start {
            Some(doc) => reader.start(&format!("{pointer}/start"), doc, &mut problems),
            None => Start::default(),
        };
        let origin = Pose {
            position: start.position.or(context.start.map(|s| s.position())),
            heading_rad: start.heading_rad.or(context.start.map(|s| s.heading_rad)),
        };
        let goal = match &self.goal {
            Some(doc) => {
                let pointer = format!("{pointer}/goal");
                let agent_frame = self.frame == Some(GoalFrame::Agent);
                let goal = if agent_frame {
                    reader.agent_goal(&pointer, doc, &origin, &mut problems)
                } else {
                    reader.scene_goal(&pointer, doc, &origin, &mut problems)
                };
                let time_s = doc.time_s.and_then(|t| goal_time(&pointer, t, context.window, &mut problems));
                Goal { time_s, ..goal }
            }
            None => Goal::default(),
        };
        let relation = self.goal.as_ref().and_then(|doc| {
            doc.relation.as_ref()?.resolve(&format!("{pointer}/goal/relation"), doc, &mut problems)
        });
        let may_cross = self.goal.as_ref().map_or_else(Vec::new, |doc| doc.may_cross.clone());
        if may_cross.len() > MAX_CROSSED_EDGES {
            let message = at_most(may_cross.len(), what::IDS, MAX_CROSSED_EDGES);
            problems.invalid(format!("{pointer}/goal/may_cross"), message);
        }
        let window = context.window;
        let via = self.vias(&format!("{pointer}/via"), origin.position, goal.time_s, window, &mut problems);
        if problems.0.is_empty() {
            let agent_type = self.agent_type;
            Ok(Conditions { agent_type, length_m, width_m, start, goal, relation, may_cross, via })
        } else {
            Err(problems.0)
        }
    }

    /// Via points, each within reach of the start and later than the previous one; `due_s` is the goal's
    /// time.
    fn vias(
        &self,
        pointer: &str,
        start: Option<Vec2>,
        due_s: Option<f64>,
        window: Window,
        problems: &mut Problems,
    ) -> Vec<Via> {
        if self.via.len() > MAX_VIAS {
            problems.invalid(pointer, at_most(self.via.len(), what::VIA_POINTS, MAX_VIAS));
            return Vec::new();
        }
        let mut before_s = f64::NEG_INFINITY;
        let mut read = |(k, doc): (usize, &ViaDoc)| {
            let pointer = format!("{pointer}/{k}");
            let names = ("x_m", "y_m", COORDINATE_M);
            let position = pair(&pointer, names, (Some(doc.x_m), Some(doc.y_m)), problems)?;
            if let Some(start) = start {
                check_distance(
                    &format!("{pointer}/x_m"),
                    what::VIA_POINT,
                    (position - start).norm(),
                    problems,
                );
            }
            let tolerance_m = doc.tolerance_m.unwrap_or(DEFAULT_VIA_TOLERANCE_M);
            problems.range(&format!("{pointer}/tolerance_m"), VIA_TOLERANCE_M, tolerance_m);
            let time_s = doc.time_s.and_then(|t| goal_time(&pointer, t, window, problems));
            if let Some(time_s) = time_s {
                if time_s <= before_s {
                    problems.invalid(format!("{pointer}/time_s"), expected(wanted::AFTER_VIA));
                }
                if due_s.is_some_and(|due_s| time_s >= due_s) {
                    problems.invalid(format!("{pointer}/time_s"), expected(wanted::BEFORE_GOAL));
                }
                before_s = time_s;
            }
            Some(Via { position, tolerance_m, time_s })
        };
        self.via.iter().enumerate().filter_map(&mut read).collect()
    }

    /// The document of domain conditions, in the scene frame.
    pub fn from_conditions(conditions: &Conditions) -> Self {
        let Conditions { agent_type, length_m, width_m, start, goal, relation, may_cross, via } = conditions;
        let start_doc = StartDoc {
            x_m: start.position.map(|p| p.x),
            y_m: start.position.map(|p| p.y),
            heading_rad: start.heading_rad,
            speed_mps: start.speed_mps,
            velocity: None,
        };
        let goal_doc = GoalDoc {
            x_m: goal.position.map(|p| p.x),
            y_m: goal.position.map(|p| p.y),
            heading_rad: goal.heading_rad,
            speed_mps: goal.speed_mps,
            time_s: goal.time_s,
            may_cross: may_cross.clone(),
            relation: relation.as_ref().map(GoalRelationDoc::from),
            ..GoalDoc::default()
        };
        Self {
            agent_type: *agent_type,
            length_m: *length_m,
            width_m: *width_m,
            start: (start_doc != StartDoc::default()).then_some(start_doc),
            goal: (goal_doc != GoalDoc::default()).then_some(goal_doc),
            via: via.iter().map(ViaDoc::from).collect(),
            frame: None,
        }
    }
}

impl From<&Via> for ViaDoc {
    fn from(via: &Via) -> Self {
        let Via { position, tolerance_m, time_s } = *via;
        Self { x_m: position.x, y_m: position.y, tolerance_m: Some(tolerance_m), time_s }
    }
}

/// Checks a goal's time against a window and snaps it to the step.
pub fn check_goal_time(pointer: &str, time_s: f64, window: Window) -> Result<f64, FieldProblem> {
    let snapped = (time_s / STEP_S).round() / (1.0 / STEP_S).round();
    let (min, max) = (window.start_s + 0.5, window.start_s + window.horizon_s);
    if snapped >= min - 1e-6 && snapped <= max + 1e-6 {
        Ok(snapped)
    } else {
        Err(FieldProblem::range(pointer, round_s(min), round_s(max), time_s))
    }
}

fn round_s(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

fn goal_time(pointer: &str, time_s: f64, window: Window, problems: &mut Problems) -> Option<f64> {
    check_goal_time(&format!("{pointer}/time_s"), time_s, window).map_err(|p| problems.push(p)).ok()
}

/// Start pose as far as it is known.
struct Pose {
    position: Option<Vec2>,
    heading_rad: Option<f64>,
}

struct ConditionReader {
    ranges: Ranges,
}

impl ConditionReader {
    fn start(&self, pointer: &str, doc: &StartDoc, problems: &mut Problems) -> Start {
        let names = ("x_m", "y_m", COORDINATE_M);
        let position = pair(pointer, names, (doc.x_m, doc.y_m), problems);
        let heading = angle(&format!("{pointer}/heading_rad"), doc.heading_rad, problems);
        let (speed_mps, course) =
            self.speed(pointer, doc.speed_mps, doc.velocity.as_ref(), GoalFrame::Scene, problems);
        Start { position, heading_rad: heading.or(course), speed_mps }
    }

    fn scene_goal(&self, pointer: &str, doc: &GoalDoc, origin: &Pose, problems: &mut Problems) -> Goal {
        let foreign = [("ahead_m", doc.ahead_m), ("left_m", doc.left_m), ("turn_rad", doc.turn_rad)];
        refuse(pointer, &foreign, GoalFrame::Agent, problems);
        let position = pair(pointer, ("x_m", "y_m", COORDINATE_M), (doc.x_m, doc.y_m), problems);
        if let (Some(goal), Some(start)) = (position, origin.position) {
            check_distance(&format!("{pointer}/x_m"), what::GOAL, (goal - start).norm(), problems);
        }
        let heading = angle(&format!("{pointer}/heading_rad"), doc.heading_rad, problems);
        let (speed_mps, course) =
            self.speed(pointer, doc.speed_mps, doc.velocity.as_ref(), GoalFrame::Scene, problems);
        Goal { position, heading_rad: heading.or(course), speed_mps, time_s: None }
    }

    fn agent_goal(&self, pointer: &str, doc: &GoalDoc, origin: &Pose, problems: &mut Problems) -> Goal {
        let foreign = [("x_m", doc.x_m), ("y_m", doc.y_m), ("heading_rad", doc.heading_rad)];
        refuse(pointer, &foreign, GoalFrame::Scene, problems);
        let range = (-MAX_GOAL_DISTANCE_M, MAX_GOAL_DISTANCE_M);
        let offset = pair(pointer, ("ahead_m", "left_m", range), (doc.ahead_m, doc.left_m), problems);
        let turn = angle(&format!("{pointer}/turn_rad"), doc.turn_rad, problems);
        let (speed_mps, course) =
            self.speed(pointer, doc.speed_mps, doc.velocity.as_ref(), GoalFrame::Agent, problems);
        let turn = turn.or(course);
        let needs_pose = offset.is_some() || turn.is_some();
        let missing = origin.heading_rad.is_none() || (offset.is_some() && origin.position.is_none());
        if needs_pose && missing {
            let message = refusals::needs("\"frame\": \"agent\"", wanted::START_POSE);
            problems.push(FieldProblem::new(pointer, code::START_MISSING, message));
        }
        let heading = origin.heading_rad.unwrap_or(0.0);
        let position = match (offset, origin.position) {
            (Some(offset), Some(start)) => {
                check_distance(&format!("{pointer}/ahead_m"), what::GOAL, offset.norm(), problems);
                let goal = start + rotate(offset, heading);
                let far = goal.x.abs().max(goal.y.abs());
                problems.range(&format!("{pointer}/ahead_m"), COORDINATE_M, far).then_some(goal)
            }
            _ => None,
        };
        Goal { position, heading_rad: turn.map(|t| wrap(heading + t)), speed_mps, time_s: None }
    }

    /// Speed, and the direction of a velocity that is fast enough to define one.
    fn speed(
        &self,
        pointer: &str,
        speed: Option<f64>,
        velocity: Option<&VelocityDoc>,
        frame: GoalFrame,
        problems: &mut Problems,
    ) -> (Option<f64>, Option<f64>) {
        let Some(velocity) = velocity else {
            let speed =
                speed.filter(|v| problems.range(&format!("{pointer}/speed_mps"), self.ranges.speed_mps, *v));
            return (speed.map(|v| v + 0.0), None);
        };
        let pointer_v = format!("{pointer}/velocity");
        if speed.is_some() {
            problems.invalid(&pointer_v, refusals::not_both("speed_mps", "velocity"));
        }
        let scene = [("x_mps", velocity.x_mps), ("y_mps", velocity.y_mps)];
        let agent = [("ahead_mps", velocity.ahead_mps), ("left_mps", velocity.left_mps)];
        let (own, foreign, other) = match frame {
            GoalFrame::Scene => (scene, agent, GoalFrame::Agent),
            GoalFrame::Agent => (agent, scene, GoalFrame::Scene),
        };
        refuse(&pointer_v, &foreign, other, problems);
        let [(first, a), (second, b)] = own;
        let (Some(a), Some(b)) = (a, b) else {
            if a.is_some() || b.is_some() || foreign.iter().all(|f| f.1.is_none()) {
                problems.invalid(&pointer_v, expected(format!("{first}, {second}")));
            }
            return (None, None);
        };
        let norm = a.hypot(b);
        if !problems.range(&pointer_v, self.ranges.speed_mps, norm) {
            return (None, None);
        }
        (Some(norm), (norm >= HEADING_SPEED_MPS).then(|| wrap(b.atan2(a))))
    }
}

fn refuse(pointer: &str, members: &[(&str, Option<f64>)], frame: GoalFrame, problems: &mut Problems) {
    let needed = match frame {
        GoalFrame::Scene => "\"frame\": \"scene\"",
        GoalFrame::Agent => "\"frame\": \"agent\"",
    };
    for (name, _) in members.iter().filter(|m| m.1.is_some()) {
        problems.invalid(format!("{pointer}/{name}"), refusals::needs(name, needed));
    }
}

fn pair(
    pointer: &str,
    (first, second, range): (&str, &str, (f64, f64)),
    values: (Option<f64>, Option<f64>),
    problems: &mut Problems,
) -> Option<Vec2> {
    match values {
        (Some(a), Some(b)) => {
            let a_fits = problems.range(&format!("{pointer}/{first}"), range, a);
            let b_fits = problems.range(&format!("{pointer}/{second}"), range, b);
            // Adding zero turns -0.0 into 0.0.
            (a_fits && b_fits).then(|| Vec2::new(a + 0.0, b + 0.0))
        }
        (None, None) => None,
        (given, _) => {
            let (has, lacks) = if given.is_some() { (first, second) } else { (second, first) };
            let message = refusals::both_or_neither(has, lacks);
            problems.push(FieldProblem::new(format!("{pointer}/{has}"), code::HALF_POSITION, message));
            None
        }
    }
}

fn angle(pointer: &str, value: Option<f64>, problems: &mut Problems) -> Option<f64> {
    value.filter(|v| problems.range(pointer, ANGLE_RAD, *v)).map(wrap)
}

/// Wraps an angle; one within [-pi, pi) is unchanged, bit for bit.
fn wrap(value: f64) -> f64 {
    let inside = (-std::f64::consts::PI..std::f64::consts::PI).contains(&value);
    if inside { value + 0.0 } else { wrap_angle(value) }
}

fn check_distance(pointer: &str, what: Word, distance_m: f64, problems: &mut Problems) {
    if distance_m > MAX_GOAL_DISTANCE_M {
        let message = refusals::too_far_from_start(what, distance_m, MAX_GOAL_DISTANCE_M);
        problems.push(FieldProblem::range_of(pointer, 0.0, MAX_GOAL_DISTANCE_M, distance_m, message));
    }
}
