//! The part of the scene's energy that keeps vehicles on the road.

use crate::planning::INSTANTS;
use scene::geometry::obb::OrientedBox;
use scene::geometry::overlap_energy::OverlapEnergy;
use scene::score::Drivable;
use scene::{Size, Vec2};

/// Energy of a box whose centre and heading at the instants are `places`, and its gradient with respect to
/// the centre for fixed headings. Each corner costs `weight` times the square of its distance off the road in
/// metres. Zero if the map has no road bounds.
pub(super) fn kerb(
    ground: &Drivable,
    size: &Size,
    places: &[(Vec2, f64); INSTANTS],
    weight: f32,
) -> OverlapEnergy<INSTANTS> {
    let mut out = OverlapEnergy { energy: 0.0, gradient: [[0.0; 2]; INSTANTS] };
    for (gradient, (position, heading_rad)) in out.gradient.iter_mut().zip(places) {
        let outline = OrientedBox::new(*position, 0.5 * size.length_m, 0.5 * size.width_m, *heading_rad);
        if ground.box_outside_m(&outline).is_none_or(|outside_m| outside_m <= 0.0) {
            continue;
        }
        for (outside_m, way) in outline.corners().into_iter().filter_map(|corner| ground.beyond(corner)) {
            let outside = outside_m as f32;
            out.energy += weight * outside * outside;
            gradient[0] += 2.0 * weight * outside * way.x as f32;
            gradient[1] += 2.0 * weight * outside * way.y as f32;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::map::{Lane, LaneMap, TypedLine};

    const WEIGHT: f32 = 0.3;
    const CAR: Size = Size { length_m: 4.6, width_m: 2.0, height_m: None };

    /// A street eastwards with an edge 4 m to its right, straight or slanting.
    fn street(slant: f64) -> Drivable {
        let points = vec![Vec2::new(-50.0, 0.0), Vec2::new(150.0, 0.0)];
        let lane = Lane { width_m: Some(3.5), ..Lane::street("a", points) };
        let edge = vec![Vec2::new(-50.0, -4.0), Vec2::new(150.0, -4.0 + slant)];
        let edge = TypedLine { id: "edge".into(), line_type: "boundary".into(), points: edge.into() };
        Drivable::new(&LaneMap { lanes: vec![lane], road_edges: vec![edge], ..LaneMap::default() })
    }

    fn beside(y: f64, heading_rad: f64) -> [(Vec2, f64); INSTANTS] {
        std::array::from_fn(|i| (Vec2::new(3.0 * i as f64, y), heading_rad))
    }

    #[test]
    fn what_is_on_the_road_costs_nothing() {
        let found = kerb(&street(0.0), &CAR, &beside(-2.9, 0.0), WEIGHT);
        assert_eq!((found.energy, found.gradient), (0.0, [[0.0; 2]; INSTANTS]));
        let nowhere = kerb(&Drivable::default(), &CAR, &beside(-9.0, 0.0), WEIGHT);
        assert_eq!(nowhere.energy, 0.0);
    }

    #[test]
    fn a_wheel_past_the_edge_is_pulled_back() {
        // Both right corners are 0.5 m past the edge.
        let found = kerb(&street(0.0), &CAR, &beside(-3.5, 0.0), WEIGHT);
        assert!((found.energy - INSTANTS as f32 * 2.0 * WEIGHT * 0.25).abs() < 1e-3, "{}", found.energy);
        for gradient in found.gradient {
            assert!(gradient[0].abs() < 1e-6 && (gradient[1] + 2.0 * WEIGHT).abs() < 1e-4, "{gradient:?}");
        }
    }

    #[test]
    fn gradient_matches_differences() {
        let ground = street(6.0);
        let places = beside(-3.0, 0.2);
        let found = kerb(&ground, &CAR, &places, WEIGHT);
        assert!(found.energy > 0.0);
        for instant in 0..INSTANTS {
            for axis in 0..2 {
                let at = |delta: f64| {
                    let mut moved = places;
                    moved[instant].0[axis] += delta;
                    f64::from(kerb(&ground, &CAR, &moved, WEIGHT).energy)
                };
                let slope = (at(1e-2) - at(-1e-2)) / 2e-2;
                let expected = f64::from(found.gradient[instant][axis]);
                assert!((slope - expected).abs() < 0.02 + 0.02 * slope.abs(), "{slope} {expected}");
            }
        }
    }
}
