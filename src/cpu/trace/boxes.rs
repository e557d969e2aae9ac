//! a ray and a node -> which of the node's children it may meet up to t, in the order in which they are to be asked

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, i32x8, u32x8};

use crate::cpu::trace::aim::{Aim, Ray};
use crate::tables::Node;

/// Where the ray is on one axis: at `near + step * byte` it crosses a near side, at `far + step * byte` a far one.
#[derive(Debug, Clone, Copy)]
struct Axis {
    step: f32,
    near: f32,
    far: f32,
}

#[inline(always)]
fn axis_of(exponent: u32, corner: f32, inverse: f32, slack: f32) -> Axis {
    let at = corner * inverse;
    Axis { step: f32::from_bits((exponent & 255) << 23) * inverse, near: at - slack, far: at + slack }
}

/// A byte for each child.
#[inline(always)]
fn bytes<S: Simd>(simd: S, words: [u32; 2]) -> i32x8<S> {
    i32x8::simd_from(simd, bytemuck::cast::<_, [u8; 8]>(words).map(i32::from))
}

/// Where the ray crosses the near sides, and the far ones.
#[inline(always)]
fn sides<S: Simd>(simd: S, axis: Axis, back: bool, low: [u32; 2], high: [u32; 2]) -> (f32x8<S>, f32x8<S>) {
    let (near, far) = if back { (high, low) } else { (low, high) };
    let at = |q, from| f32x8::float_from(bytes(simd, q)) * axis.step + from;
    (at(near, axis.near), at(far, axis.far))
}

/// Two ranks of bits: a node's child at 24 and its place, a leaf's primitives at their numbers.
#[inline(always)]
fn bits_of<S: Simd>(simd: S, kinds: [u32; 2], octant: u32) -> u32x8<S> {
    let kinds: u32x8<S> = bytes(simd, kinds).bitcast();
    let number = kinds & 31;
    let place = number.simd_ge(24).select(number ^ octant, number);
    (kinds >> 5) << place
}

/// Twin of the kernel's, for all eight children at once.
#[inline(always)]
#[must_use]
pub fn boxes_met<S: Simd>(simd: S, node: &Node, ray: Ray, aim: &Aim, t: f32) -> u32 {
    let corner = node.corner - ray.origin;
    let x = axis_of(node.steps, corner.x, aim.inverse.x, aim.slack.x);
    let y = axis_of(node.steps >> 8, corner.y, aim.inverse.y, aim.slack.y);
    let z = axis_of(node.steps >> 16, corner.z, aim.inverse.z, aim.slack.z);
    let x = sides(simd, x, aim.inverse.x < 0.0, node.low_x, node.high_x);
    let y = sides(simd, y, aim.inverse.y < 0.0, node.low_y, node.high_y);
    let z = sides(simd, z, aim.inverse.z < 0.0, node.low_z, node.high_z);
    let enter = x.0.max(y.0).max(z.0.max(f32x8::splat(simd, 0.0)));
    let leave = x.1.min(y.1).min(z.1.min(f32x8::splat(simd, t)));
    let met = enter.simd_le(leave).select(bits_of(simd, node.kinds, aim.octant), u32x8::splat(simd, 0));
    let [a, b, c, d, e, f, g, h] = met.to_array();
    ((a | b) | (c | d)) | ((e | f) | (g | h))
}
