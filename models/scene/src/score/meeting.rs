//! The road user that comes nearest to a collision with another, and how the two move relative to each other
//! then.

use super::input::ScoreInput;
use super::pairs::{Measures, Mover, MoverState, PARKED_M, belong_together, is_excluded, least, ttc};
use super::pet::encroachment;
use super::signals::{SignalStopLine, signal_passed, stop_lines};
use crate::SignalState;
use crate::geometry::obb::{circle_gap, gap_and_direction};
use crate::geometry::ttc::LOOK_AHEAD_S;
use crate::geometry::{Vec2, direction, wrap_angle};
use std::cmp::Ordering;
use std::f64::consts::FRAC_PI_4;

/// Pairs that stay farther apart are skipped, metres.
const FAR_M: f64 = 100.0;
/// Pairs that stay farther apart meet only if they have a time to collision, metres.
const NEAR_M: f64 = 30.0;
/// Headings that differ by more are oncoming, radians.
const ONCOMING_RAD: f64 = 3.0 * FRAC_PI_4;

/// Geometric relation of the paths of two road users.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairRelation {
    /// Their paths cross.
    Crossing,
    /// One drives behind the other.
    Following,
    /// They approach head-on.
    Oncoming,
    /// None of these, such as side by side.
    Beside,
}

/// How a road user meets another.
#[derive(Clone, Debug, PartialEq)]
pub struct MeetingPair {
    /// The other, by its index in the input.
    pub other: usize,
    /// Scene step of the least gap.
    pub step: usize,
    /// Crossing of the paths, else the midpoint between the two at the step, metres.
    pub place: Vec2,
    /// Relation of their paths.
    pub relation: PairRelation,
    /// Whether the other has priority in order: first at the crossing, or ahead. `None` if neither does.
    pub other_first: Option<bool>,
    /// Smallest time to collision at constant velocity, as in the scene's score, seconds.
    pub ttc_s: Option<f64>,
    /// The worst values of the pair; their time to collision also uses constant turn rates.
    pub measures: Measures,
}

/// Finds the hardest pairs of a scene.
pub struct MeetingSearch<'a> {
    input: &'a ScoreInput<'a>,
    movers: Vec<Mover>,
    lines: Vec<SignalStopLine<'a>>,
}

impl<'a> MeetingSearch<'a> {
    /// A search over the motions that an input scores.
    pub fn new(input: &'a ScoreInput<'a>) -> Self {
        let movers = input.actors.iter().map(|actor| Mover::new(actor, input.steps.clone())).collect();
        Self { input, movers, lines: stop_lines(input) }
    }

