//! The reply to `POST /v1/score` and its members.

use super::accuracy::Accuracy;
use super::goal::GoalError;
use super::input::{Actor, ScoreInput, Thresholds};
use super::kinematic::Kinematic;
use super::pairs::{Measures, PairScores, PairTotals};
use super::recorded::MotionRule;
use crate::{AgentId, State};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// Reply to a score request.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ScoreReply")]
pub struct Score {
    /// The scene as a whole.
    pub scene: SceneScore,
    /// Scores of the road users by id.
    pub agents: BTreeMap<AgentId, AgentScore>,
    /// The thresholds that were used.
    pub thresholds: Thresholds,
}

/// Two road users collide: their boxes overlap by more than the thresholds. One entry per pair.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Collision {
    /// The road user listed first.
    pub a: AgentId,
    /// The other.
    pub b: AgentId,
    /// Scene time of the first moment over the threshold, seconds.
    pub time_s: f64,
    /// Greatest intersection over union of the whole encounter, 0 to 1.
    pub iou: f64,
    /// Closing speed at the first moment, m/s (relative speed if they already overlap).
    pub closing_speed_mps: f64,
    /// Both move as recorded; the event does not count.
    pub in_log: bool,
}

/// The boxes of two road users overlap by less than the thresholds of a collision. One entry per pair.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Overlap")]
pub struct BoxOverlap {
    /// The road user listed first.
    pub a: AgentId,
    /// The other.
    pub b: AgentId,
    /// Scene time of the first step at which they overlap, seconds.
    pub time_s: f64,
    /// Greatest depth, metres: the least gap of the pair, with the opposite sign.
    pub depth_m: f64,
    /// The event is in the log: both move as recorded, or the recording has an overlap as deep. It does not
    /// count.
    pub in_log: bool,
}

/// Two moving road users nearly collide, and their boxes never touch. One entry per pair, at its worst
/// moment.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct NearMiss {
    /// The road user listed first.
    pub a: AgentId,
    /// The other.
    pub b: AgentId,
    /// Scene time, seconds.
    pub time_s: f64,
    /// Gap between the boxes at that time, metres.
    pub distance_m: f64,
    /// Time to collision at that time, at constant velocity, seconds, if there is one.
    pub ttc_s: Option<f64>,
    /// Rate at which the gap shrinks at that time, m/s.
    pub closing_speed_mps: f64,
    /// The event is in the log: both move as recorded, or the recording has the same encounter at about the
    /// same time, at least as severe. It does not count.
    pub in_log: bool,
}

/// Kind of an encounter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EncounterKind {
    /// In the list of collisions.
    Collision,
    /// In the list of overlaps.
    Overlap,
    /// In the list of near misses.
    NearMiss,
}

/// A pair with a collision, an overlap or a near miss, and its surrogate safety measures.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Encounter {
    /// The road user listed first.
    pub a: AgentId,
    /// The other.
    pub b: AgentId,
    /// Kind of the event.
    pub kind: EncounterKind,
    /// Scene time of the event, seconds.
    pub time_s: f64,
    /// Midpoint between the two at that time, metres.
    pub x_m: f64,
    /// Midpoint between the two at that time, metres.
    pub y_m: f64,
    /// The worst values up to the event.
    #[serde(flatten)]
    pub measures: Measures,
    /// The worst values of the recording over the scored time; null without a recording of both.
    pub log: Option<Measures>,
    /// As in the list of its kind.
    pub in_log: bool,
}

