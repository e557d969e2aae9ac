//! directions at a point -> the spec's diffuse and specular terms (1.2.3, "Illustration")

use glam::Vec3;

use crate::math::power::power;
use crate::math::vector::{mirror, unit};
use crate::tables::BLINN;

/// `[cos(theta), cos^k(alpha)]`, each at least 0.
///
/// `n`: normal, `l`: to the light, `v`: to the eye; all of length one, `n.l > 0`, `n.v >= 0`. Alpha is the angle
/// between the reflected light and the eye, or with [`BLINN`] between the half vector and the normal.
#[must_use]
pub fn phong(n: Vec3, l: Vec3, v: Vec3, exponent: f32, specular: u32) -> [f32; 2] {
    let cosine = if specular == BLINN { unit(l + v).dot(n) } else { mirror(l, n).dot(v) };
    [n.dot(l).max(0.0), power(cosine.max(0.0), exponent)]
}
