//! Replaces duplicate modes, so that six modes are six futures.
//!
//! Modes have different anchors, yet before a junction or in a queue they often coincide on every route. The
//! second of two coinciding modes adds nothing, while no mode covers an unlikely start or stop. The less
//! probable of the two takes that role. This occurs in one of fifteen recorded cases, and there the changed
//! mode is the best of the six. On synthetic traffic, where the modes are rightly certain, almost nothing is
//! lost.

use super::slot::Slot;
use super::trajectory::{BASIS, places};
use crate::features::agent::AgentPlan;
use crate::planning::profile::{Caps, approaching};
use crate::planning::{ALONG_SCALE, INSTANTS, MODES, Modes, PER_INSTANT, Residual};
use crate::tuning::DuplicateTuning;
use crate::tuning::fixed::duplicate_modes::RIDGE;
use nalgebra::{SMatrix, SVector};
use scene::motion::MotionKind;
use scene::{AgentType, KNOTS, Vec2};
use std::sync::LazyLock;

/// The distance below which two modes coincide, and the motion that replaces one.
struct Rule {
    /// Mean distance below which two modes coincide, metres.
    same_m: f64,
    /// Mean distance that the changed mode keeps from all others, metres.
    apart_m: f64,
    /// Rate at which it changes its speed, m/s2.
    rate_mps2: f64,
    /// Target speed of a mode that starts, where caps allow, m/s.
    going_mps: f64,
}

impl Rule {
    fn of(agent_type: AgentType, t: &DuplicateTuning) -> Self {
        match agent_type {
            AgentType::Pedestrian => Self {
                same_m: t.pedestrian_same_m,
                apart_m: t.pedestrian_apart_m,
                rate_mps2: t.pedestrian_rate_mps2,
                going_mps: t.pedestrian_going_mps,
            },
            AgentType::Cyclist => Self {
                same_m: t.cyclist_same_m,
                apart_m: t.cyclist_apart_m,
                rate_mps2: t.cyclist_rate_mps2,
                going_mps: t.cyclist_going_mps,
            },
            _ => Self {
                same_m: t.vehicle_same_m,
                apart_m: t.vehicle_apart_m,
                rate_mps2: t.vehicle_rate_mps2,
                going_mps: f64::INFINITY,
            },
        }
    }
}

/// Replaces the less probable of the two nearest modes, where they coincide and the road user has no goal.
/// The new mode starts or stops on the same path, whichever is farther from all other modes.
pub(super) fn replace(
    plan: &AgentPlan,
    modes: &mut Modes,
    probability: &mut [f64; MODES],
    tuning: &DuplicateTuning,
) {
    if !plan.is_free() {
        return;
    }
    let rule = Rule::of(plan.present.agent_type, tuning);
    let drafts: Vec<[Vec2; INSTANTS]> = Slot::all().map(|slot| at(plan, slot, slot.of(modes))).collect();
    let pairs = (0..MODES).flat_map(|a| (0..a).map(move |b| (b, a)));
    let Some(((a, b), gap)) =
        pairs.map(|(a, b)| ((a, b), apart(&drafts[a], &drafts[b]))).min_by(|x, y| x.1.total_cmp(&y.1))
    else {
        return;
    };
    if gap > rule.same_m {
        return;
    }
    let (kept, replaced) = if probability[a] < probability[b] { (b, a) } else { (a, b) };
    let new = |speed_mps: f64| {
        let mut new = modes[replaced];
        new[..KNOTS].copy_from_slice(&pace(plan, Slot::new(replaced), &rule, speed_mps));
        let draft = at(plan, Slot::new(replaced), &new);
        let others = (0..MODES).filter(|slot| *slot != replaced);
        (others.map(|slot| apart(&draft, &drafts[slot])).fold(f64::INFINITY, f64::min), new)
    };
    let (halting, going) = (new(0.0), new(rule.going_mps));
    let (distance, new) = if going.0 >= halting.0 { going } else { halting };
    if distance < rule.apart_m {
        return;
    }
    modes[replaced] = new;
    probability[kept] += probability[replaced];
    probability[replaced] = 0.0;
    for p in probability.iter_mut() {
        *p *= 1.0 - tuning.probability;
    }
    probability[replaced] = tuning.probability;
}

