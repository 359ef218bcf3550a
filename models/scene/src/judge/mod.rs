//! Judges every future by the rules of a scene's score; each fault has its time, place and extent.

mod about;
mod forcing;
pub mod manoeuvre;
mod relations;
mod trace;

pub use about::{About, Fault, FaultKind, Manoeuvre, Reaction, ReactionKind, Relation, RelationKind};
pub use forcing::Change;
pub use manoeuvre::manoeuvre;
pub use relations::relations;
pub use trace::{SAME_WAY_RAD, SharedGround, Trace, crossing};

use crate::score::goal::goal_error;
use crate::score::lane_rules::end_step;
use crate::score::pairs::{Meeting, Mover, MoverBounds};
use crate::score::recorded::{self, MotionRule};
use crate::score::report::{RedLight, Stretch};
use crate::score::road::{RoadScore, score_road};
use crate::score::signals::{SignalStopLine, crossed_at_red, stop_lines};
use crate::score::{Actor, Drivable, Exclude, PairChoice, ScoreInput, Thresholds};
use crate::via::passings;
use crate::{AgentType, LaneMap, Passing, STEP_S, Signal, State, Via};
use std::cell::LazyCell;
use std::ops::Range;
use std::sync::OnceLock;

/// A corner this far past the edge is a wheel on the kerb, not a fault, metres.
const PAST_EDGE_M: f64 = 0.15;
/// Stretches off the road shorter than this are ignored, metres driven.
const TOUCH_M: f64 = 0.3;
/// Stretches against the traffic shorter than this are turns across it, metres driven. They count if the
/// vehicle faces the traffic for a longer time, seconds, or ends that way.
const WRONG_WAY_M: f64 = 4.0;
const FACING_S: f64 = 1.0;
/// Harsh braking and steering shorter than this is noise, seconds.
pub const HARSH_S: f64 = 0.2;

/// The rules of one scene over a range of steps. Cheap to make; judges any number of motions.
pub struct Judge<'a> {
    /// An input without actors: the map, the time and the thresholds.
    input: ScoreInput<'a>,
    lines: Vec<SignalStopLine<'a>>,
}

/// Another agent, with the motion that the judged one may meet.
pub struct Other<'a> {
    actor: Actor<'a>,
    bounds: MoverBounds,
    /// Made for the first motion that comes near.
    mover: OnceLock<Mover>,
}

impl Other<'_> {
    /// The agent's id.
    pub fn id(&self) -> &str {
        self.actor.id
    }
}

impl<'a> Judge<'a> {
    /// A judge for the scene steps `steps`, the start of the motions first.
    pub fn new(map: &'a LaneMap, signals: &'a [Signal], drivable: &'a Drivable, steps: Range<usize>) -> Self {
        let input = ScoreInput {
            actors: Vec::new(),
            map,
            signals,
            drivable,
            steps,
            pairs: PairChoice::All,
            exclude: Exclude::OverlapAtStart,
            thresholds: Thresholds { offroad_m: PAST_EDGE_M, ..Thresholds::default() },
        };
        Self { lines: stop_lines(&input), input }
    }

    /// Replaces the thresholds; a wheel on the kerb is still no fault.
    #[must_use]
    pub fn with_thresholds(mut self, thresholds: Thresholds) -> Self {
        self.input.thresholds = Thresholds { offroad_m: thresholds.offroad_m.max(PAST_EDGE_M), ..thresholds };
        self
    }

