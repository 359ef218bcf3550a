//! What somebody could do instead of the motion that it keeps, and what that costs.

use super::blocks::Block;
use super::course::{Course, Moving, STRIDE};
use super::yielding::{Manner, Paced};
use super::{Answerer, Answerers};
use crate::tuning::fixed::giving_way::{
    FASTER, HURRIED_LATERAL, HURRIES_MPS2, MITIGATED, OTHER_BRAKES, OTHER_GAPS_M, PASSED_ON, VEHICLE_BRAKES,
    VEHICLE_GAPS_M,
};
use scene::score::{SweptBoxes, overlap};
use scene::{AgentType, STEP_S, State, wrap_angle};

/// How often it is looked again who is in front of whom.
const MOST_TURNS: usize = 3;

/// A motion with what it costs.
#[derive(Clone, Debug)]
pub(super) struct Way {
    pub(super) paced: Paced,
    pub(super) states: Vec<State>,
    pub(super) moving: Moving,
    pub(super) cost: f64,
}

/// Somebody with a changed motion, as others see it.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a> {
    /// Place among those who may answer, for one of them.
    pub(super) answerer: Option<usize>,
    /// It is an earlier answer that is kept.
    pub(super) kept: bool,
    pub(super) moving: &'a Moving,
}

impl Answerers<'_> {
    /// What it costs that two motions meet.
    pub(super) fn price(&self, a: &Moving, b: &Moving) -> f64 {
        let tuning = &self.tuning.choice;
        match overlap(&a.swept, &b.swept) {
            found if found.overlaps => tuning.overlap + tuning.close,
            found if found.close => tuning.close,
            _ => 0.0,
        }
    }

    /// The least costly thing that somebody could do other than what it keeps, those changed ones being where they
    /// are.
    pub(super) fn way(&self, who: usize, changed: &[Seen<'_>]) -> Option<Way> {
        let (own, road) = (&self.all[who], self.road(who));
        let ahead: Vec<Vec<Block>> = changed.iter().map(|c| road.corridor.blocks(c.moving)).collect();
        let around = own.around.get_or_init(|| self.around(who));
        let is_changed = |j: usize| changed.iter().any(|c| c.answerer == Some(j));
        let kept = around.iter().enumerate().filter(|(j, _)| !is_changed(*j)).flat_map(|(_, b)| b);
        let kept: Vec<&Block> = kept.chain(&road.lights).collect();
        let mut all = kept.clone();
        all.extend(ahead.iter().flatten());
        let mut best: Option<Way> = None;
        for manner in manners(own) {
            let way = self.weighed(who, own.behind(&road.course, &all, manner), manner, changed);
            let Some(way) = way else { continue };
            let free = way.1 == 0.0;
            if best.as_ref().is_none_or(|b| way.0.cost < b.cost - 1e-9) {
                best = Some(way.0);
            }
            if free {
                return best;
            }
        }
        for pace in FASTER {
            let manner = Manner { pace, accelerate_mps2: HURRIES_MPS2, ..manners(own)[1] };
            let paced = own.behind(&road.course, &kept, manner);
            if !own.hurries_safely(&road.course, &paced) {
                continue;
            }
            if let Some((way, _)) = self.weighed(who, paced, manner, changed)
                && best.as_ref().is_none_or(|b| way.cost < b.cost - 1e-9)
            {
                best = Some(way);
            }
        }
        best
    }

    /// A pace with its cost, and what of that is for meetings; `None` for the kept motion itself.
    fn weighed(&self, who: usize, paced: Paced, manner: Manner, changed: &[Seen<'_>]) -> Option<(Way, f64)> {
        let (own, course) = (&self.all[who], &self.road(who).course);
        if paced.is_own(course) {
            return None;
        }
        let states = paced.states(course);
        let moving = Moving::of_states(own.course.enters, &states, &own.size);
        let mut meets: f64 = changed.iter().map(|c| self.mitigated(own, &moving, c.moving)).sum();
        let is_changed = |j: usize| changed.iter().any(|c| c.answerer == Some(j));
        for (j, other) in self.all.iter().enumerate().filter(|(j, _)| *j != who && !is_changed(*j)) {
            if !self.were_near(own, &other.kept, other.keeps) {
                meets += PASSED_ON * self.price(&moving, &self.all[j].kept);
            }
        }
        for other in &self.fixed {
            if !self.were_near(own, &other.moving, other.keeps) {
                meets += self.price(&moving, &other.moving);
            }
        }
        let tuning = &self.tuning.reacting;
        let hard = (manner.brake_mps2 - tuning.easily_mps2).max(0.0);
        let late_s = own.late_s(&paced).abs();
        let cost = self.tuning.choice.deviating + tuning.late * late_s + tuning.hard * hard + meets;
        Some((Way { paced, states, moving, cost }, meets))
    }

    /// The price of a meeting, less for one that is slower than it would be without giving way.
    fn mitigated(&self, own: &Answerer, moving: &Moving, other: &Moving) -> f64 {
        let price = self.price(moving, other);
        if price <= self.tuning.choice.close {
            return price;
        }
        let closing = |m: &Moving| {
            let step = first_meeting(&m.swept, &other.swept)?;
            Some((m.velocity(step) - other.velocity(step)).norm())
        };
        match (closing(moving), closing(&own.kept)) {
            (Some(now), Some(then)) if then > 1e-3 => {
                price * (MITIGATED + (1.0 - MITIGATED) * (now / then).min(1.0))
            }
            _ => price,
        }
    }

    /// Two kept motions of one kind that come near each other: how near is how it was.
    fn were_near(&self, own: &Answerer, other: &Moving, keeps: super::Keeps) -> bool {
        !self.mind(own.keeps, keeps) && self.price(&own.kept, other) > 0.0
    }

    /// Where everybody else's kept motion is in the way.
    fn around(&self, who: usize) -> Vec<Vec<Block>> {
        let (own, road) = (&self.all[who], self.road(who));
        let blocks = |other: &Moving, keeps| {
            if self.were_near(own, other, keeps) { Vec::new() } else { road.corridor.blocks(other) }
        };
        let answering = self
            .all
            .iter()
            .enumerate()
            .map(|(j, other)| if j == who { Vec::new() } else { blocks(&other.kept, other.keeps) });
        answering.chain(self.fixed.iter().map(|f| blocks(&f.moving, f.keeps))).collect()
    }
}

impl Answerer {
    /// A course of its behind those of these blocks that it is behind by now, or comes to be by waiting.
    fn behind(&self, course: &Course, blocks: &[&Block], manner: Manner) -> Paced {
        // Who comes up from behind does not count.
        let counts = |b: &Block| b.taken.first().is_some_and(|(first, _)| *first > 0.0);
        let mut yields: Vec<bool> =
            blocks.iter().map(|b| counts(b) && !b.comes_behind(course.along_at(b.from))).collect();
        for _ in 0..MOST_TURNS {
            let waited = blocks.iter().zip(&yields).filter(|(_, y)| **y).map(|(b, _)| *b);
            let paced = Paced::behind(course, &waited.collect::<Vec<_>>(), manner);
            let mut turned = false;
            for (block, yields) in blocks.iter().zip(&mut yields).filter(|(b, y)| !**y && counts(b)) {
                let at = block.from.saturating_sub(course.enters);
                let along = paced.along_m.get(at).copied().unwrap_or(f64::INFINITY);
                if !block.comes_behind(along) {
                    *yields = true;
                    turned = true;
                }
            }
            if !turned {
                return paced;
            }
        }
        let waited = blocks.iter().zip(&yields).filter(|(_, y)| **y).map(|(b, _)| *b);
        Paced::behind(course, &waited.collect::<Vec<_>>(), manner)
    }

    /// How much later it is where it has come to; negative for earlier.
    pub(super) fn late_s(&self, paced: &Paced) -> f64 {
        let last = paced.along_m.len() - 1;
        let (end, own_end) = (paced.along_m[last], self.course.length_m());
        let steps = |from: usize, to: usize| (to as f64 - from as f64) * STEP_S;
        if end <= own_end {
            let there = self.course.step_at(end).map_or(last, |s| s - self.course.enters);
            return steps(there, last);
        }
        let there = paced.along_m.iter().position(|a| *a >= own_end).unwrap_or(last);
        steps(self.course.states.len() - 1, there)
    }

    /// Going faster than it does breaks no limit in its bends.
    fn hurries_safely(&self, course: &Course, paced: &Paced) -> bool {
        let states = paced.states(course);
        states.windows(2).all(|w| {
            let turn = wrap_angle(w[1].heading_rad - w[0].heading_rad).abs() / STEP_S;
            let speed = w[1].speed_mps();
            speed <= self.limits.speed_mps && speed * turn <= HURRIED_LATERAL * self.limits.lateral_mps2
        })
    }
}

/// How somebody may brake, from easily to hard.
fn manners(own: &Answerer) -> Vec<Manner> {
    let manner = |share: &f64, gap_m: &f64, accelerate_mps2: f64| Manner {
        brake_mps2: share * own.limits.brake_mps2,
        accelerate_mps2,
        gap_m: *gap_m,
        pace: 1.0,
    };
    let of = |shares: &[f64], gaps_m: &[f64], accelerate_mps2: f64| {
        shares.iter().zip(gaps_m).map(|(s, g)| manner(s, g, accelerate_mps2)).collect()
    };
    match own.agent_type {
        AgentType::Pedestrian => of(&OTHER_BRAKES, &OTHER_GAPS_M, 0.8),
        AgentType::Cyclist => of(&OTHER_BRAKES, &OTHER_GAPS_M, 1.0),
        _ => of(&VEHICLE_BRAKES, &VEHICLE_GAPS_M, 1.5),
    }
}

/// The first of the looked-at steps at which two motions come close.
pub(super) fn first_meeting(a: &SweptBoxes, b: &SweptBoxes) -> Option<usize> {
    if !overlap(a, b).close {
        return None;
    }
    let near = |i: usize| match (a.at(i), b.at(i)) {
        (Some(p), Some(q)) => scene::geometry::obb::overlaps(p, q, scene::score::CLOSE_M),
        _ => false,
    };
    let moment = (0..a.len()).find(|i| near(*i))?;
    Some(STRIDE * (moment + 1))
}
