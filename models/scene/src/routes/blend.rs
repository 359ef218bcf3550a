//! Paths that start and end exactly at a road user's start and goal.

use super::assemble::smooth;
use super::cubic::{self, CURVATURE_WINDOW_M};
use super::start::errors_at;
use super::{Polyline, Pose};
use crate::geometry::cross;
use crate::{AgentType, Vec2, wrap_angle};

/// Greatest distance between the points of a base path, metres: for motor vehicles, and for others, which
/// turn more sharply.
const STEP_M: f64 = 1.0;
const FINE_STEP_M: f64 = 0.4;
/// Duration of travel over which an offset is blended out, at the present speed, seconds.
const BLEND_S: f64 = 3.0;
/// Longest blend of a small offset, metres.
const MAX_BLEND_M: f64 = 40.0;
/// Lateral acceleration of a larger offset, such as a lane change; most drivers stay below it, m/s2. The
/// quintic of an offset `d` that fades in a time `T` peaks at 5.77 `d` / `T`².
const SIDEWAYS_MPS2: f64 = 1.5;
const QUINTIC_PEAK: f64 = 5.77;
/// Greatest heading difference for a blend across the path.
const BLEND_TURN_RAD: f64 = 0.7;
/// Share of the comfortable curvature that a blend may add before a cubic is tried instead.
const BLEND_CURVATURE: f64 = 0.7;
/// Length at the path's beginning in which the road user's foot is searched, metres.
const START_SEARCH_M: f64 = 15.0;

/// Shift towards the inside of a bend: metres per curvature of 1/m, and its maximum. Fitted to recorded
/// turns, whose mean distance from the path it reduces by a fifth.
const INSIDE_M2: f64 = 10.0;
const MAX_INSIDE_M: f64 = 1.5;
/// Half of the length over which a bend's curvature is averaged, metres: cutting begins before the bend.
const FELT_M: f64 = 5.0;

/// End of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndPose {
    /// Metres.
    pub position: Vec2,
    /// Radians; free means along the path.
    pub heading_rad: Option<f64>,
    /// Speed on the last part of the path, m/s: it determines the length over which an offset fades in there.
    pub speed_mps: f64,
}

/// Offset across a path that fades out over a length, with its slope, as a quintic.
#[derive(Clone, Copy, Debug)]
struct Fade {
    offset_m: f64,
    slope: f64,
    length_m: f64,
}

impl Fade {
    /// Offset at `s_m` after the place where it is `offset_m`.
    fn at(&self, s_m: f64) -> f64 {
        if s_m >= self.length_m {
            return 0.0;
        }
        let t = (s_m / self.length_m).max(0.0);
        // Quintic that begins with slope one and no curvature, and ends with zero value, slope and curvature.
        let ramp = t - t * t * t * (6.0 - t * (8.0 - 3.0 * t));
        self.offset_m * (1.0 - smooth(t)) + self.slope * self.length_m * ramp
    }
}

/// Speed and curvature with which a road user joins a path.
#[derive(Clone, Copy, Debug)]
struct BlendLimits {
    /// Speed at the joint, m/s.
    speed_mps: f64,
    /// Length of a fade of a small offset if there is room, metres.
    blend_m: f64,
    /// Shortest fade, metres.
    min_blend_m: f64,
    /// Comfortable curvature, 1/m.
    curvature: f64,
    /// Greatest distance between points, metres.
    step_m: f64,
}

impl BlendLimits {
    fn of(agent_type: AgentType, speed_mps: f64) -> Self {
        let min_blend_m = if agent_type == AgentType::Pedestrian { 3.0 } else { 8.0 };
        let blend_m = (BLEND_S * speed_mps).clamp(min_blend_m, MAX_BLEND_M);
        let fine = matches!(agent_type, AgentType::Pedestrian | AgentType::Cyclist);
        let step_m = if fine { FINE_STEP_M } else { STEP_M };
        let speed_mps = speed_mps.max(0.0);
        Self { speed_mps, blend_m, min_blend_m, curvature: cubic::comfortable_curvature(agent_type), step_m }
    }

    /// Length over which an offset of this size fades if there is room, metres.
    fn fade_m(&self, offset_m: f64) -> f64 {
        self.blend_m.max(self.speed_mps * (QUINTIC_PEAK * offset_m.abs() / SIDEWAYS_MPS2).sqrt())
    }
}

