//! a ray and a node -> which of the node's children it may meet up to t, in the order in which they are to be asked

use crate::cpu::trace::aim::{Aim, Ray};
use crate::tables::Node;

#[inline]
fn bytes(words: [u32; 2]) -> [u8; 8] {
    bytemuck::cast(words)
}

/// Where the ray is on one axis: at `near + step * byte` it crosses a near side, at `far + step * byte` a far one.
#[derive(Debug, Clone, Copy)]
struct Axis {
    step: f32,
    near: f32,
    far: f32,
}

#[inline]
fn axis_of(exponent: u8, corner: f32, inverse: f32, slack: f32) -> Axis {
    let at = corner * inverse;
    Axis { step: f32::from_bits(u32::from(exponent) << 23) * inverse, near: at - slack, far: at + slack }
}

/// Two ranks of bits: a node's child at 24 and its place, a leaf's primitives at their numbers.
#[inline]
fn bits_of(kind: u8, octant: u32) -> u32 {
    let kind = u32::from(kind);
    let number = kind & 31;
    let place = number ^ if number >= 24 { octant } else { 0 };
    (kind >> 5) << place
}

/// Twin of the kernel's; eight children at a time, for which compilers have registers.
#[inline]
#[must_use]
pub fn boxes_met(node: &Node, ray: Ray, aim: &Aim, t: f32) -> u32 {
    let [ex, ey, ez, _] = node.steps.to_le_bytes();
    let corner = node.corner - ray.origin;
    let sides = |axis: Axis, back: bool, low: [u32; 2], high: [u32; 2]| {
        let (near, far) = if back { (bytes(high), bytes(low)) } else { (bytes(low), bytes(high)) };
        (near.map(|q| f32::from(q) * axis.step + axis.near), far.map(|q| f32::from(q) * axis.step + axis.far))
    };
    let x = axis_of(ex, corner.x, aim.inverse.x, aim.slack.x);
    let y = axis_of(ey, corner.y, aim.inverse.y, aim.slack.y);
    let z = axis_of(ez, corner.z, aim.inverse.z, aim.slack.z);
    let (enter_x, leave_x) = sides(x, aim.inverse.x < 0.0, node.low_x, node.high_x);
    let (enter_y, leave_y) = sides(y, aim.inverse.y < 0.0, node.low_y, node.high_y);
    let (enter_z, leave_z) = sides(z, aim.inverse.z < 0.0, node.low_z, node.high_z);
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let smaller = |a: f32, b: f32| if a < b { a } else { b };
    let mut met = 0;
    for (i, kind) in bytes(node.kinds).into_iter().enumerate() {
        let enter = larger(larger(enter_x[i], enter_y[i]), larger(enter_z[i], 0.0));
        let leave = smaller(smaller(leave_x[i], leave_y[i]), smaller(leave_z[i], t));
        met |= if enter <= leave { bits_of(kind, aim.octant) } else { 0 };
    }
    met
}
