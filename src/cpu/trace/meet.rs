//! a ray and a primitive -> the distance to where they meet, in lengths of the direction, or FAR

#![expect(clippy::inline_always, reason = "see `aim`")]

use glam::Vec3;

use crate::cpu::trace::aim::{Aim, Ray, turned};
use crate::tables::{FAR, Leaf, Plane, Sphere};

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

/// Edge functions that neighbors share to the bit, so that no ray slips between them: Woop, Benthin and Wald,
/// "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. Of corners seen from the ray, in the frame of its aim.
#[inline(always)]
#[must_use]
pub fn edges([a, b, c]: [Vec3; 3], aim: &Aim) -> [f32; 3] {
    let ax = a.x - aim.shear.x * a.z;
    let ay = a.y - aim.shear.y * a.z;
    let bx = b.x - aim.shear.x * b.z;
    let by = b.y - aim.shear.y * b.z;
    let cx = c.x - aim.shear.x * c.z;
    let cy = c.y - aim.shear.y * c.z;
    [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax]
}

/// As processors have it: `b`, if one of them is no number.
#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// See [`lesser`].
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn least([x, y, z]: [f32; 3]) -> f32 {
    lesser(x, lesser(y, z))
}

#[inline(always)]
fn most([x, y, z]: [f32; 3]) -> f32 {
    larger(x, larger(y, z))
}

/// The spec's inside test (2.3).
#[inline(always)]
#[must_use]
pub fn meet_triangle(ray: Ray, triangle: &Leaf, aim: &Aim) -> f32 {
    let from = [triangle.a, triangle.b, triangle.c].map(|corner| corner - ray.origin);
    let [a, b, c] = from.map(|corner| turned(corner, aim.axis));
    let parts @ [u, v, w] = edges([a, b, c], aim);
    let area = u + v + w;
    if (least(parts) < 0.0 && most(parts) > 0.0) || area == 0.0 {
        return FAR;
    }
    let scaled = u * a.z + v * b.z + w * c.z;
    // Seen from its edge or from very far, a triangle of f32 is met where it is not: never outside of its box, so
    // that no node hides what a test would find.
    let low = from[0].min(from[1].min(from[2]));
    let high = from[0].max(from[1].max(from[2]));
    let back = aim.inverse.cmplt(Vec3::ZERO);
    let near = Vec3::select(back, high, low) * aim.inverse - aim.own;
    let far = Vec3::select(back, low, high) * aim.inverse + aim.own;
    let enter = most(near.to_array());
    let leave = least(far.to_array());
    if enter > leave {
        return FAR;
    }
    ahead(larger(enter, lesser(leave, scaled * aim.shear.z / area)))
}
