//! Later arrivals: each drives along the lanes behind the traffic ahead, so that it has a motion to keep
//! until it reacts.
//!
//! The Intelligent Driver Model (Treiber, Hennecke and Helbing 2000, "Congested traffic states in empirical
//! observations and microscopic simulations", Physical Review E 62), with red signals as standing leaders.

use super::arms::ArmPath;
use super::driving::{SpeedRange, allowed_mps};
use crate::tuning::placing::following::{
    BEHIND_M, BESIDE_M, BRAKING_MPS2, HARDEST_MPS2, HEADWAY_S, LOOK_M, RED_GAP_M, SPEEDING_UP_MPS2,
    STANDING_GAP_M,
};
use scene::random::Stream;
use scene::routes::{LaneGraph, Polyline};
use scene::{Agent, AgentType, STEP_S, Scene, Vec2};
use std::collections::HashSet;

/// Spacing of the known speeds along a course, metres.
const SPEED_STEP_M: f64 = 2.0;

/// The course of one vehicle: along its arm, then through the map.
pub(super) struct Course {
    pub(super) path: Polyline,
    lanes: Vec<(usize, f64)>,
    speeds_mps: Vec<f64>,
    /// Stop lines: arc length, and the index of the signal.
    stops: Vec<(f64, usize)>,
    /// The course ends before the road does.
    cut: bool,
}

impl Course {
    /// Along the path of an arm and onwards, at least `reach_m` in all if the road is long enough. At a fork one branch
    /// is drawn.
    pub(super) fn of(
        scene: &Scene,
        graph: &LaneGraph,
        way: &ArmPath,
        reach_m: f64,
        speeds: Option<SpeedRange>,
        stream: &mut Stream,
    ) -> Self {
        let mut points: Vec<Vec2> = way.path.points().to_vec();
        let mut lanes: Vec<(usize, f64)> = way.legs().collect();
        let mut seen: HashSet<usize> = way.lanes().collect();
        let (mut at, mut length_m) = (way.last_lane(), way.length_m());
        // The end line may be a stop sign in the middle of a lane.
        let (_, from_m) = way.lane_at(length_m);
        let rest = &graph.lanes()[at].path;
        if rest.length_m() > from_m + 0.1 {
            points.extend(rest.slice(from_m, rest.length_m()).points());
            length_m += rest.length_m() - from_m;
        }
        let mut cut = false;
        loop {
            let drives = |next: &&usize| graph.lanes()[**next].carries(AgentType::Vehicle);
            let next: Vec<usize> = graph.lanes()[at].successors.iter().filter(drives).copied().collect();
            if next.is_empty() {
                break;
            }
            let chosen = next[stream.below(next.len())];
            if length_m > reach_m || !seen.insert(chosen) {
                cut = true;
                break;
            }
            lanes.push((chosen, length_m));
            points.extend(graph.lanes()[chosen].path.points());
            length_m += graph.lanes()[chosen].path.length_m();
            at = chosen;
        }
        let stops = scene.signals.iter().enumerate().filter_map(|(i, signal)| {
            let lane = graph.lane_index(&signal.lane)?;
            let (_, at_m) = lanes.iter().find(|(l, _)| *l == lane)?;
            let stop_m = signal.stop.map_or(0.0, |stop| graph.lanes()[lane].path.project(stop).s_m);
            Some((at_m + stop_m, i))
        });
        let stops = stops.collect();
        let path = Polyline::new(points);
        let mut course = Self { path, lanes, speeds_mps: Vec::new(), stops, cut };
        course.take_speeds(graph, speeds);
        course
    }

    fn take_speeds(&mut self, graph: &LaneGraph, range: Option<SpeedRange>) {
        let count = (self.path.length_m() / SPEED_STEP_M).ceil() as usize;
        let free = |i: usize| {
            let at_m = i as f64 * SPEED_STEP_M;
            let after = self.lanes.partition_point(|(_, from_m)| *from_m <= at_m).max(1);
            let (lane, from_m) = self.lanes[after - 1];
            let s_m = (at_m - from_m).min(graph.lanes()[lane].path.length_m());
            let free_mps = allowed_mps(graph, lane, s_m, AgentType::Vehicle);
            range.map_or(free_mps, |r| free_mps.min(r.max_mps)).max(1.0)
        };
        let mut speeds: Vec<f64> = (0..=count).map(free).collect();
        for i in (1..speeds.len()).rev() {
            let before = (speeds[i] * speeds[i] + 2.0 * BRAKING_MPS2 * SPEED_STEP_M).sqrt();
            speeds[i - 1] = speeds[i - 1].min(before);
        }
        self.speeds_mps = speeds;
    }

    /// Speed that the limit and bends allow at a place, m/s.
    pub(super) fn allowed_mps(&self, at_m: f64) -> f64 {
        let i = (at_m / SPEED_STEP_M).max(0.0) as usize;
        self.speeds_mps[i.min(self.speeds_mps.len() - 1)]
    }

    /// Distance up to which two courses are the same, metres.
    fn shared_m(&self, other: &Self) -> f64 {
        let same = self.lanes.iter().zip(&other.lanes).take_while(|(a, b)| a.0 == b.0).count();
        self.lanes.get(same).map_or(self.path.length_m(), |(_, from_m)| *from_m)
    }
}

