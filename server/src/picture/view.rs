//! The part of a scene that a picture shows.

use scene::geometry::Extent;
use scene::{Scene, Vec2};

/// Narrowest and widest square that a picture shows, metres.
const WIDTHS_M: (f64, f64) = (10.0, 2_000.0);
/// Margin beside the outermost road user, metres.
const BESIDE_M: f64 = 20.0;
/// Square around the road users of a scene: narrowest and widest, metres.
const OF_SCENE_M: (f64, f64) = (60.0, 400.0);

/// A square of a scene, north up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneView {
    /// Its centre, metres.
    pub centre: Vec2,
    /// Its side, metres.
    pub width_m: f64,
}

impl SceneView {
    /// A square around a point; its side is clamped to the range of pictures.
    pub fn around(centre: Vec2, width_m: f64) -> Self {
        Self { centre, width_m: width_m.clamp(WIDTHS_M.0, WIDTHS_M.1) }
    }

    /// The road users at a step with their chosen futures, or the map if there are none.
    pub fn whole(scene: &Scene, step: usize) -> Self {
        let present = scene.agents.iter().filter_map(|agent| {
            let track = scene.shown(agent).track;
            track.at(step).map(scene::State::position)
        });
        let futures = scene.agents.iter().filter_map(|agent| {
            let future = scene.generated.as_ref()?.chosen_future(&agent.id)?;
            future.states.last().map(scene::State::position)
        });
        let of_agents = square(present.chain(futures)).map(|(centre, side)| (centre, side + 2.0 * BESIDE_M));
        let points = scene.map.outlines().flat_map(|(line, _)| line.iter().copied());
        let (centre, side) = of_agents.or_else(|| square(points)).unwrap_or((Vec2::zeros(), 0.0));
        Self { centre, width_m: side.clamp(OF_SCENE_M.0, OF_SCENE_M.1) }
    }

    /// Whether a line can be visible in the square: their bounding boxes overlap.
    pub fn shows(&self, points: &[Vec2], beside_m: f64) -> bool {
        let half = 0.5 * self.width_m + beside_m;
        Extent::of(points.iter().copied()).touches(&Extent::of([self.centre]).grown(half))
    }
}

/// Centre and side of the smallest square around points.
fn square(points: impl Iterator<Item = Vec2>) -> Option<(Vec2, f64)> {
    let extent = Extent::about(points)?;
    Some((extent.middle(), extent.size().max()))
}
