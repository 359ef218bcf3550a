//! Faults towards agents that change their motion because of the judged one: it forces them to brake hard, or
//! takes the crosswalk from a pedestrian.

use super::{Fault, FaultKind, Judge, near, new};
use crate::geometry::obb::OrientedBox;
use crate::geometry::{cross, direction};
use crate::map::Area;
use crate::score::Actor;
use crate::score::kinematic::hardest_braking;
use crate::{AgentType, STEP_S, State, wrap_angle};
use std::f64::consts::FRAC_PI_6;

/// A pedestrian who steps onto a crosswalk less than this later was not kept waiting, seconds.
const WAITS_S: f64 = 1.0;
/// A motion that turns by more than this near a crosswalk must let pedestrians cross on green too.
const TURNS_RAD: f64 = FRAC_PI_6;
/// Time before a crosswalk in which a turn towards it is searched, steps.
const TURN_STEPS: usize = 40;

/// The motion of another agent with and without the judged one.
pub struct Change<'a> {
    /// With the judged motion.
    pub now: Actor<'a>,
    /// Without it.
    pub before: Actor<'a>,
}

impl Judge<'_> {
    /// Faults of a motion towards agents that change because of it. `extent` is the braking in m/s2, or the
    /// pedestrian's delay in seconds.
    pub fn towards(&self, actor: &Actor<'_>, changes: &[Change<'_>]) -> Vec<Fault> {
        changes
            .iter()
            .filter_map(|change| match change.now.agent_type {
                AgentType::Pedestrian => self.takes_the_crosswalk(actor, change),
                _ => self.forces_braking(actor, change),
            })
            .collect()
    }

    fn forces_braking(&self, actor: &Actor<'_>, change: &Change<'_>) -> Option<Fault> {
        // A follower is responsible for its own distance.
        if starts_behind(&change.before, actor, self.input.steps.start) {
            return None;
        }
        let limit = self.input.thresholds.forced_brake_mps2;
        let hardest = |of: &Actor<'_>| hardest_braking(of, self.input.steps.clone());
        let (step, braking) = hardest(&change.now).filter(|(_, braking)| *braking > limit)?;
        if hardest(&change.before).is_some_and(|(_, before)| before > limit) {
            return None;
        }
        let time_s = step as f64 * STEP_S;
        let with = Some(change.now.id.to_owned());
        let state = near(actor, time_s)?;
        Some(Fault { with, ..new(FaultKind::ForcesBraking, (time_s, time_s), state, Some(braking)) })
    }

    /// A vehicle or rider drives over a crosswalk that a pedestrian would have stepped onto, so the
    /// pedestrian waits.
    fn takes_the_crosswalk(&self, actor: &Actor<'_>, change: &Change<'_>) -> Option<Fault> {
        if actor.agent_type == AgentType::Pedestrian {
            return None;
        }
        let steps = self.input.steps.clone();
        let on = |area: &Area, of: &Actor<'_>| {
            let box_meets = |state: &State| {
                let outline = OrientedBox::of_state(state, &of.size);
                outline.corners().iter().chain([&outline.center()]).any(|p| area.is_near(*p, 0.0))
            };
            steps.clone().find(|step| of.state(*step).is_some_and(box_meets))
        };
        self.input.map.crosswalks.iter().find_map(|area| {
            let (wanted, mine) = (on(area, &change.before)?, on(area, actor)?);
            // A pedestrian who is already on the crosswalk continues.
            let starts_on_it = wanted == steps.start || mine == steps.start;
            let stepped = on(area, &change.now).unwrap_or(steps.end);
            let waited_s = stepped.saturating_sub(wanted) as f64 * STEP_S;
            let overtaken = mine < stepped;
            if starts_on_it || waited_s < WAITS_S || !overtaken || self.has_right_of_way(actor, mine) {
                return None;
            }
            let time_s = mine as f64 * STEP_S;
            let with = Some(change.now.id.to_owned());
            let state = near(actor, time_s)?;
            Some(Fault { with, ..new(FaultKind::FailsToYield, (time_s, time_s), state, Some(waited_s)) })
        })
    }

    /// Whether the motion goes straight over the crosswalk in a scene with signals, which decide the
    /// priority.
    fn has_right_of_way(&self, actor: &Actor<'_>, at: usize) -> bool {
        let heading = |step: usize| actor.state(step).map(|s| s.heading_rad);
        let from = at.saturating_sub(TURN_STEPS).max(self.input.steps.start);
        let turned = heading(from).zip(heading(at)).map_or(0.0, |(a, b)| wrap_angle(b - a).abs());
        turned < TURNS_RAD && self.has_lights()
    }
}

