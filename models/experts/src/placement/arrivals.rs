//! Traffic by arms: a flow in vehicles per hour enters by each arm, before the scene begins and throughout
//! it.
//!
//! Headways on a lane are a minimum headway plus an exponential remainder (Cowan 1975, "Useful headway
//! models", Transportation Research 9, the model M2). The renewal process begins in its steady state, so the
//! expected number of vehicles that pass any place of an arm is exactly rate times duration. A vehicle that
//! entered before the scene begins is placed where free traffic would be by then. A later vehicle has a
//! motion that begins at the edge of the map.

use super::arms::{Arm, ArmLane, ArmPath, arms};
use super::cells::CellKind;
use super::checks::END_M;
use super::following::{Course, FollowingDriver, drive};
use super::place::Sampler;
use super::placed::{PlacedAgent, rounded};
use super::pose::{Pose, draw_size};
use super::random;
use super::request::{ArmTraffic, Arrivals};
use crate::request::GenerateError;
use crate::tuning::placing::arms::FREE_SHARE;
use crate::tuning::placing::arrivals::{
    BACK_M, CAR_M, ENTRY_GAP_M, ENTRY_M, ENTRY_SIDE_M, LEAST_HEADWAY_S, REACH_M, REACH_MPS, REACH_S, SHARES,
    WAIT_S,
};
use scene::Cancel;
use scene::geometry::obb::OrientedBox;
use scene::geometry::{direction, wrap_angle};
use scene::limits::Limits;
use scene::random::Stream;
use scene::routes::Polyline;
use scene::{Agent, AgentId, AgentType, Conditions, STEP_S, Size, State, Subtype, Track, Vec2};
use std::collections::HashSet;

const BACK_TRIES: usize = 16;

/// A vehicle of an arm's lane.
struct Arrival {
    /// Time of entry, seconds after the start; negative if it has entered already.
    enters_s: f64,
    size: Size,
    subtype: Subtype,
    share: f64,
    /// Index among the placed agents, for a vehicle that is present at the start.
    placed: Option<usize>,
}

/// The vehicles of one lane, from front to back.
struct FreeStretch {
    arm: usize,
    entry: ArmLane,
    number: usize,
    way: ArmPath,
    all: Vec<Arrival>,
}

/// The vehicles made for all arms so far, and those that are still to enter.
pub(super) struct TrafficByArms {
    pub(super) arms: Vec<ArmTraffic>,
    stretches: Vec<FreeStretch>,
    /// Number of vehicles without room or time to enter.
    pub(super) unplaced: usize,
    /// One sentence for each reason.
    pub(super) reasons: Vec<String>,
}

/// Entry times at a rate, from `from_s` to `to_s`, in order and at least `least_s` apart.
fn times(per_s: f64, least_s: f64, (from_s, to_s): (f64, f64), stream: &mut Stream) -> Vec<f64> {
    if per_s <= 0.0 || to_s <= from_s {
        return Vec::new();
    }
    let mean_s = 1.0 / per_s;
    let rest_s = (mean_s - least_s).max(0.0);
    // Remaining headway at an arbitrary time: the equilibrium distribution of the process.
    let first_s = if stream.unit() < least_s / mean_s {
        least_s * stream.unit()
    } else {
        least_s + stream.exponential(rest_s)
    };
    let mut all = Vec::new();
    let mut at_s = from_s + first_s;
    while at_s < to_s && all.len() < scene::MAX_AGENTS {
        all.push(at_s);
        at_s += least_s + if rest_s > 0.0 { stream.exponential(rest_s) } else { 0.0 };
    }
    all
}

