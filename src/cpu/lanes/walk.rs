//! a ray and the scene -> what `cpu/trace/walk.rs` finds, in another order: eight boxes and eight triangles at once
//!
//! Children are asked as the ray meets their boxes, not by their places; no order can show in what is found.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f32x8, mask32x8};
use glam::Vec3;

use super::LANES;
use super::herd::Open;
use super::meet::Seen;
use super::wide::{Block, Wide, Wides};
use crate::cpu::trace::aim::Ray;
use crate::cpu::trace::instanced::primitive_at;
use crate::cpu::trace::seat::Seat;
use crate::cpu::trace::walk::{Walk, past_planes};
use crate::tables::{NONE, Tables};

/// Walks of one scene, one after the other.
#[derive(Debug)]
pub struct Walker<'a> {
    pub(super) tables: &'a Tables,
    pub(super) wides: &'a Wides,
    pub(super) level: Level,
    /// Nodes to be asked, the nearest last. Above its number stand the bits of where the ray enters a node, which are
    /// in the order of their numbers from zero up.
    pub(super) stack: Vec<u64>,
    /// The same for eight rays at once.
    pub(super) open: Vec<Open>,
}

impl<'a> Walker<'a> {
    /// Walks of the scene of these tables, and of the tree that was made of them.
    #[must_use]
    pub fn new(tables: &'a Tables, wides: &'a Wides) -> Self {
        let room = LANES * tables.deep as usize;
        Self { tables, wides, level: Level::new(), stack: vec![0; room], open: vec![Open::NOTHING; room] }
    }

    /// From its start to its end.
    pub fn walk(&mut self, ray: Ray, mut start: Walk, any: bool) -> Walk {
        if self.tables.settings.planes > 0 {
            start = past_planes(self.tables, ray, start, u32::MAX, any);
        }
        if !(any && start.hit != NONE) {
            let mut found = Found { walk: start, id: 0, any };
            if start.hit != NONE {
                found.id = primitive_at(self.tables, start.hit).leaf.id;
            }
            let (tables, wides, stack) = (self.tables, self.wides, &mut self.stack[..]);
            let seat = || Seat::in_world(tables, ray);
            if tables.instances.is_empty() {
                dispatch!(self.level, simd => below::<_, false>(simd, tables, wides, &seat(), 0, stack, &mut found));
            } else {
                dispatch!(self.level, simd => below::<_, true>(simd, tables, wides, &seat(), 0, stack, &mut found));
            }
            start = found.walk;
        }
        start.turns += 1;
        start.next = self.tables.settings.planes + 1;
        start
    }
}

/// What was found so far.
pub(super) struct Found {
    pub(super) walk: Walk,
    /// The number of the hit; nothing wins a tie against the reach of a ray.
    pub(super) id: u32,
    pub(super) any: bool,
}

/// Asks all that lies below a node; instances only where there are any, and in no instance.
#[inline(always)]
pub(super) fn below<S: Simd, const INSTANCES: bool>(
    simd: S,
    tables: &Tables,
    wides: &Wides,
    seat: &Seat,
    root: u32,
    stack: &mut [u64],
    found: &mut Found,
) {
    let eyes = Eyes::new(simd, seat);
    let mut size = 0;
    let mut at = root;
    loop {
        let node = &wides.nodes[at as usize];
        let (enter, mut met) = eyes.boxes(node, found.walk.t);
        if met & !node.inner != 0 {
            for (held, block) in node.held.into_iter().zip(node.first..) {
                if met & held == 0 {
                    continue;
                }
                let block = &wides.blocks[block as usize];
                eyes.leaves(tables, block, found);
                let mut instances = if INSTANCES { block.instances } else { 0 };
                while instances != 0 && !(found.any && found.walk.hit != NONE) {
                    let leaf = &tables.leaves[(block.first + instances.trailing_zeros()) as usize];
                    instances &= instances - 1;
                    let of = &tables.instances[leaf.material as usize];
                    let seat = Seat::in_instance(tables, seat.ray, of);
                    below::<S, false>(simd, tables, wides, &seat, of.root, &mut stack[size..], found);
                }
            }
            if found.any && found.walk.hit != NONE {
                return;
            }
        }
        met &= node.inner;
        if met.is_power_of_two() {
            at = node.children[met.trailing_zeros() as usize % LANES];
            continue;
        }
        if met != 0 {
            let enter = enter.to_array();
            let bottom = size;
            let mut nearest = u64::MAX;
            while met != 0 {
                let child = met.trailing_zeros() as usize % LANES;
                met &= met - 1;
                let own = u64::from(enter[child].to_bits()) << 32 | u64::from(node.children[child]);
                let farther = nearest.max(own);
                nearest = nearest.min(own);
                if farther == u64::MAX {
                    continue;
                }
                let mut i = size;
                while i > bottom && stack[i - 1] < farther {
                    stack[i] = stack[i - 1];
                    i -= 1;
                }
                stack[i] = farther;
                size += 1;
            }
            at = nearest as u32;
            if f32::from_bits((nearest >> 32) as u32) <= found.walk.t {
                continue;
            }
        }
        at = loop {
            if size == 0 {
                return;
            }
            size -= 1;
            let top = stack[size];
            if f32::from_bits((top >> 32) as u32) <= found.walk.t {
                break top as u32;
            }
        };
    }
}

