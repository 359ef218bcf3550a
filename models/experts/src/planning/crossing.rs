//! Walkers and carriageways: where a path steps onto the lanes, the path by a crosswalk, and waits at the
//! kerb while the crossed lanes have green.

use super::profile::{Caps, Progress, TimedLeg, approaching, speed_at};
use super::stop_line::{Steps, StopLine};
use super::way::{PathKind, UntimedPath};
use super::world::{AgentAtStart, World};
use crate::tuning::fixed::crossing::{
    AHEAD_M, BEHIND_LINE_M, BESIDE_M, CROSSED_REACH_M, DETOUR, DETOUR_M, DRAWN_SHORT_M, EASY_STOP, INSIDE_M,
    KERB_M, LANE_REACH_M, PACE_MPS, ROUNDED_M, SETTING_OFF_MPS2, STANDING_MPS, STEPPED_OUT_M, STOPPING_MPS2,
};
use scene::geometry::cross;
use scene::geometry::segments::Segment;
use scene::map::Area;
use scene::motion::{MotionModel, Target};
use scene::routes::Polyline;
use scene::{AgentType, HORIZON_STEPS, STEP_S, Vec2};

/// Distance between samples of a path, metres.
const LOOK_M: f64 = 0.5;
/// Distance between the points of a path by a crosswalk, metres.
const SPACING_M: f64 = 0.5;
/// First identity of paths by crosswalks.
const IDENTITY: u64 = 1_000;
/// Delay of a walker after the lanes are stopped, steps.
const NOTICING_STEPS: usize = 5;

/// The place at which a walker's path steps onto the lanes.
#[derive(Clone, Debug, PartialEq)]
pub struct Kerb {
    /// Progress of the box centre at which its front is at the kerb, metres.
    pub line_m: f64,
    /// Steps of the window at which lanes crossed on a crosswalk have green or yellow.
    go: Steps,
    /// Steps at which all of them are known to be stopped.
    stopped: Steps,
}

/// The kerb on a walker's path. `None` for other types, for a walker already on the lanes, and if the path
/// crosses no lanes.
pub fn kerb(world: &World<'_>, who: &AgentAtStart, path: &Polyline) -> Option<Kerb> {
    if who.agent_type != AgentType::Pedestrian {
        return None;
    }
    let (enters_m, leaves_m) = carriageway(world, path, path.length_m().min(AHEAD_M))?;
    let ground = world.graph.ground();
    let place = |s: f64| path.extrapolate(s).position;
    let tries = (0..(KERB_M / LOOK_M) as usize).map(|i| enters_m - LOOK_M * i as f64);
    let mut edges = tries.take_while(|s| *s >= LOOK_M);
    let edge = edges.find(|s| ground.crosses_an_edge(place(s - LOOK_M), place(*s)));
    let from_m = edge.map_or(enters_m, |s| s - LOOK_M);
    let line_m = (from_m - 0.5 * who.size.length_m).max(0.0);
    let crossed = |line: &&StopLine| crosses(line, path, enters_m, leaves_m);
    let on_a_crosswalk = || is_on_crosswalk(world, path, enters_m, leaves_m);
    let (mut go, mut stopped) = (0, Steps::MAX);
    let mut lit = false;
    for line in world.stop_lines.iter().filter(crossed) {
        if !lit && !on_a_crosswalk() {
            break;
        }
        lit = true;
        go |= line.go();
        stopped &= line.red();
    }
    Some(Kerb { line_m, go, stopped: if lit { stopped } else { 0 } })
}

/// Whether the traffic of this stop line drives over the path within the lanes.
fn crosses(line: &StopLine, path: &Polyline, enters_m: f64, leaves_m: f64) -> bool {
    let (from, to) = line.behind(BEHIND_LINE_M);
    let (a, b) = (path.extrapolate(enters_m - LOOK_M), path.extrapolate(leaves_m + LOOK_M));
    // Cheaper than testing each piece, and accurate enough because pedestrians cross straight.
    Segment { from, to, owner: 0, piece: 0 }.crosses(a.position, b.position)
}

/// Progress at which a path steps onto the first vehicle lane, and at which it has left the last. `None` if
/// it crosses none or begins on one.
fn carriageway(world: &World<'_>, path: &Polyline, to_m: f64) -> Option<(f64, f64)> {
    let on = |s: &f64| is_on_lane(world, path.position_at(*s));
    if on(&0.0) {
        return None;
    }
    let looks = (1..=(to_m / LOOK_M).floor() as usize).map(|i| LOOK_M * i as f64);
    let mut inside = looks.filter(on);
    let first = inside.next()?;
    Some((first, inside.next_back().unwrap_or(first)))
}

fn is_on_lane(world: &World<'_>, place: Vec2) -> bool {
    let lanes = world.graph.lanes();
    let near = world.graph.nearest_for(place, LANE_REACH_M, AgentType::Vehicle);
    near.iter().any(|hit| hit.distance_m <= 0.5 * lanes[hit.lane].width_m)
}

