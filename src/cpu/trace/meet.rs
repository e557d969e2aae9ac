//! a ray and a primitive -> the distance to where they meet, in lengths of the direction, or FAR

use glam::Vec3;

use crate::tables::{FAR, Plane, Sphere, Triangle};

/// A ray in world space.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Which way it goes; of any length but zero.
    pub direction: Vec3,
    /// The primitive that the ray leaves, or [`NONE`](crate::tables::NONE).
    pub leaves: u32,
}

fn ahead(t: f32) -> f32 {
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

/// The ray in a frame in which it runs along the third axis from zero.
#[derive(Debug, Clone, Copy)]
pub struct Sheared {
    axis: u32,
    shear: Vec3,
}

fn turned(v: Vec3, axis: u32) -> Vec3 {
    match axis {
        0 => Vec3::new(v.y, v.z, v.x),
        1 => Vec3::new(v.z, v.x, v.y),
        _ => v,
    }
}

/// What of [`meet_triangle`] hangs on the ray alone.
#[must_use]
pub fn shear_of(direction: Vec3) -> Sheared {
    let size = direction.abs();
    let axis = if size.x > size.y && size.x > size.z {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    };
    let d = turned(direction, axis);
    Sheared { axis, shear: Vec3::new(d.x / d.z, d.y / d.z, 1.0 / d.z) }
}

/// The spec's inside test (2.3) on edge functions that neighbors share to the bit, so that no ray slips between
/// them: Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
#[must_use]
pub fn meet_triangle(ray: Ray, triangle: &Triangle, sheared: Sheared) -> f32 {
    let a = turned(triangle.a - ray.origin, sheared.axis);
    let b = turned(triangle.b - ray.origin, sheared.axis);
    let c = turned(triangle.c - ray.origin, sheared.axis);
    let ax = a.x - sheared.shear.x * a.z;
    let ay = a.y - sheared.shear.y * a.z;
    let bx = b.x - sheared.shear.x * b.z;
    let by = b.y - sheared.shear.y * b.z;
    let cx = c.x - sheared.shear.x * c.z;
    let cy = c.y - sheared.shear.y * c.z;
    let u = cx * by - cy * bx;
    let v = ax * cy - ay * cx;
    let w = bx * ay - by * ax;
    let area = u + v + w;
    if (u.min(v.min(w)) < 0.0 && u.max(v.max(w)) > 0.0) || area == 0.0 {
        return FAR;
    }
    let scaled = u * a.z + v * b.z + w * c.z;
    ahead(scaled * sheared.shear.z / area)
}