/// `path` (a route's, or any lane centre) bent so that it begins exactly at `start` and, with a goal, ends
/// exactly there. Vehicles keep to the inside of bends.
///
/// The road user's offset and heading fade onto the path over about 3 s of travel. An offset of a lane's
/// width takes as long as its speed requires. The goal's offset and heading fade in over the last part. Both
/// are quintics across the path, so that curvature stays continuous. If an offset is too large for that (a
/// heading far off the path's, a tight bend on the inner side), a cubic leads onto the path or off it. A goal
/// beyond the path's end extends it straight on. A goal behind is met by one cubic. Points are at most 1 m
/// apart.
pub fn base_path(
    path: &Polyline,
    start: Pose,
    speed_mps: f64,
    agent_type: AgentType,
    goal: Option<EndPose>,
) -> Polyline {
    let manner = BlendLimits::of(agent_type, speed_mps);
    let inside = (agent_type == AgentType::Vehicle).then(|| inside(path, manner.step_m));
    let path = inside.as_ref().unwrap_or(path);
    let foot = path.project_between(start.position, 0.0, START_SEARCH_M);
    let Some(goal) = goal else {
        let rest = path.slice(foot.s_m, path.length_m());
        return onto(&rest, start, manner, path.length_m()).resample(manner.step_m);
    };
    let (extended, goal_s) = reach(path, foot.s_m, goal.position);
    if goal_s - foot.s_m < 1.0 {
        return direct(start, goal, manner);
    }
    let between = extended.slice(foot.s_m, goal_s);
    // Both fades share a short path.
    let half = 0.5 * between.length_m();
    let entered = onto(&between, start, manner, half.max(manner.min_blend_m));
    let room = (entered.length_m() - manner.min_blend_m.min(half)).max(half);
    let bent = ended(&entered, goal, BlendLimits::of(agent_type, goal.speed_mps), room);
    let met = (bent.first().position - start.position).norm() < 1e-6;
    if met { bent.resample(manner.step_m) } else { direct(start, goal, manner) }
}

/// `path` as drivers take it: shifted towards the inside of its bends.
fn inside(path: &Polyline, step_m: f64) -> Polyline {
    let even = path.resample(step_m);
    let curvature = even.curvatures(FELT_M);
    let mean = |i: usize| {
        let half = (FELT_M / step_m) as usize;
        let felt = &curvature[i.saturating_sub(half)..(i + half + 1).min(curvature.len())];
        felt.iter().sum::<f64>() / felt.len() as f64
    };
    let points = even.points().iter().zip(even.headings_rad()).enumerate().map(|(i, (point, heading))| {
        let left = Vec2::new(-heading.sin(), heading.cos());
        point + left * (INSIDE_M2 * mean(i)).clamp(-MAX_INSIDE_M, MAX_INSIDE_M)
    });
    Polyline::new(points)
}

/// `path`, whose end is beside `goal`, bent over at most `room_m` to end there.
fn ended(path: &Polyline, goal: EndPose, manner: BlendLimits, room_m: f64) -> Polyline {
    let heading = goal.heading_rad.unwrap_or(path.last().heading_rad);
    let backwards = Pose::new(goal.position, wrap_angle(heading + std::f64::consts::PI));
    onto(&path.reversed(), backwards, manner, room_m).reversed()
}

/// A lane path that ends beside `goal`, bent so that it ends there, as [`base_path`] does.
pub(super) fn ending_at(path: &Polyline, goal: EndPose, agent_type: AgentType) -> Polyline {
    let manner = BlendLimits::of(agent_type, goal.speed_mps);
    ended(path, goal, manner, path.length_m()).resample(manner.step_m)
}

/// The path, extended straight on if the goal lies beyond its end, and the goal's arc length on it.
fn reach(path: &Polyline, from_m: f64, goal: Vec2) -> (Polyline, f64) {
    let end = path.last();
    let beyond = (goal - end.position).dot(&end.direction());
    let foot = path.project_between(goal, from_m, f64::INFINITY);
    if beyond > 0.0 && foot.s_m > path.length_m() - 0.1 && path.length_m() > 0.1 {
        let far = path.extrapolate(path.length_m() + beyond).position;
        let extended = Polyline::new(path.points().iter().copied().chain([far]));
        let s = extended.length_m();
        return (extended, s);
    }
    (path.clone(), foot.s_m)
}

