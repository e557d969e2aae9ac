//! vectors -> vectors, each product and sum in one fixed order

use glam::Vec3;

/// `v` at length one: each part divided by the length, where glam would multiply by its reciprocal.
#[must_use]
pub fn unit(v: Vec3) -> Vec3 {
    v / (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()
}

/// Eq. 2.6: the mirror of `i`, which points away from the surface, about the unit normal `n`.
#[must_use]
pub fn mirror(i: Vec3, n: Vec3) -> Vec3 {
    unit(n * (2.0 * i.dot(n)) - i)
}

/// Of a linear color: Rec. 709.
#[must_use]
pub fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// The largest of the three parts.
#[must_use]
pub fn largest(v: Vec3) -> f32 {
    v.x.max(v.y.max(v.z))
}
