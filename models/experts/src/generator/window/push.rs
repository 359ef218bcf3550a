//! Ways out of each other's way: the push that refinement sees, and guidance of a chosen scene.

use super::super::actor::{Actor, kept_state};
use super::super::choice::Choice;
use super::super::realise::{Motion, PER_INSTANT, places, realise};
use super::kerb::kerb;
use super::options::{options, shown_motion};
use super::{Residuals, Window};
use crate::planning::world::{Present, World};
use crate::planning::{INSTANTS, MODES, RESIDUAL};
use scene::Vec2;
use scene::geometry::direction;
use scene::geometry::overlap_energy::{Growth, MovingBox, absent, carried_back, carried_on, overlap_energy};
use scene::motion::MotionState;
use std::collections::BTreeSet;

/// Steps of guidance on a conflicting draft, and the share of the push taken at each.
const GUIDANCE: (usize, f32) = (12, 0.35);

/// Rounds of settling, and the longest share of the push taken at each.
const SETTLING: (usize, f32) = (12, 0.7);
/// Weight of boxes that soon will be too close.
const SOON: f32 = 0.3;
/// A meeting so soon at the velocity of the moment counts: intervals between instants, a second.
const SOON_INTERVALS: f32 = 2.0;

/// Boxes farther apart than this do not matter to each other, metres.
const NEAR_M: f32 = 1.0;

type Poses = scene::geometry::overlap_energy::Poses<INSTANTS>;

/// Somebody as an obstacle.
pub(super) struct Outline {
    poses: Poses,
    /// Where it would be soon.
    soon: Poses,
    /// Half length and half width, metres.
    half: [f32; 2],
}

impl Outline {
    fn new(poses: Poses, half: [f32; 2]) -> Self {
        Self { soon: carried_on(&poses, SOON_INTERVALS), poses, half }
    }

    /// Whether two come near each other, now or soon.
    fn near(&self, other: &Self) -> bool {
        let reach = NEAR_M + self.half[0] + self.half[1] + other.half[0] + other.half[1];
        let close = |a: &Poses, b: &Poses| {
            a.iter().zip(b).any(|(a, b)| {
                let far = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) > reach;
                !far && !absent(a) && !absent(b)
            })
        };
        close(&self.poses, &other.poses) || close(&self.soon, &other.soon)
    }
}

/// Which terms of the scene's energy count.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Terms {
    /// Boxes that are too close: what the networks were trained with.
    Boxes,
    /// Also boxes that soon will be, and corners past the road's edge.
    All,
}