/// An event of one road user over a time interval.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Stretch {
    /// The road user.
    pub agent: AgentId,
    /// Scene time of the first step, seconds.
    pub time_s: f64,
    /// Scene time of the last step, seconds.
    pub until_s: f64,
    /// Greatest value, in the unit of its list: metres off the road, off the map, driven against the traffic or walked
    /// on the carriageway; m/s2 of braking or sideways acceleration; share of the limit for turns; m/s above the speed
    /// limit or of running; radians askew.
    pub worst: Option<f64>,
    /// Box centre where it is worst, metres.
    pub x_m: f64,
    /// Box centre where it is worst, metres.
    pub y_m: f64,
    /// Off the road and over a median: the road edge that is driven over, by its id in the map.
    pub edge: Option<String>,
    /// The event is in the log: the motion is the recorded one, or the recording has the same event at about
    /// the same time, at least as severe.
    pub in_log: bool,
}

/// A stop line is crossed while its signal says stop.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RedLight {
    /// The road user.
    pub agent: AgentId,
    /// Lane of the red signal.
    pub lane: String,
    /// Scene time at which the front crosses, seconds.
    pub time_s: f64,
    /// Speed at that time, m/s.
    pub speed_mps: f64,
    /// The event is in the log: the motion is the recorded one, or the recording has the same event at about
    /// the same time, at least as severe.
    pub in_log: bool,
}

/// Score of the scene. Shares are 0 to 1 and `None` where no road user qualifies.
///
/// Lists include events of the log, marked `in_log`. These events do not count in `collision_rate` and in the
/// counts of road users. Distances, times and the other shares cover all motion, including recorded motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct SceneScore {
    /// By time, then by pair.
    pub collisions: Vec<Collision>,
    /// Share of road users in any collision that is not in the log.
    pub collision_rate: f64,
    /// Share of road users in any collision, including those in the log (the paper's scenario collision
    /// rate).
    pub collision_rate_with_log: f64,
    /// Share of road users with any overlap of boxes, however small.
    pub overlap_rate: f64,
    /// By time, then by pair.
    pub overlaps: Vec<BoxOverlap>,
    /// By time, then by pair.
    pub near_misses: Vec<NearMiss>,
    /// The pairs of the three lists with their measures. By time, then by pair.
    pub encounters: Vec<Encounter>,
    /// Least time to collision of any pair at constant velocity, seconds; none within the look-ahead.
    pub min_ttc_s: Option<f64>,
    /// The pair with `min_ttc_s`.
    pub min_ttc_pair: Option<[AgentId; 2]>,
    /// Least gap of any pair that is not parked, metres; below zero it is the depth of a collision or an
    /// overlap. Contact between pedestrians who walk together does not count.
    pub min_distance_m: Option<f64>,
    /// Least post-encroachment time of crossing paths, seconds.
    pub pet_s: Option<f64>,
    /// Share of vehicle steps with a corner off the road.
    pub offroad_share: Option<f64>,
    /// Greatest distance of a vehicle's corner from the road, metres.
    pub offroad_max_m: Option<f64>,
    /// The map has no drivable areas, and some lane widths were assumed by type.
    pub assumed_width: bool,
    /// Share of moving vehicle steps against the direction of every lane there.
    pub wrong_way_share: Option<f64>,
    /// Greatest values of all generated road users, and their violations together.
    pub kinematic: Option<Kinematic>,
    /// Means over the road users with fixed goal fields.
    pub goal_error: Option<GoalError>,
    /// Share of road users with fixed goal fields that meet them all.
    pub goals_reached: Option<f64>,
    /// Means over the road users with a reference; null without one.
    #[serde(flatten, serialize_with = "nullable")]
    #[schemars(with = "Accuracy")]
    pub accuracy: Option<Accuracy>,
    /// Vehicles off the road, except those over a median.
    pub off_road: Vec<Stretch>,
    /// Vehicles over the median between two directions.
    pub over_median: Vec<Stretch>,
    /// Vehicles against the traffic.
    pub wrong_way: Vec<Stretch>,
    /// Braking harder than the threshold; `worst` in m/s2.
    pub harsh_braking: Vec<Stretch>,
    /// Steering harder than the threshold; `worst` is the sideways acceleration, m/s2.
    pub harsh_steering: Vec<Stretch>,
    /// Vehicles beyond the end of the map's roads; `worst` in metres from the lanes.
    pub off_map: Vec<Stretch>,
    /// Pedestrians along a lane, or across lanes beside a crosswalk; `worst` in metres walked.
    pub on_carriageway: Vec<Stretch>,
    /// Vehicles above the speed limit; `worst` is the excess, m/s.
    pub speeding: Vec<Stretch>,
    /// Pedestrians that run; `worst` in m/s.
    pub running: Vec<Stretch>,
    /// Vehicles that end at an angle to their lane; `worst` in radians.
    pub askew: Vec<Stretch>,
    /// Turns over a limit of lateral acceleration, yaw rate or curvature (generated motion only).
    pub implausible_turns: Vec<Stretch>,
    /// Stop lines crossed at red.
    pub red_lights: Vec<RedLight>,
    #[serde(skip)]
    pub(super) offroad_steps: usize,
    #[serde(skip)]
    pub(super) road_steps: usize,
    #[serde(skip)]
    pub(super) wrong_way_steps: usize,
    #[serde(skip)]
    pub(super) moving_steps: usize,
}