    /// Prepares another agent for many comparisons.
    pub fn other(&self, actor: Actor<'a>) -> Other<'a> {
        let bounds = MoverBounds::new(&actor, self.input.steps.clone());
        Other { actor, bounds, mover: OnceLock::new() }
    }

    /// Faults of a motion that do not involve another agent: road, signals, braking, steering, goal. Faults
    /// that the recording also shows are left out.
    pub fn alone(&self, actor: &Actor<'_>) -> Vec<Fault> {
        let mut found = Vec::new();
        let mut road = self.road(actor);
        recorded::mark_road(&self.input, actor, &mut road);
        let mut add = |kind, stretches: Vec<Stretch>, keeps: &dyn Fn(&Stretch) -> bool| {
            found.extend(stretches.into_iter().filter(|s| !s.in_log && keeps(s)).map(|s| fault(kind, s)));
        };
        // A motion that starts off the road or against the traffic was placed there.
        let first_s = self.input.steps.start as f64 * STEP_S;
        let entered = |s: &Stretch| s.time_s > first_s + 1e-6;
        let driven = |s: &Stretch| entered(s) && self.driven_m(actor, s) >= TOUCH_M;
        add(FaultKind::OffRoad, road.off_road, &driven);
        add(FaultKind::OverMedian, road.over_median, &driven);
        let end = end_step(&self.input, actor).filter(|end| !self.is_in_junction(actor, *end));
        let against = |s: &Stretch| {
            let ends = end.is_some_and(|end| (step(s.time_s)..=step(s.until_s)).contains(&end));
            let long = s.worst.unwrap_or(0.0) >= WRONG_WAY_M || s.until_s - s.time_s >= FACING_S - 1e-6;
            entered(s) && (long || ends)
        };
        add(FaultKind::WrongWay, road.wrong_way, &against);
        let lasting = |s: &Stretch| s.until_s - s.time_s >= HARSH_S - 1e-6;
        for rule in MotionRule::ALL {
            let (kind, keeps): (_, &dyn Fn(&Stretch) -> bool) = match rule {
                MotionRule::Braking => (FaultKind::HarshBraking, &lasting),
                MotionRule::Steering => (FaultKind::HarshSteering, &lasting),
                MotionRule::OffMap => (FaultKind::OffMap, &entered),
                MotionRule::OnCarriageway => (FaultKind::OnCarriageway, &|_| true),
                MotionRule::Speeding => (FaultKind::Speeding, &|_| true),
                MotionRule::Running => (FaultKind::Running, &|_| true),
                MotionRule::Askew => (FaultKind::Askew, &|_| true),
            };
            add(kind, rule.breaches(&self.input, actor), keeps);
        }
        let red = crossed_at_red(&self.input, actor, &self.lines);
        let red = recorded::beyond_log(&self.input, actor, &self.lines, red);
        found.extend(red.into_iter().map(|r| at_red(actor, r)));
        found.extend(self.vias_missed(actor));
        found.extend(self.goal_missed(actor));
        found
    }

    /// Whether there are signals to obey.
    pub fn has_lights(&self) -> bool {
        !self.lines.is_empty()
    }

    /// Whether a motion crosses a stop line at red.
    pub fn runs_red(&self, actor: &Actor<'_>) -> bool {
        !crossed_at_red(&self.input, actor, &self.lines).is_empty()
    }

    /// Collisions and near misses of a motion with the others.
    pub fn among<'o>(&self, actor: &Actor<'_>, others: impl Iterator<Item = &'o Other<'a>>) -> Vec<Fault>
    where
        'a: 'o,
    {
        let mover_of = |actor: &Actor<'_>| Mover::new(actor, self.input.steps.clone());
        let bounds = MoverBounds::new(actor, self.input.steps.clone());
        let mover = LazyCell::new(|| mover_of(actor));
        let meets = |other: &Other<'_>| {
            if !Meeting::is_possible(&self.input, &bounds, &other.bounds) {
                return None;
            }
            let theirs = other.mover.get_or_init(|| mover_of(&other.actor));
            let met = Meeting::between(&self.input, (actor, &mover), (&other.actor, theirs))?;
            let (kind, time_s, extent) = match met {
                Meeting::Collision { time_s, closing_speed_mps, .. } => {
                    (FaultKind::Collision, time_s, closing_speed_mps)
                }
                // Boxes that overlap have collided, however little.
                Meeting::Overlap { time_s, .. } => (FaultKind::Collision, time_s, 0.0),
                Meeting::Near { time_s, distance_m, .. } => (FaultKind::NearMiss, time_s, distance_m),
            };
            let state = near(actor, time_s)?;
            let with = Some(other.actor.id.to_owned());
            Some(Fault { with, ..new(kind, (time_s, time_s), state, Some(extent)) })
        };
        others.filter(|o| o.actor.id != actor.id).filter_map(meets).collect()
    }

    /// Whether a lane at its place leads through a junction, where the right heading is ambiguous.
    fn is_in_junction(&self, actor: &Actor<'_>, step: usize) -> bool {
        let lanes = actor.state(step).map(|s| self.input.drivable.vehicle_lanes(s.position()));
        lanes.into_iter().flatten().any(|(_, band)| band.in_junction)
    }

    /// Metres driven in a stretch and in the step before it. That step covers a vehicle that leaves the kerb
    /// at once.
    fn driven_m(&self, actor: &Actor<'_>, stretch: &Stretch) -> f64 {
        let steps = step(stretch.time_s).saturating_sub(1)..step(stretch.until_s);
        steps.filter_map(|i| actor.state(i)).map(|s| s.speed_mps() * STEP_S).sum()
    }

    /// Cyclists may use pavements and ride both ways, but not over a median.
    fn road(&self, actor: &Actor<'_>) -> RoadScore {
        if actor.agent_type != AgentType::Cyclist {
            return score_road(&self.input, actor);
        }
        let as_driver = Actor { agent_type: AgentType::Vehicle, ..actor.clone() };
        let mut road = score_road(&self.input, &as_driver);
        road.off_road.clear();
        road.wrong_way.clear();
        road
    }

    fn vias_missed(&self, actor: &Actor<'_>) -> Vec<Fault> {
        let first = self.input.steps.start;
        let states: Vec<State> =
            (first..self.input.steps.end).map_while(|i| actor.state(i)).copied().collect();
        let passed = passings(actor.via, first as f64 * STEP_S, &states);
        let missed = actor.via.iter().zip(passed).filter(|(via, passing)| !via.is_passed(passing));
        let fault = |(_, at): (&Via, Passing)| {
            let state = State { x_m: at.place.x, y_m: at.place.y, ..State::default() };
            new(FaultKind::ViaMissed, (at.time_s, at.time_s), &state, Some(at.distance_m))
        };
        missed.map(fault).collect()
    }

    fn goal_missed(&self, actor: &Actor<'_>) -> Option<Fault> {
        let error = goal_error(actor)?;
        if error.is_reached(&self.input.thresholds) {
            return None;
        }
        let due_s = actor.goal.time_s.unwrap_or(f64::INFINITY);
        // A future that covers only a first part of the scene has no verdict on a later goal.
        let known = actor.track.last_valid_step()? + 1;
        if due_s > known as f64 * STEP_S && known < self.input.steps.end {
            return None;
        }
        let time_s = due_s.min(self.input.steps.end.saturating_sub(1) as f64 * STEP_S);
        let state = near(actor, time_s)?;
        Some(new(FaultKind::GoalMissed, (time_s, time_s), state, error.position_m))
    }
}