/// One vehicle of an arm's lane.
pub(super) struct FollowingDriver {
    pub(super) course: Course,
    pub(super) length_m: f64,
    /// Speed in free traffic as a share of what the limit and bends allow.
    pub(super) share: f64,
    /// Step of its first place.
    pub(super) first_step: usize,
    /// Place on the course and speed at each step from `first_step` on, m and m/s.
    pub(super) steps: Vec<(f64, f64)>,
}

impl FollowingDriver {
    /// Place and speed at a step.
    pub(super) fn at(&self, step: usize) -> Option<(f64, f64)> {
        self.steps.get(step.checked_sub(self.first_step)?).copied()
    }
}

/// Drives one vehicle from its first place to the last step, or to the end of its course. `before` holds
/// earlier arrivals on the same lane, `kept` the agents of the scene that stay.
pub(super) fn drive(
    scene: &Scene,
    kept: &[&Agent],
    own: &mut FollowingDriver,
    before: &[FollowingDriver],
    last_step: usize,
) {
    let shared: Vec<f64> = before.iter().map(|other| own.course.shared_m(&other.course)).collect();
    while let Some((s_m, v_mps)) = own.steps.last().copied() {
        let step = own.first_step + own.steps.len() - 1;
        if step >= last_step || s_m + 0.5 * own.length_m >= own.course.path.length_m() {
            break;
        }
        let nose_m = s_m + 0.5 * own.length_m;
        let followed = before.iter().zip(&shared).filter_map(|(other, shared_m)| {
            let (other_m, other_mps) = other.at(step)?;
            let tail_m = other_m - 0.5 * other.length_m;
            (other_m > s_m && tail_m < *shared_m).then_some((tail_m - nose_m, other_mps))
        });
        let present = others_ahead(kept, own, step, s_m);
        let red = own.course.stops.iter().filter_map(|(line_m, signal)| {
            let room_m = line_m - nose_m;
            let can_stop = v_mps * v_mps < 2.0 * HARDEST_MPS2 * room_m.max(0.0);
            (scene.signals[*signal].at(step).is_stop() && can_stop).then_some((room_m + RED_GAP_M, 0.0))
        });
        let all = followed.chain(present).chain(red);
        let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
        let wish_mps = own.share * own.course.allowed_mps(s_m);
        let a = acceleration(v_mps, wish_mps, nearest);
        let next_mps = (v_mps + a * STEP_S).max(0.0);
        own.steps.push((s_m + 0.5 * (v_mps + next_mps) * STEP_S, next_mps));
    }
    // A vehicle beyond the map's edge is removed. If only its course ends, it stays for as long as it is
    // known.
    let end_m = own.course.path.length_m();
    if !own.course.cut {
        let half_m = 0.5 * own.length_m;
        while own.steps.len() > 1 && own.steps.last().is_some_and(|(s, _)| s + half_m > end_m) {
            own.steps.pop();
        }
    }
}

/// Gap and speed of each kept agent ahead on the course, from its known state at a step.
fn others_ahead(
    kept: &[&Agent],
    own: &FollowingDriver,
    step: usize,
    s_m: f64,
) -> impl Iterator<Item = (f64, f64)> {
    let place = own.course.path.sample(s_m);
    kept.iter().filter_map(move |agent| {
        let state = agent.state_at(step)?;
        let apart = state.position() - place.position;
        if apart.norm() > LOOK_M || apart.dot(&place.direction()) < -BEHIND_M {
            return None;
        }
        let foot = own.course.path.project_within(state.position(), BESIDE_M)?;
        let along = (state.heading_rad - foot.heading_rad).cos();
        let tail_m = foot.s_m - 0.5 * agent.size.length_m * along.abs();
        (foot.s_m > s_m).then_some((tail_m - s_m - 0.5 * own.length_m, (state.speed_mps() * along).max(0.0)))
    })
}

/// Acceleration of the model, m/s2.
fn acceleration(v_mps: f64, wish_mps: f64, leader: Option<(f64, f64)>) -> f64 {
    let free = 1.0 - (v_mps / wish_mps.max(0.5)).powi(4);
    let near = leader.map_or(0.0, |(gap_m, leader_mps)| {
        let closing = v_mps * (v_mps - leader_mps) / (2.0 * (SPEEDING_UP_MPS2 * BRAKING_MPS2).sqrt());
        let wanted_m = STANDING_GAP_M + (v_mps * HEADWAY_S + closing).max(0.0);
        (wanted_m / gap_m.max(0.1)).powi(2)
    });
    (SPEEDING_UP_MPS2 * (free - near)).clamp(-HARDEST_MPS2, SPEEDING_UP_MPS2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_follower_keeps_its_distance_and_a_free_driver_its_speed() {
        assert!(acceleration(13.0, 13.0, None).abs() < 1e-9);
        assert!(acceleration(5.0, 13.0, None) > 1.0);
        let at_rest = |gap_m| acceleration(0.0, 13.0, Some((gap_m, 0.0)));
        assert!(at_rest(2.0).abs() < 1e-9 && at_rest(1.0) < 0.0 && at_rest(30.0) > 1.0);
        assert_eq!(acceleration(13.0, 13.0, Some((3.0, 0.0))), -HARDEST_MPS2);
    }
}
