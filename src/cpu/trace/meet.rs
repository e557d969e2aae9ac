//! a ray and a sphere or a plane -> the distance to where they meet, in lengths of the direction, or FAR

#![expect(clippy::inline_always, reason = "see `aim`")]

use crate::cpu::trace::aim::Ray;
use crate::tables::{FAR, Plane, Sphere};

/// Nothing is met behind a ray.
#[inline(always)]
#[must_use]
pub fn ahead(t: f32) -> f32 {
    if t > 0.0 { t } else { FAR }
}

/// Eq. 2.1 - 2.3, in the stable form of Haines et al., "Precision Improvements for Ray/Sphere Intersection",
/// Ray Tracing Gems, ch. 7.
///
/// The spec prints the root of Eq. 2.3 as `(d.e)^2 + e.e - R^2`; it should read `(d.e)^2 - |d|^2 (e.e - R^2)`.
/// `leaving`: the ray starts on this sphere.
#[must_use]
pub fn meet_sphere(ray: Ray, sphere: &Sphere, per_length_squared: f32, leaving: bool) -> f32 {
    let e = ray.origin - sphere.center;
    let b = ray.direction.dot(e);
    if leaving {
        // From a point of the sphere one root is zero, and only the chord's other end is left.
        return ahead(-2.0 * b * per_length_squared);
    }
    let r2 = sphere.radius * sphere.radius;
    let nearest = e - ray.direction * (b * per_length_squared);
    let spare = r2 - nearest.dot(nearest);
    if spare < 0.0 {
        return FAR;
    }
    let half_chord = (spare / per_length_squared).sqrt();
    let q = if b > 0.0 { -half_chord - b } else { half_chord - b };
    if q == 0.0 {
        return FAR;
    }
    let near = (e.dot(e) - r2) / q;
    if near > 0.0 { near } else { ahead(q * per_length_squared) }
}

/// Eq. 2.4 and 2.5 (the first with a dot product where the spec prints a cross).
#[must_use]
pub fn meet_plane(ray: Ray, plane: &Plane) -> f32 {
    let across = plane.normal.dot(ray.direction);
    if across == 0.0 {
        return FAR;
    }
    ahead(plane.normal.dot(plane.point - ray.origin) / across)
}
