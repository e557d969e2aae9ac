//! a ray and a triangle -> the distance to where they meet, in lengths of the direction, or FAR
//!
//! As in the kernel, with a corner in each lane.

#![expect(clippy::inline_always, reason = "see `aim`")]

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f32x4, f64x2, u8x16};
use glam::Vec3;

use crate::cpu::four::{four, from_lanes};
use crate::cpu::trace::meet::ahead;
use crate::cpu::trace::seat::Seat;
use crate::tables::{FAR, Leaf};

/// A ray as triangles ask for it, its axes in the turn of the aim.
#[derive(Debug, Clone, Copy)]
pub struct Sight<S: Simd> {
    /// Turns the axes of a corner; in the last lane the third once more, where a leaf has a number of another kind.
    turn: u8x16<S>,
    origin: f32x4<S>,
    inverse: f32x4<S>,
    own: f32x4<S>,
    /// By how much of the third axis the first and the second are off.
    shear: [f32x4<S>; 2],
    per_depth: f32,
}

/// By which axis is the third.
const TURNS: [[u8; 16]; 3] = [from_lanes([1, 2, 0, 0]), from_lanes([2, 0, 1, 1]), from_lanes([0, 1, 2, 2])];

/// Of each corner the one after it, and the one before it.
const NEXT: [u8; 16] = from_lanes([1, 2, 0, 0]);
const LAST: [u8; 16] = from_lanes([2, 0, 1, 1]);

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    // As processors have it: `b`, if one of them is no number.
    if a > b { a } else { b }
}

/// See [`larger`].
#[inline(always)]
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

impl<S: Simd> Sight<S> {
    /// Of the ray of a seat.
    #[inline(always)]
    #[must_use]
    pub fn new(simd: S, Seat { ray, aim, .. }: &Seat) -> Self {
        let turn = u8x16::simd_from(simd, TURNS[aim.axes[2] % 3]);
        let turned = |v: Vec3| four(simd, v).swizzle_dyn_within_blocks(turn);
        Self {
            turn,
            origin: turned(ray.origin),
            inverse: turned(aim.inverse),
            own: turned(aim.own),
            shear: [f32x4::splat(simd, aim.shear.x), f32x4::splat(simd, aim.shear.y)],
            per_depth: aim.shear.z,
        }
    }

    /// The corners, seen from the ray: a corner each, with its axes in the lanes.
    #[inline(always)]
    fn seen(&self, simd: S, leaf: &Leaf) -> [f32x4<S>; 3] {
        let &[a, b, c]: &[[f32; 4]; 3] = bytemuck::cast_ref(leaf);
        let seen = |row| f32x4::simd_from(simd, row).swizzle_dyn_within_blocks(self.turn) - self.origin;
        [seen(a), seen(b), seen(c)]
    }

    /// Edge functions that neighbors share to the bit, so that no ray slips between them: Woop, Benthin and Wald,
    /// "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013. And how far along the third axis each corner lies.
    #[inline(always)]
    fn edges(&self, simd: S, [a, b, c]: [f32x4<S>; 3]) -> [f32x4<S>; 2] {
        // An axis each, with the corners in the lanes.
        let ab: f64x2<S> = a.zip_low(b).bitcast();
        let cc: f64x2<S> = c.zip_low(c).bitcast();
        let [x, y]: [f32x4<S>; 2] = [ab.zip_low(cc).bitcast(), ab.zip_high(cc).bitcast()];
        let ab: f64x2<S> = a.zip_high(b).bitcast();
        let cc: f64x2<S> = c.zip_high(c).bitcast();
        let z: f32x4<S> = ab.zip_low(cc).bitcast();
        let x = x - self.shear[0] * z;
        let y = y - self.shear[1] * z;
        let next = |v: f32x4<S>| v.swizzle_dyn_within_blocks(u8x16::simd_from(simd, NEXT));
        let last = |v: f32x4<S>| v.swizzle_dyn_within_blocks(u8x16::simd_from(simd, LAST));
        [last(x) * next(y) - last(y) * next(x), z]
    }
}

/// Twice the areas that the ray cuts a triangle into, opposite of its corners; of either sign.
#[must_use]
pub fn areas(seat: &Seat, leaf: &Leaf) -> Vec3 {
    dispatch!(Level::new(), simd => {
        let sight = Sight::new(simd, seat);
        let [areas, _] = sight.edges(simd, sight.seen(simd, leaf));
        Vec3::new(areas[0], areas[1], areas[2])
    })
}

/// The spec's inside test (2.3).
#[inline(always)]
#[must_use]
pub fn meet_triangle<S: Simd>(simd: S, leaf: &Leaf, sight: &Sight<S>) -> f32 {
    let seen @ [a, b, c] = sight.seen(simd, leaf);
    let [areas, z] = sight.edges(simd, seen);
    let below = areas.simd_lt(0.0).to_bitmask() & 7;
    let above = areas.simd_gt(0.0).to_bitmask() & 7;
    if below != 0 && above != 0 {
        return FAR;
    }
    // The same either way round, but for its sign.
    let area = areas[0] + (areas[1] + areas[2]);
    if area == 0.0 {
        return FAR;
    }
    let scaled = areas * z;
    let scaled = scaled[0] + (scaled[1] + scaled[2]);
    // Seen from its edge or from very far, a triangle of f32 is met where it is not: never outside of its box, so
    // that no node hides what a test would find.
    let low = a.min(b.min(c)) * sight.inverse;
    let high = a.max(b.max(c)) * sight.inverse;
    let near = low.min(high) - sight.own;
    let far = low.max(high) + sight.own;
    let enter = larger(near[0], larger(near[1], near[2]));
    let leave = lesser(far[0], lesser(far[1], far[2]));
    if enter > leave {
        return FAR;
    }
    ahead(larger(enter, lesser(leave, scaled * sight.per_depth / area)))
}