    /// The pair of a road user with the smallest time to collision or post-encroachment time. If no pair has
    /// one, the smallest time gap decides, then the smallest gap. `None` if there is no such time and no road
    /// user is within 30 m.
    pub fn hardest(&self, of: usize) -> Option<MeetingPair> {
        let pairs = (0..self.movers.len()).filter(|other| *other != of);
        let pairs = pairs.filter_map(|other| self.between(of, other));
        let order = |pair: &MeetingPair| {
            let Measures { pet_s, headway_s, gap_m, .. } = pair.measures;
            let least_s = pair.ttc_s.into_iter().chain(pet_s).fold(f64::INFINITY, f64::min);
            [Some(least_s), headway_s, gap_m].map(|value| value.unwrap_or(f64::INFINITY))
        };
        let compared = |p: &MeetingPair, q: &MeetingPair| {
            let pairs = order(p).into_iter().zip(order(q));
            pairs.map(|(p, q)| p.total_cmp(&q)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
        };
        pairs.min_by(compared)
    }

    /// How a road user meets another, by their ids; without another, its hardest pair. `None` also if one of
    /// them is not in the input.
    pub fn of(&self, id: &str, other: Option<&str>) -> Option<MeetingPair> {
        let place = |id: &str| self.input.actors.iter().position(|actor| actor.id == id);
        let of = place(id)?;
        other.map_or_else(|| self.hardest(of), |other| self.between(of, place(other)?))
    }

    /// State of the signal whose stop line a road user passes, or stands at in the end; `None` without one.
    pub fn signal(&self, of: usize) -> Option<SignalState> {
        signal_passed(self.input, self.input.actors.get(of)?, &self.lines)
    }

    /// How two of them meet, by their indices in the input. `None` if both stay, belong together, are
    /// excluded from the score or are never near each other. Also `None` for two that stay 30 m apart and
    /// have neither a time to collision nor a post-encroachment time.
    pub fn between(&self, of: usize, other: usize) -> Option<MeetingPair> {
        let (a, b) = (self.movers.get(of)?, self.movers.get(other)?);
        let stays = |mover: &Mover| mover.travel_m < PARKED_M;
        if stays(a) && stays(b) {
            return None;
        }
        let moments = a.moments.iter().zip(&b.moments).enumerate();
        let both = moments.filter_map(|(step, (p, q))| Some((step, p.as_ref()?, q.as_ref()?)));
        let mut nearest: Option<(f64, Vec2, usize, &MoverState, &MoverState)> = None;
        let mut ttc_s = None;
        for (step, p, q) in both.filter(|(_, p, q)| circle_gap(&p.outline, &q.outline) <= FAR_M) {
            let (gap_m, towards) = gap_and_direction(&p.outline, &q.outline);
            if nearest.as_ref().is_none_or(|(least_m, ..)| gap_m < *least_m) {
                nearest = Some((gap_m, towards, step, p, q));
            }
            if p.speed_mps.max(q.speed_mps) > self.input.thresholds.moving_mps {
                ttc_s = least(ttc_s, ttc(p, q, ttc_s.unwrap_or(LOOK_AHEAD_S)));
            }
        }
        let (gap_m, towards, step, p, q) = nearest?;
        let (actor, partner) = (self.input.actors.get(of)?, self.input.actors.get(other)?);
        if belong_together(a, b, step) || is_excluded(self.input, actor, partner) {
            return None;
        }
        let measures = Measures::of(a, b, a.moments.len());
        if gap_m > NEAR_M && ttc_s.is_none() && measures.pet_s.is_none() {
            return None;
        }
        let crossing = encroachment(a, b);
        let turn_rad = wrap_angle(p.outline.heading_rad() - q.outline.heading_rad()).abs();
        let relation = match crossing {
            Some(_) => PairRelation::Crossing,
            None if measures.headway_s.is_some() => PairRelation::Following,
            None if turn_rad > ONCOMING_RAD => PairRelation::Oncoming,
            None => PairRelation::Beside,
        };
        let other_first = match relation {
            PairRelation::Crossing => crossing.and_then(|crossing| crossing.b_first),
            PairRelation::Following => Some(towards.dot(&direction(p.outline.heading_rad())) > 0.0),
            PairRelation::Oncoming | PairRelation::Beside => None,
        };
        let between = (p.outline.center() + q.outline.center()) * 0.5;
        let place = crossing.map_or(between, |crossing| crossing.point);
        let step = self.input.steps.start + step;
        Some(MeetingPair { other, step, place, relation, other_first, ttc_s, measures })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Drivable;
    use super::super::tests::{input_of, straight};
    use super::*;
    use crate::AgentType::Vehicle;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn the_hardest_pair_of_each_kind_is_found() {
        let drivable = Drivable::default();
        let car = |id, x, y, heading, speed| straight(id, Vehicle, (x, y), heading, speed);
        let ego = || car("ego", 0.0, 0.0, 0.0, 10.0);
        let hardest = |others: Vec<_>| {
            let input = input_of(std::iter::once(ego()).chain(others).collect(), &drivable);
            MeetingSearch::new(&input).hardest(0)
        };
        let far = || car("far", 0.0, 80.0, 0.0, 10.0);
        assert_eq!(hardest(vec![far()]), None);
        // Crosses 1.5 s behind the ego.
        let crossing = hardest(vec![far(), car("late", 40.0, -61.0, FRAC_PI_2, 10.0)]).unwrap();
        assert_eq!((crossing.other, crossing.relation), (2, PairRelation::Crossing));
        assert_eq!(crossing.other_first, Some(false));
        assert!((crossing.place - Vec2::new(40.0, 0.0)).norm() < 1e-6, "{:?}", crossing.place);
        assert!((crossing.measures.pet_s.unwrap() - 1.5).abs() < 0.11, "{:?}", crossing.measures);
        // Drives ahead, and is harder than the late one.
        let leader = car("leader", 12.0, 0.0, 0.0, 8.0);
        let following = hardest(vec![car("late", 40.0, -61.0, FRAC_PI_2, 10.0), leader]).unwrap();
        assert_eq!((following.other, following.relation), (2, PairRelation::Following));
        assert_eq!(following.other_first, Some(true));
        let oncoming = hardest(vec![car("oncoming", 60.0, 3.5, PI, 10.0)]).unwrap();
        assert_eq!((oncoming.relation, oncoming.other_first), (PairRelation::Oncoming, None));
    }
}
