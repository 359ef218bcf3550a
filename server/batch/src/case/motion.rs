//! The motion of a result for a picture: a few road users around the place where two meet, twice per second.

use super::facts::type_word;
use scene::geometry::rotate;
use scene::score::meeting::MeetingPair;
use scene::score::{Actor, ScoreInput};
use scene::{State, Vec2};
use serde::{Deserialize, Serialize};

/// Steps from one frame to the next.
pub const PICTURE_STEPS: usize = 5;
/// Number of road users besides the two.
const OTHERS: usize = 6;
/// Others are drawn if they come this near to the place, metres.
const NEAR_M: f64 = 40.0;
/// Frames before and after the moment of the smallest gap that are included in the relative motion.
const AROUND: usize = 6;

/// The motion of one result. Lengths are decimetres, angles hundredths of a radian.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CaseMotion {
    /// Id of the unit.
    pub unit: String,
    /// Scene step of the first frame.
    pub first: usize,
    /// Place where the two meet: x and y.
    pub place: [i32; 2],
    /// Index of the frame at the moment of the smallest gap.
    pub moment: usize,
    /// The actor, the other road user, and those near the place.
    pub agents: Vec<AgentMotion>,
    /// Position of the other relative to the actor, ahead and to the left, in the frames around the moment.
    /// Empty without another road user; null if one of the two is absent.
    pub relative: Vec<Option<[i32; 2]>>,
}

/// The motion of one road user.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct AgentMotion {
    /// Its id.
    pub id: String,
    /// vehicle, pedestrian, cyclist or other.
    pub kind: String,
    /// Length and width.
    pub size: [i32; 2],
    /// First frame in which it is present.
    pub from: usize,
    /// x, y and heading in that frame, then the differences from each frame to the next.
    pub poses: Vec<i32>,
}

fn decimetres(metres: f64) -> i32 {
    // Rust's conversion saturates.
    (metres * 10.0).round() as i32
}

impl CaseMotion {
    /// The motion of a road user and its pair, by indices in the input.
    pub fn of(unit: &str, input: &ScoreInput<'_>, of: usize, pair: Option<&MeetingPair>) -> Option<Self> {
        let actor = input.actors.get(of)?;
        let (first, end) = (input.steps.start, input.steps.end);
        let steps: Vec<usize> = (first..end).step_by(PICTURE_STEPS).collect();
        let seen = |actor: &Actor<'_>, step: usize| actor.state(step).map(State::position);
        let place =
            pair.map(|pair| pair.place).or_else(|| steps.iter().rev().find_map(|step| seen(actor, *step)))?;
        let moment =
            pair.map_or(0, |pair| (pair.step.saturating_sub(first) + PICTURE_STEPS / 2) / PICTURE_STEPS);
        let distance = |i: usize| {
            let places = steps.iter().filter_map(|step| seen(input.actors.get(i)?, *step));
            places.map(|p| (p - place).norm()).fold(f64::INFINITY, f64::min)
        };
        let is_pair = |i: usize| i == of || pair.is_some_and(|pair| pair.other == i);
        let mut others: Vec<(f64, usize)> =
            (0..input.actors.len()).filter(|i| !is_pair(*i)).map(|i| (distance(i), i)).collect();
        others.retain(|(distance_m, _)| *distance_m <= NEAR_M);
        others.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        let drawn = [of].into_iter().chain(pair.map(|pair| pair.other));
        let drawn = drawn.chain(others.into_iter().take(OTHERS).map(|(_, i)| i));
        let agents = drawn.filter_map(|i| AgentMotion::of(input.actors.get(i)?, &steps)).collect();
        let relative = pair.and_then(|pair| Some(relative(actor, input.actors.get(pair.other)?, pair.step)));
        Some(Self {
            unit: unit.to_owned(),
            first,
            place: [decimetres(place.x), decimetres(place.y)],
            moment,
            agents,
            relative: relative.unwrap_or_default(),
        })
    }

    /// Its JSON line, with the newline.
    pub fn line(&self) -> String {
        // It holds only numbers and texts, which serde_json always writes.
        serde_json::to_string(self).unwrap_or_default() + "\n"
    }
}

impl AgentMotion {
    fn of(actor: &Actor<'_>, steps: &[usize]) -> Option<Self> {
        let from = steps.iter().position(|step| actor.state(*step).is_some())?;
        let (mut poses, mut before) = (Vec::new(), [0i32; 3]);
        for state in steps.iter().skip(from).map_while(|step| actor.state(*step)) {
            // Headings are unwrapped, so that each difference is a turn.
            let turn = scene::wrap_angle(state.heading_rad - f64::from(before[2]) / 100.0);
            let heading = before[2].saturating_add((turn * 100.0).round() as i32);
            let pose = [decimetres(state.x_m), decimetres(state.y_m), heading];
            poses.extend(pose.iter().zip(before).map(|(now, before)| now.saturating_sub(before)));
            before = pose;
        }
        Some(Self {
            id: actor.id.to_owned(),
            kind: type_word(actor.agent_type).to_owned(),
            size: [decimetres(actor.size.length_m), decimetres(actor.size.width_m)],
            from,
            poses,
        })
    }
}

fn relative(actor: &Actor<'_>, other: &Actor<'_>, step: usize) -> Vec<Option<[i32; 2]>> {
    let at = |picture: usize| {
        let step = (step + picture * PICTURE_STEPS).checked_sub(AROUND * PICTURE_STEPS)?;
        let (own, their) = (actor.state(step)?, other.state(step)?);
        let seen: Vec2 = rotate(their.position() - own.position(), -own.heading_rad);
        Some([decimetres(seen.x), decimetres(seen.y)])
    };
    (0..=2 * AROUND).map(at).collect()
}
