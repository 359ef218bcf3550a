//! The planning windows of a call, with the steps that each executes.

use crate::request::Request;
use scene::{HORIZON_STEPS, MAX_HORIZON_STEPS};
use std::ops::Range;

/// Steps after the call's start that each window executes.
pub(super) struct Spans(Vec<Range<usize>>);

impl Spans {
    pub(super) fn of(request: &Request) -> Self {
        let horizon = request.horizon_steps.clamp(1, MAX_HORIZON_STEPS);
        let interval = request.replan_steps.unwrap_or(HORIZON_STEPS).clamp(1, HORIZON_STEPS);
        Self((0..horizon).step_by(interval).map(|from| from..horizon.min(from + interval)).collect())
    }

    /// Number of windows; at least one.
    pub(super) fn count(&self) -> usize {
        self.0.len()
    }

    pub(super) fn window(&self, number: usize) -> Range<usize> {
        self.0[number].clone()
    }

    /// Steps after the call's start at which the last window begins.
    pub(super) fn last_start(&self) -> usize {
        self.0.last().map_or(0, |span| span.start)
    }
}
