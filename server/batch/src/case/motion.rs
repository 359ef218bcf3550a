//! The motion of a result for a picture: a few road users about the place where two meet, twice a second.

use super::facts::type_word;
use scene::geometry::rotate;
use scene::score::meeting::MeetingPair;
use scene::score::{Actor, ScoreInput};
use scene::{State, Vec2};
use serde::{Deserialize, Serialize};

/// Steps between two pictures.
pub const PICTURE_STEPS: usize = 5;
/// Road users beside the two.
const OTHERS: usize = 6;
/// Others are drawn if they come this near to the place, metres.
const NEAR_M: f64 = 40.0;
/// Pictures before and after the moment of the least gap in which the relative motion is told.
const AROUND: usize = 6;

/// The motion of one result. Lengths are decimetres, angles hundredths of a radian.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CaseMotion {
    /// Id of the unit.
    pub unit: String,
    /// Scene step of the first picture.
    pub first: usize,
    /// Where the two meet: x and y.
    pub place: [i32; 2],
    /// Number of the picture at the moment of the least gap.
    pub moment: usize,
    /// The actor, the other one, and who is near.
    pub agents: Vec<AgentMotion>,
    /// x and y of the other one as the actor sees it, ahead and to the left, in the pictures about the moment; empty
    /// without another one, null where one of the two is not seen.
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
    /// Picture in which it is first seen.
    pub from: usize,
    /// x, y and heading in that picture, then the differences from each picture to the next.
    pub poses: Vec<i32>,
}

fn decimetres(metres: f64) -> i32 {
    // Rust's conversion saturates.
    (metres * 10.0).round() as i32
}

impl CaseMotion {
    /// Of a road user and its pair, by places in the input.
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

    /// Its line, with the line's end.
    pub fn line(&self) -> String {
        // Numbers and texts: serde_json writes those without fail.
        serde_json::to_string(self).unwrap_or_default() + "\n"
    }
}

impl AgentMotion {
    fn of(actor: &Actor<'_>, steps: &[usize]) -> Option<Self> {
        let from = steps.iter().position(|step| actor.state(*step).is_some())?;
        let (mut poses, mut before) = (Vec::new(), [0i32; 3]);
        for state in steps.iter().skip(from).map_while(|step| actor.state(*step)) {
            // Headings go on beyond a full turn, so that a difference is a turn.
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
