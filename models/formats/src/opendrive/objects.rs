//! Crosswalks and stop lines: objects on the roads of a network.

use super::sections::NetworkFrame;
use scene::Vec2;
use scene::map::Area;
use xodr::{Extent, Object, ObjectType, RoadNetwork, Shape};

/// The ring of an object on the road.
fn ring(object: &Object, frame: &NetworkFrame) -> Option<Vec<Vec2>> {
    let ring: Vec<Vec2> = match &object.shape {
        Shape::Outline { corners, .. } => corners.iter().map(|corner| frame.point(corner.base)).collect(),
        Shape::Solid { position, heading, extent: Some(Extent::Box { length, width, .. }), .. } => {
            let half = Vec2::new(f64::from(*length), f64::from(*width)) / 2.0;
            let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
            let corner = |(x, y): (f64, f64)| {
                let local = Vec2::new(half.x * x, half.y * y);
                frame.point(*position) + scene::geometry::rotate(local, f64::from(*heading))
            };
            corners.map(corner).into()
        }
        _ => return None,
    };
    let size = ring.iter().fold(0.0, |most: f64, p| most.max((p - ring[0]).norm()));
    (ring.len() > 2 && size > 0.3).then_some(ring)
}

/// Crosswalks with an outline or a size.
pub(super) fn crosswalks(
    network: &RoadNetwork,
    frame: &NetworkFrame,
    mut id: impl FnMut() -> String,
) -> Vec<Area> {
    let all = network.objects().iter().filter(|object| object.kind == ObjectType::Crosswalk);
    let mut rings: Vec<Vec<Vec2>> = all.filter_map(|object| ring(object, frame)).collect();
    for ring in &mut rings {
        // An outline that repeats its first corner.
        if ring.len() > 3 && (ring[0] - ring[ring.len() - 1]).norm() < 0.01 {
            ring.pop();
        }
    }
    let area = |ring: Vec<Vec2>| Area { id: id(), polygon: ring.into(), holes: Vec::new() };
    rings.into_iter().map(area).collect()
}

/// Centres of painted stop lines, with the lanes that the file assigns to them.
pub(super) fn stop_lines<'a>(
    network: &'a RoadNetwork,
    frame: &'a NetworkFrame,
) -> impl Iterator<Item = (Vec2, &'a [xodr::LaneId])> {
    let lines = network.objects().iter().filter(|object| object.kind != ObjectType::Crosswalk);
    lines.filter_map(move |object| {
        let middle = match &object.shape {
            Shape::Solid { position, .. } => frame.point(*position),
            _ => {
                let ring = ring(object, frame)?;
                ring.iter().sum::<Vec2>() / ring.len() as f64
            }
        };
        Some((middle, object.lanes.as_slice()))
    })
}
