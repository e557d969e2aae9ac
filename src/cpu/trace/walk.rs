//! a ray and the scene -> its nearest hit, or the first that stands in its way

use crate::cpu::trace::aim::{Aim, Ray, aim_of};
use crate::cpu::trace::boxes::boxes_met;
use crate::cpu::trace::meet::{meet_plane, meet_sphere, meet_triangle};
use crate::cpu::trace::solid::is_solid;
use crate::tables::{FAR, Leaf, NONE, PLANE, Plane, SPHERE, STACK_FULL, Sphere, Tables};

/// Where a walk is, and what it has found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walk {
    /// Only what is nearer than this counts; the distance to the hit once there is one.
    pub t: f32,
    /// The leaf, or [`NONE`]; of two at one distance the one whose number is lower.
    pub hit: u32,
    /// See [`Path`](crate::tables::Path).
    pub next: u32,
    /// Steps taken: a node or a primitive asked is one.
    pub turns: u32,
    /// [`STACK_FULL`].
    pub flags: u32,
}

impl Walk {
    /// A walk that has not begun; only what is nearer than `t` counts.
    #[must_use]
    pub fn new(t: f32) -> Self {
        Self { t, hit: NONE, next: 0, turns: 0, flags: 0 }
    }

    /// Whether there is nothing left to ask.
    #[must_use]
    pub fn over(&self, tables: &Tables, any: bool) -> bool {
        self.next == tables.settings.planes + 1 || (any && self.hit != NONE)
    }
}

/// The distance to where a ray meets leaf `i`, which is not a plane.
#[inline]
#[must_use]
pub fn meet(ray: Ray, aim: &Aim, per_length_squared: f32, leaf: &Leaf, i: u32) -> f32 {
    if leaf.kind == SPHERE {
        let sphere = Sphere { center: leaf.a, radius: leaf.b.x, ..bytemuck::Zeroable::zeroed() };
        return meet_sphere(ray, &sphere, per_length_squared, ray.leaves == i);
    }
    if ray.leaves == i {
        return FAR;
    }
    meet_triangle(ray, leaf, aim)
}

/// Asks the planes: they lie below no node.
pub fn planes(tables: &Tables, ray: Ray, walk: &mut Walk, most: u32, any: bool) {
    while walk.next < tables.settings.planes && walk.turns < most && !(any && walk.hit != NONE) {
        let i = walk.next;
        let leaf = &tables.leaves[i as usize];
        let t = meet_plane(ray, &Plane { point: leaf.a, material: 0, normal: leaf.b, pad: 0 });
        if t < walk.t && ray.leaves != i {
            walk.t = t;
            walk.hit = i;
        }
        walk.next = i + 1;
        walk.turns += 1;
    }
}

/// A child that is a node, and no primitive.
const NODES: u32 = 0xff00_0000;

/// Goes on from `start` until `most` steps are taken, or a few more: all primitives of a node are asked in one go.
/// With `any`, stops at the first that is met.
///
/// `stack` has `deep` places: the children of nodes that are still to be asked, where all of a node's begin; a bit for
/// each from bit 24 up, the next one the highest; and below bit 8, which of the places hold nodes.
#[must_use]
pub fn walk(tables: &Tables, stack: &mut [[u32; 2]], ray: Ray, start: Walk, most: u32, any: bool) -> Walk {
    let mut walk = start;
    planes(tables, ray, &mut walk, most, any);
    let planes = tables.settings.planes;
    if walk.next < planes {
        return walk;
    }

    let aim = aim_of(ray, tables.settings.low, tables.settings.high);
    let per_length_squared = 1.0 / ray.direction.dot(ray.direction);
    // The number of the hit; nothing wins a tie against the reach of a ray.
    let mut id = if walk.hit == NONE { 0 } else { tables.leaves[walk.hit as usize].id };
    // What of the stack is in hand; the root is the only child of nothing.
    let mut group = [0, if walk.next == planes { 0x8000_0000 } else { 0 }];
    let mut size = (walk.next.max(planes + 1) - planes - 1) as usize;
    while walk.turns < most && !(any && walk.hit != NONE) && (size > 0 || group[1] >= 1 << 24) {
        if group[1] < 1 << 24 {
            size -= 1;
            group = stack[size];
        }
        let bit = group[1].ilog2();
        group[1] ^= 1 << bit;
        if group[1] >= 1 << 24 {
            if size < stack.len() {
                stack[size] = group;
                size += 1;
            } else {
                walk.flags |= STACK_FULL;
            }
        }
        let before = (1 << ((bit - 24) ^ aim.octant)) - 1;
        let node = &tables.nodes[(group[0] + (group[1] & before).count_ones()) as usize];
        let mut met = boxes_met(node, ray, &aim, walk.t);
        group = [node.children, (met & NODES) | node.steps >> 24];
        met &= !NODES;
        walk.turns += 1;
        while met != 0 && !(any && walk.hit != NONE) {
            let i = node.leaves + met.trailing_zeros();
            met &= met - 1;
            let leaf = &tables.leaves[i as usize];
            let t = meet(ray, &aim, per_length_squared, leaf, i);
            let nearer = t < walk.t || (t == walk.t && leaf.id < id);
            if nearer && (leaf.kind <= PLANE || is_solid(tables, ray, &aim, leaf, any)) {
                walk.t = t;
                walk.hit = i;
                id = leaf.id;
            }
            walk.turns += 1;
        }
    }
    if group[1] >= 1 << 24 {
        if size < stack.len() {
            stack[size] = group;
            size += 1;
        } else {
            walk.flags |= STACK_FULL;
        }
    }
    walk.next = planes + 1 + size as u32;
    walk
}