/// Whether the whole path between these places is on one crosswalk, or right beside it.
fn is_on_crosswalk(world: &World<'_>, path: &Polyline, from_m: f64, to_m: f64) -> bool {
    let count = ((to_m - from_m) / 1.0).ceil().max(1.0) as usize;
    let places: Vec<Vec2> =
        (0..=count).map(|i| path.position_at(from_m + (to_m - from_m) * i as f64 / count as f64)).collect();
    // Crosswalks are drawn up to the kerb or short of it, so the middle decides.
    let middle = &places[places.len() / 4..places.len() - places.len() / 4];
    world.scene.map.crosswalks.iter().any(|area| middle.iter().all(|p| area.is_near(*p, BESIDE_M)))
}

/// The middle line of a crosswalk from kerb to kerb.
struct CrosswalkStrip {
    ends: [Vec2; 2],
    /// Room on each side of the middle line, metres.
    half_m: f64,
}

impl CrosswalkStrip {
    fn of(world: &World<'_>, area: &Area) -> Option<Self> {
        let ring = &area.polygon.xy;
        if ring.len() < 3 {
            return None;
        }
        let centre = ring.iter().sum::<Vec2>() / ring.len() as f64;
        let lane = world.graph.nearest_for(centre, CROSSED_REACH_M, AgentType::Vehicle).into_iter().next()?;
        let driven = scene::geometry::direction(lane.heading_rad);
        let sides = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| b - a);
        let longest = sides.max_by(|a, b| a.norm().total_cmp(&b.norm()))?.try_normalize(1e-6)?;
        let turned = Vec2::new(-longest.y, longest.x);
        // Of its two directions, the one that leads over the lanes.
        let over = if cross(driven, longest).abs() > cross(driven, turned).abs() { longest } else { turned };
        let aside = Vec2::new(-over.y, over.x);
        let extent = |way: Vec2| {
            let each = || ring.iter().map(|p| (p - centre).dot(&way));
            (each().fold(f64::INFINITY, f64::min), each().fold(f64::NEG_INFINITY, f64::max))
        };
        let ((low, high), (right, left)) = (extent(over), extent(aside));
        let middle = centre + aside * (0.5 * (left + right));
        let kerb = |end: Vec2, out: Vec2| {
            let tries = (0..=(DRAWN_SHORT_M / LOOK_M) as usize).map(|i| end + out * (LOOK_M * i as f64));
            tries.into_iter().find(|place| !is_on_lane(world, *place))
        };
        let ends = [kerb(middle + over * low, -over)?, kerb(middle + over * high, over)?];
        Some(Self { ends, half_m: (0.5 * (left - right) - INSIDE_M).max(0.0) })
    }

    /// From start to goal by the crosswalk, on the side that is nearest to both.
    fn way(&self, start: Vec2, goal: Vec2) -> [Vec2; 4] {
        let [a, b] = self.ends;
        let length = |from: Vec2, to: Vec2| (from - start).norm() + (goal - to).norm();
        let (from, to) = if length(a, b) <= length(b, a) { (a, b) } else { (b, a) };
        let over = (to - from).normalize();
        let aside = Vec2::new(-over.y, over.x);
        let wanted = (0.5 * (start + goal) - from).dot(&aside).clamp(-self.half_m, self.half_m);
        [start, from + aside * wanted, to + aside * wanted, goal]
    }
}

/// The path by a crosswalk to a goal on the other side. `None` if `straight` crosses no lanes or is on a
/// crosswalk already, or if the goal lies on a lane. Also `None` if no crosswalk is near enough to arrive in
/// time.
pub(super) fn by_crosswalk(
    world: &World<'_>,
    who: &AgentAtStart,
    model: &MotionModel,
    target: &Target,
    goal: Vec2,
    straight: &Polyline,
) -> Option<UntimedPath> {
    if who.agent_type != AgentType::Pedestrian || world.scene.map.crosswalks.is_empty() {
        return None;
    }
    let (enters_m, leaves_m) = carriageway(world, straight, straight.length_m().min(AHEAD_M))?;
    if is_on_lane(world, goal) || is_on_crosswalk(world, straight, enters_m, leaves_m) {
        return None;
    }
    let start = who.start.position();
    let straight_m = (goal - start).norm();
    let longest_m = (DETOUR * straight_m).max(straight_m + DETOUR_M);
    let crosswalks = world.scene.map.crosswalks.iter().enumerate();
    let near = crosswalks.filter(|(_, area)| {
        let detour_m = |p: &Vec2| (p - start).norm() + (goal - p).norm();
        area.polygon.xy.iter().any(|p| detour_m(p) <= longest_m)
    });
    let ways = near.filter_map(|(i, area)| {
        let corners = CrosswalkStrip::of(world, area)?.way(start, goal);
        let leg = |a: usize| Polyline::new([corners[a], corners[a + 1]]);
        let length_m: f64 = corners.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        let off_lanes = |leg: &Polyline| carriageway(world, leg, leg.length_m()).is_none();
        let serves = length_m <= longest_m && off_lanes(&leg(0)) && off_lanes(&leg(2).reversed());
        serves.then_some((length_m, i, corners))
    });
    let (_, i, corners) = ways.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let path = Polyline::new(corners).resample(SPACING_M).smoothed(ROUNDED_M);
    let pace = walking(model.start_speed_mps(), path.length_m(), target)?;
    let identity = IDENTITY + i as u64;
    let way = UntimedPath::new(
        path,
        2.0,
        model.limits.speed_mps,
        PathKind::LeastEffort,
        None,
        identity,
        &world.tuning.anchors,
    );
    Some(UntimedPath { pace: Some(pace), ..way })
}