impl Window<'_> {
    /// The way downhill in the scene's overlap energy, for every mode of everybody.
    pub(super) fn pushes(&self) -> Vec<Residuals> {
        let moving = self.standing();
        let kept = self.kept_poses(&self.world());
        let indices: Vec<usize> = (0..self.actors.len()).collect();
        self.generator.workers.map(&indices, |&i| {
            let actor = &self.actors[i];
            if actor.rests {
                return [[0.0; RESIDUAL]; MODES];
            }
            let others = moving.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, m)| m).chain(&kept);
            let near: Vec<&Outline> = others.collect();
            std::array::from_fn(|mode| {
                let found = self.push(actor, mode, &self.drafts[i][mode], &near, Terms::Boxes);
                found.map_or([0.0; RESIDUAL], |(_, push)| push)
            })
        })
    }

    /// The way downhill in the scene's energy at a draft, and the energy there; nothing where it is zero.
    fn push(
        &self,
        actor: &Actor,
        mode: usize,
        residual: &[f32; RESIDUAL],
        others: &[&Outline],
        terms: Terms,
    ) -> Option<(f32, [f32; RESIDUAL])> {
        let places = places(&actor.planned, mode, residual);
        let (energy, gradient) = self.energy(actor, &places, others, terms);
        if energy == 0.0 {
            return None;
        }
        let mut route = [[0.0; 2]; INSTANTS];
        for (i, (_, heading)) in places.iter().enumerate() {
            let (sin, cos) = (heading.sin() as f32, heading.cos() as f32);
            let [gx, gy] = gradient[i];
            route[i] = [gx * cos + gy * sin, gy * cos - gx * sin];
        }
        Some((energy, self.pullback.push(&route, &actor.planned.features.tangent)))
    }

    /// Energy of a draft's places and its gradient to the box centres: boxes that come too close, now or soon,
    /// and corners past the road's edge.
    fn energy(
        &self,
        actor: &Actor,
        places: &[(Vec2, f64); INSTANTS],
        others: &[&Outline],
        terms: Terms,
    ) -> (f32, [[f32; 2]; INSTANTS]) {
        let own = poses_of(places);
        let half = half_size(&actor.planned.present);
        let obstacles = others.iter().map(|o| MovingBox { poses: &o.poses, half: o.half });
        let found = overlap_energy(&own, half, obstacles, Growth::Square);
        let (mut energy, mut gradient) = (found.energy, found.gradient);
        let mut add = |weight: f32, more: f32, slope: [[f32; 2]; INSTANTS]| {
            energy += weight * more;
            for (sum, slope) in gradient.as_flattened_mut().iter_mut().zip(slope.as_flattened()) {
                *sum += weight * slope;
            }
        };
        if terms == Terms::All {
            let obstacles = others.iter().map(|o| MovingBox { poses: &o.soon, half: o.half });
            let soon = overlap_energy(&carried_on(&own, SOON_INTERVALS), half, obstacles, Growth::Square);
            add(SOON, soon.energy, carried_back(&soon.gradient, SOON_INTERVALS));
            if actor.keeps_to_the_road {
                let kerb = kerb(&self.map.drivable, &actor.planned.present.size, places);
                add(1.0, kerb.energy, kerb.gradient);
            }
        }
        (energy, gradient)
    }

    /// Everybody's standing draft.
    fn standing(&self) -> Vec<Outline> {
        let all = self.actors.iter().zip(&self.drafts).zip(&self.standing_for);
        all.map(|((actor, draft), mode)| {
            Outline::new(actor_poses(actor, *mode, &draft[*mode]), half_size(&actor.planned.present))
        })
        .collect()
    }

    /// Plain steps downhill from the drafts that stand for their road users, one after the other, so that of
    /// two in each other's way the second sees where the first has gone. What does not lower the energy is
    /// not taken. The drafts stay as they are: where they lead is one more thing that each could do.
    pub(super) fn settle(&mut self) {
        let kept = self.kept_poses(&self.world());
        let mut moving = self.standing();
        // The order of road users in the scene must not show.
        let mut order: Vec<usize> = (0..self.actors.len()).collect();
        order.sort_by(|a, b| self.actors[*a].id.cmp(&self.actors[*b].id));
        // Who has found nothing to gain looks again when somebody near it has moved.
        let mut looks: Vec<bool> =
            self.actors.iter().map(|actor| !actor.rests && actor.pinned.is_none()).collect();
        let may_look = looks.clone();
        for _ in 0..SETTLING.0 {
            for &i in &order {
                if !std::mem::take(&mut looks[i]) {
                    continue;
                }
                let (actor, mode) = (&self.actors[i], self.standing_for[i]);
                let others = moving.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o);
                let others: Vec<&Outline> = others.chain(&kept).collect();
                let from = self.settled[i].unwrap_or(self.drafts[i][mode]);
                let Some((residual, poses)) = self.downhill(actor, mode, &from, &others) else { continue };
                self.settled[i] = Some(residual);
                let settled = Outline::new(poses, moving[i].half);
                let left = std::mem::replace(&mut moving[i], settled);
                for (k, looks) in looks.iter_mut().enumerate() {
                    *looks |= may_look[k] && (k == i || moving[k].near(&moving[i]) || moving[k].near(&left));
                }
            }
        }
    }

    /// A step downhill from a draft, the longest of a few that lowers the energy.
    fn downhill(
        &self,
        actor: &Actor,
        mode: usize,
        residual: &[f32; RESIDUAL],
        others: &[&Outline],
    ) -> Option<([f32; RESIDUAL], Poses)> {
        let (before, push) = self.push(actor, mode, residual, others, Terms::All)?;
        [SETTLING.1, 0.5 * SETTLING.1, 0.25 * SETTLING.1].into_iter().find_map(|share| {
            let moved = std::array::from_fn(|i| residual[i] + share * push[i]);
            let places = places(&actor.planned, mode, &moved);
            let lower = self.energy(actor, &places, others, Terms::All).0 < before;
            lower.then(|| (moved, poses_of(&places)))
        })
    }

    /// Those who keep their motion, as obstacles.
    fn kept_poses(&self, world: &World<'_>) -> Vec<Outline> {
        let pose = |p: &Present| {
            let mut poses = [[0.0; 4]; INSTANTS];
            for (i, pose) in poses.iter_mut().enumerate() {
                let step = (i + 1) * PER_INSTANT;
                if let Some(s) = kept_state(world.scene, world.agent(p), world.step, step) {
                    *pose = pose_of(s.position(), s.heading_rad);
                }
            }
            Outline::new(poses, half_size(p))
        };
        self.in_the_way(world).map(pose).collect()
    }

    /// Those who keep their motion and count.
    pub(super) fn in_the_way<'w>(&self, world: &'w World<'_>) -> impl Iterator<Item = &'w Present> {
        let acting: BTreeSet<usize> = self.actors.iter().map(|a| a.planned.present.index).collect();
        let count = self.request.stages.kept_in_the_way;
        world.present.iter().filter(move |p| count && !acting.contains(&p.index))
    }

    /// Where the chosen scene still has conflicts, drafts pushed apart become further options; the choice
    /// takes them only where that costs less.
    pub(super) fn guide(
        &self,
        world: &World<'_>,
        choice: &mut Choice,
        motions: &mut [Vec<(f64, usize, Motion)>],
        chosen: &mut Vec<usize>,
    ) {
        let conflict = choice.in_conflict(chosen);
        if !conflict.iter().any(|c| *c) {
            return;
        }
        let present: Vec<Outline> = (0..self.actors.len())
            .map(|i| {
                let actor = &self.actors[i];
                let half = half_size(&actor.planned.present);
                match shown_motion(actor, chosen[i]).and_then(|m| motions[i].get(m)) {
                    Some((_, _, motion)) => Outline::new(poses_of_states(&motion.states), half),
                    None => Outline::new(poses_of_kept(actor), half),
                }
            })
            .collect();
        let kept = self.kept_poses(world);
        let concerned: Vec<usize> = (0..self.actors.len())
            .filter(|i| conflict[*i] && !self.actors[*i].rests && self.actors[*i].pinned.is_none())
            .collect();
        let guided = self.generator.workers.map(&concerned, |&i| {
            let actor = &self.actors[i];
            let others = present.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, p)| p).chain(&kept);
            let others: Vec<&Outline> = others.collect();
            let modes = motions[i].iter().take(self.mode_count(i));
            let slots: Vec<(f64, usize)> = modes.map(|m| (m.0, m.1)).collect();
            slots
                .into_iter()
                .filter_map(|(p, slot)| {
                    Some((p, slot, self.guided(actor, slot, &self.drafts[i][slot], &others)?))
                })
                .collect::<Vec<_>>()
        });
        for (i, guided) in concerned.into_iter().zip(guided) {
            motions[i].extend(guided);
            choice.agents[i] = options(&self.actors[i], &motions[i], self.around(i), &self.map);
        }
        *chosen = choice.solve();
    }

    /// A draft pushed out of others' ways; `None` when nothing pushes it.
    fn guided(
        &self,
        actor: &Actor,
        slot: usize,
        residual: &[f32; RESIDUAL],
        others: &[&Outline],
    ) -> Option<Motion> {
        let mut moved = *residual;
        let mut pushed = false;
        for _ in 0..GUIDANCE.0 {
            // Out of the boxes' way is far enough; on the way there the road counts too.
            let places = places(&actor.planned, slot, &moved);
            if self.energy(actor, &places, others, Terms::Boxes).0 == 0.0 {
                break;
            }
            let Some((_, push)) = self.push(actor, slot, &moved, others, Terms::All) else { break };
            pushed = true;
            for (value, push) in moved.iter_mut().zip(push) {
                *value += GUIDANCE.1 * push;
            }
        }
        pushed.then(|| realise(&actor.planned, slot, &moved))
    }
}

