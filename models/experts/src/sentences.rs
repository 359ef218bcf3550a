//! The sentences of a generation: why a goal is out of reach, and what is unlikely about a request.

use scene::message::{Message, MessageValue, Placeholder, Word};
use std::fmt;

/// The expert of an agent in a sentence.
pub mod kind {
    use scene::message::Word;

    /// On foot.
    pub const PEDESTRIAN: Word = Word { code: "pedestrian", english: "pedestrian" };
    /// On a cycle.
    pub const CYCLIST: Word = Word { code: "cyclist", english: "cyclist" };
    /// All others.
    pub const VEHICLE: Word = Word { code: "vehicle", english: "vehicle" };
}

/// A speed in a sentence: in m/s on foot, otherwise in km/h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Metres per second.
    pub mps: f64,
    /// The agent is on foot.
    pub on_foot: bool,
}

impl fmt::Display for Speed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.on_foot { write!(f, "{:.1} m/s", self.mps) } else { write!(f, "{:.0} km/h", 3.6 * self.mps) }
    }
}

impl Placeholder for Speed {
    fn value(&self) -> Option<MessageValue> {
        self.mps.value()
    }
}

/// What a goal would take, as a separate sentence; empty if that is unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Need {
    /// The amount in `unit`.
    pub amount: Option<f64>,
    /// The unit as text.
    pub unit: &'static str,
}

impl fmt::Display for Need {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.amount {
            Some(amount) => write!(f, " Required: {amount:.1} {}.", self.unit),
            None => Ok(()),
        }
    }
}

impl Placeholder for Need {
    fn value(&self) -> Option<MessageValue> {
        self.amount.map(MessageValue::Number)
    }
}

/// Makes a sentence hold from a scene time on, seconds.
pub fn since(mut message: Message, since_s: f64) -> Message {
    message.values.insert("since_s", MessageValue::Number(since_s));
    message.english = format!("From {since_s:.1} s on: {message}");
    message
}

scene::messages! {
    goal_too_far(time_s: f64, goal_m: f64, start_mps: Speed, kind: Word, most_m: f64) =
        "goal-too-far",
        "Too far for {time_s:.1} s. The goal is {goal_m:.0} m away. From {start_mps}, this {kind} covers at \
         most {most_m:.0} m in {time_s:.1} s.";
    goal_too_fast(time_s: f64, start_mps: Speed, need_mps2: Need) =
        "goal-too-fast", "Cannot accelerate that much in {time_s:.1} s from {start_mps}.{need_mps2}";
    goal_above_top_speed(kind: Word, need_mps: Need) =
        "goal-above-top-speed", "Above the top speed of this {kind}.{need_mps}";
    goal_too_near(start_mps: Speed, least_m: f64, goal_m: f64, need_mps2: Need) =
        "goal-too-near",
        "Cannot stop that soon. Braking from {start_mps} takes {least_m:.0} m; the goal is {goal_m:.0} m \
         away.{need_mps2}";
    goal_too_slow(time_s: f64, need_mps2: Need) =
        "goal-too-slow", "Cannot brake that much in {time_s:.1} s.{need_mps2}";
    goal_too_tight(need_mps2: Need) = "goal-too-tight", "Too tight at this speed.{need_mps2}";
    goal_turn_too_tight(kind: Word) = "goal-turn-too-tight", "The turn is too tight for this {kind}.";
    goal_blocked(agent: &str, kind: Word, short_m: f64) =
        "goal-blocked", "Road user {agent} blocks this {kind}, which stops {short_m:.0} m short of the goal.";
    goal_blocked_by_traffic(kind: Word, short_m: f64) =
        "goal-blocked-by-traffic",
        "Another road user blocks this {kind}, which stops {short_m:.0} m short of the goal.";
    goal_off_road(within_m: f64) = "goal-off-road", "There is no lane within {within_m} m of the goal.";
    goal_beyond_top_speed(goal_m: f64, time_s: f64) =
        "goal-beyond-top-speed", "{goal_m:.0} m in {time_s:.1} s requires more than the top speed.";
    start_off_road(within_m: f64) = "start-off-road", "There is no lane within {within_m} m of the start.";
    start_overlaps(agent: &str) = "start-overlaps", "The start overlaps road user {agent}.";
    via_missed(number: usize, distance_m: f64, time_s: f64, tolerance_m: f64) =
        "via-missed",
        "The future misses via point {number} by {distance_m:.1} m at {time_s:.1} s; the tolerance is \
         {tolerance_m:.1} m.";
    nothing_generated() =
        "nothing-generated",
        "No road user is regenerated, and no known motion ends before the last window.";
    motion_ends(time_s: f64) =
        "motion-ends", "The known motion ends at {time_s:.1} s; the road user continues straight at its speed.";
}
