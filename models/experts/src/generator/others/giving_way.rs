//! The motions with which an agent can give way, and their costs.

use super::blocks::PathBlock;
use super::other::{KeptFrom, OtherAgent, Others, ReactingAgent, Reactor};
use super::path_progress::PathProgress;
use super::yielding::{Paced, YieldManner};
use crate::generator::choice::price;
use crate::generator::motion::Sweep;
use crate::tuning::fixed::giving_way::{
    CYCLIST_SPEEDS_UP_MPS2, ENTRIES, FASTER, HURRIED_LATERAL, HURRIES_MPS2, MITIGATED, OTHER_BRAKES,
    OTHER_GAPS_M, PASSED_ON, VEHICLE_BRAKES, VEHICLE_GAPS_M, VEHICLE_HEADWAYS_S, VEHICLE_SPEEDS_UP_MPS2,
    WALKER_SPEEDS_UP_MPS2,
};
use scene::{AgentType, STEP_S, State, wrap_angle};

/// Limit of rounds in which the order of the agents is recomputed.
const MOST_TURNS: usize = 3;

/// A motion that gives way, with its cost.
#[derive(Clone, Debug)]
pub(super) struct YieldOption {
    pub(super) paced: Paced,
    pub(super) states: Vec<State>,
    pub(super) sweep: Sweep,
    pub(super) cost: f64,
}

/// A changed motion as other agents see it.
#[derive(Clone, Copy)]
pub(super) struct SeenMotion<'a> {
    /// For a reactor: its index among the agents that may react.
    pub(super) reactor: Option<usize>,
    /// The motion is kept from an earlier answer.
    pub(super) kept: bool,
    pub(super) sweep: &'a Sweep,
}

