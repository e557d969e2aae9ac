//! three numbers -> four lanes, and lanes in another order

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4};
use glam::Vec3;

/// A vector with a one in the last lane, which is nobody's. What it meets there may be a number too small to be normal,
/// and a processor may take a hundred cycles for a product with one; less a one it is normal.
#[inline(always)]
#[must_use]
pub(super) fn four<S: Simd>(simd: S, v: Vec3) -> f32x4<S> {
    f32x4::simd_from(simd, [v.x, v.y, v.z, 1.0])
}

/// The bytes of four lanes, each taken from the lane that is named.
#[must_use]
pub(super) const fn from_lanes(lanes: [u8; 4]) -> [u8; 16] {
    let mut bytes = [0; 16];
    let mut i = 0;
    while i < 16 {
        bytes[i] = lanes[i / 4] * 4 + (i % 4) as u8;
        i += 1;
    }
    bytes
}
