//! Ranges of the numbers in a request that do not depend on the scene.

use super::request::{GenerateRequest, ShownDoc};
use crate::english;
use crate::limits::{DIVERSITY, DRAFT_MS, LEAST_HORIZON_S, MODES, MOST_HORIZON_S, REPLAN_S, SAMPLES, STEPS};
use crate::problem::{Problem, refuse};
use crate::score;
use formats::FieldProblem;
use formats::native::MAX_SAFE_INTEGER;
use formats::refusals::unequal_columns;
use scene::Vec2;

/// Half seconds in a planning window.
const MOST_SHOWN: usize = 18;

impl GenerateRequest {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// All numbers that lie outside, by pointer.
    pub fn check_ranges(&self) -> Result<(), Problem> {
        let (safe, drafts) = (MAX_SAFE_INTEGER as f64, DRAFT_MS as f64);
        let numbers = [
            ("/seed", 0.0, safe, self.seed as f64),
            ("/revision", 0.0, safe, self.revision.unwrap_or(0) as f64),
            ("/horizon_s", LEAST_HORIZON_S, MOST_HORIZON_S, self.horizon_s),
            ("/samples", 1.0, SAMPLES as f64, self.samples as f64),
            ("/modes", 1.0, MODES as f64, self.modes as f64),
            ("/diversity", 0.0, DIVERSITY, self.diversity),
            ("/steps", 0.0, STEPS as f64, self.steps as f64),
            ("/draft_delay_ms", 0.0, drafts, self.draft_delay_ms as f64),
            ("/draft_interval_ms", 0.0, drafts, self.draft_interval_ms as f64),
        ];
        let outside = numbers.into_iter().filter(|(_, min, max, got)| !(got >= min && got <= max));
        let mut faults: Vec<_> =
            outside.map(|(pointer, min, max, got)| FieldProblem::range(pointer, min, max, got)).collect();
        if let Some(got) = self.replan_interval_s.filter(|s| !REPLAN_S.contains(s)) {
            let message = english::replan_interval(got);
            faults.push(FieldProblem::new("/replan_interval_s", "invalid-field", message));
        }
        faults.extend(score::beyond(&self.thresholds));
        refuse(faults)
    }
}

impl ShownDoc {
    /// The places that are used.
    pub(super) fn places(&self, pointer: &str) -> Result<Vec<Vec2>, FieldProblem> {
        if self.x_m.len() != self.y_m.len() {
            let message = unequal_columns(self.y_m.len(), self.x_m.len(), "x_m");
            return Err(FieldProblem::new(format!("{pointer}/y_m"), "invalid-field", message));
        }
        let places = self.x_m.iter().zip(&self.y_m).take(MOST_SHOWN);
        Ok(places.map(|(x, y)| Vec2::new(*x, *y)).collect())
    }
}
