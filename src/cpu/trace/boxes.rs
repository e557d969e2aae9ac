//! a ray and a node -> which of the node's children and primitives it may meet up to t

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, i32x8, u8x16, u32x4, u32x8};
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

/// A ray as boxes ask for it, in all lanes: at `corner - origin` times `inverse`, less or more `slack`, it crosses a
/// corner's planes.
#[derive(Debug, Clone, Copy)]
pub struct Gaze<S: Simd> {
    origin: [f32x8<S>; 3],
    inverse: [f32x8<S>; 3],
    slack: [f32x8<S>; 3],
    /// Which rows of a node hold the near sides; the far ones are in the other row of an axis.
    near: [usize; 3],
}

/// A node's words: rows 4 to 6 are the low sides, 7 to 9 the high ones.
type Rows = [[u32; 2]; 10];

#[inline(always)]
fn splat<S: Simd>(simd: S, v: Vec3) -> [f32x8<S>; 3] {
    [f32x8::splat(simd, v.x), f32x8::splat(simd, v.y), f32x8::splat(simd, v.z)]
}

impl<S: Simd> Gaze<S> {
    /// Of a ray in world space, or in an instance's.
    #[inline(always)]
    #[must_use]
    pub fn new(simd: S, ray: Ray, aim: &Aim) -> Self {
        let near = |axis: usize| if aim.inverse[axis] < 0.0 { 7 + axis } else { 4 + axis };
        let near = [near(0), near(1), near(2)];
        Self {
            origin: splat(simd, ray.origin),
            inverse: splat(simd, aim.inverse),
            slack: splat(simd, aim.slack),
            near,
        }
    }
}

/// Where the ray crosses the near and the far sides of the children's boxes on one axis.
#[inline(always)]
fn sides<S: Simd>(simd: S, node: &Node, gaze: &Gaze<S>, axis: usize) -> [f32x8<S>; 2] {
    let rows: &Rows = bytemuck::cast_ref(node);
    // The axis' byte of the four, where a number has its exponent.
    let exponent = (u32x8::splat(simd, node.steps) << (23 - 8 * axis as u32)) & 0x7f80_0000;
    let step: f32x8<S> = exponent.bitcast();
    let step = step * gaze.inverse[axis];
    let at = (f32x8::splat(simd, node.corner[axis]) - gaze.origin[axis]) * gaze.inverse[axis];
    let near = gaze.near[axis];
    let [near, far] = [rows[near], rows[11 + 2 * axis - near]];
    let near = crossed(simd, near, step, at - gaze.slack[axis]);
    let far = crossed(simd, far, step, at + gaze.slack[axis]);
    [near, far]
}

/// Where the ray crosses one side of each child's box.
#[inline(always)]
fn crossed<S: Simd>(simd: S, bytes: [u32; 2], step: f32x8<S>, from: f32x8<S>) -> f32x8<S> {
    let bytes: i32x8<S> = widened(simd, bytes).bitcast();
    f32x8::float_from(bytes) * step + from
}

/// What each set of children may hold: three bits for a child's primitives.
const MAY_HOLD: [u32; 256] = {
    let mut all = [0; 256];
    let mut i = 0;
    while i < 256 * 8 {
        let (set, child) = (i >> 3, i & 7);
        if set >> child & 1 == 1 {
            all[set] |= 7 << (3 * child);
        }
        i += 1;
    }
    all
};

/// Twin of the kernel's, for all eight children at once; those that are nodes, and the primitives of the others.
///
/// The nodes do not wait for a table: the next one to ask hangs on them.
#[inline(always)]
#[must_use]
pub fn boxes_met<S: Simd>(simd: S, node: &Node, gaze: &Gaze<S>, t: f32) -> [u32; 2] {
    let x = sides(simd, node, gaze, 0);
    let y = sides(simd, node, gaze, 1);
    let z = sides(simd, node, gaze, 2);
    let enter = x[0].max(y[0]).max(z[0].max(f32x8::splat(simd, 0.0)));
    let leave = x[1].min(y[1]).min(z[1].min(f32x8::splat(simd, t)));
    let met = enter.simd_le(leave).to_bitmask() as u32;
    [met << 24 & node.inner, MAY_HOLD[met as usize % 256] & node.held]
}
