//! a ray and a node -> which of the node's children and primitives it may meet up to t

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, i32x8, u8x16, u32x4, u32x8};
use glam::Vec3;

use crate::cpu::trace::aim::{Aim, Ray};
use crate::tables::Node;

/// Eight bytes as numbers. Of an array of bytes the compiler makes shifts of twice the width.
#[inline(always)]
fn widened<S: Simd>(simd: S, [low, high]: [u32; 2]) -> u32x8<S> {
    let bytes: u8x16<S> = u32x4::simd_from(simd, [low, high, 0, 0]).bitcast();
    let (low, high) = simd.widen_u16x8(simd.widen_u8x16(bytes).0);
    simd.combine_u32x4(low, high)
}

#[inline(always)]
fn four<S: Simd>(simd: S, v: Vec3) -> f32x4<S> {
    f32x4::simd_from(simd, [v.x, v.y, v.z, 0.0])
}

/// A ray as boxes ask for it: at `corner - origin` times `inverse`, less or more `slack`, it crosses a corner's planes.
#[derive(Debug, Clone, Copy)]
pub struct Gaze<S: Simd> {
    origin: f32x4<S>,
    inverse: f32x4<S>,
    slack: f32x4<S>,
    /// Which rows of a node hold the near sides, and which the far ones.
    near: [usize; 3],
    far: [usize; 3],
}

/// A node's words: rows 4 to 6 are the low sides, 7 to 9 the high ones.
type Rows = [[u32; 2]; 10];

/// The rows of one axis.
#[inline(always)]
fn rows(axis: usize, inverse: f32) -> (usize, usize) {
    if inverse < 0.0 { (7 + axis, 4 + axis) } else { (4 + axis, 7 + axis) }
}

impl<S: Simd> Gaze<S> {
    /// Of a ray in world space, or in an instance's.
    #[inline(always)]
    #[must_use]
    pub fn new(simd: S, ray: Ray, aim: &Aim) -> Self {
        let (x, y, z) = (rows(0, aim.inverse.x), rows(1, aim.inverse.y), rows(2, aim.inverse.z));
        let (origin, inverse, slack) = (four(simd, ray.origin), four(simd, aim.inverse), four(simd, aim.slack));
        Self { origin, inverse, slack, near: [x.0, y.0, z.0], far: [x.1, y.1, z.1] }
    }
}

/// Where the ray crosses one side of each child's box.
#[inline(always)]
fn crossed<S: Simd>(simd: S, bytes: [u32; 2], step: f32, from: f32) -> f32x8<S> {
    let bytes: i32x8<S> = widened(simd, bytes).bitcast();
    f32x8::float_from(bytes) * step + from
}

/// What each set of children may have: three bits for a child's primitives, and one, from bit 24 up, for itself.
const MAY_HAVE: [u32; 256] = {
    let mut all = [0; 256];
    let mut i = 0;
    while i < 256 * 8 {
        let (set, child) = (i >> 3, i & 7);
        if set >> child & 1 == 1 {
            all[set] |= 7 << (3 * child) | 1 << (24 + child);
        }
        i += 1;
    }
    all
};

/// Twin of the kernel's, for all eight children at once.
#[inline(always)]
#[must_use]
pub fn boxes_met<S: Simd>(simd: S, node: &Node, gaze: &Gaze<S>, t: f32) -> u32 {
    let (exponents, _) = (widened(simd, [node.steps, 0]) << 23).split();
    let step: f32x4<S> = exponents.bitcast();
    let [x, y, z, _] = (step * gaze.inverse).to_array();
    let at = (four(simd, node.corner) - gaze.origin) * gaze.inverse;
    let [near, far] = [(at - gaze.slack).to_array(), (at + gaze.slack).to_array()];
    let rows: &Rows = bytemuck::cast_ref(node);
    let enter_x = crossed(simd, rows[gaze.near[0]], x, near[0]);
    let enter_y = crossed(simd, rows[gaze.near[1]], y, near[1]);
    let enter_z = crossed(simd, rows[gaze.near[2]], z, near[2]);
    let leave_x = crossed(simd, rows[gaze.far[0]], x, far[0]);
    let leave_y = crossed(simd, rows[gaze.far[1]], y, far[1]);
    let leave_z = crossed(simd, rows[gaze.far[2]], z, far[2]);
    let enter = enter_x.max(enter_y).max(enter_z.max(f32x8::splat(simd, 0.0)));
    let leave = leave_x.min(leave_y).min(leave_z.min(f32x8::splat(simd, t)));
    MAY_HAVE[enter.simd_le(leave).to_bitmask() as usize % 256] & (node.inner | node.held)
}
