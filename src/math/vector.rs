//! vectors -> vectors, each product and sum in one fixed order

use glam::Vec3;

/// `v` at length one: each part divided by the length, where glam would multiply by its reciprocal.
#[must_use]
pub fn unit(v: Vec3) -> Vec3 {
    v / (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()
}

/// [`unit()`] of what may be so long, or so short, that its square is more or less than an `f32` holds.
#[must_use]
pub fn unit_of_any(v: Vec3) -> Vec3 {
    let most = largest(v.abs());
    let shrunk = if most > 1.1529215e18 { v * 8.67361738e-19 } else { v };
    unit(if most < 8.67361738e-19 { shrunk * 1.1529215e18 } else { shrunk })
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
