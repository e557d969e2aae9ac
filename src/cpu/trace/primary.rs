//! a pixel and a sample -> the primary ray's direction

use glam::{Vec2, Vec3};

use crate::math::fence::fence;
use crate::math::random::unit_float;
use crate::math::vector::unit;
use crate::tables::{FAR, NONE, Path, SEEK, View};

/// Where in its pixel a sample lies, in [0, 1)^2 from the lower left corner.
///
/// On the spec's n x n grid (2.2, figure 2.2), or at a point of the R2 sequence (Roberts, 2018): multiples of
/// 1/p and 1/p^2, p = 1.3247..., as fractions of 2^32.
#[must_use]
pub fn place(view: &View, sample: u32) -> Vec2 {
    if view.grid > 0 {
        return Vec2::new((sample % view.grid) as f32, (sample / view.grid) as f32) / view.grid as f32;
    }
    Vec2::new(unit_float(sample.wrapping_mul(3_242_174_889)), unit_float(sample.wrapping_mul(2_447_445_414)))
}

/// The direction through a sample, of length one, in world space: spec 2.2, with the film plane at distance one
/// and rows counted from the top.
#[must_use]
pub fn primary(view: &View, pixel: u32, sample: u32) -> Vec3 {
    let at = place(view, sample);
    let x = ((pixel % view.width) as f32 + at.x) / view.width as f32 - 0.5;
    let y = ((view.height - 1 - pixel / view.width) as f32 + at.y) / view.height as f32 - 0.5;
    unit(fence(view.right * x + view.up * y) - view.back)
}

/// A new tree: nothing is met yet and nothing waits.
#[must_use]
pub fn seed(view: &View, sample: u32, direction: Vec3) -> Path {
    Path {
        origin: view.eye,
        leaves: NONE,
        direction,
        t: FAR,
        weight: Vec3::ONE,
        depth: 1,
        radiance: Vec3::ZERO,
        inside: view.inside,
        state: SEEK,
        sample,
        hit: NONE,
        next: 0,
        light: 0,
        waiting: 0,
        rays: 0,
        seen: NONE,
    }
}
