//! Converts relations of goals from document to domain.

use super::conditions::{GoalDoc, GoalRelationDoc, PLACES};
use crate::problem::Problems;
use crate::refusals::{self, expected, wanted};
use scene::relation::{AFTER_S, GAP_M, GAP_S, LANES_LEFT, SLOWER_MPS};
use scene::{GoalRelation, RelativePlace};

impl GoalRelationDoc {
    /// Checks every member, and that the rest of the goal has no member that the relation replaces. `pointer`
    /// is the place of this document. The scene checks whether `to` exists.
    pub(super) fn resolve(
        &self,
        pointer: &str,
        goal: &GoalDoc,
        problems: &mut Problems,
    ) -> Option<GoalRelation> {
        let ranges = [GAP_M, GAP_M, GAP_S, AFTER_S];
        let places = self.places();
        let given = PLACES.iter().zip(ranges).zip(places).filter_map(|(of, value)| Some((of, value?)));
        let mut inside = true;
        for ((name, range), value) in given {
            inside &= problems.range(&format!("{pointer}/{name}"), range, value);
        }
        if let Some(slower_mps) = self.slower_mps {
            inside &= problems.range(&format!("{pointer}/slower_mps"), SLOWER_MPS, slower_mps);
        }
        if let Some(lanes) = self.lanes_left {
            inside &= problems.range(&format!("{pointer}/lanes_left"), LANES_LEFT, f64::from(lanes));
        }
        let place = match places {
            [Some(m), None, None, None] => RelativePlace::Ahead(m + 0.0),
            [None, Some(m), None, None] => RelativePlace::Behind(m + 0.0),
            [None, None, Some(s), None] => RelativePlace::BehindBy(s + 0.0),
            [None, None, None, Some(s)] => RelativePlace::After(s + 0.0),
            _ => {
                problems.invalid(pointer, expected(wanted::ONE_PLACE));
                return None;
            }
        };
        self.refuse_replaced(pointer, goal, matches!(place, RelativePlace::After(_)), problems);
        inside.then(|| GoalRelation {
            to: self.to.clone(),
            place,
            slower_mps: self.slower_mps.unwrap_or_default() + 0.0,
            lanes_left: self.lanes_left.unwrap_or_default(),
        })
    }

    /// Refuses members that the relation replaces.
    fn refuse_replaced(&self, pointer: &str, goal: &GoalDoc, passing: bool, problems: &mut Problems) {
        if passing {
            let has_place = goal.x_m.is_some() || goal.ahead_m.is_some();
            if !has_place {
                problems.invalid(format!("{pointer}/after_s"), refusals::needs("after_s", "x_m, y_m"));
            }
            let other = [
                ("time_s", goal.time_s.is_some()),
                ("slower_mps", self.slower_mps.is_some()),
                ("lanes_left", self.lanes_left.is_some()),
            ];
            for (name, _) in other.into_iter().filter(|(_, given)| *given) {
                problems.invalid(format!("{pointer}/after_s"), refusals::not_both("after_s", name));
            }
            return;
        }
        let replaced = [
            ("x_m", goal.x_m),
            ("y_m", goal.y_m),
            ("heading_rad", goal.heading_rad),
            ("ahead_m", goal.ahead_m),
            ("left_m", goal.left_m),
            ("turn_rad", goal.turn_rad),
        ];
        let replaced = replaced.into_iter().filter(|(_, value)| value.is_some()).map(|(name, _)| name);
        for name in replaced.chain(goal.velocity.is_some().then_some("velocity")) {
            problems.invalid(pointer, refusals::not_both("relation", name));
        }
        if self.slower_mps.is_some() && goal.speed_mps.is_some() {
            problems.invalid(format!("{pointer}/slower_mps"), refusals::not_both("slower_mps", "speed_mps"));
        }
    }
}