/// Sorts the worst first, then by time: the order of [`About::faults`].
pub fn by_weight(faults: &mut [Fault]) {
    faults.sort_by(|a, b| a.kind.cmp(&b.kind).then(a.time_s.total_cmp(&b.time_s)));
}

fn step(time_s: f64) -> usize {
    (time_s / STEP_S).round().max(0.0) as usize
}

fn near<'s>(actor: &'s Actor<'_>, time_s: f64) -> Option<&'s State> {
    actor.state(step(time_s)).or_else(|| actor.state(actor.track.last_valid_step()?))
}

fn new(kind: FaultKind, (time_s, until_s): (f64, f64), state: &State, extent: Option<f64>) -> Fault {
    let place = state.position();
    let extent = extent.map(rounded);
    Fault {
        kind,
        time_s,
        until_s,
        x_m: rounded(place.x),
        y_m: rounded(place.y),
        extent,
        with: None,
        edge: None,
    }
}

fn fault(kind: FaultKind, stretch: Stretch) -> Fault {
    let place = State { x_m: stretch.x_m, y_m: stretch.y_m, ..State::default() };
    let edge = stretch.edge;
    Fault { edge, ..new(kind, (stretch.time_s, stretch.until_s), &place, stretch.worst) }
}

fn at_red(actor: &Actor<'_>, found: RedLight) -> Fault {
    let state = near(actor, found.time_s).copied().unwrap_or_default();
    new(FaultKind::RedLight, (found.time_s, found.time_s), &state, Some(found.speed_mps))
}