/// Score of one road user.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct AgentScore {
    /// Its collisions that are not in the log.
    pub collisions: usize,
    /// Its overlaps below the threshold of a collision that are not in the log.
    pub overlaps: usize,
    /// Its near misses that are not in the log.
    pub near_misses: usize,
    /// As in [`SceneScore`].
    pub min_ttc_s: Option<f64>,
    /// As in [`SceneScore`].
    pub min_distance_m: Option<f64>,
    /// As in [`SceneScore`].
    pub pet_s: Option<f64>,
    /// Vehicles only.
    pub offroad_share: Option<f64>,
    /// Vehicles only.
    pub offroad_max_m: Option<f64>,
    /// Vehicles only.
    pub wrong_way_share: Option<f64>,
    /// Generated motion only.
    pub kinematic: Option<Kinematic>,
    /// Only when a goal field is fixed.
    pub goal_error: Option<GoalError>,
    /// Against the reference; null without one.
    #[serde(flatten, serialize_with = "nullable")]
    #[schemars(with = "Accuracy")]
    pub accuracy: Option<Accuracy>,
}

/// Members that no reference gives a value are null, as everywhere in a score.
fn nullable<S: Serializer>(accuracy: &Option<Accuracy>, serializer: S) -> Result<S::Ok, S::Error> {
    accuracy.unwrap_or_default().serialize(serializer)
}

