//! Features of a rollout: kinematics, distances to others, road edges.

use super::super::Site;
use super::super::together::{Motions, STRIDE};
use super::edges::RoadEdges;
use scene::geometry::obb::{OrientedBox, circle_gap, signed_gap};
use scene::geometry::ttc::time_to_collision;
use scene::{AgentType, HORIZON_STEPS, STEP_S, State, wrap_angle};

/// Accelerations count only above this speed, m/s.
const MOVING_MPS: f64 = 0.5;

/// One histogram.
pub(super) struct Feature {
    pub(super) name: &'static str,
    /// Bounds and bins of a number; `None` for a yes-or-no feature.
    pub(super) bins: Option<(f64, f64, usize)>,
    pub(super) weight: f64,
}

const fn number(name: &'static str, low: f64, high: f64, bins: usize, weight: f64) -> Feature {
    Feature { name, bins: Some((low, high, bins)), weight }
}

/// The features of the challenge in its order, without traffic-light violations. Its bound is 3.14, not pi.
#[allow(clippy::approx_constant, reason = "a published number")]
pub(super) const FEATURES: [Feature; 9] = [
    number("speed", 0.0, 25.0, 10, 0.05),
    number("acceleration", -12.0, 12.0, 11, 0.05),
    number("yaw rate", -0.628, 0.628, 11, 0.05),
    number("yaw acceleration", -3.14, 3.14, 11, 0.05),
    number("distance to nearest", -5.0, 40.0, 10, 0.10),
    Feature { name: "collision", bins: None, weight: 0.25 },
    number("time to collision", 0.0, 5.0, 10, 0.10),
    number("distance to road edge", -20.0, 40.0, 10, 0.10),
    Feature { name: "off-road", bins: None, weight: 0.25 },
];

/// Index of time to collision among the features.
const TIME_TO_COLLISION: usize = 6;

/// Horizon of the time to collision, seconds.
const HORIZON_S: f64 = 5.0;
/// Greatest distance to the nearest object, metres.
const FAR_M: f64 = 40.0;

/// One road user's features in one rollout: values over time, one list per feature; a yes-or-no feature has
/// one value, 1 or 0. Empty if a feature does not apply.
#[derive(Clone, Debug, Default)]
pub(super) struct Motion {
    pub(super) values: [Vec<f64>; FEATURES.len()],
    felt: [Vec<f64>; 3],
}

impl Motion {
    /// Least time to collision; `None` if it was not evaluated.
    pub(super) fn time_to_collision_s(&self) -> Option<f64> {
        self.values[TIME_TO_COLLISION].iter().copied().reduce(f64::min)
    }

    /// Longitudinal acceleration, lateral acceleration and jerk above 0.5 m/s.
    pub(super) fn felt(&self) -> [Vec<f64>; 3] {
        self.felt.clone()
    }
}

/// Features of some road users, one entry each, at the steps at which their log is known.
pub(super) fn observe(site: &Site<'_>, edges: &RoadEdges, motions: &Motions, whom: &[usize]) -> Vec<Motion> {
    let outlines: Vec<Option<Vec<(OrientedBox, State)>>> = motions
        .iter()
        .enumerate()
        .map(|(i, states)| {
            let size = &site.scene.agents[i].size;
            let states = states.as_ref()?.iter().skip(STRIDE - 1).step_by(STRIDE);
            Some(states.map(|s| (OrientedBox::of_state(s, size), *s)).collect())
        })
        .collect();
    whom.iter()
        .map(|&i| {
            let mut motion = Motion::default();
            if let Some(states) = &motions[i] {
                kinematics(site, i, states, &mut motion);
                surroundings(site, edges, i, &outlines, &mut motion);
            }
            motion
        })
        .collect()
}