impl Sampler<'_> {
    /// Duration of the scene after the start, seconds.
    fn duration_s(&self) -> f64 {
        self.request.scene.time.steps.saturating_sub(self.request.step + 1) as f64 * STEP_S
    }

    /// Places the vehicles of all arms that are present at the start. `free` is the number of agents that the
    /// scene can still hold.
    pub(super) fn place_arrivals(
        &mut self,
        free: &mut usize,
        cancel: &Cancel,
    ) -> Result<TrafficByArms, GenerateError> {
        let found = arms(self.cells.graph, &self.request.region);
        let unknown = self.request.arrivals.iter().find(|a| found.iter().all(|arm| arm.id != a.arm));
        if let Some(Arrivals { arm, .. }) = unknown {
            return Err(GenerateError::UnknownArm {
                arm: arm.chars().take(64).collect(),
                known: known(&found),
            });
        }
        let mut traffic =
            TrafficByArms { arms: Vec::new(), stretches: Vec::new(), unplaced: 0, reasons: Vec::new() };
        let mut taken = HashSet::new();
        for (at, arm) in found.into_iter().enumerate() {
            if cancel.is_cancelled() {
                return Err(GenerateError::Cancelled);
            }
            let asked = self.request.arrivals.iter().find(|a| a.arm == arm.id).map(|a| a.per_hour);
            let way = |entry: &ArmLane| {
                ArmPath::of(self.cells.graph, &self.cells.lights, *entry, self.request.speeds)
            };
            let ways: Vec<(ArmLane, ArmPath)> = arm.lanes.iter().map(|entry| (*entry, way(entry))).collect();
            let least =
                |way: &ArmPath| LEAST_HEADWAY_S.max((CAR_M + self.request.min_gap_m) / way.slowest_mps());
            let most_per_hour = ways.iter().map(|(_, way)| 3600.0 / least(way)).sum::<f64>().floor();
            let length_m = ways.iter().map(|(_, way)| way.length_m()).fold(0.0, f64::max);
            if let Some(per_hour) = asked {
                taken.extend(ways.iter().flat_map(|(_, way)| way.lanes()));
                let lost = self.stretches(&mut traffic, at, &arm, ways, per_hour);
                if lost > 0 {
                    traffic.unplaced += lost;
                    traffic
                        .reasons
                        .push(format!("arm {} takes {most_per_hour} vehicles an hour at most", arm.id));
                }
            }
            let (placed, later) = (0, 0);
            traffic.arms.push(ArmTraffic { arm, length_m, most_per_hour, placed, later });
        }
        self.keep_off(&taken);
        self.stand_all(&mut traffic, free);
        Ok(traffic)
    }

    /// Draws the vehicles that enter by an arm. Returns the number that exceeds the capacity of its lanes.
    fn stretches(
        &self,
        traffic: &mut TrafficByArms,
        at: usize,
        arm: &Arm,
        ways: Vec<(ArmLane, ArmPath)>,
        per_hour: f64,
    ) -> usize {
        let to_s = self.duration_s();
        let per_s = per_hour / 3600.0 / ways.len() as f64;
        let mut lost = 0.0;
        for (number, (entry, way)) in ways.into_iter().enumerate() {
            let purpose = format!("arrivals {}", arm.id);
            let mut stream = random::stream(self.request.seed, &purpose, number);
            let least_s = LEAST_HEADWAY_S.max((CAR_M + self.request.min_gap_m) / way.slowest_mps());
            let taken_per_s = per_s.min(1.0 / least_s);
            lost += (per_s - taken_per_s) * (to_s + way.seconds());
            let enters = times(taken_per_s, least_s, (-way.seconds(), to_s), &mut stream);
            let all = enters.into_iter().map(|enters_s| {
                let (size, subtype) = match self.of_type(AgentType::Vehicle) {
                    Some(model) => draw_size(model, AgentType::Vehicle, CellKind::Lane, &mut stream),
                    None => (Size::default_for(AgentType::Vehicle, Subtype::Car), Subtype::Car),
                };
                let share = stream.between(SHARES.0, SHARES.1);
                Arrival { enters_s, size, subtype, share, placed: None }
            });
            let all = all.collect();
            traffic.stretches.push(FreeStretch { arm: at, entry, number, way, all });
        }
        lost.round() as usize
    }

    /// Excludes all other drivers from these lanes, so that only arms supply their traffic.
    fn keep_off(&mut self, lanes: &HashSet<usize>) {
        if lanes.is_empty() {
            return;
        }
        self.arrival_lanes.clone_from(lanes);
        let cells = self.cells.all.iter().enumerate();
        let held = cells.filter(|(_, cell)| cell.kind == CellKind::Lane && lanes.contains(&cell.line));
        let held: Vec<usize> = held.map(|(at, _)| at).collect();
        if let Some(rates) = self.rates.get_mut(&AgentType::Vehicle) {
            held.into_iter().for_each(|at| rates.set(at, 0.0));
        }
    }

    /// Places vehicles that entered before the start where they are by then. A vehicle without room there
    /// stands farther back, enters later, or stays unplaced.
    fn stand_all(&mut self, traffic: &mut TrafficByArms, free: &mut usize) {
        let (mut crowded, mut full, mut outside) = (0, 0, 0);
        for stretch in &mut traffic.stretches {
            let way = &stretch.way;
            // Room up to the tail of the vehicle ahead.
            let mut room_m = way.length_m();
            let leaves = self.cells.graph.lanes()[way.last_lane()].successors.is_empty();
            let mut all = Vec::with_capacity(stretch.all.len());
            for mut arrival in std::mem::take(&mut stretch.all) {
                let half_m = 0.5 * arrival.size.length_m;
                if arrival.enters_s <= 0.0 {
                    // No vehicle overhangs the edge of the map.
                    let least_m = if stretch.entry.at_map_edge { half_m } else { ENTRY_M };
                    if leaves && way.after_s(-arrival.enters_s) > way.length_m() - half_m - END_M {
                        // The vehicle has left the map or is about to.
                        continue;
                    }
                    let most_m = room_m - half_m;
                    let at_m = way.after_s(-arrival.enters_s).min(most_m);
                    let places =
                        (0..BACK_TRIES).map(|i| at_m - BACK_M * i as f64).take_while(|s| *s >= least_m);
                    let stands =
                        places.map(|s| (s, self.on_way(way, s, &arrival))).find(|(_, p)| self.fits(p));
                    match stands {
                        Some(_) if *free == 0 => full += 1,
                        Some((s, placed)) => {
                            room_m = s - half_m - self.request.min_gap_m.max(1.0);
                            arrival.placed = Some(self.placed.len());
                            self.settle(placed);
                            traffic.arms[stretch.arm].placed += 1;
                            *free -= 1;
                            all.push(arrival);
                            continue;
                        }
                        // The vehicle has not entered yet.
                        None if at_m < least_m + BACK_M => arrival.enters_s = 1e-3,
                        None => crowded += 1,
                    }
                    if arrival.enters_s <= 0.0 {
                        continue;
                    }
                }
                if !stretch.entry.at_map_edge {
                    outside += 1;
                } else if *free == 0 {
                    full += 1;
                } else {
                    *free -= 1;
                    all.push(arrival);
                }
            }
            stretch.all = all;
        }
        traffic.unplaced += crowded + full + outside;
        let mut say = |n: usize, why: &str| {
            if n > 0 {
                traffic.reasons.push(format!("{why} for {n} vehicle{}", if n == 1 { "" } else { "s" }));
            }
        };
        say(crowded, "no free place found on the arms");
        say(full, &format!("a scene holds {} road users: no place", scene::MAX_AGENTS));
        say(
            outside,
            "the area ends inside the map, and no road user appears in the middle of a road: no way in later",
        );
    }

    /// A vehicle at a place on the path of an arm.
    fn on_way(&self, way: &ArmPath, s_m: f64, arrival: &Arrival) -> PlacedAgent {
        let place = way.path.sample(s_m);
        let (lane, lane_m) = way.lane_at(s_m);
        let limits = Limits::of(AgentType::Vehicle, arrival.subtype, arrival.size.length_m);
        PlacedAgent {
            agent_type: AgentType::Vehicle,
            subtype: arrival.subtype,
            size: arrival.size,
            pose: Pose {
                position: place.position.map(|v| rounded(v, 1e3)),
                heading_rad: wrap_angle(rounded(place.heading_rad, 1e4)),
                s_m: lane_m,
            },
            kind: CellKind::Lane,
            lane: Some(lane),
            free_mps: Some((arrival.share * way.free_mps(s_m)).min(limits.speed_mps)),
            parked: false,
        }
    }

    /// Vehicles that enter later, with their motion. `speeds` are those of the placed agents.
    pub(super) fn late_comers(
        &self,
        traffic: &mut TrafficByArms,
        speeds: &[Option<f64>],
        kept: &[&Agent],
        ids: &mut impl Iterator<Item = AgentId>,
        cancel: &Cancel,
    ) -> Result<Vec<Agent>, GenerateError> {
        let mut agents: Vec<Agent> = Vec::new();
        let mut waiting = 0;
        for stretch in &traffic.stretches {
            if cancel.is_cancelled() {
                return Err(GenerateError::Cancelled);
            }
            if stretch.all.iter().all(|arrival| arrival.placed.is_some()) {
                continue;
            }
            let purpose = format!("ways on {}", traffic.arms[stretch.arm].arm.id);
            let mut stream = random::stream(self.request.seed, &purpose, stretch.number);
            let mut before: Vec<FollowingDriver> = Vec::new();
            for arrival in &stretch.all {
                let Some(mut own) = self.driver(stretch, arrival, speeds, &before, kept, &mut stream) else {
                    waiting += usize::from(arrival.placed.is_none());
                    continue;
                };
                drive(&self.request.scene, kept, &mut own, &before, self.last_step());
                if arrival.placed.is_none() {
                    traffic.arms[stretch.arm].later += 1;
                    agents.push(arriving(ids.next().unwrap_or_default(), arrival, &own));
                }
                before.push(own);
            }
        }
        if waiting > 0 {
            traffic.unplaced += waiting;
            traffic.reasons.push(format!(
                "no room to come in during the scene for {}",
                super::request::counted(waiting, AgentType::Vehicle)
            ));
        }
        Ok(agents)
    }

    fn last_step(&self) -> usize {
        self.request.scene.time.steps.saturating_sub(1).max(self.request.step)
    }

    /// A vehicle at its first place; `None` if it cannot enter or was removed again.
    fn driver(
        &self,
        stretch: &FreeStretch,
        arrival: &Arrival,
        speeds: &[Option<f64>],
        before: &[FollowingDriver],
        kept: &[&Agent],
        stream: &mut Stream,
    ) -> Option<FollowingDriver> {
        let (scene, way, range) = (&self.request.scene, &stretch.way, self.request.speeds);
        let reach_m = way.length_m() + REACH_MPS * self.duration_s().min(REACH_S) + REACH_M;
        let course = Course::of(scene, self.cells.graph, way, reach_m, range, stream);
        let length_m = arrival.size.length_m;
        // Free traffic drives a little below the speed limit, and no vehicle exceeds it.
        let share = (FREE_SHARE * arrival.share).min(1.0);
        let mut own =
            FollowingDriver { course, length_m, share, first_step: self.request.step, steps: Vec::new() };
        if let Some(at) = arrival.placed {
            let s_m = own.course.path.project(self.placed[at].pose.position).s_m;
            own.steps.push((s_m, speeds[at]?));
            return Some(own);
        }
        let due = self.request.step + (arrival.enters_s / STEP_S).ceil().max(1.0) as usize;
        let half_m = 0.5 * length_m;
        let latest = self.last_step().min(due + (WAIT_S / STEP_S) as usize);
        for step in due..=latest {
            let ahead = before.iter().filter_map(|other| {
                let (s_m, speed_mps) = other.at(step)?;
                Some((s_m - 0.5 * other.length_m - length_m, speed_mps))
            });
            let nearest = ahead.min_by(|a, b| a.0.total_cmp(&b.0));
            let least_m = ENTRY_GAP_M.max(self.request.min_gap_m);
            if nearest.is_some_and(|(gap_m, _)| gap_m < least_m)
                || !self.is_clear(&own.course.path, arrival, kept, step)
            {
                continue;
            }
            let free_mps = own.share * own.course.allowed_mps(half_m);
            let free_mps = range.map_or(free_mps, |r| free_mps.max(r.min_mps));
            let safe_mps = nearest.map_or(f64::INFINITY, |(gap_m, speed_mps)| {
                (speed_mps * speed_mps + 2.0 * 2.0 * (gap_m - least_m).max(0.0)).sqrt()
            });
            own.first_step = step;
            own.steps.push((half_m, free_mps.min(safe_mps)));
            return Some(own);
        }
        None
    }

    /// Whether no agent of the scene occupies the place at which a vehicle would enter at a step.
    fn is_clear(&self, path: &Polyline, arrival: &Arrival, kept: &[&Agent], step: usize) -> bool {
        let place = path.sample(0.5 * arrival.size.length_m);
        let size = Size { length_m: arrival.size.length_m + 2.0 * ENTRY_GAP_M, ..arrival.size };
        let room = outline(place.position, place.heading_rad, size).grown(ENTRY_SIDE_M);
        let touches = |other: &OrientedBox| scene::geometry::obb::overlaps(&room, other, 0.0);
        let logged = kept.iter().filter_map(|agent| {
            let state = agent.state_at(step)?;
            Some(outline(state.position(), state.heading_rad, agent.size))
        });
        // Parked cars and other agents off the lanes do not move.
        let stands = self.placed.iter().filter(|p| p.lane.is_none()).map(PlacedAgent::outline);
        !logged.chain(stands).any(|other| touches(&other))
    }
}