/// The fastest walk that is not a run, m/s.
pub fn brisk_mps(v0: f64) -> f64 {
    PACE_MPS.max(v0)
}

/// Progress at a constant pace that arrives on time; `None` if that is too fast.
pub(super) fn walking(v0: f64, length_m: f64, target: &Target) -> Option<Progress> {
    let even = even_pace(v0, length_m, target.step)?;
    let seconds = target.step as f64 * STEP_S;
    // If the goal fixes the speed, the change of speed is spread over the whole path.
    Some(match target.speed_mps {
        None => even,
        end_mps => {
            TimedLeg { v0, from_m: 0.0, length_m, seconds, end_mps, easy_mps2: SETTING_OFF_MPS2 }.arriving()
        }
    })
}

/// The constant pace, after setting off, that covers a length in this many steps.
fn even_pace(v0: f64, length_m: f64, steps: usize) -> Option<Progress> {
    let free = Caps::new(&[0.0], &[f64::INFINITY]);
    let at = |pace: f64| approaching(v0, pace, SETTING_OFF_MPS2, &free);
    let (mut low, mut high) = (0.0, brisk_mps(v0));
    if at(high)[steps] < length_m {
        return None;
    }
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if at(middle)[steps] < length_m { low = middle } else { high = middle }
    }
    Some(at(high))
}

impl Kerb {
    /// Progress that waits at the kerb until the signals of the lanes are known to be red, and still meets
    /// the goal in time. `None` if `wanted` steps onto no lane with green, or the time is too short.
    pub fn waiting(&self, wanted: &Progress, v0: f64, due: usize) -> Option<Progress> {
        let steps_out = (1..=due).find(|i| wanted[*i] > self.line_m + STEPPED_OUT_M)?;
        if self.go >> steps_out & 1 == 0 {
            return None;
        }
        let clear = (steps_out..due).find(|i| self.go >> i & 1 == 0 && self.stopped >> i & 1 == 1)?;
        let mut out = self.held(wanted, v0, due)?;
        let on = [clear + NOTICING_STEPS, clear].into_iter().find_map(|leaves| {
            let left = due.checked_sub(leaves).filter(|left| *left > 0)?;
            let pace = even_pace(speed_at(&out, leaves), wanted[due] - out[leaves], left)?;
            Some((leaves, pace))
        });
        let (leaves, pace) = on?;
        let from_m = out[leaves];
        for i in leaves + 1..=HORIZON_STEPS {
            out[i] = if i <= due { from_m + pace[i - leaves] } else { wanted[i].max(out[i - 1]) };
        }
        Some(out)
    }

    /// As `wanted`, but before the kerb in the first `until` steps; then the walker sets off. `None` if it
    /// can no longer stop before the kerb.
    pub fn held(&self, wanted: &Progress, v0: f64, until: usize) -> Option<Progress> {
        let needs = v0 * v0 / (2.0 * self.line_m.max(0.05));
        if needs > STOPPING_MPS2 && v0 > STANDING_MPS {
            return None;
        }
        let brake = needs.max(EASY_STOP * STOPPING_MPS2);
        let fastest = (1..=HORIZON_STEPS).map(|i| speed_at(wanted, i)).fold(0.0, f64::max);
        let mut out = [0.0; HORIZON_STEPS + 1];
        let mut speed = v0;
        for i in 0..HORIZON_STEPS {
            let next = if i < until {
                let left = (self.line_m - out[i]).max(0.0);
                let open = speed_at(wanted, i + 1).min((2.0 * brake * left).sqrt()).min(left / STEP_S);
                open.min(speed + SETTING_OFF_MPS2 * STEP_S)
            } else {
                (speed + SETTING_OFF_MPS2 * STEP_S).min(fastest)
            };
            out[i + 1] = out[i] + 0.5 * (speed + next) * STEP_S;
            speed = next;
        }
        Some(out)
    }
}