impl SceneScore {
    /// Completes the score from the pairs and the single road users.
    pub(super) fn finish(&mut self, input: &ScoreInput<'_>, pairs: PairScores, agents: &[AgentScore]) {
        self.min_ttc_s = minimum(agents.iter().map(|a| a.min_ttc_s));
        let soonest =
            pairs.agents.iter().position(|a| a.min_ttc_s.is_some() && a.min_ttc_s == self.min_ttc_s);
        let id = |k: usize| input.actors.get(k).map(|actor| actor.id.to_owned());
        self.min_ttc_pair = soonest.and_then(|k| Some([id(k)?, id(pairs.agents[k].min_ttc_with?)?]));
        self.min_distance_m = minimum(agents.iter().map(|a| a.min_distance_m));
        self.pet_s = minimum(agents.iter().map(|a| a.pet_s));
        let of_all = |count: usize| count as f64 / agents.len().max(1) as f64;
        self.collision_rate = of_all(agents.iter().filter(|a| a.collisions > 0).count());
        let any = |a: &PairTotals| a.collisions + a.logged_collisions > 0;
        self.collision_rate_with_log = of_all(pairs.agents.iter().filter(|a| any(a)).count());
        self.overlap_rate = of_all(pairs.agents.iter().filter(|a| a.overlaps).count());
        self.collisions = pairs.collisions;
        self.overlaps = pairs.overlaps;
        self.near_misses = pairs.near_misses;
        self.encounters = pairs.encounters;
        self.encounters.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
        self.collisions.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
        self.overlaps.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
        self.near_misses.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
        self.red_lights.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
        self.offroad_share = share(self.offroad_steps, self.road_steps);
        self.offroad_max_m = maximum(agents.iter().map(|a| a.offroad_max_m));
        self.assumed_width = input.drivable.assumed_width();
        self.wrong_way_share = share(self.wrong_way_steps, self.moving_steps);
        self.kinematic = Kinematic::over_all(agents.iter().filter_map(|a| a.kinematic.as_ref()));
        self.goal_error = GoalError::mean(agents.iter().filter_map(|a| a.goal_error.as_ref()));
        let goals = agents.iter().filter_map(|a| a.goal_error.as_ref());
        let reached = goals.clone().filter(|g| g.is_reached(&input.thresholds)).count();
        self.goals_reached = share(reached, goals.count());
        self.accuracy = Accuracy::mean(agents.iter().filter_map(|a| a.accuracy.as_ref()));
        let by_time = |list: &mut Vec<Stretch>| list.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
        let roads = [&mut self.off_road, &mut self.over_median, &mut self.wrong_way];
        roads.into_iter().chain([&mut self.implausible_turns]).for_each(by_time);
        MotionRule::ALL.into_iter().for_each(|rule| by_time(self.breaches_mut(rule)));
    }

    /// The list of a rule.
    pub(super) fn breaches_mut(&mut self, rule: MotionRule) -> &mut Vec<Stretch> {
        match rule {
            MotionRule::Braking => &mut self.harsh_braking,
            MotionRule::Steering => &mut self.harsh_steering,
            MotionRule::OffMap => &mut self.off_map,
            MotionRule::OnCarriageway => &mut self.on_carriageway,
            MotionRule::Speeding => &mut self.speeding,
            MotionRule::Running => &mut self.running,
            MotionRule::Askew => &mut self.askew,
        }
    }
}

/// Smallest of the known values.
pub(super) fn minimum(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    values.flatten().reduce(f64::min)
}

/// Greatest of the known values.
pub(super) fn maximum(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    values.flatten().reduce(f64::max)
}

/// Mean of the known values.
pub(super) fn mean(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let (sum, count) = values.flatten().fold((0.0, 0usize), |(s, n), v| (s + v, n + 1));
    (count > 0).then(|| sum / count as f64)
}

/// `part` of `whole`; `None` if `whole` is zero.
pub(super) fn share(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// Scene time of a step, seconds, rounded to a hundredth so that 3 x 0.1 reads 0.3.
pub(super) fn time_of(step: f64) -> f64 {
    (step * crate::STEP_S * 1000.0).round() / 1000.0
}

/// Groups flagged steps (ascending) into stretches; each has its greatest value and its place.
pub(super) fn stretches(actor: &Actor<'_>, flagged: &[(usize, f64)]) -> Vec<Stretch> {
    /// First and last step, the worst step and its value.
    type Found = (usize, usize, (usize, f64));
    let mut found: Vec<Found> = Vec::new();
    for &(step, value) in flagged {
        match found.last_mut() {
            Some((_, last, worst)) if step <= *last + 2 => {
                *last = step;
                if value > worst.1 {
                    *worst = (step, value);
                }
            }
            _ => found.push((step, step, (step, value))),
        }
    }
    let to_stretch = |(first, last, (step, value)): Found| {
        let place = actor.state(step).map(State::position).unwrap_or_default();
        Stretch {
            agent: actor.id.to_owned(),
            time_s: time_of(first as f64),
            until_s: time_of(last as f64),
            worst: Some(value),
            x_m: place.x,
            y_m: place.y,
            edge: None,
            in_log: false,
        }
    };
    found.into_iter().map(to_stretch).collect()
}
