//! a ray and a node -> which of the node's children and primitives it may meet up to t

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, i32x8, u8x16, u32x4, u32x8};

use crate::cpu::four::{four, from_lanes};
use crate::cpu::trace::seat::Seat;
use crate::tables::Node;

/// Eight bytes as numbers. Of an array of bytes the compiler makes shifts of twice the width.
#[inline(always)]
fn widened<S: Simd>(simd: S, [low, high]: [u32; 2]) -> u32x8<S> {
    let bytes: u8x16<S> = u32x4::simd_from(simd, [low, high, 0, 0]).bitcast();
    let (low, high) = simd.widen_u16x8(simd.widen_u8x16(bytes).0);
    simd.combine_u32x4(low, high)
}

/// A ray as boxes ask for it: at `corner - origin` times `inverse`, less or more `slack`, it crosses a corner's planes.
#[derive(Debug, Clone, Copy)]
pub struct Gaze<S: Simd> {
    origin: f32x4<S>,
    inverse: f32x4<S>,
    slack: f32x4<S>,
    /// Which rows of a node hold the near sides; the far ones are in the other row of an axis.
    near: [usize; 3],
    octant: usize,
}

impl<S: Simd> Gaze<S> {
    /// Of the ray of a seat.
    #[inline(always)]
    #[must_use]
    pub fn new(simd: S, Seat { ray, aim, .. }: &Seat) -> Self {
        let near = |axis: usize| if aim.inverse[axis] < 0.0 { 7 + axis } else { 4 + axis };
        let near = [near(0), near(1), near(2)];
        Self {
            origin: four(simd, ray.origin),
            inverse: four(simd, aim.inverse),
            slack: four(simd, aim.slack),
            near,
            octant: aim.octant as usize % 8,
        }
    }
}

/// A node's words: rows 4 to 6 are the low sides, 7 to 9 the high ones.
type Rows = [[u32; 2]; 10];

/// A node's exponents, one of each axis, behind its corner.
const EXPONENTS: [u8; 16] = {
    let mut bytes = [u8::MAX; 16];
    [bytes[0], bytes[4], bytes[8]] = [12, 13, 14];
    bytes
};

/// How long a step is on each axis, and where the ray crosses the near and the far sides that lie at the corner.
#[inline(always)]
fn at_corner<S: Simd>(simd: S, node: &Node, gaze: &Gaze<S>) -> [f32x4<S>; 3] {
    let rows: &[[f32; 4]; 5] = bytemuck::cast_ref(node);
    let corner = f32x4::simd_from(simd, rows[0]);
    let bytes: u8x16<S> = corner.bitcast();
    let exponents: u32x4<S> = bytes.swizzle_dyn_precise(u8x16::simd_from(simd, EXPONENTS)).bitcast();
    let steps: f32x4<S> = (exponents << 23).bitcast();
    let at = (corner - gaze.origin) * gaze.inverse;
    [steps * gaze.inverse, at - gaze.slack, at + gaze.slack]
}

/// One of four lanes in all eight.
#[inline(always)]
fn splat<S: Simd>(simd: S, v: f32x4<S>, lane: usize) -> f32x8<S> {
    const LANES: [[u8; 16]; 3] = [from_lanes([0; 4]), from_lanes([1; 4]), from_lanes([2; 4])];
    let v = v.swizzle_dyn_within_blocks(u8x16::simd_from(simd, LANES[lane]));
    simd.combine_f32x4(v, v)
}

/// Where the ray crosses the near and the far sides of the children's boxes on one axis.
#[inline(always)]
fn sides<S: Simd>(simd: S, rows: &Rows, near: usize, at_corner: [f32x4<S>; 3], axis: usize) -> [f32x8<S>; 2] {
    let step = splat(simd, at_corner[0], axis);
    let far = 11 + 2 * axis - near;
    [
        crossed(simd, rows[near], step, splat(simd, at_corner[1], axis)),
        crossed(simd, rows[far], step, splat(simd, at_corner[2], axis)),
    ]
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

/// Each set of places as rays of an octant have it, at `place ^ octant`.
const TURNED: [[u8; 256]; 8] = {
    let mut all = [[0; 256]; 8];
    let mut i = 0;
    while i < 8 * 256 * 8 {
        let (octant, set, place) = (i >> 11, i >> 3 & 255, i & 7);
        all[octant][set] |= (set as u8 >> place & 1) << (place ^ octant);
        i += 1;
    }
    all
};

/// Twin of the kernel's, for all eight children at once; those that are nodes, and the primitives of the others.
#[inline(always)]
#[must_use]
pub fn boxes_met<S: Simd>(simd: S, node: &Node, gaze: &Gaze<S>, t: f32) -> [u32; 2] {
    let at_corner = at_corner(simd, node, gaze);
    let rows: &Rows = bytemuck::cast_ref(node);
    let x = sides(simd, rows, gaze.near[0], at_corner, 0);
    let y = sides(simd, rows, gaze.near[1], at_corner, 1);
    let z = sides(simd, rows, gaze.near[2], at_corner, 2);
    let enter = x[0].max(y[0]).max(z[0].max(f32x8::splat(simd, 0.0)));
    let leave = x[1].min(y[1]).min(z[1].min(f32x8::splat(simd, t)));
    let met = enter.simd_le(leave).to_bitmask() as u32;
    let inner = u32::from(TURNED[gaze.octant][(met & node.inner) as usize % 256]);
    [inner, MAY_HOLD[met as usize % 256] & node.held]
}