/// One ray in all lanes.
struct Eyes<S: Simd> {
    simd: S,
    seat: Seat,
    origin: [f32x8<S>; 3],
    inverse: [f32x8<S>; 3],
    /// What a near side and a far side lose: where the origin lies, with the slack.
    near_from: [f32x8<S>; 3],
    far_from: [f32x8<S>; 3],
    /// Which of the sides of boxes are the near ones; the far one of an axis is the other one.
    near: [usize; 3],
}

#[inline(always)]
fn splat<S: Simd>(simd: S, v: Vec3) -> [f32x8<S>; 3] {
    [f32x8::splat(simd, v.x), f32x8::splat(simd, v.y), f32x8::splat(simd, v.z)]
}

impl<S: Simd> Eyes<S> {
    #[inline(always)]
    fn new(simd: S, seat: &Seat) -> Self {
        let Seat { ray, aim, .. } = seat;
        // Sides and origin are multiplied before they are subtracted: what that takes off is in proportion to how far
        // all lies from zero, not from the ray.
        let from = ray.origin * aim.inverse;
        let slack = aim.slack + from.abs() * 3.8146973e-6;
        let near = |axis: usize| 2 * axis + usize::from(aim.inverse[axis] < 0.0);
        Self {
            simd,
            seat: *seat,
            origin: splat(simd, ray.origin),
            inverse: splat(simd, aim.inverse),
            near_from: splat(simd, from + slack),
            far_from: splat(simd, from - slack),
            near: [near(0), near(1), near(2)],
        }
    }

    /// Twin of [`boxes_met`](crate::cpu::trace::boxes::boxes_met): where the ray enters, and a bit for each child.
    #[inline(always)]
    fn boxes(&self, node: &Wide, t: f32) -> (f32x8<S>, u32) {
        let x = self.sides(node, 0);
        let y = self.sides(node, 1);
        let z = self.sides(node, 2);
        let entered = x.0.max(y.0).max(z.0.max(f32x8::splat(self.simd, 0.0)));
        let left = x.1.min(y.1).min(z.1.min(f32x8::splat(self.simd, t)));
        (entered, entered.simd_le(left).to_bitmask() as u32)
    }

    /// Asks a block's primitives, whichever child they belong to: what a ray meets, its box does.
    #[inline(always)]
    fn leaves(&self, tables: &Tables, block: &Block, found: &mut Found) {
        let Found { walk, id, any } = found;
        let (distances, met) = self.triangles(block, walk.t);
        let mut left = met | block.spheres;
        if left == 0 {
            return;
        }
        let distances = distances.to_array();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % LANES;
            left &= left - 1;
            let i = block.first + lane as u32;
            let leaf = &tables.leaves[i as usize];
            let number = i.wrapping_add(self.seat.numbers);
            let sphere = block.spheres & 1 << lane != 0;
            let t = if sphere { self.seat.meet_sphere(leaf, number) } else { distances[lane] };
            let own = !sphere && number == self.seat.ray.leaves;
            let nearer = !own && (t < walk.t || (t == walk.t && leaf.id + self.seat.ids < *id));
            if nearer && self.seat.is_solid(tables, leaf, *any) {
                walk.t = t;
                walk.hit = number;
                *id = leaf.id + self.seat.ids;
            }
        }
    }

    /// Where the ray crosses the near and the far sides on one axis. Fused or not, they are off by less than the slack.
    #[inline(always)]
    fn sides(&self, node: &Wide, axis: usize) -> (f32x8<S>, f32x8<S>) {
        let near = f32x8::from_slice(self.simd, &node.sides[self.near[axis]]);
        let far = f32x8::from_slice(self.simd, &node.sides[self.near[axis] ^ 1]);
        let inverse = self.inverse[axis];
        (near.mul_sub(inverse, self.near_from[axis]), far.mul_sub(inverse, self.far_from[axis]))
    }

    /// A corner of eight triangles, seen from the ray, its axes in turn.
    #[inline(always)]
    fn from(&self, corner: &[[f32; LANES]; 3], axes: [usize; 3]) -> [f32x8<S>; 3] {
        [
            f32x8::from_slice(self.simd, &corner[axes[0]]) - self.origin[axes[0]],
            f32x8::from_slice(self.simd, &corner[axes[1]]) - self.origin[axes[1]],
            f32x8::from_slice(self.simd, &corner[axes[2]]) - self.origin[axes[2]],
        ]
    }

    /// The distances to a block's triangles, and a bit for each that is met up to `most`.
    #[inline(always)]
    fn triangles(&self, block: &Block, most: f32) -> (f32x8<S>, u32) {
        let axes = self.seat.aim.axes;
        let a = self.from(&block.corners[0], axes);
        let b = self.from(&block.corners[1], axes);
        let c = self.from(&block.corners[2], axes);
        let (inverse, aim) = (&self.inverse, &self.seat.aim);
        let own = splat(self.simd, aim.own);
        let seen = Seen {
            corners: [a, b, c],
            shear: splat(self.simd, aim.shear),
            inverse: [inverse[axes[0]], inverse[axes[1]], inverse[axes[2]]],
            own: [own[axes[0]], own[axes[1]], own[axes[2]]],
        };
        let asked = mask32x8::from_bitmask(self.simd, u64::from(block.triangles));
        let (t, met) = seen.meet(asked, f32x8::splat(self.simd, most));
        (t, met.to_bitmask() as u32)
    }
}
