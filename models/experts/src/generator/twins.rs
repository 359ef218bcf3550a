//! Six futures that say six things.
//!
//! Modes are told apart by their anchors, yet before a junction or in a queue they often do the same on every
//! route. Of two that coincide one says nothing, while nobody says what was not expected: to pull away, or to halt.
//! So the less probable of the two says that. In one recorded case of fifteen in which this happens it is then the
//! best of the six; on synthetic traffic, where the modes are sure with reason, next to nothing is lost.

use super::realise::{BASIS, PER_INSTANT, places};
use super::window::Residuals;
use crate::features::agent::Planned;
use crate::planning::profile::{Caps, approaching};
use crate::planning::{ALONG_SCALE, INSTANTS, MODES, RESIDUAL};
use nalgebra::{SMatrix, SVector};
use scene::motion::Kind;
use scene::{AgentType, KNOTS, Vec2};
use std::sync::LazyLock;

/// Probability of a future that takes a twin's place. More would be as likely on recorded scenes, where drivers do
/// it, yet draws that do it while all others do as expected overlap.
const UNEXPECTED: f64 = 0.02;

/// What counts as the same, and what is said instead.
struct Twin {
    /// Mean distance below which two futures coincide, metres.
    same_m: f64,
    /// Mean distance that a new one keeps from all others, metres.
    apart_m: f64,
    /// How fast it changes its pace, m/s2.
    rate_mps2: f64,
    /// The pace of who goes, where caps allow, m/s.
    going_mps: f64,
}

impl Twin {
    /// Of what was tried on recorded scenes the best, by little.
    fn of(agent_type: AgentType) -> Self {
        match agent_type {
            AgentType::Pedestrian => Self { same_m: 1.0, apart_m: 0.5, rate_mps2: 0.7, going_mps: 1.6 },
            AgentType::Cyclist => Self { same_m: 1.0, apart_m: 2.0, rate_mps2: 1.0, going_mps: 7.0 },
            _ => Self { same_m: 2.0, apart_m: 3.0, rate_mps2: 1.5, going_mps: f64::INFINITY },
        }
    }
}

/// Where nothing is asked, gives the less probable of the two nearest drafts something of its own to say if they
/// coincide: to go or to halt on its path, whichever is farther from all others.
pub(super) fn part(planned: &Planned, residual: &mut Residuals, probability: &mut [f64; MODES]) {
    if !planned.target.is_free() {
        return;
    }
    let twin = Twin::of(planned.present.agent_type);
    let drafts: Vec<[Vec2; INSTANTS]> = (0..MODES).map(|slot| at(planned, slot, &residual[slot])).collect();
    let pairs = (0..MODES).flat_map(|a| (0..a).map(move |b| (b, a)));
    let Some(((a, b), gap)) =
        pairs.map(|(a, b)| ((a, b), apart(&drafts[a], &drafts[b]))).min_by(|x, y| x.1.total_cmp(&y.1))
    else {
        return;
    };
    if gap > twin.same_m {
        return;
    }
    let (kept, parted) = if probability[a] < probability[b] { (b, a) } else { (a, b) };
    let new = |speed_mps: f64| {
        let mut new = residual[parted];
        new[..KNOTS].copy_from_slice(&pace(planned, parted, &twin, speed_mps));
        let draft = at(planned, parted, &new);
        let others = (0..MODES).filter(|slot| *slot != parted);
        (others.map(|slot| apart(&draft, &drafts[slot])).fold(f64::INFINITY, f64::min), new)
    };
    let (halting, going) = (new(0.0), new(twin.going_mps));
    let (distance, new) = if going.0 >= halting.0 { going } else { halting };
    if distance < twin.apart_m {
        return;
    }
    residual[parted] = new;
    probability[kept] += probability[parted];
    probability[parted] = 0.0;
    for p in probability.iter_mut() {
        *p *= 1.0 - UNEXPECTED;
    }
    probability[parted] = UNEXPECTED;
}

