//! a ray -> what of a walk hangs on the ray alone

#![expect(
    clippy::inline_always,
    reason = "walks in lanes are compiled for a SIMD level, and what they call for none costs a sixth of their time"
)]

use glam::{Vec3, Vec3A};

/// A ray in world space.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Which way it goes; of any length but zero.
    pub direction: Vec3,
    /// The leaf that the ray leaves, or [`NONE`](crate::tables::NONE).
    pub leaves: u32,
}

/// A ray as triangles and boxes ask for it.
#[derive(Debug, Clone, Copy)]
pub struct Aim {
    /// The axes in turn, so that the ray runs along the third most; with `shear`, a frame in which it runs along the
    /// third from zero. In each turn no handedness changes.
    pub axes: [usize; 3],
    /// See `axes`.
    pub shear: Vec3,
    /// One over the direction, no part of which counts as zero.
    pub inverse: Vec3,
    /// How far the distances to the sides of a primitive's own box may be off.
    pub own: Vec3,
    /// How far those to the sides of a node's boxes may be off.
    pub slack: Vec3,
    /// The places of children are asked from the highest `place ^ octant` down.
    pub octant: u32,
}

/// By which axis is the third.
const TURNS: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// No part closer to zero than this.
#[inline(always)]
fn apart(v: Vec3A, least: Vec3A) -> Vec3A {
    let away = Vec3A::select(v.cmplt(Vec3A::ZERO), -least, least);
    Vec3A::select(v.abs().cmpge(least), v, away)
}

/// With u = 2^-24 and `reach` the longest way from the ray's origin to a corner of the tree: the corners of a
/// triangle, seen from the ray, are off by 5 u reach at most; the sides of a box that is decoded from bytes, seen
/// from the ray, by 9 u reach. So a ray that meets a triangle meets its box, grown by 16 u reach on each side, and
/// one that meets this meets the boxes of all nodes above, grown by 64 u reach. After Woop, Benthin and Wald 2013, 4.
#[inline(always)]
#[must_use]
pub fn aim_of(ray: Ray, low: Vec3, high: Vec3) -> Aim {
    let size = ray.direction.abs();
    // No branches: they would be guessed wrong for rays that go anywhere.
    let [to_x, to_y] = [usize::from(size.x > size.y.max(size.z)), usize::from(size.y > size.z)];
    let axes = TURNS[(1 - to_x) * (2 - to_y)];
    let [x, y, z] = axes.map(|axis| ray.direction.to_array()[axis]);
    let shear = Vec3::new(x / z, y / z, 1.0 / z);
    let least = size.max_element() * 9.313226e-10;
    let inverse = 1.0 / apart(Vec3A::from(ray.direction), Vec3A::splat(least));
    let [low, high, origin] = [low, high, ray.origin].map(Vec3A::from);
    let away = (low - origin).abs().max((high - origin).abs());
    let reach = away.x.max(away.y.max(away.z));
    let per_side = inverse.abs() * reach;
    let bit = |x: f32, bit: u32| if x < 0.0 { 0 } else { bit };
    let octant = bit(ray.direction.x, 4) | bit(ray.direction.y, 2) | bit(ray.direction.z, 1);
    Aim {
        axes,
        shear,
        inverse: inverse.into(),
        own: (per_side * 9.536743e-7).into(),
        slack: (per_side * 3.8146973e-6).into(),
        octant,
    }
}