impl Others<'_> {
    /// Cost of an encounter of two motions.
    pub(super) fn price(&self, a: &Sweep, b: &Sweep) -> f64 {
        price(a.swept(), b.swept(), &self.tuning.choice)
    }

    /// Cost of following another motion too closely.
    pub(super) fn tailgating(&self, own: &Sweep, other: &Sweep) -> f64 {
        self.tuning.reacting.tailgating * own.tailgates_s(other)
    }

    /// The cheapest alternative to an agent's kept motion, given the changed motions. `None` if it costs
    /// `most` or more.
    pub(super) fn way(
        &self,
        who: ReactingAgent<'_>,
        changed: &[SeenMotion<'_>],
        most: f64,
    ) -> Option<YieldOption> {
        if self.tuning.choice.deviating >= most {
            return None;
        }
        let (own, road) = (who.own, self.road(who.own));
        let ahead: Vec<Vec<PathBlock>> = changed.iter().map(|c| road.corridor.blocks(c.sweep)).collect();
        let around = own.around.get_or_init(|| self.around(who));
        let is_changed = |at: usize| changed.iter().any(|c| c.reactor == Some(at));
        let kept = around.iter().enumerate().filter(|(at, _)| !is_changed(*at)).flat_map(|(_, b)| b);
        let kept: Vec<&PathBlock> = kept.chain(&road.lights).collect();
        let mut all = kept.clone();
        all.extend(ahead.iter().flatten());
        let mut best: Option<YieldOption> = None;
        // An agent that was out of sight may have seen the others and braked already.
        let entries = if own.path.enters > 0 { &ENTRIES[..] } else { &[] };
        let slower = entries.iter().map(|entry| YieldManner { entry: *entry, ..manners(own)[0] });
        for manner in manners(own).into_iter().chain(slower) {
            let most = best.as_ref().map_or(most, |b| b.cost - 1e-9);
            let way = self.weighed(who, behind(&road.path, &all, manner), (manner, most), changed);
            let Some((way, meets)) = way else { continue };
            if way.cost < most {
                best = Some(way);
            }
            // Nobody brakes harder for a headway alone.
            if meets == 0.0 {
                return best;
            }
        }
        for pace in FASTER {
            let manner = YieldManner { pace, accelerate_mps2: HURRIES_MPS2, ..manners(own)[1] };
            let paced = behind(&road.path, &kept, manner);
            if !own.hurries_safely(&road.path, &paced) {
                continue;
            }
            let most = best.as_ref().map_or(most, |b| b.cost - 1e-9);
            let way = self.weighed(who, paced, (manner, most), changed);
            if let Some((way, _)) = way.filter(|(way, _)| way.cost < most) {
                best = Some(way);
            }
        }
        best
    }

    /// A paced motion with its cost, and the part of the cost for encounters. `None` for the kept motion
    /// itself, and for a motion that meets another agent and costs `most` or more.
    fn weighed(
        &self,
        who: ReactingAgent<'_>,
        paced: Paced,
        (manner, most): (YieldManner, f64),
        changed: &[SeenMotion<'_>],
    ) -> Option<(YieldOption, f64)> {
        let (own, path) = (who.own, &self.road(who.own).path);
        if paced.is_own(path) {
            return None;
        }
        let tuning = &self.tuning.reacting;
        let hard = (manner.brake_mps2 - tuning.easily_mps2).max(0.0);
        let late_s = own.late_s(&paced).abs();
        let alone = self.tuning.choice.deviating + tuning.late * late_s + tuning.hard * hard;
        let is_dear = |meets: f64| meets > 0.0 && alone + meets >= most;
        let states = paced.states(path);
        let sweep = Sweep::entering(own.path.enters, &states, &own.size);
        let mut meets: f64 = changed.iter().map(|c| self.mitigated(who, &sweep, c.sweep)).sum();
        let mut tailgates: f64 = changed.iter().map(|c| self.tailgating(&sweep, c.sweep)).sum();
        let is_changed = |at: usize| changed.iter().any(|c| c.reactor == Some(at));
        for (at, other) in self.each.iter().enumerate().filter(|(at, _)| *at != who.at && !is_changed(*at)) {
            if is_dear(meets) {
                return None;
            }
            let price = self.price(&sweep, &other.sweep);
            if price > 0.0 && !self.were_near(who, &other.sweep, other.kept_from) {
                let share = if at < self.reacting { PASSED_ON } else { 1.0 };
                meets += share * price;
            }
            let tailgating = self.tailgating(&sweep, &other.sweep);
            if tailgating > 0.0 {
                // Only the time beyond that of the kept motion costs.
                tailgates += (tailgating - self.tailgating(&who.other.sweep, &other.sweep)).max(0.0);
            }
        }
        Some((YieldOption { paced, states, sweep, cost: alone + meets + tailgates }, meets))
    }

    /// Cost of an encounter, reduced as giving way lowers the closing speed.
    fn mitigated(&self, who: ReactingAgent<'_>, sweep: &Sweep, other: &Sweep) -> f64 {
        let price = self.price(sweep, other);
        if price <= self.tuning.choice.close {
            return price;
        }
        let closing = |m: &Sweep| {
            let step = m.first_meeting(other)?;
            Some((m.velocity(step) - other.velocity(step)).norm())
        };
        match (closing(sweep), closing(&who.other.sweep)) {
            (Some(now), Some(then)) if then > 1e-3 => {
                price * (MITIGATED + (1.0 - MITIGATED) * (now / then).min(1.0))
            }
            _ => price,
        }
    }

    /// Whether two motions kept from one source come near each other; their distance has not changed.
    fn were_near(&self, who: ReactingAgent<'_>, other: &Sweep, kept_from: KeptFrom) -> bool {
        who.other.kept_from == kept_from && self.price(&who.other.sweep, other) > 0.0
    }

    /// Blocks by the kept motions of all other agents.
    fn around(&self, who: ReactingAgent<'_>) -> Vec<Vec<PathBlock>> {
        let road = self.road(who.own);
        let blocks = |(at, other): (usize, &OtherAgent)| {
            let ignored = at == who.at || self.were_near(who, &other.sweep, other.kept_from);
            if ignored { Vec::new() } else { road.corridor.blocks(&other.sweep) }
        };
        self.each.iter().enumerate().map(blocks).collect()
    }
}

impl Reactor {
    /// Delay at the last place against the agent's own timing, seconds; negative if it is early.
    pub(super) fn late_s(&self, paced: &Paced) -> f64 {
        let last = paced.along_m.len() - 1;
        let (end, own_end) = (paced.along_m[last], self.path.length_m());
        let steps = |from: usize, to: usize| (to as f64 - from as f64) * STEP_S;
        if end <= own_end {
            let there = self.path.step_at(end).map_or(last, |s| s - self.path.enters);
            return steps(there, last);
        }
        let there = paced.along_m.iter().position(|a| *a >= own_end).unwrap_or(last);
        steps(self.path.states.len() - 1, there)
    }

    /// Whether going faster than on its own timing breaks no limit in its bends.
    fn hurries_safely(&self, path: &PathProgress, paced: &Paced) -> bool {
        let states = paced.states(path);
        states.windows(2).all(|w| {
            let turn = wrap_angle(w[1].heading_rad - w[0].heading_rad).abs() / STEP_S;
            let speed = w[1].speed_mps();
            speed <= self.limits.speed_mps && speed * turn <= HURRIED_LATERAL * self.limits.lateral_mps2
        })
    }
}

/// The path driven behind those of these blocks that the agent is behind now, or will be after waiting.
pub(super) fn behind(path: &PathProgress, blocks: &[&PathBlock], manner: YieldManner) -> Paced {
    // An agent that approaches from behind does not count.
    let counts = |b: &PathBlock| b.taken.first().is_some_and(|(first, _)| *first > 0.0);
    let mut yields: Vec<bool> =
        blocks.iter().map(|b| counts(b) && !b.comes_behind(path.along_at(b.from))).collect();
    for _ in 0..MOST_TURNS {
        let waited = blocks.iter().zip(&yields).filter(|(_, y)| **y).map(|(b, _)| *b);
        let paced = Paced::behind(path, &waited.collect::<Vec<_>>(), manner);
        let mut turned = false;
        for (block, yields) in blocks.iter().zip(&mut yields).filter(|(b, y)| !**y && counts(b)) {
            if !block.comes_behind(paced.along_at(path, block.from)) {
                *yields = true;
                turned = true;
            }
        }
        if !turned {
            return paced;
        }
    }
    let waited = blocks.iter().zip(&yields).filter(|(_, y)| **y).map(|(b, _)| *b);
    Paced::behind(path, &waited.collect::<Vec<_>>(), manner)
}

/// Manners of giving way, from easy to hard braking.
fn manners(own: &Reactor) -> Vec<YieldManner> {
    let manner = |share: &f64, gap_m: &f64, headway_s: &f64, accelerate_mps2: f64| YieldManner {
        brake_mps2: share * own.limits.brake_mps2,
        accelerate_mps2,
        gap_m: *gap_m,
        headway_s: *headway_s,
        pace: 1.0,
        entry: 1.0,
    };
    let of = |shares: &[f64], gaps_m: &[f64], headways_s: &[f64], accelerate_mps2: f64| {
        let each = shares.iter().zip(gaps_m).zip(headways_s);
        each.map(|((s, g), h)| manner(s, g, h, accelerate_mps2)).collect()
    };
    match own.agent_type {
        AgentType::Pedestrian => of(&OTHER_BRAKES, &OTHER_GAPS_M, &[0.0; 3], WALKER_SPEEDS_UP_MPS2),
        AgentType::Cyclist => of(&OTHER_BRAKES, &OTHER_GAPS_M, &[0.0; 3], CYCLIST_SPEEDS_UP_MPS2),
        _ => of(&VEHICLE_BRAKES, &VEHICLE_GAPS_M, &VEHICLE_HEADWAYS_S, VEHICLE_SPEEDS_UP_MPS2),
    }
}
