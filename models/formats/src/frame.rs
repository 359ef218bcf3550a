//! Conversion between the scene's frame and that of its source.

use scene::geometry::rotate;
use scene::{Origin, State, Vec2, wrap_angle};
use std::f64::consts::PI;

/// Heading of a rotation in space: w, x, y and z of its quaternion.
pub(crate) fn yaw([w, x, y, z]: [f64; 4]) -> f64 {
    (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z))
}

/// Transforms positions and directions of the scene into those of its source, and back.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    rotation_rad: f64,
    shift: Vec2,
    up_m: f64,
}

impl Frame {
    pub fn of(origin: &Origin) -> Self {
        let shift = Vec2::new(origin.x_m, origin.y_m);
        Self { rotation_rad: origin.rotation_rad, shift, up_m: origin.z_m }
    }

    pub fn turn(self, v: Vec2) -> Vec2 {
        // Rotation by zero would be exact too, except for the sign of zeros.
        if self.rotation_rad == 0.0 { v } else { rotate(v, self.rotation_rad) }
    }

    pub fn place(self, p: Vec2) -> Vec2 {
        self.turn(p) + self.shift
    }

    pub fn heading(self, heading_rad: f64) -> f64 {
        heading_rad + self.rotation_rad
    }

    pub fn height(self, z_m: f64) -> f64 {
        if self.up_m == 0.0 { z_m } else { z_m + self.up_m }
    }

    /// A state in the frame of the source, with its heading wrapped.
    pub fn state(self, state: &State) -> State {
        let (at, v) = (self.place(state.position()), self.turn(state.velocity()));
        let heading_rad = wrapped(self.heading(state.heading_rad));
        State { x_m: at.x, y_m: at.y, heading_rad, vx_mps: v.x, vy_mps: v.y }
    }

    /// A position of the source in the frame of the scene.
    pub fn place_back(self, p: Vec2) -> Vec2 {
        let p = p - self.shift;
        if self.rotation_rad == 0.0 { p } else { rotate(p, -self.rotation_rad) }
    }

    /// A direction of the source in the frame of the scene.
    pub fn turn_back(self, v: Vec2) -> Vec2 {
        if self.rotation_rad == 0.0 { v } else { rotate(v, -self.rotation_rad) }
    }

    /// A heading of the source in the frame of the scene, wrapped.
    pub fn heading_back(self, heading_rad: f64) -> f64 {
        wrapped(heading_rad - self.rotation_rad)
    }

    /// A height of the source in the frame of the scene.
    pub fn height_back(self, z_m: f64) -> f64 {
        if self.up_m == 0.0 { z_m } else { z_m - self.up_m }
    }
}

/// Wraps an angle; one that is already wrapped keeps its last bit.
pub(crate) fn wrapped(angle_rad: f64) -> f64 {
    if (-PI..PI).contains(&angle_rad) { angle_rad } else { wrap_angle(angle_rad) }
}
