//! Diversity by sampling: drafts are drawn with a wider spread of paces and lines, and those that differ most
//! are kept.

use super::actor::PlannedActor;
use super::diversity::{DiverseModes, best};
use super::noise::NoiseKey;
use super::slot::Slot;
use super::variations::{DraftView, HURRY, moves_m, tangent};
use crate::planning::{MODES, Modes, RESIDUAL, Residual};
use crate::tuning::DiversityTuning;
use crate::tuning::fixed::sampling::{FULL_DRIVING_M, FULL_ON_FOOT_M, FULL_RIDING_M, MORE_HURRY, SHARES};
use scene::{AgentType, HORIZON_STEPS, KNOT_S, KNOTS, STEP_S};

/// Draws per mode; the one farthest from the others is taken.
const DRAWS: usize = 4;
/// First step number of the keys that are not refinement steps.
const FIRST_KEY: u64 = 1 << 32;
/// Number of waves in a drawn pace, and in a drawn line.
const WAVES: usize = 3;

/// The offsets that a draw adds to the modes of an actor, and their probabilities after it.
pub(super) fn widen(
    actor: &PlannedActor,
    diverse: &DiverseModes,
    diversity: f64,
    key: NoiseKey<'_>,
    tuning: &DiversityTuning,
) -> (Modes, [f64; MODES]) {
    let (mut added, mut probability) = ([[0.0; RESIDUAL]; MODES], diverse.probability);
    let share = 0.5 * diversity;
    let spread = DrawSpread::of(actor, share, tuning);
    if spread.along_m < 1e-3 && spread.across_m < 1e-3 {
        return (added, probability);
    }
    let shown = |slot: Slot| -> Residual {
        std::array::from_fn(|k| slot.of(&actor.modes)[k] + slot.of(&diverse.offset)[k])
    };
    let best = best(actor);
    let steady = |slot: &Slot| diverse.steady[slot.index()];
    let mut taken: Vec<DraftView<'_>> =
        Slot::all().filter(steady).map(|slot| DraftView::of(actor, slot, &shown(slot))).collect();
    let draws: [Modes; DRAWS] =
        std::array::from_fn(|draw| NoiseKey { step: FIRST_KEY + draw as u64, ..key }.normals(1.0));
    let drawn: Vec<Slot> = Slot::all().filter(|slot| !steady(slot) && *slot != best).collect();
    let mut waiting: Vec<DraftView<'_>> =
        drawn.iter().rev().map(|slot| DraftView::of(actor, *slot, &shown(*slot))).collect();
    while let Some(from) = waiting.pop() {
        let slot = from.slot;
        let drawn = draws.iter().map(|normals| {
            let (offset, far, made) = spread.offset(actor, &from, slot.of(normals));
            // Maximizes the sum of the distances to all others plus the least of them.
            let apart = taken.iter().chain(&waiting).map(|t| t.apart_m(&made));
            let (sum, least) = apart.fold((0.0, f64::INFINITY), |(sum, least), m| (sum + m, m.min(least)));
            (sum + least, offset, far, made)
        });
        let Some((_, offset, far, made)) = drawn.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        added[slot.index()] = offset;
        probability[slot.index()] *= (-0.5 * far * far * share * share).exp();
        taken.push(made);
    }
    let sum: f64 = probability.iter().sum();
    (added, probability.map(|p| p / sum.max(1e-12)))
}

/// Spread of a draw: mean metres over a window.
struct DrawSpread {
    along_m: f64,
    across_m: f64,
    /// Length of motion at which the full spread applies, metres; shorter motions spread less.
    way_m: f64,
    /// Share by which it may exceed the caps of its path.
    hurry: f64,
}

impl DrawSpread {
    fn of(actor: &PlannedActor, share: f64, t: &DiversityTuning) -> Self {
        let goal = actor.plan.target.position.is_some();
        // The spread grows with the square of the setting, so small settings stay near likely motions.
        let along = share * share;
        let (along_m, across_m, way_m) = match actor.plan.present.agent_type {
            AgentType::Pedestrian => {
                (if goal { t.goal_on_foot_m } else { t.on_foot_m }, t.aside_on_foot_m, FULL_ON_FOOT_M)
            }
            AgentType::Cyclist => (if goal { t.goal_m } else { t.riding_m }, t.aside_m, FULL_RIDING_M),
            _ => (if goal { t.goal_m } else { t.driving_m }, t.aside_m, FULL_DRIVING_M),
        };
        // A goal that is due early leaves less room.
        let room = if goal {
            let seconds = actor.plan.target.step as f64 * STEP_S;
            (seconds / (HORIZON_STEPS as f64 * STEP_S)).powi(2)
        } else {
            1.0
        };
        Self {
            along_m: along * along_m * room,
            across_m: along * across_m,
            way_m,
            hurry: HURRY + MORE_HURRY * share,
        }
    }

