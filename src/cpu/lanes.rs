//! Eight rays at once: the same operations in the same order as one by one, and so the same bits.
//!
//! Each function says what it does eight times; what it means, and why, is written at its twin for one ray.

#![expect(
    clippy::inline_always,
    reason = "SIMD levels are chosen outside; what is not inlined is compiled for none"
)]

pub(super) mod few;
pub(super) mod follow;
mod herd;
mod meet;
mod pack;
mod shade;
mod walk;
mod wide;

pub use walk::Walker;
pub use wide::Wides;

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};
use glam::Vec3;

/// Rays side by side.
pub(super) const LANES: usize = 8;

/// Eight vectors.
#[derive(Debug, Clone, Copy)]
struct Vec3s<S: Simd> {
    x: f32x8<S>,
    y: f32x8<S>,
    z: f32x8<S>,
}

impl<S: Simd> Vec3s<S> {
    #[inline(always)]
    fn splat(simd: S, v: Vec3) -> Self {
        Self { x: f32x8::splat(simd, v.x), y: f32x8::splat(simd, v.y), z: f32x8::splat(simd, v.z) }
    }

    #[inline(always)]
    fn each(self, b: Self, f: impl Fn(f32x8<S>, f32x8<S>) -> f32x8<S>) -> Self {
        Self { x: f(self.x, b.x), y: f(self.y, b.y), z: f(self.z, b.z) }
    }

    #[inline(always)]
    fn plus(self, b: Self) -> Self {
        self.each(b, |a, b| a + b)
    }

    #[inline(always)]
    fn minus(self, b: Self) -> Self {
        self.each(b, |a, b| a - b)
    }

    #[inline(always)]
    fn times(self, b: Self) -> Self {
        self.each(b, |a, b| a * b)
    }

    #[inline(always)]
    fn scaled(self, k: f32x8<S>) -> Self {
        Self { x: self.x * k, y: self.y * k, z: self.z * k }
    }

    #[inline(always)]
    fn negated(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }

    #[inline(always)]
    fn dot(self, b: Self) -> f32x8<S> {
        self.x * b.x + self.y * b.y + self.z * b.z
    }

    #[inline(always)]
    fn unit(self) -> Self {
        let length = self.dot(self).sqrt();
        Self { x: self.x / length, y: self.y / length, z: self.z / length }
    }

    /// Twin of [`mirror`](crate::math::vector::mirror).
    #[inline(always)]
    fn mirrored(self, n: Self) -> Self {
        n.scaled(self.dot(n) * 2.0).minus(self).unit()
    }

    #[inline(always)]
    fn largest(self) -> f32x8<S> {
        let yz = self.y.simd_gt(self.z).select(self.y, self.z);
        self.x.simd_gt(yz).select(self.x, yz)
    }

    #[inline(always)]
    fn choose(mask: mask32x8<S>, a: Self, b: Self) -> Self {
        a.each(b, |a, b| mask.select(a, b))
    }

    fn lane(&self, i: usize) -> Vec3 {
        Vec3::new(self.x[i], self.y[i], self.z[i])
    }

    fn set_lane(&mut self, i: usize, v: Vec3) {
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }
}
