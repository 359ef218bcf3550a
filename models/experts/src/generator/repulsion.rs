//! The scene's energy (boxes too close, now or soon, and corners past a kerb) and what repels a draft: the way
//! downhill in it.

use super::actor::{Actor, Drafts};
use super::kerb::kerb;
use super::slot::Slot;
use super::trajectory::{PER_INSTANT, as_it_is, places};
use super::workers::Workers;
use crate::planning::pullback::Pullback;
use crate::planning::world::AgentAtStart;
use crate::planning::{INSTANTS, MODES, Modes, RESIDUAL, Residual};
use crate::tuning::OverlapTuning;
use scene::Vec2;
use scene::geometry::direction;
use scene::geometry::obb::OrientedBox;
use scene::geometry::overlap_energy::{
    Bounds, Growth, MovingBox, OverlapEnergy, absent, carried_back, carried_on, overlap_energy,
};
use scene::motion::MotionState;

/// Boxes farther apart than this do not matter to each other, metres.
const NEAR_M: f32 = 1.0;

/// Places and headings at the instants; [`ABSENT`] where somebody is not there.
pub(super) type Poses = scene::geometry::overlap_energy::Poses<INSTANTS>;

/// The pose of nobody.
pub(super) const ABSENT: [f32; 4] = [0.0; 4];

/// Somebody as an obstacle.
pub(super) struct Outline {
    now: Course,
    /// Where it would be soon.
    soon: Course,
    /// Half length and half width, metres.
    half: [f32; 2],
}

/// Poses, and what is about them.
struct Course {
    poses: Poses,
    bounds: Bounds,
}

impl Course {
    fn new(poses: Poses) -> Self {
        Self { bounds: Bounds::of(&poses), poses }
    }
}

impl Outline {
    /// Of somebody's box along these poses.
    pub(super) fn new(poses: Poses, who: &AgentAtStart, tuning: &OverlapTuning) -> Self {
        Self::sized(poses, half_size(who), tuning)
    }

    fn sized(poses: Poses, half: [f32; 2], tuning: &OverlapTuning) -> Self {
        let soon = carried_on(&poses, tuning.soon_intervals as f32);
        Self { now: Course::new(poses), soon: Course::new(soon), half }
    }

    /// Of boxes at each step of a window, the start first; nobody is there where there is none.
    pub(super) fn of_boxes(boxes: &[Option<OrientedBox>], tuning: &OverlapTuning) -> Self {
        let at = |i: usize| boxes.get((i + 1) * PER_INSTANT)?.as_ref();
        let pose = |i: usize| at(i).map_or(ABSENT, |b| pose_of(b.center(), b.heading_rad()));
        let half = boxes
            .iter()
            .flatten()
            .next()
            .map_or([0.0; 2], |b| [b.half_length_m() as f32, b.half_width_m() as f32]);
        Self::sized(std::array::from_fn(pose), half, tuning)
    }

    /// Whether two come near each other, now or soon.
    pub(super) fn near(&self, other: &Self) -> bool {
        let reach = NEAR_M + self.half[0] + self.half[1] + other.half[0] + other.half[1];
        let close = |a: &Poses, b: &Poses| {
            a.iter().zip(b).any(|(a, b)| {
                let far = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) > reach;
                !far && !absent(a) && !absent(b)
            })
        };
        close(&self.now.poses, &other.now.poses) || close(&self.soon.poses, &other.soon.poses)
    }
}

/// Which terms of the scene's energy count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Terms {
    /// Boxes that are too close: what the networks were trained with.
    Boxes,
    /// Also boxes that soon will be, and corners past the road's edge.
    All,
}

/// The scene's energy as one actor's draft sees it.
#[derive(Clone, Copy)]
pub(super) struct SceneEnergy<'a> {
    pub(super) pullback: &'a Pullback,
    pub(super) tuning: &'a OverlapTuning,
}

impl SceneEnergy<'_> {
    /// The energy at a draft, and the way downhill in its knots; `None` where the energy is zero.
    pub(super) fn downhill(
        &self,
        actor: &Actor,
        slot: Slot,
        residual: &Residual,
        others: &[&Outline],
        terms: Terms,
    ) -> Option<(f32, Residual)> {
        let places = places(&actor.plan, slot, residual);
        let (energy, gradient) = self.at(actor, &places, others, terms);
        if energy == 0.0 {
            return None;
        }
        let mut route = [[0.0; 2]; INSTANTS];
        for (i, (_, heading)) in places.iter().enumerate() {
            let (sin, cos) = (heading.sin() as f32, heading.cos() as f32);
            let [gx, gy] = gradient[i];
            route[i] = [gx * cos + gy * sin, gy * cos - gx * sin];
        }
        Some((energy, self.pullback.downhill(&route, &actor.plan.features.tangent)))
    }

    /// The energy of a draft's places and its gradient to the box centres.
    pub(super) fn at(
        &self,
        actor: &Actor,
        places: &[(Vec2, f64); INSTANTS],
        others: &[&Outline],
        terms: Terms,
    ) -> (f32, [[f32; 2]; INSTANTS]) {
        let own = poses_of(places);
        let half = half_size(&actor.plan.present);
        let found = energy_among(&own, half, others, |o| &o.now);
        let (mut energy, mut gradient) = (found.energy, found.gradient);
        let mut add = |weight: f32, more: f32, slope: [[f32; 2]; INSTANTS]| {
            energy += weight * more;
            for (sum, slope) in gradient.as_flattened_mut().iter_mut().zip(slope.as_flattened()) {
                *sum += weight * slope;
            }
        };
        if terms == Terms::All {
            let soon_intervals = self.tuning.soon_intervals as f32;
            let soon = energy_among(&carried_on(&own, soon_intervals), half, others, |o| &o.soon);
            add(self.tuning.soon as f32, soon.energy, carried_back(&soon.gradient, soon_intervals));
            if actor.keeps_to_the_road {
                let size = &actor.plan.present.size;
                let kerb = kerb(&actor.plan.drivable, size, places, self.tuning.kerb as f32);
                add(1.0, kerb.energy, kerb.gradient);
            }
        }
        (energy, gradient)
    }
}

