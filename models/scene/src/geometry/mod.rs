//! Plane geometry of traffic: angles, oriented boxes, polylines.

pub mod crowding;
mod extent;
mod fine_cells;
pub mod obb;
pub mod overlap_energy;
pub mod polyline;
pub mod segments;
pub mod ttc;

pub use extent::Extent;
pub use nalgebra::Vector2;

/// A point or vector in the plane, metres (or m/s), scene frame.
pub type Vec2 = Vector2<f64>;

/// Wraps an angle to [-pi, pi). No other function wraps angles.
pub fn wrap_angle(angle_rad: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let turned = angle_rad + PI;
    // Most angles are in range, and the remainder is slow.
    let wrapped = if (0.0..TAU).contains(&turned) { turned } else { turned.rem_euclid(TAU) } - PI;
    // rem_euclid may round up to TAU itself for tiny negative input.
    if wrapped >= PI { wrapped - TAU } else { wrapped }
}

/// Unit vector that points along `heading_rad`.
pub fn direction(heading_rad: f64) -> Vec2 {
    Vec2::new(heading_rad.cos(), heading_rad.sin())
}

/// `v` turned by `angle_rad` counter-clockwise.
pub fn rotate(v: Vec2, angle_rad: f64) -> Vec2 {
    let (s, c) = angle_rad.sin_cos();
    Vec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}

/// z component of the cross product: positive when `b` lies to the left of `a`.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}
