//! Input of the score: the road users with their motion, the map index, signals and thresholds.

use super::drivable::Drivable;
use crate::geometry::obb::OrientedBox;
use crate::geometry::ttc::LOOK_AHEAD_S;
use crate::{Agent, AgentType, Future, Goal, LaneMap, Scene, Signal, Size, State, Subtype, Track, Via};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::ops::Range;

/// Thresholds of events. Ones absent in a document have their defaults.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(transform = Thresholds::describe_ranges)]
pub struct Thresholds {
    /// Boxes collide when their intersection over union is above this (the paper's collision rate: 0.02).
    pub iou: f64,
    /// Boxes also collide when more than this share of the smaller one is covered: a child under a bus has a
    /// tiny intersection over union. A value above 1 disables the rule (the paper's form).
    pub covered_share: f64,
    /// Near miss: time to collision below this, seconds. The search ends at [`LOOK_AHEAD_S`].
    pub ttc_s: f64,
    /// Near miss: gap below this, metres.
    pub gap_m: f64,
    /// Near miss: only when the gap shrinks faster than this, m/s.
    pub closing_speed_mps: f64,
    /// Near miss of a follower: only if it must brake harder than this to avoid the collision, m/s2 (DRAC,
    /// 3.35 in Archer 2005).
    pub follow_brake_mps2: f64,
    /// Near miss of two that pass each other at more than `pass_mps`: gap below this, metres.
    pub pass_gap_m: f64,
    /// Near miss of two that pass each other: only when their relative speed is above this, m/s.
    pub pass_mps: f64,
    /// Below this speed, a road user stands, m/s.
    pub moving_mps: f64,
    /// Braking above this is harsh, m/s2.
    pub harsh_brake_mps2: f64,
    /// A road user that gives way is forced to brake if it brakes harder than this, m/s2.
    pub forced_brake_mps2: f64,
    /// Sideways acceleration above this is harsh, m/s2.
    pub harsh_lateral_mps2: f64,
    /// A vehicle is off the road if a corner is farther outside than this, metres.
    pub offroad_m: f64,
    /// Off the map: no lane and no road edge within this distance, metres.
    pub off_map_m: f64,
    /// A vehicle is askew if it ends at more than this angle to every lane, radians.
    pub askew_rad: f64,
    /// Speeding: above the lane's limit by more than this share of it and `speeding_mps` together.
    pub speeding_share: f64,
    /// Speeding: see `speeding_share`, m/s.
    pub speeding_mps: f64,
    /// A pedestrian faster than this runs, m/s.
    pub running_mps: f64,
    /// Walking farther than this along a lane is walking on the carriageway, metres.
    pub along_lane_m: f64,
    /// Crossing beside a crosswalk, within this distance of it, is walking on the carriageway, metres.
    pub crosswalk_m: f64,
    /// Goal position met within this, metres.
    pub goal_position_m: f64,
    /// Goal heading met within this, radians.
    pub goal_heading_rad: f64,
    /// Goal speed met within this, m/s.
    pub goal_speed_mps: f64,
    /// Turning right at red after a stop is allowed.
    pub right_on_red: bool,
}

impl Default for Thresholds {
    fn default() -> Self {
        Self {
            iou: 0.0,
            covered_share: 0.5,
            ttc_s: 1.5,
            gap_m: 1.0,
            closing_speed_mps: 1.0,
            follow_brake_mps2: 3.35,
            pass_gap_m: 0.4,
            pass_mps: 3.0,
            moving_mps: 0.5,
            harsh_brake_mps2: 4.0,
            forced_brake_mps2: 3.0,
            harsh_lateral_mps2: 4.0,
            offroad_m: 0.1,
            off_map_m: 5.0,
            askew_rad: 0.26,
            speeding_share: 0.1,
            speeding_mps: 1.4,
            running_mps: 2.5,
            along_lane_m: 3.0,
            crosswalk_m: 15.0,
            goal_position_m: 0.05,
            goal_heading_rad: 0.02,
            goal_speed_mps: 0.05,
            right_on_red: true,
        }
    }
}

/// A number of [`Thresholds`] by the name of its field, with the range that it must be in.
#[derive(Clone, Copy, Debug)]
pub struct Threshold {
    /// Name of the field.
    pub name: &'static str,
    /// Lowest and highest allowed value, in the unit of the field.
    pub range: (f64, f64),
    of: fn(&Thresholds) -> f64,
}

impl Threshold {
    /// The default value.
    pub fn usual(&self) -> f64 {
        (self.of)(&Thresholds::default())
    }
}

