//! Compact form of futures: integers in units of the last rounded digit, as second differences over the
//! steps. The conversion is lossless.

use formats::native::{AgentFuturesDoc, FutureDoc};
use scene::judge::{Fault, Manoeuvre, Reaction, Relation};
use scene::{AgentFutures, Future, State};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Form of the futures in a reply.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum FuturesForm {
    /// As in a scene document.
    #[default]
    Columns,
    /// The same numbers in about half the bytes.
    Compact,
}

/// The futures of one road user in a reply, in the form that `futures` of the request names.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum FuturesDoc {
    /// `columns`.
    Columns(AgentFuturesDoc),
    /// `compact`.
    Compact(CompactFuturesDoc),
}

/// The futures of one road user, compact.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CompactFuturesDoc {
    /// Index into `compact` of the future that is shown and exported.
    chosen: u64,
    /// In order of decreasing probability.
    compact: Vec<CompactFuture>,
    /// Why it left its previous motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    reaction: Option<Reaction>,
}

/// One possible motion as second differences. A column starts with its first value, followed by the first
/// difference and then by the changes of the difference. Two running sums restore the columns of a scene
/// document exactly.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CompactFuture {
    /// Relative weight among the road user's futures; see `calibrated` of the answer.
    probability: f64,
    /// Index of the generator's anchor that it follows.
    #[serde(skip_serializing_if = "Option::is_none")]
    anchor: Option<u32>,
    /// Scene step of the first value.
    first_step: u64,
    /// Box centre, millimetres.
    x_mm: Vec<i64>,
    /// Box centre, millimetres.
    y_mm: Vec<i64>,
    /// Heading in units of 0.0001 rad.
    heading_e4rad: Vec<i64>,
    /// Velocity, mm/s.
    vx_mmps: Vec<i64>,
    /// Velocity, mm/s.
    vy_mmps: Vec<i64>,
    /// Faults, the worst first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    faults: Vec<Fault>,
    /// Relations to other road users.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    relations: Vec<Relation>,
    /// What it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    manoeuvre: Option<Manoeuvre>,
}

impl FuturesDoc {
    /// The futures of one road user: all of them, or only the chosen one.
    pub fn new(futures: &AgentFutures, all_modes: bool, form: FuturesForm) -> Self {
        let modes = if all_modes {
            futures.modes.as_slice()
        } else {
            futures.modes.get(futures.chosen).map_or(&[][..], std::slice::from_ref)
        };
        let chosen = if all_modes { futures.chosen as u64 } else { 0 };
        let reaction = futures.reaction.clone();
        match form {
            FuturesForm::Columns => {
                let modes = modes.iter().map(FutureDoc::from_future).collect();
                Self::Columns(AgentFuturesDoc { chosen, modes, reaction })
            }
            FuturesForm::Compact => {
                let compact = modes.iter().map(CompactFuture::of).collect();
                Self::Compact(CompactFuturesDoc { chosen, compact, reaction })
            }
        }
    }
}

impl CompactFuture {
    fn of(future: &Future) -> Self {
        let column = |per_unit: f64, of: fn(&State) -> f64| {
            let (mut last, mut change) = (0, 0);
            let mut next = |(i, state): (usize, &State)| {
                let value = (of(state) * per_unit).round() as i64;
                let (before, changed) = (change, value - last);
                (last, change) = (value, if i == 0 { 0 } else { changed });
                changed - before
            };
            future.states.iter().enumerate().map(&mut next).collect()
        };
        Self {
            probability: future.probability,
            anchor: future.anchor,
            first_step: future.first_step as u64,
            x_mm: column(1e3, |s| s.x_m),
            y_mm: column(1e3, |s| s.y_m),
            heading_e4rad: column(1e4, |s| s.heading_rad),
            vx_mmps: column(1e3, |s| s.vx_mps),
            vy_mmps: column(1e3, |s| s.vy_mps),
            faults: future.about.faults.clone(),
            relations: future.about.relations.clone(),
            manoeuvre: future.about.manoeuvre,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decodes a column as a client does.
    fn column(compact: &[i64], per_unit: f64) -> Vec<f64> {
        let (mut value, mut change) = (0, 0);
        let mut next = |(i, number): (usize, &i64)| {
            if i == 0 {
                value = *number;
            } else {
                change += number;
                value += change;
            }
            value as f64 / per_unit
        };
        compact.iter().enumerate().map(&mut next).collect()
    }

    #[test]
    fn compact_columns_are_the_same_numbers_in_fewer_bytes() {
        let state = |i: i32| {
            let t = f64::from(i) * 0.1;
            let heading_rad = scene::wrap_angle(3.0 + 0.2 * t);
            let (vx_mps, vy_mps) = (12.345_67 * heading_rad.cos(), 12.345_67 * heading_rad.sin());
            State { x_m: -8_123.456_7 + vx_mps * t, y_m: 0.000_4 + vy_mps * t, heading_rad, vx_mps, vy_mps }
        };
        let mut future = Future::bare(0.25, 7, (0..90).map(state).collect());
        for steps in [90, 2, 1, 0] {
            future.states.truncate(steps);
            let (plain, compact) = (FutureDoc::from_future(&future), CompactFuture::of(&future));
            assert_eq!(column(&compact.x_mm, 1e3), plain.x_m);
            assert_eq!(column(&compact.y_mm, 1e3), plain.y_m);
            assert_eq!(column(&compact.heading_e4rad, 1e4), plain.heading_rad);
            assert_eq!(column(&compact.vx_mmps, 1e3), plain.vx_mps);
            assert_eq!(column(&compact.vy_mmps, 1e3), plain.vy_mps);
        }
        future.states = (0..90).map(state).collect();
        let size = |value: &FuturesDoc| serde_json::to_vec(value).unwrap().len();
        let futures = AgentFutures::of(0, vec![future.clone(), future]);
        let plain = size(&FuturesDoc::new(&futures, true, FuturesForm::Columns));
        let compact = size(&FuturesDoc::new(&futures, true, FuturesForm::Compact));
        assert!(2 * compact < plain, "{compact} of {plain} bytes");
        assert!(2 * size(&FuturesDoc::new(&futures, false, FuturesForm::Compact)) < compact + 100);
    }
}