    /// A drawn offset that keeps the goal, and its size relative to the allowed spread.
    fn offset<'a>(
        &self,
        actor: &PlannedActor,
        from: &DraftView<'a>,
        normals: &Residual,
    ) -> (Residual, f64, DraftView<'a>) {
        let waits = actor.plan.target.position.is_none() && from.ends_at_rest();
        let moving = if waits { 0.0 } else { (from.way_m() / self.way_m).min(1.0) };
        let mut waves = [0.0; RESIDUAL];
        for k in 0..KNOTS {
            let at = std::f64::consts::PI * k as f64 * KNOT_S / (HORIZON_STEPS as f64 * STEP_S);
            for wave in 0..WAVES {
                let value = (wave as f64 * at).cos() as f32;
                waves[k] += normals[wave] * value;
                waves[KNOTS + k] += normals[WAVES + wave] * (value - 1.0 + (at * 0.5).sin() as f32);
            }
        }
        let shape = tangent(&actor.plan, &waves);
        let (along, across) = moves_m(&shape);
        // Between 0.5 and 1.5 times the spread.
        let far = |z: f32| 0.5 + 1.0 / (1.0 + f64::from(-z).exp());
        let far_along = far(normals[2 * WAVES]);
        let scale = [
            self.along_m * moving * far_along / along.max(1e-6),
            self.across_m * moving * far(normals[2 * WAVES + 1]) / across.max(1e-6),
        ];
        let scaled = |along: f64| -> Residual {
            std::array::from_fn(|k| {
                let scale = if k < KNOTS { along * scale[0] } else { scale[1] };
                (scale * f64::from(shape[k])) as f32
            })
        };
        for share in SHARES {
            let offset = scaled(share);
            let made = from.with(&offset);
            if made.is_usual(from, self.hurry) {
                return (offset, share * far_along, made);
            }
        }
        let offset = scaled(0.0);
        (offset, 0.0, from.with(&offset))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use crate::tuning::SHIPPED;
    use scene::{Goal, Vec2};

    fn driver(goal_m: Option<f64>) -> PlannedActor {
        let position = goal_m.map(|x| Vec2::new(x, 0.0));
        PlannedActor::new("1".into(), car_on_a_street(9.0, Goal { position, ..Goal::default() }), None)
    }

    fn drawn(actor: &PlannedActor, diversity: f64, seed: u64) -> Vec<DraftView<'_>> {
        let diverse = DiverseModes::of(actor, &[], 1.0, &SHIPPED.duplicates);
        let key = NoiseKey { seed, sample: 0, agent: "1", window: 0, step: 0 };
        let (added, probability) = widen(actor, &diverse, diversity, key, &SHIPPED.diversity);
        assert!((probability.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let offset = |i: usize| std::array::from_fn(|k| diverse.offset[i][k] + added[i][k]);
        (0..MODES).map(|i| DraftView::of(actor, Slot::new(i), &offset(i))).collect()
    }

    fn spread_m(all: &[DraftView<'_>]) -> f64 {
        let pairs = (0..MODES).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.map(|(a, b)| all[a].apart_m(&all[b])).sum::<f64>()
    }

    #[test]
    fn zero_repeats_and_more_parts_modes_and_seeds() {
        for goal_m in [None, Some(80.0)] {
            let actor = driver(goal_m);
            let of = |diversity: f64, seed: u64| drawn(&actor, diversity, seed);
            let moved = |a: &[DraftView<'_>], b: &[DraftView<'_>]| -> f64 {
                a.iter().zip(b).map(|(a, b)| a.apart_m(b)).sum()
            };
            assert_eq!(moved(&of(0.0, 1), &of(0.0, 2)), 0.0);
            let apart = [0.5, 1.0, 2.0].map(|d| moved(&of(d, 1), &of(d, 2)));
            assert!(0.0 < apart[0] && apart[0] < apart[1] && apart[1] < apart[2], "{apart:?}");
            let mean = |d: f64| (0..8).map(|seed| spread_m(&of(d, seed))).sum::<f64>();
            // Without a goal, the paces of one road range from standing to its limit anyway.
            if goal_m.is_some() {
                assert!(mean(2.0) > 1.15 * mean(0.5), "{} {}", mean(2.0), mean(0.5));
            }
        }
    }

    #[test]
    fn the_best_guess_and_the_goal_stay() {
        let actor = driver(Some(80.0));
        let (zero, wide) = (drawn(&actor, 0.0, 3), drawn(&actor, 2.0, 3));
        assert_eq!(zero[0].apart_m(&wide[0]), 0.0);
        for view in &wide {
            assert!((view.way_m() - zero[0].way_m()).abs() < 0.05, "{}", view.way_m());
        }
    }
}
