//! Signals for maps that have signal heads but no program: the heads of a junction take turns.

use crate::problem::ImportWarning;
use crate::sentences;
use scene::map::LaneMap;
use scene::{MAX_SIGNALS, STEP_S, Signal, SignalState, Vec2, wrap_angle};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI};

/// Durations of green, of amber, and of red for all, of each group, seconds.
const PHASES_S: [f64; 3] = [12.0, 3.0, 1.0];

/// A signal head: the lane that it controls, and its position.
#[derive(Clone, Debug)]
pub(crate) struct SignalHead {
    /// Index of the lane.
    pub lane: usize,
    pub stop: Vec2,
    /// Direction of the traffic there, radians.
    pub heading_rad: f64,
    /// Junction; its heads share a cycle.
    pub junction: String,
    /// Index and name of the signal group in the source; without one, opposite approaches form a group.
    pub group: Option<(u32, String)>,
}

/// A signal for each head, over `steps` steps, with the warnings about them.
pub(crate) fn signals(
    map: &LaneMap,
    mut heads: Vec<SignalHead>,
    steps: usize,
) -> (Vec<Signal>, Option<ImportWarning>) {
    let mut by_junction: BTreeMap<String, Vec<SignalHead>> = BTreeMap::new();
    let count = heads.len();
    if count > MAX_SIGNALS {
        heads.sort_by(|a, b| a.stop.norm().total_cmp(&b.stop.norm()));
        heads.truncate(MAX_SIGNALS);
    }
    for head in heads {
        by_junction.entry(head.junction.clone()).or_default().push(head);
    }
    let junctions = by_junction.len();
    let mut signals = Vec::new();
    for heads in by_junction.into_values() {
        let groups = groups(&heads);
        let most = groups.iter().max().map_or(1, |last| last + 1);
        for (head, group) in heads.iter().zip(groups) {
            let Some(lane) = map.lanes.get(head.lane) else { continue };
            let runs = runs(group, most, steps);
            signals.push(Signal { lane: lane.id.clone(), stop: Some(head.stop), stop_z_m: None, runs });
        }
    }
    let message = if count > MAX_SIGNALS {
        sentences::signals_made_near(count, junctions, MAX_SIGNALS)
    } else {
        sentences::signals_made(count, junctions)
    };
    (signals, (count > 0).then(|| ImportWarning::new("signals-made", message)))
}

/// Number of the group of each head.
fn groups(heads: &[SignalHead]) -> Vec<usize> {
    let mut names: Vec<_> = heads.iter().filter_map(|head| head.group.as_ref()).collect();
    names.sort();
    names.dedup();
    let said = heads.iter().all(|head| head.group.is_some());
    let group = |head: &SignalHead| {
        if said && names.len() > 1 {
            return names.iter().position(|name| head.group.as_ref() == Some(name)).unwrap_or(0);
        }
        // Parallel to the first head, in either direction, or across it.
        let turn = wrap_angle(2.0 * (head.heading_rad - heads[0].heading_rad)) / 2.0;
        usize::from(turn.abs() > FRAC_PI_4)
    };
    heads.iter().map(group).collect()
}

/// States of one signal group in the form of a scene. A junction with a single group is red for as long as a
/// second group would be green.
fn runs(group: usize, groups: usize, steps: usize) -> Vec<(usize, SignalState)> {
    let turn_s: f64 = PHASES_S.iter().sum();
    let cycle_s = turn_s * groups.max(2) as f64;
    let mut runs: Vec<(usize, SignalState)> = Vec::new();
    for step in 0..steps {
        // In the middle of a step, so that rounding of sums has no effect.
        let in_turn_s = ((step as f64 + 0.5) * STEP_S - turn_s * group as f64).rem_euclid(cycle_s);
        let state = match in_turn_s {
            s if s < PHASES_S[0] => SignalState::Go,
            s if s < PHASES_S[0] + PHASES_S[1] => SignalState::Caution,
            _ => SignalState::Stop,
        };
        if runs.last().is_none_or(|(_, last)| *last != state) {
            runs.push((step, state));
        }
    }
    runs
}

/// Heading of a line at its point nearest to `p`, radians.
pub(crate) fn heading_at(points: &[Vec2], p: Vec2) -> f64 {
    let nearest = points.windows(2).map(|w| {
        let along = w[1] - w[0];
        let share = ((p - w[0]).dot(&along) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        ((w[0] + along * share - p).norm(), along.y.atan2(along.x))
    });
    nearest.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, heading)| heading.clamp(-PI, PI))
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::Lane;

    fn head(lane: usize, heading_rad: f64, group: Option<(u32, String)>) -> SignalHead {
        SignalHead { lane, stop: Vec2::zeros(), heading_rad, junction: "j".into(), group }
    }

    fn shown(heads: Vec<SignalHead>, step: usize) -> Vec<SignalState> {
        let line = vec![Vec2::zeros(), Vec2::new(1.0, 0.0)];
        let lanes = (0..heads.len()).map(|i| Lane::street(i.to_string(), line.clone())).collect();
        let map = LaneMap { lanes, ..LaneMap::default() };
        let (signals, warning) = signals(&map, heads, 600);
        assert_eq!(warning.map(|w| w.code), Some("signals-made"));
        signals.iter().map(|signal| signal.at(step)).collect()
    }

    #[test]
    fn opposite_approaches_go_together() {
        use SignalState::{Caution, Go, Stop};
        let heads = || vec![head(0, 0.1, None), head(1, 3.1, None), head(2, -1.5, None), head(3, 1.6, None)];
        assert_eq!(shown(heads(), 0), [Go, Go, Stop, Stop]);
        assert_eq!(shown(heads(), 130), [Caution, Caution, Stop, Stop]);
        assert_eq!(shown(heads(), 155), [Stop; 4]);
        assert_eq!(shown(heads(), 160), [Stop, Stop, Go, Go]);
        assert_eq!(shown(heads(), 320), [Go, Go, Stop, Stop]);
    }

    #[test]
    fn groups_of_the_source_take_turns() {
        use SignalState::{Go, Stop};
        let named = |i: usize, order| head(i, 0.0, Some((order, "c".to_owned())));
        assert_eq!(shown(vec![named(0, 2), named(1, 1), named(2, 1)], 0), [Stop, Go, Go]);
        assert_eq!(shown(vec![head(0, 0.0, None)], 170), [Stop]);
    }
}