impl Thresholds {
    /// [`Self::iou`].
    pub const IOU: Threshold = Threshold { name: "iou", range: (0.0, 1.0), of: |t| t.iou };
    /// [`Self::ttc_s`].
    pub const TTC_S: Threshold = Threshold { name: "ttc_s", range: (0.0, LOOK_AHEAD_S), of: |t| t.ttc_s };
    /// [`Self::gap_m`].
    pub const GAP_M: Threshold = Threshold { name: "gap_m", range: (0.0, 60.0), of: |t| t.gap_m };
    /// All of them. Beyond these ranges a value has no effect.
    pub const ALL: [Threshold; 23] = [
        Self::IOU,
        Threshold { name: "covered_share", range: (0.0, 2.0), of: |t| t.covered_share },
        Self::TTC_S,
        Self::GAP_M,
        Threshold { name: "closing_speed_mps", range: (0.0, 300.0), of: |t| t.closing_speed_mps },
        Threshold { name: "follow_brake_mps2", range: (0.0, 1_000.0), of: |t| t.follow_brake_mps2 },
        Threshold { name: "pass_gap_m", range: (0.0, 60.0), of: |t| t.pass_gap_m },
        Threshold { name: "pass_mps", range: (0.0, 300.0), of: |t| t.pass_mps },
        Threshold { name: "moving_mps", range: (0.0, 300.0), of: |t| t.moving_mps },
        Threshold { name: "harsh_brake_mps2", range: (0.0, 1_000.0), of: |t| t.harsh_brake_mps2 },
        Threshold { name: "forced_brake_mps2", range: (0.0, 1_000.0), of: |t| t.forced_brake_mps2 },
        Threshold { name: "harsh_lateral_mps2", range: (0.0, 1_000.0), of: |t| t.harsh_lateral_mps2 },
        Threshold { name: "offroad_m", range: (0.0, 100.0), of: |t| t.offroad_m },
        Threshold { name: "off_map_m", range: (0.0, 1_000.0), of: |t| t.off_map_m },
        Threshold { name: "askew_rad", range: (0.0, 4.0), of: |t| t.askew_rad },
        Threshold { name: "speeding_share", range: (0.0, 100.0), of: |t| t.speeding_share },
        Threshold { name: "speeding_mps", range: (0.0, 300.0), of: |t| t.speeding_mps },
        Threshold { name: "running_mps", range: (0.0, 300.0), of: |t| t.running_mps },
        Threshold { name: "along_lane_m", range: (0.0, 1_000.0), of: |t| t.along_lane_m },
        Threshold { name: "crosswalk_m", range: (0.0, 1_000.0), of: |t| t.crosswalk_m },
        Threshold { name: "goal_position_m", range: (0.0, 1_000.0), of: |t| t.goal_position_m },
        Threshold { name: "goal_heading_rad", range: (0.0, 4.0), of: |t| t.goal_heading_rad },
        Threshold { name: "goal_speed_mps", range: (0.0, 300.0), of: |t| t.goal_speed_mps },
    ];

    /// Largest gap of a near miss by gap, metres.
    pub fn near_gap_m(&self) -> f64 {
        self.gap_m.max(self.pass_gap_m)
    }

    /// Thresholds out of their range, each with its value.
    pub fn outside(&self) -> impl Iterator<Item = (Threshold, f64)> {
        let valued = Self::ALL.map(|threshold| (threshold, (threshold.of)(self)));
        valued.into_iter().filter(|(Threshold { range: (least, most), .. }, v)| !(least..=most).contains(&v))
    }

    fn describe_ranges(schema: &mut schemars::Schema) {
        let Some(fields) = schema.get_mut("properties").and_then(|p| p.as_object_mut()) else { return };
        for Threshold { name, range: (least, most), .. } in Self::ALL {
            if let Some(field) = fields.get_mut(name).and_then(|f| f.as_object_mut()) {
                field.insert("minimum".into(), least.into());
                field.insert("maximum".into(), most.into());
            }
        }
    }
}

/// The pairs to score.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum PairChoice {
    /// Every pair.
    #[default]
    All,
    /// Pairs with at least one generated road user.
    Regenerated,
}

/// Pairs that are left out because the recording itself shows them overlapping (detector boxes of neighbours
/// often touch).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Exclude {
    /// None.
    Nothing,
    /// Pairs that overlap at the first scored step that both logs have.
    #[default]
    OverlapAtStart,
    /// Pairs that overlap at any scored step of the log (the evaluation's rule).
    OverlapInLog,
}

/// One road user with the motion to score.
#[derive(Clone, Debug)]
pub struct Actor<'a> {
    /// Id in the scene.
    pub id: &'a str,
    /// Type.
    pub agent_type: AgentType,
    /// Finer type.
    pub subtype: Subtype,
    /// Box.
    pub size: Size,
    /// Motion by scene step: history from the log, then what is scored.
    pub track: Cow<'a, Track>,
    /// Recorded motion, if any: it determines the pairs to leave out.
    pub log: Option<&'a Track>,
    /// Whether the motion was generated, not recorded: kinematic limits apply.
    pub generated: bool,
    /// Goal of a generated motion; free for recorded motion.
    pub goal: Goal,
    /// Road edges that it may cross.
    pub may_cross: &'a [String],
    /// Via points of a generated motion; none for recorded motion.
    pub via: &'a [Via],
    /// Motion to compare with, if any.
    pub reference: Option<&'a Track>,
    /// All futures, of which the best is compared with the reference; if empty, only the track.
    pub modes: &'a [Future],
}

