//! Surrogate safety measures of an encounter, for pairs with an event.

use super::mover::{Mover, MoverState};
use super::near::{LEAST_GAP_M, Side, follows, meeting_s};
use crate::geometry::direction;
use crate::geometry::obb::{circle_gap, gap_and_direction};
use crate::geometry::ttc::LOOK_AHEAD_S;
use crate::score::pet::post_encroachment_s;
use schemars::JsonSchema;
use serde::Serialize;

/// Pairs farther apart have no encounter yet, metres.
const FAR_M: f64 = 100.0;

/// The worst values of one encounter, up to its event; null where a measure does not apply.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Measures {
    /// Least time to collision if both keep speed and turn rate, seconds; zero once their boxes overlap at a step.
    pub ttc_s: Option<f64>,
    /// Post-encroachment time of the whole motions, seconds.
    pub pet_s: Option<f64>,
    /// Greatest deceleration to avoid the collision, m/s2.
    pub drac_mps2: Option<f64>,
    /// Least gap, metres; below zero the boxes overlap.
    pub gap_m: Option<f64>,
    /// Least headway of the follower, seconds: gap divided by its speed.
    pub headway_s: Option<f64>,
}

impl Measures {
    /// The measures of two motions up to a step, counted from the first scored one.
    pub(in crate::score) fn of(a: &Mover, b: &Mover, last: usize) -> Self {
        let mut found = Self { pet_s: post_encroachment_s(a, b), ..Self::default() };
        for (step, moments) in a.moments.iter().zip(&b.moments).enumerate().take(last + 1) {
            let (Some(p), Some(q)) = moments else { continue };
            if circle_gap(&p.outline, &q.outline) > FAR_M {
                continue;
            }
            found.add((a, p), (b, q), step);
        }
        found
    }

    fn add(&mut self, (a, p): (&Mover, &MoverState), (b, q): (&Mover, &MoverState), step: usize) {
        let side = |mover, moment| Side { mover, moment, step };
        let (gap_m, towards) = gap_and_direction(&p.outline, &q.outline);
        let closing_mps = (p.velocity - q.velocity).dot(&towards);
        let drac_mps2 = closing_mps.max(0.0).powi(2) / (2.0 * gap_m.max(LEAST_GAP_M));
        let ahead = towards.dot(&direction(p.outline.heading_rad()));
        let follower_mps = if ahead > 0.0 { p.speed_mps } else { q.speed_mps };
        let headway_s = (follows(p, q, towards) && follower_mps > 0.0).then(|| gap_m.max(0.0) / follower_mps);
        let horizon_s = self.ttc_s.unwrap_or(LOOK_AHEAD_S);
        self.ttc_s = super::least(self.ttc_s, meeting_s(side(a, p), side(b, q), horizon_s));
        self.gap_m = super::least(self.gap_m, Some(gap_m));
        self.headway_s = super::least(self.headway_s, headway_s);
        if drac_mps2 > 0.0 {
            self.drac_mps2 = Some(self.drac_mps2.map_or(drac_mps2, |most| most.max(drac_mps2)));
        }
    }
}
