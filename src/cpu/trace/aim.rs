//! a ray -> what of a walk hangs on the ray alone

#![expect(
    clippy::inline_always,
    reason = "walks in lanes are compiled for a SIMD level, and what they call for none costs a sixth of their time"
)]

use glam::Vec3;

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
    /// Which of the axes the ray runs along most; with `shear`, a frame in which it runs along the third from zero.
    pub axis: u32,
    /// See `axis`.
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

/// The axes in turn, so that the third is number `axis`; cyclic, so that no handedness changes.
#[inline(always)]
#[must_use]
pub fn turned(v: Vec3, axis: u32) -> Vec3 {
    match axis {
        0 => Vec3::new(v.y, v.z, v.x),
        1 => Vec3::new(v.z, v.x, v.y),
        _ => v,
    }
}

/// No part closer to zero than this.
#[inline(always)]
fn apart(x: f32, least: f32) -> f32 {
    if x.abs() >= least {
        x
    } else if x < 0.0 {
        -least
    } else {
        least
    }
}

/// With u = 2^-24 and `reach` the longest way from the ray's origin to a corner of the tree: the corners of a
/// triangle, seen from the ray, are off by 5 u reach at most; the sides of a box that is decoded from bytes, seen
/// from the ray, by 9 u reach. So a ray that meets a triangle meets its box, grown by 16 u reach on each side, and
/// one that meets this meets the boxes of all nodes above, grown by 64 u reach. After Woop, Benthin and Wald 2013, 4.
#[inline(always)]
#[must_use]
pub fn aim_of(ray: Ray, low: Vec3, high: Vec3) -> Aim {
    let size = ray.direction.abs();
    let axis = if size.x > size.y && size.x > size.z {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    };
    let d = turned(ray.direction, axis);
    let shear = Vec3::new(d.x / d.z, d.y / d.z, 1.0 / d.z);
    let least = d.z.abs() * 9.313226e-10;
    let inverse = 1.0 / ray.direction.map(|x| apart(x, least));
    let away = (low - ray.origin).abs().max((high - ray.origin).abs());
    let reach = away.x.max(away.y.max(away.z));
    let per_side = inverse.abs() * reach;
    let bit = |x: f32, bit: u32| if x < 0.0 { 0 } else { bit };
    let octant = bit(ray.direction.x, 4) | bit(ray.direction.y, 2) | bit(ray.direction.z, 1);
    Aim { axis, shear, inverse, own: per_side * 9.536743e-7, slack: per_side * 3.8146973e-6, octant }
}
