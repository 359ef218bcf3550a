//! The paper's own figures (Wang et al., "DragTraffic", IROS 2024): Table I "Scene Generation Quality Evaluation",
//! Table II "Interaction Reasoning Evaluation", and the cases of its sets.

use crate::methods::Method;
use crate::sets::Centre;

/// Table I of one road user type and method: MinADE6, MinFDE6, heading error, speed error. The paper gives no units.
pub fn quality(centre: Centre, method: Method) -> Option<[f64; 4]> {
    use Centre::{Cyclist, Ego, Pedestrian};
    use Method::{Mixture, Paper, TrafficGen};
    match (centre, method) {
        (Ego, TrafficGen) => Some([3.32, 5.41, 0.05, 0.05]),
        (Ego, Mixture) => Some([3.09, 4.40, 0.04, 0.05]),
        (Ego, Paper) => Some([2.53, 3.33, 0.05, 0.03]),
        (Pedestrian, TrafficGen) => Some([6.50, 9.04, 0.10, 0.40]),
        (Pedestrian, Mixture) => Some([2.05, 3.53, 0.02, 0.36]),
        (Pedestrian, Paper) => Some([1.59, 2.74, 0.02, 0.40]),
        (Cyclist, TrafficGen) => Some([17.05, 23.62, 0.41, 0.31]),
        (Cyclist, Mixture) => Some([3.34, 4.31, 0.06, 0.21]),
        (Cyclist, Paper) => Some([3.93, 6.21, 0.07, 0.37]),
        _ => None,
    }
}

/// Table II: scenario collision rate at a rollout interval in seconds, as a share.
pub fn collisions(interval_s: usize, method: Method) -> Option<f64> {
    match (interval_s, method) {
        (3, Method::Mixture) => Some(0.1500),
        (3, Method::Paper) => Some(0.0920),
        (6, Method::Mixture) => Some(0.1443),
        (6, Method::Paper) => Some(0.0897),
        (9, Method::Mixture) => Some(0.1359),
        (9, Method::Paper) => Some(0.0333),
        _ => None,
    }
}

/// Cases of the paper's sets; its order is ego-, cyclist-, pedestrian-centred.
pub fn cases(centre: Centre) -> usize {
    match centre {
        Centre::Ego => 49_884,
        Centre::Cyclist => 29_046,
        Centre::Pedestrian => 9_344,
    }
}

/// Scenes of Table II by the type that they are chosen for.
pub const INTERACTIVE: [(Centre, usize); 2] = [(Centre::Pedestrian, 200), (Centre::Cyclist, 100)];

/// Seconds between plans in Table II.
pub const ROLLOUTS_S: [usize; 3] = [3, 6, 9];