impl<'a> Actor<'a> {
    /// A road user with its recorded motion.
    pub fn of_log(agent: &'a Agent) -> Self {
        Self {
            id: &agent.id,
            agent_type: agent.agent_type,
            subtype: agent.subtype,
            size: agent.size,
            track: Cow::Borrowed(&agent.track),
            log: Some(&agent.track),
            generated: false,
            goal: Goal::default(),
            may_cross: &[],
            via: &[],
            reference: None,
            modes: &[],
        }
    }

    /// A road user with one of its futures after its history. The state before the future's first step is the
    /// log's, with the start fields of its conditions; the log is the reference.
    pub fn of_future(agent: &'a Agent, chosen: &Future, modes: &'a [Future]) -> Self {
        let conditions = &agent.conditions;
        Self {
            track: agent.shown(Some(chosen)).track,
            generated: true,
            goal: conditions.goal,
            may_cross: &conditions.may_cross,
            via: &conditions.via,
            reference: Some(&agent.track),
            modes,
            ..Self::of_kept(agent)
        }
    }

    /// A road user that keeps its log, with the type and size that it was given.
    pub fn of_kept(agent: &'a Agent) -> Self {
        Self { size: agent.shown_size(), agent_type: agent.kind(), ..Self::of_log(agent) }
    }

    /// State at a scene step.
    pub fn state(&self, step: usize) -> Option<&State> {
        self.track.at(step)
    }

    /// Box at a scene step.
    pub fn outline(&self, step: usize) -> Option<OrientedBox> {
        self.state(step).map(|s| OrientedBox::of_state(s, &self.size))
    }

    /// Greatest distance from its first place within `steps`, metres.
    pub fn travel_m(&self, steps: Range<usize>) -> f64 {
        let mut places = steps.filter_map(|i| self.state(i)).map(State::position);
        let Some(first) = places.next() else { return 0.0 };
        places.map(|p| (p - first).norm()).fold(0.0, f64::max)
    }
}

/// Everything a score needs.
#[derive(Clone, Debug)]
pub struct ScoreInput<'a> {
    /// Road users, in the order of the answer's pairs.
    pub actors: Vec<Actor<'a>>,
    /// Map of the scene: where the signals' lanes run.
    pub map: &'a LaneMap,
    /// Signals of the scene.
    pub signals: &'a [Signal],
    /// Index of the map, built once per map.
    pub drivable: &'a Drivable,
    /// Scene steps that are scored.
    pub steps: Range<usize>,
    /// Pairs to score.
    pub pairs: PairChoice,
    /// Pairs to leave out.
    pub exclude: Exclude,
    /// Thresholds of the events.
    pub thresholds: Thresholds,
}

impl<'a> ScoreInput<'a> {
    /// The scene with its shown motions: chosen futures, else logs. Scored from the step before the first
    /// future (from the first step if there is none) to the end of the longest motion.
    pub fn of_scene(scene: &'a Scene, drivable: &'a Drivable) -> Self {
        let sample = scene.generated.as_ref().and_then(|g| g.samples.get(g.chosen_sample));
        Self::of_sample(scene, sample, drivable)
    }

    /// As [`ScoreInput::of_scene`] for one sample of futures, or for the log with `None`.
    pub fn of_sample(scene: &'a Scene, sample: Option<&'a crate::Sample>, drivable: &'a Drivable) -> Self {
        let mut first_future: Option<usize> = None;
        let mut actors = Vec::with_capacity(scene.agents.len());
        for agent in &scene.agents {
            let futures = sample.and_then(|s| s.agents.get(&agent.id));
            let actor = match futures.and_then(|f| Some((f, f.modes.get(f.chosen)?))) {
                Some((futures, chosen)) => {
                    let earlier = first_future.unwrap_or(usize::MAX).min(chosen.first_step);
                    first_future = Some(earlier);
                    Actor::of_future(agent, chosen, &futures.modes)
                }
                None => Actor::of_kept(agent),
            };
            actors.push(actor);
        }
        let first = first_future.map_or(0, |f| f.saturating_sub(1));
        let end = actors.iter().map(|a| a.track.first_step + a.track.states.len()).max().unwrap_or(0);
        Self {
            actors,
            map: &scene.map,
            signals: &scene.signals,
            drivable,
            steps: first..end.max(first),
            pairs: PairChoice::default(),
            exclude: Exclude::default(),
            thresholds: Thresholds::default(),
        }
    }
}