/// One cubic from start to goal; with a free heading it ends like a circle through both.
fn direct(start: Pose, goal: EndPose, manner: BlendLimits) -> Polyline {
    let chord = goal.position - start.position;
    if chord.norm() < 0.05 {
        return Polyline::new([start.position, goal.position]);
    }
    let turn = wrap_angle(chord.y.atan2(chord.x) - start.heading_rad);
    let end = Pose::new(goal.position, goal.heading_rad.unwrap_or(start.heading_rad + 2.0 * turn));
    let join = cubic::best(start, end, manner.curvature);
    join.path.resample(manner.step_m)
}

/// `path` joined from `start`, whose foot is near its beginning; the bent part is at most `room_m` long.
fn onto(path: &Polyline, start: Pose, manner: BlendLimits, room_m: f64) -> Polyline {
    let room_m = room_m.min(path.length_m());
    let straight = || Polyline::new([start.position, path.last().position]);
    if room_m < 0.1 {
        return straight();
    }
    let (offset_m, _) = errors_at(start, path.first());
    let faded = faded(path, start, manner.fade_m(offset_m).min(room_m), manner.step_m);
    let bend = |p: &Polyline| p.max_curvature(0.0, room_m, CURVATURE_WINDOW_M);
    match &faded {
        Some(line) if bend(line) <= bend(path) + BLEND_CURVATURE * manner.curvature => {}
        _ => {
            let joined = joined(path, start, manner, room_m);
            let worse = |line: &Polyline| joined.as_ref().is_some_and(|j| bend(j) < bend(line));
            if faded.as_ref().is_none_or(worse) {
                return joined.unwrap_or_else(straight);
            }
        }
    }
    faded.unwrap_or_else(straight)
}

/// `path` with the start's offset and slope fading out over `length_m`; `None` if the start is too far off
/// for that.
fn faded(path: &Polyline, start: Pose, length_m: f64, step_m: f64) -> Option<Polyline> {
    let begin = path.first();
    let away = start.position - begin.position;
    let (along, across) = (away.dot(&begin.direction()), cross(begin.direction(), away));
    let turn = wrap_angle(start.heading_rad - begin.heading_rad);
    if turn.abs() > BLEND_TURN_RAD || along.abs() > 0.25 * length_m {
        return None;
    }
    // A parallel line covers less of the path on the inner side of a bend, and more on the outer side.
    let squeeze = 1.0 - across * path.curvature_at(0.0, 2.0 * CURVATURE_WINDOW_M);
    let sideways = Fade { offset_m: across, slope: squeeze.max(0.2) * turn.tan(), length_m };
    let lengthways = Fade { offset_m: along, slope: 0.0, length_m };
    let dense = path.resample(step_m);
    let points = dense.arc_m().iter().skip(1).map(|s| {
        let pose = dense.sample(*s);
        let forward = pose.direction();
        let left = Vec2::new(-forward.y, forward.x);
        pose.position + lengthways.at(*s) * forward + sideways.at(*s) * left
    });
    Some(Polyline::new([start.position].into_iter().chain(points)))
}

/// `path` joined by the cheapest of a few cubics.
fn joined(path: &Polyline, start: Pose, manner: BlendLimits, room_m: f64) -> Option<Polyline> {
    let mut best: Option<(f64, Polyline)> = None;
    let mut s = 4.0_f64.min(room_m);
    loop {
        let to = path.sample(s);
        if (to.position - start.position).norm() > 0.5 {
            let join = cubic::best(start, to, manner.curvature);
            let cost = cubic::cost(&join, manner.curvature) + path.length_m() - s;
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                let rest = path.slice(s, path.length_m());
                let points = join.path.points().iter().chain(rest.points().iter().skip(1)).copied();
                best = Some((cost, Polyline::new(points)));
            }
        }
        if s >= room_m.min(MAX_BLEND_M) {
            return best.map(|(_, path)| path.resample(manner.step_m));
        }
        s = (s + 2.0).min(room_m);
    }
}