fn outline(position: Vec2, heading_rad: f64, size: Size) -> OrientedBox {
    OrientedBox::new(position, 0.5 * size.length_m, 0.5 * size.width_m, heading_rad)
}

/// A vehicle with its motion from its entry on.
fn arriving(id: AgentId, arrival: &Arrival, own: &FollowingDriver) -> Agent {
    let state = |(s_m, speed_mps): &(f64, f64)| {
        let place = own.course.path.sample(*s_m);
        let heading_rad = wrap_angle(rounded(place.heading_rad, 1e4));
        let velocity = direction(heading_rad) * *speed_mps;
        Some(State {
            x_m: rounded(place.position.x, 1e3),
            y_m: rounded(place.position.y, 1e3),
            heading_rad,
            vx_mps: rounded(velocity.x, 1e3),
            vy_mps: rounded(velocity.y, 1e3),
        })
    };
    let states = own.steps.iter().map(state).collect();
    Agent {
        id,
        agent_type: AgentType::Vehicle,
        subtype: arrival.subtype,
        role: None,
        size: arrival.size,
        track: Track { first_step: own.first_step, states, z_m: None }.into(),
        conditions: Conditions::default(),
    }
}

/// The names of the available arms, for a sentence.
fn known(found: &[Arm]) -> String {
    let shown: Vec<&str> = found.iter().take(16).map(|arm| arm.id.as_str()).collect();
    match shown.as_slice() {
        [] => "no road comes in here".to_owned(),
        all => format!("{} expected", all.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placement::driving::SpeedRange;
    use crate::placement::region::Region;
    use crate::placement::request::{Amount, PlaceRequest, Placement};
    use scene::map::{Lane, LaneMap};
    use scene::routes::LaneGraph;
    use scene::{Scene, Signal, SignalState};
    use std::sync::Arc;

    #[test]
    fn as_many_come_as_the_rate_says_and_none_too_soon() {
        for per_hour in [60.0, 400.0, 1_200.0, 2_300.0] {
            let (mut count, mut least_s) = (0, f64::INFINITY);
            let runs = 400;
            for seed in 0..runs {
                let mut stream = random::stream(seed, "test", 0);
                let all = times(per_hour / 3600.0, 1.5, (-20.0, 70.0), &mut stream);
                count += all.len();
                least_s = all.windows(2).map(|w| w[1] - w[0]).fold(least_s, f64::min);
            }
            let expected = 90.0 * per_hour / 3600.0;
            let mean = count as f64 / runs as f64;
            assert!((mean / expected - 1.0).abs() < 0.05, "{per_hour}: {mean} for {expected}");
            assert!(least_s >= 1.5);
        }
        let mut stream = random::stream(1, "test", 0);
        assert!(times(0.0, 1.5, (0.0, 60.0), &mut stream).is_empty());
        assert_eq!(times(1.0 / 1.5, 1.5, (0.0, 60.0), &mut stream).len(), 40);
    }

    /// Two lanes of 200 m from the west to a signal, and 60 m beyond it.
    fn road(steps: usize) -> Scene {
        let lane = |id: &str, from_m: f64, to_m: f64, y_m: f64| {
            let at = |i: u32| Vec2::new(from_m + (to_m - from_m) * f64::from(i) / 40.0, y_m);
            let points: Vec<Vec2> = (0..=40).map(at).collect();
            Lane { speed_limit_mps: Some(14.0), width_m: Some(3.5), ..Lane::street(id, points) }
        };
        let mut lanes = Vec::new();
        for (k, y_m) in [(1, 0.0), (2, -3.5)] {
            let (near, far) = (format!("in{k}"), format!("out{k}"));
            lanes.push(Lane { successors: vec![far.clone()], ..lane(&near, -200.0, 0.0, y_m) });
            lanes.push(Lane { interpolating: true, ..lane(&far, 0.0, 60.0, y_m) });
        }
        let map = LaneMap { lanes, ..LaneMap::default() };
        let mut scene = Scene::bare("road", map, Vec::new());
        scene.time.steps = steps;
        scene
    }

    fn asked(scene: Scene, per_hour: f64, seed: u64) -> PlaceRequest {
        PlaceRequest {
            amount: Amount::PerLaneKm(0.0),
            arrivals: vec![Arrivals { arm: "west".into(), per_hour }],
            seed,
            ..PlaceRequest::new(Arc::new(scene))
        }
    }

    fn placed(graph: &LaneGraph, request: &PlaceRequest) -> Placement {
        crate::placement::place(None, graph, request, &Cancel::default()).unwrap()
    }

    fn boxes_at(all: &[Agent], step: usize) -> Vec<OrientedBox> {
        let at =
            |a: &Agent| Some(outline(a.state_at(step)?.position(), a.state_at(step)?.heading_rad, a.size));
        all.iter().filter_map(at).collect()
    }

    #[test]
    fn on_average_as_many_pass_as_were_asked_for() {
        let scene = road(301);
        let graph = LaneGraph::new(&scene.map);
        let (runs, per_hour) = (200, 1_440.0);
        let (mut there, mut later, mut lost) = (0, 0, 0);
        for seed in 0..runs {
            let request = asked(scene.clone(), per_hour, seed);
            let placement = placed(&graph, &request);
            let arm = &placement.arms[0];
            there += arm.placed;
            later += arm.later;
            lost += placement.unplaced.values().sum::<usize>();
            assert_eq!(placement.agents.len(), arm.placed + arm.later);
            for agent in &placement.agents {
                let first = agent.track.first_step;
                assert!(
                    agent.track.states.iter().flatten().all(|s| s.speed_mps() <= 14.0 + 0.01),
                    "{agent:?}"
                );
                let fixed = agent.conditions.start.position.is_some();
                assert_eq!(fixed, first == 0, "only an agent present at the start has a fixed one");
            }
            let start = boxes_at(&placement.agents, 0);
            for (i, a) in start.iter().enumerate() {
                let near = start[..i].iter().filter(|b| scene::geometry::obb::overlaps(a, b, 2.0 - 5e-3));
                let behind = near.filter(|b| (a.center().y - b.center().y).abs() < 1.0).count();
                assert_eq!(behind, 0, "seed {seed}: two are less than 2 m apart on a lane");
            }
            // Later arrivals keep their distance for as long as their motion is known.
            let late: Vec<Agent> =
                placement.agents.iter().filter(|a| a.track.first_step > 0).cloned().collect();
            for step in (0..301).step_by(5) {
                let now = boxes_at(&late, step);
                for (i, a) in now.iter().enumerate() {
                    assert!(
                        now[..i].iter().all(|b| !scene::geometry::obb::overlaps(a, b, 0.5)),
                        "seed {seed}"
                    );
                }
            }
        }
        let per_s = per_hour / 3600.0;
        let travel_s = 200.0 / (0.95 * 14.0);
        let close = |count: usize, seconds: f64| {
            let (mean, expected) = (count as f64 / runs as f64, per_s * seconds);
            assert!((mean / expected - 1.0).abs() < 0.05, "{mean} for {expected}");
        };
        close(there, travel_s);
        close(later, 30.0);
        assert!((lost as f64) < 0.01 * (there + later) as f64, "{lost} found no place");
    }

    #[test]
    fn more_than_the_lanes_take_is_said() {
        let scene = road(101);
        let graph = LaneGraph::new(&scene.map);
        let placement = placed(&graph, &asked(scene.clone(), 9_000.0, 1));
        assert_eq!(placement.arms[0].most_per_hour, 4_800.0);
        let reason = placement.reason.unwrap();
        assert!(reason.contains("arm west takes 4800 vehicles an hour at most"), "{reason}");
        assert!(placement.unplaced.values().sum::<usize>() > 10);
        let unknown = PlaceRequest {
            arrivals: vec![Arrivals { arm: "moon".into(), per_hour: 1.0 }],
            ..PlaceRequest::new(Arc::new(scene))
        };
        let refused = crate::placement::place(None, &graph, &unknown, &Cancel::default());
        let message = refused.unwrap_err().to_string();
        assert_eq!(message, "no arm \"moon\"; west expected");
    }

    #[test]
    fn late_comers_wait_at_a_red_light_and_leave_at_the_other_end() {
        let mut scene = road(401);
        let red = |lane: &str, state| Signal {
            lane: lane.into(),
            stop: Some(Vec2::new(0.0, 0.0)),
            stop_z_m: None,
            runs: vec![(0, state)],
        };
        let graph = LaneGraph::new(&scene.map);
        let far = |scene: &Scene| {
            let all = placed(&graph, &asked(scene.clone(), 1_200.0, 3)).agents;
            let last = |a: &Agent| {
                a.track.states.iter().flatten().map(|s| s.x_m + 0.5 * a.size.length_m).fold(-200.0, f64::max)
            };
            all.iter().filter(|a| a.track.first_step > 0).map(last).fold(-200.0, f64::max)
        };
        assert!(far(&scene) > 50.0, "they drive through");
        scene.signals = vec![red("out1", SignalState::Stop), red("out2", SignalState::Stop)];
        let nose_m = far(&scene);
        assert!((-90.0..=0.5).contains(&nose_m), "{nose_m}");
    }

    #[test]
    fn a_region_in_the_middle_lets_nobody_appear_on_the_road() {
        let scene = road(301);
        let graph = LaneGraph::new(&scene.map);
        let mut request = asked(scene, 1_440.0, 5);
        request.region = Region::Circle { center: Vec2::new(-60.0, -2.0), radius_m: 50.0 };
        request.speeds = Some(SpeedRange { min_mps: 5.0, max_mps: 8.0 });
        let placement = placed(&graph, &request);
        let arm = &placement.arms[0];
        assert!(arm.placed > 2 && arm.later == 0, "{arm:?}");
        assert!(placement.reason.unwrap().contains("no way in later"));
        for agent in &placement.agents {
            let state = agent.state_at(0).unwrap();
            assert!(request.region.contains(state.position()));
            assert!((5.0 - 1e-3..=8.001).contains(&state.speed_mps()), "{}", state.speed_mps());
        }
    }
}