/// Rounded to a millimetre, as coordinates are written.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec2;
    use crate::score::tests::straight;
    use std::f64::consts::PI;

    const CAR: AgentType = AgentType::Vehicle;

    fn kinds(map: &LaneMap, me: &Actor<'_>, other: Option<Actor<'_>>) -> Vec<FaultKind> {
        let drivable = Drivable::new(map);
        let judge = Judge::new(map, &[], &drivable, 0..91);
        let others: Vec<Other<'_>> = other.into_iter().map(|o| judge.other(o)).collect();
        let mut faults = judge.alone(me);
        faults.extend(judge.among(me, others.iter()));
        faults.iter().map(|f| f.kind).collect()
    }

    #[test]
    fn boxes_that_touch_have_met_and_a_brush_at_speed_is_a_near_miss() {
        let passes = |beside_m: f64| {
            let me = straight("a", CAR, (-30.0, 0.0), 0.0, 8.0);
            let other = straight("b", CAR, (30.0, beside_m), PI, 8.0);
            kinds(&LaneMap::default(), &me, Some(other))
        };
        assert_eq!(passes(1.95), [FaultKind::Collision]);
        assert_eq!(passes(2.1), [FaultKind::NearMiss]);
        assert_eq!(passes(2.3), [FaultKind::NearMiss]);
        assert!(passes(2.6).is_empty());
        let beside_parked = |beside_m: f64| {
            let me = straight("a", CAR, (-30.0, 0.0), 0.0, 8.0);
            kinds(&LaneMap::default(), &me, Some(straight("b", CAR, (0.0, beside_m), PI, 0.0)))
        };
        assert_eq!(beside_parked(2.1), [FaultKind::NearMiss]);
        assert!(beside_parked(2.3).is_empty(), "parked cars stand beside every lane");
    }

    #[test]
    fn a_goal_after_what_is_known_of_a_future_is_not_missed() {
        let map = LaneMap::default();
        let drivable = Drivable::new(&map);
        let misses = |steps: usize, due_s: f64| {
            let mut me = straight("a", CAR, (0.0, 0.0), 0.0, 10.0);
            me.goal = crate::Goal {
                position: Some(Vec2::new(140.0, 0.0)),
                time_s: Some(due_s),
                ..crate::Goal::default()
            };
            let judge = Judge::new(&map, &[], &drivable, 0..steps);
            judge.alone(&me).iter().any(|f| f.kind == FaultKind::GoalMissed)
        };
        // The motion is known for 9 s of the scene.
        assert!(!misses(151, 14.0));
        assert!(misses(151, 9.0));
        // Nothing is known after its end, so it ends short of its goal.
        assert!(misses(91, 14.0));
    }

    #[test]
    fn to_face_the_traffic_for_long_is_the_wrong_way_too() {
        let lane = crate::map::Lane::street("east", vec![Vec2::new(-50.0, 0.0), Vec2::new(50.0, 0.0)]);
        let map = LaneMap { lanes: vec![lane], ..LaneMap::default() };
        // It creeps beside the lane, and on it for a while, facing the traffic.
        let comes = |seconds: f64| {
            let mut me = straight("a", CAR, (0.0, 0.0), PI, 1.2);
            let on = step(6.0)..step(6.0 + seconds);
            let states = me.track.to_mut().states.iter_mut().enumerate();
            let beside = states.filter(|(i, _)| !on.contains(i)).filter_map(|(_, state)| state.as_mut());
            beside.for_each(|state| state.y_m = 30.0);
            kinds(&map, &me, None)
        };
        assert!(comes(2.0).contains(&FaultKind::WrongWay));
        assert!(!comes(0.5).contains(&FaultKind::WrongWay));
    }

    #[test]
    fn a_short_end_in_the_oncoming_lane_is_the_wrong_way() {
        let lanes = |interpolating| {
            let line = |points: [(f64, f64); 2]| points.map(|(x, y)| Vec2::new(x, y)).to_vec();
            let own = crate::map::Lane::street("own", line([(-50.0, 0.0), (150.0, 0.0)]));
            let oncoming = crate::map::Lane::street("oncoming", line([(150.0, 3.5), (-50.0, 3.5)]));
            let oncoming = crate::map::Lane { interpolating, ..oncoming };
            LaneMap { lanes: vec![own, oncoming], ..LaneMap::default() }
        };
        // It is in the oncoming lane for 0.2 s and 1.2 m, 30 degrees askew, and comes to rest there.
        let mut me = straight("a", CAR, (0.0, 0.0), 0.0, 6.0);
        for (i, state) in me.track.to_mut().states.iter_mut().flatten().enumerate().skip(88) {
            (state.y_m, state.heading_rad) = (2.6, PI / 6.0);
            state.vx_mps = if i == 90 { 0.0 } else { 6.0 };
        }
        let against = |map: &LaneMap, me: &Actor<'_>| kinds(map, me, None).contains(&FaultKind::WrongWay);
        assert!(against(&lanes(false), &me));
        assert!(!against(&lanes(true), &me), "which way to face in a junction cannot be told");
        let back = me.track.to_mut().states.last_mut();
        back.into_iter().flatten().for_each(|state| (state.y_m, state.heading_rad) = (0.0, 0.0));
        assert!(!against(&lanes(false), &me), "it only cut across");
    }
}
