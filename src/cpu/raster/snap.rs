//! world space -> clip space -> fixed point on the film (spec 1.2.3)

use glam::{IVec3, Vec3, Vec4};

use crate::math::quotient::quotient;
use crate::tables::{DEEP, Lens, PLANES, REGION};

fn along(row: Vec4, p: Vec3) -> f32 {
    ((row.x * p.x + row.y * p.y) + row.z * p.z) + row.w
}

/// `World2Camera` and Projection.
#[must_use]
pub fn to_clip(lens: &Lens, p: Vec3) -> Vec4 {
    Vec4::new(along(lens.x, p), along(lens.y, p), along(lens.z, p), along(lens.w, p))
}

/// How far a corner lies on the inner side of a plane: near, far, left, right, bottom, top.
#[must_use]
pub fn height(lens: &Lens, plane: u32, c: Vec4) -> f32 {
    match plane {
        0 => c.z,
        1 => c.w - c.z,
        2 => lens.guard_x * c.w + c.x,
        3 => lens.guard_x * c.w - c.x,
        4 => lens.guard_y * c.w + c.y,
        _ => lens.guard_y * c.w - c.y,
    }
}

/// The planes that a corner lies beyond, one bit each.
#[must_use]
pub fn outcode(lens: &Lens, c: Vec4) -> u32 {
    (0..PLANES).map(|plane| if height(lens, plane, c) >= 0.0 { 0 } else { 1 << plane }).sum()
}

/// Homogeneous division and `Clip2Screen`, in 1/256 pixel with y down; depth as a share of [`DEEP`].
#[must_use]
pub fn snap(lens: &Lens, c: Vec4) -> IVec3 {
    let half = [(lens.span_x * 128) as f32, (lens.span_y * 128) as f32];
    let x = half[0] + half[0] * quotient(c.x, c.w);
    let y = half[1] - half[1] * quotient(c.y, c.w);
    let z = quotient(c.z, c.w).clamp(0.0, 1.0) * DEEP as f32;
    let start = [lens.left, lens.top].map(|at| (at % REGION) as i32 * 256);
    IVec3::new((x + 0.5).floor() as i32 - start[0], (y + 0.5).floor() as i32 - start[1], z as i32)
}
