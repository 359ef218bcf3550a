//! The scene's frame in that of its source.

use super::proto::MapPoint;
use scene::geometry::rotate;
use scene::{Origin, Vec2};

/// Turns positions and directions of the scene into those of its source.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    rotation_rad: f64,
    shift: Vec2,
    up_m: f64,
}

impl Frame {
    pub(super) fn of(origin: &Origin) -> Self {
        let shift = Vec2::new(origin.x_m, origin.y_m);
        Self { rotation_rad: origin.rotation_rad, shift, up_m: origin.z_m }
    }

    pub(super) fn turn(self, v: Vec2) -> Vec2 {
        // Turning by zero would be exact too, but for the sign of zeros.
        if self.rotation_rad == 0.0 { v } else { rotate(v, self.rotation_rad) }
    }

    pub(super) fn place(self, p: Vec2) -> Vec2 {
        self.turn(p) + self.shift
    }

    pub(super) fn heading(self, heading_rad: f64) -> f64 {
        heading_rad + self.rotation_rad
    }

    pub(super) fn height(self, z_m: f64) -> f64 {
        if self.up_m == 0.0 { z_m } else { z_m + self.up_m }
    }

    pub(super) fn point(self, p: Vec2, z_m: Option<f64>) -> MapPoint {
        let p = self.place(p);
        MapPoint { x: Some(p.x), y: Some(p.y), z: z_m.map(|z| self.height(z)) }
    }
}