/// Box centres of a draft at the instants.
fn at(planned: &Planned, slot: usize, residual: &[f32; RESIDUAL]) -> [Vec2; INSTANTS] {
    places(planned, slot, residual).map(|(position, _)| position)
}

/// Mean distance of two drafts, metres.
fn apart(a: &[Vec2; INSTANTS], b: &[Vec2; INSTANTS]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).sum::<f64>() / INSTANTS as f64
}

/// Along knots that take an anchor's base to an even change of pace.
fn pace(planned: &Planned, slot: usize, twin: &Twin, speed_mps: f64) -> [f32; KNOTS] {
    /// Metres at the instants to knots, by least squares.
    static SOLVE: LazyLock<SMatrix<f64, KNOTS, INSTANTS>> = LazyLock::new(|| {
        let rows = BASIS.along;
        let basis = SMatrix::<f64, INSTANTS, KNOTS>::from_fn(|i, k| f64::from(ALONG_SCALE * rows[i][k]));
        // A little ridge keeps the last knots, which hardly move anything, small.
        let normal = basis.tr_mul(&basis) + SMatrix::identity() * 0.05;
        normal.cholesky().map_or_else(SMatrix::zeros, |c| c.solve(&basis.transpose()))
    });
    let anchor = &planned.anchors[slot];
    let caps = match planned.model.kind {
        Kind::Drive => Caps::new(anchor.path.arc_m(), &anchor.caps_mps),
        Kind::Walk => Caps::new(&[0.0], &[f64::INFINITY]),
    };
    let v0 = planned.model.start_speed_mps();
    // Who is faster than that already keeps its pace.
    let speed_mps = if speed_mps > 0.0 { speed_mps.max(v0) } else { 0.0 };
    let wanted = approaching(v0, speed_mps, twin.rate_mps2, &caps);
    let change = SVector::<f64, INSTANTS>::from_fn(|i, _| {
        let step = (i + 1) * PER_INSTANT;
        wanted[step] - anchor.base_at(step)
    });
    let knots = *SOLVE * change;
    std::array::from_fn(|k| knots[k] as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use scene::Goal;

    fn planned(goal: Goal) -> Planned {
        car_on_a_street(10.0, goal)
    }

    /// All modes at this pace.
    fn alike(planned: &Planned, speed_mps: f64) -> Residuals {
        let twin = Twin::of(AgentType::Vehicle);
        std::array::from_fn(|slot| {
            let mut residual = [0.0; RESIDUAL];
            residual[..KNOTS].copy_from_slice(&pace(planned, slot, &twin, speed_mps));
            residual
        })
    }

    const SHARES: [f64; MODES] = [0.4, 0.2, 0.1, 0.1, 0.1, 0.1];

    #[test]
    fn one_of_two_that_coincide_halts_or_goes() {
        let planned = planned(Goal::default());
        for (speed_mps, ends_m) in [(10.0, 0.0..40.0), (0.0, 110.0..160.0)] {
            let same = alike(&planned, speed_mps);
            let (mut residual, mut probability) = (same, SHARES);
            part(&planned, &mut residual, &mut probability);
            let changed: Vec<usize> = (0..MODES).filter(|slot| residual[*slot] != same[*slot]).collect();
            let &[new] = &changed[..] else { panic!("{changed:?} changed") };
            let end = at(&planned, new, &residual[new])[INSTANTS - 1].x;
            assert!(ends_m.contains(&end), "{end} m after {speed_mps} m/s");
            assert!((probability[new] - UNEXPECTED).abs() < 1e-12);
            assert!((probability.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{probability:?}");
        }
    }

    #[test]
    fn goals_and_futures_of_their_own_are_left_alone() {
        let asked = planned(Goal { speed_mps: Some(10.0), ..Goal::default() });
        let free = planned(Goal::default());
        // The anchors' own timings are all apart.
        for (planned, modes) in [(&asked, alike(&asked, 10.0)), (&free, [[0.0; RESIDUAL]; MODES])] {
            let (mut residual, mut probability) = (modes, SHARES);
            part(planned, &mut residual, &mut probability);
            assert!(residual == modes && probability == SHARES);
        }
    }
}