fn half_size(who: &Present) -> [f32; 2] {
    [0.5 * who.size.length_m as f32, 0.5 * who.size.width_m as f32]
}

fn pose_of(position: Vec2, heading_rad: f64) -> [f32; 4] {
    let ahead = direction(heading_rad);
    [position.x as f32, position.y as f32, ahead.x as f32, ahead.y as f32]
}

fn poses_of(places: &[(Vec2, f64); INSTANTS]) -> Poses {
    places.map(|(position, heading)| pose_of(position, heading))
}

fn poses_of_states(states: &[MotionState]) -> Poses {
    std::array::from_fn(|i| {
        let s = &states[((i + 1) * PER_INSTANT).min(states.len() - 1)];
        pose_of(s.position, s.heading_rad)
    })
}

fn poses_of_kept(actor: &Actor) -> Poses {
    let kept = actor.kept.as_deref().unwrap_or_default();
    std::array::from_fn(|i| {
        let state = kept.get((i + 1) * PER_INSTANT - 1);
        state.map_or([0.0; 4], |s| pose_of(s.position(), s.heading_rad))
    })
}

fn actor_poses(actor: &Actor, mode: usize, residual: &[f32; RESIDUAL]) -> Poses {
    if actor.rests {
        let start = &actor.planned.present.start;
        return [pose_of(start.position(), start.heading_rad); INSTANTS];
    }
    poses_of(&places(&actor.planned, mode, residual))
}
