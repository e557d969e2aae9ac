//! eight rays and a primitive -> the distances to where they meet: eight times `cpu/trace/meet.rs`

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8, u32x8};

use super::Vec3s;
use crate::tables::{FAR, NONE, Plane, Sphere, Tables};

/// Eight rays in world space.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rays<S: Simd> {
    pub(super) origin: Vec3s<S>,
    pub(super) direction: Vec3s<S>,
    pub(super) leaves: u32x8<S>,
}

#[inline(always)]
fn ahead<S: Simd>(simd: S, t: f32x8<S>) -> f32x8<S> {
    t.simd_gt(0.0).select(t, f32x8::splat(simd, FAR))
}

#[inline(always)]
fn meet_sphere<S: Simd>(
    simd: S,
    rays: Rays<S>,
    sphere: &Sphere,
    per_length_squared: f32x8<S>,
    leaving: mask32x8<S>,
) -> f32x8<S> {
    let far = f32x8::splat(simd, FAR);
    let e = rays.origin.minus(Vec3s::splat(simd, sphere.center));
    let b = rays.direction.dot(e);
    let other_end = ahead(simd, b * -2.0 * per_length_squared);
    let r2 = f32x8::splat(simd, sphere.radius * sphere.radius);
    let nearest = e.minus(rays.direction.scaled(b * per_length_squared));
    let spare = r2 - nearest.dot(nearest);
    // Most rays miss a sphere, and all eight of them together.
    let missed = spare.simd_lt(0.0);
    if missed.all_true() {
        return leaving.select(other_end, far);
    }
    let half_chord = (spare / per_length_squared).sqrt();
    let q = b.simd_gt(0.0).select(-half_chord - b, half_chord - b);
    let near = (e.dot(e) - r2) / q;
    let t = near.simd_gt(0.0).select(near, ahead(simd, q * per_length_squared));
    let t = (missed | q.simd_eq(0.0)).select(far, t);
    leaving.select(other_end, t)
}

#[inline(always)]
fn meet_plane<S: Simd>(simd: S, rays: Rays<S>, plane: &Plane) -> f32x8<S> {
    let normal = Vec3s::splat(simd, plane.normal);
    let across = normal.dot(rays.direction);
    let t = normal.dot(Vec3s::splat(simd, plane.point).minus(rays.origin)) / across;
    across.simd_eq(0.0).select(f32x8::splat(simd, FAR), ahead(simd, t))
}

/// Corners of eight triangles seen from a ray, or of one seen from eight, and what hangs on the ray; the axes in turn, so
/// that the ray runs along the third most.
pub(super) struct Seen<S: Simd> {
    pub(super) corners: [[f32x8<S>; 3]; 3],
    pub(super) shear: [f32x8<S>; 3],
    pub(super) inverse: [f32x8<S>; 3],
    pub(super) own: [f32x8<S>; 3],
}

impl<S: Simd> Seen<S> {
    /// Twin of [`meet_triangle`](crate::cpu::trace::triangle::meet_triangle): the distances, and which of those that are
    /// asked are met up to `most`.
    #[inline(always)]
    pub(super) fn meet(&self, asked: mask32x8<S>, most: f32x8<S>) -> (f32x8<S>, mask32x8<S>) {
        let [a, b, c] = self.corners;
        let [sx, sy, sz] = self.shear;
        let ax = a[0] - sx * a[2];
        let ay = a[1] - sy * a[2];
        let bx = b[0] - sx * b[2];
        let by = b[1] - sy * b[2];
        let cx = c[0] - sx * c[2];
        let cy = c[1] - sy * c[2];
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let area = u + (v + w);
        let below = u.min(v.min(w)).simd_lt(0.0);
        let above = u.max(v.max(w)).simd_gt(0.0);
        let inside = asked & !((below & above) | area.simd_eq(0.0));
        if !inside.any_true() {
            return (area, inside);
        }
        let scaled = u * a[2] + (v * b[2] + w * c[2]);
        let (x, y, z) = (self.sides(0), self.sides(1), self.sides(2));
        let enter = x.0.max(y.0.max(z.0));
        let leave = x.1.min(y.1.min(z.1));
        let t = enter.max(leave.min(scaled * sz / area));
        (t, inside & !enter.simd_gt(leave) & t.simd_gt(0.0) & t.simd_le(most))
    }

    /// Where a triangle's own box begins and ends on one axis.
    #[inline(always)]
    fn sides(&self, axis: usize) -> (f32x8<S>, f32x8<S>) {
        let [a, b, c] = self.corners;
        let low = a[axis].min(b[axis].min(c[axis])) * self.inverse[axis];
        let high = a[axis].max(b[axis].max(c[axis])) * self.inverse[axis];
        (low.min(high) - self.own[axis], low.max(high) + self.own[axis])
    }
}

/// What eight rays have met.
#[derive(Debug, Clone, Copy)]
pub(super) struct Founds<S: Simd> {
    pub(super) t: f32x8<S>,
    pub(super) hit: u32x8<S>,
}

/// The nearest hits.
#[inline(always)]
pub(super) fn nearest<S: Simd>(simd: S, tables: &Tables, rays: Rays<S>) -> Founds<S> {
    let mut found = Founds { t: f32x8::splat(simd, FAR), hit: u32x8::splat(simd, NONE) };
    let per_length_squared = 1.0 / rays.direction.dot(rays.direction);
    for (sphere, i) in tables.spheres.iter().zip(0_u32..) {
        let t = meet_sphere(simd, rays, sphere, per_length_squared, rays.leaves.simd_eq(i));
        let nearer = t.simd_lt(found.t);
        found.t = nearer.select(t, found.t);
        found.hit = nearer.select(u32x8::splat(simd, i), found.hit);
    }
    for (plane, i) in tables.planes.iter().zip(tables.settings.spheres..) {
        let t = meet_plane(simd, rays, plane);
        let nearer = t.simd_lt(found.t) & !rays.leaves.simd_eq(i);
        found.t = nearer.select(t, found.t);
        found.hit = nearer.select(u32x8::splat(simd, i), found.hit);
    }
    found
}

/// Which of `asked` have nothing in their way up to `reach`.
#[inline(always)]
pub(super) fn free<S: Simd>(
    simd: S,
    tables: &Tables,
    rays: Rays<S>,
    reach: f32,
    asked: mask32x8<S>,
) -> mask32x8<S> {
    let mut free = asked;
    let per_length_squared = 1.0 / rays.direction.dot(rays.direction);
    for (sphere, i) in tables.spheres.iter().zip(0_u32..) {
        let t = meet_sphere(simd, rays, sphere, per_length_squared, rays.leaves.simd_eq(i));
        free &= !t.simd_lt(reach);
    }
    for (plane, i) in tables.planes.iter().zip(tables.settings.spheres..) {
        let t = meet_plane(simd, rays, plane);
        free &= !t.simd_lt(reach) | rays.leaves.simd_eq(i);
    }
    free
}