/// The energy among those of many who come near at all.
fn energy_among(
    own: &Poses,
    half: [f32; 2],
    others: &[&Outline],
    course: impl Fn(&Outline) -> &Course,
) -> OverlapEnergy<INSTANTS> {
    let bounds = Bounds::of(own);
    let near = others.iter().filter(|o| bounds.may_touch(half, &course(o).bounds, o.half));
    let obstacles = near.map(|o| MovingBox { poses: &course(o).poses, half: o.half });
    overlap_energy(own, half, obstacles, Growth::Square)
}

/// What repels every mode of every actor: the refiner's input.
pub(super) fn repulsions(
    energy: &SceneEnergy<'_>,
    workers: &Workers,
    actors: &[Actor],
    drafts: &[Drafts],
    background: &[Outline],
) -> Vec<Modes> {
    let leading = leading_outlines(actors, drafts, energy.tuning);
    let indices: Vec<usize> = (0..actors.len()).collect();
    workers.map(&indices, |&i| {
        let actor = &actors[i];
        if actor.rests {
            return [[0.0; RESIDUAL]; MODES];
        }
        let others = leading.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o);
        let others: Vec<&Outline> = others.chain(background).collect();
        std::array::from_fn(|mode| {
            let slot = Slot::new(mode);
            let found = energy.downhill(actor, slot, slot.of(&drafts[i].modes), &others, Terms::Boxes);
            found.map_or([0.0; RESIDUAL], |(_, downhill)| downhill)
        })
    })
}

/// Every actor along its leading draft.
pub(super) fn leading_outlines(actors: &[Actor], drafts: &[Drafts], tuning: &OverlapTuning) -> Vec<Outline> {
    let outline = |(actor, drafts): (&Actor, &Drafts)| {
        let start = &actor.plan.present.start;
        let poses = if let Some(pinned) = &actor.pinned {
            // A picked future is where it is, whatever its drafts say.
            poses_of_states(&as_it_is(&actor.plan, pinned).states)
        } else if actor.rests {
            [pose_of(start.position(), start.heading_rad); INSTANTS]
        } else {
            poses_of(&places(&actor.plan, drafts.leading, drafts.leading.of(&drafts.modes)))
        };
        Outline::new(poses, &actor.plan.present, tuning)
    };
    actors.iter().zip(drafts).map(outline).collect()
}

fn half_size(who: &AgentAtStart) -> [f32; 2] {
    [0.5 * who.size.length_m as f32, 0.5 * who.size.width_m as f32]
}

/// One place and heading.
pub(super) fn pose_of(position: Vec2, heading_rad: f64) -> [f32; 4] {
    let ahead = direction(heading_rad);
    [position.x as f32, position.y as f32, ahead.x as f32, ahead.y as f32]
}

/// Places and headings of a draft.
pub(super) fn poses_of(places: &[(Vec2, f64); INSTANTS]) -> Poses {
    places.map(|(position, heading)| pose_of(position, heading))
}

/// Places and headings of a motion; nobody is there after its end.
pub(super) fn poses_of_states(states: &[MotionState]) -> Poses {
    let at = |i: usize| states.get((i + 1) * PER_INSTANT);
    std::array::from_fn(|i| at(i).map_or(ABSENT, |s| pose_of(s.position, s.heading_rad)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use crate::tuning::SHIPPED;
    use scene::Goal;

    /// A car at 8 m/s, and somebody who stands at `x`, `y`.
    fn energy_of(x: f64, y: f64, terms: Terms, draft: &Residual) -> Option<(f32, Residual)> {
        let plan = car_on_a_street(8.0, Goal::default());
        let who = plan.present.clone();
        let actor = Actor::new("1".into(), plan, None);
        let standing = Outline::new([pose_of(Vec2::new(x, y), 0.0); INSTANTS], &who, &SHIPPED.overlaps);
        let pullback = Pullback::default();
        let energy = SceneEnergy { pullback: &pullback, tuning: &SHIPPED.overlaps };
        energy.downhill(&actor, Slot::FIRST, draft, &[&standing], terms)
    }

    #[test]
    fn what_stands_on_the_way_repels_and_what_stands_aside_does_not() {
        let (energy, downhill) = energy_of(24.0, 0.6, Terms::Boxes, &[0.0; RESIDUAL]).unwrap();
        let moved = downhill.map(|step| 0.05 * step);
        let (lower, _) = energy_of(24.0, 0.6, Terms::Boxes, &moved).unwrap();
        assert!(lower > 0.0 && lower < energy, "{energy} to {lower}");
        assert!(energy_of(24.0, 9.0, Terms::All, &[0.0; RESIDUAL]).is_none());
    }

    #[test]
    fn all_terms_see_farther_than_boxes() {
        let (boxes, _) = energy_of(24.0, 0.6, Terms::Boxes, &[0.0; RESIDUAL]).unwrap();
        let (all, _) = energy_of(24.0, 0.6, Terms::All, &[0.0; RESIDUAL]).unwrap();
        assert!(all > boxes, "{all} {boxes}");
    }

    #[test]
    fn nobody_is_where_a_motion_has_ended() {
        let poses = poses_of_states(&[MotionState::default(); 11]);
        assert!(poses[1] != ABSENT && poses[2] == ABSENT);
    }
}
