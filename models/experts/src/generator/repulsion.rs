//! The scene's energy (boxes that are or soon will be too close, and corners past a kerb), and its descent
//! direction, which repels a draft.

use super::actor::PlannedActor;
use super::drafts::Drafts;
use super::kerb::kerb;
use super::motion::{Places, Sweep};
use super::slot::Slot;
use super::trajectory::{as_it_is, places};
use super::workers::WorkerPool;
use crate::features::encounters::{Encounters, encounters};
use crate::planning::pullback::Pullback;
use crate::planning::{INSTANTS, Modes, Residual};
use crate::request::Refining;
use crate::tuning::OverlapTuning;
use scene::geometry::direction;
use scene::geometry::overlap_energy::{
    Bounds, Growth, MovingBox, OverlapEnergy, Poses, absent, carried_back, carried_on, overlap_energy,
};
use scene::{AgentType, Size, Vec2};

/// Boxes farther apart than this do not affect each other, metres.
const NEAR_M: f32 = 1.0;

/// An agent as an obstacle.
pub(super) struct Outline {
    now: PoseTrack,
    /// Its predicted poses a little later.
    soon: PoseTrack,
    /// Half length and half width, metres.
    half: [f32; 2],
}

/// Poses at the instants, and their bounding rectangle.
struct PoseTrack {
    poses: Poses<INSTANTS>,
    bounds: Bounds,
}

impl PoseTrack {
    fn new(poses: Poses<INSTANTS>) -> Self {
        Self { bounds: Bounds::of(&poses), poses }
    }
}

impl Outline {
    /// The obstacle of a box along these places.
    pub(super) fn new(places: &Places, size: &Size, tuning: &OverlapTuning) -> Self {
        let poses = poses_of(places);
        let soon = carried_on(&poses, tuning.soon_intervals as f32);
        Self { now: PoseTrack::new(poses), soon: PoseTrack::new(soon), half: half_of(size) }
    }

    /// Whether two obstacles come near each other, now or soon.
    pub(super) fn near(&self, other: &Self) -> bool {
        let reach = NEAR_M + self.half[0] + self.half[1] + other.half[0] + other.half[1];
        let close = |a: &PoseTrack, b: &PoseTrack| {
            a.poses.iter().zip(&b.poses).any(|(a, b)| {
                let far = (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) > reach;
                !far && !absent(a) && !absent(b)
            })
        };
        close(&self.now, &other.now) || close(&self.soon, &other.soon)
    }
}

/// Motions as obstacles.
pub(super) fn outlines<'a>(sweeps: impl Iterator<Item = &'a Sweep>, tuning: &OverlapTuning) -> Vec<Outline> {
    sweeps.map(|sweep| Outline::new(&sweep.places(), sweep.size(), tuning)).collect()
}

/// Which terms of the scene's energy count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Terms {
    /// Boxes that are too close: the energy of the networks' training.
    Boxes,
    /// Also boxes that soon will be too close, and corners past the road's edge.
    All,
}

/// The scene's energy as one actor's draft sees it.
#[derive(Clone, Copy)]
pub(super) struct SceneEnergy<'a> {
    pub(super) pullback: &'a Pullback,
    pub(super) tuning: &'a OverlapTuning,
}