/// Box centres of a draft at the instants.
fn at(plan: &AgentPlan, slot: Slot, residual: &Residual) -> [Vec2; INSTANTS] {
    places(plan, slot, residual).map(|(position, _)| position)
}

/// Mean distance of two drafts, metres.
fn apart(a: &[Vec2; INSTANTS], b: &[Vec2; INSTANTS]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).sum::<f64>() / INSTANTS as f64
}

/// Longitudinal knots that turn an anchor's base into a constant change of speed.
fn pace(plan: &AgentPlan, slot: Slot, rule: &Rule, speed_mps: f64) -> [f32; KNOTS] {
    /// Maps metres at the instants to knots, by least squares.
    static SOLVE: LazyLock<SMatrix<f64, KNOTS, INSTANTS>> = LazyLock::new(|| {
        let rows = BASIS.along;
        let basis = SMatrix::<f64, INSTANTS, KNOTS>::from_fn(|i, k| f64::from(ALONG_SCALE * rows[i][k]));
        // A small ridge keeps the last knots, which move almost nothing, small.
        let normal = basis.tr_mul(&basis) + SMatrix::identity() * RIDGE;
        normal.cholesky().map_or_else(SMatrix::zeros, |c| c.solve(&basis.transpose()))
    });
    let anchor = &plan.anchors[slot.index()];
    let caps = match plan.model.kind {
        MotionKind::Drive => Caps::new(anchor.path.arc_m(), &anchor.caps_mps),
        MotionKind::Walk => Caps::new(&[0.0], &[f64::INFINITY]),
    };
    let v0 = plan.model.start_speed_mps();
    // A road user that is faster than this pace keeps its own speed.
    let speed_mps = if speed_mps > 0.0 { speed_mps.max(v0) } else { 0.0 };
    let wanted = approaching(v0, speed_mps, rule.rate_mps2, &caps);
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
    use crate::planning::RESIDUAL;
    use crate::tuning::SHIPPED;
    use scene::Goal;

    fn planned(goal: Goal) -> AgentPlan {
        car_on_a_street(10.0, goal)
    }

    /// All modes at this pace.
    fn alike(plan: &AgentPlan, speed_mps: f64) -> Modes {
        let rule = Rule::of(AgentType::Vehicle, &SHIPPED.duplicates);
        std::array::from_fn(|slot| {
            let mut residual = [0.0; RESIDUAL];
            residual[..KNOTS].copy_from_slice(&pace(plan, Slot::new(slot), &rule, speed_mps));
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
            replace(&planned, &mut residual, &mut probability, &SHIPPED.duplicates);
            let changed: Vec<usize> = (0..MODES).filter(|slot| residual[*slot] != same[*slot]).collect();
            let &[new] = &changed[..] else { panic!("{changed:?} changed") };
            let end = at(&planned, Slot::new(new), &residual[new])[INSTANTS - 1].x;
            assert!(ends_m.contains(&end), "{end} m after {speed_mps} m/s");
            assert!((probability[new] - SHIPPED.duplicates.probability).abs() < 1e-12);
            assert!((probability.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{probability:?}");
        }
    }

    #[test]
    fn goals_and_futures_of_their_own_are_left_alone() {
        let asked = planned(Goal { speed_mps: Some(10.0), ..Goal::default() });
        let free = planned(Goal::default());
        // The timings of the anchors are all distinct.
        for (planned, modes) in [(&asked, alike(&asked, 10.0)), (&free, [[0.0; RESIDUAL]; MODES])] {
            let (mut residual, mut probability) = (modes, SHARES);
            replace(planned, &mut residual, &mut probability, &SHIPPED.duplicates);
            assert!(residual == modes && probability == SHARES);
        }
    }
}