/// Whether one agent is behind the other on its line at this step.
fn starts_behind(one: &Actor<'_>, other: &Actor<'_>, step: usize) -> bool {
    let Some((behind, ahead)) = one.state(step).zip(other.state(step)) else { return false };
    let forward = direction(behind.heading_rad);
    let apart = ahead.position() - behind.position();
    let beside_m = 0.5 * (one.size.width_m + other.size.width_m);
    forward.dot(&apart) > 0.0
        && cross(forward, apart).abs() < beside_m
        && wrap_angle(ahead.heading_rad - behind.heading_rad).abs() < TURNS_RAD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LaneMap;
    use crate::score::Drivable;
    use crate::score::tests::{area, straight};
    use std::f64::consts::FRAC_PI_2;

    const CAR: AgentType = AgentType::Vehicle;

    fn kinds(map: &LaneMap, actor: &Actor<'_>, change: Change<'_>) -> Vec<(FaultKind, f64)> {
        let drivable = Drivable::new(map);
        let judge = Judge::new(map, &[], &drivable, 0..91);
        let faults = judge.towards(actor, &[change]);
        faults.iter().map(|f| (f.kind, f.extent.unwrap_or_default())).collect()
    }

    /// 15 m/s for 2 s, then braking at this rate for 2 s.
    fn braking(rate: f64) -> Actor<'static> {
        let mut actor = straight("behind", CAR, (0.0, 0.0), 0.0, 15.0);
        for (i, state) in actor.track.to_mut().states.iter_mut().enumerate() {
            let Some(state) = state else { continue };
            let t = (i as f64 * STEP_S - 2.0).clamp(0.0, 2.0);
            state.vx_mps = 15.0 - rate * t;
        }
        actor
    }

    #[test]
    fn hard_braking_of_another_is_forced_by_its_cause_alone() {
        let forced = |beside_m: f64, now: f64, before: f64| {
            let me = straight("me", CAR, (40.0, beside_m), 0.0, 10.0);
            kinds(&LaneMap::default(), &me, Change { now: braking(now), before: braking(before) })
        };
        assert_eq!(forced(3.5, 4.0, 0.0), [(FaultKind::ForcesBraking, 4.0)]);
        assert!(forced(3.5, 2.5, 0.0).is_empty(), "it slows in time");
        assert!(forced(3.5, 4.0, 4.0).is_empty(), "it brakes as hard anyway");
        assert!(forced(0.5, 4.0, 0.0).is_empty(), "it follows from the start");
    }

    #[test]
    fn who_takes_the_crosswalk_from_a_pedestrian_fails_to_yield() {
        // A crosswalk over a road to the east, from y = -4 to 4 at x = 20.
        let crosswalk = area(&[(18.0, -4.0), (22.0, -4.0), (22.0, 4.0), (18.0, 4.0)]);
        let map = LaneMap { crosswalks: vec![crosswalk], ..LaneMap::default() };
        let me = |x_m: f64| straight("me", CAR, (x_m, 0.0), 0.0, 5.0);
        let walks = |y_m: f64| straight("walker", AgentType::Pedestrian, (20.0, y_m), FRAC_PI_2, 1.0);
        let change = |later_s: f64| Change { now: walks(-6.0 - later_s), before: walks(-6.0) };
        let found = kinds(&map, &me(5.0), change(3.0));
        assert_eq!(found, [(FaultKind::FailsToYield, 3.0)]);
        assert!(kinds(&map, &me(5.0), change(0.5)).is_empty(), "half a second is no wait");
        assert!(kinds(&map, &me(-30.0), change(3.0)).is_empty(), "it comes after the pedestrian");
        assert!(kinds(&map, &me(20.0), change(3.0)).is_empty(), "it stands there already");
    }
}