fn kinematics(site: &Site<'_>, agent: usize, states: &[State], out: &mut Motion) {
    let log = &site.scene.agents[agent];
    let start = log.state_at(0);
    let at = |step: usize| match step {
        0 => start,
        _ => states.get(step - 1).copied().filter(|_| log.track.at(step).is_some()),
    };
    // Central differences over two steps.
    let span = 2.0 * STEP_S;
    let all = || (0..=HORIZON_STEPS).map(at);
    let all: Vec<Option<State>> = all().collect();
    let difference = |values: &[Option<f64>], wrap: bool| -> Vec<Option<f64>> {
        let mut out = vec![None; values.len()];
        for i in 1..values.len().saturating_sub(1) {
            if let (Some(a), Some(b)) = (values[i - 1], values[i + 1]) {
                out[i] = Some(if wrap { wrap_angle(b - a) } else { b - a } / span);
            }
        }
        out
    };
    let mut speed = vec![None; all.len()];
    for i in 1..all.len() - 1 {
        if let (Some(a), Some(b)) = (all[i - 1], all[i + 1]) {
            speed[i] = Some((b.position() - a.position()).norm() / span);
        }
    }
    let headings: Vec<Option<f64>> = all.iter().map(|s| s.map(|s| s.heading_rad)).collect();
    let acceleration = difference(&speed, false);
    let yaw_rate = difference(&headings, true);
    let yaw_acceleration = difference(&yaw_rate, false);
    let jerk = difference(&acceleration, false);
    for (i, values) in [&speed, &acceleration, &yaw_rate, &yaw_acceleration].into_iter().enumerate() {
        out.values[i] = values.iter().flatten().copied().collect();
    }
    for i in 0..all.len() {
        let Some(speed) = speed[i].filter(|v| *v > MOVING_MPS) else { continue };
        out.felt[0].extend(acceleration[i]);
        out.felt[1].extend(yaw_rate[i].map(|w| (w * speed).abs()));
        out.felt[2].extend(jerk[i].map(f64::abs));
    }
}

fn surroundings(
    site: &Site<'_>,
    edges: &RoadEdges,
    agent: usize,
    outlines: &[Option<Vec<(OrientedBox, State)>>],
    out: &mut Motion,
) {
    let Some(own) = &outlines[agent] else { return };
    let drives = site.scene.agents[agent].agent_type == AgentType::Vehicle && !edges.is_empty();
    let known = |i: usize, moment: usize| site.scene.agents[i].track.at((moment + 1) * STRIDE).is_some();
    let (mut collides, mut leaves) = (false, false);
    for (moment, (outline, state)) in own.iter().enumerate().filter(|(m, _)| known(agent, *m)) {
        let (mut nearest, mut soonest) = (FAR_M, HORIZON_S);
        for (j, other) in outlines.iter().enumerate() {
            let Some((other, moving)) = other.as_ref().and_then(|o| o.get(moment)) else { continue };
            if j == agent || !known(j, moment) {
                continue;
            }
            if circle_gap(outline, other) < nearest {
                nearest = nearest.min(signed_gap(outline, other));
            }
            let (v, w) = (state.velocity(), moving.velocity());
            soonest = time_to_collision(outline, v, other, w, HORIZON_S).map_or(soonest, |t| t.min(soonest));
        }
        collides |= nearest < 0.0;
        out.values[4].push(nearest);
        out.values[6].push(soonest);
        if drives {
            let distance = edges.distance_m(state.position());
            let outside = site.drivable.outside_m(state.position()).is_some_and(|m| m > 0.0);
            // The challenge counts inside as negative.
            out.values[7].push(if outside { distance } else { -distance });
            leaves |= site.drivable.box_outside_m(outline).is_some_and(|m| m > 0.1);
        }
    }
    out.values[5].push(f64::from(u8::from(collides)));
    if drives {
        out.values[8].push(f64::from(u8::from(leaves)));
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::together::motions_of_log;
    use super::*;
    use lab_train::samples::{log, scene, shifted};

    #[test]
    fn known_kinematics_and_gaps() {
        // Two cars 4.7 m long, 20 m apart, the second 10 m/s faster.
        let scene = scene(vec![log("a", 15.0, 91), shifted(log("b", 5.0, 91), 200.0, 0.0)]);
        let site = Site::new(0, &scene);
        let edges = RoadEdges::new(&scene.map);
        let seen = observe(&site, &edges, &motions_of_log(&site), &[0, 1]);
        assert!(seen[0].values[0].iter().all(|v| (v - 15.0).abs() < 1e-9));
        assert!(seen[0].values[1].iter().all(|a| a.abs() < 1e-6));
        assert_eq!(seen[0].values[0].len(), 89);
        // After 9 s the gap is 200 - 90 - 4.7 m, more than is searched.
        assert!(seen[0].values[4].iter().all(|d| *d == FAR_M));
        assert_eq!((seen[0].values[5].as_slice(), seen[0].values[8].len()), (&[0.0][..], 0));
        assert!(seen[0].values[6].iter().all(|t| *t == HORIZON_S));
        assert!(seen[0].felt[1].iter().all(|a| a.abs() < 1e-9));
    }
}