impl SceneEnergy<'_> {
    /// The energy at a draft, and its descent direction in the knots; `None` if the energy is zero.
    pub(super) fn downhill(
        &self,
        actor: &PlannedActor,
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

    /// The energy of a draft's places and its gradient with respect to the box centres.
    pub(super) fn at(
        &self,
        actor: &PlannedActor,
        places: &[(Vec2, f64); INSTANTS],
        others: &[&Outline],
        terms: Terms,
    ) -> (f32, [[f32; 2]; INSTANTS]) {
        let own = poses_of(&places.map(Some));
        let half = half_of(&actor.plan.present.size);
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

/// The energy of the overlaps with the agents that come near.
fn energy_among(
    own: &Poses<INSTANTS>,
    half: [f32; 2],
    others: &[&Outline],
    track: impl Fn(&Outline) -> &PoseTrack,
) -> OverlapEnergy<INSTANTS> {
    let bounds = Bounds::of(own);
    let near = others.iter().filter(|o| bounds.may_touch(half, &track(o).bounds, o.half));
    let obstacles = near.map(|o| MovingBox { poses: &track(o).poses, half: o.half });
    overlap_energy(own, half, obstacles, Growth::Square)
}

/// The refiner's inputs about the others, besides an actor's modes.
#[derive(Clone, Debug, Default)]
pub(super) struct Surroundings {
    /// Descent direction of the overlap energy, by mode.
    pub(super) repulsion: Modes,
    /// The agents that each mode encounters.
    pub(super) encounters: Encounters,
}

/// The surroundings of every actor's modes, with all others on their leading drafts. Only actors of the
/// `attending` types have encounters.
pub(super) fn surroundings(
    energy: &SceneEnergy<'_>,
    workers: &WorkerPool,
    (actors, drafts): (&[PlannedActor], &[Drafts]),
    background: &[Outline],
    (refining, attending): (&Refining, &[AgentType]),
) -> Vec<Surroundings> {
    let looks = refining.attention && !attending.is_empty();
    if !refining.repulsion && !looks {
        return vec![Surroundings::default(); actors.len()];
    }
    let leading = leading_outlines(actors, drafts, energy.tuning);
    let indices: Vec<usize> = (0..actors.len()).collect();
    workers.map(&indices, |&i| {
        let (actor, mut seen) = (&actors[i], Surroundings::default());
        if actor.rests {
            return seen;
        }
        let others = leading.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, o)| o);
        let others: Vec<&Outline> = others.chain(background).collect();
        for slot in Slot::all() {
            let residual = slot.of(&drafts[i].modes);
            if looks && attending.contains(&actor.plan.present.agent_type) {
                let own = poses_of(&places(&actor.plan, slot, residual).map(Some));
                let boxes = others.iter().map(|o| MovingBox { poses: &o.now.poses, half: o.half });
                seen.encounters[slot.index()] = encounters(&own, half_of(&actor.plan.present.size), boxes);
            }
            if refining.repulsion
                && let Some((_, downhill)) = energy.downhill(actor, slot, residual, &others, Terms::Boxes)
            {
                seen.repulsion[slot.index()] = downhill;
            }
        }
        seen
    })
}

/// Every actor as an obstacle along its leading draft.
pub(super) fn leading_outlines(
    actors: &[PlannedActor],
    drafts: &[Drafts],
    tuning: &OverlapTuning,
) -> Vec<Outline> {
    let outline = |(actor, drafts): (&PlannedActor, &Drafts)| {
        let start = &actor.plan.present.start;
        let places = if let Some(pinned) = &actor.pinned {
            // A picked future does not depend on the drafts.
            as_it_is(&actor.plan, pinned).places()
        } else if actor.rests {
            [Some((start.position(), start.heading_rad)); INSTANTS]
        } else {
            places(&actor.plan, drafts.leading, drafts.leading.of(&drafts.modes)).map(Some)
        };
        Outline::new(&places, &actor.plan.present.size, tuning)
    };
    actors.iter().zip(drafts).map(outline).collect()
}

fn half_of(size: &Size) -> [f32; 2] {
    [0.5 * size.length_m as f32, 0.5 * size.width_m as f32]
}

/// Places as the energy reads them: an absent agent has direction zero.
fn poses_of(places: &Places) -> Poses<INSTANTS> {
    let pose = |(position, heading_rad): (Vec2, f64)| {
        let ahead = direction(heading_rad);
        [position.x as f32, position.y as f32, ahead.x as f32, ahead.y as f32]
    };
    places.map(|place| place.map_or([0.0; 4], pose))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generator::samples::car_on_a_street;
    use crate::planning::RESIDUAL;
    use crate::tuning::SHIPPED;
    use scene::Goal;

    /// Energy and gradient of a car at 8 m/s near an agent that stands at `x`, `y`.
    fn energy_of(x: f64, y: f64, terms: Terms, draft: &Residual) -> Option<(f32, Residual)> {
        let plan = car_on_a_street(8.0, Goal::default());
        let size = plan.present.size;
        let actor = PlannedActor::new("1".into(), plan, None);
        let standing = Outline::new(&[Some((Vec2::new(x, y), 0.0)); INSTANTS], &size, &SHIPPED.overlaps);
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
    fn an_agent_is_absent_where_its_motion_has_ended() {
        let size = Size { length_m: 4.6, width_m: 2.0, height_m: None };
        let sweep = Sweep::new(vec![Some(scene::State::default()); 11], &size);
        let poses = poses_of(&sweep.places());
        assert!(!absent(&poses[1]) && absent(&poses[2]));
    }
}
